"""Designs as manufactured of a planar mechanism: many at once next to the nominal one, or one by one.

Where the nominal mechanism stands, Newton and Kantorovich's theorem says of each sample that one of its own positions
lies beside it: with eta the first step, h = beta K eta below 1/4 at all places of the grid, the sample runs through the
period in the assembly of the nominal design. What does not pass is left to the class. Extremes are sought from those of
the nominal design on.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.design_axis import Evaluated, Findings
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar.design import PlanarMechanism, folded
from gearlink.core.machines.planar.dyads import Dyad, dyads
from gearlink.core.machines.planar.extremes import Coefficient, Wanted, humps
from gearlink.core.machines.planar.structure import Structure
from gearlink.core.machines.planar.system import Jets, System, drive_rows, joined, joint_rows, pins_of
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.parts.linkages.checks import transmission_judged
from gearlink.core.parts.linkages.codes import CLOSURE, TRANSMISSION_ANGLE
from gearlink.core.studies.tolerance.sources import Parts

_PIN = "pins."
_SIZES = re.compile(r"(frame|links)\.\w+(\.\w+\[[01]\]|\[[012]\])|(slides|slots)\.\w+\.through\[[01]\]")
_SIDES = ("max", "max_at", "min", "min_at", "span")
_CERTAIN = 0.25
"""Of h, below the 1/2 of the theorem: for the way between two places of the grid."""
_NEAR = 0.1
"""Of the range of a course: local extremes that may become the extreme of a sample."""
_FAR = 0.15
"""Of the input in rad, or of the size: how far an extreme may move from that of the nominal design."""
_STEPS, _CLOSING = 12, 6
_REST = 1e-13
_APART, _LOOKS = math.radians(1.0), 25
"""Of what stands still nominally: how far it must stay above the minimum, and at how many inputs it is looked at."""
_MOST = 2_000_000
"""Numbers of the matrices that are held at a time."""


class PlayedMechanism(PlanarMechanism):
    """A planar mechanism whose pins are off by their play.

    Parameters
        spec : PlanarSpec
        plays : by pin - by how much the hole of the second body is off that of the first, in the frame [mm]
    """

    def __init__(self, spec: Any, plays: Mapping[str, complex]) -> None:
        super().__init__(spec)
        self.plays = dict(plays)
        vars(self)["structure"] = Structure(spec, self.plays)


class _Hump(NamedTuple):
    """A local extreme of the nominal design: its place, or an end of the range, and its sense."""

    place: float
    sign: float
    end: bool = False


class PlanarSamples:
    """Samples of a nominal design; `core.studies.tolerance_study.problem.ToleranceAxis`.

    Parameters
        nominal : PlanarMechanism
    Raises
        NoSolution - key cams: a cam as made is not that of a follower as made
    """

    extra: tuple[str, ...] = ()
    reference: float | None = None
    samples = 16384

    def __init__(self, nominal: PlanarMechanism) -> None:
        if nominal.spec.cams:
            words = "`tolerance` samples no mechanism with cams: a sample would have another cam for its own follower"
            raise NoSolution(words, key="cams", fix="use `gearlink register`, which keeps the cam as it is")
        self.nominal = nominal
        self.parts = Parts({}, pins=tuple(pin.name for pin in nominal.structure.pins))

    def serves(self, keys: Sequence[str], names: Sequence[str]) -> bool:
        """Whether sizes, plays and extremes alone are asked for, of a mechanism without teeth and shafts."""
        spec = self.nominal.spec
        if spec.meshes or spec.shafts or not all(key.startswith(_PIN) or _SIZES.fullmatch(key) for key in keys):
            return False
        return all(self._served(name) for name in names) and not any(self._still(name) for name in names)

    def _served(self, name: str) -> bool:
        meaning = self.nominal.meanings.get(name)
        if meaning is None:
            return name in ("min_transmission_angle", "min_transmission_angle_at", "closure_error")
        return meaning.side in _SIDES

    def _still(self, name: str) -> bool:
        """Whether it is of something that turns through or stands still; of dyads only where all do."""
        if name in self.nominal.meanings:
            needed = self.nominal.needed(name)
            return not needed or not all(key in self._humps for key in needed)
        return name.startswith("min_transmission") and not self._humps.keys() & {*self.nominal.dyad_keys}

    def sets(self, key: str) -> bool:
        """Whether a source is the play of a pin."""
        return key.startswith(_PIN)

    def design(self, values: Mapping[str, Any], cut: Any = None) -> PlayedMechanism:
        """The design of one sample."""
        spec = (self.nominal if cut is None else cut).spec
        made = PlayedMechanism(spec, {key.removeprefix(_PIN): value for key, value in values.items()})
        made.advises = False
        return made

    # The nominal design

    @cached_property
    def _humps(self) -> dict[tuple[str, int], list[_Hump]]:
        """By number and order of its derivative, the extremes that count; what stands still is left out."""
        design, course = self.nominal, self.nominal.course
        keys = dict.fromkeys(key for name in design.own_names if self._served(name) for key in design.needed(name))
        keys |= dict.fromkeys(design.dyad_keys)
        orders: dict[str, list[int]] = {}
        for name, order in keys:
            orders.setdefault(name, []).append(order)
        moving = design.moving_numbers
        wanted = {name: Wanted(moving[name][0], of, moving[name][1]) for name, of in orders.items()}
        found = {}
        for key, places in humps(course, wanted, _NEAR).items():
            ends = [] if course.turns is not None else [course.start, course.end]
            found[key] = [_Hump(place, sign) for place, sign in places] + [_Hump(end, 0.0, end=True) for end in ends]
        return found

    @cached_property
    def _grid(self) -> list[tuple[float, Reals, Reals, float, float]]:
        """Places of the nominal design: input, unknowns, inverse of the matrix, its norm, and K."""
        course = self.nominal.course
        q = course.grid
        jets = course.jets(q, 1)
        y, scaled = joined(jets.x[0], jets.t[0]), course.walked(q)
        matrix = course.system.matrix(jets)
        inverse = np.linalg.inv(matrix)
        norms = 1.0 / np.linalg.svd(matrix, compute_uv=False)[:, -1]
        found = []
        for i in range(q.size):
            here = Jets([part[i : i + 1] for part in jets.x], [part[i : i + 1] for part in jets.t])
            found.append((float(scaled[i]), y[i], inverse[i], float(norms[i]), course.system.bounds(here)[0]))
        return found

    # Samples

    def evaluate(self, columns: Mapping[str, Reals | Points], names: Sequence[str]) -> Evaluated:
        """The designs as manufactured; what is not certain is left to the class."""
        parts = [self._part(some, names) for some in self._parts(columns)]
        if len(parts) == 1:
            return parts[0]
        unsure = [part.unsure for part in parts if part.unsure is not None]
        findings = [
            Findings(
                first.code,
                np.concatenate([part.findings[i].value for part in parts]),
                np.concatenate([part.findings[i].limit for part in parts]),
                np.concatenate([part.findings[i].fails for part in parts]),
                np.concatenate([part.findings[i].warns for part in parts]),
                first.unit,
            )
            for i, first in enumerate(parts[0].findings)
        ]
        return Evaluated(
            {name: np.concatenate([part.quantities[name] for part in parts]) for name in parts[0].quantities},
            findings, np.concatenate([part.refused for part in parts]), (), np.concatenate(unsure),
        )  # fmt: skip

    def _parts(self, columns: Mapping[str, Reals | Points]) -> list[dict[str, Any]]:
        count = len(next(iter(columns.values())))
        size = max(16, _MOST // self.nominal.course.system.unknowns**2)
        return [{key: values[at : at + size] for key, values in columns.items()} for at in range(0, count, size)]

    def _part(self, columns: Mapping[str, Any], names: Sequence[str]) -> Evaluated:
        many = _Many(self, columns)
        design, quantities = many.design, {}
        for name in sorted(names, key=lambda name: name == "closure_error"):  # that of all places that were sought
            found = many.value(name)
            unit = design.unit_for(design.spec, name)
            quantities[name] = np.degrees(found) if unit == "deg" else found
        findings = []
        if self._humps.keys() & {*self.nominal.dyad_keys}:
            value = np.degrees(many.transmission[0])
            judged = transmission_judged(value, design.spec.limits.transmission_angle)
            limit = np.full(many.count, design.spec.limits.transmission_angle)
            findings.append(Findings(TRANSMISSION_ANGLE.code, value, limit, judged.fails, judged.warns, "deg"))
        largest, no = design.structure.largest, np.zeros(many.count, dtype=bool)
        limit = np.full(many.count, 1e-9 * largest)
        findings.append(Findings(CLOSURE.code, many.gap, limit, many.gap > limit, no, "mm"))
        return Evaluated(quantities, findings, np.zeros(many.count, dtype=np.intp), (), many.unsure)

    def course(self, columns: Mapping[str, Reals | Points], input_angle: Reals) -> Reals:
        """By how much the first output, a link, is turned against the nominal design [rad]; (K, N), NaN if unsure."""
        course = self.nominal.course
        body = self.nominal.structure.numbers[self.nominal.spec.shown[0]]
        q, jets = course.walked(input_angle), course.jets(input_angle, 0)
        y = joined(jets.x[0], jets.t[0])
        rows = []
        for some in self._parts(columns):
            many = _Many(self, some)
            off = np.empty((q.size, many.count))
            for k in range(q.size):
                found, open_ones = many.closed(q[k], np.tile(y[k], (many.count, 1)))
                off[k] = np.where(many.unsure | open_ones, math.nan, found[:, 3 * body - 1] - y[k, 3 * body - 1])
            rows.append(off)
        return np.concatenate(rows, axis=1)


class _Many:
    """Some samples side by side.

    Parameters
        samples : PlanarSamples
        columns : sizes and plays, (N,) arrays
    """

    def __init__(self, samples: PlanarSamples, columns: Mapping[str, Any]) -> None:
        nominal = samples.nominal
        self.samples, self.count = samples, len(next(iter(columns.values())))
        plays = {key.removeprefix(_PIN): values for key, values in columns.items() if key.startswith(_PIN)}
        sizes = {key: values for key, values in columns.items() if not key.startswith(_PIN)}
        structure = Structure(nominal.spec, plays, sizes)
        self.design = PlanarMechanism(nominal.spec)
        vars(self.design)["structure"] = structure
        start = nominal.course.at_start
        rows = (*joint_rows(structure, start.slide_turns), *drive_rows(structure, start.exact_starts))
        self.system = System(len(structure.bodies), pins_of(structure), rows)
        vars(self.system)["blocks"] = nominal.course.system.blocks
        self.unsure: Mask = self._uncertain()
        q, first = samples._grid[0][:2]
        self.gap: Reals = self._gaps(self.closed(q, np.tile(first, (self.count, 1)))[0], np.full(self.count, q))

    def _uncertain(self) -> Mask:
        """Samples of which the theorem does not say that they run beside the nominal design."""
        nominal = self.samples.nominal.structure
        moved = [
            np.abs(mine - other) ** 2
            for body, points in nominal.bodies.items()
            for mine, other in zip(self.design.structure.bodies[body].values(), points.values(), strict=True)
        ]
        # each point is an element of as many joints as there are at most links
        change = np.sqrt(sum(moved) * 2.0 * len(nominal.bodies) + np.zeros(self.count)) / nominal.size
        uncertain = np.zeros(self.count, dtype=bool)
        for q, y, inverse, beta, k in self.samples._grid:
            gaps = self.system.values(Jets.of(np.broadcast_to(y, (self.count, y.size))), 0, np.full(self.count, q))
            eta, share = np.linalg.norm(gaps @ inverse.T, axis=1), beta * change
            with np.errstate(divide="ignore"):
                h = beta * k * (1.0 + change) * eta / (1.0 - share) ** 2
            uncertain |= (share >= 0.5) | ~(h < _CERTAIN)
        return uncertain

    def closed(self, q: Any, near: Reals) -> tuple[Reals, Mask]:
        """Unknowns at inputs from approximate ones, and which do not come to rest."""
        y, inputs = near.copy(), np.broadcast_to(np.asarray(q, dtype=float), (self.count,))
        far: Mask = np.ones(self.count, dtype=bool)
        for _ in range(_CLOSING):
            with np.errstate(all="ignore"):
                step = self.system.step(Jets.of(y), inputs)
            y = y + np.where(np.isfinite(step), step, 0.0)
            far = ~(np.abs(step).max(axis=1) < 1e-9)
            if not (np.abs(step).max(axis=1) > _REST * 100.0)[~self.unsure].any():
                break
        return y, far

    def _gaps(self, y: Reals, q: Reals) -> Reals:
        """By how much the joints are open [mm]."""
        return np.asarray(np.abs(self.system.values(Jets.of(y), 0, q)).max(axis=1) * self.design.structure.size)

    @cached_property
    def _numbers(self) -> dict[str, Coefficient]:
        found = {each.output.name: each.output.coefficient for each in self.design.meanings.values()}
        return found | {f"dyad {i}": dyad.angle for i, dyad in enumerate(self._dyads)}

    @cached_property
    def _dyads(self) -> list[Dyad]:
        return dyads(self.design.structure, self.system)

    @cached_property
    def _found(self) -> dict[tuple[str, int, _Hump], tuple[Reals, Reals]]:
        return {}

    def _extreme(self, key: tuple[str, int], hump: _Hump) -> tuple[Reals, Reals]:
        """Values at a local extreme, and its places."""
        if (*key, hump) not in self._found:
            self._found[(*key, hump)] = self._sought(key, hump)
        return self._found[(*key, hump)]

    def _sought(self, key: tuple[str, int], hump: _Hump) -> tuple[Reals, Reals]:
        course, (name, order) = self.samples.nominal.course, key
        jets = course.jets(np.array([hump.place]), 0)
        first = joined(jets.x[0], jets.t[0])[0]
        q, y = np.full(self.count, float(course.walked(np.array([hump.place]))[0])), np.tile(first, (self.count, 1))
        of, start, far = self._numbers[name], q.copy(), ~self.unsure
        for _ in range(1 if hump.end else _STEPS):
            y, open_ones = self.closed(q, y)
            if hump.end:
                far = open_ones
                break
            here = self.system.onward(Jets.of(y), q, order + 2)
            slope, bend = (of(here, order + k) * math.factorial(order + k) for k in (1, 2))
            with np.errstate(all="ignore"):
                step = -slope / bend
            step = np.where(np.isfinite(step), np.clip(step, -0.1, 0.1), 0.0)
            q = q + step
            y = y + joined(here.x[1], here.t[1]) * step[:, None]
            far = open_ones | (np.abs(q - start) > _FAR) | (np.abs(step) > 1e-7) | (hump.sign * bend >= 0.0)
            if not ((np.abs(step) > 1e-11) & ~self.unsure).any():
                break
        y, open_ones = self.closed(q, y)
        here = self.system.onward(Jets.of(y), q, order)
        self.gap = np.maximum(self.gap, self._gaps(y, q))
        self.unsure = self.unsure | far | open_ones
        return course.derivatives(of, here, order)[order], course.unwalked(q)

    def extreme(self, key: tuple[str, int], sign: float) -> tuple[Reals, Reals]:
        """Maximum (sign 1) or minimum values, and their places in the period or range."""
        course = self.samples.nominal.course
        found = [self._extreme(key, hump) for hump in self.samples._humps[key] if hump.sign in (sign, 0.0)]
        values, places = (np.array([each[k] for each in found]) for k in (0, 1))
        if course.turns is not None:
            places = np.mod(places, course.end)
            places = np.where(course.end - places < 1e-9 * course.end, 0.0, places)
        top = np.max(sign * values, axis=0)
        size = np.max(np.abs(values), axis=0)
        places = np.where(sign * values >= top - 1e-10 * size, places, math.inf)
        return sign * top, places.min(axis=0)

    @property
    def _standing(self) -> Reals:
        """Minimum angle at some inputs of dyads whose angle stands still in the nominal design; inf without any, NaN
        where the sample does not close."""
        samples, least = self.samples, np.full(self.count, math.inf)
        course = samples.nominal.course
        still = [key for key in samples.nominal.dyad_keys if key not in samples._humps]
        q = np.linspace(course.start, course.end, _LOOKS) if still else np.zeros(0)
        jets = course.jets(q, 0) if still else None
        for k in range(q.size):
            assert jets is not None
            near = joined(jets.x[0][k : k + 1], jets.t[0][k : k + 1])
            y, open_ones = self.closed(float(course.walked(q)[k]), np.tile(near, (self.count, 1)))
            angles = [folded(self._numbers[name](Jets.of(y), 0)) for name, _ in still]
            least = np.where(open_ones, math.nan, np.minimum(least, np.min(angles, axis=0)))
        return least

    @cached_property
    def transmission(self) -> tuple[Reals, Reals]:
        """Minimum transmission angles [rad] and their inputs."""
        keys = [key for key in self.samples.nominal.dyad_keys if key in self.samples._humps]
        ends = [self.extreme(key, sign) for key in keys for sign in (1.0, -1.0)]
        angles, places = np.array([folded(angle) for angle, _ in ends]), np.array([place for _, place in ends])
        least = angles.min(axis=0)
        self.unsure = self.unsure | ~(self._standing > least + _APART)
        return least, np.where(angles <= least + 1e-10, places, math.inf).min(axis=0)

    def value(self, name: str) -> Reals:
        """A quantity [rad, mm]."""
        if name == "closure_error":
            return self.gap
        if name.startswith("min_transmission_angle"):
            return self.transmission[1 if name.endswith("_at") else 0]
        meaning = self.design.meanings[name]
        key = meaning.output.name, meaning.order
        if meaning.side == "span":
            return self.extreme(key, 1.0)[0] - self.extreme(key, -1.0)[0]
        value, place = self.extreme(key, 1.0 if meaning.side.startswith("max") else -1.0)
        if meaning.side.endswith("_at"):
            return place
        return value * (self.design.angular_speed or 0.0) ** meaning.order if meaning.timed else value
