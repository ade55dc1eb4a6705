"""`--suggest`: the changes that are tried, the repaired report, formats and exit status."""

from __future__ import annotations

import json
import shlex
from pathlib import Path
from typing import Any

import factory
import pytest
from sweeps import mostly_slow

from gearlink.cli.commands import suggest
from gearlink.cli.commands.suggest import Change, overrides
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import COMMANDS
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.remedies.trials import Bench
from gearlink.core.base.report import Check, Remedy
from gearlink.core.base.spec_paths import value_at
from gearlink.core.studies.codes import CONTACT_LOSS

LOOP = """kind: wide-swing-cam
layout: twin-rocker
swing: 160
cycle_angle: 150
speed: 100
inertia: 0.5
unloader: {type: spring, pivot_ratio: 4, stretch_ratio: 0.05, arm: 60}
cam: {center_distance: 150, roller_radius: 4, shaft_radius: 20}
"""
CANNOT_TURN = LOOP.replace("pivot_ratio: 4", "pivot_ratio: 0.9")


_repair, _repaired = suggest.repair, {}


@pytest.fixture(autouse=True)
def searched_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same design is repaired once: the tests differ in what they do with what was found."""

    def repair(kind: Any, command: str, spec: Any, *, strict: bool, advance: Any) -> Any:
        key = command, spec.model_dump_json(), strict
        if key not in _repaired:
            _repaired[key] = _repair(kind, command, spec, strict=strict, advance=advance)
        return _repaired[key]

    monkeypatch.setattr(suggest, "repair", repair)


@pytest.fixture
def loop(tmp_path: Path) -> Path:
    path = tmp_path / "loop.yaml"
    path.write_text(LOOP)
    return path


@pytest.mark.slow
def test_loop_is_repaired_step_by_step(gearlink: Any, loop: Path) -> None:
    assert gearlink("swing", loop).status == ExitCode.FINDING
    ended = gearlink("swing", loop, "--suggest", "--format", "json")
    assert ended.status == ExitCode.OK
    first, *others = ended.json["suggestions"]
    assert (first["path"], first["old"], first["new"]) == ("cycle_angle", 150.0, 101.0)
    assert "loop" in first["why"]
    assert all(change["path"] == "cycle_angle" for change in others)
    assert ended.json["ok"] is True
    assert "transition_zone" in ended.json["quantities"]


@pytest.mark.slow
def test_changes_put_in_by_hand_give_the_same_report(gearlink: Any, loop: Path) -> None:
    repaired = gearlink("swing", loop, "--suggest", "--format", "json").json
    overrides = [f"--set={change['path']}={json.dumps(change['new'])}" for change in repaired["suggestions"]]
    by_hand = gearlink("swing", loop, *overrides, "--format", "json")
    assert by_hand.status == ExitCode.OK
    repaired.pop("suggestions")
    assert by_hand.json == repaired


def test_refused_design_is_repaired(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "stuck.yaml"
    path.write_text(CANNOT_TURN.replace("cycle_angle: 150", "cycle_angle: 100"))
    assert gearlink("swing", path).status == ExitCode.WRONG_INPUT
    ended = gearlink("swing", path, "--suggest", "--format", "json")
    assert ended.status == ExitCode.OK
    assert ended.json["suggestions"][0]["path"] == "unloader.pivot_ratio"


BACKWARDS = """kind: swing-gripper
speed: 6400
cylinder: {radius: 106.4, center: [43.9, 269.1]}
arm: {length: 306.4, direction: -3.9}
links: {input: 158, coupler: 282, output: 112}
pivots: {input: [-179.7, 196.4], output: [-342.7, 414]}
output_direction: 52.3
swing_sense: -1
assembly: -1
phases: {accelerate: 83, constant: 13, decelerate: 58, far_dwell: 4, return: 97, near_dwell: 105}
handover: 89.5
cam:
  center: [43.9, 269.1]
  sense: -1
  shaft_radius: 35
  roller: {arm: 160, angle: 31, radius: 27}
  return_roller: {arm: 171, angle: -90, radius: 27}
