"""The commands tolerance and register at the command line: options, exit statuses, places of errors, batch."""

from __future__ import annotations

import json
from concurrent.futures import BrokenExecutor, Executor, Future
from pathlib import Path
from typing import Any

import pytest
from sweeps import ALL

from gearlink.cli.parallel import shares
from gearlink.cli.parallel.shares import Watch

DESIGN = """\
kind: three-gear-four-bar
gears: {module: 2, crank: 40, idler: 72, output: 40}
links: {crank: 38.942, frame: 153.530}
tolerance:
  sources:
    links.crank: {plus_minus: 0.02}
    links.frame: {plus_minus: 0.02}
  require: [back_step_angle <= 20.4 deg]
"""


@pytest.fixture
def spec(tmp_path: Path) -> Path:
    path = tmp_path / "feed.yaml"
    path.write_text(DESIGN)
    return path


@pytest.mark.slow
def test_options_are_keys_of_the_section(gearlink: Any, spec: Path) -> None:
    line = ["tolerance", str(spec), "--samples", "100", "--seed", "7", "--worst-case", "--sobol", "--format", "json"]
    ended = gearlink(*line)
    status, out = ended.status, ended.out
    found = json.loads(out)
    assert status == 0
    assert found["quantities"]["samples"]["value"] == 128
    assert found["quantities"]["seed"]["value"] == 7
    assert set(found["tables"]) == {"quantities", "requirements", "contributions", "corners"}
    columns = found["tables"]["contributions"]["columns"]
    assert all(row[columns.index("total")] is not None for row in found["tables"]["contributions"]["rows"])
    if ALL:
        assert gearlink(*line).out == out


def test_a_missed_target_fails(gearlink: Any, spec: Path) -> None:
    line = ["tolerance", str(spec), "--samples", "512", "--set", "tolerance.target_yield=0.9999", "--format", "json"]
    ended = gearlink(*line)
    status, out = ended.status, ended.out
    (check,) = [check for check in json.loads(out)["checks"] if check["code"] == "GL179"]
    assert (status, check["status"]) == (1, "fail")
    assert "--samples" in check["fix"]


@pytest.mark.slow
def test_the_verdict_says_whether_the_yield_is_part_of_it(gearlink: Any, spec: Path) -> None:
    line = ["tolerance", spec, "--samples", "64", "--set"]
    without = gearlink(*line, "tolerance.target_yield=null").out
    assert "checks of the nominal design (no tolerance.target_yield): " in without
    assert "checks of the nominal design and of the yield: " in gearlink(*line, "tolerance.target_yield=0.5").out


@pytest.mark.slow
def test_a_quoted_key_is_one_step_of_a_path(gearlink: Any, spec: Path) -> None:
    key = 'tolerance.sources."links.crank".plus_minus'
    line = ["tolerance", str(spec), "--samples", "512", "--format", "json"]
    wide = json.loads(gearlink(*line, "--set", f"{key}=0.2").out)["tables"]["quantities"]["rows"][0]
    narrow = json.loads(gearlink(*line).out)["tables"]["quantities"]["rows"][0]
    assert wide[5] > 5.0 * narrow[5]


@pytest.mark.parametrize(
    ("old", "new", "code", "place"),
    [
        ("links.frame:", "links.frme:", "GL170", (7, 5)),
        ("plus_minus: 0.02}\n  require", "plus_minus: 0.02, cp: 1, cpk: 2}\n  require", "GL172", (7, 5)),
        ("{plus_minus: 0.02}\n    links.frame", "{limits: [1, 1]}\n    links.frame", "GL171", (6, 5)),
        ("back_step_angle", "back_stp_angle", "GL152", (8, 13)),
        ("  req", "  correlated: [{sources: [links.crank, links.frame], rho: 1.2}]\n  req", "GL176", (8, 54)),
    ],
)
def test_errors_have_a_place(gearlink: Any, spec: Path, old: str, new: str, code: str, place: tuple[int, int]) -> None:
    spec.write_text(DESIGN.replace(old, new))
    ended = gearlink("tolerance", str(spec), "--samples", "64", "--format", "json")
    status, out = ended.status, ended.out
    error = json.loads(out)["errors"][0]
    assert (status, error["code"], error["line"], error["column"]) == (2, code, *place)


