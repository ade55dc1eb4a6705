"""Smallest cams: of the gripper by their centre, of the press by their base radius.

Tolerances, EPS = 2^-52: the centre of the reference (25 digits) to 1e-11 mm - it is the corner of two half-planes
whose touching angles are found to the root of rounding, which enters squared; pressure angles at the limit to
1e-12 rad, for the same reason; a centre or radius a little smaller must break the limit.
"""

from __future__ import annotations

import math
from functools import partial
from typing import Any

import factory
import numpy as np
import pytest
from oracles.gripper import CASES, machine
from sweeps import mostly_slow

from gearlink.core.base.errors import MissingSection, NoSolution


def sized(limit: float, **keys: Any):
    return machine(cam__center=None, size__pressure_angle=limit, **keys)


def test_apex_of_the_reference() -> None:
    expected = {key: float(value) for key, value in CASES["FEAS-01"]["expected"].items()}
    design = machine(cam__center=None, cam__return_roller=None, size={"pressure_angle": 25.0, "side": 1})
    assert abs(design.cam_center - complex(expected["Ox"], expected["Oy"])) <= 1e-11
    (largest,) = design.max_pressure_angle
    assert largest == pytest.approx(math.radians(25.0), rel=0.0, abs=1e-12)
    prime = abs(design.main_cam.points(np.array([0.0]))[0][0])
    assert prime == pytest.approx(expected["r_pitch_min"], rel=0.0, abs=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize("limit", [26.0, 28.0, 35.0])
def test_both_rollers_keep_the_limit_and_no_smaller_cam_does(limit: float) -> None:
    design = sized(limit)
    center = design.cam_center
    assert max(design.max_pressure_angle) == pytest.approx(math.radians(limit), rel=0.0, abs=1e-12)
    roller = design.main_cam.path(np.array([0.0]), 1).position[0] + center
    for turn in range(0, 360, 15):
        nearer = center + 0.2 * np.exp(1j * math.radians(turn))
        if abs(nearer - roller) < abs(center - roller) - 1e-3:
            other = machine(cam__center=[nearer.real, nearer.imag])
            assert max(other.max_pressure_angle) > math.radians(limit)


@pytest.mark.slow
def test_the_chosen_centre_is_reported_and_may_be_given() -> None:
    design = sized(28.0)
    for command in ("gripper", "cam", "analyze"):
        quantity = design.report(command).quantities
        found = {each.name: each.value for each in quantity}["cam_center"]
    again = machine(cam__center=found)
    assert again.max_pressure_angle == design.max_pressure_angle
    assert "cam_center" not in again.outline("cam").quantities


@pytest.mark.slow
@pytest.mark.parametrize("limit", mostly_slow([28.0, 26.0, 30.0, 35.5, 42.0], 1))
def test_cams_that_are_sized_to_their_limit_pass_it(limit: float) -> None:
    """Rounding, some 1e-14 of the limit, fails no GL401; a hundred-millionth of a degree more does."""
    kept = {"pressure_angle": limit, "accelerate_pressure_angle": limit}
    assert {check.status for check in sized(limit, limits=kept).check("pressure-angle")} == {"pass"}
    less = dict.fromkeys(kept, limit - 1e-8)
    assert {check.status for check in sized(limit, limits=less).check("pressure-angle")} >= {"fail"}


def test_one_roller_must_say_where_the_cam_is() -> None:
    design = sized(28.0, cam__return_roller=None)
    with pytest.raises(NoSolution, match=r"size\.side") as refused:
        _ = design.cam_center
    assert refused.value.key == "size"


def test_neither_centre_nor_size() -> None:
    with pytest.raises(MissingSection, match=r"cam\.center"):
        _ = machine(cam__center=None).cam_center


def test_a_limit_that_no_centre_keeps() -> None:
    with pytest.raises(NoSolution, match="no cam centre") as refused:
        _ = sized(15.0).cam_center
    assert refused.value.key == "size.pressure_angle"


press = partial(factory.design, "ty460")
