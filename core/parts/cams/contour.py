"""Cams of arcs: base circle, flanks and nose, their sizes from some of them, and the motion of a sliding follower.

O is the cam axis, P and Q the centres of flank and nose, alpha the angle of ascent. Lengths in mm, angles in rad.
The arcs stand in a frame in which the follower goes counter-clockwise about the cam.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.base.wording import short, unlike
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.cams.follower_motion import DWELL, TURN, FollowerMotion, Piece, Shape

if TYPE_CHECKING:
    from gearlink.core.parts.cams.contour_spec import CircularArcProfile, EccentricProfile, TangentProfile

_NARROW = 1e-9
"""Of a turn [rad]: a narrower stretch is none."""
Height = Callable[[Reals, int], list[Reals]]
"""Height of a follower along its travel and its derivatives by the cam angle, up to an order."""


@dataclass(frozen=True)
class Contour:
    """Base circle, flanks and nose.

    Fields
        base, nose : float [mm] - r_1, r_2
        distance : float [mm] - d = OQ
        flank : float [mm] or None - R, negative where concave, inf where straight; None without flanks
        ascent : float [rad] - alpha, from where the flank leaves the base circle to the nose
    """

    base: float
    nose: float
    distance: float
    flank: float | None
    ascent: float

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
    if "action_angle" in known:
        known["ascent"] = 0.5 * known["action_angle"]
    try:
        found = _with_straight(base, known) if given.type == "tangent" else _with_arcs(base, known)
        _require(found)
    except NoSolution as error:
        change = " or ".join(f"profile.{name}" for name in sizes)
        raise NoSolution(error.message, key=error.key or "profile", fix=error.fix or f"change {change}") from None
    return found


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
        return _by_nose(base, known["nose_radius"], flank, ascent)
    if "nose_distance" in known:
        distance = known["nose_distance"]
        return Contour(base, flank - side * math.hypot(distance + along, across), distance, flank, ascent)
    whole = known["lift"] + base
    over = 2.0 * (whole + along - flank)
    nose = (to_base**2 + whole**2 + 2.0 * whole * along - flank**2) / over if over else math.nan
    return Contour(base, nose, whole - nose, flank, ascent)


def _by_nose(base: float, nose: float, flank: float, ascent: float) -> Contour:
    """The distance of the nose on the axis at which its circle touches the flank's, which may do so twice."""
    along, across = (flank - base) * math.cos(ascent), (flank - base) * math.sin(ascent)
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
    message = f"no {arc} joins a base circle of {short(base)} mm and a nose of {short(nose)} mm{where}"
    return NoSolution(message)


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


# The motion of a follower that slides


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


class _Course(NamedTuple):
    """Where a follower passes from arc to arc, and how high it stands there.

    Fields
        ends : cam angles [rad] at which flank, nose, nose behind its axis, and flank end
        heights : [mm] at the base circle, where flank and nose meet, and on the nose's axis
        arcs : flank, nose, flank
    """

    ends: tuple[float, float, float, float]
    heights: tuple[float, float, float]
    arcs: tuple[_Circle | _Line | _Face, ...]


def contour_motion(found: Contour, reach: float | None, offset: float) -> FollowerMotion:
    """The lift of a follower that slides, from the beginning of its rise.

    Parameters
        reach : float [mm] - radius of the roller, 0 of a knife edge; None: a flat face
        offset : float [mm] - eps e, the offset on the right of the travel of a cam that turns counter-clockwise
    Raises
        NoSolution - a face on a flank that is not convex, a roller too large for a concave flank, a follower that jams
    """
    course = _under_face(found) if reach is None else _under_roller(found, reach, offset)
    start, middle, top = course.heights
    flank, nose, back = course.arcs
    stretches = zip(("flank", "nose", "nose", "flank"), course.ends, (middle, top, middle, start),
                    (flank, nose, nose, back), strict=True)  # fmt: skip
    pieces: list[Piece] = []
    place, low = 0.0, 0.0
    for name, end, height, arc in stretches:
        if abs(end - place) < _NARROW:
            continue
        piece = Piece(len(pieces) + 1, place, end, low, height - start, name)
        pieces.append(replace(piece, shape=_shape(piece, start, arc.height)))
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


