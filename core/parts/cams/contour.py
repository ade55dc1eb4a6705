"""Cams of arcs: base circle, flanks and nose, their sizes from some of them, and the motion of a follower.

O is the cam axis, P and Q the centres of flank and nose, alpha the angle of ascent. Lengths in mm, angles in rad.
The arcs stand in a frame in which the follower goes counter-clockwise about the cam.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table, safely_above, safely_below
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.elementary import triangle_angle
from gearlink.core.parts.cams.follower_motion import DWELL, TURN, FollowerMotion, Piece, Shape

if TYPE_CHECKING:
    from gearlink.core.parts.cams.contour_spec import CircularArcProfile, EccentricProfile, TangentProfile

_NARROW = 1e-9
"""Of a turn [rad]: a narrower stretch is none."""
_OTHER_SIDE = 1e-7
"""Difference from which on two angles of an arm [rad] are not the same: rounding leaves some 1e-9 near a jam."""
_JAMS = 1e-9
"""How near a cosine may come to 1 before an arm counts as in line with the normal: 90 deg less 0.003 deg."""
Height = Callable[[Reals, int], list[Reals]]
"""Height of a follower along its travel and its derivatives by the cam angle, up to an order."""


@dataclass(frozen=True)
class Contour:
    """Base circle, flanks and nose.

    Fields
        base, nose : float [mm] - r_1, r_2
        distance : float [mm] - d = OQ
        flank : float [mm] or None - R, negative where concave, inf where straight; None without flanks
        ascent : float [rad] - alpha, from where the flank leaves the base circle to the nose's axis
        dwell : float [rad] - of the arc about the cam axis, of radius d + r_2, between the noses of both flanks
    """

    base: float
    nose: float
    distance: float
    flank: float | None
    ascent: float
    dwell: float = 0.0

    @property
    def whole(self) -> float:
        """From the beginning of the rise to the end of the return [rad]."""
        return 2.0 * self.ascent + self.dwell

    @property
    def flank_center(self) -> complex:
        """P, the flank leaving the base circle at the angle 0 [mm]."""
        assert self.flank is not None, "needed with flanks alone"
        return complex(self.base - self.flank)

    @property
    def nose_center(self) -> complex:
        """Q [mm]."""
        return cmath.rect(self.distance, self.ascent)

    @property
    def joint_normal(self) -> complex:
        """Unit vector out of the cam where flank and nose meet."""
        if self.flank is None or math.isinf(self.flank):
            return 1.0 + 0j
        way = (self.nose_center - self.flank_center) * math.copysign(1.0, self.flank)
        return way / abs(way)


def contour(given: TangentProfile | CircularArcProfile | EccentricProfile) -> Contour:
    """The sizes of a profile, those that the file leaves open with the others.

    Raises
        NoSolution - no such profile exists
    """
    if given.type == "eccentric":
        return Contour(given.base_radius, given.radius, given.eccentricity, None, math.pi)
    sizes, base = given.given(), given.base_radius
    known = {name: math.radians(size) if name.endswith("angle") else size for name, size in sizes.items()}
    dwell = math.radians(given.dwell_angle)
    if "action_angle" in known:
        known["ascent"] = 0.5 * (known["action_angle"] - dwell)
    try:
        found = _with_straight(base, known) if given.type == "tangent" else _with_arcs(base, known)
        _require(found)
        if found.whole + dwell > TURN + _NARROW:
            # rise, dwell and return do not fit into a revolution
            whole, most = math.degrees(found.whole + dwell), safely_below(math.degrees(TURN - found.whole))
            message = f"rise, dwell and return of the profile: {short(whole)} deg (limit <= 360 deg)"
            raise NoSolution(message, key="profile.dwell_angle", fix=f"reduce profile.dwell_angle to {most} deg")
    except NoSolution as error:
        change = " or ".join(f"profile.{name}" for name in sizes)
        raise NoSolution(error.message, key=error.key or "profile", fix=error.fix or f"change {change}") from None
    return replace(found, dwell=dwell)


def _of_nose(base: float, known: Mapping[str, float]) -> tuple[float, float] | None:
    """r_2 and d of two of these with the lift h = d + r_2 - r_1; None where only one is known."""
    nose, distance, lift = (known.get(name) for name in ("nose_radius", "nose_distance", "lift"))
    if distance is None and nose is not None and lift is not None:
        distance = lift + base - nose
    if nose is None and distance is not None and lift is not None:
        nose = lift + base - distance
    return None if nose is None or distance is None else (nose, distance)


def _with_straight(base: float, known: Mapping[str, float]) -> Contour:
    """r_1 - r_2 = d cos alpha.

    Source
        R. S. Khurmi, J. K. Gupta, Theory of Machines, tangent cam with reciprocating roller follower
    """
    both = _of_nose(base, known)
    if both is not None:
        nose, distance = both
        share = (base - nose) / distance if distance > 0.0 else math.inf
        if not -1.0 < share < 1.0:
            raise _apart(base, nose, distance)
        return Contour(base, nose, distance, math.inf, math.acos(share))
    ascent = known["ascent"]
    cosine = math.cos(ascent)
    if "nose_distance" in known:
        distance = known["nose_distance"]
        return Contour(base, base - distance * cosine, distance, math.inf, ascent)
    if "lift" in known:
        nose = base - known["lift"] * cosine / (1.0 - cosine)
        return Contour(base, nose, known["lift"] + base - nose, math.inf, ascent)
    nose = known["nose_radius"]
    if abs(cosine) < _NARROW or not (distance := (base - nose) / cosine) > 0.0:
        side = "below" if nose < base else "above"
        message = f"no straight flank leads over {short(2.0 * math.degrees(ascent))} deg to a nose of {short(nose)} mm"
        raise NoSolution(message, key="profile.action_angle", fix=f"set profile.action_angle {side} 180 deg")
    return Contour(base, nose, distance, math.inf, ascent)


def _with_arcs(base: float, known: Mapping[str, float]) -> Contour:
    """(R - r_2)^2 = (R - r_1)^2 + d^2 + 2 (R - r_1) d cos alpha.

    Source
        own derivation: the triangle O P Q, whose sides at P are R - r_1 and R - r_2
    """
    if "flank_angle" in known:
        return _by_angles(base, known)
    both, flank = _of_nose(base, known), known.get("flank_radius")
    if both is None:
        assert flank is not None, "three sizes are given"
        return _by_ascent(base, flank, known)
    nose, distance = both
    if flank is not None:
        to_base, to_nose = flank - base, flank - nose
        share = (to_nose**2 - to_base**2 - distance**2) / (2.0 * to_base * distance) if to_base * distance else math.inf
        if not -1.0 < share < 1.0:
            raise _apart(base, nose, distance, flank)
        return Contour(base, nose, distance, flank, math.acos(share))
    ascent = known["ascent"]
    over = 2.0 * (base - nose - distance * math.cos(ascent))
    if abs(over) < 1e-12 * base:
        raise NoSolution("these flanks are straight", fix="set profile.type to tangent, and omit a size")
    flank = (base**2 - nose**2 + distance**2 - 2.0 * base * distance * math.cos(ascent)) / over
    return Contour(base, nose, distance, flank, ascent)


def _by_angles(base: float, known: Mapping[str, float]) -> Contour:
    """OP : OQ : PQ = sin(alpha - phi) : sin phi : sin alpha, phi the angle of the flank's arc."""
    ascent, arc = known["ascent"], known["flank_angle"]
    to_base, distance, to_nose = math.sin(ascent - arc), math.sin(arc), math.sin(ascent)
    shares = {
        "flank_radius": (to_base, -base),
        "nose_distance": (distance, 0.0),
        "nose_radius": (to_base - to_nose, -base),
        "lift": (distance + to_base - to_nose, 0.0),
    }
    name = next(each for each in shares if each in known)
    share, less = shares[name]
    size = (known[name] + less) / share if share else -1.0
    flank = base + size * to_base
    return Contour(base, flank - size * to_nose, size * distance, flank, ascent)


