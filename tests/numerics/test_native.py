"""Native code equals its plain source, reads what a Python caller has, and survives its cache's mishaps."""

import math
import os
import subprocess
import sys
import threading
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_array_equal

from pontryagin.numerics import jit, native, object_code
from pontryagin.triple_integrator.least_time.arrival import solve_stack as time_stack
from pontryagin.triple_integrator.norms.energy import solve_stack as energy_stack
from pontryagin.triple_integrator.norms.impulse import solve_stack as impulse_stack
from pontryagin.triple_integrator.norms.peak import solve_stack as peak_stack
from pontryagin.triple_integrator.problem.maneuver import one_maneuver

SOLVERS = {
    "time": time_stack,
    "energy": energy_stack,
    "impulse": impulse_stack,
    "peak": peak_stack,
    "maneuver": one_maneuver,
}
NUMBERS = st.one_of(
    st.floats(-10, 10),
    st.sampled_from([0.0, -0.0, 1.0, -0.5, 1e-8, 1 / 3, 1 - 1e-16]),
    st.floats(allow_nan=False, allow_infinity=False),
)
SIX = st.tuples(*[NUMBERS] * 6)


def weighted(p, q, r):
    """A kernel whose outputs show the order of its inputs."""
    return p + 10 * q, math_root(r)


