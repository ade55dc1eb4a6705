"""Designs as manufactured of a planar mechanism: the play of its pins; all other sizes are keys of its file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from gearlink.core.base.design_axis import Evaluated
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.structure import Structure
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.studies.tolerance.sources import Parts

_PIN = "pins."


class PlayedMechanism(PlanarMechanism):
    """A planar mechanism whose pins are off by their play.

    Parameters
        spec : PlanarSpec
        plays : by pin - by how much the hole of the second body is off that of the first, in the frame [mm]
    """

    def __init__(self, spec: Any, plays: Mapping[str, complex]) -> None:
        super().__init__(spec)
        self.plays = dict(plays)
        vars(self)["structure"] = Structure(spec, self.plays)


class PlanarSamples:
    """Samples of a nominal design, each computed by itself; `core.studies.tolerance.axis.ToleranceAxis`.

    Parameters
        nominal : PlanarMechanism
    """

    extra: tuple[str, ...] = ()
    reference: float | None = None

    def __init__(self, nominal: PlanarMechanism) -> None:
        self.nominal = nominal
        self.parts = Parts({}, pins=tuple(pin.name for pin in nominal.structure.pins))

    def serves(self, _keys: Sequence[str], _names: Sequence[str]) -> bool:
        """Nothing is computed over arrays."""
        return False

    def sets(self, key: str) -> bool:
        """Whether a source is the play of a pin."""
        return key.startswith(_PIN)

    def design(self, values: Mapping[str, Any], cut: Any = None) -> PlayedMechanism:
        """The design of one sample."""
        spec = (self.nominal if cut is None else cut).spec
        made = PlayedMechanism(spec, {key.removeprefix(_PIN): value for key, value in values.items()})
        made.advises = False
        return made

    def evaluate(self, columns: Mapping[str, Reals | Points], names: Sequence[str]) -> Evaluated:
        """Not asked for, since nothing is served."""
        raise NotImplementedError

    def course(self, columns: Mapping[str, Reals | Points], input_angle: Reals) -> Reals:
        """Not asked for, since nothing is served."""
        raise NotImplementedError
