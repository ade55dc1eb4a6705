"""The secret that signs a user's cache entries; it stands outside every checkout and nobody else may read it."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from gearlink.cli.files import read_plain_file, unfinished
from gearlink.core.errors import GearlinkError

_BYTES = 32


class NoKey(GearlinkError):
    """There is no key that could be trusted."""


def own_key() -> bytes:
    """The user's key, made when there is none.

    Raises
        NoKey - where it cannot be made or read, or others may read it
    """
    try:
        path = _state_home() / "gearlink" / "cache.key"
        if not os.path.lexists(path):
            _make(path)
        key = read_plain_file(path, _BYTES, private=True)
    except (OSError, RuntimeError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        name = getattr(error, "filename", None) or "the key"
        raise NoKey(f"{name}: {reason}") from error
    if len(key) != _BYTES:
        raise NoKey(f"{path} does not hold {_BYTES} bytes: remove it, and a new one is made")
    return key


def _state_home() -> Path:
    """Where programs keep a user's state; by the standard a relative path in the variable counts as none.

    Raises
        RuntimeError - where HOME is no place of its own but one below the current folder, a checkout perhaps
    """
    state = os.environ.get("XDG_STATE_HOME", "")
    if os.name == "posix" and not os.path.isabs(state) and not os.path.isabs(os.environ.get("HOME", "/")):
        raise RuntimeError("HOME is no absolute path")
    return Path(state) if os.path.isabs(state) else Path.home() / ".local" / "state"


def _make(path: Path) -> None:
    """Write a new key; a link makes it appear whole, and leaves the one that another run was faster with."""
    path.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    temporary = str(path.parent / f".gearlink-{os.urandom(8).hex()}")
    with unfinished(temporary):
        with open(os.open(temporary, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as stream:
            stream.write(os.urandom(_BYTES))
        with suppress(FileExistsError):
            os.link(temporary, path)
