"""A geared five-bar that generates a function over an interval with the smallest maximum error, or meets positions.

Of a function the maximum error is levelled; two to five positions, angles of the output link at given input angles,
are met exactly.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import amount, ascending
from gearlink.core.machines.five_bar.function_motion import (
    FunctionFiveBar,
    Positions,
    StructuralError,
    outputs,
    structural_error,
)
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.numerics.linear_program import Solution, least
from gearlink.core.numerics.lm import State, damped_normal, descend, normal
from gearlink.core.numerics.quasi_random import halton
from gearlink.core.parts.linkages.functions import Wanted

_NODES, _GRID = 9, 121
_STARTS, _ROUNDS, _STEPS = 300, 1, 60
# Steps of levelling: the best so many of a round by so many steps, the best of these by more.
_RACE = ((5, 15), (2, 25), (1, 80))
_SCATTER = 1.6
_WEIGHT = 3.0
_FARTHEST = 6.0
_MARGIN = math.radians(0.01)  # of the transmission angle against rounding


@dataclass(frozen=True, slots=True)
class Round:
    """A round of the search: starts so far, and the smallest maximum error so far [rad], NaN before one is found."""

    starts: int
    error: float


@dataclass(frozen=True, slots=True)
class FunctionFit:
    """A five-bar, the input angle at which the function starts [rad], its error, and how the search came to it."""

    bar: FunctionFiveBar
    start: float
    error: StructuralError
    rounds: tuple[Round, ...]


def fit_function(
    first: FunctionFiveBar, start: float, wanted: Wanted, transmission_angle: float, seconds: float | None = None
) -> FunctionFit:
    """Links, phase and start with which the maximum error over the interval is smallest.

    max |psi(phi0 + dphi s) - psi_wanted(s) - psi0| -> min over b, c, e, d, t20, phi0, psi0

    Parameters
        first : FunctionFiveBar - a start; input link and coupler ratio are kept
        start : float [rad] - phi0 of it
        transmission_angle : float [rad] - the minimum that is allowed over the interval
        seconds : float or None - budget of time: rounds of starts are begun until it is spent; without one there are
            one round, and the same file gives the same links
    Raises
        NoSolution - where no start came to a five-bar with that transmission angle
    Notes
        Each round: 300 scattered starts (no random numbers) by Levenberg's steps for the squares at nine Chebyshev
        nodes, the transmission angle as a penalty at the nodes; the five best are levelled for some steps, of these the
        two best for more, and the best to its end. Levelled is what has eight alternating extremes of one size, one
        fewer for each place where the transmission angle, and each link that is at its limit; that no other start
        would come lower is not proved.
    """
    begun, best, rounds = time.monotonic(), None, []
    for number in range(_ROUNDS if seconds is None else 1_000_000):
        for bar, phi0 in _round(first, start, wanted, transmission_angle, number):
            found = _judged(bar, phi0, wanted, transmission_angle)
            if found is not None and (best is None or found.error.greatest < best.error.greatest):
                best = found
        rounds.append(Round((number + 1) * _STARTS, math.nan if best is None else best.error.greatest))
        if seconds is not None and time.monotonic() - begun >= seconds:
            break
    if best is None:
        raise NoSolution(
            "no five-bar was found that generates this function with the required transmission angle",
            fix="reduce limits.transmission_angle, input_swing or output_swing, or use other gears",
        )
    return replace(best, rounds=tuple(rounds))


def _judged(bar: FunctionFiveBar, start: float, wanted: Wanted, least: float) -> FunctionFit | None:
    try:
        angle, _ = bar.min_transmission_angle(start, start + wanted.input_swing)
        return FunctionFit(bar, start, structural_error(bar, start, wanted), ()) if angle >= least else None
    except NoSolution:
        return None


def _round(
    first: FunctionFiveBar, start: float, wanted: Wanted, least: float, number: int
) -> Iterator[tuple[FunctionFiveBar, float]]:
    """The best of a round, levelled as far as they deserve it, the best of them first."""
    limit = math.cos(least + _MARGIN)
    running = [Levelling(*made, wanted, limit) for made in _best(first, start, wanted, limit, number)]
    for kept, steps in _RACE:
        for one in running[:kept]:
            one.advance(steps)
        running[:kept] = sorted(running[:kept], key=lambda one: one.worst)
    for one in running:
        yield one.bar, one.start


def _best(
    first: FunctionFiveBar, start: float, wanted: Wanted, limit: float, number: int
) -> Iterator[tuple[FunctionFiveBar, float]]:
    """The best starts of a round by their squares; the file's own links are the first start of all."""
    share = halton(number * _STARTS + 1, _STARTS, 7)
    x = _SCATTER * (2.0 * share - 1.0)
    x[:, 4:] = 2.0 * math.pi * share[:, 4:]
    if number == 0:
        lengths = (first.coupler, first.follower, first.output, first.frame)
        x[0, :6] = (*(math.log(length / first.input) for length in lengths), first.phase, start)
    s = 0.5 * (1.0 - np.cos((2.0 * np.arange(1, _NODES + 1) - 1.0) * math.pi / (2.0 * _NODES)))
    target = wanted.output(s)
    x, cost = _descended(x, wanted.input_swing * s, target, first.coupler_ratio, limit)
    kept = 0
    seen: list[Reals] = []
    for row in x[np.argsort(cost, kind="stable")]:
        if kept == _RACE[0][0] or not np.all(np.isfinite(row)):
            return
        if np.any(np.abs(row[:4]) > WIDEST) or any(np.abs(row - other).max() < 1e-4 for other in seen):
            continue
        for made in _moving(first, row, wanted):
            seen.append(row)
            kept += 1
            yield made


