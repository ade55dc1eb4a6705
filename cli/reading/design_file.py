"""A design file from its bytes to a validated spec; every error of it found in one run and located."""

from __future__ import annotations

import errno
import json
import math
import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import replace
from typing import TYPE_CHECKING, Any, BinaryIO, TypeVar

from gearlink.cli.files import stem_of
from gearlink.cli.options import Keyed
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic, Source
from gearlink.cli.reading.loaded_file import KeyPath, LoadedFile, Override, parse_path
from gearlink.cli.reading.places import (
    ENDINGS,
    astray,
    base_path,
    is_design_name,
    is_named_pipe,
    nearest_file,
    note,
    piped,
)
from gearlink.cli.reading.yaml_reader import (
    CONTROL,
    MAX_BYTES,
    MAX_DEPTH,
    Tree,
    compose,
    format_path,
    plain_value,
    read,
)
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.spec_paths import LARGEST_SIZE, LEAST_SIZE, has_size
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from pydantic import BaseModel

    Model = TypeVar("Model", bound=BaseModel)

_ROOT: KeyPath = ()
_LONGEST_KIND = 60
_NUMBERS = {"2": "two", "3": "three", "4": "four", "5": "five"}


def load(
    source: str | os.PathLike[str], *, overrides: Sequence[str | Keyed] = (), stdin: BinaryIO | None = None
) -> LoadedFile:
    """The design file at a path, or on standard input for `-`.

    Raises
        DesignFileError - with everything that keeps it from being read (GL101 to GL104, GL110, GL114)
    """
    name = "<stdin>" if source == "-" else os.fspath(source)
    if source != "-" and is_named_pipe(name):
        message = "a named pipe is not read\ngive - and the pipe as standard input"
        raise DesignFileError([Diagnostic("GL101", message, name)])
    if target := astray(name):
        message = f"a link to {target}, which is not a design file ({', '.join(ENDINGS)})\nname the file itself"
        raise DesignFileError([Diagnostic("GL101", message, name)])
    return parse(read_at_most(source, MAX_BYTES + 1, stdin), name, overrides=overrides)


def read_at_most(source: str | os.PathLike[str], limit: int, stdin: BinaryIO | None = None) -> bytes:
    """The first bytes of a file, or of standard input for `-`.

    Raises
        DesignFileError - GL101 where it cannot be read
    """
    if source != "-" and (held := piped(os.fspath(source), limit)) is not None:
        return held[:limit]
    try:
        with nullcontext(stdin or sys.stdin.buffer) if source == "-" else open(source, "rb") as stream:
            content = stream.read(limit)
    except (OSError, ValueError) as error:
        raise DesignFileError([_unreadable("<stdin>" if source == "-" else os.fspath(source), error)]) from None
    note(source, content)
    return content


def parse(data: bytes, file: str, *, overrides: Sequence[str | Keyed] = ()) -> LoadedFile:
    """The design file that some bytes hold, with `--set` arguments put in.

    Raises
        DesignFileError - as `load`
    """
    wrong: list[Diagnostic] = []
    tree: Tree | None = None
    try:
        tree = read(data, file)
    except DesignFileError as error:
        wrong += error.diagnostics
    loaded = LoadedFile(file, tree.data if tree else {}, tree or Tree(Source(file, ""), {}, None, 0))
    loaded.problems += loaded.tree.problems
    wrong += _put_in(loaded, overrides)
    if wrong:
        raise DesignFileError([*loaded.problems, *wrong])
    return loaded


def with_overrides(loaded: LoadedFile, overrides: Sequence[str | Keyed]) -> LoadedFile:
    """The same file with further `--set` arguments put in.

    Raises
        DesignFileError - GL110, GL114 for arguments that cannot be read or have no place
    """
    copy = replace(loaded, overrides=list(loaded.overrides))
    if wrong := _put_in(copy, overrides):
        raise DesignFileError(wrong)
    return copy


def _put_in(loaded: LoadedFile, overrides: Sequence[str | Keyed]) -> list[Diagnostic]:
    wrong: list[Diagnostic] = []
    for argument in overrides:
        try:
            _apply(loaded, _override(argument))
        except DesignFileError as error:
            wrong += error.diagnostics
    return wrong


