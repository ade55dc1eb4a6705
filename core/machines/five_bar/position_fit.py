"""A geared five-bar whose output link stands at given angles at given input angles."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import amount
from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar, Positions
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.lm import State, descend
from gearlink.core.numerics.quasi_random import halton

MOST_POSITIONS = 5
_STARTS = 1500
_STEPS = 80
# Lengths are sought from 1/20 to 20 times the input link: beyond, a drawing would not show both.
_WIDEST = math.log(20.0)
_FARTHEST = 2.0 * _WIDEST
_SCATTER = 1.5
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
    found = [bar for candidate in _candidates(start, positions) for bar in _moving(candidate, positions)]
    if not found:
        raise NoSolution(
            f"no five-bar was found that meets the {len(positions)} positions in one unbroken motion",
            fix=(
                "omit one, bring them nearer to each other, or start from other links (coupler, "
                "follower, output, frame, phase)"
            ),
        )
    return max(found, key=lambda bar: _quality(bar, positions, transmission_angle))


def _require(positions: Positions) -> None:
    if not 2 <= len(positions) <= MOST_POSITIONS:
        raise NoSolution(
            f"{amount(len(positions), 'position')}",
            fix=f"give two to {MOST_POSITIONS}, as many as there are links to choose",
        )
    for (one, _), (other, _) in pairwise(positions):
        if not one < other:
            raise NoSolution(
                f"input angles must ascend: {math.degrees(other):g} deg follows {math.degrees(one):g} deg; sort them"
            )


def _starts(bar: FunctionFiveBar) -> Reals:
    """Rows of the unknowns ln(b/a), ln(c/a), ln(e/a), ln(d/a), t20: the start, and scattered ones about it."""
    first = [math.log(length / bar.input) for length in (bar.coupler, bar.follower, bar.output, bar.frame)]
    share = halton(1, _STARTS, 5)
    scattered = np.array(first) + _SCATTER * (2.0 * share[:, :4] - 1.0), bar.phase + 2.0 * math.pi * share[:, 4:]
    return np.concatenate(([[*first, bar.phase]], np.hstack(scattered)))


def _candidates(start: FunctionFiveBar, positions: Positions) -> Iterator[FunctionFiveBar]:
    """Five-bars that satisfy the equations of the positions, not yet known to move between them."""
    phi, psi = (np.array(column) for column in zip(*positions, strict=True))
    x = _starts(start)
    ratio = start.coupler_ratio
    x, (cost, *_), _, _ = descend(
        lambda x: _state(x, phi, psi, ratio), _step, x, _STEPS, slopes=_square, damping=1.0, least=0.0
    )
    close = (cost < _CLOSE) & np.all(np.abs(x[:, :4]) < _WIDEST, axis=1)
    seen: set[tuple[float, ...]] = set()
    for row in x[close]:
        row[4] = math.remainder(float(row[4]), 2.0 * math.pi)
        alike = tuple(np.round(row, 6).tolist())
        if alike in seen:
            continue
        seen.add(alike)
        b, c, e, d = (start.input * math.exp(float(v)) for v in row[:4])
        yield replace(start, coupler=b, follower=c, output=e, frame=d, phase=float(row[4]))


def _state(x: Reals, phi: Reals, psi: Reals, ratio: float) -> State:
    """Squares, |CD| - c at each position over the input link, for every row of unknowns, and its derivatives."""
    b, c, e, d = (np.exp(np.clip(x[:, i], -_FARTHEST, _FARTHEST))[:, None] for i in range(4))
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


def _step(x: Reals, state: State, damping: Reals) -> Reals:
    """Levenberg's step of minimum length for every row: -J^T (J J^T + damping)^-1 value."""
    cost, value, slopes, square, floor = state
    held = square + (damping * np.minimum(cost, 1.0) + floor)[:, None, None] * np.eye(value.shape[1])
    step: Reals = np.squeeze(np.swapaxes(slopes, 1, 2) @ np.linalg.solve(held, value[:, :, None]), axis=2)
    return x - np.clip(step, -0.5, 0.5)


def _moving(bar: FunctionFiveBar, positions: Positions) -> Iterator[FunctionFiveBar]:
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
