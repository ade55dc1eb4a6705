"""Whether bodies in the plane of the gears keep clear of each other, links of axes of the frame, axes of each other.

A machine lists its gears, its shafts and how near their axes come; GL301 and GL302 judge every pair.

All gears of a train lie in one plane, and the shafts of the frame pass through it unless they end before it (are
overhung). Two bodies cannot meet that share an axis, are one rigid body, or are gears in mesh. Links and the pins
between them lie in planes beside that of the gears; design files give them no width.

Links are lines of no width. Arms that turn about a pivot are taken in closed form, other lines by their ends.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import chain, combinations, product
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from gearlink.core.base.judged import Judged
from gearlink.core.base.remedies.ways import THINNEST, down, thinner
from gearlink.core.base.report import Check
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.parts.linkages.codes import GEAR_COLLISION, SHAFT_CLEARANCE

if TYPE_CHECKING:
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.parts.gears.mesh.pair import GearPair
    from gearlink.core.parts.linkages.fourbar.position import FourBar


LEAST_SHAFT_MODULES = 2.0
FULL_HEIGHT = 2.25
"""Height of standard teeth, in modules."""
_TOUCHING = 1e-9
"""Gaps [mm] are differences of sizes: one that meets its limit in the drawing must not fail by their rounding."""


class Gear(NamedTuple):
    """A gear by its circles.

    Parameters
        name : str - "the idler"
        axis : str - letter of the joint on which it sits
        outer : float [mm] - tip radius; of a ring gear its rim's
        inner : float [mm] - tip radius of a ring gear, within which a body may lie; an external gear has none
        mates : str - letters of the axes whose gears mesh with it; it is enough if one of two mates names the other
        turns_with : str - letters of the shafts that are one body with it, which may pass through its blank
        root : float [mm] - root radius, where a shaft may be within the gear on its own axis; None elsewhere
    """

    name: str
    axis: str
    outer: float
    inner: float = -math.inf
    mates: str = ""
    turns_with: str = ""
    root: float | None = None


class Shaft(NamedTuple):
    """A shaft of the frame that passes through the plane of the gears.

    Parameters
        name : str - "input shaft"
        axis : str - letter of its axis
        radius : float [mm] - None where the file does not name it: a bare axis
        key : str - the design file's key of the radius
    """

    name: str
    axis: str
    radius: float | None
    key: str

    @property
    def inner(self) -> float:
        """No hole."""
        return -math.inf

    @property
    def outer(self) -> float:
        """Radius [mm], 0 for a bare axis."""
        return 0.0 if self.radius is None else self.radius


class Seat(NamedTuple):
    """A gear on a shaft of the file: the rim that its teeth leave round the shaft, and the least that bears them [mm].

    Source
        ISO 6336-3: no root stress is given for a rim of half the height of the teeth and less
    """

    gear: Gear
    shaft: Shaft
    rim: float
    least: float


class Clearance(NamedTuple):
    """The minimum gap [mm] of two bodies, negative where they overlap, and its input angle [rad], None for any."""

    one: Gear | Shaft
    other: Gear | Shaft
    gap: float
    distance: float
    angle: float | None

    @property
    def bare(self) -> tuple[Shaft, ...]:
        """Shafts of the two whose radius the file does not name."""
        return tuple(body for body in (self.one, self.other) if isinstance(body, Shaft) and body.radius is None)


def least_gap(one: Gear | Shaft, other: Gear | Shaft, reach: Reach) -> Clearance:
    """The minimum gap of two bodies over the cycle.

    max(r_min - o_1 - o_2, i_1 - r_max - o_2, i_2 - r_max - o_1)

    Parameters
        one, other : bodies with outer radius o, and i where another may lie within
        reach : Reach - minimum and maximum distance of their axes
    Notes
        Beside each other at the nearest, or one within the other's ring at the farthest: a body that passes from
        within a ring to without meets its teeth, so that none of the three is positive.
    Example
        >>> from gearlink.core.studies.clearance import Reach
        >>> ring = Gear("the ring gear", "A", outer=81.5, inner=73.0)
        >>> least_gap(ring, Shaft("shaft at D", "D", 5.0, ""), Reach(60.0, 60.0)).gap
        8.0

    Source
        thesis 4.2.2, with the distance at the closest instead of the frame length
    """
    beside, *within = gaps(one, other, reach.nearest, reach.farthest)
    if beside >= max(within):
        return Clearance(one, other, beside, reach.nearest, reach.nearest_at)
    return Clearance(one, other, max(within), reach.farthest, reach.farthest_at)


def gaps(one: Gear | Shaft, other: Gear | Shaft, nearest: Any, farthest: Any) -> tuple[Any, Any, Any]:
    """The three terms of `least_gap`, of numbers or of arrays: beside each other, and one within the other's ring."""
    within = one.inner - (farthest + other.outer), other.inner - (farthest + one.outer)
    return nearest - (one.outer + other.outer), *within


