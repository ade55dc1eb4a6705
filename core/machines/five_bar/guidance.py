"""Guidance of a body by a geared five-bar: links whose coupler takes a body through poses.

Pose j has a point M_j and an angle alpha_j of a body that is fixed to the coupler BC, with B and C at w_B, w_C of it:

    |M_j + w_B e^(i alpha_j) - A| = a,   |M_j + w_C e^(i alpha_j) - D_j| = c,
    D_j = E + e e^(i (psi + phase + k phi_j)),   phi_j = arg(M_j + w_B e^(i alpha_j) - A) - psi

psi the direction of the frame AE. Three poses with a fixed frame are met in closed form: seen from the body A and D
lie on circles about B and C. Others are met by least squares from many starts.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.arrays import Points, Reals

TURN = 2.0 * math.pi
KEEPS = ("links.input", "links.follower", "links.output", "phase")
_ANGLES, _ARMS = 48, 25
_STARTS, _SEED, _ENOUGH = 40, 20261126, 3
_MET = 1e-7
_COLLINEAR = 1e-12


@dataclass(frozen=True)
class Task:
    """What is asked for.

    Fields
        places, angles : (n,) arrays [mm, rad] - M_j, alpha_j
        start : PathFiveBar - of the file; its frame and ratio count, and the links that are kept
        keep : keys of the file that stay
        free : bool - the frame may lie anywhere
        least : float [rad] - minimum transmission angle
    """

    places: Points
    angles: Reals
    start: PathFiveBar
    keep: frozenset[str]
    free: bool
    least: float


@dataclass(frozen=True)
class Guidance:
    """Links that were found.

    Fields
        body, joint : complex [mm] - w_B, w_C in coordinates of the body
        place : complex [mm] - of A, 0 with a fixed frame
        direction : float [rad] - of the frame
    """

    task: Task
    bar: PathFiveBar
    body: complex
    joint: complex
    place: complex = 0j
    direction: float = 0.0

    @property
    def body_angle(self) -> float:
        """Direction of BC less the body's angle [rad]."""
        return cmath.phase(self.joint - self.body)

    @property
    def offset(self) -> complex:
        """The body's point on the coupler, u + i v [mm]."""
        return -self.body * cmath.exp(-1j * self.body_angle)

    @cached_property
    def inputs(self) -> Reals:
        """Input angle of each pose [rad], rising in their order where they can, else falling."""
        pins = self.task.places + self.body * np.exp(1j * self.task.angles) - self.place
        return in_order(np.angle(pins) - self.direction)

    @cached_property
    def assemblies(self) -> list[int]:
        """Side of C from B to D in each pose."""
        turned = np.exp(1j * self.task.angles)
        pins, joints = (self.task.places + arm * turned for arm in (self.body, self.joint))
        ends = self.place + cmath.exp(1j * self.direction) * np.array([self.bar.ends(float(x))[1] for x in self.inputs])
        sides = (np.conj(ends - pins) * (joints - pins)).imag
        return [1 if side >= 0.0 else -1 for side in sides]

    @cached_property
    def reached(self) -> tuple[Points, Reals]:
        """Place of the point and angle of the body at each input angle [mm, rad]."""
        places, angles = [], []
        for phi in self.inputs:
            angles.append(self.bar.coupler_angle(float(phi)) + self.direction - self.body_angle)
            places.append(self.place + cmath.exp(1j * self.direction) * self.bar.point(float(phi), self.offset))
        return np.array(places), np.array(angles)

    @property
    def position_errors(self) -> Reals:
        """Distance of the point from each pose [mm]."""
        return np.abs(self.reached[0] - self.task.places)

    @property
    def angle_errors(self) -> Reals:
        """Angle by which the body misses each pose [rad], within half a revolution."""
        missed = self.reached[1] - self.task.angles
        return np.asarray(np.abs(np.angle(np.exp(1j * missed))))

    @property
    def in_order(self) -> bool:
        """Whether the input angles rise, or fall, in the order of the poses."""
        return is_ordered(self.inputs)

    @property
    def quality(self) -> tuple[bool, bool, bool, bool, float]:
        """Closes over the revolution, one assembly, poses in order, transmission angle held; then that angle [rad]."""
        try:
            least = self.bar.min_transmission_angle()[0]
        except NoSolution:
            least = -1.0
        return least > 0.0, len(set(self.assemblies)) == 1, self.in_order, least >= self.task.least, least


