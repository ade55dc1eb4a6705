"""Writing of result files: to a temporary name in the same folder, then moved, so none is ever half-written."""

from __future__ import annotations

import os
import re
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import IO

from gearlink.core.errors import GearlinkError


class CannotWrite(GearlinkError):
    """A result file could not be written."""


def write_atomically(path: Path, write: Callable[[IO[bytes]], object]) -> None:
    """Let `write` fill a temporary file beside `path`, then move it there.

    Raises
        CannotWrite - where the folder or the disk does not take the file; nothing is left behind
    """
    temporary = None
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
        with os.fdopen(handle, "wb") as stream:
            write(stream)
        os.chmod(temporary, 0o666 & ~_umask())
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise CannotWrite(f"cannot write {path}: {error.strerror or error}") from error
    finally:
        if temporary is not None:
            Path(temporary).unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def safe_stem(name: str) -> str:
    """A design's name as a file name: letters, digits, dot, dash and underscore; never a path.

    Example
        >>> safe_stem("../a b/TY-460")
        'a-b-TY-460'
    """
    return re.sub(r"[^\w.-]+", "-", name).strip("-.")[:100] or "design"
