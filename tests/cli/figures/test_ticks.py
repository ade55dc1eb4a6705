"""Numbers along an axis: none is made that is not drawn."""

from __future__ import annotations

import factory
import numpy as np
import pytest
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator

from gearlink.cli.views.figures import write
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.drawing.own import RoundNumbers
from gearlink.cli.views.figures.drawing.panels import powers_of_ten


@pytest.mark.parametrize("view", [(0.0, 9.7), (-3.3, 8.0), (1e6, 1e6 + 0.7), (5.0, -2.4), (0.0, 10.0)])
def test_round_numbers_are_those_of_matplotlib_that_are_drawn(view: tuple[float, float]) -> None:
    axes = style.figure(4.0, 3.0, "").add_subplot()
    axes.set_xlim(*view)
    axes.xaxis.set_major_locator(MaxNLocator(6, steps=[1, 2, 2.5, 5, 10]))
    drawn = [tick.get_loc() for tick in axes.xaxis._update_ticks()]
    axes.xaxis.set_major_locator(RoundNumbers(6))
    assert axes.get_xticks().tolist() == drawn
    assert [tick.get_loc() for tick in axes.xaxis._update_ticks()] == drawn


def test_two_numbers_at_least_tell_the_digits() -> None:
    axes = style.figure(4.0, 3.0, "").add_subplot()
    axes.set_xlim(0.9, 1.6)
    axes.xaxis.set_major_locator(RoundNumbers(1))
    assert len(axes.get_xticks()) >= 2


@pytest.mark.slow
def test_panels_above_others_have_a_grid_and_no_numbers() -> None:
    made = write.panels("loads", factory.design("loaded_feed", command="loads"))
    above, *_ = (axes for axes in made.axes if axes.get_title(loc="left") == "Input torque")
    assert len(above.get_xticks()) == 0
    (grid,) = (patch for patch in above.patches if isinstance(patch, PathPatch))
    assert np.unique(grid.get_path().vertices[:, 0]).tolist() == list(range(0, 361, 30))


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("view", "wanted"),
    [
        ((3.0, 250.0), ["5", "10", "20", "50", "100", "200"]),
        ((0.04, 0.9), ["0.05", "0.1", "0.2", "0.5"]),
        ((1e-3, 1e3), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²", "10³"]),
    ],
)
def test_an_axis_of_few_decades_has_more_numbers_than_powers(view: tuple[float, float], wanted: list[str]) -> None:
    axes = style.figure(4.0, 3.0, "").add_subplot()
    axes.set_yscale("log")
    powers_of_ten(axes.yaxis)
    axes.set_ylim(*view)
    axes.figure.draw_without_rendering()
    shown = [
        (at, label.get_text())
        for minor in (False, True)
        for at, label in zip(axes.yaxis.get_ticklocs(minor=minor), axes.yaxis.get_ticklabels(minor=minor), strict=True)
        if view[0] <= at <= view[1] and label.get_text()
    ]
    assert [text for _, text in sorted(shown)] == wanted
