"""What a gear pair must satisfy to exist, and the messages where it does not."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.parts.gears.tooth.teeth import transverse

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair
    from gearlink.core.parts.gears.mesh.pitch_pair import PitchPair

_MOST_TEETH = 10_000
_LEAST_MODULE = 1e-100
"""Squares of lengths stay finite."""


def require_profile(pair: GearPair) -> None:
    """Refuse a module, teeth, angles or heights that no gear has.

    Raises
        NoSolution
    """
    if not 0.0 < pair.module < math.inf:
        raise NoSolution(f"module {pair.module:g} mm: it must be positive")
    if not _LEAST_MODULE <= pair.module <= 1.0 / _LEAST_MODULE:
        message = f"module {pair.module:g} mm cannot be computed with: it must lie between 1e-100 and 1e100 mm"
        raise NoSolution(message, key="module")
    _require_teeth(pair)
    if not 0.0 < pair.pressure_angle < math.pi / 2:
        degrees = math.degrees(pair.pressure_angle)
        raise NoSolution(f"pressure angle {degrees:g} deg: it must lie between 0 and 90 deg, usually 20 deg")
    if not 0.0 <= pair.helix_angle < math.pi / 2:
        raise NoSolution(
            f"helix angle {math.degrees(pair.helix_angle):g} deg", fix="give its magnitude, from 0 to below 90 deg"
        )
    if not (0.0 < pair.addendum < math.inf and 0.0 <= pair.clearance < math.inf):
        raise NoSolution(
            f"addendum {pair.addendum:g} and clearance {pair.clearance:g}: "
            "the addendum must be positive (usually 1), the clearance not negative (usually 0.25)"
        )


def _require_teeth(pair: GearPair) -> None:
    first, second = pair.teeth
    for z in pair.teeth:
        if isinstance(z, bool) or not isinstance(z, int) or z == 0:
            raise NoSolution(f"teeth {z!r}: a gear has a whole number of teeth, at least 1")
    if first < 0:
        raise NoSolution(f"teeth {first!r}: gear 1 is external", key="teeth[0]", fix="name the ring as gear 2")
    if second < 0 and -second <= first:
        raise NoSolution(
            f"a ring of {-second} teeth does not take a gear of {first}: it needs more teeth", key="teeth[1]"
        )
    own_ring = second < 0 and pair.given_shift != (0.0, 0.0)
    unusual = own_ring or pair.helix_angle != 0.0 or any(pair.tools)
    if unusual and min(first, abs(second)) < 3:
        place = 0 if first < 3 else 1
        raise NoSolution(f"a gear of {pair.teeth[place]} teeth: it needs at least 3", key=f"teeth[{place}]")


def least_distance(pair: PitchPair) -> float:
    """The minimum centre distance [mm]: |r_b1 + r_b2|."""
    return abs(pair.base_radius[0] + pair.base_radius[1])


def bound_of_shift_sum(pair: PitchPair) -> float:
    """The sum of shifts at which the pressure angle is 0 [module]: -(z_1 + z_2) inv(alpha_t)/(2 tan(alpha_n))."""
    f = pair.fn
    involute_t = f.involute(transverse(pair.pressure_angle, pair.helix_angle, f))
    return -(pair.teeth[0] + pair.teeth[1]) * involute_t / (2.0 * f.tan(pair.pressure_angle))


def require_distance(pair: GearPair, distance: float) -> None:
    """Refuse a centre distance below the sum of the base radii (their difference, with a ring).

    Raises
        NoSolution
    """
    least = least_distance(pair)
    if least <= distance < math.inf:
        return
    sum_of = "difference" if pair.internal else "sum"
    raise NoSolution(
        (
            f"centre distance {distance:.6g} mm does not suit gears of {pair.teeth[0]} and "
            f"{pair.teeth[1]} teeth of module {pair.module:g} mm: the minimum is the {sum_of} of the "
            f"base radii, {safely_above(least)} mm"
        ),
        fix="change it or the teeth",
    )


def require_shift(pair: GearPair) -> None:
    """Refuse a sum of shifts that leaves no pressure angle: inv(alpha_t) + 2 Sx tan(alpha_n)/Z < 0.

    Raises
        NoSolution
    """
    bound = bound_of_shift_sum(pair)
    total = pair.shift_sum
    if not pair.internal and not bound <= total < math.inf:
        raise NoSolution(
            (
                f"profile shifts with the sum {total:.6g} leave no pressure angle to {pair.teeth[0]} and "
                f"{pair.teeth[1]} teeth: the sum must be at least {safely_above(bound)}"
            ),
            fix="raise a shift or take more teeth",
        )
    if pair.internal and not -math.inf < total <= bound:
        raise NoSolution(
            (
                f"profile shifts with the sum {total:.6g} leave no pressure angle to {pair.teeth[0]} "
                f"teeth in a ring of {-pair.teeth[1]}: the sum must be at most {safely_below(bound)} "
                "(a positive shift thickens the teeth of a ring too)"
            ),
            fix="lower a shift",
        )


def no_involute_at_tip(pair: GearPair, gear: int) -> NoSolution:
    """What is wrong where a tip circle lies inside its base circle."""
    base, tip = abs(pair.base_radius[gear]), abs(pair.tip_radius[gear])
    missing = (base - tip) / pair.module
    if not pair.internal and pair.tip_radius[gear] - pair.tip_alteration[gear] * pair.module >= base:
        return _no_tip_left(pair, gear)
    if pair.teeth[gear] > 0:
        return NoSolution(
            (
                f"tip radius {tip:.6g} mm of gear {gear + 1} lies below its base radius {base:.6g} mm: no "
                "involute is left"
            ),
            fix=f"raise its profile shift or the addendum by at least {missing:.3g} modules",
        )
    teeth = least_ring(pair)
    fix = f"lower its profile shift or its addendum by at least {safely_above(missing, 3)} modules"
    return NoSolution(
        f"tip radius {tip:.6g} mm of the ring lies inside its base radius {base:.6g} mm, where there is no involute",
        key="teeth[1]",
        fix=fix if teeth is None else f"give it at least {teeth} teeth",
    )


def least_ring(pair: GearPair) -> int | None:
    """Teeth from which on the tips of a ring lie on its involutes, |z_2| (1 - cos(alpha_t)) >= 2 cos(beta) h_a2;
    None where they are too many to be made.
    """
    height = pair.addendum + pair.profile_shift[1] + pair.tip_alteration[1]
    lost = math.sin(pair.transverse_pressure_angle / 2.0) ** 2 / math.cos(pair.helix_angle)
    return math.ceil(height / lost) if height <= _MOST_TEETH * lost else None


def _no_tip_left(pair: GearPair, gear: int) -> NoSolution:
    """What is wrong where the centre distance takes so much from the tips that none is left outside the base circle."""
    first, second = pair.teeth
    distance = pair.center_distance
    fitting = pair.module * distance / pair.reference_center_distance
    return NoSolution(
        (
            f"no tip is left to gear {gear + 1}: at the centre distance {distance:.6g} mm gears of "
            f"{first} and {second} teeth of module {pair.module:g} mm take profile shifts with the "
            f"sum {pair.shift_sum:.3g}, and their tips are shortened by "
            f"{-pair.tip_alteration[gear]:.3g} modules"
        ),
        fix=(
            f"bring the distance near to {pair.reference_center_distance:.6g} mm, or take a module "
            f"near {fitting:.3g} mm or more teeth"
        ),
    )
