"""The papers of the project, in the order of the report; a new paper is a line here."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Paper:
    """A paper: what the ledger calls it, its folder, and where it was printed."""

    name: str
    package: str
    title: str
    source: str


PAPERS = (
    Paper(
        "Gorelov & Morozova 2012",
        "triple_integrator",
        "Synthesis of optimal control of spacecraft partial rotation by moments method",
        "Yu. N. Gorelov, M. V. Morozova, 2012 (in Russian)",
    ),
    Paper(
        "Pimkina & Chelnokov",
        "rendezvous",
        "Boundary value problem of reduced dimension for optimal control of a spacecraft's orbital motion",
        "T. V. Pimkina, Yu. N. Chelnokov (in Russian)",
    ),
    Paper(
        "Sapunkov",
        "rendezvous",
        "Optimal trajectories and controls in the problem of the rendezvous of spacecraft",
        "Ya. G. Sapunkov (in Russian; the first page)",
    ),
    Paper(
        "Ibragimov 2017",
        "orbit_correction",
        "Time-optimal correction of a satellite's orbit",
        "D. N. Ibragimov, 2017 (in Russian)",
    ),
    Paper(
        "Akulenko 1977",
        "averaging",
        "Asymptotic solution of some nonlinear time-optimal control problems",
        "L. D. Akulenko, 1977 (in Russian)",
    ),
)
