"""The design files below folders: all of them, however deep, and a word on what cannot be read."""

from __future__ import annotations

import errno
import os
import subprocess
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.reading.design_file import load
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.places import design_files, nearest_file

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "files").mkdir()
    (tmp_path / "files" / "a.yaml").write_text(CRANK)
    yield tmp_path
    subprocess.run(["rm", "-rf", "files", "out"], cwd=tmp_path, check=True)  # deeper than shutil goes


def _deep(folder: Path, names: list[str]) -> None:
    """Folders in each other, with a design in the innermost; made step by step, since the path is too long."""
    before = os.open(".", os.O_RDONLY)
    try:
        os.chdir(folder)
        for name in names:
            os.mkdir(name)
            os.chdir(name)
        Path("z.yaml").write_text(CRANK)
    finally:
        os.fchdir(before)
        os.close(before)


@pytest.mark.slow
@pytest.mark.parametrize("command", [("check",), ("batch",), ("batch", "--out", "out")])
def test_a_thousand_folders_deep(gearlink: Any, here: Path, command: tuple[str, ...]) -> None:
    _deep(here / "files", ["d"] * 1200)
    ended = gearlink(command[0], "files", "--format", "json", *command[1:])
    assert ended.status == 0
    assert len(design_files(["files"])) == 2
    assert ended.json["summary"]["designs" if command[0] == "check" else "pass"] == (2 if command[0] == "check" else 4)


@pytest.mark.parametrize("command", ["check", "batch"])
def test_a_folder_that_cannot_be_read_is_reported(gearlink: Any, here: Path, command: str) -> None:
    """Beyond the longest path that the system takes."""
    _deep(here / "files", ["d" * 200] * 25)
    ended = gearlink(command, "files", "--format", "json")
    assert ended.status == 2
    errors = [*ended.json.get("errors", ()), *(e for d in ended.json.get("designs", ()) for e in d.get("errors", ()))]
    assert [(error["code"], error["message"]) for error in errors] == [("GL101", "cannot be read: File name too long")]
    assert len(design_files(["files"])) == 2


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="another user has no rights to take away")
def test_a_folder_without_permission_is_reported(here: Path) -> None:
    """Read with the rights of another user; the folder is root's alone."""
    (here / "files" / "closed").mkdir(mode=0o700)
    for folder in (here, here / "files"):  # others may look into these, whatever the mask of this user
        folder.chmod(0o755)
    os.seteuid(65534)
    try:
        found = design_files(["files"])
        with pytest.raises(DesignFileError) as wrong:
            load("files/closed")
    finally:
        os.seteuid(0)
    assert found == [Path("files/a.yaml"), Path("files/closed")]
    assert str(wrong.value) == "files/closed:1:1: error GL101: no permission to read it"


def test_a_design_file_is_proposed_before_what_was_written_from_it(here: Path) -> None:
    for name in ("press.html", "press.yaml", "press.csv", "cam.png"):
        (here / name).write_text("")
    assert nearest_file("pres") == nearest_file("pres.yaml") == "did you mean press.yaml?"
    assert nearest_file("cm.yaml") == ""
    assert nearest_file("cm.csv") == "did you mean cam.png?"


def test_a_link_that_leads_nowhere(gearlink: Any, here: Path) -> None:
    os.symlink("gone.yaml", "files/b.yaml")
    for line in (("check", "files"), ("crank", "files/b.yaml")):
        ended = gearlink(*line)
        assert ended.status == 2
        assert "files/b.yaml:1:1: error GL101: a link to gone.yaml, which does not exist" in ended.out + ended.err
        assert "did you mean" not in ended.out + ended.err


def test_endings_in_capitals_are_those_of_designs(gearlink: Any, here: Path) -> None:
    """A gate passed over FEED.YAML without a word; a link of that name is no way to other files either."""
    (here / "files" / "FEED.YAML").write_text("kind: slider-crank\nstroke: 1e9\nrod: 1\n")
    (here / "secret.txt").write_text("token: hunter2\n")
    os.symlink("../secret.txt", "files/LINK.YML")
    assert Path("files/FEED.YAML") in design_files(["files"])
    ended = gearlink("check", "files")
    assert ended.status == 2
    assert "which is not a design file" in ended.out + ended.err
    assert "token" not in ended.out + ended.err


