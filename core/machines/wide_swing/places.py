"""Where over the cam's turn the rocker is fastest, the pressure angle greatest and the curvature sharpest."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme

Places: TypeAlias = SimpleNamespace
"""Values by their names."""


def of_motion(design: WideSwingDesign) -> Places:
    """Extremes of the rocker's speed [rad/s] and acceleration [rad/s^2] over the working stroke, cam angles [rad]."""
    from gearlink.core.numerics.extremes import share_of
    from gearlink.core.numerics.motion_extremes import extremes

    motion = design.motion
    law, swing, angle, time = motion.law, motion.swing, motion.cycle_angle, motion.working_time
    curves = {
        "rocker_speed": lambda phi: swing / time * law.invariants(share_of(phi, angle), 1)[1],
        "rocker_acceleration": lambda phi: swing / time**2 * law.invariants(share_of(phi, angle), 2)[2],
    }
    return Places(**extremes(curves, 0.0, angle, samples=256))


def of_pressure(design: WideSwingDesign) -> float:
    """Cam angle [rad] of the greatest pressure angle on the profile."""
    import numpy as np

    # Next to a standstill of a cam that swings itself the ratio of both rates has no digits.
    found = _greatest(design, lambda k: np.abs(design.cam.pressure_angle(k)))
    if design.spec.drive is not None:
        ends = np.abs(design.cam.pressure_angle(np.array([0.0, 1.0])))
        if ends.max() > found.value:
            return float(np.argmax(ends)) * design.motion.cycle_angle
    return found.place * design.motion.cycle_angle


def of_curvature(design: WideSwingDesign) -> float | None:
    """Cam angle [rad] of the least radius of a bulging pitch curve on the profile; None where it bulges nowhere."""
    found = _greatest(design, design.cam.bulge)
    return found.place * design.motion.cycle_angle if found.value > 0.0 else None


def _greatest(design: WideSwingDesign, curve: Callable[[Reals], Reals]) -> Extreme:
    """The greatest value over the parts of the stroke in which the roller touches the profile."""
    from gearlink.core.numerics.extremes import maximum_over

    stop = 1e-3 if design.spec.drive is not None else 0.0
    parts = ((max(first, stop), min(last, 1.0 - stop)) for first, last in design.contact_of(design.cam))
    return max((maximum_over(curve, *part, samples=256) for part in parts), key=lambda found: found.value)
