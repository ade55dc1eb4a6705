"""Tables of a two-gear four-bar; each is a function of the design and the number of rows."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar


def motion(design: TwoGearFourBar, samples: int | None = None) -> Table:
    """Output angle, speed and acceleration, coupler speed and transmission angle over a turn of the crank."""
    from gearlink.core.machines.planet_linkages.mechanism import OUTPUT
    from gearlink.core.mechanism.courses import Shown, between, motion_table, turned

    shown = [
        Shown("output_angle", OUTPUT),
        Shown("speed_ratio", OUTPUT, 1, "output_speed"),
        Shown("acceleration_ratio", OUTPUT, 2, "output_acceleration"),
        Shown("coupler_ratio", turned("coupler"), 1, "coupler_speed"),
        Shown("transmission_angle", between("coupler", "rocker")),
    ]
    return motion_table("motion", design, shown, samples)


def links(design: TwoGearFourBar, samples: int | None = None) -> Table:
    """Angle, speed, acceleration and jerk of every link over a turn of the crank."""
    from gearlink.core.mechanism.courses import all_rates, motion_table, turned

    shown = all_rates({name: turned(name) for name in ("coupler", "rocker", "output")})
    return motion_table("links", design, shown, samples)
