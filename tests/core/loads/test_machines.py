"""Loads of the larger machines: the press against its reference, the mutilated gear and the gear pair by hand."""

from __future__ import annotations

import gc
import json
import math
import weakref
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.machines.flatbed_press.chains import Travel
from gearlink.core.machines.flatbed_press.compensation import Compensation
from gearlink.core.machines.flatbed_press.loads import PressLoads
from gearlink.core.mechanism import friction
from gearlink.core.mechanism.joints import Contact
from gearlink.core.mechanism.links import Link, Mechanism
from gearlink.core.mechanism.motion import Motion
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.loads import machine

PRESS = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())["press"]


@pytest.fixture
def press(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The press with the reference's follower, whose roller stays on the main cam."""
    lift = PRESS["lift"]

    def of_reference(_press: Any, _phi: Any, cam: Travel, _order: int) -> Travel:
        t = cam.value
        return Travel(lift * (1 - np.cos(t)) / 2, lift * np.sin(t) / 2, lift * np.cos(t) / 2)

    monkeypatch.setattr(Compensation, "lift_at", of_reference)
    monkeypatch.setattr(PressLoads, "own_joints", [])
    monkeypatch.setattr(Contact, "sided", lambda self, _: self)
    monkeypatch.setattr(friction, "_exchange", lambda *_: None)
    return factory.design("ty460", command="loads", loads=PRESS["loads"])


def test_press_against_the_reference(press: Any) -> None:
    """36 unknowns; 1e-9 of the largest value of each list."""
    expected, phi = PRESS["expected"], np.radians(np.array(PRESS["at"], dtype=float))
    reduced, found = press.machine.reduced(phi), press.machine.reactions(phi)
    assert found.torque == pytest.approx(expected["input_torque"], rel=1e-9)
    assert reduced.inertia == pytest.approx(expected["reflected_inertia"], rel=1e-9)
    assert reduced.slope == pytest.approx(expected["reflected_inertia_slope"], rel=1e-9)
    seen = 0
    for name, values in expected.items():
        if name in found.unknowns:
            wanted = np.array(values).reshape(len(phi), -1).T
            if name.startswith("guide"):
                wanted = wanted[:2]
            assert found.unknowns[name] == pytest.approx(wanted, abs=1e-9 * np.abs(wanted).max())
            seen += 1
    assert seen == 20
    force, moment = press.shaking(phi)
    assert moment == pytest.approx(expected["shaking_moment"], rel=1e-9)
    assert np.column_stack((force.real, force.imag)) == pytest.approx(np.array(expected["shaking_force"]), abs=1e-6)
    assert press.input_torque_rms == pytest.approx(expected["input_torque_rms"], rel=1e-9)
    assert press.input_torque_max == pytest.approx(expected["input_torque_max"], rel=1e-9)
    assert press.torque_reversals == expected["torque_reversals"]
    assert press.power_identity <= 1e-12


def test_press_without_directions_leaves_out_the_bearings_that_need_them() -> None:
    loads = {key: value for key, value in PRESS["loads"].items() if not key.endswith("direction")}
    design = factory.design("ty460", command="loads", loads=loads)
    assert design.raw("pin_A.peak") is None
    assert "N_x" not in design.table("joints").columns
    given = factory.design("ty460", command="loads", loads=PRESS["loads"])
    assert design.raw("pin_D.peak") == pytest.approx(given.raw("pin_D.peak"), rel=1e-12)


@pytest.mark.slow
def test_the_gear_that_is_driven_changes_the_mesh_not_the_torque() -> None:
    two, one = (factory.design("ty460", command="loads", loads={**PRESS["loads"], "drive_gear": k}) for k in (2, 1))
    assert one.input_torque_rms == pytest.approx(two.input_torque_rms, rel=1e-12)
    assert one.power_identity <= 1e-12
    assert one.raw("mesh_12.tooth_force_max") != pytest.approx(two.raw("mesh_12.tooth_force_max"), rel=1e-2)


def test_return_cam_carries_what_pulls() -> None:
    """The torque does not depend on which roller carries; the guide's couple does."""
    design = factory.design("ty460", command="loads", loads=PRESS["loads"])
    found = design.machine.reactions(np.radians(np.arange(360.0)))
    assert (found.unknowns["cam"][0] < 0.0).any()
    assert (found.unknowns["cam"][0] > 0.0).any()
    assert design.power_identity <= 1e-12


ROLLER = {"width": 40, "inertia": 0.0012, "bearing_moment": 0.15}


@pytest.fixture(scope="module")
def free() -> Any:
    """The worked press, whose follower changes cams."""
    return factory.design("loaded_press", command="loads", loads__roller=ROLLER)


@pytest.fixture(scope="module")
def held() -> Any:
    """The same with a preload that holds both rollers."""
    return factory.design("loaded_press", command="loads", loads__roller=ROLLER | {"preload": 5000})


@pytest.mark.slow
def test_a_follower_that_changes_cams_strikes(free: Any) -> None:
    """Each change of sign of the follower's force is one."""
    rows = np.linspace(0.0, 2.0 * math.pi, 2001)
    changes = np.count_nonzero(np.diff(np.sign(free.side_force(rows))))
    *_, found = free.check("load-reversal")
    assert (found.status, found.value) == ("warn", changes)


@pytest.mark.slow
def test_a_preload_that_holds_both_rollers_leaves_no_strike(held: Any) -> None:
    assert len(list(held.check("load-reversal"))) == len(held.meshes_found)


@pytest.mark.slow
def test_a_roller_is_driven_round_where_it_is_pressed(free: Any, held: Any) -> None:
    """Without a preload each roller leaves its cam; with one the maximum share is that of a fine grid."""
    assert free.traction_needed == [None, None]
    rows = np.linspace(0.0, 2.0 * math.pi, 5_001)
    for name, found in zip(held.own_rollers, held.traction_needed, strict=True):
        moment = 0.0012 * np.abs(held.roller_acceleration(name, rows)) + 0.15
        need = moment / 0.025 / held.contact_force(name, rows)
        assert found == pytest.approx(float(need.max()), rel=1e-4)
        assert found >= float(need.max())


MUTILATED = {
    "speed": 60,
    "links": {"wheel": {"inertia": 0.2}, "crank": {"inertia": 0.01}},
    "forces": [{"on": "crank", "torque": -12}],
    "wheel_direction": 90,
}


def test_mutilated_gear_carries_the_load_only_while_it_moves() -> None:
    """Ratio 2/3 in 1.5 revolutions of 6: tooth force 12 N m/30 mm, input torque 12 * 2/3, else nothing."""
    design = factory.design("mutilated_gear_press", command="loads", loads=MUTILATED)
    torque, teeth = design.table("torque"), design.table("teeth")
    moving = torque["input_angle"] < 540.0
    assert torque["input_torque"][moving] == pytest.approx(8.0, rel=1e-12)
    assert torque["input_torque"][~moving] == pytest.approx(0.0, abs=1e-12)
    assert teeth["mesh_wheel"][moving] == pytest.approx(400.0, rel=1e-12)
    assert teeth["mesh_wheel"][~moving] == pytest.approx(0.0, abs=1e-9)
    assert design.input_torque_mean == pytest.approx(2.0, rel=1e-12)
    assert torque["reflected_inertia"][0] == pytest.approx(0.2 / 36.0 + 0.01 * 4.0 / 9.0, rel=1e-12)
    assert design.engagement_energy == pytest.approx(0.005 * (2.0 * math.pi * 2.0 / 3.0) ** 2, rel=1e-12)
    joints = design.table("joints")
    assert joints["A_x"][moving] == pytest.approx(400.0, rel=1e-9)
    assert joints["A_y"][moving] == pytest.approx(400.0 * math.tan(math.radians(20.0)), rel=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("teeth", "sign"), [([21, 67], -1.0), ([21, -67], 1.0)])
def test_gear_pair_carries_torque_over_radius(teeth: list[int], sign: float) -> None:
    data = {
        "kind": "gear-pair",
        "module": 2,
        "teeth": teeth,
        "profile_shift": [0.0, 0.0],
        "loads": {"speed": 100, "forces": [{"on": "gear2", "torque": -40}]},
    }
    design = factory.design(data, command="loads")
    assert design.input_torque_mean == pytest.approx(sign * 40.0 * 21 / 67, rel=1e-12)
    assert design.raw("mesh_12.tooth_force_max") == pytest.approx(40.0 / 0.067, rel=1e-12)
    assert design.raw("pin_gear1.peak") == pytest.approx(40.0 / 0.067 / math.cos(math.radians(20.0)), rel=1e-12)


def test_helical_teeth_push_along_the_axis() -> None:
    """The tooth's normal lies in the plane of action, inclined by the base helix angle."""
    design = factory.design(
        "gear_pair", command="loads", loads={"speed": 600, "forces": [{"on": "gear2", "torque": -40}]}
    )
    pair, teeth = design.pair, design.table("teeth", samples=4)
    base = math.atan(math.tan(pair.helix_angle) * math.cos(pair.transverse_pressure_angle))
    normal = np.sqrt(teeth["mesh_12"] ** 2 + teeth["mesh_12_radial"] ** 2 + teeth["mesh_12_axial"] ** 2)
    assert normal * math.cos(base) * math.cos(pair.working_pressure_angle) == pytest.approx(
        np.abs(teeth["mesh_12"]), rel=1e-12
    )
    force = design.raw("axial_force_max")
    assert force == pytest.approx(teeth["mesh_12_axial"][0], rel=1e-12)
    assert design.raw("tilting_moment_max") == pytest.approx([1e-3 * force * r for r in pair.working_radius], rel=1e-12)


@pytest.mark.slow
def test_spur_gears_have_no_axial_force() -> None:
    design = factory.design(
        "ring_pair", command="loads", loads={"speed": 600, "forces": [{"on": "gear2", "torque": -40}]}
    )
    assert design.raw("axial_force_max") is None
    assert "mesh_12_axial" not in design.table("teeth", samples=2).columns


@pytest.mark.slow
def test_of_many_rows_the_links_are_held_once_and_once_more_for_the_block_in_hand() -> None:
    """The forces are those of each block alone, to the last bit."""
    machine = factory.design("loaded_six_bar", command="loads").machine
    made: list[weakref.ref[Link]] = []
    most = 0

    def counted(phi: Reals, order: int, _side: int) -> Mechanism:
        nonlocal most
        most = max(most, 1 + sum(each() is not None for each in made))
        found = machine.motion.make(phi, order, 1)
        made.append(weakref.ref(found.links["output"]))
        return found

    phi = np.linspace(0.0, 6.0, 4 * 4096 + 5)
    assert machine.locking[0] < 1.0
    held = replace(machine, motion=Motion(counted))
    vars(held)["locking"] = machine.locking
    found = held.reactions(phi)
    assert (len(made), most) == (6, 2)
    for rows in (slice(0, 4096), slice(4 * 4096, None)):
        alone = machine.reactions(phi[rows])
        assert np.array_equal(found.torque[rows], alone.torque)
        for name, values in alone.unknowns.items():
            assert np.array_equal(found.unknowns[name][:, rows], values), name


def test_links_without_mass_and_inertia_are_named() -> None:
    keys = {"loads__links__idler": None, "loads__links__rocker": {"mass": 0.0}}
    assert factory.design("loaded_feed", command="loads", **keys).raw("massless") == ["rocker", "idler"]
    assert factory.design("loaded_feed", command="loads").raw("massless") is None


@pytest.fixture
def uncollected() -> Iterator[None]:
    """No collection but those that are asked for."""
    gc.collect()
    gc.disable()
    yield
    gc.enable()


@pytest.mark.slow
@pytest.mark.usefixtures("uncollected")
def test_what_earlier_machines_kept_is_freed(monkeypatch: pytest.MonkeyPatch) -> None:
    """A hundred designs of 65 MB each took 6.6 GB: to the collector they were few objects."""
    monkeypatch.setattr(machine, "_ROWS_KEPT", 10_000)
    left: list[weakref.ref[Any]] = []
    for _ in range(4):
        design = factory.design("loaded_feed", command="loads")  # 17,500 rows each
        design.report("loads")
        left.append(weakref.ref(design.machine))
    assert [made() is None for made in left[:2]] == [True, True]
