"""Run a study for some time, from where it stopped, and write its table."""

import argparse
import os
import sys
from importlib import import_module
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING

from benchmarks.clock import SINGLE_THREAD

if TYPE_CHECKING:
    from studies.part import Part


def main() -> int:
    """The command line; 0 when done, 1 when another process is at work, 130 when the user stopped it."""
    os.environ.update(SINGLE_THREAD)  # before the next lines load NumPy, which reads it
    from pontryagin.io import files
    from studies import table
    from studies.records import AtWork, Records
    from studies.run import run

    known = sorted(path.parent.name for path in Path(__file__).parent.glob("*/study.py"))
    parser = argparse.ArgumentParser(prog="python -m studies", description=__doc__)
    parser.add_argument("study", choices=known, metavar="STUDY", help=f"of {', '.join(known)}")
    parser.add_argument("--seconds", type=float, default=60.0, help="how long (default: a minute)")
    parser.add_argument(
        "--keep", action="store_true", help="write the table to figures/ too, to be committed"
    )
    arguments = parser.parse_args()
    study = import_module(f"studies.{arguments.study}.study").STUDY
    records = Records(study, files.repository())
    folders = [records.folder, *([files.figures_folder() / "studies" / study.name] if arguments.keep else [])]
    try:
        with records.alone():
            try:
                run(study, records, arguments.seconds, _Lines())
            except KeyboardInterrupt:
                print("stopped; the same command goes on from here", file=sys.stderr)
                return 130
            finally:
                table.write(records, folders)
            table.show(records)
    except AtWork as reason:
        print(reason, file=sys.stderr)
        return 1
    for folder in folders:
        print(f"written to {folder.relative_to(files.repository())}")
    return 0


class _Lines:
    """A line on the chunk that was done last, at most every few seconds."""

    EVERY = 5.0

    def __init__(self) -> None:
        self._next = 0.0

    def __call__(self, part: "Part", number: int, seconds: float) -> None:
        if monotonic() >= self._next:
            print(f"{part.name}: chunk {number + 1} of {part.chunks} in {seconds:.1f} s", flush=True)
            self._next = monotonic() + self.EVERY


if __name__ == "__main__":
    sys.exit(main())
