"""The arcs that show in which sense the input turns can be seen as arcs, whatever lies about the axis.

Limit: 14 points, of which the head of the arrow takes eight.
"""

from __future__ import annotations

import numpy as np
import pytest
from factory import design, worked

from gearlink.cli.views.figures import write
from gearlink.core.base.kinds import KINDS

_LEAST = 14.0


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["geneva_drive", "crank_rocker", "lift_cam", "hypocycloid_slider"])
def test_the_arc_of_an_arrow_is_longer_than_its_head(name: str) -> None:
    data = worked(name)
    command = KINDS[data["kind"]].spec_model().model_validate(data).commands()[0]
    sheet = write.draw(command, design(name, command=command))
    arcs = [(axes, line) for axes in sheet.axes for line in axes.lines if line.get_gid() == "sense"]
    assert arcs
    for axes, line in arcs:
        ends = axes.transData.transform(line.get_xydata()) * 72.0 / sheet.dpi
        assert np.abs(ends[-1] - ends[0]).max() > _LEAST
