"""A gear on a rack as the limit of a pair whose wheel has ever more teeth: path of contact, root section, rating."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.root_strength import RootSection
from gearlink.core.parts.gears.rating.root_stress import RootStress

_FLATTEST = math.pi / 6.0
"""Pressure angle above which a tangent of 30 deg would touch the flank of a rack, not its fillet."""


@dataclass(frozen=True)
class RackPath(PathOfContact):
    """Where the flanks of a gear and a rack touch: T and u are infinite, the rack's flank is straight.

    rho_C1 = r_1 sin(alpha_t),  rho_A1 = rho_C1 - (h_aR - x_1) m/sin(alpha_t),  eps_alpha = (rho_E1 - rho_A1)/p_et

    Parameters
        pair : GearPair - its gear 1 is the gear
        face_width : float or None [mm]
    Notes
        What a pair says of radii of its gear 2 a rack does not have.
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> path = RackPath(GearPair.from_shift(2.0, (20, 10_000)))
        >>> round(path.contact_ratio, 6), round(path.curvature(path.pitch) * path.pitch, 12)
        (1.768824, 1.0)

    Source
        ISO 21771
    """

    @property
    def height(self) -> float:
        """h_aR [module], of the rack's tips above its datum line: h_a* + k_2."""
        return self.pair.addendum + self.pair.tip_alteration[1]

    @cached_property
    def line(self) -> float:
        """T, without end."""
        return math.inf

    @property
    def gear_ratio(self) -> float:
        """u, without end."""
        return math.inf

    @cached_property
    def pitch(self) -> float:
        """rho_C1 = r_1 sin(alpha_t)."""
        return self.pair.reference_radius[0] * math.sin(self.pair.transverse_pressure_angle)

    @cached_property
    def start(self) -> float:
        """rho_A1, at the tip of the rack."""
        height = (self.height - self.pair.profile_shift[0]) * self.pair.module
        return self.pitch - height / math.sin(self.pair.transverse_pressure_angle)

    @cached_property
    def length(self) -> float:
        """g_alpha = rho_E1 - rho_A1."""
        return self.end - self.start

    @property
    def contact_ratio(self) -> float:
        """eps_alpha = g_alpha/p_et."""
        return self.length / self.pair.base_pitch

    def sliding(self, rho: float) -> Pair:
        """zeta_1 = 1 - rho_C1/rho_1 and zeta_2 = 1 - rho_1/rho_C1; infinite on the base circle."""
        return 1.0 - self.pitch / rho if rho else -math.inf, 1.0 - rho / self.pitch


