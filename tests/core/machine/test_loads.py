"""Loads of a machine: members' torques against their own files, energy, and forces written down by hand."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from machines import FEED, GRIPPER, ROCKER, cam, machine, of

from gearlink.cli.opening import design
from gearlink.cli.texts.codes import key_of
from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.machines.machine.loads import MachineLoads

SPRUNG = {"spring": {"preload": 300, "rate": 4}, "follower": {"mass": 1.6}, "loads": {"roller": {"width": 16}}}
HEAVY = {
    "crank": {"mass": 1.2, "inertia": 0.001},
    "coupler": {"mass": 0.8, "center": [55, 0], "inertia": 0.001},
    "rocker": {"mass": 1.5, "center": [40, 0], "inertia": 0.012},
}
BAR: dict[str, Any] = ROCKER | {"loads": {"links": HEAVY}}
SLIDER: dict[str, Any] = {"kind": "slider-crank", "stroke": 60, "rod": 120, "loads": {"links": {"slider": {"mass": 4}}}}
SPEED = 180.0


def loads(members: dict[str, Any], **more: Any) -> MachineLoads:
    found = MachineLoads(machine(members, speed=SPEED, **more).spec)
    assert found.kind == "machine"
    return found


def alone(data: dict[str, Any], speed: float, **more: Any) -> Any:
    keys = {"speed": speed} if data["kind"] == "disc-cam" else {}
    section = data["loads"] | ({} if keys else {"speed": speed}) | more
    return design("loads", **{**data, **keys, "loads": section})


@pytest.mark.quick(4)
@pytest.mark.parametrize("ratio", [1.0, 2.0, -1.0])
@pytest.mark.parametrize("data", [cam(FEED, **SPRUNG), BAR, SLIDER], ids=lambda data: str(data["kind"]))
def test_a_member_is_felt_as_in_its_own_file_times_its_ratio(data: dict[str, Any], ratio: float) -> None:
    found = loads({"m": of(data, phase=25, ratio=ratio)}).table("torque", samples=720)
    own = alone(data, SPEED * abs(ratio))
    angle = np.radians(ratio * (found["input_angle"] - 25.0)) % (2.0 * math.pi)
    want = ratio * own.machine.torque(angle)
    # rounding of the phase moves the angle by 1e-15, a torque by its slope times that
    np.testing.assert_allclose(found["input_torque"], want, rtol=0.0, atol=1e-9 * float(np.abs(want).max()))
    np.testing.assert_allclose(found["m.torque"], found["input_torque"], rtol=0.0, atol=1e-12)


def test_the_sum_is_that_of_the_members_and_its_mean_is_that_of_the_forces() -> None:
    pushed = SLIDER | {"loads": SLIDER["loads"] | {"forces": [{"on": "slider", "resistance": 40}]}}
    found = loads({"a": of(cam(GRIPPER, **SPRUNG), phase=100), "b": of(BAR, phase=40), "c": of(pushed)})
    table = found.table("torque")
    whole = table["a.torque"] + table["b.torque"] + table["c.torque"]
    np.testing.assert_allclose(table["input_torque"], whole, rtol=0.0, atol=1e-10)
    # two strokes of 60 mm against 40 N over a revolution; springs and masses give back what they take
    assert found.input_torque_mean == pytest.approx(2.0 * 0.060 * 40.0 / (2.0 * math.pi), rel=1e-9)


def test_a_mass_behind_another_member_by_its_own_motion() -> None:
    """A crank-rocker swings a lever whose rocker alone has an inertia: M = J y' y'' W^2."""
    swung = ROCKER | {"loads": {"links": {"rocker": {"inertia": 0.3}}}}
    found = loads({"first": of(BAR, phase=30), "arm": of(swung, input="first.output", phase=60)})
    table = found.table("torque", samples=120)
    angle = np.radians(table["input_angle"] - 30.0)
    _, rate, second = found.members["arm"].rates(angle, 2)
    want = 0.3 * rate * second * found.speed**2
    np.testing.assert_allclose(table["arm.torque"], want, rtol=0.0, atol=1e-11 * float(np.abs(want).max()))


