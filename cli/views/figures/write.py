"""Writing a design's figure: the figure module of its kind is imported here and nowhere else."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

from gearlink.cli.evaluate import failures as failing
from gearlink.cli.files import safe_stem, write_atomically
from gearlink.cli.options import DPI, Options
from gearlink.cli.printable import visible
from gearlink.cli.quiet import without_notes
from gearlink.cli.views.figures.drawing.placing import Places, settled
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import FILES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Check

_FIXED_METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": "gearlink"},
    "svg": {"Date": None, "Creator": "gearlink"},
    "pdf": {"CreationDate": None, "Creator": "gearlink"},
}


_SHARED = {"laws": "motion_laws", "loads": "loads", "register": "register", "tolerance": "tolerance"}
"""Modules of the commands that are drawn alike whatever the kind."""
# One part in a hundred longer than at the usual 6, in two thirds of the time.
_PACKING: dict[str, Any] = {"png": {"pil_kwargs": {"compress_level": 3}}}
_FIXED_STYLE = {"svg.hashsalt": "gearlink", "svg.fonttype": "none", "pdf.fonttype": 42}
_ASIAN_FONTS = ("Noto Sans CJK SC", "Source Han Sans SC", "WenQuanYi Zen Hei", "Microsoft YaHei", "PingFang SC")


def draw(command: str, design: Design, checks: Sequence[Check] = (), known: Places | None = None) -> Figure:
    """The figure of a command on a design, its panels placed; failed checks stand under its title.

    Parameters
        known : where the panels stood in the figure of a like design, which leaves out the layout
    """
    from gearlink.cli.views.figures.drawing import style

    made = panels(command, design)
    if failed := failures(checks):
        style.stamp(made, f"fails: {failed}")
        from gearlink.cli.views.figures.of_motion import instants

        instants(made, design, checks)
    return settled(made, known)


def failures(checks: Iterable[Check]) -> str:
    """What fails, each check once with the first value that does; "" where nothing does."""
    from gearlink.cli.views.scenes.scene import drawn

    return drawn(", ".join(failing(checks)))


def panels(command: str, design: Design) -> Figure:
    """The figure of a command on a design, as the kind draws it, not placed yet; all kinds share those of some
    commands."""
    own = FILES[design.kind].drawn if design.kind in FILES else ()
    if command in _SHARED and command not in own:
        made: Figure = load(f"cli.views.figures.{_SHARED[command]}:draw")(design)
    else:
        made = load(FILES[design.kind].picture or "cli.views.figures.of_motion:draw")(command, design)
    return made


def write_plot(command: str, design: Design, options: Options, *, stem: str = "", checks: Sequence[Check] = ()) -> Path:
    """Draw a design and write STEM-COMMAND.FORMAT into the folder of the options; the stem is its name by default.

    Raises
        CannotWrite - where the folder or the disk does not take the file
        NoSolution - where the figure shows something that the design does not have
    """
    name, what = design.spec.name, command.replace(" ", "-")
    return write_figure(lambda: draw(command, design, checks), name, what, options, stem)


def write_figure(make: Callable[[], Figure], name: str, what: str, options: Options, stem: str = "") -> Path:
    """Write the figure that `make` draws as STEM-WHAT.FORMAT into the folder of the options.

    Raises
        CannotWrite - where the folder or the disk does not take the file
    """
    ending = options.plot_format.value
    path = options.out / f"{stem or safe_stem(name)}-{what}.{ending}"
    write_atomically(path, lambda stream: save(make, name, stream, ending, options.dpi, quiet=options.quiet))
    return path


def save(
    make: Callable[[], Figure], name: str, stream: IO[bytes], ending: str, dpi: int = DPI, *, quiet: bool = True
) -> None:
    """Write the figure that `make` draws, in fonts that have the letters of `name`, as png, svg or pdf.

    The same figure gives the same bytes; `dpi` counts for png alone. Unless `quiet`, letters that no font has are told
    of on standard error; an svg has its text as text.
    """
    if not quiet and ending != "svg":
        tell_of_boxes(name)
    with fonts_of(name):
        made = make()
        resolution = dpi if ending == "png" else DPI  # else that of its first canvas, whatever the figure's own
        made.savefig(
            stream, format=ending, dpi=resolution, metadata=_FIXED_METADATA[ending], **_PACKING.get(ending, {})
        )


@contextmanager
def fonts_of(name: str) -> Iterator[None]:
    """Fonts that have the letters of a name, where some are installed; a script that none has is drawn as boxes."""
    with without_notes("matplotlib"):
        import matplotlib

    style: Any = {**_FIXED_STYLE, "font.family": families(name)}
    with matplotlib.rc_context(style), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        yield


@cache
def tell_of_boxes(name: str) -> None:
    """Say once which letters of a name are drawn as boxes, and which fonts have Chinese ones."""
    if name.isascii():
        return
    from matplotlib.font_manager import FontProperties, findfont, get_font

    have: set[int] = set()
    for family in families(name):
        have |= set(get_font(findfont(FontProperties(family=[family]))).get_charmap())
    lacking = "".join(dict.fromkeys(letter for letter in name if ord(letter) not in have and not letter.isspace()))
    if lacking:
        fonts = f"{', '.join(_ASIAN_FONTS[:-1])} or {_ASIAN_FONTS[-1]}"
        print(f"note: no installed font has {visible(lacking)}: boxes in the figure; with Chinese: {fonts}",
              file=sys.stderr)  # fmt: skip


def families(name: str) -> list[str]:
    """The usual font, and one for the script of the name where it needs one that is installed."""
    if name.isascii():
        return ["sans-serif"]
    with without_notes("matplotlib"):
        from matplotlib.font_manager import get_font_names

    installed = set(get_font_names())
    return ["sans-serif", *(font for font in _ASIAN_FONTS if font in installed)]
