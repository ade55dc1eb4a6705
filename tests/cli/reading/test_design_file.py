"""From a file to a validated spec: each kind of error, its code, its place and its words.

Places and texts are compared exactly. The models below are small ones of this test, so that a change of a real
design file's keys does not disturb it; the examples are read in the tests of the commands.
"""

from __future__ import annotations

import io
import json
import os
import random
import struct
import subprocess
import sys
import time
from enum import Enum
from pathlib import Path
from typing import Annotated, Any, Literal

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel, ConfigDict, Field, model_validator
from pydantic_core import PydanticCustomError
from sweeps import examples, mostly_slow

from gearlink.cli.reading import yaml_reader
from gearlink.cli.reading.design_file import diagnose_no_solution, load, parse, read_kind, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import parse_path
from gearlink.cli.reading.model_errors import number_remedy
from gearlink.cli.reading.yaml_reader import MAX_DEPTH
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.cylindrical_cam import CylindricalCamSpec

KINDS = ("three-gear-four-bar", "gear-pair", "slider-crank")


class Section(BaseModel):
    model_config = ConfigDict(strict=True, frozen=True, extra="forbid")


class Gears(Section):
    module: Annotated[float, Field(gt=0)] = Field(description="module of the gears")
    crank: Annotated[int, Field(ge=1, le=400)]
    idler: int | None = None
    i3: Annotated[float, Field(lt=0)] | None = None
    pressure_angle: Annotated[float, Field(gt=0, lt=45)] = 20.0

    @model_validator(mode="after")
    def _one_ratio(self) -> Gears:
        if self.i3 is not None and self.idler is not None:
            raise PydanticCustomError("GL111", "i3 excludes idler", {"key": "i3", "help": "omit one"})
        return self


class Spring(Section):
    type: Literal["spring"]
    stretch: float
    closed_length: Annotated[float, Field(gt=0)] | None = None


class Pneumatic(Section):
    type: Literal["pneumatic"]
    ratio: Annotated[float, Field(gt=1)]
    extension: float = 1.4


class Scca(Section):
    scca: tuple[float, float, float, float]


class Quintic(Section):
    quintic: float


class Colour(Enum):
    RED = "red"


class Phases(Section):
    back: float = Field(60.0, alias="return")
    dwell: float = 0.0

    @model_validator(mode="after")
    def _turn(self) -> Phases:
        if self.back + self.dwell > 360:
            raise ValueError("the phases take more than a revolution")
        return self


class Pinned(Section):
    at: tuple[float, float]


class Machine(Section):
    kind: Literal["gear-pair"]
    name: str = "design"
    gears: Gears | None = None
    teeth: Annotated[list[int], Field(min_length=2, max_length=2)] = [20, 20]
    pivot: tuple[float, float] = (0.0, 0.0)
    assembly: Literal[1, -1] = 1
    clockwise: bool = False
    colour: Colour = Colour.RED
    transition: Literal["arc", "parabola", "quartic"] = "arc"
    unloader: Annotated[Spring | Pneumatic, Field(discriminator="type")] | None = None
    law: Literal["cycloidal", "modified-sine"] | Scca | Quintic = "cycloidal"
    split: Literal["equal"] | Annotated[float, Field(ge=-5, le=5)] = "equal"
    phases: Phases = Phases()
    pins: dict[str, Pinned] = {}
    points: list[Pinned] = []


HEAD = "kind: gear-pair\n"


def wrong(text: str, *overrides: str, model: type[BaseModel] = Machine) -> list[Diagnostic]:
    with pytest.raises(DesignFileError) as caught:
        validate(parse(text.encode(), "f.yaml", overrides=overrides), model)
    return caught.value.diagnostics


def only(text: str, *overrides: str) -> Diagnostic:
    found = wrong(HEAD + text, *overrides)
    assert len(found) == 1, found
    return found[0]


def spec(text: str, *overrides: str) -> Machine:
    return validate(parse((HEAD + text).encode(), "f.yaml", overrides=overrides), Machine)


# --- reading ---------------------------------------------------------------------------------------------------


def test_file_is_read_and_located(tmp_path: Path) -> None:
    path = tmp_path / "a.yaml"
    path.write_text(HEAD + "gears:\n  module: 2\nteeth: [72,\n  36]\n")
    loaded = load(path)
    assert loaded.data == {"kind": "gear-pair", "gears": {"module": 2}, "teeth": [72, 36]}
    assert loaded.locate(("gears", "module")) == (3, 3, str(path))
    assert loaded.value_in_file(("gears", "module")) == (3, 11, 12)
    assert loaded.locate(("teeth", 1)) == (5, 3, str(path))
    assert loaded.locate(("gears", "crank", "x")) == (2, 1, str(path))
    assert loaded.locate(()) == (1, 1, str(path))
    assert loaded.text.startswith(HEAD)


