"""Ctrl-C at any moment: status 130 and one line, nothing left behind; ignored where the parent ignores it.

No tolerances: exit statuses and words.
"""

from __future__ import annotations

import os
import random
import re
import signal
import subprocess
import sys
import time
import urllib.request
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli import process
from gearlink.cli.files import _without_name
from gearlink.cli.parallel.workers import calm

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix")
OWN = re.compile(re.escape(str(Path(process.__file__).parent)) + r"/(\S+)")
GEARLINK = str(Path(sys.executable).parent / "gearlink")

LOADING = """
import signal, sys, weakref

class Page:
    pass

class Hook:
    def find_spec(self, name, *_):
        if name == MODULE:
            if LOST:  # Python drops what is raised in the callback of a weak reference
                page = Page()
                kept = weakref.ref(page, lambda _: signal.raise_signal(signal.SIGINT))
                del page
            else:
                signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Hook())
sys.argv = ["gearlink", "crank", DESIGN]
from gearlink.__main__ import main
main()
"""
WRITING = """
import os, signal, sys
from pathlib import Path
from gearlink.cli.files import leave_nothing_behind, write_atomically

def fill(stream):
    stream.write(bytes(100_000))
    if sys.argv[2] == "KILL":
        os.kill(os.getpid(), signal.SIGKILL)
    assert len(list(Path(sys.argv[1]).parent.iterdir())) == 1
    signal.raise_signal(signal.SIGINT)

if sys.argv[2] == "INT" and hasattr(os, "O_TMPFILE"):
    del os.O_TMPFILE  # as on systems that have none: the file has its name from the beginning
leave_nothing_behind()
write_atomically(Path(sys.argv[1]), fill)
"""


def _heed() -> None:
    """A runner in the background hands an ignored SIGINT down to its children."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _ignore() -> None:
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def ended(code: str, *arguments: str) -> tuple[int, str, str]:
    line = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(line, capture_output=True, text=True, preexec_fn=_heed, check=False, timeout=60)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("module", "lost"), [("gearlink.cli.main", False), ("gearlink.cli.evaluate", True), ("pydantic", True)]
)
def test_while_libraries_load(designs: Path, module: str, lost: bool) -> None:
    values = {"MODULE": module, "LOST": lost, "DESIGN": str(designs / "ty460_slider_crank.yaml")}
    code = LOADING
    for name, value in values.items():
        code = code.replace(name, repr(value))
    assert ended(code) == (130, "", "interrupted\n")


def test_an_unfinished_file_is_removed(tmp_path: Path) -> None:
    assert ended(WRITING, str(tmp_path / "a.txt"), "INT") == (130, "", "interrupted\n")
    assert not list(tmp_path.iterdir())


def test_of_an_unfinished_file_nothing_is_left_by_a_kill(tmp_path: Path) -> None:
    if (made := _without_name(str(tmp_path))) is None:
        pytest.skip("this file system has no files without a name")
    os.close(made)
    assert ended(WRITING, str(tmp_path / "a.txt"), "KILL") == (-signal.SIGKILL, "", "")
    assert not list(tmp_path.iterdir())


@pytest.fixture
def handler() -> Iterator[Callable[[Any], None]]:
    """Set what SIGINT does in this process, until the test is over."""
    before = signal.getsignal(signal.SIGINT)
    yield lambda handler: signal.signal(signal.SIGINT, handler) and None
    signal.signal(signal.SIGINT, before)


def test_what_the_parent_ignores_stays_ignored(handler: Callable[[Any], None]) -> None:
    handler(signal.SIG_IGN)
    process.end_at_interrupt()
    with calm() as asked:
        signal.raise_signal(signal.SIGINT)
        assert not asked()
    assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN


def test_the_first_asks_and_the_second_does_what_it_did(handler: Callable[[Any], None]) -> None:
    heard: list[int] = []
    handler(lambda number, _: heard.append(number))
    with calm() as asked:
        assert not asked()
        signal.raise_signal(signal.SIGINT)
        assert (asked(), heard) == (True, [])
        signal.raise_signal(signal.SIGINT)
        assert heard == [signal.SIGINT]
    signal.raise_signal(signal.SIGINT)
    assert len(heard) == 2


@pytest.mark.slow
@pytest.mark.parametrize("ignored", [True, False])
def test_watch_in_the_background_of_a_script(tmp_path: Path, ignored: bool) -> None:
    """Which starts it with SIGINT ignored; else it ends."""
    path = tmp_path / "crank.yaml"
    path.write_text("kind: slider-crank\nstroke: 310\nrod: 520\n")
    begin = _ignore if ignored else _heed
    line = [sys.executable, "-m", "gearlink", "watch", str(path)]
    with subprocess.Popen(line, stderr=subprocess.PIPE, text=True, preexec_fn=begin) as watch:
        assert watch.stderr is not None
        address = watch.stderr.readline().split(": ")[1].split()[0]
        watch.send_signal(signal.SIGINT)
        if ignored:
            with urllib.request.urlopen(address, timeout=10) as answer:
                assert answer.status == 200
            assert watch.poll() is None
            watch.terminate()
        status = watch.wait(20)
        said = watch.stderr.read().splitlines()
    assert status == (-signal.SIGTERM if ignored else 130)
    assert ignored or said[-1] == "interrupted"


@pytest.mark.slow
@pytest.mark.parametrize("line", ["explore studies/dwell_feed.yaml -q", "report ty460.yaml --out OUT", "batch . -q"])
def test_at_forty_moments_of_the_first_second(designs: Path, tmp_path: Path, line: str) -> None:
    """A process that is still in the start of Python itself, or in the lines that set what Ctrl-C does, may end by
    Python's own words."""
    moments = random.Random(20_000)
    words = line.replace("OUT", str(tmp_path)).split()
    for _ in range(40):
        with subprocess.Popen(
            [GEARLINK, *words],
            cwd=designs,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=_heed,
        ) as running:
            time.sleep(moments.uniform(0.02, 1.0))
            running.send_signal(signal.SIGINT)
            _, said = running.communicate(timeout=60)
        if running.returncode == 130:
            assert len(said.splitlines()) == 1, said
            assert said.startswith("interrupted")
        elif running.returncode == 0:  # it had ended
            assert said in ("", f"wrote {tmp_path / 'TY-460.html'}\n")
        elif running.returncode != 1 or said:
            assert running.returncode in (1, -signal.SIGINT), said
            assert not [frame for frame in OWN.findall(said) if not frame.startswith(("door/", "process.py"))], said
    assert not list(tmp_path.glob(".*"))
