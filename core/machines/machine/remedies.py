"""What repairs the timing of a machine: other phases, then relations that ask for less, then other motions."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, combinations, islice
from typing import TYPE_CHECKING

from gearlink.core.base.remedies.ways import Way, either
from gearlink.core.base.spec_paths import changed, numbers_at, step_of, unit_at
from gearlink.core.machines.machine.relations import Named, Relation, Value

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.machine.design import Machine

_STEPS = (1.0, 0.5, 0.1, 0.01)  # deg
_PAIRS = 6  # members: of more no pairs are tried
_BY = 0.5  # deg


def candidates(design: Machine) -> Iterator[Remedy]:
    """Remedies of relations that do not hold, from the phases of the maximum margin."""
    wrong = [(i, relation, margin) for i, (relation, margin) in enumerate(design.margins)
             if design.status_of(relation, margin) == "fail"]  # fmt: skip
    yield from _phases(design, [relation for _, relation, _ in wrong])
    for _, relation, _ in wrong:
        if isinstance(relation, Value):
            yield from _of_value(design, relation)
    yield from _less(design, [each for each in wrong if not isinstance(each[1], Value)])


def _phases(design: Machine, wrong: Iterable[Relation]) -> Iterator[Remedy]:
    """Given phases of the members that the relations name: of one, that which turns least first; of two; of all."""
    roots = {design.spec.root(name): None for relation in wrong for name in members_of(relation)}
    every, on_dial = design.driven, design.timing.on_dial
    alone = [found for name in every if name in roots for found in _holding(design, (name,))]
    alone.sort(key=lambda found: sum(abs(design.timing.wrap(to - design.phases[name])) for name, to in found.items()))
    pairs = combinations(every, 2) if 2 < len(every) <= _PAIRS else ()
    more = (found for names in (*pairs, every[1:], every) if names for found in _holding(design, names))
    for found in chain(alone, more):
        for step in _STEPS:
            yield _set({name: on_dial(round(step * round(phase / step), 2)) for name, phase in found.items()})
        yield _set(found)


def _of_value(design: Machine, relation: Value) -> Iterator[Remedy]:
    """The nearest phases to either side, in whole degrees, with which a value stands on its side of the limit."""
    name = design.spec.root(relation.of.partition(".")[0])
    if name not in design.driven:
        return
    old, timing = round(design.phases[name]), design.timing
    for sense in (1, -1):
        turned = (timing.on_dial(float(old + sense * i)) for i in range(1, round(timing.dial)))
        good = ({name: to} for to in turned if timing.margin(relation, {**design.phases, name: to}) >= 0.0)
        yield from map(_set, islice(good, 1))


def _set(phases: Mapping[str, float]) -> Remedy:
    return tuple((f"members.{name}.phase", phase) for name, phase in phases.items())


def _holding(design: Machine, names: tuple[str, ...]) -> Iterator[dict[str, float]]:
    """The phases of given members with which the relations hold, beside those that are free; none where they do not."""
    found = design.solved(names)
    if math.isfinite(found.margin) and design.status(found.margin) != "fail":
        yield {name: design.timing.on_dial(found.phases[name]) for name in names}


def _less(design: Machine, wrong: Sequence[tuple[int, Relation, float]]) -> Iterator[Remedy]:
    """Relations that ask for less: one by what it and those that limit it lack; all of them; with other phases."""
    of_each = [tuple(_relaxed(i, relation, margin)) for i, relation, margin in wrong]
    more = max(1, len(design.limiting_relations or ()))
    yield from (change for change in of_each if change)
    yield from (change for i, relation, margin in wrong if (change := tuple(_relaxed(i, relation, more * margin))))
    if len(of_each) > 1:
        yield tuple(chain.from_iterable(of_each))
    best = design.unbound
    for i, relation in enumerate(design.spec.relations):
        if relation.text not in best.limiting or not math.isfinite(best.margin):
            continue
        for less in _relaxed(i, relation, len(best.limiting) * min(best.margin, 0.0)):
            spec = changed(design.given, (less,))
            yield from ((less, *phases) for phases in _phases(design.varied(spec), design.spec.relations))


def _relaxed(i: int, relation: Relation, lacks: float) -> Iterator[tuple[str, str]]:
    """The line with an angle that is less by what it lacks; none where nothing of the angle would be left."""
    assert not isinstance(relation, Value)
    by = round(_BY * math.floor((relation.by + lacks) / _BY + 1e-9), 9)
    if by >= 0.0:
        yield f"require[{i}]", relation.with_by(by)


def ways(design: Machine) -> Iterator[Way]:
    """The numbers of the motions of members, those in deg first, that relations name which do not hold."""
    wrong = (relation for relation, margin in design.margins if design.status_of(relation, margin) == "fail")
    found: list[tuple[bool, tuple[Way, ...]]] = []
    for name in dict.fromkeys(member for relation in wrong for member in members_of(relation)):
        member = f"members.{name}.design"
        model = type(design.spec.members[name].spec)
        for key, field in model.model_fields.items():
            for path in numbers_at(design.spec, f"{member}.{field.alias or key}"):
                turned = unit_at(design.spec, path) == "deg"
                found.append((not turned, either(path, step=step_of(design.spec, path))))
    yield from (way for _, both in sorted(found, key=lambda each: each[0]) for way in both)


def members_of(relation: Relation) -> Iterator[str]:
    """The members whose runs or events a relation names."""
    if isinstance(relation, Value):
        yield relation.of.partition(".")[0]
    moments = (relation.at,) if isinstance(relation, Value) else (relation.one, relation.two)
    yield from (moment.member for moment in moments if isinstance(moment, Named) and moment.of)
