"""Changes of sign over a period: where torque or teeth change sides."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TypeAlias

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.loads.machine import Machine
from gearlink.core.studies.loads.zeros import zeros_of

Function: TypeAlias = Callable[[Reals], Reals]

# A value below this share of the largest is rounding: it has no sign.
NOISE = 1e-11
_STEP = 1e-6


def places(f: Function, machine: Machine, size: float) -> list[float]:
    """Input angles where a function changes its sign, jumps across zero among them [rad].

    Parameters
        f : function of input angles
        machine : Machine - gives the period
        size : float - largest magnitude of f; what stays below 1e-11 of it has no sign
    """
    return places_of([(f, size)], machine)[0]


def places_of(functions: Sequence[tuple[Function, float]], machine: Machine) -> list[list[float]]:
    """Those of several functions, searched together."""
    loaded = [k for k, (_, size) in enumerate(functions) if size != 0.0]
    signs = [partial(_without_noise, *functions[k]) for k in loaded]
    found: list[list[float]] = [[] for _ in functions]
    every = zeros_of(signs, machine.period, machine.turns, jumps=machine.breaks, any_zero=True) if loaded else []
    for k, zeros in zip(loaded, every, strict=True):
        f, size = functions[k]
        if not machine.stroke and (not zeros or min(zeros[0], machine.period - zeros[-1]) > _STEP):
            # The ends of the period are one place: a sign that changes there is seen from neither side.
            first, last = f(np.array([_STEP, machine.period - _STEP]))
            if first * last < 0.0 and min(abs(first), abs(last)) > NOISE * size:
                zeros.insert(0, 0.0)
        found[k] = _changes(f, zeros, size, machine)
    return found


def sign_changes(f: Function, machine: Machine, size: float) -> int:
    """How many of them there are."""
    return len(places(f, machine, size))


def _without_noise(f: Function, size: float, phi: Reals) -> Reals:
    values = f(phi)
    return np.where(np.abs(values) <= NOISE * size, 0.0, values)


def _changes(f: Function, zeros: list[float], size: float, machine: Machine) -> list[float]:
    """The places with opposite signs on both sides; one where f comes from or goes to nothing is none."""
    if not zeros:
        return []
    sides = np.array([place + step for place in zeros for step in (-_STEP, _STEP)])
    values = f(sides if machine.stroke else np.mod(sides, machine.period))
    before, after = values[::2], values[1::2]
    changes = (before * after < 0.0) & (np.minimum(np.abs(before), np.abs(after)) > NOISE * size)
    return [place for place, each in zip(zeros, changes, strict=True) if each]
