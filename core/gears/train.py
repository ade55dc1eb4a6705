"""The meshes of a train of gears, each gear with one tip circle however many mates it has."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from gearlink.core.gears.data import GearData
from gearlink.core.gears.from_spec import data_of, pair_at
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.train_keys import TrainKeys


@dataclass(frozen=True)
class Place:
    """A mesh of a train.

    Parameters
        gears : (int, int) - places of its gears in the lists of the section
        teeth : (int, int) - a ring second, with negative teeth
    """

    gears: tuple[int, int]
    teeth: tuple[int, int]


def train_pairs(keys: TrainKeys, places: Iterable[Place], module: float, pressure_angle: float) -> list[GearPair]:
    """The pairs of a train at their centre distances without backlash.

    k of a gear = min over its meshes of y - (x_1 + x_2)

    Parameters
        keys : TrainKeys
        places : Places of the meshes
        module : float [mm]
        pressure_angle : float [deg]
    Returns
        pairs : in the order of the places; a gear in two meshes has the shorter of the two tips
    Raises
        NoSolution - where teeth cannot mesh
    Source
        ISO 21771 for the tip shortening of a mesh
    """
    found = [(place, pair_at(keys.of(*place.gears, module, pressure_angle), place.teeth)) for place in places]
    if keys.profile_shift is None or not any(keys.profile_shift):
        return [pair for _, pair in found]
    alteration: dict[int, float] = {}
    for place, pair in found:
        for gear, k in zip(place.gears, pair.tip_alteration, strict=True):
            alteration[gear] = min(alteration.get(gear, 0.0), k)
    return [replace(pair, tip=(alteration[place.gears[0]], alteration[place.gears[1]])) for place, pair in found]


def train_data(keys: TrainKeys, place: Place, pair: GearPair) -> GearData:
    """A pair of a train with all that its drawing needs.

    Parameters
        keys : TrainKeys
        place : Place
        pair : GearPair - from `train_pairs`
    Raises
        NoSolution - for allowances beyond the tables of their standards
    """
    return data_of(keys.of(*place.gears, pair.module, 20.0), pair)
