"""Least squares of many five-bars at once: paths drawn to given points, the transmission angle kept above its limit."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from gearlink.core.five_bar.family import UNKNOWNS, FiveBarFamily, near_places
from gearlink.core.numerics.arrays import Mask, Points, Reals

_DAMPING, _LEAST_DAMPING, _MOST_DAMPING = 1e-2, 1e-15, 1e8
_SOFTER, _HARDER = 0.3, 4.0
# Longest step of a logarithm, of the phase, and of an input angle [rad].
_REACH, _PHI_REACH = 0.5, 0.3
_MATCHED_EVERY = 10
_FOOT_STEPS = 3
# So many branches of a path that crosses itself are tried for each target.
_BRANCHES = 3
# So many steps in which no row gained end a descent.
_IDLE, _GAIN = 6, 1e-9
# How far the limit of the cosine is drawn in against the give of a penalty.
_MOST_SHIFT = 0.3
_SLOW = 1e-9


@dataclass(frozen=True, slots=True)
class PathProblem:
    """Points that the paths of a family shall meet.

    Parameters
        family : FiveBarFamily
        targets : (N,) complex array - about 1 apart
        low, high : (7,) arrays - bounds of the unknowns
        cosine : float - greatest |cos| of the transmission angle
        weight : float - of its excess, against distances
    """

    family: FiveBarFamily
    targets: Points
    low: Reals
    high: Reals
    cosine: float
    weight: float


@dataclass(frozen=True, slots=True)
class _State:
    """Misses (K, N), path velocities (K, N), slopes (K, N, 7), penalties (K, 8) with slopes (K, 8, 7), cost (K,)."""

    miss: Points
    velocity: Points
    slopes: Points
    penalty: Reals
    penalty_slopes: Reals
    cost: Reals

    def updated(self, other: _State, rows: Mask) -> _State:
        """This state with some rows taken from another."""
        mask = {ndim: rows.reshape(-1, *(1,) * (ndim - 1)) for ndim in (1, 2, 3)}
        pairs = [(getattr(self, name), getattr(other, name)) for name in self.__slots__]
        return _State(*(np.where(mask[old.ndim], new, old) for old, new in pairs))


def descend(problem: PathProblem, x: Reals, phi: Reals, steps: int) -> tuple[Reals, Reals, Reals]:
    """Rows of unknowns after so many Levenberg-Marquardt steps, each row with its own damping.

    sum |M(phi_j) - P_j|^2 + weight^2 sum max(0, |cos| - limit)^2 -> min over x and every phi_j

    Parameters
        x : (K, 7) array - starts; phi : (K, N) array [rad] - places of their paths for each target
        steps : int - at most; fewer once no row gains
    Returns
        x, phi : as given; cost : (K,) array - mean square of the distances and penalties; inf where the row opens
    Notes
        Each phi_j occurs in its own point alone and is eliminated: in the direction of the path a miss counts only as
        far as the damping holds phi_j. What is left are normal equations for seven unknowns. Every ten steps the
        targets are matched with the paths anew, and the limit is drawn in by what the penalty gave way (method of
        multipliers), so that it is met at a moderate weight.
    Source
        D. W. Marquardt, J. SIAM 11 (1963) 431-441; M. J. D. Powell, in: Optimization (1969) 283-298; own derivation
    """
    damping, idle = np.full(len(x), _DAMPING), 0
    limit = np.full((len(x), 2), problem.cosine)
    state = _state(problem, x, phi, limit)
    for i in range(steps):
        if i and i % _MATCHED_EVERY == 0:
            phi, limit = matched(problem, x, phi), _drawn_in(problem, x, limit)
            state, damping = _state(problem, x, phi, limit), np.minimum(damping, _DAMPING)
        dx, dphi = _step(problem, x, state, damping)
        new_x, new_phi = np.clip(x + dx, problem.low, problem.high), phi + dphi
        new = _state(problem, new_x, new_phi, limit)
        better = new.cost < state.cost
        idle = 0 if np.any(new.cost < (1.0 - _GAIN) * state.cost) else idle + 1
        if idle == _IDLE:
            break
        x, phi = np.where(better[:, None], new_x, x), np.where(better[:, None], new_phi, phi)
        state = state.updated(new, better)
        damping = np.clip(np.where(better, _SOFTER, _HARDER) * damping, _LEAST_DAMPING, _MOST_DAMPING)
    return x, phi, state.cost / phi.shape[1]


def matched(problem: PathProblem, x: Reals, phi: Reals | None = None) -> Reals:
    """Input angles of the places of each path nearest to each target.

    Parameters
        x : (K, 7) array
        phi : (K, N) array [rad] - places so far, kept where they are nearer
    Returns
        phi : (K, N) array [rad]
    Notes
        Of the three nearest branches on the grid, the feet of the perpendiculars in three steps of Gauss and Newton.
    """
    family = problem.family
    point, velocity = family.path(x, family.grid[None, :])
    tried = family.grid[near_places(point, velocity, family.step, problem.targets, _BRANCHES)]
    if phi is not None:
        tried = np.concatenate((tried, phi[..., None]), axis=2)
    feet, away = _feet(problem, x, tried)
    best = np.argmin(np.where(np.isfinite(away), away, np.inf), axis=2)
    return np.asarray(np.squeeze(np.take_along_axis(feet, best[..., None], axis=2), axis=2))


def _feet(problem: PathProblem, x: Reals, tried: Reals) -> tuple[Reals, Reals]:
    """Feet of the perpendiculars, sought within a step of the grid, and the distances; (K, N, tries) arrays."""
    targets = np.repeat(problem.targets, tried.shape[2])
    start = tried.reshape(len(x), -1)
    phi, step = start, problem.family.step
    for _ in range(_FOOT_STEPS):
        point, velocity = problem.family.path(x, phi)
        along = (np.conj(velocity) * (point - targets)).real / np.maximum(np.abs(velocity) ** 2, _SLOW**2)
        phi = np.clip(phi - np.nan_to_num(along), start - step, start + step)
    away = np.abs(problem.family.path(x, phi)[0] - targets)
    return phi.reshape(tried.shape), away.reshape(tried.shape)


def _state(problem: PathProblem, x: Reals, phi: Reals, limit: Reals) -> _State:
    found = problem.family.path_slopes(x, phi)
    cosine, slopes = problem.family.cosines(x)
    excess = cosine - np.repeat(limit, cosine.shape[1] // 2, axis=1)
    on, miss = excess > 0.0, found.point - problem.targets
    penalty = problem.weight * np.where(on, excess, 0.0)
    slopes = problem.weight * np.where(on[..., None], slopes, 0.0)
    cost = np.sum(miss.real**2 + miss.imag**2, axis=1) + np.sum(penalty**2, axis=1)
    return _State(miss, found.velocity, found.slopes, penalty, slopes, np.where(np.isfinite(cost), cost, np.inf))


def _drawn_in(problem: PathProblem, x: Reals, limit: Reals) -> Reals:
    """The limits at the least and the greatest span, lowered by the excess there, raised where there is room."""
    cosine = problem.family.cosines(x)[0].reshape(len(x), 2, -1).max(axis=2)
    shift = np.clip(limit - cosine, -_MOST_SHIFT, 0.0)
    return np.asarray(problem.cosine + np.where(np.isfinite(shift), shift, 0.0))


def _step(problem: PathProblem, x: Reals, state: _State, damping: Reals) -> tuple[Reals, Reals]:
    """Steps of the unknowns and of the input angles."""
    speed = np.maximum(np.abs(state.velocity), _SLOW)
    back = np.conj(np.where(np.abs(state.velocity) > _SLOW, state.velocity / speed, 1.0))
    slopes, miss = state.slopes * back[..., None], state.miss * back
    held = np.sqrt(damping / (1.0 + damping))[:, None]
    rows = np.concatenate((slopes.imag, held[..., None] * slopes.real, state.penalty_slopes), axis=1)
    value = np.concatenate((miss.imag, held * miss.real, state.penalty), axis=1)
    dx = _solved(problem, x, rows, value, damping)
    left = miss.real + np.squeeze(slopes.real @ dx[..., None], axis=2)
    return dx, np.clip(-left / (speed * (1.0 + damping[:, None])), -_PHI_REACH, _PHI_REACH)


def _solved(problem: PathProblem, x: Reals, rows: Reals, value: Reals, damping: Reals) -> Reals:
    """Damped least squares for seven unknowns; one that stands at its bound and is pushed outward stays there."""
    across = np.swapaxes(rows, 1, 2)
    square, slope = across @ rows, np.squeeze(across @ value[..., None], axis=2)
    free = ~((x <= problem.low) & (slope > 0.0) | (x >= problem.high) & (slope < 0.0))
    square = square * free[:, :, None] * free[:, None, :]
    size = np.einsum("kii->ki", square)
    floor = 1e-14 * size.sum(axis=1, keepdims=True) + 1e-300
    added = damping[:, None] * (size + 1e-3 * size.max(axis=1, keepdims=True)) + floor
    square[:, range(UNKNOWNS), range(UNKNOWNS)] += added
    step = -np.squeeze(np.linalg.solve(square, (free * slope)[..., None]), axis=2)
    longest = np.max(np.abs(step[:, :5]), axis=1, keepdims=True)
    return np.asarray(step * np.minimum(1.0, _REACH / np.maximum(longest, 1e-300)))


def thinned(problem: PathProblem, most: int) -> PathProblem:
    """The same with at most so many of the targets, evenly taken from their row."""
    count = problem.targets.size
    if count <= most:
        return problem
    return replace(problem, targets=problem.targets[np.linspace(0, count - 1, most).round().astype(int)])
