"""A loop of pictures as GIF: one palette for all of them, and times that add up to the length asked for."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import IO, TYPE_CHECKING

from PIL import Image

from gearlink.cli.moving.raster import Raster

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

_COLORS = 64
_ALMOST = 250


def write_gif(stream: IO[bytes], raster: Raster, count: int, fps: int, told: Iterable[int]) -> None:
    """Write the pictures; `told` counts them and may show how far the work is."""
    palette = _with_white(raster.picture(0).quantize(_COLORS, method=Image.Quantize.MEDIANCUT))
    made = _frames(raster, palette, told)
    first = next(made)
    first.save(stream, "GIF", save_all=True, append_images=made, duration=durations(count, fps), loop=0, optimize=False)


def _with_white(picture: Picture) -> Picture:
    """The picture with what is almost white in its palette made white: paper has no tint."""
    colors = list(picture.getpalette() or [])
    rows = [colors[k : k + 3] for k in range(0, len(colors), 3)]
    picture.putpalette([part for row in rows for part in ([255, 255, 255] if min(row) >= _ALMOST else row)])
    return picture


def _frames(raster: Raster, palette: Picture, told: Iterable[int]) -> Iterator[Picture]:
    for i in told:
        yield raster.picture(i).quantize(palette=palette, dither=Image.Dither.NONE)


def durations(count: int, fps: int) -> list[int]:
    """Times of the pictures [ms] in the hundredths of a second that a GIF knows, without drifting from the rate.

    Example
        >>> durations(4, 30), durations(3, 25)
        ([30, 40, 30, 30], [40, 40, 40])
    """
    ends = [round(100.0 * i / fps) for i in range(count + 1)]
    return [10 * (end - start) for start, end in pairwise(ends)]
