"""One command on one design file: read, build the design, report, render, plot.

What is computed is printed before it is drawn: no picture that cannot be made takes the numbers with it.

`--profile` reports on standard error what a command computed and how long each took.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
from shutil import get_terminal_size
from time import perf_counter
from typing import TYPE_CHECKING

from gearlink.cli.evaluate import build, exit_status, open_design, read_spec, require_command
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, require_folder, wrote
from gearlink.cli.options import STREAM, Format, Options
from gearlink.cli.printable import visible
from gearlink.cli.progress import patience
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.render.errors import show_refusal
from gearlink.cli.render.markdown_report import as_markdown, text_of
from gearlink.cli.render.numbers import drawn, number, quiet, scales
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.key_results import KeyResult
from gearlink.core.base.nomenclature import fixed_name
from gearlink.core.base.report import Report
from gearlink.core.base.results import observed
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from gearlink.cli.reading.loaded_file import LoadedFile
    from gearlink.core.base.design import Design
    from gearlink.core.base.kind import Kind


def run_design(command: str, source: str, options: Options) -> int:
    """Run `command` on the design file `source`, print the result, and give the exit status."""
    if not options.profile:
        return _run(command, source, options, _untimed)

    profile = Profile()
    try:
        return _run(command, source, options, profile.stage)
    finally:
        print("\n".join(profile.lines()), file=sys.stderr)


def _untimed(_: str) -> AbstractContextManager[None]:
    return nullcontext()


def _run(command: str, source: str, options: Options, step: Callable[[str], AbstractContextManager[None]]) -> int:
    try:
        _before(options)
        with step("read"):
            loaded, kind = open_design(source, options)
            require_command(loaded, kind, command)
        with step("validate"):
            spec = read_spec(loaded, kind, source)
        with step("load the formulas"):
            kind.class_for(command, spec)
        with step("compute"), patience(f"computing {spec.name}", quiet=options.quiet):
            design, report = build(loaded, kind, command, spec, options, key_tables=options.brief)
        saved = ExitCode.OK if options.save is None else _save(loaded, kind, command, design, options)
    except (DesignFileError, CannotWrite, NoSolution) as error:
        return show_refusal(error, source, options)
    with step("print"):
        if options.save != STREAM:
            print_report(report, options)
    _notes(design, report, options)
    with step("draw") if options.plot else nullcontext():
        beside = plotted(command, design, options, report, source)
    return max(saved, beside, exit_status(report, strict=options.strict))


def plotted(command: str, design: Design, options: Options, report: Report, source: str) -> int:
    """Write the figure that is asked for beside a result, and give the exit status of that."""
    if not options.plot:
        return ExitCode.OK
    return written_beside(lambda: plot(command, design, options, report), source, options)


def written_beside(write: Callable[[], object], source: str, options: Options) -> int:
    """Write files beside a result that stands on standard output already, and give the exit status of that.

    What keeps them from being written is told on standard error, in whatever form the result is.
    """
    try:
        write()
    except (CannotWrite, NoSolution) as error:
        return show_refusal(error, source, options._replace(format=Format.TABLE))
    return ExitCode.OK


def _notes(design: Design, report: Report, options: Options) -> None:
    """Say of each quantity that was asked for by name what it rests on or, without a value, what the file must give."""
    known = {quantity.name for quantity in report.quantities}
    for given in () if options.quiet else options.quantities:
        if (name := fixed_name(given, design.quantity_names())) not in known:
            needs = design.needs(name)
            print(f"{name}: not known of this design{f'; {needs}' if needs else ''}", file=sys.stderr)
        elif inputs := design.rests_on(name):
            print(f"{name}: {inputs}", file=sys.stderr)


def _before(options: Options) -> None:
    """Refuse what `--save` and `--plot` cannot do before anything is computed."""
    if options.plot:
        require_folder(options.out)
    if options.save is not None or options.round is not None:
        from gearlink.cli.commands.save import require_place

        require_place(options)


def _save(loaded: LoadedFile, kind: Kind, command: str, design: Design, options: Options) -> int:
    from gearlink.cli.commands.save import save

    return save(loaded, kind, command, design, options)


def plot(command: str, design: Design, options: Options, report: Report) -> None:
    """Write the design's figure, with what its report finds wrong, and say where."""
    from gearlink.cli.views.figures.write import write_plot

    with patience(f"drawing {report.name}", quiet=options.quiet):
        path = write_plot(command, design, options, checks=report.checks)
    if not options.quiet:
        print(wrote(path), file=sys.stderr)


