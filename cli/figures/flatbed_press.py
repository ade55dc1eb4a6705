"""Figures of a flatbed cylinder press: one module per command."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.flatbed_press.design import FlatbedPress

_MODULES = {
    "press": "flatbed_press_motion",
    "analyze": "flatbed_press_motion",
    "cam": "flatbed_press_cam",
    "gear": "flatbed_press_parts",
    "crank": "flatbed_press_parts",
}


def draw(command: str, design: FlatbedPress) -> Figure:
    """The figure of a command on a press."""
    made: Figure = import_module(f"gearlink.cli.figures.{_MODULES[command]}").draw(command, design)
    return made
