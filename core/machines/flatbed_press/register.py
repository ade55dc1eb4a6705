"""The register of a flatbed press: bed against cylinder in the synchronous zone, mm at the print.

Delta = dp - dq - ds: the bed's travel less the cylinder's less what the cam takes back. What is the same over the whole
zone shifts the print and costs no register, so every error counts relative to the start of the zone.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import geometry
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press.chains import difference
from gearlink.core.machines.flatbed_press.design import FlatbedPress
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import Connection, Coupling, Mesh, Rack
from gearlink.core.mechanism.links import Mechanism
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.standstills import zeros_over_turn
from gearlink.core.studies.register import Off, Output, RegisterDesign, no_such_place
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sources import Parts

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from gearlink.core.machines.flatbed_press.spec import FlatbedPressSpec
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.studies.movable import Errors


_CHAINS = {"bed": ("gear2", "BC", "CDE"), "cylinder": ("gear1", "HM", "MN")}
_LINKS = ("gear2", "BC", "CDE", "EF", "carriage", "gear1", "HM", "MN", "cylinder")
_RADIUS = "cylinder.radius"
MESHES = ("mesh_12", "mesh_34", "rack_lower", "rack_upper")
_PINS = ("A", "B", "C", "D", "E", "F", "G", "H", "M", "N")


class PressRegister(RegisterDesign):
    """Bed against cylinder over the synchronous zone."""

    kind = "flatbed-press"
    spec: FlatbedPressSpec
    default_at = "zone"
    turning = "force on the racks and on the cylinder's gears"
    words = "bed against cylinder"
    design = geometry(FlatbedPress)

    @property
    def parts(self) -> Parts:
        """Pins of both chains."""
        return Parts({}, _PINS)

    def stretch(self, at: str) -> tuple[float, float]:
        """The synchronous zone."""
        if at != "zone":
            raise no_such_place(at, ("zone",))
        return self.design.motion.sync_start, self.design.motion.sync_end

    # What the sources move

    @property
    def errors(self) -> Errors:
        """By size; the bed's slide line keeps its place, so a longer frame puts A back."""
        bed, degree = self.design.bed, math.radians(1.0)
        key, crank = "bed.crank", cmath.exp(-1j * bed.crank_offset_angle)
        if self.design.spec.bed.crank is None:
            key, crank = "bed.stroke", 0.5 * self.design.motion.slider_crank.crank_per_stroke * crank
        found = {
            key: (Shift("CDE", ("E",), crank),),
            "bed.rod": (Shift("EF", ("F",)),),
            "bed.offset": (Shift("frame", ("guide_carriage",), -1.0),),
            "bed.crank_offset_angle": (Shift("CDE", ("E",), -degree, turned=True),),
            "cylinder.initial_crank_angle": (Shift("gear1", ("H",), degree, turned=True),),
        }
        section = self.spec.loads
        side = 1.0 if section is None else float(section.bed_side)
        for chain, (crank_pin, coupler_pin), along in (("bed", "BC", 1.0), ("cylinder", "HM", side)):
            crank_link, coupler, rocker = _CHAINS[chain]
            found |= {
                f"{chain}.double_crank.crank": (Shift(crank_link, (crank_pin,)),),
                f"{chain}.double_crank.coupler": (Shift(coupler, (coupler_pin,)),),
                f"{chain}.double_crank.rocker": (Shift(rocker, (coupler_pin,)),),
                f"{chain}.double_crank.frame": (Shift(crank_link, (crank_pin,), -along, "frame"),),
            }
        return found

    pins = {
        "A": (Shift("gear2", ("B",), 1.0, "frame"),),
        "D": (Shift("CDE", ("C", "E"), 1.0, "frame"),),
        "G": (Shift("gear1", ("H",), 1.0, "frame"),),
        "N": (Shift("MN", ("M",), 1.0, "frame"),),
    }

    def own_gain(self, key: str, input_angle: Reals) -> Reals | None:
        """A larger cylinder rolls further."""
        cylinder = self.design.motion.cylinder
        return -cylinder.travel(input_angle).value / cylinder.radius if key == _RADIUS else None

    def mechanism(self, input_angle: Reals) -> Mechanism:
        """Both chains, from the input gears to the carriage of the pinion and to the cylinder; meshes as ratios."""
        whole = self._bare.make(input_angle, 1, 1)
        links = {name: link for name, link in whole.links.items() if name in _LINKS}
        joints: list[Connection] = [
            each for each in whole.connections if not isinstance(each, (Mesh, Rack)) and each.second in links
        ]
        gear2, rocker = links["gear2"].origin.value, links["MN"].origin.value
        joints += [
            Coupling("mesh_12", "gear2", "gear1", gear2, -1.0),
            Coupling("mesh_34", "MN", "cylinder", rocker, -self.design.cylinder.gear_ratio),
        ]
        return Mechanism(links, joints, "gear2")

    @cached_property
    def _bare(self) -> Motion:
        """The motion of the press without its cam."""
        return self.design.without_cam.moving

    def output(self, input_angle: Reals) -> Output:
        """Delta of the bed as it rolls on the carriage, the cylinder's surface and the rack, which CDE lifts."""
        lift, radius = self._lift, self.design.motion.cylinder.radius
        cde, slope = self._bare.at(input_angle.ravel(), 1).links["CDE"], lift.slope
        start = cde.turn.value.reshape(input_angle.shape)

        def output(mechanism: Mechanism, parts: Off = None) -> Sequence[Reals]:
            bed, cam, cylinder = mechanism.links["carriage"].origin, mechanism.links["CDE"], mechanism.links["cylinder"]
            lifted = [lift.gained(input_angle, cam.turn.value - start)]
            lifted += [slope(input_angle) * rate for rate in cam.turn[1:2]]
            rolls = radius + (parts or {}).get(_RADIUS, 0.0)
            return [2.0 * p.imag - rolls * q - s for p, q, s in zip(bed, cylinder.turn, lifted, strict=False)]

        return output

    @cached_property
    def _lift(self) -> RackLift:
        return RackLift(self.design)

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, the cam's own error, and the meshes whose backlash is given."""
        found = super().contributions(input_angle, torque_sign)
        if self.section.cam_error is not None:
            lean, error = self._cam_lean(input_angle), self.section.cam_error
            found.append(Contribution("cam profile", 1.0 / np.cos(lean), error, error / 3.0, relative=False))
        for mesh, play in self.backlash.items():
            half = 0.5 * play
            gain = self._mesh_gain(mesh, input_angle, torque_sign)
            found.append(Contribution(f"backlash of {mesh}", gain, half, 0.0, mean=half))
        known = self._lift.known(input_angle)
        return found if known.all() else [replace(one, gain=np.where(known, one.gain, math.nan)) for one in found]

    @cached_property
    def input_angles(self) -> Reals:
        """As of any machine; an input angle at which nothing says where the lower rack stands is refused."""
        angles = super().input_angles
        if not self._lift.known(angles).all():
            start, end = (math.degrees(angle) for angle in self.stretch("zone"))
            raise MissingSection(
                f"{self._where} the position of the lower rack is not known: outside the synchronous zone, "
                f"{short(start)} to {short(end)} deg, a register needs the section cam",
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

    def _mesh_gain(self, mesh: str, phi: Reals, torque_sign: int) -> Reals:
        """Gain of half the backlash of a mesh: the driven member lags behind.

        Notes
            The torque's sign is that in the input mesh, +1 where the gear of the bed drives that of the cylinder. Bed
            and cylinder are pushed by their inertia: by the sign of q'', outside the zone the bed by that of its own.
        """
        if mesh == "mesh_12":
            rate: Reals = torque_sign * self.design.cylinder.travel(phi, 1).first / self._input_radius
            return rate
        if mesh == "mesh_34":
            return np.where(self.design.cylinder.travel(phi, 2).second >= 0.0, 1.0, -1.0)
        return np.where(self._lift.bed_acceleration(phi) >= 0.0, -1.0, 1.0)

    @cached_property
    def _jumps(self) -> dict[str, float]:
        """How far bed and cylinder jump against each other where the force turns in a mesh, at most [mm]."""
        phi = self.input_angles
        return {mesh: play * float(np.abs(self._mesh_gain(mesh, phi, 1)).max()) for mesh, play in self.backlash.items()}

    @cached_property
    def dead_band(self) -> float | None:
        """The jumps of all meshes together [mm]."""
        return sum(self._jumps.values()) if self.backlash else None

    @property
    def jump(self) -> float:
        """What inertia makes jump: all but the input mesh [mm]."""
        return sum(jump for mesh, jump in self._jumps.items() if mesh != "mesh_12")

    against_flips = "reduce the backlash of racks and gears, or preload them"

    @cached_property
    def flips(self) -> list[float] | None:
        """Input angles at which the inertia of bed and cylinder turns round [rad]; None without backlash.

        q'' = 0: in the zone the bed goes as the cylinder does
        """
        if not self.backlash:
            return None
        return zeros_over_turn(lambda phi: float(self.design.motion.cylinder.travel(phi, 2).second))

    def _cam_lean(self, phi: Reals) -> Reals:
        """Pressure angle of the main cam along the zone [rad]."""
        cam = self.design.bed.cam_angle(phi).value
        lift = self.design.cams.follower.lift(cam, 1)
        lean: Reals = np.arctan2(lift.first, self.design.cams.base_radius + lift.value)
        return lean


_TURN = 2.0 * math.pi


class RackLift:
    """Lift of the rack along input angles, by the cams as designed.

    Parameters
        design : FlatbedPress - without the section `cam` nothing is known outside the zone
    """

    def __init__(self, design: FlatbedPress) -> None:
        self.design, self.motion = design, design.motion

    def in_zone(self, input_angle: Any) -> NDArray[np.bool_]:
        """Whether input angles [rad] lie in the synchronous zone of a sheet."""
        start, end = self.motion.sync_start, self.motion.sync_end
        inside: NDArray[np.bool_] = np.mod(np.asarray(input_angle) - start, _TURN) <= end - start
        return inside

    def known(self, input_angle: Any) -> NDArray[np.bool_]:
        """Whether the lift at input angles [rad] is known."""
        inside = self.in_zone(input_angle)
        return inside if self.design.spec.cam is None else np.ones_like(inside)

    def _outside(self, input_angle: Any) -> NDArray[np.bool_]:
        return self.known(input_angle) & ~self.in_zone(input_angle)

    def slope(self, input_angle: Reals) -> Reals:
        """What the cam takes back per revolution of CD [mm/rad].

        s' = (p' - q')/cam' in the zone, outside it the slope of the follower's own stretch
        """
        gap = difference(self.motion.bed, self.motion.cylinder, input_angle, 1)
        cam = self.motion.bed.cam_angle(input_angle, 1)
        slope: Reals = gap.first / cam.first
        outside = self._outside(input_angle)
        if outside.any():
            slope[outside] = self.design.cams.follower.lift(cam.value[outside], 1).first
        return slope

    def bed_acceleration(self, input_angle: Reals) -> Reals:
        """Second derivative of the bed's travel by the input angle [mm/rad^2]: in the zone that of the cylinder."""
        found: Reals = self.motion.cylinder.travel(input_angle, 2).second
        outside = self._outside(input_angle)
        if outside.any():
            found[outside] = self.design.bed_motion.travel(input_angle[outside]).second
        return found

    def gained(self, input_angle: Reals, turned: Any) -> Any:
        """By how much the rack is too far on [mm] where CD has turned too far by `turned` [rad].

        Notes
            An angle of the zone keeps to the zone's own law, of which an error makes it see a little more.
        """
        bed, cylinder = self.motion.bed, self.motion.cylinder
        cam = bed.cam_angle(input_angle).value
        found = _of_finite(self._gap, cam + turned) - difference(bed, cylinder, input_angle).value
        outside = self._outside(input_angle)
        if outside.any():
            found = np.where(outside, _of_finite(self._lift, cam + turned) - _of_finite(self._lift, cam), found)
        return found

    def _gap(self, cam_angle: Any) -> Any:
        """By how much the bed is ahead of the cylinder [mm] where CD stands at an angle."""
        return difference(self.motion.bed, self.motion.cylinder, self.motion.bed.input_angle(cam_angle)).value

    def _lift(self, cam_angle: Any) -> Any:
        """Lift of the follower [mm]."""
        return self.design.cams.follower.lift(cam_angle, 0).value


def _of_finite(function: Callable[[Any], Any], angle: Any) -> Any:
    """A function over angles of any shape; NaN at those of machines that do not close."""
    angles = np.asarray(angle)
    finite = np.isfinite(angles)
    found = np.full(angles.shape, math.nan)
    found[finite] = function(angles[finite])
    return found
