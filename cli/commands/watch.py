"""`gearlink watch`: the report of a design file on a page of this machine, made anew whenever the file is saved."""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import partial
from html import escape
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.evaluate import build, exit_status, open_design, read_spec
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.progress import patience
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kind import FileDesigns

if TYPE_CHECKING:
    from gearlink.cli.views.page.sections import Remembered
    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Check, Report

    Stamp = tuple[int, int, int] | None


# A page on the loopback address whose pieces are replaced while it is open (server-sent events)

LOOPBACK = "127.0.0.1"
_NAMES = (LOOPBACK, "localhost", "[::1]")
_HTTP = 80
"""The port that an address does not name."""
_HEARTBEAT = 10.0
"""After so many seconds without news a comment tells whether the reader is still there."""
_PATIENCE = 20.0
"""A reader who neither asks nor takes what is sent for so many seconds is let go [s]."""
_MOST_READERS = 64
"""Each has a thread; a browser opens six at most."""
_FULL = b"HTTP/1.0 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\n\r\n"


def own_names(port: int) -> set[str]:
    """How a reader on this machine may call a port of its own, as `Host` has it."""
    return {f"{name}:{port}" for name in _NAMES} | (set(_NAMES) if port == _HTTP else set())


def is_asked_locally(port: int, hosts: Sequence[str], origins: Sequence[str]) -> bool:
    """Whether a page is asked for by a name of the loopback address, once, and not by another page.

    A page of elsewhere whose own name was made to mean this machine sends that name.
    """
    own = own_names(port)
    return (
        len(hosts) == 1
        and hosts[0].strip().lower() in own
        and all(origin.strip().lower().removeprefix("http://") in own for origin in origins)
    )


class Board:
    """What the page shows: its pieces by name with the version they are of, and what is wrong."""

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._version = 0
        self._pieces: dict[str, tuple[int, str]] = {}
        self._order: list[str] = []
        self._title = self._problem = ""
        self._stale: list[str] = []
        self.closed = False

    def begin(self, title: str, order: list[str]) -> None:
        """A new state of the file: these pieces in this order; those that are there are of the state before."""
        with self._changed:
            self._title, self._order, self._problem = title, order, ""
            self._pieces = {name: piece for name, piece in self._pieces.items() if name in order}
            self._stale = list(self._pieces)
            self._announce()

    def put(self, name: str, html: str) -> None:
        """A piece."""
        with self._changed:
            self._stale = [other for other in self._stale if other != name]
            self._pieces[name] = (self._version + 1, html)
            self._announce()

    def fail(self, html: str) -> None:
        """What is wrong with the file; the pieces stay."""
        with self._changed:
            self._problem, self._stale = html, list(self._pieces)
            self._announce()

    def close(self) -> None:
        """End all who wait."""
        with self._changed:
            self.closed = True
            self._changed.notify_all()

    def _announce(self) -> None:
        self._version += 1
        self._changed.notify_all()

    def news(self, since: int, seconds: float) -> tuple[int, dict[str, Any]] | None:
        """The version now and what has changed since one; None where nothing has within some seconds."""
        with self._changed:
            self._changed.wait_for(lambda: self._version > since or self.closed, seconds)
            if self._version <= since or self.closed:
                return None
            fresh = {name: html for name, (version, html) in self._pieces.items() if version > since}
            said = {"title": self._title, "order": self._order, "stale": self._stale, "problem": self._problem}
            return self._version, {**said, "pieces": fresh}


@contextmanager
def served(board: Board, shell: Callable[[], str], port: int) -> Iterator[str]:
    """Serve a board in the background; gives the address of the page.

    Parameters
        shell : the page without its pieces
        port : int - 0 takes one that is free
    Raises
        CannotWrite - where the port is taken
    """
    try:
        server = _Server((LOOPBACK, port), _handler(board, shell))
    except OSError as error:
        words = f"cannot serve on {LOOPBACK}:{port}: {error.strerror or error}\ngive another --port"
        raise CannotWrite(words) from error
    thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.1}, daemon=True)
    thread.start()
    try:
        yield f"http://{LOOPBACK}:{server.server_address[1]}/"
    finally:
        board.close()
        server.shutdown()
        server.server_close()


