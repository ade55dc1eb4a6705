"""Shaking force and moment of a machine, and the counterweights that balance it."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, Any

from gearlink.core.loads.base import LoadsBase
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals


class BalancedLoads(LoadsBase):
    """The forces of the masses on the frame, as they are and with counterweights."""

    @cached_property
    def shaking_force_max(self) -> float:
        """Greatest shaking force [N]."""
        return self.extreme_of("shaking_force").value

    @cached_property
    def shaking_moment_max(self) -> float:
        """Greatest magnitude of the shaking moment about the input's pivot [N m]."""
        return self.extreme_of("shaking_moment").value

    def shaking(self, phi: Reals) -> Any:
        """Force and moment of the masses on the frame."""
        from gearlink.core.mechanism.dynamics import shaking

        return shaking(self.machine.at(phi), self.masses, self.speed)

    # Counterweights

    def counterweights(self) -> dict[str, complex]:
        """Mass moments [kg mm] by link in its coordinates that balance the machine as the file asks."""
        return {}

    @cached_property
    def balance(self) -> dict[str, complex]:
        """The counterweights that the file asks for."""
        asked = getattr(self.section, "balance", None)
        if asked is None:
            return {}
        share = getattr(asked, "share", 1.0)
        return {name: share * moment for name, moment in self.counterweights().items()}

    def balanced_force(self, moments: dict[str, complex]) -> float:
        """Greatest shaking force with these counterweights [N]."""
        from gearlink.core.mechanism.dynamics import Mass, shaking

        # On a link that turns about its origin, 1 kg at U mm has the mass moment U, and nothing else in the force.
        weights = {name: Mass(1.0, 0.0, moment) for name, moment in moments.items()}

        def force(phi: Reals) -> Reals:
            added = shaking(self.machine.at(phi), weights, self.speed)[0]
            return np_abs(self.shaking(phi)[0] + added)

        return self.extreme(force).value

    def _moment(self, name: str) -> complex | None:
        return self.balance.get(name)

    @property
    def counterweight_crank(self) -> float | None:
        """Mass moment of the crank's counterweight [kg mm]."""
        return _size(self._moment("crank"))

    @property
    def counterweight_crank_direction(self) -> float | None:
        """Its direction in the crank's coordinates [rad]."""
        return _direction(self._moment("crank"))

    @property
    def counterweight_rocker(self) -> float | None:
        """Mass moment of the rocker's counterweight [kg mm]."""
        return _size(self._moment("rocker"))

    @property
    def counterweight_rocker_direction(self) -> float | None:
        """Its direction in the rocker's coordinates [rad]."""
        return _direction(self._moment("rocker"))

    @cached_property
    def balanced_force_max(self) -> float | None:
        """Greatest shaking force with the counterweights [N]."""
        from gearlink.core.report import without_noise

        if not self.balance:
            return None
        return without_noise(self.balanced_force(self.balance), 64.0 * self.shaking_force_max)


def np_abs(values: Any) -> Reals:
    """Magnitudes of plane vectors."""
    found: Reals = abs(values)
    return found


def _size(moment: complex | None) -> float | None:
    return None if moment is None else abs(moment)


def _direction(moment: complex | None) -> float | None:
    return None if moment is None else cmath.phase(moment)
