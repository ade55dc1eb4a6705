"""The blow where the roller changes flanks at mid-swing, and what an error of the profile moves at the ends."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.roots import bracketed_root

if TYPE_CHECKING:
    from gearlink.core.base.report import Check
    from gearlink.core.machines.wide_swing.design import WideSwingDesign

FARTHEST = 0.15
"""Part of the stroke after mid-swing up to which the formula, of leading order, is taken."""


def crossing_time(free: float, clearance: float, growth: float) -> float:
    """Time from mid-swing to the blow on the other flank.

    (tau - 2 tau_e)(tau + tau_e)^2 = 6 s/kappa, the minimum tau >= 2 tau_e

    Parameters
        free : float [s] - tau_e, before mid-swing, since the wall ended
        clearance : float [mm] - s, of the roller in its slot, both flanks together
        growth : float [mm/s^3] - kappa of the force that turns over, delta'' = -kappa tau
    Returns
        tau : float [s]
    Example
        >>> crossing_time(0.5, 0.0, 4.0), crossing_time(0.0, 18.0, 4.0)
        (1.0, 3.0)

    Source
        own derivation, to leading order in the time
    """
    volume = 6.0 * clearance / growth
    least = 2.0 * free
    most = least + float(np.cbrt(volume))
    return least if most <= least else bracketed_root(lambda t: (t - least) * (t + free) ** 2 - volume, least, most)


@dataclass(frozen=True)
class FlankImpact:
    """The blow of the roller on the far flank, in mm, s and J; from the design of a rocker with a cam.

    Source
        own derivation, to leading order: 2 to 5 % high against the free rocker integrated
    """

    design: WideSwingDesign

    @property
    def _middle(self) -> float:
        """Fraction of the stroke at which the device changes sides."""
        motion = self.design.motion
        return 0.5 if self.design.spec.slider is None else motion.slider.middle_place

    @cached_property
    def _slope(self) -> tuple[float, float]:
        """|dc/dk| at mid-swing of the force that is left, with a slider |dm/dk|/j; and j there."""
        motion = self.design.motion
        if self.design.spec.slider is None:
            return abs(motion.plain_law.middle_jerk), 1.0
        law, g = motion.slider, motion.slider.geometry
        speed = float(law.invariants(np.array([self._middle]), 1)[1][0])
        pull = float(g.force(np.zeros(1))[0]) * g.ratio / g.shortest
        inertia = law.inertia_at(0.5)
        return 0.5 * law.energy_parameter * motion.swing**2 * pull * speed / inertia, inertia

    @property
    def _reserve(self) -> float:
        """That of the working stroke, which a device sized by a shorter return stroke has more of."""
        motion = self.design.motion
        return (1.0 + self.design.unloading.size.reserve) * (motion.working_time / motion.stroke_time) ** 2 - 1.0

    @cached_property
    def _growth(self) -> float:
        """kappa = r rho gamma |dc/dk|/T^3 [mm/s^3]."""
        motion, slope = self.design.motion, self._slope[0]
        return self.design.cam.rocker_radius * self._reserve * motion.swing * slope / motion.working_time**3

    @property
    def _free(self) -> float:
        """tau_e, from the end of the wall to mid-swing [s]."""
        return self.design.cam.transition_zone * self.design.motion.working_time

    @cached_property
    def _time(self) -> float | None:
        """tau of the blow [s]; None without a reserve, and farther from mid-swing than the formula holds."""
        clearance = self.design.section.roller_clearance
        if clearance is None or self._growth <= 0.0:
            return None
        time = crossing_time(self._free, clearance, self._growth)
        return time if time <= FARTHEST * self.design.motion.working_time else None

    @property
    def speed(self) -> float | None:
        """v = kappa (tau^2 - tau_e^2)/2 of the roller against the flank [mm/s]."""
        time = self._time
        return None if time is None else 0.5 * self._growth * (time - self._free) * (time + self._free)

    @property
    def place(self) -> float | None:
        """Fraction of the stroke at the blow."""
        return None if self._time is None else self._middle + self._time / self.design.motion.working_time

    @property
    def _turning(self) -> tuple[float, float] | None:
        """Inertia [kg m^2] and speed v/r [rad/s] that the blow stops."""
        speed = self.speed
        if speed is None:
            return None
        return self.design.motion.inertia * self._slope[1], speed / self.design.cam.rocker_radius

    @property
    def energy(self) -> float | None:
        """(J/2)(v/r)^2 [J]."""
        found = self._turning
        return None if found is None else 0.5 * found[0] * found[1] ** 2

    @property
    def force(self) -> float | None:
        """Peak force v sqrt(k J)/r on a contact of stiffness k [N]."""
        found, stiffness = self._turning, self.design.section.contact_stiffness
        return None if found is None or stiffness is None else found[1] * math.sqrt(1e3 * stiffness * found[0])


def end_position_gain(design: WideSwingDesign) -> float:
    """Way at `output_radius` over an error of the profile, at the end of the swing where it is greater.

    (R/r) rho/(a sin phi_e): at rest the roller stands on the arc, rho^2 = a^2 + r^2 - 2 a r cos phi_e
    """
    cam, radius = design.cam, design.spec.output_radius
    assert radius is not None, "needed where the file has it"
    a, r = cam.center_distance, cam.rocker_radius
    offset = getattr(cam, "arm_offset", 0.0)
    sense = -1.0 if design.spec.layout == "twin-rocker" else 1.0
    gains = []
    for end in (0.5 * design.motion.swing + offset, 0.5 * design.motion.swing - offset):
        rho = math.sqrt((a - r) ** 2 + 4.0 * a * r * math.sin(0.5 * end) ** 2) if sense > 0.0 else cam.end_radius
        gains.append(radius / r * rho / (a * math.sin(end)))
    return max(gains, key=abs)


def flank_impact(design: WideSwingDesign) -> Iterator[Check]:
    """GL542: the speed of the blow, where the file has a limit."""
    from gearlink.core.base.wording import short
    from gearlink.core.machines.wide_swing import codes

    limit = design.spec.limits.impact_speed
    if limit is None or not design.has_profile:
        return
    speed, place = design.impact.speed, design.impact.place
    if speed is None or place is None:
        return
    yield codes.FLANK_IMPACT.check(
        "warn" if speed > limit else "pass",
        "speed at which the roller changes flanks",
        speed,
        limit,
        "mm/s",
        at=f"k = {short(place)}",
        fix="reduce cam.roller_clearance" if speed > limit else "",
    )
