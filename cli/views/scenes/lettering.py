"""Where letters stand beside their points: clear of links, of the pitch circles of gears, and of each other."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from gearlink.cli.views.scenes.scene import TURN, Body, Chain, Points, Reals, Scene

_WAYS = np.exp(1j * TURN * np.arange(24) / 24)
_POSITIONS = 60
"""So many positions of a loop tell where a letter is in the way."""
_Clearance: TypeAlias = Callable[[Points], Reals]


def on_disc(body: Body) -> float:
    """Distance of the words on a body without teeth from its axis [mm]: half-way out on a disc."""
    return 0.5 * abs(complex(body.outline[0])) if body.repeats == 0 else 0.0


def shifts(scene: Scene, reach: float, label_reach: Callable[[Body], float]) -> tuple[list[complex], list[complex]]:
    """From each mark to its letters, and from the axis of each body with a label to that label [mm].

    Parameters
        scene : Scene - of one position or of many; a letter keeps its side over all of them
        reach : float [mm] - distance of letters from their points
        label_reach : function - distance of a body's label from its axis [mm]; 0 puts it there
    """
    every = max(1, len(scene.marks[0].point) // _POSITIONS)
    gears = [part for part in scene.parts if isinstance(part, Body) and part.pitch]
    chains = [part for part in scene.parts if isinstance(part, Chain)]
    taken = [_from_link(a[::every], b[::every]) for chain in chains for a, b in pairwise(chain.joints)]
    found = []
    for mark in scene.marks:
        point = mark.point[::every]
        others = [_from_point(other.point[::every]) for other in scene.marks if other is not mark]
        circles = [_from_circle(gear.place[::every], gear.pitch) for gear in gears]
        found.append(_clearest(point, reach, reach, [*taken, *others], circles) if mark.text else 0j)
        taken += [_from_point(point + found[-1])] if mark.text else []
    taken += [_from_point(mark.point[::every]) for mark in scene.marks]
    labels = []
    for body in scene.parts:
        if isinstance(body, Body) and body.label:
            far, place = label_reach(body), body.place[::every]
            circles = [_from_circle(gear.place[::every], gear.pitch) for gear in gears if gear is not body]
            labels.append(_clearest(place, far, 2.0 * reach, taken, circles) if far else 0j)
            taken.append(_from_point(place + labels[-1]))
    return found, labels


def _clearest(
    point: Points, distance: float, enough: float, taken: list[_Clearance], circles: list[_Clearance]
) -> complex:
    """The shift that keeps farthest from all that is taken, as far as `enough`, circles included; up and right among
    equals. A letter on a circle can still be read, so that of two shifts as near to one the freer counts."""
    places = point[:, None] + distance * _WAYS[None, :]
    free = np.min([_known(clearance(places)) for clearance in taken], axis=0)
    clear = np.min([free, *(_known(clearance(places)) for clearance in circles)], axis=0)
    room = np.minimum(enough, clear).mean(axis=0) + 0.5 * np.minimum(enough, free).mean(axis=0)
    upwards = (_WAYS * np.exp(-0.125j * TURN)).real
    return complex(distance * _WAYS[int(np.argmax(room + 0.02 * enough * upwards))])


def _known(distances: Reals) -> Reals:
    """What is not there at a position is far."""
    return np.asarray(np.nan_to_num(distances, nan=np.inf, posinf=np.inf))


def _from_point(point: Points) -> _Clearance:
    return lambda places: np.abs(places - point[:, None])


def _from_circle(center: Points, radius: float) -> _Clearance:
    return lambda places: np.abs(np.abs(places - center[:, None]) - radius)


def _from_link(start: Points, end: Points) -> _Clearance:
    first, way = start[:, None], (end - start)[:, None]
    square = np.maximum(np.abs(way) ** 2, 1e-300)

    def clearance(places: Points) -> Reals:
        along = np.clip(((places - first) * way.conj()).real / square, 0.0, 1.0)
        return np.asarray(np.abs(places - first - along * way))

    return clearance
