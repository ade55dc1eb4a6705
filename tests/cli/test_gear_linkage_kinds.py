"""The smaller geared linkages at the command line: every example, its figure, the errors that a user can make.

Tolerances: none of its own; numbers are tested beside the engine. Plotted data equal the tables they come from.
"""

from pathlib import Path

import factory
import pytest
from sheets import sheet, words

from gearlink.core.base.kinds import KINDS

WORKED = {
    "gear-train-mobility": ["six_bar_two_trains"],
    "mutilated-gear-dwell": ["mutilated_gear_press"],
    "two-gear-four-bar": ["two_gear_drag_link", "two_gear_ring", "two_gear_standing"],
    "geared-rocker": ["wide_lever"],
    "hypocycloid-dwell": ["hypocycloid_slider"],
    "geared-six-bar": ["geared_six_bar", "six_bar_swing"],
    "geared-five-bar": ["five_bar_path", "five_bar_points", "five_bar_positions"],
}
PAIRS = [(kind, name) for kind, names in WORKED.items() for name in names]


def asked(name):
    """The commands that an example asks for, the main one first."""
    data = factory.worked(name)
    return KINDS[data["kind"]].spec_model().model_validate(data).commands()


def design_of(path, command="analyze"):
    from gearlink.cli.evaluate import build, open_design, read_spec
    from gearlink.cli.options import Options

    loaded, kind = open_design(str(path), Options())
    return build(loaded, kind, command, read_spec(loaded, kind, str(path)), Options())[0]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("kind", "name"), PAIRS)
def test_worked_design(kind, name, gearlink, designs):
    ended = gearlink(*asked(name)[0].split(), designs / f"{name}.yaml", "--format", "json")
    assert ended.status == 0, ended.out
    assert ended.json["kind"] == kind
    assert ended.json["ok"]
    assert ended.json["checks"]


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", [*(names[0] for names in WORKED.values()), "two_gear_standing"])
def test_every_command_in_every_format(name, gearlink, designs):
    for command in asked(name):
        for form in ("table", "csv", "md"):  # as JSON: every example runs
            assert gearlink(*command.split(), designs / f"{name}.yaml", "--format", form).status == 0


def test_worked_designs_ask_for_every_command():
    for kind, names in WORKED.items():
        commands = {command for name in names for command in asked(name)}
        if kind == "two-gear-four-bar":  # the other two syntheses: below
            commands |= {"synth back-step", "synth momentary-dwell"}
        assert commands == set(KINDS[kind].commands) - {"loads", "tolerance", "register"}


@pytest.mark.quick(1)
@pytest.mark.parametrize("command", ["synth back-step", "synth momentary-dwell"])
def test_other_syntheses_of_a_two_gear_four_bar(command, gearlink, designs):
    path = designs / "two_gear_standing.yaml"
    for form in ("table", "json"):
        assert gearlink(*command.split(), path, "--set", "back_step.angle=0.5", "--format", form).status == 0
    drawn = words(sheet("two_gear_standing", command, back_step__angle=0.5).figure)
    assert "maximum z₅/z₂ with a standstill" in drawn
    assert "start of the window" not in drawn


def test_a_figure_is_written(gearlink, designs, tmp_path):
    """Those of every design and command are drawn and looked at in figures/test_labels.py."""
    path = designs / "six_bar_two_trains.yaml"
    assert gearlink("analyze", path, "--plot", "--plot-format", "svg", "--out", tmp_path).status == 0
    assert len(list(tmp_path.glob("*.svg"))) == 1


def wrong(gearlink, folder: Path, text: str, *arguments):
    """The errors of a design file that cannot be computed."""
    path = folder / "design.yaml"
    path.write_text(text)
    ended = gearlink("analyze", path, *arguments, "--format", "json")
    assert ended.status == 2, ended.out
    return ended.json["errors"]


def test_mutilated_gear_that_does_not_come_to_a_lock(gearlink, tmp_path):
    text = "kind: mutilated-gear-dwell\nreduction: 6\ngears: {module: 3, full_teeth: 80, group_teeth: 15, driven: 20}\n"
    (error,) = wrong(gearlink, tmp_path, text)
    assert (error["key"], error["line"]) == ("gears", 3)
    assert error["help"].startswith("set gears.group_teeth to 20")
    path = tmp_path / "stops.yaml"
    path.write_text(text.replace("group_teeth: 15", "group_teeth: 20"))
    assert gearlink("analyze", path).status == 0


def test_mobility_that_is_not_wanted_is_a_finding(gearlink, designs):
    ended = gearlink("analyze", designs / "six_bar_two_trains.yaml", "--set", "mobility=2", "--format", "json")
    assert ended.status == 1
    assert [c["code"] for c in ended.json["checks"] if c["status"] == "fail"] == ["GL309"]


def test_unknown_pin_is_located(gearlink, designs):
    path = designs / "six_bar_two_trains.yaml"
    ended = gearlink("analyze", path, "--set", "trains[0].gears[0].at=Z", "--format", "json")
    assert ended.status == 2
    assert ended.json["errors"][0]["key"] == "trains[0].gears[0].at"


