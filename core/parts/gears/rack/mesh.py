"""A gear on a rack: the mesh has the reference circle of the gear and the tool's own pressure angle."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Check, Rule, Status
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.parts.gears.checks import (
    FILLET_NOISE,
    GEAR_QUANTITIES,
    Measured,
    contact_check,
    gear_check,
    gear_quantity,
    most_sliding,
    tip_check,
)
from gearlink.core.parts.gears.codes import AT_LIMITS, FILLET, INTERFERENCE, SLIDING
from gearlink.core.parts.gears.drawing_checks import backlash_check, drawing_check
from gearlink.core.parts.gears.drawing_names import RATING
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rack.rating import RackData, RackPath
from gearlink.core.parts.gears.tooth.tools import rack_tip_width

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.tip_corner import CornerGap
    from gearlink.core.parts.gears.rack.profile import RackProfile

_MATE = 10_000
_OF_GEAR = frozenset(
    (
        "profile_shift", "reference_radius", "base_radius", "working_radius", "tip_radius", "root_radius",
        "tooth_thickness", "tip_pressure_angle", "tip_thickness", "min_shift_no_undercut", "span_measurement",
        "span_teeth", "form_radius", "pin_diameter", "measure_over_balls", "measure_over_pins", "chordal_thickness",
        "chordal_height", "generating_shift", "span_measurement_limits", "measure_limits",
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
_USUAL_TIP = 0.15


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
        from gearlink.core.parts.gears.rack.profile import RackProfile

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
            from gearlink.core.parts.gears.distance_checks import rack_limits

            yield from rack_limits(name, self, limits)


def _contact_ratio(rack: RackMesh, limits: Any) -> Iterator[Check]:
    total = rack.path.total_contact_ratio
    eps = total if rack.pair.helix_angle and total else rack.contact_ratio
    yield contact_check(eps, limits, "contact ratio", "take more teeth or less profile shift")


def _interference(rack: RackMesh, _limits: Any) -> Iterator[Check]:
    what = "rack's tip {} the base tangent point of gear 1"
    yield _judged(INTERFERENCE, (what.format("to"), what.format("beyond")), rack.path.start, 0.0)


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
    fix = "lower the profile shift or the addendum of gear 1"
    yield _judged(FILLET, _contact("the root rounding of the rack"), margin, noise, fix)


def _corner_in_rack(rack: RackMesh, noise: float) -> CornerGap | None:
    """The cut of the gear's tip corner into the rounding of the rack; None where there is none."""
    from gearlink.core.parts.gears.rack.tip_corner import CornerInRack

    corner = CornerInRack(rack.pair, rack.center_distance, rack.end_depth)
    near = corner.deepest > rack.form_depth and rack.pair.tool(1).rounding_center(rack.pair.pressure_angle) >= 0.0
    return corner.least if near and corner.least.gap < noise else None


def _contact(where: str) -> tuple[str, str]:
    return f"clearance of the contact from {where}", f"contact within {where}"


def _tip(rack: RackMesh, limits: Any) -> Iterator[Check]:
    share, limit = rack.tip_width / rack.pair.module, limits.tip_thickness
    subject = "tip width of the rack over the module"
    found = Measured(share, limit, limit + _USUAL_TIP)
    yield tip_check(found, subject, "the teeth of the rack", "lower the addendum")


def _sliding(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = rack.specific_sliding
    limit = most_sliding(limits)
    if found is None or (limits.sliding is None and abs(found[0]) <= limit):
        return
    status: Status = "warn" if abs(found[0]) > limit else "pass"
    fix = "raise its profile shift or take more teeth"
    yield SLIDING.check(status, "specific sliding at the root of gear 1", abs(found[0]), limit, fix=fix)


def _backlash(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = rack.backlash_normal
    if found is None:
        return
    yield backlash_check(*found, limits.backlash, rack.pair.module, "gear and rack do not assemble")


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
    fix: str = "raise the profile shift of gear 1 or take more teeth",
    at: str = "",
) -> Check:
    """A finding that fails below its limit; `what` is kept, and what goes beyond where the margin is negative."""
    status: Status = "fail" if margin < limit else "pass"
    return rule.check(status, what[0], margin, limit, "mm", overlap=what[1], at=at, fix=fix)
