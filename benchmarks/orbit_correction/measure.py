"""All measurements of the solvers of this paper."""

from benchmarks import table
from benchmarks.contest import Row
from benchmarks.figures import accuracy_and_time
from benchmarks.orbit_correction import aims, figures, gauges, growth, roots
from benchmarks.orbit_correction.states import SEED
from benchmarks.papers import Measured
from pontryagin.orbit_correction.plan.thrust import THRUSTS

NOTES = (
    "States are normally distributed, a hundredth of the radius and the speed in each component; impulses",
    "every 0.25 rad, of at most 0.0035 orbital speeds. Stacks hold 1000 states. Ours return costate,",
    "controls and both bounds. What depends on the number of steps alone is built once and not timed:",
    "peers' matrices, and our factors up to 1024 steps, which stay between calls. Peers get numbers of",
    "order one. Clarabel solves the cone programme in the impulses or in the costate, CVXPY the former",
    "with the state as a parameter. For the fewest steps a peer searches as we do; a state counts as",
    "solved where its number of steps is the proven one.",
    "SciPy's root finders solve (11) for psi and alpha in N_min steps from alpha = 1 and psi on the unit",
    "sphere. The time of a right root is that of a start over the share of starts that find it. Of single",
    "states the tables of the aims show the slowest, of the rounds the median.",
)


def measure(quick: bool) -> Measured:
    """All tables and plots."""
    rows = side_by_side(quick)
    grown, found = growth.table(quick), roots.table(quick)
    tables = {
        "side-by-side": ("Gauges and plans side by side, one thread", table.columns(rows)),
        "root-finders": ("SciPy's root finders on the system (11)", found),
        "aims": ("Orbit correction against the aims", aims.table(quick)),
        "growth": ("Growth with the number of steps", grown),
    }
    aim = (aims.MANY, aims.AIMS[f"gauge in {aims.MANY} steps"])
    drawn = [accuracy_and_time(rows), figures.growth(grown, aim), figures.root_finders(found, "random")]
    return Measured(NOTES, SEED, tables, drawn)


def side_by_side(quick: bool) -> list[Row]:
    """Both problems for the three sets of impulses."""
    count, rounds = (20, 2) if quick else (200, 5)
    result = []
    for measured in (gauges.given_steps, gauges.fewest_steps):
        for name in THRUSTS:
            result += measured(name, gauges.peers(name, quick), count, rounds)
    return result
