"""The door for Python: what `import gearlink` gives, how little it costs, and where its errors point.

Numbers that the door gives are those of the engine, so they are compared for equality.
"""

from __future__ import annotations

import copy
import json
import math
import pickle
import subprocess
import sys
import traceback
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import QUICK
from sweeps import ALL

import gearlink
from gearlink.core.base.kinds import KINDS

CRANK = {"kind": "slider-crank", "stroke": 310, "rod": 520, "offset": 50}
PAIR = {"kind": "gear-pair", "module": 4, "teeth": (72, 72), "center_distance": 290.2912330746487}


def loaded_after(code: str) -> set[str]:
    """Modules that a fresh interpreter has imported after some code."""
    command = [sys.executable, "-c", f"{code}; import json, sys; print(json.dumps(sorted(sys.modules)))"]
    return set(json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout))


def test_import_costs_one_module() -> None:
    assert {m for m in loaded_after("import gearlink") - loaded_after("pass") if not m.startswith("__editable__")} == {
        "gearlink"
    }


@pytest.mark.slow
def test_numbers_need_no_numpy() -> None:
    code = f"import gearlink; gearlink.design(**{CRANK}).crank_length"
    assert not {"numpy", "scipy", "matplotlib", "typer", "rich"} & loaded_after(code)


def test_load_gives_what_the_file_asks_for(designs: Path) -> None:
    assert gearlink.load(designs / "candy_feed.yaml").dwell_angle == math.radians(135)
    assert type(gearlink.load(designs / "candy_feed.yaml")).__name__ == "DwellSynthesis"
    press = gearlink.load(designs / "ty460.yaml")
    quantity = press.quantity("crank_length")
    assert quantity is not None
    assert (quantity.value, quantity.unit) == (press.crank_length, "mm")
    assert press.spec.name == "TY-460"


def test_values_are_put_over_the_file(designs: Path) -> None:
    press = gearlink.load(designs / "ty460.yaml", {"bed.stroke": 600, "cam.return_law": "modified-sine"})
    assert press.spec.bed.stroke == 600
    assert press.spec.cam.return_law == "modified-sine"


def test_design_by_keywords_is_the_design_of_a_file(tmp_path: Path) -> None:
    path = tmp_path / "crank.yaml"
    path.write_text(json.dumps(CRANK))
    assert gearlink.design(**CRANK).crank_length == gearlink.load(path).crank_length
    assert gearlink.design(**CRANK).spec.name == "design"


def test_tuples_and_numpy_are_lists_and_numbers() -> None:
    pair = gearlink.design(**{**PAIR, "teeth": np.array([72, 72]), "module": np.float64(4.0)})
    assert pair.working_pressure_angle == gearlink.design(**PAIR).working_pressure_angle


def test_changed_leaves_the_design_as_it_is(designs: Path) -> None:
    crank = gearlink.load(designs / "ty460_slider_crank.yaml")
    before = crank.crank_length
    other = gearlink.changed(gearlink.changed(crank, {"stroke": 320}), {"rod": 530})
    assert (other.spec.stroke, other.spec.rod, crank.spec.stroke) == (320, 530, 310)
    assert other.crank_length != before == crank.crank_length


def test_a_command_of_another_kind_is_refused(designs: Path) -> None:
    with pytest.raises(gearlink.GearlinkError, match="this design has no command named 'gripper'"):
        gearlink.load(designs / "ty460.yaml").report("gripper")


@pytest.mark.parametrize(
    ("ask", "near"),
    [
        (lambda made: made.report("analyse"), "nearest: analyze"),
        (lambda made: made.quantity("velocity_maxx"), "nearest: velocity_max, slider_velocity_max, velocity_min"),
        (lambda made: made.table("motio"), "nearest: motion"),
        (lambda made: made.report("gripper"), "known: crank, analyze"),
    ],
)
def test_an_unknown_name_leads_to_the_nearest(ask: Any, near: str) -> None:
    """As on the command line."""
    with pytest.raises(gearlink.GearlinkError, match=near):
        ask(gearlink.design(**CRANK))


def test_a_design_shows_its_kind_and_name() -> None:
    assert repr(gearlink.design(**CRANK)) == "<slider-crank 'design'>"


def test_only_what_the_door_made_can_be_changed() -> None:
    kind = KINDS["slider-crank"]
    bare = kind.design_class("crank")(kind.spec_model()(**CRANK))
    with pytest.raises(TypeError, match=r"gearlink\.load"):
        gearlink.changed(bare, {"stroke": 300})


