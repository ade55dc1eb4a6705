"""A planar mechanism from its file: output angle of a Watt six-bar and two derivatives, against loops of one's own."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.timing import Family, Method, Row, measure, mpmath, numpy_pass, sample_of
from gearlink.core.machines.planar.spec import PlanarSpec
from gearlink.core.studies.tolerance_study.problem import Problem, problem
from gearlink.core.studies.tolerance_study.samples import design_of, rows_of

Array = NDArray[np.float64]
TURN = 2.0 * math.pi
SIZES = (1, 360, 3600)
CRANK, FRAME, COUPLER, ROCKER, ARM, OUTPUT = 40.0, 110.0, 100.0, 90.0, 120.0, 130.0
ON_COUPLER, ON_ROCKER = 130.0 + 60.0j, 120.0 - 60.0j
STEPS = (1e-1, 1e-2, 1e-3)
"""Steps of the differences [rad]."""


def family(quick: bool) -> Family:
    """The table of the family."""
    rows: list[Row] = []
    for size in SIZES[:2] if quick else SIZES:
        rows += measure(_methods(size, quick), numpy_pass(size), size, 3 if quick else 5)
    return Family(
        "planar",
        "Planar mechanism: output angle of a Watt six-bar with two derivatives",
        "relative",
        "one numpy pass of sin + cos + arctan2 + sqrt over as many numbers",
        tuple(rows),
        (
            "designs/planar_watt.yaml; gearlink knows its joints alone, and solves and differentiates their equations",
            "course: its certified steps over a revolution are made once, and not part of the time of the positions",
            "error: maximum of angle, first and second derivative, against two dyads in 40 digits",
            "scipy: fsolve of both loops at each position and at one step on either side, central differences",
            "textbook dyads: closed form of this one linkage by hand; derivatives by numpy.gradient or Fourier series",
        ),
    )


def _methods(size: int, quick: bool) -> list[Method]:
    design = made()
    q = np.linspace(0.0, TURN, size, endpoint=False)
    _ = design.course.walk
    ways: list[tuple[str, Callable[[], Array]]] = [("course, order 2", partial(of_course, design, q))]
    if size > 1:
        # positions in small steps, each from the one before: fsolve does not change the assembly then
        steps = STEPS if size == SIZES[1] and not quick else STEPS[1:2]
        ways += [(f"scipy fsolve and differences, step {h:g}", partial(by_fsolve, q, h)) for h in steps]
        ways += [
            ("textbook dyads, numpy.gradient", partial(by_gradient, q)),
            ("textbook dyads, FFT", partial(by_fft, q)),
        ]
    methods = [Method(name, size, run, error_of(run(), q)) for name, run in ways]
    if size == 1:
        methods.append(Method("course from the file's data to its end", 1, lambda: made().course.walk))
    return methods


def made() -> Any:
    """The design of the file."""
    import gearlink.designs as designs
    from gearlink.core.machines.planar.design import PlanarMechanism

    return PlanarMechanism(_spec(str(Path(str(designs.__file__)).parent / "planar_watt.yaml")))


@cache
def _spec(source: str) -> Any:
    from gearlink.cli.evaluate import open_design, read_spec
    from gearlink.cli.options import Options

    loaded, kind = open_design(source, Options())
    return read_spec(loaded, kind, source)


def of_course(design: Any, q: Array) -> Array:
    """Output angle and its derivatives; (3, N)."""
    course = design.course
    jets = course.jets(q, 2)
    body = design.structure.numbers["output"]
    return np.array(course.derivatives(lambda each, k: each.t[k][:, body], jets, 2))


def _meeting(one: Any, radius: float, other: Any, further: float) -> Any:
    """Where two circles meet, left of the way from one centre to the other."""
    way = other - one
    square = abs(way) ** 2
    along = (square + radius**2 - further**2) / 2
    return one + way * (along + 1j * (radius**2 * square - along**2) ** 0.5) / square


def dyads(turn: Any, sizes: Sequence[Any] = (CRANK, COUPLER, ROCKER, ARM)) -> Any:
    """G - F from e^(i q), numbers of numpy or of mpmath."""
    crank, coupler, rocker, arm = sizes
    pin = crank * turn
    joint = _meeting(pin, coupler, FRAME + 0j, rocker)
    on_coupler = pin + ON_COUPLER * (joint - pin) / coupler
    on_rocker = FRAME + ON_ROCKER * (joint - FRAME) / rocker
    return _meeting(on_coupler, arm, on_rocker, OUTPUT) - on_rocker


def _angle(q: Array) -> Array:
    return np.unwrap(np.angle(dyads(np.exp(1j * q))))


def by_gradient(q: Array) -> Array:
    """Closed form; derivatives by differences of neighbours over the closed revolution."""
    step = q[1] - q[0]
    closed = _angle(np.concatenate([q[:1] - 2.0 * step, q[:1] - step, q, q[-1:] + step, q[-1:] + 2.0 * step]))
    first = np.gradient(closed, step)
    return np.array([closed, first, np.gradient(first, step)])[:, 2:-2]


def by_fft(q: Array) -> Array:
    """Closed form; derivatives of the Fourier series through all positions."""
    angle = _angle(q)
    order = np.fft.rfftfreq(q.size, 1.0 / q.size)
    series = np.fft.rfft(angle)
    return np.array([angle, *(np.fft.irfft((1j * order) ** k * series, q.size) for k in (1, 2))])


def by_fsolve(q: Array, step: float) -> Array:
    """Both loops by scipy's fsolve, position after position; derivatives by central differences."""
    from scipy.optimize import fsolve

    def gap(u: Array, turned: float) -> list[float]:
        coupler, rocker, arm, output = (cmath.exp(1j * angle) for angle in u)
        pin = CRANK * cmath.exp(1j * turned)
        first = pin + COUPLER * coupler - FRAME - ROCKER * rocker
        second = pin + ON_COUPLER * coupler + ARM * arm - FRAME - ON_ROCKER * rocker - OUTPUT * output
        return [first.real, first.imag, second.real, second.imag]

    u = np.radians([60.0, 105.0, 65.0, 110.0])
    found = np.empty((3, q.size))
    for i, turned in enumerate(q.tolist()):
        u = fsolve(gap, u, args=(turned,), xtol=1e-11)
        before, here, after = (fsolve(gap, u, args=(turned + h,), xtol=1e-11)[3] for h in (-step, 0.0, step))
        found[:, i] = here, (after - before) / (2.0 * step), (after - 2.0 * here + before) / step**2
    return found


