"""What many wide swings seek at once: cams that turn evenly, as one whose numbers are columns."""

from __future__ import annotations

import math
from collections.abc import Hashable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.many_designs import hand_in, hand_on, hand_out, in_groups, sought, stacked
from gearlink.core.base.results import keep
from gearlink.core.machines.wide_swing.cam import SHRINK, SMALLEST, WideSwingCam, room_before_middle
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.slider import HalfLaw, SliderLaw
from gearlink.core.numerics.periodic import CosineSeries
from gearlink.core.numerics.roots_sweep import bracketed_roots

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cycle import ClosedCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign

_GEOMETRY = (
    "ratio", "half_sine", "half_cosine", "shortest", "longest", "reach", "stroke", "mounting", "stiffness",
)  # fmt: skip
_LAW = ("_rate", "energy_parameter", "velocity_peak")


def find_together(designs: Sequence[WideSwingDesign], asked: frozenset[str]) -> None:
    """Let designs keep what is found for all of them.

    Parameters
        asked : names of the quantities and checks that will be asked for
    """
    _share_laws(designs)
    cams = [cam for design in designs for cam in _cams_of(design) if cam.given_rocker_radius is None]
    for group in in_groups(cams, lambda cam: (cam.layout, type(cam.law), getattr(cam.law, "late", False))):
        sought(lambda some: _find_cams(some, asked), group)
    if "closed-contour" in asked:
        closed = [cam for design in designs if design.spec.cycle is not None for cam in _contours(design)]
        for cycle in in_groups(closed, _alike):
            sought(_find_free_sectors, cycle)


def _share_laws(designs: Sequence[WideSwingDesign]) -> None:
    """Designs of one device and swing have one law, of which what is known serves all."""
    known: dict[ElasticLaw, ElasticLaw] = {}
    for design in designs:
        with suppress(GearlinkError):
            law = design.motion.plain_law
            keep(design.motion, plain_law=known.setdefault(law, law))


def _cams_of(design: WideSwingDesign) -> list[WideSwingCam]:
    """The cams that turn evenly, or halves of one; what is wrong with others they say themselves."""
    if design.spec.drive is None and design.spec.cam is not None:
        with suppress(GearlinkError):
            if design.spec.slider is not None:
                return list(design.slider_cam.halves)
            return [cam for cam in (design.even_cam, design.return_cam) if cam is not None]
    return []


def _law_of(laws: Sequence[Any]) -> Any:
    """All of them as one."""
    if all(law is laws[0] for law in laws):
        return laws[0]
    if isinstance(laws[0], HalfLaw):
        half = stacked(laws, law=_slider_law_of([law.law for law in laws]))
        hand_in(half, laws, "end_turn", "_fastest_angle", "fastest", "swing")
        return half
    many = _without_time(laws)
    hand_in(many, laws, *_LAW)
    keep(many, _clock_from_middle=CosineSeries.of_many([law._clock_from_middle for law in laws]))
    return many


def _without_time(laws: Sequence[ElasticLaw]) -> ElasticLaw:
    """All of them as one, of which no times are asked."""
    many, geometries = stacked(laws), [law.geometry for law in laws]
    keep(many, geometry=stacked(geometries))
    hand_in(many.geometry, geometries, *_GEOMETRY)
    hand_in(many, laws, "modulus", "modulus_complement")
    return many


def _slider_law_of(laws: Sequence[SliderLaw]) -> SliderLaw:
    if all(law is laws[0] for law in laws):
        return laws[0]
    many = stacked(laws)
    hand_in(many, laws, "stroke", "velocity_peak", "energy_parameter", "_total")
    clocks = {name: CosineSeries.of_many([getattr(law, name) for law in laws]) for name in ("clock", "_clock_from_end")}
    keep(many, _half=_without_time([law._half for law in laws]), **clocks)
    return many


def _as_one(cams: Sequence[WideSwingCam]) -> WideSwingCam:
    return stacked(cams, law=_law_of([cam.law for cam in cams]), angle_words="")


def _find_cams(cams: Sequence[WideSwingCam], asked: frozenset[str]) -> None:
    """Loops; of those without one where the roller touches them, and extremes there."""
    hand_out(_as_one(cams), cams, "least_loop_measure")
    there = [cam for cam in cams if _exists(cam)]
    sought(_find_contacts, [cam for cam in there if cam.transition_zone_estimate >= SMALLEST])
    sought(lambda some: _find_tops(some, asked), [cam for cam in there if _is_touched(cam)])


def _exists(cam: WideSwingCam) -> bool:
    with suppress(NoSolution):
        cam.require_profile()
        return True
    return False


def _is_touched(cam: WideSwingCam) -> bool:
    with suppress(NoSolution):
        return cam.contact_end[0] > 0.0
    return False


def _find_contacts(cams: Sequence[WideSwingCam]) -> None:
    """Where the roller leaves the profile; where it covers the whole the cam says so itself."""
    nearest = min(cam.law.turn_near(min(cam.transition_zone_estimate, 0.5)) / cam.law.end_turn for cam in cams)
    shrunk = np.power(SHRINK, np.arange(math.ceil(math.log(0.01 * nearest, SHRINK)) + 1))
    turns = np.array([[cam.law.end_turn] for cam in cams]) * shrunk
    room = room_before_middle(_as_one(cams), turns)
    first = np.argmax(room < 0.0, axis=1)
    rows = np.flatnonzero(first > 0)
    if not rows.size:
        return
    some, places = [cams[row] for row in rows.tolist()], [(rows, first[rows] - back) for back in (0, 1)]
    many, (low, high) = _as_one(some), (turns[place] for place in places)
    ends = room[places[0]], room[places[1]]
    roots = bracketed_roots(lambda turn: room_before_middle(many, turn[:, None])[:, 0], low, high, ends=ends)
    share = many.law.share_from_middle(-roots[:, None])
    hand_on(some, contact_end=(0.5 + share, -roots[:, None]))


def _find_tops(cams: Sequence[WideSwingCam], asked: frozenset[str]) -> None:
    """Pressure angle and bulge where the roller touches, and its force."""
    many = _as_one(cams)
    hand_in(many, cams, "contact_end")
    hand_out(many, cams, "tops")
    if "contact_force" in asked:
        hand_out(many, cams, "pressing")


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
