"""A study made ready to be computed: its base, its variables in order, what is sought; or all that is wrong with it."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.explore.base import Base, Refused
from gearlink.core.explore.order import Grid, Sample, TooManyDesigns, Variable
from gearlink.core.explore.wishes import Condition, FaultFound, Names, Objective, condition, contradiction, objective
from gearlink.core.kinds import KINDS
from gearlink.core.study.expressions import Expression
from gearlink.core.study.faults import Fault, Place, WrongStudy
from gearlink.core.study.spec import StudySpec, VariableSpec

SCHEMA = 1
CHUNK, SCALAR_CHUNK = 8192, 64
GRID_BUDGET, SAMPLE_BUDGET = 1e8, 2.0**17
SCALAR_GRID_BUDGET, SCALAR_SAMPLE_BUDGET = 2e4, 2.0**12
_TRIED_VALUES, _TRIED_LISTED = 100, 1000
_EDGE = 1e-9
_ORDERED = ("variables", "minimize", "maximize")


@dataclass(frozen=True)
class Problem:
    """A study that can be computed.

    Parameters
        spec : StudySpec - with its base in `design`
        base : Base
        variables : tuple of Variable
        objectives, conditions : what is sought
        must_pass : tuple of str - codes that a design must pass, ascending
    """

    spec: StudySpec
    base: Base
    variables: tuple[Variable, ...]
    objectives: tuple[Objective, ...]
    conditions: tuple[Condition, ...]
    must_pass: tuple[str, ...]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Quantities that have to be computed of each design, with their indices."""
        wanted = [wish.expression for wish in self.objectives] + [wish.expression for wish in self.conditions]
        return tuple(dict.fromkeys(name for expression in wanted for name in expression.names))

    @cached_property
    def shown(self) -> tuple[tuple[str, Expression, str], ...]:
        """Name, expression and unit of each column besides the variables: objectives, then what is named by where."""
        found = {wish.name: (wish.expression, wish.unit) for wish in self.objectives}
        for wish in self.conditions:
            found.setdefault(wish.expression.text, (wish.expression, wish.unit))
        return tuple((name, *rest) for name, rest in found.items())

    @cached_property
    def axis(self) -> Any:
        """The kind's array form for this study; None where each design is computed by its class."""
        make = self.base.kind.axis_maker()
        if make is None:
            return None
        paths = [path for variable in self.variables for path in (variable.path, *variable.also)]
        numeric = all(_numeric(variable) for variable in self.variables)
        return make(self.base.spec(), self.base.command, paths, self.names) if numeric else None

    @property
    def chunk_size(self) -> int:
        """Designs of a chunk, the share that is computed and stored as one."""
        return SCALAR_CHUNK if self.axis is None else CHUNK

    @cached_property
    def order(self) -> Grid | Sample:
        """The designs in their order.

        Raises
            WrongStudy - GL155, GL111 where there is no design
        """
        sampling = self.spec.sampling
        asked, scalar = sampling.budget, self.axis is None
        budget = asked or (SCALAR_GRID_BUDGET if scalar else GRID_BUDGET)
        gridded = not any(variable.continuous for variable in self.variables)
        if gridded and sampling.method != "sobol":
            count, grid = self._grid()
            if count <= budget and grid is not None:
                if grid.count == 0:
                    raise WrongStudy([Fault("GL111", "no combination of the variables exists", ("variables",))])
                return grid
            if sampling.method == "grid":
                raise WrongStudy([self._too_many(count, budget)])
        elif sampling.method == "grid":
            real = next(variable for variable in self.variables if variable.continuous)
            message = f"{real.path} is a real number without step, which has no grid"
            raise WrongStudy([Fault("GL155", message, ("variables", real.path), "give it a step, points or values")])
        most = asked or (SCALAR_SAMPLE_BUDGET if scalar else SAMPLE_BUDGET)
        return Sample(self.variables, 2 ** int(math.log2(most)), sampling.seed)

    def _grid(self) -> tuple[float, Grid | None]:
        try:
            grid = Grid(self.variables)
        except TooManyDesigns as error:
            return error.count, None
        return grid.count, grid

    def _too_many(self, count: float, budget: float) -> Fault:
        sizes = {v.path: len(v.values) or _most_values(v) for v in self.variables}
        widest = max(sizes, key=lambda path: sizes[path])
        message = f"{count:.3g} designs are more than the budget of {budget:.3g}"
        helps = f"coarsen {widest} ({sizes[widest]:.0f} values) or raise sampling.budget (--budget)"
        return Fault("GL155", message, ("sampling", "budget"), helps)

    @cached_property
    def exhaustive(self) -> bool:
        """Whether all designs are computed."""
        return isinstance(self.order, Grid)

    @property
    def chunks(self) -> int:
        """How many chunks there are."""
        return -(-self.order.count // self.chunk_size)

    @cached_property
    def canonical(self) -> dict[str, Any]:
        """All that the result depends on, as plain data."""
        study = self.spec.model_dump(by_alias=True, mode="json", exclude={"name", "of"})
        study["sampling"]["budget"] = self.order.count
        return {"schema": SCHEMA, "chunk": self.chunk_size, **study, "command": self.base.command}

    @cached_property
    def canonical_text(self) -> str:
        """The canonical data as JSON with shortest doubles, from which `problem_of` makes the problem again."""
        return json.dumps(self.canonical, ensure_ascii=False, separators=(",", ":"))

    def named(self, name: str) -> Problem:
        """The same under a name, which no result depends on."""
        return replace(self, spec=self.spec.model_copy(update={"name": name}))

    @property
    def hash(self) -> str:
        """SHA-256 of the canonical data with sorted keys, but for sections whose order decides the result."""
        plain = {key: list(value.items()) if key in _ORDERED else value for key, value in self.canonical.items()}
        return hashlib.sha256(json.dumps(plain, sort_keys=True, ensure_ascii=False).encode()).hexdigest()

    def changes_of(self, index: int) -> list[tuple[str, Any]]:
        """Paths and values of a design by its index."""
        return self.changes(self.order.columns(np.array([index]))[:, 0])

    def changes(self, values: Any) -> list[tuple[str, Any]]:
        """Paths and values of a design as its file has them, from a column of `order.columns`."""
        found: list[tuple[str, Any]] = []
        for variable, value in zip(self.variables, values, strict=True):
            written = variable.written(float(value))
            found += [(path, written) for path in (variable.path, *variable.also)]
        return found


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
    objectives, conditions = reading.wishes(names)
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
        message = f"`{command}` does not apply to a {kind}; this kind understands: {', '.join(known)}"
        raise WrongStudy([Fault("GL113", message, ("command",))])
    return Base(spec.design, command)


class _Reading:
    """Reads the parts of a study, and keeps all that is wrong."""

    def __init__(self, spec: StudySpec, base: Base) -> None:
        self.spec, self.base = spec, base
        self.faults: list[Fault] = []

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
                self.faults.append(Fault("GL151", f"{other} is no key of {kind}", at, helps))
                return None
            if other in taken:
                message = f"{other} is given by the variable {taken[other]} already"
                self.faults.append(Fault("GL111", message, at))
                return None
            taken[other] = path
        if given.times is not None and (given.times not in before or not _numeric(before[given.times])):
            message = f"{given.times!r} is no variable of numbers above {path}"
            self.faults.append(Fault("GL151", message, (*place, "times"), "list it before"))
            return None
        made = self._made(path, given)
        wrong = self._refused_value(made, before)
        if wrong is not None:
            self.faults.append(wrong)
            return None
        return made

    def _made(self, path: str, given: VariableSpec) -> Variable:
        also = tuple(given.also)
        if given.values is not None:
            return Variable(path, also, tuple(given.values))
        low, high = given.from_, given.to
        assert low is not None, "the model asks for it"
        assert high is not None, "the model asks for it"
        whole = self.base.is_whole(path)
        if given.points is not None:
            return Variable(path, also, tuple(_points(low, high, given.points, log=given.log, whole=whole)))
        step = given.step
        if step is None and whole:
            step = 1.0
        return Variable(path, also, (), low, high, step, given.times or "", whole, given.log)

    def _refused_value(self, variable: Variable, before: dict[str, Variable]) -> Fault | None:
        """What the base has against one of a variable's values, each put in alone."""
        place: tuple[str, ...] = ("variables", variable.path)
        if variable.whole and variable.step is not None and variable.step != int(variable.step):
            return Fault(
                "GL156", f"{variable.path} takes whole numbers, a step of {variable.step:g} not", (*place, "step")
            )
        tried = list(_tried(variable, before))
        if not tried:
            return Fault("GL111", f"the range of {variable.path} holds no value", place, "widen it")
        for value in tried:
            message = self.base.takes([(path, value) for path in (variable.path, *variable.also)])
            if message:
                key = "values" if variable.values else "from" if value == tried[0] else "to"
                at = (*place, key) if self.spec.variables[variable.path].points is None else place
                return Fault("GL156", f"{variable.path} = {value!r} is refused in the base: {message}", at)
        return None

    def names(self) -> Names:
        """The quantities and what is defined of them."""
        known = frozenset(self.base.places)
        defined: dict[str, Expression] = {}
        for name, text in self.spec.define.items():
            names = Names(self.base.unit, known, dict(defined), self.base.nearest)
            place = ("define", name)
            if not name.isidentifier() or name in known:
                message = f"{name!r} is no new name" if name in known else f"{name!r} is no name: letters, digits and _"
                self.faults.append(Fault("GL152", message, place, "choose another name"))
                continue
            try:
                defined[name] = names.expression(text, place)
            except FaultFound as found:
                self.faults.append(found.fault)
        return Names(self.base.unit, known, defined, self.base.nearest)

    def wishes(self, names: Names) -> tuple[list[Objective], list[Condition]]:
        """Objectives in the order of the file, minimised ones first, and conditions."""
        objectives, conditions = [], []
        for key, sign in (("minimize", 1.0), ("maximize", -1.0)):
            for name, given in getattr(self.spec, key).items():
                if sign < 0.0 and name in self.spec.minimize:
                    self.faults.append(Fault("GL111", f"{name} is minimised already", (key, name)))
                    continue
                try:
                    objectives.append(objective(name, given, sign, names, (key, name)))
                except FaultFound as found:
                    self.faults.append(found.fault)
        for i, text in enumerate(self.spec.where):
            try:
                conditions.append(condition(text, names, ("where", i)))
            except FaultFound as found:
                self.faults.append(found.fault)
        clash = contradiction(conditions)
        if clash is not None:
            first, second = (conditions[i].text for i in clash)
            message = f"no design can meet both `{first}` and `{second}`"
            self.faults.append(Fault("GL111", message, ("where", clash[1]), "widen or leave out one of them"))
        return objectives, conditions

    def base_values(self, objectives: list[Objective], conditions: list[Condition]) -> tuple[str, ...]:
        """Compute the base; what its quantities are like, and the codes that must pass."""
        wishes: list[tuple[Objective | Condition, Place]] = [
            *((wish, ("minimize" if wish.sign > 0.0 else "maximize", wish.name)) for wish in objectives),
            *((wish, ("where", i)) for i, wish in enumerate(conditions)),
        ]
        names = dict.fromkeys(name for wish, _ in wishes for name in wish.expression.names)
        try:
            design = self.base.design()
            values = self.base.values(design, names)
            failing = self._failing(design)
        except Refused as error:
            message = f"the base design cannot be computed: {error}"
            below = error.key.split(".") if self.spec.of is None and error.key else ()
            self.faults.append(Fault("GL156", message, ("design", *below), "a study varies a design that exists"))
            return ()
        for wish, place in wishes:
            self.faults += _odd(wish, values, place)
        return self._must_pass(failing)

    def _failing(self, design: Any) -> set[str]:
        from gearlink.core.errors import NoSolution

        try:
            outline = design.outline(self.base.command)
            return {check.code for name in outline.checks for check in design.check(name) if check.status == "fail"}
        except NoSolution as error:
            raise Refused(error.key, error.message) from error

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


def _odd(wish: Objective | Condition, values: dict[str, Any], place: Place) -> Iterator[Fault]:
    """What is wrong with the quantities of a wish, by their values in the base."""
    expression = wish.expression
    words = isinstance(wish, Condition) and isinstance(wish.limit, str)
    for name in expression.names:
        value = values[name]
        if isinstance(value, (list, tuple)):
            message = f"{name} is a list of {len(value)}"
            yield Fault("GL152", message, place, f"take one of them, {name}[0]")
        elif isinstance(value, str) and not words:
            yield Fault("GL152", f"{name} is a word ({value}), not a number", place, f"where: {name} == {value}")
        elif value is not None and not isinstance(value, str) and words:
            yield Fault("GL152", f"{name} is a number, not a word", place)
        elif isinstance(wish, Condition) and wish.sign == "==" and isinstance(value, float) and name == expression.text:
            message = f"{name} is a real number, which equals nothing exactly"
            yield Fault("GL152", message, place, "compare it by >= and <=")


def _numeric(variable: Variable) -> bool:
    return all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in variable.values)


