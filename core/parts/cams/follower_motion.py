"""The motion of a cam follower over one revolution: segments with their laws, polynomials joined between them, splines.

Angles in rad, lifts in mm or rad. A joint belongs to the segment that starts there.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution, in_section
from gearlink.core.numerics.arrays import Reals, distinct
from gearlink.core.numerics.bernstein import HERMITE
from gearlink.core.numerics.roots import roots_on
from gearlink.core.parts.cams.laws import Law, law

if TYPE_CHECKING:
    from gearlink.core.parts.cams.motion_spec import MotionTable, Segment

TURN = 2.0 * math.pi
DWELL, POLYNOMIAL = "dwell", "polynomial"
_Ends = tuple[float | None, float | None]  # velocity and acceleration at the end of a segment, where the file has them
_NOTHING = 1e-9  # of a piece: roots of its velocity nearer to an end are the end's own

Shape = Callable[[Reals, int], Sequence[Reals]]
"""Rise from 0 to 1 and its derivatives by x in [0, 1], up to an order."""


@dataclass(frozen=True)
class Piece:
    """A stretch with one law.

    Fields
        number : int - of the segment of the file, from 1
        start, end : float [rad]
        low, high : float [mm or rad] - lift at both ends
        name : str - of the law
        shape : Shape or None - None: a dwell
        coefficients : (6,) tuple - of a polynomial in x, the lift itself; empty: no polynomial
        joints : floats in (0, 1) - where its law changes
        ends : (velocity, acceleration) at start and end - what the law imposes on its neighbours, by the cam angle
        law : Law or None - that it runs by, where it is one of `laws`
        waits : Segment or None - whose law takes the values of a neighbour, and is made when that is known
    """

    number: int
    start: float
    end: float
    low: float
    high: float
    name: str
    shape: Shape | None = None
    coefficients: tuple[float, ...] = ()
    joints: tuple[float, ...] = ()
    ends: tuple[tuple[float, float], tuple[float, float]] = ((0.0, 0.0), (0.0, 0.0))
    law: Law | None = None
    waits: Segment | None = None

    @property
    def width(self) -> float:
        """b [rad]."""
        return self.end - self.start

    @property
    def rises(self) -> int:
        """+1, -1, or 0 in a dwell."""
        return 0 if self.shape is None and not self.coefficients else _sign(self.high - self.low)

    def evaluate(self, x: Reals, order: int) -> list[Reals]:
        """Lift and its derivatives by the cam angle.

        s = L0 + (L1 - L0) s^(x),  s^(n) = (L1 - L0) s^^(n)(x)/b^n
        """
        if self.coefficients:
            found = _polynomial(self.coefficients, x, order)
            return [each / self.width**n for n, each in enumerate(found)]
        if self.shape is None:
            return [np.full_like(x, self.low), *(np.zeros_like(x) for _ in range(order))]
        rise, height = self.shape(x, order), self.high - self.low
        return [self.low + height * rise[0], *(height * each / self.width**n for n, each in enumerate(rise) if n)]

    def backwards(self, number: int, start: float, end: float) -> Piece:
        """The piece run from its end to its start over another width."""
        share = (end - start) / self.width
        shape = None if self.shape is None else _backwards(self.shape)
        powers = np.polynomial.Polynomial(self.coefficients or (0.0,))(np.polynomial.Polynomial([1.0, -1.0])).coef
        (v0, a0), (v1, a1) = self.ends
        return replace(
            self,
            number=number,
            start=start,
            end=end,
            low=self.high,
            high=self.low,
            shape=shape,
            coefficients=tuple(np.pad(powers, (0, 6 - powers.size)).tolist()) if self.coefficients else (),
            joints=tuple(sorted(1.0 - x for x in self.joints)),
            ends=((-v1 / share, a1 / share**2), (-v0 / share, a0 / share**2)),
        )


class Stroke(NamedTuple):
    """A stretch in which the lift rises (+1), falls (-1) or stands (0) [rad]."""

    start: float
    end: float
    sense: int


class FollowerMotion:
    """The lift over a revolution of the cam.

    Parameters
        pieces : Pieces that follow each other from 0 to 2 pi
    """

    highest = 3
    """The highest derivative that it gives."""

    def __init__(self, pieces: Sequence[Piece]) -> None:
        self.pieces = tuple(pieces)
        self._starts = np.array([piece.start for piece in self.pieces])

    @cached_property
    def joints(self) -> tuple[float, ...]:
        """Cam angles at which a law changes, those within laws among them [rad]."""
        found = {piece.start + x * piece.width for piece in self.pieces for x in (0.0, *piece.joints)}
        return tuple(sorted(found))

    def evaluate(self, phi: Reals, order: int = 3, *, side: int = 1) -> list[Reals]:
        """Lift and its derivatives.

        Parameters
            phi : (N,) array [rad] - cam angle, reduced to one revolution
            order : int - 0 to 3
            side : +1 or -1 - at a joint, the piece that starts there or the one that ends there
        Returns
            s, s', ... : (N,) arrays [mm or rad, per rad of the cam angle]
        """
        turned = np.mod(np.asarray(phi, dtype=float), TURN)
        index = np.searchsorted(self._starts, turned, side="right" if side > 0 else "left") - 1
        if side < 0:
            turned = np.where(index < 0, TURN, turned)
            index = np.where(index < 0, len(self.pieces) - 1, index)
        found = [np.empty_like(turned) for _ in range(order + 1)]
        for k in distinct(index).tolist():
            piece, inside = self.pieces[k], index == k
            x = np.clip((turned[inside] - piece.start) / piece.width, 0.0, 1.0)
            for into, values in zip(found, piece.evaluate(x, order), strict=False):
                into[inside] = values
        return found

    def negative(self) -> FollowerMotion:
        """The motion with the sign of every lift changed."""
        turned = [
            replace(
                piece,
                low=-piece.low,
                high=-piece.high,
                coefficients=tuple(-each for each in piece.coefficients),
                ends=tuple((-v, -a) for v, a in piece.ends),  # type: ignore[arg-type]
            )
            for piece in self.pieces
        ]
        return FollowerMotion(turned)

    def numbers(self, phi: Reals) -> Reals:
        """Number of the segment, from 1, at cam angles."""
        index = np.searchsorted(self._starts, np.mod(phi, TURN), side="right") - 1
        return np.array([piece.number for piece in self.pieces])[index]

    @cached_property
    def strokes(self) -> tuple[Stroke, ...]:
        """Where the lift rises, falls and stands; a polynomial that turns round is divided there."""
        found = []
        for piece in self.pieces:
            cuts = [0.0, *_turning_places(piece), 1.0]
            for low, high in pairwise(cuts):
                sense = piece.rises
                if len(cuts) > 2 or piece.coefficients:
                    sense = _sign(float(piece.evaluate(np.array([0.5 * (low + high)]), 1)[1][0]))
                found.append(Stroke(piece.start + low * piece.width, piece.start + high * piece.width, sense))
        return tuple(found)

    def steps(self, order: int) -> list[tuple[str, float]]:
        """Jumps of a derivative of the lift at the joints of the segments, by the place's words."""
        places = [f"{math.degrees(place):.5g} deg" for place in self._starts]
        return list(zip(places, self._jumps[order].tolist(), strict=True))

    @cached_property
    def _jumps(self) -> list[Reals]:
        """Jumps of the lift and its derivatives at the starts of the pieces."""
        sides = (self.evaluate(self._starts, self.highest, side=side) for side in (1, -1))
        return [after - before for after, before in zip(*sides, strict=True)]