def _moving(first: FunctionFiveBar, row: Reals, wanted: Wanted) -> Iterator[tuple[FunctionFiveBar, float]]:
    """The five-bar of a row in the assembly in which it follows the function, if it closes in either."""
    b, c, e, d = (first.input * math.exp(float(value)) for value in row[:4])
    phase, start = math.remainder(float(row[4]), 2.0 * math.pi), float(row[5]) % (2.0 * math.pi)
    # the phase is the coupler's direction at input angle 0: whole revolutions of the start change it with the ratio
    phase += first.coupler_ratio * (float(row[5]) - start)
    s = np.linspace(0.0, 1.0, _GRID)
    spread = []
    for assembly in (1, -1):
        bar = replace(
            first, coupler=b, follower=c, output=e, frame=d, phase=math.remainder(phase, math.tau), assembly=assembly
        )
        miss = outputs(bar, start + wanted.input_swing * s) - wanted.output(s)
        if np.all(np.isfinite(miss)):
            spread.append((float(np.ptp(miss)), bar))
    if spread:
        least, bar = min(spread, key=lambda found: found[0])
        if least < 0.5 * abs(wanted.output_swing):
            yield bar, start


# Least squares at the nodes


def _descended(x: Reals, phi: Reals, psi: Reals, ratio: float, cosine: float) -> tuple[Reals, Reals]:
    """Rows of ln(b/a), ln(c/a), ln(e/a), ln(d/a), t20, phi0, psi0 after Levenberg's steps, and their squares."""

    def state(x: Reals) -> State:
        value = _misses(x, phi, psi, ratio, cosine)
        return np.sum(value**2, axis=1), value

    def slopes(x: Reals, state: State) -> State:
        return normal(_slopes(x, state[1], phi, psi, ratio, cosine), state[1])

    def step(x: Reals, state: State, damping: Reals) -> Reals:
        moved = damped_normal(state[2], state[3], damping, scaled=False)
        return x + np.clip(np.nan_to_num(moved), -0.4, 0.4)

    x, (cost, _), _, _ = descend(state, step, x, _STEPS, slopes=slopes)
    return x, cost


def _directions(x: Reals, phi: Reals, psi: Reals, ratio: float) -> tuple[Points, Points, Points]:
    """Directions of input link, coupler and output link at the nodes."""
    turned = phi + x[:, 5:6]
    return np.exp(1j * turned), np.exp(1j * (x[:, 4:5] + ratio * turned)), np.exp(1j * (x[:, 6:7] + psi))


def _lengths(x: Reals) -> tuple[Reals, ...]:
    return tuple(np.exp(np.clip(x[:, i], -_FARTHEST, _FARTHEST))[:, None] for i in range(4))


def _misses(x: Reals, phi: Reals, psi: Reals, ratio: float, cosine: float) -> Reals:
    """(|CD| - c)/e at the nodes, and the excess of |cos mu| over its limit, for every row."""
    (b, c, e, d), (crank, planet, hand) = _lengths(x), _directions(x, phi, psi, ratio)
    joint = crank + b * planet
    gap = joint - d - e * hand
    mu = (c * c + e * e - np.abs(d - joint) ** 2) / (2.0 * c * e)
    return np.concatenate(((np.abs(gap) - c) / e, _WEIGHT * np.maximum(0.0, np.abs(mu) - cosine)), axis=1)


