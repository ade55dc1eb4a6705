"""The dissertation's own synthesis of the law of motion: trapezoid march and rescaling of the energy parameter.

Kept as the legacy method to compare with; `core.machines.wide_swing.law.elastic_law` gives the law to rounding without
iterating.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.law.device import Device, DeviceGeometry, Gravity, Spring, require_swing

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
        swing : float [rad] - gamma, 0 to 340 deg
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


@dataclass(frozen=True, slots=True)
class MarchedLaw:
    """Result of the iteration over the whole stroke of a law without symmetry.

    Fields
        energy_parameter : float - N
        passes : int - marches until N settled
        rows : list of (pass, N, mu, displacement from the start, displacement from the end)
    """

    energy_parameter: float
    passes: int
    rows: list[tuple[int, float, float, float, float]]


def slider_law(device: Device, swing: float, inertia: Callable[[float], float], *, steps: int = 20) -> MarchedLaw:
    """Law of motion with a slider by the dissertation's iteration, marched from both ends to k = 1/2.

    b = sqrt(N E(a)/j(a));  mu = 1/(a_forward(1/2) + a_backward(1/2));  N <- mu N, from N = 4 j(1/2)/E(1/2)

    Parameters
        device : Pneumatic, Spring or Gravity
        swing : float [rad] - gamma, 0 to 340 deg
        inertia : function of the share of the swing - j = j0 + (1 - j0) b_kp^2
        steps : int - steps in half the stroke
    Returns
        law : MarchedLaw
    Raises
        NoSolution - when |mu - 1| has not fallen to 1e-12 in 100 passes, or a march leaves the swing
    Notes
        A pass shrinks the error by |1 - b(1/2)/2|. With j = 1 it is `legacy_law`.
    Example
        >>> from gearlink.core.machines.wide_swing.law.device import Pneumatic
        >>> alike = slider_law(Pneumatic(2.5), math.radians(120), lambda a: 1.0)
        >>> round(alike.energy_parameter / legacy_law(Pneumatic(2.5), math.radians(120)).energy_parameter, 12)
        1.0

    Source
        wide-swing dissertation (16), (17) and figure 4; the two marches: own derivation
    """
    require_swing(swing)
    if steps < 1:
        raise NoSolution(f"{steps} steps: the march needs at least 1", key="iteration_steps")
    ways = _HalfSwing(device, swing, inertia), _HalfSwing(device, swing, lambda a: inertia(1.0 - a))
    parameter, rows = (2.0 / ways[0].velocity(0.5, 1.0)) ** 2, []
    for passes in range(1, _MOST_PASSES + 1):
        ends = [_march(way, parameter, steps) for way in ways]
        scale = 1.0 / math.fsum(ends)
        rows.append((passes, parameter, scale, ends[0], ends[1]))
        if abs(scale - 1.0) <= _SETTLED:
            return MarchedLaw(parameter, passes, rows)
        parameter *= scale
    speed = ways[0].velocity(ends[0], parameter)
    raise NoSolution(
        f"the source's iteration does not converge here: velocity invariant {speed:.4g} at half the time, it must be "
        "below 4; omit method",
        key="method",
    )


def _otherwise(exponent: int) -> str:
    return "take exponent 1" if exponent != 1 else "omit method, which gives the law by its integral"


@dataclass(frozen=True, slots=True)
class _HalfSwing:
    """b(a) of (6), (11), (16), (17) in plain scalars; `inertia`: j(a), none: 1."""

    device: Device
    swing: float
    inertia: Callable[[float], float] | None = None

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
        energy = x
        if isinstance(self.device, Spring):
            energy *= (1.0 + self.device.stretch_ratio) * stroke - 0.5 * x
        elif isinstance(self.device, Gravity):
            energy = 2.0 * product
        return math.sqrt(parameter * energy if self.inertia is None else parameter * energy / self.inertia(a))


def _require_rest(guess: float, following: float, start: float) -> None:
    """Refuse a step that does not settle; one that swings between its last bits has."""
    if not abs(following - guess) <= 1e-13 * abs(following):
        raise NoSolution(
            f"a step of the source's iteration does not settle, at {start:.4g} of the swing: give more iteration_steps",
            key="iteration_steps",
        )


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
        else:
            _require_rest(guess, following, a)
        a = guess
        b = half.velocity(guess, parameter)
    return a
