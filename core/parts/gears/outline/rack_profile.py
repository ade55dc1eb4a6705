"""The teeth of a rack as a tool of its own profile leaves them, and where a gear stands on them.

Frame of the teeth: the x axis is the datum line, the y axis the middle of a tooth space; teeth point up. Frame of the
mesh: the axis of the gear is the origin, the datum line stands upright at the distance a; the rack moves up. Points are
complex numbers x + i y.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.curves import Curve, straight
from gearlink.core.parts.gears.outline.mesh_geometry import contact_points
from gearlink.core.parts.gears.tooth.tools import RackTool, rack_tip_width

if TYPE_CHECKING:
    from gearlink.core.parts.gears.rack import RackMesh


Piece = tuple[Curve, float, float]


@dataclass(frozen=True, kw_only=True)
class RackProfile:
    """A rack between the middle of a space and the middle of the next tooth.

    Parameters
        module : float [mm] - normal module
        pressure_angle : float [rad] - alpha_n
        helix_angle : float [rad] - beta
        height : float [module] - of the tips above the datum line, h_aR
        tool : RackTool - its tip leaves the root: depth, rounding
    Returns
        Methods: points in mm.
    Raises
        NoSolution - for pointed teeth or tools, and for a tool with a protuberance, whose step is not known
    Notes
        The rounding is an arc in the normal section, and an ellipse in the transverse one.
    Example
        >>> rack = RackProfile(module=2.0, tool=RackTool(addendum=1.25, rounding=0.25))
        >>> points = rack.half_tooth(1e-3)
        >>> float(points[0].imag), float(points[-1].imag), round(float(points[-1].real), 9)
        (-2.5, 2.0, 3.141592654)

    Source
        ISO 53; own derivation of the transverse section
    """

    module: float
    tool: RackTool
    pressure_angle: float = math.radians(20.0)
    helix_angle: float = 0.0
    height: float = 1.0

    def __post_init__(self) -> None:
        self.tool.require_tip(self.pressure_angle)
        if self.tool.residual_undercut:
            raise NoSolution(
                "the step that a protuberance leaves in a rack depends on the tool and is not known",
                key="tool",
                fix="give the rack a tool without one (tool: [{...}, {addendum: ..., rounding: ...}])",
            )
        if self.tip_width <= 0.0:
            most = safely_below(math.pi / (4.0 * math.tan(self.pressure_angle)))
            raise NoSolution("the teeth of the rack are pointed", fix=f"keep its addendum below {most} modules")
        if not self.tool.straight_end(self.pressure_angle) + self.height > 0.0:
            raise NoSolution(
                "the rounding at the root of the rack leaves no flank", fix="reduce the rounding of its tool"
            )

    @property
    def tip_width(self) -> float:
        """s_aR = m (pi/2 - 2 h_aR tan(alpha_n)), in the normal section [mm]."""
        return self.module * rack_tip_width(self.height, self.pressure_angle)

    @property
    def pitch(self) -> float:
        """p_t = pi m/cos(beta) [mm]."""
        return math.pi * self.module / math.cos(self.helix_angle)

    @property
    def root(self) -> float:
        """Height of the root line, -h_fP* m [mm]."""
        return -self.tool.addendum * self.module

    @property
    def tip(self) -> float:
        """Height of the tip line [mm]."""
        return self.height * self.module

    def _across(self, normal: float) -> float:
        """A length of the normal section in the transverse one [mm]."""
        return normal * self.module / math.cos(self.helix_angle)

    def rounding(self, normal: Reals) -> Points:
        """The rounding at the root over the direction b of its normal, from 0 at the root line to 90 deg - alpha_n."""
        center, rho = max(0.0, self.tool.rounding_center(self.pressure_angle)), self.tool.rounding
        across = (center + rho * np.sin(normal)) / math.cos(self.helix_angle)
        up = rho - self.tool.addendum - rho * np.cos(normal)
        return np.asarray(self.module * (across + 1j * up))

    def pieces(self) -> list[Piece]:
        """Root line, rounding, flank and tip line, with the range of their parameters; ends meet to the bit."""
        slope, end = math.tan(self.pressure_angle), self.tool.straight_end(self.pressure_angle)
        flat = max(0.0, self.tool.rounding_center(self.pressure_angle))
        corners = [
            complex(0.0, self.root),
            complex(self._across(flat), self.root),
            complex(self._across(math.pi / 4.0 - end * slope), -end * self.module),
            complex(self._across(math.pi / 4.0 + self.height * slope), self.tip),
            complex(0.5 * self.pitch, self.tip),
        ]
        return [
            (straight(corners[0], corners[1]), 0.0, 1.0),
            (self.rounding, 0.0, math.pi / 2.0 - self.pressure_angle),
            (straight(corners[2], corners[3]), 0.0, 1.0),
            (straight(corners[3], corners[4]), 0.0, 1.0),
        ]

    def half_tooth(self, chord_error: float) -> Points:
        """Points from the middle of a space to the middle of the next tooth, chords within a distance [mm]."""
        root, (curve, low, high), flank, tip = self.pieces()
        bend = self.tool.rounding * self.module / math.cos(self.helix_angle) ** 2
        step = math.sqrt(8.0 * chord_error / bend) if bend > 0.0 else high
        count = max(2, math.ceil((high - low) / step) + 1)
        ends = np.array([0.0, 1.0])
        rows = [root[0](ends)[:1], curve(np.linspace(low, high, count)), flank[0](ends)[1:], tip[0](ends)[1:]]
        return np.concatenate(rows)

    def teeth(self, chord_error: float, count: int) -> Points:
        """The line of so many pitches, from the middle of a tooth on, its middle at x = 0 if their number is odd."""
        half = self.half_tooth(chord_error)
        space = np.concatenate([-half[:0:-1].conj(), half])
        at = self.pitch * (np.arange(count) - (count - 1) // 2)
        line = (at[:, None] + space[None, :-1]).ravel()
        return np.concatenate([line, at[-1:] + space[-1:]])

    def body(self, chord_error: float, count: int, back: float) -> Points:
        """The closed outline of a rack of so many pitches, its back so far below the root line [mm]."""
        line = self.teeth(chord_error, count)
        low = self.root - back
        corners = np.array([complex(line[-1].real, low), complex(line[0].real, low)])
        return np.concatenate([line, corners, line[:1]])


@dataclass(frozen=True)
class RackGeometry:
    """A gear on a rack at the moment when two flanks touch at the pitch point; the gear drives counter-clockwise.

    Returns
        Properties: points in mm, angles in rad.
    Example
        >>> from gearlink.core.parts.gears.rack import RackData, RackMesh
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> mesh = RackGeometry(RackMesh(RackData(pair=GearPair.from_shift(2.0, (20, 10_000)))))
        >>> round(abs(mesh.contact_end - mesh.contact_start) / mesh.base_pitch - mesh.rack.contact_ratio, 12)
        0.0

    Source
        own derivation; ISO 21771 for the names
    """

    rack: RackMesh

    @property
    def axis(self) -> complex:
        """Axis of the gear [mm]."""
        return 0j

    @cached_property
    def pitch_point(self) -> complex:
        """Where the reference circle rolls on the pitch line [mm]."""
        return complex(self.rack.pair.reference_radius[0])

    @cached_property
    def direction(self) -> complex:
        """Unit vector of the line of action, the way the contact moves."""
        return 1j * cmath.exp(-1j * self.rack.working_pressure_angle)

    def _at(self, rho: float) -> complex:
        return self.pitch_point + (rho - self.rack.path.pitch) * self.direction

    @property
    def contact_start(self) -> complex:
        """A, on the tip line of the rack [mm]."""
        return self._at(self.rack.path.start)

    @property
    def contact_end(self) -> complex:
        """E, on the tip circle of the gear [mm]."""
        return self._at(self.rack.path.end)

    @property
    def base_pitch(self) -> float:
        """p_et [mm], from one contact point to the next."""
        return self.rack.pair.base_pitch

    @cached_property
    def contacts(self) -> list[complex]:
        """All points where flanks touch at this moment [mm]."""
        return contact_points(self.pitch_point, self.base_pitch * self.direction, self.contact_start, self.contact_end)

    @cached_property
    def first_space(self) -> tuple[float, float]:
        """Middle of a tooth space: of the gear its polar angle [rad], of the rack its height y [mm].

        eta = (pi/2 - 2 x tan(alpha_n))/z above the line of centres, r (pi/z - eta) below it
        """
        pair = self.rack.pair
        half = (math.pi / 2.0 - 2.0 * pair.profile_shift[0] * math.tan(pair.pressure_angle)) / pair.teeth[0]
        return half, -pair.reference_radius[0] * (math.pi / pair.teeth[0] - half)
