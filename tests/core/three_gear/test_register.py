"""Register of the three-gear drive: by duality against gains derived by hand, those against Richardson differences made
elsewhere and against an exact chain of their own.

Tolerances: the reference differences carry 2e-8 of their own; the exact chain over +-h differs by h^2 and eps/h.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design
from oracles.three_gear_chain import Errors, output_error
from oracles.three_gear_gains import Drive, register_gains

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar

CASES = json.loads((Path(__file__).parents[2] / "reference/tolerance.json").read_text(encoding="utf-8"))
GAINS = [case for case in CASES if case["input"]["what"] == "drive-gains"]
NAMES = {
    "a": "crank",
    "b": "crank_idler",
    "c": "idler_output",
    "d": "frame",
    "gA": "pin_a",
    "gD": "pin_d",
    "phi": "input_angle",
    "K1": "play",
    "K2": "play",
}


def _drive(given: list[Any]) -> Drive:
    crank_teeth, idler, output, module, crank, frame, assembly = given
    sides = module * abs(crank_teeth + idler) / 2.0, module * abs(idler + output) / 2.0
    linkage = FourBar(crank, *sides, frame, int(assembly))
    return Drive(linkage, GearTrain(crank_teeth, idler, output), math.radians(20.0), module * abs(output) / 2.0)


@pytest.mark.parametrize("case", GAINS, ids=lambda case: str(case["name"]))
def test_gains_are_the_reference(case: dict[str, Any]) -> None:
    given = case["input"]
    found = register_gains(_drive(given["drive"]), np.radians([given["phi"]]), given["tau"])
    for name, wanted in case["expected"].items():
        if name in NAMES:
            value = getattr(found, NAMES[name])[0]
            got = [value.real, value.imag] if isinstance(wanted, list) else value
            assert got == pytest.approx(wanted, abs=case["tolerance"]), name
        else:  # a gear's phase is counted from crank angle 0 here, from another zero there
            value = {"e1": found.crank_gear, "e3": found.idler, "e5": found.output_gear}[name][0]
            assert abs(value) == pytest.approx(math.hypot(*wanted), abs=case["tolerance"]), name


PARTS = {
    "crank": "crank",
    "crank_idler": "crank_idler",
    "idler_output": "idler_output",
    "frame": "frame",
    "loop": "pin_a",
    "crank_gear": "crank_gear",
    "idler": "idler",
    "output_gear": "output_gear",
    "crank_idler_play": "play",
    "idler_output_play": "play",
    "input_angle": "input_angle",
}
DRIVES = [
    [40, 72, 40, 2.0, 38.94178567, 153.53024891, 1],
    [20, 20, 60, 2.5, 18.0, 121.4, -1],
    [40, 60, 50, 2.0, 160.0, 40.0, 1],
    [48, 36, -118, 1.0, 23.539125991604145, 53.76717909237369, 1],
    [-118, 36, 48, 1.0, 12.0, 50.0, -1],
    [-100, 30, -90, 1.0, 12.0, 40.0, 1],
]


@pytest.mark.quick(2)
@pytest.mark.parametrize("given", DRIVES)
@pytest.mark.parametrize("sign", [1, -1])
def test_gains_are_the_slopes_of_the_exact_chain(given: list[Any], sign: int) -> None:
    drive, angles = _drive(given), np.linspace(0.2, 6.2, 7)
    gains = register_gains(drive, angles, sign)
    for part, name in PARTS.items():
        step = 1e-6 if part == "input_angle" else 1e-4
        for direction in (1.0, 1j) if np.iscomplexobj(getattr(gains, name)) else (1.0,):
            ends = [
                output_error(drive, angles, sign, Errors({part: np.array([side * step * direction])}))
                for side in (1, -1)
            ]
            slope = (getattr(gains, name) * direction).real
            assert (ends[0] - ends[1]) / (2.0 * step) == pytest.approx(slope, abs=2e-7), part


def _register(given: list[Any], **register: Any) -> Any:
    """The register of a drive with every source."""
    crank_teeth, idler, output, module, crank, frame, assembly = given
    sources: dict[str, Any] = {key: {"plus_minus": 0.05} for key in OF_SIZES}
    sources |= {f"pins.{pin}": {"clearance": [0.0, 0.1]} for pin in "ABCD"}
    sources |= {f"gears.{gear}": {"eccentricity": 0.05} for gear in ("crank", "idler", "output")}
    gears = {"module": module, "crank": crank_teeth, "idler": idler, "output": output}
    made = {"kind": "three-gear-four-bar", "name": "a", "gears": gears, "links": {"crank": crank, "frame": frame}}
    more = {"assembly": int(assembly), "tolerance": {"sources": sources}, "register": {"at": 0} | register}
    return design(made | more, command="register")


OF_SIZES = {
    "links.crank": "crank",
    "links.frame": "frame",
    "centers.crank_idler": "crank_idler",
    "centers.idler_output": "idler_output",
}
OF_OTHERS = {
    "pins.A": "pin_a",
    "pins.B": "crank_idler",
    "pins.C": "idler_output",
    "pins.D": "pin_d",
    "gears.crank": "crank_gear",
    "gears.idler": "idler",
    "gears.output": "output_gear",
}


@pytest.mark.parametrize("given", DRIVES)
@pytest.mark.parametrize("sign", [1, -1])
def test_gains_by_duality_are_those_derived_by_hand(given: list[Any], sign: int) -> None:
    made, angles = _register(given), np.linspace(0.2, 6.2, 7)
    drive = replace(_drive(given), train=made.design.train)
    gains = register_gains(drive, angles, sign)
    for one in made.contributions(angles, sign):
        wanted = getattr(gains, (OF_SIZES | OF_OTHERS)[one.source])
        assert one.gain == pytest.approx(wanted, abs=1e-12), one.source


@pytest.mark.quick(4)
@pytest.mark.parametrize("given", DRIVES)
@pytest.mark.parametrize("sign", [1, -1])
def test_the_whole_chain_is_the_one_closed_by_hand(given: list[Any], sign: int) -> None:
    """Errors of 0.05 mm at once, away from where the output hardly follows."""
    made, angles, random = _register(given), np.linspace(0.2, 6.2, 7), np.random.default_rng(1)
    parts = {
        source.key: 0.05 * (random.uniform(-1.0, 1.0, 5) * np.exp(6j * random.uniform(size=5)) if vector else
                            random.uniform(-1.0, 1.0, 5))
        for source in made.sources
        for vector in [source.coordinates == 2 and source.key not in ("pins.B", "pins.C")]
    }  # fmt: skip
    drive = replace(_drive(given), train=made.design.train)
    by_hand = {OF_SIZES[key]: parts[key] for key in OF_SIZES}
    by_hand["crank_idler"] = by_hand["crank_idler"] + parts["pins.B"]
    by_hand["idler_output"] = by_hand["idler_output"] + parts["pins.C"]
    by_hand |= {"loop": parts["pins.A"] - parts["pins.D"]} | {
        OF_OTHERS[key]: parts[key] for key in OF_OTHERS if key.startswith("gears")
    }
    found = made.sampled_errors(angles, sign, parts)
    assert found == pytest.approx(output_error(drive, angles[:, None], sign, Errors(by_hand)), abs=1e-11)


def test_a_pin_in_the_frame_gains_by_the_transmission_angle() -> None:
    drive = _drive(DRIVES[0])
    angles = np.linspace(0.0, 6.0, 13)
    gamma = fourbar_sweep.solve(drive.linkage, angles).transmission_angle
    assert np.abs(register_gains(drive, angles, 1).pin_a) == pytest.approx(1.0 / np.cos(0.5 * gamma), rel=1e-13)


@pytest.mark.parametrize("given", DRIVES)
def test_a_longer_crank_moves_the_output_as_its_four_bar_does(given: list[Any]) -> None:
    """No mesh changes its centre distance: the motion of the other four-bar itself, by large."""
    drive, angles, longer = _drive(given), np.linspace(0.2, 6.2, 7), 0.3
    links, train = drive.linkage, drive.train
    other = replace(links, crank=links.crank + longer)
    one, two = (fourbar_sweep.solve(each, angles) for each in (links, other))
    turned = train.coupler_share * (two.coupler_angle - one.coupler_angle)
    turned += train.rocker_share * (two.rocker_angle - one.rocker_angle)
    found = output_error(drive, angles, 1, Errors({"crank": np.array([longer])}))
    assert found == pytest.approx(drive.radius * turned, abs=1e-10)


@pytest.mark.parametrize("given", DRIVES)
def test_between_its_flanks_the_output_has_the_backlash_that_centre_distances_give(given: list[Any]) -> None:
    """j_t = 2 (r_b1 + r_b2)(inv alpha' - inv alpha)/cos alpha, the radius of a ring negative: its play closes."""
    drive, angles, off = _drive(given), np.array([1.0, 4.0]), 0.05
    crank_teeth, idler, output, module, *_ = given
    for name, teeth in (("crank_idler", crank_teeth + idler), ("idler_output", idler + output)):
        errors = Errors({name: np.array([off])})
        jump = np.subtract(*(output_error(drive, angles, sign, errors) for sign in (-1, 1)))
        distance = 0.5 * module * abs(teeth)
        working = math.acos(distance * math.cos(drive.pressure_angle) / (distance + off))
        widened = math.tan(working) - working - math.tan(drive.pressure_angle) + drive.pressure_angle
        assert jump == pytest.approx(module * teeth * widened, abs=1e-12), name


def test_the_direction_in_which_the_output_is_counted_does_not_change_its_errors() -> None:
    """Output and torque are counted backward together: the same flank carries."""
    drive, angles = _drive(DRIVES[3]), np.linspace(0.2, 6.2, 5)
    back = replace(drive, train=replace(drive.train, sense=-1))
    for name in ("crank", "idler_output", "output_gear", "pin_a"):
        one, other = (getattr(register_gains(each, angles, sign), name) for each, sign in ((drive, 1), (back, -1)))
        assert other == pytest.approx(-one, abs=1e-13), name


SOURCES: dict[str, Any] = {
    key: {"plus_minus": 0.01} for key in ("links.crank", "links.frame", "centers.crank_idler", "centers.idler_output")
} | {f"pins.{pin}": {"clearance": [0.0, 0.01]} for pin in "ABCD"}


@pytest.mark.parametrize("sign", [1, -1])
def test_sampled_sources_move_the_output_as_their_gains_say(sign: int) -> None:
    """Over h = 1 um the difference is off by h^2 and eps/h; a pin of the loop moves along its own direction alone."""
    made = design("candy_feed", command="register", tolerance={"sources": SOURCES}, register={"at": 0})
    phi, h, none = np.radians([60.0, 250.0]), 1e-3, dict.fromkeys(SOURCES, np.zeros(1))
    for one in made.contributions(phi, sign):
        for way in (1.0, 1j) if np.iscomplexobj(one.gain) else (1.0 + 0j,):
            parts = none | {one.source: np.array([h * way if one.source.startswith("pins") else h])}
            back = none | {one.source: -parts[one.source]}
            ends = [made.sampled_errors(phi, sign, each)[:, 0] for each in (parts, back)]
            assert (ends[0] - ends[1]) / (2.0 * h) == pytest.approx((one.gain * way).real, abs=1e-7), one.source


GIVEN = {
    "kind": "three-gear-four-bar",
    "name": "a",
    "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
    "links": {"crank": 38.85708906, "frame": 153.5517067},
    "tolerance": {"sources": {"links.frame": {"plus_minus": 0.01}}},
}


@pytest.mark.parametrize("register", [{}, {"backlash": 0.03}, {"output_inertia": 0.02, "friction": 1.5}])
def test_without_speed_or_inertia_the_torque_turns_by_inertia_alone(register: dict[str, float]) -> None:
    """Of I = 1 at 90 and 270 deg, the middle of the dwell; a finding where the file tells of play or torque."""
    made = design(GIVEN, register=register, command="register")
    assert np.degrees(made.flips) == pytest.approx([90.0, 270.0], abs=1e-4)
    assert [check.status for check in made.check("backlash-in-dwell")] == (["warn"] if register else [])


def test_a_shaft_lags_under_the_load_of_either_kind_of_train() -> None:
    """-r T/k; the load resists the mean motion, which that of a ring has against the crank."""
    ring = {"module": 1, "crank": 48, "idler": 36, "output": -118}
    for gears, links in ((GIVEN["gears"], GIVEN["links"]), (ring, {"crank": 14.0, "frame": 40.0})):
        changes = {"gears": gears, "links": links, "register": {"at": 100, "load": 2.0, "stiffness": 500.0}}
        made = design(GIVEN | changes, command="register")
        assert made.output_torque(1.0) == 2.0
        way = math.copysign(1.0, made.design.mean_ratio)
        (twist,) = (row for row in made.contributions(np.array([1.0]), 1) if row.source.startswith("wind-up"))
        assert twist.gain[0] * way == pytest.approx(-made.radius * 2.0 / 500.0, rel=1e-12)


def test_a_torque_of_inertia_needs_a_speed() -> None:
    made = design(GIVEN, register={"at": 100, "output_inertia": 0.02, "stiffness": 500.0}, command="register")
    with pytest.raises(NoSolution) as caught:
        made.contributions(np.array([1.0]), 1)
    assert caught.value.key == "input_speed"


def test_the_friction_that_is_named_keeps_the_sign_of_the_torque() -> None:
    """J w^2 max |W'| of a drive that never turns back, at 90 1/min; where it is slowed the most, less than that lets
    the torque turn."""
    gears = {"module": 2.0, "crank": 40, "idler": 72, "output": 40}
    one_way = {"kind": "three-gear-four-bar", "name": "a", "gears": gears, "links": {"crank": 20, "frame": 153.53}}
    tolerance = {"sources": {"links.crank": {"plus_minus": 0.02}}}

    def made(**section: float) -> Any:
        given = {"tolerance": tolerance, "register": {"output_inertia": 0.02} | section}
        return design(one_way | {"input_speed": 90} | given, command="register")

    one = made()
    drive, phi = one.design, np.linspace(0.0, 2.0 * math.pi, 7201)
    change = [Output(drive.linkage, drive.train).acceleration(float(x)) for x in phi]
    inertia = 0.02 * (90.0 * 2.0 * math.pi / 60.0) ** 2
    most, slowed = inertia * max(map(abs, change)), -inertia * min(change)
    named = float(one.against_flips.split("above ")[1].split(" ")[0])
    assert named == pytest.approx(most, rel=1e-3)
    assert [len(made(friction=f).flips) for f in (most, 1.002 * slowed, 0.998 * slowed)] == [0, 0, 2]
