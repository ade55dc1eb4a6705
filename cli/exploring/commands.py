"""Puts `gearlink explore` into the command tree; what it runs is imported when it runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.exploring.options import Exploring
from gearlink.cli.options import Options, folder, plain_file
from gearlink.cli.typer_options import Dask, Jobs, keyed, place, takes


def register(app: typer.Typer) -> None:
    """Add the command."""
    app.command("explore")(_explore)


@takes("format", "plot", "plot_format", "out", "overrides", "digits", "strict", "color", "quiet")
def _explore(
    source: Annotated[str, typer.Argument(metavar="STUDY", help="study file, - for standard input, or a store")],
    options: Options,
    store: Annotated[
        Path | None, place(plain_file, "--store", metavar="FILE", help="keep what is finished in this file")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="continue what the store has")] = False,
    budget: Annotated[float | None, typer.Option(min=1.0, metavar="N", help="most designs")] = None,
    seed: Annotated[int | None, typer.Option(min=0, metavar="N", help="seed of a sampled study")] = None,
    jobs: Jobs = 0,
    dask: Dask = "",
    show: Annotated[str, typer.Option(metavar="N", help="print design N (mK: nearest miss of row K of why)")] = "",
    write: Annotated[
        Path | None, place(folder, "--write", metavar="DIR", help="write the kept designs as files")
    ] = None,
) -> None:
    """Find the best of many designs: the exact front of a grid, or a sampled one.

    Exit status: 0 there is a front, 1 no design satisfies everything, 2 the study is wrong.

    Example: gearlink explore designs/studies/dwell_feed.yaml
    """
    from gearlink.cli.exploring.run import run_explore

    options = keyed(options, "sampling", {"--budget": budget, "--seed": seed})
    asked = Exploring(options, source, store, resume, jobs, dask, show, write)
    raise typer.Exit(run_explore(asked))
