"""Tables of a two-gear four-bar; each is a function of the design and the number of rows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.linkages.fourbar.position import solve
from gearlink.core.report import Table

if TYPE_CHECKING:
    from gearlink.core.planet_linkages.two_gear_design import TwoGearFourBar


def motion(design: TwoGearFourBar, samples: int | None = None) -> Table:
    """Output angle, speed and acceleration, coupler speed and transmission angle over a turn of the crank."""
    import numpy as np

    from gearlink.core.linkages.fourbar import sweep as fourbar_sweep
    from gearlink.core.linkages.fourbar.refine import dead_point_distance
    from gearlink.core.numerics.arrays import turn_degrees

    degrees, ratio = turn_degrees(samples), design.gear_ratio
    sweep = fourbar_sweep.solve(design.linkage, np.radians(degrees), 2)
    start = solve(design.linkage, 0.0).coupler_angle
    output = (1.0 - ratio) * degrees + ratio * np.degrees(sweep.coupler_angle - start)
    columns = {
        "crank_angle": (degrees, "deg"),
        "output_angle": (output, "deg"),
        "speed_ratio": ((1.0 - ratio) + ratio * sweep.coupler_velocity, "1"),
        "acceleration_ratio": (ratio * sweep.coupler_acceleration, "1"),
        "coupler_ratio": (sweep.coupler_velocity, "1"),
        "transmission_angle": (np.degrees(dead_point_distance(sweep.transmission_angle)), "deg"),
    }
    rates = {
        "output_speed": ("speed_ratio", 1),
        "output_acceleration": ("acceleration_ratio", 2),
        "coupler_speed": ("coupler_ratio", 1),
    }
    return Table.of("motion", design.timed(columns, "crank_angle", rates))


def links(design: TwoGearFourBar, samples: int | None = None) -> Table:
    """Angle, speed, acceleration and jerk of every link over a turn of the crank."""
    import numpy as np

    from gearlink.core.linkages.fourbar.link_motion import columns, combined, four_bar_motions
    from gearlink.core.numerics.arrays import turn_degrees

    degrees = turn_degrees(samples)
    motions = four_bar_motions(design.linkage, np.radians(degrees))
    start, still = solve(design.linkage, 0.0), np.zeros_like(degrees)
    carrier = (np.radians(degrees), np.ones_like(degrees), still, still)
    coupler = (motions["coupler"][0] - start.coupler_angle, *motions["coupler"][1:])
    motions["output"] = combined((1.0 - design.gear_ratio, carrier), (design.gear_ratio, coupler))
    whole, rates = columns(motions)
    return Table.of("links", design.timed({"crank_angle": (degrees, "deg"), **whole}, "crank_angle", rates))
