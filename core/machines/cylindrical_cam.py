"""A cylindrical cam: motion of its follower, pressure angle and walls of its track, exact in space."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from pydantic import Field, model_validator

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import at_key
from gearlink.core.base.remedies.ways import down, up
from gearlink.core.base.report import NO_NUMBER, Check, Status, Table
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.spec import Assembly, Distance, Length, Spec, TolerancedSpec, refused
from gearlink.core.base.wording import short
from gearlink.core.mechanism.courses import coordinate
from gearlink.core.mechanism.joints import Connection, Contact, Guide
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Point, standing
from gearlink.core.numerics.arrays import Reals, turn_degrees, unit_vector
from gearlink.core.parts.cams.codes import CAM_UNDERCUT, PRESSURE_ANGLE
from gearlink.core.parts.cams.follower_design import FOLLOWER_QUANTITIES, OfFollower
from gearlink.core.parts.cams.follower_motion import FollowerMotion, motion_of
from gearlink.core.parts.cams.motion_spec import OfFollowerKeys, SteepAngle
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE

if TYPE_CHECKING:
    from collections.abc import Callable

    from gearlink.core.numerics.extremes import Extreme


class DrumFollower(Spec):
    """A roller whose axis is radial, on a slide along the drum."""

    type: Literal["translating-roller"] = Field(description="motion of the follower, and its contact with the cam")
    roller_radius: Length = Field(description="radius of the roller")


class DrumBody(Spec):
    """The drum."""

    radius: Length = Field(description="outside radius of the drum")
    depth: Length = Field(description="depth of the track below it")
    sense: Assembly = Field(1, description="+1: the cam turns counter-clockwise; -1: clockwise")


class DrumLimits(Spec):
    """Limits of the checks."""

    pressure_angle: SteepAngle = Field(30.0, description="maximum pressure angle, at the bottom of the track")
    jerk_step: Distance | None = Field(None, description="maximum jump of the jerk, mm per rad^3")


class CylindricalCamSpec(OfFollowerKeys, TolerancedSpec):
    """A cylindrical cam with its follower."""

    kind: Literal["cylindrical-cam"]
    follower: DrumFollower = Field(description="the roller")
    cam: DrumBody = Field(description="the drum")
    limits: DrumLimits = DrumLimits.model_construct()

    @model_validator(mode="after")
    def _has_a_track(self) -> CylindricalCamSpec:
        if self.cam.depth >= self.cam.radius:
            depth, radius = self.cam.depth, self.cam.radius
            message = f"depth: {depth:g} mm (limit < {radius:g} mm, radius)\nset cam.depth below {radius:g} mm"
            raise refused(message, "cam.depth")
        return self


# The track of a cylindrical cam for a roller whose axis is radial: pressure angle, curvature, walls, exact in space.
#
# x is a place along the roller's axis, from the cam's axis on; ' is by the cam angle.


@dataclass(frozen=True)
class Drum:
    """A track on a drum.

    Parameters
        motion : FollowerMotion - along the axis [mm]
        outside, bottom : float [mm] - radii of the drum and of the track's ground
        roller_radius : float [mm] - r_g
        sense : +1 or -1 - eps
    Source
        own derivation: the relative velocity of the roller's section at x is (-eps x, s')
    """

    motion: FollowerMotion
    outside: float
    bottom: float
    roller_radius: float
    sense: int

    def pressure_angle(self, x: float, phi: Reals) -> Reals:
        """Signed pressure angle at a radius [rad]: tan alpha = s'/x."""
        return np.arctan(self.motion.evaluate(phi, 1)[1] / x)

    def curvature(self, x: float, phi: Reals) -> Reals:
        """Curvature of the developed pitch curve [1/mm]: kappa = x s''/(x^2 + s'^2)^(3/2)."""
        _, s1, s2 = self.motion.evaluate(phi, 2)
        return np.asarray(x * s2 / (x * x + s1 * s1) ** 1.5)

    def wall_factor(self, x: float, side: int, phi: Reals) -> Reals:
        """1 - side r_g kappa - r_g^2 s'^2/h^4, h^2 = x^2 + s'^2: a wall is regular where it is positive.

        The last term is from the turning of the contact along x, which twists the walls; the development misses it.
        """
        _, s1, s2 = self.motion.evaluate(phi, 2)
        square, roller = x * x + s1 * s1, self.roller_radius
        return np.asarray(1.0 - side * roller * x * s2 / square**1.5 - (roller * s1 / square) ** 2)

    def wall(self, x: float, side: int, phi: Reals) -> tuple[Reals, Reals, Reals]:
        """A wall in the cam's frame, the cam's axis along the third coordinate [mm].

        (x, side r_g s'/h, s + side r_g eps x/h) turned by -eps phi, h = sqrt(x^2 + s'^2)
        """
        s, s1 = self.motion.evaluate(phi, 1)
        h = np.sqrt(x * x + s1 * s1)
        across, along = side * self.roller_radius * s1 / h, s + side * self.roller_radius * self.sense * x / h
        turned = (x + 1j * across) * unit_vector(-self.sense * phi)
        return turned.real, turned.imag, along

    def developed(self, x: float, side: int, phi: Reals) -> tuple[Reals, Reals]:
        """A wall (side +1 or -1) or the pitch line (0) on the development of a radius: arc and place along the axis."""
        s, s1 = self.motion.evaluate(phi, 1)
        h = np.sqrt(x * x + s1 * s1)
        return x * phi - side * self.roller_radius * s1 / h, s + side * self.roller_radius * x / h

    def off_development(self, x: float, phi: Reals) -> Reals:
        """How far a wall, where it meets the cylinder of a radius, lies from its line on the development [mm].

        Notes
            The cylinder bends away from the roller's section: a wall meets it at the place u along the roller's axis,
            u^2 + (r_g s')^2/(u^2 + s'^2) = x^2. At right angles to the pitch line; nan where a roller larger than the
            cylinder does not meet it.
        """
        s1, roller = self.motion.evaluate(phi, 1)[1], self.roller_radius
        with np.errstate(invalid="ignore"):
            square = 0.5 * (x * x - s1 * s1 + np.sqrt((x * x + s1 * s1) ** 2 - (2.0 * s1 * roller) ** 2))
            across, along = (roller * each / np.sqrt(square + s1 * s1) for each in (s1, np.sqrt(square)))
            arc = x * np.arcsin(across / x)
        return np.asarray(np.abs((s1 * arc + x * along) / np.hypot(x, s1) - roller))


