"""The cam that opens the fingers on the arm: coaxial with the gripper's axis, it turns with the cylinder.

Seen from the arm the cam turns by Theta = eps theta - s beta, which runs one way as long as |beta'| < 1: the fingers,
closed on the way out and open on the return stroke at the same swing, then have one angle at each angle of their cam.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution, in_section
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.cams.disc_cam import DiscCam
from gearlink.core.parts.cams.laws import Law, law
from gearlink.core.parts.cams.profile import RollerPath, oscillating

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.motion import Motion
    from gearlink.core.machines.swing_gripper.spec import FingerSection, SwingGripperSpec

_TURN = 2.0 * math.pi
_STEPS = 60
_GRID = 3600


class FingerCam:
    """Fingers at the tip of the arm, a roller lever on the arm, and their cam.

    Parameters
        spec : SwingGripperSpec - with fingers
        motion : Motion
    Source
        swing-gripper paper 1 lets the fingers open at the handover; the cam: own derivation
    """

    def __init__(self, spec: SwingGripperSpec, motion: Motion) -> None:
        self.spec, self.motion = spec, motion

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
                    f"fingers rest before and after: {found[-1].name} is {found[-1].kind}",
                    key=f"fingers.{name}.law",
                    fix="take cycloidal or modified-sine",
                )
        return found[0], found[1]

    @property
    def _ends(self) -> tuple[float, float, float, float]:
        """Cylinder angles at which opening and closing begin and end [deg]."""
        first, last = self.section.open, self.section.close
        return first.from_, first.from_ + first.over, last.to - last.over, last.to

    def opening(self, degrees: Reals, order: int = 2) -> list[Reals]:
        """Angle eta by which the fingers are open, and its derivatives by theta [rad].

        Parameters
            degrees : (N,) array [deg] - cylinder angle, 0 to 360
        """
        start, opened, closing, closed = self._ends
        whole = math.radians(self.section.open_angle)
        found = [np.zeros_like(degrees) for _ in range(order + 1)]
        found[0][(degrees >= opened) & (degrees <= closing)] = whole
        for begin, end, one, sense in ((start, opened, self._laws[0], 1.0), (closing, closed, self._laws[1], -1.0)):
            inside = (degrees > begin) & (degrees < end)
            shape = one.evaluate((degrees[inside] - begin) / (end - begin), order)
            found[0][inside] = whole * (shape[0] if sense > 0.0 else 1.0 - shape[0])
            for n in range(1, order + 1):
                found[n][inside] = sense * whole * shape[n] / math.radians(end - begin) ** n
        return found

    @property
    def _sense(self) -> int:
        """Sense of the cylinder that takes the sheet over: against the gripper's swing."""
        return -self.spec.swing_sense

    def cam_angle(self, degrees: Reals) -> tuple[Reals, Reals, Reals]:
        """Turn of the cam seen from the arm, theta + beta in the cylinder's sense, and derivatives by theta [rad]."""
        beta, first, second = self.motion.law.evaluate(degrees, 2)
        return np.radians(degrees) + beta, 1.0 + first, second

    @cached_property
    def _grid(self) -> tuple[Reals, Reals]:
        degrees = np.linspace(0.0, 360.0, _GRID, endpoint=False)
        angle, rate, _ = self.cam_angle(degrees)
        if np.min(rate) <= 0.0:
            worst = float(degrees[int(np.argmin(rate))])
            raise NoSolution(
                f"the arm returns as fast as the cam of its fingers turns, at cylinder angle {worst:.4g} deg",
                key="fingers",
                fix="lengthen phases.return",
            )
        return np.append(degrees, 360.0), np.append(angle, _TURN)

    def cylinder_degrees(self, cam_angle: Reals) -> Reals:
        """Cylinder angle [deg] at angles of the cam seen from the arm [rad], by Newton's steps from a grid."""
        grid, angles = self._grid
        wanted = np.mod(cam_angle, _TURN)
        degrees = np.asarray(np.interp(wanted, angles, grid), dtype=np.float64)
        for _ in range(_STEPS):
            angle, rate, _ = self.cam_angle(np.minimum(degrees, np.nextafter(360.0, 0.0)))
            off = angle - wanted
            degrees = np.minimum(np.maximum(degrees - np.degrees(off / rate), 0.0), np.nextafter(360.0, 0.0))
            if np.max(np.abs(off), initial=0.0) <= 1e-14 * _TURN:
                break
        return degrees

    @cached_property
    def cam(self) -> DiscCam:
        """The cam, in the frame of the arm: E the origin, the arm along +x."""
        section = self.section
        pivot, angle = complex(section.pivot, 0.0), math.radians(section.angle)

        def path(phi: Reals, _order: int) -> RollerPath:
            degrees = self.cylinder_degrees(phi)
            eta, first, second = self.opening(degrees)
            _, rate, bend = self.cam_angle(degrees)
            speed = first / rate
            return oscillating(pivot, section.lever, angle + eta, speed, (second - speed * bend) / rate**2)

        joints = np.array(sorted({*self.motion.law.starts[:-1], *(each % 360.0 for each in self._ends)}))
        places = tuple(self.cam_angle(joints)[0].tolist())
        return DiscCam("finger cam", path, self._sense, section.roller_radius, places, "fingers")

    @property
    def release_degrees(self) -> float:
        """Cylinder angle at which the fingers must have let go [deg]: the end of the release window."""
        return self.motion.handover + (self.spec.release.window if self.spec.release is not None else 0.0)

    @cached_property
    def opened(self) -> float:
        """Angle by which the fingers are open at the end of the release window [rad]."""
        return float(self.opening(np.array([self.release_degrees]), 0)[0][0])

    @property
    def lift(self) -> float:
        """Way of the finger tips at the end of the release window [mm]."""
        return self.section.length * self.opened
