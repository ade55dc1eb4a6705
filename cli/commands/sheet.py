"""`gearlink sheet`: further sheets of a design: motion of every output, timing, pressure angles, drawings of cams."""

from __future__ import annotations

import shlex
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import open_design, read_spec, refusals_located, whole_design
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, safe_stem, write_atomically, wrote
from gearlink.cli.options import Options
from gearlink.cli.patience import patience
from gearlink.cli.progress import counted
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.core.base.errors import named
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.cli.views.figures.sheets.true_size import Scale
    from gearlink.core.base.design import Design


def run_sheet(
    source: str, names: Sequence[str], options: Options, scale: str | None = None, paper: str | None = None
) -> int:
    """Write NAME-SHEET.png for each sheet asked for, or for all that the design has; gives the exit status.

    Parameters
        scale, paper : "1" or "1:N" of cams true to size, and the sheet of paper that they are to fit on
    """

    try:
        size = _scale(scale, paper, names)
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        with refusals_located(loaded), patience(f"drawing {spec.name}", quiet=options.quiet):
            design = whole_design(kind, spec)
            made = sheets_of(design, size)
            chosen, paths = _chosen(made, names, spec, source), []
            failed = _failures(design) if any(map(_of_cams, chosen)) else ""
            for number in counted(range(len(chosen)), f"drawing {spec.name}", quiet=options.quiet):
                name = chosen[number]
                paths.append(_write(made, name, spec, options, failed if _of_cams(name) else ""))
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, source, options)
    if not options.quiet:
        print("\n".join(wrote(path) for path in paths), file=sys.stderr)
    return ExitCode.FINDING if failed else ExitCode.OK


def _of_cams(name: str) -> bool:
    """Whether a sheet is for the workshop: it bears what fails."""
    return name == "pressure" or name.startswith("drawing")


def _failures(design: Design) -> str:
    """The checks of the cams that fail."""
    from gearlink.cli.views.figures.write import failures

    asked: tuple[str, ...] = design.spec.commands()
    outline = design.outline("cam" if "cam" in asked else asked[0])
    return failures(check for name in outline.checks for check in design.check(name))


def _chosen(made: Makers, names: Sequence[str], spec: Any, source: str) -> list[str]:
    """The sheets asked for, each once; `drawing` is that of every cam."""
    chosen: list[str] = []
    kind = spec.kind
    for name in names or tuple(made):
        found = [sheet for sheet in made if sheet == name or sheet.rpartition("-")[0] == name]
        if not found:
            known = f"it has {', '.join(made)}" if made else f"it has none; {_who_has()}"
            message = f"this {kind} has no sheet named {named(name)}; {known}"
            raise DesignFileError([Diagnostic("GL115", message, "<command line>", key=name)])
        chosen += found
    if not chosen:
        help_ = f"its sheet is drawn by `gearlink {spec.commands()[0]} {shlex.quote(source)} --plot`; {_who_has()}"
        message = f"`sheet` draws motion, timing, pressure angles and cams, of which this {kind} has none"
        raise DesignFileError([Diagnostic("GL113", message, "<command line>", key="kind", help=help_)])
    return list(dict.fromkeys(chosen))


def _who_has() -> str:

    return f"the kinds with sheets are {', '.join(kinds())}"


def _write(made: Makers, name: str, spec: Any, options: Options, failed: str) -> Path:
    from gearlink.cli.views.figures.drawing import style
    from gearlink.cli.views.figures.drawing.placing import settled
    from gearlink.cli.views.figures.write import save

    ending = options.plot_format.value
    path = options.out / f"{safe_stem(spec.name)}-{name}.{ending}"

    def draw() -> Figure:
        figure = made[name]()
        if failed:
            style.stamp(figure, f"not for manufacture: {failed}")
        return settled(figure)

    write_atomically(path, lambda stream: save(draw, spec.name, stream, ending, options.dpi))
    return path


_ALIKE = ("motion", "timing", "pressure", "drawing")
"""Sheets that are drawn alike of what a kind gives for them; others a kind draws itself."""
Makers = dict[str, Callable[[], "Figure"]]


def kinds() -> tuple[str, ...]:
    """The kinds whose designs have sheets."""
    return tuple(kind.name for kind in KINDS.values() if kind.all_sheets)


def _scale(scale: str | None, paper: str | None, names: Sequence[str]) -> Scale | None:
    """The scale that is asked for; None for drawings on a page of their own.

    Raises
        DesignFileError - for one that cannot be read, a paper without a scale, or sheets that have none
    """
    if scale is None and paper is None:
        return None
    from gearlink.cli.views.figures.sheets.true_size import Scale

    message = ""
    if scale is None:
        message = "--paper goes with --scale: give --scale 1, or 1:2"
    elif not names or any(name.rpartition("-")[0] != "drawing" and name != "drawing" for name in names):
        message = "--scale is that of cams: name the sheet drawing, or drawing-1"
    else:
        one, _, reduction = scale.partition(":")
        with suppress(ValueError):
            value = float(reduction or "1")
            if one == "1" and 0.01 <= value <= 1000.0:
                return Scale(value, paper or "")
        message = f"--scale {scale} is none: write 1, or 1:2 for half the size (1:N, N from 0.01 to 1000)"
    raise DesignFileError([Diagnostic("GL115", message, "<command line>", key="--scale" if scale else "--paper")])


def sheets_of(design: Any, scale: Scale | None = None) -> Makers:
    """The sheets that a design has, by name; a drawing for each cam (`drawing-1`, `drawing-2`), true to a scale.

    Raises
        NoSolution - where the mechanism cannot make its turn
    """
    from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, timing_sheet

    found: Makers = {}
    if motion_sheet.courses(design):
        found["motion"] = lambda: motion_sheet.draw(design)
    if "timing" in KINDS[design.kind].sheets:
        found["timing"] = lambda: timing_sheet.draw(design)
    for name, place in KINDS[design.kind].sheets.items():
        if name not in _ALIKE and place:
            found[name] = lambda place=place: load(place)(design)  # type: ignore[misc]
    cams = cam_sheets.discs(design)
    if cams:
        found["pressure"] = lambda: cam_sheets.pressure(design)
    if scale is not None:
        from gearlink.cli.views.figures.sheets import true_size

        for i in range(len(cams)):
            found[f"drawing-{i + 1}"] = lambda i=i: true_size.drawing(design, i, scale)  # type: ignore[misc]
        return found
    for i in range(len(cams)):
        found[f"drawing-{i + 1}"] = lambda i=i: cam_sheets.drawing(design, i)  # type: ignore[misc]
    return found
