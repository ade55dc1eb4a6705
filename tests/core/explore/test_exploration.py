"""Studies against the plain way: every design by its class in a loop, the front by all pairs.

Indices and counts are exact; figures of the front are the design class's own.
"""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.codes import rules
from gearlink.core.base.design_axis import Findings
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check, Rule, Status
from gearlink.core.studies.explore import front
from gearlink.core.studies.explore.base import single
from gearlink.core.studies.explore.chunks import _of_code
from gearlink.core.studies.explore.exploration import Exploration
from gearlink.core.studies.study.faults import BrokenPromise, WrongStudy
from gearlink.core.studies.study.spec import StudySpec

CASES = {c["name"]: c for c in json.loads((Path(__file__).parents[2] / "reference" / "explore.json").read_text())}
FEED = {
    "kind": "three-gear-four-bar",
    "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40},
    "dwell": {"angle": 135},
}


def study(**keys: Any) -> Exploration:
    data = {"kind": "study", "design": FEED, **keys}
    return Exploration(StudySpec.model_validate_json(json.dumps(data)))


def small(name: str) -> Exploration:
    given = CASES[name]["input"]
    crank, idler = given["crank"], given["idler_ratio"]
    return study(
        variables={
            "gears.crank": {"from": crank[0], "to": crank[1], "step": 1, "also": ["gears.output"]},
            "gears.idler": {"from": idler[0], "to": idler[1], "times": "gears.crank"},
            "gears.module": {"values": given["modules"]},
            "dwell.angle": {"values": given["angles"]},
        },
        define={"envelope": "frame_length + crank_length + crank_idler.tip_radius[1]"},
        minimize=dict(
            zip(
                ("envelope", "back_step_angle", "speed_ratio_max"),
                (given["resolution"][i] for i in (0, 2, 3)),
                strict=True,
            )
        ),
        maximize={"min_transmission_angle": given["resolution"][1]},
    )


def test_points_of_a_range_are_evenly_spaced_or_in_equal_ratios() -> None:
    ranges = {
        "gears.idler": {"from": 60, "to": 72, "points": 5},
        "dwell.angle": {"from": 90, "to": 100, "points": 5},
        "gears.module": {"from": 1, "to": 4, "points": 3, "log": True},
    }
    found = [variable.values for variable in study(variables=ranges, minimize={"frame_length": 0.1}).problem.variables]
    assert found[0] == (60, 63, 66, 69, 72)
    assert found[1] == pytest.approx((90.0, 92.5, 95.0, 97.5, 100.0), rel=1e-15)
    assert found[2] == pytest.approx((1.0, 2.0, 4.0), rel=1e-15)


@pytest.mark.parametrize("warn_counts", [False, True])
def test_of_several_findings_of_a_code_the_failing_one_nearest_to_its_limit_is_told(warn_counts: bool) -> None:
    """By hand: a design that passes, one with a single failure, two that fail, and one that only warns."""
    yes, no = True, False
    first = ([5.0, 3.0, 30.0, -9.0], [yes, yes, yes, no], [no, no, no, yes])
    second = ([8.0, 8.0, 38.0, 8.0], [no, no, yes, no], [no, no, no, no])
    found = SimpleNamespace(
        findings=[
            Findings("GL303", np.array(value), np.full(4, limit), np.array(fails), np.array(warns), "deg")
            for (value, fails, warns), limit in ((first, -4.0), (second, 40.0))
        ]
    )
    fails, (value, limit, unit) = _of_code("GL303", found, warn_counts=warn_counts, count=4)
    assert fails.tolist() == [True, True, True, warn_counts]
    last = (-9.0, -4.0) if warn_counts else (math.nan, math.nan)
    assert unit == "deg"
    np.testing.assert_array_equal(value, [5.0, 3.0, 38.0, last[0]])
    np.testing.assert_array_equal(limit, [-4.0, -4.0, 40.0, last[1]])


