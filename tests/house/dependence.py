"""Which files of the project the tests of a file depend on; what cannot be told counts as depending on all.

The imports are followed as the report follows those of a notebook, into the benchmarks, the studies
and the tests' own modules too.
"""

import ast
import re
import textwrap
from functools import cache, cached_property
from pathlib import Path

from pontryagin.report.dependencies import closure
from pontryagin.report.study_keys import Checkout

BUILT = {"build", "dist", ".git", ".venv", ".hypothesis"}
ANYWHERE = {"repository", "cwd", "getcwd", "walk_packages", "iter_modules"}
"""Names in a test by which it may find any file of the project."""
CLIMBING = {"parent", "parents", "with_name", "dirname"}
"""Names by which it may find others from a module's file; the module itself is among the imports."""
RUNNING = {
    "subprocess",
    "Popen",
    "popen",
    "exec",
    "eval",
    "import_module",
    "find_spec",
    "runpy",
    "__import__",
}
"""Names in a test that run text: its strings may be code."""
MENTIONS = re.compile(r"\b(pontryagin|benchmarks|studies|tests|import)\b")
MODULE = re.compile(r"(pontryagin|benchmarks|studies|tests)(\.\w+)+")
FILLED = "_filled_"
"""Stands for what an f-string is filled with."""


class Project(Checkout):
    """The package together with the benchmarks, the studies and the tests' own modules."""

    @cached_property
    def everything(self) -> frozenset[Path]:
        """All files of the project but what was built."""
        visible = [place for place in self.root.iterdir() if place.name not in BUILT]
        found = (path for place in visible for path in ([place] if place.is_file() else place.rglob("*")))
        return frozenset(path for path in found if path.is_file() and not self._is_cache(path))

    def _is_cache(self, path: Path) -> bool:
        parts = path.relative_to(self.root).parts
        return any(
            part.endswith(("_cache", "__pycache__", ".egg-info")) or ".partial" in part for part in parts
        )

    def below(self, package: str) -> set[str]:
        """All modules of a package of ours; those of the whole project, where it is no single package."""
        place, _, rest = package.partition(".")
        if place in {"benchmarks", "studies"} or (place == self.folder.name and rest):
            return super().below(package)
        return set(self.modules) if place in {"", "tests", self.folder.name, *self.modules} else set()

    def files(self, test: Path) -> frozenset[Path]:
        """All files that the tests of a file depend on."""
        folders = [folder for folder in test.parents if folder.is_relative_to(self.root)]
        found = {path for path in (folder / "conftest.py" for folder in folders) if path.is_file()} | {test}
        own: set[Path] = set()
        while found != own:
            own = found
            code = _code([path.read_text(encoding="utf-8") for path in sorted(own)])
            if code is None or any(self._reads_anything(text) for text in code):
                return self.everything
            reached = closure(self, code)
            found = own | {path for path in reached if path.suffix == ".py" and self._is_beside(path)}
        drawn = self.everything if any("figures_folder" in _names(text) for text in code) else frozenset()
        return frozenset(
            own | reached | {path for path in drawn if path.is_relative_to(self.root / "figures")}
        )

    def _is_beside(self, path: Path) -> bool:
        return not path.is_relative_to(self.folder)

    def _reads_anything(self, text: str) -> bool:
        names = _names(text)
        own = re.search(r"(?<![\w.])__file__", text)
        climbs = "__file__" in names and CLIMBING & names
        return bool(own or climbs or ANYWHERE & names)


def _code(texts: list[str]) -> list[str] | None:
    """Texts, the modules that their strings name and, if one of them runs code, what may be code in strings.

    None if that cannot be told. Where a text itself runs nothing, a string without an import is no code.
    """
    strings = [(string, text) for text in texts for string in _strings(text)]
    modules = [f"import {string}.__main__" for string, _ in strings if MODULE.fullmatch(string)]
    if not any(map(_runs, texts)):
        return [*texts, *modules]
    scripts = [
        _as_code(string)
        for string, text in strings
        if not MODULE.fullmatch(string) and (_runs(text) or "import" in string)
    ]
    known = [script for script in scripts if script is not None]
    return [*texts, *modules, *known] if len(known) == len(scripts) else None


def _runs(text: str) -> bool:
    names = _names(text)
    return bool(RUNNING & names) or {"os", "system"} <= names


@cache
def _names(text: str) -> frozenset[str]:
    found: set[str] = set()
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.alias):
            found |= set(node.name.split("."))
        elif isinstance(node, ast.ImportFrom):
            found |= set((node.module or "").split("."))
        elif isinstance(node, ast.Name):
            found.add(node.id)
        elif isinstance(node, ast.Attribute):
            found.add(node.attr)
    return frozenset(found)


@cache
def _strings(text: str) -> tuple[str, ...]:
    """The strings of a text, docstrings apart, that mention an import or a folder of ours."""
    nodes = list(ast.walk(ast.parse(text)))
    filled = [node for node in nodes if isinstance(node, ast.JoinedStr)]
    silent = {id(part) for node in filled for part in node.values}
    silent |= {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    plain = [node for node in nodes if isinstance(node, ast.Constant) and id(node) not in silent]
    strings = [node.value for node in plain if isinstance(node.value, str)] + [_joined(one) for one in filled]
    return tuple(filter(MENTIONS.search, strings))


def _joined(node: ast.JoinedStr) -> str:
    return "".join(str(part.value) if isinstance(part, ast.Constant) else FILLED for part in node.values)


def _as_code(string: str) -> str | None:
    """The string if it is code that imports by names that are written out."""
    code = textwrap.dedent(string)
    try:
        nodes = list(ast.walk(ast.parse(code)))
    except SyntaxError:
        return None
    imports = [ast.unparse(node) for node in nodes if isinstance(node, ast.Import | ast.ImportFrom)]
    return code if imports and FILLED not in " ".join(imports) else None
