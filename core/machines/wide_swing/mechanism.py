"""The mechanism of a wide swing: rocker, cam or cams, links beside them, and what their errors move.

The input angle is that of the cam, or of the crank that swings it, from the start of the working stroke. In a stroke
its own cam guides the rocker, and in the rest after it that cam's arc holds it. The cam axis O is at 0, the rocker's
axis D on the line of centres. The slider stands below D and the crank's pivot 60 deg below the line of centres where
the file does not say which way they stand.
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.machines.wide_swing.strokes import strokes_of
from gearlink.core.mechanism.closures import dyad, slider
from gearlink.core.mechanism.courses import coordinate, turned
from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.joints import Connection, Coupling, Guide, Mesh, Pin, SharedContact
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn, carried, fixed, standing, steady
from gearlink.core.mechanism.vectors import least_transmission
from gearlink.core.numerics.extremes import share_of
from gearlink.core.studies.movable import Errors, Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE, RETURN_ARM, ROLLER_ARM

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.oscillating_cam import CrankRockerDrive
    from gearlink.core.numerics.arrays import Points, Reals


SLIDER_DIRECTION, DRIVE_DIRECTION = -90.0, -60.0
GEARS = "shaft_gears"
"""The pair between parallel cam shafts."""


_TRANSMISSION = least_transmission("C", "F")
"""Where the coupler moves the cam, and the rod the slider."""


def motion(design: WideSwingDesign) -> Motion:
    """Links and joints over the input angle: over a revolution where the file tells all of it, else over the stroke.

    Without `cam` there are the rocker and its slider alone, about D at 0.
    """
    spec = design.spec
    if spec.cam is None:
        return working_stroke(design)
    whole = spec.cycle is not None or spec.drive is not None
    machine = _WithCams(design, whole)
    end, turns = (TURN, 1) if whole else (design.motion.cycle_angle, None)
    given = Input(end=end, turns=turns, joints=machine.joints)
    return Motion(machine.at, given, _outputs(design), design.motion.highest, _TRANSMISSION)


def working_stroke(design: WideSwingDesign) -> Motion:
    """Rocker and slider over the working stroke, by its law alone, about D at 0: whatever the cams are."""

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        return _alone(design, phi, order)

    whole = design.spec.cycle is not None and design.spec.cam is None
    given = Input(end=TURN if whole else design.motion.cycle_angle, turns=1 if whole else None)
    return Motion(make, given, _outputs(design), design.motion.highest, _TRANSMISSION)


def _outputs(design: WideSwingDesign) -> tuple[Output, ...]:
    outputs = [Output("Rocker", turned("rocker"))]
    if design.spec.slider is not None:
        outputs.append(Output("Slider", coordinate("slider", along=slider_way(design))))
    return tuple(outputs)


def slider_way(design: WideSwingDesign) -> complex:
    """The direction from D in which the slider is farthest."""
    return cmath.rect(1.0, _direction(design, "slider_direction", SLIDER_DIRECTION))


def _direction(design: WideSwingDesign, name: str, usual: float) -> float:
    """A direction that the section `loads` gives, or the usual one [rad]."""
    given = getattr(design.spec.loads, name, None)
    return math.radians(usual if given is None else given)


def _alone(design: WideSwingDesign, phi: Reals, order: int) -> Mechanism:
    """The rocker over its working stroke, with its slider, where nothing says what guides it."""
    law, angle, swing = design.motion.law, design.motion.cycle_angle, design.motion.swing
    a, *rates = law.invariants(share_of(phi, angle), order)
    turn = Turn((a - 0.5) * swing, *(swing / angle**n * rate for n, rate in enumerate(rates, 1)))
    links = {"rocker": Link(fixed(0j, phi, order=order), turn)}
    joints: list[Connection] = [Pin("D", FRAME, "rocker", links["rocker"].origin.value)]
    return Mechanism(links, joints, "rocker", travel=_hang_slider(design, links, joints))


class _WithCams:
    """The links at input angles, as the cams guide them."""

    def __init__(self, design: WideSwingDesign, whole: bool) -> None:
        self.design, self.spec, self.whole = design, design.spec, whole
        self.strokes = strokes_of(design)
        self.side = -1.0 if self.spec.layout != "twin-rocker" else 1.0
        """Side of the cam's axis on which the rocker's lies, and sense in which an even cam of the stroke turns."""
        if self.spec.drive is not None:
            phases: tuple[float, ...] = (self.strokes[0].width, 0.0, self.strokes[1].width, 0.0)
        else:
            phases = design.motion.cycle_angles if whole else (self.strokes[0].width,)
        self.edges = np.concatenate(([0.0], np.cumsum(phases)))

    @property
    def joints(self) -> tuple[float, ...]:
        """The ends of the strokes, and where the rollers change sides [rad]."""
        ends = [
            stroke.start + share * stroke.width
            for stroke in self.strokes
            for share in (0.0, stroke.at_profile(stroke.cam.middle), 1.0)
        ]
        return tuple(sorted(angle for angle in ends if angle > 0.0))

    def at(self, phi: Reals, order: int, side: int) -> Mechanism:
        """Rocker, cams and what hangs on them."""
        sector, share = self._share(phi, side)
        turn, place, normal = self._rocker(sector, share, order)
        links, connections, sense, crank = self._driven(phi, order)
        pivot = fixed(complex(self.side * self.design.cam.center_distance), phi, order=order)
        links["rocker"] = Link(pivot, turn, self._rollers)
        connections.append(Pin("D", FRAME, "rocker", pivot.value))
        shares: dict[str, Reals] = {"cam": np.ones(len(phi))}
        if self.design.has_return_cam:
            shares = {"cam": 1.0 * (sector < 2), "return_cam": 1.0 * (sector >= 2)}
        travel = _hang_slider(self.design, links, connections)
        connections.append(SharedContact("roller", "rocker", place, normal, shares))
        drive = "crank" if self.spec.drive is not None else "cam"
        return Mechanism(links, connections, drive, sense, crank, travel)

    @cached_property
    def _rollers(self) -> dict[str, complex]:
        """The two rollers of a twin rocker on it [mm], which its cams guide in turn."""
        if self.spec.cycle is None or self.spec.layout != "twin-rocker":
            return {}
        pivot, start = complex(self.side * self.design.cam.center_distance), np.zeros(1)
        places = [(stroke.roller(start)[0][0] - pivot, stroke.turn(start, 0).value[0]) for stroke in self.strokes]
        return {name: complex(arm * np.exp(-1j * turn)) for name, (arm, turn) in
                zip(("roller", "return_roller"), places, strict=True)}  # fmt: skip

    def _share(self, phi: Reals, side: int) -> tuple[Any, Reals]:
        """Number of the phase in which input angles lie (0 to 3), and the fraction of the phase that has passed."""
        edges = self.edges
        turned_by = np.mod(phi, TURN) if self.whole else phi
        sector = np.searchsorted(edges[1:-1], turned_by, side="right" if side > 0 else "left")
        width = np.where(np.diff(edges) > 0.0, np.diff(edges), 1.0)
        # The phases add up to the turn but for rounding, and what asks on which side of its end a stroke changes sign
        # looks a millionth of a radian beyond it, where the rocker rests.
        return sector, share_of(turned_by - edges[sector], width[sector])

    def _rocker(self, sector: Any, share: Reals, order: int) -> tuple[Turn, Points, Points]:
        """The rocker's angle, the centre of the guided roller [mm], and the direction in which its cam pushes it."""
        rows = len(share)
        turn, place, normal = np.zeros((order + 1, rows)), *np.zeros((2, rows), dtype=np.complex128)
        for number, stroke in enumerate(self.strokes):
            moving, resting = sector == 2 * number, sector == 2 * number + 1
            if moving.any():
                turn[:, moving] = stroke.turn(share[moving], order)
                place[moving], normal[moving] = stroke.roller(share[moving])
            if resting.any():
                turn[0, resting] = stroke.turn(np.ones(1), 0).value
                place[resting], normal[resting] = stroke.roller(np.ones(1), resting=True)
        return Turn(*turn), place, normal

    def _driven(self, phi: Reals, order: int) -> tuple[dict[str, Link], list[Connection], float, complex]:
        """The cams with what drives them, their pins, the sense of the driven link and its pivot [mm]."""
        axis = fixed(0j, phi, order=order)
        if self.spec.drive is not None:
            direction = _direction(self.design, "drive_direction", DRIVE_DIRECTION)
            return with_drive(phi, axis, self.design.motion.drive, direction)
        links: dict[str, Link] = {}
        connections: list[Connection] = []
        shafts = (("cam", "O", self.side), ("return_cam", "O_return", -self.side))[: 1 + self.design.has_return_cam]
        for (name, pin, way), stroke in zip(shafts, self.strokes, strict=False):
            # its roller stands on the line of centres at the middle of its stroke
            axis, middle = fixed(stroke.shaft, phi, order=order), stroke.start + stroke.cam.middle * stroke.width
            links[name] = Link(axis, steady(phi, way, cmath.phase(stroke.toward) - way * middle, order=order))
            connections.append(Pin(pin, FRAME, name, axis.value))
        if len(shafts) > 1:
            connections.append(self._train(fixed(0j, phi, order=order)))
        return links, connections, self.side, 0j

    def _train(self, axis: Point) -> Connection:
        """What turns the second cam against the first: the pair of parallel shafts, or a reversing train."""
        if self.spec.gears is None:
            return Coupling("train", "cam", "return_cam", axis.value, -1.0)
        radius = 0.5 * abs(self.strokes[1].shaft)
        tangent = math.tan(self.design.shafts.gears.working_pressure_angle)
        toward = self.strokes[1].shaft / (2.0 * radius)
        return Mesh(GEARS, "cam", "return_cam", axis.value, toward, radius, radius, tangent)


