"""Motion laws that minimize something among all polynomials of a degree: found by linear programmes, and proved.

s'' is a polynomial of degree n on [0, 1] that vanishes at both ends. A programme that knows its limits at finitely
many places has fewer limits than the true one, so its dual bounds every law of the class from below; the law itself
is proved afterwards, everywhere.

Laws of minimum inertia torque, |s' s''|, are found step by step, and bounded by the kinetic energy.

The product is not convex in the coefficients of s'': each step solves the programme of the product's linear part
within a trust region, and what is found is smallest of its neighbours alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.numerics import bernstein
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.gauss import gauss_legendre
from gearlink.core.numerics.linear_program import Solution, proved_bound, solution

_TWO_PI = 2.0 * math.pi
_ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3}
_USUAL = {"velocity": 1.7, "acceleration": 5.0, "jerk": 45.0, "residual": 0.01, "torque": 4.0}
_GRID, _FIRST_PLACES = 1025, 24
_EXCESS = 1e-7  # of a limit: what may pass it between the places of the programme
_ROUNDS, _TIGHTER, _SOLVER = 24, 8, 1e-9
_DIGITS = 12


class Wish(NamedTuple):
    """What a law is to be minimum in, and what it keeps; phase units.

    Fields
        minimize : str - velocity, acceleration, jerk, residual or torque
        degree : int - of s''
        velocity, acceleration, jerk : float or None - maximum magnitudes
        band : (from, to) or None - natural periods per phase, of `residual`
        damping : float - of the oscillator
        symmetric : bool - s(1 - x) = 1 - s(x), or v(1 - x) = 1 - v(x) from rest to speed
        to_speed : bool - ends with v = 1 and whatever rise, not at rest with rise 1
    """

    minimize: str
    degree: int = 15
    velocity: float | None = None
    acceleration: float | None = None
    jerk: float | None = None
    band: tuple[float, float] | None = None
    damping: float = 0.0
    symmetric: bool = True
    to_speed: bool = False


class Optimum(NamedTuple):
    """A law that minimizes something, with what is proved of it.

    Fields
        coefficients : (n + 1,) tuple - of s'' by Bernstein polynomials
        value : float - what was minimized, from above, everywhere
        lower_bound : float - below it lies no law of the degree that keeps the limits; of `torque` no law at all
        lower_bound_all_laws : float or None - below it lies no law of any form; None where no closed form is known
    """

    coefficients: tuple[float, ...]
    value: float
    lower_bound: float
    lower_bound_all_laws: float | None

    @property
    def gap(self) -> float:
        """How much lower a law of the class may be, as a share of it."""
        return self.value / self.lower_bound - 1.0


@lru_cache(maxsize=64)
def optimum(wish: Wish) -> Optimum:
    """The law of a wish, but for that of minimum torque.

    Raises
        NoSolution - where no law, or none of the degree, keeps the limits; at the key within the law
    Example
        >>> found = optimum(Wish("jerk", acceleration=6.0))
        >>> round(found.value, 3), found.gap < 1e-4
        (39.228, True)
    """
    require_possible(wish)
    programme = Programme(wish)
    coefficients, solved = programme.shipped()
    value = programme.proved_value(coefficients)
    bound = programme.lower_bound(solved, value)
    return Optimum(tuple(coefficients.tolist()), value, bound, bound_of_all_laws(wish))


def require_possible(wish: Wish) -> None:
    """Refuse limits that no law can keep, whatever its form."""
    least = (4.0, 1.0, 1.0) if wish.to_speed else (32.0, 4.0, 1.0)
    for key, low in zip(("jerk", "acceleration", "velocity"), least, strict=True):
        given = getattr(wish, key)
        attained = key == "jerk" or (wish.to_speed and key == "velocity")
        if given is not None and (given < low if attained else given <= low):
            sign, words = (">=", "to at least") if attained else (">", "above")
            ends = "from rest to speed" if wish.to_speed else "from rest to rest"
            what = f"{key}: {given:g} (limit {sign} {low:g}): no law {ends} has a smaller maximum {key}"
            raise NoSolution(what, key=key, fix=f"set {key} {words} {low:g}")
    if wish.minimize == "residual" and wish.acceleration is None and wish.jerk is None:
        message = "minimize: residual needs a limit of acceleration or jerk"
        raise NoSolution(message, key="acceleration", fix="give acceleration or jerk")


def bound_of_all_laws(wish: Wish) -> float | None:
    """What no law of any form lies below; None where no closed form is known.

    rest to rest: acceleration (J/4) (1 - sqrt(1 - 32/J)), velocity (A/2) (1 - sqrt(1 - 4/A)), jerk 32, torque 9/4;
    from rest to speed: acceleration (J/2) (1 - sqrt(1 - 4/J)), jerk 4, velocity 1, torque 1/2

    Source
        own derivation: bang-bang laws; torque from |K'| <= M of the kinetic energy K = v^2/2
    """
    if wish.to_speed:
        return {"acceleration": _ramp(wish.jerk), "jerk": 4.0, "velocity": 1.0, "torque": 0.5}.get(wish.minimize)
    if wish.minimize == "acceleration":
        return 4.0 if wish.jerk is None else 0.25 * wish.jerk * (1.0 - math.sqrt(1.0 - 32.0 / wish.jerk))
    return {"velocity": _ramp(wish.acceleration), "jerk": 32.0, "torque": 2.25}.get(wish.minimize)


def _ramp(slope: float | None) -> float:
    """Minimum height of a trapezoid of area 1 over [0, 1] whose sides are no steeper."""
    return 1.0 if slope is None else 0.5 * slope * (1.0 - math.sqrt(1.0 - 4.0 / slope))


class Basis:
    """Polynomials s'' by Chebyshev series, with s, s', s''' as linear functions of their coefficients."""

    def __init__(self, wish: Wish) -> None:
        orders = np.arange(wish.degree + 1)
        if wish.symmetric:
            orders = orders[::2] if wish.to_speed else orders[1::2]
        self.wish, self.orders = wish, orders
        unit = np.eye(wish.degree + 1)[:, orders]
        velocity = chebyshev.chebint(unit, lbnd=-1, scl=0.5)
        self._series = {
            0: chebyshev.chebint(velocity, lbnd=-1, scl=0.5),
            1: velocity,
            2: unit,
            3: chebyshev.chebder(unit, scl=2),
        }

    @property
    def size(self) -> int:
        """Number of coefficients."""
        return int(self.orders.size)

    def rows(self, order: int, x: Reals) -> Reals:
        """A derivative of s at places, (places, coefficients)."""
        return np.asarray(chebyshev.chebval(2.0 * x - 1.0, self._series[order]).T)

    @cached_property
    def conditions(self) -> tuple[Reals, Reals]:
        """Rows and values of what holds at the ends."""
        ends, wish = np.array([0.0, 1.0]), self.wish
        rows, values = [self.rows(2, ends)], [np.zeros(2)]
        if wish.symmetric:  # what is left follows
            rows, values = [self.rows(2, ends[:1])], [np.zeros(1)]
        if wish.to_speed or not wish.symmetric:
            rows, values = [*rows, self.rows(1, ends[1:])], [*values, np.array([float(wish.to_speed)])]
        if not wish.to_speed:
            rows, values = [*rows, self.rows(0, ends[1:])], [*values, np.ones(1)]
        return np.concatenate(rows), np.concatenate(values)

    def coefficients(self, series: Reals) -> Reals:
        """Bernstein coefficients of s'' that end at 0 and make the rise, or the speed, 1; rounded to 1e-12."""
        wish, full = self.wish, np.zeros(self.wish.degree + 1)
        full[self.orders] = series
        found = bernstein.from_chebyshev(full)
        found[[0, -1]] = 0.0
        mirror = 1.0 if wish.to_speed else -1.0
        halved = 0.5 * (found + mirror * found[::-1])
        found = halved if wish.symmetric else _made_exact(found, to_speed=wish.to_speed)
        places = _DIGITS - 1 - math.floor(math.log10(float(np.max(np.abs(found)))))
        return np.round(found, places)


def _made_exact(found: Reals, *, to_speed: bool) -> Reals:
    """The nearest coefficients that keep their sum, and the rise."""
    n = found.size - 1
    i = np.arange(1, n)
    values = [n + 1.0] if to_speed else [0.0, (n + 1.0) * (n + 2.0)]
    matrix = np.array([np.ones(n - 1), n + 1.0 - i][: len(values)])
    off = np.array(values) - matrix @ found[1:-1]
    inner = found[1:-1] + matrix.T @ np.linalg.solve(matrix @ matrix.T, off)
    return np.concatenate([[0.0], inner, [0.0]])


class Residual:
    """Vibration that a phase leaves, R = |Int s'' exp((-zeta w + i w_d) (1 - x)) dx|/w_d with w = 2 pi lambda.

    Parameters
        band : natural periods per phase for which it is asked
    """

    def __init__(self, basis: Basis, band: tuple[float, float], damping: float) -> None:
        self.damping = damping
        self.damped = math.sqrt(1.0 - damping * damping)
        nodes, weights = _nodes(40 + basis.wish.degree + math.ceil(math.pi * band[1]))
        self._left = 1.0 - nodes
        self._weighted = weights[:, None] * basis.rows(2, nodes)
        self.even, self.real = basis.wish.to_speed, basis.wish.symmetric and damping == 0.0

    def rows(self, periods: Reals) -> Any:
        """The integral over w_d at numbers of periods, (places, coefficients): real where it has one phase."""
        w = _TWO_PI * periods[:, None]
        phase = self._left - 0.5 if self.real else self._left
        found = np.exp((-self.damping + 1j * self.damped) * w * phase) @ self._weighted / (w * self.damped)
        if self.real:
            return found.real if self.even else found.imag
        return found


@dataclass(frozen=True)
class Course:
    """Something linear in the coefficients whose magnitude has a limit, or is minimized.

    Fields
        rows : function of places -> (places, coefficients), real or complex
        low, high : float - where it is asked for
        limit : float or None - None: minimized
    """

    rows: Callable[[Reals], Any]
    low: float
    high: float
    limit: float | None

    def grid(self, count: int) -> Reals:
        """Places, denser towards the ends."""
        return 0.5 * (self.low + self.high - (self.high - self.low) * np.cos(np.linspace(0.0, math.pi, count)))

    @cached_property
    def fine(self) -> tuple[Reals, Any]:
        """The places between which peaks are sought, and their rows."""
        places = self.grid(_GRID)
        return places, self.rows(places)


class Program(NamedTuple):
    """A linear programme in (coefficients, t)."""

    cost: Reals
    rows: Reals
    least: Reals
    most: Reals
    lower: Reals
    upper: Reals


@dataclass
class Solved:
    """A programme with what solves it: coefficients of Chebyshev polynomials, size of the objective."""

    series: Reals
    scale: float
    found: Solution
    program: Program


class Programme:
    """The linear programme of a wish; it learns the places at which its courses pass their limits."""

    def __init__(self, wish: Wish, objective: Course | None = None) -> None:
        self.wish, self.basis = wish, Basis(wish)
        half = 0.5 if wish.symmetric else 1.0
        self.residual = None
        if wish.minimize == "residual":
            assert wish.band is not None
            self.residual = Residual(self.basis, wish.band, wish.damping)
            objective = Course(self.residual.rows, *wish.band, None)
        elif objective is None:
            objective = Course(self._rows(_ORDERS[wish.minimize]), 0.0, half, None)
        limited = (Course(self._rows(_ORDERS[key]), 0.0, half, limit) for key, limit in self.limits)
        self.courses = [objective, *limited]
        self.scale = _USUAL[wish.minimize]
        self.known = [begun(course) for course in self.courses]
        self.around = np.full(self.basis.size, -np.inf), np.full(self.basis.size, np.inf)

    def _rows(self, order: int) -> Callable[[Reals], Reals]:
        return lambda x: self.basis.rows(order, x)

    # The law

    def shipped(self) -> tuple[Reals, Solved]:
        """Bernstein coefficients of a law that keeps every limit everywhere, and what it was solved from."""
        slack = 1e-6
        for _ in range(_TIGHTER):
            solved = self.solved(slack)
            coefficients = self.basis.coefficients(solved.series)
            excess = max((self.peak_of(key, coefficients) / limit - 1.0 for key, limit in self.limits), default=0.0)
            if excess <= 0.0:
                return coefficients, solved
            slack += 2.0 * excess
        raise NoSolution("the linear programme of the law does not converge", key="degree", fix="reduce the degree")

    @property
    def limits(self) -> list[tuple[str, float]]:
        """The limits of the wish, but for what it minimizes."""
        given = [(key, getattr(self.wish, key)) for key in _ORDERS if key != self.wish.minimize]
        return [(key, float(limit)) for key, limit in given if limit is not None]

    @staticmethod
    def peak_of(key: str, coefficients: Reals) -> float:
        """Upper bound of a derivative's magnitude, from the coefficients of s''."""
        if key == "velocity":
            return bernstein.peak(bernstein.integral(coefficients))
        return bernstein.peak(bernstein.derivative(coefficients) if key == "jerk" else coefficients)

    def solved(self, slack: float = 0.0) -> Solved:
        """The programme solved with its limits tightened, and with places added until none passes its limit."""
        for _ in range(_ROUNDS):
            solved = self._once(slack)
            if not 0.1 <= (t := float(solved.found.x[-1])) <= 10.0 and solved.scale > 1e-14:
                self.scale *= max(t, 1e-3)
                continue
            if not self._learn(solved, slack):
                break
        return solved

    def _once(self, slack: float) -> Solved:
        program = self.program()
        both = program.least == -program.most
        tighter = np.where(both, (1.0 - slack) * program.most, program.most)
        least = np.where(both, -tighter, program.least)
        found = solution(*program._replace(least=least, most=tighter), tolerance=_SOLVER)
        if found is None:
            raise self._impossible()
        return Solved(found.x[:-1], self.scale, found, program)

    def program(self) -> Program:
        """The programme with what is known; limits divided by themselves, the objective by its usual size."""
        m, (equal, values) = self.basis.size, self.basis.conditions
        blocks, least, most = [np.pad(equal, ((0, 0), (0, 1)))], [values], [values]
        for course, known in zip(self.courses, self.known, strict=True):
            if course.limit is None:
                for sign in (1.0, -1.0):
                    blocks.append(np.column_stack([sign * known / self.scale, np.full(len(known), -1.0)]))
                    least.append(np.full(len(known), -np.inf))
                    most.append(np.zeros(len(known)))
            else:
                blocks.append(np.pad(known / course.limit, ((0, 0), (0, 1))))
                least.append(np.full(len(known), -1.0))
                most.append(np.ones(len(known)))
        cost = np.append(np.zeros(m), 1.0)
        lower, upper = np.append(self.around[0], 0.0), np.append(self.around[1], np.inf)
        return Program(cost, np.concatenate(blocks), np.concatenate(least), np.concatenate(most), lower, upper)

    def _learn(self, solved: Solved, slack: float) -> bool:
        """Add the places at which a course passes its limit; whether there are any."""
        more = False
        for k, course in enumerate(self.courses):
            limit = solved.scale * float(solved.found.x[-1]) if course.limit is None else course.limit * (1.0 - slack)
            added = _passed(course, solved.series, limit * (1.0 + _EXCESS))
            if added is not None:
                self.known[k] = np.concatenate([self.known[k], added])
                more = True
        return more

    def _impossible(self) -> NoSolution:
        wish = self.wish
        given = ", ".join(f"{key} {limit:g}" for key, limit in self.limits)
        text = f"no law of degree {wish.degree} keeps {given}"
        key, of = ("acceleration", "velocity") if wish.jerk is None else ("jerk", "acceleration")
        if not wish.to_speed and (limit := getattr(wish, key)) is not None:
            least = bound_of_all_laws(wish._replace(minimize=of))
            assert least is not None, "it is known of both"
            text += f" (with {key} {limit:g} the {of} of any law reaches {safely_below(least)})"
        return NoSolution(text, fix="increase degree or a limit")

    # What is proved

    def proved_value(self, coefficients: Reals) -> float:
        """What was minimized, from above, over all places."""
        if self.residual is None:
            return self.peak_of(self.wish.minimize, coefficients)
        assert self.wish.band is not None
        return greatest_residual(coefficients, self.wish.band, self.wish.damping)

    def lower_bound(self, solved: Solved, value: float) -> float:
        """Below it no law of the class lies: from the duals, with the limits themselves."""
        box = 2.0 * self._greatest_acceleration(value)  # of the Chebyshev coefficients of what is bounded so
        size = np.full(self.basis.size, box)
        lower, upper = np.append(-size, 0.0), np.append(size, 2.0 * value / solved.scale)
        return solved.scale * proved_bound(solved.found, *solved.program._replace(lower=lower, upper=upper))

    def _greatest_acceleration(self, value: float) -> float:
        """What |s''| of a law that keeps the limits and is no worse does not pass."""
        wish = self.wish
        limits = {key: value if key == wish.minimize else getattr(wish, key) for key in _ORDERS}
        shares = {"acceleration": 1.0, "jerk": 0.5, "velocity": 2.0 * (wish.degree + 1) ** 2}  # Markov's inequality
        return float(min(share * limits[key] for key, share in shares.items() if limits[key] is not None))