def motion_of(
    motion: list[Segment] | MotionTable,
    initial_lift: float = 0.0,
    *,
    unit: float = 1.0,
    spec: Any = None,
    whole: float = 0.0,
) -> FollowerMotion:
    """The motion that a design file gives.

    Parameters
        unit : float - of its lifts: 1 for mm, pi/180 for deg
        spec : the design file, of whose speed and vibration laws may be shaped; None: they know of none
        whole : float - of what turns round: the lift of a revolution, by whole multiples of which it may end higher
    Raises
        NoSolution - at `motion`, for a law that cannot be or a lift that does not return
    """
    if not isinstance(motion, list):
        return spline([math.radians(angle) for angle, _ in motion.rows], [unit * lift for _, lift in motion.rows])
    pieces: list[Piece] = []
    given: dict[int, _Ends] = {}
    start, lift = 0.0, unit * initial_lift
    for number, segment in enumerate(motion, 1):
        end = math.radians(segment.to)
        if segment.return_ is not None:
            pieces += _mirrored_rise(pieces, number, start, end, unit)
        else:
            target = lift if segment.lift is None else unit * segment.lift
            pieces.append(_piece(segment, number, (start, end), (lift, target), unit, spec))
            if segment.end_velocity is not None or segment.end_acceleration is not None:
                v, a = segment.end_velocity, segment.end_acceleration
                given[len(pieces) - 1] = None if v is None else unit * v, None if a is None else unit * a
        start, lift = end, pieces[-1].high
    gained = lift - unit * initial_lift
    if abs(gained - (whole * round(gained / whole) if whole else 0.0)) > 1e-9 * max(1.0, abs(lift)):
        message = f"the lift ends at {lift / unit:.9g} and starts at {initial_lift:.9g}"
        raise NoSolution(message, key="motion", fix="let the lift return to its start")
    return FollowerMotion(_joined(_awaited(pieces, unit), given))