def _under_face(found: Contour) -> _Course:
    whole, nose = 2.0 * found.ascent, _Face(found.nose_center, found.nose)
    if found.flank is None:
        joint, middle, flank, back = 0.0, found.base, nose, nose
    elif not 0.0 < found.flank < math.inf:
        words = "straight" if found.flank > 0.0 else f"concave ({short(found.flank)} mm)"
        raise NoSolution(f"a flat face needs convex flanks, these are {words}", key="profile", fix="use a roller")
    else:
        joint, flank = cmath.phase(found.joint_normal), _Face(found.flank_center, found.flank)
        middle, back = float(nose.height(np.array(joint), 0)[0]), flank._replace(center=_beyond(found, 0.0))
    ends = joint, found.ascent, whole - joint, whole
    return _Course(ends, (found.base, middle, found.distance + found.nose), (flank, nose, back))


def _beyond(found: Contour, lead: float) -> complex:
    """Centre of the flank behind the nose, turned by an angle."""
    return found.flank_center * cmath.rect(1.0, 2.0 * found.ascent + lead)


def _under_roller(found: Contour, reach: float, offset: float) -> _Course:
    whole, prime = 2.0 * found.ascent, found.base + reach
    start = math.sqrt((prime - offset) * (prime + offset))
    lead = math.atan2(offset, start)

    def passed(size: float, direction: float) -> tuple[float, float]:
        """Cam angle at which the roller's centre passes a point of its path, and its height there."""
        height = math.sqrt((size - offset) * (size + offset))
        return lead + direction - math.atan2(offset, height), height

    nose = _Circle(found.nose_center * cmath.rect(1.0, lead), found.nose + reach, offset)
    apex, top = passed(found.distance + found.nose + reach, found.ascent)
    if found.flank is None:
        return _Course((0.0, apex, whole, whole), (start, start, top), (nose, nose, nose))
    if found.flank < 0.0 and reach >= -found.flank:
        limit = -found.flank
        message = f"roller_radius: {unlike(reach, limit)} mm (limit < {unlike(limit, reach)} mm, the concave flank)"
        raise NoSolution(message, key="follower.roller_radius", fix=f"use a roller below {short(limit)} mm")
    meeting = found.nose_center + (found.nose + reach) * found.joint_normal
    (rise, middle), (fall, _) = (
        passed(abs(meeting), direction) for direction in (cmath.phase(meeting), whole - cmath.phase(meeting))
    )
    normal = cmath.phase(found.joint_normal)
    if min(math.cos(lead + normal - rise), math.cos(lead + whole - normal - fall)) <= 0.0:
        # the tangents of a convex cam pass its axis farther than the line of travel does
        message = "the pressure angle reaches 90 deg on a concave flank: the follower jams"
        fix = "reduce the magnitude of follower.offset, or increase that of profile.flank_radius"
        raise NoSolution(message, key="profile", fix=fix)
    flank: _Circle | _Line = _Line(lead, prime, offset)
    back: _Circle | _Line = _Line(lead + whole, prime, offset)
    if not math.isinf(found.flank):
        flank = _Circle(found.flank_center * cmath.rect(1.0, lead), found.flank + reach, offset)
        back = flank._replace(center=_beyond(found, lead))
    return _Course((rise, apex, fall, whole), (start, middle, top), (flank, nose, back))


def arcs_table(found: Contour, motion: FollowerMotion, speed: float | None) -> Table:
    """Each arc with its radius, the lift at its end, and velocity and acceleration at both ends, in time as well at a
    speed [rad/s].

    Notes
        The end of an arc and the start of the next are the two sides of the jump between them.
    """
    radii = {"flank": found.flank, "nose": found.nose, DWELL: found.base}
    pieces = motion.pieces
    columns: dict[str, tuple[Any, str]] = {
        "segment": ([piece.number for piece in pieces], "1"),
        "start": ([math.degrees(piece.start) for piece in pieces], "deg"),
        "end": ([math.degrees(piece.end) for piece in pieces], "deg"),
        "arc": (["base circle" if piece.name == DWELL else piece.name for piece in pieces], "1"),
        "radius": ([None if math.isinf(radii[piece.name] or 0.0) else radii[piece.name] for piece in pieces], "mm"),
        "lift": ([piece.high for piece in pieces], "mm"),
    }
    ends = [piece.evaluate(np.array([0.0, 1.0]), 2) for piece in pieces]
    ways = [("", 1.0, "rad")] + ([] if speed is None else [("follower_", speed, "s")])
    for before, rate, unit in ways:
        for order, curve in enumerate(("velocity", "acceleration"), 1):
            for k, end in enumerate(("start", "end")):
                values = np.array([each[order][k] * rate**order for each in ends])
                columns[f"{before}{curve}_{end}"] = (values, f"mm/{unit}{'^2' * (order == 2)}")
    return Table.of("arcs", columns)
