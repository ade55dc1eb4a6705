"""Register of the press: gains against Richardson differences of the whole press with its cam, made elsewhere.

Tolerance: that of the reference differences, 2e-6 (mm per mm, mm per rad). Against the exact chain differences over
h = 1 um, whose own error is h^2 and eps/h: 2e-8. Hand formulas: rounding alone, 1e-12.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from oracles.loop_gains import loop_gains
from oracles.press_gains import PressGains
from oracles.press_register_chain import PressErrors, register_error
from sweeps import spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.flatbed_press.register import RackLift
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.position import FourBar

CASES = json.loads((Path(__file__).parents[2] / "reference/tolerance.json").read_text(encoding="utf-8"))
LINKS = dict(zip("abcd", ("crank", "coupler", "rocker", "frame"), strict=True))
SLIDER = {"crank": "crank", "rod": "rod", "off": "offset", "cde": "angle"}


def _gain(gains: PressGains, name: str) -> Any:
    chain, _, link = name.partition("_")
    if name == "bed_phi":
        return gains.cylinder_rate
    if name == "cyl_phi":
        return -gains.cylinder_rate
    if name in SLIDER:
        return gains.slider_crank[SLIDER[name]]
    if chain == "bed":
        return gains.bed(getattr(gains.bed_links, LINKS[link]))
    return gains.cylinder(getattr(gains.cylinder_links, LINKS[link]))


@pytest.mark.parametrize(
    "case", [c for c in CASES if c["input"]["what"] == "press-gains"], ids=lambda c: str(c["name"])
)
def test_gains_are_the_reference(case: dict[str, Any]) -> None:
    gains = PressGains(factory.design("ty460"), np.radians([case["input"]["phi"]]))
    assert gains.cam_slope[0] == pytest.approx(case["input"]["cam_slope"], abs=1e-8)
    for name, wanted in case["expected"].items():
        assert _gain(gains, name)[0] == pytest.approx(wanted, abs=case["tolerance"]), name


def test_the_stroke_stands_for_the_crank() -> None:
    made = factory.design("ty460", command="register", tolerance={"sources": {"bed.stroke": {"plus_minus": 0.1}}})
    up, down = (factory.design("ty460", bed__stroke=620.0 + d).motion.slider_crank.crank_length for d in (0.01, -0.01))
    assert 0.5 * made.design.motion.slider_crank.crank_per_stroke == pytest.approx((up - down) / 0.02, rel=1e-8)


def test_contributions_of_the_printed_budget() -> None:
    """um per 0.01 mm over the zone 34.0..153.57 deg, as printed to 0.1."""
    wanted = {
        "bed.double_crank.frame": 37.5,
        "cylinder.double_crank.frame": 36.0,
        "bed.double_crank.crank": 12.9,
        "bed.rod": 1.2,
        "bed.offset": 3.7,
        "cylinder.double_crank.rocker": 15.1,
    }
    made = factory.design(
        "ty460", command="register", tolerance={"sources": {key: {"plus_minus": 0.01} for key in wanted}}
    )
    found = made.contributions(made.input_angles, 1)
    for one in found:
        relative = one.gain - one.gain[0]
        assert 10.0 * float(np.ptp(relative)) == pytest.approx(wanted[one.source], abs=0.051), one.source


@pytest.mark.quick(1)
@pytest.mark.parametrize("pin", "ABCDEFGHMN")
def test_every_pin_has_a_gain(pin: str) -> None:
    sources = {f"pins.{pin}": {"clearance": [0.01, 0.03]}}
    made = factory.design("ty460", command="register", tolerance={"sources": sources}, register={"tolerance": 0.02})
    assert 0.0 < made.rss[0] < made.worst[0] < 1.0


@pytest.mark.parametrize(
    "case", [c for c in CASES if c["input"]["what"] == "gripper-gains"], ids=lambda c: str(c["name"])
)
def test_loop_gains_are_the_reference(case: dict[str, Any]) -> None:
    """The gripper's loop A (230, 0), E (498, 55), 150, 260, 100 of the example."""
    frame = complex(268.0, 55.0)
    direction = math.atan2(frame.imag, frame.real)
    crank = math.radians(case["input"]["theta1"])
    linkage = FourBar(150.0, 260.0, 100.0, abs(frame), case["input"]["assembly"])
    state = fourbar.solve(linkage, crank - direction)
    angles = (crank, state.coupler_angle + direction, state.rocker_angle + direction)
    gains = loop_gains(*(np.array([angle]) for angle in angles), 100.0)
    for name, wanted in case["expected"].items():
        if name in LINKS:
            assert getattr(gains, LINKS[name])[0] == pytest.approx(wanted, abs=case["tolerance"])
        elif name != "th1":
            got = gains.pin[0] * (1.0 if name == "gA" else -1.0)
            assert [got.real, got.imag] == pytest.approx(wanted, abs=case["tolerance"])