def _by_ascent(base: float, flank: float, known: Mapping[str, float]) -> Contour:
    """Flank and ascent are given, and one of nose, distance and lift."""
    ascent, side, to_base = known["ascent"], math.copysign(1.0, flank), flank - base
    along, across = to_base * math.cos(ascent), to_base * math.sin(ascent)
    if "nose_radius" in known:
        return _by_nose(base, known["nose_radius"], flank, ascent, along, across)
    if "nose_distance" in known:
        distance = known["nose_distance"]
        return Contour(base, flank - side * math.hypot(distance + along, across), distance, flank, ascent)
    whole = known["lift"] + base
    over = 2.0 * (whole + along - flank)
    nose = (to_base**2 + whole**2 + 2.0 * whole * along - flank**2) / over if over else math.nan
    return Contour(base, nose, whole - nose, flank, ascent)


def _by_nose(base: float, nose: float, flank: float, ascent: float, along: float, across: float) -> Contour:
    """The distance of the nose on the axis at which its circle touches the flank's, which may do so twice."""
    root = math.sqrt(max((flank - nose) ** 2 - across**2, 0.0))
    tried = [Contour(base, nose, distance, flank, ascent) for distance in (root - along, -root - along)]
    found = []
    for each in tried if abs(flank - nose) >= abs(across) else ():
        with suppress(NoSolution):
            _require(each)
            found.append(each)
    if not found:
        raise _apart(base, nose, None, flank)
    if len(found) > 1:
        one, other = (short(each.distance) for each in found)
        message = f"two noses of {short(nose)} mm touch this flank, {one} and {other} mm from the axis"
        raise NoSolution(message, fix="give profile.nose_distance or profile.lift instead of profile.action_angle")
    return found[0]


