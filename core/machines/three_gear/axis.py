"""The three-gear four-bar over arrays of designs: `base.design_axis` for its syntheses in closed form and its analysis.

Whatever a study asks for beside that (a synthesis for a window within a tolerance, a play, rings, gears with teeth of
their own, quantities of other commands) is left to the design classes.

The idler of many is that of `synthesis.smallest_idler`. In the symmetric family the idlers that keep the limits are all
from some number of teeth on, so they are halved; for other tasks they are tried from 17 up. In both, designs whose
idler is found drop out. The family's frame ratio d rises with n = 1 - i3: d = sc + sqrt(sc^2 + 1),
sc = sqrt(n^2 - 1) cos(h), where h stands or falls with n (a speed band gives d = q + sqrt(q^2 - 1) with q in proportion
to n). The least transmission angle follows d alone, (d - 1)/sqrt(2 (1 + d^2)) = sin(gamma/2), and rises; so does frame
less crank, b sqrt(2) (d - 1)/sqrt(1 + d^2).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.design_axis import Evaluated, kept_inside
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.three_gear.batch import (
    LIMITS,
    SHAFTS,
    TEETH,
    Analysis,
    BackSteps,
    Batch,
    Dwells,
    Momentary,
    Speeds,
    Tried,
    Windows,
)
from gearlink.core.machines.three_gear.design import MESHES
from gearlink.core.machines.three_gear.synthesis import GREATEST_IDLER, LEAST_IDLER
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.gears.train.unshifted import MOST_TEETH, UnshiftedMeshes

_TASKS: dict[str, tuple[str, type[Batch]]] = {
    "synth dwell": ("dwell", Dwells),
    "synth back-step": ("back_step", BackSteps),
    "synth variable-speed": ("speed", Speeds),
    "synth momentary-dwell": ("momentary", Momentary),
    "analyze": ("links", Analysis),
}
_CHECKS = (
    *("undercut", "tip-thickness", "contact-ratio", "involute-interference", "root-clearance", "sliding", "tooth-form"),
    *("gear-collision", "shaft-clearance", "shaft-seat", "transmission-angle", "rounded-ratio", "dwell-tolerance"),
    *("tip-fouling", "ring-tips"),  # of rings, which are left to the class
)
"""Names of the checks that are judged here, and of those that find nothing on the designs that are served."""
_CHECKS_OF = {
    "synth dwell": ("back-step", "dwell-window", "dwell-edge"),
    "synth back-step": ("back-step-target",),
    "synth variable-speed": (),
    "synth momentary-dwell": (),
    "analyze": ("dwell-window",),
}
"""Those of a task in addition."""
_DOMAIN = {path: (1.0, float(MOST_TEETH), 20.0) for path in TEETH} | {
    "gears.module": (1e-6, 1e6, 1.0),
    "dwell_tolerance": (1e-6, 360.0, 1.0),
    "dwell_window": (1e-6, 360.0, 1.0),
}
"""Minimum and maximum value that is computed here, not by the class, and one between that stands in for others."""
_PLACED = ("crank", "frame", "balanced")
_OTHERS = {
    "dwell": (*_PLACED, "window", "tolerance", "margin"),
    "back_step": _PLACED,
    "speed": (*_PLACED, "uniform_angle", "uniform_tolerance"),
    "momentary": ("frame", "gap", "balanced"),
    "links": (),
}


def axis(
    spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str], checks: Sequence[str]
) -> ThreeGearAxis | None:
    """The array form of a study of three-gear four-bars; None where the design classes have to serve.

    Parameters
        spec, command, paths, quantities, checks : as of `core.base.design_axis.Maker`
    """
    if command not in _TASKS or not set(checks) <= {*_CHECKS, *_CHECKS_OF[command]}:
        return None
    if not _served(spec, command, paths):
        return None
    made = ThreeGearAxis(spec, command, tuple(quantities))
    one = made.batch({path: np.array([20.0]) for path in TEETH})
    plain = {name for name in quantities if name.rpartition(".")[0] not in MESHES}
    meshes = (name for name in quantities if name not in plain)
    served = plain <= one.plain.keys() and all(one.mesh_quantity(name) is not None for name in meshes)
    return made if served else None


def _served(spec: Any, command: str, paths: Sequence[str]) -> bool:
    """Whether the array form knows all keys that are varied, and the base asks for no more."""
    task, batch = _TASKS[command][0], _batch_of(spec, command)
    section = getattr(spec, task)
    if section is None:
        return False
    if spec.gears.own_teeth or min(spec.gears.crank, spec.gears.output) < 0:  # or a ring gear
        return False
    if any(getattr(spec, name) is not None for name in ("dwell_backlash", "input_speed", "uniform_tolerance")):
        return False
    if spec.feed is not None and (spec.feed.step is not None or spec.feed.lay is not None):
        return False
    if any(getattr(section, name) is not None for name in (_PLACED if batch is Windows else _OTHERS[task])):
        return False
    known = {*TEETH, "gears.module", "gears.i3", *batch.keys, *LIMITS, *SHAFTS}

    def given(path: str) -> bool:
        return path in paths or number_at(spec, path) is not None

    if command == "analyze" and given("dwell.tolerance"):  # measured by the class alone
        return False
    if batch is Windows:
        window = given("dwell.window")
        if window == given("dwell.tolerance") or (window and given("dwell_tolerance")):
            return False
    others = given("gears.crank") and given("gears.output") and given("gears.module")
    idler = given("gears.idler") != given("gears.i3") or (batch.chooses_idler and not _is_given_by_task(command, given))
    return set(paths) <= known and others and idler


def _batch_of(spec: Any, command: str) -> type[Batch]:
    """What computes the designs of a task: a dwell may ask for a window instead of an angle."""
    by_window = command == "synth dwell" and spec.dwell is not None and spec.dwell.angle is None
    return Windows if by_window else _TASKS[command][1]


def _is_given_by_task(command: str, given: Callable[[str], bool]) -> bool:
    """Whether the task itself gives the idler: a back-step over a crank angle does."""
    both = given("back_step.angle") and given("back_step.crank_angle")
    return (command == "synth back-step" and both) or given("gears.i3")


@dataclass(frozen=True)
class ThreeGearAxis:
    """The array form; made by `axis`."""

    spec: Any
    command: str
    wanted: tuple[str, ...]

    @cached_property
    def meshes(self) -> UnshiftedMeshes:
        """Meshes of the base's pressure angle."""
        return UnshiftedMeshes(math.radians(self.spec.gears.pressure_angle), self.spec.limits)

    def batch(self, columns: Mapping[str, Reals]) -> Batch:
        """Some designs."""
        return self._kind(self.spec, self.command, self.wanted, self.meshes, columns)

    @cached_property
    def _kind(self) -> type[Batch]:
        return _batch_of(self.spec, self.command)

    def _with_idlers(self, columns: Mapping[str, Reals]) -> Mapping[str, Reals]:
        """With the idlers that ratios ask for, as `idler_for_ratio`; none where the model refuses gears beside one."""
        ratio = columns.get("gears.i3", self.spec.gears.i3)
        if ratio is None:
            return columns
        crank, _, output = (columns.get(path, number_at(self.spec, path)) for path in TEETH)
        idler = np.where(crank == output, np.floor(-ratio * output + 0.5), np.nan)
        count = len(next(iter(columns.values())))
        return {**columns, "gears.idler": np.broadcast_to(idler, (count,))}

    @cached_property
    def _seeks_idler(self) -> bool:
        return all(number_at(self.spec, path) is None for path in ("gears.idler", "gears.i3"))

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """As `core.base.design_axis.Axis`."""
        inside, outside = kept_inside(self._with_idlers(columns), _DOMAIN)
        if self._kind is Windows:  # of unequal gears the class has them, in the balanced family
            crank, output = (inside.get(path, number_at(self.spec, path)) for path in (TEETH[0], TEETH[2]))
            outside |= np.asarray(crank != output)
            inside["gears.output"] = np.broadcast_to(np.asarray(crank), outside.shape)
        with np.errstate(all="ignore"):
            if not self._seeks_idler or {"gears.idler", "gears.i3"} & columns.keys():
                return self.batch(inside).evaluated(outside)
            teeth, doubtful = self._idlers(inside)
            none = np.isnan(teeth)
            made = self.batch({**inside, "gears.idler": np.where(none, LEAST_IDLER, teeth)})
            made.without_idler = none
            return made.evaluated(outside | doubtful)

    def _idlers(self, columns: Mapping[str, Reals]) -> Idlers:
        """The smallest idlers that keep the limits."""
        shafts = any(path in columns or number_at(self.spec, path) is not None for path in SHAFTS)

        def trial(teeth: Reals, places: Any) -> Tried:
            some = {path: values[places] for path, values in columns.items()}
            return self.batch({**some, "gears.idler": teeth}).tried(shafts=shafts)

        count = len(next(iter(columns.values())))
        return smallest_idlers(trial, count, rising=self._kind.idlers_rise, shafts=shafts)