def spline(angles: Sequence[float], lifts: Sequence[float]) -> FollowerMotion:
    """The periodic quintic spline through points, continuous to the fourth derivative.

    Parameters
        angles : floats [rad] - from 0 to 2 pi
        lifts : floats - the last the same as the first
    Source
        minimum integral of s'''^2: jerk and fourth derivative are continuous at every point
    """
    pieces = [
        Piece(k + 1, angles[k], angles[k + 1], lifts[k], lifts[k + 1], POLYNOMIAL, coefficients=(0.0,) * 6)
        for k in range(len(angles) - 1)
    ]
    return FollowerMotion(_joined(pieces, {}, turns_round=False))


# Pieces of the laws of a file


def _piece(
    segment: Segment, number: int, span: tuple[float, float], lifts: tuple[float, float], unit: float, spec: Any
) -> Piece:
    blank = Piece(number, *span, *lifts, DWELL)
    if segment.law == POLYNOMIAL:
        return replace(blank, name=POLYNOMIAL, coefficients=(0.0,) * 6)
    if lifts[0] == lifts[1]:
        return blank
    slope = (lifts[1] - lifts[0]) / blank.width
    if segment.law == "constant-velocity":
        return replace(blank, name="constant-velocity", shape=_even, ends=((slope, 0.0), (slope, 0.0)))
    try:
        if getattr(segment.law, "joins", False) and "join" in (segment.law.start, segment.law.end):  # type: ignore[union-attr]
            return replace(blank, name=segment.law.type, waits=segment)  # type: ignore[union-attr]
        return _of_law(blank, segment, slope, unit, spec)
    except NoSolution as error:
        key = error.key or f"motion[{number - 1}].law"
        raise NoSolution(f"segment {number}: {error.message}", key=key, fix=error.fix) from error


def _of_law(blank: Piece, segment: Segment, slope: float, unit: float, spec: Any) -> Piece:
    definition: Any = "modified-sine" if segment.law is None else segment.law
    one: Law | None = None
    if isinstance(definition, Mapping) and "type" in definition:
        shape, joints, name = _mapped(definition)
    else:
        phase = None
        if not isinstance(definition, str | Mapping):
            from gearlink.core.parts.cams.shaped import Drive

            phase = Drive.of(spec).phase(blank.width, (blank.high - blank.low) / unit)
        with in_section(f"motion[{blank.number - 1}].law"):
            one = law(definition, phase)
        joints, name = one.joints, one.name
        blank = replace(blank, law=one)
        if not one.kappa:
            raise NoSolution(f"the {one.name} law ends where it starts: between two lifts its s runs from 0 to 1")
        shape = _normalised(one)
        if one.kind == "rest-to-speed":
            rest, speed = (0.0, 0.0), (slope / one.kappa, 0.0)
            if segment.mirrored:
                shape, joints = _backwards(shape), tuple(sorted(1.0 - x for x in joints))
            ends = (speed, rest) if segment.mirrored else (rest, speed)
            return replace(blank, name=name, shape=shape, joints=joints, ends=ends)
    if segment.mirrored:
        raise NoSolution(f"mirrored applies only to a law from rest to speed; {name} runs from rest to rest")
    return replace(blank, name=name, shape=shape, joints=joints, ends=_ends(blank, shape))


