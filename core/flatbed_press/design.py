"""The flatbed cylinder press as a design: chains, synchronous zone, input gears. Its cams: `press_cams`."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline, placed
from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.flatbed_press.cams import PressCams
from gearlink.core.flatbed_press.chains import BedChain, CylinderChain, difference
from gearlink.core.flatbed_press.codes import SYNC_LENGTH
from gearlink.core.flatbed_press.compensation import Compensation
from gearlink.core.flatbed_press.zone import equal_speed_angle, zone_end
from gearlink.core.gears.checks import GEAR_CHECKS, GEAR_QUANTITIES, GearQuantities, gear_check, gear_quantity
from gearlink.core.gears.pair import GearPair
from gearlink.core.linkages.checks import transmission_check
from gearlink.core.linkages.fourbar import FourBar
from gearlink.core.linkages.slider_crank import SliderCrank
from gearlink.core.linkages.slider_crank_design import SLIDER_QUANTITIES, SliderCrankQuantities
from gearlink.core.report import Check, Table, safely_above
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.flatbed_press.spec import DoubleCrank, FlatbedPressSpec

_SYNC = ("sync_start", "sync_end", "cam_sync_start", "cam_sync_end", "compensation")
_CHAINS = ("min_transmission_angle_bed", "min_transmission_angle_cylinder")
_CAM = (
    "cam_base_radius",
    "end_slope",
    "transition_rise",
    "follower_stroke",
    "return_end",
    "roller_center_distance",
    "max_pressure_angle",
    "min_curvature_radius",
    "max_radius",
    "min_radius",
)
_PRESS_CHECKS = ("transmission-angle", "sync-speed", "sync-length", "register")
_CAM_CHECKS = ("pressure-angle", "cam-undercut", "velocity-step", "acceleration-step", "constant-sum", "sync-length")
_CAM_TABLES = ("follower", "main_cam", "return_cam")
_PRESS_QUANTITIES = ("crank_length", "initial_crank_angle", *_SYNC, *_CHAINS)


class FlatbedPress(PressCams, SliderCrankQuantities, GearQuantities, Design):
    """A flatbed cylinder press, from its design file to every quantity that is asked for."""

    kind = "flatbed-press"
    spec: FlatbedPressSpec
    outlines = {
        "press": Outline(_PRESS_QUANTITIES, _PRESS_CHECKS, ("positions",)),
        "cam": Outline((*_SYNC, *_CAM), _CAM_CHECKS, _CAM_TABLES),
        "crank": Outline(("crank_length", *SLIDER_QUANTITIES)),
        "gear": Outline(GEAR_QUANTITIES, GEAR_CHECKS),
        "analyze": Outline(_PRESS_QUANTITIES, _PRESS_CHECKS, ("positions",)),
    }

    def outline(self, command: str) -> Outline:
        """`analyze` adds the cams and the input gears where the file has them."""
        outline = self.outlines[command]
        if command != "analyze" or self.spec.cam is None:
            return outline
        return Outline(
            (*outline.quantities, *_CAM),
            tuple(dict.fromkeys([*outline.checks, *_CAM_CHECKS])),
            (*outline.tables, *_CAM_TABLES),
        )

    # The chains

    @cached_property
    def input_speed(self) -> float:
        """Angular velocity of the input [rad/s]: one turn a sheet."""
        return self.spec.speed / 3600.0 * 2.0 * math.pi

    @cached_property
    def slider_crank(self) -> SliderCrank:
        """D-E-F, whose slider makes half the bed's stroke."""
        bed = self.spec.bed
        with at_key("bed.stroke"):
            return SliderCrank(bed.stroke / 2.0, bed.rod, bed.offset)

    @cached_property
    def bed(self) -> BedChain:
        """Drag link ABCD and slider-crank DEF."""
        bed = self.spec.bed
        return BedChain(
            _four_bar(bed.double_crank), math.radians(bed.crank_offset_angle), self.crank_length, bed.rod, bed.offset
        )

    @cached_property
    def cylinder(self) -> CylinderChain:
        """Drag link GHMN and the cylinder's gears."""
        cylinder = self.spec.cylinder
        angle = math.radians(cylinder.initial_crank_angle)
        return CylinderChain(_four_bar(cylinder.double_crank), angle, cylinder.radius, cylinder.gear_ratio)

    initial_crank_angle: float = placed("bed.initial_crank_angle")

    @cached_property
    def min_transmission_angle_bed(self) -> float:
        """Least transmission angle of ABCD over the turn [rad]."""
        return self.bed.linkage.min_transmission_angle()

    @cached_property
    def min_transmission_angle_cylinder(self) -> float:
        """Least transmission angle of GHMN over the turn [rad]."""
        return self.cylinder.linkage.min_transmission_angle()

    # The synchronous zone

    @cached_property
    def sync_start(self) -> float:
        """Input angle at the start of the zone [rad]."""
        given = self.spec.sync.start
        return equal_speed_angle(self.bed, self.cylinder) if given is None else math.radians(given)

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

    # The input gears

    @cached_property
    def gear_pair(self) -> GearPair:
        """Gears 1 and 2 on the axes A and G, equal, with as many teeth as fit unshifted (TY-460 report 1.1)."""
        gears = self.spec.input_gears
        if gears is None:
            raise MissingSection("`gear` needs the section input_gears: module, horizontal_distance", key="input_gears")
        bed = self.spec.bed
        distance = math.hypot(gears.horizontal_distance, bed.offset - bed.double_crank.frame)
        # A centre distance of whole teeth is not to lose one of them to the rounding of the quotient.
        teeth = math.floor(distance / gears.module * (1.0 + 1e-12))
        if teeth < 1:
            raise NoSolution(
                f"module {gears.module:g} mm leaves no tooth at the centre distance {distance:.6g} mm: make it smaller",
                key="input_gears.module",
            )
        with at_key("input_gears"):
            return GearPair.from_center_distance(
                gears.module, (teeth, teeth), distance, pressure_angle=math.radians(gears.pressure_angle)
            )

    def raw(self, name: str) -> Any:
        """Quantities of the gear pair are its own."""
        if name in GEAR_QUANTITIES:
            return gear_quantity(self.gear_pair, name)
        return super().raw(name)

    # Tables and checks

    def table_positions(self, samples: int | None = None) -> Table:
        """Both chains at equal steps of the input angle (TY-460 report 1.2, 2.2)."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples or 12)
        phi = np.radians(degrees)
        cam, speed = self.bed.cam_angle(phi, 1), self.input_speed
        p, q = self.bed.travel(phi, 1, cam), self.cylinder.travel(phi, 1)
        columns = {
            "input_angle": (degrees, "deg"),
            "cam_angle": (np.degrees(cam.value), "deg"),
            "bed_displacement": (p.value, "mm"),
            "bed_velocity": (p.first * speed, "mm/s"),
            "cylinder_displacement": (q.value, "mm"),
            "cylinder_velocity": (q.first * speed, "mm/s"),
            "transmission_angle_bed": (self._transmission(self.bed.linkage, self.initial_crank_angle + phi), "deg"),
            "transmission_angle_cylinder": (
                self._transmission(self.cylinder.linkage, self.cylinder.initial_angle - phi),
                "deg",
            ),
        }
        return Table.of("positions", columns)

    @staticmethod
    def _transmission(linkage: FourBar, crank_angle: Any) -> Any:
        import numpy as np

        from gearlink.core.linkages import fourbar_sweep
        from gearlink.core.linkages.fourbar_refine import dead_point_distance

        return np.degrees(dead_point_distance(fourbar_sweep.solve(linkage, crank_angle).transmission_angle))

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303 for both chains."""
        limit = self.spec.limits.transmission_angle
        for chain, angle in (
            ("bed", self.min_transmission_angle_bed),
            ("cylinder", self.min_transmission_angle_cylinder),
        ):
            yield transmission_check(
                angle,
                limit,
                f"bring coupler and rocker of {chain}.double_crank nearer to a right angle (shorter frame, longer "
                "coupler)",
                f"the least transmission angle of the {chain} chain",
            )

    def check_sync_speed(self) -> Check:
        """GL501: speeds of bed and cylinder at the start of the zone, which compensation cannot make good."""
        start = self.sync_start
        cylinder = float(self.cylinder.travel(start, 1).first)
        gap = float(self.bed.travel(start, 1).first) - cylinder
        share, limit = abs(gap / cylinder), 1e-3
        text = f"at the start of the zone bed and cylinder differ by {gap * self.input_speed:.3g} mm/s"
        if share > limit:
            text += (
                f", {100 * share:.3g} % of the speed: start the zone where the speeds are equal (leave sync.start out)"
            )
        return Check("GL501", "sync-speed", "fail" if share > limit else "pass", text, share, limit)

    def check_sync_length(self) -> Check:
        """GL502: the zone covers the print."""
        length, asked = self.zone_length, self.spec.sync.print_length
        if asked == 0.0:
            return Check(
                "GL502",
                "sync-length",
                "pass",
                f"the zone is {length:.6g} mm long; no print_length is given",
                length,
                0.0,
                "mm",
            )
        if self.spec.sync.end is None:
            remedy = f"set sync.length to at least {asked:g} mm and a margin"
        else:
            needed = math.degrees(zone_end(self.cylinder, self.sync_start, asked))
            remedy = f"set sync.end to at least {safely_above(needed, 6)} deg, or leave it out and give sync.length"
        return SYNC_LENGTH.below(length, asked, asked, "mm", "the cylinder's travel in the zone", remedy)

    def check_register(self) -> Check:
        """GL506: the cylinder makes whole turns per sheet."""
        ratio = self.spec.cylinder.gear_ratio
        off = abs(ratio - max(1, round(ratio)))
        text = f"the cylinder makes {ratio:g} turns per sheet"
        if off > 1e-9:
            text += f", so it does not come home: set cylinder.gear_ratio to {max(1, round(ratio))}"
        return Check("GL506", "register", "fail" if off > 1e-9 else "pass", text, off, 1e-9)

    def check(self, name: str) -> list[Check]:
        """Gear checks come from the gear pair, all others are the press's own."""
        if name in GEAR_CHECKS:
            return list(gear_check(name, self.gear_pair, self.spec.limits))
        return super().check(name)

    def _require_cam(self) -> Any:
        if self.spec.cam is None:
            raise MissingSection("`cam` needs the section cam: base_radius, roller_radius, ...", key="cam")
        return self.spec.cam

    @cached_property
    def follower(self) -> Compensation:
        """The lift of the compensation cam's follower."""
        from gearlink.core.cams.laws import law

        cam = self._require_cam()
        with at_key("cam.return_law"):
            return_law = law(cam.return_law)
            if return_law.kind != "rest-to-rest":
                raise NoSolution(f"the return needs a rest-to-rest law; {return_law.name} goes from rest to speed")
        return Compensation(
            self.bed,
            self.cylinder,
            self.sync_start,
            self.sync_end,
            cam.transition,
            math.radians(cam.lead_in),
            math.radians(cam.transition_end),
            math.radians(cam.return_angle),
            return_law,
        )


def _four_bar(links: DoubleCrank) -> FourBar:
    return FourBar(links.crank, links.coupler, links.rocker, links.frame, links.assembly)