def test_study_of_record() -> None:
    want, found = CASES["dwell-study-small"]["expected"], small("dwell-study-small")
    assert (found.designs, found.refused, found.feasible) == (want["designs"], want["refused"], want["feasible"])
    assert found.front_size == want["front"]
    rows = found.table("front").rows()
    assert [row[0] for row in rows] == [row[0] for row in want["kept"]]
    why = {row[1]: row for row in found.table("why").rows()}
    for code, count in want["failing"].items():
        assert why[code][2] == count
        assert why[code][3] == want["failing_alone"][code]


def plain_way(conditions: Any) -> tuple[list[int], int, int]:
    """Indices of the exact front, how many satisfy everything, how many are refused; unequal gears among them."""
    rows, refused = [], 0
    teeth = itertools.product(range(18, 27, 2), range(18, 27, 2), (20, 30, 44), (60.0, 150.0, 179.0))
    for index, (crank, output, idler, angle) in enumerate(teeth):
        made = factory.design(
            FEED,
            command="synth dwell",
            gears__crank=crank,
            gears__output=output,
            gears__idler=idler,
            dwell__angle=angle,
        )
        try:
            values = [made.quantity(name).value for name in ("frame_length", "min_transmission_angle", "gear_gap")]
        except NoSolution:
            refused += 1
            continue
        checks = [c for name in made.outline("synth dwell").checks for c in made.check(name)]
        if all(check.status != "fail" for check in checks) and conditions(values):
            rows.append((index, round(values[0] / 1e-6), round(-values[1] / 1e-7)))
    front = [i for i, f, m in rows if not any(g <= f and n <= m and (g < f or n < m) for _, g, n in rows)]
    return front, len(rows), refused


def test_refusals_conditions_and_checks_against_the_plain_way() -> None:
    found = study(
        variables={
            "gears.crank": {"from": 18, "to": 26, "step": 2},
            "gears.output": {"from": 18, "to": 26, "step": 2},
            "gears.idler": {"values": [20, 30, 44]},
            "dwell.angle": {"values": [60.0, 150.0, 179.0]},
        },
        minimize={"frame_length": "1 mm"},
        maximize={"min_transmission_angle": 0.1},
        where=["gear_gap >= 1 mm"],
        checks={"must_pass": "all"},
    )
    front, feasible, refused = plain_way(lambda values: values[2] >= 1.0)
    assert (found.front_size, found.feasible, found.refused) == (len(front), feasible, refused)
    assert {row.index for row in found.found.rows} <= set(front)
    why = {row[0]: row for row in found.table("why").rows()}
    assert why["refused gears.output"][2] == refused == 180
    gap = why["gear_gap >= 1 mm"]
    assert gap[4] < gap[5] == 1.0


def test_one_objective_is_a_ranking() -> None:
    found = study(
        variables={"gears.idler": {"from": 40, "to": 120}},
        minimize={"frame_length": "0.5 mm"},
        checks={"must_pass": "none"},
    )
    rows = found.table("front").rows()
    assert found.front_size == 1
    assert [row[1] for row in rows] == list(range(40, 90))  # each idler its own box, 50 of them
    assert found.knee is None


def test_absent_objective_is_a_refusal_and_an_absent_condition_does_not_hold() -> None:
    base = {**FEED, "speed": {"min": 100, "max": 300}}
    keys: dict[str, Any] = {
        "design": base,
        "command": "synth variable-speed",
        "variables": {"speed.min": {"values": [50, 100]}},
    }
    found = study(**keys, minimize={"back_step_angle": 1})
    assert (found.refused, found.feasible) == (2, 0)
    assert [row[0] for row in found.table("why").rows()][-1] == "refused no back_step_angle"
    assert not found.report("explore").ok
    found = study(**keys, minimize={"frame_length": 1}, where=["back_step_angle <= 5"])
    assert (found.refused, found.feasible) == (0, 0)


def test_words_are_conditions_and_quantities_of_other_commands_serve() -> None:
    found = study(
        variables={"dwell.angle": {"values": [60, 135]}},
        minimize={"acceleration_ratio_max": 0.01},
        where=["motion == back-step", "crank_teeth == 40", "idler_output.contact_ratio > 1.5"],
    )
    assert (found.feasible, found.front_size) == (2, 1)