def _apart(base: float, nose: float, distance: float | None, flank: float | None = None) -> NoSolution:
    """No flank touches base circle and nose."""
    where = "" if distance is None else f", its centre {short(distance)} mm from the axis"
    arc = "straight flank" if flank is None else f"flank of {short(flank)} mm"
    return NoSolution(f"no {arc} joins a base circle of {short(base)} mm and a nose of {short(nose)} mm{where}")


def _require(found: Contour) -> None:
    """Refuse a nose that is none, and flanks that do not lead from the base circle to the nose."""
    for name, value in (("nose_radius", found.nose), ("nose_distance", found.distance)):
        if not value > 0.0:
            raise NoSolution(f"{name} of the profile: {short(value)} mm (limit > 0 mm)")
    if not (lift := found.distance + found.nose - found.base) > 0.0:
        raise NoSolution(f"lift of the profile: {short(lift)} mm (limit > 0 mm)")
    if found.flank is not None and found.flank > 0.0 and not math.isinf(found.flank):
        least = max(found.base, found.nose)
        if found.flank <= least:
            words = f"{unlike(found.flank, least)} mm (limit > {unlike(least, found.flank)} mm, the radius within it)"
            raise NoSolution(f"flank_radius of the profile: {words}")
    # the flank ends before the nose's axis, and begins at the base circle
    turned = cmath.phase(found.joint_normal)
    if not -0.5 * math.pi < turned < found.ascent + _NARROW:
        raise NoSolution("the flank does not lead from the base circle to the nose")


# The motion of a follower


