"""The register budget of a three-gear four-bar: what the errors of its parts cost at the output while it dwells."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.machines.three_gear import motion
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.dwell_synthesis import DwellSynthesis
from gearlink.core.machines.three_gear.samples import ThreeGearSamples
from gearlink.core.machines.three_gear.synthesis import (
    BackStepSynthesis,
    MomentaryDwellSynthesis,
    VariableSpeedSynthesis,
)
from gearlink.core.mechanism.dual import Shift
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.standstills import zeros_over_turn
from gearlink.core.studies.register.design import RegisterDesign, no_such_place
from gearlink.core.studies.register.gains import turning
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sources import Parts

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.spec import ThreeGearSpec
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.studies.register.gains import Output

_OF_IDLER = (Shift("coupler", ("B",), -1.0),)  # a longer coupler: the crank side stands back
_OF_OUTPUT = (Shift("rocker", ("D",), -1.0),)
_SYNTHESES = {
    "synth dwell": DwellSynthesis,
    "synth back-step": BackStepSynthesis,
    "synth variable-speed": VariableSpeedSynthesis,
    "synth momentary-dwell": MomentaryDwellSynthesis,
}


class ThreeGearRegister(RegisterDesign):
    """Error of the output at its reference circle over the dwell."""

    kind = "three-gear-four-bar"
    spec: ThreeGearSpec
    default_at = "dwell"
    sizes = {
        "links.crank": (Shift("crank", ("B", "mesh_13")),),
        "links.frame": (Shift("frame", ("D", "D_output")),),
        "centers.crank_idler": _OF_IDLER,
        "centers.idler_output": _OF_OUTPUT,
    }
    pins = {"B": _OF_IDLER, "C": _OF_OUTPUT, "D": (Shift("frame", ("D", "D_output"), 1.0, "frame"),)}
    gears = {"crank": "crank", "idler": "idler", "output": "output"}

    def __init__(self, spec: Any) -> None:
        asked = spec.syntheses() if spec.links is None else ()
        if asked:  # done once; its links are what scatters
            found = _SYNTHESES[asked[0]](spec).completion()
            spec = changed(spec, [(one.path, one.value) for one in found])
        super().__init__(spec)

    @cached_property
    def design(self) -> ThreeGearFourBar:
        """The drive."""
        return ThreeGearFourBar(self.spec)

    @cached_property
    def parts(self) -> Parts:
        """Centre distances, pins and gears."""
        return ThreeGearSamples(self.design).parts

    @cached_property
    def radius(self) -> float:
        """Radius at which the error of the output is measured [mm]."""
        return self.section.radius or self._reference

    @property
    def _reference(self) -> float:
        """Reference radius of the output gear [mm]."""
        return 0.5 * self.spec.gears.module * abs(self.design.output_teeth)

    def mechanism(self, input_angle: Reals) -> Mechanism:
        """The five links."""
        return self.design.moving.make(input_angle, 1, 1)

    def output(self, _input_angle: Reals) -> Output:
        """The circle of the output gear, as the output is counted."""
        return turning("output", self.radius, self.design.train.sense)

    def stretch(self, at: str) -> tuple[float, float]:
        """The dwell: within the tolerance where the file gives one, else phi13."""
        if at != "dwell":
            raise no_such_place(at, ("dwell",))
        design = self.design
        if design.tolerance_dwell is not None:
            start, length = design.tolerance_dwell.start, design.tolerance_dwell.crank_angle
        elif design.back_step is not None and design.dwell_angle is not None:
            start, length = design.back_step.start, design.dwell_angle
        else:
            raise NoSolution(
                "this drive has no dwell", key="register.at", fix="give dwell_tolerance, or --at an input angle"
            )
        return start, start + length

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, and the wind-up of the output's shaft."""
        found = super().contributions(input_angle, torque_sign)
        if self.section.stiffness is not None and self.output_torque is not None:
            found.append(self._wind_up(input_angle))
        return found

    def _wind_up(self, input_angle: Reals) -> Contribution:
        """Lag of the output behind its gear under the torque that moves it: in every machine alike, without scatter."""
        assert self.output_torque is not None
        assert self.section.stiffness is not None
        torque = np.array([self.output_torque(float(phi)) for phi in input_angle])
        counted = self._ahead.sense * self.design.train.sense
        gain = -counted * self.radius * torque / self.section.stiffness
        return Contribution("wind-up of the output shaft", gain, 1.0, 0.0, mean=1.0)

    # Torque and backlash

    @cached_property
    def backlash(self) -> dict[str, float]:
        """Circumferential backlash of both meshes [mm]."""
        return self.section.backlash_of(("crank_idler", "idler_output"))

    @cached_property
    def dead_band(self) -> float | None:
        """The jump at the radius that is asked for [mm]."""
        if not self.backlash:
            return None
        return sum(self.backlash.values()) * self.radius / self._reference

    @property
    def _by_inertia_alone(self) -> bool:
        """Whether the file leaves out what friction and load are weighed against, or both."""
        section = self.section
        if section.output_inertia is None:
            return not section.friction and not section.load
        return self.spec.input_speed is None

    @property
    def _ahead(self) -> motion.GearTrain:
        """The train with its output counted in the direction of its mean motion."""
        return motion.forward(self.design.linkage, self.design.train)

    @cached_property
    def output_torque(self) -> Any:
        """Torque on the output in its forward sense [N m] over the crank angle; None where the file has nothing of it.

        T = J W' w^2 + T_f sign(W) + T_load
        """
        section, speed = self.section, self.spec.input_speed
        design, train = self.design, self._ahead
        if section.output_inertia is None and not section.friction and not section.load:
            return None
        if speed is None and section.output_inertia is not None:
            raise NoSolution("the torque of the output's inertia needs input_speed (1/min)", key="input_speed")
        inertia = 0.0 if speed is None else (section.output_inertia or 0.0) * (speed * math.pi / 30.0) ** 2

        def torque(phi: float) -> float:
            speed_ratio = motion.output_speed(design.linkage, train, phi)
            friction = math.copysign(section.friction, speed_ratio) if speed_ratio else 0.0
            return inertia * motion.output_acceleration(design.linkage, train, phi) + friction + section.load

        return torque

    @cached_property
    def flips(self) -> list[float] | None:
        """Crank angles at which the output's torque turns [rad]; by inertia alone where W' does."""
        design = self.design
        if self._by_inertia_alone:
            return zeros_over_turn(lambda phi: motion.output_acceleration(design.linkage, design.train, phi))
        return zeros_over_turn(self.output_torque)

    @property
    def judges_flips(self) -> bool:
        """Where the file tells of backlash or of what the output carries."""
        return bool(self.backlash) or self.section.output_inertia is not None or not self._by_inertia_alone

    @property
    def against_flips(self) -> str:
        """The friction that keeps the sign in a drive that never turns back."""
        section, speed = self.section, self.spec.input_speed
        if self.design.motion == "back-step" or section.output_inertia is None or speed is None:
            return "brake the output, or preload the gears"
        extremes = self.design.acceleration_extremes
        rate = speed * math.pi / 30.0
        most = section.output_inertia * rate * rate * max(abs(extremes.greatest), abs(extremes.least))
        return f"a friction torque above {most:.4g} N m on the output keeps the sign"
