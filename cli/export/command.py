"""`gearlink export`: read the design, sample its parts, write one file per part and format."""

from __future__ import annotations

import sys
from collections.abc import Callable
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import open_design, read_spec
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.export import parts
from gearlink.cli.export.options import Export, FileFormat
from gearlink.cli.files import CannotWrite, safe_stem, write_atomically
from gearlink.cli.reading.design_file import diagnose_no_solution
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile
from gearlink.cli.render.errors import show_errors
from gearlink.core.errors import GearlinkError, NoSolution
from gearlink.core.kinds import Kind

if TYPE_CHECKING:
    from gearlink.cli.export.contour import Contour


def run_export(source: str, asked: Export) -> int:
    """Export the parts of the design file `source`, say what was written, and give the exit status.

    1 where the files were written but a profile is unfit for use (the roller cuts into it), 2 where nothing was.
    """
    try:
        spec, contours = _contours(source, asked)
        files = [
            (contour, _path(contour, spec, form, asked), _writer(form)(contour, spec))
            for contour in contours
            for form in asked.formats
        ]
        for contour, path, data in files:
            write_atomically(path, lambda stream, data=data: stream.write(data))  # type: ignore[misc]
            _tell(contour, path, asked)
    except DesignFileError as error:
        show_errors(error.diagnostics, asked.options)
        return ExitCode.WRONG_INPUT
    except CannotWrite as error:
        show_errors([Diagnostic("GL116", str(error), file=source)], asked.options)
        return ExitCode.WRONG_INPUT
    except GearlinkError as error:
        show_errors([Diagnostic("GL115", str(error), file="<command line>")], asked.options)
        return ExitCode.WRONG_INPUT
    findings = [(contour.part.name, text) for contour in contours for text in contour.part.findings]
    for name, text in findings:
        print(f"warning: {name}: {text}", file=sys.stderr)
    return ExitCode.FINDING if findings else ExitCode.OK


def _contours(source: str, asked: Export) -> tuple[Any, list[Contour]]:
    """The spec and the sampled parts; whatever the mechanism refuses becomes a located error."""
    from gearlink.cli.export.contour import contour
    from gearlink.cli.export.sampling import TooFine

    loaded, kind = open_design(source, asked.options)
    _require_profiles(loaded, kind)
    spec = read_spec(loaded, kind, source)
    try:
        made = parts.makers(kind.design(_command(spec), spec))
        chosen = [made[name]() for name in _names(asked.parts, tuple(made))]
        return spec, [contour(part, asked.tolerance, asked.curve) for part in chosen]
    except NoSolution as error:
        raise DesignFileError([diagnose_no_solution(loaded, error)]) from error
    except TooFine as error:
        raise DesignFileError([Diagnostic("GL115", str(error), file="<--tolerance>")]) from error


def _command(spec: Any) -> str:
    """The command whose design class knows the parts: an analysis of given links before a synthesis."""
    asked: tuple[str, ...] = spec.commands()
    return "analyze" if "analyze" in asked else asked[0]


def _require_profiles(loaded: LoadedFile, kind: Kind) -> None:
    if kind.name in parts.kinds():
        return
    line, column, file = loaded.locate(("kind",))
    message = f"a {kind.name} has no profile to export; kinds that have one: {', '.join(parts.kinds())}"
    raise DesignFileError([Diagnostic("GL113", message, file=file, line=line, column=column, key="kind")])


def _names(asked: tuple[str, ...], known: tuple[str, ...]) -> tuple[str, ...]:
    """The parts to export: those that were asked for, each once, or all."""
    unknown = [name for name in asked if name not in known]
    if not unknown:
        return tuple(dict.fromkeys(asked)) or known
    near = get_close_matches(unknown[0], known, n=3, cutoff=0.5)
    remedy = f"nearest: {', '.join(near)}" if near else f"known: {', '.join(known)}"
    message = f"this design has no part named {unknown[0]!r}"
    raise DesignFileError([Diagnostic("GL115", message, file="<--part>", key=unknown[0], help=remedy)])


def _writer(form: FileFormat) -> Callable[[Contour, Any], bytes]:
    if form is FileFormat.DXF:
        from gearlink.cli.export.dxf import as_dxf

        return as_dxf
    if form is FileFormat.SVG:
        from gearlink.cli.export.svg import as_svg

        return as_svg
    from gearlink.cli.export.csv import as_csv

    return as_csv


def _path(contour: Contour, spec: Any, form: FileFormat, asked: Export) -> Path:
    return asked.options.out / f"{safe_stem(spec.name)}-{contour.part.name}.{form}"


def _tell(contour: Contour, path: Path, asked: Export) -> None:
    from gearlink.cli.export.header import error_name, rounded_up

    if not asked.options.quiet:
        error = f"{error_name(contour)} {rounded_up(contour.error)} mm (tolerance {asked.tolerance:g} mm)"
        print(f"{path}: {contour.points} points, {error}")