def test_every_quantity_is_an_attribute(designs: Path) -> None:
    for path in (path for path in sorted(designs.glob("*.yaml")) if ALL or path.stem in QUICK):
        made = gearlink.load(path)
        for name in made.quantity_names():
            if "." not in name:
                assert hasattr(type(made), name) or name in dir(made), (path.name, name)


class TestErrors:
    def test_wrong_key_has_its_place(self, tmp_path: Path) -> None:
        path = tmp_path / "wrong.yaml"
        path.write_text("kind: slider-crank\nstroke: 310\nrood: 520\n")
        with pytest.raises(gearlink.GearlinkError, match="unknown key 'rood'") as caught:
            gearlink.load(path)
        error = caught.value
        assert (error.file, error.line, error.column, error.key) == (str(path), 3, 1, "rood")
        assert [d.line for d in error.diagnostics] == [3]

    def test_refusal_has_its_place(self, tmp_path: Path) -> None:
        path = tmp_path / "long.yaml"
        path.write_text("kind: slider-crank\nstroke: 1100\nrod: 520\n")
        crank = gearlink.load(path)
        with pytest.raises(gearlink.NoSolution, match="stroke: 1100 mm") as caught:
            _ = crank.crank_length
        error = caught.value
        assert (error.file, error.line, error.column, error.key) == (str(path), 2, 1, "stroke")

    def test_unknown_kind_and_command(self) -> None:
        with pytest.raises(gearlink.GearlinkError, match="did you mean gear-pair"):
            gearlink.design(kind="gear-pear")
        with pytest.raises(gearlink.GearlinkError, match="does not apply"):
            gearlink.design("press", **CRANK)

    def test_a_kind_instead_of_the_command(self) -> None:
        with pytest.raises(TypeError, match="write kind='gear-pair'"):
            gearlink.design("gear-pair", module=3)

    @pytest.mark.parametrize("name", ["stroke", "crank_length", "spec"])
    def test_what_a_design_has_cannot_be_set(self, name: str) -> None:
        """A result that was computed before would not follow; a note of one's own may be put beside it."""
        crank = gearlink.design(**CRANK)
        before = crank.crank_length
        with pytest.raises(AttributeError, match=rf"^{name}: .*gearlink\.changed"):
            setattr(crank, name, 5.0)
        crank.remark = "mine"
        assert (crank.crank_length, crank.remark) == (before, "mine")

    def test_no_such_name(self) -> None:
        with pytest.raises(AttributeError, match="'loaad'"):
            gearlink.loaad  # noqa: B018


class TestValues:
    """What a script may put into a design, and what it may not."""

    @pytest.mark.parametrize(
        "stroke",
        [320, np.int8(100), np.float32(320.5), np.longdouble(320), np.array(320.0), Decimal("320.5"), Fraction(641, 2)],
    )
    def test_numbers_of_every_type(self, stroke: Any) -> None:
        crank = gearlink.changed(gearlink.design(**CRANK), {"stroke": stroke})
        assert crank.spec.stroke == float(stroke)
        assert gearlink.design(**{**CRANK, "stroke": stroke}).crank_length == crank.crank_length

    @pytest.mark.parametrize("value", [b"320", Path("x"), {1}, 1j, object(), int, [[object()]]])
    def test_what_no_file_holds(self, value: Any) -> None:
        for attempt in (
            lambda: gearlink.design(**{**CRANK, "stroke": value}),
            lambda: gearlink.changed(gearlink.design(**CRANK), {"stroke": value}),
        ):
            with pytest.raises(
                gearlink.GearlinkError, match=r"'stroke' is of type .* no design file can hold"
            ) as caught:
                attempt()
            assert caught.value.key == "stroke"

    def test_what_has_no_end(self) -> None:
        loop: dict[str, Any] = {}
        loop["x"] = loop
        deep: list[Any] = []
        for _ in range(100_000):
            deep = [deep]
        for value in (loop, deep):
            with pytest.raises(gearlink.GearlinkError, match="'stroke' contains itself"):
                gearlink.design(**{**CRANK, "stroke": value})

    def test_what_is_no_mapping_no_path_no_command(self) -> None:
        crank = gearlink.design(**CRANK)
        wrong: Any
        for wrong in ("stroke=320", [("stroke", 320)], {3: 320}):
            with pytest.raises(TypeError, match=r"mapping of paths|a path in a design file is text"):
                gearlink.changed(crank, wrong)
        with pytest.raises(gearlink.GearlinkError, match="is not a path"):
            gearlink.changed(crank, {"stroke=3": 20})
        with pytest.raises(TypeError, match="a command is text, such as 'crank', not list"):
            gearlink.design(["crank"], **CRANK)  # type: ignore[arg-type]

    def test_paths_of_bytes(self, designs: Path) -> None:
        path: Any = str(designs / "ty460_slider_crank.yaml").encode()
        assert gearlink.load(path).spec.stroke == 310

    def test_changes_without_end_leave_no_trace(self) -> None:
        """An optimisation changes the same keys of its best design thousands of times."""
        crank, sizes = gearlink.design(**CRANK), []
        for stroke in range(200, 300):
            crank = gearlink.changed(crank, {"stroke": stroke, "limits.transmission_angle": 40 + stroke / 1000})
            sizes.append(len(pickle.dumps(crank)))
        assert sizes[-1] < 1.1 * sizes[0]
        assert (crank.spec.stroke, crank.spec.limits.transmission_angle) == (299, 40.299)