def read_kind(loaded: LoadedFile, kinds: Sequence[str]) -> str:
    """The kind of a design file, one of `kinds`.

    Raises
        DesignFileError - GL106 where it is missing, GL109 where there is no such kind
    """
    known = f"the kinds are {', '.join(kinds)}"
    if "kind" not in loaded.data:
        other = next((key for key in loaded.data if key.strip(" -").lower() in ("kind", "kinds", "type")), "")
        remedy = f"write kind instead of {other!r}; {known}" if other else known
        path = (other,) if other else _ROOT
        wrong = loaded.report("GL106", "the key 'kind' is missing", path, key="kind", help=remedy)
        raise DesignFileError([*loaded.problems, wrong])
    kind = loaded.data["kind"]
    if isinstance(kind, str) and kind in kinds:
        return kind
    if not isinstance(kind, str):
        wrong = loaded.report("GL107", "kind must be one word of text", ("kind",), help=known)
        raise DesignFileError([*loaded.problems, wrong])
    if kind == "study":
        wrong = loaded.report(
            "GL109", "a study is not a design", ("kind",), help="name a design; `gearlink explore` runs studies"
        )
        raise DesignFileError([*loaded.problems, wrong])
    from difflib import get_close_matches

    from gearlink.cli.glossary import kinds_named

    near = []
    if len(kind) <= _LONGEST_KIND:
        spelled = _spelled(kind)
        near = get_close_matches(spelled, kinds, n=1, cutoff=0.8) or kinds_named(kind, kinds)
        near = (
            near or [each for each in kinds if each.startswith(f"{spelled}-")] or get_close_matches(spelled, kinds, n=1)
        )
    remedy = f"did you mean {' or '.join(near)}? {known}" if near else known
    shown = repr(kind if len(kind) <= _LONGEST_KIND else kind[: _LONGEST_KIND - 3] + "...")
    raise DesignFileError([*loaded.problems, loaded.report("GL109", f"no kind {shown}", ("kind",), help=remedy)])


def _spelled(kind: str) -> str:
    """A kind in the form of their names: numbers in words, words parted by -.

    Example
        >>> _spelled("3_gear-four-bar")
        'three-gear-four-bar'
    """
    return "-".join(_NUMBERS.get(part, part) for part in kind.lower().replace("_", "-").split("-"))


def diagnose_no_solution(loaded: LoadedFile, error: NoSolution) -> Diagnostic:
    """What the engine refuses, at the key that it names or the nearest parent that the file has."""
    path = parse_path(error.key) or _ROOT
    lacks = isinstance(error, MissingSection) and error.key and not error.fix and "`new " not in error.message
    remedy = f"`gearlink new {loaded.data.get('kind')}` shows the keys of {error.key}, with units" if lacks else ""
    return loaded.report(error.code, error.message, path, key=error.key, help=error.fix or remedy, of_several=not lacks)


def validate(loaded: LoadedFile, model: type[Model]) -> Model:
    """The file's data as an instance of a pydantic model.

    Raises
        DesignFileError - with everything that is wrong with the data, and the duplicate keys of the file
    Notes
        Values with units become numbers first. The data go in as JSON: in pydantic's strict mode a list then serves a
        tuple field and text an enum, while a number stays a number. Floats survive, since both sides write and read
        shortest round-trip doubles.
    """
    from pydantic import ValidationError

    of_others, faulty = _read_others(loaded, model)
    wrong = [*loaded.problems, *of_others]
    if renamed := _starts_with_a_number(loaded.data) or _scatters_by_terms(loaded.data):
        from gearlink.cli.reading.units import convert

        wrong += _with_fixed_names(loaded, model, _ROOT)
        wrong += convert(loaded, model)
    odd = list(_odd_values(loaded.data, _ROOT))
    sizes = {path for path, value in odd if not isinstance(value, bool)}
    spec: Model | None = None
    found: list[Diagnostic] = []
    omitted = 0
    try:
        spec = model.model_validate_json(json.dumps(loaded.data))
    except ValidationError as error:
        before = loaded.data
        doubled = [] if renamed else _with_fixed_names(loaded, model, _ROOT)
        if loaded.data is not before:
            loaded.problems += doubled
            return validate(loaded, model)
        from gearlink.cli.reading.model_errors import diagnose
        from gearlink.cli.reading.model_shapes import takes_no_number

        found, omitted = diagnose(loaded, model, error)
        sizes = {path for path in sizes if not takes_no_number(model, path, loaded.data)}
    except NoSolution as error:
        found = [diagnose_no_solution(loaded, error)]
    wrong += [_no_size(loaded, model, path, value) for path, value in odd if path in sizes]
    seen = {diagnostic.key for diagnostic in wrong if diagnostic.code in ("GL108", "GL180", "GL181")}
    found = [d for d in found if not d.key.startswith(faulty)]
    wrong += [diagnostic for diagnostic in found if diagnostic.key not in seen]
    if truths := [path for path, value in odd if isinstance(value, bool)]:
        from gearlink.cli.reading.model_errors import diagnose_truth_values

        seen = {diagnostic.key for diagnostic in wrong}
        wrong += [d for d in diagnose_truth_values(loaded, model, truths) if d.key not in seen]
    if wrong or spec is None:
        raise DesignFileError(wrong, omitted)
    loaded.settle()
    return spec


