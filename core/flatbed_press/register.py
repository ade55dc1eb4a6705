"""The register of a flatbed press: bed against cylinder in the synchronous zone, mm at the print.

Delta = dp - dq - ds: the bed's travel less the cylinder's less what the cam takes back. What is the same over the whole
zone shifts the print and costs no register, so every error counts relative to the start of the zone.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.flatbed_press.chains import difference
from gearlink.core.flatbed_press.design import FlatbedPress
from gearlink.core.linkages import fourbar_sweep
from gearlink.core.linkages.loop_gains import LoopGains, loop_gains
from gearlink.core.numerics.arrays import Reals
from gearlink.core.results import cached_property
from gearlink.core.tolerance.budget import Contribution
from gearlink.core.tolerance.register_design import RegisterDesign, contribution, no_such_place
from gearlink.core.tolerance.sources import Parts, Scatter

if TYPE_CHECKING:
    from gearlink.core.flatbed_press.spec import FlatbedPressSpec

_LINKS = ("crank", "coupler", "rocker", "frame")
_PINS = ("A", "B", "C", "D", "E", "F", "G", "H", "M", "N")


class PressGains:
    """Gains of every part of a press over input angles [mm per mm, of angles mm/rad].

    Parameters
        design : FlatbedPress
        input_angle : (N,) array [rad]
    """

    def __init__(self, design: FlatbedPress, input_angle: Reals) -> None:
        self.motion, self.phi = design.motion, input_angle

    @cached_property
    def bed_links(self) -> LoopGains:
        """Turn of CD per error of the bed's drag link."""
        chain = self.motion.bed
        angle = chain.initial_crank_angle + self.phi
        state = fourbar_sweep.solve(chain.linkage, angle)
        return loop_gains(angle, state.coupler_angle, state.rocker_angle, chain.linkage.rocker)

    @cached_property
    def cylinder_links(self) -> LoopGains:
        """Turn of MN per error of the cylinder's drag link."""
        chain = self.motion.cylinder
        angle = chain.initial_angle - self.phi
        state = fourbar_sweep.solve(chain.linkage, angle)
        return loop_gains(angle, state.coupler_angle, state.rocker_angle, chain.linkage.rocker)

    @cached_property
    def cam_slope(self) -> Reals:
        """s' = (p' - q')/cam' [mm/rad]: what the cam takes back per turn of CD."""
        gap, cam = (
            difference(self.motion.bed, self.motion.cylinder, self.phi, 1),
            self.motion.bed.cam_angle(self.phi, 1),
        )
        slope: Reals = gap.first / cam.first
        return slope

    @cached_property
    def cylinder_rate(self) -> Reals:
        """q' [mm/rad]."""
        rate: Reals = self.motion.cylinder.travel(self.phi, 1).first
        return rate

    @cached_property
    def _slider(self) -> tuple[Reals, Reals]:
        """Directions of DE and of EF [rad]."""
        chain = self.motion.bed
        state = fourbar_sweep.solve(chain.linkage, chain.initial_crank_angle + self.phi)
        psi = state.rocker_angle - chain.crank_offset_angle
        across = -(chain.offset + chain.slider_crank_length * np.cos(psi)) / chain.rod
        return psi, -np.arccos(across)

    @cached_property
    def bed_per_turn(self) -> Reals:
        """dp/dpsi [mm/rad]: travel of the bed per turn of the slider's crank."""
        psi, eta = self._slider
        rate: Reals = -2.0 * self.motion.bed.slider_crank_length * np.sin(psi - eta) / np.sin(eta)
        return rate

    @cached_property
    def slider_crank(self) -> dict[str, Any]:
        """Gains of crank DE, rod, offset, of the angle CDE and of pins at E and F."""
        psi, eta = self._slider
        return {
            "crank": 2.0 * np.cos(psi - eta) / np.sin(eta),
            "rod": 2.0 / np.sin(eta),
            "offset": 2.0 * np.cos(eta) / np.sin(eta),
            "angle": -self.bed_per_turn,
            "pin": 2.0 * np.exp(-1j * eta) / np.sin(eta),
        }

    def bed(self, turn: Any) -> Any:
        """Gain of what turns CD: the bed moves, and the cam on D takes back."""
        return (self.bed_per_turn - self.cam_slope) * turn

    def cylinder(self, turn: Any) -> Any:
        """Gain of what turns MN."""
        chain = self.motion.cylinder
        return chain.radius * chain.gear_ratio * turn

    def pin(self, name: str) -> Any:
        """Gain of the play vector of a pin."""
        if name in "ABC":
            return self.bed(self.bed_links.pin)
        if name == "D":  # the loop sees it from the other side, and E stands on the same shaft
            return self.slider_crank["pin"] - self.bed(self.bed_links.pin)
        if name in "EF":
            return self.slider_crank["pin"]
        return self.cylinder(self.cylinder_links.pin if name in "GHM" else -self.cylinder_links.pin)


