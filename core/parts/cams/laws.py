"""Motion laws of cams: from rest to rest, and from rest to a constant speed; the SCCA family among them.

A symmetric law is known from its first half: a `Piece` gives the integral of the rise, the rise and its first
derivatives up to the piece's end. The same code serves a float and a float64 array.

The first half of a law of the SCCA family is sine, constant and cosine acceleration, then constant velocity.
"""

from __future__ import annotations

import difflib
import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

from gearlink.core.base.errors import NoSolution, named
from gearlink.core.base.wording import short, unlike
from gearlink.core.parts.cams.motion_law import Law as Law
from gearlink.core.parts.cams.motion_law import largest, peak_power

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gearlink.core.parts.cams.shaped import Phase


# (x, low, high) -> derivatives low..high, counted from -1: the integral of the rise, wanted where a velocity
# follows the law.
Piece: TypeAlias = Callable[[Any, int, int], tuple[Any, ...]]


@dataclass(frozen=True, slots=True)
class FirstHalf:
    """The first half of a symmetric rest-to-rest law: its pieces with their ends, and its peak values.

    Attributes
        pieces : ((end, piece), ...) - ends ascending to 1/2; a piece serves x < end, the last one x = 1/2 too
        peak_velocity, peak_acceleration, interior_jerk, peak_power : float - largest v, |a|, |j| (beside the
            jumps of a) and v a
        end_jumps, middle_jumps : bool - the acceleration is not zero at 0, or jumps before or at 1/2
    """

    pieces: tuple[tuple[float, Piece], ...]
    peak_velocity: float
    peak_acceleration: float
    interior_jerk: float
    peak_power: float
    end_jumps: bool = False
    middle_jumps: bool = False

    def derivatives(self, x: Any, low: int, high: int) -> tuple[Any, ...]:
        """Derivatives low to high over the whole law, its second half by s(x) = 1 - s(1 - x)."""
        if not isinstance(x, float):
            return self._of_array(x, low, high)
        if x <= 0.5:
            return self._piece_at(x)(x, low, high)
        y = 1.0 - x
        first = self._piece_at(y)(y, low, high)
        return tuple(_mirrored(k, value, x) for k, value in enumerate(first, start=low))

    def _piece_at(self, y: float) -> Piece:
        for end, piece in self.pieces:
            if y < end:
                return piece
        return self.pieces[-1][1]

    def _of_array(self, x: NDArray[np.float64], low: int, high: int) -> tuple[NDArray[np.float64], ...]:
        import numpy as np

        upper = x > 0.5
        y = np.where(upper, 1.0 - x, x)
        first = _by_piece(self.pieces, y, low, high)
        return tuple(np.where(upper, _mirrored(k, value, x), value) for k, value in enumerate(first, start=low))


def _by_piece(
    pieces: tuple[tuple[float, Piece], ...], y: NDArray[np.float64], low: int, high: int
) -> tuple[NDArray[np.float64], ...]:
    if len(pieces) == 1:
        return pieces[0][1](y, low, high)
    import numpy as np

    index = np.searchsorted([end for end, _ in pieces[:-1]], y, side="right")
    values = tuple(np.empty_like(y) for _ in range(high - low + 1))
    for number, (_, piece) in enumerate(pieces):
        here = index == number
        if here.any():
            for value, part in zip(values, piece(y[here], low, high), strict=True):
                value[here] = part
    return values


def _mirrored(k: int, value: Any, x: Any) -> Any:
    if k == -1:
        return value + (x - 0.5)
    if k == 0:
        return 1.0 - value
    return 0.0 - value if k % 2 == 0 else value


