"""What to change in a wide-swing design that fails: numbers that, put into the design file, repair the finding."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

from gearlink.core.errors import NoSolution
from gearlink.core.numerics.nearest_good import nearest_good
from gearlink.core.report import safely_above, safely_below
from gearlink.core.spec_paths import replaced, value_at

if TYPE_CHECKING:
    from gearlink.core.wide_swing.design import WideSwingDesign
    from gearlink.core.wide_swing.outline import AnyCam
    from gearlink.core.wide_swing.spec import SwingDrive, SwingSlider

Value: TypeAlias = float | None

_STRICTLY = 1.0 + 1e-6


class Suggestion(NamedTuple):
    """A key of the design file, the value that repairs a finding (None: leave the key out), and the finding."""

    path: str
    value: Value
    why: str


def reserve(residual: float, margin: float) -> float:
    """Reserve of the device with which the roller lifts off a share of the speed above the design speed.

    rho = (1 + margin)^2 - 1 + f
    """
    needed = margin * (2.0 + margin) + residual
    return float(safely_above(needed)) if needed > 0.0 else 0.0


# Lengths that follow from similarity


def center_distance(design: WideSwingDesign) -> float:
    """Centre distance at which the rollers clear the cam shaft [mm]."""
    section = design.section
    needed = section.shaft_radius + section.roller_radius
    if section.rocker_radius is not None:
        return float(safely_above((section.rocker_radius + needed) * _STRICTLY))
    least = min(cam.min_radius for cam in design.cams.values())
    return float(safely_above(section.center_distance * needed / least * _STRICTLY))


def roller_for_zone(design: WideSwingDesign) -> float:
    """Roller radius that brings every cam's transition zone within the limit [mm]."""
    limit = design.spec.limits.transition_zone
    cams = [cam for cam in design.cams.values() if cam is not design.cam or design.has_profile]
    return float(safely_below(min(cam.largest_roller(limit) for cam in cams) / _STRICTLY))


def roller_for_curvature(design: WideSwingDesign) -> float:
    """Roller radius that keeps well below every cam's least curvature radius [mm]; one that touches where none does."""
    judged = [cam.min_curvature_radius for cam in design.cams.values() if design.has_zone(cam)]
    return float(safely_below(0.8 * min(judged) / _STRICTLY)) if judged else roller_for_zone(design)


# Angles


def cycle_angle(design: WideSwingDesign) -> float:
    """Cycle angle at which a twin-rocker's arm is as long as the centre distance; no loop at or below it [deg]."""
    motion = design.motion
    return float(safely_below(0.5 * math.degrees(motion.plain_law.velocity_peak * motion.swing)))


def profile(design: WideSwingDesign) -> Suggestion | None:
    """What frees the pitch curve of its loop."""
    drive = design.spec.drive
    if drive is not None:
        value = nearest_good(drive.crank, 0.05 * drive.crank, _trial(design, "drive.crank", lambda d: d.has_profile))
        return None if value is None else Suggestion("drive.crank", value, "the pitch curve has a loop")
    if design.section.rocker_radius is not None:
        return Suggestion("cam.rocker_radius", None, "the pitch curve has a loop with a longer rocker")
    if design.spec.cycle is not None:
        return None  # what one angle gives up another takes over, and which is the designer's choice
    return Suggestion("cycle_angle", cycle_angle(design), "the pitch curve has a loop at mid-swing")


def pressure(design: WideSwingDesign) -> Suggestion | None:
    """What brings the pressure angle of every cam within the limit, by the least change that was found."""
    why = f"the pressure angle exceeds the limit of {design.spec.limits.pressure_angle:g} deg"
    if design.section.rocker_radius is not None and _pressure_holds(changed(design, "cam.rocker_radius", None)):
        return Suggestion("cam.rocker_radius", None, why)
    for path, bounds in _ways(design):
        start = float(value_at(design.spec, path))
        found = [nearest_good(start, bound, _trial(design, path, _pressure_holds)) for bound in bounds]
        values = [value for value in found if value is not None]
        if values:
            return Suggestion(path, min(values, key=lambda value: abs(value - start)), why)
    return None


