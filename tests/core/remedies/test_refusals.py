"""The fix of a refusal that names a value: put into the data of the file as printed, the design is not refused.

No tolerances: a value is a number of the file as it is printed. The second way: the words of the fix are read by the
patterns below, not by the program's own.
"""

from __future__ import annotations

import re
from typing import Any

import factory
import pytest

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.kind import FileDesigns
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.remedies.trials import with_fix
from gearlink.core.base.remedies.ways import printed
from gearlink.core.base.spec_paths import put
from gearlink.core.machines.disc_cam.measured import Series

_SET = re.compile(r"(?:set|and) ([\w.\[\]]+) (?:to at most|to at least|to|above|below|from) (-?[\d.]+(?:e[-+]?\d+)?)")
_REMOVED = re.compile(r"remove ([\w.]+)")


def asked(base: str | dict[str, Any], **keys: Any) -> FileDesigns:
    """The designs of a file's data."""
    whole = {key: value for key, value in keys.items() if "[" not in key}
    data = factory.changed(factory.worked(base) if isinstance(base, str) else base, **whole)
    for key, value in keys.items():
        if key not in whole:
            put(data, key.replace("__", "."), value)
    kind = KINDS[data["kind"]]
    return FileDesigns(kind, kind.spec_model().model_validate(data))


def refusal(command: str, base: str | dict[str, Any], **keys: Any) -> NoSolution:
    made = asked(base, **keys).of(command)
    with pytest.raises(NoSolution) as caught:
        made.report(command)
    return with_fix(made, command, caught.value)


def told(fix: str) -> dict[str, Any]:
    changes: dict[str, Any] = {key: float(value) for key, value in _SET.findall(fix)}
    changes = {key: int(value) if value == int(value) else value for key, value in changes.items()}
    changes |= dict.fromkeys(_REMOVED.findall(fix))
    return {key.replace(".", "__"): value for key, value in changes.items()}


@pytest.mark.parametrize(
    ("command", "base", "keys"),
    [
        ("analyze", "drawn_feed", {"links__frame": 20}),
        ("analyze", "crank_rocker_links", {"links__frame": 49.61}),
        ("gear", "drawn_ring", {"gears__ring": 100}),
        ("cam", "ty460", {"sync__start": 300}),
        ("cam", "ty460", {"sync__length": 700}),
        ("cam", "ty460", {"cam__transition_end": 96}),
        ("cam", "ty460", {"cam__return_angle": 300}),
        ("cam", "ty460", {"cam__lead_in": 350}),
        ("synth dwell", "candy_feed", {"gears__crank": 60}),
        pytest.param("analyze", "planar_watt", {"links__rocker__C[0]": 36.4}, marks=pytest.mark.slow),
        ("analyze", "planar_five_bar", {"links__follower[2]": 24.55}),
        ("analyze", "measured_cam", {"profile__points[83][1]": 39.3}),
        ("analyze", "mutilated_gear_press", {"gears__driven": 46}),
    ],
)
def test_the_fix_of_a_refusal_lets_the_design_be(command: str, base: str, keys: dict[str, Any]) -> None:
    """They named no value, a key of a section without it, or a value with which the next refusal came."""
    error = refusal(command, base, **keys)
    changes = told(error.fix)
    assert changes, error.fix
    report = asked(base, **(keys | changes)).of(command).report(command)
    assert report.checks


def test_what_misses_in_a_file_is_said_as_before() -> None:
    made = asked({"kind": "slider-crank", "stroke": 310, "rod": 520}).of("crank")
    error = MissingSection("`loads` needs the section loads", key="loads")
    assert with_fix(made, "crank", error) is error


@pytest.mark.parametrize("fix", ["shorten the rod", "set the centre distance to at least 40 mm", "", "omit it"])
def test_words_without_key_and_value_are_no_change(fix: str) -> None:
    assert not printed(fix)


def test_the_words_of_a_fix_are_read_as_a_user_would() -> None:
    assert printed("set a to 1 and b[0] to 2.5 and remove c.d") == (("a", 1), ("b[0]", 2.5), ("c.d", None))
    assert printed("set cam.return_law to modified-sine") == (("cam.return_law", "modified-sine"),)
    assert printed("set arm to at most 1e-3 mm, or omit it") == (("arm", 1e-3),)
    assert printed("remove a and remove b.c") == (("a", None), ("b.c", None))


