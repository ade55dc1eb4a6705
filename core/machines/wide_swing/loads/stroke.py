"""Roller and cam of one stroke of a wide-swing mechanism: how hard they press, and how they roll."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.base.design import placed
from gearlink.core.base.results import cached_property
from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam
from gearlink.core.machines.wide_swing.cams.outline import middle_of
from gearlink.core.machines.wide_swing.roller import path
from gearlink.core.machines.wide_swing.strokes import Parts, Stroke
from gearlink.core.mechanism.rates import TURNING_BACK
from gearlink.core.numerics.extremes import Extreme, extremes_over, maximum_over, minimum_over
from gearlink.core.studies.loads.cams.contact import LineContact, plane_modulus

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.machines.wide_swing.loads.design import WideSwingLoads
    from gearlink.core.numerics.arrays import Reals

_ROUNDING = 8.0
_STANDSTILL = 1e-4
Wanted: TypeAlias = "dict[str, tuple[Callable[[Reals], Reals], bool]]"


def _extremes(wanted: Wanted, parts: Parts) -> dict[str, Extreme]:
    """Maximum or minimum values of functions over parts of a stroke, each part searched in one go."""
    found = [extremes_over(list(wanted.values()), *part, samples=128) for part in parts]
    return {
        name: (max if greatest else min)((of_part[i] for of_part in found), key=lambda extreme: extreme.value)
        for i, (name, (_, greatest)) in enumerate(wanted.items())
    }


class SwingStroke:
    """A stroke under load, over the fractions k of it.

    Fields
        at : Stroke
        loads : WideSwingLoads
    """

    def __init__(self, at: Stroke, loads: WideSwingLoads) -> None:
        self.at, self.loads = at, loads

    name: str = placed("at.name")
    cam: AnyCam = placed("at.cam")
    start: float = placed("at.start")
    width: float = placed("at.width")
    words: str = placed("at.words")
    cam_words: str = placed("at.cam_words")
    parts: Parts = placed("at.parts")

    # Over the stroke

    def angle(self, k: Reals) -> Reals:
        """Input angle [rad]; the very end is that of the stroke, not of the rest after it, where the force jumps."""
        end = self.start + self.width
        last = end - _ROUNDING * np.spacing(end) if self.loads.whole else end
        return np.minimum(self.start + k * self.width, last)

    def force(self, k: Reals) -> Reals:
        """Force of the roller on its cam [N], out of the reactions; at the very end that before friction turns back."""
        last = self.start + self.width - 2.0 * TURNING_BACK
        found: Reals = self.loads.machine.reactions(np.minimum(self.angle(k), last)).unknowns["roller"][0]
        return found

    def relative_radius(self, k: Reals) -> Reals:
        """R = r_g (1 - r_g kappa) of roller and profile [mm], kappa positive where the body is convex."""
        radius = self.cam.roller_radius
        return radius * (1.0 - radius * self.cam.bulge(self.at.profile(k)[0]))

    def way(self, k: Reals) -> Reals:
        """Way of the roller's centre over the cam, per input angle [mm]."""
        place, rate = self.at.profile(k)
        return np.asarray(self.cam.center_distance * path(self.cam, place).way * np.abs(rate))

    def roller_speed(self, k: Reals) -> Reals:
        """Speed of the roller about its own axis [rad/s], positive in the sense of the working stroke.

        Notes
            A cam turns against the roller on its external profile, with it on its internal one.
        """
        place, rate = self.at.profile(k)
        at = path(self.cam, place)
        rolling = self.cam.center_distance / self.cam.roller_radius * at.way
        sense = self.cam.sense if isinstance(self.cam, WideSwingCam) else 1.0
        return np.asarray((rolling - sense * at.turning) * rate * self.loads.speed)

    def bearing_speed(self, k: Reals) -> Reals:
        """Speed of the roller on its pin of the rocker [rad/s]."""
        place, rate = self.at.profile(k)
        motion = self.loads.design.motion
        swung = motion.swing / self.cam.cycle_angle * motion.law.invariants(place, 1)[1]
        return np.asarray(self.roller_speed(k) - swung * rate * self.loads.speed)

    def entrainment(self, k: Reals) -> Reals:
        """Speed of both surfaces through the contact [mm/s]."""
        return self.way(k) * self.loads.speed * self.relative_radius(k) / self.cam.roller_radius

    def contact(self, k: Reals) -> LineContact | None:
        """The Hertzian contact; None without a width."""
        return self.contact_of(self.force(k), self.relative_radius(k)) if self.loads.section.roller else None

    def contact_of(self, force: Reals, radius: Reals) -> LineContact | None:
        """The same under a force [N] with a relative radius [mm]."""
        section = self.loads.section
        if section.roller is None:
            return None
        from gearlink.core.studies.loads.spec import Material

        material = section.material or Material()
        modulus = plane_modulus(material.modulus, material.poisson)
        return LineContact(force, radius, section.roller.width, modulus)

    @property
    def curved_parts(self) -> Parts:
        """Those in which the profile has a curvature.

        Notes
            At the standstills of a cam on a crank-rocker it bends without bound: it is looked at from 1e-4 on.
        """
        (first, start), (end, last) = self.parts
        if self.loads.spec.drive is not None:
            first, last = max(first, _STANDSTILL), min(last, 1.0 - _STANDSTILL)
        return (first, start), (end, last)

    @cached_property
    def is_undercut(self) -> bool:
        """Whether the roller is somewhere as large as the bend of its path: there is no contact there."""
        return any(minimum_over(self.relative_radius, *part, samples=128).value <= 0.0 for part in self.curved_parts)

    def greatest(self, f: Callable[[Reals], Reals], *, curved: bool = False) -> float:
        """Maximum value where the roller touches; `curved`: of what depends on the curvature there."""
        parts = self.curved_parts if curved else self.parts
        return max(maximum_over(f, *part, samples=128).value for part in parts)

    @cached_property
    def pressed(self) -> dict[str, Extreme]:
        """Maximum force, pressure and depth of the shear, and the minimum force, where the roller touches.

        Notes
            Searched together, so that the machine under its loads is computed once for all of them.
        """
        of_force: Wanted = {"force": (lambda k: np.abs(self.force(k)), True), "least_force": (self.force, False)}
        names = ("pressure",) if self.loads.spec.drive is not None else ("pressure", "shear_depth")
        has_width = self.loads.section.roller is not None
        of_contact: Wanted = {name: (self._of_contact(name), True) for name in names if has_width}
        if self.curved_parts == self.parts:
            return _extremes(of_force | of_contact, self.parts)
        return _extremes(of_force, self.parts) | _extremes(of_contact, self.curved_parts)

    def _of_contact(self, name: str) -> Callable[[Reals], Reals]:
        return lambda k: np.asarray(getattr(self._contact(k), name))

    @cached_property
    def shear_depth_at_greatest_pressure(self) -> float:
        """Depth of the maximum shear stress where the pressure is largest [mm]."""
        place = self.pressed["pressure"].place
        return float(self._contact(np.array([place])).shear_depth[0])

    def _contact(self, k: Reals) -> LineContact:
        found = self.contact(k)
        assert found is not None, "needed only where the roller has a width"
        return found

    def columns(self, k: Reals) -> dict[str, tuple[Any, str]]:
        """Force, pressure, radius and speeds; not a number where the roller touches nothing."""
        place = self.at.profile(k)[0]
        touching = self.loads.design.touches(self.cam, place) & (place != middle_of(self.cam))
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
