"""When `watch` makes its page anew: on each change of the file, and where the file stays away."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.commands import watch
from gearlink.cli.options import Options


def test_a_file_that_stays_away_is_told_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path, looks, made = tmp_path / "design.yaml", 0, []

    def stamp(_: Path) -> Any:
        nonlocal looks
        looks += 1
        if looks > 400:
            raise KeyboardInterrupt
        away = looks % 100 < watch._GONE - 5 if looks < 200 else looks < 350  # for a moment; for long
        return None if away else (1, 2, 3)

    def make(_: Any) -> str:
        made.append(looks)
        return ""

    monkeypatch.setattr(watch, "_EVERY", 0.0)
    monkeypatch.setattr(watch, "_stamp", stamp)
    with pytest.raises(KeyboardInterrupt):
        watch._follow(path, make, Options())
    assert made == [watch._GONE - 5, 200 + watch._GONE - 1, 350]
