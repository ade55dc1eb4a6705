"""The store: the same bytes whoever computed, however often it was broken off; and stores that are refused."""

from __future__ import annotations

import math
import os
import random
import shutil
import signal
import sqlite3
import struct
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
import yaml
from sweeps import ALL, mostly_slow

ROOT = Path(__file__).resolve().parents[3]
STUDY: dict[str, Any] = {
    "kind": "study",
    "name": "cranks",
    "design": {"kind": "slider-crank", "stroke": 300, "rod": 500, "offset": 20},
    "variables": {
        "rod": {"from": 200, "to": 400, "step": 4},
        "offset": {"values": [0, 10, 20, 30, 45, 60]},
        "stroke": {"values": [280, 310]},
        "name": {"values": ["crank"]},  # a word, which no array form takes: chunks are those of design classes
    },
    "minimize": {"rod_length": "20 mm", "crank_length": "1 mm"},
    "maximize": {"quick_return_ratio": 0.01},
    "define": {"rod_length": "max_stroke / 2"},
    "checks": {"must_pass": "none"},
}


@pytest.fixture
def study(tmp_path: Path) -> Path:
    path = tmp_path / "study.yaml"
    path.write_text(yaml.safe_dump(STUDY, sort_keys=False))
    return path


def json_of(gearlink: Any, *arguments: object) -> str:
    ended = gearlink("explore", *arguments, "--format", "json", "-q")
    assert ended.status == 0, ended.err
    return str(ended.out)


