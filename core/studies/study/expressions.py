"""Expressions of quantities as study files write them: read by hand, never run as code."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from gearlink.core.base.errors import GearlinkError

Tree: TypeAlias = "float | str | tuple[str, list[Tree]]"
"""A number, the name of a quantity (with its index), or an operation on trees."""

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)|(?P<name>[A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*(?:\[\d{1,6}\])?)"
    r"|(?P<sign>[-+*/(),]))"
)
_FUNCTIONS = {"abs": (1, 1), "sqrt": (1, 1), "min": (1, 99), "max": (1, 99)}
_SIGNS: dict[str, Callable[[Any, Any], Any]] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
}
_DEEPEST, _LONGEST = 50, 1000
MOST_OPERATIONS = 250
"""Of an expression with all that is defined in it: each may stand below the one before."""


class NotAnExpression(GearlinkError):
    """A text that is no expression; `at` is the position of the character where reading failed."""

    def __init__(self, message: str, at: int) -> None:
        super().__init__(message)
        self.at = at


@dataclass(frozen=True)
class Expression:
    """An expression of quantities.

    Parameters
        text : str - as the file has it
        operations : int - signs and functions of the tree
    Example
        >>> found = parse("frame_length + 2 * tip_radius[1]")
        >>> list(found.names), found.value({"frame_length": 10.0, "tip_radius[1]": 4.0})
        (['frame_length', 'tip_radius[1]'], 18.0)
    """

    text: str
    tree: Tree
    operations: int

    @property
    def names(self) -> dict[str, None]:
        """Quantities that it names, each with its index, in the order of the text."""
        return dict.fromkeys(_names(self.tree))

    def value(self, quantities: Mapping[str, Any]) -> Any:
        """Its value.

        Parameters
            quantities : floats, or arrays of one shape, by the names of `names`
        Returns
            value : float or array; NaN where a root or a quotient does not exist
        """
        import numpy as np

        with np.errstate(all="ignore"):
            value = _value(self.tree, quantities)
        return float(value) if np.ndim(value) == 0 else value

    def unit(self, unit_of: Callable[[str], str | None]) -> str | None:
        """Common unit of its operands under + - min max abs and beside pure numbers; None where any will do.

        Example
            >>> units = {"length": "mm", "angle": "deg"}
            >>> [parse(text).unit(units.get) for text in ("2 * length", "max(length, angle)", "length * length")]
            ['mm', None, None]
        """
        found = _unit(self.tree, unit_of)
        return found or None


def parse(text: str) -> Expression:
    """Read an expression: numbers, quantities, `[i]`, + - * /, min, max, abs, sqrt, brackets.

    Raises
        NotAnExpression
    """
    if len(text) > _LONGEST:
        raise NotAnExpression(f"longer than {_LONGEST} characters", _LONGEST)
    reader = _Reader(text)
    tree = reader.sum(0)
    if reader.kind:
        raise NotAnExpression(f"{reader.token!r} does not belong here", reader.at)
    return Expression(text.strip(), tree, reader.operations)


class _Reader:
    """Reads by recursive descent; `token` is the next one."""

    def __init__(self, text: str) -> None:
        self._text, self._end, self.operations = text, 0, 0
        self.step()

    def _counted(self) -> None:
        self.operations += 1
        if self.operations > MOST_OPERATIONS:
            raise NotAnExpression(f"more than {MOST_OPERATIONS} operations", self.at)

    def step(self) -> str:
        """Take the token; give it."""
        taken = getattr(self, "token", "")
        rest = self._text[self._end :]
        self.at = self._end + len(rest) - len(rest.lstrip())
        found = _TOKEN.match(self._text, self._end)
        if found is None:
            if rest.strip().startswith("["):
                raise NotAnExpression("an index is a whole number counted from 0, as in tip_radius[0]", self.at)
            if rest.strip():
                raise NotAnExpression(f"{rest.strip()[0]!r} is no part of an expression", self.at)
            self.kind, self.token = "", ""
            return taken
        self.kind, self.token = str(found.lastgroup), found[found.lastgroup or 0]
        self._end = found.end()
        return taken

    def sum(self, depth: int) -> Tree:
        """Terms between + and -."""
        if depth > _DEEPEST:
            raise NotAnExpression("too many brackets in each other", self.at)
        tree = self._product(depth)
        while self.token in ("+", "-"):
            self._counted()
            sign = self.step()
            tree = (sign, [tree, self._product(depth)])
        return tree

    def _product(self, depth: int) -> Tree:
        tree = self._factor(depth)
        while self.token in ("*", "/"):
            self._counted()
            sign, at = self.step(), self.at
            factor = self._factor(depth)
            if sign == "/" and not any(_names(factor)) and Expression("", factor, 0).value({}) == 0.0:
                raise NotAnExpression("a division by 0", at)
            tree = (sign, [tree, factor])
        return tree

    def _factor(self, depth: int) -> Tree:
        signs = 0
        while self.token in ("-", "+"):
            signs += self.step() == "-"
        atom = self._atom(depth)
        return ("*", [-1.0, atom]) if signs % 2 else atom

    def _atom(self, depth: int) -> Tree:
        if self.kind == "number":
            return float(self.step())
        if self.kind == "name":
            name = self.step()
            return self._call(name, depth) if self.token == "(" else name
        if self.token == "(":
            self.step()
            tree = self.sum(depth + 1)
            self._close()
            return tree
        message = f"{self.token!r} does not belong here" if self.token else "a number or a quantity is missing"
        raise NotAnExpression(message, self.at)

    def _call(self, name: str, depth: int) -> Tree:
        if name not in _FUNCTIONS:
            raise NotAnExpression(f"no function {name}; there are {', '.join(_FUNCTIONS)}", self.at)
        arguments: list[Tree] = []
        while self.token in ("(", ","):
            self.step()
            arguments.append(self.sum(depth + 1))
        self._close()
        least, most = _FUNCTIONS[name]
        if not least <= len(arguments) <= most:
            raise NotAnExpression(f"{name} takes {least} value{'' if most == 1 else ' or more'}", self.at)
        self._counted()
        return (name, arguments)

    def _close(self) -> None:
        if self.token != ")":
            raise NotAnExpression("a bracket is not closed", self.at)
        self.step()


def with_definitions(expression: Expression, defined: Mapping[str, Expression]) -> Expression:
    """An expression with others put in for the names that they are defined under.

    Raises
        NotAnExpression - where it grows beyond all use
    """
    operations = expression.operations + sum(
        defined[name].operations for name in _names(expression.tree) if name in defined
    )
    if operations > MOST_OPERATIONS:
        text = f"with what is defined in it, it has {operations} operations, more than {MOST_OPERATIONS}"
        raise NotAnExpression(text, 0)
    return Expression(expression.text, _with(expression.tree, defined), operations)


def _with(tree: Tree, defined: Mapping[str, Expression]) -> Tree:
    if isinstance(tree, str):
        return defined[tree].tree if tree in defined else tree
    return (tree[0], [_with(part, defined) for part in tree[1]]) if isinstance(tree, tuple) else tree


def _names(tree: Tree) -> Iterator[str]:
    if isinstance(tree, str):
        yield tree
    elif isinstance(tree, tuple):
        for part in tree[1]:
            yield from _names(part)


def _value(tree: Tree, quantities: Mapping[str, Any]) -> Any:
    import numpy as np

    if isinstance(tree, str):
        return quantities[tree]
    if not isinstance(tree, tuple):
        return tree
    name, values = tree[0], [_value(part, quantities) for part in tree[1]]
    if name in _SIGNS:
        return _SIGNS[name](np.float64(values[0]) if isinstance(values[0], float) else values[0], values[1])
    if name in ("min", "max"):
        least = np.minimum if name == "min" else np.maximum
        total = values[0]
        for value in values[1:]:
            total = least(total, value)
        return total
    return np.abs(values[0]) if name == "abs" else np.sqrt(values[0])


def _unit(tree: Tree, unit_of: Callable[[str], str | None]) -> str | None:
    """The unit; "" of a pure number, None where it is not determined."""
    if isinstance(tree, str):
        return unit_of(tree)
    if not isinstance(tree, tuple):
        return ""
    name, units = tree[0], [_unit(part, unit_of) for part in tree[1]]
    if name == "sqrt":
        return "" if units == [""] else None
    if name == "*":
        return units[0] if units[1] == "" else units[1] if units[0] == "" else None
    if name == "/":
        return units[0] if units[1] == "" else None
    kinds = {unit for unit in units if unit != ""}
    return "" if not kinds else kinds.pop() if len(kinds) == 1 else None
