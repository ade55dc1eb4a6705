"""What a kind of design may bring: samples over arrays, and parts that scatter though no key of its file names them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from gearlink.core.base.design_axis import Evaluated
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.studies.tolerance.sources import Parts


class ToleranceAxis(Protocol):
    """Samples of one nominal design.

    parts : centre distances, pins and gears that may scatter beside the keys of the file; extra : quantities that only
    samples have; reference : input angle at which designs as made and nominal design are set to agree [deg], None: as
    they are
    """

    parts: Parts
    extra: tuple[str, ...]

    @property
    def reference(self) -> float | None:
        """Where the outputs are set to agree."""
        ...

    def serves(self, keys: Sequence[str], names: Sequence[str]) -> bool:
        """Whether these sources and quantities can be computed over arrays."""
        ...

    def sets(self, key: str) -> bool:
        """Whether a source is a size that `design` sets; the others are keys of the file."""
        ...

    def design(self, values: Mapping[str, Any], cut: Any = None) -> Any:
        """The design of one sample, of the class that computes it alone.

        Parameters
            values : by source, of those that it sets
            cut : the design with the sample's other keys; None: the nominal one
        """
        ...

    def evaluate(self, columns: Mapping[str, Reals | Points], names: Sequence[str]) -> Evaluated:
        """The designs as made.

        Parameters
            columns : (N,) arrays by source - sizes and centre distances as made, in the unit of the file; of a pin its
                offset as a vector x + i y [mm]
            names : of quantities
        Returns
            evaluated : Evaluated - findings of every check of the kind's analysis
        """
        ...

    def course(self, columns: Mapping[str, Reals | Points], input_angle: Reals) -> Reals:
        """By how much the outputs lie above that of the nominal design.

        Parameters
            columns : as `evaluate` takes them
            input_angle : (K,) array [rad]
        Returns
            off : (K, N) array [rad] - NaN where a design does not exist
        """
        ...