def _ends(blank: Piece, shape: Shape) -> tuple[tuple[float, float], tuple[float, float]]:
    """Velocity and acceleration at both ends of a piece with a shape, by the cam angle."""
    _, v, a = shape(np.array([0.0, 1.0]), 2)
    slope = (blank.high - blank.low) / blank.width
    first, last = ((slope * float(v[k]), slope / blank.width * float(a[k])) for k in (0, 1))
    return first, last


def _even(x: Reals, order: int) -> list[Reals]:
    return [x, np.ones_like(x), np.zeros_like(x), np.zeros_like(x)][: order + 1]


def _normalised(one: Law) -> Shape:
    """From 0 to 1, whatever its own ends are."""
    if one.kind == "rest-to-rest":
        return lambda x, order: one.derivatives(x, 0, order)
    (start,), (end,) = one.derivatives(0.0, 0, 0), one.derivatives(1.0, 0, 0)
    rise = end - start
    if not rise:
        raise NoSolution(f"the {one.name} law ends where it starts: between two lifts its s runs from 0 to 1")

    def shape(x: Reals, order: int) -> list[Reals]:
        first, *rates = one.derivatives(x, 0, order)
        return [(first - start) / rise, *(each / rise for each in rates)]

    return shape


def _awaited(pieces: list[Piece], unit: float) -> list[Piece]:
    """The pieces, those made whose laws take position, speed and acceleration of their neighbours."""
    if not any(piece.waits for piece in pieces):
        return pieces
    from gearlink.core.parts.cams.shaped import Phase, shaped_law

    made = list(pieces)
    for k, piece in enumerate(pieces):
        if piece.waits is None:
            continue
        definition, rise = piece.waits.law, piece.high - piece.low
        with in_section(f"motion[{piece.number - 1}].law"):
            values = {}
            for key, beside, side in (("start", pieces[k - 1], 1), ("end", pieces[(k + 1) % len(pieces)], 0)):
                if (given := getattr(definition, key)) != "join":
                    values[key] = given
                    continue
                v, a = _facing(beside, ("start", "end")[side], key, unit)
                values[key] = [float(key == "end"), v * piece.width / rise, a * piece.width**2 / rise]
            one = shaped_law(definition.model_copy(update=values), Phase(piece.width, rise / unit))  # type: ignore[union-attr]
        shape = _normalised(one)
        made[k] = replace(piece, shape=shape, joints=one.joints, ends=_ends(piece, shape), law=one, waits=None)
    return made


def _facing(beside: Piece, end: str, key: str, unit: float) -> tuple[float, float]:
    """Velocity and acceleration of a neighbour at the end that faces a law that joins it, by the cam angle."""
    given = None if beside.waits is None else getattr(beside.waits.law, end)
    if beside.coefficients or given == "join":
        message = f"{key}: join uses the end values of a neighbouring segment that has its own"
        raise NoSolution(message, key=key, fix="give the neighbour a law, or end values")
    if given is None:
        return beside.ends[("start", "end").index(end)]
    if not isinstance(given, list):
        return unit * given.speed, unit * given.acceleration
    # its other end joins, so that its s runs from 0, or to 1
    own = given[0] if end == "end" else 1.0 - given[0]
    if not own:
        raise NoSolution(f"segment {beside.number} ends where it starts: its s runs from 0 to 1", key=key)
    rise = (beside.high - beside.low) / own
    return given[1] * rise / beside.width, given[2] * rise / beside.width**2


def _backwards(shape: Shape) -> Shape:
    """1 - s(1 - x)."""

    def turned(x: Reals, order: int) -> list[Reals]:
        found = shape(1.0 - x, order)
        return [1.0 - found[0], *((-1.0) ** (n + 1) * each for n, each in enumerate(found) if n)]

    return turned


def _mapped(definition: Mapping[str, Any]) -> tuple[Shape, tuple[float, ...], str]:
    """A blend of two laws, or a law with its inflection elsewhere."""
    kind = definition["type"]
    wanted = {"blend": ("laws", "share"), "shifted": ("law", "inflection")}.get(kind)
    if wanted is None:
        raise NoSolution(f"unknown type of law {kind!r}: blend or shifted")
    if {*definition} != {"type", *wanted}:
        raise NoSolution(f"a law of type {kind} has the keys type, {', '.join(sorted(wanted))}")
    return (_blend if kind == "blend" else _shifted)(*(definition[key] for key in wanted))


