"""The board and the server of `watch`: pieces since a version, the loopback address alone, an end."""

from __future__ import annotations

import base64
import hashlib
import json
import re
import socket
import struct
import threading
import time
import urllib.error
import urllib.parse
import urllib.request
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from factory import design
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from gearlink.cli.commands import watch
from gearlink.cli.commands.watch import Board, _make, run_watch, served
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Options
from gearlink.cli.views.figures import write
from gearlink.cli.views.page.sections import Remembered, charts, sheet, whole_page


def test_news_are_what_has_changed() -> None:
    board = Board()
    assert board.news(0, 0.01) is None
    board.begin("a", ["one", "two"])
    board.put("one", "1")
    version, said = board.news(0, 1.0) or (0, {})
    assert (said["order"], said["pieces"], said["problem"]) == (["one", "two"], {"one": "1"}, "")
    board.put("two", "2")
    assert (board.news(version, 1.0) or (0, {}))[1]["pieces"] == {"two": "2"}
    board.fail("wrong")
    version, said = board.news(version, 1.0) or (0, {})
    assert (said["problem"], said["stale"]) == ("wrong", ["one", "two"])
    board.begin("b", ["two"])
    version, said = board.news(version, 1.0) or (0, {})
    assert (said["title"], said["problem"], said["stale"]) == ("b", "", ["two"])


def test_a_close_ends_those_who_wait() -> None:
    board, ended = Board(), threading.Event()
    waiting = threading.Thread(target=lambda: (board.news(0, 30.0), ended.set()))
    waiting.start()
    board.close()
    assert ended.wait(5.0)


def test_page_and_events_for_this_machine_alone() -> None:
    board = Board()
    board.begin("a", ["one"])
    board.put("one", "<p>é</p>")
    with served(board, lambda: "shell", 0) as address:
        assert address.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(address, timeout=5) as answer:
            assert answer.read() == b"shell"
        with urllib.request.urlopen(address + "events", timeout=5) as answer:
            assert answer.readline().startswith(b"id: ")
            assert json.loads(answer.readline().removeprefix(b"data: "))["pieces"] == {"one": "<p>é</p>"}
        for path, host, status in (("other", None, 404), ("", "evil.example", 403), ("events", "evil.example:80", 403)):
            request = urllib.request.Request(address + path, headers={"Host": host} if host else {})
            with pytest.raises(urllib.error.HTTPError) as refused:
                urllib.request.urlopen(request, timeout=5)
            assert refused.value.code == status
            refused.value.close()
        port = int(address.rsplit(":", 1)[1].strip("/"))
        with pytest.raises(CannotWrite, match="another --port"), served(Board(), lambda: "", port):
            pass
    with pytest.raises(OSError, match=r".+"):
        urllib.request.urlopen(address, timeout=1)


def _status(address: str, path: str, *lines: str) -> int:
    """Of the answer to a request whose lines are these alone, each with PORT in it replaced."""
    place = urllib.parse.urlsplit(address)
    with socket.create_connection((place.hostname, place.port), timeout=5) as reader:
        asked = "\r\n".join([f"GET {path} HTTP/1.1", *lines, "", ""]).replace("PORT", str(place.port))
        reader.sendall(asked.encode())
        return int(reader.makefile("rb").readline().split()[1])


@pytest.mark.parametrize(
    ("lines", "status"),
    [
        (["Host: 127.0.0.1:PORT"], 200),
        (["Host: LOCALHOST:PORT"], 200),
        (["Host: [::1]:PORT"], 200),
        (["Host: localhost:PORT", "Origin: http://localhost:PORT"], 200),
        ([], 403),
        (["Host: 127.0.0.1"], 403),  # another port, then
        (["Host: localhost.evil.example:PORT"], 403),
        (["Host: 127.0.0.1:PORT", "Host: evil.example"], 403),
        (["Host: localhost:PORT", "Origin: http://evil.example"], 403),
        (["Host: localhost:PORT", "Origin: null"], 403),
        (["Host: localhost:PORT", "Origin: http://localhost:1"], 403),
    ],
)
def test_names_of_this_machine(lines: list[str], status: int) -> None:
    """A name that was made to mean this machine, and a page of elsewhere, are refused: page and events."""
    board = Board()
    board.begin("a", [])
    with served(board, lambda: "shell", 0) as address:
        assert {_status(address, path, *lines) for path in ("/", "/events")} == {status}


def test_so_many_readers_and_no_more(monkeypatch: pytest.MonkeyPatch) -> None:
    """Those who ask for nothing are let go after a while, and their places are free again."""
    monkeypatch.setattr(watch, "_MOST_READERS", 3)
    monkeypatch.setattr(watch, "_PATIENCE", 0.3)
    with served(Board(), lambda: "shell", 0) as address, ExitStack() as block:
        place = urllib.parse.urlsplit(address)
        for _ in range(3):
            block.enter_context(socket.create_connection((place.hostname, place.port)))
        began = threading.active_count()
        while (status := _status(address, "/", "Host: localhost:PORT")) == 200:  # until those three have a thread each
            time.sleep(0.01)
        assert status == 503
        assert threading.active_count() <= began + 3
        latest = time.monotonic() + 20.0
        while (status := _status(address, "/", "Host: localhost:PORT")) == 503 and time.monotonic() < latest:
            time.sleep(0.05)
        assert status == 200


