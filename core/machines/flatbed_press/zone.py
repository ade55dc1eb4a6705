"""The zone in which bed and cylinder of a flatbed press run together: where it starts and where it ends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import unlike
from gearlink.core.machines.flatbed_press.chains import BedChain, CylinderChain
from gearlink.core.numerics.roots import bracketed_root, maximum, newton_root
from gearlink.core.parts.linkages.slider_crank import SliderCrank, dead_center_extended, dead_center_folded

_TURN = 2.0 * math.pi
_STEP = math.radians(3.0)
_SHORT = 1.0 - 1e-6  # of the longest crank that the rod can follow
_CREST = 1e-9  # the speeds at a crest known to so much are known to 1e-18 of their second derivative


def forward_stroke_end(bed: BedChain) -> float:
    """Input angle at which the bed turns back [rad], where D, E and F stand in line, folded.

    theta_DC turns by pi + asin(e/(EF + DE)) - asin(e/(EF - DE)) from the start to there
    """
    lengths = (bed.slider_crank_length, bed.rod, bed.offset)
    return float(bed.input_angle(math.pi + dead_center_extended(*lengths) - dead_center_folded(*lengths)))


def turning_within(bed: BedChain, start: float, end: float) -> float | None:
    """First input angle between two at which the bed turns back [rad]; None where it never does."""
    places = (place + turn * _TURN for turn in (0, 1) for place in (0.0, forward_stroke_end(bed)))
    return min((place for place in places if start < place < end), default=None)


def equal_speed_angle(
    bed: BedChain, cylinder: CylinderChain, *, advise: bool = True, size: str = "bed.stroke"
) -> float:
    """First input angle after the start at which bed and cylinder have the same speed [rad].

    p'(phi) = q'(phi),  0 < phi < the bed's turning point

    Parameters
        bed, cylinder : BedChain, CylinderChain
        advise : bool - whether a refusal names a repair
        size : str - key by which the file gives the size of the bed drive, bed.stroke or bed.crank
    Raises
        NoSolution - when the speeds never meet on the forward stroke; where advice is asked for, the message says which
            change of the cylinder's initial crank angle makes them meet
    Notes
        Signs are taken every 3 deg; a crest that comes near zero between two points is refined first, so two
        close roots are not stepped over. The root is then exact to the last bits.
    Source
        TY-460 report 3.2
    """
    end = forward_stroke_end(bed)
    root = _first_root(bed, cylinder, end)
    if root is None:
        shift = _shift_that_helps(bed, cylinder, end) if advise else ""
        if shift or not advise:
            text = "bed and cylinder never have the same speed on the forward stroke: no synchronous zone"
            raise NoSolution(text, key="cylinder.initial_crank_angle", fix=shift)
        raise _sizes_that_help(bed, cylinder, end, size)
    return root


def zone_end(cylinder: CylinderChain, start: float, length: float) -> float:
    """Input angle at which the cylinder has turned `length` [mm] beyond `start` [rad].

    Raises
        NoSolution - when a whole revolution is not enough
    Source
        TY-460 report 3.2
    """
    begin = cylinder.position(start)[0]
    most = cylinder.turn
    if length >= most:
        raise NoSolution(
            (f"length of the zone: {length:g} mm (limit < {unlike(most, length)} mm, the cylinder's travel per sheet)"),
            key="sync.length",
            fix=f"set sync.length below {safely_below(most)} mm",
        )

    def left(phi: float) -> tuple[float, float]:
        travel, speed = cylinder.position(phi)
        return travel - begin - length, speed

    return newton_root(left, start, start + _TURN, start + _TURN * length / most)


def equal_speed_angles(bed: BedChain, cylinder: CylinderChain) -> list[float]:
    """Every input angle in [0, 2 pi) at which bed and cylinder have the same speed [rad], ascending.

    p'(phi) = q'(phi)

    Notes
        As `equal_speed_angle`, over both strokes of the bed.
    Source
        TY-460 report 3.2
    """
    end = forward_stroke_end(bed)
    found = [*_equal_speeds(bed, cylinder, 0.0, end), *_equal_speeds(bed, cylinder, end, _TURN)]
    return sorted(dict.fromkeys(phi % _TURN for phi in found))


def _first_root(bed: BedChain, cylinder: CylinderChain, end: float) -> float | None:
    return next(_equal_speeds(bed, cylinder, 0.0, end), None)


def _equal_speeds(bed: BedChain, cylinder: CylinderChain, start: float, end: float) -> Iterator[float]:
    """Input angles of equal speeds in (start, end], ascending, each sought when it is asked for."""

    def excess(phi: float) -> float:
        return bed.speed(phi) - cylinder.speed(phi)

    def slope(phi: float) -> float:
        return float(bed.travel(phi, 2).second - cylinder.travel(phi, 2).second)

    count = max(8, math.ceil((end - start) / _STEP))
    grid = [start + (end - start) * i / count for i in range(count + 1)]
    values = [excess(grid[0]), excess(grid[1])]
    for i in range(1, count + 1):
        if values[i - 1] * values[i] < 0.0 or values[i] == 0.0:
            yield bracketed_root(excess, grid[i - 1], grid[i], ends=(values[i - 1], values[i]))
        if i == count:
            return
        values.append(excess(grid[i + 1]))
        before, here, after = values[i - 1 :]
        # on one side of zero, or both roots beside the crest are found as changes of sign
        if abs(here) <= min(abs(before), abs(after)) and before * here > 0.0 and here * after > 0.0:
            yield from _pair_at_crest(excess, slope, here > 0.0, grid[i - 1], grid[i + 1])


def _pair_at_crest(
    f: Callable[[float], float], slope: Callable[[float], float], above: bool, low: float, high: float
) -> Iterator[float]:
    """Both roots beside a crest that passes zero between the points of a grid; none where it stays on one side."""
    sign = -1.0 if above else 1.0
    ends = sign * slope(low), sign * slope(high)
    if ends[0] > 0.0 > ends[1]:
        place = bracketed_root(lambda phi: sign * slope(phi), low, high, tolerance=_CREST, ends=ends)
        value = sign * f(place)
    else:
        place, value = maximum(lambda phi: sign * f(phi), low, high)
    if value >= 0.0:
        yield bracketed_root(f, low, place)
        yield bracketed_root(f, place, high)


def _shift_that_helps(bed: BedChain, cylinder: CylinderChain, end: float) -> str:
    """The smallest whole-degree shift of the cylinder's crank for which the speeds meet; nothing where none does."""
    for degrees in range(1, 181):
        for sign in (1, -1):
            shifted = replace(cylinder, initial_angle=cylinder.initial_angle + math.radians(sign * degrees))
            if _first_root(bed, shifted, end) is not None:
                value = math.degrees(math.remainder(shifted.initial_angle, _TURN))
                return f"set cylinder.initial_crank_angle to {value:.9g} deg ({sign * degrees:+d} deg)"
    return ""