_TRACK = ("max_pressure_angle", "pressure_angle_outside", "min_curvature_radius", "least_wall_factor")
_CHECKS = ("pressure-angle", "cam-undercut", "velocity-step", "acceleration-step", "jerk-step", *LAW_CHECKS)
_OUTLINE = Outline((*FOLLOWER_QUANTITIES, *_TRACK), _CHECKS, ("follower", "track"))
_FIT = 1e-9  # deg
_THIN = 0.2
_SAMPLES = 512


class CylindricalCamDesign(OfFollower, Design):
    """The drum of a design file; its axis is the direction of the lift."""

    kind = "cylindrical-cam"
    spec: CylindricalCamSpec
    keys = dict.fromkeys(
        ("cam", "analyze"),
        (
            "lift_max",
            ("max_pressure_angle", "<limits.pressure_angle"),
            "pressure_angle_outside",
            "min_curvature_radius",
            "least_wall_factor",
            "follower_velocity_max",
            "follower_acceleration_max",
            "velocity_max",
            "acceleration_max",
        ),
    )
    outlines = {"cam": _OUTLINE, "analyze": _OUTLINE}
    requirements = Design.requirements | {"motion", "limits.pressure_angle"}
    ways = {
        "pressure-angle": (up("cam.radius"), down("cam.depth")),
        "cam-undercut": (up("cam.radius"), down("follower.roller_radius")),
    }
    extra_tables = ("segments", "walls", LAW_TABLE)
    advises = False

    @cached_property
    def follower_motion(self) -> FollowerMotion:
        with at_key("motion"):
            return motion_of(self.spec.motion, self.spec.initial_lift, spec=self.spec)

    at_once = 256

    @classmethod
    def find_together(cls, designs: Sequence[Any], names: Sequence[str]) -> None:
        """Tracks of one motion are sought together."""
        from gearlink.core.base.many_designs import hand_out, sought, together

        del names

        def find(some: Sequence[Any]) -> None:
            many = cls(together([design.spec for design in some], ("motion", "initial_lift", "speed")))
            of_motion = {name: getattr(some[0], name) for name in ("follower_motion", "motion_extremes")}
            for design in (many, *some):
                keep(design, **of_motion)
            hand_out(many, some, "steepest", "pressure_angle_outside", "bends", "walls")

        sought(find, designs)

    @cached_property
    def drum(self) -> Drum:
        """The track."""
        cam = self.spec.cam
        return Drum(
            self.follower_motion, cam.radius, cam.radius - cam.depth, self.spec.follower.roller_radius, cam.sense
        )

    @property
    def _radii(self) -> tuple[float, float]:
        return self.drum.bottom, self.drum.outside

    def _most(self, course: Callable[[Reals], Reals]) -> Extreme:
        from gearlink.core.numerics.extremes import maximum_over

        return maximum_over(course, joints=self.follower_motion.joints, samples=_SAMPLES)

    @cached_property
    def steepest(self) -> Extreme:
        """Maximum magnitude of the pressure angle, at the bottom of the track [rad], and its cam angle."""
        return self._most(lambda phi: abs(self.drum.pressure_angle(self.drum.bottom, phi)))

    max_pressure_angle: float = placed("steepest.value")

    @cached_property
    def pressure_angle_outside(self) -> float:
        """Maximum magnitude of the pressure angle at the outside of the drum [rad]."""
        return self._most(lambda phi: abs(self.drum.pressure_angle(self.drum.outside, phi))).value

    @cached_property
    def bends(self) -> tuple[Extreme, ...]:
        """Maximum curvature of the developed pitch curve, of either sense, at both radii [1/mm]."""
        return tuple(self._most(lambda phi, x=x: abs(self.drum.curvature(x, phi))) for x in self._radii)  # type: ignore[misc]

    @property
    def min_curvature_radius(self) -> float:
        """Minimum radius of the developed pitch curve, of either sense, over both radii [mm]."""
        bend = max(each.value for each in self.bends)
        return 1.0 / bend if bend > 0.0 else math.inf

    @cached_property
    def walls(self) -> tuple[Extreme, ...]:
        """Minimum wall factor of both walls at both radii, as the maximum of its negative, and its cam angle [rad]."""
        return tuple(
            self._most(lambda phi, x=x, side=side: -self.drum.wall_factor(x, side, phi))  # type: ignore[misc]
            for x in self._radii
            for side in (1, -1)
        )

    @property
    def thinnest(self) -> Extreme:
        """Minimum wall factor over both walls and both radii, and its cam angle [rad]."""
        worst = max(self.walls, key=lambda each: each.value)
        return worst._replace(value=-worst.value)

    least_wall_factor: float = placed("thinnest.value")

    def table_track(self, samples: int | None = None) -> Table:
        """Pitch line and both walls, developed at the outside and at the bottom, with the pressure angles there."""
        degrees = turn_degrees(samples)
        phi, columns = np.radians(degrees), {"cam_angle": (degrees, "deg")}
        for name, x in (("outside", self.drum.outside), ("bottom", self.drum.bottom)):
            columns[f"{name}_pressure_angle"] = np.degrees(self.drum.pressure_angle(x, phi)), "deg"
            for wall, side in (("pitch", 0), ("upper", 1), ("lower", -1)):
                arc, along = self.drum.developed(x, side, phi)
                columns |= {f"{name}_{wall}_arc": (arc, "mm"), f"{name}_{wall}": (along, "mm")}
        return Table.of("track", columns)

    def table_walls(self, samples: int | None = None) -> Table:
        """Points of both walls in space at the outside and at the bottom, in the cam's frame, its axis along z."""
        degrees = turn_degrees(samples)
        phi, columns = np.radians(degrees), {"cam_angle": (degrees, "deg")}
        for name, x in (("outside", self.drum.outside), ("bottom", self.drum.bottom)):
            for wall, side in (("upper", 1), ("lower", -1)):
                points = self.drum.wall(x, side * self.drum.sense, phi)
                columns |= {f"{name}_{wall}_{axis}": (place, "mm") for axis, place in zip("xyz", points, strict=True)}
        return Table.of("walls", columns)

    def check_pressure_angle(self) -> Check:
        """GL401, at the bottom of the track."""
        value, limit = math.degrees(self.steepest.value), self.spec.limits.pressure_angle
        over = value > limit + _FIT
        what, fix = "pressure angle at the bottom of the track", "enlarge the drum, or give the motion more cam angle"
        at = f"cam angle {short(math.degrees(self.steepest.place))} deg"
        return PRESSURE_ANGLE.check("fail" if over else "pass", what, value, limit, "deg", at=at, fix=fix)

    def check_cam_undercut(self) -> Check:
        """GL402: a wall is regular where its factor is positive."""
        value, place = self.thinnest
        status: Status = "fail" if value <= 0.0 else "warn" if value < _THIN else "pass"
        what, at = "minimum wall factor", f"cam angle {short(math.degrees(place))} deg"
        shown = None
        if value < 0.0:
            what, shown = "the wall of the track is undercut", NO_NUMBER
        fix = "use a smaller roller, or enlarge the drum"
        return CAM_UNDERCUT.check(status, what, value, 0.0, side=">=", shown=shown, recommended=_THIN, at=at, fix=fix)


