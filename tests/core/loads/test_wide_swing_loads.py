"""Loads of a wide-swing stroke: the reference without its device, and the contact with it; 1e-7 as it was printed."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import GearlinkError
from gearlink.core.base.report import Rule

DATA = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())
EXPECTED = DATA["wide_swing"]["expected"]
K = np.array(EXPECTED["k"])


@pytest.fixture(scope="module")
def swing() -> Any:
    loads = {"roller": {"width": 20}, "vibration": {"frequency": 60, "damping": 0, "allowed_residual": 0.2}}
    return factory.design("wide_swing_twin_cam", command="loads", loads=loads)


def inertia_torque(loads: Any) -> Any:
    """Torque on the rocker that moves it in the working stroke at the design speed [N m]."""
    motion = loads.design.motion
    return motion.inertia * motion.swing / motion.working_time**2 * motion.law.device_torque(K)


def test_stroke_against_the_reference(swing: Any) -> None:
    stroke, reserve = swing.strokes[0], swing.spec.unloader.reserve
    assert inertia_torque(swing) == pytest.approx(EXPECTED["torque"], rel=1e-7)
    assert stroke.relative_radius(K) == pytest.approx(EXPECTED["relative_radius"], rel=1e-7)
    # With its device the cam carries what the device gives too much, the other way.
    assert -swing.machine.torque(stroke.angle(K)) / reserve == pytest.approx(EXPECTED["cam_torque"], rel=1e-7)
    assert -stroke.force(K) / reserve == pytest.approx(EXPECTED["contact_force"], rel=1e-7)


SPRING = {"between": ["rocker", "frame"], "points": [[40, 0], [160, 90]], "rate": 0.02, "free_length": 60}
FORCES = {
    "roller": {"width": 20},
    "device_direction": 40,
    "forces": [{"on": "rocker", "torque": {"zones": [{"from": 20, "to": 60, "value": -3}]}}],
    "springs": [SPRING],
    "friction": {"pins": 0.05, "pin_radius": 8},
}


@pytest.mark.parametrize("base", ["wide_swing_twin_cam", "wide_swing_twin_rocker"])
def test_device_by_its_geometry_leaves_what_its_law_says(base: str) -> None:
    """The pull of cylinder or spring along its own line, against the closed form of the law; both strokes' profiles."""
    design = factory.design(base, command="loads", loads={"roller": {"width": 20}})
    stroke = design.strokes[0]
    lever = 1e-3 * stroke.cam.rocker_radius * np.cos(stroke.cam.pressure_angle(K))
    excess = design.spec.unloader.reserve * np.abs(inertia_torque(design))
    assert stroke.force(K) * lever == pytest.approx(excess, rel=1e-11)
    assert design.design.unloading.contact_force(stroke.cam, K) == pytest.approx(stroke.force(K), rel=1e-11)
    assert design.power_identity <= 1e-12


@pytest.mark.parametrize("layout", ["twin-rocker", "twin-cam"])
def test_whole_cycle(layout: str) -> None:
    """Both strokes against the closed form, rests against the device's whole force, where no torque is left."""
    design = factory.design("wide_swing_cycle", command="loads", layout=layout, loads={"roller": {"width": 20}})
    for stroke in design.strokes:
        assert design.design.unloading.contact_force(stroke.cam, K) == pytest.approx(stroke.force(K), rel=1e-11)
    working, far, back, near = design.design.motion.cycle_angles
    rests = np.array([working + 0.3 * far, working + far + back + 0.6 * near])
    forces = design.machine.reactions(rests).unknowns["roller"][0]
    assert max(forces) == pytest.approx(design.design.dwell_force, rel=1e-12)
    assert design.machine.torque(rests) == pytest.approx(0.0, abs=1e-12)
    assert design.power_identity <= 1e-12
    assert abs(design.input_torque_mean) <= 1e-12 * design.input_torque_max


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["twin-rocker", "twin-cam"])
def test_cycle_with_all_that_may_act(layout: str) -> None:
    """Friction's power is what virtual power and reactions differ by; the shafts together bear what acts outside."""
    design = factory.design("wide_swing_cycle", command="loads", layout=layout, loads=FORCES)
    assert design.power_identity <= 1e-12
    phi = np.radians(np.array([33.0, 120.0, 200.0, 300.0]))
    found = design.machine.reactions(phi)
    frame = sum(found.force(name) for name in design.pins if design.has(name))
    pulls = sum(each.force for each in design.machine.applied(phi) if hasattr(each, "force"))
    assert frame + pulls == pytest.approx(0.0, abs=1e-9 * np.abs(pulls).max())
    assert design.contact_force_max != pytest.approx(design.design.contact_force, rel=1e-3)


def test_what_needs_the_whole_turn_says_so() -> None:
    loads = {"flywheel": {"inertia": 1.0}}
    with pytest.raises(GearlinkError, match="give cycle") as caught:
        factory.design("wide_swing_twin_cam", command="loads", loads=loads).report("loads")
    assert caught.value.key == "loads.flywheel"
    run = factory.design("wide_swing_cycle", command="loads", loads={"flywheel": {"inertia": 40.0}})
    assert 0.0 < run.raw("speed_fluctuation") < 0.1


