"""What Windows and macOS have otherwise, as far as it can be simulated here: the CI runs all tests on them.

No signals of Unix, no fork, no files without a name, no module `resource`; texts in the code page of a console; a
default encoding that is not UTF-8; a pipe whose end is another error; a console that must be told of escape codes; few
processes to wait for; ports that two servers may have; files that another program holds.
"""

from __future__ import annotations

import ctypes
import errno
import os
import subprocess
import sys
from http.server import BaseHTTPRequestHandler
from pathlib import Path, PureWindowsPath
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock

import pytest

from gearlink.cli import files, printable, progress
from gearlink.cli import main as program
from gearlink.cli.batch import summary
from gearlink.cli.batch.summary import Outcome
from gearlink.cli.commands import watch
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.parallel import shares, workers
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.cli.views.films import raster

ROOT = Path(__file__).resolve().parents[2]
FEED = "designs/standing_feed.yaml"
_WITHOUT_UNIX = """
import os, signal, sys
for name in ("register_at_fork", "nice", "O_TMPFILE", "O_NOFOLLOW", "O_NONBLOCK", "sched_getaffinity", "fork"):
    if hasattr(os, name):
        delattr(os, name)
for name in dir(signal):
    if name.startswith("SIG") and name not in ("SIGABRT", "SIGINT", "SIGTERM", "SIGSEGV", "SIG_DFL", "SIG_IGN"):
        delattr(signal, name)
for name in ("resource", "fcntl", "termios", "grp"):
    sys.modules[name] = None
from types import SimpleNamespace
import gearlink.cli.commands.report as report
report.sys = SimpleNamespace(platform="win32", stderr=sys.stderr)
from gearlink.cli.main import main
main()
"""


def _process(*words: object, code: str = "", flags: tuple[str, ...] = (), **changed: str) -> Any:
    command = [sys.executable, *flags, *(("-c", code) if code else ("-m", "gearlink")), *map(str, words)]
    return subprocess.run(command, cwd=ROOT, capture_output=True, env=os.environ | changed, check=False, timeout=120)


@pytest.mark.parametrize(
    "words",
    [
        pytest.param(("synth", "dwell", FEED, "--plot", "--out", "{}"), marks=pytest.mark.slow),
        ("export", "designs/gear_pair.yaml", "--out", "{}"),
        pytest.param(("batch", "designs/ty460.yaml", FEED, "--out", "{}", "-j", "1"), marks=pytest.mark.slow),
        pytest.param(("report", FEED, "--out", "{}"), marks=pytest.mark.slow),
    ],
)
def test_commands_need_nothing_that_windows_lacks(words: tuple[str, ...], tmp_path: Path) -> None:
    ended = _process(*(word.format(tmp_path) for word in words), code=_WITHOUT_UNIX)
    assert (ended.returncode, b"Traceback" in ended.stderr) == (0, False), ended.stderr
    assert list(tmp_path.iterdir())


