"""Cam-gear and cam-linkage as designs: the output's motion is given, the groove follows from it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import NoSolution, in_section
from gearlink.core.base.real_speed import RealSpeed, per_time
from gearlink.core.base.remedies.ways import either, up
from gearlink.core.base.report import Check, Status, Table
from gearlink.core.base.report import Shown as Compared
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.wording import short, within
from gearlink.core.mechanism.closures import dyad
from gearlink.core.mechanism.courses import motion_table, of_output, turned
from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.joints import Connection, Contact, Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Turn, fixed, mixed, steady
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees, units
from gearlink.core.numerics.extremes import Extreme, extremes_over, least_convex_radius
from gearlink.core.parts.cams.checks import ROLLER_SHARE, against_curvature, is_steep
from gearlink.core.parts.cams.codes import CAM_UNDERCUT, PRESSURE_ANGLE
from gearlink.core.parts.cams.undercut import undercut
from gearlink.core.studies.movable import Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE

if TYPE_CHECKING:
    from gearlink.core.machines.cam_drives.spec import CamGearSpec, CamLinkageSpec
    from gearlink.core.numerics.together import Function
    from gearlink.core.parts.cams.output_motion import OutputMotion
    from gearlink.core.parts.gears.data import GearData


_SAMPLES = 1024
_STANDS = 1e-12
_CUT = 1e-9


# A groove that a roller is held in: its profile by inversion of a prescribed motion, whatever carries the roller.
#
# P is the path of the roller's centre in the coordinates of the body with the groove, primes by the input angle; u the
# direction in which the roller would go with the input held. N = i P'/|P'|, walls P +- r_g N,
#
#     pressure angle between N and u,   kappa = Im(conj(P') P'')/|P'|^3


class Path(NamedTuple):
    """The roller's centre at input angles: P, P', P'' and u, (N,) complex arrays [mm]; u has any length."""

    place: Points
    first: Points
    second: Points
    way: Points


def _bend(path: Path) -> Reals:
    return np.asarray((np.conj(path.first) * path.second).imag / np.abs(path.first) ** 3)


@dataclass(frozen=True)
class Groove:
    """A closed groove about the axis of the input.

    Parameters
        path : function of input angles (N,) [rad] - gives the Path
        roller_radius : float [mm]
        joints : input angles [rad] at which the law changes
    Raises
        NoSolution - where the roller stands still in the groove
    """

    path: Callable[[Reals], Path]
    roller_radius: float
    joints: tuple[float, ...] = ()

    @cached_property
    def sense(self) -> float:
        """+1 where the path goes round counter-clockwise, -1 where clockwise."""
        place = self.path(np.radians(turn_degrees(720))).place
        area = float(np.sum((np.conj(place) * np.roll(place, -1)).imag))
        return 1.0 if area >= 0.0 else -1.0

    def _tangents(self, path: Path, theta: Reals) -> Points:
        speed = np.abs(path.first)
        still = speed <= _STANDS * np.max(np.abs(path.place))
        if np.any(still):
            place = math.degrees(float(theta[int(np.argmax(still))]))
            message = f"the roller is at rest in its groove at input angle {short(place)} deg"
            raise NoSolution(message, fix="change the motion")
        return np.asarray(path.first / speed)

    def pressure_angle(self, theta: Reals) -> Reals:
        """Between the normal and the roller's own way, -90 to 90 deg [rad]."""
        path = self.path(theta)
        seen = np.conj(self._tangents(path, theta)) * path.way
        return np.arctan2(seen.real * np.sign(seen.imag) + 0.0 * seen.real, np.abs(seen.imag))

    def curvature(self, theta: Reals) -> Reals:
        """Curvature of the path [1/mm], convex seen from within positive."""
        return self.sense * _bend(self.path(theta))

    def radius(self, theta: Reals) -> Reals:
        """Distance of the roller from the axis of the input [mm]."""
        return np.abs(self.path(theta).place)

    def walls(self, theta: Reals) -> tuple[Points, Points]:
        """Inner and outer wall [mm]."""
        path = self.path(theta)
        inwards = 1j * self.sense * self._tangents(path, theta) * self.roller_radius
        return np.asarray(path.place + inwards), np.asarray(path.place - inwards)

    @cached_property
    def extremes(self) -> list[Extreme]:
        """Maximum pressure angle, maximum and minimum distance of the roller from the axis."""
        steep: tuple[Function, bool] = (lambda theta: np.abs(self.pressure_angle(theta)), True)
        return extremes_over([steep, (self.radius, True), (self.radius, False)], joints=self.joints, samples=_SAMPLES)

    @cached_property
    def sharpest(self) -> Extreme:
        """Minimum convex radius of the path [mm] and its place."""
        return least_convex_radius(self.curvature, joints=self.joints, samples=_SAMPLES)

    @cached_property
    def hollow(self) -> Extreme:
        """Minimum hollow radius of the path [mm] and its place."""
        return least_convex_radius(lambda theta: -self.curvature(theta), joints=self.joints, samples=_SAMPLES)

    def table(self, samples: int | None = None) -> Table:
        """Path, walls, pressure angle and radius of curvature over the input angle."""
        degrees = turn_degrees(samples)
        theta = np.radians(degrees)
        place, (inner, outer), bend = self.path(theta).place, self.walls(theta), self.curvature(theta)
        with np.errstate(divide="ignore"):
            radius = np.where(bend == 0.0, np.inf, 1.0 / bend)
        columns = {"input_angle": (degrees, "deg")}
        for name, points in (("pitch", place), ("inner", inner), ("outer", outer)):
            columns |= {f"{name}_x": (points.real, "mm"), f"{name}_y": (points.imag, "mm")}
        columns["pressure_angle"] = np.degrees(self.pressure_angle(theta)), "deg"
        columns["curvature_radius"] = radius, "mm"
        return Table.of("main_cam", columns)

    def with_wall(self, side: int, theta: Reals) -> tuple[Points, Points]:
        """Path of the roller's centre, and its inner (0) or outer (1) wall."""
        return self.path(theta).place, self.walls(theta)[side]

    @cached_property
    def star_shaped(self) -> tuple[Any, Any]:
        """Whether the polar angle of inner and outer wall runs one way: without a cusp none then crosses itself."""
        closed = np.radians(turn_degrees(2 * _SAMPLES))
        inner, outer = (self.sense * (np.conj(w) * np.roll(w, -1, axis=-1)).imag > 0.0 for w in self.walls(closed))
        return np.all(inner, axis=-1), np.all(outer, axis=-1)


