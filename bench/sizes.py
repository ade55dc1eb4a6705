"""Sizes that are sought: the minimum disc cam for its limits, and the crank-rocker of the best transmission angle."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, measure, mpmath, numpy_pass
from gearlink.core.machines.crank_rocker.synthesis import best_ratios, best_start, generated, half_angles
from gearlink.core.machines.disc_cam.cams import FollowerCams
from gearlink.core.machines.disc_cam.spec import DiscCamSpec
from gearlink.core.parts.cams.follower_motion import FollowerMotion
from gearlink.core.parts.linkages.functions import Wanted

Array = NDArray[np.float64]
TURN = 2.0 * math.pi
PASS = 360
LIFT, RISE, RETURN = 30.0, (0.0, 90.0), (150.0, 270.0)
"""A lift of 30 mm [mm], cam angles of its rise and return [deg]."""
LIMIT, RADIUS = 30.0, 60.0
"""Limits: pressure angle [deg]; curvature radius of the pitch curve [mm], which is what counts at 60 deg."""
STEPS = (4.0, 1.0, 0.25)
"""Of a scan [deg of the cam, mm of the offset]."""


# The minimum disc cam


def cams(quick: bool) -> Family:
    """The table of the disc cams."""
    methods = [*_offsets(quick), *_curvatures(quick)]
    return Family(
        "cam-size",
        "Minimum disc cam: prime radius for a pressure angle with the best offset, and for a curvature radius",
        "mm",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {PASS} numbers",
        measure(methods, numpy_pass(PASS), 1, 5 if quick else 9),
        (
            "lift 30 mm by polynomial 3-4-5 in 90 deg, back in 120; limits 30 deg, or 60 mm without an offset",
            "gearlink: from the validated spec to the prime radius, both limits looked at; error against 40 digits",
            "textbook scan: every offset at every cam angle, by equal steps of mm and deg",
            "scipy: bounded search over the offset (brentq over the radius) round the scan of all cam angles",
        ),
    )


@cache
def spec_of(size: float | None) -> DiscCamSpec:
    """The cam for the pressure angle, or with no offset for a curvature radius [mm]."""
    motion = [
        {"to": RISE[1], "lift": LIFT, "law": "polynomial-345"},
        {"to": RETURN[0]},
        {"to": RETURN[1], "lift": 0, "law": "polynomial-345"},
        {"to": 360},
    ]
    follower = {"type": "translating-roller", "roller_radius": 8.0, "offset": "best" if size is None else 0.0}
    asked = {"pressure_angle": LIMIT} if size is None else {"pressure_angle": 60.0, "curvature_radius": size}
    data = {"kind": "disc-cam", "name": "cam", "motion": motion, "follower": follower, "cam": {"size": asked}}
    return DiscCamSpec.model_validate(data)


def prime_radius(size: float | None) -> float:
    """By gearlink [mm]."""
    return FollowerCams(spec_of(size)).place.radius


@cache
def motion() -> FollowerMotion:
    """The lift over the cam angle."""
    return FollowerCams(spec_of(None)).motion


def _offsets(quick: bool) -> list[Method]:
    true = offset_reference()
    ways: list[tuple[str, Callable[[], float]]] = [
        ("best offset: corner of the exact limits", partial(prime_radius, None)),
        *((f"textbook scan of offsets, step {h:g}", partial(by_scan, h)) for h in (STEPS[:2] if quick else STEPS)),
        *((f"scipy over the offset, step {h:g}", partial(by_minimize, h)) for h in (STEPS[:2] if quick else STEPS)),
    ]
    return [Method(name, 1, run, float(abs(run() - true))) for name, run in ways]


def _lifts(step: float) -> tuple[Array, Array]:
    """s and s' at equal steps of the cam angle."""
    phi = np.radians(np.arange(0.0, 360.0, step))
    s, s1 = motion().evaluate(phi, 1)
    return s, s1


