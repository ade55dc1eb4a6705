"""The lines of the blocking contour: what a pair may not, or should not, cross with its profile shifts."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing_checks import corner_in_fillet
from gearlink.core.parts.gears.shifts.candidates import strengths

Value = Callable[[GearData], float | None]
_TIPS, _RATIOS = (0.0, 0.2, 0.4), (1.0, 1.1, 1.2)


class Line(NamedTuple):
    """A line of the contour: its value is positive where a pair is good, or changes sign where gears are equal."""

    name: str
    value: Value
    blocks: bool = True
    limits: bool = True

    @property
    def needs_flanks(self) -> bool:
        """Whether its value asks for both tips."""
        return not self.name.startswith(("undercut", "radial"))


def lines_of(data: GearData) -> tuple[Line, ...]:
    """The lines that a pair can have: undercut, tips, contact ratio, root fillets, base circles, ring tips."""
    found: list[Line] = []
    for gear in (0, 1):
        if data.pair.teeth[gear] > 0:
            found.append(Line(f"undercut {gear + 1}", lambda d, g=gear: _undercut(d, g)))  # type: ignore[misc]
        for level in _TIPS:
            name = f"tip {gear + 1} {level:g} m" if level else f"pointed tip {gear + 1}"
            value = lambda d, g=gear, t=level: d.pair.tip_thickness[g] / d.pair.module - t  # noqa: E731
            found.append(Line(name, value, limits=not level))
        found.append(Line(f"fillet {gear + 1}", lambda d, g=gear: _fillet(d, g)))  # type: ignore[misc]
        found.append(Line(f"base circle {gear + 1}", lambda d, g=gear: d.pair.interference_margin[1 - g]))  # type: ignore[misc]
    for ratio in _RATIOS:
        found.append(Line(f"contact ratio {ratio:g}", lambda d, r=ratio: d.pair.contact_ratio - r, limits=ratio == 1.0))  # type: ignore[misc]
    found.append(Line("equal sliding", _sliding, blocks=False, limits=False))
    found.append(Line("equal root stress", _roots, blocks=False, limits=False))
    if data.pair.internal:
        found.append(Line("tip fouling", lambda d: d.internal.tip_fouling_margin if d.internal else None))
        found.append(
            Line("radial assembly", lambda d: d.internal.radial_assembly_margin if d.internal else None, limits=False)
        )
    return tuple(found)


def _undercut(data: GearData, gear: int) -> float | None:
    least = data.pair.min_shift_no_undercut[gear]
    return None if least is None else data.pair.profile_shift[gear] - least


def _fillet(data: GearData, gear: int) -> float | None:
    form, used = data.pair.form_radius[gear], data.path.used_root_radius[gear]
    if form is None or data.pair.interference_margin[1 - gear] < 0.0:
        return None
    corner = corner_in_fillet(data.pair, gear) if used >= form else None
    return used - form if corner is None else corner.gap


def _sliding(data: GearData) -> float:
    one, other = data.pair.specific_sliding
    return one - other


def _roots(data: GearData) -> float | None:
    found = strengths(data)
    return None if found is None else math.log(found[0] / found[1])


def value_of(line: Line, data: GearData) -> float:
    """The value of a line, not a number where a pair has none."""
    try:
        found = line.value(data)
    except NoSolution:
        return math.nan
    return math.nan if found is None else found
