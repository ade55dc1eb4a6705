"""The whole cycle of a wide-swing mechanism: working stroke, far dwell, return stroke, near dwell, and its cams."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import at_key
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.machines.wide_swing.cams.closed_cam import ClosedCam

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.numerics.arrays import Points, Reals

PHASES = ("working", "far-dwell", "return", "near-dwell")


class WholeCycle:
    """Both closed contours over one revolution, from the design; every result is computed when it is read."""

    def __init__(self, design: WideSwingDesign) -> None:
        self.design = design
        self.angles = design.motion.cycle_angles
        self.external_working = design.spec.layout != "twin-rocker"

    @cached_property
    def main(self) -> ClosedCam:
        """The cam that guides the working stroke."""
        _, far, back, _ = self.angles
        with at_key("cycle.working"):
            return ClosedCam(self.design.even_cam, far, back, self.design.section.free_clearance)

    @cached_property
    def back(self) -> ClosedCam:
        """The cam that guides the return stroke, in its own frame."""
        working, _, _, near = self.angles
        with at_key("cycle.return"):
            cam = self.design.return_cam or self.design.even_cam
            return ClosedCam(cam, near, working, self.design.section.free_clearance)

    @property
    def contours(self) -> dict[str, ClosedCam]:
        """Both cams by the words that a message calls them."""
        words = ("cam", "return cam") if self.external_working else ("internal profile", "external profile")
        return dict(zip(words, (self.main, self.back), strict=True))

    # Sectors

    @property
    def sectors_external(self) -> tuple[float, ...]:
        """Driven profile, arc, free sector, arc of the external profile [rad]; a twin-cam's of its working stroke."""
        return self.main.sectors if self.external_working else self.back.sectors

    @property
    def sectors_internal(self) -> tuple[float, ...] | None:
        """The same of a twin-rocker's internal profile."""
        return None if self.external_working else self.main.sectors

    @property
    def sectors_return(self) -> tuple[float, ...] | None:
        """The same of a twin-cam's second cam."""
        return self.back.sectors if self.external_working else None

    @property
    def longer_stroke_reserve(self) -> float | None:
        """Force to spare in the longer stroke over what balances it, (1 + rho)(longer/shorter)^2 - 1; None where both
        are as long."""
        working, _, back, _ = self.angles
        if working == back:
            return None
        ratio = max(working, back) / min(working, back)
        return (1.0 + self.design.unloading.size.reserve) * ratio**2 - 1.0

    @property
    def plane_room(self) -> float | None:
        """Room between the bodies of a twin-rocker's two profiles during the rests, as if in one plane [mm]."""
        if self.external_working:
            return None
        rollers = self.main.cam.roller_radius + self.back.cam.roller_radius
        return self.main.rest_radius - self.back.rest_radius - rollers

    # In the cams' frames

    def of_main(self, points: Points) -> Points:
        """Points of the working stroke's cam in the frame of the table `main_cam`."""
        return points if self.external_working else -points.conj()

    def of_back(self, points: Points) -> Points:
        """Points of the return stroke's cam: on the twin-rocker's one body, in the frame of its internal profile."""
        if self.external_working:
            return points.conj()
        working, far, back, _ = self.angles
        turned: Points = points.conj() * cmath.exp(-1j * (math.pi + 0.5 * working + far + 0.5 * back))
        return turned

    # Tables

    def table(self, samples: int | None = None) -> Table:
        """Both contours over one turn of the cam; empty where the roller at mid-swing has cut the profile away."""
        import numpy as np

        count = samples or 360
        rows = row_numbers(samples, count)
        t = 2.0 * math.pi * np.arange(rows.start, rows.stop) / count
        late = np.mod(t - self.angles[0] - self.angles[1], 2.0 * math.pi)
        sector, swing = self.main.sector_at(t), self.design.motion.swing
        law = self.design.motion.law
        angle = (law.invariants(self.main.swing_share(t), 0)[0] - 0.5) * swing
        columns: dict[str, tuple[Any, str]] = {
            "cam_angle": (np.degrees(t), "deg"),
            "phase": ([PHASES[i] for i in sector], "1"),
            "rocker_angle": (np.degrees(angle), "deg"),
            **_columns("", self.main, t, self.of_main),
            **_columns("return_", self.back, late, self.of_back),
        }
        return Table.of("contour", columns)

    def joints(self) -> Table:
        """The joints of both contours: place, radii, and how tangent and curvature go over."""
        rows = [
            (words, PHASES[(i + 2 * late) % 4], joint)
            for late, (words, cam) in enumerate(self.contours.items())
            for i, joint in enumerate(cam.joints)
        ]
        start = self.angles[0] + self.angles[1]
        places = [joint.cam_angle + (start if late >= 4 else 0.0) for late, (*_, joint) in enumerate(rows)]
        columns: dict[str, tuple[Any, str]] = {
            "cam": ([words for words, *_ in rows], "1"),
            "start_of": ([phase for _, phase, _ in rows], "1"),
            "cam_angle": ([math.degrees(place) % 360.0 for place in places], "deg"),
            "radius": ([joint.radius for *_, joint in rows], "mm"),
            "tangent_step": ([math.degrees(joint.tangent_step) for *_, joint in rows], "deg"),
            "curvature_radius_before": ([joint.before for *_, joint in rows], "mm"),
            "curvature_radius_after": ([joint.after for *_, joint in rows], "mm"),
        }
        return Table.of("joints", columns)


def _columns(prefix: str, cam: ClosedCam, t: Reals, frame: Callable[[Points], Points]) -> dict[str, tuple[Reals, str]]:
    import numpy as np

    start, end = cam.slot
    k = cam.swing_share(t)
    gone = (cam.sector_at(t) == 0) & (k > start) & (k < end)
    pitch, contour = frame(cam.pitch(t)), frame(cam.contour(t))
    return {
        f"{prefix}pitch_x": (pitch.real, "mm"),
        f"{prefix}pitch_y": (pitch.imag, "mm"),
        f"{prefix}x": (np.where(gone, np.nan, contour.real), "mm"),
        f"{prefix}y": (np.where(gone, np.nan, contour.imag), "mm"),
    }
