"""`gearlink batch`: every design file below some folders, one summary, the worst exit status.

A file's outcomes do not depend on the others: nothing that one design does can end the batch or change another.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.places import design_files
from gearlink.core.base.wording import amount


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
    try:
        results, interrupted = run_files(files, options)
    except DesignFileError as error:  # of the cluster; those of files stand among the results
        return _refused(error, options)
    results.sort(key=lambda outcome: outcome.file)
    from gearlink.cli.batch.summary import write_batch

    write_batch(results, options, sys.stdout)
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
