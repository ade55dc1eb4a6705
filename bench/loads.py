"""Loads: forces of whole machines, flywheel, motor and residual vibration, each beside the textbook's way."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from bench.timing import Family, Method, measure, mpmath, numpy_pass
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.loads.flywheel import Energy
from gearlink.core.studies.loads.panels import Panels
from gearlink.core.studies.loads.running import MotorRun
from gearlink.core.studies.loads.vibration import Oscillator, Panelled

ROWS = 360
TURN = 2.0 * math.pi
KINDS = ("loaded_feed", "loaded_press", "loaded_gripper", "loaded_swing_cycle")
DELTA, SPEED = 0.05, 12.0
SLOPE, NO_LOAD, INERTIA = 3.0, 22.0, 0.4
RATIO = 4.3


def family(quick: bool) -> Family:
    """The table of the family."""
    kinds = KINDS[:2] if quick else KINDS
    methods = [method for name in kinds for method in _machine(name)]
    methods += [*_flywheels(), *_motors(), *_residuals()]
    return Family(
        "loads",
        "Loads: one result each; machines: torque and all forces at 360 positions",
        "relative",
        "one numpy pass of sin + cos + arctan2 + sqrt over 360 numbers",
        measure(methods, numpy_pass(ROWS), 1, 5 if quick else 15),
        (
            "a machine's error is the difference of its two input torques, that of the others is against 30 digits",
            "J' by differences: central ones of J at the 360 positions, as by hand",
            "textbook flywheel: dW/(delta w^2) from 360 rows, which omits the variable inertia",
        ),
    )


# Machines


def _machine(name: str) -> list[Method]:
    import gearlink.designs as designs
    from gearlink.cli.evaluate import open_design, read_spec
    from gearlink.cli.options import Options

    source = str(Path(str(designs.__file__)).parent / f"{name}.yaml")
    loaded, kind = open_design(source, Options())
    design: Any = kind.design("loads", read_spec(loaded, kind, source))
    machine = design.machine
    _ = machine.friction is not None and machine.locks
    runs = count()

    def fresh() -> Reals:
        """Other input angles each time, so that nothing that machine or law have kept serves again."""
        machine.kept.clear()
        machine.kept_few.clear()
        return np.linspace(0.0, TURN, ROWS, endpoint=False) + 1e-9 * next(runs)

    def forces() -> None:
        phi = fresh()
        machine.reduced(phi)
        machine.reactions(phi)

    def power() -> Reals:
        found: Reals = machine.reduced(fresh()).torque(machine.speed)
        return found

    def by_differences() -> Reals:
        reduced = machine.reduced(fresh())
        slope = (np.roll(reduced.inertia, -1) - np.roll(reduced.inertia, 1)) * (0.5 * ROWS / TURN)
        return np.asarray(0.5 * slope * machine.speed**2 + reduced.static)

    true = machine.reduced(np.arange(ROWS) * (TURN / ROWS)).torque(machine.speed)
    error = float(np.max(np.abs(by_differences() - true)) / np.max(np.abs(true)))
    return [
        Method(f"{design.kind}: all forces", 1, forces, design.power_identity),
        Method(f"{design.kind}: torque alone", 1, power, design.power_identity),
        Method(f"{design.kind}: torque, J' by differences", 1, by_differences, error),
    ]


# Flywheel


def _load(x: Any) -> Any:
    return 18.0 + 9.0 * np.sin(2.0 * x) - 4.0 * np.cos(x)


def _inertia(x: Any) -> Any:
    return 0.05 + 0.03 * np.cos(x)


def _flywheels() -> list[Method]:
    true = float(flywheel_reference())
    x = np.arange(ROWS) * (TURN / ROWS)

    def exact() -> float:
        return Energy.from_functions(_load, _inertia, Panels.over(TURN, [])).flywheel_for(DELTA, SPEED)

    def textbook() -> float:
        surplus = np.cumsum(18.0 - _load(x)) * (TURN / ROWS)
        return float(surplus.max() - surplus.min()) / (DELTA * SPEED**2)

    return [
        Method(name, 1, run, abs(run() / true - 1.0))
        for name, run in (("flywheel, exact with J(phi)", exact), ("flywheel, textbook", textbook))
    ]


def flywheel_reference() -> Any:
    """J_F = [max(W - J w_1^2/2) - min(W - J w_2^2/2)]/(delta w_m^2) with 30 digits."""
    mp = mpmath(30)
    delta, speed = mp.mpf(DELTA), mp.mpf(SPEED)

    def extreme(sign: int) -> Any:
        square = (speed * (1 + sign * delta / 2)) ** 2 / 2

        def value(x: Any) -> Any:
            surplus = mp.mpf(9) / 2 * (mp.cos(2 * x) - 1) + 4 * mp.sin(x)
            return surplus - (mp.mpf("0.05") + mp.mpf("0.03") * mp.cos(x)) * square

        def slope(x: Any) -> Any:
            return -9 * mp.sin(2 * x) + 4 * mp.cos(x) + mp.mpf("0.03") * mp.sin(x) * square

        best = max(range(ROWS), key=lambda i: sign * value(mp.mpf(i) * 2 * mp.pi / ROWS))
        return value(mp.findroot(slope, mp.mpf(best) * 2 * mp.pi / ROWS))

    return (extreme(1) - extreme(-1)) / (delta * speed**2)


# Motor


def _speed(x: Any) -> Any:
    return 10.0 + 0.8 * np.cos(x) + 0.3 * np.sin(3.0 * x)


def _torque_of_load(x: Any) -> Any:
    """The load with which the machine runs at just that speed: tau = k (w_0 - w) - J w w'."""
    w, bend = _speed(x), -0.8 * np.sin(x) + 0.9 * np.cos(3.0 * x)
    return SLOPE * (NO_LOAD - w) - INERTIA * w * bend


