"""Samples of tolerance studies: drives and cams as manufactured, many together against one by one."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, Row, measure, mpmath, numpy_pass, sample_of
from gearlink.core.base.design import in_unit
from gearlink.core.base.nomenclature import term
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.register import ThreeGearSamples
from gearlink.core.machines.three_gear.spec import ThreeGearSpec
from gearlink.core.studies.explore.base import Base

_FEW = 12
_ASKED = ("speed_ratio_min", "back_step_angle", "dwell_swing", "dwell_angle", "tolerance_dwell_angle")
_DEVIATION = 0.0067  # mm: limits of +-0.02 at three of it
_WIDTH, _LIFT, _ROLLER = 80.0, 12.0, 12.0
"""Of the sampled cams: cam angle of rise and return [deg], lift, roller radius [mm]."""
_PLACE = ("cam.prime_radius", 60.0), ("follower.offset", 5.0)
_DRUM, _DEPTH, _STROKE = 60.0, 12.0, 40.0
"""Of the sampled drums: radius, depth of the track, lift [mm]; two sizes vary."""
_SIZES = ("cam.radius", _DRUM), ("follower.roller_radius", 18.0)
_OF_DRUMS = ("max_pressure_angle", "least_wall_factor")
_OF_CAMS = ("max_pressure_angle", "min_curvature_radius")
_KEYS = ("links.crank", "links.frame", "centers.crank_idler", "centers.idler_output")


def family(quick: bool) -> Family:
    """The table of the family; the error is the maximum difference from drives computed one by one."""
    axis, size = ThreeGearSamples(_drive()), 2048 if quick else 8192
    columns = _columns(axis, size)
    few = {key: column[:: size // _FEW][:_FEW] for key, column in columns.items()}
    methods = []
    for name in _ASKED:
        off = _difference(axis, few, name)
        methods.append(Method(f"{name}, at once", size, partial(axis.evaluate, columns, (name,)), off))
    methods.append(Method("back_step_angle, by class", _FEW, partial(_alone, axis, few, "back_step_angle"), 0.0))
    rows: tuple[Row, ...] = measure(methods, numpy_pass(size), size, 3)
    return Family(
        "samples",
        "Samples of a three-gear drive as manufactured: one quantity and all checks",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {size} numbers",
        rows,
        ("crank, frame and both centre distances +-0.02 mm; the checks of the drive are evaluated for every sample",),
    )


def _drive() -> ThreeGearFourBar:
    gears = {"module": 2.0, "crank": 40, "idler": 72, "output": 40}
    links = {"crank": 38.942, "frame": 153.53}
    data = {"kind": "three-gear-four-bar", "gears": gears, "links": links, "dwell_tolerance": 0.5}
    return ThreeGearFourBar(ThreeGearSpec.model_validate(data))


def _columns(axis: ThreeGearSamples, size: int) -> dict[str, Any]:
    nominal = axis.nominal
    sizes = (nominal.crank_length, nominal.frame_length, nominal.coupler_length, nominal.rocker_length)
    off = np.random.default_rng(1).normal(size=(len(_KEYS), size)) * _DEVIATION
    return {key: length + part for key, length, part in zip(_KEYS, sizes, off, strict=True)}


def _alone(axis: ThreeGearSamples, columns: dict[str, Any], name: str) -> list[float]:
    count = len(columns[_KEYS[0]])
    made = (axis.design({key: column[i] for key, column in columns.items()}) for i in range(count))
    return [in_unit(one.raw(name), term(name).unit) for one in made]


def _difference(axis: ThreeGearSamples, columns: dict[str, Any], name: str) -> float:
    many = axis.evaluate(columns, (name,)).quantities[name]
    single = np.array(_alone(axis, columns, name))
    return float(np.max(np.abs(many - single) / np.maximum(1.0, np.abs(single))))


# Disc cams


def cams(quick: bool) -> Family:
    """The table of disc cams; the error is that of pressure angle and curvature radius against 40 digits."""
    size, few = 256, 16
    places = _places(_PLACE, size)
    ways: list[tuple[str, int, Callable[[], NDArray[np.float64]]]] = [
        ("searches together", size, partial(_made, _base(), _OF_CAMS, places, together=True)),
        ("one by one", few, partial(_made, _base(), _OF_CAMS, places[:few], together=False)),
        *(
            (f"textbook scan, step {h:g} deg", size, partial(_scan, places, h))
            for h in ((1.0,) if quick else (4.0, 1.0, 0.25))
        ),
    ]
    methods = [Method(name, count, run, _off(run(), places, _exact)) for name, count, run in ways]
    return Family(
        "cam-samples",
        "Samples of a disc cam as manufactured: maximum pressure angle and minimum curvature radius",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {size} numbers",
        measure(methods, numpy_pass(size), size, 5 if quick else 9),
        (
            "prime radius 60 mm and offset 5 mm +-0.02 mm; lift 12 mm by polynomial 3-4-5 in 80 deg, and back",
            "gearlink: from the changed numbers to both quantities, each design validated and its extremes refined",
            "textbook scan: all cams at equal steps of the cam angle as one array; the largest of the values there",
        ),
    )


def _places(nominal: tuple[tuple[str, float], ...], size: int) -> list[list[tuple[str, float]]]:
    off = np.random.default_rng(2).normal(size=(size, len(nominal))) * _DEVIATION
    return [[(key, value + by) for (key, value), by in zip(nominal, row, strict=True)] for row in off.tolist()]


@cache
def _base() -> Base:
    motion = [
        {"to": _WIDTH, "lift": _LIFT, "law": "polynomial-345"},
        {"to": 150},
        {"to": 150 + _WIDTH, "lift": 0, "law": "polynomial-345"},
        {"to": 360},
    ]
    data = {
        "kind": "disc-cam",
        "name": "cam",
        "motion": motion,
        "follower": {"type": "translating-roller", "roller_radius": _ROLLER, "offset": _PLACE[1][1]},
        "cam": {"prime_radius": _PLACE[0][1]},
    }
    return Base(data, "cam")


def _made(
    base: Base, names: tuple[str, ...], places: list[list[tuple[str, float]]], *, together: bool
) -> NDArray[np.float64]:
    designs: list[Any] = [base.design(place) for place in places]
    if together:
        type(designs[0]).find_together(designs, names)
    return np.array([[design.raw(name) for name in names] for design in designs])


def _motion() -> Any:
    design: Any = _base().design([])
    return design.follower_motion


def _scan(places: list[list[tuple[str, float]]], step: float) -> NDArray[np.float64]:
    s, s1, s2 = _motion().evaluate(np.radians(np.arange(0.0, 360.0, step)), 2)
    radius, offset = np.array([[value for _, value in place] for place in places]).T[..., None]
    y, w = np.sqrt(radius**2 - offset**2) + s, s1 - offset
    bend = (y * y - y * s2 + w * (w + s1)) / (y * y + w * w) ** 1.5
    return np.array([np.arctan(np.abs(w) / y).max(axis=1), 1.0 / bend.max(axis=1)]).T


def _off(
    found: NDArray[np.float64],
    places: list[list[tuple[str, float]]],
    exact: Callable[[float, float], tuple[Any, Any]],
) -> float:
    """Maximum error of both quantities, relative, on some of the cams."""
    mp = mpmath(40)
    return max(
        float(abs(mp.mpf(float(found[i, k])) / true - 1))
        for i in sample_of(len(found), 4)
        for k, true in enumerate(exact(places[i][0][1], places[i][1][1]))
    )


@cache
def _exact(radius: float, offset: float) -> tuple[Any, Any]:
    """Pressure angle and curvature radius in 40 digits, of the stroke on which each is worse."""
    mp = mpmath(40)
    wide, e = mp.radians(mp.mpf(_WIDTH)), mp.mpf(offset)
    start = mp.sqrt(mp.mpf(radius) ** 2 - e**2)

    def lift(x: Any) -> Any:
        return _LIFT * x**3 * (10 - 15 * x + 6 * x**2)

    def course(x: Any, sense: int) -> tuple[Any, Any]:
        y, w = start + lift(x), sense * mp.diff(lift, x) / wide - e
        bend = y**2 - y * mp.diff(lift, x, 2) / wide**2 + w * (w + sense * mp.diff(lift, x) / wide)
        return abs(w) / y, bend / (y**2 + w**2) ** mp.mpf(1.5)

    def most(k: int, near: float) -> Any:
        found = []
        for sense in (1, -1):  # a return is the rise run backwards
            place = mp.findroot(lambda x, sense=sense: mp.diff(lambda each: course(each, sense)[k], x), near)
            found.append(course(place, sense)[k])
        return max(found)

    return mp.atan(most(0, 0.45)), 1 / most(1, 0.8)


# Cylindrical cams


def drums(quick: bool) -> Family:
    """The table of cylindrical cams; the error is that of pressure angle and wall factor against 40 digits."""
    size, few = 256, 16
    places, base = _places(_SIZES, size), _drum_base()
    steps = (1.0,) if quick else (4.0, 1.0, 0.25)
    ways: list[tuple[str, int, Callable[[], NDArray[np.float64]]]] = [
        ("searches together", size, partial(_made, base, _OF_DRUMS, places, together=True)),
        ("one by one", few, partial(_made, base, _OF_DRUMS, places[:few], together=False)),
        *((f"textbook scan, step {h:g} deg", size, partial(_drum_scan, places, h)) for h in steps),
        ("textbook development, 0.25 deg", size, partial(_drum_scan, places, 0.25, developed=True)),
    ]
    methods = [Method(name, count, run, _off(run(), places, _drum_exact)) for name, count, run in ways]
    return Family(
        "drum-samples",
        "Samples of a cylindrical cam: maximum pressure angle and minimum wall factor of the track",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {size} numbers",
        measure(methods, numpy_pass(size), size, 5 if quick else 9),
        (
            "drum of radius 60 mm and roller of 18 mm +-0.02 mm, track 12 mm deep; lift 40 mm in 110 deg, and back",
            "wall factor: a wall of the track, in space, is regular where it is positive",
            "textbook scan: all drums at equal steps of the cam angle as one array",
            "textbook development: the walls as parallel curves in the plane, which omits their twist",
        ),
    )


@cache
def _drum_base() -> Base:
    motion = [
        {"to": 110, "lift": _STROKE, "law": "polynomial-345"},
        {"to": 180},
        {"to": 290, "lift": 0, "law": "polynomial-345"},
        {"to": 360},
    ]
    data = {
        "kind": "cylindrical-cam",
        "name": "drum",
        "motion": motion,
        "follower": {"type": "translating-roller", "roller_radius": _SIZES[1][1]},
        "cam": {"radius": _DRUM, "depth": _DEPTH},
    }
    return Base(data, "cam")


def _drum_scan(places: list[list[tuple[str, float]]], step: float, *, developed: bool = False) -> NDArray[np.float64]:
    design: Any = _drum_base().design([])
    _, s1, s2 = design.follower_motion.evaluate(np.radians(np.arange(0.0, 360.0, step)), 2)
    radius, roller = np.array([[value for _, value in place] for place in places]).T[..., None]
    steepest = np.arctan(np.abs(s1).max() / (radius[:, 0] - _DEPTH))
    factors = []
    for x in (radius, radius - _DEPTH):
        square = x * x + s1 * s1
        twist = 0.0 if developed else (roller * s1 / square) ** 2
        factors.append((1.0 - roller * x * np.abs(s2) / square**1.5 - twist).min(axis=1))
    return np.array([steepest, np.minimum(*factors)]).T


@cache
def _drum_exact(radius: float, roller: float) -> tuple[Any, Any]:
    """Pressure angle and wall factor in 40 digits: tan alpha = (15/8) h/(beta x) at the bottom of the track."""
    mp = mpmath(40)
    wide, roll = mp.radians(mp.mpf(110)), mp.mpf(roller)

    def factor(u: Any, x: Any) -> Any:
        s1 = _STROKE * 30 * u**2 * (1 - u) ** 2 / wide
        s2 = _STROKE * 60 * u * (1 - u) * (1 - 2 * u) / wide**2
        square = x**2 + s1**2
        return 1 - roll * x * s2 / square ** mp.mpf(1.5) - (roll * s1 / square) ** 2

    bottom = mp.mpf(radius) - _DEPTH
    found = []
    for x in (mp.mpf(radius), bottom):
        near = min((factor(mp.mpf(k) / 64, x), k) for k in range(1, 32))[1] / 64.0
        found.append(factor(mp.findroot(lambda u, x=x: mp.diff(lambda each: factor(each, x), u), near), x))
    return mp.atan(mp.mpf(15) / 8 * _STROKE / wide / bottom), min(found)
