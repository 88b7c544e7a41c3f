"""Processor seconds of the steps of a script in a fresh process."""

import json
import os
import subprocess
import sys

SCRIPT = """
import json
from time import process_time
spent = {}
def mark(step, since=[process_time()]):
    now = process_time()
    spent[step] = now - since[0]
    since[0] = now
%s
print(json.dumps(spent))
"""
"""The script around the steps; each step ends with ``mark(its name)``."""


def seconds(steps: str, **environment: str) -> dict[str, float]:
    """Seconds of each step in one process."""
    run = subprocess.run(
        [sys.executable, "-c", SCRIPT % steps],
        check=True,
        capture_output=True,
        text=True,
        env=os.environ | environment,
    )
    spent: dict[str, float] = json.loads(run.stdout)
    return spent


def least_seconds(steps: str, processes: int, **environment: str) -> dict[str, float]:
    """Seconds of each step, the least of several processes."""
    runs = [seconds(steps, **environment) for _ in range(processes)]
    return {step: min(run[step] for run in runs) for step in runs[0]}