def test_without_the_section_there_is_nothing_to_study(gearlink: Any, spec: Path) -> None:
    spec.write_text(DESIGN[: DESIGN.index("tolerance:")])
    for command in ("tolerance", "register"):
        ended = gearlink(command, str(spec), "--format", "json")
        status, out = ended.status, ended.out
        assert (status, json.loads(out)["errors"][0]["code"]) == (2, "GL113")


@pytest.mark.slow
def test_a_batch_runs_them_on_request_alone(gearlink: Any, spec: Path) -> None:
    def commands(*more: str) -> list[str]:
        out = gearlink("batch", str(spec), "--jobs", "1", "--format", "json", *more).out
        return [result["command"] for result in json.loads(out)["designs"]]

    assert commands() == ["analyze"]
    more = ("--with", "register", "--with", "tolerance", "--set", "tolerance.samples=64")
    assert commands(*more) == ["analyze", "register", "tolerance"]


def test_register_gives_the_cycle_beside_the_budget(gearlink: Any, spec: Path) -> None:
    tables = json.loads(gearlink("register", str(spec), "--samples", "24", "--format", "json").out)["tables"]
    assert list(tables) == ["budget", "cycle"]
    assert tables["cycle"]["columns"] == ["torque_sign", "input_angle", "worst", "band"]
    assert len(tables["cycle"]["rows"]) == 2 * 360


def test_register_at_an_angle_is_absolute(gearlink: Any, spec: Path) -> None:
    ended = gearlink("register", str(spec), "--at", "270", "--format", "json")
    status, out = ended.status, ended.out
    found = json.loads(out)["quantities"]
    # frame 1.3708 and crank 0.3477 (the theory's gains at 270 deg), +-0.02 each
    assert status == 0
    assert found["worst"]["value"][0] == pytest.approx(0.02 * (1.3708 + 0.3477), abs=3e-6)


PAIR = """\
kind: gear-pair
module: 4
teeth: [23, 41]
center_distance: 129.5
tolerance: {sources: {center_distance: {plus_minus: 0.03}}, samples: 32, sobol: true}
"""


