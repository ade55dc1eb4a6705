"""A Geneva drive: sizes, motion, forces on the pin, and its comparison with a gear linkage and a cam."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, in_section
from gearlink.core.base.real_speed import RealSpeed, per_time
from gearlink.core.base.remedies.ways import down, either, thinner, up
from gearlink.core.base.report import Check, Status, Table, safely_above, safely_below, without_noise
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short
from gearlink.core.mechanism.courses import motion_table, of_output, turned
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import NEWTON_METER, Connection, Pin, SharedContact
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Turn, fixed, steady
from gearlink.core.numerics.arrays import Mask, Points, Reals, turn_degrees, units
from gearlink.core.numerics.elementary import triangle_angle
from gearlink.core.parts.linkages.codes import LOCKING, PIN_ENTRY, SHAFT_CLEARANCE, STEP_RATE
from gearlink.core.studies.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.geneva.spec import GenevaDriveSpec
    from gearlink.core.numerics.extremes import Extreme


_NEAR = 8.0
"""Units in the last place by which an angle may lie beside an end of the motion and be it."""


@dataclass(frozen=True)
class Geneva:
    """A wheel of radial slots and a crank.

    Fields
        distance : float [mm] - of the axes
        sign : float - +1 external, -1 internal
    Source
        thesis 4.2.1; own derivation: the pin enters along the slot, so that the speed has no step
    """

    slots: int
    pins: int
    distance: float
    sign: float

    @cached_property
    def ratio(self) -> float:
        """Crank radius over the distance of the axes, sin(pi/n)."""
        return math.sin(math.pi / self.slots)

    @property
    def crank(self) -> float:
        """Radius of the pin's circle [mm]."""
        return self.distance * self.ratio

    @property
    def wheel(self) -> float:
        """Radius of the wheel to the mouths of its slots [mm]."""
        return self.distance * math.cos(math.pi / self.slots)

    @property
    def step(self) -> float:
        """Angle of the wheel in a step [rad]."""
        return TURN / self.slots

    @property
    def half(self) -> float:
        """Crank angle from the line of centres to where the pin leaves its slot [rad]."""
        return 0.5 * math.pi - self.sign * math.pi / self.slots

    def rates(self, f: Reals, order: int) -> list[Reals]:
        """Angle of the wheel and its derivatives while a pin is in a slot.

        psi = atan2(l sin f, 1 - s l cos f),  W = l (cos f - s l)/Q,  W' = -l (1 - l^2) sin f/Q^2,
        W'' = -l (1 - l^2) (Q cos f - 4 s l sin^2 f)/Q^3,  Q = 1 + l^2 - 2 s l cos f

        Parameters
            f : (N,) array [rad] - crank angle from the line of centres, within +-half
            order : int - 0 to 3
        Returns
            rates : order + 1 arrays [rad]
        """
        lam, s = self.ratio, self.sign
        cos, sin = np.cos(f), np.sin(f)
        q = 1.0 + lam * lam - 2.0 * s * lam * cos
        part = -lam * (1.0 - lam * lam)
        found = [
            np.arctan2(lam * sin, 1.0 - s * lam * cos),
            lam * (cos - s * lam) / q,
            part * sin / q**2,
            part * (q * cos - 4.0 * s * lam * sin**2) / q**3,
        ]
        return [np.asarray(each) for each in found[: order + 1]]

    def over(self, phi: Reals, order: int, side: int = 1) -> tuple[list[Reals], Mask, Reals]:
        """Angle of the wheel and its derivatives at any crank angle, whether it moves, and which pin is the nearest.

        Parameters
            phi : (N,) array [rad] - from a pin on the line of centres
            side : +1 or -1 - of the ends of the motion, where the second derivative jumps
        Returns
            rates, moves, pin : order + 1 (N,) arrays [rad], bool, number of whole pitches from pin 0
        """
        pitch = TURN / self.pins
        near = _NEAR * np.spacing(np.maximum(np.abs(phi), TURN))
        pin = np.floor(phi / pitch + 0.5)
        f = phi - pin * pitch
        late = f >= self.half - near if side > 0 else f > self.half + near
        early = f < -self.half - near if side > 0 else f <= -self.half + near
        moves = ~(late | early)
        held = np.clip(f, -self.half, self.half)  # where the wheel stands only the end of its step counts
        rates = self.rates(held, order)
        rates = [np.asarray(rates[0] + pin * self.step), *(np.where(moves, each, 0.0) for each in rates[1:])]
        return rates, np.asarray(moves), pin

    def reach(self, f: Reals) -> Reals:
        """Distance of the pin from the wheel's axis [mm]."""
        a, r = self.distance, self.crank
        return np.sqrt(a * a + r * r - 2.0 * self.sign * a * r * np.cos(f))

    @cached_property
    def peak_place(self) -> float:
        """Crank angle of the maximum acceleration ratio, before the line of centres [rad].

        external: cos f* = -q + sqrt(q^2 + 2), q = (1 + l^2)/(4 l);  internal: the entry
        """
        if self.sign < 0.0:
            return -self.half
        q = (1.0 + self.ratio**2) / (4.0 * self.ratio)
        return -math.acos(2.0 / (q + math.sqrt(q * q + 2.0)))

    def leaves(self, angle: float) -> float:
        """Crank angle from the line of centres at which the wheel has this angle left of its step [rad].

        sin(psi) = l sin(f + s psi), of the closed form of psi
        """
        psi = 0.5 * self.step - angle
        return math.asin(math.sin(psi) / self.ratio) - self.sign * psi