def by_scan(step: float) -> float:
    """The least of all offsets, each with the height that every cam angle asks for."""
    (s, s1), slope = _lifts(step), math.tan(math.radians(LIMIT))
    offsets = np.arange(-2.0 * LIFT, 2.0 * LIFT, step)
    heights = (np.abs(s1 - offsets[:, None]) / slope - s).max(axis=1)
    return float(np.hypot(offsets, heights).min())


def by_minimize(step: float) -> float:
    """The same with the offset by scipy's bounded search."""
    from scipy.optimize import minimize_scalar

    (s, s1), slope = _lifts(step), math.tan(math.radians(LIMIT))

    def radius(offset: float) -> float:
        return math.hypot(offset, float((np.abs(s1 - offset) / slope - s).max()))

    found = minimize_scalar(radius, bounds=(-2.0 * LIFT, 2.0 * LIFT), method="bounded", options={"xatol": 1e-12})
    return float(found.fun)


def _rise(x: Any) -> Any:
    return LIFT * x**3 * (10 - 15 * x + 6 * x**2)


def _steepest(width: float) -> Any:
    """max (s'/tan alpha - s) of a rise over a width [deg], in 40 digits; a return asks for the same, mirrored."""
    mp = mpmath(40)
    slope, wide = mp.tan(mp.radians(mp.mpf(LIMIT))), mp.radians(mp.mpf(width))

    def asked(x: Any) -> Any:
        return mp.diff(_rise, x) / wide / slope - _rise(x)

    return asked(mp.findroot(lambda x: mp.diff(asked, x), 0.4))


def offset_reference() -> Any:
    """The corner of y0 >= A - e/T and y0 >= B + e/T in 40 digits."""
    mp = mpmath(40)
    one, other = (_steepest(end - start) for start, end in (RISE, RETURN))
    offset = (one - other) * mp.tan(mp.radians(mp.mpf(LIMIT))) / 2
    return mp.hypot(offset, (one + other) / 2)


def _curvatures(quick: bool) -> list[Method]:
    true = curvature_reference()
    ways: list[tuple[str, Callable[[], float]]] = [
        ("curvature radius: largest root at each cam angle", partial(prime_radius, RADIUS)),
        *((f"scipy brentq of the least radius, step {h:g}", partial(by_brentq, h)) for h in STEPS[: 2 if quick else 3]),
    ]
    return [Method(name, 1, run, float(abs(run() - true))) for name, run in ways]


def by_brentq(step: float) -> float:
    """The start height at which the least convex radius of all cam angles is the limit."""
    from scipy.optimize import brentq

    phi = np.radians(np.arange(0.0, 360.0, step))
    s, s1, s2 = motion().evaluate(phi, 2)

    def room(height: float) -> float:
        y = height + s
        curvature = (y * y + 2.0 * s1 * s1 - y * s2) / (y * y + s1 * s1) ** 1.5
        return 1.0 / float(curvature.max()) - RADIUS

    found: float = brentq(room, 0.5 * RADIUS, 4.0 * RADIUS, xtol=1e-12)
    return found


def curvature_reference() -> Any:
    """The start height in 40 digits: of the cam angle at which the least radius is the limit."""
    mp = mpmath(40)
    wide = mp.radians(mp.mpf(RISE[1] - RISE[0]))

    def radius(x: Any, height: Any) -> Any:
        s, s1, s2 = _rise(x), mp.diff(_rise, x) / wide, mp.diff(_rise, x, 2) / wide**2
        y = height + s
        return (y**2 + s1**2) ** mp.mpf(1.5) / (y**2 + 2 * s1**2 - y * s2)

    def least(height: Any) -> Any:
        return radius(mp.findroot(lambda x: mp.diff(lambda each: radius(each, height), x), 0.75), height) - RADIUS

    return mp.findroot(least, (73, 74))


# The crank-rocker


SWING, QUICK_RETURN = math.radians(80.0), 10.0 / 9.0
LOG = Wanted("log", (1.0, 2.0), math.radians(60.0), math.radians(60.0))
LEAST = math.radians(30.0)
"""Tasks: swing [rad] and time ratio; log x with a transmission angle [rad]."""