def _motors() -> list[Method]:
    x = np.linspace(0.0, TURN, 33)
    true = _speed(x)

    def periodic() -> Reals:
        inertia: Callable[[Reals], Reals] = lambda phi: np.full_like(phi, INERTIA)  # noqa: E731
        return MotorRun(_torque_of_load, inertia, Panels.over(TURN, []), SLOPE, NO_LOAD).speed(x)

    def marched() -> Reals:
        """Runge-Kutta over the energy, 360 steps a revolution, six turns from the no-load speed."""
        step, energy, found = TURN / ROWS, 0.5 * INERTIA * NO_LOAD**2, np.empty(ROWS + 1)

        def rate(phi: float, e: float) -> float:
            return float(SLOPE * (NO_LOAD - math.sqrt(2.0 * e / INERTIA)) - _torque_of_load(phi))

        for i in range(6 * ROWS + 1):
            found[i % ROWS] = energy
            phi = i * step
            k1 = rate(phi, energy)
            k2 = rate(phi + 0.5 * step, energy + 0.5 * step * k1)
            k3 = rate(phi + 0.5 * step, energy + 0.5 * step * k2)
            energy += step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rate(phi + step, energy + step * k3))
        found[ROWS] = found[0]
        return np.asarray(np.sqrt(2.0 * np.interp(x, np.arange(ROWS + 1) * step, found) / INERTIA))

    return [
        Method(name, 1, run, float(np.max(np.abs(run() / true - 1.0))))
        for name, run in (("motor, periodic by Newton", periodic), ("motor, marched from no load", marched))
    ]


# Vibration


def _residuals() -> list[Method]:
    mp = mpmath(30)
    r = mp.mpf(RATIO)
    true = float(abs(mp.sin(mp.pi * r)) / (mp.pi * r * abs(1 - r * r)))
    frequency = TURN * RATIO

    def bend(u: Reals) -> Reals:
        return np.asarray(TURN * np.sin(TURN * u))

    def exact() -> float:
        motion = Panelled.of(bend, 0.0, 1.0, (), frequency)
        return motion.residual(Oscillator(frequency, 0.0), 1.0)

    def newmark() -> float:
        """Constant average acceleration, 1000 steps."""
        step, z, v = 1e-3, 0.0, 0.0
        load = -bend(np.linspace(0.0, 1.0, 1001))
        a = float(load[0])
        for p in load[1:].tolist():
            guess, fast = z + step * v + 0.25 * step * step * a, v + 0.5 * step * a
            a = (p - frequency**2 * guess) / (1.0 + 0.25 * step * step * frequency**2)
            z, v = guess + 0.25 * step * step * a, fast + 0.5 * step * a
        return math.hypot(z, v / frequency)

    return [
        Method(name, 1, run, abs(run() / true - 1.0))
        for name, run in (("residual after a cycloid", exact), ("residual, Newmark with 1000 steps", newmark))
    ]
