"""Result files are whole or absent."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest

from gearlink.cli.files import CannotWrite, safe_stem, write_atomically


def test_written_whole(tmp_path: Path) -> None:
    target = tmp_path / "new" / "a.txt"
    write_atomically(target, lambda stream: stream.write(b"whole"))
    assert target.read_bytes() == b"whole"
    assert [p.name for p in target.parent.iterdir()] == ["a.txt"]


def test_failure_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    target = tmp_path / "a.txt"
    target.write_bytes(b"old")

    def fail(stream: object) -> None:
        raise OSError(28, "No space left on device")

    with pytest.raises(CannotWrite, match="No space left"):
        write_atomically(target, fail)
    assert target.read_bytes() == b"old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.txt"]


def test_other_errors_leave_nothing_either(tmp_path: Path) -> None:
    def fail(stream: object) -> None:
        raise ValueError("planted")

    with pytest.raises(ValueError, match="planted"):
        write_atomically(tmp_path / "a.txt", fail)
    assert not list(tmp_path.iterdir())


def test_folder_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(CannotWrite, match="cannot write"):
        write_atomically(tmp_path / "file" / "a.txt", lambda stream: stream.write(b""))


@pytest.mark.parametrize(
    ("number", "fix"),
    [
        (errno.EACCES, "write into a folder that you may write to (--out)"),
        (errno.ENOSPC, "free some space"),
        (0, ""),
    ],
)
def test_a_file_that_cannot_be_written_says_what_helps(number: int, fix: str, tmp_path: Path) -> None:
    def fail(stream: object) -> None:
        raise OSError(number, "the reason")

    with pytest.raises(CannotWrite) as refused:
        write_atomically(tmp_path / "a.txt", fail)
    what, _, advice = str(refused.value).partition("\n")
    assert what.endswith("a.txt: the reason")
    assert advice.startswith(fix)
    assert bool(advice) is bool(fix)


@pytest.mark.parametrize("letter", ["x", "é", "中", "𝛼"])
@pytest.mark.parametrize("start", ["", "a", "ab", "abc"])
def test_a_file_name_is_cut_by_bytes_between_letters(letter: str, start: str) -> None:
    stem = safe_stem(start + 200 * letter)
    assert stem == start + (len(stem) - len(start)) * letter
    assert 100 - 4 < len(stem.encode()) <= 100


@pytest.mark.parametrize(
    ("name", "stem"),
    [("TY-460", "TY-460"), ("../../etc/passwd", "etc-passwd"), ("a/b\\c", "a-b-c"), ("..", "design"), ("", "design")],
)
def test_a_name_never_decides_a_path(name: str, stem: str) -> None:
    assert safe_stem(name) == stem


@pytest.mark.parametrize(
    ("name", "stem"),
    [("CON", "design-CON"), ("nul.txt", "design-nul.txt"), ("Com1", "design-Com1"), ("lpt9.", "design-lpt9"),
     ("console", "console"), ("com", "com"), ("com10", "com10"), ("a.nul", "a.nul")],
)  # fmt: skip
def test_no_file_has_the_name_of_a_device(name: str, stem: str) -> None:
    """Of Windows, which takes the part before the first dot for the device whatever follows."""
    assert safe_stem(name) == stem


@pytest.mark.parametrize("nameless", [True, False])
def test_a_new_file_is_as_the_mask_has_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, nameless: bool) -> None:
    if not nameless:
        monkeypatch.delattr(os, "O_TMPFILE", raising=False)
    before = os.umask(0o027)
    try:
        write_atomically(tmp_path / "a.txt", lambda stream: stream.write(b"whole"))
        write_atomically(tmp_path / "a.txt", lambda stream: stream.write(b"again"))
    finally:
        os.umask(before)
    assert (tmp_path / "a.txt").read_bytes() == b"again"
    assert os.name == "nt" or (tmp_path / "a.txt").stat().st_mode & 0o777 == 0o640
    assert len(list(tmp_path.iterdir())) == 1
