"""Loads of the geared six-bar: both torques for every seat of a train, energy over the period, and what is refused.

The forces themselves are held against an augmented system in tests/core/loads/test_augmented.py.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from factory import design, worked
from pydantic import ValidationError
from six_bars import LOADS, SIX_BARS

from gearlink.core.base.errors import GearlinkError
from gearlink.core.mechanism.joints import meshes_of

SWING = "six_bar_swing"
TURNS = {"both trains on one link, two revolutions": 2, "free gear on B": 3, "free gear on F": 3}


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", SIX_BARS)
def test_both_torques_agree_at_every_angle(name: str) -> None:
    """Virtual power and reactions, 1e-12 of the largest, over the whole period."""
    loads = design(SIX_BARS[name], command="loads")
    phi = np.linspace(0.0, loads.machine.period, 200, endpoint=False)
    power, forces = loads.machine.torque(phi), loads.machine.reactions(phi).torque
    assert np.abs(forces - power).max() <= 1e-12 * np.abs(power).max()
    assert np.abs(power).max() > 0.1


@pytest.mark.slow
@pytest.mark.parametrize("name", SIX_BARS)
def test_mean_power_is_that_of_the_load_and_friction_adds_to_it(name: str) -> None:
    """Masses and gravity take nothing over a period: the mean torque is 20 N m times the mean ratio of the output."""
    loads = design(SIX_BARS[name], command="loads")
    assert loads.turns == TURNS.get(name, 1)
    top = float(np.abs(loads.machine.torque(np.linspace(0.0, 6.0, 60))).max())
    assert loads.input_torque_mean == pytest.approx(20.0 * loads.design.mean_ratio, abs=1e-10 * top)
    rubbing = design(SIX_BARS[name], command="loads", loads__friction={"pins": 0.02, "pin_radius": 4, "meshes": 0.99})
    assert rubbing.input_power_mean > loads.input_power_mean
    assert rubbing.power_identity <= 1e-12


@pytest.mark.slow
def test_a_trial_of_loads_counts_the_turns_of_its_period() -> None:
    """Fifty turns cost as much as fifty designs of one revolution, with friction as thousand."""
    trains = [worked(SWING)["trains"][0] | {"pins": ["E", "F", "A"], "gears": [20, 30, 40]},
              {"pins": ["A", "B"], "module": 2, "gears": [22, 20]}]  # fmt: skip
    links = {"coupler_1": 180, "coupler_2": 180, "coupler_3": 180}
    section = {"links": {"coupler_2": {"mass": 1.5, "inertia": 0.004, "center": [60, 0]}}}
    more = {"trains": trains, "links": links, "start": {"coupler_1": 240, "output": -60}, "input_speed": 60}
    loads = design(SWING, command="loads", assembly=None, loads=section, **more)
    one = design(SWING, command="loads", loads=section)
    assert one.turns == 1
    assert loads.turns == 50
    assert loads.cost == 50 * one.cost
    rubbing = design(SWING, command="loads", assembly=None, loads=section | {"friction": {"meshes": 0.99}}, **more)
    _ = rubbing.machine
    assert rubbing.cost == 981 * one.cost


def test_the_worked_six_bar_works_against_its_brush() -> None:
    """Over a turn the drive gives 8 N m times all that the output swings, between its standstills by the geometry."""
    loads = design("loaded_six_bar", command="loads", loads__friction=None)
    places = np.array(loads.design.dwell_crank_angles)
    travel = float(np.abs(np.diff(loads.design.output(np.append(places, places[0] + 2.0 * np.pi)))).sum())
    assert 2.0 * np.pi * loads.input_torque_mean == pytest.approx(8.0 * travel, rel=1e-12)


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", SIX_BARS)
def test_links_move_as_their_rates_say(name: str) -> None:
    """Places, turns and their rates against differences of sixth order over 1e-3 rad: 1e-9 of the largest."""
    loads = design(SIX_BARS[name], command="loads")
    phi, step = np.array([0.4, 2.9, 5.1]), 1e-3
    near = {k: loads.moving.at(phi + k * step).links for k in (-3, -2, -1, 0, 1, 2, 3)}
    for link, here in near[0].items():
        for part in ("origin", "turn"):
            motion = {k: getattr(links[link], part) for k, links in near.items()}
            for order in (0, 1):
                rate = sum(w * (motion[k][order] - motion[-k][order]) for k, w in ((1, 45), (2, -9), (3, 1)))
                expected = getattr(here, part)[order + 1]
                assert np.abs(rate / (60 * step) - expected).max() < 1e-9 * max(1.0, float(np.abs(expected).max()))


def test_a_free_gear_bears_on_its_pin() -> None:
    """Without a mass its pin takes what both of its teeth press with: the three forces are in balance."""
    loads = design(SIX_BARS["free gear on B"], command="loads", loads__links__gear_1B=None)
    found = loads.machine.reactions(np.radians(np.arange(0.0, 360.0, 30.0)))
    teeth = [each for each in meshes_of(found.mechanism) if each.name in ("mesh_1AB", "mesh_1BC")]
    forces = {each.name: 1j * each.toward * found.unknowns[each.name][0] + found.radial(each.name) for each in teeth}
    assert found.force("gear_1B") == pytest.approx(forces["mesh_1BC"] - forces["mesh_1AB"], abs=1e-9)
    assert np.abs(found.force("gear_1B")).max() > 1.0


def test_a_balanced_free_gear_leaves_the_period_alone() -> None:
    for body in ({"mass": 1.5, "inertia": 0.001}, None):
        assert design(SIX_BARS["free gear on B"], command="loads", loads__links__gear_1B=body).turns == 1


# Refused


def test_without_the_section_there_are_no_loads(monkeypatch: pytest.MonkeyPatch) -> None:
    from gearlink.core.machines.six_bar.loads import SixBarLoads

    def refuse(*_: Any) -> Any:
        raise AssertionError("loads were computed")

    monkeypatch.setattr(SixBarLoads, "moving", property(refuse))
    assert "loads" not in design(SWING).spec.commands()
    assert design({**worked(SWING), "loads": LOADS}).report("analyze").quantities
    with pytest.raises(GearlinkError, match="needs the section loads"):
        design(SWING, command="loads").report("loads")


@pytest.mark.parametrize("asked", [None, {"start": -5, "end": 5}])
def test_a_loop_that_jams_is_refused(asked: Any) -> None:
    """A dead centre within the turn, whether or not the range of the file keeps away from it."""
    with pytest.raises(GearlinkError, match="whole period") as caught:
        design(SWING, command="loads", loads=LOADS, links__coupler_2=100, range=asked).report("loads")
    assert caught.value.key == ("links" if asked is None else "range")
    assert "range: {" not in str(caught.value)


def test_a_range_within_a_turn_that_closes_has_the_loads_of_the_turn() -> None:
    whole, part = (design(SWING, command="loads", loads=LOADS, range=r) for r in (None, {"start": 0, "end": 90}))
    assert part.input_torque_max == whole.input_torque_max


@pytest.mark.parametrize(
    ("keys", "place"),
    [
        ({"loads__speed": 0.0}, "loads.speed"),
        ({"loads__forces": [{"on": "gear_1B", "torque": 1}]}, "loads.forces[0].on"),
        ({"loads__links": {"gear_2C": {"mass": 1}}}, "loads.links.gear_2C"),
        ({"loads__links": {}, "loads__forces": []}, "loads.links"),
        ({"loads__bearings": {"G": {"kind": "plain", "width": 10, "diameter": 10}}}, "loads.bearings.G"),
    ],
)
def test_refused_with_the_key(keys: dict[str, Any], place: str) -> None:
    with pytest.raises(GearlinkError) as caught:
        design({**worked(SWING), "loads": LOADS}, command="loads", **keys).report("loads")
    assert caught.value.key == place


def test_a_negative_mass_is_refused() -> None:
    with pytest.raises(ValidationError):
        design({**worked(SWING), "loads": LOADS}, command="loads", loads__links__output__mass=-1.0)


def test_two_trains_between_the_same_pins_are_judged_both() -> None:
    made = design({k: v for k, v in SIX_BARS["both trains on one link, two revolutions"].items() if k != "loads"})
    assert len(made.meshes) == 3
    assert len(made.center_distance) == 3
    assert len(made.check("contact-ratio")) == 3