@pytest.mark.slow
def test_all_tests_are_collected_without_modules_of_unix() -> None:
    """A file that imports one at its top would end the run of the CI on Windows."""
    code = "import sys; sys.modules |= dict.fromkeys(('resource', 'fcntl', 'termios', 'pty', 'grp', 'pwd'))\n"
    code += (
        "import pytest; sys.exit(pytest.main(['-q', '-p', 'no:logging', '--collect-only', '-m', 'not slow', 'tests']))"
    )
    ended = _process(code=code)
    assert ended.returncode == 0, ended.stdout[-2000:]


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ("synth", "dwell", FEED, "--plot", "--out", "{}", "--save", "{}/full.yaml"),
        ("report", FEED, "--out", "{}"),
        ("batch", FEED, "--format", "junit", "--out", "{}"),
        ("export", FEED, "--out", "{}"),
        ("explain", "传动角"),
        ("new", "gear-pair", "--out", "{}/pair.yaml"),
        ("schema", "--write", "{}"),
        ("verify", "khurmi"),
        ("explore", "designs/studies/gear_pair.yaml", "--jobs", "1", "--store", "{}/s.sqlite"),
    ],
)
def test_no_file_is_read_or_written_in_the_encoding_of_the_system(words: tuple[str, ...], tmp_path: Path) -> None:
    """Of Windows that is an old code page, in which a degree sign is another byte."""
    flags = ("-X", "warn_default_encoding", "-W", "always::EncodingWarning")
    ended = _process(*(word.format(tmp_path) for word in words), flags=flags)
    assert ended.returncode in (0, 1), ended.stderr
    ours = tuple(str(ROOT / top) for top in ("core", "cli", "designs"))
    lines = ended.stderr.decode().splitlines()
    assert [line for line in lines if "EncodingWarning" in line and line.startswith(ours)] == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("encoding", "words"),
    [
        ("cp437", ("check", FEED, "--set", "gears.idler=36")),
        pytest.param("cp1252", ("synth", "dwell", FEED, "--all"), marks=pytest.mark.slow),
        pytest.param("cp932", ("explain", "dwell"), marks=pytest.mark.slow),
    ],
)
def test_a_console_of_another_code_page_gets_signs_that_it_has(encoding: str, words: tuple[str, ...]) -> None:
    ended = _process(*words, PYTHONIOENCODING=encoding, COLUMNS="80")
    assert ended.returncode in (0, 1)
    assert b"Traceback" not in ended.stderr
    assert (ended.stdout + ended.stderr).decode(encoding)


class _Kernel:
    """Handles and modes of a console of Windows, as `ctypes` reaches them."""

    def __init__(self) -> None:
        self.modes: dict[int, int] = {-11: 3}

    def GetStdHandle(self, number: int) -> int:
        return number

    def GetConsoleMode(self, handle: int, mode: Any) -> int:
        mode._obj.value = self.modes.get(handle, 0)
        return int(handle in self.modes)

    def SetConsoleMode(self, handle: int, mode: int) -> None:
        self.modes[handle] = mode


