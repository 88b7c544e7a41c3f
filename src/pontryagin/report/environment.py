"""The environment of everything that the build runs: nothing is left to chance or to the user's settings."""

import os

from pontryagin.io.kept_results import FOLDER
from pontryagin.report.workspace import Workspace

EPOCH = "1325376000"
"""The moment that whatever asks for the time of the build is told, in seconds since 1970."""

_FIXED = {
    "PYTHONHASHSEED": "0",
    "SOURCE_DATE_EPOCH": EPOCH,
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    "MKL_NUM_THREADS": "1",
    "NUMEXPR_NUM_THREADS": "1",
    "NUMBA_NUM_THREADS": "1",
    "RERUN_ANALYTICS": "0",
    "PYDEVD_DISABLE_FILE_VALIDATION": "1",
    "LC_ALL": "C.UTF-8",
    "TZ": "UTC",
}
FIXED_KEY = repr(sorted(_FIXED.items()))


def environment(workspace: Workspace, **more: str) -> dict[str, str]:
    """Environment of everything that the build runs: fixed hashes, one thread, no user settings."""
    private = workspace.cache / "settings"
    private.mkdir(parents=True, exist_ok=True)
    return {
        **os.environ,
        **_FIXED,
        "IPYTHONDIR": str(private / "ipython"),
        "JUPYTER_CONFIG_DIR": str(private / "jupyter"),
        "MPLCONFIGDIR": str(private / "matplotlib"),
        FOLDER: str(workspace.results),
        "PYTHONPATH": str(workspace.source.parent),
        **more,
    }