def math_root(r):
    return r**0.5 if r > 0 else -1.0 / r


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty cache."""
    monkeypatch.setattr(object_code, "cache_folder", lambda: tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def ready():
    """A solver that runs native code; its arguments hold two numbers and one."""
    solver = jit.batched(weighted, outputs=2, groups=(2, 1))
    assert solver._start()
    return solver


def fresh():
    return jit.batched(weighted, outputs=2, groups=(2, 1))


def plain(solver, values):
    """What the source returns, with what plain Python refuses as nan."""
    try:
        return solver._plain(*values)
    except ValueError:  # math.sqrt of a negative number or of nan
        return None


@pytest.mark.parametrize("name", SOLVERS)
@given(first=SIX, second=SIX)
def test_native_code_equals_the_plain_source_to_the_bit(name, first, second):
    solver = SOLVERS[name]
    assert solver._start()
    values = (*first, *second)[: sum(solver.groups)]
    expected, numbers = plain(solver, values), numbers_of(solver, values)
    if expected is None or not np.isfinite(expected).all():
        assert numbers is None or np.isfinite(numbers).all()
        return
    stack = solver(*(np.array([value]) for value in values))[0]
    assert stack.tobytes() == np.array(expected).tobytes()
    assert numbers.tobytes() == np.array([*values, *expected]).tobytes()


@pytest.mark.parametrize("name", SOLVERS)
@pytest.mark.parametrize("beyond", [math.nan, math.inf, -math.inf])
def test_no_number_beyond_range_is_taken(name, beyond):
    solver = SOLVERS[name]
    assert solver._start()
    usual = [0.1, 0.2, 0.3, 1.0, 0.5, 0.7, 2.0, 1.0, 0.5][: sum(solver.groups)]
    assert numbers_of(solver, usual) is not None
    for place in range(len(usual)):
        assert numbers_of(solver, [*usual[:place], beyond, *usual[place + 1 :]]) is None


def numbers_of(solver, values):
    """What the Python function of a solver returns, as an array."""
    rest = iter(values)
    parts = [next(rest) if size == 1 else [next(rest) for _ in range(size)] for size in solver.groups]
    numbers = solver.call(*parts)
    return None if numbers is None else np.frombuffer(numbers)


@pytest.mark.parametrize(
    "pair",
    [
        [1.0, 2.0],
        (1.0, 2.0),
        [1, 2],
        [np.float64(1), 2],
        np.array([1.0, 2.0]),
        np.array([2.0, 1.0])[::-1],
        np.array([[1.0, 0.0], [2.0, 0.0]])[:, 0],
        np.frombuffer(np.array([1.0, 2.0]).tobytes()),
    ],
)
@pytest.mark.parametrize("alone", [4.0, 4, np.float64(4), np.array(4.0)])
def test_it_reads_numbers_lists_tuples_and_arrays(ready, pair, alone):
    assert np.frombuffer(ready.call(pair, alone)).tolist() == [1, 2, 4, 21, 2]


@pytest.mark.parametrize(
    "pair",
    [
        [1.0, True],
        [1.0],
        [1.0, 2.0, 3.0],
        [1.0, "2"],
        [1.0, 10**400],
        [1.0, math.nan],
        [1.0, Fraction(1, 2)],
        np.array([[1.0, 2.0]]),
        np.array([1.0, 2.0], ">f8"),
        np.array([1, 2]),
        np.array(1.0),
        b"sixteen bytes...",
        1.0,
        None,
    ],
)
def test_it_leaves_everything_else_to_the_caller(ready, pair):
    assert ready.call(pair, 4.0) is None
    assert ready.call([1.0, 2.0], pair) is None or pair == 1.0 or np.shape(pair) == ()


def test_it_leaves_other_numbers_of_arguments_and_results_beyond_range_to_the_caller(ready):
    assert ready.call([1.0, 2.0]) is None and ready.call([1.0, 2.0], 4.0, 4.0) is None
    assert ready.call([1.0, 1e308], 4.0) is None and ready.call([1.0, 2.0], 0.0) is None
    with pytest.raises(TypeError):
        ready.call([1.0, 2.0], alone=4.0)


def test_packed_numbers_pass_from_one_solver_to_the_next(ready):
    following = jit.batched(weighted, outputs=2, groups=(3,), packed=True)
    assert following._start()
    numbers = np.frombuffer(following.call(np.array([9.0, 1.0, 2.0, 4.0]).tobytes()))
    assert numbers.tolist() == [1, 2, 4, 21, 2]
    assert following.call(b"short") is None


def scaled_sum(x, scale, table):
    """A kernel with a table, whose first number says how many follow."""
    total = 0.0
    for i in range(int(table[0])):
        total += table[i + 1] * x
    return scale * total, table[1]


def test_a_table_is_shared_by_all_problems():
    solver = jit.batched(scaled_sum, outputs=2, groups=(2,), packed=True, tables=1)
    x, scale, table = np.arange(4.0), np.full(4, 10.0), np.array([2.0, 3.0, 4.0]).tobytes()
    plain, alone = solver(x, scale, tables=(table,)), solver.one(1.0, 10.0, tables=(table,))
    assert_array_equal(plain, np.stack([70 * x, np.full(4, 3.0)], axis=-1))
    assert alone.tolist() == [70, 3] and solver._start()
    assert_array_equal(solver(x, scale, tables=(table,)), plain)
    assert_array_equal(solver.one(1.0, 10.0, tables=(table,)), alone)
    assert np.frombuffer(solver.call([1.0, 10.0], table)).tolist() == [1, 10, 70, 3]
    assert solver.call([1.0, 10.0], [2.0, 3.0, 4.0]) is None and solver.call([1.0, 10.0]) is None


def test_it_keeps_no_reference(ready):
    pair, alone = [1.0, 2.0], np.array(4.0)
    before = sys.getrefcount(pair), sys.getrefcount(alone), sys.getrefcount(None)
    for _ in range(1000):
        ready.call(pair, alone)
        ready.call(pair, "x")
    after = sys.getrefcount(pair), sys.getrefcount(alone), sys.getrefcount(None)
    assert after[:2] == before[:2] and abs(after[2] - before[2]) < 100


def test_columns_of_other_types_and_strides(ready):
    table = np.arange(12.0).reshape(4, 3)
    expected = [list(weighted(*row)) for row in table.tolist()]
    assert ready(*table.T).tolist() == expected
    assert ready(*table.T.astype(">f8")).tolist() == expected
    assert ready(*table.T.astype(int)).tolist() == expected
    assert ready(*np.frombuffer(b"x" + table.tobytes(), offset=1).reshape(4, 3).T).tolist() == expected
    with pytest.raises(ValueError, match="broadcast"):
        ready(np.arange(4.0), np.arange(3.0), np.arange(4.0))


def test_threads_that_start_together_make_the_code_once(folder, monkeypatch):
    made = []
    build = native.Recipe._object_code
    monkeypatch.setattr(native.Recipe, "_object_code", lambda self: made.append(1) or build(self))
    solver, columns = fresh(), np.random.default_rng(5).random((3, jit.COMPILE_FROM))
    results = []
    threads = [threading.Thread(target=lambda: results.append(solver(*columns))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 1 and len(results) == 8
    for result in results:
        assert_array_equal(result, results[0])
    assert [path.suffix for path in folder.iterdir()] == [".so"]


def test_threads_import_one_module_together(folder):
    modules, barrier = [], threading.Barrier(8)

    def load():
        barrier.wait()
        modules.append(native.load_module("VALUE = 7\n"))

    threads = [threading.Thread(target=load) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [module.VALUE for module in modules] == [7] * 8
    assert [path.suffix for path in folder.iterdir() if path.is_file()] == [".py"]


@pytest.mark.parametrize("content", ["VALUE = 8\n", "", "\0", "VALUE = "])
def test_a_module_runs_its_text_whatever_the_file_holds(folder, content):
    native.load_module("VALUE = 7\n")
    (path,) = (path for path in folder.iterdir() if path.is_file())
    path.write_text(content)
    assert native.load_module("VALUE = 7\n").VALUE == 7
    assert path.read_text() == "VALUE = 7\n"


@pytest.mark.parametrize("damage", [lambda _: b"", lambda text: text[:-20], bytes.swapcase])
@pytest.mark.parametrize("kind", ["nbi", "nbc"])
def test_what_numba_kept_is_made_anew_if_it_was_damaged(folder, damage, kind):
    text = (
        "from numba import njit\n\n\ndef thrice(x):\n    return 3 * x\n\n\n"
        'compiled = njit("float64(float64)", cache=True)(thrice)\n'
    )
    native.load_module(text)
    kept = [*(folder / "__pycache__").glob(f"*.{kind}")]
    assert kept
    for path in kept:
        path.write_bytes(damage(path.read_bytes()))
    assert native.load_module(text).compiled(2.0) == 6.0


def test_a_cache_is_closed_to_others_and_a_stranger_s_is_not_used(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    folder = tmp_path / "pontryagin"
    folder.mkdir()
    folder.chmod(0o777)
    assert object_code.cache_folder.__wrapped__() == folder
    assert folder.stat().st_mode & 0o777 == 0o755
    monkeypatch.setattr(object_code, "trusted", lambda state: False)
    with pytest.warns(RuntimeWarning, match="belongs to another user"):
        assert object_code.cache_folder.__wrapped__() != folder


@pytest.mark.parametrize(
    "damage", [lambda text: text[:-1], lambda text: text[:500], lambda _: b"", bytes.swapcase]
)
def test_a_damaged_file_is_made_anew(folder, damage):
    assert fresh()._start()
    (path,) = folder.iterdir()
    text = path.read_bytes()
    path.unlink()  # The process has it open.
    path.write_bytes(damage(text))
    path.chmod(0o600)
    again = fresh()
    assert not again._start(quick=True)
    assert again.call([1.0, 2.0], 4.0) is None
    assert again._start()
    assert np.frombuffer(again.call([1.0, 2.0], 4.0)).tolist() == [1, 2, 4, 21, 2]
    assert object_code.intact(path)


def test_a_file_that_others_may_write_is_not_opened(folder):
    assert fresh()._start()
    (path,) = folder.iterdir()
    assert object_code.intact(path)
    path.chmod(0o722)
    assert not object_code.intact(path) and not fresh()._start(quick=True)


def test_what_is_in_the_way_is_left_alone(folder):
    solver = fresh()
    for suffix in (".so", ".o"):
        solver._recipe.path.with_suffix(suffix).mkdir()
        solver._recipe.path.with_suffix(suffix).joinpath("something").touch()
    assert solver._start()
    assert np.frombuffer(solver.call([1.0, 2.0], 4.0)).tolist() == [1, 2, 4, 21, 2]
    assert len([*folder.rglob("something")]) == 2


@pytest.mark.parametrize("linker", [None, "false", "no-such-program"])
def test_without_a_linker_llvmlite_loads_the_object_code(folder, monkeypatch, linker):
    monkeypatch.setattr(object_code.shutil, "which", lambda _: linker)
    assert fresh()._start()
    (path,) = folder.iterdir()
    assert path.suffix == ".o" and object_code.intact(path)
    again = fresh()
    assert not again._start(quick=True)
    monkeypatch.setattr(native.Recipe, "made", None)
    assert again._start()
    assert np.frombuffer(again.call((1, 2.0), np.array(4.0))).tolist() == [1, 2, 4, 21, 2]
    assert again(*np.array([[1.0, 2.0, 4.0]] * 3).T).tolist() == [[21, 2]] * 3


def test_where_no_file_may_be_executed_llvmlite_loads_the_object_code(folder, monkeypatch):
    def refuse(path, symbols, externals):
        raise OSError("failed to map segment from shared object")

    monkeypatch.setattr(object_code, "open_library", refuse)
    monkeypatch.setitem(object_code.FORMS, ".so", refuse)
    assert fresh()._start()
    assert [path.suffix for path in folder.iterdir()] == [".o"]


@pytest.mark.parametrize("package", ["numba", "llvmlite"])
def test_without_numba_or_llvmlite_the_source_serves(folder, monkeypatch, package):
    monkeypatch.setitem(sys.modules, package, None)
    monkeypatch.setattr(jit, "has_numba", lambda: False)
    solver, columns = fresh(), np.random.default_rng(5).random((3, jit.COMPILE_FROM))
    assert solver(*columns).tolist() == [list(weighted(*row)) for row in columns.T.tolist()]
    assert solver.call([1.0, 2.0], 4.0) is None
    assert solver.one(1.0, 2.0, 4.0).tolist() == [21, 2]
    assert not list(folder.iterdir())


def test_single_calls_and_small_stacks_make_the_code_as_a_large_stack_does(folder):
    solver, columns = fresh(), np.ones((3, 100))
    for _ in range(jit.COMPILE_FROM - 401):
        assert solver.call([1.0, 2.0], 4.0) is None
    for _ in range(4):
        solver(*columns)
    assert not list(folder.iterdir())
    assert solver.call([1.0, 2.0], 4.0) is not None


def test_kept_code_solves_the_first_small_stack(folder, monkeypatch):
    assert fresh()._start()
    monkeypatch.setattr(jit.Batched, "_plain", None)
    assert fresh()(*np.array([[1.0], [2.0], [4.0]])).tolist() == [[21, 2]]
    assert fresh().call([1.0, 2.0], 4.0) is not None
    solver = fresh()
    assert solver._start() and solver.one(1.0, 2.0, 4.0).tolist() == [21, 2]


def test_other_kernels_and_other_versions_have_other_files(folder, monkeypatch):
    import llvmlite

    def path(**changes):
        recipe = {"kernel": weighted, "groups": (2, 1), "outputs": 2, "packed": False} | changes
        return native.Recipe(**recipe).path

    paths = [path(), path(groups=(3,)), path(packed=True), path(outputs=1), path(kernel=math_root)]
    monkeypatch.setitem(math_root.__globals__, "math_root", lambda r: r)
    paths.append(path())
    monkeypatch.setattr(llvmlite, "__version__", "another")
    paths.append(path())
    monkeypatch.setattr(native, "EXTENSION_SUFFIXES", [".cpython-311-aarch64-linux-gnu.so"])
    paths.append(path())
    monkeypatch.setattr(object_code.platform, "machine", lambda: "another")
    paths.append(path())
    assert len({*paths}) == len(paths)


FRESH = """
import sys
import numpy as np
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_impulse, minimum_peak, minimum_time
x0, xf = [0.0, 0.1, 0.2], np.array([1.0, 0.0, 0.0])
singles = [minimum_time(x0, xf, 1.0).norm, minimum_time(x0, xf, 1.0).duration]
for solve in (minimum_peak, minimum_energy, minimum_impulse):
    singles.append(solve(Maneuver(x0, xf, 2.0)).norm)
ends = np.random.default_rng(0).standard_normal((2, 600, 3))
minimum_time(*ends, 1.0)
for solve in (minimum_peak, minimum_energy, minimum_impulse):
    solve(Maneuver(*ends, 2.0))
loaded = [name for name in ("numba", "llvmlite.binding") if name in sys.modules]
print(loaded, [float(number).hex() for number in singles])
"""


@pytest.mark.slow
def test_a_fresh_process_imports_no_numba(tmp_path):
    lines = [
        subprocess.run(
            [sys.executable, "-c", FRESH],
            env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)},
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        for _ in range(2)
    ]
    assert lines[0].startswith("['numba', 'llvmlite.binding']")
    assert lines[1].startswith("[] ")
    assert lines[0].partition("]")[2] == lines[1].partition("]")[2]
