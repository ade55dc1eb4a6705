"""Dyads of a planar mechanism: two unknowns that close one pin, their transmission angle and their other closing.

Each unknown moves the closing pin, the direction of a link about its pivot or a place along a line; the transmission
angle is the angle between these two motions, 0 to 90 deg. It vanishes in the dyad's dead centres alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.machines.planar.structure import LineJoint, PinJoint, Structure
from gearlink.core.machines.planar.system import Jets, System, scaled
from gearlink.core.mechanism.blocks import Block
from gearlink.core.numerics.arrays import Points, Reals


class Swing(NamedTuple):
    """A closing point that turns about a pivot; both by body and place on it [size]."""

    pivot: tuple[int, complex]
    pin: tuple[int, complex]


class Along(NamedTuple):
    """A closing point that moves along a line of a body."""

    body: int
    direction: float


@dataclass(frozen=True)
class Dyad:
    """Two unknowns that close a pin.

    Fields
        block : the part of the equations
        bodies : numbers of its links
        ways : how each unknown moves the closing pin
    """

    block: Block
    bodies: tuple[int, ...]
    ways: tuple[Swing | Along, Swing | Along]

    def motions(self, jets: Jets, k: int) -> tuple[Points, Points]:
        """Coefficients of the two motions of the closing pin."""
        one, other = (_motion(way, jets, k) for way in self.ways)
        return one, other

    def angle(self, jets: Jets, k: int) -> Reals:
        """Taylor coefficients of the angle from the one motion to the other [rad], which never folds.

        L = log z, k L_k = (k z_k - sum_(j=1..k-1) j L_j z_(k-j))/z_0
        """
        pairs = [self.motions(jets, j) for j in range(k + 1)]
        z = [np.sum([np.conj(pairs[j][0]) * pairs[i - j][1] for j in range(i + 1)], axis=0) for i in range(k + 1)]
        if k == 0:
            return np.asarray(np.angle(z[0]))
        logs = [np.zeros_like(z[0])]
        for i in range(1, k + 1):
            logs.append((i * z[i] - sum(j * logs[j] * z[i - j] for j in range(1, i))) / (i * z[0]))
        return np.asarray(logs[k].imag)


def folded(angle: Any) -> Any:
    """The acute angle between two lines."""
    return np.minimum(np.abs(angle) % math.pi, math.pi - np.abs(angle) % math.pi)


def _motion(way: Swing | Along, jets: Jets, k: int) -> Points:
    if isinstance(way, Swing):
        return np.asarray(1j * (jets.point(*way.pin, k) - jets.point(*way.pivot, k)))
    return np.asarray(np.exp(1j * way.direction) * jets.e[k][:, way.body])


def dyads(structure: Structure, system: System) -> list[Dyad]:
    """The dyads among the parts of the equations of a mechanism."""
    joints = _joints(structure)
    found: dict[tuple[int, ...], Dyad] = {}
    for block in system.blocks:
        bodies = {column // 3 + 1 for column in block.columns}
        own = [each for each in system.blocks if {column // 3 + 1 for column in each.columns} & bodies]
        if any({column // 3 + 1 for column in each.columns} - bodies for each in own):
            continue
        rows = sorted(row for each in own for row in each.rows)
        made = _dyad(block, bodies, [joints.get(row) for row in rows], structure)
        if made is not None:
            known = found.get(made.bodies)
            if known is None or len(known.block.rows) < len(block.rows):
                found[made.bodies] = made
    return list(found.values())


class _Tie(NamedTuple):
    """An equation of a joint; of a slide `across` its line, or of the direction."""

    joint: PinJoint | LineJoint
    across: bool = False


def _joints(structure: Structure) -> dict[int, _Tie]:
    """By equation the joint that it is of; those of drives and meshes are left out."""
    ties = [_Tie(pin) for pin in structure.pins for _ in range(2)]
    ties += [_Tie(slide, across) for slide in structure.slides.values() for across in (True, False)]
    ties += [_Tie(slot, across=True) for slot in structure.slots.values()]
    return dict(enumerate(ties))


def _ends(joint: PinJoint | LineJoint) -> tuple[int, int]:
    return (joint.first, joint.second) if isinstance(joint, PinJoint) else (joint.line.body, joint.line.other)


def _dyad(block: Block, bodies: set[int], ties: list[_Tie | None], structure: Structure) -> Dyad | None:
    known = [tie for tie in ties if tie is not None]
    if len(known) != len(ties) or len(ties) != 3 * len(bodies):
        return None
    rows: dict[int, list[_Tie]] = {}  # by identity: of many mechanisms the sizes of a joint are arrays
    for tie in known:
        rows.setdefault(id(tie.joint), []).append(tie)
    whole = [own[0].joint for own in rows.values() if len(own) == 2]
    if len(bodies) == 1 and len(rows) == 2 and len(whole) == 1:
        (body,), ((tie,),) = bodies, (own for own in rows.values() if len(own) == 1)
        joint = tie.joint
        if not tie.across or not isinstance(joint, LineJoint):
            return None
        line = scaled(joint.line, structure.size)
        swing = _held_way(whole[0], body, (line.other, line.point), structure.size)
        return Dyad(block, (body,), (swing, Along(line.body, line.direction)))
    if len(bodies) == 2 and len(whole) == 3:
        return _of_two(block, tuple(sorted(bodies)), whole, structure.size)
    return None


def _held_way(joint: PinJoint | LineJoint, body: int, pin: tuple[int, complex], size: float) -> Swing | Along:
    """How a body that a joint leaves one freedom moves a point."""
    if isinstance(joint, PinJoint):
        place = joint.at_first if joint.first == body else joint.at_second
        return Swing((body, place / size), pin)
    return Along(joint.line.body, joint.line.direction)


def _of_two(block: Block, bodies: tuple[int, ...], joints: list[PinJoint | LineJoint], size: float) -> Dyad | None:
    one, other = bodies
    inner = [each for each in joints if {*_ends(each)} == {one, other}]
    rest = [each for each in joints if {*_ends(each)} != {one, other}]
    outer = {body: [each for each in rest if body in _ends(each)] for body in bodies}
    if len(inner) != 1 or any(len(each) != 1 for each in outer.values()):
        return None
    (joint,), (first,), (second,) = inner, outer[one], outer[other]
    if isinstance(joint, PinJoint):
        pins = {joint.first: joint.at_first / size, joint.second: joint.at_second / size}
        ways = _held_way(first, one, (one, pins[one]), size), _held_way(second, other, (other, pins[other]), size)
        return Dyad(block, bodies, ways)
    along = Along(joint.line.body, joint.line.direction)
    if isinstance(first, LineJoint) and isinstance(second, PinJoint):
        one, other, first, second = other, one, second, first
    if not isinstance(first, PinJoint):
        return None
    if isinstance(second, PinJoint):
        far = (other, (second.at_first if second.first == other else second.at_second) / size)
        return Dyad(block, bodies, (_held_way(first, one, far, size), along))
    return Dyad(block, bodies, (along, Along(second.line.body, second.line.direction)))


def mirrored(dyad: Dyad, x: Points, t: Reals) -> None:
    """Move the bodies of a dyad about to its other closing, in place; Newton's steps do the rest.

    Where one unknown swings, the closing pin is mirrored at the line from its pivot to that of the other, or across
    the foot of the pivot on the other's line.
    """
    jets = Jets([x[None].copy()], [t[None].copy()])
    one, other = dyad.ways
    if isinstance(one, Along):
        one, other = other, one
    if not isinstance(one, Swing):
        return  # two lines cross once
    pivot, pin = (complex(jets.point(*each, 0)[0]) for each in (one.pivot, one.pin))
    arm = pin - pivot
    if isinstance(other, Swing):
        base = complex(jets.point(*other.pivot, 0)[0])
        line = base - pivot
        image = pivot + np.conj(arm / line) * line if line else pin
        turned = {one.pivot[0]: (pivot, (image - pivot) / arm), other.pivot[0]: (base, (image - base) / (pin - base))}
        for body, (about, turn) in turned.items():
            _turn(x, t, body, about, complex(turn))
        return
    along = complex(np.exp(1j * other.direction) * jets.e[0][0, other.body])
    seen = arm / along
    image = -np.conj(seen) * along
    if other.body in dyad.bodies:  # the line turns with the link: the pin stays, the line comes from the other side
        for body in dyad.bodies:
            _turn(x, t, body, pivot, arm / image)
        return
    moved = image - arm
    for body in dyad.bodies:
        if body == one.pivot[0]:
            _turn(x, t, body, pivot, image / arm)
        else:
            x[body] += moved


def _turn(x: Points, t: Reals, body: int, about: complex, turn: complex) -> None:
    unit = turn / abs(turn) if turn else 1.0
    x[body] = about + (x[body] - about) * unit
    t[body] += float(np.angle(unit))
