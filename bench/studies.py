"""Designs a second of studies: many at once against one by one."""

from __future__ import annotations

import json
from functools import partial
from typing import Any

import numpy as np

from bench.timing import Family, Method, Row, measure, numpy_pass
from gearlink.core.studies.explore.chunks import chunk_of, evaluated, one_by_one
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.explore.problem import CHUNK, Problem
from gearlink.core.studies.study.spec import StudySpec

_GEARS = {
    "gears.crank": {"from": 20, "to": 60, "also": ["gears.output"]},
    "gears.idler": {"from": 1, "to": 4, "times": "gears.crank"},
    "gears.module": {"values": [1.5, 2, 2.5, 3, 4]},
}
_TASKS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "synth dwell": ({"dwell": {"angle": 135}}, {"dwell.angle": {"from": 60, "to": 180, "step": 8}}),
    "synth back-step": ({"back_step": {"angle": 20}}, {"back_step.angle": {"from": 5, "to": 35, "step": 2}}),
    "synth momentary-dwell": (
        {"momentary": {"eccentricity": 30}},
        {"momentary.eccentricity": {"from": 12, "to": 27, "step": 1}},
    ),
    "analyze": ({"links": {"crank": 38.9, "frame": 153.5}}, {"links.frame": {"from": 120, "to": 270, "step": 10}}),
    "synth variable-speed": ({"speed": {"min": 100, "max": 300}}, {"speed.min": {"from": 0, "to": 150, "step": 10}}),
}
_OTHERS: dict[str, dict[str, Any]] = {
    "gear pairs by distance": {
        "design": {"kind": "gear-pair", "module": 2.5, "teeth": [26, 53], "center_distance": 100},
        "variables": {
            "teeth[0]": {"from": 20, "to": 28},
            "teeth[1]": {"from": 46, "to": 54},
            "center_distance": {"from": 94, "to": 103, "step": 0.1},
            "shift_split": {"from": -0.2, "to": 0.6, "step": 0.05},
        },
        "minimize": {"specific_sliding[0]": 0.05},
        "maximize": {"contact_ratio": 0.02, "tip_thickness[0]": 0.1},
    },
    "pinions in rings": {
        "design": {"kind": "gear-pair", "module": 2.5, "teeth": [26, -67], "profile_shift": [0.3, -0.3]},
        "variables": {
            "teeth[0]": {"from": 20, "to": 40},
            "teeth[1]": {"from": -90, "to": -60},
            "profile_shift[0]": {"from": -0.2, "to": 0.6, "step": 0.05},
            "profile_shift[1]": {"from": -0.6, "to": 0.2, "step": 0.05},
        },
        "minimize": {"specific_sliding[0]": 0.05},
        "maximize": {"contact_ratio": 0.02, "tip_fouling_margin": 0.1},
    },
    "slider-cranks, sizes": {
        "design": {"kind": "slider-crank", "stroke": 300, "rod": 500, "limits": {"transmission_angle": 40}},
        "variables": {
            "stroke": {"from": 100, "to": 700, "step": 1},
            "rod": {"from": 300, "to": 900, "step": 5},
            "offset": {"from": -100, "to": 100, "step": 10},
        },
        "minimize": {"crank_length": 1, "quick_return_ratio": 0.01},
        "maximize": {"min_transmission_angle": 1},
    },
}
_OTHERS["slider-cranks, motion"] = {**_OTHERS["slider-cranks, sizes"], "minimize": {"acceleration_max": 1}}
_FEW = 50


def family(quick: bool) -> Family:
    """The table of the family; the error is the maximum difference of any quantity from the design class's."""
    methods = []
    studies = {command: _study(command) for command in _TASKS}
    studies["synth dwell, idler sought"] = _study("synth dwell", idler=False)
    studies |= {name: _problem({**given, "command": "analyze"}) for name, given in _OTHERS.items()}
    for command, made in studies.items():
        size = CHUNK // (4 if quick else 1)
        columns = made.order.columns(np.arange(size) * (made.order.count // size))
        few = made.order.columns(np.arange(_FEW) * (CHUNK // _FEW) * (made.order.count // CHUNK))  # the same if quick
        off = _difference(made, few)
        methods.append(Method(f"{command}, at once", size, partial(evaluated, made, columns), off))
        methods.append(Method(f"{command}, by class", _FEW, partial(one_by_one, made, few), 0.0))
        if command == "synth dwell":
            methods.append(Method("the same with its front", CHUNK, partial(chunk_of, made, 7), off))
    rows: tuple[Row, ...] = measure(methods, numpy_pass(CHUNK), CHUNK, 3)
    return Family(
        "studies",
        "Studies of three-gear four-bars, gear pairs, slider-cranks: required quantities and all checks of a design",
        "relative",
        "one numpy pass of sin + cos + arctan2 + sqrt over 8192 numbers",
        rows,
        ("statuses and errors are those of the design class; it computes the designs next to a limit",),
    )


def _study(command: str, *, idler: bool = True) -> Problem:
    section, variable = _TASKS[command]
    gears = {"module": 2, "crank": 40, "output": 40, **({"idler": 72} if idler else {})}
    variables = {path: values for path, values in _GEARS.items() if idler or path != "gears.idler"}
    data = {
        "design": {"kind": "three-gear-four-bar", "gears": gears, **section},
        "command": command,
        "variables": {**variables, **variable},
        "minimize": {"frame_length": 10, "speed_ratio_max": 0.1},
        "maximize": {"min_transmission_angle": 2},
    }
    return _problem(data)


def _problem(data: dict[str, Any]) -> Problem:
    return problem(StudySpec.model_validate_json(json.dumps({"kind": "study", **data})))


def _difference(made: Problem, columns: Any) -> float:
    many, single = evaluated(made, columns), one_by_one(made, columns)
    worst = 0.0
    for name in made.names:
        a, b = many.quantities[name], single.quantities[name]
        worst = max(worst, float(np.nanmax(np.abs(a - b) / np.maximum(1.0, np.abs(b)))))
    return worst
