"""A loop as one HTML page that needs nothing else: positions as JSON, drawn on a canvas, with controls."""

from __future__ import annotations

import html
import json
import math
import re
from collections.abc import Iterator
from dataclasses import replace
from importlib import resources
from typing import Any, TypeAlias

import numpy as np

from gearlink.cli.views.films.stage import Box, ChartScale, Stage
from gearlink.cli.views.scenes.scene import Arrow, Chain, Chart, Line, Part, Points, Reals, Scene


def page(stage: Stage, fps: float) -> str:
    """The page; the same scene gives the same text."""
    data = as_script(player_data(stage.scene, stage.title, fps, (stage.width, stage.height)))
    parts = {"TITLE": html.escape(stage.title), "STYLE": part("player.css"), "SCRIPT": part("player.js"), "DATA": data}
    return re.sub("@([A-Z]+)@", lambda found: parts[found[1]], part("player.html"))


def as_script(value: Any) -> str:
    """Plain data as a script reads it, without what could end that."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def part(name: str) -> str:
    """A file of the player."""
    return (resources.files("gearlink.cli.views.films") / name).read_text(encoding="utf-8")


Reach: TypeAlias = tuple[float, float, float, float]


def player_stage(scene: Scene, title: str, size: tuple[int, int] = (960, 720), reach: Reach | None = None) -> Stage:
    """The mechanism alone on a picture no higher than it needs: the page shows title, values and chart beside it."""
    width, height = size
    bare = Stage(replace(scene, chart=None), title, width, height, bare=True, reach=reach)
    return replace(bare, height=min(height, bare.needed_height))


def player_data(
    scene: Scene, title: str, fps: float, size: tuple[int, int] = (960, 720), reach: Reach | None = None
) -> dict[str, Any]:
    """What the player is given: parts and marks in pixels of its picture, values, the chart in its own units."""
    stage = player_stage(scene, title, size, reach)
    letters, labels = stage.shifts
    on_body = iter(labels)
    return {
        "width": stage.width,
        "height": stage.height,
        "fps": fps,
        "count": stage.count,
        "title": title,
        "text": stage.text_size,
        "own": scene.own or (0, len(scene.parts), len(scene.marks)),
        "parts": [_part(stage, part, on_body) for part in scene.parts],
        "marks": [
            {
                "p": _xy(stage.pixels(mark.point)),
                "text": mark.text,
                "pivot": mark.pivot,
                "shift": _xy(np.array([shift])),
            }
            for mark, shift in zip(scene.marks, letters, strict=True)
        ],
        "readouts": stage.texts(),
        "keys": [
            {"p": [round(at.real, 2), round(at.imag, 2)], "long": round(long, 2), "words": words, "color": color}
            for at, long, words, color in stage.scales()
        ],
        "framed": [int(stage.framed(i)) for i in range(stage.count)] if scene.faults else [],
        "faults": [stage.failing(i) for i in range(stage.count)] if scene.faults else [],
        "chart": None if scene.chart is None else _chart(scene.chart),
    }


def _part(stage: Stage, part: Part, on_body: Iterator[complex]) -> dict[str, Any]:
    if isinstance(part, Arrow):
        ends = stage.pixels(part.start), stage.pixels(part.start + part.vector)
        return {"is": "arrow", "p": _xy(ends[0]), "q": _xy(ends[1]), "color": part.color, "name": part.name}
    look = {"color": part.color, "width": part.width}
    if isinstance(part, Line):
        return {"is": "line", "p": _xy(stage.pixels(part.points)), "dashed": part.dashed, **look}
    if isinstance(part, Chain):
        joints = [_xy(stage.pixels(joint)) for joint in part.joints]
        return {"is": "chain", "p": joints, "marked": part.marked, **look}
    return {
        "is": "body",
        "o": _xy(stage.scale * np.conj(part.outline)),
        "p": _xy(stage.pixels(part.place)),
        "t": _rounded(-part.turn, 6),
        "fill": part.fill,
        "label": part.label,
        "shift": _xy(np.array([next(on_body) if part.label else 0j])),
        **look,
    }


def _chart(chart: Chart) -> dict[str, Any]:
    scale = ChartScale(chart, Box(0.0, 0.0, 1.0, 1.0))
    return {
        "x": [float(chart.x[0]), float(chart.x[-1])],
        "y": list(scale.y_range),
        "xticks": list(scale.x_values()),
        "yticks": list(scale.y_values()),
        "xlabel": chart.xlabel,
        "ylabel": chart.ylabel,
        "now": _rounded(chart.now, 4),
        "bands": [{"name": b.name, "start": b.start, "end": b.end, "color": b.color} for b in chart.bands],
        "curves": [
            {"label": curve.label, "color": curve.color}
            | {axis: _figures(values) for axis, values in (("x", chart.x), ("y", curve.y), ("now", curve.now))}
            for curve in chart.curves
        ],
    }


def _figures(values: Reals) -> list[float]:
    return [float(f"{value:.6g}") for value in values.tolist()]


def _xy(points: Points) -> list[Any]:
    """x, y, x, y ... in hundredths of a pixel."""
    return _rounded(np.column_stack([points.real, points.imag]).ravel(), 2)


def _rounded(values: Reals, places: int) -> list[Any]:
    """Numbers for JSON; what is not there is null."""
    # A sum with 0.0 makes 0.0 of -0.0.
    rounded: list[float] = (np.round(values, places) + 0.0).tolist()
    if np.isfinite(values).all():
        return rounded
    return [value if math.isfinite(value) else None for value in rounded]
