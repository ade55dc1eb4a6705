"""The register of any machine that has a motion: what the errors of its parts cost at its first output."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution, named
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.mechanism.joints import Contact, Pin, SharedContact, Toothed
from gearlink.core.mechanism.motion import Course
from gearlink.core.numerics.arrays import Reals, turn_degrees
from gearlink.core.studies.loads.zeros import zeros
from gearlink.core.studies.register.design import RegisterDesign, no_such_place
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sources import Parts

if TYPE_CHECKING:
    from gearlink.core.base.design import Design
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.studies.register.gains import Off, Output
    from gearlink.core.studies.register.movable import Errors, Movable

_RPM = math.pi / 30.0


def _turned(x: Course, y: Course, angle: float) -> Course:
    """A point along a direction, from its coordinates."""
    if angle == 0.0:
        return x
    along, across = math.cos(angle), math.sin(angle)
    return Course(
        x.unit,
        lambda mechanism: [
            along * np.asarray(a) + across * np.asarray(b)
            for a, b in zip(x.of(mechanism), y.of(mechanism), strict=True)
        ],
    )


class MotionRegister(RegisterDesign):
    """Error of the first output of a motion, at a radius where it turns, over the range of the input or at one place.

    Parameters
        spec : spec of a kind that has a motion
    """

    kind = ""  # that of its design file
    default_at = "range"
    has_outputs = True

    def __init__(self, spec: Any) -> None:
        kind = KINDS[spec.kind]
        made = kind.class_for("analyze", spec)(spec)
        if spec.sized_by("analyze"):  # its links are what scatters
            spec = changed(spec, [(one.path, one.value) for one in made.completion()])
            made = kind.class_for("analyze", spec)(spec)
        super().__init__(spec)
        self.record, self.design = kind, made
        self.kind = kind.name  # type: ignore[misc]  # of a class that serves all kinds

    design: Design

    @cached_property
    def motion(self) -> Motion:
        """The motion of the design.

        Raises
            NoSolution - where a slide is its input
        """
        found = self.design.moving
        if found.input.unit != "rad":
            message = "a register is taken over an input angle"
            raise NoSolution(message, key="drive.slide", fix="drive a link instead of a slide")
        return found

    @cached_property
    def course(self) -> Course:
        """The output: the first one, or that of `register.output`; of a point along its direction.

        Raises
            NoSolution - for an output that the machine does not have
        """
        found = {each.name.replace(", ", " "): each.course for each in self.motion.outputs}
        names = list(dict.fromkeys(name.removesuffix(" x").removesuffix(" y") for name in found))
        name = names[0] if self.section.output is None else self.section.output
        if name not in names:
            message = f"no output {named(name)} here: it has {', '.join(names)}"
            raise NoSolution(message, key="register.output")
        direction = self.section.direction
        if f"{name} y" not in found:
            if direction is not None:
                raise NoSolution(f"direction belongs to a point: {name} is none", key="register.direction")
            return found[name]
        return _turned(found[f"{name} x"], found[f"{name} y"], math.radians(direction or 0.0))

    @property
    def _turns(self) -> bool:
        return self.course.unit == "rad"

    @cached_property
    def _at_start(self) -> Mechanism:
        return self.motion.make(np.array([self.motion.input.start]), 1, 1)

    @cached_property
    def movable(self) -> Movable:
        """What its sources move."""
        found: Movable = self.record.movable(self.design, self._at_start)
        return found

    @cached_property
    def parts(self) -> Parts:
        """Centre distances, pins and gears."""
        pins = tuple(each.name for each in self._at_start.connections if isinstance(each, Pin))
        gears = {name: gear.teeth for name, gear in self.movable.gears.items()}
        return Parts(dict(self.movable.centers), pins + self.movable.rollers, gears, dict(self.movable.others))

    @property
    def errors(self) -> Errors:
        """By size, what it moves."""
        return self.movable.sizes

    @property
    def pins(self) -> Errors:  # type: ignore[override]
        """By pin, what its play moves where that is not the element on the first link."""
        return self.movable.pins

    @property
    def gears(self) -> dict[str, str]:  # type: ignore[override]
        """By gear, its link."""
        return {name: gear.link for name, gear in self.movable.gears.items()}

    @cached_property
    def radius(self) -> float:
        """Radius at which the error of an output that turns is measured [mm]; of one that slides 1."""
        if not self._turns:
            if self.section.radius is not None:
                raise NoSolution("radius belongs to an output that turns: this one slides", key="register.radius")
            return 1.0
        radius = self.section.radius or self.movable.radius
        if not radius:
            raise MissingSection(
                "the register of an output that turns needs a radius",
                key="register.radius",
                fix="give register.radius (mm), the radius at which its error is measured, or --radius",
            )
        return radius

    def mechanism(self, input_angle: Reals) -> Mechanism:
        """Links and joints."""
        return self.motion.make(input_angle, 1, 1)

    def output(self, _input_angle: Reals) -> Output:
        """The output [mm]; what an error adds to it by itself stands in `parts`."""
        course, radius, own = self.course, self.radius, self.movable.own

        def output(mechanism: Mechanism, parts: Off = None) -> Sequence[Reals]:
            value, *rates = (radius * np.asarray(rate) for rate in course.of(mechanism))
            for key, error in (parts or {}).items():
                if key in own:
                    value = value + radius * error * own[key].of(mechanism)[0]
            return [value, *rates]

        return output

    def own_gain(self, key: str, input_angle: Reals) -> Reals | None:
        """Gain of a size that places the output on its link."""
        if key not in self.movable.own:
            return None
        return np.asarray(self.radius * self.movable.own[key].rates(self.motion, input_angle, 0)[0])

    def stretch(self, at: str) -> tuple[float, float]:
        """The whole range of the input, or its period; or a part of it that the kind names."""
        places = self.movable.places
        if at in places:
            return places[at]
        if at != "range":
            raise no_such_place(at, ("range", *places))
        return self.motion.input.start, self.motion.input.end

    def cycle_degrees(self, samples: int | None) -> Reals:
        """Inputs of tables over the cycle: a period, or the range."""
        given = self.motion.input
        if given.turns is not None:
            return turn_degrees(samples, given.turns)
        return np.degrees(np.linspace(given.start, given.end, samples or 361))

    # Torque and backlash

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, the backlash of the meshes, and the wind-up of the output's shaft."""
        gains = self.gains(input_angle, torque_sign)
        found = self.of_sources(gains, input_angle) + gains.backlash(self.backlash)
        if self.section.cam_error is not None:
            found += [gains.profile(roller, self.section.cam_error) for roller in self._rollers]
        if self.section.stiffness is not None and self._carries:
            lag = -self.radius * self.output_torque(input_angle) / self.section.stiffness
            found.append(Contribution("wind-up of the output shaft", lag, 1.0, 0.0, mean=1.0))
        return found

    @cached_property
    def backlash(self) -> dict[str, float]:
        """Circumferential backlash of each mesh on the way [mm]."""
        meshes = tuple(each.name for each in self._at_start.connections if isinstance(each, Toothed))
        if not meshes and self.section.backlash is not None:
            raise NoSolution("no mesh lies on the way to the output", key="register.backlash", fix="omit backlash")
        return self.section.backlash_of(meshes)

    @cached_property
    def _rollers(self) -> list[str]:
        """The contacts with cams."""
        found = [each.name for each in self._at_start.connections if isinstance(each, (Contact, SharedContact))]
        if not found:
            raise NoSolution("no cam lies on the way to the output", key="register.cam_error", fix="omit cam_error")
        return found

    @cached_property
    def dead_band(self) -> float | None:
        """How far the output jumps where its torque turns, at most over the stretch [mm]."""
        if not self.backlash:
            return None
        gains = self.gains(self.input_angles, 1)
        jumps = [play * np.abs(gains.dual.play(mesh)) for mesh, play in self.backlash.items()]
        return float(np.sum(jumps, axis=0).max())

    @property
    def _carries(self) -> bool:
        """Whether the file tells of a torque on the output."""
        section = self.section
        given = [name for name in ("output_inertia", "friction", "load", "stiffness") if getattr(section, name)]
        if given and not self._turns:
            raise NoSolution(f"{given[0]} belongs to an output that turns: this one slides", key=f"register.{given[0]}")
        return any(name != "stiffness" for name in given)

    @property
    def _inertia(self) -> float:
        """Torque of the output's inertia per 1/rad of its acceleration ratio [N m].

        Raises
            NoSolution - where it is weighed against friction and load without a speed
        """
        section, speed = self.section, getattr(self.spec, "input_speed", None)
        if section.output_inertia is None:
            return 0.0 if section.friction or section.load else 1.0
        if speed is None:
            if section.friction or section.load or section.stiffness is not None:
                raise NoSolution("the torque of the output's inertia needs input_speed (1/min)", key="input_speed")
            return 1.0
        inertia: float = section.output_inertia * (speed * _RPM) ** 2
        return inertia

    def output_torque(self, input_angle: Reals) -> Reals:
        """Torque on the output in the sense in which it counts, over (N,) inputs [rad]; (N,) array [N m].

        T = J W' w^2 + T_f sign(W) + T_load; where the file has none of them, W' alone
        """
        _, rate, second = self.course.rates(self.motion, input_angle, 2)
        section = self.section
        return np.asarray(self._inertia * second + section.friction * np.sign(rate) + section.load)

    @cached_property
    def flips(self) -> list[float] | None:
        """Inputs at which the torque on the output turns [rad]; by inertia alone where W' does."""
        _, given = self._carries, self.motion.input
        found = zeros(
            lambda q: self.output_torque(q + given.start),
            given.end - given.start,
            max(1, math.ceil((given.end - given.start) / (2.0 * math.pi) - 1e-9)),
        )
        return [given.start + place for place in found]

    @property
    def judges_flips(self) -> bool:
        """Where the file tells of backlash or of what the output carries."""
        return bool(self.backlash) or self._carries