class TestNames:
    def test_one_name_may_stand_alone(self, designs: Path) -> None:
        report = gearlink.load(designs / "ty460_slider_crank.yaml").report(
            "crank", quantities="crank_length", tables="motion", samples=5
        )
        assert [q.name for q in report.quantities] == ["crank_length"]
        assert [(t.name, t.length) for t in report.tables] == [("motion", 5)]

    @pytest.mark.parametrize("name", [3, None, ["crank_length"], b"crank_length", math.nan])
    def test_names_that_are_none(self, name: Any) -> None:
        crank = gearlink.design(**CRANK)
        for ask in (crank.quantity, crank.table, crank.report, lambda name: gearlink.figure(crank, name or "")):
            with pytest.raises(gearlink.GearlinkError, match="this design has no"):
                ask(name)

    def test_a_check_that_is_none_names_those_there_are(self) -> None:
        """It was an AttributeError about `check_nosuch`."""
        crank = gearlink.design(**CRANK)
        with pytest.raises(gearlink.GearlinkError, match="no check named 'nosuch'; known: transmission-angle"):
            crank.check("nosuch")
        with pytest.raises(gearlink.GearlinkError, match="names are text"):
            crank.check(3)
        assert crank.check("transmission-angle")

    @pytest.mark.parametrize("value", [math.nan, math.inf, np.float64("nan"), [1.0, -math.inf]])
    def test_numbers_that_are_not_finite(self, value: Any) -> None:
        """They were "not a number, but 'NaN'"."""
        for make in (lambda: gearlink.design(**{**CRANK, "stroke": value}),
                     lambda: gearlink.changed(gearlink.design(**CRANK), {"stroke": value})):  # fmt: skip
            with pytest.raises(gearlink.GearlinkError, match="'stroke' is or contains a number that is not finite"):
                make()

    @pytest.mark.parametrize("samples", [0, 1, -5, 2.5, "36", True, 10**9, 10**30, math.nan])
    def test_rows_that_no_table_has(self, samples: Any) -> None:
        with pytest.raises(gearlink.GearlinkError, match="a whole one from 2 to 10000000, not"):
            gearlink.design(**CRANK).table("motion", samples=samples)

    def test_small_integers_of_numpy_do_not_overflow(self, designs: Path) -> None:
        for name in ("ty460", "wide_swing_cycle"):
            made: Any = gearlink.load(designs / f"{name}.yaml")
            rows: Any = np.int8(100)
            table = made.table_names()[0]
            assert made.table(table, samples=rows).rows() == made.table(table, samples=100).rows()

    def test_figure_takes_commands_and_designs(self) -> None:
        with pytest.raises(gearlink.GearlinkError, match="no command named 'gripper'"):
            gearlink.figure(gearlink.design(**CRANK), "gripper")
        with pytest.raises(TypeError, match=r"gearlink\.load"):
            gearlink.figure(3)  # type: ignore[arg-type]


def test_table_columns_are_arrays(designs: Path) -> None:
    table = gearlink.load(designs / "ty460.yaml").table("positions", samples=36)
    assert table["input_angle"].shape == (36,)
    assert isinstance(table["bed_velocity"], np.ndarray)
    with pytest.raises(KeyError, match="the columns are"):
        table["bed"]


def test_notebooks_show_reports_and_tables(designs: Path) -> None:
    report = gearlink.load(designs / "ty460.yaml").report("press")
    html = report._repr_html_()
    assert html.count("<table>") == 2 + len(report.tables)
    assert "crank_length" in html
    assert "GL303 transmission-angle" in html
    hostile = gearlink.design(**{**CRANK, "name": "<script>"}).report("crank")
    assert "<script>" not in hostile._repr_html_()


def test_prompts_show_what_reports_and_tables_hold(designs: Path) -> None:
    """All columns and findings filled the screen."""
    press = gearlink.load(designs / "ty460.yaml")
    table, report = press.table("positions"), press.report("press")
    assert repr(table) == f"<table positions: 12 rows of {', '.join(table.columns)}>"
    held = f"{len(report.quantities)} quantities, {len(report.checks)} checks, tables positions"
    assert repr(report) == f"<report of press, flatbed-press 'TY-460': {held}>"
    many = press.table_in_parts("positions", 200_000)
    assert repr(many).startswith("<table positions: rows in parts of input_angle, ")


