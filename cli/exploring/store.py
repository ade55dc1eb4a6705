"""The store of a study: one SQLite file with what is kept of every finished chunk, written by one process.

A chunk is either there whole or not at all, whatever ends the program; the result is made of the chunks alone, so it
does not matter who computed them, in which order, or how often the work was broken off.
"""

from __future__ import annotations

import json
import platform
import sqlite3
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Protocol

from gearlink.cli.parallel.cluster import processor
from gearlink.cli.reading.places import is_named_pipe
from gearlink.core.errors import GearlinkError
from gearlink.core.explore.chunks import Chunk, Miss
from gearlink.core.explore.preparing import problem_of
from gearlink.core.explore.problem import SCHEMA, Problem
from gearlink.core.version import VERSION

Result = tuple[int, str, bytes]
"""Number of a chunk, and what `Chunk.counts` and `Chunk.data` gave."""
_MAGIC = b"SQLite format 3\0"
_ODD = (ValueError, TypeError, LookupError, AttributeError, RecursionError, OverflowError)
"""What reading a text or numbers raises that no run wrote."""
_LONGEST_NAME = 200
_TABLES = """
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;
CREATE TABLE chunk (id INTEGER PRIMARY KEY, counts TEXT NOT NULL, rows BLOB NOT NULL);
CREATE TABLE refined (id INTEGER PRIMARY KEY, variables BLOB NOT NULL, row BLOB NOT NULL);
CREATE TABLE log (at TEXT, event TEXT);
"""


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

    def meta(self) -> dict[str, str]:
        """What the store says of itself; empty where it has no schema yet."""
        tables = {name for (name,) in self._connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'")}
        if not tables:
            return {}
        if not {"meta", "chunk", "refined"} <= tables:
            raise CannotStore("GL159", f"{self._path} is a database of something else", "give another --store")
        return dict(self._connection.execute("SELECT key, value FROM meta"))

    def begin(self, problem: Problem) -> None:
        """Write schema and study, all or nothing."""
        with self._transaction():
            for statement in _TABLES.strip().split(";\n"):
                self._connection.execute(statement.rstrip(";"))
            self._connection.executemany("INSERT INTO meta VALUES (?, ?)", meta_of(problem).items())

    def finished(self) -> set[int]:
        """The numbers of the chunks that are there."""
        return {number for (number,) in self._connection.execute("SELECT id FROM chunk")}

    def add(self, results: Sequence[Result]) -> None:
        """Keep some chunks in one transaction; one that is there already stays."""
        with self._transaction():
            self._connection.executemany("INSERT OR IGNORE INTO chunk VALUES (?, ?, ?)", results)

    def results(self) -> Iterator[Result]:
        """The chunks in the order of their numbers."""
        yield from self._connection.execute("SELECT id, counts, rows FROM chunk ORDER BY id").fetchall()

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
        connection.execute("PRAGMA locking_mode=EXCLUSIVE")
        connection.execute("PRAGMA journal_mode=WAL")
        connection.execute("PRAGMA synchronous=NORMAL")
        yield Store(connection, path)
    except sqlite3.Error as error:
        raise _refused(path, error) from None
    finally:
        connection.close()


def _refused(path: Path, error: sqlite3.Error) -> CannotStore:
    words = str(error)
    if "locked" in words:
        return CannotStore("GL159", f"{path} is in use by another run", "wait for its end, or give another --store")
    if "not a database" in words or "malformed" in words:
        return CannotStore("GL159", f"{path} is no store: {words}", "give another --store")
    return CannotStore("GL116", f"cannot write {path}: {words}", "give another --store")


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
    import numpy as np

    return {
        "schema": str(SCHEMA),
        "spec": problem.hash,
        "study": problem.canonical_text,
        "name": problem.spec.name,
        "gearlink": VERSION,
        "numpy": np.__version__,
        "cpu": processor(),
        "seed": str(problem.spec.sampling.seed),
        "columns": json.dumps(["index", *(name for name, _, _ in problem.shown)]),
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


def same_study(path: Path, meta: dict[str, str], problem: Problem) -> None:
    """Refuse a store of another study or another program.

    Raises
        CannotStore - GL157, GL158
    """
    own = meta_of(problem)
    if meta.get("spec") != own["spec"]:
        try:
            key, was, now = _difference(json.loads(meta.get("study", "{}")), problem.canonical)
        except _ODD:
            raise damaged(f"the study in {path}") from None
        message = f"{path} belongs to another study: {key} was {was}, is {now}"
        raise CannotStore("GL157", message, "give another --store")
    for name in ("gearlink", "numpy", "cpu"):
        if meta.get(name) != own[name]:
            message = f"{path} was begun with {name} {meta.get(name)}; this is {own[name]}"
            raise CannotStore("GL158", message, "continue it where it was begun, or give another --store")


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
        CannotStore - GL157 where there is none, GL158 of another schema
    """
    meta = store.meta()
    if meta.get("schema") != str(SCHEMA):
        message = f"{store._path} holds no study" if not meta else f"its schema is {meta.get('schema')}, not {SCHEMA}"
        raise CannotStore("GL158" if meta else "GL159", message, "give the study file in its place")
    try:
        made = problem_of(meta["study"])
    except (*_ODD, GearlinkError):
        raise damaged(f"the study in {store._path}") from None
    name = meta.get("name")
    if made.hash != meta.get("spec") or not isinstance(name, str) or len(name) > _LONGEST_NAME:
        raise damaged(f"the study in {store._path}")
    return made.named(name)


def chunks_of(kept: Kept, problem: Problem) -> Iterator[Chunk]:
    """The finished chunks of a study.

    Raises
        CannotStore - GL159 for one that no run of this study can have made
    """
    columns = len(problem.shown)
    for number, counts, data in kept.results():
        try:
            chunk = Chunk.of(counts, data, columns)
            sound = _is_sound(chunk, number, problem)
        except _ODD:
            sound = False
        if not sound:
            raise damaged(f"chunk {number}")
        yield chunk


def damaged(what: str) -> CannotStore:
    """The refusal of a store whose content somebody has changed."""
    return CannotStore("GL159", f"{what} is damaged", "give another --store, and compute the study again")


def _is_sound(chunk: Chunk, number: int, problem: Problem) -> bool:
    """Whether every field of a chunk has its type and range."""
    import numpy as np

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
