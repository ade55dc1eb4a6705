"""The design charts that `gearlink chart` knows: axes, curve parameters, defaults, and where a design lies in them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Quantity, Table

_CURVES = Callable[[Any, Any], Any]


@dataclass(frozen=True, slots=True)
class Axis:
    """A quantity along an axis, or the one that tells the curves apart."""

    name: str
    unit: str
    words: str
    symbol: str


@dataclass(frozen=True, slots=True)
class Marked:
    """A design in a chart: its name and place, and how far its links are from those of the family."""

    name: str
    place: tuple[float, float]
    quantities: tuple[Quantity, ...]
    off_family: float


@dataclass(frozen=True)
class DesignChart:
    """A chart: `function` of a module in `gearlink.core` gives y over x, one curve per parameter.

    `peaked` : its curves come to a point, which lies between the rows of a table
    """

    name: str
    title: str
    source: str
    function: str
    x: Axis
    y: Axis
    parameter: Axis | None
    range: tuple[float, float]
    curves: tuple[float, ...] = ()
    module: str = "machines.three_gear.charts"
    kind: str = "three-gear-four-bar"
    peaked: bool = False
    given: tuple[tuple[str, float], ...] = ()
    """Names and values of the other arguments of the function, by the options of the command."""

    def values(self, x: Any, parameter: float | None) -> Any:
        """A curve of the chart, in the units of its axes."""
        import numpy as np

        function: Callable[..., Any] = getattr(import_module(f"gearlink.core.{self.module}"), self.function)
        if self.parameter is None or parameter is None:
            return function(x, **dict(self.given))
        x = np.radians(x) if self.x.unit == "deg" else x
        y = function(x, math.radians(parameter) if self.parameter.unit == "deg" else parameter, **dict(self.given))
        return np.degrees(y) if self.y.unit == "deg" else y

    def table(self, low: float, high: float, curves: Sequence[float], samples: int) -> Table:
        """x and a column per curve.

        Raises
            NoSolution - where the chart does not reach
        """
        import numpy as np

        x = np.linspace(low, high, samples)
        found = [self.values(x, parameter) for parameter in (curves or (None,))]
        if all(bool(np.all(np.isnan(column))) for column in found):
            raise NoSolution(f"the chart {self.name} has no values there", fix="widen the range, or use other curves")
        units = self.x.unit, *(self.y.unit for _ in found)
        return Table(self.name, (self.x.name, *self.columns(curves)), units, (x, *found))

    def columns(self, curves: Sequence[float]) -> list[str]:
        """The name of each curve's column."""
        if self.parameter is None:
            return [self.y.name]
        symbol = _SYMBOLS.get(self.parameter.name) or term(self.parameter.name).symbol
        return [f"{self.y.name}({symbol}={value:g})" for value in curves]

    def place(self, design: Any) -> tuple[float, float] | None:
        """Where a design lies; None where it has no such quantity (an output that never steps back, no tolerance)."""
        found = [_of(design, axis) for axis in (self.x, self.y)]
        return None if None in found else (found[0], found[1])  # type: ignore[return-value]


def _of(design: Any, axis: Axis) -> float | None:
    if axis.name == "swing":
        return float(design.spec.swing)
    if axis.name == "curvature_ratio":
        return float(design.middle_radius_estimate / design.cam.max_radius)
    if axis.name in _BY_QUANTITY:
        found = design.quantity(axis.name)
        return None if found is None else float(found.value)
    if axis.name == "dwell_tolerance":
        band = design.output_tolerance
        return None if band is None else math.degrees(band)
    if axis.name == "speed_swing_share":
        return float(design.frame_ratio / (design.frame_ratio**2 + 1.0))
    value: float | None = getattr(design, axis.name)
    if value is None:
        return 0.0 if design.motion == "momentary-dwell" else None
    return math.degrees(value) if axis.unit == "deg" else float(value)


def _axis(name: str, words: str, symbol: str) -> Axis:
    return Axis(name, term(name).unit, words, symbol)


_SYMBOLS = {"pivot_ratio": "lambda", "cycle_angle": "phi"}
_BY_QUANTITY = ("tolerance_dwell_angle", "velocity_peak", "acceleration_peak", "energy_parameter")
_WINDOW = _axis("tolerance_dwell_angle", "crank angle of the dwell", r"$\varphi_{tol}$")
_BAND = _axis("dwell_tolerance", "tolerance ±", r"$\tau$")
_SWING = Axis("swing", "deg", "swing", r"$\gamma$")
_PIVOT = Axis("pivot_ratio", "1", "pivot distance over arm", r"$\lambda$")
_LAMBDAS = (1.5, 2.0, 2.5, 3.0, 4.0, 6.0)
_OF_SWING = ("machines.wide_swing.charts", "wide-swing-cam")


