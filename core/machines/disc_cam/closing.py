"""What holds a follower on its cam: spring, preload, lift-off, width for the contact pressure.

T = F0 + k s + m s'' Omega^2 - F_u - m g.u along the travel; oscillating: T0 + c s + J s'' Omega^2 - M about the pivot.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, maximum_over
from gearlink.core.parts.cams.disc_cam import SAMPLES

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.cams import FollowerCams
    from gearlink.core.machines.disc_cam.spec import DiscCamSpec

MILLIMETER = 1e-3
RPM = math.pi / 30.0


class Closing:
    """Forces along the lift [N, or N m], of a file with a spring."""

    def __init__(self, spec: DiscCamSpec, cams: FollowerCams) -> None:
        self.spec, self.cams = spec, cams
        self.follower: Any = spec.follower

    @cached_property
    def inertia(self) -> float:
        """Force per acceleration of the lift [N/(mm/s^2), or N m/(rad/s^2)]."""
        follower = self.spec.follower
        if self.spec.oscillates:
            return float(getattr(follower, "inertia", None) or 0.0)
        return float(getattr(follower, "mass", None) or 0.0) * MILLIMETER

    @property
    def speed(self) -> float:
        """Speed of the cam [rad/s]; 0 where the file gives none."""
        return 0.0 if self.spec.speed is None else self.spec.speed * RPM

    @property
    def rate(self) -> float:
        """Spring rate [N/mm, or N m/rad]."""
        return 0.0 if self.spec.spring is None else self.spec.spring.rate

    def outside(self, phi: Reals) -> Reals:
        """What acts against the spring: -F_u - m g.u of the section `loads` [N, or N m]."""
        section = self.spec.loads
        if section is None:
            return np.zeros_like(phi)
        from gearlink.core.studies.loads.sources import values

        found = np.zeros_like(phi)
        if not self.spec.oscillates:
            gravity = complex(*section.gravity)
            found = found - self.inertia / MILLIMETER * (gravity * self.cams.direction.conjugate()).real
        for load in section.forces:
            value = load.torque if self.spec.oscillates else load.force
            if load.on == "follower" and value is not None and not isinstance(value, list):
                sense = -self.follower.side if self.spec.oscillates else 1
                found = found - sense * values(value, phi)
        return found

    @cached_property
    def preload(self) -> float | None:
        """Force of the spring at lift 0, given or the minimum [N, or N m]; None without a spring."""
        spring = self.spec.spring
        if spring is None:
            return None
        if spring.preload is not None:
            return spring.preload
        least = spring.least_force or 0.0

        def lacking(phi: Reals) -> Reals:
            s, _, s2 = self.cams.motion.evaluate(phi, 2)
            still = least - self.rate * s - self.outside(phi)
            return np.maximum(still, still - self.inertia * s2 * self.speed**2)

        return max(0.0, self._most(lacking).value)

    def _most(self, course: Callable[[Reals], Reals]) -> Extreme:
        return maximum_over(course, joints=self.cams.motion.joints, samples=SAMPLES)

    def static(self, phi: Reals) -> Reals:
        """T without the inertia [N, or N m]."""
        found: Reals = (self.preload or 0.0) + self.rate * self.cams.motion.evaluate(phi, 0)[0] + self.outside(phi)
        return found

    def force(self, phi: Reals) -> Reals:
        """T at the speed of the file [N, or N m]."""
        return self.static(phi) + self.inertia * self.cams.motion.evaluate(phi, 2)[2] * self.speed**2

    @cached_property
    def unloading(self) -> Extreme | None:
        """Maximum 1/Omega*^2 = -m s''/T_static and its cam angle; None without spring or mass.

        It is inf where the spring does not hold the follower on the cam at rest.
        """
        if self.spec.spring is None or not self.inertia:
            return None

        least = self._most(lambda phi: -self.static(phi))
        if least.value >= 0.0:  # the spring alone does not hold it there
            return Extreme(math.inf, least.place)

        def share(phi: Reals) -> Reals:
            return np.asarray(-self.inertia * self.cams.motion.evaluate(phi, 2)[2] / self.static(phi))

        return self._most(share)

    def preload_for(self, speed: float) -> float:
        """Preload that keeps the follower on the cam up to a speed [rad/s]."""

        def lacking(phi: Reals) -> Reals:
            s, _, s2 = self.cams.motion.evaluate(phi, 2)
            return -self.rate * s - self.outside(phi) - self.inertia * s2 * speed**2

        return max(0.0, self._most(lacking).value)

    @property
    def lift_off_speed(self) -> float | None:
        """Speed at which the follower leaves the cam [1/min]; None where nothing ever lifts it, or is known."""
        found = self.unloading
        return None if found is None or found.value <= 0.0 else math.sqrt(1.0 / found.value) / RPM

    @cached_property
    def face_width(self) -> float | None:
        """Width that keeps the allowed contact pressure [mm], b = max(N/R) E*/(pi p^2); None without one."""
        section = self.spec.loads
        material = None if section is None else section.material
        if material is None or material.allowed_pressure is None or self.spec.closure != "spring":
            return None
        from gearlink.core.studies.loads.cams.contact import plane_modulus

        modulus = plane_modulus(material.modulus, material.poisson)
        worst = self._most(lambda phi: np.maximum(self.contact_force(phi), 0.0) / self.relative_radius(phi)).value
        return float(worst * modulus / (math.pi * material.allowed_pressure**2))

    def contact_force(self, phi: Reals) -> Reals:
        """N = T/cos alpha; rocker T/(l cos alpha); flat faces T, T/t [N]."""
        force, cams = self.force(phi), self.cams
        if self.spec.is_flat:
            return force / (cams.flat.touch(phi).place * MILLIMETER) if self.spec.oscillates else force
        lever = self.follower.arm * MILLIMETER if self.spec.oscillates else 1.0
        return np.asarray(force / (lever * np.cos(cams.main.pressure_angle(phi))))

    def relative_radius(self, phi: Reals) -> Reals:
        """R of the contact [mm]: r_g (1 - r_g kappa), or rho under a flat face."""
        if self.spec.is_flat:
            return self.cams.flat.touch(phi).radius
        roller = self.cams.main.roller_radius
        return np.asarray(roller * (1.0 - roller * self.cams.main.curvature(phi)))
