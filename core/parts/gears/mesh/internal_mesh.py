"""An internal mesh without profile shift: pinion in a ring gear, at the reference centre distance or near it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.tooth.involute import involute
from gearlink.core.parts.gears.tooth.teeth import rim_radius

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair

Pair = tuple[float, float]
_MOST_TEETH = 10_000


@dataclass(frozen=True)
class InternalMesh:
    """Pinion and ring gear; a pair is (pinion, ring).

    a = m (z_2 - z_1)/2

    Parameters
        module : float [mm]
        teeth : (int, int) - pinion z_1, ring z_2 > z_1
        pressure_angle : float [rad] - alpha
        addendum, clearance : float [module] - h_a*, c*
        rim : float [mm] - outer radius of the ring gear; None: 2 modules outside its root circle
        distance : float [mm] - of the axes as made; None: a
    Raises
        NoSolution - for a module that is not positive, a ring that is not larger than the pinion, or axes that stand
            nearer than the base circles let them
    Example
        >>> mesh = InternalMesh(2.0, (48, 62))
        >>> mesh.center_distance, round(mesh.contact_ratio, 6)
        (14.0, 2.036356)

    Source
        ISO 21771
    """

    module: float
    teeth: tuple[int, int]
    pressure_angle: float = math.radians(20.0)
    addendum: float = 1.0
    clearance: float = 0.25
    rim: float | None = None
    distance: float | None = None

    def __post_init__(self) -> None:
        pinion, ring = self.teeth
        if not 0.0 < self.module < math.inf:
            raise NoSolution(f"module {self.module:g} mm: it must be positive")
        if not 1 <= pinion < ring:
            raise NoSolution(f"a ring gear of {ring} teeth does not take a gear of {pinion}: it needs more teeth")
        least = self.base_radius[1] - self.base_radius[0]
        if self.distance is not None and not self.distance >= least:
            raise NoSolution(
                f"axes {self.distance:.6g} mm apart have no line of action: at least {least:.6g} mm are needed"
            )

    internal: ClassVar[bool] = True
    """As of a GearPair with a ring."""

    @cached_property
    def signed(self) -> GearPair:
        """The mesh as a gear pair whose ring has negative teeth.

        Example
            >>> InternalMesh(2.0, (48, 62)).signed.center_distance
            -14.0

        Source
            ISO 21771, whose signs of a ring are those of `GearPair`
        """
        from gearlink.core.parts.gears.mesh.pair import GearPair

        return GearPair(
            module=self.module,
            teeth=(self.teeth[0], -self.teeth[1]),
            pressure_angle=self.pressure_angle,
            given_shift=(0.0, 0.0),
            addendum=self.addendum,
            clearance=self.clearance,
            given_distance=self.distance,
            tip=(0.0, 0.0),
        )

    @property
    def center_distance(self) -> float:
        """Centre distance, as made or m (z_2 - z_1)/2 [mm]."""
        return self._reference_distance if self.distance is None else self.distance

    @property
    def _reference_distance(self) -> float:
        return self.module * (self.teeth[1] - self.teeth[0]) / 2.0

    @property
    def working_pressure_angle(self) -> float:
        """alpha_w [rad]: cos(alpha_w) = a cos(alpha)/a_w."""
        if self.distance is None:
            return self.pressure_angle
        return math.acos(self._reference_distance * math.cos(self.pressure_angle) / self.distance)

    @property
    def reference_radius(self) -> Pair:
        """Reference radii [mm]."""
        return self.module * self.teeth[0] / 2.0, self.module * self.teeth[1] / 2.0

    @property
    def base_radius(self) -> Pair:
        """Base radii, r cos(alpha) [mm]."""
        r_1, r_2 = self.reference_radius
        return r_1 * math.cos(self.pressure_angle), r_2 * math.cos(self.pressure_angle)

    @property
    def tip_radius(self) -> Pair:
        """Tip radii [mm]; the ring's tips point inward."""
        r_1, r_2 = self.reference_radius
        return r_1 + self.addendum * self.module, r_2 - self.addendum * self.module

    @property
    def root_radius(self) -> Pair:
        """Root radii [mm]."""
        depth = (self.addendum + self.clearance) * self.module
        r_1, r_2 = self.reference_radius
        return r_1 - depth, r_2 + depth

    @property
    def rim_radius(self) -> float:
        """Outer radius of the ring gear [mm]."""
        return rim_radius(self.root_radius[1], self.module, self.rim)

    @cached_property
    def tip_pressure_angle(self) -> Pair:
        """Pressure angles at the tips [rad].

        Raises
            NoSolution - where the ring's tips lie inside its base circle
        """
        (a_1, a_2), (b_1, b_2) = self.tip_radius, self.base_radius
        if a_2 < b_2:
            raise NoSolution(
                f"the tips of the ring gear ({a_2:.6g} mm) lie inside its base circle ({b_2:.6g} mm), where there is "
                f"no involute: {self.least_ring}"
            )
        return math.acos(b_1 / a_1), math.acos(b_2 / a_2)

    @property
    def least_ring(self) -> str:
        """In words, what gives the ring's tips an involute: z_2 (1 - cos alpha) >= 2 h_a*."""
        lost = 2.0 * math.sin(0.5 * self.pressure_angle) ** 2
        needed = 2.0 * self.addendum
        if needed > _MOST_TEETH * lost:
            return "take a larger pressure angle"
        return f"it needs at least {math.ceil(needed / lost)} teeth"

    @property
    def ring_tip_margin(self) -> float:
        """How far the ring's tips stay outside its base circle [mm]; negative where they have no involute."""
        return self.tip_radius[1] - self.base_radius[1]

    @property
    def tip_circle_margin(self) -> float:
        """a - (r_a1 - r_a2) [mm]; negative where the pinion's tip circle encloses the ring's, whose teeth then
        overlap all round (with full teeth: less than two teeth of difference).
        """
        return self.center_distance - (self.tip_radius[0] - self.tip_radius[1])

    @cached_property
    def contact_ratio(self) -> float:
        """Transverse contact ratio.

        eps = (z_1 (tan alpha_a1 - tan alpha_w) - z_2 (tan alpha_a2 - tan alpha_w))/(2 pi)

        Raises
            NoSolution - as `tip_pressure_angle`
        """
        tip_1, tip_2 = (math.tan(angle) for angle in self.tip_pressure_angle)
        working = math.tan(self.working_pressure_angle)
        return (self.teeth[0] * (tip_1 - working) - self.teeth[1] * (tip_2 - working)) / (2.0 * math.pi)

    @cached_property
    def interference_margin(self) -> float:
        """How far the contact at the ring's tips stays from the pinion's base circle on the line of action [mm].

        sqrt(r_a2^2 - r_b2^2) - a sin(alpha_w) >= 0

        Raises
            NoSolution - as `tip_pressure_angle`
        """
        reach = self.base_radius[1] * math.tan(self.tip_pressure_angle[1])
        return reach - self.center_distance * math.sin(self.working_pressure_angle)

    @cached_property
    def tip_fouling_margin(self) -> float:
        """Room between the tips where they leave each other, as an arc on the ring's tip circle [mm].

        z_1 (inv alpha_a1 + delta_1) - z_2 (inv alpha_a2 + delta_2) + (z_2 - z_1) inv alpha_w >= 0,
        delta_1, delta_2 the angles at the two axes from the line of centres to where the tip circles cross

        Raises
            NoSolution - as `tip_pressure_angle`, and where the tip circles do not cross
        Notes
            At 20 deg and full teeth the tips of rings with about 8 teeth more than the pinion come free.
        Source
            own derivation: a tip corner of the pinion against the ring's flank where the tip circles cross
        """
        (a_1, a_2), distance = self.tip_radius, self.center_distance
        margin = self.tip_circle_margin
        if margin < 0.0:
            raise NoSolution(
                f"the tip circle of the pinion encloses that of the ring gear by {-margin:.6g} mm: "
                "give the ring gear more teeth, or the pinion fewer"
            )
        squares = (a_2 - a_1) * (a_2 + a_1)
        # Four areas of the triangle of both axes and the crossing (Heron): an arctangent stands a touch of the circles.
        area = math.sqrt((a_1 + a_2 + distance) * (a_1 + a_2 - distance) * (distance + a_1 - a_2) * margin)
        delta_1 = math.atan2(area, squares - distance**2)
        delta_2 = math.atan2(area, squares + distance**2)
        inv_1, inv_2 = (involute(angle) for angle in self.tip_pressure_angle)
        z_1, z_2 = self.teeth
        room = z_1 * (inv_1 + delta_1) - z_2 * (inv_2 + delta_2) + (z_2 - z_1) * involute(self.working_pressure_angle)
        return room / z_2 * a_2
