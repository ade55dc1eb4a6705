"""The register budget of any machine that has a motion: sources, stretch, the two torque signs, tables and checks.

The register error is that of the first output.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from typing import Any, ClassVar, Protocol, TypeAlias

import numpy as np

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, named
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.report import NO_NUMBER, Check, Shown, Status, Table, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.torsion import torsional_stiffness
from gearlink.core.base.wording import first_of, short
from gearlink.core.mechanism.dual import Chain, Dual, Shift
from gearlink.core.mechanism.joints import Contact, Flank, Pin, SharedContact, Toothed
from gearlink.core.mechanism.links import Mechanism
from gearlink.core.mechanism.motion import Course, Motion
from gearlink.core.numerics.arrays import Reals, turn_degrees
from gearlink.core.numerics.roots_sweep import zeros
from gearlink.core.studies.codes import BACKLASH_IN_DWELL, REGISTER_BUDGET
from gearlink.core.studies.loads.names import RPM
from gearlink.core.studies.movable import Errors, Movable
from gearlink.core.studies.tolerance.budget import Budget, Contribution, budget, budget_table, counted, tightened
from gearlink.core.studies.tolerance.correlation import coordinate_root, of_sizes, together
from gearlink.core.studies.tolerance.laws import Law
from gearlink.core.studies.tolerance.sampling import is_shared, of_replications, replication, rounded_up
from gearlink.core.studies.tolerance.sources import Parts, Scatter, deviations_of, is_of_parts, scatters
from gearlink.core.studies.tolerance.spec import Register, Tolerance

Off: TypeAlias = Mapping[str, Any] | None
"""Errors by source, of those on which the output depends beside the links."""


class Output(Protocol):
    """What is looked at, out of the links [mm], and its derivatives."""

    def __call__(self, mechanism: Mechanism, parts: Off = None, /) -> Sequence[Reals]:
        """The value and its derivatives, as many as the links have."""


@dataclass(frozen=True)
class Moves:
    """What the sources of a machine move.

    Fields
        errors : of sizes, by their keys - mm per mm, of angles per degree
        pins : what the play of a pin moves: along a link the part in its direction counts, in the frame it is a vector;
            of those that are left out the element on the first link, in the frame
        gears : by source, the link of the gear
        words : what the sources move, for a size that is none of them
    """

    errors: Errors
    pins: Errors
    gears: Mapping[str, str]
    words: str

    def of(self, source: Scatter, mechanism: Mechanism) -> tuple[Shift, ...]:
        """The shifts of a source.

        Raises
            NoSolution - for a size that is no source here
        """
        name = source.key.partition(".")[2]
        if source.kind == "pin":
            return self.pins[name] if name in self.pins else _play(name, mechanism)
        if source.kind == "gear":
            link = self.gears[name]
            teeth = [each for each in mechanism.connections if isinstance(each, (*Toothed, Flank))]
            return (Shift(link, tuple(each.name for each in teeth if link in (each.first, each.second))),)
        if source.key in self.errors:
            return self.errors[source.key]
        others = f"; sizes that count here: {first_of(list(self.errors), 8)}" if self.errors else ""
        raise NoSolution(
            f"{source.key} is no source of the register of {self.words}: it counts in tolerance alone",
            key=f'tolerance.sources."{source.key}"',
            fix=f"omit it where register is computed{others}",
        )

    def is_vector(self, source: Scatter) -> bool:
        """Whether an error of it has any direction."""
        if source.kind != "pin":
            return source.kind == "gear"
        own = self.pins.get(source.key.partition(".")[2])
        return own is None or own[0].frame == "frame"


def _play(pin: str, mechanism: Mechanism) -> tuple[Shift, ...]:
    joint = next(each for each in mechanism.connections if each.name == pin)
    return (Shift(joint.first, (pin,), 1.0, "frame"),)


class Gains:
    """The gains of a machine over input angles.

    Parameters
        torque_sign : +1 or -1 - of what the machine puts on the output
    """

    def __init__(self, mechanism: Mechanism, output: Output, moves: Moves, torque_sign: int) -> None:
        self.mechanism, self.moves = mechanism, moves
        self.dual = Dual(mechanism, output, torque_sign)

    def of(self, source: Scatter) -> Any:
        """The gain of a source, complex for a vector."""
        shifts = self.moves.of(source, self.mechanism)
        if self.moves.is_vector(source):
            return sum(self.dual.vector_gain(shift) for shift in shifts)
        return sum(self.dual.gain(shift) for shift in shifts)

    def profile(self, contact: str, error: float) -> Contribution:
        """The error of a cam's profile under a roller: whatever its sign, each place has its own."""
        roller = next(each for each in self.mechanism.connections if each.name == contact)
        gain = np.abs(self.dual.gain(Shift(roller.second, (contact,), 1.0, "normal")))
        return Contribution("cam profile", gain, error, error / 3.0, relative=False)

    def backlash(self, plays: Mapping[str, float]) -> list[Contribution]:
        """Half of the backlash of each mesh, by which the driven member lags."""
        halves = {mesh: 0.5 * play for mesh, play in plays.items()}
        return [
            Contribution(f"backlash of {mesh}", self.dual.play(mesh), half, 0.0, mean=half)
            for mesh, half in halves.items()
        ]


