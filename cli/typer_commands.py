"""Commands as Typer takes them, but for those of designs: around files, pictures, tolerances, studies and exports.

Each imports what it runs when it runs.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from gearlink.cli.exploring.options import Exploring
from gearlink.cli.export.options import (
    DEFAULT_TOLERANCE,
    LEAST_TOLERANCE,
    MOST_TOLERANCE,
    CurveForm,
    Export,
    FileFormat,
)
from gearlink.cli.options import OF_ANIMATE, OPTIONS, Format, Options, PlotFormat, file, folder, plain_file
from gearlink.cli.typer_options import Dask, Jobs, Spec, keyed, offers, option, place, takes
from gearlink.core.base.kinds import FILES


class PageFormat(StrEnum):
    """How text is printed that is no table of numbers."""

    TABLE = "table"
    JSON = "json"
    MARKDOWN = "md"


PageOption = Annotated[PageFormat, option("format", help="format of the answer")]


@takes("quiet")
def _new(
    options: Options,
    kind: Annotated[
        str,
        typer.Argument(metavar="KIND", help="kind of design; default: list the kinds", autocompletion=offers("kinds")),
    ] = "",
    out: Annotated[
        Path | None, option("out", type=file, metavar="FILE", help="file to write; default, or -: standard output")
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="overwrite the file")] = False,
) -> None:
    from gearlink.cli.commands.new import run_new

    raise typer.Exit(run_new(kind, out, force=force, quiet=options.quiet))


_new.__doc__ = f"""Write a commented example of a design file, ready to run and to change; without KIND, list the kinds.

    Kinds: {", ".join(FILES)}.

    Example: gearlink new gear-pair --out pair.yaml
    """


def _schema(
    kind: Annotated[
        str | None,
        typer.Argument(metavar="KIND", help="kind of design; default: all kinds", autocompletion=offers("kinds")),
    ] = None,
    write: Annotated[
        Path | None, place(folder, "--write", metavar="DIR", help="folder for the schema and settings for VS Code")
    ] = None,
) -> None:
    """JSON Schema (draft-07) of the design files, for editors that check and complete while you type.

    With --write DIR the editor knows design files by their name: DIR gets gearlink.schema.json, and, where there is
    none, .vscode/settings.json, which names the schema for designs/**/*.yaml and *.gearlink.yaml. Without it, give the
    schema's name in the first line of a design: `# yaml-language-server: $schema=gear-pair.schema.json`.

    Example: gearlink schema --write .
    """
    from gearlink.cli.commands.schema import run_schema, write_schema

    raise typer.Exit(run_schema(kind) if write is None else write_schema(kind, write))


def _explain(
    name: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="NAME",
            help="term, code, check, quantity, symbol, key, table, column, kind, law; (4-26) or figure 2-4 of a source",
            autocompletion=offers("explained"),
        ),
    ] = None,
    format: PageOption = PageFormat.TABLE,
) -> None:
    """Explain a term of the field, a code, check, quantity, symbol, key, table, column, kind or motion law.

    Terms are known in English, German and Chinese; without NAME, list the codes.

    Example: gearlink explain transmission angle
    """
    from gearlink.cli.commands.explain import run_explain

    raise typer.Exit(run_explain(" ".join(name) if name else None, Format(format.value)))


@takes("format", "overrides", "strict", "quiet")
def _check(
    places: Annotated[list[str], typer.Argument(metavar="SPEC|DIR", help="design files, folders, or -")],
    options: Options,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="show passed checks as well")] = False,
) -> None:
    """Run only the checks of designs; each finding is shown with its line in the design file.

    Example: gearlink check designs --strict
    """
    from gearlink.cli.commands.check import run_check

    raise typer.Exit(run_check(places, options, verbose=verbose))


@takes("digits", "color", digits="significant digits of values, or full; default: 9")
def _diff(
    old: Annotated[str, typer.Argument(metavar="OLD", help="design file, or result written with --format json")],
    new: Annotated[str, typer.Argument(metavar="NEW", help="file of the same type")],
    options: Options,
    format: PageOption = PageFormat.TABLE,
    tolerance: Annotated[
        float,
        typer.Option(
            min=0.0,
            help="inputs are equal within this times their magnitude, results within this times max(1, magnitude)",
        ),
    ] = 1e-9,
) -> None:
    """Compare two designs or two results: inputs, quantities, checks. Exit status 0: equal, 1: different.

    Example: gearlink diff press.yaml press-new.yaml --tolerance 1e-6
    """
    from gearlink.cli.commands.diff import run_diff

    raise typer.Exit(run_diff(old, new, options._replace(format=Format(format.value)), tolerance))


@takes("format", "color", "quiet")
def _verify(
    options: Options,
    prefixes: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="CASE-PREFIX",
            help="only cases with this prefix; default: all",
            autocompletion=offers("published_cases"),
        ),
    ] = None,
    everything: Annotated[bool, typer.Option("--all", help="show every number, not one line per case")] = False,
) -> None:
    """Compute published cases with this installation and compare each number with its source.

    The cases come from books, standards and reports, and are part of the program. Exit status 0: all numbers agree
    within their limits, 1: at least one does not.

    Example: gearlink verify khurmi
    """
    from gearlink.cli.commands.verify import run_verify

    raise typer.Exit(run_verify(prefixes or (), options, everything=everything))


Show = Annotated[
    str,
    typer.Option(
        "--show",
        metavar="WHAT,...",
        help="draw on the mechanism: velocity, acceleration, force (each also as :POINT), path:POINT, centres, ghosts",
    ),
]


class ReportFormat(StrEnum):
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
    design: Annotated[
        list[str] | None, typer.Option("--design", metavar="SPEC", help="mark this design in the chart")
    ] = None,
    range_: Annotated[str, typer.Option("--range", metavar="LOW:HIGH", help="range of the x axis")] = "",
    curves: Annotated[
        str, typer.Option("--curves", metavar="A,B,...", help="draw a curve for each of these parameters")
    ] = "",
    samples: Annotated[int, option("samples", help="rows of the table", most=1_000_000)] = 91,
    device: Annotated[
        str, typer.Option("--device", metavar="TYPE", help="device of a wide swing: pneumatic or spring")
    ] = "",
    stretch_ratio: Annotated[
        float | None, typer.Option("--stretch-ratio", min=0.0, help="stretch ratio of that spring")
    ] = None,
    pivot_ratio: Annotated[
        float | None, typer.Option("--pivot-ratio", min=1.0, help="pivot ratio of that device")
    ] = None,
) -> None:
    """Design charts of the three-gear four-bar with I = 1 over frame and gears, and of wide swings over the swing.

    The chart residual SPEC shows what vibration the laws of a file leave over the speed, beside usual laws.

    Example: gearlink chart back-step --curves 60,90,120 --range -6:-1 --plot --format csv
    """
    from gearlink.cli.commands.chart import Asked, run_chart

    designs = [*(design or ()), *([spec] if spec else ())]
    if len(designs) > 1:
        words = f"a chart marks one design, not {len(designs)}: call it once for each"
        raise typer.BadParameter(words, param_hint="--design")
    marked = designs[0] if designs else ""
    raise typer.Exit(
        run_chart(Asked(name, range_, curves, samples, marked, (device, stretch_ratio, pivot_ratio)), options)
    )


@takes(*OF_ANIMATE)
def _animate(
    spec: Spec,
    options: Options,
    format: Annotated[MovingFormat, option("format", help="file format of the animation")] = MovingFormat.GIF,
    fps: Annotated[int, typer.Option(min=1, max=50, help="frames per second")] = 25,
    seconds: Annotated[
        float | None,
        typer.Option(
            min=0.1, max=120.0, help="length of the loop in seconds; default: 4, or longer if teeth move fast"
        ),
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
        str | None, typer.Option(metavar="1[:N]", help="draw cams to this scale, with a bar to check the print")
    ] = None,
    paper: Annotated[
        Paper | None, typer.Option(help="with --scale: paper size; default: as large as the drawing")
    ] = None,
    at: Annotated[
        str,
        typer.Option(
            metavar="X,...", help="for vectors: up to 4 inputs in deg or mm; default: that of the maximum speed"
        ),
    ] = "",
    show: Show = "",
    format: Annotated[  # the name of the option
        PlotFormat | None, typer.Option("--format", "-f", help="same as --plot-format")
    ] = None,
) -> None:
    """Write further sheets of a design: motion of every output, vectors, timing, drawings of its parts.

    A drawing of a design in which a check fails is stamped, exit status 1.

    Example: gearlink sheet press.yaml drawing --scale 1 --format pdf
    """
    from gearlink.cli.commands.sheet import Asked, run_sheet

    chosen = options if format is None else options._replace(plot_format=format)
    raise typer.Exit(
        run_sheet(spec, names or [], chosen, Asked(scale, None if paper is None else paper.value, at, show))
    )


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
    worst_case: Annotated[bool, typer.Option("--worst-case", help="add the table corners (worst case)")] = False,
    sobol: Annotated[bool, typer.Option("--sobol", help="Sobol' indices of every source")] = False,
    allocate: Annotated[
        bool, typer.Option("--allocate", help="add the table allocation: grades of minimum cost")
    ] = False,
    jobs: Jobs = 0,
    dask: Scheduler = "",
) -> None:
    """Yield of a design as manufactured: variation, capability and contribution of each tolerance.

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
        float | None, typer.Option("--radius", min=1e-6, help="radius in mm at which the output's error is given")
    ] = None,
    samples: Samples = None,
    seed: Seed = None,
    jobs: Jobs = 0,
    dask: Scheduler = "",
) -> None:
    """Register: error at the output due to play, runout and other errors of the parts, by source.

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


@takes("format", "plot", "plot_format", "out", "overrides", "digits", "strict", "color", "quiet")
def _explore(
    source: Annotated[str, typer.Argument(metavar="STUDY", help="study file, - for standard input, or a store")],
    options: Options,
    store: Annotated[
        Path | None, place(plain_file, "--store", metavar="FILE", help="keep finished results in this file")
    ] = None,
    resume: Annotated[bool, typer.Option("--resume", help="continue from the results in the store")] = False,
    budget: Annotated[float | None, typer.Option(min=1.0, metavar="N", help="most designs")] = None,
    seed: Annotated[int | None, typer.Option(min=0, metavar="N", help="seed of a sampled study")] = None,
    jobs: Jobs = 0,
    dask: Dask = "",
    show: Annotated[
        str, typer.Option(metavar="N", help="print design N (mK: design nearest to row K of the table why)")
    ] = "",
    write: Annotated[
        Path | None, place(folder, "--write", metavar="DIR", help="write the kept designs as files")
    ] = None,
) -> None:
    """Find the best of many designs: the exact Pareto front of a grid, or a sampled one.

    Exit status: 0 there is a front, 1 no design satisfies all conditions, 2 the study is wrong.

    Example: gearlink explore designs/studies/dwell_feed.yaml
    """
    from gearlink.cli.exploring.run import run_explore

    options = keyed(options, "sampling", {"--budget": budget, "--seed": seed})
    asked = Exploring(options, source, store, resume, jobs, dask, show, write)
    raise typer.Exit(run_explore(asked))


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
            help="main_cam, cutter, gear1, PATH-POINT of a link, blocking_contour ... (repeatable)",
            autocompletion=offers("parts"),
        ),
    ] = [],  # noqa: B006
    tolerance: Annotated[
        float | None,
        typer.Option(
            min=LEAST_TOLERANCE,
            max=MOST_TOLERANCE,
            metavar="MM",
            help="maximum chord error, default 0.001; with --cam-table maximum position error (mm, deg)",
        ),
    ] = None,
    curve: Annotated[CurveForm, typer.Option(help="polyline of chords, or cubic spline")] = CurveForm.POLYLINE,
    width: Annotated[
        float | None,
        typer.Option(min=1e-3, max=1e5, metavar="MM", help="width of STEP solids; default: face_width of the file"),
    ] = None,
    cam_table: Annotated[
        bool, typer.Option("--cam-table", help="write the table for a servo drive instead of a cam, NAME-cam-table.csv")
    ] = False,
    rows: Annotated[
        int | None,
        typer.Option(min=2, max=100_000, help="rows of --cam-table, both ends included; default: servo of the file"),
    ] = None,
) -> None:
    """Write the profiles of cams and gears as DXF, SVG, CSV or STEP, NAME-PART.dxf for each part; gears as REXS.

    Closed outlines run counter-clockwise, also round a hole; the rows of a CSV of a cam follow its angle.

    STEP (solids) needs cadquery-ocp: pip install cadquery-ocp. REXS 1.7 is one file for all gears.

    Exit status 1: the files were written, but a check of the design fails.

    Example: gearlink export designs/ty460.yaml --part main_cam --as dxf --as svg
    """
    if cam_table:
        from gearlink.cli.export.command import run_cam_table

        raise typer.Exit(run_cam_table(spec, options, rows, tolerance))
    from gearlink.cli.export.command import run_export

    within = DEFAULT_TOLERANCE if tolerance is None else tolerance
    raise typer.Exit(run_export(spec, Export(tuple(dict.fromkeys(as_)), tuple(part), within, curve, options, width)))


COMMANDS: dict[str, Callable[..., None]] = {
    "check": _check,
    "diff": _diff,
    "new": _new,
    "schema": _schema,
    "explain": _explain,
    "verify": _verify,
    "export": _export,
    "explore": _explore,
    "tolerance": _tolerance,
    "register": _register,
    "chart": _chart,
    "animate": _animate,
    "sheet": _sheet,
}
