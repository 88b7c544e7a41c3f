"""Measure our solvers and their peers; write tables and plots to build/bench and figures/benchmarks."""

import argparse
import os

from benchmarks.clock import SINGLE_THREAD


def main() -> None:
    os.environ.update(SINGLE_THREAD)  # before the next lines load NumPy, which reads it
    from benchmarks.papers import PAPERS
    from benchmarks.run import run

    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    known = ", ".join(PAPERS)
    parser.add_argument("papers", nargs="*", metavar="PAPER", help=f"of {known}; all if none is named")
    parser.add_argument("--quick", action="store_true", help="small sizes; leaves figures/benchmarks alone")
    arguments = parser.parse_args()
    for name in arguments.papers:
        if name not in PAPERS:
            parser.error(f"PAPER must be one of {known}, got {name!r}")
    run(arguments.papers or list(PAPERS), arguments.quick)


if __name__ == "__main__":
    main()