_GROOVE = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_OUTPUT = (
    "speed_ratio_max", "speed_ratio_min", "acceleration_ratio_max", "input_speed", "turn_time", "output_speed_max",
    "output_speed_min", "output_acceleration_max",
)  # fmt: skip
_STEEPEST = ("max_pressure_angle", "<limits.pressure_angle")
_KEYS = (
    "min_curvature_radius", "max_radius", "min_radius", "output_speed_max", "output_acceleration_max",
    "speed_ratio_max", "speed_ratio_min", "acceleration_ratio_max",
)  # fmt: skip
_CHECKS = ("pressure-angle", "cam-undercut")
_TEETH = (
    "undercut", "tip-thickness", "contact-ratio", "involute-interference", "root-clearance", "tooth-form", "sliding",
)  # fmt: skip
_IN_LINE = 1e-9
_DEGREE = math.pi / 180.0


class Grooved(RealSpeed, Design):
    """A drive whose roller runs in a groove of the frame; a subclass says where the roller is."""

    spec: CamGearSpec | CamLinkageSpec
    requirements = Design.requirements | {"motion", "limits.pressure_angle"}
    larger = "enlarge the drive, or use a smaller roller"

    at_once = 256
    alike: ClassVar[tuple[str, ...]] = ()  # keys by which drives that are sought together do not differ
    beside: ClassVar[tuple[str, ...]] = ()  # what they find together beside the groove

    @classmethod
    def find_together(cls, designs: Sequence[Any], names: Sequence[str]) -> None:
        """Grooves of one motion are sought together."""
        from gearlink.core.base.many_designs import hand_out, sought, together

        del names

        def find(some: Sequence[Any]) -> None:
            spec = together([design.spec for design in some], ("motion", "input_speed", "loads", *cls.alike))
            many, first = cls(spec), some[0]
            of_motion = {"output_motion": first.output_motion, "_rates": first._rates}
            for design in (many, *some):
                keep(design, **of_motion)
            hand_out(many, some, *cls.beside)
            grooves = [design.groove for design in some]
            keep(many, groove=Groove(many.path, spec.roller_radius, first.output_motion.joints))
            hand_out(many.groove, grooves, "extremes", "sharpest", "hollow", "star_shaped")

        sought(find, designs)

    @cached_property
    def output_motion(self) -> OutputMotion:
        """Output angle over the input angle."""
        from gearlink.core.parts.cams.output_motion import OutputMotion

        return OutputMotion(self.spec.motion)

    def path(self, theta: Reals) -> Path:
        """The roller's centre in the frame."""
        raise NotImplementedError

    def require_closed(self) -> None:
        """Refuse a drive that cannot turn through.

        Raises
            NoSolution
        """

    @cached_property
    def groove(self) -> Groove:
        """The groove.

        Raises
            NoSolution - where the drive does not close over the revolution
        """
        self.require_closed()
        return Groove(self.path, self.spec.roller_radius, self.output_motion.joints)

    max_pressure_angle: float = placed("groove.extremes.0.value")
    min_curvature_radius: float = placed("groove.sharpest.value")
    max_radius: float = placed("groove.extremes.1.value")
    min_radius: float = placed("groove.extremes.2.value")

    @cached_property
    def _rates(self) -> list[Extreme]:
        motion = self.output_motion

        def speed(theta: Reals) -> Reals:
            return motion.evaluate(theta, 1)[1]

        wanted = [(speed, True), (speed, False), (lambda theta: abs(motion.evaluate(theta, 2)[2]), True)]
        return extremes_over(wanted, joints=motion.joints, samples=_SAMPLES)

    def ends(self, course: Callable[[Reals], Reals]) -> tuple[Extreme, Extreme]:
        """Maximum and minimum of a function of the input angle."""
        wanted = [(course, True), (course, False)]
        high, low = extremes_over(wanted, joints=self.output_motion.joints, samples=_SAMPLES)
        return high, low

    speed_ratio_max: float = placed("_rates.0.value")
    speed_ratio_min: float = placed("_rates.1.value")
    acceleration_ratio_max: float = placed("_rates.2.value")
    output_speed_max: float | None = per_time("speed_ratio_max", 1)
    output_speed_min: float | None = per_time("speed_ratio_min", 1)
    output_acceleration_max: float | None = per_time("acceleration_ratio_max", 2)

    def table_motion(self, samples: int | None = None, **beside: tuple[Any, str]) -> Table:
        """The output over a revolution of the input."""
        self.require_closed()
        return motion_table("motion", self, of_output(self.moving.outputs[0].course), samples, beside=beside)

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The groove: path of the roller, both walls, pressure angle, curvature."""
        return self.groove.table(samples)

    def check_pressure_angle(self) -> Check:
        """GL401."""
        steepest, limit = self.groove.extremes[0], self.spec.limits.pressure_angle
        value, at = math.degrees(steepest.value), f"input angle {short(math.degrees(steepest.place))} deg"
        status: Status = "fail" if is_steep(value, limit) else "pass"
        what = "pressure angle in the groove"
        return PRESSURE_ANGLE.check(status, what, value, limit, "deg", at=at, fix=self.larger)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 of both walls: the roller against the minimum radius of the path, and what it cuts elsewhere."""
        groove, roller = self.groove, self.groove.roller_radius
        for side, (name, found) in enumerate((("inner", groove.sharpest), ("outer", groove.hollow))):
            share, place = roller / found.value, found.place
            status: Status = "fail" if share >= 1.0 else "warn" if share > ROLLER_SHARE else "pass"
            what, shown = f"roller radius, {name} wall", against_curvature(roller, found.value, status)
            if status == "pass" and not groove.star_shaped[side]:
                cut = undercut(partial(groove.with_wall, side), roller)
                if cut.depth > _CUT * roller:
                    status, what, place = "fail", f"cut of the roller into the {name} wall", cut.cam_angle
                    shown = Compared(cut.depth, 0.0, "mm", "<=")
            at = f"input angle {short(math.degrees(place))} deg"
            yield CAM_UNDERCUT.check(status, what, share, 1.0, shown=shown, at=at, fix=self.larger)


