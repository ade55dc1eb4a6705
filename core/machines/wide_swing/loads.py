"""The loads of a wide swing: rocker with its device, cam shafts, and the rollers between them.

The input angle is that of the cam, from the start of the working stroke; torques are positive in the sense of that
stroke. With `cycle` the whole turn is computed, with `cycle_angle` the working stroke alone. In a stroke its own cam
guides the rocker, and in the rest after it that cam's arc holds it against the device. A cam on a crank-rocker swings
home on the profile of its stroke: the whole revolution is that of the crank, without a rest.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.base.design import geometry, placed
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.remedies.ways import at_least
from gearlink.core.base.report import Check, Remedy, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short
from gearlink.core.machines.wide_swing import bodies
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.mechanism import GEARS
from gearlink.core.machines.wide_swing.remedies import side_changes, side_words
from gearlink.core.machines.wide_swing.strokes import AnyCam, Parts, Stroke, strokes_of
from gearlink.core.mechanism.dynamics import Force, Mass, Torque
from gearlink.core.mechanism.rates import TURNING_BACK
from gearlink.core.numerics.arrays import range_rows
from gearlink.core.numerics.extremes import Extreme, extremes_of_parts, extremes_over
from gearlink.core.numerics.together import kept_last
from gearlink.core.studies import codes
from gearlink.core.studies.loads import tables
from gearlink.core.studies.loads.cams import CAM_CHECKS, no_width, pressed_where_undercut, pressure_check
from gearlink.core.studies.loads.checks import resonance
from gearlink.core.studies.loads.contact import LineContact, contact_of
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline
from gearlink.core.studies.loads.joints import BALL, ROLLER, BearingLoad
from gearlink.core.studies.loads.names import PIN
from gearlink.core.studies.loads.panels import Panels
from gearlink.core.studies.loads.vibration import Vibrating

if TYPE_CHECKING:
    from collections.abc import Sequence

    from gearlink.core.machines.wide_swing.loads_spec import SwingLoads as Section
    from gearlink.core.machines.wide_swing.spec import WideSwingSpec
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.spec import Bearing


_ROUNDING = 8.0
_STANDSTILL = 1e-4
Wanted: TypeAlias = "dict[str, tuple[Callable[[Reals], Reals], bool]]"


def _extreme(f: Callable[[Reals], Reals], greatest: bool, parts: Parts, joints: Sequence[float] = ()) -> float:
    """Maximum or minimum value of a function over parts of a stroke."""
    found = extremes_of_parts([(f, greatest)], parts, joints=joints, samples=128)
    return (max if greatest else min)(extreme.value for (extreme,) in found)


class SwingStroke:
    """A stroke under load, over the fractions k of it."""

    def __init__(self, at: Stroke, loads: WideSwingLoads) -> None:
        self.at, self.loads = at, loads

    name: str = placed("at.name")
    cam: AnyCam = placed("at.cam")
    start: float = placed("at.start")
    width: float = placed("at.width")
    words: str = placed("at.words")
    cam_words: str = placed("at.cam_words")
    parts: Parts = placed("at.parts")

    # Over the stroke

    @property
    def joints(self) -> list[float]:
        """Places at which what the file lets act jumps or bends."""
        places = [(angle - self.start) / self.width for angle in self.loads.machine.breaks]
        return [place for place in places if 0.0 < place < 1.0]

    def angle(self, k: Reals) -> Reals:
        """Input angle [rad]; the very end is that of the stroke, not of the rest after it, where the force jumps."""
        end = self.start + self.width
        last = end - _ROUNDING * np.spacing(end) if self.loads.whole else end
        return np.minimum(self.start + k * self.width, last)

    def force(self, k: Reals) -> Reals:
        """Force of the roller on its cam [N], out of the reactions; at the very end that before friction turns back."""
        found: Reals = self.loads.machine.reactions(self.pressing_angle(k)).unknowns["roller"][0]
        return found

    def pressing_angle(self, k: Reals) -> Reals:
        """Input angle at which the force is looked at [rad]."""
        return np.minimum(self.angle(k), self.start + self.width - 2.0 * TURNING_BACK)

    def _parted(self, k: Reals) -> tuple[Reals, Reals]:
        """N_0 of the machine that stands [N], less the share f that the device misses, and N_1 [N s^2]."""
        rest, swung = (part.unknowns["roller"][0] for part in self.loads.machine.parted(self.pressing_angle(k)))
        design = self.loads.design.unloading
        if missed := self.loads.spec.unloader.residual:
            rest = rest - missed / (1.0 + design.size.reserve) * design.contact_force(
                self.cam, self.at.profile(k)[0], 0.0
            )
        return rest, swung

    @property
    def least_standing(self) -> float:
        """Minimum force of the roller on its cam while the machine stands, without friction [N]."""
        return _extreme(lambda k: self._parted(k)[0], False, self.parts, self.joints)

    @property
    def most_unloading(self) -> float:
        """1/w^2 of the speed at which the roller that presses while it stands is without force [s^2]."""

        def unloading(k: Reals) -> Reals:
            rest, swung = self._parted(k)
            return np.asarray(-swung / rest)

        return _extreme(unloading, True, self.parts, self.joints)

    def relative_radius(self, k: Reals) -> Reals:
        """R = r_g (1 - r_g kappa) of roller and profile [mm], kappa positive where the body is convex."""
        radius = self.cam.roller_radius
        return radius * (1.0 - radius * self.cam.bulge(self.at.profile(k)[0]))

    def way(self, k: Reals) -> Reals:
        """Way of the roller's centre over the cam, per input angle [mm]."""
        place, rate = self.at.profile(k)
        return np.asarray(self.cam.center_distance * np.abs(self.cam.state(place).gradient) * np.abs(rate))

    def roller_speed(self, k: Reals) -> Reals:
        """Speed of the roller about its own axis [rad/s], positive in the sense of the working stroke.

        Notes
            A cam turns against the roller on its external profile, with it on its internal one.
        """
        place, rate = self.at.profile(k)
        at = self.cam.state(place)
        rolling = self.cam.center_distance / self.cam.roller_radius * np.abs(at.gradient)
        return np.asarray((rolling - self.cam.sense * at.turning) * rate * self.loads.speed)

    def bearing_speed(self, k: Reals) -> Reals:
        """Speed of the roller on its pin of the rocker [rad/s]."""
        place, rate = self.at.profile(k)
        motion = self.loads.design.motion
        swung = motion.swing / self.cam.cycle_angle * motion.law.invariants(place, 1)[1]
        return np.asarray(self.roller_speed(k) - swung * rate * self.loads.speed)

    def entrainment(self, k: Reals) -> Reals:
        """Speed of both surfaces through the contact [mm/s]."""
        return self.way(k) * self.loads.speed * self.relative_radius(k) / self.cam.roller_radius

    def contact(self, k: Reals) -> LineContact | None:
        """The Hertzian contact; None without a width."""
        section = self.loads.section
        return contact_of(section, self.force(k), self.relative_radius(k)) if section.roller else None

    @property
    def curved_parts(self) -> Parts:
        """Those in which the profile has a curvature.

        Notes
            At the standstills of a cam on a crank-rocker it bends without bound: it is looked at from 1e-4 on.
        """
        (first, start), (end, last) = self.parts
        if self.loads.spec.drive is not None:
            first, last = max(first, _STANDSTILL), min(last, 1.0 - _STANDSTILL)
        return (first, start), (end, last)

    @cached_property
    def is_undercut(self) -> bool:
        """Whether the roller is somewhere as large as the bend of its path: there is no contact there."""
        if self.loads.spec.drive is None and self.parts:  # where it touches, its cam has been searched for the same
            return self.cam.min_curvature_radius <= self.cam.roller_radius
        return _extreme(self.relative_radius, False, self.curved_parts) <= 0.0

    def greatest(self, f: Callable[[Reals], Reals], *, curved: bool = False) -> float:
        """Maximum value where the roller touches; `curved`: of what depends on the curvature there."""
        return _extreme(f, True, self.curved_parts if curved else self.parts)

    @property
    def pressed(self) -> dict[str, Extreme]:
        """Maximum force, pressure and depth of the shear, and the minimum force, where the roller touches."""
        return self.loads.of_strokes[self.loads.strokes.index(self)]

    @cached_property
    def shear_depth_at_greatest_pressure(self) -> float:
        """Depth of the maximum shear stress where the pressure is largest [mm]."""
        place = self.pressed["pressure"].place
        return float(self._contact(np.array([place])).shear_depth[0])

    def _contact(self, k: Reals) -> LineContact:
        found = self.contact(k)
        assert found is not None, "asked for only where the roller has a width"
        return found

    def columns(self, k: Reals) -> dict[str, tuple[Any, str]]:
        """Force, pressure, radius and speeds; not a number where the roller touches nothing."""
        place = self.at.profile(k)[0]
        touching = self.loads.design.touches(self.cam, place) & (place != self.cam.middle)
        at = k[touching]
        none = np.full(at.shape, np.nan)
        locked = self.loads.locked
        contact, force = (None, none) if locked else (self.contact(at), self.force(at))

        def shown(values: Reals) -> Reals:
            found = np.full_like(k, np.nan)
            found[touching] = values
            return found

        return {
            "force": (shown(force), "N"),
            "pressure": (shown(none if contact is None else contact.pressure), "N/mm^2"),
            "radius": (shown(self.relative_radius(at)), "mm"),
            "roller_speed": (shown(self.roller_speed(at) * 60.0 / (2.0 * math.pi)), "1/min"),
            "entrainment": (shown(self.entrainment(at)), "mm/s"),
        }


