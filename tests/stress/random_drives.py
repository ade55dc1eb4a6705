"""Random whole drives of every variant: links, assembly and teeth, sizes log-spaced from 1e-6 to 1e6."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.momentary import eccentricity_range, momentary_linkage
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar

Random = np.random.Generator


@dataclass(frozen=True)
class Design:
    """A drive and the variant that it was drawn for."""

    variant: str
    linkage: FourBar
    train: GearTrain

    def __str__(self) -> str:
        links = self.linkage
        lengths = (links.crank, links.coupler, links.rocker, links.frame, links.assembly)
        return f"{self.variant} {lengths} {(self.train.crank, self.train.idler, self.train.output)}"


def arrays(designs: list[Design]) -> tuple[Any, Any, Any]:
    """Lengths (4, N), assemblies (N,) and teeth (3, N) of many."""
    links = np.array([(x.linkage.crank, x.linkage.coupler, x.linkage.rocker, x.linkage.frame) for x in designs]).T
    teeth = np.array([(x.train.crank, x.train.idler, x.train.output) for x in designs], dtype=float).T
    return links, np.array([x.linkage.assembly for x in designs]), teeth


def draw(rng: Random, variant: str) -> Design:
    """A random drive of a variant."""
    while True:
        try:
            linkage, train = VARIANTS[variant](rng)
        except NoSolution:
            continue  # a task without a mechanism
        return Design(variant, linkage, train)


def designs(rng: Random, count: int, variants: tuple[str, ...] = ()) -> list[Design]:
    """So many, of all variants in turn."""
    names = variants or tuple(VARIANTS)
    return [draw(rng, names[i % len(names)]) for i in range(count)]


def _teeth(rng: Random) -> int:
    return round(10.0 ** float(rng.uniform(1.0, 2.3)))


def _module(rng: Random) -> float:
    return 10.0 ** float(rng.uniform(-6.0, 6.0))


def _side(rng: Random) -> int:
    return 1 if rng.random() < 0.5 else -1


def _share(rng: Random) -> float:
    """A place in a range: anywhere, or near one of its ends."""
    share = float(rng.uniform(0.0, 1.0)) if rng.random() < 0.5 else 10.0 ** float(rng.uniform(-5.0, -0.3))
    return share if rng.random() < 0.5 else 1.0 - share


def turning(rng: Random, b: float, c: float) -> tuple[float, float]:
    """Crank and frame, the shorter first, with which a coupler and a rocker turn fully."""
    short = min(b, c) * 10.0 ** float(rng.uniform(-4.0, 0.0))
    return short, abs(b - c) + short + (2.0 * min(b, c) - 2.0 * short) * _share(rng)


def _free(rng: Random) -> tuple[float, float, float, float, GearTrain]:
    z1, z3, z5 = _teeth(rng), _teeth(rng), _teeth(rng)
    module = _module(rng)
    b, c = 0.5 * module * (z1 + z3), 0.5 * module * (z3 + z5)
    return (*turning(rng, b, c), b, c, GearTrain(z1, z3, z5))


def _crank_rocker(rng: Random) -> tuple[FourBar, GearTrain]:
    short, long, b, c, train = _free(rng)
    return FourBar(short, b, c, long, _side(rng)), train


def _drag_link(rng: Random) -> tuple[FourBar, GearTrain]:
    short, long, b, c, train = _free(rng)
    return FourBar(long, b, c, short, _side(rng)), train


def _symmetric(rng: Random, frame_ratio: Callable[[float], float]) -> tuple[FourBar, GearTrain]:
    train = GearTrain(z := _teeth(rng), _teeth(rng), z)
    distance = 0.5 * _module(rng) * (train.crank + train.idler)
    return symmetric.symmetric_linkage(frame_ratio(train.i3), distance, _side(rng)), train


def _dwell(rng: Random) -> tuple[FourBar, GearTrain]:
    def ratio(i3: float) -> float:
        angle = symmetric.dwell_angle_limit(i3) * float(rng.uniform(1e-3, 0.99))
        return symmetric.frame_ratio_for_back_step(i3, symmetric.crank_angle_for_dwell(i3, angle))

    return _symmetric(rng, ratio)


def _back_step(rng: Random) -> tuple[FourBar, GearTrain]:
    def ratio(i3: float) -> float:
        angle = -i3 * math.pi * 10.0 ** float(rng.uniform(-6.0, -0.1))
        return symmetric.frame_ratio_for_back_step(i3, symmetric.crank_angle_for_back_step(i3, angle))

    return _symmetric(rng, ratio)


def _variable_speed(rng: Random) -> tuple[FourBar, GearTrain]:
    def ratio(i3: float) -> float:
        return symmetric.frame_ratio_for_speed_band(i3, 100.0 * float(rng.uniform(0.0, 0.99)), 100.0)

    return _symmetric(rng, ratio)


def _momentary(rng: Random) -> tuple[FourBar, GearTrain]:
    teeth, module = (_teeth(rng), _teeth(rng), _teeth(rng)), _module(rng)
    radii = [0.5 * module * z for z in teeth]
    low, high = eccentricity_range(*radii)
    return momentary_linkage(*radii, low + (high - low) * _share(rng), _side(rng)), GearTrain(*teeth)


def _beside_momentary(rng: Random) -> tuple[FourBar, GearTrain]:
    """A frame a little longer or shorter than that of the momentary dwell: two near standstills or none."""
    linkage, train = _momentary(rng)
    frame = linkage.frame * (1.0 + _side(rng) * 10.0 ** float(rng.uniform(-8.0, -1.0)))
    beside = FourBar(linkage.crank, linkage.coupler, linkage.rocker, frame, linkage.assembly)
    check_linkage(beside)
    return beside, train


VARIANTS: dict[str, Callable[[Random], tuple[FourBar, GearTrain]]] = {
    "crank-rocker": _crank_rocker,
    "drag-link": _drag_link,
    "dwell": _dwell,
    "back-step": _back_step,
    "variable-speed": _variable_speed,
    "momentary-dwell": _momentary,
    "beside-momentary": _beside_momentary,
}
