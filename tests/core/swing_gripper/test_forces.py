"""Force closure of the swing gripper: inertia torque, contact torques, lift-off, the spring on its levers.

Tolerances, EPS = 2^-52:
* reference torques (25 digits): 32 EPS of the largest torque or force of the turn - four products of sums;
* energy: the work of the inertia torque over a stretch is the gain of kinetic energy, both summed by Gauss's rule
  between the joints of the laws' zones: 1e-12 of the largest energy, ten times the rounding of the sum;
* the spring's torque against mpmath's derivative of its energy: 32 EPS.
"""

from __future__ import annotations

import math
import re

import factory
import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.gripper import CASES, REFERENCE, kinetic_energy, machine
from sweeps import examples, mostly_slow

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.remedies.trials import Bench
from gearlink.core.machines.swing_gripper.forces import (
    LeverSpring,
    Masses,
    contact_torques,
    inertia_torque,
    lift_off_speed,
)

EPS = 2.0**-52
EXAMPLE = machine()
LARGEST = 293.07
MASSES = Masses(0.11, 0.42, 0.018, 3.2, 0.05)


def test_torques_and_forces_of_the_reference() -> None:
    case = CASES["DYN-01"]["expected"]
    degrees = np.array([71.5])
    main, back = EXAMPLE.closure.inertia.torques(degrees)
    assert EXAMPLE.closure.lift_sense == -1
    one, two = contact_torques(400.0, main, back, -1)
    force = 1.0 / 0.16
    pressure = [cam.pressure_angle(np.radians(degrees)) for cam in EXAMPLE.cams.discs]
    for key, value, scale in (
        ("T_inertia", main[0], LARGEST),
        ("T_contact1", one[0], 700.0),
        ("T_contact2", two[0], 700.0),
        ("N1", one[0] * force / math.cos(pressure[0][0]), 5000.0),
        ("N2", two[0] * force / math.cos(pressure[1][0]), 5000.0),
    ):
        assert value == pytest.approx(float(case[key]), rel=0.0, abs=32 * EPS * scale), key


def test_worst_torque_of_the_turn() -> None:
    expected = CASES["EXT-01"]["expected"]
    worst = EXAMPLE.closure.worst_unloading[0]
    assert worst.value == pytest.approx(float(expected["T_inertia_max"]), rel=0.0, abs=32 * EPS * LARGEST)
    # The place of a maximum is known to the root of its value's rounding.
    assert worst.place == pytest.approx(float(expected["at_T_inertia_max_deg"]), rel=0.0, abs=1e-5)
    speed = 12000.0 * math.sqrt(400.0 / float(expected["T_inertia_max"]))
    assert EXAMPLE.lift_off_speed == pytest.approx(speed, rel=64 * EPS, abs=0.0)
    least = float(REFERENCE["example_extremes_1deg_scan"]["T_inertia"]["min"])
    assert EXAMPLE.closure.inertia.torques(np.array([275.0]))[0][0] == pytest.approx(least, rel=1e-11, abs=0.0)


@pytest.mark.quick(3)
@pytest.mark.parametrize(("start", "end"), [(0.0, 100.0), (112.0, 162.0), (170.0, 290.0)])
@pytest.mark.parametrize(
    "masses",
    [MASSES, Masses(1.0, 0.0, 0.0, 0.0, 0.0), Masses(0.0, 0.0, 0.0, 1.0, 0.0), Masses(0.0, 0.0, 1.0, 0.0, 0.0)],
    ids=["all", "rocker", "coupler-mass", "coupler-inertia"],
)
def test_work_of_the_inertia_torque_is_gain_of_energy(start: float, end: float, masses: Masses) -> None:
    linkage, speed = EXAMPLE.linkage, EXAMPLE.shaft_speed
    nodes, weights = np.polynomial.legendre.leggauss(24)
    edges = np.linspace(start, end, 49)
    half = 0.5 * np.diff(edges)
    places = (0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * nodes).ravel()
    motion = linkage.motion(places, 2)
    power = inertia_torque(linkage, motion, masses, speed) * motion.input.first
    work = np.cumsum(np.radians(half) * (power.reshape(48, 24) @ weights))
    energy = kinetic_energy(linkage, masses, speed, edges)
    gain = energy[1:] - energy[0]
    assert np.abs(work - gain)[:-1].max() <= 1e-12 * energy.max()


def test_a_dwell_needs_no_torque() -> None:
    main, back = EXAMPLE.closure.inertia.torques(np.array([165.0, 300.0, 345.0]))
    assert (main == 0.0).all()
    assert (back == 0.0).all()