class CamGear(Grooved):
    """Sun, planet and carrier, the planet's lever in a groove: output by a differential.

    chi = (z_s/z_p)(theta - theta_out),  X = angle + chi,  P = e^(i theta)(R + l e^(i X)),
    tan alpha = [R cos X + l (1 + chi')]/(R sin X)

    Source
        thesis 1.3.4; own derivation
    """

    kind = "cam-gear"
    spec: CamGearSpec
    keys = {"analyze": ("lever_swing", _STEEPEST, *_KEYS)}
    outlines = {
        "analyze": Outline(
            ("lever_swing", *_GROOVE, *_OUTPUT, "carrier_length", "contact_ratio"), (*_CHECKS, *_TEETH),
            ("motion", "main_cam"),
        )
    }  # fmt: skip
    ways = {
        "pressure-angle": (*either("lever.angle"), *either("lever.length", "gears.module")),
        "cam-undercut": (*either("roller_radius"), up("gears.module", step=0.25)),
    }
    alike = ("gears",)
    beside = ("_swing", "gear_data")
    larger = "shorten the lever, turn it (lever.angle), use fewer sun teeth, or give the motion more input angle"

    @cached_property
    def gear_data(self) -> GearData:
        """Sun and planet."""
        from gearlink.core.parts.gears.from_spec import data_of, pair_at

        gears = self.spec.gears
        plain = 0.5 * gears.module * (gears.sun + gears.planet) / math.cos(math.radians(gears.helix_angle))
        with in_section("gears"):
            pair = pair_at(gears, (gears.sun, gears.planet), plain if gears.profile_shift is None else None)
            return data_of(gears, pair)

    carrier_length: float = placed("gear_data.pair.center_distance")
    contact_ratio: float = placed("gear_data.pair.contact_ratio")

    def lever(self, theta: Reals, order: int, side: int = 1) -> list[Reals]:
        """Angle X of the lever from the direction sun to planet, and its derivatives by the input angle [rad]."""
        angle, *rates = self.output_motion.evaluate(theta, order, side=side)
        share = self.spec.gears.sun / self.spec.gears.planet
        found = [self.spec.lever.angle * _DEGREE + share * (theta - angle)]
        return found + [share * ((1.0 if k == 0 else 0.0) - each) for k, each in enumerate(rates)]

    @cached_property
    def _swing(self) -> tuple[Extreme, Extreme]:
        return self.ends(lambda theta: self.lever(theta, 0)[0])

    @property
    def lever_swing(self) -> float:
        """Range of the lever's angle against the carrier [rad]."""
        return self._swing[0].value - self._swing[1].value

    def require_closed(self) -> None:
        """The lever must never lie in line with its carrier, where the groove cannot turn it."""
        top, low = self._swing
        over = math.floor(top.value / math.pi + _IN_LINE) * math.pi
        if over >= low.value - _IN_LINE:
            raise NoSolution(
                f"angle of the lever: {short(math.degrees(low.value))} to {short(math.degrees(top.value))} deg "
                f"(within 0 to 180 deg; at {short(math.degrees(over))} deg it is collinear with its carrier)",
                key="lever.angle",
                fix="set lever.angle so that this angle stays between 0 and 180 deg, or use fewer sun teeth",
            )

    def path(self, theta: Reals) -> Path:
        """P, P', P'' and u = d P/d X."""
        x, first, second = self.lever(theta, 2)
        turn, arm, length = units(theta), self.spec.lever.length * units(x), self.carrier_length
        spin = 1.0 + first
        return Path(
            np.asarray(turn * (length + arm)),
            np.asarray(1j * turn * (length + spin * arm)),
            np.asarray(turn * (1j * second * arm - length - spin**2 * arm)),
            np.asarray(1j * turn * arm),
        )

    def table_motion(self, samples: int | None = None, **beside: tuple[Any, str]) -> Table:
        """The output over a revolution of the input."""
        lever = np.degrees(self.lever(np.radians(turn_degrees(samples)), 0)[0])
        return super().table_motion(samples, lever_angle=(lever, "deg"), **beside)

    def check(self, name: str) -> list[Check]:
        """Gear checks are those of sun and planet."""
        if name not in _TEETH:
            return super().check(name)
        from gearlink.core.parts.gears.drawing_checks import pair_check

        with in_section("gears"):
            return pair_check(name, self.gear_data, self.spec.limits, shifts=self.spec.gears.profile_shift is not None)


