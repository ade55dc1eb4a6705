"""Locking disc and plate of a mutilated wheel, compared with the swept plate.

The second way turns the plate in steps and looks how deep its points get into the disc, in the frame of the disc. Arcs
are resolved by 1e-3 of their radius and steps by 1e-3 rad, so that a corner that passes an edge is seen to 1e-6 of the
radius; a disc whose arcs are longer by 0.02 rad is met by some 1e-4 of it. Closed forms of one plate at rest are
compared to 1e-9 rad, the bisection's end.
"""

from __future__ import annotations

import math
import re
from functools import partial
from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import brentq
from sweeps import examples

from gearlink.cli.export import parts
from gearlink.cli.export.contour import contour
from gearlink.cli.export.options import CurveForm
from gearlink.cli.views.figures.mutilated_gear_dwell import build
from gearlink.cli.views.scenes.scene import GREEN, Body
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.dwell_gears.locking import Lock

TURN = 2.0 * math.pi
design = partial(factory.design, "mutilated_gear_two_stops")


def lock_of(distance: float, ratio: float, radius: float, plate: float, clearance: float = 0.0, stops: int = 1) -> Lock:
    """A lock whose driven gear goes from stop to stop, in the dwell that one group leaves."""
    return Lock(distance, ratio, TURN - TURN / stops / ratio, radius, plate, clearance, stops)


def plate_of(lock: Lock) -> Any:
    """Points of the plate about the driven axis, an arc towards -x."""
    a, hollow, plate = lock.distance, lock.hollow, lock.plate
    reach = math.acos((a * a + hollow * hollow - plate * plate) / (2.0 * a * hollow))
    half = math.acos((a * a + plate * plate - hollow * hollow) / (2.0 * a * plate))
    arc = hollow * np.exp(1j * np.linspace(-reach, reach, 801)) - a
    rim = plate * np.exp(1j * np.linspace(math.pi + half, math.pi + TURN / lock.stops - half, 801))
    one = np.concatenate([arc, rim])
    return np.concatenate([one * np.exp(1j * TURN * k / lock.stops) for k in range(lock.stops)])


def deepest(lock: Lock, longer: float = 0.0) -> float:
    """How deep the plate gets into a disc whose arcs are longer by so much at each end, over a motion [mm]."""
    points, step, worst = plate_of(lock), TURN / lock.stops, -math.inf
    for turned in np.linspace(0.0, step, 1501):
        seen = lock.distance + points * np.exp(1j * turned)
        near = seen[np.abs(seen) < lock.radius] * np.exp(1j * turned / lock.ratio)  # the others are outside
        beyond, angle = np.abs(near), np.mod(np.angle(near), TURN)
        open_ = (angle > longer - lock.edge) & (angle < step / lock.ratio + lock.edge - longer)
        if lock.edge > longer:
            open_ |= angle > TURN + longer - lock.edge
        worst = max(worst, float(np.max(np.where(open_, lock.cut, lock.radius) - beyond, initial=-math.inf)))
    return worst


