"""Machines: torque of many members on one shaft, and their free phases, against formulas and programmes by hand."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from itertools import count
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, measure, mpmath, numpy_pass, sample_of
from gearlink.core.machines.machine.timing import Tie, solve

Array = NDArray[np.float64]
ROWS, MEMBERS = 360, 10
SPEED, STROKE, ROD, MASS = 180.0, 60.0, 90.0, 4.0
"""Speed [1/min]; stroke and rod [mm], mass of the slider [kg] of each member."""
RIGHT = 0.5 * math.pi
"""Crank angle from the slide line at input 0 [rad]."""
STEPS = (1e-1, 1e-2, 1e-3)
NAMES = tuple(f"m{i}" for i in range(12))
DIAL, MARGIN = 360.0, 72.5
"""Of the phases [deg]: the margin is half of what the narrowest span leaves, (150 - 5)/2."""


def family(quick: bool) -> Family:
    """The table of the family."""
    methods = [*_torques(), *_phases(quick)]
    return Family(
        "machines",
        "Machines: torque of 10 slider-cranks on one shaft at 360 positions, and 12 free phases",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {ROWS} numbers",
        measure(methods, numpy_pass(ROWS), 1, 5 if quick else 9),
        (
            "torque: members at ratios of 1, -1 and 2 with phases of their own; error over the largest torque",
            "textbook crank: the slider's motion by its first two harmonics",
            "phases: the largest minimum margin of 22 relations, which is 72.5 deg; angles are on a dial, so that "
            "milp seeks a whole number of turns for each relation",
        ),
    )


# Torque


def data() -> dict[str, Any]:
    """The file."""
    loads = {"links": {"slider": {"mass": MASS}}}
    crank = {"kind": "slider-crank", "stroke": STROKE, "rod": ROD, "loads": loads}
    members = {f"m{i}": {"phase": phase, "ratio": ratio, "design": crank} for i, (phase, ratio) in enumerate(_places())}
    return {"kind": "machine", "name": "row", "speed": SPEED, "members": members}


def _places() -> list[tuple[float, float]]:
    """Phase [deg] and ratio of each member."""
    return [(23.0 * i, (1.0, -1.0, 2.0)[i % 3]) for i in range(MEMBERS)]


def _torques() -> list[Method]:
    from gearlink.cli.opening import design

    theta = np.linspace(0.0, 2.0 * math.pi, ROWS, endpoint=False)
    made = design("loads", **data()).machine
    true = {i: reference(float(theta[i])) for i in sample_of(ROWS, 24)}
    most = max(map(abs, true.values()))
    runs = count()

    def elsewhere() -> Array:  # what is kept for the positions of the run before is of no use
        return np.asarray(replace(made).torque(theta + 1e-6 * next(runs)))

    ways: list[tuple[str, Callable[[], Array]]] = [
        ("torque of the machine", elsewhere),
        *((f"textbook differences of the motion, step {h:g}", partial(by_differences, theta, h)) for h in STEPS),
        ("textbook crank with two harmonics", partial(by_harmonics, theta)),
    ]

    def error(found: Array) -> float:
        return float(max(abs(float(found[i]) - each) for i, each in true.items()) / most)

    methods = [Method(name, 1, run, error(run())) for name, run in ways]
    return [
        *methods,
        Method("the same from the file's data", 1, lambda: design("loads", **data()).machine.torque(theta)),
    ]


def _summed(theta: Array, rates: Callable[[Array], tuple[Array, Array]]) -> Array:
    """Sum of m i^3 y' y'' W^2 of the sliders [N m]."""
    total, speed = np.zeros_like(theta), SPEED * math.pi / 30.0
    for phase, ratio in _places():
        first, second = rates(ratio * (theta - math.radians(phase)) + RIGHT)
        total += 1e-6 * MASS * speed**2 * ratio**3 * first * second
    return total


def by_differences(theta: Array, step: float) -> Array:
    """Rates of the slider by central differences of its place."""

    def place(u: Array) -> Array:
        return np.asarray(0.5 * STROKE * np.cos(u) + np.sqrt(ROD**2 - (0.5 * STROKE * np.sin(u)) ** 2))

    def rates(u: Array) -> tuple[Array, Array]:
        before, here, after = (place(u + h) for h in (-step, 0.0, step))
        return (after - before) / (2.0 * step), (after - 2.0 * here + before) / step**2

    return _summed(theta, rates)


