"""A gear on a rack, the limit of a pair whose wheel has ever more teeth: path of contact, root section, rating.

The mesh has the reference circle of the gear and the tool's own pressure angle.

The corner of the gear's tip may meet the root rounding of the rack outside the path of contact.

In the frame of the rack, x from the middle of a space towards the flank in contact, D below the datum line, the gear
turned by psi from where its corner stands deepest:

    D = r_a cos(psi) - r - x m,  x = w(D_E) - (r_a sin(psi) - r psi) + (r_a sin(psi_E) - r psi_E)

w is half the width of the space at its flanks, E the end of contact, psi_E = alpha_t - alpha_a. The gear's own fillet
needs no such look: the rack's tips lie inside the tool that cut it wherever contact ends on the flank.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, Rule, Status
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.parts.gears.checks import (
    FILLET_NOISE,
    GEAR_QUANTITIES,
    contact_check,
    gear_check,
    gear_quantity,
    most_sliding,
    tip_check,
    tip_measure,
)
from gearlink.core.parts.gears.codes import AT_LIMITS, FILLET, INTERFERENCE, SLIDING
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing_checks import backlash_check, drawing_check, rack_limits
from gearlink.core.parts.gears.drawing_names import RATING
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.mesh.tip_corner import CornerGap, least_gap, near_of, places_towards
from gearlink.core.parts.gears.rating.root_stress import RootSection, RootStress
from gearlink.core.parts.gears.tooth.tools import rack_tip_width

if TYPE_CHECKING:
    from gearlink.core.parts.gears.outline.rack_profile import RackProfile


_MATE = 10_000
_OF_GEAR = frozenset(
    (
        "profile_shift", "reference_radius", "base_radius", "working_radius", "tip_radius", "root_radius",
        "tooth_thickness", "tip_pressure_angle", "tip_thickness", "min_shift_no_undercut", "min_teeth_no_undercut",
        "span_measurement", "span_teeth", "form_radius", "pin_diameter", "measure_over_balls", "measure_over_pins",
        "chordal_thickness", "chordal_height", "generating_shift", "span_measurement_limits", "measure_limits",
    )
)  # fmt: skip
"""Quantities that the gear has by itself."""
_OF_MESH = frozenset(
    (
        "transverse_pressure_angle", "base_helix_angle", "overlap_ratio", "total_contact_ratio", "path_of_contact",
        "sliding_factor", *RATING,
    )
)  # fmt: skip
"""Quantities of the path of contact and of the rating, as a pair's."""
_OWN = frozenset(
    (
        "center_distance", "working_pressure_angle", "contact_ratio", "used_root_radius", "specific_sliding",
        "specific_sliding_tip", "tip_clearance", "backlash_circumferential", "backlash_normal", "backlash_angle",
    )
)  # fmt: skip
"""Quantities that stand here under their own names."""
_OF_TOOTH = ("undercut", "tip-thickness", "tooth-form", "root-clearance")
_OF_PAIR = ("inspection", "pitting", "bending")


def beside_a_rack(pair: dict[str, Any], first: float) -> GearPair:
    """The gear of a rack as a pair at its reference centre distance with a large mate: only gear 1 is used."""
    mate = {"teeth": (pair["teeth"][0], _MATE), "given_shift": (first, -first), "given_distance": None}
    return GearPair(**(pair | mate))