def test_standard_input() -> None:
    loaded = load("-", stdin=io.BytesIO(b"a: 1\n"))
    assert loaded.locate(("a",)) == (1, 1, "<stdin>")


def refused(path: str | Path) -> Diagnostic:
    with pytest.raises(DesignFileError) as caught:
        load(path)
    return caught.value.diagnostics[0]


def test_missing_file_names_the_nearest(tmp_path: Path) -> None:
    (tmp_path / "candy_feed.yaml").touch()
    found = refused(tmp_path / "candyfeed.yaml")
    assert (found.code, found.line, found.column) == ("GL101", 1, 1)
    assert found.help == f"did you mean {tmp_path / 'candy_feed.yaml'}?"
    assert refused(tmp_path / "press.yaml").help == ""  # alike in the ending alone


def test_unreadable_places(tmp_path: Path) -> None:
    assert refused(tmp_path).message == "this is a folder"
    assert refused("a\0b").code == "GL101"
    assert refused(tmp_path / "x" / "y.yaml").message == "no such file"
    assert refused(tmp_path / ("x" * 300)).code == "GL101"
    locked = tmp_path / "locked.yaml"
    locked.touch(mode=0o000)
    if not os.access(locked, os.R_OK):
        assert refused(locked).message == "no permission to read it"


def test_a_huge_file_is_refused_without_reading_it(tmp_path: Path) -> None:
    path = tmp_path / "huge.yaml"
    with path.open("wb") as stream:
        stream.truncate(100 << 20)
    start = time.process_time()
    assert refused(path).code == "GL110"
    assert time.process_time() - start < 0.5


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="no such device here")
def test_an_endless_file_is_refused() -> None:
    assert refused("/dev/zero").code == "GL110"


def test_reader_needs_no_heavy_package() -> None:
    """Start-up time: numpy, typer and rich are never needed here, pydantic only once a model is there."""
    code = (
        "import sys; from gearlink.cli.reading.design_file import parse; parse(b'a: 1', 'f', overrides=['b=2']);"
        "print([m for m in ('numpy', 'typer', 'rich', 'pydantic', 'scipy', 'matplotlib') if m in sys.modules])"
    )
    assert subprocess.check_output([sys.executable, "-c", code], text=True).strip() == "[]"


# --- kind, sections, the engine's refusals ---------------------------------------------------------------------


def kind_error(text: str) -> Diagnostic:
    with pytest.raises(DesignFileError) as caught:
        read_kind(parse(text.encode(), "f"), KINDS)
    return caught.value.diagnostics[-1]


def test_kind() -> None:
    assert read_kind(parse(b"kind: gear-pair", "f"), KINDS) == "gear-pair"
    found = kind_error("name: x\nkind: gear_pear\n")
    assert (found.code, found.line, found.column, found.key) == ("GL109", 2, 1, "kind")
    assert found.help.startswith("did you mean gear-pair? the kinds are three-gear-four-bar, ")
    assert kind_error("kind: study").help == "name a design; `gearlink explore` runs studies"
    with pytest.raises(DesignFileError, match=r"did you mean gear-pair\?"):
        read_kind(parse(b"kind: gear", "f"), ("gear-pair", "cam-gear"))
    found = kind_error("# a\nname: x\n")
    assert (found.code, found.line, found.column, found.key) == ("GL106", 2, 1, "kind")
    assert kind_error("kind: [1]").code == "GL107"
    assert kind_error("kind: 3").code == "GL107"
    assert kind_error("kind:").code == "GL107"
    assert len(kind_error(f"kind: {'x' * 5000}").message) < 100


def test_kind_given_twice_is_told_with_the_rest() -> None:
    loaded = parse(b"kind: gear-pair\nkind: slider-crank\ntooth: 3\n", "f")
    assert read_kind(loaded, KINDS) == "gear-pair"
    with pytest.raises(DesignFileError) as caught:
        validate(loaded, Machine)
    assert [(d.code, d.line) for d in caught.value.diagnostics] == [("GL104", 2), ("GL105", 3)]


def test_no_solution_points_at_the_nearest_parent_and_keeps_the_key() -> None:
    loaded = parse(b"kind: gear-pair\ngears:\n  module: 2\nteeth: [1, 2]\n", "f", overrides=["links.crank=3"])
    places = {
        "gears.module": (3, 3, "f"),
        "gears.output": (2, 1, "f"),
        "teeth[1]": (4, 12, "f"),
        "stroke": (1, 1, "f"),
        "": (1, 1, "f"),
        "not a path!": (1, 1, "f"),
        "links": (1, 1, "<--set>"),
        "links.frame": (1, 1, "<--set>"),
    }
    for key, (line, column, file) in places.items():
        found = diagnose_no_solution(loaded, NoSolution("too long: 3 mm, at most 2 mm", key=key))
        assert (found.code, found.key, found.message) == ("GL112", key, "too long: 3 mm, at most 2 mm")
        assert (found.line, found.column, found.file) == (line, column, file)


