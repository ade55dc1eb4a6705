"""Puts `gearlink export` into the command tree; what it runs is imported when it runs."""

from __future__ import annotations

from typing import Annotated

import typer

from gearlink.cli.export.options import (
    DEFAULT_TOLERANCE,
    LEAST_TOLERANCE,
    MOST_TOLERANCE,
    CurveForm,
    Export,
    FileFormat,
)
from gearlink.cli.options import Options
from gearlink.cli.typer_options import Spec, offers, takes


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("export")(_export)


@takes("out", "overrides", "quiet", quiet="do not list the files that are written")
def _export(
    spec: Spec,
    options: Options,
    as_: Annotated[list[FileFormat], typer.Option("--as", help="format of the files (repeatable)")] = [FileFormat.DXF],  # noqa: B006 - Typer copies it
    part: Annotated[
        list[str],
        typer.Option(
            "--part",
            metavar="NAME",
            help="main_cam, gear1, blocking_contour ... (repeatable)",
            autocompletion=offers("parts"),
        ),
    ] = [],  # noqa: B006
    tolerance: Annotated[
        float | None,
        typer.Option(
            min=LEAST_TOLERANCE,
            max=MOST_TOLERANCE,
            metavar="MM",
            help="maximum chord error, default 0.001; of --cam-table the maximum error of position (mm, deg)",
        ),
    ] = None,
    curve: Annotated[CurveForm, typer.Option(help="chords, or cubics through points")] = CurveForm.POLYLINE,
    width: Annotated[
        float | None,
        typer.Option(min=1e-3, max=1e5, metavar="MM", help="width of STEP solids; default: face_width of the file"),
    ] = None,
    cam_table: Annotated[
        bool, typer.Option("--cam-table", help="the table of a servo drive instead of a cam, NAME-cam-table.csv")
    ] = False,
    rows: Annotated[
        int | None, typer.Option(min=2, max=100_000, help="rows of --cam-table, both ends; default: servo of the file")
    ] = None,
) -> None:
    """Write the profiles of cams and gears as DXF, SVG, CSV or STEP, NAME-PART.dxf for each part; gears as REXS.

    Closed outlines run counter-clockwise, also round a hole; the rows of a CSV of a cam follow its angle.

    STEP (solids) needs cadquery-ocp: pip install cadquery-ocp. REXS 1.7 is one file for all gears.

    Exit status 1: the files were written, but a roller cuts into its profile.

    Example: gearlink export designs/ty460.yaml --part main_cam --as dxf --as svg
    """
    if cam_table:
        from gearlink.cli.export.cam_table import run_cam_table

        raise typer.Exit(run_cam_table(spec, options, rows, tolerance))
    from gearlink.cli.export.command import run_export

    within = DEFAULT_TOLERANCE if tolerance is None else tolerance
    raise typer.Exit(run_export(spec, Export(tuple(dict.fromkeys(as_)), tuple(part), within, curve, options, width)))
