"""Sliding, pressure and root stress along the path of contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.rating.flank_strength import hertz_pressure

if TYPE_CHECKING:
    from gearlink.core.base.report import Column

_STEPS = 40


class Place(NamedTuple):
    """A place on the path: rho_1, its name (A, B-, B+, C, D-, D+, E or none), and the share of the load there."""

    rho: float
    name: str
    share: float | None


@dataclass(frozen=True)
class AlongPath:
    """A pair's values from A to E.

    Notes
        Between B and D one pair of flanks carries all, outside a second one helps: from a third to two thirds of the
        load ("third"), or half of it. This holds for contact ratios of 1 to 2; beyond, no load is given.

    Source
        ISO/TR 13989 for the shares, from memory; pressure: Hertz
    """

    data: GearData

    @cached_property
    def single(self) -> tuple[float, float] | None:
        """rho_1 at B and D; None where one pair of flanks never carries alone, or contact breaks off."""
        path = self.data.path
        pitch, eps = path.pair.base_pitch, path.contact_ratio
        return (path.end - pitch, path.start + pitch) if 1.0 < eps <= 2.0 else None

    def share(self, rho: float, *, after: bool = True) -> float | None:
        """X, the share of the load at rho_1; at B and D the one `after` or before the step."""
        if self.single is None:
            return None
        b, d = self.single
        first, last = self.data.path.start, self.data.path.end
        if b < rho < d or (rho == b and after) or (rho == d and not after):
            return 1.0
        if self.data.load_share == "half":
            return 0.5
        if rho <= b:
            return 1.0 / 3.0 + (rho - first) / (3.0 * (b - first)) if b > first else 1.0 / 3.0
        return 2.0 / 3.0 - (rho - d) / (3.0 * (last - d)) if last > d else 2.0 / 3.0

    def places(self, steps: int = _STEPS) -> list[Place]:
        """Equal steps from A to E with the named places among them, from the first on."""
        path = self.data.path
        named = {path.start: "A", path.end: "E"}
        if path.start < path.pitch < path.end:  # a pair may touch on one side of its pitch point alone
            named[path.pitch] = "C"
        between = [path.start + (path.end - path.start) * k / steps for k in range(1, steps)]
        found = [Place(rho, name, self.share(rho)) for rho, name in named.items()]
        found += [Place(rho, "", self.share(rho)) for rho in between]
        for rho, name in zip(self.single or (), "BD", strict=False):
            found += [Place(rho, f"{name}-", self.share(rho, after=False)), Place(rho, f"{name}+", self.share(rho))]
        return sorted(found, key=lambda place: (place.rho, place.name.endswith("+")))

    def sliding_factor(self, rho: float) -> float:
        """K_g = v_g/v_t."""
        path = self.data.path
        return (rho - path.pitch) * (1.0 + 1.0 / path.gear_ratio) / path.pair.working_radius[0]

    def sliding_speed(self, rho: float) -> float | None:
        """v_g [mm/s]; None where the load names no speed."""
        if self.data.load is None or self.data.load.speed is None:
            return None
        return self.sliding_factor(rho) * self.data.pair.working_radius[0] * self.data.load.speed * math.pi / 30.0

    def pressure(self, place: Place) -> float | None:
        """Hertz pressure of the nominal load [N/mm^2]."""
        force, width = self.data.flank.tangential_force, self.data.path.face_width
        if force is None or width is None or place.share is None:
            return None
        line = place.share * force / math.cos(self.data.pair.transverse_pressure_angle) / width
        return hertz_pressure(self.data.path, place.rho, line, self.data.materials)

    def root_stress(self, place: Place, gear: int) -> float | None:
        """Nominal root stress of a gear while it is loaded at a place [N/mm^2]."""
        root, pair = self.data.root, self.data.pair
        section, width, beta = root.sections[gear], root.bearing_width, root.helix_angle_factor
        raised = root.raised(gear)
        force = self.data.flank.tangential_force
        if section is None or width is None or beta is None or force is None or place.share is None or raised is None:
            return None
        here = section.loaded_at(self.data.path, place.rho)
        try:
            factor = here.form_factor * here.stress_correction_factor
        except NoSolution:
            return None
        return place.share * force / (width[gear] * pair.module) * factor * beta * raised * root.load_distribution

    def table(self, steps: int = _STEPS) -> Table:
        """The table `path`."""
        places = self.places(steps)
        sliding = [self.data.path.sliding(place.rho) for place in places]
        columns: dict[str, tuple[Column, str]] = {
            "rho": ([place.rho for place in places], "mm"),
            "place": ([place.name for place in places], "1"),
            "sliding": ([one for one, _ in sliding], "1"),
            "sliding_2": ([other for _, other in sliding], "1"),
            "sliding_factor": ([self.sliding_factor(place.rho) for place in places], "1"),
            "speed": ([self.sliding_speed(place.rho) for place in places], "mm/s"),
            "load_share": ([place.share for place in places], "1"),
            "pressure": ([self.pressure(place) for place in places], "N/mm^2"),
            "root_stress": ([self.root_stress(place, 0) for place in places], "N/mm^2"),
            "root_stress_2": ([self.root_stress(place, 1) for place in places], "N/mm^2"),
        }
        return Table.of("path", columns)
