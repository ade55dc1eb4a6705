"""The handover of a swing gripper: speed, place and release window, mixed into its design class."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.report import Check, Status, Table, safely_above, safely_below
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.base import GripperBase

if TYPE_CHECKING:
    from gearlink.core.swing_gripper.handover_geometry import TipPath
    from gearlink.core.swing_gripper.spec import Release

# Share of the surface speed that the two may differ by: rounding only.
_SPEED_SHARE = 1e-9
_WINDOW = 6.0
_ROWS = 41


class GripperHandover(GripperBase):
    """The handover of the design: results, table and checks."""

    @cached_property
    def handover_speed(self) -> float:
        """Speed of the gripper tip at the handover [mm/s]."""
        return self.spec.arm.length * self._at_handover[1] * self.shaft_speed

    @cached_property
    def handover_mismatch(self) -> float:
        """Speed of the tip less that of the cylinder's surface [mm/s]."""
        return self.handover_speed - self.spec.cylinder.radius * self.shaft_speed

    @cached_property
    def _at_handover(self) -> tuple[float, float]:
        """Swing angle [rad] and its rate by the cylinder angle at the handover."""
        import numpy as np

        beta, rate = self.law.evaluate(np.array([self.spec.handover]), 1)
        return float(beta[0]), float(rate[0])

    @cached_property
    def _tip(self) -> complex:
        """The gripper tip at the handover [mm]."""
        arm = self.spec.arm
        direction = math.radians(arm.direction) + self.spec.swing_sense * self._at_handover[0]
        return complex(*self.spec.pivots.output) + cmath.rect(arm.length, direction)

    @cached_property
    def handover_center(self) -> complex:
        """Axis of a cylinder whose pitch circle the tip meets on the line of centres at the handover [mm]."""
        from gearlink.core.swing_gripper.positions import drum_center

        return drum_center(complex(*self.spec.pivots.output), self._tip, self.spec.cylinder.radius)

    def _path(self, degrees: Any) -> tuple[Any, Any, TipPath]:
        """Lead of the arm on the line of centres [rad], tip speed [mm/s] and path of the tip at cylinder angles."""
        import numpy as np

        from gearlink.core.swing_gripper.handover_geometry import tip_path

        arm, radius = self.spec.arm.length, self.spec.cylinder.radius
        distance, lead_0 = arm + radius, 0.0
        if self.spec.cylinder.center is not None:
            pivot = complex(*self.spec.pivots.output)
            line = complex(*self.spec.cylinder.center) - pivot
            distance = abs(line)
            lead_0 = self.spec.swing_sense * cmath.phase((self._tip - pivot) / line)
        beta, rate = self.law.evaluate(np.fmod(degrees + 360.0, 360.0), 1)
        lead = lead_0 + beta - self._at_handover[0]
        turned = np.radians(degrees - self.spec.handover)
        return lead, arm * rate * self.shaft_speed, tip_path(arm, radius, distance, lead, turned, lead_0)

    def table_handover_window(self, _samples: int | None = None) -> Table:
        """Gap of the tip to the pitch circle, slip and speed difference round the handover."""
        import numpy as np

        from gearlink.core.swing_gripper.handover_geometry import speed_difference

        half = self.spec.release.window if self.spec.release is not None else _WINDOW
        degrees = self.spec.handover + half * np.linspace(-1.0, 1.0, _ROWS)
        lead, speed, path = self._path(degrees)
        difference = speed_difference(path, lead, speed, self.shaft_speed, self.spec.cylinder.radius)
        columns = {
            "theta": (degrees, "deg"),
            "arm_lead": (np.degrees(lead), "deg"),
            "gap": (path.gap, "mm"),
            "slip": (path.slip, "mm"),
            "speed_difference": (difference, "mm/s"),
        }
        return Table.of("handover_window", columns)

    # Checks

    def check_handover(self) -> Iterator[Check]:
        """GL503: speed, place and release window."""
        yield self._speed_check()
        if self.spec.cylinder.center is not None:
            yield self._place_check(complex(*self.spec.cylinder.center))
        if self.spec.release is not None:
            yield self._inside_check(self.spec.release)
            yield self._gap_check(self.spec.release)

    def _speed_check(self) -> Check:
        mismatch, speed = self.handover_mismatch, self.spec.cylinder.radius * self.shaft_speed
        share = abs(mismatch) / speed
        status: Status = "fail" if share > _SPEED_SHARE else "pass"
        text = f"gripper and cylinder run at {speed:.6g} mm/s at the handover, mismatch {mismatch:.2g} mm/s"
        if status == "fail":
            start, end = self.law.starts[1:3]
            text += f": set handover to {0.5 * (start + end):g}, the middle of the constant phase"
        return Check("GL503", "handover", status, text, share, _SPEED_SHARE)

    def _place_check(self, center: complex) -> Check:
        from gearlink.core.swing_gripper.handover_geometry import misplacement

        limit = self.spec.limits.handover_place
        off = misplacement(complex(*self.spec.pivots.output), self._tip, center, self.spec.cylinder.radius)
        status: Status = "fail" if off.place > limit else "pass"
        text = f"the gripper tip stands {off.place:.4g} mm off its place on the line of centres at the handover"
        if status == "fail":
            fits = self.handover_center
            changes = [f"turn arm.direction by {math.degrees(off.turn):+.6g} deg"]
            if abs(off.distance) > limit:
                changes.append(f"change arm.length by {off.distance:+.6g} mm (the speeds then differ)")
            text += (
                f", above the limit {limit:g} mm: {' and '.join(changes)}, or set cylinder.center to "
                f"[{fits.real:.6g}, {fits.imag:.6g}]"
            )
        return Check("GL503", "handover", status, text, off.place, limit, "mm")

    def _inside_check(self, release: Release) -> Check:
        start, end = self.law.starts[1:3]
        room = min(self.spec.handover - start, end - self.spec.handover)
        status: Status = "warn" if release.window > room else "pass"
        text = (
            f"gripper and cylinder run at one speed for {room:g} deg to either side of the handover; the sheet changes "
            f"over within {release.window:g} deg, {release.window / 360.0 * 3.6e6 / self.spec.speed:.4g} ms"
        )
        if status == "warn":
            text += (
                f": set phases.constant to at least {2.0 * release.window:g} deg with the handover in its middle, or "
                f"release.window to at most {safely_below(room) if room else 'its'} deg"
            )
        return Check("GL503", "handover", status, text, release.window, room, "deg")

    def _gap_check(self, release: Release) -> Check:
        import numpy as np

        from gearlink.core.swing_gripper.handover_geometry import widest_window

        degrees = self.spec.handover + release.window * np.array([-1.0, 0.0, 1.0])
        _, _, path = self._path(degrees)
        gap, slip = float(np.abs(path.gap).max()), float(np.abs(path.slip).max())
        status: Status = "warn" if gap > release.gap else "pass"
        text = (
            f"the tip leaves the pitch circle by {gap:.4g} mm and slips by {slip:.2g} mm within {release.window:g} deg "
            "of the handover"
        )
        if status == "warn":
            widest = widest_window(self.spec.arm.length, self.spec.cylinder.radius, release.gap)
            text += (
                f", above release.gap {release.gap:g} mm: set release.window to at most "
                f"{safely_below(math.degrees(widest), 4)} deg, or allow a gap of {safely_above(gap, 3)} mm"
            )
        return Check("GL503", "handover", status, text, gap, release.gap, "mm")
