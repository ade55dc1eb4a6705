"""A measured cam: how well the series fits, the motion of its follower, and the laws that it seems to be made of.

With that motion it is a disc cam: figure, film, loads, tolerances and export are those of one.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Outline
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.machines.disc_cam.cams import FollowerCams, Place
from gearlink.core.machines.disc_cam.design import DiscCamDesign
from gearlink.core.parts.cams.follower_motion import Stroke

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.measured_profile import MeasuredCam, MeasuredPhase
    from gearlink.core.machines.disc_cam.measured_spec import MeasuredCamSpec
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
    "pressure_angle_rise",
    "pressure_angle_return",
    "prime_radius",
    "max_radius",
    "min_radius",
    "follower_velocity_max",
    "follower_acceleration_max",
    "spring_preload",
    "lift_off_speed",
)
_CHECKS = ("pressure-angle", "cam-undercut", "shaft-clearance", "outer-wall", "lift-off")
_SENSES = {"rise": 1, "dwell": 0, "return": -1}


class MeasuredMotion:
    """The lift over a revolution of the cam, as that of a disc cam, to its second derivative.

    Parameters
        cam : MeasuredCam
        least : float [rad or mm] - minimum coordinate of the follower, outward
        phases : dwells and strokes
    """

    joints: tuple[float, ...] = ()
    highest = 2
    """Points of a profile have no third derivative that means something."""

    def __init__(self, cam: MeasuredCam, least: float, phases: list[MeasuredPhase]) -> None:
        self.cam, self.least, self._phases = cam, least, phases

    def evaluate(self, phi: Reals, order: int = 2, *, side: int = 1) -> list[Reals]:
        """Lift and its derivatives by the cam angle [mm or rad]; `side` is for laws that jump."""
        del side
        value, *rates = self.cam.motion(phi)
        sense = self.cam.outward_sense
        return [self.cam.outward(value) - self.least, *(sense * rate for rate in rates)][: order + 1]

    @cached_property
    def strokes(self) -> tuple[Stroke, ...]:
        """Where the lift rises, falls and stands; what runs over the end of the revolution in two parts.

        Notes
            The ends of the phases are fitted and may miss each other a little: strokes meet in the middle of that.
        """
        phases, found = self._phases, []
        apart = [(after.start - before.end + math.pi) % _TURN - math.pi for before, after in _round(phases)]
        for k, each in enumerate(phases):
            begin, end = each.start - 0.5 * apart[k - 1], each.end + 0.5 * apart[k]
            sense = _SENSES[each.motion] * round(self.cam.outward_sense)
            for off in (-_TURN, 0.0, _TURN):
                low, high = max(begin + off, 0.0), min(end + off, _TURN)
                if high > low:
                    found.append(Stroke(low, high, sense))
        return tuple(sorted(found))


def _round(phases: list[MeasuredPhase]) -> list[tuple[MeasuredPhase, MeasuredPhase]]:
    """Each phase and the one after it, over the end of the revolution."""
    return list(zip(phases, [*phases[1:], *phases[:1]], strict=True))


class MeasuredCams(FollowerCams):
    """Motion, place and cam of a measured profile."""

    spec: Any

    def __init__(self, design: MeasuredCamDesign) -> None:
        self.design, self.spec, self.sense = design, design.spec, design.spec.sense
        self.follower = design.spec.disc_follower

    @cached_property
    def motion(self) -> Any:
        """Lift over the cam angle [mm or rad]."""
        design = self.design
        least = min(design.cam.outward(value) for value in design.ends)
        return MeasuredMotion(design.cam, least, design.phases)

    @cached_property
    def place(self) -> Place:
        """The roller at lift 0, where it is nearest to the cam axis."""
        least, follower = self.motion.least, self.follower
        if not self.spec.oscillates:
            return Place(math.hypot(least, follower.offset), follower.offset)
        f, l = follower.center_distance, follower.arm  # noqa: E741
        return Place(math.sqrt(f * f + l * l - 2.0 * f * l * math.cos(least)), 0.0, f, least)


class MeasuredCamDesign(DiscCamDesign):
    """A follower on a cam whose profile was measured."""

    kind = "measured-cam"
    spec: MeasuredCamSpec  # type: ignore[assignment]  # it has what a disc cam's has
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
    outlines = {"analyze": Outline(QUANTITIES, _CHECKS, ("law", "phases"))}
    extra_tables = ("profile_fit", "main_cam", "radius")
    extreme_names = ()

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """None: the motion is that of the profile."""
        return {}

    @cached_property
    def cams(self) -> FollowerCams:
        """The cam as a disc cam."""
        return MeasuredCams(self)

    @property
    def _oscillates(self) -> bool:
        return self.spec.oscillates

    @cached_property
    def points(self) -> tuple[Reals, Reals]:
        """Angles [rad] and radii [mm] of the measured profile."""
        from gearlink.core.machines.disc_cam.measured_profile import places

        return places(self.spec.profile.points or ())

    @cached_property
    def cam(self) -> MeasuredCam:
        """Series and follower."""
        from gearlink.core.machines.disc_cam.measured_profile import MeasuredCam, Series

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

    @property
    def ends(self) -> tuple[float, float]:
        """Minimum and maximum coordinate of the follower [rad or mm]."""
        return self._range

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
    def follower_velocity_max(self) -> float | None:
        """Maximum velocity of the follower [mm/s or rad/s]."""
        return None if self.speed is None else self.speed * self._greatest(1)

    @property
    def follower_acceleration_max(self) -> float | None:
        """Maximum acceleration of it [mm/s^2 or rad/s^2]."""
        return None if self.speed is None else self.speed**2 * self._greatest(2)

    def _greatest(self, order: int) -> float:
        from gearlink.core.numerics.extremes import maximum_over

        return maximum_over(lambda phi: abs(self.cam.motion(phi)[order]), samples=self._samples).value

    @cached_property
    def phases(self) -> list[MeasuredPhase]:
        """Dwells and strokes."""
        import numpy as np

        from gearlink.core.machines.disc_cam.measured_profile import ROWS, phases_of

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
