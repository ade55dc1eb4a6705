"""A measured cam: how well the series fits, the motion of its follower, and the laws that it seems to be made of."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.machines.measured_cam.phases import MeasuredPhase
    from gearlink.core.machines.measured_cam.profile import MeasuredCam
    from gearlink.core.machines.measured_cam.spec import MeasuredCamSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme

_TURN = 2.0 * math.pi
QUANTITIES = (
    "swing",
    "stroke",
    "fit_rms",
    "fit_max",
    "fit_harmonics",
    "min_curvature_radius",
    "min_curvature_radius_at",
    "max_pressure_angle",
    "max_pressure_angle_at",
    "follower_velocity_max",
    "follower_acceleration_max",
)
_OSCILLATING = ("swing",)
_TRANSLATING = ("stroke", "follower_velocity_max", "follower_acceleration_max")


class MeasuredCamDesign(Design):
    """A follower on a cam whose profile was measured."""

    kind = "measured-cam"
    spec: MeasuredCamSpec
    keys = {
        "analyze": (
            "swing",
            "stroke",
            "fit_rms",
            "fit_max",
            "max_pressure_angle",
            "min_curvature_radius",
        ),
    }
    outlines = {"analyze": Outline(QUANTITIES, (), ("law", "phases"))}
    extra_tables = ("profile_fit",)
    advises = False

    def outline(self, command: str) -> Outline:
        """What this follower has."""
        found = super().outline(command)
        absent = _OSCILLATING if not self._oscillates else _TRANSLATING
        if self.spec.speed is None:
            absent = (*absent, *_TRANSLATING[1:])
        return found._replace(quantities=tuple(name for name in found.quantities if name not in absent))

    @property
    def _oscillates(self) -> bool:
        return self.spec.follower.type == "oscillating"

    @cached_property
    def points(self) -> tuple[Reals, Reals]:
        """Angles [rad] and radii [mm] of the measured profile."""
        from gearlink.core.machines.measured_cam.profile import places

        return places(self.spec.profile.points or ())

    @cached_property
    def cam(self) -> MeasuredCam:
        """Series and follower."""
        from gearlink.core.machines.measured_cam.profile import MeasuredCam, Series

        spec, follower = self.spec, self.spec.follower
        series = Series.fitted(*self.points, spec.order)
        if follower.type == "oscillating":
            pivot = complex(*follower.pivot)
            return MeasuredCam(series, spec.roller_radius, spec.sense, pivot, follower.arm, follower.side)
        direction = cmath.rect(1.0, math.radians(follower.direction))
        return MeasuredCam(series, spec.roller_radius, spec.sense, direction=direction, offset=follower.offset)

    # Quantities

    @cached_property
    def residuals(self) -> Reals:
        """Measured radii less those of the series [mm]."""
        t, radius = self.points
        found: Reals = radius - self.cam.series.at(t, 0)[0]
        return found

    @property
    def fit_rms(self) -> float:
        """Root of the mean square of what the series leaves [mm]."""
        return math.sqrt(float((self.residuals**2).mean()))

    @property
    def fit_max(self) -> float:
        """Maximum of it [mm]."""
        return float(abs(self.residuals).max())

    @property
    def fit_harmonics(self) -> int:
        """Harmonics of the series."""
        return self.spec.order

    @cached_property
    def _range(self) -> tuple[float, float]:
        """Minimum and maximum coordinate of the follower [rad or mm]."""
        from gearlink.core.numerics.extremes import maximum_over, minimum_over

        self.require_runs()

        def value(t: Reals) -> Reals:
            return self.cam.follower(t).value[0]

        return minimum_over(value, samples=self._samples).value, maximum_over(value, samples=self._samples).value

    @property
    def _samples(self) -> int:
        return 16 * self.spec.order + 512

    def require_runs(self) -> None:
        """Refuse a profile along which the cam angle turns back."""
        import numpy as np

        self.cam.at_cam_angle(np.zeros(1))

    @property
    def swing(self) -> float | None:
        """Swing of an oscillating follower [rad]."""
        return self._range[1] - self._range[0] if self._oscillates else None

    @property
    def stroke(self) -> float | None:
        """Stroke of a translating follower [mm]."""
        return None if self._oscillates else self._range[1] - self._range[0]

    @cached_property
    def _sharpest(self) -> Extreme:
        from gearlink.core.numerics.extremes import least_convex_radius

        self.require_runs()
        return least_convex_radius(self.cam.curvature, samples=self._samples)

    @cached_property
    def _steepest(self) -> Extreme:
        from gearlink.core.numerics.extremes import maximum_over

        self.require_runs()
        return maximum_over(self.cam.pressure_angle, samples=self._samples)

    @property
    def min_curvature_radius(self) -> float | None:
        """Minimum convex radius of the pitch curve [mm]; None where it is convex nowhere."""
        return self._sharpest.value if math.isfinite(self._sharpest.value) else None

    @property
    def min_curvature_radius_at(self) -> float:
        """Cam angle of it [rad]."""
        return self._cam_angle(self._sharpest.place)

    @property
    def max_pressure_angle(self) -> float:
        """Maximum pressure angle [rad]."""
        return self._steepest.value

    @property
    def max_pressure_angle_at(self) -> float:
        """Cam angle of it [rad]."""
        return self._cam_angle(self._steepest.place)

    def _cam_angle(self, t: float) -> float:
        import numpy as np

        return float(np.mod(self.cam.follower(np.array([t])).cam_angle[0][0], _TURN))

    @property
    def _speed(self) -> float | None:
        return None if self.spec.speed is None or self._oscillates else self.spec.speed * math.pi / 30.0

    @property
    def follower_velocity_max(self) -> float | None:
        """Maximum velocity of a translating follower [mm/s]."""
        return None if self._speed is None else self._speed * self._greatest(1)

    @property
    def follower_acceleration_max(self) -> float | None:
        """Maximum acceleration of it [mm/s^2]."""
        return None if self._speed is None else self._speed**2 * self._greatest(2)

    def _greatest(self, order: int) -> float:
        from gearlink.core.numerics.extremes import maximum_over

        return maximum_over(lambda phi: abs(self.cam.motion(phi)[order]), samples=self._samples).value

    @cached_property
    def phases(self) -> list[MeasuredPhase]:
        """Dwells and strokes."""
        import numpy as np

        from gearlink.core.machines.measured_cam.phases import ROWS, phases_of

        value = self.cam.motion(np.linspace(0.0, _TURN, ROWS, endpoint=False))[0]
        tolerance = self.spec.dwell_tolerance
        return phases_of(value, math.radians(tolerance) if self._oscillates else tolerance)

    # Tables

    def table_law(self, samples: int | None = None) -> Table:
        """The follower over the cam angle, and what the series leaves of the points that touch it there."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        phi = np.asarray(np.radians(degrees), dtype=np.float64)
        value, speed, acceleration = self.cam.motion(phi)
        if self._oscillates:
            columns = {"cam_angle": (degrees, "deg"), "follower_angle": (np.degrees(value), "deg")}
            units = ("rad/rad", "rad/rad^2")
        else:
            columns = {"cam_angle": (degrees, "deg"), "lift": (value - self._range[0], "mm")}
            units = ("mm/rad", "mm/rad^2")
        t, left = self.points[0], self.residuals
        residual = np.interp(np.mod(self.cam.at_cam_angle(phi), _TURN), np.mod(t, _TURN), left, period=_TURN)
        columns |= {
            "velocity": (speed, units[0]),
            "acceleration": (acceleration, units[1]),
            "residual": (residual, "mm"),
        }
        return Table.of("law", columns)

    def table_phases(self, _samples: int | None = None) -> Table:
        """Dwells and strokes over the cam angle, with the law that comes nearest to each stroke."""
        unit = "deg" if self._oscillates else "mm"
        scale = math.degrees(1.0) if self._oscillates else 1.0
        columns: dict[str, tuple[list[Any], str]] = {
            "start": ([math.degrees(each.start) for each in self.phases], "deg"),
            "end": ([math.degrees(each.end) for each in self.phases], "deg"),
            "motion": ([each.motion for each in self.phases], "1"),
            "law": ([each.law for each in self.phases], "1"),
            "deviation": ([scale * each.deviation for each in self.phases], unit),
        }
        return Table.of("phases", columns)

    def table_profile_fit(self, _samples: int | None = None) -> Table:
        """The points, the series at their angles, and the difference."""
        import numpy as np

        t, radius = self.points
        columns = {
            "profile_angle": (np.degrees(t), "deg"),
            "radius": (radius, "mm"),
            "fitted_radius": (radius - self.residuals, "mm"),
            "residual": (self.residuals, "mm"),
        }
        return Table.of("profile_fit", columns)
