"""Teeth of one involute gear, and the functions of their formulas: undercut, pressure angle, span, rim of a ring."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.elementary import Elementary, One, Two
from gearlink.core.parts.gears.tooth.involute import involute, involute_rise, rise_of_involute


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class GearFunctions(Elementary):
    """Functions of numbers, or of arrays element by element; involutes as in `core.parts.gears.tooth.involute`."""

    involute: One = involute
    involute_rise: Two = involute_rise
    rise_of_involute: Two = rise_of_involute


SCALARS = GearFunctions()


RIM_MODULES = 2.0
"""A ring's rim lies so many modules outside its root circle, where the file names none."""
_LEAST_SPANNED = 2


def transverse(pressure_angle: float, helix_angle: float, f: GearFunctions = SCALARS) -> float:
    """Pressure angle in the transverse section [rad]; to the bit the normal one where there is no helix."""
    turned = f.atan(f.tan(pressure_angle) / f.cos(helix_angle))
    return f.where(helix_angle == 0.0, pressure_angle, turned)


def rim_radius(root_radius: float, module: float, given: float | None = None) -> float:
    """Outer radius of a ring gear [mm]: given, or 2 modules outside its root circle.

    Parameters
        root_radius : float [mm] - of either sign
        module : float [mm]
        given : float or None [mm]
    Example
        >>> rim_radius(-64.5, 2.0), rim_radius(-64.5, 2.0, 80.0)
        (68.5, 80.0)
    """
    return abs(root_radius) + RIM_MODULES * module if given is None else given


def pressure_angle_rise(radius: float, increase: float, pressure_angle: float, *, what: str = "radius") -> float:
    """Rise of an involute's pressure angle from one radius to another.

    cos(alpha + rise) = r cos(alpha)/(r + increase)

    Parameters
        radius : float [mm] - first radius r > 0; a centre distance obeys the same equation
        increase : float [mm] - second radius less the first, either sign
        pressure_angle : float [rad] - alpha at the first radius, 0 < alpha < pi/2
        what : str - word for the radius in the message of NoSolution
    Returns
        rise : float [rad] - of the sign of the increase, exactly 0 at 0
    Raises
        NoSolution - when the second radius lies below the base radius r cos(alpha)
    Notes
        With R = r + increase, u = sqrt(R^2 - r_b^2), v = r sin(alpha), no difference of arc cosines is taken:
        sin(rise) = cos(alpha) (R^2 - r^2)/(R (u + v)), cos(rise) = (r cos^2(alpha) + u sin(alpha))/R.
        Full relative precision; near the base circle the condition number tan(alpha)/tan(alpha + rise) of
        u is the problem's own.
    Example
        >>> round(math.degrees(pressure_angle_rise(288.0, 2.2912330746487, math.radians(20.0))), 10)
        1.2076131545
    """
    if not above_base(radius, increase, pressure_angle) >= 0.0:
        base = radius * math.cos(pressure_angle)
        raise NoSolution(
            f"{what}: {unlike(radius + increase, base)} mm (limit >= {unlike(base, radius + increase)} mm, the base "
            "radius: no involute below)"
        )
    return rise_between(radius, increase, pressure_angle)


def above_base(radius: float, increase: float, pressure_angle: float, f: GearFunctions = SCALARS) -> float:
    """How far a second radius lies above the base radius [mm]: r + increase - r cos(alpha)."""
    return increase + 2.0 * radius * f.sin(pressure_angle / 2.0) ** 2


def rise_between(radius: float, increase: float, pressure_angle: float, f: GearFunctions = SCALARS) -> float:
    """The formula of `pressure_angle_rise` [rad], for radii at or above the base radius; arrays are NaN below it."""
    base, above = radius * f.cos(pressure_angle), above_base(radius, increase, pressure_angle, f)
    u = f.sqrt(above * (above + 2.0 * base))
    v = radius * f.sin(pressure_angle)
    sine = f.cos(pressure_angle) * increase * (2.0 * radius + increase) / (u + v)
    return f.atan2(sine, base * f.cos(pressure_angle) + u * f.sin(pressure_angle))


