"""`gearlink export`: read the design, sample its parts, write one file per part and format.

`--cam-table` writes the motion of a follower as the table of a servo drive, its error told.
"""

from __future__ import annotations

import csv
import io
import math
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from difflib import get_close_matches
from itertools import chain, repeat
from pathlib import Path
from typing import Any

from gearlink.cli.evaluate import (
    checks_of,
    failures,
    open_design,
    read_spec,
    refusals_located,
    whole_design,
    wrong_kind,
)
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.export import parts
from gearlink.cli.export.contour import Contour, describe, design_hash, error_name, rounded_up, rows_of
from gearlink.cli.export.options import CONTOUR, DEFAULT_TOLERANCE, PATH, CurveForm, Export, FileFormat
from gearlink.cli.export.sampling import Sampled, TooFine
from gearlink.cli.files import CannotWrite, in_place, safe_stem, write_atomically
from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.progress import patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile
from gearlink.cli.render.csv_report import table_rows
from gearlink.cli.render.errors import show_errors, show_refusal
from gearlink.core.base.errors import GearlinkError, named
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import FILES
from gearlink.core.base.wording import first_of
from gearlink.core.version import VERSION


def run_export(source: str, asked: Export) -> int:
    """Export the parts of the design file `source`, say what was written, and give the exit status.

    1 where the files were written but a check of the file fails, or a profile is unfit for use (the roller cuts into
    it); 2 where nothing was.
    """
    try:
        loaded, kind = open_design(source, asked.options)
        paths = bool(kind.motion) and any(name.startswith(PATH) for name in asked.parts)
        if kind.name not in (known := parts.kinds()) and not paths:
            raise wrong_kind(loaded, f"a {kind.name} has no profile to export; kinds that have one: {first_of(known)}")
        spec = read_spec(loaded, kind, source)
        design = whole_design(kind, spec)
        with _located(loaded), patience(f"computing the profiles of {spec.name}", quiet=asked.options.quiet):
            files = list(_contour_files(design, asked))
            rest = replace(asked, parts=tuple(part for part in asked.parts if part != CONTOUR)) if files else asked
            contours: dict[CurveForm, list[Contour]] = {}
            if rest.parts or not files:
                contours = {curve: _contours(design, rest, curve) for curve in _curves(asked)}
                for form in asked.formats:
                    files += _files(form, design, contours, asked)
        for path, data, words in files:
            write_atomically(path, lambda stream, data=data: stream.write(data))  # type: ignore[misc]
            if not asked.options.quiet:
                print(f"{visible(str(path))}: {words}{in_place(path)}")
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, source, asked.options)
    except GearlinkError as error:
        show_errors([Diagnostic("GL115", str(error), file="<command line>")], asked.options)
        return ExitCode.WRONG_INPUT
    found = {contour.part.name: contour.part.findings for made in contours.values() for contour in made}
    findings = [f"{name}: {text}" for name, texts in found.items() for text in texts]
    return _warned([*findings, *_failed(design)])


def _failed(design: Any) -> list[str]:
    """What checks of the file fail, whatever is exported."""
    kind = FILES[design.kind]
    return [f"the design fails {words}" for words in failures(checks_of(kind, design.spec, design.kin))]


def _warned(findings: list[str]) -> int:
    """Say on standard error what is wrong with what was written; the exit status."""
    for text in findings:
        print(f"warning: {text}", file=sys.stderr)
    return ExitCode.FINDING if findings else ExitCode.OK


def _contour_files(design: Any, asked: Export) -> Iterator[tuple[Path, bytes, str]]:
    """The blocking contour of a gear pair, where it is asked for."""
    for form in asked.formats if CONTOUR in asked.parts and design.kind == "gear-pair" else ():
        data, words = contour_file(design, form)
        yield asked.options.out / f"{safe_stem(design.spec.name)}-{CONTOUR}.{form}", data, words


