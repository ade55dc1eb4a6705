"""Tables of a three-gear four-bar; each is a function of the design and the number of rows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals

_UNITS = 8.0


def motion(design: ThreeGearFourBar, samples: int | None = None) -> Table:
    """Output angle, speed and acceleration, transmission angle over a turn of the crank."""
    from gearlink.core.machines.three_gear.mechanism import OUTPUT
    from gearlink.core.mechanism.courses import Shown, between, motion_table

    shown = [
        Shown("output_angle", OUTPUT),
        Shown("speed_ratio", OUTPUT, 1, "output_speed"),
        Shown("acceleration_ratio", OUTPUT, 2, "output_acceleration"),
        Shown("transmission_angle", between("coupler", "rocker")),
    ]
    return motion_table("motion", design, shown, samples)


def links(design: ThreeGearFourBar, samples: int | None = None) -> Table:
    """Angle, speed, acceleration and jerk of every link and gear over a turn, and the pole P15 on the line AD."""
    from gearlink.core.mechanism.courses import Shown, all_rates, motion_table, turned
    from gearlink.core.mechanism.motion import Course

    names = ("coupler", "rocker", "idler", "output")
    shown = all_rates({name: turned(name) for name in names})
    pole = Course("mm", lambda mechanism: [_pole(design, mechanism)])
    return motion_table("links", design, [*shown, Shown("pole_x", pole)], samples)


def _pole(design: ThreeGearFourBar, mechanism: Mechanism) -> Reals:
    """AP15 = W AD/(W - 1) from w5/w1 = AP15/DP15 [mm]; NaN where both gears turn at one speed.

    Notes
        W - 1 is a sum with the terms 1, i1, i2 w2/w1 and i3 w3/w1, each off by some units in the last place, the speeds
        of the links by 1/sin(transmission angle) times as many. Where the sum is not above eight units of its terms, no
        digit of the pole is known: the gears turn at one speed, and the pole lies at infinity.
    """
    import numpy as np

    speed = mechanism.links["output"].turn.first
    faster = speed - 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        known = np.abs(faster) > _UNITS * np.finfo(float).eps * _terms(design, mechanism)
        return np.where(known, design.frame_length * speed / faster, np.nan)


def _terms(design: ThreeGearFourBar, mechanism: Mechanism) -> Reals:
    """The size of what W - 1 is summed from, with the condition of the speeds of the links."""
    import numpy as np

    train, coupler, rocker = design.train, mechanism.links["coupler"].turn, mechanism.links["rocker"].turn
    condition = 1.0 / np.abs(np.sin(coupler.value - rocker.value))
    of_links = np.abs(train.coupler_share * coupler.first) + np.abs(train.rocker_share * rocker.first)
    return np.asarray(1.0 + abs(train.ratio) + condition * of_links)