def in_order(angles: Reals) -> Reals:
    """Angles counted on so that they rise in their order within a revolution; where they do not, so that they fall.

    Example
        >>> np.degrees(in_order(np.radians([350.0, 10.0, 90.0]))).round(9).tolist()
        [350.0, 370.0, 450.0]
        >>> np.degrees(in_order(np.radians([10.0, 350.0, 300.0]))).round(9).tolist()
        [10.0, -10.0, -60.0]
    """
    steps = np.diff(angles)
    up = np.mod(steps, TURN)
    if float(np.sum(up)) < TURN or float(np.sum(TURN - up)) >= TURN:
        return np.asarray(angles[0] + np.concatenate([[0.0], np.cumsum(up)]))
    return np.asarray(angles[0] - np.concatenate([[0.0], np.cumsum(TURN - up)]))


def is_ordered(angles: Reals) -> bool:
    """Whether angles that were counted on lie within a revolution."""
    return bool(abs(angles[-1] - angles[0]) < TURN)


def circumcenter(points: Sequence[complex] | Points) -> complex:
    """Centre of the circle through three points.

    w = (p_3 - p_1)/(p_2 - p_1),  centre = p_1 + (p_2 - p_1)(w - |w|^2)/(2 i Im w)

    Raises
        NoSolution - for points on a line
    Example
        >>> abs(circumcenter([1.0 + 0j, 1j, -1.0 + 0j])) < 1e-15
        True
    """
    first, second, third = (complex(each) for each in points)
    if first == second:
        raise NoSolution(
            "two of the three poses have the pivot at one position: they have no common centre of rotation"
        )
    w = (third - first) / (second - first)
    if abs(w.imag) <= _COLLINEAR * max(1.0, abs(w)):
        raise NoSolution(
            "the three poses have no common centre of rotation: relative to the body the pivot moves along a line"
        )
    return first + (second - first) * (w - abs(w) ** 2) / (2j * w.imag)


def guide(task: Task) -> Guidance:
    """The links that take a body through poses.

    Raises
        NoSolution - where there are none
    """
    exact = not task.free and task.places.size == 3 and not task.keep & {"links.input", "links.follower"}
    found = list(_three(task) if exact else _searched(task))
    if not found:
        raise NoSolution(
            "no five-bar goes through these poses\nchange target.poses, or list fewer links in target.keep"
        )
    return max(found, key=lambda each: each.quality)


# Three poses, the frame fixed


def _three(task: Task) -> Iterator[Guidance]:
    """In closed form, over the output link and the phase where they are not kept."""
    seen = -task.places * np.exp(-1j * task.angles)
    body = circumcenter(seen)
    arm = abs(complex(seen[0]) - body)
    phi = in_order(np.angle(task.places + body * np.exp(1j * task.angles)))
    lengths, phases = _grid(task)
    best: list[Guidance] = []
    for length in lengths:
        for phase in phases:
            made = _closed(task, body, arm, phi, float(length), float(phase))
            if made is not None:
                best.append(made)
    if len(lengths) * len(phases) == 1 or not best:
        yield from best
        return
    best = sorted(best, key=lambda each: each.quality, reverse=True)[:1]
    yield best[0]
    yield from _refined(task, best[0], body, arm, phi)


def _grid(task: Task) -> tuple[Reals, Reals]:
    start = task.start
    lengths = np.array([start.output]) if "links.output" in task.keep else np.geomspace(0.2, 5.0, _ARMS) * start.output
    phases = np.array([start.phase]) if "phase" in task.keep else TURN * np.arange(_ANGLES) / _ANGLES
    return lengths, phases


def _refined(task: Task, best: Guidance, body: complex, arm: float, phi: Reals) -> Iterator[Guidance]:
    """Nearer and nearer about the best of the grid."""
    width = np.array([0.0 if "links.output" in task.keep else 0.07, 0.0 if "phase" in task.keep else TURN / _ANGLES])
    for _ in range(12):
        around = [
            _closed(task, body, arm, phi, best.bar.output * (1.0 + x * width[0]), best.bar.phase + y * width[1])
            for x in (-1.0, 0.0, 1.0)
            for y in (-1.0, 0.0, 1.0)
        ]
        better = max((each for each in around if each is not None), key=lambda each: each.quality, default=best)
        width = 0.6 * width if better.quality <= best.quality else width
        best = max(best, better, key=lambda each: each.quality)
        yield best


def _closed(task: Task, body: complex, arm: float, phi: Reals, length: float, phase: float) -> Guidance | None:
    """The five-bar of an output link and a phase; None where C would lie in line."""
    start = task.start
    ends = start.frame + length * np.exp(1j * (phase + float(start.ratio) * phi))
    seen = (ends - task.places) * np.exp(-1j * task.angles)
    try:
        joint = circumcenter(seen)
    except NoSolution:
        return None
    follower = abs(complex(seen[0]) - joint)
    return _made(task, body, joint, arm, follower, length, phase)


