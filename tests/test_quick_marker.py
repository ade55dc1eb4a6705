"""`quick(count)`: so many cases of a test stay in `make test`, evenly spread from the first on; none is ever lost."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

CASES = """
import pytest

three = pytest.mark.quick(3)
numbers = pytest.mark.parametrize("i", range(10))


@three
@numbers
def test_ten(i): ...


@three
@pytest.mark.parametrize("i", [0, *(pytest.param(i, marks=pytest.mark.slow) for i in (1, 2)), *range(3, 10)])
def test_slow_ones_do_not_count(i): ...


@three
@pytest.mark.parametrize("i", [*range(8), *(pytest.param(i, marks=pytest.mark.stress) for i in (8, 9))])
def test_nor_do_those_of_stress(i): ...


@pytest.mark.quick(1)
@numbers
def test_one(i): ...


@pytest.mark.quick(20)
@numbers
def test_more_than_there_are(i): ...


class TestOther:
    @three
    @numbers
    def test_ten(self, i): ...


@three
def test_without_cases(): ...


@numbers
def test_unmarked(i): ...
"""
KEPT = {
    "test_ten": [0, 3, 6],
    "test_slow_ones_do_not_count": [0, 4, 7],  # of 0, 3, 4, 5, 6, 7, 8, 9
    "test_nor_do_those_of_stress": [0, 2, 5],
    "test_one": [0],
    "test_more_than_there_are": [*range(10)],
    "TestOther::test_ten": [0, 3, 6],
    "test_unmarked": [*range(10)],
}


def collected(folder: Path, *options: str) -> list[str]:
    """The cases that pytest would run with the conftest.py and the markers of these tests."""
    shutil.copy(ROOT / "tests" / "conftest.py", folder)
    (folder / "test_cases.py").write_text(CASES)
    command = [sys.executable, "-m", "pytest", "--collect-only", "-q", "-p", "no:cacheprovider", *options]
    command += ["-c", str(ROOT / "pyproject.toml"), "--rootdir", str(folder), str(folder / "test_cases.py")]
    ended = subprocess.run(command, capture_output=True, text=True, cwd=folder, check=True, env={**os.environ})
    return [line.partition("::")[2] for line in ended.stdout.splitlines() if "::" in line]


def quick_cases() -> list[str]:
    return sorted([*(f"{name}[{i}]" for name, kept in KEPT.items() for i in kept), "test_without_cases"])


def hooked(path: Path, text: str, request: pytest.FixtureRequest) -> list[pytest.Item]:
    """The cases that pytest makes of a module, as the hook of conftest.py leaves them."""
    path.write_text(text)
    items = list(request.session.genitems(pytest.Module.from_parent(request.session, path=path)))
    hooks = request.config.pluginmanager.get_plugin(str(ROOT / "tests" / "conftest.py"))
    hooks.pytest_collection_modifyitems(items)
    return items


def test_even_spread_of_the_cases_is_quick(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    items = hooked(tmp_path / "test_cases.py", CASES, request)
    kept = [item for item in items if not any(map(item.get_closest_marker, ("slow", "stress")))]
    assert sorted(item.nodeid.rpartition("test_cases.py::")[2] for item in kept) == quick_cases()


def test_no_test_is_slow_and_quick(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    text = "import pytest\n\n\n@pytest.mark.slow\n@pytest.mark.quick(1)\ndef test_both(): ...\n"
    with pytest.raises(pytest.UsageError, match="test_both is marked slow and quick"):
        hooked(tmp_path / "test_both.py", text, request)


@pytest.mark.slow
def test_all_cases_are_in_the_full_run(tmp_path: Path) -> None:
    assert sorted(collected(tmp_path)) == quick_cases()
    wanted = [f"{name}[{i}]" for name in KEPT for i in range(8 if name == "test_nor_do_those_of_stress" else 10)]
    assert sorted(collected(tmp_path, "-m", "not stress")) == sorted([*wanted, "test_without_cases"])
