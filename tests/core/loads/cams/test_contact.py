"""Rollers on cams: reference numbers, Hertz by its integral, closed forms.

1e-8 against the reference of the gripper, 1e-9 for integrals, 1e-12 for closed forms.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.studies.loads.contact import (
    SHEAR_DEPTH,
    LineContact,
    RollerOnCam,
    plane_modulus,
    positive_drive,
)

DATA = json.loads((Path(__file__).parents[3] / "reference" / "loads.json").read_text())
GRIPPER = DATA["gripper"]


@pytest.fixture(scope="module")
def gripper() -> Any:
    return factory.design("swing_gripper", command="loads", loads=GRIPPER["spec"])


def test_gripper_against_the_reference(gripper: Any) -> None:
    expected = GRIPPER["expected"]
    phi = np.radians(np.array(expected["at"], dtype=float))
    found = gripper.machine.reactions(phi)
    roller = gripper.roller_on_cam("main", phi)
    pairs = {
        "contact_force_main": gripper.contact_force("main", phi),
        "contact_force_return": gripper.contact_force("return", phi),
        "cam_torque": gripper.cam_torque(phi),
        "relative_radius_main": roller.relative_radius,
        "roller_speed_ratio_main": np.abs(roller.roller_speed),
        "entrainment_main": 1e-3 * roller.entrainment * gripper.speed,
        **{f"pin_{name}": found.unknowns[name].T for name in "ACDE"},
    }
    for name, values in pairs.items():
        wanted = np.array(expected[name])
        assert values == pytest.approx(wanted, abs=1e-8 * np.abs(wanted).max()), name
    assert gripper.contact_force_max == pytest.approx(
        [expected["contact_force_main_max"], expected["contact_force_return_max"]], rel=1e-9
    )
    assert gripper.contact_force_min[0] == pytest.approx(expected["contact_force_main_min"], rel=1e-9)
    assert gripper.hertz_pressure_max == pytest.approx(
        [expected["hertz_main_max"], expected["hertz_return_max"]], rel=1e-9
    )
    assert gripper.cam_torque_max == pytest.approx(expected["cam_torque_max"], rel=1e-9)
    assert gripper.cam_torque_min == pytest.approx(expected["cam_torque_min"], rel=1e-9)


def test_gripper_lifts_off_where_its_own_check_says(gripper: Any) -> None:
    """At that speed the minimum force is nothing: two ways to the same speed."""
    speed = gripper.lift_off_speed
    at_it = factory.design("swing_gripper", command="loads", loads=GRIPPER["spec"], speed=speed)
    assert min(at_it.contact_force_min) == pytest.approx(0.0, abs=1e-6 * max(at_it.contact_force_max))
    above = factory.design("swing_gripper", command="loads", loads=GRIPPER["spec"], speed=1.01 * speed)
    assert [check.status for check in above.check("contact-loss")].count("fail") >= 1


def test_torque_of_the_gripper_by_power_and_by_the_contacts(gripper: Any) -> None:
    phi = np.radians(np.arange(0.0, 360.0, 7.0))
    assert gripper.power_identity <= 1e-12
    sense = gripper.spec.cam.sense
    assert sense * gripper.cam_torque(phi) == pytest.approx(gripper.machine.torque(phi), abs=1e-10)


# Hertz


def test_an_undercut_cam_has_no_pressure() -> None:
    """A roller larger than the minimum curvature of the pitch curve, 124 mm: the other roller keeps its pressure."""
    whole = factory.design("loaded_gripper", command="loads")
    undercut = factory.design("loaded_gripper", command="loads", cam__roller__radius=150.0)
    assert undercut.hertz_pressure_max[0] is None
    assert undercut.shear_depth[0] is None
    assert undercut.hertz_pressure_max[1] == pytest.approx(whole.hertz_pressure_max[1], rel=1e-12)
    assert [check.status for check in undercut.check("contact-pressure")] == ["fail", "pass"]
    assert not list(undercut.candidates("contact-pressure"))


def test_pressure_adds_up_to_the_force() -> None:
    """An ellipse over the contact's width, p_max at its middle: its integral is N to 1e-9."""
    contact = LineContact(np.array([1700.0]), np.array([17.0]), 24.0, plane_modulus(206_000.0, 0.3))
    b, p = float(contact.half_width[0]), float(contact.pressure[0])
    t = (np.arange(200) + 0.5) * (math.pi / 200)  # x = b cos t: the integrand becomes sin^2, exact by midpoints
    assert np.mean(p * np.sin(t) ** 2) * math.pi * b * 24.0 == pytest.approx(1700.0, rel=1e-12)


def test_greatest_shear_below_a_line_contact() -> None:
    """Half the difference of the principal stresses on the axis, scanned: 0.30028 p at 0.78615 b."""
    depth = np.linspace(0.5, 1.1, 600_001)
    root = np.sqrt(1.0 + depth**2)
    shear = 0.5 * ((1.0 + 2.0 * depth**2) / root - 2.0 * depth - 1.0 / root) * -1.0
    top = int(np.argmax(shear))
    assert shear[top] == pytest.approx(0.3002831060007776, abs=1e-11)
    assert depth[top] == pytest.approx(SHEAR_DEPTH, abs=1e-5)
    assert pytest.approx(0.7861513777574233, abs=1e-15) == SHEAR_DEPTH


