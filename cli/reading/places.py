"""The design files that folders, patterns and names on a command line stand for, and the files of a result."""

from __future__ import annotations

import glob
import os
import stat
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from itertools import islice
from pathlib import Path

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic

ENDINGS = (".yaml", ".yml")
"""How the names of design files end, in capitals too."""


def is_design_name(name: str) -> bool:
    """Whether a name ends as those of design files do.

    Example
        >>> is_design_name("feed.yaml"), is_design_name("FEED.YAML"), is_design_name("feed.txt")
        (True, True, False)
    """
    return name.lower().endswith(ENDINGS)


def design_files(places: Sequence[str]) -> list[Path]:
    """Design files named, matched by a pattern, or found below the folders named; each once, in a fixed order.

    Raises
        DesignFileError - for a place that does not exist, or folders without a design file
    """
    found: dict[Path, None] = {}
    for place in places:
        if not place:  # a variable of a script that is not set, and no order to take the current folder
            help_ = "give a file or a folder, . for the current one"
            raise DesignFileError([Diagnostic("GL101", "the name is empty", file="<command line>", help=help_)])
        path = Path(place)
        matched = [path] if os.path.lexists(path) else _matched(place)
        if not matched:
            near = nearest_file(place.rstrip("/"), folders=True)
            raise DesignFileError([Diagnostic("GL101", "no such file or folder", file=place, help=near)])
        for match in matched:
            found.update(dict.fromkeys(_below(match) if os.path.isdir(match) else [match]))
    if not found:
        message = f"no design file ({', '.join(ENDINGS)}) below"
        raise DesignFileError([Diagnostic("GL101", message, file=", ".join(places))])
    return list(found)


def by_kind(files: Sequence[str | Path], most: int) -> list[list[int]]:
    """Numbers of files in parts of at most so many, each of one kind: a process that computes a part imports its kind
    alone, where the imports of all kinds take a fifth of the time of a folder with all of them. The parts with most
    text come first, so that processes end together: what has more sections takes longer."""
    kinds: dict[bytes, list[int]] = {}
    sizes = []
    for k, file in enumerate(files):
        kind, size = _kind_line(file)
        kinds.setdefault(kind, []).append(k)
        sizes.append(size)
    parts = [of_kind[k : k + most] for of_kind in kinds.values() for k in range(0, len(of_kind), most)]
    return sorted(parts, key=lambda part: -sum(sizes[k] for k in part))


def _kind_line(file: str | Path) -> tuple[bytes, int]:
    """The line that names the kind, as far as it can be seen without reading YAML, and the bytes of the file; nothing
    where they cannot be seen."""
    try:
        with open(file, "rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            return next((line.split(b"#")[0].strip() for line in stream if line.startswith(b"kind:")), b""), size
    except OSError:
        return b"", 0


def astray(name: str) -> str:
    """Where a link named as a design file leads, if that is none: its lines would be shown as those of a design."""
    if not (is_design_name(name) and os.path.islink(name)):
        return ""
    try:
        target = os.path.realpath(name)
    except OSError:  # it leads through a place that this user may not look into: who reads it is told so
        return ""
    return "" if is_design_name(target) or not os.path.exists(target) else target


def is_named_pipe(name: str) -> bool:
    """Whether a file waits for ever for someone who writes: a pipe on the disk, not one that a shell has opened."""
    if name.startswith(("/dev/", "/proc/")):  # <(command) of a shell, /dev/stdin
        return False
    try:
        return stat.S_ISFIFO(os.stat(name).st_mode)
    except (OSError, ValueError):
        return False


def piped(name: str, limit: int) -> bytes | None:
    """What a pipe that a shell has opened holds, such as <(git show HEAD:a.yaml); None for what is none.

    It can be read but once, and a file is looked at before it is read: the bytes are kept.
    """
    if not name.startswith(("/dev/fd/", "/proc/self/fd/")):
        return None
    try:
        found = os.stat(name)
        if not stat.S_ISFIFO(found.st_mode):
            return None
        key = (found.st_dev, found.st_ino)
        if key not in _PIPED:
            with open(name, "rb") as stream:
                _PIPED[key] = stream.read(limit)
    except OSError:
        return None
    return _PIPED[key]


_PIPED: dict[tuple[int, int], bytes] = {}


def _matched(pattern: str) -> list[Path]:
    try:
        return sorted(Path(name) for name in glob.glob(pattern, recursive=True))
    except RecursionError:
        message = "the folders are too deep for a pattern\nname the folder itself"
        raise DesignFileError([Diagnostic("GL101", message, file=pattern)]) from None


def _below(folder: Path) -> list[Path]:
    """Design files below a folder, however deep; links to folders are not followed.

    A folder that cannot be read, and a link that leads nowhere, stand among the files: whoever reads them as such
    is given the reason why they cannot be read.
    """
    found, waiting = [], [os.fspath(folder)]
    while waiting:
        place = waiting.pop()
        try:
            with os.scandir(place) as entries:
                seen = [entry for entry in entries if not entry.name.startswith(".")]
        except OSError:
            found.append(place)
            continue
        for entry in seen:
            if entry.is_dir(follow_symlinks=False):
                waiting.append(entry.path)
            elif is_design_name(entry.name) and (os.path.isfile(entry) or not os.path.exists(entry)):
                found.append(entry.path)
    return sorted(map(Path, found), key=lambda path: path.parts)


def nearest_file(name: str, *, folders: bool = False) -> str:
    """The file, or with `folders` also the folder, that a name was perhaps meant for; nothing where none is near.

    A design file is meant before what was written from it, such as its page, and alone where the name has its ending.
    """
    from difflib import get_close_matches

    there = sorted(_neighbours(name, folders), key=lambda each: (is_design_name(each), each))
    if is_design_name(name) and not folders:
        there = [each for each in there if is_design_name(each)]
    by_stem = {os.path.splitext(each)[0]: each for each in there}
    near = get_close_matches(os.path.splitext(os.path.basename(name))[0], by_stem, n=1)
    return f"did you mean {os.path.join(os.path.dirname(name), by_stem[near[0]])}?" if near else ""


def _neighbours(name: str, folders: bool) -> list[str]:
    try:
        with os.scandir(os.path.dirname(name) or ".") as entries:
            return [entry.name for entry in islice(entries, 1000) if folders or not entry.is_dir()]
    except (OSError, ValueError):
        return []


def base_path(file: str, of: str) -> Path:
    """Where the file named by `of` stands: beside the file that names it; in the current folder where that is none."""
    return Path(of) if file.startswith("<") else Path(file).parent / of


_NOTED: ContextVar[dict[str, bytes] | None] = ContextVar("noted", default=None)


@contextmanager
def files_read() -> Iterator[dict[str, bytes]]:
    """The content of the files that are read within, by their paths."""
    found: dict[str, bytes] = {}
    token = _NOTED.set(found)
    try:
        yield found
    finally:
        _NOTED.reset(token)


def note(path: str | os.PathLike[str], content: bytes) -> None:
    """Tell what a file held when it was read."""
    noted = _NOTED.get()
    if noted is not None:
        noted[os.fspath(path)] = content
