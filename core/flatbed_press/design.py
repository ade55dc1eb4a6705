"""The flatbed cylinder press as a design: its parts, and what each command shows of it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.cams.machine import OnDiscCams
from gearlink.core.design import Design, Found, Outline, placed
from gearlink.core.errors import MissingSection, NoSolution, at_key, in_section
from gearlink.core.flatbed_press import bodies, checks, remedies, tables
from gearlink.core.flatbed_press.bed_motion import BedMotion
from gearlink.core.flatbed_press.cams import PressCams
from gearlink.core.flatbed_press.motion import PressMotion
from gearlink.core.gears.checks import GEAR_CHECKS, GEAR_QUANTITIES, GearQuantities, gear_quantity
from gearlink.core.gears.drawing_names import DERIVED, DRAWING_CHECKS, DRAWING_QUANTITIES, lacking
from gearlink.core.linkages.slider_crank.design import SLIDER_QUANTITIES, SliderCrankQuantities
from gearlink.core.motion_extremes import WithExtremes, names
from gearlink.core.report import Check, Table
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.flatbed_press.chains import BedChain, CylinderChain
    from gearlink.core.flatbed_press.compensation import Compensation
    from gearlink.core.flatbed_press.spec import FlatbedPressSpec
    from gearlink.core.gears.data import GearData
    from gearlink.core.gears.mesh.pair import GearPair
    from gearlink.core.linkages.slider_crank.position import SliderCrank

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
    "max_pressure_angle_at",
    "min_curvature_radius_at",
    "return_max_pressure_angle",
    "return_max_pressure_angle_at",
    "return_min_curvature_radius_at",
    "return_min_curvature_radius",
    "return_max_radius",
    "return_min_radius",
)
_PRESS_CHECKS = ("transmission-angle", "sync-speed", "sync-length", "register", "body-clearance")
_BEARING = ("pressure-angle", "cam-undercut", "shaft-clearance")
_CAM_CHECKS = (
    *_BEARING,
    "velocity-step",
    "acceleration-step",
    "constant-sum",
    "sync-length",
)
_CAM_TABLES = ("follower", "main_cam", "return_cam")
_PRESS_QUANTITIES = ("crank_length", "initial_crank_angle", *_SYNC, *_CHAINS)


_BED_EXTREMES = names("bed_velocity", "bed_acceleration")
_EXTREMES = (
    "min_transmission_angle_bed_at",
    "min_transmission_angle_cylinder_at",
    *_BED_EXTREMES,
    *names("cylinder_velocity", "cylinder_acceleration"),
)


class FlatbedPress(WithExtremes, SliderCrankQuantities, GearQuantities, OnDiscCams):
    """A flatbed cylinder press, from its design file to every quantity that is asked for."""

    kind = "flatbed-press"
    spec: FlatbedPressSpec
    outlines = {
        "press": Outline(_PRESS_QUANTITIES, _PRESS_CHECKS, ("positions",)),
        "cam": Outline((*_SYNC, *_CAM), _CAM_CHECKS, _CAM_TABLES),
        "crank": Outline(("crank_length", *SLIDER_QUANTITIES)),
        "gear": Outline((*GEAR_QUANTITIES, *DRAWING_QUANTITIES), (*GEAR_CHECKS, *DRAWING_CHECKS)),
        "analyze": Outline((*_PRESS_QUANTITIES, *_EXTREMES), _PRESS_CHECKS, ("positions",)),
    }

    derived = DERIVED
    extreme_names = _EXTREMES
    motion_extremes: dict[str, float] = placed("motion.extremes")
    extra_tables = ("chains", "drawing", "candidates")
    requirements = Design.requirements | {"sync.print_length"}
    cost = 5.0
    candidates, ways_of = remedies.candidates, remedies.ways_of

    def completion(self) -> Iterator[Found]:
        """The base radius in place of the rule that chose it."""
        if self.spec.size is not None and self.spec.cam is not None and self.spec.cam.base_radius is None:
            yield Found("cam.base_radius", float(self.cams.base_radius), "found for size")
            yield Found("size", None)

    def table_candidates(self, _samples: int | None = None) -> Table:
        """Input gears of other modules side by side."""
        from gearlink.core.flatbed_press.candidates import input_gears

        return input_gears(self)

    # Parts

    @cached_property
    def motion(self) -> PressMotion:
        """Chains and synchronous zone."""
        return PressMotion(self.spec, advise=self.advises)

    @cached_property
    def cams(self) -> PressCams:
        """The compensation cams and their follower."""
        return PressCams(self.spec, self.motion)

    @cached_property
    def bed_motion(self) -> BedMotion:
        """The bed, the lift of its cam taken off where the file has one."""
        return BedMotion(self)

    @property
    def bed_moves(self) -> bool:
        """Whether the motion of the bed exists, for which a cam that the file has must have its lift."""
        return self.spec.cam is None or self.cams.follows

    @cached_property
    def gear_pair(self) -> GearPair:
        """Gears 1 and 2 on the axes A and G, equal, with as many teeth as fit unshifted (TY-460 report 1.1)."""
        gears = self.spec.input_gears
        if gears is None:
            raise MissingSection("`gear` needs the section input_gears: module, horizontal_distance", key="input_gears")
        from gearlink.core.gears.from_spec import pair_at

        bed = self.spec.bed
        distance = math.hypot(gears.horizontal_distance, bed.offset - bed.double_crank.frame)
        # A centre distance of whole teeth is not to lose one of them to the rounding of the quotient.
        transverse = gears.module / math.cos(math.radians(gears.helix_angle))
        teeth = math.floor(distance / transverse * (1.0 + 1e-12))
        if teeth < 1:
            raise NoSolution(
                f"module {gears.module:g} mm leaves no tooth at the centre distance {distance:.6g} mm: make it smaller",
                key="input_gears.module",
            )
        with in_section("input_gears"):
            return pair_at(gears, (teeth, teeth), distance)

    @cached_property
    def gear_data(self) -> GearData:
        """The input gears with all that their drawing needs."""
        from gearlink.core.gears.from_spec import data_of

        pair = self.gear_pair
        assert self.spec.input_gears is not None, "the pair asks for it"
        with in_section("input_gears"):
            return data_of(self.spec.input_gears, pair)

    @property
    def mesh_data(self) -> dict[str, GearData]:
        """The meshes that the file draws: the input gears alone."""
        return {"": self.gear_data}

    input_speed: float = placed("motion.input_speed")
    turn_time: float = placed("motion.turn_time")
    zone_length: float = placed("motion.zone_length")
    slider_crank: SliderCrank = placed("motion.slider_crank")
    bed: BedChain = placed("motion.bed")
    cylinder: CylinderChain = placed("motion.cylinder")
    follower: Compensation = placed("cams.follower")
    main_cam: DiscCam = placed("cams.main_cam")
    return_cam: DiscCam = placed("cams.return_cam")

    # Quantities

    initial_crank_angle: float = placed("motion.bed.initial_crank_angle")
    min_transmission_angle_bed: float = placed("motion.min_transmission_angle_bed")
    min_transmission_angle_cylinder: float = placed("motion.min_transmission_angle_cylinder")
    sync_start: float = placed("motion.sync_start")
    sync_end: float = placed("motion.sync_end")
    cam_sync_start: float = placed("motion.cam_sync_start")
    cam_sync_end: float = placed("motion.cam_sync_end")
    compensation: float = placed("motion.compensation")
    cam_base_radius: float = placed("cams.base_radius")
    end_slope: float = placed("cams.follower.end_slope")
    transition_rise: float = placed("cams.follower.transition_rise")
    follower_stroke: float = placed("cams.follower_stroke")
    return_end: float = placed("cams.follower.return_end")
    roller_center_distance: float = placed("cams.roller_center_distance")
    max_pressure_angle: float = placed("cams.main_cam.max_pressure_angle.value")
    max_pressure_angle_at: float = placed("cams.main_cam.max_pressure_angle.place")
    min_curvature_radius_at: float = placed("cams.main_cam.min_curvature_radius.place")
    return_max_pressure_angle_at: float = placed("cams.return_cam.max_pressure_angle.place")
    return_min_curvature_radius_at: float = placed("cams.return_cam.min_curvature_radius.place")
    min_curvature_radius: float = placed("cams.main_cam.min_curvature_radius.value")
    max_radius: float = placed("cams.max_radius")
    min_radius: float = placed("cams.min_radius")
    return_max_pressure_angle: float = placed("cams.return_cam.max_pressure_angle.value")
    return_min_curvature_radius: float = placed("cams.return_cam.min_curvature_radius.value")
    return_max_radius: float = placed("cams.max_radius")
    return_min_radius: float = placed("cams.min_radius")

    def raw(self, name: str) -> Any:
        """Quantities of the gear pair are its own, and so are extremes of the bed."""
        if name in _BED_EXTREMES:
            return self.bed_motion.extremes[name]
        if name in GEAR_QUANTITIES:
            return gear_quantity(self.gear_pair, name)
        if name not in DRAWING_QUANTITIES:
            return super().raw(name)
        with at_key("input_gears"):
            return self.gear_data.quantity(name)

    def needs(self, name: str) -> str:
        """The keys that the input gears lack for a quantity."""
        return lacking(name, self.spec.input_gears, "input_gears.")

    def rests_on(self, name: str) -> str:
        """The factors of the rating."""
        from gearlink.core.gears.drawing_checks import rests_on

        return rests_on(name, self.gear_data) if name in DRAWING_QUANTITIES else ""

    @property
    def _shifts_given(self) -> bool:
        return self.spec.input_gears is not None and self.spec.input_gears.profile_shift is not None

    # Tables and checks

    def table_drawing(self, _samples: int | None = None) -> Table:
        """The gear table of the drawing of the input gears."""
        from gearlink.core.gears.drawing import drawing_table

        with at_key("input_gears"):
            return drawing_table(self.gear_data)

    table_positions, table_follower, table_chains = tables.positions, tables.follower, tables.chains
    table_main_cam, table_return_cam = tables.main_cam, tables.return_cam

    check_transmission_angle, check_register = checks.transmission_angle, checks.register
    check_body_clearance = bodies.crank_axes
    check_sync_speed, check_sync_length = checks.sync_speed, checks.sync_length
    check_pressure_angle, check_cam_undercut = checks.pressure_angle, checks.cam_undercut
    check_shaft_clearance, check_constant_sum = checks.shaft_clearance, checks.constant_sum
    check_velocity_step, check_acceleration_step = checks.velocity_step, checks.acceleration_step

    def check(self, name: str) -> list[Check]:
        """Gear checks come from the gear pair, all others are the press's own."""
        if name not in GEAR_CHECKS and name not in DRAWING_CHECKS:
            return super().check(name)
        from gearlink.core.gears.drawing_checks import pair_check

        with at_key("input_gears"):
            return pair_check(name, self.gear_data, self.spec.limits, shifts=self._shifts_given)

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """`press` judges whether the cams can bear the motion, `analyze` the cams."""
        of_cams = {} if spec.cam is None else {"press": _BEARING, "analyze": _CAM_CHECKS}
        return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams.get(command, ()))))

    def outline(self, command: str) -> Outline:
        """With the section `cam`, `press` judges whether the cams can bear the motion; `analyze` shows them too."""
        outline = self.outlines[command]
        if command not in ("press", "analyze") or self.spec.cam is None:
            return outline
        bearing = _BEARING if self.cams.is_sized else ()
        if command == "press":
            return Outline(outline.quantities, (*outline.checks, *bearing), outline.tables)
        if bearing and self.cams.is_refused:
            left_out = () if self.bed_moves else _BED_EXTREMES
            quantities = tuple(name for name in outline.quantities if name not in left_out)
            return Outline(quantities, (*outline.checks, *bearing), outline.tables)
        return Outline(
            (*outline.quantities, *_CAM),
            tuple(dict.fromkeys([*outline.checks, *_CAM_CHECKS])),
            (*outline.tables, *_CAM_TABLES),
        )
