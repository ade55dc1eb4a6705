"""What to change in a wide-swing design that fails: numbers that, put into the design file, repair the finding."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import REFUSAL, at_least, at_most, down, either, thinner, up
from gearlink.core.base.results import keep, kept
from gearlink.core.base.spec_paths import changed, number_at
from gearlink.core.machines.wide_swing.bodies import device_room
from gearlink.core.numerics.roots import roots_on
from gearlink.core.parts.cams.checks import HUB
from gearlink.core.parts.linkages.slider_crank import slider_sweep

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.slider import SliderDrive
    from gearlink.core.machines.wide_swing.spec import SwingDrive, SwingSlider
    from gearlink.core.machines.wide_swing.strokes import AnyCam

Change: TypeAlias = tuple[str, float | None]
"""A key of the design file and the value that repairs a finding; None: leave the key out."""

_STRICTLY = 1.0 + 1e-6
_DEGREES, _RATIO = 0.5, 0.01
_STEPS = 16
_SAME_ANGLE = 0.011

_CYCLE = down("cycle_angle", step=_DEGREES)
_DISTANCES = ("cam.center_distance", "cam.second.center_distance")
_ROLLER = (down("cam.roller_radius"), up("cam.center_distance"))
WAYS = {
    "pressure-angle": (*either("slider.middle_angle", step=1.0), down("slider.crank")),
    "unloader-turnability": (up("unloader.pivot_ratio", step=_RATIO), down("swing", step=_DEGREES)),
    "force-closure": (up("unloader.stretch_ratio"),),
    "profile-exists": (_CYCLE, down("drive.crank"), up("swing", step=_DEGREES)),
    "cam-undercut": _ROLLER,
    "transition-zone": _ROLLER,
    "shaft-clearance": (*map(up, _DISTANCES), down("cam.roller_radius"), *thinner("cam.shaft_radius")),
    "body-clearance": (up("unloader.arm"), *either("slider.middle_angle", step=1.0)),
    "force-reserve": (up("unloader.reserve", step=_RATIO),),
    "transmission-angle": (down("drive.crank"), *either("drive.coupler", "drive.frame")),
}


def candidates(design: WideSwingDesign, check: str) -> Iterable[Remedy]:
    """Remedies of a check, or of a refusal, from closed forms, the first to be tried first."""
    if check == "side-change" and design.spec.slider is not None:
        return side_changes(design.spec.slider)
    return ((change,) for change in _CLOSED[check](design)) if check in _CLOSED else ()


def reserve(residual: float, margin: float, need: float = 1.0) -> float:
    """Reserve of the device with which the roller lifts off a share of the speed above the design speed.

    rho = (1 + margin)^2 k_b - 1 + f, k_b the need of the return stroke
    """
    return max(0.0, margin * (2.0 + margin) * need + (need - 1.0) + residual)


# Lengths that follow from similarity


def distance_key(design: WideSwingDesign, cam: AnyCam) -> str:
    """The key of a cam's centre distance."""
    second = design.section.second
    own = second is not None and second.center_distance is not None and cam is design.return_cam
    return "cam.second.center_distance" if own else "cam.center_distance"


def center_distance(design: WideSwingDesign, cam: AnyCam) -> tuple[str, float]:
    """Key and centre distance [mm] at which a cam's roller leaves the shaft its hub, with those on the same shaft."""
    section, second = design.section, design.section.second
    needed = HUB * section.shaft_radius + section.roller_radius
    key, apart = distance_key(design, cam), second is not None and second.center_distance is not None
    if section.rocker_radius is not None:
        return key, (section.rocker_radius + needed) * _STRICTLY
    shares = [each.min_radius / each.center_distance for each in ((cam,) if apart else design.cams.values())]
    return key, needed / min(shares) * _STRICTLY


def roller_for_zone(design: WideSwingDesign) -> float:
    """Roller radius that brings every cam's transition zone within the limit [mm]."""
    limit = design.spec.limits.transition_zone
    return min(cam.largest_roller(limit) for cam in design.profiles.values()) / _STRICTLY


