"""Functions that a linkage shall generate."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals

Name: TypeAlias = Literal["log", "exp", "power", "sine", "cosine", "tangent"]
CIRCULAR = ("sine", "cosine", "tangent")


@dataclass(frozen=True)
class Wanted:
    """psi - psi0 = swing (y(x) - y(x0))/(y(x1) - y(x0)), x = x0 + s (x1 - x0), s the share of the input's swing.

    Parameters
        name : of y(x) - x of the circular functions in rad
        x : (float, float) - x0, x1
        input_swing, output_swing : float [rad] - the output's may be negative
        exponent : float - of a power
    Raises
        NoSolution - where y does not exist all over the interval, or is the same at both ends
    Example
        >>> log = Wanted("log", (1.0, 2.0), 1.0, 0.5 * np.pi)
        >>> log.output(np.array([0.0, 1.0])).round(9).tolist()
        [0.0, 1.570796327]
    """

    name: Name
    x: tuple[float, float]
    input_swing: float
    output_swing: float
    exponent: float = 1.0

    @classmethod
    def of(cls, section: Any) -> Wanted:
        """That of a section of a file, in deg."""
        low, high = (math.radians(each) if section.name in CIRCULAR else each for each in section.x)
        swings = math.radians(section.input_swing), math.radians(section.output_swing)
        return cls(section.name, (low, high), *swings, section.exponent or 1.0)

    def __post_init__(self) -> None:
        s = np.linspace(0.0, 1.0, 721)
        with np.errstate(all="ignore"):
            y = self._y(s)
        least, most = float(np.min(np.abs(np.cos(self._x(s))))), float(np.max(np.abs(y)))
        poles = self.name == "tangent" and (least < 1e-6 or bool(np.any(np.diff(np.sign(np.cos(self._x(s)))) != 0.0)))
        if not np.all(np.isfinite(y)) or poles:
            raise NoSolution(f"{self.name} is not defined everywhere over {self._shown()}", fix="change the interval")
        if abs(float(y[-1] - y[0])) <= 1e-9 * most:
            raise NoSolution(
                f"{self.name} has the same value at both ends of {self._shown()}", fix="change the interval"
            )

    def _shown(self) -> str:
        return f"x = {self.x[0]:g} to {self.x[1]:g}"

    def _x(self, s: Reals) -> Reals:
        return self.x[0] + s * (self.x[1] - self.x[0])

    def _y(self, s: Reals) -> Reals:
        x = self._x(s)
        made: dict[str, Callable[[Reals], Reals]] = {
            "log": np.log,
            "exp": np.exp,
            "power": lambda x: x**self.exponent,
            "sine": np.sin,
            "cosine": np.cos,
            "tangent": np.tan,
        }
        return np.asarray(made[self.name](x))

    def output(self, s: Reals) -> Reals:
        """Output angle from its place at the start, over shares of the input's swing [rad]."""
        low, high = self._y(np.array([0.0, 1.0]))
        return np.asarray(self.output_swing * (self._y(s) - low) / (high - low))
