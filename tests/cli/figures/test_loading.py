"""What sheets leave out of matplotlib: they look as with it."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import pytest
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.backends.backend_svg import RendererSVG
from matplotlib.mathtext import MathTextParser
from matplotlib.text import Text

import gearlink
from gearlink.cli.figures import write
from gearlink.cli.figures.drawing import style
from gearlink.cli.figures.gears import values
from gearlink.cli.figures.loading import heights_of_lines

LOOKS: list[dict[str, Any]] = [
    {"fontsize": 9.0},
    {"fontsize": 7.5, "fontweight": "bold"},
    {"fontsize": 5.25, "fontstyle": "italic"},
    {"fontsize": 10.0, "family": "monospace"},
]


@pytest.mark.parametrize("look", LOOKS, ids=str)
@pytest.mark.parametrize("words", ["force [N]", "two\nlines", "$a_w$"])
def test_texts_have_the_place_that_matplotlib_finds_for_them(look: dict[str, Any], words: str) -> None:
    figure = style.figure(4.0, 3.0, "")
    text: Text = figure.text(0.3, 0.4, words, **look)
    for own, resolution, dpi in (
        (RendererAgg(400, 300, 130.0), None, 130.0),
        (RendererSVG(4, 3, io.StringIO()), 72.0, 72.0),
    ):
        figure.set_dpi(dpi)

        class Told(type(own)):  # type: ignore[misc]
            _get_font_height_metrics = heights_of_lines(lambda renderer, at=resolution: at or renderer.dpi)

        usual = text._get_layout(own)
        own.__class__ = Told
        for _ in range(2):  # read, and known
            box, lines, *rest = text._get_layout(own)
            assert (box.extents == usual[0].extents).all()
            assert (lines, rest) == (usual[1], list(usual[2:]))


def test_a_font_that_does_not_tell_its_heights_is_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    class Face:
        def get_sfnt_table(self, name: str) -> None:
            assert name in ("OS/2", "hhea")

    monkeypatch.setattr("matplotlib.font_manager.get_font", lambda _: Face())
    found = heights_of_lines(lambda _: 72.0)(None, Text(0, 0, "").get_fontproperties())
    assert found == (None, None, None)


def test_a_star_stands_above_the_index_before_it() -> None:
    figure = style.figure(4.0, 3.0, "")
    axes = figure.add_subplot()
    values._set_symbol(axes, (0.5, 0.5), "h_fP*", 6.2)
    figure.canvas.draw()
    letter, index, star = (text.get_window_extent() for text in axes.texts)
    assert letter.x1 < index.x0 < index.x1 < star.x0
    assert star.y1 == pytest.approx(letter.y1, abs=1.0)
    assert star.y1 > index.y1


@pytest.mark.parametrize(
    ("command", "name"),
    [
        ("gear", "gear_pair"),
        ("cam", "wide_swing_cycle"),
        ("swing", "wide_swing_cycle"),
        ("synth dwell", "standing_feed"),
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
