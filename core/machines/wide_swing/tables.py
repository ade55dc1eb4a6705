"""Tables of a wide-swing design over the stroke, the speed, and the steps of the source's iteration."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table
from gearlink.core.base.rows import row_numbers

if TYPE_CHECKING:
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign


def _k(samples: int | None) -> Any:
    import numpy as np

    count = samples or 100
    rows = row_numbers(samples, count + 1)
    return np.arange(rows.start, rows.stop) / count


def law(design: WideSwingDesign, samples: int | None = None) -> Table:
    """The invariants of the law over the stroke."""
    k = _k(samples)
    a, b, c = design.motion.law.invariants(k, 2)
    return Table.of("law", {"k": (k, "1"), "displacement": (a, "1"), "velocity": (b, "1"), "acceleration": (c, "1")})


def slider(design: WideSwingDesign, samples: int | None = None) -> Table:
    """The slider's invariants over the stroke, its travel and its speed at the design speed."""
    k, moved = _k(samples), design.motion.slider
    a, b, c = moved.slider_invariants(k)
    columns = {
        "k": (k, "1"),
        "displacement": (a, "1"),
        "velocity": (b, "1"),
        "acceleration": (c, "1"),
        "travel": (moved.stroke * a, "mm"),
        "speed": (moved.stroke / design.motion.working_time * b, "mm/s"),
    }
    return Table.of("slider", columns)


def _speed_shares() -> Any:
    import numpy as np

    return np.arange(10, 135, 5) / 100.0


def contact(design: WideSwingDesign, samples: int | None = None) -> Table:
    """Force of the roller on the cam over the stroke and the speed, empty where it does not touch the profile."""
    import numpy as np

    shares, count = _speed_shares(), samples or 100
    rows = row_numbers(samples, shares.size * (count + 1))
    number = np.arange(rows.start, rows.stop)
    k, share = number % (count + 1) / count, shares[number // (count + 1)]
    columns = {"k": (k, "1"), "force": (_force(design, design.cam, k, share), "N"), "speed_share": (share, "1")}
    if design.return_cam is not None:
        columns["return_force"] = (_force(design, design.return_cam, k, share), "N")
    return Table.of("contact", columns)


def _force(design: WideSwingDesign, cam: AnyCam, k: Any, share: Any) -> Any:
    import numpy as np

    from gearlink.core.machines.wide_swing.cams.outline import middle_of

    touching = design.touches(cam, k) & (k != middle_of(cam))
    force = np.full_like(k, np.nan)
    force[touching] = design.unloading.contact_force(cam, k[touching], share[touching])
    return force


def balance(design: WideSwingDesign, _samples: int | None = None) -> Table:
    """Torque on the rocker axis with and without the device, over the speed."""
    import numpy as np

    from gearlink.core.machines.wide_swing.law.balancing import drive_balancing_ratio, speed_sweep

    share, spec, motion = _speed_shares(), design.spec, design.motion
    inertia, losses = design.unloading.even_inertia, (spec.unloader.residual, spec.unloader.reserve)
    without, left = speed_sweep(inertia, motion.plain_law, motion.stroke_time, share, *losses)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = without / left
    columns = {
        "speed": (share * spec.speed, "1/min"),
        "torque_without": (without, "N m"),
        "torque_with": (left, "N m"),
        "ratio": (ratio, "1"),
    }
    if spec.shaft is not None:
        columns["drive_ratio"] = (drive_balancing_ratio(share, spec.shaft.linkage_share, *losses), "1")
    return Table.of("balance", columns)


def iteration(design: WideSwingDesign, _samples: int | None = None) -> Table:
    """Steps of the iteration against its error (run time against error of the source's own method)."""
    from gearlink.core.machines.wide_swing.law.iteration import legacy_law

    motion, steps = design.motion, (5, 10, 20, 50, 100, 200)
    laws = [legacy_law(motion.device, motion.swing, steps=n) for n in steps]
    exact = motion.plain_law.energy_parameter
    columns = {
        "steps": (steps, "1"),
        "passes": ([law.passes for law in laws], "1"),
        "energy_parameter": ([law.energy_parameter for law in laws], "1"),
        "relative_error": ([law.energy_parameter / exact - 1.0 for law in laws], "1"),
    }
    return Table.of("iteration", columns)


def contour(design: WideSwingDesign, samples: int | None = None) -> Table:
    """Both cams as closed contours over one turn."""
    return design.cycle.table(samples)


def joints(design: WideSwingDesign, _samples: int | None = None) -> Table:
    """The joints of both closed contours."""
    return design.cycle.joints()


def main_cam(design: WideSwingDesign, samples: int | None = None) -> Table:
    """The cam of the working stroke; where the roller's slot cuts the profile away, x and y are empty."""
    return _cam(design, "main_cam", design.cam, 1.0, samples)


def return_cam(design: WideSwingDesign, samples: int | None = None) -> Table:
    """The cam of the return stroke: a mirror image (twin-cam), or the external profile of the twin-rocker."""
    mirror = -1.0 if design.spec.layout == "twin-cam" else 1.0
    return _cam(design, "return_cam", design.return_cam or design.even_cam, mirror, samples)


def _cam(design: WideSwingDesign, name: str, cam: AnyCam, mirror: float, samples: int | None) -> Table:
    import numpy as np

    k = _k(samples)
    gone = ~design.touches(cam, k)
    points = cam.points(k)
    columns = {
        "k": (k, "1"),
        "cam_angle": (np.degrees(points.cam_angle), "deg"),
        "pitch_x": (points.pitch.real, "mm"),
        "pitch_y": (mirror * points.pitch.imag, "mm"),
        "x": (np.where(gone, np.nan, points.profile.real), "mm"),
        "y": (np.where(gone, np.nan, mirror * points.profile.imag), "mm"),
        "pressure_angle": (np.degrees(points.pressure_angle), "deg"),
        "curvature_radius": (points.curvature_radius, "mm"),
    }
    return Table.of(name, columns)