def scca(a: float, b: float, c: float, d: float) -> FirstHalf:
    """First half of the SCCA law with the shares a (sine), b (constant), c (cosine), d (no acceleration).

    1/A = 2 [(a^2/pi)(1/2 - 1/pi) + a b/(2 pi) + b^2/8 + (a/pi + b/2) c/2 + c^2/pi^2 + ((a + c)/pi + b/2) d/2]

    Parameters
        a, b, c, d : float - shares of the whole rise, >= 0, sum 1 (to 1e-9; they are then divided by their sum)
    Returns
        first_half : FirstHalf - peak_velocity = A ((a + c)/pi + b/2), peak_acceleration = A
    Raises
        NoSolution - a negative share, a sum other than 1, or no acceleration at all (d = 1)
    Notes
        Each piece starts from the end where its rise is flat, so the rise keeps its relative accuracy near 0
        and reaches 1/2 exactly in the middle. Cosine differences are written as squares of half-angle sines.
    Example
        >>> round(scca(0.25, 0.5, 0.25, 0.0).peak_acceleration, 12)
        4.888123762813

    Source
        own derivation: the acceleration integrated piece by piece
    """
    a, b, c, d = _checked_shares(a, b, c, d)
    peak = 0.5 / (
        a * a / math.pi * (0.5 - 1.0 / math.pi)
        + a * b / (2.0 * math.pi)
        + b * b / 8.0
        + (a / math.pi + b / 2.0) * c / 2.0
        + (c / math.pi) ** 2
        + ((a + c) / math.pi + b / 2.0) * d / 2.0
    )
    cruise = peak * ((a + c) / math.pi + b / 2.0)
    before = peak * (a / math.pi + b / 2.0)
    swings = [share for share in (a, c) if share > 0.0]
    return FirstHalf(
        pieces=_pieces(a, b, c, d, peak, cruise),
        peak_velocity=cruise,
        peak_acceleration=peak,
        interior_jerk=peak * math.pi / min(swings) if swings else 0.0,
        peak_power=_peak_power_scca(peak, before, peak * c / math.pi),
        end_jumps=a == 0.0,
        middle_jumps=c == 0.0,
    )


def _checked_shares(a: float, b: float, c: float, d: float) -> tuple[float, float, float, float]:
    shares = (a, b, c, d)
    if not all(share >= 0.0 for share in shares):
        raise NoSolution(f"scca shares {list(shares)} must not be negative", fix="give four shares >= 0 with sum 1")
    total = math.fsum(shares)
    if not abs(total - 1.0) <= 1e-9:
        message = f"scca shares {list(shares)} have the sum {unlike(total, 1.0)} (required 1)"
        raise NoSolution(message, fix=f"change one of them by {1.0 - total:+.9g}")
    if d >= 1.0:
        raise NoSolution("scca share d = 1 leaves no time to accelerate", fix="keep d below 1 (0.2 to 0.5 is usual)")
    return a / total, b / total, c / total, d / total


def _peak_power_scca(peak: float, before: float, gain: float) -> float:
    # v a grows up to the cosine piece, where v = before + gain sin(z) and a = peak cos(z).
    sine = 2.0 * gain / (before + math.sqrt(before * before + 8.0 * gain * gain))
    return peak * math.sqrt((1.0 - sine) * (1.0 + sine)) * (before + gain * sine)


def _pieces(a: float, b: float, c: float, d: float, peak: float, cruise: float) -> tuple[tuple[float, Piece], ...]:
    end_sine, end_constant, end_cosine = a / 2.0, (a + b) / 2.0, (1.0 - d) / 2.0
    found: list[tuple[float, Piece]] = []
    start = (0.0, 0.0, 0.0)
    if a > 0.0:
        found.append((end_sine, _sine_piece(a, peak)))
        r = a / math.pi
        start = (peak * r**3 * (math.pi**2 / 8.0 - 1.0), peak * r * r * (math.pi / 2.0 - 1.0), peak * r)
    if b > 0.0:
        constant = _parabola(end_sine, (*start, peak))
        found.append((end_constant, constant))
        start = constant(end_constant, -1, 1)
    rise_cosine = 0.5 - cruise * d / 2.0
    area_cosine = start[0]
    if c > 0.0:
        if end_constant == 0.0:
            found.append((c / 4.0, _harmonic_piece(c, peak)))
        w, r = c / 2.0, c / math.pi
        area_cosine += rise_cosine * w - cruise * w * w / 2.0 + peak * r**3 * (math.pi**2 / 8.0 - 1.0)
        found.append((end_cosine, _cosine_piece(c, peak, end_cosine, area_cosine, rise_cosine, cruise)))
    if d > 0.0 or c == 0.0:
        # Measured from the middle, so that the rise is 1/2 there to the last bit.
        area_middle = area_cosine + d / 4.0 - cruise * d * d / 8.0
        found.append((0.5, _parabola(0.5, (area_middle, 0.5, cruise, 0.0 if d > 0.0 else peak))))
    return tuple(found)