def motion(design: GenevaDrive) -> Motion:
    """Links and joints over the crank angle from the line of centres: crank axis A at 0, the wheel's axis D on the x
    axis, for an external wheel on +x; a wheel of more slots than the crank has pins comes home after several turns."""
    drive = design.drive
    axis, radius, start = complex(drive.sign * drive.distance), drive.crank, math.pi if drive.sign > 0.0 else 0.0

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        rates, moves, pin = drive.over(phi, order, side)
        rates[0] = start - drive.sign * rates[0]
        wheel = Turn(rates[0], *(-drive.sign * each for each in rates[1:]))
        links = {
            "crank": Link(fixed(0j, phi, order=order), steady(phi, order=order), {"P": radius}),
            "wheel": Link(fixed(axis, phi, order=order), wheel),
        }
        at = radius * units(phi - pin * (TURN / drive.pins))
        across = 1j * (at - axis) / np.abs(at - axis)
        joints: list[Connection] = [
            Pin("A", FRAME, "crank", links["crank"].origin.value),
            Pin("D", FRAME, "wheel", links["wheel"].origin.value),
            SharedContact(
                "slot",
                "wheel",
                np.asarray(at),
                np.where(moves, across, 0j),
                {"crank": np.where(moves, 1.0, 0.0)},
                hold=np.where(moves, 0.0, NEWTON_METER),
            ),
        ]
        return Mechanism(links, joints, "crank")

    pitch = TURN / drive.pins
    ends = [k * pitch + f for k in range(drive.pins + 1) for f in (-drive.half, drive.half)]
    joints = tuple(sorted(end for end in ends if 0.0 < end < TURN))
    return Motion(make, Input("crank_angle", joints=joints), (Output("Wheel", wheel_course(drive)),))


def wheel_course(drive: Geneva) -> Course:
    """Angle of the wheel from the middle of its step, positive the way that it turns [rad]."""
    start = math.pi if drive.sign > 0.0 else 0.0
    return turned("wheel", sense=-drive.sign).less(-drive.sign * start)


def errors(design: GenevaDrive, _mechanism: Mechanism) -> Movable:
    """The distance of the axes; the error is measured at the rim of the wheel where the file says nothing else."""
    return Movable({"center_distance": (Shift(FRAME, ("D",), design.drive.sign),)}, radius=design.drive.wheel)


_INSTANTS, _PLACES = 721, 33
_EDGE_INSTANTS = 20001
_CLOSER = 6
"""So often the grid over instants and places closes in on the deepest point, to a sixteenth of its cells and more."""
_INSIDE = 1e-9
"""Share of the locking radius by which a point of the wheel has to lie inside the disc to count."""


class Piece(NamedTuple):
    """A smooth piece of an outline: its name, points over a parameter, and the range of that."""

    name: str
    curve: Callable[[Reals], Points]
    low: float
    high: float


