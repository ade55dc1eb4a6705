"""Figures of a swing gripper: one module per command."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.machines.swing_gripper.design import SwingGripper

_MODULES = {"gripper": "motion", "analyze": "motion", "cam": "cam"}


def draw(command: str, design: SwingGripper) -> Figure:
    """The figure of a command on a swing gripper."""
    made: Figure = import_module(f"gearlink.cli.views.figures.swing_gripper.{_MODULES[command]}").draw(command, design)
    return made
