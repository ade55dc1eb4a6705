"""Links beside rocker and cam: the rod and slider that the rocker drives, and the crank-rocker that carries the cam.

The film draws them where the file does not say which way they stand: the slider below D, the crank's pivot 60 deg
below the line of centres.
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.closures import dyad, slider
from gearlink.core.mechanism.dynamics import Force
from gearlink.core.mechanism.joints import Connection, Coupling, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Link
from gearlink.core.mechanism.rates import Point, carried, fixed, standing, steady

if TYPE_CHECKING:
    from collections.abc import Sequence

    from gearlink.core.mechanism.dynamics import Torque
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.wide_swing.crank_rocker import CrankRockerDrive
    from gearlink.core.wide_swing.loads.design import WideSwingLoads
    from gearlink.core.wide_swing.slider import SliderDrive

SLIDER_DIRECTION, DRIVE_DIRECTION = -90.0, -60.0


def with_slider(rocker: Link, drive: SliderDrive, direction: float) -> tuple[dict[str, Link], list[Connection]]:
    """Rod and slider, their pins E and F, and the guide.

    Parameters
        rocker : Link - its angle counted from mid-swing
        drive : SliderDrive [mm]
        direction : float [rad] - from D, in which the slider is farthest
    """
    away = cmath.rect(1.0, direction)
    pin = rocker.at(drive.crank * cmath.rect(1.0, drive.middle_angle) * away)
    line = complex(rocker.origin.value[0]) - 1j * away * drive.offset
    turn, block = slider(pin, drive.rod, line, away)
    links = {"rod": Link(pin, turn), "slider": Link(block, standing(direction, turn.value, order=turn.order))}
    joints: list[Connection] = [
        Pin("E", "rocker", "rod", pin.value),
        Pin("F", "rod", "slider", block.value),
        Guide("guide", FRAME, "slider", block.value, away),
    ]
    return links, joints


def with_shafts(
    phi: Reals, axis: Point, sense: float, middles: Sequence[float]
) -> tuple[dict[str, Link], list[Connection]]:
    """The cam that turns evenly, and a second one that a train turns the other way, each in the frame of its table.

    Parameters
        phi : (N,) array [rad] - input angle
        axis : Point [mm] - of both cams
        sense : float - in which the first one turns
        middles : by cam - input angle at which its roller stands on the line of centres [rad]
    """
    links = {"cam": Link(axis, steady(phi, sense, -sense * middles[0], order=axis.order))}
    joints: list[Connection] = [Pin("O", FRAME, "cam", axis.value)]
    if len(middles) > 1:
        links["return_cam"] = Link(axis, steady(phi, -sense, sense * middles[1], order=axis.order))
        joints += [
            Pin("O_return", FRAME, "return_cam", axis.value),
            Coupling("train", "cam", "return_cam", axis.value, -1.0),
        ]
    return links, joints


def with_drive(
    phi: Reals, axis: Point, drive: CrankRockerDrive, direction: float
) -> tuple[dict[str, Link], list[Connection], float, complex]:
    """Crank, coupler and cam, the pins A, B, C and O, the sense in which the crank turns, and the place of its pivot.

    Parameters
        phi : (N,) array [rad] - input angle from the start of the stroke
        axis : Point [mm] - of the cam, on which the rocker of the crank-rocker turns
        drive : CrankRockerDrive [mm]
        direction : float [rad] - from the cam's axis to the crank's pivot
    Notes
        The cam turns clockwise in the stroke; a crank-rocker whose rocker turns the other way is mirrored.
    """
    bar, sense = drive.linkage, -drive.rising
    place = complex(axis.value[0]) + bar.frame * cmath.rect(1.0, direction)
    turn = steady(phi, sense, direction + math.pi + sense * drive.crank_angles[0], order=axis.order)
    pivot = fixed(place, phi, order=axis.order)
    pin = carried(pivot, turn, bar.crank)
    along, cam = dyad(pin, axis, bar.coupler, bar.rocker, round(sense) * bar.assembly)
    links = {"crank": Link(pivot, turn), "coupler": Link(pin, along), "cam": Link(axis, cam)}
    end = axis.value + bar.rocker * np.exp(1j * cam.value)
    joints: list[Connection] = [
        Pin("A", FRAME, "crank", pivot.value),
        Pin("B", "crank", "coupler", pin.value),
        Pin("C", "coupler", "cam", end),
        Pin("O", FRAME, "cam", axis.value),
    ]
    return links, joints, sense, place


def pull_of_device(loads: WideSwingLoads, mechanism: Mechanism, _phi: Reals) -> list[Force | Torque]:
    """The pull of the device on its pin of the rocker, towards its base pin."""
    unloader, unloading = loads.spec.unloader, loads.design.unloading
    way = cmath.rect(1.0, math.radians(loads.section.device_direction or 0.0))
    rocker = mechanism.links["rocker"]
    arm = unloader.arm
    pin = rocker.at(arm * way)
    along = way * (
        unloader.pivot_ratio - rocker.unit
    )  # in arms from the pivot: of any size, and a short one is not lost
    length = np.abs(along)
    if unloader.type == "pneumatic":
        pull = np.full(length.shape, unloading.force or 0.0)
    else:
        geometry = loads.design.motion.law.geometry
        mounted = geometry.shortest - unloader.stretch_ratio * geometry.stroke
        pull = (unloading.spring_rate or 0.0) * arm * (length - mounted)
    return [Force("rocker", pull * along / length, pin)]
