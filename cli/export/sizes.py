"""Sizes that workshop drawings show of parts without teeth: dimensions of the outline, and the lines of a table.

They are read off the outlines that `export` writes, or are quantities of the design.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.export.contour import Dimension

if TYPE_CHECKING:
    from gearlink.core.machines.cam_drives.grooved import Groove
    from gearlink.core.machines.cycloidal.disc import Disc
    from gearlink.core.machines.dwell_gears.locking import Lock
    from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell
    from gearlink.core.machines.geneva.design import GenevaDrive, Outlines, Piece

Lines = list[tuple[str, str, Any, str]]
_TURN = 2.0 * math.pi


def size(value: float) -> str:
    """A length to a thousandth, without noughts at its end.

    Example
        >>> size(16.0), size(52.03849)
        ('16', '52.038')
    """
    return f"{value:.3f}".rstrip("0").rstrip(".")


def wheel(outlines: Outlines) -> tuple[Dimension, ...]:
    """Width and bottom of a slot, radius and place of a locking arc of a Geneva wheel."""
    drive, pieces = outlines.drive, {piece.name: piece for piece in outlines.wheel_half()}
    bottom, (start, end) = abs(_ends(pieces["bottom"])[0]), _ends(pieces["slot"])
    corner = max(start, end, key=lambda place: place.real)
    found = [
        Dimension(f"{drive.slots} × {size(2.0 * corner.imag)}", corner.conjugate(), corner, row=1),
        Dimension(f"R{size(bottom)}", 0j, complex(bottom), drive.slots),
    ]
    if "locking arc" in pieces:
        center = cmath.rect(drive.distance, math.pi / drive.slots)
        middle = _ends(pieces["locking arc"])[1]
        found.append(Dimension(f"{drive.slots} × R{size(abs(middle - center))}", center, middle, drive.slots))
        found.append(Dimension(size(drive.distance), center, 0j, drive.slots))
    return tuple(found)


def wheel_lines(design: GenevaDrive) -> Lines:
    """The table of a Geneva wheel."""
    spec, drive, outlines = design.spec, design.drive, design.outlines_with(design.spec.locking_radius or 0.0)
    given: Lines = [
        ("slots, equally spaced", "n", spec.slots, ""),
        ("angle between two slots", "", 360.0 / spec.slots, "deg"),
        ("distance of the axes", "a", spec.center_distance, "mm"),
        ("width of a slot", "b", 2.0 * outlines.slot, "mm"),
        ("diameter of the pin", "", 2.0 * spec.pin_radius, "mm"),
        ("axis to the centre of a slot's bottom", "", drive.distance - drive.sign * drive.crank, "mm"),
        ("diameter of the circle through the slots' corners", "", 2.0 * outlines.tip, "mm"),
    ]
    if spec.locking_radius is not None:
        given.append(("radius of the locking arcs", "h", outlines.hollow, "mm"))
    return [*given, *_quantities(design, ("crank_radius", "wheel_radius", "slot_bottom_radius", "lip_thickness"))]


def driver(outlines: Outlines) -> tuple[Dimension, ...]:
    """The disc's radius, the ends of its arc, the cut-out and the place of a pin of a Geneva drive's crank."""
    drive, edge = outlines.drive, outlines.edge
    found = [
        Dimension(size(abs(outlines.cut_vertex)), 0j, complex(outlines.cut_vertex), row=1),
        Dimension(size(drive.crank), 0j, complex(drive.crank), row=2),
        Dimension(size(2.0 * edge.imag), edge.conjugate(), edge, row=1),
    ]
    arcs = [piece for piece in outlines.driver() if piece.name == "locking arc"]
    if arcs:
        found.append(Dimension(f"R{size(outlines.locking)}", 0j, _at(arcs[0], 0.35), drive.pins))
    return tuple(found)


def driver_lines(design: GenevaDrive, outlines: Outlines) -> Lines:
    """The table of the crank of a Geneva drive."""
    spec, edge = design.spec, outlines.edge
    given: Lines = [
        ("pins, equally spaced", "", spec.pins, ""),
        ("diameter of a pin", "", 2.0 * spec.pin_radius, "mm"),
        ("distance of the axes", "a", spec.center_distance, "mm"),
        ("diameter of the locking disc", "", 2.0 * outlines.locking, "mm"),
        ("edges of the disc, from the pin's radius on", "", math.degrees(cmath.phase(edge)), "deg"),
        ("distance of both edges of a cut-out", "", 2.0 * edge.imag, "mm"),
        ("axis to a cut-out, on the pin's radius", "", outlines.cut_vertex, "mm"),
        ("radius of a cut-out", "", outlines.cut_radius if math.isfinite(outlines.cut_radius) else "straight", "mm"),
    ]
    return [*given, *_quantities(design, ("crank_radius", "locking_angle"))]


def disc(lock: Lock, groups: int) -> tuple[Dimension, ...]:
    """Radii of a locking disc's arc and of its cut-out."""
    end, middle = 0.5 * lock.arc, math.pi / groups
    return (
        Dimension(f"R{size(lock.radius)}", 0j, cmath.rect(lock.radius, 0.35 * end)),
        Dimension(f"R{size(lock.cut)}", 0j, cmath.rect(lock.cut, middle + 0.5 * (middle - end))),
    )


