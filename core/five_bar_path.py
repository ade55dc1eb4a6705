"""Path of the coupler point of a geared five-bar over arrays of input angles, and its distance from given points."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.arrays import Points, Reals
from gearlink.core.extremes import Extreme, maximum_over, minimum_over
from gearlink.core.five_bar import GearedFiveBar

_PER_TURN = 720


@dataclass(frozen=True, slots=True)
class PathSweep:
    """The five-bar over input angles: coupler angle continuous from the first row, rates per input angle."""

    coupler_angle: Reals
    transmission_angle: Reals
    point: Points
    velocity: Points


def sweep(bar: GearedFiveBar, phi: Reals, offset: complex) -> PathSweep:
    """Coupler angle, transmission angle, coupler point and its velocity.

    w2 = Re[(B' - D') e^(-i t3)]/(b sin(t2 - t3)),   M' = B' + i w2 (M - B)

    Parameters
        bar : GearedFiveBar
        phi : (N,) array [rad] - ascending
        offset : complex [mm] - u + i v
    Returns
        sweep : PathSweep - angles [rad], point [mm], velocity [mm/rad]
    Raises
        NoSolution - where the five-bar opens anywhere in its period
    Example
        >>> from fractions import Fraction
        >>> bar = GearedFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))
        >>> point = sweep(bar, np.radians([60.0, 200.0]), 60.0 + 0j).point
        >>> [complex(round(m.real, 9), round(m.imag, 9)) for m in point]
        [(45.321887013+65.821686389j), (21.851649007+37.295106807j)]

    Source
        own derivation
    """
    bar.closure()
    start, end, u2, u3, gamma = _position(bar, phi)
    k = float(bar.ratio)
    speeds = 1j * start, 1j * k * (end - bar.frame)
    w2 = ((speeds[0] - speeds[1]) * np.conj(u3)).real / (bar.coupler * (u2 * np.conj(u3)).imag)
    point = start + offset * u2
    return PathSweep(_continuous(bar, phi), gamma, point, speeds[0] + 1j * w2 * offset * u2)


def points(bar: GearedFiveBar, phi: Reals, offset: complex) -> Points:
    """The coupler point alone [mm]; closure is not checked (NaN where the five-bar opens).

    Source
        own derivation
    """
    start, _, u2, _, _ = _position(bar, phi)
    result: Points = start + offset * u2
    return result


def _position(bar: GearedFiveBar, phi: Reals) -> tuple[Points, Points, Points, Points, Reals]:
    """B, D, unit vectors of coupler (B->C) and follower (D->C), transmission angle."""
    b, c = bar.coupler, bar.follower
    start = bar.input * np.exp(1j * phi)
    end = bar.frame + bar.output * np.exp(1j * (bar.phase + float(bar.ratio) * phi))
    way = end - start
    n = np.abs(way)
    with np.errstate(invalid="ignore", divide="ignore"):
        near, far = (n - b + c) * (n + b - c), (b + c - n) * (b + c + n)
        height = 0.5 * np.sqrt(near * far) / n
        along = 0.5 * (n + (b - c) * (b + c) / n)
        joint = start + way / n * (along + 1j * bar.assembly * height)
        gamma = 2.0 * np.arctan2(np.sqrt(near), np.sqrt(far))
    return start, end, (joint - start) / b, (joint - end) / c, gamma


def _continuous(bar: GearedFiveBar, phi: Reals) -> Reals:
    """Coupler angle without jumps: between rows the angle is followed in steps below a quarter turn.

    |w2| <= (|B'| + |D'|)/(b sin(gamma)) bounds the step, so that no winding is missed.
    """
    angle, _ = bar.min_transmission_angle()
    bound = (bar.input + abs(float(bar.ratio)) * bar.output) / (bar.coupler * math.sin(angle))
    widest = float(np.max(np.diff(phi), initial=0.0))
    parts = max(1, math.ceil(widest * bound / (0.5 * math.pi)))
    if phi.size < 2:
        return np.asarray(np.angle(_position(bar, phi)[2]))
    steps = np.arange(parts) / parts
    fine = np.append((phi[:-1, None] + np.diff(phi)[:, None] * steps).ravel(), phi[-1])
    return np.asarray(np.unwrap(np.angle(_position(bar, fine)[2]))[::parts])


def extent(bar: GearedFiveBar, offset: complex) -> tuple[Extreme, Extreme, Extreme, Extreme]:
    """Least and greatest x, least and greatest y of the path, refined, with their input angles.

    Raises
        NoSolution - where the five-bar opens
    Source
        own derivation
    """
    bar.closure()
    end, count = bar.period, 512 * bar.period_turns

    def part(direction: complex) -> tuple[Extreme, Extreme]:
        def along(phi: Reals) -> Reals:
            return np.asarray((points(bar, phi, offset) * np.conj(direction)).real)

        return minimum_over(along, 0.0, end, samples=count), maximum_over(along, 0.0, end, samples=count)

    return (*part(1.0 + 0j), *part(1j))


def distances(bar: GearedFiveBar, offset: complex, targets: Points) -> tuple[Reals, Reals]:
    """Distance of each point from the path, and the input angle of the path's nearest place.

    Parameters
        bar : GearedFiveBar
        offset : complex [mm] - u + i v
        targets : (N,) complex array [mm]
    Returns
        distance, phi : (N,) arrays [mm], [rad] in [0, period)
    Raises
        NoSolution - where the five-bar opens
    Notes
        Nearest of 720 places a turn, then golden section between its neighbours: the distance to rounding.
    Source
        own derivation
    """
    bar.closure()
    count = _PER_TURN * bar.period_turns
    grid = bar.period * np.arange(count) / count
    nearest = np.argmin(np.abs(points(bar, grid, offset)[None, :] - targets[:, None]), axis=1)
    step = bar.period / count
    low, high = grid[nearest] - step, grid[nearest] + step
    share = (math.sqrt(5.0) - 1.0) / 2.0
    for _ in range(60):
        p, q = high - share * (high - low), low + share * (high - low)
        closer = np.abs(points(bar, p, offset) - targets) <= np.abs(points(bar, q, offset) - targets)
        low, high = np.where(closer, low, p), np.where(closer, q, high)
    phi = 0.5 * (low + high)
    return np.abs(points(bar, phi, offset) - targets), phi % bar.period
