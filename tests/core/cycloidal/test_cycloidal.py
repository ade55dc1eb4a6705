"""Cycloidal reducers: closed forms against searches, pole geometry, and the profile itself.

Tolerances: searches over fine rows are good to the square of the step; the backlash of many pins is that of some pins
to some percent (own derivation).
"""

from __future__ import annotations

import math
import re
from typing import Any

import mpmath
import numpy as np
import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st

from gearlink.core.machines.cycloidal.disc import Disc

GIVEN: dict[str, Any] = {
    "kind": "cycloidal-reducer",
    "pins": 12,
    "pin_circle_radius": 60.0,
    "pin_radius": 5.0,
    "eccentricity": 3.0,
    "discs": 2,
    "width": 12.0,
    "torque": 100.0,
    "output_pins": {"count": 6, "circle_radius": 30.0, "radius": 4.0},
}
FRICTION = {"friction": {"pins": 0.05, "output_pins": 0.04, "bearing": 0.003}, "bearing_radius": 10.0}


@given(pins=st.integers(4, 60), k=st.floats(0.05, 0.97))
def test_least_convex_radius_is_the_least_of_all(pins: int, k: float) -> None:
    disc = Disc(pins, 100.0, 1.0, k * 100.0 / pins)
    bend = disc.curvature(np.linspace(0.0, math.pi, 20_001))
    assert disc.min_convex_radius == pytest.approx(1.0 / bend.max(), rel=2e-6)
    assert disc.min_convex_radius <= 1.0 / bend.max() * (1.0 + 1e-12)


@given(pins=st.integers(4, 40), k=st.floats(0.2, 0.9), phi=st.floats(0.0, 6.28))
def test_normals_pass_the_pitch_point(pins: int, k: float, phi: float) -> None:
    """Levers by the moment of each normal; and a pin touches the profile there, in the disc's place."""
    disc = Disc(pins, 100.0, 2.0, k * 100.0 / pins)
    shares = disc.shares(np.array([phi]))
    arm = shares.places[0] - disc.eccentricity
    u = 2.0 * math.pi / pins * np.arange(pins) - phi
    assert -(np.conj(arm) * shares.normals[0]).imag == pytest.approx(disc.lever(u), abs=1e-11 * disc.pitch_radius)
    assert float(np.sum(shares.pins * np.abs(disc.lever(u)))) == pytest.approx(1.0, rel=1e-13)
    tau = -u / disc.lobes  # seen from a disc that stands so that a valley of it meets the pin at u = 0
    spot, _ = disc.profile(tau)
    seen = (spot * np.exp(1j * (u - tau))) + disc.eccentricity
    assert np.abs(seen - shares.places[0]) == pytest.approx(np.zeros(pins), abs=1e-10 * disc.circle)


def test_profile_has_its_radius_of_curvature() -> None:
    """By three points of the profile."""
    disc = design(GIVEN).disc
    tau, h = np.linspace(0.01, 1.0, 57), 1e-4
    a, b, c = (disc.profile(tau + way)[0] for way in (-h, 0.0, h))
    bend = 2.0 * ((b - a).conj() * (c - b)).imag / (np.abs(b - a) * np.abs(c - b) * np.abs(c - a))
    assert bend == pytest.approx(1.0 / disc.profile(tau)[1], abs=1e-4)