def test_a_page_runs_its_own_script_alone() -> None:
    """A browser takes the hash of what stands between the tags; what a name smuggled in would have none."""
    page = whole_page("a", ["<p>b</p>"], "more();")
    (script,) = re.findall(r"<script>(.*?)</script>", page, re.DOTALL)
    assert script.endswith("more();")
    own = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    (policy,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', page)
    assert f"script-src 'sha256-{own}';" in policy
    assert policy.startswith("default-src 'none';")
    assert "script-src 'unsafe" not in policy


def _pieces(board: Board) -> dict[str, Any]:
    found = board.news(0, 0.1)
    assert found is not None
    return found[1]


@pytest.mark.parametrize("begun", [b"GET / HT", b"POST / HTTP/1.1\r\n\r\n" * 1000])
def test_a_reader_who_goes_away_is_no_error(capfd: pytest.CaptureFixture[str], begun: bytes) -> None:
    at_once = struct.pack("ii", 1, 0)  # a reset, instead of an end
    with served(Board(), lambda: "shell", 0) as address:
        place = urllib.parse.urlsplit(address)
        for _ in range(5):
            with socket.create_connection((place.hostname, place.port)) as reader:
                reader.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, at_once)
                reader.sendall(begun)
        latest = time.monotonic() + 10.0
        while any("process_request" in thread.name for thread in threading.enumerate()) and time.monotonic() < latest:
            time.sleep(0.01)
        assert urllib.request.urlopen(address).read() == b"shell"
    assert capfd.readouterr().err == ""


def test_a_file_becomes_pieces_and_a_wrong_one_a_caret(tmp_path: Path) -> None:
    path, board = tmp_path / "crank.yaml", Board()
    path.write_text("kind: slider-crank\nstroke: 310\nrod: 520\n")
    assert _make(str(path), Options(), board, Remembered(), lambda: True) == "crank: pass"
    said = _pieces(board)
    assert said["order"] == ["head", "film", "piece-0-sheet", "piece-0-results", "input"]
    # The page places each by `order`; they come as they are made, pictures, which take longest, at the end.
    assert list(said["pieces"]) == ["head", "film", "piece-0-results", "input", "piece-0-sheet"]
    assert "<svg" in said["pieces"]["piece-0-sheet"]
    path.write_text("kind: slider-crank\nstroke: 310\nrot: 520\n")
    assert "GL105" in _make(str(path), Options(), board, Remembered(), lambda: True)
    said = _pieces(board)
    assert "  rot: 520\n  ^" in said["problem"]
    assert said["stale"] == ["head", "film", "piece-0-results", "input", "piece-0-sheet"]  # all, as they came


CRANK = {"kind": "slider-crank", "name": "crank", "stroke": 310, "rod": 520}


@pytest.fixture
def one_panel(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sheets of one panel, whose numbers beside it take more room where the rod is long."""

    def panels(command: str, made: Any) -> Figure:
        figure = Figure(figsize=(3, 2), layout="constrained")
        axes = figure.add_subplot(xlabel="crank angle [deg]", ylabel="rod [mm]")
        axes.plot(range(30), [made.spec.rod * 1.001**i for i in range(30)])
        return figure

    monkeypatch.setattr("gearlink.cli.views.figures.write.panels", panels)


@pytest.mark.usefixtures("one_panel")
def test_a_sheet_is_drawn_where_its_panels_were(monkeypatch: pytest.MonkeyPatch) -> None:
    """Both end with the bytes of a report."""
    sheets = Remembered()
    first, like = (design(CRANK, rod=rod) for rod in (520, 521))
    assert sheets.at_once("crank", first, ()) == sheet("crank", first)
    with monkeypatch.context() as patch:
        patch.setattr(ConstrainedLayoutEngine, "execute", None)  # whoever placed panels would fail
        drawn = sheets.at_once("crank", like, ())
    assert sheets.moved("crank", like, ()) == ""
    assert drawn == sheet("crank", like)


@pytest.mark.slow
@pytest.mark.usefixtures("one_panel")
def test_a_sheet_is_drawn_again_where_its_panels_moved() -> None:
    """Only what moves the panels is drawn twice."""
    sheets, wide = Remembered(), design(CRANK, rod=52000)
    sheets.at_once("crank", design(CRANK), ())
    whole = sheet("crank", wide)
    assert sheets.at_once("crank", wide, ()) != whole
    assert sheets.moved("crank", wide, ()) == whole
    assert sheets.moved("crank", wide, ()) == "", "they stand where they were placed last"


@pytest.mark.slow
def test_words_of_a_title_do_not_move_panels(monkeypatch: pytest.MonkeyPatch) -> None:
    """The title of a wide swing names its angle: another angle must not cost another layout."""
    sheets = Remembered()
    sheets.at_once("swing", design("wide_swing_twin_cam"), ())
    like = design("wide_swing_twin_cam", swing=118)
    with monkeypatch.context() as forbidden:
        forbidden.setattr(ConstrainedLayoutEngine, "execute", None)  # whoever placed panels would fail
        drawn = sheets.at_once("swing", like, ())
    assert "118° swing" in drawn


def test_a_newer_file_ends_the_making_of_an_older_page(tmp_path: Path) -> None:
    path, board = tmp_path / "crank.yaml", Board()
    path.write_text("kind: slider-crank\nstroke: 310\nrod: 520\n")
    assert _make(str(path), Options(), board, Remembered(), lambda: False) == ""
    assert board.news(0, 0.01) is None


@pytest.mark.parametrize(("source", "words"), [("-", "not standard input"), ("none.yaml", "no such file")])
def test_watch_wants_a_file(source: str, words: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_watch(source, Options()) == 2
    assert words in capsys.readouterr().err


def test_rows_that_are_drawn_to_no_scale_give_a_cursor_no_values() -> None:
    """The rows of a machine's timing chart: 2.86 stood there where the suckers are at 12 mm."""
    (chart,) = charts(write.draw("analyze", design("sheet_feeder")))
    assert (chart["over"], chart["curves"]) == ("machine angle [deg]", [])
    assert all(each["curves"] for each in charts(write.draw("cam", design("lift_cam"))))
