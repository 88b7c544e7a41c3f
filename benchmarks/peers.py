"""Which peers are installed; the rows of an absent one are left out, and a line says so."""

from importlib.metadata import PackageNotFoundError, version

PEERS = ("scipy", "ruckig", "clarabel", "casadi", "cvxpy", "highspy")


def absent(peer: str) -> str | None:
    """A line that says which rows are left out and how to get them; None if the peer is installed."""
    try:
        version(peer)
    except PackageNotFoundError:
        return f'{peer} is not installed: its rows are left out (pip install "pontryagin[bench]")'
    return None
