"""Cams of a planar mechanism: the law by which each moves its follower, as a term of its equation, and its profile.

The profile is that of the cams of `core.parts.cams`, with the cam's axis at 0 and the body that carries cam and
follower as its frame; ' is by the cam angle.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from gearlink.core.base.errors import NoSolution, at_key, in_section
from gearlink.core.base.report import Check, safely_above
from gearlink.core.base.wording import short
from gearlink.core.machines.planar.wiring import FRAME
from gearlink.core.mechanism.rates import chained
from gearlink.core.numerics.arrays import unit_vector
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.parts.cams.checks import (
    flat_undercut_check,
    hub_checks,
    pressure_angle_checks,
    step_check,
    undercut_checks,
)
from gearlink.core.parts.cams.codes import ACCELERATION_STEP
from gearlink.core.parts.cams.disc_cam import SAMPLES, DiscCam
from gearlink.core.parts.cams.flat_cam import FlatCam, Touch, rocking_face, sliding_face
from gearlink.core.parts.cams.follower_motion import FollowerMotion, motion_of
from gearlink.core.parts.cams.profile import RollerPath
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gearlink.core.machines.planar.spec import CamPair
    from gearlink.core.machines.planar.structure import Line, LineJoint, Structure
    from gearlink.core.machines.planar.system import Jets
    from gearlink.core.numerics.arrays import Mask, Points, Reals

Array = TypeVar("Array", "Reals", "Points")

_DEGREE = math.pi / 180.0
_STEP = 1e-6  # of the maximum velocity: what laws that meet leave
_SQUARE = 1e-9  # cosine of a right angle
_OUTLINE, _BEYOND = 721, 0.1
_FOOT_ROUNDS, _FOOT = 12, 1e-11  # rad, after which another step would be rounding
_UPON = 2e-12  # rad, from a joint of a law: rounding
_LARGER = "move the follower farther from the cam, or give its motion more cam angle"
_USUAL = {True: 30.0, False: 45.0}
"""Maximum pressure angle of a follower that slides, and of one that turns [deg]."""


class Lift(NamedTuple):
    """share s(phi) in an equation, phi = phase + sum of directions by body.

    Fields
        bend : float - maximum |s''|
    """

    motion: FollowerMotion
    share: float
    turns: Mapping[int, float]
    phase: float
    bend: float

    def angle(self, jets: Jets, k: int) -> Reals:
        """Taylor coefficient of phi [rad]."""
        found = np.zeros(jets.t[k].shape[0]) + (self.phase if k == 0 else 0.0)
        for body, share in self.turns.items():
            found += share * jets.t[k][:, body]
        return found

    def coefficient(self, jets: Jets, k: int) -> Reals:
        """Taylor coefficient of share s(phi), k up to 3.

        Raises
            AssertionError - for a higher order, which laws do not have
        """
        if k > 3:
            raise AssertionError(f"a motion law has no derivative of order {k}")
        a = [self.angle(jets, j) for j in range(1, k + 1)]
        phi, back = self.angle(jets, 0), a[0] < 0.0 if k > 1 else np.zeros(1, dtype=bool)
        s = _on_side(lambda side: self.motion.evaluate(phi, k, side=side), back, jets.side)
        if k == 0:
            return self.share * s[0]
        found = s[1] * a[k - 1]
        if k == 2:
            found = found + 0.5 * s[2] * a[0] ** 2
        elif k == 3:
            found = found + s[2] * a[0] * a[1] + s[3] * a[0] ** 3 / 6.0
        return self.share * found

    def slope(self, jets: Jets) -> Reals:
        """Share s'(phi)."""
        return self.share * self.motion.evaluate(self.angle(jets, 0), 1, side=jets.side)[1]

    def bounds(self, jets: Jets) -> tuple[float, float, float]:
        """Of the second derivative of the term: by unknowns twice, by unknowns and the input, by the input twice."""
        steep = abs(self.share) * self.bend
        rate = abs(float(self.angle(jets, 1)[0]))
        by_unknowns = math.sqrt(sum(share * share for share in self.turns.values()))
        return steep * by_unknowns**2, steep * by_unknowns * rate, steep * rate * rate