def _nodes(count: int) -> tuple[Reals, Reals]:
    """Nodes and weights of Gauss and Legendre on [0, 1]."""
    x, w = gauss_legendre(count)
    return 0.5 * (x + 1.0), 0.5 * w


def begun(course: Course, places: int = _FIRST_PLACES) -> Reals:
    """Rows of a course at its first places; of a complex one in four directions."""
    rows = course.rows(course.grid(places))
    if not np.iscomplexobj(rows):
        return np.asarray(rows)
    return np.concatenate([(rows * np.exp(-0.25j * math.pi * k)).real for k in range(4)])


def _passed(course: Course, series: Reals, limit: float) -> Reals | None:
    """Rows of the places between which a course has its peaks above a limit; None where it has none."""
    places, fine = course.fine
    values = np.abs(fine @ series)
    inner = values[1:-1]
    peaks = np.flatnonzero((inner >= values[:-2]) & (inner >= values[2:]) & (inner > limit)) + 1
    found = [_top(places[k - 1 : k + 2], values[k - 1 : k + 2]) for k in peaks]
    found += [float(places[k]) for k in (0, -1) if values[k] > limit]
    if not found:
        return None
    rows = course.rows(np.array(found))
    if not np.iscomplexobj(rows):
        return np.asarray(rows)
    whole: Points = rows @ series
    return np.asarray((rows * np.exp(-1j * np.angle(whole))[:, None]).real)


