"""The loads of a mutilated-gear dwell: a four-bar that teeth drive for a part of the cycle and a lock holds else.

The speed of the driven gear jumps at both ends of the motion; the forces are those in between, the blows are given by
their energy.
"""

from __future__ import annotations

import cmath
import math
from fractions import Fraction
from typing import TYPE_CHECKING

from gearlink.core.dwell_gears.mutilated_design import MutilatedGearDwell
from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.loads.design import LoadsDesign, loads_outline
from gearlink.core.loads.periods import homecoming
from gearlink.core.loads.sources import mass_of
from gearlink.core.loads.spec import of_body
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.dwell_gears.loads_spec import MutilatedLoads as Section
    from gearlink.core.dwell_gears.mutilated_spec import MutilatedGearDwellSpec
    from gearlink.core.linkages.fourbar.position import FourBar
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * math.pi
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

    @cached_property
    def design(self) -> MutilatedGearDwell:
        """The geometry."""
        return MutilatedGearDwell(self.spec)

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar on the driven shaft."""
        if self.design.linkage is None:
            raise MissingSection("`loads` needs the four-bar on the driven shaft: give links", key="links")
        return self.design.linkage

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
                f"the linkage starts more than {_MOST_MOTIONS} times until it and the input come home together: round "
                "the reduction, or give a larger one",
                key="reduction",
            )
        return homecoming(turns, "input and linkage come home together", "reduction", "round the reduction")

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """The bearing of the driven gear, where the file does not say on which side the wheel stands."""
        return () if self.section.wheel_direction is not None else ("A",)

    @property
    def shaft_inertia(self) -> float:
        """The wheel's, which turns once in `reduction` input turns."""
        return mass_of(of_body(self.section.links, "wheel")).inertia / self.design.reduction**2

    @cached_property
    def own_joints(self) -> list[float]:
        """Input angles of all turns at which a motion begins or ends [rad]."""
        cycle, motion = _TURN * self.design.cycle_turns, _TURN * self.design.motion_turns
        count = round(self.turns / self.design.cycle_turns)
        return [start for k in range(count) for start in (k * cycle, k * cycle + motion)]

    def _driven(self, phi: Reals) -> tuple[Reals, Reals]:
        """Angle of the driven gear [rad], and whether it moves, as 1 or 0."""
        import numpy as np

        gear = self.design.mutilated
        cycle, step = _TURN * gear.cycle_turns, _TURN * gear.driven_turn
        rest = np.mod(phi, cycle)
        # A place that is the start of a motion but for rounding is the start.
        rest = np.where(cycle - rest <= 8.0 * np.spacing(np.maximum(np.abs(phi), cycle)), 0.0, rest)
        whole = np.round((phi - rest) / cycle)
        moves = np.where(rest < _TURN * gear.motion_turns, 1.0, 0.0)
        # within a cycle the gear turns by one step, and then stands
        return np.asarray(whole * step + np.minimum(gear.speed_ratio * rest, step)), moves

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The three links at input angles."""
        from gearlink.core.mechanism.joints import ToothDrive
        from gearlink.core.mechanism.links import Link, Mechanism
        from gearlink.core.mechanism.rates import Point, Turn

        angle, moves = self._driven(phi)
        crank = (self.design.start_crank_angle or 0.0) + angle
        rate = moves * self.design.mutilated.speed_ratio
        links = {
            name: Link(
                Point(link.origin.value, *(each * rate**k for k, each in enumerate(link.origin[1:], 1))),
                Turn(link.turn.value, *(each * rate**k for k, each in enumerate(link.turn[1:], 1))),
                link.points,
            )
            for name, link in four_bar(self.linkage, crank, order).items()
        }
        direction = math.radians(self.section.wheel_direction or 0.0)
        radius = self.design.mesh.working_radius[1]
        tangent = math.tan(self.design.mesh.working_pressure_angle)
        teeth = ToothDrive("mesh_wheel", "crank", links["crank"].origin.value, cmath.exp(1j * direction), radius,
                           tangent, moves > 0.0)  # fmt: skip
        connections: list[Connection] = [*four_bar_pins(links), teeth]
        return Mechanism(links, connections, "mesh_wheel", gain=radius * rate)

    # Jumps of speed

    @cached_property
    def engagement_energy(self) -> float:
        """Energy that a start of the motion costs, the hardest one [J]; its end leaves as much in the lock.

        E = J_red w_F^2/2,  J_red of all links at the driven shaft
        """
        import numpy as np

        from gearlink.core.mechanism.dynamics import reduced
        from gearlink.core.mechanism.links import Mechanism

        count = self.design.cycles_to_repeat
        starts = np.arange(count, dtype=np.float64) * (_TURN * self.design.driven_turn) + (
            self.design.start_crank_angle or 0.0
        )
        links = four_bar(self.linkage, starts, 2)

        found = reduced(Mechanism(links, [], "crank"), self.masses, [], 0j)
        driven = self.speed * self.design.mutilated.speed_ratio
        return float(np.max(found.inertia)) * driven**2 / 2.0
