"""Gears 3 and 4 of a press, its pinion and both racks: geometry and checks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import MissingSection, in_section
from gearlink.core.base.report import Check, Status
from gearlink.core.base.results import cached_property
from gearlink.core.machines.flatbed_press.codes import RACK_LENGTH
from gearlink.core.parts.gears.checks import GEAR_QUANTITIES, gear_quantity
from gearlink.core.parts.gears.drawing_names import DRAWING_QUANTITIES

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.rack.mesh import RackMesh

CYLINDER, PINION = "cylinder_gears", "pinion_rack"
OF_CYLINDER = tuple(f"{CYLINDER}.{name}" for name in (*GEAR_QUANTITIES, *DRAWING_QUANTITIES))
OF_PINION = tuple(f"{PINION}.{name}" for name in (*GEAR_QUANTITIES, *DRAWING_QUANTITIES))
OF_RACKS = ("pinion_radius", "rack_teeth", "rack_travel")


class PressTeeth:
    """The gears beside those of the input, as far as the file gives them."""

    def __init__(self, design: FlatbedPress) -> None:
        self.design = design

    @property
    def names(self) -> tuple[str, ...]:
        """What there is of them to look at."""
        found = OF_CYLINDER if self.design.spec.cylinder.gears is not None else ()
        return (*found, *OF_PINION, *OF_RACKS) if self.design.spec.bed.pinion is not None else found

    @cached_property
    def cylinder(self) -> GearData:
        """Gears 3 and 4, without backlash by their shifts."""
        from gearlink.core.parts.gears.from_spec import data_of, pair_at, required_of

        given = self.design.spec.cylinder.gears
        if given is None:
            raise MissingSection("give cylinder.gears: {module, teeth: [z3, z4]}", key="cylinder")
        plain = 0.5 * given.module * sum(given.teeth) / math.cos(math.radians(given.helix_angle))
        with in_section("cylinder.gears"):
            pair = pair_at(given, (given.teeth[0], given.teeth[1]), plain if given.profile_shift is None else None)
            return replace(data_of(given, pair), required=required_of(self.design.spec.limits))

    @cached_property
    def pinion(self) -> RackMesh:
        """The pinion on either rack."""
        from gearlink.core.parts.gears.from_spec import rack_at

        given = self.design.spec.bed.pinion
        if given is None:
            raise MissingSection("give bed.pinion: {module, teeth}", key="bed")
        with in_section("bed.pinion"):
            return rack_at(given, given.teeth)

    @property
    def pinion_radius(self) -> float | None:
        """Radius with which the pinion rolls [mm]."""
        return None if self.design.spec.bed.pinion is None else self.pinion.pair.reference_radius[0]

    @cached_property
    def rack_travel(self) -> list[float] | None:
        """How far the pinion goes along the lower and the upper rack [mm]: stroke of F, and the follower's with it."""
        if self.design.spec.bed.pinion is None:
            return None
        stroke = 0.5 * self.design.spec.bed.stroke
        lift = 0.0 if self.design.spec.cam is None else float(self.design.cams.follower_stroke)
        return [stroke + lift, stroke]

    @property
    def least_rack_teeth(self) -> list[int]:
        """Teeth that travel, path of contact and a pitch take."""
        pitch = self.pinion.pitch_on_line
        contact = (self.pinion.path.end - self.pinion.path.start) * math.cos(self.pinion.working_pressure_angle)
        return [math.ceil((travel + contact + pitch) / pitch) for travel in self.rack_travel or ()]

    @property
    def rack_teeth(self) -> list[int] | None:
        """Teeth of the lower and the upper rack, given or as many as they need."""
        if self.design.spec.bed.pinion is None:
            return None
        return self.design.spec.bed.rack_teeth or self.least_rack_teeth

    def quantity(self, name: str) -> Any:
        """A quantity by name, None where the file has not these gears."""
        mesh, _, last = name.rpartition(".")
        if name not in self.names:
            return None
        if mesh == CYLINDER:
            with in_section("cylinder.gears"):
                data = self.cylinder
                return gear_quantity(data.pair, last) if last in GEAR_QUANTITIES else data.quantity(last)
        if mesh == PINION:
            with in_section("bed.pinion"):
                return self.pinion.quantity(last)
        return getattr(self, name)

    def checks(self, name: str) -> Iterator[Check]:
        """The findings of a gear check on gears 3 and 4, and on pinion and racks."""
        from gearlink.core.parts.gears.drawing_checks import pair_check

        spec = self.design.spec
        if spec.cylinder.gears is not None:
            shifts = spec.cylinder.gears.profile_shift is not None
            with in_section("cylinder.gears"):
                yield from pair_check(name, self.cylinder, spec.limits, mesh=CYLINDER, shifts=shifts)
        if spec.bed.pinion is not None:
            with in_section("bed.pinion"):
                for found in self.pinion.checks(name, spec.limits):
                    yield replace(found, what=f"{PINION}: {found.what}")

    def check_racks(self) -> Iterator[Check]:
        """GL346: teeth of both racks against what the travel takes."""
        if self.design.spec.bed.rack_teeth is None:
            return
        for name, has, needs in zip(
            ("lower", "upper"), self.design.spec.bed.rack_teeth, self.least_rack_teeth, strict=True
        ):
            what, aside = f"length of the {name} rack", "travel and path of contact"
            status: Status = "fail" if has < needs else "pass"
            fix = f"give it {needs} teeth (bed.rack_teeth)"
            yield RACK_LENGTH.check(status, what, float(has), float(needs), "teeth", aside=aside, fix=fix)


def polygons(design: FlatbedPress, samples: int | None = None) -> dict[str, tuple[Any, str]]:
    """Velocity polygons of both chains: v_C = v_B + v_CB, v_F = v_E + v_FE, v_M = v_H + v_MH.

    Returns
        columns : by name - input angle, magnitudes [mm/s], then directions from +x of the frame of the chains [deg]
    Source
        TY-460 report, sheets 1 and 2
    """
    import numpy as np

    from gearlink.core.base.rows import row_numbers
    from gearlink.core.machines.flatbed_press.mechanism import bare

    count = samples or 12
    degrees = np.array([360.0 * k / count for k in row_numbers(samples, count)])
    links = bare(design).moving.at(np.radians(degrees), 1).links
    at = {
        point: design.input_speed * links[link].at(point).first
        for point, link in {"B": "gear2", "C": "CDE", "E": "CDE", "F": "carriage", "H": "gear1", "M": "MN"}.items()
    }
    found: dict[str, Any] = {}
    for start, end in (("B", "C"), ("E", "F"), ("H", "M")):
        found |= {f"v_{start}": at[start], f"v_{end}{start}": at[end] - at[start], f"v_{end}": at[end]}
    columns: dict[str, tuple[Any, str]] = {"input_angle": (degrees, "deg")}
    columns |= {name: (np.abs(vector), "mm/s") for name, vector in found.items()}
    angles = {name: np.degrees(np.angle(vector)) for name, vector in found.items()}
    return columns | {f"{name}_direction": (angle, "deg") for name, angle in angles.items()}
