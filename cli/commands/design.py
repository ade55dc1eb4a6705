"""One command on one design file: read, build the design, report, render, plot.

What is computed is printed before it is drawn: no picture that cannot be made takes the numbers with it.

`--profile` reports on standard error what a command computed and how long each took.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass, field
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
from gearlink.cli.render.json_report import as_json
from gearlink.cli.render.markdown_report import as_markdown, text_of
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import fixed_name
from gearlink.core.base.report import Report
from gearlink.core.base.results import observed

if TYPE_CHECKING:
    from gearlink.core.base.design import Design


def run_design(command: str, source: str, options: Options) -> int:
    """Run `command` on the design file `source`, print the result, and give the exit status."""
    if not options.profile:
        return _run(command, source, options, lambda _: nullcontext())

    profile = Profile()
    try:
        return _run(command, source, options, profile.stage)
    finally:
        print("\n".join(profile.lines()), file=sys.stderr)


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
        saved: int = ExitCode.OK
        if options.save is not None:
            from gearlink.cli.commands.save import save

            saved = save(loaded, kind, command, design, options)
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
        print(as_json(report))
    elif options.format is Format.CSV:
        from gearlink.cli.render.csv_report import write_csv

        write_csv(report, sys.stdout)
    elif options.format is Format.MARKDOWN:
        print(as_markdown(report))
    elif options.quantities:
        print(as_lines(report))
    elif report.key and not options.all:
        from gearlink.cli.render.key_results import show_key_results

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
