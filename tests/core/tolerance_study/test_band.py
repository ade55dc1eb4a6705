"""The output over the cycle: arrays against the class of one drive, percentiles against closed forms of linear scatter.

Tolerances: arrays against the class rounding of angles, 1e-12 rad; a percentile of 4096 points some per cent of sigma.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.studies.tolerance_study.samples import SHARES, courses, outputs_of

CANDY: dict[str, Any] = {
    "kind": "three-gear-four-bar",
    "name": "candy",
    "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
    "links": {"crank": 38.94178567, "frame": 153.53024891},
}
SLIDER: dict[str, Any] = {"kind": "slider-crank", "name": "slider", "crank": 40.0, "rod": 120.0, "offset": 10.0}


def study(data: dict[str, Any], /, **section: Any) -> Any:
    return factory.design(data | {"tolerance": section}, command="tolerance")


@pytest.mark.parametrize(
    ("entry", "limits"),
    [
        ({"plus_minus": 0.02}, (-0.02, 0.02)),
        ({"lower": -0.01, "upper": 0.03}, (-0.01, 0.03)),
        ({"limits": [-0.04, -0.01]}, (-0.04, -0.01)),
        ({"sigma": 0.01}, (-0.03, 0.03)),
        ({"measured": 40.02}, (0.02, 0.02)),
        ({"class": "h7"}, (-0.025, 0.0)),  # ISO 286: IT7 of 40 mm
    ],
    ids=lambda value: next(iter(value)) if isinstance(value, dict) else "",
)
def test_limits_of_a_size_in_each_form(entry: dict[str, Any], limits: tuple[float, float]) -> None:
    (source,) = study(SLIDER, sources={"crank": entry}).problem.sources
    assert (source.law.lower, source.law.upper) == pytest.approx(limits, abs=1e-14)
    assert source.limit == pytest.approx(max(map(abs, limits)), abs=1e-14)


def test_arrays_are_the_drives_one_by_one() -> None:
    sources = {"links.crank": {"plus_minus": 0.05}, "centers.crank_idler": {"plus_minus": 0.05}}
    made = study(CANDY, sources=sources).problem
    columns = made.offsets([{}, {"links.crank": 0.05}, {"centers.crank_idler": -0.05, "links.crank": 0.02}])
    places = np.radians([0.0, 50.0, 135.0, 200.0, 224.0, 300.0, 359.0])
    found = made.axis.course(columns, places)
    start = math.radians(made.axis.reference)
    nominal = made.nominal
    for i in range(3):
        one = made.axis.design({key: float(value[i]) for key, value in columns.items()})
        for k, phi in enumerate(places):
            turned, wanted = (
                Output(drive.linkage, drive.train).angle(phi) - Output(drive.linkage, drive.train).angle(start)
                for drive in (one, nominal)
            )
            assert found[k, i] == pytest.approx(turned - wanted, abs=1e-12)


def test_a_pin_that_turns_the_frame_turns_the_crank_angles() -> None:
    """Play along the frame is a frame of another length; play across it turns the line A-D by v/d."""
    made = study(CANDY, sources={"pins.A": {"clearance": [0.0, 0.04]}}).problem
    play, places = 0.02, np.radians([30.0, 120.0, 250.0])
    found = made.axis.course(made.offsets([{"pins.A": -play}, {"pins.A": 1j * play}]), places)
    links, train = made.nominal.linkage, made.nominal.train
    start = math.radians(made.axis.reference)
    speed = np.array([Output(links, train).speed(float(phi)) for phi in (*places, start)])
    across = play / links.frame * (speed[:-1] - speed[-1])  # to first order: crank angles grow by v/d
    assert found[:, 1] == pytest.approx(across, abs=2e-7)
    longer = made.axis.design({"links.frame": links.frame + play})
    for k, phi in enumerate(places):
        turned = [
            Output(d.linkage, train).angle(phi) - Output(d.linkage, train).angle(start) for d in (longer, made.nominal)
        ]
        assert found[k, 0] == pytest.approx(turned[0] - turned[1], abs=1e-12)


@pytest.mark.slow
def test_percentiles_of_linear_scatter_are_those_of_its_normal_law() -> None:
    (found,) = courses(study(CANDY, sources={"links.frame": {"plus_minus": 0.002}}, samples=2048).problem)
    assert (found.output, found.over, found.units) == ("output_angle", "crank_angle", ("deg", "deg"))
    width = np.max(np.abs(found.percentiles[4]))
    for share, times in zip(SHARES, (-3.0, -1.6448536, 0.0, 1.6448536, 3.0), strict=True):
        row = found.percentiles[SHARES.index(share)]
        slope = np.abs(found.percentiles[3] - found.percentiles[1]) / (2.0 * 1.6448536)
        assert row == pytest.approx(times * slope, abs=0.04 * width)


def test_one_by_one_the_far_percentiles_are_left_out() -> None:
    """A long rod: the slider's position follows the crank's length by cos, the rod's by 1 to first order."""
    made = study(SLIDER, sources={"rod": {"plus_minus": 0.03}}, samples=16)
    (found,) = courses(made.problem)
    assert found.output == "displacement"
    assert np.isnan(found.percentiles[[0, 4]]).all()
    slope = (courses_at(120.001) - courses_at(119.999)) / 0.002
    spread = found.percentiles[3] - found.percentiles[1]
    assert spread == pytest.approx(2.0 * 1.645 * 0.01 * np.abs(slope), rel=0.15, abs=1e-9)
    table = made.table_band()
    assert set(table.data[table.columns.index("q00135")]) == {None}
    assert table["q95"] == pytest.approx(found.percentiles[3], rel=1e-12)


def courses_at(rod: float) -> Any:
    return np.asarray(factory.design(SLIDER | {"rod": rod}).table("motion", samples=120)["displacement"])


@pytest.mark.parametrize("name", ["loaded_measured_cam", "slider_crank_tolerances"])
def test_outputs_are_those_that_the_design_has(name: str) -> None:
    """A measured cam has a lift or a follower's angle; its kind names both, and the picture ended in a fault."""
    made = factory.design(name, command="tolerance").problem
    table, names = outputs_of(made)
    assert names
    assert set(names) <= set(made.nominal.table(table).columns)
