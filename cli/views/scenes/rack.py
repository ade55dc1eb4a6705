"""A gear on a rack: the rack goes there and back, so that the animation comes to meet itself."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLUE, ORANGE, pale
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import TURN, Body, Mark, Points, Readout, Reals, Scene, track
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.rack.geometry import RackGeometry
from gearlink.core.parts.gears.rack.profile import RackProfile

if TYPE_CHECKING:
    from gearlink.core.parts.gears.rack.mesh import RackMesh

_CHORD = 0.012
_MOST_TEETH = 600
_LEAST_STROKE = 1.0
"""Pitches to each side."""


def rack_scene(rack: RackMesh, teeth: int, back: float, fraction: Reals, drawn: int = 0) -> Scene:
    """Gear and rack over a loop; at its start and in its middle two flanks touch at the pitch point.

    Parameters
        teeth : int - of the rack
        back : float [mm] - thickness of its body below the root line
        fraction : of the loop, there and back
        drawn : int - teeth about its middle that are drawn, as odd or even as all of them; 0: all
    """
    pair, geometry = rack.pair, RackGeometry(rack)
    radius = pair.reference_radius[0]
    travel = rack.pitch_on_line * max(_LEAST_STROKE, 0.5 * teeth - 2.0) * np.sin(TURN * fraction)
    turn = geometry.first_space[0] + travel / radius
    driver = gear(pair, 0, track(0.0, fraction), turn, 1.0, BLUE, "1", "gear 1")
    place = rack.center_distance + 1j * (geometry.first_space[1] + travel)
    body = replace(rack_body(rack, drawn or teeth, back, place), name=f"rack, z = {teeth}")
    readouts = (
        Readout("gear 1", "°", np.degrees(turn - geometry.first_space[0])),
        Readout("rack", " mm", travel),
    )
    return Scene(parts=(body, *driver), marks=(Mark(track(0.0, fraction), pivot=True),), readouts=readouts)


def rack_body(rack: RackMesh, teeth: int, back: float, place: Points) -> Body:
    """The rack upright, its teeth to the left; a rack that no tool leaves is drawn by its tip and back lines."""
    module, words = rack.pair.module, ""
    try:
        profile: RackProfile = rack.profile
        if teeth > _MOST_TEETH:
            raise NoSolution("finer teeth would be a grey band at page width")
        outline = profile.body(_CHORD * module, teeth, back)
    except NoSolution:
        long, low = 0.5 * teeth * rack.pitch_on_line, -(rack.pair.root_depth(1) * module + back)
        high = rack.path.height * module
        corners = [complex(x, y) for x, y in ((long, high), (-long, high), (-long, low), (long, low), (long, high))]
        outline, words = np.array(corners), "2 (tip line)"
    still = np.full(place.shape, 0.5 * np.pi)
    body = Body(outline=outline, place=place, turn=still, color=ORANGE, fill=pale(ORANGE), width=1.0)
    return replace(body, label=words, name=f"rack, z = {teeth}")