KEYS = [f"{chain}.double_crank.{link}" for chain in ("bed", "cylinder") for link in LINKS.values()]
KEYS += ["bed.stroke", "bed.rod", "bed.offset", "bed.crank_offset_angle"]
KEYS += ["cylinder.initial_crank_angle", "cylinder.radius"]
SOURCES = {key: {"plus_minus": 0.01} for key in KEYS} | {f"pins.{p}": {"clearance": [0.0, 0.02]} for p in "ABCDEFGHMN"}


def press(sources: dict[str, Any] = SOURCES, **register: Any) -> Any:
    return factory.design("ty460", command="register", tolerance={"sources": sources}, register=register)


@pytest.mark.slow
def test_gains_are_the_slopes_of_the_exact_chain() -> None:
    made, phi, h = press(), np.radians(spread([34.0, 70.0, 120.0, 150.0], 2)), 1e-3
    none = dict.fromkeys(SOURCES, 0.0)
    for one in made.contributions(phi, 1):
        for axis in (1.0, 1j) if np.iscomplexobj(one.gain) else (1.0,):
            ends = [made.sampled_errors(phi, 1, none | {one.source: np.array([h * s * axis])})[:, 0] for s in (1, -1)]
            assert (ends[0] - ends[1]) / (2.0 * h) == pytest.approx((one.gain * axis).real, abs=2e-8), one.source


def test_gains_by_duality_are_those_derived_by_hand() -> None:
    made, phi = press(), np.radians([34.0, 70.0, 120.0, 150.0, 200.0, 300.0])
    by_hand = PressGains(made.design, phi)
    for one in made.contributions(phi, 1):
        assert one.gain == pytest.approx(
            by_hand.of(one.source, 0.5 * made.design.motion.slider_crank.crank_per_stroke), abs=1e-12
        ), one.source


def test_a_given_crank_has_the_gain_of_the_crank() -> None:
    phi = np.radians([34.0, 70.0, 120.0, 150.0, 200.0, 300.0])
    bed = press().design.spec.bed.model_dump(exclude_unset=True)
    bed["crank"] = press().design.motion.slider_crank.crank_length
    del bed["stroke"]
    sources = {"sources": {"bed.crank": {"plus_minus": 0.01}}}
    made = factory.design("ty460", command="register", bed=bed, tolerance=sources, register={})
    (one,) = [one for one in made.contributions(phi, 1) if one.source == "bed.crank"]
    assert one.gain == pytest.approx(PressGains(made.design, phi).of("bed.stroke", 1.0), abs=1e-12)


def test_the_whole_chain_is_the_one_closed_by_hand() -> None:
    """Errors of 0.01 mm and 0.01 deg at once; what is left is the rounding of 620 mm."""
    made, phi, random = press(), np.radians([34.0, 70.0, 120.0, 150.0, 200.0]), np.random.default_rng(1)
    parts = {key: 0.01 * random.uniform(-1.0, 1.0, 5) for key in KEYS}
    parts |= {f"pins.{pin}": 0.01 * np.exp(6j * random.uniform(size=5)) for pin in "ABCDEFGHMN"}
    others = {
        "bed.stroke": ("crank", 0.5 * made.design.motion.slider_crank.crank_per_stroke),
        "bed.crank_offset_angle": ("angle", math.radians(1.0)),
        "cylinder.initial_crank_angle": ("cylinder.angle", math.radians(1.0)),
    }
    by_hand = {}
    for key, error in parts.items():
        plain = key.replace(".double_crank", "").removeprefix("pins.")
        name, scale = others.get(key, (plain, 1.0))
        name = {"bed.rod": "rod", "bed.offset": "offset", "cylinder.radius": "radius"}.get(name, name)
        by_hand[name] = scale * error
    wanted = register_error(RackLift(made.design), phi[:, None], PressErrors(by_hand))
    assert made.sampled_errors(phi, 1, parts) == pytest.approx(wanted, abs=1e-11)


