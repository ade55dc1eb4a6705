"""The motion of a flatbed press: input, both chains, and the zone in which they run together."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.errors import NoSolution, at_key
from gearlink.core.flatbed_press.chains import BedChain, CylinderChain, difference
from gearlink.core.flatbed_press.zone import equal_speed_angle, turning_within, zone_end
from gearlink.core.linkages.dyad import acute
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.linkages.slider_crank.position import SliderCrank
from gearlink.core.report import safely_above
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.flatbed_press.spec import DoubleCrank, FlatbedPressSpec


_TURN = 2.0 * math.pi


class PressMotion:
    """Chains and synchronous zone of a design file; one that is to advise says in a refusal what would help."""

    def __init__(self, spec: FlatbedPressSpec, *, advise: bool = True) -> None:
        self.spec = spec
        self.advise = advise

    @cached_property
    def input_speed(self) -> float:
        """Angular velocity of the input [rad/s]: one turn a sheet."""
        return self.spec.speed / 3600.0 * 2.0 * math.pi

    @property
    def turn_time(self) -> float:
        """Time of an input turn [ms]."""
        return 2e3 * math.pi / self.input_speed

    @cached_property
    def slider_crank(self) -> SliderCrank:
        """D-E-F, whose slider makes half the bed's stroke."""
        bed = self.spec.bed
        with at_key("bed.stroke"):
            return SliderCrank(bed.stroke / 2.0, bed.rod, bed.offset)

    @cached_property
    def bed(self) -> BedChain:
        """Drag link ABCD and slider-crank DEF."""
        bed, crank = self.spec.bed, self.slider_crank.crank_length
        return BedChain(_four_bar(bed.double_crank), math.radians(bed.crank_offset_angle), crank, bed.rod, bed.offset)

    @cached_property
    def cylinder(self) -> CylinderChain:
        """Drag link GHMN and the cylinder's gears."""
        cylinder = self.spec.cylinder
        angle = math.radians(cylinder.initial_crank_angle)
        return CylinderChain(_four_bar(cylinder.double_crank), angle, cylinder.radius, cylinder.gear_ratio)

    @cached_property
    def min_transmission_angle_bed(self) -> float:
        """Least transmission angle of ABCD over the turn [rad]."""
        return self.bed.linkage.min_transmission_angle()

    @cached_property
    def min_transmission_angle_cylinder(self) -> float:
        """Least transmission angle of GHMN over the turn [rad]."""
        return self.cylinder.linkage.min_transmission_angle()

    @cached_property
    def min_rod_angle(self) -> float:
        """Least angle between the rod EF and the normal of the slide line over the turn [rad]."""
        return math.acos((self.slider_crank.crank_length + abs(self.spec.bed.offset)) / self.spec.bed.rod)

    @cached_property
    def extremes(self) -> dict[str, float]:
        """Extremes of velocity and acceleration of the cylinder [mm/s, mm/s^2], and their places and those of the least
        transmission angles [rad]."""
        from gearlink.core.motion_extremes import extremes

        speed, cylinder = self.input_speed, self.cylinder
        curves = {
            "cylinder_velocity": lambda phi: cylinder.travel(phi, 1).first * speed,
            "cylinder_acceleration": lambda phi: cylinder.travel(phi, 2).second * speed**2,
        }
        return extremes(curves, 0.0, _TURN) | self._transmission_places()

    def _transmission_places(self) -> dict[str, float]:
        """Input angles of the least transmission angles: the driving crank then lies in the line of the frame."""
        bed, cylinder = (_crank_of_least(chain.linkage) for chain in (self.bed, self.cylinder))
        return {
            "min_transmission_angle_bed_at": (bed - self.bed.initial_crank_angle) % _TURN,
            "min_transmission_angle_cylinder_at": (self.cylinder.initial_angle - cylinder) % _TURN,
        }

    # The synchronous zone

    @cached_property
    def sync_start(self) -> float:
        """Input angle at the start of the zone [rad]."""
        given = self.spec.sync.start
        if given is not None:
            return math.radians(given)
        return equal_speed_angle(self.bed, self.cylinder, advise=self.advise)

    @cached_property
    def sync_end(self) -> float:
        """Input angle at the end of the zone [rad]."""
        given = self.spec.sync.end
        if given is None:
            return zone_end(self.cylinder, self.sync_start, self.spec.sync.length)
        if math.radians(given) <= self.sync_start:
            start = math.degrees(self.sync_start)
            raise NoSolution(
                f"the zone ends at input angle {given:g} deg, but starts at {start:.6g} deg: set sync.end above "
                f"{safely_above(start, 6)} deg, or leave it out and give sync.length",
                key="sync.end",
            )
        return math.radians(given)

    @cached_property
    def bed_turns_back(self) -> float | None:
        """First input angle within the zone at which the bed turns back [rad]; None where it never does."""
        return turning_within(self.bed, self.sync_start, self.sync_end)

    @cached_property
    def zone_length(self) -> float:
        """Cylinder travel in the zone [mm]: as asked for, unless the file says where the zone ends."""
        if self.spec.sync.end is None:
            return self.spec.sync.length
        return float(self.cylinder.travel(self.sync_end).value - self.cylinder.travel(self.sync_start).value)

    @cached_property
    def compensation(self) -> float:
        """Bed travel that the cam makes good in the zone [mm]."""
        gap = [float(difference(self.bed, self.cylinder, phi).value) for phi in (self.sync_start, self.sync_end)]
        return gap[1] - gap[0]

    @cached_property
    def cam_sync_start(self) -> float:
        """Cam angle at the start of the zone [rad]."""
        return float(self.bed.cam_angle(self.sync_start).value)

    @cached_property
    def cam_sync_end(self) -> float:
        """Cam angle at the end of the zone [rad]."""
        return float(self.bed.cam_angle(self.sync_end).value)


def _crank_of_least(linkage: FourBar) -> float:
    """Crank angle of the least transmission angle [rad], 0 or pi."""
    folded, stretched = map(acute, linkage.transmission_extremes())
    return 0.0 if folded <= stretched else math.pi


def _four_bar(links: DoubleCrank) -> FourBar:
    return FourBar(links.crank, links.coupler, links.rocker, links.frame, links.assembly)