class _Circle(NamedTuple):
    """A roller of which the centre goes round a point of the cam: a slider-crank, its crank OC, its rod the radius.

    Fields
        center : complex [mm] - C
        radius : float [mm] - of the centre's path, negative in a concave flank
        offset : float [mm]
    """

    center: complex
    radius: float
    offset: float

    def height(self, phi: Reals, order: int) -> list[Reals]:
        """y = c cos(gamma - phi) + sqrt(rho^2 - w^2),  w = e - c sin(gamma - phi)."""
        turn = cmath.phase(self.center) - phi
        c, s = abs(self.center) * np.cos(turn), abs(self.center) * np.sin(turn)
        w = self.offset - s
        rod = np.copysign(np.sqrt((self.radius - w) * (self.radius + w)), self.radius)
        first = -w * c / rod
        second = -(c * c + w * s + first * first) / rod
        third = -(3.0 * c * s - w * c + 3.0 * first * second) / rod
        return [c + rod, s + first, second - c, third - s][: order + 1]


class _Line(NamedTuple):
    """A roller of which the centre goes along a straight line of the cam.

    Fields
        normal : float [rad] - direction of the line's normal
        distance, offset : float [mm]
    """

    normal: float
    distance: float
    offset: float

    def height(self, phi: Reals, order: int) -> list[Reals]:
        """y cos(phi - beta) = h + e sin(phi - beta).

        Source
            R. S. Khurmi, J. K. Gupta, Theory of Machines, tangent cam, without offset
        """
        t = np.tan(phi - self.normal)
        square = 1.0 + t * t
        y = self.distance * np.sqrt(square) + self.offset * t
        first = self.offset + y * t
        second = first * t + y * square
        return [y, first, second, second * t + 2.0 * square * (first + y * t)][: order + 1]


class _Face(NamedTuple):
    """A flat face across its travel, on an arc.

    Fields
        center : complex [mm], radius : float [mm] - of the arc
    """

    center: complex
    radius: float

    def height(self, phi: Reals, order: int) -> list[Reals]:
        """y = c cos(gamma - phi) + R.

        Source
            R. S. Khurmi, J. K. Gupta, Theory of Machines, circular arc cam with flat-faced follower
        """
        turn = cmath.phase(self.center) - phi
        along, across = abs(self.center) * np.cos(turn), abs(self.center) * np.sin(turn)
        return [along + self.radius, across, -along, -across][: order + 1]


class _OnArc(NamedTuple):
    """A roller on a rocker of which the centre Z goes round a point C of the cam, in the triangle A C Z.

    Fields
        center : complex [mm] - C
        radius : float [mm] - of the centre's path, negative in a concave flank
        start : float [rad] - direction of the pivot A from the cam axis at cam angle 0
    """

    center: complex
    radius: float
    rocker: Rocker
    start: float

    def cosine(self, phi: Reals) -> Reals:
        """Of the angle at the pivot between C and the roller's centre; beyond 1 they do not meet."""
        away = np.abs(1.0 - self._share(phi)) * self.rocker.distance
        arm = self.rocker.arm
        return np.asarray((arm * arm + away * away - self.radius * self.radius) / (2.0 * arm * away))

    def _share(self, phi: Reals) -> Any:
        return self.center / self.rocker.distance * np.exp(-1j * (phi + self.start))

    def height(self, phi: Reals, order: int) -> list[Reals]:
        """Psi = sgn(rho) kappa - sigma nu, derived by the cam angle.

        nu = arg f, ln D = ln(b |f|), f = 1 - q, q = C/A;   D cos(kappa) = (a^2 + D^2 - rho^2)/(2 a)
        """
        arm, way = self.rocker.arm, math.copysign(1.0, self.radius)
        q = self._share(phi)
        w = q / (1.0 - q)
        turns = [np.log(1.0 - q), 1j * w, w * (1.0 + w), -1j * w * (1.0 + w) * (1.0 + 2.0 * w)]
        away = np.abs(1.0 - q) * self.rocker.distance
        g = self.cosine(phi)
        h = (away * away + self.radius * self.radius - arm * arm) / (2.0 * arm * away)
        s, square = np.sqrt((1.0 - g) * (1.0 + g)), (self.radius / arm) ** 2
        # derivatives of kappa by ln D, then by the cam angle
        k1, k2 = -h / s, -g * square / s**3
        k3 = -square * (h / s**3 + 3.0 * g * g * h / s**5)
        u1, u2, u3 = (turn.real for turn in turns[1:])
        kappa = [np.arccos(g), k1 * u1, k2 * u1 * u1 + k1 * u2, k3 * u1**3 + 3.0 * k2 * u1 * u2 + k1 * u3]
        found = [way * each - self.rocker.side * turn.imag for each, turn in zip(kappa, turns, strict=True)]
        return found[: order + 1]

    def extremes(self) -> tuple[float, ...]:
        """Cam angles at which C lies on the line of cam axis and pivot."""
        direct = cmath.phase(self.center) - self.start
        return direct, direct + math.pi


