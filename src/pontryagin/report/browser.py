"""A look at the finished page in headless Chromium, where there is one: does MathJax read every formula?"""

import json
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from html import unescape
from pathlib import Path

PROGRAMS = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
OPTIONS = (
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
)
TIMEOUT = 180.0


@dataclass(frozen=True)
class Typeset:
    """How many formulas the browser typeset, and the TeX of those that it could not."""

    formulas: int
    failed: list[str]


def find() -> str | None:
    """Path of a Chromium, or None."""
    return next((path for path in map(shutil.which, PROGRAMS) if path), None)


def typeset(page: Path, program: str) -> Typeset | None:
    """What became of the page's formulas; None when the browser gives no answer.

    Parameters
    ----------
    page : Path
        The HTML report.
    program : str
        A Chromium.
    """
    with tempfile.TemporaryDirectory() as profile:
        command = [
            program,
            *OPTIONS,
            f"--user-data-dir={profile}",
            "--virtual-time-budget=60000",
            "--dump-dom",
        ]
        try:
            done = subprocess.run([*command, page.as_uri()], capture_output=True, text=True, timeout=TIMEOUT)
        except (OSError, subprocess.TimeoutExpired):
            return None
    root = re.search(r"<html[^>]*>", done.stdout)
    told = dict(re.findall(r'data-(formulas|failed)="([^"]*)"', root[0])) if root else {}
    if "formulas" not in told:
        return None
    return Typeset(int(told["formulas"]), json.loads(unescape(told["failed"])))
