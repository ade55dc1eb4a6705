"""The strokes of a wide swing: contour of any of its cams, the roller on it, how the rocker turns.

In the frame of the line of centres, the cam axis at 0 and the rocker's axis at -1 centre distance, with the rocker
turning counter-clockwise in the stroke.

The world has the cam axis O at 0 and the rocker's axis D on the line of centres; the rocker turns counter-clockwise
in the working stroke. k is the fraction of the stroke in time; where the roller then stands on the profile is a
fraction of the stroke that the profile was made for, another one on the way home of a cam that swings.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from gearlink.core.machines.wide_swing.cam import CurveState, WideSwingCam, mirrored
from gearlink.core.machines.wide_swing.oscillating_cam import OscillatingCam, crank_angle, way_home
from gearlink.core.mechanism.rates import Rates, Turn, chained
from gearlink.core.numerics.arrays import Points, Reals, unit_vector

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign


AnyCam = WideSwingCam | OscillatingCam


def contour(cam: AnyCam, count: int = 400) -> tuple[Points, Points, Points]:
    """The cam's contour over the stroke: run-up, slot of the roller at mid-swing, run-out.

    Parameters
        cam : WideSwingCam or OscillatingCam
        count : int - points of each profile branch
    Returns
        run_up, slot, run_out : complex arrays [mm] - each begins where the one before it ends
    Raises
        NoSolution - for a profile that does not exist
    """
    run_up, run_out = (cam.points(np.linspace(*part, count)).profile for part in cam.contact)
    return run_up, mirrored(cam.slot_bottom(np.linspace(0.0, 1.0, 81)), cam.sense), run_out


def dwell_arc(cam: AnyCam) -> Points:
    """The rest of the turn, from the end of the stroke back to its start, about the cam axis.

    Parameters
        cam : WideSwingCam or OscillatingCam
    Returns
        arc : (181,) complex array [mm] - a circle's where the cam turns evenly and the rocker dwells
    Raises
        NoSolution - for a profile that does not exist
    """
    (begin, _), (_, end) = cam.contact
    last, first = (complex(z) for z in cam.points(np.array([end, begin])).profile)
    middle = complex(cam.points(np.array([cam.middle])).pitch[0])
    start, stop = (float(np.angle(z / -middle)) for z in (last, first))
    share: Reals = np.linspace(0.0, 1.0, 181)
    radius = abs(last) ** (1.0 - share) * abs(first) ** share
    return -middle / abs(middle) * radius * unit_vector(start + (stop - start) * share)


# A stroke of a wide-swing mechanism: how the rocker turns in it, and where its roller stands on the cam


Parts: TypeAlias = tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, eq=False)
class Stroke:
    """A stroke over the fractions k of it.

    Fields
        name : str - of its roller: main, return
        cam : AnyCam - that guides it
        start : float [rad] - input angle at which it starts
        shaft : complex [mm] - the cam's axis
        toward : complex - unit vector from the rocker's axis to it, over that of the working stroke
    """

    name: str
    cam: AnyCam
    start: float
    design: WideSwingDesign
    shaft: complex = 0j
    toward: complex = 1.0 + 0j

    @property
    def width(self) -> float:
        """Input angle that it takes [rad]."""
        return self.cam.cycle_angle

    @property
    def words(self) -> str:
        """What it is called."""
        return "working stroke" if self.name == "main" else "return stroke"

    @property
    def cam_words(self) -> str:
        """What its cam is called beside that of the working stroke."""
        return "cam" if self.name == "main" else "return cam"

    @property
    def mirrored(self) -> bool:
        """Whether it goes the other way round on a cam of its own."""
        return self.name != "main"

    def profile(self, k: Reals) -> tuple[Reals, Reals]:
        """Where on the profile the roller stands, as a fraction of the profile's stroke, and how fast that goes."""
        return k, np.ones_like(k)

    def at_profile(self, place: float) -> float:
        """Fraction k of this stroke at which the roller stands at a place of the profile."""
        return place

    def turn(self, k: Reals, order: int) -> Turn:
        """The rocker's angle from mid-swing, with its derivatives by the input angle."""
        motion = self.design.motion
        a, *rates = motion.law.invariants(k, order)
        swing = -motion.swing if self.mirrored else motion.swing
        return Turn((a - 0.5) * swing, *(swing / self.width**n * rate for n, rate in enumerate(rates, 1)))

    def to_world(self, z: Points) -> Points:
        """From the frame in which cams are computed to the world; a mirrored stroke is its mirror image."""
        if self.design.spec.layout == "twin-rocker":
            return mirrored(z, -1)
        return np.asarray(np.conj(z)) if self.mirrored else z

    def roller(self, k: Reals, *, resting: bool = False) -> tuple[Points, Points]:
        """Roller centre [mm] and the direction in which the cam pushes it; `resting`: on the arc beside its stroke."""
        at: CurveState = self.cam.state(self.profile(k)[0])
        if resting:
            at = at.resting()
        place, push = self.to_world(self.cam.center_distance * at.arm), self.to_world(at.outward)
        return np.asarray(self.shaft + self.toward * place), np.asarray(self.toward * push)

    @cached_property
    def parts(self) -> Parts:
        """Parts of the stroke in which the roller touches the profile."""
        return self.design.contact_of(self.cam)


