"""Torque and forces: reference cases, and second ways that share no formula with the program.

Tolerances: 1e-9 of the largest value of a list where the reference was printed so; 1e-11 where both ways are ours
(transmission angles above 20 deg, condition of the system below 1e3).
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.mechanism.dynamics import Force, Mass, Torque, power_parts, reduced, shaking
from gearlink.core.mechanism.joints import NEWTON_METER, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.mechanism.rates import cross

CASES = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())["cases"]
COLUMNS = ("input_torque", "reflected_inertia", "reflected_inertia_slope")
SIZES = ("input_torque_max", "input_torque_min", "input_torque_rms", "torque_reversals")


def loads_of(case: dict[str, Any], **keys: Any) -> Any:
    spec = {key: value for key, value in case["spec"].items() if key != "at"}
    if spec["kind"] == "geared-five-bar":
        spec["coupler_point"] = {"along": 60.0}
    return factory.design(spec, command="loads", **keys)


def named(case: dict[str, Any]) -> str:
    return str(case["name"])


@pytest.fixture(params=CASES, ids=named)
def case(request: pytest.FixtureRequest) -> Any:
    return request.param


@pytest.mark.quick(2)
def test_torque_of_the_reference(case: dict[str, Any]) -> None:
    design, expected = loads_of(case), case["expected"]
    table = design.table("torque")
    for column in COLUMNS:
        scale = max(map(abs, expected[column])) or 1.0
        assert table[column][expected["at"]] == pytest.approx(expected[column], abs=1e-9 * scale)
    for name in SIZES:
        assert design.quantity(name).value == pytest.approx(expected[name], rel=1e-9)


def test_joint_and_tooth_forces_of_the_reference(case: dict[str, Any]) -> None:
    design, expected = loads_of(case), case["expected"]
    tables = {name: design.table(name) for name in ("joints", "teeth", "frame")}
    for name, values in expected.items():
        if isinstance(values, list) and f"{name}_x" in tables["joints"].columns:
            scale, at = np.abs(values).max(), expected["at"]
            if name == "guide":  # the reference gives its force along i u and its couple
                push = design.machine.reactions(np.radians(at)).unknowns[name]
                assert push.T.tolist() == [pytest.approx(row, abs=1e-9 * scale) for row in values]
                continue
            assert tables["joints"][f"{name}_x"][at] == pytest.approx([v[0] for v in values], abs=1e-9 * scale)
            assert tables["joints"][f"{name}_y"][at] == pytest.approx([v[1] for v in values], abs=1e-9 * scale)
        elif isinstance(values, list) and name in tables["teeth"].columns:
            assert tables["teeth"][name][expected["at"]] == pytest.approx(values, abs=1e-9 * np.abs(values).max())
    force, scale = expected["shaking_force"], np.abs(expected["shaking_force"]).max()
    assert tables["frame"]["force_x"][expected["at"]] == pytest.approx([v[0] for v in force], abs=1e-9 * scale)
    assert tables["frame"]["moment"][expected["at"]] == pytest.approx(expected["shaking_moment"], abs=1e-9 * scale)


# Second ways


def _spectral(values: Any) -> Any:
    """Derivative of a periodic function by its Fourier series; geometric convergence for these linkages."""
    n = len(values)
    return np.fft.ifft(1j * np.fft.fftfreq(n, 1.0 / n) * np.fft.fft(values))


def test_derivatives_of_every_point_against_its_fourier_series(case: dict[str, Any]) -> None:
    design = loads_of(case)
    phi = np.arange(1024) * (2.0 * math.pi / 1024)
    for link in design.moving.at(phi).links.values():
        point = link.at(31.0 - 20.0j)
        for place, rate in ((point.value, point.first), (point.first, point.second)):
            if abs(place[0] - place[-1]) < 0.1 * np.abs(place).max():  # a free gear need not come home after a turn
                assert np.abs(_spectral(place) - rate).max() <= 1e-10 * np.abs(rate).max() + 1e-10


def test_slope_of_the_inertia_against_its_fourier_series(case: dict[str, Any]) -> None:
    phi = np.arange(1024) * (2.0 * math.pi / 1024)
    found = loads_of(case).machine.reduced(phi)
    assert np.abs(_spectral(found.inertia).real - found.slope).max() <= 1e-10 * np.abs(found.slope).max()


def test_virtual_power_and_newton_euler_agree(case: dict[str, Any]) -> None:
    assert loads_of(case).power_identity <= 1e-12


def test_joint_forces_hold_the_machine_on_its_frame(case: dict[str, Any]) -> None:
    """Reactions of the frame, shaking force, weight and applied forces balance, and so do their moments."""
    design = loads_of(case)
    phi = np.linspace(0.0, 6.0, 50)
    machine = design.machine
    found, applied = machine.reactions(phi), machine.applied(phi)
    mechanism: Mechanism = found.mechanism
    force, moment = shaking(mechanism, machine.masses, machine.speed)
    total, turning = force.copy(), moment + found.torque
    size = np.abs(force).max()
    for name, mass in machine.masses.items():
        center = mechanism.links[name].at(mass.center).value
        weight = mass.tonnes * machine.gravity
        total += weight
        turning += cross(center - mechanism.pivot, weight) / NEWTON_METER
    for each in applied:
        if isinstance(each, Force):
            total += each.force
            turning += cross(each.at.value - mechanism.pivot, each.force) / NEWTON_METER
        else:
            turning += each.torque / NEWTON_METER
    for joint in mechanism.connections:
        if joint.first != FRAME:
            continue
        push, radial = found.force(joint.name), 0.0
        place = joint.at if isinstance(joint, (Pin, Guide)) else joint.pitch_point  # type: ignore[union-attr]
        if not isinstance(joint, (Pin, Guide)):
            radial = found.radial(joint.name)
        total += push + radial
        turning += cross(place - mechanism.pivot, push + radial) / NEWTON_METER
        if isinstance(joint, Guide):
            turning += found.unknowns[joint.name][1]
        size = max(size, np.abs(push).max())
    assert np.abs(total).max() <= 1e-12 * size
    assert np.abs(turning).max() <= 1e-12 * size


def test_tooth_force_of_a_free_gear_is_its_own_moment_equation() -> None:
    """F_t r = J t'' w^2 - T: no system is needed for the output gear of a single mesh."""
    design = loads_of(next(case for case in CASES if case["spec"]["kind"] == "two-gear-four-bar"))
    phi = np.linspace(0.0, 6.0, 40)
    output = design.machine.at(phi).links["output"]
    mass = design.machine.masses["output"]
    torque = mass.inertia * output.turn.second * design.speed**2 + 6.0
    # The force on the output is the opposite of that on the coupler, at its pitch radius of 18 mm.
    found = -design.machine.reactions(phi).unknowns["mesh_25"][0] * 0.018
    assert found == pytest.approx(torque, abs=1e-12 * np.abs(torque).max())


def test_torque_scales_with_the_square_of_the_speed_where_nothing_else_acts() -> None:
    case = CASES[1]
    one, two = (loads_of(case, loads__speed=speed).input_torque_max for speed in (200.0, -400.0))
    assert two == pytest.approx(4.0 * one, rel=1e-12)


# Friction and springs


def test_friction_takes_the_power_that_turns_into_heat() -> None:
    friction = {"pins": 0.08, "pin_radius": 6.0, "meshes": 0.97}
    free, rubbing = loads_of(CASES[0]), loads_of(CASES[0], loads__friction=friction)
    assert rubbing.power_identity <= 1e-12
    assert rubbing.input_torque_mean > free.input_torque_mean


def test_spring_does_no_net_work() -> None:
    spring = {"between": ["rocker", "frame"], "points": [[40, 5], [300, 60]], "rate": 4, "free_length": 80}
    free, sprung = loads_of(CASES[0]), loads_of(CASES[0], loads__springs=[spring])
    assert sprung.power_identity <= 1e-12
    assert sprung.input_torque_mean == pytest.approx(free.input_torque_mean, rel=1e-12)
    assert sprung.input_torque_max != pytest.approx(free.input_torque_max, rel=1e-3)


def test_resistance_is_always_against_the_motion() -> None:
    case = next(case for case in CASES if case["spec"]["kind"] == "slider-crank")
    design = loads_of(case, loads__forces=[{"on": "slider", "resistance": 350.0}], loads__links=None)
    assert design.input_torque_mean == pytest.approx(350.0 * 2.0 * 0.310 / (2.0 * math.pi), rel=1e-11)
    assert design.input_torque_min == pytest.approx(0.0, abs=1e-9)


def test_zone_and_step_table_say_the_same() -> None:
    zone = {"zones": [{"from": 34, "to": 154, "value": -120}]}
    table = {"table": [[34, -120], [154, 0]], "interpolation": "step"}
    one, two = (loads_of(CASES[0], loads__forces=[{"on": "output", "torque": torque}]) for torque in (zone, table))
    assert one.input_torque_rms == pytest.approx(two.input_torque_rms, rel=1e-13)
    turn = one.machine.at(np.radians([34.0, 154.0])).links["output"].turn.value
    assert one.input_torque_mean == pytest.approx(120.0 * (turn[1] - turn[0]) / (2.0 * math.pi), rel=1e-12)


def test_least_transmission_angle_of_a_slider_crank_is_that_of_its_rod() -> None:
    """GL612: the rod's own direction over a fine grid, flat at its minimum to 1e-9."""
    design = loads_of(next(case for case in CASES if case["spec"]["kind"] == "slider-crank"))
    rod = design.machine.at(np.linspace(0.0, 2.0 * math.pi, 20_001)).links["rod"].turn.value
    assert math.sin(design.transmission_angle) == pytest.approx(np.abs(np.sin(rod)).min(), rel=1e-8)
    (check,) = design.check("force-amplification")
    assert check.value == pytest.approx(1.0 / np.abs(np.sin(rod)).min(), rel=1e-8)