def test_the_same_with_one_two_and_seven_processes_shares_and_any_executor(
    gearlink: Any, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    alone = json_of(gearlink, study, "--jobs", 1)
    for jobs in (2, 7) if ALL else (2,):
        store = tmp_path / f"{jobs}.sqlite"
        assert json_of(gearlink, study, "--jobs", jobs, "--store", store) == alone
        assert json_of(gearlink, store) == alone
    stores = [tmp_path / f"share{i}.sqlite" for i in (1, 2, 3)]
    for i, store in enumerate(stores, 1):
        ended = gearlink("explore", study, "--store", store, "--shard", f"{i}/3", "-j", 1)
        assert (ended.status, ended.out) == (0, "")
        assert f"share {i} of 3" in ended.err
    assert json_of(gearlink, "--merge", *stores, "--store", tmp_path / "all.sqlite") == alone
    (tmp_path / "threads.py").write_text(
        "from concurrent.futures import ThreadPoolExecutor\nmake = ThreadPoolExecutor\n"
    )
    monkeypatch.chdir(tmp_path)
    assert json_of(gearlink, study, "--executor", "threads:make") == alone


@pytest.mark.parametrize(
    ("text", "name", "words"),
    [
        ("1 / 0\n", "broken:make", "cannot be loaded: ZeroDivisionError"),
        ("def make(:\n", "broken:make", "cannot be loaded: SyntaxError"),
        ("def make():\n    raise RuntimeError('no pool')\n", "broken:make", "cannot make one: RuntimeError: no pool"),
        ("make = dict\n", "broken:make", "makes no executor, but a dict"),
        ("", "broken:make", "cannot be loaded: AttributeError"),
        ("", "..broken:make", "cannot be loaded: TypeError"),
        ("", "broken", "is not MODULE:FACTORY"),
    ],
)
def test_what_a_factory_raises_is_a_wrong_command_line(
    gearlink: Any, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, name: str, words: str
) -> None:
    (tmp_path / "broken.py").write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.delitem(sys.modules, "broken", raising=False)
    ended = gearlink("explore", study, "--executor", name)
    assert (ended.status, ended.out) == (2, "")
    assert "GL115" in ended.err
    assert words in ended.err


def begun(study: Path, store: Path) -> subprocess.Popen[bytes]:
    words = ["explore", study, "--store", store, "--resume", "--jobs", "2", "--format", "json", "-q"]
    return subprocess.Popen(
        [sys.executable, "-m", "gearlink.cli", *map(str, words)],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )


def chunks(store: Path) -> int:
    try:
        with sqlite3.connect(f"file:{store}?mode=ro", uri=True) as connection:
            return int(connection.execute("SELECT count(*) FROM chunk").fetchone()[0])
    except sqlite3.Error:
        return -1


@pytest.mark.slow
@pytest.mark.parametrize("seed", mostly_slow([*range(20)], 1))
def test_killed_at_any_moment_and_continued_it_is_the_same(
    gearlink: Any, study: Path, tmp_path: Path, seed: int
) -> None:
    alone, store = json_of(gearlink, study, "--jobs", 1), tmp_path / "killed.sqlite"
    draw = random.Random(seed)
    for _ in range(2):
        process = begun(study, store)
        time.sleep(draw.uniform(0.2, 1.5))
        process.send_signal(signal.SIGKILL)
        process.communicate()
        deadline = time.monotonic() + 3.0
        while alive(process.pid) and time.monotonic() < deadline:
            time.sleep(0.05)
        assert not alive(process.pid), "a worker outlived its parent"
    assert json_of(gearlink, study, "--store", store, "--resume", "-j", 1) == alone


def alive(group: int) -> bool:
    try:
        os.killpg(group, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.slow
def test_interrupted_it_says_how_to_continue(study: Path, tmp_path: Path) -> None:
    store = tmp_path / "s.sqlite"
    data = {**STUDY, "variables": {**STUDY["variables"], "rod": {"from": 200, "to": 400, "step": 0.2}}}
    study.write_text(yaml.safe_dump(data, sort_keys=False))
    process = begun(study, store)
    deadline = time.monotonic() + 20.0
    while not Path(f"{store}-wal").exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    time.sleep(0.3)
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert process.returncode == 130, err
    assert b"--resume" in err
    assert chunks(store) > 0


def test_what_a_killed_run_leaves_on_the_disk_is_continued(
    gearlink: Any, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its files as they stand while a chunk is computed, which is all that is left of a process that is killed then."""
    store, killed = tmp_path / "s.sqlite", tmp_path / "killed.sqlite"
    ran: list[int] = []
    from gearlink.cli.exploring import computing

    real = computing.computed

    def computed(text: str, number: int) -> Any:
        if ran == [0, 1]:
            for path in tmp_path.glob("s.sqlite*"):
                shutil.copy(path, tmp_path / path.name.replace("s.", "killed.", 1))
        ran.append(number)
        return real(text, number)

    monkeypatch.setattr(computing, "computed", computed)
    alone = json_of(gearlink, study, "--jobs", 1, "--store", store)
    whole = list(ran)
    assert whole == [*range(len(whole))]
    ran.clear()
    assert json_of(gearlink, study, "--jobs", 1, "--store", killed, "--resume") == alone
    assert ran == whole[2:]


def test_finished_chunks_are_not_computed_again(
    gearlink: Any, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = tmp_path / "s.sqlite"
    alone = json_of(gearlink, study, "--jobs", 1, "--store", store)
    with sqlite3.connect(store) as connection:
        connection.execute("DELETE FROM chunk WHERE id = 3")
    connection.close()
    ran: list[int] = []
    from gearlink.cli.exploring import computing

    real = computing.computed
    monkeypatch.setattr(computing, "computed", lambda text, number: ran.append(number) or real(text, number))
    assert json_of(gearlink, study, "--jobs", 1, "--store", store, "--resume") == alone
    assert ran == [3]


def refused(gearlink: Any, *arguments: object) -> tuple[str, str]:
    ended = gearlink("explore", *arguments, "--format", "json")
    assert ended.status == 2
    (error,) = ended.json["errors"]
    return error["code"], error["message"]


def test_stores_that_are_refused(gearlink: Any, study: Path, tmp_path: Path) -> None:
    store = tmp_path / "s.sqlite"
    json_of(gearlink, study, "--store", store)
    assert refused(gearlink, study, "--store", store)[0] == "GL159"
    code, message = refused(
        gearlink, study, "--store", store, "--resume", "--set", "variables.rod={from: 200, to: 500}"
    )
    assert (code, "variables.rod.step was 4.0, is null" in message) == ("GL157", True)
    with sqlite3.connect(store) as connection:
        connection.execute("UPDATE meta SET value = '0.0' WHERE key = 'numpy'")
    connection.close()
    code, message = refused(gearlink, study, "--store", store, "--resume")
    assert (code, "numpy 0.0" in message) == ("GL158", True)
    (tmp_path / "text").write_text("no database, but some text that is long enough to be none\n" * 20)
    assert refused(gearlink, study, "--store", tmp_path / "text", "--resume")[0] == "GL159"
    other = sqlite3.connect(tmp_path / "other.sqlite")
    other.execute("CREATE TABLE mine (x)")
    other.close()
    assert refused(gearlink, study, "--store", tmp_path / "other.sqlite", "--resume")[0] == "GL159"
    assert refused(gearlink, study, "--store", tmp_path / "no" / "folder.sqlite")[0] == "GL116"
    assert refused(gearlink, study, "--resume")[0] == "GL115"
    assert refused(gearlink, study, study)[0] == "GL115"


def test_a_store_in_use_is_refused(gearlink: Any, study: Path, tmp_path: Path) -> None:
    from gearlink.cli.exploring.store import opened

    store = tmp_path / "s.sqlite"
    json_of(gearlink, study, "--store", store)
    with opened(store) as kept:
        kept.log("held")
        code, message = refused(gearlink, study, "--store", store, "--resume")
    assert (code, "in use" in message) == ("GL159", True)


def test_empty_and_missing_files_begin_a_store(gearlink: Any, study: Path, tmp_path: Path) -> None:
    (tmp_path / "empty.sqlite").touch()
    assert json_of(gearlink, study, "--store", tmp_path / "empty.sqlite", "--resume") == json_of(
        gearlink, study, "--store", tmp_path / "missing.sqlite", "--resume"
    )


def test_show_and_write_give_files_that_run(gearlink: Any, study: Path, tmp_path: Path) -> None:
    store = tmp_path / "s.sqlite"
    front = gearlink("explore", study, "--store", store, "--format", "json", "--write", tmp_path / "out").json
    rows = front["tables"]["front"]["rows"]
    files = sorted((tmp_path / "out").iterdir())
    assert len(files) == len(rows) == front["quantities"]["kept"]["value"]
    assert gearlink("batch", tmp_path / "out").status == 0
    index = rows[0][0]
    shown = gearlink("explore", store, "--show", index)
    assert shown.out == files[0].read_text() == gearlink("explore", study, "--show", index).out
    (tmp_path / "shown.yaml").write_text(shown.out)
    found = gearlink("crank", tmp_path / "shown.yaml", "--format", "json").json["quantities"]
    assert found["crank_length"]["value"] == rows[0][front["tables"]["front"]["columns"].index("crank_length")]
    assert refused(gearlink, store, "--show", 10**9)[0] == refused(gearlink, store, "--show", "x")[0] == "GL115"


def dies(canonical: str, number: int) -> tuple[str, bytes]:
    """A chunk of which the second ends its process."""
    from gearlink.core.explore import chunks

    if number == 2 and os.getpid() != PARENT:
        os._exit(9)
    return chunks.computed(canonical, number)


PARENT = os.getpid()


def test_a_worker_that_dies_is_replaced_and_the_culprit_named(
    gearlink: Any, study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gearlink.cli.exploring import computing

    monkeypatch.setattr(computing, "computed", dies)
    monkeypatch.setattr(computing, "_survives", lambda _, first, last: not first <= 150 < last)
    ended = gearlink("explore", study, "--jobs", 2)
    assert ended.status == 3
    assert "design 150 ends the process" in ended.err


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A store of a small study, whole."""
    from gearlink.cli.main import run

    folder = tmp_path_factory.mktemp("store")
    small = {**STUDY, "variables": {"rod": {"from": 200, "to": 400, "step": 50}}}
    (folder / "study.yaml").write_text(yaml.safe_dump(small, sort_keys=False))
    assert run(["explore", str(folder / "study.yaml"), "--store", str(folder / "s"), "-j", "1", "-q"]) == 0
    return (folder / "s").read_bytes()


@pytest.mark.quick(7)
@pytest.mark.parametrize(
    ("change", "value"),
    [
        ("UPDATE chunk SET rows = ?", b"abc"),
        ("UPDATE chunk SET rows = ?", struct.pack("<4d", math.nan, 1.0, 2.0, 3.0)),
        ("UPDATE chunk SET rows = ?", struct.pack("<4d", 1e300, 1.0, 2.0, 3.0)),
        ("UPDATE chunk SET counts = ?", "x"),
        ("UPDATE chunk SET counts = ?", "[" * 100_000),
        ("UPDATE chunk SET counts = ?", '["a", {}, 3]'),
        ("UPDATE chunk SET counts = ?", '[5, 5, {"GL303": [1, 0, "far", null, 3, "1"]}]'),
        ("UPDATE chunk SET counts = ?", "[-5, 5, {}]"),
        ("UPDATE meta SET value = ? WHERE key = 'study'", "{"),
        ("UPDATE meta SET value = ? WHERE key = 'study'", "[" * 100_000),
        ("UPDATE meta SET value = ? WHERE key = 'study'", '{"schema":1}'),
        ("UPDATE meta SET value = ? WHERE key = 'study'", None),
        ("UPDATE meta SET value = ? WHERE key = 'spec'", "zz"),
        ("UPDATE meta SET value = ? WHERE key = 'name'", None),
        ("UPDATE meta SET value = ? WHERE key = 'name'", "x" * 10_000),
    ],
    ids=lambda value: repr(value)[-30:],
)
def test_a_store_whose_content_was_changed_is_refused(
    gearlink: Any, finished: bytes, tmp_path: Path, change: str, value: Any
) -> None:
    store = tmp_path / "s"
    store.write_bytes(finished)
    connection = sqlite3.connect(store)
    connection.execute(change, (value,))
    connection.commit()
    connection.close()
    ended = gearlink("explore", store)
    assert (ended.status, ended.out) == (2, "")
    assert "error GL159" in ended.err
    assert "is damaged" in ended.err


def test_a_studys_name_opens_no_command_in_its_files(gearlink: Any, study: Path) -> None:
    study.write_text(yaml.safe_dump({**STUDY, "name": "a\n::error::b" + 188 * "c"}, sort_keys=False))
    shown = gearlink("explore", study, "--show", "3").out
    assert not any(line.lstrip().startswith("::") for line in shown.splitlines())
    study.write_text(shown)
    assert gearlink("analyze", study, "--quantity", "stroke").status == 0
