"""The store of a study: one SQLite file with what is kept of every finished chunk, written by one process.

A chunk is either there whole or not at all, whatever ends the program; the result is made of the chunks alone, so it
does not matter who computed them, in which order, or how often the work was broken off. Each has a checksum, and so has
what the store says of itself: what a disk, a copy or somebody changed is refused, not believed.
"""

from __future__ import annotations

import hashlib
import json
import platform
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from gearlink.cli.program import program
from gearlink.cli.reading.places import is_named_pipe
from gearlink.core.base.errors import GearlinkError
from gearlink.core.studies.explore.chunks import Chunk, Miss
from gearlink.core.studies.explore.preparing import problem_of
from gearlink.core.studies.explore.problem import Problem

Result = tuple[int, str, bytes]
"""Number of a chunk, and what `Chunk.counts` and `Chunk.data` gave."""
_MAGIC = b"SQLite format 3\0"
_ODD = (ValueError, TypeError, LookupError, AttributeError, RecursionError, OverflowError)
"""What reading a text or numbers raises that no run wrote."""
_FORMAT = "2"
"""Of the tables below; stores of format 1 have no checksums."""
_TABLES = """
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;
CREATE TABLE chunk (id INTEGER PRIMARY KEY, counts TEXT NOT NULL, rows BLOB NOT NULL, checksum BLOB NOT NULL);
CREATE TABLE log (at TEXT, event TEXT);
"""


_CHECKSUM = "checksum"
_ANOTHER = "give another --store"
_ANEW = "give the study file and another --store, and compute it again"


class CannotStore(GearlinkError):
    """A store that cannot be used: its code, and what helps."""

    def __init__(self, code: str, message: str, help: str = "") -> None:
        super().__init__(message)
        self.code, self.help = code, help


class Kept(Protocol):
    """Where finished chunks are kept."""

    def finished(self) -> set[int]:
        """The numbers of the chunks that are there."""
        ...

    def add(self, results: Sequence[Result]) -> None:
        """Keep some chunks, all or none of them."""
        ...

    def results(self) -> Iterator[Result]:
        """The chunks in the order of their numbers."""
        ...


class Memory:
    """Chunks kept as long as the program runs."""

    def __init__(self) -> None:
        self._chunks: dict[int, Result] = {}

    def finished(self) -> set[int]:
        """The numbers of the chunks that are there."""
        return set(self._chunks)

    def add(self, results: Sequence[Result]) -> None:
        """Keep some chunks."""
        self._chunks |= {result[0]: result for result in results}

    def results(self) -> Iterator[Result]:
        """The chunks in the order of their numbers."""
        return (self._chunks[number] for number in sorted(self._chunks))


