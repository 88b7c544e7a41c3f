"""The report from its parts: one text, rendered twice, checked in a browser where there is one."""

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path

from pontryagin import __version__
from pontryagin.io import files, sealed
from pontryagin.report import (
    assemble,
    browser,
    dependencies,
    front,
    measured,
    progress,
    provenance,
    studies,
    text,
    tree,
)
from pontryagin.report.execute import Executed
from pontryagin.report.recordings import Clip
from pontryagin.report.render_html import render_html
from pontryagin.report.render_pdf import render_pdf
from pontryagin.report.workspace import Workspace

SUBTITLE = "Optimal control of spacecraft, derived, solved and certified: the papers against their print"


def write_report(
    workspace: Workspace,
    executed: Sequence[Executed],
    clips: Sequence[Clip],
    entries: Sequence[Mapping[str, str]],
) -> None:
    """Write ``index.html`` and ``pontryagin.pdf``, each only when something in it changed.

    Raises
    ------
    UnreadableFormula
        When a formula cannot be rendered; the message names its cell.
    PandocWarning
        When another piece cannot be rendered.
    """
    markdown = whole_text(workspace, executed, clips, entries)
    title = {
        "pagetitle": "pontryagin",
        "subtitle": SUBTITLE,
        "imprint": f"version {__version__}, commit {provenance.commit(workspace)}",
    }
    key = _key(workspace, markdown, title)
    targets: dict[str, Callable[[text.Text, Path], None]] = {
        "pontryagin.pdf": lambda read, to: render_pdf(read.document, workspace.root, to, title),
        "index.html": lambda read, to: _write_html(read, workspace.root, to, title),
    }
    if find_spec("typst") is None:
        progress.note("typst is not installed here: no PDF")
        del targets["pontryagin.pdf"]
    stamps = {name: workspace.cache / "report" / f"{name}.key" for name in targets}
    due = [name for name in targets if not sealed.is_stamped(workspace.report / name, stamps[name], key)]
    read = text.read(markdown) if due else None

    def bring_up_to_date(name: str) -> None:
        watch = progress.Stopwatch()
        if read and name in due:
            _placed(read, targets[name], workspace.report / name)
            sealed.stamp(workspace.report / name, stamps[name], key)
        told = f"rendered in {watch}" if name in due else "nothing changed since it was rendered"
        progress.step("report", f"build/report/{name}: {told}")

    with ThreadPoolExecutor() as pool:
        list(pool.map(bring_up_to_date, targets))


def whole_text(
    workspace: Workspace,
    executed: Sequence[Executed],
    clips: Sequence[Clip],
    entries: Sequence[Mapping[str, str]],
) -> str:
    """The report as Markdown: front page, a chapter per notebook, recordings, measurements, provenance."""
    parts = [front.front_page(entries)]
    parts += [assemble.chapter(workspace, result) for result in executed]
    parts += [_recordings(clips), measured.benchmarks(workspace), studies.chapter(workspace)]
    parts += [provenance.index_of(assemble.items(executed))]
    return "\n\n".join(part for part in [*parts, provenance.provenance(workspace, executed)] if part)


def _recordings(clips: Sequence[Clip]) -> str:
    if not clips:
        return ""
    shown = "\n".join(f"[{clip.title}](play/{clip.name}.html)\n:   {clip.description}\n" for clip in clips)
    return f"""# Recordings {{#recordings}}

Each recording replays in the browser, with no network. The same files open in rerun's own viewer, with
`.venv/bin/rerun build/recordings/{clips[0].name}.rrd` and so on.

{shown}"""


def _write_html(read: text.Text, root: Path, target: Path, title: dict[str, str]) -> None:
    page = render_html(read.document, root, title)
    program = browser.find()
    if not read.places:
        files.write(target, page)
        return
    if program is None:
        files.write(target, page)
        progress.note("no Chromium here: the formulas of index.html were not looked at in a browser")
        return
    with files.replacing(target) as draft:
        draft.write_text(page, encoding="utf-8")
        seen = browser.typeset(draft, program)
        error = read.unreadable("", seen.failed) if seen else None
        if error:
            raise error
    if seen is None:
        progress.note("Chromium gave no answer: the formulas of index.html were not looked at in a browser")
    else:
        progress.step("browser", f"{seen.formulas} formulas typeset in Chromium")


def _placed(read: text.Text, render: Callable[[text.Text, Path], None], target: Path) -> None:
    try:
        render(read, target)
    except tree.PandocWarning as warning:
        raise (read.unreadable(str(warning)) or warning) from None


def _key(workspace: Workspace, markdown: str, title: Mapping[str, str]) -> str:
    own = [path for path in Path(__file__).parent.rglob("*") if path.is_file() and path.suffix != ".pyc"]
    drawn = workspace.figures.rglob("*.svg")
    pictures = (workspace.build / "pictures").glob("*")
    known = dependencies.digest(*sorted(own), workspace.lock_text, root=Path(__file__).parent)
    shown = dependencies.digest(*sorted([*drawn, *pictures]), root=workspace.root)
    return dependencies.digest(known, shown, markdown, repr(sorted(title.items())))
