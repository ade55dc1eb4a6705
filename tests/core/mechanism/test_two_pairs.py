"""Two pairs of rollers whose forces decide each other's sides, against all four choices of sides, solved one by one."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
import pytest

from gearlink.core.mechanism.dynamics import Force, System
from gearlink.core.mechanism.friction import Coefficients, settled, solution_of
from gearlink.core.mechanism.joints import Contact, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import Point, fixed, steady

ROWS = 200
PAIRS = ("left", "right")
SIDES = [*itertools.product((False, True), repeat=2)]
SLIDING = Coefficients(0.0, 0.0, 1.0, 0.0, {"edge": 0.3})


def around(angle: float, spread: float, random: Any) -> Any:
    return np.exp(1j * (angle + spread * random.uniform(-1.0, 1.0, ROWS)))


def plate() -> tuple[Mechanism, list[Force]]:
    """A plate that two pairs of rollers and an edge hold; the edge slides on a shaft that turns. Each row has its own
    places, normals and load; the rollers of a pair stand askew, so that who carries on the one side is felt on the
    other."""
    random = np.random.default_rng(5)
    zero = np.zeros(ROWS)
    links = {"shaft": Link(fixed(-50j, zero), steady(zero, 1.0)), "plate": Link(fixed(0j, zero), steady(zero, 0.0))}
    held = []
    for name, at, angle in (("left", -60.0 + 5j, 1.2), ("right", 60.0 + 5j, 1.9)):
        back = (np.full(ROWS, at + 30j), around(angle, 0.6, random))
        held.append(Contact(name, FRAME, "plate", np.full(ROWS, at), around(angle, 0.6, random), back))
    edge = Contact("edge", "shaft", "plate", np.full(ROWS, -8j), around(0.0, 0.2, random), slides=True)
    joints = [Pin("A", FRAME, "shaft", np.full(ROWS, -50j)), *held, edge]
    push = Point(*fixed(10.0 + 4j, zero))
    load = Force("plate", 100.0 * (random.normal(size=ROWS) + 1j * random.normal(size=ROWS)), push)
    return Mechanism(links, joints, "shaft"), [load]


MECHANISM, APPLIED = plate()
SYSTEM = System(MECHANISM, {})


def dense(factors: dict[int, Any]) -> Any:
    found = np.zeros((ROWS, SYSTEM.size))
    for row, value in factors.items():
        found[:, row] = value
    return found


def matrix(sides: tuple[bool, bool]) -> Any:
    """Columns of the unknowns where the second rollers carry as `sides` says."""
    columns = [dense(each) for each in SYSTEM.entries]
    for name, is_back in zip(PAIRS, sides, strict=True):
        joint = next(each for each in MECHANISM.connections if each.name == name)
        assert isinstance(joint, Contact)
        if is_back:
            place = SYSTEM.place(name)
            columns[place] = dense(SYSTEM.factors(joint.backward(SYSTEM.columns[place][1])))
    return np.stack(columns, axis=-1)


def solved(sides: tuple[bool, bool], side: Any) -> Any:
    return np.linalg.solve(matrix(sides), side[..., None])[..., 0].T


def chosen(friction: Coefficients | None) -> tuple[Any, Any]:
    """All unknowns of the choice of sides that bears itself out in each row, and how many do."""
    side = dense(SYSTEM.right_side(APPLIED, 0j, 1.0, 0.0))
    found, count = np.full((SYSTEM.size, ROWS), np.nan), np.zeros(ROWS, dtype=int)
    for sides in SIDES:
        x = solved(sides, side)
        if friction is not None:
            (unit,) = friction.units(MECHANISM, 1.0)
            rubs = solved(sides, dense(SYSTEM.side(unit.acts)))
            edge = SYSTEM.place("edge")
            # f = mu max(x + f y, 0) at the edge itself
            x = x + rubs * (0.3 * np.maximum(x[edge], 0.0) / (1.0 - 0.3 * rubs[edge]))
        holds = np.all([(x[SYSTEM.place(name)] < 0.0) == way for name, way in zip(PAIRS, sides, strict=True)], axis=0)
        found[:, holds], count = x[:, holds], count + holds
    return found, count


@pytest.mark.quick(4)
@pytest.mark.parametrize("friction", [None, SLIDING])
@pytest.mark.parametrize("sides", SIDES)
def test_columns_of_every_choice_of_sides(sides: tuple[bool, bool], friction: Coefficients | None) -> None:
    """1e-11 of the largest: the condition is below 1e3 of rows, where the exchange divides by no small share."""
    pulled = {name: np.full(ROWS, way) for name, way in zip(PAIRS, sides, strict=True)}
    found = solution_of(MECHANISM, {}, APPLIED, 0j, 1.0, friction, pulled).rubbing
    wanted = solved(sides, dense(SYSTEM.right_side(APPLIED, 0j, 1.0, 0.0)))
    assert found.free == pytest.approx(wanted, abs=1e-11 * np.abs(wanted).max())
    if friction is not None:
        (unit,) = friction.units(MECHANISM, 1.0)
        wanted = solved(sides, dense(SYSTEM.side(unit.acts)))
        assert found.responses[0] == pytest.approx(wanted, abs=1e-11 * np.abs(wanted).max())


@pytest.mark.parametrize("friction", [None, SLIDING])
def test_rollers_that_carry_are_those_that_push(friction: Coefficients | None) -> None:
    """In rows where exactly one choice of sides bears itself out: 95 of 100 at least, and each choice in some."""
    wanted, count = chosen(friction)
    only = count == 1
    assert only.mean() > 0.95
    ways = wanted[[SYSTEM.place(name) for name in PAIRS]][:, only] < 0.0
    assert {(bool(left), bool(right)) for left, right in ways.T} == {*SIDES}
    found, sizes = settled(MECHANISM, {}, APPLIED, 0j, 1.0, friction)
    unknowns = found.rubbing.unknowns(sizes)
    assert unknowns[:, only] == pytest.approx(wanted[:, only], abs=1e-10 * np.abs(wanted[:, only]).max())


def test_a_choice_that_comes_back_ends_the_search(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where either roller would have it the other way: of n pairs the search went on for 2^n choices."""
    solved: list[Any] = []

    def counted(*given: Any) -> Any:
        solved.append(solution_of(*given))
        return solved[-1]

    def other_way(found: Any, _unknowns: Any) -> Any:
        return {name: ~used if name == "left" else used for name, used in found.pulled.items()}

    monkeypatch.setattr("gearlink.core.mechanism.friction._first_changed", other_way)
    monkeypatch.setattr("gearlink.core.mechanism.friction.solution_of", counted)
    assert settled(MECHANISM, {}, APPLIED, 0j, 1.0, SLIDING)[0] is solved[-1]
    assert len(solved) == 2