@dataclass(frozen=True)
class RackMesh:
    """A gear on a rack of the same reference profile.

    eps_alpha = (rho_E1 - r_1 sin(alpha_t) + (h_aR - x_1) m/sin(alpha_t))/p_et,  a = r_1 + x_1 m

    Parameters
        data : RackData - its gear 1 is the gear
    Returns
        Properties: lengths in mm, angles in rad.
    Notes
        The limit of an external pair whose wheel has ever more teeth: held by the tests.
    Example
        >>> rack = RackMesh(RackData(pair=GearPair.from_shift(2.0, (20, 10_000))))
        >>> round(rack.contact_ratio, 6), rack.center_distance
        (1.768824, 20.0)

    Source
        ISO 21771
    """

    data: RackData

    @property
    def path(self) -> RackPath:
        """The path of contact."""
        return self.data.path

    @property
    def pair(self) -> GearPair:
        """The pair whose gear 1 it is."""
        return self.data.pair

    @cached_property
    def profile(self) -> RackProfile:
        """The teeth of the rack.

        Raises
            NoSolution - for a rack that no tool leaves
        """
        from gearlink.core.parts.gears.outline.rack_profile import RackProfile

        pair = self.pair
        return RackProfile(
            module=pair.module,
            tool=pair.tool(1),
            pressure_angle=pair.pressure_angle,
            helix_angle=pair.helix_angle,
            height=self.path.height,
        )

    @property
    def center_distance(self) -> float:
        """a = r_1 + x_1 m, from the axis to the datum line."""
        return self.pair.reference_radius[0] + self.pair.profile_shift[0] * self.pair.module

    @property
    def working_pressure_angle(self) -> float:
        """alpha_wt = alpha_t."""
        return self.pair.transverse_pressure_angle

    @property
    def contact_ratio(self) -> float:
        """eps_alpha."""
        return self.path.contact_ratio

    @property
    def used_root_radius(self) -> tuple[float, None]:
        """r_Nf of the gear."""
        return math.hypot(self.pair.base_radius[0], self.path.start), None

    @property
    def specific_sliding(self) -> tuple[float, None] | None:
        """zeta_A1 = 1 - rho_C1/rho_A1."""
        return (1.0 - self.path.pitch / self.path.start, None) if self.path.start > 0.0 else None

    @property
    def specific_sliding_tip(self) -> tuple[float, None]:
        """zeta_E1 = 1 - rho_C1/rho_E1."""
        return 1.0 - self.path.pitch / self.path.end, None

    @property
    def tip_clearance(self) -> tuple[float, None]:
        """c_1, from the gear's tip to the root of the rack."""
        return self.center_distance + self.pair.root_depth(1) * self.pair.module - self.pair.tip_radius[0], None

    @property
    def pitch_on_line(self) -> float:
        """p_t = pi m/cos(beta) [mm]."""
        return math.pi * self.pair.module / math.cos(self.pair.helix_angle)

    @property
    def end_depth(self) -> float:
        """How far below its datum line the rack is touched at E [mm]."""
        below = (self.path.end - self.path.pitch) * math.sin(self.pair.transverse_pressure_angle)
        return below - self.pair.profile_shift[0] * self.pair.module

    @property
    def form_depth(self) -> float:
        """How far below its datum line the straight flank of the rack reaches [mm]."""
        return self.pair.tool(1).straight_end(self.pair.pressure_angle) * self.pair.module

    @property
    def tip_width(self) -> float:
        """s_aR, width of the rack's tips in the normal section [mm]."""
        return rack_tip_width(self.path.height, self.pair.pressure_angle) * self.pair.module

    @cached_property
    def backlash_circumferential(self) -> Pair | None:
        """j_wt on the reference circle, minimum and maximum [mm]: -(E_1 + E_2)/cos(beta) +- 2 A_a tan(alpha_t).

        Notes
            Exact: the flank of a rack has the same direction everywhere.
        """
        allowances, distance = self.data.allowances, self.data.distance_allowance
        if allowances is None and distance is None:
            return None
        open_ = 2.0 * (distance or 0.0) * math.tan(self.pair.transverse_pressure_angle)
        (upper1, lower1), (upper2, lower2) = allowances or ((0.0, 0.0), (0.0, 0.0))
        cosine = math.cos(self.pair.helix_angle)
        return -(upper1 + upper2) / cosine - open_, -(lower1 + lower2) / cosine + open_

    @property
    def backlash_normal(self) -> Pair | None:
        """j_bn, minimum and maximum [mm]: j_wt cos(alpha_t) cos(beta_b)."""
        found = self.backlash_circumferential
        turned = math.cos(self.pair.transverse_pressure_angle) * math.cos(self.pair.base_helix_angle)
        return None if found is None else (found[0] * turned, found[1] * turned)

    @property
    def backlash_angle(self) -> tuple[Pair, None] | None:
        """Free turn of the gear while the rack stands, minimum and maximum [rad]."""
        found, r = self.backlash_circumferential, self.pair.reference_radius[0]
        return None if found is None else ((found[0] / r, found[1] / r), None)

    def height_over_pin(self, diameter: float, allowance: float = 0.0) -> float:
        """From the datum line to the top of a pin in a space [mm]: D/2 (1 + 1/sin(alpha_n)) - e/(2 tan(alpha_n)).

        Parameters
            diameter : float [mm] - D
            allowance : float [mm] - E_sn of the rack; its space on the datum line is e = pi m/2 - E_sn
        """
        alpha, space = self.pair.pressure_angle, 0.5 * math.pi * self.pair.module - allowance
        return 0.5 * diameter * (1.0 + 1.0 / math.sin(alpha)) - 0.5 * space / math.tan(alpha)

    def quantity(self, name: str) -> Any:
        """A quantity by name; values of the rack are None."""
        if name in _OF_GEAR:
            found = gear_quantity(self.pair, name) if name in GEAR_QUANTITIES else self.data.quantity(name)
            return None if found is None or found[0] is None else (found[0], None)
        if name in _OF_MESH:
            return self.data.quantity(name)
        return getattr(self, name) if name in _OWN else None

    def checks(self, name: str, limits: Any) -> Iterator[Check]:
        """The findings of a check on gear and rack."""
        if name in _OF_TOOTH:
            found = list(gear_check(name, self.pair, limits, shifts=True))
            yield from (each for each in found if "gear 1" in each.what + each.advice)
        if name in _CHECKS:
            yield from _CHECKS[name](self, limits)
        if name in _OF_PAIR:
            yield from drawing_check(name, self.data, limits)
        if name in AT_LIMITS:
            yield from rack_limits(name, self, limits)