inertia: {input: 0.02, output: 0.25, coupler: 0.03, coupler_mass: 2.3, return_rocker: 0.03}
spring: {torque: 1500}
limits: {handover_place: 0.9}
"""


@pytest.mark.slow
def test_a_cam_that_turns_the_drum_backwards_is_reversed(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "drum.yaml"
    path.write_text(BACKWARDS)
    assert gearlink("gripper", path).status == ExitCode.FINDING
    ended = gearlink("gripper", path, "--suggest", "--format", "json")
    assert ended.status == ExitCode.OK
    assert [(c["path"], c["new"]) for c in ended.json["suggestions"]] == [("cam.sense", 1)]


@pytest.mark.parametrize("name", ["follower", "last link", "a.b", "x[0]", "7"])
def test_length_of_a_link_that_the_file_names(gearlink: Any, tmp_path: Path, name: str) -> None:
    """A key that the file has chosen, whatever it is called: a train keeps the pins of the link 256 mm apart."""
    pins = {"frame": "AF", "crank": "AB", "one": "BC", "two": "CD", "three": "DE", name: "EF"}
    gears = [("A", "frame", 20), ("B", "one", 20)], [("F", "frame", 240), ("E", "three", 16)]
    data = {
        "kind": "gear-train-mobility",
        "links": {link: {"pins": list(ends)} for link, ends in pins.items()},
        "trains": [
            {"module": 2, "gears": [{"at": at, "fixed_to": link, "teeth": teeth} for at, link, teeth in train]}
            for train in gears
        ],
    }
    data["links"][name]["length"] = 40
    path = tmp_path / "loop.yaml"
    path.write_text(json.dumps(data), encoding="utf-8")
    ended = gearlink("analyze", path, "--suggest")
    assert ended.status == ExitCode.OK


@pytest.mark.slow
def test_key_that_is_left_out(gearlink: Any, designs: Path) -> None:
    arguments = ("swing", designs / "wide_swing_twin_cam.yaml", "--set", "cam.rocker_radius=80", "--suggest")
    ended = gearlink(*arguments, "--format", "json")
    assert [(c["path"], c["old"], c["new"]) for c in ended.json["suggestions"]] == [("cam.rocker_radius", 80.0, None)]
    assert "cam.rocker_radius: 80 -> not given" in gearlink(*arguments).out


def test_good_design_needs_no_change(gearlink: Any, designs: Path) -> None:
    path = designs / "ty460_input_gears.yaml"
    ended = gearlink("gear", path, "--suggest", "--format", "json")
    plain = gearlink("gear", path, "--format", "json")
    assert ended.status == ExitCode.OK
    assert ended.json == plain.json | {"suggestions": []}
    assert gearlink("gear", path, "--suggest").out == "suggestions: none\n\n" + gearlink("gear", path).out


@pytest.mark.slow
def test_formats(gearlink: Any, loop: Path) -> None:
    table = gearlink("swing", loop, "--suggest").out
    assert table.startswith("suggestions, tried in this order:\n  cycle_angle: 150 -> 101")
    csv = gearlink("swing", loop, "--suggest", "--format", "csv").out
    assert csv.startswith("change,old,new,why\ncycle_angle,150.0,101.0,")
    assert "\n\nquantity,symbol,unit,value\n" in csv
    markdown = gearlink("swing", loop, "--suggest", "--format", "md").out
    assert markdown.startswith("## Suggestions\n\n| change | old | new | why |")
    assert "\n# loop: swing\n" in markdown


@pytest.mark.slow
def test_quantity_stays_alone_on_standard_output(gearlink: Any, loop: Path) -> None:
    ended = gearlink("swing", loop, "--suggest", "--quantity", "velocity_peak")
    assert ended.out.count("\n") == 1
    assert float(ended.out) == pytest.approx(1.4149, abs=1e-4)
    assert "cycle_angle: 150 -> 101" in ended.err


FEEDER = """kind: three-gear-four-bar
gears: {module: 1.5, crank: 40, idler: 44, output: 40}
links:
  crank: 22.52
  frame: 86.2
