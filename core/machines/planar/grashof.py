"""What the four-bars of a planar mechanism are by their lengths."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.machines.planar.wiring import FRAME

if TYPE_CHECKING:
    from gearlink.core.machines.planar.spec import PlanarSpec

_CHANGE = 1e-9


def loops(spec: PlanarSpec) -> list[str]:
    """The loops frame, driven link, coupler, output link of four pins, as "A B C D: crank-rocker"."""
    bodies, crank = spec.bodies, spec.drive.link
    if crank is None:
        return []
    found = []
    for a in _shared(bodies, FRAME, crank):
        for b in (point for point in bodies[crank] if point != a):
            for coupler in (name for name in bodies if name not in (FRAME, crank) and b in bodies[name]):
                for c in (point for point in bodies[coupler] if point != b):
                    for last in (name for name in bodies if name not in (FRAME, crank, coupler) and c in bodies[name]):
                        for d in _shared(bodies, FRAME, last):
                            if len({a, b, c, d}) == 4:
                                pairs = (crank, a, b), (coupler, b, c), (last, c, d), (FRAME, a, d)
                                lengths = [abs(bodies[body][p] - bodies[body][q]) for body, p, q in pairs]
                                found.append(f"{a} {b} {c} {d}: {sort_of(*lengths)}")
    return list(dict.fromkeys(found))


def _shared(bodies: dict[str, dict[str, complex]], one: str, other: str) -> list[str]:
    return [point for point in bodies[one] if point in bodies[other]]


def sort_of(crank: float, coupler: float, output: float, frame: float) -> str:
    """What a four-bar is by Grashof's rule.

    Example
        >>> sort_of(32.0, 96.0, 78.0, 120.0), sort_of(50.0, 60.0, 50.0, 60.0), sort_of(80.0, 60.0, 50.0, 100.0)
        ('crank-rocker', 'change-point', 'non-Grashof')
    """
    lengths = [crank, coupler, output, frame]
    least, _, _, greatest = sorted(lengths)
    apart = 2.0 * (least + greatest) - sum(lengths)
    if abs(apart) <= _CHANGE * greatest:
        return "change-point"
    if apart > 0.0:
        return "non-Grashof"
    return ("crank-rocker", "double-rocker", "rocker-crank", "double-crank")[lengths.index(least)]