class Support(NamedTuple):
    """The cam of a flat face as cut: distance h of its axis from a face by the direction of the face [mm by rad].

    Fields
        faces : function (cam angles, order, side) -> directions and distances of the face as the law has them
        start : float [rad] - direction at cam angle 0
    """

    faces: Callable[[Reals, int, int], tuple[list[Reals], list[Reals]]]
    start: float
    sense: int

    def evaluate(self, chi: Reals, order: int, *, side: int = 1) -> list[Reals]:
        """h and its derivatives by the direction, up to the third."""
        phi = self.angles(chi)
        way, h = self.faces(phi, order, -side * self.sense)
        back = [phi]
        if order >= 1:
            back.append(1.0 / way[1])
        if order >= 2:
            back.append(-way[2] * back[1] ** 3)
        if order >= 3:
            back.append((3.0 * way[2] ** 2 * back[1] - way[3]) * back[1] ** 4)
        return chained(h, back)

    def angles(self, chi: Reals) -> Reals:
        """Cam angles at which the face has these directions; at a joint of the law upon it."""
        phi = self.sense * (self.start - chi)
        for _ in range(_FOOT_ROUNDS):
            way, _h = self.faces(phi, 1, 1)
            step = (chi - way[0]) / way[1]
            phi = phi + step
            if not np.any(np.abs(step) > _FOOT):
                break
        return phi


