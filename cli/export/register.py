"""Puts `gearlink export` into the command tree; what it runs is imported when it runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.export.options import LEAST_TOLERANCE, MOST_TOLERANCE, CurveForm, Export, FileFormat
from gearlink.cli.options import Options


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("export")(_export)


def _export(
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="design file, or - for standard input")],
    as_: Annotated[list[FileFormat], typer.Option("--as", help="format of the files (repeatable)")] = [FileFormat.DXF],  # noqa: B006 - Typer copies it
    part: Annotated[list[str], typer.Option("--part", metavar="NAME", help="main_cam, gear1 ... (repeatable)")] = [],  # noqa: B006
    tolerance: Annotated[
        float, typer.Option(min=LEAST_TOLERANCE, max=MOST_TOLERANCE, metavar="MM", help="greatest chord error")
    ] = 0.001,
    curve: Annotated[CurveForm, typer.Option(help="chords, or cubics through points")] = CurveForm.POLYLINE,
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="folder for the files")] = Path(),
    set_: Annotated[list[str], typer.Option("--set", metavar="PATH=VALUE", help="override a key (repeatable)")] = [],  # noqa: B006
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="say nothing of what was written")] = False,
) -> None:
    """Profiles of cams and gears as DXF, SVG or CSV: NAME-PART.dxf for each part, with the chord error reached.

    Exit status 1: the files were written, but a roller cuts into its profile.

    Example: gearlink export designs/ty460.yaml --part main_cam --as dxf --as svg
    """
    from gearlink.cli.export.command import run_export

    options = Options(out=out, overrides=tuple(set_), quiet=quiet)
    raise typer.Exit(run_export(spec, Export(tuple(dict.fromkeys(as_)), tuple(part), tolerance, curve, options)))