def _top(x: Reals, y: Reals) -> float:
    """Where the parabola through three points is greatest."""
    (a, b, c), (p, q, r) = x, y
    left, right = (q - p) / (b - a), (r - q) / (c - b)
    bend = (right - left) / (c - a)
    if bend >= 0.0:
        return float(b)
    return float(min(max(0.5 * (a + b) - 0.5 * left / bend, a), c))


def greatest_residual(coefficients: Sequence[float] | Reals, band: tuple[float, float], damping: float) -> float:
    """Upper bound of the residual of a law over a band of periods, 1e-6 of it too high at most, and 1e-15.

    Parameters
        coefficients : of s'' by Bernstein polynomials
    Notes
        Between two places the integral is off its chord by h^2/8 of the bound of its second derivative.
    """
    c = np.asarray(coefficients, dtype=np.float64)
    damped = math.sqrt(1.0 - damping * damping)
    nodes, weights = _nodes(40 + c.size + math.ceil(math.pi * band[1]))
    left, values = 1.0 - nodes, weights * bernstein.evaluate(c, nodes)

    def numerator(periods: Reals) -> Reals:
        w = _TWO_PI * periods[:, None]
        return np.asarray(np.abs(np.exp((-damping + 1j * damped) * w * left) @ values))

    # |d^2/dlambda^2| of the integral; exp(...) is turned to the middle of the phase, which no magnitude feels
    spread = (_TWO_PI * (damping + 0.5 * damped)) ** 2 * bernstein.peak(c) / 8.0
    low = np.linspace(*band, 257)[:-1]
    high = np.append(low[1:], band[1])
    at_low, at_high = numerator(low), numerator(high)
    best = 0.0
    for _ in range(60):
        best = max(best, float(np.max(at_low / low)), float(np.max(at_high / high)))
        bound = (np.maximum(at_low, at_high) + spread * (high - low) ** 2) / low
        doubtful = bound > best * (1.0 + 1e-6) + 1e-15 * _TWO_PI
        if not doubtful.any():
            break
        low, high, at_low, at_high = low[doubtful], high[doubtful], at_low[doubtful], at_high[doubtful]
        middle = 0.5 * (low + high)
        at = numerator(middle)
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
        at_low, at_high = np.concatenate([at_low, at]), np.concatenate([at, at_high])
    return (best * (1.0 + 1e-6) + 1e-15 * _TWO_PI) / (_TWO_PI * damped)


