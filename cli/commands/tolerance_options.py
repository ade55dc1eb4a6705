"""The commands of tolerances: their own options become keys of the sections `tolerance` and `register`."""

from __future__ import annotations

import math
from enum import StrEnum
from typing import Annotated

import typer

from gearlink.cli.options import OPTIONS, Options
from gearlink.cli.typer_options import Jobs, Spec, keyed, offers, takes

_SHARED = [name for name in OPTIONS if name not in ("samples", "suggest", "save", "round", "force", "candidates")]


class Method(StrEnum):
    """How a register band is computed."""

    WORST = "worst"
    RSS = "rss"
    MC = "mc"


Samples = Annotated[
    int | None, typer.Option("--samples", min=16, max=2**24, help="designs as manufactured; rounded up to 16 x 2^k")
]
Seed = Annotated[int | None, typer.Option("--seed", min=0, max=2**32 - 1, help="the same seed gives the same samples")]

Scheduler = Annotated[str, typer.Option("--dask", metavar="ADDRESS", help="compute on this scheduler's Dask cluster")]


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command tree."""
    app.command("tolerance")(_tolerance)
    app.command("register")(_register)


def _place(text: str) -> str | float:
    """An input angle [deg], or the name of a place."""
    try:
        angle = float(text)
    except ValueError:
        return text
    return angle if math.isfinite(angle) else text


@takes(*_SHARED)
def _tolerance(
    spec: Spec,
    options: Options,
    samples: Samples = None,
    seed: Seed = None,
    worst_case: Annotated[bool, typer.Option("--worst-case", help="add the table corners")] = False,
    sobol: Annotated[bool, typer.Option("--sobol", help="Sobol' indices of every source")] = False,
    allocate: Annotated[
        bool, typer.Option("--allocate", help="add the table allocation: grades at least cost")
    ] = False,
    jobs: Jobs = 0,
    dask: Scheduler = "",
) -> None:
    """Yield of a design as manufactured: spreads, capabilities, and which tolerance contributes what.

    Exit status: 1 a check of the nominal design fails, or the yield may lie below its target.

    Example: gearlink tolerance designs/candy_feed_tolerances.yaml --worst-case
    """
    from gearlink.cli.commands.design import run_design
    from gearlink.cli.parallel.shares import shares_by

    options = keyed(options, "tolerance", {"--samples": samples, "--seed": seed, "--sobol": sobol or None})
    added = (*(("corners",) if worst_case else ()), *(("allocation",) if allocate else ()))
    options = options._replace(tables=(*options.tables, *added))
    with shares_by(jobs, dask, words="samples", quiet=options.quiet):
        raise typer.Exit(run_design("tolerance", spec, options))


@takes(*_SHARED)
def _register(
    spec: Spec,
    options: Options,
    at: Annotated[
        str | None,
        typer.Option(
            "--at", metavar="PLACE", help="dwell, zone, handover, range, or an angle", autocompletion=offers("places")
        ),
    ] = None,
    method: Annotated[Method | None, typer.Option("--method", help="how the band is computed")] = None,
    radius: Annotated[
        float | None, typer.Option("--radius", min=1e-6, help="radius of the output's error in mm")
    ] = None,
    samples: Samples = None,
    seed: Seed = None,
    jobs: Jobs = 0,
    dask: Scheduler = "",
) -> None:
    """Register: what play, runout and the other errors of the parts cost at the output, by source.

    Exit status: 1 the budget is exceeded.

    Example: gearlink register designs/candy_feed_tolerances.yaml --at dwell
    """
    from gearlink.cli.commands.design import run_design
    from gearlink.cli.parallel.shares import shares_by

    place = None if at is None else _place(at)
    options = keyed(options, "register", {"--at": place, "--method": method and method.value, "--radius": radius})
    options = keyed(options, "tolerance", {"--samples": samples, "--seed": seed})
    with shares_by(jobs, dask, words="samples", quiet=options.quiet):
        raise typer.Exit(run_design("register", spec, options))
