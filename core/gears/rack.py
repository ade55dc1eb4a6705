"""A gear on a rack: the mesh has the reference circle of the gear and the tool's own pressure angle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from gearlink.core.gears.checks import GEAR_QUANTITIES, gear_check, gear_quantity
from gearlink.core.gears.codes import CONTACT_RATIO, FILLET, INTERFERENCE
from gearlink.core.gears.data import GearData
from gearlink.core.gears.drawing_names import PLACES
from gearlink.core.gears.pair import GearPair
from gearlink.core.report import Check, Status
from gearlink.core.results import cached_property

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
_FILLET_NOISE = 1e-4


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

    @property
    def center_distance(self) -> float:
        """a = r_1 + x_1 m, from the axis to the datum line."""
        return self.pair.reference_radius[0] + self.pair.profile_shift[0] * self.pair.module

    @property
    def pitch(self) -> float:
        """rho_C1 = r_1 sin(alpha_t)."""
        return self.pair.reference_radius[0] * math.sin(self.pair.transverse_pressure_angle)

    @property
    def start(self) -> float:
        """rho_A1 = rho_C1 - (h_aR - x_1) m/sin(alpha_t), at the tip of the rack."""
        height = (self.pair.addendum - self.pair.profile_shift[0]) * self.pair.module
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
        elif name == "contact-ratio":
            eps = self.total_contact_ratio if self.pair.helix_angle and self.total_contact_ratio else self.contact_ratio
            least = limits.contact_ratio
            remedy = "take more teeth or less profile shift"
            yield CONTACT_RATIO.below(eps, least, least + 0.1, "1", "the contact ratio", remedy)
        elif name == "involute-interference":
            yield _judged(INTERFERENCE.check, self.start, 0.0, "the rack's tip stays short of the base tangent point")
        elif name == "fillet-interference" and self.pair.form_radius[0] is not None:
            margin = self.used_root_radius[0] - self.pair.form_radius[0] if self.start > 0.0 else self.start
            yield _judged(FILLET.check, margin, -_FILLET_NOISE * self.pair.module, "contact stays off the root fillet")


def _judged(make: Any, margin: float, limit: float, words: str) -> Check:
    status: Status = "fail" if margin < limit else "pass"
    text = f"{words} by {margin:.4g} mm"
    if status == "fail":
        text = f"not so: {words} (by {margin:.4g} mm): raise the profile shift of gear 1 or take more teeth"
    check: Check = make(status, text, margin, limit, "mm")
    return check