LOCKS = {
    "tips outside the pitch circle": (150.0, 4.0, 120.0, 33.0),
    "usual": (150.0, 4.0, 120.0, 60.0),
    "arcs end before the line of centres": (150.0, 4.0, 120.0, 80.0),
    "disc smaller than the pitch circle": (150.0, 4.0, 105.0, 70.0),
    "disc larger": (150.0, 2.0, 108.0, 70.0),
    "two stops": (144.0, 3.0, 108.0, 60.0, 0.0, 2),
    "four stops": (120.0, 2.5, 80.0, 55.0, 0.0, 4),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("sizes", LOCKS.values(), ids=LOCKS)
def test_the_plate_passes_the_disc_and_no_longer_arc_lets_it(sizes: tuple[float, ...]) -> None:
    lock = lock_of(*sizes)  # type: ignore[arg-type]
    assert deepest(lock) < 1e-6 * lock.radius
    assert deepest(lock, 0.02) > 1e-5 * lock.radius


def test_an_arc_ends_earlier_where_the_tips_go_deep() -> None:
    assert lock_of(*LOCKS["usual"]).edge == 0.0
    assert lock_of(*LOCKS["arcs end before the line of centres"]).edge > 0.1


@pytest.mark.slow
@examples(60)
@given(
    st.floats(0.8, 6.0), st.floats(0.9, 4.0), st.floats(0.0, 1.0), st.sampled_from([0.0, 0.05, 0.2]), st.integers(1, 4)
)
def test_no_disc_meets_its_plate(ratio: float, plate: float, share: float, clearance: float, stops: int) -> None:
    """Discs from the plate's rim to the driven axis, with clearance too."""
    distance = 150.0
    rim = plate * distance / (1.0 + ratio)
    if rim >= 0.98 * distance or TURN / stops / ratio > 2.8:
        return
    try:
        lock = lock_of(distance, ratio, distance - rim + share * (rim - 2.0), rim, clearance, stops)
    except NoSolution:
        return
    assert deepest(lock) < 1e-6 * lock.radius


@pytest.mark.parametrize("sizes", [(150.0, 4.0, 120.0, 60.0, 0.05), (144.0, 3.0, 108.0, 60.0, 0.2, 2)])
def test_play_and_arm_of_the_plate_at_rest(sizes: tuple[float, ...]) -> None:
    lock = lock_of(*sizes)  # type: ignore[arg-type]

    def gap(turned: float) -> float:
        """From the disc's arc to the nearest point of the plate's."""
        reach = math.acos((lock.distance**2 + lock.hollow**2 - lock.plate**2) / (2.0 * lock.distance * lock.hollow))
        arc = lock.hollow * np.exp(1j * np.linspace(-reach, reach, 4001)) - lock.distance
        return float(np.min(np.abs(lock.distance + arc * np.exp(1j * turned)))) - lock.radius

    free = brentq(gap, 0.0, 0.3, xtol=1e-12)
    assert lock.play == pytest.approx(2.0 * free, abs=1e-9)
    # The force at the tip points at the wheel's axis: its arm is how fast the tip nears it.
    step = 1e-5
    assert lock.arm == pytest.approx((gap(free - step) - gap(free + step)) / (2.0 * step), rel=1e-8)


def test_both_tips_are_on_the_disc_for_the_turns_that_are_told() -> None:
    made = design()
    lock = made.lock
    place = math.asin(lock.plate * math.sin(lock.half_arc - 0.5 * lock.play) / lock.radius)
    assert made.held_turns == pytest.approx(made.reduction * (lock.arc - 2.0 * place) / TURN, rel=1e-14)
    assert made.held_turns < made.dwell_turns
    assert made.quantity("locking_arc").value == pytest.approx(360.0 / 2 - 12 * 360.0 / 72, rel=1e-14)
    assert factory.design("mutilated_gear_press").locking_play is None


@pytest.mark.parametrize(("stops", "keys", "key"), [
    (2, {"radius": 80}, "locking.radius"),
    (2, {"radius": 143.99}, "locking.radius"),
    (2, {"plate_radius": 143.96}, "locking.plate_radius"),
    (2, {"plate_radius": 130}, "locking.plate_radius"),
    (4, {"plate_radius": 80, "radius": 125}, "locking.radius"),
])  # fmt: skip
def test_what_is_refused_names_a_value_that_is_not(stops: int, keys: dict[str, float], key: str) -> None:
    """The value that the fix names, kept by a thousandth, leads to no such refusal."""
    teeth = {"module": 3, "full_teeth": 72, "group_teeth": 24 // stops, "groups": 2, "driven": 24, "stops": stops}
    section = {"plate_radius": 60, "clearance": 0.05} | keys
    told = _refusal(teeth, section)
    assert told is not None
    assert told.key == key
    side, value = str(told.fix).removesuffix(" mm").rsplit(" ", 2)[1:]
    changed = {key.removeprefix("locking."): float(value) * (0.999 if side == "below" else 1.001)}
    other = _refusal(teeth, section | changed)
    assert other is None or re.sub("[0-9.]+", "", str(other)) != re.sub("[0-9.]+", "", str(told))


def _refusal(gears: dict[str, int], section: dict[str, float]) -> NoSolution | None:
    try:
        _ = design(gears=gears, locking=section).locking_play
    except NoSolution as told:
        return told
    return None


def test_metal_at_the_shafts() -> None:
    made = design(shafts={"A_radius": 40, "W_radius": 90})
    found = made.check("locking")
    assert [check.status for check in found] == ["fail", "fail"]
    assert found[0].value == pytest.approx(made.lock.bottom - 40.0, rel=1e-12)
    assert found[1].value == pytest.approx(made.lock.cut - 90.0, rel=1e-12)
    assert [check.status for check in design().check("locking")] == ["pass", "pass"]
    assert factory.design("mutilated_gear_press").check("locking") == []


@pytest.mark.parametrize("name", ["disc", "plate"])
def test_files_have_the_areas_of_closed_forms(name: str) -> None:
    """Sectors and circular segments; polygons within 1e-4 mm of the curves."""
    made = design()
    lock = made.lock
    (line,) = contour(parts.makers(made)[name](), 1e-4, CurveForm.POLYLINE).lines
    points = line.nodes
    area = 0.5 * (points[:-1].conj() * points[1:]).imag.sum()
    if name == "disc":
        exact = lock.arc * lock.radius**2 + (math.pi - lock.arc) * lock.cut**2
    else:
        reach = math.asin(lock.plate * math.sin(lock.half_arc) / lock.hollow)
        lens = (
            lock.plate**2 * lock.half_arc
            + lock.hollow**2 * reach
            - lock.distance * lock.plate * math.sin(lock.half_arc)
        )
        exact = math.pi * lock.plate**2 - 2.0 * lens
    assert area == pytest.approx(exact, abs=2e-4 * TURN * lock.radius)
    assert line.closed


@pytest.mark.quick(1)
@pytest.mark.parametrize("file", ["mutilated_gear_two_stops", "mutilated_gear_press"])
def test_disc_and_plate_of_the_film_never_overlap(file: str) -> None:
    """Over the whole loop of the animation; chords of its outlines are off the arcs by 0.02 mm."""
    from matplotlib.path import Path

    made = factory.design(file, locking={"plate_radius": 60, "clearance": 0.05})
    scene = build(made, np.linspace(0.0, 1.0, 240, endpoint=False))
    disc, plate = (body for body in scene.parts if getattr(body, "color", "") == GREEN)
    assert isinstance(disc, Body)
    assert isinstance(plate, Body)
    assert (disc.name, plate.name) == ("locking disc and plate", "")
    for k in range(240):
        one, other = (body.place[k] + body.outline * np.exp(1j * body.turn[k]) for body in (disc, plate))
        inside = Path(np.column_stack([one.real, one.imag])).contains_points(
            np.column_stack([other.real, other.imag]), radius=0.0
        )
        near = np.abs(np.abs(other[inside] - disc.place[k]) - made.lock.radius)
        assert not inside.any() or near.max() < 0.02, k
