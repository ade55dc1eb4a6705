"""From a study file to a problem that can be computed, or to all that is wrong with it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.studies.explore.base import Base, Refused
from gearlink.core.studies.explore.order import Variable
from gearlink.core.studies.explore.problem import Problem, numeric
from gearlink.core.studies.explore.requirements import (
    OF_ANY_LENGTH,
    Condition,
    FaultFound,
    Names,
    Objective,
    beyond_lists,
    condition,
    contradiction,
    no_lists,
    objective,
    odd_comparisons,
)
from gearlink.core.studies.study.expressions import Expression, parse
from gearlink.core.studies.study.faults import Fault, Place, WrongStudy
from gearlink.core.studies.study.spec import StudySpec, VariableSpec

_TRIED_VALUES, _TRIED_LISTED = 100, 1000
_EDGE = 1e-9


def problem_of(canonical: str) -> Problem:
    """The problem of a canonical text."""
    data = json.loads(canonical)
    del data["schema"], data["chunk"]
    return problem(StudySpec.model_validate_json(json.dumps(data)))


def problem(spec: StudySpec) -> Problem:
    """Make a study ready to be computed.

    Parameters
        spec : StudySpec - with its base in `design`
    Raises
        WrongStudy - with all that is wrong
    """
    base = _base(spec)
    reading = _Reading(spec, base)
    variables = tuple(reading.variables())
    names = reading.names()
    objectives, conditions = reading.requirements(names)
    if reading.faults:
        raise WrongStudy(reading.faults)
    must_pass = reading.base_values(objectives, conditions)
    if reading.faults:
        raise WrongStudy(reading.faults)
    return Problem(spec, base, variables, tuple(objectives), tuple(conditions), must_pass)


def _base(spec: StudySpec) -> Base:
    assert spec.design is not None, "the reader puts the file of `of` here"
    kind = spec.design.get("kind")
    if kind not in KINDS:
        raise WrongStudy([Fault("GL156", f"the base design has no kind {kind!r}", ("design", "kind"))])
    probe = Base(spec.design, "")
    try:
        asked = probe.spec().commands()
    except ValueError as error:
        raise WrongStudy([Fault("GL156", f"the base design is wrong: {error}", ("design",))]) from None
    known = tuple(KINDS[kind].commands)
    command = spec.command or next((name for name in asked if name in known), known[0])
    if command not in known:
        message = f"`{command}` does not apply to a {kind}; available for this kind: {', '.join(known)}"
        raise WrongStudy([Fault("GL113", message, ("command",))])
    return Base(spec.design, command, spec.checks.warn_counts)


class _Reading:
    """Reads the parts of a study, and keeps all that is wrong."""

    def __init__(self, spec: StudySpec, base: Base) -> None:
        self.spec, self.base = spec, base
        self.faults: list[Fault] = []
        self._ends: list[list[tuple[str, Any]]] = []  # first and last value of each variable, as changes of the base

    def variables(self) -> Iterator[Variable]:
        """The variables that are in order; of the others a fault each."""
        before: dict[str, Variable] = {}
        taken: dict[str, str] = {}
        for path, given in self.spec.variables.items():
            made = self._variable(path, given, before, taken)
            if made is not None:
                before[path] = made
                yield made

    def _variable(
        self, path: str, given: VariableSpec, before: dict[str, Variable], taken: dict[str, str]
    ) -> Variable | None:
        place = ("variables", path)
        for other, at in ((path, place), *((name, (*place, "also")) for name in given.also)):
            if not self.base.knows(other):
                kind = self.base.kind.name
                helps = self.base.nearest(other, self.base.units)
                self.faults.append(Fault("GL151", f"{other} is not a key of {kind}", at, helps))
                return None
            if other in taken:
                message = f"{other} is given by the variable {taken[other]} already"
                self.faults.append(Fault("GL111", message, at))
                return None
            taken[other] = path
        if given.times is not None and (given.times not in before or not numeric(before[given.times])):
            message = f"{given.times!r} is not a numeric variable listed before {path}"
            self.faults.append(Fault("GL151", message, (*place, "times"), "list it before this variable"))
            return None
        made = self._made(path, given, before)
        wrong = self._refused_value(made, before)
        if wrong is not None:
            self.faults.append(wrong)
            return None
        return made

    def _made(self, path: str, given: VariableSpec, before: dict[str, Variable]) -> Variable:
        also = tuple(given.also)
        if given.values is not None:
            return Variable(path, also, tuple(given.values))
        low, high = given.from_, given.to
        assert low is not None, "the model requires it"
        assert high is not None, "the model requires it"
        whole = self.base.is_whole(path)
        if given.points is not None:
            return Variable(path, also, tuple(_points(low, high, given.points, log=given.log, whole=whole)))
        step = given.step
        if step is None and (whole or low == high):  # a range of one value is no continuum
            step = 1.0
        decimals = _decimals_below(given.times, before)
        return Variable(path, also, (), low, high, step, given.times or "", whole, given.log, decimals)

    def _refused_value(self, variable: Variable, before: dict[str, Variable]) -> Fault | None:
        """What the base has against one of a variable's values, each put in alone."""
        place: tuple[str, ...] = ("variables", variable.path)
        if variable.whole and variable.step is not None and variable.step != int(variable.step):
            return Fault(
                "GL156",
                f"{variable.path} takes whole numbers: its step must be one, not {variable.step:g}",
                (*place, "step"),
            )
        tried = list(_tried(variable, before))
        if not tried:
            return Fault("GL111", f"the range of {variable.path} contains no value", place, "widen it")
        paths = (variable.path, *variable.also)
        self._ends += [[(path, value) for path in paths] for value in (tried[0], tried[-1])]
        for value in tried:
            message = self.base.takes([(path, value) for path in paths])
            if message:
                key = "values" if variable.values else "from" if value == tried[0] else "to"
                at = (*place, key) if self.spec.variables[variable.path].points is None else place
                return Fault("GL156", f"{variable.path} = {value!r} is rejected in the base: {message}", at)
        return None

    def names(self) -> Names:
        """The quantities and what is defined of them."""
        known = frozenset(self.base.places)
        defined: dict[str, Expression] = {}
        wrong: set[str] = set()
        for name, text in self.spec.define.items():
            later = frozenset(self.spec.define) - defined.keys()
            names = Names(self.base.unit, known, dict(defined), self.base.nearest, frozenset(wrong), later)
            place = ("define", name)
            if not name.isidentifier() or name in known:
                message = f"{name!r} is no new name" if name in known else f"{name!r} is no name: letters, digits and _"
                self.faults.append(Fault("GL152", message, place, "choose another name"))
                continue
            try:
                defined[name] = names.expression(text, place)
            except FaultFound as found:
                wrong.add(name)
                self.faults += found.faults
        return Names(self.base.unit, known, defined, self.base.nearest, frozenset(wrong))

    def requirements(self, names: Names) -> tuple[list[Objective], list[Condition]]:
        """Objectives in the order of the file, minimised ones first, and conditions."""
        objectives, conditions = [], []
        for key, sign in (("minimize", 1.0), ("maximize", -1.0)):
            for name, given in getattr(self.spec, key).items():
                if sign < 0.0 and name in self.spec.minimize:
                    self.faults.append(Fault("GL111", f"{name} is already minimised", (key, name)))
                    continue
                try:
                    objectives.append(objective(name, given, sign, names, (key, name)))
                except FaultFound as found:
                    self.faults += found.faults
        for i, text in enumerate(self.spec.where):
            try:
                conditions.append(condition(text, names, ("where", i)))
            except FaultFound as found:
                self.faults += found.faults
        clash = contradiction(conditions)
        if clash is not None:
            first, second = (conditions[i].text for i in clash)
            message = f"no design can meet both `{first}` and `{second}`"
            self.faults.append(Fault("GL111", message, ("where", clash[1]), "widen or omit one of them"))
        return objectives, conditions

    def base_values(self, objectives: list[Objective], conditions: list[Condition]) -> tuple[str, ...]:
        """Compute the base; what its quantities are like, and the codes that must pass."""
        requirements: list[tuple[Objective | Condition, Place]] = [
            *(
                (requirement, ("minimize" if requirement.sign > 0.0 else "maximize", requirement.name))
                for requirement in objectives
            ),
            *((requirement, ("where", i)) for i, requirement in enumerate(conditions)),
        ]
        names = dict.fromkeys(name for requirement, _ in requirements for name in requirement.expression.names)
        entries = [(name, place) for name, place in self._defined_entries() if name not in names]
        try:
            design = self.base.design()
            values = self.base.values(design, names)
            every = [*names, *(name for name, _ in entries)]
            whole = self.base.values(design, dict.fromkeys(name.partition("[")[0] for name in every))
            failing = self._failing(design)
        except Refused as error:
            message = f"the base design cannot be computed: {error}"
            below = error.key.split(".") if self.spec.of is None and error.key else ()
            self.faults.append(Fault("GL156", message, ("design", *below), "a study varies a design that exists"))
            return ()
        longest, kind = self._longest(every, whole), self.base.kind.name
        for name, at in entries:
            self.faults += no_lists([name], whole, at)
            self.faults += beyond_lists([name], longest, at, kind)
        for requirement, place in requirements:
            for name in requirement.expression.names:
                at = self._place_of(name, requirement.expression.text, place)
                self.faults += no_lists([name], whole, at)
                self.faults += beyond_lists([name], longest, at, kind)
                self.faults += odd_comparisons(requirement, [name], values, at, kind)
        self.faults = list(dict.fromkeys(self.faults))  # of a definition that serves several lines one
        return self._must_pass(failing)

    def _defined_entries(self) -> Iterator[tuple[str, Place]]:
        """Entries of lists that definitions name, whether a line stands on them or not."""
        for key, text in self.spec.define.items():
            for name in parse(text).names:
                if "[" in name:
                    yield name, ("define", key)

    def _place_of(self, name: str, text: str, place: Place) -> Place:
        """Where the file names a quantity: in a line itself, or in the definition that the line stands on."""
        if name in parse(text).names:
            return place
        return next(("define", key) for key, given in self.spec.define.items() if name in parse(given).names)

    def _longest(self, names: Iterable[str], whole: dict[str, Any]) -> dict[str, Any]:
        """The quantities of the base, with a longer list instead of one where a variable's ends give one.

        Notes
            A gear more makes a mesh more; only where an entry is missing in the base, other designs are asked.
        """
        found = {name: value for name, value in whole.items() if name not in OF_ANY_LENGTH}
        missing = list(beyond_lists(names, found, (), ""))
        together = [[each for ends in self._ends[i::2] for each in ends] for i in (0, 1)]
        for changes in (*together, *self._ends) if missing else ():
            with suppress(Refused):
                others = self.base.values(self.base.design(changes), whole)
                found |= {name: others[name] for name in found if _length(others[name]) > _length(found[name])}
        return found

    def _failing(self, design: Any) -> set[str]:
        try:
            outline = design.outline(self.base.command)
            return {check.code for name in outline.checks for check in design.check(name) if check.status == "fail"}
        except NoSolution as error:
            raise Refused(error.key, str(error)) from error

    def _must_pass(self, failing: set[str]) -> tuple[str, ...]:
        asked, known = self.spec.checks.must_pass, self.base.codes
        if isinstance(asked, str):
            left = set() if asked == "none" else set(known) - (failing if asked == "default" else set())
            return tuple(sorted(left))
        for i, code in enumerate(asked):
            if code not in known:
                helps = f"its checks are {', '.join(sorted(known))}"
                message = f"no check {code!r} of `{self.base.command}`"
                self.faults.append(Fault("GL152", message, ("checks", "must_pass", i), helps))
        return tuple(sorted(set(asked)))