def test_a_range_of_one_value_is_one_design() -> None:
    found = study(variables={"gears.module": {"from": 2.5, "to": 2.5}}, minimize={"frame_length": 1})
    assert (found.designs, found.exhaustive) == (1, True)
    assert [check.status for check in found.report("explore").checks] == ["pass"]


@pytest.mark.quick(12)
@pytest.mark.parametrize(
    ("keys", "code", "place"),
    [
        ({"variables": {"gears.cranc": {"values": [1]}}}, "GL151", ("variables", "gears.cranc")),
        (
            {"variables": {"gears.idler": {"from": 1, "to": 2, "times": "x"}}},
            "GL151",
            ("variables", "gears.idler", "times"),
        ),
        ({"variables": {"gears.idler": {"from": 0, "to": 2}}}, "GL156", ("variables", "gears.idler", "from")),
        ({"variables": {"gears.i3": {"values": [-2.0]}}}, "GL156", ("variables", "gears.i3", "values")),
        ({"variables": {"gears.idler": {"from": 30.2, "to": 30.8}}}, "GL111", ("variables", "gears.idler")),
        ({"minimize": {"frame": 1}}, "GL152", ("minimize", "frame")),
        ({"minimize": {"dwell_crank_angles": 1}}, "GL152", ("minimize", "dwell_crank_angles")),
        ({"minimize": {"frame_length": "1 deg"}}, "GL153", ("minimize", "frame_length")),
        ({"minimize": {"frame_length": "wide"}}, "GL154", ("minimize", "frame_length")),
        ({"where": ["i3 == -1.8"]}, "GL152", ("where", 0)),
        ({"where": ["frame_length[0] > 9 mm"]}, "GL152", ("where", 0)),
        ({"where": ["motion[0] == back-step"]}, "GL152", ("where", 0)),
        ({"minimize": {"frame_length[1]": 1}}, "GL152", ("minimize", "frame_length[1]")),
        ({"where": ["motion >= back-step"]}, "GL152", ("where", 0)),
        ({"where": ["frame_length > 9", "frame_length < 9"]}, "GL111", ("where", 1)),
        ({"checks": {"must_pass": ["GL400"]}}, "GL152", ("checks", "must_pass", 0)),
        ({"define": {"frame_length": "2"}}, "GL152", ("define", "frame_length")),
        ({"define": {"x": "1 + *"}, "minimize": {"x": 1}, "where": ["x > 0"]}, "GL152", ("define", "x")),
        ({"define": {"x": "y", "y": "1"}}, "GL152", ("define", "x")),
        ({"define": {"x": "x + i3"}}, "GL152", ("define", "x")),
        (
            {"define": {"x0": "i3", **{f"x{i}": f"x{i - 1} + x{i - 1}" for i in range(1, 40)}}},
            "GL152",
            ("define", "x8"),
        ),
        ({"define": {"x0": "i3", **{f"x{i}": f"x{i - 1} + 1" for i in range(1, 400)}}}, "GL152", ("define", "x251")),
        ({"define": {"x": "+".join("1" * 400)}}, "GL152", ("define", "x")),
        ({"where": ["40 <= min_transmission_angle <= 50"]}, "GL152", ("where", 0)),
        ({"where": ["40 deg <= min_transmission_angle"]}, "GL152", ("where", 0)),
        ({"command": "press"}, "GL113", ("command",)),
        ({"design": {**FEED, "dwell": {"angle": 359}}}, "GL156", ("design", "dwell", "angle")),
        ({"sampling": {"method": "grid", "budget": 40}}, "GL155", ("sampling", "budget")),
        (
            {"sampling": {"method": "grid"}, "variables": {"dwell.angle": {"from": 90, "to": 100}}},
            "GL155",
            ("variables", "dwell.angle"),
        ),
    ],
)
def test_wrong_studies(keys: dict[str, Any], code: str, place: tuple[Any, ...]) -> None:
    plain = {"variables": {"gears.idler": {"from": 40, "to": 90}}, "minimize": {"frame_length": 1}}
    with pytest.raises(WrongStudy) as caught:
        study(**{**plain, **keys}).report("explore")
    assert [(fault.code, fault.place) for fault in caught.value.faults] == [(code, place)]