def _read_others(loaded: LoadedFile, model: type[BaseModel]) -> tuple[list[Diagnostic], tuple[str, ...]]:
    """Put what other files hold instead of their names: designs of members, points of tables.

    Returns
        wrong, keys : what is wrong with them; how the keys of that begin of which nothing more is to be said
    """
    wrong: list[Diagnostic] = []
    keys: list[str] = []
    if section := getattr(model, "section_of_members", ""):
        wrong, faulty = _read_members(loaded, section)
        keys = [f"{member}.design" for member in faulty]
    if "file" in loaded.text or loaded.overrides:
        of_numbers, unread = read_points(loaded)
        wrong, keys = wrong + of_numbers, keys + sorted(unread)
    return wrong, tuple(keys)


def _read_members(loaded: LoadedFile, section: str) -> tuple[list[Diagnostic], set[str]]:
    """Put the design of every member instead of the file that it names; units become numbers in all of them.

    Parameters
        section : str - the key under which the members stand
    Returns
        wrong, keys : what is wrong with them, at its place in their own files; keys of the members that have faults
    """
    members = loaded.data.get(section)
    wrong: list[Diagnostic] = []
    bad: set[str] = set()
    for name, member in members.items() if isinstance(members, dict) else ():
        if not isinstance(member, dict):
            continue
        path = (section, name)
        try:
            design = _design(loaded, path, member)
        except DesignFileError as error:
            wrong += error.diagnostics
            bad.add(format_path(path))
            continue
        if design is not None:
            kept = {key: value for key, value in member.items() if key not in ("of", "design")}
            loaded.data = {**loaded.data, section: {**loaded.data[section], name: {**kept, "design": design}}}
    return wrong, bad


def _design(loaded: LoadedFile, path: KeyPath, member: dict[str, Any]) -> dict[str, Any] | None:
    """The data of a member's design, validated; None where it has none, or two, which the model refuses."""
    of, own = member.get("of"), member.get("design")
    written = loaded.tree.data.get(path[0], {})
    in_file = written.get(path[1], {}) if isinstance(written, dict) else {}
    if isinstance(of, str) and not (isinstance(in_file, dict) and "design" in in_file and "of" in in_file):
        return _of_file(loaded, path, of, own if isinstance(own, dict) else {})
    if of is not None or not isinstance(own, dict):
        return None
    below = loaded.part((*path, "design"))
    try:
        _validate_member(below)
    except DesignFileError as error:
        raise DesignFileError([_below(each, f"{format_path(path)}.design") for each in error.diagnostics]) from None
    return {"name": path[1], **below.data}


