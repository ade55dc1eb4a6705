"""What a script does to a list or an array that it was given changes no later result."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sweeps import mostly_slow

import gearlink
from gearlink.core.base.report import Table

KEEPING = ["candy_feed", "drawn_lever", "wide_lever", "swing_gripper", "five_bar_points", "belt_feed"]
"""Designs that keep lists and arrays: of places, swings, meshes, errors, intervals."""


def written_over(value: Any) -> None:
    """Spoil whatever of a result can be written to."""
    if isinstance(value, np.ndarray) and value.flags.writeable:
        value[...] = value.flat[0] if value.dtype.kind in "OU" else 77
    elif isinstance(value, (list, tuple)):
        for item in value:
            written_over(item)
        if isinstance(value, list):
            value.append(88.8)


def everything(design: Any) -> dict[str, Any]:
    """Every quantity both ways, every table, and the report."""
    found: dict[str, Any] = {}
    for name in design.quantity_names():
        for way in (design.raw, design.quantity, lambda name: getattr(design, name, None)):
            try:
                value = way(name)
            except gearlink.NoSolution as error:
                value = str(error)
            found[f"{name} {len(found)}"] = getattr(value, "value", value)
    for name in design.table_names():
        try:
            table = design.table(name, samples=7)
        except gearlink.NoSolution:
            continue
        found[name] = [*table.data, *(table[column] for column in table.columns)]
    return found


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", mostly_slow(KEEPING, 3))
def test_what_was_given_is_the_readers(designs: Path, name: str) -> None:
    design = gearlink.load(designs / f"{name}.yaml")
    before, spoilt = repr(everything(gearlink.load(designs / f"{name}.yaml"))), everything(design)
    written_over(list(spoilt.values()))
    assert repr(spoilt) != before
    assert repr(everything(design)) == before
    assert repr(everything(gearlink.load(designs / f"{name}.yaml"))) == before


def test_columns_are_the_readers_and_data_cannot_be_written_to() -> None:
    kept = np.arange(3.0)
    table = Table.of("law", {"x": (kept, "1"), "gap": ([0.5, None, 2], "mm"), "way": (["a", None, "b"], "1")})
    table["x"][:] = 9.0
    assert table["x"].tolist() == kept.tolist() == [0.0, 1.0, 2.0]
    with pytest.raises(ValueError, match="read-only"):
        table.data[0][0] = 9.0  # type: ignore[index]  # what a script would try
    kept[0] = 0.25  # whose array it was may write to it
    assert table["gap"].dtype == float
    assert np.isnan(table["gap"][1])
    assert table["way"].tolist() == ["a", None, "b"]
