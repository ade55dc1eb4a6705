"""Motion laws of cams: from rest to rest, and from rest to a constant speed."""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Mapping
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution, named
from gearlink.core.numerics.roots import roots_on
from gearlink.core.parts.cams.first_half import FirstHalf, Piece
from gearlink.core.parts.cams.motion_law import Law as Law
from gearlink.core.parts.cams.scca import scca

if TYPE_CHECKING:
    from gearlink.core.parts.cams.shaped import Phase

# First halves of the polynomial laws, with closed forms of their peaks


def _polynomial(*parts: Callable[[Any], Any]) -> Piece:
    """A piece from the integral, the rise and its derivatives, each a function of x."""

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        return tuple(part(x) for part in parts[low + 1 : high + 2])

    return piece


def _polynomial_half(piece: Piece, velocity: float, acceleration: float, jerk: float, power: float) -> FirstHalf:
    return FirstHalf(((0.5, piece),), velocity, acceleration, jerk, power)


# The parts are factored in w = x(1 - x) where that saves cancellation; the sixth is the fourth derivative, which
# only the peak jerk of the free laws asks for.
POLYNOMIAL_123 = _polynomial_half(
    _polynomial(
        lambda x: x**3 * (1.0 - 0.5 * x),
        lambda x: x * x * (3.0 - 2.0 * x),
        lambda x: 6.0 * x * (1.0 - x),
        lambda x: 6.0 * (1.0 - 2.0 * x),
        lambda x: -12.0 + 0.0 * x,
        lambda x: 0.0 * x,
    ),
    velocity=1.5,
    acceleration=6.0,
    jerk=12.0,
    power=2.0 * math.sqrt(3.0),
)
POLYNOMIAL_345 = _polynomial_half(
    _polynomial(
        lambda x: x**4 * (2.5 - x * (3.0 - x)),
        lambda x: x**3 * (10.0 - x * (15.0 - 6.0 * x)),
        lambda x: 30.0 * (x * (1.0 - x)) ** 2,
        lambda x: 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
        lambda x: 60.0 * (1.0 - 6.0 * x * (1.0 - x)),
        lambda x: -360.0 * (1.0 - 2.0 * x),
    ),
    velocity=15.0 / 8.0,
    acceleration=10.0 / math.sqrt(3.0),
    jerk=60.0,
    power=1800.0 / 64.0 * (6.0 / 7.0) ** 3 / math.sqrt(7.0),
)
POLYNOMIAL_4567 = _polynomial_half(
    _polynomial(
        lambda x: x**5 * (7.0 - x * (14.0 - x * (10.0 - 2.5 * x))),
        lambda x: x**4 * (35.0 - x * (84.0 - x * (70.0 - 20.0 * x))),
        lambda x: 140.0 * (x * (1.0 - x)) ** 3,
        lambda x: 420.0 * (x * (1.0 - x)) ** 2 * (1.0 - 2.0 * x),
        lambda x: 840.0 * x * (1.0 - x) * (1.0 - 5.0 * x * (1.0 - x)),
        lambda x: 840.0 * (1.0 - 2.0 * x) * (1.0 - 10.0 * x * (1.0 - x)),
    ),
    velocity=35.0 / 16.0,
    acceleration=84.0 * math.sqrt(5.0) / 25.0,
    jerk=52.5,
    power=58800.0 / 1024.0 * (10.0 / 11.0) ** 5 / math.sqrt(11.0),
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
        raise NoSolution(
            (
                f"motion law {name!r}: the acceleration is not zero at both ends of the first half, so it "
                "jumps at the dwell or at the constant speed"
            ),
            fix="use half-cycloidal or velocity-345",
        )
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
        peak_power=_peak_power(derivatives),
        joints=_joints(half),
    )