def _piece(*parts: Callable[[Any], Any], place: Callable[[Any], Any] = lambda x: x) -> Piece:
    """A piece from the integral, the rise and its derivatives, each a function of a place that follows from x."""

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        z = place(x)
        return tuple(part(z) for part in parts[low + 1 : high + 2])

    return piece


def _sine_piece(a: float, peak: float) -> Piece:
    r = a / math.pi
    return _piece(
        lambda z: peak * r**3 * _square_excess(z),
        lambda z: peak * r * r * _sine_defect(z),
        lambda z: _versine(z, 2.0 * peak * r),
        lambda z: peak * _sin(z),
        lambda z: peak / r * (1.0 - _versine(z)),
        place=lambda x: x / r,
    )


def _parabola(origin: float, at_origin: tuple[float, float, float, float]) -> Piece:
    area, rise, velocity, acceleration = at_origin
    return _piece(
        lambda t: area + t * (rise + t * (0.5 * velocity + t * (acceleration / 6.0))),
        lambda t: rise + t * (velocity + t * (0.5 * acceleration)),
        lambda t: velocity + t * acceleration,
        lambda t: acceleration + 0.0 * t,
        lambda t: 0.0 * t + 0.0,
        place=lambda x: x - origin,
    )


def _harmonic_piece(c: float, peak: float) -> Piece:
    r = c / math.pi
    return _piece(
        lambda z: peak * r**3 * _sine_defect(z),
        lambda z: _versine(z, 2.0 * peak * r * r),
        lambda z: peak * r * _sin(z),
        lambda z: peak * (1.0 - _versine(z)),
        lambda z: -peak / r * _sin(z),
        place=lambda x: x / r,
    )


def _cosine_piece(c: float, peak: float, end: float, area: float, rise: float, velocity: float) -> Piece:
    r = c / math.pi
    return _piece(
        lambda w: area - w * (rise - 0.5 * velocity * w) - peak * r**3 * _square_excess(w / r),
        lambda w: rise - velocity * w + peak * r * r * _sine_defect(w / r),
        lambda w: velocity - _versine(w / r, 2.0 * peak * r),
        lambda w: peak * _sin(w / r),
        lambda w: -peak / r * (1.0 - _versine(w / r)),
        place=lambda x: end - x,
    )


def _sin(x: Any) -> Any:
    """Sine of a float (by math) or of an array (by numpy, imported only then)."""
    if isinstance(x, float):
        return math.sin(x)
    import numpy as np

    return np.sin(x)


def _versine(z: Any, twice: float = 2.0) -> Any:
    """1 - cos z without cancellation, times half of a number."""
    half = _sin(0.5 * z)
    return twice * half * half


def _sine_defect(z: Any) -> Any:
    """z - sin z without cancellation."""
    return _near_zero(z, 3, lambda z: z - _sin(z))


def _square_excess(z: Any) -> Any:
    """z^2/2 - 1 + cos z without cancellation."""
    return _near_zero(z, 4, lambda z: 0.5 * z * z - _versine(z))


def _near_zero(z: Any, power: int, direct: Callable[[Any], Any]) -> Any:
    """z^n/n! - z^(n + 2)/(n + 2)! + ... below 1, from there on directly."""

    def series(z: Any) -> Any:
        y, value = z * z, 1.0
        for n in range(power + 13, power, -2):
            value = 1.0 - y / (n * (n + 1.0)) * value
        return z**power / math.factorial(power) * value

    if isinstance(z, float):
        return series(z) if z < 1.0 else direct(z)
    import numpy as np

    near = z < 1.0
    if not near.any():
        return direct(z)
    return series(z) if near.all() else np.where(near, series(np.minimum(z, 1.0)), direct(z))


# First halves of the polynomial laws, with closed forms of their peaks


def _polynomial(peaks: tuple[float, float, float, float], *parts: Callable[[Any], Any]) -> FirstHalf:
    return FirstHalf(((0.5, _piece(*parts)),), *peaks)