class Contact(NamedTuple):
    """A roller as made on a cam as cut: the distance of its centre from the nominal pitch curve, in units of size.

    D = Re(conj(n)(z - p)), p the foot: D' = Re(conj(n) z'), phi' = Re(conj(T) z')/(|p'| + mu D theta'), mu = -sense,
    T = e^(i theta) along p', n = i sense T outwards

    Fields
        cam : CamJoint - nominal
        guess : Lift - nominal, whose angle is near
        line : Line - of the cam's link, its x axis at cam angle 0, for the roller's centre
        size : float [mm]
    """

    cam: CamJoint
    guess: Lift
    line: Line
    size: float

    def coefficient(self, jets: Jets, k: int) -> Reals:
        """Taylor coefficient of D, k up to 3."""
        return self._solved(jets, k)[0][k] / math.factorial(k)

    def angle(self, jets: Jets, k: int) -> Reals:
        """Taylor coefficient of the cam angle [rad], k up to 2."""
        return self._solved(jets, k)[1][k] / math.factorial(k)

    def across(self, jets: Jets) -> Line:
        """The line along the outward normal."""
        phi, _ = self._foot(jets)
        normal: Any = np.angle(1j * self.cam.sense * self.cam.pitch(phi, 1)[1])
        return self.line._replace(direction=self.line.direction + normal)

    def _foot(self, jets: Jets) -> tuple[Reals, Points]:
        """Cam angles of the feet, and the roller's centres in the cam's frame [size]."""
        if id(self) not in jets.kept:
            jets.kept[id(self)] = self._sought(jets.seen(self.line, 0), self.guess.angle(jets, 0))
        found: tuple[Reals, Points] = jets.kept[id(self)]
        return found

    def _sought(self, z: Points, phi: Reals) -> tuple[Reals, Points]:
        for _ in range(_FOOT_ROUNDS):
            p, p1, p2 = (each / self.size for each in self.cam.pitch(phi, 2))
            slope = (np.conj(p1) * p1).real - (np.conj(p2) * (z - p)).real
            step = (np.conj(p1) * (z - p)).real / slope
            phi = phi + step
            if not np.any(np.abs(step) > _FOOT):
                break
        return self.cam.upon_joints(phi), z

    def _pitch(self, jets: Jets, k: int) -> Sequence[Points]:
        """The pitch curve at the feet [size] with as many derivatives as order k takes; from order 2 on, of which the
        rate no longer changes, kept."""
        if (kept := (id(self), self.size)) in jets.kept:
            found: Sequence[Points] = jets.kept[kept]
            return found
        phi, _ = self._foot(jets)
        back = (np.conj(self.cam.pitch(phi, 1)[1]) * jets.seen(self.line, 1)).real < 0.0
        pitch = _on_side(lambda side: self.cam.pitch(phi, 3 if k > 1 else 2, side), back, jets.side)
        scaled = [each / self.size for each in pitch]
        if k > 1:
            jets.kept[kept] = scaled
        return scaled

    def _solved(self, jets: Jets, k: int) -> tuple[list[Reals], list[Reals]]:
        """Derivatives of D up to k and of the cam angle by the input, as many as there are motions to be derived."""
        sense, mu = self.cam.sense, -self.cam.sense
        phi, z = self._foot(jets)
        if k == 0:
            p, p1 = (each / self.size for each in self.cam.pitch(phi, 1))
            normal = 1j * sense * p1 / np.abs(p1)
            return [(np.conj(normal) * (z - p)).real], [phi]
        p, p1, *more = self._pitch(jets, k)
        v = np.abs(p1)
        along, normal = p1 / v, 1j * sense * p1 / v
        rates = [math.factorial(j) * jets.seen(self.line, j) for j in range(1, k + 1)]
        tau, nu = ([(np.conj(way) * each).real for each in rates] for way in (along, normal))
        turn = (np.conj(p1) * more[0]).imag / v**2
        d = [(np.conj(normal) * (z - p)).real, nu[0]]
        reach = v + mu * d[0] * turn
        angle = [phi, tau[0] / reach]
        if k >= 2:
            d.append(nu[1] + mu * turn * angle[1] * tau[0])
        if k >= 3:
            longer = (np.conj(p1) * more[0]).real / v
            bend = (np.conj(p1) * more[1]).imag / v**2 - 2.0 * longer * turn / v
            next_tau = tau[1] - mu * turn * angle[1] * d[1]
            next_reach = longer * angle[1] + mu * (d[1] * turn + d[0] * bend * angle[1])
            angle.append((next_tau - angle[1] * next_reach) / reach)
            turned = turn * angle[1]
            d.append(
                nu[2] + mu * (turned * tau[1] + (bend * angle[1] ** 2 + turn * angle[2]) * tau[0] + turned * next_tau)
            )
        return d, angle

    def bounds(self, jets: Jets) -> Reals:
        """K, K', M of the row, less those of the line."""
        steep = self.cam.steepest * self.size
        a, b = self.line.body, self.line.other
        moves = abs(complex(jets.x[0][0, b] - jets.x[0][0, a])) + 1.0 + 2.0**0.5 + abs(self.line.point)
        rate = abs(complex(jets.seen(self.line, 1)[0]))
        return np.array([steep * moves**2, steep * moves * rate, steep * rate**2])


