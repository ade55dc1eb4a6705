"""Changes of sign over a period: where torque or teeth change sides."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlink.core.loads.machine import Machine, zeros
from gearlink.core.numerics.arrays import Reals

# A value below this share of the largest is rounding: it has no sign.
NOISE = 1e-11
_STEP = 1e-6


def places(f: Callable[[Reals], Reals], machine: Machine, size: float) -> list[float]:
    """Input angles where a function changes its sign, jumps across zero among them [rad].

    Parameters
        f : function of input angles
        machine : Machine - gives the period
        size : float - largest magnitude of f; what stays below 1e-11 of it has no sign
    """
    if size == 0.0:
        return []
    found = zeros(lambda phi: _without_noise(f(phi), size), machine.period, machine.turns)
    if not found or min(found[0], machine.period - found[-1]) > _STEP:
        # The ends of the period are one place: a sign that changes there is seen from neither side.
        first, last = f(np.array([_STEP, machine.period - _STEP]))
        if first * last < 0.0 and min(abs(first), abs(last)) > NOISE * size:
            found.insert(0, 0.0)
    return [place for place in found if _changes(f, place, size)]


def sign_changes(f: Callable[[Reals], Reals], machine: Machine, size: float) -> int:
    """How many of them there are."""
    return len(places(f, machine, size))


def _without_noise(values: Reals, size: float) -> Reals:
    return np.where(np.abs(values) <= NOISE * size, 0.0, values)


def _changes(f: Callable[[Reals], Reals], place: float, size: float) -> bool:
    """Whether the function has opposite signs on both sides; one that comes from or goes to nothing has not."""
    before, after = f(np.array([place - _STEP, place + _STEP]))
    return bool(before * after < 0.0 and min(abs(before), abs(after)) > NOISE * size)
