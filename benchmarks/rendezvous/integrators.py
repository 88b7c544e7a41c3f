"""The shooting equations with their derivatives, by heyoka's Taylor series and by SciPy's DOP853."""

from dataclasses import replace

import numpy as np

from benchmarks.clock import take_turns
from benchmarks.rendezvous import problems
from pontryagin.rendezvous.reduced.conditions import Setting, equations

CASES = (*problems.FIXED, "inclined-10", "inclined-60", "glonass")


def table(quick: bool) -> dict[str, list]:
    """Times and derivatives of one flight of each case by both integrators, with switches located."""
    rows = []
    for name in CASES[:1] if quick else CASES:
        best = problems.solved(name)
        settings = {
            taylor: replace(problems.setting(best.problem), taylor=taylor) for taylor in (True, False)
        }
        unknowns = best.root.unknowns

        def run(setting: Setting, unknowns: np.ndarray = unknowns) -> int:
            equations(setting, unknowns)
            return 1

        timings = take_turns(
            {str(taylor): lambda setting=setting: run(setting) for taylor, setting in settings.items()},
            1 if quick else 5,
        )
        ours, theirs = (equations(setting, unknowns).jacobian for setting in settings.values())
        taylor, runge = (1e3 * timings[str(key)].typical for key in (True, False))
        difference = float(np.abs(ours - theirs).max() / np.abs(ours).max())
        rows.append((name, len(best.switch_times), taylor, runge, runge / taylor, difference))
    headings = ("case", "switches", "Taylor, ms", "DOP853, ms", "times slower", "difference of derivatives")
    return {heading: [row[i] for row in rows] for i, heading in enumerate(headings)}
