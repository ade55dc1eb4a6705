"""`gearlink batch`: every design file below some folders, one summary, the worst exit status.

A file's outcomes do not depend on the others: nothing that one design does can end the batch or change another.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format
from gearlink.cli.printable import visible
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.places import design_files
from gearlink.core.wording import amount


def run_batch(places: Sequence[str], options: BatchOptions) -> int:
    """Run every design below the places, print the summary, give the worst exit status.

    Notes
        Interrupted, it shows what is finished and gives 130.
    """
    from gearlink.cli.batch.pool import run_files

    try:
        files = design_files(places)
        if options.out is not None:
            from gearlink.cli.batch.out import require_places

            require_places(files)
        files = options.share_of(files)
    except DesignFileError as error:
        return _refused(error, options)
    options = _with_key(options)
    try:
        results, interrupted = run_files(files, options)
    except DesignFileError as error:  # of the cluster; those of files stand among the results
        return _refused(error, options)
    results.sort(key=lambda outcome: outcome.file)
    from gearlink.cli.batch.summary import write_batch

    write_batch(results, options, sys.stdout)
    _tell([outcome.note for outcome in results if outcome.note], options)
    if interrupted:
        print(f"interrupted after {len({r.file for r in results})} of {amount(len(files), 'file')}", file=sys.stderr)
        return ExitCode.INTERRUPTED
    return max((outcome.status for outcome in results), default=ExitCode.OK)


def _refused(error: DesignFileError, options: BatchOptions) -> int:
    """Say what is wrong before any file was run, in the form that the summary would have."""
    from gearlink.cli.render.errors import show_errors

    in_json = options.format in (BatchFormat.JSON, BatchFormat.JSONL)
    show_errors(error.diagnostics, options.design._replace(format=Format.JSON if in_json else options.design.format))
    return ExitCode.WRONG_INPUT


def _with_key(options: BatchOptions) -> BatchOptions:
    """The options with the key that a cache needs; without a cache where there is none."""
    if options.cache is None:
        return options
    from gearlink.cli.batch.key import NoKey, own_key

    try:
        return replace(options, cache_key=own_key())
    except NoKey as error:
        _tell([f"nothing is kept or taken from it: {error}"], options)
        return replace(options, cache=None)


def _tell(notes: Sequence[str], options: BatchOptions) -> None:
    """Say once what the cache could not do."""
    if notes and not options.design.quiet:
        others = f" (and {len(notes) - 1} more)" if len(notes) > 1 else ""
        print(f"note: cache: {visible(notes[0])}{others}", file=sys.stderr)