@dataclass(frozen=True)
class Outlines:
    """Wheel and driver of a drive.

    Fields
        slot : float [mm] - half the width of a slot
        locking, hollow : float [mm] - radii of the locking disc, and of the wheel's locking arcs
    Source
        own derivation: the wheel's arc and the disc are circles about the crank's axis in the dwell
    """

    drive: Geneva
    slot: float
    locking: float
    hollow: float

    @property
    def tip(self) -> float:
        """Wheel axis to the corners of a slot's mouth [mm]."""
        return math.hypot(self.drive.wheel, self.slot)

    @property
    def depth(self) -> float:
        """How deep the locking disc reaches into the circle through the corners [mm]; at 0 it holds nothing."""
        return self.locking - abs(self.drive.distance - self.tip)

    @property
    def edge(self) -> complex:
        """Where a locking arc of the driver ends, the pin on the x axis [mm]."""
        return cmath.rect(self.locking, self.drive.half)

    @property
    def _arc_half(self) -> float:
        """Half of the wheel's angle that its locking arc takes of the circle through the corners [rad].

        Raises
            NoSolution - where the disc covers the whole wheel
        """
        distance, tip = self.drive.distance, self.tip
        if self.hollow <= abs(distance - tip):
            return 0.0
        if self.hollow >= distance + tip:  # the disc holds the whole circle
            return math.pi
        return triangle_angle(distance, tip, self.hollow)

    @property
    def play(self) -> float | None:
        """Angle that the wheel can turn in the middle of the dwell, from one side of the disc to the other [rad].

        The corner of its arc, or the edge of the disc if that is nearer to the line of centres, stands at d from the
        wheel's axis: 2 (acos((a^2 + d^2 - h^2)/(2 a d)) - acos((a^2 + d^2 - l^2)/(2 a d))), h and l the radii of arc
        and disc; to first order 2 (h - l)/(a sin t), t from the line of centres at the crank's axis. None where the
        disc holds nothing.
        """
        drive, a, radius = self.drive, self.drive.distance, self.locking
        end = 0.5 * TURN / drive.pins - drive.half
        if self.depth <= 0.0 or end <= _INSIDE or self.hollow >= a + self.tip:
            return None
        away = math.sqrt(a * a + radius * radius - 2.0 * drive.sign * a * radius * math.cos(end))
        if drive.sign > 0.0 and triangle_angle(a, self.hollow, self.tip) < end:
            away = self.tip
        if self.hollow >= a + away:  # the edge of the disc comes to no side of the arc
            return None
        return 2.0 * (triangle_angle(a, away, self.hollow) - triangle_angle(a, away, radius))

    def wheel_half(self) -> list[Piece]:
        """From the bottom of a slot on the x axis to the middle between two slots.

        Raises
            NoSolution - where slots run into each other, or the locking arcs reach their bottoms
        """
        drive, s, wide = self.drive, self.drive.sign, self.slot
        bottom, mouth, middle = drive.distance - s * drive.crank, drive.wheel, math.pi / drive.slots
        axis, corner = cmath.rect(drive.distance, middle), math.asin(wide / self.tip)
        if corner >= middle:
            widest = drive.wheel * math.tan(middle)
            message = f"slots {short(2.0 * wide)} mm wide run into each other at their mouths"
            raise NoSolution(message, key="pin_radius", fix=f"choose pin_radius below {safely_below(widest)} mm")
        arc_from = middle - self._arc_half
        if arc_from < corner:  # no lip: the arc cuts the wall of the slot
            mouth -= s * math.sqrt(self.hollow**2 - (drive.crank - wide) ** 2)
            if s * (mouth - bottom) <= 0.0:
                most = math.hypot(drive.crank - wide, drive.wheel - bottom)
                message = f"the locking arc of radius {short(self.hollow)} mm reaches the bottoms of the slots"
                fix = f"choose locking_radius below {safely_below(most)} mm"
                raise NoSolution(message, key="locking_radius", fix=fix)
        pieces = [
            Piece("bottom", lambda t: complex(bottom) - complex(s * wide) * units(-s * t), 0.0, 0.5 * math.pi),
            Piece("slot", partial(_straight, complex(bottom, wide), complex(mouth, wide)), 0.0, 1.0),
        ]
        start = complex(mouth, wide)
        if arc_from >= corner:
            pieces.append(Piece("tip circle", lambda t: self.tip * units(t), corner, arc_from))
            start = cmath.rect(self.tip, arc_from)
        if self._arc_half > 0.0:
            inward = -s * cmath.rect(1.0, middle)
            turn = cmath.phase((start - axis) / inward)
            arc = Piece("locking arc", lambda t: axis + self.hollow * inward * units(turn * (1.0 - t)), 0.0, 1.0)
            pieces.append(arc)
        return pieces

    def driver(self) -> list[Piece]:
        """The locking disc, counter-clockwise from the cut-out of the pin on the x axis."""
        drive, half, pitch = self.drive, self.drive.half, TURN / self.drive.pins
        cut, pieces = self._cut(), []
        for k in range(drive.pins):
            pieces.append(Piece("cut-out", partial(_turned, cut, cmath.rect(1.0, k * pitch)), 0.0, 1.0))
            if pitch - 2.0 * half > _INSIDE:
                pieces.append(
                    Piece("locking arc", lambda t: self.locking * units(t), k * pitch + half, (k + 1) * pitch - half)
                )
        return pieces

    def _cut(self) -> Callable[[Reals], Points]:
        """The cut-out, an arc from edge to edge through its vertex."""
        end, vertex, radius = self.edge, self.cut_vertex, self.cut_radius
        if math.isinf(radius):
            return partial(_straight, end.conjugate(), end)
        half = self._cut_half
        return lambda t: complex(vertex + radius) - complex(radius) * units(-half * (2.0 * t - 1.0))

    @property
    def _cut_half(self) -> float:
        """Half of the angle of a cut-out's arc at its centre, by the chord from vertex to edge [rad]."""
        return math.pi - 2.0 * cmath.phase(self.edge - self.cut_vertex)

    @property
    def cut_radius(self) -> float:
        """Radius of a cut-out [mm], negative where it bulges; infinite: a chord."""
        half = self._cut_half
        return math.inf if abs(half) < _INSIDE else self.edge.imag / math.sin(half)

    @cached_property
    def cut_vertex(self) -> float:
        """Where the cut-out crosses the pin's radius, from the crank's axis [mm].

        The textbook's arc (a - wheel) locking/r of an external drive, the chord of an internal one, unless the wheel
        comes nearer on its way: then the arc that just lets it pass.
        """
        drive, end = self.drive, self.edge
        usual = (drive.distance - drive.wheel) * self.locking / drive.crank if drive.sign > 0.0 else end.real

        def rise(near: Points) -> Reals:
            """How far the arc over the edges that passes a point of the wheel stands before the usual one."""
            within = np.abs(near) < self.locking * (1.0 - _INSIDE)
            if drive.sign > 0.0:  # what lies beyond the edges is the overlap
                within &= np.abs(np.angle(near)) < drive.half - _INSIDE
            with np.errstate(divide="ignore", invalid="ignore"):  # points on the chord, which are not within
                # arcs over a chord are the places of equal angle at which it is seen
                seen = np.angle((end - near) / (end.conjugate() - near)) % TURN
                return np.where(within, usual - end.real + end.imag / np.tan(0.5 * seen), 0.0)

        return usual - max(0.0, self._deepest(rise))

    @property
    def overlap(self) -> float:
        """How far lips beside a slot and edges of the disc reach into each other on their way [mm]; 0: not at all.

        Of an external drive the lips are within the sector of the arc, of an internal one the edge is in the wheel:
        beyond the circle through the corners, out of its slots and of its locking arcs.
        """
        drive = self.drive

        def depth(near: Points) -> Reals:
            if drive.sign > 0.0:
                into = self.locking * (1.0 - _INSIDE) - np.abs(near)
                return np.asarray(np.minimum(into, np.abs(near) * (np.abs(np.angle(near)) - drive.half)))
            near = np.abs(near) * units(np.abs(np.angle(near * units(-_pitches(near, drive.step)))))
            from_arc = np.abs(near - cmath.rect(drive.distance, 0.5 * drive.step)) - self.hollow
            into = np.minimum(np.minimum(np.abs(near) - self.tip, near.imag - self.slot), from_arc)
            return np.asarray(into - _INSIDE * self.locking)

        return max(0.0, self._deepest(depth, edge=drive.sign < 0.0))

    def _deepest(self, depth: Callable[[Points], Reals], *, edge: bool = False) -> float:
        """The greatest of a depth over the instants at which a pin drives the wheel, and over the places of a lip.

        Parameters
            depth : of points seen from the crank, the pin on the x axis; alike for both lips, which are mirror images
            edge : of the edge of the disc instead, seen from the wheel, a slot on the x axis
        """
        f = np.linspace(-self.drive.half, self.drive.half, _EDGE_INSTANTS if edge else _INSTANTS)
        corner, middle = math.asin(self.slot / self.tip), math.pi / self.drive.slots - self._arc_half
        lip = np.zeros(1) if edge else np.linspace(corner, middle, _PLACES)
        best = -math.inf
        for _ in range(_CLOSER):
            found = depth(self._edge_in_wheel(f[:, None]) if edge else self._lip(f[:, None], lip))
            i, j = divmod(int(np.argmax(found)), lip.size)
            best = max(best, float(found[i, j]))
            f = np.linspace(f[max(i - 1, 0)], f[min(i + 1, f.size - 1)], _PLACES)
            if not edge:
                lip = np.linspace(lip[max(j - 1, 0)], lip[min(j + 1, lip.size - 1)], _PLACES)
        return best

    def _lip(self, f: Reals, lip: Reals) -> Points:
        drive, s = self.drive, self.drive.sign
        turn = (math.pi if s > 0.0 else 0.0) - s * drive.rates(f, 0)[0]
        return np.asarray((s * drive.distance + self.tip * units(lip) * units(turn)) * units(-f))

    def _edge_in_wheel(self, f: Reals) -> Points:
        return np.asarray((self.drive.distance + self.edge * units(f)) * units(-self.drive.rates(f, 0)[0]))