def gear_meetings(gears: Iterable[Gear]) -> Iterator[tuple[Gear, Gear]]:
    """Every two gears that do not mesh; of numbers or of arrays."""
    return ((a, b) for a, b in combinations(gears, 2) if a.axis not in b.mates and b.axis not in a.mates)


def shaft_meetings(gears: Iterable[Gear], shafts: tuple[Shaft, ...]) -> Iterator[tuple[Gear | Shaft, Gear | Shaft]]:
    """Every gear with every shaft that it does not turn with, then every two shafts; of numbers or of arrays."""
    of_gears = ((gear, shaft) for shaft in shafts for gear in gears if shaft.axis not in gear.turns_with)
    return chain(of_gears, combinations(shafts, 2))


@dataclass(frozen=True)
class Layout:
    """Gears and shafts of a machine, and how near their axes come.

    Parameters
        gears, shafts : bodies
        reaches : mapping - Reach of two axes by their letters in alphabetical order, "AD"; missing where the bodies
            are one, or where the design leaves the distance free
        least_shaft : float [mm] - radius of the thinnest shaft that would be built
    """

    gears: tuple[Gear, ...]
    shafts: tuple[Shaft, ...]
    reaches: Mapping[str, Reach]
    least_shaft: float

    @cached_property
    def gear_pairs(self) -> tuple[Clearance, ...]:
        """Every two gears that do not mesh."""
        return tuple(self._gaps(gear_meetings(self.gears)))

    @cached_property
    def shaft_pairs(self) -> tuple[Clearance, ...]:
        """Every gear against every shaft that it does not turn with, then the shafts against each other."""
        return tuple(self._gaps(shaft_meetings(self.gears, self.shafts)))

    def _gaps(self, pairs: Iterable[tuple[Gear | Shaft, Gear | Shaft]]) -> Iterator[Clearance]:
        for one, other in pairs:
            reach = self.reaches.get("".join(sorted(one.axis + other.axis)))
            if reach is not None:
                yield least_gap(one, other, reach)

    @property
    def gear_gap(self) -> float | None:
        """Minimum gap of the gears that do not mesh [mm]; None where all mesh."""
        return min((pair.gap for pair in self.gear_pairs), default=None)


def seats(gears: Iterable[Gear], shafts: Iterable[Shaft]) -> Iterator[Seat]:
    """Every gear on the axis of a shaft that the file names; of numbers or of arrays."""
    for gear, shaft in product(gears, shafts):
        if gear.axis == shaft.axis and gear.root is not None and shaft.radius is not None:
            yield Seat(gear, shaft, gear.root - shaft.radius, 0.5 * (gear.outer - gear.root))


def ring_gear(axis: str, mesh: GearPair, mates: str = "", rim: float | None = None) -> Gear:
    """The ring gear of an internal mesh, on its axis, with the outer radius that the file gives [mm]."""
    from gearlink.core.parts.gears.tooth.teeth import rim_radius

    outer = rim_radius(mesh.root_radius[1], mesh.module, rim)
    return Gear("the ring gear", axis, outer, abs(mesh.tip_radius[1]), mates)


class Limits(Protocol):
    """What a layout reads of a spec's `limits`."""

    @property
    def least_shaft(self) -> float | None: ...


def least_shaft(limits: Limits, module: float) -> float:
    """Radius of the thinnest shaft that would be built [mm]: given, or 2 modules."""
    return LEAST_SHAFT_MODULES * module if limits.least_shaft is None else limits.least_shaft


def shafts_at(axes: str, section: object) -> tuple[Shaft, ...]:
    """The shafts at axes of the frame, with the radii that the file's section `shafts` names.

    Parameters
        axes : str - letters
        section : the section, whose keys are A_radius and so on, or None
    """
    keys = [f"{axis}_radius" for axis in axes]
    return tuple(
        Shaft(f"shaft at {axis}", axis, getattr(section, key, None), f"shafts.{key}")
        for axis, key in zip(axes, keys, strict=True)
    )