def _number(value: Any, low: float, high: float, name: str) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float) or not low <= value <= high:
        raise NoSolution(f"{name} must be a number from {low:g} to {high:g}")
    return float(value)


def _resting(definition: Any) -> Law:
    if not isinstance(definition, str | Mapping):
        raise NoSolution("a law is a name, or a mapping with its numbers")
    one = law(definition)
    if one.kind != "rest-to-rest":
        raise NoSolution(f"{one.name} runs from rest to speed", fix="use a law from rest to rest")
    return one


def _blend(laws: Any, share: Any) -> tuple[Shape, tuple[float, ...], str]:
    """(1 - w) s1 + w s2."""
    if not isinstance(laws, list) or len(laws) != 2:
        raise NoSolution("laws is a list of two laws")
    first, second = (_resting(each) for each in laws)
    w = _number(share, 0.0, 1.0, "share")

    def shape(x: Reals, order: int) -> list[Reals]:
        both = zip(first.derivatives(x, 0, order), second.derivatives(x, 0, order), strict=True)
        return [(1.0 - w) * one + w * other for one, other in both]

    return shape, tuple(sorted({*first.joints, *second.joints})), f"blend of {first.name} and {second.name}"


def _shifted(definition: Any, inflection: Any) -> tuple[Shape, tuple[float, ...], str]:
    """s = 2 m s0(x/(2 m)) up to x = m, 1 - 2 (1 - m)(1 - s0(1 - (1 - x)/(2 (1 - m)))) from there on."""
    one = _resting(definition)
    m = _number(inflection, 0.05, 0.95, "inflection")
    bend = float(one.derivatives(np.array([0.5]), 2, 2)[0][0])
    if abs(bend) > 1e-9 * one.peak_acceleration:
        message = f"the acceleration of {one.name} is not zero in the middle: its inflection point cannot be shifted"
        raise NoSolution(message)

    def half(x: Reals, order: int, share: float) -> list[Reals]:
        found = one.derivatives(np.clip(x / (2.0 * share), 0.0, 0.5), 0, order)
        return [2.0 * share * each / (2.0 * share) ** n for n, each in enumerate(found)]

    def shape(x: Reals, order: int) -> list[Reals]:
        both = zip(half(x, order, m), above(x, order), strict=True)
        return [np.where(x < m, low, high) for low, high in both]

    above = _backwards(lambda x, order: half(x, order, 1.0 - m))

    low = [2.0 * m * x for x in one.joints if x < 0.5]
    high = [1.0 - 2.0 * (1.0 - m) * (1.0 - x) for x in one.joints if x > 0.5]
    return shape, tuple(sorted({*low, m, *high})), f"shifted {one.name}"


def _mirrored_rise(pieces: Sequence[Piece], number: int, start: float, end: float, unit: float) -> list[Piece]:
    """The last rise backwards over a width."""
    last = next((k for k in reversed(range(len(pieces))) if pieces[k].high > pieces[k].low), None)
    if last is None:
        raise NoSolution(f"segment {number} repeats the last rise backwards, but there is none", key="motion")
    first = last
    while first > 0 and pieces[first - 1].high > pieces[first - 1].low:
        first -= 1
    rise = pieces[first : last + 1]
    if (lift := pieces[-1].high) != rise[-1].high:
        ends = f"{rise[-1].high / unit:.9g}"
        message = f"segment {number} begins at lift {lift / unit:.9g} and repeats a rise backwards that ends at {ends}"
        raise NoSolution(message, key="motion", fix="give lift and law")
    if any(piece.coefficients or piece.waits for piece in rise):
        message = f"segment {number} repeats a rise backwards that depends on its neighbours"
        raise NoSolution(message, key="motion", fix="give lift and law")
    share = (end - start) / (rise[-1].end - rise[0].start)
    found: list[Piece] = []
    for piece in reversed(rise):
        after = end if piece is rise[0] else start + share * piece.width
        found.append(piece.backwards(number, start, after))
        start = after
    return found


# Polynomials of degree 5 between what their ends have


_JERK = np.array([6.0 * HERMITE[3], 6.0 * HERMITE[3] + 24.0 * HERMITE[4] + 60.0 * HERMITE[5]])
_FOURTH = np.array([24.0 * HERMITE[4], 24.0 * HERMITE[4] + 120.0 * HERMITE[5]])


