"""Tooth root strength by ISO 6336-3, method B, on the virtual spur gear; the tangent of the fillet is exact.

The section of an external tooth stands where a tangent of 30 deg touches the fillet, that of a ring at 60 deg. The
standard's auxiliary angle theta is the direction of the tool's normal there, so it is found as a bracketed root.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from gearlink.core.errors import NoSolution
from gearlink.core.gears.involute import involute
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.tools import RackTool
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.gears.contact import PathOfContact


@dataclass(frozen=True, kw_only=True)
class RootSection:
    """The root section of one gear of a pair, in normal modules of its virtual spur gear.

    Parameters
        pair : GearPair
        gear : int - 0 or 1
        tool : RackTool - the one that cuts it; of a ring its substitute
        shift : float [module] - generating profile shift x_E
        contact_radius : float or None [module] - radius on the virtual gear where the load acts, signed; None: the
            outer point of single contact (method B)
        contact_ratio : float or None - eps_alpha of the mesh; None: the pair's
    Returns
        Properties: lengths in modules, angles in rad.
    Raises
        NoSolution - where the tool leaves no such tangent
    Notes
        theta, the section and rho_F were compared with the tangent of the generated fillet by differentiation: 1e-23
        at forty digits over 520 gears.
    Example
        >>> pair = GearPair(module=3.0, teeth=(17, 40), given_shift=(0.4, 0.2))
        >>> hob = RackTool(addendum=1.25, rounding=0.25)
        >>> root = RootSection(pair=pair, gear=0, tool=hob, shift=0.4)
        >>> round(root.form_factor, 9), round(root.stress_correction_factor, 9)
        (1.46980356, 2.234815374)

    Source
        ISO 6336-3:2006, as public code and worked examples quote it; the form of the equations is an own derivation
    """

    pair: GearPair
    gear: int
    tool: RackTool
    shift: float
    contact_radius: float | None = None
    contact_ratio: float | None = None

    @property
    def _ring(self) -> bool:
        return self.pair.teeth[self.gear] < 0

    @cached_property
    def virtual_teeth(self) -> float:
        """z_n = z/(cos^2(beta_b) cos(beta)), negative for a ring."""
        pair = self.pair
        return pair.teeth[self.gear] / (math.cos(pair.base_helix_angle) ** 2 * math.cos(pair.helix_angle))

    @cached_property
    def virtual_contact_ratio(self) -> float:
        """eps_alpha,n = eps_alpha/cos^2(beta_b)."""
        eps = self.pair.contact_ratio if self.contact_ratio is None else self.contact_ratio
        return eps / math.cos(self.pair.base_helix_angle) ** 2

    @property
    def _depth(self) -> float:
        """G = rho* - h_fP* + x_E."""
        return self.tool.rounding - self.tool.addendum + self.shift

    @property
    def _tangent(self) -> float:
        return math.pi / 6.0 if self._ring else math.pi / 3.0

    @cached_property
    def theta(self) -> float:
        """Direction of the tool's normal at the tangent: theta = 2 G/z_n tan(theta) - H.

        Raises
            NoSolution - where no tangent of this direction touches the fillet
        """
        z, alpha = self.virtual_teeth, self.pair.pressure_angle
        h = 2.0 / z * (math.pi / 2.0 - self.tool.rounding_center(alpha)) - self._tangent
        slope = 2.0 * self._depth / z
        try:
            return bracketed_root(lambda b: b - slope * math.tan(b) + h, 0.0, math.pi / 2.0 - alpha)
        except NoSolution:
            degrees = "60" if self._ring else "30"
            raise NoSolution(f"no tangent of {degrees} deg touches the root fillet of gear {self.gear + 1}") from None

    @property
    def _out(self) -> float:
        """G/cos(theta) - rho*."""
        return self._depth / math.cos(self.theta) - self.tool.rounding

    @cached_property
    def chord(self) -> float:
        """s_Fn*, thickness of the root section."""
        factor = 1.0 if self._ring else math.sqrt(3.0)
        return self.virtual_teeth * math.sin(self._tangent - self.theta) + factor * self._out

    @cached_property
    def fillet_radius(self) -> float:
        """rho_F*, radius of the fillet at the tangent."""
        g, cosine = self._depth, math.cos(self.theta)
        return self.tool.rounding + 2.0 * g * g / (cosine * (self.virtual_teeth * cosine * cosine - 2.0 * g))

    @property
    def tip_radius(self) -> float:
        """d_an*/2 of the virtual gear; signed."""
        height = (self.pair.tip_radius[self.gear] - self.pair.reference_radius[self.gear]) / self.pair.module
        return 0.5 * self.virtual_teeth + height

    @cached_property
    def loaded_at_tip(self) -> RootSection:
        """The same section with its load at the tip, for Y_Fa and Y_Sa of method C."""
        return self.loaded(self.tip_radius)

    def loaded(self, radius: float) -> RootSection:
        """The same section with its load elsewhere on the flank, by contact_radius [module]."""
        return replace(self, contact_radius=radius)

    def loaded_at(self, path: PathOfContact, rho: float) -> RootSection:
        """The same section, loaded at a place rho_1 [mm] on the path of contact."""
        pair, gear = self.pair, self.gear
        own = rho if gear == 0 else path.line - rho
        radius = pair.signs[gear] * math.hypot(pair.base_radius[gear], own)
        return self.loaded(0.5 * self.virtual_teeth + (radius - pair.reference_radius[gear]) / pair.module)

    @cached_property
    def load_radius(self) -> float:
        """d_en*/2, where the load acts on the virtual gear; signed."""
        if self.contact_radius is not None:
            return self.contact_radius
        z, alpha, sign = self.virtual_teeth, self.pair.pressure_angle, self.pair.signs[self.gear]
        base = 0.5 * z * math.cos(alpha)
        tip = self.tip_radius
        roll = sign * math.sqrt(max(0.0, (tip - base) * (tip + base)))
        at = roll - math.pi * math.cos(alpha) * (self.virtual_contact_ratio - 1.0)
        return sign * math.hypot(at, base)

    @cached_property
    def load_angle(self) -> float:
        """alpha_Fen, between the load and the normal of the tooth's middle: alpha_en - gamma."""
        z, alpha = self.virtual_teeth, self.pair.pressure_angle
        base = 0.5 * z * math.cos(alpha)
        at = math.acos(min(1.0, base / self.load_radius))
        gamma = (0.5 * math.pi + 2.0 * self.shift * math.tan(alpha)) / z + involute(alpha) - involute(at)
        return at - gamma

    @cached_property
    def moment_arm(self) -> float:
        """h_Fe*, from the root section to where the load crosses the middle of the tooth."""
        z, factor = self.virtual_teeth, math.sqrt(3.0) if self._ring else 1.0
        crossing = z * math.cos(self.pair.pressure_angle) / math.cos(self.load_angle)
        return 0.5 * (crossing - z * math.cos(self._tangent - self.theta) - factor * self._out)

    @cached_property
    def form_factor(self) -> float:
        """Y_F = 6 h_Fe* cos(alpha_Fen)/(s_Fn*^2 cos(alpha_n))."""
        lever = 6.0 * self.moment_arm * math.cos(self.load_angle)
        return lever / (self.chord**2 * math.cos(self.pair.pressure_angle))

    @cached_property
    def notch(self) -> float:
        """q_s = s_Fn/(2 rho_F); the standard covers 1 to 8."""
        return self.chord / (2.0 * self.fillet_radius)

    @cached_property
    def stress_correction_factor(self) -> float:
        """Y_S = (1.2 + 0.13 L) q_s^(1/(1.21 + 2.3/L)), L = s_Fn/h_Fe.

        Raises
            NoSolution - where fillet radius, section or lever is not positive
        """
        if min(self.fillet_radius, self.chord, self.moment_arm) <= 0.0:
            raise NoSolution(
                f"the root fillet of gear {self.gear + 1} has no radius that a stress could be formed with"
            )
        slender = self.chord / self.moment_arm
        return float((1.2 + 0.13 * slender) * self.notch ** (1.0 / (1.21 + 2.3 / slender)))