class Store:
    """A store that is open; made by `opened`."""

    def __init__(self, connection: sqlite3.Connection, path: Path) -> None:
        self._connection, self._path = connection, path
        connection.text_factory = lambda text: text.decode(errors="replace")  # its checksum tells what was no text

    def meta(self) -> dict[str, str]:
        """What the store says of itself; empty where it has no schema yet.

        Raises
            CannotStore - GL159 where that is not what was written, GL158 of another format
        """
        tables = {name for (name,) in self._connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        if not tables:
            return {}
        if not {"meta", "chunk"} <= tables:
            raise CannotStore("GL159", f"{self._path} is another kind of database", _ANOTHER)
        found = dict(self._connection.execute("SELECT key, value FROM meta"))
        checksum = found.pop(_CHECKSUM, None)
        if found.get("schema") == "1":
            message = f"{self._path} was written by an earlier gearlink, whose stores have no checksums"
            raise CannotStore("GL158", message, _ANEW)
        if checksum != _checksum_of_meta(found):
            raise damaged(self._path, "its description of the study")
        if found["schema"] != _FORMAT:
            message = f"{self._path} was written by gearlink {found.get('gearlink')}: its format is {found['schema']}"
            raise CannotStore("GL158", f"{message}, this one reads {_FORMAT}", _ANEW)
        return found

    def begin(self, problem: Problem) -> None:
        """Write schema and study, all or nothing."""
        meta = meta_of(problem)
        with self._transaction():
            for statement in _TABLES.strip().split(";\n"):
                self._connection.execute(statement.rstrip(";"))
            meta[_CHECKSUM] = _checksum_of_meta(meta)
            self._connection.executemany("INSERT INTO meta VALUES (?, ?)", meta.items())

    def finished(self) -> set[int]:
        """The numbers of the chunks that are there."""
        return {number for (number,) in self._connection.execute("SELECT id FROM chunk")}

    def add(self, results: Sequence[Result]) -> None:
        """Keep some chunks in one transaction; one that is there already stays."""
        rows = [(*result, _checksum(*result)) for result in results]
        with self._transaction():
            self._connection.executemany("INSERT OR IGNORE INTO chunk VALUES (?, ?, ?, ?)", rows)

    def results(self) -> Iterator[Result]:
        """The chunks in the order of their numbers.

        Raises
            CannotStore - GL159 for one that is not what was written
        """
        before = -1
        for *result, checksum in self._connection.execute("SELECT id, counts, rows, checksum FROM chunk ORDER BY id"):
            number, counts, rows = result
            sound = type(number) is int and isinstance(counts, str) and isinstance(rows, bytes)
            if not (sound and number > before and checksum == _checksum(number, counts, rows)):
                raise damaged(self._path, f"chunk {number}")
            before = number
            yield number, counts, rows

    def log(self, event: str) -> None:
        """Note an event; no result depends on it."""
        with self._transaction():
            now = datetime.now(UTC).isoformat(timespec="seconds")
            self._connection.execute("INSERT INTO log VALUES (?, ?)", (now, f"{platform.node()}: {event}"))

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._connection.execute("BEGIN IMMEDIATE")
        try:
            yield
        except BaseException:
            if self._connection.in_transaction:
                self._connection.execute("ROLLBACK")
            raise
        self._connection.execute("COMMIT")


@contextmanager
def opened(path: Path) -> Iterator[Store]:
    """The store at a path, made where there is none; no other process can open it meanwhile.

    Raises
        CannotStore - GL159, GL116 for whatever the file or the disk does, within the block too
    Notes
        The lock ends with this process. A worker that was forked while the store is open would have its descriptor;
        whoever starts workers does so before.
    """
    try:
        connection = sqlite3.connect(path, timeout=0.2, isolation_level=None)
    except sqlite3.Error as error:
        raise _refused(path, error) from None
    try:
        for setting in ("locking_mode=EXCLUSIVE", "journal_mode=WAL", "synchronous=NORMAL"):
            connection.execute(f"PRAGMA {setting}")
        connection.execute("SELECT count(*) FROM sqlite_master")  # which reads the whole schema
    except sqlite3.Error as error:
        connection.close()
        raise _refused(path, error) from None
    except UnicodeDecodeError:  # SQLite says what is wrong with the schema in bytes of the file
        connection.close()
        raise damaged(path, "its schema") from None
    try:
        yield Store(connection, path)
    except sqlite3.Error as error:
        raise _refused(path, error) from None
    finally:
        connection.close()


def _refused(path: Path, error: sqlite3.Error) -> CannotStore:
    words = str(error)
    if "locked" in words:
        return CannotStore("GL159", f"{path} is in use by another run", "wait for its end, or give another --store")
    if "not a database" in words:
        return CannotStore("GL159", f"{path} is not a store: {words}", _ANOTHER)
    if "malformed" in words or "no such" in words:
        return damaged(path, f"the database ({words})")
    return CannotStore("GL116", f"cannot write {path}: {words}", _ANOTHER)


def _checksum(number: int, counts: str, rows: bytes) -> bytes:
    """Of a chunk, over the bytes that are written."""
    text = counts.encode()
    return hashlib.sha256(b"%d %d %d\n%b%b" % (number, len(text), len(rows), text, rows)).digest()


def _checksum_of_meta(meta: Mapping[str, Any]) -> str:
    return hashlib.sha256(ascii(sorted(meta.items(), key=ascii)).encode()).hexdigest()  # whatever types it is read with


def is_store(source: str) -> bool:
    """Whether a file is a store rather than the text of a study."""
    if is_named_pipe(source) or source.startswith(("/dev/fd/", "/proc/")):  # a pipe can be read but once
        return False
    try:
        with open(source, "rb") as stream:
            return stream.read(len(_MAGIC)) == _MAGIC
    except OSError:
        return False


def meta_of(problem: Problem) -> dict[str, str]:
    """What a store says of itself."""
    return {
        "schema": _FORMAT,
        "spec": problem.hash,
        "study": problem.canonical_text,
        "name": problem.spec.name,
        "seed": str(problem.spec.sampling.seed),
        "columns": json.dumps(["index", *(name for name, _, _ in problem.shown)]),
        **program(),
    }


def ready(store: Store, problem: Problem, *, resume: bool) -> None:
    """Make sure that a store belongs to a study and may be continued; begin it where it is new.

    Raises
        CannotStore - GL157 another study, GL158 another program, GL159 not to be continued
    """
    meta = store.meta()
    if not meta:
        store.begin(problem)
        return
    if not resume:
        done = len(store.finished())
        message = f"{store._path} holds {done} of {problem.chunks} chunks already"
        raise CannotStore("GL159", message, "add --resume to continue it, or give another --store")
    same_study(store._path, meta, problem)
    for _ in store.results():  # a damaged one is told of now, not after hours
        pass


def same_study(path: Path, meta: dict[str, str], problem: Problem) -> None:
    """Refuse to continue a store of another study or another program.

    Raises
        CannotStore - GL157, GL158
    """
    if meta.get("spec") != problem.hash:
        key, was, now = _difference(json.loads(meta["study"]), problem.canonical)
        message = f"{path} belongs to another study: {key} was {was}, is {now}"
        raise CannotStore("GL157", message, _ANOTHER)
    for name, was, now in others(meta):
        message = f"{path} was begun with {name} {was}; this is {now}"
        raise CannotStore("GL158", message, "continue with the installation that began it, or give another --store")


def others(meta: Mapping[str, str]) -> list[tuple[str, str, str]]:
    """What a store was begun with that is not of this program: name, what it was, what it is."""
    return [(name, meta.get(name, ""), now) for name, now in program().items() if meta.get(name) != now]


def _difference(old: Any, new: Any, path: str = "") -> tuple[str, str, str]:
    """The first key in which two studies differ, and both values."""
    if isinstance(old, dict) and isinstance(new, dict):
        for key in sorted({*old, *new}, key=lambda key: (key == "sampling", key)):  # its count follows from the others
            if old.get(key) != new.get(key):
                return _difference(old.get(key), new.get(key), f"{path}.{key}" if path else key)
    return (
        path or "the order of its keys",
        json.dumps(old, ensure_ascii=False)[:80],
        json.dumps(new, ensure_ascii=False)[:80],
    )


def problem_in(store: Store) -> Problem:
    """The study that a store was made for, with its name.

    Raises
        CannotStore - GL158 of another program that read studies otherwise, GL159 where there is none
    """
    meta = store.meta()
    if not meta:
        raise CannotStore("GL159", f"{store._path} holds no study", "give the study file instead")
    try:
        made = problem_of(meta["study"])
        same = made.hash == meta["spec"] and meta_of(made)["columns"] == meta["columns"]
    except (*_ODD, GearlinkError):
        same = False
    if same:
        return made.named(meta["name"])
    if not others(meta):
        raise damaged(store._path, "the study")
    raise of_another_program(store._path, meta, "this version reads its study differently")


def chunks_of(kept: Kept, problem: Problem) -> Iterator[Chunk]:
    """The finished chunks of a study.

    Raises
        CannotStore - GL159 for one that no run of this study can have made, and where one is missing
    """
    columns, count = len(problem.shown), 0
    for number, counts, data in kept.results():
        try:
            chunk = Chunk.of(counts, data, columns)
            sound = _is_sound(chunk, number, problem)
        except _ODD:
            sound = False
        if not sound:
            raise damaged(None, f"chunk {number}")
        yield chunk
        count += 1
    if count < problem.chunks:  # though their numbers are there
        raise damaged(None, "the number of its chunks")


def damaged(path: Path | None, what: str) -> CannotStore:
    """The refusal of a store whose content is not what was written."""
    return CannotStore(
        "GL159", f"{'the store' if path is None else path} is damaged: {what} does not match its checksum", _ANEW
    )


def of_another_program(path: Path, meta: Mapping[str, str], what: str) -> CannotStore:
    """The refusal to show a store of another program."""
    was = ", ".join(f"{name} {was}" for name, was, _ in others(meta))
    return CannotStore("GL158", f"{path} was computed with {was}: {what}", _ANEW)


def _is_sound(chunk: Chunk, number: int, problem: Problem) -> bool:
    """Whether every field of a chunk has its type and range."""
    first = number * problem.chunk_size
    last = min(first + problem.chunk_size, problem.order.count) - 1
    places, objectives = chunk.rows[:, 0], chunk.rows[:, 1 : 1 + len(problem.objectives)]
    return (
        0 <= number < problem.chunks
        and type(chunk.designs) is type(chunk.feasible) is int
        and 0 <= chunk.feasible <= chunk.designs <= problem.chunk_size
        and all(isinstance(name, str) and _is_sound_miss(miss, first, last) for name, miss in chunk.misses.items())
        and bool(np.all((places >= first) & (places <= last) & (places == np.rint(places))))
        and bool(np.isfinite(objectives).all())
    )


def _is_sound_miss(miss: Miss, first: int, last: int) -> bool:
    amounts = (miss.value, miss.limit)
    return (
        all(type(count) is int and 0 <= count <= last + 1 - first for count in (miss.fails, miss.alone))
        and all(amount is None or type(amount) in (int, float) for amount in amounts)
        and (miss.index is None or (type(miss.index) is int and first <= miss.index <= last))
        and isinstance(miss.unit, str)
    )