def turning(link: str, radius: float, sense: float = 1.0) -> Output:
    """The way of a circle of a link that turns [mm], counted in a sense."""

    def output(mechanism: Mechanism, _parts: Off = None) -> Sequence[Reals]:
        return [sense * radius * rate for rate in mechanism.links[link].turn]

    return output


_STEP = math.radians(0.5)


class RegisterDesign(Design):
    """The register budget of a machine, over a stretch of its cycle.

    A machine gives `parts`, `mechanism` and `output`, what its `errors` move, its `stretch`, and what it knows of
    torque and backlash.
    """

    repairable = False
    default_at: ClassVar[str]
    turning: ClassVar[str] = "torque on the output"
    has_outputs: ClassVar[bool] = False
    """Whether the file may say whose error counts."""
    words: ClassVar[str] = "the output"
    """What its sources move."""
    outlines: ClassVar[dict[str, Outline]] = {
        "register": Outline(
            ("worst", "rss", "band", "dead_band", "flips"),
            ("register-budget", "backlash-in-dwell"),
            ("budget", "cycle"),
        )
    }
    key_tables = ("budget",)
    extra_tables = ("sources",)
    advises = False

    # What a machine gives

    @property
    def parts(self) -> Parts:
        """What may scatter beside the keys of the file."""
        raise NotImplementedError

    def mechanism(self, input_angle: Reals) -> Mechanism:
        """Links and joints at input angles [rad]."""
        raise NotImplementedError

    def output(self, input_angle: Reals) -> Output:
        """What is looked at, out of the links at input angles [rad], which may stand one below the other."""
        raise NotImplementedError

    sizes: ClassVar[Errors] = {}
    """By size of the file, or centre distance, what it moves."""
    pins: ClassVar[Errors] = {}
    """By pin, what its play moves, where that is not the element on the first link: along a link, or in the frame."""
    gears: ClassVar[Mapping[str, str]] = {}
    """By gear, its link."""

    @property
    def errors(self) -> Errors:
        """By size, what it moves, where that depends on the design as well."""
        return self.sizes

    def own_gain(self, _key: str, _input_angle: Reals) -> Reals | None:
        """Gain of a size on which the output depends beside the links."""
        return None

    def stretch(self, at: str) -> tuple[float, float]:
        """First and last input angle [rad] of a place by name.

        Raises
            NoSolution - where the machine has no such place
        """
        raise NotImplementedError

    def cycle_degrees(self, samples: int | None) -> Reals:
        """Inputs of the tables over the cycle."""
        return turn_degrees(samples)

    # Gains

    @cached_property
    def moves(self) -> Moves:
        """What the sources move."""
        return Moves(self.errors, self.pins, self.gears, self.words)

    def shifts(self, source: Scatter, mechanism: Mechanism) -> tuple[Shift, ...]:
        """What a source moves; nothing where the output alone depends on it."""
        return () if self._own_alone(source) else self.moves.of(source, mechanism)

    def _own_alone(self, source: Scatter) -> bool:
        """Whether the output depends on a source by itself, and no joint does."""
        own = source.kind == "size" and self.own_gain(source.key, np.zeros(1)) is not None
        return own and source.key not in self.errors

    def gains(self, input_angle: Reals, torque_sign: int) -> Gains:
        """The gains over input angles."""
        return Gains(self.mechanism(input_angle), self.output(input_angle), self.moves, torque_sign)

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source along input angles."""
        return self.of_sources(self.gains(input_angle, torque_sign), input_angle)

    def of_sources(self, gains: Gains, input_angle: Reals) -> list[Contribution]:
        """Every source of the file."""
        found = []
        for source in self.sources:
            own = self.own_gain(source.key, input_angle) if source.kind == "size" else None
            gain = 0.0 if self._own_alone(source) else gains.of(source)
            found.append(contribution(source, gain if own is None else gain + own))
        return found

    def chain(self, input_angle: Reals, torque_sign: int) -> Chain:
        """The chain over input angles, for what carries at a torque sign; without meshes that is one for both."""
        key = input_angle.tobytes()
        if (key, torque_sign) not in self._chains:
            gains = self.gains(input_angle, torque_sign)
            chain = Chain(gains.mechanism, gains.dual.sides)
            self._chains |= {(key, sign): chain for sign in SIGNS if sign == torque_sign or not gains.dual.sides}
        return self._chains[key, torque_sign]

    @cached_property
    def _chains(self) -> dict[tuple[bytes, int], Chain]:
        """The chains that replications look at again and again."""
        return {}

    def sampled_errors(self, input_angle: Reals, torque_sign: int, parts: Mapping[str, Any]) -> Reals:
        """Errors of machines as manufactured, the whole chain of each closed; (places, N) array [mm].

        Parameters
            input_angle : (places,) array [rad]
            parts : errors of all machines by source; of pins and gears vectors
        """
        chain = self.chain(input_angle, torque_sign)
        output = self.output(input_angle[:, None])
        errors: list[Any] = []
        for source in self.sources:
            error = parts[source.key]
            if source.coordinates == 2 and not self.moves.is_vector(source):
                error = np.real(error)
            errors += [(shift, error) for shift in self.shifts(source, chain.mechanism)]
        return chain.output(lambda made: output(made, parts), errors, output)

    # Torque and backlash

    @property
    def backlash(self) -> dict[str, float]:
        """Circumferential backlash of each mesh on the way [mm]."""
        return {}

    @property
    def dead_band(self) -> float | None:
        """How far the output jumps where its torque turns [mm]."""
        return sum(self.backlash.values()) if self.backlash else None

    @property
    def jump(self) -> float:
        """How far it jumps where inertia, friction and load turn [mm]."""
        return self.dead_band or 0.0

    @property
    def flips(self) -> list[float] | None:
        """Input angles at which the output's torque turns [rad]."""
        return None

    # The budget

    @cached_property
    def section(self) -> Register:
        """The section `register`, empty where the file has none.

        Raises
            NoSolution - for keys that this machine does not take
        """
        given = self.spec.register_
        if given is None:
            return Register()
        if not self.has_outputs:
            for key in ("output", "direction"):
                if getattr(given, key) is not None:
                    message = f"{key} belongs to machines with several outputs: here {self.words} counts, omit it"
                    raise NoSolution(message, key=f"register.{key}")
        section: Register = given
        return section

    @cached_property
    def sources(self) -> tuple[Scatter, ...]:
        """The sources of the file."""
        if self.spec.tolerance is None:
            raise MissingSection("`register` needs tolerance: {sources: {...}}", key="tolerance.sources")
        return scatters(self.spec.tolerance, self.spec, self.parts)

    def require_named(self) -> None:
        """Refuse sources, meshes and places that the machine does not have."""
        if self.spec.register_ is None:
            self.require_parts(self.spec.tolerance)
        else:
            _ = self.sources, self.correlations, self.backlash
            self.contributions(self.input_angles[:1], SIGNS[0])

    def require_parts(self, section: Tolerance | None) -> None:
        """Refuse pins, gears and centre distances that the machine does not have.

        Raises
            WrongStudy - GL170, GL171, at its source
        """
        parts = {} if section is None else {key: one for key, one in section.sources.items() if is_of_parts(key, one)}
        if section is not None and parts:
            scatters(section.model_copy(update={"sources": parts}), self.spec, self.parts)

    @cached_property
    def correlations(self) -> dict[tuple[str, str], float]:
        """How sizes scatter together."""
        return of_sizes(self.spec.tolerance, self.sources)

    @cached_property
    def place(self) -> str | float:
        """Where the register is asked for: a name, or an input angle [deg]."""
        at = self.default_at if self.section.at is None else self.section.at
        try:
            angle = float(at)
        except ValueError:
            return at
        return angle if math.isfinite(angle) else str(at)

    @cached_property
    def input_angles(self) -> Reals:
        """Input angles of the stretch [rad], every half degree; one alone where an angle is asked for."""
        if isinstance(self.place, float):
            return np.array([math.radians(self.place)])
        start, end = self.stretch(self.place)
        if start == end:
            return np.array([start])
        count = max(2, math.ceil((end - start) / _STEP) + 1)
        return np.linspace(start, end, count)

    def _budget(self, sign: int) -> Budget:
        start = 0 if self.input_angles.size > 1 else None
        return budget(self.contributions(self.input_angles, sign), start, self.correlations)

    @cached_property
    def budgets(self) -> tuple[Budget, Budget]:
        """The budget for either sign of the torque on the output."""
        return self._budget(1), self._budget(-1)

    @cached_property
    def worst(self) -> list[float]:
        """Maximum error where all sources add up [mm]."""
        return [float(one.worst.max()) for one in self.budgets]

    @cached_property
    def rss(self) -> list[float]:
        """Maximum standard deviation of the error [mm]."""
        return [float(one.rss.max()) for one in self.budgets]

    @property
    def titles(self) -> Mapping[str, str]:  # type: ignore[override]
        """What its band is of."""
        return _TITLES.get(self.section.method, {})

    @cached_property
    def band(self) -> list[float]:
        """What 99.73 % of the machines keep, of `register.method` worst all of them, to either side [mm]."""
        if self.section.method == "worst":
            return self.worst
        if self.section.method == "mc":
            return self.sampled_band
        return [float(one.band.max()) for one in self.budgets]

    @property
    def kept(self) -> list[float]:
        """The band that is judged [mm]: by `register.method` rss not more than the sources add up to."""
        return self.band if self.section.method != "rss" else [float(one.kept.max()) for one in self.budgets]

    @cached_property
    def sampled_places(self) -> Reals:
        """Input angles at which samples are closed [rad]: some of the stretch, its ends, the largest budget."""
        count = self.input_angles.size
        even = np.linspace(0, count - 1, min(count, _PLACES)).astype(int)
        largest = [int(np.argmax(one.band)) for one in self.budgets]
        chosen: Reals = self.input_angles[np.unique([*even, *largest])]
        return chosen

    @cached_property
    def own_errors(self) -> list[list[Contribution]]:
        """What the machine adds there to the sources of the file, for either torque sign, as it counts over them."""
        chosen, keys = self.sampled_places, {one.key for one in self.sources}
        start = 0 if chosen.size > 1 else None
        every = [self.contributions(chosen, sign) for sign in SIGNS]
        return [[replace(one, gain=counted(one, start)) for one in row if one.source not in keys] for row in every]

    @cached_property
    def sampled_band(self) -> list[float]:
        """What 99.73 % of the samples of the whole chain keep, to either side, for either torque sign [mm]."""
        _ = self.correlations, self.input_angles  # refused before anything is sampled
        model = type(self.spec)
        text = str(self.spec.model_dump_json(exclude_unset=True, exclude_none=True, by_alias=True))
        share = partial(_share_of, type(self), model, text) if is_shared() else self.sampled_share
        largest = np.sort(np.concatenate(list(of_replications(share)), axis=2), axis=2)
        return [float(one.max()) for one in largest[:, :, -self._beyond]]

    @property
    def _sample_count(self) -> int:
        return rounded_up(self.spec.tolerance.samples or _SAMPLES)

    @property
    def _beyond(self) -> int:
        """Samples that the band leaves out, and the one on it."""
        return self._sample_count - math.ceil(_KEPT * self._sample_count) + 1

    def sampled_share(self, number: int) -> Reals:
        """The largest errors of one replication at the places of the samples; (2, places, n) array [mm]."""
        section, chosen, own = self.spec.tolerance, self.sampled_places, self.own_errors
        width = sum(one.coordinates for one in self.sources)
        points = replication(width + len(own[0]), self._sample_count, section.seed, number)
        found: list[Reals] = [np.empty((chosen.size, 0))] * 2
        missed = np.zeros((2, chosen.size))
        for some in (points[start : start + _AT_ONCE] for start in range(0, len(points), _AT_ONCE)):
            parts = deviations_of(self.sources, together(some[:, :width], coordinate_root(section, self.sources)))
            errors = np.zeros(0)
            for k, (sign, beside) in enumerate(zip(SIGNS, own, strict=True)):
                if k == 0 or self.chain(chosen, sign) is not self.chain(chosen, SIGNS[0]):
                    errors = self.sampled_errors(chosen, sign, parts)
                    if chosen.size > 1:
                        errors = errors - errors[0]
                missed[k] += np.isnan(errors).sum(axis=1)
                off = np.abs(errors + _scattered(beside, some[:, width:]))
                found[k] = np.sort(np.concatenate([found[k], off], axis=1), axis=1)[:, -self._beyond :]
        for sign, count in zip(SIGNS, missed, strict=True):
            self._require_closed(float(count.max()) / len(points), sign)
        return np.array(found)

    def _require_closed(self, share: float, sign: int) -> None:
        """Refuse a band outside of which no samples could lie but those that do not close, of a share of them."""
        if share > 1.0 - _KEPT:
            first = max(self.budgets[SIGNS.index(sign)].rows, key=lambda row: row.limit * abs(row.gain)).source
            limit = short(100.0 * (1.0 - _KEPT))
            message = f"samples too far off nominal to be closed: {short(100.0 * share)} % (limit <= {limit} %)"
            raise NoSolution(message, key="tolerance.sources", fix=f"tighten {first}, which moves the output most")

    # Tables

    def table_budget(self, _samples: int | None = None) -> Table:
        """Every source where the whole is largest, for either torque sign where they differ, the maximum first."""
        both = list(zip(SIGNS, self.budgets, strict=True))
        if are_alike(*self.budgets):
            both = both[:1]
        rows = [(sign, row) for sign, one in both for row in sorted(one.rows, key=lambda row: -row.share)]
        return budget_table("torque_sign", rows)

    def table_cycle(self, samples: int | None = None) -> Table:
        """Absolute error over the whole cycle, for either torque sign; the band by rss, whatever the method."""
        both, columns = self._over_cycle(samples)
        found = [budget(each, None, self.correlations) for each in both]
        columns["worst"] = np.concatenate([one.worst for one in found]), "mm"
        columns["band"] = np.concatenate([one.band for one in found]), "mm"
        return Table.of("cycle", columns)

    def table_sources(self, samples: int | None = None) -> Table:
        """What each source costs at its limit over the whole cycle, absolute, for either torque sign."""
        both, columns = self._over_cycle(samples)
        for pair in zip(*both, strict=True):
            columns[pair[0].source] = (np.concatenate([one.limit * np.abs(one.gain) for one in pair]), "mm")
        return Table.of("sources", columns)

    def _over_cycle(self, samples: int | None) -> tuple[list[list[Contribution]], dict[str, tuple[Any, str]]]:
        """Every source over the cycle, for either torque sign, and the first columns of a table of them."""
        degrees = self.cycle_degrees(samples)
        signs, inputs = np.repeat(np.array(SIGNS), degrees.size), np.tile(degrees, 2)
        both = [self.contributions(np.radians(degrees), sign) for sign in SIGNS]
        return both, {"torque_sign": (signs, "1"), "input_angle": (inputs, "deg")}

    # Checks

    def check_register_budget(self) -> Iterator[Check]:
        """GL520 where the file names what may be lost."""
        limit = self.section.tolerance
        if limit is None:
            return
        band, worst = max(self.kept), max(self.worst)
        status: Status = "fail" if band > limit else "warn" if worst > limit else "pass"
        fix = "" if status == "pass" else self._tighter(limit, at_worst=status == "warn")
        share = ALL if self.section.method == "worst" else MOST
        yield budget_check(status, f"register error {self._where}", band, worst, limit, fix, share=share)

    def _tighter(self, limit: float, *, at_worst: bool) -> str:
        """The sources that are to be tightened, and how much; where the band is one of samples, by their budget."""
        start = 0 if self.input_angles.size > 1 else None
        every = [self.contributions(self.input_angles, sign) for sign in SIGNS]
        if self.section.method == "mc" and not at_worst:
            limit *= max(float(one.kept.max()) for one in self.budgets) / max(self.band)
        at_worst = at_worst or self.section.method == "worst"
        return tighter(tightened(every, start, self.correlations, limit, at_worst=at_worst), len(every[0]))

    @property
    def _where(self) -> str:
        if isinstance(self.place, float):
            return f"at {self.place:g} deg"
        return f"{'over' if self.input_angles.size > 1 else 'at'} the {self.place}"

    @property
    def judges_flips(self) -> bool:
        """Whether places at which the torque turns are a finding."""
        return True

    def check_backlash_in_dwell(self) -> Iterator[Check]:
        """GL521 where the torque on the output turns within the stretch."""
        flips = self.flips if self.judges_flips else None
        if flips is None or self.input_angles.size == 1:
            return
        start, end = float(self.input_angles[0]), float(self.input_angles[-1])
        inside = [flip for flip in flips if (flip - start) % (2.0 * math.pi) < end - start]
        if not inside:
            what = f"the {self.turning} keeps its sign {self._where}"
            yield BACKLASH_IN_DWELL.check("pass", what, 0.0, 0.0, shown=NO_NUMBER)
            return
        places = ", ".join(short(math.degrees(flip)) for flip in inside)
        what, note = f"the {self.turning} reverses {self._where}", ""
        if self.jump:
            note = f"the output jumps by {short(self.jump)} mm there"
        yield BACKLASH_IN_DWELL.check(
            "warn",
            what,
            float(len(inside)),
            0.0,
            shown=NO_NUMBER,
            at=f"{places} deg",
            fix=self.against_flips,
            note=note,
        )

    @property
    def against_flips(self) -> str:
        """What keeps the torque's sign."""
        return "brake the output, or preload the gears"


