"""Puts `gearlink explore` into the command tree; what it runs is imported when it runs."""

from __future__ import annotations

from typing import Annotated

import typer

from gearlink.cli.options import Options
from gearlink.cli.typer_options import takes


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("explore")(_explore)


@takes("format", "overrides", "strict", "color", "quiet")
def _explore(
    study: Annotated[str, typer.Argument(metavar="STUDY", help="study file, or - for standard input")],
    options: Options,
) -> None:
    """Find the best of many designs: the exact front of a grid, or a sampled one.

    Exit status: 0 there is a front, 1 no design satisfies everything, 2 the study is wrong.

    Example: gearlink explore designs/studies/dwell_feed.yaml
    """
    from gearlink.cli.exploring.run import run_explore

    raise typer.Exit(run_explore(study, options))
