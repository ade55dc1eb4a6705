"""The base design of a study: the designs that differ from it by some keys, and the quantities they have.

Each design may be computed by its own class, a form that every kind has and that checks the array form.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from pydantic import ValidationError

from gearlink.core.base.codes import rules
from gearlink.core.base.design import Design, in_unit
from gearlink.core.base.design_axis import Single
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kind import Kind
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.nearest import near_quantities
from gearlink.core.base.report import Check
from gearlink.core.base.spec_paths import put

Changes = Iterable[tuple[str, Any]]
_DEEPEST = 4
_PATH = re.compile(r"\w+(?:\.\w+|\[\d{1,6}\])*")
_MARK = re.compile(r'"\\u0000(\d+)\\u0000"')  # what stands in the file's JSON for a value that changes
_WHOLE = ("int_type", "int_from_float")
_ROUNDING = 1e-9


class Refused(Exception):
    """A design that does not exist: `key` is the key of the design file that it is refused for, `code` its code."""

    def __init__(self, key: str, message: str, code: str = "GL112") -> None:
        super().__init__(message)
        self.key, self.code = key, code


@dataclass(frozen=True)
class Base:
    """The base design.

    Parameters
        data : dict - of its design file
        command : str - whose checks count
        warnings : bool - whether findings that can only warn are wanted
    """

    data: dict[str, Any]
    command: str
    warnings: bool = True

    @cached_property
    def kind(self) -> Kind:
        """Its kind."""
        return KINDS[self.data["kind"]]

    def changed(self, changes: Changes) -> dict[str, Any]:
        """The data of its file with other values at some paths; None leaves a key out."""
        data: dict[str, Any] = json.loads(self._text)  # in a third of the time of a deep copy
        for path, value in changes:
            put(data, path, value)
        return data

    @cached_property
    def _text(self) -> str:
        return json.dumps(self.data)

    def _changed_text(self, changes: Sequence[tuple[str, Any]]) -> str:
        """The data of `changed` as JSON: the texts between the values that change are made once."""
        paths = tuple(path for path, _ in changes)
        between = self._between.get(paths)
        if between is None:
            between = self._between[paths] = self._texts_between(paths)
        if not between:
            return json.dumps(self.changed(changes))
        order, texts = between
        values = [json.dumps(changes[i][1]) for i in order]
        return "".join(part for pair in zip(texts, [*values, ""], strict=True) for part in pair)

    @cached_property
    def _between(self) -> dict[tuple[str, ...], Any]:
        """By the paths that change: the order in which they stand in the file, and the texts between them."""
        return {}

    def _texts_between(self, paths: tuple[str, ...]) -> Any:
        """None where a path is listed twice, leads below another, or nowhere."""
        marks = [f"\0{i}\0" for i in range(len(paths))]
        try:
            text = json.dumps(self.changed(zip(paths, marks, strict=True)))
        except (LookupError, TypeError, AttributeError):
            return None
        parts = _MARK.split(text)
        order = [int(mark) for mark in parts[1::2]]
        return (order, parts[::2]) if sorted(order) == list(range(len(paths))) else None

    def spec(self, changes: Changes = ()) -> Any:
        """The spec of a design with other values at some paths.

        Raises
            ValidationError, NoSolution - where the model refuses it
        """
        # As JSON: in strict mode a list then serves a tuple field.
        return self.kind.spec_model().model_validate_json(self._changed_text(tuple(changes)))

    def design(self, changes: Changes = ()) -> Design:
        """The design with other values at some paths.

        Raises
            Refused - where the model refuses it
        """
        try:
            spec, last = self.spec(changes), self._last.get(self.command)
            same = type(last) is self.kind.class_for(self.command, spec)
            made = last.varied(spec) if last is not None and same else self.kind.design(self.command, spec)
        except ValidationError as error:
            raise Refused(*_first(error)) from error
        except NoSolution as error:
            raise Refused(error.key, str(error), error.code) from error
        made.advises, made.warnings = False, self.warnings
        self._last[self.command] = made
        return made

    @cached_property
    def _last(self) -> dict[str, Design]:
        """The design made last, of which the next may keep what they share."""
        return {}

    def takes(self, changes: Changes) -> str:
        """What the model has against other values at some paths; empty where it takes them."""
        try:
            self.spec(changes)
        except ValidationError as error:
            return _first(error)[1]
        except NoSolution as error:
            return str(error)
        return ""

    def knows(self, path: str) -> bool:
        """Whether the model has such a key."""
        if not _PATH.fullmatch(path):
            return False
        try:
            self.spec([(path, None)])
        except ValidationError as error:
            return all(item["type"] != "extra_forbidden" for item in error.errors(include_url=False))
        except (LookupError, TypeError, AttributeError):
            return False
        except NoSolution:
            pass
        return True

    def is_whole(self, path: str) -> bool:
        """Whether a key takes whole numbers alone."""
        try:
            self.spec([(path, 17.5)])
        except ValidationError as error:
            return any(item["type"] in _WHOLE for item in error.errors(include_url=False))
        except NoSolution:
            pass
        return False

    # Quantities

    @cached_property
    def places(self) -> dict[str, str]:
        """The command that gives each quantity of the kind: that of the study where its class can."""
        own = self.kind.design_class(self.command)
        found: dict[str, str] = dict.fromkeys(own.names_for(self._own_spec), self.command)
        for command in self.kind.commands:
            other = self.kind.design_class(command)
            place = self.command if issubclass(own, other) else command
            for name in other.names_for(self._own_spec):
                found.setdefault(name, place)
        return found

    def unit(self, name: str) -> str:
        """The unit of a quantity, with its index or without."""
        plain = name.partition("[")[0]
        command = self.places.get(plain, self.command)
        found: str = self.kind.design_class(command).unit_for(self._own_spec, plain)
        return found

    @cached_property
    def _own_spec(self) -> Any:
        """The spec as it stands."""
        return self.spec()

    def values(self, design: Design, names: Iterable[str], checks: Iterable[str] = ()) -> dict[str, Any]:
        """Quantities of a design in the units of design files.

        Parameters
            design : of this base
            names : with an index where one element of a list is wanted
            checks : that will be asked for besides
        Raises
            Refused - where there is no such mechanism
        """
        made, names = {self.command: design}, tuple(names)
        found = {}
        plain_names = [name.partition("[")[0] for name in names]
        design.prepare([*(name for name in plain_names if self.places[name] == self.command), *checks])
        for name in names:
            plain, _, index = name.partition("[")
            command = self.places[plain]
            if command not in made:
                made[command] = self.kind.design(command, design.spec)
            try:
                value = made[command].raw(plain)
            except NoSolution as error:
                raise Refused(error.key, str(error), error.code) from error
            value = None if value is None else in_unit(value, self.unit(plain))
            found[name] = _element(value, index) if index else value
        return found

    def nearest(self, name: str, known: Iterable[str]) -> str:
        """The nearest known names, in words."""
        known = sorted(known)
        near = near_quantities(name[:100], known)
        shown = self.kind.design_class(self.command).outlines[self.command].quantities
        own = [name for name in shown if name in known] or known
        return f"nearest: {', '.join(near)}" if near else f"known: {', '.join(own[:12])}"

    @cached_property
    def codes(self) -> dict[str, tuple[str, ...]]:
        """The codes of the command's checks, each with the names of its checks."""
        checks = self.kind.design_class(self.command).judged(self.command, self.spec())
        return {
            code: tuple(name for name in rule.checks if name in checks)
            for code, rule in rules().items()
            if any(name in checks for name in rule.checks)
        }

    @cached_property
    def units(self) -> dict[str, str]:
        """The units of the model's keys by their paths; those of elements of a list are the list's."""
        return dict(_units(self.kind.spec_model().model_json_schema()))


