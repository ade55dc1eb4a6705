"""The project's own files: packages and disk agree."""

from __future__ import annotations

import tomllib
from pathlib import Path

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
