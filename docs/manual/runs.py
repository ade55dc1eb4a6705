"""Runs of the program for the manual: what a command prints, the picture that it draws; kept by what they depend on.

A result is kept under the digest of its command, beside the digest of the program and the designs that gave it, in
`build/manual/runs`. `make docs` computes what is not there or came from another program; a check of the pages
(`make site`) takes what is there.
"""

from __future__ import annotations

import contextlib
import hashlib
import io
import json
import multiprocessing
import os
import shlex
import shutil
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "build" / "manual" / "runs"
_DPI = "90"
_WITHOUT_DPI = ("animate", "chart", "explore", "report")


@dataclass(frozen=True, slots=True)
class Run:
    """What a command left.

    Fields
        command : str - as it was typed
        status : int - its exit status
        text : str - what it printed, on both streams
        picture : str - name of the picture in `KEPT`, empty without one
        seconds : float - wall time
        made_of : str - the program and the designs that gave it
    """

    command: str
    status: int
    text: str
    picture: str
    seconds: float
    made_of: str


@cache
def program() -> str:
    """Digest of everything that a result may depend on: the program and the designs."""
    found = hashlib.sha256()
    for folder in ("core", "cli", "designs"):
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in {".py", ".yaml", ".json", ".html", ".js", ".css"}:
                found.update(str(path.relative_to(ROOT)).encode() + path.read_bytes())
    return found.hexdigest()


def result(command: str, picture: bool = False) -> Run:
    """What is kept of a command; KeyError where it has not been run."""
    path = _path(command, picture)
    if not path.exists():
        raise KeyError(command)
    return Run(**json.loads(path.read_text(encoding="utf-8")))


def compute(wanted: Iterable[tuple[str, bool]], stale: bool = False) -> list[Run]:
    """Run what is not kept, in as many processes as there are processors, four at most.

    Parameters
        wanted : commands, each with whether its picture is wanted
        stale : bool - a result of another state of the program counts as kept
    Returns
        what was run now
    """
    KEPT.mkdir(parents=True, exist_ok=True)
    missing = [pair for pair in dict.fromkeys(wanted) if not _kept(*pair, stale)]
    if not missing:
        return []
    count = min(len(missing), os.cpu_count() or 1, 4)
    with ProcessPoolExecutor(count, mp_context=multiprocessing.get_context("spawn")) as pool:
        return list(pool.map(run, *zip(*missing, strict=True)))


def run(command: str, picture: bool = False) -> Run:
    """Run a command of gearlink in this process, keep and give what it left.

    Raises
        RuntimeError - for a fault of the program, and where a picture is wanted and none is written
    """
    words = shlex.split(command)
    if words[0] != "gearlink":
        raise RuntimeError(f"only gearlink is run: {command}")
    KEPT.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(ROOT), _plain():
        extra = ["--out", folder] if picture else []
        extra += ["--dpi", _DPI] if picture and words[1] not in _WITHOUT_DPI else []
        began = time.perf_counter()
        status, text = _printed([*words[1:], *extra])
        seconds = time.perf_counter() - began
        if status > 2:
            raise RuntimeError(f"{command} ended with {status}:\n{text}")
        kept = ""
        if picture:
            drawn = sorted(path for path in Path(folder).rglob("*") if path.suffix in {".png", ".svg", ".gif"})
            if not drawn:
                raise RuntimeError(f"{command} drew nothing:\n{text}")
            kept = _path(command, picture).with_suffix(drawn[0].suffix).name
            shutil.copyfile(drawn[0], KEPT / kept)
    ended = Run(command, status, text, kept, round(seconds, 2), program())
    _path(command, picture).write_text(json.dumps(asdict(ended)), encoding="utf-8")
    return ended


@contextlib.contextmanager
def _plain() -> Iterator[None]:
    """A terminal of 80 columns without colours, whatever that of the user is."""
    before, program_name = dict(os.environ), sys.argv[0]
    os.environ |= {"COLUMNS": "80", "OPENBLAS_NUM_THREADS": "1", "MPLBACKEND": "agg", "NO_COLOR": "1"}
    sys.argv[0] = "gearlink"  # which messages on the command line name
    try:
        yield
    finally:
        sys.argv[0] = program_name
        os.environ.clear()
        os.environ.update(before)


def _printed(words: list[str]) -> tuple[int, str]:
    from gearlink.cli.main import run as gearlink

    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        status = int(gearlink(words))
    lines = (out.getvalue() + err.getvalue()).rstrip().split("\n")
    return status, "\n".join(line.rstrip() for line in lines)


def _path(command: str, picture: bool) -> Path:
    return KEPT / (hashlib.sha256(f"{picture} {command}".encode()).hexdigest()[:20] + ".json")


def _kept(command: str, picture: bool, stale: bool) -> bool:
    try:
        found = result(command, picture)
    except KeyError:
        return False
    return (stale or found.made_of == program()) and (not found.picture or (KEPT / found.picture).exists())


def session(commands: tuple[str, ...], files: tuple[str, ...], stale: bool = False) -> list[Run]:
    """Commands that follow each other in one folder, such as those of a tutorial.

    Parameters
        files : the files they leave that are wanted; the `picture` of the last run names the first of them
    Returns
        a run for each command; files are kept as `session_file` names them
    """
    keys = [f"{i} {' && '.join(commands)}" for i in range(len(commands))]
    if all(_kept(key, False, stale) for key in keys):
        return [result(key) for key in keys]
    KEPT.mkdir(parents=True, exist_ok=True)
    found = []
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), _plain():
        for key, command in zip(keys, commands, strict=True):
            words = shlex.split(command, comments=True)
            began = time.perf_counter()
            status, text = _printed(words[1:])
            if words[0] != "gearlink" or status > 2:
                raise RuntimeError(f"{command} ended with {status}:\n{text}")
            text = text.replace(folder, "/home/name")
            found.append(Run(command, status, text, "", round(time.perf_counter() - began, 2), program()))
            _path(key, False).write_text(json.dumps(asdict(found[-1])), encoding="utf-8")
        for name in files:
            shutil.copyfile(name, KEPT / session_file(commands, name))
    return found


def session_file(commands: tuple[str, ...], name: str) -> str:
    """Name in `KEPT` of a file that a session left."""
    return hashlib.sha256(" && ".join(commands).encode()).hexdigest()[:12] + "-" + Path(name).name