def test_no_solution_out_of_a_model_is_located() -> None:
    class Refusing(BaseModel):
        x: float

        @model_validator(mode="after")
        def _check(self) -> Refusing:
            raise NoSolution("x is too long", key="x")

    found = wrong("y: 1\n\nx: 2\n", model=Refusing)[0]
    assert (found.code, found.line, found.key) == ("GL112", 3, "x")


# --- validation ------------------------------------------------------------------------------------------------


def test_a_good_file_gives_the_spec() -> None:
    got = spec(
        "gears: {module: 2, crank: 40, i3: -1.8}\nteeth: [72, 36]\npivot: [1, 2.5]\nassembly: -1\nclockwise: true\n"
        "colour: red\nunloader: {type: spring, stretch: 1e-6}\nlaw: {scca: [1, 2, 3, 4]}\nsplit: -.5\n"
        "phases: {return: 30}\npins: {a: {at: [0, 1]}}\npoints: [{at: [1, 1]}]\n"
    )
    assert got.gears == Gears(module=2.0, crank=40, i3=-1.8)
    assert got.pivot == (1.0, 2.5)
    assert got.unloader == Spring(type="spring", stretch=1e-6)
    assert got.law == Scca(scca=(1.0, 2.0, 3.0, 4.0))
    assert (got.assembly, got.clockwise, got.colour, got.split) == (-1, True, Colour.RED, -0.5)
    assert got.phases.back == 30.0


def test_every_error_is_told_in_one_run_in_the_order_of_the_file() -> None:
    found = wrong(
        "kind: gear-pair\nmodul: 4\ngears:\n  modul: 2\n  crank: 40.5\n  crank: 3\n  pressure_angle: .nan\n"
        "teeth: [20, x]\npivot: [1]\n"
    )
    assert [(d.code, d.line, d.column, d.key) for d in found] == [
        ("GL105", 2, 1, "modul"),
        ("GL105", 4, 3, "gears.modul"),  # and not that module is missing
        ("GL107", 5, 3, "gears.crank"),
        ("GL104", 6, 3, "gears.crank"),
        ("GL108", 7, 3, "gears.pressure_angle"),
        ("GL107", 8, 13, "teeth[1]"),
        ("GL106", 9, 1, "pivot[1]"),
    ]


