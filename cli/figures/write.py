"""Writing a design's figure: the figure module of its kind is imported here and nowhere else."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any, TypeAlias

from gearlink.cli.files import safe_stem, write_atomically
from gearlink.cli.options import DPI, Options

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.design import Design
    from gearlink.core.report import Check

_FIXED_METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": "gearlink"},
    "svg": {"Date": None, "Creator": "gearlink"},
    "pdf": {"CreationDate": None, "Creator": "gearlink"},
}


_SHARED = ("loads", "tolerance", "register")
# One part in a hundred longer than at the usual 6, in two thirds of the time.
_PACKING: dict[str, Any] = {"png": {"pil_kwargs": {"compress_level": 3}}}
_FIXED_STYLE = {"svg.hashsalt": "gearlink", "svg.fonttype": "none", "pdf.fonttype": 42}
_ASIAN_FONTS = ("Noto Sans CJK SC", "Source Han Sans SC", "WenQuanYi Zen Hei", "Microsoft YaHei", "PingFang SC")


def draw(command: str, design: Design, checks: Sequence[Check] = (), known: Places | None = None) -> Figure:
    """The figure of a command on a design, its panels placed; failed checks stand under its title.

    Parameters
        known : where the panels stood in the figure of a like design, which leaves out the layout
    """
    from gearlink.cli.figures import style

    made = panels(command, design)
    failed = dict.fromkeys(f"{check.code} {check.name}" for check in checks if check.status == "fail")
    if failed:
        style.stamp(made, "fails: " + ", ".join(failed))
    return settled(made, known)


def panels(command: str, design: Design) -> Figure:
    """The figure of a command on a design, from the module named after the kind, not placed yet; all kinds
    share those of some commands."""
    if command in _SHARED:
        made: Figure = import_module(f"gearlink.cli.figures.{command}").draw(design)
    else:
        made = import_module("gearlink.cli.figures." + design.kind.replace("-", "_")).draw(command, design)
    return made


def settled(made: Figure, known: Places | None = None) -> Figure:
    """The figure with its panels placed for good, to the hundredth of a millimetre; where they are known to stand, if
    the lines of its title and the number of its panels are those of that time.

    The solver of the constrained layout leaves last digits to chance; an SVG names its clips after them, and a
    drawing to scale widens its limits by them. So the limits are those from before the layout.
    """
    from gearlink.cli.figures import style

    limits = [(axes.get_xlim(), axes.get_ylim()) for axes in made.axes]
    likeness, boxes = known or ("", ())
    if likeness != _likeness(made):
        boxes = ()
    if (layout := made.get_layout_engine()) and not boxes:
        for axes in made.axes:
            measured_once(axes)
        with ticks_once(made):
            layout.execute(made)
        for axes in made.axes:
            del axes.get_tightbbox  # the method of the class again
    made.set_layout_engine(None)  # "none" would have savefig draw the panels a time more, for a layout
    style.place_title(made)
    for axes, (x, y), box in zip(made.axes, limits, boxes or _boxes(made), strict=True):
        axes.set_position(box)
        axes.set_xlim(x, auto=None)
        axes.set_ylim(y, auto=None)
    return made


Box: TypeAlias = tuple[float, float, float, float]
Places: TypeAlias = tuple[str, tuple[Box, ...]]
"""What tells like figures, and the boxes of their panels."""


def places(made: Figure) -> Places:
    """Where the panels of a settled figure stand."""
    return _likeness(made), _boxes(made)


def _likeness(made: Figure) -> str:
    title = made._suptitle  # type: ignore[attr-defined]
    rows = (
        0 if title is None else 1 + title.get_text().count("\n")
    )  # its words move nothing, as a swing that is changed
    return f"{len(made.axes)} panels below {rows} lines"


def _boxes(made: Figure) -> tuple[Box, ...]:
    found: Any = (axes.get_position(original=True).bounds for axes in made.axes)
    return tuple(tuple(round(side, 5) for side in box) for box in found)


def measured_once(axes: Axes) -> None:
    """Let the room that a panel's words need beside it be measured once.

    The layout measures all words twice, for numbers along an axis may change with its length; those of these sheets
    hardly do, and measuring takes a third of the time of a sheet.
    """
    from matplotlib.transforms import Bbox

    measure = axes.get_tightbbox
    known: list[Any] = []

    def measured(*given: Any, **named: Any) -> Any:
        box: Any = axes.get_position(original=True).transformed(axes.figure.transSubfigure)
        if not known:
            tight = measure(*given, **named)
            known.append(None if tight is None else tight.extents - box.extents)
        return None if known[0] is None else Bbox.from_extents(*(box.extents + known[0]))

    axes.get_tightbbox = measured  # type: ignore[method-assign]


@contextmanager
def ticks_once(made: Figure) -> Iterator[None]:
    """Let every axis place its ticks once: they are asked for five times while panels are measured, three times while
    they are drawn, and nothing moves them in between. The method is matplotlib's own affair: without it all is as ever.
    """
    every = [axis for axes in made.axes for axis in (axes.xaxis, axes.yaxis) if hasattr(axis, "_update_ticks")]
    for axis in every:
        axis._update_ticks = _once(axis._update_ticks)
    try:
        yield
    finally:
        for axis in every:
            del axis._update_ticks


def _once(update: Callable[[], Any]) -> Callable[[], Any]:
    known: list[Any] = []

    def updated() -> Any:
        if not known:
            known.append(update())
        return known[0]

    return updated


def write_plot(command: str, design: Design, options: Options, *, stem: str = "", checks: Sequence[Check] = ()) -> Path:
    """Draw a design and write STEM-COMMAND.FORMAT into the folder of the options; the stem is its name by default.

    Raises
        CannotWrite - where the folder or the disk does not take the file
        NoSolution - where the figure shows something that the design does not have
    """
    ending = options.plot_format.value
    path = options.out / f"{stem or safe_stem(design.spec.name)}-{command.replace(' ', '-')}.{ending}"
    name = design.spec.name
    write_atomically(
        path, lambda stream: save(lambda: draw(command, design, checks), name, stream, ending, options.dpi)
    )
    return path


def save(make: Callable[[], Figure], name: str, stream: IO[bytes], ending: str, dpi: int = DPI) -> None:
    """Write the figure that `make` draws, in fonts that have the letters of `name`, as png, svg or pdf.

    The same figure gives the same bytes; `dpi` counts for png alone.
    """
    with fonts_of(name):
        made = make()
        made.set_dpi(dpi if ending == "png" else DPI)
        with ticks_once(made):
            made.savefig(stream, format=ending, metadata=_FIXED_METADATA[ending], **_PACKING.get(ending, {}))


@contextmanager
def fonts_of(name: str) -> Iterator[None]:
    """Fonts that have the letters of a name, where some are installed; a script that none has is drawn as boxes."""
    import matplotlib

    style: Any = {**_FIXED_STYLE, "font.family": families(name)}
    with matplotlib.rc_context(style), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        yield


def families(name: str) -> list[str]:
    """The usual font, and one for the script of the name where it needs one that is installed."""
    if name.isascii():
        return ["sans-serif"]
    from matplotlib.font_manager import get_font_names

    installed = set(get_font_names())
    return ["sans-serif", *(font for font in _ASIAN_FONTS if font in installed)]