def _contact_ratio(rack: RackMesh, limits: Any) -> Iterator[Check]:
    total = rack.path.total_contact_ratio
    eps = total if rack.pair.helix_angle and total else rack.contact_ratio
    yield contact_check(eps, limits, "contact ratio", "use more teeth or less profile shift")


def _interference(rack: RackMesh, _limits: Any) -> Iterator[Check]:
    point = "the base tangent point of gear 1"
    words = f"distance of the rack's tip from {point}", f"rack's tip beyond {point}"
    yield _judged(INTERFERENCE, words, rack.path.start, 0.0)


def _fillet(rack: RackMesh, _limits: Any) -> Iterator[Check]:
    noise = -FILLET_NOISE * rack.pair.module
    if rack.pair.form_radius[0] is not None:
        margin = rack.used_root_radius[0] - rack.pair.form_radius[0] if rack.path.start > 0.0 else rack.path.start
        yield _judged(FILLET, _contact("the root fillet of gear 1"), margin, noise)
    margin = rack.form_depth - rack.end_depth
    if margin >= noise and (corner := _corner_in_rack(rack, noise)):
        what = "cut of the tip corner of gear 1 into the root rounding of the rack"
        at = f"{short(corner.place)} mm below the datum line"
        yield _judged(FILLET, (what, what), corner.gap, noise, "shorten the tips of gear 1", at)
        return
    fix = "reduce the profile shift or the addendum of gear 1"
    yield _judged(FILLET, _contact("the root rounding of the rack"), margin, noise, fix)


def _corner_in_rack(rack: RackMesh, noise: float) -> CornerGap | None:
    """The cut of the gear's tip corner into the rounding of the rack; None where there is none."""
    corner = CornerInRack(rack.pair, rack.center_distance, rack.end_depth)
    near = corner.deepest > rack.form_depth and rack.pair.tool(1).rounding_center(rack.pair.pressure_angle) >= 0.0
    return corner.least if near and corner.least.gap < noise else None


def _contact(where: str) -> tuple[str, str]:
    return f"clearance of the contact from {where}", f"contact within {where}"


