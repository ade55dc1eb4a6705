"""Forces of a plane machine by free bodies, from places alone: Fourier derivatives, one dense system a row.

Nothing of the program is used. Places are given at even steps of a period; a tooth presses with one force along a line
of action, of which flank the sign of the force decides.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

ROWS = 512
Array = Any


def phi() -> Array:
    """Input angles of a revolution."""
    return 2.0 * math.pi * np.arange(ROWS) / ROWS


def derivative(values: Array, order: int = 1) -> Array:
    """With respect to the input angle, of a periodic function plus whole revolutions."""
    turns = np.round((2.0 * values[-1] - values[-2] - values[0]).real / (2.0 * math.pi)) if values.dtype == float else 0
    waves = np.fft.fftfreq(ROWS, 1.0 / ROWS)
    waves[ROWS // 2] = 0.0
    found = np.fft.ifft((1j * waves) ** order * np.fft.fft(values - turns * phi()))
    return found if values.dtype == complex else found.real + (turns if order == 1 else 0.0)


def circle_meet(p: Array, q: Array, a: float, b: float, side: int) -> Array:
    """The point at a from p and b from q, left of the way from p to q for +1."""
    way = q - p
    n = np.abs(way)
    along = (a * a - b * b + n * n) / (2.0 * n)
    return p + way / n * (along + 1j * side * np.sqrt(a * a - along * along))


def angle(values: Array) -> Array:
    return np.unwrap(np.angle(values))


@dataclass
class Body:
    """A link: place of its origin, direction, and what the file gives it, in mm, kg, kg m^2."""

    origin: Array
    turn: Array
    mass: float = 0.0
    inertia: float = 0.0
    center: complex = 0j
    loads: list[tuple[Array, Array, Array]] = field(default_factory=list)
    """Force, place, couple."""

    def at(self, arm: complex) -> Array:
        return self.origin + 1e-3 * arm * np.exp(1j * self.turn)

    @property
    def place(self) -> Array:
        return self.at(self.center)


@dataclass
class Machine:
    bodies: dict[str, Body]
    pins: dict[str, tuple[str, str, Array]]
    """First and second link and place; the force is that on the second."""
    drive: str
    speed: float
    gravity: complex = 0j
    guides: dict[str, tuple[str, complex]] = field(default_factory=dict)
    teeth: dict[str, tuple[str, str, Array, Array, float]] = field(default_factory=dict)
    """First and second wheel, pitch point, direction from the first's centre, pressure angle, below 0 for a ring."""

    def torque(self) -> Array:
        """By the change of the energy."""
        energy, work = np.zeros(ROWS), np.zeros(ROWS)
        for body in self.bodies.values():
            speed, turning = derivative(body.place) * self.speed, derivative(body.turn) * self.speed
            energy += 0.5 * (body.mass * np.abs(speed) ** 2 + body.inertia * turning**2)
            work += (np.conj(body.mass * self.gravity) * derivative(body.place)).real
            for force, place, couple in body.loads:
                carried = derivative(place)
                work += (np.conj(force) * carried).real + couple * derivative(body.turn)
        return derivative(energy) - work

    def forces(self) -> tuple[dict[str, Array], Array]:
        """Forces of pins, guides and teeth, and the torque of the drive."""
        flanks = {name: np.ones(ROWS) for name in self.teeth}
        for _ in range(3):
            found = self._solved(flanks)
            flanks = {name: np.where(found[name] < 0.0, -flanks[name], flanks[name]) for name in self.teeth}
        return found, found.pop("drive")

    def line(self, name: str, flank: Array) -> Array:
        """Direction of the normal force on the second wheel, which always presses."""
        *_, toward, alpha = self.teeth[name]
        return flank * 1j * toward * math.cos(alpha) + toward * math.sin(alpha)

    def _solved(self, flanks: dict[str, Array]) -> dict[str, Array]:
        names = list(self.bodies)
        size = 3 * len(names)
        columns: list[tuple[str, list[tuple[str, Array, Array, float]]]] = []
        for name, (first, second, place) in self.pins.items():
            for unit in (1.0 + 0j, 1j):
                columns.append((name, [(second, unit, place, 0.0), (first, -unit, place, 0.0)]))
        for name, (body, along) in self.guides.items():
            columns.append((name, [(body, 1j * along, self.bodies[body].origin, 0.0)]))
            columns.append((name, [(body, 0j, self.bodies[body].origin, 1.0)]))
        for name, (first, second, place, _, _) in self.teeth.items():
            push = self.line(name, flanks[name])
            columns.append((name, [(second, push, place, 0.0), (first, -push, place, 0.0)]))
        columns.append(("drive", [(self.drive, 0j, self.bodies[self.drive].origin, 1.0)]))
        matrix, side = np.zeros((ROWS, size, size)), np.zeros((ROWS, size))
        assert len(columns) == size
        for j, (_, acts) in enumerate(columns):
            for body, force, at, couple in acts:
                if body != "frame":
                    k, arm = 3 * names.index(body), at - self.bodies[body].place
                    matrix[:, k, j] += np.real(force)
                    matrix[:, k + 1, j] += np.imag(force)
                    matrix[:, k + 2, j] += (np.conj(arm) * force).imag + couple
        for i, body in enumerate(self.bodies.values()):
            wanted = body.mass * (derivative(body.place, 2) * self.speed**2 - self.gravity)
            couple = body.inertia * derivative(body.turn, 2) * self.speed**2
            for force, at, moment in body.loads:
                wanted = wanted - force
                couple = couple - (np.conj(at - body.place) * force).imag - moment
            side[:, 3 * i], side[:, 3 * i + 1], side[:, 3 * i + 2] = wanted.real, wanted.imag, couple
        solution = np.linalg.solve(matrix, side[..., None])[..., 0]
        found: dict[str, Array] = {}
        for j, (name, _) in enumerate(columns):
            value = solution[:, j] * (1j if name in self.pins and name in found else 1.0)
            found[name] = (found[name] + value) if name in self.pins and name in found else found.get(name, value)
        return found


def cis(degrees: float) -> complex:
    return cmath.rect(1.0, math.radians(degrees))
