"""The contour of one tooth with its rim, for the stress on its generated fillet.

The virtual spur gear of module 1 in the normal section, its centre at the origin, the middle of the tooth on the y
axis, tip up; a ring is mirrored so that its rim lies below the tooth as well. Neighbouring teeth are left out: the root
circle goes on to 1.5 pitches beside the middle.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile
from gearlink.core.parts.gears.tooth.involute import involute

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.parts.gears.mesh.pair import GearPair

    Curve = Callable[[Reals], Points]

RIM = 5.0
"""Modules of the rim below the root circle, where the file names none."""
BESIDE = 1.5
"""Pitches from the middle of the tooth to where the root circle ends."""
TIP_ROUNDING = 0.12
_LEAST_ROUNDING = 0.005
_MOST_OF_GEAR = 0.8
"""Of the root circle that a rim takes at most."""
_FILLET = (0.0, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 0.9, 0.95, 1.0)
_LAND = (0.0, 0.02, 0.04, 0.08, 0.2, 0.4, 0.7, 1.0)
"""Places of the panels over fillet and land: short ones at their joint, without which a ring came out 2.4 % wrong."""
_FLANK = (0.0, 0.03, 0.08, 0.2, 0.45, 1.0)
_LOAD_HALF = 0.24
"""Modules of the flank to either side of the middle of the load."""
_LOAD_PANELS = 4


@dataclass(frozen=True, kw_only=True)
class RootContour:
    """The right half of a tooth with its rim, in modules.

    Parameters
        teeth : float - |z_n|
        ring : bool
        base, tip, root : float - radii
        at_base : float [rad] - of a gear half the angle of a space on the base circle, of a ring that of a tooth
        fillet : function of an array - points of the fillet, the middle of the space on the x axis, from root to flank
        ends : (float, float) - range of its parameter
        form : float - radius where the flank begins
        rim : float - thickness of the rim
    """

    teeth: float
    ring: bool
    base: float
    tip: float
    root: float
    at_base: float
    fillet: Callable[[Any], Any]
    ends: tuple[float, float]
    form: float
    rim: float

    @classmethod
    def of(
        cls, pair: GearPair, gear: int, shift: float, rim: float | None, tip_radius: float | None = None
    ) -> RootContour | None:
        """The contour of a gear of a pair; None of a ring whose cutter is not known, and of a tooth that is none.

        Parameters
            pair : GearPair
            gear : int - 0 or 1
            shift : float [module] - generating shift
            rim : float or None [module] - thickness below the root circle
            tip_radius : float or None [mm] - of a gear whose tooth is cut down; None: its tip circle
        """
        try:
            found = cls._ring(pair, rim) if pair.teeth[gear] < 0 else cls._gear(pair, gear, shift, rim, tip_radius)
        except NoSolution:
            return None
        return None if found is None or found.is_pointed else found

    @classmethod
    def _gear(cls, pair: GearPair, gear: int, shift: float, rim: float | None, tip: float | None) -> RootContour:
        turned = math.cos(pair.base_helix_angle) ** 2 * math.cos(pair.helix_angle)
        teeth, tool = pair.teeth[gear] / turned, pair.tool(gear)
        top = pair.tip_radius[gear] if tip is None else tip
        height = (top - pair.reference_radius[gear]) / pair.module
        profile = ToothProfile(
            module=1.0,
            teeth=cast(int, teeth),
            shift=shift,
            pressure_angle=pair.pressure_angle,
            tip_radius=0.5 * teeth + height,
            tool_addendum=tool.addendum,
            tool_rounding=tool.rounding,
            residual_undercut=tool.residual_undercut,
        )
        _, (curve, start, end), *_ = profile.pieces()
        half = (math.pi / 2.0 - 2.0 * shift * math.tan(pair.pressure_angle)) / teeth
        return cls(
            teeth=teeth,
            ring=False,
            base=profile.base_radius,
            tip=profile.outer_radius,
            root=profile.root_radius,
            at_base=half - involute(pair.pressure_angle),
            fillet=curve,
            ends=(start, end),
            form=profile.form_radius,
            rim=min(RIM if rim is None else rim, _MOST_OF_GEAR * profile.root_radius),
        )

    @classmethod
    def _ring(cls, pair: GearPair, rim: float | None) -> RootContour | None:
        if pair.shaped is None:
            return None
        ring = pair.shaped.virtual
        teeth = -float(ring.teeth)
        height = abs(pair.tip_radius[1] - pair.reference_radius[1]) / pair.module
        half = (math.pi / 2.0 + 2.0 * ring.shift * math.tan(pair.pressure_angle)) / teeth
        return cls(
            teeth=teeth,
            ring=True,
            base=0.5 * teeth * math.cos(pair.pressure_angle),
            tip=0.5 * teeth - height,
            root=ring.root_radius,
            at_base=half - involute(pair.pressure_angle),
            fillet=np.vectorize(ring.fillet, otypes=[complex]),
            ends=ring.turns,
            form=ring.form_radius,
            rim=RIM if rim is None else rim,
        )

    # Curves, the middle of the space on the x axis

    @property
    def _sign(self) -> float:
        return -1.0 if self.ring else 1.0

    def roll_at(self, radius: float) -> float:
        """Roll angle tan(alpha) of the flank at a radius."""
        return math.sqrt(max(0.0, (radius / self.base - 1.0) * (radius / self.base + 1.0)))

    def flank(self, roll: Any) -> Any:
        """The involute over its roll angle."""
        sign = self._sign
        start = math.pi / self.teeth - self.at_base if self.ring else self.at_base
        return self.base * (1.0 - 1j * sign * roll) * np.exp(1j * (start + sign * roll))

    def standing(self, points: Any) -> Any:
        """Points beside the middle of the space, in the frame of the tooth."""
        found = points * np.exp(1j * (0.5 * math.pi - math.pi / self.teeth))
        return np.conj(found) if self.ring else found

    @property
    def is_pointed(self) -> bool:
        """Whether the tip has no room for the minimum rounding, or lies too near to the base circle."""
        radius = _LEAST_ROUNDING
        inside = not self.ring and self.tip - TIP_ROUNDING <= self.base
        return inside or bool(np.angle(self._tip_corner(radius)[1]) > math.pi / self.teeth)

    @cached_property
    def tip_corner(self) -> tuple[float, float, complex]:
        """Radius of the rounding of the tip, the roll angle where the flank ends in it, and its centre."""
        radius = TIP_ROUNDING
        while radius > _LEAST_ROUNDING:
            roll, center = self._tip_corner(radius)
            if np.angle(center) <= math.pi / self.teeth:
                return radius, roll, center
            radius *= 0.5
        return _LEAST_ROUNDING, *self._tip_corner(_LEAST_ROUNDING)

    def _tip_corner(self, radius: float) -> tuple[float, complex]:
        """Roll angle at the end of the flank, and centre: on the parallel of the involute and of the tip circle."""
        sign = self._sign
        at = math.sqrt((self.tip - sign * radius) ** 2 - self.base**2) / self.base
        roll = at + sign * radius / self.base
        start = math.pi / self.teeth - self.at_base if self.ring else self.at_base
        return roll, complex(self.base * (1.0 - 1j * sign * at) * np.exp(1j * (start + sign * roll)))

    def load_patch(self, radius: float) -> tuple[float, float]:
        """Minimum and maximum roll angle of the load on the flank about a radius."""
        low, high = sorted((self.roll_at(self.form), self.tip_corner[1]))
        middle = min(max(self.roll_at(radius), low), high)
        # arc length of the involute: base roll^2/2
        half = _LOAD_HALF / self.base
        ends = [math.sqrt(max(0.0, middle * middle + 2.0 * side * half)) for side in (-1.0, 1.0)]
        room = 0.02 * (high - low)
        begin, end = max(ends[0], low + room), min(ends[1], high - room)
        return begin, end

    def pieces(self, load_radius: float) -> list[tuple[str, Curve, Sequence[float]]]:
        """Names, curves and places of panels from below the tooth counter-clockwise to the middle of its tip."""
        stand = self.standing
        begin, end = self.load_patch(load_radius)
        form, radius = self.roll_at(self.form), self.tip_corner[0]
        roll, center = self.tip_corner[1], self.tip_corner[2]
        flank = [*_between(form, begin if form < roll else end, _FLANK)]
        patch = np.linspace(begin, end, _LOAD_PANELS + 1)
        patch = patch if form < roll else patch[::-1]
        beyond = _between(float(patch[-1]), roll, (0.0, 0.5, 1.0))
        first, last = np.angle(self.flank(roll) - center), np.angle(self._sign * center)
        tip = float(np.angle(center))
        corner = _arc_about(center, radius)
        over = _turned(first, last, clockwise=self.ring)
        return [
            *self._rim(),
            ("fillet", lambda at: stand(self.fillet(at)), _between(*self.ends, _FILLET)),
            ("flank", lambda at: stand(self.flank(at)), flank),
            ("load", lambda at: stand(self.flank(at)), list(patch)),
            ("flank", lambda at: stand(self.flank(at)), beyond),
            ("corner", lambda at: stand(corner(at)), _between(*over, (0.0, 0.5, 1.0))),
            ("tip", lambda at: stand(_circle(self.tip)(at)), _between(tip, math.pi / self.teeth, (0.0, 0.5, 1.0))),
        ]

    def _rim(self) -> list[tuple[str, Curve, Sequence[float]]]:
        """Far side of the rim, its side, and the land beside the fillet, with rounded corners."""
        sign, stand, half = self._sign, self.standing, math.pi / self.teeth
        far = self.root - sign * self.rim
        edge = half - 2.0 * BESIDE * half
        edge = max(edge, half - 0.95 * math.pi)
        rounding = min(0.5, 0.2 * self.rim, 0.2 * far * (half - edge))
        side = np.exp(1j * edge)
        below, above = far + sign * rounding, self.root - sign * rounding
        turns = (math.asin(rounding / below), math.asin(rounding / above))
        centers = [place * np.exp(1j * (edge + turn)) for place, turn in zip((below, above), turns, strict=True)]
        ends = [place * math.cos(turn) for place, turn in zip((below, above), turns, strict=True)]
        to_side = edge - 0.5 * math.pi
        inward = edge + turns[0] + (math.pi if not self.ring else 0.0)
        outward = edge + turns[1] + (0.0 if not self.ring else math.pi)
        at_root = float(np.angle(self.fillet(np.asarray([self.ends[0]]))[0]))
        land = _between(at_root, edge + turns[1], _LAND)
        return [
            ("far", lambda at: stand(_circle(far)(at)), _between(half, edge + turns[0], (0.0, 0.25, 0.5, 0.75, 1.0))),
            (
                "side",
                lambda at: stand(_arc_about(centers[0], rounding)(at)),
                _halved(_turned(inward, to_side, clockwise=self.ring)),
            ),
            ("side", lambda at: stand(at * side), _between(ends[0], ends[1], (0.0, 0.33, 0.67, 1.0))),
            (
                "side",
                lambda at: stand(_arc_about(centers[1], rounding)(at)),
                _halved(_turned(to_side, outward, clockwise=self.ring)),
            ),
            ("land", lambda at: stand(_circle(self.root)(at)), land[::-1]),
        ]


def _circle(radius: float) -> Curve:
    return _arc_about(0.0, radius)


def _arc_about(center: complex, radius: float) -> Curve:
    return lambda angle: center + radius * np.exp(1j * angle)


def _between(low: float, high: float, shares: Sequence[float]) -> list[float]:
    return [low + share * (high - low) for share in shares]


def _halved(ends: tuple[float, float]) -> list[float]:
    return _between(*ends, (0.0, 0.5, 1.0))


def _turned(start: float, end: float, *, clockwise: bool) -> tuple[float, float]:
    """Angles of an arc from one direction to another, the way round that is named."""
    turn = (end - start) % (2.0 * math.pi)
    return float(start), float(start + (turn - 2.0 * math.pi if clockwise else turn))