@pytest.mark.parametrize(("held", "ratio"), [("ring", -11.0), ("output", 12.0)])
@pytest.mark.parametrize("discs", [1, 2, 3])
def test_links_in_motion_carry_what_the_pins_do(held: str, ratio: float, discs: int) -> None:
    """Virtual work of the whole machine; the eccentric's bearing bears the pins of ring and output."""
    loads = design(
        {key: value for key, value in GIVEN.items() if key not in ("torque", "width")}, command="loads",
        discs=discs, fixed=held, loads={"speed": 100.0, "forces": [{"on": "output", "resistance": 100.0}]},
    )  # fmt: skip
    phi = np.linspace(0.1, 6.0, 23)
    reactions = loads.machine.reactions(phi)
    assert reactions.torque == pytest.approx(np.full(phi.size, 100.0 / abs(ratio)), rel=1e-9)
    found = design(GIVEN, discs=discs, fixed=held)
    assert found.ratio == ratio
    seen = phi * (11.0 / 12.0 if held == "output" else 1.0)
    ring = found.disc.shares(seen).of_ring
    outputs = np.sum(found.disc.shares(phi if held == "output" else phi * 12.0 / 11.0, 6, 30.0).outputs, axis=1)
    assert reactions.force("E1") == pytest.approx(-found.disc_torque * (ring - outputs) * np.exp(1j * phi), rel=1e-9)
    assert found.disc_torque * discs * abs(ratio) == pytest.approx(1e5 * found.disc.lobes, rel=1e-12)


@pytest.mark.parametrize("held", ["ring", "output"])
def test_a_torque_the_other_way_is_a_mirror_image(held: str) -> None:
    """Turned backwards with its torque reversed the reducer is its own mirror image about the line through pin 1."""
    one, other = (
        design(
            {key: value for key, value in GIVEN.items() if key not in ("torque", "width")}, command="loads",
            fixed=held, loads={"speed": 100.0, "forces": [{"on": "output", "torque": torque}]},
        ).machine.reactions(phi)
        for torque, phi in ((70.0, np.linspace(0.1, 6.0, 23)), (-70.0, -np.linspace(0.1, 6.0, 23)))
    )  # fmt: skip
    for name in ("E1", "E2", "A", "D"):
        assert one.force(name) == pytest.approx(np.conj(other.force(name)), rel=1e-9, abs=1e-9)
    assert one.torque == pytest.approx(-other.torque, rel=1e-9)


def test_the_pins_of_the_table_stand_on_the_circle() -> None:
    """Numbered from 1, the lever e z |sin| of the angle from the pitch point on the circle of radius e z."""
    found = design(GIVEN)
    table, k = found.table("pins"), np.arange(12)
    assert list(table["pin"]) == list(range(1, 13))
    assert table["angle"] == pytest.approx(30.0 * k, rel=1e-14)
    place, pitch = 60.0 * np.exp(1j * math.pi / 6.0 * k), 3.0 * 12.0  # pitch point of the ring on +x; disc centre at e
    normal = (place - pitch) / np.abs(place - pitch)
    assert table["lever"] == pytest.approx(np.abs((np.conj(pitch - 3.0) * normal).imag), rel=1e-12, abs=1e-12)


def test_greatest_forces_are_those_of_fine_rows() -> None:
    found = design(GIVEN, **FRICTION)
    phi = np.linspace(0.0, 2.0 * math.pi, 7201)
    shares = found.disc.shares(phi, 6, 30.0)
    assert found.pin_force_max == pytest.approx(found.worst_torque * shares.pins.max(), rel=1e-6)
    assert found.pin_force_max >= found.worst_torque * shares.pins.max() * (1.0 - 1e-12)
    assert found.contact_stress == pytest.approx(found.stresses(phi).max(), rel=1e-6)
    assert found.output_pin_force_max == pytest.approx(found.worst_torque * shares.outputs.max(), rel=1e-6)
    lost = 2.0 * 50.0 * float(np.mean(found._losses(phi[:-1])))
    assert found.efficiency == pytest.approx(100.0 / 11.0 / (100.0 / 11.0 + lost), rel=1e-6)
    assert design(GIVEN, **FRICTION, uneven=1.5).pin_force_max == pytest.approx(1.5 * found.pin_force_max, rel=1e-12)


