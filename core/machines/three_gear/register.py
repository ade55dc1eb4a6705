"""Errors of the parts of a three-gear four-bar: its register budget in the dwell, and its samples for `tolerance`.

Links, centre distances and pins are taken as manufactured.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import geometry, in_unit, placed
from gearlink.core.base.design_axis import Evaluated, Findings, Single, as_arrays, put_in
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.nomenclature import term
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.torsion import torsional_stiffness
from gearlink.core.machines.three_gear import sweep
from gearlink.core.machines.three_gear.design import ThreeGearFourBar
from gearlink.core.machines.three_gear.dwell import STANDSTILL_TOLERANCE, ByRoots
from gearlink.core.mechanism.dual import Shift
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS
from gearlink.core.parts.linkages.checks import check_linkage, transmission_judged, window_judged
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.sweep import least_transmission_angle
from gearlink.core.parts.linkages.standstills import zeros_over_turn
from gearlink.core.studies.clearance import Clearance, collision_judged, gaps, shaft_judged
from gearlink.core.studies.register import Output, RegisterDesign, no_such_place, turning
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sampling import ARRAY_SAMPLES
from gearlink.core.studies.tolerance.sources import GearOfSource, Parts

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.spec import ThreeGearSpec
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.parts.gears.mesh.pair import GearPair


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

    Notes
        A pin's play at A or D shifts the loop as a whole; at B and C only its component along the coupler and along
        the rocker counts, since the gears stand on the pins. Gear teeth scatter in `register` alone.
    """

    extra = (_SWING,)
    samples = ARRAY_SAMPLES
    course_units = ("deg",)

    def __init__(self, nominal: ThreeGearFourBar) -> None:
        if nominal.spec.gears.helix_angle:
            raise NoSolution(
                "tolerance and register apply only to spur gears", key="gears.helix_angle", fix="omit helix_angle"
            )
        if nominal.off_center:
            raise NoSolution(
                "tolerance and register apply only to meshes whose profile shifts add up to 0",
                key="gears.profile_shift",
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
        """Start and crank angle of the nominal drive's dwell."""
        found = self.nominal.dwell_stretch
        if found is None:
            raise NoSolution(
                "dwell_swing needs a dwell: a back-step, or dwell_tolerance in the file", key="tolerance.require"
            )
        return found

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
        return self.nominal.dwell_stretch is not None

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
        nominal = samples.ahead.angle(phi)
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
                yield from (Findings.alike(check, samples.count) for check in nominal.check(name))

    def _of_meshes(self, samples: DriveSamples, exists: Mask) -> Iterator[Findings]:
        """What is judged of the teeth at the centre distances as made; a mesh that cannot be takes its drive away."""
        (_, b, c, _), made = self._lengths, samples.lengths[1:3]
        if all((length == nominal).all() for length, nominal in zip(made, (b, c), strict=True)):
            checks = (check for name in self._mesh_checks for check in self.nominal.check(name))
            yield from (Findings.alike(check, samples.count) for check in checks)
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


class MeshStates:
    """What the checks of both meshes say at the centre distances of many drives.

    Parameters
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


# Three-gear four-bars whose parts are as manufactured, not as designed: one at a time, and many near one at once

_TURN = 2.0 * math.pi
_MOST_OFF = 0.5  # [rad] by which an extreme may lie beside the nominal one
_CHORD_REST, _MOST_STEPS = 3e-7, 12  # of a step whose slope is the nominal drive's: a value there is off by its cube


class TolerancedDrive(ThreeGearFourBar):
    """A drive of given links, coupler and rocker among them.

    Parameters
        spec : ThreeGearSpec
        lengths : (crank, coupler, rocker, frame) [mm]
        window : (start, length) [rad] - crank angles over which `dwell_swing` is taken
        cut : ThreeGearFourBar or None - the drive of the same file, whose teeth these are; None: it is made here
    """

    advises = False

    def __init__(
        self,
        spec: Any,
        lengths: tuple[float, float, float, float],
        window: tuple[float, float] = (0.0, 0.0),
        cut: ThreeGearFourBar | None = None,
    ) -> None:
        super().__init__(spec)
        self.lengths, self.window = lengths, window
        self.cut = ThreeGearFourBar(spec) if cut is None else cut

    coupler_length: float = placed("lengths.1")
    rocker_length: float = placed("lengths.2")

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar as it is made."""
        linkage = FourBar(*self.lengths, self.spec.assembly)
        with at_key("links"):
            check_linkage(linkage)
        return linkage

    @cached_property
    def meshes(self) -> dict[str, GearPair]:
        """The teeth as they were cut, at the centre distances as manufactured."""
        pairs = zip(self.cut.meshes.items(), self._off, strict=True)
        return {name: at_distance(mesh, off) for (name, mesh), off in pairs}

    @property
    def _own_pairs(self) -> dict[str, GearPair]:
        return self.meshes

    @property
    def _off(self) -> tuple[float, float]:
        """By how much the centre distances are greater than those that the teeth were cut for [mm]."""
        return self.lengths[1] - self.cut.coupler_length, self.lengths[2] - self.cut.rocker_length

    @cached_property
    def output(self) -> ByRoots:
        """Standstills as roots: the links as manufactured are in no proportion to the teeth."""
        return ByRoots(self.linkage, self.train)

    @cached_property
    def dwell_swing(self) -> float:
        """Half the range of the output over the window [rad]."""
        start, length = self.window
        inside = [start + (place - start) % _TURN for place in self.dwell_crank_angles]
        places = [start, start + length, *(place for place in inside if place < start + length)]
        angles = [self.output.angle(place) for place in places]
        return 0.5 * (max(angles) - min(angles))


def at_distance(mesh: Any, off: float) -> Any:
    """A mesh whose teeth and tips stay as they are, its axes farther apart by `off` [mm].

    Raises
        NoSolution - where the axes stand nearer than the base circles let them
    """
    if off == 0.0:
        return mesh
    distance = abs(mesh.center_distance) + off
    return replace(mesh, given_shift=mesh.profile_shift, given_distance=distance, tip=mesh.tip_alteration)


class DriveSamples:
    """What a study asks of many drives near a nominal one.

    Parameters
        lengths : crank, coupler, rocker, frame - (N,) arrays [mm]
        frame_turn : (N,) array [rad] - by how much the line A-D is turned: crank angles count from the nominal line
    """

    def __init__(
        self, nominal: ThreeGearFourBar, lengths: tuple[Reals, Reals, Reals, Reals], frame_turn: Reals | float = 0.0
    ) -> None:
        self.nominal, self.lengths = nominal, lengths
        self.count = lengths[0].size
        self.frame_turn = np.broadcast_to(frame_turn, (self.count,))
        self.ahead = nominal.output.ahead
        self.counted = 1 if self.ahead is nominal.output else -1  # -1 where the file counts the output backward
        self.unsettled: Mask = np.zeros(self.count, dtype=bool)

    @cached_property
    def drives(self) -> sweep.Drives:
        """Linkages and gears."""
        train = self.ahead.train
        shares = train.ratio, train.coupler_share, train.rocker_share
        return sweep.drives_of(self.lengths, self.nominal.spec.assembly, *shares)

    def turning(self) -> tuple[Mask, Mask]:
        """Which are of the nominal drive's kind, crank-rocker or drag link, and which of the other; the rest do not
        turn."""
        rocker, drag, near = sweep.turns(self.drives)
        self.unsettled |= near
        positive = np.minimum.reduce(self.lengths) > 0.0
        own, other = (rocker, drag) if self.nominal.linkage.kind() == "crank-rocker" else (drag, rocker)
        return positive & own, positive & other

    def angle_at(self, phi: Reals) -> Reals:
        """Output angles [rad] at crank angles against the line A-D, of any zero."""
        return self.drives.angle(phi)

    # Extremes

    def _extreme(self, place: float, sign: float) -> tuple[Reals, Reals]:
        """The extreme of the speed near the nominal one, and its place; sign +1 for the greatest."""
        value, found, rests = sweep.extreme(self.drives, np.full(self.count, place), sign)
        self.unsettled |= ~rests | ~(np.abs(found - place) < _MOST_OFF)
        return value, found

    @property
    def _slowest_first(self) -> list[float]:
        """Where the nominal drive's speed is extreme, the output counted in the direction of its mean motion."""
        return [each.place for each in sorted(self.nominal.output.ahead_turnings, key=lambda each: each.value)]

    @cached_property
    def _least(self) -> tuple[Reals, Reals]:
        return self._extreme(self._slowest_first[0], -1.0)

    @cached_property
    def _greatest(self) -> tuple[Reals, Reals]:
        return self._extreme(self._slowest_first[-1], 1.0)

    @property
    def speed_ratio_min(self) -> Reals:
        """Minimum speed ratio."""
        return self._least[0] if self.counted > 0 else -self._greatest[0]

    @property
    def speed_ratio_max(self) -> Reals:
        """Maximum speed ratio."""
        return self._greatest[0] if self.counted > 0 else -self._least[0]

    def _acceleration_extreme(self, place: float) -> Reals:
        """Of the parabola about a place where the next step, with the nominal drive's slope of the jerk, is small."""
        h = 1e-4
        jerks = [self.ahead.jerk(place + side) for side in (-h, h)]
        slope = (jerks[1] - jerks[0]) / (2.0 * h)
        phi, value, live = np.full(self.count, place), np.full(self.count, np.nan), np.arange(self.count)
        for _ in range(_MOST_STEPS):
            _, acceleration, jerk = sweep.speed(phi[live], self.drives.part(live))
            step = jerk / slope
            phi[live] -= step
            value[live] = acceleration - 0.5 * jerk * step
            live = live[np.abs(step) > _CHORD_REST]
            if not live.size:
                break
        self.unsettled[live] = True
        self.unsettled |= ~(np.abs(phi - place) < _MOST_OFF)
        return self.counted * value

    @cached_property
    def acceleration_ratio_max(self) -> Reals:
        """Maximum acceleration ratio [1/rad]."""
        return self._acceleration_extreme(self.nominal.acceleration_ratio_max_at)

    @cached_property
    def acceleration_ratio_min(self) -> Reals:
        """Minimum acceleration ratio [1/rad]."""
        return self._acceleration_extreme(self.nominal.acceleration_ratio_min_at)

    @cached_property
    def nonuniformity(self) -> Reals:
        """(max - min)/mean of the speed ratio."""
        return (self.speed_ratio_max - self.speed_ratio_min) / abs(self.nominal.mean_ratio)

    # Back-step

    @cached_property
    def turns_back(self) -> Mask:
        """Where the output turns back."""
        value, place = self._least
        return np.asarray(value < -STANDSTILL_TOLERANCE * sweep.terms(place, self.drives))

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """Start and end of the back-step [rad], against the line A-D; without one the minimum speed's place twice."""
        least, some = self._least[1], np.flatnonzero(self.turns_back)
        first, second = least.copy(), least.copy()
        if not some.size:
            return first, second
        drives = self.drives if some.size == self.count else self.drives.part(some)
        # any place between the second standstill and the first of the next revolution ends the brackets
        fast = np.full(some.size, self._slowest_first[-1])
        self.unsettled[some] |= ~(sweep.speed(fast, drives, 1)[0] > 0.0)
        first[some], second[some] = sweep.around(least[some], fast, drives)
        return first, second

    @cached_property
    def back_step_angle(self) -> Reals:
        """How far the output turns back [rad]; NaN where it does not."""
        top, bottom = (self.angle_at(place) for place in self.standstills)
        return np.where(self.turns_back, top - bottom, np.nan)

    @cached_property
    def back_step_crank_angle(self) -> Reals:
        """Crank angle of the back-step [rad]."""
        first, second = self.standstills
        return np.where(self.turns_back, second - first, np.nan)

    @property
    def dwell_angle_approximate(self) -> Reals:
        """1.5 times the crank angle of the back-step [rad]."""
        return 1.5 * self.back_step_crank_angle

    @cached_property
    def dwell_angle(self) -> Reals:
        """Crank angle until the output regains its place [rad]."""
        found, some = np.full(self.count, np.nan), np.flatnonzero(self.turns_back)
        first, width = self.standstills[0][some], self.back_step_crank_angle[some]
        found[some] = sweep.dwell_angle(first, width, self.drives.part(some))
        return found

    @cached_property
    def tolerance_dwell_angle(self) -> Reals:
        """Crank angle of the longest dwell within the tolerance [rad]; NaN without one."""
        tolerance, dwell = self.nominal.output_tolerance, self.nominal.tolerance_dwell
        if tolerance is None or dwell is None:
            return np.full(self.count, np.nan)
        first, second = self.standstills
        high = first + np.mod(self._greatest[1] - first, _TURN)
        mean = np.full(self.count, abs(self.nominal.mean_ratio))
        valleys = sweep.Valleys(self.drives, first, second, self._least[1], high - _TURN, high, mean)
        found = sweep.longest_in_band(valleys, np.full(self.count, tolerance))
        self.unsettled |= found.doubtful
        return found.crank_angle

    def swing(self, start: float, length: float) -> Reals:
        """Half the range of the output over crank angles that are fixed in the machine [rad].

        Parameters
            start, length : float [rad] - of the window, from the nominal line A-D
        """
        ends = [start + share * length - self.frame_turn for share in (0.0, 1.0)]
        angles = [self.angle_at(end) for end in ends]
        for place in self.standstills if self.turns_back.any() else ():
            here = place - np.rint((place - start - 0.5 * length) / _TURN) * _TURN
            inside = self.turns_back & (here > ends[0]) & (here < ends[1])
            angles.append(np.where(inside, self.angle_at(here), angles[0]))
        swing: Reals = 0.5 * (np.max(angles, axis=0) - np.min(angles, axis=0))
        return swing

    # Closed forms

    @cached_property
    def min_transmission_angle(self) -> Reals:
        """Minimum transmission angle over the revolution [rad]."""
        return least_transmission_angle(*self.lengths)

    @cached_property
    def gear_gap(self) -> Reals:
        """Minimum gap of the tips of gears 1 and 5 [mm]; NaN where they are not judged."""
        nominal, links, (crank, *_, frame) = self.nominal.gear_gap, self.nominal.linkage, self.lengths
        if nominal is None:
            return np.full(self.count, np.nan)
        return np.abs(frame - crank) + (nominal - abs(links.frame - links.crank))

    def distances(self) -> dict[str, tuple[Reals, Reals]]:
        """Minimum and maximum distance of the axes over the revolution [mm], by their ends."""
        crank, coupler, rocker, frame = self.lengths
        # Of the triangle A-B-C or A-D-C the one whose angle at the middle joint turns fully.
        one, other = (coupler, crank) if self.nominal.linkage.kind() == "crank-rocker" else (rocker, frame)
        return {
            "AC": (np.abs(one - other), one + other),
            "AD": (frame, frame),
            "BD": (np.abs(frame - crank), frame + crank),
            "CD": (rocker, rocker),
        }


_OF_IDLER = (Shift("coupler", ("B",), -1.0),)  # a longer coupler: the crank side stands back
_OF_OUTPUT = (Shift("rocker", ("D",), -1.0),)


class ThreeGearRegister(RegisterDesign):
    """Error of the output at its reference circle over the dwell."""

    kind = "three-gear-four-bar"
    spec: ThreeGearSpec
    default_at = "dwell"
    sizes = {
        "links.crank": (Shift("crank", ("B", "mesh_13")),),
        "links.frame": (Shift("frame", ("D", "D_output")),),
        "centers.crank_idler": _OF_IDLER,
        "centers.idler_output": _OF_OUTPUT,
    }
    pins = {"B": _OF_IDLER, "C": _OF_OUTPUT, "D": (Shift("frame", ("D", "D_output"), 1.0, "frame"),)}
    gears = {"crank": "crank", "idler": "idler", "output": "output"}

    def __init__(self, spec: Any) -> None:
        asked = spec.syntheses() if spec.links is None else ()
        if asked:  # done once; its links are what scatters
            found = KINDS[self.kind].design_class(asked[0])(spec).completion()
            spec = changed(spec, [(one.path, one.value) for one in found])
        super().__init__(spec)

    design = geometry(ThreeGearFourBar)

    @cached_property
    def parts(self) -> Parts:
        """Centre distances, pins and gears."""
        return ThreeGearSamples(self.design).parts

    @cached_property
    def radius(self) -> float:
        """Radius at which the error of the output is measured [mm]."""
        return self.section.radius or self._reference

    @property
    def _reference(self) -> float:
        """Reference radius of the output gear [mm]."""
        return 0.5 * self.spec.gears.module * abs(self.design.output_teeth)

    def mechanism(self, input_angle: Reals) -> Mechanism:
        """The five links."""
        return self.design.moving.make(input_angle, 1, 1)

    def output(self, _input_angle: Reals) -> Output:
        """The circle of the output gear, as the output is counted."""
        return turning("output", self.radius, self.design.train.sense)

    def stretch(self, at: str) -> tuple[float, float]:
        """The dwell: within the tolerance where the file gives one, else phi13."""
        if at != "dwell":
            raise no_such_place(at, ("dwell",))
        found = self.design.dwell_stretch
        if found is None:
            raise NoSolution(
                "this drive has no dwell", key="register.at", fix="give dwell_tolerance, or --at an input angle"
            )
        return found[0], found[0] + found[1]

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, and the wind-up of the output's shaft."""
        found = super().contributions(input_angle, torque_sign)
        if self.section.stiffness is not None and self.output_torque is not None:
            found.append(self._wind_up(input_angle))
        return found

    def _wind_up(self, input_angle: Reals) -> Contribution:
        """Lag of the output behind its gear under the torque that moves it: in every machine alike, without scatter."""
        assert self.output_torque is not None
        assert self.section.stiffness is not None
        torque = np.array([self.output_torque(float(phi)) for phi in input_angle])
        counted = self.design.output.ahead.train.sense * self.design.train.sense
        gain = -counted * self.radius * torque / torsional_stiffness(self.section.stiffness)
        return Contribution("wind-up of the output shaft", gain, 1.0, 0.0, mean=1.0)

    # Torque and backlash

    @cached_property
    def backlash(self) -> dict[str, float]:
        """Circumferential backlash of both meshes [mm]."""
        return self.section.backlash_of(("crank_idler", "idler_output"))

    @cached_property
    def dead_band(self) -> float | None:
        """The jump at the radius that is asked for [mm]."""
        if not self.backlash:
            return None
        return sum(self.backlash.values()) * self.radius / self._reference

    @property
    def _by_inertia_alone(self) -> bool:
        """Whether the file leaves out what friction and load are weighed against, or both."""
        section = self.section
        if section.output_inertia is None:
            return not section.friction and not section.load
        return self.spec.input_speed is None

    @cached_property
    def output_torque(self) -> Any:
        """Torque on the output in its forward sense [N m] over the crank angle; None where the file has nothing of it.

        T = J W' w^2 + T_f sign(W) + T_load
        """
        section, speed = self.section, self.spec.input_speed
        ahead = self.design.output.ahead
        if section.output_inertia is None and not section.friction and not section.load:
            return None
        if speed is None and section.output_inertia is not None:
            raise NoSolution("the torque of the output's inertia needs input_speed (1/min)", key="input_speed")
        inertia = 0.0 if speed is None else (section.output_inertia or 0.0) * (speed * math.pi / 30.0) ** 2

        def torque(phi: float) -> float:
            speed_ratio = ahead.speed(phi)
            friction = math.copysign(section.friction, speed_ratio) if speed_ratio else 0.0
            return inertia * ahead.acceleration(phi) + friction + section.load

        return torque

    @cached_property
    def flips(self) -> list[float] | None:
        """Crank angles at which the output's torque turns [rad]; by inertia alone where W' does."""
        return zeros_over_turn(self.design.output.acceleration if self._by_inertia_alone else self.output_torque)

    @property
    def judges_flips(self) -> bool:
        """Where the file tells of backlash or of what the output carries."""
        return bool(self.backlash) or self.section.output_inertia is not None or not self._by_inertia_alone

    @property
    def against_flips(self) -> str:
        """The friction that keeps the sign in a drive that never turns back."""
        section, speed = self.section, self.spec.input_speed
        if self.design.motion == "back-step" or section.output_inertia is None or speed is None:
            return "brake the output, or preload the gears"
        rate = speed * math.pi / 30.0
        most = section.output_inertia * rate * rate * max(abs(t.value) for t in self.design.acceleration_turnings)
        return f"a friction torque above {most:.4g} N m on the output keeps the sign"
