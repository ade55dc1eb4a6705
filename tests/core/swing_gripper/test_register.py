"""Register of the gripper: gains of every part and the whole chain, against those derived by hand, and samples.

Differences over h = 1 um: their own error is h^2 and eps/h, 1e-7.
"""

from __future__ import annotations

from typing import Any

import factory
import numpy as np
import pytest
from oracles.gripper_register import GripperByHand
from oracles.gripper_register_contact import roller_contact
from scipy.optimize import brentq

from gearlink.core.base.errors import NoSolution

SOURCES: dict[str, Any] = {
    key: {"plus_minus": 0.01}
    for key in (
        "links.input",
        "links.coupler",
        "links.output",
        "pivots.input[0]",
        "pivots.input[1]",
        "pivots.output[0]",
        "pivots.output[1]",
        "arm.direction",
        "cam.center[0]",
        "cam.center[1]",
        "cam.roller.arm",
        "cam.roller.radius",
        "cam.roller.angle",
    )
} | {f"pins.{pin}": {"clearance": [0.0, 0.01]} for pin in "ACDE"}


PAIR: tuple[dict[str, Any], ...] = ({"cam": None, "spring": None, "inertia": None}, {})


def gripper(sources: dict[str, Any] = SOURCES, **more: Any) -> Any:
    kept = {key: more.pop(key) for key in PAIR[0] if key in more}
    return factory.design("swing_gripper", command="register", tolerance={"sources": sources}, register=more, **kept)


def test_gains_are_the_slopes_of_the_exact_chain() -> None:
    made, phi, h = gripper(), np.radians([60.0, 106.0, 200.0]), 1e-3
    none = dict.fromkeys(SOURCES, 0.0)
    for one in made.contributions(phi, 1):
        for axis in (1.0, 1j) if np.iscomplexobj(one.gain) else (1.0,):
            ends = [made.sampled_errors(phi, 1, none | {one.source: np.array([h * s * axis])})[:, 0] for s in (1, -1)]
            assert (ends[0] - ends[1]) / (2.0 * h) == pytest.approx((one.gain * axis).real, abs=1e-7), one.source


def test_gains_by_duality_are_those_derived_by_hand() -> None:
    made, phi = gripper(), np.radians([60.0, 106.0, 200.0])
    by_hand = GripperByHand(made.design, phi)
    for one in made.contributions(phi, 1):
        assert one.gain == pytest.approx(by_hand.gain(one.source), abs=1e-12), one.source


def test_the_whole_chain_is_the_one_closed_by_hand() -> None:
    """Errors of 0.01 mm and 0.01 deg at once; what is left is the rounding of 560 mm."""
    made, phi, random = gripper(), np.radians([60.0, 106.0, 200.0]), np.random.default_rng(1)
    parts = {key: 0.01 * random.uniform(-1.0, 1.0, 5) for key in SOURCES}
    parts |= {f"pins.{pin}": 0.01 * np.exp(6j * random.uniform(size=5)) for pin in "ACDE"}
    found = made.sampled_errors(phi, 1, parts)
    assert found == pytest.approx(GripperByHand(made.design, phi).error(parts), abs=1e-11)


def test_an_axis_and_its_pin_move_the_tip_alike() -> None:
    """E moved by 10 um is a pin that lies 10 um aside: the gripper turns, and its axis takes the tip along."""
    gains = {one.source: one.gain for one in gripper().contributions(np.radians([106.0]), 1)}
    assert gains["pivots.output[0]"] == pytest.approx(gains["pins.E"].real, abs=1e-14)
    assert gains["pivots.output[1]"] == pytest.approx((1j * gains["pins.E"]).real, abs=1e-14)


def test_a_whole_machine_that_is_moved_moves_its_tip_as_much() -> None:
    """A, E and the cam's axis moved by one vector: no link turns, the tip goes with it."""
    gains = {one.source: one.gain for one in gripper().contributions(np.radians([60.0, 106.0]), 1)}
    places = ("pivots.input", "pivots.output", "cam.center")
    both = sum(gains[f"{place}[0]"] + 1j * gains[f"{place}[1]"] for place in places)
    assert np.abs(both) == pytest.approx(1.0, abs=1e-12)


def test_a_pivot_without_a_cam_moves_the_tip_through_the_loop_alone() -> None:
    """Then it is the pin C that counts, wherever it comes from; with the cam its roller holds the rocker back."""
    sources = {key: SOURCES[key] for key in ("pins.A", "pins.C")}
    phi = np.radians([60.0, 106.0])
    bare, rolling = ({one.source: one.gain for one in gripper(sources, **more).contributions(phi, 1)} for more in PAIR)
    assert bare["pins.A"] == pytest.approx(bare["pins.C"], abs=1e-14)
    assert np.abs(rolling["pins.A"])[1] < 0.5 * np.abs(rolling["pins.C"])[1]


@pytest.mark.slow
def test_samples_of_the_chain_are_the_budget() -> None:
    sizes = {key: one for key, one in SOURCES.items() if not key.startswith("pins")}
    more = {"cam_error": 0.01}
    assert gripper(sizes, method="mc", **more).band == pytest.approx(gripper(sizes, **more).band, rel=0.03)


def test_what_is_no_source_of_the_register_is_refused() -> None:
    """At its own line, with the sizes that are."""
    with pytest.raises(NoSolution, match="is no source of the register of the tip") as refused:
        gripper({"links.input": {"plus_minus": 0.01}, "arm.length": {"plus_minus": 0.01}}).report("register")
    assert refused.value.key == 'tolerance.sources."arm.length"'
    assert "links.input, links.coupler" in refused.value.fix


@pytest.mark.parametrize("degrees", [60.0, 106.0, 200.0])
def test_a_roller_that_is_moved_stays_on_its_cam(degrees: float) -> None:
    """The pitch curve itself, searched for the point at the arm's distance from the moved pivot: no normal, no bend.

    Errors of 0.05 mm on a cam of 100 mm leave some 1e-10 of the parabola's third order.
    """
    made, phi = gripper(), np.radians([degrees])
    cams, motion = made.design.cams, made.design.linkage.motion(np.array([degrees]), 0)
    off = {"arm": 0.05, "radius": 0.0, "angle": 0.02, "A": 0.03 - 0.05j, "center": -0.02 + 0.04j}
    pivot = complex(*made.spec.pivots.input) + off["A"]
    axis, turn = cams.center + off["center"], np.exp(1j * cams.main_cam.sense * phi[0])

    def roller(angle: float) -> complex:
        return complex(axis + turn * cams.main_cam.points(np.array([angle]))[0][0])

    length = cams.section.roller.arm + off["arm"]
    place = brentq(lambda angle: abs(roller(angle) - pivot) - length, phi[0] - 0.05, phi[0] + 0.05, xtol=1e-15)
    wanted = np.angle((roller(place) - pivot) * np.exp(-1j * (motion.input.value[0] + np.radians(49.02))))
    found = roller_contact(cams, motion, phi).turned(off)
    assert float(found[0, 0]) == pytest.approx(float(wanted), abs=1e-9)
    assert abs(wanted) > 1e-5


def test_a_thicker_roller_lifts_as_the_profile_does() -> None:
    """The offset of a disc cam: both turn the rocker by the same."""
    made = gripper({"cam.roller.radius": {"plus_minus": 0.01}}, cam_error=0.01)
    roller, profile = made.contributions(np.radians([60.0, 106.0, 200.0]), 1)
    assert np.abs(roller.gain) == pytest.approx(profile.gain, rel=1e-14)
