"""Cam profiles: true envelope and radial shortcut, polyline and spline by density; the press as a whole."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, Row, measure, mpmath, numpy_pass, sample_of
from gearlink.core.numerics.arrays import BLOCK
from gearlink.core.parts.cams.profile import profile, profile_points, translating

Array = NDArray[np.float64]
Points = NDArray[np.complex128]
BASE, RISE, ROLLER = 40.0, 10.0, 12.0
"""Radius to the roller centre at zero lift, half the lift, roller radius [mm]: s = 10 (1 - cos 2 theta)."""


def family(quick: bool) -> Family:
    """The table of the family."""
    rows: list[Row] = []
    for size in (360, 3600, 100_000) if quick else (360, 3600, 100_000, 1_000_000):
        rows += measure(_envelopes(size), numpy_pass(size), size, 5)
    rows += measure(_curves(), numpy_pass(3600), 3600, 5)
    return Family(
        "cam",
        "Cam profile: translating roller, base 40 mm, lift 20 mm, roller 12 mm",
        "mm",
        "one numpy pass of sin + cos + arctan2 + sqrt over as many numbers",
        tuple(rows),
        (
            "error of points: distance from the profile in 30 digits at the same cam angle; of the radial shortcut: "
            "distance of the roller that rolls on it from its true position",
            "error of polyline and spline: maximum distance from the envelope between the points",
        ),
    )


def lift(theta: Array) -> tuple[Array, Array, Array]:
    """Place of the roller centre and its derivatives."""
    return (
        BASE + RISE * (1.0 - np.cos(2.0 * theta)),
        2.0 * RISE * np.sin(2.0 * theta),
        4.0 * RISE * np.cos(2.0 * theta),
    )


def _envelopes(size: int) -> list[Method]:
    theta = np.linspace(0.0, 2.0 * math.pi, size, endpoint=False)
    y, y1, y2 = lift(theta)

    def whole() -> Any:
        return profile(theta, translating(y, y1, y2), sense=1, roller_radius=ROLLER)

    def points() -> Points:
        return profile_points(theta, translating(y, y1), sense=1, roller_radius=ROLLER)

    def in_blocks() -> Points:
        last = np.empty(0, dtype=np.complex128)
        for start in range(0, size, BLOCK):
            part = slice(start, start + BLOCK)
            path = translating(y[part], y1[part], y2[part])
            last = profile(theta[part], path, sense=1, roller_radius=ROLLER).profile
        return last

    ways: list[tuple[str, Callable[[], Any], Points]] = [
        ("envelope with pressure angle and curvature", whole, whole().profile),
        ("envelope, points alone", points, points()),
        ("textbook envelope, complex exponentials", lambda: textbook(theta, y, y1), textbook(theta, y, y1)),
    ]
    methods = [Method(name, size, run, point_error(found, theta)) for name, run, found in ways]
    if size > BLOCK:
        whole_error = methods[0].error
        methods.append(Method("envelope with all, in blocks of 8000, constant memory", size, in_blocks, whole_error))
    short = Method("radial shortcut", size, lambda: radial(theta, y), gap_of(radial(theta, y)))
    return [*methods, short]


def textbook(theta: Array, y: Array, y1: Array) -> Points:
    """The same envelope from complex exponentials and whole arrays."""
    back = np.exp(-1j * theta)
    normal = -1j * (y1 - 1j * y)
    found: Points = back * (y + ROLLER * normal / np.abs(normal))
    return found


def radial(theta: Array, y: Array) -> Points:
    """The roller radius taken off along the ray to the roller centre, not along the common normal."""
    found: Points = (y - ROLLER) * np.exp(-1j * theta)
    return found


def _exact(theta: float) -> Any:
    mp = mpmath(30)
    t = mp.mpf(theta)
    y, y1 = BASE + RISE * (1 - mp.cos(2 * t)), 2 * RISE * mp.sin(2 * t)
    normal = mp.mpc(-y, -y1)
    return mp.expj(-t) * (y + ROLLER * normal / abs(normal))


def point_error(found: Points, theta: Array) -> float:
    """Maximum distance of points from the profile in 30 digits at the same cam angle."""
    mp = mpmath(30)
    return max(float(abs(mp.mpc(complex(found[i])) - _exact(float(theta[i])))) for i in sample_of(theta.size))


def gap_of(found: Points) -> float:
    """Maximum | distance from the pitch curve - roller radius | of points."""
    theta = np.linspace(0.0, 2.0 * math.pi, 200_000, endpoint=False)
    pitch = lift(theta)[0] * np.exp(-1j * theta)
    chosen = found[sample_of(found.size, 60)]
    return max(abs(float(np.abs(pitch - point).min()) - ROLLER) for point in chosen)


def _curves() -> list[Method]:
    methods = []
    for size in (90, 360, 720, 1440, 3600):
        theta = np.linspace(0.0, 2.0 * math.pi, size + 1)
        points = profile_points(theta, translating(*lift(theta)[:2]), sense=1, roller_radius=ROLLER)
        between = 0.5 * (theta[1:] + theta[:-1])
        true = profile_points(between, translating(*lift(between)[:2]), sense=1, roller_radius=ROLLER)
        methods.append(Method(f"polyline, {size} points", size, _polyline(theta), _chord_error(points, true)))
        if size <= 720:
            methods.append(_spline_method(theta, points, between))
    return methods


def _polyline(theta: Array) -> Callable[[], object]:
    return lambda: profile_points(theta, translating(*lift(theta)[:2]), sense=1, roller_radius=ROLLER)


def _chord_error(points: Points, true: Points) -> float:
    along = np.diff(points)
    across = np.imag(np.conj(along) * (true - points[:-1])) / np.abs(along)
    return float(np.abs(across).max())


def _spline_method(theta: Array, points: Points, between: Array) -> Method:
    from scipy.interpolate import CubicSpline

    def run() -> Any:
        return CubicSpline(theta, np.append(points[:-1], points[0]), bc_type="periodic")

    return Method(f"cubic spline, {theta.size - 1} points", theta.size - 1, run, gap_of(run()(between)))


def press(quick: bool) -> Family:
    """Both chains, zone and both cams of the worked press at 3600 positions, from the validated spec on."""
    import gearlink.designs as designs
    from gearlink.cli.evaluate import open_design, read_spec
    from gearlink.cli.options import Options

    source = str(Path(str(designs.__file__)).parent / "ty460.yaml")
    loaded, kind = open_design(source, Options())
    spec = read_spec(loaded, kind, source)
    theta = np.linspace(0.0, 2.0 * math.pi, 3600, endpoint=False)

    def whole() -> None:
        design: Any = kind.design("cam", spec)
        _ = design.sync_end
        design.bed.travel(theta, 2)
        design.cylinder.travel(theta, 2)
        design.main_cam.at(theta)
        design.return_cam.at(theta)

    def tables() -> None:
        design: Any = kind.design("cam", spec)
        for name in ("positions", "follower", "main_cam", "return_cam"):
            design.table(name, samples=3600)

    rows = measure(
        [Method("chains, zone, both cams", 1, whole), Method("all four tables", 1, tables)],
        numpy_pass(3600),
        3600,
        9 if quick else 25,
    )
    return Family(
        "press",
        "Flatbed press: both drives, synchronous zone and both cams at 3600 positions",
        "none",
        "one numpy pass of sin + cos + arctan2 + sqrt over one number",
        rows,
        ("one result is the whole press; its errors are those of the four-bar and cam tables",),
    )
