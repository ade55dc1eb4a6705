"""Numbers along an axis: none is made that is not drawn."""

from __future__ import annotations

import factory
import numpy as np
import pytest
from matplotlib.patches import PathPatch
from matplotlib.ticker import MaxNLocator

from gearlink.cli.views.figures import write
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.drawing.ticks import RoundNumbers


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


def test_panels_above_others_have_a_grid_and_no_numbers() -> None:
    made = write.panels("loads", factory.design("loaded_feed", command="loads"))
    above, *_ = (axes for axes in made.axes if axes.get_title(loc="left") == "Input torque")
    assert len(above.get_xticks()) == 0
    (grid,) = (patch for patch in above.patches if isinstance(patch, PathPatch))
    assert np.unique(grid.get_path().vertices[:, 0]).tolist() == list(range(0, 361, 30))
