"""The two-gear four-bar as a design: a gear on the coupler drives one that is free on the crank's axis."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any, ClassVar

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.real_speed import OUTPUT_SPEEDS, OutputSpeed, per_time
from gearlink.core.base.remedies.ways import down, either, up
from gearlink.core.base.report import Check, Remedy, Shown, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage, standstill_coupler_ratio
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, TRAIN_CHECKS, Meshed, train_ways
from gearlink.core.parts.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.checks import check_linkage, dwell_window_check, of_gears, transmission_check
from gearlink.core.parts.linkages.codes import DWELL_CONDITION
from gearlink.core.parts.linkages.feed import FEED_QUANTITIES, FeedResults
from gearlink.core.parts.linkages.fourbar.nearest_passes import rocker_swing
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import BackStep, OutputRates, Turning
from gearlink.core.studies.clearance import (
    SHAFT_WAYS,
    Gear,
    Layout,
    WithShafts,
    constant,
    crank_pin,
    least_shaft,
    ring_gear,
    shafts_at,
)

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.two_gear_family import Family
    from gearlink.core.machines.planet_linkages.two_gear_spec import TwoGearFourBarSpec
    from gearlink.core.parts.linkages.band_dwell import AlwaysStepping, ToleranceDwell


# As in the three-gear four-bar: links that no workshop can tell apart have one standstill, not two or none.
_STANDSTILL_TOLERANCE = 1e-9

QUANTITIES = (
    *("planet_teeth", "output_teeth", "gear_ratio", "linkage_kind", "crank_length", "coupler_length", "rocker_length"),
    *("frame_length", "mean_ratio", "speed_ratio_max", "speed_ratio_min", "speed_ratio_max_at", "speed_ratio_min_at"),
    *("nonuniformity", "coupler_ratio_max", "coupler_ratio_min", "standstill_coupler_ratio", "dwell_teeth_ratio"),
    *("motion", "dwell_crank_angles", "back_step_angle", "back_step_crank_angle", "min_transmission_angle"),
    *("contact_ratio", *names("acceleration_ratio"), "rocker_swing", "input_speed", "turn_time", *OUTPUT_SPEEDS),
    *("back_step_time", *FEED_QUANTITIES),
)
OF_DWELL = ("tolerance_dwell_angle", "tolerance_dwell_start", "tolerance_dwell_time")
CHECKS = ("dwell-condition", "shaft-clearance", "shaft-seat", "transmission-angle", *MESH_CHECKS, "backlash",
          "lay-speed")  # fmt: skip

UNIDIRECTIONAL, MOMENTARY_DWELL, BACK_STEP = "unidirectional", "momentary-dwell", "back-step"


_TEETH = tuple(up(f"gears.{gear}", step=1) for gear in ("planet", "sun", "ring"))
_FEWER = tuple(down(f"gears.{gear}", step=1) for gear in ("planet", "sun", "ring"))
_LINKS = either("links.frame", "links.rocker", "links.coupler")


class TwoGearFourBar(OutputRates, OutputSpeed, FeedResults, WithShafts, Meshed):
    """Planet on the coupler, sun or ring gear on the crank's axis; the crank is their centre distance."""

    kind = "two-gear-four-bar"
    spec: TwoGearFourBarSpec
    keys = {
        "analyze": (
            *("motion", ("tolerance_dwell_angle", "dwell_window"), "back_step_angle", "dwell_crank_angles"),
            *("mean_ratio", "speed_ratio_max", "speed_ratio_min", "output_acceleration_max", "feed_per_turn"),
            *(("min_transmission_angle", ">limits.transmission_angle"), "linkage_kind", "acceleration_ratio_max"),
        )
    }
    outlines = {
        "analyze": Outline((*QUANTITIES, *OF_DWELL), ("dwell-window", *CHECKS), ("motion",)),
        "gear": Outline((*OF_MESH, "output_play"), (*MESH_CHECKS, *TRAIN_CHECKS)),
    }

    extra_tables: ClassVar[tuple[str, ...]] = ("links", "drawing", "factors")
    ways = {
        "dwell-condition": (*_TEETH, *_FEWER, *_LINKS),
        "dwell-window": (*_LINKS, up("dwell_tolerance", step=0.01), down("dwell_window", step=0.1)),
        "shaft-clearance": (*SHAFT_WAYS, *_LINKS, *_FEWER, *_TEETH),
        "transmission-angle": (*_LINKS, *_FEWER, *_TEETH),
        **train_ways(2, *_TEETH),
    }

    seeks: ClassVar[bool] = False
    """Whether the frame is sought: of a synthesis, to which gears, coupler and rocker are given."""

    def __init__(self, spec: Any) -> None:
        super().__init__(spec)
        if self.seeks:
            self.require_proportion()

    @property
    def cost(self) -> float:
        """An analysis takes a tenth of a millisecond, a frame that is sought for a back-step some hundredths of a
        second each time, a search over the whole range of frames three times as long."""
        if not self.seeks:
            return 0.3
        return 40.0 if self.__dict__.get("always") else 13.5

    def completion(self) -> Iterator[Found]:
        """The frame instead of the task."""
        if self.seeks:
            synthesis = next(command for command in self.outlines if command.startswith("synth"))
            yield Found("links.frame", self.frame_length, f"found by {synthesis}")
            yield from (Found(section, None) for section in ("dwell", "back_step"))

    # Gears and links

    planet_teeth: int = placed("spec.gears.planet")

    @property
    def internal(self) -> bool:
        """Whether the output is a ring gear."""
        return self.spec.gears.ring is not None

    @property
    def output_teeth(self) -> int:
        """Teeth of the output gear."""
        gears = self.spec.gears
        return gears.ring or gears.sun or 0

    @property
    def gear_ratio(self) -> float:
        """Ratio i of planet and output gear, negative for an external mesh."""
        return self.planet_teeth / self.output_teeth * (1.0 if self.internal else -1.0)

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Planet and output gear."""
        return self.planet_teeth, -self.output_teeth if self.internal else self.output_teeth

    @property
    def given_distances(self) -> tuple[float | None, ...]:
        """The crank, where the file gives it."""
        return (self.spec.links.crank,)

    @property
    def crank_length(self) -> float:
        """Centre distance of the gears [mm]; without profile shift m_t (z2 + z5)/2 or m_t (z5 - z2)/2."""
        if self.own_teeth:
            return self.distance()
        sign = -1 if self.internal else 1
        return self.spec.gears.module * (self.output_teeth + sign * self.planet_teeth) / 2.0

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar, with the frame that meets the task of a synthesis."""
        frame = self.spec.links.frame
        if self.seeks and frame is not None:
            raise NoSolution("this command determines links.frame", key="links.frame", fix="omit it")
        return self.linkage_of(self.sought_frame() if frame is None else frame)

    def sought_frame(self) -> float:
        """The frame [mm] that meets the task of a synthesis."""
        raise MissingSection("this command needs links.frame; a synth command finds it", key="links.frame")

    @cached_property
    def family(self) -> Family:
        """Gears and links without the frame."""
        from gearlink.core.machines.planet_linkages.two_gear_family import Family

        links = self.spec.links
        return Family(self.checked_crank(), links.coupler, links.rocker, self.gear_ratio, self.spec.assembly)

    @cached_property
    def always(self) -> AlwaysStepping | None:
        """The frames, where the output steps back with each of them; else a search starts at a momentary dwell."""
        from gearlink.core.machines.planet_linkages.two_gear_family import always_stepping

        return always_stepping(self.family)

    def linkage_of(self, frame: float) -> FourBar:
        """The four-bar of a frame [mm]."""
        links = self.spec.links
        with at_key("links"):
            linkage = FourBar(self.checked_crank(), links.coupler, links.rocker, frame, self.spec.assembly)
            check_linkage(linkage)
        return linkage

    def checked_crank(self) -> float:
        """Centre distance of the gears [mm], which a crank in the file must agree with."""
        return of_gears("crank", self.spec.links.crank, self.crank_length, self.spec.gears)

    @property
    def linkage_kind(self) -> str:
        """Class of the four-bar."""
        return self.linkage.kind()

    coupler_length: float = placed("linkage.coupler")
    rocker_length: float = placed("linkage.rocker")
    frame_length: float = placed("linkage.frame")

    # Motion

    @cached_property
    def drive(self) -> PlanetLinkage:
        """The kernel's view of gears and links."""
        return PlanetLinkage(self.linkage, self.gear_ratio, "crank")

    mean_ratio: float = placed("drive.mean_ratio")
    speed_turnings: list[Turning] = placed("drive.speed_turnings")
    acceleration_turnings: list[Turning] = placed("drive.acceleration_turnings")

    @cached_property
    def coupler_turnings(self) -> list[Turning]:
        """Extremes of the coupler's speed per crank speed; those of the output lie at the same crank angles."""
        return self.drive.coupler_turnings()

    @property
    def running(self) -> tuple[Any, Any, Any]:
        """As `FeedResults.running`; the mean motion is the crank's way."""
        return self.drive.speed, self.drive.angle, self.speed_turnings

    @property
    def coupler_ratio_max(self) -> float:
        """Maximum coupler speed per crank speed."""
        return max(t.value for t in self.coupler_turnings)

    @property
    def coupler_ratio_min(self) -> float:
        """Minimum coupler speed per crank speed."""
        return min(t.value for t in self.coupler_turnings)

    back_step_time: float | None = per_time("back_step_crank_angle", -1)

    @property
    def rocker_swing(self) -> float | None:
        """Swing of the rocker between its dead centres [rad]; a drag link has none."""
        return rocker_swing(self.linkage)

    @property
    def nonuniformity(self) -> float:
        """(max - min)/mean of the speed ratio."""
        return (self.speed_ratio_max - self.speed_ratio_min) / self.mean_ratio

    @property
    def standstill_coupler_ratio(self) -> float:
        """Coupler speed per crank speed at which the output stands."""
        return standstill_coupler_ratio(self.gear_ratio)

    @property
    def dwell_teeth_ratio(self) -> float | None:
        """Maximum z5/z2 with which these links stop the output; none where no teeth do."""
        reach = 1.0 - self.coupler_ratio_min if self.internal else self.coupler_ratio_max - 1.0
        return reach if reach > (1.0 if self.internal else 0.0) else None

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """Crank angles of zero output speed [rad], ascending."""
        tolerance = _STANDSTILL_TOLERANCE * (1.0 + 2.0 * abs(self.gear_ratio))
        return standstills.standstills(self.drive.speed, self.speed_turnings, tolerance)

    @cached_property
    def back_steps(self) -> list[BackStep]:
        """Every back-step of the turn."""
        return standstills.back_steps(self.drive.speed, self.drive.angle, self.dwell_crank_angles)

    @cached_property
    def motion(self) -> str:
        """unidirectional, momentary-dwell or back-step."""
        if self.back_steps:
            return BACK_STEP
        return MOMENTARY_DWELL if self.dwell_crank_angles else UNIDIRECTIONAL

    @cached_property
    def back_step(self) -> BackStep | None:
        """The back-step that loses most, where there is one."""
        return max(self.back_steps, key=lambda step: step.angle, default=None)

    back_step_angle: float | None = placed("back_step.angle")
    back_step_crank_angle: float | None = placed("back_step.crank_angle")

    @property
    def output_tolerance(self) -> float | None:
        """Tolerance of the output to either side within which its dwell is measured [rad]; None without one."""
        given = self.spec.dwell_tolerance
        return None if given is None else math.radians(given)

    @cached_property
    def tolerance_dwell(self) -> ToleranceDwell | None:
        """The longest dwell within the tolerance; None without one.

        Raises
            NoSolution - for a tolerance so wide that the whole revolution lies within it
        """
        with at_key("dwell_tolerance"):
            return None if self.output_tolerance is None else self.drive.within(self.output_tolerance)

    tolerance_dwell_angle: float | None = placed("tolerance_dwell.crank_angle")
    tolerance_dwell_start: float | None = placed("tolerance_dwell.start")
    tolerance_dwell_time: float | None = per_time("tolerance_dwell_angle", -1)

    @property
    def min_transmission_angle(self) -> float:
        """Minimum transmission angle over the revolution [rad]."""
        return self.linkage.min_transmission_angle()

    @cached_property
    def layout(self) -> Layout:
        """Planet on B, sun or ring gear on A."""
        links, spec, mesh = self.linkage, self.spec, self.mesh
        output = (
            ring_gear("A", mesh, rim=self.outer_rim())
            if self.internal
            else Gear("the sun", "A", mesh.tip_radius[1], root=mesh.root_radius[1])
        )
        gears = Gear("the planet", "B", mesh.tip_radius[0], mates="A"), output
        reaches = {"AB": constant(links.crank), "AD": constant(links.frame), "BD": crank_pin(links.crank, links.frame)}
        return Layout(gears, shafts_at("AD", spec.shafts), reaches, least_shaft(spec.limits, spec.gears.module))

    def table_motion(self, samples: int | None = None) -> Table:
        """Output angle, speed and acceleration, coupler speed and transmission angle over a revolution of the crank."""
        from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
        from gearlink.core.mechanism.courses import Shown, between, motion_table, of_output, turned

        shown = [
            *of_output(OUTPUT),
            Shown("coupler_ratio", turned("coupler"), 1, "coupler_speed"),
            Shown("transmission_angle", between("coupler", "rocker")),
        ]
        return motion_table("motion", self, shown, samples)

    def table_links(self, samples: int | None = None) -> Table:
        """Angle, speed, acceleration and jerk of every link over a revolution of the crank."""
        from gearlink.core.mechanism.courses import all_rates, motion_table, turned

        shown = all_rates({name: turned(name) for name in ("coupler", "rocker", "output")})
        return motion_table("links", self, shown, samples)

    # Checks

    def candidates(self, check: str, /) -> Iterator[Remedy]:
        """The frame that a synthesis finds: no step of a grid meets the momentary dwell, few the window."""
        target = self.spec.target
        from gearlink.core.machines.planet_linkages.two_gear_family import flattest, momentary_frame

        if check == "dwell-window" and self.spec.dwell_window is not None:
            with suppress(NoSolution):
                frame, _ = flattest(self.family, math.radians(self.spec.dwell_window), "the window")
                yield (("links.frame", round(frame, 2)),)
        if check == "dwell-condition" and target is not None and target.motion == MOMENTARY_DWELL:
            yield (("links.frame", momentary_frame(self.family)),)

    def check_dwell_window(self) -> Iterator[Check]:
        """GL313 where the file asks for a window within its tolerance."""
        dwell, tolerance, asked = self.tolerance_dwell, self.output_tolerance, self.spec.dwell_window
        if dwell is not None and tolerance is not None and asked is not None:
            yield dwell_window_check(dwell.crank_angle, math.radians(asked), tolerance)

    def check_dwell_condition(self) -> Check:
        """GL306: whether the output stands still, by how much, and whether that is what the file asks for."""
        needed = self.standstill_coupler_ratio
        reached = self.coupler_ratio_min if self.internal else self.coupler_ratio_max
        aside = f"{self.motion}; the output stops at {short(needed)}"
        what = f"{'minimum' if self.internal else 'maximum'} coupler ratio w2/w1"
        shown = Shown(reached)
        asked = None if self.spec.target is None else self.spec.target.motion
        if asked is None or asked == self.motion:
            return DWELL_CONDITION.check("pass", what, reached, needed, shown=shown, aside=aside)
        if self._never_stands() and asked != UNIDIRECTIONAL:
            fix = "use a ring gear, or a drag link (frame the shortest)"
            raise NoSolution(f"{asked} is impossible: {self._never_stands()}", key="target.motion", fix=fix)
        fix = self._motion_remedy(asked)
        return DWELL_CONDITION.check("fail", f"no {asked}, {what}", reached, needed, shown=shown, aside=aside, fix=fix)

    def _never_stands(self) -> str:
        """Why an external mesh on a crank-rocker never stops its output; empty for other drives."""
        if self.internal or self.linkage_kind != "crank-rocker":
            return ""
        return (
            f"the output stops where w2/w1 = 1 + z5/z2 = {short(self.standstill_coupler_ratio)}, in a crank-rocker "
            f"w2/w1 stays below 1 (here {short(self.coupler_ratio_max)})"
        )

    def _motion_remedy(self, asked: str) -> str:
        """What would bring the motion that is asked for."""
        limit, have = self.dwell_teeth_ratio, self.output_teeth / self.planet_teeth
        if limit is None:
            return "change the links: no numbers of teeth stop the output with these"
        if asked == MOMENTARY_DWELL:
            return f"set z5/z2 to {short(limit)} (now {short(have)})"
        side, bound = ("above", safely_above(limit)) if asked == UNIDIRECTIONAL else ("below", safely_below(limit))
        return f"set z5/z2 {side} {bound} (now {short(have)})"

    def check_transmission_angle(self) -> Check:
        """GL303."""
        remedy = "shorten the crank (the frame of a drag link)"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)
