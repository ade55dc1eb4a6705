"""Commands that make pictures of their own: chart, animate. Each imports what it runs when it runs."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from gearlink.cli.options import Options, PlotFormat
from gearlink.cli.typer_options import Spec, offers, option, takes

Show = Annotated[
    str,
    typer.Option(
        "--show",
        metavar="WHAT,...",
        help="draw on the mechanism: velocity, acceleration, force (each also as :POINT), path:POINT, centres, ghosts",
    ),
]


class PageFormat(StrEnum):
    """How a report is written."""

    HTML = "html"
    PDF = "pdf"


class MovingFormat(StrEnum):
    """How a moving picture is written."""

    GIF = "gif"
    MP4 = "mp4"
    HTML = "html"


class Paper(StrEnum):
    """Sheets of paper, ISO 216."""

    A0 = "A0"
    A1 = "A1"
    A2 = "A2"
    A3 = "A3"
    A4 = "A4"


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command tree."""
    app.command("chart")(_chart)
    app.command("animate")(_animate)
    app.command("sheet")(_sheet)


@takes(
    *("format", "plot", "plot_format", "dpi", "out", "overrides", "all", "digits", "color", "quiet"),
    plot="write the figure NAME-chart.png",
    all="show every row",
)
def _chart(
    options: Options,
    name: Annotated[
        str, typer.Argument(metavar="NAME", help="chart; default: list the charts", autocompletion=offers("charts"))
    ] = "",
    spec: Annotated[str, typer.Argument(metavar="SPEC", help="design file, of the chart residual")] = "",
    design: Annotated[str, typer.Option("--design", metavar="SPEC", help="mark this design in the chart")] = "",
    range_: Annotated[str, typer.Option("--range", metavar="LOW:HIGH", help="range of the x axis")] = "",
    curves: Annotated[str, typer.Option("--curves", metavar="A,B,...", help="a curve for each parameter")] = "",
    samples: Annotated[int, option("samples", help="rows of the table", most=1_000_000)] = 91,
    device: Annotated[str, typer.Option("--device", metavar="TYPE", help="of a wide swing: pneumatic or spring")] = "",
    stretch_ratio: Annotated[float | None, typer.Option("--stretch-ratio", min=0.0, help="of that spring")] = None,
    pivot_ratio: Annotated[float | None, typer.Option("--pivot-ratio", min=1.0, help="of that device")] = None,
) -> None:
    """Design charts of the three-gear four-bar with I = 1 over frame and gears, and of wide swings over the swing.

    The chart residual SPEC shows what vibration the laws of a file leave over the speed, beside usual laws.

    Example: gearlink chart back-step --curves 60,90,120 --range -6:-1 --plot --format csv
    """
    from gearlink.cli.commands.chart import Asked, run_chart

    raise typer.Exit(
        run_chart(Asked(name, range_, curves, samples, design or spec, (device, stretch_ratio, pivot_ratio)), options)
    )


@takes("out", "overrides", "quiet")
def _animate(
    spec: Spec,
    options: Options,
    format: Annotated[MovingFormat, option("format", help="file format of the animation")] = MovingFormat.GIF,
    fps: Annotated[int, typer.Option(min=1, max=50, help="frames per second")] = 25,
    seconds: Annotated[
        float | None,
        typer.Option(min=0.1, max=120.0, help="length of the loop; default: 4, or longer where teeth move fast"),
    ] = None,
    size: Annotated[str, typer.Option(metavar="WIDTHxHEIGHT", help="size of the figure in pixels")] = "960x720",
    show: Show = "",
) -> None:
    """Animate the mechanism as a seamless loop, NAME-motion.gif; HTML has controls, mp4 needs ffmpeg.

    Instants at which a check fails have a red frame.

    Example: gearlink animate design.yaml --format html --show velocity,path:C
    """
    from gearlink.cli.commands.animate import Asked, run_animate

    raise typer.Exit(run_animate(spec, Asked(format.value, fps, seconds, size, show), options))


@takes("plot_format", "dpi", "out", "overrides", "quiet")
def _sheet(
    spec: Spec,
    options: Options,
    names: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[NAME]...",
            help="motion, vectors, forces, dwell, zone, tornado, timing, pressure, contact, drawing; default: all",
            autocompletion=offers("sheets"),
        ),
    ] = None,
    scale: Annotated[
        str | None, typer.Option(metavar="1[:N]", help="draw cams true to this scale, with a bar that checks the print")
    ] = None,
    paper: Annotated[
        Paper | None, typer.Option(help="of --scale: the sheet of paper; default: as large as the drawing")
    ] = None,
    at: Annotated[
        str,
        typer.Option(metavar="X,...", help="of vectors: inputs in deg or mm, at most 4; default: the fastest"),
    ] = "",
    show: Show = "",
    format: Annotated[  # the name of the option
        PlotFormat | None, typer.Option("--format", "-f", help="the same as --plot-format")
    ] = None,
) -> None:
    """Write further sheets of a design: motion of every output, velocities and accelerations, timing, drawings of cams.

    A drawing of a cam whose check fails is stamped, exit status 1.

    Example: gearlink sheet press.yaml drawing --scale 1 --format pdf
    """
    from gearlink.cli.commands.sheet import Asked, run_sheet

    chosen = options if format is None else options._replace(plot_format=format)
    raise typer.Exit(
        run_sheet(spec, names or [], chosen, Asked(scale, None if paper is None else paper.value, at, show))
    )
