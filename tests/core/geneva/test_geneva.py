"""Geneva drives: closed forms against the pin's own geometry, differences and searches.

Tolerances: differences of a step of 1e-4 rad are good to 1e-8; searches of smooth peaks to rounding.
"""

from __future__ import annotations

import cmath
import itertools
import math
import re
from typing import Any

import numpy as np
import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.path import Path
from sweeps import ALL

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.machines.geneva.design import Geneva, Outlines

GIVEN: dict[str, Any] = {
    "kind": "geneva-drive",
    "type": "external",
    "slots": 6,
    "center_distance": 120.0,
    "pin_radius": 8.0,
    "locking_radius": 42.0,
    "input_speed": 60.0,
    "wheel": {"inertia": 0.02, "resistance": 3.0},
}


@given(slots=st.integers(3, 24), sign=st.sampled_from([1.0, -1.0]), share=st.floats(-0.999, 0.999))
def test_the_pin_is_in_its_slot(slots: int, sign: float, share: float) -> None:
    """Direction of the pin from the wheel's axis; both derivatives by differences."""
    drive = Geneva(slots, 1, 100.0, sign)
    f, h = share * drive.half, 1e-4

    def angle(place: float) -> float:
        pin = cmath.rect(drive.crank, place)
        return math.pi - cmath.phase(pin - 100.0) if sign > 0.0 else cmath.phase(pin + 100.0)

    psi, speed, acceleration, jerk = (float(each[0]) for each in drive.rates(np.array([f]), 3))
    assert cmath.rect(1.0, psi) == pytest.approx(cmath.rect(1.0, angle(f)), abs=1e-12)
    there, back = (drive.rates(np.array([f + way * h]), 2) for way in (1.0, -1.0))
    for k, exact in enumerate((speed, acceleration, jerk)):
        scale = 1.0 + max(abs(float(each[k][0])) for each in (there, back)) + abs(jerk) * 40.0
        assert (there[k][0] - back[k][0]) / (2.0 * h) == pytest.approx(exact, abs=1e-6 * scale)
    assert drive.reach(np.array([f]))[0] == pytest.approx(abs(cmath.rect(drive.crank, f) - sign * 100.0), rel=1e-13)
    if abs(psi) < 0.499 * drive.step:
        assert drive.leaves(0.5 * drive.step - abs(psi)) == pytest.approx(abs(f), abs=1e-9)


@pytest.mark.parametrize(
    ("slots", "peak"), [(3, 31.392428), (4, 5.406981), (6, 1.349637), (8, 0.699757)]
)  # published to six decimals
def test_peaks_of_the_textbooks(slots: int, peak: float) -> None:
    found = design(GIVEN, slots=slots, pin_radius=2.0, locking_radius=None)
    assert found.acceleration_ratio_max == pytest.approx(peak, abs=5e-7)
    f = np.linspace(-found.drive.half, found.drive.half, 200_001)
    assert np.max(np.abs(found.drive.rates(f, 2)[2])) == pytest.approx(peak, abs=6e-7)


@pytest.mark.parametrize("kind", ["external", "internal"])
def test_ends_of_the_step(kind: str) -> None:
    """The wheel starts and stops without a step in speed; its acceleration jumps by tan(pi/n)."""
    found = design(GIVEN, type=kind)
    ends = found.drive.rates(np.array([-found.drive.half, found.drive.half]), 2)
    assert ends[0] == pytest.approx([-math.pi / 6.0, math.pi / 6.0], abs=1e-14)
    assert ends[1] == pytest.approx([0.0, 0.0], abs=1e-14)
    assert ends[2] == pytest.approx([math.tan(math.pi / 6.0), -math.tan(math.pi / 6.0)], rel=1e-13)
    assert found.motion_angle + found.locking_angle == pytest.approx(2.0 * math.pi, rel=1e-15)
    if kind == "internal":
        assert found.acceleration_ratio_max == pytest.approx(found.entry_acceleration_ratio, rel=1e-13)