# The loads of a wide-swing mechanism: rocker with its device, cam shaft, and the roller between them


ROLLERS = "roller"
"""The bearing of the rollers, by its name in the file."""
_HANGS = 1e-6
"""Angle between a pendulum at mid-swing and the gravity of the file that is none [deg]."""
_NEAR = 0.9
_TURN_BY = 15
"""Steps in which a direction is turned [deg]."""


def _clear_directions(design: WideSwingLoads) -> Iterator[Remedy]:
    """The nearest direction each way in which every body keeps clear, by geometry alone."""
    for name in design.own_directions:
        given = getattr(design.section, name)
        for sense in (1.0, -1.0) if given is not None else ():
            turned = (math.remainder(given + sense * step, 360.0) for step in range(_TURN_BY, 180, _TURN_BY))
            found = next((each for each in turned if _is_clear(design, f"loads.{name}", each)), None)
            if found is not None:
                yield ((f"loads.{name}", found),)


def _is_clear(design: WideSwingLoads, path: str, value: float) -> bool:
    spec = changed(design.spec, ((path, value),))
    return spec is not None and not any(True for _ in bodies.placed_clearance(type(design)(spec)))


_ENDS = 2.0 * TURNING_BACK
LEAST = 4.0 * _ENDS
"""Input angle below which a rest is none [rad]: its ends belong to the strokes, where the force is another."""