@cache
def reference(q: float) -> tuple[Any, ...]:
    """Output angle and its two derivatives at an input, the two dyads in 40 digits."""
    mp = mpmath(40)

    def angle(turned: Any) -> Any:
        return mp.arg(dyads(mp.expj(turned)))

    return tuple(mp.diff(angle, mp.mpf(q), k) for k in range(3))


def error_of(found: Array, q: Array) -> float:
    """Maximum difference of angle and derivatives, relative where they are above 1."""
    mp, worst = mpmath(40), 0.0
    for i in sample_of(q.size, 24):
        for k, true in enumerate(reference(float(q[i]))):
            off = mp.mpf(float(found[k, i])) - true
            if k == 0:
                off -= 2 * mp.pi * mp.nint(off / (2 * mp.pi))
            worst = max(worst, float(abs(off) / max(1, abs(true))))
    return worst


# As manufactured


SOURCES = {"links.crank[2]": CRANK, "links.coupler.C[0]": COUPLER, "links.rocker.C[0]": ROCKER, "links.arm[2]": ARM}
ASKED = ("output.swing", "output.speed_ratio_max")


def samples(quick: bool) -> Family:
    """The table of the samples."""
    size, few = 256, 3
    columns = _columns(size)
    some = {key: column[:few] for key, column in columns.items()}
    study = _study()
    ways: list[tuple[str, int, Callable[[], Array]]] = [
        ("at once", size, partial(_at_once, study, columns)),
        ("one by one", few, partial(_one_by_one, study, some)),
        *(
            (f"textbook scan, {n} positions", size, partial(by_scan, columns, n))
            for n in ((360,) if quick else (90, 360, 1440))
        ),
    ]
    methods = [Method(name, count, run, _off(run(), columns)) for name, count, run in ways]
    return Family(
        "planar-samples",
        "Samples of a Watt six-bar as manufactured: swing and maximum speed ratio of the output",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {size} numbers",
        measure(methods, numpy_pass(size), size, 3 if quick else 7),
        (
            "four lengths +-0.02 mm; gearlink: as in a tolerance study, with the checks of every sample",
            "textbook scan: the two dyads of all samples at equal steps of the crank, speed from a Fourier series",
            "error: of both quantities, against extremes in 40 digits",
        ),
    )


def _columns(size: int) -> dict[str, Array]:
    off = np.random.default_rng(4).normal(size=(len(SOURCES), size)) * 0.0067
    return {key: length + by for (key, length), by in zip(SOURCES.items(), off, strict=True)}


def _study() -> Problem:
    """A tolerance study of the file."""
    data = made().spec.model_dump(exclude_unset=True, by_alias=True)
    sources = {key: {"plus_minus": 0.02} for key in SOURCES}
    return problem(PlanarSpec.model_validate(data | {"tolerance": {"sources": sources}}))


def _at_once(study: Problem, columns: dict[str, Array]) -> Array:
    assert study.axis is not None
    found = study.axis.evaluate(columns, ASKED).quantities
    return np.array([found[name] for name in ASKED]).T


def _one_by_one(study: Problem, columns: dict[str, Array]) -> Array:
    designs = [design_of(study, row) for row in rows_of(columns)]
    return np.array([[one.quantity(name).value for name in ASKED] for one in designs])


def by_scan(columns: dict[str, Array], positions: int) -> Array:
    """Swing [deg] and maximum speed ratio at equal steps."""
    q = np.linspace(0.0, TURN, positions, endpoint=False)
    angle = np.angle(dyads(np.exp(1j * q), [column[:, None] for column in columns.values()]))
    order = np.fft.rfftfreq(positions, 1.0 / positions)
    speed = np.fft.irfft(1j * order * np.fft.rfft(angle), positions)
    return np.array([np.degrees(np.ptp(angle, axis=1)), speed.max(axis=1)]).T


def _off(found: Array, columns: dict[str, Array]) -> float:
    """Maximum relative error of the first samples."""
    worst = 0.0
    for i in range(3):
        for k, true in enumerate(extremes(tuple(float(column[i]) for column in columns.values()))):
            worst = max(worst, float(abs(found[i, k] / true - 1)))
    return worst


@cache
def extremes(sizes: tuple[float, ...]) -> tuple[Any, Any]:
    """Swing [deg] and maximum speed ratio in 40 digits."""
    mp = mpmath(40)
    near = np.linspace(0.0, TURN, 720, endpoint=False)
    angle = np.angle(dyads(np.exp(1j * near), sizes))

    def of(q: Any) -> Any:
        return mp.arg(dyads(mp.expj(q), [mp.mpf(each) for each in sizes]))

    def at(order: int, i: int) -> Any:
        return mp.diff(of, mp.findroot(lambda q: mp.diff(of, q, order + 1), float(near[i])), order)

    swing = at(0, int(angle.argmax())) - at(0, int(angle.argmin()))
    return mp.degrees(swing), at(1, int(np.gradient(angle).argmax()))