# The peaks are those of velocity, acceleration, jerk and power.
# The parts are factored in w = x(1 - x) where that saves cancellation; the sixth is the fourth derivative, which
# only the peak jerk of the free laws asks for.
POLYNOMIAL_123 = _polynomial(
    (1.5, 6.0, 12.0, 2.0 * math.sqrt(3.0)),
    lambda x: x**3 * (1.0 - 0.5 * x),
    lambda x: x * x * (3.0 - 2.0 * x),
    lambda x: 6.0 * x * (1.0 - x),
    lambda x: 6.0 * (1.0 - 2.0 * x),
    lambda x: -12.0 + 0.0 * x,
    lambda x: 0.0 * x,
)
POLYNOMIAL_345 = _polynomial(
    (15.0 / 8.0, 10.0 / math.sqrt(3.0), 60.0, 1800.0 / 64.0 * (6.0 / 7.0) ** 3 / math.sqrt(7.0)),
    lambda x: x**4 * (2.5 - x * (3.0 - x)),
    lambda x: x**3 * (10.0 - x * (15.0 - 6.0 * x)),
    lambda x: 30.0 * (x * (1.0 - x)) ** 2,
    lambda x: 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
    lambda x: 60.0 * (1.0 - 6.0 * x * (1.0 - x)),
    lambda x: -360.0 * (1.0 - 2.0 * x),
)
POLYNOMIAL_4567 = _polynomial(
    (35.0 / 16.0, 84.0 * math.sqrt(5.0) / 25.0, 52.5, 58800.0 / 1024.0 * (10.0 / 11.0) ** 5 / math.sqrt(11.0)),
    lambda x: x**5 * (7.0 - x * (14.0 - x * (10.0 - 2.5 * x))),
    lambda x: x**4 * (35.0 - x * (84.0 - x * (70.0 - 20.0 * x))),
    lambda x: 140.0 * (x * (1.0 - x)) ** 3,
    lambda x: 420.0 * (x * (1.0 - x)) ** 2 * (1.0 - 2.0 * x),
    lambda x: 840.0 * x * (1.0 - x) * (1.0 - 5.0 * x * (1.0 - x)),
    lambda x: 840.0 * (1.0 - 2.0 * x) * (1.0 - 10.0 * x * (1.0 - x)),
)


def _rest_to_rest(name: str, half: FirstHalf) -> Law:
    jumps = half.end_jumps or half.middle_jumps
    return Law(
        name=name,
        kind="rest-to-rest",
        derivatives=half.derivatives,
        kappa=1.0,
        peak_velocity=half.peak_velocity,
        peak_acceleration=half.peak_acceleration,
        interior_jerk=half.interior_jerk,
        peak_jerk=math.inf if jumps else half.interior_jerk,
        peak_power=half.peak_power,
        end_jumps=half.end_jumps,
        joints=_joints(half),
    )


def _joints(half: FirstHalf) -> tuple[float, ...]:
    """Ends of the pieces and their mirror images."""
    ends = [end for end, _ in half.pieces]
    return tuple(sorted({*ends, *(1.0 - end for end in ends)} - {0.0, 1.0}))


def _half_law(name: str, half: FirstHalf) -> Law:
    """s = 2 s0(u/2)/Cv, v = v0(u/2)/Cv, a = a0(u/2)/(2 Cv), j = j0(u/2)/(4 Cv)"""
    if half.end_jumps or half.middle_jumps:
        message = f"motion law {name!r}: the acceleration is not zero at both ends of the first half, so it "
        message += "jumps at the dwell or at the constant speed"
        raise NoSolution(message, fix="use half-cycloidal or velocity-345")
    speed = half.peak_velocity

    def derivatives(x: Any, low: int, high: int) -> tuple[Any, ...]:
        values = half.derivatives(0.5 * x, low, high)
        return tuple(value / (speed * 2.0 ** (k - 1)) for k, value in enumerate(values, start=low))

    jerk = half.interior_jerk / (4.0 * speed)
    return Law(
        name=name,
        kind="rest-to-speed",
        derivatives=derivatives,
        kappa=1.0 / speed,
        peak_velocity=1.0,
        peak_acceleration=half.peak_acceleration / (2.0 * speed),
        interior_jerk=jerk,
        peak_jerk=jerk,
        peak_power=half.peak_power / (2.0 * speed * speed),
        joints=tuple(2.0 * place for place in _joints(half) if place < 0.5),
    )


