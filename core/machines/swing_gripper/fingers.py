"""The cam that opens a gripper's fingers on the arm: coaxial with the gripper's axis, it turns with the cylinder.

Seen from the arm the cam turns by Theta = eps theta - s beta, which runs one way as long as |beta'| < 1: the fingers,
closed on the way out and open on the return stroke at the same swing, then have one angle at each angle of their cam.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import NoSolution, in_section
from gearlink.core.base.results import cached_property, kept
from gearlink.core.machines.swing_gripper.law import SixPhaseLaw, of_rows
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme
from gearlink.core.numerics.roots_sweep import newton_places
from gearlink.core.parts.cams.disc_cam import DiscCam, seek_together
from gearlink.core.parts.cams.laws import Law, law
from gearlink.core.parts.cams.profile import RollerPath, oscillating

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.motion import Timing
    from gearlink.core.machines.swing_gripper.spec import FingerSection, SwingGripperSpec

FOUND = ("max_pressure_angle", "most_convex", "least_support")
"""Extremes of the cam that its checks need."""
_TURN = 2.0 * math.pi
_GRID = 3600
_SURELY = 1.0 - 1e-9


@dataclass(frozen=True)
class FingerCourse:
    """The course of the roller over the cylinder angle, in the frame of the arm: E the origin, the arm along +x.

    Parameters
        law : SixPhaseLaw - of the arm
        laws : of opening and closing
        ends : four floats [deg] - cylinder angles at which opening and closing begin and end
        whole : float [rad] - angle by which the fingers open
        pivot, lever : float [mm] - E to the lever's pivot, and that to the roller
        angle : float [rad] - from the arm to the lever, fingers closed
    """

    law: SixPhaseLaw
    laws: tuple[Law, Law]
    ends: tuple[float, float, float, float]
    whole: float
    pivot: float
    lever: float
    angle: float

    def __call__(self, theta: Reals, _order: int) -> RollerPath:
        """The path of a disc cam, over the cylinder angle [rad] instead of the cam's."""
        return self.at(np.degrees(theta))

    def at(self, degrees: Reals) -> RollerPath:
        """The path at cylinder angles [deg]; its derivatives are by the angle of the cam seen from the arm."""
        eta, first, second = self.opening(degrees)
        _, rate, bend = self.cam_angle(degrees)
        speed = first / rate
        angles = self.angle + eta, speed, (second - speed * bend) / rate**2
        return oscillating(self.pivot + 0j, self.lever, *angles)

    def cam_angle(self, degrees: Reals) -> tuple[Reals, Reals, Reals]:
        """Turn of the cam seen from the arm, theta + beta in the cylinder's sense, and derivatives by theta [rad]."""
        beta, first, second = self.law.evaluate(degrees, 2)
        return np.radians(degrees) + beta, 1.0 + first, second

    def opening(self, degrees: Reals, order: int = 2) -> list[Reals]:
        """Angle eta by which the fingers are open, and its derivatives by theta [rad].

        Parameters
            degrees : (N,) array [deg] - cylinder angle, 0 to 360
        """
        degrees = np.broadcast_arrays(degrees, *self.ends)[0]
        start, opened, closing, closed = self.ends
        found = [np.where((degrees >= opened) & (degrees <= closing), self.whole, 0.0)]
        found += [np.zeros_like(degrees) for _ in range(order)]
        for begin, end, one, sense in ((start, opened, self.laws[0], 1.0), (closing, closed, self.laws[1], -1.0)):
            inside = ((degrees > begin) & (degrees < end)).nonzero()
            first, last, whole = of_rows(inside[0], begin, end, self.whole)
            shape = one.evaluate((degrees[inside] - first) / (last - first), order)
            found[0][inside] = whole * (shape[0] if sense > 0.0 else 1.0 - shape[0])
            for n in range(1, order + 1):
                found[n][inside] = sense * whole * shape[n] / ((last - first) * (math.pi / 180.0)) ** n
        return found


@dataclass(frozen=True)
class CamOfFingers(DiscCam):
    """The cam, whose extremes are sought over the cylinder angle, for which no cam angle has to be solved.

    Parameters
        fingers : FingerCam - whose it is
    """

    fingers: FingerCam | None = None

    @cached_property
    def _found(self) -> dict[str, Any]:
        """By name; nothing where there is no such cam, of which each search over the cam angle tells."""
        assert self.fingers is not None, "made with them"
        fingers, over = self.fingers, self.fingers.cylinder_cam
        try:
            fingers.require_one_way()
            if not kept(over, *FOUND):
                seek_together((over,), FOUND)
        except NoSolution:
            return {}
        return {
            name: Extreme(found.value, fingers.turned(found.place)) if isinstance(found, Extreme) else found
            for name, found in kept(over, *FOUND).items()
        }

    @cached_property
    def max_pressure_angle(self) -> Extreme:
        found: Extreme | None = self._found.get("max_pressure_angle")
        return found or super().max_pressure_angle

    @cached_property
    def most_convex(self) -> Extreme:
        found: Extreme | None = self._found.get("most_convex")
        return found or super().most_convex

    @cached_property
    def least_support(self) -> float:
        found: float | None = self._found.get("least_support")
        return super().least_support if found is None else found


