"""The meshes of a train of gears, each gear with one tip circle however many mates it has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.from_spec import as_pair, data_of, load_of, pair_at
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.rating.load import Load
from gearlink.core.parts.gears.tooth.teeth import rim_radius
from gearlink.core.parts.gears.tooth.tools import PinionCutter
from gearlink.core.parts.gears.train.keys import TrainKeys


@dataclass(frozen=True)
class Place:
    """A mesh of a train.

    Parameters
        gears : (int, int) - places of its gears in the lists of the section
        teeth : (int, int) - a ring second, with negative teeth
    """

    gears: tuple[int, int]
    teeth: tuple[int, int]


def places(teeth: Sequence[int]) -> list[Place]:
    """The meshes of gears that mesh one after the other.

    Parameters
        teeth : of the gears in order, rings negative
    Example
        >>> [place.gears for place in places((-70, 30, 41))]
        [(1, 0), (1, 2)]
    """
    return [
        Place((i + 1, i), (teeth[i + 1], teeth[i])) if teeth[i] < 0 else Place((i, i + 1), (teeth[i], teeth[i + 1]))
        for i in range(len(teeth) - 1)
    ]


@dataclass(frozen=True)
class Train:
    """The pairs of a train with the keys of their file.

    Parameters
        keys : TrainKeys - with a module and a pressure angle
        teeth : of the gears in order, rings negative
        distances : float or None [mm], for each mesh - working centre distances of the machine; None: without backlash
    Notes
        k of a gear is the minimum of its meshes', y - (x_1 + x_2): the shorter of the tips that its mates ask for.
    Source
        ISO 21771 for the tip shortening of a mesh
    """

    keys: Any
    teeth: tuple[int, ...]
    distances: tuple[float | None, ...]

    @property
    def places(self) -> list[Place]:
        """The meshes."""
        return places(self.teeth)

    def pairs(self) -> list[GearPair]:
        """The pairs in the order of the meshes.

        Raises
            NoSolution - where teeth cannot mesh
        """
        found = [self._pair(place, distance) for place, distance in zip(self.places, self.distances, strict=True)]
        keys: TrainKeys = self.keys
        if not any(keys.profile_shift or ()) or isinstance(keys.tip_shortening, list):
            return found
        alteration: dict[int, float] = {}
        for place, pair in zip(self.places, found, strict=True):
            for gear, k in zip(place.gears, pair.tip_alteration, strict=True):
                alteration[gear] = min(alteration.get(gear, 0.0), k)
        return [
            replace(pair, tip=(alteration[place.gears[0]], alteration[place.gears[1]]))
            for place, pair in zip(self.places, found, strict=True)
        ]

    def _pair(self, place: Place, distance: float | None) -> GearPair:
        keys: TrainKeys = self.keys
        one, other = (keys.gear_names()[gear] for gear in place.gears)
        given = keys.of(*place.gears, self.keys.module, self.keys.pressure_angle)
        pair = pair_at(given, place.teeth, distance, (one, other))
        changes: dict[str, Any] = {}
        if keys.span_teeth is not None:
            changes["given_spans"] = as_pair([self._span(place, i) for i in (0, 1)])
        if keys.cutter is not None and pair.internal:
            changes["cutter"] = self._cutter(-place.teeth[1])
        return replace(pair, **changes) if changes else pair

    def _span(self, place: Place, gear: int) -> int:
        spans, at, teeth = self.keys.span_teeth, place.gears[gear], abs(place.teeth[gear])
        if spans[at] > teeth:
            words, key = f"a gear of {teeth} teeth has no span over {spans[at]}", f"span_teeth[{at}]"
            raise NoSolution(words, key=key, fix=f"set {key} to at most {teeth}")
        found: int = spans[at]
        return found

    def _cutter(self, ring: int) -> PinionCutter:
        given = self.keys.cutter
        if given.teeth >= ring:
            message = f"a cutter of {given.teeth} teeth does not fit into a ring of {ring}"
            raise NoSolution(message, key="cutter.teeth", fix=f"set cutter.teeth to at most {ring - 1}")
        return PinionCutter(**given.model_dump())

    def data(self, place: Place, pair: GearPair, rim: float | None = None) -> GearData:
        """One of the pairs with all that its drawing and its rating need.

        Parameters
            pair : GearPair - of `pairs`
            rim : float or None [mm] - outer radius of its ring, where the file gives it
        Raises
            NoSolution - for allowances beyond the tables of their standards
        """
        keys: TrainKeys = self.keys
        data = data_of(keys.of(*place.gears, self.keys.module, self.keys.pressure_angle), pair)
        if keys.load is None:
            return data
        rims = data.rims
        if pair.internal and (rim is not None or (rims[1] is None and "rim" in type(keys).model_fields)):
            root = abs(pair.root_radius[1])  # a rim that is left out is the one that stands in the machine
            rims = rims[0], rim_radius(root, pair.module, rim) - root
        count = len(self.teeth)  # those between the ends hand the force on, with one flank to the other
        one, other = (0 < gear < count - 1 for gear in place.gears)
        rated: dict[str, Any] = {}
        if keys.rating is not None:
            limits = tuple((each.contact_limit, each.bending_limit) for each in data.materials)
            rated["conditions"] = keys.rating.of(place.gears).conditions(limits, keys.accuracy_grade)
        return replace(data, load=self._load(place), rims=rims, idlers=(one, other), **rated)

    def _load(self, place: Place) -> Load:
        """The load of a mesh; one tangential force on the reference circles goes through all of them.

        T_1 = T z_1/z,  n_1 = n z/z_1
        """
        given = self.keys.load
        named = 0 if given.gear is None else self.keys.gear_names().index(given.gear)
        ratio = abs(place.teeth[0] / self.teeth[named])
        whole = load_of(given)
        assert whole is not None, "the file gives one"
        return replace(
            whole,
            torque=None if whole.torque is None else whole.torque * ratio,
            speed=None if whole.speed is None else whole.speed / ratio,
        )
