"""`gearlink laws`: constants and curves of the motion laws. Values are compared as printed, to the last bit of the
reference's double where a closed form rounds once, else to 4 ulp."""

from __future__ import annotations

import csv
import io
import json
import math
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from sweeps import ALL

from gearlink.cli.exit_codes import ExitCode
from gearlink.core.parts.cams.law_tables import MotionLaws
from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED, law

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "swing_gripper.json").read_text())
ULP = 2.0**-52


def rows(table: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {row[0]: dict(zip(table["columns"], row, strict=True)) for row in table["rows"]}


def test_every_law_of_the_contract_is_listed(gearlink: Any) -> None:
    tables = gearlink("laws", "--format", "json").json["tables"]
    assert tuple(rows(tables["rest_to_rest"])) == REST_TO_REST
    assert tuple(rows(tables["rest_to_speed"])) == (*REST_TO_SPEED, "quintic 0.5", "septic 0.5")


def test_constants_are_those_of_the_reference(gearlink: Any) -> None:
    found = rows(gearlink("laws", "--format", "json").json["tables"]["rest_to_rest"])
    names = {"poly345": "polynomial-345", "poly4567": "polynomial-4567"}
    for key, constants in REFERENCE["law_constants"].items():
        name = names.get(key, key.replace("_", "-").replace("mcv", "mcv-").replace("mcv--", "mcv-"))
        for column, value in constants.items():
            if column in ("Cv", "Ca", "Cj", "Cm") and str(value) != "inf":
                assert found[name][column] == pytest.approx(float(value), rel=8 * ULP, abs=0.0), (name, column)


def test_kappa_and_jumps(gearlink: Any) -> None:
    tables = gearlink("laws", "--format", "json").json["tables"]
    rest, speed = rows(tables["rest_to_rest"]), rows(tables["rest_to_speed"])
    assert {row["kappa"] for row in rest.values()} == {1.0}
    assert rest["simple-harmonic"]["jumps"] == "at the ends"
    assert {row["jumps"] for name, row in rest.items() if name != "simple-harmonic"} == {"none"}
    assert speed["half-modified-sine"]["kappa"] == pytest.approx(0.568309886183791, rel=1e-14)
    assert speed["half-polynomial-345"]["Ca"] == pytest.approx(1.53960071783900, rel=1e-14)
    assert {row["Cv"] for row in speed.values()} == {1.0}


def test_course_of_a_law(gearlink: Any) -> None:
    tables = gearlink("laws", "--law", "modified-sine", "--samples", "8", "--format", "json").json["tables"]
    assert list(tables) == ["rest_to_rest", "modified-sine"]
    assert tables["modified-sine"]["columns"] == ["x", "s", "v", "a", "j"]
    assert [row[0] for row in tables["modified-sine"]["rows"]] == [k / 8 for k in range(9)]
    for row in tables["modified-sine"]["rows"]:
        assert row[1:] == pytest.approx(law("modified-sine").evaluate(row[0], 3), rel=4 * ULP, abs=4 * ULP * 70)


def test_several_laws_as_a_design_file_writes_them(gearlink: Any) -> None:
    ended = gearlink("laws", "--law", "{scca: [0.25, 0, 0.75, 0]}", "--law", "{quintic: 0.55}", "--format", "json")
    tables = ended.json["tables"]
    assert list(tables) == ["rest_to_rest", "rest_to_speed", "scca [0.25, 0.0, 0.75, 0.0]", "quintic 0.55"]
    assert tables["quintic 0.55"]["rows"][-1][1] == pytest.approx(0.55, rel=4 * ULP, abs=0.0)
    assert len(tables["scca [0.25, 0.0, 0.75, 0.0]"]["rows"]) == 101


def test_csv_and_markdown_hold_the_same_numbers(gearlink: Any) -> None:
    text = gearlink("laws", "--format", "csv").out
    first = next(csv.DictReader(io.StringIO(text)))
    assert first["law"] == "simple-harmonic"
    peak = law("simple-harmonic").peak_velocity
    assert peak == pytest.approx(math.pi / 2, rel=4 * ULP, abs=0.0)
    assert float(first["Cv"]) == peak
    assert repr(peak) in gearlink("laws", "--format", "md").out


def test_table_fits_a_terminal_of_eighty_columns(gearlink: Any) -> None:
    ended = gearlink("laws")
    assert ended.status == 0
    assert max(len(line) for line in ended.out.splitlines()) <= 80
    assert "velocity-mcv-20" in ended.out


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("modifed-sine", "did you mean 'modified-sine'"),
        ("{quintic: 0.7}", "(nearest 0.6)"),
        ("{quintic: 0.5", "never closed"),
        ("{scca: [0.5, 0.5, 0.5, 0]}", "scca"),
        ("half-simple-harmonic", "half-cycloidal"),
    ],
)
def test_wrong_laws_are_refused(gearlink: Any, name: str, words: str) -> None:
    ended = gearlink("laws", "--law", name, "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    (error,) = ended.json["errors"]
    assert words in f"{error['message']}; {error.get('help', '')}"
    assert error["file"] == "<--law>"


def test_plot_is_written_and_reproducible(gearlink: Any, tmp_path: Path) -> None:
    folders = ["one", *(["two"] if ALL else [])]
    for folder in folders:
        out = tmp_path / folder
        ended = gearlink("laws", "--law", "velocity-345", "--plot", "--plot-format", "svg", "--out", out)
        assert ended.status == 0
        assert f"wrote {out / 'motion-laws.svg'}" in ended.err
    one, *again = ((tmp_path / folder / "motion-laws.svg").read_bytes() for folder in folders)
    assert all(other == one for other in again)


def test_plotted_curves_are_the_laws(monkeypatch: pytest.MonkeyPatch) -> None:
    from gearlink.cli.views.figures.motion_laws import draw
    from gearlink.core.parts.cams.law_tables import LawChoice

    chosen = (law("cycloidal"), law("half-modified-sine"))
    figure = draw(MotionLaws(LawChoice(chosen)))
    assert len(figure.axes) == 8
    for column, each in enumerate(chosen):
        for order in range(4):
            line = figure.axes[2 * order + column].lines[0]
            x, y = line.get_data()
            assert (y == each.evaluate(x, 3)[order]).all()


def test_an_unwritable_folder_is_told(gearlink: Any, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    ended = gearlink("laws", "--plot", "--out", tmp_path / "file")
    assert ended.status == ExitCode.WRONG_INPUT
    assert "cannot write" in ended.err


# A design file

QUIET = """kind: motion-law
law: {type: optimal, minimize: residual, band: [2, 3], degree: 11, acceleration: 7, jerk: 120}
stroke: 20
time: 12
frequency: 220
"""


def test_a_law_of_a_file_with_its_proof(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "quiet.yaml"
    path.write_text(QUIET)
    found = gearlink("laws", str(path), "--format", "json").json
    quantities = {name: each["value"] for name, each in found["quantities"].items()}
    assert quantities["periods"] == pytest.approx(2.64, rel=1e-12)
    assert quantities["lower_bound"] < quantities["residual"] < quantities["lower_bound"] * (1.0 + 1e-3)
    assert quantities["residual_at_design"] <= quantities["residual"]
    assert quantities["follower_velocity_max"] == pytest.approx(quantities["peak_velocity"] * 20.0 / 0.012, rel=1e-12)
    assert quantities["degree"] == 11
    assert [check["code"] for check in found["checks"]] == ["GL517"]
    assert [len(found["tables"][name]["rows"]) for name in ("law", "residual", "coefficients")] == [101, 101, 12]
    assert gearlink("analyze", str(path), "--format", "json").json["quantities"] == found["quantities"]


@pytest.mark.slow
def test_a_solved_law_is_saved_and_read_without_a_solver(gearlink: Any, tmp_path: Path) -> None:
    path, saved = tmp_path / "quiet.yaml", tmp_path / "solved.yaml"
    path.write_text(QUIET)
    first = gearlink("laws", str(path), "--save", str(saved), "--format", "json").json
    again = gearlink("laws", str(saved), "--format", "json").json
    for name in ("peak_velocity", "peak_acceleration", "peak_jerk", "kappa", "residual_at_design"):
        assert again["quantities"][name]["value"] == first["quantities"][name]["value"], name
    assert "gap" not in again["quantities"]
    code = f"import sys; from gearlink.cli.main import main; sys.argv[1:] = ['laws', {str(saved)!r}]; main()"
    watch = "import atexit, sys; atexit.register(lambda: print(*({'scipy', 'highspy'} & {*sys.modules})))"
    done = subprocess.run([sys.executable, "-c", f"{watch}; {code}"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == ""


@pytest.mark.parametrize(
    ("law_", "key"),
    [
        ("{type: polydyne, periods: 0.4}", "law.periods"),
        ("{type: optimal, minimize: acceleration, jerk: 30}", "law.jerk"),
        ("{type: optimal, minimize: jerk, acceleration: 4}", "law.acceleration"),
        ("{type: optimal, minimize: jerk, velocity: 1}", "law.velocity"),
        ("{type: optimal, minimize: jerk, acceleration: 4.1}", "law"),
        ("{type: optimal, minimize: residual, band: [2, 4]}", "law.acceleration"),
        ("{type: optimal, minimize: jerk, degree: 8}", "law.degree"),
        ("{type: optimal, minimise: jerk}", "law.minimise"),
        ("{type: bernstein, acceleration: [0, 1, 0]}", "law.acceleration"),
    ],
)
def test_wrong_laws_of_files_are_located(gearlink: Any, tmp_path: Path, law_: str, key: str) -> None:
    path = tmp_path / "law.yaml"
    path.write_text(f"kind: motion-law\nlaw: {law_}\n")
    ended = gearlink("laws", str(path), "--format", "json")
    assert ended.status == ExitCode.WRONG_INPUT
    errors = {error["key"]: error for error in ended.json["errors"]}
    assert key in errors
    assert errors[key]["line"] == 2


def test_polydyne_of_few_periods_is_warned_of(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "law.yaml"
    path.write_text("kind: motion-law\nlaw: {type: polydyne, periods: 0.8}\n")
    (check,) = gearlink("laws", str(path), "--format", "json").json["checks"]
    assert (check["code"], check["status"]) == ("GL518", "warn")


@pytest.mark.slow
def test_chart_of_what_laws_leave(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "quiet.yaml"
    path.write_text(QUIET)
    table = gearlink("chart", "residual", str(path), "--format", "json").json["tables"]["law"]
    assert table["columns"] == [
        "speed",
        "periods",
        "optimal residual 11",
        "cycloidal",
        "modified-sine",
        "polynomial-4567",
    ]
    assert [table["rows"][k][0] for k in (0, -1)] == pytest.approx([0.5, 1.3], rel=1e-12)
    ended = gearlink("chart", "residual", str(path), "--plot", "--plot-format", "svg", "--out", str(tmp_path))
    assert "quiet-residual-chart.svg" in ended.err
    for line, words in (
        (("chart", "residual"), "gearlink chart residual SPEC"),
        (("chart", "residual", "designs/gear_pair.yaml"), "has no motion laws"),
        (("chart", "residual", "designs/lift_cam.yaml"), "natural periods"),
    ):
        ended = gearlink(*line)
        assert ended.status == ExitCode.WRONG_INPUT
        assert words in " ".join(ended.err.split())


def test_options_of_files_go_with_files(gearlink: Any) -> None:
    for arguments in (
        ("--save", "x.yaml"),
        ("--set", "law.degree=9"),
        ("designs/quiet_law.yaml", "--law", "cycloidal"),
    ):
        assert gearlink("laws", *arguments).status == ExitCode.WRONG_INPUT
