"""Where the roller of a wide-swing mechanism stands on its cam, which way that pushes it, and how it goes on.

In the frame of the line of centres, the cam axis at 0 and the rocker's axis at -1 centre distance, with the rocker
turning counter-clockwise in the stroke.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.machines.wide_swing.cams.oscillating_cam import OscillatingCam
from gearlink.core.machines.wide_swing.cams.slider_cam import SliderCam
from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
    from gearlink.core.machines.wide_swing.cams.curve import CurveState
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam


class Path(NamedTuple):
    """The roller at fractions of the stroke.

    Fields
        arm : (N,) complex array - its centre from the cam axis, in centre distances
        outward : (N,) complex array - unit vector along which the profile pushes it
        way : (N,) array - of its centre over the cam, in centre distances per input angle
        turning : (N,) array - speed of the cam, per input angle
    """

    arm: Points
    outward: Points
    way: Reals
    turning: Reals


def outward(cam: WideSwingCam, state: CurveState) -> Points:
    """Direction in which the profile pushes the roller, in the frame of the line of centres.

    Notes
        The body lies on the side of the inward normal of an external profile; at the cusp the limit of the run-up.
    """
    gradient = cam.curve.gradient(state)
    size = np.abs(gradient)
    cusp = size == 0.0
    unit = gradient / np.where(cusp, 1.0, size) + np.where(cusp, 1j * cam.sense, 0.0)
    return np.asarray(-cam.sense * unit)


def path(cam: AnyCam, k: Reals, *, resting: bool = False) -> Path:
    """The roller on any cam of a stroke; `resting`: on the arc beside the stroke of a cam that turns evenly."""
    if isinstance(cam, OscillatingCam):
        return _on_rocker(cam, k)
    return _with_slider(cam, k) if isinstance(cam, SliderCam) else _even(cam, k, resting=resting)


def _even(cam: WideSwingCam, k: Reals, *, resting: bool = False) -> Path:
    state = cam.curve.state(k)
    if resting:
        ones = np.ones_like(k)
        state = replace(state, a=ones, e=(1.0 - cam.ratio) * ones, second=0.0 * ones)
    arm = -((1.0 - cam.ratio) + cam.ratio * state.s) + 1j * cam.ratio * np.sin(state.psi)
    return Path(arm, outward(cam, state), np.abs(cam.curve.gradient(state)), np.ones_like(k))


def _with_slider(cam: SliderCam, k: Reals) -> Path:
    """Each half on the symmetric cam that it is half of; the run-out, taken backwards in time, is its mirror image."""
    found = Path(*np.empty((2, *k.shape), dtype=np.complex128), *np.empty((2, *k.shape)))
    for number, (half, rows, own) in enumerate(cam.split(k)):
        at = _even(half, own[rows])
        for whole, part in zip(found, at, strict=True):
            whole[rows] = part.conj() if number else part
    return found


def _on_rocker(cam: OscillatingCam, k: Reals) -> Path:
    """The body lies left of the roller's way over it."""
    step, span = cam.step(k), cam.cycle_angle
    return Path(step.arm, -1j * step.along, np.abs(step.first) / span, step.chi[1] / span)