class CamLinkage(Grooved):
    """A five-bar A-B-C-D-E whose joint C runs in a groove: the output by any law, full revolutions too.

    Source
        thesis 1.3.2; own derivation
    """

    kind = "cam-linkage"
    spec: CamLinkageSpec
    keys = {"analyze": (_STEEPEST, ("min_transmission_angle", ">limits.transmission_angle"), *_KEYS)}
    outlines = {
        "analyze": Outline(
            (*_GROOVE, "min_transmission_angle", *_OUTPUT), (*_CHECKS, "transmission-angle"), ("motion", "main_cam")
        )
    }
    requirements = Grooved.requirements | {"limits.transmission_angle"}
    ways = {
        "pressure-angle": either("links.coupler", "links.follower", "links.output", "links.input", "phase"),
        "cam-undercut": either("roller_radius", "links.coupler", "links.follower"),
        "transmission-angle": either("links.output", "links.follower", "links.coupler", "phase"),
    }
    beside = ("_span", "_leans")
    larger = "change coupler, follower or phase, or give the motion more input angle"

    @cached_property
    def _span(self) -> tuple[Extreme, Extreme]:
        """Maximum and minimum distance of B and D."""
        links, phase = self.spec.links, self.spec.phase * _DEGREE

        def apart(theta: Reals) -> Reals:
            d = links.frame + links.output * units(phase + self.output_motion.evaluate(theta, 0)[0])
            return np.abs(d - links.input * units(theta))

        return self.ends(apart)

    def require_closed(self) -> None:
        """Coupler and follower must reach from B to D over the whole revolution."""
        links, (far, near) = self.spec.links, self._span
        least, most = abs(links.coupler - links.follower), links.coupler + links.follower
        open_at = far if far.value >= most else near if near.value <= least else None
        if open_at is not None:
            message = f"coupler and follower do not close: distance BD {short(open_at.value)} mm (reach "
            message += f"{within(least, most, 'mm')}) at input angle {short(math.degrees(open_at.place))} deg"
            raise NoSolution(message, key="links", fix="change links.coupler or links.follower, or phase")

    def path(self, theta: Reals) -> Path:
        """C and its derivatives; u is across BC."""
        links = five_bar(self, theta, 2, 1)
        place = links["coupler"].at("C")
        return Path(place.value, place.first, place.second, np.asarray(1j * links["coupler"].unit))

    def _lean(self, theta: Reals) -> Reals:
        """Signed angle between the lines of follower and output [rad]."""
        links = five_bar(self, theta, 0, 1)
        apart = np.conj(links["follower"].unit) * links["output"].unit
        return np.asarray(np.arctan2(apart.imag, np.abs(apart.real)))

    @cached_property
    def _leans(self) -> tuple[Extreme, Extreme]:
        return self.ends(self._lean)

    @cached_property
    def _flattest(self) -> Extreme:
        """That angle where it is nearest to 0; 0 where both are in line."""
        from gearlink.core.numerics.roots import bracketed_root

        self.require_closed()
        high, low = self._leans
        if low.value * high.value > 0.0:
            return min(high, low, key=lambda each: abs(each.value))
        ends = sorted((low.place, high.place))
        return Extreme(0.0, bracketed_root(lambda place: float(self._lean(np.array([place]))[0]), *ends))

    @property
    def min_transmission_angle(self) -> float:
        """Minimum angle between follower and output, at D [rad]; 0 where a force at C does not turn the output."""
        return abs(self._flattest.value)

    def check_transmission_angle(self) -> Check:
        """GL303."""
        from gearlink.core.parts.linkages.checks import transmission_check

        limit, place = self.spec.limits.transmission_angle, math.degrees(self._flattest.place)
        return transmission_check(
            self.min_transmission_angle,
            limit,
            "change output, follower or phase, or give the motion more input angle",
            "minimum transmission angle of follower and output",
            at=f"input angle {short(place)} deg",
        )