@dataclass(frozen=True, eq=False)
class SwingRest:
    """The rest after a stroke, in which the arc of that stroke's cam holds the rocker.

    Fields
        stroke : SwingStroke - before it
        start, width : float [rad] - input angle at which it starts, and that it takes
    """

    stroke: SwingStroke
    start: float
    width: float

    @property
    def words(self) -> str:
        """What it is called."""
        return "far rest" if self.stroke.name == "main" else "near rest"

    @property
    def _end(self) -> float:
        return self.start + self.width

    def _inside(self, phi: Reals) -> Reals:
        """Input angles that are not those of the strokes."""
        return np.clip(phi, self.start + _ENDS, self._end - _ENDS)

    def force(self, phi: Reals) -> Reals:
        """Force of the roller on the arc [N] at input angles, out of the reactions."""
        found: Reals = self.stroke.loads.machine.reactions(self._inside(phi)).unknowns["roller"][0]
        return found

    def _extremes(self, *wanted: tuple[Callable[[Reals], Reals], bool]) -> list[float]:
        found = extremes_over(wanted, self.start, self._end, joints=self._joints, samples=128)
        return [each.value for each in found]

    @property
    def least_standing(self) -> float:
        """Minimum force on the arc without friction [N]; no mass moves meanwhile that the roller bears."""

        def force(phi: Reals) -> Reals:
            found: Reals = self.stroke.loads.machine.parted(self._inside(phi))[0].unknowns["roller"][0]
            return found

        return self._extremes((force, False))[0]

    @property
    def _joints(self) -> list[float]:
        """Input angles inside at which what the file lets act jumps or bends [rad]."""
        return [angle for angle in self.stroke.loads.machine.breaks if self.start < angle < self._end]

    def run(self, exponent: float) -> Reals:
        """int F^p |n| dt and int |n| dt per revolution of the input [N^p rad, rad]; the rocker stands still."""
        cam = self.stroke.cam
        way = float(np.abs(cam.state(np.ones(1)).resting().gradient[0]))
        rate = abs(cam.center_distance / cam.roller_radius * way - cam.sense)
        panels = Panels.over(self.width, [angle - self.start for angle in self._joints])
        force = np.abs(self.force(self.start + panels.nodes))
        return rate * np.array([panels.integral(force**exponent), self.width])

    def pressure(self, phi: Reals) -> Reals | None:
        """Pressure there [N/mm^2]; None without a width."""
        contact = contact_of(self.stroke.loads.section, self.force(phi), np.full_like(phi, self.relative_radius))
        return None if contact is None else contact.pressure

    @property
    def relative_radius(self) -> float:
        """R = r_g (1 -+ r_g/rho) of roller and arc [mm], + of an internal profile; rho the pitch radius of the arc."""
        cam = self.stroke.cam
        return cam.roller_radius * (1.0 - cam.sense * cam.roller_radius / cam.end_radius)

    @cached_property
    def pressed(self) -> dict[str, float]:
        """Maximum force, pressure and depth of the shear, and the minimum force: on an arc both go with the force."""
        greatest, least = self._extremes((self.force, True), (self.force, False))
        found = {"force": max(abs(greatest), abs(least)), "least_force": least}
        section, radius = self.stroke.loads.section, np.array([self.relative_radius])
        contact = contact_of(section, np.array([greatest]), radius)
        if contact is not None:
            found |= {"pressure": float(contact.pressure[0]), "shear_depth": float(contact.shear_depth[0])}
        return found


