"""What last digits of numbers depend on besides the design: the code of gearlink, what it computes with, and where."""

from __future__ import annotations

import hashlib
import os
import platform
import sys
from functools import cache
from importlib import import_module, metadata
from pathlib import Path

from gearlink.core.version import VERSION

_DIGITS = 12
_ROOMS = ("gearlink.core", "gearlink.cli")


def program() -> dict[str, str]:
    """Versions by name; two programs for which they are the same compute the same."""
    import numpy as np

    return {
        "gearlink": f"{VERSION} (code {code()})",
        "python": f"{sys.version_info.major}.{sys.version_info.minor}",  # whose sums of floats have changed once
        "numpy": np.__version__,
        "scipy": metadata.version("scipy"),
        "cpu": processor(),
    }


@cache
def code() -> str:
    """A number for the code of gearlink itself: two checkouts of one version are two programs."""
    sums = hashlib.sha256()
    for room in _ROOMS:
        folder = Path(import_module(room).__path__[0])
        files = sorted(folder.rglob("*.py"))
        if not files:  # code that cannot be read is the same as no other
            return os.urandom(_DIGITS // 2).hex()
        for path in files:
            content = path.read_bytes()
            sums.update(f"{room} {path.relative_to(folder).as_posix()} {len(content)}\n".encode() + content)
    return sums.hexdigest()[:_DIGITS]


def processor() -> str:
    """The type of this processor, and its instructions that numpy has functions of its own for and uses."""
    import numpy as np

    core = "_core" if int(np.__version__.partition(".")[0]) > 1 else "core"
    numbers = import_module(f"numpy.{core}._multiarray_umath")
    used = [name for name in numbers.__cpu_dispatch__ if numbers.__cpu_features__.get(name)]
    return " ".join([platform.machine(), *used]).strip()
