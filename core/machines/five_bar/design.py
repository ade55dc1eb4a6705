"""The geared five-bar as a design: a coupler point's path, or an output over the input angle."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from fractions import Fraction
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.candidates import Sought, nothing_sought, table
from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import GearlinkError, MissingSection, NoSolution, at_key
from gearlink.core.base.many_designs import column, hand_on, in_groups, sought, stacked
from gearlink.core.base.real_speed import OUTPUT_SPEEDS, OutputSpeed, RealSpeed, per_time
from gearlink.core.base.remedies.ways import down, either, modules, up
from gearlink.core.base.report import Check, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.base.wording import short
from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar, outputs
from gearlink.core.machines.five_bar.path import rates, spread
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.arrays import turn_degrees
from gearlink.core.numerics.motion_extremes import WithExtremes, extremes, names
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, TRAIN_CHECKS, Meshed, mesh_quantity, named, train_ways
from gearlink.core.parts.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.parts.linkages.checks import of_gears, target_check, transmission_check
from gearlink.core.parts.linkages.codes import CLOSURE, POSE_ORDER
from gearlink.core.parts.linkages.functions import Wanted
from gearlink.core.studies.clearance import (
    SHAFT_WAYS,
    Gear,
    Layout,
    Reach,
    WithShafts,
    collision_check,
    constant,
    crank_pin,
    least_shaft,
    ring_gear,
    shafts_at,
)

if TYPE_CHECKING:
    from gearlink.core.machines.five_bar.fit import Fit, TimedFit
    from gearlink.core.machines.five_bar.function_fit import FunctionFit, Round
    from gearlink.core.machines.five_bar.guidance import Guidance
    from gearlink.core.machines.five_bar.spec import GearedFiveBarSpec
    from gearlink.core.numerics.extremes import Extreme


def _path(design: GearedFiveBar) -> tuple[tuple[Gear, ...], dict[str, Reach]]:
    """Each gear is one body with its link; the idler turns on O in the frame."""
    reaches = {"AE": constant(design.frame_length)}
    first, *more = design.meshes.values()
    if first.internal:
        ring, pinion = ("A", "E") if design.signed_teeth[0] < 0 else ("E", "A")
        name = {"A": "the input gear", "E": "the output gear"}[pinion]
        return (
            ring_gear(ring, first, rim=design.outer_rim(design.mesh_names[0])),
            Gear(name, pinion, first.tip_radius[0], mates=ring, root=first.root_radius[0]),
        ), reaches
    driven = more[0] if more else first
    ends = (
        Gear("the input gear", "A", first.tip_radius[0], mates="O" if more else "E", root=first.root_radius[0]),
        Gear("the output gear", "E", driven.tip_radius[1], mates="O" if more else "A", root=driven.root_radius[1]),
    )
    if not more:
        return ends, reaches
    reaches |= {"AO": constant(design.center_distance[0]), "EO": constant(design.center_distance[1])}
    return (*ends, Gear("the idler", "O", first.tip_radius[1], root=first.root_radius[1])), reaches


def _function(design: GearedFiveBar) -> tuple[tuple[Gear, ...], dict[str, Reach]]:
    """The planet goes round the fixed gear as far as the range of the input takes it."""
    (mesh,), bar = design.meshes.values(), design.function_bar
    planet = Gear("the planet", "B", mesh.tip_radius[0], mates="A")
    rim = design.outer_rim(design.mesh_names[0])
    fixed = (
        ring_gear("A", mesh, rim=rim)
        if mesh.internal
        else Gear("the sun", "A", mesh.tip_radius[1], root=mesh.root_radius[1])
    )
    return (planet, fixed), {
        "AB": constant(bar.input),
        "AE": constant(bar.frame),
        "BE": crank_pin(bar.input, bar.frame, *design.input_range),
    }


_RATIOS = ((1, 1), (2, 1), (1, 2))
_CANDIDATES_LINKS = ("input_length", "coupler_length", "follower_length", "output_length", "frame_length", "phase")
_QUALITY = ("path_deviation_rms", "path_deviation_max", "structural_error", "min_transmission_angle")


MESHES = ("input_idler", "idler_output")
_TURN = 2.0 * math.pi
_PER_WAVE, _MOST = 360, 20_000


def path_extremes(bar: PathFiveBar, offset: complex) -> dict[str, float]:
    """Extremes of |M'| [mm/rad] and |M''| [mm/rad^2] over the period, and their input angles [rad].

    Parameters
        bar : PathFiveBar - it closes over its period
        offset : complex [mm] - u + i v
    Example
        >>> from fractions import Fraction
        >>> bar = PathFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))
        >>> round(path_extremes(bar, 60.0 + 0j)["velocity_max"], 6)
        58.52755
    """
    found = kept_last(lambda phi: rates(bar, phi, offset))
    curves = {"velocity": lambda phi: np.abs(found(phi)[0]), "acceleration": lambda phi: np.abs(found(phi)[1])}
    waves = bar.period_turns * max(1.0, abs(float(bar.ratio)))
    return extremes(curves, 0.0, bar.period, samples=min(_MOST, math.ceil(_PER_WAVE * waves)))


def function_extremes(bar: FunctionFiveBar, start: float, end: float) -> dict[str, float]:
    """Extremes of the output's speed and acceleration per input speed over a range, and their input angles [rad].

    Parameters
        start, end : float [rad] - it closes between them
    """
    rates = kept_last(bar.output_rates)
    curves = {"speed_ratio": lambda phi: rates(phi)[0], "acceleration_ratio": lambda phi: rates(phi)[1]}
    waves = float(np.max(end - start)) / _TURN * max(1.0, abs(bar.coupler_ratio))
    return extremes(curves, start, end, samples=max(64, min(_MOST, math.ceil(_PER_WAVE * waves))))


_SHOWN_TURNS = 100
_POSE_FIT = 1e-6
"""[mm, deg]"""
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


class GearedFiveBar(WithExtremes, OutputSpeed, RealSpeed, WithShafts, Meshed):
    """A five-bar whose gears take away one of its two freedoms."""

    kind = "geared-five-bar"
    spec: GearedFiveBarSpec
    keys = {
        "analyze": (
            *("structural_error", "position_errors", "path_deviation_max", "path_deviation_rms"),
            *(("min_transmission_angle", ">limits.transmission_angle"), "path_width", "path_height", "point_speed_max"),
            *("point_acceleration_max", "input_length", "coupler_length", "follower_length", "output_length"),
            *("frame_length", "phase", "speed_ratio_max", "speed_ratio_min"),
        )
    }
    outlines = {
        "analyze": Outline(
            (
                *("form", "five_bar_ratio", "coupler_ratio", "period_turns", "input_length", "coupler_length"),
                *("follower_length", "output_length", "frame_length", "phase", "assembly", "point_along"),
                *("point_across", "span_min", "span_min_at", "span_max", "span_max_at", "min_transmission_angle"),
                *("min_transmission_angle_at", *_OF_PATH, *_OF_FUNCTION, "path_width", "path_height", "phase_step"),
                *("path_deviation_rms", "path_deviation_max", "pose_error_max", "pose_error_rms"),
                *("pose_angle_error_max", "body_angle", "frame_place", "frame_direction", "position_errors"),
                *("structural_error", "structural_error_at", "error_extremes", "function_start", "output_zero"),
                *("starts_tried", "first_point_angle", "center_distance", "gear_gap", "contact_ratio", "input_speed"),
                *("turn_time", "point_speed_max", "point_speed_min", "point_acceleration_max", *OUTPUT_SPEEDS),
            ),
            (
                *("closure", "target", "pose-order", "gear-collision", "shaft-clearance", "shaft-seat"),
                *("transmission-angle", *MESH_CHECKS, "backlash"),
            ),
            ("path", "function", "deviations", "poses", "structural_error", "search"),
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

    form: str = placed("spec.form")
    input_length: float = placed("bar.input")
    coupler_length: float = placed("bar.coupler")
    follower_length: float = placed("bar.follower")
    output_length: float = placed("bar.output")
    frame_length: float = placed("bar.frame")
    phase: float = placed("bar.phase")
    assembly: int = placed("bar.assembly")

    extreme_names = (*_OF_PATH, *_OF_FUNCTION)
    at_once = 64

    @classmethod
    def find_together(cls, designs: Sequence[GearedFiveBar], names: Sequence[str]) -> None:
        """Extremes of the motion, and how far paths extend."""
        closed = [design for design in designs if _closes(design)]
        for group in in_groups(closed, lambda design: (design.is_path, design.ratio, design.spec.assembly)):
            sought(partial(_find_extremes, frozenset(names)), group)

    point_speed_max: float | None = per_time("velocity_max", 1)
    point_speed_min: float | None = per_time("velocity_min", 1)
    point_acceleration_max: float | None = per_time("acceleration_max", 2)

    ways = {
        "transmission-angle": (
            up("links.follower", "links.output"),
            *(*_LINKS, *either("phase", step=1.0), *_FEWER, *_TEETH, *modules("gears.module")),
        ),
        "shaft-clearance": (*SHAFT_WAYS, *_LINKS, *_FEWER, *_TEETH, *modules("gears.module")),
        "gear-collision": (up("links.frame"), *_FEWER, *_TEETH, *modules("gears.module")),
        **train_ways(3, up("gears.input", "gears.output", step=1), *_TEETH),
    }

    @property
    def is_path(self) -> bool:
        """Whether the coupler point's path counts."""
        return self.spec.form == "path"

    def completion(self) -> Iterator[Found]:
        """The links that were found instead of the target."""
        target = self.spec.target
        if target is None or (target.function is not None and target.function.links == "given"):
            return
        bar, why = self.bar, "found for target"
        names = ("input", "coupler", "follower", "output", "frame")
        yield Found("links", {name: float(getattr(bar, name)) for name in names}, why)
        yield Found("phase", math.degrees(math.remainder(bar.phase, _TURN)), why)
        yield Found("assembly", bar.assembly, why)
        if self.is_path:
            yield Found("coupler_point", {"along": self.offset.real, "across": self.offset.imag}, why)
        else:
            start, end = (math.degrees(angle) for angle in self.input_range)
            yield Found("range", {"start": start, "end": end}, "from target" if self.spec.range is None else "")
        yield Found("target", None)

    def as_found(self) -> Iterator[Found]:
        """The links; a function that was to be generated goes on judging them."""
        target = self.spec.target
        for one in self.completion():
            judged = one.path == "target" and target is not None and target.function is not None
            yield Found("target.function.links", "given") if judged else one

    # Gears

    own_quantities = frozenset(("center_distance", "contact_ratio"))

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Input, idler and output gear of a path, planet and fixed gear of a function."""
        gears = self.spec.gears
        teeth = [getattr(gears, name) or 0 for name in gears.gear_names()]
        return tuple(-z if ring else z for z, ring in zip(teeth, gears.rings(), strict=True))

    @property
    def output_play(self) -> tuple[float, float] | None:
        """Free turn of the output gear of a path [rad]; the output of a function is a link."""
        return super().output_play if self.is_path else None

    @property
    def mesh_names(self) -> tuple[str, ...]:
        """Both meshes of an idler, or the only one."""
        return MESHES if self.spec.gears.idler is not None else ("",)

    @property
    def given_distances(self) -> tuple[float | None, ...]:
        """Frame of a path with gears in direct mesh, input of a function, where the file gives it."""
        links = self.spec.links
        if self.spec.gears.idler is not None:
            return None, None
        return (links.frame if self.is_path else links.input,)

    @property
    def center_distance(self) -> list[float]:  # type: ignore[override]  # one for each mesh
        """Centre distance of each mesh [mm]."""
        return [abs(mesh.center_distance) for mesh in self.meshes.values()]

    @property
    def contact_ratio(self) -> list[float] | None:  # type: ignore[override]
        """Contact ratio of each mesh; None where a ring's tips have no involute."""
        with at_key("gears"):
            found = [mesh_quantity(mesh, "contact_ratio") for mesh in self.meshes.values()]
        return None if None in found else found

    @property
    def ratio(self) -> Fraction:
        """Path: k, output over input speed. Function: m, coupler over input speed."""
        gears = self.spec.gears
        if self.is_path:
            same = gears.idler is not None or gears.mesh == "internal"
            return Fraction(gears.input or 0, gears.output or 1) * (1 if same else -1)
        turn = Fraction(gears.ring or gears.sun or 0, gears.planet or 1)
        return 1 - turn if gears.ring is not None else 1 + turn

    @property
    def five_bar_ratio(self) -> float | None:
        """k of the path form."""
        return float(self.ratio) if self.is_path else None

    @property
    def coupler_ratio(self) -> float | None:
        """m of the function form."""
        return None if self.is_path else float(self.ratio)

    period_turns: int = placed("ratio.denominator")

    @property
    def phase_step(self) -> float | None:
        """Step in which the phase can be set by putting the gears together a tooth on [rad]."""
        return _TURN / self.spec.gears.output if self.is_path and self.spec.gears.output else None

    # Links

    def _fixed_length(self, name: str) -> float:
        """The link that is the gears' centre distance; given too, it must agree."""
        return of_gears(name, getattr(self.spec.links, name), self.center_distance[0], self.spec.gears)

    def _frame(self) -> float:
        """The frame of the path form."""
        links = self.spec.links
        if self.spec.gears.idler is None:
            return self._fixed_length("frame")
        frame, (first, second) = links.frame or 0.0, self.center_distance
        if not abs(first - second) < frame < first + second:
            raise NoSolution(
                f"the idler does not reach: its centre distances are {first:g} and {second:g} mm, so the "
                f"frame must lie between {abs(first - second):g} and {first + second:g} mm, not {frame:g}",
                key="links.frame",
                fix="change the idler",
            )
        return frame

    @cached_property
    def start_path(self) -> PathFiveBar:
        """The five-bar of the file, path form; with a target it is the start."""
        links = self.spec.links
        lengths = (links.input or 0.0, links.coupler, links.follower, links.output, self._frame())
        with at_key("links"):
            return PathFiveBar(*lengths, self.ratio, math.radians(self.spec.phase), self.spec.assembly)

    @property
    def _least_angle(self) -> float:
        """Limit of the transmission angle [rad]."""
        return math.radians(self.spec.limits.transmission_angle)

    @cached_property
    def fit(self) -> Fit | None:
        """What the synthesis of a path found, where the file asks for one."""
        target = self.spec.target
        if not self.is_path or target is None or target.points is None:
            return None
        from gearlink.core.machines.five_bar.fit import fit_path

        if self.timed_fit is not None:
            return self.timed_fit.fit
        points = np.array([complex(x, y) for x, y in target.points])
        with at_key("target.points"):
            return fit_path(self.start_path, self._start_offset, points, self._least_angle)

    @cached_property
    def timed_fit(self) -> TimedFit | None:
        """What the synthesis of timed points found, where the file asks for one."""
        target = self.spec.target
        if target is None or target.points is None or target.input_angles is None:
            return None
        from gearlink.core.machines.five_bar.fit import fit_timed

        points = np.array([complex(x, y) for x, y in target.points])
        angles = np.radians(target.input_angles)
        with at_key("target.points"):
            return fit_timed(self.start_path, self._start_offset, points, angles, self._least_angle, target.budget)

    @property
    def _start_offset(self) -> complex:
        point = self.spec.coupler_point
        return 0j if point is None else complex(point.along, point.across)

    @cached_property
    def path_bar(self) -> PathFiveBar:
        """The five-bar of the path form, given or found; it closes over its whole period."""
        found = self.guidance or self.fit
        bar = self.start_path if found is None else found.bar
        with at_key("links" if self.guidance is None else "target.poses"):
            bar.closure()
        return bar

    @property
    def offset(self) -> complex:
        """The coupler point, u + i v [mm]."""
        found = self.guidance or self.fit
        return self._start_offset if found is None else found.offset

    # Guidance of a body

    @cached_property
    def guidance(self) -> Guidance | None:
        """What takes a body through the poses of the file; None without them."""
        target = self.spec.target
        if target is None or target.poses is None:
            return None
        from gearlink.core.machines.five_bar.guidance import Task, guide

        places = np.array([complex(x, y) for x, y, _ in target.poses])
        angles = np.radians([angle for _, _, angle in target.poses])
        free = target.frame == "free"
        task = Task(places, angles, self.start_path, frozenset(target.keep), free, self._least_angle)
        with at_key("target.poses"):
            return guide(task)

    @property
    def pose_error_max(self) -> float | None:
        """Maximum distance of the body's point from a pose [mm]."""
        return None if self.guidance is None else float(self.guidance.position_errors.max())

    @property
    def pose_error_rms(self) -> float | None:
        """Root of the mean square of these distances [mm]."""
        return None if self.guidance is None else math.sqrt(float((self.guidance.position_errors**2).mean()))

    @property
    def pose_angle_error_max(self) -> float | None:
        """Maximum angle by which the body misses a pose [rad]."""
        return None if self.guidance is None else float(self.guidance.angle_errors.max())

    body_angle: float | None = placed("guidance.body_angle")

    @property
    def _of_free_frame(self) -> Guidance | None:
        target = self.spec.target
        return None if target is None or target.frame == "fixed" else self.guidance

    @property
    def frame_place(self) -> list[float] | None:
        """Place of A in the coordinates of the poses, where the frame is free [mm]."""
        found = self._of_free_frame
        return None if found is None else [found.place.real, found.place.imag]

    frame_direction: float | None = placed("_of_free_frame.direction")

    def table_poses(self, _samples: int | None = None) -> Table:
        """The poses, with the input angle of each and what is missed."""
        found = self.guidance
        if found is None:
            raise MissingSection("the table poses needs target.poses: [[x, y, angle], ...]", key="target")
        task = found.task
        columns = {
            "x": (task.places.real, "mm"),
            "y": (task.places.imag, "mm"),
            "angle": (np.degrees(task.angles), "deg"),
            "input_angle": (np.degrees(found.inputs), "deg"),
            "position_error": (found.position_errors, "mm"),
            "angle_error": (np.degrees(found.angle_errors), "deg"),
        }
        return Table.of("poses", columns)

    def check_pose_order(self) -> Iterator[Check]:
        """GL340."""
        found = self.guidance
        if found is None:
            return
        what, fix = "the poses follow each other in one assembly of the links", ""
        if not found.in_order:
            what, fix = "the input angles neither rise nor fall in the order of the poses", "reorder target.poses"
        elif len(set(found.assemblies)) > 1:
            what, fix = "two poses need different assemblies of the links", "change a pose"
        fix = f"{fix}, or list fewer links in target.keep" if fix else ""
        yield POSE_ORDER.check("fail" if fix else "pass", what, fix=fix)

    @cached_property
    def positions(self) -> list[tuple[float, float]] | None:
        """Pairs of input and output angle that are asked for [rad]."""
        target = self.spec.target
        if target is None or target.positions is None:
            return None
        return [(math.radians(phi), math.radians(psi)) for phi, psi in target.positions]

    @cached_property
    def wanted(self) -> Wanted | None:
        """The function that is asked for."""
        target = self.spec.target
        if target is None or target.function is None:
            return None
        with at_key("target.function.x"):
            return Wanted.of(target.function)

    @cached_property
    def function_fit(self) -> FunctionFit | None:
        """What the synthesis of a function found, or how far given links are from it."""
        target, wanted = self.spec.target, self.wanted
        if wanted is None or target is None or target.function is None:
            return None
        from gearlink.core.machines.five_bar.function_fit import FunctionFit, fit_function
        from gearlink.core.machines.five_bar.function_motion import structural_error

        if target.function.links == "given":
            start = math.radians(self.spec.range.start) if self.spec.range is not None else 0.0
            with at_key("links"):
                return FunctionFit(self.start_function, start, structural_error(self.start_function, start, wanted), ())
        with at_key("target.function"):
            return fit_function(self.start_function, 0.0, wanted, self._least_angle, target.budget)

    @cached_property
    def start_function(self) -> FunctionFiveBar:
        """The five-bar of the file, function form; with a target it is the start."""
        links = self.spec.links
        lengths = (self._fixed_length("input"), links.coupler, links.follower, links.output, links.frame or 0.0)
        with at_key("links"):
            return FunctionFiveBar(*lengths, float(self.ratio), math.radians(self.spec.phase), self.spec.assembly)

    @cached_property
    def function_bar(self) -> FunctionFiveBar:
        """The five-bar of the function form, given or found; it closes over the range."""
        if self.function_fit is not None:
            return self.function_fit.bar
        bar, positions = self.start_function, self.positions
        if positions is not None:
            with at_key("target.positions"):
                from gearlink.core.machines.five_bar.function_fit import five_bar_for_positions

                bar = five_bar_for_positions(bar, positions, self._least_angle)
        with at_key("range" if self.spec.range is not None else "links"):
            bar.closure(*self.input_range)
        return bar

    @cached_property
    def input_range(self) -> tuple[float, float]:
        """Input angles of the function form [rad]: given, from the first position to the last, or one period."""
        asked = self.spec.range
        if self.function_fit is not None and self.wanted is not None:
            return self.function_fit.start, self.function_fit.start + self.wanted.input_swing
        if asked is not None:
            return math.radians(asked.start), math.radians(asked.end)
        if self.positions is not None:
            return self.positions[0][0], self.positions[-1][0]
        return 0.0, _TURN * self.period_turns

    @property
    def bar(self) -> PathFiveBar | FunctionFiveBar:
        """The five-bar of either form."""
        return self.path_bar if self.is_path else self.function_bar

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
    def _point(self) -> complex | None:
        return self.offset if self.is_path else None

    point_along: float | None = placed("_point.real")
    point_across: float | None = placed("_point.imag")

    @cached_property
    def motion_extremes(self) -> dict[str, float]:
        """Extremes of the point's speed and acceleration [mm/rad, mm/rad^2], or of the output's, and their places."""
        if self.is_path:
            return path_extremes(self.path_bar, self.offset)
        return function_extremes(self.function_bar, *self.input_range)

    # Closing

    @cached_property
    def _spans(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Minimum and maximum distance that the dyad spans, each with its input angle."""
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
        return spread(self.path_bar, self.offset)

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
        """Maximum distance of a point from the path [mm]."""
        return None if self.fit is None else float(self.fit.distance.max())

    @cached_property
    def position_errors(self) -> list[float] | None:
        """Output angle reached less that asked for, at each position [rad]."""
        if self.positions is None or self.is_path:
            return None
        return self.function_bar.position_errors(self.positions)

    @cached_property
    def layout(self) -> Layout:
        """The bodies in the plane of the gears."""
        spec, (gears, reaches) = self.spec, _path(self) if self.is_path else _function(self)
        shafts = shafts_at("AE" if spec.gears.idler is None else "AEO", spec.shafts)
        return Layout(gears, shafts, reaches, least_shaft(spec.limits, spec.gears.module))

    gear_gap: float | None = placed("layout.gear_gap")
    structural_error: float | None = placed("function_fit.error.greatest")
    error_extremes: int | None = placed("function_fit.error.alternations")
    function_start: float | None = placed("function_fit.start")
    first_point_angle: float | None = placed("timed_fit.first_angle")
    output_zero: float | None = placed("function_fit.error.zero")

    @property
    def structural_error_at(self) -> list[float] | None:
        """Input angles at which the structural error is largest [rad]."""
        found, wanted = self.function_fit, self.wanted
        if found is None or wanted is None:
            return None
        rows = zip(found.error.places, found.error.errors, strict=True)
        most = found.error.greatest * (1.0 - 1e-9)
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

    extra_tables = ("drawing", "factors", "candidates")

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The target met with other gears side by side."""
        if self.spec.target is None:
            raise nothing_sought("give target: points, positions or a function")
        one, *_, other = self.spec.gears.gear_names()
        own = getattr(self.spec.gears, one), getattr(self.spec.gears, other)
        keys = {f"gears.{name}": (f"{name}_teeth", "1") for name in (one, other)} | {"assembly": ("assembly", "1")}
        teeth = list(dict.fromkeys((own, *((min(own) * p, min(own) * q) for p, q in _RATIOS))))
        # Each row is a search of its own; that of a function takes seconds: it keeps to the file's assembly.
        sides = (1, -1) if self.is_path else (self.spec.assembly,)
        rows = [(*pair, side) for pair in teeth for side in sides]
        return table(self, Sought("analyze", keys, rows, (*_CANDIDATES_LINKS, *_QUALITY)))

    def table_names_shown(self) -> tuple[str, ...]:
        """The tables of this form."""
        target = self.spec.target
        if self.is_path:
            poses = target is not None and target.poses is not None
            shown = {"path": True, "deviations": self.fit is not None, "poses": poses}
        else:
            shown = {"function": True, "structural_error": self.wanted is not None}
        return tuple(name for name, there in {**shown, "search": self.searches}.items() if there)

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

    def table_path(self, samples: int | None = None) -> Table:
        """Coupler point, its speed and the links over the period, or the first hundred turns of a longer one."""
        from gearlink.core.mechanism.courses import Shown, between, coordinate, motion_table, turned

        x, y = (coordinate("coupler", "M", along) for along in (1.0 + 0j, 1j))
        shown = [
            Shown("output_angle", turned("output")),
            Shown("coupler_angle", turned("coupler")),
            Shown("x", x),
            Shown("y", y),
            Shown("x_velocity", x, 1, "point_x_velocity"),
            Shown("y_velocity", y, 1, "point_y_velocity"),
            Shown("x_acceleration", x, 2, "point_x_acceleration"),
            Shown("y_acceleration", y, 2, "point_y_acceleration"),
            Shown("transmission_angle", between("coupler", "follower")),
        ]
        return motion_table("path", self, shown, samples, degrees=turn_degrees(samples, self.shown_turns))

    def table_deviations(self, _samples: int | None = None) -> Table:
        """Every required point and its distance from the path."""
        target, fit = self.spec.target, self.fit
        assert target is not None, "shown only with a fit"
        assert target.points is not None, "shown only with a fit"
        assert fit is not None, "shown only with a fit"
        x, y = zip(*target.points, strict=True)
        columns: dict[str, tuple[Any, str]] = {"x": (x, "mm"), "y": (y, "mm"), "distance": (fit.distance, "mm")}
        if self.timed_fit is not None and target.input_angles is not None:
            first = math.degrees(self.timed_fit.first_angle)
            columns = {"input_angle": ([first + angle for angle in target.input_angles], "deg"), **columns}
        return Table.of("deviations", columns)

    def table_search(self, _samples: int | None = None) -> Table:
        """What the search had reached after each of its rounds."""
        rounds, unit = self.search_rounds, "mm" if self.is_path else "deg"
        error = [each.error if self.is_path else math.degrees(each.error) for each in rounds]
        return Table.of("search", {"starts": ([each.starts for each in rounds], "1"), "error": (error, unit)})

    def table_function(self, samples: int | None = None) -> Table:
        """Output angle and speed over the range of the input, both ends included."""
        from gearlink.core.mechanism.courses import motion_table, of_output, turned

        start, end = self.input_range
        rows = row_numbers(samples, (count := samples or 180) + 1)
        angles = [start + (end - start) * i / count if i < count else end for i in rows]
        return motion_table("function", self, of_output(turned("output")), samples, degrees=np.degrees(angles))

    def table_structural_error(self, samples: int | None = None) -> Table:
        """Output angle, what it should be, and the difference, over the interval of the function."""
        found, wanted = self.function_fit, self.wanted
        assert found is not None, "shown only with a function"
        assert wanted is not None, "shown only with a function"
        s = np.linspace(0.0, 1.0, (samples or 60) + 1)
        fine = np.linspace(0.0, 1.0, 721)
        phi = found.start + wanted.input_swing * np.concatenate([fine, s])
        order = np.argsort(phi, kind="stable")
        reached = np.empty(phi.size)
        reached[order] = outputs(found.bar, phi[order])
        output, asked = reached[fine.size :], found.error.zero + wanted.output(s)
        turns = 2.0 * math.pi * round(float(output[0] - asked[0]) / (2.0 * math.pi))
        columns = {
            "input_angle": (np.degrees(phi[fine.size :]), "deg"),
            "output_angle": (np.degrees(output - turns), "deg"),
            "wanted_angle": (np.degrees(asked), "deg"),
            "error": (np.degrees(output - turns - asked), "deg"),
        }
        return Table.of("structural_error", columns)

    # Checks

    def check_closure(self) -> Check:
        """GL305: the dyad spans all distances; what does not close is refused before."""
        bar = self.bar
        links = (bar.coupler, bar.follower) if self.is_path else (bar.follower, bar.output)
        room = min(sum(links) - self.span_max, self.span_min - abs(links[0] - links[1]))
        possible = f"{short(abs(links[0] - links[1]))} to {short(sum(links))} mm"
        aside = f"span of the dyad {short(self.span_min)} to {short(self.span_max)} mm, possible {possible}"
        return CLOSURE.check("pass", "margin of the dyad's span to its limits", room, 0.0, "mm", aside=aside)

    def _pose_checks(self) -> Iterator[Check]:
        """The place of every pose, and its angle where the poses are met exactly or the file limits it."""
        target, place, angle = self.spec.target, self.pose_error_max, self.pose_angle_error_max
        if target is None or place is None or angle is None:
            return
        yield target_check("the position of a pose", place, target.tolerance or _POSE_FIT, "mm", "target.tolerance")
        limit = target.angle_tolerance or (_POSE_FIT if target.tolerance is None else None)
        if limit is not None:
            yield target_check("the angle of a pose", math.degrees(angle), limit, "deg", "target.angle_tolerance")

    def check_target(self) -> Iterator[Check]:
        """GL307, where the file asks for points (with a tolerance) or positions."""
        if self.position_errors is not None:
            worst = math.degrees(max(self.position_errors, key=abs))
            yield target_check("the output angle from a position", worst, _POSITION_TOLERANCE, "deg")
        yield from self._pose_checks()
        asked = None if self.spec.target is None else self.spec.target.function
        if asked is not None and asked.tolerance is not None and self.structural_error is not None:
            key = "target.function.tolerance"
            yield target_check("the function", math.degrees(self.structural_error), asked.tolerance, "deg", key)
        target, worst_point = self.spec.target, self.path_deviation_max
        if worst_point is not None and target is not None and target.tolerance is not None:
            yield target_check("the path from a point", worst_point, target.tolerance, "mm", "target.tolerance")

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: input and output gear with an idler between them."""
        for pair in self.layout.gear_pairs:
            why, remedy = f"axes {short(pair.distance)} mm apart", "lengthen the frame, as far as the idler reaches"
            yield collision_check(pair, self.spec.limits.gear_gap, why, remedy)

    def check_transmission_angle(self) -> Check:
        """GL303: its last two links are folded where the pins are nearest to each other, else stretched."""
        place, links = self.min_transmission_angle_at, "coupler and follower" if self.is_path else "follower and output"
        folded = abs(place - self.span_min_at) <= abs(place - self.span_max_at)
        change = f"{'shorten' if folded else 'lengthen'} {links}"
        if self._fits:
            change = "start from other links, or use other gears; the target determines the links"
        limit, at = self.spec.limits.transmission_angle, f"input angle {short(math.degrees(place))} deg"
        return transmission_check(self.min_transmission_angle, limit, change, at=at)


def _closes(design: GearedFiveBar) -> bool:
    """Whether there is a five-bar; what is wrong with another it says itself."""
    with suppress(GearlinkError):
        return bool(design.bar)
    return False


_OF_EXTREMES = {
    *GearedFiveBar.extreme_names, *OUTPUT_SPEEDS, "point_speed_max", "point_speed_min", "point_acceleration_max"
}  # fmt: skip


def _find_extremes(asked: frozenset[str], designs: Sequence[GearedFiveBar]) -> None:
    moving, many = not asked.isdisjoint(_OF_EXTREMES), stacked([design.bar for design in designs])
    if isinstance(many, FunctionFiveBar):
        start, end = (column(ends) for ends in zip(*(design.input_range for design in designs), strict=True))
        if moving:
            hand_on(designs, motion_extremes=function_extremes(many, start, end))
        return
    offset = column([design.offset for design in designs])
    if moving:
        hand_on(designs, motion_extremes=path_extremes(many, offset))
    if not asked.isdisjoint(("path_width", "path_height")):
        hand_on(designs, _extent=spread(many, offset))
