"""What a figure measures once stays right: limits of filled outlines, and the words along axes clear of their numbers.

Limits against matplotlib's own ways: 1e-12 of the size, for its circles are Bezier curves. Words: half a pixel.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Circle
from sheets import sheet
from sweeps import mostly_slow

from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.drawing.placing import places, settled
from gearlink.cli.views.films.raster import thinned

OUTLINE = 3.0 * np.exp(2j * np.pi * np.arange(7) / 7) + 1j


def _limits(add: Any) -> list[float]:
    axes = Figure().add_subplot()
    axes.plot([0.0, 1.0], [0.0, 1.0])
    add(axes)
    return [*axes.get_xlim(), *axes.get_ylim()]


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        (lambda axes: style.area(axes, OUTLINE), lambda axes: axes.fill(OUTLINE.real, OUTLINE.imag)),
        (lambda axes: style.disc(axes, 2 - 1j, 3.5), lambda axes: axes.add_patch(Circle((2, -1), 3.5))),
        (lambda axes: style.stretch(axes, 0.5, 4.0), lambda axes: axes.axvspan(0.5, 4.0)),
    ],
    ids=["area", "disc", "stretch"],
)
def test_what_is_filled_reaches_as_far_as_matplotlib_says(ours: Any, theirs: Any) -> None:
    assert _limits(ours) == pytest.approx(_limits(theirs), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "command"), [("candy_feed", "synth dwell"), ("ty460", "cam"), ("swing_gripper", "gripper")]
)
def test_words_beside_panels_are_clear_of_all_numbers_and_in_a_line(name: str, command: str) -> None:
    made = sheet(name, command).figure
    settled(made)
    renderer = FigureCanvasAgg(made).get_renderer()
    made.draw(renderer)
    columns: dict[float, list[tuple[float, float]]] = defaultdict(list)
    for axes in made.axes:
        if not axes.axison or not axes.get_ylabel():
            continue
        words = axes.yaxis.label.get_window_extent(renderer)
        low, high = sorted(axes.get_ylim())
        every = zip(axes.get_yticks(), axes.get_yticklabels(), strict=True)  # those beyond the limits are not drawn
        numbers = min(text.get_window_extent(renderer).x0 for at, text in every if low <= at <= high)
        columns[round(axes.get_position().x0, 3)].append((words.x1, numbers))
    assert columns
    for column in columns.values():
        ends = [end for end, _ in column]
        assert max(ends) <= min(numbers for _, numbers in column) + 0.5
        assert max(ends) - min(ends) <= 0.5


CLEAR = [
    ("six_bar_swing", "analyze"),
    ("loaded_swing_cycle", "loads"),
    ("loaded_press", "loads"),
    ("loaded_press", "press"),
    ("loaded_gripper", "gripper"),
    ("candy_feed_tolerances", "tolerance"),
    ("two_gear_drag_link", "analyze"),
    ("wide_swing_cycle", "cam"),
    ("mutilated_gear_times", "analyze"),
    ("five_bar_function", "analyze"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "command"), mostly_slow(CLEAR, 1))
def test_nothing_written_along_the_axes_meets_anything_else_written_there(name: str, command: str) -> None:
    made = settled(sheet(name, command).figure)
    renderer = FigureCanvasAgg(made).get_renderer()
    made.draw(renderer)
    page = made.bbox
    boxes = [(text, text.get_window_extent(renderer)) for text in _written(made) if _has_box(text)]
    assert [text.get_text() for text, box in boxes if box.x0 < -0.5 or box.x1 > page.x1 + 0.5] == []
    met = [
        (one.get_text(), other.get_text())
        for (one, box), (other, far) in combinations(boxes, 2)
        if min(box.x1, far.x1) - max(box.x0, far.x0) > 1.0 and min(box.y1, far.y1) - max(box.y0, far.y0) > 1.0
    ]
    assert met == []


def _has_box(text: Any) -> bool:
    """Whether a text fills its box; a slanted one does not."""
    return bool(text.get_text()) and text.get_rotation() % 90.0 == 0.0


def _written(made: Any) -> Iterator[Any]:
    """Headings, legends, words and numbers of all panels and of the axes that they have besides."""
    for axes in made.axes:
        yield from (axes.title, axes._left_title, axes._right_title)
        yield from () if axes.get_legend() is None else axes.get_legend().get_texts()
        for each in (one for one in (axes, *axes.child_axes) if one.axison):
            for axis, ends in ((each.xaxis, each.get_xlim()), (each.yaxis, each.get_ylim())):
                yield from (axis.label, axis.get_offset_text()) if axis.get_visible() else ()
                inside = [tick for tick in axis.get_major_ticks() if min(ends) <= tick.get_loc() <= max(ends)]
                yield from (label for tick in inside for label in (tick.label1, tick.label2) if label.get_visible())


@pytest.mark.slow
def test_a_remark_below_a_table_keeps_clear_of_the_table_beside_it() -> None:
    made = settled(sheet("gear_pair", "gear").figure)
    renderer = FigureCanvasAgg(made).get_renderer()
    remarks = [text for axes in made.axes for text in axes.texts if text.get_text().startswith("K_A")]
    assert remarks
    beside = next(axes for axes in made.axes if axes.get_title(loc="left") == "Gear table of the drawing")
    assert max(text.get_window_extent(renderer).x1 for text in remarks) < beside.get_window_extent(renderer).x0


def test_places_are_read_back_as_they_were_set() -> None:
    made = sheet("ty460_slider_crank", "crank").figure
    known = places(settled(made))
    again = settled(sheet("ty460_slider_crank", "crank").figure, known)
    assert places(again) == known
    assert len(known.distances) > 3
    assert min(known.distances) > 0.05


def test_a_thinned_outline_stays_within_the_tolerance() -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 721)
    outline = (40.0 + 2.0 * np.sin(19.0 * turn)) * np.exp(1j * turn)
    kept = thinned(outline, 0.05)
    assert kept[0] == outline[0]
    assert kept[-1] == outline[-1]
    assert len(kept) < len(outline) / 2
    starts, ways = kept[:-1], np.diff(kept)
    share = np.clip(((outline[:, None] - starts) * ways.conj()).real / np.abs(ways) ** 2, 0.0, 1.0)
    assert np.abs(outline[:, None] - (starts + share * ways)).min(axis=1).max() <= 0.05
