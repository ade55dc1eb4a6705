"""The dissertation's iteration against the quadrature.

Tolerances: the trapezoid's error is known to fall with dk^2, so the ratio of errors at half the step is 4 to a few
per cent (the next term is dk^4); the sizes quoted in its docstring hold to half a unit of their digit.
"""

from __future__ import annotations

import math

import pytest
from oracles.unloading_limits import iterated
from sweeps import mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import Device, Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw, legacy_law

DEVICES = [(Pneumatic(2.5), 120.0), (Spring(4.0, 0.5), 180.0), (Pneumatic(5.3), 300.0), (Spring(2.0, 0.0), 60.0)]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("device", "swing"), mostly_slow(DEVICES, 2))
def test_error_falls_with_the_square_of_the_step(device: Device, swing: float) -> None:
    exact = ElasticLaw(device, math.radians(swing))
    laws = [legacy_law(device, math.radians(swing), steps=n) for n in (10, 20, 40)]
    errors = [abs(law.energy_parameter / exact.energy_parameter - 1.0) for law in laws]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)
    assert errors[1] / errors[2] == pytest.approx(4.0, rel=0.02)


def test_extrapolation_to_zero_step_meets_the_quadrature() -> None:
    exact = ElasticLaw(Pneumatic(2.5), math.radians(120.0)).energy_parameter
    coarse, fine = (legacy_law(Pneumatic(2.5), math.radians(120.0), steps=n).energy_parameter for n in (40, 80))
    # Richardson's step leaves the dk^4 term, 16 times smaller a halving: below 1e-7 here
    assert (4.0 * fine - coarse) / 3.0 == pytest.approx(exact, rel=1e-7)


@pytest.mark.quick(2)
@pytest.mark.parametrize(("device", "swing"), DEVICES)
def test_passes_follow_the_contraction(device: Device, swing: float) -> None:
    b = ElasticLaw(device, math.radians(swing)).velocity_peak
    passes = legacy_law(device, math.radians(swing), steps=20).passes
    # |1 - B/2| a pass from an error of about that size down to 1e-12
    expected = math.log(1e-12) / math.log(abs(1.0 - 0.5 * b))
    assert passes == pytest.approx(expected, abs=4)


@pytest.mark.parametrize(("ratio", "degrees", "steps"), [(2.5, 120.0, 20), (5.3, 300.0, 10), (4.0, 300.0, 20)])
def test_iteration_by_brackets(ratio: float, degrees: float, steps: int) -> None:
    """N settles to 1e-12 in mu; lengths by the cosine rule lose some digits more."""
    found, swing = legacy_law(Pneumatic(ratio), math.radians(degrees), steps=steps), math.radians(degrees)
    parameter, passes = iterated(ratio, swing, steps=steps, exponent=1)
    assert found.energy_parameter == pytest.approx(parameter, rel=1e-10)
    assert found.passes == passes


@pytest.mark.slow
def test_squared_scale_is_slow_and_fails_beyond_two() -> None:
    swing = math.radians(120.0)
    parameter, passes = iterated(2.5, swing, steps=20, exponent=2)
    assert passes > 54
    assert parameter == pytest.approx(legacy_law(Pneumatic(2.5), swing).energy_parameter, rel=1e-9)
    with pytest.raises(ArithmeticError, match="no end in 100 passes"):
        iterated(5.3, math.radians(300.0), steps=10, exponent=2)


def test_no_steps() -> None:
    with pytest.raises(NoSolution, match="at least 1"):
        legacy_law(Pneumatic(2.5), 2.0, steps=0)
