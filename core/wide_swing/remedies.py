"""What to change in a wide-swing design that fails: numbers that, put into the design file, repair the finding."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.numerics.nearest_good import nearest_good
from gearlink.core.report import safely_above, safely_below
from gearlink.core.results import cached_property
from gearlink.core.spec_paths import replaced, value_at
from gearlink.core.wide_swing.design_profile import WideSwingProfile

if TYPE_CHECKING:
    from gearlink.core.wide_swing.cam import WideSwingCam
    from gearlink.core.wide_swing.oscillating_cam import CrankRockerDrive, OscillatingCam
    from gearlink.core.wide_swing.slider import SliderLaw

Value: TypeAlias = float | None

_STRICTLY = 1.0 + 1e-6


class Suggestion(NamedTuple):
    """A key of the design file, the value that repairs a finding (None: leave the key out), and the finding."""

    path: str
    value: Value
    why: str


class WideSwingMending(WideSwingProfile):
    """The design with the numbers that repair it; every one is computed when a finding asks for it."""

    def changed(self, path: str, value: Value) -> WideSwingMending:
        """The design with one key changed; the law is kept where it does not depend on the key."""
        trial = type(self)(replaced(self.spec, path, value))
        if path.startswith(("cam", "cycle_angle", "drive")) and self.spec.slider is None:
            trial.__dict__["plain_law"] = self.plain_law
        return trial

    # Lengths that follow from similarity

    @cached_property
    def repaired_center_distance(self) -> float:
        """Centre distance at which the rollers clear the cam shaft [mm]."""
        section = self.section
        needed = section.shaft_radius + section.roller_radius
        if section.rocker_radius is not None:
            return float(safely_above((section.rocker_radius + needed) * _STRICTLY))
        least = min(cam.min_radius for cam in self.cams.values())
        return float(safely_above(section.center_distance * needed / least * _STRICTLY))

    @cached_property
    def repaired_roller_radius(self) -> float:
        """Roller radius that brings every cam's transition zone within the limit [mm]."""
        limit, roller = self.spec.limits.transition_zone, self.section.roller_radius
        zones = [cam.transition_zone for cam in self.cams.values() if cam is not self.cam or self.has_profile]
        return float(safely_below(roller * limit / max(zones) / _STRICTLY))

    @cached_property
    def repaired_roller_for_curvature(self) -> float:
        """Roller radius that keeps well below every cam's least curvature radius [mm]."""
        least = min(cam.min_curvature_radius for cam in self.cams.values() if self.has_zone(cam))
        return float(safely_below(0.8 * least / _STRICTLY))

    # Angles

    @property
    def repaired_cycle_angle(self) -> float:
        """Cycle angle at which a twin-rocker's arm is as long as the centre distance; no loop at or below it [deg]."""
        return float(safely_below(0.5 * math.degrees(self.plain_law.velocity_peak * self.swing)))

    @cached_property
    def repaired_profile(self) -> Suggestion | None:
        """What frees the pitch curve of its loop."""
        if self.spec.drive is not None:
            value = nearest_good(self.spec.drive.crank, 0.05 * self.spec.drive.crank, self._try("drive.crank", _exists))
            return None if value is None else Suggestion("drive.crank", value, "the pitch curve has a loop")
        if self.section.rocker_radius is not None:
            return Suggestion("cam.rocker_radius", None, "the pitch curve has a loop with a longer rocker")
        return Suggestion("cycle_angle", self.repaired_cycle_angle, "the pitch curve has a loop at mid-swing")

    @cached_property
    def repaired_pressure(self) -> Suggestion | None:
        """What brings the pressure angle of every cam within the limit, by the least change that was found."""
        why = f"the pressure angle exceeds the limit of {self.spec.limits.pressure_angle:g} deg"
        if self.section.rocker_radius is not None and _pressure_holds(self.changed("cam.rocker_radius", None)):
            return Suggestion("cam.rocker_radius", None, why)
        for path, bounds in self._ways():
            start = float(value_at(self.spec, path))
            found = [nearest_good(start, bound, self._try(path, _pressure_holds)) for bound in bounds]
            values = [value for value in found if value is not None]
            if values:
                return Suggestion(path, min(values, key=lambda value: abs(value - start)), why)
        return None

    def _ways(self) -> Iterator[tuple[str, tuple[float, ...]]]:
        """Keys that bear on the pressure angle and how far each may go."""
        if self.spec.drive is not None:
            yield "drive.crank", (0.05 * self.spec.drive.crank,)
        else:
            yield "cycle_angle", (1.0, 180.0)
        yield "swing", (5.0, 300.0)

    def _try(self, path: str, good: Callable[[WideSwingMending], bool]) -> Callable[[float], bool]:
        def test(value: float) -> bool:
            try:
                return good(self.changed(path, value))
            except NoSolution:
                return False

        return test

    # Combined mechanisms

    @cached_property
    def drive(self) -> CrankRockerDrive:
        """The crank-rocker that carries the cam; its refusal names the length to change."""
        try:
            return super().drive
        except MissingSection:
            raise
        except NoSolution as error:
            raise _with_number(error, self.repaired_drive()) from error

    @cached_property
    def slider_law(self) -> SliderLaw:
        """The law of rocker and slider; its refusal at a dead centre names the angle to change."""
        try:
            return super().slider_law
        except NoSolution as error:
            if error.key != "slider.middle_angle":
                raise
            raise _with_number(error, self.repaired_slider_angle()) from error

    @property
    def repaired_slider_rod(self) -> float:
        """A usual length of the connecting rod [mm]."""
        section = self.spec.slider
        assert section is not None
        return float(safely_above(3.0 * (section.crank + abs(section.offset))))

    def repaired_slider_angle(self) -> Suggestion:
        """The arm's angle at mid-swing, or the swing, that keeps the slider off its dead centres."""
        section = self.spec.slider
        assert section is not None
        extended = -math.asin(section.offset / (section.rod + section.crank))
        folded = math.pi - math.asin(section.offset / (section.rod - section.crank))
        half = 0.5 * (folded - extended)
        given = math.radians(section.middle_angle)
        places = ((extended + half, half), (extended + half + math.pi, math.pi - half))
        place, room = min(places, key=lambda p: abs(math.remainder(p[0] - given, 2.0 * math.pi)))
        why = "the swing holds a dead centre of the slider"
        if 0.5 * self.swing < room and abs(math.remainder(place - given, 2.0 * math.pi)) > 1e-3:
            angle = math.degrees(math.remainder(place, 2.0 * math.pi))
            return Suggestion("slider.middle_angle", round(angle, 3), why)
        return Suggestion("swing", float(safely_below(math.degrees(1.9 * room))), why)

    def repaired_drive(self) -> Suggestion:
        """A length that makes the drive a crank-rocker."""
        section = self.spec.drive
        assert section is not None
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


def _with_number(error: NoSolution, repair: Suggestion) -> NoSolution:
    return NoSolution(f"{error.message}: make {repair.path} {repair.value:.12g}", key=repair.path)


def _exists(trial: WideSwingMending) -> bool:
    return trial.has_profile


def _pressure_holds(trial: WideSwingMending) -> bool:
    limit = trial.spec.limits.pressure_angle
    cams = trial.cams.values()
    # Most values that are tried exceed the limit by far: a few places tell, before any maximum is refined.
    if any(math.degrees(_pressure_somewhere(cam)) > limit for cam in cams):
        return False
    return all(trial.has_zone(cam) and math.degrees(cam.max_pressure_angle) <= limit for cam in cams)


def _pressure_somewhere(cam: WideSwingCam | OscillatingCam) -> float:
    """Largest pressure angle at a few places of the stroke [rad], infinite where the pitch curve has a loop."""
    try:
        end = 0.5 - cam.transition_zone
    except NoSolution:
        return math.inf
    if end <= 0.0:
        return math.inf
    return float(np.abs(cam.pressure_angle(np.linspace(0.0, end, 17))).max())
