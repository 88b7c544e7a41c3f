"""Recordings of three coupled channels of one body beside the motion of the uncoupled programmes."""

from pathlib import Path
from typing import Any

import numpy as np

from pontryagin.display.plotting import BLUE, RED
from pontryagin.display.recording import Events, Plot, Scene, View, record
from pontryagin.numerics.rotation import quaternion
from pontryagin.triple_integrator.coupling import Channels, CoupledManeuver, couple
from pontryagin.triple_integrator.norms.energy import minimum_energy
from pontryagin.triple_integrator.playback.spacecraft import (
    CHANNEL_COLOURS,
    SPACECRAFT,
    angle_between,
    draw_spacecraft,
    draw_target,
    rest_to_rest,
    sample_times,
)
from pontryagin.triple_integrator.problem.maneuver import Maneuver


def coupled_channels(path: Path) -> None:
    """Three coupled channels of one body.

    All three channels turn at once. The left body follows programmes that know the cross-coupling, iterated
    until the full equations reach the target; the right one the programmes of channels that know of no other.
    """
    channels = [rest_to_rest(angle) for angle in (0.4, -0.5, 0.6)]
    coupled = couple(SPACECRAFT, channels, minimum_energy)
    record_coupled(path, coupled)


def record_coupled(path: Path, coupled: CoupledManeuver) -> None:
    """Record a coupled manoeuvre beside the motion of the uncoupled programmes.

    Parameters
    ----------
    path : Path
        File to write, ending in ``.rrd``.
    coupled : CoupledManeuver
        The manoeuvre, with all three channels programmed for the least energy.
    """
    plain = tuple(
        minimum_energy(Maneuver(m.x0, m.xf, m.tf, m.t0)) for m in (p.maneuver for p in coupled.programmes)
    )
    uncoupled = Channels(coupled.body, plain, coupled.programmed).move()
    t = sample_times([*coupled.programmes, *plain])
    target = quaternion([programme.maneuver.xf[0] for programme in coupled.programmes])
    plots: list[View] = [
        Plot("channel angle, rad", "angle"),
        Plot("cross-coupling f, rad/s²", "coupling"),
        Plot("control, rad/s³", "control"),
        Plot("turn left to the target, rad", "left"),
    ]
    layout = [[Scene("the manoeuvre", "turn"), Events("iterations", "events")], plots]
    with record(path, "coupled channels", layout) as recording:
        bodies: list[tuple[str, Any, str]] = [("coupled", coupled, BLUE), ("uncoupled", uncoupled, RED)]
        for place, (label, motion, colour) in enumerate(bodies):
            position = np.array([6.0 * place, 0.0, 0.0])
            draw_spacecraft(recording, f"turn/{label}", t, motion.attitude(t), position, colour)
            draw_target(recording, f"turn/{label}-target", t, target, position)
            recording.curve(f"left/{label}", t, angle_between(motion.attitude(t), target), label, colour)
        state, f, u = coupled.state(t), coupled.coupling(t), coupled.control(t)
        for i, colour in enumerate(CHANNEL_COLOURS):
            recording.curve(f"angle/{i + 1}", t, state[i, :, 0], f"channel {i + 1}", colour)
            recording.curve(f"coupling/{i + 1}", t, f[i], f"channel {i + 1}", colour)
            recording.curve(f"control/{i + 1}", t, u[i], f"channel {i + 1}", colour)
        for k, miss in enumerate(coupled.misses):
            recording.event("events", t[0], f"iterate {k}: misses the target by {miss:.2e}")
