"""What an error of each part costs at the output of a three-gear four-bar: the linear map, over crank angles.

The loop with an error vector eps closes again with other angles of coupler and rocker, and the gears add up to one
vector V: the output's reference circle moves by X = Re(V eps), with e2, e3 the unit vectors of coupler (B -> C) and
rocker (D -> C). Each mesh adds the tangent of its pressure angle for the centre distance, on the flank that carries
the torque.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar


@dataclass(frozen=True, slots=True)
class Drive:
    """A three-gear drive whose errors are asked for.

    Parameters
        linkage : FourBar [mm]
        train : GearTrain
        pressure_angle : float [rad] - of both meshes
        radius : float [mm] - at which the error of the output is measured; its reference radius r5
    """

    linkage: FourBar
    train: GearTrain
    pressure_angle: float
    radius: float


@dataclass(frozen=True, slots=True)
class RegisterGains:
    """Errors at the output's circle per unit of each cause, over crank angles; (N,) arrays.

    Real gains [1]: crank, crank_idler and idler_output (centre distances), frame, play (half of the normal play of
    either mesh, beyond that of its centre distance); input_angle [mm/rad]. Complex gains [1] of vectors v, X = Re(v
    gain): pin_a and pin_d (fixed in the frame); crank_gear, idler and output_gear (eccentricity, fixed in the gear, at
    crank angle 0).
    """

    crank: Reals
    crank_idler: Reals
    idler_output: Reals
    frame: Reals
    pin_a: Points
    pin_d: Points
    crank_gear: Points
    idler: Points
    output_gear: Points
    input_angle: Reals
    play: Reals


def register_gains(drive: Drive, crank_angle: Reals, torque_sign: int) -> RegisterGains:
    """Gains of all errors over crank angles, for one sign of the torque on the output.

    V = +-conj(s_c e2 - s_b e3)/sin(t2 - t3);  crank Re(e1 V), frame -Re V, centre distances Re(e V) - tau s tan(alpha)
    s_b = sign(z1 + z3),  s_c = sign(z3 + z5): -1 where a ring is the larger gear

    Parameters
        drive : Drive
        crank_angle : (N,) array [rad]
        torque_sign : +1 or -1 - tau, sign of the torque that the idler puts on the output
    Returns
        gains : RegisterGains - per mm, at the radius of `drive`
    Raises
        NoSolution - where the linkage does not close
    Notes
        The idler is in balance, so its two meshes touch on opposite flanks. A ring has a negative radius; its play
        closes as the centre distance grows. Without one |V| = 1/cos(gamma/2), gamma the transmission angle. Against the
        exact chain of `three_gear_chain` the error falls a hundredfold for every tenfold smaller error of the parts.
    Example
        >>> linkage = FourBar(38.94178567, 112.0, 112.0, 153.53024891)
        >>> drive = Drive(linkage, GearTrain(40, 72, 40), math.radians(20.0), 40.0)
        >>> gains = register_gains(drive, np.array([math.radians(270.0)]), 1)
        >>> round(float(abs(gains.pin_a[0])), 7), round(float(gains.frame[0]), 4)
        (1.4142136, 1.3708)

    Source
        own derivation: crossed belt over the base circles, differentiated
    """
    train, linkage = drive.train, drive.linkage
    state = fourbar_sweep.solve(linkage, crank_angle, 1)
    e1, e2, e3 = (np.exp(1j * angle) for angle in (crank_angle, state.coupler_angle, state.rocker_angle))
    scale = drive.radius / (linkage.rocker * train.output / (train.idler + train.output))
    b, c, counted = signs(train)
    v = scale * counted * np.conj(c * e2 - b * e3) / np.sin(state.coupler_angle - state.rocker_angle)
    flank, tangent = float(torque_sign), math.tan(drive.pressure_angle)
    first, second = counted * b * (1j - counted * flank * tangent), counted * c * (1j + counted * flank * tangent)
    idler_angle, output_angle = gear_angles(linkage, train, crank_angle)
    speed = train.ratio + train.coupler_share * state.coupler_velocity + train.rocker_share * state.rocker_velocity
    return RegisterGains(
        crank=(e1 * v).real,
        crank_idler=(e2 * v).real - b * scale * flank * tangent,
        idler_output=-(e3 * v).real - c * scale * flank * tangent,
        frame=-v.real,
        pin_a=v,
        pin_d=-v,
        crank_gear=-scale * first * np.conj(e2) * e1,
        idler=scale * np.exp(1j * idler_angle) * (first * np.conj(e2) - second * np.conj(e3)),
        output_gear=scale * second * np.conj(e3) * np.exp(1j * output_angle),
        input_angle=drive.radius * speed,
        play=np.full(np.shape(crank_angle), -scale * flank / math.cos(drive.pressure_angle)),
    )


def signs(train: GearTrain) -> tuple[float, float, float]:
    """Signs of z1 + z3 and z3 + z5, and that of z5 in the sense in which the output is counted.

    Example
        >>> signs(GearTrain(48, 36, -118, -1))
        (1.0, -1.0, 1.0)
    """
    b, c = (math.copysign(1.0, teeth + train.idler) for teeth in (train.crank, train.output))
    return b, c, math.copysign(1.0, train.output) * train.sense


def gear_angles(linkage: FourBar, train: GearTrain, crank_angle: Reals) -> tuple[Reals, Reals]:
    """Angles that idler and output gear have turned since crank angle 0.

    th3 = i2 phi + (1 - i2) t2,   th5 = i3 th3 + (1 - i3) t3

    Parameters
        crank_angle : (N,) array [rad]
    Returns
        idler, output : (N,) arrays [rad]
    Source
        thesis (4-21), (4-22)
    """
    state, start = fourbar_sweep.solve(linkage, crank_angle), fourbar_sweep.solve(linkage, np.zeros(1))
    coupler, rocker = state.coupler_angle - start.coupler_angle, state.rocker_angle - start.rocker_angle
    idler = train.i2 * crank_angle + (1.0 - train.i2) * coupler
    return idler, train.i3 * idler + (1.0 - train.i3) * rocker
