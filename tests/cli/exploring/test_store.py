"""The store: the same bytes whoever computed, however often it was broken off; and stores that are refused."""

from __future__ import annotations

import os
import random
import shutil
import signal
import sqlite3
import struct
import subprocess
import sys
import time
from multiprocessing import parent_process
from pathlib import Path
from typing import Any

import pytest
import yaml
from sweeps import ALL, mostly_slow
from systems import UNIX

from gearlink.cli.exploring import store as stores

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
    "minimize": {"half_reach": "20 mm", "crank_length": "1 mm"},
    "maximize": {"quick_return_ratio": 0.01},
    "define": {"half_reach": "max_stroke / 2"},
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


@pytest.mark.slow
def test_the_same_with_one_two_and_seven_processes(gearlink: Any, study: Path, tmp_path: Path) -> None:
    alone = json_of(gearlink, study, "--jobs", 1)
    for jobs in (2, 7) if ALL else (2,):
        store = tmp_path / f"{jobs}.sqlite"
        assert json_of(gearlink, study, "--jobs", jobs, "--store", store) == alone
        assert json_of(gearlink, store) == alone


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


@UNIX
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


@UNIX
@pytest.mark.slow
def test_interrupted_it_says_how_to_continue(study: Path, tmp_path: Path) -> None:
    store = tmp_path / "s.sqlite"
    variables = {**STUDY["variables"], "rod": {"from": 200, "to": 400, "step": 0.2}}
    data = {**STUDY, "command": "analyze", "minimize": {"velocity_max": "1 mm/rad"}, "variables": variables}
    study.write_text(yaml.safe_dump(data, sort_keys=False))
    process = begun(study, store)
    deadline = time.monotonic() + 20.0
    while not Path(f"{store}-wal").exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    time.sleep(1.0)  # it is made ready, then computed for some seconds
    process.send_signal(signal.SIGINT)
    _, err = process.communicate(timeout=20)
    assert process.returncode == 130, err
    assert b"--resume" in err
    assert chunks(store) > 0


