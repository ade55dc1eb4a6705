"""Gains of every part of a flatbed press by hand: both drag links, the slider-crank, what the cam takes back."""

from __future__ import annotations

import math
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from oracles.loop_gains import LoopGains, loop_gains

from gearlink.core.machines.flatbed_press.register import RackLift
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress


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
        """s' [mm/rad]: what the cam takes back per revolution of CD."""
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
        """dp/dpsi [mm/rad]: travel of the bed per revolution of the slider's crank."""
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

    def of(self, key: str, crank_per_stroke: float) -> Any:
        """Gain of a source of the file; angles per degree."""
        group, _, name = key.partition(".")
        if group in ("pins", "bearings"):
            return self.pin(name)
        if ".double_crank." in key:
            links, moved = (self.bed_links, self.bed) if group == "bed" else (self.cylinder_links, self.cylinder)
            return moved(getattr(links, key.rpartition(".")[2]))
        degree, cylinder = math.radians(1.0), self.motion.cylinder
        return {
            "bed.stroke": self.slider_crank["crank"] * crank_per_stroke,
            "bed.rod": self.slider_crank["rod"],
            "bed.offset": self.slider_crank["offset"],
            "bed.crank_offset_angle": self.slider_crank["angle"] * degree,
            "cylinder.initial_crank_angle": self.cylinder_rate * degree,
            "cylinder.radius": -cylinder.travel(self.phi).value / cylinder.radius,
        }[key]
