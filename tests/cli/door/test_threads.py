"""Several threads at once, on one design and on many: numbers as alone, sheets one after the other."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from sweeps import mostly_slow

import gearlink
from gearlink.cli.views.figures import write


@pytest.fixture(autouse=True)
def _often() -> Iterator[None]:
    """Change from thread to thread as often as can be."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    yield
    sys.setswitchinterval(before)


def everything(design: Any) -> str:
    found: list[Any] = [getattr(design.quantity(name), "value", None) for name in design.quantity_names()]
    names = design.outlines[vars(design)["_command"]].tables
    return repr((found, [design.table(name, samples=36).rows() for name in names]))


def together(work: Callable[[Any], Any], given: list[Any]) -> list[Any]:
    with ThreadPoolExecutor(4) as pool:
        return list(pool.map(work, given))


@pytest.mark.parametrize(
    "names",
    mostly_slow(
        [
            ["ty460_slider_crank", "crank_rocker"],
            ["mutilated_gear_press", "ty460_slider_crank", "hypocycloid_slider"],
        ],
        1,
    ),
    ids=len,
)
def test_one_design_and_many(designs: Path, names: list[str]) -> None:
    paths = [designs / f"{name}.yaml" for name in names]
    alone = [everything(gearlink.load(path)) for path in paths]
    assert together(lambda path: everything(gearlink.load(path)), paths * 3) == alone * 3
    for path, expected in zip(paths, alone, strict=True):
        shared = gearlink.load(path)
        assert together(everything, [shared] * 4) == [expected] * 4


def test_sheets_are_drawn_one_after_the_other(monkeypatch: pytest.MonkeyPatch) -> None:
    """Two that draw at once meet in matplotlib's reader of formulas, which fails."""
    drawing: list[int] = []
    most: list[int] = []

    def draw(*_: Any) -> None:
        drawing.append(1)
        time.sleep(0.01)
        most.append(len(drawing))
        drawing.pop()

    monkeypatch.setattr(write, "draw", draw)
    crank = gearlink.design(kind="slider-crank", stroke=310, rod=520)
    together(lambda _: gearlink.figure(crank), [0] * 4)
    assert most == [1] * 4
