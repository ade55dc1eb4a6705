"""Exact fronts of many objectives, epsilon boxes, the knee, and a spread of rows to be shown. All are minimised.

Objectives are counted in whole multiples of a millionth of their resolution, so that values which differ in their last
bits alone are equal and a front depends on the designs, not on how a machine rounds.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Mask, Reals, distinct

Indices = NDArray[np.intp]
PARTS = 1e6
"""Parts of a resolution that objectives are counted in."""
_BLOCK, _TILE = 512, 1024
_SIEVES = 24
_GOLDEN = 0.6180339887498949
_ROUNDING = 1e-12


def counted(objectives: Reals, resolution: Reals) -> Reals:
    """Objectives as whole multiples of a millionth of their resolution.

    Parameters
        objectives : (N, k) array - to be minimised
        resolution : (k,) array - of each, positive
    Returns
        multiples : (N, k) array of whole numbers
    Example
        >>> counted(np.array([[1.0, 0.1 + 0.2], [1.0, 0.3]]), np.array([0.5, 0.1])).tolist()
        [[2000000.0, 3000000.0], [2000000.0, 3000000.0]]
    """
    multiples: Reals = np.rint(objectives / (resolution / PARTS))
    return multiples


def front(values: Reals) -> Indices:
    """Rows that no other row dominates: none is at most as large everywhere and smaller somewhere. Equal rows all stay.

    Parameters
        values : (N, k) array - k >= 1
    Returns
        places : (M,) array - ascending
    Notes
        A few good rows sieve the rest. Two objectives by sorting and a running minimum. More: sorted by the sum of
        ranks, no row can dominate an earlier one, and blocks are folded into the front.
    Example
        >>> front(np.array([[1, 5], [2, 4], [2, 4], [3, 4], [5, 1]])).tolist()
        [0, 1, 2, 4]
    """
    if len(values) == 0:
        return np.empty(0, dtype=np.intp)
    if values.shape[1] == 1:
        return np.flatnonzero(values[:, 0] == values[:, 0].min())
    places = _sieved(np.asarray(values, dtype=float))
    unique, back = np.unique(values[places], axis=0, return_inverse=True)
    best = _front_of_two(unique) if values.shape[1] == 2 else _front_of_many(unique)
    stays = np.zeros(len(unique), dtype=bool)
    stays[best] = True
    return places[stays[back.reshape(-1)]]


def _sieved(values: Reals) -> Indices:
    """Places without the rows that the best ones by some weights dominate."""
    places, k = np.arange(len(values)), values.shape[1]
    low, high = values.min(axis=0), values.max(axis=0)
    scaled = (values - low) / np.where(high > low, high - low, 1.0)
    for i in range(_SIEVES):
        if len(places) <= _BLOCK:
            break
        weights = 0.05 + ((i + 1) * _GOLDEN * np.arange(1, k + 1)) % 1.0
        best = int(np.argmin(scaled @ weights))
        above, differs = np.ones(len(places), dtype=bool), np.zeros(len(places), dtype=bool)
        for column in scaled.T:
            above &= column >= column[best]
            differs |= column > column[best]
        left = np.logical_not(above & differs)
        places, scaled = places[left], scaled[left]
    return places


def _front_of_two(unique: Reals) -> Indices:
    """Rows stand in lexicographic order and differ: one stays where the second objective falls below all before."""
    least = np.minimum.accumulate(unique[:, 1])
    return np.flatnonzero(np.concatenate([[True], unique[1:, 1] < least[:-1]]))


def _front_of_many(unique: Reals) -> Indices:
    ranks = np.array([np.searchsorted(np.sort(column), column) for column in unique.T])
    order = np.argsort(ranks.sum(axis=0), kind="stable")
    found = np.empty(0, dtype=np.intp)
    for start in range(0, len(order), _BLOCK):
        block = order[start : start + _BLOCK]
        block = block[~_dominated(unique[block], unique[found])]
        block = block[~_dominated(unique[block], unique[block], same=True)]
        found = np.concatenate([found, block])
    return found


def _dominated(rows: Reals, by: Reals, *, same: bool = False) -> Mask:
    """Which rows some other row dominates; no two rows are equal, but `by` may be the rows themselves (`same`)."""
    gone = np.zeros(len(rows), dtype=bool)
    for start in range(0, len(by), _TILE):
        left = np.flatnonzero(~gone)
        tile = by[start : start + _TILE]
        below = tile[:, 0] <= rows[left, 0, None]
        for mine, other in zip(rows[left, 1:].T, tile[:, 1:].T, strict=True):
            below &= other <= mine[:, None]
        count = below.sum(axis=1)
        inside = (left >= start) & (left < start + len(tile)) if same else np.zeros(len(left), dtype=bool)
        gone[left] |= count > inside
    return gone


def boxes(multiples: Reals) -> Indices:
    """One design of each box, of the boxes that no other dominates.

    A box is as wide as the resolution in each objective and begins at a multiple of it; of a box the design stays that
    is nearest to its best corner, then the one of the minimum objectives in their order, then the first.

    Parameters
        multiples : (N, k) array - of designs that are a front, from `counted`, in the order of their indices
    Returns
        places : (M,) array - ascending
    Notes
        The boxes' origin is 0, so none moves when a design is added.
    """
    if len(multiples) == 0:
        return np.empty(0, dtype=np.intp)
    corner = np.floor(multiples / PARTS)
    return _nearest(multiples, corner, front(corner))


def best_boxes(multiples: Reals, most: int) -> Indices:
    """Of a single objective: one design of each of the best boxes.

    Parameters
        multiples : (N, 1) array - of designs in the order of their indices
    Returns
        places : (M,) array - ascending, at most `most`
    """
    corner = np.floor(multiples / PARTS)
    limit = distinct(corner)[:most]
    return _nearest(multiples, corner, np.flatnonzero(corner[:, 0] <= limit[-1])) if limit.size else _none()


def _none() -> Indices:
    return np.empty(0, dtype=np.intp)


def _nearest(multiples: Reals, corner: Reals, places: Indices) -> Indices:
    """Of each box among some designs the one nearest to its best corner."""
    rows, at = multiples[places], corner[places]
    away = ((rows - at * PARTS) ** 2).sum(axis=1)
    order = np.lexsort((places, *reversed(list(rows.T)), away, *reversed(list(at.T))))
    ranked = at[order]
    first = np.concatenate([[True], (ranked[1:] != ranked[:-1]).any(axis=1)])
    return np.sort(places[order[first]])


def knee(objectives: Reals) -> int | None:
    """Row of the minimum sum of objectives, each scaled from 0 to 1 over the rows; none of fewer than three.

    Parameters
        objectives : (N, k) array - in the order of the rows shown
    Notes
        It moves with the ends of the front: a mark, no verdict. Ties within 1e-12 go to the first row; an objective
        in which the rows differ by less has no share in it.
    Example
        >>> knee(np.array([[0.0, 10.0], [1.0, 2.0], [8.0, 0.0]]))
        1
    """
    if len(objectives) < 3:
        return None
    return int(np.argmin(np.round(_scaled(objectives).sum(axis=1), 12)))


def _scaled(objectives: Reals) -> Reals:
    """Each objective from 0 to 1 over the rows; 0 where these are alike but for rounding."""
    low, high = objectives.min(axis=0), objectives.max(axis=0)
    differs = high - low > _ROUNDING * np.maximum(np.abs(low), np.abs(high))
    return np.where(differs, (objectives - low) / np.where(differs, high - low, 1.0), 0.0)


def spread(objectives: Reals, most: int, first: int) -> Indices:
    """So many rows far from each other, beginning with `first`: each next one is the farthest from all taken.

    Returns
        places : array - ascending; all rows where there are no more than `most`
    """
    count = len(objectives)
    if count <= most:
        return np.arange(count)
    scaled = _scaled(objectives)
    taken, away = [first], np.full(count, np.inf)
    while len(taken) < most:
        away = np.minimum(away, np.round(((scaled - scaled[taken[-1]]) ** 2).sum(axis=1), 12))
        away[taken] = -1.0
        taken.append(int(np.argmax(away)))
    return np.sort(np.array(taken))
