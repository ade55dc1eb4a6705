"""`gearlink chart`: a design chart as table, CSV, JSON or picture, with a design marked in it."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.commands.design import print_report, written_beside
from gearlink.cli.evaluate import open_design, read_spec, refusals_located, whole_design, wrong_kind
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, require_folder, safe_stem, wrote
from gearlink.cli.options import Format, Options
from gearlink.cli.progress import patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.cli.render.lists import listed
from gearlink.cli.views.figures.chart_list import CHARTS, OF_FILES, Axis, DesignChart, Marked
from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.write import write_figure
from gearlink.core.base.errors import NoSolution, at_key, named
from gearlink.core.base.report import Report, Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.three_gear.design import ThreeGearFourBar
    from gearlink.core.parts.cams.shaped_design import Vibration


_DEVICES = {"spring": "spring", "pneumatic": "cylinder"}
_LINK_TOLERANCE = 1e-3
_SMOOTH = 601


@dataclass(frozen=True, slots=True)
class Asked:
    """A chart as the command line asks for it; empty texts take the chart's own."""

    name: str
    range: str = ""
    curves: str = ""
    samples: int = 91
    design: str = ""
    device: tuple[str, float | None, float | None] = ("", None, None)
    """Type, stretch ratio and pivot ratio of a wide swing's device."""


def run_chart(asked: Asked, options: Options) -> int:
    """Print or draw a chart and give the exit status; without a name, list the charts."""
    if not asked.name:
        return _list_charts(options)
    if asked.name in OF_FILES:
        return _residual(asked, options)
    try:
        chart = _with_device(_chart_named(asked.name), asked)
        low, high = _range(asked.range, chart)
        curves = _curves(asked.curves, chart)
        if asked.device[2] is not None and chart.parameter is not None and chart.parameter.name == "pivot_ratio":
            curves = (asked.device[2],)
        if options.plot:
            require_folder(options.out)
        with patience(f"computing {asked.name}", quiet=options.quiet):
            report, marked = _report(chart, low, high, curves, asked, options)
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, asked.design or "<command line>", options)
    if marked is not None and marked.off_family > _LINK_TOLERANCE and not options.quiet:
        of_family = "the curves hold for coupler = rocker = sqrt((crank^2 + frame^2)/2); the links of"
        away = f"{100.0 * marked.off_family:.3g} % away from that, so its point need not lie on its curve"
        print(f"note: {of_family} {marked.name} are {away}", file=sys.stderr)
    print_report(report, options)

    return _drawn(lambda: write_chart(chart, report.tables[0], curves, marked, options), options)


def _drawn(write: Callable[[], Path], options: Options) -> int:
    """Write the picture where it is asked for, and say so."""

    def draw() -> None:
        path = write()
        if not options.quiet:
            print(wrote(path), file=sys.stderr)

    return written_beside(draw, "<--out>", options) if options.plot else ExitCode.OK


def _residual(asked: Asked, options: Options) -> int:
    """The chart of what vibration the laws of a file leave."""
    try:
        if not asked.design:
            words = "the chart residual needs a file with motion laws: gearlink chart residual SPEC"
            raise DesignFileError([Diagnostic("GL115", words, "<command line>", key="residual")])
        if options.plot:
            require_folder(options.out)
        name, found = _vibrations(asked, options)
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, asked.design or "<command line>", options)
    tables = []
    for each in found:
        columns: dict[str, tuple[Any, str]] = {"speed": (each.speed, each.unit), "periods": (each.periods, "1")}
        columns |= {law: (values, "1") for law, values in each.residuals.items()}
        tables.append(Table.of(each.path, columns))
    print_report(Report("design-chart", f"residual, {name}", "chart", (), (), tuple(tables)), options)

    def write() -> Path:
        from gearlink.cli.views.figures.motion_laws import write_residuals

        finer = replace(asked, samples=max(asked.samples, _SMOOTH))
        return write_residuals(name, _vibrations(finer, options)[1], options)

    return _drawn(write, options)


