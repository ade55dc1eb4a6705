"""Designs side by side: input gears of other modules at the centre distance of the machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.candidates import Sought, table
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.remedies.ways import MODULES

if TYPE_CHECKING:
    from gearlink.core.base.report import Table
    from gearlink.core.machines.flatbed_press.design import FlatbedPress

_SHOWN = ("profile_shift", "contact_ratio", "tip_thickness", "specific_sliding")


def input_gears(design: FlatbedPress) -> Table:
    """The modules of ISO 54 about the file's own, each with as many teeth as fit."""
    gears = design.spec.input_gears
    if gears is None:
        raise MissingSection("candidates are the input gears: give the section input_gears", key="input_gears")
    near = sorted({*MODULES, gears.module}, key=lambda module: abs(module / gears.module - 1.0))[:7]
    keys = {"input_gears.module": ("module", "mm")}
    rows, teeth = [(module,) for module in sorted(near)], {"teeth": lambda trial: trial.gear_pair.teeth[0]}
    return table(design, Sought("gear", keys, rows, _SHOWN, counted=teeth))
