"""`gearlink batch`: every design file below some folders, one summary, the worst exit status.

A file's outcomes do not depend on the others: nothing that one design does can end the batch or change another.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from gearlink.cli.batch.options import BatchOptions
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.places import design_files


def run_batch(places: Sequence[str], options: BatchOptions) -> int:
    """Run every design below the places, print the summary, give the worst exit status.

    Notes
        Interrupted, it shows what is finished and gives 130.
    """
    from gearlink.cli.batch.pool import run_files

    try:
        files = options.share_of(design_files(places))
    except DesignFileError as error:
        from gearlink.cli.render.errors import show_errors

        show_errors(error.diagnostics, options.design)
        return ExitCode.WRONG_INPUT
    results, interrupted = run_files(files, options)
    results.sort(key=lambda outcome: outcome.file)
    from gearlink.cli.batch.summary import write_batch

    write_batch(results, options, sys.stdout)
    if interrupted:
        print(f"interrupted after {len({r.file for r in results})} of {len(files)} files", file=sys.stderr)
        return ExitCode.INTERRUPTED
    return max((outcome.status for outcome in results), default=ExitCode.OK)