def _joined(pieces: Sequence[Piece], given: Mapping[int, _Ends], *, turns_round: bool = True) -> list[Piece]:
    """The polynomials with what their neighbours impose, what is given, and what makes the rest smooth.

    Free accelerations make the jerk continuous, free velocities the fourth derivative: minimum integral of s'''^2.
    """
    if not any(piece.coefficients for piece in pieces):
        return list(pieces)
    known = [_known(pieces, k, given.get((k - 1) % len(pieces)), turns_round) for k in range(len(pieces))]
    free = [(k, n) for k, values in enumerate(known) for n in (0, 1) if values[n] is None]
    place = {where: column for column, where in enumerate(free)}
    found = _solved(pieces, known, place) if free else np.zeros(0)
    ends = [
        [found[place[k, n]] if value is None else value for n, value in enumerate(each)] for k, each in enumerate(known)
    ]
    joined = []
    for k, piece in enumerate(pieces):
        if piece.coefficients:
            own = given.get(k, (None, None))
            next_ends = ends[(k + 1) % len(pieces)]
            after = [end if value is None else value for end, value in zip(next_ends, own, strict=True)]
            b = piece.width
            values = [piece.low, ends[k][0] * b, ends[k][1] * b * b, piece.high, after[0] * b, after[1] * b * b]
            piece = replace(piece, coefficients=tuple(float(c) for c in HERMITE @ np.array(values)))
        joined.append(piece)
    return joined


def _known(pieces: Sequence[Piece], k: int, given: _Ends | None, turns_round: bool) -> list[float | None]:
    """Velocity and acceleration at the start of a piece, as far as they are known; of no use where none asks."""
    before, after = pieces[k - 1], pieces[k]
    if not after.coefficients:
        return list(after.ends[0])
    if not before.coefficients:
        return list(before.ends[1])
    found = list(given or (None, None))
    if found[0] is None and turns_round and (before.high - before.low) * (after.high - after.low) < 0.0:
        found[0] = 0.0
    return found


def _solved(
    pieces: Sequence[Piece], known: Sequence[Sequence[float | None]], place: Mapping[tuple[int, int], int]
) -> Reals:
    """The free velocities and accelerations of the joints between polynomials."""
    matrix, right = np.zeros((len(place), len(place))), np.zeros(len(place))
    for (k, n), row in place.items():
        # free velocity: the fourth derivative is continuous; free acceleration: the jerk
        rows, power = (_FOURTH, 4) if n == 0 else (_JERK, 3)
        for piece_index, end, sign in (((k - 1) % len(pieces), 1, 1.0), (k, 0, -1.0)):
            piece, b = pieces[piece_index], pieces[piece_index].width
            weights = sign * rows[end] / b**power
            right[row] -= weights[0] * piece.low + weights[3] * piece.high
            for at, joint in ((0, piece_index), (3, (piece_index + 1) % len(pieces))):
                for m in (0, 1):
                    weight = weights[at + 1 + m] * b ** (m + 1)
                    value = known[joint][m]
                    if value is None:
                        matrix[row, place[joint, m]] += weight
                    else:
                        right[row] -= weight * value
    return np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)


def _polynomial(coefficients: Sequence[float], x: Reals, order: int) -> list[Reals]:
    found, powers = [], list(coefficients)
    for _ in range(order + 1):
        value = np.zeros_like(x)
        for c in reversed(powers):
            value = value * x + c
        found.append(value)
        powers = [k * c for k, c in enumerate(powers)][1:]
    return found


def _turning_places(piece: Piece) -> list[float]:
    """Places in (0, 1) at which a polynomial, or a law with given ends, turns round."""
    rate = [k * c for k, c in enumerate(piece.coefficients)][1:]
    found = [float(root.real) for root in np.roots(rate[::-1]) if abs(root.imag) < 1e-7]
    if piece.law is not None and piece.law.kind == "given-ends":
        places = np.linspace(0.0, 1.0, 129).tolist()
        found = [*roots_on(lambda x: float(piece.evaluate(np.array([x]), 1)[1][0]), places)]
    return sorted(x for x in found if _NOTHING < x < 1.0 - _NOTHING)


def _sign(value: float) -> int:
    return (value > 0.0) - (value < 0.0)