class Near(NamedTuple):
    """The minimum distance [mm] of a place from what turns, and how far that has turned there [rad]."""

    distance: float
    turned: float


def beside_turning_arm(place: complex, arm: complex, sweep: float) -> Near:
    """A place from the line pivot-end of an arm over its sweep: 0 where the arm passes over it.

    Parameters
        place : complex [mm] - seen from the pivot
        arm : complex [mm] - from the pivot to the end at the start of the sweep
        sweep : float [rad] - turned in all, its sign the sense; less than a revolution
    Returns
        near : Near - `turned` positive in the sense of the sweep
    Example
        >>> beside_turning_arm(50j, 100 + 0j, math.pi).distance, beside_turning_arm(-5 - 3j, 100 + 0j, 3.0).turned
        (0.0, 3.0)
    """
    seen = _ahead(place, arm, sweep)
    lead, length = cmath.phase(seen) % math.tau, abs(arm)
    if lead <= abs(sweep):
        return Near(max(abs(seen) - length, 0.0), lead)
    ends = ((_beside(seen * cmath.exp(-1j * turned), length), turned) for turned in (0.0, abs(sweep)))
    return Near(*min(ends))


def beside_turning_pin(place: complex, arm: complex, sweep: float) -> Near:
    """A place from the end of an arm over its sweep; parameters and result as of `beside_turning_arm`.

    Example
        >>> beside_turning_pin(50j, 100 + 0j, math.pi).distance
        50.0
    """
    seen = _ahead(place, arm, sweep)
    lead, length = cmath.phase(seen) % math.tau, abs(arm)
    if lead <= abs(sweep):
        return Near(abs(abs(seen) - length), lead)
    return Near(*min((abs(seen * cmath.exp(-1j * turned) - length), turned) for turned in (0.0, abs(sweep))))


def beside_line(place: Points | complex, start: Points, end: Points | complex) -> Reals:
    """Distance of a place from the line between two joints, at every position of them.

    Parameters
        place : complex or (N,) array [mm]
        start, end : (N,) arrays [mm] - which never coincide; an end that stands still may be one place
    Returns
        distance : (N,) array [mm]
    Example
        >>> import numpy as np
        >>> beside_line(1 + 2j, np.array([0j, 2 + 2j]), np.array([4 + 0j, 4 + 2j])).tolist()
        [2.0, 1.0]
    """
    import numpy as np

    line, seen = end - start, place - start
    along = (seen.real * line.real + seen.imag * line.imag) / (line.real**2 + line.imag**2)
    return np.abs(np.clip(along, 0.0, 1.0) * line - seen)


def _ahead(place: complex, arm: complex, sweep: float) -> complex:
    """The place seen along the arm at its start, mirrored where the sweep is clockwise."""
    seen = place * arm.conjugate() / abs(arm)
    return seen if sweep >= 0.0 else seen.conjugate()


def _beside(seen: complex, length: float) -> float:
    return abs(seen - min(max(seen.real, 0.0), length))


SHAFT_WAYS = (*thinner(*(f"shafts.{name}_radius" for name in ("input", "output", *"ADEOW"))), down("gears.rim"))
"""How a file may be changed where a shaft is not clear."""


def collision_check(pair: Clearance, limit: float, why: str, remedy: str) -> Check:
    """GL301: two gears that do not mesh.

    Parameters
        pair : Clearance - of two gears
        limit : float [mm] - minimum gap
        why, remedy : str - which lengths make the gap, and what would give the gears room
    Notes
        A limit below 0 allows gears that overlap, which is a warning: they do not turn in one plane.
    """
    gap, names = pair.gap, f"{pair.one.name} and {pair.other.name}"
    judged = collision_judged(gap, limit)
    note = "the gears must lie in separate planes, as limits.gear_gap allows" if judged.warns else ""
    fix = "put the gears in separate planes" if judged.warns else remedy
    return judged.check(
        f"gap between the tips of {names}",
        fix,
        at=_place(pair),
        aside=why,
        overlap=f"interference of {names}",
        note=note,
    )


def collision_judged(gap: Any, limit: Any) -> Judged:
    """GL301 of gaps of gears that do not mesh [mm]."""
    keeps = gap >= limit - _TOUCHING
    return Judged(GEAR_COLLISION, gap, limit, keeps ^ True, keeps & (gap < -_TOUCHING), "mm")