def test_inertia_and_its_slope_keep_the_energy() -> None:
    """The integral of the torque over a way is the gain of kinetic energy J(theta) W^2/2, ratio and series together."""
    swung = ROCKER | {"loads": {"links": HEAVY | {"crank": {"mass": 0.5, "center": [10, 5]}}}}
    found = loads({"first": of(BAR, phase=30, ratio=2), "arm": of(swung, input="first.output", phase=60)})
    nodes, weights = np.polynomial.legendre.leggauss(60)
    a, b = 0.3, 1.4
    angle = 0.5 * (a + b) + 0.5 * (b - a) * nodes
    work = 0.5 * (b - a) * float(weights @ found.machine.torque(angle))
    ends = found.machine.reduced(np.array([a, b])).inertia
    assert work == pytest.approx(0.5 * float(ends[1] - ends[0]) * found.speed**2, rel=1e-9)


def test_resistance_behind_a_swinging_driver_acts_against_the_motion() -> None:
    swung = ROCKER | {"loads": {"links": {"rocker": {"inertia": 0.01}}, "forces": [{"on": "rocker", "resistance": 5}]}}
    found = loads({"first": of(BAR), "arm": of(swung, input="first.output", phase=60)})
    way = np.abs(np.diff(found.members["arm"].rates(np.linspace(0.0, 2.0 * math.pi, 7201), 0)[0])).sum()
    # the whole way forth and back times the torque, over a revolution; the rows leave 1e-6 of it
    assert found.input_torque_mean == pytest.approx(way * 5.0 / (2.0 * math.pi), rel=1e-5)


def test_lift_off_by_the_joint_forces_is_that_of_the_cams_own_file() -> None:
    data = cam(FEED, **SPRUNG)
    found = loads({"m": of(data, phase=25)})
    want = design("cam", **data, speed=SPEED).quantity("lift_off_speed").value
    assert found.machine_speed_limit == pytest.approx(want, rel=1e-12)
    assert (found.speed_limit_member, found.speed_limit_check) == ("m", "lift-off")
    # by forces at rows of half a degree, the extreme between them is flat: 1e-5
    assert found.felt["m"].lift_off() * 30.0 / math.pi == pytest.approx(want, rel=1e-5)
    twice = loads({"m": of(data, ratio=2)})
    assert twice.machine_speed_limit == pytest.approx(0.5 * want, rel=1e-12)


def test_lift_off_behind_a_driver_by_hand() -> None:
    """A cam that a rocker swings: contact is lost where F + c y + m W^2 y'' = 0."""
    data = cam(FEED, **SPRUNG)
    found = loads({"first": of(BAR), "cam": of(data, input="first.output", phase=70, ratio=1.2)})
    y, _, second = found.members["cam"].rates(np.linspace(0.0, 2.0 * math.pi, 7200, endpoint=False), 2)
    falling = second < 0.0
    want = np.sqrt(((300.0 + 4.0 * y[falling]) / (1.6e-3 * -second[falling])).min())
    (limit,) = [each for each in found.limits if each.member == "cam"]
    assert limit.speed == pytest.approx(want * 30.0 / math.pi, rel=1e-4)


def test_machine_speed_is_judged_by_the_member_that_bears_least() -> None:
    members = {"a": of(cam(FEED, **SPRUNG)), "b": of(cam(GRIPPER, **SPRUNG), ratio=2)}
    found = loads(members)
    (check,) = [each for each in found.check("machine-speed") if each.code == "GL533"]
    assert check.limit == min(each.speed for each in found.limits)
    assert check.status == ("fail" if check.limit < SPEED else "pass" if 0.9 * check.limit >= SPEED else "warn")


def test_one_flywheel_and_one_motor_are_the_machines() -> None:
    found = loads({"m": of(BAR)}, loads={"flywheel": {"inertia": 0.8, "fluctuation": 0.05}})
    own = alone(BAR, SPEED, flywheel={"inertia": 0.8, "fluctuation": 0.05})
    for name in ("speed_min", "speed_max", "flywheel_inertia", "energy_fluctuation", "reflected_inertia_mean"):
        assert getattr(found, name) == pytest.approx(getattr(own, name), rel=1e-8)
    with pytest.raises(GearlinkError) as wrong:
        loads({"m": of(BAR | {"loads": BAR["loads"] | {"flywheel": {"inertia": 1}}})}).report("loads")
    assert wrong.value.key == "members.m.design.loads.flywheel"  # type: ignore[attr-defined]


