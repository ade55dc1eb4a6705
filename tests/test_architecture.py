"""The floor plan: no circle of imports, lazy ones counted, and nothing imports what stands above it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest
from sources import tree
from sweeps import ALL

ROOT = Path(__file__).parents[1]
MACHINES = sorted(path.stem for path in (ROOT / "core/machines").iterdir() if not path.name.startswith("__"))
LEVELS = ("base", "numerics", "mechanism", "parts", "studies", "machines")
"""The rooms of core from below: none imports one that stands above it."""


def _modules() -> dict[str, Path]:
    found = {}
    for top in ("core", "cli"):
        for path in (ROOT / top).rglob("*.py"):
            name = path.relative_to(ROOT).with_suffix("").as_posix().replace("/", ".")
            found[name.removesuffix(".__init__")] = path
    return found


MODULES = _modules()


_TYPING = re.compile(r"^( *)if TYPE_CHECKING:\n(?:\1 +.*\n|\n)+", re.MULTILINE)
_IMPORT = re.compile(r"^ *(?:from gearlink\.([\w.]+) import (\([^)]*\)|.*)|import gearlink\.([\w.]+))", re.MULTILINE)


def _imported(text: str) -> Iterator[str]:
    """Modules that a piece of code imports when it runs, at its head or inside a function; annotations do not run.

    By the lines, as the formatter writes them: to parse all modules takes twenty times as long.
    """
    for base, names, module in _IMPORT.findall(_TYPING.sub("", text)):
        if module:
            yield module
        for name in re.findall(r"(\w+)(?: as \w+)?", re.sub("#.*", "", names)):
            yield f"{base}.{name}" if f"{base}.{name}" in MODULES else base


def _parsed(node: ast.AST) -> Iterator[str]:
    """The same by walking the statements."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.expr):
            continue  # imports are statements
        if isinstance(child, ast.If) and "TYPE_CHECKING" in ast.dump(child.test):
            continue
        if isinstance(child, ast.ImportFrom) and child.module and child.module.startswith("gearlink."):
            base = child.module.removeprefix("gearlink.")
            for alias in child.names:
                yield f"{base}.{alias.name}" if f"{base}.{alias.name}" in MODULES else base
        elif isinstance(child, ast.Import):
            yield from (alias.name.removeprefix("gearlink.") for alias in child.names)
        yield from _parsed(child)


@cache
def arrows() -> dict[str, set[str]]:
    """Which module imports which."""
    return {
        name: {other for other in _imported(path.read_text(encoding="utf-8")) if other in MODULES} - {name}
        for name, path in MODULES.items()
    }


@pytest.mark.slow
def test_lines_tell_what_statements_import() -> None:
    for name, path in MODULES.items():
        text = path.read_text(encoding="utf-8")
        parsed = {other for other in _parsed(ast.parse(text)) if other in MODULES} - {name}
        assert arrows()[name] == parsed, name


def _room(module: str, depth: int = 2) -> str:
    """The package of that depth that a module stands in, or the module itself where it stands above."""
    return ".".join(module.split(".")[:depth])


def _circle(graph: dict[str, set[str]]) -> list[str]:
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return list(error.args[1])
    return []


def test_the_walk_sees_imports() -> None:
    assert "core.base.design" in arrows()["core.machines.gear_pair.design"]
    assert "cli.batch.run" in arrows()["cli.app"]  # a lazy one


def test_no_circle_of_modules() -> None:
    assert _circle(arrows()) == []


@pytest.mark.parametrize("depth", [2, 3])
def test_no_circle_of_rooms(depth: int) -> None:
    """Neither among the packages of core and cli, nor among those within one of them."""
    rooms: dict[str, set[str]] = {}
    for module, others in arrows().items():
        rooms.setdefault(_room(module, depth), set()).update(_room(other, depth) for other in others)
    assert _circle({room: others - {room} for room, others in rooms.items()}) == []


def test_core_does_not_know_the_command_line() -> None:
    assert not [
        (a, b) for a, others in arrows().items() for b in others if a.startswith("core") and b.startswith("cli")
    ]


def test_core_stands_in_its_levels() -> None:
    """A machine asks for studies, a study for mechanisms and parts, all of them for numbers and for what a file is."""
    level = {f"core.{name}": k for k, name in enumerate(LEVELS)}
    assert {_room(name) for name in MODULES if name.startswith("core.")} - level.keys() <= {"core.version"}
    pairs = [(a, b) for a, others in arrows().items() for b in others if _room(a) in level and _room(b) in level]
    assert pairs
    assert not [(a, b) for a, b in pairs if level[_room(a)] < level[_room(b)]]


@pytest.mark.parametrize("machine", MACHINES)
def test_no_machine_imports_another(machine: str) -> None:
    own = [name for name in MODULES if _room(name, 3) == f"core.machines.{machine}"]
    others = {f"core.machines.{name}" for name in MACHINES if name != machine}
    assert own
    assert not [(a, b) for a in own for b in arrows()[a] if _room(b, 3) in others]