def _points(low: float, high: float, count: int, *, log: bool, whole: bool) -> list[Any]:
    shares = [i / (count - 1) for i in range(count)]
    found = [low * (high / low) ** share if log else low + share * (high - low) for share in shares]
    found[-1] = high
    return list(dict.fromkeys(round(value) for value in found)) if whole else found


def _most_values(variable: Variable) -> float:
    return float(variable.count(1.0)) if not variable.times else math.inf


def _tried(variable: Variable, before: dict[str, Variable]) -> Iterator[Any]:
    """Values of a variable that are tried in the base: all where they are not many, else ends and an even share."""
    if variable.values:
        stride = max(1, len(variable.values) // _TRIED_LISTED)
        yield from dict.fromkeys((*variable.values[::stride], variable.values[-1]))
        return
    parents = _span(before[variable.times], before) if variable.times else (1.0, 1.0)
    low, high = (float(variable.ends(parent)[i]) for parent, i in zip(parents, (0, 1), strict=True))
    if high < low:
        return
    step = variable.step or (high - low) / 8 or 1.0
    count = int((high - low) / step + _EDGE) + 1
    stride = max(1, count // _TRIED_VALUES)
    for i in dict.fromkeys((0, count - 1, *range(0, count, stride))):
        yield variable.written(low + i * step)


def _span(variable: Variable, before: dict[str, Variable]) -> tuple[float, float]:
    """Least and greatest value of a variable of numbers."""
    if variable.values:
        return min(variable.values), max(variable.values)
    low, high = _span(before[variable.times], before) if variable.times else (1.0, 1.0)
    return float(variable.ends(low)[0]), float(variable.ends(high)[1])