def test_forces_are_those_of_the_links_in_motion() -> None:
    """Closed form against Newton and Euler of the two links, and the torque against virtual power, to rounding."""
    loads = design(
        GIVEN, command="loads",
        loads={"links": {"wheel": {"inertia": 0.02}}, "forces": [{"on": "wheel", "resistance": 3.0}]},
    )  # fmt: skip
    found = loads.design
    f = np.linspace(-0.99, 0.99, 41) * found.drive.half
    reactions = loads.machine.reactions(np.mod(f, 2.0 * math.pi))
    force, torque = found.forces(f)
    assert np.abs(reactions.unknowns["slot"][0]) == pytest.approx(force, rel=1e-11)
    assert reactions.torque == pytest.approx(torque, abs=1e-11)
    assert loads.power_identity < 1e-9
    assert found.contact_force_max == pytest.approx(float(np.max(found.forces(np.linspace(-1, 1, 20001))[0])), rel=1e-7)


def test_wheel_of_several_pins_runs_on() -> None:
    found = design(GIVEN, slots=4, pins=2, pin_radius=3.0, locking_radius=None, wheel=None)
    table = found.table("motion", samples=72)
    assert table["wheel_angle"][[0, 18, 36, 54]] == pytest.approx([0.0, 45.0, 90.0, 135.0], abs=1e-12)
    assert np.all(np.diff(table["wheel_angle"]) >= 0.0)
    assert found.steps_per_minute == pytest.approx(120.0, rel=1e-15)
    assert found.contact_force_max is None


@pytest.mark.parametrize(("slots", "pins"), [(6, 1), (5, 2), (6, 2)])
def test_the_wheel_moves_in_its_share_of_the_time(slots: int, pins: int) -> None:
    found = design(GIVEN, slots=slots, pins=pins, pin_radius=3.0, locking_radius=None, wheel=None)
    speed = np.abs(found.table("motion", samples=3600)["speed_ratio"])
    assert np.mean(speed > 1e-9) == pytest.approx(found.motion_share, abs=2 * pins / 3600)
    assert found.motion_share * 360.0 == pytest.approx(360.0 - pins * math.degrees(found.locking_angle), rel=1e-12)


@pytest.mark.parametrize(("kind", "pins"), [("external", 1), ("external", 2), ("internal", 1)])
def test_loads_know_where_the_wheel_starts_and_stops(kind: str, pins: int) -> None:
    """By the angle of the pin at the mouth of its slot, cos = a_crank/a, about each pin."""
    found = design(GIVEN, slots=4, type=kind, pins=pins, pin_radius=3.0, locking_radius=None, wheel=None)
    half = 0.5 * math.pi + (0.25 if kind == "internal" else -0.25) * math.pi
    apart = np.arange(pins) * 2.0 * math.pi / pins
    wanted = np.sort(np.concatenate([apart + half, apart - half]) % (2.0 * math.pi))
    assert found.moving.input.joints == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("assembly", [1, -1])
def test_comparison_at_equal_step(assembly: int) -> None:
    """Dwells within the tolerance by dense rows of each motion; the cam's peaks those of a modified sine.

    The mirror image of the compared drive runs backwards: where the one accelerates most the other decelerates most.
    """
    found = design("geneva_drive", compare__assembly=assembly)
    table = found.table("comparison")
    assert table["step"] == pytest.approx([60.0] * 3, rel=1e-14)
    rows = np.radians(np.linspace(0.0, 360.0, 360_001))
    angle = np.degrees(found.drive.over(rows, 0)[0][0])
    inside = np.abs(angle - 30.0) <= 0.25
    assert table["dwell"][0] == pytest.approx(np.count_nonzero(inside) * 1e-3, abs=2e-3)
    share = math.radians(120.0)
    assert table["acceleration_ratio_max"][1] == pytest.approx(
        math.radians(60.0) * 4.0 * math.pi**2 / (math.pi + 4.0) / share**2, rel=1e-13
    )
    assert table["dwell"][2] == pytest.approx(math.degrees(found.compared.tolerance_dwell_angle), rel=1e-14)
    motion = found.compared.table("motion", samples=3600)
    for name in ("speed_ratio", "acceleration_ratio"):  # rows a tenth of a degree apart leave 1e-6 of a maximum
        assert table[f"{name}_max"][2] == pytest.approx(np.abs(motion[name]).max(), rel=1e-5)
    peak = table["acceleration_ratio_max"]
    assert table["steps_per_minute"] == pytest.approx(60.0 * np.sqrt(peak[0] / peak), rel=1e-14)


