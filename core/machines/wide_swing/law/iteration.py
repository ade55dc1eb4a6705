"""The dissertation's own synthesis of the law of motion: trapezoid march and rescaling of the energy parameter.

Kept as the legacy method to compare with; `core.machines.wide_swing.law.elastic_law` gives the law to rounding without
iterating.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.law.device import Device, DeviceGeometry, Spring, require_swing

_FIXED_POINT_LIMIT = 400
_SETTLED, _MOST_PASSES = 1e-12, 100


@dataclass(frozen=True, slots=True)
class LegacyLaw:
    """Result of the iteration over the first half of the stroke.

    Fields
        energy_parameter : float - N
        passes : int - marches until N settled
    """

    energy_parameter: float
    passes: int


def legacy_law(device: Device, swing: float, *, steps: int = 20, exponent: int = 1) -> LegacyLaw:
    """Law of motion by the dissertation's iteration.

    a_{i+1} = a_i + (b_i + b_{i+1}) dk/2 from k = 0 to 1/2 with b = sqrt(N E(a)); mu = 0.5/a(1/2); N <- mu^e N

    Parameters
        device : Pneumatic or Spring
        swing : float [rad] - gamma, 0 to 300 deg
        steps : int - steps in half the stroke, dk = 0.5/steps
        exponent : int - e; 1 converges for every device tried, 2 is slow and fails where B exceeds 2
    Returns
        law : LegacyLaw
    Raises
        NoSolution - when |mu - 1| has not fallen to 1e-12 in 100 passes, or the rocker leaves its swing during a march
    Notes
        Starts from B = 2. The trapezoid leaves an error O(dk^2): with the device of the example N is 6.62e-4
        too large with 20 steps, 2.65e-5 with 100.
        The error shrinks by |1 - B/2| a pass (e = 1) or |1 - B| (e = 2).
    Example
        >>> from gearlink.core.machines.wide_swing.law.device import Pneumatic
        >>> law = legacy_law(Pneumatic(2.5), math.radians(120), steps=20)
        >>> round(law.energy_parameter, 3), law.passes < 20
        (4.194, True)

    Source
        wide-swing dissertation (5) to (9), (11) to (14) and figure 4; the exponent is illegible there
    """
    require_swing(swing)
    if steps < 1:
        raise NoSolution(f"{steps} steps: the march needs at least 1", key="iteration_steps")
    half = _HalfSwing(device, swing)
    parameter = (2.0 / half.velocity(0.5, 1.0)) ** 2
    for passes in range(1, _MOST_PASSES + 1):
        scale = 0.5 / _march(half, parameter, steps)
        if abs(scale - 1.0) <= _SETTLED:
            return LegacyLaw(parameter, passes)
        parameter *= scale**exponent
    raise NoSolution(
        f"the source's iteration comes to no end in {_MOST_PASSES} passes with this device and swing: "
        f"{_otherwise(exponent)}",
        key="method",
    )


def _otherwise(exponent: int) -> str:
    return "take exponent 1" if exponent != 1 else "leave method out, which gives the law by its integral"


@dataclass(frozen=True, slots=True)
class _HalfSwing:
    """b(a) of (6), (11) in plain scalars."""

    device: Device
    swing: float

    def velocity(self, a: float, parameter: float) -> float:
        geometry = DeviceGeometry(self.device, self.swing)
        longest, stroke = geometry.longest, geometry.stroke
        angle = (0.5 - a) * self.swing
        length = math.hypot(geometry.shortest, geometry.reach * math.sin(0.5 * angle))
        product = math.sin(0.25 * self.swing - 0.5 * angle) * math.sin(0.25 * self.swing + 0.5 * angle)
        x = 4.0 * self.device.pivot_ratio * product / (longest + length)
        if x < 0.0:
            raise NoSolution(
                f"the source's iteration leaves the swing, at {a:.6g} of it",
                key="method",
                fix=f"give more iteration_steps, or {_otherwise(1)}",
            )
        energy = x * ((1.0 + self.device.stretch_ratio) * stroke - 0.5 * x) if isinstance(self.device, Spring) else x
        return math.sqrt(parameter * energy)


def _march(half: _HalfSwing, parameter: float, steps: int) -> float:
    """Displacement at k = 1/2 by the implicit trapezoid, each step a fixed point."""
    dk = 0.5 / steps
    a = b = 0.0
    for _ in range(steps):
        # a = 0 solves the first step too; any a > 0 leads away from it
        guess = a + (b * dk if b > 0.0 else 0.25 * dk)
        for _ in range(_FIXED_POINT_LIMIT):
            b_next = half.velocity(guess, parameter)
            following = a + 0.5 * (b + b_next) * dk
            settled = abs(following - guess) <= 4e-16 * following
            guess = following
            if settled:
                break
        a = guess
        b = half.velocity(guess, parameter)
    return a
