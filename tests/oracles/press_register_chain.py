"""A press whose parts have errors, solved exactly: both loops, the slider and the cam, at input angles.

Bed chain in the frame of A-D (A at 0, D on +x), cylinder chain in that of G-N. The slide line of F keeps its place in
the machine; the lift of the cam belongs to the angle that its shaft has really turned.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from oracles.loop_gains import closed_pin

from gearlink.core.machines.flatbed_press.chains import BedChain
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.register import RackLift


@dataclass(frozen=True, slots=True)
class PressErrors:
    """Errors of the parts, floats or arrays that broadcast with the input angles; what is not named has none.

    Lengths [mm] bed.crank, bed.coupler, bed.rocker, bed.frame, the same of cylinder; crank, rod, offset (of the
    slider-crank), radius; angles [rad] bed.angle, cylinder.angle (of the driving cranks), angle (CDE); vectors [mm] by
    the names of the pins, in the frame of their chain
    """

    values: Mapping[str, Any] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        return self.values.get(name, 0.0)


def register_error(lift: RackLift, input_angle: Reals, errors: PressErrors) -> Reals:
    """Error of bed against cylinder at the print, exactly.

    Delta = dp - dq - ds,   s(c) the lift that the cam has at the angle c

    Parameters
        lift : RackLift - of the press without errors, with its chains
        input_angle : array [rad]
        errors : PressErrors - of shapes that broadcast with `input_angle`
    Returns
        error : array [mm] - NaN where a loop does not close
    Notes
        Angles are deviations from the chains without errors, so no branch is lost.
    Source
        own derivation; agrees with `press_gains` to first order
    """
    bed, cylinder = lift.motion.bed, lift.motion.cylinder
    turned = _turn(bed.linkage, bed.initial_crank_angle + input_angle, "bed", "ABC", "D", errors)
    lifted = lift.gained(input_angle, turned)
    moved = _bed_travel(bed, input_angle, turned, errors)
    driven = _turn(cylinder.linkage, cylinder.initial_angle - input_angle, "cylinder", "GHM", "N", errors)
    travel = cylinder.travel(input_angle).value
    rolled = errors["radius"] / cylinder.radius * travel
    error: Reals = moved - lifted - rolled + (cylinder.radius + errors["radius"]) * cylinder.gear_ratio * driven
    return error


def _turn(linkage: FourBar, crank_angle: Reals, chain: str, near: str, far: str, errors: PressErrors) -> Any:
    """By how much the driven crank has turned too far [rad]; pins before the coupler shift it on, the last one back."""
    state = fourbar_sweep.solve(linkage, crank_angle)
    play = sum(errors[pin] for pin in near)
    crank = np.exp(1j * (crank_angle + errors[f"{chain}.angle"]))
    start = (linkage.crank + errors[f"{chain}.crank"]) * crank + play - errors[f"{chain}.frame"]
    end = linkage.frame + errors[far]
    coupler, rocker = linkage.coupler + errors[f"{chain}.coupler"], linkage.rocker + errors[f"{chain}.rocker"]
    knee: Points = closed_pin(start, end, coupler, rocker, linkage.assembly)
    return np.angle((knee - end) * np.exp(-1j * state.rocker_angle))


def _bed_travel(bed: BedChain, input_angle: Reals, turned: Any, errors: PressErrors) -> Any:
    """By how much the bed has gone too far, the lower rack at rest."""
    psi = bed.cam_angle_start + bed.cam_angle(input_angle).value - bed.crank_offset_angle
    plain = _height(psi, bed.slider_crank_length, bed.rod, bed.offset, 0.0)
    play = errors["D"] + errors["E"] + errors["F"]
    lengths = bed.slider_crank_length + errors["crank"], bed.rod + errors["rod"], bed.offset + errors["offset"]
    return 2.0 * (_height(psi + turned - errors["angle"], *lengths, play) - plain)


def _height(psi: Any, crank: Any, rod: Any, offset: Any, play: Any) -> Any:
    """Height of F above D, on its line."""
    pin = crank * np.exp(1j * psi) + play
    across = -offset - pin.real
    with np.errstate(invalid="ignore"):
        return pin.imag - np.sqrt((rod - across) * (rod + across))
