"""The design files that folders, patterns and names on a command line stand for."""

from __future__ import annotations

import glob
import os
from collections.abc import Sequence
from pathlib import Path

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic

_ENDINGS = (".yaml", ".yml")


def design_files(places: Sequence[str]) -> list[Path]:
    """Design files named, matched by a pattern, or found below the folders named; each once, in a fixed order.

    Raises
        DesignFileError - for a place that does not exist, or folders without a design file
    """
    found: dict[Path, None] = {}
    for place in places:
        path = Path(place)
        matched = [path] if path.exists() else sorted(Path(name) for name in glob.glob(place, recursive=True))
        if not matched:
            raise DesignFileError([Diagnostic("GL101", "no such file or folder", file=place)])
        for match in matched:
            found.update(dict.fromkeys(_below(match) if match.is_dir() else [match]))
    if not found:
        message = f"no design file ({', '.join(_ENDINGS)}) below"
        raise DesignFileError([Diagnostic("GL101", message, file=", ".join(places))])
    return list(found)


def _below(folder: Path) -> list[Path]:
    found: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        place = Path(root)
        wanted = (place / name for name in names if name.endswith(_ENDINGS) and not name.startswith("."))
        found += [path for path in wanted if path.is_file()]
    return sorted(found, key=lambda path: path.parts)
