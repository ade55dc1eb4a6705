"""Symbols with indices on sheets: set as letters of their own, no formula is read for them."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from matplotlib.mathtext import MathTextParser

import gearlink
from gearlink.cli.views.figures import gears, write
from gearlink.cli.views.figures.drawing import style


def test_a_star_stands_above_the_index_before_it() -> None:
    figure = style.figure(4.0, 3.0, "")
    axes = figure.add_subplot()
    gears._set_symbol(axes, (0.5, 0.5), "h_fP*", 6.2)
    figure.canvas.draw()
    letter, index, star = (text.get_window_extent() for text in axes.texts)
    assert letter.x1 < index.x0 < index.x1 < star.x0
    assert star.y1 == pytest.approx(letter.y1, abs=1.0)
    assert star.y1 > index.y1


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "name"),
    [
        ("synth dwell", "standing_feed"),
        ("gear", "gear_pair"),
        ("cam", "wide_swing_cycle"),
        ("swing", "wide_swing_cycle"),
    ],
)
def test_no_sheet_of_a_report_has_a_formula_to_be_read(
    designs: Path, monkeypatch: pytest.MonkeyPatch, command: str, name: str
) -> None:
    def parse(_: Any, formula: str, *__: Any, **___: Any) -> None:
        raise AssertionError(formula)

    monkeypatch.setattr(MathTextParser, "parse", parse)
    design = gearlink.load(designs / f"{name}.yaml")
    write.save(lambda: write.draw(command, design), name, io.BytesIO(), "svg")
