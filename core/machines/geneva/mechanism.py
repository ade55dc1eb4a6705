"""The motion of a Geneva drive in closed form, and its mechanism: crank, wheel, the pin in its slots."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import NEWTON_METER, Connection, Pin, SharedContact
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Turn, fixed, steady
from gearlink.core.numerics.arrays import Mask, Reals, units
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.geneva.design import GenevaDrive

_NEAR = 8.0
"""Units in the last place by which an angle may lie beside an end of the motion and be it."""


@dataclass(frozen=True)
class Geneva:
    """A wheel of radial slots and a crank.

    Fields
        slots, pins : int
        distance : float [mm] - of the axes
        sign : float - +1 external, -1 internal
    Source
        thesis 4.2.1; own derivation: the pin enters along the slot, so that the speed has no step
    """

    slots: int
    pins: int
    distance: float
    sign: float

    @cached_property
    def ratio(self) -> float:
        """Crank radius over the distance of the axes, sin(pi/n)."""
        return math.sin(math.pi / self.slots)

    @property
    def crank(self) -> float:
        """Radius of the pin's circle [mm]."""
        return self.distance * self.ratio

    @property
    def wheel(self) -> float:
        """Radius of the wheel to the mouths of its slots [mm]."""
        return self.distance * math.cos(math.pi / self.slots)

    @property
    def step(self) -> float:
        """Angle of the wheel in a step [rad]."""
        return TURN / self.slots

    @property
    def half(self) -> float:
        """Crank angle from the line of centres to where the pin leaves its slot [rad]."""
        return 0.5 * math.pi - self.sign * math.pi / self.slots

    def rates(self, f: Reals, order: int) -> list[Reals]:
        """Angle of the wheel and its derivatives while a pin is in a slot.

        psi = atan2(l sin f, 1 - s l cos f),  W = l (cos f - s l)/Q,  W' = -l (1 - l^2) sin f/Q^2,
        W'' = -l (1 - l^2) (Q cos f - 4 s l sin^2 f)/Q^3,  Q = 1 + l^2 - 2 s l cos f

        Parameters
            f : (N,) array [rad] - crank angle from the line of centres, within +-half
            order : int - 0 to 3
        Returns
            rates : order + 1 arrays [rad]
        """
        lam, s = self.ratio, self.sign
        cos, sin = np.cos(f), np.sin(f)
        q = 1.0 + lam * lam - 2.0 * s * lam * cos
        part = -lam * (1.0 - lam * lam)
        found = [
            np.arctan2(lam * sin, 1.0 - s * lam * cos),
            lam * (cos - s * lam) / q,
            part * sin / q**2,
            part * (q * cos - 4.0 * s * lam * sin**2) / q**3,
        ]
        return [np.asarray(each) for each in found[: order + 1]]

    def over(self, phi: Reals, order: int, side: int = 1) -> tuple[list[Reals], Mask, Reals]:
        """Angle of the wheel and its derivatives at any crank angle, whether it moves, and which pin is the nearest.

        Parameters
            phi : (N,) array [rad] - from a pin on the line of centres
            side : +1 or -1 - of the ends of the motion, where the second derivative jumps
        Returns
            rates, moves, pin : order + 1 (N,) arrays [rad], bool, number of whole pitches from pin 0
        """
        pitch = TURN / self.pins
        near = _NEAR * np.spacing(np.maximum(np.abs(phi), TURN))
        pin = np.floor(phi / pitch + 0.5)
        f = phi - pin * pitch
        late = f >= self.half - near if side > 0 else f > self.half + near
        early = f < -self.half - near if side > 0 else f <= -self.half + near
        moves = ~(late | early)
        held = np.clip(f, -self.half, self.half)  # where the wheel stands only the end of its step counts
        rates = self.rates(held, order)
        rates = [np.asarray(rates[0] + pin * self.step), *(np.where(moves, each, 0.0) for each in rates[1:])]
        return rates, np.asarray(moves), pin

    def reach(self, f: Reals) -> Reals:
        """Distance of the pin from the wheel's axis [mm]."""
        a, r = self.distance, self.crank
        return np.sqrt(a * a + r * r - 2.0 * self.sign * a * r * np.cos(f))

    @cached_property
    def peak_place(self) -> float:
        """Crank angle of the maximum acceleration ratio, before the line of centres [rad].

        external: cos f* = -q + sqrt(q^2 + 2), q = (1 + l^2)/(4 l);  internal: the entry
        """
        if self.sign < 0.0:
            return -self.half
        q = (1.0 + self.ratio**2) / (4.0 * self.ratio)
        return -math.acos(2.0 / (q + math.sqrt(q * q + 2.0)))

    def leaves(self, angle: float) -> float:
        """Crank angle from the line of centres at which the wheel has this angle left of its step [rad].

        sin(psi) = l sin(f + s psi), of the closed form of psi
        """
        psi = 0.5 * self.step - angle
        return math.asin(math.sin(psi) / self.ratio) - self.sign * psi


def motion(design: GenevaDrive) -> Motion:
    """Links and joints over the crank angle from the line of centres: crank axis A at 0, the wheel's axis D on the x
    axis, for an external wheel on +x; a wheel of more slots than the crank has pins comes home after several turns."""
    drive = design.drive
    axis, radius, start = complex(drive.sign * drive.distance), drive.crank, math.pi if drive.sign > 0.0 else 0.0

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        rates, moves, pin = drive.over(phi, order, side)
        rates[0] = start - drive.sign * rates[0]
        wheel = Turn(rates[0], *(-drive.sign * each for each in rates[1:]))
        links = {
            "crank": Link(fixed(0j, phi, order=order), steady(phi, order=order), {"P": radius}),
            "wheel": Link(fixed(axis, phi, order=order), wheel),
        }
        at = radius * units(phi - pin * (TURN / drive.pins))
        across = 1j * (at - axis) / np.abs(at - axis)
        joints: list[Connection] = [
            Pin("A", FRAME, "crank", links["crank"].origin.value),
            Pin("D", FRAME, "wheel", links["wheel"].origin.value),
            SharedContact(
                "slot",
                "wheel",
                np.asarray(at),
                np.where(moves, across, 0j),
                {"crank": np.where(moves, 1.0, 0.0)},
                hold=np.where(moves, 0.0, NEWTON_METER),
            ),
        ]
        return Mechanism(links, joints, "crank")

    pitch = TURN / drive.pins
    ends = [k * pitch + f for k in range(drive.pins + 1) for f in (-drive.half, drive.half)]
    joints = tuple(sorted(end for end in ends if 0.0 < end < TURN))
    return Motion(make, Input("crank_angle", joints=joints), (Output("Wheel", wheel_course(drive)),))


def wheel_course(drive: Geneva) -> Course:
    """Angle of the wheel from the middle of its step, positive the way that it turns [rad]."""
    start = math.pi if drive.sign > 0.0 else 0.0
    return turned("wheel", sense=-drive.sign).less(-drive.sign * start)


def errors(design: GenevaDrive, _mechanism: Mechanism) -> Movable:
    """The distance of the axes; the error is measured at the rim of the wheel where the file says nothing else."""
    return Movable({"center_distance": (Shift(FRAME, ("D",), design.drive.sign),)}, radius=design.drive.wheel)