def _vibrations(asked: Asked, options: Options) -> tuple[str, list[Vibration]]:
    """Name of the design, and what each of its laws leaves.

    Raises
        DesignFileError - for a kind without laws, or a file that names no natural frequency
    """
    from gearlink.core.parts.cams.shaped_design import WithShapedLaws

    loaded, kind = open_design(asked.design, options)
    spec = read_spec(loaded, kind, asked.design)
    with refusals_located(loaded):
        design: Any = whole_design(kind, spec)
        if not isinstance(design, WithShapedLaws):
            raise wrong_kind(loaded, f"a {kind.name} has no motion laws, of which the chart residual is")
        found = design.vibrations(asked.samples - 1)
        if not found:
            fix = "give loads.vibration.frequency and the speed, or frequency and time of the law"
            raise NoSolution("no law of this file has natural periods", fix=fix)
    return spec.name, found


def _list_charts(options: Options) -> int:
    known = {chart.name: (chart.title, chart.source) for chart in CHARTS.values()} | OF_FILES
    if options.format is Format.JSON:
        import json

        print(json.dumps({name: {"title": title, "source": source} for name, (title, source) in known.items()}))
        return ExitCode.OK
    print(listed((name, f"{title} ({source})") for name, (title, source) in known.items()))
    return ExitCode.OK


def _chart_named(name: str) -> DesignChart:
    if name in CHARTS:
        return CHARTS[name]
    near = get_close_matches(name.lower().replace("_", "-"), [*CHARTS, *OF_FILES], n=3, cutoff=0.4)
    known = f"the charts are {', '.join([*CHARTS, *OF_FILES])}"
    remedy = f"nearest: {', '.join(near)}; {known}" if near else known
    raise DesignFileError([Diagnostic("GL115", f"no chart {named(name)}", "<command line>", key=name, help=remedy)])


def _with_device(chart: DesignChart, asked: Asked) -> DesignChart:
    """The chart for the device that the options name.

    Raises
        DesignFileError - for options that do not go together, or a chart that is about no device
    """
    device, stretch, ratio = asked.device
    if (device, stretch, ratio) == ("", None, None):
        return chart
    if chart.kind != "wide-swing-cam":
        words = f"not in the chart: the chart {chart.name} does not depend on an unloading device"
        raise _wrong("--device", device or chart.name, words)
    if device not in ("", "pneumatic", "spring"):
        raise _wrong("--device", device, "pneumatic or spring")
    if (device == "spring") != (stretch is not None):
        if device == "spring":
            raise _wrong("--device", device, "with a number of --stretch-ratio, as in 0.5")
        raise _wrong("--stretch-ratio", f"{stretch:g}", "with --device spring")
    if ratio is not None and not ratio > 1.0:
        raise _wrong("--pivot-ratio", f"{ratio:g}", "above 1")
    by_ratio = chart.parameter is not None and chart.parameter.name == "pivot_ratio"
    if asked.curves and ratio is not None and by_ratio:
        raise _wrong("--pivot-ratio", f"{ratio:g}", "omitted with --curves, which are pivot ratios")
    asked_for = {"stretch_ratio": stretch, "pivot_ratio": None if by_ratio else ratio}
    given = tuple((key, value) for key, value in asked_for.items() if value is not None)
    more = f", spring with mounting stretch {stretch:g} of its stroke" if device == "spring" else ""
    return replace(chart, given=given, title=chart.title + more)


def _range(text: str, chart: DesignChart) -> tuple[float, float]:
    if not text:
        return chart.range
    low, colon, high = text.partition(":")
    ends = _number(low), _number(high)
    if colon and ends[0] is not None and ends[1] is not None and ends[0] < ends[1]:
        return ends[0], ends[1]
    raise _wrong("--range", text, f"LOW:HIGH of {chart.x.name}, as in {chart.range[0]:g}:{chart.range[1]:g}")


