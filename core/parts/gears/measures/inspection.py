"""What a gear is measured by: span, balls and pins, chords."""

from __future__ import annotations

import math
from bisect import bisect_left
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.involute import inverse_involute, involute

PREFERRED_PINS = (
    0.5, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5, 3.75, 4.0, 4.25, 4.5, 5.0, 5.25, 5.5, 6.0,
    6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 10.5, 11.0, 12.0, 14.0, 15.0, 16.0, 18.0, 20.0, 22.0, 25.0, 28.0, 30.0, 35.0, 40.0,
    45.0, 50.0,
)  # fmt: skip
"""Diameters of measuring balls and pins that can be bought [mm]."""


@dataclass(frozen=True, kw_only=True)
class Ball:
    """A ball (or pin) in a tooth space.

    inv(alpha_K) = D/(z m cos(alpha_n)) - eta + inv(alpha_t),  eta = (pi/2 - 2 x tan(alpha_n))/z

    Parameters
        gear : int - 0 or 1
        diameter : float [mm] - D
        shift : float or None [module] - generating profile shift; None: the nominal one
    Returns
        Properties: lengths in mm, radii of a ring negative.
    Raises
        NoSolution - where the ball falls through the space
    Notes
        Exact for balls in helical gears, since the offset of an involute helicoid is an involute helicoid; compared
        with a sphere that touches the flanks in space: 2e-41 at forty digits.
    Example
        >>> pair = GearPair(module=2.0, teeth=(25, 40), helix_angle=math.radians(20.0), given_shift=(0.0, 0.0))
        >>> ball = Ball(pair=pair, gear=0, diameter=3.5)
        >>> round(ball.over_balls, 4), round(ball.over_pins or 0.0, 4)
        (58.0771, 58.185)

    Source
        DIN 21773; own derivation
    """

    pair: GearPair
    gear: int
    diameter: float
    shift: float | None = None

    @cached_property
    def pressure_angle(self) -> float:
        """alpha_K [rad], on the circle of the ball's centre."""
        pair, z = self.pair, self.pair.teeth[self.gear]
        x = pair.profile_shift[self.gear] if self.shift is None else self.shift
        half_space = (math.pi / 2.0 - 2.0 * x * math.tan(pair.pressure_angle)) / z
        gained = self.diameter / (z * pair.module * math.cos(pair.pressure_angle)) - half_space
        return inverse_involute(gained + involute(pair.transverse_pressure_angle))

    @property
    def center_radius(self) -> float:
        """r_K = r_b/cos(alpha_K)."""
        return self.pair.base_radius[self.gear] / math.cos(self.pressure_angle)

    @cached_property
    def contact_radius(self) -> float:
        """r_M, on which the ball touches: tan(alpha_M) = tan(alpha_K) - D cos(beta_b)/(2 r_b)."""
        base = self.pair.base_radius[self.gear]
        return math.copysign(math.hypot(base, base * self.roll), base)

    @cached_property
    def roll(self) -> float:
        """tan(alpha_M); negative where the ball would touch inside the base circle."""
        lost = self.diameter * math.cos(self.pair.base_helix_angle) / (2.0 * self.pair.base_radius[self.gear])
        return math.tan(self.pressure_angle) - lost

    @property
    def over_balls(self) -> float:
        """M over two balls, of a ring between them; with an odd number of teeth they stand half a pitch off."""
        z = abs(self.pair.teeth[self.gear])
        share = math.cos(math.pi / (2.0 * z)) if z % 2 else 1.0
        return 2.0 * abs(self.center_radius) * share + self.pair.signs[self.gear] * self.diameter

    @property
    def over_pins(self) -> float | None:
        """M over two pins; those in a helical gear settle opposite each other, a helical ring takes none."""
        if self.pair.helix_angle == 0.0:
            return self.over_balls
        if self.pair.teeth[self.gear] < 0:
            return None
        return 2.0 * self.center_radius + self.diameter


def preferred_pin(pair: GearPair, gear: int) -> float | None:
    """The preferred pin that touches nearest to the circle r + x m; None where none stays in the space.

    Example
        >>> preferred_pin(GearPair(module=2.0, teeth=(25, 40), given_shift=(0.0, 0.0)), 0)
        3.5
    """
    wanted = pair.reference_radius[gear] + pair.module * pair.profile_shift[gear]

    def contact(diameter: float) -> float:
        """Signed radius of the contact, which rises with the diameter; beyond all where the ball falls through."""
        ball = Ball(pair=pair, gear=gear, diameter=diameter)
        try:
            return ball.contact_radius if ball.roll >= 0.0 else -ball.contact_radius
        except NoSolution:
            return -math.inf if pair.teeth[gear] > 0 else math.inf

    place = bisect_left(PREFERRED_PINS, wanted, key=contact)
    near = PREFERRED_PINS[max(place - 1, 0) : place + 1]
    found = [(abs(abs(radius) - abs(wanted)), pin) for pin in near if math.isfinite(radius := contact(pin))]
    return min(found)[1] if found else None


def chord(pair: GearPair, gear: int) -> tuple[float, float]:
    """Chordal thickness on the reference circle and its height below the tip [mm].

    s_c = d_n sin(s_n/d_n),  h_c = r_a - r + d_n/2 (1 - cos(s_n/d_n)),  d_n = d/cos^2(beta)

    Notes
        Exact for spur gears; for helical ones within 1.7e-5 of the minimum distance of both flank helices.
    Example
        >>> gear = GearPair(module=10.0, teeth=(12, 40), given_shift=(0.3, 0.0), tip="none")
        >>> [round(each, 4) for each in chord(gear, 0)]
        [17.8256, 13.6657]

    Source
        DIN 21773
    """
    virtual = 2.0 * pair.reference_radius[gear] / math.cos(pair.helix_angle) ** 2
    half = pair.tooth_thickness[gear] / virtual
    height = pair.tip_radius[gear] - pair.reference_radius[gear]
    return virtual * math.sin(half), height + virtual * math.sin(half / 2.0) ** 2