def print_report(report: Report, options: Options) -> None:
    """Print a report in the format of the options."""
    if options.format is Format.JSON:
        from gearlink.cli.render.json_report import as_json

        print(as_json(report))
    elif options.format is Format.CSV:
        from gearlink.cli.render.csv_report import write_csv

        write_csv(report, sys.stdout)
    elif options.format is Format.MARKDOWN:
        print(as_markdown(report))
    elif options.quantities:
        print(as_lines(report))
    elif report.key and not options.all:
        show_key_results(report, options)
    else:
        from gearlink.cli.render.terminal import show

        show(report, options)


def as_lines(report: Report) -> str:
    """`149.11 149.11 mm` for one quantity; `name = ...` where several were asked for."""
    several = len(report.quantities) > 1
    lines = []
    for quantity in report.quantities:
        unit = "" if quantity.unit == "1" else f" {quantity.unit}"
        lines.append((f"{quantity.name} = " if several else "") + visible(text_of(quantity.value)) + unit)
    return "\n".join(lines)


@dataclass(slots=True)
class Step:
    """A result that was computed: with what it took itself, and with what it asked others for."""

    name: str
    depth: int
    total: float = 0.0
    own: float = 0.0


@dataclass(slots=True)
class Profile:
    """The steps of a run in the order in which they were begun."""

    steps: list[Step] = field(default_factory=list)
    _open: list[Step] = field(default_factory=list)

    @contextmanager
    def step(self, name: str) -> Iterator[None]:
        """Time what is done within; what is begun inside counts to the total, not to its own time."""
        step = Step(name, len(self._open))
        self.steps.append(step)
        self._open.append(step)
        begun = perf_counter()
        try:
            yield
        finally:
            took = perf_counter() - begun
            step.total += took
            step.own += took
            self._open.pop()
            if self._open:
                self._open[-1].own -= took

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time a stage of a command; while it computes, every result of gearlink.core is a step below it."""
        with observed(self.step) if name == "compute" else nullcontext(), self.step(name):
            yield

    def lines(self) -> list[str]:
        """The profile as text, one line per step, indented under the one that asked for it.

        Example
            >>> profile = Profile([Step("read", 0, 0.002, 0.002)])
            >>> profile.lines()
            ['   total ms     own ms  computed', '      2.000      2.000  read']
        """
        rows = [
            f"{step.total * 1e3:11.3f}{step.own * 1e3:11.3f}  {'  ' * step.depth}{step.name}" for step in self.steps
        ]
        return [f"{'total ms':>11}{'own ms':>11}  computed", *rows]


# The key results of a command on the terminal: what was asked for beside what was reached, and failed checks.
#
# Written without rich where all checks pass: its import takes longer than most designs.


_BOLD, _GREEN, _PLAIN = "\x1b[1m", "\x1b[32m", "\x1b[0m"
_WIDE = 110
"""Columns of a terminal that show the meaning of each quantity."""
_LONGEST = (18, 12)
"""Characters of a value in the column of values, where there is room for them and where there is not."""


def show_key_results(report: Report, options: Options) -> None:
    """Print the key results of a report, the tables that stand beside them, and the checks that do not pass."""
    coloured = _coloured(options)
    heading = f"{visible(' '.join(report.name.split()))}: {report.command} ({report.kind})"
    print(f"{_BOLD}{heading}{_PLAIN}" if coloured else heading)
    print("\n".join(_lines(report, options)))
    if more := _more(report):
        print(f"{more}: --all")
    passed = all(check.status == "pass" for check in report.checks)
    if report.tables or not passed:
        _show_rest(report, options)
    elif report.checks:
        verdict = f"{report.counted}: {len(report.checks)} pass"
        print(f"{_GREEN}{verdict}{_PLAIN}" if coloured else verdict)


def _show_rest(report: Report, options: Options) -> None:
    from gearlink.cli.render.terminal import console_for, show_findings, show_table

    console = console_for(options)
    for table in report.tables:
        if table.data and not len(table.data[0]):
            continue
        show_table(table, console, scale=scales(report), digits=options.digits)
    show_findings(report, console, passed=False)


def _coloured(options: Options) -> bool:
    return options.color and sys.stdout.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM") != "dumb"


def _lines(report: Report, options: Options) -> list[str]:
    """A line for each key result: title, value, unit and what was asked for; its name where the title is another.

    In a narrow terminal lists run on in further lines, and names that do not fit are left out.
    """
    scale = scales(report)
    values = [visible(drawn(quiet(q.value, scale.get(q.unit, 0.0)), q.unit, options.digits)) for q, *_ in report.key]
    columns = get_terminal_size((80, 24)).columns
    laid = [_laid(report.key, values, longest, columns >= _WIDE) for longest in _LONGEST]
    lines = next((lines for lines in laid if all(len(named) <= columns for _, named, _ in lines)), laid[-1])
    best = [next((form for form in forms if len(form) <= columns), forms[-1]) for forms in lines]
    indent = " " * (2 + max(len(each.title) for each in report.key))
    return [part for line in best for part in _folded(line, columns, indent)]


def _folded(line: str, columns: int, indent: str) -> list[str]:
    """A line, or a long list in lines below each other: texts one by one, numbers as many as there is space for."""
    if len(line) <= columns or " " not in line[len(indent) :]:
        return [line]
    if "; " in line:
        first, *others = line.split("; ")
        return [f"{first};", *(f"{indent}{each};" for each in others[:-1]), f"{indent}{others[-1]}"]
    from textwrap import wrap

    return wrap(line, columns, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def _laid(key: Sequence[KeyResult], values: Sequence[str], longest: int, wide: bool) -> list[tuple[str, str, str]]:
    """Each line with meaning and name, with the name, and without; values below each other but for longer ones."""
    tails = [_tail(each) for each in key]
    names = [each.quantity.name if each.title != each.quantity.name else "" for each in key]
    titles = max(len(each.title) for each in key)
    width = max((len(value) for value in values if len(value) <= longest), default=0)
    behind = max((len(tail) for tail, name in zip(tails, names, strict=True) if name or wide), default=0)
    lines = []
    for each, value, tail, name in zip(key, values, tails, names, strict=True):
        plain = f"{visible(each.title):<{titles}}  {value:>{width}} {tail:<{behind}}"
        meaning = ": ".join(filter(None, (name, each.quantity.words))) if wide else name
        lines.append((f"{plain}  {meaning}".rstrip(), f"{plain}  {name}".rstrip(), plain.rstrip()))
    return lines


def _tail(each: KeyResult) -> str:
    """Unit, and what was asked for."""
    unit = "" if each.quantity.unit == "1" else each.quantity.unit
    return f"{unit} ({each.how} {number(each.asked, 6)})".lstrip() if each.asked is not None else unit


def _more(report: Report) -> str:
    """What --all would show besides."""
    quantities = sum(q.value != [] for q in report.quantities) - len(report.key)
    parts = [
        *([amount(quantities, "more quantity", "more quantities")] if quantities > 0 else []),
        *([amount(len(report.left_out), "table" if quantities > 0 else "more table")] if report.left_out else []),
    ]
    return ", ".join(parts)