class _OnLine(NamedTuple):
    """A roller on a rocker of which the centre goes along a straight line of the cam.

    Fields
        normal : float [rad] - direction of the line's normal
        height_of_line : float [mm]
        start : float [rad] - direction of the pivot A from the cam axis at cam angle 0
    """

    normal: float
    height_of_line: float
    rocker: Rocker
    start: float

    def cosine(self, phi: Reals) -> Reals:
        """cos chi = (b cos tau - h)/a,  tau from the line's normal to the pivot; beyond 1 they do not meet."""
        tau = phi + self.start - self.normal
        return np.asarray((self.rocker.distance * np.cos(tau) - self.height_of_line) / self.rocker.arm)

    def height(self, phi: Reals, order: int) -> list[Reals]:
        """Psi = sigma tau + chi, derived by the cam angle."""
        tau, side = phi + self.start - self.normal, self.rocker.side
        ratio, g = self.rocker.distance / self.rocker.arm, self.cosine(phi)
        p, r, s = ratio * np.sin(tau), ratio * np.cos(tau), np.sqrt((1.0 - g) * (1.0 + g))
        first = p / s
        second = (r - g * first * first) / s
        third = (p * (first * first - 1.0) - 3.0 * g * first * second) / s
        return [side * tau + np.arccos(g), side + first, second, third][: order + 1]

    def extremes(self) -> tuple[float, ...]:
        """Cam angles at which the pivot lies on the line's normal through the cam axis."""
        return self.normal - self.start, self.normal - self.start + math.pi


Arc = _Circle | _Line | _Face | _OnArc | _OnLine


class _Course(NamedTuple):
    """Where a follower passes from arc to arc, and how high it stands there.

    Fields
        ends : cam angles [rad] at which flank, nose, the arc about the cam axis, nose behind it, and flank end
        heights : [mm, of a rocker rad] at the base circle, where flank and nose meet, and on the nose's axis
        arcs : flank, nose, nose, flank
    """

    ends: tuple[float, float, float, float, float]
    heights: tuple[float, float, float]
    arcs: tuple[Arc, Arc, Arc, Arc]


def contour_motion(found: Contour, reach: float | None, follower: float | Rocker) -> FollowerMotion:
    """The lift of a follower, from the beginning of its rise.

    Parameters
        reach : float [mm] - radius of the roller, 0 of a knife edge; None: a flat face that slides
        follower : float [mm] or Rocker - of one that slides eps e, the offset on the right of the travel of a cam that
            turns counter-clockwise
    Returns
        motion : FollowerMotion - in mm, of a rocker in rad
    Raises
        NoSolution - a face on a flank that is not convex, a roller too large for a concave flank, a follower that jams
            or does not reach the cam
    """
    ends, (start, middle, top), (flank, nose, behind, back) = _course(found, reach, follower)
    stretches = zip(("flank", "nose", DWELL, "nose", "flank"), ends, (middle, top, top, middle, start),
                    (flank, nose, None, behind, back), strict=True)  # fmt: skip
    pieces: list[Piece] = []
    place, low = 0.0, 0.0
    for name, end, height, arc in stretches:
        if abs(end - place) < _NARROW:
            continue
        piece = Piece(len(pieces) + 1, place, end, low, height - start, name)
        pieces.append(piece if arc is None else replace(piece, shape=_shape(piece, start, arc.height)))
        place, low = end, height - start
    if TURN - place < _NARROW:
        pieces[-1] = replace(pieces[-1], end=TURN)
    else:
        pieces.append(Piece(len(pieces) + 1, place, TURN, 0.0, 0.0, DWELL))
    return FollowerMotion(pieces)