_STEPS = 100
_RUN_PANELS = 16
"""Panels of a part of a stroke, over which forces and speeds of a roller are integrated."""


class SwingVibrating(Vibrating):
    """As of any output; of a stroke alone, the one motion that ends in a rest."""

    design: WideSwingLoads

    @cached_property
    def inertia(self) -> float:
        """That of the rocker; with a slider it changes over the stroke, and a stiffness has no frequency."""
        if self.design.spec.slider is not None:
            message = "with a slider the inertia changes over the stroke"
            raise NoSolution(message, key="loads.vibration.stiffness", fix="give loads.vibration.frequency instead")
        return super().inertia

    @cached_property
    def motions(self) -> list[tuple[float, float]]:
        """Both strokes of a revolution, or the working stroke."""
        return super().motions if self.design.whole else [(0.0, self.design.cam.cycle_angle)]


class RollerLoad(BearingLoad):
    """What the bearings of the rollers bear over a revolution: of rollers that differ the one that lasts shortest.

    Parameters
        bearing : Bearing of the file
    Notes
        A roller runs in the strokes of its cam and in the rest after each; in between it is clear of the other cam.
        Where the file knows the working stroke alone, that is counted once a revolution.
    Source
        ISO 281, P = (int F^p |n| dt/int |n| dt)^(1/p) over the speed of the roller on its pin
    """

    design: WideSwingLoads
    bearing: Bearing
    swing = None
    """It goes round."""

    def __init__(self, loads: WideSwingLoads, bearing: Bearing) -> None:
        self.design, self.bearing = loads, bearing

    @property
    def exponent(self) -> float:
        """3 for balls, 10/3 for all others."""
        return BALL if self.bearing.kind == "ball" else ROLLER

    @cached_property
    def borne(self) -> tuple[tuple[float, float], ...]:
        """Equivalent load [N] and turns a revolution of the input, by roller."""
        parts = [_run(stroke, self.exponent) for stroke in self.design.strokes]
        for rest in self.design.rests:
            number = self.design.strokes.index(rest.stroke)
            parts[number] = parts[number] + rest.run(self.exponent)
        if self.design.spec.drive is not None:  # one roller on one cam
            parts = [sum(parts, np.zeros(2))]
        pairs = (part.tolist() for part in parts)
        return tuple(((force / way) ** (1.0 / self.exponent), way / math.tau) for force, way in pairs)

    @cached_property
    def _shortest(self) -> tuple[float, float]:
        return max(self.borne, key=lambda each: each[0] ** self.exponent * each[1])

    @property
    def equivalent(self) -> float:
        """Equivalent load [N]."""
        return self._shortest[0]

    @property
    def travel(self) -> float:
        """Turns a revolution of the input."""
        return self._shortest[1]

    @property
    def peak(self) -> float:
        """Maximum force [N]."""
        return self.design.contact_force_max


def _run(stroke: SwingStroke, exponent: float) -> Reals:
    """int F^p |n| dt and int |n| dt over a stroke, per revolution of the input [N^p rad, rad]."""
    found = np.zeros(2)
    for first, last in stroke.parts:
        inside = [place - first for place in stroke.joints if first < place < last]
        panels = Panels.over(last - first, inside, (last - first) / _RUN_PANELS)
        k = first + panels.nodes
        turned = np.abs(stroke.bearing_speed(k)) * stroke.width / abs(stroke.loads.speed)
        force = np.abs(stroke.force(k))
        found += [panels.integral(force**exponent * turned), panels.integral(turned)]
    return found


