"""Figures of a flatbed cylinder press: one module per command."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.machines.flatbed_press.design import FlatbedPress

_MODULES = {
    "press": "motion",
    "analyze": "motion",
    "cam": "cam",
    "gear": "parts",
    "crank": "parts",
}


def draw(command: str, design: FlatbedPress) -> Figure:
    """The figure of a command on a press."""
    made: Figure = import_module(f"gearlink.cli.views.figures.flatbed_press.{_MODULES[command]}").draw(command, design)
    return made