def test_checks_on_both_sides_of_their_limits() -> None:
    good = {
        each.name: each.status for each in design(GIVEN, hub_radius=40.0, shaft_radius=14.0).report("analyze").checks
    }
    assert set(good.values()) == {"pass"}
    for keys, name, status in (
        ({"locking_radius": 52.0}, "locking", "fail"),
        ({"locking_radius": None, "pin_radius": 31.0}, "locking", "fail"),
        ({"hub_radius": 52.5}, "shaft-clearance", "fail"),
        ({"shaft_radius": 16.0}, "shaft-clearance", "fail"),
        ({"input_speed": 201.0}, "step-rate", "warn"),
    ):
        found = [each.status for each in design(GIVEN, **keys).report("analyze").checks if each.name == name]
        assert status in found, keys


def test_refusals() -> None:
    with pytest.raises(NoSolution) as refused:
        design("geneva_drive", compare__gears__output=121).table("comparison")
    assert refused.value.key == "compare.gears"
    with pytest.raises(MissingSection):
        design(GIVEN).table("comparison")
    for keys, key in (({"slots": 2}, "slots"), ({"pins": 4}, "pins"), ({"pin_radius": 60.0}, "axis")):
        with pytest.raises(ValueError, match=key):
            design(GIVEN, **keys)


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("sign", "slots", "share"),
    [
        (1.0, 3, 0.8),
        (1.0, 4, 0.95),
        (1.0, 6, 0.5),
        (1.0, 12, 0.85),
        (-1.0, 3, 0.83),
        (-1.0, 4, 0.95),
        (-1.0, 6, 0.7),
        (-1.0, 12, 0.85),
    ],
)
def test_wheel_and_driver_turn_without_touching(sign: float, slots: int, share: float) -> None:
    """The outlines join and, turned through a revolution, the wheel's points stay out of the disc but for its arc.

    With the shares 0.8 and 0.5 of 3 and 6 slots the edges of an internal disc are in the wheel: the second test below.
    """
    drive = Geneva(slots, 1, 100.0, sign)
    pin = 0.1 * drive.crank
    radius = share * (drive.crank - pin)
    outlines = Outlines(drive, pin, radius, radius)
    half, driver = outlines.wheel_half(), outlines.driver()
    for chain in (half, [*driver, driver[0]]):
        ends = [(each.curve(np.array([each.low]))[0], each.curve(np.array([each.high]))[0]) for each in chain]
        for (_, end), (start, _) in itertools.pairwise(ends):
            assert abs(end - start) < 1e-9
    assert outlines.overlap == 0.0
    sector = np.concatenate([each.curve(np.linspace(each.low, each.high, 60)) for each in half])
    sector = np.concatenate([sector, sector.conj()])
    wheel = (sector * np.exp(1j * drive.step * np.arange(slots))[:, None]).ravel()
    f = np.linspace(-math.pi, math.pi, 181)[:, None]
    angle = (math.pi if sign > 0.0 else 0.0) - sign * drive.over(f[:, 0], 0)[0][0][:, None]
    seen = (sign * drive.distance + wheel * np.exp(1j * angle)) * np.exp(-1j * f)
    vertex, end = outlines.cut_vertex, outlines.edge
    into = outlines.locking - np.abs(seen)
    # left of the arc through both edges and its vertex: the edges are seen at less than from the vertex
    whole = np.angle((end - vertex) / (end.conjugate() - vertex)) % (2.0 * math.pi)
    left = whole - np.angle((end - seen) / (end.conjugate() - seen)) % (2.0 * math.pi)
    assert np.max(np.minimum(into, outlines.locking * left)) < 1e-3
    assert np.max(into) > 0.1  # what the disc is cut out for


