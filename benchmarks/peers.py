"""Which peers are installed; an absent one costs its rows and one line, never the run."""

from importlib.metadata import PackageNotFoundError, version

PEERS = ("scipy", "ruckig", "clarabel", "casadi", "cvxpy", "highspy")


def absent(peer: str) -> str | None:
    """One line that says which rows are missing and how to get them, or None where the peer is installed."""
    try:
        version(peer)
    except PackageNotFoundError:
        return f'{peer} is not installed: its rows are left out (pip install "pontryagin[bench]")'
    return None
