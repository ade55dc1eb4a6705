"""Command lines that are refused say what would have been right, and that is accepted when it is followed."""

from __future__ import annotations

import re
import shlex
from pathlib import Path
from typing import Any, get_args

import pytest
from conftest import ROOT

from gearlink.cli.app import _tree
from gearlink.cli.usage_errors import _leaves, _values, _writer

PAIR = "kind: gear-pair\nmodule: 4\nteeth: [30, 40]\n"

NUMBERS = ("3x", "nan", "1e999", "-1e9")
FEED = "designs/candy_feed.yaml"
FEED_WITH_TOLERANCES = "designs/candy_feed_tolerances.yaml"
STUDY = "designs/studies/dwell_feed.yaml"
TEXTS = [
    f"register {FEED_WITH_TOLERANCES} --at nowhere",
    f"explore {STUDY} --show x",
    f"explore {STUDY} --show m99",
    f"explore {STUDY} --budget inf",
    f"batch {FEED} --shard 0/3",
    f"export {FEED} --part nothing",
    f"animate {FEED} --size big",
    f"analyze {FEED} --table nothing",
    f"analyze {FEED} --quantity nothing",
    f"analyze {FEED} --set nothing",
    "chart back-step --range 5:1",
    "chart back-step --curves 1,,2",
    "gears --ratio 2 --center-distance 100 --modules 1,-2",
    "gears --ratio 2 --center-distance 100 --shift-sum 2:1",
    "laws --law nothing",
]
TREE: Any = _tree()
COMMANDS = dict(_leaves(TREE))
WORDS = sorted({word for each in COMMANDS.values() for param in each.params for word in _values(param)})


@pytest.fixture
def pair(tmp_path: Path) -> Path:
    path = tmp_path / "pair.yaml"
    path.write_text(PAIR)
    return path


@pytest.mark.parametrize(
    ("words", "remedy"),
    [
        ("export SPEC --format step", "help: give --as step"),
        ("export SPEC --format=stp", "help: give --as step"),
        ("export SPEC --format", "--as takes dxf, svg, csv, step, rexs"),
        ("gear SPEC --as svg", "help: give --plot --plot-format svg"),
        ("gear SPEC --format step", "help: use `gearlink export SPEC --as step`"),
        ("gear SPEC --format html", "help: use `gearlink report SPEC` for a page"),
        ("gear SPEC --format yaml", "help: give --save FILE"),
        ("gear SPEC -f SVG", "help: give --plot --plot-format svg"),
        ("gear SPEC --plot-format markdown", "help: give --format md"),
        ("check SPEC --format sarif", "help: use `gearlink batch DIR --format sarif`"),
        ("export SPEC -o x.dxf", "help: --out DIR: folder for files that are written"),
        ("gear SPEC --jobs 4", "help: it is an option of batch, explore, tolerance, register"),
        ("gear SPEC --samples 1e3", "'1e3' is not a whole number from 2 to 10000000   help: write 1000"),
        ("gear SPEC -format json", "help: give --format, with two dashes"),
        ("gear SPEC -quiet", "help: give --quiet, with two dashes"),
        ("gear SPEC --dpi 1e300", "'1e300' is not a whole number from 20 to 1200"),
        ("batch SPEC -jx", "'x' is not a whole number from 0 on"),
        ("dwell SPEC", "help: use `gearlink synth dwell`"),
        ("SPEC", "help: for a file: `gearlink analyze "),
        ("bench involute", "help: run times are measured in a checkout of gearlink, by `make bench`"),
        ("gears --ratio 3,5 --center-distance 100", "help: write 3.5"),
        ("gears --ratio 19/7 --center-distance 100", "help: write 2.71428571429"),
        ("gears --ratio 3 --center-distance 100 --modules 2;3", "help: write numbers with , between them, such as 2,3"),
        ("gear SPEC --set module 3", "help: write --set module=3"),
        ("gear SPEC other.yaml", "help: gear accepts one file; `gearlink batch` and `gearlink check` accept several"),
        ("gear", "Missing argument 'SPEC'.    help: design file, or - for standard input"),
    ],
)
def test_the_remedy_is_named(gearlink: Any, pair: Path, words: str, remedy: str) -> None:
    ended = gearlink(*(pair if word == "SPEC" else word for word in words.split()))
    assert ended.status == 2
    assert remedy in ended.err.replace("\n", " ")
    assert "Value error" not in ended.err


