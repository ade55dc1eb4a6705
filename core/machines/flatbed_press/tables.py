"""Tables of a flatbed press; each is a function of the design and the number of rows."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.parts.linkages.fourbar.position import FourBar


def positions(design: FlatbedPress, samples: int | None = None) -> Table:
    """Both chains at equal steps of the input angle (TY-460 report 1.2, 2.2), and the bed with the lift of its cam."""
    import numpy as np

    from gearlink.core.numerics.arrays import turn_degrees

    motion, degrees = design.motion, turn_degrees(samples or 12)
    phi = np.radians(degrees)
    cam, speed = motion.bed.cam_angle(phi, 1), motion.input_speed
    p, q = motion.bed.travel(phi, 1, cam), motion.cylinder.travel(phi, 1)
    columns = {
        "input_angle": (degrees, "deg"),
        "cam_angle": (_from_start(phi, np.degrees(cam.value)), "deg"),
        "bed_displacement": (p.value, "mm"),
        "bed_velocity": (_from_start(phi, p.first * speed), "mm/s"),
        "cylinder_displacement": (q.value, "mm"),
        "cylinder_velocity": (q.first * speed, "mm/s"),
        "transmission_angle_bed": (_transmission(motion.bed.linkage, motion.bed.initial_crank_angle + phi), "deg"),
        "transmission_angle_cylinder": (
            _transmission(motion.cylinder.linkage, motion.cylinder.initial_angle - phi),
            "deg",
        ),
    }
    if design.spec.cam is not None and design.bed_moves:
        bed = design.bed_motion.travel(phi)
        columns["compensated_displacement"] = (bed.value, "mm")
        columns["compensated_velocity"] = (bed.first * speed, "mm/s")
    return Table.of("positions", columns)


def chains(design: FlatbedPress, samples: int | None = None) -> Table:
    """Accelerations of bed and cylinder and the directions of all links over the input angle, with the time.

    Of a bed whose cam cannot be nothing is said.
    """
    import numpy as np

    from gearlink.core.numerics.arrays import turn_degrees
    from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
    from gearlink.core.parts.linkages.slider_crank import sweep as slider_crank_sweep

    motion, degrees = design.motion, turn_degrees(samples)
    phi, speed, bed, cylinder = np.radians(degrees), motion.input_speed, motion.bed, motion.cylinder
    q = cylinder.travel(phi, 2)
    one = fourbar_sweep.solve(bed.linkage, bed.initial_crank_angle + phi, 0)
    other = fourbar_sweep.solve(cylinder.linkage, cylinder.initial_angle - phi, 0)
    slider = one.rocker_angle - bed.crank_offset_angle
    crank, rod, offset = bed.slider_crank_length, bed.rod, bed.offset
    slider_crank_sweep.slider(slider, crank, rod, offset)  # refuses where the rod does not reach
    columns = {
        "input_angle": (degrees, "deg"),
        "time": (degrees / 360.0 * 3.6e6 / design.spec.speed, "ms"),
        **_bed_rates(design, phi),
        "cylinder_velocity": (q.first * speed, "mm/s"),
        "cylinder_acceleration": (q.second * speed**2, "mm/s^2"),
        "BC_angle": (np.degrees(one.coupler_angle), "deg"),
        "CD_angle": (np.degrees(one.rocker_angle), "deg"),
        "DE_angle": (np.degrees(slider), "deg"),
        "rod_angle": (np.degrees(np.arcsin((crank * np.cos(slider) + offset) / rod)), "deg"),
        "HM_angle": (np.degrees(other.coupler_angle), "deg"),
        "MN_angle": (np.degrees(other.rocker_angle), "deg"),
    }
    return Table.of("chains", columns)


def _bed_rates(design: FlatbedPress, phi: Any) -> dict[str, Any]:
    if not design.bed_moves:
        return {}
    bed, speed = design.bed_motion.travel(phi), design.motion.input_speed
    return {"bed_velocity": (bed.first * speed, "mm/s"), "bed_acceleration": (bed.second * speed**2, "mm/s^2")}


def _from_start(input_angle: Any, values: Any) -> Any:
    """Values that are 0 at the start by its definition: there the cam's turn begins and the bed stands at its dead
    centre, which the directions of the links give to rounding."""
    import numpy as np

    return np.where(input_angle == 0.0, 0.0, values)


def _transmission(linkage: FourBar, crank_angle: Any) -> Any:
    import numpy as np

    from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
    from gearlink.core.parts.linkages.fourbar.sweep import dead_point_distance

    return np.degrees(dead_point_distance(fourbar_sweep.solve(linkage, crank_angle).transmission_angle))


def follower(design: FlatbedPress, samples: int | None = None) -> Table:
    """Lift of the follower over the cam angle (TY-460 report 3.4)."""
    import numpy as np

    from gearlink.core.numerics.arrays import turn_degrees

    degrees = turn_degrees(samples)
    lift, phases = design.cams.follower.evaluate(np.radians(degrees), 2)
    columns = {
        "cam_angle": (degrees, "deg"),
        "lift": (lift.value, "mm"),
        "velocity": (lift.first, "mm/rad"),
        "acceleration": (lift.second, "mm/rad^2"),
        "phase": (phases, "1"),
    }
    return Table.of("follower", columns)


def main_cam(design: FlatbedPress, samples: int | None = None) -> Table:
    """The main cam, point for point (TY-460 report 3.5)."""
    return design.main_cam.table("main_cam", samples)


def return_cam(design: FlatbedPress, samples: int | None = None) -> Table:
    """The return cam, point for point (TY-460 report 3.6)."""
    return design.return_cam.table("return_cam", samples)