@pytest.mark.slow
def test_what_a_killed_run_leaves_on_the_disk_is_continued(
    gearlink: Any, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its files as they stand while a chunk is computed, which is all that is left of a process that is killed then."""
    store, killed = tmp_path / "s.sqlite", tmp_path / "killed.sqlite"
    ran: list[int] = []
    from gearlink.cli.exploring import run

    real = run.computed

    def computed(text: str, number: int) -> Any:
        if ran == [0, 1]:
            for path in tmp_path.glob("s.sqlite*"):
                shutil.copy(path, tmp_path / path.name.replace("s.", "killed.", 1))
        ran.append(number)
        return real(text, number)

    monkeypatch.setattr(run, "computed", computed)
    alone = json_of(gearlink, study, "--jobs", 1, "--store", store)
    whole = list(ran)
    assert whole == [*range(len(whole))]
    ran.clear()
    assert json_of(gearlink, study, "--jobs", 1, "--store", killed, "--resume") == alone
    assert ran == whole[2:]


@pytest.mark.slow
def test_finished_chunks_are_not_computed_again(
    gearlink: Any, study: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    store = tmp_path / "s.sqlite"
    alone = json_of(gearlink, study, "--jobs", 1, "--store", store)
    with sqlite3.connect(store) as connection:
        connection.execute("DELETE FROM chunk WHERE id = 3")
    connection.close()
    ran: list[int] = []
    from gearlink.cli.exploring import run

    real = run.computed
    monkeypatch.setattr(run, "computed", lambda text, number: ran.append(number) or real(text, number))
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
    (tmp_path / "text").write_text("no database, but some text that is long enough to be none\n" * 20)
    assert refused(gearlink, study, "--store", tmp_path / "text", "--resume")[0] == "GL159"
    other = sqlite3.connect(tmp_path / "other.sqlite")
    other.execute("CREATE TABLE mine (x)")
    other.close()
    assert refused(gearlink, study, "--store", tmp_path / "other.sqlite", "--resume")[0] == "GL159"
    assert refused(gearlink, study, "--store", tmp_path / "no" / "folder.sqlite")[0] == "GL116"
    assert refused(gearlink, study, "--resume")[0] == "GL115"


def test_a_store_in_use_is_refused(gearlink: Any, study: Path, tmp_path: Path) -> None:
    from gearlink.cli.exploring.store import opened

    store = tmp_path / "s.sqlite"
    json_of(gearlink, study, "--store", store)
    with opened(store) as kept:
        kept.log("held")
        code, message = refused(gearlink, study, "--store", store, "--resume")
    assert (code, "in use" in message) == ("GL159", True)


@pytest.mark.slow
def test_empty_and_missing_files_begin_a_store(gearlink: Any, study: Path, tmp_path: Path) -> None:
    (tmp_path / "empty.sqlite").touch()
    assert json_of(gearlink, study, "--store", tmp_path / "empty.sqlite", "--resume") == json_of(
        gearlink, study, "--store", tmp_path / "missing.sqlite", "--resume"
    )


@pytest.mark.slow
def test_show_and_write_give_files_that_run(gearlink: Any, study: Path, tmp_path: Path) -> None:
    store = tmp_path / "s.sqlite"
    front = gearlink("explore", study, "--store", store, "--format", "json", "--write", tmp_path / "out").json
    rows = front["tables"]["front"]["rows"]
    files = [tmp_path / "out" / f"cranks-{row[0]}.yaml" for row in rows]
    assert set(files) == {*(tmp_path / "out").iterdir()}, "files are called as the table calls the designs"
    assert len(files) == front["quantities"]["kept"]["value"]
    summary = gearlink("batch", tmp_path / "out", "--format", "json").json["summary"]
    assert summary["error"] == summary["fault"] == 0  # the study asks for no check to pass
    index = rows[0][0]
    shown = gearlink("explore", store, "--show", index)
    assert shown.out == files[0].read_text() == gearlink("explore", study, "--show", index).out
    (tmp_path / "shown.yaml").write_text(shown.out)
    found = gearlink("crank", tmp_path / "shown.yaml", "--format", "json").json["quantities"]
    assert found["crank_length"]["value"] == rows[0][front["tables"]["front"]["columns"].index("crank_length")]
    assert refused(gearlink, store, "--show", 10**9)[0] == refused(gearlink, store, "--show", "x")[0] == "GL115"


def dies(canonical: str, number: int) -> tuple[str, bytes]:
    """A chunk of which the second ends its process."""
    from gearlink.core.studies.explore import chunks

    if number == 2 and parent_process() is not None:
        os._exit(9)
    return chunks.computed(canonical, number)


def test_a_worker_that_dies_is_replaced_and_the_culprit_named(
    gearlink: Any, study: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gearlink.cli.exploring import run

    monkeypatch.setattr(run, "computed", dies)
    monkeypatch.setattr(run, "_survives", lambda _, first, last: not first <= 150 < last)
    ended = gearlink("explore", study, "--jobs", 2)
    assert ended.status == 3
    assert "design 150 ends the process" in ended.err


SMALL = {**STUDY, "variables": {"rod": {"from": 200, "to": 400, "step": 50}}}


@pytest.fixture
def small(tmp_path: Path) -> Path:
    path = tmp_path / "small.yaml"
    path.write_text(yaml.safe_dump(SMALL, sort_keys=False))
    return path


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A store of a small study, whole."""
    from gearlink.cli.main import run

    folder = tmp_path_factory.mktemp("store")
    (folder / "study.yaml").write_text(yaml.safe_dump(SMALL, sort_keys=False))
    assert run(["explore", str(folder / "study.yaml"), "--store", str(folder / "s"), "-j", "1", "-q"]) == 0
    return (folder / "s").read_bytes()


def changed(finished: bytes, folder: Path, statement: str, value: Any) -> Path:
    """A copy of a store with something put into it instead of what a run wrote."""
    path = folder / "s"
    path.write_bytes(finished)
    connection = sqlite3.connect(path)
    connection.execute(statement, (value,))
    connection.commit()
    connection.close()
    return path


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("change", "value"),
    [
        ("UPDATE chunk SET rows = ?", b"abc"),
        ("UPDATE chunk SET rows = ?", "abc"),
        ("UPDATE chunk SET rows = ?", struct.pack("<4d", 1e300, 1.0, 2.0, 3.0)),
        ("UPDATE chunk SET counts = ?", "x"),
        ("UPDATE chunk SET counts = ?", "[" * 100_000),
        ("UPDATE chunk SET counts = ?", b"[0, 0, {}]"),
        ("UPDATE chunk SET id = ?", 1),
        ("UPDATE chunk SET checksum = ?", b""),
        ("UPDATE meta SET value = ? WHERE key = 'study'", "{"),
        ("UPDATE meta SET value = ? WHERE key = 'study'", None),
        ("UPDATE meta SET value = ? WHERE key = 'spec'", "zz"),
        ("UPDATE meta SET value = ? WHERE key = 'gearlink'", "0.1.9"),
        ("UPDATE meta SET value = ? WHERE key = 'checksum'", b"\xff"),
        ("UPDATE meta SET key = ? WHERE key = 'schema'", "scheme"),
        ("DELETE FROM meta WHERE key = ?", "columns"),
    ],
    ids=lambda value: repr(value)[-30:],
)
@pytest.mark.parametrize("resume", [False, True])
def test_a_store_whose_content_was_changed_is_refused(
    gearlink: Any, finished: bytes, small: Path, tmp_path: Path, change: str, value: Any, resume: bool
) -> None:
    store = changed(finished, tmp_path, change, value)
    ended = gearlink("explore", *((small, "--store", store, "--resume") if resume else (store,)))
    assert (ended.status, ended.out) == (2, "")
    assert f"error GL159: {store} is damaged" in ended.err
    assert "another --store, and compute it again" in ended.err