def test_a_disc_that_does_not_hold_the_wheel() -> None:
    """On both sides of a - tip_radius; then a lip that hits the edge of a small disc."""
    least = 120.0 - design(GIVEN).tip_radius
    found = [design(GIVEN, locking_radius=least + way).check("locking")[1] for way in (0.1, -0.1)]
    assert [each.status for each in found] == ["pass", "fail"]
    assert found[1].value == pytest.approx(-0.1, rel=1e-9, abs=0.0)
    hit = [
        c for c in design(GIVEN, slots=12, pin_radius=2.0, locking_radius=8.0).check("locking") if c.status == "fail"
    ]
    assert len(hit) == 1
    assert "edge of the locking disc" in hit[0].what


@pytest.mark.quick(1)
@pytest.mark.parametrize(("slots", "share", "depth"), [(3, 0.8, 0.03), (6, 0.5, 5.5)])
def test_how_deep_the_edges_of_an_internal_disc_are_in_the_wheel(slots: int, share: float, depth: float) -> None:
    """An edge turned into the wheel, beyond the tips and out of slots and arcs: instants 6e-6 rad apart at most, of a
    depth that changes by up to 100 mm per radian."""
    drive = Geneva(slots, 1, 100.0, -1.0)
    pin = 0.1 * drive.crank
    radius = share * (drive.crank - pin)
    outlines = Outlines(drive, pin, radius, radius)
    f = np.linspace(-drive.half, drive.half, 400_001)
    seen = (100.0 + outlines.edge * np.exp(1j * f)) * np.exp(-1j * drive.over(f, 0)[0][0])
    away = np.abs(np.angle(seen * np.exp(-1j * drive.step * np.round(np.angle(seen) / drive.step))))
    from_arc = np.abs(np.abs(seen) * np.exp(1j * away) - 100.0 * np.exp(0.5j * drive.step)) - radius
    most = float(
        np.max(np.minimum(np.minimum(np.abs(seen) - outlines.tip, np.abs(seen) * np.sin(away) - pin), from_arc))
    )
    assert most == pytest.approx(depth, rel=0.1)
    assert outlines.overlap == pytest.approx(most, abs=4e-4)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("slots", "share"), [(12, 0.5), (16, 0.4), (16, 0.3)])
def test_how_deep_the_edges_of_an_external_disc_reach_into_the_lips(slots: int, share: float) -> None:
    """Against a million places and instants, which lie 1e-5 a apart: at a greatest depth of two that cross, as far."""
    drive = Geneva(slots, 1, 120.0, 1.0)
    pin = 0.1 * drive.crank
    outlines = Outlines(drive, pin, share * (drive.crank - pin), share * (drive.crank - pin))
    lip = outlines.tip * np.exp(
        1j * np.linspace(math.asin(pin / outlines.tip), math.pi / slots - outlines._arc_half, 101)
    )
    f = np.linspace(-drive.half, drive.half, 10_001)[:, None]
    turned = lip * np.exp(1j * (math.pi - drive.over(f[:, 0], 0)[0][0][:, None]))
    seen = (drive.distance + turned) * np.exp(-1j * f)
    depth = np.minimum(outlines.locking - np.abs(seen), np.abs(seen) * (np.abs(np.angle(seen)) - drive.half))
    most = float(np.max(depth))
    assert most > 0.1
    assert most - 1e-7 < outlines.overlap < most + 1e-5 * drive.distance


