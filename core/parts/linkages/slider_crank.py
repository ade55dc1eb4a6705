"""The offset slider-crank: crank length from stroke, dead centres, position; stroke with time ratio; many positions.

Frame: crank pivot D = (0, 0), crank pin E = r (cos psi, sin psi), slider F below on the line x = -e (the offset e
is positive where the line passes to the left of D); the depth of the slider is h = -y_F.

A stroke and a time ratio give the linkage with a rod, a crank or the best transmission angle. Crank r, rod L,
offset e, stroke S, K slow over fast stroke, p = 90 deg (K - 1)/(K + 1). D and both dead centres of the slider make a
triangle of the sides L + r, L - r and S, 2 p at D and e its height:

    (S/2)^2 = r^2 cos^2 p + L^2 sin^2 p,   e = (L^2 - r^2) sin(2 p)/S

The angle at the inner dead centre is obtuse where S/2 < L < (S/2) cot p, that is (S/2) tan p < r < S/2: else the slider
would pass below D, and its strokes would be others.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

from gearlink.core.base.design import placed
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.wording import short, unlike
from gearlink.core.numerics.elementary import SCALARS, Elementary

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from gearlink.core.numerics.arrays import Reals


SLIDER_QUANTITIES = ("quick_return_ratio", "dead_center_extended", "dead_center_folded", "max_stroke")


class SliderCrankQuantities:
    """Quantities of a design that has a `slider_crank`."""

    crank_length: float = placed("slider_crank.crank_length")
    quick_return_ratio: float = placed("slider_crank.quick_return_ratio")
    dead_center_extended: float = placed("slider_crank.dead_center_extended")
    dead_center_folded: float = placed("slider_crank.dead_center_folded")
    max_stroke: float = placed("slider_crank.max_stroke")


def max_stroke(rod: float, offset: float = 0.0) -> float:
    """Stroke at which the crank could only just turn; a slider-crank's stroke stays below it.

    S_max = 2 sqrt(L (L - |e|))

    Parameters
        rod : float [mm] - length L
        offset : float [mm] - e, signed
    Returns
        stroke : float [mm]
    Raises
        NoSolution - when the offset is not smaller than the rod
    Example
        >>> round(max_stroke(520.0, 50.0), 6)
        988.736568

    Source
        own derivation: crank L - |e| in S = P - Q
    """
    _check_rod(rod, offset)
    return _max_stroke(rod, offset)


def _max_stroke(rod: float, offset: float, f: Elementary = SCALARS) -> float:
    return 2.0 * f.sqrt(rod * (rod - abs(offset)))


def _crank_length(stroke: float, rod: float, offset: float, f: Elementary = SCALARS) -> float:
    numerator, denominator = _radicands(stroke, rod, offset, f)
    return stroke / 2.0 * f.sqrt(numerator / denominator)


def _stroke(crank: float, rod: float, offset: float, f: Elementary = SCALARS) -> float:
    far, near = _reaches(crank, rod, offset, f)
    return 4.0 * rod * crank / (far + near)


def dead_center_extended(crank: float, rod: float, offset: float = 0.0) -> float:
    """Angle of the rod from the slide line where crank and rod are stretched.

    asin(e/(L + r))

    Parameters
        crank, rod, offset : float [mm] - r, L, e (signed)
    Returns
        angle : float [rad] - of the sign of the offset; the crank's direction is -pi/2 less this angle
    Raises
        NoSolution - when the crank cannot make a full revolution
    Example
        >>> round(math.degrees(dead_center_extended(154.21159203908383, 520.0, 50.0)), 9)
        4.252999348

    Source
        TY-460 report 2.1
    """
    _check_crank(crank, rod, offset)
    return math.atan2(offset, _reaches(crank, rod, offset)[0])


def dead_center_folded(crank: float, rod: float, offset: float = 0.0) -> float:
    """Angle of the rod from the slide line where crank and rod overlap.

    asin(e/(L - r))

    Parameters
        crank, rod, offset : float [mm] - r, L, e (signed)
    Returns
        angle : float [rad] - of the sign of the offset; the crank's direction is pi/2 less this angle
    Raises
        NoSolution - when the crank cannot make a full revolution
    Example
        >>> round(math.degrees(dead_center_folded(154.21159203908383, 520.0, 50.0)), 9)
        7.856416254

    Source
        TY-460 report 2.1
    """
    _check_crank(crank, rod, offset)
    return math.atan2(offset, _reaches(crank, rod, offset)[1])


@dataclass(frozen=True)
class SliderCrank:
    """Slider-crank of a given stroke, each value worked out when it is asked for.

    P = 2 L r/S + S/2,  Q = 2 L r/S - S/2,  tan(extended) = e/P,  tan(folded) = e/Q

    Parameters
        stroke, rod, offset : float [mm] - S, L, e (signed)
    Returns
        Properties: crank_length, max_stroke [mm]; dead_center_extended, dead_center_folded [rad];
        quick_return_ratio [1], crank angle of the stroke away from the crank pivot over that of the stroke back, for a
        crank that turns counter-clockwise: 1/K for one that turns clockwise, and for the mirror image
    Raises
        NoSolution - for a stroke that is not positive or not below max_stroke, or an offset beyond the rod
    Notes
        Squaring S = P - Q twice also solves P + Q = S; those roots lie beyond max_stroke. Radicands are formed as
        products (whichever form cancels less): a few ulp up to max_stroke, where dr/dS goes to 0.
        Near the largest stroke the crank hardly depends on the stroke, so that the folded dead centre cannot be
        had from the rounded crank. Here Q comes from the stroke,
        Q = (S_max^2 - S^2)(4 L^2 - S^2 + 4 L |e|)/(2 D (4 L r/S + S)), D = 4 L^2 - S^2.
    Example
        >>> SliderCrank(100.0, 200.0, 0.0).crank_length
        50.0

    Source
        TY-460 report 2.1; the closed form of the crank is an own derivation
    """

    stroke: float
    rod: float
    offset: float = 0.0

    fn: ClassVar[Elementary] = SCALARS
    """What the formulas are made of; the class of many slider-cranks has those for arrays."""

    def __post_init__(self) -> None:
        _check_stroke(self.stroke, self.rod, self.offset)

    @classmethod
    def of_crank(cls, crank: float, rod: float, offset: float = 0.0) -> SliderCrank:
        """The slider-crank of a given crank.

        Raises
            NoSolution - when the crank cannot make a full revolution
        Example
            >>> SliderCrank.of_crank(50.0, 200.0).stroke
            100.0
        """
        cls._require_turn(crank, rod, offset)
        made = cls(_stroke(crank, rod, offset, cls.fn), rod, offset)
        keep(made, crank_length=crank)  # as it is given, not by way of the stroke
        return made

    @classmethod
    def _require_turn(cls, crank: float, rod: float, offset: float) -> None:
        _check_crank(crank, rod, offset, below=True)

    @cached_property
    def max_stroke(self) -> float:
        """S_max = 2 sqrt(L (L - |e|)) [mm]."""
        return _max_stroke(self.rod, self.offset, self.fn)

    @cached_property
    def crank_length(self) -> float:
        """r = (S/2) sqrt((4 L^2 - 4 e^2 - S^2)/(4 L^2 - S^2)) [mm]."""
        return _crank_length(self.stroke, self.rod, self.offset, self.fn)

    @property
    def crank_per_stroke(self) -> float:
        """Change of the crank per mm of the stroke, in closed form.

        r = (s/2) sqrt((4 L^2 - 4 e^2 - s^2)/(4 L^2 - s^2))
        """
        s = self.stroke
        inner, outer = 4.0 * (self.rod**2 - self.offset**2) - s * s, 4.0 * self.rod**2 - s * s
        return self.crank_length * (1.0 / s - s / inner + s / outer)

    @cached_property
    def _far(self) -> float:
        return 2.0 * self.rod * self.crank_length / self.stroke + self.stroke / 2.0

    @cached_property
    def _near(self) -> float:
        s, rod = self.stroke, self.rod
        square = (2.0 * rod - s) * (2.0 * rod + s)
        left = (self.max_stroke - s) * (self.max_stroke + s)
        return left * (1.0 + 4.0 * rod * abs(self.offset) / square) / (2.0 * (4.0 * rod * self.crank_length / s + s))

    @cached_property
    def dead_center_extended(self) -> float:
        """asin(e/(L + r)) [rad]."""
        return self.fn.atan2(self.offset, self._far)

    @cached_property
    def dead_center_folded(self) -> float:
        """asin(e/(L - r)) [rad]."""
        return self.fn.atan2(self.offset, self._near)

    @cached_property
    def quick_return_ratio(self) -> float:
        """K = (180 + t)/(180 - t) [1], t = folded less extended dead centre."""
        return _ratio(self._far, self._near, self.stroke, self.offset, self.fn)


def slider(psi: float, crank: float, rod: float, offset: float = 0.0, order: int = 0) -> tuple[float, ...]:
    """Depth of the slider below the crank pivot, with derivatives with respect to the crank direction.

    h = w - r sin(psi),  w = sqrt(L^2 - u^2),  u = r cos(psi) + e

    Parameters
        psi : float [rad] - direction of the crank from +x, counter-clockwise
        crank, rod, offset : float [mm] - r, L, e (signed)
        order : 0 to 3 - derivatives wanted
    Returns
        h and its derivatives up to the order : tuple of floats [mm, mm/rad, mm/rad^2, mm/rad^3]
    Raises
        NoSolution - when the rod does not reach the slide line there, or just reaches it (derivatives)
    Notes
        Condition number of the derivatives: the rod's angle, L^2/w^2.
    Example
        >>> slider(-math.pi / 2, 50.0, 200.0, 0.0, 2)[::2]
        (250.0, -62.5)

    Source
        TY-460 report 2.1; the closed form of the crank is an own derivation
    """
    return _depths(psi, crank, rod, offset, order, SCALARS)


def _depths(psi: Any, crank: Any, rod: Any, offset: Any, order: int, fn: Elementary) -> tuple[Any, ...]:
    """Depth and derivatives of one direction or of many; w w' = -u u' with u' = -r sin(psi), differentiated further."""
    along, across = crank * fn.cos(psi), crank * fn.sin(psi)
    u = along + offset
    square = (rod - u) * (rod + u)
    least = square if fn is SCALARS else square.min(initial=math.inf)
    if least < 0.0 or (least == 0.0 and order > 0):
        first = psi if fn is SCALARS else psi.flat[int((square < 0.0 if order == 0 else square <= 0.0).argmax())]
        raise NoSolution(not_reached(math.remainder(first, math.tau), crank, rod, offset))
    w = fn.sqrt(square)
    if order == 0:
        return (w - across,)
    w1 = u * across / w
    if order == 1:
        return w - across, w1 - along
    w2 = -(across * across - u * along + w1 * w1) / w
    if order == 2:
        return w - across, w1 - along, across + w2
    w3 = -(3.0 * across * along + u * across + 3.0 * w1 * w2) / w
    return w - across, w1 - along, across + w2, along + w3