def test_torque_grows_with_the_square_of_the_speed() -> None:
    fast = machine(speed=24000.0)
    degrees = np.arange(0.0, 360.0, 5.0)
    one, other = EXAMPLE.closure.inertia.torques(degrees)[0], fast.closure.inertia.torques(degrees)[0]
    assert np.abs(other - 4.0 * one).max() <= 16 * EPS * 4.0 * LARGEST
    assert fast.lift_off_speed == pytest.approx(EXAMPLE.lift_off_speed, rel=16 * EPS, abs=0.0)


def test_the_least_spring_torque_lifts_off_at_the_design_speed() -> None:
    edge = machine(spring={"torque": EXAMPLE.spring_torque})
    assert edge.lift_off_speed == pytest.approx(12000.0, rel=8 * EPS, abs=0.0)
    assert machine(spring={"torque": 400.0, "reserve": 12.5}).spring_torque == EXAMPLE.spring_torque + 12.5


def test_nothing_lifts_off_without_inertia() -> None:
    free = machine(inertia={"input": 0.0})
    assert free.lift_off_speed is None
    assert free.check_lift_off().status == "pass"
    assert lift_off_speed(12000.0, 400.0, 0.0) == math.inf


def test_forces_table_closes_the_balance() -> None:
    table = EXAMPLE.table("forces")
    columns = dict(zip(table.columns, table.data, strict=True))
    assert np.abs(columns["contact_torque_main"] - (400.0 - columns["inertia_torque"])).max() <= 4 * EPS * 700.0
    assert columns["contact_torque_main"].min() == pytest.approx(112.37, rel=0.0, abs=0.005)
    assert (columns["normal_force_return"] > 0.0).all()
    one_roller = machine(cam__return_roller=None)
    assert "contact_torque_return" not in one_roller.table("forces").columns


def test_spring_torque_of_the_reference() -> None:
    case = CASES["SPR-01"]
    given_ = case["inputs"]
    for degrees in given_["delta_deg"]:
        spring = LeverSpring(
            given_["p"], given_["q"], math.radians(degrees), given_["F_ref"], given_["k_N_per_mm"], given_["L_ref"]
        )
        expected = float(case["expected"][f"T({degrees})"])
        assert spring.torque == pytest.approx(expected, rel=32 * EPS, abs=0.0)


@given(
    arms=st.tuples(st.floats(10.0, 300.0), st.floats(10.0, 300.0)),
    angle=st.floats(0.1, 3.0),
    preload=st.floats(1.0, 5000.0),
    rate=st.floats(0.0, 50.0),
)
@examples(60)
def test_spring_torque_is_the_slope_of_its_energy(arms: tuple, angle: float, preload: float, rate: float) -> None:
    p, q = arms
    spring = LeverSpring(p, q, angle, preload, rate, 0.25)
    if spring.rate == 0.0:
        assert spring.pull == preload

    def energy(delta: mp.mpf) -> mp.mpf:
        length = mp.sqrt(mp.mpf(p) ** 2 + mp.mpf(q) ** 2 - 2 * mp.mpf(p) * q * mp.cos(delta))
        return preload * length + mp.mpf(rate) / 2 * (length - mp.mpf(0.25)) ** 2

    with mp.workdps(30):
        slope = mp.diff(energy, mp.mpf(angle)) / 1000
        assert abs(spring.torque / slope - 1) <= 64 * EPS


def test_levers_serve_in_place_of_the_torque() -> None:
    levers = {"arms": [120.0, 110.0], "angle": 88.0, "preload": 300.0, "rate": 25.0, "length": 90.0}
    design = machine(spring=levers)
    assert design.closing_torque == pytest.approx(168.9548992381990524, rel=32 * EPS, abs=0.0)
    assert "closing_torque" in design.outline("gripper").quantities
    (check,) = design.findings("gripper", "lift-off")
    assert check.status == "fail"
    ((key, preload),) = check.remedy
    assert key == "spring.preload"
    repaired = machine(spring={**levers, "preload": preload})
    assert repaired.check_lift_off().status == "pass"


@pytest.mark.quick(1)
@pytest.mark.parametrize("torque", [250.0, 300.0])
def test_the_spring_that_is_recommended_holds(torque: float) -> None:
    (check,) = machine(spring={"torque": torque}).findings("gripper", "lift-off")
    assert check.status == ("fail" if torque < 287.0 else "warn")
    words = "set spring.torque to " if check.status == "fail" else "increase spring.torque to "
    raised = float(check.fix.split(words)[1].split()[0])
    assert machine(spring={"torque": raised}).check_lift_off().status == "pass"


