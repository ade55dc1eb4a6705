"""`gearlink export --cam-table`: the motion of a follower as the table of a servo drive, its error told."""

from __future__ import annotations

import csv
import io
import math
from typing import Any

from gearlink.cli.evaluate import open_design, read_spec, refusals_located, whole_design, wrong_kind
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.export.options import DEFAULT_TOLERANCE
from gearlink.cli.files import CannotWrite, in_place, safe_stem, write_atomically
from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.render.errors import show_refusal


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
            motion, count = design.follower_motion, _rows(design, rows, tolerance)
            table, error = servo_table(motion, count, rocks=design.rocks), greatest_error(motion, count)
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(table.columns)
        writer.writerows(table.rows())
        path = options.out / f"{safe_stem(spec.name)}-cam-table.csv"
        write_atomically(path, lambda stream: stream.write(text.getvalue().encode()))
    except (DesignFileError, CannotWrite) as refused:
        return show_refusal(refused, source, options)
    if not options.quiet:
        shown = f"{math.degrees(error):.3g} deg" if design.rocks else f"{error:.3g} mm"
        print(f"{visible(str(path))}: {count} rows, off by at most {shown} between them{in_place(path)}")
    return ExitCode.OK


def _rows(design: Any, rows: int | None, tolerance: float | None) -> int:
    """Rows asked for, those of a tolerance, or what the section `servo` says."""
    from gearlink.core.parts.cams.servo import rows_for

    if rows is not None:
        return rows
    given = getattr(design.spec, "servo", None)
    if tolerance is None and given is not None:
        return int(design.servo_rows)
    within = DEFAULT_TOLERANCE if tolerance is None else tolerance
    return rows_for(design.follower_motion, math.radians(within) if design.rocks else within)