def test_members_at_another_speed_are_named_and_the_machines_speed_holds() -> None:
    slow = cam(FEED, **SPRUNG) | {"speed": 90}
    found = loads({"slow": of(slow), "right": of(cam(FEED, **SPRUNG) | {"speed": 360}, ratio=-2)})
    statuses = [each.status for each in found.check("member-speed")]
    assert statuses == ["fail", "pass"]
    want = alone(cam(FEED, **SPRUNG), SPEED).table("torque")["input_torque"]
    np.testing.assert_allclose(found.table("torque")["slow.torque"], want, rtol=0.0, atol=1e-10)
    assert found.quantity("slow.input_torque_max").value == pytest.approx(float(want.max()), rel=1e-4)  # type: ignore[union-attr, arg-type]


@pytest.mark.slow
def test_members_that_add_nothing_are_among_the_first_results() -> None:
    bare = cam(FEED, follower={"mass": None})
    mixed = loads({"m": of(cam(FEED, **SPRUNG)), "light": of(bare), "other": of(bare)})
    first = mixed.report("loads").key[0]
    assert (first.title, first.quantity.value) == ("members without loads", ["light", "other"])
    whole = loads({"m": of(cam(FEED, **SPRUNG))}).report("loads").key
    assert whole[0].quantity.name == "input_torque_max"


def test_findings_of_members_bear_their_names() -> None:
    found = loads({"m": of(cam(FEED, **SPRUNG))})
    checks = found.report("loads").checks
    assert all(each.message.startswith("m: ") for each in checks if each.code.startswith("GL6"))
    assert any(each.code == "GL601" for each in checks)


def test_what_is_wrong_with_a_member_is_told_by_paths_of_the_machines_file() -> None:
    """Its refusal had no key while the loads were summed, and the fix of its finding named the key of another file."""
    key = "members.gripper.design.cam.return_roller.angle"
    spec = factory.changed(factory.worked("sheet_press"), members__gripper__design__cam__return_roller__angle=12)
    made = KINDS["machine"].spec_model().model_validate(spec)
    with pytest.raises(NoSolution) as refusal:
        KINDS["machine"].design("loads", made).report("loads")
    assert refusal.value.key == key
    assert refusal.value.fix.startswith(f"set {key} above ")
    (found,) = [each for each in KINDS["machine"].design("analyze", made).check("lift-off") if each.status == "fail"]
    assert found.fix == refusal.value.fix
    assert key_of(spec, found) == key


def test_a_member_that_fails_has_less_speed_of_the_machine_as_its_fix() -> None:
    """What may repair it was sought in the loads of the machine, which have no vibration and no forces."""
    vibration = {"frequency": 60, "damping": 0.03, "allowed_residual": 0.05}
    keys = SPRUNG | {"loads": SPRUNG["loads"] | {"vibration": vibration}}
    found = loads({"m": of(cam(FEED, **keys))})
    (failing,) = [each for each in found.report("loads").checks if each.name == "residual-vibration"]
    assert failing.status == "fail"
    ((key, value),) = failing.remedy
    assert key == "speed"
    again = MachineLoads(machine({"m": of(cam(FEED, **keys))}, speed=value).spec)
    assert {each.status for each in again.check("residual-vibration")} <= {"pass", "warn"}


@pytest.mark.parametrize(
    ("members", "more", "key"),
    [
        ({"m": of(cam(FEED))}, {}, "members"),
        ({"m": of(BAR)}, {"speed": None}, "speed"),
    ],
)
def test_what_loads_lack(members: dict[str, Any], more: dict[str, Any], key: str) -> None:
    data = {"members": members, "speed": SPEED} | more
    with pytest.raises(GearlinkError) as wrong:
        MachineLoads(machine(**{k: v for k, v in data.items() if v is not None}).spec).report("loads")
    assert wrong.value.key == key  # type: ignore[attr-defined]