def by_harmonics(theta: Array) -> Array:
    """y = r (cos u + r/(4 l) cos 2u)."""
    crank = 0.5 * STROKE

    def rates(u: Array) -> tuple[Array, Array]:
        first = -crank * (np.sin(u) + crank / (2.0 * ROD) * np.sin(2.0 * u))
        return first, -crank * (np.cos(u) + crank / ROD * np.cos(2.0 * u))

    return _summed(theta, rates)


def reference(theta: float) -> Any:
    """The torque in 40 digits [N m]."""
    mp = mpmath(40)
    crank, rod = mp.mpf(STROKE) / 2, mp.mpf(ROD)
    total, speed = mp.mpf(0), mp.mpf(SPEED) * mp.pi / 30

    def place(u: Any) -> Any:
        return crank * mp.cos(u) + mp.sqrt(rod**2 - (crank * mp.sin(u)) ** 2)

    for phase, ratio in _places():
        u = mp.mpf(ratio) * (mp.mpf(theta) - mp.radians(mp.mpf(phase))) + mp.pi / 2
        total += mp.mpf(MASS) / 10**6 * speed**2 * ratio**3 * mp.diff(place, u) * mp.diff(place, u, 2)
    return total


# Phases


def ties() -> list[Tie]:
    """A ring of 12 members, spans over three of them, and one that stands fast."""
    ring = [Tie(NAMES[i], NAMES[(i + 1) % 12], 10.0, 2.0, math.inf, f"ring {i}") for i in range(12)]
    spans = [Tie(NAMES[i], NAMES[i + 3], 0.0, 5.0, 150.0, f"span {i}") for i in range(9)]
    return [*ring, *spans, Tie("", NAMES[0], 0.0, 0.0, math.inf, "first")]


def margin(phases: Array) -> Any:
    """Minimum margin of phases by the definition; (12,) or (12, N)."""
    found = []
    for tie in ties():
        one, two = (phases[NAMES.index(name)] if name else 0.0 for name in (tie.one, tie.two))
        x = two - one + tie.offset
        x = x - DIAL * np.ceil(x / DIAL - 0.5)
        found += [x - tie.least, tie.most - x]
    return np.min(found, axis=0)


def _phases(quick: bool) -> list[Method]:
    asked = ties()

    def of_solve() -> Array:
        found = solve(NAMES, asked, DIAL).phases
        return np.array([found[name] for name in NAMES])

    ways: list[tuple[str, Callable[[], Array]]] = [("phases: tightest circle of relations", of_solve)]
    if not quick:
        ways += [("scipy milp", by_milp), ("scipy differential_evolution", by_evolution)]
    return [Method(name, 1, run, abs(float(margin(run())) / MARGIN - 1.0)) for name, run in ways]


def by_milp() -> Array:
    """The phases by a programme with whole turns: x = two - one + offset + 360 k in [-180, 180]."""
    from scipy.optimize import Bounds, LinearConstraint, milp

    asked = ties()
    size, most = len(NAMES), 0.5 * DIAL
    rows, low, high = [], [], []
    for i, tie in enumerate(asked):
        row = np.zeros(size + len(asked) + 1)
        for name, sign in ((tie.one, -1.0), (tie.two, 1.0)):
            if name:
                row[NAMES.index(name)] = sign
        row[size + i] = DIAL
        for sign, limit in ((-1.0, tie.least), (1.0, tie.most)):  # x - t >= least, x + t <= most
            if math.isfinite(limit):
                bound = row.copy()
                bound[-1] = sign
                rows.append(bound)
                low.append(limit - tie.offset if sign < 0.0 else -np.inf)
                high.append(np.inf if sign < 0.0 else limit - tie.offset)
        rows.append(row)
        low.append(1e-6 - most - tie.offset)
        high.append(most - 1e-6 - tie.offset)
    cost = np.zeros(size + len(asked) + 1)
    cost[-1] = -1.0
    whole = np.concatenate([np.zeros(size), np.ones(len(asked)), [0.0]])
    turns = np.full(len(asked), 3.0)
    bounds = Bounds(
        np.concatenate([np.zeros(size), -turns, [-most]]), np.concatenate([np.full(size, DIAL), turns, [most]])
    )
    done = milp(cost, constraints=LinearConstraint(np.array(rows), low, high), integrality=whole, bounds=bounds)
    return np.asarray(done.x[:size])


def by_evolution() -> Array:
    """The phases by a random search that knows nothing of relations."""
    from scipy.optimize import differential_evolution

    done = differential_evolution(
        lambda x: -margin(x),
        [(0.0, DIAL)] * len(NAMES),
        maxiter=100,
        polish=False,
        vectorized=True,
        updating="deferred",
        seed=5,
    )
    return np.asarray(done.x)
