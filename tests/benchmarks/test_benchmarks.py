"""Timing, tables and plots of the benchmarks, and the agreement of each peer with our optima."""

import re
import tomllib

import numpy as np
import pytest
from benchmarks.clock import take_turns
from benchmarks.figures import accuracy_and_time
from benchmarks.triple_integrator import collocation, figures, fixed_time, grids, problems, propagation
from benchmarks.triple_integrator import transfers as least_time
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from benchmarks import contest, papers, peers, run, table
from pontryagin.io import files

COUNT = 4


@pytest.mark.slow
def test_problems_are_counted_and_processor_time_measured():
    timing = take_turns({"ten": lambda: 10, "busy": lambda: len([i * i for i in range(20_000)])}, rounds=3)
    assert timing["ten"].count == 10
    assert timing["busy"].count == 20_000
    assert 0 < timing["busy"].least <= timing["busy"].typical < 1e-3


def test_propagation_agrees_with_an_integrator():
    x0, _ = problems.ends("propagation", 1)
    durations, levels, force = np.array([[0.3, 0.9, 0.4]]), np.array([[2.0, -1.0, 3.0]]), 0.7
    state = x0[0]
    for duration, level in zip(durations[0], levels[0], strict=True):
        flow = solve_ivp(
            lambda t, x, u=level: [x[1], x[2] + force, u], (0, duration), state, rtol=1e-12, atol=1e-12
        )
        state = flow.y[:, -1]
    assert propagation.miss(x0, state[None], durations, levels, force)[0] < 1e-11
    assert propagation.miss(x0, state[None] + [[1e-6, 0, 0]], durations, levels, force)[0] > 1e-8


def test_an_impulse_before_and_after_a_piece_is_a_step_of_the_acceleration():
    rest, kicks = np.zeros((1, 3)), np.array([[1.0, -1.0]])
    coast = np.array([[2.0]])
    target = np.array([[2.0, 2.0, 0.0]])
    assert propagation.miss(rest, target, coast, 0 * coast, impulses=kicks)[0] == 0


@pytest.mark.parametrize("name", problems.MOMENT_CLASSES)
def test_problems_depend_on_the_seed_alone(name):
    first, again = problems.moments(name, COUNT), problems.moments(name, COUNT)
    for left, right in zip(first, again, strict=True):
        np.testing.assert_array_equal(left, right)
        assert np.isfinite(left).all()


def fixed_time_peers(problem: str) -> dict[str, fixed_time.Peer]:
    return grids.peers(problem, quick=True) | collocation.peers(problem, quick=True)


@pytest.mark.parametrize("problem", fixed_time.OURS)
def test_each_peer_finds_our_optimum_up_to_its_grid(problem):
    x0, xf = problems.ends(problem, COUNT)
    optimum = fixed_time.OURS[problem](fixed_time.Maneuver(x0, xf, 1.0)).norm
    found = fixed_time_peers(problem)
    if problem != "least L4 norm":  # Of its optimum only Ipopt knows.
        assert any("HiGHS" in method or "solve_bvp" in method for method in found)
    for package, name in (("clarabel", "Clarabel"), ("casadi", "CasADi")):
        line = peers.absent(package)
        assert line is None or (package in line and not any(name in method for method in found))
    for method, peer in found.items():
        costs = np.array([peer.solve(*ends) for ends in zip(x0, xf, strict=True)])
        excess = costs / optimum - 1
        assert (np.abs(excess) < 3e-3).all(), method
        assert (excess > -1e-6).all() or "solve_bvp" in method, method


def test_a_finer_grid_is_no_dearer():
    x0, xf = problems.ends("refinement", COUNT)
    coarse, fine = (grids.highs_impulse(cells) for cells in (50, 100))
    for ends in zip(x0, xf, strict=True):
        assert fine(*ends) <= coarse(*ends) * (1 + 1e-9)


@pytest.mark.parametrize("name", ["full states", "no acceleration at the ends"])
def test_both_sides_take_the_same_least_time(name):
    work = problems.transfers(name, 50)
    ours = least_time.by_pontryagin(work)
    assert ours.solved.all()
    if line := peers.absent("ruckig"):
        assert "ruckig" in line
        return
    theirs = least_time.by_ruckig(work)
    assert theirs.solved.mean() > 0.9
    np.testing.assert_allclose(theirs.duration[theirs.solved], ours.duration[theirs.solved], rtol=1e-9)


def test_an_absent_peer_is_named_in_one_line():
    line = peers.absent("no-such-solver")
    assert line is not None
    assert "\n" not in line
    assert line.startswith("no-such-solver is not installed")


