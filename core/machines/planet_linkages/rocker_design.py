"""A rocker with a multiplied swing as a design: a gear on the coupler drives one on the rocker's axis."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import OUTPUT_SPEEDS, OutputSpeed, RealSpeed
from gearlink.core.base.remedies.ways import down, either, up
from gearlink.core.base.report import Check, Table, safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.gears.checks import GEAR_CHECKS
from gearlink.core.parts.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.parts.gears.train.meshed import TRAIN_CHECKS, Meshed, train_ways
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.checks import check_linkage, of_gears, target_check, transmission_check
from gearlink.core.parts.linkages.fourbar.nearest_passes import rocker_swing
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import OutputRates, Turning
from gearlink.core.studies.clearance import (
    SHAFT_WAYS,
    Gear,
    Layout,
    WithShafts,
    constant,
    coupler_joint,
    least_shaft,
    shafts_at,
)

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.rocker_spec import GearedRockerSpec


# The crank that gives the output of a geared rocker its swing

_STEPS = 48
# The swing is sought up to this share of the longest crank; beyond it the transmission angle is below a degree.
_LARGEST = 1.0 - 1e-6
# And from this share on: the swing of a vanishing crank is zero, but its linkage has no extremes to find.
_SMALLEST = 1e-6


def extreme_crank_angles(drive: PlanetLinkage) -> list[float]:
    """Crank angles at which the output of a geared rocker reverses.

    (1 - i) w3 + i w2 = 0: the line AB passes through the pitch point of the gears on CD

    Parameters
        drive : PlanetLinkage - its carrier the rocker
    Returns
        places : list of float [rad] - ascending in [0, 2 pi); not the dead centres of the linkage
    Example
        >>> drive = PlanetLinkage(FourBar(20.0, 70.0, 60.0, 80.0), -1.5, "rocker")
        >>> [round(math.degrees(phi), 9) for phi in extreme_crank_angles(drive)]
        [17.4224633, 194.290488458]

    Source
        own derivation; thesis 2.2.2, figure 2-4 takes the swing for a multiple of the rocker's
    """
    return standstills.zeros_over_turn(drive.speed)


def output_swing(drive: PlanetLinkage) -> float:
    """Swing of the output gear of a geared rocker between its own extremes [rad].

    Parameters
        drive : PlanetLinkage - its carrier the rocker of a crank-rocker
    Returns
        swing : float [rad]
    Example
        >>> round(math.degrees(output_swing(PlanetLinkage(FourBar(20.0, 70.0, 60.0, 80.0), -1.5, "rocker"))), 9)
        101.175579602
    """
    angles = [drive.angle(phi) for phi in extreme_crank_angles(drive)]
    return max(angles) - min(angles)


def longest_crank(coupler: float, rocker: float, frame: float) -> float:
    """Crank at which a crank-rocker of the other three links becomes a change-point linkage [mm].

    a_max = b + c + d - 2 max(b, c, d)

    Raises
        NoSolution - where the longest of the three is not shorter than the other two together
    Example
        >>> longest_crank(70.0, 60.0, 80.0)
        50.0

    Source
        own derivation: Grashof's rule with the crank the shortest
    """
    longest = max(coupler, rocker, frame)
    room = math.fsum((coupler, rocker, frame, -2.0 * longest))
    if room <= 0.0:
        raise NoSolution(
            f"no crank turns with coupler {coupler:g}, rocker {rocker:g} and frame {frame:g} mm: the longest must be "
            f"shorter than the other two together, {coupler + rocker + frame - longest:g} mm"
        )
    return min(room, coupler, rocker, frame)


def crank_for_swing(coupler: float, rocker: float, frame: float, assembly: int, ratio: float, swing: float) -> float:
    """Shortest crank with which the output of a geared rocker swings by a given angle.

    Parameters
        coupler, rocker, frame : float [mm]
        assembly : +1 or -1
        ratio : float - i = -z2/z5
        swing : float [rad] - of the output gear
    Returns
        crank : float [mm]
    Raises
        NoSolution - where no crank-rocker of these links and gears swings so far
    Notes
        The swing is computed on the linkage of each crank that is tried; the shortest crank has the best transmission
        angles.
    Example
        >>> round(crank_for_swing(70.0, 60.0, 80.0, 1, -1.5, math.radians(120.0)), 9)
        23.507018829
    """
    limit = _LARGEST * longest_crank(coupler, rocker, frame)

    def excess(crank: float) -> float:
        return output_swing(PlanetLinkage(FourBar(crank, coupler, rocker, frame, assembly), ratio, "rocker")) - swing

    low, greatest = 0.0, -swing
    for i in range(1, _STEPS + 1):
        crank = limit * i / _STEPS
        value = excess(crank)
        if value >= 0.0:
            return bracketed_root(excess, low or _least_crank(excess, limit, swing), crank)
        low, greatest = crank, max(greatest, value)
    reach = math.degrees(greatest + swing)
    raise NoSolution(
        f"swing: {unlike(math.degrees(swing), reach)} deg (limit <= {math.floor(reach * 10.0) / 10.0:g} deg "
        "with these links and gears)",
        fix=f"reduce swing, or use more teeth on the coupler gear (now z2/z5 = {short(abs(ratio))})",
    )


def _least_crank(excess: Callable[[float], float], limit: float, swing: float) -> float:
    """A crank that swings the output less than is asked for.

    Raises
        NoSolution - where even the shortest that is tried swings it farther
    """
    crank = limit * _SMALLEST
    if (over := excess(crank)) >= 0.0:
        raise NoSolution(
            f"swing: {short(math.degrees(swing))} deg, too small to be computed",
            fix=f"set target.swing to at least {safely_above(math.degrees(over + swing), 3)} deg",
        )
    return crank


# A root to the last bit leaves some ulp of the swing: far below what teeth can tell.
_SWING_TOLERANCE = math.radians(1e-9)


_TEETH = (up("gears.coupler", step=1), up("gears.output", step=1), up("gears.coupler", "gears.output", step=1))
_FEWER = (down("gears.coupler", step=1), down("gears.output", step=1))
_LINKS = either("links.crank", "links.frame", "links.coupler")
_OF_TEETH = train_ways(2, *_TEETH)
_CRANK = 11.0
"""Trials of a crank that is given, which one that is sought takes as long as."""


class GearedRocker(OutputRates, OutputSpeed, RealSpeed, WithShafts, Meshed):
    """Crank-rocker with a gear on the coupler at C and the output gear on D; the rocker is their centre distance."""

    kind = "geared-rocker"
    spec: GearedRockerSpec
    keys = {
        "analyze": (
            *(("output_swing", "target.swing"), "crank_length", "swing_multiple", "rocker_swing"),
            *("extreme_crank_angles", ("min_transmission_angle", ">limits.transmission_angle"), "output_speed_max"),
            *("output_acceleration_max", "speed_ratio_max", "acceleration_ratio_max", "contact_ratio"),
        )
    }
    outlines = {
        "analyze": Outline(
            (
                *("coupler_gear_teeth", "output_teeth", "gear_ratio", "crank_length", "coupler_length"),
                *("rocker_length", "frame_length", "rocker_swing", "output_swing", "swing_multiple", "naive_multiple"),
                *("extreme_crank_angles", *names("speed_ratio"), *names("acceleration_ratio")),
                *("min_transmission_angle", "swing_residual", "contact_ratio", "input_speed", "turn_time"),
                *OUTPUT_SPEEDS,
            ),
            ("target", "shaft-clearance", "shaft-seat", "transmission-angle", *GEAR_CHECKS, "backlash"),
            ("motion",),
        ),
        "gear": Outline((*OF_MESH, "output_play"), (*GEAR_CHECKS, *TRAIN_CHECKS)),
    }

    extra_tables = ("links", "drawing", "factors", "candidates")
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
        """The crank instead of the target."""
        if self.spec.target is not None:
            yield Found("links.crank", self.crank_length, "found for target.swing")
            yield Found("target", None)

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The required swing by other teeth; the rocker is their centre distance."""
        from gearlink.core.base.candidates import Sought, around, nothing_sought, pairs, table

        if self.spec.target is None:
            raise nothing_sought("give target: {swing} instead of links.crank")
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
        fixed = links.coupler, self.rocker_length, links.frame, self.spec.assembly
        with at_key("target.swing"):
            return crank_for_swing(*fixed, self.gear_ratio, math.radians(target.swing))

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar: a crank-rocker."""
        links = self.spec.links
        rocker = of_gears("rocker", links.rocker, self.rocker_length, self.spec.gears)
        with at_key("links"):
            linkage = FourBar(self.crank_length, links.coupler, rocker, links.frame, self.spec.assembly)
            if check_linkage(linkage) != "crank-rocker":
                raise NoSolution(
                    f"frame: {unlike(links.frame, self.crank_length)} mm, the shortest link, with which the rocker "
                    "turns fully",
                    fix=f"set links.frame above the crank, {safely_above(self.crank_length)} mm",
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

    speed_turnings: list[Turning] = placed("drive.speed_turnings")
    acceleration_turnings: list[Turning] = placed("drive.acceleration_turnings")

    @property
    def min_transmission_angle(self) -> float:
        """Minimum transmission angle over the revolution [rad]."""
        return self.linkage.min_transmission_angle()

    @cached_property
    def layout(self) -> Layout:
        """Coupler gear on C, output gear on D."""
        links, spec, (coupler, output) = self.linkage, self.spec, self.mesh.tip_radius
        gears = (
            Gear("the coupler gear", "C", coupler, mates="D"),
            Gear("the output gear", "D", output, root=self.mesh.root_radius[1]),
        )
        reaches = {"AC": coupler_joint(links), "AD": constant(links.frame), "CD": constant(links.rocker)}
        return Layout(gears, shafts_at("AD", spec.shafts), reaches, least_shaft(spec.limits, spec.gears.module))

    def table_motion(self, samples: int | None = None) -> Table:
        """Rocker and output over a revolution of the crank; the output angle is 0 at crank angle 0."""
        from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
        from gearlink.core.mechanism.courses import Shown, between, motion_table, of_output, turned

        shown = [
            Shown("rocker_angle", turned("rocker")),
            *of_output(OUTPUT),
            Shown("transmission_angle", between("coupler", "rocker")),
        ]
        return motion_table("motion", self, shown, samples)

    def table_links(self, samples: int | None = None) -> Table:
        """Angle, speed, acceleration and jerk of every link over a revolution of the crank."""
        from gearlink.core.mechanism.courses import all_rates, motion_table, turned

        shown = all_rates({name: turned(name) for name in ("coupler", "rocker", "output")})
        return motion_table("links", self, shown, samples)

    # Checks

    def check_target(self) -> Iterator[Check]:
        """GL307, where the file asks for a swing."""
        if self.swing_residual is not None:
            degrees = math.degrees(self.swing_residual)
            yield target_check("the swing of the output", degrees, math.degrees(_SWING_TOLERANCE), "deg")

    def check_transmission_angle(self) -> Check:
        """GL303."""
        remedy = "shorten the crank, and keep the swing by more teeth on the coupler gear"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)