def roller_for_curvature(design: WideSwingDesign) -> float:
    """Roller radius that keeps well below every cam's least curvature radius [mm]; one that touches where none does.

    Notes
        A smaller roller touches the profile nearer to mid-swing, where it bends more: where the radius found at the
        given one does not hold itself, the largest one that does is sought.
    """
    judged = [cam.min_curvature_radius for cam in design.cams.values() if design.has_zone(cam)]
    if not judged:
        return roller_for_zone(design)
    most, good = 0.8 * min(judged) / _STRICTLY, _good(design, "cam.roller_radius", _curvature_holds)
    return most if good(most) else _nearest_good(most, 0.0, good, 0.1 if most > 2.0 else 0.05 * most) or most


def _curvature_holds(trial: WideSwingDesign) -> bool:
    cams = (cam for cam in trial.cams.values() if trial.has_zone(cam))
    return all(trial.section.roller_radius <= 0.8 * cam.min_curvature_radius for cam in cams)


def roller_of_profile(design: WideSwingDesign) -> float | None:
    """Roller radius that the profiles can bear [mm], where they cannot bear the one given; None where they can."""
    if all(cam.transition_zone <= design.spec.limits.transition_zone for cam in design.profiles.values()):
        return None
    most = min(roller_for_zone(design), roller_for_curvature(design))
    return most if most < design.section.roller_radius else None


def _shaft(design: WideSwingDesign) -> Iterator[Change]:
    """The roller first where its profile asks for a smaller one as well."""
    roller = roller_of_profile(design)
    if roller is not None:
        yield "cam.roller_radius", at_most(roller)
    bottom = HUB * design.section.shaft_radius + design.section.roller_radius
    changes = [center_distance(design, cam) for cam in design.cams.values() if cam.min_radius < bottom]
    yield from ((path, at_least(value)) for path, value in dict.fromkeys(changes))


def _longer_arm(design: WideSwingDesign) -> Iterator[Change]:
    """The arm that takes the device away from the rocker's axis."""
    unloader = design.spec.unloader
    if unloader.type == "gravity":
        return
    room = device_room(unloader.pivot_ratio, design.motion.swing)
    least = design.section.roller_radius / room
    if unloader.arm < least:
        yield "unloader.arm", at_least(least)


# Angles


def cycle_angle(design: WideSwingDesign) -> float:
    """Cycle angle at which a twin-rocker's arm is as long as the centre distance; no loop at or below it [deg]."""
    motion = design.motion
    return 0.5 * math.degrees(motion.plain_law.velocity_peak * motion.swing)


def _profile(design: WideSwingDesign) -> Iterator[Change]:
    """What frees the pitch curve of its loop, or lets a twin-rocker turn faster than its cam."""
    if design.spec.drive is not None:
        found = drive_crank(design)
        if found is not None:
            yield "drive.crank", found
        return
    if design.section.rocker_radius is not None:
        yield "cam.rocker_radius", None
    if design.spec.cycle is None:  # what one angle of a whole cycle gives up another takes over: the designer's choice
        yield "cycle_angle", at_most(cycle_angle(design), _DEGREES)


def drive_crank(design: WideSwingDesign) -> float | None:
    """The longest crank of the drive below the one given whose cam has no loop [mm]; None where none was found."""
    crank = number_at(design.spec, "drive.crank") or 0.0
    return _nearest_good(crank, 0.05 * crank, _good(design, "drive.crank", lambda trial: trial.has_profile), 0.1)


def _pressure(design: WideSwingDesign) -> Iterator[Change]:
    """What brings the pressure angle of every cam within the limit: keys by turns, the minimum change of each first."""
    if design.section.rocker_radius is not None:
        yield "cam.rocker_radius", None
    if design.spec.slider is not None:  # a third of a second each: the few trials of the ways must do
        return
    for path, step, bounds in _bearing(design):
        start = number_at(design.spec, path) or 0.0
        found = (_nearest_good(start, bound, _good(design, path, _pressure_holds), step) for bound in bounds)
        values = [value for value in found if value is not None]
        yield from ((path, value) for value in sorted(values, key=lambda value, start=start: abs(value - start)))  # type: ignore[misc]


def _bearing(design: WideSwingDesign) -> Iterator[tuple[str, float, tuple[float, ...]]]:
    """Keys that bear on the pressure angle, their step, and how far each may go."""
    if design.spec.drive is not None:
        yield "drive.crank", 0.1, (0.05 * design.spec.drive.crank,)
    elif design.spec.cycle is None:
        yield "cycle_angle", _DEGREES, (1.0, 180.0)
    yield "swing", _DEGREES, (5.0, 300.0)


