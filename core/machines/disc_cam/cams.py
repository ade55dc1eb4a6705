"""The cams of a follower, given or the minimum that keep its limits, and how they are made: cutter path, errors."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import Table, safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.machines.disc_cam.spec import (
    ROLLER_SHARE,
    DiscCamSpec,
    OnRocker,
    OnSlide,
    OscillatingFlat,
    ReturnRoller,
)
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees
from gearlink.core.numerics.extremes import Extreme, maximum_over, minimum_over
from gearlink.core.parts.cams import profile
from gearlink.core.parts.cams.contour import Contour, Rocker, contour, contour_motion
from gearlink.core.parts.cams.disc_cam import SAMPLES, DiscCam
from gearlink.core.parts.cams.flat_cam import FlatCam, rocking_face, sliding_face
from gearlink.core.parts.cams.follower_motion import FollowerMotion, motion_of
from gearlink.core.parts.cams.profile import RollerPath
from gearlink.core.parts.cams.servo import greatest_error, rows_for, servo_table
from gearlink.core.parts.cams.size import (
    Line,
    Rocking,
    RockingRoller,
    first_from_which,
    flat_base_radius,
    height_at,
    height_for_curvature,
    most_in_strokes,
    nearest,
    smallest_cam_of_rollers,
    wedge,
)

DEGREE = math.pi / 180.0
_WIDEST = 50.0  # of the arm and the distance of a rocker: how far a search of its base radius goes


class Place(NamedTuple):
    """How cam and follower stand.

    Fields
        radius : float [mm] - prime radius (flat: base radius)
        offset : float [mm] - of a translating roller
        distance : float [mm] - cam axis to pivot; 0 of a slide
        start : float [rad] - Psi_0; 0 of a slide
    """

    radius: float
    offset: float = 0.0
    distance: float = 0.0
    start: float = 0.0


class FollowerCams:
    """Motion, place and cams of a design file."""

    def __init__(self, spec: DiscCamSpec) -> None:
        self.spec, self.sense = spec, spec.cam.sense
        self.follower: Any = spec.follower

    @property
    def roller_radius(self) -> Any:
        """Of the follower [mm]; 0 of a face or an edge."""
        return getattr(self.follower, "roller_radius", 0.0)

    @cached_property
    def motion(self) -> FollowerMotion:
        """Lift over the cam angle [mm or rad]."""
        spec = self.spec
        if spec.arcs is not None and self.contour is not None:
            reach, given = None if spec.is_flat else self.roller_radius, self.follower
            if spec.oscillates:
                rocker = Rocker(given.arm, given.center_distance, -self.sense * given.side)
                return contour_motion(self.contour, reach, rocker)
            return contour_motion(self.contour, reach, self.sense * float(getattr(given, "offset", 0.0)))
        assert spec.motion is not None, "a file without a profile has it"
        with at_key("motion"):
            return motion_of(spec.motion, spec.initial_lift, unit=DEGREE if spec.oscillates else 1.0, spec=spec)

    @cached_property
    def contour(self) -> Contour | None:
        """The sizes of a profile that the file gives by its arcs."""
        return None if self.spec.arcs is None else contour(self.spec.arcs)

    @cached_property
    def lifts(self) -> tuple[float, float]:
        """Minimum and maximum lift [mm or rad]."""
        low, high = (
            most(lambda phi: self.motion.evaluate(phi, 0)[0], joints=self.motion.joints, samples=SAMPLES).value
            for most in (minimum_over, maximum_over)
        )
        return low, high

    @cached_property
    def limits(self) -> tuple[float, float, float]:
        """Maximum pressure angle of rise, return and dwell [rad], of the size where it gives one."""
        size = self.spec.cam.size
        given = None if size is None else size.pressure_angle
        rise, back = given if isinstance(given, list) else (given, given) if given else self.spec.pressure_limits()
        return math.radians(rise), math.radians(back), math.radians(max(rise, back))

    def _least_radius(self, roller_radius: float | None = None) -> float:
        """Curvature radius that a size keeps under a roller, the follower's own by default [mm]."""
        size = self.spec.cam.size
        assert size is not None, "needed with a size alone"
        if size.curvature_radius is not None:
            return size.curvature_radius
        return (self.roller_radius if roller_radius is None else roller_radius) / ROLLER_SHARE

    @cached_property
    def _returning(self) -> FollowerMotion:
        """The motion as a return roller has it that stands on the other side of the cam axis: its negative."""
        return self.motion.negative()

    @property
    def _limits_of_return(self) -> tuple[float, float, float]:
        """The limits by the strokes of that motion: its rise is the follower's return."""
        rise, back, dwell = self.limits
        return back, rise, dwell

    # Where cam and follower stand

    @cached_property
    def place(self) -> Place:
        """The place, given or the minimum.

        Raises
            NoSolution - none keeps the limits, or the roller would reach over the cam's axis
        """
        found = self._rocking_place() if self.spec.oscillates else self._sliding_place()
        roller = self.roller_radius
        if found.radius <= roller:
            given = self.spec.radius is not None
            words = "prime_radius" if given else "the minimum prime radius"
            radius, limit = unlike(found.radius, roller), unlike(roller, found.radius)
            message = f"{words}: {radius} mm (limit > {limit} mm; roller_radius)"
            fix = f"set cam.prime_radius above {roller:g} mm" + ("" if given else ", or give cam.size.curvature_radius")
            raise NoSolution(message, key="cam.prime_radius" if given else "cam.size", fix=fix)
        return found

    def _sliding_place(self) -> Place:
        follower = self.follower
        if not isinstance(follower, OnSlide):
            radius = self.spec.radius or flat_base_radius(self.motion, self._least_radius())
            if not radius > 0.0:
                message = f"minimum base radius: {short(radius)} mm, since the curvature sets no limit"
                raise NoSolution(f"{message}\ngive cam.base_radius", key="cam.size")
            return Place(radius)
        if self.spec.radius is not None:
            return Place(self.spec.radius, float(follower.offset))
        lines = wedge(self.motion, self.limits, self.sense)
        roller, whole = self.spec.return_roller, sum(self.lifts)
        back: list[Line] = []
        if roller is not None:
            # its own height is L - y0, by default y0 + the sum of both lifts; its offset counts back
            found = wedge(self._returning, self._limits_of_return, self.sense)
            back = [Line(line.height - whole, -line.slope) for line in found]
        equal = roller is not None and roller.distance is None
        both = [*lines, *back] if equal else lines
        offset = nearest(both).offset if follower.offset == "best" else float(follower.offset)
        height = height_at(both, offset)
        if curved := self._least_radius():
            height = max(height, height_for_curvature(self.motion, curved, offset, self.sense))
        if roller is not None:
            least = self._least_radius(roller.radius)
            lowest = height_for_curvature(self._returning, least, -offset, self.sense) - whole
            if roller.distance is None:
                height = max(height, lowest)
            else:
                # the rollers may stand too near to each other for the limits of the return cam
                farthest = height + max(lowest, height_at(back, offset)) + whole
                if roller.distance < farthest * (1.0 - 1e-12):
                    message = f"at a roller distance of {short(roller.distance)} mm the return cam does not keep "
                    fix = f"increase return_roller.distance to {safely_above(farthest)} mm, or omit it"
                    raise NoSolution(f"{message}cam.size", key="return_roller.distance", fix=fix)
        if height + self.lifts[0] <= 0.0:
            message = "these limits set no minimum size, since the motion is so slow"
            raise NoSolution(message, key="cam.size", fix=f"give {self.spec.radius_key}")
        return Place(math.hypot(offset, height), offset)

    def _rocking_place(self) -> Place:
        follower = self.follower
        if isinstance(follower, OscillatingFlat):
            return self._rocking_face_place(follower)
        assert isinstance(follower, OnRocker), "no other follower oscillates"
        if follower.center_distance is None:
            return self._found_pivot(follower)
        if self.spec.radius is not None:
            return self._triangle(follower.arm, follower.center_distance, self.spec.radius)
        rocker = Rocking(self.motion, follower.arm, follower.center_distance, self.sense, follower.side)
        low, high = rocker.start_angles(self.limits)
        roller = self.spec.return_roller
        if roller is not None:
            least, most = self._angles_of_return(roller, follower.center_distance)
            low, high = max(low, least), min(high, most)
            if low > high:
                message = "no start angle keeps the pressure angle of both rollers"
                fix = "increase cam.size.pressure_angle, or change return_roller.angle"
                raise NoSolution(message, key="cam.size", fix=fix)
        room = partial(self._room, distance=follower.center_distance)
        start = first_from_which(room, low, high, "cam.size", steps=1 if roller is None else 32)
        return Place(rocker.prime_radius(start), 0.0, follower.center_distance, start)

    def _triangle(self, arm: float, distance: float, radius: float) -> Place:
        share = (distance**2 + arm**2 - radius**2) / (2.0 * distance * arm)
        if not -1.0 < share < 1.0:
            bound, sign = (abs(distance - arm), ">") if share > 0.0 else (distance + arm, "<")
            limit = f"limit {sign} {unlike(bound, radius)} mm; arm {arm:g} mm, center_distance {distance:g} mm"
            key = self.spec.radius_key
            message = f"{key.removeprefix('cam.')}: {unlike(radius, bound)} mm ({limit})"
            reach = within(abs(distance - arm), distance + arm, "mm")
            raise NoSolution(message, key=key, fix=f"set {key} from {reach}")
        return Place(radius, 0.0, distance, math.acos(share))

    def _angles_of_return(self, roller: ReturnRoller, distance: float) -> tuple[float, float]:
        """Minimum and maximum start angle of the first roller that keep the pressure angle of the second [rad].

        Its angle Psi is that of the first less side angle; where this is negative it stands on the other side of the
        line to the cam axis, and its angle falls as the lift rises.
        """
        side, arm = self.follower.side, roller.arm or 0.0
        ahead = side * math.remainder(math.radians(roller.angle or 0.0), 2.0 * math.pi)
        if ahead > 0.0:
            other = Rocking(self._returning, arm, distance, self.sense, -side)
            low, high = other.start_angles(self._limits_of_return)
            return ahead - high, ahead - low
        low, high = Rocking(self.motion, arm, distance, self.sense, side).start_angles(self.limits)
        return low + ahead, high + ahead

    def _room(self, start: float, distance: float) -> float:
        """Minimum convex curvature radius less what is asked for [mm], of a start angle; the lesser of two rollers."""
        place, roller = Place(0.0, 0.0, distance, start), self.spec.return_roller
        found = [(self._rocking_path(place), self._least_radius())]
        if roller is not None:
            path = self._rocking_path(place, roller.arm, math.radians(roller.angle or 0.0))
            found.append((path, self._least_radius(roller.radius)))
        return min(
            DiscCam("cam", path, self.sense, 0.0, self.motion.joints).min_curvature_radius.value - least
            for path, least in found
        )

    def _found_pivot(self, follower: OnRocker) -> Place:
        """The pivot of the smallest cam."""

        def law(phi: Reals, ahead: float = 0.0) -> tuple[Reals, Reals]:
            s, s1 = self.motion.evaluate(phi, 1)
            return ahead - follower.side * s, -follower.side * s1

        rollers, given = [RockingRoller(law, 0j, follower.arm, follower.side)], self.spec.return_roller
        if given is not None:
            ahead = math.remainder(math.radians(given.angle or 0.0), 2.0 * math.pi)
            side = -follower.side if follower.side * ahead > 0.0 else follower.side
            rollers.append(RockingRoller(partial(law, ahead=ahead), 0j, given.arm or 0.0, side))
        rise, back, dwell = self.limits
        of_sense = {1: rise, -1: back, 0: dwell}
        strokes = [] if rise == back else [(each.start, each.end, of_sense[each.sense]) for each in self.motion.strokes]
        with at_key("cam.size"):
            shared: dict[str, Any] = {"sense": self.sense, "joints": self.motion.joints, "strokes": strokes}
            center = smallest_cam_of_rollers(rollers, min(rise, back), **shared)
        at_zero = complex(follower.arm)

        def placed(share: float) -> Place:
            moved = at_zero + share * (center - at_zero)
            return Place(abs(moved - at_zero), 0.0, abs(moved), abs(cmath.phase(moved / at_zero)))

        def room(share: float) -> float:
            return self._room(placed(share).start, placed(share).distance)

        return placed(first_from_which(room, 1.0, _WIDEST, "cam.size"))

    def _rocking_face_place(self, follower: OscillatingFlat) -> Place:
        distance, offset = follower.center_distance, follower.face_offset
        low, high = self.lifts
        given = self.spec.cam.base_radius
        if given is None:

            def room(psi: float) -> float:
                flat = self._flat(Place(0.0, 0.0, distance, psi))
                return flat.min_curvature_radius.value - self._least_radius()

            start = first_from_which(room, max(1e-9, 1e-9 - low), 0.5 * math.pi - high - 1e-9, "cam.size")
            return Place(offset + distance * math.sin(start), 0.0, distance, start)
        share = (given - offset) / distance
        if not 0.0 < share < 1.0:
            low, high = max(offset, 0.0), offset + distance
            limit, key = f"> {low:g} mm and < {high:g} mm, center_distance with face_offset", "cam.base_radius"
            message = f"base_radius: {given:g} mm (limit {limit})"
            raise NoSolution(message, key=key, fix=f"set {key} between {low:g} mm and {high:g} mm")
        return Place(given, 0.0, distance, math.asin(share))

    # The cams

    @property
    def direction(self) -> complex:
        """u: direction of the travel."""
        return cmath.exp(1j * math.radians(self.follower.direction))

    @cached_property
    def start_height(self) -> float:
        """y_0 of a translating roller or edge [mm]."""
        radius, offset = self.place.radius, self.place.offset
        height: float = ((radius - offset) * (radius + offset)) ** 0.5
        return height

    @cached_property
    def pivot(self) -> complex:
        """The pivot of a rocker [mm]."""
        return self._pivot(self.place)

    def _pivot(self, place: Place) -> complex:
        return place.distance * cmath.exp(1j * math.radians(self.follower.pivot_direction))

    def arm_angle(self, place: Place, phi: Reals, order: int, side: int = 1) -> list[Reals]:
        """psi, direction of the arm from the pivot, and its derivatives [rad]."""
        follower = self.follower
        s, *rates = self.motion.evaluate(phi, order, side=side)
        start = math.radians(follower.pivot_direction) + math.pi
        return [start - follower.side * (place.start + s), *(-follower.side * rate for rate in rates)]

    def _rocking_path(
        self, place: Place, arm: float | None = None, ahead: float = 0.0
    ) -> Callable[[Reals, int], RollerPath]:
        pivot, length = self._pivot(place), self.follower.arm if arm is None else arm

        def path(phi: Reals, order: int) -> RollerPath:
            psi, *rates = self.arm_angle(place, phi, max(order, 1))
            return profile.oscillating(pivot, length, psi + ahead, *rates[:2])

        return path

    def _sliding_path(self, back: float = 0.0) -> Callable[[Reals, int], RollerPath]:
        height, offset, u = self.start_height - back, self.place.offset, self.direction

        def path(phi: Reals, order: int) -> RollerPath:
            s, *rates = self.motion.evaluate(phi, max(order, 1))
            return profile.translating(height + s, *rates[:2], direction=u, offset=offset)

        return path

    def _flat(self, place: Place) -> FlatCam:
        follower = self.follower
        if isinstance(follower, OscillatingFlat):
            direction = math.radians(follower.pivot_direction)
            where = (place.start, place.distance, direction, follower.face_offset, follower.side, self.sense)
            touch = rocking_face(self.motion, *where)
        else:
            touch = sliding_face(self.motion, place.radius, self.direction, self.sense)
        return FlatCam("cam", touch, self.sense, self.motion.joints)

    @cached_property
    def flat(self) -> FlatCam:
        """The cam under a flat face."""
        return self._flat(self.place)

    @cached_property
    def main(self) -> DiscCam:
        """The cam of the roller, or of an edge, which is one of radius 0."""
        path = self._rocking_path(self.place) if self.spec.oscillates else self._sliding_path()
        key = "cam" if self.spec.radius is None else self.spec.radius_key
        return DiscCam("main cam", path, self.sense, self.roller_radius, self.motion.joints, key)

    @cached_property
    def back(self) -> DiscCam | None:
        """The cam of the return roller; None without one."""
        roller = self.spec.return_roller
        if roller is None:
            return None
        if self.spec.oscillates:
            self._require_across(roller)
            path = self._rocking_path(self.place, roller.arm, math.radians(roller.angle or 0.0))
        else:
            path = self._sliding_path(self.roller_distance)
        return DiscCam("return cam", path, self.sense, roller.radius, self.motion.joints, "return_roller")

    @property
    def discs(self) -> tuple[DiscCam, ...]:
        """The cams of rollers or an edge: main cam, and the return cam where there is one."""
        return (self.main,) if self.back is None else (self.main, self.back)

    def _require_across(self, roller: ReturnRoller) -> None:
        """Refuse a return roller of a rocker that its cam pushes the same way as the main one: nothing holds it then.

        A cam pushes a roller away from the line of centres, so both stand on different sides of it.
        """
        place, (low, high) = self.place, self.lifts
        side = self.follower.side
        least, most = np.max(np.degrees(place.start + high)), np.min(np.degrees(place.start + low)) + 180.0
        angle = (side * (roller.angle or 0.0)) % 360.0
        if not least < angle < most:
            message = f"return_roller.angle: {short(roller.angle or 0.0)} deg: both cams push the rocker the same way"
            bounds = sorted((side * least, side * most))
            fix = f"choose one from {within(bounds[0], bounds[1], 'deg')}, across the line of centres"
            raise NoSolution(message, key="return_roller.angle", fix=fix)

    @cached_property
    def roller_distance(self) -> float:
        """Distance of both rollers of a slide [mm]; by default that of pitch curves which reach equally far."""
        roller = self.spec.return_roller
        assert roller is not None
        return 2.0 * self.start_height + sum(self.lifts) if roller.distance is None else roller.distance

    @cached_property
    def outer_wall(self) -> DiscCam:
        """The outer wall of a groove, as a roller of negative radius leaves it."""
        main = self.main
        return DiscCam("outer wall", main.path, main.sense, -main.roller_radius, main.joints, main.key)

    @cached_property
    def sharpest(self) -> Extreme:
        """Minimum convex radius of the profile under an edge [mm] and its cam angle [rad]; 0 at a corner.

        Such a profile never crosses itself: an edge that does not pass the relative pole meets each point of the cam in
        one place alone, at the distance of the point from the axis.
        """
        outward = max(self.main.corners, default=Extreme(0.0, 0.0))
        return outward._replace(value=0.0) if outward.value > 0.0 else self.main.min_curvature_radius

    def hollow_of(self, cam: DiscCam) -> tuple[float, float] | None:
        """Minimum hollow radius of a cam's profile, 1/max(-kappa) + r_g [mm], and its cam angle [rad].

        A hollow corner of the pitch curve leaves the roller's own radius in the profile.
        """
        inward = min(cam.corners, default=Extreme(0.0, 0.0))
        if inward.value < 0.0:
            return cam.roller_radius, inward.place
        lowest = cam.most_hollow
        if lowest.value >= -1e-12 / self.place.radius:
            return None
        return cam.roller_radius - 1.0 / lowest.value, lowest.place

    @cached_property
    def steepest_rise(self) -> float | None:
        """Maximum magnitude of the pressure angle in rises [rad]; None without one."""
        return self._most_in_strokes(1)

    @cached_property
    def steepest_return(self) -> float | None:
        """The same in returns."""
        return self._most_in_strokes(-1)

    @cached_property
    def steepest_dwell(self) -> float | None:
        """The same in dwells."""
        return self._most_in_strokes(0)

    def _most_in_strokes(self, sense: int) -> float | None:
        cams = (self.flat,) if self.spec.is_flat else self.discs
        return most_in_strokes(self.motion, [cam.size_of_pressure_angle for cam in cams], sense)