_PLACES, _FINE = 129, 2049
_STEPS, _SETTLED = 40, 3e-6
_INTERVALS, _CUTS = 200, 6


@lru_cache(maxsize=64)
def least_torque(wish: Wish) -> Optimum:
    """A law whose |s' s''| is less than that of its neighbours.

    Raises
        NoSolution - as `optimum`
    Notes
        `lower_bound` holds for every law with the same maximum acceleration, whatever its form and jerk.
    """
    require_possible(wish)
    coefficients = _Search(wish).shipped()[0]
    value = bernstein.peak(bernstein.product(bernstein.integral(coefficients), coefficients))
    bound = bound_of_all_laws(wish)
    assert bound is not None
    lower = bound if wish.to_speed else max(bound, _bound_by_energy(wish, value))
    return Optimum(tuple(coefficients.tolist()), value, lower, bound)


class _Search(Programme):
    """The programme of the linear part of |s' s''| about the best law so far."""

    def __init__(self, wish: Wish) -> None:
        half = 0.5 if wish.symmetric else 1.0
        super().__init__(wish, Course(self._linear_part, 0.0, half, None))
        self.fine = np.linspace(0.0, half, _FINE)

    def _linear_part(self, x: Reals) -> Reals:
        """v0 a + a0 v - v0 a0 times the rise, or the speed, which is 1."""
        v, a = self.basis.rows(1, x), self.basis.rows(2, x)
        if not hasattr(self, "best"):
            return a
        v0, a0 = v @ self.best, a @ self.best
        one = self.basis.rows(1 if self.wish.to_speed else 0, np.ones(1))[0]
        return np.asarray(v0[:, None] * a + a0[:, None] * v - (v0 * a0)[:, None] * one)

    def _value(self, series: Reals) -> float:
        v, a = (self.basis.rows(order, self.fine) @ series for order in (1, 2))
        return float(np.max(np.abs(v * a)))

    def _begin(self) -> None:
        """From the law of minimum acceleration that keeps the other limits."""
        wish = self.wish
        start = optimum(wish._replace(minimize="acceleration", acceleration=None))
        if wish.acceleration is not None and start.value > wish.acceleration:
            raise self._impossible()
        c, n = np.array(start.coefficients), wish.degree
        self.best = chebyshev.chebinterpolate(lambda u: bernstein.evaluate(c, 0.5 * (u + 1.0)), n)[self.basis.orders]

    def solved(self, slack: float = 0.0) -> Solved:
        """The last programme of the search."""
        if not hasattr(self, "best"):
            self._begin()
        value = math.inf  # what was best may pass a limit that is tighter now
        size = float(np.max(np.abs(self.best)))
        reach = 0.3 * size
        for _ in range(_STEPS):
            self.courses[0] = replace(self.courses[0])  # the linear part about another law
            self.known[0] = begun(self.courses[0], _PLACES)
            self.around = self.best - reach, self.best + reach
            found = super().solved(slack)
            reached = self._value(found.series)
            promised = value - found.scale * float(found.found.x[-1])
            if value < math.inf and (promised <= _SETTLED * value or reach < _SETTLED * size):
                break
            if reached < value:
                reach *= 2.0 if value - reached > 0.7 * promised else 0.7
                self.best, value = found.series, reached
            else:
                reach *= 0.25
        found.series = self.best
        return found


