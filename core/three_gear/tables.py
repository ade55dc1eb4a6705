"""Tables of a three-gear four-bar; each is a function of the design and the number of rows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.report import Table

if TYPE_CHECKING:
    from gearlink.core.linkages.fourbar.link_motion import Motion
    from gearlink.core.three_gear.design import ThreeGearFourBar


_UNITS = 8.0


def motion(design: ThreeGearFourBar, samples: int | None = None) -> Table:
    """Output angle, speed and acceleration, transmission angle over a turn of the crank."""
    import numpy as np

    from gearlink.core.numerics.arrays import turn_degrees
    from gearlink.core.three_gear.sweep import output_motion

    degrees = turn_degrees(samples)
    sweep = output_motion(design.linkage, design.train, np.radians(degrees))
    columns = {
        "crank_angle": (degrees, "deg"),
        "output_angle": (np.degrees(sweep.output_angle), "deg"),
        "speed_ratio": (sweep.speed_ratio, "1"),
        "acceleration_ratio": (sweep.acceleration_ratio, "1"),
        "transmission_angle": (np.degrees(sweep.transmission_angle), "deg"),
    }
    rates = {"output_speed": ("speed_ratio", 1), "output_acceleration": ("acceleration_ratio", 2)}
    return Table.of("motion", design.timed(columns, "crank_angle", rates))


def links(design: ThreeGearFourBar, samples: int | None = None) -> Table:
    """Angle, speed, acceleration and jerk of every link and gear over a turn, and the pole P15 on the line AD.

    AP15 = W AD/(W - 1) from w5/w1 = AP15/DP15; none where both gears turn at one speed

    Notes
        W - 1 is a sum with the terms 1, i1, i2 w2/w1 and i3 w3/w1, each off by some units in the last place, the speeds
        of the links by 1/sin(transmission angle) times as many. Where the sum is not above eight units of its terms, no
        digit of the pole is known: the gears turn at one speed, and the pole lies at infinity.
    """
    import numpy as np

    from gearlink.core.linkages.fourbar.link_motion import columns, four_bar_motions
    from gearlink.core.numerics.arrays import turn_degrees

    degrees = turn_degrees(samples)
    motions = four_bar_motions(design.linkage, np.radians(degrees))
    whole, rates = columns({**motions, **_gears(design, np.radians(degrees), motions)})
    speed = whole["output_speed_ratio"][0]
    faster = speed - 1.0
    with np.errstate(divide="ignore", invalid="ignore"):
        known = np.abs(faster) > _UNITS * np.finfo(float).eps * _terms(design, motions)
        pole = np.where(known, design.frame_length * speed / faster, np.nan)
    columns_ = {"crank_angle": (degrees, "deg"), **whole, "pole_x": (pole, "mm")}
    return Table.of("links", design.timed(columns_, "crank_angle", rates))


def _terms(design: ThreeGearFourBar, motions: dict[str, Motion]) -> Any:
    """The size of what W - 1 is summed from, with the condition of the speeds of the links."""
    import numpy as np

    (coupler, coupler_speed, *_), (rocker, rocker_speed, *_) = motions["coupler"], motions["rocker"]
    train, condition = design.train, 1.0 / np.abs(np.sin(coupler - rocker))
    of_links = np.abs(train.coupler_share * coupler_speed) + np.abs(train.rocker_share * rocker_speed)
    return 1.0 + abs(train.ratio) + condition * of_links


def _gears(design: ThreeGearFourBar, crank: Any, motions: dict[str, Motion]) -> dict[str, Motion]:
    """Idler and output gear, 0 at crank angle 0: w3 = (1 + r1/r3) w2 - (r1/r3) w1, and thesis (4-24)."""
    import numpy as np

    from gearlink.core.linkages.fourbar.link_motion import combined
    from gearlink.core.linkages.fourbar.position import solve

    start, still = solve(design.linkage, 0.0), np.zeros_like(crank)
    steady = (crank, np.ones_like(crank), still, still)
    coupler = (motions["coupler"][0] - start.coupler_angle, *motions["coupler"][1:])
    rocker = (motions["rocker"][0] - start.rocker_angle, *motions["rocker"][1:])
    ratio, train = design.crank_teeth / design.idler_teeth, design.train
    return {
        "idler": combined((1.0 + ratio, coupler), (-ratio, steady)),
        "output": combined((train.ratio, steady), (train.coupler_share, coupler), (train.rocker_share, rocker)),
    }
