"""What every source of a design file moves, and what it costs at the output."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.mechanism.dual import Dual, Shift
from gearlink.core.mechanism.joints import Flank, Toothed
from gearlink.core.mechanism.links import Mechanism
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.register.movable import Errors
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sources import Scatter

Off: TypeAlias = Mapping[str, Any] | None
"""Errors by source, of those on which the output depends beside the links."""


class Output(Protocol):
    """What is looked at, out of the links [mm], and its derivatives."""

    def __call__(self, mechanism: Mechanism, parts: Off = None, /) -> Sequence[Reals]:
        """The value and its derivatives, as many as the links have."""


@dataclass(frozen=True)
class Moves:
    """What the sources of a machine move.

    Fields
        errors : of sizes, by their keys - mm per mm, of angles per degree
        pins : what the play of a pin moves: along a link the part in its direction counts, in the frame it is a vector;
            of those that are left out the element on the first link, in the frame
        gears : by source, the link of the gear
        words : what a source should move, for those that do not
    """

    errors: Errors
    pins: Errors
    gears: Mapping[str, str]
    words: str

    def of(self, source: Scatter, mechanism: Mechanism) -> tuple[Shift, ...]:
        """The shifts of a source.

        Raises
            NoSolution - for a size that moves nothing
        """
        name = source.key.partition(".")[2]
        if source.kind == "pin":
            return self.pins[name] if name in self.pins else _play(name, mechanism)
        if source.kind == "gear":
            link = self.gears[name]
            teeth = [each for each in mechanism.connections if isinstance(each, (*Toothed, Flank))]
            return (Shift(link, tuple(each.name for each in teeth if link in (each.first, each.second))),)
        if source.key in self.errors:
            return self.errors[source.key]
        message = f"{source.key} does not move {self.words}"
        raise NoSolution(message, key="tolerance.sources", fix="use it in a file without register, or omit it")

    def is_vector(self, source: Scatter) -> bool:
        """Whether an error of it has any direction."""
        if source.kind != "pin":
            return source.kind == "gear"
        own = self.pins.get(source.key.partition(".")[2])
        return own is None or own[0].frame == "frame"


def _play(pin: str, mechanism: Mechanism) -> tuple[Shift, ...]:
    joint = next(each for each in mechanism.connections if each.name == pin)
    return (Shift(joint.first, (pin,), 1.0, "frame"),)


class Gains:
    """The gains of a machine over input angles.

    Parameters
        mechanism : Mechanism
        output : Output
        moves : Moves
        torque_sign : +1 or -1 - of what the machine puts on the output
    """

    def __init__(self, mechanism: Mechanism, output: Output, moves: Moves, torque_sign: int) -> None:
        self.mechanism, self.moves = mechanism, moves
        self.dual = Dual(mechanism, output, torque_sign)

    def of(self, source: Scatter) -> Any:
        """The gain of a source, complex for a vector."""
        shifts = self.moves.of(source, self.mechanism)
        if self.moves.is_vector(source):
            return sum(self.dual.vector_gain(shift) for shift in shifts)
        return sum(self.dual.gain(shift) for shift in shifts)

    def profile(self, contact: str, error: float) -> Contribution:
        """The error of a cam's profile under a roller: whatever its sign, each place has its own."""
        roller = next(each for each in self.mechanism.connections if each.name == contact)
        gain = np.abs(self.dual.gain(Shift(roller.second, (contact,), 1.0, "normal")))
        return Contribution("cam profile", gain, error, error / 3.0, relative=False)

    def backlash(self, plays: Mapping[str, float]) -> list[Contribution]:
        """Half of the backlash of each mesh, by which the driven member lags."""
        halves = {mesh: 0.5 * play for mesh, play in plays.items()}
        return [
            Contribution(f"backlash of {mesh}", self.dual.play(mesh), half, 0.0, mean=half)
            for mesh, half in halves.items()
        ]


def turning(link: str, radius: float, sense: float = 1.0) -> Output:
    """The way of a circle of a link that turns [mm], counted in a sense."""

    def output(mechanism: Mechanism, _parts: Off = None) -> Sequence[Reals]:
        return [sense * radius * rate for rate in mechanism.links[link].turn]

    return output
