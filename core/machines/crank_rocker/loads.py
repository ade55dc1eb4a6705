"""The loads of a crank-rocker: crank, coupler, rocker."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.machines.crank_rocker.design import CrankRocker
from gearlink.core.machines.crank_rocker.synthesis import class_of
from gearlink.core.parts.linkages.fourbar.mechanism import full_balance
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline
from gearlink.core.studies.loads.names import BALANCE

if TYPE_CHECKING:
    from gearlink.core.machines.crank_rocker.spec import CrankRockerSpec


class CrankRockerLoads(LoadsDesign):
    """Input angle: the crank's, from the line of the frame; loads are those of whole revolutions."""

    kind = "crank-rocker"
    spec: CrankRockerSpec
    links = ("crank", "coupler", "rocker")
    output = "rocker"
    pins, meshes = ("A", "B", "C", "D"), ()
    outlines = loads_outline(pins, meshes, BALANCE)

    @cached_property
    def design(self) -> CrankRocker:
        """The geometry.

        Raises
            NoSolution - where its crank does not turn fully, or moves within a range only
        """
        found = self.of_file(class_of(self.spec))
        if found.crank_range is not None:
            key = "range" if self.spec.range is not None else "function.pairs"
            message = "loads are computed for whole revolutions at constant speed"
            raise NoSolution(message, key=key, fix="omit range, and use links whose crank turns fully")
        return found

    def counterweights(self) -> dict[str, complex]:
        """Those of the full force balance."""
        return full_balance(self.design.linkage, self.masses)
