"""Idlers and modules side by side: what each would give for the same task."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.base.candidates import findings, modules
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.three_gear.idler_choice import GREATEST_IDLER, LEAST_IDLER

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.synthesis.base import Synthesis

_SHARES = (1.0, 1.1, 1.25, 1.5, 1.75, 2.0)
"""Teeth of the idlers that are shown, over those of the first."""

_COLUMNS = {
    "module": "mm",
    "idler_teeth": "1",
    "findings": "1",
    "length": "mm",
    "crank_length": "mm",
    "frame_length": "mm",
    "dwell": "deg",
    "back_step": "deg",
    "speed_ratio_max": "1",
    "acceleration_ratio_max": "1",
    "transmission_angle": "deg",
    "gear_gap": "mm",
}


def table(design: Synthesis, _samples: int | None = None) -> Table:
    """The task met by six idlers in each of three modules; where there is no mechanism the row says why.

    Rows: modules as the file has it and the next of ISO 54 to either side; idlers from the one that the file names, or
    from the smallest that keeps the limits, up to twice its teeth. `length` is what gears 1 and 5 cover along the line
    AD, `dwell` the window within the tolerance, or where no tolerance is asked for phi13.
    """
    rows = [_row(design, module, idler) for module in modules(design.spec.gears.module) for idler in _idlers(design)]
    return Table.of("candidates", {name: ([row.get(name) for row in rows], unit) for name, unit in _COLUMNS.items()})


def _idlers(design: Synthesis) -> list[int]:
    first = design.spec.gears.idler or _smallest(design)
    return sorted({min(GREATEST_IDLER, math.ceil(first * share)) for share in _SHARES})


def _smallest(design: Synthesis) -> int:
    try:
        return design.idler_teeth
    except NoSolution as refused:
        if refused.key != "gears.idler":
            raise
        return LEAST_IDLER


def _row(design: Synthesis, module: float, idler: int) -> dict[str, Any]:
    """One candidate; a mechanism that does not exist has its reason among the findings."""
    row: dict[str, Any] = {"module": module, "idler_teeth": idler}
    spec = changed(design.spec, (("gears.module", module), ("gears.idler", idler), ("gears.i3", None)))
    if spec is None:
        return row | {"findings": "refused"}
    trial = type(design)(spec)
    trial.advises = False
    try:
        return row | _found(trial)
    except NoSolution as refused:
        return row | {"findings": f"{refused.code} {refused.key}"}


def _found(trial: Synthesis) -> dict[str, Any]:
    radii = (trial.spec.gears.transverse_module * abs(teeth) / 2.0 for teeth in (trial.crank_teeth, trial.output_teeth))
    dwell = trial.tolerance_dwell_angle if _within_a_tolerance(trial) else trial.dwell_angle
    command = next(name for name in trial.outlines if name.startswith("synth"))
    return {
        "length": trial.crank_length + trial.frame_length + sum(radii) + trial.tip_excess,
        "crank_length": trial.crank_length,
        "frame_length": trial.frame_length,
        "dwell": None if dwell is None else math.degrees(dwell),
        "back_step": None if trial.back_step_angle is None else math.degrees(trial.back_step_angle),
        "speed_ratio_max": trial.speed_ratio_max,
        "acceleration_ratio_max": trial.acceleration_ratio_max,
        "transmission_angle": math.degrees(trial.min_transmission_angle),
        "gear_gap": trial.gear_gap,
        "findings": findings(trial, command),
    }


def _within_a_tolerance(trial: Synthesis) -> bool:
    request = trial.spec.dwell
    return trial.spec.dwell_tolerance is not None or (request is not None and request.angle is None)
