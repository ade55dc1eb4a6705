"""A motion law: its rise and derivatives, its peaks, where it jumps."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.roots import roots_on

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gearlink.core.parts.cams.shaped import Shaping

    X = TypeVar("X", float, NDArray[np.float64])
else:
    X = TypeVar("X")

# Callers divide an angle by a phase length; the quotient may pass the end by a few ulp, never by more.
_REACH = 1e-12


@dataclass(frozen=True, slots=True)
class Law:
    """A motion law over x in [0, 1], normalised to rise 1 (rest-to-rest) or to end velocity 1 (rest-to-speed).

    Attributes
        name : str - as the design file writes it
        kind : 'rest-to-rest', 'rest-to-speed', or 'given-ends' where it begins or ends otherwise
        derivatives : (x, low, high) -> derivatives low to high, without a check of the range
        kappa : float - s(1): 1 for rest-to-rest, the share of (end speed) x (time) for rest-to-speed
        peak_velocity, peak_acceleration, peak_power : float - largest v, |a| and v a (Cv, Ca, Cm)
        interior_jerk : float - largest |j| beside the jumps of the acceleration
        peak_jerk : float - the same (Cj), or inf where the acceleration jumps inside or at an end
        end_jumps : bool - the acceleration is not zero at an end, so the law must not join a dwell
        joints : floats in (0, 1) - where the acceleration or a derivative of it may jump
        shaping : Shaping or None - how a law that numbers shape came to be
    """

    name: str
    kind: Literal["rest-to-rest", "rest-to-speed", "given-ends"]
    derivatives: Callable[[Any, int, int], tuple[Any, ...]]
    kappa: float
    peak_velocity: float
    peak_acceleration: float
    interior_jerk: float
    peak_jerk: float
    peak_power: float
    end_jumps: bool = False
    joints: tuple[float, ...] = ()
    shaping: Shaping | None = None

    def evaluate(self, x: X, order: int = 3) -> tuple[X, ...]:
        """Rise and its derivatives with respect to x.

        Parameters
            x : float or float64 array - in [0, 1]
            order : int - 0 to 3, the number of derivatives wanted; the rest is not computed
        Returns
            s[, v[, a[, j]]] : floats or arrays like x
        Raises
            NoSolution - x outside [0, 1] by more than 1e-12, or not a number
        Notes
            Errors stay within 8 ulp of the peak; near x = 0 the rise keeps its relative accuracy, and
            s(1 - x) = 1 - s(x) holds exactly for a rest-to-rest law. At a jump inside the first half the value
            is the one on the right, its mirror image in the second.
        Example
            >>> from gearlink.core.parts.cams.laws import law
            >>> law("polynomial-345").evaluate(0.5, 2)
            (0.5, 1.875, 0.0)
        """
        inside: Any = float(x) if isinstance(x, int | float) else x
        single = isinstance(inside, float)
        if single or inside.size:
            low, high = (inside, inside) if single else (float(inside.min()), float(inside.max()))
            if not (low >= -_REACH and high <= 1.0 + _REACH):
                message = f"motion law {self.name}: x from {low:.4g} to {high:.4g} is outside 0 to 1"
                raise NoSolution(message, fix="reduce it to the phase")
        return self.derivatives(inside, 0, order)


def peak_power(derivatives: Callable[[Any, int, int], tuple[Any, ...]], steps: int = 32) -> float:
    """Largest |v a| of a law, sought between so many places."""

    def power(u: float) -> float:
        v, a = derivatives(u, 1, 2)
        return float(v * a)

    def slope(u: float) -> float:
        v, a, j = derivatives(u, 1, 3)
        return float(a * a + v * j)

    return largest(power, slope, steps)


def largest(f: Callable[[float], float], slope: Callable[[float], float], steps: int = 32) -> float:
    """Largest |f| on [0, 1]: the ends and the roots of the slope, sought between so many places."""
    places = [i / steps for i in range(steps + 1)]
    return max(abs(f(u)) for u in (0.0, 1.0, *roots_on(slope, places)))
