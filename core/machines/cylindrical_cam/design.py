"""A cylindrical cam: motion of its follower, pressure angle and walls of its track, exact in space."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import at_key
from gearlink.core.base.report import NO_NUMBER, Check, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.parts.cams.codes import CAM_UNDERCUT, PRESSURE_ANGLE
from gearlink.core.parts.cams.follower_design import FOLLOWER_QUANTITIES, OfFollower
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE

if TYPE_CHECKING:
    from collections.abc import Callable

    from gearlink.core.machines.cylindrical_cam.spec import CylindricalCamSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.parts.cams.drum import Drum
    from gearlink.core.parts.cams.follower_motion import FollowerMotion

_TRACK = ("max_pressure_angle", "pressure_angle_outside", "min_curvature_radius", "least_wall_factor")
_CHECKS = ("pressure-angle", "cam-undercut", "velocity-step", "acceleration-step", "jerk-step", *LAW_CHECKS)
_OUTLINE = Outline((*FOLLOWER_QUANTITIES, *_TRACK), _CHECKS, ("follower", "track"))
_FIT = 1e-9  # deg
_THIN = 0.2
_SAMPLES = 512


class CylindricalCamDesign(OfFollower, Design):
    """The drum of a design file; its axis is the direction of the lift."""

    kind = "cylindrical-cam"
    spec: CylindricalCamSpec
    keys = dict.fromkeys(
        ("cam", "analyze"),
        (
            "lift_max",
            ("max_pressure_angle", "<limits.pressure_angle"),
            "pressure_angle_outside",
            "min_curvature_radius",
            "least_wall_factor",
            "follower_velocity_max",
            "follower_acceleration_max",
            "velocity_max",
            "acceleration_max",
        ),
    )
    outlines = {"cam": _OUTLINE, "analyze": _OUTLINE}
    extra_tables = ("walls", LAW_TABLE)
    advises = False

    @cached_property
    def follower_motion(self) -> FollowerMotion:
        """Lift over the cam angle [mm]."""
        from gearlink.core.parts.cams.follower_motion import motion_of

        with at_key("motion"):
            return motion_of(self.spec.motion, self.spec.initial_lift, spec=self.spec)

    @cached_property
    def drum(self) -> Drum:
        """The track."""
        from gearlink.core.parts.cams.drum import Drum

        cam = self.spec.cam
        return Drum(
            self.follower_motion, cam.radius, cam.radius - cam.depth, self.spec.follower.roller_radius, cam.sense
        )

    @property
    def _radii(self) -> tuple[float, float]:
        return self.drum.bottom, self.drum.outside

    def _most(self, course: Callable[[Reals], Reals]) -> Extreme:
        from gearlink.core.numerics.extremes import maximum_over

        return maximum_over(course, joints=self.follower_motion.joints, samples=_SAMPLES)

    @cached_property
    def steepest(self) -> Extreme:
        """Maximum magnitude of the pressure angle, at the bottom of the track [rad], and its cam angle."""
        return self._most(lambda phi: abs(self.drum.pressure_angle(self.drum.bottom, phi)))

    max_pressure_angle: float = placed("steepest.value")

    @cached_property
    def pressure_angle_outside(self) -> float:
        """Maximum magnitude of the pressure angle at the outside of the drum [rad]."""
        return self._most(lambda phi: abs(self.drum.pressure_angle(self.drum.outside, phi))).value

    @cached_property
    def min_curvature_radius(self) -> float:
        """Minimum radius of the developed pitch curve, of either sense, over both radii [mm]."""
        bend = max(self._most(lambda phi, x=x: abs(self.drum.curvature(x, phi))).value for x in self._radii)  # type: ignore[misc]
        return 1.0 / bend if bend > 0.0 else math.inf

    @cached_property
    def thinnest(self) -> Extreme:
        """Minimum wall factor over both walls and both radii, and its cam angle [rad]."""
        found = [
            self._most(lambda phi, x=x, side=side: -self.drum.wall_factor(x, side, phi))  # type: ignore[misc]
            for x in self._radii
            for side in (1, -1)
        ]
        worst = max(found, key=lambda each: each.value)
        return worst._replace(value=-worst.value)

    least_wall_factor: float = placed("thinnest.value")

    def table_track(self, samples: int | None = None) -> Table:
        """Pitch line and both walls, developed at the outside and at the bottom, with the pressure angles there."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        phi, columns = np.radians(degrees), {"cam_angle": (degrees, "deg")}
        for name, x in (("outside", self.drum.outside), ("bottom", self.drum.bottom)):
            columns[f"{name}_pressure_angle"] = np.degrees(self.drum.pressure_angle(x, phi)), "deg"
            for wall, side in (("pitch", 0), ("upper", 1), ("lower", -1)):
                arc, along = self.drum.developed(x, side, phi)
                columns |= {f"{name}_{wall}_arc": (arc, "mm"), f"{name}_{wall}": (along, "mm")}
        return Table.of("track", columns)

    def table_walls(self, samples: int | None = None) -> Table:
        """Points of both walls in space at the outside and at the bottom, in the cam's frame, its axis along z."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        phi, columns = np.radians(degrees), {"cam_angle": (degrees, "deg")}
        for name, x in (("outside", self.drum.outside), ("bottom", self.drum.bottom)):
            for wall, side in (("upper", 1), ("lower", -1)):
                points = self.drum.wall(x, side * self.drum.sense, phi)
                columns |= {f"{name}_{wall}_{axis}": (place, "mm") for axis, place in zip("xyz", points, strict=True)}
        return Table.of("walls", columns)

    def check_pressure_angle(self) -> Check:
        """GL401, at the bottom of the track."""
        value, limit = math.degrees(self.steepest.value), self.spec.limits.pressure_angle
        over = value > limit + _FIT
        what, fix = "pressure angle at the bottom of the track", "enlarge the drum, or give the motion more cam angle"
        at = f"cam angle {short(math.degrees(self.steepest.place))} deg"
        return PRESSURE_ANGLE.check("fail" if over else "pass", what, value, limit, "deg", at=at, fix=fix)

    def check_cam_undercut(self) -> Check:
        """GL402: a wall is regular where its factor is positive."""
        value, place = self.thinnest
        status: Status = "fail" if value <= 0.0 else "warn" if value < _THIN else "pass"
        what, at = "minimum wall factor", f"cam angle {short(math.degrees(place))} deg"
        shown = None
        if value < 0.0:
            what, shown = "the wall of the track is undercut", NO_NUMBER
        fix = "take a smaller roller, or enlarge the drum"
        return CAM_UNDERCUT.check(status, what, value, 0.0, side=">=", shown=shown, recommended=_THIN, at=at, fix=fix)