def not_reached(psi: float, crank: float, rod: float, offset: float) -> str:
    """Message for a crank position at which the rod does not reach the slide line."""
    return (
        f"rod: {unlike(rod, crank + abs(offset))} mm (limit > {unlike(crank + abs(offset), rod)} mm, crank + offset) "
        f"at crank direction {short(math.degrees(psi))} deg, where it does not reach the slide line\nset rod above "
        f"{safely_above(crank + abs(offset))} mm"
    )


def _check_rod(rod: float, offset: float) -> None:
    if not 0.0 < rod < math.inf:
        raise NoSolution(f"rod {rod:g} mm: its length must be positive")
    if not abs(offset) < rod:
        raise NoSolution(
            f"magnitude of the offset: {unlike(abs(offset), rod)} mm (limit < {unlike(rod, abs(offset))} mm, the rod)",
            fix=f"set the offset within -{safely_below(rod)} and {safely_below(rod)} mm",
        )


def _check_stroke(stroke: float, rod: float, offset: float) -> None:
    largest = max_stroke(rod, offset)
    if not stroke > 0.0:
        raise NoSolution(f"stroke {stroke:g} mm: it must be positive")
    if not stroke < largest:
        raise NoSolution(
            f"stroke: {unlike(stroke, largest)} mm (limit < {unlike(largest, stroke)} mm with rod {short(rod)} "
            f"mm and offset {short(offset)} mm)",
            fix=f"set stroke below {safely_below(largest)} mm, lengthen the rod or reduce the offset",
        )


