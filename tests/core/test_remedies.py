"""Every remedy put into the design file as it is given: the check passes, no other one breaks.

No tolerances: a remedy is whole teeth, tenths of a millimetre, hundredths of a profile shift or half degrees, and what
it gives is a status. The second way: the remedies are written into the data of the file and the file is read anew.
"""

from __future__ import annotations

import copy
import re
from typing import Any

import factory
import pytest
from oracles.random_designs import KINDS as DRAWN
from oracles.random_designs import Data, draw

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kind import FileDesigns
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.remedies.ways import down, left_out, shared, up
from gearlink.core.base.report import Check, Remedy, remedy_words
from gearlink.core.base.spec_paths import changed, numbers_at, step_of, value_at

SLOW_KINDS = ("five_bar", "hypocycloid", "six_bar")
"""Much that is wrong with them no single key repairs, and each trial follows a whole motion."""
Failing = dict[str, list[bool]]
"""The findings of each check, whether they fail."""


def with_values(data: Data, remedy: Remedy) -> Data:
    """The data of a design file after a remedy; a key that is left out is deleted."""
    repaired = copy.deepcopy(data)
    for path, value in remedy:
        *sections, last = [int(s) if s.isdecimal() else s for s in re.findall(r"[^.\[\]]+", path)]
        place: Any = repaired
        for section in sections:
            place = place[section]
        assert value is not None or last in place
        if value is None:
            del place[last]
        else:
            place[last] = list(value) if isinstance(value, tuple) else value  # as a file has it
    return repaired


def design(data: Data, command: str) -> Any:
    """The design of the data of a file."""
    kind = KINDS[data["kind"]]
    return kind.design(command, kind.spec_model().model_validate(data))


def failing(data: Data, command: str) -> Failing | None:
    """Which findings of each check of a file fail; None where the file is refused."""
    try:
        made = design(data, command)
        made.advises = False
        made.require(command)
        return {name: [check.status == "fail" for check in made.check(name)] for name in made.outline(command).checks}
    except (ValueError, NoSolution):
        return None


def no_worse(now: Failing, before: Failing) -> bool:
    """Nothing fails that did not; where a check has more or fewer findings than before, no more of them fail.

    Findings come and go with what they judge: a root that no tool leaves has a warning instead of its stress.
    """
    pairs = ((now[name], before.get(name, [])) for name in now)  # cams that there were not yet have checks of their own
    return all(
        all(was or not fails for fails, was in zip(one, other, strict=True))
        if len(one) == len(other)
        else sum(one) <= sum(other)
        for one, other in pairs
    )


def tried(kind: str, failures: int, seed: int = 1) -> tuple[int, int]:
    """How many findings of so many failing random designs fail, and how many have a remedy; each is followed."""
    wrong = repaired = 0
    for data, command in draw(kind, seed, 100 * failures):
        before = failing(data, command)
        if before is None or not any(map(any, before.values())):
            continue
        asked = {command, *design(data, command).spec.commands()}
        stood = {each: failing(data, each) for each in asked}
        made = design(data, command)
        for name in (name for name, found in before.items() if any(found)):
            for i, check in enumerate(made.findings(command, name)):
                wrong += check.status == "fail"
                repaired += check.status == "fail" and bool(check.remedy)
                if check.remedy:
                    follow(data, check, i, stood)
        failures -= 1
        if failures == 0:
            break
    assert failures == 0
    return wrong, repaired


def follow(data: Data, check: Check, i: int, stood: dict[str, Failing | None]) -> None:
    """Write the remedy into the file: its check passes, and nothing else fails that did not, of any command; what was
    refused is refused still, or fails in nothing that the others did not."""
    assert check.fix.startswith(remedy_words(check.remedy))
    known = {name: found for before in stood.values() if before for name, found in before.items()}
    for command, before in stood.items():
        now = failing(with_values(data, check.remedy), command)
        if before is None:
            assert now is None or no_worse(now, known), (data, check)
            continue
        assert now is not None, (data, check)
        assert no_worse(now, before), (data, check)
        if fails := now.get(check.name, []):
            # new findings count with the check
            assert not (fails[i] if len(fails) == len(before[check.name]) else any(fails)), (data, check)


