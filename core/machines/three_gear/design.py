"""The three-gear four-bar as a design: analysis, tables and bodies. Its syntheses: `synthesis`, `dwell_synthesis`."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import MissingSection, at_key
from gearlink.core.base.real_speed import OUTPUT_SPEEDS, OutputSpeed, per_time
from gearlink.core.base.remedies.ways import counts, down, either, up
from gearlink.core.base.report import Check, Remedy, Table, safely_above, safely_below, without_noise
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import amount, short
from gearlink.core.machines.three_gear import dwell as dwells
from gearlink.core.machines.three_gear.codes import ratio_judged, tolerance_judged
from gearlink.core.machines.three_gear.dwell import ByRoots, Output
from gearlink.core.machines.three_gear.momentary import crank_with_room
from gearlink.core.machines.three_gear.train import GearTrain, gear_gap, idler_for_ratio, tip_radius
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.teeth import rim_radius
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, TRAIN_CHECKS, Meshed, named, train_ways
from gearlink.core.parts.linkages.checks import check_linkage, dwell_window_check, transmission_check, window_judged
from gearlink.core.parts.linkages.codes import GEAR_COLLISION
from gearlink.core.parts.linkages.feed import FEED_QUANTITIES, FeedResults
from gearlink.core.parts.linkages.fourbar.nearest_passes import rocker_swing
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
from gearlink.core.parts.linkages.standstills import BackStep, OutputRates, Turning
from gearlink.core.studies.clearance import (
    FULL_HEIGHT,
    SHAFT_WAYS,
    Gear,
    Layout,
    Shaft,
    WithShafts,
    collision_check,
    constant,
    coupler_joint,
    crank_pin,
    least_gap,
    least_shaft,
)

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families import Room, Uniform
    from gearlink.core.machines.three_gear.spec import Gears, ThreeGearSpec
    from gearlink.core.machines.three_gear.synthesis import Task
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.linkages.band_dwell import ToleranceDwell


_ROUNDED = 64.0
"""Frames: rounding of a place, and of a standstill itself, is that of some lengths."""
QUANTITIES = (
    "i3",
    "crank_teeth",
    "idler_teeth",
    "output_teeth",
    "frame_ratio",
    "crank_length",
    "coupler_length",
    "rocker_length",
    "frame_length",
    "mean_ratio",
    "speed_ratio_max",
    "speed_ratio_min",
    "motion",
    "dwell_crank_angles",
    "back_step_angle",
    "back_step_crank_angle",
    "dwell_angle",
    "dwell_angle_approximate",
    "min_transmission_angle",
    "gear_gap",
    "nonuniformity",
    "speed_ratio_max_at",
    "speed_ratio_min_at",
    *names("acceleration_ratio"),
    "rocker_swing",
    "tolerance_dwell_angle",
    "tolerance_dwell_start",
    "input_speed",
    "turn_time",
    *OUTPUT_SPEEDS,
    "back_step_time",
    "dwell_time",
    "tolerance_dwell_time",
    *FEED_QUANTITIES,
    "uniform_angle",
    "uniform_start",
    "uniform_ratio",
)
CHECKS = (
    "gear-collision",
    "shaft-clearance",
    "shaft-seat",
    "transmission-angle",
    "rounded-ratio",
    "dwell-tolerance",
    "lay-speed",
    *MESH_CHECKS,
)
_OF_OTHERS = frozenset(
    (
        *(name for name in QUANTITIES if name.endswith(("_ratio_max_at", "_ratio_min_at", "_time"))),
        *OUTPUT_SPEEDS,
        "input_speed",
        "dwell_angle_approximate",
        "tolerance_dwell_start",
    )
)
"""What is read off, or scaled from, quantities that are shown as well."""
MESHES = ("crank_idler", "idler_output")
MESH_QUANTITIES = named(MESHES)


_UNITS = 8.0
_MORE_TEETH = 20
"""So many more than the smallest idler are tried where its teeth do not mesh well."""
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
    "shaft-clearance": (*_LINKS, *either("gears.idler", step=1), *_TEETH, *SHAFT_WAYS),
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


class ThreeGearFourBar(OutputRates, OutputSpeed, FeedResults, WithShafts, Meshed):
    """A three-gear four-bar of given links, or of those that the `task` of a synthesis finds."""

    kind = "three-gear-four-bar"
    spec: ThreeGearSpec
    derived = Meshed.derived | _OF_OTHERS
    keys = {
        "analyze": (
            "motion",
            ("tolerance_dwell_angle", "dwell_window"),
            "back_step_angle",
            "mean_ratio",
            "speed_ratio_max",
            "speed_ratio_min",
            "output_acceleration_max",
            "feed_per_turn",
            ("min_transmission_angle", ">limits.transmission_angle"),
            ("gear_gap", ">limits.gear_gap"),
            "acceleration_ratio_max",
            "dwell_angle",
        )
    }
    outlines = {
        "analyze": Outline((*QUANTITIES, "dwell_pole_line_error"), ("dwell-window", *CHECKS), ("motion",)),
        "gear": Outline((*MESH_QUANTITIES, "output_play"), (*MESH_CHECKS, *TRAIN_CHECKS)),
    }
    extra_tables: ClassVar[tuple[str, ...]] = ("motion", "links", "poles", "drawing", "factors")
    ways = WAYS
    in_ring = ("the idler", "the ring gear")

    def __init__(self, spec: Any) -> None:
        super().__init__(spec)
        if self.task is not None:
            self.require_proportion()

    @property
    def task(self) -> Task | None:
        """What a synthesis seeks the idler and the links for; None: the file gives them."""
        return None

    def completion(self) -> Iterator[Found]:
        """Idler and links instead of the tasks."""
        if self.task is None:
            return
        by = f"found by {next(command for command in self.outlines if command.startswith('synth'))}"
        if self.spec.gears.idler is None:
            yield Found("gears.idler", self.idler_teeth, by)
        yield Found("gears.i3", None)
        yield Found("links", {"crank": self.crank_length, "frame": self.frame_length}, by)
        yield from (Found(section, None) for section in ("dwell", "back_step", "speed", "momentary"))

    # Gears and links

    @cached_property
    def idler_teeth(self) -> int:
        """Teeth of the idler: given, from i3, or as the command chooses it."""
        gears = self.spec.gears
        if gears.idler is not None:
            return gears.idler
        if gears.i3 is not None:
            with at_key("gears.i3"):
                return idler_for_ratio(gears.i3, gears.output)
        if self.task is not None:
            return self.task.chosen_idler(advises=self.advises)
        raise MissingSection(f"this command needs gears.idler (teeth) or gears.i3{self._sought()}", key="gears.idler")

    def _sought(self) -> str:
        """Who finds what the file leaves out."""
        asked = [f"`{command}`" for command in self.spec.syntheses()]
        if not asked:
            return "\ngive it, or add a section dwell, back_step, speed or momentary and run its synthesis"
        several = "\nkeep one of their sections" if len(asked) > 1 else ""
        return f"; {' or '.join(asked)} finds it{several}"

    crank_teeth: int = placed("spec.gears.crank")
    output_teeth: int = placed("spec.gears.output")

    @cached_property
    def train(self) -> GearTrain:
        """The three gears; a task refuses those that it does not serve."""
        if self.task is not None:
            self.task.require_gears()
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
        if self.task is not None:
            return self.task.linkage_of(self.idler_teeth)
        links = self.spec.links
        if links is None:
            raise MissingSection(f"this needs the section links: {{crank: mm, frame: mm}}{self._sought()}", key="links")
        linkage = FourBar(links.crank, self.coupler_length, self.rocker_length, links.frame, self.spec.assembly)
        with at_key("links"):
            check_linkage(linkage)
        return linkage

    crank_length: float = placed("linkage.crank")
    frame_length: float = placed("linkage.frame")

    # Motion

    @cached_property
    def output(self) -> Output:
        """The output over a revolution: in closed form where the links are proportional to the teeth, else by roots."""
        if self.task is not None:
            return self.task.output(self.linkage, self.train)
        return (ByRoots if self.off_center else Output)(self.linkage, self.train)

    frame_ratio: float = placed("output.frame_ratio")

    mean_ratio: float = placed("output.mean_ratio")
    speed_turnings: list[Turning] = placed("output.speed_turnings")
    acceleration_turnings: list[Turning] = placed("output.acceleration_turnings")

    back_step_time: float | None = per_time("back_step_crank_angle", -1)
    dwell_time: float | None = per_time("dwell_angle", -1)
    tolerance_dwell_time: float | None = per_time("tolerance_dwell_angle", -1)

    @property
    def rocker_swing(self) -> float | None:
        """Swing of the rocker between its dead centres [rad]; a drag link has none."""
        return rocker_swing(self.linkage)

    dwell_crank_angles: list[float] = placed("output.places")

    @cached_property
    def motion(self) -> str:
        """unidirectional, momentary-dwell or back-step."""
        return dwells.motion(self.dwell_crank_angles)

    back_step: BackStep | None = placed("output.back_step")
    back_step_angle: float | None = placed("back_step.angle")
    back_step_crank_angle: float | None = placed("back_step.crank_angle")

    @property
    def dwell_angle(self) -> float | None:
        """Crank angle until the output is back at its starting position, phi13 [rad]."""
        return self.output.dwell_angle

    @property
    def dwell_stretch(self) -> tuple[float, float] | None:
        """Start and crank angle of the dwell [rad]: within the tolerance where the file gives one, else phi13."""
        if self.tolerance_dwell is not None:
            return self.tolerance_dwell.start, self.tolerance_dwell.crank_angle
        if self.back_step is not None and self.dwell_angle is not None:
            return self.back_step.start, self.dwell_angle
        return None

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
        with at_key(self._tolerance_key):
            return self.output.within(tolerance)

    @property
    def endless_tolerance(self) -> float:
        """Half of the net output angle per revolution of the crank [rad]: a larger band is never left."""
        return math.pi * abs(self.mean_ratio)

    @property
    def output_tolerance(self) -> float | None:
        """Tolerance of the output angle to either side [rad]: given, or from the play at the output gear."""
        return given_tolerance(
            self.spec, self.spec.dwell_tolerance if self.dwell_request is None else self.dwell_request.tolerance
        )

    @property
    def dwell_request(self) -> Any:
        """The file's section dwell with a tolerance, which is the same request as dwell_tolerance; None without one."""
        request = self.spec.dwell if self.task is None else None  # a task reads its own section
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
        """Minimum transmission angle over the revolution [rad]."""
        return self.linkage.min_transmission_angle()

    @cached_property
    def layout(self) -> Layout:
        """The bodies in the plane of the gears."""
        return layout(self.linkage, self.train, self.spec, self._own_pairs if self.own_teeth else None)

    @cached_property
    def gear_gap(self) -> float | None:
        """Gap of the tips of gears 1 and 5 at the closest [mm]; None where one is a ring, in another plane."""
        if self.train.internal:
            return None
        if self.own_teeth:
            return self.layout.gear_pairs[0].gap
        return gear_gap(self.linkage, self.train, self.spec.gears.module)

    def table_motion(self, samples: int | None = None) -> Table:
        """Output angle, speed and acceleration, transmission angle over a revolution of the crank."""
        from gearlink.core.machines.three_gear.mechanism import OUTPUT
        from gearlink.core.mechanism.courses import Shown, between, motion_table, of_output

        shown = [*of_output(OUTPUT), Shown("transmission_angle", between("coupler", "rocker"))]
        return motion_table("motion", self, shown, samples)

    def table_links(self, samples: int | None = None) -> Table:
        """Angle, speed, acceleration, jerk of every link and gear over a revolution, and the pole P15 on AD."""
        from gearlink.core.mechanism.courses import Shown, all_rates, motion_table, turned
        from gearlink.core.mechanism.motion import Course

        names = ("coupler", "rocker", "idler", "output")
        shown = all_rates({name: turned(name) for name in names})
        pole = Course("mm", lambda mechanism: [_pole(self, mechanism)])
        return motion_table("links", self, [*shown, Shown("pole_x", pole)], samples)

    # Poles, even speed

    def pole_places(self, phi: Reals) -> Reals:
        """Place of P15 on AD from A by the speeds [mm]; NaN where no digit of it is known."""
        return _pole(self, self.moving.at(phi, 1))

    def table_poles(self, samples: int | None = None) -> Table:
        """The instant centres over a revolution."""
        from gearlink.core.machines.three_gear.mechanism import columns
        from gearlink.core.numerics.arrays import turn_degrees

        return Table.of("poles", columns(self, turn_degrees(samples)))

    @cached_property
    def dwell_pole_line_error(self) -> list[float] | None:
        """Distance of A from the line of P13 and P35 in each standstill [mm]; None without one."""
        if not self.dwell_crank_angles:
            return None
        errors = []
        for phi in self.dwell_crank_angles:
            b = cmath.rect(self.crank_length, phi)
            c = self.frame_length + cmath.rect(self.rocker_length, solve(self.linkage, phi).rocker_angle)
            first, second = self.rolling_points(b, c)
            way = second - first
            apart = abs((way.conjugate() * first).imag) / abs(way)
            errors.append(without_noise(apart, _ROUNDED * self.frame_length))
        return errors

    def rolling_points(self, b: Any, c: Any) -> tuple[Any, Any]:
        """P13 and P35, where the gears roll, of the joints B and C; complex, numbers or arrays [mm].

        P13 = B + r1/(r1 + r3) (C - B),   P35 = C + r3/(r3 + r5) (D - C)
        """
        (r1, r3, _), (r3_out, r5, _) = self.rolling
        return b + r1 / (r1 + r3) * (c - b), c + r3_out / (r3_out + r5) * (self.frame_length - c)

    @cached_property
    def rolling(self) -> list[tuple[float, float, float]]:
        """Working radii [mm] of both meshes, a ring's negative and first, and the tangent of their pressure angle."""
        if self.own_teeth:
            crank, output = self.meshes.values()
            (r1, r3, flank), (r3_out, r5, flank_out) = _rolling_of(crank), _rolling_of(output)
            return [(r3, r1, flank) if r3 < 0.0 else (r1, r3, flank), (r3_out, r5, flank_out)]
        train, gears = self.train, self.spec.gears
        tangent = math.tan(math.radians(gears.pressure_angle))
        r1, r3, r5 = (0.5 * gears.module * teeth for teeth in (train.crank, train.idler, train.output))
        return [(r1, r3, tangent), (r3, r5, tangent)]

    @property
    def running(self) -> tuple[Any, Any, Any]:
        """As `FeedResults.running`."""
        ahead = self.output.ahead
        return ahead.speed, ahead.angle, self.output.ahead_turnings

    @cached_property
    def even_stretch(self) -> Uniform | None:
        """The longest stretch at a nearly even speed, where the file gives a tolerance."""
        share = self.uniform_tolerance
        if share is None:
            return None
        from gearlink.core.machines.three_gear.families import uniform

        return uniform(self.output.ahead.speed, self.output.ahead_turnings, share)

    @property
    def uniform_tolerance(self) -> float | None:
        """Share by which the speed may differ from its level."""
        return self.spec.uniform_tolerance

    uniform_angle: float | None = placed("even_stretch.angle")
    uniform_start: float | None = placed("even_stretch.start")
    uniform_ratio: float | None = placed("even_stretch.level")

    # Checks

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: gears 1 and 5, over the whole revolution."""
        if self.train.internal:
            yield ring_planes(self.layout, self.train, self.spec.limits.gear_gap)
            return
        limit, apart = self.spec.limits.gear_gap, abs(self.frame_length - self.crank_length)
        why = f"minimum centre distance {short(apart)} mm, AD - AB"
        for pair in self.layout.gear_pairs:
            remedy = self._gap_remedy(limit - pair.gap) if pair.gap < limit and self.advises else ""
            yield collision_check(pair, limit, why, remedy)

    def _gap_remedy(self, missing: float) -> str:
        """What would give the gears room."""
        if self.task is not None and not self.train.internal:
            idler = self.task.idler_with_room(self.idler_teeth)
            if idler is not None:
                return f"use an idler of {idler} teeth or more"
        module = self.spec.gears.transverse_module
        if self.spec.momentary is not None and (shorter := self._longest_crank_with_room()) is not None:
            return f"use a crank of at most {safely_below(shorter)} mm (synth momentary-dwell)"
        fewer = amount(math.ceil(2.0 * missing / module), "tooth", "teeth")
        return (
            f"increase frame minus crank by {safely_above(missing)} mm, or use {fewer} fewer on crank and output gear"
        )

    def _longest_crank_with_room(self) -> float | None:
        """Longest crank of a momentary dwell with these gears that keeps gears 1 and 5 apart [mm]."""
        module = self.spec.gears.transverse_module
        r1, r3, r5 = (0.5 * module * teeth for teeth in self.signed_teeth)
        return crank_with_room(r1, r3, r5, r1 + r5 + self.tip_excess + self.spec.limits.gear_gap)

    @property
    def tip_excess(self) -> float:
        """What the tips of gears 1 and 5 reach beyond their reference circles, together [mm]."""
        return tip_excess(self.spec.gears)

    def check_transmission_angle(self) -> Check:
        """GL303."""
        remedy = "shorten the crank or use a larger idler"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)

    def check_dwell_window(self) -> Iterator[Check]:
        """GL313 where the file asks for a window: an output that never leaves the band has one of a whole turn."""
        given, tolerance = self.spec.dwell_window, self.output_tolerance
        if given is None or tolerance is None:
            return
        asked, dwell, remedy = math.radians(given), self.tolerance_dwell, ""
        reached = 2.0 * math.pi if dwell is None else dwell.crank_angle
        if self.advises and window_judged(math.degrees(reached), given).fails:
            from gearlink.core.machines.three_gear.families import words

            remedy = words(self.window_rooms)
        yield dwell_window_check(reached, asked, tolerance, remedy)

    def check_dwell_tolerance(self) -> Iterator[Check]:
        """GL317 where the file gives a tolerance or a play: whether a dwell within it has an end."""
        if self.output_tolerance is None:
            return
        given, limit = math.degrees(self.output_tolerance), math.degrees(self.endless_tolerance)
        aside = f"net output rotation {short(2.0 * limit)} deg per revolution"
        fix = f"set the tolerance below {safely_below(limit)} deg: with a larger one the dwell never ends"
        if self.spec.dwell is not None and self.spec.dwell.tolerance is None and self.task is not None:
            fix = "reduce dwell.angle: the output steps back by more than it gains in a revolution"
        yield tolerance_judged(given, limit).check("dwell tolerance", fix, aside=aside)

    @cached_property
    def window_rooms(self) -> tuple[Room, ...]:
        """The lengths of crank or frame that meet the window of the file."""
        from gearlink.core.machines.three_gear.families import rooms

        return rooms(self, math.radians(self.spec.dwell_window or 0.0), self.output_tolerance or 0.0)

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """The lengths that meet a window; more teeth for the teeth of an idler that a task chose as the smallest."""
        if check == "dwell-window" and self.spec.dwell_window is not None:
            return (((room.key, length),) for room in self.window_rooms for length in room.built())
        gears = self.spec.gears
        if check in MESH_CHECKS and self.task is not None and gears.idler is None and gears.i3 is None:
            return ((("gears.idler", self.idler_teeth + more),) for more in counts(_MORE_TEETH))
        return ()

    def check_rounded_ratio(self) -> Iterator[Check]:
        """GL304 where the file gives i3, or a step of a chain without its sprocket: whole teeth may change either."""
        feed, fed = self.spec.feed, self.feed_per_turn
        if feed is not None and self.feed_teeth is not None and fed is not None:
            judged = ratio_judged(abs(fed), feed.step)._replace(unit="mm")
            aside = f"sprocket of {self.feed_teeth} teeth"
            yield judged.check("feed per revolution", "change feed.ratio or pitch", name="rounded-ratio", aside=aside)
        asked = self.spec.gears.i3
        if asked is None:
            return
        aside, fix = f"{self.idler_teeth} idler teeth", f"give gears.idler: {self.idler_teeth} instead of i3"
        note = "all results are of this ratio"
        yield ratio_judged(self.i3, asked).check(
            "ratio i3 of whole teeth", fix, name="rounded-ratio", aside=aside, note=note
        )


def given_tolerance(spec: ThreeGearSpec, named: float | None) -> float | None:
    """Tolerance of the output to either side [rad]: from the play at the output gear, else as named [deg]."""
    if spec.dwell_backlash is not None:
        radius = spec.gears.transverse_module * abs(spec.gears.output) / 2.0
        return dwells.tolerance_from_backlash(spec.dwell_backlash, radius)
    return None if named is None else math.radians(named)


def tip_excess(gears: Gears) -> float:
    """What the tips of gears 1 and 5 reach beyond their reference circles, together [mm].

    m (2 h_a* + x_1 + x_5 + k_1 + k_5); k = 0 where the shifts cancel in each mesh
    """
    k = gears.tip_shortening if isinstance(gears.tip_shortening, list) else (0.0, 0.0, 0.0)
    return gears.module * (2.0 * gears.addendum + gears.shift(0) + gears.shift(2) + k[0] + k[2])


def _pole(design: ThreeGearFourBar, mechanism: Mechanism) -> Reals:
    """AP15 = W AD/(W - 1) from w5/w1 = AP15/DP15 [mm]; NaN where both gears turn at one speed.

    Notes
        W - 1 is a sum with the terms 1, i1, i2 w2/w1 and i3 w3/w1, each off by some units in the last place, the speeds
        of the links by 1/sin(transmission angle) times as many. Where the sum is not above eight units of its terms, no
        digit of the pole is known: the gears turn at one speed, and the pole lies at infinity.
    """
    import numpy as np

    speed = mechanism.links["output"].turn.first
    faster = speed - 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        known = np.abs(faster) > _UNITS * np.finfo(float).eps * _terms(design, mechanism)
        return np.where(known, design.frame_length * speed / faster, np.nan)


def _terms(design: ThreeGearFourBar, mechanism: Mechanism) -> Reals:
    """The size of what W - 1 is summed from, with the condition of the speeds of the links."""
    import numpy as np

    train, coupler, rocker = design.train, mechanism.links["coupler"].turn, mechanism.links["rocker"].turn
    condition = 1.0 / np.abs(np.sin(coupler.value - rocker.value))
    of_links = np.abs(train.coupler_share * coupler.first) + np.abs(train.rocker_share * rocker.first)
    return np.asarray(1.0 + abs(train.ratio) + condition * of_links)


def layout(links: FourBar, train: GearTrain, spec: ThreeGearSpec, own: Mapping[str, Any] | None = None) -> Layout:
    """Gears, shafts and distances; the crank gear is one body with crank and input shaft.

    Parameters
        links : FourBar [mm]
        own : dict of GearPair - meshes with teeth of their own; None: standard teeth
    """
    gears, module, shafts, mates = spec.gears, spec.gears.module, spec.shafts, "CD" if train.internal else "C"
    if own is None:
        crank = _standard("B", train.crank, train, "the crank gear", gears, mates)
        idler = tip_radius(train.idler, module)
        output = _standard("D", train.output, train, "the output gear", gears, "C")
    else:
        first, second = own.values()
        crank = _end("B", first, "the crank gear", gears, mates)
        idler = first.tip_radius[0 if first.internal else 1]  # in the pair of a ring it is the first
        output = _end("D", second, "the output gear", gears, "C")
    return Layout(
        gears=(crank, Gear("the idler", "C", idler, mates="BD"), output),
        shafts=(
            Shaft("input shaft", "A", shafts.input_radius if shafts else None, "shafts.input_radius"),
            Shaft("output shaft", "D", shafts.output_radius if shafts else None, "shafts.output_radius"),
        ),
        reaches={
            "AC": coupler_joint(links),
            "AD": constant(links.frame),
            "BD": crank_pin(links.crank, links.frame),
            "CD": constant(links.rocker),
        },
        least_shaft=least_shaft(spec.limits, module),
    )


def _standard(axis: str, teeth: float, train: GearTrain, name: str, gears: Gears, mates: str) -> Gear:
    """Crank or output gear with standard teeth; a ring for negative ones."""
    if teeth < 0:
        return _end(axis, GearPair.from_shift(gears.module, (int(train.idler), int(teeth))), name, gears, mates)
    tip = tip_radius(teeth, gears.module)
    return Gear(name, axis, tip, mates=mates, root=tip - FULL_HEIGHT * gears.module)


def _outer(axis: str, mesh: Any, gears: Gears) -> float:
    """Outer radius of a ring on B or D [mm]; the key `rim` is that of the output ring."""
    root, given = mesh.root_radius[1], gears.rim if axis == "D" else None
    return rim_radius(root, mesh.module, gears.rim_at(0 if axis == "B" else 2, root) if given is None else given)


def _end(axis: str, pair: Any, name: str, gears: Gears, mates: str) -> Gear:
    """Crank or output gear of its pair; a ring stands in a plane of its own, apart from the other gear."""
    if pair.internal:
        return Gear(f"{name}, a ring,", axis, _outer(axis, pair, gears), -pair.tip_radius[1], mates)
    place = 0 if axis == "B" else 1
    return Gear(name, axis, pair.tip_radius[place], mates=mates, root=pair.root_radius[place])


def ring_planes(layout: Layout, train: GearTrain, limit: float) -> Check:
    """GL301 of a train with a ring: the third gear stays within it, or must stand in another plane.

    Parameters
        layout : Layout - gears 1, idler and 5
        limit : float [mm] - minimum gap
    """
    crank, _, output = layout.gears
    gap = least_gap(crank, output, layout.reaches["BD"]).gap
    ring, other = ("the output ring", "the crank gear") if train.output < 0 else ("the crank ring", "the output gear")
    if gap >= limit:
        return GEAR_COLLISION.check("pass", f"gap between the tips of {other} and {ring}", gap, limit, "mm")
    fix = "put both gears in separate planes, side by side on a wide idler"
    return GEAR_COLLISION.check("warn", f"{other} sweeps through {ring}", fix=fix)


def _rolling_of(pair: Any) -> tuple[float, float, float]:
    r1, r2 = pair.working_radius
    return r1, r2, math.tan(pair.working_pressure_angle)
