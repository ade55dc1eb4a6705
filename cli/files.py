"""Writing of result files: to a temporary name in the same folder, then moved, so none is ever half-written."""

from __future__ import annotations

import errno
import os
import re
import stat
import sys
from contextlib import contextmanager, suppress

from gearlink.cli import process
from gearlink.cli.printable import visible
from gearlink.core.base.errors import GearlinkError

TYPE_CHECKING = False  # as typing has it
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from typing import IO


class CannotWrite(GearlinkError):
    """A result file could not be written."""


_unfinished: set[str] = set()
_in_place_of_others: set[str] = set()
_DESCRIPTORS = "/proc/self/fd"
_ENDING = (
    *("SIGHUP", "SIGQUIT", "SIGABRT", "SIGUSR1", "SIGUSR2", "SIGALRM", "SIGTERM", "SIGXCPU"),
    *("SIGVTALRM", "SIGPROF", "SIGIO", "SIGPWR", "SIGSTKFLT"),
    "SIGBREAK",  # Ctrl-Break of Windows
)


def leave_nothing_behind() -> None:
    """From now on a signal that ends this process first removes the files that it has not finished.

    Notes
        What the parent of the process chose to ignore (nohup) stays ignored.
    """
    import signal  # whose names take longer to make than --version to answer

    process.end_at_interrupt()
    for name in _ENDING:
        number = getattr(signal, name, None)  # not every system has them all
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _end)


def _end(number: int, _: object) -> None:
    import signal

    process.do_before_the_end()
    signal.signal(number, signal.SIG_DFL)
    os.kill(os.getpid(), number)


def _remove_unfinished() -> None:
    for path in tuple(_unfinished):
        _remove(path)


process.before_the_end.append(_remove_unfinished)


@contextmanager
def unfinished(path: str) -> Iterator[None]:
    """Remove the file or folder at `path` whichever way the block ends, if it is still there."""
    _unfinished.add(path)  # before it exists: a signal may come between
    try:
        yield
    finally:
        _remove(path)
        _unfinished.discard(path)


def _remove(path: str) -> None:
    if os.path.isdir(path):
        import shutil

        shutil.rmtree(path, ignore_errors=True)
    else:
        with suppress(OSError):
            os.unlink(path)


def require_free(path: Path, option: str, *, force: bool) -> None:
    """Refuse a file that is there without `force`, and whatever is no plain file: no folder or device is replaced.

    Raises
        CannotWrite
    """
    if not os.path.exists(path):
        return
    if os.path.isdir(path):
        raise CannotWrite(f"{path} is a folder\ngive {option} the name of a file in it")
    if not os.path.isfile(path):
        raise CannotWrite(f"{path} is not a regular file\ngive another {option}, - for standard output")
    if not force:
        raise CannotWrite(f"{path} exists already\ngive another {option}, or --force to overwrite it")


def require_folder(path: Path) -> None:
    """Refuse a folder that cannot be had, since a file stands instead, before work begins that takes long.

    Raises
        CannotWrite
    """
    there = next((place for place in (path, *path.parents) if os.path.lexists(place)), None)
    if there is not None and not os.path.isdir(there):
        raise CannotWrite(f"cannot write into {path}: {there} is not a folder")