IN_THEIR_ROOMS = ("cycle", "loads", "wide_swing")
"""Up to a second for one design; their rooms follow remedies of their own (tests/core/loads/test_remedies.py,
test_remedy_in_the_message_holds in tests/core/wide_swing/test_design.py)."""
SEEDS = {"loads": 4, "cycle": 6, "gripper": 5, "press": 3, "three_gear": 2}
"""Draws that begin with designs whose remedy takes few trials; every other one belongs to `make check-full`."""


@pytest.mark.quick(4)
@pytest.mark.parametrize(
    "kind",
    [
        pytest.param(name, marks=pytest.mark.slow) if name in (*IN_THEIR_ROOMS, "gripper", "press") else name
        for name in DRAWN
        if name not in SLOW_KINDS
    ],
)
def test_followed_remedies_repair_and_break_nothing(kind: str) -> None:
    wrong, repaired = tried(kind, 1, SEEDS.get(kind, 1))
    assert repaired >= 0.3 * wrong


LEAST = {"five_bar": 0.6, "hypocycloid": 0.2, "six_bar": 0.4}
"""Share of what fails that has a remedy at least, else a half. A six-bar's link under a mesh is its gears' own, so that
gears which collide have no key for it, and few trials are made where the motion is followed step by step."""


FEWER = {"cycle": 0.3, "loads": 0.2}
"""Share of the failing designs of kinds that take 2 and 3 s for each."""


@pytest.mark.slow
@pytest.mark.parametrize("count", [30, pytest.param(1000, marks=pytest.mark.stress)])
@pytest.mark.parametrize(("kind", "least"), [(kind, LEAST.get(kind, 0.5)) for kind in DRAWN])
def test_many_followed_remedies(kind: str, least: float, count: int) -> None:
    wrong, repaired = tried(kind, round(FEWER.get(kind, 1.0) * count))
    assert repaired >= least * wrong


def test_steps_reach_the_grid_first() -> None:
    assert up("links.frame").remedy([121.43], 1) == (("links.frame", 121.5),)
    assert down("links.frame").remedy([121.43], 2) == (("links.frame", 121.3),)
    assert up("gears.crank", step=1).remedy([17], 3) == (("gears.crank", 20),)
    assert down("profile_shift[0]", step=0.01).remedy([0.3], 1) == (("profile_shift[0]", 0.29),)
    assert left_out("sync.start").remedy([3.0], 1) == (("sync.start", None),)


def test_what_one_shift_gives_the_other_takes() -> None:
    more, less = shared("a", "b", step=0.01)
    assert more.remedy([0.305, 0.1], 1) == (("a", 0.31), ("b", pytest.approx(0.095, abs=1e-15)))
    assert less.remedy([0.305, 0.1], 1) == (("a", 0.3), ("b", pytest.approx(0.105, abs=1e-15)))


def test_no_tooth_is_split() -> None:
    way = up("gears.planet", "gears.ring", step=1)
    ratio = type(way)(way.keys, 1, "ratio")
    assert ratio.remedy([20, 60], 1) == (("gears.planet", 21), ("gears.ring", 63))
    assert ratio.remedy([20, 50], 1) == ()
    assert ratio.remedy([20, 50], 2) == (("gears.planet", 22), ("gears.ring", 55))


def test_no_gear_becomes_a_ring() -> None:
    """Teeth below 0 are those of a ring gear: another machine, and no remedy."""
    assert down("gears.output", step=1).remedy([3], 2) == (("gears.output", 1),)
    assert down("gears.output", step=1).remedy([3], 3) == ()
    assert down("gears.output", step=1).remedy([3], 5) == ()
    assert up("gears.output", step=1).remedy([-3], 3) == ()


def test_a_key_that_python_keeps_for_itself() -> None:
    spec = design(factory.worked("swing_gripper"), "gripper").spec
    assert value_at(spec, "laws.return") == "modified-sine"
    assert "phases.return" in list(numbers_at(spec, "phases"))
    assert step_of(spec, "phases.return") == 0.5
    assert changed(spec, (("laws.return", "cycloidal"),)).laws.return_ == "cycloidal"


