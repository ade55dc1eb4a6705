"""A pinion at the rod end between two racks: closed forms against rolling by steps, gear pairs, and virtual work.

Tolerances: rounding; a pair of a very large wheel differs from a rack by the inverse of its teeth.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.cli.texts.codes import key_of

GIVEN: dict[str, Any] = {
    "kind": "slider-crank",
    "stroke": 310.0,
    "rod": 520.0,
    "offset": 50.0,
    "racks": {"module": 4.0, "fixed": 50, "moving": 30, "side": "opposite"},
}


@pytest.mark.parametrize(("side", "ratio"), [("opposite", 1.6), ("same", 0.4)])
def test_the_pinion_rolls_without_slip(side: str, ratio: float) -> None:
    """Speeds of the pinion's points on both pitch lines: that of the frame, and that of the rack."""
    found = design(GIVEN, racks__side=side)
    phi = np.linspace(0.1, 6.2, 31)
    links = found.moving.at(phi, 1).links
    axis, spin = links["pinion"].origin.first, links["pinion"].turn.first
    way = 1.0 if side == "opposite" else -1.0
    assert axis + 1j * spin * 100.0 == pytest.approx(np.zeros(31), abs=1e-10)
    assert axis - way * 1j * spin * 60.0 == pytest.approx(links["rack"].origin.first, abs=1e-10)
    assert links["rack"].origin.first == pytest.approx(ratio * axis, abs=1e-10)
    assert found.raw("stroke_ratio") == pytest.approx(ratio, rel=1e-15)
    place = found.table("motion")["output_displacement"]
    assert np.ptp(found.table("motion", samples=7200)["output_displacement"]) == pytest.approx(310.0 * ratio, abs=1e-3)
    assert found.raw("output_stroke") == pytest.approx(310.0 * ratio, rel=1e-14)
    assert np.ptp(place) <= 310.0 * ratio
    turned = found.moving.at(np.array([found.dead_center_folded_at, found.dead_center_extended_at]), 0).links
    angle = np.diff(turned["pinion"].turn.value)[0]
    assert abs(angle) == pytest.approx(2.0 * math.pi * found.raw("pinion_turns"), rel=1e-12)


@pytest.mark.parametrize("side", ["opposite", "same"])
def test_forces_by_virtual_work(side: str) -> None:
    loads = design(GIVEN, command="loads", racks__side=side,
                   loads={"speed": 60.0, "forces": [{"on": "rack", "force": 100.0}]})  # fmt: skip
    phi = np.linspace(0.2, 6.0, 17)
    reactions = loads.machine.reactions(phi)
    ratio = 1.6 if side == "opposite" else 0.4
    assert np.abs(reactions.unknowns["mesh_moving"][0]) == pytest.approx(np.full(17, 100.0), rel=1e-12)
    assert np.abs(reactions.unknowns["mesh_fixed"][0]) == pytest.approx(np.full(17, 60.0), rel=1e-12)
    assert np.abs(reactions.force("F").imag) == pytest.approx(np.full(17, 100.0 * ratio), rel=1e-12)
    assert loads.power_identity < 1e-9


@pytest.mark.quick(1)
@pytest.mark.parametrize("lossy", ["mesh_fixed", "mesh_moving"])
def test_each_mesh_loses_its_share_of_what_it_passes_on(lossy: str) -> None:
    """Seen from the pinion's axis the fixed rack drives the pinion, and this the moving one, against 350 N."""
    racks = {"module": 4.0, "fixed": 50, "moving": 50, "side": "opposite"}
    section = {"speed": 60.0, "friction": {"joints": {lossy: 0.9}}, "forces": [{"on": "rack", "resistance": 350.0}]}
    loads = design({**GIVEN, "racks": racks}, command="loads", loads=section)
    # the racks push with 350 N/0.9 and 350 N against the force of the rod end, over twice its stroke
    wanted = (350.0 / 0.9 + 350.0) * 2.0 * 0.310 / (2.0 * math.pi)
    assert loads.raw("input_torque_mean") == pytest.approx(wanted, rel=1e-9)
    assert loads.power_identity < 1e-9


