"""Where `loads.cylinder_direction` and `loads.gear_1_direction` put cylinder and gears, against what the machine is."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.base.report import Check
from gearlink.core.machines.flatbed_press.codes import PLACE

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.loads import PressLoads

PLACE_CHECKS = PLACE.checks
_NEAR = 1.0
"""A direction of whole degrees [deg]."""
_DRAWN = (
    "loads.bed_side -1, with gravity [9.81, 0], is the machine as drawn, in which it stands on the bed and runs with it"
)


class _Places(NamedTuple):
    """Where the parts stand in the frame of the loads [mm]."""

    axes: dict[str, complex]
    """of the shafts that stand still, those that are known"""
    cylinder: complex
    slide: float
    """x of the slide line"""
    pitch_line: float
    """x of the pitch line of the bed's rack"""


def _places(design: PressLoads) -> _Places:
    """Out of the joints that bear the forces; without a direction of gear 1 its axis stands on the slide line."""
    pins, racks = design.places
    slide, known = pins["F"].real, design.section.gear_1_direction is not None
    shift = 0.0 if known else slide - pins["G"].real
    axes = {name: pins[name] for name in "ADGN"} if known else {}
    return _Places(axes, pins["cylinder"] + shift, slide, racks["rack_upper"].real)


def cylinder_place(design: PressLoads) -> Iterator[Check]:
    """GL516: the cylinder beside the bed on which it rolls, and beside the axes."""
    direction = design.section.cylinder_direction
    if direction is None:
        return
    at, radius = _places(design), design.spec.cylinder.radius
    yield _beside_bed(design, at, direction)
    for name, axis in at.axes.items():
        room = abs(at.cylinder - axis) - radius
        if room < 0.0:
            text = f"with loads.cylinder_direction {direction:g} the cylinder reaches"
            text += f" {-room:.5g} mm over the axis {name}: its shaft cannot pass there"
            yield PLACE.check("warn", text, room, 0.0, "mm")


def _beside_bed(design: PressLoads, at: _Places, direction: float) -> Check:
    """The bed runs along +y, the cylinder turns counter-clockwise: at the printing line, which lies at the greatest x
    of the cylinder, both run the same way."""
    radius = design.spec.cylinder.radius
    room = at.pitch_line - at.cylinder.real - radius
    text = f"with loads.cylinder_direction {direction:g} the cylinder"
    if at.cylinder.real >= at.pitch_line:
        text += " lies on the side of the bed on which its surface runs against the bed's: "
    elif design.section.bed_side > 0:
        over = at.cylinder.real + radius > at.slide
        text += f" lies on the side of the pinion{', over the slide line' if over else ''}: "
    elif room < 0.0:
        text += f" reaches {-room:.5g} mm through the pitch line of the bed's rack: "
    else:
        text += f" runs with the bed, {room:.5g} mm clear of the pitch line of its rack"
        return PLACE.check("pass", text, room, 0.0, "mm")
    help_ = _DRAWN if design.section.bed_side > 0 else _clear(design, at, direction)
    return PLACE.check("warn", text + help_, room, 0.0, "mm")


def _clear(design: PressLoads, at: _Places, direction: float) -> str:
    """The directions in which the cylinder stands clear of the bed's rack."""
    distance = sum(design.pitch_radii)
    n = at.cylinder.real - distance * math.cos(math.radians(direction))
    share = (at.pitch_line - design.spec.cylinder.radius - n) / distance
    if share < -1.0:
        return f"no direction does, the gears are {distance:.5g} mm apart and {-share * distance:.5g} are needed"
    least = math.degrees(math.acos(share))
    low, high = math.ceil(10.0 * least) / 10.0, math.floor(10.0 * (360.0 - least)) / 10.0
    return f"from {low:g} to {high:g} deg it runs with the bed, clear of its rack"


def gear_direction(design: PressLoads) -> Iterator[Check]:
    """GL516: the direction from A to G against that of the axes' distances."""
    given, gears, bed = design.section.gear_1_direction, design.spec.input_gears, design.spec.bed
    if given is None or gears is None:
        return
    across, up = gears.horizontal_distance, bed.double_crank.frame - bed.offset
    wanted = math.degrees(math.atan2(across, up))
    off = min(abs(math.remainder(given - side * wanted, 360.0)) for side in (1.0, -1.0))
    text = (
        f"loads.gear_1_direction {given:g} is {off:.3g} deg from where the axes stand: horizontal_distance "
        f"{across:g} mm, and G on the height of the slide line"
    )
    name = PLACE.checks[1]
    if off > _NEAR:
        text += f", is {wanted:.5g} deg, or {-wanted:.5g} deg as drawn"
    yield PLACE.check("warn" if off > _NEAR else "pass", text, off, _NEAR, "deg", name=name, side="<=")
