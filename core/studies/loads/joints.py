"""Load of a pin over the period, and of a mesh, and where torque or teeth change sides."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.base.results import cached_property, keep, kept
from gearlink.core.mechanism.joints import Pin, ToothDrive, meshes_of
from gearlink.core.mechanism.links import Mechanism, rates
from gearlink.core.numerics.arrays import BLOCK, Points, Reals
from gearlink.core.numerics.roots_sweep import zeros, zeros_of
from gearlink.core.studies.loads.machine import Machine
from gearlink.core.studies.loads.panels import Panels

if TYPE_CHECKING:
    from gearlink.core.studies.loads.design import LoadsDesign
    from gearlink.core.studies.loads.spec import Bearing


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
    for k, crossings in zip(loaded, every, strict=True):
        f, size = functions[k]
        if not machine.stroke and (not crossings or min(crossings[0], machine.period - crossings[-1]) > _STEP):
            # The ends of the period are one place: a sign that changes there is seen from neither side.
            first, last = f(np.array([_STEP, machine.period - _STEP]))
            if first * last < 0.0 and min(abs(first), abs(last)) > NOISE * size:
                crossings.insert(0, 0.0)
    # all look at both sides of the crossings of all: what they share is computed once
    sides = np.array([place + step for crossings in every for place in crossings for step in (-_STEP, _STEP)])
    sides, first_side = sides if machine.stroke else np.mod(sides, machine.period), 0
    for k, crossings in zip(loaded, every, strict=True):
        own = slice(first_side, first_side := first_side + 2 * len(crossings))
        if crossings:
            f, size = functions[k]
            found[k] = _changes(f, crossings, size, machine, _without_noise(f, size, sides)[own])
    return found


def _without_noise(f: Function, size: float, phi: Reals) -> Reals:
    values = f(phi)
    return np.where(np.abs(values) <= NOISE * size, 0.0, values)


def _changes(f: Function, zeros: list[float], size: float, machine: Machine, values: Reals) -> list[float]:
    """The places with opposite signs on both sides; in between f may be 0 over a way, as in the dwell of a cam.

    Parameters
        values : (2 N,) array - before and behind each of the zeros
    """
    before, after = values[::2], values[1::2]
    if not np.all(before * after):
        signs = _signs_between(f, zeros, size, machine)
        before, after = signs[:-1], signs[1:]
    return [place for place, each in zip(zeros, before * after < 0.0, strict=True) if each]


def _signs_between(f: Function, zeros: list[float], size: float, machine: Machine) -> Reals:
    """Sign of f before the first zero, between them and behind the last one; 0 where it is nothing all the way."""
    grid = np.linspace(0.0, machine.period, 720 * machine.turns + 1)
    values, of = _without_noise(f, size, grid), np.searchsorted(zeros, grid)
    ways = [values[of == k] for k in range(len(zeros) + 1)]
    if not machine.stroke:  # the last way goes on as the first one
        ways[0] = ways[-1] = np.concatenate((ways[-1], ways[0]))
    return np.array([np.sign(way[np.argmax(np.abs(way))]) if way.size else 0.0 for way in ways])


BALL, ROLLER = 3.0, 10.0 / 3.0
_NOISE = 1e-9


class BearingLoad:
    """What a bearing bears: its rating life, or its pressure where it is a plain one.

    Fields
        bearing : Bearing of the file, or None
    """

    design: LoadsDesign
    bearing: Bearing | None

    if TYPE_CHECKING:

        @property
        def peak(self) -> float | None: ...
        @property
        def equivalent(self) -> float | None: ...
        @property
        def travel(self) -> float: ...

    @property
    def exponent(self) -> float:
        """3 for balls, 10/3 for rollers and needles."""
        kind = "ball" if self.bearing is None else self.bearing.kind
        return ROLLER if kind in ("roller", "needle") else BALL

    @cached_property
    def life(self) -> float | None:
        """Rating life of the file's bearing at its reliability [h]; None where it gives none, or a plain one.

        L_n = a_1 (C/P)^p 10^6 relative turns
        """
        bearing = self.bearing
        if bearing is None or bearing.dynamic_rating is None or not self.equivalent:
            return None
        turns = bearing.reliability_factor * (bearing.dynamic_rating / self.equivalent) ** self.exponent * 1e6
        per_hour = self.travel * abs(self.design.speed) / (2.0 * math.pi) * 3600.0
        return float(turns / per_hour)

    @property
    def bearing_pressure(self) -> float | None:
        """Maximum pressure of a plain bearing, F/(b d) [N/mm^2]."""
        bearing = self.bearing
        if bearing is None or bearing.width is None or bearing.diameter is None or self.peak is None:
            return None
        return float(self.peak / (bearing.width * bearing.diameter))


class PinLoad(BearingLoad):
    """A pin's force and its relative turning.

    Parameters
        bearing : Bearing of the file, or None
    """

    def __init__(self, design: LoadsDesign, name: str, bearing: Bearing | None) -> None:
        self.design, self.name, self.bearing = design, name, bearing

    def force(self, phi: Reals) -> Points:
        """Force on the second link [N]."""
        return self.design.machine.reactions(phi).force(self.name)

    def size(self, phi: Reals) -> Reals:
        """Its magnitude [N]."""
        return np.asarray(np.abs(self.force(phi)))

    def rate(self, phi: Reals) -> Reals:
        """Relative turning per input angle."""
        return self._rate(self.design.machine.at(phi))

    def _rate(self, mechanism: Mechanism) -> Reals:
        pin = next(each for each in mechanism.connections if each.name == self.name)
        assert isinstance(pin, Pin), "only pins are evaluated"
        return rates(mechanism, pin.first, pin.second)

    @cached_property
    def known(self) -> bool:
        """Whether its force can be had; not where a direction that it depends on is unknown."""
        return self.name not in self.design.unknown_joints

    @cached_property
    def peak(self) -> float | None:
        """Maximum force [N]."""
        return self.design.extreme_of(f"pin_{self.name}").value if self.known else None

    @cached_property
    def reversals(self) -> list[float]:
        """Input angles where the relative turning changes its sense [rad]."""
        machine = self.design.machine
        return zeros(self.rate, machine.period, machine.turns)

    @cached_property
    def way(self) -> float:
        """Relative turning over the period, both senses counted [rad]."""
        find_ways(self.design.machine, [self], pressed=False)
        return float(kept(self, "way")["way"])

    @cached_property
    def _borne(self) -> float:
        """|F|^p over that way, F in shares of the peak [rad]."""
        find_ways(self.design.machine, [self])
        return float(kept(self, "_borne")["_borne"])

    @cached_property
    def equivalent(self) -> float | None:
        """(int |F|^p |dt| / int |dt|)^(1/p) [N], over the relative turning; None for a pin that does not turn."""
        if not self.known or self.way == 0.0:
            return None
        return float((self.peak or 0.0) * (self._borne / self.way) ** (1.0 / self.exponent))

    @property
    def travel(self) -> float:
        """Relative turns per input turn, both senses counted."""
        return self.way / self.design.machine.period

    def rates_of(self, machine: Machine, phi: Reals, *, pressed: bool) -> tuple[Reals, ...]:
        """Relative turning per input angle of both senses, and that times |F/peak|^p where `pressed`."""
        mechanism = machine.at(phi)
        way = np.abs(self._rate(mechanism))
        if not pressed:
            return (way,)
        force = machine.reactions(phi).force(self.name)
        return way, way * (np.abs(force) / (self.peak or 1.0)) ** self.exponent

    @cached_property
    def swing(self) -> float | None:
        """Angle of the oscillation [rad]; None for a pin that goes round."""
        if not self.reversals:
            return None
        edges = sorted({0.0, self.design.machine.period, *self.reversals})
        panels = Panels.over(self.design.machine.period, edges[1:-1])
        running = panels.running(self.rate(panels.nodes))
        return float(running.max() - running.min())


class MeshLoad:
    """A mesh's tangential force over the period."""

    def __init__(self, design: LoadsDesign, name: str) -> None:
        self.design, self.name = design, name

    def force(self, phi: Reals) -> Reals:
        """F_t on the second gear [N]."""
        found = self.design.machine.reactions(phi)
        mesh = next(each for each in meshes_of(found.mechanism) if each.name == self.name)
        share = mesh.moves if isinstance(mesh, ToothDrive) else 1.0
        return np.asarray(found.unknowns[self.name][0] * share)

    def size(self, phi: Reals) -> Reals:
        """Its magnitude [N]."""
        return np.asarray(np.abs(self.force(phi)))

    @cached_property
    def _mesh(self) -> Any:
        return next(mesh for mesh in meshes_of(self.design.machine.at(np.zeros(1))) if mesh.name == self.name)

    @property
    def radius(self) -> float:
        """Pitch radius of the second gear [mm]."""
        return float(self._mesh.mate_radius)

    @property
    def second(self) -> str:
        """The link of the second gear."""
        return str(self._mesh.second)

    @cached_property
    def tooth_force_max(self) -> float:
        """Maximum magnitude of the tangential force [N]."""
        return self.design.extreme_of(self.name).value

    @cached_property
    def tooth_force_back(self) -> float:
        """Maximum force on the flanks that carry less [N]; 0 where the teeth never change flanks."""
        low, high = (self.design.extreme(self.force, greatest).value for greatest in (False, True))
        back = min(-low, high)
        return back if back > _NOISE * self.tooth_force_max else 0.0

    @cached_property
    def reversal_places(self) -> list[float]:
        """Input angles where the teeth change flanks [rad]."""
        return places(self.force, self.design.machine, self.tooth_force_max)

    @property
    def reversals(self) -> int:
        """How often the teeth change flanks over the period."""
        return len(self.reversal_places)


