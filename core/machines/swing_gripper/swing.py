"""Where the links of a gripper may swing: refusal of a swing that they cannot make, and the remedy in degrees."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
from gearlink.core.numerics.arrays import Reals

DEAD_POINT = 1e-3
_LEAST_AIM = math.radians(10.0)
_STEP = math.radians(0.1)
_JOINTS = (("D", "coupler", "output"), ("C", "input", "coupler"))


def require_swing(linkage: GripperLinkage, limit: float) -> None:
    """Refuse a linkage that cannot make its swing: open somewhere, or within 1e-3 rad of a dead centre.

    |AC - CD| <= |AD| <= AC + CD,   mu_C >= 1e-3,   mu_D >= 1e-3 for every swing angle

    Parameters
        linkage : GripperLinkage
        limit : float [rad] - transmission angle that the remedy aims at
    Raises
        NoSolution - with the cylinder angle, and what to change by how much
    Source
        own derivation; a sign change of sin(th4 - th3) passes mu_D = 0
    """
    swing = np.linspace(0.0, linkage.law.total_swing, 1801)
    reach = _reach(linkage, linkage.local_output(swing))
    low, high = abs(linkage.input - linkage.coupler), linkage.input + linkage.coupler
    wrong = (reach > high) | (reach < low)
    if wrong.any():
        first = int(np.argmax(wrong))
        off = float(reach.max()) - high
        change = f"lengthen input or coupler by {safely_above(off, 4)} mm"
        if off <= 0.0:
            change = f"bring input and coupler {safely_above(low - float(reach.min()), 4)} mm nearer"
        raise NoSolution(
            f"the linkage cannot be assembled at cylinder angle {short(linkage.law.reaches(float(swing[first])))} deg: "
            f"AD {reach[first]:.6g} mm (reach {low:.6g} to {high:.6g} mm)",
            key="links",
            fix=change,
        )
    for extreme, (joint, one, other) in zip(linkage.least_transmission, _JOINTS, strict=True):
        if extreme.value < DEAD_POINT:
            raise NoSolution(
                f"dead centre at joint {joint} ({one} and {other} collinear): {math.degrees(extreme.value):.2g} deg "
                f"(limit >= {safely_above(math.degrees(DEAD_POINT), 2)} deg) at cylinder angle "
                f"{short(linkage.law.reaches(extreme.place))} deg",
                key="links",
                fix=turn_remedy(linkage, limit),
            )


def turn_remedy(linkage: GripperLinkage, limit: float, *, tells: bool = True) -> str:
    """Words for what brings the whole swing to a transmission angle [rad]: a revolution of ED, or a lesser swing.

    Parameters
        tells : bool - by how much ED is to be turned; not where cams stand that the turn may make impossible
    """
    limit = max(limit, _LEAST_AIM)
    turn, widest = clear_turn(linkage, limit)
    aim = f"(transmission angle {math.degrees(limit):g} deg)"
    if turn is not None:
        sign = "+" if turn > 0.0 else "-"
        angle = f" by {sign}{safely_above(abs(math.degrees(turn)), 4)} deg" if tells else ""
        return f"turn output_direction{angle} {aim}"
    swing = math.degrees(linkage.law.total_swing)
    if widest > 0.0:
        return (
            f"reduce the swing from {short(swing)} to {safely_below(math.degrees(widest))} deg {aim} by shorter phases"
        )
    return f"change links or pivots {aim}"


def clear_turn(linkage: GripperLinkage, limit: float) -> tuple[float | None, float]:
    """How to turn ED on the gripper so that both transmission angles keep a limit over the whole swing.

    Parameters
        linkage : GripperLinkage - the swing need not close
        limit : float [rad] - minimum angle between CD and ED and between AC and CD
    Returns
        turn : float [rad] or None - what to add to the output direction, the smallest; None where no direction
            serves the swing
        widest : float [rad] - the largest swing that keeps the limit with these links; 0 where none does
    Notes
        Directions of ED are tried every 0.1 deg; the result lies inside the exact range.
    """
    four_bar = linkage.four_bar
    directions = np.arange(-math.pi, 3.0 * math.pi, _STEP)
    reach = _reach(linkage, directions)
    low, high = abs(four_bar.crank - four_bar.coupler), four_bar.crank + four_bar.coupler
    good = (reach > low * (1.0 + 1e-9)) & (reach < high * (1.0 - 1e-9))
    if good.any():
        at_d, at_c = linkage.transmission(directions[good])
        good[good] = np.minimum(at_d, at_c) >= limit
    swing = linkage.law.total_swing
    start = math.remainder(linkage.output_direction - linkage.frame_direction, 2.0 * math.pi)
    first, last = sorted((start, start + linkage.swing_sense * swing))
    turns, widest = [], 0.0
    for left, right in _runs(directions, good):
        widest = max(widest, min(right - left, 2.0 * math.pi))
        if right - left >= swing:
            for turns_away in (-2.0 * math.pi, 0.0):
                window = (left + turns_away - first, right + turns_away - last)
                turns.append(min(max(0.0, window[0]), window[1]))
    return min(turns, key=abs, default=None), widest


def _reach(linkage: GripperLinkage, directions: Reals) -> Reals:
    """|AD| [mm] at directions of ED from the frame line."""
    reach: Reals = np.abs(linkage.four_bar.frame + linkage.output * np.exp(1j * directions))
    return reach


def _runs(places: Reals, good: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """First and last place of every unbroken run of good ones."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], good.astype(np.int8), [0]))))
    return [(float(places[i]), float(places[j - 1])) for i, j in zip(edges[::2], edges[1::2], strict=True)]
