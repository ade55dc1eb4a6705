"""Maximum and minimum values of a motion with the places where they occur, as quantities of a design.

Of a curve `bed_velocity` there are `bed_velocity_max`, `bed_velocity_max_at` and the same of `_min`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals

    Curve = Callable[[Reals], Reals]


def names(*curves: str) -> tuple[str, ...]:
    """The quantities of some curves.

    Example
        >>> names("speed")
        ('speed_max', 'speed_max_at', 'speed_min', 'speed_min_at')
    """
    return tuple(f"{curve}_{side}" for curve in curves for side in ("max", "max_at", "min", "min_at"))


def extremes(
    curves: Mapping[str, Curve], start: float, end: float, *, joints: Sequence[float] = (), samples: int = 512
) -> dict[str, float]:
    """Refined extremes of curves over an interval.

    Parameters
        curves : name -> function of arrays of the input angle [rad]
        start, end : float [rad]
        joints, samples : as of `maximum_over`
    Returns
        values : dict - by the names of `names`, places in rad
    Example
        >>> import numpy as np
        >>> found = extremes({"speed": lambda phi: 1.0 + np.cos(phi)}, 0.0, 6.0)
        >>> found["speed_min"], round(found["speed_min_at"], 6)
        (0.0, 3.141593)
    """
    from gearlink.core.numerics.extremes import extremes_over

    wanted = [(curve, greatest) for curve in curves.values() for greatest in (True, False)]
    sides = [f"{name}_{side}" for name in curves for side in ("max", "min")]
    found: dict[str, float] = {}
    for side, extreme in zip(sides, extremes_over(wanted, start, end, joints=joints, samples=samples), strict=True):
        found |= {side: extreme.value, f"{side}_at": extreme.place}
    return found


class WithExtremes:
    """A design with such quantities: `extreme_names` lists them, `motion_extremes` has their values."""

    extreme_names: tuple[str, ...] = ()

    @property
    def motion_extremes(self) -> Mapping[str, Any]:
        """Values in mm, rad and s by their names."""
        raise NotImplementedError

    def raw(self, name: str) -> Any:
        """Extremes by their names, and the design's own quantities."""
        if name in self.extreme_names:
            return self.motion_extremes.get(name)
        return super().raw(name)  # type: ignore[misc]