def test_a_kind_without_shifts_hears_nothing_of_them(gearlink: Any, tmp_path: Any) -> None:
    path = tmp_path / "small.yaml"
    path.write_text(
        "kind: three-gear-four-bar\ngears: {module: 2, crank: 14, idler: 40, output: 40}\n"
        "links: {crank: 10, frame: 90}\n"
    )
    ended = gearlink("analyze", path, "--format", "json")
    assert ended.status == 1
    assert "shift" not in " ".join(check["fix"] for check in ended.json["checks"] if check["status"] == "fail")


@pytest.mark.slow
def test_cams_that_a_remedy_makes_possible_keep_their_own_checks() -> None:
    """Before it they are refused, so that nothing of theirs failed: one that then comes into its shaft is no remedy."""
    rollers = {"roller": {"arm": 190.7, "angle": 35.4, "radius": 12}, "return_roller": {"arm": 178.9, "angle": 70.4}}
    rollers["return_roller"]["radius"] = 57
    for shaft in (5, 38):
        data = factory.changed(
            factory.worked("swing_gripper"), cam={"center": [0, 0], "sense": -1, "shaft_radius": shaft, **rollers}
        )
        made = design(data, "gripper")
        (check,) = (found for found in made.findings("gripper", "pressure-angle") if found.status == "fail")
        now = failing(with_values(data, check.remedy), "gripper") if check.remedy else {}
        assert now is not None
        assert not any(map(any, now.values())), shaft
        assert bool(check.remedy) is (shaft == 5)


@pytest.mark.slow
def test_a_check_that_a_command_had_not_to_show_is_new_to_it() -> None:
    """`cam` shows the lift-off where nothing can close both rollers; `gripper` had shown it, of another cause."""
    data = factory.worked("swing_gripper")
    data["cam"]["roller"]["radius"], data["laws"]["accelerate"], data["links"]["coupler"] = 90.63, "half-mcv-50", 316.39
    stood = {command: failing(data, command) for command in ("gripper", "cam")}
    findings = [(i, found) for name in stood["gripper"] or () for i, found in enumerate(_found(data, name))]
    assert {found.name for _, found in findings if found.status == "fail" and not found.remedy} == {"shaft-clearance"}
    for i, found in findings:
        if found.remedy:
            follow(data, found, i, stood)


def _found(data: Data, name: str) -> tuple[Any, ...]:
    return tuple(design(data, "gripper").findings("gripper", name))


def test_findings_that_are_new_count_with_the_check() -> None:
    """With a height of the teeth in the file each gear of a mesh is judged for itself: one finding becomes two."""
    data: Data = {
        "kind": "two-gear-four-bar",
        "gears": {"module": 2, "planet": 17, "ring": 75},
        "links": {"coupler": 190.87, "rocker": 193.89, "frame": 196.06},
    }
    made = design(data, "analyze")
    (check,) = (found for found in made.findings("analyze", "involute-interference") if found.status == "fail")
    assert check.remedy
    now = failing(with_values(data, check.remedy), "analyze")
    assert now is not None
    assert not any(now[check.name])


def spec_of(name: str, **keys: Any) -> Any:
    data = factory.changed(factory.worked(name), **keys)
    return KINDS[data["kind"]].spec_model().model_validate(data)


@pytest.mark.slow
def test_a_remedy_breaks_no_command_that_another_class_serves() -> None:
    """The spring that keeps the roller on its cam presses the other one beyond what the file's loads allow."""
    made = KINDS["swing-gripper"].design(
        "gripper", spec_of("loaded_gripper", cylinder={"radius": 373.6}, links__output=39.37)
    )
    (check,) = made.findings("gripper", "lift-off")
    assert check.status == "fail"
    stronger = changed(made.spec, (("spring.torque", 5537.0),))
    loads = [KINDS["swing-gripper"].design("loads", spec).check("contact-pressure") for spec in (made.spec, stronger)]
    assert [any(found.status == "fail" for found in each) for each in loads] == [False, True]
    assert ("spring.torque", 5537.0) not in check.remedy