def _free_law(name: str, base: FirstHalf, addition: FirstHalf, kappa: float) -> Law:
    """The law whose velocity follows `base` (kappa 1/2) plus (kappa - 1/2) rises of `addition`."""

    def derivatives(x: Any, low: int, high: int) -> tuple[Any, ...]:
        first, second = base.derivatives(x, low - 1, high - 1), addition.derivatives(x, low, high)
        return tuple(p + (kappa - 0.5) * q for p, q in zip(first, second, strict=True))

    def single(k: int) -> Callable[[float], float]:
        return lambda u: float(derivatives(u, k, k)[0])

    jerk = _largest(single(3), single(4))
    return Law(
        name=name,
        kind="rest-to-speed",
        derivatives=derivatives,
        kappa=kappa,
        peak_velocity=1.0,
        peak_acceleration=_largest(single(2), single(3)),
        interior_jerk=jerk,
        peak_jerk=jerk,
        peak_power=_peak_power(derivatives),
        joints=tuple(sorted({*_joints(base), *_joints(addition)})),
    )


def _peak_power(derivatives: Callable[[Any, int, int], tuple[Any, ...]]) -> float:
    def power(u: float) -> float:
        v, a = derivatives(u, 1, 2)
        return float(v * a)

    def slope(u: float) -> float:
        v, a, j = derivatives(u, 1, 3)
        return float(a * a + v * j)

    return _largest(power, slope)


def _largest(f: Callable[[float], float], slope: Callable[[float], float]) -> float:
    """Largest |f| on [0, 1]: the ends and the roots of the slope, sought between 32 places."""
    places = [i / 32.0 for i in range(33)]
    return max(abs(f(u)) for u in (0.0, 1.0, *roots_on(slope, places)))


_SCCA = {
    "simple-harmonic": (0.0, 0.0, 1.0, 0.0),
    "cycloidal": (0.5, 0.0, 0.5, 0.0),
    "modified-trapezoid": (0.25, 0.5, 0.25, 0.0),
    "modified-sine": (0.25, 0.0, 0.75, 0.0),
}
_POLYNOMIALS = {"polynomial-345": POLYNOMIAL_345, "polynomial-4567": POLYNOMIAL_4567}
_KINDS = {"": _rest_to_rest, "half-": _half_law, "velocity-": _velocity_law}
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
    Returns
        law : Law
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
    if key in ("quintic", "septic"):
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
    near = difflib.get_close_matches(asked, known, n=1)
    meant = f"did you mean {near[0]!r}? From" if near else "from"
    raise NoSolution(
        f"unknown motion law {named(asked)}: {meant} rest to rest: {', '.join(REST_TO_REST)}; from rest to speed: "
        "half-<law>, velocity-<law>"
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
        raise NoSolution(
            f"motion law {named(name)}: the percentage of constant velocity must lie in 0 to 99, as in mcv-33"
        )
    return share


def _free(key: str, kappa: float) -> Law:
    low, high, ends = (0.4, 0.6, "2/5 to 3/5") if key == "quintic" else (3.0 / 7.0, 4.0 / 7.0, "3/7 to 4/7")
    if not low <= kappa <= high:
        nearest = min(max(kappa, low), high)
        raise NoSolution(
            f"{key} law with kappa = {kappa:.6g} reverses its acceleration",
            fix=(f"keep kappa in {ends} (the nearest is {nearest:.6g}); change the swing or the phase length"),
        )
    name = f"{key} {kappa!r}"
    if key == "quintic":
        return _free_law(name, POLYNOMIAL_123, POLYNOMIAL_345, kappa)
    return _free_law(name, POLYNOMIAL_345, POLYNOMIAL_4567, kappa)


def _numbers(key: str, value: object, count: int) -> tuple[float, ...]:
    given = [value] if count == 1 else value
    numbers = given if isinstance(given, list | tuple) else ()
    if len(numbers) != count or not all(
        isinstance(n, int | float) and not isinstance(n, bool) and math.isfinite(n) for n in numbers
    ):
        what = "one number" if count == 1 else f"a list of {count} numbers"
        raise NoSolution(
            f"motion law {key}: {value!r} is not {what}, as in {{scca: [0.25, 0, 0.75, 0]}}, {{quintic: 0.5}}"
        )
    return tuple(float(n) for n in numbers)