def _curves(text: str, chart: DesignChart) -> tuple[float, ...]:
    if not text:
        return chart.curves
    if chart.parameter is None:
        raise _wrong("--curves", text, f"not in the chart: the chart {chart.name} has one curve")
    values = [_number(part) for part in text.split(",")]
    unit = "" if chart.parameter.unit == "1" else f" [{chart.parameter.unit}]"
    if None in values:
        example = ",".join(f"{value:g}" for value in chart.curves)
        raise _wrong("--curves", text, f"values of {chart.parameter.name}{unit}, as in {example}")
    return tuple(dict.fromkeys(values))  # type: ignore[arg-type]


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def _wrong(option: str, text: str, words: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", f"{text!r} must be {words}", f"<{option}>", key=text)])


def _report(
    chart: DesignChart, low: float, high: float, curves: tuple[float, ...], asked: Asked, options: Options
) -> tuple[Report, Marked | None]:
    try:
        table = chart.table(low, high, curves, asked.samples)
    except NoSolution as error:
        wrong = Diagnostic("GL112", error.message, "<command line>", key=chart.name, help=error.fix)
        raise DesignFileError([wrong]) from error
    marked = _marked(chart, asked.design, options) if asked.design else None
    name = chart.name if marked is None else f"{chart.name}, {marked.name}"
    quantities = () if marked is None else marked.quantities
    return Report("design-chart", name, "chart", quantities, (), (table,)), marked


def _marked(chart: DesignChart, source: str, options: Options) -> Marked:
    """The design of a file and its place in the chart.

    Raises
        DesignFileError - for a design that the chart does not hold for
    """
    loaded, kind = open_design(source, options)
    if kind.name != chart.kind:
        words = f"a {kind.name} is not in the chart {chart.name}; it applies to the kind {chart.kind}"
        raise wrong_kind(loaded, words)
    spec = read_spec(loaded, kind, source)
    with refusals_located(loaded):
        design: Any = whole_design(kind, spec)
        return _located_swing(chart, design) if chart.kind == "wide-swing-cam" else _located(chart, design)


def _located_swing(chart: DesignChart, design: Any) -> Marked:
    """A wide swing's place in a chart of the law, or the profile, of a device and a rocker alone."""
    spec, given = design.spec, dict(chart.given)
    device = "spring" if "stretch_ratio" in given else "pneumatic"
    if spec.unloader.type != device or spec.slider is not None:
        key = "unloader.type" if spec.unloader.type != device else "slider"
        raise NoSolution(f"the chart {chart.name} applies to a {_DEVICES[device]} that unloads only a rocker", key=key)
    if chart.y.name == "curvature_ratio" and spec.layout != "twin-rocker":
        raise NoSolution(f"the chart {chart.name} applies to an internal profile: layout twin-rocker", key="layout")
    place = chart.place(design)
    assert place is not None, "a law has its peaks"
    name = "middle_radius_estimate" if chart.y.name == "curvature_ratio" else chart.y.name
    return Marked(spec.name, place, (design.quantity(name),), 0.0)


def _located(chart: DesignChart, design: ThreeGearFourBar) -> Marked:
    if design.crank_teeth != design.output_teeth:
        with at_key("gears.output"):
            words = "the charts hold for I = 1, equal teeth of crank and output gear: this design has"
            fix = f"set gears.output to {design.crank_teeth}, or use analyze"
            raise NoSolution(f"{words} {design.crank_teeth} and {design.output_teeth}", fix=fix)
    place = chart.place(design)
    if place is None and chart.y.name == "tolerance_dwell_angle":
        words = f"this design has no tolerance of its dwell, so it is not in the chart {chart.name}"
        raise NoSolution(words, key="dwell_tolerance", fix="give dwell_tolerance")
    if place is None:
        why = f"never steps back (minimum speed ratio {design.speed_ratio_min:.6g})"
        words = f"the output of this design {why}, so it is not in the chart {chart.name}"
        raise NoSolution(words, fix="shorten the frame, or use the chart nonuniformity")
    family = design.crank_length * math.sqrt(0.5 * (1.0 + design.frame_ratio**2))
    names = ("i3", "frame_ratio", "back_step_crank_angle", "back_step_angle", "nonuniformity")
    found = tuple(each for name in names if (each := design.quantity(name)) is not None)
    return Marked(design.spec.name, place, found, abs(design.coupler_length / family - 1.0))


_COLORS = (style.BLUE, style.RED, style.GREEN, style.ORANGE, style.PURPLE, style.SKY, style.BLACK)
_BESIDE_A_POINT = 25
"""Places between two rows beside the maximum of a pointed curve."""
_DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (6, 2, 1.5, 2)))
"""Neighbours differ in their lines as well, for grey print; each of 21 curves has its own look."""