def test_long_tables_show_their_ends(designs: Path) -> None:
    table = gearlink.load(designs / "ty460.yaml").table("positions", samples=360)
    assert table._repr_html_().count("<tr>") == 1 + 10 + 1 + 10


@pytest.mark.slow
def test_figure_is_the_sheet(designs: Path) -> None:
    figure = gearlink.figure(gearlink.load(designs / "ty460_slider_crank.yaml"))
    assert figure.axes
    assert figure._repr_png_().startswith(b"\x89PNG")  # notebooks showed a line of text without pyplot


def test_kernels_stand_in_their_packages() -> None:
    from gearlink.core.parts.cams import law
    from gearlink.core.parts.gears import GearPair
    from gearlink.core.parts.linkages import FourBar

    assert GearPair.from_shift(4.0, (72, 72)).contact_ratio > 1.0
    assert FourBar(18.0, 50.0, 100.0, 121.4).kind() == "crank-rocker"
    assert law("modified-sine").evaluate(1.0, 0)[0] == 1.0


def test_designs_travel_between_processes(designs: Path) -> None:
    crank: Any = pickle.loads(pickle.dumps(gearlink.load(designs / "ty460_slider_crank.yaml")))
    assert crank.crank_length == gearlink.load(designs / "ty460_slider_crank.yaml").crank_length


def test_a_refusal_asked_for_again_does_not_grow(designs: Path) -> None:
    """A kept error that is raised itself keeps every function that it ever passed, and what these held."""
    belt = gearlink.load(designs / "belt_feed.yaml", {"dwell.window": 300})
    ways, words = [], set()
    for _ in range(5):
        with pytest.raises(gearlink.NoSolution) as caught:
            _ = belt.idler_teeth
        ways.append(len(traceback.extract_tb(caught.value.__traceback__)))
        words.add((str(caught.value), caught.value.key, caught.value.line))
    assert len(set(ways[1:])) == len(words) == 1


def test_errors_travel_between_processes() -> None:
    crank = gearlink.design(**CRANK)
    for attempt in (
        lambda: gearlink.load("nowhere.yaml"),
        lambda: gearlink.design(**{**CRANK, "stroke": "x", "rood": 3}),
        lambda: gearlink.design(**{**CRANK, "stroke": b"x"}),
        lambda: gearlink.design(**{**CRANK, "stroke": 2000}).crank_length,
        lambda: crank.quantity("strok"),
        lambda: crank.report("press"),
    ):
        with pytest.raises(gearlink.GearlinkError) as caught:
            attempt()
        error = caught.value
        for again in (pickle.loads(pickle.dumps(error)), copy.copy(error), copy.deepcopy(error)):
            assert type(again) is type(error)
            assert (str(again), again.args, vars(again)) == (str(error), error.args, vars(error))
            assert (again.file, again.line, again.key) == (error.file, error.line, error.key)


@pytest.mark.slow
def test_type_checkers_take_quantities_by_name_and_know_what_all_designs_have(designs: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.py"
    page.write_text(
        "import gearlink\n"
        "press = gearlink.changed(gearlink.load('ty460.yaml'), {'speed': 5000})\n"
        "length: float = press.crank_length\n"
        "unit: str = press.quantity('crank_length')\n"
        "gearlink.load(3)\n"
    )
    options = ["--strict", "--cache-dir", str(tmp_path / "cache"), str(page)]
    shown = subprocess.run([sys.executable, "-m", "mypy", *options], cwd=designs.parent, capture_output=True, text=True)
    wrong = [line.split(":")[1] for line in shown.stdout.splitlines() if ": error:" in line]
    assert wrong == ["4", "5"], shown.stdout + shown.stderr


def test_the_package_runs_as_the_command_does() -> None:
    """Without it Python ends with status 1, which says that a check failed."""
    line = [sys.executable, "-m", "gearlink", "--version"]
    done = subprocess.run(line, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, f"gearlink {gearlink.__version__}\n", "")


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"kind": "slider-crank"}, r"write design\(\*\*keys\)"),
        ("feed.yaml", r"write load\('feed\.yaml'\)"),
        (Path("feed.yml"), r"write load\('feed\.yml'\)"),
    ],
)
def test_a_file_or_a_dict_as_a_design_is_told_what_to_write(given: Any, words: str) -> None:
    with pytest.raises(TypeError, match=words):
        gearlink.design(given)
