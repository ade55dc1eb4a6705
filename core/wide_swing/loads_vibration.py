"""The rocker of a wide-swing mechanism on its shaft: after the working stroke, or over the whole turn."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.loads.vibrating import Vibrating
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.wide_swing.loads import WideSwingLoads


class SwingVibrating(Vibrating):
    """As of any output; of a stroke alone, the one motion that ends in a rest."""

    design: WideSwingLoads

    @cached_property
    def motions(self) -> list[tuple[float, float]]:
        """Both strokes of a turn, or the working stroke."""
        return super().motions if self.design.whole else [(0.0, self.design.cam.cycle_angle)]
