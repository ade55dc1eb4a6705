"""`gearlink report`: a design as one self-contained HTML page, for reading and for print.

Everything is in the file: inputs, results with symbol, unit and source, findings, tables, sheets, film, and the scripts
of player and cursor. It holds no date, so the same design gives the same bytes.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from html import escape
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from gearlink.cli.evaluate import build, exit_status, open_design, read_spec
from gearlink.cli.files import CannotWrite, safe_stem, write_atomically, wrote
from gearlink.cli.options import Options
from gearlink.cli.progress import patience
from gearlink.cli.quiet import without_notes
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.kind import FileDesigns, Kind

if TYPE_CHECKING:
    from gearlink.cli.commands.diff import Difference
    from gearlink.cli.reading.loaded_file import LoadedFile
    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Report

    Part = tuple[Design, Report]


# Pieces of a page made side by side: every process takes the next that none has taken yet

Make: TypeAlias = Callable[[int], Any]

_TASKS: list[tuple[Make, int]] = []
"""What forked processes make, and where they read which is next: they need no way to it."""


def side_by_side(make: Make, count: int) -> list[Any] | None:
    """`make` of 0 to count - 1, the first in this process, the others where one is free, the last of them first.

    Parameters
        make : gives what can be sent from a process to another
        count : int - below 256
    Returns
        what was made, in order; None on a machine with a single processor, and where a piece was refused or a
        process died
    """
    spare = len(os.sched_getaffinity(0)) - 1 if sys.platform == "linux" else 0
    if min(spare, count - 1) < 1:
        return None
    from concurrent.futures import BrokenExecutor

    from gearlink.cli.parallel.workers import workers

    following, write = os.pipe()  # a byte is read by one process alone
    os.write(write, bytes(range(count - 1, 0, -1)))
    os.close(write)
    _TASKS[:] = [(make, following)]
    try:
        with workers(min(spare, count - 1)) as pool:
            others = [pool.submit(_taken) for _ in range(min(spare, count - 1))]
            found = {0: make(0)} | _taken()
            for other in others:
                found |= other.result()
            if len(found) < count:
                raise GearlinkError("a piece cannot be made")  # the other processes need not go on
    except (GearlinkError, BrokenExecutor):
        return None
    finally:
        os.close(following)
        _TASKS.clear()
    return [found[i] for i in range(count)]


def _taken() -> dict[int, Any]:
    """Make what nobody has taken until nothing is left; what was refused is missing."""
    ((make, following),) = _TASKS
    found: dict[int, Any] = {}
    while number := os.read(following, 1):
        with suppress(GearlinkError):
            found[number[0]] = make(number[0])
    return found


class Section(NamedTuple):
    """A command on the page: its report without tables, animation (of the first command), sheet and results as HTML."""

    report: Report
    film: str
    sheet: str
    results: str


class Asked(NamedTuple):
    """What the command line asks of a report.

    Fields
        format : str - html or pdf
        against : str - file of another design of the kind, whose differences are listed
        show : str - what the film draws on the mechanism
    """

    format: str = "html"
    against: str = ""
    show: str = ""


def run_report(source: str, options: Options, asked: Asked | None = None) -> int:
    """Write NAME.html or NAME.pdf into the folder of the options; gives the worst exit status of the commands."""
    asked = asked or Asked()
    try:
        if asked.show and asked.format == "pdf":
            message = f"--show {asked.show} is for the animation, which a pdf does not have\ngive --format html"
            raise DesignFileError([Diagnostic("GL115", message, "<command line>", key="--show")])
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        with patience(f"computing and drawing {spec.name}", quiet=options.quiet):
            changes = _changes(loaded, kind, source, asked.against) if asked.against else None
            if asked.format == "pdf":
                made, data = _as_pdf(loaded, kind, spec, options, changes)
            else:
                made, data = _as_html(loaded, kind, spec, options, changes, asked.show)
        path = options.out / f"{safe_stem(spec.name)}.{asked.format}"
        write_atomically(path, lambda stream: stream.write(data))
    except (DesignFileError, CannotWrite, NoSolution) as error:
        return show_refusal(error, source, options)
    if not options.quiet:
        print(wrote(path), file=sys.stderr)
    return max(exit_status(report, strict=options.strict) for report in made)


def _changes(loaded: LoadedFile, kind: Kind, source: str, against: str) -> Difference:
    """What differs from another design.

    Raises
        DesignFileError - where that cannot be read, or is of another kind
    """
    from gearlink.cli.commands.diff import compared, side_of

    before = side_of(*open_design(against, Options()))
    return compared(before, side_of(loaded, kind), (against, source))


def _as_html(
    loaded: LoadedFile, kind: Kind, spec: Any, options: Options, changes: Difference | None, show: str
) -> tuple[list[Report], bytes]:
    from gearlink.cli.views.page.sections import whole_page

    made = _sections(loaded, kind, spec, options, show)
    page = whole_page(spec.name, _body(loaded.text, spec, made, changes))
    return [section.report for section in made], page.encode()


def _as_pdf(
    loaded: LoadedFile, kind: Kind, spec: Any, options: Options, changes: Difference | None
) -> tuple[list[Report], bytes]:
    from gearlink.cli.commands.diff import lines_of
    from gearlink.cli.views.figures.write import tell_of_boxes
    from gearlink.cli.views.page.pdf import document

    if not options.quiet:
        tell_of_boxes(spec.name)
    designs = FileDesigns(kind, spec)
    found = (_built(loaded, kind, spec, options, designs, command) for command in _commands(kind, spec))
    parts = [part for part in found if part is not None]
    return [report for _, report in parts], document(parts, loaded.text, list(lines_of(changes)) if changes else ())


def _commands(kind: Kind, spec: Any) -> tuple[str, ...]:
    return (*spec.pages(), *_budgets(kind, spec))


def _built(
    loaded: LoadedFile, kind: Kind, spec: Any, options: Options, designs: FileDesigns, command: str
) -> Part | None:
    """Design and report of a command; None of a study of tolerances that takes long."""
    study: Any = designs.of(command) if command == "tolerance" else None
    if study is not None and not study.is_short:
        return None
    asked = options._replace(tables=kind.design_class(command).tables_of_page(command, spec))
    return build(loaded, kind, command, spec, asked, designs=designs)


def _sections(loaded: LoadedFile, kind: Kind, spec: Any, options: Options, show: str = "") -> list[Section]:
    """Every command of the design, several at a time on a machine with several processors.

    Where one is refused they are made again one after another, so that the first to refuse in the file's order says so.
    """
    with without_notes("matplotlib"):
        import matplotlib.backends.backend_svg  # noqa: F401 - once, not in every process
    commands, designs = _commands(kind, spec), FileDesigns(kind, spec)

    def built(command: str) -> Part | None:
        return _built(loaded, kind, spec, options, designs, command)

    def filmed(i: int) -> str | None:
        return show if i == 0 else None

    if show:
        from gearlink.cli.commands.animate import require_shown

        require_shown(designs.of(commands[0]), show)
    made = side_by_side(lambda i: _section(built(commands[i]), filmed(i)), len(commands))
    if made is None:
        parts = [built(command) for command in commands]
        made = [_section(part, filmed(i)) for i, part in enumerate(parts)]
    return [section for section in made if section is not None]


def _budgets(kind: Kind, spec: Any) -> Iterator[str]:
    """Register budget and tolerance study of a file that has them; samples that take long have their own command."""
    if getattr(spec, "tolerance", None) is None:
        return
    if getattr(spec, "register_", None) is not None and "register" in kind.commands:
        yield "register"
    yield "tolerance"


def _section(part: Part | None, show: str | None) -> Section | None:
    """A command on the page; with the film where it is said what that shows."""
    from gearlink.cli.views.page import sections

    if part is None:
        return None
    design, report = part
    film = "" if show is None else sections.film(design, show=show, checks=report.checks)
    drawn = sections.sheet(report.command, design, report.checks)
    return Section(replace(report, tables=()), film, drawn, sections.results(report))


def _body(text: str, spec: Any, made: Sequence[Section], changes: Difference | None = None) -> Iterator[str]:
    """In the order of a review: verdict and results, what has changed, film, figures with their numbers, input."""
    from gearlink.cli.render.numbers import number
    from gearlink.cli.views.page import sections

    yield sections.head(spec, [section.report for section in made])
    yield sections.contents([section.report.command for section in made], changed=changes is not None)
    if changes is not None:
        from gearlink.cli.commands.diff import lines_of, parts_of

        yield sections.changes(next(lines_of(changes)), parts_of(changes, lambda value: number(value, 9)))
    yield made[0].film
    for section in made:
        yield f'<section id="{sections.anchor(section.report.command)}">'
        yield f"<h2>{escape(section.report.command)}</h2>"
        yield section.sheet
        yield section.results
        yield "</section>"
    yield sections.given(text, spec)
