"""A function five-bar whose greatest error is made least, step by step, until its extremes are level."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar
from gearlink.core.machines.five_bar.wanted import Wanted, outputs
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.linear_program import least

_GRID = 121
WIDEST = math.log(20.0)
"""Logarithm of the greatest ratio of another link to the input link, or of this to the other."""
# Shares of the promised gain: below the first a step is corrected, above the others trust grows or stays.
_CORRECTED, _TRUSTED, _KEPT = 0.75, 0.5, 0.1
_LEAST_GAIN, _LEAST_TRUST = 1e-5, 1e-10
Slopes: TypeAlias = tuple[Reals, Reals]


class Levelling:
    """A five-bar on its way to the least greatest error over an interval.

    max_s |psi(phi0 + dphi s) - psi_wanted(s) - psi0| -> min over ln b, ln c, ln e, ln d, t20, phi0 and psi0

    Notes
        Each step solves a linear program on 121 places, within a region of trust that adapts. The errors bend, so the
        step of a program raises extremes that it thought level; it is then solved again with the errors at that step
        in place of what the slopes say of them. Without this correction steps along a curved valley shrink to nothing.
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
            wanted : Wanted
            limit : float - the greatest |cos mu| that is allowed, mu the transmission angle
        """
        s = 0.5 * (1.0 - np.cos(math.pi * np.linspace(0.0, 1.0, _GRID)))  # as dense at the ends as the extremes are
        self._first, self._limit = bar, limit
        self._target, self._swing = wanted.output(s), wanted.input_swing * s
        lengths = (bar.coupler, bar.follower, bar.output, bar.frame)
        self._x = np.array([*(math.log(length / bar.input) for length in lengths), bar.phase, start])
        self._miss, self._cosine = state(bar, start, self._swing, self._target)
        self.worst = self._worst(self._miss, self._cosine)
        self._slopes = slopes(bar, start, self._swing)
        self._trust, self._ended = 0.05, False

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
        """The greatest error, with the excess of cos mu as what must go first."""
        if not np.all(np.isfinite(miss)):
            return math.inf
        return float(np.abs(miss).max() + 10.0 * max(0.0, float(np.abs(cosine).max()) - self._limit))

    def _program(self, miss: Reals, cosine: Reals) -> Reals | None:
        """Step of the unknowns that makes the greatest error least, as far as its slopes tell."""
        outward, turns = self._slopes
        if not (np.all(np.isfinite(outward)) and np.all(np.isfinite(turns))):
            return None
        ones, trust = np.ones((miss.size, 1)), self._trust
        size = float(
            np.abs(miss).max()
        )  # psi0 and the error in this: the programs' tolerance is that of numbers about 1
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
        )
        return None if found is None else found[:6]


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


def slopes(bar: FunctionFiveBar, start: float, swing: Reals) -> Slopes:
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
