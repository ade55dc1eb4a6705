"""Choice of the idler of a three-gear four-bar: the smallest that keeps transmission angle and gear gap."""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.motion import GearTrain, gear_gap
from gearlink.core.parts.linkages.fourbar.position import FourBar

LEAST_IDLER = 17
GREATEST_IDLER = 400
_RING_DIFFERENCE = 8


def idler_for_ratio(i3: float, output_teeth: int) -> int:
    """Idler whose ratio to the output gear comes nearest to a wanted one.

    z3 = round(-i3 z5)

    Parameters
        i3 : float - negative
        output_teeth : int - z5
    Returns
        idler_teeth : int - at least 1
    Raises
        NoSolution - when the nearest number of teeth is 0, or i3 is not negative
    Example
        >>> idler_for_ratio(-1.7798080356711419, 40)
        71

    Source
        thesis 4.1.4, example 1
    """
    teeth = math.floor(-i3 * output_teeth + 0.5) if math.isfinite(i3) else 0
    if teeth < 1:
        raise NoSolution(
            f"no idler has the ratio i3 = {i3:.9g} to an output gear of {output_teeth} teeth; i3 must be at most "
            f"{-1.0 / output_teeth:.9g}, one tooth"
        )
    return teeth


def smallest_idler(
    design: Callable[[int], FourBar],
    crank_teeth: int,
    output_teeth: int,
    module: float,
    *,
    min_transmission_angle: float,
    min_gear_gap: float,
    addendum: float = 1.0,
    clear: Callable[[FourBar, int], bool] | None = None,
) -> int:
    """Smallest idler from 17 to 400 teeth whose design keeps transmission angle and gear gap, and clears the shafts.

    mu_min >= limit  and  s15 >= limit

    Parameters
        design : function - gives the linkage of an idler's teeth, or raises NoSolution where there is none
        crank_teeth, output_teeth : int - z1, z5
        module : float [mm]
        min_transmission_angle : float [rad] - limit of mu_min
        min_gear_gap : float [mm] - limit of the gap between the tips of gears 1 and 5
        addendum : float - h_a*
        clear : function of linkage and idler - whether no gear reaches a shaft; where no idler does, shafts do not
            count: only more teeth on crank and output gear, or thinner shafts, help there
    Returns
        idler_teeth : int
    Raises
        NoSolution - with key `gears.idler` where no idler keeps both limits: which one stands in the way and what is
            reached at best; where no idler gives a design at all, the refusal of the last one as it came
    Notes
        Closed forms and no search over the turn: all 384 idlers cost about 5 ms.
    Example
        >>> from gearlink.core.machines.three_gear.dwell.momentary_dwell import momentary_linkage
        >>> smallest_idler(lambda z: momentary_linkage(25.0, 1.25 * z, 75.0, 16.0), 20, 60, 2.5,
        ...                min_transmission_angle=math.radians(40.0), min_gear_gap=0.0)
        19

    Source
        thesis 4.1.4: i3 is chosen for transmission angle and collision of gears 1 and 5
    """
    reached: list[tuple[int, float, float]] = []
    refusal: NoSolution | None = None
    beside = 0
    greatest = _greatest_idler(crank_teeth, output_teeth)
    if greatest < LEAST_IDLER:
        ring, key = (crank_teeth, "gears.crank") if crank_teeth < 0 else (output_teeth, "gears.output")
        least = LEAST_IDLER + _RING_DIFFERENCE
        raise NoSolution(f"no idler fits into a ring of {-ring} teeth: it needs {least} or more", key=key)
    for idler in range(LEAST_IDLER, greatest + 1):
        try:
            linkage = design(idler)
        except NoSolution as error:
            refusal = error
            continue
        angle = linkage.min_transmission_angle()
        train = GearTrain(crank_teeth, idler, output_teeth)
        # a ring stands in a plane of its own
        gap = math.inf if train.internal else gear_gap(linkage, train, module, addendum)
        if angle >= min_transmission_angle and gap >= min_gear_gap:
            if clear is None or clear(linkage, idler):
                return idler
            beside = beside or idler
        reached.append((idler, angle, gap))
    if beside:
        return beside
    if refusal is not None and not reached:
        raise refusal
    raise NoSolution(_obstacle(reached, min_transmission_angle, min_gear_gap), key="gears.idler")


def _greatest_idler(crank_teeth: int, output_teeth: int) -> int:
    """400 teeth, or so many that the tips of a ring of 20 deg pressure angle do not foul them: 8 less than its own."""
    rings = [-teeth for teeth in (crank_teeth, output_teeth) if teeth < 0]
    return min([GREATEST_IDLER, *(ring - _RING_DIFFERENCE for ring in rings)])


def _obstacle(reached: list[tuple[int, float, float]], angle_limit: float, gap_limit: float) -> str:
    """Which limit keeps every idler out, with the best value reached and where."""
    best_angle = max(reached, key=lambda row: row[1])
    best_gap = max(reached, key=lambda row: row[2])
    angles = f"the least transmission angle reaches {math.degrees(best_angle[1]):.4g} deg at most"
    gaps = f"the gap of crank and output gear reaches {best_gap[2]:.4g} mm at most"
    head = f"no idler from {LEAST_IDLER} to {GREATEST_IDLER} teeth keeps the limits: "
    asked_angle, asked_gap = f"{math.degrees(angle_limit):g} deg", f"{gap_limit:g} mm"
    if best_gap[2] < gap_limit:
        return f"{head}{gaps} (idler {best_gap[0]}), below {asked_gap}; change the crank and output teeth or the task"
    if best_angle[1] < angle_limit:
        return f"{head}{angles} (idler {best_angle[0]}), below {asked_angle}; lower limits.transmission_angle"
    both = max((row for row in reached if row[2] >= gap_limit), key=lambda row: row[1])
    return (
        f"{head}where the gear gap keeps {asked_gap}, the least transmission angle reaches "
        f"{math.degrees(both[1]):.4g} deg at most (idler {both[0]}), below {asked_angle}; lower one of the limits"
    )
