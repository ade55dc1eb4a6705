"""A rocker with a multiplied swing as a design: a gear on the coupler drives one on the rocker's axis."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, cast

from gearlink.core.clearance.bodies import Layout
from gearlink.core.clearance.checks import SHAFT_WAYS, shaft_checks, shaft_seat
from gearlink.core.design import Found, Outline, placed
from gearlink.core.errors import NoSolution, at_key
from gearlink.core.gears.checks import GEAR_CHECKS
from gearlink.core.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.gears.train.meshed import Meshed
from gearlink.core.gears.train.names import TRAIN_CHECKS
from gearlink.core.gears.train.ways import train_ways
from gearlink.core.linkages.checks import check_linkage, target_check, transmission_check
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.linkages.fourbar.swing import rocker_swing
from gearlink.core.linkages.output_rates import OutputRates
from gearlink.core.linkages.standstills import Turning, turnings
from gearlink.core.motion_extremes import names
from gearlink.core.planet_linkages.bodies import rocker_layout
from gearlink.core.planet_linkages.planet import PlanetLinkage
from gearlink.core.planet_linkages.rocker_synthesis import crank_for_swing, extreme_crank_angles
from gearlink.core.real_speed import OUTPUT_SPEEDS, RealSpeed
from gearlink.core.remedies.ways import down, either, up
from gearlink.core.report import Check, Table
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.gears.mesh.pair import GearPair
    from gearlink.core.planet_linkages.rocker_spec import GearedRockerSpec

_LINK_TOLERANCE = 1e-9
# A root to the last bit leaves some ulp of the swing: far below what teeth can tell.
_SWING_TOLERANCE = math.radians(1e-9)


_TEETH = (up("gears.coupler", step=1), up("gears.output", step=1), up("gears.coupler", "gears.output", step=1))
_FEWER = (down("gears.coupler", step=1), down("gears.output", step=1))
_LINKS = either("links.crank", "links.frame", "links.coupler")
_OF_TEETH = train_ways(2, *_TEETH)
_CRANK = 11.0
"""Trials of a crank that is given, which one that is sought takes as long as."""


class GearedRocker(OutputRates, RealSpeed, Meshed):
    """Crank-rocker with a gear on the coupler at C and the output gear on D; the rocker is their centre distance."""

    kind = "geared-rocker"
    spec: GearedRockerSpec
    outlines = {
        "analyze": Outline(
            (
                "coupler_gear_teeth",
                "output_teeth",
                "gear_ratio",
                "crank_length",
                "coupler_length",
                "rocker_length",
                "frame_length",
                "rocker_swing",
                "output_swing",
                "swing_multiple",
                "naive_multiple",
                "extreme_crank_angles",
                *names("speed_ratio"),
                *names("acceleration_ratio"),
                "min_transmission_angle",
                "swing_residual",
                "contact_ratio",
                "input_speed",
                "turn_time",
                *OUTPUT_SPEEDS,
            ),
            ("target", "shaft-clearance", "shaft-seat", "transmission-angle", *GEAR_CHECKS, "backlash"),
            ("motion",),
        ),
        "gear": Outline((*OF_MESH, "output_play"), (*GEAR_CHECKS, *TRAIN_CHECKS)),
    }

    extra_tables = ("links", "drawing", "candidates")
    ways = {
        "shaft-clearance": (*SHAFT_WAYS, *_LINKS, *_FEWER, *_TEETH),
        "transmission-angle": (*_LINKS, *_TEETH, *_FEWER),
        **_OF_TEETH,
        "backlash": (*_OF_TEETH["backlash"], *either("links.rocker", step=0.01)),
    }

    @property
    def cost(self) -> float:
        """A crank that is sought for a swing takes ten milliseconds."""
        return _CRANK if self.spec.target is not None and "crank_length" in self.__dict__ else 1.5

    def completion(self) -> Iterator[Found]:
        """The crank in place of the target."""
        if self.spec.target is not None:
            yield Found("links.crank", self.crank_length, "found for target.swing")
            yield Found("target", None)

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The wanted swing by other teeth; the rocker is their centre distance."""
        from gearlink.core.candidates import Sought, around, nothing_sought, pairs, table

        if self.spec.target is None:
            raise nothing_sought("give target: {swing} in place of links.crank")
        keys = {"gears.coupler": ("coupler_gear_teeth", "1"), "gears.output": ("output_teeth", "1")}
        gears = self.spec.gears
        outputs = sorted({max(1, round(share * gears.output)) for share in (0.85, 1.0, 1.2)})
        shown = ("crank_length", "rocker_length", "rocker_swing", "swing_multiple", "speed_ratio_max")
        found = (*shown, "acceleration_ratio_max", "min_transmission_angle")
        return table(self, Sought("analyze", keys, pairs(around(gears.coupler), outputs), found))

    # Gears and links

    coupler_gear_teeth: int = placed("spec.gears.coupler")
    output_teeth: int = placed("spec.gears.output")

    @property
    def gear_ratio(self) -> float:
        """Ratio i = -z2/z5."""
        return -self.coupler_gear_teeth / self.output_teeth

    @property
    def mesh(self) -> GearPair:
        """Coupler gear and output gear."""
        return cast("GearPair", super().mesh)

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Coupler gear and output gear."""
        return self.coupler_gear_teeth, self.output_teeth

    @property
    def given_distances(self) -> tuple[float | None, ...]:
        """The rocker, where the file gives it."""
        return (self.spec.links.rocker,)

    @property
    def rocker_length(self) -> float:
        """Centre distance of the gears [mm]."""
        if self.own_teeth:
            return self.distance()
        return self.spec.gears.module * (self.coupler_gear_teeth + self.output_teeth) / 2.0

    coupler_length: float = placed("spec.links.coupler")
    frame_length: float = placed("spec.links.frame")

    @cached_property
    def crank_length(self) -> float:
        """Crank [mm], given or found from the target."""
        links, target = self.spec.links, self.spec.target
        if links.crank is not None or target is None:
            return links.crank or 0.0
        swing = math.radians(target.swing)
        with at_key("target.swing"):
            return crank_for_swing(
                links.coupler, self.rocker_length, links.frame, self.spec.assembly, self.gear_ratio, swing
            )

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar: a crank-rocker."""
        links, rocker = self.spec.links, self.rocker_length
        given = rocker if links.rocker is None or self.spec.gears.profile_shift is not None else links.rocker
        if abs(given - rocker) > _LINK_TOLERANCE * rocker:
            raise NoSolution(
                f"rocker {given:.9g} mm is not the centre distance of the gears, {rocker:.9g} mm: leave it out, "
                "or change module or teeth",
                key="links.rocker",
            )
        with at_key("links"):
            linkage = FourBar(self.crank_length, links.coupler, rocker, links.frame, self.spec.assembly)
            if check_linkage(linkage) != "crank-rocker":
                raise NoSolution(
                    f"the frame {links.frame:.6g} mm is the shortest link, so that the rocker goes all the way round: "
                    f"make it longer than the crank, {self.crank_length:.6g} mm"
                )
        return linkage

    # Motion

    @cached_property
    def drive(self) -> PlanetLinkage:
        """The kernel's view of gears and links."""
        return PlanetLinkage(self.linkage, self.gear_ratio, "rocker")

    @cached_property
    def extreme_crank_angles(self) -> list[float]:
        """Crank angles at which the output reverses [rad]."""
        return extreme_crank_angles(self.drive)

    @property
    def output_swing(self) -> float:
        """Swing of the output gear [rad]."""
        angles = [self.drive.angle(phi) for phi in self.extreme_crank_angles]
        return max(angles) - min(angles)

    @property
    def rocker_swing(self) -> float:
        """Swing of the rocker between the dead centres [rad]."""
        swing = rocker_swing(self.linkage)
        assert swing is not None, "the linkage is a crank-rocker"
        return swing

    @property
    def swing_multiple(self) -> float | None:
        """Output swing over rocker swing; None where no number is small enough for the rocker's."""
        return self.output_swing / self.rocker_swing if self.rocker_swing else None

    @property
    def naive_multiple(self) -> float:
        """1 + z2/z5, which leaves the turning of the coupler out."""
        return 1.0 - self.gear_ratio

    @property
    def swing_residual(self) -> float | None:
        """Swing reached less swing asked for [rad]."""
        target = self.spec.target
        return None if target is None else self.output_swing - math.radians(target.swing)

    @cached_property
    def speed_turnings(self) -> list[Turning]:
        """Extremes of the output's speed ratio."""
        return turnings(self.drive.speed, self.drive.acceleration)

    @cached_property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of its acceleration ratio."""
        return turnings(self.drive.acceleration, self.drive.jerk)

    @property
    def min_transmission_angle(self) -> float:
        """Least transmission angle over the turn [rad]."""
        return self.linkage.min_transmission_angle()

    @cached_property
    def layout(self) -> Layout:
        """The bodies in the plane of the gears."""
        return rocker_layout(self)

    def table_motion(self, samples: int | None = None) -> Table:
        """Rocker and output over a turn of the crank; the output angle counts from its place at crank angle 0."""
        from gearlink.core.mechanism.courses import Shown, between, motion_table, turned
        from gearlink.core.planet_linkages.mechanism import OUTPUT

        shown = [
            Shown("rocker_angle", turned("rocker")),
            Shown("output_angle", OUTPUT),
            Shown("speed_ratio", OUTPUT, 1, "output_speed"),
            Shown("acceleration_ratio", OUTPUT, 2, "output_acceleration"),
            Shown("transmission_angle", between("coupler", "rocker")),
        ]
        return motion_table("motion", self, shown, samples)

    def table_links(self, samples: int | None = None) -> Table:
        """Angle, speed, acceleration and jerk of every link over a turn of the crank."""
        from gearlink.core.mechanism.courses import all_rates, motion_table, turned

        shown = all_rates({name: turned(name) for name in ("coupler", "rocker", "output")})
        return motion_table("links", self, shown, samples)

    # Checks

    def check_target(self) -> Iterator[Check]:
        """GL307, where the file asks for a swing."""
        if self.swing_residual is not None:
            degrees = math.degrees(self.swing_residual)
            yield target_check("the swing of the output", degrees, math.degrees(_SWING_TOLERANCE), "deg")

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302."""
        return shaft_checks(self.layout)

    check_shaft_seat = shaft_seat

    def check_transmission_angle(self) -> Check:
        """GL303."""
        remedy = "shorten the crank, and gain the swing by more teeth on the coupler gear"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)
