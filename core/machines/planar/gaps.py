"""The gears and shafts of a planar mechanism, of one or of many, and how near their axes come.

An axis is a point of a body; one that a pin joins to other bodies is that of the first of them.
"""

from __future__ import annotations

from collections.abc import Container, Iterator
from functools import reduce
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from gearlink.core.machines.planar.structure import GearJoint, RackJoint, Structure
from gearlink.core.machines.planar.system import Jets
from gearlink.core.machines.planar.wiring import FRAME
from gearlink.core.studies.clearance import (
    FULL_HEIGHT,
    Gear,
    Layout,
    Shaft,
    gear_meetings,
    least_shaft,
    reaches,
    shaft_meetings,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from gearlink.core.machines.planar.design import PlanarMechanism
    from gearlink.core.numerics.arrays import Reals

Axis: TypeAlias = tuple[str, str]
"""A body and a point of it."""

_RIM = 2.0
"""Modules outside the root circle of a ring."""
_FIRST = 0x100
"""Axes are letters to the clearance: beyond those that a file may name."""


class Placed(NamedTuple):
    """Gears and shafts, taken to lie in one plane; sizes of many mechanisms are (N,) arrays.

    Fields
        axes : by letter
        least_shaft : float [mm] - radius of the thinnest shaft that would be built
    """

    gears: tuple[Gear, ...]
    shafts: tuple[Shaft, ...]
    axes: dict[str, Axis]
    least_shaft: Any

    @property
    def meetings(self) -> Iterator[tuple[Gear | Shaft, Gear | Shaft]]:
        """Gears that do not mesh, then gears and shafts, then shafts; those of one axis left out."""
        for pairs in (gear_meetings(self.gears), shaft_meetings(self.gears, self.shafts)):
            yield from ((one, other) for one, other in pairs if one.axis != other.axis)


class _Axes:
    """Letters of axes, in the order in which they are asked for."""

    def __init__(self, structure: Structure) -> None:
        self.bodies, self.letters = structure.spec.bodies, dict[Axis, str]()

    def _first(self, body: str, point: str) -> str:
        """The first point of a body that lies where this one does."""
        points = self.bodies[body]
        return next(name for name, at in points.items() if at == points[point])

    def key(self, body: str, point: str) -> Axis:
        """The axis at a point; one that a pin joins to another body is that body's."""
        point = self._first(body, point)
        holder = next(name for name, points in self.bodies.items() if point in points)
        return holder, self._first(holder, point)

    def letter(self, body: str, point: str) -> str:
        """That of an axis."""
        return self.letters.setdefault(self.key(body, point), chr(_FIRST + len(self.letters)))


def placed(structure: Structure) -> Placed | None:
    """The gears and shafts; None where there are none.

    Notes
        Gears have standard teeth without shift, tips at z m/2 + m. A gear passes its shaft where its link turns on it.
    """
    spec, axes, found = structure.spec, _Axes(structure), dict[tuple[str, str], Gear]()
    for name, mesh in structure.meshes.items():
        at = spec.meshes[name].at
        if isinstance(mesh, RackJoint):
            body = structure.names[mesh.line.other]
            _add(found, body, _pinion(body, axes.letter(body, str(at)), mesh))
            continue
        letters = [axes.letter(structure.names[mesh.carrier], point) for point in at]
        for k, number in enumerate((mesh.first, mesh.second)):
            body = structure.names[number] if number else name
            _add(found, body, _gear(mesh, k, body, letters))
    if not found and not spec.shafts:
        return None
    gears = [gear._replace(turns_with=_shafts_of(axes, body)) for (body, _), gear in found.items()]
    shafts = [
        Shaft(f"shaft at {point}", axes.letter(FRAME, point), spec.shafts.get(key), f"shafts.{key}")
        for point, key in ((point, f"{point}_radius") for point in spec.frame)
        if key in spec.shafts or any(gear.axis == axes.letters.get(axes.key(FRAME, point)) for gear in gears)
    ]
    module = reduce(_larger, (mesh.module for mesh in structure.meshes.values()), 0.0)
    letters_of = {letter: axis for axis, letter in axes.letters.items()}
    return Placed(tuple(gears), tuple(shafts), letters_of, least_shaft(spec.limits, module))


def layout(design: PlanarMechanism) -> Layout | None:
    """The gears and shafts of a design, and how near their axes come over its motion; None where there are none."""
    structure, found = design.structure, placed(design.structure)
    if found is None:
        return None
    axes = {letter: (body, structure.bodies[body][point]) for letter, (body, point) in found.axes.items()}
    pairs = sorted(one + other for one in axes for other in axes if one < other)
    apart = reaches(design.moving, axes, pairs, samples=design.course.samples)
    return Layout(found.gears, found.shafts, apart, found.least_shaft)


def _larger(one: Any, other: Any) -> Any:
    """Of numbers or of arrays."""
    return max(one, other) if isinstance(one, float) and isinstance(other, float) else np.maximum(one, other)


def _add(found: dict[tuple[str, str], Gear], body: str, gear: Gear) -> None:
    """A gear, or more mates of one that is there."""
    known = found.get((body, gear.axis))
    found[body, gear.axis] = (
        gear
        if known is None
        else known._replace(mates=known.mates + gear.mates, outer=_larger(known.outer, gear.outer))
    )


def _pinion(body: str, axis: str, mesh: RackJoint) -> Gear:
    tip = mesh.radius + mesh.module
    return Gear(f"the pinion {body}", axis, tip, root=tip - FULL_HEIGHT * mesh.module)


def _gear(mesh: GearJoint, k: int, body: str, letters: list[str]) -> Gear:
    teeth, mate = mesh.teeth[k], letters[1 - k]
    pitch = 0.5 * mesh.module * abs(teeth)
    if teeth < 0:
        outer = pitch + (0.5 * FULL_HEIGHT + 0.125 + _RIM) * mesh.module
        return Gear(f"the ring {body}", letters[k], outer, pitch - mesh.module, mate)
    tip = pitch + mesh.module
    return Gear(f"the gear {body}", letters[k], tip, mates=mate, root=tip - FULL_HEIGHT * mesh.module)


def _shafts_of(axes: _Axes, body: str) -> str:
    """Letters of the axes of the frame that the gear's own link turns on."""
    points, frame = axes.bodies.get(body, {}), axes.bodies[FRAME]
    return "".join(axes.letters.get(axes.key(FRAME, point), "") for point in points if point in frame)


def carrier(structure: Structure, one: Axis, other: Axis, played: Container[str]) -> str | None:
    """The body that holds both axes, whatever moves; None without one.

    Parameters
        played : names of pins with play, whose place on their second body is no longer that of the axis
    """
    for body in structure.spec.bodies:
        if all(_is_held(structure, axis, body, played) for axis in (one, other)):
            return body
    return None


def _is_held(structure: Structure, axis: Axis, body: str, played: Container[str]) -> bool:
    holder, point = axis
    pins = [name for name, (_, other) in structure.pins_at(point).items() if other == body]
    return pins[0] not in played if pins else body == holder


def squared_distance(structure: Structure, one: Axis, other: Axis) -> Callable[[Jets, int], Reals]:
    """Taylor coefficients of the square of how far two axes are apart, in units of the structure's size [mm]."""
    size = structure.size
    (a, p), (b, r) = ((structure.numbers[body], structure.bodies[body][point] / size) for body, point in (one, other))

    def coefficient(jets: Jets, k: int) -> Reals:
        apart = [jets.point(b, r, j) - jets.point(a, p, j) for j in range(k + 1)]
        return np.asarray(size * sum((np.conj(apart[j]) * apart[k - j]).real for j in range(k + 1)))

    return coefficient


def axes_that_may_meet(structure: Structure) -> Mapping[str, tuple[Axis, Axis]]:
    """By a name of its own, each two axes of bodies that may meet."""
    found = placed(structure)
    if found is None:
        return {}
    return {name_of(one, other): (found.axes[one.axis], found.axes[other.axis]) for one, other in found.meetings}


def name_of(one: Gear | Shaft, other: Gear | Shaft) -> str:
    """What the number that tells how far the axes of two bodies are apart is called."""
    return " ".join(("axes", *sorted((one.axis, other.axis))))


class Tops:
    """The highest and the lowest vertices of curves over even places of a period, each through three values beside.

    Parameters
        shape : of the values of a place
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.count, self.last = 0, list[Any]()
        self.best = {sign: np.full(shape, -np.inf) for sign in (1.0, -1.0)}
        self.at = {sign: np.zeros(shape, dtype=np.intp) for sign in (1.0, -1.0)}

    def add(self, values: Reals) -> None:
        """The values of the next place; those of the first two once more at the end."""
        self.last = [*self.last[-2:], values]
        self.count += 1
        if self.count < 3:
            return
        before, here, after = self.last
        bend = 2.0 * here - before - after
        with np.errstate(all="ignore"):
            beyond = np.where(bend != 0.0, (after - before) ** 2 / (8.0 * bend), 0.0)
        for sign, best in self.best.items():
            tops = (sign * here >= sign * before) & (sign * here >= sign * after)
            height = np.where(tops, sign * (here + beyond), -np.inf)
            self.at[sign] = np.where(height > best, self.count - 2, self.at[sign])
            self.best[sign] = np.maximum(best, height)
