"""Draws the figures of docs/img: the animation and the press of the README, and thumbnails of the kinds.

Run by `make docs`.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image
from typer.testing import CliRunner

from gearlink.cli.app import app
from gearlink.cli.evaluate import open_design, read_spec, whole_design
from gearlink.cli.options import Options
from gearlink.cli.views.films.raster import Raster
from gearlink.cli.views.films.stage import Stage
from gearlink.cli.views.scenes.linkages import build
from gearlink.cli.views.scenes.scene import Scene

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "docs" / "img"
# The example of each kind and the part of its loop that its thumbnail shows.
THUMBNAILS = {
    "three-gear-four-bar": ("standing_feed", 0.75),
    "two-gear-four-bar": ("two_gear_standing", 0.2),
    "geared-rocker": ("wide_lever", 0.2),
    "geared-five-bar": ("five_bar_path", 0.1),
    "geared-six-bar": ("geared_six_bar", 0.15),
    "hypocycloid-dwell": ("hypocycloid_slider", 0.2),
    "mutilated-gear-dwell": ("mutilated_gear_press", 0.1),
    "geneva-drive": ("geneva_drive", 0.1),
    "crank-rocker": ("crank_rocker", 0.15),
    "slider-crank": ("slider_crank_quick_return", 0.15),
    "planar-mechanism": ("planar_watt", 0.15),
    "flatbed-press": ("ty460", 0.17),
    "swing-gripper": ("swing_gripper", 0.4),
    "wide-swing-cam": ("wide_swing_cycle", 0.3),
    "disc-cam": ("lift_cam", 0.12),
    "cylindrical-cam": ("barrel_cam", 0.1),
    "linked-cams": ("linked_cams", 0.1),
    "cam-gear": ("cam_gear", 0.1),
    "cam-linkage": ("cam_linkage", 0.1),
    "cycloidal-reducer": ("cycloidal_reducer", 0.1),
    "gear-pair": ("ring_pair", 0.0),
    "measured-cam": ("measured_cam", 0.12),
    "machine": ("sheet_press", 0.1),
}
# Of the kinds that have no loop: command, example, and the part of its figure by shares of width and height.
PARTS = {
    "gear-train-mobility": ("analyze", "six_bar_two_trains", (0.02, 0.1, 0.58, 0.93)),
    "motion-law": ("analyze", "quiet_law", (0.1, 0.07, 0.97, 0.32)),
    "study": ("explore", "studies/dwell_feed", (0.07, 0.05, 0.53, 0.29)),
}
_THUMBNAIL, _EDGE = (200, 150), 6
# Teeth move on by less than half a pitch from one frame to the next; more frames or colours exceed 400 kB.
_FEED, _FEED_FRAMES, _FEED_FPS, _FEED_COLORS = (316, 266), 90, 15, 16


def scene_of(name: str, fractions: Iterable[float]) -> Scene:
    """The scene of a file of designs/ at fractions of its loop."""
    source = str(ROOT / "designs" / f"{name}.yaml")
    loaded, kind = open_design(source, Options())
    return build(whole_design(kind, read_spec(loaded, kind, source)), np.array(list(fractions)))


def thumbnail(name: str, fraction: float) -> Image.Image:
    """The mechanism alone, without title and chart; drawn at twice the size."""
    width, height = (2 * (size - 2 * _EDGE) for size in _THUMBNAIL)
    steps = 48  # the frame shows all positions, so that it does not depend on the one shown
    loop = (fraction + i / steps for i in range(steps))
    stage = Stage(replace(scene_of(name, loop), chart=None, readouts=()), "", width, height, bare=True)
    made = Image.new("RGB", _THUMBNAIL, "white")
    made.paste(Raster(stage).picture(0).resize((width // 2, height // 2), Image.Resampling.LANCZOS), (_EDGE, _EDGE))
    return made


def part_of_figure(command: str, design: str, part: tuple[float, float, float, float]) -> Image.Image:
    """A part of a command's figure, as large as it may be."""
    with tempfile.TemporaryDirectory() as folder:
        whole = drawn((command,), design, Path(folder))
    found = whole.crop(tuple(round(share * whole.size[i % 2]) for i, share in enumerate(part)))  # type: ignore[arg-type]
    found.thumbnail(tuple(size - 2 * _EDGE for size in _THUMBNAIL), Image.Resampling.LANCZOS)
    made = Image.new("RGB", _THUMBNAIL, "white")
    made.paste(found, tuple((size - own) // 2 for size, own in zip(_THUMBNAIL, found.size, strict=True)))
    return made


def drawn(command: tuple[str, ...], design: str, folder: Path, *options: str) -> Image.Image:
    """The figure of a command."""
    source = str(ROOT / "designs" / f"{design}.yaml")
    words = [*command, source, "--plot", *options, "--out", str(folder), "--quiet"]
    assert CliRunner().invoke(app, words).exit_code == 0
    (path,) = folder.glob("*.png")
    with Image.open(path) as picture:
        return picture.convert("RGB")


def write_png(picture: Image.Image, name: str) -> None:
    """Write a figure in its own colours: a palette of few tints its fills anew at each change."""
    picture.convert("RGB").save(TARGET / f"{name}.png", optimize=True)


def write_feed() -> None:
    """The dwell feed over one revolution of its crank."""
    fractions = [i / _FEED_FRAMES for i in range(_FEED_FRAMES)]
    raster = Raster(Stage(scene_of("standing_feed", fractions), "standing-feed", *_FEED))
    palette = raster.picture(0).quantize(_FEED_COLORS, method=Image.Quantize.MEDIANCUT)
    palette.putpalette([255 if part > 250 else part for part in palette.getpalette() or []])  # paper has no tint
    frames = [raster.picture(i).quantize(palette=palette, dither=Image.Dither.NONE) for i in range(_FEED_FRAMES)]
    options = {"save_all": True, "append_images": frames[1:], "duration": 1000 // _FEED_FPS, "loop": 0}
    frames[0].save(TARGET / "feed.gif", "GIF", optimize=False, **options)


def write_figure(command: tuple[str, ...], design: str, dpi: int, name: str) -> None:
    """The figure of a command."""
    with tempfile.TemporaryDirectory() as folder:
        drawn(command, design, Path(folder), "--dpi", str(dpi)).save(TARGET / f"{name}.png", optimize=True)


def write_all() -> None:
    """Every figure of docs/img."""
    TARGET.mkdir(exist_ok=True)
    write_feed()
    write_figure(("press",), "ty460", 80, "press")
    write_figure(("synth", "dwell"), "standing_feed", 80, "first-result")
    for kind, (name, fraction) in THUMBNAILS.items():
        write_png(thumbnail(name, fraction), kind)
    for kind, part in PARTS.items():
        write_png(part_of_figure(*part), kind)


if __name__ == "__main__":
    write_all()
