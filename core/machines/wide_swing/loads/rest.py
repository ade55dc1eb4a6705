"""Roller and cam of a wide-swing mechanism in a rest, where the cam bears the whole device and the rocker stands."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
from gearlink.core.mechanism.rates import TURNING_BACK
from gearlink.core.numerics.extremes import extremes_over

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.loads.stroke import SwingStroke
    from gearlink.core.numerics.arrays import Reals

_ENDS = 2.0 * TURNING_BACK
LEAST = 4.0 * _ENDS
"""Input angle below which a rest is none [rad]: its ends belong to the strokes, where the force is another."""


@dataclass(frozen=True, eq=False)
class SwingRest:
    """The rest after a stroke, in which the arc of that stroke's cam holds the rocker.

    Fields
        stroke : SwingStroke - before it
        start, width : float [rad] - input angle at which it starts, and that it takes
    """

    stroke: SwingStroke
    start: float
    width: float

    @property
    def words(self) -> str:
        """What it is called."""
        return "far rest" if self.stroke.name == "main" else "near rest"

    def force(self, phi: Reals) -> Reals:
        """Force of the roller on the arc [N] at input angles, out of the reactions."""
        inside = np.clip(phi, self.start + _ENDS, self.start + self.width - _ENDS)
        found: Reals = self.stroke.loads.machine.reactions(inside).unknowns["roller"][0]
        return found

    def pressure(self, phi: Reals) -> Reals | None:
        """Pressure there [N/mm^2]; None without a width."""
        contact = self.stroke.contact_of(self.force(phi), np.full_like(phi, self.relative_radius))
        return None if contact is None else contact.pressure

    @property
    def relative_radius(self) -> float:
        """R = r_g (1 -+ r_g/rho) of roller and arc [mm], + of an internal profile; rho the pitch radius of the arc."""
        cam = self.stroke.cam
        assert isinstance(cam, WideSwingCam), "a cycle has cams that turn evenly"
        return cam.roller_radius * (1.0 - cam.sense * cam.roller_radius / cam.end_radius)

    @cached_property
    def forces(self) -> tuple[float, float]:
        """Greatest and least force on the arc [N]; what the file lets act may vary over the rest."""
        end, breaks = self.start + self.width, self.stroke.loads.machine.breaks
        joints = [angle for angle in breaks if self.start < angle < end]
        wanted = [(self.force, True), (self.force, False)]
        greatest, least = extremes_over(wanted, self.start, end, joints=joints, samples=128)
        return greatest.value, least.value

    @cached_property
    def pressed(self) -> dict[str, float]:
        """Greatest force, pressure and depth of the shear, and the least force: on an arc both go with the force."""
        greatest, least = self.forces
        found = {"force": max(abs(greatest), abs(least)), "least_force": least}
        contact = self.stroke.contact_of(np.array([greatest]), np.array([self.relative_radius]))
        if contact is not None:
            found |= {"pressure": float(contact.pressure[0]), "shear_depth": float(contact.shear_depth[0])}
        return found
