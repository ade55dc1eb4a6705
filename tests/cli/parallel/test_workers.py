"""Workers end with their parent, whatever ends it, and leave no unfinished file."""

from __future__ import annotations

import gc
import itertools
import os
import signal
import subprocess
import sys
import threading
import time
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from types import SimpleNamespace

import pytest
from sweeps import ALL, mostly_slow

from gearlink.cli import process
from gearlink.cli.parallel import shares
from gearlink.cli.parallel.shares import Watch
from gearlink.cli.parallel.workers import _close_by_one, _end, workers

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="forked processes, /proc")

# Two workers hold a half-written file each when the parent says that it is ready.
PARENT = """
import sys, time
from pathlib import Path
from gearlink.cli.files import leave_nothing_behind, write_atomically
from gearlink.cli.parallel.workers import workers

def hold(stream):
    stream.write(b"half")
    stream.flush()
    (folder / f"begun{time.monotonic_ns()}").touch()
    time.sleep(60.0)

folder = Path(sys.argv[1])
leave_nothing_behind()
with workers(2) as pool:
    for name in "ab":
        pool.submit(write_atomically, folder / name, hold)
    while len(list(folder.glob("begun*"))) < 2:
        time.sleep(0.01)
    print("ready", flush=True)
    for _ in range(600):  # a signal that comes just before Python sleeps is heard when it wakes
        time.sleep(0.1)
"""


def _heed() -> None:
    """A runner in the background, or under nohup, hands ignored signals down to its children."""
    for name in ("SIGHUP", "SIGINT", "SIGQUIT"):
        signal.signal(getattr(signal, name), signal.SIG_DFL)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name", mostly_slow(["SIGTERM", "SIGKILL", "SIGHUP", "SIGQUIT", "SIGUSR1", "SIGABRT", "SIGPROF"], 2)
)
def test_workers_end_with_their_parent(tmp_path: Path, name: str) -> None:
    """The reader of their common output gets its end, which it does not while any of them lives."""
    command = [sys.executable, "-c", PARENT, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=_heed) as parent:
        assert parent.stdout is not None
        assert parent.stderr is not None
        assert parent.stdout.readline() == b"ready\n"
        parent.send_signal(getattr(signal, name))
        sent = time.monotonic()
        assert (parent.stdout.read(), parent.stderr.read()) == (b"", b"")
        assert time.monotonic() - sent < 10.0
    assert parent.returncode == -getattr(signal, name)
    assert {path.name[:5] for path in tmp_path.iterdir()} == {"begun"}


def test_what_the_caller_of_the_process_ignores_stays_ignored(tmp_path: Path) -> None:
    script = "import os, signal\nfrom gearlink.cli.files import leave_nothing_behind\nleave_nothing_behind()\n"
    script += "os.kill(os.getpid(), signal.SIGHUP)\nprint('still here')"
    ended = subprocess.run(["nohup", sys.executable, "-c", script], capture_output=True, cwd=tmp_path, check=True)
    assert ended.stdout == b"still here\n"


def _leave_in_the_middle() -> None:
    with workers(2) as pool:
        for _ in range(8):
            pool.submit(time.sleep, 30.0)
        raise ValueError("enough")


def test_an_exception_in_the_block_ends_them_at_once() -> None:
    begun = time.monotonic()
    with pytest.raises(ValueError, match="enough"):
        _leave_in_the_middle()
    assert time.monotonic() - begun < 10.0


@pytest.mark.parametrize(("heeds", "asked", "forced"), [(1, 1, 0), (3, 3, 0), (9, 3, 1)])
def test_one_that_loses_a_signal_is_asked_again(
    monkeypatch: pytest.MonkeyPatch, heeds: int, asked: int, forced: int
) -> None:
    """Python forgets a signal to a process that has just been forked; who would wait for it waits for ever."""
    clock = SimpleNamespace(monotonic=itertools.count(0.0, 0.3).__next__)  # seconds go by in a moment
    monkeypatch.setattr("gearlink.cli.parallel.workers.time", clock)
    monkeypatch.setattr("gearlink.cli.parallel.workers._AGAIN_SECONDS", 0.0)
    deaf = _Deaf(heeds)
    _end([deaf])  # type: ignore[list-item]
    assert (deaf.asked, deaf.forced) == (asked, forced)


class _Deaf:
    """A process that heeds the signal of that number alone; its sentinel is the end of a pipe."""

    def __init__(self, heeds: int) -> None:
        self.heeds, self.asked, self.forced = heeds, 0, 0
        self.sentinel, self._held = os.pipe()

    def terminate(self) -> None:
        self.asked += 1
        if self.asked == self.heeds:
            os.close(self._held)

    def kill(self) -> None:
        self.forced += 1


