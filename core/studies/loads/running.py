"""How a machine runs: at a constant speed, with a flywheel at a constant drive torque, or with a motor.

The torque of a motor falls linearly with its speed, M = k (w_0 - w):

dE/dphi = k (w_0 - w) - tau(phi),  E = (J(phi) + J_F) w^2/2

Over a turn the energy E becomes P(E) with 0 < P' < 1, so that there is one periodic run at most, and Newton on P(E) - E
finds it. A panel of the period is taken by Gauss collocation, whose Newton step gives P' as well.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import extremes_over
from gearlink.core.numerics.gauss import gauss_legendre
from gearlink.core.studies.loads.flywheel import Function
from gearlink.core.studies.loads.names import RPM
from gearlink.core.studies.loads.panels import Panels, fewest_samples, to_integral

if TYPE_CHECKING:
    from gearlink.core.studies.loads.design import LoadsDesign


class Running:
    """Flywheel, motor and the speed over the input angle of one design."""

    def __init__(self, design: LoadsDesign) -> None:
        self.design = design
        self.flywheel, self.motor = design.section.flywheel, design.section.motor

    @cached_property
    def motor_inertia(self) -> float:
        """The motor's inertia at the input [kg m^2]."""
        return 0.0 if self.motor is None else self.motor.inertia * self.motor.ratio**2

    @cached_property
    def needed(self) -> float | None:
        """Flywheel for the fluctuation of the file [kg m^2]; None where it asks for none."""
        if self.flywheel is None or self.flywheel.fluctuation is None:
            return None
        speed = abs(self.design.speed)
        return float(self.design.energy.flywheel_for(self.flywheel.fluctuation, speed, self.motor_inertia))

    @cached_property
    def inertia(self) -> float:
        """All constant inertia on the input: flywheel, given or needed, and motor [kg m^2]."""
        given = None if self.flywheel is None else self.flywheel.inertia
        return (given if given is not None else self.needed or 0.0) + self.motor_inertia

    @cached_property
    def run(self) -> Any:
        """The periodic run; None at constant speed, or where the machine stops."""
        if self.motor is not None:
            return self.motor_run
        if self.flywheel is None:
            return None
        self._require_inertia()
        return self.design.energy.run(self.inertia, abs(self.design.speed))

    def _require_inertia(self) -> None:
        # what the links add is nowhere negative, and is not sought where there is a flywheel or a motor
        if not (self.inertia > 0.0 or self.design.reflected_inertia_min > 0.0):
            raise MissingSection(
                "the speed is not defined without inertia at the input",
                key="loads.flywheel",
                fix="give loads.flywheel: {inertia: kg m^2}, or masses in loads.links",
            )

    @cached_property
    def stops(self) -> bool:
        """Whether the flywheel is too small to come round at a constant drive torque."""
        return self.motor is None and self.flywheel is not None and self.run is None

    @cached_property
    def slope(self) -> float:
        """k at the input [N m s]."""
        motor = self.motor
        assert motor is not None, "needed only with a motor"
        if motor.slope is not None:
            return float(motor.slope * motor.ratio**2)
        slip = (motor.no_load_speed - motor.rated_speed) * RPM
        return float(motor.rated_torque / slip * motor.ratio**2)

    @property
    def ratio_of_speed(self) -> float | None:
        """Ratio with which the motor runs the input at the speed of the file; None where it is too weak for that.

        k r^2 (w_0/r - w) = T, the greater root r; w_0 and k without load and of the motor's slope, T the mean torque
        """
        motor = self.motor
        assert motor is not None, "needed only with a motor"
        free, ratio, wanted = motor.no_load_speed * RPM, motor.ratio, abs(self.design.speed)
        torque = self.slope * (free / ratio - 0.5 * sum(self.range) * RPM)
        root = free**2 - 4.0 * wanted * torque * ratio**2 / self.slope
        return 0.5 * (free + math.sqrt(root)) / wanted if root > 0.0 else None

    @cached_property
    def motor_run(self) -> MotorRun:
        """The run with the motor, over an angle that rises with time."""
        self._require_inertia()
        machine = self.design.machine
        forward = machine.speed > 0.0
        breaks = machine.breaks if forward else sorted(machine.period - angle for angle in machine.breaks)

        def at(angle: Reals) -> Reals:
            return angle if forward else machine.period - angle

        def load(angle: Reals) -> Reals:
            tau = machine.load_torque(at(angle))
            return tau if forward else -tau

        return MotorRun(
            load,
            lambda angle: machine.reduced(at(angle)).inertia + self.inertia,
            Panels.over(machine.period, breaks),
            self.slope,
            self.motor.no_load_speed / self.motor.ratio * RPM,
            tuple(breaks),
        )

    # Over the input angle

    def _own_angle(self, phi: Reals) -> Reals:
        """The angle of the run at input angles: with a motor it rises with time."""
        machine = self.design.machine
        if self.motor is not None and machine.speed < 0.0:
            return np.mod(machine.period - phi, machine.period)
        return phi

    def speed(self, phi: Reals) -> Reals:
        """Speed of the input [rad/s], signed."""
        if self.run is None:
            return np.full_like(phi, self.design.speed)
        found: Reals = math.copysign(1.0, self.design.speed) * self.run.speed(self._own_angle(phi))
        return found

    @cached_property
    def _paces(self) -> Reals:
        """Time per angle at the nodes of the machine's panels [s]."""
        return np.asarray(1.0 / np.abs(self.speed(self.design.machine.panels.nodes)))

    def time(self, phi: Reals) -> Reals:
        """Time since input angle 0 at input angles of the period [s], the input turning its own way; each stands alone.

        Notes
            An input that turns backwards comes to the maximum angles first.
        """
        panels = self.design.machine.panels
        edges = panels.running(self._paces)
        found = np.asarray(edges[panels.row(phi)] + panels.within(self._paces, phi))
        return np.where(found > 0.0, edges[-1] - found, 0.0) if self.design.speed < 0.0 else found

    @cached_property
    def range(self) -> tuple[float, float]:
        """Minimum and maximum speed, magnitudes [1/min]."""
        if self.run is None:
            speed = abs(self.design.speed) / RPM
            return speed, speed
        low, high = self.run.range
        return low / RPM, high / RPM

    @property
    def fluctuation(self) -> float:
        """(maximum - minimum)/mean of the two."""
        low, high = self.range
        return 2.0 * (high - low) / (high + low)

    @cached_property
    def motor_rms(self) -> float | None:
        """Root mean square of the motor's torque at its own shaft [N m]."""
        return None if self.motor is None else self.motor_run.rms_torque / self.motor.ratio

    @cached_property
    def motor_peak(self) -> float | None:
        """The motor's torque of the maximum magnitude at its own shaft [N m]; negative where the load drives it.

        Notes
            Its torque falls with its speed, so that the maximum is that at the minimum speed or at the maximum.
        """
        if self.motor is None:
            return None
        at_ends = [self.slope * (self.motor_run.no_load - speed) / self.motor.ratio for speed in self.motor_run.range]
        return float(max(at_ends, key=abs))


