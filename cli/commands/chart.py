"""`gearlink chart`: a design chart as table, CSV, JSON or picture, with a design marked in it."""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from gearlink.cli.commands.design import print_report, written_beside
from gearlink.cli.evaluate import open_design, read_spec, refusals_located, whole_design, wrong_kind
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, require_folder, wrote
from gearlink.cli.options import Format, Options
from gearlink.cli.patience import patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.cli.render.lists import listed
from gearlink.cli.views.figures.chart_list import CHARTS, DesignChart, Marked
from gearlink.core.base.errors import NoSolution, at_key, named
from gearlink.core.base.report import Report

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar

_LINK_TOLERANCE = 1e-3


@dataclass(frozen=True, slots=True)
class Asked:
    """A chart as the command line asks for it; empty texts take the chart's own."""

    name: str
    range: str = ""
    curves: str = ""
    samples: int = 91
    design: str = ""


def run_chart(asked: Asked, options: Options) -> int:
    """Print or draw a chart and give the exit status; without a name, list the charts."""
    if not asked.name:
        return _list_charts(options)
    try:
        chart = _chart_named(asked.name)
        low, high = _range(asked.range, chart)
        curves = _curves(asked.curves, chart)
        if options.plot:
            require_folder(options.out)
        with patience(f"computing {asked.name}", quiet=options.quiet):
            report, marked = _report(chart, low, high, curves, asked, options)
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, asked.design or "<command line>", options)
    if marked is not None and marked.off_family > _LINK_TOLERANCE and not options.quiet:
        print(_off_family(marked), file=sys.stderr)
    print_report(report, options)

    def draw() -> None:
        from gearlink.cli.views.figures.design_charts import write_chart

        path = write_chart(chart, report.tables[0], curves, marked, options)
        if not options.quiet:
            print(wrote(path), file=sys.stderr)

    return written_beside(draw, "<--out>", options) if options.plot else ExitCode.OK


def _list_charts(options: Options) -> int:
    if options.format is Format.JSON:
        import json

        print(json.dumps({chart.name: {"title": chart.title, "source": chart.source} for chart in CHARTS.values()}))
        return ExitCode.OK
    print(listed((chart.name, f"{chart.title} ({chart.source})") for chart in CHARTS.values()))
    return ExitCode.OK


def _chart_named(name: str) -> DesignChart:
    if name in CHARTS:
        return CHARTS[name]
    near = get_close_matches(name.lower().replace("_", "-"), CHARTS, n=3, cutoff=0.4)
    known = f"the charts are {', '.join(CHARTS)}"
    remedy = f"nearest: {', '.join(near)}; {known}" if near else known
    raise DesignFileError([Diagnostic("GL115", f"no chart {named(name)}", "<command line>", key=name, help=remedy)])


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
        raise _wrong("--curves", text, f"left out: the chart {chart.name} has one curve")
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
        raise DesignFileError([Diagnostic("GL112", str(error), "<command line>", key=chart.name)]) from error
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
        words = f"a {kind.name} has no place in the chart {chart.name}; it is about the kind {chart.kind}"
        raise wrong_kind(loaded, words)
    spec = read_spec(loaded, kind, source)
    with refusals_located(loaded):
        design: Any = whole_design(kind, spec)
        return _located_swing(chart, design) if chart.kind == "wide-swing-cam" else _located(chart, design)


def _located_swing(chart: DesignChart, design: Any) -> Marked:
    """A wide swing's place in a chart of the unloading law, which is that of a cylinder and a rocker alone."""
    spec = design.spec
    if spec.unloader.type != "pneumatic" or spec.slider is not None:
        key = "unloader.type" if spec.unloader.type != "pneumatic" else "slider"
        raise NoSolution(f"the chart {chart.name} is about a cylinder that unloads a rocker alone", key=key)
    place = chart.place(design)
    assert place is not None, "a law has its peaks"
    return Marked(spec.name, place, (design.quantity(chart.y.name),), 0.0)


def _located(chart: DesignChart, design: ThreeGearFourBar) -> Marked:
    if design.crank_teeth != design.output_teeth:
        with at_key("gears.output"):
            raise NoSolution(
                f"the charts hold for I = 1, equal teeth of crank and output gear: this design has {design.crank_teeth}"
                f" and {design.output_teeth}; set gears.output to {design.crank_teeth}, or use analyze"
            )
    place = chart.place(design)
    if place is None and chart.y.name == "tolerance_dwell_angle":
        raise NoSolution(
            f"this design names no tolerance of its dwell, so it has no place in the chart {chart.name}: give "
            "dwell_tolerance",
            key="dwell_tolerance",
        )
    if place is None:
        raise NoSolution(
            f"the output of this design never steps back (least speed ratio {design.speed_ratio_min:.6g}), so it has "
            f"no place in the chart {chart.name}: shorten the frame, or take the chart nonuniformity"
        )
    family = design.crank_length * math.sqrt(0.5 * (1.0 + design.frame_ratio**2))
    names = ("i3", "frame_ratio", "back_step_crank_angle", "back_step_angle", "nonuniformity")
    found = [design.quantity(name) for name in names]
    return Marked(
        design.spec.name,
        place,
        tuple(quantity for quantity in found if quantity is not None),
        abs(design.coupler_length / family - 1.0),
    )


def _off_family(marked: Marked) -> str:
    return (
        f"note: the curves hold for coupler = rocker = sqrt((crank^2 + frame^2)/2); the links of {marked.name} are "
        f"{100.0 * marked.off_family:.3g} % away from that, so its point need not lie on its curve"
    )
