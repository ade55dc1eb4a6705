"""Nearest and farthest pass of the coupler joint over a whole revolution of the linkage.

Tolerances: distances 4 eps of the longest link (one rounded sum); the crank angle of a bound is checked by the distance
that the closed linkage has there: near a bound the distance is flat (dead centre, quadratic), so that an angle good to
a few eps times the condition 1/sin of the other triangle's angle leaves 1e-13 of the links. The brute-force scan
bounds from inside only: it may miss the bound by the square of its step times the links.
"""

import cmath
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages.fourbar.nearest_passes import joint_to_crank_pivot
from gearlink.core.parts.linkages.fourbar.position import FourBar

EPS = 2.0**-52


def joint(phi, a, b, c, d, assembly):
    """C by the intersection of two circles, in complex numbers (None where they miss)."""
    pin = a * cmath.exp(1j * phi)
    line = d - pin
    reach = abs(line)
    cosine = (b * b + reach * reach - c * c) / (2.0 * b * reach)
    if abs(cosine) > 1.0:
        return None
    return pin + b * line / reach * cmath.exp(1j * assembly * math.acos(cosine))


def scan(a, b, c, d, assembly, steps=720):
    points = [joint(2.0 * math.pi * i / steps, a, b, c, d, assembly) for i in range(steps)]
    return None if None in points else [abs(p) for p in points]


@st.composite
def turning(draw):
    """Links whose crank turns fully: |b - c| < |d - a| and a + d < b + c, with some room."""
    short, apart, crank_shorter = draw(st.floats(0.2, 5.0)), draw(st.floats(0.1, 5.0)), draw(st.booleans())
    a, d = (short, short + apart) if crank_shorter else (short + apart, short)
    difference = apart * draw(st.floats(-0.9, 0.9))
    total = (a + d) * (1.0 + draw(st.floats(0.02, 2.0)))
    return a, 0.5 * (total + difference), 0.5 * (total - difference), d


@examples(200)
@given(turning(), st.sampled_from([1, -1]))
def test_range_of_the_coupler_joint_against_a_scan(links, assembly):
    a, b, c, d = links
    total = a + b + c + d
    distances = scan(a, b, c, d, assembly)
    assert distances is not None
    nearest, farthest = joint_to_crank_pivot(FourBar(a, b, c, d, assembly))
    assert min(distances) >= nearest.distance - 1e-12 * total
    assert max(distances) <= farthest.distance + 1e-12 * total
    for bound in (nearest, farthest):
        assert 0.0 <= bound.crank_angle < 2.0 * math.pi
        there = joint(bound.crank_angle, a, b, c, d, assembly)
        assert abs(there) == pytest.approx(bound.distance, abs=2e-12 * total)
        for step in (-1e-3, 1e-3):  # and it is an extreme, of this assembly
            beside = abs(joint(bound.crank_angle + step, a, b, c, d, assembly))
            assert (beside - bound.distance) * (1.0 if bound is nearest else -1.0) >= -1e-12 * total


def test_named_linkages():
    near, far = joint_to_crank_pivot(FourBar(18.0, 50.0, 100.0, 121.4))  # crank-rocker of thesis example 3
    assert (near.distance, far.distance) == (32.0, 68.0)
    near, far = joint_to_crank_pivot(FourBar(116.0, 100.0, 100.0, 37.0))  # drag link of the bed chain
    assert (near.distance, far.distance) == (63.0, 137.0)
    near, far = joint_to_crank_pivot(FourBar(100.0, 100.0, 95.0, 40.0, -1))  # drag link of the cylinder chain
    assert (near.distance, far.distance) == (55.0, 135.0)


def test_idler_reaches_the_input_shaft_of_thesis_example_1():
    near, _ = joint_to_crank_pivot(FourBar(38.85708906, 112.0, 112.0, 153.5517067))
    assert near.distance == pytest.approx(73.143, abs=5e-4)
    assert near.distance < 74.0  # the idler's tips cross the shaft's axis


@examples(60)
@given(turning())
def test_mirror_and_scale(links):
    a, b, c, d = links
    upper, lower = joint_to_crank_pivot(FourBar(a, b, c, d, 1)), joint_to_crank_pivot(FourBar(a, b, c, d, -1))
    large = joint_to_crank_pivot(FourBar(64.0 * a, 64.0 * b, 64.0 * c, 64.0 * d, 1))
    for first, mirrored, scaled in zip(upper, lower, large, strict=True):
        assert first.distance == mirrored.distance == scaled.distance / 64.0
        assert math.remainder(first.crank_angle + mirrored.crank_angle, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-14)
        assert scaled.crank_angle == first.crank_angle


@pytest.mark.parametrize(
    "links",
    [
        (100.0, 50.0, 18.0, 121.4),  # the long link driven
        (50.0, 60.0, 40.0, 70.0),  # change point
        (10.0, 20.0, 20.0, 100.0),  # does not close
    ],
)
def test_crank_that_does_not_turn_is_refused(links):
    with pytest.raises(NoSolution, match="not a crank-rocker or drag link"):
        joint_to_crank_pivot(FourBar(*links))
