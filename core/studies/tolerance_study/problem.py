"""A tolerance study made ready: the nominal design with its links, its sources as random numbers, its requirements."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from gearlink.core.base.design import Design
from gearlink.core.base.design_axis import Evaluated
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.spec_paths import number_at, numbers_at, part_at, unit_at
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.studies.explore.base import Base, Refused
from gearlink.core.studies.explore.requirements import (
    Condition,
    FaultFound,
    Names,
    beyond_lists,
    condition,
    no_lists,
    odd_comparisons,
)
from gearlink.core.studies.study.faults import Fault, Place, WrongStudy
from gearlink.core.studies.tolerance.correlation import coordinate_root, together
from gearlink.core.studies.tolerance.sampling import SCALAR_SAMPLES
from gearlink.core.studies.tolerance.sources import Parts, Scatter, deviations_of, is_of_parts, scatters
from gearlink.core.studies.tolerance.spec import Tolerance, ToleranceSource

MOST_WITH_INDICES = 32
_STUDIES = ("tolerance", "register")
_ABOUT = (*_STUDIES, "loads")  # commands about a design, and their sections: no sample is for them


@dataclass(frozen=True)
class Problem:
    """A study that can be computed.

    Parameters
        base : Base - of the nominal design, its links in the file
        nominal : Design - of that base
        axis : ToleranceAxis or None - of kinds that compute many designs at once
        asked : Base - as the file has it, with what it asks to be searched for
        commands : of the file
    """

    base: Base
    nominal: Design
    section: Tolerance
    axis: ToleranceAxis | None
    asked: Base
    commands: tuple[str, ...]

    @cached_property
    def sources(self) -> tuple[Scatter, ...]:
        """The sources whose scatter changes the design; parts that no key of the file names count in `register`.

        Raises
            WrongStudy - GL170 where none is left, GL171 for a measured size that no design has
        """
        parts = Parts({}) if self.axis is None else self.axis.parts
        given = self.section.sources
        counted = {key: one for key, one in given.items() if not self._is_of_register(key, one)}
        if len(counted) < len(given):
            register: Any = self.nominal.of_command("register")
            register.require_parts(self.section)
        found: tuple[Scatter, ...] = ()
        for key in counted:
            self._found_once(key)
        if counted or not given:
            found = scatters(self.section.model_copy(update={"sources": counted}), self.base.spec(), parts)
        found = tuple(one for one in found if one.kind != "gear")
        if not found:
            message = f"{' and '.join(given)} {'count' if len(given) > 1 else 'counts'} in `register` alone"
            message += "\nname a size of the file"
            raise no("GL170", message, "sources")
        for one in found:
            self._possible(one)
        return found

    def _found_once(self, key: str) -> None:
        """Refuse a requirement: samples keep what was found for it."""
        spec = self.base.spec()
        if number_at(self.asked.spec(), key) is None or number_at(spec, key) is not None:
            return
        found = [path for one in self.asked.design().as_found() for path in numbers_at(spec, one.path)]
        sizes = [path for path in found if isinstance(number_at(spec, path), float) and unit_at(spec, path)]
        sizes = [path for path in sizes if not path.startswith(("limits", "dwell_"))]
        message = f"{key} is a requirement: samples keep what was found for it\nname one of {', '.join(sizes)}"
        raise no("GL170", message, "sources", key)

    def _possible(self, one: Scatter) -> None:
        """Refuse a measured size that the key cannot have."""
        if one.entry.measured is None or one.kind != "size":
            return
        if message := self.base.takes([(one.key, one.entry.measured)]):
            raise no("GL171", f"measured {one.entry.measured:g}: {message}", "sources", one.key)

    @property
    def of_register_alone(self) -> bool:
        """Whether no source changes the samples."""
        runout = ("grade", "eccentricity")
        return all(self._is_of_register(key, one) or one.form in runout for key, one in self.section.sources.items())

    def _is_of_register(self, key: str, entry: ToleranceSource) -> bool:
        """Parts that the register of a machine counts and its analysis does not know."""
        return self.axis is None and "register" in self.base.kind.commands and is_of_parts(key, entry)

    @property
    def coordinates(self) -> int:
        """Random numbers of a sample."""
        return sum(one.coordinates for one in self.sources)

    @cached_property
    def judged_codes(self) -> frozenset[str]:
        """Codes of the findings of the nominal design."""
        checks = self.nominal.outline(self.base.command).checks
        return frozenset(check.code for name in checks for check in self.nominal.check(name))

    @cached_property
    def requirements(self) -> tuple[Condition, ...]:
        """The lines of `require`.

        Raises
            WrongStudy - at the line
        """
        known = {*self.base.places, *(self.axis.extra if self.axis is not None else ())}
        names = Names(self.base.unit, frozenset(known), {}, self.base.nearest)
        found = []
        for i, text in enumerate(self.section.require):
            try:
                one = condition(text, names, ("tolerance", "require", i))
            except FaultFound as error:
                raise WrongStudy(error.faults) from error
            self._comparable(one, i)
            found.append(one)
        return tuple(found)

    def _comparable(self, one: Condition, place: int) -> None:
        """Words are compared with words, numbers with numbers, lists by entries that they have.

        Raises
            WrongStudy - GL152, also for what the nominal design does not have
        """
        at = ("tolerance", "require", place)
        names = list(one.expression.names)
        whole = self._nominal_values({name.partition("[")[0] for name in names}, at)
        kind = self.base.kind.name
        faults = [*no_lists(names, whole, at), *beyond_lists(names, whole, at, kind)]
        if not faults:
            values = self._nominal_values(names, at)
            faults = [*_absent(values, at), *odd_comparisons(one, names, values, at, kind)]
        if faults:
            raise WrongStudy(faults)

    def _nominal_values(self, names: Iterable[str], at: Place) -> dict[str, Any]:
        """Quantities of the nominal design; those that only samples have count as numbers."""
        own = () if self.axis is None else self.axis.extra
        try:
            found = self.base.values(self.nominal, [name for name in names if name not in own])
        except Refused as error:
            message = f"the nominal design does not give it: {error}"
            raise WrongStudy([Fault("GL152", message, at)]) from error
        return found | {name: 0.0 for name in names if name in own}

    @cached_property
    def not_sampled(self) -> list[tuple[str, str]]:
        """What of the file no sample knows, with the reason: sources, checks, commands with checks of their own."""
        of_register = [key for key, one in self.section.sources.items() if self._is_of_register(key, one)]
        why = "no sample differs by it: it counts in `register` alone"
        if "errors" in type(self.asked.spec()).model_fields:
            why += ", or as errors.profile here, with lift_error_worst in require"
        return [*((key, why) for key in of_register), *self._of_requests(), *self._of_other_commands()]

    def _of_requests(self) -> Iterator[tuple[str, str]]:
        """Checks that judge what the search was asked for: its results alone are made, and are not sought again."""
        design, command = self.asked.design(), self.asked.command
        asked = [
            one.path
            for one in design.as_found()
            if one.value is None and part_at(self.asked.data, one.path) is not None
        ]
        if not asked:
            return
        left: dict[str, str] = {}
        for name in design.outline(command).checks:
            left |= {check.code: name for check in design.check(name) if check.code not in self.judged_codes}
        for code, name in left.items():
            yield (
                code,
                f"{name} evaluates the search for {' and '.join(asked)}, done once: evaluate samples by a line "
                f"of require",
            )

    def _of_other_commands(self) -> Iterator[tuple[str, str]]:
        spec, kind = self.asked.spec(), self.base.kind
        sampled = {name for names in self.base.codes.values() for name in names}
        for command in self.commands:
            if command in (self.asked.command, *_STUDIES):
                continue
            if not sampled.issuperset(kind.design_class(command).judged(command, spec)):
                why = "samples carry no loads" if command in _ABOUT else "tolerance.command may name this command"
                yield command, f"its checks evaluate no sample: {why}"

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Quantities whose scatter is shown: those of the requirements, else the numbers that the command shows."""
        wanted = dict.fromkeys(name for one in self.requirements for name in one.expression.names)
        if wanted:
            return tuple(wanted)
        outline = self.nominal.outline(self.base.command).quantities
        plain = [name for name in outline if isinstance(self._nominal_value(name), float)]
        return tuple(plain)

    def _nominal_value(self, name: str) -> Any:
        try:
            return self.nominal.raw(name)
        except NoSolution:
            return None

    @cached_property
    def is_quick(self) -> bool:
        """Whether all samples are computed over arrays."""
        keys = [one.key for one in self.sources]
        return self.axis is not None and self.axis.serves(keys, self.quick_names)

    @cached_property
    def quick_names(self) -> tuple[str, ...]:
        """The quantities, less those that no source of an array form changes."""
        if self.axis is None:
            return self.names
        keys = [one.key for one in self.sources]
        served = [name for name in self.names if self.axis.serves(keys, [name])]
        asked = {name for one in self.requirements for name in one.expression.names}
        return tuple(name for name in self.names if name in served or name in asked)

    @property
    def samples(self) -> int:
        """Samples that are asked for."""
        usual = self.axis.samples if self.axis is not None and self.is_quick else SCALAR_SAMPLES
        return self.section.samples or usual

    # Random numbers to sizes

    @cached_property
    def correlation(self) -> Reals | None:
        """What makes normal coordinates scatter together; None where all are independent."""
        return coordinate_root(self.section, self.sources)

    def sizes(self, points: Reals) -> dict[str, Reals | Points]:
        """Sizes as manufactured of random numbers.

        Parameters
            points : (N, coordinates) array - in (0, 1)
        Returns
            columns : (N,) arrays by source - as `gearlink.core.studies.tolerance_study.problem` wants them
        """
        found = deviations_of(self.sources, together(points, self.correlation))
        return {one.key: one.nominal + found[one.key] for one in self.sources}

    def offsets(self, shifts: Sequence[Mapping[str, complex]]) -> dict[str, Reals | Points]:
        """Sizes that differ from nominal by given amounts, an element each."""
        return {
            one.key: np.array([one.nominal + shift.get(one.key, 0.0) for shift in shifts])
            if one.kind == "pin"
            else np.array([one.nominal + np.real(shift.get(one.key, 0.0)) for shift in shifts])
            for one in self.sources
        }


