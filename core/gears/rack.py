"""A gear on a rack: the mesh has the reference circle of the gear and the tool's own pressure angle."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.core.gears.checks import (
    FILLET_NOISE,
    GEAR_QUANTITIES,
    MORE_CONTACT,
    gear_check,
    gear_quantity,
    most_sliding,
)
from gearlink.core.gears.codes import BACKLASH, CONTACT_RATIO, FILLET, INTERFERENCE, SLIDING, TIP_THICKNESS
from gearlink.core.gears.data import GearData
from gearlink.core.gears.drawing_names import PLACES
from gearlink.core.gears.pair import GearPair, Pair
from gearlink.core.gears.tools import rack_tip_width
from gearlink.core.report import Check, Status, Table
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.gears.rack_profile import RackProfile

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
_OF_TOOTH = ("undercut", "tip-thickness", "tooth-form", "root-clearance")
_NO_BACKLASH = -1e-6
_USUAL_TIP = 0.15
_STEPS = 40


def beside_a_rack(pair: dict[str, Any], first: float) -> GearPair:
    """The gear of a rack as a pair at its reference centre distance with a large mate: only gear 1 is used."""
    mate = {"teeth": (pair["teeth"][0], _MATE), "given_shift": (first, -first), "given_distance": None}
    return GearPair(**(pair | mate))


@dataclass(frozen=True)
class RackMesh:
    """A gear on a rack of the same reference profile.

    eps_alpha = (rho_E1 - r_1 sin(alpha_t) + (h_aR - x_1) m/sin(alpha_t))/p_et,  a = r_1 + x_1 m

    Parameters
        data : GearData - its gear 1 is the gear
    Returns
        Properties: lengths in mm, angles in rad.
    Notes
        The limit of an external pair whose wheel has ever more teeth: held by the tests.
    Example
        >>> rack = RackMesh(GearData(pair=GearPair.from_shift(2.0, (20, 10_000))))
        >>> round(rack.contact_ratio, 6), rack.center_distance
        (1.768824, 20.0)

    Source
        ISO 21771
    """

    data: GearData

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
        from gearlink.core.gears.rack_profile import RackProfile

        pair = self.pair
        return RackProfile(
            module=pair.module,
            tool=pair.tool(1),
            pressure_angle=pair.pressure_angle,
            helix_angle=pair.helix_angle,
            height=self.height,
        )

    @property
    def center_distance(self) -> float:
        """a = r_1 + x_1 m, from the axis to the datum line."""
        return self.pair.reference_radius[0] + self.pair.profile_shift[0] * self.pair.module

    @property
    def height(self) -> float:
        """h_aR [module], of the rack's tips above its datum line: h_a* + k_2."""
        return self.pair.addendum + self.pair.tip_alteration[1]

    @property
    def pitch(self) -> float:
        """rho_C1 = r_1 sin(alpha_t)."""
        return self.pair.reference_radius[0] * math.sin(self.pair.transverse_pressure_angle)

    @property
    def start(self) -> float:
        """rho_A1 = rho_C1 - (h_aR - x_1) m/sin(alpha_t), at the tip of the rack."""
        height = (self.height - self.pair.profile_shift[0]) * self.pair.module
        return self.pitch - height / math.sin(self.pair.transverse_pressure_angle)

    @property
    def end(self) -> float:
        """rho_E1, at the tip of the gear."""
        return self.pair.base_radius[0] * math.tan(self.pair.tip_pressure_angle[0])

    @property
    def path_of_contact(self) -> float:
        """g_alpha = rho_E1 - rho_A1."""
        return self.end - self.start

    @cached_property
    def contact_ratio(self) -> float:
        """eps_alpha."""
        return self.path_of_contact / self.pair.base_pitch

    @property
    def overlap_ratio(self) -> float | None:
        """eps_beta; None for helical gears without a width."""
        return self.data.path.overlap_ratio

    @property
    def total_contact_ratio(self) -> float | None:
        """eps_gamma."""
        return None if self.overlap_ratio is None else self.contact_ratio + self.overlap_ratio

    @property
    def transverse_pressure_angle(self) -> float:
        """alpha_t."""
        return self.pair.transverse_pressure_angle

    working_pressure_angle = transverse_pressure_angle

    @property
    def base_helix_angle(self) -> float:
        """beta_b."""
        return self.pair.base_helix_angle

    @property
    def used_root_radius(self) -> tuple[float, None]:
        """r_Nf of the gear."""
        return math.hypot(self.pair.base_radius[0], self.start), None

    @property
    def specific_sliding(self) -> tuple[float, None] | None:
        """zeta_A1 = 1 - rho_C1/rho_A1."""
        return (1.0 - self.pitch / self.start, None) if self.start > 0.0 else None

    @property
    def specific_sliding_tip(self) -> tuple[float, None]:
        """zeta_E1 = 1 - rho_C1/rho_E1."""
        return 1.0 - self.pitch / self.end, None

    @property
    def sliding_factor(self) -> tuple[float, float]:
        """K_g at A and at E."""
        r = self.pair.reference_radius[0]
        return (self.pitch - self.start) / r, (self.end - self.pitch) / r

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
        below = (self.end - self.pitch) * math.sin(self.pair.transverse_pressure_angle)
        return below - self.pair.profile_shift[0] * self.pair.module

    @property
    def form_depth(self) -> float:
        """How far below its datum line the straight flank of the rack reaches [mm]."""
        return self.pair.tool(1).straight_end(self.pair.pressure_angle) * self.pair.module

    @property
    def tip_width(self) -> float:
        """s_aR, width of the rack's tips in the normal section [mm]."""
        return rack_tip_width(self.height, self.pair.pressure_angle) * self.pair.module

    @cached_property
    def backlash_circumferential(self) -> Pair | None:
        """j_wt on the reference circle, least and greatest [mm]: -(E_1 + E_2)/cos(beta) +- 2 A_a tan(alpha_t).

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
        """j_bn, least and greatest [mm]: j_wt cos(alpha_t) cos(beta_b)."""
        found = self.backlash_circumferential
        turned = math.cos(self.pair.transverse_pressure_angle) * math.cos(self.pair.base_helix_angle)
        return None if found is None else (found[0] * turned, found[1] * turned)

    @property
    def backlash_angle(self) -> tuple[Pair, None] | None:
        """Free turn of the gear while the rack stands, least and greatest [rad]."""
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
        known = name in GEAR_QUANTITIES or name in PLACES
        return getattr(self, name, None) if known else None

    def checks(self, name: str, limits: Any) -> Iterator[Check]:
        """The findings of a check on gear and rack."""
        if name in _OF_TOOTH:
            found = list(gear_check(name, self.pair, limits, shifts=True))
            yield from (each for each in found if "gear 1" in each.message)
        if name in _CHECKS:
            yield from _CHECKS[name](self, limits)

    def table(self, samples: int | None = None) -> Table:
        """The table `path`: sliding from A to E."""
        steps, r = _STEPS if samples is None else samples, self.pair.reference_radius[0]
        named = {self.start: "A", self.pitch: "C", self.end: "E"}
        between = [self.start + self.path_of_contact * k / steps for k in range(1, steps)]
        rho = sorted({*between, *(at for at in named if self.start <= at <= self.end)})
        columns: dict[str, tuple[list[Any], str]] = {
            "rho": (rho, "mm"),
            "place": ([named.get(at, "") for at in rho], "1"),
            "sliding": ([1.0 - self.pitch / at if at else -math.inf for at in rho], "1"),
            "sliding_2": ([1.0 - at / self.pitch for at in rho], "1"),
            "sliding_factor": ([(at - self.pitch) / r for at in rho], "1"),
        }
        return Table.of("path", columns)


def _contact_ratio(rack: RackMesh, limits: Any) -> Iterator[Check]:
    eps = rack.total_contact_ratio if rack.pair.helix_angle and rack.total_contact_ratio else rack.contact_ratio
    least = limits.contact_ratio
    remedy = "take more teeth or less profile shift"
    yield CONTACT_RATIO.below(eps, least, least + MORE_CONTACT, "1", "the contact ratio", remedy)


def _interference(rack: RackMesh, _limits: Any) -> Iterator[Check]:
    good, bad = "stays {:.4g} mm short of", "goes {:.4g} mm beyond"
    words = f"the rack's tip {bad if rack.start < 0.0 else good} the base tangent point"
    yield _judged(INTERFERENCE.check, words, rack.start, 0.0)


def _fillet(rack: RackMesh, _limits: Any) -> Iterator[Check]:
    noise = -FILLET_NOISE * rack.pair.module
    if rack.pair.form_radius[0] is not None:
        margin = rack.used_root_radius[0] - rack.pair.form_radius[0] if rack.start > 0.0 else rack.start
        yield _judged(FILLET.check, f"contact {_side(margin, noise)} the root fillet of gear 1", margin, noise)
    margin = rack.form_depth - rack.end_depth
    words = f"contact {_side(margin, noise)} the root rounding of the rack"
    remedy = "lower the profile shift or the addendum of gear 1, or the rounding of the rack's tool"
    yield _judged(FILLET.check, words, margin, noise, remedy)


def _side(margin: float, noise: float) -> str:
    return "goes {:.4g} mm into" if margin < noise else "stays {:.4g} mm off"


def _tip(rack: RackMesh, limits: Any) -> Iterator[Check]:
    share, limit = rack.tip_width / rack.pair.module, limits.tip_thickness
    subject = "the tip width of the rack over the module"
    yield TIP_THICKNESS.below(share, limit, limit + _USUAL_TIP, "1", subject, "lower the addendum")


def _sliding(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = rack.specific_sliding
    limit = most_sliding(limits)
    if found is None or (limits.sliding is None and abs(found[0]) <= limit):
        return
    text = f"the specific sliding at the root of gear 1 is {found[0]:.5g}"
    over = abs(found[0]) > limit
    if over:
        text += f", beyond the limit of {limit:g}: raise its profile shift or take more teeth"
    yield SLIDING.check("warn" if over else "pass", text, abs(found[0]), limit)


def _backlash(rack: RackMesh, limits: Any) -> Iterator[Check]:
    found = rack.backlash_normal
    if found is None:
        return
    status: Status = "pass"
    text = f"the theoretical normal backlash is {found[0]:.4g} to {found[1]:.4g} mm"
    if found[0] < _NO_BACKLASH * rack.pair.module:
        status = "fail"
        text += ": gear and rack do not assemble; thin the teeth (allowances) or move the axis away"
    elif found[0] < limits.backlash:
        status, text = "warn", f"{text}, below {limits.backlash:g} mm: thin the teeth (allowances)"
    yield BACKLASH.check(status, text, found[0], limits.backlash, "mm")


_CHECKS: dict[str, Callable[[RackMesh, Any], Iterator[Check]]] = {
    "contact-ratio": _contact_ratio,
    "involute-interference": _interference,
    "fillet-interference": _fillet,
    "tip-thickness": _tip,
    "sliding": _sliding,
    "backlash": _backlash,
}


def _judged(
    make: Any,
    words: str,
    margin: float,
    limit: float,
    remedy: str = "raise the profile shift of gear 1 or take more teeth",
) -> Check:
    status: Status = "fail" if margin < limit else "pass"
    text = words.format(abs(margin)) + (f": {remedy}" if status == "fail" else "")
    check: Check = make(status, text, margin, limit, "mm")
    return check
