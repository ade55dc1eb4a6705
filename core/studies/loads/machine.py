"""A machine under its loads at any input angles: torque, reactions, and integrals over its period.

The last few answers are kept, since several results look at the same rows.
"""

from __future__ import annotations

import gc
import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.results import keep, kept
from gearlink.core.mechanism.dynamics import Applied, Force, Mass, Reactions, Reduced, System, Torque, reduced
from gearlink.core.mechanism.friction import LOCKED, LOCKS, Coefficients, SelfLocking, Solution, settled, with_friction
from gearlink.core.mechanism.joints import Coupling, Pin
from gearlink.core.mechanism.links import Mechanism
from gearlink.core.mechanism.motion import Motion
from gearlink.core.mechanism.rates import TURNING_BACK, dot
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots_sweep import zeros_of
from gearlink.core.studies.loads.panels import APART, Panels
from gearlink.core.studies.loads.sources import Sources

TURN = 2.0 * math.pi
_KEPT = 24
_ROWS_KEPT = 100_000
_BLOCK = 4096
_SUMS = ("reduced", "torque")
_made = [0]
"""Rows of links that all machines have computed since the collector was last called for them."""
_FEW = 340
"""Rows at most of what a search looks at on the way; the grids that searches begin with are kept apart from it."""


def free_what_others_kept() -> None:
    """Collect the machines of earlier designs, once what they kept may be much.

    A design and its parts know each other, so only the collector frees them; it counts objects, and a hundred designs
    of some MB each are few objects.
    """
    if _made[0] > _ROWS_KEPT:
        _made[0] = 0
        gc.collect()


