"""Nothing is imported or computed that the asked-for result does not need."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
_PROBE = """
import io, json, sys
from contextlib import redirect_stdout, redirect_stderr
from gearlink.cli.main import run
status = 0
if sys.argv[1:] != ["nothing"]:
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        status = run(sys.argv[1:])
print(json.dumps([int(status), sorted(sys.modules)]))
"""


def modules_of(*arguments: str) -> set[str]:
    """Modules loaded by a command in a process of its own."""
    done = subprocess.run(
        [sys.executable, "-c", _PROBE, *arguments], capture_output=True, text=True, cwd=ROOT, check=True
    )
    status, modules = json.loads(done.stdout)
    assert status in (0, 1), arguments
    return set(modules)


def packages(modules: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in modules}


@pytest.mark.parametrize(
    "arguments",
    [
        ("synth", "dwell", "designs/candy_feed.yaml", "--format", "json"),
        ("synth", "momentary-dwell", "designs/thesis_example_3_mended.yaml", "--format", "json"),
        ("synth", "back-step", "designs/thesis_example_1.yaml", "--format", "json"),
        ("synth", "variable-speed", "designs/thesis_example_2.yaml", "--format", "json"),
        ("gear", "designs/ty460_input_gears.yaml", "--format", "json"),
        ("gear", "designs/ty460.yaml", "--format", "json"),
        ("crank", "designs/ty460_slider_crank.yaml", "--format", "json"),
        ("crank", "designs/ty460.yaml", "--format", "json"),
        ("press", "designs/ty460.yaml", "--quantity", "crank_length"),
        ("press", "designs/ty460.yaml", "--quantity", "sync_start"),
    ],
    ids=lambda arguments: "-".join(a.removesuffix(".yaml").rpartition("/")[2] for a in arguments),
)
def test_scalar_commands_import_no_numpy(arguments: tuple[str, ...]) -> None:
    found = packages(modules_of(*arguments))
    assert not found & {"numpy", "scipy", "matplotlib"}


def test_json_needs_no_rich() -> None:
    assert "rich.table" not in modules_of("synth", "dwell", "designs/candy_feed.yaml", "--format", "json")


@pytest.mark.parametrize("arguments", [("--help",), ("--version",), ("synth", "--help")])
def test_help_and_version_import_no_models(arguments: tuple[str, ...]) -> None:
    modules = modules_of(*arguments)
    assert "numpy" not in modules
    assert not {m for m in modules if m.startswith("gearlink.core.specs")}
    assert not {m for m in modules if m in ("yaml", "scipy", "matplotlib", "gearlink.cli.run")}


def test_version_imports_no_typer() -> None:
    probe = (
        "import sys; sys.argv = ['gearlink', '--version']\n"
        "from gearlink.cli.main import main; main()\n"
        "print(sorted(m for m in sys.modules if m.partition('.')[0] in ('typer', 'pydantic', 'rich', 'yaml')))"
    )
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[1] == "[]"


@pytest.mark.parametrize(
    "arguments",
    [
        ("press", "designs/ty460.yaml", "--format", "json"),
        ("cam", "designs/ty460.yaml", "--format", "json"),
        ("analyze", "designs/thesis_example_3_as_printed.yaml", "--format", "json"),
    ],
    ids=["press", "cam", "analyze"],
)
def test_sweeps_import_no_scipy_and_no_matplotlib(arguments: tuple[str, ...]) -> None:
    assert not packages(modules_of(*arguments)) & {"scipy", "matplotlib"}


def test_core_imports_no_interface() -> None:
    """One direction only: no module of core imports cli, typer, rich, yaml or matplotlib."""
    probe = (
        "import importlib, json, pkgutil, sys, gearlink.core\n"
        "for m in pkgutil.walk_packages(gearlink.core.__path__, 'gearlink.core.'):\n"
        "    importlib.import_module(m.name)\n"
        "tops = {m.partition('.')[0] for m in sys.modules}\n"
        "print(json.dumps(sorted(tops | {m for m in sys.modules if m == 'gearlink.cli'})))"
    )
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    found = set(json.loads(done.stdout))
    assert not found & {"typer", "rich", "yaml", "matplotlib", "scipy", "gearlink.cli"}
