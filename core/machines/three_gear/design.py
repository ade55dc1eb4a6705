"""The three-gear four-bar as a design: analysis of given links. Its syntheses: `synthesis`."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, ClassVar

from gearlink.core.base.design import Outline, placed
from gearlink.core.base.errors import MissingSection, at_key
from gearlink.core.base.real_speed import OutputSpeed, per_time
from gearlink.core.base.remedies.ways import down, either, up
from gearlink.core.base.report import Check, Remedy, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import amount
from gearlink.core.machines.three_gear import bodies, dwell_checks, motion, tables
from gearlink.core.machines.three_gear.dwell import dwells
from gearlink.core.machines.three_gear.dwell.momentary_dwell import crank_with_room
from gearlink.core.machines.three_gear.idler_choice import idler_for_ratio
from gearlink.core.machines.three_gear.motion import Extremes, GearTrain
from gearlink.core.machines.three_gear.names import CHECKS, MESH_QUANTITIES, MESHES, QUANTITIES
from gearlink.core.parts.gears.train.meshed import Meshed
from gearlink.core.parts.gears.train.names import TRAIN_CHECKS
from gearlink.core.parts.gears.train.single_mesh import MESH_CHECKS
from gearlink.core.parts.gears.train.ways import train_ways
from gearlink.core.parts.linkages.checks import check_linkage, transmission_check
from gearlink.core.parts.linkages.feed import FeedResults
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.swing import rocker_swing
from gearlink.core.parts.linkages.standstills import BackStep
from gearlink.core.studies.clearance.bodies import Layout
from gearlink.core.studies.clearance.checks import SHAFT_WAYS, collision_check, shaft_checks, shaft_seat

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.dwell.by_roots import ByRoots
    from gearlink.core.machines.three_gear.families.window_lengths import Room
    from gearlink.core.machines.three_gear.spec import ThreeGearSpec
    from gearlink.core.parts.linkages.band_dwell import ToleranceDwell

_TEETH = (
    up("gears.crank", "gears.output", step=1),
    *(up(f"gears.{gear}", step=1) for gear in ("crank", "idler", "output")),
)
_LINKS = either("links.frame", "links.crank")
WAYS = {
    "gear-collision": (
        *_LINKS,
        up("gears.idler", step=1),
        down("gears.output", step=1),
        down("gears.crank", step=1),
        down("momentary.eccentricity"),
    ),
    "shaft-clearance": (
        *_LINKS,
        *either("gears.idler", step=1),
        *_TEETH,
        *SHAFT_WAYS,
    ),
    "transmission-angle": (
        *_LINKS,
        up("gears.idler", step=1),
        *either("momentary.eccentricity"),
        down("gears.crank", step=1),
        down("gears.output", step=1),
        *_TEETH,
    ),
    "dwell-tolerance": tuple(down(key, step=0.01) for key in ("dwell_tolerance", "dwell.tolerance", "dwell_backlash")),
    **train_ways(3, *_TEETH),
}


class ThreeGearFourBar(OutputSpeed, FeedResults, Meshed):
    """A three-gear four-bar of given links; the syntheses replace `linkage`, `idler_teeth` and closed forms."""

    kind = "three-gear-four-bar"
    spec: ThreeGearSpec
    outlines = {
        "analyze": Outline(QUANTITIES, ("dwell-window", *CHECKS), ("motion",)),
        "gear": Outline((*MESH_QUANTITIES, "output_play"), (*MESH_CHECKS, *TRAIN_CHECKS)),
    }
    extra_tables: ClassVar[tuple[str, ...]] = ("motion", "links", "drawing")
    ways = WAYS

    # Gears and links

    @cached_property
    def idler_teeth(self) -> int:
        """Teeth of the idler: given, from i3, or as the command chooses it."""
        gears = self.spec.gears
        if gears.idler is not None:
            return gears.idler
        if gears.i3 is None:
            return self.chosen_idler()
        with at_key("gears.i3"):
            return idler_for_ratio(gears.i3, gears.output)

    def chosen_idler(self) -> int:
        """Teeth of an idler that the file leaves out; only a synthesis can choose one."""
        raise MissingSection(f"this command needs gears.idler (teeth) or gears.i3{self._sought()}", key="gears.idler")

    def _sought(self) -> str:
        """Who finds what the file leaves out."""
        asked = [f"`{command}`" for command in self.spec.syntheses()]
        if not asked:
            return "; a section dwell, back_step, speed or momentary would have it found"
        several = ": leave all but one of their sections out" if len(asked) > 1 else ""
        return f"; {' or '.join(asked)} finds it{several}"

    crank_teeth: int = placed("spec.gears.crank")
    output_teeth: int = placed("spec.gears.output")

    @cached_property
    def train(self) -> GearTrain:
        """The three gears."""
        return GearTrain(self.crank_teeth, self.idler_teeth, self.output_teeth)

    i3: float = placed("train.i3")

    @property
    def coupler_length(self) -> float:
        """Centre distance of crank gear and idler [mm]."""
        if self.off_center:
            return self.distance("crank_idler")
        return self.spec.gears.transverse_module * abs(self.crank_teeth + self.idler_teeth) / 2.0

    @property
    def rocker_length(self) -> float:
        """Centre distance of idler and output gear [mm]."""
        if self.off_center:
            return self.distance("idler_output")
        return self.spec.gears.transverse_module * abs(self.idler_teeth + self.output_teeth) / 2.0

    @property
    def off_center(self) -> bool:
        """Whether the profile shifts of a mesh do not cancel, which moves its centre distance."""
        return self.spec.gears.off_center(2)

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Crank gear, idler, output gear."""
        return self.crank_teeth, self.idler_teeth, self.output_teeth

    mesh_names = MESHES

    def rim_of(self, mesh: str) -> float | None:
        """The file's rim is the output ring's."""
        return self.spec.gears.rim if mesh == MESHES[1] else None

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar; coupler and rocker are the gears' centre distances."""
        links = self.spec.links
        if links is None:
            raise MissingSection(
                f"`analyze` needs the section links: {{crank: mm, frame: mm}}{self._sought()}", key="links"
            )
        linkage = FourBar(links.crank, self.coupler_length, self.rocker_length, links.frame, self.spec.assembly)
        with at_key("links"):
            check_linkage(linkage)
        return linkage

    crank_length: float = placed("linkage.crank")
    frame_length: float = placed("linkage.frame")

    @property
    def frame_ratio(self) -> float:
        """Frame over crank."""
        return self.frame_length / self.crank_length

    # Motion

    @cached_property
    def mean_ratio(self) -> float:
        """Net output turns per input turn."""
        return motion.mean_ratio(self.linkage, self.train)

    @cached_property
    def speed_extremes(self) -> Extremes:
        """Greatest and least speed ratio and their places."""
        return motion.speed_extremes(self.linkage, self.train)

    @cached_property
    def acceleration_extremes(self) -> Extremes:
        """Greatest and least acceleration ratio and their places."""
        return motion.acceleration_extremes(self.linkage, self.train)

    speed_ratio_max: float = placed("speed_extremes.greatest")
    speed_ratio_min: float = placed("speed_extremes.least")
    speed_ratio_max_at: float = placed("speed_extremes.greatest_angle")
    speed_ratio_min_at: float = placed("speed_extremes.least_angle")
    acceleration_ratio_max: float = placed("acceleration_extremes.greatest")
    acceleration_ratio_max_at: float = placed("acceleration_extremes.greatest_angle")
    acceleration_ratio_min: float = placed("acceleration_extremes.least")
    acceleration_ratio_min_at: float = placed("acceleration_extremes.least_angle")

    back_step_time: float | None = per_time("back_step_crank_angle", -1)
    dwell_time: float | None = per_time("dwell_angle", -1)
    tolerance_dwell_time: float | None = per_time("tolerance_dwell_angle", -1)

    @property
    def rocker_swing(self) -> float | None:
        """Swing of the rocker between its dead centres [rad]; a drag link has none."""
        return rocker_swing(self.linkage)

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending."""
        if self.off_center:
            return self.by_roots.places
        return dwells.dwell_positions(self.linkage, self.train)

    @cached_property
    def by_roots(self) -> ByRoots:
        """Standstills as roots of the output's speed, for links that are not in proportion to the teeth."""
        from gearlink.core.machines.three_gear.dwell.by_roots import ByRoots

        return ByRoots(self.linkage, self.train)

    @cached_property
    def motion(self) -> str:
        """unidirectional, momentary-dwell or back-step."""
        return dwells.motion(self.dwell_crank_angles)

    @cached_property
    def back_step(self) -> BackStep | None:
        """The back-step, where there is one."""
        if self.off_center:
            return self.by_roots.back_step
        return dwells.back_step(self.linkage, self.train) if self.motion == "back-step" else None

    back_step_angle: float | None = placed("back_step.angle")
    back_step_crank_angle: float | None = placed("back_step.crank_angle")

    @cached_property
    def dwell_angle(self) -> float | None:
        """Crank angle until the output regains its place, phi13 [rad]."""
        step = self.back_step
        if self.off_center:
            return self.by_roots.dwell_angle
        return None if step is None else dwells.dwell_angle(self.linkage, self.train, step)

    @property
    def dwell_angle_approximate(self) -> float | None:
        """1.5 phi12 [rad] (thesis (4-17))."""
        return None if self.back_step_crank_angle is None else 1.5 * self.back_step_crank_angle

    @property
    def nonuniformity(self) -> float:
        """(max - min)/mean of the speed ratio."""
        return (self.speed_ratio_max - self.speed_ratio_min) / abs(self.mean_ratio)

    @cached_property
    def tolerance_dwell(self) -> ToleranceDwell | None:
        """The longest dwell within the tolerance of the output, where the file gives one that has an end."""
        tolerance = self.output_tolerance
        if tolerance is None or tolerance >= self.endless_tolerance:
            return None
        if self.off_center:
            return self.by_roots.within(tolerance, self.speed_extremes, self.mean_ratio)
        from gearlink.core.machines.three_gear.dwell.tolerance_dwell import tolerance_dwell

        with at_key(self._tolerance_key):
            return tolerance_dwell(self.linkage, self.train, tolerance)

    @property
    def endless_tolerance(self) -> float:
        """Half of what the output gains in a turn of the crank [rad]: within it, the output never leaves its place."""
        return math.pi * abs(self.mean_ratio)

    @property
    def output_tolerance(self) -> float | None:
        """Tolerance of the output angle to either side [rad]: given, or from the play at the output gear."""
        if self.spec.dwell_backlash is not None:
            from gearlink.core.machines.three_gear.dwell.tolerance_dwell import tolerance_from_backlash

            return tolerance_from_backlash(
                self.spec.dwell_backlash, self.spec.gears.transverse_module * abs(self.output_teeth) / 2.0
            )
        given = self.spec.dwell_tolerance if self.dwell_request is None else self.dwell_request.tolerance
        return None if given is None else math.radians(given)

    @property
    def dwell_request(self) -> Any:
        """The file's section dwell with a tolerance, which is the same request as dwell_tolerance; None without one."""
        request = self.spec.dwell
        return None if request is None or request.tolerance is None else request

    @property
    def _tolerance_key(self) -> str:
        if self.spec.dwell_backlash is not None:
            return "dwell_backlash"
        return "dwell_tolerance" if self.dwell_request is None else "dwell.tolerance"

    tolerance_dwell_angle: float | None = placed("tolerance_dwell.crank_angle")
    tolerance_dwell_start: float | None = placed("tolerance_dwell.start")

    @cached_property
    def min_transmission_angle(self) -> float:
        """Least transmission angle over the turn [rad]."""
        return self.linkage.min_transmission_angle()

    @cached_property
    def layout(self) -> Layout:
        """The bodies in the plane of the gears."""
        return bodies.layout(self.linkage, self.train, self.spec, self._own_pairs if self.own_teeth else None)

    @cached_property
    def gear_gap(self) -> float | None:
        """Gap of the tips of gears 1 and 5 at the closest [mm]; None where one is a ring, in another plane."""
        if self.train.internal:
            return None
        if self.own_teeth:
            return self.layout.gear_pairs[0].gap
        return motion.gear_gap(self.linkage, self.train, self.spec.gears.module)

    table_motion, table_links = tables.motion, tables.links

    # Checks

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: gears 1 and 5, over the whole turn."""
        if self.train.internal:
            yield bodies.ring_planes(self.layout, self.train, self.spec.limits.gear_gap)
            return
        limit, apart = self.spec.limits.gear_gap, abs(self.frame_length - self.crank_length)
        why = f"the crank gear travels with the crank pin, so AD - AB = {apart:.6g} mm counts, not AD"
        for pair in self.layout.gear_pairs:
            remedy = self._gap_remedy(limit - pair.gap) if pair.gap < limit and self.advises else ""
            yield collision_check(pair, limit, why, remedy)

    def _gap_remedy(self, missing: float) -> str:
        """What would give the gears room."""
        module = self.spec.gears.transverse_module
        words = (
            f"make frame less crank {safely_above(missing)} mm longer, or the crank and output gears "
            f"{amount(math.ceil(2.0 * missing / module), 'tooth', 'teeth')} smaller together"
        )
        shorter = self._longest_crank_with_room()
        if shorter is not None:
            most = safely_below(shorter)
            words += f"; a momentary dwell has room with a crank of at most {most} mm (synth momentary-dwell)"
        return words

    def _longest_crank_with_room(self) -> float | None:
        """Longest crank of a momentary dwell with these gears that keeps gears 1 and 5 apart [mm]."""
        module = self.spec.gears.transverse_module
        r1, r3, r5 = (0.5 * module * teeth for teeth in self.signed_teeth)
        return crank_with_room(r1, r3, r5, r1 + r5 + self.tip_excess + self.spec.limits.gear_gap)

    @property
    def tip_excess(self) -> float:
        """What the tips of gears 1 and 5 reach beyond their reference circles, together [mm].

        m (2 h_a* + x_1 + x_5 + k_1 + k_5); k = 0 where the shifts cancel in each mesh
        """
        gears = self.spec.gears
        k = gears.tip_shortening if isinstance(gears.tip_shortening, list) else (0.0, 0.0, 0.0)
        return gears.module * (2.0 * gears.addendum + gears.shift(0) + gears.shift(2) + k[0] + k[2])

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302."""
        return shaft_checks(self.layout)

    check_shaft_seat = shaft_seat

    def check_transmission_angle(self) -> Check:
        """GL303."""
        remedy = "shorten the crank or take a larger idler"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)

    check_dwell_window, check_dwell_tolerance = dwell_checks.window_check, dwell_checks.tolerance_check

    @cached_property
    def window_rooms(self) -> tuple[Room, ...]:
        """The lengths of crank or frame that meet the window of the file."""
        from gearlink.core.machines.three_gear.families.window_lengths import rooms

        return rooms(self, math.radians(self.spec.dwell_window or 0.0), self.output_tolerance or 0.0)

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """The lengths that meet a window."""
        asked = check == "dwell-window" and self.spec.dwell_window is not None
        return (((room.key, length),) for room in self.window_rooms for length in room.built()) if asked else ()

    def check_rounded_ratio(self) -> Iterator[Check]:
        """GL304 where the file gives i3: whole teeth may change it."""
        asked = self.spec.gears.i3
        if asked is None:
            return
        text = f"i3 = {asked:g} becomes {self.i3:.9g} with {self.idler_teeth} idler teeth"
        remedy = "; everything is computed with that: ask for a ratio of whole teeth, or accept it"
        yield dwell_checks.ratio_judged(self.i3, asked).check(text, remedy, name="rounded-ratio")