def _sizes_that_help(bed: BedChain, cylinder: CylinderChain, end: float, size: str) -> NoSolution:
    """The refusal, with the maximum radius of the cylinder and the minimum size of the bed for which they meet."""
    fastest = _greatest(bed.speed, end)
    least = -_greatest(lambda phi: -cylinder.speed(phi), _TURN)
    text = (
        f"the bed (max. {safely_above(fastest)} mm/rad) never reaches the cylinder speed (min. {safely_below(least)} "
        "mm/rad): no synchronous zone"
    )
    crank = _least_crank(bed, cylinder)
    if crank is None:
        radius = safely_below(cylinder.radius * _share(bed, cylinder))
        return NoSolution(text, key="cylinder.radius", fix=f"set cylinder.radius to at most {radius} mm")
    least = crank if size == "bed.crank" else 2.0 * SliderCrank.of_crank(crank, bed.rod, bed.offset).stroke
    return NoSolution(text, key=size, fix=f"set {size} to at least {safely_above(least)} mm")


def _least_crank(bed: BedChain, cylinder: CylinderChain) -> float | None:
    """Minimum crank DE with which the bed is as fast as the cylinder [mm]; None where the rod allows none."""

    def lacks(crank: float) -> float:
        return _share(replace(bed, slider_crank_length=crank), cylinder) - 1.0

    low, most = bed.slider_crank_length, (bed.rod - abs(bed.offset)) * _SHORT
    if not (low < most and lacks(most) > 0.0):
        return None
    return bracketed_root(lacks, low, most, tolerance=1e-9 * most)


def _share(bed: BedChain, cylinder: CylinderChain) -> float:
    """Maximum speed of the bed over that of the cylinder on the forward stroke."""
    return _greatest(lambda phi: bed.speed(phi) / cylinder.speed(phi), forward_stroke_end(bed))


def _greatest(f: Callable[[float], float], end: float) -> float:
    """Maximum value of a smooth function over (0, end), of which one hump is the highest by far."""
    count = max(8, math.ceil(end / _STEP))
    grid = [end * i / count for i in range(count + 1)]
    at = max(range(count + 1), key=lambda i: f(grid[i]))
    return maximum(f, grid[max(at - 1, 0)], grid[min(at + 1, count)])[1]