def shaft_checks(layout: Layout) -> Iterator[Check]:
    """GL302: every gear against every shaft, and the shafts against each other.

    Notes
        A shaft of the file must be clear. Beside the axis of one that the file does not name there must be room for
        the thinnest shaft that would be built; less is a warning, since that shaft may end before the gears.
    """
    pairs = layout.shaft_pairs
    room = _room(pairs)
    for pair in pairs:
        bare = pair.bare
        limit = layout.least_shaft * len(bare)
        judged = shaft_judged(pair.gap, limit, bool(bare))
        yield _shaft_check(judged, pair, bare, room)


def _room(pairs: Iterable[Clearance]) -> dict[str, float]:
    """What all bodies together leave to a shaft at the axis of each that the file does not name [mm], by its key."""
    room: dict[str, float] = {}
    for pair in pairs:
        if len(pair.bare) == 1:
            (shaft,) = pair.bare
            room[shaft.key] = min(pair.gap, room.get(shaft.key, math.inf))
    return room


def shaft_judged(gap: Any, limit: Any, bare: Any) -> Judged:
    """GL302 of gaps of gears and shafts [mm], at axes that are bare a warning."""
    low = (gap >= limit - _TOUCHING) ^ True
    return Judged(SHAFT_CLEARANCE, gap, limit, low & (bare ^ True), low & bare, "mm")


