"""The instant centres of a three-gear four-bar in its standstills, or where it is slowest, and their line."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.three_gear_four_bar import build

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.three_gear.design import ThreeGearFourBar

_TURN = 2.0 * math.pi
_MOST = 2
_CLOSE = 0.06


def draw(design: ThreeGearFourBar) -> Figure:
    """The linkage at each standstill with its poles; A, F = P13 and E = P35 lie in line there."""
    places = design.dwell_crank_angles[:_MOST] or [design.speed_ratio_min_at]
    made = panels.page(f"{design.spec.name}: instant centres", 0.5 * len(places) + 0.1)
    grid = made.add_gridspec(len(places), 1)
    words = "standstill" if design.dwell_crank_angles else "minimum speed"
    for row, phi in enumerate(places):
        axes = made.add_subplot(grid[row])
        panels.drawing(axes, f"Poles at the {words}, crank angle {math.degrees(phi):.5g}°")
        scene_axes.draw(axes, build(design, np.array([phi / _TURN])))
        _poles(axes, design, phi)
    return made


def _poles(axes: Axes, design: ThreeGearFourBar, phi: float) -> None:
    """The three poles, the line through them, and the feet of B and D on it."""
    from gearlink.core.machines.three_gear.mechanism import poles

    found = poles(design, np.array([phi]))
    first, second, x = complex(found.first[0]), complex(found.second[0]), float(found.on_frame[0])
    points = {"F = P13": first, "E = P35": second}
    if math.isfinite(x) and abs(x) < 3.0 * design.frame_length:
        points["P15"] = complex(x, 0.0)
    way = (second - first) / abs(second - first)
    ends = {"G": complex(design.frame_length, 0.0), "G'": complex(found.crank_pin[0])}
    feet = {name: first + way * ((point - first) * way.conjugate()).real for name, point in ends.items()}
    along = sorted(((point - first) * way.conjugate()).real for point in (*points.values(), *feet.values(), 0j))
    line = first + way * np.array([along[0], along[-1]])
    axes.plot(line.real, line.imag, color=style.RED, linewidth=1.2, linestyle=style.DASHED, zorder=8)
    close = _CLOSE * design.frame_length
    for name, point in {**points, **feet}.items():
        axes.plot([point.real], [point.imag], "o", color=style.RED, markersize=4.0, zorder=9)
        crowded = name == "G'" and min(abs(point), *(abs(point - other) for other in points.values())) < close
        axes.annotate(name, (point.real, point.imag), (-14, -16) if crowded else (5, 5), textcoords="offset points",
                      fontsize=8, zorder=10, path_effects=style.outlined())  # fmt: skip
