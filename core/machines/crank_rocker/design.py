"""The crank-rocker as a design: analysis of given links. Its syntheses: `synthesis`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.real_speed import OutputSpeed, RealSpeed, per_time
from gearlink.core.base.remedies.ways import either
from gearlink.core.base.report import Check, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.mechanism.courses import Shown, all_rates, between, coordinate, motion_table, of_output, turned
from gearlink.core.mechanism.dual import longer
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.numerics.motion_extremes import extremes, names
from gearlink.core.parts.linkages.checks import check_linkage, transmission_check
from gearlink.core.parts.linkages.dyad import acute
from gearlink.core.parts.linkages.fourbar import sweep
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.parts.linkages.fourbar.nearest_passes import joint_to_crank_pivot
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarState, solve
from gearlink.core.parts.linkages.geared_output import GearedOutput, Shares
from gearlink.core.parts.linkages.standstills import OutputRates, Turning
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.crank_rocker.spec import CrankRockerSpec
    from gearlink.core.numerics.arrays import Reals


TURN = 2.0 * math.pi
LENGTHS = ("crank_length", "coupler_length", "rocker_length", "frame_length")
ROCKER_SPEEDS = ("rocker_speed_max", "rocker_speed_min", "rocker_acceleration_max", "rocker_acceleration_min")
MOTION = (
    *("rocker_swing", "quick_return_ratio", "outer_dead_center", "inner_dead_center", "min_transmission_angle"),
    *(*names("speed_ratio"), *names("acceleration_ratio"), "input_speed", "turn_time", *ROCKER_SPEEDS),
)
QUANTITIES = (*LENGTHS, *MOTION)
_LINKS = either("links.crank", "links.coupler", "links.rocker", "links.frame")


class DeadCenters:
    """The dead centres of a crank-rocker.

    Fields
        outer, inner : float [rad] - crank angles with crank and coupler stretched, and folded over each other
        swing : float [rad] - of the rocker between them
        ratio : float - time of the slow over the fast stroke, 1 or more
        same : bool - whether the rocker turns with the crank in the slow stroke
    """

    def __init__(self, linkage: FourBar) -> None:
        near, far = joint_to_crank_pivot(linkage)
        self.outer, self.inner = far.crank_angle, near.crank_angle
        turned = solve(linkage, self.inner).rocker_angle - solve(linkage, self.outer).rocker_angle
        to_inner = (self.inner - self.outer) % TURN
        strokes = sorted((to_inner, TURN - to_inner))
        self.swing, self.ratio = abs(turned), strokes[1] / strokes[0]
        self.same = (turned > 0.0) is (to_inner >= math.pi)


class CrankRocker(OutputRates, OutputSpeed, RealSpeed, Design):
    """A four-bar whose rocker is the output, of given links; the syntheses replace `linkage`."""

    kind = "crank-rocker"
    spec: CrankRockerSpec
    keys = {
        "analyze": (
            *("rocker_swing", "quick_return_ratio", ("min_transmission_angle", ">limits.transmission_angle")),
            *("rocker_speed_max", "rocker_speed_min", "outer_dead_center", "inner_dead_center"),
            *("rocker_acceleration_max", "rocker_acceleration_min", "speed_ratio_max", "speed_ratio_min"),
            "acceleration_ratio_max",
        )
    }
    outlines = {"analyze": Outline(QUANTITIES, ("transmission-angle",), ("motion",))}
    extra_tables = ("links", "path")
    requirements = Design.requirements | {"swing.angle", "swing.quick_return_ratio", "function.pairs"}
    ways = {"transmission-angle": _LINKS}

    def outline(self, command: str) -> Outline:
        """With a point on the coupler, an analysis shows its path."""
        found = self.outlines[command]
        return found if self.spec.coupler_point is None else found._replace(tables=(*found.tables, "path"))

    # Links

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar of the file; without a range its crank turns fully."""
        links = self.spec.links
        if links is None:
            raise MissingSection(self._without_links(), key="links")
        linkage = FourBar(links.crank, links.coupler, links.rocker, links.frame, self.spec.assembly)
        if self.spec.range is None:
            try:
                check_linkage(linkage)
            except NoSolution as error:
                reach = "" if linkage.kind() == "impossible" else _reach(linkage)
                fix = f"set range to {reach}" if reach else error.fix
                raise NoSolution(error.message, key="links", fix=fix) from error
        return linkage

    def _without_links(self) -> str:
        asked = [f"`{command}`" for command in self.spec.syntheses()]
        text = "the command needs the section links: {crank, coupler, rocker, frame} (mm)"
        if len(asked) > 1:
            return f"{text}; {' or '.join(asked)} finds it\nkeep one of their sections"
        return f"{text}\nadd links, or a section swing or function and its synthesis"

    crank_length: float = placed("linkage.crank")
    coupler_length: float = placed("linkage.coupler")
    rocker_length: float = placed("linkage.rocker")
    frame_length: float = placed("linkage.frame")

    @property
    def traced(self) -> tuple[str, ...]:
        """The coupler point, where the file has one."""
        return () if self.spec.coupler_point is None else ("P",)

    @property
    def coupler_point(self) -> complex | None:
        """The point of the coupler whose path is wanted, in its coordinates [mm]."""
        return None if self.spec.coupler_point is None else complex(*self.spec.coupler_point)

    # Motion

    @cached_property
    def crank_range(self) -> tuple[float, float] | None:
        """Crank angles [rad] between which the linkage moves; None where it turns.

        Raises
            NoSolution - where it does not close between them
        """
        if self.spec.range is None:
            return None
        start, end = (math.radians(angle) for angle in self.spec.range)
        with at_key("range"):
            for angle in inner_places(start, end):
                solve(self.linkage, angle, order=1)
        return start, end

    def state(self, crank_angle: float, order: int = 0) -> FourBarState[float]:
        """The linkage at a crank angle [rad], with rates by it."""
        return solve(self.linkage, crank_angle, order)

    @cached_property
    def dead_centers(self) -> DeadCenters | None:
        """Dead centres of the rocker; None where it has not both."""
        return DeadCenters(self.linkage) if self.linkage.kind() == "crank-rocker" else None

    outer_dead_center: float | None = placed("dead_centers.outer")
    inner_dead_center: float | None = placed("dead_centers.inner")
    quick_return_ratio: float | None = placed("dead_centers.ratio")
    rocker_swing: float | None = placed("dead_centers.swing")

    @property
    def min_transmission_angle(self) -> float:
        """Least transmission angle of a revolution or the range [rad]: at an end, or with crank and frame in line.

        Source
            |BD| runs one way between crank angles 0 and 180 deg
        """
        if self.crank_range is None:
            return self.linkage.min_transmission_angle()
        return min(acute(self.state(angle).transmission_angle) for angle in inner_places(*self.crank_range))

    @property
    def turning(self) -> GearedOutput:
        """The rocker as the output, of a crank that turns."""
        return GearedOutput(self.linkage, Shares(0.0, 0.0, 1.0))

    @cached_property
    def speed_turnings(self) -> list[Turning]:
        """Extremes of the speed ratio over the revolution, or over the range with its ends."""
        if self.crank_range is None:
            return self.turning.speed_turnings
        return self._within("speed_ratio", "rocker_velocity", 1)

    @cached_property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of the acceleration ratio, likewise."""
        if self.crank_range is None:
            return self.turning.acceleration_turnings
        return self._within("acceleration_ratio", "rocker_acceleration", 2)

    def _within(self, name: str, rate: str, order: int) -> list[Turning]:
        assert self.crank_range is not None
        curve = {name: lambda phi: getattr(sweep.solve(self.linkage, phi, order), rate)}
        found = extremes(curve, *self.crank_range)
        return [Turning(found[f"{name}_{side}_at"], found[f"{name}_{side}"]) for side in ("max", "min")]

    rocker_speed_max: float | None = per_time("speed_ratio_max", 1)
    rocker_speed_min: float | None = per_time("speed_ratio_min", 1)
    rocker_acceleration_max: float | None = per_time("acceleration_ratio_max", 2)
    rocker_acceleration_min: float | None = per_time("acceleration_ratio_min", 2)

    # Tables

    def table_motion(self, samples: int | None = None) -> Table:
        """The rocker over a revolution of the crank, or over its range with both ends."""
        shown = of_output(rocker(self), "rocker_angle", "rocker")
        return self._over("motion", [*shown, Shown("transmission_angle", between("coupler", "rocker"))], samples)

    def table_links(self, samples: int | None = None) -> Table:
        """Angle, speed, acceleration and jerk of coupler and rocker."""
        return self._over("links", all_rates({"coupler": turned("coupler"), "rocker": rocker(self)}), samples)

    def table_path(self, samples: int | None = None) -> Table:
        """Path of the coupler point: its position, speed by the crank angle, and radius of curvature.

        The radius is positive where the path curves to the left of its way, and null where it is straight.
        """
        self.require_table("path")
        x, y = (coordinate("coupler", "P", along) for along in (1.0 + 0j, 1j))
        shown = [Shown(f"{name}{order}", course, order) for name, course in (("x", x), ("y", y)) for order in range(3)]
        whole = self._over("rates", shown, samples)
        data = {name: np.asarray(whole[name]) for name in whole.columns}
        speed = np.hypot(data["x1"], data["y1"])
        bend = data["x1"] * data["y2"] - data["y1"] * data["x2"]
        with np.errstate(divide="ignore"):
            radius = np.where(bend == 0.0, np.nan, speed**3 / bend)
        columns = {
            "crank_angle": (data["crank_angle"], "deg"),
            "x": (data["x0"], "mm"),
            "y": (data["y0"], "mm"),
            "speed": (speed, "mm/rad"),
            "curvature_radius": (radius, "mm"),
        }
        return Table.of("path", columns)

    def require_table(self, name: str, /) -> None:
        """A path needs the point."""
        if name == "path" and self.spec.coupler_point is None:
            raise MissingSection("the table path needs coupler_point: [x, y] (mm)", key="coupler_point")

    def _over(self, name: str, shown: Any, samples: int | None) -> Table:
        degrees = None
        if self.crank_range is not None:
            start, end = self.spec.range or (math.degrees(angle) for angle in self.crank_range)
            count = samples or 180
            rows = row_numbers(samples, count + 1)
            degrees = np.array([start + (end - start) * i / count if i < count else end for i in rows])
        return motion_table(name, self, shown, samples, degrees=degrees)

    # Checks

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303."""
        what = f"minimum transmission angle over the {'revolution' if self.crank_range is None else 'range'}"
        limit = self.spec.limits.transmission_angle
        yield transmission_check(self.min_transmission_angle, limit, self.remedy, what)

    remedy = "shorten the crank, or bring coupler and rocker nearer to a right angle"


