"""Chunks are freed with their last user: what waits for the collector is few objects to it, and may be many MB.

1.9 MB a chunk waited for it: a worker grew by 1.2 GB over ten million designs.
"""

from __future__ import annotations

import gc
import json
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from gearlink.core.studies.explore.chunks import chunk_of
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.study.spec import StudySpec

FEED = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40}}
LINKS = {"crank": 38.857, "frame": 153.552}
PAIR = {"kind": "gear-pair", "module": 2, "teeth": [20, 40], "profile_shift": [0.2, 0.1]}
MODULE = {"module": {"from": 1, "to": 5}}
GEARS = {"gears.idler": {"from": 60, "to": 90}, "gears.module": {"from": 1, "to": 5}}
STUDIES: dict[str, tuple[dict[str, Any], str, dict[str, Any], str]] = {
    "dwell": ({**FEED, "dwell": {"angle": 135}}, "synth dwell", GEARS, "frame_length"),
    "window": ({**FEED, "dwell": {"window": 50}}, "synth dwell", GEARS, "frame_length"),
    "back-step": ({**FEED, "back_step": {"angle": 20}}, "synth back-step", GEARS, "gear_gap"),
    "speed": ({**FEED, "speed": {"min": 100, "max": 300}}, "synth variable-speed", GEARS, "frame_length"),
    "momentary": ({**FEED, "momentary": {"eccentricity": 28}}, "synth momentary-dwell", GEARS, "frame_length"),
    "band": ({**FEED, "links": LINKS, "dwell_tolerance": 1}, "analyze", GEARS, "tolerance_dwell_angle"),
    "idler": (
        {**FEED, "gears": {"module": 2, "crank": 40, "output": 40}, "dwell": {"angle": 135}},
        "synth dwell",
        {"gears.module": {"from": 1, "to": 5}, "dwell.angle": {"from": 100, "to": 150}},
        "frame_length",
    ),
    "gears": (PAIR, "gear", {**MODULE, "teeth[0]": {"from": 15, "to": 60}}, "contact_ratio"),
    "ring": ({**PAIR, "teeth": [20, -60]}, "gear", {**MODULE, "teeth[0]": {"from": 15, "to": 40}}, "contact_ratio"),
    "slider": (
        {"kind": "slider-crank", "stroke": 300, "rod": 500},
        "analyze",
        {"stroke": {"from": 200, "to": 300}, "rod": {"from": 400, "to": 500}},
        "acceleration_max",
    ),
}


@pytest.fixture
def garbage() -> Iterator[list[Any]]:
    """What only the collector can free, instead of freeing it."""
    gc.disable()
    gc.freeze()  # else every collection walks all that the tests have loaded
    yield gc.garbage
    gc.set_debug(0)
    gc.garbage.clear()
    gc.unfreeze()
    gc.enable()


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", STUDIES)
def test_no_array_of_a_chunk_waits_for_the_collector(name: str, garbage: list[Any]) -> None:
    base, command, variables, quantity = STUDIES[name]
    data = {"kind": "study", "design": base, "command": command, "variables": variables, "minimize": {quantity: 1e-3}}
    data |= {"sampling": {"method": "sobol", "budget": 1024}, "checks": {"must_pass": "all"}}
    made = problem(StudySpec.model_validate_json(json.dumps(data)))
    assert made.axis is not None, "else designs are few at a time"
    chunk_of(made, 0)  # makes what is kept for all chunks
    gc.collect()
    chunk_of(made, 0)
    gc.set_debug(gc.DEBUG_SAVEALL)
    gc.collect()
    held = [held for each in garbage for held in (each, *gc.get_referents(each)) if isinstance(held, np.ndarray)]
    assert sum(array.nbytes for array in held) == 0
