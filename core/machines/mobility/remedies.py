"""What to change where a gear train does not fit its linkage: lengths, teeth and fixed gears."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations, islice, pairwise
from typing import TYPE_CHECKING

from gearlink.core.machines.mobility.freedom import common_links

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.mobility.design import GearTrainMobility
    from gearlink.core.machines.mobility.spec import Train

_MOST = 60
"""Ways to fix or free gears that are tried."""


def candidates(design: GearTrainMobility, check: str) -> Iterator[Remedy]:
    """Remedies of a check, the least change first."""
    if check == "mobility":
        yield from islice(_freed_or_fixed(design), _MOST)
        return
    if check != "train-fit":
        return
    single = [*_lengths(design), *_fixings(design)]
    yield from single
    if len(single) > 1:  # a train may have more than one fault
        yield tuple(dict(change for remedy in single for change in remedy).items())
    yield from _teeth(design)


def _lengths(design: GearTrainMobility) -> Iterator[Remedy]:
    """Links as long as their gears mesh."""
    for train in design.spec.trains:
        for (one, other), distance in zip(pairwise(train.gears), design.distances_of(train), strict=True):
            common = common_links(design.links, one.at, other.at) if one.at != other.at else []
            if distance is None or not common or not _is_path(common[0]):
                continue
            length = design.spec.links[common[0]].length
            if length is not None and length != distance:
                yield ((f"links.{common[0]}.length", distance),)


def _teeth(design: GearTrainMobility) -> Iterator[Remedy]:
    """Each gear as large as what holds its distance to its neighbour leaves it."""
    for i, train in enumerate(design.spec.trains):
        for j, (one, other) in enumerate(pairwise(train.gears)):
            apart = design.apart(one, other)
            if train.module is None or one.teeth is None or other.teeth is None or apart is None:
                continue
            total = 2.0 * apart / train.module
            for place, mate, ring in ((j, other, one.ring), (j + 1, one, other.ring)):
                assert mate.teeth is not None, "both have teeth"
                needed = total + mate.teeth if ring else mate.teeth - total if mate.ring else total - mate.teeth
                if needed >= 1.0 and abs(needed - round(needed)) < 1e-6:
                    yield ((f"trains[{i}].gears[{place}].teeth", round(needed)),)


def _fixings(design: GearTrainMobility) -> Iterator[Remedy]:
    """Gears between others set free, end gears fixed to a link at their pin, one of two ends on one link set free."""
    for i, train in enumerate(design.spec.trains):
        for j, gear in enumerate(train.gears):
            if gear.fixed_to is not None and 0 < j < len(train.gears) - 1:
                yield ((_fixing(i, j), None),)
            elif gear.fixed_to is not None and gear.at not in design.links[gear.fixed_to]:
                yield from (((_fixing(i, j), name),) for name, pins in design.links.items() if gear.at in pins)
        if train.gears[0].fixed_to is not None and train.gears[0].fixed_to == train.gears[-1].fixed_to:
            yield from (((_fixing(i, j), None),) for j in _ends(train))


def _freed_or_fixed(design: GearTrainMobility) -> Iterator[Remedy]:
    """As many end gears free, or fixed to a link at their pins, as degrees of freedom are missing or too many."""
    excess = design.mobility - design.spec.mobility
    if excess == 0:  # what holds twice is not told by the count
        return
    ends = [(i, j) for i, train in enumerate(design.spec.trains) for j in _ends(train)]
    gears = {(i, j): design.spec.trains[i].gears[j] for i, j in ends}
    if excess < 0:
        fixed = [place for place in ends if gears[place].fixed_to is not None]
        for several in combinations(fixed, -excess):
            yield tuple((_fixing(*place), None) for place in several)
        return
    free = [place for place in ends if gears[place].fixed_to is None]
    for several in combinations(free, excess):
        able = [[name for name, pins in design.links.items() if gears[place].at in pins] for place in several]
        for turn in range(max(map(len, able), default=0)):
            yield tuple((_fixing(*place), names[turn % len(names)]) for place, names in zip(several, able, strict=True))


def _ends(train: Train) -> tuple[int, int]:
    return 0, len(train.gears) - 1


def _fixing(train: int, gear: int) -> str:
    return f"trains[{train}].gears[{gear}].fixed_to"


def _is_path(name: str) -> bool:
    """Whether a link's name can stand in a dotted path."""
    return re.fullmatch(r"(?!\d+$)[^.\[\]]+", name) is not None
