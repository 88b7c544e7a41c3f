"""The list of papers, read by the ledger, the command line, the report and make.

A new paper is an entry of `PAPERS` and a folder. This module imports nothing else from the package; only
`room` imports a paper's module by its name.
"""

from importlib import import_module
from importlib.util import find_spec
from typing import Any, NamedTuple


class Paper(NamedTuple):
    """A paper and where it is found in the project.

    Attributes
    ----------
    name : str
        The paper's name in the ledger.
    package : str
        Its folder in ``src/pontryagin``; papers that are solved together share one. With hyphens for
        underscores it names the command, ``pontryagin solve PACKAGE``, and the benchmarks.
    title, source : str
        Title of the paper; authors and year.
    chapter : str
        First digit of the names of its notebooks; commands and benchmarks are in this order.
    benchmark : str
        Title of its section of the benchmarks.
    """

    name: str
    package: str
    title: str
    source: str
    chapter: str
    benchmark: str


PAPERS = (
    Paper(
        "Gorelov & Morozova 2012",
        "triple_integrator",
        "Synthesis of optimal control of spacecraft partial rotation by moments method",
        "Yu. N. Gorelov, M. V. Morozova, 2012 (in Russian)",
        "1",
        "Turns about one axis (Gorelov & Morozova 2012)",
    ),
    Paper(
        "Pimkina & Chelnokov",
        "rendezvous",
        "Boundary value problem of reduced dimension for optimal control of a spacecraft's orbital motion",
        "T. V. Pimkina, Yu. N. Chelnokov (in Russian)",
        "4",
        "Low-thrust rendezvous (Pimkina & Chelnokov; Sapunkov)",
    ),
    Paper(
        "Sapunkov",
        "rendezvous",
        "Optimal trajectories and controls in the problem of the rendezvous of spacecraft",
        "Ya. G. Sapunkov (in Russian; the first page)",
        "4",
        "Low-thrust rendezvous (Pimkina & Chelnokov; Sapunkov)",
    ),
    Paper(
        "Ibragimov 2017",
        "orbit_correction",
        "Time-optimal correction of a satellite's orbit",
        "D. N. Ibragimov, 2017 (in Russian)",
        "2",
        "Orbit correction with the fewest impulses (Ibragimov 2017)",
    ),
    Paper(
        "Akulenko 1977",
        "averaging",
        "Asymptotic solution of some nonlinear time-optimal control problems",
        "L. D. Akulenko, 1977 (in Russian)",
        "3",
        "Averaging of nonlinear oscillations (Akulenko 1977)",
    ),
)
"""All papers, in the order of the ledger and of the report's front page."""


def packages() -> tuple[str, ...]:
    """The folders of the papers without repetition, in the order of the ledger.

    Examples
    --------
    >>> packages()
    ('triple_integrator', 'rendezvous', 'orbit_correction', 'averaging')
    """
    return tuple(dict.fromkeys(paper.package for paper in PAPERS))


def commands() -> dict[str, str]:
    """The folder of each command of ``pontryagin solve``, in the order of the chapters.

    Examples
    --------
    >>> list(commands())
    ['triple-integrator', 'orbit-correction', 'averaging', 'rendezvous']
    """
    ordered = sorted(PAPERS, key=lambda paper: paper.chapter)
    return {paper.package.replace("_", "-"): paper.package for paper in ordered}


def benchmarks() -> dict[str, str]:
    """The title of each section of the benchmarks, by the name of its command."""
    titles = {paper.package: paper.benchmark for paper in PAPERS}
    return {command: titles[package] for command, package in commands().items()}


def room(package: str, name: str) -> Any:
    """Import a module of a paper's folder, such as its ``claims`` or its ``command``.

    Examples
    --------
    >>> room("averaging", "claims").ENTRIES[0].paper
    'Akulenko 1977'
    """
    return import_module(f"pontryagin.{package}.{name}")


def having(name: str) -> list[str]:
    """The dotted names of all papers' modules with a given name, in the order of the chapters.

    Examples
    --------
    >>> having("generate")[0]
    'pontryagin.triple_integrator.generate'
    """
    modules = [f"pontryagin.{package}.{name}" for package in commands().values()]
    return [module for module in modules if find_spec(module) is not None]