def _slopes(x: Reals, value: Reals, phi: Reals, psi: Reals, ratio: float, cosine: float) -> Reals:
    """Derivatives by the unknowns, in closed form; none by a length that is kept within its bounds.

    g = e^(i phi) + b e^(i t2) - d - e e^(i psi):   d|g| = Re(g* dg)/|g|,   d cos mu = Re(w* dw)/(c e), w = d - B
    """
    (b, c, e, d), (crank, planet, hand) = _lengths(x), _directions(x, phi, psi, ratio)
    planet, hand = b * planet, e * hand
    far = d - crank - planet
    gap = -far - hand
    mu = (c * c + e * e - np.abs(far) ** 2) / (2.0 * c * e)
    toward, across = np.conj(gap / np.maximum(np.abs(gap), 1e-300)) / e, np.conj(far) / (c * e)
    found = np.zeros((*value.shape, 7))
    near, turned = found[:, : phi.shape[-1]], found[:, phi.shape[-1] :]
    swept = 1j * (crank + ratio * planet)
    for column, moved in ((0, planet), (3, -d), (4, 1j * planet), (5, swept)):
        near[..., column], turned[..., column] = (moved * toward).real, (moved * across).real
    near[..., 1], near[..., 2] = -c / e, -(hand * toward).real - value[:, : phi.shape[-1]]
    near[..., 6] = (hand * toward).imag
    turned[..., 1], turned[..., 2] = c / e - mu, e / c - mu
    turned *= (_WEIGHT * np.sign(mu) * (np.abs(mu) > cosine))[..., None]
    found[..., :4] *= (np.abs(x[:, :4]) < _FARTHEST)[:, None, :]
    return found


WIDEST = math.log(20.0)
"""Logarithm of the maximum ratio of another link to the input link, or of this to the other; beyond, a drawing would
not show both."""
# Shares of the promised gain: below the first a step is corrected, above the others trust grows or stays.
_CORRECTED, _TRUSTED, _KEPT = 0.75, 0.5, 0.1
_LEAST_GAIN, _LEAST_TRUST = 1e-5, 1e-10


