"""The cache of a batch: believed only with this user's signature, and never the end of a batch."""

from __future__ import annotations

import json
import os
import resource
import signal
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from sweeps import mostly_slow

from gearlink.cli.batch.kept import as_bytes, restored
from gearlink.cli.batch.key import NoKey, own_key
from gearlink.cli.batch.outcome import Fix, Outcome
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.core.report import Check, Quantity, Report, Table

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"


@pytest.fixture(autouse=True)
def state(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user's state folder of the test's own."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    return tmp_path / "state"


@pytest.fixture
def folder(tmp_path: Path, designs: Path) -> Path:
    """A design that fails, one that passes, a wrong file."""
    place = tmp_path / "files"
    place.mkdir()
    (place / "fail.yaml").write_text(
        (designs / "six_bar_two_trains.yaml").read_text().replace("mobility: 1", "mobility: 2")
    )
    (place / "pass.yaml").write_text(CRANK)
    (place / "wrong.yaml").write_text("kind: slider-crank\nrod: 5\n")
    return place


@pytest.fixture
def batch(gearlink: Any, folder: Path, tmp_path: Path) -> Callable[..., Any]:
    """Run the folder with a cache; JSON."""

    def call(*arguments: object, cache: object = tmp_path / "cache") -> Any:
        return gearlink("batch", folder, "--format", "json", "-j", "1", "--cache", cache, *arguments)

    return call


@pytest.fixture
def soon() -> Iterator[None]:
    """A read that hangs ends the test, not the run of all tests."""

    def stop(*_: object) -> None:
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(20)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def plain(ended: Any) -> list[dict[str, Any]]:
    return [{k: v for k, v in d.items() if k not in ("seconds", "cached")} for d in ended.json["designs"]]


def cached(ended: Any) -> list[bool]:
    return [design["cached"] for design in ended.json["designs"]]


VARIED = ["candy_feed", "thesis_example_3_as_printed", "ty460", "wide_swing_slider", "six_bar_two_trains"]
OTHERS = sorted({path.stem for path in (Path(__file__).parents[3] / "designs").glob("*.yaml")} - set(VARIED))


@pytest.mark.parametrize("name", mostly_slow(VARIED + OTHERS, len(VARIED)))
def test_what_is_kept_is_what_was_computed(gearlink: Any, designs: Path, tmp_path: Path, name: str) -> None:
    line = ("batch", designs / f"{name}.yaml", "--format", "json", "--cache", tmp_path / "cache")
    first, second = gearlink(*line), gearlink(*line)
    assert plain(first) == plain(second)
    assert set(cached(second)) == {True}
    assert first.status == second.status


def test_entries_stay_the_users_own(batch: Any, state: Path) -> None:
    batch()
    (key,) = (path for path in state.rglob("*") if path.is_file())
    assert key.stat().st_mode & 0o777 == 0o600
    assert len(key.read_bytes()) == 32


def test_a_study_is_computed_again_where_its_base_has_changed(gearlink: Any, state: Path, tmp_path: Path) -> None:
    base, study, cache = tmp_path / "base.yml", tmp_path / "study.yaml", tmp_path / "kept"
    base.write_text("{kind: slider-crank, stroke: 310, rod: 520, offset: 50}")
    study.write_text("kind: study\nof: base.yml\nvariables: {rod: {values: [500, 510]}}\nminimize: {crank_length: 1}\n")

    def run() -> Any:
        (found,) = gearlink("batch", study, "--cache", cache, "--format", "json").json["designs"]
        return found["cached"], found["tables"]["front"]["rows"]

    first = run()
    assert run() == (True, first[1])
    base.write_text(base.read_text().replace("310", "320"))
    again = run()
    assert not again[0]
    assert again[1] != first[1]


class TestForged:
    def test_an_entry_that_was_edited_is_computed(self, batch: Any, tmp_path: Path) -> None:
        first = batch()
        for entry in (tmp_path / "cache").iterdir():
            entry.write_bytes(entry.read_bytes().replace(b'"fail"', b'"pass"'))
        again = batch()
        assert plain(again) == plain(first)
        assert again.status == first.status
        assert "your key did not sign it" in again.err
        assert again.err.count("note:") == 1

    def test_a_strangers_cache_is_computed_and_replaced(self, batch: Any, state: Path) -> None:
        first = batch()
        (state / "gearlink" / "cache.key").write_bytes(bytes(32))
        again = batch()
        assert cached(again) == [False] * 3
        assert plain(again) == plain(first)
        assert cached(batch()) == [True] * 3

    def test_an_entry_does_not_serve_for_another_design(self, batch: Any, tmp_path: Path) -> None:
        """The failing design's entry replaced by the passing one's, each signed by this user."""
        batch()
        entries = {("GL309" in path.read_text()): path for path in (tmp_path / "cache").iterdir()}
        entries[True].write_bytes(entries[False].read_bytes())
        again = batch()
        assert [design["result"] for design in again.json["designs"]] == ["fail", "pass", "error"]


class TestBroken:
    """A bad, special, huge or unwritable cache costs the cache: same results, same status, one note."""

    def check(self, batch: Any, first: Any, word: str, **options: Any) -> None:
        again = batch(**options)
        assert plain(again) == plain(first)
        assert again.status == first.status
        assert word in again.err
        assert again.err.count("note:") == 1

    @pytest.mark.quick(2)
    @pytest.mark.parametrize("data", [b"", b"{", b"[" * 200_000, b"\xff" * 100, b'{"status": 77}'])
    def test_bytes(self, batch: Any, tmp_path: Path, data: bytes) -> None:
        first = batch()
        for entry in (tmp_path / "cache").iterdir():
            entry.write_bytes(data)
        self.check(batch, first, "did not sign")

    @pytest.mark.usefixtures("soon")
    @pytest.mark.parametrize(
        ("make", "word"),
        [
            (os.mkfifo, "no plain file"),
            (os.mkdir, "directory"),
            (lambda path: os.symlink("/dev/zero", path), "symbolic link"),
            (lambda path: os.symlink("nowhere", path), "symbolic link"),
        ],
    )
    def test_special_files(self, batch: Any, tmp_path: Path, make: Callable[[Path], None], word: str) -> None:
        first = batch()
        for entry in (tmp_path / "cache").iterdir():
            entry.unlink()
            make(entry)
        self.check(batch, first, word)

    def test_huge_entries_are_not_read(self, batch: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        first = batch()
        monkeypatch.setattr("gearlink.cli.batch.cache._LARGEST_ENTRY", 1 << 20)  # 64 of them take long to be read
        for entry in (tmp_path / "cache").iterdir():
            os.truncate(entry, 3 << 30)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        self.check(batch, first, "larger than")
        assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 400_000

    def test_a_file_in_the_place_of_the_folder(self, batch: Any, tmp_path: Path) -> None:
        first = batch()
        (tmp_path / "file").touch()
        self.check(batch, first, "cannot write", cache=tmp_path / "file")
        self.check(batch, first, "cannot write", cache="/dev/full")

    def test_quiet(self, batch: Any) -> None:
        assert batch("-q", cache="/dev/full").err == ""


class TestKey:
    def test_made_once(self) -> None:
        assert own_key() == own_key() != bytes(32)

    @pytest.mark.parametrize("state_home", ["", "relative"])
    def test_without_the_variable_it_stands_below_home(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, state_home: str
    ) -> None:
        monkeypatch.setenv("HOME", str(tmp_path))
        monkeypatch.setenv("XDG_STATE_HOME", state_home)
        key = own_key()
        assert (tmp_path / ".local" / "state" / "gearlink" / "cache.key").read_bytes() == key

    @pytest.mark.parametrize("home", ["", "relative"])
    def test_it_never_stands_below_the_current_folder(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, home: str
    ) -> None:
        monkeypatch.chdir(tmp_path)
        monkeypatch.setenv("HOME", home)
        monkeypatch.setenv("XDG_STATE_HOME", "")
        with pytest.raises(NoKey, match="HOME is no absolute path"):
            own_key()
        assert not list(tmp_path.iterdir())

    @pytest.mark.quick(3)
    @pytest.mark.parametrize(
        ("spoil", "word"),
        [
            (lambda key: key.chmod(0o644), "others own it or may read it"),
            (lambda key: key.write_bytes(b"short"), "does not hold 32 bytes"),
            (lambda key: os.truncate(key, 100), "larger than 32 bytes"),
            (lambda key: (key.unlink(), key.symlink_to("/dev/zero")), "symbolic link"),
            (lambda key: (key.unlink(), key.mkdir()), "cache.key: it is no plain file"),
        ],
    )
    def test_no_cache_without_a_good_key(
        self, batch: Any, state: Path, tmp_path: Path, spoil: Callable[[Path], object], word: str
    ) -> None:
        own_key()
        spoil(state / "gearlink" / "cache.key")
        with pytest.raises(NoKey, match=word):
            own_key()
        ended = batch()
        assert "nothing is kept or taken" in ended.err
        assert cached(batch()) == [False] * 3
        assert not (tmp_path / "cache").exists()

    def test_a_home_that_cannot_be_written(self, batch: Any, state: Path) -> None:
        state.touch()
        assert "nothing is kept or taken" in batch().err


def test_a_huge_file_is_not_read(gearlink: Any, tmp_path: Path) -> None:
    """3 GB of holes: refused after the first megabyte."""
    (tmp_path / "a.yaml").write_text(CRANK)
    (tmp_path / "s.yaml").touch()
    os.truncate(tmp_path / "s.yaml", 3 << 30)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    ended = gearlink("batch", tmp_path, "--cache", tmp_path / "cache", "--format", "json", "-j", "1")
    assert [design["result"] for design in ended.json["designs"]] == ["pass", "error"]
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200_000


# Field by field

GOOD = Outcome(
    "f.yaml",
    "gear-pair",
    "a",
    "gear",
    0,
    Report(
        "gear-pair",
        "a",
        "gear",
        (
            Quantity("q", [1.0, 2.5], "mm", "q", "words"),
            Quantity("n", 3, "1", "n", "words"),
            Quantity("r", [None, [1.0, 2.5]], "mm", "r", "words"),
            Quantity("s", [2.5, None], "mm", "s", "words"),
            Quantity("t", [], "deg", "t", "words"),
        ),
        (
            Check("GL301", "collision", "fail", "m", 1.0, None, "mm", (("a[0]", 2.5), ("b", None))),
            Check("GL302", "axis", "pass", "m"),
        ),
        (Table("t", ("a", "b"), ("mm", "1"), ([1.0, None], ["x", 2])),),
    ),
    places=((3, 1),),
    fixes=((Fix(3, 5, 8, "2.5"),),),
)
WRONG = Outcome("f.yaml", "", "a", "", 2, errors=(Diagnostic("GL105", "m", "f.yaml", 2, 3),))


@pytest.mark.parametrize("good", [pytest.param(GOOD, marks=pytest.mark.slow), WRONG])
def test_outcomes_come_back(good: Outcome) -> None:
    assert repr(restored(as_bytes([good]))) == repr([good])


def _places_of(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    yield path
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for step, inner in items:
        yield from _places_of(inner, (*path, step))


def _with(node: Any, path: tuple[Any, ...], value: Any) -> Any:
    if not path:
        return value
    copy = node.copy()
    copy[path[0]] = _with(node[path[0]], path[1:], value)
    return copy


@pytest.mark.parametrize("good", [GOOD, WRONG])
def test_no_field_of_another_type_is_taken(good: Outcome) -> None:
    """Every place of the entry in turn replaced by what no field of an outcome may be."""
    data = json.loads(as_bytes([good]))
    taken = []
    for path in _places_of(data):
        for value in (True, {"a": 1}, [[[[]]]], [None]):
            try:
                restored(json.dumps(_with(data, path, value)).encode())
            except ValueError:
                continue
            taken.append((path, value))
    allowed = {(0, "cached")}  # a truth value there is one
    values = {(0, "report", "quantities", i, "value") for i in range(5)}  # of a study one is a truth value
    others = {path for path, value in taken if value is not True or path not in values}
    assert others <= allowed | {(0, "report", "tables", 0, "data", i) for i in (0, 1)}


@pytest.mark.parametrize(
    ("path", "value"),
    [
        ((), []),
        ((0, "status"), 1e999),
        ((0, "report"), None),
        ((0, "places"), [[0, 1]]),
        ((0, "places"), [[1, 1], [2, 1]]),
        ((0, "report", "checks", 0, "status"), "good"),
        ((0, "report", "tables", 0, "data"), [[1.0, 2.0]]),
        ((0, "report", "tables", 0, "data"), [[1.0], [1.0, 2.0]]),
        ((0, "errors"), [{"code": "GL105"}]),
    ],
)
def test_no_value_out_of_range_is_taken(path: tuple[Any, ...], value: Any) -> None:
    with pytest.raises(ValueError, match=r"."):
        restored(json.dumps(_with(json.loads(as_bytes([GOOD])), path, value)).encode())


def test_a_deep_entry_is_refused() -> None:
    with pytest.raises(ValueError, match="RecursionError"):
        restored(b"[" * 100_000)