def _pitches(seen: Points, pitch: float) -> Reals:
    """Direction of the slot nearest to each point [rad]."""
    return np.asarray(pitch * np.round(np.angle(seen) / pitch))


def _turned(curve: Callable[[Reals], Points], unit: complex, parameter: Reals) -> Points:
    return unit * curve(parameter)


def _straight(start: complex, end: complex, parameter: Reals) -> Points:
    return np.asarray(start + parameter * (end - start), dtype=np.complex128)


SIZES = ("crank_radius", "wheel_radius", "tip_radius", "slot_bottom_radius", "lip_thickness")
PLAYS = ("wheel_backlash", "locking_play")
MOTION = (
    "motion_angle", "motion_share", "locking_angle", "speed_ratio_max", "acceleration_ratio_max",
    "acceleration_ratio_max_at", "entry_acceleration_ratio", "input_speed", "turn_time", "steps_per_minute",
    "output_speed_max", "output_acceleration_max",
)  # fmt: skip
FORCES = ("contact_force_max", "contact_force_max_at", "input_torque_max", "input_torque_max_at")
_COMPARED = "three-gear-four-bar"
_SAME = 1e-9


class GenevaDrive(RealSpeed, Design):
    """A wheel of radial slots, and a crank whose pin enters them along the slot."""

    kind = "geneva-drive"
    spec: GenevaDriveSpec
    keys = {
        "analyze": (
            "motion_angle",
            "motion_share",
            ("steps_per_minute", "<limits.steps_per_minute"),
            "crank_radius",
            "wheel_radius",
            "slot_bottom_radius",
            "output_acceleration_max",
            "contact_force_max",
            "input_torque_max",
            "locking_angle",
            "speed_ratio_max",
            "acceleration_ratio_max",
        )
    }
    outlines = {
        "analyze": Outline(
            (*SIZES, *PLAYS, *MOTION, *FORCES), ("locking", "pin-entry", "shaft-clearance", "step-rate"), ("motion",)
        )
    }
    extra_tables = ("comparison",)
    requirements = Design.requirements | {"slots", "type", "limits.steps_per_minute"}
    ways = {
        "locking": either("locking_radius", "pin_radius", "center_distance"),
        "pin-entry": (down("locking_clearance", step=0.005), up("slot_clearance", step=0.005)),
        "shaft-clearance": (*thinner("shaft_radius", "hub_radius"), *either("center_distance")),
    }

    def outline(self, command: str) -> Outline:
        """With a design to compare, its table."""
        found = self.outlines[command]
        return found if self.spec.compare is None else found._replace(tables=(*found.tables, "comparison"))

    # Sizes

    @cached_property
    def drive(self) -> Geneva:
        """Its motion in closed form."""
        sign = 1.0 if self.spec.type == "external" else -1.0
        return Geneva(self.spec.slots, self.spec.pins, self.spec.center_distance, sign)

    crank_radius: float = placed("drive.crank")
    wheel_radius: float = placed("drive.wheel")

    @property
    def tip_radius(self) -> float:
        """Wheel axis to the corners of a slot's mouth [mm]: sqrt(wheel^2 + (b/2)^2)."""
        return self.outlines_with(0.0).tip

    def outlines_with(self, locking: float) -> Outlines:
        """Wheel and driver with a locking disc of this radius [mm]."""
        return Outlines(self.drive, self._half_slot, locking, locking + self.spec.locking_clearance)

    @property
    def _half_slot(self) -> float:
        return self.spec.pin_radius + 0.5 * self.spec.slot_clearance

    @property
    def slot_bottom_radius(self) -> float | None:
        """Wheel axis to the bottom of a slot [mm], a - r - b/2; of an internal wheel the bottoms lie outside."""
        if self.drive.sign < 0.0:
            return None
        return self.drive.distance - self.crank_radius - self._half_slot

    @property
    def lip_thickness(self) -> float | None:
        """Metal between the locking arc and a slot [mm]: r - b/2 - (locking_radius + locking_clearance)."""
        locking = self.spec.locking_radius
        if locking is None:
            return None
        lip = self.crank_radius - self._half_slot - locking - self.spec.locking_clearance
        return without_noise(lip, self.crank_radius)

    # Play

    @property
    def wheel_backlash(self) -> float | None:
        """Maximum angle that the wheel can turn about a pin in its slot [rad]: 2 asin(c/(2 p)), p the minimum reach."""
        if not self.spec.slot_clearance:
            return None
        nearest = self.drive.distance - self.crank_radius if self.drive.sign > 0.0 else self.wheel_radius
        return 2.0 * math.asin(0.5 * self.spec.slot_clearance / nearest)

    @property
    def locking_play(self) -> float | None:
        """Angle that the wheel can turn in the middle of the dwell [rad]."""
        if self.spec.locking_radius is None or not self.spec.locking_clearance:
            return None
        return self.outlines_with(self.spec.locking_radius).play

    # Motion

    @property
    def motion_angle(self) -> float:
        """Crank angle of a step [rad]."""
        return 2.0 * self.drive.half

    @property
    def motion_share(self) -> float:
        """Share of the time in which the wheel moves, p (1/2 - s/n) with p pins."""
        return self.spec.pins * self.motion_angle / TURN

    @property
    def locking_angle(self) -> float:
        """Crank angle between two steps, in which the wheel dwells [rad]."""
        return TURN / self.spec.pins - self.motion_angle

    @property
    def speed_ratio_max(self) -> float:
        """Maximum speed of the wheel over the crank's, on the line of centres: l/(1 - s l)."""
        lam = self.drive.ratio
        return lam / (1.0 - self.drive.sign * lam)

    @property
    def acceleration_ratio_max(self) -> float:
        """Maximum magnitude of the wheel's acceleration over the square of the crank's speed."""
        return float(self.drive.rates(np.array([self.drive.peak_place]), 2)[2][0])

    acceleration_ratio_max_at: float = placed("drive.peak_place")

    @property
    def entry_acceleration_ratio(self) -> float:
        """Jump of the acceleration ratio at entry and exit: tan(pi/n)."""
        return math.tan(math.pi / self.spec.slots)

    @property
    def steps_per_minute(self) -> float | None:
        """Steps in a minute."""
        return None if self.input_speed is None else self.input_speed * self.spec.pins

    output_speed_max: float | None = per_time("speed_ratio_max", 1)
    output_acceleration_max: float | None = per_time("acceleration_ratio_max", 2)

    # Forces

    def needs(self, name: str, /) -> str:
        """What contact force and torque rest on."""
        if name not in FORCES:
            return ""
        return "wheel: {inertia, resistance}" if self.spec.wheel is None else "input_speed"

    @property
    def _torque(self) -> tuple[float, float] | None:
        """Inertia times the square of the speed, and resistance [N m]."""
        wheel = self.spec.wheel
        if wheel is None or (wheel.inertia > 0.0 and self.angular_speed is None):
            return None
        return wheel.inertia * (self.angular_speed or 0.0) ** 2, wheel.resistance

    def forces(self, f: Reals) -> tuple[Reals, Reals]:
        """Force between pin and slot [N] and torque of the crank [N m] while the wheel moves.

        N = |J W' w^2 + T|/p,  torque (J W' w^2 + T) W

        Parameters
            f : (N,) array [rad] - crank angle from the line of centres
        """
        assert self._torque is not None
        inertial, resistance = self._torque
        _, speed, acceleration = self.drive.rates(f, 2)
        torque = inertial * acceleration + resistance
        return abs(torque) / (1e-3 * self.drive.reach(f)), torque * speed

    @cached_property
    def _hardest(self) -> list[Extreme] | None:
        if self._torque is None:
            return None
        from gearlink.core.numerics.extremes import extremes_over

        half = self.drive.half
        return extremes_over(
            [(lambda f: self.forces(f)[0], True), (lambda f: abs(self.forces(f)[1]), True)], -half, half
        )

    contact_force_max: float | None = placed("_hardest.0.value")
    contact_force_max_at: float | None = placed("_hardest.0.place")
    input_torque_max: float | None = placed("_hardest.1.value")
    input_torque_max_at: float | None = placed("_hardest.1.place")

    # Tables

    def table_motion(self, samples: int | None = None) -> Table:
        """The wheel over a revolution of the crank from a pin on the line of centres."""
        beside: dict[str, tuple[Any, str]] = {}
        if self._torque is not None:
            phi = np.radians(turn_degrees(samples))
            _, moves, pin = self.drive.over(phi, 0)
            force, torque = self.forces(phi - pin * (TURN / self.spec.pins))
            beside = {
                "contact_force": (np.where(moves, force, 0.0), "N"),
                "input_torque": (np.where(moves, torque, 0.0), "N m"),
            }
        shown, degrees = of_output(wheel_course(self.drive), "wheel_angle"), turn_degrees(samples)
        return motion_table("motion", self, shown, samples, degrees=degrees, beside=beside)

    def require_table(self, name: str, /) -> None:
        """A comparison needs the other design."""
        if name == "comparison" and self.spec.compare is None:
            message = "the table comparison needs compare: {gears, links, ...}, a three-gear-four-bar of the same step"
            raise MissingSection(message, key="compare")

    @cached_property
    def compared(self) -> Any:
        """The gear linkage of `compare`, with the tolerance of its dwell.

        Raises
            NoSolution - where its step is another
        """
        from gearlink.core.base.kinds import KINDS

        spec = changed(self.spec.compare, [("dwell_backlash", None), ("dwell_tolerance", self.spec.compare_tolerance)])
        with in_section("compare"):
            found: Any = KINDS[_COMPARED].design("analyze", spec)
            turns = found.mean_ratio
        if abs(abs(turns) * self.spec.slots - 1.0) > _SAME:
            message = (
                f"the linkage moves its output by {short(360.0 * turns)} deg per revolution, this wheel by "
                f"{short(math.degrees(self.drive.step))} deg"
            )
            raise NoSolution(message, key="compare.gears", fix=f"choose teeth with crank/output 1/{self.spec.slots}")
        return found

    def table_comparison(self, _samples: int | None = None) -> Table:
        """This drive, a cam with a modified sine of the same motion angle, and the gear linkage, of the same step.

        Dwells are crank angles in which the output stays within +-compare_tolerance; `steps_per_minute` are those at
        the peak acceleration of this drive: n sqrt(A_this/A_other).
        """
        self.require_table("comparison")
        from gearlink.core.numerics.roots import bracketed_root
        from gearlink.core.parts.cams.laws import law

        step, half, pitch = self.drive.step, math.radians(self.spec.compare_tolerance), TURN / self.spec.pins
        if half >= 0.5 * step:
            most = safely_below(math.degrees(0.5 * step))
            raise NoSolution(
                f"compare_tolerance: {short(self.spec.compare_tolerance)} deg (limit < {most} deg, half a step)",
                key="compare_tolerance",
                fix=f"set compare_tolerance below {most} deg",
            )
        sine, share, other = law("modified-sine"), self.motion_angle, self.compared
        left = bracketed_root(lambda x: sine.evaluate(x, 0)[0] - half / step, 0.0, 0.5)
        rows = [
            ("geneva-drive", step, pitch - 2.0 * self.drive.leaves(half), self.speed_ratio_max,
             self.acceleration_ratio_max, self.spec.pins),
            ("cam, modified sine", step, pitch - share * (1.0 - 2.0 * left),
             step * sine.peak_velocity / share, step * sine.peak_acceleration / share**2, self.spec.pins),
            (_COMPARED, step, other.tolerance_dwell_angle or 0.0, other.speed_ratio_max,
             max(other.acceleration_ratio_max, -other.acceleration_ratio_min), 1),
        ]  # fmt: skip
        speed = math.nan if self.input_speed is None else self.input_speed
        hardest = self.acceleration_ratio_max
        names, steps, dwells, speeds, peaks_of, pins = zip(*rows, strict=True)
        rate = [speed * per * math.sqrt(hardest / each) for per, each in zip(pins, peaks_of, strict=True)]
        columns: dict[str, tuple[Any, str]] = {
            "mechanism": (names, ""),
            "step": ([math.degrees(each) for each in steps], "deg"),
            "dwell": ([math.degrees(each) for each in dwells], "deg"),
            "speed_ratio_max": (speeds, "1"),
            "acceleration_ratio_max": (peaks_of, "1"),
            "steps_per_minute": (rate, "1/min"),
        }
        return Table.of("comparison", columns)

    # Checks

    def check_locking(self) -> Iterator[Check]:
        """GL344: the lip at the locking arc, and the web between two slots of an external wheel."""
        lip = self.lip_thickness
        if lip is not None:
            status: Status = "fail" if lip <= 0.0 else "pass"
            what, overlap = "thickness of the lip between locking arc and slot", "overlap of locking arc and slot"
            fix = "use a smaller locking_radius or pin_radius"
            if lip:
                yield LOCKING.check(status, what, lip, 0.0, "mm", overlap=overlap, fix=fix)
            else:
                yield LOCKING.check("fail", "no lip is left: locking arc and slot touch", fix=fix)
            yield from self._held(self.outlines_with(self.spec.locking_radius or 0.0), lips=lip > 0.0)
        if self.drive.sign > 0.0:
            bottom = self.drive.distance - self.crank_radius
            web = 2.0 * (bottom * self.drive.ratio - self._half_slot)
            status = "fail" if web <= 0.0 else "pass"
            what, overlap = "web between the bottoms of two slots", "overlap of the bottoms of two slots"
            fix = "use a smaller pin_radius, or a larger center_distance"
            yield LOCKING.check(status, what, web, 0.0, "mm", overlap=overlap, fix=fix)

    @staticmethod
    def _held(outlines: Outlines, *, lips: bool) -> Iterator[Check]:
        """Whether the disc reaches into the wheel, and lets the lips that it leaves pass beside a driven slot."""
        depth, deeper = outlines.depth, "choose a larger locking_radius"
        status: Status = "fail" if depth <= 0.0 else "pass"
        what, overlap = "depth of the locking disc in the wheel", "gap between locking disc and wheel"
        yield LOCKING.check(status, what, depth, 0.0, "mm", overlap=overlap, fix=deeper)
        if lips and depth > 0.0 and (over := outlines.overlap) > 0.0:
            what = "interference of the lip at a slot with the edge of the locking disc"
            yield LOCKING.check("fail", what, over, 0.0, "mm", side="<=", fix=deeper)

    def check_pin_entry(self) -> Iterator[Check]:
        """GL347: whether a wheel that stands off by its play takes the pin."""
        play = self.locking_play
        if play is None:
            return
        off, most = self.wheel_radius * math.sin(0.5 * play), 0.5 * self.spec.slot_clearance
        what = "offset of a slot at its mouth, of the locked wheel"
        fix = f"increase slot_clearance to {safely_above(2.0 * off)} mm, or chamfer the mouths of the slots"
        if off > most > 0.0:
            fix = f"reduce locking_clearance to {safely_below(self.spec.locking_clearance * most / off)} mm, {fix}"
        yield PIN_ENTRY.check("warn" if off > most else "pass", what, off, most, "mm", fix=fix)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: the crank's shaft beside an external wheel, and the wheel's hub within the bottoms of its slots."""
        bottom = self.slot_bottom_radius
        if bottom is None:
            return
        room = self.drive.distance - self.tip_radius
        pairs = (("tips of the wheel", "crank's shaft", room, self.spec.shaft_radius, "shaft_radius"),
                 ("bottoms of the slots", "wheel's hub", bottom, self.spec.hub_radius, "hub_radius"))  # fmt: skip
        for what, body, place, radius, key in pairs:
            if radius is None:
                continue
            fails = place <= radius
            subject, aside = f"free radius inside the {what}", f"radius of the {body}"
            fix = f"reduce {key}, or increase center_distance"
            yield SHAFT_CLEARANCE.check("fail" if fails else "pass", subject, place, radius, "mm", aside=aside, fix=fix)

    def check_step_rate(self) -> Iterator[Check]:
        """GL345."""
        rate, speed, limit = self.steps_per_minute, self.spec.input_speed, self.spec.limits.steps_per_minute
        if rate is None or speed is None:
            return
        over = rate > limit
        fix = f"reduce input_speed to {safely_below(abs(speed) * limit / rate)} 1/min or less" if over else ""
        yield STEP_RATE.check("warn" if over else "pass", "step rate", rate, limit, "1/min", fix=fix)
