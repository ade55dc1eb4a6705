"""Commands that make pictures of their own: chart, animate. Each imports what it runs when it runs."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.options import Format, Options, PlotFormat


class MovingFormat(StrEnum):
    """How a moving picture is written."""

    GIF = "gif"
    MP4 = "mp4"
    HTML = "html"


OutOption = Annotated[Path, typer.Option("--out", metavar="DIR", help="folder for files that are written")]
SetOption = Annotated[list[str], typer.Option("--set", metavar="PATH=VALUE", help="override a key (repeatable)")]
QuietOption = Annotated[bool, typer.Option("--quiet", "-q", help="print no notes on standard error")]


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command tree."""
    app.command("chart")(_chart)
    app.command("animate")(_animate)


def _chart(
    name: Annotated[str, typer.Argument(metavar="NAME", help="chart; left out: the list of charts")] = "",
    design: Annotated[str, typer.Option("--design", metavar="SPEC", help="mark this design in the chart")] = "",
    range_: Annotated[str, typer.Option("--range", metavar="LOW:HIGH", help="range of the x axis")] = "",
    curves: Annotated[str, typer.Option("--curves", metavar="A,B,...", help="a curve for each parameter")] = "",
    samples: Annotated[int, typer.Option(min=2, max=1_000_000, help="rows of the table")] = 91,
    format: Annotated[Format, typer.Option("--format", "-f", help="how the table is printed")] = Format.TABLE,
    plot: Annotated[bool, typer.Option("--plot", help="write NAME-chart.png")] = False,
    plot_format: Annotated[PlotFormat, typer.Option("--plot-format", help="kind of picture")] = PlotFormat.PNG,
    out: OutOption = Path(),
    set_: SetOption = [],  # noqa: B006 - Typer copies it
    no_color: Annotated[bool, typer.Option("--no-color", help="no colours, as with NO_COLOR=1")] = False,
    quiet: QuietOption = False,
) -> None:
    """Design charts of the three-gear four-bar with I = 1: which frame and gears give which motion.

    Example: gearlink chart back-step --curves 60,90,120 --range -6:-1 --plot --format csv
    """
    from gearlink.cli.commands.chart import Asked, run_chart

    options = Options(
        format=format,
        plot=plot,
        plot_format=plot_format,
        out=out,
        overrides=tuple(set_),
        color=not no_color,
        quiet=quiet,
    )
    raise typer.Exit(run_chart(Asked(name, range_, curves, samples, design), options))


def _animate(
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="design file, or - for standard input")],
    format: Annotated[MovingFormat, typer.Option("--format", "-f", help="kind of moving picture")] = MovingFormat.GIF,
    out: OutOption = Path(),
    fps: Annotated[int, typer.Option(min=1, max=50, help="pictures per second")] = 25,
    seconds: Annotated[
        float | None,
        typer.Option(min=0.1, max=120.0, help="length of the loop; left out: 4, or longer for teeth to be followed"),
    ] = None,
    size: Annotated[str, typer.Option(metavar="WIDTHxHEIGHT", help="of the picture in pixels")] = "960x720",
    set_: SetOption = [],  # noqa: B006 - Typer copies it
    quiet: QuietOption = False,
) -> None:
    """The mechanism in motion: NAME-motion.gif, a loop without a jump. HTML has controls; mp4 needs ffmpeg.

    Example: gearlink animate design.yaml --format html --seconds 8
    """
    from gearlink.cli.commands.animate import Asked, run_animate

    options = Options(out=out, overrides=tuple(set_), quiet=quiet)
    raise typer.Exit(run_animate(spec, Asked(format.value, fps, seconds, size), options))
