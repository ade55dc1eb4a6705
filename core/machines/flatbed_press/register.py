"""The register of a flatbed press: bed against cylinder in the synchronous zone, mm at the print.

Delta = dp - dq - ds: the bed's travel less the cylinder's less what the cam takes back. What is the same over the whole
zone shifts the print and costs no register, so every error counts relative to the start of the zone.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import MissingSection
from gearlink.core.base.results import cached_property
from gearlink.core.machines.flatbed_press.design import FlatbedPress
from gearlink.core.machines.flatbed_press.mechanism import bed_rods
from gearlink.core.machines.flatbed_press.register_lift import RackLift
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import Coupling, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import fixed, from_start, mixed, steady
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar import position
from gearlink.core.parts.linkages.fourbar.mechanism import turns
from gearlink.core.parts.linkages.standstills import zeros_over_turn
from gearlink.core.studies.register.design import RegisterDesign, no_such_place
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sources import Parts

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.spec import FlatbedPressSpec
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.studies.register.gains import Off, Output
    from gearlink.core.studies.register.movable import Errors

_CHAINS = {"bed": ("gear2", "BC", "CDE"), "cylinder": ("gear1", "HM", "MN")}
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

    # What the sources move

    @property
    def errors(self) -> Errors:
        """By size; the bed's slide line keeps its place, so a longer frame puts A back."""
        bed, degree = self.design.bed, math.radians(1.0)
        per_stroke = 0.5 * self.design.motion.slider_crank.crank_per_stroke  # the bed goes twice as far
        crank = per_stroke * cmath.exp(-1j * bed.crank_offset_angle)
        found = {
            "bed.stroke": (Shift("CDE", ("E",), crank),),
            "bed.rod": (Shift("EF", ("F",)),),
            "bed.offset": (Shift("frame", ("guide",), -1.0),),
            "bed.crank_offset_angle": (Shift("CDE", ("E",), -degree, turned=True),),
            "cylinder.initial_crank_angle": (Shift("gear1", ("H",), degree, turned=True),),
        }
        for chain, (crank_pin, coupler_pin) in (("bed", "BC"), ("cylinder", "HM")):
            crank_link, coupler, rocker = _CHAINS[chain]
            found |= {
                f"{chain}.double_crank.crank": (Shift(crank_link, (crank_pin,)),),
                f"{chain}.double_crank.coupler": (Shift(coupler, (coupler_pin,)),),
                f"{chain}.double_crank.rocker": (Shift(rocker, (coupler_pin,)),),
                f"{chain}.double_crank.frame": (Shift(crank_link, (crank_pin,), -1.0, "frame"),),
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
        """Both chains, from the input gears to the carriage of the pinion and to the cylinder."""
        links, connections = self._bed_chain(input_angle)
        driven, joints = self._cylinder_chain(input_angle)
        gears = Coupling("mesh_12", "gear2", "gear1", links["gear2"].origin.value, -1.0)
        return Mechanism(links | driven, [*connections, *joints, gears], "gear2")

    def output(self, input_angle: Reals) -> Output:
        """Delta of the bed as it rolls on the carriage, the cylinder's surface and the rack, which CDE lifts."""
        lift, radius = self._lift, self.design.motion.cylinder.radius
        start, slope = self._rods(input_angle.ravel(), 0)["CDE"].turn.value.reshape(input_angle.shape), lift.slope

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

    def _rods(self, phi: Reals, order: int) -> dict[str, Link]:
        return bed_rods(self.design, phi, order)

    def _bed_chain(self, phi: Reals) -> tuple[dict[str, Link], list[Connection]]:
        """Gear 2 to the carriage."""
        links = self._rods(phi, 1)
        f = links["carriage"].origin.value
        return links, [
            Pin("A", FRAME, "gear2", links["gear2"].origin.value),
            Pin("B", "gear2", "BC", links["BC"].origin.value),
            Pin("C", "BC", "CDE", links["CDE"].at(self.design.bed.linkage.rocker).value),
            Pin("D", FRAME, "CDE", links["CDE"].origin.value),
            Pin("E", "CDE", "EF", links["EF"].origin.value),
            Pin("F", "EF", "carriage", f),
            Guide("guide", FRAME, "carriage", f, -1j),
        ]

    def _cylinder_chain(self, phi: Reals) -> tuple[dict[str, Link], list[Connection]]:
        """Gear 1 to the cylinder, in the frame of its own: G at 0, N on +x."""
        chain = self.design.cylinder
        four = chain.linkage
        coupler, rocker = turns(four, chain.initial_angle - phi, 1, velocity=-1.0)
        gear1 = Link(fixed(0j, phi, order=1), steady(phi, -1.0, chain.initial_angle, order=1))
        n = fixed(four.frame, phi, order=1)
        start = position.solve(four, chain.initial_angle).rocker_angle
        links = {
            "gear1": gear1,
            "HM": Link(gear1.at(four.crank), coupler),
            "MN": Link(n, rocker),
            "cylinder": Link(n, mixed((-chain.gear_ratio, from_start(rocker, start)))),
        }
        return links, [
            Pin("G", FRAME, "gear1", gear1.origin.value),
            Pin("H", "gear1", "HM", links["HM"].origin.value),
            Pin("M", "HM", "MN", links["MN"].at(four.rocker).value),
            Pin("N", FRAME, "MN", n.value),
            Pin("cylinder", FRAME, "cylinder", n.value),
            Coupling("mesh_34", "MN", "cylinder", n.value, -chain.gear_ratio),
        ]

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

    against_flips = "take the backlash out there, or preload it"

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