@contextmanager
def _located(loaded: LoadedFile) -> Iterator[None]:
    """Whatever the mechanism refuses becomes an error at its place in the file."""
    try:
        with refusals_located(loaded):
            yield
    except TooFine as error:
        raise DesignFileError([Diagnostic("GL115", str(error), file="<--tolerance>")]) from error


def _curves(asked: Export) -> list[CurveForm]:
    """How the profiles are sampled: a solid is made of splines whatever the drawings are made of."""
    drawings = [form for form in asked.formats if form not in (FileFormat.STEP, FileFormat.REXS)]
    solids = [CurveForm.SPLINE] if FileFormat.STEP in asked.formats else []
    return list(dict.fromkeys([*([asked.curve] if drawings else []), *solids]))


def _contours(design: Any, asked: Export, curve: CurveForm) -> list[Contour]:
    """The sampled parts."""
    from gearlink.cli.export.contour import contour

    made = parts.makers(design, asked.parts)
    also = (CONTOUR,) if design.kind == "gear-pair" else ()
    return [contour(made[name](), asked.tolerance, curve) for name in _names(asked.parts, tuple(made), also)]


def _files(
    form: FileFormat, design: Any, contours: dict[CurveForm, list[Contour]], asked: Export
) -> Iterator[tuple[Path, bytes, str]]:
    """Path, bytes and a word on each file of a format."""
    spec = design.spec
    if form is FileFormat.REXS:
        from gearlink.cli.export.rexs import as_rexs

        yield asked.options.out / f"{safe_stem(spec.name)}.rexs", as_rexs(design), "REXS 1.7"
        return
    for contour in _drawn(form, contours, asked):
        data, words = _writer(form, asked)(contour, spec), _words(form, contour, asked)
        yield asked.options.out / f"{safe_stem(spec.name)}-{contour.part.name}.{form}", data, words


def _drawn(form: FileFormat, contours: dict[CurveForm, list[Contour]], asked: Export) -> list[Contour]:
    """The parts that a format takes: of all parts, those that are bodies become solids."""
    if form is not FileFormat.STEP:
        return contours[asked.curve]
    every = [(contour, {line.layer for line in contour.lines}) for contour in contours[CurveForm.SPLINE]]
    made = [contour for contour, layers in every if contour.part.body and "PROFILE" in layers]
    if not made:
        words = "a circle of pins" if any("PIN_CIRCLE" in layers for _, layers in every) else "a path"
        raise GearlinkError(f"{words} is not a solid\ngive --as dxf, svg or csv")
    closed = [contour for contour in made if contour.part.closed]
    return made if asked.parts or not closed else closed


def _names(asked: tuple[str, ...], known: tuple[str, ...], also: tuple[str, ...]) -> tuple[str, ...]:
    """The parts to export: those that were asked for, each once, or all; `also` can be asked for beside them."""
    unknown = [name for name in asked if name not in known]
    if not unknown:
        return tuple(dict.fromkeys(asked)) or known
    near = get_close_matches(unknown[0], (*known, *also), n=3, cutoff=0.5)
    remedy = f"nearest: {', '.join(near)}" if near else f"known: {', '.join((*known, *also))}"
    message = f"this design has no part named {named(unknown[0])}"
    raise DesignFileError([Diagnostic("GL115", message, file="<--part>", key=unknown[0], help=remedy)])


def _writer(form: FileFormat, asked: Export) -> Callable[[Contour, Any], bytes]:
    if form in (FileFormat.DXF, FileFormat.SVG):
        from gearlink.cli.export.drawings import as_dxf, as_svg

        return as_dxf if form is FileFormat.DXF else as_svg
    if form is FileFormat.STEP:
        from gearlink.cli.export.step import as_step

        return lambda contour, spec: as_step(contour, spec, asked.width)
    return as_csv