class StrokesInARow:
    """All strokes one after the other, each over the places 2 i + k, so that a search looks at all of them at once."""

    def __init__(self, loads: WideSwingLoads) -> None:
        self.loads, self.strokes = loads, loads.strokes
        self.force, self.contact = kept_last(self._force), kept_last(self._contact)

    def _each(self, of: Callable[[SwingStroke, Reals], Reals], places: Reals) -> Reals:
        """What the stroke of each place has there."""
        number, found = np.floor(0.5 * places), np.empty(places.shape)
        for i, stroke in enumerate(self.strokes):
            own = number == i
            if own.any():
                found[own] = of(stroke, places[own] - 2.0 * i)
        return found

    def _force(self, places: Reals) -> Reals:
        angle = self._each(SwingStroke.pressing_angle, places)
        found: Reals = self.loads.machine.reactions(angle).unknowns["roller"][0]
        return found

    def _contact(self, places: Reals) -> LineContact | None:
        return contact_of(self.loads.section, self.force(places), self._each(SwingStroke.relative_radius, places))

    def pressed(self) -> list[dict[str, Extreme]]:
        """Extremes of force, pressure and depth of the shear of each stroke, where the roller touches."""
        wanted: Wanted = {"force": (lambda at: np.abs(self.force(at)), True), "least_force": (self.force, False)}
        of_force = len(wanted)
        names = ("pressure",) if self.loads.spec.drive is not None else ("pressure", "shear_depth")
        if self.loads.section.roller is not None:
            wanted |= {name: (partial(self._of_contact, name), True) for name in names}
        every = range(len(wanted))
        asked: list[tuple[int, tuple[float, float], range]] = []
        for i, stroke in enumerate(self.strokes):
            parts, curved = stroke.parts, stroke.curved_parts
            if parts == curved:
                asked += [(i, part, every) for part in parts]
            else:
                asked += [(i, part, every[:of_force]) for part in parts]
                asked += [(i, part, every[of_force:]) for part in curved if every[of_force:]]
        return self._sought(wanted, asked)

    def _of_contact(self, name: str, places: Reals) -> Reals:
        return np.asarray(getattr(self.contact(places), name))

    def _sought(self, wanted: Wanted, asked: list[tuple[int, tuple[float, float], range]]) -> list[dict[str, Extreme]]:
        """Extremes by stroke; of each part of one those whose numbers are given."""
        names = list(wanted)
        parts, numbers = (
            [(2.0 * i + start, 2.0 * i + end) for i, (start, end), _ in asked],
            [some for *_, some in asked],
        )
        found: list[dict[str, Extreme]] = [{} for _ in self.strokes]
        tops = extremes_of_parts(list(wanted.values()), parts, samples=128, sought=numbers)
        for (i, _, some), of_part in zip(asked, tops, strict=True):
            for name, top in zip([names[k] for k in some], of_part, strict=True):
                better, at = max if wanted[name][1] else min, top._replace(place=top.place - 2.0 * i)
                found[i][name] = better(found[i].get(name, at), at, key=lambda extreme: extreme.value)
        return found


_RPM = 2.0 * math.pi / 60.0
_CONTACT = (
    "contact_force_max",
    "hertz_pressure_max",
    "shear_depth",
    "roller_speed_max",
    "entrainment_speed_max",
    "cam_torque_max",
    "cam_torque_min",
    "cam_torque_rms",
    "lift_off_speed",
)
_OF_TURN = ("bearings", "flywheel", "motor")
_PINS = ("O", "O_return", "D", "E", "F", "A", "B", "C")


