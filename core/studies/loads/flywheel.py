"""Energy over the period, the flywheel for a fluctuation of the speed, and the speed that a flywheel leaves.

The drive gives a constant torque, the mean of the load; inertia varies with the input angle and is taken exactly.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.gauss import gauss_legendre
from gearlink.core.studies.loads.machine import Machine
from gearlink.core.studies.loads.panels import NODES, PANEL, Panels, fewest_samples

_STEPS = 30
_SAMPLED = 1e-9
Function = Callable[[Reals], Reals]


@dataclass(frozen=True)
class Energy:
    """Surplus W(phi) of the drive's constant torque over the load's, W' = M_m - tau.

    Fields
        load, inertia : functions of input angles - tau [N m] and J [kg m^2]
        panels : Panels - of the period
        mean : float [N m] - M_m, the mean of the load torque
        running : (n,) array [J] - W at the edges of the panels
        breaks : floats - places where the load jumps
        sampled : (N,) array [N m] or None - tau at the nodes of the panels; then no more of it is computed
    """

    load: Function
    inertia: Function
    panels: Panels
    mean: float
    running: Reals
    breaks: tuple[float, ...] = ()
    sampled: Reals | None = None

    @classmethod
    def of(cls, machine: Machine) -> Energy:
        """That of a machine under its own load.

        Notes
            Nothing more is computed than the load at the nodes of panels of a quarter of the usual width: the integral
            of the polynomials through them is as exact as Gauss' over wide ones. With friction to 1e-6 where the force
            of a pin comes near 0.
        """
        panels = Panels.over(machine.period, machine.breaks, 0.25 * PANEL)
        sampled = machine.load_torque(panels.nodes)

        def load(phi: Reals) -> Reals:
            return sampled if phi is panels.nodes else machine.load_torque(phi)

        found = cls.from_functions(load, lambda phi: machine.reduced(phi).inertia, panels, tuple(machine.breaks))
        return replace(found, sampled=sampled)

    @classmethod
    def from_functions(
        cls, load: Function, inertia: Function, panels: Panels, breaks: tuple[float, ...] = ()
    ) -> Energy:
        """From load torque and inertia over a period.

        Example
            >>> turn = Panels.over(2.0 * np.pi, [])
            >>> wave = Energy.from_functions(lambda x: 18.0 + 5.0 * np.sin(2.0 * x), np.ones_like, turn)
            >>> wave.mean, round(wave.fluctuation, 12)
            (18.0, 5.0)
        """
        values = load(panels.nodes)
        mean = panels.integral(values) / float(panels.edges[-1])
        mean = float(f"{mean:.15g}")  # a sum of thousands of terms: its last bit is chance
        return cls(load, inertia, panels, mean, panels.running(mean - values), breaks)

    @cached_property
    def _gauss(self) -> tuple[Reals, Reals]:
        x, weights = gauss_legendre(NODES)
        return 0.5 * (x + 1.0), 0.5 * weights

    def surplus(self, phi: Reals) -> Reals:
        """W at input angles within the period [J], 0 at its start.

        Notes
            Gauss from the edge of the panel on: as exact as the load torque is smooth between its breaks.
        """
        edges, row = self.panels.edges, self.panels.row(phi)
        if self.sampled is not None:
            return np.asarray(self.running[row] + self.panels.within(self.mean - self.sampled, phi))
        share, weights = self._gauss
        width = phi - edges[row]
        nodes = edges[row][:, None] + width[:, None] * share
        load = self.load(nodes.ravel()).reshape(nodes.shape)
        return np.asarray(self.running[row] + width * ((self.mean - load) @ weights))

    def extremes(self, *wanted: tuple[Function, bool]) -> list[Extreme]:
        """Maximum or minimum values of functions over the period, refined."""
        end = float(self.panels.edges[-1])
        samples = max(180, min(2 * (len(self.panels.edges) - 1), math.ceil(math.degrees(end))))
        fewest = fewest_samples(self.breaks)
        return extremes_over(wanted, 0.0, end, joints=self.breaks, samples=samples, fewest=fewest)

    @cached_property
    def range(self) -> tuple[float, float]:
        """Minimum and maximum surplus [J]."""
        least, greatest = self.extremes((self.surplus, False), (self.surplus, True))
        return least.value, greatest.value

    @property
    def fluctuation(self) -> float:
        """Maximum less minimum surplus [J]."""
        return self.range[1] - self.range[0]

    def flywheel_for(self, fluctuation: float, speed: float, more: float = 0.0) -> float:
        """Minimum flywheel that keeps the speed within a share of its mean [kg m^2].

        J_F = [max(W - J w_1^2/2) - min(W - J w_2^2/2)]/(delta w_m^2),  w_1,2 = w_m (1 +- delta/2)

        Parameters
            fluctuation : float - delta = (w_max - w_min)/w_m, w_m the mean of the two
            speed : float [rad/s] - w_m
            more : float [kg m^2] - inertia that the shaft has besides, a motor's
        Returns
            inertia : float [kg m^2] - 0 where none is needed
        Notes
            Exact with J(phi). The usual dW/(delta w^2) leaves J(phi) out.
        Example
            >>> turn = Panels.over(2.0 * np.pi, [])
            >>> wave = Energy.from_functions(lambda x: 5.0 * np.sin(2.0 * x), np.zeros_like, turn)
            >>> round(wave.flywheel_for(0.05, 10.0), 12)
            1.0

        Source
            energy over the period; own derivation of the form with variable inertia
        """
        fast, slow = (0.5 * (speed * (1.0 + sign * 0.5 * fluctuation)) ** 2 for sign in (1.0, -1.0))
        top, bottom = self.extremes(
            (lambda phi: self.surplus(phi) - fast * self.inertia(phi), True),
            (lambda phi: self.surplus(phi) - slow * self.inertia(phi), False),
        )
        return max(0.0, (top.value - bottom.value) / (fluctuation * speed * speed) - more)

    def run(self, flywheel: float, speed: float) -> SteadyRun | None:
        """The periodic run with a given flywheel, its mean of maximum and minimum speed as asked; None: it stops.

        Parameters
            flywheel : float [kg m^2] - all constant inertia on the input
            speed : float [rad/s] - w_m > 0
        """
        floor = -self.range[0]
        energy = self._sampled_start(flywheel, speed, floor)
        if energy is None:
            return None
        least = 1e-12 * energy
        for _ in range(_STEPS):
            # w_min + w_max rises with the energy and is concave: Newton, whose slope is 1/(J w) at both places.
            run = SteadyRun(self, flywheel, floor + energy)
            ends = run.extremes
            slope = sum(1.0 / (self._inertia_at(end.place) + flywheel) / end.value for end in ends)
            step = (2.0 * speed - sum(end.value for end in ends)) / slope
            if abs(step) <= 1e-15 * (floor + energy):
                return run
            if energy + step <= least and sum(SteadyRun(self, flywheel, floor + least).range) >= 2.0 * speed:
                return None
            energy = energy + step if energy + step > least else 0.25 * energy
        return SteadyRun(self, flywheel, floor + energy)

    def _sampled_start(self, flywheel: float, speed: float, floor: float) -> float | None:
        """About the energy at the maximum deficit with which the speed has its mean [J], by the nodes of the panels.

        Notes
            None where nothing moves that could hold an energy.
        """
        nodes = self.panels.nodes
        inertia, left = self.inertia(nodes) + flywheel, floor + self.surplus(nodes)
        first = energy = 0.5 * float(inertia.max()) * speed**2 + self.fluctuation
        if energy <= 0.0:
            return None
        for _ in range(_STEPS):
            # only a start: a place that a step leaves without energy counts as standing, and the next step mends it
            speeds = np.sqrt(2.0 * np.maximum(left + energy, 0.0) / inertia)
            ends = int(np.argmin(speeds)), int(np.argmax(speeds))
            slope = sum(1.0 / float(inertia[k] * speeds[k]) for k in ends)
            step = (2.0 * speed - sum(float(speeds[k]) for k in ends)) / slope
            if not energy + step > 1e-12 * first:
                return first
            energy += step
            if abs(step) <= _SAMPLED * energy:
                return energy
        return first

    def _inertia_at(self, place: float) -> float:
        return float(self.inertia(np.array([place]))[0])


@dataclass(frozen=True)
class SteadyRun:
    """Speed over the input angle where the energy is E0 + W(phi).

    Fields
        flywheel : float [kg m^2]
        start : float [J] - E0, energy at input angle 0
    """

    energy: Energy
    flywheel: float
    start: float

    def kinetic(self, phi: Reals) -> Reals:
        """Kinetic energy of all that moves [J]."""
        return self.start + self.energy.surplus(phi)

    def speed(self, phi: Reals) -> Reals:
        """Speed of the input [rad/s]."""
        inertia = self.energy.inertia(phi) + self.flywheel
        # A run starts with an energy above the maximum deficit: below 0 it falls by rounding alone, at a standstill.
        return np.asarray(np.sqrt(2.0 * np.maximum(self.kinetic(phi), 0.0) / inertia))

    @cached_property
    def extremes(self) -> tuple[Extreme, Extreme]:
        """Minimum and maximum speed [rad/s] with their places."""
        least, greatest = self.energy.extremes((self.speed, False), (self.speed, True))
        return least, greatest

    @property
    def range(self) -> tuple[float, float]:
        """Minimum and maximum speed [rad/s]."""
        low, high = self.extremes
        return low.value, high.value