def test_every_package_of_the_extra_bench_is_a_peer_whose_absence_is_told():
    written = tomllib.loads((files.repository() / "pyproject.toml").read_text())
    extra = written["project"]["optional-dependencies"]["bench"]
    assert {re.match("[a-z]+", line)[0] for line in extra} <= set(peers.PEERS) <= set(table.machine())


@pytest.fixture(scope="module")
def rows():
    found = []
    for problem in fixed_time.OURS:
        some = dict(list(fixed_time_peers(problem).items())[:1])
        found += fixed_time.rows(problem, some, count=2, large=5, rounds=1)
    return found


@pytest.mark.slow
def test_ratios_are_to_our_own_rows(rows):
    columns = table.columns(rows)
    for i, row in enumerate(rows):
        assert columns["microseconds"][i] == pytest.approx(1e6 * row.timing.typical)
        if row.method == contest.CALL:
            assert columns["times our call"][i] == 1
            assert columns["times our stack"][i] == pytest.approx(
                columns["microseconds"][i] / columns["microseconds"][i + 1]
            )


def test_tables_carry_the_machine_and_every_row(rows):
    facts, columns = table.machine(), table.columns(rows)
    assert facts["numpy"] == np.__version__
    csv = table.as_csv(facts, columns)
    markdown = table.section("Turns", facts, ["Noted."], {"a": ("A", columns)})
    assert csv.count("\n") == len(facts) + 1 + len(rows)
    assert markdown.count("\n| ") == 2 + len(rows)
    assert "## Turns" in markdown and "### A" in markdown and "Noted." in markdown
    assert all(value in markdown and value in csv for value in facts.values())


def measured(value: float) -> papers.Measured:
    figure = Figure()
    figure.set_label("line")
    return papers.Measured(["Noted."], 7, {"table": ("A table", {"value": [value]})}, [figure])


def test_one_paper_measured_alone_leaves_the_others_as_they_are(tmp_path):
    first, second = list(papers.PAPERS)[:2]
    for name, value in ((second, 1.5), (first, 2.5)):
        run.write(tmp_path, name, {"threads": "1"}, measured(value))
    page = (tmp_path / run.PAGE).read_text()
    assert page.index(papers.PAPERS[first]) < page.index("| 2.5 |") < page.index(papers.PAPERS[second])
    assert page.index(papers.PAPERS[second]) < page.index("| 1.5 |")
    kept = (tmp_path / first / "table.csv").read_bytes(), page.split(f"## {papers.PAPERS[second]}")[0]
    run.write(tmp_path, second, {"threads": "1"}, measured(3.5))
    page = (tmp_path / run.PAGE).read_text()
    assert "| 3.5 |" in page and "| 1.5 |" not in page
    assert (
        (tmp_path / first / "table.csv").read_bytes(),
        page.split(f"## {papers.PAPERS[second]}")[0],
    ) == kept
    assert (tmp_path / second / "line.svg").is_file()


def test_the_committed_page_has_a_section_of_every_paper_in_order():
    page = (files.figures_folder() / run.FOLDER / run.PAGE).read_text()
    titles = [line.removeprefix("## ") for line in page.splitlines() if line.startswith("## ")]
    assert titles == list(papers.PAPERS.values())


@pytest.mark.parametrize(
    ("value", "shown"),
    [(0.0, "0"), (1e-12, "1.0e-12"), (12.34, "12.3"), (5000.0, "5000"), (float("nan"), "–")],
)
def test_cells_have_three_digits(value, shown):
    assert table.text(value) == shown


def test_plots_show_every_contestant(rows):
    figure = accuracy_and_time(rows)
    drawn = sum(len(axis.get_lines()) for axis in figure.axes)
    assert drawn == sum(row.error >= 0 for row in rows)
    sizes = figures.stack_size({"stack": [1, 10], "least peak, microseconds": [20.0, 5.0]})
    assert sizes.axes[0].get_lines()[0].get_ydata().tolist() == [20.0, 5.0]


def test_failures_are_counted_by_cell():
    none, all_ = {"ruckig": 0, "pontryagin": 0}, {"ruckig": 4, "pontryagin": 0}
    miss = {"ruckig": 1e-16, "pontryagin": 1e-16}
    cells = [
        least_time.Cell("full states", "1e0", "1e0", 4, none, none, miss),
        least_time.Cell("full states", "1e0", "1e3", 4, all_, none, miss),
    ]
    assert least_time.by_cell(cells)["ruckig fails"] == [0, 1]
    assert least_time.summary(cells)["ruckig fails"] == [0.5]
    labels = [text.get_text() for text in figures.failures_by_scale(cells).axes[0].texts]
    assert labels == ["0", "100"]
