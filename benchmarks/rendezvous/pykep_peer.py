"""pykep's least-time problem in a process of its own, since pykep requires another version of heyoka.

The interpreter is expected in build/pykep; without it the rows are left out. It is made by
``python3 -m venv build/pykep && build/pykep/bin/pip install pykep==3.0.1``.
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
    """The interpreter of the environment that holds pykep."""
    return files.repository() / "build" / "pykep" / "bin" / "python"


def absent() -> str | None:
    """One line that says why pykep's rows are left out, or None if they are not."""
    if interpreter().is_file():
        return None
    return "build/pykep holds no pykep: its rows are left out (see benchmarks/rendezvous/pykep_peer.py)"


def solve(problem: Rendezvous, start: Extremal, rounds: int) -> dict[str, Any]:
    """Duration, residual and times of Newton's method on a least-time problem from a neighbour's costates.

    Empty if pykep's process dies, which a line says.
    """
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
    command = [str(interpreter()), pykep_least_time.__file__]
    try:
        done = subprocess.run(
            command, input=json.dumps(given), capture_output=True, text=True, check=True, timeout=300
        )
    except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as reason:
        print(f"pykep {reason}: its rows are empty")
        return {}
    answer: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return answer
