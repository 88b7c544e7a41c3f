"""Public names of a package that load their module at first use, so that an import costs nothing unneeded."""

from collections.abc import Callable, Mapping
from importlib import import_module
from typing import Any


def attach(
    package: str, homes: Mapping[str, str]
) -> tuple[Callable[[str], Any], Callable[[], list[str]], list[str]]:
    """Make ``__getattr__``, ``__dir__`` and ``__all__`` of a package.

    Parameters
    ----------
    package : str
        Its ``__name__``.
    homes : mapping of str to str
        Public name -> module of the package that defines it; "" for a module that is itself public.

    Returns
    -------
    tuple
        The three, in this order.

    Examples
    --------
    >>> find, names, everything = attach("pontryagin", {"Certificate": "certificate", "errors": ""})
    >>> find("Certificate").__module__, find("errors").__name__, names(), everything
    ('pontryagin.certificate', 'pontryagin.errors', ['Certificate', 'errors'], ['Certificate', 'errors'])
    """

    def find(name: str) -> Any:
        if name not in homes:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        home = homes[name]
        return (
            getattr(import_module(f"{package}.{home}"), name) if home else import_module(f"{package}.{name}")
        )

    return find, lambda: sorted(homes), list(homes)
