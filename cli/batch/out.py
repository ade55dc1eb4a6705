"""Files of a batch: per design and command a JSON report, its tables as CSV, and the plot where one is asked for."""

from __future__ import annotations

import hashlib
import io
import os
import stat
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from gearlink.cli.files import CannotWrite, safe_stem, write_atomically
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.csv_report import table_rows, write_rows
from gearlink.cli.render.json_report import as_json

if TYPE_CHECKING:
    from gearlink.cli.batch.options import BatchOptions
    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Report


def write_results(source: Path, design: Design, report: Report, options: BatchOptions) -> tuple[str, ...]:
    """Write STEM-COMMAND.json, STEM-COMMAND-TABLE.csv and the plot into the design's place below `out`; their names.

    Raises
        CannotWrite - where the folder or the disk does not take a file, or a link stands in the way
    """
    assert options.out is not None
    *folders, stem = place_of(source)
    folder = _folder(options.out, folders)
    results = folder / f"{stem}-{report.command.replace(' ', '-')}"
    written = [Path(f"{results}.json")]
    write_atomically(written[0], lambda stream: stream.write(as_json(report).encode()))
    for table in report.tables:
        text = io.StringIO()
        write_rows(table_rows(table), text)
        data = text.getvalue().encode()
        written.append(Path(f"{results}-{table.name}.csv"))
        write_atomically(written[-1], lambda stream, data=data: stream.write(data))  # type: ignore[misc]
    if options.design.plot:
        from gearlink.cli.views.figures.write import write_plot

        drawn = options.design._replace(out=folder)
        written.append(write_plot(report.command, design, drawn, stem=stem, checks=report.checks))
    return tuple(path.name for path in written)


def note_of(source: Path, options: BatchOptions) -> Path:
    """Where it is noted what a design's results were made of: beside them, by a name that none of them has.

    Raises
        CannotWrite - as `write_results`
    """
    assert options.out is not None
    *folders, stem = place_of(source)
    return _folder(options.out, folders) / f"{stem}~made-of.json"


def place_of(source: Path) -> tuple[str, ...]:
    """Folders below `out` and the stem of a design's result files; other files, other places.

    Notes
        They repeat the design file's own path. A part that is no safe name as it stands is followed by a hash of
        it, after a sign that safe names do not have; so the place depends on nothing but the path.

    Example
        >>> place_of(Path("designs/ty460.yaml"))
        ('designs', 'ty460')
        >>> place_of(Path("../a b/x.yml"))
        ('~up', 'a-b~c8687a08aa5d6ed2', 'x~5d2677742fcfe69b')
    """
    *folders, name = source.relative_to(source.anchor).parts
    stem = source.stem if source.suffix == ".yaml" else ""
    return (*(_safe(part, part) for part in folders), _safe(stem, name))


def _safe(wanted: str, whole: str) -> str:
    """`wanted` where that is a safe name, else one made of the whole part of the path."""
    if whole == "..":
        return "~up"
    if wanted and safe_stem(wanted) == wanted:
        return wanted
    return f"{safe_stem(Path(whole).stem)}~{hashlib.sha256(os.fsencode(whole)).hexdigest()[:16]}"


def require_places(files: Sequence[Path]) -> None:
    """Refuse files whose results would meet: `/a/b.yaml` and `a/b.yaml`.

    Raises
        DesignFileError - naming both
    """
    taken: dict[tuple[str, ...], Path] = {}
    for file in files:
        other = taken.setdefault(place_of(file), file)
        if other != file:
            message = f"{other} and this file would have their results in one folder"
            help_ = "name the files of one run either all from the current folder or all from the root"
            raise DesignFileError([Diagnostic("GL116", message, file=str(file), help=help_)])


def _folder(out: Path, parts: Sequence[str]) -> Path:
    """The folder of these parts below `out`, made where it is missing.

    Raises
        CannotWrite - where something else than a folder stands there, or a link, which could lead anywhere
    """
    folder = out
    try:
        out.mkdir(parents=True, exist_ok=True)
        for part in parts:
            folder /= part
            with suppress(FileExistsError):
                folder.mkdir()
            if not stat.S_ISDIR(folder.lstat().st_mode):
                what = "a symbolic link, which results do not follow" if folder.is_symlink() else "no folder"
                raise CannotWrite(f"cannot write below {folder}: it is {what}\nremove it, or give another --out")
    except OSError as error:
        raise CannotWrite(f"cannot write {folder}: {error.strerror or error}") from error
    return folder