def _velocity_law(name: str, half: FirstHalf) -> Law:
    """v = s0(u), a = v0(u), j = a0(u), s = the integral of s0"""

    def derivatives(x: Any, low: int, high: int) -> tuple[Any, ...]:
        return half.derivatives(x, low - 1, high - 1)

    return Law(
        name=name,
        kind="rest-to-speed",
        derivatives=derivatives,
        kappa=0.5,
        peak_velocity=1.0,
        peak_acceleration=half.peak_velocity,
        interior_jerk=half.peak_acceleration,
        peak_jerk=half.peak_acceleration,
        peak_power=peak_power(derivatives),
        joints=_joints(half),
    )


def _free_law(name: str, base: FirstHalf, addition: FirstHalf, kappa: float) -> Law:
    """The law whose velocity follows `base` (kappa 1/2) plus (kappa - 1/2) rises of `addition`."""

    def derivatives(x: Any, low: int, high: int) -> tuple[Any, ...]:
        first, second = base.derivatives(x, low - 1, high - 1), addition.derivatives(x, low, high)
        return tuple(p + (kappa - 0.5) * q for p, q in zip(first, second, strict=True))

    def single(k: int) -> Callable[[float], float]:
        return lambda u: float(derivatives(u, k, k)[0])

    jerk = largest(single(3), single(4))
    return Law(
        name=name,
        kind="rest-to-speed",
        derivatives=derivatives,
        kappa=kappa,
        peak_velocity=1.0,
        peak_acceleration=largest(single(2), single(3)),
        interior_jerk=jerk,
        peak_jerk=jerk,
        peak_power=peak_power(derivatives),
        joints=tuple(sorted({*_joints(base), *_joints(addition)})),
    )


_SCCA = {
    "simple-harmonic": (0.0, 0.0, 1.0, 0.0),
    "cycloidal": (0.5, 0.0, 0.5, 0.0),
    "modified-trapezoid": (0.25, 0.5, 0.25, 0.0),
    "modified-sine": (0.25, 0.0, 0.75, 0.0),
}
_POLYNOMIALS = {"polynomial-345": POLYNOMIAL_345, "polynomial-4567": POLYNOMIAL_4567}
_FREE = {
    "quintic": (POLYNOMIAL_123, POLYNOMIAL_345, 0.4, 0.6, "2/5 to 3/5"),
    "septic": (POLYNOMIAL_345, POLYNOMIAL_4567, 3.0 / 7.0, 4.0 / 7.0, "3/7 to 4/7"),
}
_KINDS = {"": _rest_to_rest, "half-": _half_law, "velocity-": _velocity_law}
_PARABOLIC = "{scca: [0, 1, 0, 0]}"
_TEXTBOOKS = {"3-4-5": "polynomial-345", "4-5-6-7": "polynomial-4567", "shm": "simple-harmonic"}
_TEXTBOOKS |= dict.fromkeys(("cosine", "cosine-acceleration"), "simple-harmonic")
_TEXTBOOKS |= dict.fromkeys(("sine", "sine-acceleration", "bestehorn"), "cycloidal")
_TEXTBOOKS |= dict.fromkeys(("parabolic", "constant-acceleration", "uniform-acceleration"), _PARABOLIC)
"""What textbooks call laws that have another name here."""
_SHORT = {"345": "polynomial-345", "4567": "polynomial-4567", "harmonic": "simple-harmonic"}

REST_TO_REST: tuple[str, ...] = (*_SCCA, *_POLYNOMIALS, "mcv-50", "mcv-33", "mcv-20")
REST_TO_SPEED: tuple[str, ...] = (
    *(f"half-{name}" for name in REST_TO_REST if name != "simple-harmonic"),
    *(f"velocity-{name}" for name in REST_TO_REST),
)


