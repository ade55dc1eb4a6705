"""What the figures of the smaller gear-linkages share: gears, letters, facts, charts over a motion table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gearlink.cli.figures import panels, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.design import Design

DASHED: Any = (0, (5, 3))
DOTTED: Any = (0, (1, 2))
DWELL, BACKWARD = "#CFE8F7", "#FBE3C8"


def two_parts(figure: Figure, share: float) -> tuple[Any, Any]:
    """The drawing above, its charts below; each part has a layout of its own, so that the charts keep their width."""
    parts: Any = figure.subfigures(2, 1, height_ratios=[share, 1.0])
    return parts[0], parts[1]


def gear(axes: Axes, center: complex, pitch: float, tip: float, color: str, label: str) -> None:
    """A gear to scale: pitch circle solid, tip circle dashed (of a ring gear it lies inside)."""
    from matplotlib.patches import Circle

    if tip > pitch:
        axes.add_patch(Circle((center.real, center.imag), pitch, facecolor=color, alpha=0.10, linewidth=0, zorder=1))
    style.circle(axes, center, pitch, color=color, linewidth=1.5, zorder=3)
    style.circle(axes, center, tip, color=color, linewidth=0.9, linestyle=DASHED, zorder=3)
    axes.plot([], [], color=color, linewidth=1.5, label=label)


def letters(axes: Axes, joints: Mapping[str, tuple[complex, Sequence[complex]]]) -> None:
    """The letters of joints, each away from the neighbours that its links lead to."""
    for name, (point, neighbours) in joints.items():
        ways = [(other - point) / abs(other - point) for other in neighbours if other != point] or [-1j]
        away = -sum(ways, 0j)
        if abs(away) < 0.2:
            away = 1j * ways[0]
        away *= 12.0 / abs(away)
        box = {"boxstyle": "round,pad=0.1", "facecolor": "white", "edgecolor": "none", "alpha": 0.7}
        axes.annotate(
            name,
            (point.real, point.imag),
            (away.real, away.imag),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=10,
            fontweight="bold",
            bbox=box,
            zorder=8,
        )


def facts(axes: Axes, design: Design, names: Sequence[str]) -> None:
    """Legend and numbers beside a drawing, on its right; what the words add after a semicolon is left out."""
    axes.autoscale_view()
    axes.margins(0.03)
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=8, borderaxespad=0.0)
    found = [design.quantity(name) for name in names]
    lines = [
        f"{q.words.partition(';')[0]}: {_text(q.value)} {q.unit}".removesuffix(" 1") for q in found if q is not None
    ]
    axes.text(1.012, 0.0, "\n".join(lines), transform=axes.transAxes, va="bottom", fontsize=8, linespacing=1.45)


def _text(value: object) -> str:
    if isinstance(value, list):
        return ", ".join(_text(item) for item in value) or "none"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def chart(axes: Axes, title: str, ylabel: str, xlabel: str = "crank angle [deg]", turn: bool = True) -> None:
    """An empty chart over the crank angle."""
    style.curves(axes, xlabel, ylabel)
    if turn:
        style.full_turn(axes)
    panels.small_ticks(axes)
    panels.heading(axes, title)


def columns(design: Design, table: str) -> dict[str, Any]:
    """The columns of a table by name."""
    found = design.table(table)
    return dict(zip(found.columns, found.data, strict=True))


def closed(values: Any, gain: float = 0.0) -> Any:
    """A column with its first value, and what a turn adds, put at the end."""
    import numpy as np

    data = np.asarray(values, dtype=float)
    return np.append(data, data[0] + gain)