def draw(chart: DesignChart, table: Table, curves: tuple[float, ...], marked: Marked | None) -> Figure:
    """A chart: each curve with its parameter in the legend, in the order of their ends."""
    made = panels.page(chart.title, 0.45)
    axes = made.add_subplot()
    style.curves(axes, _label(chart.x), _label(chart.y))
    for i, values in enumerate(table.data[1:]):
        x, y = table.data[0], values
        if chart.peaked:
            x, y = _pointed(chart, table.data[0], values, curves[i])
        dashes = _DASHES[i % len(_DASHES)]
        label = _curve_label(chart, curves[i]) if chart.parameter is not None else None
        axes.plot(x, y, color=_COLORS[i % len(_COLORS)], linewidth=1.6, linestyle=dashes, label=label, gid=f"curve-{i}")
    axes.set_xlim(table.data[0][0], table.data[0][-1])
    if marked is not None:
        _mark(axes, marked)
    if chart.parameter is not None or marked is not None:
        title = "" if chart.parameter is None else chart.parameter.words
        place: dict[str, Any] = {"loc": "upper left", "bbox_to_anchor": (1.01, 1.0), "borderaxespad": 0.0}
        axes.legend(frameon=False, fontsize=8.5, title=title, **place)
    return made


def _pointed(chart: DesignChart, x: Any, y: Any, parameter: float) -> tuple[Any, Any]:
    """A curve with more places about its maximum row, from the row before it to that after it."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    for _ in range(2):
        top = int(np.argmax(np.nan_to_num(y, nan=-np.inf)))
        if not 0 < top < len(x) - 1:
            break
        between = np.linspace(x[top - 1], x[top + 1], _BESIDE_A_POINT)
        around = chart.values(between, parameter)
        x, y = (np.concatenate((a[: top - 1], b, a[top + 2 :])) for a, b in ((x, between), (y, around)))
    return x, y


def write_chart(
    chart: DesignChart, table: Table, curves: tuple[float, ...], marked: Marked | None, options: Options
) -> Path:
    """Draw a chart and write NAME-chart.FORMAT, or DESIGN-NAME-chart.FORMAT, into the folder of the options.

    Raises
        CannotWrite - where the folder or the disk does not take the file
    """
    name = "" if marked is None else marked.name
    stem = chart.name if marked is None else f"{safe_stem(name)}-{chart.name}"

    def make() -> Figure:
        return settled(draw(chart, table, curves, marked))

    return write_figure(make, name, "chart", options, stem)


def _label(axis: Axis) -> str:
    unit = "" if axis.unit == "1" else f" [{axis.unit}]"
    return f"{axis.words} {axis.symbol}{unit}"


def _curve_label(chart: DesignChart, value: float) -> str:
    assert chart.parameter is not None, "needed for curves alone"
    unit = "°" if chart.parameter.unit == "deg" else ""
    return f"{chart.parameter.symbol} = {style.number(value)}{unit}"


def _mark(axes: Axes, marked: Marked) -> None:
    """The design's point with lines to both axes."""
    x, y = marked.place
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, x), max(high, x))
    label = f"{marked.name}\n({x:.5g}, {y:.5g})".replace("$", r"\$")
    axes.plot([x], [y], "D", color=style.BLACK, markersize=7, zorder=6, label=label, gid="design")
    axes.relim()
    axes.autoscale_view(scalex=False)
    left, bottom = axes.get_xlim()[0], axes.get_ylim()[0]
    axes.plot([left, x, x], [y, y, bottom], color=style.BLACK, linewidth=0.8, linestyle=(0, (4, 3)), zorder=5)
    axes.set_ylim(bottom=bottom)