class FingerCam:
    """Fingers at the tip of the arm, a roller lever on the arm, and their cam.

    Parameters
        spec : SwingGripperSpec - with fingers
    Source
        swing-gripper paper 1 lets the fingers open at the handover; the cam: own derivation
    """

    def __init__(self, spec: SwingGripperSpec, timing: Timing) -> None:
        self.spec, self.timing = spec, timing

    @property
    def section(self) -> FingerSection:
        """The section `fingers` of the design file."""
        assert self.spec.fingers is not None, "needed only where the file has it"
        return self.spec.fingers

    @cached_property
    def _laws(self) -> tuple[Law, Law]:
        found = []
        for name in ("open", "close"):
            with in_section(f"fingers.{name}.law"):
                found.append(law(getattr(self.section, name).law))
            if found[-1].kind != "rest-to-rest":
                raise NoSolution(
                    f"fingers are at rest before and after their motion: {found[-1].name} is {found[-1].kind}",
                    key=f"fingers.{name}.law",
                    fix="use cycloidal or modified-sine",
                )
        return found[0], found[1]

    @cached_property
    def course(self) -> FingerCourse:
        """The course of the roller."""
        given, first, last = self.section, self.section.open, self.section.close
        ends = first.from_, first.from_ + first.over, last.to - last.over, last.to
        angles = math.radians(given.open_angle), given.pivot, given.lever, math.radians(given.angle)
        return FingerCourse(self.timing.law, self._laws, ends, *angles)

    def opening(self, degrees: Reals, order: int = 2) -> list[Reals]:
        """Angle by which the fingers are open, and its derivatives by the cylinder angle [rad], at angles [deg]."""
        return self.course.opening(degrees, order)

    @property
    def _sense(self) -> int:
        """Sense of the cylinder that takes the sheet over: against the gripper's swing."""
        return -self.spec.swing_sense

    def require_one_way(self) -> None:
        """Refuse a cam that turns back on the arm.

        Raises
            NoSolution
        """
        law, span = self.timing.law, self.timing.phase_angles.return_
        forth = law.accelerate.shaping is None and law.decelerate.shaping is None  # the arm swings forth all the way
        if not (forth and law.total_swing * law.return_.peak_velocity < _SURELY * span):
            _ = self._grid

    def turned(self, theta: float) -> float:
        """Angle of the cam [rad] at a cylinder angle [rad]."""
        return (theta + self.timing.law.swing(math.degrees(theta))) % _TURN

    @cached_property
    def _grid(self) -> tuple[Reals, Reals]:
        degrees = np.linspace(0.0, 360.0, _GRID, endpoint=False)
        angle, rate, _ = self.course.cam_angle(degrees)
        if np.min(rate) <= 0.0:
            worst = float(degrees[int(np.argmin(rate))])
            raise NoSolution(
                f"the arm returns as fast as the cam of the fingers turns, at cylinder angle {worst:.4g} deg",
                key="fingers",
                fix="lengthen phases.return",
            )
        return np.append(degrees, 360.0), np.append(angle, _TURN)

    def cylinder_degrees(self, cam_angle: Reals) -> Reals:
        """Cylinder angle [deg] at angles of the cam seen from the arm [rad], by Newton's steps from a grid."""
        grid, angles = self._grid
        wanted = np.mod(cam_angle, _TURN)
        degrees = np.asarray(np.interp(wanted, angles, grid), dtype=np.float64)

        def excess(at: Reals, rows: Any) -> tuple[Reals, Reals]:
            angle, rate, _ = self.course.cam_angle(at)
            return angle - wanted[rows], np.radians(rate)

        found = newton_places(excess, degrees, float(np.nextafter(360.0, 0.0)), 1e-14 * _TURN)
        assert found is not None, "the cam angle rises all the way"
        return found

    @property
    def _joints(self) -> Reals:
        """Cylinder angles [deg] at which the law of the arm or of the fingers changes."""
        course = self.course
        return np.array(sorted({*course.law.starts[:-1], *(each % 360.0 for each in course.ends)}))

    @cached_property
    def cylinder_cam(self) -> DiscCam:
        """The cam over the cylinder angle instead of its own, of the same extremes."""
        joints = tuple(np.radians(self._joints).tolist())
        return DiscCam("finger cam", self.course, self._sense, self.section.roller_radius, joints, "fingers")

    @cached_property
    def cam(self) -> CamOfFingers:
        """The cam, in the frame of the arm."""

        def path(phi: Reals, _order: int) -> RollerPath:
            return self.course.at(self.cylinder_degrees(phi))

        places = tuple(self.course.cam_angle(self._joints)[0].tolist())
        return CamOfFingers("finger cam", path, self._sense, self.section.roller_radius, places, "fingers", self)

    @property
    def release_degrees(self) -> float:
        """Cylinder angle at which the fingers must have let go [deg]: the end of the release window."""
        return self.timing.handover + (self.spec.release.window if self.spec.release is not None else 0.0)

    @cached_property
    def opened(self) -> float:
        """Angle by which the fingers are open at the end of the release window [rad]."""
        return float(self.opening(np.array([self.release_degrees]), 0)[0][0])

    @property
    def lift(self) -> float:
        """Way of the finger tips at the end of the release window [mm]."""
        return self.section.length * self.opened
