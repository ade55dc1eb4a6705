"""The mechanism of a cycloidal reducer: eccentric, discs, output; its outlines for pictures."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.cycloidal.disc import TURN
from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import NEWTON_METER, Act, Connection, Contact, Pin, Shared
from gearlink.core.mechanism.links import FRAME, Later, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import fixed, steady
from gearlink.core.numerics.arrays import Points, Reals, units
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.cycloidal.design import CycloidalReducer


def motion(design: CycloidalReducer) -> Motion:
    """Links and joints over the angle of the eccentric, the ring's centre at 0; a ring pin stands at angle 0.

    Ring and output pins act as the resultants of those that push: at the pitch point, and along the eccentricity.
    """
    disc, spec = design.disc, design.spec
    held = spec.fixed == "output"

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        turns = [TURN * k / spec.discs for k in range(spec.discs)]
        rate = 0.0 if held else -1.0 / disc.lobes
        axis = fixed(0j, phi, order=order)
        ends = {f"E{k}": spec.eccentricity * complex(np.exp(1j * at)) for k, at in enumerate(turns, 1)}
        links = {"eccentric": Link(axis, steady(phi, order=order), ends)}
        for k, at in enumerate(turns, 1):
            start = -at / disc.lobes
            links[f"disc_{k}"] = Link(links["eccentric"].at(f"E{k}"), steady(phi, rate, start, order=order))
        links["output"] = Link(axis, steady(phi, 1.0 / disc.pins if held else rate, order=order))
        return Mechanism(links, Later(lambda: _joints(design, links, phi, turns)), "eccentric")

    whole = TURN * abs(design.ratio)
    course = turned("output")
    return Motion(make, Input("input_angle", end=whole, turns=abs(design.ratio)), (Output("Output", course),))


def _joints(design: CycloidalReducer, links: dict[str, Link], phi: Reals, turns: list[float]) -> list[Connection]:
    """Bearings, the pins of the ring, and those of the output, which share among the discs evenly."""
    disc, held = design.disc, design.spec.fixed == "output"
    axis = links["eccentric"].origin.value
    joints: list[Connection] = [Pin("A", FRAME, "eccentric", axis), Pin("D", FRAME, "output", axis)]
    acts: list[Act] = []
    back: list[Act] = []
    for k, at in enumerate(turns, 1):
        name, way = f"disc_{k}", units(phi + at)
        joints.append(Pin(f"E{k}", "eccentric", name, links[name].origin.value))
        # seen from the ring, which turns by phi/Z where the output is held
        seen = phi * (disc.lobes / disc.pins) + at if held else phi + at
        # torque the other way: the mirror image, by the pins that stand there
        push, mirrored = (_direction(disc.shares(np.asarray(sense * seen)).of_ring) for sense in (1.0, -1.0))
        place = np.asarray(disc.eccentricity * disc.pins * way)
        first = "output" if held else FRAME
        joints.append(
            Contact(f"ring_{k}", first, name, place, push * way, (place, np.asarray(-np.conj(mirrored) * way)))
        )
        pins = np.zeros_like(phi) if held else links["output"].turn.value
        angle, center = np.asarray(phi + at - pins), links[name].origin.value
        acts += _outputs(design, name, way, angle, center, 1.0)
        back += _outputs(design, name, way, angle, center, -1.0)
    first, second = (FRAME, "disc_1") if held else ("disc_1", "output")
    both = None if design.spec.output_pins is None else tuple(back)
    joints.append(Shared("output_pins", first, second, axis, tuple(acts), both))
    return joints


def _direction(force: Points) -> Points:
    return np.asarray(force / np.abs(force))


def _outputs(design: CycloidalReducer, name: str, way: Points, angle: Reals, center: Points, sense: float) -> list[Act]:
    """What a N m of the output pins gives on a disc, and the opposite on the output.

    They push along the eccentricity from the disc's centre to the ring's, on the half that carries while the input
    drives (sense +1) or is driven (-1); without output pins in the file a couple stands for them.
    """
    held, given = design.spec.fixed == "output", design.spec.output_pins
    if given is None:
        couple = [Act(name, 0j, center, NEWTON_METER)]
        return couple if held else [*couple, Act("output", 0j, center, -NEWTON_METER)]
    shares = design.disc.shares(np.asarray(sense * angle), given.count, given.circle_radius).outputs
    total = sense * np.sum(shares, axis=1)
    at = np.asarray(center + 1j * way / total)
    force = np.asarray(-way * total * NEWTON_METER)
    on_disc = [Act(name, force, at, 0.0)]
    return on_disc if held else [*on_disc, Act("output", -force, at, 0.0)]


def errors(design: CycloidalReducer, _mechanism: Mechanism) -> Movable:
    """The eccentricity; the error is measured at the pin circle where the file says nothing else."""
    sizes = {"eccentricity": tuple(Shift("eccentric", (f"E{k}",), 1.0) for k in range(1, design.spec.discs + 1))}
    return Movable(sizes, radius=design.spec.pin_circle_radius)
