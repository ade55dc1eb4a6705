"""Where the joints of a flatbed press's two chains stand, and how fast the driven ones move.

Each chain has its own frame, as in `gearlink.core.flatbed_press.chains`: the origin is the pivot of the driving crank
and the frame link lies along +x, so the slide of the bed chain runs along -y. Velocities are by the input angle, in
mm/rad.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.flatbed_press.chains import BedChain, CylinderChain
from gearlink.core.linkages.dyad import acute
from gearlink.core.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.linkages.slider_crank import sweep as slider_crank_sweep
from gearlink.core.numerics.arrays import Points, Reals

_TURN = 2.0 * math.pi


@dataclass(frozen=True, slots=True)
class BedPositions:
    """Joints of the bed chain [mm], complex arrays over the input angle; the pivots A and D stand still."""

    a: complex
    b: Points
    c: Points
    d: complex
    e: Points
    f: Points
    f_velocity: Points
    """of the slider F [mm/rad], half the bed's"""


@dataclass(frozen=True, slots=True)
class CylinderPositions:
    """Joints of the cylinder chain [mm], complex arrays over the input angle; the pivots G and N stand still."""

    g: complex
    h: Points
    m: Points
    n: complex
    m_velocity: Points
    """of the crank pin M [mm/rad]"""


def bed_positions(chain: BedChain, input_angle: Reals) -> BedPositions:
    """Joints of A-B-C-D-E-F at input angles.

    B = a e^(i phi),  C = d + c e^(i psi),  E = d + r e^(i (psi - CDE)),  F = d - e - i h

    Parameters
        chain : BedChain
        input_angle : (N,) array [rad]
    Returns
        positions : BedPositions
    Example
        >>> drag = FourBar(116.0, 100.0, 100.0, 37.0)
        >>> press = BedChain(drag, math.radians(177.0), 154.21159203908383, 520.0, 50.0)
        >>> complex(np.round(bed_positions(press, np.array([0.0])).f[0], 6))
        (-13-672.355018j)

    Source
        TY-460 report 2.2
    """
    linkage = chain.linkage
    cam = chain.cam_angle(input_angle, 1)
    travel = chain.travel(input_angle, 1, cam)
    at_start = fourbar_sweep.solve(linkage, np.array([chain.initial_crank_angle])).rocker_angle[0]
    psi = at_start + cam.value
    d = complex(linkage.frame)
    crank = psi - chain.crank_offset_angle
    depth = slider_crank_sweep.slider(crank, chain.slider_crank_length, chain.rod, chain.offset)[0]
    return BedPositions(
        a=0j,
        b=linkage.crank * np.exp(1j * (chain.initial_crank_angle + input_angle)),
        c=d + linkage.rocker * np.exp(1j * psi),
        d=d,
        e=d + chain.slider_crank_length * np.exp(1j * crank),
        f=np.asarray((d - chain.offset) - 1j * depth, dtype=np.complex128),
        f_velocity=0.5j * travel.first,
    )


def cylinder_positions(chain: CylinderChain, input_angle: Reals) -> CylinderPositions:
    """Joints of G-H-M-N at input angles.

    H = a e^(i (phi_GH0 - phi)),  M = d + c e^(i psi)

    Parameters
        chain : CylinderChain
        input_angle : (N,) array [rad]
    Returns
        positions : CylinderPositions
    Example
        >>> chain = CylinderChain(FourBar(100.0, 100.0, 95.0, 40.0, -1), math.radians(57.109), 140.0, 1.0)
        >>> at = cylinder_positions(chain, np.array([0.0]))
        >>> round(float(abs(at.m - at.h)[0]), 9)
        100.0

    Source
        TY-460 report 1.2
    """
    linkage = chain.linkage
    crank = chain.initial_angle - input_angle
    state = fourbar_sweep.solve(linkage, crank, 1)
    arm = linkage.rocker * np.exp(1j * state.rocker_angle)
    d = complex(linkage.frame)
    # The crank turns against the input.
    return CylinderPositions(0j, linkage.crank * np.exp(1j * crank), d + arm, d, -1j * state.rocker_velocity * arm)


def least_transmission_crank(linkage: FourBar) -> float:
    """Crank angle at which the transmission angle of a full turn is least: 0 or pi [rad].

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
    """Input angle in [0, 2 pi) at which the transmission angle of a chain is least [rad].

    Source
        own derivation: the crank lies along the frame there
    """
    crank = least_transmission_crank(chain.linkage)
    turned = crank - chain.initial_crank_angle if isinstance(chain, BedChain) else chain.initial_angle - crank
    return turned % _TURN
