"""The project's own files: packages and disk agree."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
from least_versions import _least, least_versions

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text())


PLACES = {
    name: PROJECT["tool"]["setuptools"]["package-dir"].get(name, name.removeprefix("gearlink.").replace(".", "/"))
    for name in PROJECT["tool"]["setuptools"]["packages"]
}


def test_packages_are_those_on_the_disk() -> None:
    on_disk = {
        path.parent.relative_to(ROOT).as_posix()
        for top in ("core", "cli", "designs")
        for path in (ROOT / top).rglob("*.py")
    }
    assert set(PLACES.values()) == on_disk


def test_every_package_has_an_init() -> None:
    assert [name for name, place in PLACES.items() if not (ROOT / place / "__init__.py").exists()] == []


def test_no_test_package() -> None:
    """With import-mode=importlib a tests/__init__.py would give modules two names."""
    assert not list((ROOT / "tests").rglob("__init__.py"))


def test_every_library_has_a_least_version() -> None:
    """`make test-least` tries them; the reader refuses a requirement without a lower bound."""
    found = least_versions()
    assert len(found) == len(PROJECT["project"]["dependencies"]) + 2
    assert "numpy==2.0" in found
    for requirement in ("numpy", "numpy<3", "numpy~=2.0", "numpy>=2.0.*"):
        with pytest.raises(ValueError, match="has no lower bound"):
            _least(requirement)


def test_nobody_is_told_to_install_another_project_s_package() -> None:
    """`gearlink` on PyPI is another program, and this one is not there under any name: it is installed from a path."""
    files = [path for ending in ("*.md", "*.yml", "*.yaml") for path in ROOT.glob(ending)]
    files += [path for top in ("docs", "cli", "core", ".github") for path in (ROOT / top).rglob("*.*")]
    texts = {path: path.read_text(encoding="utf-8") for path in files if path.suffix in (".md", ".py", ".yml", ".yaml")}
    assert len(texts) > 300
    wrong = re.compile(r"pip install (-[-\w]+ )*['\"]?gearlink(-design)?\b(?!_)")
    assert [path.name for path, text in texts.items() if wrong.search(text)] == []
    assert wrong.search("pip install --quiet 'gearlink-design[step]'")
    assert wrong.search("pip install gearlink")
