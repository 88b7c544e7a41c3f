"""The shooting equations with their derivatives, by heyoka's Taylor series and by SciPy's DOP853."""

from dataclasses import replace
from functools import partial

import numpy as np

from benchmarks.clock import one_call, take_turns
from benchmarks.rendezvous import problems
from benchmarks.table import by_heading
from pontryagin.rendezvous.reduced.conditions import equations

CASES = (*problems.FIXED, "inclined-10", "inclined-60", "glonass")


def table(quick: bool) -> dict[str, list]:
    """Times and derivatives of one flight of each case by both integrators, with switches located."""
    rows = []
    for name in CASES[:1] if quick else CASES:
        best = problems.solved(name)
        setting = problems.setting(best.problem)
        shots = {
            heading: partial(equations, replace(setting, taylor=taylor), best.root.unknowns)
            for heading, taylor in (("Taylor, ms", True), ("DOP853, ms", False))
        }
        runs = {heading: one_call(shot) for heading, shot in shots.items()}
        timings = take_turns(runs, 1 if quick else 5)
        taylor, runge = (timing.typical for timing in timings.values())
        ours, theirs = (shot().jacobian for shot in shots.values())
        rows.append(
            {
                "case": name,
                "switches": len(best.switch_times),
                **{heading: 1e3 * timing.typical for heading, timing in timings.items()},
                "times slower": runge / taylor,
                "difference of derivatives": float(np.abs(ours - theirs).max() / np.abs(ours).max()),
            }
        )
    return by_heading(rows)