def test_relative_radius_is_that_of_roller_and_profile() -> None:
    """On an eccentric disc the pitch curve is a circle: 1/R = 1/r_g + kappa_c."""
    phi = np.linspace(0.0, 6.0, 30)
    center, pitch, r = 0.012, 0.055, 0.01
    # A roller whose centre stays on a circle about a point that turns with the cam, led along +x.
    turning = center * np.exp(1j * phi)
    rate, bend = 1j * turning, -turning
    x = turning.real + np.sqrt(pitch**2 - turning.imag**2)
    x1 = rate.real - turning.imag * rate.imag / np.sqrt(pitch**2 - turning.imag**2)
    root = np.sqrt(pitch**2 - turning.imag**2)
    x2 = bend.real - (rate.imag**2 + turning.imag * bend.imag) / root - (turning.imag * rate.imag) ** 2 / root**3
    roller = RollerOnCam(x + 0j, x1 + 0j, x2 + 0j, 1, r)
    assert roller.relative_radius == pytest.approx(1.0 / (1.0 / r + 1.0 / (pitch - r)), rel=1e-10)


def test_roller_speed_is_that_of_rolling() -> None:
    """A concentric disc: surface speeds agree, (r_c w_c)/(-r_g) with the cam's sense."""
    phi = np.linspace(0.0, 1.0, 3)
    at = np.full(3, 0.06 + 0j)
    roller = RollerOnCam(at, 0.0 * at, 0.0 * at, 1, 0.01)
    assert roller.roller_speed == pytest.approx(-0.05 / 0.01, rel=1e-13)
    assert roller.entrainment == pytest.approx(0.05, rel=1e-13)
    assert roller.roller_acceleration == pytest.approx(0.0, abs=1e-12)
    assert phi.size == 3


def test_acceleration_of_the_roller_is_the_slope_of_its_speed(gripper: Any) -> None:
    """Central difference of the speed ratio, 1e-6 of the largest; away from the joints of the law."""
    phi, h = np.radians([30.0, 75.0, 140.0, 230.0, 260.0]), 1e-5
    before, after = (gripper.roller_on_cam("main", phi + step).roller_speed for step in (-h, h))
    slope = (after - before) / (2.0 * h)
    assert gripper.roller_on_cam("main", phi).roller_acceleration == pytest.approx(
        slope, abs=1e-6 * np.abs(slope).max()
    )


# Positive drive


def test_positive_drive_opens_where_the_preload_ends() -> None:
    force = np.linspace(-900.0, 1200.0, 2101)
    stiffness = (2e5, 3e5)
    needed = max(0.6 * force.max(), -0.4 * force.min())
    one, other = positive_drive(force, needed, stiffness)
    assert min(one.min(), other.min()) == pytest.approx(0.0, abs=1e-9)
    assert one - other == pytest.approx(force, abs=1e-9)
    loose = positive_drive(force, 0.9 * needed, stiffness)
    assert min(loose[0].min(), loose[1].min()) == 0.0
    assert loose[0] - loose[1] == pytest.approx(force, abs=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "section",
    [{"gravity": [0.0, -9.81]}, {"forces": [{"on": "output", "resistance": 30.0}]}, {}],
    ids=["gravity", "resistance", "neither"],
)
def test_a_roller_of_the_gripper_is_without_force_at_the_speed_of_lift_off(section: dict[str, Any]) -> None:
    """The speed out of forces at rest and of the masses, against the force at that speed; 1e-9 of the 4 kN at rest."""
    given = {"roller": {"width": 30}, **section}
    speed = factory.design("loaded_gripper", command="loads", loads=given).lift_off_speed
    there = factory.design("loaded_gripper", command="loads", loads=given, speed=speed)
    assert min(there.contact_force_min) == pytest.approx(0.0, abs=4e-6)
    assert there.lift_off_speed == pytest.approx(speed, rel=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize("load", [{"forces": [{"on": "output", "torque": -150.0}]}, {}, {"gravity": [0.0, -9.81]}])
def test_the_spring_that_a_gripper_lacks_leaves_a_roller_without_force(load: dict[str, Any]) -> None:
    """With that torque, an empty section before, the least force of both rollers is 0; 1e-10 of some kN."""
    given = {"loads": {"roller": {"width": 30}, **load}}
    bare = factory.changed(factory.worked("loaded_gripper"), **given) | {"spring": None}
    made = factory.design(bare, command="loads")
    assert made.lacking_spring is not None
    key, torque = made.lacking_spring
    assert key == "spring.torque"
    sprung = factory.design(bare | {"spring": {"torque": torque}}, command="loads")
    assert min(sprung.contact_force_min) == pytest.approx(0.0, abs=1e-6)
    (lost, *_) = (check for check in made.findings("loads", "contact-loss") if check.status == "fail")
    assert lost.remedy
