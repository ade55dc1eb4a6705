"""Results of a law of motion at places that several ask for, one after the other."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

from gearlink.core.numerics.arrays import Reals

_MOST, _SIZE = 64, 4096
Turned = TypeVar("Turned", bound=tuple[Any, ...])
Kept: TypeAlias = dict[tuple[tuple[int, ...], bytes], Turned]
"""Results by the places that they are of."""


def kept_for(kept: Kept[Turned], k: Reals, compute: Callable[[Reals], Turned]) -> Turned:
    """What is computed of an array of places, computed once for those that are asked for again.

    Parameters
        kept : dict - where results stand, at most 64 of arrays up to 4096 places
        k : array - places
        compute : function of the array
    Returns
        results : tuple - whoever gets it leaves its arrays as they are
    """
    if k.size > _SIZE:
        return compute(k)
    places = k.shape, k.tobytes()
    found = kept.get(places)
    if found is None:
        found = compute(k)
        if len(kept) >= _MOST:
            kept.clear()
        kept[places] = found
    return found