dwell_tolerance: 0.3
dwell_window: 60
"""


@pytest.mark.slow
@pytest.mark.parametrize(("typed", "key"), [(("22.52", "23.60"), "crank"), (("86.2", "85.0"), "frame")])
def test_one_mistyped_length_is_found(gearlink: Any, tmp_path: Path, typed: tuple[str, str], key: str) -> None:
    """The one change stands at its line, repairs the collision besides, and the saved file passes."""
    path = tmp_path / "feeder.yaml"
    path.write_text(FEEDER.replace(*typed))
    line = next(n for n, text in enumerate(path.read_text().splitlines(), 1) if f"  {key}:" in text)
    checked = gearlink("check", path)
    assert checked.status == 1
    (of_dwell, of_tips) = [text for text in checked.out.splitlines() if ": fail " in text]
    assert of_dwell.startswith(f"{path}:{line}:3: fail GL313")
    assert of_tips.startswith(f"{path}:{line}:3: fail GL301")
    one, other = [text for text in checked.out.splitlines() if "  fix: " in text]
    assert one == other, "one change repairs both"
    annotations = gearlink("batch", path, "--format", "github").out.splitlines()
    (of_dwell,) = [text for text in annotations if "GL313" in text]
    assert f"line={line},col=3," in of_dwell
    assert f"%0Afix: set links.{key} to " in of_dwell
    whole = gearlink("analyze", path, "--suggest", "--save", tmp_path / "better.yaml", "--format", "json").json
    assert whole["ok"]
    (change,) = whole["suggestions"]
    assert change["path"] == f"links.{key}"
    assert change["new"] == pytest.approx(float(typed[0]), abs=0.03)
    assert gearlink("check", tmp_path / "better.yaml").status == 0


@pytest.mark.slow
def test_what_cannot_be_repaired_keeps_its_status(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    path = designs / "wide_swing_twin_rocker.yaml"
    ended = gearlink("swing", path, "--set", "limits.pressure_angle=1", "--suggest", "--format", "json")
    assert ended.status == ExitCode.FINDING
    wrong = gearlink("swing", path, "--set", "swing=400", "--suggest", "--format", "json")
    assert wrong.status == ExitCode.WRONG_INPUT
    assert wrong.json["errors"][0]["key"] == "swing"
    unknown = gearlink("swing", path, "--suggest", "--quantity", "velocity_peek")
    assert unknown.status == ExitCode.WRONG_INPUT
    (tmp_path / "file").write_text("")
    no_folder = gearlink("swing", path, "--suggest", "--plot", "--out", tmp_path / "file" / "x")
    assert no_folder.status == ExitCode.WRONG_INPUT


def test_figure_is_that_of_the_repaired_design(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr(
        "gearlink.cli.commands.design.plot", lambda command, design, *_: drawn.append((command, design.spec))
    )
    path = tmp_path / "wrong.yaml"
    path.write_text(TWICE_WRONG)
    ended = gearlink("gear", path, "--suggest", "--plot", "--out", tmp_path, "--format", "json")
    assert ended.status == ExitCode.OK
    ((command, spec),) = drawn
    (change, *_) = ended.json["suggestions"]
    assert (command, value_at(spec, change["path"])) == ("gear", change["new"])


@pytest.mark.quick(1)
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_on_a_design_has_the_option(gearlink: Any, designs: Path, command: str) -> None:
    name, path = next(
        (kind.name, path)
        for kind in KINDS.values()
        for path in sorted(designs.glob("*.yaml"))
        if command in kind.commands and f"\nkind: {kind.name}\n" in f"\n{path.read_text()}"
    )
    plain = gearlink(*command.split(), path, "--format", "json")
    ended = gearlink(*command.split(), path, "--suggest", "--format", "json")
    assert "--suggest" in gearlink(*command.split(), "--help").out
    if plain.status == ExitCode.OK:
        assert (name, ended.json) == (name, plain.json | {"suggestions": []})
    else:
        assert ended.status in (ExitCode.OK, plain.status)


def test_wrong_kind(gearlink: Any, designs: Path) -> None:
    ended = gearlink("swing", designs / "ty460.yaml", "--suggest", "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    assert ended.json["errors"][0]["code"] == "GL113"


@pytest.mark.slow
@pytest.mark.parametrize("name", mostly_slow(["twin_cam", "twin_rocker", "slider", "oscillating_cam"], 1))
def test_worked_designs_pass(gearlink: Any, designs: Path, name: str) -> None:
    path = designs / f"wide_swing_{name}.yaml"
    for command in ("swing", "analyze", *(() if name == "slider" else ("cam",))):
        ended = gearlink(command, path, "--strict", "--format", "json")
        assert ended.status == ExitCode.OK, ended.out


def test_cam_command_refuses_a_loop_at_the_key(gearlink: Any, loop: Path) -> None:
    ended = gearlink("cam", loop, "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    (error,) = ended.json["errors"]
    assert (error["key"], error["line"]) == ("cycle_angle", 4)


# Other kinds: the remedies of what fails

COLLIDING = """kind: three-gear-four-bar
gears: {module: 2.5, crank: 20, idler: 20, output: 60}
links: {crank: 18, frame: 121.4}
"""
TWICE_WRONG = "kind: gear-pair\nmodule: 4\nteeth: [10, 12]\nprofile_shift: [0, 0]\n"


@pytest.mark.quick(1)
@pytest.mark.parametrize(("command", "text"), [("analyze", COLLIDING), ("gear", TWICE_WRONG)])
def test_the_printed_options_repair_the_design(gearlink: Any, tmp_path: Path, command: str, text: str) -> None:
    path = tmp_path / "wrong.yaml"
    path.write_text(text)
    assert gearlink(command, path).status == ExitCode.FINDING
    ended = gearlink(command, path, "--suggest")
    assert ended.status == ExitCode.OK
    (line,) = (line for line in ended.out.splitlines() if line.startswith("  as options: "))
    options = shlex.split(line.removeprefix("  as options: "))
    assert options[0] == "--set"
    again = gearlink(command, path, *options)
    assert again.status == ExitCode.OK
    assert ended.out.endswith(again.out)


@pytest.mark.slow
def test_where_nothing_was_found_it_says_so(gearlink: Any, tmp_path: Path) -> None:
    """No tooth of one with so large a shift can be cut: no options that would still fail, the design as it stands."""
    path = tmp_path / "ones.yaml"
    path.write_text("kind: gear-pair\nmodule: 2\nteeth: [1, 1]\nprofile_shift: [3, 3]\n")
    ended, plain = gearlink("gear", path, "--suggest"), gearlink("gear", path)
    assert ended.status == ExitCode.FINDING
    assert ended.out == "suggestions: no change found with which every check passes\n\n" + plain.out
    assert gearlink("gear", path, "--suggest", "--format", "json").json["suggestions"] == []


@pytest.mark.slow
@pytest.mark.parametrize(
    "line",
    mostly_slow(
        [
            "gripper swing_gripper laws.return=simple-harmonic",
            "swing wide_swing_twin_cam unloader.pivot_ratio=0.9",
            "press ty460 cam.base_radius=30",
            "gripper swing_gripper cam.return_roller.angle=20",
            "swing wide_swing_twin_rocker swing=60",
        ],
        2,
    ),
)
def test_options_of_every_cam_kind_repair_the_design(gearlink: Any, designs: Path, line: str) -> None:
    command, name, change = line.split()
    given = (command, designs / f"{name}.yaml", "--set", change)
    assert gearlink(*given).status != ExitCode.OK
    ended = gearlink(*given, "--suggest")
    assert ended.status == ExitCode.OK
    (options,) = (each for each in ended.out.splitlines() if each.startswith("  as options: "))
    assert gearlink(*given, *shlex.split(options.removeprefix("  as options: "))).status == ExitCode.OK


def test_a_refusal_is_repaired_at_its_key(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "rocker.yaml"
    path.write_text(COLLIDING.replace("crank: 18", "crank: 60"))
    assert gearlink("analyze", path).status == ExitCode.WRONG_INPUT
    ended = gearlink("analyze", path, "--suggest", "--format", "json")
    assert ended.status == ExitCode.OK
    # 28.5 mm would do away with the refusal alone: its gears collide
    assert [(change["path"], change["new"]) for change in ended.json["suggestions"]] == [("links.crank", 16.4)]


def test_strict_repairs_warnings_as_well(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "small.yaml"
    path.write_text("kind: gear-pair\nmodule: 4\nteeth: [17, 17]\nprofile_shift: [0, 0]\n")
    assert gearlink("gear", path, "--suggest", "--format", "json").json["suggestions"] == []
    ended = gearlink("gear", path, "--suggest", "--strict", "--format", "json")
    assert ended.status == ExitCode.OK
    assert ended.json["suggestions"]


def test_of_a_key_that_changes_twice_the_last_value_counts() -> None:
    changes = [Change("teeth[0]", 10, 12, "a"), Change("teeth[0]", 12, 17, "b"), Change("x y", 1.0, None, "c")]
    assert overrides(changes) == "--set 'teeth[0]=17' --set 'x y=null'"


def test_a_section_that_the_file_leaves_out_is_suggested(gearlink: Any, tmp_path: Path) -> None:
    file = tmp_path / "cam.yaml"
    file.write_text(
        "kind: disc-cam\nspeed: 600\nfollower: {type: translating-flat, mass: 2}\ncam: {base_radius: 40}\n"
        "motion: [{to: 120, lift: 10}, {to: 180}, {to: 300, lift: 0}, {to: 360}]\nloads: {roller: {width: 15}}\n"
    )
    ended = gearlink("loads", file, "--suggest")
    assert ended.status == 0
    assert "spring.preload: not given -> " in ended.out


class Slower:
    """A bench that repairs a finding by less and less speed, at the price of others, and finds no remedy."""

    def __init__(self, speeds: list[float]) -> None:
        self.speeds = speeds

    def remedy(self, _check: Check, _index: int) -> Remedy:
        return ()

    def detour(self, _check: Check, _index: int) -> Remedy:
        return (("speed", self.speeds.pop(0)),)


def test_what_came_back_is_not_repaired_the_same_way_again() -> None:
    """Eight rounds of ever less speed took a minute of a press with friction, and ended with nothing found."""
    check, taken, bench = CONTACT_LOSS.check("fail", "speed", 1.0, 2.0, fix="less"), set(), Slower([9.0, 8.0, 7.0])
    found = [list(suggest._steps(bench, [(0, check)], taken)) for _ in range(3)]
    assert found == [[((("speed", 9.0),), check.message)], [], []]


@pytest.mark.slow
def test_a_press_whose_limits_cannot_be_met_is_given_up_soon(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[Bench] = []

    def bench(*given: Any, **keys: Any) -> Bench:
        made.append(Bench(*given, **keys))
        return made[-1]

    monkeypatch.setattr(suggest, "Bench", bench)
    design = factory.design("loaded_press", command="loads", limits={"transmission_angle": 60})
    assert _repair(KINDS["flatbed-press"], "loads", design.spec, strict=True) == (design.spec, None)
    assert len(made) <= 3
    assert sum(len(each._trials) for each in made) <= 15
