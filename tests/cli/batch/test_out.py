"""Result files of a batch: each design's own place, in this folder and nowhere else."""

from __future__ import annotations

import json
import os
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gearlink.cli.batch.run import place_of

CRANK = "kind: slider-crank\nstroke: {stroke}\nrod: 520\noffset: 50\n"
ALIKE = ("a b.yaml", "a-b.yaml", "a-b.yml", "a_b.yaml", "a b .yaml", "-a-b.yaml", "a-b.yaml.yaml", "a-b~1.yaml")


def test_names_that_look_alike_do_not_meet(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever the order, the share and the number of processes, each file has its own result, and it is its own."""
    monkeypatch.chdir(tmp_path)
    Path("k").mkdir()
    strokes = {name: 200 + i for i, name in enumerate(ALIKE)}
    for name, stroke in strokes.items():
        Path("k", name).write_text(CRANK.format(stroke=stroke))
    gearlink("batch", "k", "--out", "whole", "-q")
    for shard in ("2/2", "1/2"):
        gearlink("batch", *(f"k/{name}" for name in reversed(ALIKE)), "--out", "shares", "--shard", shard, "-q")
    found = [
        {path.relative_to(out).as_posix(): path.read_bytes() for path in out.rglob("*.json")}
        for out in map(Path, ("whole", "shares"))
    ]
    assert found[0] == found[1]
    assert len(found[0]) == 2 * len(ALIKE)
    for name, stroke in strokes.items():
        *folders, stem = place_of(Path("k", name))
        result = json.loads(Path("whole", *folders, f"{stem}-crank.json").read_text())
        wanted = json.loads(gearlink("crank", f"k/{name}", "--format", "json").out)
        assert result["quantities"] == wanted["quantities"], stroke


def test_plain_names_stay_as_they_are() -> None:
    assert place_of(Path("designs/press/ty-460_b.yaml")) == ("designs", "press", "ty-460_b")
    assert place_of(Path("/data/ty460.yaml")) == ("data", "ty460")


NAMES = st.text(st.sampled_from("ab-_. ~\u00e9\udcff=:"), min_size=1, max_size=4).filter(lambda name: name != ".")


@given(st.lists(st.tuples(NAMES, NAMES, st.sampled_from((".yaml", ".yml", ""))), min_size=2, max_size=6))
def test_other_files_have_other_places(files: list[tuple[str, str, str]]) -> None:
    """And none outside the folder."""
    paths = {Path(folder, name + ending) for folder, name, ending in files if name + ending != ".."}
    places = {path: place_of(path) for path in paths}
    assert all(places[a] != places[b] for a, b in combinations(paths, 2))
    for place in places.values():
        assert not {"", ".", ".."} & set(place)
        assert all(part.isprintable() and len(part.encode()) < 130 and "/" not in part for part in place)


def test_a_path_from_the_root_and_one_from_here(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """/T/a.yaml and T/a.yaml would be written to one place."""
    inner = tmp_path.joinpath(*tmp_path.parts[1:])
    inner.mkdir(parents=True)
    for folder in (tmp_path, inner):
        (folder / "a.yaml").write_text(CRANK.format(stroke=310))
    monkeypatch.chdir(tmp_path)
    line = ("batch", tmp_path / "a.yaml", (inner / "a.yaml").relative_to(tmp_path))
    assert gearlink(*line).status == 0
    ended = gearlink(*line, "--out", "o")
    assert ended.status == 2
    assert "GL116" in ended.err
    assert "into one folder" in ended.err


class TestLinks:
    @pytest.fixture
    def here(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
        monkeypatch.chdir(tmp_path)
        for name in ("k", "k/deep", "free", "out", "victim"):
            Path(name).mkdir()
        for name in ("k/a.yaml", "k/deep/b.yaml", "free/c.yaml"):
            Path(name).write_text(CRANK.format(stroke=310))
        return tmp_path

    @pytest.mark.parametrize("plot", [(), ("--plot",)])
    @pytest.mark.usefixtures("here", "small_pictures")
    def test_a_link_below_out_is_not_followed(self, gearlink: Any, plot: tuple[str, ...]) -> None:
        os.symlink("../victim", "out/k")
        ended = gearlink("batch", "k", "free", "--out", "out", "--format", "json", *plot)
        assert not list(Path("victim").iterdir())
        assert [design["result"] for design in ended.json["designs"]] == ["pass", "pass", *4 * ["error"]]
        (error,) = ended.json["designs"][2]["errors"]
        assert error["code"] == "GL116"
        assert "symbolic link" in error["message"]
        assert Path("out/free/c-crank.json").exists()

    @pytest.mark.usefixtures("here")
    def test_nor_one_further_down(self, gearlink: Any) -> None:
        Path("out/k").mkdir()
        os.symlink("../../victim", "out/k/deep")
        gearlink("batch", "k", "--out", "out")
        assert not list(Path("victim").iterdir())
        assert Path("out/k/a-crank.json").exists()

    @pytest.mark.usefixtures("here")
    def test_a_link_in_the_place_of_a_result_is_replaced(self, gearlink: Any) -> None:
        Path("out/k").mkdir()
        os.symlink("../../victim/x", "out/k/a-crank.json")
        gearlink("batch", "k", "--out", "out")
        assert not list(Path("victim").iterdir())
        assert not Path("out/k/a-crank.json").is_symlink()

    @pytest.mark.usefixtures("here")
    def test_out_itself_may_be_a_link(self, gearlink: Any) -> None:
        os.symlink("victim", "reports")
        gearlink("batch", "k", "--out", "reports")
        assert Path("victim/k/a-crank.json").exists()

    @pytest.mark.usefixtures("here")
    def test_a_file_in_the_place_of_a_folder(self, gearlink: Any) -> None:
        Path("out/k").touch()
        ended = gearlink("batch", "k/a.yaml", "--out", "out", "--format", "json")
        assert "no folder" in ended.json["designs"][0]["errors"][0]["message"]


@pytest.mark.usefixtures("small_pictures")
def test_a_name_that_is_no_utf8(gearlink: Any, tmp_path: Path) -> None:
    (tmp_path / os.fsdecode(b"bad\xff.yaml")).write_text(CRANK.format(stroke=310))
    ended = gearlink("batch", tmp_path, "--out", tmp_path / "out", "--plot", "--format", "json")
    assert [(d["result"], d["name"]) for d in ended.json["designs"]] == 2 * [("pass", "bad\ufffd")]
    assert len(list((tmp_path / "out").rglob("bad~*-crank.*"))) == 2
