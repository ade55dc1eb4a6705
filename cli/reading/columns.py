"""Points from files of numbers: the rows of a CSV file take the place of the key `file` that names it."""

from __future__ import annotations

from typing import Any

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic, Source
from gearlink.cli.reading.loaded_file import KeyPath, LoadedFile
from gearlink.cli.reading.places import base_path, nearest_file, note
from gearlink.cli.reading.yaml_reader import format_path

_MOST_ROWS = 100_000
_DELIMITERS = (";", "\t", ",")


def read_points(loaded: LoadedFile) -> tuple[list[Diagnostic], set[str]]:
    """Put the points of every file of numbers instead of its name; those of table laws and measured profiles.

    Returns
        wrong, keys : what is wrong with the files, at its place in them; keys of what has no points for that
    """
    wrong: list[tuple[KeyPath, Diagnostic]] = []
    loaded.data = _filled(loaded, loaded.data, (), wrong)
    return [each for _, each in wrong], {format_path(path) for path, _ in wrong}


def _filled(loaded: LoadedFile, node: Any, path: KeyPath, wrong: list[tuple[KeyPath, Diagnostic]]) -> Any:
    if isinstance(node, list) and any(isinstance(item, dict) for item in node):
        return [_filled(loaded, item, (*path, k), wrong) for k, item in enumerate(node)]
    if not isinstance(node, dict):
        return node
    if isinstance(name := node.get("file"), str) and (node.get("type") == "table" or path[-1:] == ("profile",)):
        if "points" in node:
            return node  # the model refuses both
        try:
            points = _points(loaded, name, (*path, "file"))
            return {**{key: item for key, item in node.items() if key != "file"}, "points": points}
        except DesignFileError as error:
            wrong += [(path, each) for each in error.diagnostics]
            return node
    found = {key: _filled(loaded, item, (*path, key), wrong) for key, item in node.items()}
    return node if all(found[key] is node[key] for key in found) else found


def _points(loaded: LoadedFile, name: str, path: KeyPath) -> list[list[float]]:
    place = base_path(loaded.file, name)
    if place.suffix.lower() in (".xlsx", ".xls", ".ods"):
        message = f"{name} is a workbook of a spreadsheet"
        raise DesignFileError([loaded.report("GL182", message, path, help="save it as CSV")])
    try:
        content = place.read_bytes()
        text = content.decode("utf-8-sig")
    except OSError as error:
        message = f"cannot read {place}: {error.strerror or error}"
        raise DesignFileError([loaded.report("GL101", message, path, help=nearest_file(str(place)))]) from None
    except UnicodeDecodeError:
        message = f"{name} is no text in UTF-8"
        raise DesignFileError([loaded.report("GL182", message, path, help="save it as CSV in UTF-8")]) from None
    note(place, content)
    return rows_of(Source(str(place), text))


def rows_of(source: Source) -> list[list[float]]:
    """The pairs of numbers of a text: the delimiter is counted, lines of words at the top are skipped.

    Notes
        A decimal comma stands where the delimiter is another character.
    Raises
        DesignFileError - GL182, at the cell
    """
    lines = [line.strip() for line in source.text.splitlines()]
    delimiter = max(_DELIMITERS, key=lambda each: sum(each in line for line in lines))
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        if not line or line.startswith("#"):
            continue
        cells = line.split(delimiter)
        values = [_number(cell, delimiter) for cell in cells]
        if not rows and values[0] is None:  # words at the top
            continue
        if len(cells) != 2 or None in values:
            bad = values.index(None) if None in values else min(2, len(cells))
            at = source.line_start(number) + len(delimiter.join(cells[:bad])) + (bad > 0)
            what = f"{cells[bad].strip()!r} is no number" if None in values else f"{len(cells)} numbers in a row"
            fix = "give two numbers a row, with a delimiter between them"
            raise DesignFileError([source.report("GL182", what, min(at, len(source.text)), help=fix)])
        rows.append([value for value in values if value is not None])
        if len(rows) > _MOST_ROWS:
            at = source.line_start(number)
            raise DesignFileError([source.report("GL182", f"more than {_MOST_ROWS} rows", at, help="omit rows")])
    if not rows:
        raise DesignFileError([source.report("GL182", "no row of numbers", 0, help="give two numbers a row")])
    return rows


def _number(cell: str, delimiter: str) -> float | None:
    text = cell.strip() if delimiter == "," else cell.strip().replace(",", ".")
    try:
        return float(text)
    except ValueError:
        return None
