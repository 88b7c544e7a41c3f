"""pykep's least-time problem: its own process, because it pins another version of heyoka than we do.

Where build/pykep holds no such interpreter the rows are left out:
``python3 -m venv build/pykep && build/pykep/bin/pip install pykep==3.0.1`` makes one.
"""

import json
import subprocess
from pathlib import Path
from typing import Any

from benchmarks.rendezvous import pykep_least_time
from pontryagin.io import files
from pontryagin.rendezvous import Extremal, Rendezvous
from pontryagin.rendezvous.witness.cartesian import (
    start_of,
    target_by_kepler,
)


def interpreter() -> Path:
    """Of the environment that holds pykep."""
    return files.repository() / "build" / "pykep" / "bin" / "python"


def absent() -> str | None:
    """One line that says how to have pykep's rows, or None where they can be had."""
    if interpreter().is_file():
        return None
    return "build/pykep holds no pykep: its rows are left out (see benchmarks/rendezvous/elsewhere.py)"


def by_pykep(problem: Rendezvous, start: Extremal, rounds: int) -> dict[str, Any]:
    """Newton's method of a least-time problem from a neighbour's costates: duration, residual, times."""
    scaled = problem.scaled
    place, target = start_of(start.flight), target_by_kepler(scaled, 0.0)
    given = {
        "craft": [place[:3].tolist(), place[3:6].tolist()],
        "target": [target[:3].tolist(), target[3:].tolist()],
        "costates": place[6:].tolist(),
        "duration": start.flight.duration,
        "peak": scaled.peak,
        "rounds": rounds,
    }
    done = subprocess.run(
        [str(interpreter()), pykep_least_time.__file__],
        input=json.dumps(given),
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    return json.loads(done.stdout.splitlines()[-1])
