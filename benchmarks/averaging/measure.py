"""All measurements of the solvers of the third paper."""

from benchmarks.averaging import aims, collocation, enumeration, figures, flows, start
from benchmarks.averaging.examples import SEED
from benchmarks.papers import Measured

NOTES = (
    "Averaged solves include input checks and certificate. Exact extremals are all those around the",
    "averaged optimum, each polished to a residual of 1e-11 in the problem's own units; certificates, which",
    "a second integrator makes in slow time, are made when asked for, and timed for the best extremal. When",
    "all turns were solved and each flight was integrated alone, all extremals at epsilon 0.002 took, in",
    "processor time of one machine, 18.8 s for the Kepler transfer (now 0.81 s), 30.5 s for the rigid body",
    "(3.8 s), 3.8 s for the paid rotor (0.79 s) and 0.78 s for the rippled example (0.39 s); the first",
    "certificate took 3 to 15 s, since it made all of them, and takes 5 to 17 ms. One exact shot carries",
    "one guess to the end. Equations are compiled once and not timed, except in the table of first calls,",
    "which is of fresh processes. Errors of J0 and J0 + epsilon J1 are relative, against the least exact",
    "cost.",
    "Integrators follow the best extremal at epsilon 0.01 with the anomaly as the clock, at the tolerance",
    "1e-12; SciPy's call the same expressions compiled by Numba. Errors are against a long-double",
    "reference.",
    "Of 64 trajectories, native code carries eight at a time and heyoka's vector mode as many as it",
    "recommends for the processor; times are for each of them. One alone is followed by the integrator that",
    "each has for one.",
    "solve_bvp gets the exact problem with the Jacobian of its right-hand side, the averaged solution as",
    "its guess at 24 points a turn, the tolerance 1e-6 and up to 20000 nodes; it finds one extremal, ours",
    "all.",
)


def measure(quick: bool) -> Measured:
    """All tables and plots of the averaging benchmark."""
    exact, flown = enumeration.table(quick), flows.table(quick)
    tables = {
        "aims": ("Averaged solves, once compiled, against the aim", aims.table(quick)),
        "start": (
            "First calls in a fresh process, and the engine's build against the aim",
            start.table(quick),
        ),
        "exact-and-averaged": ("Exact extremals beside the averaged solve", exact),
        "integrators": ("The exact equations by four integrators", flown),
        "solve-bvp": ("solve_bvp on the exact problem", collocation.table(quick)),
    }
    landings = {epsilon: collocation.landing(epsilon) for epsilon in collocation.SHOWN}
    drawn = [
        figures.price_of_exactness(exact),
        figures.integrators(flown),
        figures.where_solve_bvp_lands(landings),
    ]
    return Measured(NOTES, SEED, tables, drawn)
