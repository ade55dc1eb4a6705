"""Friction: the fixed point against plain passes, locking as a finding, and blocks of a system against the whole."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.remedies.trials import Bench
from gearlink.core.mechanism.blocks import blocks
from gearlink.core.mechanism.friction import Rubbing, SelfLocking, solution_of

FEED, PRESS = "loaded_feed", "loaded_press"
RUBBING = {"pins": 0.1, "pin_radius": 10, "guides": 0.1, "meshes": 0.98}
SLIDER = {"speed": 75, "links": {"crank": {"mass": 20, "inertia": 0.3}, "slider": {"mass": 240}}}
PHI = np.radians(np.arange(3.0, 360.0, 17.0))


def _solution(base: str, friction: Any) -> Any:
    machine = factory.design(base, command="loads", loads__friction=friction).machine
    return solution_of(
        machine.at(PHI), machine.masses, machine.applied(PHI), machine.gravity, machine.speed, machine.friction
    )


@pytest.mark.parametrize("base", [FEED, PRESS])
def test_blocks_solve_what_the_whole_system_says(base: str) -> None:
    """LAPACK on all unknowns at once; 1e-12 of the largest, the condition is below 1e3."""
    mechanism, system, rubbing, _ = _solution(base, None)
    entries = system.entries
    assert len(blocks(tuple(tuple(each) for each in entries))) > 8
    matrix = np.zeros((len(PHI), system.size, system.size))
    for column, rows in enumerate(entries):
        for row, factor in rows.items():
            matrix[:, row, column] = factor
    side = np.einsum("nij,jn->in", matrix, rubbing.free)
    whole = np.linalg.solve(matrix, side.T[..., None])[..., 0].T
    assert np.abs(whole - rubbing.free).max() <= 1e-12 * np.abs(whole).max()
    assert mechanism.rows == len(PHI)


@pytest.mark.parametrize("base", [FEED, PRESS])
def test_newton_ends_where_the_passes_end(base: str) -> None:
    """Plain passes, 200 of them, whose ratio is below 0.3."""
    rubbing = _solution(base, RUBBING).rubbing
    sizes = np.zeros((len(PHI), len(rubbing.shares)))
    for _ in range(200):
        sizes = rubbing.sizes(rubbing.forces(sizes))
    assert rubbing.settled() == pytest.approx(sizes, rel=1e-11, abs=1e-11 * sizes.max())


def test_the_roller_that_carries_is_that_of_the_forces_with_friction() -> None:
    """The follower's own balance across its guide, over degrees at which friction alone decides which cam pushes.

    The pinion pushes the lower rack away from the bed.
    """
    phi = np.radians(np.arange(76.0, 79.0, 0.05))
    keys = {"command": "loads", "speed": 3000, "loads__gravity": [0, 0]}
    heavy = {"pins": 0.1, "pin_radius": 30, "guides": 0.15}
    press, smooth = (factory.design(PRESS, **keys, loads__friction=each) for each in (heavy, None))
    found = press.machine.reactions(phi)
    (cam,) = (each for each in found.mechanism.connections if each.name == "cam")
    force, plain = (one.side_force(phi) for one in (press, smooth))
    assert ((force < 0.0) != (plain < 0.0)).any()
    assert not np.array_equal(np.sign(force), np.full_like(force, np.sign(force[0])))
    across = found.unknowns["guide_rack"][0] + (force * cam.normal).real
    separating = math.tan(math.radians(20.0)) * np.abs(found.unknowns["rack_lower"][0])
    assert across == pytest.approx(press.section.bed_side * separating, abs=1e-9 * separating.max())


def test_a_rack_turns_no_carriage_of_its_pinion() -> None:
    """Losses act between pinion and rack: the carriage, which rod and pinion meet in one point, is turned by none."""
    press = factory.design(PRESS, command="loads", loads__friction={"meshes": 0.9})
    found = press.machine.reactions(PHI)
    teeth = sum(np.abs(found.unknowns[name][0]) for name in ("rack_lower", "rack_upper"))
    lost = 1e-4 * press.pinion_radius * teeth  # what would turn it
    assert found.unknowns["guide_carriage"][1] == pytest.approx(np.zeros(PHI.size), abs=1e-9 * lost.max())


def test_ratio_is_that_of_the_last_passes() -> None:
    """Of one joint alone the ratio is exact: sizes f = mu |a + b f| change by mu |b| a pass, up to 1 and beyond."""
    for mu in (0.3, 0.95, 1.7):
        rubbing = Rubbing(np.array([[5.0]]), np.array([[[0.9]]]), np.array([mu]), np.array([[0, 0]]))
        if mu * 0.9 < 1.0:
            sizes = rubbing.settled()
            assert sizes[0, 0] == pytest.approx(mu * 5.0 / (1.0 - mu * 0.9), rel=1e-12)
            assert rubbing.ratio(sizes)[0] == pytest.approx(mu * 0.9, rel=1e-12)
        else:
            with pytest.raises(SelfLocking):
                rubbing.settled()


@pytest.mark.parametrize("base", ["loaded_six_bar", PRESS])
def test_ratio_is_that_of_passes_without_end(base: str) -> None:
    """What 2^40 passes leave, by squaring: the root takes the part of the norm away; the same ratio in all units."""
    rubbing = _solution(base, RUBBING).rubbing
    sizes = rubbing.settled()
    found = rubbing.ratio(sizes)
    power, logarithm = rubbing.rates(rubbing.forces(sizes)), np.zeros(len(PHI))
    for doubling in range(40):
        size = np.abs(power).max(axis=(1, 2))
        logarithm += np.log(size) / 2.0**doubling
        power = (power / size[:, None, None]) @ (power / size[:, None, None])
    assert found == pytest.approx(np.exp(logarithm), rel=1e-9)
    units = 10.0 ** np.arange(len(rubbing.shares))
    other = replace(rubbing, responses=rubbing.responses / units[:, None, None], shares=rubbing.shares * units)
    assert other.ratio(sizes * units) == pytest.approx(found, rel=1e-9)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("base", "friction"),
    [(FEED, {"pins": 0.9, "pin_radius": 60}), ("ty460_slider_crank", {"guides": 0.99, "pins": 0.9, "pin_radius": 200})],
)
def test_locking_is_a_finding(base: str, friction: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """GL615 fails; what needs no forces is given, what needs them is left out, and the table is empty there."""
    monkeypatch.setattr(Bench, "remedy", lambda *_: ())  # which is sought for long, and held by test_remedies.py
    design = factory.design(
        base,
        command="loads",
        **({"loads": SLIDER | {"friction": friction}} if "slider" in base else {"loads__friction": friction}),
    )
    report = design.report("loads")
    (found,) = [check for check in report.checks if check.code == "GL615"]
    assert found.status == "fail"
    names = {quantity.name for quantity in report.quantities}
    assert {"reflected_inertia_max", "shaking_force_max"} <= names
    assert not {"input_torque_max", "power_identity", "flywheel_inertia", "pin_A.peak", "pin_D.peak"} & names
    assert np.isnan(report.tables[0]["input_torque"]).all()
    assert not np.isnan(report.tables[0]["inertia_part"]).any()


def test_strong_friction_still_moves() -> None:
    """Where hardly anything is taken off a pass the forces are found all the same, and warned of."""
    friction = {"pins": 0.3, "pin_radius": 65, "meshes": 0.95}
    design = factory.design(FEED, command="loads", loads__friction=friction)
    (check,) = design.check("self-locking")
    assert check.status == "warn"
    assert 0.5 < check.value < 0.9
    assert design.power_identity <= 1e-12


@pytest.mark.parametrize("friction", [None, {"pins": 0.1, "pin_radius": 10}])
def test_energy_from_samples_is_that_of_the_load(friction: Any) -> None:
    design = factory.design(FEED, command="loads", loads__friction=friction)
    sampled = design.energy
    exact = replace(sampled, sampled=None)
    phi = np.linspace(0.0, 2.0 * math.pi, 101)
    size = np.abs(exact.surplus(phi)).max()
    assert np.abs(sampled.surplus(phi) - exact.surplus(phi)).max() <= 1e-12 * size


@pytest.mark.slow
def test_many_zones_take_few_rows() -> None:
    """400 zones that add up to one: the same energies as that one; 1e-12."""
    ends = np.linspace(30.0, 150.0, 401).tolist()
    zones = [{"from": a, "to": b, "value": -20.0} for a, b in itertools.pairwise(ends)]
    many, one = (
        factory.design(FEED, command="loads", loads__forces=[{"on": "output", "torque": {"zones": each}}])
        for each in (zones, [{"from": 30.0, "to": 150.0, "value": -20.0}])
    )
    assert len(many.machine.panels.nodes) < 7_000
    assert many.input_torque_rms == pytest.approx(one.input_torque_rms, rel=1e-12)
    assert many.energy_fluctuation == pytest.approx(one.energy_fluctuation, rel=1e-12)
    assert many.input_torque_max == pytest.approx(one.input_torque_max, rel=1e-12)


@pytest.mark.slow
def test_hardly_any_friction_changes_hardly_anything() -> None:
    """Where forces turn as well as a zone ends, two breaks are one but for rounding; 1e-5 of the surplus."""
    free, rubbing = (
        factory.design(PRESS, command="loads", loads__friction=friction).energy
        for friction in (None, {"pins": 1e-6, "pin_radius": 1})
    )
    assert rubbing.range == pytest.approx(free.range, rel=1e-5)


@pytest.mark.slow
def test_where_joints_turn_back_a_row_is_the_one_just_after() -> None:
    """At 0 and 180 deg coupler and rocker turn back against each other: the pin between them and the mesh that rolls
    on it change sides there together, and no row has one of them on the old side."""
    data = factory.worked("wide_lever") | {"loads": {"speed": 90, "gravity": [5, -7]}}
    data["loads"] |= {"links": {name: {"mass": 2, "inertia": 0.01} for name in ("coupler", "output")}}
    data["loads"] |= {"friction": RUBBING, "forces": [{"on": "output", "resistance": 3}]}
    machine = factory.design(data, command="loads").machine
    back = np.array([0.0, math.pi, 2.0 * math.pi])
    at, after = machine.reactions(back), machine.reactions(back + 1e-9)
    assert at.force("C") == pytest.approx(after.force("C"), rel=1e-6)
    assert at.torque == pytest.approx(after.torque, rel=1e-6)


@pytest.mark.slow
def test_how_near_it_is_to_locking_is_the_worst_of_all_turns() -> None:
    """A five-bar of three revolutions is nearest to locking in its second, between two rows of 5 deg."""
    links = {"input": 35, "coupler": 80, "follower": 75, "output": 35}
    data = {"kind": "geared-five-bar", "form": "path", "gears": {"module": 2, "input": 20, "output": 60}, "phase": 60}
    data |= {"links": links, "coupler_point": {"along": 30}}
    masses = {"coupler": {"mass": 2, "center": [20, 5]}, "follower": {"mass": 4, "center": [20, 5]}}
    data["loads"] = {"speed": 90, "links": masses, "forces": [{"on": "output", "torque": 5}], "friction": RUBBING}
    design = factory.design(data, command="loads")
    rows = np.linspace(0.0, design.machine.period, 5003)
    worst = float(design.machine.passes_ratio(rows).max())
    assert design.machine.turns == 3
    assert worst > 2.0 * design.machine.locking[0]
    (found,) = design.check("self-locking")
    assert found.value >= worst * (1.0 - 1e-9)
    assert found.value == pytest.approx(worst, rel=0.03)  # beside a jump more than at any row


@pytest.mark.slow
def test_a_force_that_changes_sides_beside_a_jump_is_a_break() -> None:
    """On the return stroke the roller pulls for 0.06 deg before the rest, where the force jumps: less than a row.

    The mean of the torque against panels that halve towards every break from both sides; 1e-13 of the root mean square.
    """
    machine = factory.design("loaded_swing_cycle", command="loads").machine
    ends, edges = [0.0, *machine.breaks, machine.period], [0.0]
    for low, high in itertools.pairwise(ends):
        shares = [0.5**k for k in range(30, 0, -1)]
        near = [low, *(low + (high - low) * share for share in shares)]
        near += [high - (high - low) * share for share in reversed(shares[:-1])] + [high]
        for start, end in itertools.pairwise(near):
            edges += np.linspace(start, end, math.ceil((end - start) / 0.03) + 1)[1:].tolist()
    x, weights = np.polynomial.legendre.leggauss(10)
    nodes = (np.array(edges[:-1])[:, None] + np.diff(edges)[:, None] * (0.5 * (x + 1.0))).ravel()
    values = np.concatenate([machine.torque(part) for part in np.array_split(nodes, 4)]).reshape(-1, 10)
    mean = float(np.sum(np.diff(edges) * (values @ (0.5 * weights)))) / machine.period
    size = math.sqrt(machine.mean(lambda phi: machine.torque(phi) ** 2))
    assert machine.mean(machine.torque) == pytest.approx(mean, abs=1e-13 * size)


@pytest.mark.slow
def test_many_turns_have_their_forces_computed_once_for_all_that_integrates_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """7 turns: mean, rms, energy and what pins bear look at the same nodes, and changes of sign at the same grid."""
    from gearlink.core.studies.loads import machine

    asked, solve = [0], machine.settled

    def counted(mechanism: Any, *given: Any) -> Any:
        asked[0] += mechanism.rows
        return solve(mechanism, *given)

    monkeypatch.setattr(machine, "settled", counted)
    keys = {"gears__idler": 70, "gears__crank": 40, "loads__links__idler__center": [3.0, 0.0]}
    design = factory.design(FEED, command="loads", **keys, loads__friction={"pins": 0.03, "pin_radius": 8})
    assert design.turns == 7
    design.report("loads")
    assert asked[0] < 6000 * design.turns