def test_mechanism_knows_numbers_alone() -> None:
    own = [name for name in MODULES if name.startswith("core.mechanism.")]
    allowed = {"core.mechanism", "core.numerics", "core.base"}
    assert not [(a, b) for a in own for b in arrows()[a] if _room(b) not in allowed]


def test_each_package_says_what_stands_there() -> None:
    for path in (ROOT / top for top in ("core", "cli")):
        for init in path.rglob("__init__.py"):
            assert ast.get_docstring(ast.parse(init.read_text(encoding="utf-8"))), init


_NESTED = (ast.FunctionDef, ast.ClassDef)


_HEADS = re.compile(
    r"^(?:from gearlink\.[\w.]+ import (?:\([^)]*\)|.*)|class \w+(?:\((?:[^()]|\([^()]*\))*\))?:)", re.MULTILINE
)
_BLOCK = re.compile(r"^( *)(def |class |@)", re.MULTILINE)


@cache
def _text(module: str) -> str:
    return MODULES[module].read_text(encoding="utf-8")


def _head(module: str) -> ast.Module:
    """The imports at the head of a module and its classes without what is in them, by the lines."""
    return ast.parse("\n".join(found + " ..." * found.endswith(":") for found in _HEADS.findall(_text(module))))


def _may_be_long(module: str) -> bool:
    """Whether 50 lines or more lead from a function to the next one that is not in it."""
    text = _text(module)
    starts = [(len(found[1]), text.count("\n", 0, found.start()), found[2]) for found in _BLOCK.finditer(text)]
    end = text.count("\n")
    return any(
        next((other for inner, other, _ in starts[i + 1 :] if inner <= indent), end) - line >= 50
        for i, (indent, line, word) in enumerate(starts)
        if word == "def "
    )


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """What stands in a module, a class or a function, without the expressions: six sevenths of all nodes."""
    for name in ("body", "orelse", "finalbody", "handlers", "cases"):
        inner = getattr(node, name, ())
        for each in inner if isinstance(inner, list) else ():
            yield each
            yield from _statements(each)


def test_models_have_types_for_annotations() -> None:
    """A text would be compiled and evaluated for its own class and again for every class that stands on that one."""
    models = [
        name for name in MODULES if re.search(r"spec$|\.keys\b", name) and "\nfrom pydantic import" in _text(name)
    ]
    assert len(models) > 40
    assert [name for name in models if "from __future__" in _text(name)] == []


def test_a_function_fits_a_screen() -> None:
    """A module is a subject, whatever its length; a function has fewer than 50 lines, but for those in it."""
    for name in MODULES if ALL else filter(_may_be_long, MODULES):
        for node in _statements(tree(MODULES[name])):
            if isinstance(node, ast.FunctionDef):
                body = [each for each in node.body[bool(ast.get_docstring(node)) :] if not isinstance(each, _NESTED)]
                lines = sum((each.end_lineno or 0) - each.lineno + 1 for each in body)
                assert lines < 50, f"{name}.{node.name}: {lines} lines"


MOST_LEVELS = 4
"""Of inheritance among classes of our own: what reaches deeper is made of parts instead."""


def _named(module: str, head: ast.Module) -> dict[str, str]:
    """What the names at the head of a module stand for: "module:name" of what it imports, "module:" of a module."""
    found = {}
    for node in head.body:
        if isinstance(node, ast.ImportFrom) and node.module and node.module.startswith("gearlink."):
            base = node.module.removeprefix("gearlink.")
            for alias in node.names:
                whole = f"{base}.{alias.name}"
                found[alias.asname or alias.name] = f"{whole}:" if whole in MODULES else f"{base}:{alias.name}"
        elif isinstance(node, ast.ClassDef):
            found[node.name] = f"{module}:{node.name}"
    return found


def _classes_of(module: str, head: ast.Module) -> dict[str, list[str]]:
    """The bases of our own of each class of a module, by "module:name"."""
    found, named = {}, _named(module, head)
    for node in head.body:
        if isinstance(node, ast.ClassDef):
            words = (ast.unparse(base).partition("[")[0].partition(".") for base in node.bases)
            bases = (named.get(first, "") + rest for first, _, rest in words)
            found[f"{module}:{node.name}"] = [base for base in bases if base]
    return found


@cache
def _classes() -> dict[str, list[str]]:
    """Of all modules."""
    return {name: bases for module in MODULES for name, bases in _classes_of(module, _head(module)).items()}


@pytest.mark.slow
def test_lines_tell_what_classes_stand_on() -> None:
    for module, path in MODULES.items():
        assert _classes_of(module, _head(module)) == _classes_of(module, tree(path)), module


def _levels(name: str) -> int:
    return 1 + max((_levels(base) for base in _classes()[name] if base in _classes()), default=0)


def test_no_class_stands_on_more_than_three_of_our_own() -> None:
    assert _levels("core.machines.three_gear.dwell_synthesis:DwellSynthesis") == MOST_LEVELS
    deep = {name: levels for name in _classes() if (levels := _levels(name)) > MOST_LEVELS}
    assert not deep