def _hang_slider(design: WideSwingDesign, links: dict[str, Link], joints: list[Connection]) -> dict[str, complex]:
    """Put rod and slider to the rocker, where the file has them, their pins E and F, and the guide.

    Returns
        travel : direction in which the slider is farthest from D, by its link
    """
    if design.spec.slider is None:
        return {}
    rocker, drive, away = links["rocker"], design.motion.slider.drive, slider_way(design)
    pin = rocker.at(drive.crank * cmath.rect(1.0, drive.middle_angle) * away)
    line = complex(rocker.origin.value[0]) - 1j * away * drive.offset
    turn, block = slider(pin, drive.rod, line, away)
    links["rod"] = Link(pin, turn)
    links["slider"] = Link(block, standing(cmath.phase(away), turn.value, order=turn.order))
    joints += [
        Pin("E", "rocker", "rod", pin.value),
        Pin("F", "rod", "slider", block.value),
        Guide("guide", FRAME, "slider", block.value, away),
    ]
    return {"slider": away}


def with_drive(
    phi: Reals, axis: Point, drive: CrankRockerDrive, direction: float
) -> tuple[dict[str, Link], list[Connection], float, complex]:
    """Crank, coupler and cam, the pins A, B, C and O, the sense in which the crank turns, and the place of its pivot.

    Parameters
        phi : (N,) array [rad] - input angle from the start of the stroke
        axis : Point [mm] - of the cam, on which the rocker of the crank-rocker turns
        drive : CrankRockerDrive [mm]
        direction : float [rad] - from the cam's axis to the crank's pivot
    Notes
        The cam turns clockwise in the stroke; a crank-rocker whose rocker turns the other way is mirrored.
    """
    bar, sense = drive.linkage, -drive.rising
    place = complex(axis.value[0]) + bar.frame * cmath.rect(1.0, direction)
    turn = steady(phi, sense, direction + math.pi + sense * drive.crank_angles[0], order=axis.order)
    pivot = fixed(place, phi, order=axis.order)
    pin = carried(pivot, turn, bar.crank)
    along, cam = dyad(pin, axis, bar.coupler, bar.rocker, round(sense) * bar.assembly)
    links = {"crank": Link(pivot, turn), "coupler": Link(pin, along), "cam": Link(axis, cam)}
    end = axis.value + bar.rocker * np.exp(1j * cam.value)
    joints: list[Connection] = [
        Pin("A", FRAME, "crank", pivot.value),
        Pin("B", "crank", "coupler", pin.value),
        Pin("C", "coupler", "cam", end),
        Pin("O", FRAME, "cam", axis.value),
    ]
    return links, joints, sense, place


