"""The project's own files: packages and disk agree."""

from __future__ import annotations

import os
import re
import subprocess
import tomllib
from pathlib import Path

import pytest
from least_versions import _least, least_versions
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

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
    assert len(found) == len(PROJECT["project"]["dependencies"]) + 1
    assert "numpy==2.0" in found
    for requirement in ("numpy", "numpy<3", "numpy~=2.0", "numpy>=2.0.*"):
        with pytest.raises(ValueError, match="has no lower bound"):
            _least(requirement)


# The lock files

LOCKS = ("development", "program")
PYTHONS = ("3.11", "3.12", "3.13", "3.14", "3.15")


def locked(name: str) -> list[Requirement]:
    """What a lock file names, without the hashes."""
    text = (ROOT / "locks" / f"{name}.txt").read_text().replace("\\\n", " ")
    return [Requirement(line.partition("--hash")[0]) for line in text.splitlines() if line[:1] not in ("", "#", " ")]


def asked_for(name: str) -> list[Requirement]:
    """What pyproject.toml asks for, of the libraries that a lock file is made for."""
    project = PROJECT["project"]
    dev = project["optional-dependencies"]["dev"] if name == "development" else []
    return [Requirement(each) for each in (*project["dependencies"], *dev, *PROJECT["dependency-groups"]["build"])]


@pytest.mark.parametrize("python", PYTHONS)
@pytest.mark.parametrize("name", LOCKS)
def test_the_lock_has_one_version_of_each_library_that_is_allowed(name: str, python: str) -> None:
    """`make lock` renews it after a change of pyproject.toml."""
    here = {"python_version": python, "python_full_version": f"{python}.0", "sys_platform": "linux"}
    found = {}
    for each in locked(name):
        if each.marker is None or each.marker.evaluate(here):
            assert canonicalize_name(each.name) not in found
            (found[canonicalize_name(each.name)],) = (pin.version for pin in each.specifier)
    for wanted in asked_for(name):
        assert wanted.specifier.contains(found[canonicalize_name(wanted.name)]), wanted


@pytest.mark.parametrize("name", LOCKS)
def test_every_file_of_the_lock_has_a_hash_and_comes_from_the_usual_index(name: str) -> None:
    text = (ROOT / "locks" / f"{name}.txt").read_text()
    entries = [line for line in text.replace("\\\n", " ").splitlines() if line[:1] not in ("", "#", " ")]
    entry = re.compile(r"[\w.-]+==[\w.+!-]+( ; .+?)?( +--hash=sha256:[0-9a-f]{64})+")
    assert [line for line in entries if not entry.fullmatch(line)] == []
    assert len(entries) == len(locked(name)) > 20
    assert not re.search(r"://|index|find-links", text)


def test_the_program_is_installed_with_the_versions_that_the_tests_have() -> None:
    assert {str(each) for each in locked("program")} < {str(each) for each in locked("development")}
    assert "pytest" not in {each.name for each in locked("program")}


def test_what_builds_the_project_is_locked_too() -> None:
    """The editable installation takes it from the environment: build isolation would fetch what nobody has tried."""
    assert PROJECT["dependency-groups"]["build"] == PROJECT["build-system"]["requires"]


def test_a_changed_lock_renews_the_environment() -> None:
    usual = {name: value for name, value in os.environ.items() if not name.startswith("MAKE")}
    rules = subprocess.run(["make", "-pn", "demo"], cwd=ROOT, env=usual, capture_output=True, text=True, check=True)
    (ready,) = re.findall(r"^\.venv/\.ready: (.+)$", rules.stdout, re.MULTILINE)
    assert ready.split() == ["pyproject.toml", "locks/development.txt"]


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
