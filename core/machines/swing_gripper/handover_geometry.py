"""A gripper's tip beside the drum that takes the sheet over: gap to the pitch circle, slip, speed difference.

The arm l turns about E, the drum R about O at the distance D; d is the arm's lead on the line of centres E-O.
Arm and drum turn in opposite senses; d and the drum's turn count positive in the sense of the working stroke.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.arrays import Reals


@dataclass(frozen=True, slots=True)
class TipPath:
    """The tip seen from the drum, over the leads asked for.

    Attributes
        gap : (N,) array [mm] - |OF| - R, positive outside the pitch circle
        drum_angle : (N,) array [rad] - psi_F, angle of F about O from the line of centres
        slip : (N,) array [mm] - R (psi_F - turned): how far the tip is ahead of the sheet since the handover
    """

    gap: Reals
    drum_angle: Reals
    slip: Reals


def tip_path(arm: float, radius: float, distance: float, lead: Reals, turned: Reals, lead_0: float = 0.0) -> TipPath:
    """Path of the gripper tip relative to the drum.

    |OF|^2 = (D - l)^2 + 4 l D sin^2(d/2),   gap = [(D - l - R)(D - l + R) + 4 l D sin^2(d/2)]/(|OF| + R)
    psi_F = atan2(l sin d, D - l cos d)

    Parameters
        arm, radius, distance : float [mm] - l, R, D
        lead : (N,) array [rad] - d of the arm on the line of centres
        turned : (N,) array [rad] - turn of the drum since the handover
        lead_0 : float [rad] - d at the handover; not 0 where the drum stands off the line of the arm
    Returns
        path : TipPath
    Notes
        No difference of nearly equal lengths where D = l + R. The gap opens as l D/(2R) d^2, the slip as d^3.
    Example
        >>> turned = np.radians([0.0, 1.0, 6.0])
        >>> tip_path(300.0, 135.0, 435.0, 0.45 * turned, turned).gap.round(6).tolist()
        [0.0, 0.029811, 1.068889]
    """
    offset = distance - arm
    swell = 4.0 * arm * distance * np.sin(0.5 * lead) ** 2
    from_drum = np.sqrt(offset * offset + swell)
    gap: Reals = ((offset - radius) * (offset + radius) + swell) / (from_drum + radius)
    angle: Reals = _drum_angle(arm, distance, lead)
    slip: Reals = radius * (angle - _drum_angle(arm, distance, np.float64(lead_0)) - turned)
    return TipPath(gap, angle, slip)


def _drum_angle(arm: float, distance: float, lead: Reals | np.float64) -> Reals:
    # D - l cos d = (D - l) + 2 l sin^2(d/2)
    angle: Reals = np.arctan2(arm * np.sin(lead), distance - arm + 2.0 * arm * np.sin(0.5 * lead) ** 2)
    return angle


def speed_difference(path: TipPath, lead: Reals, tip_speed: Reals, drum_speed: float, radius: float) -> Reals:
    """Tangential speed of the tip less that of the drum turning below it.

    v cos(d + psi_F) - (R + gap) Omega

    Parameters
        path : TipPath
        lead : (N,) array [rad] - d
        tip_speed : (N,) array [mm/s] - v along the arm's circle
        drum_speed : float [rad/s] - Omega
        radius : float [mm] - R
    Returns
        difference : (N,) array [mm/s]
    """
    turn = np.sin(0.5 * (lead + path.drum_angle)) ** 2
    difference: Reals = (tip_speed - radius * drum_speed) - 2.0 * tip_speed * turn - path.gap * drum_speed
    return difference


def widest_window(arm: float, radius: float, gap: float) -> float:
    """Largest turn of the drum to either side of the handover within which the tip keeps to the pitch circle.

    sin^2(d/2) = gap (2 R + gap)/(4 l (l + R)),   turn = d l/R

    Parameters
        arm, radius : float [mm] - l, R; the tip stands on the line of centres at the handover
        gap : float [mm] - allowed distance from the pitch circle
    Returns
        turn : float [rad]
    Raises
        NoSolution - for a gap of 2 l or more, which no turn reaches
    Example
        >>> round(math.degrees(widest_window(300.0, 135.0, 0.03)), 4)
        1.0032
    """
    if gap >= 2.0 * arm:
        raise NoSolution(
            f"gap of the tip from the pitch circle: {unlike(gap, 2.0 * arm)} mm (limit < {unlike(2.0 * arm, gap)} mm)",
            fix=f"specify less than {safely_below(2.0 * arm)} mm",
        )
    square = gap * (2.0 * radius + gap) / (4.0 * arm * (arm + radius))
    return 2.0 * math.asin(math.sqrt(square)) * arm / radius


@dataclass(frozen=True, slots=True)
class Misplacement:
    """How far the drum stands off the gripper at the handover.

    Attributes
        place : float [mm] - from the tip to the point of the pitch circle on the line of centres
        turn : float [rad] - what to add to the arm's direction so that it lies on the line of centres
        distance : float [mm] - what the centre distance exceeds l + R by
    """

    place: float
    turn: float
    distance: float


def misplacement(pivot: complex, tip: complex, center: complex, radius: float) -> Misplacement:
    """Where the tip stands at the handover against the line of centres.

    Parameters
        pivot, tip, center : complex [mm] - E, F at the handover, O
        radius : float [mm] - R
    Returns
        off : Misplacement
    Example
        >>> off = misplacement(0j, 300.0 + 0j, 436.0 + 0j, 135.0)
        >>> off.place, off.turn, off.distance
        (1.0, 0.0, 1.0)
    """
    line = center - pivot
    contact = center - radius * line / abs(line)
    turn = cmath.phase(line / (tip - pivot))
    return Misplacement(abs(tip - contact), turn, abs(line) - abs(tip - pivot) - radius)


def drum_center(pivot: complex, tip: complex, radius: float) -> complex:
    """Centre of the drum whose rim the gripper tip touches on the line of centres.

    O_t = E + (l + R) (F - E)/l

    Parameters
        pivot, tip : complex [mm] - E, and F at the handover
        radius : float [mm] - R of the drum
    Example
        >>> drum_center(0j, 30.0 + 40.0j, 10.0)
        (36+48j)

    Source
        swing-gripper paper 2 (handover on the line of centres)
    """
    arm = tip - pivot
    return pivot + arm * (1.0 + radius / abs(arm))