def _words(form: FileFormat, contour: Contour, asked: Export) -> str:
    error = f"{error_name(contour)} {rounded_up(contour.error)} mm (tolerance {asked.tolerance:g} mm)"
    if form is FileFormat.STEP and contour.part.twist:
        from gearlink.cli.export.step import helix_error

        error += f", {rounded_up(helix_error(contour, asked.width))} mm more along the helix"
    return f"{_counted(contour)}, {error}"


def _counted(contour: Contour) -> str:
    """The points of a file; where it holds several curves, those of each besides."""
    counts: dict[str, int] = {}
    for line in contour.lines:
        name = line.layer.lower().replace("_", " ")
        counts[name] = counts.get(name, 0) + line.nodes.size
    each = ", ".join(f"{name} {count}" for name, count in counts.items())
    return f"{contour.points} points ({each})" if len(counts) > 1 else f"{contour.points} points"


class NoContourFile(GearlinkError):
    """The contour is no body."""


def contour_file(design: Any, form: FileFormat) -> tuple[bytes, str]:
    """The bytes of the file and a word on it.

    Raises
        NoContourFile - for formats other than SVG and CSV
        NoSolution - for a gear on a rack
    """
    design.require_two_gears("a blocking contour")
    points = sum(map(len, design.contour.points.values())) if form in (FileFormat.SVG, FileFormat.CSV) else 0
    if form is FileFormat.SVG:
        made: bytes = load("cli.views.figures.gears:contour_svg")(design)
        return made, f"{points} points of {len(design.contour.lines)} lines"
    if form is FileFormat.CSV:
        return _csv(design), f"{points} points of {len(design.contour.lines)} lines"
    raise NoContourFile(f"the blocking contour cannot be written as {form}\ngive --as svg or --as csv")


def _csv(design: Any) -> bytes:
    """Comment lines with the design, its shifts and margins, then a row for each point of a line."""
    text, contour = io.StringIO(), design.contour
    x1, x2 = contour.pair.profile_shift
    said = {"program": f"gearlink {VERSION}", "design": " ".join(design.spec.name.split())}
    said |= {"design_sha256": design_hash(design.spec), "x1": repr(x1), "x2": repr(x2)}
    for key, value in said.items():
        text.write(f"# {key}: {value}\n")
    writer = csv.writer(text, lineterminator="\n")
    for line in contour.lines:
        less, more = contour.margins[line.name]
        text.write(f"# margin of {line.name}: {_way(less)} to {_way(more)} in x1 at the same shift sum\n")
    writer.writerow(["line", "x1", "x2"])
    writer.writerows((name, *point) for name, points in contour.points.items() for point in points)
    return text.getvalue().encode("utf-8")


def _way(value: float | None) -> str:
    return "none" if value is None else repr(value)


_HEADS = dict.fromkeys(("PROFILE", "PATH", "PIN_CIRCLE"), ("x [mm]", "y [mm]"))
_HEADS["PITCH_CURVE"] = "pitch_x [mm]", "pitch_y [mm]"
_INPUTS = ("cam_angle", "input_angle", "crank_angle", "carrier_angle", "theta")
_LEADING = ("k", *(f"{name} [deg]" for name in _INPUTS), "input_position [mm]")


def as_csv(contour: Contour, spec: Any) -> bytes:
    """The part as a CSV file; of a closed curve the last row is the first point again.

    Notes
        The rows of a spline are the points that the cubics pass through. A value that does not exist (no contact,
        a straight pitch curve, the pressure angle at a corner) is left empty; the column `curve` stands where a piece
        of the contour has a name.
    """
    text = io.StringIO()
    for key, value in describe(contour, spec).items():
        text.write(f"# {key}: {' '.join(value.encode('utf-8', 'replace').decode().split())}\n")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerows(_rows(contour))
    return text.getvalue().encode("utf-8")


