"""Curves as chords or as interpolating cubics, refined until the distance from the curve is within a tolerance.

The distance is measured against the kernel's curve between all nodes, never estimated from a formula, and the
maximum that is left is reported.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlink.cli.export.options import CurveForm
from gearlink.core.base.errors import GearlinkError
from gearlink.core.numerics.arrays import Points, Reals

MOST_POINTS = 100_000
"""Points of a file at most, of all its curves; a gear of a thousand teeth has 40,000 for chords within 0.001 module."""

_PROBES = 8  # parts of a step at whose ends the distance is measured
_SHARES = np.arange(_PROBES + 1) / _PROBES
_UNSEEN = 9e-5  # share by which the maximum distance may pass what probes tell of it; 4e-5 was seen
_CUBIC = 1.0 / math.sqrt(243.0)  # maximum of (x - x^3)/6 on [0, 1]: a cubic over its parabola, per third difference
_TELLING = 500  # steps to be halved from which on they tell how many nodes there will be
_FORESEEN = 16.0  # parts of a step at most that are foretold: beside a corner it needs fewer than by the rule
_FEWER = 1.2  # times fewer nodes than by the rule, at most
_LEAST_CUBIC_STEPS = 4  # one more than a cubic without given end slopes needs


class TooFine(GearlinkError):
    """The tolerance asks for more points than a file should hold."""

    def __init__(self, tolerance: float, remedy: str = "increase --tolerance") -> None:
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
        error : float [mm] - maximum distance between the curve and its chords or cubics
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
        nodes, control = self.nodes[:, ::-1], self.control[:, ::-1]
        knots = (self.knots[-1] - self.knots)[::-1] if self.knots.size else self.knots
        return replace(self, parameter=self.parameter[::-1], nodes=nodes, control=control, knots=knots)


def sample(stretch: Stretch, tolerance: float, form: CurveForm, most: int = MOST_POINTS) -> Sampled:
    """Nodes of a stretch such that chords or cubics stay within the tolerance of every curve.

    Parameters
        tolerance : float [mm] - maximum distance
        most : int - maximum number of nodes of all curves
    Raises
        TooFine - where that many nodes do not do
    Notes
        Steps that are too long are halved, so that nodes lie dense only where the curve bends; what is known of the
        curve is kept. The distance is measured at seven places of each step, and the vertex of the parabola through
        the maximum and its neighbours is added, with what the third difference there tells. Of a spline it is the
        distance at equal parameter, never less than that of the curves.
    """
    spline = form is CurveForm.SPLINE
    steps = max(stretch.steps, _LEAST_CUBIC_STEPS) if spline else stretch.steps
    ends = np.linspace(stretch.low, stretch.high, steps + 1)
    probes = ends[:-1, None] + np.diff(ends)[:, None] * _SHARES
    probes[:, -1] = ends[1:]
    points = _in_steps(stretch.points(np.append(probes[:, :-1], ends[-1])))
    while True:
        parameter, nodes = np.append(probes[:, 0], probes[-1, -1]), _nodes(points)
        cubic = _cubic(parameter, nodes) if spline else None
        if cubic is None:
            off = _from_chords(points)
        else:  # of each point from that of the cubic at the same parameter
            off = np.abs(_values(cubic(probes.ravel())).reshape(points.shape) - points)
        worst = _peaks(off) * (1.0 + _UNSEEN)
        wide = worst > tolerance
        if not wide.any():
            break
        if len(nodes) * (parameter.size + _splits(worst, tolerance, spline)) > most:
            raise TooFine(tolerance)
        between = 0.5 * (probes[wide, :-1] + probes[wide, 1:])
        found = stretch.points(between.ravel()).reshape(len(nodes), *between.shape)
        probes, points = _halved(probes[None], between[None], wide)[0], _halved(points, found, wide)
    knots, control = np.empty(0), np.empty((len(nodes), 0), np.complex128)
    if cubic is not None:
        knots, control = cubic.t, _values(cubic.c)
        control[:, 0], control[:, -1] = nodes[:, 0], nodes[:, -1]
    return Sampled(stretch, parameter, nodes, float(worst.max()), knots, control)


def _splits(worst: Reals, tolerance: float, spline: bool) -> float:
    """How many nodes more steps of these errors need at least: halving quarters the error of a chord, and leaves a
    sixteenth of a cubic's. So a curve far too long is refused before it has been sampled."""
    wide = worst[worst > tolerance]
    if wide.size < _TELLING:
        return wide.size
    pieces = (wide / tolerance) ** (0.25 if spline else 0.5)
    return max(wide.size, float(np.sum(np.minimum(pieces, _FORESEEN) - 1.0)) / _FEWER)


def _in_steps(points: Points) -> Points:
    """Points of curves, the end of a step being the start of the next, as (curves, steps, probes)."""
    starts = points[:, :-1].reshape(len(points), -1, _PROBES)
    ends = np.append(starts[:, 1:, :1], points[:, None, -1:], axis=1)
    return np.concatenate([starts, ends], axis=2)


def _halved(rows: Any, between: Any, wide: NDArray[np.bool_]) -> Any:
    """What is known at the probes of steps, (..., steps, probes), after some of these were halved: `between` is what is
    known of them in the middle of each two probes."""
    both = np.empty((*between.shape[:-1], 2 * _PROBES + 1), rows.dtype)
    both[..., ::2], both[..., 1::2] = rows[..., wide, :], between
    halved = np.repeat(rows, 1 + wide, axis=-2)
    first = np.flatnonzero(wide) + np.arange(np.count_nonzero(wide))
    halved[..., first, :], halved[..., first + 1, :] = both[..., : _PROBES + 1], both[..., _PROBES:]
    return halved


def _nodes(points: Points) -> Points:
    """The ends of the steps."""
    return np.append(points[:, :, 0], points[:, -1:, -1], axis=1)


def _from_chords(points: Points) -> Reals:
    """Distance of each point from the chord of its step."""
    start = points[:, :, :1]
    chord = points[:, :, -1:] - start
    square = np.abs(chord) ** 2
    way = points - start
    along = np.real(way * chord.conj()) / np.where(square == 0.0, 1.0, square)
    off: Reals = np.abs(way - np.clip(along, 0.0, 1.0) * chord)
    return off


def _peaks(probes: Reals) -> Reals:
    """Maximum distance in each step over all curves: the parabola's vertex beside the maximum probe, and what a cubic
    through one probe more can stand above that parabola."""
    place = np.argmax(probes[:, :, 1:-1], axis=2)[..., None] + 1
    left, top, right = (np.take_along_axis(probes, place + shift, axis=2)[..., 0] for shift in (-1, 0, 1))
    bend = 2.0 * top - left - right
    rise = np.divide((right - left) ** 2, 8.0 * bend, out=np.zeros_like(top), where=bend > 0.0)
    windows = np.lib.stride_tricks.sliding_window_view(probes, 4, axis=2)
    cubic = np.abs(windows @ np.array([-1.0, 3.0, -3.0, 1.0]))
    near = [np.take_along_axis(cubic, np.minimum(np.maximum(place - back, 0), _PROBES - 3), axis=2) for back in (1, 2)]
    worst: Reals = (top + np.minimum(rise, top) + _CUBIC * np.maximum(*near)[..., 0]).max(axis=0)
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