_TURNS = 60
_STEPS = 40
_SETTLED = 4e-15
_ROUNDING = 1e-12


@lru_cache
def _collocation(order: int) -> tuple[Reals, Reals]:
    """Matrix of integrals from 0 to each Gauss node of [0, 1], and weights of the whole."""
    x, weights = gauss_legendre(order)
    return np.polynomial.legendre.legvander(x, order) @ to_integral(order).T, 0.5 * weights


@dataclass(frozen=True)
class MotorRun:
    """The periodic run over an angle that rises with time.

    Parameters
        load, inertia : functions of that angle - tau [N m] and J [kg m^2] with all constant inertia
        panels : Panels - of the period
        slope : float [N m s] - k at the input
        no_load : float [rad/s] - w_0 at the input
        breaks : floats - places where the load jumps
    Raises
        NoSolution - from any result, where the motor stalls
    """

    load: Function
    inertia: Function
    panels: Panels
    slope: float
    no_load: float
    breaks: tuple[float, ...] = ()

    @cached_property
    def _given(self) -> tuple[Reals, Reals]:
        """Load and inertia at the nodes, a row a panel."""
        nodes = self.panels.nodes
        order = self.panels.order
        return self.load(nodes).reshape(-1, order), self.inertia(nodes).reshape(-1, order)

    def _panel(self, k: int, energy: float) -> tuple[float, float, Reals] | None:
        """Energy at the end of a panel, its derivative by that at the start, and dE/dphi at the nodes; None: stalls."""
        order = self.panels.order
        matrix, weights = _collocation(order)
        h = float(self.panels.edges[k + 1] - self.panels.edges[k])
        values = np.full(order, energy)
        for _ in range(_STEPS):
            rate, fall = self._rates(values, k)
            system = np.eye(order) - h * matrix * fall
            step = np.linalg.solve(system, energy + h * (matrix @ rate) - values)
            share = 1.0
            while np.any(values + share * step <= 0.0):
                share *= 0.5
                if share < 1e-3:
                    return None
            values = values + share * step
            if share == 1.0 and np.max(np.abs(step)) <= _SETTLED * np.max(values):
                break
        rate, fall = self._rates(values, k)
        gain = np.linalg.solve(np.eye(order) - h * matrix * fall, np.ones(order))
        end = energy + h * float(weights @ rate)
        return (end, 1.0 + h * float(weights @ (fall * gain)), rate) if end > 0.0 else None

    def _turn(self, energy: float) -> tuple[float, float, Reals, Reals] | None:
        """P(E) - E, P', the energies at the edges and the rates at the nodes; None where the motor stalls."""
        edges, rates, slope = [energy], [], 1.0
        for k in range(len(self.panels.edges) - 1):
            found = self._panel(k, edges[-1])
            if found is None:
                return None
            edges.append(found[0])
            slope *= found[1]
            rates.append(found[2])
        return edges[-1] - energy, slope, np.array(edges), np.array(rates)

    def _rates(self, values: Reals, k: Any = ...) -> tuple[Reals, Reals]:
        """dE/dphi at the nodes of a panel, or of all, where these are the energies there, and its slope by them."""
        load, inertia = (each[k] for each in self._given)
        speed = np.sqrt(2.0 * values / inertia)
        return self.slope * (self.no_load - speed) - load, -self.slope / (inertia * speed)

    def _joined(self, values: Reals) -> tuple[Reals, Reals, float]:
        """One of Newton's steps on the whole period: energies at the edges and at the nodes, and P'.

        v = a + g e at the nodes of a panel that starts with the energy e, c + d e at its end; the ends are joined.
        """
        matrix, weights = _collocation(self.panels.order)
        rate, fall = self._rates(values)
        h = np.diff(self.panels.edges)[:, None]
        system = np.eye(self.panels.order) - (h * fall)[:, None, :] * matrix
        right = np.stack([h * (rate @ matrix.T) - values, np.ones_like(values)], axis=-1)
        change, share = np.moveaxis(np.linalg.solve(system, right), -1, 0)
        ahead = (h[:, 0] * ((rate + fall * change) @ weights)).tolist()
        left = (1.0 + h[:, 0] * ((fall * share) @ weights)).tolist()
        end, slope = 0.0, 1.0
        for c, d in zip(ahead, left, strict=True):
            end, slope = c + d * end, d * slope
        edges = [end / (1.0 - slope) if slope != 1.0 else math.inf]
        for c, d in zip(ahead, left, strict=True):
            edges.append(c + d * edges[-1])
        return np.array(edges), values + change + share * np.array(edges[:-1])[:, None], slope

    def _at_once(self) -> tuple[Reals, Reals] | None:
        """The periodic run from one of even speed, all panels together; None where that does not lead to it."""
        load, inertia = self._given
        even = self.no_load - self.panels.integral(load.ravel()) / (float(self.panels.edges[-1]) * self.slope)
        values, last = 0.5 * inertia * even**2, math.inf
        for _ in range(_STEPS if even > 0.0 else 0):
            edges, found, slope = self._joined(values)
            if not (found > 0.0).all() or not (edges > 0.0).all() or not slope < 1.0:
                return None
            step, values = float(np.max(np.abs(found - values)) / np.max(found)), found
            if step <= _SETTLED or (step >= last and step < _ROUNDING):
                return edges, self._rates(values)[0]
            last = step
        return None

    @cached_property
    def _periodic(self) -> tuple[Reals, Reals]:
        """Energies at the edges and rates at the nodes of the periodic run."""
        with np.errstate(all="ignore"):  # energies that are none are looked for after every step
            found = self._at_once()
        return found or self._turn_by_turn()

    def _turn_by_turn(self) -> tuple[Reals, Reals]:
        """The same by whole turns one after the other, each panel by panel: slower, and certain to tell what stalls."""
        load, inertia = self._given
        fastest = self.no_load - float(load.min()) / self.slope
        if fastest <= 0.0:
            raise _stalls()
        energy = high = 0.5 * float(inertia.max()) * fastest**2
        for _ in range(_TURNS):
            found = self._turn(energy)
            if found is None:  # too little to come round: between here and the minimum that is known to come round
                if high - energy <= 1e-12 * high:
                    raise _stalls()
                energy = 0.5 * (energy + high)
                continue
            change, slope, edges, rates = found
            if abs(change) <= 8.0 * _SETTLED * energy:
                return edges, rates
            if change < 0.0:
                high = min(high, energy)
            step = energy + change / (1.0 - slope)
            energy = step if step > 0.0 else 0.25 * energy
        if abs(change) <= 1e-11 * energy:
            return edges, rates
        raise _stalls()

    def kinetic(self, phi: Reals) -> Reals:
        """Kinetic energy at angles within the period [J]."""
        edges, rates = self._periodic
        return np.asarray(edges[self.panels.row(phi)] + self.panels.within(rates.ravel(), phi))

    def speed(self, phi: Reals) -> Reals:
        """Speed of the input [rad/s]."""
        return np.asarray(np.sqrt(2.0 * self.kinetic(phi) / self.inertia(phi)))

    def torque(self, phi: Reals) -> Reals:
        """Torque of the motor at the input [N m]."""
        return np.asarray(self.slope * (self.no_load - self.speed(phi)))

    @cached_property
    def range(self) -> tuple[float, float]:
        """Minimum and maximum speed [rad/s]."""
        end = float(self.panels.edges[-1])
        samples = max(360, min(10 * (len(self.panels.edges) - 1), math.ceil(math.degrees(end))))
        fewest = fewest_samples(self.breaks)
        wanted = [(self.speed, False), (self.speed, True)]
        low, high = extremes_over(wanted, 0.0, end, joints=self.breaks, samples=samples, fewest=fewest)
        return low.value, high.value

    @cached_property
    def rms_torque(self) -> float:
        """Root mean square over the time of the motor's torque at the input [N m]."""
        nodes = self.panels.nodes
        speed = self.speed(nodes)
        torque = self.slope * (self.no_load - speed)
        return math.sqrt(self.panels.integral(torque**2 / speed) / self.panels.integral(1.0 / speed))


def _stalls() -> NoSolution:
    return NoSolution(
        "the motor stalls: over a period the load needs more energy than the motor gives",
        key="loads.motor",
        fix="increase its torque (slope, rated_torque) or no_load_speed, change ratio, or add a flywheel",
    )
