"""A machine under its loads at any input angles: torque, reactions, and integrals over its period.

The kinematics are computed anew for every array of angles that is asked for; the last few answers are kept, since
several results look at the same rows.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from gearlink.core.loads.dynamics import Applied, Force, Mass, Reactions, Reduced, Torque, reduced
from gearlink.core.loads.friction import Coefficients, passes_ratio, with_friction
from gearlink.core.loads.kinematics import dot
from gearlink.core.loads.mechanism import Mechanism
from gearlink.core.loads.sources import Sources
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.together import Search, together

Kinematics: TypeAlias = Callable[[Reals], Mechanism]
TURN = 2.0 * math.pi
NODES = 16
PANEL = math.radians(10.0)
_STEPS = 150
_KEPT = 24
_ROWS_KEPT = 200_000
_FEW = 340
"""Rows at most of what a search looks at on the way; the grids that searches begin with are kept apart from it."""


@dataclass(frozen=True)
class Machine:
    """Kinematics, masses and sources of one design.

    Fields
        kinematics : function of an array of input angles [rad]
        masses : by link
        sources : Sources
        gravity : complex [m/s^2]
        speed : float [rad/s] - of the input, signed, not 0
        turns : int - input turns after which everything repeats
        friction : Coefficients or None
        joints : input angles of a turn where the machine's own accelerations jump [rad]
        shaft_inertia : float [kg m^2] - of what turns evenly with the input
        more : what acts besides the sources, a spring of the machine's own
        joints_of_period : bool - the joints are those of the whole period
        stroke : float [rad] - of a machine that is looked at over less than a turn; 0: over its turns
    """

    kinematics: Kinematics
    masses: Mapping[str, Mass]
    sources: Sources
    gravity: complex
    speed: float
    turns: int = 1
    friction: Coefficients | None = None
    joints: tuple[float, ...] = ()
    shaft_inertia: float = 0.0
    joints_of_period: bool = False
    stroke: float = 0.0
    more: Callable[[Mechanism, Reals], Sequence[Force | Torque]] | None = None
    kept: dict[tuple[str, bytes], Any] = field(default_factory=dict, repr=False)
    kept_few: dict[tuple[str, bytes], Any] = field(default_factory=dict, repr=False)

    @property
    def period(self) -> float:
        """Input angle after which everything repeats, or of the stroke [rad]."""
        return self.stroke or TURN * self.turns

    def _keep(self, what: str, phi: Reals, make: Callable[[], Any]) -> Any:
        key = what, phi.tobytes()
        kept = self.kept if phi.size > _FEW else self.kept_few
        if key not in kept:
            # The oldest go; of long arrays few are held, so that a table of a million rows does not fill the memory.
            while kept and (len(kept) >= _KEPT or (len(kept) + 1) * phi.size > _ROWS_KEPT):
                del kept[next(iter(kept))]
            kept[key] = make()
        return kept[key]

    def at(self, phi: Reals) -> Mechanism:
        """The links at input angles [rad]."""
        found: Mechanism = self._keep("links", phi, lambda: self.kinematics(phi))
        return found

    def applied(self, phi: Reals) -> Applied:
        """What acts from outside there."""
        found: Applied = self._keep("applied", phi, lambda: self._applied(phi))
        return found

    def _applied(self, phi: Reals) -> Applied:
        links = self.at(phi)
        own = () if self.more is None else self.more(links, phi)
        return [*self.sources.at(links, phi, math.copysign(1.0, self.speed)), *own]

    def reduced(self, phi: Reals) -> Reduced:
        """Inertia and load as the input feels them."""
        found: Reduced = self._keep(
            "reduced",
            phi,
            lambda: reduced(self.at(phi), self.masses, self.applied(phi), self.gravity, self.shaft_inertia),
        )
        return found

    def reactions(self, phi: Reals) -> Reactions:
        """All forces between the links at the constant speed."""
        found: Reactions = self._keep("reactions", phi, lambda: self._reactions(phi))
        return found

    def _reactions(self, phi: Reals) -> Reactions:
        return with_friction(self.at(phi), self.masses, self.applied(phi), self.gravity, self.speed, self.friction)

    def torque(self, phi: Reals) -> Reals:
        """Input torque at the constant speed [N m]; with friction, that of the reactions."""
        return self.reduced(phi).torque(self.speed) if self.friction is None else self.reactions(phi).torque

    def load_torque(self, phi: Reals) -> Reals:
        """tau, what the input must hold without accelerating anything [N m]."""
        if self.friction is None:
            return self.reduced(phi).static
        return np.asarray(self.torque(phi) - self.reduced(phi).inertial(self.speed))

    @property
    def locking_ratio(self) -> float:
        """Change of the second pass of the friction over that of the first, over a turn."""
        assert self.friction is not None, "asked for only where there is friction"
        phi = np.linspace(0.0, min(TURN, self.period), 72, endpoint=False)
        return passes_ratio(self.at(phi), self.masses, self.applied(phi), self.gravity, self.speed, self.friction)

    # Places where something jumps, and integrals

    @cached_property
    def breaks(self) -> list[float]:
        """Input angles within the period where a force jumps or bends [rad], ascending."""
        of_a_turn = self.sources.breaks() if self.joints_of_period else [*self.sources.breaks(), *self.joints]
        found = [turn * TURN + angle % TURN for angle in of_a_turn for turn in range(self.turns)]
        found += self.joints if self.joints_of_period else ()
        found += self._turning_back()
        return sorted({angle for angle in found if 0.0 < angle < self.period})

    def _turning_back(self) -> list[float]:
        """Where a link with resistance, or with friction two links against each other, turn back."""
        found: list[float] = []
        for places in zeros_of(self._jumping_rates(), self.period, self.turns):
            found += places
        return found

    def _jumping_rates(self) -> list[Callable[[Reals], Reals]]:
        rates = [self._rate_of(name) for name in self.sources.resisted]
        if self.friction is not None:
            rates += [self._between(i) for i in self.friction.rubbing(self.at(np.zeros(1)))]
        return rates

    def _rate_of(self, name: str) -> Callable[[Reals], Reals]:
        def rate(phi: Reals) -> Reals:
            mechanism = self.at(phi)
            link, travel = mechanism.links[name], mechanism.travel.get(name)
            return link.turn.first if travel is None else dot(travel, link.origin.first)

        return rate

    def _between(self, name: str) -> Callable[[Reals], Reals]:
        assert self.friction is not None, "asked for only where there is friction"
        friction = self.friction
        return lambda phi: friction.rate(self.at(phi), name)

    @cached_property
    def panels(self) -> Panels:
        """The period in panels between the breaks."""
        return Panels.over(self.period, self.breaks)

    def mean(self, f: Callable[[Reals], Reals]) -> float:
        """Mean over the period of a function of input angles."""
        return self.panels.integral(f(self.panels.nodes)) / self.period


@dataclass(frozen=True)
class Panels:
    """An interval in panels with Gauss nodes.

    Fields
        edges : (n + 1,) array
        nodes : (n * NODES,) array - ascending
        weights : (NODES,) array - of a panel of length 1
    """

    edges: Reals
    nodes: Reals
    weights: Reals

    @classmethod
    def over(cls, period: float, breaks: Sequence[float]) -> Panels:
        """Panels of at most 10 deg between the breaks.

        Notes
            16 Gauss nodes over 10 deg: 1e-13 for a function whose nearest singularity is 5 deg off the real axis, as
            that of a linkage whose transmission angle falls to 5 deg.
        """
        bounds = [0.0, *breaks, period]
        parts = [
            np.linspace(low, high, max(1, math.ceil((high - low) / PANEL - 1e-9)) + 1)[:-1]
            for low, high in itertools.pairwise(bounds)
        ]
        edges = np.append(np.concatenate(parts), period)
        x, weights = np.polynomial.legendre.leggauss(NODES)
        nodes = (edges[:-1, None] + np.diff(edges)[:, None] * (0.5 * (x + 1.0))).ravel()
        return cls(edges, nodes, 0.5 * weights)

    def each(self, values: Reals) -> Reals:
        """Integral over each panel of a function given at the nodes."""
        return np.asarray((values.reshape(-1, NODES) @ self.weights) * np.diff(self.edges))

    def integral(self, values: Reals) -> float:
        """Integral over the whole of a function given at the nodes."""
        return math.fsum(self.each(values).tolist())

    def running(self, values: Reals) -> Reals:
        """Integral from the start to each edge."""
        return np.concatenate(([0.0], np.cumsum(self.each(values))))


def zeros(f: Callable[[Reals], Reals], period: float, turns: int = 1) -> list[float]:
    """Places within a period where a function changes its sign, to the last bits, all at once.

    Notes
        Brackets from 720 rows a turn; a zero that is touched without a change of sign is none.
    """
    return zeros_of([f], period, turns)[0]


def zeros_of(functions: Sequence[Callable[[Reals], Reals]], period: float, turns: int = 1) -> list[list[float]]:
    """The zeros of several functions, searched together."""
    return together(functions, [_zeros(period, turns) for _ in functions])


def _zeros(period: float, turns: int) -> Search[list[float]]:
    grid = np.linspace(0.0, period, 720 * turns + 1)
    values = yield grid
    rows = np.flatnonzero((values[:-1] > 0.0) != (values[1:] > 0.0))
    if rows.size == 0:
        return []
    low, high, f_low, f_high = grid[rows], grid[rows + 1], values[rows], values[rows + 1]
    up, last = f_high > 0.0, low
    for step in range(_STEPS):
        # Illinois' false position, halved every third time, so that a jump is found as well.
        share = f_low / (f_low - f_high) if step % 3 else np.full_like(low, 0.5)
        place = low + (high - low) * np.clip(np.nan_to_num(share, nan=0.5), 0.0, 1.0)
        value = yield place
        after = (value > 0.0) == up
        f_high = np.where(after, value, 0.5 * f_high)
        f_low = np.where(after, 0.5 * f_low, value)
        low, high = np.where(after, low, place), np.where(after, place, high)
        near = 4.0 * np.spacing(period)
        if step % 3 and np.all((np.abs(place - last) <= near) | (high - low <= near)):
            break
        last = place
    return [float(each) for each in last]