def _radicands(stroke: float, rod: float, offset: float, f: Elementary) -> tuple[float, float]:
    """4 L^2 - 4 e^2 - S^2 and 4 L^2 - S^2, without loss of digits below max_stroke."""
    e = abs(offset)
    denominator = (2.0 * rod - stroke) * (2.0 * rod + stroke)
    short, long = denominator - 4.0 * e * e, 4.0 * (rod - e) * (rod + e) - stroke * stroke
    return f.where(2.0 * e < rod, short, long), denominator


def _check_crank(crank: float, rod: float, offset: float, *, below: bool = False) -> None:
    """Refuse a crank that cannot turn; where it stays `below` the limit, the one that only just could as well."""
    _check_rod(rod, offset)
    e, difference = abs(offset), rod - crank
    if not crank > 0.0:
        raise NoSolution(f"crank {crank:g} mm: its length must be positive")
    if not (e < difference if below else e <= difference):
        limit, words = ("<", "below") if below else ("<=", "to at most")
        raise NoSolution(
            f"crank: {unlike(crank, rod - e)} mm "
            f"(limit {limit} {unlike(rod - e, crank)} mm, rod - offset, to turn fully)",
            fix=f"set the crank {words} {safely_below(rod - e)} mm",
        )


def _reaches(crank: float, rod: float, offset: float, f: Elementary = SCALARS) -> tuple[float, float]:
    """P and Q: depths of the slider at the dead centres."""
    e, difference, total = abs(offset), rod - crank, rod + crank
    return f.sqrt((total - e) * (total + e)), f.sqrt((difference - e) * (difference + e))