def test_definitions_of_many_operations_are_computed() -> None:
    made = study(
        variables={"gears.idler": {"values": [40, 50]}},
        define={"x0": "i3", **{f"x{i}": f"x{i - 1} + 1" for i in range(1, 251)}, "y": "+".join(["i3"] * 250)},
        minimize={"x250": 1e-3},
        maximize={"y": 1e-3},
        checks={"must_pass": "none"},
    )
    table = made.report("explore").tables[0]
    assert sorted(table["x250"]) == [pytest.approx(250.0 - z / 40.0, rel=1e-12) for z in (50, 40)]
    assert sorted(table["y"]) == [pytest.approx(-250.0 * z / 40.0, rel=1e-12) for z in (50, 40)]


@pytest.mark.parametrize(
    ("where", "helps"),
    [
        ("40 deg <= min_transmission_angle", "write min_transmission_angle >= 40 deg"),
        ("1 < i3 < 2", "write two lines, each with the quantity on its left"),
    ],
)
def test_conditions_that_are_written_in_another_way(where: str, helps: str) -> None:
    with pytest.raises(WrongStudy) as caught:
        study(variables={"gears.idler": {"values": [40]}}, minimize={"i3": 1}, where=[where]).report("explore")
    assert caught.value.faults[0].help == helps


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("base", "command", "path", "values", "code"),
    [
        ("ty460", "press", "cylinder.initial_crank_angle", [50.0, 57.109], "GL401"),
        ("ty460", "analyze", "cam.shaft_radius", [30.0, 80.0], "GL302"),
        ("swing_gripper", "gripper", "cam.roller.radius", [30.0, 90.0], "GL302"),
        ("wide_swing_twin_cam", "swing", "cam.shaft_radius", [25.0, 120.0], "GL302"),
    ],
)
def test_what_a_section_makes_a_command_judge_is_asked(
    base: str, command: str, path: str, values: list[float], code: str
) -> None:
    """Cams that one of two designs cannot have: the command itself fails that one."""
    data = factory.worked(base)
    found = study(
        design=data, command=command, variables={path: {"values": values}}, minimize={_PLAIN[data["kind"]]: 1e-6}
    )
    good = [
        i
        for i, value in enumerate(values)
        if all(
            check.status != "fail"
            for made in [factory.design(data, command=command, **{path.replace(".", "__"): value})]
            for name in made.outline(command).checks
            for check in made.check(name)
        )
    ]
    assert len(good) == 1
    assert [row.index for row in found.found.rows] == good
    assert {row[1]: row[2] for row in found.table("why").rows()}[code] == 1


_PLAIN = {"flatbed-press": "crank_length", "swing-gripper": "total_swing", "wide-swing-cam": "velocity_peak"}


@pytest.mark.parametrize(
    ("other", "words"),
    [
        ({"gears.idler": 74}, "has frame_length"),
        ({"dwell.angle": 359.9}, "is refused"),
    ],
)
def test_a_design_that_its_own_class_sees_otherwise_is_a_fault_of_the_program(
    monkeypatch: pytest.MonkeyPatch, other: dict[str, Any], words: str
) -> None:
    """Here the class is asked about another design than the search found."""
    found = study(
        variables={"gears.idler": {"values": [72]}}, minimize={"frame_length": "1 mm"}, checks={"must_pass": "none"}
    )
    monkeypatch.setattr(front, "single", lambda base, _, *asked: single(base, [*other.items()], *asked))
    with pytest.raises(BrokenPromise, match=f"GL160: design 0 {words}"):
        _ = found.found.rows