def test_a_spring_that_pushes_is_refused() -> None:
    levers = {"arms": [120.0, 110.0], "angle": 88.0, "preload": 300.0, "rate": 25.0, "length": 290.0}
    with pytest.raises(NoSolution, match=r"the spring, 159\.9 mm long, is slack: no force closes the cam") as refused:
        _ = machine(spring=levers).closing_torque
    assert refused.value.key == "spring.length"


def test_rollers_on_one_side_are_refused() -> None:
    with pytest.raises(
        NoSolution, match="both rollers lie on the same side of the cam: a spring that presses one lifts the"
    ) as refused:
        _ = machine(cam__return_roller__angle=20.0).closure.lift_sense
    assert refused.value.key == "cam.return_roller.angle"
    (bound,) = re.findall(r"angle above (\S+) deg", refused.value.fix)  # as it is printed: 30.94 lay below the bound
    assert machine(cam__return_roller__angle=float(bound)).closure.lift_sense in (-1, 1)


@pytest.mark.slow
@pytest.mark.parametrize("command", mostly_slow(["gripper", "analyze", "cam"], 1))
def test_rollers_on_one_side_leave_the_kinematics(command: str) -> None:
    """A failed check beside what stands: law, linkage and cams, with an angle of the roller that closes both."""
    made = machine(cam__return_roller__angle=20.0)
    report = made.report(command)
    (found,) = [check for check in report.checks if check.name == "lift-off"]
    assert (found.code, found.status, found.value) == ("GL406", "fail", None)
    assert "same side of the cam" in found.message
    names = [quantity.name for quantity in report.quantities]
    assert ("total_swing" in names) == (command != "cam")
    assert "max_pressure_angle" in names
    assert "lift_off_speed" not in names
    ((key, angle),) = found.remedy
    assert key == "cam.return_roller.angle"
    assert machine(cam__return_roller__angle=angle).check("lift-off")[0].status != "fail"


def test_a_spring_that_pushes_leaves_the_kinematics(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Bench, "remedy", lambda *_: ())  # the finding is asked for, not what would repair it
    levers = {"arms": [120.0, 110.0], "angle": 88.0, "preload": 300.0, "rate": 25.0, "length": 290.0}
    report = machine(spring=levers).report("gripper")
    (found,) = [check for check in report.checks if check.name == "lift-off"]
    assert (found.status, "is slack: no force closes the cam pair" in found.message) == ("fail", True)


def test_missing_sections_are_named() -> None:
    bare = machine(inertia=None, spring=None)
    for name, key in (("closing_torque", "spring"), ("spring_torque", "inertia")):
        with pytest.raises(MissingSection) as missing:
            getattr(bare, name)
        assert missing.value.key == key


@pytest.mark.quick(2)
@pytest.mark.parametrize("command", ["gripper", "cam", "analyze"])
@pytest.mark.parametrize(("back", "words"), [({}, "either roller"), ({"cam__return_roller": None}, "the roller")])
def test_rollers_that_no_spring_presses_on_their_cams_are_warned_of(command: str, back: dict, words: str) -> None:
    """Without the section nothing was said, though each roller has a rocker of its own."""
    checks = machine(spring=None, **back).report(command).checks
    (found,) = [check for check in checks if check.name == "lift-off"]
    assert (found.code, found.status, found.value) == ("GL406", "warn", None)
    assert found.message.startswith(f"nothing presses {words} on its cam")


def test_a_spring_without_masses_is_not_judged() -> None:
    assert not [check for check in machine(inertia=None).report("gripper").checks if check.name == "lift-off"]


@pytest.mark.slow
def test_rollers_without_a_spring_are_told_a_torque_that_presses_them() -> None:
    bare = factory.design("loaded_gripper", command="loads", spring=None)
    assert "fail" in {check.status for check in bare.check("contact-loss")}
    ((key, torque),) = next(iter(bare.candidates("contact-loss")))
    assert key == "spring.torque"
    held = factory.design("loaded_gripper", command="loads", spring={"torque": torque})
    assert all(check.value > 0.0 for check in held.check("contact-loss"))
    (found,) = factory.design("loaded_gripper", command="gripper", spring=None).check("lift-off")
    least = float(found.fix.partition("of at least ")[2].partition(" ")[0])
    assert 1.0 < least / torque < 1.2  # a tenth of speed in reserve