def _element(value: Any, index: str) -> Any:
    """An element of a list; None where the list has none there."""
    place = int(index.rstrip("]"))
    return value[place] if isinstance(value, list) and place < len(value) else None


def _first(error: ValidationError) -> tuple[str, str, str]:
    """Key, message and code of the first thing that a model refuses."""
    item = error.errors(include_url=False)[0]
    steps = [step for step in item["loc"] if isinstance(step, int) or step.isidentifier()]
    below = str((item.get("ctx") or {}).get("key", ""))
    key = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in steps)
    key = f"{key}.{below}" if below else key
    code = item["type"] if item["type"].startswith("GL") else "GL108"
    message = item["msg"].replace("Input should be", "it must be")
    return key.removeprefix("."), message[:1].lower() + message[1:], code


def _units(schema: dict[str, Any]) -> Iterator[tuple[str, str]]:
    """Path and unit of every key of a JSON Schema."""

    def below(section: dict[str, Any], before: str) -> Iterator[tuple[str, str]]:
        for name, node in section.get("properties", {}).items():
            parts = (node, *node.get("anyOf", ()), *node.get("allOf", ()))
            named = [schema["$defs"][part["$ref"].rpartition("/")[2]] for part in parts if "$ref" in part]
            inner = named + [part for part in parts if "properties" in part]
            if not inner:
                unit = next((part["unit"] for part in parts if "unit" in part), "1")
                yield before + name, "1" if unit == "teeth" else unit
            for part in inner if before.count(".") < _DEEPEST else ():
                yield from below(part, f"{before}{name}.")

    yield from below(schema, "")