def _of_file(loaded: LoadedFile, path: KeyPath, of: str, put_over: dict[str, Any]) -> dict[str, Any]:
    """The data of the file that a member names, with what `--set` puts over it."""
    place = base_path(loaded.file, of)
    if not is_design_name(place.name):
        message = f"the member {place} is not a design file ({', '.join(ENDINGS)})"
        raise DesignFileError([loaded.report("GL101", message, (*path, "of"))])
    try:
        found = load(str(place))
    except DesignFileError as error:
        if error.diagnostics[0].code != "GL101":
            raise
        wrong = error.diagnostics[0]
        message = f"the member {place}: {wrong.message}"
        raise DesignFileError([loaded.report("GL101", message, (*path, "of"), help=wrong.help)]) from None
    if put_over:
        found.data = _over(found.data, put_over)
        found.overrides = [
            each._replace(path=each.path[len(path) + 1 :])
            for each in loaded.overrides
            if each.path[: len(path) + 1] == (*path, "design") and len(each.path) > len(path) + 1
        ]
    _validate_member(found)
    return {"name": stem_of(str(place)), **found.data}


def _validate_member(loaded: LoadedFile) -> None:
    """Validate a member by its kind; one that is none of a member the model of the machine refuses.

    Its own members are not read then: they may be the machine that is being read.
    """
    from gearlink.core.base.kinds import KINDS

    kind = KINDS[read_kind(loaded, tuple(KINDS))]
    if kind.motion:
        validate(loaded, kind.spec_model())


def _over(data: dict[str, Any], put: dict[str, Any]) -> dict[str, Any]:
    """Data with others put over them, section by section."""
    found = dict(data)
    for key, value in put.items():
        both = isinstance(value, dict) and isinstance(found.get(key), dict)
        found[key] = _over(found[key], value) if both else value
    return found


def _below(wrong: Diagnostic, place: str) -> Diagnostic:
    return replace(wrong, key=f"{place}.{wrong.key}" if wrong.key else place)


def _with_fixed_names(loaded: LoadedFile, model: type[BaseModel], section: KeyPath) -> list[Diagnostic]:
    """Give the keys of a section and below that bear standard terms their fixed names; what is given under both.

    What `--set` gives under one name is put over what the file has under the other.
    """
    from gearlink.cli.reading.model_shapes import aliases_at

    wrong: list[Diagnostic] = []
    node: Any = part_of(loaded.data, section)
    aliases = aliases_at(model, section, loaded.data) if isinstance(node, dict) else {}
    for alias, name in aliases.items():
        if alias not in node:
            continue
        if name in node:
            ranks = [loaded.rank((*section, key)) for key in (alias, name)]
            if ranks[0] == ranks[1]:
                message = f"'{alias}' is the standard term for '{name}': both are given"
                wrong.append(loaded.report("GL111", message, (*section, alias), help=f"keep {name}"))
            if ranks[0] <= ranks[1]:
                loaded.drop(section, alias)
                continue
        loaded.rename(section, alias, name)
    if section == _SOURCES and isinstance(node, dict):
        _name_sources(loaded, model)
    node = part_of(loaded.data, section)
    for step, inner in node.items() if isinstance(node, dict) else enumerate(node):
        if isinstance(inner, (dict, list)) and not (inner and isinstance(inner, list) and _plain(inner[0])):
            wrong += _with_fixed_names(loaded, model, (*section, step))
    return wrong


_SOURCES = ("tolerance", "sources")


def _scatters_by_terms(data: dict[str, Any]) -> bool:
    """Whether a source of the tolerances is named by the path of a key that has a standard term in it."""
    try:
        return any(has_term(path) for path in data["tolerance"]["sources"])
    except (LookupError, TypeError, AttributeError):
        return False


def has_term(path: str) -> bool:
    """Whether a path may name a key by its standard term."""
    from gearlink.core.base.spec import STANDARD_TERMS

    return not STANDARD_TERMS.isdisjoint(path.replace("[", ".").split("."))


def _name_sources(loaded: LoadedFile, model: type[BaseModel]) -> None:
    """Give the sources of the tolerances, which are paths, the fixed names of their keys."""
    paths = {path: fixed_path(path, model, loaded.data) for path in part_of(loaded.data, _SOURCES)}
    for path, fixed in paths.items():
        if path != fixed and fixed not in paths:
            loaded.rename(_SOURCES, path, fixed)
    groups = loaded.data["tolerance"].get("correlated")
    for i, group in enumerate(groups if isinstance(groups, list) else ()):
        names = group.get("sources") if isinstance(group, dict) else None
        if isinstance(names, list):
            fixed_names = [paths.get(name, name) if isinstance(name, str) else name for name in names]
            if fixed_names != names:
                loaded.data = _with(loaded.data, ("tolerance", "correlated", i, "sources"), fixed_names, "")