class CamJoint:
    """A cam with its follower.

    Attributes
        cam, follower, carrier : int - bodies
        slide : LineJoint or None - on which the follower runs; None: it turns
        zero : float [rad or mm] - direction of the follower against the carrier at lift 0, or place of its slide
        away : +1 or -1 - way of a positive lift in the follower's coordinate
        point : complex [mm] - roller centre, or a point of the face, in coordinates of the follower
        axis, bore : complex [mm] - of the cam, in coordinates of the carrier and of its own link
        shaft : float [mm] - radius of its shaft at a point of the frame; 0 where the file names none
    """

    def __init__(self, structure: Structure, name: str, bearer: str) -> None:
        each: CamPair = structure.spec.cams[name]
        self.name, self.key, self.given = name, f"cams.{name}", each
        self.carrier, self.cam, self.follower = (structure.numbers[body] for body in (bearer, each.cam, each.follower))
        slid = structure.spec.slid.get(each.follower)
        self.slide: LineJoint | None = structure.slides[slid] if slid else None
        bodies = structure.bodies
        self.axis, self.bore = next(
            (at, bodies[each.cam][pin]) for pin, at in bodies[bearer].items() if pin in bodies[each.cam]
        )
        pins = (pin for pin, at in bodies[FRAME].items() if self.carrier == 0 and at == self.axis)
        self.shaft = max((structure.spec.shafts.get(f"{pin}_radius", 0.0) for pin in pins), default=0.0)
        self.point = bodies[each.follower][each.point]
        self._started = slid or each.follower
        self.zero = structure.start_of(self._started) or 0.0
        shared = (pin for pin in bodies[bearer] if pin in bodies[each.follower])
        self._pivot = None if slid else next((bodies[bearer][pin], bodies[each.follower][pin]) for pin in shared)
        self.sense, self.phase = each.sense, math.radians(each.phase)

    @property
    def _turns_about(self) -> complex:
        """Pivot of a follower that turns, about the cam's axis in coordinates of the carrier [mm]."""
        assert self._pivot is not None
        return self._pivot[0] - self.axis

    @cached_property
    def motion(self) -> FollowerMotion:
        """The lift [mm or rad].

        Raises
            NoSolution - where its velocity jumps
        """
        with in_section(self.key), at_key("motion"):
            found = motion_of(self.given.motion, unit=1.0 if self.slide else _DEGREE)
        phi = np.linspace(0.0, 2.0 * math.pi, SAMPLES)
        fastest = float(np.abs(found.evaluate(phi, 1)[1]).max())
        place, jump = max(found.steps(1), key=lambda step: abs(step[1]))
        if abs(jump) > _STEP * fastest:
            words = f"the velocity of the lift jumps at cam angle {place}, which no mechanism can follow"
            raise NoSolution(
                words, key=f"{self.key}.motion", fix="use laws with the same velocity on both sides of the joint"
            )
        return found

    def lift(self, size: float, phase: float) -> Lift:
        """The term of its equation, lengths in units of size; `phase` is the cam angle less its directions."""
        share = self.away / (size if self.slide else 1.0)
        turns = {self.cam: float(self.sense)} | ({self.carrier: -float(self.sense)} if self.carrier else {})
        return Lift(self.motion, share, turns, phase, self.bend)

    @cached_property
    def bend(self) -> float:
        """Maximum magnitude of the second derivative of the lift [mm or rad]."""
        motion = self.motion
        return maximum_over(lambda phi: np.abs(motion.evaluate(phi, 2)[2]), joints=motion.joints, samples=SAMPLES).value

    # The cam as cut, under a follower as made

    def _centres(self, phi: Reals, order: int, side: int = 1) -> list[Points]:
        """The roller's centre in coordinates of the carrier about the cam's axis, and its derivatives [mm]."""
        a = [self.away * each for each in self.motion.evaluate(phi, order, side=side)]
        if self.slide is not None:
            u = cmath.exp(1j * self.slide.line.direction)
            return [np.asarray(self._start + u * a[0]), *(np.asarray(u * each) for each in a[1:])]
        pivot = self._turns_about
        return [np.asarray(pivot + (self._start - pivot) * np.exp(1j * a[0])), *_turned(self._start - pivot, a)]

    def pitch(self, phi: Reals, order: int, side: int = 1) -> list[Points]:
        """The pitch curve in the cam's frame, and its derivatives [mm]."""
        b, back, e = self._centres(phi, order, side), -1j * self.sense, np.exp(-1j * self.sense * phi)
        return [
            np.asarray(e * sum(math.comb(k, j) * back**j * b[k - j] for j in range(k + 1))) for k in range(order + 1)
        ]

    def upon_joints(self, phi: Reals, within: float = _UPON) -> Reals:
        """Cam angles, those that are off a joint of the law by rounding upon it."""
        joints = np.array([*self.motion.joints, 2.0 * math.pi])
        inside = np.mod(phi, 2.0 * math.pi)
        nearest = joints[np.argmin(np.abs(inside[:, None] - joints), axis=1)]
        return np.where(np.abs(inside - nearest) <= within, phi + (nearest - inside), phi)

    @cached_property
    def steepest(self) -> float:
        """Bound of the curvature of all offsets of the pitch curve that are near it [1/mm]."""
        found = self.profile
        assert not isinstance(found, FlatCam)
        joints = self.motion.joints
        most = maximum_over(lambda phi: np.abs(found.curvature(phi)), joints=joints, samples=SAMPLES).value
        return 1.1 * most

    @cached_property
    def face_normal(self) -> complex:
        """Unit vector from the cam into the face at lift 0, in coordinates of the carrier."""
        if self.slide is not None:
            return self.away * cmath.exp(1j * self.slide.line.direction)
        return 1j * self.away * self._face(self._turns_about)[0]

    @cached_property
    def support(self) -> Support:
        """The profile of a flat face."""
        _ = self.profile  # refuses what cannot be
        normal = self.face_normal
        start = cmath.phase(normal)

        def faces(phi: Reals, order: int, side: int) -> tuple[list[Reals], list[Reals]]:
            phi = self.upon_joints(phi)
            a = [self.away * each for each in self.motion.evaluate(phi, order, side=side)]
            still = np.zeros_like(phi)
            if self.slide is not None:
                base = (normal.conjugate() * self._start).real
                way = [start - self.sense * phi, still - self.sense, still, still]
                return way[: order + 1], [base + self.away * a[0], *(self.away * each for each in a[1:])]
            pivot = self._turns_about
            w, offset = normal.conjugate() * pivot, (normal.conjugate() * (self._start - pivot)).real
            back = [-each for each in a]
            h = [offset + (w * np.exp(1j * back[0])).real, *(each.real for each in _turned(w, back))]
            way = (
                [start + a[0] - self.sense * phi, a[1] - self.sense, *a[2:]]
                if order
                else [start + a[0] - self.sense * phi]
            )
            return way, h

        return Support(faces, start, self.sense)

    @cached_property
    def round(self) -> float:
        """Bound of the second derivative of the support by the direction [mm]."""
        found = self.profile
        assert isinstance(found, FlatCam)
        phi = np.linspace(0.0, 2.0 * math.pi, SAMPLES)
        return 1.1 * float(np.abs(found.touch(phi).radius).max() + np.abs(found.points(phi)[0]).max())

    # The profile, in the carrier's coordinates about the cam's axis

    @cached_property
    def ahead(self) -> complex:
        """Unit vector of the follower's x axis at lift 0, in coordinates of the carrier."""
        if self.slide is None:
            return cmath.exp(1j * self.zero)
        return cmath.exp(1j * (self.slide.line.direction + (self.slide.lean or 0.0)))

    @cached_property
    def _start(self) -> complex:
        """The roller's centre, or the point of the face, at lift 0 [mm]."""
        if self._pivot is not None:
            at, own = self._pivot
            return at - self.axis + (self.point - own) * self.ahead
        assert self.slide is not None
        line = self.slide.line
        at = line.through + self.zero * cmath.exp(1j * line.direction)
        return at - self.axis + (self.point - line.point) * self.ahead

    @cached_property
    def away(self) -> float:
        """+1 or -1: positive lifts move away from the cam's axis.

        Raises
            NoSolution - where none of both ways does
        """
        if self.slide is not None:
            reach, size = (self._start * cmath.exp(-1j * self.slide.line.direction)).real, abs(self._start)
        else:
            pivot = self._turns_about
            toward = self._start if self.given.face is None else self._face(pivot)[0]
            reach, size = -(pivot.conjugate() * toward).imag, abs(pivot) * abs(toward)
        if abs(reach) <= _SQUARE * size:
            what = f"in the start position {self.given.point} does not move away from the axis of the cam"
            raise NoSolution(what, key=self.key, fix=f"change start.{self._started}")
        return math.copysign(1.0, reach)

    def _face(self, pivot: complex) -> tuple[complex, float]:
        """Direction of a rocking face at lift 0 from its pivot to the cam's side, and angle to the axis there [rad]."""
        along = self.ahead * cmath.exp(1j * math.radians(self.given.face or 0.0))
        if (along.conjugate() * -pivot).real < 0.0:
            along = -along
        return along, math.remainder(cmath.phase(-pivot) - cmath.phase(along), 2.0 * math.pi)

    @cached_property
    def profile(self) -> DiscCam | FlatCam:
        """The cam.

        Raises
            NoSolution - where it cannot be
        """
        title, joints = f"cam {self.name}", self.motion.joints
        if self.given.face is not None:
            return FlatCam(title, self._touch(), self.sense, joints)
        radius = self.given.roller_radius or 0.0
        if abs(self._start) <= radius:
            what = f"prime radius {short(abs(self._start))} mm is not above roller_radius {short(radius)} mm"
            raise NoSolution(what, key=f"{self.key}.roller_radius", fix="use a smaller roller, or move the follower")
        return DiscCam(title, self._path, self.sense, radius, joints, self.key)

    def _path(self, phi: Reals, order: int) -> RollerPath:
        place, *rates = self._centres(phi, max(order, 1))
        if self.slide is not None:
            way = np.full(phi.shape, self.away * cmath.exp(1j * self.slide.line.direction))
        else:
            arm = place - self._turns_about
            way = 1j * arm / np.abs(arm)
        return RollerPath(place, rates[0], rates[1] if order > 1 else np.zeros_like(place), way)

    def _touch(self) -> Callable[[Reals], Touch]:
        if self.slide is not None:
            u = self.away * cmath.exp(1j * self.slide.line.direction)
            along = self.ahead * cmath.exp(1j * math.radians(self.given.face or 0.0))
            if abs((u.conjugate() * along).real) > _SQUARE:
                what, square = (
                    "a flat face must be perpendicular to the slide of its follower",
                    cmath.phase(1j * u / self.ahead),
                )
                raise NoSolution(what, key=f"{self.key}.face", fix=f"set {self.key}.face to {math.degrees(square):.6g}")
            base = (u.conjugate() * self._start).real
            return sliding_face(self.motion, base, u, self.sense)
        pivot = self._turns_about
        along, angle = self._face(pivot)
        side = -int(self.away)
        normal = -1j * side * along
        offset = (normal.conjugate() * (self._start - pivot)).real
        if offset + abs(pivot) * math.sin(abs(angle)) <= 0.0:
            what = "there is no base circle at lift 0: the axis of the cam lies beyond the face"
            raise NoSolution(what, key=self.key, fix=f"change start.{self._started}")
        return rocking_face(self.motion, abs(angle), abs(pivot), cmath.phase(pivot), offset, side, self.sense)

    @property
    def start_radius(self) -> float:
        """Axis of the cam to the roller's centre, of a face to the surface, at lift 0 [mm]."""
        if self.given.face is None:
            return abs(self._start)
        found = self.profile
        assert isinstance(found, FlatCam)
        touch = found.touch(np.zeros(1))
        return float((np.conj(touch.normal) * touch.point).real[0])

    def contact(self, phi: Reals) -> tuple[Points | None, Points, Reals | float]:
        """Where a face touches (of a roller None: its centre), normal into the follower, pitch curvature."""
        found = self.profile
        if isinstance(found, FlatCam):
            touch = found.touch(phi)
            return touch.point + self.axis, touch.normal, 0.0
        return None, found.normals(phi), found.curvature(phi)

    def shapes(self, phase: float) -> tuple[Points, Points]:
        """The profile in coordinates of the cam's link, and roller or face in those of the follower [mm].

        Parameters
            phase : float [rad] - cam angle at direction 0 of the cam's link against the carrier
        """
        phi = np.linspace(0.0, 2.0 * math.pi, _OUTLINE)
        found = self.profile
        turned = cmath.exp(1j * self.sense * phase)
        if not isinstance(found, FlatCam):
            roller = self.point + found.roller_radius * unit_vector(phi[::8])
            return self.bore + turned * found.points(phi)[1], roller
        along = cmath.exp(1j * math.radians(self.given.face or 0.0))
        reach = (along.conjugate() * (self._seen(found.touch(phi).point, phi) - self.point)).real
        low, high = float(reach.min()), float(reach.max())
        ends = np.array([low, high]) + _BEYOND * (high - low) * np.array([-1.0, 1.0])
        return self.bore + turned * found.points(phi)[0], np.asarray(self.point + along * ends, dtype=np.complex128)

    def _seen(self, place: Points, phi: Reals) -> Points:
        """Places about the cam's axis, in coordinates of the follower at these cam angles."""
        s, start = self.away * self.motion.evaluate(phi, 0)[0], self._start
        if self.slide is not None:
            way = s * cmath.exp(1j * self.slide.line.direction)
            return np.asarray(self.point + (place - start - way) * self.ahead.conjugate())
        assert self._pivot is not None
        at, own = self._pivot
        return np.asarray(own + (place + self.axis - at) * np.exp(-1j * s) * self.ahead.conjugate())

    # Checks

    def check_pressure_angle(self, limit: float | None) -> Iterator[Check]:
        """GL401; the limit in degrees, None for the usual one."""
        return pressure_angle_checks([self.profile], limit or _USUAL[self.slide is not None], _LARGER)

    def check_undercut(self) -> Iterator[Check]:
        """GL402."""
        found = self.profile
        if isinstance(found, FlatCam):
            yield flat_undercut_check(found, 0.0, f"set the follower of {self.name} farther from the cam by {{}} mm")
        else:
            yield from undercut_checks([found], plainly=_LARGER)

    def check_step(self) -> Check:
        """GL404."""
        unit = "mm/rad^2" if self.slide is not None else "1/rad"
        steps = [(f"{place} of cam {self.name}", jump) for place, jump in self.motion.steps(2)]
        fix = "use laws that end with zero acceleration, such as cycloidal"
        return step_check(ACCELERATION_STEP, steps, self.bend, unit, "warn", fix)

    def check_shaft(self) -> Iterator[Check]:
        """GL302 against its own shaft."""
        return hub_checks(SHAFT_CLEARANCE, [self.profile], self.shaft, self._farther)

    def _farther(self, by: float) -> str:
        return f"set the follower of {self.name} farther from the cam by {safely_above(by)} mm"


def _on_side(evaluate: Callable[[int], Sequence[Array]], back: Mask, side: int) -> Sequence[Array]:
    """What a law is just after inputs (side 1) or just before them; where it is run through backwards, on the other."""
    if back.all():
        return evaluate(-side)
    ahead = evaluate(side)
    if not back.any():
        return ahead
    return [np.where(back, other, each) for other, each in zip(evaluate(-side), ahead, strict=True)]


def _turned(arm: complex, a: Sequence[Reals]) -> list[Points]:
    """Derivatives of arm e^(i a), from the first on, as many as there are of a, up to the third."""
    e = arm * np.exp(1j * a[0])
    found = []
    if len(a) > 1:
        found.append(1j * a[1] * e)
    if len(a) > 2:
        found.append((1j * a[2] - a[1] ** 2) * e)
    if len(a) > 3:
        found.append((1j * a[3] - 3.0 * a[1] * a[2] - 1j * a[1] ** 3) * e)
    return found