def _absent(values: Mapping[str, Any], at: Place) -> list[Fault]:
    """Quantities that the nominal design does not have: a design as made that meets a requirement on them is chance."""
    return [
        Fault("GL152", f"{name} does not apply to the nominal design", at, f"gearlink explain {name.partition('[')[0]}")
        for name, value in values.items()
        if value is None
    ]


def problem(spec: Any) -> Problem:
    """Make the study of a design file ready.

    Parameters
        spec : a spec with the section `tolerance`
    Raises
        NoSolution - where the nominal design does not exist, or the section asks for what it does not have
    """
    section: Tolerance = spec.tolerance
    data = spec.model_dump(mode="json", exclude_unset=True, by_alias=True)
    for key in _ABOUT:
        data.pop(key, None)
    asked = section.command or next(one for one in spec.commands() if one not in _ABOUT)
    kind = KINDS[data["kind"]]
    if asked not in kind.commands or asked in _ABOUT:
        known = ", ".join(one for one in kind.commands if one not in _ABOUT)
        raise NoSolution(
            f"no samples for the command {asked!r} of {kind.name}", key="tolerance.command", fix=f"use {known}"
        )
    try:
        given = Base(data, asked)
        base, nominal = _with_links(given)
    except (Refused, NoSolution) as error:
        missing = error.code == MissingSection.code and section.command is not None
        raise NoSolution(str(error), key="tolerance.command" if missing else error.key) from error
    samples = kind.samples_maker()
    axis = None if samples is None else samples(nominal)
    return Problem(base, nominal, section, axis, given, tuple(spec.commands()))


