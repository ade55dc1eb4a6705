"""Long tables as CSV: computed and written a part at a time, the same rows as at once.

The rows are compared exactly: each stands alone, so a part holds the same doubles as the whole. Of planar mechanisms
each row is where Newton's steps end that begin at a place near by, another one in a part: they end within rounding
times the condition of the joints, below 1e-12 of the table's maximum in the column's unit. So are those of measured
cams, whose series are summed by a matrix product, which rounds by the number of rows.
"""

from __future__ import annotations

from itertools import compress
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from factory import each_kind
from sweeps import mostly_slow

import gearlink.core.base.design
from gearlink.cli.evaluate import open_design, read_spec
from gearlink.cli.options import Options
from gearlink.core.base.design import Design
from gearlink.core.base.errors import GearlinkError
from gearlink.core.base.report import Table, TableInParts

DESIGNS = sorted((Path(__file__).resolve().parents[2] / "designs").glob("*.yaml"))
SIZES = (37, 43)


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Lengths of the tables that are computed, parts being of 37 or 43 rows."""
    lengths: list[int] = []
    table = Design.table

    def counted(self: Design, name: str, *, samples: int | None = None) -> Table:
        made = table(self, name, samples=samples)
        lengths.append(made.length)
        return made

    monkeypatch.setattr(gearlink.core.base.design, "_PART_SIZES", SIZES)
    monkeypatch.setattr(Design, "table", counted)
    return lengths


def _require_near(whole: Table, parts: TableInParts) -> None:
    """Words and gaps alike, numbers within 1e-12 of the largest of their unit."""
    one, other = ([value for row in table.each_row() for value in row] for table in (parts, whole))
    units = [*whole.units] * whole.length
    numbers = [isinstance(value, float) for value in other]
    assert [a for a, is_number in zip(one, numbers, strict=True) if not is_number] == [
        b for b, is_number in zip(other, numbers, strict=True) if not is_number
    ]
    for unit in {*units}:
        own = [is_number and each == unit for each, is_number in zip(units, numbers, strict=True)]
        a, b = (np.array([*compress(values, own)]) for values in (one, other))
        largest = np.abs(b[np.isfinite(b)]).max(initial=0.0)
        np.testing.assert_allclose(a, b, rtol=0.0, atol=1e-12 * largest, err_msg=whole.name)


@pytest.mark.quick(1)
@pytest.mark.parametrize("path", each_kind(DESIGNS), ids=lambda path: path.stem)
@pytest.mark.usefixtures("asked")
def test_parts_hold_the_rows_of_the_whole(path: Path) -> None:
    loaded, kind = open_design(str(path), Options())
    spec = read_spec(loaded, kind, str(path))
    for command in spec.commands():
        design = kind.design(command, spec)
        for name in design.table_names():
            try:
                whole = design.table(name, samples=3 * 37)  # 37 leaves no last part: 43 has to serve
            except GearlinkError:  # a table that this design does not have
                continue
            parts = design.table_in_parts(name, 3 * 37)
            assert (parts.columns, parts.units) == (whole.columns, whole.units)
            if kind.name in ("planar-mechanism", "measured-cam"):
                _require_near(whole, parts)
            else:
                assert list(map(tuple, parts.each_row())) == list(map(tuple, whole.each_row())), name


def test_a_table_as_long_as_a_part_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """One of fixed length was taken for the first of many parts, each of them the whole again, without an end."""
    design = factory.design("ring_feed", command="synth dwell")
    whole = design.table("drawing")
    monkeypatch.setattr(gearlink.core.base.design, "_PART_SIZES", (whole.length,))
    made = design.table_in_parts("drawing", 2 * whole.length + 1)
    assert not isinstance(made, TableInParts)
    assert made.rows() == whole.rows()


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("command", "file"),
    mostly_slow(
        [
            ("analyze", "two_gear_drag_link"),
            ("cam", "ty460"),
            ("gripper", "swing_gripper"),
            ("analyze", "five_bar_path"),
            ("analyze", "five_bar_positions"),
            ("analyze", "hypocycloid_slider"),
            ("analyze", "mutilated_gear_press"),
            ("swing", "wide_swing_slider"),
            ("cam", "wide_swing_cycle"),
        ],
        4,
    ),
)
def test_no_more_than_a_part_is_held(gearlink: Any, asked: list[int], command: str, file: str) -> None:
    path = DESIGNS[0].parent / f"{file}.yaml"
    csv = gearlink(command, path, "--samples", 500, "--format", "csv").out
    assert asked
    assert max(asked) <= max(SIZES)
    asked.clear()
    table = gearlink(command, path, "--samples", 500, "--format", "md").out
    assert max(asked) >= 500
    assert csv.count("\n") > 500
    assert table


def test_a_short_table_is_computed_once(gearlink: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[Any] = []
    table = Design.table
    monkeypatch.setattr(Design, "table", lambda *a, **k: calls.append(k) or table(*a, **k))
    gearlink("analyze", DESIGNS[0].parent / "two_gear_drag_link.yaml", "--samples", 720, "--format", "csv")
    assert len(calls) == 1


def test_long_tables_are_read_as_often_as_asked() -> None:
    part = Table("t", ("x",), ("1",), ((1.0, 2.0),))
    whole = TableInParts("t", ("x",), ("1",), part.data, lambda: iter([part, part]))
    assert whole.rows() == whole.rows() == [[1.0], [2.0], [1.0], [2.0]]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "table"),
    [("geared_six_bar", "links"), ("geared_six_bar", "joints"), ("five_bar_path", "path"), ("swing_gripper", "tip")],
)
def test_rows_do_not_depend_on_how_many_there_are(file: str, table: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """From 256 KiB on numpy turns products with a temporary array round, which rounds complex ones otherwise."""
    monkeypatch.setattr(gearlink.core.base.design, "_PART_SIZES", (5003,))
    made = factory.design(file)
    whole, parts = made.table(table, samples=17_011), made.table_in_parts(table, 17_011)
    assert list(map(tuple, parts.each_row())) == list(map(tuple, whole.each_row()))
