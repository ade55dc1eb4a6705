"""Planar mechanisms as manufactured: many at once against each by its class, the play of pins, studies of them."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from oracles.planar_zoo import FOUR_BAR, QUICK_RETURN, ZOO, made
from sweeps import mostly_slow

from gearlink.cli.opening import design
from gearlink.core.base.design_axis import as_arrays
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.samples import PlanarSamples
from gearlink.core.machines.planar.spec import PlanarSpec
from gearlink.core.studies.tolerance_study.problem import problem
from gearlink.core.studies.tolerance_study.samples import _single, evaluated, rows_of


def planar(name: str, **more: Any) -> PlanarMechanism:
    return PlanarMechanism(made(name, **more))


def sources(file: dict[str, Any]) -> dict[str, Any]:
    """A size of every link and line, and the play of the first pin."""
    found: dict[str, Any] = {}
    for name, link in file["links"].items():
        points = [] if isinstance(link, list) else [*link][1:]
        keys = [f"links.{name}[2]"] if isinstance(link, list) else [f"links.{name}.{point}[1]" for point in points]
        found |= {key: {"plus_minus": 0.05} for key in keys}
    for group in ("slides", "slots"):
        found |= {f"{group}.{name}.through[1]": {"plus_minus": 0.05} for name in file.get(group, {})}
    pin = PlanarSamples(
        PlanarMechanism(PlanarSpec.model_validate({"kind": "planar-mechanism", "name": "x", **file}))
    ).parts
    return found | {f"pins.{pin.pins[0]}": {"clearance": [0.01, 0.05]}}


def study(file: dict[str, Any], given: dict[str, Any]) -> Any:
    whole = {"kind": "planar-mechanism", "name": "x", **file, "tolerance": {"sources": given}}
    return problem(PlanarSpec.model_validate(whole))


@pytest.mark.parametrize("name", mostly_slow(["four-bar", "cylinder", "quick-return", "watt", "slide-on-lever"], 1))
def test_samples_at_once_are_those_of_the_class(name: str) -> None:
    """Every quantity within 1e-9 of its magnitude, and each verdict; places of flat extremes to 1e-6."""
    made_ = study(ZOO[name], sources(ZOO[name]))
    assert made_.is_quick
    columns = made_.sizes(np.random.default_rng(5).uniform(size=(2, made_.coordinates)))
    many = evaluated(made_, columns)
    few = as_arrays([_single(made_, row) for row in rows_of(columns)], made_.names, list(made_.base.codes))
    assert len(made_.quick_names) >= 9
    for key in made_.quick_names:
        size = max(1.0, np.abs(few.quantities[key]).max())
        room = 1e-6 if key.endswith("_at") else 1e-9
        assert many.quantities[key] == pytest.approx(few.quantities[key], abs=room * size), key
    for one, other in zip(many.findings, few.findings, strict=True):
        assert (one.code, one.fails.tolist(), one.warns.tolist()) == (
            other.code,
            other.fails.tolist(),
            other.warns.tolist(),
        )


@pytest.mark.slow
def test_samples_next_to_a_dead_centre_are_left_to_the_class() -> None:
    """A rocker that stretches within some hundredths of a degree: errors of 0.05 mm may jam it."""
    file = {**FOUR_BAR, "links": {**FOUR_BAR["links"], "rocker": ["D", "C", 56.935]}}
    made_ = study(file, {"links.rocker[2]": {"plus_minus": 0.05}})
    assert made_.axis is not None
    found = made_.axis.evaluate({"links.rocker[2]": np.array([56.935, 56.90, 80.0])}, ["rocker.swing"])
    assert found.unsure is not None
    assert found.unsure.tolist() == [False, True, True]


@pytest.mark.slow
def test_the_closure_error_of_samples_is_that_of_all_that_was_sought() -> None:
    """Whichever quantity is asked for first; it is rounding of places up to 120 mm, and of many never all zero."""
    made_ = study(FOUR_BAR, {"links.crank[2]": {"plus_minus": 0.05}})
    assert made_.axis is not None
    columns = {"links.crank[2]": np.linspace(31.96, 32.04, 9)}
    names = ["closure_error", "rocker.swing"]
    found = [made_.axis.evaluate(columns, order).quantities["closure_error"] for order in (names, names[::-1])]
    assert found[0].tolist() == found[1].tolist()
    assert 0.0 < found[0].max() < 1e-11
    alone = made_.axis.evaluate(columns, names[:1]).quantities["closure_error"]
    assert 0.0 < alone.max() <= found[0].max()


@pytest.mark.slow
def test_the_course_of_samples_is_that_of_their_tables() -> None:
    made_ = study({**QUICK_RETURN, "outputs": ["lever"]}, {"links.crank[2]": {"plus_minus": 0.5}})
    assert made_.axis is not None
    columns, q = {"links.crank[2]": np.array([149.6, 150.2])}, np.array([0.0, 60.0, 240.0])
    off = np.degrees(made_.axis.course(columns, np.radians(q)))
    for k, crank in enumerate(columns["links.crank[2]"]):
        rows = [planar("quick-return", outputs=["lever"], links={**QUICK_RETURN["links"], "crank": ["A", "B", each]})
                .table("motion", samples=6)["lever_angle"] for each in (crank, 150.0)]  # fmt: skip
        wanted = (np.asarray(rows[0]) - np.asarray(rows[1]))[[0, 1, 4]]
        assert off[:, k] == pytest.approx(wanted, abs=1e-9)


def test_cams_are_refused() -> None:
    file = {
        "frame": {"O": [0, 0]},
        "links": {"cam": {"O": [0, 0]}, "ram": {"B": [0, 0]}},
        "slides": {"guide": {"link": "ram", "through": [0, 0], "direction": 90}},
        "cams": {"c": {"cam": "cam", "follower": "ram", "point": "B", "roller_radius": 9,
                       "motion": [{"to": 180, "lift": 9}, {"to": 360, "lift": 0}]}},
        "drive": {"link": "cam"}, "start": {"guide": 50},
    }  # fmt: skip
    with pytest.raises(NoSolution) as refused:
        study(file, {"slides.guide.through[0]": {"plus_minus": 0.05}})
    assert refused.value.key == "cams"


@pytest.mark.slow
@pytest.mark.parametrize("pin", ["B", "C"])
def test_the_play_of_a_pin_is_that_of_a_pivot_beyond_it(pin: str) -> None:
    """A hole of the coupler off the crank's pin, in the frame, moves the crank's circle as its pivot would; one of the
    rocker off the coupler's pin moves the rocker's pivot back."""
    off = 0.3 - 0.2j
    played = PlanarSamples(planar("four-bar")).design({f"pins.{pin}": off})
    a, d = (off, 120 + 15j) if pin == "B" else (0j, 120 + 15j - off)
    frame = {"A": [a.real, a.imag], "D": [d.real, d.imag]}
    moved = planar("four-bar", frame=frame)
    for name in ("rocker.angle_max", "rocker.speed_ratio_max", "rocker.jerk_ratio_min", "min_transmission_angle"):
        assert played.raw(name) == pytest.approx(moved.raw(name), rel=1e-10), name


@pytest.mark.slow
def test_samples_follow_the_keys_of_the_file_and_the_play() -> None:
    """A yield of the four-bar with a require line on its own output, twice the same."""
    tolerance = {
        "seed": 3,
        "samples": 16,
        "sources": {"links.crank[2]": {"plus_minus": 0.05}, "pins.C": {"clearance": [0.01, 0.03]}},
        "require": ["rocker.swing <= 48.5 deg"],
    }
    made_ = design("tolerance", kind="planar-mechanism", name="four", **ZOO["four-bar"], tolerance=tolerance)
    assert 0.0 < made_.raw("yield") < 1.0
    table = made_.table("contributions")
    assert {*table["source"]} == {"links.crank[2]", "pins.C"}


@pytest.mark.slow
def test_the_band_is_that_of_the_first_output() -> None:
    """Links that may be longer alone: the rocker's band over the cycle, with its nominal angle."""
    tolerance = {"seed": 3, "samples": 16, "sources": {"links.crank[2]": {"plus_minus": 0.05}}}
    made_ = design("tolerance", kind="planar-mechanism", name="four", **ZOO["four-bar"], tolerance=tolerance)
    table = made_.table("band")
    assert {*table["output"]} == {"rocker_angle"}
    nominal = planar("four-bar").table("motion", samples=120)
    assert np.asarray(table["nominal"]) == pytest.approx(np.asarray(nominal["rocker_angle"]), abs=1e-12)