def find_reversals(
    machine: Machine, pins: Sequence[PinLoad], meshes: Sequence[MeshLoad], others: Sequence[tuple[Function, float]] = ()
) -> list[list[float]]:
    """Search the reversals of pins together, and the changes of flanks of meshes, and keep them there.

    Parameters
        others : functions with their sizes, as of `places_of`, whose changes of sign are wanted as well
    Returns
        places : input angles of those of each of them [rad]; a torque with friction comes with the forces of the meshes
    """
    turning = [pin for pin in dict.fromkeys(pins) if pin.known and not kept(pin, "reversals")]
    for pin, found in zip(turning, zeros_of([pin.rate for pin in turning], machine.period, machine.turns), strict=True):
        keep(pin, reversals=found)
    rolling = [mesh for mesh in dict.fromkeys(meshes) if not kept(mesh, "reversal_places")]
    places = places_of([*((mesh.force, mesh.tooth_force_max) for mesh in rolling), *others], machine)
    for mesh, found in zip(rolling, places, strict=False):
        keep(mesh, reversal_places=found)
    return places[len(rolling) :]


def find_ways(machine: Machine, pins: Sequence[PinLoad], *, pressed: bool = True) -> None:
    """Integrate the turning of pins over the period, and what they bear meanwhile, and keep it there.

    Notes
        All look at the machine's panels, whose links and forces are computed once, a block of panels after the other. A
        panel in which a pin turns back is looked at anew in parts.
    """
    asked = [(pin, pressed and pin.known) for pin in dict.fromkeys(pins)]
    asked = [(pin, with_force) for pin, with_force in asked if not _has_way(pin, with_force)]
    if not asked:
        return
    panels, torques = machine.panels, []
    parts: list[list[Reals]] = [[] for _ in asked]
    many, whole_period = panels.nodes.size > 2 * BLOCK, slice(0, len(panels.edges) - 1)
    blocks = machine.by_blocks(whole_period.stop, max(1, BLOCK // panels.order)) if many else [(whole_period, machine)]
    for rows, part in blocks:
        some = panels.some(rows) if many else panels
        for found, (pin, with_force) in zip(parts, asked, strict=True):
            found.append(np.array([some.each(v) for v in pin.rates_of(part, some.nodes, pressed=with_force)]))
        if machine.friction is not None and any(with_force for _, with_force in asked):
            torques.append(part.reactions(some.nodes).torque)
    if torques:
        machine.hold_torque(panels.nodes, np.concatenate(torques))
    for found, (pin, with_force) in zip(parts, asked, strict=True):
        sums = np.concatenate(found, axis=1)
        cut, more = panels.cut(pin.reversals)
        sums[:, cut] = 0.0
        again = [more.each(v) for v in pin.rates_of(machine, more.nodes, pressed=with_force)] if len(cut) else []
        whole = [math.fsum([*one, *(again[i] if again else ())]) for i, one in enumerate(sums.tolist())]
        keep(pin, **dict(zip(("way", "_borne"), whole, strict=False)))


def _has_way(pin: PinLoad, pressed: bool) -> bool:
    return bool(kept(pin, "_borne" if pressed else "way"))
