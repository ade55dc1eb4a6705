"""The cams of a wide-swing mechanism, from its design file: quantities and points."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.report import Table
from gearlink.core.results import cached_property
from gearlink.core.wide_swing.design_law import WideSwingLaw

if TYPE_CHECKING:
    from gearlink.core.wide_swing.cam import Layout, WideSwingCam
    from gearlink.core.wide_swing.oscillating_cam import OscillatingCam
    from gearlink.core.wide_swing.spec import SwingCam

_OF_CAM = (
    "rocker_radius",
    "min_radius",
    "max_radius",
    "profile_correction",
    "largest_profile_correction",
    "phase_angle",
    "start_curvature_radius",
    "transition_zone",
    "max_pressure_angle",
    "min_curvature_radius",
    "middle_pressure_angle",
)
OF_EVEN_CAM = ("profile_correction", "largest_profile_correction", "phase_angle", "start_curvature_radius")
NEED_PROFILE = ("start_radius_estimate", "middle_radius_estimate")
NEED_ZONE = ("transition_zone", "max_pressure_angle", "min_curvature_radius", "contact_end")


class WideSwingProfile(WideSwingLaw):
    """The rocker with the cams that guide it."""

    @property
    def section(self) -> SwingCam:
        """The section `cam` of the design file."""
        if self.spec.cam is None:
            raise MissingSection("this needs the section cam: center_distance, roller_radius", key="cam")
        return self.spec.cam

    @property
    def profile_key(self) -> str:
        """The key to change where the profile does not exist."""
        if self.spec.drive is not None:
            return "drive"
        return "cycle_angle" if self.section.rocker_radius is None else "cam.rocker_radius"

    @cached_property
    def cam(self) -> WideSwingCam | OscillatingCam:
        """The cam of the working stroke."""
        return self.even_cam if self.spec.drive is None else self.oscillating_cam

    @cached_property
    def even_cam(self) -> WideSwingCam:
        """The cam of the working stroke, turning evenly."""
        if self.spec.drive is not None:
            raise NoSolution("this is a result of a cam that turns evenly: leave out drive", key="drive")
        return self._even(self.spec.layout, self.section.rocker_radius)

    @cached_property
    def return_cam(self) -> WideSwingCam | None:
        """A return cam of another shape: the external profile of the twin-rocker."""
        return self._even("twin-cam", None) if self.spec.layout == "twin-rocker" else None

    @cached_property
    def oscillating_cam(self) -> OscillatingCam:
        """The cam on the rocker of a crank-rocker."""
        from gearlink.core.wide_swing.oscillating_cam import OscillatingCam

        section, law, drive = self.section, self.plain_law, self.drive
        with at_key("drive"):
            return OscillatingCam(drive, law, section.center_distance, section.roller_radius)

    def _even(self, layout: Layout, rocker_radius: float | None) -> WideSwingCam:
        from gearlink.core.wide_swing.cam import WideSwingCam

        section, law = self.section, self.plain_law
        with at_key("cycle_angle"):
            return WideSwingCam(
                layout, law, self.cycle_angle, section.center_distance, section.roller_radius, rocker_radius
            )

    @property
    def cams(self) -> dict[str, WideSwingCam | OscillatingCam]:
        """The cams that are checked, by the words that a message calls them."""
        if self.return_cam is None:
            return {"cam": self.cam}
        return {"internal profile": self.cam, "external profile": self.return_cam}

    @cached_property
    def has_profile(self) -> bool:
        """Whether the pitch curve of the working stroke is free of loops."""
        try:
            self.cam.require_profile()
        except NoSolution:
            return False
        return True

    def has_zone(self, cam: WideSwingCam | OscillatingCam) -> bool:
        """Whether a cam has a profile outside the transition zone, so that it can be judged there."""
        from gearlink.core.wide_swing.oscillating_cam import REST_SHARE

        if cam is self.cam and not self.has_profile:
            return False
        return cam.transition_zone < 0.5 - REST_SHARE

    @property
    def cam_swing(self) -> float:
        """Swing of an oscillating cam [rad]."""
        return self.drive.swing

    @property
    def crank_span(self) -> float:
        """Crank angle of the stroke between the dead centres [rad]."""
        return self.drive.crank_span

    @cached_property
    def start_radius_estimate(self) -> float:
        """R of (23) [mm]."""
        from gearlink.core.wide_swing.contact import start_radius_estimate

        with at_key(self.profile_key):
            return start_radius_estimate(self.even_cam)

    @cached_property
    def middle_radius_estimate(self) -> float:
        """R of (27) [mm]."""
        from gearlink.core.wide_swing.contact import middle_radius_estimate

        with at_key(self.profile_key):
            return middle_radius_estimate(self.even_cam)

    @property
    def contact_end(self) -> float:
        """k at which the roller leaves the profile."""
        return self.slot_of(self.cam)[0]

    def slot_of(self, cam: WideSwingCam | OscillatingCam) -> tuple[float, float]:
        """Fractions of the stroke between which a cam's profile is cut away."""
        from gearlink.core.wide_swing.cam import WideSwingCam
        from gearlink.core.wide_swing.contact import contact_end

        self._require_profile(cam)
        with at_key("cam.roller_radius"):
            if isinstance(cam, WideSwingCam):
                end = contact_end(cam)
                return end, 1.0 - end
            return cam.slot()

    def _require_profile(self, cam: WideSwingCam | OscillatingCam) -> None:
        with at_key(self.profile_key):
            cam.require_profile()

    def raw(self, name: str) -> Any:
        """Profile quantities are the cam's; those that do not exist say which key to change."""
        if name not in _OF_CAM:
            return getattr(self, name)
        if name in NEED_ZONE:
            self._require_profile(self.cam)
        if name == "middle_pressure_angle":
            return self.oscillating_cam.middle_pressure_angle
        source = self.even_cam if name in OF_EVEN_CAM else self.cam
        with at_key("cam.roller_radius"):
            value = getattr(source, name)
        return None if isinstance(value, float) and math.isinf(value) else value

    # Tables

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The cam of the working stroke; where the slot at mid-swing cuts the profile away, x and y are empty."""
        return self._cam_table("main_cam", self.cam, 1.0, samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The cam of the return stroke: the mirror image (twin-cam), or the external profile of the twin-rocker."""
        if self.return_cam is None:
            return self._cam_table("return_cam", self.even_cam, -1.0, samples)
        return self._cam_table("return_cam", self.return_cam, 1.0, samples)

    def _cam_table(self, name: str, cam: WideSwingCam | OscillatingCam, mirror: float, samples: int | None) -> Table:
        import numpy as np

        start, end = self.slot_of(cam)
        points = cam.points(self._k(samples))
        gone = (points.k > start) & (points.k < end)
        columns = {
            "k": (points.k, "1"),
            "cam_angle": (np.degrees(points.cam_angle), "deg"),
            "pitch_x": (points.pitch.real, "mm"),
            "pitch_y": (mirror * points.pitch.imag, "mm"),
            "x": (np.where(gone, np.nan, points.profile.real), "mm"),
            "y": (np.where(gone, np.nan, mirror * points.profile.imag), "mm"),
            "pressure_angle": (np.degrees(points.pressure_angle), "deg"),
            "curvature_radius": (points.curvature_radius, "mm"),
        }
        return Table.of(name, columns)