def test_json_has_the_remedy_too(gearlink: Any, pair: Path) -> None:
    (error,) = gearlink("export", pair, "--as", "png", "--format", "json").json["errors"]
    assert (error["code"], error["message"]) == ("GL115", "No such option: --format")
    assert error["help"] == "use `gearlink analyze SPEC --format json`"


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", COMMANDS)
def test_whatever_is_recommended_for_a_format_takes_it(name: str) -> None:
    """For every command and every format word: the option that is named belongs to the command and has the word."""
    for word in WORDS:
        remedy = _writer(word, COMMANDS[name], TREE)
        for line in re.findall(r"`gearlink ([^`]*)`", remedy) or [f"{name} {remedy.removeprefix('give ')}"]:
            if "--" not in line or "FILE" in line:
                continue
            head, _, tail = line.rpartition(" --")
            option, value = f"--{tail}".split()
            command = COMMANDS[max(path for path in COMMANDS if shlex.split(head)[: len(path.split())] == path.split())]
            (param,) = [each for each in command.params if option in each.opts]
            assert value in _values(param), remedy


def _of_numbers() -> list[tuple[str, str]]:
    return [(path, param.opts[0]) for path, each in COMMANDS.items() for param in each.params if _is_number(param)]


def _is_number(param: Any) -> bool:
    kind = param.type_descriptor.annotation
    return param.param_type_name == "option" and not {int, float}.isdisjoint({kind, *get_args(kind)})


@pytest.mark.quick(8)
@pytest.mark.parametrize(("command", "option"), _of_numbers())
def test_a_number_that_is_none_names_its_option(gearlink: Any, pair: Path, command: str, option: str) -> None:
    params = COMMANDS[command].params
    sources = [str(pair) for param in params if param.param_type_name == "argument"]
    ends = next(param.max is not None for param in params if option in param.opts)
    for value in NUMBERS:
        if value == "1e999" and not ends:
            continue  # it is beyond no limit of the option
        ended = gearlink(*command.split(), *sources, f"{option}={value}")
        assert ended.status == 2, value
        assert option in ended.err, value
        assert repr(value) in ended.err, value


@pytest.mark.parametrize("line", TEXTS)
def test_a_text_that_is_none_names_its_option(gearlink: Any, line: str) -> None:
    words = [str(ROOT / word) if word.endswith(".yaml") else word for word in line.split()]
    ended = gearlink(*words)
    assert ended.status == 2
    assert next(word for word in reversed(words) if word.startswith("--")) in ended.err


@pytest.mark.parametrize(
    ("line", "serves"),
    [
        (f"batch {FEED} --cache kept", "--out DIR --unchanged skip"),
        (f"explore {STUDY} --shard 1/3", "--dask ADDRESS"),
        (f"explore --merge {STUDY}", "one store holds the whole study"),
        (f"explore {STUDY} --executor here:make", "--jobs N"),
        (f"tolerance {FEED_WITH_TOLERANCES} --executor=here:make", "--jobs N"),
        (f"register {FEED_WITH_TOLERANCES} --executor here:make", "--jobs N"),
    ],
)
def test_options_that_are_gone_say_what_serves_instead(gearlink: Any, line: str, serves: str) -> None:
    ended = gearlink(*line.split())
    assert (ended.status, ended.out) == (2, "")
    assert "No such option" in ended.err
    assert serves in " ".join(ended.err.split())


@pytest.mark.parametrize("words", [(), ("synth",)])
def test_without_arguments_the_help_is_shown_as_it_is(gearlink: Any, words: tuple[str, ...]) -> None:
    err = gearlink(*words).err
    assert err.startswith("Usage: ")
    assert "help: " not in err.partition("\n\n")[0]
