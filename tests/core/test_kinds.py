"""The record of a kind: every place in it is there, and it alone says what belongs to the kind."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from gearlink import designs
from gearlink.core.base.kind import Kind, load
from gearlink.core.base.kinds import FILES, KINDS
from gearlink.core.base.report import Rule

ROOT = Path(__file__).parents[2]


@pytest.mark.parametrize("kind", FILES.values(), ids=lambda kind: kind.name)
def test_what_a_record_names_is_there(kind: Kind) -> None:
    assert kind.summary
    assert kind.spec_model().model_fields["kind"].annotation.__args__ == (kind.name,)
    for command, place in kind.commands.items():
        assert not place or kind.design_class(command).kind == kind.name
    for place in (kind.picture, kind.scene, kind.profiles, *kind.all_sheets.values()):
        assert not place or callable(load(place)), place
    assert kind.picture
    assert callable(kind.axis_maker()) is bool(kind.array)
    assert callable(kind.samples_maker()) is bool(kind.samples)
    if kind.codes:
        assert any(
            isinstance(rule, Rule) for rule in vars(import_module(f"gearlink.core.{kind.folder}.{kind.codes}")).values()
        )
    stem = kind.worked or kind.name.replace("-", "_")
    assert not kind.worked or (Path(str(designs.__file__)).parent / f"{stem}.yaml").exists()


@pytest.mark.parametrize("kind", KINDS.values(), ids=lambda kind: kind.name)
def test_outputs_are_columns_of_tables(kind: Kind) -> None:
    """That the columns are there, tests/core/tolerance_study/test_band.py holds."""
    assert set(kind.outputs) <= set(kind.design_class("analyze").table_names())
    assert bool(kind.register_at) is (kind.name != "machine")  # which has its print at an angle


def test_a_record_imports_nothing() -> None:
    code = (
        "import sys, gearlink.core.base.kinds; print(*(name for name in sys.modules if name.startswith('gearlink.')))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert set(done.stdout.split()) == {
        "gearlink.core",
        "gearlink.core.base",
        "gearlink.core.base.kind",
        "gearlink.core.base.kinds",
    }


def _keys(path: Path) -> Iterator[str]:
    """Words that are keys of a dict of a module; as text first, for to parse takes longer."""
    text = path.read_text(encoding="utf-8")
    if any(f'"{name}":' in text for name in KINDS):
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Dict):
                yield from (key.value for key in node.keys if isinstance(key, ast.Constant) and key.value in KINDS)


def test_no_other_module_keeps_a_list_by_kind() -> None:
    files = [path for top in ("core", "cli") for path in (ROOT / top).rglob("*.py")]
    assert {str(path): found for path in files if (found := [*_keys(path)])} == {}
