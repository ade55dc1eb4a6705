"""Joints of the press chains: link lengths, velocities and equal-speed points.

Tolerances
    1e-9 mm: lengths of some 500 mm come back from coordinates within a few ulp, 1e-13 of them each.
    1e-6 relative: a central difference of step 1e-5 loses half the digits.
    1e-7 deg: equal-speed points of the reference are printed to so many digits.
"""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from gearlink.core.machines.flatbed_press.chains import BedChain, CylinderChain, least_transmission_input
from tests import factory

PHI = np.radians(np.arange(0.0, 360.0, 7.5))


MADE = factory.design("ty460")


@pytest.fixture
def bed() -> BedChain:
    return MADE.bed


@pytest.fixture
def cylinder() -> CylinderChain:
    return MADE.cylinder


def bed_positions(_bed: BedChain, phi: Any) -> Any:
    """Joints of A-B-C-D-E-F, and the velocity of F."""
    links = MADE.moving.at(phi, 1).links
    pins = {"a": "gear2", "b": "gear2", "c": "CDE", "d": "CDE", "e": "CDE", "f": "carriage"}
    found = {pin: links[link].at(pin.upper()) for pin, link in pins.items()}
    return SimpleNamespace(**{pin: at.value for pin, at in found.items()} | {"f_velocity": found["f"].first})


def cylinder_positions(_cylinder: CylinderChain, phi: Any) -> Any:
    """Joints of G-H-M-N, and the velocity of M."""
    links = MADE.moving.at(phi, 1).links
    pins = {"g": "gear1", "h": "gear1", "m": "MN", "n": "MN"}
    found = {pin: links[link].at(pin.upper()) for pin, link in pins.items()}
    return SimpleNamespace(**{pin: at.value for pin, at in found.items()} | {"m_velocity": found["m"].first})


def test_links_of_the_bed_chain_keep_their_lengths(bed: BedChain) -> None:
    at = bed_positions(bed, PHI)
    for start, end, length in ((at.a, at.b, 116.0), (at.b, at.c, 100.0), (at.c, at.d, 100.0)):
        np.testing.assert_allclose(np.abs(end - start), length, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(np.abs(at.e - at.d), bed.slider_crank_length, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(np.abs(at.f - at.e), 520.0, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(at.f.real, -13.0, rtol=0.0, atol=1e-9)


def test_crank_offset_angle_is_that_between_driven_crank_and_slider_crank(bed: BedChain) -> None:
    at = bed_positions(bed, PHI)
    np.testing.assert_allclose(np.angle((at.c - at.d) / (at.e - at.d)), math.radians(177.0), rtol=0.0, atol=1e-12)


def test_slider_makes_half_the_travel_of_the_bed(bed: BedChain) -> None:
    at = bed_positions(bed, PHI)
    np.testing.assert_allclose(2.0 * (at.f.imag - at.f[0].imag), bed.travel(PHI).value, rtol=0.0, atol=1e-9)


def test_assemblies_are_those_of_the_chains(bed: BedChain, cylinder: CylinderChain) -> None:
    left, right = bed_positions(bed, PHI), cylinder_positions(cylinder, PHI)
    assert np.all(np.imag(np.conj(left.d - left.b) * (left.c - left.b)) > 0.0)
    assert np.all(np.imag(np.conj(right.n - right.h) * (right.m - right.h)) < 0.0)


def test_links_of_the_cylinder_chain_keep_their_lengths(cylinder: CylinderChain) -> None:
    at = cylinder_positions(cylinder, PHI)
    for start, end, length in ((at.g, at.h, 100.0), (at.h, at.m, 100.0), (at.m, at.n, 95.0)):
        np.testing.assert_allclose(np.abs(end - start), length, rtol=0.0, atol=1e-9)


def test_velocities_are_the_derivatives_of_the_positions(bed: BedChain, cylinder: CylinderChain) -> None:
    step = 1e-5
    f = (bed_positions(bed, PHI + step).f - bed_positions(bed, PHI - step).f) / (2.0 * step)
    m = (cylinder_positions(cylinder, PHI + step).m - cylinder_positions(cylinder, PHI - step).m) / (2.0 * step)
    np.testing.assert_allclose(bed_positions(bed, PHI).f_velocity, f, rtol=1e-6, atol=1e-6)
    np.testing.assert_allclose(cylinder_positions(cylinder, PHI).m_velocity, m, rtol=1e-6, atol=1e-6)


def test_surface_of_the_cylinder_runs_as_the_pin_m_on_its_radius(cylinder: CylinderChain) -> None:
    pin = np.abs(cylinder_positions(cylinder, PHI).m_velocity)
    np.testing.assert_allclose(cylinder.travel(PHI, 1).first, pin * 140.0 / 95.0, rtol=1e-12)


def test_least_transmission_angle_stands_where_it_is_said_to(bed: BedChain, cylinder: CylinderChain) -> None:
    phi = np.array([least_transmission_input(bed), least_transmission_input(cylinder)])
    left, right = bed_positions(bed, phi[:1]), cylinder_positions(cylinder, phi[1:])
    for angle, least in (
        (np.angle((left.b - left.c) / (left.d - left.c))[0], 46.531948123073),
        (np.angle((right.h - right.m) / (right.n - right.m))[0], 35.723697488383266),
    ):
        folded = min(abs(angle), math.pi - abs(angle))
        assert math.degrees(folded) == pytest.approx(least, abs=1e-10)