def are_alike(one: Budget, other: Budget) -> bool:
    """Whether nothing depends on the flank that carries: what is below rounding is not the flank's."""
    return all(
        np.allclose(a, b, rtol=1e-9, atol=1e-12, equal_nan=True)
        for a, b in ((one.band, other.band), (one.worst, other.worst))
    )


def contribution(source: Scatter, gain: Any) -> Contribution:
    """A source with its gain; what has a direction is 0 on average."""
    mean = source.law.moments()[0] if source.coordinates == 1 else 0.0
    limit, sigma, unit = source.limit, source.sigma, source.unit
    return Contribution(source.key, np.asarray(gain), limit, sigma, mean, keeps=source.keeps_limit, unit=unit)


def no_such_place(at: str, known: Sequence[str]) -> NoSolution:
    """A place that the machine does not have."""
    return NoSolution(
        f"no position {named(at)} here", key="register.at", fix=f"give {', '.join(known)} or an input angle in degrees"
    )


SIGNS = (1, -1)
MOST, ALL = "99.73 %", "worst case"
"""Which of the machines a band is of."""
_SAMPLES = 16_384
_AT_ONCE = 8192
"""Samples that are closed together: memory does not grow with their number."""
_KEPT = 0.9973
_TITLES = {"worst": {"band": "register, all of the machines"}, "mc": {"band": "register, 99.73 % of the samples"}}
"""What a band is of by `register.method`, where that is not the usual one."""
_PLACES = 13


