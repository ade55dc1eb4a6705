"""Outcomes of unchanged designs, kept by the content of the file and of everything that decides the result.

An entry is believed only where this user's own key signed it, since a folder in a checkout may hold what a stranger
put there; and whatever is wrong with the cache costs the cache, never the batch.
"""

from __future__ import annotations

import hashlib
import hmac
import os
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from gearlink.cli.batch.outcome import Outcome
from gearlink.cli.evaluate import exit_status
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, read_plain_file, write_atomically
from gearlink.cli.reading.design_file import read_at_most
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.yaml_reader import MAX_BYTES
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from gearlink.cli.batch.options import BatchOptions

_LARGEST_ENTRY = 1 << 26
_OF = re.compile(rb"(?m)^[\"'{ ]*of[\"']? *:")
_MAC_DIGITS = 64


def cached_outcomes(path: Path, options: BatchOptions, compute: Callable[[], list[Outcome]]) -> list[Outcome]:
    """The kept outcomes of a file, or those computed now, which are then kept.

    Notes
        A design whose result files are wanted, or that met a fault, is always computed. What the cache could not
        do stands in `note` of the file's first outcome.
    """
    entry = _entry_of(path, options)
    if entry is None:
        return compute()
    kept, note = _kept(entry, path, options) if options.out is None else (None, "")
    if kept is not None:
        return kept
    results = compute()
    # A file that changed while it was computed has no content that the results belong to.
    if all(outcome.status != ExitCode.FAULT for outcome in results) and entry == _entry_of(path, options):
        note = _keep(entry, results, options) or note
    return [replace(results[0], note=note), *results[1:]] if note and results else results


def _entry_of(path: Path, options: BatchOptions) -> Path | None:
    """Where the outcomes of a file are kept; nowhere for what is no file of a design's size."""
    assert options.cache is not None
    try:
        content = read_at_most(path, MAX_BYTES + 1) if os.path.isfile(path) else b""
    except DesignFileError:
        return None
    if not 0 < len(content) <= MAX_BYTES:
        return None
    design = options.design
    decides = (
        VERSION,
        str(path),
        options.findings_only,
        options.with_places,
        options.added,
        design.strict,
        design.overrides,
        design.samples,
    )
    base = _base_of(path, content)
    return options.cache / hashlib.sha256(repr(decides).encode() + b"\0" + content + base).hexdigest()


def _base_of(path: Path, content: bytes) -> bytes:
    """The file that a study takes its base design from, with its length; nothing of other files."""
    named = _OF.search(content)
    if named is None:
        return b""
    from gearlink.cli.reading.base_design import base_path
    from gearlink.cli.reading.design_file import parse

    try:
        of = parse(content, str(path)).data.get("of")
        base = read_at_most(base_path(str(path), of), MAX_BYTES + 1) if isinstance(of, str) else b""
    except DesignFileError:
        return b""
    return b"\0%d\0" % len(base) + base


def _signature(entry: Path, data: bytes, options: BatchOptions) -> bytes:
    """Of an entry and of the design that it is kept for, so that one cannot stand for another."""
    signed = hmac.new(options.cache_key, entry.name.encode() + b"\n" + data, hashlib.sha256)
    return signed.hexdigest().encode()


def _kept(entry: Path, path: Path, options: BatchOptions) -> tuple[list[Outcome] | None, str]:
    """The outcomes of an entry, or none; and a word where there is an entry that is not believed."""
    from gearlink.cli.batch.kept import restored

    try:
        data = read_plain_file(entry, _LARGEST_ENTRY)
    except FileNotFoundError:
        return None, ""
    except OSError as error:
        return None, f"{entry} is not read: {error.strerror or error}"
    mac, payload = data[:_MAC_DIGITS], data[_MAC_DIGITS:]
    if not hmac.compare_digest(mac, _signature(entry, payload, options)):
        return None, f"{entry} is not believed: your key did not sign it"
    try:
        kept = restored(payload)
    except ValueError as error:
        return None, f"{entry} is not believed: {error}"
    return [_as_now(outcome, path, options) for outcome in kept], ""


def _as_now(kept: Outcome, path: Path, options: BatchOptions) -> Outcome:
    """A kept outcome; what can be inferred is not taken from the entry."""
    report = kept.report
    status = ExitCode.WRONG_INPUT if report is None else exit_status(report, strict=options.design.strict)
    return replace(kept, file=str(path), status=status, seconds=0.0, cached=True, note="")


def _keep(entry: Path, results: list[Outcome], options: BatchOptions) -> str:
    """Write an entry; a word of why where that cannot be."""
    from gearlink.cli.batch.kept import as_bytes

    try:
        data = as_bytes(results)
    except ValueError:  # a value that is not finite, which JSON does not know
        return ""
    if _MAC_DIGITS + len(data) > _LARGEST_ENTRY:
        return ""
    try:
        write_atomically(entry, lambda stream: stream.write(_signature(entry, data, options) + data))
    except CannotWrite as error:
        return str(error)
    return ""
