"""Joints of the swing gripper: link lengths, agreement with the motion, the drum on the line of centres.

Tolerances: 1e-9 mm, for lengths of some 500 mm come back from coordinates within a few ulp, 1e-13 of them each.
"""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from gearlink.core.machines.swing_gripper.design import drum_center
from gearlink.core.machines.swing_gripper.law import SixPhaseLaw
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
from gearlink.core.machines.swing_gripper.mechanism import links_of
from gearlink.core.parts.cams.laws import law

DEGREES = np.arange(0.0, 360.0, 7.5)
ARM = 300.0, math.radians(125.0)


def positions(linkage: GripperLinkage, length: float, direction: float, degrees: Any) -> Any:
    """Joints of A-C-D-E and the tip F."""
    links = links_of(linkage, np.radians(degrees), 0, length * np.exp(1j * direction))
    pins = {"a": "input", "c": "input", "d": "output", "e": "output", "f": "output"}
    return SimpleNamespace(**{pin: links[link].at(pin.upper()).value for pin, link in pins.items()})


@pytest.fixture
def linkage() -> GripperLinkage:
    phases = (100.0, 12.0, 50.0, 8.0, 120.0, 70.0)
    motion = SixPhaseLaw(phases, 0.45, law("velocity-345"), law("half-cycloidal"), law("modified-sine"))
    return GripperLinkage(motion, 230.0 + 0j, 498.0 + 55.0j, 150.0, 260.0, 100.0, math.radians(110.0), -1, 1)


def test_links_keep_their_lengths(linkage: GripperLinkage) -> None:
    at = positions(linkage, *ARM, DEGREES)
    for start, end, length in ((at.a, at.c, 150.0), (at.c, at.d, 260.0), (at.d, at.e, 100.0), (at.e, at.f, 300.0)):
        np.testing.assert_allclose(np.abs(end - start), length, rtol=0.0, atol=1e-9)


def test_arm_is_rigid_with_the_output_link(linkage: GripperLinkage) -> None:
    at = positions(linkage, *ARM, DEGREES)
    np.testing.assert_allclose(np.angle((at.f - at.e) / (at.d - at.e), deg=True), 15.0, rtol=0.0, atol=1e-10)


def test_assembly_puts_c_left_of_the_way_to_d(linkage: GripperLinkage) -> None:
    at = positions(linkage, *ARM, DEGREES)
    assert np.all(np.imag(np.conj(at.d - at.a) * (at.c - at.a)) > 0.0)


def test_drum_of_the_reference_machine(linkage: GripperLinkage) -> None:
    tip = complex(positions(linkage, *ARM, np.array([106.0])).f[0])
    center = drum_center(linkage.output_pivot, tip, 135.0)
    assert center == pytest.approx(498.0 + 55.0j + 435.0 * np.exp(1j * math.radians(99.8)), abs=1e-9)
    assert abs(center - tip) == pytest.approx(135.0, abs=1e-9)