class Levelling:
    """A five-bar on its way to the smallest maximum error over an interval.

    max_s |psi(phi0 + dphi s) - psi_wanted(s) - psi0| -> min over ln b, ln c, ln e, ln d, t20, phi0 and psi0

    Notes
        Each step solves a linear program on 121 places, within a region of trust that adapts. The errors bend, so the
        step of a program raises extremes that it thought level; it is then solved again with the errors at that step
        instead of what the slopes say of them. Without this correction steps along a curved valley shrink to nothing.
        All links stay within 1/20 and 20 times the input link.

    Source
        K. Madsen, H. Schjaer-Jacobsen, Mathematical Programming 14 (1978) 208; the correction: R. Fletcher, Lecture
        Notes in Mathematics 912 (1982) 85
    """

    def __init__(self, bar: FunctionFiveBar, start: float, wanted: Wanted, limit: float) -> None:
        """Begin with a five-bar and the input angle at which the function starts.

        Parameters
            bar : FunctionFiveBar - it closes over the whole interval
            start : float [rad] - phi0
            limit : float - the maximum |cos mu| that is allowed, mu the transmission angle
        """
        # as dense at the ends as the extremes are
        s = 0.5 * (1.0 - np.cos(math.pi * np.linspace(0.0, 1.0, _GRID)))
        self._first, self._limit = bar, limit
        self._target, self._swing = wanted.output(s), wanted.input_swing * s
        lengths = (bar.coupler, bar.follower, bar.output, bar.frame)
        self._x = np.array([*(math.log(length / bar.input) for length in lengths), bar.phase, start])
        self._miss, self._cosine = state(bar, start, self._swing, self._target)
        self.worst = self._worst(self._miss, self._cosine)
        self._slopes = slopes(bar, start, self._swing)
        self._trust, self._ended = 0.05, False
        self._near: Solution | None = None

    @property
    def bar(self) -> FunctionFiveBar:
        """The five-bar so far."""
        return self._made(self._x)

    @property
    def start(self) -> float:
        """Input angle at which the function starts [rad]."""
        return float(self._x[5])

    def advance(self, steps: int) -> None:
        """So many steps more, fewer where no more is gained."""
        for _ in range(steps):
            if self._ended:
                return
            self._step()

    def _step(self) -> None:
        step = self._program(self._miss, self._cosine)
        promised = 0.0 if step is None else self.worst - 0.5 * float(np.ptp(self._miss + self._slopes[0] @ step))
        if step is None or promised <= 0.1 * _LEAST_GAIN * self.worst:
            self._ended = True
            return
        x, miss, cosine, worst = self._tried(step)
        if self.worst - worst < _CORRECTED * promised and math.isfinite(worst):
            outward, turns = self._slopes
            second = self._program(miss - outward @ step, cosine - turns @ step)
            if second is not None and (corrected := self._tried(second))[3] < worst:
                x, miss, cosine, worst = corrected
        gained = self.worst - worst
        if not gained > 0.0:
            self._trust *= 0.25
            self._ended = self._trust < _LEAST_TRUST
            return
        share = gained / promised
        self._trust = min(0.5, 2.0 * self._trust) if share > _TRUSTED else self._trust * (1.0 if share > _KEPT else 0.5)
        self._x, self._miss, self._cosine, self.worst = x, miss, cosine, worst
        self._ended = gained <= _LEAST_GAIN * worst
        self._slopes = slopes(self.bar, self.start, self._swing)

    def _tried(self, step: Reals) -> tuple[Reals, Reals, Reals, float]:
        x = self._x + step
        miss, cosine = state(self._made(x), float(x[5]), self._swing, self._target)
        return x, miss, cosine, self._worst(miss, cosine)

    def _made(self, x: Reals) -> FunctionFiveBar:
        b, c, e, d = (self._first.input * math.exp(float(value)) for value in x[:4])
        return replace(self._first, coupler=b, follower=c, output=e, frame=d, phase=float(x[4]))

    def _worst(self, miss: Reals, cosine: Reals) -> float:
        """The maximum error, with the excess of cos mu as what must go first."""
        if not np.all(np.isfinite(miss)):
            return math.inf
        return float(np.abs(miss).max() + 10.0 * max(0.0, float(np.abs(cosine).max()) - self._limit))

    def _program(self, miss: Reals, cosine: Reals) -> Reals | None:
        """Step of the unknowns that makes the maximum error minimum, as far as its slopes tell."""
        outward, turns = self._slopes
        if not (np.all(np.isfinite(outward)) and np.all(np.isfinite(turns))):
            return None
        ones, trust = np.ones((miss.size, 1)), self._trust
        # psi0 and the error in this: the programs' tolerance is that of numbers about 1
        size = float(np.abs(miss).max())
        rows = [np.hstack((side / size * outward, -side * ones, -ones)) for side in (1.0, -1.0)]
        edges = [-miss / size, miss / size]
        over = max(self._limit, float(np.abs(cosine).max()) - 0.1 * trust)
        reach = trust * np.abs(turns).sum(axis=1)
        for side in (1.0, -1.0):
            near: Mask = side * cosine + reach > over  # the others cannot be reached within the trust
            rows.append(np.hstack((side * turns[near], np.zeros((int(near.sum()), 2)))))
            edges.append((over - side * cosine)[near])
        links = self._x[:4]
        down, up = np.clip(-WIDEST - links, -trust, 0.0), np.clip(WIDEST - links, 0.0, trust)
        found = least(
            np.array([0.0] * 7 + [1.0]),
            np.vstack(rows),
            np.concatenate(edges),
            np.array([*down, -trust, -trust, -np.inf, 0.0]),
            np.array([*up, trust, trust, np.inf, np.inf]),
            self._near,
        )
        if found is None:
            return None
        self._near = found
        return found.x[:6]


def state(bar: FunctionFiveBar, start: float, swing: Reals, target: Reals) -> tuple[Reals, Reals]:
    """Misses about their middle [rad], and cos mu.

    Parameters
        start : float [rad] - phi0
        swing, target : (N,) arrays [rad] - input angles from there, and what the output should turn to
    Returns
        miss, cosine : (N,) arrays - NaN where the five-bar does not close
    """
    phi = start + swing
    miss = outputs(bar, phi) - target
    joint = bar.input * np.exp(1j * phi) + bar.coupler * np.exp(1j * (bar.phase + bar.coupler_ratio * phi))
    c, e = bar.follower, bar.output
    cosine = (c * c + e * e - np.abs(bar.frame - joint) ** 2) / (2.0 * c * e)
    return miss - 0.5 * (miss.max() + miss.min()), cosine