@pytest.mark.quick(1)
@pytest.mark.parametrize("slots", [3, 4, 6, 9])
@pytest.mark.parametrize("clearance", [0.0, 0.3])
def test_the_edges_of_a_small_disc_of_an_internal_drive_hit_the_wheel(slots: int, clearance: float) -> None:
    """The edges are turned through the wheel's own outline: the first that is free of it is the first that passes."""

    def hits(radius: float) -> tuple[bool, bool]:
        keys = {"slots": slots, "pin_radius": 4.0, "locking_radius": radius}
        found = design(GIVEN, type="internal", locking_clearance=clearance, slot_clearance=2.0 * clearance, **keys)
        outlines, drive = found.outlines_with(radius), found.drive
        half = np.concatenate([each.curve(np.linspace(each.low, each.high, 401)) for each in outlines.wheel_half()])
        sector = np.concatenate([[0.0], np.conj(half[::-1]), half])  # chords are within 1e-3 mm of the arcs
        f = drive.half * np.linspace(
            -0.99999, 0.99999, 4001 if ALL else 2001
        )  # not where the sectors of two slots meet
        pins = drive.distance + drive.crank * np.exp(1j * f)
        edges = drive.distance + (radius - 2e-3) * np.exp(1j * (drive.half + f))
        seen = edges * np.exp(-1j * np.angle(pins))
        angle = np.angle(seen) % drive.step
        folded = np.abs(seen) * np.exp(1j * np.minimum(angle, drive.step - angle))
        cavity = Path(np.column_stack([sector.real, sector.imag]))
        free = cavity.contains_points(np.column_stack([folded.real, folded.imag]))
        return not free.all(), any(each.status == "fail" for each in found.check("locking"))

    crank = 120.0 * math.sin(math.pi / slots)
    judged = [hits(share * crank) for share in np.linspace(0.4, 0.85, 16 if ALL else 10)]
    assert {each[0] for each in judged} == {True, False}
    assert [each[0] for each in judged] == [each[1] for each in judged]


@pytest.mark.parametrize("kind", ["external", "internal"])
def test_a_disc_beyond_the_whole_wheel_is_a_finding(kind: str) -> None:
    found = design(GIVEN, type=kind, locking_radius=400.0).check("locking")
    assert [each.what for each in found if each.status == "fail"] == ["overlap of locking arc and slot"]


@pytest.mark.parametrize(
    ("kind", "slots", "pins", "radius", "clearance"),
    [("external", 6, 1, 42.0, 0.1), ("external", 6, 2, 42.0, 0.3), ("external", 4, 1, 60.0, 1.0),
     ("external", 5, 2, 50.0, 0.05), ("internal", 6, 1, 42.0, 0.2), ("internal", 3, 1, 80.0, 0.6)],
)  # fmt: skip
def test_play_of_the_locked_wheel_by_turning_its_outline(
    kind: str, slots: int, pins: int, radius: float, clearance: float
) -> None:
    """The wheel is turned until points of its arc are in the disc, or the disc's edge in the wheel."""
    keys = {"type": kind, "slots": slots, "pins": pins, "locking_radius": radius, "locking_clearance": clearance}
    found = design(GIVEN, pin_radius=4.0, **keys)
    outlines, drive = found.outlines_with(radius), found.drive
    end, sign = 0.5 * found.locking_angle, drive.sign
    center = sign * drive.distance  # of the wheel, seen from the crank
    arc = outlines.wheel_half()[-1]
    assert arc.name == "locking arc"
    middle = cmath.rect(1.0, math.pi / slots)
    half = arc.curve(np.linspace(arc.low, arc.high, 4001)) / middle  # the middle of the arc on the x axis
    wheel = (-sign * np.concatenate([half, half.conj()])) if sign > 0.0 else np.concatenate([half, half.conj()])
    edge = radius * np.exp(1j * np.linspace(-end, end, 8001))  # of the disc, about the direction of the arc

    def touches(turn: float) -> bool:
        points = center + wheel * np.exp(1j * turn)
        inside = (np.abs(points) < radius) & (np.abs(np.angle(points)) < end)
        hub = center - center * cmath.exp(1j * turn)  # where the centre of the arc has gone
        out = (np.abs(edge - hub) > radius + clearance) & (np.abs(edge - center) * sign < outlines.tip * sign)
        return bool(inside.any() or out.any())

    low, high = 0.0, 0.2
    for _ in range(40):
        middle_turn = 0.5 * (low + high)
        low, high = (low, middle_turn) if touches(middle_turn) else (middle_turn, high)
    assert found.locking_play is not None
    assert found.locking_play == pytest.approx(2.0 * low, rel=2e-3, abs=0.0)  # points 1e-4 of the arc apart