class _Energy(NamedTuple):
    """Columns v_0..v_N, K_0..K_N, M of the programme over half the phase."""

    intervals: int
    step: float
    acceleration: float

    @property
    def columns(self) -> int:
        return 2 * self.intervals + 3

    def rows(self) -> tuple[Reals, Reals]:
        """Rows and their upper limits that hold for every law: steps of v and K, and the rise."""
        n, h, top = self.intervals, self.step, self.acceleration
        v, k = np.eye(n + 1, self.columns), np.eye(n + 1, self.columns, n + 1)
        torque = np.zeros((n, self.columns))
        torque[:, -1] = h
        dv, dk, mean = v[1:] - v[:-1], k[1:] - k[:-1], 0.5 * (v[1:] + v[:-1])
        blocks = [dv, -dv, dk - torque, -dk - torque, dk - top * h * mean, -dk - top * h * mean]
        bend = 0.25 * (top * h) ** 2
        limits = [np.full(n, top * h)] * 2 + [np.zeros(n)] * 2 + [np.full(n, bend)] * 2
        rise = -h * mean.sum(axis=0, keepdims=True)
        return np.concatenate([*blocks, rise]), np.append(np.concatenate(limits), 0.25 * top * h * n * h - 0.5)

    def cuts(self, at: Reals) -> tuple[Reals, Reals]:
        """v_j below the tangents of sqrt(2 K) at places of K."""
        root = np.sqrt(2.0 * at)
        rows = np.zeros((self.intervals + 1, self.columns))
        j = np.arange(self.intervals + 1)
        rows[j, j], rows[j, self.intervals + 1 + j] = 1.0, -1.0 / root
        return rows, 0.5 * root