def disc_lines(design: MutilatedGearDwell) -> Lines:
    """The table of a locking disc."""
    lock = design.lock
    assert lock is not None, "as for the disc"
    given: Lines = [
        ("arcs, equally spaced", "", design.spec.gears.groups, ""),
        ("diameter of the disc", "2 R", 2.0 * lock.radius, "mm"),
        ("radius of the cut-out", "", lock.cut, "mm"),
        ("distance of the axes", "a", lock.distance, "mm"),
    ]
    return [*given, *_quantities(design, ("locking_arc",))]


def plate(lock: Lock) -> tuple[Dimension, ...]:
    """Radius of a locking plate's arc, and the distance of its tips."""
    tip, center = cmath.rect(lock.plate, lock.half_arc), complex(lock.distance)
    place = center + cmath.rect(lock.hollow, math.pi + 0.5 * cmath.phase(center - tip))
    return (
        Dimension(f"{lock.stops} × R{size(lock.hollow)}", center, place, lock.stops),
        Dimension(size(2.0 * tip.imag), tip.conjugate(), tip, row=1),
    )


def plate_lines(design: MutilatedGearDwell) -> Lines:
    """The table of a locking plate."""
    lock = design.lock
    assert lock is not None, "as for the plate"
    given: Lines = [
        ("arcs, equally spaced", "", lock.stops, ""),
        ("diameter of the plate", "2 p", 2.0 * lock.plate, "mm"),
        ("radius of an arc", "R + c", lock.hollow, "mm"),
        ("distance of the axes, centre of an arc", "a", lock.distance, "mm"),
        ("angle between the tips of an arc", "", math.degrees(2.0 * lock.half_arc), "deg"),
        ("axis to the middle of an arc", "", lock.bottom, "mm"),
    ]
    play = ("free rotation in the dwell", "", math.degrees(lock.play), "deg")
    return [*given, play, *_quantities(design, ("locking_arm",))]


def lobes(disc: Disc) -> tuple[Dimension, ...]:
    """Radii of valleys and tips of a cycloidal disc."""
    places, _ = disc.profile(np.array([0.0, math.pi / disc.lobes]))
    return tuple(Dimension(f"R{abs(place):.3f}", 0j, place, disc.lobes) for place in places.tolist())


def ring_lines(disc: Disc) -> Lines:
    """The table of the ring of pins of a cycloidal reducer."""
    return [
        ("pins, equally spaced", "Z", disc.pins, ""),
        ("angle between two pins", "", 360.0 / disc.pins, "deg"),
        ("diameter of a pin", "2 r_p", 2.0 * disc.pin, "mm"),
        ("diameter of the circle of their centres", "2 R", 2.0 * disc.circle, "mm"),
        ("distance of two neighbours' centres", "", 2.0 * disc.circle * math.sin(math.pi / disc.pins), "mm"),
        ("diameter of the circle within the pins", "", 2.0 * (disc.circle - disc.pin), "mm"),
    ]


def centre_line(groove: Groove) -> tuple[Dimension, ...]:
    """The extreme radii of the centre line of a groove."""
    _, far, near = groove.extremes
    places = [complex(groove.path(np.array([each.place])).place[0]) for each in (near, far)]
    return tuple(Dimension(f"R{abs(place):.3f}", 0j, place) for place in places)


def _quantities(design: GenevaDrive | MutilatedGearDwell, names: Iterable[str]) -> Lines:
    """Results of the design by their names, those that it has."""
    found = [each for name in names if (each := design.quantity(name)) is not None]
    return [(each.words, each.symbol, each.value, each.unit) for each in found]


def _ends(piece: Piece) -> tuple[complex, complex]:
    return _at(piece, 0.0), _at(piece, 1.0)


def _at(piece: Piece, share: float) -> complex:
    return complex(piece.curve(np.array([piece.low + share * (piece.high - piece.low)]))[0])