@lru_cache(maxsize=4)
def _made(register: type[RegisterDesign], model: type[Any], text: str) -> RegisterDesign:
    return register(model.model_validate_json(text))


def _share_of(register: type[RegisterDesign], model: type[Any], text: str, number: int) -> Reals:
    made = _made(register, model, text)  # type: ignore[arg-type]  # mypy takes a class for unhashable
    return made.sampled_share(number)


def _scattered(own: Sequence[Contribution], points: Reals) -> Any:
    """Errors by gains: what all machines have alike, and normal scatter about it; (places, N) array."""
    found: Any = 0.0
    for one, share in zip(own, points.T, strict=True):
        law = Law("normal", -one.limit, one.limit, one.mean, one.sigma)
        found = found + np.real(one.gain)[:, None] * law.deviations(share)
    return found


def tighter(found: tuple[list[str], float], sources: int) -> str:
    """The fix of GL520, of what `tightened` finds among so many sources."""
    names, percent = found
    every_one = len(names) == sources > 1
    which = "all sources" if every_one else " and ".join(filter(None, (", ".join(names[:-1]), names[-1])))
    return f"tighten {which} to {safely_below(percent)} % of {'their' if len(names) > 1 else 'its'} limits"


def budget_check(
    status: Status, what: str, band: float, worst: float, limit: float, fix: str, *, at: str = "", share: str = MOST
) -> Check:
    """GL520 of a band that a share of the machines keeps and a worst case [mm], of which alone a warning is."""
    warned = status == "warn"
    shown = Shown(worst if warned else band, limit, "mm", "<=")
    aside = "" if share == ALL else f"{share} {short(band)} mm" if warned else f"{ALL} {short(worst)} mm"
    called = f"{what}, {ALL if warned else share}"
    return REGISTER_BUDGET.check(status, called, band, limit, "mm", shown=shown, aside=aside, at=at, fix=fix)


