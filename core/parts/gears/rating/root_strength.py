"""Tooth root strength by ISO 6336-3, method B, on the virtual spur gear; the tangent of the fillet is exact.

The section of an external tooth stands where a tangent of 30 deg touches the fillet, that of a ring at 60 deg. The
standard's auxiliary angle theta is the direction of the tool's normal there, so it is found as a bracketed root.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.tools import RackTool

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.contact import PathOfContact


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
        given_fillet_radius : float or None [module] - of a ring, the one that its cutter leaves; None: the tool's
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
    given_fillet_radius: float | None = None

    @property
    def _ring(self) -> bool:
        return self.pair.teeth[self.gear] < 0

    @cached_property
    def virtual_teeth(self) -> float:
        """z_n = z/(cos^2(beta_b) cos(beta)), negative for a ring."""
        pair, fn = self.pair, self.pair.fn
        return pair.teeth[self.gear] / (fn.cos(pair.base_helix_angle) ** 2 * fn.cos(pair.helix_angle))

    @cached_property
    def virtual_contact_ratio(self) -> float:
        """eps_alpha,n = eps_alpha/cos^2(beta_b)."""
        eps = self.pair.contact_ratio if self.contact_ratio is None else self.contact_ratio
        return eps / self.pair.fn.cos(self.pair.base_helix_angle) ** 2

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
        slope, h = self._tangent_line
        try:
            return bracketed_root(lambda b: b - slope * math.tan(b) + h, 0.0, math.pi / 2.0 - self.pair.pressure_angle)
        except NoSolution:
            degrees = "60" if self._ring else "30"
            raise NoSolution(f"no tangent of {degrees} deg touches the root fillet of gear {self.gear + 1}") from None

    @property
    def _tangent_line(self) -> tuple[float, float]:
        """2 G/z_n and H of the equation of theta."""
        z, center = self.virtual_teeth, self.tool.rounding_center(self.pair.pressure_angle, self.pair.fn)
        return 2.0 * self._depth / z, 2.0 / z * (math.pi / 2.0 - center) - self._tangent

    @property
    def _out(self) -> float:
        """G/cos(theta) - rho*."""
        return self._depth / self.pair.fn.cos(self.theta) - self.tool.rounding

    @cached_property
    def chord(self) -> float:
        """s_Fn*, thickness of the root section."""
        factor = 1.0 if self._ring else math.sqrt(3.0)
        return self.virtual_teeth * self.pair.fn.sin(self._tangent - self.theta) + factor * self._out

    @cached_property
    def fillet_radius(self) -> float:
        """rho_F*, radius of the fillet at the tangent."""
        return self._radius(self.virtual_teeth) if self.given_fillet_radius is None else self.given_fillet_radius

    def _radius(self, virtual_teeth: float) -> float:
        g, cosine = self._depth, self.pair.fn.cos(self.theta)
        return self.tool.rounding + 2.0 * g * g / (cosine * (virtual_teeth * cosine * cosine - 2.0 * g))

    @property
    def standard_fillet_radius(self) -> float:
        """rho_F* of a ring by ISO 6336-3:2006 and 2007, with |z_n|: a hollow root is not as flat as that of a gear."""
        return self._radius(abs(self.virtual_teeth))

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
        z, fn, sign = self.virtual_teeth, self.pair.fn, self.pair.signs[self.gear]
        cosine, tip = fn.cos(self.pair.pressure_angle), self.tip_radius
        base = 0.5 * z * cosine
        roll = sign * fn.sqrt(fn.greatest(0.0, (tip - base) * (tip + base)))
        at = roll - math.pi * cosine * (self.virtual_contact_ratio - 1.0)
        return sign * fn.hypot(at, base)

    @cached_property
    def load_angle(self) -> float:
        """alpha_Fen, between the load and the normal of the tooth's middle: alpha_en - gamma."""
        z, alpha, fn = self.virtual_teeth, self.pair.pressure_angle, self.pair.fn
        base = 0.5 * z * fn.cos(alpha)
        at = fn.acos(fn.least(1.0, base / self.load_radius))
        gamma = (0.5 * math.pi + 2.0 * self.shift * fn.tan(alpha)) / z + fn.involute(alpha) - fn.involute(at)
        return at - gamma

    @cached_property
    def moment_arm(self) -> float:
        """h_Fe*, from the root section to where the load crosses the middle of the tooth."""
        z, fn, factor = self.virtual_teeth, self.pair.fn, math.sqrt(3.0) if self._ring else 1.0
        crossing = z * fn.cos(self.pair.pressure_angle) / fn.cos(self.load_angle)
        return 0.5 * (crossing - z * fn.cos(self._tangent - self.theta) - factor * self._out)

    @cached_property
    def form_factor(self) -> float:
        """Y_F = 6 h_Fe* cos(alpha_Fen)/(s_Fn*^2 cos(alpha_n))."""
        lever = 6.0 * self.moment_arm * self.pair.fn.cos(self.load_angle)
        return lever / (self.chord**2 * self.pair.fn.cos(self.pair.pressure_angle))

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
        return float(self._stress_correction)

    @property
    def _stress_correction(self) -> Any:
        slender = self.chord / self.moment_arm
        return (1.2 + 0.13 * slender) * self.notch ** (1.0 / (1.21 + 2.3 / slender))
