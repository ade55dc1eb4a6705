"""Figures of a wide-swing cam mechanism: one module per command."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.machines.wide_swing.design import WideSwingDesign

_MODULES = {"swing": "motion", "analyze": "motion", "cam": "profiles"}


def draw(command: str, design: WideSwingDesign) -> Figure:
    """The figure of a command on a wide-swing mechanism."""
    made: Figure = import_module(f"gearlink.cli.views.figures.wide_swing_cam.{_MODULES[command]}").draw(command, design)
    return made
