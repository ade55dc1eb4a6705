"""Roller and cam of one stroke of a wide-swing mechanism: where they stand, how hard they press, and how they roll.

The world has the cam axis O at 0 and the rocker's axis D on the line of centres; the rocker turns counter-clockwise
in the working stroke. k is the fraction of the stroke.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.loads.cam_contact import LineContact, plane_modulus
from gearlink.core.numerics.extremes import maximum_over, minimum_over

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.wide_swing.cam import WideSwingCam
    from gearlink.core.wide_swing.curve import CurveState
    from gearlink.core.wide_swing.loads import WideSwingLoads

_MM = 1e-3
_ROUNDING = 8.0


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


@dataclass(frozen=True, eq=False)
class SwingStroke:
    """A stroke under load, over the fractions k of it.

    Fields
        name : str - of its roller: main, return
        cam : WideSwingCam - that guides it
        start : float [rad] - input angle at which it starts
        loads : WideSwingLoads
    """

    name: str
    cam: WideSwingCam
    start: float
    loads: WideSwingLoads

    def place(self, z: Points) -> Points:
        """From the frame in which cams are computed to the world; the return stroke is its mirror image."""
        if self.loads.spec.layout == "twin-rocker":
            return np.asarray(-np.conj(z))
        return z if self.name == "main" else np.asarray(np.conj(z))

    def roller(self, k: Reals, *, resting: bool = False) -> tuple[Points, Points]:
        """Roller centre [m] and the direction in which the cam pushes it; `resting`: on the arc beside its stroke."""
        cam = self.cam
        state = cam.curve.state(k)
        if resting:
            ones = np.ones_like(k)
            state = replace(state, a=ones, e=(1.0 - cam.ratio) * ones, second=0.0 * ones)
        arm = -((1.0 - cam.ratio) + cam.ratio * state.s) + 1j * cam.ratio * np.sin(state.psi)
        return self.place(_MM * cam.center_distance * arm), self.place(outward(cam, state))

    # Over the stroke

    def angle(self, k: Reals) -> Reals:
        """Input angle [rad]; the very end is that of the stroke, not of the rest after it, where the force jumps."""
        end = self.start + self.cam.cycle_angle
        last = end - _ROUNDING * np.spacing(end) if self.loads.whole else end
        return np.minimum(self.start + k * self.cam.cycle_angle, last)

    def force(self, k: Reals) -> Reals:
        """Force of the roller on its cam [N], out of the reactions."""
        found: Reals = self.loads.machine.reactions(self.angle(k)).unknowns["roller"][0]
        return found

    def relative_radius(self, k: Reals) -> Reals:
        """R = r_g (1 - r_g kappa) of roller and profile [mm], kappa positive where the body is convex."""
        radius = self.cam.roller_radius
        return radius * (1.0 - radius * self.cam.bulge(k))

    def way(self, k: Reals) -> Reals:
        """Way of the roller's centre over the cam, per cam angle [mm]."""
        curve = self.cam.curve
        return np.asarray(self.cam.center_distance * np.abs(curve.gradient(curve.state(k))))

    def roller_speed(self, k: Reals) -> Reals:
        """Speed of the roller about its own axis [rad/s]."""
        return (self.way(k) / self.cam.roller_radius - 1.0) * self.loads.speed

    def entrainment(self, k: Reals) -> Reals:
        """Speed of both surfaces through the contact [mm/s]."""
        return self.way(k) * self.loads.speed * self.relative_radius(k) / self.cam.roller_radius

    def contact(self, k: Reals) -> LineContact | None:
        """The Hertzian contact; None without a width."""
        section = self.loads.section
        if section.roller is None:
            return None
        from gearlink.core.loads.spec import Material

        material = section.material or Material()
        modulus = plane_modulus(material.modulus, material.poisson)
        return LineContact(self.force(k), self.relative_radius(k), section.roller.width, modulus)

    @cached_property
    def parts(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches the profile."""
        return self.loads.design.contact_of(self.cam)

    def greatest(self, f: Callable[[Reals], Reals]) -> float:
        """Greatest value where the roller touches."""
        return max(maximum_over(f, *part, samples=128).value for part in self.parts)

    def least(self, f: Callable[[Reals], Reals]) -> float:
        """Least value where the roller touches."""
        return min(minimum_over(f, *part, samples=128).value for part in self.parts)

    def columns(self, k: Reals) -> dict[str, tuple[Any, str]]:
        """Force, pressure, radius and speeds; not a number where the roller touches nothing."""
        touching = self.loads.design.touches(self.cam, k) & (k != 0.5)
        at = k[touching]
        none = np.full(at.shape, np.nan)
        locked = self.loads.locked
        contact, force = (None, none) if locked else (self.contact(at), self.force(at))

        def shown(values: Reals) -> Reals:
            found = np.full_like(k, np.nan)
            found[touching] = values
            return found

        return {
            "force": (shown(force), "N"),
            "pressure": (shown(none if contact is None else contact.pressure), "N/mm^2"),
            "radius": (shown(self.relative_radius(at)), "mm"),
            "roller_speed": (shown(self.roller_speed(at) * 60.0 / (2.0 * math.pi)), "1/min"),
            "entrainment": (shown(self.entrainment(at)), "mm/s"),
        }
