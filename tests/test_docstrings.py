"""The examples in docstrings give what they say."""

import doctest
from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
MODULES = [
    path.relative_to(ROOT).with_suffix("").as_posix().replace("/", ".").removesuffix(".__init__")
    for top in ("core", "cli")
    for path in sorted((ROOT / top).rglob("*.py"))
    if ">>> " in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_docstrings(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # Each docstring's debugger looks at the times of all files that were ever quoted: half of the time.
    monkeypatch.setattr("linecache.checkcache", lambda _=None: None)
    found = doctest.testmod(import_module(f"gearlink.{name}"))
    assert found.attempted > 0
    assert found.failed == 0
