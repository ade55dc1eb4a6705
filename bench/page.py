"""Tables and pictures of measured families: text for a terminal, Markdown, work-precision diagrams."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from textwrap import wrap
from typing import Any

from bench.timing import Family, Row
from gearlink.cli.printable import visible
from gearlink.cli.render.lists import hanging

_HEAD = ("method", "N", "time each", "error", "ratio")


def as_text(families: Sequence[Family], machine: Mapping[str, str]) -> str:
    """Plain tables for a terminal."""
    blocks = ["\n".join(f"{key + ':':12}{value}" for key, value in machine.items())]
    for family in families:
        rows = [_head(family), *(_cells(row) for row in family.rows)]
        widths = [max(len(row[i]) for row in rows) for i in range(len(_HEAD))]
        lines = [_aligned(row, widths) for row in rows]
        notes = [hanging(note, "    ", "  ") for note in _notes(family)]
        blocks.append("\n".join([family.title, *lines, *notes]))
    return "\n\n".join(blocks)


def as_markdown(
    families: Sequence[Family], machine: Mapping[str, str], pictures: Mapping[str, str] | None = None
) -> str:
    """The same as Markdown, with the pictures where there are any."""
    blocks = ["\n".join(f"* {key}: {value}" for key, value in machine.items())]
    for family in families:
        lines = [f"## {family.title}", ""]
        lines += [f"| {' | '.join(_head(family))} |", "|---|---:|---:|---:|---:|"]
        lines += [f"| {' | '.join(_cells(row))} |" for row in family.rows]
        lines += ["", *(f"* {note}" for note in _notes(family))]
        if pictures and family.name in pictures:
            lines += ["", f"![{family.title}]({pictures[family.name]})"]
        blocks.append("\n".join(lines))
    return "\n\n".join(blocks) + "\n"


def _head(family: Family) -> tuple[str, ...]:
    unit = "" if family.unit == "none" else f" [{family.unit}]"
    return (*_HEAD[:3], f"error{unit}", "ratio")


def _notes(family: Family) -> list[str]:
    return [f"ratio: to {family.reference}", *family.notes]


def _cells(row: Row) -> tuple[str, ...]:
    error = f"{row.error:.2g}" if math.isfinite(row.error) else "-"
    return row.method, f"{row.size}", duration(row.nanoseconds), error, f"{row.ratio:.3g}"


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    first, *rest = (
        cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(row, widths, strict=True))
    )
    return "  ".join([first, *rest]).rstrip()


def duration(nanoseconds: float) -> str:
    """A time with three digits.

    Example
        >>> duration(17.43), duration(2764000.0)
        ('17.4 ns', '2.76 ms')
    """
    for unit, size in (("s", 1e9), ("ms", 1e6), ("us", 1e3)):
        if nanoseconds >= size:
            return f"{nanoseconds / size:.3g} {unit}"
    return f"{nanoseconds:.3g} ns"


def draw(family: Family, path: Path) -> None:
    """Work-precision diagram: error over time each, both axes logarithmic; each point bears its method's number."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from gearlink.cli.views.figures.drawing import style

    figure = style.figure(9.0, 5.5, "\n".join(wrap(family.title, 72)))
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    plotted = curves(family)
    foot = "; none: at the foot" if any(e == 0.0 for points in plotted.values() for _, e in points) else ""
    style.curves(axes, "time each [ns]", f"worst error [{family.unit}{foot}]")
    axes.set(xscale="log", yscale="log")
    least = min((e for points in plotted.values() for _, e in points if e > 0.0), default=1e-16)
    colors = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY, style.BLACK)
    for i, (name, points) in enumerate(plotted.items()):
        times, errors = zip(*sorted(points), strict=True)
        shown, color = [max(e, 0.3 * least) for e in errors], colors[i % len(colors)]
        # Steps of one method follow each other; sizes are points of their own.
        line = "-" if any(row.method.startswith(f"{name}, ") for row in family.rows) else "none"
        look: dict[str, Any] = {"marker": "o", "markersize": 11, "markerfacecolor": "white", "linewidth": 1.0}
        axes.plot(times, shown, color=color, linestyle=line, label=f"{i + 1}  {name}", **look, zorder=3 + i)
        for x, y in zip(times, shown, strict=True):
            axes.text(x, y, str(i + 1), fontsize=6.5, ha="center", va="center_baseline", zorder=3.5 + i)
    axes.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5), frameon=False, handlelength=1.2)
    figure.savefig(path, dpi=100, metadata={"Software": None})


def curves(family: Family) -> dict[str, list[tuple[float, float]]]:
    """Points (time, error) of each curve: a method over its sizes, or over its steps at the largest size."""
    found: dict[str, list[tuple[float, float]]] = {}
    largest: dict[str, int] = {}
    for row in family.rows:
        largest[row.method] = max(row.size, largest.get(row.method, 0))
    siblings = Counter(method.partition(", ")[0] for method in largest)
    for row in family.rows:
        name, _, step = row.method.partition(", ")
        stepped = siblings[name] > 1 and any(c.isdigit() for c in step)
        if math.isfinite(row.error) and (not stepped or row.size == largest[row.method]):
            found.setdefault(name if stepped else row.method, []).append((row.nanoseconds, row.error))
    return found


def write_pictures(families: Sequence[Family], folder: Path, say: Callable[[str], None]) -> dict[str, str]:
    """A picture for every family that has errors; names of the files by family."""
    folder.mkdir(parents=True, exist_ok=True)
    written = {}
    for family in families:
        if curves(family):
            path = folder / f"bench-{family.name}.png"
            draw(family, path)
            say(f"wrote {visible(str(path))}")
            written[family.name] = path.name
    return written