def span_measurement(
    module: float,
    teeth: int,
    shift: float,
    pressure_angle: float,
    span_teeth: int,
    helix_angle: float = 0.0,
    f: GearFunctions = SCALARS,
) -> float:
    """Distance of two parallel planes that touch opposite flanks over a number of teeth (base tangent length).

    W_k = m cos(alpha_n) (pi (k - 1/2) + z inv(alpha_t)) + 2 x m sin(alpha_n)

    Parameters
        module : float [mm] - normal module m
        teeth : int - number of teeth z
        shift : float [module] - profile shift x
        pressure_angle : float [rad] - alpha_n
        span_teeth : int - teeth between the planes, k >= 1
        helix_angle : float [rad] - beta
        f : GearFunctions - functions of numbers or of arrays
    Returns
        W_k : float [mm] - for no backlash
    Notes
        Of a ring with straight teeth: over k spaces, that of an external gear with |z| teeth and -x.
    Example
        >>> round(span_measurement(2.0, 40, 0.0, math.radians(20.0), 5), 4)
        27.6896
        >>> round(span_measurement(2.0, 25, 0.0, math.radians(20.0), 3, math.radians(20.0)), 4)
        15.5967

    Source
        own derivation: k - 1 base pitches and the tooth thickness on the base circle
    """
    arc = math.pi * (span_teeth - 0.5) + teeth * f.involute(transverse(pressure_angle, helix_angle, f))
    return module * (f.cos(pressure_angle) * arc + 2.0 * shift * f.sin(pressure_angle))


def span_contact_radius(
    base_radius: float, span: float, base_helix_angle: float = 0.0, f: GearFunctions = SCALARS
) -> float:
    """Radius on which the planes of a span measurement touch the flanks.

    R = sqrt(r_b^2 + (W_k cos(beta_b)/2)^2)

    Example
        >>> span_contact_radius(3.0, 8.0)
        5.0
    """
    return f.hypot(base_radius, span * f.cos(base_helix_angle) / 2.0)


def span_rivals(
    teeth: int, shift: float, pressure_angle: float, helix_angle: float = 0.0, f: GearFunctions = SCALARS
) -> tuple[tuple[int, float], tuple[int, float]]:
    """The two numbers of teeth whose span measurement may touch the flanks nearest to the circle r + x m.

    R_k = sqrt(r_b^2 + (W_k cos(beta_b)/2)^2), |R_k - (r + x m)| minimum

    Parameters
        teeth : int - number of teeth z
        shift : float [module] - profile shift x
        pressure_angle, helix_angle : float [rad] - alpha_n, beta
    Returns
        (k, distance), (k + 1, distance) - 2 <= k <= z; how far the contact lies from that circle [module]
    Notes
        Over one tooth there is nothing to measure: the planes would meet its flanks at the root alone.
        R_k grows with k, so that only the two whole numbers beside the exact solution compete.
    Example
        >>> [k for k, _ in span_rivals(40, 0.0, math.radians(20.0))]
        [4, 5]
    """
    base_helix = f.asin(f.sin(helix_angle) * f.cos(pressure_angle))
    radius = teeth / 2.0 / f.cos(helix_angle)
    base = radius * f.cos(transverse(pressure_angle, helix_angle, f))
    wanted = radius + shift
    reach = f.sqrt(f.greatest(wanted - base, 0.0) * (wanted + base))
    pitch = math.pi * f.cos(pressure_angle)
    first = span_measurement(1.0, teeth, shift, pressure_angle, 1, helix_angle, f)
    exact = 1.0 + (2.0 * reach / f.cos(base_helix) - first) / pitch

    def rival(k: int) -> tuple[int, float]:
        span = span_measurement(1.0, teeth, shift, pressure_angle, k, helix_angle, f)
        return k, abs(span_contact_radius(base, span, base_helix, f) - wanted)

    low: Any = f.greatest(_LEAST_SPANNED, f.least(teeth, f.floor(exact)))
    high: Any = f.least(teeth, low + 1)
    return rival(low), rival(high)