@pytest.mark.parametrize("counts", ["[" * 100_000, '["a", {}, 3]', "[-5, 5, {}]", '[5, 5, {"GL303": [1, 0, "far"]}]'])
def test_a_chunk_with_its_own_checksum_is_still_looked_at(
    gearlink: Any, finished: bytes, tmp_path: Path, counts: str
) -> None:
    """What no run can have written, though whoever wrote it knew how checksums are made."""
    store = changed(finished, tmp_path, "UPDATE chunk SET counts = ?", counts)
    connection = sqlite3.connect(store)
    rows = connection.execute("SELECT id, counts, rows FROM chunk").fetchall()
    connection.executemany("UPDATE chunk SET checksum = ? WHERE id = ?", [(stores._checksum(*r), r[0]) for r in rows])
    connection.commit()
    connection.close()
    ended = gearlink("explore", store)
    assert (ended.status, ended.out) == (2, "")
    assert "error GL159" in ended.err


def _bit(data: bytearray, at: int, draw: random.Random) -> None:
    data[at] ^= 1 << draw.randrange(8)


def _twenty(data: bytearray, at: int, draw: random.Random) -> None:
    data[at : at + 20] = draw.randbytes(min(20, len(data) - at))


def _zeros(data: bytearray, at: int, _: random.Random) -> None:
    data[at // 4096 * 4096 : at // 4096 * 4096 + 4096] = bytes(4096)


def _cut(data: bytearray, at: int, _: random.Random) -> None:
    del data[at:]


DAMAGES = (_bit, _twenty, _zeros, _cut)


def damaged(finished: bytes, seed: int) -> bytes:
    """A store that a disk or a copy has changed at some place."""
    data, draw = bytearray(finished), random.Random(seed)
    DAMAGES[seed % len(DAMAGES)](data, draw.randrange(len(data)), draw)
    return bytes(data)


def read(store: Path) -> Any:
    """All that a store says; the code of its refusal where it is damaged."""
    try:
        with stores.opened(store) as opened:
            return opened.meta(), list(opened.results())
    except stores.CannotStore as error:
        return error.code


def test_damage_is_seen_or_changes_nothing(finished: bytes, tmp_path: Path) -> None:
    """At random places: of 300 such stores 7 had been believed."""
    store = tmp_path / "s"
    store.write_bytes(finished)
    whole, found = read(store), []
    for seed in range(4000 if ALL else 200):
        for path in tmp_path.glob("s*"):
            path.unlink()
        store.write_bytes(damaged(finished, seed))
        found.append(read(store))
    refusals = ("GL116", "GL158", "GL159")
    assert all(each == whole or each in refusals or each == ({}, []) for each in found)
    assert len(found) > sum(each in refusals for each in found) > len(found) // 4, "both ends are tried"


@pytest.mark.quick(1)
@pytest.mark.parametrize("seed", mostly_slow([*range(60)], 8))
def test_a_damaged_store_is_no_fault_of_the_program(
    gearlink: Any, finished: bytes, small: Path, tmp_path: Path, seed: int
) -> None:
    """Shown or continued; 6 of 300 had ended as one."""
    alone, store = json_of(gearlink, small, "-j", 1), tmp_path / "s"
    for words in ((store,), (small, "--store", store, "--resume", "-j", 1)):
        store.write_bytes(damaged(finished, seed))
        ended = gearlink("explore", *words, "--format", "json", "-q")
        assert ended.status in (0, 2), ended.err
        assert ended.status == 2 or ended.out == alone


def test_bytes_of_the_schema_that_are_no_text(gearlink: Any, finished: bytes, tmp_path: Path) -> None:
    """SQLite says what is wrong with a schema in its own bytes, which Python cannot decode."""
    store = tmp_path / "s"
    assert b"WITHOUT ROWID" in finished
    store.write_bytes(finished.replace(b"WITHOUT ROWID", b"WITHOUT R\xc4WID"))
    ended = gearlink("explore", store)
    assert (ended.status, ended.out) == (2, "")
    assert f"error GL159: {store} is damaged" in ended.err


def test_a_store_without_checksums_is_of_an_earlier_program(gearlink: Any, small: Path, tmp_path: Path) -> None:
    store = tmp_path / "old"
    connection = sqlite3.connect(store)
    connection.executescript(
        "CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
        "CREATE TABLE chunk (id INTEGER PRIMARY KEY, counts TEXT NOT NULL, rows BLOB NOT NULL);"
        "INSERT INTO meta VALUES ('schema', '1'), ('gearlink', '0.2.0');"
    )
    connection.close()
    for words in ((store,), (small, "--store", store, "--resume")):
        ended = gearlink("explore", *words)
        assert (ended.status, ended.out) == (2, "")
        assert "error GL158" in ended.err
        assert "have no checksums" in ended.err
        assert "compute it again" in ended.err


def begun_by(monkeypatch: pytest.MonkeyPatch, **other: str) -> None:
    """Let stores that are begun from now on be those of another program."""
    own = stores.program()
    monkeypatch.setattr(stores, "program", lambda: {**own, **other})


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["gearlink", "python", "numpy", "scipy", "cpu"])
def test_a_store_of_another_program_is_shown_but_not_continued(
    gearlink: Any, small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    store, own = tmp_path / "s", stores.program()[name]
    with monkeypatch.context() as patch:
        begun_by(patch, **{name: "0.0"})
        alone = json_of(gearlink, small, "--store", store)
    ended = gearlink("explore", store, "--format", "json")
    assert (ended.status, ended.out) == (0, alone)
    assert ended.err == f"note: {store} was computed with {name} 0.0; this is {own}\n"
    assert gearlink("explore", store, "-q").err == ""
    code, message = refused(gearlink, small, "--store", store, "--resume")
    assert (code, message) == ("GL158", f"{store} was begun with {name} 0.0; this is {own}")


@pytest.mark.slow
def test_designs_that_another_program_computes_otherwise_are_no_fault(
    gearlink: Any, small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In a store of this program they are one: there the search and the class disagree."""
    from gearlink.core.studies.explore import front

    store, ours = tmp_path / "s", tmp_path / "ours"
    with monkeypatch.context() as patch:
        begun_by(patch, gearlink="0.1.9")
        json_of(gearlink, small, "--store", store)
    json_of(gearlink, small, "--store", ours)
    single = front.single
    monkeypatch.setattr(front, "single", lambda base, _, *asked: single(base, [("rod", 999.0)], *asked))
    code, message = refused(gearlink, store)
    assert code == "GL158"
    assert f"{store} was computed with gearlink 0.1.9: here, design" in message
    ended = gearlink("explore", ours)
    assert ended.status == 3
    assert "GL160" in ended.err


def test_a_studys_name_opens_no_command_in_its_files(gearlink: Any, study: Path) -> None:
    study.write_text(yaml.safe_dump({**STUDY, "name": "a\n::error::b" + 188 * "c"}, sort_keys=False))
    shown = gearlink("explore", study, "--show", "3").out
    assert not any(line.lstrip().startswith("::") for line in shown.splitlines())
    study.write_text(shown)
    assert gearlink("analyze", study, "--quantity", "stroke").status == 0