@pytest.mark.slow
def test_the_same_bytes_by_whatever_computes(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "pair.yaml"
    path.write_text(PAIR)
    line = ["tolerance", str(path), "--format", "json"]
    means = (["--jobs", "1"], ["--jobs", "2"])
    ended = [gearlink(*line, *more) for more in means]
    assert [one.status for one in ended] == [0, 0]
    assert len({one.out for one in ended}) == 1


@pytest.mark.slow
def test_samples_of_a_register_are_the_same_by_whatever_computes(gearlink: Any, spec: Path) -> None:
    line = ["register", str(spec), "--method", "mc", "--samples", "256", "--format", "json"]
    means = (["--jobs", "1"], ["--jobs", "2"])
    ended = [gearlink(*line, *more) for more in means]
    assert [one.status for one in ended] == [0, 0]
    assert len({one.out for one in ended}) == 1


@pytest.mark.parametrize(
    ("requirement", "told"),
    [
        ("dwell_crank_angles[5] <= 3 deg", "counted from 0, the last is dwell_crank_angles[1]"),
        ("back_step_angle[0] <= 3 deg", "use back_step_angle"),
        ("dwell_swing[0] <= 3 deg", "use dwell_swing"),
        ("dwell_crank_angles <= 3 deg", "use one of them"),
        ("tolerance_dwell_angle >= 3 deg", "does not apply to the nominal design"),
        ("frame_ratio_interval[0] >= 3", "the nominal design does not give it"),
        ("dwell_swing == 3 deg", "compare it by >= and <="),
    ],
)
def test_a_requirement_that_nothing_can_meet_is_an_error_at_its_line(
    gearlink: Any, spec: Path, requirement: str, told: str
) -> None:
    spec.write_text(DESIGN.replace("back_step_angle <= 20.4 deg", f'"{requirement}"'))
    ended = gearlink("tolerance", str(spec), "--samples", "64")
    assert ended.status == 2
    assert "GL152" in ended.err
    assert f"{spec}:8:13:" in ended.err
    assert "^" in ended.err
    assert told in ended.err


def test_shares_of_a_worker_that_ends_are_computed_here(capsys: pytest.CaptureFixture[str]) -> None:
    class Dying(Executor):
        def submit(self, function: Any, /, *line: Any, **_: Any) -> Any:
            future: Any = Future()
            if line[0] % 2:
                future.set_exception(BrokenExecutor("killed"))
            else:
                future.set_result(function(*line))
            return future

    done: list[int] = []
    watch = Watch(4, 1, done.append, quiet=False)
    assert shares._given(Dying(), abs, [0, 1, 2, 3], watch) == [0, 1, 2, 3]
    assert sum(done) == 4
    assert "killed" in capsys.readouterr().err


@pytest.mark.slow
def test_the_page_of_a_file_with_tolerances_shows_budget_and_samples(gearlink: Any, spec: Path, tmp_path: Path) -> None:
    ended = gearlink("report", str(spec), "--set", "register.tolerance=0.5", "--out", str(tmp_path))
    page = (tmp_path / "feed.html").read_text()
    assert ended.status == 0
    assert "<h2>register</h2>" in page
    assert "GL520" in page
    assert "<h2>tolerance</h2>" in page
    assert "output angle: designs as manufactured over the cycle" in page


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("sources", "told"),
    [
        ("gears.idler: {grade: 6, width: 20}", ""),  # it counts in `register` alone
        ("links.crak: {plus_minus: 0.02}", "GL170"),
    ],
)
@pytest.mark.usefixtures("small_pictures")
def test_a_page_has_no_samples_where_nothing_scatters(
    gearlink: Any, spec: Path, tmp_path: Path, sources: str, told: str
) -> None:
    spec.write_text(DESIGN[: DESIGN.index("tolerance:")] + f"tolerance: {{sources: {{{sources}}}}}\n")
    ended = gearlink("report", str(spec), "--out", str(tmp_path))
    assert ended.status == (2 if told else 0)
    assert told in ended.err
    if not told:
        assert "<h2>tolerance</h2>" not in (tmp_path / "feed.html").read_text()


@pytest.mark.parametrize("at", ["nan", "abc", "zone", "1e999", ""])
def test_a_place_that_is_none_is_refused_as_that_of_its_option(gearlink: Any, spec: Path, at: str) -> None:
    ended = gearlink("register", str(spec), "--at", at)
    assert ended.status == 2
    assert ended.err.startswith("<--at>:1:1: error GL112: no position ")
    assert "give dwell or an input angle" in ended.err
    ended = gearlink("register", str(spec), "--set", f"register.at={at or repr(at)}", "--format", "json")
    assert [(each["file"], each["key"]) for each in ended.json["errors"]] == [("<--set>", "register.at")]


def test_an_option_is_not_at_fault_for_what_its_section_lacks(gearlink: Any, designs: Path) -> None:
    ended = gearlink("tolerance", designs / "candy_feed.yaml", "--samples", "64", "--format", "json")
    assert ended.status == 2
    assert [each["file"] for each in ended.json["errors"]] == [str(designs / "candy_feed.yaml")]


@pytest.mark.slow
def test_estimates_stand_with_their_intervals_on_a_terminal(gearlink: Any, spec: Path) -> None:
    out = gearlink("tolerance", str(spec), "--samples", "512", "--all").out
    assert " +-0.0" in out
    assert "mean_pm" not in out
    assert max(map(len, out.splitlines())) <= 80
    assert "mean_pm" in gearlink("tolerance", str(spec), "--samples", "512", "--format", "csv").out


@pytest.mark.slow
def test_a_word_alone_scatters_nothing(gearlink: Any, spec: Path) -> None:
    ended = gearlink("tolerance", str(spec), "--samples", "64", "--set", "tolerance.require=[motion == back-step]")
    assert ended.status == 0
    assert "motion == back-step" in ended.out


