"""The public interface: names, the cost of an import, and the documentation of every argument and field."""

import ast
import dataclasses
import importlib
import inspect
import pkgutil
import re
import subprocess
import sys

import pytest

import pontryagin
from pontryagin import triple_integrator

PROMISED = ["Maneuver", "minimum_energy", "minimum_peak", "minimum_impulse", "minimum_norm", "minimum_time"]
FIELDS = {
    "minimum_energy": ["breakpoints", "breakpoint_offsets"],
    "minimum_peak": ["breakpoints", "switch_times", "switch_offsets", "first_sign"],
    "minimum_impulse": ["breakpoints", "impulse_times", "impulse_offsets", "impulses", "regime", "unique"],
}


def modules():
    """Every module of the package that imports here (extras may be absent)."""
    for info in pkgutil.walk_packages(pontryagin.__path__, "pontryagin."):
        if info.name.endswith("__main__"):
            continue
        try:
            yield importlib.import_module(info.name)
        except ModuleNotFoundError as missing:
            if missing.name and missing.name.split(".")[0] == "pontryagin":
                raise


def public_things():
    """Functions, classes and their public methods, by qualified name."""
    found = {}
    for module in modules():
        for name, thing in vars(module).items():
            if name.startswith("_") or getattr(thing, "__module__", None) != module.__name__:
                continue
            if inspect.isfunction(thing):
                found[f"{module.__name__}.{name}"] = thing
            elif inspect.isclass(thing):
                found[f"{module.__name__}.{name}"] = thing
                for attribute, method in vars(thing).items():
                    if inspect.isfunction(method) and not attribute.startswith("_"):
                        found[f"{module.__name__}.{name}.{attribute}"] = method
    return found


def parameters(thing):
    """The names of what a caller passes: the fields of a dataclass or the arguments of a function."""
    if dataclasses.is_dataclass(thing):
        return [field.name for field in dataclasses.fields(thing) if field.init]
    called = thing.__init__ if inspect.isclass(thing) else thing
    return [name for name in inspect.signature(called).parameters if name not in ("self", "cls")]


def section(doc, title):
    """The names that a NumPy docstring's section introduces: unindented lines, commas between names."""
    match = re.search(rf"^{title}\n-+\n(.*?)(?=^\w[\w ]*\n-+\n|\Z)", doc, re.MULTILINE | re.DOTALL)
    lines = [line for line in match.group(1).splitlines() if line and not line[0].isspace()] if match else []
    return {name.strip().lstrip("*") for line in lines for name in line.split(":")[0].split(",")}


def test_the_promised_names_are_there_and_listed():
    for name in PROMISED:
        assert callable(getattr(triple_integrator, name))
        assert name in triple_integrator.__all__
        assert name in dir(triple_integrator)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match=r"triple_integrator attribute minimum_regret"):
        _ = triple_integrator.minimum_regret


@pytest.mark.parametrize("name", FIELDS)
def test_solutions_have_the_promised_fields(name):
    solution = getattr(triple_integrator, name)(triple_integrator.Maneuver([0, 0, 0], [1, 0, 0], 1.0))
    common = ["maneuver", "norm", "multipliers", "control", "state", "costate", "certificate"]
    for field in [*common, *FIELDS[name]]:
        assert getattr(solution, field) is not None
    with pytest.raises(AttributeError):
        solution.maneuver = None


def run(code):
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return done.stdout.split()


SOLVE = """
from pontryagin.triple_integrator import Maneuver, minimum_energy, minimum_peak, minimum_impulse
from pontryagin.triple_integrator import minimum_time
m = Maneuver([0, 0, 0], [1, 0, 0], 1.0, disturbance=lambda t: t)
minimum_energy(m), minimum_peak(m), minimum_impulse(m), minimum_time([0, 0, 0], [1, 0, 0], 1.0)
"""


@pytest.mark.parametrize(
    ("code", "heavy"),
    [
        ("import pontryagin.triple_integrator", {"sympy", "numba", "matplotlib", "scipy", "rerun"}),
        (SOLVE, {"sympy", "numba", "matplotlib"}),
    ],
    ids=["an import", "one problem"],
)
def test_what_takes_long_to_load_is_not_loaded_by(code, heavy):
    assert not heavy & set(run(f"{code}\nimport sys\nprint(*sys.modules)"))


def test_importing_costs_little_beside_numpy():
    """Best of five, in processor time of one process that has NumPy loaded."""
    spent = run(
        "import numpy, time, sys\n"
        "def once():\n"
        "    for name in [n for n in sys.modules if n.startswith('pontryagin')]: del sys.modules[name]\n"
        "    start = time.process_time()\n"
        "    import pontryagin.triple_integrator\n"
        "    return time.process_time() - start\n"
        "print(min(once() for _ in range(5)))"
    )
    assert float(spent[0]) < 0.1


def test_derivations_import_no_numpy():
    folder = importlib.import_module("pontryagin.triple_integrator.derivation").__path__
    for info in pkgutil.iter_modules(folder):
        module = importlib.import_module(f"pontryagin.triple_integrator.derivation.{info.name}")
        tree = ast.parse(inspect.getsource(module))
        names = [
            alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names
        ]
        names += [node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)]
        assert not [name for name in names if name.split(".")[0] in ("numpy", "scipy", "numba")], info.name


@pytest.mark.slow
def test_every_public_thing_has_a_docstring():
    bare = [name for name, thing in public_things().items() if not (thing.__doc__ or "").strip()]
    assert not bare


def test_every_field_is_documented_where_any_is():
    missing = {}
    for name, thing in public_things().items():
        if dataclasses.is_dataclass(thing):
            doc = inspect.getdoc(thing) or ""
            told = section(doc, "Parameters") | section(doc, "Attributes")
            lacking = [field for field in parameters(thing) if field not in told]
            if lacking and told:
                missing[name] = lacking
    assert not missing


def test_every_argument_is_documented_where_any_is():
    """A docstring with a Parameters section names all arguments and nothing else."""
    wrong = {}
    for name, thing in public_things().items():
        told = section(inspect.getdoc(thing) or "", "Parameters")
        if told:
            taken = set(parameters(thing))
            if told != taken:
                wrong[name] = sorted(told ^ taken)
    assert not wrong


@pytest.mark.parametrize("name", PROMISED)
def test_what_users_call_documents_every_argument_and_shows_an_example(name):
    thing = getattr(triple_integrator, name)
    doc = inspect.getdoc(thing)
    assert section(doc, "Parameters") == set(parameters(thing))
    assert ">>> " in doc
    if not inspect.isclass(thing):
        assert "Returns\n-------" in doc


def test_the_check_of_docstrings_can_fail():
    doc = "Sum.\n\nParameters\n----------\na, b : float\n    Terms.\nc : int\n\nReturns\n-------\nfloat\n"
    assert section(doc, "Parameters") == {"a", "b", "c"}
    assert section(doc, "Attributes") == set()


@pytest.mark.parametrize("name", ["energy", "peak", "impulse", "norm", "entropy"])
@pytest.mark.parametrize("given", [[1, 2, 3], None])
def test_what_is_no_manoeuvre_is_refused_by_name(name, given):
    solve = getattr(triple_integrator, "maximum_entropy" if name == "entropy" else f"minimum_{name}")
    with pytest.raises(TypeError, match=r"^maneuver must be a Maneuver, got") as caught:
        solve(given, *[3.0] * (name == "norm"))
    assert caught.value.argument == "maneuver"
