"""What is judged of the teeth of many drives: their meshes at the centre distances as made."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np

from gearlink.core.base.design_axis import Findings
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.as_made.one import TolerancedDrive
from gearlink.core.numerics.arrays import Mask, Reals

_NO_MESH = "no mesh"
State = frozenset[str]
"""Codes that fail at a centre distance; `_NO_MESH` where the teeth cannot mesh."""


def findings_of_meshes(
    nominal: Any, lengths: Sequence[float], names: Sequence[str], made: Sequence[Reals], exists: Mask
) -> Iterator[Findings]:
    """The checks of both meshes.

    Parameters
        nominal : ThreeGearFourBar
        lengths : 4 float [mm] - crank, coupler, rocker, frame of it
        names : of the checks
        made : two (N,) arrays [mm] - coupler and rocker as made, the centre distances of the meshes
        exists : (N,) array - becomes False where the teeth cannot mesh
    Yields
        findings : Findings - one of every code and mesh, without values
    """
    for place, (mesh, distances) in enumerate(zip(nominal.mesh_names, made, strict=True), 1):

        def state(distance: float, place: int = place, mesh: str = mesh) -> State:
            a, b, c, d = (distance if i == place else length for i, length in enumerate(lengths))
            return _state(TolerancedDrive(nominal.spec, (a, b, c, d), cut=nominal), mesh, names)

        states = over_sorted(state, distances)
        exists &= ~_with(states, _NO_MESH, distances.size)
        judged = (check.code for name in names for check in nominal.check_mesh(name, mesh))
        for code in dict.fromkeys([*judged, *(code for found, _ in states for code in found - {_NO_MESH})]):
            fails, nothing = _with(states, code, distances.size), np.full(distances.shape, np.nan)
            yield Findings(code, nothing, nothing, fails, np.zeros_like(fails), "1")


def _state(made: TolerancedDrive, mesh: str, names: Sequence[str]) -> State:
    try:
        found = [check for name in names for check in made.check_mesh(name, mesh)]
    except NoSolution:
        return frozenset((_NO_MESH,))
    return frozenset(check.code for check in found if check.status == "fail")


def over_sorted(state: Callable[[float], State], values: Reals) -> list[tuple[State, Any]]:
    """What a function of one number is at many, where it changes few times and never back.

    Parameters
        state : Callable - of one number; what it gives at two numbers it gives between them
        values : (N,) array
    Returns
        states : list of (state, places) - places in `values`
    Notes
        A mesh is judged at some numbers of each stretch alone: contact ratio, clearance at the root and what the tips
        leave of the flanks rise or fall with the centre distance, so that each code fails on one side of a number.
    """
    order = np.argsort(values)
    found: list[tuple[State, Any]] = []

    def between(first: int, last: int, low: State, high: State) -> None:
        """The places after the first to the last."""
        if low == high or last - first <= 1:
            found.append((high, order[first + 1 : last + 1]))
            return
        middle = (first + last) // 2
        half = state(float(values[order[middle]]))
        between(first, middle, low, half)
        between(middle, last, half, high)

    ends = state(float(values[order[0]])), state(float(values[order[-1]]))
    found.append((ends[0], order[:1]))
    between(0, len(order) - 1, *ends)
    return found


def _with(states: Sequence[tuple[State, Any]], code: str, count: int) -> Mask:
    """Where a code is in the state."""
    mask: Mask = np.zeros(count, dtype=bool)
    for state, places in states:
        if code in state:
            mask[places] = True
    return mask