def _good(design: WideSwingDesign, path: str, good: Callable[[WideSwingDesign], bool]) -> Callable[[float], bool]:
    def test(value: float) -> bool:
        spec = changed(design.spec, ((path, value),))
        try:
            return spec is not None and good(varied(design, spec))
        except NoSolution:
            return False

    return test


def varied(design: WideSwingDesign, spec: object) -> WideSwingDesign:
    """The design of another file; the law is kept where it is the same."""
    trial, given = type(design)(spec), design.spec
    if trial.spec.swing == given.swing and trial.spec.unloader == given.unloader and given.slider is None:
        keep(trial.motion, **kept(design.motion, "device", "plain_law"))
    return trial


def _pressure_holds(trial: WideSwingDesign) -> bool:
    limit = trial.spec.limits.pressure_angle
    cams = trial.cams.values()
    # Most values that are tried exceed the limit by far: a few places tell, before any maximum is refined.
    if any(math.degrees(_pressure_somewhere(cam)) > limit for cam in cams):
        return False
    return all(trial.has_zone(cam) and math.degrees(cam.max_pressure_angle) <= limit for cam in cams)


def _pressure_somewhere(cam: AnyCam) -> float:
    """Largest pressure angle at a few places well before mid-swing [rad], infinite where the pitch curve has a loop."""
    try:
        end = 0.5 - 1.2 * cam.transition_zone_estimate
    except NoSolution:
        return math.inf
    return float(np.abs(cam.pressure_angle(np.linspace(0.0, end, 17))).max()) if end > 0.0 else 0.0


