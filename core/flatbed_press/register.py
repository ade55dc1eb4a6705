"""The register of a flatbed press: bed against cylinder in the synchronous zone, mm at the print.

Delta = dp - dq - ds: the bed's travel less the cylinder's less what the cam takes back. What is the same over the whole
zone shifts the print and costs no register, so every error counts relative to the start of the zone.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.flatbed_press.design import FlatbedPress
from gearlink.core.flatbed_press.register_chain import PressErrors, register_error
from gearlink.core.flatbed_press.register_lift import RackLift
from gearlink.core.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.linkages.fourbar.loop_gains import LoopGains, loop_gains
from gearlink.core.linkages.standstills import zeros_over_turn
from gearlink.core.numerics.arrays import Reals
from gearlink.core.results import cached_property
from gearlink.core.tolerance.budget import Contribution
from gearlink.core.tolerance.register_design import RegisterDesign, contribution, no_such_place
from gearlink.core.tolerance.sources import Parts, Scatter

if TYPE_CHECKING:
    from gearlink.core.flatbed_press.spec import FlatbedPressSpec

_LINKS = ("crank", "coupler", "rocker", "frame")
MESHES = ("mesh_12", "mesh_34", "rack_lower", "rack_upper")
_PINS = ("A", "B", "C", "D", "E", "F", "G", "H", "M", "N")


class PressGains:
    """Gains of every part of a press over input angles [mm per mm, of angles mm/rad].

    Parameters
        design : FlatbedPress
        input_angle : (N,) array [rad]
    """

    def __init__(self, design: FlatbedPress, input_angle: Reals) -> None:
        self.motion, self.phi, self.lift = design.motion, input_angle, RackLift(design)

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
        """s' [mm/rad]: what the cam takes back per turn of CD."""
        return self.lift.slope(self.phi)

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
    turning = "force on the racks and on the cylinder's gears"

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

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, the cam's own error, and the meshes whose backlash is given."""
        gains = PressGains(self.design, input_angle)
        known = gains.lift.known(input_angle)
        found = [contribution(source, self._gain(source, gains)) for source in self.sources]
        if self.section.cam_error is not None:
            lean = self._cam_lean(gains)
            error = self.section.cam_error
            found.append(Contribution("cam profile", 1.0 / np.cos(lean), error, error / 3.0, relative=False))
        for mesh, play in self.backlash.items():
            half = 0.5 * play
            gain = self._mesh_gain(mesh, gains, torque_sign)
            found.append(Contribution(f"backlash of {mesh}", gain, half, 0.0, mean=half))
        return found if known.all() else [replace(one, gain=np.where(known, one.gain, math.nan)) for one in found]

    @cached_property
    def input_angles(self) -> Reals:
        """As of any machine; an input angle at which nothing says where the lower rack stands is refused."""
        angles = super().input_angles
        if not RackLift(self.design).known(angles).all():
            start, end = (math.degrees(angle) for angle in self.stretch("zone"))
            raise MissingSection(
                f"{self._where} nothing says where the lower rack stands: outside the synchronous "
                f"zone, {start:.6g} to {end:.6g} deg, a register needs the section cam",
                key="cam",
            )
        return angles

    # Backlash

    @cached_property
    def backlash(self) -> dict[str, float]:
        """Circumferential backlash of each mesh [mm]; that of the cylinder's gears at its surface."""
        return {name: play for name, play in self.section.backlash_of(MESHES).items() if play > 0.0}

    @cached_property
    def _input_radius(self) -> float:
        """Working radius of the input gears [mm]."""
        if self.spec.input_gears is None:
            raise MissingSection("the backlash of mesh_12 needs the section input_gears", key="input_gears")
        return float(self.design.gear_pair.working_radius[0])

    def _mesh_gain(self, mesh: str, gains: PressGains, torque_sign: int) -> Reals:
        """Gain of half the backlash of a mesh: the driven member lags behind.

        Notes
            The torque's sign is that in the input mesh, +1 where the gear of the bed drives that of the cylinder. Bed
            and cylinder are pushed by their inertia: by the sign of q'', outside the zone the bed by that of its own.
        """
        if mesh == "mesh_12":
            rate: Reals = torque_sign * gains.cylinder_rate / self._input_radius
            return rate
        if mesh == "mesh_34":
            return np.where(gains.motion.cylinder.travel(gains.phi, 2).second >= 0.0, 1.0, -1.0)
        return np.where(gains.lift.bed_acceleration(gains.phi) >= 0.0, -1.0, 1.0)

    @cached_property
    def _jumps(self) -> dict[str, float]:
        """How far bed and cylinder jump against each other where the force turns in a mesh, at most [mm]."""
        gains = PressGains(self.design, self.input_angles)
        return {
            mesh: play * float(np.abs(self._mesh_gain(mesh, gains, 1)).max()) for mesh, play in self.backlash.items()
        }

    @cached_property
    def dead_band(self) -> float | None:
        """The jumps of all meshes together [mm]."""
        return sum(self._jumps.values()) if self.backlash else None

    @property
    def jump(self) -> float:
        """What inertia makes jump: all but the input mesh [mm]."""
        return sum(jump for mesh, jump in self._jumps.items() if mesh != "mesh_12")

    against_flips = "take the backlash out there, or preload it"

    @cached_property
    def flips(self) -> list[float] | None:
        """Input angles at which the inertia of bed and cylinder turns round [rad]; None without backlash.

        q'' = 0: in the zone the bed goes as the cylinder does
        """
        if not self.backlash:
            return None
        return zeros_over_turn(lambda phi: float(self.design.motion.cylinder.travel(phi, 2).second))

    # Samples of the exact chain

    def sampled_errors(self, input_angle: Reals, _torque_sign: int, parts: Mapping[str, Any]) -> Reals:
        """Errors of the print by the exact chain."""
        values: dict[str, Any] = {}
        for source in self.sources:
            name, scale = self._chain_name(source)
            values[name] = values.get(name, 0.0) + scale * parts[source.key]
        return register_error(RackLift(self.design), input_angle[:, None], PressErrors(values))

    def _chain_name(self, source: Scatter) -> tuple[str, float]:
        """What a source is called in the chain, and the chain's error per one of the source."""
        if source.kind == "pin":
            return source.key.partition(".")[2], 1.0
        name, degree = source.key.replace(".double_crank", ""), math.radians(1.0)
        scales = {
            "bed.stroke": ("crank", self._crank_per_stroke),
            "bed.rod": ("rod", 1.0),
            "bed.offset": ("offset", 1.0),
            "bed.crank_offset_angle": ("angle", degree),
            "cylinder.initial_crank_angle": ("cylinder.angle", degree),
            "cylinder.radius": ("radius", 1.0),
        }
        return scales.get(name, (name, 1.0))

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
                return gains.cylinder_rate * degree
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
