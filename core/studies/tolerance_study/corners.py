"""The worst case: every size at one of its limits, and every pin against its hole where that is worst."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.studies.tolerance.sources import Scatter
from gearlink.core.studies.tolerance_study.problem import Problem
from gearlink.core.studies.tolerance_study.samples import evaluated
from gearlink.core.studies.tolerance_study.sensitivity import Slope

_MOST = 12
"""Sizes of which all corners are computed."""

_ROUND = np.linspace(0.0, math.tau, 32, endpoint=False)
_NARROWINGS = 3
"""Times that directions are tried about the best one, 16 times as near each: 1e-3 rad costs 1e-6 of the play."""

_WORTH = 1e-9


@dataclass(frozen=True)
class _Corner:
    """Where the sizes stand, +1 at the upper limit and -1 at the lower one, and how far each pin is off [mm]."""

    signs: Reals
    plays: Points


def corners(
    made: Problem, names: Sequence[str], gains: Mapping[str, list[Slope]]
) -> dict[str, tuple[float, float, str]]:
    """Least and greatest value of quantities at the corners of the limits, and where the greatest is.

    Returns
        found : by quantity - least, greatest, a sign for each source: + or - a size at its limit, o the play of a pin
    Notes
        Of up to 12 sizes all corners, of more that of the linear signs. From the best one single sizes are turned
        about, and each pin goes round its hole at half the greatest clearance, until none helps. What lies inside may
        be worse where the quantity is not monotone.
    """
    pins = [source for source in made.sources if source.kind == "pin"]
    sizes = len(made.sources) - len(pins)
    still = np.zeros(len(pins), dtype=complex)
    every = sizes <= _MOST
    bits = (np.arange(2**sizes if every else 1)[:, None] >> np.arange(sizes)) & 1
    first = [_Corner(row, still) for row in np.where(bits, -1.0, 1.0)]
    of_first = evaluated(made, _offsets(made, first)).quantities if every else {}
    found: dict[str, tuple[float, float, str]] = {}
    for name in names:
        ends = []
        for sense in (-1.0, 1.0):
            if every:
                at = _best(sense * of_first[name])
                best, start = float(sense * of_first[name][at]), first[at]
            else:
                start = _Corner(sense * _linear(made, gains[name]), still)
                best = float(_values(made, name, sense, [start])[0])
            known = every and not pins
            ends.append((best, start) if known else _climbed(partial(_values, made, name, sense), best, start, pins))
        (least, _), (most, place) = ends
        found[name] = (-least, most, "" if math.isnan(most) else _shown(made, place))
    return found


def _linear(made: Problem, gains: Sequence[Slope]) -> Reals:
    """The signs of the slopes in the sizes."""
    rows = zip(gains, made.sources, strict=True)
    return np.array([1.0 if row.gain[0] >= 0.0 else -1.0 for row, source in rows if source.kind != "pin"])


def _values(made: Problem, name: str, sense: float, places: Sequence[_Corner]) -> Reals:
    return sense * evaluated(made, _offsets(made, places)).quantities[name]


def _offsets(made: Problem, places: Sequence[_Corner]) -> dict[str, Reals | Points]:
    shifts: list[Mapping[str, complex]] = []
    for place in places:
        signs, plays = iter(place.signs), iter(place.plays)
        shifts.append({one.key: next(plays) if one.kind == "pin" else _limit(one, next(signs)) for one in made.sources})
    return made.offsets(shifts)


def _limit(source: Scatter, sign: float) -> float:
    return source.law.upper if sign > 0.0 else source.law.lower


def _best(values: Reals) -> int:
    """Where the greatest value is; a design that does not exist has none."""
    return int(np.argmax(np.where(np.isnan(values), -math.inf, values)))


def _climbed(
    values: Callable[[Sequence[_Corner]], Reals], best: float, place: _Corner, pins: Sequence[Scatter]
) -> tuple[float, _Corner]:
    """The greatest value that moving single sources from a place finds, and where it is."""

    def take(tried: Sequence[_Corner]) -> bool:
        nonlocal best, place
        found = values(tried)
        at = _best(found)
        worth = -math.inf if math.isnan(best) else best + _WORTH * abs(best)
        if not found[at] > worth:
            return False
        best, place = float(found[at]), tried[at]
        return True

    moved = True
    while moved:
        moved = bool(place.signs.size) and take(_turned_about(place))
        for i, pin in enumerate(pins):
            around = _ROUND
            for _ in range(1 + _NARROWINGS):
                moved |= take([_with_play(place, i, cmath.rect(pin.limit, angle)) for angle in around])
                around = cmath.phase(place.plays[i]) + (around - around.mean()) / _ROUND.size * 2.0
    return best, place


def _turned_about(place: _Corner) -> list[_Corner]:
    """Those that differ in one sign."""
    count = np.arange(place.signs.size)
    return [_Corner(np.where(count == i, -place.signs, place.signs), place.plays) for i in count]


def _with_play(place: _Corner, i: int, play: complex) -> _Corner:
    plays = place.plays.copy()
    plays[i] = play
    return _Corner(place.signs, plays)


def _shown(made: Problem, place: _Corner) -> str:
    signs = iter(place.signs)
    return "".join("o" if one.kind == "pin" else "+" if next(signs) > 0.0 else "-" for one in made.sources)