def _ways(design: WideSwingDesign) -> Iterator[tuple[str, tuple[float, ...]]]:
    """Keys that bear on the pressure angle and how far each may go."""
    if design.spec.drive is not None:
        yield "drive.crank", (0.05 * design.spec.drive.crank,)
    elif design.spec.cycle is None:
        yield "cycle_angle", (1.0, 180.0)
    yield "swing", (5.0, 300.0)


def changed(design: WideSwingDesign, path: str, value: Value) -> WideSwingDesign:
    """The design with one key changed; the law is kept where it does not depend on the key."""
    trial = type(design)(replaced(design.spec, path, value))
    if path.startswith(("cam", "cycle_angle", "drive")) and design.spec.slider is None:
        vars(trial.motion)["plain_law"] = design.motion.plain_law
    return trial


def _trial(design: WideSwingDesign, path: str, good: Callable[[WideSwingDesign], bool]) -> Callable[[float], bool]:
    def test(value: float) -> bool:
        try:
            return good(changed(design, path, value))
        except NoSolution:
            return False

    return test


def _pressure_holds(trial: WideSwingDesign) -> bool:
    limit = trial.spec.limits.pressure_angle
    cams = trial.cams.values()
    # Most values that are tried exceed the limit by far: a few places tell, before any maximum is refined.
    if any(math.degrees(_pressure_somewhere(cam)) > limit for cam in cams):
        return False
    return all(trial.has_zone(cam) and math.degrees(cam.max_pressure_angle) <= limit for cam in cams)


def _pressure_somewhere(cam: AnyCam) -> float:
    """Largest pressure angle at a few places well before mid-swing [rad], infinite where the pitch curve has a loop."""
    import numpy as np

    try:
        end = 0.5 - 4.0 * cam.transition_zone_estimate
    except NoSolution:
        return math.inf
    return float(np.abs(cam.pressure_angle(np.linspace(0.0, end, 17))).max()) if end > 0.0 else 0.0


# Combined mechanisms


def with_number(error: NoSolution, repair: Suggestion) -> NoSolution:
    """The refusal, with the key to change and its value."""
    return NoSolution(f"{error.message}: make {repair.path} {repair.value:.12g}", key=repair.path)


def slider_repair(section: SwingSlider, swing: float) -> Suggestion:
    """The arm's angle at mid-swing, or the swing, that keeps the slider off its dead centres."""
    extended = -math.asin(section.offset / (section.rod + section.crank))
    folded = math.pi - math.asin(section.offset / (section.rod - section.crank))
    half = 0.5 * (folded - extended)
    given = math.radians(section.middle_angle)
    places = ((extended + half, half), (extended + half + math.pi, math.pi - half))
    place, room = min(places, key=lambda p: abs(math.remainder(p[0] - given, 2.0 * math.pi)))
    why = "the swing holds a dead centre of the slider"
    if 0.5 * swing < room and abs(math.remainder(place - given, 2.0 * math.pi)) > 1e-3:
        angle = math.degrees(math.remainder(place, 2.0 * math.pi))
        return Suggestion("slider.middle_angle", round(angle, 3), why)
    return Suggestion("swing", float(safely_below(math.degrees(1.9 * room))), why)


def drive_repair(section: SwingDrive) -> Suggestion:
    """A length that makes the drive a crank-rocker."""
    others = sorted((getattr(section, name), name) for name in ("coupler", "rocker", "frame"))
    (least, _), (middle, _), (longest, name) = others
    room = least + middle - longest
    why = "the drive is no crank-rocker"
    if room > 0.0:
        return Suggestion("drive.crank", float(safely_below(0.9 * min(least, room))), why)
    if section.crank < least:
        length = max(middle, 0.95 * (least + middle - section.crank))
        return Suggestion(f"drive.{name}", float(safely_below(length, 9)), why)
    return Suggestion("drive.crank", float(safely_below(0.5 * least)), why)


