"""Remedies where trials are few: what does not bear on a finding is left, what leads to its limit comes first.

No tolerances: a remedy is put into the data of the file, which is read anew, and its check passes.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import pytest
from oracles.random_designs import draw

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import Standing, modules, steps_to_limit
from gearlink.core.base.report import Check, Remedy
from gearlink.core.machines.five_bar import fit as five_bar_fit
from gearlink.core.machines.flatbed_press import zone


def path_of(key: str) -> str:
    return key.replace(".", "__")


def failing(made: Any, command: str, name: str) -> list[Check]:
    return [check for check in made.findings(command, name) if check.status == "fail"]


def repaired(worked: str, remedy: Remedy, name: str, command: str, **keys: Any) -> bool:
    """Whether a check passes after a remedy, and nothing of its command fails."""
    after = factory.design(worked, command=command, **{**keys, **{path_of(key): value for key, value in remedy}})
    after.require(command)
    return all(check.status != "fail" for each in (name, *after.outline(command).checks) for check in after.check(each))


def test_modules_are_those_of_the_series() -> None:
    more, less = modules("gears.module")
    assert more.remedy([2.0], 1) == (("gears.module", 2.5),)
    assert more.remedy([2.1], 2) == (("gears.module", 3.0),)
    assert less.remedy([2.0], 3) == (("gears.module", 1.0),)
    assert more.most([2.0]) == len((2.5, 3.0, 4.0, 5.0, 6.0, 8.0))
    assert more.remedy([2.0], 7) == ()
    assert more.remedy([20.0], more.most([20.0])) == ()


class OneNumber:
    """A design that judges the number it has, below 40."""

    def __init__(self, value: float | None) -> None:
        self.value = value

    def check(self, name: str) -> list[Check]:
        return [Check("GL303", name, "fail", "", self.value, 40.0, "deg")]


@pytest.mark.parametrize(("then", "steps"), [(32.0, 5.0), (28.0, -5.0), (30.0, math.inf), (None, None)])
def test_steps_to_the_limit(then: float | None, steps: float | None) -> None:
    before, now = Standing(OneNumber(30.0)), Standing(OneNumber(then))  # type: ignore[arg-type]
    for each in (before, now):
        each.ranks("any")
    assert steps_to_limit(before, now, "any", 0) == steps


def test_the_chain_that_fails_is_changed() -> None:
    """Links of the other chain, which come first, do not bear on it: none of the few trials is lost on them."""
    keys = {"cylinder__double_crank__frame": 52}
    (check,) = failing(factory.design("ty460", command="press", **keys), "press", "transmission-angle")
    assert check.remedy[0][0].startswith("cylinder.")
    assert repaired("ty460", check.remedy, "transmission-angle", "press", **keys)


@pytest.mark.slow
def test_the_input_gears_of_a_press_are_repaired() -> None:
    keys = {"input_gears__pressure_angle": 42}
    (check, *_) = failing(factory.design("ty460", command="gear", **keys), "gear", "tip-thickness")
    assert check.remedy[0][0].startswith("input_gears.")
    assert repaired("ty460", check.remedy, "tip-thickness", "gear", **keys)


def test_findings_that_one_width_repairs_name_the_same() -> None:
    """By itself each would name the least that it needs: 10 mm for the flanks, 12 for the roots."""
    keys = {"face_width": 6}
    made = factory.design("gear_pair", command="gear", **keys)
    found = [check for name in ("pitting", "bending") for check in failing(made, "gear", name)]
    assert len(found) == 4
    assert len({check.remedy for check in found}) == 1
    assert repaired("gear_pair", found[0].remedy, "pitting", "gear", **keys)


@pytest.mark.slow
def test_a_transition_before_the_end_of_its_zone() -> None:
    """Behind it alone where the cams bear that, or with the base radius that they need."""
    for keys, changed in (
        ({"cam__transition_end": 60}, ["cam.transition_end"]),
        ({"sync__length": 522.07, "sync__start": 12.13}, ["cam.transition_end", "cam.base_radius"]),
    ):
        (check,) = failing(factory.design("ty460", command="press", **keys), "press", "pressure-angle")
        assert [key for key, _ in check.remedy] == changed
        assert repaired("ty460", check.remedy, "pressure-angle", "press", **keys)


@pytest.mark.slow
def test_given_links_are_repaired_though_a_function_is_asked_for() -> None:
    """Nothing is searched there that a trial would have to wait for."""
    keys = {"gears__planet": 13}
    (check,) = failing(factory.design("five_bar_function_tolerances", **keys), "analyze", "undercut")
    assert check.remedy
    after = factory.design("five_bar_function_tolerances", **{path_of(key): value for key, value in check.remedy})
    assert not failing(after, "analyze", "undercut")


@pytest.mark.slow
def test_a_six_bar_is_repaired_along_the_ways_that_lead_to_the_limit() -> None:
    data = {
        "kind": "geared-six-bar",
        "links": {"frame": 150, "coupler_1": 60, "coupler_2": 143.8, "coupler_3": 90},
        "trains": [
            {"pins": ["A", "B"], "gears": [20, 20], "module": 2},
            {"pins": ["E", "F"], "gears": [-60, 20], "module": 2},
        ],
        "start": {"coupler_1": 120, "output": 90},
    }
    (check,) = failing(factory.design(data), "analyze", "transmission-angle")
    assert check.remedy


@pytest.mark.slow
def test_loads_of_many_turns_are_not_followed_for_a_remedy() -> None:
    """Ten turns with friction take more than a second for each change that is tried."""
    keys = {"links__coupler_2": 201, "links__coupler_1": 30}
    trains = factory.worked("loaded_six_bar")["trains"]
    trains[0]["gears"][0], trains[1]["gears"][0], trains[1]["gears"][1] = 14, 42, 31
    made = factory.design("loaded_six_bar", trains=trains, **keys)
    assert made.period_turns > 4
    bench = made.bench("analyze")
    for name in ("transmission-angle", "undercut"):
        failing(made, "analyze", name)
    assert all("machine" not in vars(each.design) for each in bench._others.values() if each.design is not None)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("worked", "command", "name", "keys"),
    [
        ("wide_lever", "analyze", "transmission-angle", {"gears__coupler": 16, "links__frame": 90}),
        pytest.param(
            *("swing_gripper", "gripper", "shaft-clearance"),
            {"cam__center": [30, -30], "cam__return_roller__radius": 100.0, "cam__shaft_radius": 40},
            marks=pytest.mark.slow,
        ),
        pytest.param(
            *("wide_swing_slider_cam", "swing", "pressure-angle", {"slider__middle_angle": 55}),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_few_trials_that_lead_to_the_limit_suffice(worked: str, command: str, name: str, keys: dict[str, Any]) -> None:
    """A crank that is sought for its swing, rollers of a gripper, the arm of a slider."""
    (check,) = failing(factory.design(worked, command=command, **keys), command, name)
    assert check.remedy
    after = factory.design(worked, command=command, **{**keys, **{path_of(key): value for key, value in check.remedy}})
    after.require(command)
    assert all(found.status != "fail" for found in after.check(name))


def test_what_is_tried_seeks_no_advice(monkeypatch: pytest.MonkeyPatch) -> None:
    """The shift of the crank with which bed and cylinder meet takes as long as twenty trials: that of the file is."""
    sought: list[Any] = []
    monkeypatch.setattr(zone, "_shift_that_helps", lambda _, cylinder, __: sought.append(cylinder.gear_ratio) or "")
    made = factory.design("ty460", command="press", cylinder__gear_ratio=1.4)
    (check,) = failing(made, "press", "register")
    assert check.remedy == (("cylinder.gear_ratio", 1.0),), "of two turns bed and cylinder never meet: tried in vain"
    assert set(sought) <= {1.4}


def test_links_for_points_with_times_are_not_sought_for_a_remedy(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each search takes tenths of a second, and a gear of one tooth fails five checks: seconds in all."""
    sought: list[Any] = []
    fit = five_bar_fit.fit_timed
    monkeypatch.setattr(five_bar_fit, "fit_timed", lambda *given: sought.append(given) or fit(*given))
    made = factory.design("five_bar_timed_points", command="gear", gears__output=1)
    assert failing(made, "gear", "undercut")
    assert len(sought) <= 1


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "count"), [("gear_pair", 3), pytest.param("six_bar", 20, marks=pytest.mark.slow)])
def test_a_remedy_does_not_depend_on_other_findings(kind: str, count: int) -> None:
    """Trials that are known from another finding count as those that are not."""
    for data, command in draw(kind, 77, count):
        try:
            made = factory.design(data, command=command)
            made.require(command)
        except (ValueError, NoSolution):
            continue
        for name in made.outline(command).checks:
            in_order = [check.remedy for check in made.findings(command, name)]
            alone = factory.design(data, command=command)
            alone.require(command)
            assert in_order == [check.remedy for check in alone.findings(command, name)], (data, name)


def test_an_idler_that_the_synthesis_chose_may_have_more_teeth_for_its_ring() -> None:
    """Each other change is a search for the idler, of which only two are tried."""
    data: dict[str, Any] = {
        "kind": "three-gear-four-bar",
        "gears": {"module": 2, "crank": 20, "output": -60},
        "dwell": {"tolerance": 0.5},
    }
    made = factory.design(data, command="synth dwell")
    (check,) = failing(made, "synth dwell", "involute-interference")
    ((key, teeth),) = check.remedy
    assert key == "gears.idler"
    assert made.idler_teeth < teeth < made.idler_teeth + 6
    data["gears"]["idler"] = teeth
    assert not failing(factory.design(data, command="synth dwell"), "synth dwell", "involute-interference")