@pytest.mark.parametrize(
    ("base", "axis", "other"), [("loaded_feed", "D", "D_output"), ("loaded_gripper", "A", "A_return")]
)
def test_shafts_in_each_other_load_the_frame_together(base: str, axis: str, other: str) -> None:
    joints = factory.design(base, command="loads").table("joints", samples=90)
    for part in ("_x", "_y"):
        assert joints[f"{axis}_sum{part}"] == pytest.approx(
            joints[f"{axis}{part}"] + joints[f"{other}{part}"], rel=1e-12
        )
    assert joints[f"{axis}_sum"] == pytest.approx(np.hypot(joints[f"{axis}_sum_x"], joints[f"{axis}_sum_y"]), rel=1e-12)


def test_parts_of_the_torque_are_counted_by_their_sizes() -> None:
    """Of one inertia, one force or one torque alone nothing cancels: the size of what it takes."""
    machine = factory.design("loaded_feed", command="loads").machine
    phi = np.radians(np.arange(5.0, 360.0, 25.0))
    at, speed = machine.at(phi), 12.0
    turn = at.links["rocker"].turn
    wheel = {"rocker": Mass(inertia=0.3)}
    found = power_parts(at, wheel, (), -9810j, speed)
    assert found == pytest.approx(np.abs(0.5 * reduced(at, wheel, (), 0j).slope) * speed**2, rel=1e-13)
    assert found == pytest.approx(0.3 * np.abs(turn.first * turn.second) * 144.0, rel=1e-13)
    body = {"coupler": Mass(2.0, 0.0, 50.0 + 10.0j)}
    center = at.links["coupler"].at(50.0 + 10.0j)
    sizes = 2.0 * 1e-3 * np.abs(center.first) * (1e-3 * np.abs(center.second) * 144.0 + 9.81)
    assert power_parts(at, body, (), -9810j, speed) == pytest.approx(sizes, rel=1e-13)
    torque = (Torque("output", np.full(phi.size, -5000.0)),)
    turned = at.links["output"].turn.first
    assert power_parts(at, {}, torque, 0j, speed) == pytest.approx(5.0 * np.abs(turned), rel=1e-13)
