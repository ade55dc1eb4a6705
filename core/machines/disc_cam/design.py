"""A disc cam with its follower: motion, size, profile, limits, making."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from gearlink.core.base.design import Design, Found, Outline, placed
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.many_designs import Unlike, column, hand_out, sought, together
from gearlink.core.base.remedies.ways import Way, down, either, left_out, thinner, up
from gearlink.core.base.report import NO_NUMBER, Check, Status, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.wording import short
from gearlink.core.machines.disc_cam.cams import FollowerCams, Making, Place, curve_table
from gearlink.core.machines.disc_cam.spec import OscillatingFlat
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, maximum_over
from gearlink.core.parts.cams.checks import edge_check, flat_undercut_check, hub_checks, undercut_checks
from gearlink.core.parts.cams.codes import (
    CONSTANT_SUM,
    CUTTER_RADIUS,
    FACE_LENGTH,
    LIFT_OFF,
    OUTER_WALL,
    PRESSURE_ANGLE,
)
from gearlink.core.parts.cams.contour import arcs_table
from gearlink.core.parts.cams.disc_cam import SAMPLES, DiscCam
from gearlink.core.parts.cams.follower_design import FOLLOWER_QUANTITIES, OfFollower
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.spec import DiscCamSpec
    from gearlink.core.mechanism.dynamics import Force, Torque
    from gearlink.core.parts.cams.contour import Contour
    from gearlink.core.parts.cams.flat_cam import FlatCam
    from gearlink.core.parts.cams.follower_motion import FollowerMotion
    from gearlink.core.studies.loads.spec import CamLoads


_QUANTITIES = (
    "prime_radius",
    "base_radius",
    "nose_radius",
    "nose_distance",
    "flank_radius",
    "action_angle",
    "offset",
    "start_angle",
    "center_distance",
    *FOLLOWER_QUANTITIES,
    "max_pressure_angle",
    "pressure_angle_rise",
    "pressure_angle_return",
    "min_curvature_radius",
    "min_concave_radius",
    "max_radius",
    "min_radius",
    "contact_place_max",
    "contact_place_min",
    "face_length",
    "roller_center_distance",
    "spring_preload",
    "lift_off_speed",
    "lift_error_worst",
    "lift_error_rss",
    "acceleration_error",
    "face_width_needed",
    "servo_rows",
    "servo_error",
)
_OF_CURVES = {"velocity": "1", "acceleration": "1/rad", "jerk": "1/rad^2"}
_OF_CURVES |= {"follower_velocity": "rad/s", "follower_acceleration": "rad/s^2"}
_ROCKING = {f"{curve}_{side}": unit for curve, unit in _OF_CURVES.items() for side in ("max", "min")}
_ROCKING |= dict.fromkeys(("lift_max", "lift_error_worst", "lift_error_rss", "servo_error"), "deg")
_ROCKING |= {"spring_preload": "N m", "acceleration_error": "rad/s^2"}
_CHECKS = (
    "pressure-angle",
    "cam-undercut",
    "velocity-step",
    "acceleration-step",
    "jerk-step",
    "shaft-clearance",
    "constant-sum",
    "lift-off",
    "face-length",
    "outer-wall",
    "cutter-radius",
    *LAW_CHECKS,
)
_ENLARGED = (up("cam.prime_radius"), up("cam.base_radius"), up("profile.base_radius"))
_OUTLINE = Outline(_QUANTITIES, _CHECKS, ("follower", "main_cam", "return_cam"))


class DiscCamDesign(OfFollower, Design):
    """The cam of a design file; cam axis at 0, the cam's frame is the machine's at cam angle 0."""

    kind = "disc-cam"
    spec: DiscCamSpec
    keys = dict.fromkeys(
        ("cam", "analyze"),
        (
            "lift_max",
            *(
                (f"?{name}", "?.contour")
                for name in (
                    "nose_radius",
                    "nose_distance",
                    "flank_radius",
                    "action_angle",
                    "^follower_velocity_m*",
                    "follower_acceleration_m*",
                )
            ),
            "prime_radius",
            ("?base_radius", "?.sized_base_radius"),
            ("max_pressure_angle", "<limits.pressure_angle", "<cam.size.pressure_angle"),
            "min_curvature_radius",
            "max_radius",
            "follower_velocity_max",
            "follower_acceleration_max",
            "spring_preload",
            ("lift_off_speed", ">speed"),
            "servo_error",
            "lift_error_worst",
            "velocity_max",
            "acceleration_max",
        ),
    )
    outlines = {"cam": _OUTLINE, "analyze": _OUTLINE}
    requirements = Design.requirements | {"motion", "limits.pressure_angle"}
    ways: ClassVar[Mapping[str, tuple[Way, ...]]] = {
        "pressure-angle": (*_ENLARGED, *either("follower.offset", "follower.center_distance")),
        "cam-undercut": (*_ENLARGED, down("follower.roller_radius")),
        "shaft-clearance": (*_ENLARGED, *thinner("cam.shaft_radius")),
        "lift-off": (up("spring.preload", step=1.0), up("spring.least_force", step=1.0), up("spring.rate")),
        "outer-wall": (*_ENLARGED, down("follower.roller_radius")),
        "cutter-radius": (down("cam.cutter_radius"),),
        "constant-sum": (up("return_roller.distance"), left_out("return_roller.distance")),
    }
    extra_tables: ClassVar[tuple[str, ...]] = (
        "segments",
        "arcs",
        "outer_wall",
        "cutter",
        "radius",
        "errors",
        "servo",
        LAW_TABLE,
    )
    advises = False

    @cached_property
    def cams(self) -> FollowerCams:
        """Motion, place and cams."""
        return FollowerCams(self.spec)

    @cached_property
    def closing(self) -> Closing:
        """What holds the follower on the cam."""
        return Closing(self.spec, self.cams)

    @cached_property
    def making(self) -> Making:
        """Cutter path, radii, errors and servo table."""
        return Making(self.spec, self.cams)

    at_once = 256

    @classmethod
    def find_together(cls, designs: Sequence[Any], names: Sequence[str]) -> None:
        """Cams of one motion are sought together."""
        sought(lambda some: found_together(some, names), designs)

    def as_found(self) -> Iterator[Found]:
        """The size and the preload that the limits of the file give, which cams as manufactured keep."""
        yield from self.completion()
        size, follower, spring = self.spec.cam.size, self.spec.follower, self.spec.spring
        if spring is not None and spring.preload is None:
            yield Found("spring.preload", self.closing.preload, "found for spring.least_force")
            yield Found("spring.least_force", None)
        if size is None:
            return
        place = self.cams.place
        yield Found("cam.size", None)
        yield Found(self.spec.radius_key, place.radius, "found for cam.size")
        if getattr(follower, "offset", None) == "best":
            yield Found("follower.offset", place.offset, "found for cam.size")
        if self.spec.oscillates and getattr(follower, "center_distance", None) is None:
            yield Found("follower.center_distance", place.distance, "found for cam.size")
        if size.pressure_angle is not None and self.spec.limits.pressure_angle is None:
            yield Found("limits.pressure_angle", size.pressure_angle, "of cam.size")

    def outline(self, command: str) -> Outline:
        """Without the table of a return cam where there is none, and with that of the arcs of a profile."""
        found = super().outline(command)
        if self.spec.arcs is not None:
            found = found._replace(tables=("arcs", *found.tables))
        if self.spec.return_roller is None:
            found = found._replace(tables=tuple(name for name in found.tables if name != "return_cam"))
        return found

    @classmethod
    def unit_for(cls, spec: Any, name: str, /) -> str:
        """Those of an oscillating follower are its own, the speed of lift-off has that of the cam."""
        if name == "lift_off_speed":
            return "1/min"
        return (_ROCKING.get(name) if spec.oscillates else None) or super().unit_for(spec, name)

    # Sizes

    @property
    def prime_radius(self) -> float | None:
        """Cam axis to roller centre at lift 0 [mm]; None of a face or an edge."""
        return self.cams.place.radius if self.spec.rolls else None

    @property
    def base_radius(self) -> float:
        """Cam axis to the surface at lift 0 [mm]."""
        return self.cams.place.radius - float(self.cams.roller_radius)

    @property
    def sized_base_radius(self) -> float | None:
        """That radius where it was found for a face or an edge [mm]."""
        return None if self.spec.rolls or self.spec.cam.size is None else self.base_radius

    contour: Contour | None = placed("cams.contour")
    nose_radius: float | None = placed("contour.nose")
    nose_distance: float | None = placed("contour.distance")
    action_angle: float | None = placed("contour.whole")

    @property
    def flank_radius(self) -> float | None:
        """Radius of the flanks, negative where hollow [mm]; None where they are straight, or there are none."""
        flank = None if self.contour is None else self.contour.flank
        return None if flank is None or math.isinf(flank) else flank

    @property
    def offset(self) -> float | None:
        """Offset of a translating roller or edge [mm]."""
        return self.cams.place.offset if hasattr(self.spec.follower, "offset") else None

    @property
    def start_angle(self) -> float | None:
        """Angle of a rocker at lift 0 from the line pivot -> cam axis [rad]."""
        return self.cams.place.start if self.spec.oscillates else None

    @property
    def center_distance(self) -> float | None:
        """Cam axis to pivot [mm]."""
        return self.cams.place.distance if self.spec.oscillates else None

    @property
    def roller_center_distance(self) -> float | None:
        """Distance of both rollers of a slide [mm]."""
        return None if self.spec.return_roller is None or self.spec.oscillates else self.cams.roller_distance

    # Motion

    @property
    def follower_motion(self) -> FollowerMotion:
        return self.cams.motion

    @property
    def smoother(self) -> str:  # type: ignore[override]
        """What avoids steps of the acceleration; the joints of arcs have them."""
        return super().smoother if self.spec.arcs is None else "give motion by laws such as cycloidal, without profile"

    @property
    def rocks(self) -> bool:
        return self.spec.oscillates

    # Profile

    @property
    def profiles(self) -> tuple[DiscCam | FlatCam, ...]:
        """Main cam, and the return cam where there is one."""
        if self.spec.is_flat:
            return (self.cams.flat,)
        return self.cams.discs

    @staticmethod
    def _one_or_both(values: list[Any]) -> Any:
        return values[0] if len(values) == 1 else values

    @property
    def max_pressure_angle(self) -> Any:
        """Maximum pressure angle [rad]."""
        return self._one_or_both([cam.max_pressure_angle.value for cam in self.profiles])

    pressure_angle_rise: float | None = placed("cams.steepest_rise")
    pressure_angle_return: float | None = placed("cams.steepest_return")

    @property
    def min_curvature_radius(self) -> Any:
        """Minimum convex radius of the pitch curve (of a face or an edge: of the profile) [mm]; 0 where the velocity
        steps down under a face."""
        if self.spec.is_edge:
            return self.cams.sharpest.value
        if self.spec.is_flat and self.cams.flat.crossing is not None:
            return 0.0
        return self._one_or_both([cam.min_curvature_radius.value for cam in self.profiles])

    @property
    def min_concave_radius(self) -> Any:
        """Minimum radius of the hollow flanks of the profile [mm]; None where there are none."""
        if self.spec.is_flat:
            return None
        values = [None if (found := self.cams.hollow_of(cam)) is None else found[0] for cam in self.cams.discs]
        return None if all(each is None for each in values) else self._one_or_both(values)

    @property
    def max_radius(self) -> Any:
        """Largest radius of the profile [mm]; of a groove [inner, outer wall]."""
        return self._one_or_both([cam.max_radius for cam in self.walls])

    @property
    def min_radius(self) -> Any:
        """Smallest radius of the profile [mm]; of a groove [inner, outer wall]."""
        return self._one_or_both([cam.min_radius for cam in self.walls])

    @property
    def walls(self) -> tuple[DiscCam | FlatCam, ...]:
        """The profiles that are cut."""
        return (self.cams.main, self.cams.outer_wall) if self.spec.closure == "groove" else self.profiles

    @property
    def _contact_places(self) -> tuple[float, float] | None:
        return self.cams.flat.contact_places if self.spec.is_flat else None

    contact_place_max: float | None = placed("_contact_places.1")
    contact_place_min: float | None = placed("_contact_places.0")

    @property
    def face_length(self) -> float | None:
        """Length of the flat face that the contact takes [mm]."""
        return None if (places := self._contact_places) is None else places[1] - places[0]

    spring_preload: float | None = placed("closing.preload")
    lift_off_speed: float | None = placed("closing.lift_off_speed")
    face_width_needed: float | None = placed("closing.face_width")
    lift_error_worst: float | None = placed("making.lift_error_worst")
    lift_error_rss: float | None = placed("making.lift_error_rss")
    acceleration_error: float | None = placed("making.acceleration_error")
    servo_rows: int | None = placed("making.servo_rows")
    servo_error: float | None = placed("making.servo_error")

    def require_table(self, name: str, /) -> None:
        """Refuse a table whose key the file does not have."""
        spec = self.spec
        needs = {
            "arcs": (spec.arcs is not None, "profile", "profile: {type: tangent}"),
            "cutter": (spec.cam.cutter_radius is not None, "cam", "cam.cutter_radius"),
            "errors": (spec.errors is not None, "errors", "errors: {profile: 0.01}"),
            "servo": (spec.servo is not None, "servo", "servo: {rows: 73}"),
            "return_cam": (spec.return_roller is not None, "closure", "closure: conjugate and return_roller"),
            "outer_wall": (spec.closure == "groove", "closure", "closure: groove"),
        }
        given, key, words = needs.get(name, (True, "", ""))
        if not given:
            raise MissingSection(f"the table {name} needs {words}", key=key)

    def table_arcs(self, _samples: int | None = None) -> Table:
        """The arcs of a profile, with velocity and acceleration of the follower at both ends of each."""
        assert self.contour is not None
        return arcs_table(self.contour, self.follower_motion, self.speed, oscillates=self.spec.oscillates)

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The main cam; of a groove its inner wall."""
        return self.profiles[0].table("main_cam", samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The return cam."""
        return self.profiles[1].table("return_cam", samples)

    def table_outer_wall(self, samples: int | None = None) -> Table:
        """The outer wall of a groove."""
        return curve_table("outer_wall", lambda phi: self.cams.outer_wall.points(phi)[1], samples)

    def table_cutter(self, samples: int | None = None) -> Table:
        """The cutter's centre over the cam angle."""
        return curve_table("cutter", self.making.cutter_points, samples)

    def table_radius(self, samples: int | None = None) -> Table:
        """Radius of the profile over its polar angle."""
        return self.making.radius_table(samples)

    def table_errors(self, samples: int | None = None) -> Table:
        """Errors of the lift over the cam angle."""
        return self.making.errors_table(samples)

    def table_servo(self, _samples: int | None = None) -> Table:
        """The table of a drive instead of the cam."""
        return self.making.servo_table()

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 of the stroke that is nearest to its limit."""
        rise, back = self.spec.pressure_limits()
        found = [(self.cams.steepest_rise, rise, "rise"), (self.cams.steepest_return, back, "return")]
        found.append((self.cams.steepest_dwell, max(rise, back), "dwell"))
        known = [(math.degrees(value), limit, stroke) for value, limit, stroke in found if value is not None]
        value, limit, stroke = max(known, key=lambda each: each[0] - each[1])
        over = value > limit + _FIT
        status: Status = "fail" if over else "pass"
        yield PRESSURE_ANGLE.check(status, f"pressure angle of the {stroke}", value, limit, "deg", fix=_LARGER)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402: roller against the pitch curve, or the profile under a flat face or an edge."""
        if self.spec.rolls:
            yield from undercut_checks(self.cams.discs, plainly=_LARGER, profile_stays=self.spec.profile is not None)
            return
        limit = self.spec.limits.curvature_radius
        if self.spec.is_flat:
            follower, needed = self.spec.follower, self.base_radius + limit - self.cams.flat.min_curvature_radius.value
            larger = "increase cam.base_radius by {} mm"
            # where a face rocks, the radius ends at its centre distance
            if isinstance(follower, OscillatingFlat) and needed >= follower.face_offset + follower.center_distance:
                larger = "give the motion more cam angle, or less lift"
            yield flat_undercut_check(self.cams.flat, limit, larger)
        else:
            yield edge_check(self.cams.sharpest, limit, _LARGER)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: the profile against its shaft."""
        spec = self.spec
        radius = self.cams.place.radius

        def farther(by: float) -> str:
            larger = safely_above(radius + by)
            if spec.cam.size is None:
                return f"set {spec.radius_key} to {larger}"
            center, given = self.center_distance, getattr(spec.follower, "center_distance", None)
            if given is None and center is not None:
                larger = f"{larger}, with follower.center_distance: {safely_above(center)}"
            return f"replace cam.size by {spec.radius_key}: {larger}"

        yield from hub_checks(SHAFT_CLEARANCE, self.profiles, self.spec.cam.shaft_radius, farther)

    def check_constant_sum(self) -> Iterator[Check]:
        """GL405 of the two rollers of a slide: they stand on either side of the cam axis at their distance."""
        cams = self.cams
        if cams.back is None or self.spec.oscillates:
            return
        phi = np.radians(np.arange(0.0, 360.0, 1.0))
        lift, distance = cams.motion.evaluate(phi, 0)[0], cams.roller_distance
        # along the travel: with an offset the radii themselves do not add up
        along = np.abs(cams.start_height + lift) + np.abs(cams.start_height + lift - distance)
        off, limit = float(np.abs(along - distance).max()), 1e-9 * distance
        what, aside = "deviation of the sum of the pitch radii", f"roller distance {short(distance)} mm"
        status: Status = "fail" if off > limit else "pass"
        farthest = safely_above(float((cams.start_height + lift).max()))
        fix = f"set return_roller.distance above {farthest} mm: the return roller passes the cam axis"
        yield CONSTANT_SUM.check(status, what, off, limit, "mm", aside=aside, fix=fix)

    def check_lift_off(self) -> Iterator[Check]:
        """GL406, where speed, mass and spring are given."""
        closing, spec = self.closing, self.spec
        found = closing.unloading
        if found is None or spec.speed is None:
            return
        speed = closing.lift_off_speed
        if speed is None:
            what = "the follower does not lift off its cam at any speed"
            yield LIFT_OFF.check("pass", what, None, spec.speed, "1/min")
            return
        status: Status = "fail" if speed <= spec.speed else "warn" if speed < _RESERVE * spec.speed else "pass"
        fix = ""
        if status != "pass":
            # more than that by a little: at a force of 0 it lifts off at any speed
            more, key = (1.0 + 1e-9) * closing.preload_for(_RESERVE * closing.speed), "preload"
            if spec.spring is not None and spec.spring.least_force is not None:  # the preload follows from it
                more, key = more - (closing.preload or 0.0) + spec.spring.least_force, "least_force"
            unit = "N m" if spec.oscillates else "N"
            fix = f"increase spring.{key} to {safely_above(more)} {unit} (10 % speed margin)"
        what, at = "lift-off speed of the follower", f"cam angle {short(math.degrees(found.place))} deg"
        most = _RESERVE * spec.speed
        yield LIFT_OFF.check(status, what, speed, spec.speed, "1/min", recommended=most, at=at, fix=fix)

    def check_face_length(self) -> Iterator[Check]:
        """GL408, where the file gives the face."""
        face = getattr(self.spec.follower, "face", None)
        if face is None:
            return
        low, high = self.cams.flat.contact_places
        least, most = (face[0], face[1]) if self.spec.oscillates else (-face[0], face[1])
        beyond = max(least - low, high - most)
        aside = f"contact {short(low)} to {short(high)} mm, face {short(least)} to {short(most)} mm"
        what = "contact beyond the end of the face"
        if beyond > 1e-9:
            rocks, (start, end) = self.spec.oscillates, face
            start = safely_below(min(start, low)) if rocks else safely_above(max(start, -low))
            fix = f"set follower.face to [{start}, {safely_above(max(end, high))}]"
            yield FACE_LENGTH.check("fail", what, beyond, 0.0, "mm", aside=aside, fix=fix)
        else:
            what = "the contact stays on the face"
            yield FACE_LENGTH.check("pass", what, beyond, 0.0, "mm", shown=NO_NUMBER, aside=aside)

    def check_outer_wall(self) -> Iterator[Check]:
        """GL409 of a groove."""
        if self.spec.closure != "groove":
            return
        roller, hollow = self.cams.main.roller_radius, self.cams.hollow_of(self.cams.main)
        if hollow is None:
            what = "the pitch curve is convex: the outer wall is not undercut"
            yield OUTER_WALL.check("pass", what, 0.0, roller, "mm", shown=NO_NUMBER)
            return
        least = hollow[0] - roller
        at = f"cam angle {short(math.degrees(hollow[1]))} deg"
        status: Status = "fail" if roller >= least else "pass"
        what = "roller radius against the minimum concave radius of the outer wall"
        yield OUTER_WALL.check(status, what, roller, least, "mm", at=at, fix=_LARGER)

    def check_cutter_radius(self) -> Iterator[Check]:
        """GL410, where the file gives the cutter."""
        cutter = self.spec.cam.cutter_radius
        if cutter is None:
            return
        found = self.min_concave_radius
        values = found if isinstance(found, list) else [found]
        least = min((each for each in values if each is not None), default=None)
        if least is None:
            what = "the profile has no concave flank: any cutter fits"
            yield CUTTER_RADIUS.check("pass", what, cutter, None, "mm", shown=NO_NUMBER)
            return
        what, aside = "cutter radius", "minimum concave radius of the profile"
        status: Status = "fail" if cutter >= least else "pass"
        fix = f"set cam.cutter_radius below {safely_below(least)} mm"
        yield CUTTER_RADIUS.check(status, what, cutter, least, "mm", fix=fix, aside=aside)


MILLIMETER = 1e-3
RPM = math.pi / 30.0


# What holds a follower on its cam: spring, preload, lift-off, width for the contact pressure.
#
# T = F0 + k s + m s'' Omega^2 - F_u - m g.u along the travel; oscillating: T0 + c s + J s'' Omega^2 - M about the
# pivot.


class Closing:
    """Forces along the lift [N, or N m], of a file with a spring."""

    def __init__(self, spec: DiscCamSpec, cams: FollowerCams) -> None:
        self.spec, self.cams = spec, cams
        self.follower: Any = spec.follower

    @cached_property
    def inertia(self) -> float:
        """Force per acceleration of the lift [N/(mm/s^2), or N m/(rad/s^2)]."""
        if self.spec.oscillates:
            return float(self.follower.inertia or 0.0)
        return float(self.follower.mass or 0.0) * MILLIMETER

    @property
    def speed(self) -> float:
        """Speed of the cam [rad/s]; 0 where the file gives none."""
        return 0.0 if self.spec.speed is None else self.spec.speed * RPM

    @property
    def rate(self) -> float:
        """Spring rate [N/mm, or N m/rad]."""
        return 0.0 if self.spec.spring is None else self.spec.spring.rate

    def outside(self, phi: Reals) -> Reals:
        """What acts against the spring: -F_u - m g.u of the section `loads`, without friction [N, or N m]."""
        section, found = self.spec.loads, np.zeros_like(phi)
        if section is None:
            return found
        if not self.spec.oscillates:
            gravity = complex(*section.gravity)
            found = found - self.inertia / MILLIMETER * (gravity * self.cams.direction.conjugate()).real
        if not section.forces and not section.springs:
            return found
        for act in self._applied(section, phi):
            if act.on == "follower":
                found = found - self._along(act)
        return found

    def _applied(self, section: CamLoads, phi: Reals) -> list[Force | Torque]:
        from gearlink.core.machines.disc_cam.mechanism import follower_link
        from gearlink.core.mechanism.links import Link, Mechanism
        from gearlink.core.mechanism.rates import fixed, steady
        from gearlink.core.studies.loads.sources import Sources

        links = {"cam": Link(fixed(0j, phi), steady(phi, float(self.spec.cam.sense)))}
        links["follower"] = follower_link(self.cams, phi)
        travel = {} if self.spec.oscillates else {"follower": self.cams.direction}
        return Sources(section, tuple(links), tuple(travel)).at(Mechanism(links, (), "cam", travel=travel), phi, 1.0)

    def _along(self, act: Force | Torque) -> Reals:
        """What acts on the follower, along the lift [N, or N m]."""
        from gearlink.core.mechanism.dynamics import Torque
        from gearlink.core.mechanism.rates import cross, dot

        if not self.spec.oscillates:
            assert not isinstance(act, Torque), "a slide takes no torque"
            return dot(self.cams.direction, act.force)
        turning = act.torque if isinstance(act, Torque) else cross(act.at.value - self.cams.pivot, act.force)
        return np.asarray(-self.follower.side * MILLIMETER * turning, dtype=np.float64)

    @cached_property
    def preload(self) -> float | None:
        """Force of the spring at lift 0, given or the minimum [N, or N m]; None without a spring."""
        spring = self.spec.spring
        if spring is None or spring.preload is not None:
            return None if spring is None else spring.preload
        return max(0.0, self.lacking.value)

    @cached_property
    def lacking(self) -> Extreme:
        """What the minimum force lacks at rest or at speed without a preload [N, or N m], and its cam angle."""
        assert self.spec.spring is not None, "needed with a spring alone"
        least = self.spec.spring.least_force
        assert least is not None, "needed where no preload is given"

        def lacking(phi: Reals) -> Reals:
            s, _, s2 = self.cams.motion.evaluate(phi, 2)
            still = least - self.rate * s - self.outside(phi)
            return np.maximum(still, still - self.inertia * s2 * self.speed**2)

        return self._most(lacking)

    def _most(self, course: Callable[[Reals], Reals]) -> Extreme:
        return maximum_over(course, joints=self.cams.motion.joints, samples=SAMPLES)

    def static(self, phi: Reals) -> Reals:
        """T without the inertia [N, or N m]."""
        preload = 0.0 if self.preload is None else self.preload
        found: Reals = preload + self.rate * self.cams.motion.evaluate(phi, 0)[0] + self.outside(phi)
        return found

    def force(self, phi: Reals) -> Reals:
        """T at the speed of the file [N, or N m]."""
        return self.static(phi) + self.inertia * self.cams.motion.evaluate(phi, 2)[2] * self.speed**2

    @cached_property
    def unloading(self) -> Extreme | None:
        """Maximum 1/Omega*^2 = -m s''/T_static and its cam angle; None without spring or mass.

        It is inf where the spring does not hold the follower on the cam at rest.
        """
        if self.spec.spring is None or not self.inertia:
            return None
        if self.loosest.value >= 0.0:  # the spring alone does not hold it there
            return Extreme(math.inf, self.loosest.place)
        return self.lightest

    @cached_property
    def loosest(self) -> Extreme:
        """Maximum of -T_static [N, or N m] and its cam angle."""
        return self._most(lambda phi: -self.static(phi))

    @cached_property
    def lightest(self) -> Extreme:
        """Maximum -m s''/T_static and its cam angle, of a spring that holds the follower on the cam at rest."""
        return self._most(lambda phi: -self.inertia * self.cams.motion.evaluate(phi, 2)[2] / self.static(phi))

    def preload_for(self, speed: float) -> float:
        """Preload that keeps the follower on the cam up to a speed [rad/s]."""

        def lacking(phi: Reals) -> Reals:
            s, _, s2 = self.cams.motion.evaluate(phi, 2)
            return -self.rate * s - self.outside(phi) - self.inertia * s2 * speed**2

        return max(0.0, self._most(lacking).value)

    @property
    def lift_off_speed(self) -> float | None:
        """Speed at which the follower leaves the cam [1/min]; None where nothing ever lifts it, or is known."""
        found = self.unloading
        return None if found is None or found.value <= 0.0 else math.sqrt(1.0 / found.value) / RPM

    @cached_property
    def face_width(self) -> float | None:
        """Width that keeps the allowed contact pressure [mm], b = max(N/R) E*/(pi p^2); None without one.

        Friction changes N: with it the loads alone know the width.
        """
        section = self.spec.loads
        material = None if section is None or section.friction is not None else section.material
        if material is None or material.allowed_pressure is None or self.spec.closure != "spring":
            return None
        from gearlink.core.studies.loads.contact import plane_modulus

        modulus = plane_modulus(material.modulus, material.poisson)
        worst = self._most(lambda phi: np.maximum(self.contact_force(phi), 0.0) / self.relative_radius(phi)).value
        return float(worst * modulus / (math.pi * material.allowed_pressure**2))

    def contact_force(self, phi: Reals) -> Reals:
        """N = T/cos alpha; rocker T/(l cos alpha); flat faces T, T/t [N]."""
        force, cams = self.force(phi), self.cams
        if self.spec.is_flat:
            return force / (cams.flat.touch(phi).place * MILLIMETER) if self.spec.oscillates else force
        lever = self.follower.arm * MILLIMETER if self.spec.oscillates else 1.0
        return np.asarray(force / (lever * np.cos(cams.main.pressure_angle(phi))))

    def relative_radius(self, phi: Reals) -> Reals:
        """R of the contact [mm]: r_g (1 - r_g kappa), or rho under a flat face."""
        if self.spec.is_flat:
            return self.cams.flat.touch(phi).radius
        roller = self.cams.main.roller_radius
        return np.asarray(roller * (1.0 - roller * self.cams.main.curvature(phi)))


_FIT = 1e-9  # deg: a cam that is sized lies on its limit
_RESERVE = 1.1
_LARGER = "enlarge the cam, or give the motion more cam angle"


_ALIKE = ("motion", "initial_lift", "speed", "loads", "direction", "pivot_direction", "side", "sense", "type", "angle")
_MAKING = ("lift_error_worst", "lift_error_rss", "acceleration_error")


def found_together(designs: Sequence[DiscCamDesign], names: Sequence[str]) -> None:
    """Let designs keep what their checks and some of their quantities need.

    Parameters
        designs : of files that differ by numbers of cam and follower
        names : quantities that will be asked for
    Raises
        Unlike - for files that differ otherwise, or whose motion follows from their sizes
        NoSolution - where one of them does not exist
    """
    if designs[0].spec.arcs is not None:
        raise Unlike
    spec, first = together([design.spec for design in designs], _ALIKE), designs[0]
    for design in designs:
        keep(design.cams, motion=first.cams.motion)
    hand_out(first.cams, [design.cams for design in designs], "lifts")
    for design in designs:
        keep(design, motion_extremes=first.motion_extremes)
    if "servo_error" in names:
        hand_out(first.making, [design.making for design in designs], "servo_rows", "servo_error")
    many = type(first)(spec)
    hand_out(first.cams, [many.cams], "lifts")
    keep(many.cams, motion=first.cams.motion)
    keep(many.cams, place=Place(*map(column, zip(*(design.cams.place for design in designs), strict=True))))
    wanted = {"max_pressure_angle", "max_radius", "min_radius"}.intersection(names)
    if np.any(spec.cam.shaft_radius):
        wanted.add("min_radius")
    if spec.is_flat:
        _give(many, designs, "cams.flat", "min_curvature_radius", "contact_places", *wanted)
    else:
        wanted |= {"most_convex", "least_support"}
        if "min_concave_radius" in names or spec.closure == "groove" or spec.cam.cutter_radius is not None:
            wanted.add("most_hollow")
        for name in ("main",) if spec.return_roller is None else ("main", "back"):
            _give(many, designs, f"cams.{name}", *wanted)
        if spec.closure == "groove":
            _give(many, designs, "cams.outer_wall", *wanted.intersection(("max_radius", "min_radius")))
    _give(many, designs, "cams", "steepest_rise", "steepest_return", "steepest_dwell")
    found_forces(many, designs)
    _give(many, designs, "making", *(name for name in _MAKING if name in names))


def found_forces(many: DiscCamDesign, designs: Sequence[DiscCamDesign]) -> None:
    """Preload and lift-off of a spring; where forces act at points, each design finds its own."""
    spring, section = many.spec.spring, many.spec.loads
    at_points = section is not None and (
        section.springs or any(isinstance(load.force, list) for load in section.forces)
    )
    if spring is None or at_points:
        return
    closings = [design.closing for design in designs]
    keep(many.closing, inertia=column([one.inertia for one in closings]))
    if spring.preload is None:
        _give(many, designs, "closing", "lacking")
    keep(many.closing, preload=column([one.preload for one in closings]))
    if closings[0].inertia:
        _give(many, designs, "closing", "loosest")
        if all(one.loosest.value < 0.0 for one in closings):
            _give(many, designs, "closing", "lightest")


def _give(many: DiscCamDesign, designs: Sequence[DiscCamDesign], place: str, *names: str) -> None:
    def at(design: Any) -> Any:
        for name in place.split("."):
            design = getattr(design, name)
        return design

    hand_out(at(many), [at(design) for design in designs], *names)
