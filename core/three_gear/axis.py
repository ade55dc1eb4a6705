"""The three-gear four-bar over arrays of designs: `core.design_axis` for its syntheses in closed form and its analysis.

Whatever a study asks for beside that (a synthesis for a window, a play, given shafts, a ratio in place of an idler,
quantities of other commands) is left to the design classes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.design_axis import Evaluated, kept_inside
from gearlink.core.gears.unshifted import MOST_TEETH, UnshiftedMeshes
from gearlink.core.numerics.arrays import Reals
from gearlink.core.spec_paths import number_at
from gearlink.core.three_gear.axis_batch import LIMITS, TEETH, Batch
from gearlink.core.three_gear.general_axis import Analysis, Momentary
from gearlink.core.three_gear.names import MESHES
from gearlink.core.three_gear.symmetric_axis import BackSteps, Dwells, Speeds

_TASKS: dict[str, tuple[str, type[Batch]]] = {
    "synth dwell": ("dwell", Dwells),
    "synth back-step": ("back_step", BackSteps),
    "synth variable-speed": ("speed", Speeds),
    "synth momentary-dwell": ("momentary", Momentary),
    "analyze": ("links", Analysis),
}
_DOMAIN = {path: (1.0, float(MOST_TEETH), 20.0) for path in TEETH} | {
    "gears.module": (1e-6, 1e6, 1.0),
    "dwell_tolerance": (1e-6, 360.0, 1.0),
    "dwell_window": (1e-6, 360.0, 1.0),
}
"""Least and greatest value that is computed here, not by the class, and one between that stands in for others."""
_PLACED = ("crank", "frame", "balanced")
_OTHERS = {
    "dwell": (*_PLACED, "window", "tolerance", "margin"),
    "back_step": _PLACED,
    "speed": _PLACED,
    "momentary": ("frame", "gap", "balanced"),
    "links": (),
}


def axis(
    spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str], _codes: Sequence[str]
) -> ThreeGearAxis | None:
    """The array form of a study of three-gear four-bars; None where the design classes have to serve.

    Parameters
        spec, command, paths, quantities, _codes : as of `core.design_axis.Maker`
    """
    if command not in _TASKS or not _served(spec, command, paths):
        return None
    made = ThreeGearAxis(spec, command, tuple(quantities))
    one = made.batch({path: np.array([number_at(spec, path)]) for path in TEETH})
    plain = {name for name in quantities if name.rpartition(".")[0] not in MESHES}
    meshes = (name for name in quantities if name not in plain)
    served = plain <= one.plain.keys() and all(one.mesh_quantity(name) is not None for name in meshes)
    return made if served else None


def _served(spec: Any, command: str, paths: Sequence[str]) -> bool:
    """Whether the array form knows all keys that are varied, and the base asks for no more."""
    task, batch = _TASKS[command]
    section = getattr(spec, task)
    if section is None or spec.gears.i3 is not None or spec.shafts is not None:
        return False
    if spec.gears.own_teeth or min(spec.gears.crank, spec.gears.output) < 0:  # or a ring gear
        return False
    if any(getattr(spec, name) is not None for name in ("dwell_backlash", "input_speed")):
        return False
    if any(getattr(section, name) is not None for name in _OTHERS[task]):
        return False
    known = {*TEETH, "gears.module", *batch.keys, *LIMITS}
    needed = {*TEETH, "gears.module"}
    given = {path for path in needed if path in paths or number_at(spec, path) is not None}
    return set(paths) <= known and given == needed


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
        return _TASKS[self.command][1](self.spec, self.command, self.wanted, self.meshes, columns)

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """As `core.design_axis.Axis`."""
        inside, outside = kept_inside(columns, _DOMAIN)
        with np.errstate(all="ignore"):
            return self.batch(inside).evaluated(outside)
