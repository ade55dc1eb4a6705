"""Two cams on one shaft that move a cross slide along a path."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.real_speed import RealSpeed, per_time
from gearlink.core.base.remedies.ways import either, up
from gearlink.core.base.report import Check, Table
from gearlink.core.base.results import cached_property, keep
from gearlink.core.mechanism.courses import Shown, coordinate, motion_table
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import Connection, Contact, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Point, fixed, standing, steady
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.cam_drives.spec import LinkedCamsSpec
    from gearlink.core.parts.cams.disc_cam import DiscCam
    from gearlink.core.parts.cams.follower_motion import FollowerMotion

AXES = ("x", "y")
_LARGER = "enlarge its base_radius"


class LinkedCams(RealSpeed, Design):
    """Each coordinate of the path is the lift of an in-line cam, counted from its minimum.

    Source
        thesis 1.3.1; own derivation: tan alpha = s'/(r_0 + s)
    """

    kind = "linked-cams"
    spec: LinkedCamsSpec
    keys = {
        "analyze": (
            "stroke",
            ("max_pressure_angle", "<limits.pressure_angle"),
            "min_curvature_radius",
            "max_radius",
            "min_radius",
            "path_speed_max",
            "path_speed_min",
        )
    }
    outlines = {
        "analyze": Outline(
            ("stroke", "max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius", "input_speed",
             "turn_time", "path_speed_max", "path_speed_min"),
            ("pressure-angle", "cam-undercut"),
            ("path", "x_cam", "y_cam"),
        )
    }  # fmt: skip
    requirements = Design.requirements | {"limits.pressure_angle", "path"}
    ways = {
        "pressure-angle": (up("cams.x.base_radius"), up("cams.y.base_radius")),
        "cam-undercut": (*either("cams.x.roller_radius", "cams.y.roller_radius"), up("cams.x.base_radius"),
                         up("cams.y.base_radius")),
    }  # fmt: skip

    at_once = 256

    @classmethod
    def find_together(cls, designs: Sequence[Any], names: Sequence[str]) -> None:
        """Cams of one path are sought together."""
        from gearlink.core.base.many_designs import hand_out, sought, together

        wanted = ("max_pressure_angle", "most_convex", "star_shaped")
        radii = tuple(name for name in ("max_radius", "min_radius") if name in names)

        def find(some: Sequence[Any]) -> None:
            many, first = cls(together([design.spec for design in some], ("path", "input_speed", "loads"))), some[0]
            of_path = {"_reach": first._reach} | ({"_speeds": first._speeds} if first.angular_speed else {})
            for design in (many, *some):
                keep(design, **of_path)
            for axis in (0, 1):
                hand_out(many.cams[axis], [design.cams[axis] for design in some], *wanted, *radii)

        sought(find, designs)

    # The path

    def coordinate(self, axis: int, theta: Reals, order: int) -> list[Reals]:
        """x or y and derivatives by the input angle [mm]."""
        if self.spec.path.points is not None:
            return self._splines[axis].evaluate(theta, order)
        assert self.spec.path.harmonics is not None
        found = [np.zeros_like(theta) for _ in range(order + 1)]
        for n, cos, sin in (self.spec.path.harmonics.x, self.spec.path.harmonics.y)[axis]:
            wave = (cos - 1j * sin) * np.exp(1j * n * theta)
            for k in range(order + 1):
                found[k] = found[k] + ((1j * n) ** k * wave).real
        return found

    @cached_property
    def _splines(self) -> list[FollowerMotion]:
        from gearlink.core.parts.cams.follower_motion import spline

        points = self.spec.path.points or []
        angles = [math.radians(row[0]) for row in points]
        return [spline(angles, [row[axis] for row in points]) for axis in (1, 2)]

    @property
    def joints(self) -> tuple[float, ...]:
        """Input angles at which the fourth derivative may jump: the points of a spline [rad]."""
        return tuple(math.radians(row[0]) for row in (self.spec.path.points or ())[:-1])

    @cached_property
    def lowest(self) -> list[float]:
        """Minimum x and y of the path [mm]."""
        return [found[0] for found in self._reach]

    @cached_property
    def _reach(self) -> list[tuple[float, float]]:
        from gearlink.core.numerics.extremes import extremes_over

        def reach(axis: int) -> tuple[float, float]:
            wanted = [(lambda theta: self.coordinate(axis, theta, 0)[0], greatest) for greatest in (False, True)]
            low, high = extremes_over(wanted, joints=self.joints, samples=1024)
            return low.value, high.value

        return [reach(0), reach(1)]

    @property
    def stroke(self) -> list[float]:
        """Strokes of both slides [mm]."""
        return [high - low for low, high in self._reach]

    @cached_property
    def _speeds(self) -> list[float]:
        from gearlink.core.numerics.extremes import extremes_over

        def speed(theta: Reals) -> Reals:
            return abs(self.coordinate(0, theta, 1)[1] + 1j * self.coordinate(1, theta, 1)[1])

        found = extremes_over([(speed, True), (speed, False)], joints=self.joints, samples=1024)
        return [each.value for each in found]

    _fastest: float = placed("_speeds.0")
    _slowest: float = placed("_speeds.1")
    path_speed_max: float | None = per_time("_fastest", 1)
    path_speed_min: float | None = per_time("_slowest", 1)

    # The cams

    @cached_property
    def cams(self) -> tuple[DiscCam, DiscCam]:
        """Those of x and of y, in the frame at input angle 0; their followers move along +x and +y."""
        from gearlink.core.parts.cams.disc_cam import DiscCam
        from gearlink.core.parts.cams.profile import RollerPath, translating

        def made(axis: int) -> DiscCam:
            given = (self.spec.cams.x, self.spec.cams.y)[axis]

            def path(theta: Reals, order: int) -> RollerPath:
                place, *rates = self.coordinate(axis, theta, max(order, 1))
                height = given.base_radius + (place - self.lowest[axis])
                return translating(height, *rates[:2], direction=(1.0, 1j)[axis])

            key = f"cams.{AXES[axis]}"
            return DiscCam(f"{AXES[axis]} cam", path, 1, given.roller_radius, self.joints, key)

        return made(0), made(1)

    max_pressure_angle: list[float] = placed("cams.*.max_pressure_angle.value")
    min_curvature_radius: list[float] = placed("cams.*.min_curvature_radius.value")

    @property
    def max_radius(self) -> list[float]:
        """Maximum radius of both pitch curves [mm]."""
        return [cam.max_radius + cam.roller_radius for cam in self.cams]

    @property
    def min_radius(self) -> list[float]:
        """Minimum radius of both pitch curves [mm]."""
        return [cam.min_radius + cam.roller_radius for cam in self.cams]

    # Tables and checks

    def table_path(self, samples: int | None = None) -> Table:
        """The path over the input angle, with lifts and rates."""
        shown: list[Shown] = []
        for (name, course, _), lowest in zip(self.moving.outputs, self.lowest, strict=True):
            shown += [Shown(name, course), Shown(f"{name}_lift", course.less(lowest))]
            shown += [Shown(f"{name}_velocity", course, 1), Shown(f"{name}_acceleration", course, 2)]
        return motion_table("path", self, shown, samples)

    def table_x_cam(self, samples: int | None = None) -> Table:
        """The cam of x."""
        return self.cams[0].table("x_cam", samples)

    def table_y_cam(self, samples: int | None = None) -> Table:
        """The cam of y."""
        return self.cams[1].table("y_cam", samples)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 of both."""
        from gearlink.core.parts.cams.checks import pressure_angle_checks

        return pressure_angle_checks(self.cams, self.spec.limits.pressure_angle, _LARGER)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 of both."""
        from gearlink.core.parts.cams.checks import undercut_checks

        return undercut_checks(self.cams, plainly=_LARGER)


def linked_cams(design: LinkedCams) -> Motion:
    """Shaft at 0 with both cams, a slide along x, a slide along y, and the table that both move."""
    cams = design.cams

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        x, y = (design.coordinate(axis, phi, order) for axis in (0, 1))
        level = standing(0.0, phi, order=order)
        links = {
            "cam": Link(fixed(0j, phi, order=order), steady(phi, order=order)),
            "slide_x": Link(_along(x, 1.0, design.spec.cams.x.base_radius - design.lowest[0]), level),
            "slide_y": Link(_along(y, 1j, design.spec.cams.y.base_radius - design.lowest[1]), level),
            "table": Link(Point(*(one + 1j * other for one, other in zip(x, y, strict=True))), level),
        }
        place = links["table"].origin.value
        joints: list[Connection] = [
            Pin("O", FRAME, "cam", links["cam"].origin.value),
            Guide("guide_x", FRAME, "slide_x", links["slide_x"].origin.value, 1.0 + 0j),
            Guide("guide_y", FRAME, "slide_y", links["slide_y"].origin.value, 1j),
            Guide("cross", "slide_x", "table", place, 1j),
            Contact("push_y", "slide_y", "table", place, np.full_like(place, 1j)),
        ]
        for cam, name in zip(cams, ("x", "y"), strict=True):
            at = links[f"slide_{name}"].origin.value
            joints.append(Contact(f"roller_{name}", "cam", f"slide_{name}", at, cam.normals(phi)))
        travel = {"slide_x": 1.0 + 0j, "slide_y": 1j}
        return Mechanism(links, joints, "cam", travel=travel)

    outputs = (Output("x", coordinate("table")), Output("y", coordinate("table", along=1j)))
    return Motion(make, Input(joints=tuple(joint for joint in design.joints if joint > 0.0)), outputs)


def _along(rates: list[Reals], way: complex, start: float) -> Point:
    """A slide that moves along a direction; its place is its roller's."""
    value, *others = rates
    return Point(np.asarray(way * (value + start)), *(np.asarray(way * each) for each in others))


def linked_errors(_design: LinkedCams, _mechanism: Mechanism) -> Movable:
    """Rollers and profiles: what an error of the radius of one, or of the size of its cam, does to the path."""
    outwards = {name: (Shift("cam", (f"roller_{name}",), 1.0, "normal"),) for name in ("x", "y")}
    profiles = {f"cams.{name}.profile": shifts for name, shifts in outwards.items()}
    rollers = {f"cams.{name}.roller_radius": shifts for name, shifts in outwards.items()}
    return Movable(rollers | profiles, others=dict.fromkeys(profiles, 0.0))