def fixed_path(path: str, model: type[BaseModel], data: Any) -> str:
    """The path of a key by its fixed names, of one that has standard terms in it."""
    from gearlink.cli.reading.model_shapes import aliases_at

    steps = list(parse_path(path) or ()) if has_term(path) else []
    for i, step in enumerate(steps):
        steps[i] = aliases_at(model, tuple(steps[:i]), data).get(str(step), step)
    return format_path(tuple(steps)) if steps else path


def _plain(value: Any) -> bool:
    return not isinstance(value, (dict, list))


def part_of(data: Any, path: KeyPath) -> Any:
    """What stands at a path that the data have."""
    for step in path:
        data = data[step]
    return data


def _starts_with_a_number(node: Any) -> bool:
    """Whether some text of the data begins as a number does, so that it may have a unit."""
    if isinstance(node, str):
        return node.lstrip()[:1] in {*"+-.0123456789"}
    items = node.values() if isinstance(node, dict) else node if isinstance(node, list) else ()
    return any(map(_starts_with_a_number, items))


def _odd_values(node: Any, path: KeyPath) -> Iterator[tuple[KeyPath, Any]]:
    """Numbers that no machine has, not finite ones too, and truth values, which Python takes for 1 and 0."""
    items = node.items() if isinstance(node, dict) else enumerate(node)
    for step, value in items:
        if isinstance(value, (dict, list)):
            yield from _odd_values(value, (*path, step))
        elif isinstance(value, bool) or (isinstance(value, (int, float)) and not has_size(value)):
            yield (*path, step), value


def _no_size(loaded: LoadedFile, model: type[Model], path: KeyPath, value: float) -> Diagnostic:
    key = format_path(path)
    if not math.isfinite(value):
        return loaded.report("GL108", f"{key} is not a finite number", path, help="give a finite number")
    from gearlink.cli.reading.model_shapes import allowed_numbers

    message = f"{key} is {value:g}, which no machine can have"
    allowed = allowed_numbers(model, path, loaded.data, LEAST_SIZE, LARGEST_SIZE)
    return loaded.report("GL108", message, path, help=f"allowed: {allowed}" if allowed else "")


def _quoted(path: str) -> str:
    """A path with the names in quotes that are no words; empty where it is none even so.

    Example
        >>> _quoted("links.first coupler.length"), _quoted("a..b")
        ('links."first coupler".length', '')
    """
    steps = path.split(".")
    whole = ".".join(step if parse_path(step) else f'"{step}"' for step in steps)
    return whole if all(steps) and '""' not in whole and parse_path(whole) else ""


def _override(argument: str | Keyed) -> Override:
    if isinstance(argument, Keyed):
        path = parse_path(argument.path)
        assert path is not None
        return Override(path, argument.value, None, Source(f"<{argument.option}>", str(argument.value)))
    source = Source("<--set>", argument)
    name, sign, text = argument.partition("=")
    path = parse_path(name.strip())
    if not sign or path is None:
        remedy = "write path=value, such as gears.crank=42 or teeth[1]=20"
        message = "no '=' after the path" if not sign else f"{name!r} is not a key path"
        if sign and (quoted := _quoted(name.strip())):
            remedy = f"quote a name that is not a word: --set '{quoted}={text[:40]}'"
        raise DesignFileError([source.report("GL114", message, 0, key=name.strip()[:100], help=remedy)])
    if len(argument) > MAX_BYTES or len(path) > MAX_DEPTH:
        raise DesignFileError([source.report("GL110", "too long or too deep", 0, key=name.strip()[:100])])
    if control := CONTROL.search(argument):
        message = f"character {control[0]!r} is not text"
        raise DesignFileError([source.report("GL114", message, control.start(), key=format_path(path))])
    text = text.strip()
    if text[:1] not in ("[", "{", '"', "'"):
        return Override(path, plain_value(text), None, source)
    try:
        tree = compose(source, argument.index("=") + 1)
    except DesignFileError as error:
        raise DesignFileError(_as_set_errors(error, path)) from None
    if tree.problems:
        raise DesignFileError(tree.problems)
    return Override(path, tree.data, tree.marks, source)