@pytest.mark.parametrize(
    ("text", "code", "key", "message", "help"),
    [
        ("gears: {crank: 1}", "GL106", "gears.module", "the key 'module' is missing in 'gears'",
         "module of the gears (above 0)"),
        ("gears: {module: 2, crank: 72.5}", "GL107", "gears.crank", "gears.crank must be a whole number, not 72.5",
         "write 72 or 73"),
        ("gears: {module: 2, crank: 40.0}", "GL107", "gears.crank", "gears.crank must be a whole number, not 40.0",
         "write 40"),
        ("gears: {module: 2, crank: true}", "GL107", "gears.crank", "gears.crank must be a whole number, not true",
         "crank: from 1 to 400"),
        ("gears: {module: true, crank: 2}", "GL107", "gears.module", "gears.module must be a number, not true",
         "module of the gears (above 0)"),
        ("gears: {module: 2, crank: 500}", "GL108", "gears.crank", "gears.crank must be at most 400, not 500",
         "allowed: from 1 to 400"),
        ("gears: {module: 0, crank: 1}", "GL108", "gears.module", "gears.module must be greater than 0, not 0", ""),
        ("gears: {module: 2, crank: 1, pressure_angle: 45}", "GL108", "gears.pressure_angle",
         "gears.pressure_angle must be less than 45, not 45", "allowed: above 0 and below 45"),
        ("gears: {module: , crank: 1}", "GL107", "gears.module", "gears.module is empty: it must be a number",
         "module of the gears (above 0)"),
        ("gears: {module: [1], crank: 1}", "GL107", "gears.module", "gears.module must be a number, not a list",
         "module of the gears (above 0)"),
        ("gears: 3", "GL107", "gears", "gears must be a section of keys, not 3",
         "gears: its keys are module, crank, idler, i3, pressure_angle"),
        ("gears: [1]", "GL107", "gears", "gears must be a section of keys, not a list",
         "gears: its keys are module, crank, idler, i3, pressure_angle"),
        ("gears: {module: 2, crank: 1, idler: 3, i3: -1}", "GL111", "gears.i3", "i3 excludes idler", "omit one"),
        ("name: 460", "GL107", "name", "name must be text, not 460", 'put it in quotes: "460"'),
        ("name: true", "GL107", "name", "name must be text, not true", 'put it in quotes: "true"'),
        ("teeth: [1, 2, 3]", "GL107", "teeth", "teeth must have exactly 2 entries, not 3", ""),
        ("teeth: [1]", "GL107", "teeth", "teeth must have exactly 2 entries, not 1", ""),
        ("teeth: 20", "GL107", "teeth", "teeth must be a list such as [1, 2], not 20", ""),
        ("teeth: 20, 30", "GL107", "teeth", "teeth must be a list such as [1, 2], not '20, 30'",
         "write it in brackets: [20, 30]"),
        ("teeth: [20 30]", "GL107", "teeth[0]", "teeth[0] must be a whole number, not '20 30'",
         "separate the elements of a list by commas: 20, 30"),
        ("teeth: [20; 30]", "GL107", "teeth[0]", "teeth[0] must be a whole number, not '20; 30'",
         "separate the elements of a list by commas: 20, 30"),
        ("teeth: 20;30", "GL107", "teeth", "teeth must be a list such as [1, 2], not '20;30'",
         "write it in brackets: [20, 30]"),
        ("pivot: [1, 2, 3]", "GL107", "pivot", "pivot must have at most 2 entries, not 3", ""),
        ("assembly: 2", "GL108", "assembly", "assembly must be 1 or -1, not 2", ""),
        ("assembly: true", "GL107", "assembly", "assembly must be a number, not true or false", ""),
        ("assembly: [1]", "GL107", "assembly", "assembly must be 1 or -1, not a list", ""),
        ("clockwise: yes", "GL107", "clockwise", "clockwise must be true or false, not 'yes'", "write true"),
        ("clockwise: 1", "GL107", "clockwise", "clockwise must be true or false, not 1", ""),
        ("colour: rde", "GL108", "colour", "colour must be 'red', not 'rde'", "did you mean 'red'?"),
        ("transition: quartik", "GL108", "transition",
         "transition must be 'arc', 'parabola' or 'quartic', not 'quartik'", "did you mean 'quartic'?"),
        ("unloader: {type: springy}", "GL108", "unloader.type",
         "unloader.type must be spring or pneumatic, not 'springy'", "did you mean spring?"),
        ("unloader: {stretch: 1}", "GL106", "unloader.type", "the key 'type' is missing in 'unloader'",
         "type: spring or pneumatic"),
        ("unloader: {type: spring}", "GL106", "unloader.stretch", "the key 'stretch' is missing in 'unloader'", ""),
        ("unloader: {type: pneumatic, ratio: 0.5}", "GL108", "unloader.ratio",
         "unloader.ratio must be greater than 1, not 0.5", ""),
        ("unloader: {type: spring, stretch: 1, ratio: 2}", "GL105", "unloader.ratio",
         "unknown key 'ratio' in 'unloader'", "allowed here: closed_length, stretch, type"),
        ("law: cycloid", "GL107", "law", "law must be 'cycloidal', 'modified-sine' or a section of keys, not 'cycloid'",
         "did you mean 'cycloidal'?"),
        ("law: {scca: [1, 2, 3]}", "GL106", "law.scca[3]", "law.scca[3] is missing: the list is too short", ""),
        ("law: {quintic: x}", "GL107", "law.quintic", "law.quintic must be a number, not 'x'", ""),
        ("split: 7", "GL108", "split", "split must be at most 5, not 7", "allowed: from -5 to 5"),
        ("split: eqal", "GL107", "split", "split must be 'equal' or a number, not 'eqal'", "did you mean 'equal'?"),
        ("phases: {return: 300, dwell: 90}", "GL111", "phases", "the phases take more than a revolution", ""),
        ("phases: {retrun: 300}", "GL105", "phases.retrun", "unknown key 'retrun' in 'phases'",
         "did you mean 'return'? allowed here: dwell, return"),
        ("pins: {a: 3}", "GL107", "pins.a", "pins.a must be a section of keys, not 3", "its keys are at"),
        ("pins: {a: {at: [x, 1]}}", "GL107", "pins.a.at[0]", "pins.a.at[0] must be a number, not 'x'", ""),
        ("pins: {a: {to: 1, at: [0, 0]}}", "GL105", "pins.a.to", "unknown key 'to' in 'pins.a'", "allowed here: at"),
        ("points: [{at: [0, 0]}, {at: [0]}]", "GL106", "points[1].at[1]",
         "points[1].at[1] is missing: the list is too short", ""),
        ("split: .inf", "GL108", "split", "split is not a finite number", "give a finite number"),
        ("teeth: [20, 1e999]", "GL108", "teeth[1]", "teeth[1] is not a finite number", "give a finite number"),
        ("phases: .nan", "GL107", "phases", "phases must be a section of keys, not nan",
         "phases: its keys are return, dwell"),
        ("split: 1e-300", "GL108", "split", "split is 1e-300, which no machine can have",
         "allowed: from -5 to 5, 0 or at least 1e-30 in size"),
        ("teeth: [20, -1e300]", "GL108", "teeth[1]", "teeth[1] is -1e+300, which no machine can have",
         "allowed: whole numbers from -1000000000000 to 1000000000000"),
    ],
)  # fmt: skip
def test_each_error_in_our_own_words(text: str, code: str, key: str, message: str, help: str) -> None:
    found = only(text + "\n")
    assert (found.code, found.key, found.message, found.help) == (code, key, message, help)
    assert found.line == 2


