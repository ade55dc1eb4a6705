"""Standstills, extremes and dwell of many drives by a dense search of a revolution and bisection, in 80-bit numbers."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from oracles.long_drive import LONG, PI, Drives

TURN = 2 * PI


def grid() -> Any:
    """The turn in half degrees, and places that halve their distance to 0 and 180 deg, where links come in line."""
    even = TURN * (np.arange(720) + LONG(0.31)) / 720
    steps = PI / LONG(2) ** np.arange(7, 36)
    near = np.concatenate([PI + steps, PI - steps, steps, TURN - steps])
    return np.sort(np.concatenate([even, near]))


def bisect(f: Callable[[Any], Any], low: Any, high: Any, steps: int = 80) -> Any:
    """Roots of many functions between places where their signs differ."""
    falls = f(low) > 0
    for _ in range(steps):
        middle = (low + high) / 2
        left = (f(middle) > 0) == falls
        low, high = np.where(left, middle, low), np.where(left, high, middle)
    return (low + high) / 2


@dataclass(frozen=True)
class Places:
    """Places of a kind on the turns of many drives: which drive each belongs to, and where it is; in order."""

    drive: Any
    place: Any

    def of(self, drive: int) -> list:
        """Those of one drive."""
        return list(self.place[self.drive == drive])


def turning_points(drives: Drives, function: str, count: int) -> Places:
    """Zeros of a periodic function of the crank angle."""
    x = grid()
    wide = drives.at((slice(None), None))
    positive = np.concatenate([getattr(wide.at(part), function)(x) > 0 for part in _parts(count)])
    which, left = np.nonzero(positive != np.roll(positive, -1, axis=1))
    return _refined(drives, function, which, x[left], np.append(x, x[0] + TURN)[left + 1])


def standstills(drives: Drives, extremes: Places) -> Places:
    """Zeros of the speed: between neighbouring extremes it runs one way, so none is missed."""
    following = np.arange(extremes.drive.size) + 1
    last = np.append(extremes.drive[1:] != extremes.drive[:-1], True)
    first = np.searchsorted(extremes.drive, extremes.drive)
    high = np.where(last, extremes.place[first] + TURN, extremes.place[np.minimum(following, following.size - 1)])
    mine = drives.at(extremes.drive)
    crosses = (mine.speed(extremes.place) > 0) != (mine.speed(high) > 0)
    return _refined(drives, "speed", extremes.drive[crosses], extremes.place[crosses], high[crosses])


@dataclass(frozen=True)
class Turn:
    """What one drive does over a revolution: places of the maximum and the minimum speed, standstills in order."""

    drive: Drives
    greatest: Any
    least: Any
    standstills: list

    def back_step(self) -> tuple:
        """Start, crank angle and size of the back-step, and the crank angle until the output is back in its place."""
        start, end = self.standstills
        if self.drive.acceleration(start) > 0:
            start, end = end, start
        width, at_start = (end - start) % TURN, self.drive.angle(start)
        regained = bisect(lambda x: self.drive.angle(start + x) - at_start, width, TURN)
        return start, width, at_start - self.drive.angle(start + width), regained

    def over(self, function: str, start: Any, width: Any) -> Any:
        """Maximum condition of a result over an interval."""
        return max(self.drive.condition(function, start + width * share) for share in (0, 0.25, 0.5, 0.75, 1))


def turns(drives: Drives, count: int) -> list[Turn]:
    """The turns of so many drives."""
    extremes = turning_points(drives, "acceleration", count)
    speed, stops = drives.at(extremes.drive).speed(extremes.place), standstills(drives, extremes)
    found = []
    for i in range(count):
        mine = np.nonzero(extremes.drive == i)[0]
        most, least = (extremes.place[mine[f(speed[mine])]] for f in (np.argmax, np.argmin))
        found.append(Turn(drives.at(i), most, least, stops.of(i)))
    return found


def _refined(drives: Drives, function: str, which: Any, low: Any, high: Any) -> Places:
    mine = drives.at(which)
    place = bisect(getattr(mine, function), low, high) % TURN
    order = np.lexsort((place, which))
    return Places(which[order], place[order])


def _parts(count: int, size: int = 500) -> list[slice]:
    return [slice(start, start + size) for start in range(0, count, size)]