def _shape(piece: Piece, start: float, height: Height) -> Shape:
    rise, width = piece.high - piece.low, piece.width

    def shape(x: Reals, order: int) -> list[Reals]:
        value, *rates = height(piece.start + x * width, order)
        return [(value - start - piece.low) / rise, *(rate * width**n / rise for n, rate in enumerate(rates, 1))]

    return shape


def _course(found: Contour, reach: float | None, follower: float | Rocker) -> _Course:
    if reach is None:
        return _under_face(found)
    if found.flank is not None and found.flank < 0.0 and reach >= -found.flank:
        limit = -found.flank
        message = f"roller_radius: {unlike(reach, limit)} mm (limit < {unlike(limit, reach)} mm, the concave flank)"
        raise NoSolution(message, key="follower.roller_radius", fix=f"use a roller below {short(limit)} mm")
    return _on_rocker(found, reach, follower) if isinstance(follower, Rocker) else _under_roller(found, reach, follower)


def _under_face(found: Contour) -> _Course:
    whole, nose = found.whole, _Face(found.nose_center, found.nose)
    if found.flank is None:
        joint, middle, flank, back = 0.0, found.base, nose, nose
    elif not 0.0 < found.flank < math.inf:
        words = "straight" if found.flank > 0.0 else f"concave ({short(found.flank)} mm)"
        raise NoSolution(f"a flat face needs convex flanks, these are {words}", key="profile", fix="use a roller")
    else:
        joint, flank = cmath.phase(found.joint_normal), _Face(found.flank_center, found.flank)
        middle, back = float(nose.height(np.array(joint), 0)[0]), flank._replace(center=_turned(flank.center, whole))
    ends = joint, found.ascent, found.ascent + found.dwell, whole - joint, whole
    behind = nose._replace(center=_turned(nose.center, found.dwell))
    return _Course(ends, (found.base, middle, found.distance + found.nose), (flank, nose, behind, back))


def _turned(center: complex, angle: float) -> complex:
    return center * cmath.rect(1.0, angle)


def _rolled(
    found: Contour,
    reach: float,
    lead: float,
    passed: Callable[[float, float], tuple[float, float]],
    arc: Callable[[complex, float], Arc],
    line: Callable[[float, float], Arc],
) -> _Course:
    """The course of a roller.

    Parameters
        lead : float [rad] - by which the arcs are turned
        passed : (distance from the cam axis, direction) of a point of the centre's path -> cam angle and height there
        arc : (centre, radius) of the centre's path -> Arc
        line : (direction of its normal, distance) of that path -> Arc
    """
    whole, prime = found.whole, found.base + reach
    nose, behind = (arc(_turned(found.nose_center, lead + by), found.nose + reach) for by in (0.0, found.dwell))
    apex, top = passed(found.distance + found.nose + reach, found.ascent)
    _, start = passed(prime, 0.0)
    if found.flank is None:
        return _Course((0.0, apex, apex, whole, whole), (start, start, top), (nose, nose, nose, nose))
    meeting = found.nose_center + (found.nose + reach) * found.joint_normal
    (rise, middle), (fall, _) = (
        passed(abs(meeting), direction) for direction in (cmath.phase(meeting), whole - cmath.phase(meeting))
    )
    if math.isinf(found.flank):
        flank, back = (line(lead + by, prime) for by in (0.0, whole))
    else:
        flank, back = (arc(_turned(found.flank_center, lead + by), found.flank + reach) for by in (0.0, whole))
    return _Course((rise, apex, apex + found.dwell, fall, whole), (start, middle, top), (flank, nose, behind, back))


