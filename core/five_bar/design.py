"""The geared five-bar as a design: a coupler point's path, or an output over the input angle."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.clearance.bodies import Layout
from gearlink.core.clearance.checks import SHAFT_WAYS, collision_check, shaft_checks, shaft_seat
from gearlink.core.design import Outline, placed
from gearlink.core.errors import NoSolution
from gearlink.core.five_bar import bodies, tables
from gearlink.core.five_bar.codes import CLOSURE
from gearlink.core.five_bar.parts import MESHES, FiveBarParts
from gearlink.core.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.gears.train.meshed import named
from gearlink.core.gears.train.names import TRAIN_CHECKS
from gearlink.core.gears.train.single_mesh import MESH_CHECKS
from gearlink.core.gears.train.ways import train_ways
from gearlink.core.linkages.checks import target_check, transmission_check
from gearlink.core.motion_extremes import WithExtremes, names
from gearlink.core.real_speed import OUTPUT_SPEEDS, OutputSpeed, RealSpeed, per_time
from gearlink.core.remedies.ways import down, either, modules, up
from gearlink.core.report import Check, Table
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.five_bar.function_fit import Round
    from gearlink.core.five_bar.spec import GearedFiveBarSpec
    from gearlink.core.numerics.extremes import Extreme

_SHOWN_TURNS = 100
_LISTS = ("center_distance", "contact_ratio")
"""One for each mesh, whatever their number."""
_POSITION_TOLERANCE = math.degrees(1e-9)


_FEW_TURNS = 3
_FIT, _TOO_LONG = 100.0, 1e6
"""Trials of designs without a target that one fit takes as long as, and how many are tried with one."""
_TEETH = tuple(up(f"gears.{gear}", step=1) for gear in ("input", "output", "idler", "planet", "sun", "ring"))
_FEWER = tuple(down(*way.keys, step=1) for way in _TEETH)
_LINKS = (
    up("links.coupler", "links.follower"),
    *either("links.coupler", "links.follower", "links.output", "links.input", "links.frame"),
)


_OF_PATH = names("velocity", "acceleration")
_OF_FUNCTION = names("speed_ratio", "acceleration_ratio")


class GearedFiveBar(WithExtremes, OutputSpeed, RealSpeed, FiveBarParts):
    """A five-bar whose gears take away one of its two freedoms."""

    kind = "geared-five-bar"
    spec: GearedFiveBarSpec
    outlines = {
        "analyze": Outline(
            (
                "form",
                "five_bar_ratio",
                "coupler_ratio",
                "period_turns",
                "input_length",
                "coupler_length",
                "follower_length",
                "output_length",
                "frame_length",
                "phase",
                "assembly",
                "point_along",
                "point_across",
                "span_min",
                "span_min_at",
                "span_max",
                "span_max_at",
                "min_transmission_angle",
                "min_transmission_angle_at",
                *_OF_PATH,
                *_OF_FUNCTION,
                "path_width",
                "path_height",
                "phase_step",
                "path_deviation_rms",
                "path_deviation_max",
                "position_errors",
                "structural_error",
                "structural_error_at",
                "error_extremes",
                "function_start",
                "output_zero",
                "starts_tried",
                "first_point_angle",
                "center_distance",
                "gear_gap",
                "contact_ratio",
                "input_speed",
                "turn_time",
                "point_speed_max",
                "point_speed_min",
                "point_acceleration_max",
                *OUTPUT_SPEEDS,
            ),
            (
                "closure",
                "target",
                "gear-collision",
                "shaft-clearance",
                "shaft-seat",
                "transmission-angle",
                *MESH_CHECKS,
                "backlash",
            ),
            ("path", "function", "deviations", "structural_error", "search"),
        ),
        "gear": Outline(
            (
                "center_distance",
                "contact_ratio",
                *(name for name in OF_MESH if name not in _LISTS),
                *named(MESHES),
                "output_play",
            ),
            (*MESH_CHECKS, *TRAIN_CHECKS),
        ),
    }

    input_length: float = placed("bar.input")
    coupler_length: float = placed("bar.coupler")
    follower_length: float = placed("bar.follower")
    output_length: float = placed("bar.output")
    frame_length: float = placed("bar.frame")
    phase: float = placed("bar.phase")
    assembly: int = placed("bar.assembly")

    extreme_names = (*_OF_PATH, *_OF_FUNCTION)
    point_speed_max: float | None = per_time("velocity_max", 1)
    point_speed_min: float | None = per_time("velocity_min", 1)
    point_acceleration_max: float | None = per_time("acceleration_max", 2)

    ways = {
        "transmission-angle": (
            up("links.follower", "links.output"),
            *_LINKS,
            *either("phase", step=1.0),
            *_FEWER,
            *_TEETH,
            *modules("gears.module"),
        ),
        "shaft-clearance": (*SHAFT_WAYS, *_LINKS, *_FEWER, *_TEETH, *modules("gears.module")),
        "gear-collision": (up("links.frame"), *_FEWER, *_TEETH, *modules("gears.module")),
        **train_ways(3, up("gears.input", "gears.output", step=1), *_TEETH),
    }

    @property
    def cost(self) -> float:
        """A path of few turns takes a millisecond; links found for points or positions a tenth of a second each time,
        those for a function, for points with times, or within a budget, more than remedies may take."""
        target = self.spec.target
        if target is not None and self._fits:
            takes_long = target.function, target.input_angles, target.budget
            return _FIT if all(each is None for each in takes_long) else _TOO_LONG
        return (0.4 if self.period_turns <= _FEW_TURNS else 0.5) if self.is_path else 2.5

    @property
    def _fits(self) -> bool:
        """Whether the links are found for a target."""
        target = self.spec.target
        return target is not None and not (target.function is not None and target.function.links == "given")

    @property
    def point_along(self) -> float | None:
        """u of the coupler point [mm]."""
        return self.offset.real if self.is_path else None

    @property
    def point_across(self) -> float | None:
        """v of the coupler point [mm]."""
        return self.offset.imag if self.is_path else None

    @cached_property
    def motion_extremes(self) -> dict[str, float]:
        """Extremes of the point's speed and acceleration [mm/rad, mm/rad^2], or of the output's, and their places."""
        from gearlink.core.five_bar.extremes import function_extremes, path_extremes

        if self.is_path:
            return path_extremes(self.path_bar, self.offset)
        return function_extremes(self.function_bar, *self.input_range)

    # Closing

    @cached_property
    def _spans(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Least and greatest distance that the dyad spans, each with its input angle."""
        if self.is_path:
            return self.path_bar.span_extremes
        return self.function_bar.reach_extremes(*self.input_range)

    span_min: float = placed("_spans.0.1")
    span_min_at: float = placed("_spans.0.0")
    span_max: float = placed("_spans.1.1")
    span_max_at: float = placed("_spans.1.0")

    @cached_property
    def _transmission(self) -> tuple[float, float]:
        if self.is_path:
            return self.path_bar.min_transmission_angle()
        return self.function_bar.min_transmission_angle(*self.input_range)

    min_transmission_angle: float = placed("_transmission.0")
    min_transmission_angle_at: float = placed("_transmission.1")

    # Path

    @cached_property
    def _extent(self) -> tuple[Extreme, Extreme, Extreme, Extreme]:
        from gearlink.core.five_bar.path import extent

        return extent(self.path_bar, self.offset)

    @property
    def path_width(self) -> float | None:
        """Extent of the path along the frame [mm]."""
        return self._extent[1].value - self._extent[0].value if self.is_path else None

    @property
    def path_height(self) -> float | None:
        """Extent of the path across the frame [mm]."""
        return self._extent[3].value - self._extent[2].value if self.is_path else None

    path_deviation_rms: float | None = placed("fit.rms")

    @property
    def path_deviation_max(self) -> float | None:
        """Greatest distance of a point from the path [mm]."""
        return None if self.fit is None else float(self.fit.distance.max())

    @cached_property
    def position_errors(self) -> list[float] | None:
        """Output angle reached less that asked for, at each position [rad]."""
        if self.positions is None or self.is_path:
            return None
        from gearlink.core.five_bar.positions import position_errors

        return position_errors(self.function_bar, self.positions)

    @cached_property
    def layout(self) -> Layout:
        """The bodies in the plane of the gears."""
        return bodies.layout(self)

    gear_gap: float | None = placed("layout.gear_gap")
    structural_error: float | None = placed("function_fit.error.greatest")
    error_extremes: int | None = placed("function_fit.error.alternations")
    function_start: float | None = placed("function_fit.start")
    first_point_angle: float | None = placed("timed_fit.first_angle")
    output_zero: float | None = placed("function_fit.error.zero")

    @property
    def structural_error_at(self) -> list[float] | None:
        """Input angles at which the structural error is greatest [rad]."""
        found, wanted = self.function_fit, self.wanted
        if found is None or wanted is None:
            return None
        error = found.error
        rows = zip(error.places, error.errors, strict=True)
        most = error.greatest * (1.0 - 1e-9)
        return [found.start + wanted.input_swing * place for place, value in rows if abs(value) >= most]

    @property
    def starts_tried(self) -> int | None:
        """Starts that the search of a function or of timed points has gone through."""
        rounds = self.search_rounds
        return rounds[-1].starts if rounds else None

    @property
    def searches(self) -> bool:
        """Whether the file asks for such a search, which is not begun to tell so."""
        target = self.spec.target
        if target is None:
            return False
        if self.is_path:
            return target.points is not None and target.input_angles is not None
        return target.function is not None and target.function.links != "given"

    @property
    def search_rounds(self) -> tuple[Round, ...]:
        """The rounds of that search."""
        found = self.timed_fit if self.is_path else self.function_fit
        return () if found is None else found.rounds

    # Tables

    extra_tables = ("drawing", "candidates")

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The target met with other gears side by side."""
        from gearlink.core.five_bar.candidates import five_bar

        return five_bar(self)

    def table_names_shown(self) -> tuple[str, ...]:
        """The tables of this form."""
        if not self.is_path:
            judged = ("structural_error",) if self.wanted is not None else ()
            return ("function", *judged, *(("search",) if self.searches else ()))
        return (
            "path",
            *(("deviations",) if self.fit is not None else ()),
            *(("search",) if self.searches else ()),
        )

    def outline(self, command: str) -> Outline:
        """Each form has its own tables."""
        found = super().outline(command)
        return found._replace(tables=self.table_names_shown()) if command == "analyze" else found

    def table(self, name: str, *, samples: int | None = None) -> Table:
        """A table of this form; the other form's is refused as one that the design does not have."""
        if name in self.table_names() and name not in (*self.table_names_shown(), *self.extra_tables):
            raise NoSolution(f"the form {self.form} has no table {name}: it has {', '.join(self.table_names_shown())}")
        return super().table(name, samples=samples)

    @property
    def shown_turns(self) -> int:
        """Input turns that the path's table covers: the period, or the beginning of a long one."""
        return min(self.period_turns, _SHOWN_TURNS)

    table_path, table_deviations, table_search = tables.path, tables.deviations, tables.search
    table_function, table_structural_error = tables.function, tables.structural_error

    # Checks

    def check_closure(self) -> Check:
        """GL305: the dyad spans all distances; what does not close is refused before."""
        bar = self.bar
        links = (bar.coupler, bar.follower) if self.is_path else (bar.follower, bar.output)
        room = min(sum(links) - self.span_max, self.span_min - abs(links[0] - links[1]))
        low, high = math.degrees(self.span_min_at), math.degrees(self.span_max_at)
        text = (
            f"the five-bar stays closed: its dyad spans {self.span_min:.6g} mm (at {low:.5g} deg) to "
            f"{self.span_max:.6g} mm (at {high:.5g} deg) of the possible "
            f"{abs(links[0] - links[1]):.6g} to {sum(links):.6g} mm"
        )
        return CLOSURE.check("pass", text, room, 0.0, "mm")

    def check_target(self) -> Iterator[Check]:
        """GL307, where the file asks for points (with a tolerance) or positions."""
        if self.position_errors is not None:
            worst = math.degrees(max(self.position_errors, key=abs))
            yield target_check("the output angle of a position", worst, _POSITION_TOLERANCE, "deg")
        asked = None if self.spec.target is None else self.spec.target.function
        if asked is not None and asked.tolerance is not None and self.structural_error is not None:
            yield target_check("the function", math.degrees(self.structural_error), asked.tolerance, "deg")
        target, worst_point = self.spec.target, self.path_deviation_max
        if worst_point is not None and target is not None and target.tolerance is not None:
            yield target_check("a point of the path", worst_point, target.tolerance, "mm")

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: input and output gear with an idler between them."""
        for pair in self.layout.gear_pairs:
            tips = f"{pair.one.outer:.6g} and {pair.other.outer:.6g}"
            why = f"their axes are {pair.distance:.6g} mm apart, their tips reach {tips} mm"
            remedy = "lengthen the frame, as far as the idler reaches, or take smaller gears"
            yield collision_check(pair, self.spec.limits.gear_gap, why, remedy)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302."""
        return shaft_checks(self.layout)

    check_shaft_seat = shaft_seat

    def check_transmission_angle(self) -> Check:
        """GL303."""
        place = math.degrees(self.min_transmission_angle_at)
        remedy = (
            f"at input angle {place:.5g} deg; lengthen the two links of the dyad, or bring them nearer to each other"
        )
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)
