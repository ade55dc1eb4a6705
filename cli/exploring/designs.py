"""Designs of a study as complete files, which every command takes."""

from __future__ import annotations

import glob
import re
from functools import partial
from pathlib import Path
from typing import IO, Any

import yaml

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import safe_stem, write_atomically
from gearlink.cli.printable import visible
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.core.explore.front import Found
from gearlink.core.explore.problem import Problem
from gearlink.core.wording import amount

_NAME = 180
"""Letters of the study's name in the names of its designs, which have their number beside it."""
_MISS = re.compile(r"m([0-9]{1,6})")


def show(made: Problem, found: Found | None, asked: str) -> int:
    """Print a design's file: by its index, or mK for the nearest miss of row K of the table why."""
    print(text_of(made, found, _index(made, found, asked)), end="")
    return ExitCode.OK


def _index(made: Problem, found: Found | None, asked: str) -> int:
    if asked.isascii() and asked.isdecimal() and len(asked) < 18:
        last = made.order.count - 1 + (len(found.extra.rows) if found is not None else 0)
        if int(asked) <= last:
            return int(asked)
        raise _wrong(f"design {asked}: the last one is {last}", asked)
    row = _MISS.fullmatch(asked)
    if row is None or found is None:
        raise _wrong(f"{asked!r} is neither the index of a design nor mK for row K of the table why", asked)
    rows = found.why
    number = int(row[1])
    if not 1 <= number <= len(rows):
        raise _wrong(f"the table why has {amount(len(rows), 'row')}, not {number}", asked)
    name, _, miss = rows[number - 1]
    if miss.index is None:
        raise _wrong(f"no design fails row {number} ({name})", asked)
    return miss.index


def _wrong(message: str, asked: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", message, file="<--show>", key=asked)])


def text_of(made: Problem, found: Found | None, index: int) -> str:
    """The file of a design."""
    changes = found.changes(index) if found is not None else made.changes_of(index)
    data: dict[str, Any] = made.base.changed(changes)
    data["name"] = f"{made.spec.name[:_NAME]}-{index}"
    head = f"# Design {index} of the study {visible(made.spec.name)}; try: gearlink {made.base.command} FILE\n"
    return head + yaml.dump(
        data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, default_flow_style=None, width=120
    )


class _Dumper(yaml.SafeDumper):
    """Words whose lines could open commands in the log of a CI stand in quotes."""


def _quoted(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    style = '"' if "\n" in text or "::" in text else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


_Dumper.add_representer(str, _quoted)


def _put(text: str, stream: IO[bytes]) -> None:
    stream.write(text.encode())


def write(found: Found, folder: Path) -> tuple[int, int]:
    """Write the kept designs as NAME-INDEX.yaml: each is called by its index in the table, as it is for --show.

    Returns
        count, others : int - how many were written; how many files of such names stand there besides

    Raises
        CannotWrite
    """
    stem, written = safe_stem(found.problem.spec.name), set()
    for row in found.rows:
        path = folder / f"{stem}-{row.index}.yaml"
        write_atomically(path, partial(_put, text_of(found.problem, found, row.index)))
        written.add(path.name)
    there = (path for path in folder.glob(f"{glob.escape(stem)}-*.yaml") if path.name not in written)
    others = sum(path.stem.removeprefix(f"{stem}-").isdecimal() for path in there)
    return len(found.rows), others
