"""All tables and plots of the rendezvous benchmark."""

from benchmarks.papers import Measured
from benchmarks.rendezvous import (
    aims,
    figures,
    first_solve,
    forms,
    integrators,
    problems,
    pykep_peer,
    solves,
    stacks,
    starts,
)

NOTES = (
    "Units are such that fM = 1 and the craft starts near r = 1. All forms hold r, v1, c, phi* and rho, s1,",
    "e; 16 adds lambda, Phi*, mu, 14 adds nu and lambda, 11 adds nu and chi, 10 adds nu alone. Operations",
    "are counted after common subexpressions; derivatives are six columns in the costates at t0, by the",
    "variational equations. All forms are compiled to native code in the same way; the flight is the",
    "reference case's (60 degrees, time 12), a stage one of twelve of a step. Newton's method solves a",
    "fixed-time problem of least energy (time 6) from normally distributed costates, the same in each form,",
    "with least-squares steps, halved where the residual grows. Where a form's own residual vanishes, the",
    "extremal is flown anew and tested against (5) and (6). With nu0 = 0 kept, 16, 14 and 11 equations",
    "compute one map: their shares agree, their times do not. With all eight costates free the gauge nu0 is",
    "a null direction; with (15) in place of (6) one equation is missing. Warm solves start from the",
    "solution of a neighbour, 2 % away in the duration or in the bound: ours and pykep from its costates,",
    "solve_bvp from its trajectory; CasADi + Ipopt starts cold. The error is that of the cost against ours;",
    "in our own rows it is the certificate's largest residual. solve_bvp solves the repaired form and is",
    "given all Jacobians. pykep 3.0.1 is on PyPI for this Python, but pins heyoka 7.10.1 and cannot share",
    "our environment; its wheel lacks the data of pykep.trajopt.gym and does not import as it is; the",
    "gradient of its least-time problem raises. In an environment of its own, with a stand-in for the first",
    "and the missing parameter for the second, that problem, its mass as good as constant, is the same work",
    "as ours; its gradient is integrated to 1e-8, its default, ours to rounding. Its other problem, least",
    "mass, is other work: a fixed time, and the integral of |p| behind a logarithmic barrier; none of its",
    "problems minimises that of p^2. Flights one by one carry their derivatives always.",
)


def measure(quick: bool) -> Measured:
    """All tables and plots."""
    if line := pykep_peer.absent():
        print(line)
    costs, ends = forms.table(quick), starts.table(quick)
    times, flights = solves.table(quick), stacks.flights(quick)
    tables = {
        "forms": ("Right-hand sides and flights of the four forms", costs),
        "integrators": ("A flight with its derivatives by three integrators", integrators.table(quick)),
        "first-solve": ("The first solve in a fresh process", first_solve.table(quick)),
        "starts": ("Newton's method from random starts, and the Jacobian at the solution", ends),
        "solves": ("Warm solves side by side, one thread", times),
        "warm": ("Warm solves against the aim", aims.warm(quick)),
        "least-time": ("From nothing to least time against the aim", aims.least_time(quick)),
        "stacks": ("Flights one by one and many in one call", flights),
        "multistart": (
            "Newton's method from many starts, one by one and together",
            stacks.multistarts(quick),
        ),
    }
    drawn = [
        figures.form_costs(costs),
        figures.starts(ends),
        figures.solve_times(times, aims.WARM_AIM),
        figures.stacks(flights),
    ]
    return Measured(NOTES, problems.SEED, tables, drawn)