_TURN = 2.0 * math.pi
_CLOSE = 4097
_HALVINGS = 60


class Making:
    """Cutter, radii, errors and servo table of a design file."""

    def __init__(self, spec: DiscCamSpec, cams: FollowerCams) -> None:
        self.spec, self.cams = spec, cams
        self.follower: Any = spec.follower

    def points(self, phi: Reals) -> Points:
        """Points of the profile [mm], in the cam's frame."""
        return self.cams.flat.points(phi)[0] if self.spec.is_flat else self.cams.main.points(phi)[1]

    def cutter_points(self, phi: Reals) -> Points:
        """Centre of the cutter [mm], in the cam's frame: C + r_c n, n outward."""
        radius = self.spec.cam.cutter_radius
        assert radius is not None, "needed with a cutter alone"
        if self.spec.is_flat:
            return self.cams.flat.outside(radius).points(phi)[0]
        main = self.cams.main
        reach = main.roller_radius - radius
        return profile.profile_points(phi, main.path(phi, 1), sense=main.sense, roller_radius=reach)

    def radius_table(self, samples: int | None) -> Table:
        """Radius of the profile over its polar angle.

        Raises
            NoSolution - where the profile is not star-shaped
        """
        degrees, sense = turn_degrees(samples), self.spec.cam.sense
        near = np.linspace(0.0, _TURN, _CLOSE)
        back = -sense * np.unwrap(np.angle(self.points(near)))
        if not np.all(np.diff(back) > 0.0):
            message = "a ray from the cam axis meets the profile more than once: it has no radius over the polar angle"
            raise NoSolution(message, key="cam")
        wanted = back[0] + np.mod(-sense * np.radians(degrees) - back[0], _TURN)
        after = np.clip(np.searchsorted(back, wanted, side="right"), 1, _CLOSE - 1)
        low, high = near[after - 1], near[after]
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            ahead = np.angle(self.points(middle) * np.exp(1j * sense * wanted)) * -sense > 0.0
            low, high = np.where(ahead, low, middle), np.where(ahead, middle, high)
        phi = np.where(0.5 * (low + high) > _TURN - 1e-13, 0.0, 0.5 * (low + high))
        columns = {"radius": (np.abs(self.points(phi)), "mm"), "cam_angle": (np.degrees(phi), "deg")}
        return Table.of("radius", {"polar_angle": (degrees, "deg"), **columns})

    # Errors

    def _per_normal(self, phi: Reals) -> Reals:
        """Lift by a displacement of the profile along its normal: 1/cos alpha, 1/(l cos alpha), 1, 1/t [1, 1/mm]."""
        cams = self.cams
        if self.spec.is_flat:
            return 1.0 / cams.flat.touch(phi).place if self.spec.oscillates else np.ones_like(phi)
        lever = self.follower.arm if self.spec.oscillates else 1.0
        return np.asarray(1.0 / (lever * np.cos(cams.main.pressure_angle(phi))))

    def parts(self, phi: Reals) -> dict[str, Reals]:
        """Errors of the lift by their sources [mm, or rad]."""
        given = self.spec.errors
        assert given is not None, "needed with errors alone"
        share = np.abs(self._per_normal(phi))
        roller = 0.0 if self.spec.is_flat else given.roller_radius
        return {
            "profile": given.profile * share,
            "run_out": 0.5 * given.run_out * share,
            "key": np.abs(self.cams.motion.evaluate(phi, 1)[1]) * np.radians(given.key),
            "roller_radius": roller * share,
        }

    def _worst(self, phi: Reals) -> Reals:
        return np.asarray(sum(self.parts(phi).values()))

    def _rss(self, phi: Reals) -> Reals:
        return np.asarray(np.sqrt(sum(part**2 for part in self.parts(phi).values())))

    @cached_property
    def lift_error_worst(self) -> float | None:
        """Maximum sum of the errors [mm, or rad]; None without errors."""
        return None if self.spec.errors is None else self._most(self._worst)

    @cached_property
    def lift_error_rss(self) -> float | None:
        """Maximum root of the sum of their squares [mm, or rad]."""
        return None if self.spec.errors is None else self._most(self._rss)

    @cached_property
    def acceleration_error(self) -> float | None:
        """Maximum acceleration that waves of the profile make, n^2 Omega^2 delta/cos alpha [mm/s^2, or rad/s^2]."""
        given = self.spec.errors
        if given is None or given.waves is None or self.spec.speed is None:
            return None
        speed = self.spec.speed * math.pi / 30.0
        return (given.waves * speed) ** 2 * given.profile * self._most(lambda phi: np.abs(self._per_normal(phi)))

    def _most(self, course: Callable[[Reals], Reals]) -> float:
        return maximum_over(course, joints=self.cams.motion.joints, samples=SAMPLES).value

    def errors_table(self, samples: int | None) -> Table:
        """Errors of the lift over the cam angle."""
        degrees = turn_degrees(samples)
        phi = np.radians(degrees)
        found = {**self.parts(phi), "worst": self._worst(phi), "rss": self._rss(phi)}
        rocks = self.spec.oscillates
        columns = {name: (np.degrees(v), "deg") if rocks else (v, "mm") for name, v in found.items()}
        return Table.of("errors", {"cam_angle": (degrees, "deg"), **columns})

    # The table of a drive

    @cached_property
    def servo_rows(self) -> int | None:
        """Rows of the table, both ends; None without the section."""
        servo = self.spec.servo
        if servo is None or servo.tolerance is None:
            return None if servo is None else servo.rows
        return rows_for(self.cams.motion, servo.tolerance, rocks=self.spec.oscillates)

    @cached_property
    def servo_error(self) -> float | None:
        """Maximum error of the position between the rows [mm, or rad]."""
        rows = self.servo_rows
        return None if rows is None else greatest_error(self.cams.motion, rows)

    def servo_table(self) -> Table:
        """Positions and derivatives per degree at equal steps of the cam angle."""
        rows = self.servo_rows
        assert rows is not None, "needed with the section alone"
        return servo_table(self.cams.motion, rows, rocks=self.spec.oscillates)


def curve_table(name: str, points: Callable[[Reals], Points], samples: int | None) -> Table:
    """A curve in the cam's frame [mm] over the cam angle."""
    degrees = turn_degrees(samples)
    found = points(np.radians(degrees))
    return Table.of(name, {"cam_angle": (degrees, "deg"), "x": (found.real, "mm"), "y": (found.imag, "mm")})