def motion(design: CylindricalCamDesign) -> Motion:
    """Links and joints over the cam angle: the drum's surface runs along x, the follower along y at x 0."""
    drum, law = design.drum, design.follower_motion

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        still = np.zeros(phi.shape, dtype=np.complex128)
        way = [np.asarray(still + drum.sense * drum.bottom * phi), still + drum.sense * drum.bottom, still, still]
        lift = [np.asarray(1j * each, dtype=np.complex128) for each in law.evaluate(phi, order, side=side)]
        links = {
            "cam": Link(Point(*way[: order + 1]), standing(0.0, phi, order=order)),
            "follower": Link(Point(*lift), standing(0.0, phi, order=order)),
        }
        rate = 1j * law.evaluate(phi, 1, side=side)[1] - drum.sense * drum.bottom
        normal = np.asarray(-1j * drum.sense * rate / np.abs(rate), dtype=np.complex128)
        joints: list[Connection] = [
            Guide("drum", FRAME, "cam", links["cam"].origin.value, 1.0 + 0j),
            Guide("guide", FRAME, "follower", links["follower"].origin.value, 1j),
            Contact("roller", "cam", "follower", links["follower"].origin.value, normal),
        ]
        return Mechanism(links, joints, "cam", travel={"cam": 1.0 + 0j, "follower": 1j})

    joints = tuple(joint for joint in law.joints if joint > 0.0)
    return Motion(make, Input("cam_angle", joints=joints), (Output("Follower", coordinate("follower", along=1j)),))
