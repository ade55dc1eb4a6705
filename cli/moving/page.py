"""A loop as one HTML page that needs nothing else: positions as JSON, drawn on a canvas, with controls."""

from __future__ import annotations

import html
import json
from collections.abc import Iterator
from importlib import resources
from typing import Any

import numpy as np

from gearlink.cli.moving.stage import ChartScale, Stage
from gearlink.cli.scenes.scene import Body, Chain, Line, Points, Reals


def page(stage: Stage, fps: float) -> str:
    """The page; the same scene gives the same text."""
    template = (resources.files("gearlink.cli.moving") / "player.html").read_text(encoding="utf-8")
    # A closing tag in a name must not end the script.
    data = json.dumps(_data(stage, fps), ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    data = data.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")
    return template.replace("@TITLE@", html.escape(stage.title)).replace("@DATA@", data)


def _data(stage: Stage, fps: float) -> dict[str, Any]:
    scene, (letters, labels) = stage.scene, stage.shifts
    on_body = iter(labels)
    return {
        "width": stage.width,
        "height": stage.height,
        "fps": fps,
        "count": stage.count,
        "title": stage.title,
        "text": stage.text_size,
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
        "chart": _chart(stage),
    }


def _part(stage: Stage, part: Body | Chain | Line, on_body: Iterator[complex]) -> dict[str, Any]:
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


def _chart(stage: Stage) -> dict[str, Any] | None:
    chart = stage.scene.chart
    if chart is None:
        return None
    scale, room = ChartScale(chart, stage.chart_room), stage.chart_room
    return {
        "room": [round(side, 2) for side in (room.left, room.top, room.right, room.bottom)],
        "x": [[round(x, 2), words] for x, words in scale.x_ticks()],
        "y": [[round(y, 2), words] for y, words in scale.y_ticks()],
        "xlabel": chart.xlabel,
        "ylabel": chart.ylabel,
        "curves": [
            {
                "label": curve.label,
                "color": curve.color,
                "p": _xy(scale.points(chart.x, curve.y)),
                "now": _xy(scale.points(chart.now, curve.now)),
            }
            for curve in chart.curves
        ],
    }


def _xy(points: Points) -> list[float]:
    """x, y, x, y ... in hundredths of a pixel."""
    return _rounded(np.column_stack([points.real, points.imag]).ravel(), 2)


def _rounded(values: Reals, places: int) -> list[float]:
    # A sum with 0.0 turns -0.0 into 0.0.
    rounded: list[float] = (np.round(values, places) + 0.0).tolist()
    return rounded
