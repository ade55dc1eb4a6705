"""`gearlink sheet`: further sheets of a design: motion, timing, pressure angles, drawings of parts."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.cli.commands.animate import require_shown
from gearlink.cli.evaluate import checks_of, open_design, read_spec, refusals_located, whole_design
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, wrote
from gearlink.cli.options import Options
from gearlink.cli.printable import for_shell
from gearlink.cli.progress import counted, patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.core.base.errors import named
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.cli.views.figures.sheets.true_size import Scale
    from gearlink.core.base.report import Check


class Asked(NamedTuple):
    """What the command line asks of sheets.

    Fields
        scale, paper : "1" or "1:N" of cams true to size, and the sheet of paper that they are to fit on
        at : inputs of the sheet `vectors` [deg, mm], separated by commas
        show : what it draws on the mechanism
    """

    scale: str | None = None
    paper: str | None = None
    at: str = ""
    show: str = ""


def run_sheet(source: str, names: Sequence[str], options: Options, asked: Asked) -> int:
    """Write NAME-SHEET.png for each sheet asked for, or for all that the design has; gives the exit status."""
    from gearlink.cli.views.figures.write import failures

    try:
        size, at = _scale(asked.scale, asked.paper, names), _inputs(asked.at)
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        with refusals_located(loaded), patience(f"drawing {spec.name}", quiet=options.quiet):
            design = whole_design(kind, spec)
            made = sheets_of(design, size, at, asked.show)
            chosen, paths = _chosen(made, names, spec, source), []
            _require_vectors(asked, at, chosen, design)
            checks = checks_of(kind, spec)
            failed = failures(checks)
            for number in counted(range(len(chosen)), f"drawing {spec.name}", quiet=options.quiet):
                paths.append(_write(made, chosen[number], design, options, checks))
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, source, options)
    if not options.quiet:
        print("\n".join(wrote(path) for path in paths), file=sys.stderr)
    return ExitCode.FINDING if failed and any(map(_is_drawing, chosen)) else ExitCode.OK


def _is_drawing(name: str) -> bool:
    return name.startswith("drawing")


def _inputs(text: str) -> list[float]:
    """The inputs of `--at`.

    Raises
        DesignFileError
    """
    try:
        found = [float(part) for part in text.split(",") if part.strip()]
        if len(found) <= _MOST_INPUTS and all(map(math.isfinite, found)):
            return found
    except ValueError:
        pass
    message = f"--at {text} must be at most {_MOST_INPUTS} numbers, separated by commas: 30,120"
    raise DesignFileError([Diagnostic("GL115", message, "<command line>", key="--at")])


def _require_vectors(asked: Asked, at: Sequence[float], chosen: Sequence[str], design: Any) -> None:
    """Refuse what the sheet `vectors` cannot draw, and what only that one knows where it is not drawn."""
    for key, given in (("--at", asked.at), ("--show", asked.show)):
        if given and "vectors" not in chosen:
            drawn = f"only {', '.join(chosen)} {'is' if len(chosen) == 1 else 'are'} drawn"
            message = f"{key} {given} applies only to the sheet vectors; {drawn}"
            raise DesignFileError([Diagnostic("GL115", message, "<command line>", key=key)])
    if at:
        from gearlink.cli.views.figures.sheets.vector_sheet import beyond

        if message := beyond(design, at):
            raise DesignFileError([Diagnostic("GL115", f"--at {message}", "<command line>", key="--at")])
    if asked.show:
        require_shown(design, asked.show)


def _chosen(made: Makers, names: Sequence[str], spec: Any, source: str) -> list[str]:
    """The sheets asked for, each once; `drawing` is that of every part."""
    chosen: list[str] = []
    kind = spec.kind
    for name in names or tuple(made):
        found = [sheet for sheet in made if sheet == name or sheet.partition("-")[0] == name]
        if not found:
            known = f"it has {', '.join(made)}" if made else f"it has none; {_who_has()}"
            message = f"this {kind} has no sheet named {named(name)}; {known}"
            raise DesignFileError([Diagnostic("GL115", message, "<command line>", key=name)])
        chosen += found
    if not chosen:
        help_ = f"its sheet is drawn by `gearlink {spec.commands()[0]} {for_shell(source)} --plot`; {_who_has()}"
        message = f"`sheet` draws motion, timing, pressure angles and parts, of which this {kind} has none"
        raise DesignFileError([Diagnostic("GL113", message, "<command line>", key="kind", help=help_)])
    return list(dict.fromkeys(chosen))


def _who_has() -> str:
    return f"the kinds with sheets are {', '.join(kinds())}"


def _write(made: Makers, name: str, design: Any, options: Options, checks: Sequence[Check]) -> Path:
    from gearlink.cli.views.figures.drawing import style
    from gearlink.cli.views.figures.drawing.placing import settled
    from gearlink.cli.views.figures.of_motion import instants
    from gearlink.cli.views.figures.write import failures, write_figure

    failed = failures(checks)

    def draw() -> Figure:
        figure = made[name]()
        if failed and _is_drawing(name):
            style.forbid(figure, f"NOT FOR MANUFACTURE: {failed}")
        elif failed:
            style.stamp(figure, f"fails: {failed}")
            instants(figure, design, checks)
        return settled(figure)

    return write_figure(draw, design.spec.name, name, options)


_MOST_INPUTS = 4
_ALIKE = ("motion", "vectors", "forces", "dwell", "zone", "timing", "pressure", "contact", "drawing")
"""Sheets that are drawn alike of what a kind gives for them; others a kind draws itself."""
Makers = dict[str, Callable[[], "Figure"]]


def kinds() -> tuple[str, ...]:
    """The kinds whose designs have sheets."""
    return tuple(kind.name for kind in KINDS.values() if kind.all_sheets or kind.cut)


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
        message = "--paper without --scale\ngive --scale 1, or 1:2"
    elif not names or any(name.rpartition("-")[0] != "drawing" and name != "drawing" for name in names):
        message = "--scale applies only to drawings of cams\nname the sheet drawing, or drawing-1"
    else:
        one, _, reduction = scale.partition(":")
        with suppress(ValueError):
            value = float(reduction or "1")
            if one == "1" and 0.01 <= value <= 1000.0:
                return Scale(value, paper or "")
        message = f"--scale {scale} is not a scale\ngive 1, or 1:2 for half the size (1:N, N from 0.01 to 1000)"
    raise DesignFileError([Diagnostic("GL115", message, "<command line>", key="--scale" if scale else "--paper")])


def sheets_of(design: Any, scale: Scale | None = None, at: Sequence[float] = (), show: str = "") -> Makers:
    """The sheets that a design has, by name: a drawing for each cam (`drawing-1`, true to a scale) and other part.

    Raises
        NoSolution - where the mechanism cannot make its turn
        DesignFileError - for a scale where there are no disc cams
    """
    from gearlink.cli.views.figures import loads, tolerance
    from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, part_drawing, timing_sheet, true_size
    from gearlink.cli.views.figures.sheets import vector_sheet as vectors

    kind, cams = KINDS[design.kind], cam_sheets.discs(design)
    found: Makers = {}
    if motion_sheet.courses(design):
        found["motion"] = partial(motion_sheet.draw, design)
    if "vectors" in kind.all_sheets and vectors.draws(design):
        found["vectors"] = partial(vectors.draw, design, at, show)
    if "forces" in kind.all_sheets and loads.draws(design):
        found["forces"] = partial(loads.draw_forces, design)
    if "dwell" in kind.all_sheets and motion_sheet.dwell_of(design) is not None:
        found["dwell"] = partial(motion_sheet.dwell, design)
    if motion_sheet.has_zone(design):
        found["zone"] = partial(motion_sheet.zone, design)
    if tolerance.study_of(design) is not None:
        found["tornado"] = partial(tolerance.draw_tornado, design)
    if "timing" in kind.sheets:
        found["timing"] = partial(timing_sheet.draw, design)
    own = {name: place for name, place in kind.sheets.items() if name not in _ALIKE and place}
    found |= {name: partial(load(place), design) for name, place in own.items()}
    if cams and "pressure" in kind.sheets and cam_sheets.touching(cams[0]) != "face":
        found["pressure"] = partial(cam_sheets.pressure, design)
        found["contact"] = partial(motion_sheet.contact, design)
    if scale is not None and not cams:
        message = f"--scale is for drawings of disc cams, of which this {design.kind} has none\nomit --scale"
        raise DesignFileError([Diagnostic("GL115", message, "<command line>", key="--scale")])
    drawing = true_size.workshop_drawing if scale is None else partial(true_size.drawing, scale=scale)
    found |= {f"drawing-{i + 1}": partial(drawing, design, i) for i in range(len(cams))}
    if scale is None:
        found.update((f"drawing-{name}", make) for name, make in part_drawing.drawn(design).items())
    return found