def _ratio(far: float, near: float, stroke: float, offset: float, f: Elementary = SCALARS) -> float:
    t = f.atan2(offset * stroke, far * near + offset * offset)
    return (math.pi + t) / (math.pi - t)


class QuickReturn(NamedTuple):
    """Crank, rod and offset [mm]."""

    crank: float
    rod: float
    offset: float


def quick_return(stroke: float, ratio: float, rod: float | None = None, crank: float | None = None) -> QuickReturn:
    """The slider-crank of a stroke and a time ratio.

    Parameters
        stroke : float [mm]
        ratio : float - K, 1 or more
        rod, crank : float [mm] - at most one of them; without either, the transmission angle is the best there is
    Raises
        NoSolution - with the key, where no slider-crank has this stroke and ratio
    Example
        >>> found = quick_return(310.0, 1.1, rod=520.0)
        >>> round(found.crank, 9), round(found.offset, 9)
        (150.470496796, 119.117766514)

    Source
        own derivation, from the triangle of the dead centres
    """
    p, half = 0.5 * math.pi * (ratio - 1.0) / (ratio + 1.0), 0.5 * stroke
    if p == 0.0 and rod is None:
        message = "strokes of equal time have the crank stroke/2 and no offset, whatever the rod"
        raise NoSolution(message, key="quick_return_ratio", fix="give rod")
    sine, cosine = math.sin(p), math.cos(p)
    if rod is not None:
        _require_within("rod", rod, half, half * cosine / sine if p else math.inf, ratio)
        found = math.sqrt((half - rod * sine) * (half + rod * sine)) / cosine
        return QuickReturn(found, rod, _offset(found, rod, p, stroke))
    if crank is not None:
        _require_within("crank", crank, half * sine / cosine, half, ratio)
        found = math.sqrt((half - crank * cosine) * (half + crank * cosine)) / sine
        return QuickReturn(crank, found, _offset(crank, found, p, stroke))
    return _best(half, p, ratio)