def test_a_range_that_ends_with_its_key_is_not_to_be_extended() -> None:
    """No shaft is thinner than 0 mm; one of 5 mm can be, and a gear can have fewer teeth, or more."""
    cam, pair = factory.worked("lift_cam"), factory.worked("gear_pair")
    for low, told in ((0, 0), (5, 1)):
        shaft = {"cam.shaft_radius": {"from": low, "to": 10, "step": 5}}
        thin = study(
            design=cam, command="cam", variables=shaft, minimize={"max_radius": 0.1}, checks={"must_pass": "none"}
        )
        assert len(list(thin.check("range-end"))) == told
    teeth = {"teeth[1]": {"from": 60, "to": 62, "step": 1}}
    few = study(design=pair, command="gear", variables=teeth, minimize={"reference_center_distance": 0.1})
    assert any("teeth[1] at the lower end" in check.message for check in few.check("range-end"))


def test_what_the_base_fails_is_said_to_be_left_out() -> None:
    """A base whose gears collide asks no design to keep its gears apart, and does not say that all is well."""
    base = factory.worked("thesis_example_3_as_printed")
    keys: dict[str, Any] = {"variables": {"links.crank": {"values": [16.0, 18.0]}}, "minimize": {"frame_length": 0.1}}
    left, asked = study(design=base, **keys), study(design=base, checks={"must_pass": "all"}, **keys)
    assert (left.feasible, left.problem.waived) == (2, ("GL301",))
    assert "everything but GL301, which the base fails" in left.check("feasible-designs")[0].message
    assert (asked.feasible, asked.problem.asked) == (1, "everything")