def _reach(linkage: FourBar) -> str:
    """The range of crank angles in which a four-bar closes whose crank does not turn fully; "" where it does.

    BD^2 = a^2 + d^2 - 2 a d cos phi,  |b - c| <= BD <= b + c
    """
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame

    def angle(apart: float) -> float:
        return math.degrees(math.acos((a * a + d * d - apart * apart) / (2.0 * a * d)))

    far = angle(b + c) if b + c < a + d else None
    near = angle(abs(b - c)) if abs(b - c) > abs(a - d) else None
    if near is None:
        return "" if far is None else f"[{safely_above(-far)}, {safely_below(far)}]"
    return f"[{safely_above(near)}, {safely_below(360.0 - near if far is None else far)}]"


def inner_places(start: float, end: float) -> list[float]:
    """The ends of a range of crank angles [rad], and where the crank lies on the line of the frame between them.

    Raises
        NoSolution - for a range of no length

    Example
        >>> [round(x, 3) for x in inner_places(1.0, 7.0)]
        [1.0, 3.142, 6.283, 7.0]
    """
    if not end > start:
        raise NoSolution("the range has no length", fix="give a greater end")
    first, last = math.ceil(start / math.pi), math.floor(end / math.pi)
    return sorted({start, end, *(k * math.pi for k in range(first, last + 1))})


