"""Stiffness of shafts by their sizes: against the integral of the twist along the shaft, and where files take it.

Tolerance: 1e-13, some roundings of a closed form.
"""

from __future__ import annotations

from typing import Any

import factory
import pytest
from mpmath import mp, mpf, quad

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.torsion import SHEAR_MODULUS, ShaftPiece, torsional_stiffness

STEPPED = [{"diameter": 60.0, "length": 200.0}, {"diameter": 80.0, "length": 150.0, "bore": 20.0}]


def twisted(pieces: list[dict[str, float]]) -> float:
    """T/phi by phi = Int T dx/(G Int r^2 dA), both integrals by quadrature [N m/rad]."""
    with mp.workdps(25):
        angle = mpf(0)
        for piece in pieces:
            inner, outer = mpf(piece.get("bore", 0.0)) / 2, mpf(piece["diameter"]) / 2
            polar = quad(lambda r: 2 * mp.pi * r**3, [inner, outer])
            angle += quad(lambda _, polar=polar: 1000 / (SHEAR_MODULUS * polar), [0, piece["length"]])
        return float(1 / angle)


@pytest.mark.parametrize("pieces", [STEPPED[:1], STEPPED[1:], STEPPED])
def test_stiffness_is_that_of_the_twist(pieces: list[dict[str, float]]) -> None:
    made = [ShaftPiece(**piece) for piece in pieces]
    assert torsional_stiffness(made) == pytest.approx(twisted(pieces), rel=1e-13)
    assert torsional_stiffness(made[0]) == pytest.approx(twisted(pieces[:1]), rel=1e-13)
    assert torsional_stiffness(4e4) == 4e4


def test_the_main_shaft_of_a_machine_takes_sizes() -> None:
    numbers = [6e4, 4e4, 4e4, twisted(STEPPED), 2.2e5, 3e4]
    sizes: list[Any] = [6e4, 4e4, 4e4, STEPPED, 2.2e5, 3e4]
    shaft = factory.worked("sheet_press")["shaft"]
    one, other = (
        factory.design("sheet_press", command="loads", shaft=shaft | {"stiffnesses": each}) for each in (numbers, sizes)
    )
    name = "natural_frequencies"
    assert other.quantity(name).value == pytest.approx(one.quantity(name).value, rel=1e-12)


def test_the_register_takes_sizes() -> None:
    found = [
        factory.design("candy_feed_tolerances", command="register", register={"stiffness": each, "output_inertia": 0.5})
        for each in (twisted(STEPPED), STEPPED, None)
    ]
    values = [design.quantity("worst").value for design in found]
    assert values[1] == pytest.approx(values[0], rel=1e-12)
    assert values[2] != pytest.approx(values[0], rel=1e-6)


def _vibrating(name: str, stiffness: Any) -> Any:
    loads = factory.worked(name)["loads"]
    return factory.design(name, command="loads", loads=loads | {"vibration": {"stiffness": stiffness}})


def test_the_vibration_of_an_output_takes_sizes() -> None:
    one, other = (_vibrating("loaded_feed", each).quantity("natural_frequency") for each in (twisted(STEPPED), STEPPED))
    assert other.value == pytest.approx(one.value, rel=1e-12)


def test_the_drive_of_a_slider_has_no_shaft() -> None:
    loads = {"links": {"slider": {"mass": 5.0}}, "speed": 60.0, "vibration": {"stiffness": STEPPED}}
    with pytest.raises(NoSolution, match="slides"):
        factory.design("ty460_slider_crank", command="loads", loads=loads).quantity("natural_frequency")
