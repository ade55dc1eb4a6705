"""When `studio` does not begin."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.studio import command as studio


@pytest.mark.parametrize(
    ("source", "words"),
    [
        ("nothing.yaml", "no such file"),
        ("designs", "this is a folder"),
        ("-", "not standard input"),
        ("designs/studies/dwell_feed.yaml", "open a design that it found"),
    ],
)
def test_what_it_does_not_open(gearlink: Any, source: str, words: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(studio, "find_spec", lambda _: object())
    found = gearlink("studio", source)
    assert found.status == 2
    assert words in found.err


def test_without_the_extra_it_says_how_to_install_it(
    gearlink: Any, designs: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(studio, "find_spec", lambda _: None)
    found = gearlink("studio", str(designs / "candy_feed.yaml"))
    assert found.status == 2
    assert "pip install 'nicegui>=3.18'" in found.err
