"""docs/python.md is run as it is printed, from the root of the repository."""

from __future__ import annotations

import doctest
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


def test_every_block_of_the_page_holds(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    page = ROOT / "docs" / "python.md"
    results = doctest.testfile(str(page), module_relative=False)
    assert results.failed == 0
    assert results.attempted == page.read_text().count("\n>>> ")


@pytest.mark.slow
def test_the_blocks_of_the_page_pass_a_strict_type_checker(tmp_path: Path) -> None:
    """As a script of someone who has gearlink installed."""
    blocks = doctest.DocTestParser().get_examples((ROOT / "docs" / "python.md").read_text())
    script = tmp_path / "script.py"
    script.write_text("".join(block.source for block in blocks))
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), str(script)]
    checked = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert checked.returncode == 0, checked.stdout
