"""Geared six-bars under load, one for each way in which a train can sit on the loop."""

from __future__ import annotations

from typing import Any

MASS = {"mass": 1.5, "inertia": 0.001, "center": [10, 3]}
LOADS = {
    "speed": 60,
    "gravity": [0, -9.81],
    "links": {"coupler_1": MASS, "coupler_2": MASS, "coupler_3": MASS, "output": MASS},
    "forces": [{"on": "output", "torque": -20}],
}


def _train(pins: str, gears: list[int], module: float) -> dict[str, Any]:
    return {"pins": list(pins), "gears": gears, "module": module}


def _six_bar(trains: list[Any], start: dict[str, float], free: str = "", **links: float) -> dict[str, Any]:
    loads = {**LOADS, "links": {**LOADS["links"], **({free: MASS} if free else {})}}  # type: ignore[dict-item]
    return {"kind": "geared-six-bar", "name": "x", "links": links, "trains": trains, "start": start, "loads": loads}


SIX_BARS = {
    "ring on a coupler, its gear on the frame": _six_bar(
        [_train("AB", [20, 20], 2), _train("EF", [-60, 20], 2)],
        {"coupler_1": 120, "output": 90}, frame=150, coupler_1=60, coupler_2=120, coupler_3=90,
    ),
    "ring on the frame": _six_bar(
        [_train("AB", [-60, 20], 2), _train("EF", [20, 20], 2)],
        {"coupler_1": 60, "output": -60}, frame=60, coupler_1=180, coupler_2=120, coupler_3=180,
    ),
    "axes on the frame": _six_bar(
        [_train("FA", [20, 40], 3), _train("AB", [20, 20], 2)],
        {"coupler_1": 240, "output": 120}, coupler_1=90, coupler_2=150, coupler_3=150, output=90,
    ),
    "free gear on B": _six_bar(
        [_train("ABC", [20, 30, 20], 1), _train("EF", [20, 20], 2)],
        {"coupler_1": 120, "output": 30}, "gear_1B", frame=120, coupler_2=90, coupler_3=120,
    ),
    "free gear on F": _six_bar(
        [_train("EFA", [20, 30, 40], 2), _train("AB", [20, 20], 2)],
        {"coupler_1": 240, "output": -60}, "gear_1F", coupler_1=180, coupler_2=180, coupler_3=180,
    ),
    "both trains on one link, two revolutions": _six_bar(
        [_train("ABC", [20, 20, 20], 1), _train("BC", [30, 10], 1)],
        {"coupler_1": 120, "coupler_2": 120}, frame=30, coupler_2=180, coupler_3=150, output=120,
    ),
}  # fmt: skip
