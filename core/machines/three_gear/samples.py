"""Samples of a three-gear four-bar for the command tolerance: links, centre distances and pins as manufactured."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any

import numpy as np

from gearlink.core.base.design import in_unit
from gearlink.core.base.design_axis import Evaluated, Findings, Single, as_arrays, put_in
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Check
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear import motion
from gearlink.core.machines.three_gear.as_made import DriveSamples, TolerancedDrive
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.parts.gears.train.single_mesh import MESH_CHECKS
from gearlink.core.parts.linkages.checks import transmission_judged, window_judged
from gearlink.core.studies.clearance.bodies import Clearance, gaps
from gearlink.core.studies.clearance.checks import collision_judged, shaft_judged
from gearlink.core.studies.tolerance.sources import GearOfSource, Parts

_KEYS = ("links.crank", "links.frame", "centers.crank_idler", "centers.idler_output")
_PINS = ("A", "B", "C", "D")
_ARRAYS = (
    "back_step_angle",
    "back_step_crank_angle",
    "dwell_angle",
    "dwell_angle_approximate",
    "speed_ratio_max",
    "speed_ratio_min",
    "acceleration_ratio_max",
    "acceleration_ratio_min",
    "nonuniformity",
    "min_transmission_angle",
    "gear_gap",
    "tolerance_dwell_angle",
)
_LENGTHS = {"crank_length": 0, "coupler_length": 1, "rocker_length": 2, "frame_length": 3}
_SWING = "dwell_swing"
_OF_LINKS = {"gear-collision", "shaft-clearance", "transmission-angle", "dwell-window"}
"""Checks that the links as manufactured decide; those of the meshes hang on the centre distances."""
_NO_MESH = "no mesh"
State = frozenset[str]
"""Codes that fail at a centre distance; `_NO_MESH` where the teeth cannot mesh."""


class ThreeGearSamples:
    """The samples of one drive.

    Parameters
        nominal : ThreeGearFourBar
    Notes
        A pin's play at A or D shifts the loop as a whole; at B and C only its component along the coupler and along
        the rocker counts, since the gears stand on the pins. Gear teeth scatter in `register` alone.
    """

    extra = (_SWING,)

    def __init__(self, nominal: ThreeGearFourBar) -> None:
        if nominal.spec.gears.helix_angle:
            raise NoSolution(
                "tolerance and register take spur gears only", key="gears.helix_angle", fix="omit helix_angle"
            )
        if nominal.off_center:
            raise NoSolution(
                "tolerance and register take only meshes whose profile shifts add up to 0", key="gears.profile_shift"
            )
        self.nominal = nominal
        links = nominal.linkage
        self._lengths = (links.crank, links.coupler, links.rocker, links.frame)

    @cached_property
    def parts(self) -> Parts:
        """Centre distances, pins and gears."""
        gears, nominal = self.nominal.spec.gears, self.nominal
        alpha = math.radians(gears.pressure_angle)
        teeth = {"crank": nominal.crank_teeth, "idler": nominal.idler_teeth, "output": nominal.output_teeth}
        return Parts(
            {"crank_idler": self._lengths[1], "idler_output": self._lengths[2]},
            _PINS,
            {name: GearOfSource(gears.module, gears.module * abs(z), alpha) for name, z in teeth.items()},
        )

    def serves(self, keys: Sequence[str], names: Sequence[str]) -> bool:
        """Links, centre distances and pins, and what depends on them alone."""
        known = {*_KEYS, *(f"{group}.{pin}" for group in ("pins", "bearings") for pin in _PINS)}
        return known.issuperset(keys) and {*_ARRAYS, *_LENGTHS, _SWING}.issuperset(names)

    def evaluate(self, columns: Mapping[str, Reals | Points], names: Sequence[str]) -> Evaluated:
        """The drives as manufactured; one without a turning crank is refused."""
        samples = self._samples(columns)
        exists, other = samples.turning()
        with np.errstate(invalid="ignore", divide="ignore"):  # of drives that do not exist
            values = {name: self._quantity(name, samples) for name in names}
            findings = [*self._of_links(samples), *self._of_meshes(samples, exists)]
        for value in values.values():
            value[~exists] = np.nan
        found = Evaluated(values, findings, np.where(exists, 0, 1), ("links",))
        alone = np.flatnonzero((samples.unsettled & exists) | other)
        return put_in(found, alone, self._alone(alone, samples, names)) if alone.size else found

    def _alone(self, places: Any, samples: DriveSamples, names: Sequence[str]) -> Evaluated:
        """Some of the drives, each by its class."""
        found = []
        for i in places.tolist():
            made = self._made(self.nominal, samples, i, _SWING in names)
            try:
                values = {name: in_unit(made.raw(name), term(name).unit) for name in names}
                checks = tuple(check for name in self._checks for check in made.check(name))
                found.append(Single(values, checks))
            except NoSolution as error:
                found.append(Single({}, (), "links", str(error)))
        codes = dict.fromkeys(check.code for one in found for check in one.findings)
        return as_arrays(found, names, list(codes))

    def _samples(self, columns: Mapping[str, Any]) -> DriveSamples:
        a, b, c, d = self._lengths
        crank, frame = columns.get("links.crank", a), columns.get("links.frame", d)
        coupler, rocker = columns.get("centers.crank_idler", b), columns.get("centers.idler_output", c)
        loop: Any = frame
        for group in ("pins", "bearings"):
            loop = loop + columns.get(f"{group}.D", 0.0) - columns.get(f"{group}.A", 0.0)
            coupler = coupler + np.real(columns.get(f"{group}.B", 0.0))
            rocker = rocker + np.real(columns.get(f"{group}.C", 0.0))
        one, two, three, four = np.broadcast_arrays(crank, coupler, rocker, np.abs(loop))
        return DriveSamples(self.nominal, (one, two, three, four), np.angle(loop))

    def _quantity(self, name: str, samples: DriveSamples) -> Reals:
        if name in _LENGTHS:
            return samples.lengths[_LENGTHS[name]].copy()
        value: Reals = samples.swing(*self._window) if name == _SWING else getattr(samples, name)
        return np.array(np.degrees(value) if term(name).unit == "deg" else value)

    @cached_property
    def _window(self) -> tuple[float, float]:
        """Crank angles that the dwell is meant for: within the tolerance where one is given, else phi13."""
        nominal = self.nominal
        if nominal.tolerance_dwell is not None:
            return nominal.tolerance_dwell.start, nominal.tolerance_dwell.crank_angle
        if nominal.back_step is None or nominal.dwell_angle is None:
            raise NoSolution(
                "dwell_swing needs a dwell: a back-step, or dwell_tolerance in the file", key="tolerance.require"
            )
        return nominal.back_step.start, nominal.dwell_angle

    def _made(self, cut: ThreeGearFourBar, samples: DriveSamples, i: int, in_window: bool) -> TolerancedDrive:
        """One of the drives, whose teeth are those of a drive as cut: its gears may lie at other centre distances."""
        a, b, c, d = (float(length[i]) for length in samples.lengths)
        if cut is not self.nominal:
            b, c = b + (cut.coupler_length - self._lengths[1]), c + (cut.rocker_length - self._lengths[2])
        start, length = self._window if in_window else (0.0, 0.0)
        return TolerancedDrive(cut.spec, (a, b, c, d), (start - float(samples.frame_turn[i]), length), cut)

    def sets(self, key: str) -> bool:
        """Whether a source is a length of the loop."""
        return key in _KEYS or key.startswith(("pins.", "bearings."))

    def design(self, values: Mapping[str, float | complex], cut: Any = None) -> TolerancedDrive:
        """One drive as manufactured."""
        cut = self.nominal if cut is None else cut
        crank = {"links.crank": self._lengths[0]}  # of one drive, also where no length differs
        samples = self._samples({key: np.array([value]) for key, value in (crank | dict(values)).items()})
        return self._made(cut, samples, 0, self.has_window)

    @property
    def has_window(self) -> bool:
        """Whether the nominal drive dwells."""
        return self.nominal.tolerance_dwell is not None or self.nominal.dwell_angle is not None

    # Over the cycle

    @cached_property
    def reference(self) -> float | None:
        """Where the dwell begins; the outputs of drives without one count from crank angle 0."""
        return math.degrees(self._window[0]) if self.has_window else None

    def course(self, columns: Mapping[str, Reals | Points], input_angle: Reals) -> Reals:
        """By how much the outputs lie above that of the nominal drive [rad]."""
        samples = self._samples(columns)
        exists, _ = samples.turning()
        with np.errstate(invalid="ignore"):
            start = self._off(samples, self._window[0] if self.has_window else 0.0)
            off = np.array([self._off(samples, float(phi)) - start for phi in input_angle])
        off[:, ~exists] = np.nan
        return off

    def _off(self, samples: DriveSamples, phi: float) -> Reals:
        """Output angle of the drives at a crank angle of the machine, less that of the nominal one."""
        nominal = motion.output_angle(self.nominal.linkage, samples.train, phi)
        off: Reals = samples.counted * (samples.angle_at(phi - samples.frame_turn) - nominal)
        return off

    # Findings

    @property
    def _checks(self) -> tuple[str, ...]:
        return self.nominal.outlines["analyze"].checks

    def _of_links(self, samples: DriveSamples) -> Iterator[Findings]:
        """What is judged of every drive by its links, and what no deviation changes."""
        nominal, limits = self.nominal, self.nominal.spec.limits
        own = set(_OF_LINKS)
        if nominal.gear_gap is not None:
            yield collision_judged(samples.gear_gap, limits.gear_gap).of(samples.count)
        else:  # a ring and its idler lie in a plane of their own
            own.remove("gear-collision")
        angle = np.degrees(samples.min_transmission_angle)
        yield transmission_judged(angle, limits.transmission_angle).of(samples.count)
        for pair in nominal.layout.shaft_pairs:
            yield self._shaft(pair, samples)
        if nominal.tolerance_dwell is None:  # no tolerance, or one that the output never leaves
            own.remove("dwell-window")
        elif nominal.spec.dwell_window is not None:
            reached = np.degrees(samples.tolerance_dwell_angle)
            yield window_judged(reached, nominal.spec.dwell_window).of(samples.count)
        for name in self._checks:
            if name not in own and name not in MESH_CHECKS:
                yield from (_same(check, samples.count) for check in nominal.check(name))

    def _of_meshes(self, samples: DriveSamples, exists: Mask) -> Iterator[Findings]:
        """What is judged of the teeth at the centre distances as made; a mesh that cannot be takes its drive away."""
        (_, b, c, _), made = self._lengths, samples.lengths[1:3]
        if all((length == nominal).all() for length, nominal in zip(made, (b, c), strict=True)):
            checks = (check for name in self._mesh_checks for check in self.nominal.check(name))
            yield from (_same(check, samples.count) for check in checks)
            return
        yield from self._meshes.findings(made, exists)

    @property
    def _mesh_checks(self) -> list[str]:
        return [name for name in self._checks if name in MESH_CHECKS]

    @cached_property
    def _meshes(self) -> MeshStates:
        return MeshStates(self.nominal, self._lengths, self._mesh_checks)

    def _shaft(self, pair: Clearance, samples: DriveSamples) -> Findings:
        """GL302 of two bodies."""
        ends = "".join(sorted((pair.one.axis, pair.other.axis)))
        gap = np.maximum.reduce(gaps(pair.one, pair.other, *samples.distances()[ends]))
        limit = self.nominal.layout.least_shaft * len(pair.bare)
        return shaft_judged(gap, limit, bool(pair.bare)).of(samples.count)


def _same(check: Check, count: int) -> Findings:
    """A finding that no tolerance of these changes."""
    fails, warns = np.full(count, check.status == "fail"), np.full(count, check.status == "warn")
    value = np.full(count, math.nan if check.value is None else check.value)
    return Findings(
        check.code, value, np.full(count, math.nan if check.limit is None else check.limit), fails, warns, check.unit
    )


class MeshStates:
    """What the checks of both meshes say at the centre distances of many drives.

    Parameters
        nominal : ThreeGearFourBar
        lengths : 4 float [mm] - crank, coupler, rocker, frame of it
        names : of the checks
    Notes
        The stretches of distances whose state is known are kept, from one block of samples to the next.
    """

    def __init__(self, nominal: ThreeGearFourBar, lengths: Sequence[float], names: Sequence[str]) -> None:
        self.nominal, self.lengths, self.names = nominal, lengths, names
        self._known: dict[str, dict[State, tuple[float, float]]] = {mesh: {} for mesh in nominal.mesh_names}
        self._codes = {
            mesh: dict.fromkeys(check.code for name in names for check in nominal.check_mesh(name, mesh))
            for mesh in nominal.mesh_names
        }

    def findings(self, made: Sequence[Reals], exists: Mask) -> Iterator[Findings]:
        """The checks of both meshes.

        Parameters
            made : two (N,) arrays [mm] - coupler and rocker as manufactured, the centre distances of the meshes
            exists : (N,) array - becomes False where the teeth cannot mesh
        Yields
            findings : Findings - one of every code and mesh, without values
        """
        for place, (mesh, distances) in enumerate(zip(self.nominal.mesh_names, made, strict=True), 1):
            states = over_sorted(partial(self._at, mesh, place), distances)
            exists &= ~_with(states, _NO_MESH, distances.size)
            for code in dict.fromkeys(
                [*self._codes[mesh], *(one for found, _ in states for one in found - {_NO_MESH})]
            ):
                fails, nothing = _with(states, code, distances.size), np.full(distances.shape, np.nan)
                yield Findings(code, nothing, nothing, fails, np.zeros_like(fails), "1")

    def _at(self, mesh: str, place: int, distance: float) -> State:
        known = self._known[mesh]
        for found, (low, high) in known.items():
            if low <= distance <= high:
                return found
        a, b, c, d = (distance if i == place else length for i, length in enumerate(self.lengths))
        state = _state(TolerancedDrive(self.nominal.spec, (a, b, c, d), cut=self.nominal), mesh, self.names)
        low, high = known.get(state, (distance, distance))
        known[state] = min(low, distance), max(high, distance)
        return state


def _state(made: TolerancedDrive, mesh: str, names: Sequence[str]) -> State:
    try:
        found = [check for name in names for check in made.check_mesh(name, mesh)]
    except NoSolution:
        return frozenset((_NO_MESH,))
    return frozenset(check.code for check in found if check.status == "fail")


def over_sorted(state: Callable[[float], State], values: Reals) -> list[tuple[State, Any]]:
    """What a function of one number is at many, where it changes few times and never back.

    Parameters
        state : Callable - of one number; what it gives at two numbers it gives between them
        values : (N,) array
    Returns
        states : list of (state, places) - places in `values`
    Notes
        A mesh is judged at some numbers of each stretch alone: contact ratio, clearance at the root and what the tips
        leave of the flanks rise or fall with the centre distance, so that each code fails on one side of a number.
    """
    least, greatest = state(float(values.min())), state(float(values.max()))
    if least == greatest:
        return [(least, np.arange(values.size))]
    order = np.argsort(values)
    found: list[tuple[State, Any]] = []

    def between(first: int, last: int, low: State, high: State) -> None:
        """The places after the first to the last."""
        if low == high or last - first <= 1:
            found.append((high, order[first + 1 : last + 1]))
            return
        middle = (first + last) // 2
        half = state(float(values[order[middle]]))
        between(first, middle, low, half)
        between(middle, last, half, high)

    found.append((least, order[:1]))
    between(0, len(order) - 1, least, greatest)
    return found


def _with(states: Sequence[tuple[State, Any]], code: str, count: int) -> Mask:
    """Where a code is in the state."""
    mask: Mask = np.zeros(count, dtype=bool)
    for state, places in states:
        if code in state:
            mask[places] = True
    return mask