def _best(half: float, p: float, ratio: float) -> QuickReturn:
    """The minimum (r + e)/L, which is the cosine of the minimum transmission angle.

    (S/(2 L))^2 = g = (r/L)^2 cos^2 p + sin^2 p,   g^2 - g sin^2 p - sin^2 p = 0

    Source
        own derivation: the derivative of (r + e)/L by r/L is 0 where g^3 = sin^2 p (g - sin^2 p)(g + 1)^2, of which
        g = tan^2 p belongs to the flat triangle
    """
    if ratio >= 3.0:
        raise NoSolution(
            f"no slider-crank has a time ratio of {ratio:g}",
            key="quick_return_ratio",
            fix="set quick_return_ratio below 3",
        )
    sine, cosine = math.sin(p), math.cos(p)
    g = 0.5 * sine * (sine + math.hypot(sine, 2.0))
    rod = half / math.sqrt(g)
    crank = rod * math.sqrt(0.5 * sine * (math.hypot(sine, 2.0) - sine)) / cosine
    return QuickReturn(crank, rod, _offset(crank, rod, p, 2.0 * half))


def _offset(crank: float, rod: float, p: float, stroke: float) -> float:
    return (rod - crank) * (rod + crank) * math.sin(2.0 * p) / stroke


def _require_within(key: str, length: float, low: float, high: float, ratio: float) -> None:
    """Refuse a rod or a crank outside its limits."""
    if low < length < high:
        return
    if not low < high:
        text, fix = f"no {key} gives a time ratio of {ratio:g} (limit < 3)", "set quick_return_ratio below 3"
    elif length >= high:
        most = safely_below(high)
        text = f"{key}: {unlike(length, high)} mm (limit < {most} mm with this stroke and time ratio)"
        fix = f"set {key} below {most} mm"
    else:
        least = safely_above(low)
        text = f"{key}: {unlike(length, low)} mm (limit > {least} mm with this stroke and time ratio)"
        fix = f"set {key} above {least} mm"
    raise NoSolution(text, key=key, fix=fix)


def slider_sweep(psi: ArrayLike, crank: float, rod: float, offset: float = 0.0, order: int = 0) -> tuple[Reals, ...]:
    """Depths of the slider below the crank pivot, with derivatives with respect to the crank direction.

    h = w - r sin(psi),  w = sqrt(L^2 - u^2),  u = r cos(psi) + e

    Parameters
        psi : float array of any shape [rad] - directions of the crank from +x, counter-clockwise
        crank, rod, offset : float [mm] - r, L, e (signed)
        order : 0..3 - derivatives wanted
    Returns
        h, h', h'', h''' up to the order : tuple of arrays of that shape [mm, mm/rad ... mm/rad^3]
    Raises
        NoSolution - when the rod does not reach the slide line at one of the positions
    Example
        >>> import numpy as np
        >>> slider_sweep([0.0, -np.pi / 2], 50.0, 200.0)[0].round(6)
        array([193.649167, 250.      ])

    Source
        TY-460 report 2.1; own derivation
    """
    import numpy as np

    from gearlink.core.numerics.elementary_sweep import ARRAYS

    return _depths(np.asarray(psi, dtype=np.float64), crank, rod, offset, order, ARRAYS)
