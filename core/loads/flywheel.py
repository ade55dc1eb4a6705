"""Energy over the period, and the flywheel that holds the speed within a share of its mean."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gearlink.core.loads.machine import NODES, Machine, Panels
from gearlink.core.numerics.arrays import Reals


@dataclass(frozen=True)
class Energy:
    """Surplus W(phi) of the drive's constant torque over the load's, W' = M_m - tau.

    Fields
        machine : Machine
        mean : float [N m] - M_m, the mean of the load torque
        running : (n,) array [J] - W at the edges of the machine's panels
    """

    machine: Machine
    mean: float
    running: Reals

    @classmethod
    def of(cls, machine: Machine) -> Energy:
        """From the machine's own load torque."""
        load = machine.load_torque(machine.panels.nodes)
        mean = machine.panels.integral(load) / machine.period
        return cls(machine, mean, machine.panels.running(mean - load))

    @cached_property
    def _gauss(self) -> tuple[Reals, Reals]:
        x, weights = np.polynomial.legendre.leggauss(NODES)
        return 0.5 * (x + 1.0), 0.5 * weights

    def surplus(self, phi: Reals) -> Reals:
        """W at input angles within the period [J], 0 at its start.

        Notes
            Gauss from the edge of the panel on: as exact as the load torque is smooth between its breaks.
        """
        panels: Panels = self.machine.panels
        row = np.clip(np.searchsorted(panels.edges, phi, side="right") - 1, 0, len(panels.edges) - 2)
        start = panels.edges[row]
        share, weights = self._gauss
        width = phi - start
        nodes = start[:, None] + width[:, None] * share
        load = self.machine.load_torque(nodes.ravel()).reshape(nodes.shape)
        return np.asarray(self.running[row] + width * ((self.mean - load) @ weights))