def _made(
    task: Task,
    body: complex,
    joint: complex,
    arm: float,
    follower: float,
    output: float,
    phase: float,
    place: complex = 0j,
    direction: float = 0.0,
) -> Guidance | None:
    start, body, joint = task.start, complex(body), complex(joint)
    coupler, arm, follower, output, phase = abs(joint - body), *(float(each) for each in (arm, follower, output, phase))
    if min(coupler, arm, follower, output) <= 1e-9 * start.frame:
        return None
    bar = PathFiveBar(arm, coupler, follower, output, start.frame, start.ratio, math.remainder(phase, TURN), 1)
    found = Guidance(task, bar, body, joint, place, direction)
    return replace(found, bar=replace(bar, assembly=-1)) if sum(found.assemblies) < 0 else found


# Any number of poses, by least squares


def _searched(task: Task) -> Iterator[Guidance]:
    """From many starts about the file's own links; the nearest, or all that meet the poses."""
    from scipy.optimize import least_squares

    unknowns = _Unknowns(task)
    starts = np.random.default_rng(_SEED).random((_STARTS, unknowns.size))
    results: list[tuple[float, Guidance]] = []
    good = 0
    for row in starts:
        solved: Any = least_squares(unknowns.residuals, unknowns.start(row), method="trf", x_scale="jac", max_nfev=80)
        made = unknowns.made(solved.x)
        if made is None:
            continue
        results.append((float(np.max(np.abs(solved.fun))), made))
        good += results[-1][0] <= _MET * task.start.frame and all(made.quality[:4])
        if good >= _ENOUGH:
            break
    if not results:
        return
    nearest = min(size for size, _ in results)
    limit = max(_MET * task.start.frame, 1.0001 * nearest)
    yield from (made for size, made in results if size <= limit)


class _Unknowns:
    """What is free: w_B, w_C, then the lengths, the phase and the frame that are not kept."""

    def __init__(self, task: Task) -> None:
        self.task = task
        start = task.start
        self.fixed = {"a": start.input, "c": start.follower, "e": start.output, "phase": start.phase}
        kept = dict(zip(("a", "c", "e", "phase"), KEEPS, strict=True))
        self.names = [name for name, key in kept.items() if key not in task.keep]
        if task.free:
            self.names += ["x", "y", "psi"]
        self.scale = float(np.max(np.abs(task.places - np.mean(task.places)))) + start.frame

    @property
    def size(self) -> int:
        """How many numbers."""
        return 4 + len(self.names)

    def start(self, row: Reals) -> Reals:
        """Values of a start, from a point of the unit cube."""
        spread = 2.0 * row - 1.0
        values = [*(self.scale * spread[:4])]
        middle = complex(np.mean(self.task.places))
        for name, share in zip(self.names, spread[4:], strict=True):
            if name in ("phase", "psi"):
                values.append(math.pi * share)
            elif name in ("x", "y"):
                values.append((middle.real if name == "x" else middle.imag) + self.scale * share)
            else:
                values.append(self.fixed[name] * 2.0**share)
        return np.array(values)

    def _read(self, x: Reals) -> tuple[complex, complex, dict[str, float]]:
        given = self.fixed | dict(zip(self.names, (float(each) for each in x[4:]), strict=True))
        return complex(x[0], x[1]), complex(x[2], x[3]), given

    def residuals(self, x: Reals) -> Reals:
        """How far both circles are missed at each pose [mm]."""
        body, joint, v = self._read(x)
        place, psi = complex(v.get("x", 0.0), v.get("y", 0.0)), v.get("psi", 0.0)
        turned = np.exp(1j * self.task.angles)
        pins = self.task.places + body * turned - place
        phi = in_order(np.angle(pins) - psi)
        start = self.task.start
        ends = start.frame + v["e"] * np.exp(1j * (v["phase"] + float(start.ratio) * phi))
        joints = (self.task.places + joint * turned - place) * cmath.exp(-1j * psi)
        return np.concatenate([np.abs(pins) - v["a"], np.abs(joints - ends) - v["c"]])

    def made(self, x: Reals) -> Guidance | None:
        """The five-bar of a solution."""
        body, joint, v = self._read(x)
        if min(v["a"], v["c"], v["e"]) <= 0.0:
            return None
        place, psi = complex(v.get("x", 0.0), v.get("y", 0.0)), v.get("psi", 0.0)
        return _made(self.task, body, joint, v["a"], v["c"], v["e"], v["phase"], place, math.remainder(psi, TURN))
