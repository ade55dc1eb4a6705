"""The offset slider-crank as a design: crank length from stroke, and the motion of its slider."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Found, Outline, placed
from gearlink.core.base.real_speed import SLIDER_SPEEDS, SliderSpeed, per_time
from gearlink.core.base.remedies.ways import Way, down, either, up
from gearlink.core.base.report import Check, Table
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.parts.gears.checks import gear_ways
from gearlink.core.parts.gears.codes import FILLET, ROOT_CLEARANCE
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.slider_crank import SLIDER_QUANTITIES, SliderCrank, SliderCrankQuantities, slider

if TYPE_CHECKING:
    from gearlink.core.machines.slider_crank.racks import RackDrive
    from gearlink.core.machines.slider_crank.spec import SliderCrankSpec
    from gearlink.core.parts.linkages.standstills import Turning

_SIZES = ("crank_length", "stroke", *SLIDER_QUANTITIES, "dead_center_extended_at", "dead_center_folded_at")
FOUND = ("rod_length", "offset")
_STROKES = (
    "stroke_ratio", "output_stroke", "pinion_turns", "fixed_rack_travel", "moving_rack_travel", "fixed_rack_length",
    "moving_rack_length",
)  # fmt: skip
_OF_RACK = (
    "center_distance", "working_pressure_angle", "contact_ratio", "profile_shift", "reference_radius", "tip_radius",
    "root_radius", "tooth_thickness", "tip_thickness", "span_measurement", "specific_sliding", "backlash_normal",
)  # fmt: skip
RACKS = (*_STROKES, *(f"{rack}.{name}" for rack in ("fixed_rack", "moving_rack") for name in _OF_RACK))
RACK_CHECKS = (
    "undercut", "tip-thickness", "contact-ratio", "involute-interference", "root-clearance", "tooth-form", "sliding",
    "fillet-interference", "backlash",
)  # fmt: skip
_MOTION = (
    "forward_angle",
    "return_angle",
    *names("velocity", "acceleration"),
    "min_transmission_angle",
    "input_speed",
    "turn_time",
    "forward_time",
    "return_time",
    *SLIDER_SPEEDS,
)


def rack_ways() -> dict[str, tuple[Way, ...]]:
    """The ways for the teeth of pinion and racks: its shift where the file gives one, either number of teeth, both."""
    teeth = (up("racks.fixed", step=1.0), up("racks.moving", step=1.0), up("racks.fixed", "racks.moving", step=1.0))
    shift = either("racks.profile_shift[0]", step=0.01)
    ways = {name: (*shift, *ways) for name, ways in gear_ways(*teeth, angle="racks.pressure_angle").items()}
    return ways | {
        ROOT_CLEARANCE.name: (up("racks.clearance", step=0.01), up("racks.tool.addendum", step=0.01)),
        FILLET.name: (*shift, *teeth),
    }


class SliderCrankDesign(SliderSpeed, SliderCrankQuantities, Design):
    """The slider-crank of a design file; its crank turns counter-clockwise, F lies below D on x = -offset."""

    kind = "slider-crank"
    spec: SliderCrankSpec
    keys = {
        "crank": (
            "crank_length",
            "stroke",
            ("quick_return_ratio", "quick_return_ratio"),
            "rod_length",
            "offset",
            ("max_stroke", ">stroke"),
            "dead_center_extended_at",
            "dead_center_folded_at",
            ("min_transmission_angle", ">limits.transmission_angle"),
        ),
        "analyze": (
            "crank_length",
            "output_stroke",
            "stroke",
            ("quick_return_ratio", "quick_return_ratio"),
            "rod_length",
            "offset",
            ("min_transmission_angle", ">limits.transmission_angle"),
            "slider_velocity_max",
            "slider_velocity_min",
            "slider_acceleration_max",
            "slider_acceleration_min",
            "*.contact_ratio",
            "velocity_max",
            "velocity_min",
            "acceleration_max",
            "acceleration_min",
        ),
    }
    outlines = {
        "crank": Outline((*_SIZES, *FOUND)),
        "analyze": Outline((*_SIZES, *FOUND, *_MOTION, *RACKS), ("transmission-angle", *RACK_CHECKS), ("motion",)),
    }
    extra_tables = ("candidates",)
    derived = frozenset(
        (*names("velocity", "acceleration"), *SLIDER_SPEEDS, "input_speed", "turn_time", "forward_time", "return_time")
    )
    requirements = Design.requirements | {"stroke", "quick_return_ratio"}
    ways = rack_ways() | {
        "transmission-angle": (up("rod"), down("stroke"), down("crank"), *either("offset"), down("quick_return_ratio"))
    }

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The stroke by other rods and offsets side by side."""
        from gearlink.core.base.candidates import Sought, nothing_sought, pairs, table

        if self.spec.crank is not None or self.spec.rod is None or self.spec.quick_return_ratio is not None:
            raise nothing_sought("give stroke and rod instead of crank")
        rod, offset = self.spec.rod, self.spec.offset
        rods = [round(share * rod, 6) for share in (0.7, 0.85, 1.0, 1.2, 1.5)]
        keys = {"rod": ("rod", "mm"), "offset": ("offset", "mm")}
        shown = ("crank_length", "quick_return_ratio", "velocity_max", "velocity_min", "acceleration_max")
        found = (*shown, "acceleration_min", "min_transmission_angle")
        return table(self, Sought("analyze", keys, pairs(rods, sorted({0.0, 0.5 * offset, offset})), found))

    @cached_property
    def slider_crank(self) -> SliderCrank:
        """The kernel's view of the spec."""
        return self.spec.slider_crank()

    @property
    def stroke(self) -> float | None:
        """Stroke of a given crank [mm]; None where the file gives it."""
        return None if self.spec.crank is None or self._found else self.slider_crank.stroke

    @property
    def _found(self) -> bool:
        return self.spec.quick_return_ratio is not None

    @property
    def rod_length(self) -> float | None:
        """The rod [mm], where it is found for a time ratio; None where the file gives it."""
        return self.slider_crank.rod if self._found and self.spec.rod is None else None

    @property
    def offset(self) -> float | None:
        """The offset [mm] that a time ratio needs; None where the file gives it."""
        return self.slider_crank.offset if self._found else None

    @cached_property
    def rack_drive(self) -> RackDrive | None:
        """Pinion and racks at the rod end; None where the file has none."""
        if self.spec.racks is None:
            return None
        from gearlink.core.machines.slider_crank.racks import RackDrive

        return RackDrive(self.spec.racks, self.slider_crank.stroke)

    def raw(self, name: str) -> Any:
        """Quantities of the racks are theirs."""
        if name in RACKS:
            return None if self.rack_drive is None else self.rack_drive.quantity(name)
        return super().raw(name)

    def check(self, name: str) -> list[Check]:
        """Gear checks are those of the racks."""
        if name in RACK_CHECKS:
            return [] if self.rack_drive is None else list(self.rack_drive.checks(name, self.spec.limits))
        return super().check(name)

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """Without racks there are no teeth to judge."""
        found = super().judged(command, spec)
        return found if spec.racks is not None else tuple(name for name in found if name not in RACK_CHECKS)

    def outline(self, command: str) -> Outline:
        """Where the rod is found, the transmission angle that it is found for stands beside it."""
        found = self.outlines[command]
        if self.spec.racks is None:
            found = Outline(
                tuple(name for name in found.quantities if name not in RACKS),
                tuple(name for name in found.checks if name not in RACK_CHECKS),
                found.tables,
            )
        if command != "crank" or not self._found or self.spec.rod is not None:
            return found
        return found._replace(quantities=(*found.quantities, "min_transmission_angle"))

    def completion(self) -> Iterator[Found]:
        """Rod and offset, and the crank where it is given, instead of the time ratio."""
        if self._found:
            part = self.slider_crank
            if self.spec.rod is None:
                yield Found("rod", part.rod, "found for quick_return_ratio")
            if self.spec.crank is not None:
                yield Found("stroke", None)
            yield Found("offset", part.offset, "found for quick_return_ratio")
            yield Found("quick_return_ratio", None)

    def depth(self, angle: float, order: int) -> float:
        """Depth of the slider below D, or its derivative of an order up to 3 [mm/rad^order]."""
        part = self.slider_crank
        return slider(angle, self.crank_length, part.rod, part.offset, order)[order]

    @property
    def _dead_centers(self) -> tuple[float, float]:
        """Input angles with the slider nearest to D and farthest from it [rad]."""
        folded, extended = self.dead_center_folded, self.dead_center_extended
        return 0.5 * math.pi - folded, 1.5 * math.pi - extended

    dead_center_folded_at: float = placed("_dead_centers.0")
    dead_center_extended_at: float = placed("_dead_centers.1")

    @property
    def forward_angle(self) -> float:
        """Input angle of the stroke away from D [rad]."""
        near, far = self._dead_centers
        return far - near

    @property
    def return_angle(self) -> float:
        """Input angle of the stroke towards D [rad]."""
        return 2.0 * math.pi - self.forward_angle

    @cached_property
    def fastest(self) -> list[Turning]:
        """Extremes of the slider's velocity per input angle away from D, maximum first, then minimum."""
        return self._turnings(1)

    @cached_property
    def hardest(self) -> list[Turning]:
        """Extremes of its acceleration per square of the input angle."""
        return self._turnings(2)

    def _turnings(self, order: int) -> list[Turning]:
        from gearlink.core.parts.linkages.standstills import SLIDER_GRID, turnings

        found = turnings(lambda x: self.depth(x, order), lambda x: self.depth(x, order + 1), SLIDER_GRID)
        found.sort(key=lambda turning: turning.value)
        return [found[-1], found[0]]

    forward_time: float | None = per_time("forward_angle", -1)
    return_time: float | None = per_time("return_angle", -1)

    @property
    def min_transmission_angle(self) -> float:
        """Minimum angle of the rod to the normal of the slide line over a revolution [rad]: 90 deg less the rod's."""
        part = self.slider_crank
        return part.fn.acos((self.crank_length + abs(part.offset)) / part.rod)

    def table_motion(self, samples: int | None = None) -> Table:
        """Slider and rod over a revolution of the crank; displacement counts from the dead centre nearest to D."""
        from gearlink.core.machines.slider_crank.mechanism import displacement
        from gearlink.core.mechanism.courses import Shown, between, motion_table, turned

        way, rod = displacement(self), turned("rod", sense=-1.0).less(0.5 * math.pi)
        of_rack = []
        if self.rack_drive is not None:
            from gearlink.core.machines.slider_crank.mechanism import rack_displacement

            course = rack_displacement(self)
            of_rack = [
                Shown("output_displacement", course),
                Shown("output_velocity", course, 1, "rack_velocity"),
                Shown("output_acceleration", course, 2, "rack_acceleration"),
            ]
        shown = [
            Shown("displacement", way),
            Shown("velocity", way, 1, "slider_velocity"),
            Shown("acceleration", way, 2, "slider_acceleration"),
            Shown("rod_angle", rod),
            Shown("rod_speed_ratio", rod, 1, "rod_speed"),
            Shown("rod_acceleration_ratio", rod, 2, "rod_acceleration"),
            Shown("transmission_angle", between("rod", "slider")),
            *of_rack,
        ]
        return motion_table("motion", self, shown, samples)

    def check_transmission_angle(self) -> Check:
        """GL303: the rod against the slide line."""
        remedy = "lengthen the rod, or reduce the offset"
        if self._found:  # stroke and time ratio leave the rod, or nothing
            remedy = "specify a smaller quick_return_ratio"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)