def test_a_wrong_type_hides_nothing_else_of_its_section() -> None:
    """What is wrong whichever type is meant; a key that one of them takes, and what one of them lacks, may be right."""
    for named in ("type: springy, ", ""):
        found = wrong(f"{HEAD}unloader: {{{named}bogus: 1, ratio: 0.5, stretch: [], extension: 2}}\n")
        first = "GL108" if named else "GL106"
        assert {(each.code, each.key) for each in found} == {
            (first, "unloader.type"),
            ("GL105", "unloader.bogus"),
            ("GL108", "unloader.ratio"),
            ("GL107", "unloader.stretch"),
        }
    (alone,) = wrong(f"{HEAD}unloader: {{type: springy, ratio: 2, stretch: 1}}\n")
    assert alone.key == "unloader.type"


@pytest.mark.parametrize(
    ("text", "column", "help"),
    [
        ("crank: 3", 1, "it belongs to 'gears'; allowed here: "),
        ("gears.module: 3", 1, "write `module: 3` in `gears`"),
        ("gears_module: 3", 1, "write `module: 3` in `gears`"),
        ("Teeth: [1, 2]", 1, "did you mean 'teeth'? allowed here: "),
        ("gears: {module: 2, crank: 1, pressure-angle: 20}", 30, "did you mean 'pressure_angle'?"),
        ("gears: {module: 38,5, crank: 1}", 20, "commas separate entries: write decimals with a point"),
        ("gears: {module: 2, crank: 1, i3:-1}", 30, "a space is required after the colon: 'i3: -1'"),
    ],
)
def test_unknown_keys(text: str, column: int, help: str) -> None:
    found = only(text + "\n")
    assert (found.code, found.line, found.column) == ("GL105", 2, column)
    assert found.help.startswith(help)


@pytest.mark.parametrize(
    ("text", "remedy"),
    [
        ("38,8571", "write a decimal point: 38.8571"),
        ("0,857", "write a decimal point: 0.857"),
        ("38,857", "write 38.857, or 38857 if the comma separates thousands"),
        ("40 mm", "a unit is not allowed here: write 40"),
        ("20°", "a unit is not allowed here: write 20"),
        ("1.5e3rpm", "a unit is not allowed here: write 1.5e3"),
        ("40:20", "write decimals, not minutes and seconds"),
        ("36:42:2", "one value at a time: several values of a key are a study, `gearlink new study` shows one"),
        ("1_000", "write 1000"),
        ("1 000.5", "write 1000.5"),
        ("38\u00a0", "it holds U+00A0 (no-break space): write 38"),
        ("１２．５", "it holds U+FF11 (fullwidth digit one): write 12.5"),
        ("\u22125", "it holds U+2212 (minus sign): write -"),
        ("\u20135", "it holds U+2013 (en dash): write -"),
        ("40 parsec", "a unit is not allowed here: write 40"),
        ("5 cm", "a unit is not allowed here: write 5"),
        ("0b11", "write it in decimals"),
        ("0xG", "write it in decimals"),
        ("1e", "write the exponent as in 1e3"),
        ("1e5_0", "write the exponent as in 1e3"),
        ("“3”", "it holds U+201C (left double quotation mark): write 3"),
        ("1’000", "it holds U+2019 (right single quotation mark): write 1000"),
        ("60;", "write 60"),
        ("1.2,", "write 1.2"),
        ("2O", "a letter instead of a digit: write 20"),
        ("8000/60", "write 133.3333333"),
        ("72 / 2", "write 36"),
        ("1/0", "write it in decimals"),
        ("DP12", ""),
        ("abc", ""),
        ("", ""),
    ],
)
def test_texts_that_were_meant_as_numbers(text: str, remedy: str) -> None:
    assert number_remedy(text) == remedy


@pytest.mark.parametrize(
    ("text", "degrees"),
    [("15°30'", "15.5"), ("15° 7.5'", "15.125"), ("0°0'36\"", "0.01"), ("1° 1' 1.8''", "1.017166667")],
)
def test_an_angle_in_minutes_and_seconds_is_converted(text: str, degrees: str) -> None:
    """A minute is 1/60 of a degree, a second 1/60 of a minute."""
    assert number_remedy(text, "deg") == f"write {degrees}"
    assert number_remedy(text, "mm") != f"write {degrees}"


