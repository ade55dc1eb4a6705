"""Planar mechanisms with 40 digits from the text of their files alone: joints as equations, a root, differences.

A second way beside `core/machines/planar`: nothing of it is used, no branch is followed; rates are differences of
positions on either side.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import Any

from mpmath import mp, mpc, mpf

DIGITS = 40
STEP = mpf("1e-4")
# Weights of nine places for derivatives 1 to 3, exact for polynomials of degree 8
WEIGHTS = {
    1: ["1/280", "-4/105", "1/5", "-4/5", "0", "4/5", "-1/5", "4/105", "-1/280"],
    2: ["-1/560", "8/315", "-1/5", "8/5", "-205/72", "8/5", "-1/5", "8/315", "-1/560"],
    3: ["-7/240", "3/10", "-169/120", "61/30", "0", "-61/30", "169/120", "-3/10", "7/240"],
}


def fraction(text: str) -> Any:
    """A weight."""
    top, _, below = text.partition("/")
    return mpf(top) / mpf(below or "1")


def _cis(angle: Any) -> Any:
    return mpc(mp.cos(angle), mp.sin(angle))


class Bodies:
    """Equations of a file.

    Parameters
        file : dict - as YAML gives it
        size : float - lengths of the file are divided by it in the equations
    """

    def __init__(self, file: Mapping[str, Any]) -> None:
        self.file = file
        self.points: dict[str, dict[str, Any]] = {"frame": {k: mpc(*v) for k, v in file["frame"].items()}}
        for name, link in file["links"].items():
            self.points[name] = (
                {k: mpc(*v) for k, v in link.items()}
                if isinstance(link, dict)
                else {link[0]: mpc(0), link[1]: mpc(link[2])}
            )
        self.names = list(file["links"])

    def place(self, y: Any, body: str, at: Any) -> Any:
        """A point of a body from the unknowns x, y, t of every link."""
        if body == "frame":
            return at
        i = 3 * self.names.index(body)
        return mpc(y[i], y[i + 1]) + at * _cis(y[i + 2])

    def turn(self, y: Any, body: str) -> Any:
        """Direction of a body."""
        return mpf(0) if body == "frame" else y[3 * self.names.index(body) + 2]

    def along(self, y: Any, body: str, through: Any, direction: Any, point: Any) -> Any:
        """A point seen from a line, along and across."""
        line = self.place(y, body, mpc(*through))
        return (point - line) * _cis(-self.turn(y, body) - mp.radians(mpf(direction)))

    def slid(self, y: Any, name: str) -> Any:
        """A slide's point seen from its line."""
        slide = self.file["slides"][name]
        points = self.points[slide["link"]]
        at = points[slide["point"]] if "point" in slide else next(iter(points.values()))
        point = self.place(y, slide["link"], at)
        return self.along(y, slide.get("on", "frame"), slide["through"], slide["direction"], point)

    def slotted(self, y: Any, name: str) -> Any:
        """A slot's pin seen from its line."""
        slot = self.file["slots"][name]
        body = next(b for b, points in self.points.items() if slot["point"] in points and b != slot["on"])
        return self.along(
            y, slot["on"], slot["through"], slot["direction"], self.place(y, body, self.points[body][slot["point"]])
        )

    def rolled(self, y: Any, name: str) -> Any:
        """What a mesh keeps."""
        mesh = self.file["meshes"][name]
        if "rack" in mesh:
            r = mpf(mesh["module"]) * mesh["teeth"] / 2
            centre = self.place(y, mesh["pinion"], self.points[mesh["pinion"]][mesh["at"]])
            way = self.along(y, mesh["rack"], [0, 0], mesh["direction"], centre).real
            return r * (self.turn(y, mesh["pinion"]) - self.turn(y, mesh["rack"])) + mesh["side"] * way
        carrier = next(b for b, points in self.points.items() if set(mesh["at"]) <= set(points))
        z1, z2 = mesh["teeth"]
        k = self.turn(y, carrier)
        return z1 * (self.turn(y, mesh["gears"][0]) - k) + z2 * (self.turn(y, mesh["gears"][1]) - k)

    def driven(self, y: Any, name: str) -> Any:
        """What a drive moves."""
        return self.slid(y, name).real if name in self.file.get("slides", {}) else self.turn(y, name)

    def equations(self, y: Any, kept: Mapping[str, Any], q: Any) -> list[Any]:
        """All of them; `kept` are the values at the start of meshes and drives."""
        found: list[Any] = []
        for point in dict.fromkeys(itertools.chain(*self.points.values())):
            first, *others = (body for body, points in self.points.items() if point in points)
            for other in others:
                gap = self.place(y, other, self.points[other][point]) - self.place(y, first, self.points[first][point])
                found += [gap.real, gap.imag]
        for name, slide in self.file.get("slides", {}).items():
            lean = mp.radians(mpf(slide["direction"]) + mpf(slide.get("angle", 0)))
            apart = self.turn(y, slide["link"]) - self.turn(y, slide.get("on", "frame")) - lean
            found += [self.slid(y, name).imag, mp.sin(apart)]
        found += [self.slotted(y, name).imag for name in self.file.get("slots", {})]
        found += [self.rolled(y, name) - kept[name] for name in self.file.get("meshes", {})]
        drive = self.file["drive"]
        ratios = {drive.get("link") or drive["slide"]: 1, **drive.get("with", {})}
        found += [self.driven(y, name) - kept[name] - mpf(ratio) * q for name, ratio in ratios.items()]
        return found

    def kept(self, y: Any) -> dict[str, Any]:
        """What meshes and drives keep from the start."""
        drive = self.file["drive"]
        names = [drive.get("link") or drive["slide"], *drive.get("with", {})]
        return {
            **{name: self.rolled(y, name) for name in self.file.get("meshes", {})},
            **{name: self.driven(y, name) for name in names},
        }

    def root(self, near: list[float], kept: Mapping[str, Any], q: Any) -> list[Any]:
        """Unknowns at an input next to approximate ones."""
        found = mp.findroot(lambda *y: self.equations(y, kept, q), [mpf(each) for each in near], tol=mpf(10) ** -70)
        return [*found]


def motion(
    file: Mapping[str, Any], start: list[float], near: list[float], q: float, orders: tuple[int, ...] = (1, 2, 3)
) -> list[list[Any]]:
    """Unknowns and their derivatives at an input, from approximate ones at the start and there."""
    with mp.workdps(DIGITS):
        bodies = Bodies(file)
        first = list(map(mpf, start))
        kept = bodies.kept(first)
        exact = bodies.root(start, kept, mpf(0))
        kept = {**kept, **{name: bodies.kept(exact)[name] for name in file.get("meshes", {})}}
        at = mpf(q)
        places = [bodies.root(near, kept, at + k * STEP) for k in range(-4, 5)]
        found = [places[4]]
        for order in orders:
            weights = [fraction(each) for each in WEIGHTS[order]]
            found.append([sum(w * p[i] for w, p in zip(weights, places, strict=True)) / STEP**order
                          for i in range(len(near))])  # fmt: skip
        return found