def _as_set_errors(error: DesignFileError, path: KeyPath) -> list[Diagnostic]:
    return [replace(d, code="GL114" if d.code == "GL103" else d.code, key=format_path(path)) for d in error.diagnostics]


def _apply(loaded: LoadedFile, override: Override) -> None:
    try:
        loaded.data = _with(loaded.data, override.path, override.value, "")
    except _NoPlace as error:
        key = format_path(override.path)
        raise DesignFileError([override.source.report("GL114", str(error), 0, key=key)]) from None
    depth = len(override.path)
    loaded.overrides = [*(other for other in loaded.overrides if other.path[:depth] != override.path), override]


class _NoPlace(Exception):
    """A path of `--set` that leads through something other than sections and lists."""


def _with(node: Any, path: KeyPath, value: Any, name: str) -> Any:
    """A copy of the data with one value put in; what is beside the path is shared, since aliases share it too."""
    if not path:
        return value
    step, rest = path[0], path[1:]
    inner = format_path((step,)) if not name else name + (f"[{step}]" if isinstance(step, int) else f".{step}")
    if isinstance(step, int):
        if not isinstance(node, list):
            raise _NoPlace(f"{name} is not a list: {_in_place_of_an_index(node, name)}")
        if step >= len(node):
            raise _NoPlace(f"{name} has {amount(len(node), 'element')}, counted from [0]")
        return [*node[:step], _with(node[step], rest, value, inner), *node[step + 1 :]]
    if node is not None and not isinstance(node, dict):
        wanted = f"\nwrite {name}[{step}]" if isinstance(node, list) and step.isdecimal() and step.isascii() else ""
        raise _NoPlace(f"{name} is not a section, so it has no key '{step}'{wanted}")
    section = {} if node is None else node
    return {**section, step: _with(section.get(step), rest, value, inner)}


def _in_place_of_an_index(node: Any, name: str) -> str:
    if isinstance(node, dict):
        return f"it is a section, write {name}.KEY"
    return f"write {name}=[...] with all its elements" if node is None else f"write {name}=VALUE"


def _unreadable(name: str, error: Exception) -> Diagnostic:
    if isinstance(error, FileNotFoundError):
        return _missing(name)
    if isinstance(error, IsADirectoryError):
        return Diagnostic("GL101", "this is a folder", name, help="`gearlink batch` takes folders")
    if isinstance(error, PermissionError):
        return Diagnostic("GL101", "no permission to read it", name)
    if isinstance(error, OSError) and error.errno == errno.ELOOP:
        return Diagnostic("GL101", "a link that leads back to itself", name, help="delete it")
    reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return Diagnostic("GL101", f"cannot be read: {reason}", name)


def _missing(name: str) -> Diagnostic:
    if os.path.islink(name):
        message = f"a link to {os.readlink(name)}, which does not exist"
        return Diagnostic("GL101", message, name, help="restore that file, or delete the link")
    return Diagnostic("GL101", "no such file", name, help=nearest_file(name))


_MOST_ROWS = 100_000
_DELIMITERS = (";", "\t", ",")


def read_points(loaded: LoadedFile) -> tuple[list[Diagnostic], set[str]]:
    """Put the points of every file of numbers instead of its name; those of table laws, measured profiles and motions.

    Returns
        wrong, keys : what is wrong with the files, at its place in them; keys of what has no points for that
    """
    wrong: list[tuple[KeyPath, Diagnostic]] = []
    loaded.data = _filled(loaded, loaded.data, (), wrong)
    return [each for _, each in wrong], {format_path(path) for path, _ in wrong}