@pytest.mark.parametrize("text", ["DP12", "12DP", "dp 12", "12 DP"])
def test_a_diametral_pitch_is_converted(text: str) -> None:
    """12 teeth for each inch of the reference diameter: a module of 25.4/12 mm."""
    assert "write 2.116666667 (mm)" in number_remedy(text, "mm")


@pytest.mark.parametrize("text", ["1e-400", "-1e-400", "0." + "0" * 400 + "1"])
def test_what_is_not_0_does_not_become_0(text: str) -> None:
    found = only(f"gears: {{module: {text}, crank: 1}}\n")
    assert (found.code, "no machine can have" in found.message) == ("GL108", True)


def test_quoted_number_where_a_number_is_wanted() -> None:
    assert only("gears: {module: '2', crank: 1}\n").help == "omit the quotation marks"


def test_custom_error_at_a_key_that_is_missing_points_at_its_parent() -> None:
    class Back(BaseModel):
        @model_validator(mode="before")
        @classmethod
        def _something(cls, _data: Any) -> Any:
            raise PydanticCustomError("GL106", "give angle or crank_angle", {"key": "target.angle"})

    class Holder(BaseModel):
        back: Back

    found = wrong("a: 1\nback: {target: {}}\n", model=Holder)[0]
    assert (found.code, found.key, found.line, found.column) == ("GL106", "back.target.angle", 2, 8)


def test_a_tag_that_is_also_a_key_does_not_mislead() -> None:
    class Inner(Section):
        type: Literal["spring"]
        spring: Annotated[float, Field(gt=0)]

    class Other(Section):
        type: Literal["other"]

    class Outer(Section):
        unit: Annotated[Inner | Other, Field(discriminator="type")]

    found = wrong("unit:\n  type: spring\n  spring: -1\n", model=Outer)[0]
    assert (found.key, found.line, found.column) == ("unit.spring", 3, 3)


@pytest.mark.slow
def test_a_flood_of_errors_is_cut_in_time() -> None:
    text = HEAD + "".join(f"key_number_{i}: 1\n" for i in range(15_000))
    start = time.process_time()
    found = wrong(text)
    assert time.process_time() - start < 2.0
    assert len(found) == 101
    assert found[-1].message == f"{15_000 - 100} more errors are not shown"


@examples(200)
@given(st.floats(1e-30, 1e12) | st.floats(-1e12, -1e-30) | st.sampled_from([0.0, -0.0]))
def test_floats_reach_the_model_to_the_last_bit(number: float) -> None:
    got = spec(f"pivot: [{number!r}, 0]\n").pivot[0]
    assert struct.pack("d", got) == struct.pack("d", number)


# --- --set -----------------------------------------------------------------------------------------------------


def data(*overrides: str, text: str = "a: {b: 1, c: [1, 2]}\nd:\n") -> dict[str, Any]:
    return parse(text.encode(), "f", overrides=overrides).data


def test_override_values() -> None:
    assert data("a.b=1e-6")["a"] == {"b": 1e-6, "c": [1, 2]}
    assert data("a.c[1]=no")["a"]["c"] == [1, "no"]
    assert data("a.c=[3, {x: 4}]")["a"]["c"] == [3, {"x": 4}]
    assert data("d.e.f=3")["d"] == {"e": {"f": 3}}
    assert data("x.y=-.5")["x"] == {"y": -0.5}
    assert data("a=")["a"] is None
    assert data('a="1"')["a"] == "1"
    assert data("a=TY: 460 # x = y")["a"] == "TY: 460 # x = y"
    assert data("a.b=1", "a.b=2")["a"]["b"] == 2
    assert data("a.c[0]=5", "a.c[1]=6")["a"]["c"] == [5, 6]


def test_override_leaves_an_alias_of_the_value_alone() -> None:
    assert data("b.x=2", text="a: &a {x: 1}\nb: *a\n") == {"a": {"x": 1}, "b": {"x": 2}}


def test_override_is_located_where_it_was_given() -> None:
    def place(text: str, *overrides: str) -> tuple[str, int, int, str]:
        found = only(text, *overrides)
        return found.file, found.line, found.column, found.key

    gears = "gears: {module: 2, crank: 40}\n"
    assert place(gears, "gears.module=-1") == ("<--set>", 1, 1, "gears.module")
    assert place(gears, "gears={module: 2, crnk: 3, crank: 3}") == ("<--set>", 1, 19, "gears.crnk")
    assert place(gears, "teeth=[1, x]") == ("<--set>", 1, 11, "teeth[1]")
    assert place("teeth: [1, 2]\n", "teeth[1]=x") == ("<--set>", 1, 1, "teeth[1]")
    assert place("", "gears.module=2") == ("<--set>", 1, 1, "gears.crank")
    assert place("gears: {module: 2}\n", "gears.idler=3") == ("f.yaml", 2, 1, "gears.crank")
    assert only(gears, "gears.module=-1").source == "gears.module=-1"
    assert place(gears + "split: .nan\n", "gears.module=3") == ("f.yaml", 3, 1, "split")
    assert spec("split: .nan\n", "split=3").split == 3


