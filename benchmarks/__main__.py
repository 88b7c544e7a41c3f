"""Measure our solvers and their peers; write tables and plots to build/bench and figures/benchmarks."""

import argparse
import os

from benchmarks.clock import SINGLE_THREAD


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="small sizes; leaves figures/benchmarks alone")
    quick = parser.parse_args().quick
    os.environ.update(SINGLE_THREAD)  # read when NumPy is loaded, which the next line does
    from benchmarks.run import run

    run(quick)


if __name__ == "__main__":
    main()