class WayHome(Stroke):
    """The way home of a cam on a crank-rocker, over the profile of the stroke; k is its fraction from the far end."""

    cam: OscillatingCam

    @property
    def width(self) -> float:
        """What the stroke leaves of the crank's turn [rad]."""
        return 2.0 * math.pi - self.cam.cycle_angle

    @property
    def cam_words(self) -> str:
        """It is the same cam as that of the stroke."""
        return self.words

    @property
    def mirrored(self) -> bool:
        """It is the same cam that goes back."""
        return False

    def _home(self, k: Reals, order: int = 2) -> Rates[Reals]:
        """The cam there; at both ends, where the profile bends without bound, it stands at the stop itself."""
        place, *rates = way_home(self.cam, self.start + k * self.width, order)
        return Rates(np.where(k == 0.0, 1.0, np.where(k == 1.0, 0.0, place)), *rates)

    def profile(self, k: Reals) -> tuple[Reals, Reals]:
        """The place goes backwards, and its speed is that over the stroke's."""
        at = self._home(k)
        return at.value, at.first * self.cam.cycle_angle

    def at_profile(self, place: float) -> float:
        """Fraction k of the way home at which the cam stands at a place of the stroke."""
        turned = float(crank_angle(self.cam, np.array([place]))[0])
        return (turned - self.start) / self.width

    def turn(self, k: Reals, order: int) -> Turn:
        """The rocker follows the cam, at whose places the profile has it as in the stroke."""
        at, motion = self._home(k, max(order, 2)), self.design.motion
        a, *rates = motion.law.invariants(at.value, order)
        return Turn(*(motion.swing * each for each in chained([a - 0.5, *rates], at)))

    @cached_property
    def parts(self) -> Parts:
        """Parts of the way home in which the roller touches the profile."""
        (first, start), (end, last) = self.design.contact_of(self.cam)
        a, b, c, d = (self.at_profile(place) for place in (last, end, start, first))
        return (a, b), (c, d)


def strokes_of(design: WideSwingDesign) -> tuple[Stroke, ...]:
    """The working stroke, and what brings the rocker back where the whole revolution is known."""
    main = Stroke("main", design.cam, 0.0, design)
    if design.spec.drive is not None:
        return main, WayHome("return", design.cam, design.cam.cycle_angle, design)
    if design.spec.cycle is None:
        return (main,)
    start = sum(design.motion.cycle_angles[:2])
    if design.spec.layout == "twin-cam-parallel":
        near, far = design.shafts.shafts
        seat = far - near, cmath.rect(1.0, design.shafts.roller_arm_angle)
        return main, Stroke("return", design.shafts.cams[1], start, design, *seat)
    return main, Stroke("return", design.return_cam or design.cam, start, design)