class WideSwingLoads(LoadsDesign):
    """Cam on O, rocker on D; a twin-cam with its whole cycle has a second cam that turns the other way, on O_return.

    A slider hangs on the rocker by a rod from E to F; a cam on a crank-rocker is driven by its crank, A to B, and its
    coupler, B to C.
    """

    kind = "wide-swing-cam"
    spec: WideSwingSpec
    section: Section
    section_example = "roller: {width: 20}"
    links = ("rocker", "cam", "return_cam", "rod", "slider", "crank", "coupler")
    sliding = ("slider",)
    output = "rocker"
    pins, meshes = _PINS, (GEARS,)
    stands = True
    other_bearings = (ROLLERS,)
    outlines = loads_outline(
        _PINS,
        (GEARS,),
        (*_CONTACT, *(f"{ROLLERS}.{name}" for name in PIN[1:])),
        (*CAM_CHECKS[:2], "body-clearance"),
        ("torque", "contact_stroke"),
    )
    extra_tables = (*LoadsDesign.extra_tables, "contact_stroke")
    derived = LoadsDesign.derived | {*_CONTACT}
    design: cached_property[WideSwingDesign] = geometry(WideSwingDesign)

    @property
    def cam(self) -> AnyCam:
        """The cam of the working stroke."""
        return self.design.cam

    @property
    def whole(self) -> bool:
        """Whether the file gives the whole revolution."""
        return self.spec.cycle is not None or self.spec.drive is not None

    @property
    def cost(self) -> float:
        """Each stroke with its rests takes as long to judge as a whole revolution of other machines."""
        return (2 if self.spec.cycle is not None else 1) * super().cost

    @cached_property
    def strokes(self) -> tuple[SwingStroke, ...]:
        """The working stroke, and what brings the rocker back where the whole revolution is known."""
        return tuple(SwingStroke(stroke, self) for stroke in strokes_of(self.design))

    has_return_cam: bool = placed("design.has_return_cam")

    @cached_property
    def own_links(self) -> tuple[str, ...]:
        """Rocker and cam, and what the file has besides."""
        spec = self.spec
        has = {"return_cam": self.has_return_cam}
        has |= dict.fromkeys(("rod", "slider"), spec.slider is not None)
        has |= dict.fromkeys(("crank", "coupler"), spec.drive is not None)
        for name, given in self.section.links:
            if given is not None and not has.get(name, True):
                raise NoSolution(f"this mechanism has no {name}", key=f"loads.links.{name}", fix="omit its mass")
        return tuple(name for name in self.links if has.get(name, True))

    @property
    def given_speed(self) -> float:
        """Speed of the cam [1/min]."""
        return self.spec.speed

    @cached_property
    def masses(self) -> dict[str, Mass]:
        """Rocker and slider of their own sections, and what the file gives the others."""
        found = super().masses
        unloader = self.spec.unloader
        if unloader.type == "gravity":  # its moment of inertia about its own centre counts in that of the rocker
            way = cmath.rect(unloader.distance, math.radians(self.section.device_direction or 0.0))
            found["rocker"] = Mass(self.design.unloading.size.mass, self.spec.inertia, way)
        elif self.spec.inertia:
            found["rocker"] = Mass(0.0, self.spec.inertia)
        if self.spec.slider is not None:
            found["slider"] = Mass(self.spec.slider.mass)
        return found

    @cached_property
    def machine(self) -> Machine:
        """Everything, with the device."""
        self._require_turn()
        self._require_own_directions()
        for stroke in self.strokes:
            stroke.cam.require_profile()
        return replace(
            super().machine, more=partial(_pull_of_device, self), stroke=0.0 if self.whole else self.cam.cycle_angle
        )

    def _require_turn(self) -> None:
        """Refuse what a stroke alone cannot tell."""
        given = next((key for key in _OF_TURN if getattr(self.section, key)), None)
        if self.whole or given is None:
            return
        message = f"{given} needs the whole revolution of the cam\ngive cycle instead of cycle_angle"
        if self.spec.slider is not None:
            message = (
                f"{given} needs the full revolution of the cam; with slider only the stroke is known\nomit {given}"
            )
        raise MissingSection(message, key=f"loads.{given}")

    def _require_own_directions(self) -> None:
        """Refuse a direction of what is not there, and a weight whose direction the file leaves open."""
        if self.spec.unloader.type == "gravity" and any(self.section.gravity):
            self._require_hanging(complex(*self.section.gravity))
        for name in ("slider", "drive"):
            key, has = f"{name}_direction", getattr(self.spec, name) is not None
            given = getattr(self.section, key) is not None
            if given and not has:
                raise NoSolution(f"this mechanism has no {name}", key=f"loads.{key}", fix=f"omit {key}")
            if has and not given and any(self.section.gravity):
                words = f"the weight depends on the direction of the {name}"
                raise MissingSection(words, key="loads.gravity", fix=f"give loads.{key}")

    def _require_hanging(self, gravity: complex) -> None:
        """Refuse a pendulum that does not hang along the gravity of the file."""
        given, down = self.section.device_direction, math.degrees(cmath.phase(gravity))
        if given is None or abs(math.remainder(given - down, 360.0)) > _HANGS:
            message = "the mass of type: gravity hangs along loads.gravity at mid-swing"
            raise NoSolution(message, key="loads.device_direction", fix=f"set loads.device_direction to {short(down)}")

    @property
    def dwell_zones(self) -> list[tuple[float, float]]:
        """Both rests of a whole revolution."""
        if self.spec.cycle is None:
            return []
        working, far, back, near = self.design.motion.cycle_angles
        return [(working, far), (working + far + back, near)]

    @property
    def own_directions(self) -> tuple[str, ...]:
        """That of the device, and those of slider and drive where the file has them."""
        others = tuple(f"{name}_direction" for name in ("slider", "drive") if getattr(self.spec, name) is not None)
        return ("device_direction", *others)

    @property
    def unknown_joints(self) -> tuple[str, ...]:
        """Those of a link on which something pulls whose direction the file leaves open."""
        section, spec = self.section, self.spec
        slider_open = spec.slider is not None and section.slider_direction is None
        found = ["D"] if section.device_direction is None or slider_open else []
        if spec.drive is not None and section.drive_direction is None:
            found.append("O")
        return tuple(found)

    # The stroke

    @property
    def own_forces(self) -> bool:
        """Whether more acts than the inertia of rocker and slider, and the device; of a slider its weight does."""
        others = set(self.machine.masses) - ({"rocker"} if self.machine.gravity else {"rocker", "slider"})
        return self.machine.sources.any or self.machine.friction is not None or bool(others)

    def _greatest(self, name: str, *, curved: bool = False) -> float:
        """Maximum value over the strokes of a method of theirs, where the roller touches."""
        return max(
            stroke.greatest(lambda k, stroke=stroke: np.abs(getattr(stroke, name)(k)), curved=curved)  # type: ignore[misc]
            for stroke in self.strokes
        )

    @cached_property
    def of_strokes(self) -> list[dict[str, Extreme]]:
        """What `SwingStroke.pressed` gives of each stroke; the machine is computed once a round for all of it."""
        return StrokesInARow(self).pressed()

    @cached_property
    def rests(self) -> tuple[SwingRest, ...]:
        """The rests of a whole cycle, each on the cam of the stroke before it; those of no length left out."""
        zones = zip(self.strokes, self.dwell_zones, strict=False)
        return tuple(SwingRest(stroke, *zone) for stroke, zone in zones if zone[1] > LEAST)

    def _pressed(self, name: str) -> list[float]:
        """A value of every stroke and every rest."""
        return [each.pressed[name].value for each in self.strokes] + [each.pressed[name] for each in self.rests]

    @cached_property
    def contact_force_max(self) -> float:
        """Maximum force of the roller on any of the cams [N]; from geometry alone where nothing acts besides."""
        if self.own_forces:
            return max(self._pressed("force"))
        in_rests = self.design.unloading.dwell_force([rest.stroke.cam for rest in self.rests]) if self.rests else 0.0
        return max(self.design.contact_force, in_rests)

    @cached_property
    def least_contact_force(self) -> float:
        """Minimum force of the roller where it touches a cam [N]."""
        return min(self._pressed("least_force"))

    @cached_property
    def bears(self) -> bool:
        """Whether the roller has a width and bears on its cams wherever it touches them."""
        if self.section.roller is None or any(rest.relative_radius <= 0.0 for rest in self.rests):
            return False
        return not any(stroke.is_undercut for stroke in self.strokes)

    @cached_property
    def hertz_pressure_max(self) -> float | None:
        """Maximum pressure of roller and cam [N/mm^2]; None without a width, and where the cam is undercut."""
        return max(self._pressed("pressure")) if self.bears else None

    @cached_property
    def shear_depth(self) -> float | None:
        """Maximum depth of the maximum shear stress [mm]; with a drive, that where the pressure is greatest."""
        if not self.bears:
            return None
        if self.spec.drive is None:
            return max(self._pressed("shear_depth"))
        hardest = max(self.strokes, key=lambda each: each.pressed["pressure"].value)
        return hardest.shear_depth_at_greatest_pressure

    @cached_property
    def rollers_found(self) -> RollerLoad | None:
        """What the bearings of the rollers bear; None where the file gives none."""
        bearing = self.section.bearings.get(ROLLERS)
        return None if bearing is None else RollerLoad(self, bearing)

    def borne_by(self, name: str) -> Any:
        """What a bearing of the file bears, that of the rollers among them."""
        return self.rollers_found if name == ROLLERS else super().borne_by(name)

    def mesh(self, name: str) -> Any:
        """A mesh, or what the file calls as one: the bearings of the rollers."""
        return self.rollers_found if name == ROLLERS else super().mesh(name)

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which the roller leaves a cam, by all that acts but friction [1/min]; None where nothing lifts it.

        N = N_0 + w^2 N_1 and N = 0, less the share of the inertia that the device misses
        """
        if not self.own_forces:
            return self.design.unloading.lift_off_speed
        least = [each.least_standing for each in self.strokes]
        if min([*least, *(rest.least_standing for rest in self.rests)]) <= 0.0:
            return 0.0
        worst = max(each.most_unloading for each in self.strokes)
        return math.sqrt(1.0 / worst) / _RPM if worst > 0.0 else None

    @property
    def roller_speed_max(self) -> float:
        """Maximum speed of the roller where it touches [1/min]."""
        return self._greatest("roller_speed") / _RPM

    @property
    def entrainment_speed_max(self) -> float:
        """Maximum entrainment speed where the roller touches [mm/s]."""
        return self._greatest("entrainment", curved=True)

    cam_torque_max: float = placed("input_torque_max")
    cam_torque_min: float = placed("input_torque_min")
    cam_torque_rms: float = placed("input_torque_rms")

    # Vibration

    @cached_property
    def vibrating(self) -> Vibrating:
        """The rocker on the shaft that drives it."""
        return SwingVibrating(self)

    def raw(self, name: str) -> Any:
        """A stroke alone has no turns to count; a crank drives no cam shaft."""
        no_shaft = self.spec.drive is not None and name.startswith("cam_torque")
        return None if no_shaft or (name.endswith(".travel") and not self.whole) else super().raw(name)

    @property
    def changes_apart(self) -> bool:
        """Whether device and roller change sides at different places."""
        return any(check.status == "fail" for check in self.design.check("side-change"))

    def candidates(self, check: str, /) -> Iterator[Remedy]:
        """Directions that are clear; of a slider whose arm stands ill what lets the device hold the roller all the way,
        alone and with more reserve."""
        if check == "body-clearance":
            yield from _clear_directions(self)
        section, reserve = self.spec.slider, self.design.unloading.size.reserve
        if check == "contact-loss" and section is not None and self.changes_apart:
            for changes in side_changes(section):
                yield changes
                yield from ((*changes, ("unloader.reserve", at_least(reserve + more, 0.01))) for more in (0.25, 1.0))
        yield from super().candidates(check)

    def rows(self, samples: int | None) -> tuple[Reals, dict[str, tuple[Any, str]]]:
        """Input angles of a table's rows [rad] and its first columns; k over the stroke where the file has no cycle."""
        if self.whole:
            return super().rows(samples)
        k = range_rows(0.0, 1.0, samples or _STEPS)
        phi = k * self.cam.cycle_angle
        return phi, {"k": (k, "1"), "input_angle": (np.degrees(phi), "deg")}

    def table_contact_stroke(self, samples: int | None = None) -> Table:
        """Force, pressure and speeds of the roller over each stroke; empty where it touches nothing."""
        k = range_rows(0.0, 1.0, samples or _STEPS)
        columns: dict[str, tuple[Any, str]] = {"k": (k, "1")}
        for stroke in self.strokes:
            later = "" if stroke.name == "main" else "return_"
            found = stroke.columns(k)
            columns[f"{later}cam_angle"] = (np.degrees(stroke.angle(k)), "deg")
            columns |= {f"{stroke.name}_{name}": found[name] for name in ("force", "pressure", "radius")}
            columns |= {f"{later}{name}": found[name] for name in ("roller_speed", "entrainment")}
            torque = np.full_like(k, np.nan) if self.locked else self.machine.torque(stroke.angle(k))
            columns[f"{later}input_torque"] = (torque, "N m")
        return Table.of("contact_stroke", columns)

    def table_harmonics(self, samples: int | None = None) -> Table:
        """Harmonics of the rocker's motion over a whole revolution."""
        if not self.whole:
            if self.spec.slider is not None:
                raise NoSolution("harmonics need a whole revolution, but only the stroke is known here", key="loads")
            message = "harmonics need a whole revolution"
            raise MissingSection(message, key="cycle_angle", fix="give cycle instead of cycle_angle")
        return tables.harmonics(self, samples)

    def check_contact_pressure(self) -> Iterator[Check]:
        """GL607, where the file gives an allowed pressure."""
        allowed = None if self.section.material is None else self.section.material.allowed_pressure
        found, roller = self.hertz_pressure_max, self.section.roller
        if allowed is None:
            return
        if roller is None:
            yield no_width(allowed)
            return
        if found is None:
            yield pressed_where_undercut("the roller presses where its cam", allowed)
            return
        at = next((f"the {rest.words}" for rest in self.rests if rest.pressed["pressure"] == found), "")
        yield pressure_check("contact pressure of the roller", found, allowed, at)

    def check_contact_loss(self) -> Iterator[Check]:
        """GL608: the device holds the roller on its cam up to the lift-off speed, and against all that acts besides."""
        speed, limit = self.spec.speed, self.lift_off_speed
        slider, fix = self.spec.slider, "increase unloader.reserve"
        if slider is not None and self.changes_apart:
            fix = side_words(slider)
        status: Status
        if limit is not None:
            status = "fail" if limit < speed * (1.0 - 1e-9) else "pass"
            yield codes.CONTACT_LOSS.check(status, "lift-off speed of the roller", limit, speed, "1/min", fix=fix)
        if not self.own_forces and slider is None:
            return
        least = self.least_contact_force
        status = "fail" if least < 0.0 else "pass"
        what, overlap = "minimum contact force of the roller", "missing contact force: the roller leaves its cam"
        yield codes.CONTACT_LOSS.check(status, what, least, 0.0, "N", overlap=overlap, fix=fix)

    def check_resonance(self) -> Iterator[Check]:
        """GL611, of a whole revolution."""
        return resonance(self) if self.whole else iter(())

    check_body_clearance = bodies.placed_clearance


