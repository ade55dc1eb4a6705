"""Parts of a flatbed cylinder press that are designs of their own kind as well: input gears, slider-crank."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign


def draw(command: str, design: FlatbedPress) -> Figure:
    """The pair of input gears, or the slider-crank D-E-F."""
    if command == "gear":
        from gearlink.cli.views.figures.gears.mesh import Mesh, mesh_figure

        return mesh_figure(f"{design.spec.name}: {command}", [Mesh(design.gear_pair)])
    from gearlink.cli.views.figures import slider_crank

    return slider_crank.draw(command, _slider_crank(design))


def _slider_crank(design: FlatbedPress) -> SliderCrankDesign:
    """D-E-F as a design of its own: its slider makes half the bed's stroke."""
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign
    from gearlink.core.machines.slider_crank.spec import SliderCrankSpec

    part = design.slider_crank
    spec = SliderCrankSpec(
        kind="slider-crank", name=design.spec.name, stroke=part.stroke, rod=part.rod, offset=part.offset
    )
    return SliderCrankDesign(spec)