UNKNOWN_NAMES = [
    ("candy_feed_tolerances", 'tolerance.sources."pins.Q".clearance=[0,0.1]', "GL170", "pin 'Q': it has A, B, C, D"),
    (
        "candy_feed_tolerances",
        'tolerance.sources."centers.x".plus_minus=1',
        "GL170",
        "it has crank_idler, idler_output",
    ),
    ("candy_feed_tolerances", 'tolerance.sources."gears.x".eccentricity=1', "GL170", "it has crank, idler, output"),
    (
        "candy_feed_tolerances",
        'tolerance.sources."links.x".plus_minus=1',
        "GL170",
        "'links.x' is not a key with a number",
    ),
    ("candy_feed_tolerances", "tolerance.require=[bak_step_angle < 1]", "GL152", "bak_step_angle"),
    ("candy_feed_tolerances", "register.backlash={mesh_9: 1}", "GL112", "no mesh 'mesh_9': there are crank_idler"),
    ("candy_feed_tolerances", "register.at=zone", "GL112", "no position 'zone' here; give dwell or"),
    ("ty460_register", 'tolerance.sources."pins.Q".clearance=[0,0.1]', "GL170", "pin 'Q': it has A, B, C, D, E, F"),
    ("ty460_register", "register.backlash.mesh_9=1", "GL112", "there are mesh_12, mesh_34, rack_lower, rack_upper"),
    (
        "barrel_cam",
        'tolerance.sources."pins.D".clearance=[0,0.1]',
        "GL170",
        "play of pins is not computed for it",
    ),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "setting", "code", "words"), UNKNOWN_NAMES)
def test_names_that_the_design_does_not_have_are_refused_by_check_and_batch(
    gearlink: Any, tmp_path: Path, designs: Path, name: str, setting: str, code: str, words: str
) -> None:
    path = designs / f"{name}.yaml"
    ended = gearlink("check", path, "--set", setting, "--format", "json")
    (found,) = [one for one in ended.json["findings"] if one["status"] == "error"]
    assert (ended.status, found["code"], found["file"]) == (2, code, "<--set>")
    assert words in "; ".join(filter(None, (found["message"], found.get("help"))))
    (tmp_path / "one.yaml").write_text(path.read_text())
    ended = gearlink("batch", tmp_path, "-j", "1", "--set", setting)
    assert ended.status == 2
    assert code in ended.out + ended.err


@pytest.mark.parametrize(
    ("key", "help"),
    [
        ('"links.crnk"', "help: did you mean links.crank?"),
        ("links.crank", "by the full path of its key: links.crank,"),
    ],
)
def test_a_source_that_is_slightly_wrong_is_told_the_right_name(gearlink: Any, spec: Path, key: str, help: str) -> None:
    ended = gearlink("tolerance", spec, "--set", f"tolerance.sources.{key}={{plus_minus: 0.1}}")
    assert ended.status == 2
    assert help in " ".join(ended.err.split())


def test_every_name_that_is_unknown_is_said_at_its_line(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "feed.yaml"
    path.write_text(
        DESIGN.replace("  require", "    pins.Q: {clearance: [0, 0.1]}\n    centers.x: {plus_minus: 1}\n  require")
    )
    ended = gearlink("check", path)
    assert ended.status == 2
    assert "feed.yaml:8:5: error GL170: this design has no pin 'Q'" in ended.out + ended.err
    assert "feed.yaml:9:5: error GL170: this design has no centre distance 'x'" in ended.out + ended.err
    assert gearlink("tolerance", path).err.count("error GL170") == 2


def test_candidates_are_not_offered_where_there_are_none(gearlink: Any, spec: Path, designs: Path) -> None:
    """Neither of these commands has any; where a command may have some, the option that was given is named."""
    for command in ("tolerance", "register"):
        assert "--candidates" not in gearlink(command, "--help").out
    ended = gearlink("loads", designs / "loaded_feed.yaml", "--candidates")
    assert ended.status == 2
    assert ended.err.startswith("<--candidates>:1:1: error GL115: `loads` has no values to be chosen")