def _with_links(given: Base) -> tuple[Base, Design]:
    """A synthesis, a search for a target or a rule is done once: what it finds becomes keys of the file."""
    design = given.design()
    found = list(design.as_found())
    command = "analyze" if given.command.startswith("synth") else given.command
    base = Base(given.changed((one.path, one.value) for one in found), command, warnings=False)
    as_given = not found and command == given.command
    return base, design if as_given else replace(base, warnings=True).design()


def no(code: str, message: str, *place: str | int) -> WrongStudy:
    """What is wrong at a key of the section."""
    return WrongStudy([Fault(code, message, ("tolerance", *place))])


class ToleranceAxis(Protocol):
    """Samples of one nominal design.

    parts : centre distances, pins and gears that may scatter beside the keys of the file; extra : quantities that only
    samples have; reference : input angle at which designs as made and nominal design are set to agree [deg], None: as
    they are; course_units : of an output that `course` gives, "deg" and perhaps "mm"
    """

    parts: Parts
    extra: tuple[str, ...]
    course_units: tuple[str, ...]

    @property
    def samples(self) -> int:
        """Samples by default: `ARRAY_SAMPLES`, less of a form that takes longer."""
        ...

    @property
    def reference(self) -> float | None:
        """Where the outputs are set to agree."""
        ...

    def serves(self, keys: Sequence[str], names: Sequence[str]) -> bool:
        """Whether these sources and quantities can be computed over arrays."""
        ...

    def sets(self, key: str) -> bool:
        """Whether a source is a size that `design` sets; the others are keys of the file."""
        ...

    def design(self, values: Mapping[str, Any], cut: Any = None) -> Any:
        """The design of one sample, of the class that computes it alone.

        Parameters
            values : by source, of those that it sets
            cut : the design with the sample's other keys; None: the nominal one
        """
        ...

    def evaluate(self, columns: Mapping[str, Reals | Points], names: Sequence[str]) -> Evaluated:
        """The designs as manufactured.

        Parameters
            columns : (N,) arrays by source - sizes and centre distances as made, in the unit of the file; of a pin its
                offset as a vector x + i y [mm]
            names : of quantities
        Returns
            evaluated : Evaluated - findings of every check of the kind's analysis
        """
        ...

    def course(self, columns: Mapping[str, Reals | Points], input_angle: Reals) -> Reals:
        """By how much the outputs lie above that of the nominal design.

        Parameters
            columns : as `evaluate` takes them
            input_angle : (K,) array [rad]
        Returns
            off : (K, N) array [rad] - NaN where a design does not exist
        """
        ...
