"""The loads of a two-gear four-bar and of a geared rocker: a four-bar, a free gear, a mesh on the carrier link."""

from __future__ import annotations

import math
from abc import abstractmethod
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from gearlink.core.gears.outline.mesh_phase import signed_pair
from gearlink.core.linkages.fourbar.mechanism import four_bar, four_bar_pins, full_balance
from gearlink.core.linkages.fourbar.position import FourBar, solve
from gearlink.core.loads.design import BALANCE, LoadsDesign, loads_outline
from gearlink.core.loads.periods import homecoming, is_directed
from gearlink.core.planet_linkages.rocker_design import GearedRocker
from gearlink.core.planet_linkages.two_gear_design import TwoGearFourBar
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.mechanism.joints import Mesh
    from gearlink.core.mechanism.links import Link, Mechanism
    from gearlink.core.mechanism.rates import Turn
    from gearlink.core.numerics.arrays import Reals

_MESHES = ("mesh_25",)
_MOST_TEETH = 10_000


class PlanetLinkageLoads(LoadsDesign):
    """What both have: crank, coupler with a gear, rocker, and a free gear on the pivot of the carrier link."""

    links = ("crank", "coupler", "rocker", "output")
    meshes = _MESHES
    design: Any
    output_pin: str

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar."""
        found: FourBar = self.design.linkage
        return found

    def counterweights(self) -> dict[str, complex]:
        """Those of the full force balance."""
        return full_balance(self.linkage, self.masses)

    @cached_property
    def _start(self) -> tuple[float, float]:
        """Coupler and rocker angle at crank angle 0, from which the free gear counts."""
        state = solve(self.linkage, 0.0)
        return state.coupler_angle, state.rocker_angle

    @abstractmethod
    def carrier_turn(self, links: dict[str, Link]) -> Turn:
        """Angle of the link that carries the gears, 0 at crank angle 0."""

    @abstractmethod
    def mesh_of(self, links: dict[str, Link]) -> Mesh:
        """The mesh of output and coupler."""

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The four links at crank angles."""
        from gearlink.core.mechanism.joints import Pin
        from gearlink.core.mechanism.links import FRAME, Link, Mechanism
        from gearlink.core.mechanism.rates import from_start, mixed

        links, ratio = four_bar(self.linkage, phi, order), self.design.gear_ratio
        pins = four_bar_pins(links)
        coupler = from_start(links["coupler"].turn, self._start[0])
        pivot = links["crank" if self.output_pin == "A_output" else "rocker"].origin
        links["output"] = Link(pivot, mixed((1.0 - ratio, self.carrier_turn(links)), (ratio, coupler)))
        return Mechanism(
            links, [*pins, Pin(self.output_pin, FRAME, "output", pivot.value), self.mesh_of(links)], "crank"
        )

    @cached_property
    def rolling(self) -> tuple[float, float, float]:
        """Working radii of output gear and coupler gear [mm], and the tangent of their working pressure angle."""
        pair = signed_pair(self.design.mesh)
        r2, r5 = pair.working_radius
        return abs(r5), r2, math.tan(pair.working_pressure_angle)


class TwoGearLoads(PlanetLinkageLoads):
    """Planet on the coupler at B, output gear or ring on A."""

    kind = "two-gear-four-bar"
    output_pin = "A_output"
    pins = ("A", "B", "C", "D", "A_output")
    outlines = loads_outline(pins, _MESHES, BALANCE)

    @cached_property
    def design(self) -> TwoGearFourBar:
        """The geometry."""
        return TwoGearFourBar(self.spec)

    @cached_property
    def turns(self) -> int:
        """Crank turns until the output is home, where its direction matters."""
        if not is_directed(self.section, "output"):
            return 1
        mean = Fraction(self.design.mean_ratio).limit_denominator(_MOST_TEETH)
        return homecoming(mean.denominator, "the output comes home", "gears")

    @property
    def motion_turns(self) -> int:
        """The links are home after every turn."""
        return 1

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwell: within the tolerance of the file, else within the band that the back-step fills."""
        from gearlink.core.planet_linkages.two_gear_family import tolerance_dwell

        step = self.design.back_step
        tolerance = None if step is None else 0.5 * step.angle
        if self.spec.dwell is not None and self.spec.dwell.tolerance is not None:
            tolerance = math.radians(self.spec.dwell.tolerance)
        if self.design.output_tolerance is not None:
            tolerance = self.design.output_tolerance
        if tolerance is None:
            return []
        dwell = tolerance_dwell(self.design.drive, tolerance)
        return [(dwell.start + 2.0 * math.pi * turn, dwell.crank_angle) for turn in range(self.turns)]

    def carrier_turn(self, links: dict[str, Link]) -> Turn:
        """The crank's."""
        return links["crank"].turn

    def mesh_of(self, links: dict[str, Link]) -> Mesh:
        """Along the crank."""
        from gearlink.core.mechanism.joints import Mesh

        crank = links["crank"]
        return Mesh(
            "mesh_25", "output", "coupler", crank.origin.value, crank.unit, *self.rolling, self.design.internal, "crank"
        )


class GearedRockerLoads(PlanetLinkageLoads):
    """Gear on the coupler at C, output gear on D."""

    kind = "geared-rocker"
    output_pin = "D_output"
    pins = ("A", "B", "C", "D", "D_output")
    outlines = loads_outline(pins, _MESHES, BALANCE)

    @cached_property
    def design(self) -> GearedRocker:
        """The geometry."""
        return GearedRocker(self.spec)

    def carrier_turn(self, links: dict[str, Link]) -> Turn:
        """The rocker's."""
        from gearlink.core.mechanism.rates import from_start

        return from_start(links["rocker"].turn, self._start[1])

    def mesh_of(self, links: dict[str, Link]) -> Mesh:
        """Along the rocker."""
        from gearlink.core.mechanism.joints import Mesh

        rocker = links["rocker"]
        return Mesh("mesh_25", "output", "coupler", rocker.origin.value, rocker.unit, *self.rolling, False, "rocker")
