"""Stress on the edge of a plane elastic body that is its own mirror image, by a boundary integral.

First fundamental problem of plane elasticity, the equation of Sherman and Lauricella over the closed contour L,
counter-clockwise, with th = arg(tau - t):

    omega(t) + (1/pi) Int_L [omega(tau) - e^(2 i th) conj omega(tau)] d th = f(t),   f = i Int (X + i Y) ds
    phi(t) = omega(t) + 1/(2 pi i) Int (omega(tau) - omega(t))/(tau - t) d tau,   sigma_t + sigma_n = 4 Re phi'(t)

The body is mirrored at the y axis: its right half gives two real systems of half size, for loads that mirror and for
those that mirror with the other sign. A turn of the whole body, omega = i z, bears no stress: the second system is
freed of it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Points, Reals

ORDER = 8
"""Gauss nodes of a panel."""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(ORDER)
_POWERS = np.vander(NODES, ORDER, increasing=True)
DERIVATIVE = np.vander(NODES, ORDER, increasing=True)[:, : ORDER - 1] * np.arange(1, ORDER) @ np.linalg.inv(_POWERS)[1:]
"""Values at the nodes of a panel to those of the derivative on [-1, 1]."""
_RAISED = (NODES[:, None] ** np.arange(1, ORDER + 1) - (-1.0) ** np.arange(1, ORDER + 1)) / np.arange(1, ORDER + 1)
INTEGRAL = _RAISED @ np.linalg.inv(_POWERS)
"""Values at the nodes of a panel to those of the integral from its beginning."""


@dataclass(frozen=True)
class HalfContour:
    """The right half of a mirrored contour, from the y axis counter-clockwise to the y axis.

    Parameters
        points : (P, 8) complex array - Gauss nodes of its panels, in order
    """

    points: Points

    @cached_property
    def rates(self) -> Points:
        """Derivatives by the place on each panel, -1 to 1."""
        return self.points @ DERIVATIVE.T

    @cached_property
    def steps(self) -> Points:
        """d tau of each node: derivative times weight."""
        return self.rates * WEIGHTS

    @cached_property
    def lengths(self) -> Reals:
        """ds of each node."""
        return np.abs(self.steps)

    @cached_property
    def _half_bends(self) -> Reals:
        """Limit of d th where tau = t: half the curvature times ds."""
        bent = self.rates @ DERIVATIVE.T
        found: Reals = (bent * self.rates.conj()).imag / (2.0 * np.abs(self.rates) ** 2) * WEIGHTS
        return found

    @cached_property
    def _kernels(self) -> tuple[Points, Points]:
        """What multiplies omega and conj omega of the right half, at mirrored loads and at the others: P_R, Q_R first,
        then what the left half adds."""
        own, steps = self.points.ravel(), self.steps.ravel()
        right = own[None, :] - own[:, None]
        np.fill_diagonal(right, 1.0)
        turned = (steps[None, :] / right).imag
        turned[np.diag_indices_from(turned)] = self._half_bends.ravel()
        double = right / right.conj()
        rates = self.rates.ravel()
        double[np.diag_indices_from(double)] = rates / rates.conj()
        left = -own.conj()[None, :] - own[:, None]
        beside = (steps.conj()[None, :] / left).imag  # the left half runs the other way: d tau is conj(d tau)
        crossed = left / left.conj() * beside
        direct, conjugate = np.stack((turned, beside)) / np.pi, np.stack((-double * turned, -crossed)) / np.pi
        return direct.astype(complex), conjugate.astype(complex)

    def solved(self, mirrored: Points, other: Points) -> tuple[Points, Points]:
        """omega of the right half under loads that mirror, f(-conj z) = -conj f(z), and under those of the other sign.

        Parameters
            mirrored, other : (P, 8) complex arrays - f at the nodes
        """
        return self._solved(1.0, mirrored), self._solved(-1.0, other)

    def _solved(self, sign: float, loads: Points) -> Points:
        (direct, beside), (conjugate, crossed) = self._kernels
        plain, bar = direct - sign * crossed, conjugate - sign * beside
        plain = plain + np.eye(len(plain))
        first, second = plain + bar, 1j * (plain - bar)
        system = np.block([[first.real, second.real], [first.imag, second.imag]])
        if sign < 0.0:
            turn = 1j * self.points.ravel()
            free = np.concatenate((turn.real, turn.imag))
            system += np.outer(free, free) / (free @ free)
        flat = loads.ravel()
        found = np.linalg.solve(system, np.concatenate((flat.real, flat.imag)))
        return (found[: flat.size] + 1j * found[flat.size :]).reshape(loads.shape)

    def stress_sums(self, sign: float, omega: Points, panels: Sequence[int]) -> Reals:
        """sigma_t + sigma_n at the nodes of some panels of the right half, (len(panels), 8).

        Parameters
            sign : float - 1 of a load that mirrors, -1 of one of the other sign
            omega : (P, 8) complex array - of `solved`
            panels : their numbers
        """
        own, steps, values = self.points.ravel(), self.steps.ravel(), omega.ravel()
        places = (np.asarray(panels)[:, None] * ORDER + np.arange(ORDER)).ravel()
        at, here = own[places], values[places]
        away = own[None, :] - at[:, None]
        away[np.arange(len(places)), places] = 1.0
        differences = (values[None, :] - here[:, None]) / away
        slopes = (omega @ DERIVATIVE.T / self.rates).ravel()
        differences[np.arange(len(places)), places] = slopes[places]
        far = -own.conj()[None, :] - at[:, None]
        mirrored = (-sign * values.conj()[None, :] - here[:, None]) / far
        whole = differences @ steps + mirrored @ steps.conj()
        phi = (here + whole / (2j * np.pi)).reshape(-1, ORDER)
        found: Reals = 4.0 * (phi @ DERIVATIVE.T / self.rates[list(panels)]).real
        return found


def panels(curve: object, breaks: Sequence[float]) -> Points:
    """Gauss nodes of a curve on panels between places of its parameter, (len(breaks) - 1, 8).

    Parameters
        curve : function of an array of the parameter that gives complex points
        breaks : places of the parameter, in the order of the contour
    """
    ends = np.asarray(breaks, dtype=float)
    middle, half = 0.5 * (ends[1:] + ends[:-1]), 0.5 * (ends[1:] - ends[:-1])
    places = middle[:, None] + half[:, None] * NODES
    return np.asarray(curve(places.ravel())).reshape(places.shape)  # type: ignore[operator]
