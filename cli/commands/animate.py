"""`gearlink animate`: the mechanism of a design file in motion, as GIF, mp4 or HTML."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import IO, TYPE_CHECKING

import numpy as np

from gearlink.cli.evaluate import checks_of, open_design, read_spec, refusals_located, whole_design, wrong_kind
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, safe_stem, write_atomically, wrote
from gearlink.cli.options import Options
from gearlink.cli.progress import counted, patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.cli.views.films.stage import Stage
from gearlink.cli.views.scenes import shown
from gearlink.cli.views.scenes.linkages import build, moves, moving_kinds, pictures_for

if TYPE_CHECKING:
    from gearlink.cli.views.scenes.scene import Scene
    from gearlink.core.base.design import Design

_SIZE = re.compile(r"(\d{3,4})x(\d{3,4})")
_LEAST_SIZE, _MOST_SIZE = 160, 3840
_PROBES = 96


@dataclass(frozen=True, slots=True)
class Asked:
    """A moving picture as the command line asks for it; without seconds, as long as its teeth want."""

    format: str = "gif"
    fps: int = 25
    seconds: float | None = None
    size: str = "960x720"
    show: str = ""


def run_animate(source: str, asked: Asked, options: Options) -> int:
    """Write NAME-motion.FORMAT and give the exit status."""
    try:
        width, height = _size(asked.size)
        if asked.format == "mp4":
            from gearlink.cli.views.films.raster import ffmpeg

            ffmpeg()
        with patience(f"drawing {source}", quiet=options.quiet):
            design, scene = _scene(source, asked, options)
            stage = Stage(scene, design.spec.name, width, height)
            path = options.out / f"{safe_stem(design.spec.name)}-motion.{asked.format}"
            write_atomically(path, lambda stream: _write(stream, stage, asked, options))
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, source, options)
    if not options.quiet:
        print(wrote(path), file=sys.stderr)
    return ExitCode.OK


def _scene(source: str, asked: Asked, options: Options) -> tuple[Design, Scene]:
    """The design of a file and its scene; whatever the mechanism refuses becomes a located error."""
    with _show_as_told():
        wanted = shown.wishes(asked.show)
    loaded, kind = open_design(source, options)
    if not moves(kind.name):
        raise wrong_kind(loaded, f"a {kind.name} does not move; kinds that do: {', '.join(moving_kinds())}")
    spec = read_spec(loaded, kind, source)
    with refusals_located(loaded):
        design = whole_design(kind, spec)
        if asked.seconds is None:
            count = pictures_for(build(design, np.arange(_PROBES) / _PROBES), asked.fps)
        else:
            count = max(2, round(asked.seconds * asked.fps))
        with _show_as_told():
            return design, shown.build(design, np.arange(count) / count, wanted, checks_of(kind, spec))


def require_shown(design: Design, show: str) -> None:
    """Refuse what cannot be shown on a mechanism, before all else is made."""
    with _show_as_told():
        shown.build(design, np.array([0.0, 0.5]), shown.wishes(show))


@contextmanager
def _show_as_told() -> Iterator[None]:
    """What `--show` asks for and cannot be had becomes an error of the command line."""
    try:
        yield
    except shown.WrongShow as error:
        raise DesignFileError([Diagnostic("GL115", str(error), "<command line>", key="--show")]) from None


def _size(text: str) -> tuple[int, int]:
    """Width and height; even, as video wants them."""
    found = _SIZE.fullmatch(text)
    width, height = (int(found[1]), int(found[2])) if found else (0, 0)
    if min(width, height) >= _LEAST_SIZE and max(width, height) <= _MOST_SIZE:
        return width - width % 2, height - height % 2
    words = f"{text!r} must be WIDTHxHEIGHT, each from {_LEAST_SIZE} to {_MOST_SIZE} pixels, as in 960x720"
    raise DesignFileError([Diagnostic("GL115", words, "<--size>", key=text)])


def _write(stream: IO[bytes], stage: Stage, asked: Asked, options: Options) -> None:
    if asked.format == "html":
        from gearlink.cli.views.films.page import page

        stream.write(page(stage, asked.fps).encode())
        return
    from gearlink.cli.views.films.raster import Raster, write_gif, write_mp4

    raster, count = Raster(stage), stage.count
    pictures = counted(range(count), "drawing", quiet=options.quiet)
    if asked.format == "mp4":
        write_mp4(stream, raster, asked.fps, pictures)
    else:
        write_gif(stream, raster, count, asked.fps, pictures)