def _turned(x: Course, y: Course, angle: float) -> Course:
    """A point along a direction, from its coordinates."""
    if angle == 0.0:
        return x
    along, across = math.cos(angle), math.sin(angle)
    return Course(
        x.unit,
        lambda mechanism: [
            along * np.asarray(a) + across * np.asarray(b)
            for a, b in zip(x.of(mechanism), y.of(mechanism), strict=True)
        ],
    )


class MotionRegister(RegisterDesign):
    """Error of the first output of a motion, at a radius where it turns, over the range of the input or at one place.

    Parameters
        spec : spec of a kind that has a motion
    """

    kind = ""  # that of its design file
    default_at = "range"
    has_outputs = True

    def __init__(self, spec: Any) -> None:
        kind = KINDS[spec.kind]
        spec = kind.completed(spec)  # the links that it finds are what scatters
        super().__init__(spec)
        self.record = kind
        self.kind = kind.name  # type: ignore[misc]  # of a class that serves all kinds

    @cached_property
    def design(self) -> Design:
        """The geometry of the same file."""
        found: Design = self.of_file(self.record.class_for("analyze", self.spec))
        return found

    @cached_property
    def motion(self) -> Motion:
        """The motion of the design.

        Raises
            NoSolution - where a slide is its input
        """
        found = self.design.moving
        if found.input.unit != "rad":
            message = "a register is taken over an input angle"
            raise NoSolution(message, key="drive.slide", fix="drive a link instead of a slide")
        return found

    @cached_property
    def course(self) -> Course:
        """The output: the first one, or that of `register.output`; of a point along its direction.

        Raises
            NoSolution - for an output that the machine does not have
        """
        found = {each.name.replace(", ", " "): each.course for each in self.motion.outputs}
        names = list(dict.fromkeys(name.removesuffix(" x").removesuffix(" y") for name in found))
        name = names[0] if self.section.output is None else self.section.output
        if name not in names:
            message = f"no output {named(name)} here: it has {', '.join(names)}"
            raise NoSolution(message, key="register.output")
        direction = self.section.direction
        if f"{name} y" not in found:
            if direction is not None:
                raise NoSolution(f"direction belongs to a point: {name} is none", key="register.direction")
            return found[name]
        return _turned(found[f"{name} x"], found[f"{name} y"], math.radians(direction or 0.0))

    @property
    def _turns(self) -> bool:
        return self.course.unit == "rad"

    @cached_property
    def _at_start(self) -> Mechanism:
        return self.motion.make(np.array([self.motion.input.start]), 1, 1)

    @cached_property
    def movable(self) -> Movable:
        """What its sources move."""
        found: Movable = self.record.movable(self.design, self._at_start)
        return found

    @cached_property
    def parts(self) -> Parts:
        """Centre distances, pins and gears."""
        pins = tuple(each.name for each in self._at_start.connections if isinstance(each, Pin))
        gears = {name: gear.teeth for name, gear in self.movable.gears.items()}
        return Parts(dict(self.movable.centers), pins + self.movable.rollers, gears, dict(self.movable.others))

    errors: Errors = placed("movable.sizes")
    pins: ClassVar[Errors] = placed("movable.pins")

    @property
    def gears(self) -> dict[str, str]:  # type: ignore[override]
        """By gear, its link."""
        return {name: gear.link for name, gear in self.movable.gears.items()}

    @cached_property
    def radius(self) -> float:
        """Radius at which the error of an output that turns is measured [mm]; of one that slides 1."""
        if not self._turns:
            if self.section.radius is not None:
                raise NoSolution("radius belongs to an output that turns: this one slides", key="register.radius")
            return 1.0
        radius = self.section.radius or self.movable.radius
        if not radius:
            raise MissingSection(
                "the register of an output that turns needs a radius",
                key="register.radius",
                fix="give register.radius (mm), the radius at which its error is measured, or --radius",
            )
        return radius

    def mechanism(self, input_angle: Reals) -> Mechanism:
        return self.motion.make(input_angle, 1, 1)

    def output(self, _input_angle: Reals) -> Output:
        """The output [mm]; what an error adds to it by itself stands in `parts`."""
        course, radius, own = self.course, self.radius, self.movable.own

        def output(mechanism: Mechanism, parts: Off = None) -> Sequence[Reals]:
            value, *rates = (radius * np.asarray(rate) for rate in course.of(mechanism))
            for key, error in (parts or {}).items():
                if key in own:
                    value = value + radius * error * own[key].of(mechanism)[0]
            return [value, *rates]

        return output

    def own_gain(self, key: str, input_angle: Reals) -> Reals | None:
        """Gain of a size that places the output on its link."""
        if key not in self.movable.own:
            return None
        return np.asarray(self.radius * self.movable.own[key].rates(self.motion, input_angle, 0)[0])

    def stretch(self, at: str) -> tuple[float, float]:
        """The whole range of the input, or its period; or a part of it that the kind names."""
        places = self.movable.places
        if at in places:
            return places[at]
        if at != "range":
            raise no_such_place(at, ("range", *places))
        return self.motion.input.start, self.motion.input.end

    def cycle_degrees(self, samples: int | None) -> Reals:
        """Inputs of tables over the cycle: a period, or the range."""
        given = self.motion.input
        if given.turns is not None:
            return turn_degrees(samples, given.turns)
        return np.degrees(np.linspace(given.start, given.end, samples or 361))

    # Torque and backlash

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, the backlash of the meshes, and the wind-up of the output's shaft."""
        gains = self.gains(input_angle, torque_sign)
        found = self.of_sources(gains, input_angle) + gains.backlash(self.backlash)
        if self.section.cam_error is not None:
            found += [gains.profile(roller, self.section.cam_error) for roller in self._rollers]
        if self.section.stiffness is not None and self._carries:
            lag = -self.radius * self.output_torque(input_angle) / torsional_stiffness(self.section.stiffness)
            found.append(Contribution("wind-up of the output shaft", lag, 1.0, 0.0, mean=1.0))
        return found

    @cached_property
    def backlash(self) -> dict[str, float]:
        meshes = tuple(each.name for each in self._at_start.connections if isinstance(each, Toothed))
        if not meshes and self.section.backlash is not None:
            raise NoSolution("no mesh lies on the way to the output", key="register.backlash", fix="omit backlash")
        return self.section.backlash_of(meshes)

    @cached_property
    def _rollers(self) -> list[str]:
        """The contacts with cams."""
        found = [each.name for each in self._at_start.connections if isinstance(each, (Contact, SharedContact))]
        if not found:
            raise NoSolution("no cam lies on the way to the output", key="register.cam_error", fix="omit cam_error")
        return found

    @cached_property
    def dead_band(self) -> float | None:
        """How far the output jumps where its torque turns, at most over the stretch [mm]."""
        if not self.backlash:
            return None
        gains = self.gains(self.input_angles, 1)
        jumps = [play * np.abs(gains.dual.play(mesh)) for mesh, play in self.backlash.items()]
        return float(np.sum(jumps, axis=0).max())

    @property
    def _carries(self) -> bool:
        """Whether the file tells of a torque on the output."""
        section = self.section
        given = [name for name in ("output_inertia", "friction", "load", "stiffness") if getattr(section, name)]
        if given and not self._turns:
            raise NoSolution(f"{given[0]} belongs to an output that turns: this one slides", key=f"register.{given[0]}")
        return any(name != "stiffness" for name in given)

    @property
    def _inertia(self) -> float:
        """Torque of the output's inertia per 1/rad of its acceleration ratio [N m].

        Raises
            NoSolution - where it is weighed against friction and load without a speed
        """
        section, speed = self.section, getattr(self.spec, "input_speed", None)
        if section.output_inertia is None:
            return 0.0 if section.friction or section.load else 1.0
        if speed is None:
            if section.friction or section.load or section.stiffness is not None:
                raise NoSolution("the torque of the output's inertia needs input_speed (1/min)", key="input_speed")
            return 1.0
        inertia: float = section.output_inertia * (speed * RPM) ** 2
        return inertia

    def output_torque(self, input_angle: Reals) -> Reals:
        """Torque on the output in the sense in which it counts, over (N,) inputs [rad]; (N,) array [N m].

        T = J W' w^2 + T_f sign(W) + T_load; where the file has none of them, W' alone
        """
        _, rate, second = self.course.rates(self.motion, input_angle, 2)
        section = self.section
        return np.asarray(self._inertia * second + section.friction * np.sign(rate) + section.load)

    @cached_property
    def flips(self) -> list[float] | None:
        """Inputs at which the torque on the output turns [rad]; by inertia alone where W' does."""
        _, given = self._carries, self.motion.input
        found = zeros(
            lambda q: self.output_torque(q + given.start),
            given.end - given.start,
            max(1, math.ceil((given.end - given.start) / (2.0 * math.pi) - 1e-9)),
        )
        return [given.start + place for place in found]

    @property
    def judges_flips(self) -> bool:
        """Where the file tells of backlash or of what the output carries."""
        return bool(self.backlash) or self._carries