def _under_roller(found: Contour, reach: float, offset: float) -> _Course:
    prime = found.base + reach
    lead = math.atan2(offset, math.sqrt((prime - offset) * (prime + offset)))

    def passed(size: float, direction: float) -> tuple[float, float]:
        height = math.sqrt((size - offset) * (size + offset))
        return lead + direction - math.atan2(offset, height), height

    course = _rolled(found, reach, lead, passed, partial(_Circle, offset=offset), partial(_Line, offset=offset))
    normal, (rise, _, _, fall, whole) = cmath.phase(found.joint_normal), course.ends
    flanked = found.flank is not None
    if flanked and min(math.cos(lead + normal - rise), math.cos(lead + whole - normal - fall)) <= 0.0:
        # the tangents of a convex cam pass its axis farther than the line of travel does
        message = "the pressure angle reaches 90 deg on a concave flank: the follower jams"
        fix = "reduce the magnitude of follower.offset, or increase that of profile.flank_radius"
        raise NoSolution(message, key="profile", fix=fix)
    return course


class Rocker(NamedTuple):
    """A follower that turns about a pivot A, in the frame of the arcs.

    Fields
        arm, distance : float [mm] - a, from the pivot to the roller's centre, and b, to the cam axis
        side : int - sigma: +1 where the centre lies left of the line from the cam axis to the pivot
    """

    arm: float
    distance: float
    side: int

    def angle(self, size: float) -> float:
        """Psi, from the line pivot to cam axis to the arm, with the roller's centre so far from the cam axis [rad]."""
        return triangle_angle(self.arm, self.distance, size)

    def ahead(self, size: float) -> float:
        """Angle at the cam axis between pivot and roller's centre [rad]."""
        return triangle_angle(self.distance, size, self.arm)

    def require_reach(self, least: float, most: float) -> None:
        """Refuse a pitch curve whose radii, from least to most [mm], the roller's centre does not reach."""
        low, high = abs(self.arm - self.distance), self.arm + self.distance
        if low < least and most < high:
            return
        nearest, farthest = max(abs(self.arm - least), abs(self.arm - most)), self.arm + least
        fix = f"set follower.center_distance from {within(nearest, farthest, 'mm')}"
        if nearest >= farthest:
            fix = f"set follower.arm above {safely_above(0.5 * (most - least))} mm"
        raise NoSolution(
            f"radii of the pitch curve: {short(least)} to {short(most)} mm (limit {short(low)} to {short(high)} mm, "
            f"which an arm of {short(self.arm)} mm reaches, {short(self.distance)} mm from the cam axis)",
            key="follower.center_distance",
            fix=fix,
        )


def _on_rocker(found: Contour, reach: float, rocker: Rocker) -> _Course:
    course = _rocked(found, reach, rocker)
    if (jam := _jam(course)) is not None:
        message = f"the pressure angle reaches 90 deg between the cam angles {jam} deg: the follower jams"
        raise NoSolution(message, key="profile", fix=_freed(found, reach, rocker))
    return course


def _freed(found: Contour, reach: float, rocker: Rocker) -> str:
    """The nearest distance of the pivot, in steps of a hundredth, at which a rocker does not jam."""
    for change in (0.01 * step * way for step in range(1, 100) for way in (1, -1)):
        other = rocker._replace(distance=float(short(rocker.distance * (1.0 + change))))
        with suppress(NoSolution):
            if _jam(_rocked(found, reach, other)) is None:
                return f"set follower.center_distance to {other.distance:g} mm"
    return "change follower.center_distance and follower.arm"