def errors(design: WideSwingDesign, mechanism: Mechanism) -> Movable:
    """The distance of the axes, the cam's profile, the roller and its arm, and the play of the roller on its pin."""
    if design.spec.cam is None:
        return Movable()
    away = float(mechanism.links["rocker"].origin.value[0].real)
    farther = (Shift(FRAME, ("D",), 1.0 if away > 0.0 else -1.0),)
    outwards = (Shift("rocker", ("roller",), -1.0, "normal"),)  # as if the roller stood nearer to its cam
    sizes: dict[str, tuple[Shift, ...]] = {
        "cam.center_distance": farther,
        "centers.cam": farther,
        CAM_PROFILE: outwards,
        "cam.roller_radius": outwards,
    }
    others = {CAM_PROFILE: 0.0}
    if design.spec.layout != "twin-rocker" or design.spec.cycle is None:  # else there are two, that point apart
        sizes[ROLLER_ARM] = (Shift("rocker", ("roller",), 1.0, "arm"),)
        others[ROLLER_ARM] = design.cam.rocker_radius
    if design.section.second is not None:
        sizes |= _shafts(design, mechanism)
        others[RETURN_ARM] = design.shafts.cams[1].rocker_radius
    if "crank" in mechanism.links:
        bar = design.motion.drive.linkage
        sizes |= longer(mechanism, {"drive.crank": ("crank", bar.crank), "drive.coupler": ("coupler", bar.coupler)})
    return Movable(
        sizes,
        {"cam": abs(away)},
        others=others,
        pins={"roller": (Shift("rocker", ("roller",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=design.spec.output_radius or 0.0,
        places=_dwells(design),
    )


def _shafts(design: WideSwingDesign, mechanism: Mechanism) -> Errors:
    """Of two cam shafts: each has its own distance from the rocker's axis and its own arm with a roller."""
    sizes: dict[str, tuple[Shift, ...]] = dict.fromkeys(
        ("cam.center_distance", "centers.cam"), (Shift(FRAME, ("O",), 1.0),)
    )
    if "return_cam" not in mechanism.links:
        return sizes
    _, second = design.shafts.shafts
    per_degree = 1j * math.radians(1.0) * second
    # a longer arm is the same as a cam that stands back along it
    return sizes | {
        "cam.second.center_distance": (Shift(FRAME, ("O_return",), second / abs(second)),),
        "cam.second.direction": (Shift(FRAME, ("O_return",), per_degree),),
        ROLLER_ARM: (Shift("cam", ("roller",), -1.0, "arm"),),
        RETURN_ARM: (Shift("return_cam", ("roller",), -1.0, "arm"),),
    }


def _dwells(design: WideSwingDesign) -> dict[str, tuple[float, float]]:
    """The far dwell of a cycle, where the arc of the working cam holds the rocker; its errors do not change there."""
    if design.spec.cycle is None:
        return {}
    working, far, _, _ = design.motion.cycle_angles
    return {} if far == 0.0 else {"dwell": (working + 0.5 * far, working + 0.5 * far)}