def test_running_clearance() -> None:
    """Backlash by the pin between two walls; the lip loses what slot and arc gain; the entry on both sides."""
    for kind, near in (("external", 120.0 - 60.0), ("internal", 120.0 * math.cos(math.pi / 6.0))):
        found = design(GIVEN, type=kind, slot_clearance=0.2, locking_clearance=0.05)
        turned = cmath.rect(near, 0.5 * found.wheel_backlash)
        assert turned.imag == pytest.approx(0.1, rel=1e-12, abs=0.0)
        assert found.drive.reach(np.linspace(-found.drive.half, found.drive.half, 999)).min() >= near * (1.0 - 1e-12)
    assert design(GIVEN).lip_thickness - found.lip_thickness == pytest.approx(0.15, rel=1e-9, abs=0.0)
    assert design(GIVEN).locking_play is None
    assert design(GIVEN).wheel_backlash is None
    held = design(GIVEN, locking_clearance=0.05)
    least = 2.0 * held.wheel_radius * math.sin(0.5 * held.locking_play)
    for way, status in ((1.001, "pass"), (0.999, "warn")):
        (check,) = design(GIVEN, locking_clearance=0.05, slot_clearance=way * least).check("pin-entry")
        assert check.status == status
    far = {"slots": 11, "center_distance": 100.0, "pin_radius": 2.5, "locking_radius": 210.0, "pins": 2}
    assert design(GIVEN, **far, locking_clearance=168.0).locking_play is None
    for kind, near in (("external", 60.0), ("internal", 120.0 * math.cos(math.pi / 6.0))):
        loose = design(GIVEN, type=kind, slot_clearance=math.nextafter(2.0 * near * (1.0 - 1e-12), 0.0))
        assert loose.wheel_backlash == pytest.approx(math.pi, abs=1e-5)
        with pytest.raises(ValueError, match="turns freely"):
            design(GIVEN, type=kind, slot_clearance=2.0 * near * (1.0 + 1e-12))
    with pytest.raises(ValueError, match="give locking_radius"):
        design(GIVEN, locking_radius=None, locking_clearance=0.1)


def test_the_clearances_of_the_fix_pass_and_are_not_nothing() -> None:
    """The suggestion had been a wheel that is locked without clearance."""
    tight = design(GIVEN, locking_clearance=0.05, slot_clearance=0.04)
    (check,) = tight.check("pin-entry")
    told = re.fullmatch(
        r"reduce locking_clearance to ([\d.]+) mm, increase slot_clearance to ([\d.]+) mm, or .*", check.fix
    )
    assert told
    for key, value in zip(("locking_clearance", "slot_clearance"), map(float, told.groups()), strict=True):
        (again,) = design(GIVEN, **{"locking_clearance": 0.05, "slot_clearance": 0.04, key: value}).check("pin-entry")
        assert again.status == "pass"
    assert 0.0 < float(told[1]) < 0.05
    tried = [dict(each) for way in tight.ways["pin-entry"] if (each := way.remedy([0.05], 4))]
    assert tried == [{"locking_clearance": 0.03}, {"slot_clearance": 0.07}]


def test_no_torque_beside_the_ends_of_a_step() -> None:
    loads = design(
        GIVEN, command="loads", type="internal", slots=8, pin_radius=4.0, center_distance=70.0, locking_radius=None,
        loads={"links": {"wheel": {"inertia": 0.004}}, "forces": [{"on": "wheel", "resistance": 0.8}]},
    )  # fmt: skip
    assert loads.input_torque_min == 0.0
    assert loads.input_torque_max > 0.1
