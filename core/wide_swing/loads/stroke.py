"""Roller and cam of one stroke of a wide-swing mechanism: where they stand, how hard they press, and how they roll.

The world has the cam axis O at 0 and the rocker's axis D on the line of centres; the rocker turns counter-clockwise
in the working stroke. k is the fraction of the stroke in time; where the roller then stands on the profile is a
fraction of the stroke that the profile was made for, another one on the way home of a cam that swings.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.loads.cams.contact import LineContact, plane_modulus
from gearlink.core.mechanism.rates import TURNING_BACK, Turn
from gearlink.core.numerics.extremes import Extreme, extremes_over, maximum_over, minimum_over
from gearlink.core.wide_swing import way_back
from gearlink.core.wide_swing.cams.outline import middle_of
from gearlink.core.wide_swing.loads.roller import path

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.wide_swing.cams.oscillating_cam import OscillatingCam
    from gearlink.core.wide_swing.cams.outline import AnyCam
    from gearlink.core.wide_swing.loads.design import WideSwingLoads

Parts: TypeAlias = tuple[tuple[float, float], tuple[float, float]]
_ROUNDING = 8.0
_STANDSTILL = 1e-4
Wanted: TypeAlias = "dict[str, tuple[Callable[[Reals], Reals], bool]]"


def _extremes(wanted: Wanted, parts: Parts) -> dict[str, Extreme]:
    """Greatest or least values of functions over parts of a stroke, each part searched in one go."""
    found = [extremes_over(list(wanted.values()), *part, samples=128) for part in parts]
    return {
        name: (max if greatest else min)((of_part[i] for of_part in found), key=lambda extreme: extreme.value)
        for i, (name, (_, greatest)) in enumerate(wanted.items())
    }


@dataclass(frozen=True, eq=False)
class SwingStroke:
    """A stroke under load, over the fractions k of it.

    Fields
        name : str - of its roller: main, return
        cam : AnyCam - that guides it
        start : float [rad] - input angle at which it starts
        loads : WideSwingLoads
    """

    name: str
    cam: AnyCam
    start: float
    loads: WideSwingLoads

    @property
    def width(self) -> float:
        """Input angle that it takes [rad]."""
        return self.cam.cycle_angle

    @property
    def words(self) -> str:
        """What it is called."""
        return "working stroke" if self.name == "main" else "return stroke"

    @property
    def cam_words(self) -> str:
        """What its cam is called beside that of the working stroke."""
        return "cam" if self.name == "main" else "return cam"

    @property
    def mirrored(self) -> bool:
        """Whether it goes the other way round on a cam of its own."""
        return self.name != "main"

    def profile(self, k: Reals) -> tuple[Reals, Reals]:
        """Where on the profile the roller stands, as a fraction of the profile's stroke, and how fast that goes."""
        return k, np.ones_like(k)

    def at_profile(self, place: float) -> float:
        """Fraction k of this stroke at which the roller stands at a place of the profile."""
        return place

    def turn(self, k: Reals, order: int) -> Turn:
        """The rocker's angle from mid-swing, with its derivatives by the input angle."""
        motion = self.loads.design.motion
        a, *rates = motion.law.invariants(k, order)
        swing = -motion.swing if self.mirrored else motion.swing
        return Turn((a - 0.5) * swing, *(swing / self.width**n * rate for n, rate in enumerate(rates, 1)))

    def to_world(self, z: Points) -> Points:
        """From the frame in which cams are computed to the world; a mirrored stroke is its mirror image."""
        if self.loads.spec.layout == "twin-rocker":
            return np.asarray(-np.conj(z))
        return np.asarray(np.conj(z)) if self.mirrored else z

    def roller(self, k: Reals, *, resting: bool = False) -> tuple[Points, Points]:
        """Roller centre [mm] and the direction in which the cam pushes it; `resting`: on the arc beside its stroke."""
        at = path(self.cam, self.profile(k)[0], resting=resting)
        return self.to_world(self.cam.center_distance * at.arm), self.to_world(at.outward)

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
        return radius * (1.0 - radius * self.cam.bulge(self.profile(k)[0]))

    def way(self, k: Reals) -> Reals:
        """Way of the roller's centre over the cam, per input angle [mm]."""
        place, rate = self.profile(k)
        return np.asarray(self.cam.center_distance * path(self.cam, place).way * np.abs(rate))

    def roller_speed(self, k: Reals) -> Reals:
        """Speed of the roller about its own axis [rad/s], positive in the sense of the working stroke."""
        place, rate = self.profile(k)
        at = path(self.cam, place)
        rolling = self.cam.center_distance / self.cam.roller_radius * at.way
        return np.asarray((rolling - at.turning) * rate * self.loads.speed)

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
        from gearlink.core.loads.spec import Material

        material = section.material or Material()
        modulus = plane_modulus(material.modulus, material.poisson)
        return LineContact(force, radius, section.roller.width, modulus)

    @cached_property
    def parts(self) -> Parts:
        """Parts of the stroke in which the roller touches the profile."""
        return self.loads.design.contact_of(self.cam)

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
        """Greatest value where the roller touches; `curved`: of what depends on the curvature there."""
        parts = self.curved_parts if curved else self.parts
        return max(maximum_over(f, *part, samples=128).value for part in parts)

    @cached_property
    def pressed(self) -> dict[str, Extreme]:
        """Greatest force, pressure and depth of the shear, and the least force, where the roller touches.

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
        """Depth of the greatest shear stress where the pressure is greatest [mm]."""
        place = self.pressed["pressure"].place
        return float(self._contact(np.array([place])).shear_depth[0])

    def _contact(self, k: Reals) -> LineContact:
        found = self.contact(k)
        assert found is not None, "asked for only where the roller has a width"
        return found

    def columns(self, k: Reals) -> dict[str, tuple[Any, str]]:
        """Force, pressure, radius and speeds; not a number where the roller touches nothing."""
        place = self.profile(k)[0]
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


class WayHome(SwingStroke):
    """The way home of a cam on a crank-rocker, over the profile of the stroke; k is its fraction from the far end."""

    cam: OscillatingCam

    @property
    def width(self) -> float:
        """What the stroke leaves of the crank's turn [rad]."""
        return 2.0 * math.pi - self.cam.cycle_angle

    @property
    def words(self) -> str:
        """What it is called."""
        return "way home"

    @property
    def cam_words(self) -> str:
        """It is the same cam as that of the stroke."""
        return self.words

    @property
    def mirrored(self) -> bool:
        """It is the same cam that goes back."""
        return False

    def _home(self, k: Reals, order: int = 2) -> way_back.Home:
        """The cam there; at both ends, where the profile bends without bound, it stands at the stop itself."""
        at = way_back.home(self.cam, self.start + k * self.width, order)
        return at._replace(k=np.where(k == 0.0, 1.0, np.where(k == 1.0, 0.0, at.k)))

    def profile(self, k: Reals) -> tuple[Reals, Reals]:
        """The place goes backwards, and its speed is that over the stroke's."""
        at = self._home(k)
        return at.k, at.first * self.cam.cycle_angle

    def at_profile(self, place: float) -> float:
        """Fraction k of the way home at which the cam stands at a place of the stroke."""
        turned = float(way_back.crank_angle(self.cam, np.array([place]))[0])
        return (turned - self.start) / self.width

    def turn(self, k: Reals, order: int) -> Turn:
        """The rocker follows the cam, at whose places the profile has it as in the stroke."""
        at, motion = self._home(k, max(order, 2)), self.loads.design.motion
        a, *rates = motion.law.invariants(at.k, order)
        parts = [(a - 0.5) * motion.swing]
        if order > 0:
            parts.append(motion.swing * rates[0] * at.first)
        if order > 1:
            parts.append(motion.swing * (rates[1] * at.first**2 + rates[0] * at.second))
        if order > 2:
            bend = 3.0 * rates[1] * at.first * at.second + rates[0] * at.third
            parts.append(motion.swing * (rates[2] * at.first**3 + bend))
        return Turn(*parts)

    @cached_property
    def parts(self) -> Parts:
        """Parts of the way home in which the roller touches the profile."""
        (first, start), (end, last) = self.loads.design.contact_of(self.cam)
        a, b, c, d = (self.at_profile(place) for place in (last, end, start, first))
        return (a, b), (c, d)
