"""Samples of tolerance studies: drives as manufactured, many at once against one by one."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from bench.timing import Family, Method, Row, measure, numpy_pass
from gearlink.core.base.design import in_unit
from gearlink.core.base.nomenclature import term
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.register import ThreeGearSamples
from gearlink.core.machines.three_gear.spec import ThreeGearSpec

_FEW = 12
_ASKED = ("speed_ratio_min", "back_step_angle", "dwell_swing", "dwell_angle", "tolerance_dwell_angle")
_DEVIATION = 0.0067  # mm: limits of +-0.02 at three of it
_KEYS = ("links.crank", "links.frame", "centers.crank_idler", "centers.idler_output")


def family(quick: bool) -> Family:
    """The table of the family; the error is the maximum difference from drives computed one by one."""
    axis, size = ThreeGearSamples(_drive()), 2048 if quick else 8192
    columns = _columns(axis, size)
    few = {key: column[:: size // _FEW][:_FEW] for key, column in columns.items()}
    methods = []
    for name in _ASKED:
        off = _difference(axis, few, name)
        methods.append(Method(f"{name}, at once", size, partial(axis.evaluate, columns, (name,)), off))
    methods.append(Method("back_step_angle, by class", _FEW, partial(_alone, axis, few, "back_step_angle"), 0.0))
    rows: tuple[Row, ...] = measure(methods, numpy_pass(size), size, 3)
    return Family(
        "samples",
        "Samples of a three-gear drive as manufactured: one quantity and all checks",
        "relative",
        f"one numpy pass of sin + cos + arctan2 + sqrt over {size} numbers",
        rows,
        ("crank, frame and both centre distances +-0.02 mm; the checks of the drive are evaluated for every sample",),
    )


def _drive() -> ThreeGearFourBar:
    gears = {"module": 2.0, "crank": 40, "idler": 72, "output": 40}
    links = {"crank": 38.942, "frame": 153.53}
    data = {"kind": "three-gear-four-bar", "gears": gears, "links": links, "dwell_tolerance": 0.5}
    return ThreeGearFourBar(ThreeGearSpec.model_validate(data))


def _columns(axis: ThreeGearSamples, size: int) -> dict[str, Any]:
    nominal = axis.nominal
    sizes = (nominal.crank_length, nominal.frame_length, nominal.coupler_length, nominal.rocker_length)
    off = np.random.default_rng(1).normal(size=(len(_KEYS), size)) * _DEVIATION
    return {key: length + part for key, length, part in zip(_KEYS, sizes, off, strict=True)}


def _alone(axis: ThreeGearSamples, columns: dict[str, Any], name: str) -> list[float]:
    count = len(columns[_KEYS[0]])
    made = (axis.design({key: column[i] for key, column in columns.items()}) for i in range(count))
    return [in_unit(one.raw(name), term(name).unit) for one in made]


def _difference(axis: ThreeGearSamples, columns: dict[str, Any], name: str) -> float:
    many = axis.evaluate(columns, (name,)).quantities[name]
    single = np.array(_alone(axis, columns, name))
    return float(np.max(np.abs(many - single) / np.maximum(1.0, np.abs(single))))
