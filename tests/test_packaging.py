"""The project's own files: packages and disk agree, the project speaks of itself alone."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


def test_packages_are_those_on_the_disk() -> None:
    on_disk = {
        "gearlink." + str(path.parent.relative_to(ROOT)).replace("/", ".")
        for top in ("core", "cli", "designs")
        for path in (ROOT / top).rglob("*.py")
    }
    assert set(PROJECT["tool"]["setuptools"]["packages"]) == on_disk


def test_every_package_has_an_init() -> None:
    for name in PROJECT["tool"]["setuptools"]["packages"]:
        assert (ROOT / name.removeprefix("gearlink.").replace(".", "/") / "__init__.py").exists()


def test_no_test_package() -> None:
    """With import-mode=importlib a tests/__init__.py would give modules two names."""
    assert not list((ROOT / "tests").rglob("__init__.py"))


@pytest.mark.parametrize("word", ["\\.\\./shared", "/work/", "acceptance tool", "subagent", "copilot"])
def test_the_project_speaks_of_itself(word: str) -> None:
    files = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False).stdout.split(
        "\n"
    )
    texts = [ROOT / f for f in files if f and Path(f).suffix in {".py", ".md", ".yaml", ".toml", ".json", ""}]
    found = [
        str(p) for p in texts if p.is_file() and p != Path(__file__) and re.search(word, p.read_text(), re.IGNORECASE)
    ]
    assert not found