def single(base: Base, changes: Changes, names: Iterable[str], codes: Sequence[str]) -> Single:
    """Compute a design by its class.

    Parameters
        changes : paths and values that differ from it
        names : quantities that are wanted
        codes : of the checks that are wanted
    """
    (found,) = singles(base, [changes], names, codes)
    return found


def singles(base: Base, changes: Iterable[Changes], names: Iterable[str], codes: Sequence[str]) -> list[Single]:
    """Compute designs by their class, as `single` does; what a class seeks for many at once is sought first.

    Notes
        A design next to a limit is computed by itself: rounding among others could tell otherwise.
    """
    names, found, waiting = tuple(names), list[Single](), list[tuple[Changes, Design | Single]]()
    for one in changes:
        one = tuple(one)
        waiting.append((one, _made(base, one)))
        if len(waiting) >= _at_once(waiting[-1][1]):
            found += _evaluated(base, waiting, names, codes)
            waiting = []
    return [*found, *_evaluated(base, waiting, names, codes)]


def _made(base: Base, changes: Changes) -> Design | Single:
    try:
        return base.design(changes)
    except Refused as error:
        return _refused(error)


def _at_once(made: Design | Single) -> int:
    """Designs that are made before they are computed; one, of which the next keeps results, where none are shared."""
    if isinstance(made, Single):
        return Design.at_once
    seeks_together = made.find_together.__func__ is not Design.find_together.__func__  # type: ignore[attr-defined]
    return made.at_once if seeks_together else 1


def _refused(error: Refused) -> Single:
    return Single({}, (), error.key or "kind", str(error))


def _evaluated(
    base: Base, made: Sequence[tuple[Changes, Design | Single]], names: Sequence[str], codes: Sequence[str]
) -> Iterable[Single]:
    there: dict[type[Design], list[Design]] = {}
    for _, design in made:
        if not isinstance(design, Single):
            there.setdefault(type(design), []).append(design)
    asked = (*names, *checks_of(base, codes))
    for cls, designs in there.items():
        cls.find_together(designs, asked)
    for changes, design in made:
        found = _judged(base, design, names, codes)
        if len(made) > 1 and any(_is_next_to_its_limit(check) for check in _of_found(design, found)):
            found = _judged(base, _made(base, changes), names, codes)
        yield found


def _judged(base: Base, design: Design | Single, names: Sequence[str], codes: Sequence[str]) -> Single:
    if isinstance(design, Single):
        return design
    try:
        checks = checks_of(base, codes)
        return Single(base.values(design, names, checks), tuple(findings_of(base, design, codes)))
    except Refused as error:
        return _refused(error)


def _of_found(design: Design | Single, found: Single) -> Iterable[Check]:
    """Findings that rest on what was found among other designs."""
    alone = frozenset() if isinstance(design, Single) else design.alone
    return (check for check in found.findings if check.name not in alone)


def _is_next_to_its_limit(check: Check) -> bool:
    """Whether rounding may decide: within 1e-9 of a limit, next to 0 of the unit; a limit of 1e-9 is its own scale."""
    value, limit = check.value, check.limit
    if value is None or limit is None:
        return False
    return math.isclose(value, limit, rel_tol=_ROUNDING, abs_tol=0.0 if limit else _ROUNDING)


def checks_of(base: Base, codes: Sequence[str]) -> set[str]:
    """Names of the checks under some codes."""
    return {name for code in codes for name in base.codes[code]}


def findings_of(base: Base, design: Any, codes: Sequence[str]) -> Iterable[Check]:
    """The findings of a design under some codes.

    Raises
        Refused - where a check finds that there is no mechanism
    """
    names = checks_of(base, codes)
    try:
        shown = dict.fromkeys(name for name in design.outline(base.command).checks if name in names)
        return [check for name in shown for check in design.check(name)]
    except NoSolution as error:
        raise Refused(error.key, str(error), error.code) from error