@pytest.mark.parametrize(
    ("argument", "message"),
    [
        ("a.b", "no '=' after the path"),
        ("", "no '=' after the path"),
        ("=3", "'' is not a key path"),
        ("a..b=3", "'a..b' is not a key path"),
        ("[0]=3", "'[0]' is not a key path"),
        ("a[x]=3", "'a[x]' is not a key path"),
        ("a[-1]=3", "'a[-1]' is not a key path"),
        ("a.c[2]=3", "a.c has 2 elements, counted from [0]"),
        ("a[0]=3", "a is not a list: it is a section, write a.KEY"),
        ("d[0]=3", "d is not a list: write d=[...] with all its elements"),
        ("a.b.x=3", "a.b is not a section, so it has no key 'x'"),
        ("a.c.x=3", "a.c is not a section, so it has no key 'x'"),
        ("a=[1", "'[' is never closed"),
        ("a=[1] 2", "text after the end of the data"),
        ("a={b: !x 1}", "tags such as '!x' are not supported"),
        ("a=x\udcff", "character '\\udcff' is not text"),
    ],
)
def test_wrong_overrides(argument: str, message: str) -> None:
    with pytest.raises(DesignFileError) as caught:
        data(argument)
    found = caught.value.diagnostics[0]
    assert (found.code, found.message, found.file, found.line) == ("GL114", message, "<--set>", 1)
    found.as_text("ascii").encode("ascii")


def test_overrides_are_told_together_with_the_file() -> None:
    with pytest.raises(DesignFileError) as caught:
        parse(b"a: 1\na: 2\nb: [1\n", "f", overrides=["x", "y=[", "z={a: 1, a: 2}"])
    assert [(d.code, d.file) for d in caught.value.diagnostics] == [
        ("GL104", "f"),
        ("GL103", "f"),
        ("GL114", "<--set>"),
        ("GL114", "<--set>"),
        ("GL104", "<--set>"),
    ]


OVERRIDES = {
    "path": ".".join("a" * 50) + "=1",
    "levels": "a=" + "[" * (MAX_DEPTH + 1),
    "levels beyond the parser's own limit": "a=" + "[" * 50_000,
    "characters": "a='" + "x" * (1 << 20) + "'",
}


