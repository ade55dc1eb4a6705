"""Directions of a press's loads that its own geometry contradicts, and where the frames of its bodies lie."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

PRESS = "loaded_press"
REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())["press"]
SLOW = 0.001
"""Sheets an hour: what is left of the forces of motion is below 1e-12 N."""


def _press(**keys: Any) -> Any:
    return factory.design(PRESS, command="loads", **keys)


def _places(press: Any) -> list[tuple[str, str]]:
    return [(check.status, "; ".join(check.lines)) for check in press.check("cylinder-place")]


# Directions


def test_the_worked_press_stands_as_its_geometry_has_it() -> None:
    """N is 40 mm above G, the cylinder's axis 272 mm from it at 151 deg from the vertical downwards.

    The pitch line lies 100 mm above the slide. Three digits of the direction from A to G leave 1.5e-3 mm.
    """
    press = _press()
    (place,), (gear,) = press.check("cylinder-place"), press.check("gear-direction")
    height = 13.0 + 40.0 - 272.0 * math.cos(math.radians(151.0))
    assert (place.code, place.status) == ("GL516", "pass")
    assert place.value == pytest.approx(height - 140.0 - (13.0 + 100.0), abs=2e-3)
    assert (gear.code, gear.status, gear.limit) == ("GL516", "pass", 1.0)
    assert gear.value == pytest.approx(abs(-92.567 + math.degrees(math.atan2(290.0, -13.0))), abs=1e-9)


def test_the_frame_of_the_theory_warns_and_does_not_fail() -> None:
    press = factory.design("ty460", command="loads", loads=REFERENCE["loads"])
    assert "fail" not in {check.status for check in press.report("loads").checks}
    (found, *axes) = _places(press)
    assert found[0] == "warn"
    assert "runs against the bed; set loads.bed_side to -1 and gravity to [9.81, 0]" in found[1].replace("fix: ", "")
    assert axes == []
    assert [check.status for check in press.check("gear-direction")] == ["pass"]


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"cylinder_direction": -140}, "distance of the cylinder from the pitch line of the bed's rack: 8.36"),
        ({"cylinder_direction": -130}, "overlap of the cylinder and the pitch line of the bed's rack: 25.1"),
        ({"cylinder_direction": 0}, "runs against the bed"),
        ({"cylinder_direction": 150, "bed_side": 1}, "on the side of the pinion"),
        ({"cylinder_direction": 100, "bed_side": 1}, "on the side of the pinion, over the slide line"),
        ({"cylinder_direction": 170, "cylinder_gear_radius": 50}, "overlap of the cylinder and the pitch line"),
    ],
)
def test_where_the_cylinder_lies_is_told(keys: dict[str, Any], words: str) -> None:
    """53 + 272 sin 50 deg - 140 - 113 = 8.364 mm, 40 deg instead: -25.16; 272 sin 47.33 deg = 200."""
    first, *_ = _places(_press(**{f"loads__{name}": value for name, value in keys.items()}))
    assert words in first[1]
    assert first[0] == ("pass" if first[1].startswith("distance of the cylinder from the pitch line") else "warn")


def test_the_directions_that_are_named_are_clear_to_the_tenth() -> None:
    """Their ends hold, a tenth of a degree beyond them does not."""
    (_, message), *_ = _places(_press(loads__cylinder_direction=0))
    low, high = (float(word) for word in message.partition(" from ")[2].removesuffix(" deg").split()[0:3:2])
    for at, beyond in ((low, low - 0.1), (high, high + 0.1)):
        assert _places(_press(loads__cylinder_direction=at - 360.0))[0][0] == "pass"
        assert _places(_press(loads__cylinder_direction=beyond - 360.0))[0][0] == "warn"


def test_gears_too_near_for_any_direction_are_told_how_far_apart_they_must_be() -> None:
    """Above N at 13 + 40 mm the axis must stand 113 + 140 mm high: 200 mm, to the three digits of a direction."""
    (_, message), *_ = _places(_press(loads__cylinder_direction=170, loads__cylinder_gear_radius=50))
    least = float(message.partition("set the gears at least ")[2].removesuffix(" mm apart"))
    assert 199.99 < least < 200.1


def test_a_cylinder_over_an_axis_is_told_by_how_much() -> None:
    found = _places(_press(loads__cylinder_direction=90))
    press = _press(loads__cylinder_direction=90)
    links = press.machine.at(np.zeros(1)).links
    axis = complex(links["cylinder"].origin.value[0])
    (_, message) = found[-1]
    assert f"overlap of the cylinder and the axis D: {140.0 - abs(axis - 37.0):.3g}" in message
    assert len(found) == 3


def test_gear_1_beside_its_axes_is_told_by_how_much() -> None:
    for direction, off in ((88.0, 4.57), (-92.0, 0.567), (267.5, 0.0667), (180.0, 87.4)):
        (found,) = _press(loads__gear_1_direction=direction).check("gear-direction")
        assert found.value == pytest.approx(off, rel=1e-2)
        assert found.status == ("warn" if off > 1.0 else "pass")
        if off <= 1.0:
            continue
        named = float(found.fix.removeprefix("set loads.gear_1_direction to ").removesuffix(" deg"))
        assert abs(math.remainder(named - direction, 360.0)) == pytest.approx(found.value, abs=1e-2)


def test_without_directions_nothing_is_judged() -> None:
    press = _press(loads__gear_1_direction=None, loads__cylinder_direction=None)
    assert press.check("cylinder-place") == press.check("gear-direction") == []
    alone = _places(_press(loads__gear_1_direction=None))
    assert alone == _places(_press(loads__gear_1_direction=math.degrees(math.atan2(-290.0, -13.0))))


# Frames


def test_bodies_that_turn_freely_lie_along_x_at_the_start() -> None:
    for side in (1, -1):
        links = _press(loads__bed_side=side).machine.at(np.zeros(1)).links
        assert abs(links["pinion"].turn.value[0]) <= 1e-15
        assert abs(links["cylinder"].turn.value[0]) <= 1e-15


@pytest.mark.parametrize("gravity", [[9.81, 0], [0, 9.81]])
def test_a_pinion_out_of_balance_hangs_along_x_at_the_start(gravity: list[float]) -> None:
    """Held still, its weight along its arm turns it nowhere; across, it loads the lower rack with m g z/r8.

    The bed is free and takes nothing of it. The lower rack lies on +x of the pinion, a positive force is along -y.
    """
    keys = {"speed": SLOW, "loads__gravity": gravity, "loads__forces": [{"on": "cylinder", "torque": 1e-9}]}
    even, odd = (
        _press(**keys, loads__links__pinion={"mass": 16, "inertia": 0.08, "center": center})
        for center in ([0, 0], [20, 0])
    )
    start = np.zeros(1)
    extra = [
        odd.machine.reactions(start).unknowns[name][0][0] - even.machine.reactions(start).unknowns[name][0][0]
        for name in ("rack_lower", "rack_upper")
    ]
    turning = 16.0 * 20.0 * gravity[1]
    assert extra == pytest.approx([turning / odd.pinion_radius, 0.0], abs=1e-9)