def motion(design: CrankRocker) -> Motion:
    """Links and joints over the crank angle, A at 0 and D on +x: a revolution, or the range of the file."""
    linkage, span = design.linkage, design.crank_range
    point = design.coupler_point

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links = four_bar(linkage, phi, order)
        if point is not None:
            coupler = links["coupler"]
            links["coupler"] = Link(coupler.origin, coupler.turn, {**coupler.points, "P": point})
        return Mechanism(links, [*four_bar_pins(links)], "crank")

    inputs = Input("crank_angle") if span is None else Input("crank_angle", start=span[0], end=span[1], turns=None)
    outputs = (Output("Rocker CD", rocker(design)),)
    return Motion(make, inputs, outputs, transmission=between("coupler", "rocker"))


def rocker(design: CrankRocker) -> Course:
    """Direction of the rocker from D to C, at the first crank angle in (-180, 180] deg [rad]."""
    first = design.state(0.0 if design.crank_range is None else design.crank_range[0]).rocker_angle
    turns = math.ceil((first - math.pi) / (2.0 * math.pi))
    return turned("rocker").less(2.0 * math.pi * turns) if turns else turned("rocker")


def errors(design: CrankRocker, mechanism: Mechanism) -> Movable:
    """The four links; the error is measured at the joint on the rocker where the file says nothing else."""
    bar = design.linkage
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    return Movable(longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)}), radius=bar.rocker)
