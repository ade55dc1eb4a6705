"""Tables on a terminal: what is repeated where a table is folded."""

from __future__ import annotations

from io import StringIO
from typing import Any

import pytest
from factory import DESIGNS
from rich.console import Console

from gearlink.cli.render.terminal import show_table
from gearlink.core.base.report import Table


def heads(table: Table, width: int) -> list[list[str]]:
    """The heads of each part of a folded table."""
    console = Console(width=width, record=True, file=StringIO())
    show_table(table, console)
    lines = console.export_text().splitlines()
    return [lines[i - 1].split() for i, line in enumerate(lines) if set(line.strip()) in ({"─"}, {"-"})]


def test_a_name_alone_opens_each_part() -> None:
    words = ["stroke", "speed"]
    table = Table("t", ("quantity", "unit", "mean", "sigma"), ("1",) * 4, (words, ["mm", "mm/s"], words, words))
    assert heads(table, 30) == [["quantity", "unit", "mean"], ["quantity", "sigma"]]


def test_what_it_takes_to_name_a_row_opens_each_part() -> None:
    numbers = [1.0, 2.0, 3.0, 4.0]
    data = ([1.5, 1.5, 2.0, 2.0], [44, 55, 44, 55], numbers, numbers)
    table = Table("t", ("module", "idler", "acceleration", "transmission"), ("1",) * 4, data)
    assert heads(table, 40) == [["module", "idler", "acceleration"], ["module", "idler", "transmission"]]


def test_names_that_take_half_the_width_stand_once() -> None:
    signs, sources = [1.0, 1.0], ["a bearing with a long name", "another bearing with a long name"]
    table = Table("t", ("sign", "source", "gain", "share"), ("1",) * 4, (signs, sources, signs, signs))
    assert heads(table, 50) == [["sign", "source", "gain"], ["sign", "share"]]


def test_an_estimate_has_the_digits_that_its_interval_leaves_it() -> None:
    """From the value, not from its cell of six digits: 154.212000 +-0.000004 is off by a hundred times its interval."""
    table = Table("t", ("name", "mean", "mean_pm"), ("1",) * 3, (["a", "b"], [154.21159079, 20.5], [4.45e-6, 0.0]))
    console = Console(width=60, record=True, file=StringIO())
    show_table(table, console)
    assert [line.split()[1:] for line in console.export_text().splitlines()[-2:]] == [
        ["154.211591", "+-0.000004"],
        ["20.5"],
    ]


def test_a_table_of_texts_fits_the_width() -> None:
    """Of the texts that are too wide the widest goes on below; nothing of it is lost."""
    inputs = ["grade=6/6, m=3, d=76.6755/226.96, b=32/32, a long rest of inputs that no terminal shows", "x=1"]
    names = ["a name of some length here", "another"]
    table = Table("t", ("symbol", "name", "inputs"), ("1",) * 3, (["f_pt", "f_pb"], names, inputs))
    console = Console(width=80, record=True, file=StringIO())
    show_table(table, console)
    text = console.export_text()
    assert max(map(len, text.splitlines())) <= 80
    assert " ".join(inputs[0].split()) in " ".join(" ".join(text.replace("f_pt", "").split()).split())


@pytest.mark.parametrize("width", [80, 60])
def test_names_of_a_pair_break_at_an_underscore_or_not_at_all(
    gearlink: Any, monkeypatch: pytest.MonkeyPatch, width: int
) -> None:
    monkeypatch.setenv("COLUMNS", str(width))
    shown = gearlink("gear", DESIGNS / "gear_pair.yaml", "--all").out
    lines = [line.split()[0] for line in shown.splitlines() if line.strip()]
    whole = "tip_stress_correction_factor"
    at = next(i for i, word in enumerate(lines) if word.startswith("tip_stress"))
    broken = lines[at : at + 2] if width < 80 else lines[at : at + 1]
    assert "".join(broken) == whole
    assert all(word.endswith("_") for word in broken[:-1])