def rockers(quick: bool) -> Family:
    """The table of the crank-rockers."""
    methods = [*_swings(), *_functions(quick)]
    return Family(
        "crank-rocker",
        "Crank-rocker: coupler of the best transmission angle for a swing, and the start of a function's least error",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {PASS} numbers",
        measure(methods, numpy_pass(PASS), 1, 5 if quick else 9),
        (
            "swing 80 deg, time ratio 10/9: error of coupler over crank against the cubic in 40 digits",
            "log x, x = 1 .. 2, both swings 60 deg, start directions free: by what share the structural error is above "
            "the least that is known, of Nelder-Mead to 1e-13 from four starts",
        ),
    )


def _swings() -> list[Method]:
    p, q = half_angles(SWING, QUICK_RETURN, True)
    true = coupler_reference(p, q)
    ways: list[tuple[str, Callable[[], float]]] = [
        ("swing: root of the cubic", lambda: best_ratios(p, q).coupler),
        *((f"textbook scan of couplers, step {h:g}", partial(by_couplers, p, q, h)) for h in (1e-1, 1e-2, 1e-3)),
        *((f"scipy minimize_scalar, to {h:g}", partial(by_transmission, p, q, h)) for h in (1e-4, 1e-8, 1e-12)),
    ]
    return [Method(name, 1, run, float(abs(run() / true - 1))) for name, run in ways]


def transmission(coupler: Any, p: float, q: float) -> Any:
    """Cosine of the worse transmission angle: with the crank along the frame; crank 1."""
    rocker = np.hypot(math.cos(p), coupler * math.sin(p)) / math.sin(q)
    frame = np.hypot(math.cos(q - p), coupler * math.sin(q - p)) / math.sin(q)
    sides = coupler**2 + rocker**2
    cosines = ((sides - (frame + sign) ** 2) / (2.0 * coupler * rocker) for sign in (-1.0, 1.0))
    return np.maximum(*(np.abs(each) for each in cosines))


def by_couplers(p: float, q: float, step: float) -> float:
    """The best of equal steps of coupler over crank."""
    couplers = np.arange(1.0 + step, 8.0, step)
    return float(couplers[transmission(couplers, p, q).argmin()])


def by_transmission(p: float, q: float, tolerance: float) -> float:
    """By scipy's bounded search for the least cosine."""
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(
        transmission, bounds=(1.0, 8.0), args=(p, q), method="bounded", options={"xatol": tolerance}
    )
    return float(found.x)


def coupler_reference(p: float, q: float) -> Any:
    """Coupler over crank in 40 digits, from the root of the cubic."""
    mp = mpmath(40)
    t2, turned = 1 / mp.tan(mp.mpf(p)) ** 2, mp.tan(mp.mpf(q) - mp.mpf(p)) ** 2
    x = mp.findroot(lambda x: ((t2 * x + 2) * x - 1) * x - (1 + 1 / t2) * turned, 0.2)
    return 1 / mp.sqrt(x)


def _functions(quick: bool) -> list[Method]:
    def own() -> float:
        return best_start(LOG, (None, None), LEAST).error

    if quick:
        return [Method("function: grid, then downhill", 1, own)]
    starts = [(0.5 * math.pi * k, 0.5 * math.pi * k + 1.0) for k in range(4)]
    ways: list[tuple[str, Callable[[], float]]] = [
        ("function: grid, then downhill", own),
        *((f"scipy Nelder-Mead, to {h:g}", partial(by_nelder_mead, starts, h)) for h in (1e-2, 1e-6)),
    ]
    least = by_nelder_mead(starts, 1e-13)
    return [Method(name, 1, run, max(run() / least - 1.0, 0.0)) for name, run in ways]


def by_nelder_mead(starts: Sequence[tuple[float, float]], tolerance: float) -> float:
    """Least structural error of both start directions [rad]."""
    from scipy.optimize import minimize

    def error(both: Array) -> float:
        found = generated(LOG, float(both[0]), float(both[1]), LEAST)
        return 1.0 if found is None else found.error

    options = {"xatol": tolerance, "fatol": 1e-3 * tolerance, "maxiter": 400}
    return min(float(minimize(error, start, method="Nelder-Mead", options=options).fun) for start in starts)
