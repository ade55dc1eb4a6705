"""What tells two programs apart that may compute different last digits."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from gearlink.cli import program


@pytest.fixture
def source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Code of our own instead of the program's."""
    (tmp_path / "core" / "gears").mkdir(parents=True)
    (tmp_path / "cli").mkdir()
    (tmp_path / "core" / "gears" / "mesh.py").write_text("LIMIT = 1.1\n")
    (tmp_path / "cli" / "app.py").write_text("")
    rooms = {f"gearlink.{name}": SimpleNamespace(__path__=[str(tmp_path / name)]) for name in ("core", "cli")}
    monkeypatch.setattr(program, "import_module", rooms.__getitem__)
    return tmp_path / "core" / "gears" / "mesh.py"


def code() -> str:
    program.code.cache_clear()
    try:
        return program.code()
    finally:
        program.code.cache_clear()


def test_other_code_of_the_same_version_is_another_program(source: Path) -> None:
    before = code()
    assert code() == before
    source.write_text("LIMIT = 5.1\n")
    other = code()
    source.rename(source.with_name("meshes.py"))
    moved = code()
    source.with_name("meshes.py").rename(source)
    source.write_text("LIMIT = 1.1\n")
    os.utime(source, (0, 0))
    assert len({before, other, moved}) == 3
    assert code() == before, "times of files do not count"


def test_code_that_cannot_be_read_is_the_same_as_no_other(source: Path) -> None:
    source.unlink()
    assert code() != code()


@pytest.mark.parametrize(
    ("dispatched", "has", "named"),
    [
        (["SSE3", "AVX2", "AVX512F"], {"SSE3": True, "AVX2": True, "AVX512F": False}, "x86_64 SSE3 AVX2"),
        (["X86_V3", "X86_V4"], {"AVX2": True, "X86_V3": False}, "x86_64"),  # switched off for numpy
        ([], {"ASIMD": True}, "x86_64"),
    ],
)
def test_a_processor_is_named_by_what_numpy_uses_of_it(
    monkeypatch: pytest.MonkeyPatch, dispatched: list[str], has: dict[str, bool], named: str
) -> None:
    numbers = SimpleNamespace(__cpu_dispatch__=dispatched, __cpu_features__=has)
    monkeypatch.setattr(program, "import_module", lambda _: numbers)
    monkeypatch.setattr("platform.machine", lambda: "x86_64")
    assert program.processor() == named


@pytest.mark.slow
def test_what_numpy_is_told_to_leave_out_counts() -> None:
    """Switched off, other kernels of numpy compute; what the processor has stays the same."""
    *_, last = ["", *program.processor().split()[1:]]
    if not last:
        pytest.skip("numpy uses nothing here that could be switched off")
    words = [sys.executable, "-c", "from gearlink.cli.program import processor; print(processor())"]
    environment = {**os.environ, "NPY_DISABLE_CPU_FEATURES": last}
    found = subprocess.run(words, env=environment, capture_output=True, text=True, check=True).stdout.strip()
    assert found != program.processor()
