"""Gains by duality and the whole chain, against four-bars that are made anew.

Tolerances: over +-h a difference quotient is off by h^2 and eps/h; the chain is exact.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gearlink.core.mechanism.dual import Chain, Dual, Shift, gradient
from gearlink.core.mechanism.joints import Coupling, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import fixed, mixed
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.parts.linkages.fourbar.position import FourBar

BAR = FourBar(18.0, 50.0, 100.0, 121.4)
ANGLES = np.linspace(0.2, 6.2, 7)
SIZES = {
    "crank": Shift("crank", ("B",)),
    "coupler": Shift("coupler", ("C",)),
    "rocker": Shift("rocker", ("C",)),
    "frame": Shift(FRAME, ("D",)),
}


def _made(bar: FourBar, angles: Reals) -> Mechanism:
    links = four_bar(bar, angles, 1)
    return Mechanism(links, four_bar_pins(links), "crank")


def _turn(mechanism: Mechanism) -> list[Reals]:
    return list(mechanism.links["rocker"].turn)


def _height(mechanism: Mechanism) -> list[Reals]:
    return [part.imag for part in mechanism.links["coupler"].at(20.0 + 30.0j)]


@pytest.mark.parametrize("value", [_turn, _height])
@pytest.mark.parametrize("name", SIZES)
def test_gains_of_sizes_are_the_slopes_of_other_four_bars(name: str, value: object) -> None:
    h = 1e-4
    ends = [value(_made(replace(BAR, **{name: getattr(BAR, name) + h * side}), ANGLES))[0] for side in (1, -1)]  # type: ignore[operator]
    gain = Dual(_made(BAR, ANGLES), value).gain(SIZES[name])  # type: ignore[arg-type]
    assert gain == pytest.approx((ends[0] - ends[1]) / (2.0 * h), abs=1e-8)


def test_the_chain_is_another_four_bar_by_large() -> None:
    errors = {"crank": 0.3, "coupler": -0.2, "rocker": 0.4, "frame": 0.5}
    other = replace(BAR, **{name: getattr(BAR, name) + error for name, error in errors.items()})
    found = Chain(_made(BAR, ANGLES), {}).output(_turn, [(SIZES[name], error) for name, error in errors.items()])
    assert found[:, 0] == pytest.approx(_turn(_made(other, ANGLES))[0] - _turn(_made(BAR, ANGLES))[0], abs=1e-11)


def test_a_chain_that_does_not_close_is_no_number() -> None:
    at = np.array([1.0])
    found = Chain(_made(BAR, at), {}).output(_turn, [(SIZES["coupler"], np.array([0.0, -40.0]))])
    assert found[0, 0] == 0.0
    assert np.isnan(found[0, 1])


def test_the_load_of_a_value_has_its_rate_as_power() -> None:
    made = _made(BAR, ANGLES)
    power = np.zeros(ANGLES.size)
    for act in gradient(made, _height):
        link = made.links[act.on]
        power += (np.conj(act.force) * link.origin.first).real + act.couple * link.turn.first
    assert power == pytest.approx(_height(made)[1], abs=1e-12)


def test_an_element_that_turns_with_its_link_leaves_the_link_behind() -> None:
    """The output of a train of ratio 3 behind the rocker: an arm that sits askew by 1 on it turns it by 3."""
    made = _made(BAR, ANGLES)
    pivot = fixed(200.0, ANGLES, order=1)
    links = {**made.links, "output": Link(pivot, mixed((3.0, made.links["rocker"].turn)))}
    joints = [*made.connections, Pin("O", FRAME, "output", pivot.value)]
    joints.append(Coupling("train", "rocker", "output", pivot.value, 3.0))
    geared = Mechanism(links, joints, "crank")
    askew = Shift("rocker", ("train",), turned=True)
    gain = Dual(geared, lambda machine: list(machine.links["output"].turn)).gain(askew)
    assert gain == pytest.approx(np.full(ANGLES.size, 3.0), abs=1e-13)


def test_a_joint_of_another_link_is_refused() -> None:
    with pytest.raises(AssertionError, match="D is no joint of crank"):
        Dual(_made(BAR, ANGLES), _turn).gain(Shift("crank", ("D",)))
