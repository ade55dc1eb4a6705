"""Scenes of disc cams and cylindrical cams: the generic one of the links, with bodies, rollers or the flat face."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.colors import BLUE, GREY, ORANGE, pale
from gearlink.cli.views.scenes.scene import TURN, Body, Chain, Mark, Part, Points, Reals, Scene, track, wheel

if TYPE_CHECKING:
    from gearlink.core.machines.cylindrical_cam.design import CylindricalCamDesign
    from gearlink.core.machines.disc_cam.design import DiscCamDesign
    from gearlink.core.parts.cams.disc_cam import DiscCam


_POINTS = 720


def disc_cam(cam: DiscCam, axis: Points, turn: Reals, color: str) -> Body:
    """A cam whose place at cam angle 0 is its own frame; `turn` counts counter-clockwise."""
    profile = cam.points(TURN * np.arange(_POINTS + 1) / _POINTS)[1]
    profile[-1] = profile[0]
    return Body(outline=profile, place=axis, turn=turn, color=color, fill=pale(color), name=cam.name)


_TURN = 2.0 * math.pi
_CLOSE = np.linspace(0.0, _TURN, 721)
_STEM = 0.8
"""Of the prime radius: how far the rod of a slide is drawn."""
_REACH = 1.15
"""Of the places of contact: how far a flat face is drawn that the file does not bound."""


def build(design: DiscCamDesign, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution of the cam."""
    scene = of_motion.build(design, fraction)
    links = [part for part in scene.parts if getattr(part, "name", "") != "main"]  # the contact is no slot
    return replace(scene, parts=(*_cams(design, fraction), *links, *_followers(design, fraction)))


def _cams(design: DiscCamDesign, fraction: Reals) -> list[Part]:
    cams, turn = design.cams, design.spec.cam.sense * _TURN * fraction
    axis = track(0j, fraction)
    if design.spec.is_flat:
        outline = cams.flat.points(_CLOSE)[0]
        return [Body(outline=outline, place=axis, turn=turn, color=BLUE, fill=pale(BLUE, 0.15), width=1.6)]
    walls = [
        cams.main,
        *([cams.outer_wall] if design.spec.closure == "groove" else []),
        *([cams.back] if cams.back else []),
    ]
    return [disc_cam(cam, axis, turn, color) for cam, color in zip(walls, (BLUE, ORANGE), strict=False)]


def _followers(design: DiscCamDesign, fraction: Reals) -> list[Part]:
    cams, phi = design.cams, _TURN * fraction
    if design.spec.is_flat:
        low, high = cams.flat.contact_places
        touch = cams.flat.touch(phi)
        along = -1j * touch.normal
        if design.spec.oscillates:  # places count from the pivot, along the arm
            along = np.exp(1j * cams.arm_angle(cams.place, phi, 0)[0])
        ends = [touch.point + along * (place - touch.place) for place in (low - 0.1 * (high - low), _REACH * high)]
        return [Chain(joints=(ends[0], ends[1]), color=GREY, marked=False), *_stem(design, touch.point)]
    found: list[Part] = [*_stem(design, cams.main.path(phi, 1).position)]
    for cam, color in ((cams.main, BLUE), (cams.back, ORANGE)):
        if cam is not None:
            center = cam.path(phi, 1).position
            found.append(wheel(center, cam.roller_radius, fraction, color=color, fill=pale(color, 0.3)))
    return found


def _stem(design: DiscCamDesign, start: Points) -> list[Part]:
    """The rod of a follower that slides, from its roller or face on."""
    if design.spec.oscillates:
        return []
    return [Chain(joints=(start, start + _STEM * design.cams.place.radius * design.cams.direction), marked=False)]


_DRUM_STEM = 3.0
"""Radii of the roller that the follower's rod is drawn."""


def build_cylindrical(design: CylindricalCamDesign, fraction: Reals) -> Scene:
    """Positions over fractions of a turn of the cam; the track is drawn over three turns, so that it never ends."""
    scene, drum = of_motion.build(design, fraction), design.drum
    phi = np.linspace(-_TURN, 2.0 * _TURN, 1081)
    upper, lower = (
        -drum.sense * arc + 1j * along for arc, along in (drum.developed(drum.bottom, s, phi) for s in (1, -1))
    )
    outline = np.concatenate((upper, lower[::-1], upper[:1]))
    place = track(drum.sense * drum.bottom * _TURN * fraction + 0j, fraction)
    level, center = np.zeros_like(fraction), 1j * design.follower_motion.evaluate(_TURN * fraction, 0)[0]
    parts = (
        Body(outline=outline, place=place, turn=level, color=BLUE, fill=pale(BLUE, 0.15), width=1.4),
        wheel(center, drum.roller_radius, fraction, color=ORANGE, fill=pale(ORANGE, 0.3)),
        Chain(joints=(center, center + _DRUM_STEM * 1j * drum.roller_radius), marked=False),
    )
    return replace(scene, parts=parts, marks=(Mark(center),))
