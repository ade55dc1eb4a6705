"""Property tests try the same examples in every run, whatever modules the process has loaded before."""

import importlib.util
import inspect
import sys

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.internal.cache import LRUCache
from hypothesis.internal.conjecture import providers

NUMBERS = "NUMBERS = [{}]\n".format(", ".join(f"{1000.0 + 0.25 * n}, {5000 + n}" for n in range(200)))


def examples():
    """The examples that a property test gets."""
    seen = []

    @settings(max_examples=100, derandomize=True, database=None)
    @given(st.floats(0.0, 1e5), st.integers(0, 10**5))
    def collect(number, count):
        seen.append((number, count))

    collect()
    return seen


def load_numbers(tmp_path, monkeypatch):
    """Import a module full of numbers that stands outside the tests, as those of the program do."""
    path = tmp_path / "numbers_of_a_program.py"
    path.write_text(NUMBERS)
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    monkeypatch.setitem(sys.modules, path.stem, module)


def test_examples_do_not_depend_on_loaded_modules(tmp_path, monkeypatch):
    before = examples()
    load_numbers(tmp_path, monkeypatch)
    assert examples() == before


@pytest.mark.slow
def test_they_would_if_hypothesis_were_left_to_itself(tmp_path, monkeypatch):
    """So the test above can fail: this is what conftest.py switches off."""
    before = examples()
    # a process that loads conftest.py twice wraps it twice
    monkeypatch.setattr(providers, "_get_local_constants", inspect.unwrap(providers._get_local_constants))
    monkeypatch.setattr(providers, "CONSTANTS_CACHE", LRUCache(1024))
    # as in a process in which nothing has been looked for: modules are known by their address, which may come again
    monkeypatch.setattr(providers, "_seen_modules", set())
    monkeypatch.setattr(providers, "_sys_modules_len", None)
    load_numbers(tmp_path, monkeypatch)
    assert examples() != before