def write_atomically(path: Path, write: Callable[[IO[bytes]], object]) -> None:
    """Let `write` fill a temporary file beside `path`, then move it there.

    Raises
        CannotWrite - where the folder or the disk does not take the file; nothing is left behind
    """
    temporary = str(path.parent / f".gearlink-{os.urandom(8).hex()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with unfinished(temporary):
            with _filled(temporary) as stream:
                write(stream)
            differs = _differ(temporary, path)
            os.replace(temporary, path)
            (_in_place_of_others.add if differs else _in_place_of_others.discard)(str(path))
    except (FileExistsError, NotADirectoryError) as error:
        raise CannotWrite(f"cannot write {path}: {path.parent} is not a folder") from error
    except OSError as error:
        raise CannotWrite(f"cannot write {path}: {error.strerror or error}\n{_advice(error, path)}".rstrip()) from error


def _advice(error: OSError, path: Path) -> str:
    """What helps where a file cannot be written; empty where nothing is known."""
    if sys.platform == "win32" and path.is_file():  # nothing is moved there to a name that a program has open
        return "close the program that shows it"
    if error.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return "write into a folder that you may write to (--out)"
    return "free some space, or write to another disk (--out)" if error.errno == errno.ENOSPC else ""


@contextmanager
def _filled(path: str) -> Iterator[IO[bytes]]:
    """A stream into a new file, which has its name once the block has ended; whatever ends the process, until then
    nothing is left of it. Where the system has no files without a name, it has its name from the beginning."""
    descriptor = _without_name(os.path.dirname(path) or os.curdir)
    if descriptor is None:
        with open(path, "xb") as stream:
            yield stream
        return
    with open(descriptor, "wb") as stream:
        yield stream
        stream.flush()
        # Python follows the link, which gives the name, only where a folder is named as well.
        os.link(f"{_DESCRIPTORS}/{descriptor}", path, src_dir_fd=descriptor)


def _without_name(folder: str) -> int | None:
    """Descriptor of a new file that no folder shows (Linux, on most of its file systems)."""
    if hasattr(os, "O_TMPFILE") and os.path.isdir(_DESCRIPTORS):
        with suppress(OSError):
            return os.open(folder, os.O_TMPFILE | os.O_RDWR, 0o666)
    return None


def _differ(new: str, old: Path) -> bool:
    """Whether a file stands there already, and holds something else."""
    if not os.path.isfile(old):
        return False
    import filecmp

    with suppress(OSError):
        return not filecmp.cmp(new, old, shallow=False)
    return True


def wrote(path: Path) -> str:
    """What is told of a file that was written: that it took the place of another one, made from other input, too."""
    return f"wrote {visible(str(path))}{in_place(path)}"


def in_place(path: Path) -> str:
    """Words for a file that took the place of one with another content; nothing for a new file or the same again."""
    return ", instead of an earlier one that differs" if str(path) in _in_place_of_others else ""


def read_plain_file(path: Path, limit: int) -> bytes:
    """What a plain file holds, up to `limit` bytes; links are not followed, pipes and devices not read.

    Raises
        OSError - for anything else, and for a larger file
    """
    flags = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)
    if path.is_symlink():
        raise OSError(0, "it is a symbolic link", str(path))
    if path.is_dir():  # whose descriptor Python would name instead of the path
        raise OSError(0, "it is not a regular file", str(path))
    with open(os.open(path, os.O_RDONLY | flags), "rb") as stream:
        if not stat.S_ISREG(os.fstat(stream.fileno()).st_mode):
            raise OSError(0, "it is not a regular file", str(path))
        data = stream.read(limit + 1)
    if len(data) > limit:
        raise OSError(0, f"it is larger than {limit} bytes", str(path))
    return data


def safe_stem(name: str) -> str:
    """A design's name as a file name: letters, digits, dot, dash and underscore, 100 bytes of them; never a path, nor a
    device of Windows, where no checkout could hold it.

    Example
        >>> safe_stem("../a b/TY-460"), safe_stem("aux")
        ('a-b-TY-460', 'design-aux')
    """
    stem = re.sub(r"[^\w.-]+", "-", name).strip("-.")
    if re.match(r"(con|prn|aux|nul|(com|lpt)[0-9])(\.|$)", stem, re.IGNORECASE):
        stem = f"design-{stem}"
    return stem.encode(errors="ignore")[:100].decode(errors="ignore") or "design"


def stem_of(source: str | Path) -> str:
    """The name that a design has from its file; what does not show, and bytes that are no UTF-8, are replaced.

    Example
        >>> stem_of("designs/ty460.yaml"), stem_of(os.fsdecode(b"bad\\xff.yaml"))
        ('ty460', 'bad\N{REPLACEMENT CHARACTER}')
    """
    from pathlib import Path

    return "".join(each if each.isprintable() else "\N{REPLACEMENT CHARACTER}" for each in Path(source).stem)