def _groove(design: Grooved, phi: Reals, on: str) -> Contact:
    """The roller in the groove of the frame: a force of either sense along the normal."""
    path = design.path(phi)
    normal = np.asarray(1j * path.first / np.abs(path.first))
    return Contact("groove", FRAME, on, path.place, normal, None, -_bend(path))


def _inner(joints: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(joint for joint in joints if joint > 0.0)


def cam_gear(design: CamGear) -> Motion:
    """Carrier on +x at input angle 0, both gears' axis and the input's at 0."""
    design.require_closed()
    pair, length, arm = design.gear_data.pair, design.carrier_length, design.spec.lever.length
    one, other = pair.working_radius
    tangent = math.tan(pair.working_pressure_angle)

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        axis = fixed(0j, phi, order=order)
        carrier = Link(axis, steady(phi, order=order), {"A": 0.0, "B": length})
        lever = Turn(*design.lever(phi, order, side))
        planet = Link(carrier.at("B"), mixed((1.0, carrier.turn), (1.0, lever)), {"B": 0.0, "P": arm})
        links = {"carrier": carrier, "planet": planet,
                 "sun": Link(axis, Turn(*design.output_motion.evaluate(phi, order, side=side)))}  # fmt: skip
        joints: list[Connection] = [
            Pin("A", FRAME, "carrier", axis.value),
            Pin("B", "carrier", "planet", planet.origin.value),
            Pin("D", FRAME, "sun", axis.value),
            Mesh("mesh", "sun", "planet", axis.value, carrier.unit, one, other, tangent, False, "carrier"),
            _groove(design, phi, "planet"),
        ]
        return Mechanism(links, joints, "carrier")

    return Motion(make, Input(joints=_inner(design.output_motion.joints)), (Output("Sun", turned("sun")),))


def cam_gear_errors(design: CamGear, mechanism: Mechanism) -> Movable:
    """Lever, centre distance and the groove; the error is measured at the sun's pitch circle."""
    ends = {"centers.gears": ("carrier", design.carrier_length)}
    outwards = (Shift(FRAME, ("groove",), 1.0, "normal"),)
    return Movable(
        longer(mechanism, ends) | {"lever.length": (Shift("planet", ("groove",)),), CAM_PROFILE: outwards},
        {"gears": design.carrier_length},
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("planet", ("groove",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=design.gear_data.pair.working_radius[0],
    )


def five_bar(design: CamLinkage, phi: Reals, order: int, side: int) -> dict[str, Link]:
    """Input, coupler, follower and output; A at 0, E on +x."""
    given = design.spec.links
    value, *rates = design.output_motion.evaluate(phi, order, side=side)
    angle = Turn(value + design.spec.phase * _DEGREE, *rates)
    first = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": given.input})
    last = Link(fixed(given.frame, phi, order=order), angle, {"E": 0.0, "D": given.output})
    coupler, follower = dyad(first.at("B"), last.at("D"), given.coupler, given.follower, design.spec.assembly)
    return {
        "input": first,
        "coupler": Link(first.at("B"), coupler, {"B": 0.0, "C": given.coupler}),
        "follower": Link(last.at("D"), follower, {"D": 0.0, "C": given.follower}),
        "output": last,
    }


def cam_linkage(design: CamLinkage) -> Motion:
    """Links and joints over the input angle, AB on +x at 0."""
    design.require_closed()

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        links = five_bar(design, phi, order, side)
        joints: list[Connection] = [
            Pin("A", FRAME, "input", links["input"].origin.value),
            Pin("B", "input", "coupler", links["coupler"].origin.value),
            Pin("C", "coupler", "follower", links["coupler"].at("C").value),
            Pin("D", "output", "follower", links["follower"].origin.value),
            Pin("E", FRAME, "output", links["output"].origin.value),
            _groove(design, phi, "coupler"),
        ]
        return Mechanism(links, joints, "input")

    start = math.radians(design.spec.phase)
    output = Output("Output link ED", turned("output").less(start) if start else turned("output"))
    return Motion(make, Input(joints=_inner(design.output_motion.joints)), (output,))


def cam_linkage_errors(design: CamLinkage, mechanism: Mechanism) -> Movable:
    """The links, the groove, and the roller's pin."""
    given = design.spec.links
    ends = {f"links.{name}": (name, getattr(given, name)) for name in ("input", "follower", "output")}
    sizes = longer(mechanism, ends)
    sizes["links.coupler"] = (Shift("coupler", ("C", "groove")),)
    return Movable(
        sizes | {CAM_PROFILE: (Shift(FRAME, ("groove",), 1.0, "normal"),)},
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("coupler", ("groove",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=given.output,
    )
