"""What stands still behind a moving picture: fixed lines, the chart with its words, the title."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from PIL import Image, ImageDraw

from gearlink.cli.views.films.brush import FINER, dashes, flat, font
from gearlink.cli.views.films.stage import ChartScale, Stage
from gearlink.cli.views.scenes.colors import BLACK, GREY, LIGHT, WHITE
from gearlink.cli.views.scenes.scene import Line

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

_FINEST, _EDGE = 4, 4
"""How many times as large as the large picture its curves are drawn, and what is left about them [large pixel]."""


def backdrop(stage: Stage) -> Picture:
    """The large picture that all others are drawn on."""
    made = Image.new("RGB", (FINER * stage.width, FINER * stage.height), WHITE)
    draw = ImageDraw.Draw(made)
    for part in stage.scene.parts:
        if isinstance(part, Line):
            _line(draw, part, stage)
    size = FINER * stage.text_size
    letters, room = font(1.25 * size, stage.title), made.width - 1.8 * size
    title = stage.title
    while len(title) > 1 and draw.textlength(title, font=letters) > room:
        title = title.rstrip("…")[:-1] + "…"
    draw.text((0.9 * size, 0.6 * size), title, font=letters, fill=BLACK)
    if stage.scene.chart is not None:
        scale = ChartScale(stage.scene.chart, stage.chart_room)
        _chart(draw, scale)
        _curves(made, scale)
        _chart_words(draw, scale, size)
    return made


def _line(draw: ImageDraw.ImageDraw, line: Line, stage: Stage) -> None:
    points = FINER * stage.pixels(line.points)
    width = max(1, round(line.width * FINER))
    for stretch in dashes(points, 7.0 * FINER) if line.dashed else [points]:
        draw.line(flat(stretch), fill=line.color, width=width)


def _chart(draw: ImageDraw.ImageDraw, scale: ChartScale) -> None:
    room = scale.room
    for band in scale.chart.bands:
        at = scale.points(np.array([band.start, band.end]), np.zeros(2)).real
        box = [FINER * at[0], FINER * room.top, FINER * at[1], FINER * room.bottom]
        draw.rectangle([float(side) for side in box], fill=band.color)
    for x, _ in scale.x_ticks():
        draw.line([FINER * x, FINER * room.top, FINER * x, FINER * room.bottom], fill=LIGHT, width=FINER)
    for y, _ in scale.y_ticks():
        draw.line([FINER * room.left, FINER * y, FINER * room.right, FINER * y], fill=LIGHT, width=FINER)
    corners = [room.left, room.top, room.left, room.bottom, room.right, room.bottom]
    draw.line([FINER * corner for corner in corners], fill=GREY, width=FINER)


def _curves(made: Picture, scale: ChartScale) -> None:
    """The curves, drawn larger still: one that rises slowly shows where Pillow rounds its points to whole pixels."""
    left, top, right, bottom = (FINER * round(side) for side in scale.room.sides)
    left, top, right, bottom = left - _EDGE, top - _EDGE, right + _EDGE, bottom + _EDGE
    part = made.crop((left, top, right, bottom)).resize((_FINEST * (right - left), _FINEST * (bottom - top)), 0)
    draw = ImageDraw.Draw(part)
    for curve in scale.chart.curves:
        points = _FINEST * (FINER * scale.points(scale.chart.x, curve.y) - complex(left, top))
        draw.line(flat(points), fill=curve.color, width=2 * FINER * _FINEST, joint="curve")
    made.paste(part.reduce(_FINEST), (left, top))


def _chart_words(draw: ImageDraw.ImageDraw, scale: ChartScale, size: float) -> None:
    """Numbers and names of the axes; several curves are named in their colours, above the right end of the chart."""
    small = font(0.85 * size)
    left, top, right, bottom = (FINER * side for side in scale.room.sides)
    for x, words in scale.x_ticks():
        draw.text((FINER * x, bottom + 0.3 * size), words, font=small, fill=GREY, anchor="ma")
    for y, words in scale.y_ticks():
        draw.text((left - 0.4 * size, FINER * y), words, font=small, fill=GREY, anchor="rm")
    for k, band in enumerate(scale.chart.bands):
        row = sum(other.start < band.end and band.start < other.end for other in scale.chart.bands[:k] if other.name)
        start, end = (FINER * float(x) for x in scale.points(np.array([band.start, band.end]), np.zeros(2)).real)
        if small.getlength(band.name) < end - start:
            draw.text((0.5 * (start + end), top + (0.2 + row) * size), band.name, font=small, fill=GREY, anchor="ma")
    draw.text((0.5 * (left + right), bottom + 1.5 * size), scale.chart.xlabel, font=small, fill=BLACK, anchor="ma")
    draw.text((left, top - 0.35 * size), scale.chart.ylabel, font=small, fill=BLACK, anchor="ls")
    for curve in reversed(scale.chart.curves if len(scale.chart.curves) > 1 else ()):
        draw.text((right, top - 0.35 * size), curve.label, font=small, fill=curve.color, anchor="rs")
        right -= draw.textlength(curve.label, font=small) + 1.2 * size
