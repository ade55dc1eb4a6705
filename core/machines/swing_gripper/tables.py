"""Tables of a swing gripper; each is a function of the design and the number of rows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import MissingSection
from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import SwingGripper

_WINDOW = 6.0
_ROWS = 41


def motion(design: SwingGripper, samples: int | None = None) -> Table:
    """Angles, velocities and accelerations of both rockers over the turn."""
    import numpy as np

    degrees, motion = design.motion.rows(samples)
    speed, square = design.motion.shaft_speed, design.motion.shaft_speed**2
    columns = {
        "theta": (degrees, "deg"),
        "beta": (np.degrees(motion.beta), "deg"),
        "input_angle": (np.degrees(motion.input_angle), "deg"),
        "coupler_angle": (np.degrees(motion.coupler_angle), "deg"),
        "output_angle": (np.degrees(motion.output_angle), "deg"),
        "input_velocity": (motion.input_velocity * speed, "rad/s"),
        "output_velocity": (motion.output_velocity * speed, "rad/s"),
        "input_acceleration": (motion.input_acceleration * square, "rad/s^2"),
        "output_acceleration": (motion.output_acceleration * square, "rad/s^2"),
    }
    return Table.of("motion", columns)


def tip(design: SwingGripper, samples: int | None = None) -> Table:
    """Path of the gripper's tip in the machine's frame, its speed and acceleration, and the jerk of the arm."""
    import cmath
    import math

    import numpy as np

    from gearlink.core.numerics.arrays import product, turn_degrees

    degrees, spec, speed = turn_degrees(samples), design.spec, design.motion.shaft_speed
    beta = design.motion.law.evaluate(degrees, 3)
    arm = np.exp(1j * spec.swing_sense * beta[0])
    arm = product(spec.arm.length * cmath.exp(1j * math.radians(spec.arm.direction)), arm)
    velocity, acceleration = beta[1] * speed, beta[2] * speed**2
    place = complex(*spec.pivots.output) + arm
    columns = {
        "theta": (degrees, "deg"),
        "time": (degrees / 360.0 * 3.6e6 / spec.speed, "ms"),
        "tip_x": (place.real, "mm"),
        "tip_y": (place.imag, "mm"),
        "tip_speed": (spec.arm.length * np.abs(velocity), "mm/s"),
        "tip_acceleration": (spec.arm.length * np.hypot(acceleration, velocity**2), "mm/s^2"),
        "output_jerk": (spec.swing_sense * beta[3] * speed**3 + 0.0, "rad/s^3"),
    }
    return Table.of("tip", columns)


def newton(design: SwingGripper, samples: int | None = None) -> Table:
    """Both ways side by side: deviation of the angles, steps, opening of the loop, error of the closed form."""
    import numpy as np

    from gearlink.core.machines.swing_gripper.loop import closed_form_error

    degrees, loop = design.motion.loop_at(samples)
    _, motion = design.motion.rows(samples)
    columns = {
        "theta": (degrees, "deg"),
        "deviation": (np.degrees(loop.deviation), "deg"),
        "iterations": (loop.iterations, "1"),
        "residual": (loop.residual, "mm"),
        "error": (np.degrees(closed_form_error(design.linkage, motion)), "deg"),
    }
    return Table.of("newton", columns)


def main_cam(design: SwingGripper, samples: int | None = None) -> Table:
    """The main cam, point for point."""
    return design.cams.main_cam.table("main_cam", samples)


def return_cam(design: SwingGripper, samples: int | None = None) -> Table:
    """The return cam, point for point."""
    if design.cams.return_cam is None:
        raise MissingSection("the table needs cam.return_roller: arm, angle, radius", key="cam.return_roller")
    return design.cams.return_cam.table("return_cam", samples)


def forces(design: SwingGripper, samples: int | None = None) -> Table:
    """Inertia and contact torques and normal forces over the turn."""
    import numpy as np

    from gearlink.core.machines.swing_gripper.forces import contact_torques
    from gearlink.core.numerics.arrays import turn_degrees

    degrees, spring = turn_degrees(samples), design.closure.closing_torque
    main, back = design.closure.inertia_torques(degrees)
    torques = contact_torques(spring, main, back, design.closure.lift_sense)
    columns: dict[str, tuple[Any, str]] = {"theta": (degrees, "deg"), "inertia_torque": (main, "N m")}
    rollers = (design.cams.section.roller, design.cams.section.return_roller)
    contacts = list(zip(("main", "return"), torques, design.cams.discs, rollers, strict=False))
    for name, torque, _, _ in contacts:
        columns[f"contact_torque_{name}"] = (torque, "N m")
    for name, torque, cam, roller in contacts:
        lever = roller.arm * 1e-3 * np.cos(cam.pressure_angle(np.radians(degrees)))  # type: ignore[union-attr]
        columns[f"normal_force_{name}"] = (torque / lever, "N")
    return Table.of("forces", columns)


def handover_window(design: SwingGripper, _samples: int | None = None) -> Table:
    """Gap of the tip to the pitch circle, slip and speed difference round the handover."""
    import numpy as np

    from gearlink.core.machines.swing_gripper.handover_geometry import speed_difference

    half = design.spec.release.window if design.spec.release is not None else _WINDOW
    degrees = design.spec.handover + half * np.linspace(-1.0, 1.0, _ROWS)
    lead, speed, path = design.handover.path(degrees)
    difference = speed_difference(path, lead, speed, design.motion.shaft_speed, design.spec.cylinder.radius)
    columns = {
        "theta": (degrees, "deg"),
        "arm_lead": (np.degrees(lead), "deg"),
        "gap": (path.gap, "mm"),
        "slip": (path.slip, "mm"),
        "speed_difference": (difference, "mm/s"),
    }
    return Table.of("handover_window", columns)
