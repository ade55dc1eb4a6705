"""A headless browser for tests: Chromium by its WebDriver, spoken to over plain HTTP."""

from __future__ import annotations

import base64
import json
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

MISSING = "no chromium and chromedriver on this machine (Debian: apt-get install chromium chromium-driver)"
_FLAGS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
    # nothing of its own over the network, which may be closed
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-quic",
    "--disable-sync",
    "--no-first-run",
)
_SECONDS_TO_START, _SECONDS_TO_ANSWER = 60.0, 60.0
_ELEMENT = "element-6066-11e4-a52e-4f735466cecf"
KEYS = {"ArrowLeft": "\ue012", "ArrowRight": "\ue014", "Home": "\ue011", "End": "\ue010", "Space": " "}


class NoBrowser(Exception):
    """The browser of this machine does not start: nothing that a page could be blamed for."""


def installed() -> bool:
    """Whether there is a browser with its driver."""
    return bool(shutil.which("chromedriver") and (shutil.which("chromium") or shutil.which("google-chrome")))


@dataclass
class Browser:
    """One session; `problems` are errors that the pages put on their console."""

    session: str

    def _ask(self, method: str, path: str, **data: Any) -> Any:
        body = json.dumps(data).encode() if method == "POST" else None
        request = urllib.request.Request(self.session + path, body, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=_SECONDS_TO_ANSWER) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            raise AssertionError(json.load(error)["value"]["message"]) from error

    def open(self, address: str | Path) -> None:
        """Go to a page."""
        self._ask("POST", "/url", url=address.as_uri() if isinstance(address, Path) else address)

    def run(self, script: str, *arguments: Any) -> Any:
        """What a script returns."""
        return self._ask("POST", "/execute/sync", script=script, args=list(arguments))

    def size(self, width: int, height: int) -> None:
        """Show pages on a screen of so many CSS pixels."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self._ask("POST", "/goog/cdp/execute", cmd="Emulation.setDeviceMetricsOverride", params=metrics)

    def media(self, name: str) -> None:
        """Show pages as on "print"; "" is the screen again."""
        self._ask("POST", "/goog/cdp/execute", cmd="Emulation.setEmulatedMedia", params={"media": name})

    def press(self, *keys: str) -> None:
        """Keys, one after the other, to whatever has the focus."""
        strokes = [{"type": way, "value": KEYS.get(key, key)} for key in keys for way in ("keyDown", "keyUp")]
        self._ask("POST", "/actions", actions=[{"type": "key", "id": "keyboard", "actions": strokes}])

    def point(self, x: float, y: float) -> None:
        """Move the mouse to a place of the window."""
        self._mouse({"type": "pointerMove", "duration": 0, "x": round(x), "y": round(y), "origin": "viewport"})

    def drag(self, start: tuple[float, float], *places: tuple[float, float]) -> None:
        """Press the mouse at one place of the window and move it, held, over others; `release` lets it go."""
        self.point(*start)
        self._mouse({"type": "pointerDown", "button": 0})
        for place in places:
            time.sleep(0.2)
            self.point(*place)

    def release(self) -> None:
        """Let the mouse go."""
        self._mouse({"type": "pointerUp", "button": 0})

    def _mouse(self, *actions: dict[str, Any]) -> None:
        mouse = {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": [*actions]}
        self._ask("POST", "/actions", actions=[mouse])

    def wait(self, script: str, seconds: float = 60.0) -> float:
        """Until a script gives something true; how long that took [s]. Nothing is said of speed: so long as a machine
        with many tests may take."""
        start = time.monotonic()
        while not self.run(script):
            assert time.monotonic() - start < seconds, f"not within {seconds} s: {script}"
            time.sleep(0.02)
        return time.monotonic() - start

    def picture(self, path: Path) -> None:
        """A PNG of the window."""
        path.write_bytes(base64.b64decode(self._ask("GET", "/screenshot")))

    def problems(self) -> list[str]:
        """Errors on the console since the last call."""
        return [
            entry["message"] for entry in self._ask("POST", "/se/log", type="browser") if entry["level"] == "SEVERE"
        ]


@contextmanager
def browser() -> Iterator[Browser]:
    """A browser of its own, ended with the block."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    with tempfile.TemporaryDirectory() as home:
        driver = subprocess.Popen(
            ["chromedriver", f"--port={port}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        try:
            yield Browser(_session(port, home))
        finally:
            with_session = f"http://127.0.0.1:{port}/shutdown"
            try:
                urllib.request.urlopen(with_session, timeout=5).read()
                driver.wait(5)
            except (OSError, subprocess.TimeoutExpired):
                driver.kill()
                driver.wait()


def _session(port: int, home: str) -> str:
    options = {"args": [*_FLAGS, f"--user-data-dir={home}/profile"], "binary": shutil.which("chromium") or ""}
    wanted = {"browserName": "chrome", "goog:chromeOptions": options, "goog:loggingPrefs": {"browser": "ALL"}}
    body = json.dumps({"capabilities": {"alwaysMatch": wanted}}).encode()
    request = urllib.request.Request(f"http://127.0.0.1:{port}/session", body, {"Content-Type": "application/json"})
    begun = time.monotonic()
    while (left := _SECONDS_TO_START - (time.monotonic() - begun)) > 0.0:
        try:
            with urllib.request.urlopen(request, timeout=left) as answer:
                return f"http://127.0.0.1:{port}/session/{json.load(answer)['value']['sessionId']}"
        except urllib.error.HTTPError as error:
            raise AssertionError(json.load(error)["value"]["message"]) from error
        except OSError:
            time.sleep(0.05)
    raise NoBrowser(f"chromium and chromedriver did not start within {_SECONDS_TO_START:g} s")