def law(definition: Any, phase: Phase | None = None) -> Law:
    """The motion law that a design file names.

    Parameters
        definition : str or mapping - simple-harmonic, cycloidal, modified-trapezoid, modified-sine, polynomial-345,
            polynomial-4567, mcv-NN (modified sine with NN percent of constant velocity; 33 is one third),
            half-<law>, velocity-<law> (also half-345, velocity-4567, ...), {scca: [a, b, c, d]},
            {half-scca: ...}, {velocity-scca: ...}, {quintic: kappa}, {septic: kappa}, and the mappings with a `type`
            of `shaped_spec`, or their models
        phase : Phase - what a design says of the phase; None: nothing
    Raises
        NoSolution - unknown name (with the nearest one), shares or kappa out of range, or half-simple-harmonic
    Notes
        half-<law> uses the first half of the law and reaches its peak velocity; velocity-<law> lets the velocity
        follow it. {quintic: kappa} and {septic: kappa} take the share kappa of (end speed) x (time) as given.
    Example
        >>> law("modified-sine").peak_velocity
        1.7596033859537703
        >>> law({"quintic": 0.55}).kappa
        0.55

    Source
        own derivation; the trigonometric laws are cases of {scca: [a, b, c, d]}
    """
    if isinstance(definition, str):
        return _named(definition)
    if not isinstance(definition, Mapping) or "type" in definition:
        from gearlink.core.parts.cams.shaped import shaped_law

        return shaped_law(definition, phase)
    if len(definition) != 1:
        raise NoSolution(f"motion law {dict(definition)!r}", fix="give one key, scca, quintic or septic")
    (key, value), *_ = definition.items()
    if key in ("scca", "half-scca", "velocity-scca"):
        shares = _numbers(key, value, 4)
        base = scca(*shares)
        return _KINDS[key.removesuffix("scca")](f"{key} {list(shares)}", base)
    if key in _FREE:
        return _free(key, *_numbers(key, value, 1))
    raise NoSolution(f"unknown motion law {named(key)}: the laws with numbers are scca, quintic and septic")


@lru_cache(maxsize=128)
def _named(name: str) -> Law:
    for prefix in ("half-", "velocity-"):
        rest = name.removeprefix(prefix)
        if rest != name:
            return _KINDS[prefix](name, _symmetric(_SHORT.get(rest, rest), name))
    return _rest_to_rest(name, _symmetric(name, name))


def _symmetric(name: str, asked: str) -> FirstHalf:
    if name in _SCCA:
        return scca(*_SCCA[name])
    if name in _POLYNOMIALS:
        return _POLYNOMIALS[name]
    if name.startswith("mcv-"):
        q = 1.0 - _constant_share(name)
        return scca(0.25 * q, 0.0, 0.75 * q, 1.0 - q)
    known = (*REST_TO_REST, *REST_TO_SPEED, "half-345", "half-4567", "velocity-345", "velocity-4567")
    plain = re.sub(r"[\s_]+", "-", asked.strip().lower())
    near = [_TEXTBOOKS[plain]] if plain in _TEXTBOOKS else difflib.get_close_matches(plain, known, n=1)
    meant = f"did you mean {near[0] if near[0] == _PARABOLIC else repr(near[0])}? " if near else ""
    raise NoSolution(
        f"unknown motion law {named(asked)}",
        fix=f"{meant}from rest to rest: {', '.join(REST_TO_REST)}; from rest to speed: half-<law>, velocity-<law>; "
        "with numbers: {scca: [a, b, c, d]} or {type: ...}",
    )


def _constant_share(name: str) -> float:
    text = name.removeprefix("mcv-")
    if text in ("33", "67"):
        return round(float(text) * 0.03) / 3.0
    try:
        share = float(text) / 100.0
    except ValueError:
        share = math.nan
    if not 0.0 <= share < 1.0:
        message = f"motion law {named(name)}: the percentage of constant velocity must lie in 0 to 99, as in mcv-33"
        raise NoSolution(message)
    return share


def _free(key: str, kappa: float) -> Law:
    base, addition, low, high, ends = _FREE[key]
    if not low <= kappa <= high:
        nearest = min(max(kappa, low), high)
        raise NoSolution(
            f"{key} law with kappa {short(kappa)} reverses its acceleration",
            fix=f"keep kappa in {ends} (nearest {short(nearest)}): change the swing or the phase length",
        )
    return _free_law(f"{key} {kappa!r}", base, addition, kappa)


def _numbers(key: str, value: object, count: int) -> tuple[float, ...]:
    given = [value] if count == 1 else value
    numbers = given if isinstance(given, list | tuple) else ()
    if len(numbers) != count or not all(
        isinstance(n, int | float) and not isinstance(n, bool) and math.isfinite(n) for n in numbers
    ):
        what = "one number" if count == 1 else f"a list of {count} numbers"
        message = f"motion law {key}: {value!r} is not {what}, as in {{scca: [0.25, 0, 0.75, 0]}}, {{quintic: 0.5}}"
        raise NoSolution(message)
    return tuple(float(n) for n in numbers)
