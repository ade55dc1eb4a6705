"""`gearlink studio`: a design under the hand, on a page of this machine: every number a slider, all results live."""

from __future__ import annotations

import secrets
import socket
import sys
from concurrent.futures import Executor
from http.cookies import SimpleCookie
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs

from gearlink.cli.commands.watch import LOOPBACK, is_asked_locally, own_names
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Options
from gearlink.cli.parallel.workers import workers
from gearlink.cli.printable import visible
from gearlink.cli.quiet import without_notes
from gearlink.cli.reading.design_file import parse, read_kind
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_refusal
from gearlink.core.base.kinds import FILES, KINDS

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from gearlink.cli.studio.text import Document

    Scope = dict[str, Any]
    App = Callable[[Scope, Any, Any], Awaitable[None]]

INSTALL = "pip install 'nicegui>=3.18'"


def run_studio(source: str, options: Options, *, port: int = 0, show: bool = False) -> int:
    """Serve the page of a design file until Ctrl-C ends it; the file is written by its button Save alone.

    Parameters
        port : int - 0 takes a free one
        show : bool - open the page in the browser
    """
    try:
        document = _opened(source)
        listening = _listening(port)
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, source, options)
    with listening, workers(2) as beside:
        beside.submit(_ready).result()  # forked before there are other threads
        _serve(source, document, beside, listening, show=show)
    return ExitCode.OK


def _ready() -> None:
    """What the process beside the page needs in any case."""
    with without_notes("matplotlib"):
        import matplotlib.backends.backend_svg  # noqa: F401


def _opened(source: str) -> Document:
    """The file, which may have errors: they are shown where it is edited.

    Raises
        DesignFileError - where there is nothing to edit, or NiceGUI is missing
    """
    if find_spec("nicegui") is None:
        message = f"studio needs the package nicegui: {INSTALL}"
        raise DesignFileError([Diagnostic("GL115", message, "<command line>")])
    if source == "-":
        raise DesignFileError([Diagnostic("GL115", "studio needs a file, not standard input", "<command line>")])
    if not source or not Path(source).exists():
        raise DesignFileError([Diagnostic("GL101", "no such file; studio needs an existing file", source)])
    if Path(source).is_dir():
        raise DesignFileError([Diagnostic("GL101", "this is a folder; studio shows one design file", source)])
    from gearlink.cli.studio.text import Document

    document = Document(Path(source))
    _refuse_study(document.text, source)
    return document


def _refuse_study(text: str, source: str) -> None:
    try:
        loaded = parse(text.encode(), source)
        kind = read_kind(loaded, tuple(FILES))
    except DesignFileError:
        return
    if kind not in KINDS:
        message = f"a {kind} searches many designs and has no values of its own: open a design that it found"
        raise DesignFileError([loaded.report("GL113", message, ("kind",))])


def _listening(port: int) -> socket.socket:
    try:
        made = socket.create_server((LOOPBACK, port))
    except OSError as error:
        raise CannotWrite(
            f"cannot serve on {LOOPBACK}:{port}: {error.strerror or error}\ngive another --port"
        ) from error
    return made


def _serve(source: str, document: Document, beside: Executor, listening: socket.socket, *, show: bool) -> None:
    import fastapi
    import uvicorn
    from nicegui import app, background_tasks, ui

    from gearlink.cli.studio.page import StudioPage
    from gearlink.cli.studio.session import Session

    session = Session(document, beside)
    port, token = listening.getsockname()[1], secrets.token_urlsafe(24)
    address = f"http://{LOOPBACK}:{port}/?token={token}"

    @ui.page("/")
    def page() -> None:
        StudioPage(session)

    @app.on_startup
    def begin() -> None:
        background_tasks.create(session.run())
        print(f"{visible(source)}: {address} (Ctrl-C ends)", file=sys.stderr, flush=True)
        if show:
            import webbrowser

            webbrowser.open(address)

    outer = fastapi.FastAPI(openapi_url=None, docs_url=None, redoc_url=None)
    ui.run_with(outer, title=document.path.name, tailwind=False, show_welcome_message=False, reconnect_timeout=60.0)
    guarded = Guard(outer, port, token)
    config = uvicorn.Config(
        guarded, log_level="error", access_log=False, lifespan="on", timeout_graceful_shutdown=1, server_header=False
    )
    uvicorn.Server(config).run(sockets=[listening])


class Guard:
    """What stands before the page: it answers by a name of the loopback address alone, to no other page, and to nobody
    who does not know the token. The address of the page has it; a cookie keeps it for what the page asks for.

    Parameters
        app : what is guarded
        port, token : of the address
    """

    def __init__(self, app: App, port: int, token: str) -> None:
        self._app, self._port, self._token = app, port, token
        self._cookie = f"gearlink-studio-{port}"

    async def __call__(self, scope: Scope, receive: Any, send: Any) -> None:
        """Let a request pass, or refuse it with 403."""
        if scope["type"] == "lifespan":
            await self._app(scope, receive, send)
        elif not self._local(scope) or not self._known(scope):
            await self._refuse(scope, receive, send)
        else:
            await self._app(scope, receive, lambda message: send(self._with_headers(message)))

    def _local(self, scope: Scope) -> bool:
        return is_asked_locally(self._port, *(_headers(scope, name) for name in (b"host", b"origin")))

    def _known(self, scope: Scope) -> bool:
        given = parse_qs(scope.get("query_string", b"").decode("latin-1")).get("token", [])
        for header in _headers(scope, b"cookie"):
            jar: SimpleCookie = SimpleCookie()
            jar.load(header)
            given += [jar[self._cookie].value] if self._cookie in jar else []
        return any(secrets.compare_digest(each.encode(), self._token.encode()) for each in given)

    def _with_headers(self, message: dict[str, Any]) -> dict[str, Any]:
        if message["type"] != "http.response.start":
            return message
        # An address in brackets is no source of a policy, and none that is listened to.
        sockets = " ".join(f"ws://{name}" for name in sorted(own_names(self._port)) if "[" not in name)
        policy = (
            f"default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:; connect-src 'self' {sockets}; "
            "frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
        )
        more = {
            "set-cookie": f"{self._cookie}={self._token}; Path=/; HttpOnly; SameSite=Strict",
            "content-security-policy": policy,
            "x-content-type-options": "nosniff",
            "referrer-policy": "no-referrer",
        }
        headers = [*message.get("headers", ()), *((key.encode(), value.encode()) for key, value in more.items())]
        return {**message, "headers": headers}

    async def _refuse(self, scope: Scope, receive: Any, send: Any) -> None:
        if scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 1008})
            return
        await send({"type": "http.response.start", "status": 403, "headers": [(b"content-type", b"text/plain")]})
        await send(
            {"type": "http.response.body", "body": b"the address with its token stands where studio was started"}
        )


def _headers(scope: Scope, name: bytes) -> list[str]:
    return [value.decode("latin-1") for key, value in scope.get("headers", ()) if key == name]
