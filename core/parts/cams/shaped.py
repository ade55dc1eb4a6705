"""Motion laws that a file shapes by numbers: end values, polydyne, optimal, through points; what vibration they leave.

Points of a table are joined by the quintic spline that is at rest, or at speed, where the phase ends.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short, unlike
from gearlink.core.numerics import bernstein
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.cams.motion_law import Law, largest, peak_power

if TYPE_CHECKING:
    from gearlink.core.parts.cams.optimal import Optimum, Wish
    from gearlink.core.parts.cams.shaped_spec import OptimalLaw, Polydyne


_TWO_PI = 2.0 * math.pi
_LEAST_PERIODS = 0.5
ASSUMED_DAMPING = 0.03
"""As `loads.vibration` has it where the file gives none."""
_LEAST_SPEED_BAND = 100.0
_MOST_IN_BAND = 200.0
"""Of a band: the vibration left is that at its other end, and the effort grows as the third power."""
_SAME = 1e-9
_PHASE_OF_PANEL, _NODES = 6.0, 24
_MOST_PERIODS = 10_000.0
"""Natural periods per phase whose vibration is computed: time and memory are in proportion to them."""


class Phase(NamedTuple):
    """What a design says of the phase that a law fills; None where it does not say.

    Fields
        angle : float [rad] - of the input over the phase
        rise : float - over the phase, in the unit of the file
        time : float [s] - of the phase at the design's speed
        speed : float - of the design, in `unit`
        unit : str - of speeds, and of bands of speeds
        frequency : float [Hz], damping : float - of what the design drives
        to_speed : bool - the phase ends at speed
        in_periods : bool - bands are natural periods per phase, not speeds
    """

    angle: float | None = None
    rise: float | None = None
    time: float | None = None
    speed: float | None = None
    unit: str = ""
    frequency: float | None = None
    damping: float | None = None
    to_speed: bool = False
    in_periods: bool = False


class Drive(NamedTuple):
    """What a design says of the speed at which its laws run, and of what vibrates behind them.

    Fields
        speed : float or None - in `unit`
        rate : float [rad/s] - of the input at speed 1
        unit : str - of speeds
        frequency : float [Hz] or None, damping : float or None
    """

    speed: float | None = None
    rate: float = math.pi / 30.0
    unit: str = "1/min"
    frequency: float | None = None
    damping: float | None = None

    @classmethod
    def of(cls, spec: Any, *, rate: float = math.pi / 30.0, unit: str = "1/min") -> Drive:
        """The drive of a design file with the keys `speed` and `loads.vibration`, where it has them."""
        vibration = getattr(getattr(spec, "loads", None), "vibration", None)
        frequency, damping = (getattr(vibration, key, None) for key in ("frequency", "damping"))
        damping = ASSUMED_DAMPING if vibration is not None and damping is None else damping
        return cls(getattr(spec, "speed", None), rate, unit, frequency, damping)

    def phase(self, angle: float, rise: float | None = None, *, to_speed: bool = False) -> Phase:
        """A phase over an angle of the input [rad]."""
        time = None if self.speed is None else angle / (self.speed * self.rate)
        return Phase(angle, rise, time, self.speed, self.unit, self.frequency, self.damping, to_speed)


class Shaping(NamedTuple):
    """What is known of a shaped law beside its motion.

    Fields
        type : str - polynomial, harmonic, polydyne, optimal, bernstein, table
        acceleration : coefficients of s'' by Bernstein polynomials; empty where it is no polynomial
        periods : float or None - natural periods per phase for which it is shaped
        damping : float - of the oscillator
        wish, optimum : of an optimal law
        least_speed : of a table from rest to rest the minimum velocity and its x
    """

    type: str
    acceleration: tuple[float, ...] = ()
    periods: float | None = None
    damping: float = 0.0
    wish: Wish | None = None
    optimum: Optimum | None = None
    least_speed: tuple[float, float] | None = None


def shaped_law(definition: Any, phase: Phase | None = None) -> Law:
    """The law of a mapping with a `type`.

    Parameters
        definition : model of `shaped_spec`, or the mapping itself
        phase : Phase or None - what the design says of it
    Raises
        NoSolution - for what no law can be, at the key within the mapping
    Example
        >>> law = shaped_law({"type": "polydyne", "periods": 1.5})
        >>> round(law.peak_acceleration, 9), law.evaluate(1.0, 1)
        (6.017812473, (1.0, 0.0))
    """
    from pydantic import ValidationError

    from gearlink.core.parts.cams.shaped_spec import MODELS, shaped

    try:
        model = shaped(dict(definition)) if isinstance(definition, dict) else definition
    except ValidationError as error:
        first = error.errors()[0]
        key = ".".join(str(part) for part in first["loc"]) or str(first.get("ctx", {}).get("key", ""))
        raise NoSolution(f"motion law {definition.get('type')}: {key}: {first['msg']}", key=key) from error
    if isinstance(model, dict):
        raise NoSolution(f"unknown type of law {model.get('type')!r}: {', '.join(MODELS)}; in a cam blend, shifted")
    return _made(_Asked(model, model.model_dump_json(), phase or Phase()))


class _Asked:
    """A law that is asked for, told apart by what the file says and by its phase."""

    def __init__(self, model: Any, text: str, phase: Phase) -> None:
        self.model, self.phase, self._key = model, phase, (text, phase)

    def __hash__(self) -> int:
        return hash(self._key)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Asked) and self._key == other._key


@lru_cache(maxsize=128)
def _made(asked: _Asked) -> Law:
    model, phase = asked.model, asked.phase
    if model.type in ("polynomial", "harmonic"):
        start, end = (_end_values(model, key, phase) for key in ("start", "end"))
        return _polynomial(start, end) if model.type == "polynomial" else _harmonic(start, end)
    if model.type == "polydyne":
        return polydyne(_design_periods(model, phase), model.damping)
    if model.type == "bernstein":
        return of_acceleration(model.acceleration, "bernstein")
    if model.type == "table":
        return _through_points(model.points, to_speed=phase.to_speed)
    return _optimal(model, phase)


def _through_points(points: Sequence[Sequence[float]], *, to_speed: bool) -> Law:
    """The law through the points of a table."""
    (x, s), last = zip(*points, strict=True), len(points) - 1
    if not to_speed and s[-1] != 1.0:
        raise NoSolution(f"last s of a law from rest to rest: {unlike(s[-1], 1.0)} (required 1)", key=f"points[{last}]")
    if s[-1] <= 0.0:
        raise NoSolution(f"last s of a law from rest to speed: {s[-1]:.4g} (above 0)", key=f"points[{last}]")
    spline = TableSpline(x, s, 1.0 if to_speed else 0.0)
    shaping = Shaping("table", least_speed=None if to_speed else spline.least_speed())
    found = _law("table", spline.derivatives, spline.peaks(), shaping)
    return replace(found, joints=tuple(x[1:-1]), kappa=s[-1])


# Given end values


def _end_values(model: Any, key: str, phase: Phase) -> list[float]:
    given = getattr(model, key)
    if isinstance(given, list):
        return list(given)
    if given == "join":
        fix = "join uses the end values of a neighbouring segment, which only a segment of a cam has"
        raise NoSolution(key, key=key, fix=fix)
    if phase.angle is None or not phase.rise:
        message = f"{key}: speed and acceleration of a lift apply only to a segment of a cam"
        raise NoSolution(message, key=key, fix="give [s, v, a]")
    scale = phase.angle / phase.rise
    return [1.0 if key == "end" else 0.0, given.speed * scale, given.acceleration * scale * phase.angle]


def _polynomial(start: Sequence[float], end: Sequence[float]) -> Law:
    """The polynomial of degree 5, or 7 with the jerk, of given end values: unique."""
    m = len(start)
    if len(end) != m:
        raise NoSolution("start and end need the same number of values; a joined end has three, s, v, a", key="end")
    # powers by the Taylor series at 0, the rest by the values at 1
    powers = [Fraction(value) / math.factorial(k) for k, value in enumerate(start)]
    rows = [[Fraction(math.perm(p, k)) for p in range(m, 2 * m)] for k in range(m)]
    right = [Fraction(end[k]) - sum(math.perm(p, k) * powers[p] for p in range(k, m)) for k in range(m)]
    powers += _solved(rows, right)
    return of_powers(powers, "polynomial", Shaping("polynomial"))


def _solved(rows: list[list[Fraction]], right: list[Fraction]) -> list[Fraction]:
    """Gauss-Jordan in fractions."""
    n = len(right)
    table = [[*row, value] for row, value in zip(rows, right, strict=True)]
    for k in range(n):
        pivot = next(i for i in range(k, n) if table[i][k])
        table[k], table[pivot] = table[pivot], table[k]
        table[k] = [value / table[k][k] for value in table[k]]
        for i in range(n):
            if i != k and (factor := table[i][k]):
                table[i] = [a - factor * b for a, b in zip(table[i], table[k], strict=True)]
    return [row[-1] for row in table]


def _harmonic(start: Sequence[float], end: Sequence[float]) -> Law:
    """The sum c0 + c1 x + sum of c cos k pi x, d sin k pi x, k = 1, 2, of given s, v, a at both ends."""
    pi = math.pi

    def basis(x: Any, order: int) -> list[Any]:
        one = np.ones_like(x)
        found = [one if order == 0 else 0.0 * one, x if order == 0 else one if order == 1 else 0.0 * one]
        for k in (1, 2):
            shift = 0.5 * pi * order
            found += [(k * pi) ** order * np.cos(k * pi * x + shift), (k * pi) ** order * np.sin(k * pi * x + shift)]
        return found

    rows = np.array([basis(np.array([0.0, 1.0]), order) for order in range(3)])
    matrix = np.concatenate([rows[..., 0], rows[..., 1]])
    c = np.linalg.solve(matrix, np.array([*start, *end]))

    def derivatives(x: Any, low: int, high: int) -> tuple[Any, ...]:
        at = np.asarray(x, dtype=np.float64)
        found = [sum(each * part for each, part in zip(c, basis(at, n), strict=True)) for n in range(low, high + 1)]
        return tuple(float(value) for value in found) if isinstance(x, float) else tuple(found)

    return _law("harmonic", derivatives, _peaks_by_slopes(derivatives), Shaping("harmonic"))


_LOOKS = 64


def _peaks_by_slopes(derivatives: Callable[[Any, int, int], tuple[Any, ...]]) -> tuple[float, ...]:
    def single(k: int) -> Callable[[float], float]:
        return lambda x: float(derivatives(x, k, k)[0])

    return (*(largest(single(k), single(k + 1), _LOOKS) for k in (1, 2, 3)), peak_power(derivatives, _LOOKS))


# Polynomials


def of_powers(powers: Sequence[float | Fraction], name: str, shaping: Shaping) -> Law:
    """The law s = sum p_k x^k, its derivatives rounded once."""
    exact, orders = [Fraction(p) for p in powers], []
    for _ in range(5):
        orders.append(bernstein.from_powers(exact or [0.0]))
        exact = [k * p for k, p in enumerate(exact)][1:] or [Fraction(0)]
    return _of_orders(name, orders, shaping._replace(acceleration=tuple(orders[2].tolist())))


def of_acceleration(coefficients: Sequence[float], name: str, shaping: Shaping | None = None) -> Law:
    """The law from rest whose second derivative is sum c_i B_i,n; from rest to rest with rise 1, or to speed 1.

    Raises
        NoSolution - where it ends neither way within 1e-9, at the key `acceleration`
    """
    c = np.asarray(coefficients, dtype=np.float64)
    v = bernstein.integral(c)
    s = bernstein.integral(v)
    size = float(np.max(np.abs(v))) or 1.0
    rests, runs = abs(v[-1]) <= _SAME * size, abs(v[-1] - 1.0) <= _SAME * size
    if not runs and not (rests and abs(s[-1] - 1.0) <= _SAME * size):
        message = f"this acceleration ends with s = {short(s[-1])}, v = {short(v[-1])}: from rest to rest they are "
        raise NoSolution(f"{message}1 and 0, from rest to speed v is 1", key="acceleration")
    if rests:
        c, v, s = c / s[-1], v / s[-1], s / s[-1]
    v[-1] = 0.0 if rests else 1.0
    j = bernstein.derivative(c)
    shaping = (shaping or Shaping("bernstein"))._replace(acceleration=tuple(coefficients))
    return _of_orders(name, [s, v, c, j, bernstein.derivative(j)], shaping)


def _of_orders(name: str, orders: Sequence[Reals], shaping: Shaping) -> Law:
    def derivatives(x: Any, low: int, high: int) -> tuple[Any, ...]:
        return tuple(bernstein.evaluate(orders[n], x) for n in range(low, high + 1))

    peaks = [bernstein.peak(orders[n]) for n in (1, 2, 3)]
    power = bernstein.peak(bernstein.product(orders[1], orders[2]))
    return _law(name, derivatives, (*peaks, power), shaping)


def _law(
    name: str, derivatives: Callable[[Any, int, int], tuple[Any, ...]], peaks: Sequence[float], shaping: Shaping
) -> Law:
    (s0, v0, a0), (s1, v1, a1) = derivatives(0.0, 0, 2), derivatives(1.0, 0, 2)
    small = [_SAME * (1.0 + peak) for peak in peaks]
    jumps = abs(a0) > small[1] or abs(a1) > small[1]
    starts = abs(s0) <= _SAME and abs(v0) <= small[0]
    kind: Any = "given-ends"
    if starts and abs(v1 - 1.0) <= small[0]:
        kind = "rest-to-speed"
    elif starts and abs(v1) <= small[0] and abs(s1 - 1.0) <= _SAME:
        kind = "rest-to-rest"
    return Law(
        name=name,
        kind=kind,
        derivatives=derivatives,
        kappa=1.0 if kind == "rest-to-rest" else float(s1),
        peak_velocity=peaks[0],
        peak_acceleration=peaks[1],
        interior_jerk=peaks[2],
        peak_jerk=math.inf if jumps else peaks[2],
        peak_power=peaks[3],
        end_jumps=jumps,
        shaping=shaping,
    )


# Polydyne


def polydyne(periods: float, damping: float = 0.0) -> Law:
    """The law that moves what hangs on a spring by y = 126 x^5 - 420 x^6 + 540 x^7 - 315 x^8 + 70 x^9.

    s = y + (2 zeta/w) y' + y''/w^2,  w = 2 pi lambda;  the deflection -y''/w^2 rests at both ends

    Parameters
        periods : float - lambda, natural periods per phase
    Raises
        NoSolution - below 0.5, at the key `periods`
    Source
        D. A. Stoddart, Machine Design 25 (1953); base polynomial and damping: own derivation
    """
    if periods < _LEAST_PERIODS:
        message = f"natural periods per phase of the polydyne law: {safely_below(periods)} (limit >= "
        fix = f"make phase time times frequency {safely_above(_LEAST_PERIODS / periods)} times as large"
        raise NoSolution(f"{message}{_LEAST_PERIODS:g})", key="periods", fix=fix)
    y = [Fraction(c) for c in (0, 0, 0, 0, 0, 126, -420, 540, -315, 70)]
    w = Fraction(_TWO_PI * periods)
    first = [*(k * c for k, c in enumerate(y) if k), Fraction(0)]
    second = [*(k * c for k, c in enumerate(first) if k), Fraction(0)]
    ratio = 2 * Fraction(damping) / w
    powers = [a + ratio * b + c / w**2 for a, b, c in zip(y, first, second, strict=True)]
    return of_powers(powers, f"polydyne {periods:.6g}", Shaping("polydyne", periods=periods, damping=damping))


def _design_periods(model: Polydyne, phase: Phase) -> float:
    if model.periods is not None:
        return model.periods
    frequency = _frequency(model.frequency, phase)
    if phase.time is None:
        raise NoSolution("frequency needs the time of the phase", key="frequency", fix="give speed, or periods")
    time = phase.time
    if model.speed is not None:
        if phase.speed is None:
            raise NoSolution("speed of a law needs the speed of the design", key="speed", fix="give it, or periods")
        time *= phase.speed / model.speed
    if frequency * time < _LEAST_PERIODS:
        with at_key("frequency"):
            polydyne(frequency * time)
    return frequency * time


def _frequency(given: float | None, phase: Phase) -> float:
    found = given if given is not None else phase.frequency
    if found is None:
        raise NoSolution("this law needs the natural frequency", key="frequency", fix="give frequency (Hz), or periods")
    return found


# Optimal laws


def _optimal(model: OptimalLaw, phase: Phase) -> Law:
    from gearlink.core.parts.cams.optimal import Wish, least_torque, optimum

    v, a, j = (_bound(model, key, phase) for key in model.KEYS)
    damping = (phase.damping or 0.0) if model.damping is None else model.damping
    band = None if model.band is None else _band(model, phase)
    known = damping if band else 0.0
    wish = Wish(model.minimize, model.degree, v, a, j, band, known, model.symmetric, phase.to_speed)
    try:
        found = least_torque(wish) if wish.minimize == "torque" else optimum(wish)
    except NoSolution as error:
        real = getattr(model.limit, error.key, None) if error.key in model.KEYS else None
        if real is None:
            raise
        message = f"limit.{error.key} {real:g} is, over this rise and time, {error.message}"
        raise NoSolution(message, key=f"limit.{error.key}", fix=error.fix) from error
    frequency = phase.frequency if model.frequency is None else model.frequency
    periods = None if frequency is None or phase.time is None else frequency * phase.time
    shaping = Shaping("optimal", periods=periods, damping=damping, wish=wish, optimum=found)
    return of_acceleration(found.coefficients, f"optimal {model.minimize} {model.degree}", shaping)


def _bound(model: OptimalLaw, key: str, phase: Phase) -> float | None:
    """A limit in phase units."""
    given: float | None = getattr(model, key)
    real: float | None = getattr(model.limit, key) if model.limit is not None else None
    if real is None:
        return given
    if phase.time is None or not phase.rise:
        raise NoSolution("limit needs the rise and the time of the phase", key="limit", fix="give the speed")
    order = model.KEYS.index(key) + 1
    return real * phase.time**order / abs(phase.rise)


def _band(model: OptimalLaw, phase: Phase) -> tuple[float, float]:
    """The band in natural periods per phase."""
    assert model.band is not None
    low, high = model.band
    if model.unit == "periods" or phase.in_periods or not phase.unit:
        _require_few_periods(high, f"end the band at {_MOST_IN_BAND:g}")
        return low, high
    if phase.speed is None or phase.time is None:
        message = f"a band of speeds ({phase.unit}) needs the speed of the design"
        raise NoSolution(message, key="band", fix="give it, or unit: periods")
    if high < _LEAST_SPEED_BAND <= phase.speed:
        message = f"the band {low:g} to {high:g} is of speeds ({phase.unit}), and the design runs at {phase.speed:g}: "
        raise NoSolution(f"{message}for natural periods per phase say unit: periods", key="band")
    per_speed = _frequency(model.frequency, phase) * phase.time * phase.speed
    _require_few_periods(per_speed / low, f"start the band at {safely_above(per_speed / _MOST_IN_BAND)} {phase.unit}")
    return per_speed / high, per_speed / low


def _require_few_periods(periods: float, fix: str) -> None:
    if periods > _MOST_IN_BAND:
        message = f"natural periods per phase of the band: {short(periods)} (limit <= {_MOST_IN_BAND:g})"
        raise NoSolution(message, key="band", fix=fix)


# Vibration


def residuals(law: Law, periods: Reals, damping: float = 0.0) -> Reals:
    """Amplitude of vibration that a phase leaves, over its rise, at numbers of natural periods per phase.

    R = |Int s'' exp((-zeta w + i w_d) (1 - x)) dx|/w_d,  w = 2 pi lambda

    Raises
        NoSolution - for more natural periods than are computed
    Example
        >>> from gearlink.core.parts.cams.laws import law
        >>> round(float(residuals(law("cycloidal"), np.ones(1))[0]), 12)
        0.5
    """
    joints, most = [0.0, *law.joints, 1.0], float(np.max(periods))
    if most > _MOST_PERIODS:
        message = f"natural periods per phase: {short(most)} (limit <= {_MOST_PERIODS:g})"
        raise NoSolution(message, fix="shorten the phase, or lower the frequency")
    step = _PHASE_OF_PANEL / (_TWO_PI * most)
    edges = np.concatenate(
        [np.linspace(a, b, math.ceil((b - a) / step) + 1)[:-1] for a, b in pairwise(joints)] + [np.ones(1)]
    )
    x, weight = np.polynomial.legendre.leggauss(_NODES)
    width = np.diff(edges)[:, None]
    nodes, weights = (edges[:-1, None] + 0.5 * width * (x + 1.0)).ravel(), (0.5 * width * weight).ravel()
    values = weights * np.asarray(law.derivatives(nodes, 2, 2)[0])
    w = _TWO_PI * np.asarray(periods, dtype=np.float64)
    damped = math.sqrt(1.0 - damping * damping)
    rates = (-damping + 1j * damped) * w
    found = [abs(complex(np.sum(values * np.exp(rate * (1.0 - nodes))))) for rate in rates.ravel()]
    return np.asarray(np.array(found).reshape(w.shape) / (w * damped))


_UPPER = bernstein.HERMITE[3:]
# Integral of (6 c3 + 24 c4 t + 60 c5 t^2)^2 over the interval, as a form of these.
_ENERGY = _UPPER.T @ np.array([[36.0, 72.0, 120.0], [72.0, 192.0, 360.0], [120.0, 360.0, 720.0]]) @ _UPPER


class TableSpline:
    """The quintic spline through points (x, s), four times continuously differentiable, with v and a given at its ends.

    Parameters
        x : (n,) array - ascending
        s : (n,) array
        end_speed : float - v at the last point; at the first it is 0, and so is a at both
    Notes
        It is the curve with the minimum integral of s'''^2 through the points; v and a at the inner ones solve a
        system of 2 x 2 blocks, three to a row, which is positive definite and needs no pivoting.
    Source
        own derivation; Schoenberg, natural splines
    """

    def __init__(self, x: Sequence[float], s: Sequence[float], end_speed: float) -> None:
        self.x, self.s = np.asarray(x, dtype=np.float64), np.asarray(s, dtype=np.float64)
        self.width = np.diff(self.x)
        rates = np.zeros((self.x.size, 2))
        rates[-1, 0] = end_speed
        rates[1:-1] = self._inner_rates(end_speed)
        h, (v, a) = self.width, rates.T
        # Differences of s, not s itself: they lose no digits.
        step = [np.zeros_like(h), v[:-1] * h, a[:-1] * h * h, np.diff(self.s), v[1:] * h, a[1:] * h * h]
        self.coefficients = np.array([self.s[:-1], step[1], 0.5 * step[2], *(_UPPER @ np.array(step))]).T

    def _inner_rates(self, end_speed: float) -> Reals:
        """v and a at the inner points, by elimination of blocks."""
        n = self.x.size - 2
        diagonal, beside, right = np.zeros((n, 2, 2)), np.zeros((n, 2, 2)), np.zeros((n, 2))
        for k, h in enumerate(self.width):
            scale = np.array([h, h * h])
            both = np.concatenate([scale, scale])
            form = _ENERGY[np.ix_([1, 2, 4, 5], [1, 2, 4, 5])] * np.outer(both, both) / h**5
            pull = _ENERGY[[1, 2, 4, 5], 3] * both * (self.s[k + 1] - self.s[k]) / h**5
            if k == self.width.size - 1:
                pull = pull + form[:, 2] * end_speed
            if k > 0:
                diagonal[k - 1] += form[:2, :2]
                right[k - 1] -= pull[:2]
            if k < n:
                diagonal[k] += form[2:, 2:]
                right[k] -= pull[2:]
            if 0 < k < n:
                beside[k - 1] = form[:2, 2:]
        for k in range(1, n):
            share = np.linalg.solve(diagonal[k - 1], beside[k - 1]).T
            diagonal[k] -= share @ beside[k - 1]
            right[k] -= share @ right[k - 1]
        found = np.zeros((n, 2))
        for k in range(n - 1, -1, -1):
            after = beside[k] @ found[k + 1] if k + 1 < n else 0.0
            found[k] = np.linalg.solve(diagonal[k], right[k] - after)
        return found

    def derivatives(self, x: Any, low: int, high: int) -> tuple[Any, ...]:
        """Derivatives low to high at x, a float or an array."""
        at = np.asarray(x, dtype=np.float64)
        k = np.minimum(np.maximum(np.searchsorted(self.x, at, side="right") - 1, 0), self.width.size - 1)
        t, h, found = (at - self.x[k]) / self.width[k], self.width[k], []
        c = self.coefficients[k]
        for order in range(high + 1):
            if order >= low:
                value = np.zeros_like(t)
                for power in range(c.shape[-1] - 1, -1, -1):
                    value = value * t + c[..., power]
                found.append(value / h**order)
            c = c[..., 1:] * np.arange(1, c.shape[-1]) if c.shape[-1] > 1 else 0.0 * c
        return tuple(float(value) for value in found) if isinstance(x, float) else tuple(found)

    def peaks(self) -> tuple[float, float, float, float]:
        """Maximum |v|, |a|, |j| and |v a|, proved by the coefficients of Bernstein polynomials."""
        v, a, j = (self._bernstein(order) for order in (1, 2, 3))
        power = np.array([bernstein.product(*both) for both in zip(v, a, strict=True)])
        return bernstein.peak(v), bernstein.peak(a), bernstein.peak(j), bernstein.peak(power)

    def least_speed(self) -> tuple[float, float]:
        """The minimum velocity and its x."""
        places = self.x.tolist()
        for k, c in enumerate(np.polynomial.polynomial.polyder(self.coefficients, 2, axis=1)):
            roots = np.polynomial.polynomial.polyroots(np.trim_zeros(c, "b"))
            real = roots.real[(np.abs(roots.imag) < 1e-9) & (roots.real > 0.0) & (roots.real < 1.0)]
            places += (self.x[k] + self.width[k] * real).tolist()
        speeds = self.derivatives(np.array(places), 1, 1)[0]
        least = int(np.argmin(speeds))
        return float(speeds[least]), places[least]

    def _bernstein(self, order: int) -> Reals:
        rows = np.polynomial.polynomial.polyder(self.coefficients, order, axis=1) / self.width[:, None] ** order
        return np.array([bernstein.from_powers(row) for row in rows.tolist()])