def _length(value: Any) -> int:
    return len(value) if isinstance(value, (list, tuple)) else -1


def _decimals_below(times: str | None, before: dict[str, Variable]) -> int:
    """Decimals of the values of the variable that a range is a multiple of."""
    return 0 if times is None or before[times].continuous else before[times].decimals


def _points(low: float, high: float, count: int, *, log: bool, whole: bool) -> list[Any]:
    shares = [i / (count - 1) for i in range(count)]
    found = [low * (high / low) ** share if log else low + share * (high - low) for share in shares]
    found[-1] = high
    if whole:
        return list(dict.fromkeys(round(value) for value in found))
    return [float(f"{value:.15g}") for value in found]  # 0.3, not 0.30000000000000004


def _tried(variable: Variable, before: dict[str, Variable]) -> Iterator[Any]:
    """Values of a variable that are tried in the base: all where they are not many, else ends and an even share."""
    if variable.values:
        stride = max(1, len(variable.values) // _TRIED_LISTED)
        ends = (min(variable.values), max(variable.values)) if numeric(variable) else ()
        yield from dict.fromkeys((*variable.values[::stride], variable.values[-1], *ends))
        return
    parents = _span(before[variable.times], before) if variable.times else (1.0, 1.0)
    low, high = (float(variable.ends(parent)[i]) for parent, i in zip(parents, (0, 1), strict=True))
    if high < low:
        return
    step = variable.step or (high - low) / 8 or 1.0
    count = int((high - low) / step + _EDGE) + 1
    stride = max(1, count // _TRIED_VALUES)
    for i in dict.fromkeys((0, count - 1, *range(0, count, stride))):
        value = low + i * step if variable.continuous else variable.at(i, parents[0])
        yield variable.written(float(value))


def _span(variable: Variable, before: dict[str, Variable]) -> tuple[float, float]:
    """Minimum and maximum value of a variable of numbers."""
    if variable.values:
        return min(variable.values), max(variable.values)
    low, high = _span(before[variable.times], before) if variable.times else (1.0, 1.0)
    return float(variable.ends(low)[0]), float(variable.ends(high)[1])
