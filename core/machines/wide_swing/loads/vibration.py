"""The rocker of a wide-swing mechanism on its shaft: after the working stroke, or over the whole turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.studies.loads.vibrating import Vibrating

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.loads.design import WideSwingLoads


class SwingVibrating(Vibrating):
    """As of any output; of a stroke alone, the one motion that ends in a rest."""

    design: WideSwingLoads

    @cached_property
    def inertia(self) -> float:
        """That of the rocker; with a slider it changes over the stroke, and a stiffness has no frequency."""
        if self.design.spec.slider is not None:
            message = "with a slider the inertia changes over the stroke: give loads.vibration.frequency in place"
            raise NoSolution(message, key="loads.vibration.stiffness")
        return super().inertia

    @cached_property
    def motions(self) -> list[tuple[float, float]]:
        """Both strokes of a turn, or the working stroke."""
        return super().motions if self.design.whole else [(0.0, self.design.cam.cycle_angle)]