@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("pressure-angle", {"cam__return_angle": 0.01}),
        ("pressure-angle", {"sync__start": 200}),
        ("sync-length", {"sync__start": 300}),
        ("sync-length", {"sync__length": 700}),
    ],
)
def test_a_press_whose_cam_jams_or_whose_bed_reverses_names_a_value(name: str, keys: dict[str, Any]) -> None:
    """They told to allow a larger pressure angle, and to reduce the zone."""
    failing = [each for each in asked("ty460", **keys).of("press").findings("press", name) if each.status == "fail"]
    failing += [each for each in asked("ty460", **keys).of("cam").findings("cam", name) if each.status == "fail"]
    assert failing
    for check in failing:
        after = asked("ty460", **(keys | told(str(check.fix))))
        assert all(each.status != "fail" for each in after.of("cam").findings("cam", name)), check.fix
        assert all(each.status != "fail" for each in after.of("press").findings("press", name)), check.fix


_ROLLERS = {
    "kind": "disc-cam",
    "closure": "conjugate",
    "motion": [{"to": 90, "lift": 30}, {"to": 180}, {"to": 270, "lift": 0}, {"to": 360}],
    "follower": {"type": "translating-roller", "roller_radius": 8},
    "cam": {"prime_radius": 50},
    "return_roller": {"distance": 20, "radius": 8},
}


def test_rollers_too_near_for_the_return_cam_name_a_distance() -> None:
    """They told to increase return_roller.distance; twice the start height and both lifts is that of equal cams."""
    (check,) = asked(_ROLLERS).of("cam").findings("cam", "constant-sum")
    assert check.status == "fail"
    assert check.remedy == (("return_roller.distance", None),)
    bound = float(re.findall(r"above ([\d.]+)", check.advice)[0])
    assert bound == 50.0 + 30.0
    for distance, status in ((bound - 0.1, "fail"), (2.0 * 50.0 + 30.0, "pass")):
        (after,) = asked(_ROLLERS, return_roller__distance=distance).of("cam").check("constant-sum")
        assert after.status == status


@pytest.mark.parametrize("keys", [{"cam__return_roller__angle": 110}, {"cam__roller__arm": 260}])
def test_a_cam_beside_the_axis_of_its_rocker_names_a_value(keys: dict[str, Any]) -> None:
    """They told to move pivots.input, with which the cams grow as far as the axis moves."""
    warned = [
        each for each in asked("swing_gripper", **keys).of("cam").findings("cam", "shaft-clearance") if each.remedy
    ]
    assert warned
    for check in warned:
        after = asked("swing_gripper", **(keys | told(str(check.fix)))).of("cam")
        assert all(each.status == "pass" for each in after.check("shaft-clearance")), check.fix


def test_an_axis_that_no_key_clears_is_left_to_the_planes() -> None:
    """The file knows no planes along the shafts: nothing in it says that one ends before another."""
    keys = {"pivots__output": [217.5, 55]}
    for check in asked("swing_gripper", **keys).of("cam").findings("cam", "shaft-clearance"):
        assert check.remedy or check.status == "pass" or "before the plane of the" in check.advice


def test_what_a_tried_change_divides_by_is_not_told() -> None:
    """A cam that is tried has a corner where its roller rolls on nothing; a warning is an error here."""
    error = refusal("cam", "loaded_cam", follower__roller_radius=150)
    assert told(error.fix) == {"cam__prime_radius": 150}


def test_a_cam_that_takes_long_to_judge_is_tried_few_times(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every number of the file was tried in both senses: 40 s."""
    fitted: list[int] = []
    before = Series.fitted

    def counted(*arguments: Any) -> Series:
        fitted.append(1)
        return before(*arguments)

    monkeypatch.setattr(Series, "fitted", counted)
    refusal("analyze", "measured_cam", **{"profile__points[31][1]": 3.8e7})
    assert len(fitted) <= 12
