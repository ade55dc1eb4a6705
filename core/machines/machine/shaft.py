"""The main shaft as a chain of discs and springs: natural frequencies, shapes, and the swing under periodic torques."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.remedies.ways import at_least
from gearlink.core.base.report import Remedy, safely_above
from gearlink.core.base.torsion import ShaftPiece, torsional_stiffness
from gearlink.core.machines.machine.codes import NEAR
from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from gearlink.core.machines.machine.spec import MainShaft

ASSUMED_DAMPING = 0.03
_SPARE = 1e-9
_TURN = 2.0 * math.pi


def stiffened(shaft: MainShaft, frequencies: Reals) -> Iterator[Remedy]:
    """The shaft with all stiffnesses, or the diameters that give them, as much greater as keeps off.

    Parameters
        frequencies : (n,) array [rad/s] - at which something excites the shaft
    Notes
        All natural frequencies rise by one ratio, to the nearest that leaves each away from all of these.
    """
    natural = Chain.of(shaft).natural
    ratios = frequencies[:, None] / ((1.0 - NEAR) * natural)
    for ratio in np.unique(ratios[ratios > 1.0]):
        remedy: Remedy = ()
        values: list[Any] = []
        for i, given in enumerate(shaft.stiffnesses):
            changes, value = _stiffer(given, f"shaft.stiffnesses[{i}]", float(ratio) ** 2 * (1.0 + _SPARE))
            remedy, values = (*remedy, *changes), [*values, value]
        off = frequencies[:, None] / Chain.of(shaft.model_copy(update={"stiffnesses": values})).natural - 1.0
        if np.all(np.abs(off) >= NEAR):
            plain = all(isinstance(value, float) for value in values)
            yield (("shaft.stiffnesses", tuple(values)),) if plain else remedy


def _stiffer(given: float | ShaftPiece | list[ShaftPiece], key: str, factor: float) -> tuple[Remedy, Any]:
    """A stiffness so many times as great, to four digits up; of a piece of a shaft by its diameter, to 0.01 mm up."""
    if isinstance(given, list):
        found = [_stiffer(piece, f"{key}[{i}]", factor) for i, piece in enumerate(given)]
        return tuple(change for changes, _ in found for change in changes), [piece for _, piece in found]
    if isinstance(given, ShaftPiece):
        wanted = factor * (given.diameter**4 - given.bore**4) + given.bore**4
        diameter = at_least(wanted**0.25, 0.01)
        return ((f"{key}.diameter", diameter),), given.model_copy(update={"diameter": diameter})
    value = float(safely_above(factor * given, 4))
    return ((key, value),), value


@dataclass(frozen=True)
class Chain:
    """Discs on a shaft, all reduced to the main shaft.

    Fields
        inertias : (n,) array [kg m^2]
        stiffnesses : (n - 1,) array [N m/rad]
        fixed : bool - the first disc does not swing
        damping : float - ratio of every mode
    """

    inertias: Reals
    stiffnesses: Reals
    fixed: bool = False
    damping: float = ASSUMED_DAMPING

    @classmethod
    def of(cls, shaft: MainShaft) -> Chain:
        """That of a design file: J i^2, c i^2 of discs that turn i times a revolution, c at the first of both discs."""
        ratios = np.ones(len(shaft.inertias)) if shaft.ratios is None else np.array(shaft.ratios)
        square = ratios**2
        return cls(
            np.array(shaft.inertias) * square,
            np.array([torsional_stiffness(each) for each in shaft.stiffnesses]) * square[:-1],
            shaft.fixed,
            ASSUMED_DAMPING if shaft.damping is None else shaft.damping,
        )

    @property
    def discs(self) -> int:
        """How many."""
        return int(self.inertias.size)

    @cached_property
    def _modes(self) -> tuple[Reals, Reals]:
        """omega [rad/s], ascending without the 0 of the free chain, and shapes (n, modes) with phi' J phi = 1.

        Notes
            K = B C B', so that omega are the singular values of J^(-1/2) B C^(1/2), which has two diagonals: each to
            the last digits however far the stiffnesses lie apart, and none is 0.
        """
        n = self.discs
        spread = np.zeros((n, n - 1))
        rows = np.arange(n - 1)
        spread[rows, rows], spread[rows + 1, rows] = -1.0, 1.0
        moved = spread * np.sqrt(self.stiffnesses) / np.sqrt(self.inertias)[:, None]
        left, omega, _ = np.linalg.svd(moved[1:] if self.fixed else moved, full_matrices=False)
        shapes = np.zeros((n, omega.size))
        shapes[1 if self.fixed else 0 :] = left / np.sqrt(self.inertias[1:] if self.fixed else self.inertias)[:, None]
        order = np.argsort(omega)
        return omega[order], shapes[:, order]

    @property
    def natural(self) -> Reals:
        """Natural frequencies [rad/s], ascending; a free chain turns as a whole besides."""
        return self._modes[0]

    @cached_property
    def shapes(self) -> Reals:
        """(n, modes) array - angles of the discs, 1 at the last one.

        Source
            eigenvectors of K - omega^2 J; W. T. Thomson, Theory of Vibration, 12.4
        """
        found = self._modes[1]
        return np.asarray(found / found[-1])

    def wind_up(self, torques: Reals) -> Reals:
        """Angles of the discs against the first under constant torques that it holds (n,) [rad].

        Parameters
            torques : (n,) array [N m] - on the discs, in the sense of the turning
        """
        behind = np.cumsum(torques[::-1])[::-1]  # what each spring carries
        return np.concatenate([[0.0], np.cumsum(behind[1:] / self.stiffnesses)])

    def swing(self, torques: Points, frequency: Reals) -> Points:
        """Amplitudes of the discs under periodic torques, the shaft turning as a whole among them.

        theta = sum over modes of phi (phi' T)/(omega^2 - w^2 + 2 i zeta omega w)

        Parameters
            torques : (n, K) array [N m] - complex amplitudes of T e^(i w t)
            frequency : (K,) array [rad/s] - w > 0
        Returns
            amplitudes : (n, K) array [rad]
        Source
            modal superposition, the same damping ratio in every mode
        """
        omega, shapes = self._modes
        if not self.fixed:
            omega = np.concatenate([[0.0], omega])
            rigid = np.full((self.discs, 1), 1.0 / math.sqrt(float(self.inertias.sum())))
            shapes = np.hstack([rigid, shapes])
        pushed = shapes.T @ torques
        w = frequency[None, :]
        under = omega[:, None] ** 2 - w**2 + 2j * self.damping * omega[:, None] * w
        found: Points = shapes @ (pushed / under)
        return found


@dataclass(frozen=True)
class Swing:
    """The steady swing of the discs under torques that repeat, by harmonic balance.

    Fields
        torques : (n, N) array [N m] - on the discs at N equal steps of the period, in the sense of the turning; the
            first disc holds their mean
        turns : int - of the main shaft in the period
        speed : float [rad/s]
    """

    chain: Chain
    torques: Reals
    turns: int
    speed: float

    @cached_property
    def amplitudes(self) -> Points:
        """(n, orders) array [N m] - complex amplitudes of the torques, order k/turns a revolution, from 0."""
        found: Points = np.fft.rfft(self.torques, axis=1) * (2.0 / self.torques.shape[1])
        found[:, 0] *= 0.5
        return found

    @cached_property
    def orders(self) -> Reals:
        """Cycles a revolution of the main shaft."""
        return np.arange(self.amplitudes.shape[1]) / self.turns

    @cached_property
    def angles(self) -> Reals:
        """(n, N) array [rad] - of the discs against an even turning in which the first one is on the mean at 0."""
        swung = np.zeros_like(self.amplitudes)
        swung[:, 1:] = self.chain.swing(self.amplitudes[:, 1:], self.orders[1:] * self.speed)
        mean = self.chain.wind_up(self.amplitudes[:, 0].real)
        count = self.torques.shape[1]
        swung[:, 1:] *= 0.5 * count
        return np.asarray(np.fft.irfft(swung, count, axis=1)) + mean[:, None]

    @cached_property
    def twist(self) -> Reals:
        """(n, N) array [rad] - how far each disc leads the first one, its wind-up."""
        return np.asarray(self.angles - self.angles[0])
