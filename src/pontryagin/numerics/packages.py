"""Optional compiled packages: whether each is installed, with one warning if it is not."""

import functools
import importlib.util
import warnings


@functools.cache
def installed(package: str, consequence: str) -> bool:
    """Whether a package can be imported; if not, warn once per process about the consequence.

    Parameters
    ----------
    package : str
        Its name.
    consequence : str
        What the user notices without it, such as "large stacks run slowly, as plain Python".

    Examples
    --------
    >>> installed("numpy", "nothing runs")
    True
    """
    if importlib.util.find_spec(package) is not None:
        return True
    warnings.warn(f"{package} is not installed; {consequence}", UserWarning, stacklevel=3)
    return False