def slopes(bar: FunctionFiveBar, start: float, swing: Reals) -> tuple[Reals, Reals]:
    """Derivatives of the output angle and of cos mu by ln b, ln c, ln e, ln d, t20 and phi0, at the places.

    |g| = c,  g = a e^(i phi) + b e^(i t2) - d - e e^(i psi):   dpsi = (Re(g* dg) - c dc)/Re(g* i e e^(i psi))
    """
    phi = start + swing
    c, e, d = bar.follower, bar.output, bar.frame
    crank = bar.input * np.exp(1j * phi)
    planet = bar.coupler * np.exp(1j * (bar.phase + bar.coupler_ratio * phi))
    hand = e * np.exp(1j * outputs(bar, phi))
    far = d - crank - planet
    mu = (c * c + e * e - np.abs(far) ** 2) / (2.0 * c * e)
    nothing = np.zeros(phi.size, dtype=complex)
    moves = np.stack(
        (planet, nothing, -hand, nothing - d, 1j * planet, 1j * (crank + bar.coupler_ratio * planet)), axis=1
    )
    along = np.conj(-far - hand)
    pulled = (along[:, None] * moves).real
    pulled[:, 1] -= c * c
    apart = (np.conj(far)[:, None] * moves).real / (c * e)
    apart[:, 1], apart[:, 2] = c / e - mu, e / c - mu
    return pulled / (along * 1j * hand).real[:, None], apart


# Output angles at given input angles

MOST_POSITIONS = 5
_POSITION_STARTS = 1500
_POSITION_STEPS = 80
_FARTHEST_LINK = 2.0 * WIDEST
_SCATTER_OF_LINKS = 1.5
# A five-bar that comes nearer to its dead centre than this is of no use to anybody [rad].
_LEAST_ANGLE = math.radians(0.5)
# Sum of squared misses over the input link of a candidate that is worth following; its motion decides.
_CLOSE = 1e-22
# Largest error of an output angle of a design that counts as found [rad].
_EXACT = 1e-9


def five_bar_for_positions(
    start: FunctionFiveBar, positions: Positions, transmission_angle: float = 0.0
) -> FunctionFiveBar:
    """Geared five-bar whose output link stands at given angles at given input angles.

    |a e^(i phi_j) + b e^(i (t20 + m phi_j)) - d - e e^(i psi_j)| = c,   j = 1..n

    Parameters
        start : FunctionFiveBar - input link and coupler ratio are kept (the gears give them); the rest is a start
        positions : sequence of (phi, psi) [rad] - two to five, phi ascending
        transmission_angle : float [rad] - the minimum that is wanted between the first and the last position
    Returns
        bar : FunctionFiveBar - of those found that have this transmission angle the one with the smallest differences
            in length; where none has it, the one with the maximum
    Raises
        NoSolution - for too few or too many positions, or where nothing meets them on one unbroken motion
    Notes
        Levenberg's steps from the start and 1500 fixed scattered ones at once (no random numbers). A candidate counts
        only if its own motion, in one assembly and without opening on the way, meets every angle to 1e-9 rad.
    Source
        thesis 2.2.2, section 4; own derivation
    """
    _require(positions)
    found = [bar for candidate in _candidates(start, positions) for bar in _meeting(candidate, positions)]
    if not found:
        raise NoSolution(
            f"no five-bar was found that meets the {len(positions)} positions in one continuous motion",
            fix="omit one, bring them nearer to each other, or start from other links (coupler, follower, output, "
            "frame, phase)",
        )
    return max(found, key=lambda bar: _quality(bar, positions, transmission_angle))


def _require(positions: Positions) -> None:
    if not 2 <= len(positions) <= MOST_POSITIONS:
        raise NoSolution(
            f"{amount(len(positions), 'position')}",
            fix=f"give two to {MOST_POSITIONS}, as many as there are free links",
        )
    for (one, _), (other, _) in pairwise(positions):
        if not one < other:
            angles = [math.degrees(angle) for angle, _ in positions]
            raise NoSolution(
                f"input angles must ascend: {math.degrees(other):g} deg follows {math.degrees(one):g} deg",
                fix=ascending(angles, "target.positions[{}][0]") or "sort them",
            )


def _starts(bar: FunctionFiveBar) -> Reals:
    """Rows of the unknowns ln(b/a), ln(c/a), ln(e/a), ln(d/a), t20: the start, and scattered ones about it."""
    first = [math.log(length / bar.input) for length in (bar.coupler, bar.follower, bar.output, bar.frame)]
    share = halton(1, _POSITION_STARTS, 5)
    lengths = np.array(first) + _SCATTER_OF_LINKS * (2.0 * share[:, :4] - 1.0)
    scattered = np.hstack((lengths, bar.phase + 2.0 * math.pi * share[:, 4:]))
    return np.concatenate(([[*first, bar.phase]], scattered))