def test_mutilated_figure_shows_the_table():
    made, figure = sheet("mutilated_gear_press")
    lines = {line.get_label(): line for axes in figure.axes for line in axes.lines}
    table = made.table("motion")
    assert list(lines["rocker"].get_ydata()) == list(table.data[table.columns.index("rocker_speed_ratio")])


TWO_GEAR = """kind: two-gear-four-bar
gears: {module: 1, planet: 16, sun: 12}
links: {coupler: 30, rocker: 40, frame: 45}
target: {motion: momentary-dwell}
"""


def test_impossible_dwell_is_refused_with_the_reason(gearlink, tmp_path):
    (error,) = wrong(gearlink, tmp_path, TWO_GEAR)
    assert (error["key"], error["line"]) == ("target.motion", 4)
    assert "crank-rocker w2/w1 stays below 1" in error["message"]


@pytest.mark.parametrize(
    ("old", "new", "code", "key"),
    [
        (", frame: 45}\ntarget: {motion: momentary-dwell}", "}", "GL106", "links.frame"),
        ("target: {motion: momentary-dwell}", "dwell: {tolerance: 1}", "GL111", "links.frame"),
        ("target: {motion: momentary-dwell}", "back_step: {angle: 1}", "GL111", "links.frame"),
        ("target: {motion: momentary-dwell}", "dwell: {}", "GL106", "dwell.tolerance"),
        ("target: {motion: momentary-dwell}", "dwell: {window: 9, margin: 0.1}", "GL111", "dwell.margin"),
        ("sun: 12", "sun: 12, ring: 40", "GL111", "gears.ring"),
        (", sun: 12", "", "GL106", "gears.sun"),
        ("sun: 12", "ring: 16", "GL111", "gears.ring"),
    ],
)
def test_what_a_two_gear_file_must_give(gearlink, tmp_path, old, new, code, key):
    (error,) = wrong(gearlink, tmp_path, TWO_GEAR.replace(old, new))
    assert (error["code"], error["key"]) == (code, key)


def test_rocker_needs_a_crank_or_a_swing(gearlink, designs, tmp_path):
    text = (designs / "wide_lever.yaml").read_text()
    (error,) = wrong(gearlink, tmp_path, text.replace("target: {swing: 120}", ""))
    assert (error["code"], error["key"]) == ("GL106", "links.crank")
    (error,) = wrong(gearlink, tmp_path, text, "--set", "links.crank=20")
    assert error["code"] == "GL111"


def test_swing_out_of_reach(gearlink, designs):
    ended = gearlink("analyze", designs / "wide_lever.yaml", "--set", "target.swing=900", "--format", "json")
    assert ended.status == 2
    assert ended.json["errors"][0]["key"] == "target.swing"


HYPOCYCLOID = """kind: hypocycloid-dwell
gears: {module: 1.6, planet: 25, ring: 75}
rod: {rule: osculating}
dwell: {tolerance: 0.25}
"""


@pytest.mark.parametrize(
    ("old", "new", "code", "key"),
    [
        ("ring: 75", "ring: 80", "GL112", "gears.ring"),
        ("ring: 75", "ring: 50", "GL112", "gears.ring"),
        ("ring: 75", "ring: 20", "GL111", "gears.ring"),  # `gear` named teeth[1], which stood at `kind`
        ("{rule: osculating}", "{length: 50}", "GL112", "rod"),
        ("{rule: osculating}", "{length: 50, rule: osculating}", "GL111", "rod.rule"),
        ("{rule: osculating}", "{}", "GL106", "rod.rule"),
        ("rod: {rule: osculating}", "target: {quality: least-ripple}\nrod: {rule: osculating}", "GL111", "rod"),
        ("dwell: {tolerance: 0.25}", "dwell: {tolerance: 60}", "GL112", "dwell.tolerance"),
        (
            "rod: {rule: osculating}\ndwell: {tolerance: 0.25}",
            "target: {quality: widest-dwell}",
            "GL106",
            "dwell.tolerance",
        ),
    ],
)
def test_hypocycloid_refusals(gearlink, tmp_path, old, new, code, key):
    (error,) = wrong(gearlink, tmp_path, HYPOCYCLOID.replace(old, new))
    assert (error["code"], error["key"]) == (code, key)


@pytest.mark.slow
def test_hypocycloid_dwell_too_narrow_is_a_finding(gearlink, tmp_path):
    path = tmp_path / "design.yaml"
    path.write_text(HYPOCYCLOID)
    ended = gearlink("analyze", path, "--format", "json")
    assert ended.status == 1
    (failed,) = [c for c in ended.json["checks"] if c["status"] == "fail"]
    assert (failed["code"], failed["unit"]) == ("GL311", "deg")
    assert failed["remedy"] == [{"key": "rod.length", "value": 140.0}, {"key": "rod.rule", "value": None}]
    assert failed["fix"].startswith("set rod.length to 140 and remove rod.rule")
    assert gearlink("analyze", path, "--set", "rod.length=140", "--set", "rod.rule=null").status == 0
    for quality in ("least-ripple", "widest-dwell"):
        path.write_text(HYPOCYCLOID.replace("rod: {rule: osculating}", f"target: {{quality: {quality}}}"))
        assert gearlink("analyze", path, "--format", "json").status == 0