# Suggestions


def suggestions(design: WideSwingDesign) -> list[Suggestion]:
    """Changes of the design file that repair what fails or is refused, the first to be tried first.

    Returns
        suggestions : list of (path, value, why) - value None: leave the key out; each path once
    Notes
        In the order device, slider or drive, cyclogram, shaft, profile, pressure angle, roller, reserve. A change
        may bring up another finding: apply the first, and ask again.
    Source
        own derivation; the conditions are those of the wide-swing dissertation
    """
    found: dict[str, Suggestion] = {}
    for step in (_device, _combination, _cycle, _shaft, _profile, _pressure, _roller, _reserve):
        try:
            suggestion = step(design)
        except NoSolution:
            # what is refused here has a step of its own
            continue
        if suggestion is not None:
            found.setdefault(suggestion.path, suggestion)
    return list(found.values())


def _fails(design: WideSwingDesign, name: str) -> bool:
    return any(check.status == "fail" for check in design.check(name))


def _device(design: WideSwingDesign) -> Suggestion | None:
    least, ratio = design.motion.usual_pivot_ratio, design.spec.unloader.pivot_ratio
    if ratio <= 1.0 or _fails(design, "unloader-turnability"):
        value = float(safely_above(least))
        return Suggestion("unloader.pivot_ratio", value, f"the device needs a pivot ratio of {least:.6g} or more")
    return None


def _combination(design: WideSwingDesign) -> Suggestion | None:
    if design.spec.drive is not None:
        try:
            _ = design.motion.drive
        except NoSolution:
            return drive_repair(design.spec.drive)
    section = design.spec.slider
    if section is None:
        return None
    if section.rod <= section.crank + abs(section.offset):
        rod = float(safely_above(3.0 * (section.crank + abs(section.offset))))
        return Suggestion("slider.rod", rod, "the rod must exceed crank plus offset")
    try:
        _ = design.motion.slider.energy_parameter
    except NoSolution:
        return slider_repair(section, design.motion.swing)
    return None


def _cycle(design: WideSwingDesign) -> Suggestion | None:
    if _fails(design, "cycle-angles"):
        return Suggestion("cycle_angle", 180.0, "both strokes must find room in one turn of the cam")
    return None


def _shaft(design: WideSwingDesign) -> Suggestion | None:
    if design.spec.cam is not None and _fails(design, "shaft-clearance"):
        return Suggestion("cam.center_distance", center_distance(design), "a roller comes into the cam shaft")
    return None


def _profile(design: WideSwingDesign) -> Suggestion | None:
    if design.spec.cam is None:
        return None
    try:
        cam = design.cam
    except NoSolution:
        if design.spec.layout != "twin-rocker" or design.spec.cycle is not None:
            raise
        # a twin-rocker whose rocker is slower than its cam
        return Suggestion("cycle_angle", cycle_angle(design), "a twin-rocker must turn faster than its cam")
    return None if cam.loop_margin > 0.0 and design.has_profile else profile(design)


def _pressure(design: WideSwingDesign) -> Suggestion | None:
    return pressure(design) if design.spec.cam is not None and _fails(design, "pressure-angle") else None


def _roller(design: WideSwingDesign) -> Suggestion | None:
    if design.spec.cam is None:
        return None
    values = []
    if _fails(design, "transition-zone"):
        values.append((roller_for_zone(design), "the contact changes sides over too much of the stroke"))
    if _fails(design, "cam-undercut"):
        values.append((roller_for_curvature(design), "the roller is too large for the pitch curve"))
    return Suggestion("cam.roller_radius", *min(values)) if values else None


def _reserve(design: WideSwingDesign) -> Suggestion | None:
    if design.spec.cam is None or not _fails(design, "force-reserve"):
        return None
    value = reserve(design.spec.unloader.residual, 0.1)
    return Suggestion("unloader.reserve", value, "the roller leaves its cam at the design speed")
