"""Checks of a wide-swing mechanism: device, stroke and cams."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.errors import NoSolution
from gearlink.core.report import Check, Status, safely_above, safely_below
from gearlink.core.wide_swing.remedies import Suggestion, WideSwingMending

if TYPE_CHECKING:
    from gearlink.core.wide_swing.cam import WideSwingCam
    from gearlink.core.wide_swing.oscillating_cam import OscillatingCam


class WideSwingChecks(WideSwingMending):
    """The checks; where the pitch curve has a loop, `profile-exists` alone speaks of that cam."""

    # Device and stroke

    def check_unloader_turnability(self) -> Iterator[Check]:
        """GL504: the device can follow the whole swing."""
        least, ratio = self.fitting_pivot_ratio, self.spec.unloader.pivot_ratio
        if least is None:
            return
        status: Status = "fail" if ratio < least else "pass"
        text = f"pivot ratio {ratio:g}, at least {least:.6g} is needed over a swing of {self.spec.swing:g} deg"
        if status == "fail":
            text += f": increase unloader.pivot_ratio to at least {safely_above(least)}, or reduce the swing"
        yield Check("GL504", "unloader-turnability", status, text, ratio, least)

    def check_force_closure(self) -> Iterator[Check]:
        """GL509: a spring that is slack at mid-swing does not hold the roller there."""
        unloader = self.spec.unloader
        if unloader.type == "pneumatic":
            return
        stretch = unloader.stretch_ratio
        status: Status = "warn" if stretch == 0.0 else "pass"
        text = f"the spring's mounting stretch is {stretch:g} of its stroke"
        if status == "warn":
            text += ": it is slack at mid-swing; make unloader.stretch_ratio above 0, such as 0.1"
        yield Check("GL509", "force-closure", status, text, stretch, 0.0)

    def check_cycle_angles(self) -> Iterator[Check]:
        """GL510: both strokes find room in one turn of the cam."""
        if self.spec.drive is not None:
            return
        both = 2.0 * math.degrees(self.cycle_angle)
        text = f"both strokes take {both:g} deg of the cam's turn"
        if both > 360.0:
            text += ", more than 360 deg: reduce cycle_angle to 180 deg or less"
        yield Check("GL510", "cycle-angles", "fail" if both > 360.0 else "pass", text, both, 360.0, "deg")

    def check_balancing(self) -> Iterator[Check]:
        """GL508: speeds at which the device does harm."""
        harm = self.harmful_speed
        text = f"the device lowers the torque above {harm:.5g} rev/min and raises it below"
        lowest = self.spec.operating_speed_min
        if lowest is None:
            return
        status: Status = "warn" if lowest < harm else "pass"
        if status == "warn":
            share = (lowest / self.spec.speed) ** 2
            text += (
                f"; at {lowest:g} rev/min lower its force or rate to {share:.3g} of the design value, or take it off"
            )
        yield Check("GL508", "balancing", status, text, lowest, harm, "1/min")

    # Cams

    def _judged(self, *, zone: bool) -> Iterator[tuple[str, WideSwingCam | OscillatingCam]]:
        """The cams with a profile, and with `zone` those whose transition zone leaves something to judge."""
        for words, cam in self.cams.items():
            if (cam is not self.cam or self.has_profile) and (not zone or self.has_zone(cam)):
                yield words, cam

    def check_profile_exists(self) -> Check:
        """GL505: no loop, and a phase angle above zero."""
        margin = self.cam.loop_margin
        shown = margin if math.isfinite(margin) else None
        try:
            self.cam.require_profile()
        except NoSolution as error:
            repair = self.repaired_profile if self.spec.drive is not None else None
            text = error.message + (f": make {repair.path} at most {repair.value:.12g} mm" if repair else "")
            return Check("GL505", "profile-exists", "fail", text, shown, 0.0)
        text = "the pitch curve has no loop"
        if self.spec.drive is None:
            text += f"; the run-up takes {math.degrees(self.even_cam.phase_angle):.6g} deg of the cam"
        return Check("GL505", "profile-exists", "pass", text, shown, 0.0)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 outside the transition zone."""
        limit = self.spec.limits.pressure_angle
        for words, cam in self._judged(zone=True):
            value = math.degrees(cam.max_pressure_angle)
            text = f"the pressure angle of the {words} reaches {value:.6g} deg"
            if self.spec.drive is None:
                text += " outside the transition zone"
            if value > limit:
                text += f", above the limit {limit:g} deg: {self._pressure_remedy()}"
            yield Check("GL401", "pressure-angle", "fail" if value > limit else "pass", text, value, limit, "deg")

    def _pressure_remedy(self) -> str:
        repair = self.repaired_pressure
        if repair is None:
            keys = "cycle_angle and no swing" if self.spec.drive is None else "drive.crank and no swing"
            return f"no {keys} alone was found that keeps it; a twin-cam wants a swing near 2 acos(r/a)"
        if repair.value is None:
            return f"leave out {repair.path}"
        return f"make {repair.path} {repair.value:.12g}"

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402: roller against the curvature outside the transition zone, and against the source's (27)."""
        roller = self.section.roller_radius
        for words, cam in self._judged(zone=True):
            least = cam.min_curvature_radius
            share = roller / least
            status: Status = "fail" if share >= 1.0 else "warn" if share > 0.8 else "pass"
            text = (
                f"roller radius {roller:g} mm against the least curvature radius {least:.6g} mm of the {words} "
                "outside the transition zone"
            )
            if status != "pass":
                most = self.repaired_roller_for_curvature
                text += f": take a roller of at most {most:.12g} mm or a larger cam.center_distance"
            yield Check("GL402", "cam-undercut", status, text, share, 1.0)
        if self.spec.layout == "twin-rocker" and self.has_profile:
            yield from self._against_estimate(roller)

    def _against_estimate(self, roller: float) -> Iterator[Check]:
        """The source's own criterion of the internal profile: a warning, since its radius is an estimate."""
        estimate = self.middle_radius_estimate
        if roller >= estimate:
            text = (
                f"roller radius {roller:g} mm is not below the source's estimate {estimate:.6g} mm of the curvature "
                f"radius at mid-swing: to keep its rule take a roller of at most {safely_below(0.999 * estimate)} mm"
            )
            yield Check("GL402", "cam-undercut", "warn", text, roller / estimate, 1.0)

    def check_transition_zone(self) -> Iterator[Check]:
        """GL507: the contact changes sides within a small part of the stroke."""
        limit = self.spec.limits.transition_zone
        for words, cam in self._judged(zone=False):
            zone = cam.transition_zone
            text = f"the roller changes sides of the {words} over {zone:.4g} of the stroke each side of mid-swing"
            if zone > limit:
                text += (
                    f", above the limit {limit:g}: take a roller of at most "
                    f"{self.repaired_roller_radius:.12g} mm or a larger cam.center_distance"
                )
            yield Check("GL507", "transition-zone", "fail" if zone > limit else "pass", text, zone, limit)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: roller against the cam shaft, and the rocker's axis against the cam."""
        section = self.section
        if self.spec.drive is None:
            yield from self._over_rocker_axis()
        if section.shaft_radius == 0.0:
            return
        for words, cam in self.cams.items():
            room = cam.min_radius - section.roller_radius - section.shaft_radius
            text = (
                f"the roller of the {words} keeps {room:.4g} mm from the cam shaft (radius {section.shaft_radius:g} mm)"
            )
            if room <= 0.0:
                text = (
                    f"the roller of the {words} comes {-room:.4g} mm into the cam shaft (radius "
                    f"{section.shaft_radius:g} mm): make cam.center_distance at least "
                    f"{self.repaired_center_distance:.12g} mm, or the roller smaller"
                )
            yield Check("GL302", "shaft-clearance", "fail" if room <= 0.0 else "pass", text, room, 0.0, "mm")

    def _over_rocker_axis(self) -> Iterator[Check]:
        """The cam's arc about the dwells may reach over the rocker's axis: a warning, since it can be overhung."""
        place, roller = self.section.center_distance, self.section.roller_radius
        for words, cam in self.cams.items():
            sense = -1.0 if self.spec.layout == "twin-rocker" and cam is self.cam else 1.0
            room = sense * (place - cam.end_radius) + roller
            if room <= 0.0:
                text = (
                    f"the {words} reaches {-room:.4g} mm over the rocker's axis at the dwells: overhang the rocker "
                    "beside the cam, or reduce the swing"
                )
                yield Check("GL302", "shaft-clearance", "warn", text, room, 0.0, "mm")

    # Suggestions

    def suggestions(self) -> list[Suggestion]:
        """Changes of the design file that repair what fails or is refused, the first to be tried first.

        Returns
            suggestions : list of (path, value, why) - value None: leave the key out; each path once
        Notes
            In the order device, cyclogram, shaft, profile, pressure angle, roller, slider, drive. A change may bring
            up another finding: apply the first, and ask again.
        Source
            own derivation; the conditions are those of the wide-swing dissertation
        """
        found: dict[str, Suggestion] = {}
        for step in (
            self._repair_device,
            self._repair_combination,
            self._repair_cycle,
            self._repair_shaft,
            self._repair_profile,
            self._repair_pressure,
            self._repair_roller,
        ):
            try:
                suggestion = step()
            except NoSolution:
                # what is refused here has a step of its own
                continue
            if suggestion is not None:
                found.setdefault(suggestion.path, suggestion)
        return list(found.values())

    def _fails(self, name: str) -> bool:
        return any(check.status == "fail" for check in self.check(name))

    def _repair_device(self) -> Suggestion | None:
        least, ratio = self.usual_pivot_ratio, self.spec.unloader.pivot_ratio
        if ratio <= 1.0 or self._fails("unloader-turnability"):
            value = float(safely_above(least))
            return Suggestion("unloader.pivot_ratio", value, f"the device needs a pivot ratio of {least:.6g} or more")
        return None

    def _repair_combination(self) -> Suggestion | None:
        if self.spec.drive is not None:
            try:
                _ = self.drive
            except NoSolution:
                return self.repaired_drive()
        section = self.spec.slider
        if section is None:
            return None
        if section.rod <= section.crank + abs(section.offset):
            return Suggestion("slider.rod", self.repaired_slider_rod, "the rod must exceed crank plus offset")
        try:
            _ = self.slider_law.energy_parameter
        except NoSolution:
            return self.repaired_slider_angle()
        return None

    def _repair_cycle(self) -> Suggestion | None:
        if self._fails("cycle-angles"):
            return Suggestion("cycle_angle", 180.0, "both strokes must find room in one turn of the cam")
        return None

    def _repair_shaft(self) -> Suggestion | None:
        if self.spec.cam is not None and self._fails("shaft-clearance"):
            return Suggestion("cam.center_distance", self.repaired_center_distance, "a roller comes into the cam shaft")
        return None

    def _repair_profile(self) -> Suggestion | None:
        if self.spec.cam is None:
            return None
        try:
            cam = self.cam
        except NoSolution:
            if self.spec.layout != "twin-rocker":
                raise
            # a twin-rocker whose rocker is slower than its cam
            return Suggestion("cycle_angle", self.repaired_cycle_angle, "a twin-rocker must turn faster than its cam")
        return None if cam.loop_margin > 0.0 and self.has_profile else self.repaired_profile

    def _repair_pressure(self) -> Suggestion | None:
        if self.spec.cam is None or not self._fails("pressure-angle"):
            return None
        return self.repaired_pressure

    def _repair_roller(self) -> Suggestion | None:
        if self.spec.cam is None:
            return None
        values = []
        if self._fails("transition-zone"):
            values.append((self.repaired_roller_radius, "the contact changes sides over too much of the stroke"))
        if self._fails("cam-undercut"):
            values.append((self.repaired_roller_for_curvature, "the roller is too large for the pitch curve"))
        return Suggestion("cam.roller_radius", *min(values)) if values else None
