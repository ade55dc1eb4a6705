"""What many wide swings seek at once: their laws and cams, as one whose numbers are columns."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from contextlib import suppress
from functools import lru_cache, partial
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.many_designs import column, hand_in, hand_on, hand_out, in_groups, sought, stacked
from gearlink.core.base.results import keep
from gearlink.core.machines.wide_swing.cam import (
    END,
    KNOWN,
    MIDDLE,
    SMALLEST,
    START,
    WideSwingCam,
    roller_room,
    shrinking,
)
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.oscillating_cam import (
    NOISE,
    CrankRockerDrive,
    OscillatingCam,
    aimed_at,
    bend,
    greatest_need,
    places_beside,
)
from gearlink.core.machines.wide_swing.slider import AimedLaw, SliderLaw
from gearlink.core.machines.wide_swing.torques import Unloading
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.periodic import CosineSeries
from gearlink.core.numerics.roots_sweep import bracketed_roots

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cycle import ClosedCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.strokes import AnyCam

_OF_POWER = frozenset(("power_peak", "drive_torque_peak"))
_OF_LAWS = _OF_POWER | {
    *("velocity_peak", "acceleration_peak", "slider_velocity_peak", "slider_acceleration_peak", "dynamic_coefficient")
}
"""Quantities by extremes of the laws of rockers with sliders."""
Part = TypeVar("Part")
_GEOMETRY = (
    "ratio", "half_sine", "half_cosine", "shortest", "longest", "reach", "stroke", "mounting", "stiffness",
)  # fmt: skip
_OF_FORCE = "inertia", "swing", "stroke_time", "device_angle"
_LAW, _CLOCKS = ("_rate", "energy_parameter", "velocity_peak"), ("clock", "_clock_from_middle")


def find_together(designs: Sequence[WideSwingDesign], asked: frozenset[str]) -> None:
    """Let designs keep what is found for all of them.

    Parameters
        asked : names of the quantities and checks that will be asked for
    """
    _share_laws(designs, asked)
    _share_cams(designs)
    cams = _once([cam for design in designs for cam in _cams_of(design) if cam.given_rocker_radius is None])
    for group in in_groups(cams, lambda cam: (cam.layout, type(cam.law))):
        sought(lambda some: _find_cams(some, asked), group)
    driven = [design for design in designs if _is_driven(design)]
    for alike in in_groups(driven, lambda design: isinstance(design.oscillating_cam.law, AimedLaw)):
        sought(_find_driven, alike)
    if "contact_force" in asked:
        moving = [design for design in designs if _is_pressed(design)]
        sought(_find_forces, moving)
    if "closed-contour" in asked:
        whole = [design.cycle for design in designs if design.spec.cycle is not None and design.spec.cam is not None]
        for name in ("main", "back"):
            _share(whole, name)
        closed = _once([cam for design in designs if design.spec.cycle is not None for cam in _contours(design)])
        for cycle in in_groups(closed, _alike):
            sought(_find_free_sectors, cycle)


def _share_laws(designs: Sequence[WideSwingDesign], asked: frozenset[str]) -> None:
    """Designs of one device and swing, and one slider, have one law, of which what is known serves all."""
    alone = [design.motion for design in designs if design.spec.slider is None]
    plain = _share([design.motion for design in designs], "plain_law")
    if alone and asked & _OF_POWER:
        sought(lambda laws: hand_out(law_of(laws), laws, "power_peak"), plain)
    with_slider = [design for design in designs if design.spec.slider is not None]
    sliding = _share([design.motion for design in with_slider], "slider")
    if asked & _OF_LAWS:
        sought(lambda laws: hand_out(law_of(laws), laws, "peaks"), sliding)
    with_cam = [design for design in with_slider if design.spec.cam is not None and "slider" in vars(design.motion)]
    if with_cam and with_cam[0].spec.drive is not None:
        sought(_aim, with_cam)
    sought(_find_aimed, _share(with_cam, "aimed_law"))


def _aim(designs: Sequence[WideSwingDesign]) -> None:
    """Where the rollers of cams on a crank-rocker pass the line of centres."""
    laws, drives = [design.motion.slider for design in designs], [design.motion.drive for design in designs]
    k = places_beside(np.array([law.middle_place for law in laws]))
    values = bend(law_of(laws), _drive_of(drives), k)
    rows, columns = np.nonzero(values[:, :-1] * values[:, 1:] <= 0.0)
    found: list[list[float]] = [[] for _ in designs]
    if rows.size:
        law, drive = law_of([laws[row] for row in rows.tolist()]), _drive_of([drives[row] for row in rows.tolist()])
        ends = (values[rows, columns], values[rows, columns + 1])
        low, high = k[rows, columns], k[rows, columns + 1]
        roots = bracketed_roots(lambda at: bend(law, drive, at[:, None])[:, 0], low, high, ends=ends)
        for row, place in zip(rows.tolist(), roots.tolist(), strict=True):
            found[row].append(place)
    for design, law, places in zip(designs, laws, found, strict=True):
        keep(design, aimed_law=aimed_at(law, places))


def _find_aimed(laws: Sequence[AimedLaw]) -> None:
    many = stacked(laws, law=law_of([law.law for law in laws]))
    hand_out(many, laws, "turns", "_at", "middle_jerk")


def _drive_of(drives: Sequence[CrankRockerDrive]) -> CrankRockerDrive:
    many = stacked(drives)
    hand_in(many, drives, "crank_angles", "_middle")
    return many


def _share_cams(designs: Sequence[WideSwingDesign]) -> None:
    """Designs with alike cams have one of each."""
    some = [design for design in designs if design.spec.drive is None and design.spec.cam is not None]
    for name in ("even_cam", "return_cam", "slider_cam"):
        _share(some, name)


def _share(owners: Sequence[Any], name: str) -> list[Any]:
    """Let owners of alike results have one, and return each of these; what is wrong with others they say themselves."""
    known: dict[Any, Any] = {}
    for owner in owners:
        with suppress(GearlinkError):
            value = getattr(owner, name)
            keep(owner, **{name: known.setdefault(value, value)})
    return list(known)


def _once(parts: Sequence[Part]) -> list[Part]:
    return list({id(part): part for part in parts}.values())


def _cams_of(design: WideSwingDesign) -> list[WideSwingCam]:
    """The cams that turn evenly; what is wrong with others they say themselves."""
    if design.spec.drive is None and design.spec.cam is not None:
        with suppress(GearlinkError):
            if design.spec.slider is not None:
                return [design.slider_cam]
            return [cam for cam in (design.even_cam, design.return_cam) if cam is not None]
    return []


def law_of(laws: Sequence[Any]) -> Any:
    """Laws of one class as one, that has a row for each where they are not the same."""
    return laws[0] if all(law is laws[0] for law in laws) else _many_laws(tuple(laws))


@lru_cache(maxsize=4)
def _many_laws(laws: tuple[Any, ...]) -> Any:
    """Kept for the next search among the same: the places that it has for times are many."""
    if isinstance(laws[0], SliderLaw):
        return _slider_law_of(laws)
    if isinstance(laws[0], AimedLaw):
        aimed = stacked(laws, law=law_of([law.law for law in laws]))
        hand_in(aimed, laws, "turns", "_at")
        return aimed
    many = _without_time(laws)
    hand_in(many, laws, *_LAW)
    keep(many, **{name: CosineSeries.of_many([getattr(law, name) for law in laws]) for name in _CLOCKS})
    return many


def _without_time(laws: Sequence[ElasticLaw]) -> ElasticLaw:
    """All of them as one, of which no times are asked."""
    many, geometries = stacked(laws), [law.geometry for law in laws]
    keep(many, geometry=stacked(geometries))
    hand_in(many.geometry, geometries, *_GEOMETRY)
    hand_in(many, laws, "modulus", "modulus_complement")
    return many


def _slider_law_of(laws: Sequence[SliderLaw]) -> SliderLaw:
    many = stacked(laws)
    hand_in(many, laws, "stroke", "energy_parameter", "_total", "middle_place")
    clocks = {name: CosineSeries.of_many([getattr(law, name) for law in laws]) for name in ("clock", "_clock_from_end")}
    keep(many, _half=_without_time([law._half for law in laws]), **clocks)
    return many


def _as_one(cams: Sequence[WideSwingCam]) -> WideSwingCam:
    return stacked(cams, law=law_of([cam.law for cam in cams]), angle_words="")


def _find_cams(cams: Sequence[WideSwingCam], asked: frozenset[str]) -> None:
    """Loops; of those without one where the roller touches them, and extremes there."""
    hand_out(_as_one(cams), cams, "least_loop_measures")
    there = [cam for cam in cams if _exists(cam)]
    sought(_find_contacts, [cam for cam in there if cam.transition_zone_estimate >= SMALLEST])
    sought(lambda some: _find_tops(some, asked), [cam for cam in there if _is_touched(cam)])


def _exists(cam: AnyCam) -> bool:
    with suppress(NoSolution):
        cam.require_profile()
        return True
    return False


def _is_touched(cam: WideSwingCam) -> bool:
    with suppress(NoSolution):
        return all(0.0 < end < 1.0 for end, _ in cam.contact_ends)
    return False


def _find_contacts(cams: Sequence[WideSwingCam]) -> None:
    """Where the roller leaves the profile; where it covers the whole the cam says so itself."""
    many, sides = _as_one(cams), cams[0].sides(-1.0, 1.0)
    ways = [_turns_from_end(cams, side) for side in sides]
    rooms = [many.room_at(side * turns) for side, turns in zip(sides, ways, strict=True)]
    firsts = [np.argmax(room < 0.0, axis=1) for room in rooms]
    rows = np.flatnonzero(np.min(firsts, axis=0) > 0)
    if not rows.size:
        return
    some = [cams[row] for row in rows.tolist()]
    many, found = _as_one(some), []
    for side, turns, room, first in zip(sides, ways, rooms, firsts, strict=True):
        places = [(rows, first[rows] - back) for back in (0, 1)]
        (low, high), ends = (turns[place] for place in places), (room[places[0]], room[places[1]])
        roots = side * bracketed_roots(partial(_room_on_side, many, side), low, high, ends=ends)[:, None]
        found.append((many.middle + many.law.share_from_middle(roots), roots))
    hand_on(some, contact_ends=tuple(found))


def _turns_from_end(cams: Sequence[WideSwingCam], side: float) -> Reals:
    """Angles of the laws from an end of the stroke to where a contact with k* ends at the latest; a row for each."""
    far = np.array([[abs(cam.law.turns[side > 0.0])] for cam in cams])
    near = [cam.law.turn_near(min(cam.transition_zone_estimate, 0.5)) for cam in cams]
    return shrinking(far, 0.01 * float(np.min(near / far[:, 0])))


def _room_on_side(many: WideSwingCam, side: float, turn: Reals) -> Reals:
    return many.room_at(side * turn[:, None])[:, 0]


def _find_tops(cams: Sequence[WideSwingCam], asked: frozenset[str]) -> None:
    """Pressure angle and bulge where the roller touches, and its force."""
    many = _as_one(cams)
    hand_in(many, cams, "contact_ends")
    hand_out(many, cams, "tops")
    if "contact_force" in asked and many.symmetric:
        hand_out(many, cams, "pressing")


# Cams on the rocker of a crank-rocker


def _is_driven(design: WideSwingDesign) -> bool:
    """Whether the file has a cam on a crank-rocker."""
    if design.spec.drive is None or design.spec.cam is None:
        return False
    with suppress(GearlinkError):
        return design.oscillating_cam.ratio > 0.0
    return False


def _driven(cams: Sequence[OscillatingCam]) -> OscillatingCam:
    """All of them as one."""
    laws = [cam.law for cam in cams]
    many = stacked(cams, law=law_of(laws), drive=_drive_of([cam.drive for cam in cams]))
    hand_in(many.law, laws, "middle_jerk")
    hand_in(many, cams, "_middle", "ratio", "middle_pressure_angle")
    return many


def _find_driven(designs: Sequence[WideSwingDesign]) -> None:
    """Stops; of cams without a loop where the roller touches them, extremes there, and the need of the way home."""
    cams = [design.oscillating_cam for design in designs]
    hand_out(_driven(cams), cams, "stops")
    there = [design for design in designs if _exists(design.oscillating_cam)]
    sought(_find_covers, [design.oscillating_cam for design in there])
    sought(_find_driven_tops, [design for design in there if "contact" in vars(design.oscillating_cam)])


def _find_driven_tops(designs: Sequence[WideSwingDesign]) -> None:
    cams = [design.oscillating_cam for design in designs]
    many = _driven(cams)
    hand_in(many, cams, "stops", "contact")
    hand_out(many, cams, "tops", "max_pressure_angle")
    hand_on([design.unloading for design in designs], way_back=greatest_need(many))


def _find_covers(cams: Sequence[OscillatingCam]) -> None:
    """Where the roller leaves the profile; where it covers half of the stroke the cam says so itself."""
    ends = [(START, 1.0), (MIDDLE, -1.0), (MIDDLE, 1.0), (END, -1.0)]
    found = np.array([_covers(cams, stop, side) for stop, side in ends])
    rows = np.flatnonzero(~np.isnan(found).any(axis=0))
    first, before, after, last = found[:, rows, None]
    hand_on([cams[row] for row in rows.tolist()], contact=((first, before), (after, last)))


def _covers(cams: Sequence[OscillatingCam], stop: int, side: float) -> Reals:
    """`OscillatingCam.cover` of each cam; NaN of those that it refuses."""
    found = np.array([cam.places[stop] for cam in cams])
    estimates = np.array([cam.left(stop) for cam in cams])
    bulging = np.array([cam.stops[stop][0] > 0.0 for cam in cams])
    small = bulging & (estimates < SMALLEST)
    found[small] += side * estimates[small]
    rows = np.flatnonzero(bulging & ~small)
    if rows.size:
        some = [cams[row] for row in rows.tolist()]
        found[rows] += side * _ways(some, stop, side, estimates[rows])
    return found


def _ways(cams: Sequence[OscillatingCam], stop: int, side: float, estimates: Reals) -> Reals:
    """Ways from a stop over which the roller, standing there, covers the profile, as `covered` finds them."""
    many = _driven(cams)
    hand_in(many, cams, "stops")

    def room(t: Reals) -> Reals:
        return roller_room(many.step(many.places[stop] + side * t, stop), many.roller_radius)

    far = np.array([cam.far_from(stop, side) for cam in cams])
    shares = 0.01 * estimates / far
    sizes = [shrinking(1.0, share).size for share in shares.tolist()]
    t = shrinking(far[:, None], float(shares.min()))
    rooms = room(t)
    cut = (rooms < 0.0) & (np.arange(t.shape[1]) < np.array(sizes)[:, None])
    at = np.argmax(cut, axis=1)
    ways = np.where(cut.any(axis=1), np.nan, 0.0)
    ways[rooms[:, 0] <= 0.0] = np.nan
    rows = np.flatnonzero(at > 0)
    if rows.size:
        some = [cams[row] for row in rows.tolist()]
        many = _driven(some)
        hand_in(many, some, "stops")
        low, high = t[rows, at[rows]], t[rows, at[rows] - 1]
        ends = rooms[rows, at[rows]], rooms[rows, at[rows] - 1]
        known = KNOWN + NOISE / low
        ways[rows] = bracketed_roots(lambda t: room(t[:, None])[:, 0], low, high, ends=ends, tolerance=known)
    return ways


def _is_pressed(design: WideSwingDesign) -> bool:
    """Whether the roller touches a cam on a crank-rocker, or one of a rocker that drives a slider."""
    spec = design.spec
    if spec.cam is None or (spec.drive is None and spec.slider is None):
        return False
    with suppress(GearlinkError):
        design.contact_of(design.cam)
        return True
    return False


def _find_forces(designs: Sequence[WideSwingDesign]) -> None:
    cams: list[Any] = [design.cam for design in designs]
    if designs[0].spec.drive is None:
        many: Any = _as_one(cams)
    else:
        many = _driven(cams)
        hand_in(many, cams, "stops")
    hand_in(many, cams, "contact")
    law = many.law.law if isinstance(many.law, AimedLaw) else many.law
    motions = [design.motion for design in designs]
    columns = {name: column([getattr(motion, name) for motion in motions]) for name in _OF_FORCE}
    unloading = Unloading(designs[0].spec, SimpleNamespace(law=law, **columns))  # type: ignore[arg-type]
    reserve = column([design.unloading.size.reserve for design in designs])
    keep(unloading, size=SimpleNamespace(reserve=reserve))
    hand_on(designs, contact_force=unloading.greatest_force(many))


def _contours(design: WideSwingDesign) -> list[ClosedCam]:
    with suppress(NoSolution):
        return list(design.cycle.contours.values())
    return []


def _alike(closed: ClosedCam) -> Hashable:
    return closed.cam.layout, closed.cam.given_rocker_radius is None


def _find_free_sectors(closed: Sequence[ClosedCam]) -> None:
    """Extremes over the sectors in which the other cam guides the rocker."""
    many = stacked(closed, cam=_as_one([each.cam for each in closed]))
    hand_out(many, closed, "free")
