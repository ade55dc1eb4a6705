"""The tables of `loads`, a row per degree of the input over a whole period."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table
from gearlink.core.studies.loads.names import RPM

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.studies.loads.design import LoadsDesign


def torque(design: LoadsDesign, samples: int | None = None) -> Table:
    """Input torque and its parts, reflected inertia and power over the input angle; empty where friction locks."""
    import numpy as np

    phi, columns = design.rows(samples)
    machine = design.machine
    reduced = machine.reduced(phi)
    whole = np.full_like(phi, np.nan) if design.locked else machine.torque(phi)
    inertial = reduced.inertial(machine.speed)
    columns |= {
        "input_torque": (whole, "N m"),
        "inertia_part": (inertial, "N m"),
        "load_part": (whole - inertial, "N m"),
        "reflected_inertia": (reduced.inertia, "kg m^2"),
        "reflected_inertia_slope": (reduced.slope, "kg m^2"),
        "power": (whole * machine.speed, "W"),
    }
    return Table.of("torque", columns)


def joints(design: LoadsDesign, samples: int | None = None) -> Table:
    """Every pin's force on the second link of the joint, those of the guides, and sums of shafts in each other."""
    from gearlink.core.mechanism.joints import Guide, Pin

    phi, columns = design.rows(samples)
    found = design.machine.reactions(phi)
    for each in found.mechanism.connections:
        if not isinstance(each, (Pin, Guide)) or each.name in design.unknown_joints:
            continue
        force = found.force(each.name)
        columns |= _force(each.name, force)
        if isinstance(each, Guide):
            columns[f"{each.name}_moment"] = (found.unknowns[each.name][1], "N m")
    for names in _on_one_axis(design, found.mechanism):
        columns |= _force(f"{names[0]}_sum", sum(found.force(name) for name in names))
    return Table.of("joints", columns)


def _force(name: str, force: Any) -> dict[str, tuple[Any, str]]:
    return {f"{name}_x": (force.real, "N"), f"{name}_y": (force.imag, "N"), name: (abs(force), "N")}


def _on_one_axis(design: LoadsDesign, mechanism: Mechanism) -> Iterator[list[str]]:
    """The pins of the frame about each axis that has several: shafts that run in each other load it together."""
    from gearlink.core.mechanism.joints import Pin
    from gearlink.core.mechanism.links import FRAME

    axes: dict[complex, list[str]] = {}
    for each in mechanism.connections:
        if isinstance(each, Pin) and each.first == FRAME and each.name not in design.unknown_joints:
            axes.setdefault(complex(each.at[0]), []).append(each.name)
    return (names for names in axes.values() if len(names) > 1)


def teeth(design: LoadsDesign, samples: int | None = None) -> Table:
    """Tangential and radial tooth force of every mesh."""
    from gearlink.core.mechanism.joints import ToothDrive, meshes_of

    phi, columns = design.rows(samples)
    found = design.machine.reactions(phi)
    for mesh in meshes_of(found.mechanism):
        tangential = found.unknowns[mesh.name][0]
        if isinstance(mesh, ToothDrive):
            tangential = tangential * mesh.moves
        columns[mesh.name] = (tangential, "N")
        columns[f"{mesh.name}_radial"] = (abs(tangential) * mesh.tangent, "N")
    return Table.of("teeth", columns)


def frame(design: LoadsDesign, samples: int | None = None) -> Table:
    """Shaking force and moment of the masses on the frame."""
    phi, columns = design.rows(samples)
    force, moment = design.shaking(phi)
    columns |= {"force_x": (force.real, "N"), "force_y": (force.imag, "N"), "moment": (moment, "N m")}
    return Table.of("frame", columns)


def speed(design: LoadsDesign, samples: int | None = None) -> Table:
    """Speed of the input, time and kinetic energy over the input angle."""
    phi, columns = design.rows(samples)
    running = design.running
    found = running.speed(phi)
    kinetic = 0.5 * (design.machine.reduced(phi).inertia + running.inertia) * found**2
    columns |= {
        "speed": (found / RPM, "1/min"),
        "time": (1e3 * running.time(phi), "ms"),
        "kinetic_energy": (kinetic, "J"),
    }
    return Table.of("speed", columns)


def spectrum(design: LoadsDesign, samples: int | None = None) -> Table:
    """Residual vibration from 0.1 to 1.3 times the speed of the design."""
    vibrating = design.vibrating_given
    shares, periods, residual = vibrating.spectrum(samples or 121)
    columns = {
        "speed": (shares * abs(design.speed) / design.speed_unit, design.speed_unit_name),
        "ratio": (periods, "1"),
        "residual": (residual, "mm" if vibrating.slides else "deg"),
    }
    return Table.of("spectrum", columns)


def harmonics(design: LoadsDesign, samples: int | None = None) -> Table:
    """Harmonics of the output's motion: order, frequency, torque or force of its mass, and deflection."""
    import numpy as np

    from gearlink.core.studies.loads.vibration import harmonics as amplitudes

    vibrating, machine = design.vibrating_given, design.machine
    orders, rows = 40 * design.turns, max(samples or 720, 160) * design.turns
    phi = np.arange(rows, dtype=np.float64) * (machine.period / rows)
    bend = amplitudes(vibrating.bend(phi), orders) * machine.speed**2
    order = np.arange(1, orders + 1) / design.turns
    w_n, zeta = vibrating.oscillator.frequency, vibrating.oscillator.damping
    at = order * abs(machine.speed)
    transfer = np.abs(w_n**2 - at**2 + 2j * zeta * w_n * at)
    inertia = vibrating.swung / 1e3 if vibrating.slides else np.radians(vibrating.swung)
    columns = {
        "order": (order, "1"),
        "frequency": (at / (2.0 * np.pi), "Hz"),
        "torque": (bend * inertia, "N" if vibrating.slides else "N m"),
        "twist": (np.divide(bend, transfer, out=np.full_like(bend, np.nan), where=transfer > 0.0),
                  "mm" if vibrating.slides else "deg"),
    }  # fmt: skip
    return Table.of("harmonics", columns)
