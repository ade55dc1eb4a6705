"""A loop of pictures as mp4, by the ffmpeg that the machine has."""

from __future__ import annotations

import shutil
import subprocess
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import IO

from gearlink.cli.files import CannotWrite, unfinished
from gearlink.cli.views.films.raster import Raster

_BITEXACT = ("-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "1")


def ffmpeg() -> str:
    """Where ffmpeg is.

    Raises
        CannotWrite - where the machine has none
    """
    found = shutil.which("ffmpeg")
    if found is None:
        raise CannotWrite("mp4 needs the program ffmpeg, which is not on the PATH: install it, or take --format gif")
    return found


def write_mp4(stream: IO[bytes], raster: Raster, fps: int, counted: Iterable[int]) -> None:
    """Write the pictures as H.264.

    Raises
        CannotWrite - where there is no ffmpeg, or it fails
    """
    program, stage = ffmpeg(), raster.stage
    with tempfile.TemporaryDirectory(prefix="gearlink-") as folder, unfinished(folder):
        path = Path(folder) / "motion.mp4"
        raw = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{stage.width}x{stage.height}", "-r", str(fps), "-i", "-")
        coded = ("-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart", *_BITEXACT)
        command = [program, "-v", "error", "-y", *raw, "-an", *coded, str(path)]
        with tempfile.TemporaryFile() as said:
            running = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said)
            _feed(running, raster, counted)
            if running.wait() != 0 or not path.is_file():
                said.seek(0)
                words = said.read().decode(errors="replace").strip().splitlines() or ["no word of why"]
                raise CannotWrite(f"ffmpeg failed: {words[-1][:300]}")
        with path.open("rb") as made:
            shutil.copyfileobj(made, stream)


def _feed(running: subprocess.Popen[bytes], raster: Raster, counted: Iterable[int]) -> None:
    assert running.stdin is not None, "opened as a pipe"
    try:
        for i in counted:
            running.stdin.write(raster.picture(i).tobytes())
    except BrokenPipeError:
        pass  # ffmpeg has ended early; its status and last words say why
    except BaseException:
        running.kill()
        raise
    finally:
        with suppress(BrokenPipeError):
            running.stdin.close()
