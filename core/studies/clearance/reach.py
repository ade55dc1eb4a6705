"""How near two axes come to each other over the cycle, and how far apart they get."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from itertools import combinations
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.parts.linkages.fourbar.nearest_passes import joint_to_crank_pivot
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.arrays import Points, Reals

_TURN = 2.0 * math.pi


class Reach(NamedTuple):
    """Minimum and maximum distance of two axes [mm] and the input angles [rad] where they occur.

    Notes
        The angles are None where the distance never changes.
    """

    nearest: float
    farthest: float
    nearest_at: float | None = None
    farthest_at: float | None = None


def constant(distance: float) -> Reach:
    """Two axes on one link, or both in the frame.

    Parameters
        distance : float [mm]
    """
    return Reach(distance, distance)


def crank_pin(crank: float, frame: float, start: float = 0.0, end: float = _TURN) -> Reach:
    """The pin of a turning link against an axis of the frame.

    |BD|^2 = (d - a)^2 + 4 a d sin^2(phi/2)

    Parameters
        crank : float [mm] - a, the link AB that turns about A
        frame : float [mm] - d = AD; phi counts from A->D
        start, end : float [rad] - the input angles that are passed
    Returns
        reach : Reach - |d - a| and d + a where the range passes them, else the distances at its ends
    Example
        >>> crank_pin(18.0, 121.4).nearest, round(crank_pin(10.0, 61.0, math.radians(60.0), math.pi).nearest, 9)
        (103.4, 56.665686266)
    """
    ends = [
        (math.hypot(frame - crank, 2.0 * math.sqrt(crank * frame) * math.sin(0.5 * phi)), phi) for phi in (start, end)
    ]
    folded, stretched = _first_passed(0.0, start, end), _first_passed(math.pi, start, end)
    near = min(ends) if folded is None else (abs(frame - crank), folded)
    far = max(ends) if stretched is None else (frame + crank, stretched)
    return Reach(near[0], far[0], near[1], far[1])


def _first_passed(angle: float, start: float, end: float) -> float | None:
    """The first input angle of a range that is the given one up to whole revolutions."""
    place = angle + _TURN * math.ceil((start - angle) / _TURN)
    return place if place <= end else None


def coupler_joint(linkage: FourBar) -> Reach:
    """The coupler joint C against the crank pivot A over a revolution of the crank.

    Parameters
        linkage : FourBar - its crank turns fully
    Raises
        NoSolution - as `joint_to_crank_pivot`
    Example
        >>> coupler_joint(FourBar(18.0, 50.0, 100.0, 121.4)).nearest
        32.0
    """
    near, far = joint_to_crank_pivot(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, linkage.assembly)
    return Reach(near.distance, far.distance, near.crank_angle, far.crank_angle)


def reaches(
    motion: Motion, axes: Mapping[str, tuple[str, complex | str]], pairs: Iterable[str] = (), *, samples: int = 2048
) -> dict[str, Reach]:
    """Reaches of axes over all inputs of a motion, searched together.

    Parameters
        motion : Motion
        axes : by letter - the link that an axis stands on, "frame" among them, and the point of it [mm]
        pairs : two letters each; without them every two axes
        samples : int - places over the inputs that are looked at first
    Returns
        reaches : by pair - the places within the period or range of the input
    Raises
        NoSolution - where the mechanism does not close
    """
    import numpy as np

    from gearlink.core.numerics.extremes import extremes_over
    from gearlink.core.numerics.together import kept_last

    def places(phi: Reals) -> dict[str, Points]:
        links = motion.at(phi, 0).links
        return {
            name: np.full(phi.shape, at, dtype=np.complex128) if link == "frame" else links[link].at(at).value
            for name, (link, at) in axes.items()
        }

    placed, asked = kept_last(places), [*pairs] or ["".join(pair) for pair in combinations(axes, 2)]

    def distance(one: str, other: str) -> Callable[[Reals], Reals]:
        return lambda phi: np.asarray(np.abs(placed(phi)[one] - placed(phi)[other]))

    given = motion.input
    distances = [distance(pair[0], pair[1]) for pair in asked]
    wanted = [(each, greatest) for each in distances for greatest in (False, True)]
    found = iter(extremes_over(wanted, given.start, given.end, joints=given.joints, samples=samples))
    near_far = {pair: (next(found), next(found)) for pair in asked}
    return {pair: Reach(near.value, far.value, near.place, far.place) for pair, (near, far) in near_far.items()}
