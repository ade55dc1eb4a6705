"""Writes tests/reference/statistics.json: laws, copula and Sobol' indices by openturns and SALib, for the tests.

python -m pip install --target /tmp/oracles openturns SALib
PYTHONPATH=/tmp/oracles .venv/bin/python tests/oracles/make_statistics.py
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
PLACE = Path(__file__).parents[1] / "reference/statistics.json"
SHARES = [0.00135, 0.05, 0.3, 0.5, 0.8, 0.99865]
LAWS: list[dict[str, Any]] = [
    {"form": "normal", "lower": -0.02, "upper": 0.02, "mean": 0.005, "sigma": 0.004},
    {"form": "uniform", "lower": -0.01, "upper": 0.03},
    {"form": "triangular", "lower": -0.02, "upper": 0.05, "mode": -0.01},
    {"form": "truncated", "lower": -0.02, "upper": 0.02, "mean": 0.008, "sigma": 0.01},
]
SOURCES = ("links.crank", "links.frame", "centers.crank_idler", "centers.idler_output")
DEVIATION = 0.02 / 3.0


def _law(ot: Any, law: dict[str, Any]) -> Any:
    low, high = law["lower"], law["upper"]
    match law["form"]:
        case "normal":
            return ot.Normal(law["mean"], law["sigma"])
        case "uniform":
            return ot.Uniform(low, high)
        case "triangular":
            return ot.Triangular(low, law["mode"], high)
    return ot.TruncatedNormal(law["mean"], law["sigma"], low, high)


def _laws(ot: Any) -> list[dict[str, Any]]:
    found = []
    for law in LAWS:
        made = _law(ot, law)
        quantiles = [made.computeQuantile(share)[0] for share in SHARES]
        found.append(
            law | {"quantiles": quantiles, "mean_of": made.getMean()[0], "sigma_of": made.getStandardDeviation()[0]}
        )
    return found


def _copula(ot: Any) -> list[dict[str, Any]]:
    """Probability that two sizes of a group both lie below the 30 % and the 60 % point of their laws."""
    rows = []
    for rho in (-0.6, 0.5, 0.9):
        matrix = ot.CorrelationMatrix(2)
        matrix[0, 1] = rho
        both = ot.JointDistribution([_law(ot, LAWS[1]), _law(ot, LAWS[2])], ot.NormalCopula(matrix))
        place = [_law(ot, LAWS[1]).computeQuantile(0.3)[0], _law(ot, LAWS[2]).computeQuantile(0.6)[0]]
        rows.append({"rho": rho, "share": both.computeCDF(place)})
    return rows


def _ishigami(x: Any) -> Any:
    return np.sin(x[:, 0]) + 7.0 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def _swing(x: Any) -> Any:
    """Half the range of the candy feed's output over its dwell, which has a kink there."""
    import factory

    data = {
        "kind": "three-gear-four-bar",
        "name": "candy",
        "gears": {"module": 2.0, "crank": 40, "idler": 72, "output": 40},
        "links": {"crank": 38.94178567, "frame": 153.53024891},
        "tolerance": {
            "sources": {key: {"plus_minus": 0.02} for key in SOURCES},
            "require": ["dwell_swing <= 10.2 deg"],
        },
    }
    made = factory.design(data, command="tolerance").problem
    sizes = {one.key: one.nominal + x[:, i] for i, one in enumerate(made.sources)}
    return made.axis.evaluate(sizes, ["dwell_swing"]).quantities["dwell_swing"]


def _indices(model: Any, names: list[str], bounds: list[list[float]], dists: list[str], power: int) -> dict[str, Any]:
    from SALib.analyze import sobol as analyze
    from SALib.sample import sobol as sample

    problem = {"num_vars": len(names), "names": names, "bounds": bounds, "dists": dists}
    points = sample.sample(problem, 2**power, calc_second_order=False, seed=3)
    found = analyze.analyze(problem, model(points), calc_second_order=False, conf_level=0.95, seed=4)
    return {"names": names} | {key: [float(v) for v in found[key]] for key in ("S1", "S1_conf", "ST", "ST_conf")}


def main() -> None:
    """Write the file."""
    from importlib.metadata import version

    import openturns as ot

    circle = [[-math.pi, math.pi]] * 3
    data = {
        "made by": {name: version(name) for name in ("openturns", "SALib")},
        "shares": SHARES,
        "laws": _laws(ot),
        "copula": _copula(ot),
        "ishigami": _indices(_ishigami, ["x1", "x2", "x3"], circle, ["unif"] * 3, 16),
        "swing": _indices(_swing, list(SOURCES), [[0.0, DEVIATION]] * 4, ["norm"] * 4, 16),
    }
    PLACE.write_text(json.dumps(data, indent=1) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