def _filled(loaded: LoadedFile, node: Any, path: KeyPath, wrong: list[tuple[KeyPath, Diagnostic]]) -> Any:
    if isinstance(node, list) and any(isinstance(item, dict) for item in node):
        return [_filled(loaded, item, (*path, k), wrong) for k, item in enumerate(node)]
    if not isinstance(node, dict):
        return node
    of_motion = path[-1:] == ("motion",)
    if isinstance(name := node.get("file"), str) and (
        of_motion or node.get("type") == "table" or path[-1:] == ("profile",)
    ):
        into = "table" if of_motion else "points"
        if into in node:
            return node  # the model refuses both
        try:
            points = _points(loaded, name, (*path, "file"), _columns(loaded, node, path) if of_motion else None)
            if of_motion and node.get("degrees") is False:
                points = [[math.degrees(angle), value] for angle, value in points]
            read = ("file", "columns", "degrees") if of_motion else ("file",)
            return {**{key: item for key, item in node.items() if key not in read}, into: points}
        except DesignFileError as error:
            wrong += [(path, each) for each in error.diagnostics]
            return node
    found = {key: _filled(loaded, item, (*path, key), wrong) for key, item in node.items()}
    return node if all(found[key] is node[key] for key in found) else found


def _columns(loaded: LoadedFile, node: dict[str, Any], path: KeyPath) -> tuple[int, int]:
    """The columns of a file that count, from 1."""
    given = node.get("columns", [1, 2])
    if not (isinstance(given, list) and len(given) == 2 and all(type(each) is int and each > 0 for each in given)):
        message = "columns must be the numbers of two columns, counted from 1"
        raise DesignFileError([loaded.report("GL107", message, (*path, "columns"), help="write columns: [1, 2]")])
    return given[0], given[1]


def _points(loaded: LoadedFile, name: str, path: KeyPath, columns: tuple[int, int] | None = None) -> list[list[float]]:
    place = base_path(loaded.file, name)
    if place.suffix.lower() in (".xlsx", ".xls", ".ods"):
        message = f"{name} is a workbook of a spreadsheet"
        raise DesignFileError([loaded.report("GL182", message, path, help="save it as CSV")])
    try:
        content = place.read_bytes()
        text = content.decode("utf-8-sig")
    except OSError as error:
        message = f"cannot read {place}: {error.strerror or error}"
        raise DesignFileError([loaded.report("GL101", message, path, help=nearest_file(str(place)))]) from None
    except UnicodeDecodeError:
        message = f"{name} is not a text in UTF-8"
        raise DesignFileError([loaded.report("GL182", message, path, help="save it as CSV in UTF-8")]) from None
    note(place, content)
    return rows_of(Source(str(place), text), columns)


def rows_of(source: Source, columns: tuple[int, int] | None = None) -> list[list[float]]:
    """The pairs of numbers of a text: the delimiter is counted, lines of words at the top are skipped.

    Parameters
        columns : (int, int) - which of its columns, from 1; by default a row has two
    Notes
        A decimal comma stands where the delimiter is another character.
    Raises
        DesignFileError - GL182, at the cell
    """
    lines = [line.strip() for line in source.text.splitlines()]
    delimiter = max(_DELIMITERS, key=lambda each: sum(each in line for line in lines))
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        if not line or line.startswith("#"):
            continue
        cells = line.split(delimiter)
        chosen = range(len(cells)) if columns is None else [k - 1 for k in columns if k <= len(cells)]
        values = [_number(cells[k], delimiter) for k in chosen]
        if not rows and (not values or values[0] is None):  # words at the top
            continue
        if len(values) != 2 or None in values:
            bad = chosen[values.index(None)] if None in values else min(2, len(cells))
            at = source.line_start(number) + len(delimiter.join(cells[:bad])) + (bad > 0)
            count = f"{len(cells)} numbers in a row" if columns is None else f"no column {max(columns)} in a row"
            what = f"{cells[bad].strip()!r} is not a number" if None in values else count
            fix = "give two numbers a row, with a delimiter between them, or name two of the columns"
            raise DesignFileError([source.report("GL182", what, min(at, len(source.text)), help=fix)])
        rows.append([value for value in values if value is not None])
        if len(rows) > _MOST_ROWS:
            at = source.line_start(number)
            raise DesignFileError([source.report("GL182", f"more than {_MOST_ROWS} rows", at, help="omit rows")])
    if not rows:
        fix = "give two numbers a row, with a comma, a semicolon or a tab between them"
        raise DesignFileError([source.report("GL182", "no row of numbers", 0, help=fix)])
    return rows


def _number(cell: str, delimiter: str) -> float | None:
    text = cell.strip() if delimiter == "," else cell.strip().replace(",", ".")
    try:
        return float(text)
    except ValueError:
        return None
