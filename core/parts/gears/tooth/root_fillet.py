"""The root of a gear that a rack tool cuts, in closed form and with `math` alone: fillet, form radius, undercut.

The tool's rounding leaves in the transverse section the envelope of an ellipse. With b the direction of the normal in
the normal section (0 at the root circle, 90 deg - alpha_n where the straight flank begins), lengths in modules:

    X = (E + rho sin b)/cos(beta),  Y = G - rho cos b,  s = X + Y sin b cos(beta)/cos b
    point = (X - s + i (Y + r)) exp(-i s/r)

on an axis i through the middle of the space. A protuberance ends with a corner where the rounding does: from there on
the corner draws the fillet: X and Y stay, s falls, or rises where that side of its path stands deeper in the tooth.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, ClassVar

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.tooth.teeth import SCALARS, GearFunctions, transverse
from gearlink.core.parts.gears.tooth.tools import RackTool

REACH = 5.0
"""Further than the corner of a protuberance turns [rad] until it is back in the space."""


@dataclass(frozen=True, kw_only=True)
class RackCutRoot:
    """The root of an external gear of module 1 as a rack tool leaves it.

    Parameters
        teeth : int - z >= 1
        shift : float [module] - generating profile shift x
        pressure_angle : float [rad] - alpha_n
        helix_angle : float [rad] - beta
    Returns
        Properties: lengths in modules.
    Notes
        The form radius was compared with a tool that is rolled along the gear, point by point; 1e-14 of the module
        where the tool does not undercut, else a bracketed root.
    Example
        >>> root = RackCutRoot(teeth=17, shift=0.11779, tool=RackTool(addendum=1.4, rounding=0.39),
        ...                    pressure_angle=math.radians(20.0), helix_angle=math.radians(15.8))
        >>> round(2.0 * 8.0 * root.form_radius, 9)
        132.248241272

    Source
        own derivation from the law of gearing; ISO/TR 6336-30 example 1 prints d_Ff = 132.248
    """

    teeth: int
    shift: float
    tool: RackTool
    pressure_angle: float = math.radians(20.0)
    helix_angle: float = 0.0

    fn: ClassVar[GearFunctions] = SCALARS

    @cached_property
    def _transverse(self) -> float:
        """alpha_t [rad]."""
        return transverse(self.pressure_angle, self.helix_angle, self.fn)

    @cached_property
    def _r(self) -> float:
        return self.teeth / 2.0 / self.fn.cos(self.helix_angle)

    @cached_property
    def base_radius(self) -> float:
        """r_b = r cos(alpha_t)."""
        return self._r * self.fn.cos(self._transverse)

    @cached_property
    def half_space_at_base(self) -> float:
        """Half the angle of the space on the base circle [rad], eta - inv(alpha_t)."""
        half_space = (math.pi / 2.0 - 2.0 * self.shift * self.fn.tan(self.pressure_angle)) / self.teeth
        return half_space - self.fn.involute(self._transverse)

    @cached_property
    def flank_start(self) -> float:
        """q = r sin(alpha_t) - h_Ff*/sin(alpha_t): from the base tangent point to where the straight flank's end
        touches; negative where the tool undercuts.
        """
        sine = self.fn.sin(self._transverse)
        end = self.tool.straight_end(self.pressure_angle, self.fn) - self.shift
        return self._r * sine - end / sine

    @property
    def undercut(self) -> bool:
        """Whether the tool cuts into the involute at its foot."""
        return self.flank_start < 0.0

    @property
    def last_normal(self) -> float:
        """Direction of the normal where the straight flank begins, 90 deg - alpha_n [rad]."""
        return math.pi / 2.0 - self.pressure_angle

    def fillet(self, normal: float) -> complex:
        """Point of the fillet at a direction b of the normal; the middle of the space is the imaginary axis.

        Beyond the last normal, by so much as the tool has rolled on [rad], a point of its corner's path.
        """
        left, above, rolled = self._drawn(normal)
        return (left + 1j * above) * self.fn.turn(-rolled)

    def _drawn(self, normal: float) -> tuple[float, float, float]:
        """Where the tool touches, right of the gear's axis and above it, while it has rolled by so much [rad]."""
        fn, tool, cosine = self.fn, self.tool, self.fn.cos(self.helix_angle)
        held = fn.least(normal, self.last_normal)
        x = (tool.rounding_center(self.pressure_angle, fn) + tool.rounding * fn.sin(held)) / cosine
        y = tool.rounding - tool.addendum + self.shift - tool.rounding * fn.cos(held)
        left = self.corner_path(-y * fn.tan(held) * cosine, y + self._r, normal - held)
        return left, y + self._r, (x - left) / self._r

    def corner_path(self, left: Any, above: Any, rolled: Any) -> Any:
        """How far right of the gear's axis the corner is when its path is farther out by so much roll [rad].

        The path is its own mirror image: of both ways out the one that stands deeper in the tooth.
        """
        fn, size = self.fn, abs(left) + rolled * self._r
        deeper = fn.where(fn.atan2(size, above) < size / self._r, -size, size)
        return fn.where(rolled > 0.0, deeper, left)

    def polar(self, normal: float) -> tuple[float, float]:
        """Radius of a point of the fillet, and its angle beside the middle of the space [rad]."""
        left, above, rolled = self._drawn(normal)
        return self.fn.hypot(left, above), self.fn.atan2(left, above) + rolled

    def _into_tooth(self, normal: float) -> float:
        """Angle by which the fillet stands inside the tooth of the involute, at its own radius [rad]."""
        radius, beside = self.polar(normal)
        roll = self.fn.sqrt(self.fn.greatest((radius / self.base_radius) ** 2 - 1.0, 0.0))
        return beside - self.half_space_at_base - self.fn.involute(self.fn.atan(roll))

    @cached_property
    def end_normal(self) -> float:
        """Where the fillet ends: the direction of the flank's normal, or the cut through the involute [rad]."""
        end = self.last_normal
        if not self.undercut and self.tool.residual_undercut == 0.0:
            return end
        if self.tool.residual_undercut > 0.0 and self._into_tooth(end) > 0.0:
            return bracketed_root(self._into_tooth, end, end + REACH)
        start = 0.0
        if abs(self.fillet(start)) < self.base_radius:
            if abs(self.fillet(end)) <= self.base_radius:
                return end
            start = bracketed_root(lambda b: abs(self.fillet(b)) - self.base_radius, start, end)
        if (self._into_tooth(start) > 0.0) == (self._into_tooth(end) > 0.0):
            return start  # to rounding: the fillet nowhere comes into the tooth
        return bracketed_root(self._into_tooth, start, end)

    @property
    def form_radius_uncut(self) -> float:
        """r_Ff of a tool without protuberance that does not undercut: sqrt(r_b^2 + q^2)."""
        return self.fn.hypot(self.base_radius, self.flank_start)

    @cached_property
    def form_radius(self) -> float:
        """r_Ff, where fillet and involute meet outermost; at least the base radius.

        Of a protuberance the minimum that it can leave: one that is higher than its rounding cuts away more.
        """
        if not self.undercut and self.tool.residual_undercut == 0.0:
            return self.form_radius_uncut
        return max(self.base_radius, abs(self.fillet(self.end_normal)))
