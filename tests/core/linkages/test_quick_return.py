"""The slider-crank of a stroke and a time ratio: what is found gives both back, and no other rod transmits better."""

from __future__ import annotations

import math
import random
from typing import Any

import pytest
from factory import design
from pydantic import ValidationError
from scipy.optimize import brentq, minimize_scalar

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages.slider_crank import quick_return

ASKED: dict[str, Any] = {"kind": "slider-crank", "name": "asked", "stroke": 310.0, "quick_return_ratio": 1.1}


def turned(crank: float, rod: float, offset: float) -> tuple[float, float]:
    """Stroke and time ratio from the dead centres, which scipy finds on the depth of the slider."""

    def depth(phi: float) -> float:
        return math.sqrt(rod**2 - (crank * math.cos(phi) + offset) ** 2) - crank * math.sin(phi)

    def slope(phi: float) -> float:
        across = crank * math.cos(phi) + offset
        return across * crank * math.sin(phi) / math.sqrt(rod**2 - across**2) - crank * math.cos(phi)

    far = brentq(slope, math.pi, 2.0 * math.pi, xtol=1e-14)
    near = brentq(slope, 0.0, math.pi, xtol=1e-14)
    return depth(far) - depth(near), (far - near) / (2.0 * math.pi - far + near)


@pytest.mark.parametrize("given", ["rod", "crank", ""])
def test_stroke_and_ratio_come_back(given: str) -> None:
    rng = random.Random(7)
    for _ in range(40):
        stroke, ratio = rng.uniform(20.0, 500.0), rng.uniform(1.001, 2.5)
        p = 0.5 * math.pi * (ratio - 1.0) / (ratio + 1.0)
        low, high = {"rod": (1.0, 1.0 / math.tan(p)), "crank": (math.tan(p), 1.0), "": (0.0, 0.0)}[given]
        length = 0.5 * stroke * (low + (high - low) * rng.uniform(0.05, 0.95))
        found = quick_return(stroke, ratio, **({given: length} if given else {}))
        back = turned(*found)
        assert back == pytest.approx((stroke, ratio), rel=1e-7)
        assert not given or getattr(found, given) == length


@pytest.mark.parametrize("ratio", [1.0001, 1.02, 1.1, 1.6, 2.5, 2.99])
def test_no_other_rod_transmits_better(ratio: float) -> None:
    best = quick_return(100.0, ratio)
    p = 0.5 * math.pi * (ratio - 1.0) / (ratio + 1.0)

    def cosine(rod: float) -> float:
        found = quick_return(100.0, ratio, rod=rod)
        return (found.crank + found.offset) / found.rod

    ends = 50.0 * (1.0 + 1e-9), 50.0 / math.tan(p) * (1.0 - 1e-9)
    search = minimize_scalar(
        lambda log: cosine(math.exp(log)),
        bounds=tuple(math.log(end) for end in ends),
        method="bounded",
        options={"xatol": 1e-10},
    )
    assert math.exp(search.x) == pytest.approx(best.rod, rel=1e-4)
    least = (best.crank + best.offset) / best.rod
    assert least <= search.fun + 1e-13
    assert least <= min(cosine(ends[0] + (ends[1] - ends[0]) * i / 400) for i in range(401)) + 1e-13


def test_quantities_of_the_file() -> None:
    given = design(ASKED, command="crank", rod=520.0)
    report = {quantity.name: quantity.value for quantity in given.report("crank").quantities}
    assert report["quick_return_ratio"] == pytest.approx(1.1, rel=1e-13)
    assert report["crank_length"] == pytest.approx(150.4704967956172, rel=1e-13)
    assert report["offset"] == pytest.approx(119.11776651421012, rel=1e-13)
    assert not {"rod_length", "min_transmission_angle"} & report.keys()
    free = design(ASKED, command="crank")
    report = {quantity.name: quantity.value for quantity in free.report("crank").quantities}
    cosine = (report["crank_length"] + report["offset"]) / report["rod_length"]
    assert report["min_transmission_angle"] == pytest.approx(math.degrees(math.acos(cosine)), rel=1e-14)
    assert free.table("motion")["displacement"].max() == pytest.approx(310.0, rel=1e-4)
    by_crank = design(ASKED, command="crank", crank=150.4704967956172)
    assert by_crank.rod_length == pytest.approx(520.0, rel=1e-10)
    assert by_crank.crank_length == 150.4704967956172


@pytest.mark.parametrize("keys", [{"rod": 520.0}, {"crank": 140.0}, {}])
def test_what_is_found_completes_the_file(keys: dict[str, float]) -> None:
    made = design(ASKED, **keys)
    data = ASKED | keys
    for found in made.completion():
        data.pop(found.path, None)
        if found.value is not None:
            data[found.path] = found.value
    again = design(data)
    assert again.crank_length == pytest.approx(made.crank_length, rel=1e-12)
    assert again.quick_return_ratio == pytest.approx(1.1, rel=1e-12)


@pytest.mark.parametrize(
    ("keys", "key"),
    [
        ({"rod": 3400.0}, "rod"),
        ({"rod": 150.0}, "rod"),
        ({"crank": 155.5}, "crank"),
        ({"crank": 155.1}, "crank"),
        ({"crank": 10.0}, "crank"),
        ({"quick_return_ratio": 1.0}, "quick_return_ratio"),
        ({"quick_return_ratio": 1.0, "crank": 155.0}, "quick_return_ratio"),
        ({"quick_return_ratio": 3.5}, "quick_return_ratio"),
    ],
)
def test_refused(keys: dict[str, float], key: str) -> None:
    with pytest.raises(NoSolution) as refused:
        design(ASKED, command="crank", **keys).report("crank")
    assert refused.value.key == key


def test_even_strokes_are_those_of_a_slider_in_line() -> None:
    assert quick_return(310.0, 1.0, rod=520.0) == (155.0, 520.0, 0.0)


@pytest.mark.parametrize(
    "keys", [{"offset": 0.0, "rod": 520.0}, {"rod": 520.0, "crank": 150.0}, {"stroke": None, "crank": 150.0}]
)
def test_keys_that_do_not_go_together(keys: dict[str, Any]) -> None:
    with pytest.raises(ValidationError):
        design(ASKED, **keys)
