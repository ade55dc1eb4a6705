"""`gearlink watch`: the report of a design file on a page of this machine, made anew whenever the file is saved."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from functools import partial
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import build, exit_status, open_design, read_spec
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Options
from gearlink.cli.patience import patience
from gearlink.cli.printable import visible
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.core.errors import NoSolution
from gearlink.core.kind import FileDesigns

if TYPE_CHECKING:
    from gearlink.cli.page.server import Board
    from gearlink.cli.page.sheets import Remembered
    from gearlink.core.design import Design
    from gearlink.core.report import Check, Report

    Stamp = tuple[int, int, int] | None

_EVERY = 0.05
"""Between two looks at the file [s]."""
_GONE = 40
"""So many looks without a file, and it is told: an editor takes it away for a moment only."""
_FIRST_PICTURES = 60
"""A film of so few pictures comes at once; the whole one follows the sheets."""


def run_watch(source: str, options: Options, *, port: int = 0, show: bool = False) -> int:
    """Serve the page of a design file until Ctrl-C ends it.

    Parameters
        port : int - 0 takes a free one
        show : bool - open the page in the browser
    """
    from gearlink.cli.page.sections import watch_script, whole_page
    from gearlink.cli.page.server import Board, served
    from gearlink.cli.page.sheets import Remembered

    if source == "-":
        error = DesignFileError([Diagnostic("GL115", "watch needs a file, not standard input", "<command line>")])
        return show_refusal(error, source, options)
    board, path, sheets = Board(), Path(source), Remembered()
    if not source or _stamp(path) is None:
        wrong = Diagnostic("GL101", "no such file; watch begins with one that is there", source)
        return show_refusal(DesignFileError([wrong]), source, options)
    if path.is_dir():
        wrong = Diagnostic("GL101", "this is a folder; watch shows one design file", source)
        return show_refusal(DesignFileError([wrong]), source, options)
    page = whole_page(path.name, ['<div id="problem" role="status"></div>'], watch_script())
    try:
        with served(board, lambda: page, port) as address:
            print(f"{visible(source)}: {address} (Ctrl-C ends)", file=sys.stderr, flush=True)
            if show:
                import webbrowser

                webbrowser.open(address)
            _follow(path, lambda unchanged: _make(source, options, board, sheets, unchanged), options)
    except CannotWrite as error:
        return show_refusal(error, source, options)
    return ExitCode.OK


def _follow(path: Path, make: Callable[[Callable[[], bool]], str], options: Options) -> None:
    """Make the page whenever the file is another; a page in the making is given up for a newer one."""
    seen: Stamp = None
    missing = 0
    while True:
        now = _stamp(path)
        missing = missing + 1 if now is None else 0
        if (now == seen and missing == 0) or (missing and missing != _GONE):
            time.sleep(_EVERY)
            continue
        seen, start = now, time.monotonic()
        with patience(f"making the page of {path.name}", quiet=options.quiet):
            words = make(partial(_is_still, path, seen))
        if words and not options.quiet:
            print(f"{words} ({time.monotonic() - start:.2f} s)", file=sys.stderr, flush=True)


def _is_still(path: Path, stamp: Stamp) -> bool:
    return _stamp(path) in (stamp, None)


def _stamp(path: Path) -> Stamp:
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


def _make(source: str, options: Options, board: Board, sheets: Remembered, unchanged: Callable[[], bool]) -> str:
    """Put all pieces on the board; gives a word of how it went, none where the file changed meanwhile."""
    try:
        loaded, kind = open_design(source, options)
        spec = read_spec(loaded, kind, source)
        designs = FileDesigns(kind, spec)
        parts = [build(loaded, kind, command, spec, options, designs=designs) for command in spec.commands()]
        for put in _pieces(board, sheets, loaded.text, spec, parts):
            if not unchanged():
                return ""
            put()
    except (DesignFileError, NoSolution) as error:
        words = str(error) if isinstance(error, DesignFileError) else visible(f"{error.code}: {error}")
        board.fail(f"<pre>{escape(words)}</pre>")
        return words
    except Exception as fault:  # the page says so, and the next save is another try
        words = visible(f"fault of the program: {type(fault).__name__}: {fault}")
        board.fail(f"<pre>{escape(words)}</pre>")
        return words
    failed = any(exit_status(report, strict=options.strict) for _, report in parts)
    return visible(f"{spec.name}: a check fails" if failed else f"{spec.name}: pass")


def _pieces(
    board: Board, sheets: Remembered, text: str, spec: Any, parts: list[tuple[Design, Report]]
) -> list[Callable[[], None]]:
    """The steps of making the page: the film, all numbers, then sheet by sheet, and again those whose panels moved."""
    from gearlink.cli.page import sections

    names = [f"piece-{i}" for i in range(len(parts))]
    order = ["head", "film", *(name + kind for name in names for kind in ("-sheet", "-results")), "input"]

    def results(i: int) -> str:
        return sections.results(parts[i][1])

    def drawing(i: int, draw: Callable[[str, Design, tuple[Check, ...]], str]) -> None:
        design, report = parts[i]
        if html := draw(report.command, design, report.checks):
            board.put(f"{names[i]}-sheet", f"<h2>{escape(report.command)}</h2>{html}")

    every = range(len(parts))
    known = sheets.known
    return [
        lambda: board.begin(spec.name, order),
        lambda: board.put("head", sections.head(spec, [report for _, report in parts])),
        lambda: board.put("film", sections.film(parts[0][0], _FIRST_PICTURES)),
        # Numbers take milliseconds, a sheet half a second.
        *(lambda i=i: board.put(f"{names[i]}-results", results(i)) for i in every),
        lambda: board.put("input", sections.given(text, spec)),
        *(lambda i=i: drawing(i, sheets.at_once) for i in every),
        *(lambda i=i: drawing(i, sheets.moved) for i in every if parts[i][1].command in known),
    ]