def test_no_remedy_that_the_reader_of_files_refuses() -> None:
    spec = spec_of("loaded_gripper")
    assert changed(spec, (("loads.roller.width", 6.0e14),)) is None
    assert changed(spec, (("loads.roller.width", 60.0),)) is not None


def test_a_gripper_names_no_base_circle() -> None:
    """Its file has no such key: the cam's centre stands farther from the roller instead of it."""
    spec = spec_of("swing_gripper", cam__roller__angle=15.38)
    made = KINDS["swing-gripper"].design("gripper", spec)
    (check,) = (found for found in made.check("pressure-angle") if found.status == "fail")
    assert "base circle" not in f"{check.message} {check.fix}"
    assert "cam.center" in (check.fix or "")


def fails(made: Any, command: str, name: str) -> Check:
    """The first finding of a check that fails."""
    return next(check for check in made.findings(command, name) if check.status == "fail")


@pytest.mark.slow
@pytest.mark.parametrize(("allowed", "angle"), [(540, 72.0), (300, None)])
def test_loads_that_were_refused_hold_after_a_remedy(allowed: float, angle: float | None) -> None:
    """Both rollers on one side: 57 deg parts them, and presses the return roller beyond what the file allows."""
    given: dict[str, Any] = {"cam__return_roller__angle": 20, "loads__material__allowed_pressure": allowed}
    kind, spec = KINDS["swing-gripper"], spec_of("loaded_gripper", **given)
    with pytest.raises(NoSolution, match="same side"):
        kind.design("loads", spec).require("loads")
    check = fails(kind.design("gripper", spec), "gripper", "lift-off")
    assert check.remedy == (() if angle is None else (("cam.return_roller.angle", angle),))
    if check.remedy:
        loads = kind.design("loads", changed(spec, check.remedy))
        assert all(found.status != "fail" for found in loads.report("loads").checks)


@pytest.mark.slow
@pytest.mark.parametrize(("allowed", "compared"), [(1200, False), pytest.param(300, True, marks=pytest.mark.slow)])
def test_remedies_and_commands_of_a_file_share_its_loads(allowed: float, compared: bool) -> None:
    """Those of the file as it stands are computed where a remedy leaves something to compare them with."""
    given = {"spring__torque": 150, "loads__material__allowed_pressure": allowed}
    designs = FileDesigns(KINDS["swing-gripper"], spec_of("loaded_gripper", **given))
    made = designs.of("gripper")
    assert fails(made, "gripper", "lift-off").remedy or compared
    assert designs.of("cam") is made
    assert ("machine" in vars(designs.of("loads"))) is compared


@pytest.mark.parametrize("name", ["undercut", "involute-interference"])
def test_gears_are_repaired_though_their_linkage_is_refused(name: str) -> None:
    data: Data = {
        "kind": "two-gear-four-bar",
        "gears": {"module": 2, "planet": 16, "ring": 93},
        "links": {"coupler": 96.85, "rocker": 121.41, "frame": 174.42},
    }
    before = failing(data, "gear")
    assert before is not None
    assert failing(data, "analyze") is None
    check = fails(design(data, "gear"), "gear", name)
    assert check.remedy
    now = failing(with_values(data, check.remedy), "gear")
    assert now is not None
    assert not any(now[name])
    assert no_worse(now, before)


def test_links_are_changed_of_a_wheel_whose_teeth_are_chosen_for_times() -> None:
    data = factory.changed(factory.worked("mutilated_gear_times"), links__crank=44, links__rocker=75)
    check = fails(design(data, "analyze"), "analyze", "transmission-angle")
    assert check.remedy
    now = failing(with_values(data, check.remedy), "analyze")
    assert now is not None
    assert not any(map(any, now.values()))