@pytest.mark.parametrize(("number", "modes"), [(1, {-11: 7}), (2, {-11: 3})])
def test_a_console_of_windows_keeps_its_own_stream_and_heeds_colours(
    number: int, modes: dict[int, int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """It writes UTF-16; bytes put past it would be shown in an old code page. What is no console has no mode."""
    kernel = _Kernel()
    monkeypatch.setattr(ctypes, "windll", SimpleNamespace(kernel32=kernel), raising=False)
    stream: Any = SimpleNamespace(isatty=lambda: True, fileno=lambda: number)
    monkeypatch.setattr(program, "sys", SimpleNamespace(platform="win32"))
    assert program._output(stream, BrokenPipeError) is stream
    assert kernel.modes == modes


@pytest.mark.parametrize(
    ("system", "word", "quoted"),
    [
        ("linux", "teeth[0]=17", "'teeth[0]=17'"),
        ("win32", "teeth[0]=17", "teeth[0]=17"),  # cmd.exe would pass single quotes on
        ("win32", "x=[0.2, -0.1]", '"x=[0.2, -0.1]"'),
        ("win32", "C:\\my designs\\feed.yaml", '"C:\\my designs\\feed.yaml"'),
    ],
)
def test_options_are_quoted_for_the_shell_at_hand(
    system: str, word: str, quoted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(printable, "sys", SimpleNamespace(platform=system))
    assert printable.for_shell(word) == quoted


def test_progress_on_a_console_of_windows_goes_through_its_stream(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []
    stream = SimpleNamespace(isatty=lambda: True, write=shown.append, flush=lambda: None, fileno=lambda: 1 / 0)
    monkeypatch.setattr(progress, "sys", SimpleNamespace(platform="win32", stderr=stream))
    progress._write("drawing Bogenzuführung")
    assert shown == ["drawing Bogenzuführung"]


def test_windows_waits_for_61_processes_at_most(monkeypatch: pytest.MonkeyPatch) -> None:
    """A larger pool is a ValueError there, on a machine with more processors too."""
    monkeypatch.setattr(workers, "sys", SimpleNamespace(platform="win32"))
    with workers.workers(96) as pool:
        assert pool._max_workers == 61  # type: ignore[attr-defined]


@pytest.mark.parametrize("number", [errno.EINVAL, errno.EPIPE])
def test_ffmpeg_that_has_ended_is_heard_on_windows_too(number: int) -> None:
    """A pipe that nobody reads answers EINVAL there; any other error ends ffmpeg and is shown."""
    pipe = SimpleNamespace(write=Mock(side_effect=OSError(number, "x")), close=Mock(side_effect=OSError(number, "x")))
    running: Any = SimpleNamespace(stdin=pipe, kill=Mock())
    pictures: Any = SimpleNamespace(picture=lambda _: SimpleNamespace(tobytes=lambda: b""))
    raster._feed(running, pictures, range(3))
    running.kill.assert_not_called()
    pipe.write.side_effect = OSError(errno.ENOSPC, "full")
    with pytest.raises(OSError, match="full"):
        raster._feed(running, pictures, range(3))
    running.kill.assert_called_once()


@pytest.mark.parametrize("system", ["win32", "linux"])
def test_watch_takes_no_port_of_another_server(system: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """With SO_REUSEADDR Windows would let it; elsewhere the option frees a port whose server has just ended."""
    monkeypatch.setattr(watch, "sys", SimpleNamespace(platform=system))
    with watch._Server(("127.0.0.1", 0), BaseHTTPRequestHandler) as server:
        assert server.allow_reuse_address is (system != "win32")


@pytest.mark.parametrize(("system", "hint"), [("win32", True), ("linux", False)])
def test_a_file_that_a_viewer_has_open(
    system: str, hint: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Windows moves nothing to its name."""
    (tmp_path / "feed.pdf").write_bytes(b"old")
    monkeypatch.setattr(files.os, "replace", Mock(side_effect=PermissionError(13, "Access is denied")))
    monkeypatch.setattr(files, "sys", SimpleNamespace(platform=system))
    with pytest.raises(files.CannotWrite, match="Access is denied") as refused:
        files.write_atomically(tmp_path / "feed.pdf", lambda stream: stream.write(b"new"))
    assert ("close the program that shows it" in str(refused.value)) is hint
    assert [path.name for path in tmp_path.iterdir()] == ["feed.pdf"]


@pytest.mark.parametrize(("system", "ends"), [("win32", True), ("linux", False)])
def test_a_pipe_without_reader_ends_no_command_on_windows(
    system: str, ends: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It answers EINVAL there, which elsewhere is a fault of the output: here a descriptor that takes no bytes."""
    read_only = os.open(os.devnull, os.O_RDONLY)
    raw = program._Output(read_only, "w", closefd=False)
    raw.ignored = BrokenPipeError
    monkeypatch.setattr(program, "sys", SimpleNamespace(platform=system))
    monkeypatch.setattr(program, "_NO_READER_OF_WINDOWS", 9)  # EBADF, what such a descriptor says
    monkeypatch.setattr(program.os, "dup2", lambda *_: None)
    try:
        if ends:
            assert raw.write(b"text") == 4
        else:
            with pytest.raises(OSError, match="cannot be written"):
                raw.write(b"text")
    finally:
        os.close(read_only)


@pytest.mark.slow
def test_workers_that_are_started_anew_give_the_same(gearlink: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """As on Windows and macOS, where nothing is forked."""
    monkeypatch.chdir(ROOT)
    arguments = ("explore", "designs/studies/gear_pair.yaml", "--format", "json")
    forked = gearlink(*arguments, "--jobs", "2")
    elsewhere = SimpleNamespace(platform="darwin", stderr=sys.stderr, modules=sys.modules)
    monkeypatch.setattr(workers, "sys", elsewhere)
    monkeypatch.setattr(shares, "sys", elsewhere)
    started = gearlink(*arguments, "--jobs", "2")
    assert (started.status, started.out) == (forked.status, forked.out), started.err


def test_annotations_of_windows_have_paths_of_the_repository(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(summary, "PurePath", PureWindowsPath)
    wrong = Diagnostic("GL116", "no number", file="designs\\feed.yaml")
    text = summary.as_github([Outcome("designs\\feed.yaml", "", "feed", "", ExitCode.WRONG_INPUT, errors=(wrong,))])
    assert text.startswith("::error file=designs/feed.yaml,line=1,")