# A pipe holds 64 kB: while the thread that reads results is busy with the first, the worker stands in the middle of the
# second, a megabyte, and is ended there.
HALF = """
import sys, threading, time
from pathlib import Path
from gearlink.cli.parallel.workers import workers

class Late:
    def __reduce__(self):
        return wait, ()

def wait():
    reads_on.wait(30.0)

def late():
    time.sleep(0.1)  # until the other call is handed on, which the reading thread does too
    return Late()

def large():
    begun.touch()
    return bytes(1 << 20)

begun, reads_on = Path(sys.argv[1]), threading.Event()
with workers(1) as pool:
    pool.submit(late)
    pool.submit(large)
    while not begun.exists():
        time.sleep(0.01)
    time.sleep(0.2)
    threading.Timer(0.2, reads_on.set).start()
    sys.exit("left")
"""


@pytest.mark.slow
def test_half_a_result_is_not_waited_for(tmp_path: Path) -> None:
    command = [sys.executable, "-c", HALF, str(tmp_path / "begun")]
    ended = subprocess.run(command, capture_output=True, timeout=60, check=False)
    assert (ended.returncode, ended.stderr) == (1, b"left\n")


# Two workers are at work at once: the first result keeps the reading thread busy, the second is killed in the middle of
# its own. Other calls wait.
KILLED = """
import os, signal, sys, threading, time
from concurrent.futures import BrokenExecutor
from pathlib import Path
from gearlink.cli.parallel.workers import workers

class Late:
    def __reduce__(self):
        return wait, ()

def wait():
    reads_on.wait(30.0)

def late():
    time.sleep(0.1)
    return Late()

def large():
    time.sleep(0.3)
    begun.write_text(str(os.getpid()))
    return bytes(1 << 20)

begun, reads_on = Path(sys.argv[1]), threading.Event()
with workers(2) as pool:
    given = [pool.submit(call) for call in (late, large, *(4 * [late]))]
    while not (begun.exists() and begun.read_text()):
        time.sleep(0.01)
    time.sleep(0.1)
    os.kill(int(begun.read_text()), signal.SIGKILL)
    threading.Timer(0.1, reads_on.set).start()
    print(*(isinstance(given[i].exception(), BrokenExecutor) for i in (0, 1, -1)))
"""


@pytest.mark.slow
def test_one_that_is_killed_while_it_writes_its_result_breaks_the_executor(tmp_path: Path) -> None:
    """The result before it was whole; its own and what had not begun are lost, and nothing waits for them."""
    command = [sys.executable, "-c", KILLED, str(tmp_path / "begun")]
    ended = subprocess.run(command, capture_output=True, timeout=60, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, b"False True True\n", b"")


def test_they_do_not_answer_an_interrupt() -> None:
    with workers(1) as pool:
        process = pool.submit(os.getpid).result()
        os.kill(process, signal.SIGINT)
        assert pool.submit(os.getpid).result() == process


def test_a_connection_is_closed_by_one_thread_alone() -> None:
    """Without the lock several threads close the same number of a descriptor, the later ones someone else's."""
    wrong: list[OSError] = []

    def close(start: threading.Barrier, connection: Connection) -> None:
        start.wait()
        try:
            connection.close()
        except OSError as error:
            wrong.append(error)

    for _ in range(40):
        reader, writer = Pipe(duplex=False)
        _close_by_one(writer)
        start = threading.Barrier(4)
        threads = [threading.Thread(target=close, args=(start, writer)) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        reader.close()
        assert writer.closed
    assert not wrong


def test_workers_collect_as_python_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command itself hardly ever collects; workers that did likewise grew by 1.9 MB with every chunk of a study."""
    pythons = (701, 11, 9)  # odd ones, which nothing else sets
    monkeypatch.setattr(process, "_pythons", pythons)
    with workers(1) as pool:
        assert pool.submit(gc.get_threshold).result() == pythons
    assert gc.get_threshold() != pythons


@pytest.mark.slow
def test_this_process_collects_as_python_does_while_it_computes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(process, "_pythons", (701, 11, 9))
    before = gc.get_threshold()
    watch = Watch(2, 1, lambda _: None, quiet=True)
    assert shares._in_processes(lambda _: gc.get_threshold(), [1, 2], 1, watch) == [(701, 11, 9)] * 2
    assert gc.get_threshold() == before


def test_no_thread_of_theirs_is_left_when_they_have_ended() -> None:
    """A process that is forked while one runs may wait for ever for a lock that it held."""
    before = set(threading.enumerate())
    for _ in range(5 if ALL else 1):
        with workers(2) as pool:
            assert pool.submit(abs, -1).result() == 1
        assert set(threading.enumerate()) == before
        with pytest.raises(ZeroDivisionError), workers(2) as pool:
            pool.submit(divmod, 1, 0).result()
        assert set(threading.enumerate()) == before