def _candidates(start: FunctionFiveBar, positions: Positions) -> Iterator[FunctionFiveBar]:
    """Five-bars that satisfy the equations of the positions, not yet known to move between them."""
    phi, psi = (np.array(column) for column in zip(*positions, strict=True))
    state = partial(_position_state, phi=phi, psi=psi, ratio=start.coupler_ratio)
    found = descend(state, _position_step, _starts(start), _POSITION_STEPS, slopes=_square, damping=1.0, least=0.0)
    x, (cost, *_), _, _ = found
    close = (cost < _CLOSE) & np.all(np.abs(x[:, :4]) < WIDEST, axis=1)
    seen: set[tuple[float, ...]] = set()
    for row in x[close]:
        row[4] = math.remainder(float(row[4]), 2.0 * math.pi)
        alike = tuple(np.round(row, 6).tolist())
        if alike in seen:
            continue
        seen.add(alike)
        b, c, e, d = (start.input * math.exp(float(v)) for v in row[:4])
        yield replace(start, coupler=b, follower=c, output=e, frame=d, phase=float(row[4]))


def _position_state(x: Reals, phi: Reals, psi: Reals, ratio: float) -> State:
    """Squares, |CD| - c at each position over the input link, for every row of unknowns, and its derivatives."""
    b, c, e, d = (np.exp(np.clip(x[:, i], -_FARTHEST_LINK, _FARTHEST_LINK))[:, None] for i in range(4))
    coupler = b * np.exp(1j * (x[:, 4:5] + ratio * phi))
    arm = e * np.exp(1j * psi)
    gap = np.exp(1j * phi) + coupler - d - arm
    long = np.abs(gap)
    toward = np.conj(gap) / np.maximum(long, 1e-12)
    parts = (coupler * toward).real, -c + 0.0 * long, -(arm * toward).real, -d * toward.real
    slopes = np.stack((*parts, (1j * coupler * toward).real), axis=2)
    return np.sum((long - c) ** 2, axis=1), long - c, slopes


def _square(_x: Reals, state: State) -> State:
    """J J^T of every row, with a floor against rounding."""
    slopes = state[2]
    square = slopes @ np.swapaxes(slopes, 1, 2)
    # The floor goes with the size, else rounding takes it where one link is a million times the others.
    return square, 1e-14 * np.maximum(1.0, np.einsum("kii->k", square))


def _position_step(x: Reals, state: State, damping: Reals) -> Reals:
    """Levenberg's step of minimum length for every row: -J^T (J J^T + damping)^-1 value."""
    cost, value, slopes, square, floor = state
    held = square + (damping * np.minimum(cost, 1.0) + floor)[:, None, None] * np.eye(value.shape[1])
    step: Reals = np.squeeze(np.swapaxes(slopes, 1, 2) @ np.linalg.solve(held, value[:, :, None]), axis=2)
    return x - np.clip(step, -0.5, 0.5)


def _meeting(bar: FunctionFiveBar, positions: Positions) -> Iterator[FunctionFiveBar]:
    """The five-bar in the assembly, if any, in which its motion meets the positions."""
    first, last = positions[0][0], positions[-1][0]
    for assembly in (1, -1):
        made = replace(bar, assembly=assembly)
        try:  # the cheap questions first: few candidates come to the last one
            if (
                all(_stands(made, phi, psi) for phi, psi in positions)
                and made.min_transmission_angle(first, last)[0] >= _LEAST_ANGLE
                and max(map(abs, made.position_errors(positions))) <= _EXACT
            ):
                yield made
        except NoSolution:  # it opens on the way, in either assembly
            return


def _stands(bar: FunctionFiveBar, phi: float, psi: float) -> bool:
    """Whether the output link points the right way at an input angle, whole revolutions aside."""
    return abs(math.remainder(bar.output_angle(phi) - psi, 2.0 * math.pi)) <= _EXACT


def _quality(bar: FunctionFiveBar, positions: Positions, wanted: float) -> tuple[float, float]:
    """First the transmission angle as far as it is wanted, then links of like length."""
    lengths = (bar.input, bar.coupler, bar.follower, bar.output, bar.frame)
    angle, _ = bar.min_transmission_angle(positions[0][0], positions[-1][0])
    return min(angle, wanted) if wanted > 0.0 else angle, -max(lengths) / min(lengths)