_NEW_CHECKS = {
    "three-gear-four-bar": (
        {"design": FEED, "command": "synth dwell", "variables": {"gears.idler": {"from": 60, "to": 90}}},
        "frame_length",
    ),
    "gear-pair": (
        {
            "design": {"kind": "gear-pair", "module": 2, "teeth": [20, 40], "profile_shift": [0.2, 0.1]},
            "command": "gear",
            "variables": {"teeth[1]": {"from": 40, "to": 60}},
        },
        "center_distance",
    ),
    "slider-crank": (
        {
            "design": {"kind": "slider-crank", "stroke": 300, "rod": 500},
            "command": "crank",
            "variables": {"stroke": {"from": 200, "to": 300, "step": 10}},
        },
        "crank_length",
    ),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("code", ["GL399", "GL303"])
@pytest.mark.parametrize("kind", _NEW_CHECKS)
def test_a_check_that_no_array_form_knows_is_judged_by_the_class(
    kind: str, code: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A check new to the class, under a code of its own or beside others under one; the plain way is the other one."""
    keys, quantity = _NEW_CHECKS[kind]
    made = study(minimize={quantity: 1e-6}, **keys).problem
    values = [single(made.base, made.changes_of(i), [quantity], ()).values[quantity] for i in range(made.order.count)]
    limit = sorted(values)[len(values) // 2]
    assert made.axis is not None, "else the test tests nothing"
    rule = rules().get(code, Rule(code, "new", "", "", ""))
    rule = rule._replace(checks=(*rule.checks, "new"))

    command, owner = made.base.command, type(made.base.design())
    outline, check = owner.outlines[command], owner.check

    def with_new(design: Any, name: str) -> list[Check]:
        value = getattr(design, quantity)
        status: Status = "pass" if value >= limit else "fail"
        return [rule.check(status, "", value, limit, "mm", name=name)] if name == "new" else check(design, name)

    monkeypatch.setitem(rules(), code, rule)
    monkeypatch.setattr(owner, "check", with_new)
    new = outline._replace(checks=(*outline.checks, "new"))
    monkeypatch.setattr(owner, "outlines", {**owner.outlines, command: new})
    found = study(minimize={quantity: 1e-6}, checks={"must_pass": "all"}, **keys)
    assert found.problem.axis is None
    assert found.feasible == sum(value >= limit for value in values)
    assert found.found.rows[0].figures[0] == limit


@pytest.mark.parametrize(
    ("keys", "place", "message", "helps"),
    [
        (
            {"define": {"x": "i3 + crank_idler.tip_radius[7]", "y": "2 * x"}, "minimize": {"y": 1}},
            ("define", "x"),
            "crank_idler.tip_radius is a list of 2: it has no crank_idler.tip_radius[7]",
            "counted from 0: [0] crank, [1] idler",
        ),
        (
            {"define": {"x": "i3 + crank_idler.tip_radius[7]", "y": "i3"}, "minimize": {"y": 1}},
            ("define", "x"),
            "crank_idler.tip_radius is a list of 2: it has no crank_idler.tip_radius[7]",
            "counted from 0: [0] crank, [1] idler",
        ),
        (
            {"where": ["idler_output.tip_radius[2] > 9"]},
            ("where", 0),
            "idler_output.tip_radius is a list of 2: it has no idler_output.tip_radius[2]",
            "counted from 0: [0] idler, [1] output",
        ),
        (
            {"maximize": {"mesh_13.tip_radius[2]": 1}},
            ("maximize", "mesh_13.tip_radius[2]"),
            "no quantity 'mesh_13.tip_radius[2]' of this kind of design",
            "nearest: ",
        ),
        (
            {"define": {"x": "crank_idler.tip_radius"}, "minimize": {"x": 1}},
            ("define", "x"),
            "crank_idler.tip_radius is a list of 2",
            "use one of them, crank_idler.tip_radius[0]; counted from 0: [0] crank, [1] idler",
        ),
        (
            {"define": {"x": "frame_length[0]"}, "minimize": {"x": 1}},
            ("define", "x"),
            "frame_length is not a list: it has no entry 0",
            "use frame_length",
        ),
        (
            {"where": ["crank_idler.tip_radius[-1] > 9"]},
            ("where", 0),
            "'crank_idler.tip_radius[-1]' cannot be read: "
            "an index is a whole number counted from 0, as in tip_radius[0]",
            "",
        ),
    ],
)
def test_an_entry_that_no_design_has_is_refused_at_once(
    keys: dict[str, Any], place: tuple[Any, ...], message: str, helps: str
) -> None:
    """Computed to the end, all designs were told to be without a mechanism."""
    plain = {"variables": {"gears.idler": {"from": 40, "to": 90}}, "minimize": {"frame_length": 1}}
    with pytest.raises(WrongStudy) as caught:
        _ = study(**{**plain, **keys}).problem
    ((found,)) = caught.value.faults
    assert (found.code, found.place, found.message) == ("GL152", place, message)
    assert found.help.startswith(helps)


def test_an_entry_that_other_designs_have_is_taken() -> None:
    """The base steps back and stands still twice where others of the study do so but once, or never."""
    base = {k: v for k, v in FEED.items() if k != "dwell"} | {"links": {"crank": 38.857, "frame": 153.552}}
    variables = {"links.crank": {"from": 10, "to": 38, "step": 7}}
    never = {**base, "links": {"crank": 10, "frame": 153.552}}
    for design in (base, never):
        found = study(
            design=design,
            command="analyze",
            variables=variables,
            minimize={"dwell_crank_angles[1]": 1},
            checks={"must_pass": "none"},
        )
        assert found.designs == 5


FIVE_BAR: dict[str, Any] = {
    "kind": "geared-five-bar",
    "gears": {"module": 2.5, "input": 20, "output": 20},
    "links": {"input": 20, "coupler": 60, "follower": 60, "output": 20, "frame": 50},
    "phase": 90,
    "coupler_point": {"along": 60},
    "limits": {"transmission_angle": 0},
}


@pytest.mark.parametrize(("entry", "exists"), [(1, True), (2, False)])
def test_an_entry_that_only_the_variables_bring_is_taken(entry: int, exists: bool) -> None:
    """With an idler the five-bar has a second mesh; without one, as in the base, its frame is another."""
    keys: dict[str, Any] = {
        "design": FIVE_BAR,
        "command": "analyze",
        "variables": {"gears.idler": {"values": [18]}, "links.frame": {"values": [80]}},
        "maximize": {f"contact_ratio[{entry}]": 0.1},
    }
    if exists:
        assert study(**keys).feasible == 1
    else:
        with pytest.raises(WrongStudy, match="is a list of 2"):
            _ = study(**keys).problem