PATH = """kind: geared-five-bar
gears: {module: 2.5, input: 20, output: 20}
links: {input: 20, coupler: 60, follower: 60, output: 20}
phase: 90
coupler_point: {along: 60}
"""
FUNCTION = """kind: geared-five-bar
form: function
gears: {module: 2, planet: 25, sun: 20}
links: {coupler: 18, follower: 40, output: 40, frame: 38}
phase: 154
range: {start: 60, end: 140}
"""


@pytest.mark.parametrize(
    ("text", "old", "new", "code", "key"),
    [
        (PATH, "coupler: 60", "coupler: 20", "GL112", "links"),
        (PATH, "coupler: 60", "coupler: 110", "GL112", "links"),
        (PATH, "output: 20}\nphase", "output: 20, frame: 51}\nphase", "GL112", "links.frame"),
        (PATH, "coupler_point: {along: 60}", "", "GL106", "coupler_point"),
        (PATH, "{input: 20, coupler", "{coupler", "GL106", "links.input"),
        (PATH, ", output: 20}\nlinks", "}\nlinks", "GL106", "gears.output"),
        (PATH, "output: 20}\nlinks", "output: 20, idler: 9}\nlinks", "GL111", "links.frame"),
        (PATH, "output: 20}\nlinks", "output: 20, mesh: internal}\nlinks", "GL111", "gears.output"),
        (PATH, "output: 20}\nlinks", "output: 20, sun: 9}\nlinks", "GL111", "gears"),
        (PATH, "phase: 90", "phase: 90\nrange: {end: 90}", "GL111", "range"),
        (PATH, "phase: 90", "phase: 90\ntarget: {positions: [[0, 1], [2, 3]]}", "GL111", "target.positions"),
        (FUNCTION, "sun: 20", "ring: 20", "GL111", "gears.ring"),
        (FUNCTION, "sun: 20", "sun: 20, ring: 60", "GL111", "gears.sun"),
        (FUNCTION, ", frame: 38", "", "GL106", "links.frame"),
        (FUNCTION, "{start: 60, end: 140}", "{start: 60, end: 50}", "GL111", "range.end"),
        (FUNCTION, "{start: 60, end: 140}", "{start: 0, end: 360}", "GL112", "range"),
        (FUNCTION, "coupler: 18", "coupler: 18, input: 44", "GL112", "links.input"),
        (FUNCTION, "phase: 154", "phase: 154\ntarget: {points: [[0, 1], [2, 3], [4, 5]]}", "GL111", "target.points"),
    ],
)
def test_five_bar_refusals(gearlink, tmp_path, text, old, new, code, key):
    changed = text.replace(old, new)
    assert changed != text
    (error,) = wrong(gearlink, tmp_path, changed)
    assert (error["code"], error["key"]) == (code, key)


def test_opening_five_bar_names_the_worst_angle(gearlink, tmp_path):
    (error,) = wrong(gearlink, tmp_path, PATH.replace("coupler: 60", "coupler: 100"))
    assert "input angle 287.1 deg" in error["message"]
    assert "35.36 mm" in error["message"]


@pytest.mark.slow
def test_five_bar_with_an_idler_has_two_meshes(gearlink, tmp_path):
    path = tmp_path / "design.yaml"
    text = PATH.replace("output: 20}\nlinks", "output: 20, idler: 18}\nlinks").replace(
        "20}\nphase", "20, frame: 80}\nphase"
    )
    path.write_text(text + "limits: {transmission_angle: 0}\n")
    ended = gearlink("analyze", path, "--format", "json", "--plot", "--out", tmp_path)
    assert ended.status == 0, ended.out
    assert ended.json["quantities"]["five_bar_ratio"]["value"] == 1.0
    assert len(ended.json["quantities"]["contact_ratio"]["value"]) == 2
    path.write_text(text.replace("frame: 80", "frame: 100"))
    assert gearlink("analyze", path, "--format", "json").json["errors"][0]["key"] == "links.frame"


def test_table_of_the_other_form_is_refused(gearlink, designs):
    ended = gearlink("analyze", designs / "five_bar_path.yaml", "--table", "function", "--format", "json")
    assert ended.status == 2
    assert "it has path" in ended.json["errors"][0]["message"]


@pytest.mark.slow
def test_five_bar_figure_shows_the_table():
    made, figure = sheet("five_bar_points")
    lines = {line.get_label(): line for axes in figure.axes for line in axes.lines}
    table = made.table("path")
    x = list(table.data[table.columns.index("x")])
    assert list(lines["path of M"].get_xdata()) == [*x, x[0]]
    assert list(lines["required points"].get_xdata()) == [x for x, _ in made.spec.target.points]