Trial = Callable[[Reals, Any], Tried]
"""Tries idlers, a number of teeth each, on the designs of some places."""


class Idlers(NamedTuple):
    """Smallest idlers: teeth, NaN where no idler keeps the limits, and designs that the class shall compute."""

    teeth: Reals
    doubtful: Mask


def smallest_idlers(trial: Trial, count: int, *, rising: bool, shafts: bool) -> Idlers:
    """The smallest idler of each design that keeps the limits and clears the shafts; or the limits alone, if none does.

    Parameters
        trial : Trial
        count : int - of the designs
        rising : bool - whether all idlers above one that keeps the limits keep them
        shafts : bool - whether there are shafts to clear
    """
    doubtful = np.zeros(count, dtype=bool)
    first = (_halved if rising else _from_below)(trial, count, doubtful)
    if not shafts:
        return Idlers(first, doubtful)
    return Idlers(_clear(trial, first, doubtful), doubtful)


def _halved(trial: Trial, count: int, doubtful: Mask) -> Reals:
    """Bisection: the minimum of an upper range."""
    low, high = np.full(count, LEAST_IDLER - 1.0), np.full(count, float(GREATEST_IDLER))
    every = np.arange(count)
    at_most = trial(high, every)
    doubtful |= at_most.close
    live = np.flatnonzero(at_most.good)
    while live.size:
        middle = np.floor(0.5 * (low[live] + high[live]))
        found = trial(middle, live)
        doubtful[live] |= found.close
        high[live] = np.where(found.good, middle, high[live])
        low[live] = np.where(found.good, low[live], middle)
        live = live[high[live] - low[live] > 1.0]
    return np.where(at_most.good, high, np.nan)


def _from_below(trial: Trial, count: int, doubtful: Mask) -> Reals:
    return _first(trial, np.full(count, float(LEAST_IDLER)), doubtful, lambda found: found.good)


def _clear(trial: Trial, first: Reals, doubtful: Mask) -> Reals:
    """The first idler from those that keep the limits on that clears the shafts too; where none does, those."""
    found = _first(trial, first, doubtful, lambda tried: tried.good & tried.clear)
    return np.where(np.isnan(found), first, found)


def _first(trial: Trial, start: Reals, doubtful: Mask, holds: Callable[[Tried], Mask]) -> Reals:
    """The first idler from `start` on for which something holds; NaN where there is none, or no start."""
    found = np.full(start.shape, np.nan)
    live, teeth = np.flatnonzero(~np.isnan(start)), start[~np.isnan(start)]
    while live.size:
        tried = trial(teeth, live)
        doubtful[live] |= tried.close
        good = holds(tried)
        found[live[good]] = teeth[good]
        going = ~good & (teeth < GREATEST_IDLER)
        live, teeth = live[going], teeth[going] + 1.0
    return found