@pytest.mark.parametrize("fixed", ["ring", "output"])
def test_each_joint_loses_its_force_times_its_sliding(fixed: str) -> None:
    """Speeds from the mechanism: of output pins and bearings against their disc, of a disc against the ring."""
    keys = {**GIVEN, "fixed": fixed, "bearing_radius": 10.0}
    phi = np.linspace(0.1, 6.0, 23)
    found = {
        name: design(keys, friction={"pins": 0.0, "output_pins": 0.0, "bearing": 0.0} | {name: 0.1})
        for name in ("pins", "output_pins", "bearing")
    }
    any_one = found["pins"]
    links, shares = any_one.moving.at(phi, 1).links, any_one.disc.shares(phi, 6, 30.0)
    disc = links["disc_1"].turn.first
    ring = links["output"].turn.first if fixed == "output" else 0.0
    swinging, rolling = np.abs(1.0 - disc), np.abs(disc - ring)
    outputs = shares.outputs.sum(axis=1)
    assert found["output_pins"]._losses(phi) == pytest.approx(0.1 * 3.0 * outputs * swinging, rel=1e-12)
    bearing = np.abs(shares.of_ring + outputs)
    assert found["bearing"]._losses(phi) == pytest.approx(0.1 * 10.0 * bearing * swinging, rel=1e-12)
    levers = np.abs(shares.places - 3.0 * 12.0)
    assert found["pins"]._losses(phi) == pytest.approx(0.1 * (shares.pins * levers).sum(axis=1) * rolling, rel=1e-12)


@pytest.mark.slow
def test_backlash_is_where_the_ground_disc_meets_a_pin() -> None:
    """By the distance of the ground profile from every pin, the disc turned to and fro."""
    many = design(GIVEN, pins=40, eccentricity=0.9, pin_radius=2.0, modification={"offset": 0.01, "pin_circle": -0.02})
    disc = many.disc
    ground = disc.ground(*many.changes)
    points = ground.profile(np.linspace(0.0, 2.0 * math.pi, 120_001))[0]
    pin = disc.circle * np.exp(2j * math.pi * np.arange(disc.pins) / disc.pins) - disc.eccentricity

    def least(turn: float) -> float:
        near = pin * np.exp(-1j * turn)
        index = [int(np.argmin(np.abs(points - each))) for each in near]
        return float(np.min(np.abs(points[index] - near))) - disc.pin

    from scipy.optimize import brentq

    ends = [brentq(least, 0.0, way * 2e-3, xtol=1e-7) for way in (1.0, -1.0)]
    assert ends[0] - ends[1] == pytest.approx(many.backlash, rel=0.04)
    plain = design(GIVEN, modification={"offset": 0.02})
    assert plain.backlash == pytest.approx(2.0 * 0.02 / (3.0 * 11.0), rel=1e-9)


@pytest.mark.slow
def test_checks_on_both_sides_of_their_limits() -> None:
    material = {"contact_limit": 700.0}
    assert {each.status for each in design(GIVEN, material=material).report("analyze").checks} == {"pass"}
    for keys, name, status in (
        ({"pin_radius": 15.0}, "undercut", "warn"),
        ({"pin_radius": 17.7}, "undercut", "fail"),
        ({"pin_radius": 15.6}, "gear-collision", "fail"),
        ({"output_pins__radius": 12.0}, "shaft-clearance", "fail"),
        ({"modification": {"offset": 0.01, "pin_circle": 0.02}}, "interference", "fail"),
        ({"eccentricity": 1.9}, "shortening", "warn"),
        ({"eccentricity": 4.1}, "shortening", "warn"),
        ({"material": {"contact_limit": 600.0}}, "pitting", "fail"),
    ):
        found = [each.status for each in design(GIVEN, **keys).report("analyze").checks if each.name == name]
        assert status in found, keys
    assert design(GIVEN, modification={"offset": 0.01, "pin_circle": 0.02}).backlash is None


def test_the_web_to_the_lobes_is_that_of_the_ground_disc() -> None:
    """Against the nearest point of the profile that is ground for thicker pins on a smaller circle."""
    found = design(GIVEN, modification={"offset": 0.05, "pin_circle": -0.04})
    profile = found.table("profile")
    nearest = np.hypot(profile["x"], profile["y"]).min()  # the first row is a root
    hole = GIVEN["output_pins"]["circle_radius"] + found.output_hole_radius
    (web,) = [each.value for each in found.check("shaft-clearance") if "roots of the lobes" in each.what]
    assert web == pytest.approx(nearest - hole, rel=1e-9, abs=0.0)


