"""What holds the driven gear of a mutilated wheel in its dwell: a disc next to the wheel, a plate next to the gear.

Both lie in a plane of their own next to the teeth. In the dwell an arc of the disc about the wheel's axis lies in a
concave arc of the plate; while a group of teeth passes, a cut-out of the disc lets the plate turn.
"""

from __future__ import annotations

import cmath
import math
from copy import copy
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short
from gearlink.core.numerics.elementary import triangle_angle
from gearlink.core.numerics.roots import bracketed_root

_TURN = 2.0 * math.pi


@dataclass(frozen=True)
class Lock:
    """Locking disc and plate of a mutilated wheel and its driven gear.

    Parameters
        distance : float [mm] - a, of the axes
        ratio : float - rho, turns of the driven gear per turn of the wheel in a motion
        gap : float [rad] - angle of the wheel in a dwell
        radius, plate : float [mm] - R of the disc's arcs, and p, the outer radius of the plate
        clearance : float [mm] - c: the arcs of the plate have the radius R + c
        stops : int - s, arcs of the plate
    Raises
        NoSolution - where the disc does not reach the plate, the arcs reach the axis or each other, the plate reaches
            the wheel's axis, or the dwell is too short for both tips of an arc
    Example
        >>> lock = Lock(150.0, 4.0, math.radians(270.0), 120.0, 45.0, 0.1)
        >>> round(math.degrees(lock.play), 4), round(lock.arm, 3)
        (0.3077, 37.206)

    Source
        thesis 2.2.2 (figure 2-6) names no lock; own derivation
    """

    distance: float
    ratio: float
    gap: float
    radius: float
    plate: float
    clearance: float = 0.0
    stops: int = 1

    def __post_init__(self) -> None:
        a, most = self.distance, self.distance - self.clearance
        self._require_below("plate_radius", self.plate, most, "reaches the axis of the wheel")
        self._require_below("radius", self.radius, most, "reaches the axis of the driven gear")
        if self.radius <= a - self.plate:
            raise NoSolution(
                f"a locking disc of radius {self.radius:.9g} mm does not reach a plate of radius {self.plate:.9g} mm",
                key="locking.radius",
                fix=f"choose locking.radius above {safely_above(a - self.plate)} mm",
            )
        self._require_room()

    @staticmethod
    def _require_below(name: str, value: float, limit: float, what: str) -> None:
        if value >= limit:
            fix = f"choose locking.{name} below {safely_below(limit)} mm"
            raise NoSolution(f"locking.{name} of {value:.9g} mm {what}", key=f"locking.{name}", fix=fix)

    def _require_room(self) -> None:
        """Arcs apart from each other, and both their tips on the disc for some time."""
        a, p = self.distance, self.plate
        if self.half_arc * self.stops >= math.pi:
            most = math.sqrt(a * a + p * p - 2.0 * a * p * math.cos(math.pi / self.stops)) - self.clearance
            raise NoSolution(
                f"{self.stops} locking arcs of {short(math.degrees(2.0 * self.half_arc))} deg do not fit on the plate",
                key="locking.radius",
                fix=f"choose locking.radius below {safely_below(most)} mm",
            )
        if self.held <= 0.0:
            most = bracketed_root(lambda plate: self._with(plate).held, a - self.radius, p)
            raise NoSolution(
                f"the wheel passes {short(math.degrees(self.gap))} deg in the dwell, too little for the tips of the "
                f"plate's arc, {short(math.degrees(2.0 * self.contact))} deg apart about its axis, to lie on the disc",
                key="locking.plate_radius",
                fix=f"choose locking.plate_radius below {safely_below(most)} mm",
            )

    def _with(self, plate: float) -> Lock:
        """The same with another plate, whatever it is good for."""
        other = copy(self)
        object.__setattr__(other, "plate", plate)
        return other

    @property
    def hollow(self) -> float:
        """Radius of the plate's arcs [mm], R + c."""
        return self.radius + self.clearance

    def _tip(self, radius: float) -> float:
        """Angle at the driven axis from the line of centres to the plate's rim at a radius about the wheel [rad]."""
        return triangle_angle(self.distance, self.plate, radius)

    @property
    def half_arc(self) -> float:
        """Half of the angle of a plate's arc about the driven axis [rad].

        cos gamma = (a^2 + p^2 - (R + c)^2)/(2 a p)
        """
        return self._tip(self.hollow)

    @property
    def reach(self) -> float:
        """Half of the angle of a plate's arc about the wheel's axis [rad]."""
        return triangle_angle(self.distance, self.hollow, self.plate)

    @property
    def play(self) -> float:
        """Angle that the driven gear can turn in the dwell, from one tip on the disc to the other [rad].

        2 (gamma(R + c) - gamma(R))
        """
        return 2.0 * (self.half_arc - self._tip(self.radius))

    @property
    def contact(self) -> float:
        """Angle at the wheel's axis from the line of centres to the tip that lies on the disc [rad].

        cos delta = (a^2 + R^2 - p^2)/(2 a R)
        """
        return triangle_angle(self.distance, self.radius, self.plate)

    @property
    def arm(self) -> float:
        """Distance of the locking force from the driven axis [mm], a sin delta: its line passes through the wheel's."""
        return self.distance * math.sin(self.contact)

    @property
    def edge(self) -> float:
        """Angle of the wheel by which an arc of the disc ends before the line of centres when a motion begins [rad].

        The tip of the plate's arc passes the line of centres when the driven gear has turned by gamma, and goes on
        inside the disc's circle towards the edge: in the frame of the wheel to arg T + (gamma + u)/rho,
        T = a - p exp(i u), 0 <= u <= gamma(R), the least at T (T - W P) = 0, P the pitch point. Where that is
        negative, the arc ends there; else on the line of centres, where the plate's own arc touches the disc last: its
        envelope in the frame of the wheel leaves this place into the cut-out where R > a rho/(rho + 2), else away
        from the disc.
        """
        a, p, pole = self.distance, self.plate, self.distance * self.ratio / (1.0 + self.ratio)
        cosine = (p * p + a * (a - pole)) / (p * (2.0 * a - pole))
        if cosine >= 1.0:
            return 0.0
        u = min(math.acos(cosine), self._tip(self.radius))
        return max(0.0, -(cmath.phase(a - cmath.rect(p, u)) + (self.half_arc + u) / self.ratio))

    @property
    def arc(self) -> float:
        """Angle of an arc of the disc about the wheel's axis [rad]."""
        return self.gap - 2.0 * self.edge

    @property
    def held(self) -> float:
        """Angle of the wheel during which both tips lie on the disc [rad]."""
        return self.arc - 2.0 * self.contact

    @property
    def cut(self) -> float:
        """Radius of the disc's cut-out [mm], a - p - c."""
        return self.distance - self.plate - self.clearance

    @property
    def bottom(self) -> float:
        """Distance of the middle of a plate's arc from the driven axis [mm], a - R - c."""
        return self.distance - self.hollow
