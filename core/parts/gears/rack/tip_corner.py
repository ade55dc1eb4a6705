"""The corner of a gear's tip in the root rounding of its rack, outside the path of contact.

In the frame of the rack, x from the middle of a space towards the flank in contact, D below the datum line, the gear
turned by psi from where its corner stands deepest:

    D = r_a cos(psi) - r - x m,  x = w(D_E) - (r_a sin(psi) - r psi) + (r_a sin(psi_E) - r psi_E)

w is half the width of the space at its flanks, E the end of contact, psi_E = alpha_t - alpha_a. The gear's own fillet
needs no such look: the rack's tips lie inside the tool that cut it wherever contact ends on the flank.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.tip_corner import CornerGap, least_gap, near_of, places_towards


@dataclass(frozen=True)
class CornerInRack:
    """The corner of a gear's tip beside the root rounding of its rack.

    Parameters
        pair : GearPair - gear 1 is the gear, the tool of gear 2 the rack's; contact ends on the flank of the
            rack, whose tool is not pointed
        center_distance : float [mm] - from the axis to the datum line
        end_depth : float [mm] - how far below the datum line contact ends
    Notes
        The limit of a wheel with ever more teeth; compared with drawn teeth that are turned in mesh.
    Source
        own derivation: the corner's path while the reference circle rolls on the pitch line
    """

    pair: GearPair
    center_distance: float
    end_depth: float

    @cached_property
    def _gap(self) -> Callable[[float], float]:
        pair = self.pair
        m, across, tip, r = (
            pair.module,
            pair.module / math.cos(pair.helix_angle),
            pair.tip_radius[0],
            pair.reference_radius[0],
        )
        at_end = pair.transverse_pressure_angle - pair.tip_pressure_angle[0]
        depth = self.end_depth / m
        start = across * (math.pi / 4.0 - depth * math.tan(pair.pressure_angle)) + tip * math.sin(at_end) - r * at_end

        def gap(normal: float) -> float:
            """Along the rack, from the corner to the rounding in a direction of its normal [mm]."""
            beside, below = self._rounding(normal)
            left = (self.deepest - m * below) / (2.0 * tip)
            if left < 0.0:
                return math.inf
            psi = math.copysign(2.0, at_end) * math.asin(math.sqrt(left))
            return across * beside - start + tip * math.sin(psi) - r * psi

        return gap

    @property
    def deepest(self) -> float:
        """How far below the datum line the tip comes, r_a - r - x m [mm]."""
        return self.pair.tip_radius[0] - self.center_distance

    def _rounding(self, normal: float) -> tuple[float, float]:
        """Place of the rounding beside the middle of the space and below the datum line, in the normal section [m]."""
        angle, tool = self.pair.pressure_angle, self.pair.tool(1)
        beside = tool.rounding_center(angle) + tool.rounding * math.sin(normal)
        return beside, tool.addendum - tool.rounding * (1.0 - math.cos(normal))

    @cached_property
    def least(self) -> CornerGap:
        """The minimum gap along the rack, and how far below the datum line [mm]."""
        module, end = self.pair.module, math.pi / 2.0 - self.pair.pressure_angle
        gap, place = least_gap(self._gap, places_towards(0.0, end), near_of(module))
        return CornerGap(gap, module * self._rounding(place)[1])
