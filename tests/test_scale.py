"""A design keeps its digits in other units of length, time and mass: an absolute limit inside a kernel would show.

All lengths are multiplied by 16, times by 4 and masses by 256. These are powers of two, which change no digit of a
number, and leave gravity and N/mm^2 as they are. So every quantity and check of the large, slow machine is that of the
example times the power of its unit: exactly where no root or power of a length is taken, within 1e-12 anyway. What a
standard lists by sizes in mm (pins, allowances) is no part of it, nor are the residues of a check of the program.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import factory
import pytest
from sweeps import mostly_slow

from gearlink.cli.texts.schema import kind_schema
from gearlink.core.base.kinds import KINDS

LENGTH, MASS, TIME = 16.0, 256.0, 4.0
UNITS = {
    "mm": LENGTH,
    "kg": MASS,
    "s": TIME,
    "ms": TIME,
    "mm/rad": LENGTH,
    "mm/rad^2": LENGTH,
    "mm/rad^3": LENGTH,
    "h": TIME,
    "1/min": 1.0 / TIME,
    "sheets/h": 1.0 / TIME,
    "Hz": 1.0 / TIME,
    "rad/s": 1.0 / TIME,
    "rad/s^2": 1.0 / TIME**2,
    "mm/s": LENGTH / TIME,
    "mm/s^2": LENGTH / TIME**2,
    "N": MASS * LENGTH / TIME**2,
    "N/mm": MASS / TIME**2,
    "N m": MASS * LENGTH**2 / TIME**2,
    "N m/rad": MASS * LENGTH**2 / TIME**2,
    "N m s": MASS * LENGTH**2 / TIME,
    "J": MASS * LENGTH**2 / TIME**2,
    "W": MASS * LENGTH**2 / TIME**3,
    "kg m^2": MASS * LENGTH**2,
    "kg mm": MASS * LENGTH,
    "mm^6": LENGTH**6,
}
ALIKE = {"1", "deg", "teeth", "rows", "N/mm^2", "m/s^2", "rad/rad", "rad/rad^2", "1/rad", "1/rad^2"}
RESIDUES = ("identity", "agreement", "residual")

CASES = [
    ("slider_crank_quick_return", "crank"),
    ("five_bar_points", "analyze"),
    ("wide_swing_parallel", "loads"),
    ("ty460", "press"),
    ("swing_gripper", "gripper"),
    ("planar_watt", "analyze"),
    ("barrel_cam", "cam"),
    ("belt_feed", "synth dwell"),
    ("candy_feed", "synth dwell"),
    ("crank_rocker", "synth swing"),
    ("crank_rocker_links", "loads"),
    ("five_bar_path", "analyze"),
    ("five_bar_positions", "analyze"),
    ("geared_six_bar", "analyze"),
    ("geneva_drive", "analyze"),
    ("hypocycloid_slider", "analyze"),
    ("lift_cam", "cam"),
    ("cam_gear", "analyze"),
    ("cam_linkage", "analyze"),
    ("loaded_gripper", "loads"),
    ("loaded_feed", "loads"),
    ("loaded_wide_swing", "loads"),
    ("mutilated_gear_press", "analyze"),
    ("six_bar_swing", "analyze"),
    ("thesis_example_3_mended", "synth momentary-dwell"),
    ("thesis_example_1", "synth back-step"),
    ("thesis_example_2", "synth variable-speed"),
    ("two_gear_ring", "analyze"),
    ("ty460", "cam"),
    ("ty460_slider_crank", "crank"),
    ("wide_lever", "analyze"),
    ("wide_swing_cycle", "cam"),
    ("wide_swing_oscillating_cam", "cam"),
    ("wide_swing_slider_cam", "swing"),
    ("wide_swing_slider_drive", "loads"),
    ("wide_swing_twin_rocker", "cam"),
]


@pytest.mark.quick(3)
@pytest.mark.parametrize(("example", "command"), mostly_slow(CASES, 6))
def test_a_large_slow_heavy_machine_has_the_same_digits(example: str, command: str) -> None:
    data = factory.worked(example)
    schema = kind_schema(KINDS[data["kind"]])
    large = _scaled(data, [schema], schema.get("definitions", {}))
    one, other = (factory.design(made, command=command).report(command) for made in (data, large))
    assert one.quantities
    assert [quantity.name for quantity in one.quantities] == [quantity.name for quantity in other.quantities]
    for small, great in zip(one.quantities, other.quantities, strict=True):
        if not any(word in small.name for word in RESIDUES):
            _same(great.value, small.value, _factor(small.unit))
    assert [(check.code, check.status) for check in one.checks] == [
        (check.code, check.status) for check in other.checks
    ]


def _factor(unit: str) -> float:
    return 1.0 if unit in ALIKE else UNITS[unit]


def _same(value: Any, before: Any, factor: float) -> None:
    if isinstance(before, list):
        for one, other in zip(value, before, strict=True):
            _same(one, other, factor)
    elif isinstance(before, float):
        assert value == pytest.approx(factor * before, rel=1e-12, abs=0.0)
    else:
        assert value == before


def _scaled(value: Any, schemas: list[Any], definitions: dict[str, Any]) -> Any:
    """The data of a file with every number that has a unit scaled."""
    nodes = list(_nodes(schemas, definitions))
    if isinstance(value, list):
        return [_scaled(item, _items(nodes, k), definitions) for k, item in enumerate(value)]
    if not isinstance(value, dict):
        unit = next((node["unit"] for node in nodes if "unit" in node), "1")
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return _factor(unit) * value if number and _factor(unit) != 1.0 else value
    sections = [node["properties"] for node in nodes if "properties" in node]
    fitting = [keys for keys in sections if set(value) <= set(keys)] or sections
    others = [node["additionalProperties"] for node in nodes if isinstance(node.get("additionalProperties"), dict)]
    return {
        key: _scaled(item, [keys[key] for keys in fitting if key in keys] or others, definitions)
        for key, item in value.items()
    }


def _nodes(schemas: list[Any], definitions: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Every schema that a value may have to meet."""
    for schema in schemas:
        yield schema
        named = [definitions[schema["$ref"].rpartition("/")[2]]] if "$ref" in schema else []
        yield from _nodes(
            [*named, *(one for key in ("anyOf", "oneOf", "allOf") for one in schema.get(key, ()))], definitions
        )


def _items(nodes: list[dict[str, Any]], k: int) -> list[Any]:
    items = [node["items"] for node in nodes if "items" in node]
    each = [item for item in items if isinstance(item, dict)]
    return each or [item[k] for item in items if len(item) > k] or [{"unit": n["unit"]} for n in nodes if "unit" in n]
