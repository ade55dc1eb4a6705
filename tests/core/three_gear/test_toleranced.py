"""Drives as manufactured: the general class against the closed forms, and many at once against the class.

Tolerances: places of the turn are roots of well-conditioned functions, met to a few ulp of a turn (1e-12 rad leaves
room for the condition of the loop); at a standstill that nearly touches the condition is 1/sqrt(distance), 1e-11. The
crank angle of a dwell hangs by the inverse square of that of its back-step.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import factory
import numpy as np
import pytest
from sweeps import ALL

from gearlink.core.base.design import in_unit
from gearlink.core.base.nomenclature import term
from gearlink.core.machines.three_gear import sweep
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.register import DriveSamples, ThreeGearSamples, TolerancedDrive
from gearlink.core.parts.linkages.fourbar.position import FourBar

NEAR = 1e-11
NAMES = (
    "dwell_angle",
    "back_step_angle",
    "back_step_crank_angle",
    "speed_ratio_max",
    "speed_ratio_min",
    "acceleration_ratio_max",
    "acceleration_ratio_min",
    "min_transmission_angle",
    "tolerance_dwell_angle",
    "gear_gap",
)


def drive(crank: float, frame: float, teeth: tuple[int, int, int], module: float = 2.0, **keys: Any) -> Any:
    gears = {"module": module, "crank": teeth[0], "idler": teeth[1], "output": teeth[2]}
    links = {"crank": crank, "frame": frame}
    return factory.design({"kind": "three-gear-four-bar", "name": "as made", "gears": gears, "links": links, **keys})


DRIVES = {
    "candy feed": lambda: drive(38.94178567, 153.53024891, (40, 72, 40), dwell_tolerance=0.5),
    "back-step as wide as the band": lambda: drive(38.94178567, 153.53024891, (40, 72, 40), dwell_tolerance=10.1477),
    "wide band": lambda: drive(38.94178567, 153.53024891, (40, 72, 40), dwell_tolerance=10.4),
    "example 3": lambda: drive(18.0, 121.4, (20, 20, 60), 2.5, dwell_tolerance=0.6),
    "mirror image": lambda: drive(18.0, 121.4, (20, 20, 60), 2.5, assembly=-1, dwell_tolerance=0.3),
    "momentary dwell": lambda: drive(18.0, 115.5222156247132, (20, 20, 60), 2.5, dwell_tolerance=0.05),
    "drag link": lambda: drive(160.0, 40.0, (40, 60, 50), dwell_tolerance=3.0),
    "one way": lambda: drive(8.0, 110.0, (30, 40, 45), dwell_tolerance=2.0),
    "ring output": lambda: drive(23.539125991604145, 53.76717909237369, (48, 36, -118), 1.0, dwell_tolerance=0.5),
    "ring output turning back far": lambda: drive(22.0, 46.0, (24, 17, -54), dwell_tolerance=1.5),
    "ring round the idler": lambda: drive(12.0, 50.0, (-118, 36, 48), 1.0, dwell_tolerance=2.0),
    "end binds": lambda: drive(10.589, 148.763, (24, 50, 36), dwell_tolerance=8.534),
}


COUNTS = (12 if ALL else 4, pytest.param(256, marks=pytest.mark.slow))
"""Samples that are computed alone as well."""


@pytest.mark.quick(6)
@pytest.mark.parametrize("name", DRIVES)
def test_without_deviations_the_general_class_is_the_ordinary_one(name: str) -> None:
    nominal = DRIVES[name]()
    links = nominal.linkage
    made = TolerancedDrive(nominal.spec, (links.crank, links.coupler, links.rocker, links.frame))
    assert made.motion == nominal.motion
    for quantity in NAMES:
        wanted, got = (math.nan if one.raw(quantity) is None else one.raw(quantity) for one in (nominal, made))
        assert got == pytest.approx(wanted, rel=1e-12, abs=1e-12, nan_ok=True), quantity


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", DRIVES)
@pytest.mark.parametrize("count", COUNTS)
def test_many_drives_at_once_are_those_computed_alone(name: str, count: int) -> None:
    nominal = _with_window(DRIVES[name]())
    axis, columns = ThreeGearSamples(nominal), _columns(nominal, count)
    names = [*NAMES, "frame_length", "coupler_length", *(["dwell_swing"] if axis.has_window else [])]
    found = axis.evaluate(columns, names)
    for i in range(count):
        alone = axis.design({key: value[i] for key, value in columns.items()})
        for quantity in names:
            raw = alone.raw(quantity)
            wanted = math.nan if raw is None else in_unit(raw, term(quantity).unit)
            near = NEAR
            if quantity == "dwell_angle" and raw is not None:
                near = max(NEAR, 4e-13 / alone.raw("back_step_crank_angle") ** 2)
            assert found.quantities[quantity][i] == pytest.approx(wanted, rel=near, abs=near, nan_ok=True), quantity
        checks = [check for each in alone.outlines["analyze"].checks for check in alone.check(each)]
        wanted_findings = _said(
            (check.code, check.status, math.nan if check.value is None else check.value) for check in checks
        )
        statuses = [("fail" if f.fails[i] else "warn" if f.warns[i] else "pass") for f in found.findings]
        pairs = zip(found.findings, statuses, strict=True)
        got = _said((f.code, status, float(f.value[i])) for f, status in pairs)
        assert [row[:2] for row in got] == [row[:2] for row in wanted_findings]
        assert [row[2] for row in got] == pytest.approx(
            [row[2] for row in wanted_findings], rel=NEAR, abs=NEAR, nan_ok=True
        )


def _said(findings: Iterable[tuple[str, str, float]]) -> list[tuple[str, str, float]]:
    """The findings on the linkage; a sample that is computed alone has rows that say nothing of the others."""
    return sorted(row for row in findings if row[0].startswith("GL3") and not (row[1] == "pass" and math.isnan(row[2])))


@pytest.mark.parametrize("name", ["candy feed", "back-step as wide as the band", "ring output turning back far"])
def test_no_bit_of_a_drive_hangs_by_the_others(name: str) -> None:
    nominal = _with_window(DRIVES[name]())
    axis, columns = ThreeGearSamples(nominal), _columns(nominal, 48)
    names = [*NAMES, "dwell_swing"]
    whole = axis.evaluate(columns, names).quantities
    some = axis.evaluate({key: value[::5] for key, value in columns.items()}, names).quantities
    assert {quantity: whole[quantity][::5].tobytes() for quantity in names} == {
        quantity: some[quantity].tobytes() for quantity in names
    }


def _with_window(nominal: Any) -> Any:
    """The drive that asks for just the window that it has: some as manufactured miss it."""
    given = nominal.spec.model_dump(mode="json", exclude_unset=True, by_alias=True)
    return factory.design(given, dwell_window=math.degrees(nominal.tolerance_dwell_angle))


def _columns(nominal: Any, count: int) -> dict[str, Any]:
    off = np.random.default_rng(2).normal(size=(5, 2, count)) * 0.02
    return {
        "links.crank": nominal.crank_length + off[0, 0],
        "links.frame": nominal.frame_length + off[0, 1],
        "centers.crank_idler": nominal.coupler_length + off[1, 0],
        "centers.idler_output": nominal.rocker_length + off[1, 1],
        "pins.A": off[2, 0] + 1j * off[2, 1],
        "pins.C": off[3, 0] + 1j * off[3, 1],
        "bearings.D": off[4, 0] + 1j * off[4, 1],
    }


def test_a_drive_whose_lengths_are_nominal_is_the_nominal_drive_with_that_key() -> None:
    nominal = DRIVES["candy feed"]()
    cut = drive(38.94178567, 153.53024891, (40, 72, 40), limits={"transmission_angle": 47.0}, dwell_tolerance=0.5)
    made = ThreeGearSamples(nominal).design({}, cut)
    (check,) = made.check("transmission-angle")
    assert (check.limit, check.value) == (47.0, pytest.approx(nominal.check("transmission-angle")[0].value, rel=1e-14))
    assert made.raw("dwell_angle") == pytest.approx(nominal.raw("dwell_angle"), rel=1e-12)


def test_a_drive_that_does_not_turn_is_refused_not_computed() -> None:
    nominal = DRIVES["candy feed"]()
    found = ThreeGearSamples(nominal).evaluate({"links.crank": np.array([38.9, 500.0, -1.0])}, ["speed_ratio_max"])
    assert found.refused.tolist() == [0, 1, 1]
    assert np.isnan(found.quantities["speed_ratio_max"]).tolist() == [False, True, True]


@pytest.mark.parametrize("assembly", [1, -1])
def test_motions_of_many_lengths_are_those_of_each(assembly: int) -> None:
    rng = np.random.default_rng(0)
    nominal = drive(18.0, 121.4, (20, 20, 60), 2.5, assembly=assembly)
    a, b, c, d = np.array([[18.0], [50.0], [100.0], [121.0]]) + rng.random((4, 40))
    angles, made = rng.random(40) * 2.0 * math.pi, DriveSamples(nominal, (a, b, c, d))
    rates, turned = sweep.speed(angles, made.drives), made.angle_at(angles) - made.angle_at(np.zeros(40))
    for i, phi in enumerate(angles):
        one = FourBar(a[i], b[i], c[i], d[i], assembly), nominal.train, phi
        wanted = [Output(*one[:2]).speed(one[2]), Output(*one[:2]).acceleration(one[2]), Output(*one[:2]).jerk(one[2])]
        assert [rate[i] for rate in rates] == pytest.approx(wanted, abs=2e-14)
        assert turned[i] == pytest.approx(Output(*one[:2]).angle(one[2]), abs=4e-15)
