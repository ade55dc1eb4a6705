"""The mechanism of a swing gripper: cam rocker with linkage and arm, return rocker, and the cams that drive both."""

from __future__ import annotations

import cmath
import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.swing_gripper.law import PHASES
from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.joints import Connection, Contact, Pin
from gearlink.core.mechanism.links import FRAME, Later, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import fixed, steady
from gearlink.core.mechanism.vectors import least_transmission
from gearlink.core.studies.loads.contact import roller_on

if TYPE_CHECKING:
    from collections.abc import Mapping

    from gearlink.core.machines.swing_gripper.design import SwingGripper
    from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.cams.disc_cam import DiscCam


def motion(design: SwingGripper) -> Motion:
    """Links and joints over the angle of the cylinder shaft, in the machine's frame; the cams turn as far.

    Without the section `cam` there is the linkage with its arm alone.

    Raises
        NoSolution - where the cams that the file asks for cannot be
    """
    return _motion(design, _cams(design) if design.spec.cam is not None else {})


def without_cams(design: SwingGripper) -> Motion:
    """The motion of linkage and arm alone, which there is whatever the cams are."""
    return _motion(design, {})


def rocker_too(design: SwingGripper) -> Motion:
    """Motion of the linkage alone with both outputs: the arm, and the cam rocker from the pick-up position."""
    found = without_cams(design)
    start = float(design.linkage.motion(np.zeros(1), 0).input.value[0])
    rocker = found.outputs[0]._replace(name="Cam rocker AC", course=turned("input").less(start))
    return replace(found, outputs=(*found.outputs, rocker))


def _motion(design: SwingGripper, cams: dict[str, DiscCam]) -> Motion:
    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        arm = design.spec.arm
        links = links_of(design.linkage, phi, order, cmath.rect(arm.length, math.radians(arm.direction)))
        if not cams:
            return Mechanism(links, Later(lambda: _pins(links)), "input")
        sense = float(cams["main"].sense)
        axis = fixed(design.cam_center, phi, order=order)
        links["cam"] = Link(axis, steady(phi, sense, order=order))
        if "return" in cams:
            links["return_rocker"] = Link(links["input"].origin, links["input"].turn)

        def joints() -> list[Connection]:
            found = [*_pins(links), Pin("O", FRAME, "cam", axis.value)]
            if "return" in cams:
                found.append(Pin("A_return", FRAME, "return_rocker", links["input"].origin.value))
            for name, cam in cams.items():
                roller = made.once(f"roller {name}", lambda cam=cam: roller_on(cam, phi))  # type: ignore[misc]
                arm = "input" if name == "main" else "return_rocker"
                found.append(Contact(name, "cam", arm, axis.value + roller.position, roller.normal))
            return found

        made = Mechanism(links, Later(joints), "cam", sense, pivot=design.cam_center)
        return made

    starts = np.radians(design.law.starts)
    stretches = zip(PHASES, starts, starts[1:], strict=False)
    phases = tuple((name, float(a), float(b)) for name, a, b in stretches if a < b)
    outputs = (Output("Gripper arm", swing(design), phases),)
    return Motion(make, Input("theta", joints=_joints(design)), outputs, transmission=least_transmission("D", "C"))


def swing(design: SwingGripper) -> Course:
    """What the arm has swung since the bite."""
    linkage = design.linkage
    start = linkage.output_direction + linkage.output_shift
    return turned("output", sense=linkage.swing_sense).less(linkage.swing_sense * start)


def _cams(design: SwingGripper) -> dict[str, DiscCam]:
    """Main, and return where the file has one."""
    back = design.return_cam
    return {"main": design.main_cam} if back is None else {"main": design.main_cam, "return": back}


def links_of(linkage: GripperLinkage, phi: Reals, order: int, arm: complex = 0j) -> dict[str, Link]:
    """Cam rocker, coupler and gripper rocker with the arm's tip F.

    C = A + AC e^(i th1),  D = E + ED e^(i th4),  F = E + EF e^(i (gamma_0 + s beta))

    Parameters
        phi : (N,) array [rad] - of the cylinder
        arm : complex [mm] - EF at the pick-up position
    Source
        swing-gripper paper (4), (5)
    """
    found = linkage.motion(np.degrees(phi), order)
    a, e = (fixed(pivot, phi, order=order) for pivot in (linkage.input_pivot, linkage.output_pivot))
    rocker = Link(a, found.input, {"A": 0.0, "C": linkage.input})
    tip = arm * cmath.exp(-1j * linkage.output_direction)
    return {
        "input": rocker,
        "coupler": Link(rocker.at("C"), found.coupler, {"C": 0.0, "D": linkage.coupler}),
        "output": Link(e, found.output, {"E": 0.0, "D": linkage.output, "F": tip}),
    }


def _pins(links: Mapping[str, Link]) -> list[Connection]:
    return [
        Pin("A", FRAME, "input", links["input"].origin.value),
        Pin("C", "input", "coupler", links["coupler"].origin.value),
        Pin("D", "coupler", "output", links["output"].at("D").value),
        Pin("E", FRAME, "output", links["output"].origin.value),
    ]


def _joints(design: SwingGripper) -> tuple[float, ...]:
    """Cylinder angles at which the law of the swing changes, its pieces among them [rad]."""
    law, lengths = design.law, design.motion.phases
    starts = law.starts
    found = list(starts[1:])
    for k, joints in ((0, law.accelerate.joints), (2, law.decelerate.joints), (4, law.return_.joints)):
        # The law of the second runs backwards.
        found += [starts[k] + lengths[k] * (1.0 - x if k == 2 else x) for x in joints]
    return tuple(sorted(math.radians(degrees) for degrees in found))
