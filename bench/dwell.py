"""Dwell angle phi13 and frame length of the momentary dwell, for one design and for many."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, Row, measure, mpmath, numpy_pass, sample_of, worst
from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.momentary import momentary_frame_length
from gearlink.core.machines.three_gear.sweep import momentary_dwells
from gearlink.core.machines.three_gear.symmetric import dwell_angle
from gearlink.core.numerics.elementary_sweep import ARRAYS

Array = NDArray[np.float64]
SIZES = (1, 1000, 100_000)


def family(quick: bool) -> Family:
    """The table of the family."""
    rows: list[Row] = []
    for size in SIZES:
        rows += measure([*_dwell(size, quick), *_momentary(size, quick)], numpy_pass(size), size, 11)
    return Family(
        "dwell",
        "Dwell angle phi13 and frame of the instantaneous dwell",
        "ulp",
        "one numpy pass of sin + cos + arctan2 + sqrt over as many numbers",
        tuple(rows),
        ("i3 in -4 .. -0.5, phi12 in 17 .. 172 deg; cranks of 20 .. 30 mm",),
    )


def _dwell(size: int, quick: bool) -> list[Method]:
    rng = np.random.default_rng(3)
    i3, phi12 = -rng.uniform(0.5, 4.0, size), rng.uniform(0.3, 3.0, size)
    few = min(size, 100 if quick else 1000)
    pairs = list(zip(i3[:few].tolist(), phi12[:few].tolist(), strict=True))
    exact = {i: reference(float(i3[i]), float(phi12[i])) for i in sample_of(size)}
    early = {i: reference(*pairs[i]) for i in sample_of(few)}

    def method(name: str, run: Callable[[], Any], true: dict[int, Any], count: int) -> Method:
        found = np.asarray(run())
        return Method(name, count, run, worst((found[i] for i in true), true.values()))

    return [
        method(
            "phi13: bracketed Newton",
            lambda: 0.5 * phi12 + symmetric.regained(1.0 - i3, 0.5 * phi12, ARRAYS),
            exact,
            size,
        ),
        method("phi13: scalar", lambda: [dwell_angle(*pair) for pair in pairs], early, few),
        *(method(f"phi13: unbracketed Newton, {k} steps", _plain(i3, phi12, k), exact, size) for k in (3, 5, 8)),
        method("phi13: brentq loop", lambda: [brentq_phi13(*pair) for pair in pairs], early, few),
    ]


def _plain(i3: Array, phi12: Array, steps: int) -> Callable[[], Array]:
    def run() -> Array:
        n, h = 1.0 - i3, 0.5 * phi12
        k = 1.0 / np.sqrt(1.0 + (n * n - 1.0) * np.cos(h) ** 2)
        y, at_h = 2.0 * h, np.arcsin(k * np.sin(h))
        for _ in range(steps):
            x = k * np.sin(y)
            value = n * (np.arcsin(x) + at_h) - h - y
            y = y - value / (n * k * np.cos(y) / np.sqrt(1.0 - x * x) - 1.0)
        result: Array = h + y
        return result

    return run


def brentq_phi13(i3: float, phi12: float) -> float:
    """One dwell angle by scipy's brentq on the textbook form."""
    from scipy.optimize import brentq

    n, h = 1.0 - i3, 0.5 * phi12
    k = 1.0 / math.sqrt(1.0 + (n * n - 1.0) * math.cos(h) ** 2)
    at_h = math.asin(k * math.sin(h))

    def gain(y: float) -> float:
        return n * (math.asin(k * math.sin(y)) + at_h) - h - y

    most = 2.0 * math.pi * (1.0 - i3) / (2.0 - i3) - h
    root: float = brentq(gain, h * (1.0 + 1e-9), min(3.0 * h, most) * (1.0 + 1e-9))
    return h + root


def reference(i3: float, phi12: float) -> Any:
    """phi13 in 30 digits."""
    mp = mpmath(45)
    n, h = 1 - mp.mpf(i3), mp.mpf(phi12) / 2
    k = 1 / mp.sqrt(1 + (n * n - 1) * mp.cos(h) ** 2)
    near = mp.mpf(dwell_angle(i3, phi12)) - h

    def gain(y: Any) -> Any:
        return n * (mp.asin(k * mp.sin(y)) + mp.asin(k * mp.sin(h))) - h - y

    return h + mp.findroot(gain, (near * (1 - mp.mpf(10) ** -9), near * (1 + mp.mpf(10) ** -9)), tol=mp.mpf(10) ** -60)


def _momentary(size: int, quick: bool) -> list[Method]:
    rng = np.random.default_rng(4)
    r1 = rng.uniform(20.0, 30.0, size)
    r5, eccentricity = 3.0 * r1, 0.6 * r1
    designs = [(r, r, 3.0 * r, 0.6 * r) for r in r1[: min(size, 1000)].tolist()]
    searched = designs[: min(len(designs), 2 if quick else 5)]
    chosen = [designs[i] for i in sample_of(len(designs), 20)]

    def error(way: Callable[..., Any]) -> float:
        return worst((float(way(*design)) for design in chosen), (frame_reference(*design) for design in chosen))

    def sweep(*design: float) -> Any:
        return momentary_dwells(*design).frame

    methods = [
        Method("frame: closed form", size, lambda: momentary_dwells(r1, r1, r5, eccentricity), error(sweep)),
        Method("frame: scalar", len(designs), _loop(momentary_frame_length, designs), error(momentary_frame_length)),
    ]
    if size == 1:
        methods.append(
            Method("frame: nested search", len(searched), _loop(nested_search, searched), error(nested_search))
        )
    return methods


def _loop(way: Callable[..., float], designs: list[tuple[float, float, float, float]]) -> Callable[[], list[float]]:
    return lambda: [way(*design) for design in designs]


def nested_search(r1: float, r3: float, r5: float, eccentricity: float) -> float:
    """Frame length at which the least output speed of the turn is zero: a search over frames round one over angles."""
    from scipy.optimize import brentq, minimize_scalar

    from gearlink.core.machines.three_gear.train import GearTrain
    from gearlink.core.parts.linkages.fourbar import position as fourbar
    from gearlink.core.parts.linkages.fourbar.position import FourBar

    train = GearTrain(r1, r3, r5)
    b, c = r1 + r3, r3 + r5

    def least(frame: float) -> float:
        linkage = FourBar(eccentricity, b, c, frame)

        def speed(phi: float) -> float:
            state = fourbar.solve(linkage, phi, 1)
            return (
                train.ratio + train.coupler_share * state.coupler_velocity + train.rocker_share * state.rocker_velocity
            )

        start = min(range(72), key=lambda i: speed(math.radians(5.0 * i)))
        place = math.radians(5.0 * start)
        found = minimize_scalar(speed, bounds=(place - 0.1, place + 0.1), method="bounded", options={"xatol": 1e-10})
        return float(found.fun)

    near = momentary_frame_length(r1, r3, r5, eccentricity)
    root: float = brentq(least, 0.97 * near, 1.03 * near)
    return root


def frame_reference(r1: float, r3: float, r5: float, eccentricity: float) -> Any:
    """Frame length of the momentary dwell in 30 digits."""
    mp = mpmath(30)
    a, m, o, e = (mp.mpf(x) for x in (r1, r3, r5, eccentricity))
    b, s = a + m, a + 2 * m + o
    low = s * (a / (mp.sqrt(b * (b + o)) + mp.sqrt(m * (m + o)))) ** 2
    share = (a * a - e * e) / (a * a - low * low)
    return mp.sqrt((s - low) ** 2 * share + o * o * (1 - share))
