"""Connections of links: pins, guides, teeth, rollers on cams, and the unknown forces of each.

Lengths in mm, couples in N mm. A connection acts on its second link with the forces given here and on its first link
with the opposite ones. The unknowns are linear, so that one system gives all of them; unknown couples are in N m.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.numerics.arrays import Mask, Points, Reals

NEWTON_METER = 1e3
"""[N mm]; so many t mm^2 are a kg m^2 as well."""


class Act(NamedTuple):
    """A force on a link, where it acts, and a couple."""

    on: str
    force: Points | complex
    at: Points
    couple: Reals | float


class Column(NamedTuple):
    """One unknown: the force that its unit gives on the second link, where it acts, and a couple.

    The first link takes the opposite; `also` is what its unit gives on further links.
    """

    first: str
    second: str
    force: Points | complex
    at: Points
    couple: Reals | float
    also: tuple[Act, ...] = ()


class Radial(NamedTuple):
    """The force on the second link that goes with the magnitude of an unknown, per its unit."""

    force: Points
    at: Points


@dataclass(frozen=True)
class Pin:
    """A pin joint: X and Y on the second link."""

    name: str
    first: str
    second: str
    at: Points

    def columns(self) -> list[Column]:
        """Unit forces along x and y."""
        return [Column(self.first, self.second, unit, self.at, 0.0) for unit in (1.0 + 0j, 1j)]


@dataclass(frozen=True)
class Guide:
    """A slide without play: a force across the direction `along`, and a couple.

    The direction is one for all inputs, or on a link that moves an array.
    """

    name: str
    first: str
    second: str
    at: Points
    along: complex | Points

    def columns(self) -> list[Column]:
        """The force i u and the couple."""
        return [
            Column(self.first, self.second, 1j * self.along, self.at, 0.0),
            Column(self.first, self.second, 0j, self.at, NEWTON_METER),
        ]


@dataclass(frozen=True)
class Mesh:
    """A gear mesh: the tangential force at the pitch point, and the radial one that goes with its magnitude.

    Fields
        center : (N,) array [mm] - centre of the first gear
        toward : (N,) array - e, unit vector from the first centre to the second (of a ring: to the planet's)
        radius, mate_radius : float [mm] - working radii of the first and the second gear
        tangent : float - tan of the working pressure angle
        internal : bool - the first gear is a ring
        carrier : str - link that holds both axes, for the friction of the mesh
    """

    name: str
    first: str
    second: str
    center: Points
    toward: Points | complex
    radius: float
    mate_radius: float
    tangent: float
    internal: bool = False
    carrier: str = FRAME

    @property
    def pitch_point(self) -> Points:
        """The point where the pitch circles touch."""
        return np.asarray(self.center + self.radius * self.toward)

    def columns(self) -> list[Column]:
        """F_t i e at the pitch point."""
        return [Column(self.first, self.second, 1j * self.toward, self.pitch_point, 0.0)]

    def radial(self) -> Radial:
        """Away from the first centre; towards a ring's centre."""
        sign = -1.0 if self.internal else 1.0
        return Radial(np.asarray(sign * self.tangent * self.toward + np.zeros_like(self.center)), self.pitch_point)


@dataclass(frozen=True)
class Rack:
    """A rack in mesh with a pinion: the force along the pitch line, and the separating force.

    Fields
        center : (N,) array [mm] - of the pinion
        along, normal : complex, or (N,) arrays of a rack that turns - of the pitch line; from the rack to the pinion
        mate_radius : float [mm] - of the pinion
        tangent : float - tan of the pressure angle
    """

    name: str
    first: str
    second: str
    center: Points
    along: complex | Points
    normal: complex | Points
    mate_radius: float
    tangent: float
    radius: float = field(default=0.0, init=False)

    @property
    def pitch_point(self) -> Points:
        """Where the pitch line touches the pinion."""
        return np.asarray(self.center - self.mate_radius * self.normal)

    def columns(self) -> list[Column]:
        """F_t u at the pitch point."""
        return [Column(self.first, self.second, self.along, self.pitch_point, 0.0)]

    def radial(self) -> Radial:
        """From the rack to the pinion."""
        return Radial(np.broadcast_to(self.tangent * np.asarray(self.normal), self.center.shape), self.pitch_point)


@dataclass(frozen=True)
class ToothDrive:
    """A drive by teeth on a part of the circumference; elsewhere a lock holds the link.

    Fields
        center : (N,) array [mm] - of the driven gear
        toward : complex - from there to the wheel
        mate_radius : float [mm] - working radius of the driven gear
        moves : (N,) array of bool - where teeth are in mesh
    """

    name: str
    second: str
    center: Points
    toward: complex
    mate_radius: float
    tangent: float
    moves: Mask
    first: str = FRAME

    @property
    def pitch_point(self) -> Points:
        """The point where the pitch circles touch."""
        return np.asarray(self.center + self.mate_radius * self.toward)

    def columns(self) -> list[Column]:
        """F_t along i e on the driven gear; a couple where it is locked."""
        along = np.where(self.moves, 1j * self.toward, 0j)
        return [Column(self.first, self.second, along, self.pitch_point, np.where(self.moves, 0.0, NEWTON_METER))]

    def radial(self) -> Radial:
        """Away from the wheel."""
        return Radial(np.where(self.moves, -self.tangent * self.toward, 0j), self.pitch_point)


@dataclass(frozen=True)
class Contact:
    """A roller on a cam: one force along the normal at the roller's centre.

    Where it is negative a second roller carries it, if `back` gives that one's place and normal; the normal counts
    against its own force, so that the sign tells which roller carries. `curvature` is that of the pitch curve [1/mm],
    convex positive, where a motion away from the place that is meant asks for it. `shapes` gives what is drawn of it:
    the outline of the cam, and that of roller or face, each in coordinates of its link [mm]. A face or an edge `slides`
    on the cam; a roller rolls.
    """

    name: str
    first: str
    second: str
    at: Points
    normal: Points
    back: tuple[Points, Points] | None = None
    curvature: Reals | float = 0.0
    shapes: Callable[[], tuple[Points, Points]] | None = field(default=None, compare=False)
    slides: bool = False

    def sided(self, force: Reals) -> Contact:
        """The contact of the roller that carries at each row."""
        if self.back is None:
            return self
        at, normal = self.back
        return Contact(
            self.name,
            self.first,
            self.second,
            np.where(force < 0.0, at, self.at),
            np.where(force < 0.0, normal, self.normal),
        )

    def backward(self, column: Column) -> Column:
        """Its column where the second roller carries."""
        assert self.back is not None, "asked of two rollers only"
        return column._replace(at=self.back[0], force=self.back[1])

    def columns(self) -> list[Column]:
        """N n_out."""
        return [Column(self.first, self.second, self.normal, self.at, 0.0)]


@dataclass(frozen=True)
class Coupling:
    """A train on the frame that turns the second shaft `ratio` times as fast as the first."""

    name: str
    first: str
    second: str
    at: Points
    ratio: float

    def columns(self) -> list[Column]:
        """A couple on the second shaft; -ratio times it on the first, the frame takes the rest."""
        on_first = Act(self.first, 0j, self.at, -self.ratio * NEWTON_METER)
        return [Column(FRAME, self.second, 0j, self.at, NEWTON_METER, (on_first,))]


@dataclass(frozen=True)
class Feed:
    """A train on the frame that moves the second link `ratio` mm along a line of the first per rad of a shaft."""

    name: str
    first: str
    second: str
    at: Points
    along: complex | Points
    shaft: str
    ratio: float

    def columns(self) -> list[Column]:
        """The force along the line; the couple that it takes on the shaft, the frame takes the rest."""
        on_shaft = Act(self.shaft, 0j, self.at, -self.ratio)
        return [Column(self.first, self.second, self.along, self.at, 0.0, (on_shaft,))]


@dataclass(frozen=True)
class SharedContact:
    """A roller that several cams guide in turn: one force along the normal at the roller's centre.

    Fields
        shares : by cam - (N,) array, 1 where it guides the roller, else 0
        curvature : (N,) array [1/mm] - of the pitch curve there, convex positive
        hold : (N,) array [N mm] - couple of a lock instead of the force, where no cam guides the roller
    """

    name: str
    second: str
    at: Points
    normal: Points
    shares: Mapping[str, Reals]
    first: str = FRAME
    curvature: Reals | float = 0.0
    hold: Reals | float = 0.0

    def columns(self) -> list[Column]:
        """N n_out on the roller, the opposite on the cam that guides it; a couple where it is locked."""
        cams = tuple(Act(cam, -share * self.normal, self.at, 0.0) for cam, share in self.shares.items())
        return [Column(FRAME, self.second, self.normal, self.at, self.hold, cams)]


@dataclass(frozen=True)
class Shared:
    """A connection of several links that carry in given shares: one unknown.

    Fields
        first, second : str - the links that it is counted to
        acts : what its unit gives on each link, N or N mm; the frame takes what is left
        back : the same on the same links where the unknown is negative, if other pins carry it then; None: the same
    """

    name: str
    first: str
    second: str
    at: Points
    acts: tuple[Act, ...]
    back: tuple[Act, ...] | None = None

    def sided(self, force: Reals) -> Shared:
        """The connection of the pins that carry at each row."""
        if self.back is None:
            return self
        acts = tuple(
            Act(
                one.on,
                np.where(force < 0.0, other.force, one.force),
                np.where(force < 0.0, other.at, one.at),
                one.couple,
            )
            for one, other in zip(self.acts, self.back, strict=True)
        )
        return Shared(self.name, self.first, self.second, self.at, acts)

    def backward(self, column: Column) -> Column:
        """Its column where the other pins carry."""
        assert self.back is not None, "asked where the sides differ only"
        return column._replace(also=self.back)

    def columns(self) -> list[Column]:
        """All shares of the unknown."""
        return [Column(FRAME, self.second, 0j, self.at, 0.0, self.acts)]


@dataclass(frozen=True)
class Flank:
    """A mesh that touches on one flank: a force along the normal there, given by its tangential part.

    Fields
        teeth : Mesh, Rack or ToothDrive
        side : (N,) array - sign of the tangential force
    """

    teeth: Mesh | Rack | ToothDrive
    side: Reals

    @property
    def name(self) -> str:
        """That of the mesh."""
        return self.teeth.name

    @property
    def first(self) -> str:
        """The first link."""
        return self.teeth.first

    @property
    def second(self) -> str:
        """The second link."""
        return self.teeth.second

    def columns(self) -> list[Column]:
        """The tangential force and the separating one with it."""
        (column,), radial = self.teeth.columns(), self.teeth.radial()
        return [column._replace(force=np.asarray(column.force + self.side * radial.force))]


Connection = Pin | Guide | Mesh | Rack | ToothDrive | Contact | Coupling | Feed | SharedContact | Shared | Flank
Toothed = (Mesh, Rack, ToothDrive)


def meshes_of(mechanism: Mechanism) -> list[Mesh | Rack | ToothDrive]:
    """The connections that have teeth."""
    return [each for each in mechanism.connections if isinstance(each, Toothed)]
