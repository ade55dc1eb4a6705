"""A gear pair with all that its drawing needs, and its quantities by name."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from gearlink.core.gears.contact import PathOfContact
from gearlink.core.gears.internal import InternalInterference
from gearlink.core.gears.pair import GearPair, Pair
from gearlink.core.results import cached_property

PLACES = {
    "transverse_pressure_angle": "pair.transverse_pressure_angle",
    "base_helix_angle": "pair.base_helix_angle",
    "overlap_ratio": "path.overlap_ratio",
    "total_contact_ratio": "path.total_contact_ratio",
    "usable_contact_ratio": "path.usable_contact_ratio",
    "path_of_contact": "path.length",
    "form_radius": "form_radius",
    "used_root_radius": "path.used_root_radius",
    "tip_clearance": "pair.tip_clearance",
    "specific_sliding_tip": "path.sliding_at_tip",
    "sliding_factor": "path.sliding_factor",
    "involute_margin": "internal.involute_margin",
    "tip_fouling_margin": "internal.tip_fouling_margin",
    "radial_assembly_margin": "internal.radial_assembly_margin",
}
"""Where each quantity of a drawing stands in a GearData."""
DRAWING_QUANTITIES = tuple(PLACES)
_MAGNITUDES = frozenset(
    (
        "center_distance",
        "reference_center_distance",
        "reference_radius",
        "base_radius",
        "working_radius",
        "tip_radius",
        "root_radius",
        "used_root_radius",
    )
)


@dataclass(frozen=True, kw_only=True)
class GearData:
    """A gear pair with its widths; parts are computed when they are asked for.

    Parameters
        pair : GearPair
        face_width : (float, float) or None [mm] - of gear 1 and 2
    """

    pair: GearPair
    face_width: Pair | None = None

    @property
    def common_width(self) -> float | None:
        """b [mm], the lesser width."""
        return None if self.face_width is None else min(self.face_width)

    @cached_property
    def path(self) -> PathOfContact:
        """The path of contact."""
        return PathOfContact(self.pair, self.common_width)

    @cached_property
    def internal(self) -> InternalInterference | None:
        """The interferences of a pinion in a ring; None for an external pair."""
        return InternalInterference(self.pair) if self.pair.internal else None

    @property
    def form_radius(self) -> tuple[float | None, float | None]:
        """r_Ff [mm]."""
        return self.pair.form_radius

    def quantity(self, name: str) -> Any:
        """A quantity by name, its radii and distances as magnitudes; None where it does not apply."""
        value: Any = self
        for step in PLACES[name].split("."):
            if value is None:
                return None
            value = getattr(value, step)
        return shown(name, value)


def shown(name: str, value: Any) -> Any:
    """A value as results give it: magnitudes of radii and distances, None where both gears have none."""
    if isinstance(value, tuple):
        both = tuple(shown(name, each) for each in value)
        return None if all(each is None for each in both) else both
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return None
    return abs(value) if name in _MAGNITUDES else value
