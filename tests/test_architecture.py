"""docs/architecture.md against the modules that exist: each has a room, and each room that is named exists."""

from __future__ import annotations

import re
from fnmatch import fnmatchcase
from pathlib import Path

ROOT = Path(__file__).parents[1]


def rooms() -> list[str]:
    """The files and folders that the table names, each with its folder; a name without one stands in that before it."""
    named: list[str] = []
    for line in (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8").splitlines():
        folder = ""
        for name in re.findall(r"`([^`]+)`", line.split("|")[1]) if line.startswith("| `") else []:
            folder = name.rpartition("/")[0] if "/" in name else folder
            named.append(name if "/" in name else f"{folder}/{name}")
    return named


def test_every_module_has_a_room() -> None:
    named = rooms()
    modules = [
        path.relative_to(ROOT).as_posix()
        for folder in ("core", "cli")
        for path in (ROOT / folder).rglob("*.py")
        if path.name != "__init__.py"
    ]
    homeless = [
        module
        for module in modules
        if not any(module.startswith(room) if room.endswith("/") else fnmatchcase(module, room) for room in named)
    ]
    assert homeless == []


def test_every_room_exists() -> None:
    assert [room for room in rooms() if not list(ROOT.glob(room))] == []