@dataclass(frozen=True, kw_only=True)
class RackSection(RootSection):
    """The root section of a rack: its fillet is the tool's own rounding, touched at 30 deg, its flank is straight.

    s_Fn* = pi - 2 E - sqrt(3) rho*,  rho_F* = rho*,  alpha_Fen = alpha_n
    h_Fe* = y_e - (s_e/2) tan(alpha_n) - (x_E - h_fP* + rho*/2),  s_e = pi/2 - 2 (y_e - x_E) tan(alpha_n)

    Parameters
        contact_radius : float or None [module] - instead of a radius the height y_e above the datum line where the
            load acts; None: h_aR - pi sin(alpha_n) cos(alpha_n) (eps_alpha,n - 1), the outer point of single contact
    Notes
        The limit z_n -> infinity of `RootSection`; of an external gear with 1e7 teeth it keeps 6 digits.
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> from gearlink.core.parts.gears.tooth.tools import RackTool
        >>> pair = GearPair(module=2.0, teeth=(20, 10_000), given_shift=(0.0, 0.0))
        >>> root = RackSection(pair=pair, gear=1, tool=RackTool(rounding=0.38), shift=0.0, contact_ratio=1.768824)
        >>> round(root.chord, 6), round(root.moment_arm, 6), round(root.form_factor, 6)
        (2.3547, 1.027504, 1.111894)

    Source
        own derivation, from ISO 6336-3:2006
    """

    @cached_property
    def virtual_teeth(self) -> float:
        """z_n, without end."""
        return math.inf

    @cached_property
    def theta(self) -> float:
        """Direction of the tool's normal at the tangent: 60 deg.

        Raises
            NoSolution - where the rounding ends before
        """
        if self.pair.pressure_angle > _FLATTEST:
            raise NoSolution("no tangent of 30 deg touches the root fillet of the rack")
        return math.pi / 3.0

    @cached_property
    def chord(self) -> float:
        """s_Fn*."""
        across = math.pi - 2.0 * self.tool.rounding_center(self.pair.pressure_angle)
        return across - 2.0 * math.sin(self.theta) * self.tool.rounding

    @cached_property
    def fillet_radius(self) -> float:
        """rho_F*."""
        return self.tool.rounding

    @property
    def tip_radius(self) -> float:
        """h_aR*, height of the tips above the datum line."""
        return self.pair.addendum + self.pair.tip_alteration[1]

    @cached_property
    def load_radius(self) -> float:
        """y_e*, height above the datum line where the load acts."""
        if self.contact_radius is not None:
            return self.contact_radius
        alpha = self.pair.pressure_angle
        return self.tip_radius - math.pi * math.sin(alpha) * math.cos(alpha) * (self.virtual_contact_ratio - 1.0)

    def loaded_at(self, path: PathOfContact, rho: float) -> RootSection:
        """The same section, loaded at a place on the path of contact: y = x_1 + (rho_C1 - rho_1) sin(alpha_t)/m."""
        above = (path.pitch - rho) * math.sin(self.pair.transverse_pressure_angle) / self.pair.module
        return self.loaded(self.pair.profile_shift[0] + above)

    @cached_property
    def load_angle(self) -> float:
        """alpha_Fen."""
        return self.pair.pressure_angle

    @cached_property
    def moment_arm(self) -> float:
        """h_Fe*."""
        slope, height = math.tan(self.pair.pressure_angle), self.load_radius
        half = math.pi / 4.0 - (height - self.shift) * slope
        section = self.shift - self.tool.addendum + math.cos(self.theta) * self.tool.rounding
        return height - half * slope - section


@dataclass(frozen=True, kw_only=True)
class RackRoots(RootStress):
    """Root stresses of a gear and its rack."""

    def _made(self, gear: int) -> RootSection:
        if gear == 0:
            return super()._made(gear)
        pair, eps = self.path.pair, self.path.contact_ratio
        return RackSection(pair=pair, gear=gear, tool=self.tools[gear], shift=self.shifts[gear], contact_ratio=eps)


@dataclass(frozen=True, kw_only=True)
class RackData(GearData):
    """A gear on a rack with all that its drawing needs; the pair's gear 1 is the gear, gear 2 stands for the rack.

    Notes
        The back of the rack takes the rim factor Y_B of an external gear.
    """

    @cached_property
    def path(self) -> RackPath:
        """The path of contact, with the lesser width."""
        return RackPath(self.pair, self._common_width)

    @property
    def cut_shift(self) -> Pair:
        """x_E of the upper allowances [module]; a rack has no nominal shift."""
        if self.allowances is None:
            return self.pair.profile_shift[0], 0.0
        thinner = self.allowances[1][0] / (2.0 * self.pair.module * math.tan(self.pair.pressure_angle))
        return self._generated(0)[1], thinner

    @cached_property
    def root(self) -> RackRoots:
        """Root strength, at the upper allowances."""
        return RackRoots(**self._of_roots)

    def called(self, gear: int) -> str:
        """What findings call gear 1 and the rack."""
        return "the rack" if gear else "gear 1"

    @property
    def measured(self) -> tuple[int, ...]:
        """The gear alone: a ball in a rack is what `RackMesh.height_over_pin` takes."""
        return (0,)

    def rated_with(self, gear: int) -> str:
        """What a root needs so that it can be rated."""
        if gear == 0:
            return super().rated_with(gear)
        return "give its tool a rounding and a pressure angle of at most 30 deg"
