"""Mutants of the modules that decide: how many of a sample the quick tests kill."""

import json
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pontryagin.io import files
from studies.mutation.mutants import mutants
from studies.mutation.sample import BUDGET, KILLED, SURVIVED, TIMED_OUT, UNREACHED, Sample
from studies.part import Found, Part, Study

ROOT = files.repository()
SEED = 20240229
DECIDE = (
    "certificate.py",
    "triple_integrator/norms/*.py",
    "triple_integrator/least_time/*.py",
    "orbit_correction/gauges/*.py",
    "orbit_correction/plan/*.py",
    "averaging/averaged/certificate.py",
    "averaging/averaged/collocation.py",
    "averaging/exact/certificate.py",
    "averaging/exact/roots.py",
    "rendezvous/reduced/certificate.py",
    "rendezvous/reduced/conditions.py",
    "rendezvous/reduced/shooting.py",
    "rendezvous/elements/certificate.py",
    "numerics/newton.py",
    "numerics/arcs.py",
    "numerics/continuation.py",
)
"""The modules that decide, below ``src/pontryagin``: solvers, certificates, and what both are made of."""
EQUIVALENT = Path(__file__).with_name("equivalent.json")
"""Mutants that no test can tell from the module, by their keys, each with the reason."""


def sources() -> list[str]:
    """The modules that decide and have mutants, as paths in the checkout."""
    package = ROOT / "src" / "pontryagin"
    found = [path for pattern in DECIDE for path in sorted(package.glob(pattern))]
    return [str(path.relative_to(ROOT)) for path in found if mutants(path.read_text(encoding="utf-8"), "")]


SAMPLE = Sample(ROOT, ROOT / "build" / "studies" / "mutation", sources(), SEED)


def equivalent() -> dict[str, dict[str, str]]:
    """The mutants that are equivalent to their module, with the reasons."""
    return dict(json.loads(EQUIVALENT.read_text(encoding="utf-8"))) if EQUIVALENT.is_file() else {}


def row(part: Part, found: Sequence[Found]) -> Mapping[str, Any]:
    """The score of a module: the share of its sampled mutants that are not equivalent which tests notice."""
    known = equivalent()
    same = sum(one["key"] in known for one in found)
    counts = Counter(one["outcome"] for one in found if one["key"] not in known)
    noticed, counted = counts[KILLED] + counts[TIMED_OUT], len(found) - same
    return {
        "mutants": part.chunks,
        "sample": len(found),
        KILLED: counts[KILLED],
        TIMED_OUT: counts[TIMED_OUT],
        "equivalent": same,
        SURVIVED: counts[SURVIVED],
        UNREACHED: counts[UNREACHED],
        "score in percent": round(100 * noticed / counted) if counted else "",
    }


def survivors(part: Part, found: Sequence[Found]) -> Sequence[Mapping[str, Any]]:
    """The mutants that no test noticed and that are not known to be equivalent."""
    known, missed = equivalent(), {SURVIVED, UNREACHED}
    shown = ("key", "outcome", "function", "line", "kind", "before", "after")
    left = [one for one in found if one["outcome"] in missed and one["key"] not in known]
    return [{name: one[name] for name in shown} for one in left]


def _part(module: str) -> Part:
    dotted = module.removeprefix("src/").removesuffix(".py").replace("/", ".")
    return Part(
        name=dotted.removeprefix("pontryagin."),
        modules=[dotted],
        chunks=len(SAMPLE.order(module)),
        run=lambda _, number: SAMPLE.attempt(module, number),
        holds=lambda found: SAMPLE.holds(module, found) or found["key"] in equivalent(),
    )


STUDY = Study(
    name="mutation",
    title="Mutants of solvers and certificates",
    note=(
        "A mutant is a module with one small change: a comparison flipped or its boundary moved, a sum for a "
        "difference, a product for a quotient, a constant one larger or twice as large, a sign, a `not`, an "
        "`and`, a minimum for a maximum, a sine for a cosine, a statement left out. A seeded sample of each "
        "module's mutants runs, as plain Python, the quick tests of its paper (of its room in the core) that "
        f"reach the changed line, quickest first, {BUDGET:.0f} seconds of them. The score is the share "
        "of the sample, equivalent mutants apart, in which a test fails or does not end; equivalent is what "
        "has a reason why no test can tell it from the module. Slow tests are not run. Tests are written for "
        "the survivors of a sample: the score says how far that went, and that of another seed how good they "
        "are."
    ),
    seed=SEED,
    parts=[_part(module) for module in SAMPLE.modules],
    row=row,
    cases=survivors,
)
