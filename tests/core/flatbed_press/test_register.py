"""Register of the press: gains against Richardson differences of the whole press with its cam, made elsewhere.

Tolerance: that of the reference differences, 2e-6 (mm per mm, mm per rad).
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.flatbed_press.register import PressGains
from gearlink.core.linkages import fourbar
from gearlink.core.linkages.fourbar import FourBar
from gearlink.core.linkages.loop_gains import loop_gains

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
    assert made._crank_per_stroke == pytest.approx((up - down) / 0.02, rel=1e-8)


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


@pytest.mark.parametrize("pin", "ABCDEFGHMN")
def test_every_pin_has_a_gain(pin: str) -> None:
    sources = {f"pins.{pin}": {"clearance": [0.01, 0.03]}}
    made = factory.design("ty460", command="register", tolerance={"sources": sources}, register={"tolerance": 0.02})
    assert 0.0 < made.rss[0] < made.worst[0] < 1.0


@pytest.mark.parametrize(
    "case", [c for c in CASES if c["input"]["what"] == "gripper-gains"], ids=lambda c: str(c["name"])
)
def test_loop_gains_are_the_reference(case: dict[str, Any]) -> None:
    """The gripper's loop A (230, 0), E (498, 55), 150, 260, 100 of the worked design."""
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
