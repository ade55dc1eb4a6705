"""Curves as chords or as interpolating cubics, refined until the distance from the curve is within a tolerance.

The distance is measured against the kernel's curve between all nodes, never estimated from a formula, and the
greatest that is left is reported.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlink.cli.export.options import CurveForm
from gearlink.core.errors import GearlinkError

Points = NDArray[np.complex128]
Reals = NDArray[np.float64]

MOST_POINTS = 100_000
"""Points of a curve in a file at most; a gear of a thousand teeth needs 40,000 for a chord error of 0.001 module."""

_PROBES = 8  # parts of a step at whose ends the distance is measured
_UNSEEN = 1e-4  # share by which the greatest distance may pass the parabola's vertex; 4e-5 was seen
_LEAST_CUBIC_STEPS = 4  # one more than a cubic without given end slopes needs


class TooFine(GearlinkError):
    """The tolerance asks for more points than a file should hold."""

    def __init__(self, tolerance: float, remedy: str = "raise --tolerance") -> None:
        super().__init__(f"a tolerance of {tolerance:g} mm needs more than {MOST_POINTS} points: {remedy}")


@dataclass(frozen=True)
class Stretch:
    """Curves that are smooth over one common parameter.

    Parameters
        layers : names of the curves
        points : function of the parameter (N,) - gives the curves as a (curves, N) complex array [mm]
        low, high : float - range of the parameter
        name : str - what the stretch is called
        extra : function of the parameter or None - further columns of a table, (columns, N)
        steps : int - into which the range is divided before the first measurement
    """

    layers: tuple[str, ...]
    points: Callable[[Reals], Points]
    low: float
    high: float
    name: str = ""
    extra: Callable[[Reals], Reals] | None = None
    steps: int = 8


@dataclass(frozen=True)
class Sampled:
    """A stretch as nodes; of a spline also knots and control points.

    Attributes
        nodes : (curves, N) complex array [mm]
        parameter : (N,) array - of the nodes
        error : float [mm] - greatest distance between the curve and its chords or cubics
        knots, control : (N + 4,), (curves, N) arrays - of the cubic B-splines; empty for chords
    """

    stretch: Stretch
    parameter: Reals
    nodes: Points
    error: float
    knots: Reals
    control: Points

    def turned(self, unit: complex) -> Sampled:
        """The same, turned about the origin."""
        return replace(self, nodes=unit * self.nodes, control=unit * self.control)

    def mirrored(self) -> Sampled:
        """The mirror image about the x axis, run through backwards."""
        back = self.backwards()
        return replace(back, nodes=back.nodes.conj(), control=back.control.conj())

    def backwards(self) -> Sampled:
        """The same, run through backwards."""
        return replace(
            self,
            parameter=self.parameter[::-1],
            nodes=self.nodes[:, ::-1],
            control=self.control[:, ::-1],
            knots=(self.knots[-1] - self.knots)[::-1] if self.knots.size else self.knots,
        )


def sample(stretch: Stretch, tolerance: float, form: CurveForm, most: int = MOST_POINTS) -> Sampled:
    """Nodes of a stretch such that chords or cubics stay within the tolerance of every curve.

    Parameters
        stretch : Stretch
        tolerance : float [mm] - greatest distance
        form : CurveForm
        most : int - greatest number of nodes
    Returns
        sampled : Sampled
    Raises
        TooFine - where that many nodes do not do
    Notes
        Steps that are too long are halved, so that nodes lie dense only where the curve bends. The distance is
        measured at seven places of each step, and the vertex of the parabola through the greatest and its
        neighbours is added. Of a spline it is the distance at equal parameter, never less than that of the curves.
    """
    spline = form is CurveForm.SPLINE
    steps = max(stretch.steps, _LEAST_CUBIC_STEPS) if spline else stretch.steps
    parameter = np.linspace(stretch.low, stretch.high, steps + 1)
    while True:
        fine = _between(parameter)
        points = stretch.points(fine)
        nodes = points[:, ::_PROBES]
        cubic = _cubic(parameter, nodes) if spline else None
        off = _from_chords(points) if cubic is None else np.abs(_values(cubic(fine)) - points)
        worst = _peaks(off) * (1.0 + _UNSEEN)
        wide = worst > tolerance
        if not wide.any():
            break
        if parameter.size + int(wide.sum()) > most:
            raise TooFine(tolerance)
        middles = 0.5 * (parameter[:-1] + parameter[1:])[wide]
        parameter = np.sort(np.concatenate([parameter, middles]))
    knots, control = np.empty(0), np.empty((len(nodes), 0), np.complex128)
    if cubic is not None:
        knots, control = cubic.t, _values(cubic.c)
        control[:, 0], control[:, -1] = nodes[:, 0], nodes[:, -1]
    return Sampled(stretch, parameter, nodes, float(worst.max()), knots, control)


def _between(parameter: Reals) -> Reals:
    """The nodes and seven places between each two of them."""
    share = np.arange(_PROBES) / _PROBES
    steps = parameter[:-1, None] + np.diff(parameter)[:, None] * share
    return np.append(steps.ravel(), parameter[-1])


def _from_chords(points: Points) -> Reals:
    """Distance of each point from the chord of its step."""
    start, end = points[:, :-1:_PROBES, None], points[:, _PROBES::_PROBES, None]
    chord = end - start
    square = np.abs(chord) ** 2
    way = points[:, :-1].reshape(*start.shape[:2], _PROBES) - start
    along = np.real(way * chord.conj()) / np.where(square == 0.0, 1.0, square)
    off = np.abs(way - np.clip(along, 0.0, 1.0) * chord)
    return np.concatenate([off.reshape(len(points), -1), np.zeros((len(points), 1))], axis=1)


def _peaks(off: Reals) -> Reals:
    """Greatest distance in each step over all curves: the greatest probe, or the parabola's vertex beside it."""
    steps = off[:, :-1].reshape(len(off), -1, _PROBES)
    following = np.concatenate([steps[:, 1:, :1], np.broadcast_to(off[:, -1:, None], (len(off), 1, 1))], axis=1)
    probes = np.concatenate([steps, following], axis=2)
    place = np.argmax(probes[:, :, 1:-1], axis=2)[..., None] + 1
    left, top, right = (np.take_along_axis(probes, place + shift, axis=2)[..., 0] for shift in (-1, 0, 1))
    bend = 2.0 * top - left - right
    rise = np.divide((right - left) ** 2, 8.0 * bend, out=np.zeros_like(top), where=bend > 0.0)
    worst: Reals = (top + np.minimum(rise, top)).max(axis=0)
    return worst


def _cubic(parameter: Reals, nodes: Points) -> Any:
    """Cubic B-spline through the nodes of all curves; its columns are x and y of each."""
    from scipy.interpolate import make_interp_spline

    columns = np.concatenate([nodes.real, nodes.imag]).T
    return make_interp_spline(parameter, columns, k=3)


def _values(columns: Reals) -> Points:
    """Columns of x and y back to complex curves."""
    curves = columns.shape[1] // 2
    values: Points = (columns[:, :curves] + 1j * columns[:, curves:]).T
    return values
