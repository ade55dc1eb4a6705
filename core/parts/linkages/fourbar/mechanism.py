"""A four-bar as links and joints, for all machines that hold one."""

from __future__ import annotations

from collections.abc import Mapping

from gearlink.core.mechanism.courses import between, turned
from gearlink.core.mechanism.dynamics import Mass
from gearlink.core.mechanism.joints import Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Turn, fixed, steady
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar


def turns(linkage: FourBar, crank_angle: Reals, order: int, *, velocity: float = 1.0) -> tuple[Turn, Turn]:
    """Angles of coupler and rocker, with so many derivatives for a crank that turns evenly with a velocity."""
    sweep = fourbar_sweep.solve(linkage, crank_angle, order, velocity=velocity)
    coupler = (sweep.coupler_angle, sweep.coupler_velocity, sweep.coupler_acceleration, sweep.coupler_jerk)
    rocker = (sweep.rocker_angle, sweep.rocker_velocity, sweep.rocker_acceleration, sweep.rocker_jerk)
    return Turn(*coupler[: order + 1]), Turn(*rocker[: order + 1])


def four_bar(linkage: FourBar, phi: Reals, order: int = 2) -> dict[str, Link]:
    """Crank, coupler and rocker at crank angles, A at 0 and D on +x; lengths in mm.

    Parameters
        linkage : FourBar [mm]
        phi : (N,) array [rad] - crank angles, which are the input angles
        order : 0..3 - of the derivatives
    Returns
        links : crank (A->B), coupler (B->C), rocker (D->C), with those points by name
    Raises
        NoSolution - where the linkage does not close
    Example
        >>> import numpy as np
        >>> links = four_bar(FourBar(18.0, 50.0, 100.0, 121.4), np.array([0.0]))
        >>> round(float(links["rocker"].turn.first[0]), 9)
        -0.174081238
    """
    coupler, rocker = turns(linkage, phi, order)
    crank = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": linkage.crank})
    return {
        "crank": crank,
        "coupler": Link(crank.at("B"), coupler, {"B": 0.0, "C": linkage.coupler}),
        "rocker": Link(fixed(linkage.frame, phi, order=order), rocker, {"D": 0.0, "C": linkage.rocker}),
    }


def four_bar_pins(links: Mapping[str, Link]) -> list[Pin]:
    """A, B, C, D of these links."""
    return [
        Pin("A", FRAME, "crank", links["crank"].origin.value),
        Pin("B", "crank", "coupler", links["coupler"].origin.value),
        Pin("C", "coupler", "rocker", links["rocker"].at("C").value),
        Pin("D", FRAME, "rocker", links["rocker"].origin.value),
    ]


def four_bar_motion(linkage: FourBar) -> Motion:
    """A four-bar by itself over its crank angle, A at 0 and D on +x."""

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        links = four_bar(linkage, phi, order)
        return Mechanism(links, four_bar_pins(links), "crank")

    outputs = (Output("Rocker CD", turned("rocker")),)
    return Motion(make, Input("crank_angle"), outputs, transmission=between("coupler", "rocker"))


def full_balance(linkage: FourBar, masses: Mapping[str, Mass], at_c: float = 0.0) -> dict[str, complex]:
    """Mass moments of the counterweights that take the whole shaking force of a four-bar away.

    U_1 = -[m1 z1 + m2 a (1 - z2/b)],  U_3 = -[m3 z3 + m2 c z2/b + m_C c]

    Parameters
        linkage : FourBar [mm]
        masses : by link - crank, coupler, rocker
        at_c : float [kg] - mass of what turns on C
    Returns
        moments : complex [kg mm] by link - of crank and rocker, in their coordinates
    Example
        >>> moments = full_balance(FourBar(40.0, 120.0, 100.0, 140.0), {"crank": Mass(2.0, 0.0, 10.0)})
        >>> moments["crank"].real, abs(moments["rocker"])
        (-20.0, 0.0)

    Source
        linearly independent vectors (Berkof and Lowen, 1969)
    """
    a, b, c = linkage.crank, linkage.coupler, linkage.rocker
    crank, coupler, rocker = (masses.get(name, Mass()) for name in ("crank", "coupler", "rocker"))
    share = coupler.center / b
    return {
        "crank": -(crank.mass * crank.center + coupler.mass * a * (1.0 - share)),
        "rocker": -(rocker.mass * rocker.center + coupler.mass * c * share + at_c * c),
    }
