"""The turn of a rigid body: the gyroscopic torque, and the error of the attitude without it."""

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from pontryagin.display.plotting import INK, RED, SKY, styled, subplots
from pontryagin.triple_integrator.attitude import turn
from pontryagin.triple_integrator.attitude.rigid_body import RigidBody
from pontryagin.triple_integrator.figures import labels
from pontryagin.triple_integrator.figures.labels import Solution
from pontryagin.triple_integrator.problem.maneuver import Maneuver


@styled
def real_turn(body: RigidBody, axis: ArrayLike, maneuver: Maneuver) -> Figure:
    """A rigid body turned about an axis by each of the three programmes, integrated by Euler's equations.

    The upper panels show the torque along J e that the channel commands and the gyroscopic torque across the
    axis. The lower ones show the angle between planned and true attitude, with and without feedforward of the
    gyroscopic torque.

    Parameters
    ----------
    body : RigidBody
        Inertia in kg m^2, so that torques are in N m.
    axis : (3,) array_like
        Direction of the axis.
    maneuver : Maneuver
        One manoeuvre of the angle about the axis.
    """
    programmes: list[Solution] = [*labels.three(maneuver)]
    figure, axes = subplots(2, 3, height=4.7, sharex=True, sharey="row")
    for column, programme in zip(axes.T, programmes, strict=True):
        fed, unfed = (turn(body, axis, programme, feedforward) for feedforward in (True, False))
        t, colour = labels.instants(programme), labels.colour(programme)
        along = body.inertia @ fed.axis
        channel = fed.channel_torque(t) @ (along / np.linalg.norm(along))
        across = np.linalg.norm(fed.gyroscopic_torque(t), axis=1)
        column[0].axhline(0, color=INK, linewidth=0.6)
        column[0].plot(t, channel, color=colour, label="channel")
        column[0].plot(t, across, color=INK, linewidth=1.2, linestyle="--", label="gyroscopic")
        column[0].set_title(labels.name(programme), color=colour)
        for made, paint, words in ((unfed, RED, "left out"), (fed, SKY, "fed forward")):
            error = np.rad2deg(np.linalg.norm(made.error(t), axis=1))
            column[1].plot(t, np.where(error > 0, error, np.nan), color=paint, label=words)
        column[1].set(xlabel=labels.TIME, yscale="log")
    axes[0, 0].set_ylabel("torque, N m")
    axes[1, 0].set_ylabel("attitude error, degrees")
    axes[1, 0].set_ylim(1e-13, 1e3)
    axes[0, -1].legend(loc="upper right")
    axes[1, 0].legend(title="gyroscopic torque", loc="center right")
    figure.align_ylabels(axes[:, 0])
    return figure