def _tip(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = tip_measure(rack.tip_width, rack.pair.module, limits)
    yield tip_check(found, "tip width of the rack over the module", "the teeth of the rack", "reduce the addendum")


def _sliding(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = rack.specific_sliding
    limit = most_sliding(limits)
    if found is None or (limits.sliding is None and abs(found[0]) <= limit):
        return
    status: Status = "warn" if abs(found[0]) > limit else "pass"
    fix = "increase its profile shift or use more teeth"
    yield SLIDING.check(status, "specific sliding at the root of gear 1", abs(found[0]), limit, fix=fix)


def _backlash(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = rack.backlash_normal
    if found is None:
        return
    yield backlash_check(*found, limits.backlash, rack.pair.module, "gear and rack cannot be assembled")


_CHECKS: dict[str, Callable[[RackMesh, Any], Iterator[Check]]] = {
    "contact-ratio": _contact_ratio,
    "involute-interference": _interference,
    "fillet-interference": _fillet,
    "tip-thickness": _tip,
    "sliding": _sliding,
    "backlash": _backlash,
}


def _judged(
    rule: Rule,
    what: tuple[str, str],
    margin: float,
    limit: float,
    fix: str = "increase the profile shift of gear 1 or use more teeth",
    at: str = "",
) -> Check:
    """A finding that fails below its limit; `what` is kept, and what goes beyond where the margin is negative."""
    status: Status = "fail" if margin < limit else "pass"
    return rule.check(status, what[0], margin, limit, "mm", overlap=what[1], at=at, fix=fix)


@dataclass(frozen=True)
class CornerInRack:
    """The corner of a gear's tip beside the root rounding of its rack.

    Parameters
        pair : GearPair - gear 1 is the gear, the tool of gear 2 the rack's; contact ends on the flank of the
            rack, whose tool is not pointed
        center_distance : float [mm] - from the axis to the datum line
        end_depth : float [mm] - how far below the datum line contact ends
    Notes
        The limit of a wheel with ever more teeth; compared with drawn teeth that are turned in mesh.
    Source
        own derivation: the corner's path while the reference circle rolls on the pitch line
    """

    pair: GearPair
    center_distance: float
    end_depth: float

    @cached_property
    def _gap(self) -> Callable[[float], float]:
        pair = self.pair
        m, across, tip, r = (
            pair.module,
            pair.module / math.cos(pair.helix_angle),
            pair.tip_radius[0],
            pair.reference_radius[0],
        )
        at_end = pair.transverse_pressure_angle - pair.tip_pressure_angle[0]
        depth = self.end_depth / m
        start = across * (math.pi / 4.0 - depth * math.tan(pair.pressure_angle)) + tip * math.sin(at_end) - r * at_end

        def gap(normal: float) -> float:
            """Along the rack, from the corner to the rounding in a direction of its normal [mm]."""
            beside, below = self._rounding(normal)
            left = (self.deepest - m * below) / (2.0 * tip)
            if left < 0.0:
                return math.inf
            psi = math.copysign(2.0, at_end) * math.asin(math.sqrt(left))
            return across * beside - start + tip * math.sin(psi) - r * psi

        return gap

    @property
    def deepest(self) -> float:
        """How far below the datum line the tip comes, r_a - r - x m [mm]."""
        return self.pair.tip_radius[0] - self.center_distance

    def _rounding(self, normal: float) -> tuple[float, float]:
        """Place of the rounding beside the middle of the space and below the datum line, in the normal section [m]."""
        angle, tool = self.pair.pressure_angle, self.pair.tool(1)
        beside = tool.rounding_center(angle) + tool.rounding * math.sin(normal)
        return beside, tool.addendum - tool.rounding * (1.0 - math.cos(normal))

    @cached_property
    def least(self) -> CornerGap:
        """The minimum gap along the rack, and how far below the datum line [mm]."""
        module, end = self.pair.module, math.pi / 2.0 - self.pair.pressure_angle
        gap, place = least_gap(self._gap, places_towards(0.0, end), near_of(module))
        return CornerGap(gap, module * self._rounding(place)[1])


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
        across = math.pi - 2.0 * self.tool.rounding_center(self.pair.pressure_angle)
        return across - 2.0 * math.sin(self.theta) * self.tool.rounding

    @cached_property
    def fillet_radius(self) -> float:
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
        return self.pair.pressure_angle

    @cached_property
    def moment_arm(self) -> float:
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
        return RackRoots(**self._of_roots)

    def called(self, gear: int) -> str:
        """What findings call gear 1 and the rack."""
        return "the rack" if gear else "gear 1"

    @property
    def measured(self) -> tuple[int, ...]:
        """The gear alone: a ball in a rack is what `RackMesh.height_over_pin` takes."""
        return (0,)

    def rated_with(self, gear: int) -> str:
        if gear == 0:
            return super().rated_with(gear)
        return "give its tool a rounding and a pressure angle of at most 30 deg"