class _Server(ThreadingHTTPServer):
    daemon_threads = True

    def __init__(self, *given: Any) -> None:
        self._room = threading.BoundedSemaphore(_MOST_READERS)
        self.allow_reuse_address = sys.platform != "win32"  # where it would take the port of a server that runs
        super().__init__(*given)

    def process_request(self, request: Any, client_address: Any) -> None:
        """A thread for each reader; there are so many and no more."""
        if not self._room.acquire(blocking=False):
            with suppress(OSError):
                request.send(_FULL)
            self.shutdown_request(request)
            return
        try:
            super().process_request(request, client_address)
        except BaseException:  # no thread was to be had
            self._room.release()
            raise

    def process_request_thread(self, request: Any, client_address: Any) -> None:
        """What the thread of a reader does."""
        try:
            super().process_request_thread(request, client_address)
        finally:
            self._room.release()

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A reader who goes away in the middle, of a request or of an answer, is no error."""
        if not isinstance(sys.exception(), ConnectionError | TimeoutError):
            super().handle_error(request, client_address)


def _handler(board: Board, shell: Callable[[], str]) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        timeout = _PATIENCE

        def do_GET(self) -> None:
            """The page, or its events; nothing else, and to nobody who came by another name of this machine."""
            if not self._local():
                self.send_error(HTTPStatus.FORBIDDEN)
            elif self.path == "/":
                self._answer(shell().encode())
            elif self.path == "/events":
                self._events()
            elif self.path == "/favicon.ico":  # every browser asks for one
                self.send_response(HTTPStatus.NO_CONTENT)
                self.end_headers()
            else:
                self.send_error(HTTPStatus.NOT_FOUND)

        def _local(self) -> bool:
            port = self.server.server_address[1]  # type: ignore[index]
            return is_asked_locally(int(port), *(self.headers.get_all(name, []) for name in ("Host", "Origin")))

        def _answer(self, data: bytes) -> None:
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/html; charset=utf-8")
            self.send_header("Content-Length", str(len(data)))
            self.send_header("Cache-Control", "no-store")
            self.send_header("X-Content-Type-Options", "nosniff")
            self.send_header("Content-Security-Policy", "frame-ancestors 'none'")  # what the page itself cannot say
            self.end_headers()
            self.wfile.write(data)

        def _events(self) -> None:
            self.send_response(HTTPStatus.OK)
            self.send_header("Content-Type", "text/event-stream; charset=utf-8")
            self.send_header("Cache-Control", "no-store")
            self.end_headers()
            version = 0
            while not board.closed:
                found = board.news(version, _HEARTBEAT)
                if found is None:
                    self.wfile.write(b":\n\n")
                else:
                    version, said = found
                    data = json.dumps(said, ensure_ascii=False, separators=(",", ":"))
                    self.wfile.write(f"id: {version}\ndata: {data}\n\n".encode())
                self.wfile.flush()

        def log_message(self, *_: Any) -> None:
            """Requests are no news."""

    return Handler


_EVERY = 0.05
"""Between two looks at the file [s]."""
_GONE = 40
"""So many looks without a file, and it is told: an editor takes it away for a moment only."""
_FIRST_PICTURES = 60
"""A animation of so few pictures comes at once; the whole one follows the sheets."""


def run_watch(source: str, options: Options, *, port: int = 0, show: bool = False) -> int:
    """Serve the page of a design file until Ctrl-C ends it.

    Parameters
        port : int - 0 takes a free one
        show : bool - open the page in the browser
    """
    from gearlink.cli.views.page.sections import Remembered, watch_script, whole_page

    if source == "-":
        error = DesignFileError([Diagnostic("GL115", "watch needs a file, not standard input", "<command line>")])
        return show_refusal(error, source, options)
    board, path, sheets = Board(), Path(source), Remembered()
    missing = not source or _stamp(path) is None
    if missing or path.is_dir():
        folder = "this is a folder; watch shows one design file"
        wrong = Diagnostic("GL101", "no such file; watch needs an existing file" if missing else folder, source)
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
        parts = [build(loaded, kind, command, spec, options, designs=designs) for command in spec.pages()]
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
    from gearlink.cli.views.page import sections

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
        lambda: board.put("film", sections.film(parts[0][0], _FIRST_PICTURES, checks=parts[0][1].checks)),
        # Numbers take milliseconds, a sheet half a second.
        *(lambda i=i: board.put(f"{names[i]}-results", results(i)) for i in every),
        lambda: board.put("input", sections.given(text, spec)),
        *(lambda i=i: drawing(i, sheets.at_once) for i in every),
        *(lambda i=i: drawing(i, sheets.moved) for i in every if parts[i][1].command in known),
    ]
