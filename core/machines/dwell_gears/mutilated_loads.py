"""The loads of a mutilated-gear dwell: a four-bar that teeth drive for a part of the cycle and a lock holds else.

The speed of the driven gear jumps at both ends of the motion; the forces are those in between, the blows are given by
their energy.
"""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.design import geometry
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell
from gearlink.core.mechanism.dynamics import reduced
from gearlink.core.mechanism.links import Mechanism
from gearlink.core.mechanism.motion import TURN, Motion
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar
from gearlink.core.studies.loads.design import LoadsDesign, homecoming, loads_outline
from gearlink.core.studies.loads.sources import mass_of
from gearlink.core.studies.loads.spec import of_body

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.loads_spec import MutilatedLoads as Section
    from gearlink.core.machines.dwell_gears.mutilated_spec import MutilatedGearDwellSpec
    from gearlink.core.parts.linkages.fourbar.position import FourBar

_MOST_MOTIONS = 200


class MutilatedGearLoads(LoadsDesign):
    """Crank with the driven gear, coupler, rocker; the wheel turns evenly with the input."""

    kind = "mutilated-gear-dwell"
    spec: MutilatedGearDwellSpec
    section: Section
    links = ("crank", "coupler", "rocker")
    pins, meshes = ("A", "B", "C", "D"), ("mesh_wheel",)
    joints_of_period = True
    output, jumps = "rocker", True
    outlines = loads_outline(pins, meshes, ("engagement_energy",))
    design: cached_property[MutilatedGearDwell] = geometry(MutilatedGearDwell)

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar on the driven shaft."""
        if self.design.linkage is None:
            raise MissingSection("`loads` needs the four-bar on the driven shaft", key="links", fix="give links")
        return self.design.linkage

    @property
    def moving(self) -> Motion:
        """The motion of the links, which the file must give."""
        _ = self.linkage
        return self.design.moving

    @cached_property
    def turns(self) -> int:
        """Input turns until input and linkage are both back at their place.

        Raises
            NoSolution - where they are more, or hold more motions, than are computed
        """
        cycles = Fraction(self.design.reduction).limit_denominator(10_000) / self.spec.gears.groups
        turns = (cycles * self.design.cycles_to_repeat).numerator
        if not cycles or turns > _MOST_MOTIONS * cycles:
            raise NoSolution(
                f"the motion repeats only after more than {_MOST_MOTIONS} starts, which are not computed",
                key="reduction",
                fix="use a reduction of small whole numbers",
            )
        return homecoming(turns, "input and linkage return to their start", "reduction", "round the reduction")

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """The bearing of the driven gear, where the file does not say on which side the wheel stands."""
        return () if self.section.wheel_direction is not None else ("A",)

    @property
    def shaft_inertia(self) -> float:
        """The wheel's, which turns once in `reduction` input turns.

        Raises
            NoSolution - of a wheel out of balance: its weight and its force on W are in no result
        """
        wheel = mass_of(of_body(self.section.links, "wheel"))
        if wheel.mass and wheel.center:
            message = (
                f"centre of mass of the wheel: {short(abs(wheel.center))} mm off its axis (limit 0: it is balanced)"
            )
            fix = "omit it, and add mass times center^2 to inertia"
            raise NoSolution(message, key="loads.links.wheel.center", fix=fix)
        return wheel.inertia / self.design.reduction**2

    @property
    def own_joints(self) -> list[float]:
        """Input angles of the period at which a motion begins or ends [rad]."""
        home = self.moving.input
        return [turn * home.end + joint for turn in range(round(TURN * self.turns / home.end)) for joint in home.joints]

    # Jumps of speed

    @cached_property
    def engagement_energy(self) -> float:
        """Energy that a start of the motion costs, the hardest one [J]; its end leaves as much in the lock.

        E = J_red w_F^2/2,  J_red of all links at the driven shaft
        """
        count = self.design.cycles_to_repeat
        first = self.design.start_crank_angle or 0.0
        starts = np.arange(count, dtype=np.float64) * (TURN * self.design.driven_turn) + first
        links = four_bar(self.linkage, starts, 2)
        found = reduced(Mechanism(links, [], "crank"), self.masses, [], 0j)
        driven = self.speed * self.design.mutilated.speed_ratio
        return float(np.max(found.inertia)) * driven**2 / 2.0
