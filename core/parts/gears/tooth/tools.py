"""Gear cutting tools: the rack tool (hob, rack cutter, grinding worm) and the pinion cutter of a ring."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import short, unlike
from gearlink.core.parts.gears.tooth.teeth import SCALARS, GearFunctions

_USUAL_ROUNDING = 0.38


@dataclass(frozen=True, kw_only=True)
class RackTool:
    """The reference profile of a rack tool, in modules of the normal section.

    Parameters
        addendum : float [module] - h_fP*, tip of the tool below its datum line
        rounding : float [module] - rho_fP*, radius of the tool's tip
        residual_undercut : float [module] - s_pr*, protuberance less the machining allowance
    Example
        >>> tool = RackTool(addendum=1.25, rounding=0.25)
        >>> round(tool.straight_end(math.radians(20.0)), 6)
        1.085505

    Source
        ISO 53, ISO 6336-3
    """

    addendum: float = 1.25
    rounding: float = _USUAL_ROUNDING
    residual_undercut: float = 0.0

    def straight_end(self, pressure_angle: float, f: GearFunctions = SCALARS) -> float:
        """h_fP* - rho* (1 - sin(alpha_n)) [module]: how far below the datum line the straight flank reaches."""
        return self.addendum - self.rounding * (1.0 - f.sin(pressure_angle))

    def rounding_center(self, pressure_angle: float, f: GearFunctions = SCALARS) -> float:
        """E = pi/4 - h_fP* tan(alpha_n) + (s_pr* - rho* (1 - sin(alpha_n)))/cos(alpha_n) [module].

        The rounding's centre beside the middle of the tool's tooth; negative for a pointed tool.
        """
        protruding = self.residual_undercut - self.rounding * (1.0 - f.sin(pressure_angle))
        center = math.pi / 4.0 - self.addendum * f.tan(pressure_angle) + protruding / f.cos(pressure_angle)
        return f.where(abs(center) < 1e-14, 0.0, center)

    def require_tip(self, pressure_angle: float) -> None:
        """Refuse a tool whose tip is pointed.

        Raises
            NoSolution - where E < 0
        """
        if self.rounding_center(pressure_angle) >= 0.0:
            return
        most = full_rounding(pressure_angle, self.addendum, self.residual_undercut)
        if most <= 0.0:
            deepest = (math.pi / 4.0 + self.residual_undercut / math.cos(pressure_angle)) / math.tan(pressure_angle)
            raise NoSolution(
                f"addendum of the tool: {unlike(self.addendum, deepest)} modules (limit < "
                f"{unlike(deepest, self.addendum)} modules, where it is pointed)",
                fix=f"keep the addendum below {safely_below(deepest)} modules",
            )
        raise NoSolution(
            f"rounding of the tool: {unlike(self.rounding, most)} modules (limit <= {unlike(most, self.rounding)} "
            f"modules, a full round at the addendum {short(self.addendum)})"
        )


def full_rounding(
    pressure_angle: float, addendum: float, residual_undercut: float = 0.0, f: GearFunctions = SCALARS
) -> float:
    """Rounding that makes the tip of a rack tool one arc [module]: E = 0.

    Example
        >>> round(full_rounding(math.radians(20.0), 1.25), 6)
        0.471911
    """
    half = math.pi / 4.0 - addendum * f.tan(pressure_angle) + residual_undercut / f.cos(pressure_angle)
    return half * f.cos(pressure_angle) / (1.0 - f.sin(pressure_angle))


def rack_tip_width(height: float, pressure_angle: float) -> float:
    """Width of the tips of a rack [module]: pi/2 - 2 h tan(alpha_n), negative where its flanks meet below the tip.

    Example
        >>> round(rack_tip_width(1.0, math.radians(20.0)), 6)
        0.842856
    """
    return math.pi / 2.0 - 2.0 * height * math.tan(pressure_angle)


def standard_tool(pressure_angle: float, addendum: float, clearance: float, f: GearFunctions = SCALARS) -> RackTool:
    """The rack tool of a profile with addendum h_a* and clearance c* that names no tool.

    rho* = c*/(1 - sin(alpha_n)), where the tool's straight flank ends at h_a*; at most a full round

    Example
        >>> round(standard_tool(math.radians(20.0), 1.0, 0.25).rounding, 6)
        0.379951

    Source
        ISO 53, profile A
    """
    depth = addendum + clearance
    most = f.greatest(0.0, full_rounding(pressure_angle, depth, f=f))
    return RackTool(addendum=depth, rounding=f.least(clearance / (1.0 - f.sin(pressure_angle)), most))


@lru_cache(maxsize=64)
def tool_of_profile(pressure_angle: float, addendum: float, clearance: float) -> RackTool:
    """`standard_tool`, kept for the thousands of pairs of a contour that differ in their shifts alone.

    Example
        >>> tool_of_profile(math.radians(20.0), 1.0, 0.25) == standard_tool(math.radians(20.0), 1.0, 0.25)
        True
    """
    return standard_tool(pressure_angle, addendum, clearance)


def usual_rounding(pressure_angle: float, addendum: float, clearance: float, residual_undercut: float = 0.0) -> float:
    """rho* of a tool that gives none: 0.38, but no more than ends at the clearance and than a full round [module].

    Example
        >>> [round(usual_rounding(math.radians(20.0), 1.25, c), 6) for c in (0.25, 0.1)]
        [0.379951, 0.15198]

    Source
        ISO 53, profile A
    """
    most = max(0.0, full_rounding(pressure_angle, addendum, residual_undercut))
    return min(_USUAL_ROUNDING, clearance / (1.0 - math.sin(pressure_angle)), most)


@dataclass(frozen=True, kw_only=True)
class PinionCutter:
    """The pinion cutter that shapes a ring.

    Parameters
        teeth : int - z_0
        shift : float [module] - x_0 of the cutter as it is ground
        addendum : float [module] - h_a0*
        rounding : float [module] - rho_a0*, radius of its tip corner
    """

    teeth: int
    shift: float = 0.0
    addendum: float = 1.25
    rounding: float = 0.25
