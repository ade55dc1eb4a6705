"""The wide-swing cam mechanism with unloading device as a design: its parts, and what each command shows of it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, at_key, in_section
from gearlink.core.base.remedies.ways import THINNEST
from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing import bodies, codes, remedies
from gearlink.core.machines.wide_swing.cam import Layout, WideSwingCam, middle_radius_estimate, start_radius_estimate
from gearlink.core.machines.wide_swing.codes import (
    BALANCING,
    CLOSED_CONTOUR,
    CYCLE_ANGLES,
    DEVICE_PRESSURE,
    FORCE_CLOSURE,
    FORCE_RESERVE,
    PROFILE_EXISTS,
    PROFILE_PLANES,
    SIDE_CHANGE,
    SWING_RANGE,
    TRANSITION_ZONE,
    TURNABILITY,
)
from gearlink.core.machines.wide_swing.cycle import ClosedCam, WholeCycle
from gearlink.core.machines.wide_swing.law import legacy_law
from gearlink.core.machines.wide_swing.motion import MOST_STRETCH, Motion
from gearlink.core.machines.wide_swing.oscillating_cam import OscillatingCam, aimed_law, greatest_need
from gearlink.core.machines.wide_swing.sizing import ISENTROPIC, OF_CYLINDER, OF_GRAVITY, QUANTITIES, names
from gearlink.core.machines.wide_swing.slider import AimedLaw, fastest_place
from gearlink.core.machines.wide_swing.strokes import AnyCam
from gearlink.core.machines.wide_swing.torques import FlankImpact, Unloading, flank_impact
from gearlink.core.numerics.arrays import range_rows
from gearlink.core.numerics.extremes import Extreme, extremes_of_parts, share_of
from gearlink.core.numerics.motion_extremes import extremes
from gearlink.core.numerics.motion_extremes import names as extreme_names
from gearlink.core.parts.cams.checks import HUB, against_curvature, over_axis_check
from gearlink.core.parts.cams.codes import ACCELERATION_STEP, CAM_UNDERCUT, PRESSURE_ANGLE
from gearlink.core.parts.gears.checks import GEAR_QUANTITIES, gear_quantity
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.studies.clearance import beside_turning_pin

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.spec import SecondShaft, SwingCam, WideSwingSpec
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.parts.gears.mesh.pair import GearPair


OF_GEARS = tuple(f"shaft_gears.{name}" for name in GEAR_QUANTITIES)
_TURN = 2.0 * math.pi
_COARSE, _FINE = (120, 48), (360, 400)
"""Angles of a revolution and points of a piece of a contour, in the two rounds of the search."""


# Twin cams on parallel shafts: two bodies of their own, geared one to one, each with its arm of the rocker.
#
# The rocker's axis D at 0, the first shaft at a_1 on the reference direction, the second at a_2 in the direction psi;
# each roller arm lies on the line from D to its shaft at mid-swing.


@dataclass(frozen=True)
class ParallelShafts:
    """Both shafts, from the design; lengths in mm.

    Source
        wide-swing dissertation, figure 2, whose drawing is lost: the layout is a reconstruction
    """

    design: WideSwingDesign

    @property
    def _second(self) -> SecondShaft:
        second = self.design.section.second
        if second is None:
            raise MissingSection("the command needs layout: twin-cam-parallel and cam.second: direction", key="cam")
        return second

    @property
    def roller_arm_angle(self) -> float:
        """psi, between the arms of the two rollers, that of the directions to both shafts [rad]."""
        return math.radians(self._second.direction)

    @property
    def cams(self) -> tuple[WideSwingCam, WideSwingCam]:
        """The cam of the working stroke and that of the return stroke."""
        _ = self._second
        other = self.design.return_cam
        assert other is not None, "the second cam has a shaft of its own"
        return self.design.even_cam, other

    @property
    def shafts(self) -> tuple[complex, complex]:
        """Both shafts, from the rocker's axis [mm]."""
        first, second = self.cams
        return complex(first.center_distance), cmath.rect(second.center_distance, self.roller_arm_angle)

    @property
    def shaft_distance(self) -> float:
        """|O1 O2|, |.|^2 = a_1^2 + a_2^2 - 2 a_1 a_2 cos psi [mm]."""
        return abs(self.shafts[1] - self.shafts[0])

    @property
    def _outer(self) -> tuple[float, float]:
        """Maximum radius of both profiles [mm]."""
        first, second = self.cams
        return first.max_radius - first.roller_radius, second.max_radius - second.roller_radius

    @property
    def cam_gap(self) -> float:
        """Room between the circles of both cams, as if in one plane [mm]; negative where they overlap."""
        return self.shaft_distance - sum(self._outer)

    @property
    def cam_shaft_gap(self) -> float:
        """Minimum room between a cam and the shaft of the other [mm]."""
        return self.shaft_distance - max(self._outer) - self.design.section.shaft_radius

    @cached_property
    def gears(self) -> GearPair:
        """The pair 1:1 between the shafts, so that the cams turn against each other."""
        from gearlink.core.parts.gears.from_spec import pair_at

        given = self.design.spec.gears
        if given is None:
            raise MissingSection("the command needs the section gears: module", key="gears")
        # what m z leaves of the distance is made up by positive shift
        teeth = given.teeth or int(self.shaft_distance * math.cos(math.radians(given.helix_angle)) / given.module)
        with in_section("gears"):
            return pair_at(given, (teeth, teeth), self.shaft_distance)

    # In one plane

    @cached_property
    def plane_gap(self) -> float:
        """Least room in one plane [mm]: circles where they clear, else the contours over a revolution; and each roller
        beside the other cam."""
        gap = self.cam_gap
        if gap < 0.0 and self.design.spec.cycle is not None:
            gap = self._contour_gap
        return min(gap, self._roller_gap)

    @property
    def _roller_gap(self) -> float:
        """Minimum clearance between a roller, over its swing, and the circle of the other cam [mm]."""
        swing, found = self.design.motion.swing, []
        for number, cam in enumerate(self.cams):
            arm = cmath.rect(cam.rocker_radius, (0.0, self.roller_arm_angle)[number] - 0.5 * swing)
            nearest = beside_turning_pin(self.shafts[1 - number], arm, swing).distance
            found.append(nearest - self._outer[1 - number] - cam.roller_radius)
        return min(found)

    @property
    def _contour_gap(self) -> float:
        """Minimum distance of both closed contours while the cams turn against each other; negative: how deep they cut.

        Notes
            Looked for from coarse to fine, points against points: off by the square of their distance over the gap.
        """
        whole = self.design.cycle
        pairs = [(_outline(whole.main, count), _outline(whole.back, count)) for _, count in (_COARSE, _FINE)]
        angles = np.linspace(0.0, _TURN, _COARSE[0], endpoint=False)
        rough = self._gaps(*pairs[0], angles)
        best, step = float(angles[int(np.argmin(rough))]), _TURN / _COARSE[0]
        near = np.linspace(best - step, best + step, _FINE[0] // 8)
        return float(self._gaps(*pairs[1], near).min())

    def _gaps(self, first: Points, second: Points, angles: Reals) -> Reals:
        """The gap at cam angles from the start of the working stroke."""
        from scipy.spatial import cKDTree

        whole, (near, far) = self.design.cycle, self.shafts
        tree = cKDTree(np.column_stack((second.real, second.imag)))
        order = np.argsort(np.angle(second))
        polar, radius = np.angle(second)[order], np.abs(second)[order]
        turned = cmath.exp(-1j * self.roller_arm_angle)
        late = whole.angles[0] + whole.angles[1]
        found = []
        for angle in angles.tolist():
            world = near + first * cmath.exp(-1j * (angle - 0.5 * whole.main.own))
            seen = np.conj((world - far) * turned) * cmath.exp(1j * (angle - late - 0.5 * whole.back.own))
            distance = tree.query(np.column_stack((seen.real, seen.imag)))[0]
            inside = np.abs(seen) < np.interp(np.angle(seen), polar, radius, period=_TURN)
            found.append(float(np.where(inside, -distance, distance).min()))
        return np.array(found)


def _outline(cam: ClosedCam, count: int) -> Points:
    return np.concatenate([points for _, points in cam.outline(count)])


def cam_clearance(design: WideSwingDesign) -> Iterator[Check]:
    """GL541: two cams on parallel shafts beside each other."""
    if design.section.second is None or not design.has_profile:
        return
    shafts, limit = design.shafts, design.spec.limits.cam_gap
    same = design.section.planes == "same"
    gap = min(shafts.cam_shaft_gap, shafts.plane_gap) if same else shafts.cam_shaft_gap
    what = "cams, rollers and shafts in one plane" if same else "each cam and the shaft of the other"
    fix = "set cam.planes to separate" if same else "set cam.second.direction farther from 0"
    status: Status = "fail" if gap < limit else "pass"
    yield codes.CAM_CLEARANCE.check(status, f"clearance between {what}", gap, limit, "mm", fix=fix)


_ROUNDING = 1e-9
_UNGUIDED = 0.1
"""Half-width of the contact change, as a share of the stroke, that no limit allows without a word: twice the usual."""

MOST_RISE = 0.05
"""Rise of a cylinder's force over its stroke up to which the law of constant force is taken."""

# Device and stroke


def _room_for_steel(design: WideSwingDesign, otherwise: str) -> Iterator[Check]:
    """GL504 of a spring of which the file gives no length, or a stretch that no steel bears: whether any spring of
    steel finds room between the pins."""
    ratio, least = design.motion.device.pivot_ratio, design.motion.least_ratio_of_steel
    if ratio < least:
        what, aside = "pivot ratio for a steel spring", f"stretch of {MOST_STRETCH:g} times its closed length"
        fix = f"increase unloader.pivot_ratio to at least {safely_above(least)}, or {otherwise}"
        yield TURNABILITY.check("warn", what, ratio, least, aside=aside, fix=fix)


_USUAL_SWING = 300.0
_STEEPEST = 60.0


_TRANSMISSION = {
    "drive": ("minimum transmission angle of the drive", "shorten drive.crank"),
    "slider.rod": ("minimum angle of the slider's rod to the normal of its slide line", "lengthen slider.rod"),
}
"""What a message calls an angle, and what raises it."""


def _more_force(design: WideSwingDesign) -> str:
    """The reserve that holds the roller with a tenth of speed as margin, or the strength of a given device."""
    unloader, need, size = design.spec.unloader, design.unloading.need, design.unloading.size
    if design.spec.slider is not None and math.isinf(need):
        return remedies.side_words(design.spec.slider)
    safe = remedies.reserve(unloader.residual, 0.1, need)
    key = {"pneumatic": "force", "spring": "rate", "gravity": "mass"}[unloader.type]
    if getattr(unloader, key) is None:
        return f"increase unloader.reserve to {safely_above(safe)} (10 % speed margin)"
    if unloader.type == "gravity":
        if safe >= design.motion.most_pendulum_reserve:
            return "move the mass closer to the axis, or reduce the speed"
        return f"increase unloader.mass to {safely_above(design.motion.pendulum_mass(1.0 + safe))} (10 % speed margin)"
    return f"increase unloader.{key} to {safely_above(size.balancing * (1.0 + safe))} (10 % speed margin)"


# Cams


def _pressure_remedy(design: WideSwingDesign) -> str:
    if design.spec.cycle is not None:
        return "give that stroke a larger angle in cycle"
    return f"change {'cycle_angle' if design.spec.drive is None else 'drive.crank'} or swing"


def _covered(cam: AnyCam, words: str) -> Check:
    what = f"the roller (radius {short(cam.roller_radius)} mm) covers the whole profile of the {words}"
    return CAM_UNDERCUT.check("fail", what, None, 1.0, fix="use a smaller cam.roller_radius")


def _left_out(cam: AnyCam) -> str:
    """The parts of the stroke in which the roller does not touch the profile."""
    (first, _), (_, last) = cam.contact
    parts = [
        f"{name} {short(part, 3)} of the stroke"
        for name, part in (("first", first), ("last", 1.0 - last))
        if part > 0.0
    ]
    return " and ".join(("outside the transition zone", *parts))


def _against_estimate(design: WideSwingDesign, roller: float) -> Iterator[Check]:
    """The source's own criterion of the internal profile: a warning, since its radius is an estimate."""
    estimate = design.middle_radius_estimate
    if roller >= estimate:
        what, shown = "roller radius, internal profile", Shown(roller, estimate, "mm", "<=")
        aside = "the source's estimate of the curvature radius at mid-swing"
        fix = f"use a roller of at most {safely_below(0.999 * estimate)} mm"
        yield CAM_UNDERCUT.check("warn", what, roller / estimate, 1.0, shown=shown, aside=aside, fix=fix)


def _over_rocker_axis(design: WideSwingDesign) -> Iterator[Check]:
    """The cam's arc about the dwells may reach over the rocker's axis."""
    place, roller = design.section.center_distance, design.section.roller_radius
    for words, cam in design.cams.items():
        sense = -1.0 if design.spec.layout == "twin-rocker" and cam is design.cam else 1.0
        room = sense * (place - cam.end_radius) + roller
        if design.spec.drive is not None and design.has_profile:
            # Both stop there, so that the normal of the pitch curve does not point to the cam's axis.
            room = place - bodies.disc_radius(design)
        advice = "overhang the rocker next to the cam, or reduce the swing"
        rule, axis = SHAFT_CLEARANCE, "the rocker's axis"
        at = "the ends of the stroke"
        yield from over_axis_check(rule, words, room, roller, axis, advice, at=at)


# Checks of a whole cycle: the joints of its contours, the roller in the free sectors, two profiles on one body


_CUT = 1e-7
"""Cut, in roller radii, that rounding and the search of the nearest place leave of none."""


def _angles_of_cycle(design: WideSwingDesign) -> Iterator[Check]:
    """GL510 of a whole cycle, whose angles fill the turn: rests of no length, and the stroke that sizes the device."""
    section = design.spec.cycle
    assert section is not None, "asked for where there is a cycle"
    working, far, back, near = section.lengths
    aside = f"strokes {short(working)} and {short(back)} deg, dwells {short(far)} and {short(near)} deg"
    for name, rest in (("far_dwell", far), ("near_dwell", near)):
        if rest == 0.0:
            what, fix = (
                f"no {name.replace('_', ' ')}: two concave flanks of each cam meet in an edge",
                f"set cycle.{name} above 0",
            )
            yield CYCLE_ANGLES.check("warn", what, rest, 0.0, "deg", shown=NO_NUMBER, aside=aside, fix=fix)
    note = ""
    if working != back:
        longer, reserve = "working" if working > back else "return", design.cycle.longer_stroke_reserve
        note = (
            f"the balancing device is sized for the shorter stroke: force reserve {short(100.0 * (reserve or 0.0))} %"
        )
        note += f" in the {longer} stroke"
    if far > 0.0 and near > 0.0:
        whole = working + far + back + near
        what = "angles of strokes and dwells"
        yield CYCLE_ANGLES.check("pass", what, whole, 360.0, "deg", side="", aside=aside, note=note)


def _contours(design: WideSwingDesign) -> list[tuple[str, ClosedCam]]:
    """The closed contours of the cams that have a profile."""
    try:
        found = list(design.cycle.contours.items())
        for _, cam in found:
            _ = cam.cam.slot
    except NoSolution:
        # what is refused here fails in checks of its own
        return []
    return found


def profile_planes(design: WideSwingDesign) -> Iterator[Check]:
    """GL513: whether the two profiles of a twin-rocker's cam can stand in one plane."""
    if not _contours(design):
        return
    room = design.cycle.plane_room
    if room is None:
        return
    status: Status = "pass" if room > 0.0 else "warn"
    what, overlap = "distance of the two profiles at the dwells", "overlap of the two profiles at the dwells"
    fix = "cut the profiles in two planes next to each other"
    yield PROFILE_PLANES.check(status, what, room, 0.0, "mm", overlap=overlap, fix=fix)


LAW = {
    "energy_parameter": "motion.law.energy_parameter",
    "velocity_peak": "motion.law.velocity_peak",
    "acceleration_peak": "motion.law.acceleration_peak",
    "min_pivot_ratio": "motion.min_pivot_ratio",
    "force": "unloading.force",
    "spring_rate": "unloading.spring_rate",
}
TORQUE = {"power_peak": "motion.law.power_peak", "drive_torque_peak": "unloading.drive_torque_peak"}
SHAFT = {name: f"unloading.{name}" for name in ("dynamic_coefficient", "drive_balancing_ratio")}
SLIDER = {
    "slider_stroke": "motion.slider.stroke",
    "reference_inertia": "motion.reference_inertia",
    "rocker_share": "motion.slider.rocker_share",
    "middle_place": "motion.slider.middle_place",
    "slider_velocity_peak": "motion.slider.slider_velocity_peak",
    "slider_acceleration_peak": "motion.slider.slider_acceleration_peak",
}
DRIVE = {
    "crank_span": "motion.drive.crank_span",
    "cam_swing": "motion.drive.swing",
    "middle_pressure_angle": "oscillating_cam.middle_pressure_angle",
}
OF_REST = ("dwell_force",)
OF_SLIDER_CAM = {"line_of_centers_place": "aimed_cam.middle", "roller_arm_offset": "aimed_cam.arm_offset"}
OF_EVEN_CAM = (
    "profile_correction",
    "largest_profile_correction",
    "zero_end_swing",
    "phase_angle",
    "start_curvature_radius",
)
PROFILE = {
    "rocker_radius": "cam.rocker_radius",
    "min_radius": "cam.min_radius",
    "max_radius": "cam.max_radius",
    **{name: f"even_cam.{name}" for name in OF_EVEN_CAM},
    "start_radius_estimate": "start_radius_estimate",
    "middle_radius_estimate": "middle_radius_estimate",
    "transition_zone": "cam.transition_zone",
    "contact_end": "contact_end",
    "max_pressure_angle": "cam.max_pressure_angle",
    "lift_off_speed": "unloading.lift_off_speed",
    "contact_force": "contact_force",
    "dwell_force": "dwell_force",
}
_OF_IMPACT = ("impact_speed", "impact_place", "impact_energy", "impact_force")
IMPACT = {name: name.replace("_", ".") for name in _OF_IMPACT}
GAIN = {"end_position_gain": "end_position_gain"}
SHAFTS = {name: f"shafts.{name}" for name in ("shaft_distance", "roller_arm_angle", "cam_gap", "cam_shaft_gap")}
OF_BOTH = ("rocker_radius", "max_radius", "min_radius")
PHASES = ("working_angle", "far_dwell_angle", "return_angle", "near_dwell_angle")
_OF_CYCLE = ("sectors_external", "sectors_internal", "sectors_return", "longer_stroke_reserve")
CYCLE = {name: f"cycle.{name}" for name in _OF_CYCLE}
ITERATION = {
    "iteration_energy_parameter": "unloading.iteration.energy_parameter",
    "iteration_passes": "unloading.iteration.passes",
    "iteration_error": "unloading.iteration_error",
}
MOTION = {name: f"extremes.{name}" for name in extreme_names("rocker_speed", "rocker_acceleration")}
PLACES = {"max_pressure_angle_at": "pressure_place", "min_curvature_radius_at": "curvature_place"}
CURVATURE = {"min_curvature_radius": "cam.min_curvature_radius"}
RETURN_CURVATURE = {"return_min_curvature_radius": "other_cam.min_curvature_radius"}
RETURN_ZONE = {"return_transition_zone": "other_cam.transition_zone"}
RETURN = {f"return_{name}": f"other_cam.{name}" for name in ("max_radius", "min_radius")}
RETURN |= RETURN_ZONE | {"return_max_pressure_angle": "other_cam.max_pressure_angle"}
"""Quantities of a return cam of another shape."""
PATHS = (
    QUANTITIES
    | IMPACT
    | SHAFTS
    | GAIN
    | MOTION
    | PLACES
    | LAW
    | TORQUE
    | SHAFT
    | SLIDER
    | DRIVE
    | PROFILE
    | OF_SLIDER_CAM
    | CURVATURE
    | RETURN
    | RETURN_CURVATURE
    | CYCLE
    | {name: f"phases.{name}" for name in PHASES}
    | ITERATION
)
NEED_PROFILE = ("start_radius_estimate", "middle_radius_estimate")
NEED_ZONE = (
    *PLACES,
    *IMPACT,
    "transition_zone",
    "max_pressure_angle",
    "min_curvature_radius",
    "contact_end",
    "contact_force",
)
DERIVED = frozenset(
    (*(*TORQUE, *MOTION, *PLACES, *OF_REST), *("contact_force", "slider_velocity_peak", "slider_acceleration_peak"))
)
"""Extremes of a law, and of a profile, that other quantities have already found to exist."""


Places: TypeAlias = SimpleNamespace
"""Values by their names."""


def _k(samples: int | None) -> Reals:
    return range_rows(0.0, 1.0, samples or 100)


def _speed_shares() -> Any:
    return np.arange(10, 135, 5) / 100.0


def _force(design: WideSwingDesign, cam: AnyCam, k: Any, share: Any) -> Any:
    touching = design.touches(cam, k) & (k != cam.middle)
    force = np.full_like(k, np.nan)
    force[touching] = design.unloading.contact_force(cam, k[touching], share[touching])
    return force


def _cam(design: WideSwingDesign, name: str, cam: AnyCam, mirror: float, samples: int | None) -> Table:
    k = _k(samples)
    gone = ~design.touches(cam, k)
    points = cam.points(k)
    columns = {
        "k": (k, "1"),
        "cam_angle": (np.degrees(points.cam_angle), "deg"),
        "pitch_x": (points.pitch.real, "mm"),
        "pitch_y": (mirror * points.pitch.imag, "mm"),
        "x": (np.where(gone, np.nan, points.profile.real), "mm"),
        "y": (np.where(gone, np.nan, mirror * points.profile.imag), "mm"),
        "pressure_angle": (np.degrees(points.pressure_angle), "deg"),
        "curvature_radius": (points.curvature_radius, "mm"),
    }
    return Table.of(name, columns)


_CAM = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_LAW_CHECKS = (
    "unloader-turnability",
    "swing-range",
    "device-pressure",
    "force-closure",
    "cycle-angles",
    "balancing",
    "transmission-angle",
)
_CYCLE_CHECKS = ("acceleration-step", "closed-contour", "profile-planes")
_BESIDE = ("flank-impact", "cam-clearance")
_CAM_CHECKS = (
    "profile-exists",
    "pressure-angle",
    "cam-undercut",
    "transition-zone",
    "shaft-clearance",
    "body-clearance",
)


_DEVICE_KEYS = ("force", "spring_rate", "slider_stroke")
_STEEPEST_KEYS = (
    ("max_pressure_angle", "<limits.pressure_angle"),
    ("return_max_pressure_angle", "<limits.pressure_angle"),
)
_CAM_KEYS = (
    ("lift_off_speed", ">speed"),
    "contact_force",
    "drive_torque_peak",
    "max_radius",
    "rocker_radius",
    ("transition_zone", "<limits.transition_zone"),
    ("return_transition_zone", "<limits.transition_zone"),
    "energy_parameter",
)


class WideSwingDesign(Design):
    """A twin-cam or twin-rocker mechanism, from its design file to every quantity that is asked for."""

    kind = "wide-swing-cam"
    spec: WideSwingSpec
    keys = {
        "swing": (*_DEVICE_KEYS, ("min_pivot_ratio", "<unloader.pivot_ratio"), *_STEEPEST_KEYS, *_CAM_KEYS),
        "analyze": (*_DEVICE_KEYS, "rocker_speed_max", "rocker_acceleration_max", *_STEEPEST_KEYS, *_CAM_KEYS),
        "cam": (*_STEEPEST_KEYS, *_CAM[1:]),
    }
    outlines = {
        "swing": Outline(tuple(LAW), _LAW_CHECKS, ("law", "balance")),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline((*LAW, *MOTION), _LAW_CHECKS, ("law", "balance")),
    }
    extra_tables = ("iteration", "slider", "contact", "contour", "joints", "device", "history")
    derived = DERIVED

    # Parts

    @cached_property
    def motion(self) -> Motion:
        """Device, law of motion and drive."""
        return Motion(self.spec)

    @cached_property
    def unloading(self) -> Unloading:
        """Size of the device and torques."""
        return Unloading(self.spec, self.motion, None if self.spec.drive is None else self._way_back)

    def _way_back(self) -> Extreme:
        return greatest_need(self.oscillating_cam)

    @property
    def angular_speed(self) -> float:
        """Speed of the input shaft [rad/s]."""
        return self.spec.speed * 2.0 * math.pi / 60.0

    @property
    def phases(self) -> Places:
        """Strokes and dwells of a whole cycle, the remainder among them [rad]."""
        return Places(**dict(zip(PHASES, self.motion.cycle_angles, strict=True)))

    @property
    def section(self) -> SwingCam:
        """The section `cam` of the design file."""
        if self.spec.cam is None:
            raise MissingSection("the command needs the section cam: center_distance, roller_radius", key="cam")
        return self.spec.cam

    @cached_property
    def cam(self) -> AnyCam:
        """The cam of the working stroke."""
        if self.spec.drive is not None:
            return self.oscillating_cam
        return self.even_cam if self.spec.slider is None else self.slider_cam

    @cached_property
    def even_cam(self) -> WideSwingCam:
        """The cam of the working stroke, turning evenly."""
        if self.spec.drive is not None:
            raise NoSolution("this result exists only for a cam at constant speed", key="drive", fix="omit drive")
        if self.spec.slider is not None:
            raise NoSolution(
                "this result exists only for a cam of a rocker without slider", key="slider", fix="omit slider"
            )
        layout: Layout = "twin-rocker" if self.spec.layout == "twin-rocker" else "twin-cam"
        return self._even(layout, self.motion.cycle_angle, self.section.rocker_radius, "working")

    @cached_property
    def return_cam(self) -> WideSwingCam | None:
        """A return cam of another shape: the external profile of the twin-rocker, or one of another cam angle."""
        if self.spec.slider is not None:
            return None
        second = self.section.second
        alike = self.spec.layout != "twin-rocker" and self.motion.return_angle == self.motion.cycle_angle
        if second is None and alike:
            return None
        other = self._even("twin-cam", self.motion.return_angle, None, "return")
        if second is None or second.center_distance is None:
            return other
        return replace(other, center_distance=second.center_distance)

    def _even(self, layout: Layout, angle: float, rocker_radius: float | None, phase: str) -> WideSwingCam:
        section, law = self.section, self.motion.plain_law
        lengths = section.center_distance, section.roller_radius, rocker_radius
        if self.spec.cycle is None:
            with at_key("cycle_angle"):
                return WideSwingCam(layout, law, angle, *lengths)
        with at_key("cycle"):
            return WideSwingCam(layout, law, angle, *lengths, angle_words=f"cycle.{phase}")

    @property
    def has_return_cam(self) -> bool:
        """Whether a second cam turns the other way over the whole cycle."""
        return self.spec.cycle is not None and self.spec.layout != "twin-rocker"

    @property
    def other_cam(self) -> WideSwingCam:
        """The same, where the file gives one."""
        if self.return_cam is None:
            words = "the return cam is the mirror image of the main cam and has the same results"
            raise NoSolution(words, key="layout", fix="use the name without return_")
        return self.return_cam

    @cached_property
    def cycle(self) -> WholeCycle:
        """Both cams as closed contours over a whole revolution."""
        return WholeCycle(self)

    @cached_property
    def oscillating_cam(self) -> OscillatingCam:
        """The cam on the rocker of a crank-rocker."""
        section, motion, drive = self.section, self.motion, self.motion.drive
        law = motion.plain_law if self.spec.slider is None else self.aimed_law
        with at_key("drive"):
            return OscillatingCam(drive, law, section.center_distance, section.roller_radius)

    @cached_property
    def slider_cam(self) -> WideSwingCam:
        """The cam of a rocker that drives a slider, which passes the line of centres where it is fastest."""
        section, law, angle = self.section, self.aimed_law, self.motion.cycle_angle
        with at_key("cycle_angle"):
            return WideSwingCam("twin-cam", law, angle, section.center_distance, section.roller_radius)

    @cached_property
    def aimed_law(self) -> AimedLaw:
        """The law of a rocker with a slider, as its cam sees it."""
        law = self.motion.slider
        return AimedLaw(law, fastest_place(law)) if self.spec.drive is None else aimed_law(law, self.motion.drive)

    @cached_property
    def shafts(self) -> ParallelShafts:
        """Both shafts of a twin-cam-parallel."""
        return ParallelShafts(self)

    @property
    def aimed_cam(self) -> AnyCam:
        """The cam of a rocker with a slider, whose roller passes the line of centres beside mid-swing."""
        _ = self.section, self.motion.slider  # refused without one
        return self.cam

    @property
    def cams(self) -> dict[str, AnyCam]:
        """The cams that are checked, by the words that a message calls them."""
        if self.return_cam is None:
            return {"cam": self.cam}
        if self.spec.layout != "twin-rocker":
            return {"cam": self.cam, "return cam": self.return_cam}
        return {"internal profile": self.cam, "external profile": self.return_cam}

    @property
    def profiles(self) -> dict[str, AnyCam]:
        """Those among them that have a profile."""
        return {words: cam for words, cam in self.cams.items() if cam is not self.cam or self.has_profile}

    @cached_property
    def refusal(self) -> NoSolution | None:
        """Why there is no such cam of the working stroke, not even one with a loop; None where there is.

        Raises
            NoSolution - where the stroke itself is refused
        """
        _ = self.section, self.motion.plain_law, self.motion.cycle_angle
        try:
            _ = self.cam
        except NoSolution as error:
            return error
        return None

    # Where a profile stands

    @cached_property
    def has_profile(self) -> bool:
        """Whether the pitch curve of the working stroke is free of loops."""
        try:
            self.cam.require_profile()
        except NoSolution:
            return False
        return True

    def has_zone(self, cam: AnyCam) -> bool:
        """Whether a cam has a profile outside the transition zone, so that it can be judged there."""
        return (cam is not self.cam or self.has_profile) and cam.transition_zone < 0.5

    @cached_property
    def start_radius_estimate(self) -> float:
        """R of (23) [mm]."""
        with self._profile_key:
            return start_radius_estimate(self.even_cam)

    @cached_property
    def middle_radius_estimate(self) -> float:
        """R of (27) [mm]."""
        with self._profile_key:
            return middle_radius_estimate(self.even_cam)

    @property
    def contact_end(self) -> float:
        """k at which the roller leaves the profile."""
        return self.slot_of(self.cam)[0]

    def slot_of(self, cam: AnyCam) -> tuple[float, float]:
        """Fractions of the stroke between which a cam's profile is cut away."""
        (_, start), (end, _) = self.contact_of(cam)
        return start, end

    def contact_of(self, cam: AnyCam) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches a cam's profile."""
        with self._profile_key:
            cam.require_profile()
        with at_key("cam.roller_radius"):
            return cam.contact

    def touches(self, cam: AnyCam, k: Reals) -> Any:
        """Whether the roller touches a cam's profile at fractions of the stroke."""
        (first, start), (end, last) = self.contact_of(cam)
        return ((k >= first) & (k <= start)) | ((k >= end) & (k <= last))

    @cached_property
    def contact_force(self) -> float:
        """Maximum force of the roller on any of the cams over the stroke, and home, at the design speed [N]."""
        if self.spec.slider is None and self.spec.drive is None:
            return self._even_contact_force
        self.contact_of(self.cam)
        return self.unloading.greatest_force(self.cam)

    @property
    def _even_contact_force(self) -> float:
        """The same of cams that turn evenly: alike on both sides of mid-swing."""
        found = []
        for cam in (self.even_cam, self.return_cam):
            if cam is self.even_cam or (cam is not None and self.has_zone(cam)):
                self.contact_of(cam)
                found.append(self.unloading.even_contact_force(cam))
        return max(found)

    @cached_property
    def impact(self) -> FlankImpact:
        """The blow where the roller changes flanks."""
        return FlankImpact(self)

    @property
    def end_position_gain(self) -> float:
        """Way at `output_radius` over an error of the profile in the rests, the greater one of both ends of the swing.

        (R/r) rho/(a sin phi_e): at rest the roller stands on the arc, rho^2 = a^2 + r^2 - 2 a r cos phi_e
        """
        cam, radius = self.cam, self.spec.output_radius
        assert radius is not None, "asked for where the file has it"
        arms = cam.rocker_radius * cam.center_distance
        return max((radius * cam.pitch_radius(end) / (arms * math.sin(end)) for end in cam.ends), key=abs)

    @cached_property
    def extremes(self) -> Places:
        """Extremes of the rocker's speed [rad/s] and acceleration [rad/s^2] over the working stroke; angles in rad."""
        motion = self.motion
        law, swing, angle, time = motion.law, motion.swing, motion.cycle_angle, motion.working_time
        curves = {
            "rocker_speed": lambda phi: swing / time * law.invariants(share_of(phi, angle), 1)[1],
            "rocker_acceleration": lambda phi: swing / time**2 * law.invariants(share_of(phi, angle), 2)[2],
        }
        return Places(**extremes(curves, 0.0, angle, samples=256))

    @cached_property
    def pressure_place(self) -> float:
        """Cam angle of the maximum pressure angle where the roller touches the profile [rad]."""
        # Next to a standstill of a cam that swings itself the ratio of both rates has no digits.
        found = self._greatest(lambda k: np.abs(self.cam.pressure_angle(k)))
        if self.spec.drive is not None:
            ends = np.abs(self.cam.pressure_angle(np.array([0.0, 1.0])))
            if ends.max() > found.value:
                return float(np.argmax(ends)) * self.motion.cycle_angle
        return found.place * self.motion.cycle_angle

    @cached_property
    def curvature_place(self) -> float | None:
        """Cam angle of the minimum radius of a bulging pitch curve where the roller touches it [rad]; None without."""
        found = self._greatest(self.cam.bulge)
        return found.place * self.motion.cycle_angle if found.value > 0.0 else None

    def _greatest(self, curve: Callable[[Reals], Reals]) -> Extreme:
        """The maximum value over the parts of the stroke in which the roller touches the profile."""
        stop = 1e-3 if self.spec.drive is not None else 0.0
        parts = [(max(first, stop), min(last, 1.0 - stop)) for first, last in self.contact_of(self.cam)]
        found = extremes_of_parts([(curve, True)], self.cam.sides(*parts), samples=256)
        return max((each for (each,) in found), key=lambda each: each.value)

    @cached_property
    def dwell_force(self) -> float:
        """Maximum force of a roller on its cam during the rests [N]."""
        return self.unloading.dwell_force(self.cams.values())

    @property
    def _profile_key(self) -> Any:
        """What a refused profile is refused with: the key to change."""
        if self.spec.drive is not None:
            return at_key("drive")
        if self.spec.cycle is not None and self.section.rocker_radius is None:
            return at_key("cycle.working")
        return at_key("cycle_angle" if self.section.rocker_radius is None else "cam.rocker_radius")

    # Results

    @classmethod
    def unit_for(cls, spec: Any, name: str, /) -> str:
        """The speed of lift-off is the cam's."""
        return "1/min" if name == "lift_off_speed" else super().unit_for(spec, name)

    def raw(self, name: str) -> Any:
        """A quantity by its place among the parts; one of a profile that does not exist says which key to change.

        None of one that another device has, or of a way at an `output_radius` that the file lacks.
        """
        if self.needs(name):
            return None
        if name in NEED_ZONE:
            with self._profile_key:
                self.cam.require_profile()
        if name in OF_BOTH and self.section.second is not None:
            return [getattr(cam, name) for cam in self.shafts.cams]
        if name.startswith("shaft_gears."):
            return gear_quantity(self.shafts.gears, name.rpartition(".")[2])
        value_of = attrgetter(PATHS[name])
        if "cam." not in PATHS[name]:
            return value_of(self)
        with at_key("cam.roller_radius"):
            value = value_of(self)
        return None if value is None or math.isinf(value) else value

    def needs(self, name: str, /) -> str:
        """The device or the key that the file lacks."""
        if name in GAIN and self.spec.output_radius is None:
            return "output_radius"
        if name not in QUANTITIES or name in names(self.spec):
            return ""
        if name in OF_CYLINDER:
            key = "reservoir" if name in OF_CYLINDER[3:] else "pressure"
            return f"unloader: {{type: pneumatic, {key}}}"
        return f"unloader: {{type: {'gravity' if name in OF_GRAVITY else 'spring'}}}"

    def table_law(self, samples: int | None = None) -> Table:
        """The invariants of the law over the stroke."""
        k = _k(samples)
        a, b, c = self.motion.law.invariants(k, 2)
        return Table.of(
            "law", {"k": (k, "1"), "displacement": (a, "1"), "velocity": (b, "1"), "acceleration": (c, "1")}
        )

    def table_slider(self, samples: int | None = None) -> Table:
        """The slider's invariants over the stroke, its travel and its speed at the design speed."""
        k, moved = _k(samples), self.motion.slider
        a, b, c = moved.slider_invariants(k)
        columns = {
            "k": (k, "1"),
            "displacement": (a, "1"),
            "velocity": (b, "1"),
            "acceleration": (c, "1"),
            "travel": (moved.stroke * a, "mm"),
            "speed": (moved.stroke / self.motion.working_time * b, "mm/s"),
        }
        return Table.of("slider", columns)

    def table_balance(self, _samples: int | None = None) -> Table:
        """Torque on the rocker axis with and without the device, over the speed."""
        return self._balance

    @cached_property
    def _balance(self) -> Table:
        share, spec = _speed_shares(), self.spec
        without, left = self.unloading.torque_peaks(share)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = without / left
        columns = {
            "speed": (share * spec.speed, "1/min"),
            "torque_without": (without, "N m"),
            "torque_with": (left, "N m"),
            "ratio": (ratio, "1"),
        }
        if spec.shaft is not None:
            columns["drive_ratio"] = (self.unloading.balancing_ratios(share), "1")
            columns["dynamic_coefficient"] = (self.unloading.dynamic_coefficients(share.tolist()), "1")
        return Table.of("balance", columns)

    def table_iteration(self, _samples: int | None = None) -> Table:
        """Steps of the source's iteration against its error; with a slider its passes; two marches add up to 1."""
        if self.spec.slider is not None:
            heads = ("pass", "energy_parameter", "mu", "displacement_forward", "displacement_backward")
            passes = zip(*self.unloading.iteration.rows, strict=True)
            return Table.of("iteration", {head: (list(each), "1") for head, each in zip(heads, passes, strict=True)})
        motion, steps = self.motion, (5, 10, 20, 50, 100, 200)
        laws = [legacy_law(motion.device, motion.swing, steps=n) for n in steps]
        exact = motion.plain_law.energy_parameter
        columns = {
            "steps": (steps, "1"),
            "passes": ([law.passes for law in laws], "1"),
            "energy_parameter": ([law.energy_parameter for law in laws], "1"),
            "relative_error": ([law.energy_parameter / exact - 1.0 for law in laws], "1"),
        }
        return Table.of("iteration", columns)

    def table_contact(self, samples: int | None = None) -> Table:
        """Force of the roller on the cam over the stroke and the speed, empty where it does not touch the profile."""
        shares, count = _speed_shares(), samples or 100
        rows = row_numbers(samples, shares.size * (count + 1))
        number = np.arange(rows.start, rows.stop)
        k, share = number % (count + 1) / count, shares[number // (count + 1)]
        columns = {"k": (k, "1"), "force": (_force(self, self.cam, k, share), "N"), "speed_share": (share, "1")}
        if self.return_cam is not None:
            columns["return_force"] = (_force(self, self.return_cam, k, share), "N")
        return Table.of("contact", columns)

    def table_history(self, _samples: int | None = None) -> Table:
        """Torques of rocker shaft and main shaft over the stroke and the rest after it, with elasticity."""
        return self.unloading.history()

    def table_device(self, samples: int | None = None) -> Table:
        """Length, force and torque of the device over the stroke, and what it leaves of the inertia torque."""
        return self.unloading.size.table(_k(samples))

    def table_contour(self, samples: int | None = None) -> Table:
        """Both cams as closed contours over one revolution."""
        return self.cycle.table(samples)

    def table_joints(self, _samples: int | None = None) -> Table:
        """The joints of both closed contours."""
        return self.cycle.joints()

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The cam of the working stroke; where the roller's slot cuts the profile away, x and y are empty."""
        return _cam(self, "main_cam", self.cam, 1.0, samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The cam of the return stroke: a mirror image (twin-cam), or the external profile of the twin-rocker."""
        mirror = -1.0 if self.spec.layout != "twin-rocker" else 1.0
        return _cam(self, "return_cam", self.return_cam or self.even_cam, mirror, samples)

    def check_swing_range(self) -> Iterator[Check]:
        """GL543: a swing beyond those of the source, near the far dead centre of the device."""
        swing, law = self.spec.swing, self.motion.law
        if swing <= _USUAL_SWING * (1.0 + _ROUNDING):
            return
        half, g = 0.5 * self.motion.swing, law.geometry
        lever = math.sin(half) if self.spec.unloader.type == "gravity" else g.ratio * math.sin(half) / g.longest
        steps = [replace(law, swing=scale * law.swing).energy_parameter for scale in (0.9999, 1.0001)]
        growth = math.log(steps[1] / steps[0]) / (2e-4 * swing)
        yield SWING_RANGE.check(
            "warn",
            "swing",
            swing,
            _USUAL_SWING,
            "deg",
            aside=f"lever of the device at the ends {short(lever)} arms, "
            f"force +{short(100.0 * growth)} % per deg of swing",
            fix=f"reduce swing to {_USUAL_SWING:g} deg, or add a gear stage",
            note=f"an external profile has pressure angles above {_STEEPEST:g} deg",
        )

    def check_device_pressure(self) -> Iterator[Check]:
        """GL540: the pressure in a closed reservoir rises little over the stroke."""
        unloader = self.spec.unloader
        if unloader.type != "pneumatic" or unloader.reservoir is None:
            return
        rise = self.unloading.size.force_variation
        litres = unloader.reservoir
        swept, most = (1.0 - (1.0 + each) ** (-1.0 / ISENTROPIC) for each in (rise, MOST_RISE))
        yield DEVICE_PRESSURE.check(
            "warn" if rise > MOST_RISE else "pass",
            "rise of the cylinder's force over its stroke",
            rise,
            MOST_RISE,
            aside=f"{litres:g} l of air; the law assumes a constant force",
            fix=f"set unloader.reservoir to at least {safely_above(litres * swept / most)}",
        )

    def check_unloader_turnability(self) -> Iterator[Check]:
        """GL504: the device can follow the whole swing."""
        unloader = self.spec.unloader
        if unloader.type == "gravity":
            return
        least, ratio = self.motion.min_pivot_ratio, unloader.pivot_ratio
        if least is None:
            yield from _room_for_steel(self, "give unloader.closed_length or stretch_capacity of the spring that fits")
            return
        status: Status = "fail" if ratio < least else "pass"
        fix, aside = (
            f"increase unloader.pivot_ratio to at least {safely_above(least)}",
            f"swing {short(self.spec.swing)} deg",
        )
        yield TURNABILITY.check(status, "pivot ratio of the balancing device", ratio, least, aside=aside, fix=fix)
        capacity = getattr(self.spec.unloader, "stretch_capacity", None) or 0.0
        if status == "pass" and capacity > MOST_STRETCH:
            yield from _room_for_steel(self, "use another device, or a smaller unloader.stretch_capacity")

    def check_force_closure(self) -> Iterator[Check]:
        """GL509: a spring that is slack at mid-swing does not hold the roller there."""
        unloader = self.spec.unloader
        if unloader.type != "spring":
            return
        stretch = self.motion.stretch_ratio
        status: Status = "warn" if stretch == 0.0 else "pass"
        what, aside = "mounting stretch of the spring over its stroke", "the spring is slack at mid-swing"
        given = unloader.free_length is not None
        fix = "use a shorter spring" if given else "set unloader.stretch_ratio above 0, such as 0.1"
        yield FORCE_CLOSURE.check(status, what, stretch, 0.0, aside="" if stretch else aside, fix=fix)

    def check_cycle_angles(self) -> Iterator[Check]:
        """GL510: both strokes find room in one revolution of the cam."""
        if self.spec.drive is not None:
            return
        if self.spec.cycle is not None:
            yield from _angles_of_cycle(self)
            return
        both = 2.0 * math.degrees(self.motion.cycle_angle)
        what, fix = "cam angle of both strokes", "reduce cycle_angle to 180 deg or less"
        status: Status = "fail" if both > 360.0 else "pass"
        yield CYCLE_ANGLES.check(status, what, both, 360.0, "deg", side="<=", fix=fix)

    def check_balancing(self) -> Iterator[Check]:
        """GL508: speeds at which the device does harm."""
        harm = self.unloading.harmful_speed
        lowest = self.spec.operating_speed_min
        if lowest is None:
            return
        status: Status = "warn" if lowest < harm else "pass"
        share = (lowest / self.spec.speed) ** 2
        yield BALANCING.check(
            status,
            "minimum speed with the balancing device",
            lowest,
            harm,
            "1/min",
            aside="below this speed the device increases the torque" if status == "warn" else "",
            fix=f"reduce its force or rate to {safely_below(share, 3)} of the design value at that speed, or remove it",
        )

    def check_profile_exists(self) -> Check:
        """GL505: a cam for this stroke, and no loop."""
        if self.refusal is not None:
            return PROFILE_EXISTS.check("fail", self.refusal.message, None, 0.0, fix=self.refusal.fix)
        margin = self.cam.loop_margin
        shown = margin if math.isfinite(margin) else None
        try:
            self.cam.require_profile()
        except NoSolution as error:
            crank = remedies.drive_crank(self) if self.spec.drive is not None else None
            fix = f"set drive.crank to at most {crank:.12g} mm" if crank else error.fix
            return PROFILE_EXISTS.check("fail", error.message, shown, 0.0, shown=NO_NUMBER, fix=fix)
        aside = ""
        if self.spec.drive is None and self.spec.slider is None:
            aside = f"acceleration phase over {short(math.degrees(self.even_cam.phase_angle))} deg of the cam"
        what = "the pitch curve has no loop"
        return PROFILE_EXISTS.check("pass", what, shown, 0.0, shown=NO_NUMBER, aside=aside)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 where the roller touches the profile."""
        limit = self.spec.limits.pressure_angle
        for words, cam in self.profiles.items():
            if not self.has_zone(cam):
                continue
            value = math.degrees(cam.max_pressure_angle)
            aside = ""
            if self.spec.drive is None:
                aside = "outside the transition zone" if cam.transition_zone > 0.0 else "contact lasts to mid-swing"
            status: Status = "fail" if value > limit else "pass"
            what, fix = f"pressure angle of the {words}", _pressure_remedy(self)
            yield PRESSURE_ANGLE.check(status, what, value, limit, "deg", aside=aside, fix=fix)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402: roller against the curvature where it touches the profile, and against the source's (27)."""
        roller = self.section.roller_radius
        for words, cam in self.profiles.items():
            if not self.has_zone(cam):
                yield _covered(cam, words)
                continue
            least, fix = cam.min_curvature_radius, ""
            share = roller / least
            status: Status = "fail" if share >= 1.0 else "warn" if share > 0.8 else "pass"
            if status != "pass":
                fix = "use a smaller roller"
                if cam.contact[0][0] <= 0.0 and cam.contact[1][1] >= 1.0:  # else it also moves where the profile ends
                    fix = f"use a roller of at most {safely_below(remedies.roller_for_curvature(self))} mm"
            what = f"roller radius, {words}"
            shown = against_curvature(roller, least, status)
            yield CAM_UNDERCUT.check(status, what, share, 1.0, shown=shown, aside=_left_out(cam), fix=fix)
        if self.spec.layout == "twin-rocker" and self.has_profile:
            yield from _against_estimate(self, roller)

    def check_transition_zone(self) -> Iterator[Check]:
        """GL507: the contact changes sides within a small part of the stroke."""
        limit = self.spec.limits.transition_zone
        for words, cam in self.profiles.items():
            zone = cam.transition_zone
            fix = note = ""
            if zone > limit:
                roller = remedies.roller_for_zone(self)
                fix = "remove cam.rocker_radius"
                if math.isfinite(roller):
                    fix = f"use a roller of at most {safely_below(roller)} mm"
            status: Status = "fail" if zone > limit else "pass"
            if status == "pass" and zone > _UNGUIDED:
                status, note = (
                    "warn",
                    f"over {short(2.0 * zone, 3)} of the stroke the balancing device alone guides the rocker",
                )
            what = f"half-width of the contact change from one flank of the {words} to the other, over the stroke"
            yield TRANSITION_ZONE.check(status, what, zone, limit, recommended=_UNGUIDED, fix=fix, note=note)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: roller against the cam shaft, and the rocker's axis against the cam."""
        section, shaft = self.section, self.section.shaft_radius
        yield from _over_rocker_axis(self)
        if shaft == 0.0:
            return
        for words, cam in self.cams.items():
            bottom = cam.min_radius - section.roller_radius
            room = bottom - shaft
            status: Status = "pass"
            key, distance = remedies.center_distance(self, cam)
            fix = f"set {key} to at least {safely_above(distance)} mm"
            recommended = None
            if room <= 0.0:
                status = "fail"
            elif cam.sense > 0 and bottom < HUB * shaft * (1.0 - _ROUNDING):
                status, recommended = "warn", (HUB - 1.0) * shaft
                if bottom >= HUB * THINNEST * shaft:
                    fix = f"use a shaft_radius of at most {safely_below(bottom / HUB)} mm"
            yield SHAFT_CLEARANCE.check(
                status,
                f"distance of the roller of the {words} from the cam shaft",
                room,
                0.0,
                "mm",
                overlap=f"roller of the {words} within the cam shaft",
                recommended=recommended,
                aside=f"shaft radius {short(shaft)} mm",
                fix=fix,
            )

    def check_force_reserve(self) -> Check:
        """GL511: the device presses the roller to its cam at the design speed, with a tenth of speed to spare."""
        speed, lift_off = self.spec.speed, self.unloading.lift_off_speed
        status: Status = "pass"
        if lift_off < 1.1 * speed * (1.0 - 1e-9):
            status = "fail" if speed > lift_off * (1.0 + 1e-9) else "warn"
        back, fix = self.unloading.way_back, ""
        if status != "pass":
            fix = _more_force(self)
        at = aside = ""
        if back is not None and back.value > 1.0:
            at = f"k = {short(back.place)} of the return stroke"
            aside = f"the return stroke requires {short(back.value)} times the force"
            if math.isinf(back.value):
                aside = "the return stroke requires a force where the device has none"
        return FORCE_RESERVE.check(
            status,
            "lift-off speed of the roller",
            lift_off,
            speed,
            "1/min",
            recommended=1.1 * speed,
            aside=aside,
            at=at,
            fix=fix,
        )

    def check_side_change(self) -> Iterator[Check]:
        """GL514: device and roller change sides together, at the slot of a cam whose rocker drives a slider."""
        if self.spec.slider is None or not self.has_profile or not self.has_zone(self.cam):
            return
        start, end = self.slot_of(self.cam)
        middle = self.motion.slider.middle_place
        beyond = max(start - middle, middle - end)
        aside = f"force reverses at k {short(middle)}, roller contact at k {short(start)} to {short(end)}"
        if beyond > 0.0:
            what, fix = "the roller is pushed off its cam near mid-swing", remedies.side_words(self.spec.slider)
        else:
            what, fix = "balancing force and roller contact change sides together", ""
        status: Status = "fail" if beyond > 0.0 else "pass"
        yield SIDE_CHANGE.check(status, what, beyond, 0.0, shown=NO_NUMBER, aside=aside, fix=fix)

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303: the crank-rocker that carries the cam, over its turn, and the slider's rod, over the swing."""
        limit = self.spec.limits.transmission_angle
        for key, angle in self.motion.transmission_angles.items():
            subject, remedy = _TRANSMISSION[key]
            yield transmission_check(angle, limit, remedy, subject)

    def check_acceleration_step(self) -> Iterator[Check]:
        """GL404: at the joints of strokes and rests the tangent goes over, the rocker's acceleration jumps."""
        for words, cam in _contours(self):
            first, pace = cam.joints[0], self.spec.speed * math.tau / 60.0
            start = float(self.motion.plain_law.invariants(np.zeros(1), 2)[2][0])
            step = start * self.motion.swing * (pace / cam.own) ** 2
            what, aside = f"acceleration step of the rocker at the dwells of the {words}", "no velocity step"
            note = f"the radius of the pitch curve steps from {short(first.before)} to {short(first.after)} mm there"
            fix = "compute the vibration with the section shaft"
            yield ACCELERATION_STEP.check("warn", what, step, 0.0, "rad/s^2", aside=aside, fix=fix, note=note)

    def check_closed_contour(self) -> Iterator[Check]:
        """GL512: the roller goes round each closed contour without a cut, and the contour does not cross itself."""
        shaft, clearance = self.section.shaft_radius, self.section.free_clearance
        for words, cam in _contours(self):
            cut, least = cam.cut, cam.least_radius
            if cut.depth > _CUT * cam.cam.roller_radius:
                what = f"cut of the roller into the contour of the {words}"
                at = f"cam angle {short(math.degrees(cut.cam_angle))} deg"
                fix, shown = "use a smaller cam.roller_radius", Shown(cut.depth, 0.0, "mm", "<=")
                yield CLOSED_CONTOUR.check("fail", what, -cut.depth, 0.0, "mm", shown=shown, at=at, fix=fix)
            elif clearance >= cam.largest_clearance:
                most = cam.largest_clearance
                what = f"clearance of the roller in the free sector of the {words}"
                fix, shown = "use a smaller cam.roller_radius", NO_NUMBER
                if most > 0.0:
                    fix, shown = (
                        f"set cam.free_clearance below {safely_below(most)} mm",
                        Shown(clearance, most, "mm", "<="),
                    )
                else:
                    what = f"the contour of the {words} crosses itself in its free sector"
                yield CLOSED_CONTOUR.check("fail", what, clearance, most, "mm", shown=shown, fix=fix)
            elif least <= shaft:
                what = f"minimum radius of the contour of the {words}"
                fix = f"set a larger {remedies.distance_key(self, cam.cam)}"
                yield CLOSED_CONTOUR.check("fail", what, least, shaft, "mm", aside="shaft radius", fix=fix)
            elif cam.cam.sense > 0 and least < HUB * shaft and least < cam.cam.min_radius - cam.cam.roller_radius:
                what, shown = (
                    f"minimum radius of the contour of the {words}",
                    Shown(least, HUB * shaft, "mm", ">=", "recommended"),
                )
                aside, fix = f"{HUB:g} times the shaft radius", "set a smaller cam.free_clearance"
                yield CLOSED_CONTOUR.check("warn", what, least, shaft, "mm", shown=shown, aside=aside, fix=fix)
            else:
                what = f"minimum radius of the contour of the {words}"
                yield CLOSED_CONTOUR.check("pass", what, least, shaft, "mm")

    check_profile_planes, check_body_clearance = profile_planes, bodies.body_clearance
    check_flank_impact, check_cam_clearance = flank_impact, cam_clearance

    ways = remedies.WAYS
    requirements = Design.requirements | {"swing", "operating_speed_min"}

    @property
    def cost(self) -> float:
        """A slider's cam takes a tenth of a second to judge, a contour of a whole turn half of it, others less."""
        return 25.0 if self.spec.slider is not None else 7.0 if self.spec.cycle is not None else 3.5

    candidates, varied = remedies.candidates, remedies.varied

    at_once = 64
    alone = frozenset(("cycle-angles", "unloader-turnability", "swing-range", "device-pressure", "force-closure"))

    @classmethod
    def find_together(cls, designs: Sequence[WideSwingDesign], names: Sequence[str]) -> None:
        """Extremes of laws, and of cams, are sought together."""
        from gearlink.core.machines.wide_swing.together import find_together

        find_together(designs, frozenset(name.partition("[")[0] for name in names))

    # Outlines

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """With a cam `swing` judges the profile, the device, and a cycle or a slider."""
        more: tuple[str, ...] = ()
        if spec.cam is not None and command != "cam":
            more = (*_CAM_CHECKS, "force-reserve", *_BESIDE, *(("side-change",) if spec.slider is not None else ()))
        more += _CYCLE_CHECKS if spec.cycle is not None and spec.cam is not None else ()
        return tuple(dict.fromkeys((*super().judged(command, spec), *more)))

    def outline(self, command: str) -> Outline:
        """What the sections of the file allow; a profile with a loop leaves its quantities out of `swing`."""
        base, spec = self.outlines[command], self.spec
        cams = ("main_cam", "return_cam") if spec.drive is None and spec.slider is None else ("main_cam",)
        turn = ("joints",) if spec.cycle is not None else ()
        of_turn = _CYCLE_CHECKS if spec.cycle is not None else ()
        if command == "cam":
            sectors = (*PHASES, *CYCLE) if spec.cycle is not None else ()
            return Outline((*base.quantities, *sectors), (*base.checks, *of_turn), (*cams, *turn))
        quantities = [*base.quantities, *names(spec), *(SLIDER if spec.slider is not None else ()), *TORQUE]
        checks, tables = [*base.checks], [*base.tables]
        if spec.cycle is not None:
            quantities += PHASES
        if spec.shaft is not None:
            quantities += SHAFT
        if spec.slider is not None:
            tables.append("slider")
            checks += ("side-change",) if spec.cam is not None and not self._is_refused else ()
        if spec.cam is not None:
            quantities += self._profile_quantities(command)
            checks += (
                *(("profile-exists",) if self._is_refused else (*_CAM_CHECKS, *of_turn, *_BESIDE)),
                "force-reserve",
            )
        if spec.method == "iteration":
            quantities += ITERATION
            tables.append("iteration")
        if command == "analyze" and spec.cam is not None and self._profile_exists:
            tables += (*cams, *turn)
        return Outline(tuple(quantities), tuple(checks), tuple(tables))

    def _profile_quantities(self, command: str) -> list[str]:
        shown = [*PROFILE, *((*CURVATURE, *PLACES) if command == "analyze" else ())]
        if self._is_refused:
            return ["lift_off_speed"]
        if self.spec.drive is not None:
            shown = [*DRIVE, *(name for name in shown if name not in (*OF_EVEN_CAM, *OF_REST, *NEED_PROFILE))]
        if self.spec.slider is not None:
            shown = [*OF_SLIDER_CAM, *(name for name in shown if name not in (*OF_EVEN_CAM, *NEED_PROFILE))]
        section = self.section
        if section.second is not None:
            shown += SHAFTS
            if self.spec.gears is not None:
                shown += OF_GEARS
        other = None if self.spec.drive is not None else self.return_cam
        if other is not None:
            of_other = [*RETURN, *(RETURN_CURVATURE if command == "analyze" else ())]
            shown += of_other if self.has_zone(other) else [*RETURN_ZONE]
        if section.roller_clearance is not None:
            shown += [name for name in IMPACT if name != "impact_force" or section.contact_stiffness is not None]
        if self.spec.output_radius is not None:
            shown += GAIN
        if self.spec.cycle is not None and self._profile_exists:
            shown += CYCLE
        if not self._profile_exists:
            shown = [name for name in shown if name not in (*NEED_PROFILE, *NEED_ZONE)]
        elif not self.has_zone(self.cam):
            shown = [name for name in shown if name == "transition_zone" or name not in NEED_ZONE]
        return shown

    @property
    def _is_refused(self) -> bool:
        """Whether the cam alone is impossible; a stroke that is refused says so itself."""
        try:
            return self.refusal is not None
        except NoSolution:
            return False

    @property
    def _profile_exists(self) -> bool:
        """Whether the cam has a profile; where the stroke is refused the quantities say so, each with its key."""
        try:
            return self.refusal is None and self.has_profile
        except NoSolution:
            return True

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Every quantity, those of an optional section included."""
        return (*PATHS, *OF_GEARS)