def test_residual_after_the_stroke_by_another_integral(swing: Any) -> None:
    """Simpson over 20001 rows in time; 1e-8 of the swing."""
    n = 20_001
    u = np.linspace(0.0, 1.0, n)
    time = swing.cam.cycle_angle / swing.speed
    bend = swing.design.motion.plain_law.invariants(u, 2)[2] * 120.0 / time**2
    w = 2.0 * math.pi * 60.0
    weights = np.ones(n)
    weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
    whole = np.sum(weights * bend * np.exp(1j * w * time * (1.0 - u))) * time / (3.0 * (n - 1))
    assert math.degrees(swing.residual_amplitude) == pytest.approx(abs(whole) / w, abs=1e-8 * 120.0)


def test_a_torque_that_ends_with_its_stroke_has_no_reversal_there() -> None:
    """What asks on which side of an end the torque changes sign looks beyond the stroke, where the rocker rests."""
    forces = [{"on": "rocker", "torque": -15.0}, {"on": "rocker", "resistance": 4.0}]
    design = factory.design("wide_swing_twin_rocker", command="loads", loads={"forces": forces})
    torque = design.machine.torque(np.linspace(0.0, design.machine.period, 4001)[1:-1])
    assert design.raw("torque_reversals") == np.count_nonzero(np.diff(np.sign(torque)))


@pytest.mark.slow
def test_a_roller_whose_profile_is_undercut_has_no_pressure() -> None:
    """The least curvature radius of the path, 7.003 mm, is less than the roller's 8: there the profile has no bend."""
    sound, undercut = (factory.design("loaded_swing_slider", command="loads", cycle_angle=angle) for angle in (150, 15))
    assert [check.status for check in sound.check("contact-pressure")] == ["pass"]
    assert undercut.hertz_pressure_max is None
    assert undercut.shear_depth is None
    assert [check.status for check in undercut.check("contact-pressure")] == ["fail"]


def test_a_check_of_what_is_no_number_does_not_pass() -> None:
    rule = Rule("GL999", "", "", "", "", checks=("toy",))
    with pytest.raises(ArithmeticError, match="GL999 toy"):
        rule.check("pass", "in order", math.nan)
    assert rule.check("pass", "nothing to compare").value is None


@pytest.mark.slow
def test_every_result_can_be_asked_for(swing: Any) -> None:
    report = swing.report("loads", tables=("spectrum",))
    assert {table.name for table in report.tables} == {"torque", "contact_stroke", "spectrum"}
    assert all(math.isfinite(quantity.value) for quantity in report.quantities if quantity.name != "massless")


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["loaded_swing_slider", "loaded_wide_swing"])
def test_a_stroke_ends_before_its_friction_turns_back(name: str) -> None:
    """The last row has not the resistance of the return, 3.4 N less than the row before it: its slider stands there."""
    changes = {} if name == "loaded_swing_slider" else {"loads__forces": [{"on": "rocker", "resistance": 5}]}
    made = factory.design(name, command="loads", **changes)
    force = np.asarray(made.table("contact_stroke", samples=1000)["main_force"], dtype=float)
    steps = np.abs(np.diff(force[-20:]))
    assert steps[-1] < 3.0 * steps[:-1].max()


def _least_force(made: Any, speed: float) -> float:
    """Minimum force of the roller at another speed of the cam with the same device, without friction [N]."""
    machine = dataclasses.replace(made.machine, speed=speed * math.pi / 30.0, friction=None)
    places = [(each, np.linspace(*part, 2001)) for each in made.strokes for part in each.parts]
    return min(float(machine.reactions(each.pressing_angle(k)).unknowns["roller"][0].min()) for each, k in places)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("loaded_swing_slider", {}),
        ("loaded_swing_slider", {"forces": [], "links": {}, "gravity": [0.0, -0.5]}),
        ("loaded_oscillating_cam", {"forces": [{"on": "rocker", "torque": 0.5}]}),
        ("loaded_swing_cycle", {"forces": [{"on": "rocker", "torque": -0.5}]}),
    ],
    ids=["resistance", "weight", "drive", "cycle"],
)
def test_the_roller_is_without_force_at_the_speed_of_lift_off(name: str, changes: dict[str, Any]) -> None:
    """The speed out of forces at rest and of the masses, against the forces at that speed; 1e-9 of some 100 N."""
    made = factory.design(name, command="loads", **{f"loads__{key}": value for key, value in changes.items()})
    assert made.lift_off_speed < made.design.unloading.lift_off_speed
    assert _least_force(made, made.lift_off_speed) == pytest.approx(0.0, abs=1e-7)


def test_the_share_that_the_device_misses_counts_in_lift_off() -> None:
    """Next to nothing acts besides: the closed form n0 sqrt(1 + rho - f)."""
    made = factory.design("loaded_wide_swing", command="loads", loads__forces=[{"on": "rocker", "torque": -1e-7}])
    assert made.spec.unloader.residual > 0.0
    assert made.lift_off_speed == pytest.approx(made.design.unloading.lift_off_speed, rel=1e-8)
    assert made.lift_off_speed != made.design.unloading.lift_off_speed
    pushed = factory.design("loaded_wide_swing", command="loads", loads__forces=[{"on": "rocker", "torque": -500.0}])
    assert pushed.lift_off_speed == 0.0


@pytest.mark.slow
def test_the_weight_of_a_slider_counts_in_the_force_of_its_roller() -> None:
    """Without other loads: against the maximum of the table, 108 N; 34 N are those of inertia and device."""
    changes = {"forces": [], "links": {}, "gravity": [0.0, -9.81]}
    made = factory.design("loaded_swing_slider", command="loads", **{f"loads__{k}": v for k, v in changes.items()})
    force = np.asarray(made.table("contact_stroke", samples=4000)["main_force"], dtype=float)
    assert made.contact_force_max == pytest.approx(np.nanmax(np.abs(force)), rel=1e-3)
