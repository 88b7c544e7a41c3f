"""Recordings as the tests read them."""

import subprocess
import sys

from pontryagin.display.recording import read_back


def verified(path):
    """The arrays that a recording holds, after rerun has found no fault in the file."""
    command = [sys.executable, "-m", "rerun", "rrd", "verify", str(path)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return read_back(path)


def assert_described(recordings):
    """The first line of each writer's docstring is a title, and its rest describes the recording."""
    for name, writer in recordings.items():
        title, description = writer.__doc__.split("\n\n", 1)
        assert name == name.lower()
        assert title.endswith(".") and len(description) > 80
