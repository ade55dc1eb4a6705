"""The loads of a three-gear four-bar: its links, its joints, its two meshes."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import geometry
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.parts.linkages.fourbar.mechanism import full_balance
from gearlink.core.studies.loads.design import LoadsDesign, homecoming, is_directed, loads_outline
from gearlink.core.studies.loads.names import BALANCE

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.loads_spec import ThreeGearLoads as Section
    from gearlink.core.machines.three_gear.spec import ThreeGearSpec

_PINS = ("A", "B", "C", "C_idler", "D", "D_output")
_MESHES = ("mesh_13", "mesh_35")


class ThreeGearLoads(LoadsDesign):
    """Crank with gear 1, coupler, rocker, idler on C, output gear on D."""

    kind = "three-gear-four-bar"
    spec: ThreeGearSpec
    section: Section
    links = ("crank", "coupler", "rocker", "idler", "output")
    pins, meshes = _PINS, _MESHES
    outlines = loads_outline(_PINS, _MESHES, BALANCE)

    def __init__(self, spec: Any) -> None:
        super().__init__(KINDS[self.kind].completed(spec))

    design: cached_property[ThreeGearFourBar] = geometry(ThreeGearFourBar)

    @cached_property
    def turns(self) -> int:
        """Crank turns until idler and output gear are home, where their directions matter."""
        if self.design.linkage.kind() == "drag-link":  # all links and gears turn once
            return 1
        train = self.design.train
        gears = {
            "idler": Fraction(int(train.crank), int(train.idler)),
            "output": Fraction(int(train.crank), int(train.output)),
        }
        turns = math.lcm(*(turn.denominator for name, turn in gears.items() if is_directed(self.section, name)))
        return homecoming(turns, "idler and output gear are back in their initial positions", "gears.idler")

    @property
    def motion_turns(self) -> int:
        """The links are home after every revolution."""
        return 1

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwell: within the tolerance where the file gives one, else the back-step and the return stroke."""
        zone = self.design.dwell_stretch
        if zone is not None and self.design.tolerance_dwell is None and self.speed < 0.0:
            # Backwards the back-step begins where it ends forwards, and the way back follows there: as in the mirror.
            found = ThreeGearFourBar(self.spec.model_copy(update={"assembly": -self.spec.assembly})).dwell_stretch
            zone = None if found is None else (-found[0] - found[1], found[1])
        if zone is None:
            return []
        return [(zone[0] + 2.0 * math.pi * turn, zone[1]) for turn in range(self.turns)]

    def counterweights(self) -> dict[str, complex]:
        """Those of the full force balance; the idler counts at C."""
        idler = self.masses.get("idler")
        return full_balance(self.design.linkage, self.masses, 0.0 if idler is None else idler.mass)