class WithShafts:
    """GL302 of a design whose gears and shafts lie in one plane, which its `layout` gives."""

    layout: Any

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302 of gears and shafts; see `shaft_checks`."""
        return shaft_checks(self.layout)

    def check_shaft_seat(self) -> Iterator[Check]:
        """GL302 of the rims of gears round their own shafts; see `seat_checks`."""
        return seat_checks(self.layout)


def seat_checks(layout: Layout) -> Iterator[Check]:
    """GL302: every gear whose own shaft leaves its teeth no rim that bears them; a warning, since they may be cut into
    the shaft. Nothing where all have one."""
    for seat in seats(layout.gears, layout.shafts):
        if seat.rim < seat.least:
            yield _thin_rim(seat)


def _place(pair: Clearance) -> str:
    """Where in the cycle; empty where the gap never changes."""
    return "" if pair.angle is None else f"input angle {short(math.degrees(pair.angle))} deg"


def _words(body: Gear | Shaft) -> str:
    if isinstance(body, Gear):
        return body.name
    return f"the axis of the {body.name}" if body.radius is None else f"the {body.name}"


def _shaft_check(judged: Judged, pair: Clearance, bare: tuple[Shaft, ...], room: Mapping[str, float]) -> Check:
    """GL302 of one body and one shaft; the radius that is named is clear of every other body too."""
    one, other = _words(pair.one), _words(pair.other)
    named = [body for body in (pair.one, pair.other) if isinstance(body, Shaft) and body.radius is not None]
    aside = ", ".join(f"{body.name} radius {body.radius:g} mm" for body in named)
    fix = ""
    if judged.fails:
        fix = "end the shaft before the plane of the gears (overhung)"
    elif judged.warns:
        fix = f"end the {bare[0].name} before the plane of the gears (overhung)"
        # In whole tenths that can be built; the last bit of a gap is rounding.
        radius = math.floor(10.0 * room.get(bare[0].key, pair.gap) - 1e-9) / 10.0
        if len(bare) == 1 and radius >= THINNEST * judged.limit:
            fix = f"set {bare[0].key} to at most {radius:g} mm"
        if pair.gap >= 0.0:
            aside = f"{'two minimum shaft radii' if len(bare) > 1 else 'minimum shaft radius'}, limits.least_shaft"
        else:
            aside = f"axes {short(pair.distance)} mm apart"
    overlap = f"overlap of {one} and {other}"
    return judged.check(f"distance of {one} from {other}", fix, at=_place(pair), aside=aside, overlap=overlap)


def _thin_rim(seat: Seat) -> Check:
    what, name = f"rim of {seat.gear.name} between its teeth and {_words(seat.shaft)}", SHAFT_CLEARANCE.checks[1]
    overlap = f"overlap of the teeth of {seat.gear.name} and {_words(seat.shaft)}"
    return SHAFT_CLEARANCE.check(
        "warn",
        what,
        seat.rim,
        seat.least,
        "mm",
        name=name,
        overlap=overlap,
        aside="half the tooth height" if seat.rim >= 0.0 else "",
        fix=f"reduce {seat.shaft.key}, or cut the teeth into the shaft",
    )


_TURN = 2.0 * math.pi


class Reach(NamedTuple):
    """Minimum and maximum distance of two axes [mm] and the input angles [rad] where they occur.

    Notes
        The angles are None where the distance never changes.
    """

    nearest: float
    farthest: float
    nearest_at: float | None = None
    farthest_at: float | None = None


def constant(distance: float) -> Reach:
    """Two axes on one link, or both in the frame.

    Parameters
        distance : float [mm]
    """
    return Reach(distance, distance)


def crank_pin(crank: float, frame: float, start: float = 0.0, end: float = _TURN) -> Reach:
    """The pin of a turning link against an axis of the frame.

    |BD|^2 = (d - a)^2 + 4 a d sin^2(phi/2)

    Parameters
        crank : float [mm] - a, the link AB that turns about A
        frame : float [mm] - d = AD; phi counts from A->D
        start, end : float [rad] - the input angles that are passed
    Returns
        reach : Reach - |d - a| and d + a where the range passes them, else the distances at its ends
    Example
        >>> crank_pin(18.0, 121.4).nearest, round(crank_pin(10.0, 61.0, math.radians(60.0), math.pi).nearest, 9)
        (103.4, 56.665686266)
    """
    ends = [
        (math.hypot(frame - crank, 2.0 * math.sqrt(crank * frame) * math.sin(0.5 * phi)), phi) for phi in (start, end)
    ]
    folded, stretched = _first_passed(0.0, start, end), _first_passed(math.pi, start, end)
    near = min(ends) if folded is None else (abs(frame - crank), folded)
    far = max(ends) if stretched is None else (frame + crank, stretched)
    return Reach(near[0], far[0], near[1], far[1])


def _first_passed(angle: float, start: float, end: float) -> float | None:
    """The first input angle of a range that is the given one up to whole revolutions."""
    place = angle + _TURN * math.ceil((start - angle) / _TURN)
    return place if place <= end else None


def coupler_joint(linkage: FourBar) -> Reach:
    """The coupler joint C against the crank pivot A over a revolution of the crank.

    Parameters
        linkage : FourBar - its crank turns fully
    Raises
        NoSolution - as `joint_to_crank_pivot`
    Example
        >>> from gearlink.core.parts.linkages import FourBar
        >>> coupler_joint(FourBar(18.0, 50.0, 100.0, 121.4)).nearest
        32.0
    """
    from gearlink.core.parts.linkages.fourbar.nearest_passes import joint_to_crank_pivot

    near, far = joint_to_crank_pivot(linkage)
    return Reach(near.distance, far.distance, near.crank_angle, far.crank_angle)


def reaches(
    motion: Motion, axes: Mapping[str, tuple[str, complex | str]], pairs: Iterable[str] = (), *, samples: int = 2048
) -> dict[str, Reach]:
    """Reaches of axes over all inputs of a motion, searched together.

    Parameters
        axes : by letter - the link that an axis stands on, "frame" among them, and the point of it [mm]
        pairs : two letters each; without them every two axes
        samples : int - places over the inputs that are looked at first
    Returns
        reaches : by pair - the places within the period or range of the input
    Raises
        NoSolution - where the mechanism does not close
    """
    import numpy as np

    from gearlink.core.numerics.extremes import extremes_over
    from gearlink.core.numerics.together import kept_last

    def places(phi: Reals) -> dict[str, Points]:
        links = motion.at(phi, 0).links
        return {
            name: np.full(phi.shape, at, dtype=np.complex128) if link == "frame" else links[link].at(at).value
            for name, (link, at) in axes.items()
        }

    placed, asked = kept_last(places), [*pairs] or ["".join(pair) for pair in combinations(axes, 2)]

    def distance(one: str, other: str) -> Callable[[Reals], Reals]:
        return lambda phi: np.asarray(np.abs(placed(phi)[one] - placed(phi)[other]))

    given = motion.input
    distances = [distance(pair[0], pair[1]) for pair in asked]
    wanted = [(each, greatest) for each in distances for greatest in (False, True)]
    found = iter(extremes_over(wanted, given.start, given.end, joints=given.joints, samples=samples))
    near_far = {pair: (next(found), next(found)) for pair in asked}
    return {pair: Reach(near.value, far.value, near.place, far.place) for pair, (near, far) in near_far.items()}
