"""`--unchanged skip`: designs that passed, and of which nothing has changed since, are not computed again.

Beside the results of a design stands what they were made of: the content of every file that was read, the program and
the options; and the content of every file that was written. A design with findings is computed again, so that they are
told. Whoever can write into the folder of the results can make a design pass.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.batch.out import note_of
from gearlink.cli.batch.outcome import Outcome
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, read_plain_file, write_atomically
from gearlink.cli.program import program
from gearlink.cli.reading.design_file import read_at_most
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.files_read import files_read

_LARGEST = 1 << 26
_WRONG = (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError, DesignFileError)
"""What a note raises that is none, or of results that have changed."""


def taken_or_computed(path: Path, options: BatchOptions, compute: Callable[[], list[Outcome]]) -> list[Outcome]:
    """The outcomes of a file: taken from its results where the same would be made again, else computed and noted."""
    try:
        note = note_of(path, options)
    except CannotWrite:  # nor can a result be written
        return compute()
    with suppress(*_WRONG):
        return _taken(json.loads(read_plain_file(note, _LARGEST)), note.parent, path, options)
    with files_read() as read:
        outcomes = compute()
    if all(outcome.verdict == "pass" for outcome in outcomes):
        with suppress(CannotWrite, OSError):  # without a note it is computed again the next time
            data = _noted(read, outcomes, note.parent, options)
            write_atomically(note, lambda stream: stream.write(data))
    return outcomes


def _taken(noted: Any, folder: Path, path: Path, options: BatchOptions) -> list[Outcome]:
    """The outcomes that a note stands for.

    Raises
        one of _WRONG
    """
    wrote = {name: read_plain_file(folder / Path(name).name, _LARGEST) for name in noted["wrote"]}
    read = {name: read_at_most(name, _LARGEST) for name in noted["read"] if os.path.isfile(name)}
    if noted != {"made_by": _made_by(options), "read": _sums(read), "wrote": _sums(wrote)} or str(path) not in read:
        raise ValueError("something has changed")
    shown = options.format in (BatchFormat.JSON, BatchFormat.JSONL)
    reports = [json.loads(data) for name, data in wrote.items() if name.endswith(".json")]
    return [
        Outcome(str(path), r["kind"], r["name"], r["command"], ExitCode.OK, unchanged=r if shown else {})
        for r in reports
    ]


def _noted(read: dict[str, bytes], outcomes: Sequence[Outcome], folder: Path, options: BatchOptions) -> bytes:
    """The note of results that have just been written."""
    names = [name for outcome in outcomes for name in outcome.wrote]
    wrote = {name: read_plain_file(folder / name, _LARGEST) for name in names}
    noted = {"made_by": _made_by(options), "read": _sums(read), "wrote": _sums(wrote)}
    return json.dumps(noted, indent=1).encode()


def _sums(files: dict[str, bytes]) -> dict[str, str]:
    return {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}


def _made_by(options: BatchOptions) -> str:
    """Of the program, and of every option that decides a result."""
    design = options.design
    decides = (
        options.added,
        design.strict,
        design.overrides,
        design.samples,
        design.plot,
        design.plot_format,
        design.dpi,
    )
    return hashlib.sha256(ascii((_program(), decides)).encode()).hexdigest()


@cache
def _program() -> tuple[tuple[str, str], ...]:
    return tuple(program().items())
