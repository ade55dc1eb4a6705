"""Register of the press over its whole turn: gains against the machine with its real follower, made a second time.

The second way: loops by meeting circles, the slider by Pythagoras, the lift of the lead-in and the transition by the
linear equations of their ends, all in 40 digits; slopes are central differences of 1e-9 (mm, deg), which leave 1e-12.
Tolerance: 1e-9 (mm per mm, mm per deg), the rounding of the program's closed forms where a loop is oblique.
Samples: by the exact chain, which knows a difference of some 1e-3 mm of travels of 600 mm to 1e-12.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import factory
import mpmath as mp
import numpy as np
import pytest
from oracles.press import TY460
from oracles.press_follower import lift

from gearlink.core.base.errors import MissingSection, NoSolution

pytestmark = pytest.mark.usefixtures("forty_digits")

ANGLES = {"lead-in": (25.0, 30.0), "sync": (34.0, 60.0, 120.0, 153.5), "transition": (155.0, 162.0)}
ANGLES |= {"return": (170.0, 200.0, 230.0), "dwell": (10.0, 270.0, 290.0, 330.0)}
STEP = mp.mpf("1e-9")
LINKS = ("crank", "coupler", "rocker", "frame")


def meeting(one: Any, first: Any, other: Any, second: Any, near: Any) -> Any:
    """Of the two points of two circles that which lies nearer to a place."""
    line = other - one
    along = (first**2 - second**2 + abs(line) ** 2) / (2 * abs(line))
    across = mp.sqrt(first**2 - along**2)
    points = [one + (along + side * 1j * across) * line / abs(line) for side in (1, -1)]
    return min(points, key=lambda point: abs(point - near))


def turn_too_far(links: Any, crank_angle: Any, errors: dict[str, Any], chain: str, pins: str) -> Any:
    """Of a drag link with errors: how much farther its driven crank stands than without [rad]."""
    a, b, c, d, side = links

    def knee(da: Any, db: Any, dc: Any, start: Any, pivot: Any, turn: Any, near: Any) -> Any:
        pin = start + (a + da) * mp.expj(crank_angle + turn)
        return meeting(pin, b + db, pivot, c + dc, near) - pivot

    crank = a * mp.expj(crank_angle)
    reach = abs(crank - d)
    direction = mp.arg(crank - d) - side * mp.acos((c * c + reach * reach - b * b) / (2 * c * reach))
    plain = c * mp.expj(direction)
    play = {pin: errors.get(f"pins.{pin}", 0) for pin in pins}
    *before, last = play.values()
    lengths = [errors.get(f"{chain}.double_crank.{link}", 0) for link in LINKS]
    turn = mp.radians(errors.get(f"{chain}.initial_crank_angle", 0))
    moved = knee(*lengths[:3], sum(before) - lengths[3], d + last, turn, d + plain)
    return mp.arg(moved / plain)


def height(psi: Any, crank: Any, errors: dict[str, Any]) -> Any:
    """Height of F on its line, above D."""
    pin = crank * mp.expj(psi) + sum(errors.get(f"pins.{pin}", 0) for pin in "DEF")
    rod, offset = TY460.rod + errors.get("bed.rod", 0), TY460.offset + errors.get("bed.offset", 0)
    return mp.im(pin) - mp.sqrt(mp.mpf(rod) ** 2 - (mp.re(pin) + offset) ** 2)


def error(phi: Any, errors: dict[str, Any]) -> Any:
    """Bed against cylinder of the machine with errors, less that of the machine without."""
    turned = turn_too_far(TY460.bed, TY460.crank_start + phi, errors, "bed", "ABCD")
    cam = TY460.cam(phi)
    psi = -mp.pi / 2 - mp.asin(mp.mpf(TY460.offset) / (TY460.rod + TY460.crank)) + cam
    crank = replace(TY460, stroke=TY460.stroke + errors["bed.stroke"]).crank if "bed.stroke" in errors else TY460.crank
    too_far = psi + turned - mp.radians(errors.get("bed.crank_offset_angle", 0))
    bed = 2 * (height(too_far, crank, errors) - height(psi, TY460.crank, {}))
    rack = lift(cam + turned, phi) - lift(cam, phi)
    start = mp.radians(TY460.initial_crank_angle)
    driven = turn_too_far(TY460.cylinder, start - phi, errors, "cylinder", "GHMN")
    wider = errors.get("cylinder.radius", 0)
    return bed - rack - wider * TY460.q(phi) / TY460.radius + (TY460.radius + wider) * driven


SIZES = [f"{chain}.double_crank.{link}" for chain in ("bed", "cylinder") for link in LINKS]
SIZES += ["bed.stroke", "bed.rod", "bed.offset", "bed.crank_offset_angle", "cylinder.initial_crank_angle"]
SIZES += ["cylinder.radius"]
PINS = [f"pins.{pin}" for pin in "ABCDEFGHMN"]
SOURCES = {key: {"plus_minus": 0.01} for key in SIZES} | {pin: {"clearance": [0.0, 0.02]} for pin in PINS}


def register(sources: dict[str, Any] = SOURCES, **sections: Any) -> Any:
    return factory.design("ty460", command="register", tolerance={"sources": sources}, **sections)


@pytest.mark.quick(1)
@pytest.mark.parametrize("phase", ANGLES)
@pytest.mark.parametrize("keys", [SIZES, PINS], ids=["sizes", "pins"])
def test_gains_are_the_slopes_of_the_machine_with_its_follower(keys: list[str], phase: str) -> None:
    made, degrees = register({key: SOURCES[key] for key in keys}, cam__lead_in=12.0), ANGLES[phase]
    cam = np.degrees(made.design.bed.cam_angle(np.radians(degrees)).value)
    assert set(made.design.follower.evaluate(np.radians(cam))[1]) == {phase}
    for one in made.contributions(np.radians(degrees), 1):
        for axis in (1, mp.mpc(0, 1)) if np.iscomplexobj(one.gain) else (1,):
            wanted = [
                float((error(phi, {one.source: STEP * axis}) - error(phi, {one.source: -STEP * axis})) / (2 * STEP))
                for phi in map(mp.radians, degrees)
            ]
            assert (one.gain * complex(axis)).real == pytest.approx(wanted, abs=1e-9), one.source


@pytest.mark.quick(2)
@pytest.mark.parametrize("phase", ANGLES)
def test_samples_are_the_machine_with_its_follower(phase: str) -> None:
    made, degrees = register(cam__lead_in=12.0), ANGLES[phase]
    given = {key: 0.004 * (1 + i % 3) * (-1) ** i for i, key in enumerate(SIZES)}
    given |= {key: 0.003 * mp.expj(i) for i, key in enumerate(PINS)}
    given["bed.stroke"] = 0.0  # counts by its slope in the samples as well
    if phase == "sync":  # at its ends the zone's own law goes on
        degrees = degrees[1:-1]
    parts = {key: np.array([complex(value) if key in PINS else value]) for key, value in given.items()}
    found = made.sampled_errors(np.radians(degrees), 1, parts)[:, 0]
    assert found == pytest.approx([float(error(mp.radians(angle), given)) for angle in degrees], abs=2e-12)


@pytest.mark.slow
def test_the_table_of_the_cycle_is_that_of_single_angles() -> None:
    sources = {"bed.double_crank.crank": {"plus_minus": 0.01}}
    table = register(sources).table("cycle", samples=36)
    worst = dict(zip(table["input_angle"], table["worst"], strict=True))
    for angle, printed in ((20.0, 0.00792), (60.0, 0.02327), (200.0, 0.00811), (270.0, 0.00805), (330.0, 0.00678)):
        assert worst[angle] == pytest.approx(printed, abs=5e-6), "of an independent exact chain"
        assert register(sources, register={"at": angle}).worst[0] == pytest.approx(worst[angle], rel=1e-12)


def test_racks_are_pushed_by_the_bed_itself() -> None:
    """The sign of the bed's acceleration, from second differences of the oracle's travel less the lift."""
    made = register({"bed.rod": {"plus_minus": 0.01}}, register={"backlash": {"rack_upper": 0.02}}, cam__lead_in=12.0)
    degrees = [angle for phase in ANGLES.values() for angle in phase]
    (one,) = [one for one in made.contributions(np.radians(degrees), 1) if one.source == "backlash of rack_upper"]

    def bed(phi: Any) -> Any:
        return TY460.p(phi) - lift(TY460.cam(phi), phi)

    h = mp.mpf("1e-6")
    bends = [bed(phi + h) - 2 * bed(phi) + bed(phi - h) for phi in map(mp.radians, degrees)]
    assert one.gain.tolist() == [-1.0 if bend > 0 else 1.0 for bend in bends]


@pytest.mark.slow
def test_without_a_cam_nothing_is_known_outside_the_zone() -> None:
    bare, full = register(cam=None), register()
    assert bare.worst == full.worst
    for name in ("cycle", "sources"):
        tables = [one.table(name, samples=72) for one in (bare, full)]
        inside = (tables[0]["input_angle"] >= 34.0) & (tables[0]["input_angle"] <= 153.5)
        for column in tables[0].columns[2:]:
            assert np.isfinite(tables[0][column]).tolist() == inside.tolist()
            assert tables[0][column][inside].tolist() == tables[1][column][inside].tolist()
    with pytest.raises(MissingSection, match="at 200 deg the position of the lower rack is not known") as refused:
        register(cam=None, register={"at": 200.0}).report("register")
    assert refused.value.key == "cam"
    assert register(cam=None, register={"at": 60.0}).worst == register(register={"at": 60.0}).worst


def test_a_cam_that_cannot_be_is_refused_outside_the_zone_alone() -> None:
    made = register(cam__transition_end=100.0)
    assert made.worst == register().worst
    with pytest.raises(NoSolution) as refused:
        made.table("cycle")
    assert refused.value.key == "cam.transition_end"
