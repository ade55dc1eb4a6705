"""The gear pair as a design."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline
from gearlink.core.errors import NoSolution, at_key
from gearlink.core.gears.checks import GEAR_CHECKS, GEAR_QUANTITIES, GearQuantities, gear_check, gear_quantity
from gearlink.core.gears.pair import GearPair
from gearlink.core.remedies import down, either, shared, up
from gearlink.core.report import Check
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.gears.spec import GearPairSpec

_AGREE = 1e-6


_SHIFTS = (
    *shared("profile_shift[0]", "profile_shift[1]", step=0.01),
    *either("profile_shift[0]", "profile_shift[1]", "shift_split", step=0.01),
)
_TEETH = (up("teeth[0]", step=1), up("teeth[1]", step=1))
_ANGLE = either("pressure_angle", step=0.5)
_WAYS = {
    "undercut": (*_SHIFTS, *_TEETH, *_ANGLE),
    "tip-thickness": (*_SHIFTS, down("addendum", step=0.01), *_TEETH, *_ANGLE),
    "contact-ratio": (*_SHIFTS, up("addendum", step=0.01), *_TEETH, *_ANGLE),
    "involute-interference": (*_SHIFTS, down("addendum", step=0.01), *_TEETH, *_ANGLE),
    "tooth-form": (*_SHIFTS, down("addendum", step=0.01), *_TEETH, *_ANGLE),
    "root-clearance": (up("clearance", step=0.01),),
}


class GearPairDesign(GearQuantities, Design):
    """External spur gears, given by centre distance, by profile shifts, or by both in agreement."""

    kind = "gear-pair"
    spec: GearPairSpec
    outlines = {
        "gear": Outline(GEAR_QUANTITIES, GEAR_CHECKS),
        "analyze": Outline(GEAR_QUANTITIES, GEAR_CHECKS),
    }
    ways = _WAYS

    @cached_property
    def gear_pair(self) -> GearPair:
        """The pair of the design file.

        Raises
            NoSolution - where centre distance and shifts contradict each other, or the teeth cannot mesh
        """
        spec = self.spec
        teeth = (spec.teeth[0], spec.teeth[1])
        profile = {
            "pressure_angle": math.radians(spec.pressure_angle),
            "addendum": spec.addendum,
            "clearance": spec.clearance,
        }
        if spec.profile_shift is None:
            assert spec.center_distance is not None, "the spec asks for one of the two"
            with at_key("center_distance"):
                return GearPair.from_center_distance(
                    spec.module, teeth, spec.center_distance, split=spec.shift_split, **profile
                )
        with at_key("profile_shift"):
            pair = GearPair.from_shift(spec.module, teeth, (spec.profile_shift[0], spec.profile_shift[1]), **profile)
            distance = pair.center_distance
        if spec.center_distance is not None and abs(spec.center_distance - distance) > _AGREE * spec.module:
            raise NoSolution(
                f"center_distance {spec.center_distance!r} mm and profile_shift contradict each other: these shifts "
                f"give {distance!r} mm; leave one of the two out",
                key="center_distance",
            )
        return pair

    def raw(self, name: str) -> Any:
        """Every quantity is the pair's."""
        with at_key(self._placed_by):
            return gear_quantity(self.gear_pair, name)

    def check(self, name: str) -> list[Check]:
        """Every check is the pair's."""
        with at_key(self._placed_by):
            return list(gear_check(name, self.gear_pair, self.spec.limits, shifts=True))

    @property
    def _placed_by(self) -> str:
        """The key that decides whether the teeth have a flank left; the pair finds out when it is asked."""
        return "center_distance" if self.spec.profile_shift is None else "profile_shift"