def _rows(contour: Contour) -> Iterator[list[Any]]:
    drawn = tuple(piece for piece in contour.pieces if piece.stretch.layers[0] in _HEADS)  # no construction lines
    layers = tuple(dict.fromkeys(layer for piece in drawn for layer in piece.stretch.layers))
    leading = [head for head in contour.part.extra_columns if head in _LEADING]
    trailing = [head for head in contour.part.extra_columns if head not in leading]
    named = ["curve"] if any(piece.stretch.name for piece in drawn) else []
    yield [*leading, *(head for layer in layers for head in _HEADS[layer]), *trailing, *named]
    if contour.part.teeth:
        yield from _tooth_by_tooth(contour)
        return
    for piece, shown in rows_of(drawn):
        columns = _columns(piece, layers, len(contour.part.extra_columns), len(leading))
        for row in zip(*(column[shown] for column in columns), strict=True):
            cells = (value if math.isfinite(value) else "" for value in row)
            yield [*cells, *([piece.stretch.name] if named else ())]


def _tooth_by_tooth(contour: Contour) -> Iterator[list[Any]]:
    """Rows of a gear: x, y and the name of the curve."""
    (line,) = contour.lines
    names = [piece.stretch.name for piece in line.pieces for _ in piece.parameter[1:]]
    curves = chain(*repeat(names, contour.part.teeth), names[-1:])
    nodes = line.nodes
    yield from map(list, zip(nodes.real.tolist(), nodes.imag.tolist(), curves, strict=True))


def _columns(piece: Sampled, layers: tuple[str, ...], extras: int, leading: int) -> list[list[float]]:
    """The columns of a piece: leading extras, x and y of each layer, the other extras."""
    empty = [math.nan] * piece.parameter.size
    extra = [empty] * extras
    if piece.stretch.extra is not None:
        extra = piece.stretch.extra(piece.parameter).tolist()
    places: list[list[float]] = []
    for layer in layers:
        if layer in piece.stretch.layers:
            nodes = piece.nodes[piece.stretch.layers.index(layer)]
            places += [nodes.real.tolist(), nodes.imag.tolist()]
        else:
            places += [empty, empty]
    return [*extra[:leading], *places, *extra[leading:]]


def run_cam_table(source: str, options: Options, rows: int | None, tolerance: float | None) -> int:
    """Write NAME-cam-table.csv, say its rows and the maximum error of position between them, give the exit status."""
    from gearlink.core.parts.cams.servo import greatest_error, servo_table

    try:
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        design: Any = whole_design(kind, spec)
        if not hasattr(type(design), "follower_motion"):
            raise wrong_kind(loaded, f"a {kind.name} has no cam that a servo drive could replace")
        with refusals_located(loaded):
            motion, count = design.follower_motion, _servo_rows(design, rows, tolerance)
            table = servo_table(motion, count, rocks=design.rocks)
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerows(table_rows(table))
        path = options.out / f"{safe_stem(spec.name)}-cam-table.csv"
        write_atomically(path, lambda stream: stream.write(text.getvalue().encode()))
    except (DesignFileError, CannotWrite) as refused:
        return show_refusal(refused, source, options)
    if not options.quiet:
        errors = (greatest_error(motion, count, end_side=side) for side in (-1, 1))
        shown, stepped = (f"{math.degrees(each):.3g} deg" if design.rocks else f"{each:.3g} mm" for each in errors)
        more = f" ({stepped} before rows with a step, which have the values after it)" if stepped != shown else ""
        print(f"{visible(str(path))}: {count} rows, off by at most {shown} between them{more}{in_place(path)}")
    return _warned(_failed(design))


def _servo_rows(design: Any, rows: int | None, tolerance: float | None) -> int:
    """Rows asked for, those of a tolerance, or what the section `servo` says."""
    from gearlink.core.parts.cams.servo import rows_for

    if rows is not None:
        return rows
    given = getattr(design.spec, "servo", None)
    if tolerance is None and given is not None:
        return int(design.servo_rows)
    within = DEFAULT_TOLERANCE if tolerance is None else tolerance
    return rows_for(design.follower_motion, within, rocks=design.rocks, key="--tolerance")
