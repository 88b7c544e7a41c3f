"""Which peers are installed; the rows of an absent one are left out, and a line says so."""

from importlib.metadata import PackageNotFoundError, version

PEERS = ("heyoka", "scipy", "ruckig", "clarabel", "casadi", "cvxpy", "highspy")


def installed(package: str) -> str | None:
    """The version of a package; None if it is absent."""
    try:
        return version(package)
    except PackageNotFoundError:
        return None


def absent(peer: str) -> str | None:
    """A line that says which rows are left out and how to get them; None if the peer is installed."""
    if installed(peer):
        return None
    return f'{peer} is not installed: its rows are left out (pip install "pontryagin[bench]")'