def _rocked(found: Contour, reach: float, rocker: Rocker) -> _Course:
    prime, side = found.base + reach, rocker.side
    rocker.require_reach(prime, found.distance + found.nose + reach)
    start = -side * rocker.ahead(prime)

    def passed(size: float, direction: float) -> tuple[float, float]:
        return direction - start - side * rocker.ahead(size), rocker.angle(size)

    arc, line = (partial(each, rocker=rocker, start=start) for each in (_OnArc, _OnLine))
    return _rolled(found, reach, 0.0, passed, arc, line)


def _jam(course: _Course) -> str | None:
    """The cam angles between which a rocker jams: its arm along the normal of the profile, or beyond its reach."""
    (start, middle, top), ends = course.heights, (0.0, *course.ends)
    stretches = zip(
        course.arcs,
        ((ends[k], ends[k + 1]) for k in (0, 1, 3, 4)),
        ((start, middle), (middle, top), (top, middle), (middle, start)),
        strict=True,
    )
    for arc, (low, high), heights in stretches:
        assert isinstance(arc, _OnArc | _OnLine), "of a rocker"
        if abs(high - low) < _NARROW:
            continue
        inside = [low + turned for each in arc.extremes() if (turned := (each - low) % TURN) < high - low]
        free = high > low and bool(np.abs(arc.cosine(np.array([low, *inside, high]))).max() < 1.0 - _JAMS)
        # Where the centre comes to an end on the other side of the normal, the cam has turned back meanwhile.
        if not free or np.abs(arc.height(np.array([low, high]), 0)[0] - heights).max() > _OTHER_SIDE:
            return " and ".join(short(math.degrees(end)) for end in sorted((low, high)))
    return None


def arcs_table(found: Contour, motion: FollowerMotion, speed: float | None, *, oscillates: bool = False) -> Table:
    """Each arc with its radius, the lift at its end, and velocity and acceleration at both ends, in time as well at a
    speed [rad/s].

    Notes
        The end of an arc and the start of the next are the two sides of the jump between them.
    """
    pieces = motion.pieces
    arcs = [_arc_of(found, piece) for piece in pieces]
    lift = "deg" if oscillates else "mm"
    columns: dict[str, tuple[Any, str]] = {
        "segment": ([piece.number for piece in pieces], "1"),
        "start": ([math.degrees(piece.start) for piece in pieces], "deg"),
        "end": ([math.degrees(piece.end) for piece in pieces], "deg"),
        "arc": ([name for name, _ in arcs], "1"),
        "radius": ([None if radius is None or math.isinf(radius) else radius for _, radius in arcs], "mm"),
        "lift": ([math.degrees(piece.high) if oscillates else piece.high for piece in pieces], lift),
    }
    ends = [piece.evaluate(np.array([0.0, 1.0]), 2) for piece in pieces]
    by_angle = ("1", "1/rad") if oscillates else ("mm/rad", "mm/rad^2")
    by_time = ("rad/s", "rad/s^2") if oscillates else ("mm/s", "mm/s^2")
    ways = [("", 1.0, by_angle)] + ([] if speed is None else [("follower_", speed, by_time)])
    for before, rate, units in ways:
        for order, (curve, unit) in enumerate(zip(("velocity", "acceleration"), units, strict=True), 1):
            for k, end in enumerate(("start", "end")):
                values = np.array([each[order][k] * rate**order for each in ends])
                columns[f"{before}{curve}_{end}"] = (values, unit)
    return Table.of("arcs", columns)


def _arc_of(found: Contour, piece: Piece) -> tuple[str, float | None]:
    """Name and radius [mm] of the arc of a stretch."""
    if piece.name == DWELL:
        return ("outer circle", found.distance + found.nose) if piece.low > 0.0 else ("base circle", found.base)
    return piece.name, found.flank if piece.name == "flank" else found.nose