def test_findings_of_one_tool_name_one_rounding() -> None:
    data = factory.worked("drawn_feed")
    data["gears"] |= {"idler": 23, "tool": {"addendum": 1.0625, "rounding": 0.3}}
    found = [c for c in design(data, "analyze").findings("analyze", "fillet-interference") if c.status == "fail"]
    ((key, value),) = {pair for check in found for pair in check.remedy}
    data["gears"]["tool"]["rounding"] = value
    assert (len(found), key) == (3, "gears.tool.rounding")
    assert all(check.status == "pass" for check in design(data, "analyze").check("fillet-interference"))


def test_a_remedy_that_leaves_a_warning_says_so() -> None:
    data: Data = {"kind": "gear-pair", "module": 2, "teeth": [11, 51], "profile_shift": [-0.67, -0.54]}
    data |= {"clearance": 0.28, "addendum": 0.94}
    made = design(data, "gear")
    check = fails(made, "gear", "fillet-interference")
    after = design(with_values(data, check.remedy), "gear")
    worse = [
        name
        for name in made.outline("gear").checks
        if any(found.status == "warn" for found in after.check(name))
        and all(found.status == "pass" for found in made.check(name))
    ]
    assert worse == ["sliding"]
    assert "warnings that remain: sliding" in check.note


def test_a_change_of_what_is_asked_for_comes_last_and_says_so() -> None:
    """The rod of the minimum ripple stays within 0.221 mm: no other rod keeps less, so that less must be asked for."""
    for tolerance, key in ((0.25, "rod.length"), (0.05, "dwell.tolerance")):
        made = factory.design("hypocycloid_slider", rod={"rule": "osculating"}, dwell__tolerance=tolerance)
        check = fails(made, "analyze", "dwell-quality")
        assert check.remedy[0][0] == key
        assert ("relaxes the requirement" in check.fix) is (key == "dwell.tolerance")
    crank = factory.design("ty460_slider_crank", limits={"transmission_angle": 70})
    check = fails(crank, "analyze", "transmission-angle")
    assert check.remedy[0][0] == "rod"


@pytest.mark.slow
def test_no_part_greater_than_the_machine() -> None:
    """A pressure angle of a degree asks for cams of metres."""
    for limit, radius in ((5.0, 245.3), (1.0, None)):
        check = fails(factory.design("ty460", command="cam", limits__pressure_angle=limit), "cam", "pressure-angle")
        assert dict(check.remedy).get("cam.base_radius") == radius
        assert ("set cam.base_radius" in check.fix) is (radius is not None)


@pytest.mark.slow
def test_teeth_move_between_the_gears_of_a_six_bar() -> None:
    """The link under them keeps its length."""
    data = factory.worked("geared_six_bar")
    gears = data["trains"][0]["gears"]
    gears[0], gears[1] = 12, gears[0] + gears[1] - 12
    made = design(data, "gear")
    check = fails(made, "gear", "undercut")
    assert len(check.remedy) == 2
    assert {key.rpartition("[")[0] for key, _ in check.remedy} == {"trains[0].gears"}
    assert all(isinstance(value, int) for _, value in check.remedy)
    before, now = failing(data, "gear"), failing(with_values(data, check.remedy), "gear")
    assert before is not None
    assert now is not None
    assert not any(now["undercut"])
    assert no_worse(now, before)


def test_a_dwell_beyond_one_arc_may_ask_for_less() -> None:
    """No rod makes it, which is no reason to try nothing more."""
    data: Data = {"kind": "hypocycloid-dwell", "gears": {"module": 2, "planet": 26, "ring": 130}}
    data |= {"rod": {"length": 134.79}, "dwell": {"angle": 78.96, "tolerance": 0.13}}
    assert fails(design(data, "analyze"), "analyze", "dwell-quality").remedy


def test_no_shaft_of_less_than_nothing() -> None:
    """A cam that reaches over its own axis leaves room for none."""
    rollers = {"roller": {"arm": 160, "angle": 49, "radius": 30}, "return_roller": {"arm": 160, "angle": 88}}
    rollers["return_roller"]["radius"] = 300
    made = factory.design("swing_gripper", cam={"center": [0, 0], "sense": -1, "shaft_radius": 40, **rollers})
    found = [check for check in made.check("shaft-clearance") if check.status == "fail"]
    assert found
    assert not any("at most -" in check.message for check in found)
