"""The project's own files: packages and disk agree."""

from __future__ import annotations

import tomllib
from pathlib import Path

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