class PressRegister(RegisterDesign):
    """Bed against cylinder over the synchronous zone."""

    kind = "flatbed-press"
    spec: FlatbedPressSpec
    default_at = "zone"

    @cached_property
    def design(self) -> FlatbedPress:
        """The press."""
        return FlatbedPress(self.spec)

    @property
    def parts(self) -> Parts:
        """Pins of both chains."""
        return Parts({}, _PINS)

    def stretch(self, at: str) -> tuple[float, float]:
        """The synchronous zone."""
        if at != "zone":
            raise no_such_place(at, ("zone",))
        return self.design.motion.sync_start, self.design.motion.sync_end

    def contributions(self, input_angle: Reals, _torque_sign: int) -> list[Contribution]:
        """Every source of the file, and the cam's own error."""
        gains = PressGains(self.design, input_angle)
        found = [contribution(source, self._gain(source, gains)) for source in self.sources]
        if self.section.cam_error is not None:
            lean = self._cam_lean(gains)
            error = self.section.cam_error
            found.append(Contribution("cam profile", 1.0 / np.cos(lean), error, error / 3.0, relative=False))
        return found

    def _gain(self, source: Scatter, gains: PressGains) -> Any:
        section, _, rest = source.key.partition(".")
        if source.kind == "pin":
            return gains.pin(rest)
        chain, _, link = rest.partition(".")
        if chain == "double_crank" and link in _LINKS:
            links, moved = (gains.bed_links, gains.bed) if section == "bed" else (gains.cylinder_links, gains.cylinder)
            return moved(getattr(links, link))
        found = self._other(source.key, gains)
        if found is None:
            message = f"{source.key} does not move bed against cylinder: leave it out of a register"
            raise NoSolution(message, key="tolerance.sources")
        return found

    def _other(self, key: str, gains: PressGains) -> Any:
        """Gains of the keys beside the drag links; angles per degree."""
        degree, slider, cylinder = math.radians(1.0), gains.slider_crank, gains.motion.cylinder
        match key:
            case "bed.stroke":
                return slider["crank"] * self._crank_per_stroke
            case "bed.rod" | "bed.offset":
                return slider[key.removeprefix("bed.")]
            case "bed.crank_offset_angle":
                return slider["angle"] * degree
            case "cylinder.initial_crank_angle":
                return -gains.cylinder_rate * degree
            case "cylinder.radius":
                return -cylinder.travel(gains.phi).value / cylinder.radius
        return None

    @property
    def _crank_per_stroke(self) -> float:
        """Error of the crank DE per mm of the bed's stroke, which is how the file gives it: dr/dS, in closed form.

        r = (s/2) sqrt((4 L^2 - 4 e^2 - s^2)/(4 L^2 - s^2)),   s = S/2
        """
        bed = self.spec.bed
        s, crank = 0.5 * bed.stroke, self.design.motion.slider_crank.crank_length
        inner, outer = 4.0 * (bed.rod**2 - bed.offset**2) - s * s, 4.0 * bed.rod**2 - s * s
        return 0.5 * crank * (1.0 / s - s / inner + s / outer)

    def _cam_lean(self, gains: PressGains) -> Reals:
        """Pressure angle of the main cam along the zone [rad]."""
        radius = self.design.cams.base_radius
        cam = self.design.motion.bed.cam_angle(gains.phi).value
        lift = self.design.cams.follower.lift(cam, 1)
        lean: Reals = np.arctan2(lift.first, radius + lift.value)
        return lean