@pytest.mark.parametrize("away", [1e-3, 1e-9, 1e-14])
def test_lobes_that_all_but_loop(away: float) -> None:
    """K next to 1: Q and the curvature's numerator lost all digits, and the lever of the pin at 0 was 0/0."""
    disc = Disc(12, 60.0, 1.0, 5.0 * (1.0 - away))
    u = np.array([0.0, 1e-9, 1e-5, 1.0])
    assert disc.lever(u)[0] == 0.0
    with mpmath.workdps(40):
        k, at = mpmath.mpf(disc.shortening), [mpmath.mpf(each) for each in u]
        root = [mpmath.sqrt(1 + k * k - 2 * k * mpmath.cos(each)) for each in at]
        bend = [(1 + 12 * k * k - 13 * k * mpmath.cos(x)) / (60 * q**3) for x, q in zip(at, root, strict=True)]
    np.testing.assert_allclose(disc.q(u), np.array(root, dtype=float), rtol=1e-14)  # some roundings of K, sin and root
    np.testing.assert_allclose(disc.curvature(u), np.array(bend, dtype=float), rtol=1e-13)


@pytest.mark.parametrize("pins", [7, 12, 49])
def test_the_largest_eccentricity_that_is_no_loop_is_computed(pins: int) -> None:
    """The first below R/Z that is taken, by 0 to some ulp."""
    eccentricity = 60.0 / pins
    while eccentricity * pins / 60.0 >= 1.0:
        with pytest.raises(ValueError, match="loops"):
            design(GIVEN, pins=pins, eccentricity=eccentricity)
        eccentricity = math.nextafter(eccentricity, 0.0)
    found = design(GIVEN, pins=pins, eccentricity=eccentricity)
    assert np.isfinite(found.table("pins")["force"]).all()


def test_no_flank_is_stressed_where_one_is_undercut() -> None:
    """Pins of the table that are larger than the hollow they lie in had the root of a negative number for a stress."""
    keys = {"pins": 36, "eccentricity": 1.666}
    undercut = design(GIVEN, **keys)
    assert undercut.min_curvature_radius < 5.0
    assert undercut.contact_stress is None
    assert list(undercut.table("pins").columns) == ["pin", "angle", "lever", "force", "gap"]
    assert "stress" in design(GIVEN).table("pins").columns


def test_refusals() -> None:
    for keys, words in (
        ({"eccentricity": 5.0}, "loops"),
        ({"pin_radius": 57.0}, "no disc"),
        ({"friction": {"bearing": 0.01}}, "bearing_radius"),
        ({"friction": {"pins": 0.01}, "output_pins": None}, "output_pins"),
    ):
        with pytest.raises(ValueError, match=words):
            design(GIVEN, **keys)


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("undercut", {"pin_circle_radius": 37}),
        ("gear-collision", {"pin_radius": 16}),
        ("shaft-clearance", {"output_pins__radius": 16}),
        ("shaft-clearance", {"output_pins__circle_radius": 47}),
        ("pitting", {"torque": 30000}),
        ("pitting", {"width": 0.2}),
        ("interference", {"modification__pin_circle": 0.5}),
    ],
)
def test_the_value_that_a_finding_names_repairs_it(name: str, keys: dict[str, Any]) -> None:
    """Closed forms: the stress falls with the root of the width, the gap grows with the offset, a hole with its pin."""
    found = design("cycloidal_reducer", **keys).check(name)
    bad = [check for check in found if check.status == "fail"]
    assert bad
    for check in bad:
        (key, bound, value) = re.findall(r"set ([\w.]+) (to at least|to at most|below) ([\d.]+)", check.advice)[0]
        applied = float(value) * (1.0 - 1e-9 if bound == "below" else 1.0)
        after = design("cycloidal_reducer", **(keys | {key.replace(".", "__"): applied})).check(name)
        assert after[found.index(check)].status != "fail", check.advice