@pytest.mark.quick(4)
@pytest.mark.parametrize("loader", ["CSafeLoader", "SafeLoader"])
@pytest.mark.parametrize("name", OVERRIDES)
def test_override_caps(name: str, loader: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the parser that is installed, whether it limits nesting itself or not, and with the pure Python one."""
    monkeypatch.setattr(yaml_reader, "EventParser", getattr(yaml, loader, yaml.SafeLoader))
    with pytest.raises(DesignFileError) as caught:
        data(OVERRIDES[name], text="b: 1\n")
    assert caught.value.diagnostics[0].code == "GL110"
    assert len(str(caught.value)) < 1_000


def test_parse_path() -> None:
    assert parse_path("a") == ("a",)
    assert parse_path("laws.return-x[0][1].b") == ("laws", "return-x", 0, 1, "b")
    for text in ("", ".a", "a.", "a[", "a]", "a[1", "[1]", "a b", "a=b", "a[1]b"):
        assert parse_path(text) is None


# --- nothing else is raised ------------------------------------------------------------------------------------

VALUES = st.sampled_from(
    [
        "1",
        "-1",
        "2.5",
        ".nan",
        "true",
        "x",
        "",
        "[1, 2]",
        "[x]",
        "{a: 1}",
        "{type: spring}",
        "{scca: [1]}",
        "'q'",
        "0x10",
    ]
)
KEYS = st.sampled_from(
    [*Machine.model_fields, "gears.module", "gears.crank", "gears.i3", "teeth[1]", "unloader.ratio", "zz"]
)


@examples(300)
@given(st.lists(st.tuples(KEYS, VALUES), max_size=6), st.lists(st.tuples(KEYS, VALUES), max_size=3))
def test_any_values_give_a_spec_or_located_errors(lines: list[tuple[str, str]], sets: list[tuple[str, str]]) -> None:
    text = HEAD + "".join(f"{key}: {value}\n" for key, value in lines)
    found: list[Diagnostic] = []
    try:
        loaded = parse(text.encode(), "f", overrides=[f"{key}={value}" for key, value in sets])
        validate(loaded, Machine)
    except DesignFileError as error:
        found = error.diagnostics
    for diagnostic in found:
        assert diagnostic.code in {f"GL{n}" for n in range(104, 115)}
        assert diagnostic.message
        assert 1 <= diagnostic.column <= len(diagnostic.source) + 1
        assert "Input should" not in diagnostic.message
        diagnostic.as_text("ascii").encode("ascii")


@examples(100)
@given(st.binary(max_size=60))
def test_random_bytes_on_standard_input(raw: bytes) -> None:
    found: list[Diagnostic] = []
    try:
        read_kind(load("-", stdin=io.BytesIO(raw)), KINDS)
    except DesignFileError as error:
        found = error.diagnostics
    assert found
    assert all(diagnostic.file == "<stdin>" for diagnostic in found)


def test_round_trip_with_lines() -> None:
    """Every key of a design written as JSON, one a line, is found in its line."""
    rng = random.Random(4)
    design = {
        f"section_{i}": {
            f"key_{j}": rng.choice([rng.random(), rng.randrange(99), "text", None, True]) for j in range(5)
        }
        for i in range(8)
    }
    text = json.dumps(design, indent=1)
    loaded = parse(text.encode(), "f")
    assert loaded.data == design
    rows = text.split("\n")
    for section, keys in design.items():
        for key in keys:
            line, column, _ = loaded.locate((section, key))
            assert column == 3
            assert rows[line - 1].startswith(f'  "{key}"')
            start = max(i for i, row in enumerate(rows[:line]) if row.startswith(' "'))
            assert rows[start].startswith(f' "{section}"')


def test_speed_of_reading_and_validating() -> None:
    """Printed with -s; a batch of a thousand designs should spend well under a second here."""
    raw = (HEAD + "gears: {module: 2, crank: 40, i3: -1.8}\nteeth: [72, 36]\npivot: [1, 2.5]\n").encode()
    raw += b"phases:\n  return: 30   # degrees\n  dwell: 10\npins:\n" + b"".join(
        b"  p%d: {at: [%d, 1.5]}   # mm\n" % (i, i) for i in range(20)
    )
    start = time.perf_counter()
    for _ in range(200):
        loaded = parse(raw, "f")
    middle = time.perf_counter()
    for _ in range(200):
        validate(loaded, Machine)
    end = time.perf_counter()
    lines = raw.count(b"\n")
    print(f"\n{lines} lines: read {(middle - start) * 5:.3f} ms, validate {(end - middle) * 5:.3f} ms")


SLIDER_CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\nname: "


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("x" * 201, "name has 201 characters (limit <= 200)"),
        ("x" * 900_000, "name has 900000 characters"),
        (r'"a\rb"', "U+000D"),
    ],
)
def test_a_name_that_cannot_head_a_picture(gearlink: Any, tmp_path: Path, name: str, words: str) -> None:
    path = tmp_path / "design.yaml"
    path.write_text(SLIDER_CRANK + name + "\n")
    for line in (("check", path), ("report", path, "--out", tmp_path), ("animate", path, "--out", tmp_path)):
        ended = gearlink(*line)
        assert ended.status == 2
        assert "design.yaml:5:1: error GL108: name " in ended.err + ended.out
        assert words in ended.err + ended.out
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", mostly_slow(["中" * 200, "e\u0301" * 100, "x" * 200, "a\u200bb\u202ec", r'"a\nb\tc"'], 1)
)
def test_any_name_of_letters_heads_every_page(gearlink: Any, tmp_path: Path, name: str) -> None:
    path = tmp_path / "design.yaml"
    path.write_text(SLIDER_CRANK + name + "\n", encoding="utf-8")
    for line in (("report", path), ("crank", path, "--plot"), ("animate", path, "--format", "html"), ("batch", path)):
        ended = gearlink(*line, "--out", tmp_path)
        assert ended.status == 0, ended.err
        assert "arning" not in ended.err
    assert len(list(tmp_path.rglob("*.*"))) >= 5


@pytest.mark.slow
def test_a_file_name_that_is_no_text_heads_pages_too(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "bad\udcff.yaml"
    path.write_text(SLIDER_CRANK.removesuffix("name: "))
    for line in (("report", path), ("animate", path, "--format", "html"), ("batch", path)):
        assert gearlink(*line, "--out", tmp_path).status == 0


def test_a_missing_list_names_the_keys_of_its_entries() -> None:
    with pytest.raises(DesignFileError) as refused:
        validate(parse(b"kind: cylindrical-cam\n", "x.yaml"), CylindricalCamSpec)
    help = next(found.help for found in refused.value.diagnostics if found.key == "motion")
    assert "the keys of an entry are to, lift, law" in help
    assert help.endswith("those of a section are table, file, columns, degrees")