@dataclass(frozen=True)
class Machine:
    """Motion, masses and sources of one design.

    Fields
        motion : Motion - of its links
        masses : by link
        gravity : complex [mm/s^2]
        speed : float [rad/s] - of the input, signed, not 0
        turns : int - input turns after which everything repeats
        joints : input angles of a revolution where the machine's own accelerations jump [rad]
        shaft_inertia : float [kg m^2] - of what turns evenly with the input
        more : what acts besides the sources, a spring of the machine's own
        joints_of_period : bool - the joints are those of the whole period
        stroke : float [rad] - of a machine that is looked at over less than a revolution; 0: over its turns
    """

    motion: Motion
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
    kept: dict[tuple[str, bytes], Any] = field(default_factory=dict, init=False, repr=False)
    kept_few: dict[tuple[str, bytes], Any] = field(default_factory=dict, init=False, repr=False)
    kept_last: dict[bytes, tuple[Solution, Reals]] = field(default_factory=dict, init=False, repr=False)
    kept_sums: dict[str, dict[tuple[str, bytes], Any]] = field(default_factory=dict, init=False, repr=False)

    @property
    def period(self) -> float:
        """Input angle after which everything repeats, or of the stroke [rad]."""
        return self.stroke or TURN * self.turns

    def _keep(self, what: str, phi: Reals, make: Callable[[], Any]) -> Any:
        key = what, phi.tobytes()
        kept, most = self.kept if phi.size > _FEW else self.kept_few, _ROWS_KEPT
        if what in _SUMS and phi.size > 2 * _BLOCK:  # a few numbers a row, where links are hundreds
            kept, most = self.kept_sums.setdefault(what, {}), 10 * _ROWS_KEPT
        if key not in kept:
            # The oldest go; of long arrays few are held, so that a table of a million rows does not fill the memory.
            while kept and (len(kept) >= _KEPT or (len(kept) + 1) * phi.size > most):
                del kept[next(iter(kept))]
            kept[key] = make()
        return kept[key]

    def at(self, phi: Reals) -> Mechanism:
        """The links at input angles [rad]."""
        return self.motion.at(phi)

    def applied(self, phi: Reals) -> Applied:
        """What acts from outside there."""
        found: Applied = self._keep("applied", phi, lambda: self._applied(phi))
        return found

    def _applied(self, phi: Reals) -> Applied:
        _made[0] += phi.size
        links = self.at(phi)
        own = () if self.more is None else self.more(links, phi)
        return [*self.sources.at(links, phi, math.copysign(1.0, self.speed)), *own]

    def reduced(self, phi: Reals) -> Reduced:
        """Inertia and load as the input feels them."""
        found: Reduced = self._keep("reduced", phi, lambda: self._reduced(phi))
        return found

    def _reduced(self, phi: Reals) -> Reduced:
        if phi.size <= 2 * _BLOCK:
            return reduced(self.at(phi), self.masses, self.applied(phi), self.gravity, self.shaft_inertia)
        found = Reduced(*np.empty((4, phi.size)))
        for rows, machine in self.by_blocks(phi.size):
            part = machine._reduced(phi[rows])
            for name in ("inertia", "slope", "weight", "applied"):
                getattr(found, name)[rows] = getattr(part, name)
        return found

    def by_blocks(self, rows: int, block: int = _BLOCK) -> Iterator[tuple[slice, Machine]]:
        """Slices of very many rows, and for each the machine with nothing kept, so that it ends with its block."""
        for start in range(0, rows, block):
            made = replace(self, motion=self.motion.anew())
            keep(made, **kept(self, "locking", "breaks"))
            yield slice(start, start + block), made

    def reactions(self, phi: Reals) -> Reactions:
        """All forces between the links at the constant speed.

        Raises
            SelfLocking - where friction locks the machine
        """
        if self.locks:
            raise SelfLocking(LOCKED, key="loads.friction")
        found: Reactions = self._keep("reactions", phi, lambda: self._reactions(phi))
        return found

    def _reactions(self, phi: Reals) -> Reactions:
        if phi.size > _BLOCK:  # for the memory's sake
            return self._by_blocks(phi)
        return with_friction(*self._settled(phi), self.friction, self.speed)

    def parted(
        self, phi: Reals, first: Reals | float = 1.0, second: Reals | float = 0.0
    ) -> tuple[Reactions, Reactions]:
        """Forces at rest, and those of the masses per square of a speed, both without friction: R = R_0 + W^2 R_1.

        Parameters
            phi : (N,) array [rad] - input angles
            first, second : rates of the input by the angle whose speed is W
        Source
            own derivation: the equations of Newton and Euler are linear in W^2
        """
        system = System(self.at(phi), self.masses)
        still = system.right_side(self.applied(phi), self.gravity, 0.0, 0.0)
        rest, swung = system.solve([still, system.right_side((), 0j, first, second)])
        return system.reactions(rest), system.reactions(swung)

    def _settled(self, phi: Reals) -> tuple[Solution, Reals]:
        """The equations solved there; the last answer is kept, since forces and the nearness of locking share it."""
        key = phi.tobytes()
        found = self.kept_last.get(key)
        if found is None:
            found = settled(self.at(phi), self.masses, self.applied(phi), self.gravity, self.speed, self.friction)
            self.kept_last.clear()
            self.kept_last[key] = found
        return found

    def _by_blocks(self, phi: Reals) -> Reactions:
        """The same of many rows; of a block nothing is kept but its forces."""
        torque, unknowns = np.empty(phi.size), dict[str, Reals]()
        for rows, machine in self.by_blocks(phi.size):
            part = machine._reactions(phi[rows])
            torque[rows] = part.torque
            for name, values in part.unknowns.items():
                if name not in unknowns:
                    unknowns[name] = np.empty((len(values), phi.size))
                unknowns[name][:, rows] = values
        return Reactions(unknowns, torque, self.at(phi))

    def torque(self, phi: Reals) -> Reals:
        """Input torque at the constant speed [N m]; with friction, that of the reactions."""
        if self.friction is None:
            return self.reduced(phi).torque(self.speed)
        if phi.size <= 2 * _BLOCK or self.locks:
            return self.reactions(phi).torque
        found: Reals = self._keep("torque", phi, lambda: self._torque_by_blocks(phi))
        return found

    def _torque_by_blocks(self, phi: Reals) -> Reals:
        """The torque alone of many rows, without the links and the forces between them."""
        parts = [machine._reactions(phi[rows]).torque for rows, machine in self.by_blocks(phi.size)]
        return np.concatenate(parts)

    def hold_torque(self, phi: Reals, torque: Reals) -> None:
        """Keep the torque of many rows that was come by with the forces there, so that `torque` need not seek it."""
        if self.friction is not None and phi.size > 2 * _BLOCK:
            self._keep("torque", phi, lambda: torque)

    def load_torque(self, phi: Reals) -> Reals:
        """tau, what the input must hold without accelerating anything [N m]."""
        if self.friction is None:
            return self.reduced(phi).static
        return np.asarray(self.torque(phi) - self.reduced(phi).inertial(self.speed))

    @cached_property
    def locking(self) -> tuple[float, float | None]:
        """How near the friction is to locking the machine, the worst of a row every 5 deg, and its input angle [rad].

        Notes
            Infinite, without an angle, where there are no forces with which it moves.
        """
        assert self.friction is not None, "needed only where there is friction"
        phi = np.linspace(0.0, min(TURN, self.period), 72, endpoint=False)
        try:
            found = self.passes_ratio(phi)
        except SelfLocking:
            return math.inf, None
        return float(found.max()), float(phi[np.argmax(found)])

    def passes_ratio(self, phi: Reals) -> Reals:
        """What a pass of the friction leaves of a change at input angles; from 1 on the machine locks itself.

        Raises
            SelfLocking - where there are no forces with which it moves
        """
        assert self.friction is not None, "needed only where there is friction"
        found, sizes = self._settled(phi)
        return found.rubbing.ratio(sizes)

    def rubbing(self, share: float) -> Machine:
        """The machine with a share of its friction."""
        assert self.friction is not None, "needed only where there is friction"
        return replace(self, friction=self.friction.scaled(share))

    @property
    def locks(self) -> bool:
        """Whether friction locks the machine."""
        return self.friction is not None and self.locking[0] > LOCKS

    # Places where something jumps, and integrals

    @cached_property
    def breaks(self) -> list[float]:
        """Input angles within the period where a force jumps or bends [rad], ascending."""
        found = [*self._given_breaks(), *self._turning_back()]
        apart = APART * float(np.spacing(self.period))
        distinct: list[float] = []
        for angle in sorted(found):
            if (distinct[-1] if distinct else 0.0) + apart < angle < self.period - max(apart, 2.0 * TURNING_BACK):
                distinct.append(angle)
        return distinct

    def _given_breaks(self) -> list[float]:
        """Those of what the file gives, and of the machine's own motion."""
        of_a_turn = self.sources.breaks() if self.joints_of_period else [*self.sources.breaks(), *self.joints]
        found = [turn * TURN + angle % TURN for angle in of_a_turn for turn in range(self.turns)]
        return [*found, *self.joints] if self.joints_of_period else found

    def _turning_back(self) -> list[float]:
        """Where a link with resistance turns back; with friction two links against each other, or where forces do."""
        rates = [self._rate_of(name) for name in self.sources.resisted]
        if self.friction is not None:
            rates += [self._between(i) for i in self.friction.rubbing(self.at(np.zeros(1)))]
        turning = itertools.chain(*zeros_of(rates, self.period, self.turns))
        found = [place - TURNING_BACK for place in turning]  # where `sense_of` has the force jump
        if self.friction is not None and not self.locks:
            # Other forces jump there as well: where that is known, it is not sought by halving.
            jumps = sorted({*found, *self._given_breaks()})
            found += itertools.chain(*zeros_of(self._sides(), self.period, self.turns, jumps=jumps))
        return found

    def _sides(self) -> list[Callable[[Reals], Reals]]:
        """Forces of guides, teeth and rollers, whose friction bends where they change sides."""
        found = [each.name for each in self.at(np.zeros(1)).connections if not isinstance(each, (Pin, Coupling))]
        return [lambda phi, name=name: self.reactions(phi).unknowns[name][0] for name in found]  # type: ignore[misc]

    def _rate_of(self, name: str) -> Callable[[Reals], Reals]:
        def rate(phi: Reals) -> Reals:
            mechanism = self.at(phi)
            link, travel = mechanism.links[name], mechanism.travel.get(name)
            return link.turn.first if travel is None else dot(travel, link.origin.first)

        return rate

    def _between(self, name: str) -> Callable[[Reals], Reals]:
        assert self.friction is not None, "needed only where there is friction"
        friction = self.friction
        return lambda phi: friction.rate(self.at(phi), name)

    @cached_property
    def panels(self) -> Panels:
        """The period in panels between the breaks."""
        return Panels.over(self.period, self.breaks)

    def mean(self, f: Callable[[Reals], Reals]) -> float:
        """Mean over the period of a function of input angles."""
        return self.panels.integral(f(self.panels.nodes)) / self.period