def _bound_by_energy(wish: Wish, value: float) -> float:
    """Below it |s' s''| of no law with |s''| <= A and |s'| <= V lies, by K = s'^2/2 at equal steps of half the phase.

    |dK| <= M h,  |dv| <= A h,  |dK| <= A h (v_j + v_j+1)/2 + A^2 h^2/4,  v <= sqrt(2 K),  sum of the rise >= 1/2

    Notes
        Every condition is necessary, and what holds for a law and its mirror image holds for their mean.
    """
    accelerations = [each for each in (wish.acceleration, None if wish.jerk is None else 0.5 * wish.jerk) if each]
    if not accelerations:
        return 0.0
    top = min(accelerations)
    fastest = min(0.5 * top, math.inf if wish.velocity is None else wish.velocity)
    energy = _Energy(_INTERVALS, 0.5 / _INTERVALS, top)
    lower = np.zeros(energy.columns)
    upper = np.concatenate([np.full(_INTERVALS + 1, fastest), np.full(_INTERVALS + 1, 0.5 * fastest**2), [2.0 * value]])
    lower[: _INTERVALS + 1] = -fastest
    upper[[0, _INTERVALS + 1]] = lower[0] = 0.0
    cost = np.zeros(energy.columns)
    cost[-1] = 1.0
    rows, limits = energy.rows()
    x = np.arange(_INTERVALS + 1) / _INTERVALS
    at = np.maximum(0.5 * np.minimum(top * 0.5 * x, min(fastest, 2.0)) ** 2, 1e-8)
    best = 0.0
    for _ in range(_CUTS):
        more, most = energy.cuts(at)
        rows, limits = np.concatenate([rows, more]), np.append(limits, most)
        program = Program(cost, rows, np.full(limits.size, -np.inf), limits, lower, upper)
        found = solution(*program)
        if found is None:
            raise NoSolution(f"no law keeps acceleration {top:g} and velocity {fastest:g}", fix="increase a limit")
        best = max(best, proved_bound(found, *program))
        at = np.maximum(found.x[_INTERVALS + 1 : -1], 1e-8)
    return best
