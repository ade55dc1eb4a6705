"""A push rod as a design, and its loads."""

from __future__ import annotations

from typing import Any

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.real_speed import RealSpeed
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.studies.clearance import reaches
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline


class PushRod(RealSpeed, Design):
    """Crank, rod, slider."""

    kind = "push-rod"
    outlines = {"analyze": Outline(("crank_length", "stroke"), (), ("motion",))}

    @property
    def crank_length(self) -> float:
        """The crank [mm]."""
        return float(self.spec.crank)

    @property
    def stroke(self) -> float:
        """How far the slider goes, where the crank's axis is on its line [mm]."""
        reach = reaches(self.moving, {"A": ("frame", 0j), "C": ("slider", 0j)})["AC"]
        return reach.farthest - reach.nearest

    def table_motion(self, samples: int | None = None) -> Table:
        """The slider over a revolution."""
        from gearlink.core.mechanism.courses import Shown, motion_table
        from gearlink.core.push_rod.mechanism import SLIDER

        shown = [Shown("displacement", SLIDER), Shown("velocity", SLIDER, 1, "slider_velocity")]
        return motion_table("motion", self, shown, samples)


class PushRodLoadsDesign(LoadsDesign):
    """Torque, forces, bearings."""

    kind = "push-rod"
    links, sliding, output = ("crank", "rod", "slider"), ("slider",), "slider"
    pins, meshes = ("A", "B", "C"), ()
    outlines = loads_outline(pins, meshes)

    @cached_property
    def design(self) -> Any:
        """The geometry."""
        return PushRod(self.spec)
