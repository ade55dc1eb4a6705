"""The design charts that `gearlink chart` knows: axes, curve parameters, defaults, and where a design lies in them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.core.nomenclature import term
from gearlink.core.report import Table

if TYPE_CHECKING:
    from gearlink.core.three_gear.design import ThreeGearFourBar

_CURVES = Callable[[Any, Any], Any]


@dataclass(frozen=True, slots=True)
class Axis:
    """A quantity along an axis, or the one that tells the curves apart."""

    name: str
    unit: str
    words: str
    symbol: str


@dataclass(frozen=True)
class DesignChart:
    """A chart: `function` in `gearlink.core.three_gear.charts` gives y over x, one curve per parameter."""

    name: str
    title: str
    source: str
    function: str
    x: Axis
    y: Axis
    parameter: Axis | None
    range: tuple[float, float]
    curves: tuple[float, ...] = ()

    def values(self, x: Any, parameter: float | None) -> Any:
        """A curve of the chart, in the units of its axes."""
        import numpy as np

        from gearlink.core.three_gear import charts

        function: Callable[..., Any] = getattr(charts, self.function)
        if self.parameter is None or parameter is None:
            return function(x)
        y = function(x, math.radians(parameter) if self.parameter.unit == "deg" else parameter)
        return np.degrees(y) if self.y.unit == "deg" else y

    def table(self, low: float, high: float, curves: Sequence[float], samples: int) -> Table:
        """x and a column per curve.

        Raises
            NoSolution - where the chart does not reach
        """
        import numpy as np

        x = np.linspace(low, high, samples)
        found = [self.values(x, parameter) for parameter in (curves or (None,))]
        return Table(
            self.name,
            (self.x.name, *self.columns(curves)),
            (self.x.unit, *(self.y.unit for _ in found)),
            (x, *found),
        )

    def columns(self, curves: Sequence[float]) -> list[str]:
        """The name of each curve's column."""
        if self.parameter is None:
            return [self.y.name]
        symbol = term(self.parameter.name).symbol
        return [f"{self.y.name}({symbol}={value:g})" for value in curves]

    def place(self, design: ThreeGearFourBar) -> tuple[float, float] | None:
        """Where a design lies; None where it has no such quantity (an output that never steps back)."""
        found = [_of(design, axis) for axis in (self.x, self.y)]
        return None if None in found else (found[0], found[1])  # type: ignore[return-value]


def _of(design: ThreeGearFourBar, axis: Axis) -> float | None:
    if axis.name == "speed_swing_share":
        return design.frame_ratio / (design.frame_ratio**2 + 1.0)
    value: float | None = getattr(design, axis.name)
    if value is None:
        return 0.0 if design.motion == "momentary-dwell" else None
    return math.degrees(value) if axis.unit == "deg" else value


def _axis(name: str, words: str, symbol: str) -> Axis:
    return Axis(name, term(name).unit, words, symbol)


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
            "Share of the frame ratio in the swing of the output speed",
            "thesis (4-13), figure 4-4",
            "speed_swing_share",
            _D,
            Axis("speed_swing_share", "1", "share of the frame ratio", "$y = d/(d^2+1)$"),
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
    )
}