def test_what_is_wrong_with_a_link_is_said_with_a_way_out(here: Path) -> None:
    """The system's own words, "Too many levels of symbolic links", and no remedy."""
    os.symlink("b.yaml", "files/a_link.yaml")
    os.symlink("a_link.yaml", "files/b.yaml")
    os.symlink("gone.yaml", "files/c.yaml")
    found = {}
    for name in ("b", "c"):
        with pytest.raises(DesignFileError) as wrong:
            load(f"files/{name}.yaml")
        found[name] = wrong.value.diagnostics[0]
    assert found["b"].lines == ("a link that leads back to itself", "help: delete it")
    assert found["c"].help == "restore that file, or delete the link"


def test_a_link_to_what_is_no_design_is_not_read(gearlink: Any, here: Path) -> None:
    """A stranger's link would show lines of any file of this machine in the log."""
    (here / "secret.txt").write_text("token: hunter2\n")
    os.symlink("../secret.txt", "files/b.yaml")
    os.symlink("b.yaml", "files/c.yml")
    os.symlink("a.yaml", "files/d.yaml")
    for line in (("check", "files"), ("batch", "files"), ("crank", "files/c.yml")):
        ended = gearlink(*line)
        assert ended.status == 2
        assert "which is not a design file (.yaml, .yml)" in " ".join((ended.out + ended.err).split())
        assert "token" not in ended.out + ended.err
    assert gearlink("crank", "files/d.yaml").status == 0


@pytest.mark.parametrize("more", [(), ("--out", "kept", "--unchanged", "skip")])
def test_a_link_through_a_place_that_is_closed_costs_its_one_file(
    gearlink: Any, here: Path, monkeypatch: pytest.MonkeyPatch, more: tuple[str, ...]
) -> None:
    """Such as /proc/1/root, where the system refuses to say where a link leads."""
    place = here / "links"
    place.mkdir()
    (place / "good.yaml").write_text(CRANK)
    (place / "shut.yaml").symlink_to(here / "closed" / "x.yaml")

    def closed(real: Any) -> Any:
        def ask(name: Any, *rest: Any, **options: Any) -> Any:
            if str(name).endswith("shut.yaml") and options.get("follow_symlinks", True):
                raise PermissionError(errno.EACCES, "Permission denied", str(name))
            return real(name, *rest, **options)

        return ask

    monkeypatch.setenv("XDG_STATE_HOME", str(here / "state"))
    monkeypatch.setattr(os, "stat", closed(os.stat))
    monkeypatch.setattr(os.path, "realpath", closed(os.path.realpath))
    ended = gearlink("batch", place, "--format", "json", *more)
    assert ended.status == 2, ended.err
    assert [(Path(d["file"]).name, d["result"]) for d in ended.json["designs"]] == [
        ("good.yaml", "pass"),
        ("good.yaml", "pass"),
        ("shut.yaml", "error"),
    ]
    assert gearlink("check", place / "shut.yaml").status == 2


def test_a_base_design_is_a_design_file(gearlink: Any, here: Path) -> None:
    (here / "secret.txt").write_text("token: hunter2\n")
    (here / "study.yaml").write_text(
        "kind: study\nof: secret.txt\nvariables: {stroke: {values: [1]}}\nminimize: {rod: 1}\n"
    )
    ended = gearlink("explore", "study.yaml")
    assert ended.status == 2
    assert "study.yaml:2:1: error GL101: the base design secret.txt is not a design file (.yaml, .yml)" in ended.err
    assert "token" not in ended.err


def test_links_to_folders_are_not_followed(here: Path) -> None:
    os.symlink(here / "files", here / "files" / "loop")
    os.symlink("a.yaml", here / "files" / "b.yaml")
    assert design_files(["files"]) == [Path("files/a.yaml"), Path("files/b.yaml")]