@pytest.mark.parametrize(
    ("racks", "remedy"),
    [
        ({"fixed": 12, "moving": 30}, {"racks.fixed": 20}),
        ({"fixed": 12, "moving": 12}, {"racks.fixed": 20, "racks.moving": 20}),
        ({"fixed": 14, "moving": 30, "profile_shift": [0.1, 0]}, None),
        ({"fixed": 30, "moving": 30, "clearance": 0.02}, {"racks.clearance": 0.15}),
    ],
)
def test_teeth_that_fail_are_told_a_change_that_passes(racks: dict[str, Any], remedy: dict[str, float] | None) -> None:
    """Their findings stand in the section racks."""
    data = {**GIVEN, "racks": {"module": 4.0, "side": "opposite", **racks}}
    failing = [check for check in design(data).report("analyze").checks if check.status == "fail"]
    assert failing
    for check in failing:
        assert key_of(data, check).startswith("racks")
        assert check.remedy
        if remedy is not None:
            assert dict(check.remedy) == remedy
        keys = {key.replace(".", "__"): value for key, value in check.remedy}
        if not any("[" in key for key in keys):
            (*again,) = design(data, **keys).check(check.name)
            assert all(each.status != "fail" for each in again)


TURNING: dict[str, dict[str, Any]] = {
    "the rack turns about the pinion": {
        "kind": "planar-mechanism",
        "frame": {"A": [0, 0], "D": [160, 20]},
        "links": {"crank": ["A", "B", 40], "rod": {"B": [0, 0]}, "block": {"D": [0, 0]}, "pinion": {"D": [0, 0]}},
        "slides": {"guide": {"link": "block", "on": "rod", "through": [0, 40], "direction": 0}},
        "meshes": {"teeth": {"rack": "rod", "at": "D", "direction": 0}},
        "start": {"crank": 0, "rod": -10, "guide": 120},
    },
    "only a slot guides the pinion": {
        "kind": "planar-mechanism",
        "frame": {"A": [0, 0]},
        "links": {"crank": ["A", "B", 40], "rod": ["B", "F", 140], "pinion": {"F": [0, 0]}},
        "slots": {"slot": {"point": "F", "on": "frame", "through": [0, 0], "direction": 0}},
        "meshes": {"teeth": {"rack": "frame", "at": "F", "direction": 0}},
        "start": {"crank": 0, "rod": 0},
    },
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", TURNING)
@pytest.mark.parametrize("speed", [60.0, -60.0])
def test_a_rack_loses_by_the_rolling_of_its_pinion(name: str, speed: float) -> None:
    """Against 6 N m on the pinion, by the power alone: the loss is that of the rolling against the rack."""
    spec = TURNING[name]
    teeth = {**spec["meshes"]["teeth"], "pinion": "pinion", "side": 1, "teeth": 20, "module": 4.0}
    given = {**spec, "meshes": {"teeth": teeth}, "drive": {"link": "crank"}, "outputs": ["pinion"]}
    section = {"speed": speed, "friction": {"meshes": 0.9}, "forces": [{"on": "pinion", "resistance": 6.0}]}
    loads = design(given, command="loads", loads=section)
    phi = np.linspace(0.05, 6.2, 29)
    reactions = loads.machine.reactions(phi)
    links = loads.machine.at(phi).links
    turned = links["pinion"].turn.first
    rolled = turned - (links["rod"].turn.first if "slots" not in spec else 0.0)
    driven = turned * rolled > 0.0  # where the pinion turns against its torque the other way it drives the rack
    assert name.startswith("only") == driven.all()
    lost = np.abs(rolled) * np.where(driven, 1.0 / 0.9 - 1.0, 1.0 - 0.9)
    assert reactions.torque * np.sign(speed) == pytest.approx(6.0 * (np.abs(turned) + lost), rel=1e-9)


def test_teeth_are_those_of_a_pinion_on_a_very_large_wheel() -> None:
    found = design(GIVEN)
    pair = design(
        {"kind": "gear-pair", "module": 4.0, "teeth": [50, 10_000], "profile_shift": [0.0, 0.0]}, command="gear"
    )
    assert found.raw("fixed_rack.contact_ratio") == pytest.approx(pair.contact_ratio, rel=1e-3)
    rack = design(
        {"kind": "gear-pair", "module": 4.0, "teeth": [50, "rack"], "profile_shift": [0.0, 0.0]}, command="gear"
    )
    for name in ("contact_ratio", "center_distance", "working_pressure_angle"):
        assert found.raw(f"fixed_rack.{name}") == rack.raw(name)
    assert found.raw("fixed_rack_length") > 310.0
    few = design(GIVEN, racks__moving=12).report("analyze")
    undercut = [each.message for each in few.checks if each.name == "undercut" and each.status == "fail"]
    assert ["moving rack" in text for text in undercut] == [True]


def test_refusals_and_what_stays() -> None:
    with pytest.raises(ValueError, match="at rest"):
        design(GIVEN, racks__side="same", racks__moving=50)
    plain = design(GIVEN, racks=None).report("analyze")
    assert not [each.name for each in plain.quantities if "rack" in each.name]
    assert {each.name for each in plain.checks} == {"transmission-angle"}
