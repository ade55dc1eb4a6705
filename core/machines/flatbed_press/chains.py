"""The two chains of a flatbed cylinder press: travel of cylinder and bed over the input angle.

One turn of the input is one sheet. The bed drive is a drag link A-B-C-D, whose driven crank CD carries the crank
DE of the slider-crank D-E-F at the fixed angle CDE; a pinion on the slider F doubles its travel to the bed. The
cylinder drive is a drag link G-H-M-N, whose crank turns against the input. All derivatives are with respect to
the input angle and come from the chain rule.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.report import safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.parts.linkages import slider_crank
from gearlink.core.parts.linkages.dyad import acute
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.loop import Reading, rocker_and_rate, rocker_rate
from gearlink.core.parts.linkages.fourbar.position import FourBar


class Travel(NamedTuple):
    """A displacement and its derivatives with respect to the input angle; floats, or arrays of one shape.

    Rates beyond the order asked for are not computed and hold NaN.
    """

    value: Any
    first: Any = math.nan
    second: Any = math.nan


@dataclass(frozen=True)
class CylinderChain:
    """Drag link G-H-M-N and the gears from MN to the cylinder.

    Parameters
        linkage : FourBar - GH, HM, MN, NG [mm]
        initial_angle : float [rad] - direction of GH from the line G-N at input angle 0
        radius : float [mm] - of the cylinder
        gear_ratio : float - cylinder revolutions per revolution of MN
    Raises
        NoSolution - when the linkage is not a drag link
    Source
        TY-460 report 1 and 5
    """

    linkage: FourBar
    initial_angle: float
    radius: float
    gear_ratio: float

    def __post_init__(self) -> None:
        _require_drag_link(self.linkage, "cylinder")

    @cached_property
    def _start(self) -> float:
        return fourbar.solve(self.linkage, self.initial_angle).rocker_angle

    def travel(self, input_angle: Any, order: int = 0) -> Travel:
        """Surface travel of the cylinder [mm], with `order` derivatives; float in, floats out, arrays likewise.

        q(phi) = R i (theta_MN(phi_GH0) - theta_MN(phi_GH0 - phi))

        Parameters
            input_angle : float or (N,) array [rad] - any angle; a whole revolution adds one revolution of MN
            order : 0, 1 or 2
        Source
            TY-460 report 1.2; sense of rotation recovered from its numbers
        """
        state = _solver(input_angle).solve(self.linkage, self.initial_angle - input_angle, order)
        scale = self.radius * self.gear_ratio
        value = scale * (self._start - state.rocker_angle)
        if order == 0:
            return Travel(value)
        # phi_GH falls as the input rises: the sign turns in q, and a second time in q'.
        first = scale * state.rocker_velocity
        return Travel(value, first) if order == 1 else Travel(value, first, -scale * state.rocker_acceleration)

    def speed(self, input_angle: float) -> float:
        """First derivative of `travel` [mm/rad] at one input angle, to the last bit the same and nothing else."""
        return self.radius * self.gear_ratio * rocker_rate(self.linkage.reading, self.initial_angle - input_angle)

    def position(self, input_angle: float) -> tuple[float, float]:
        """Travel [mm] and its first derivative [mm/rad] at one input angle, and nothing else."""
        rocker, rate = rocker_and_rate(self.linkage.reading, self.initial_angle - input_angle)
        scale = self.radius * self.gear_ratio
        return scale * (self._start - rocker), scale * rate

    @property
    def turn(self) -> float:
        """Travel of a revolution of the input [mm]."""
        return 2.0 * math.pi * self.radius * self.gear_ratio


@dataclass(frozen=True)
class BedChain:
    """Drag link A-B-C-D, slider-crank D-E-F and the doubling pinion.

    Parameters
        linkage : FourBar - AB, BC, CD, DA [mm]
        crank_offset_angle : float [rad] - angle CDE: the direction of DE is that of DC less this angle
        slider_crank_length, rod, offset : float [mm] - DE, EF and the offset of the slide line from D
    Raises
        NoSolution - when the linkage is not a drag link
    Source
        TY-460 report 2 and 5
    """

    linkage: FourBar
    crank_offset_angle: float
    slider_crank_length: float
    rod: float
    offset: float

    def __post_init__(self) -> None:
        _require_drag_link(self.linkage, "bed")

    @cached_property
    def initial_crank_angle(self) -> float:
        """Direction of AB [rad] at the start, where D, E and F stand in line, stretched.

        psi_0 = -pi/2 - asin(e/(EF + DE)),  theta_DC = psi_0 + CDE

        Source
            TY-460 report 2.2
        """
        psi = -0.5 * math.pi - math.asin(self.offset / (self.rod + self.slider_crank_length))
        angle = fourbar.solve_inverse(self.linkage, psi + self.crank_offset_angle).crank_angle
        return math.remainder(angle, 2.0 * math.pi)

    @cached_property
    def _start(self) -> tuple[float, float]:
        """Rocker direction and slider depth at the start."""
        rocker = fourbar.solve(self.linkage, self.initial_crank_angle).rocker_angle
        return rocker, self._slider(rocker, 0)[0]

    @cached_property
    def inverse(self) -> Reading:
        """The linkage with CD driving."""
        return fourbar.inverse_reading(self.linkage)

    @cached_property
    def start_input(self) -> float:
        """Direction of AB at the start, as it is found from that of CD [rad]."""
        return fourbar.solve_inverse(self.linkage, self._start[0]).crank_angle

    @property
    def cam_angle_start(self) -> float:
        """Direction of DC [rad] at the start, from which the cam angle counts."""
        return self._start[0]

    def _slider(self, rocker: Any, order: int) -> Any:
        psi = rocker - self.crank_offset_angle
        return _slider(psi)(psi, self.slider_crank_length, self.rod, self.offset, order)

    def cam_angle(self, input_angle: Any, order: int = 0) -> Travel:
        """Angle turned by CD [rad], which is the cam angle, with `order` derivatives."""
        state = _solver(input_angle).solve(self.linkage, self.initial_crank_angle + input_angle, order)
        value = state.rocker_angle - self._start[0]
        if order == 0:
            return Travel(value)
        first = state.rocker_velocity
        return Travel(value, first) if order == 1 else Travel(value, first, state.rocker_acceleration)

    def speed(self, input_angle: float) -> float:
        """First derivative of `travel` [mm/rad] at one input angle, to the last bit the same and nothing else."""
        rocker, rate = rocker_and_rate(self.linkage.reading, self.initial_crank_angle + input_angle)
        start = self._start[0]
        psi = start + (rocker - start) - self.crank_offset_angle
        depth = slider_crank.slider(psi, self.slider_crank_length, self.rod, self.offset, 1)
        return float(-2.0 * depth[1] * rate)

    def input_angle(self, cam_angle: Any) -> Any:
        """Input angle [rad] at a cam angle [rad]; a drag link gives exactly one."""
        linkage = self.linkage if isinstance(cam_angle, (float, int)) else self.inverse
        state = _solver(cam_angle).solve_inverse(linkage, self._start[0] + cam_angle)
        return state.crank_angle - self.start_input

    def travel(self, input_angle: Any, order: int = 0, cam: Travel | None = None) -> Travel:
        """Travel of the bed [mm] before compensation, with `order` derivatives.

        p = 2 (h_0 - h(psi)),  h the depth of F below D

        Parameters
            input_angle : float or (N,) array [rad]
            order : 0, 1 or 2
            cam : Travel - the cam angle at `input_angle` where the caller has it already
        Source
            TY-460 report 2.2, with the product of cosines in its program corrected to a sum
        """
        cam = self.cam_angle(input_angle, order) if cam is None else cam
        depth = self._slider(self._start[0] + cam.value, order)
        value = 2.0 * (self._start[1] - depth[0])
        if order == 0:
            return Travel(value)
        first = -2.0 * depth[1] * cam.first
        if order == 1:
            return Travel(value, first)
        return Travel(value, first, -2.0 * (depth[2] * cam.first * cam.first + depth[1] * cam.second))


def difference(bed: BedChain, cylinder: CylinderChain, input_angle: Any, order: int = 0) -> Travel:
    """Travel of the bed less that of the cylinder [mm], with `order` derivatives by the input angle.

    Source
        TY-460 report 3.3
    """
    p, q = bed.travel(input_angle, order), cylinder.travel(input_angle, order)
    if order == 0:
        return Travel(p.value - q.value)
    if order == 1:
        return Travel(p.value - q.value, p.first - q.first)
    return Travel(p.value - q.value, p.first - q.first, p.second - q.second)


def least_transmission_crank(linkage: FourBar) -> float:
    """Crank angle at which the transmission angle of a full revolution is smallest: 0 or pi [rad].

    Raises
        NoSolution - when the crank does not turn fully
    Example
        >>> least_transmission_crank(FourBar(116.0, 100.0, 100.0, 37.0)) == math.pi
        False

    Source
        thesis 4.2 (transmission angle)
    """
    at_0, at_pi = map(acute, linkage.transmission_extremes())
    return 0.0 if at_0 <= at_pi else math.pi


def least_transmission_input(chain: BedChain | CylinderChain) -> float:
    """Input angle in [0, 2 pi) at which the transmission angle of a chain is smallest [rad].

    Source
        own derivation: the crank lies along the frame there
    """
    crank = least_transmission_crank(chain.linkage)
    turned = crank - chain.initial_crank_angle if isinstance(chain, BedChain) else chain.initial_angle - crank
    return turned % (2.0 * math.pi)


def _solver(angle: Any) -> Any:
    """The scalar kernel for a float; the array kernel, and numpy with it, only for arrays."""
    if isinstance(angle, (float, int)):
        return fourbar
    from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep

    return fourbar_sweep


def _slider(angle: Any) -> Any:
    if isinstance(angle, (float, int)):
        return slider_crank.slider

    return slider_crank.slider_sweep


def _require_drag_link(linkage: FourBar, chain: str) -> None:
    kind = linkage.kind()
    if kind == "drag-link":
        return
    shortest, p, q, longest = sorted((linkage.crank, linkage.coupler, linkage.rocker, linkage.frame))
    excess = math.fsum((shortest, longest, -p, -q))
    wrong, changes = [], []
    if excess >= 0.0:
        wrong.append(f"{short(shortest)} + {short(longest)} {'=' if excess == 0.0 else '>'} {short(p)} + {short(q)}")
        by = f", by more than {safely_above(excess)} mm" if excess > 0.0 else ""
        changes.append(f"shorten the longest link, {short(longest)} mm{by}")
    if linkage.frame > shortest:
        wrong.append(f"frame {short(linkage.frame)} mm is not the shortest link")
        changes.append("make the frame the shortest link")
    found = {"impossible": "the four links cannot be assembled", "change-point": "at its change point"}.get(
        kind, f"a {kind}"
    )
    with at_key(f"{chain}.double_crank"):
        raise NoSolution(
            f"{chain} drive: {found}, not a drag link, both of whose cranks turn fully ({', '.join(wrong)})",
            fix=", and ".join(changes),
        )