def _of_law(quantity: str, words: str, symbol: str) -> DesignChart:
    """A chart of the unloading law over the swing."""
    name, title = quantity.replace("_", "-"), f"{words.capitalize()} of the unloading law"
    source, y = "wide-swing dissertation, chapter 2, (8), (10), (9)", _axis(quantity, words, symbol)
    return DesignChart(name, title, source, quantity, _SWING, y, _PIVOT, (30.0, 300.0), _LAMBDAS, *_OF_SWING)


def _of_dwell(name: str, title: str, x: Axis, parameter: Axis, *ends: tuple[float, ...], **more: Any) -> DesignChart:
    """A chart of the dwell within a tolerance."""
    (low, high), curves = ends
    function = f"window_over_{name.removeprefix('dwell-')}"
    return DesignChart(name, title, "own derivation", function, x, _WINDOW, parameter, (low, high), curves, **more)


_I3 = _axis("i3", "gear ratio", "$i_3 = -z_3/z_5$")
_D = _axis("frame_ratio", "frame/crank", "$d$")
_PHI12 = _axis("back_step_crank_angle", "crank angle of the back-step", r"$\varphi_{12}$")
_DELTA = _axis("nonuniformity", "nonuniformity", r"$\delta$")

CHARTS: dict[str, DesignChart] = {
    chart.name: chart
    for chart in (
        DesignChart(
            "frame-ratio",
            "Frame ratio over gear ratio at constant crank angle of the back-step",
            "thesis (4-18)",
            "frame_ratio_at_crank_angle",
            _I3,
            _D,
            _PHI12,
            (-5.0, -0.5),
            (0.0, 30.0, 60.0, 90.0, 120.0),
        ),
        DesignChart(
            "back-step",
            "Back-step over gear ratio at constant crank angle of the back-step",
            "thesis (4-19), figure 4-5",
            "back_step_at_crank_angle",
            _I3,
            _axis("back_step_angle", "back-step of the output", r"$|\varphi_5(2)-\varphi_5(1)|$"),
            _PHI12,
            (-5.0, -0.5),
            (30.0, 60.0, 80.0, 90.0, 100.0, 120.0),
        ),
        DesignChart(
            "speed-swing",
            "Influence of the frame ratio on the variation of the output speed",
            "thesis (4-13), figure 4-4",
            "speed_swing_share",
            _D,
            Axis("speed_swing_share", "1", "influence of the frame ratio", "$y = d/(d^2+1)$"),
            None,
            (1.0, 10.0),
        ),
        DesignChart(
            "nonuniformity",
            "Frame ratio over gear ratio at constant nonuniformity",
            "thesis (4-20), figure 4-6",
            "frame_ratio_at_nonuniformity",
            _I3,
            _D,
            _DELTA,
            (-5.0, -0.5),
            (0.4, 0.5, 1.0, 1.6, 2.0),
        ),
        _of_dwell(
            "dwell-ratio",
            "Longest dwell within a tolerance over gear ratio",
            _I3,
            _BAND,
            (-5.0, -0.5),
            (0.1, 0.25, 0.5, 1.0, 2.0),
        ),
        _of_dwell(
            "dwell-tolerance",
            "Longest dwell over its tolerance at constant gear ratio",
            _BAND,
            _I3,
            (0.02, 5.0),
            (-5.0, -2.0, -1.0, -0.5),
        ),
        _of_dwell(
            "dwell-frame",
            "Dwell within ±0.5° over frame ratio at constant gear ratio",
            _D,
            _I3,
            (2.5, 7.0),
            (-2.4, -1.8, -1.3),
            peaked=True,
        ),
        _of_law("velocity_peak", "peak velocity", "$B$"),
        _of_law("acceleration_peak", "peak acceleration", "$C$"),
        _of_law("energy_parameter", "energy parameter", "$N$"),
        DesignChart(
            "curvature-ratio",
            "Minimum curvature radius of an internal profile over its maximum radius",
            "wide-swing dissertation, figure 6, (27)",
            "curvature_ratio",
            _SWING,
            Axis("curvature_ratio", "1", "curvature radius (27) over maximum radius", r"$R/\rho_{max}$"),
            Axis("cycle_angle", "deg", "cam angle of the stroke", r"$\varphi$"),
            (40.0, 300.0),
            (40.0, 60.0, 80.0, 100.0, 120.0),
            *_OF_SWING,
        ),
    )
}

OF_FILES = {
    "residual": ("Residual vibration over the speed, of the laws of a file and of usual laws", "own derivation")
}
"""Charts that a design file alone has: title and source."""