@pytest.mark.quick(1)
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("mesh", ["mesh_12", "mesh_34", "rack_lower", "rack_upper"])
def test_backlash_of_one_mesh_is_the_hand_formula(mesh: str, sign: int) -> None:
    """Input mesh: half the backlash over the working radius, by q'; the others: half of it, on the side of q''."""
    play, frame = 0.03, {"bed.rod": {"plus_minus": 0.01}}
    made = press(frame, backlash={mesh: play})
    (one,) = [one for one in made.contributions(made.input_angles, sign) if one.source == f"backlash of {mesh}"]
    travel = made.design.motion.cylinder.travel(made.input_angles, 2)
    wanted = {
        "mesh_12": sign * 0.5 * play * travel.first / (0.5 * math.hypot(290.0, 13.0)),
        "mesh_34": 0.5 * play * np.sign(travel.second),
    }.get(mesh, -0.5 * play * np.sign(travel.second))
    assert one.mean * one.gain == pytest.approx(wanted, abs=1e-12)
    row = next(row for row in made.budgets[0 if sign == 1 else 1].rows if row.source == one.source)
    assert (row.sigma, row.share) == (0.0, 0.0)
    assert made.dead_band == pytest.approx(2.0 * float(np.abs(wanted).max()), abs=1e-12)


def test_a_force_that_turns_within_the_zone_jumps_by_the_racks_backlash() -> None:
    made = press(SOURCES, backlash={"rack_lower": 0.01, "rack_upper": 0.02, "mesh_12": 0.05})
    (flip,) = [flip for flip in made.flips if made.input_angles[0] < flip < made.input_angles[-1]]
    assert abs(made.design.motion.cylinder.travel(flip, 2).second) < 1e-9
    (found,) = made.check("backlash-in-dwell")
    assert found.status == "warn"
    assert made.jump == pytest.approx(0.03, abs=1e-15)
    mean = made.budgets[0].mean - press(SOURCES, backlash={"mesh_12": 0.05}).budgets[0].mean
    before = made.input_angles < flip
    assert mean[before] == pytest.approx(0.0, abs=1e-15)
    assert np.abs(mean[~before]) == pytest.approx(0.03, abs=1e-12)


def test_a_mesh_that_does_not_exist_and_gears_that_are_not_given_are_refused() -> None:
    with pytest.raises(NoSolution, match="no mesh 'mesh_99'"):
        press(backlash={"mesh_99": 0.01}).report("register")
    made = factory.design(
        "ty460", command="register", tolerance={"sources": SOURCES}, register={"backlash": 0.01}, input_gears=None
    )
    with pytest.raises(NoSolution, match="input_gears"):
        made.report("register")


def test_a_machine_that_does_not_close_has_no_error() -> None:
    """The others have theirs; the angle of its slider's crank was refused for all."""
    frame, phi = "bed.double_crank.frame", np.radians([70.0, 120.0])
    made, none = press({frame: {"plus_minus": 0.005}}), np.array([0.0, 200.0, 0.005])
    found = made.sampled_errors(phi, 1, {frame: none})
    assert np.isnan(found[:, 1]).all()
    alone = [made.sampled_errors(phi, 1, {frame: none[[k]]})[:, 0] for k in (0, 2)]
    assert found[:, [0, 2]] == pytest.approx(np.transpose(alone), abs=1e-12)


@pytest.mark.slow
def test_samples_of_the_chain_are_the_budget() -> None:
    """Sources of this size are linear; cam error and backlash are counted in both. A quantile of 2^14 samples: 2 %."""
    sizes = {key: one for key, one in SOURCES.items() if not key.startswith("pins")}
    more = {"backlash": {"mesh_12": 0.02, "rack_upper": 0.01}, "cam_error": 0.01}
    made, by_samples = press(sizes, **more), press(sizes, method="mc", **more)
    assert by_samples.band == pytest.approx(made.band, rel=0.03)


def test_the_side_on_which_the_bed_lies_changes_no_gain() -> None:
    sources = {
        f"{chain}.double_crank.{link}": {"plus_minus": 0.02}
        for chain in ("bed", "cylinder")
        for link in ("crank", "coupler", "rocker", "frame")
    }
    sources |= {"bed.offset": {"plus_minus": 0.02}, "bed.crank_offset_angle": {"plus_minus": 0.01}}
    phi = np.radians([50.0, 110.0, 200.0])
    one, other = (
        factory.design("ty460", command="register", tolerance={"sources": sources}, loads={"bed_side": side})
        for side in (1, -1)
    )
    for here, there in zip(one.contributions(phi, 1), other.contributions(phi, 1), strict=True):
        assert here.gain == pytest.approx(there.gain, rel=1e-10, abs=1e-12), here.source
