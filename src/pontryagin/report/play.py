"""``python -m pontryagin.report.play``: say where the players are, and open the first in a browser."""

import os
import sys
import webbrowser

from pontryagin.io import files
from pontryagin.report import progress
from pontryagin.report.workspace import Workspace


def main() -> int:
    """Print the players' paths and open the first one where there is a browser to do it."""
    pages = sorted((Workspace(files.repository()).report / "play").glob("*.html"))
    if not pages:
        progress.note("there are no players: `make report` says why")
        return 0
    for page in pages:
        progress.step("player", str(page))
    has_screen = (
        sys.platform in ("darwin", "win32") or os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    )
    if not (has_screen and webbrowser.open(pages[0].as_uri())):
        progress.note("no browser could be started from here: open one of these files in yours")
    return 0


if __name__ == "__main__":
    sys.exit(main())