def _nearest_good(bad: float, limit: float, good: Callable[[float], bool], step: float) -> float | None:
    """The multiple of `step` nearest to `bad` on the way to `limit` that is good; None where none is found.

    Notes
        Sixteen wide steps to the first good value, then halving back.
    Example
        >>> _nearest_good(100.0, 20.0, lambda x: x * x < 3000.0, 0.1), _nearest_good(1.0, 2.0, lambda x: x > 5.0, 0.1)
        (54.7, None)
    """
    sense = math.copysign(1.0, limit - bad)

    def value(count: int) -> float:
        nearest = math.floor(sense * bad / step + 1e-9)
        return round(sense * (nearest + count) * step, 9)

    most = int(sense * (limit - bad) / step)
    last, found = 0, None
    for i in range(1, _STEPS + 1):
        count = max(last + 1, most * i // _STEPS)
        if count <= most and good(value(count)):
            found = count
            break
        last = count
    if found is None:
        return None
    while found - last > 1:
        middle = (last + found) // 2
        last, found = (last, middle) if good(value(middle)) else (middle, found)
    return value(found)


# Combined mechanisms


def with_number(error: NoSolution, repair: tuple[str, float] | None) -> NoSolution:
    """The refusal, with the key to change and its value, where there is such a one."""
    if repair is None:
        return error
    path, value = repair
    return NoSolution(error.message, key=path, fix=f"set {path} to {value:.12g}")


def slider_repair(drive: SliderDrive, swing: float) -> tuple[str, float]:
    """The arm's angle at mid-swing, or the swing, that keeps the slider off its dead centres."""
    extended, folded = drive.dead_centers()
    half = 0.5 * (folded - extended)
    places = ((extended + half, half), (extended + half + math.pi, math.pi - half))
    turn, room = min(places, key=lambda p: abs(math.remainder(p[0], math.tau)))
    if 0.5 * swing < room and abs(math.remainder(turn, math.tau)) > 1e-3:
        return "slider.middle_angle", round(math.degrees(math.remainder(drive.middle_angle + turn, math.tau)), 2)
    return "swing", at_most(math.degrees(1.9 * room), _DEGREES)


def even_middle_angle(section: SwingSlider) -> float | None:
    """The arm's angle at mid-swing [deg], the nearest to the file's, at which the slider is fastest; None where it is.

    d2s/dphi2 = 0
    """

    def bend(angle: float) -> float:
        return float(slider_sweep(angle - 0.5 * math.pi, section.crank, section.rod, section.offset, 2)[2])

    given = math.radians(section.middle_angle)
    grid = (given + np.linspace(-math.pi, math.pi, 91)).tolist()
    nearest = min(roots_on(bend, grid), key=lambda place: abs(place - given), default=given)
    found = round(math.degrees(math.remainder(nearest, 2.0 * math.pi)), 2)
    return None if abs(math.remainder(found - section.middle_angle, 360.0)) < _SAME_ANGLE else found


def side_words(section: SwingSlider) -> str:
    """What brings device and roller to change sides together."""
    angle = even_middle_angle(section)
    turn = "" if angle is None else "turn slider.middle_angle until the slider is fastest at mid-swing, or "
    return f"{turn}reduce slider.mass"  # no value: those that help were tried before


def side_changes(section: SwingSlider) -> Iterator[tuple[Change, ...]]:
    """The arm at which the slider is fastest at mid-swing, and lighter sliders, under which the rocker is as well."""
    angle = even_middle_angle(section)
    turned: tuple[Change, ...] = () if angle is None else (("slider.middle_angle", angle),)
    if turned:
        yield turned
    yield from ((*turned, ("slider.mass", at_most(share * section.mass))) for share in (0.5, 0.2, 0.1))


def drive_repair(section: SwingDrive) -> tuple[str, float] | None:
    """A length that makes the drive a crank-rocker; None where one alone cannot."""
    others = sorted((getattr(section, name), name) for name in ("coupler", "rocker", "frame"))
    (least, shortest), (middle, _), (longest, name) = others
    room = least + middle - longest
    if room > 0.0:
        return "drive.crank", at_most(0.9 * min(least, room))
    if section.crank < least:
        return f"drive.{name}", max(middle, at_most(0.95 * (least + middle - section.crank)))
    if section.crank < middle:  # the bound is crank + longest - middle
        return f"drive.{shortest}", min(longest, at_least(longest - 0.5 * (middle - section.crank)))
    return None


def _rod(design: WideSwingDesign) -> Iterator[Change]:
    """The rod that keeps the limit, well or just."""
    section, limit = design.spec.slider, design.spec.limits.transmission_angle
    if section is None:
        return
    reach = section.rod * math.cos(design.motion.transmission_angles["slider.rod"])
    for aim in (limit + 5.0, limit):
        if aim < 90.0:
            yield "slider.rod", at_least(reach / math.cos(math.radians(aim)))


def _refused(design: WideSwingDesign) -> Iterator[Change]:
    """What makes device, drive or slider possible."""
    spec, motion = design.spec, design.motion
    if spec.unloader.type != "gravity" and spec.unloader.pivot_ratio <= 1.0:
        yield "unloader.pivot_ratio", at_least(motion.usual_pivot_ratio, _RATIO)
    repair = drive_repair(spec.drive) if spec.drive is not None else None
    if repair is not None:
        yield repair
    if spec.slider is None:
        return
    if spec.slider.rod <= spec.slider.crank + abs(spec.slider.offset):
        yield "slider.rod", at_least(3.0 * (spec.slider.crank + abs(spec.slider.offset)))
        return
    yield slider_repair(motion.slider_drive, motion.swing)


def _reserve(design: WideSwingDesign) -> Iterator[Change]:
    need = design.unloading.need
    if math.isfinite(need):
        yield "unloader.reserve", at_least(reserve(design.spec.unloader.residual, 0.1 + 1e-9, need), _RATIO)


_CLOSED: dict[str, Callable[[WideSwingDesign], Iterator[Change]]] = {
    REFUSAL: _refused,
    "unloader-turnability": lambda d: _one("unloader.pivot_ratio", at_least(d.motion.usual_pivot_ratio, _RATIO)),
    "transmission-angle": _rod,
    "cycle-angles": lambda _: _one("cycle_angle", 180.0),
    "balancing": lambda d: _one("operating_speed_min", at_least(d.unloading.harmful_speed)),
    "profile-exists": _profile,
    "pressure-angle": _pressure,
    "cam-undercut": lambda d: _one("cam.roller_radius", at_most(roller_for_curvature(d))),
    "transition-zone": lambda d: _one("cam.roller_radius", at_most(roller_for_zone(d))),
    "shaft-clearance": _shaft,
    "body-clearance": _longer_arm,
    "force-reserve": _reserve,
}


def _one(path: str, value: float) -> Iterator[Change]:
    yield path, value