def _pull_of_device(loads: WideSwingLoads, mechanism: Mechanism, _phi: Reals) -> list[Force | Torque]:
    """The pull of the device on its pin of the rocker, towards its base pin; of a pendulum its weight."""
    unloader, unloading = loads.spec.unloader, loads.design.unloading
    way = cmath.rect(1.0, math.radians(loads.section.device_direction or 0.0))
    rocker = mechanism.links["rocker"]
    if unloader.type == "gravity":  # what gravity of the file pulls already is not pulled twice
        weight = unloading.size.mass * (unloader.gravity * way - complex(*loads.section.gravity))
        return [Force("rocker", np.full(len(rocker.unit), weight), rocker.at(unloader.distance * way))]
    arm = unloader.arm
    pin = rocker.at(arm * way)
    # In arms from the pivot: of any size, and a short one is not lost.
    along = way * (unloader.pivot_ratio - rocker.unit)
    length = np.abs(along)
    if unloader.type == "pneumatic":
        pull = np.full(length.shape, unloading.force or 0.0)
    else:
        geometry = loads.design.motion.law.geometry
        mounted = geometry.shortest - geometry.mounting
        pull = (unloading.spring_rate or 0.0) * arm * (length - mounted)
    return [Force("rocker", pull * along / length, pin)]
