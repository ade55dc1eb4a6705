"""Designs as manufactured of a planar mechanism: many at once next to the nominal one, or one by one.

Where the nominal mechanism stands, Newton and Kantorovich's theorem says of each sample that one of its own positions
lies beside it: with eta the first step, h = beta K eta below 1/4 at all places of the grid, the sample runs through the
period in the assembly of the nominal design. What does not pass is left to the class. Extremes are sought from those of
the nominal design on.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Container, Iterator, Mapping, Sequence
from functools import cached_property, reduce
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.design_axis import Evaluated, Findings
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Check
from gearlink.core.base.results import keep
from gearlink.core.base.spec_paths import value_at
from gearlink.core.machines.planar.course import AsMade, Course, Start
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.dyads import dyads, folded
from gearlink.core.machines.planar.extremes import Coefficient, Wanted, humps
from gearlink.core.machines.planar.gaps import (
    Axis,
    Tops,
    axes_that_may_meet,
    carrier,
    name_of,
    placed,
    squared_distance,
)
from gearlink.core.machines.planar.structure import GearJoint, Line, RackJoint, Structure
from gearlink.core.machines.planar.system import Jets, System, drive_rows, joined, joint_rows, meshes_at_rest, split
from gearlink.core.numerics.arrays import Mask, Points, Reals, distinct
from gearlink.core.parts.linkages.checks import transmission_judged
from gearlink.core.parts.linkages.codes import CLOSURE, SHAFT_CLEARANCE, TRANSMISSION_ANGLE
from gearlink.core.studies.clearance import Gear, Shaft, collision_judged, gaps, seats, shaft_judged
from gearlink.core.studies.tolerance.sources import Parts

_PIN = "pins."
_SIZES = re.compile(
    r"(frame|links)\.\w+(\.\w+\[[01]\]|\[[012]\])|(slides|slots)\.\w+\.(through\[[01]\]|direction|angle)"
    r"|meshes\.\w+\.(direction|module|pressure_angle)"
)
_OF_CAMS = re.compile(r"cams\.(\w+)\.(profile|roller_radius|phase|face)")
_OF_POINTS = re.compile(r"(?:links\.)?(\w+)\.(\w+)\[[01]\]")
_SIDES = ("max", "max_at", "min", "min_at", "span")
_CERTAIN = 0.25
"""Of h, below the 1/2 of the theorem: for the way between two places of the grid."""
_STAGES = (2, 6)
"""Designs between the nominal one and a sample that are tried where the theorem does not say it at once."""
_STILL = 1e-10  # of the largest slope: rounding of a dwell
_LEVEL = 0.02  # of the largest slope: what an extreme at a joint may rise or fall beyond it, in samples
_NEAR = 0.1
"""Of the range of a course: local extremes that may become the extreme of a sample."""
_FAR = 0.15
"""Of the input in rad, or of the size: how far an extreme may move from that of the nominal design."""
_STEPS, _CLOSING = 24, 6
_SECANT = 1e-4  # of the input: first step of a secant
_BESIDE = 1e-4  # of the input, from joints
_REST = 1e-13
_APART, _LOOKS = math.radians(1.0), 25
"""Of what stands still nominally: how far it must stay above the minimum, and at how many inputs it is looked at."""
_SWING = 0.01
"""Of the size: what the square of a distance moves by at least, in its units, for extremes beside the nominal ones."""
_LEAST_LOOKS, _ROUNDS, _LEVEL_GAP = 60, 4, 1e-11
"""Inputs over a period at which other distances are looked at, steps by the nominal inverse at each, and the share of
the size by which the square of one that stands still may move."""
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
        keep(self, structure=Structure(spec, self.plays))

    def cut_for(self, nominal: PlanarMechanism, profiles: Mapping[str, float]) -> None:
        """Take the cams of the nominal design, with the errors of their profiles [mm] by cam."""
        errors = {
            name: {
                "profile": profiles.get(name, 0.0),
                "roller_radius": (own.roller_radius or 0.0) - (given.roller_radius or 0.0),
                "phase": math.radians(own.phase - given.phase),
                "face": math.radians((own.face or 0.0) - (given.face or 0.0)),
            }
            for (name, given), own in zip(nominal.spec.cams.items(), self.spec.cams.values(), strict=True)
        }
        keep(self.structure, cams=nominal.structure.cams)
        course = Course(self.structure)
        keep(course, at_start=AsMade(self.structure, nominal.course.at_start, errors))
        keep(course, dyads=dyads(self.structure, nominal.course.system))
        keep(self, course=course)


class _Hump(NamedTuple):
    """A local extreme of the nominal design: its place, or an end of the range, and its sense.

    Fields
        cam, joint : of what lies where the law of a cam changes - the cam, and its angle there, of any revolution [rad]
        side : +1 or -1 - just after it or before
    """

    place: float
    sign: float
    end: bool = False
    cam: str = ""
    joint: float = 0.0
    side: int = 1


class _There(NamedTuple):
    """A place of the nominal design.

    Fields
        q, y : input and unknowns
        inverse, norm : of the matrix, and of its inverse
        bend : K
    """

    q: float
    y: Reals
    inverse: Reals
    norm: float
    bend: float

    def leaves(self, system: System, change: Reals, count: int) -> Mask:
        """Mechanisms of which the theorem does not say that one of their positions lies here.

        Parameters
            change : (count,) array - by how much their matrices may differ
        """
        gaps = system.values(Jets.of(np.broadcast_to(self.y, (count, self.y.size))), 0, np.full(count, self.q))
        eta, share = np.linalg.norm(gaps @ self.inverse.T, axis=1), self.norm * change
        with np.errstate(divide="ignore"):
            h = self.norm * self.bend * (1.0 + change) * eta / (1.0 - share) ** 2
        return np.asarray((share >= 0.5) | ~(h < _CERTAIN))


def _places(system: System, q: Reals, jets: Jets) -> Iterator[_There]:
    """The places of a motion at inputs, from its first derivatives."""
    y, matrix = joined(jets.x[0], jets.t[0]), system.matrix(jets)
    inverse, sizes = np.linalg.inv(matrix), np.linalg.svd(matrix, compute_uv=False)
    for i in range(q.size):
        here = Jets([part[i : i + 1] for part in jets.x], [part[i : i + 1] for part in jets.t])
        yield _There(float(q[i]), y[i], inverse[i], 1.0 / float(sizes[i, -1]), system.bounds(here)[0])


def _lines(structure: Structure) -> list[Line]:
    """Lines of slides, slots and racks."""
    racks = [mesh.line for mesh in structure.meshes.values() if isinstance(mesh, RackJoint)]
    return [*(each.line for group in (structure.slides, structure.slots) for each in group.values()), *racks]


def _radii(mesh: GearJoint | RackJoint) -> tuple[float, ...]:
    return (mesh.radius,) if isinstance(mesh, RackJoint) else mesh.radii


class PlanarSamples:
    """Samples of a nominal design; `core.studies.tolerance_study.problem.ToleranceAxis`.

    Notes
        The cams are those of the nominal design: their profiles, with an error of their own, under followers as made.
    """

    extra: tuple[str, ...] = ()
    reference: float | None = None
    course_units: tuple[str, ...] = ("deg", "mm")

    @property
    def samples(self) -> int:
        """Samples by default; with cams, whose law each takes several times, fewer."""
        return 4096 if self.nominal.spec.cams else 16384

    def __init__(self, nominal: PlanarMechanism) -> None:
        self.nominal = nominal
        pins = tuple(pin.name for pin in nominal.structure.pins)
        self.parts = Parts({}, pins=pins, others={f"cams.{name}.profile": 0.0 for name in nominal.spec.cams})

    def serves(self, keys: Sequence[str], names: Sequence[str]) -> bool:
        """Whether sizes, plays and extremes alone are asked for, and each gap of gears and shafts is found."""
        for key in keys:
            if key.startswith("cams.") and not _OF_CAMS.fullmatch(key):
                what = f"{key} is not a size of a part: the profile is cut by the law of the file"
                raise NoSolution(what, key="tolerance.sources", fix="name cams.NAME.profile, roller_radius or phase")
        if not all(self._is_size(key) for key in keys) or not self._has_gaps(keys):
            return False
        return all(self._served(name) for name in names) and not any(self._still(name) for name in names)

    def _has_gaps(self, keys: Sequence[str]) -> bool:
        """Whether distances of axes are found: not those of points of one place that may part, nor what nearly stands
        still over a range or with cams."""
        if not self._axes:
            return True
        of_points = (match.groups() for key in keys if (match := _OF_POINTS.fullmatch(key)))
        for points, point in ((self.nominal.spec.bodies.get(body, {}), point) for body, point in of_points):
            if sum(at == points.get(point) for at in points.values()) > 1:
                return False
        periodic = self.nominal.course.turns is not None and not self.nominal.spec.cams
        return periodic or not self.nearly_still({key.removeprefix(_PIN) for key in keys if key.startswith(_PIN)})

    def nearly_still(self, played: Container[str]) -> list[str]:
        """Distances of axes that no body holds and that move too little in the nominal design for extremes there.

        Parameters
            played : names of pins with play
        """
        return [
            name for name, axes in self._axes.items()
            if (name, 0) not in self._humps and carrier(self.nominal.structure, *axes, played) is None
        ]  # fmt: skip

    def _is_size(self, key: str) -> bool:
        """Whether an array form has it; a cam off its shaft makes no dwell."""
        if any(key.startswith(f"links.{cam.cam}.") for cam in self.nominal.spec.cams.values()):
            return False
        return key.startswith(_PIN) or bool(_SIZES.fullmatch(key) or _OF_CAMS.fullmatch(key))

    def _served(self, name: str) -> bool:
        meaning = self.nominal.meanings.get(name)
        if self.nominal.spec.cams and (name.endswith("_at") or (meaning is not None and meaning.order > 2)):
            return False  # of a dwell there is no one place, and laws have no fourth derivative
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
        """Whether a source is the play of a pin, or the profile of a cam."""
        return key.startswith(_PIN) or key in self.parts.others

    def design(self, values: Mapping[str, Any], cut: Any = None) -> PlayedMechanism:
        """The design of one sample."""
        spec = (self.nominal if cut is None else cut).spec
        plays = {key.removeprefix(_PIN): value for key, value in values.items() if key.startswith(_PIN)}
        made = PlayedMechanism(spec, plays)
        made.advises = False
        if spec.cams:
            made.cut_for(self.nominal, {name: values.get(f"cams.{name}.profile", 0.0) for name in spec.cams})
        return made

    # The nominal design

    @cached_property
    def _humps(self) -> dict[tuple[str, int], list[_Hump]]:
        """By number and order of its derivative, the extremes that count; what stands still is left out."""
        design, course = self.nominal, self.nominal.course
        keys = dict.fromkeys(key for name in design.own_names if self._served(name) for key in design.needed(name))
        wanted = design.wanted([*keys, *design.dyad_keys])
        wanted |= {name: Wanted(of, [0], unit) for name, (of, unit) in self._distances.items()}
        if design.spec.cams:
            return self._beside_joints(wanted)
        found = {}
        for key, places in humps(course, wanted, _NEAR).items():
            ends = [] if course.turns is not None else [course.start, course.end]
            found[key] = [_Hump(place, sign) for place, sign in places] + [_Hump(end, 0.0, end=True) for end in ends]
        return found

    @cached_property
    def _axes(self) -> Mapping[str, tuple[Axis, Axis]]:
        return axes_that_may_meet(self.nominal.structure)

    @cached_property
    def _distances(self) -> dict[str, tuple[Coefficient, str]]:
        """By name the squares of distances of axes that move, and their unit."""
        course, structure, found = self.nominal.course, self.nominal.structure, {}
        jets = course.jets(course.grid, 0)
        for name, axes in self._axes.items():
            if carrier(structure, *axes, ()) is None:
                number = squared_distance(structure, *axes)
                if float(np.ptp(number(jets, 0))) > _SWING * structure.size:
                    found[name] = number, "mm"
        return found

    @cached_property
    def system(self) -> System:
        """The equations of the nominal design as those of its samples."""
        nominal = self.nominal
        if not nominal.spec.cams:
            return nominal.course.system
        return AsMade(nominal.structure, nominal.course.at_start, {}).running

    def _beside_joints(self, wanted: Mapping[str, Wanted]) -> dict[tuple[str, int], list[_Hump]]:
        """The same of a mechanism with cams: what is largest where a law changes, and where the next derivative is 0
        between these places."""
        course, joints = self.nominal.course, self._joints
        highest = max(max(each.orders) for each in wanted.values()) + 1
        beside = np.array([joint.place for joint in joints])[:, None] + _BESIDE * np.array([-1.0, 1.0])
        q = distinct(np.concatenate([course.grid, beside[(beside > course.start) & (beside < course.end)]]))
        jets = course.jets(q, 0)
        walked = course.walked(q)
        after, before = (self.system.onward(Jets(jets.x, jets.t, side=side), walked, highest) for side in (1, -1))
        found = {}
        for name, (of, orders, unit) in wanted.items():
            right, left = (course.derivatives(of, each, max(orders) + 1) for each in (after, before))
            for order in orders:
                value = np.concatenate([right[order], left[order]])
                span = float(np.ptp(value))
                if span > 1e-11 * max(float(np.abs(value).max()), course.floor(unit, order)):
                    sides = right[order], left[order], right[order + 1], left[order + 1]
                    found[name, order] = list(_tops(q, sides, span, joints, period=course.turns is not None))
        return found

    @cached_property
    def steepness(self) -> float:
        """By how much more a point that is off changes the matrix where it lies on a cam, whose normal turns there."""
        nominal = self.nominal.structure
        bends = [cam.steepest if cam.given.face is None else 1.0 / nominal.size for cam in nominal.cams.values()]
        return 1.0 + 6.0 * nominal.size * max(bends, default=0.0) if bends else 1.0

    @cached_property
    def _joints(self) -> list[_Hump]:
        """Where the laws of the cams change, over the period or range."""
        course = self.nominal.course
        places = np.array([course.start, *course.joints])
        jets, found = course.jets(places, 0), []
        for name, cam in self.nominal.structure.cams.items():
            on = cam.upon_joints(course.at_start.lifts[name].angle(jets, 0), within=1e-9)
            off = np.mod(on[:, None] - np.array([*cam.motion.joints]) + 1.0, 2.0 * math.pi) - 1.0
            there = np.abs(off).min(axis=1) < 1e-12
            found += [_Hump(place, 0.0, cam=name, joint=angle)
                      for place, angle in zip(places[there].tolist(), on[there].tolist(), strict=True)]  # fmt: skip
        return found

    @cached_property
    def _grid(self) -> list[_There]:
        """Places of the nominal design."""
        course = self.nominal.course
        return [*_places(self.system, course.walked(course.grid), course.jets(course.grid, 1))]

    @cached_property
    def looks(self) -> list[_There]:
        """Even places of the nominal design over its period."""
        course = self.nominal.course
        count = max(_LEAST_LOOKS, course.samples // 4)
        q = np.linspace(course.start, course.end, count, endpoint=False)
        return [*_places(self.system, course.walked(q), course.jets(q, 1))]

    @cached_property
    def _at_start(self) -> _There:
        """The start of the nominal design with its exact start values instead of meshes."""
        start = self.nominal.course.at_start
        x, t = start.closed[0][None], start.closed[1][None]
        system = self._starting(self.nominal.structure)
        return next(_places(system, np.zeros(1), Jets([x, np.zeros_like(x)], [t, np.zeros_like(t)])))

    @cached_property
    def _reaches(self) -> list[float]:
        """By line, how far its point is at most from the origin of the line's body, over the grid [size]."""
        nominal = self.nominal.structure
        jets = self.nominal.course.jets(self.nominal.course.grid, 0)
        apart = (jets.point(each.other, each.point / nominal.size, 0) - jets.x[0][:, each.body]
                 for each in _lines(nominal))  # fmt: skip
        return [float(np.abs(each).max()) for each in apart]

    # Samples

    def made(self, columns: Mapping[str, Any]) -> tuple[Structure, System]:
        """Structure and equations of samples, of which each number is a (N,) array."""
        nominal, start = self.nominal, self.nominal.course.at_start
        plays = {key.removeprefix(_PIN): values for key, values in columns.items() if key.startswith(_PIN)}
        sizes = {key: values for key, values in columns.items() if not key.startswith(_PIN)}
        structure = Structure(nominal.spec, plays, sizes)
        if nominal.spec.cams:
            keep(structure, cams=nominal.structure.cams)
            system = AsMade(structure, start, _errors_of_cams(nominal, columns)).running
        else:
            rows = [*joint_rows(structure, start.slide_turns), *drive_rows(structure, start.exact_starts)]
            if structure.meshes:
                rows += meshes_at_rest(structure, self._closed_at_start(structure))
            system = System.of(structure, rows)
        keep(system, blocks=self.system.blocks)
        return structure, system

    def _starting(self, structure: Structure) -> System:
        """The equations at input 0, with exact start values instead of meshes."""
        start = self.nominal.course.at_start
        rows = [*joint_rows(structure, start.slide_turns), *drive_rows(structure, start.exact_starts)]
        system = System.of(structure, [*rows, *Start(structure).mesh_rows()])
        keep(system, blocks=start.system.blocks)
        return system

    def _closed_at_start(self, structure: Structure) -> Jets:
        """Samples at input 0, NaN where the theorem does not say that they stand beside the nominal design."""
        system, there = self._starting(structure), self._at_start
        uncertain = there.leaves(system, self.change(structure) + np.zeros(structure.count), structure.count)
        y, _open = rested(system, 0.0, np.tile(there.y, (structure.count, 1)), ~uncertain)
        return Jets.of(np.where(uncertain[:, None], math.nan, y))

    def change(self, structure: Structure) -> Reals:
        """By how much the matrices of samples may differ from the nominal one at the same place; (N,), NaN where
        gears do not mesh."""
        return self._change_of_points(structure) + np.sqrt(self._change_of_lines(structure))

    def _change_of_points(self, structure: Structure) -> Reals:
        nominal = self.nominal.structure
        moved = [
            np.abs(mine - other) ** 2
            for body, points in nominal.bodies.items()
            for mine, other in zip(structure.bodies[body].values(), points.values(), strict=True)
        ]
        # each point is an element of as many joints as there are at most links
        return np.asarray(np.sqrt(sum(moved) * 2.0 * len(nominal.bodies)) / nominal.size * self.steepness)

    def _change_of_lines(self, structure: Structure) -> Reals:
        """Squares of what lines that lie otherwise, and meshes of other radii, change.

        Notes
            A row along or across a line has 1, 1, the distance of the point from the origin of its own body, and 1, 1,
            that from the origin of the line's body, all turned with the line.
        """
        nominal, size, total = self.nominal.structure, self.nominal.structure.size, np.zeros(structure.count)
        for line, given, most in zip(_lines(structure), _lines(nominal), self._reaches, strict=True):
            arm, reach = np.abs(line.point) / size, most + np.abs(line.point - given.point) / size
            total += (line.direction - given.direction) ** 2 * (2.0 + arm**2 + reach**2)
        for mesh, own in zip(nominal.meshes.values(), structure.meshes.values(), strict=True):
            # the element of a carrier is the sum of those of its gears
            total += sum(3.0 * ((r - given) / size) ** 2 for r, given in zip(_radii(own), _radii(mesh), strict=True))
            total = np.where(np.isnan(own.tangent), math.nan, total)
        return total

    def run_beside(self, columns: Mapping[str, Any], stages: int) -> Mask:
        """Samples of which the theorem says so by way of designs between the nominal one and them.

        Notes
            Each stage is tested at the solution of the one before, with the matrix of its own design there.
        """
        count = len(next(iter(columns.values())))
        between = [self.made(self._between(columns, k / stages)) for k in range(1, stages + 1)]
        sure, inputs = np.ones(count, dtype=bool), np.empty(count)
        changes = [self.change(structure) for structure, _ in between]
        for there in self._grid:
            inputs[:], y = there.q, np.tile(there.y, (count, 1))
            for change, (_, system) in zip(changes, between, strict=True):
                jets = Jets.of(y)
                inverse = _inverse(system.matrix(jets))
                step = -(inverse @ system.values(jets, 0, inputs)[..., None])[..., 0]
                beta, eta = np.linalg.norm(inverse, axis=(1, 2)), np.linalg.norm(step, axis=1)
                sure &= beta * there.bend * (1.0 + change) * eta < _CERTAIN
                y = y + step
                y = y - (inverse @ system.values(Jets.of(y), 0, inputs)[..., None])[..., 0]
            if not sure.any():
                break
        return sure

    def _between(self, columns: Mapping[str, Any], share: float) -> dict[str, Any]:
        """Samples that are off the nominal design by a share of what these are."""
        found = {}
        for key, values in columns.items():
            nominal = 0.0 if self.sets(key) else value_at(self.nominal.spec, key) or 0.0
            found[key] = nominal + share * (values - nominal)
        return found

    def evaluate(self, columns: Mapping[str, Reals | Points], names: Sequence[str]) -> Evaluated:
        """The designs as manufactured; what is not certain is left to the class."""
        parts = [self._part(some, names) for some in self._parts(columns)]
        unsure = [part.unsure for part in parts if part.unsure is not None]

        def whole(i: int, name: str) -> Any:
            return np.concatenate([getattr(part.findings[i], name) for part in parts])

        findings = [
            Findings(first.code, whole(i, "value"), whole(i, "limit"), whole(i, "fails"), whole(i, "warns"), first.unit)
            for i, first in enumerate(parts[0].findings)
        ]
        return Evaluated(
            {name: np.concatenate([part.quantities[name] for part in parts]) for name in parts[0].quantities},
            [finding for finding in findings if not np.isnan(finding.value).all()],
            np.concatenate([part.refused for part in parts]), (), np.concatenate(unsure),
        )  # fmt: skip

    def _parts(self, columns: Mapping[str, Reals | Points]) -> list[dict[str, Any]]:
        count = len(next(iter(columns.values())))
        size = max(16, _MOST // self.nominal.course.system.unknowns**2)
        return [{key: values[at : at + size] for key, values in columns.items()} for at in range(0, count, size)]

    def _part(self, columns: Mapping[str, Any], names: Sequence[str]) -> Evaluated:
        many = _Many(self, columns)
        design, quantities, findings = many.design, {}, [*many.judged_gaps]
        for name in sorted(names, key=lambda name: name == "closure_error"):  # that of all places that were sought
            found = many.value(name)
            unit = design.unit_of(name)
            quantities[name] = np.degrees(found) if unit == "deg" else found
        if self._humps.keys() & {*self.nominal.dyad_keys}:
            value = np.degrees(many.transmission[0])
            judged = transmission_judged(value, design.spec.limits.transmission_angle)
            limit = np.full(many.count, design.spec.limits.transmission_angle)
            findings.append(Findings(TRANSMISSION_ANGLE.code, value, limit, judged.fails, judged.warns, "deg"))
        largest, no = design.structure.largest, np.zeros(many.count, dtype=bool)
        limit = np.full(many.count, 1e-9 * largest)
        findings.append(Findings(CLOSURE.code, many.gap, limit, many.gap > limit, no, "mm"))
        findings += [Findings.alike(check, many.count) for check in self._unchanged]
        return Evaluated(quantities, findings, np.zeros(many.count, dtype=np.intp), (), many.unsure)

    @cached_property
    def _unchanged(self) -> list[Check]:
        """Findings of the cams as cut, which no sample changes."""
        if not self.nominal.spec.cams:
            return []
        names = ("pressure-angle", "cam-undercut", "acceleration-step")
        found = [check for name in names for check in self.nominal.check(name)]
        return [*(check for cam in self.nominal.structure.cams.values() for check in cam.check_shaft()), *found]

    def course(self, columns: Mapping[str, Reals | Points], input_angle: Reals) -> Reals:
        """By how much the first output, a link or a slide, is off that of the nominal design [rad or mm]; (K, N), NaN
        if unsure."""
        course, name = self.nominal.course, self.nominal.spec.shown[0]
        inputs = np.degrees(input_angle) if course.by_slide else input_angle  # of a slide mm, taken for deg
        q, jets = course.walked(inputs), course.jets(inputs, 0)
        y, nominal = joined(jets.x[0], jets.t[0]), self.nominal.moving_numbers[name][0](jets, 0)
        rows = []
        for some in self._parts(columns):
            many = _Many(self, some)
            off = np.empty((q.size, many.count))
            for k in range(q.size):
                found, open_ones = many.closed(q[k], np.tile(y[k], (many.count, 1)))
                value = many.numbers[name](Jets.of(found), 0)
                off[k] = np.where(many.unsure | open_ones, math.nan, value - nominal[k])
            rows.append(off)
        return np.concatenate(rows, axis=1)


class _AngleOfFace(NamedTuple):
    """The cam angle under a flat face, from the direction of the face."""

    lift: Any

    def angle(self, jets: Jets, k: int) -> Reals:
        """Its Taylor coefficient, k up to 1 [rad]."""
        chi, support = self.lift.angle(jets, 0), self.lift.motion
        phi = support.angles(chi)
        if k == 0:
            return np.asarray(phi)
        return np.asarray(self.lift.angle(jets, 1) / support.faces(phi, 1, 1)[0][1])


def _errors_of_cams(nominal: PlanarMechanism, columns: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """By cam, by how much samples are off [mm, rad]."""
    found: dict[str, dict[str, Any]] = {name: {} for name in nominal.spec.cams}
    for key, values in columns.items():
        if match := _OF_CAMS.fullmatch(key):
            name, what = match.groups()
            given = getattr(nominal.spec.cams[name], what, 0.0) or 0.0
            found[name][what] = (values - given) * (math.pi / 180.0 if what in ("phase", "face") else 1.0)
    return found


def _bends(q: Reals, slopes: Sequence[Reals], i: int) -> bool:
    """Whether slopes that are 0 at a joint of a grid grow linearly to both sides: an extreme that may leave it."""
    if not 2 <= i < q.size - 2:
        return False
    ends = [abs(slopes[way > 0][i + k * way] / (q[i + k * way] - q[i])) for way in (-1, 1) for k in (1, 2)]
    return bool(ends[0] > 0.1 * ends[1] > 0.0 and ends[2] > 0.1 * ends[3] > 0.0)


def _tops(
    q: Reals, sides: tuple[Reals, Reals, Reals, Reals], span: float, joints: Sequence[_Hump], *, period: bool
) -> Iterator[_Hump]:
    """Local extremes near the largest and the smallest value, at joints and between the places of a grid.

    Parameters
        sides : values after and before each place, slopes after and before
    """
    after, before, *slopes = sides
    least = _STILL * max(float(np.abs(each).max()) for each in slopes)
    slope_after, slope_before = (np.where(np.abs(each) <= least, 0.0, each) for each in slopes)
    for sign in (1.0, -1.0):
        top = max(float((sign * each).max()) for each in (after, before)) - _NEAR * span
        flat = _LEVEL * max(float(np.abs(each).max()) for each in slopes)
        for joint in joints:
            i = int(np.argmin(np.abs(q - joint.place)))
            k = i if i or not period else -1
            falls, rises = sign * slope_after[i] <= flat, sign * slope_before[k] >= -flat
            if abs(after[i] - before[k]) <= _STILL * span:
                sides_of = [(after[i], 1)] if falls and rises else []
            else:
                sides_of = [(after[i], 1)] * bool(falls) + [(before[k], -1)] * bool(rises)
            yield from (joint._replace(sign=sign, side=side) for value, side in sides_of if sign * value >= top)
        if not period:
            yield from (_Hump(place, sign, end=True) for place in (float(q[0]), float(q[-1])))
        rise, fall = sign * slope_after[:-1], sign * slope_before[1:]
        room = np.diff(q) * np.maximum(np.abs(rise), np.abs(fall))
        near = np.maximum(sign * after[:-1], sign * before[1:]) + room >= top
        upon = np.append((fall[:-1] == 0.0) & (rise[1:] == 0.0) & (fall[1:] < 0.0), [False])  # on a place of the grid
        places = np.array([joint.place for joint in joints])
        for k in np.flatnonzero(upon).tolist():
            upon[k] = np.abs(q[k + 1] - places).min() > 1e-9 or _bends(q, slopes, k + 1)
        for i in np.flatnonzero((rise > 0.0) & ((fall < 0.0) | upon) & near).tolist():
            share = float(rise[i] / (rise[i] - fall[i]))
            yield _Hump(float(q[i] + share * (q[i + 1] - q[i])), sign)


class _ToJoint:
    """To where the cam angle is that of a joint of the law.

    `order` of the motions that a step needs; `rest` below which the last steps stay: what ends them, what is enough
    """

    order, rest, misses = 1, (1e-12, 1e-9), False

    def __init__(self, row: Any, joint: float) -> None:
        self.row, self.joint = row, joint

    def step(self, _q: Reals, here: Jets) -> Reals:
        """Newton's step."""
        off = np.mod(self.row.angle(here, 0) - self.joint + math.pi, 2.0 * math.pi) - math.pi
        return np.asarray(-off / self.row.angle(here, 1))


class _BySlope:
    """To where the derivative after that of a coordinate is 0, of which an extreme has a bend of its sense.

    Parameters
        derivative : function of jets and an order, by the input of the equations
        order : int - of the highest derivative that a step needs
        sign : +1 a maximum, -1 a minimum
    """

    above, rest = 2, (1e-11, 1e-7)

    def __init__(self, derivative: Callable[[Jets, int], Reals], order: int, sign: float) -> None:
        self.derivative, self.order, self.sign, self.bend = derivative, order, sign, np.zeros(0)

    @property
    def misses(self) -> Mask:
        """Whether no extreme of that sense is near."""
        return np.asarray(self.sign * self.bend >= 0.0)

    def step(self, _q: Reals, here: Jets) -> Reals:
        """Newton's step."""
        self.bend = self.derivative(here, self.order)
        return np.asarray(-self.derivative(here, self.order - 1) / self.bend)


class _BySecants(_BySlope):
    """The same from that derivative alone."""

    above, rest = 1, (1e-8, 1e-7)
    last: tuple[Reals, Reals] | None = None

    def step(self, q: Reals, here: Jets) -> Reals:
        """The step of the secant through the last two places; the first is small."""
        slope, last = self.derivative(here, self.order), self.last
        self.last = q, slope
        if last is None:
            self.bend = np.zeros_like(slope)
            return np.full_like(q, _SECANT)
        apart = q - last[0]
        self.bend = np.where(np.abs(apart) > 1e-9, (slope - last[1]) / apart, self.bend)
        step: Reals = -slope / self.bend
        return step


def _inverse(matrices: Reals) -> Reals:
    """Inverses, NaN of what has none."""
    try:
        return np.asarray(np.linalg.inv(matrices), dtype=np.float64)
    except np.linalg.LinAlgError:
        whole = np.linalg.det(matrices) != 0.0
        found: Reals = np.full_like(matrices, math.nan)
        found[whole] = np.linalg.inv(matrices[whole])
        return found


def rested(system: System, q: Any, near: Reals, wanted: Mask) -> tuple[Reals, Mask]:
    """Unknowns at inputs from approximate ones until the wanted ones rest, and which do not come to rest."""
    y, inputs = near.copy(), np.broadcast_to(np.asarray(q, dtype=float), (len(near),))
    far: Mask = np.ones(len(near), dtype=bool)
    for _ in range(_CLOSING):
        with np.errstate(all="ignore"):
            step = system.step(Jets.of(y), inputs)
        y = y + np.where(np.isfinite(step), step, 0.0)
        far = ~(np.abs(step).max(axis=1) < 1e-9)
        if not (np.abs(step).max(axis=1) > _REST * 100.0)[wanted].any():
            break
    return y, far


class _Many:
    """Some samples side by side.

    Parameters
        columns : sizes and plays, (N,) arrays
    """

    def __init__(self, samples: PlanarSamples, columns: Mapping[str, Any]) -> None:
        self.samples, self.count = samples, len(next(iter(columns.values())))
        self.design = PlanarMechanism(samples.nominal.spec)
        structure, self.system = samples.made(columns)
        course = Course(structure)
        keep(course, dyads=dyads(structure, samples.nominal.course.system))
        keep(self.design, structure=structure, course=course)
        self.unsure: Mask = self._uncertain()
        for stages in _STAGES:
            if len(some := np.flatnonzero(self.unsure)):
                self.unsure[some] = ~samples.run_beside({key: values[some] for key, values in columns.items()}, stages)
        first = samples._grid[0]
        y, _open = self.closed(first.q, np.tile(first.y, (self.count, 1)))
        self.gap: Reals = self._gaps(y, np.full(self.count, first.q))

    def _uncertain(self) -> Mask:
        """Samples of which the theorem does not say that they run beside the nominal design."""
        change = self.samples.change(self.design.structure) + np.zeros(self.count)
        uncertain = np.zeros(self.count, dtype=bool)
        for there in self.samples._grid:
            uncertain |= there.leaves(self.system, change, self.count)
        return uncertain

    def closed(self, q: Any, near: Reals) -> tuple[Reals, Mask]:
        """Unknowns at inputs from approximate ones, and which do not come to rest."""
        return rested(self.system, q, near, ~self.unsure)

    def _gaps(self, y: Reals, q: Reals) -> Reals:
        """By how much the joints are open [mm]."""
        return np.asarray(np.abs(self.system.values(Jets.of(y), 0, q)).max(axis=1) * self.design.structure.size)

    @cached_property
    def numbers(self) -> dict[str, Coefficient]:
        """Taylor coefficients of what moves, by name."""
        found, structure = {name: of for name, (of, _) in self.design.moving_numbers.items()}, self.design.structure
        return found | {name: squared_distance(structure, *axes) for name, axes in self.samples._axes.items()}

    @cached_property
    def _found(self) -> dict[tuple[str, int, _Hump], tuple[Reals, Reals]]:
        return {}

    def _extreme(self, key: tuple[str, int], hump: _Hump) -> tuple[Reals, Reals]:
        """Values at a local extreme, and its places."""
        if (*key, hump) not in self._found:
            self._found[(*key, hump)] = self._sought(key, hump)
        return self._found[(*key, hump)]

    def _sought(self, key: tuple[str, int], hump: _Hump) -> tuple[Reals, Reals]:
        q, y = self._first(hump)
        if hump.end:
            return self._there(key, q, y, np.zeros(self.count, dtype=bool))
        return self._there(key, *self._walked(q, y, self._way(key, hump)), hump.side)

    def _walked(
        self, q: Reals, y: Reals, way: _ToJoint | _BySlope, held: Mask | bool = False
    ) -> tuple[Reals, Reals, Mask]:
        """Places along a way, and which are none: each step closes the samples, and goes on along their motions.

        Parameters
            held : (N,) mask - samples that stay where they are
        """
        start, off = q.copy(), np.zeros(self.count, dtype=bool)
        for _ in range(_STEPS):
            y, _open = self.closed(q, y)
            here = self.system.onward(Jets.of(y), q, way.order)
            with np.errstate(all="ignore"):
                step = way.step(q, here)
            step = np.where(np.isfinite(step) & np.logical_not(held), np.clip(step, -0.1, 0.1), 0.0)
            q, y = q + step, y + joined(here.x[1], here.t[1]) * step[:, None]
            off = (np.abs(q - start) > _FAR) | (np.abs(step) > way.rest[1]) | way.misses
            if not ((np.abs(step) > way.rest[0]) & ~self.unsure).any():
                break
        return q, y, off & np.logical_not(held)

    def _way(self, key: tuple[str, int], hump: _Hump) -> _ToJoint | _BySlope:
        """Laws have no derivative after the third: with cams by secants."""
        if hump.cam:
            return _ToJoint(self._cam_rows[hump.cam], hump.joint)
        (name, order), kind = key, _BySecants if self.samples.nominal.spec.cams else _BySlope
        return kind(lambda here, k: self.numbers[name](here, k) * math.factorial(k), order + kind.above, hump.sign)

    def _first(self, hump: _Hump) -> tuple[Reals, Reals]:
        """The place of the nominal design as the equations have it, and its unknowns, for each sample."""
        course, place = self.samples.nominal.course, np.array([hump.place])
        jets = course.jets(place, 0)
        first = joined(jets.x[0], jets.t[0])[0]
        return np.full(self.count, float(course.walked(place)[0])), np.tile(first, (self.count, 1))

    def _there(self, key: tuple[str, int], q: Reals, y: Reals, off: Mask, side: int = 1) -> tuple[Reals, Reals]:
        """Values at these places, and the places."""
        course, (name, order) = self.samples.nominal.course, key
        y, open_ones = self.closed(q, y)
        x, t = split(y)
        here = self.system.onward(Jets([x], [t], side=side), q, order)
        self.gap = np.maximum(self.gap, self._gaps(y, q))
        self.unsure = self.unsure | off | open_ones
        return course.derivatives(self.numbers[name], here, order)[order], course.unwalked(q)

    @cached_property
    def _cam_rows(self) -> dict[str, Any]:
        """By cam what tells its angle."""
        names = [*self.samples.nominal.spec.cams]
        found = {}
        for name, row in zip(names, self.system.rows[-len(names) :], strict=True):
            found[name] = row.contact if row.contact is not None else _AngleOfFace(row.lift)
        return found

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

    # Gears and shafts

    @property
    def judged_gaps(self) -> Iterator[Findings]:
        """GL301 and GL302 of gears and shafts, in the order of the class; of seats that do well NaN."""
        found, limits = placed(self.design.structure), self.samples.nominal.spec.limits
        if found is None:
            return
        for one, other in found.meetings:
            gap = self._gap_of(one, other)
            bare = sum(isinstance(body, Shaft) and body.radius is None for body in (one, other))
            if isinstance(one, Gear) and isinstance(other, Gear):
                yield collision_judged(gap, limits.gear_gap).of(self.count)
            else:
                yield shaft_judged(gap, found.least_shaft * bare, bare > 0).of(self.count)
        for seat in seats(found.gears, found.shafts):
            rim, least = (np.broadcast_to(each, (self.count,)) for each in (seat.rim, seat.least))
            thin, no = rim < least, np.zeros(self.count, dtype=bool)
            value, limit = (np.where(thin, each, math.nan) for each in (rim, least))
            yield Findings(SHAFT_CLEARANCE.code, value, limit, no, thin, "mm")

    def _gap_of(self, one: Gear | Shaft, other: Gear | Shaft) -> Reals:
        """Minimum gaps [mm]."""
        name = name_of(one, other)
        nearest = self._distance(name, -1.0)
        is_ring = np.any(np.isfinite(one.inner)) or np.any(np.isfinite(other.inner))
        farthest = self._distance(name, 1.0) if is_ring else nearest
        return np.asarray(reduce(np.maximum, gaps(one, other, nearest, farthest)))

    def _distance(self, name: str, sign: float) -> Reals:
        """Maximum (sign 1) or minimum distances of two axes [mm]."""
        samples, structure = self.samples, self.design.structure
        (one, p), (other, r) = samples._axes[name]
        body = carrier(structure, (one, p), (other, r), structure.plays)
        if body is not None:
            points = structure.bodies[body]
            return np.asarray(np.abs(points[p] - points[r]) + np.zeros(self.count))
        is_moving = (name, 0) in samples._humps
        square = self.extreme((name, 0), sign)[0] if is_moving else self._little_moved(name, sign)
        return np.asarray(np.sqrt(np.maximum(square, 0.0) * structure.size))

    @cached_property
    def _vertices(self) -> tuple[list[str], Tops]:
        """Names of the distances that nearly stand still nominally, and their vertices over the period."""
        names, looks = self.samples.nearly_still(self.design.structure.plays), self.samples.looks
        found = Tops((len(names), self.count))
        for there in (*looks, *looks[:2]):
            y, inputs = np.tile(there.y, (self.count, 1)), np.full(self.count, there.q)
            for _ in range(_ROUNDS):
                y = y - self.system.values(Jets.of(y), 0, inputs) @ there.inverse.T
            jets = Jets.of(y)
            found.add(np.array([self.numbers[name](jets, 0) for name in names]))
        return names, found

    def _little_moved(self, name: str, sign: float) -> Reals:
        """Extremes of what nearly stands still in the nominal design, from its vertex in each sample on."""
        (names, tops), looks = self._vertices, self.samples.looks
        i = names.index(name)
        at, key = tops.at[sign][i] % len(looks), (name, 0)
        held = ~(tops.best[1.0][i] + tops.best[-1.0][i] > _LEVEL_GAP * self.design.structure.size)
        q, y = np.array([there.q for there in looks])[at], np.array([there.y for there in looks])[at]
        return self._there(key, *self._walked(q, y, self._way(key, _Hump(0.0, sign)), held))[0]

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
            angles = [folded(self.numbers[name](Jets.of(y), 0)) for name, _ in still]
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
