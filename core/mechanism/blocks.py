"""The order in which the sparse system of equations of a mechanism is solved block by block.

A mechanism is a chain of groups of links; each group can be solved once the groups it depends on are solved. The
order follows from the structure alone: a perfect matching of equations and unknowns, and its strongly connected
parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple, TypeAlias

Pattern: TypeAlias = tuple[tuple[int, ...], ...]


class Block(NamedTuple):
    """A part of a system that is solved at once; its unknowns occur in no block before it."""

    rows: tuple[int, ...]
    columns: tuple[int, ...]


@lru_cache(maxsize=256)
def blocks(pattern: Pattern) -> tuple[Block, ...]:
    """The blocks in the order in which they can be solved.

    Parameters
        pattern : by unknown - the equations in which it occurs
    Returns
        blocks : what a block needs stands before it; all in one where the structure alone is singular
    Example
        >>> blocks(((0, 1), (1, 2), (2,)))
        (Block(rows=(0,), columns=(0,)), Block(rows=(1,), columns=(1,)), Block(rows=(2,), columns=(2,)))

    Source
        Dulmage and Mendelsohn; R. Tarjan
    """
    matched = _matching(pattern)
    size = len(pattern)
    if matched is None:
        return (Block(tuple(range(size)), tuple(range(size))),)
    # an unknown is needed by those whose own equation it occurs in
    owner = {row: column for column, row in enumerate(matched)}
    needs: list[list[int]] = [[] for _ in range(size)]
    for column, rows in enumerate(pattern):
        for row in rows:
            if owner[row] != column:
                needs[owner[row]].append(column)
    return tuple(Block(tuple(matched[c] for c in part), tuple(part)) for part in _connected(needs))


def _matching(pattern: Pattern) -> list[int] | None:
    """An equation for each unknown, none twice; None where there is no such choice."""
    taken: dict[int, int] = {}

    def place(column: int, seen: set[int]) -> bool:
        for row in pattern[column]:
            if row in seen:
                continue
            seen.add(row)
            if row not in taken or place(taken[row], seen):
                taken[row] = column
                return True
        return False

    # those that occur in few equations first: hardly any has to move then
    order = sorted(range(len(pattern)), key=lambda column: len(pattern[column]))
    if not all(place(column, set()) for column in order):
        return None
    found = [0] * len(pattern)
    for row, column in taken.items():
        found[column] = row
    return found


def _connected(needs: Sequence[Sequence[int]]) -> list[list[int]]:
    """Strongly connected parts, each after those that it needs."""
    number: dict[int, int] = {}
    lowest: dict[int, int] = {}
    stack: list[int] = []
    parts: list[list[int]] = []

    def visit(node: int) -> None:
        number[node] = lowest[node] = len(number)
        stack.append(node)
        for other in needs[node]:
            if other not in number:
                visit(other)
                lowest[node] = min(lowest[node], lowest[other])
            elif other in stack:
                lowest[node] = min(lowest[node], number[other])
        if lowest[node] == number[node]:
            part = stack[stack.index(node) :]
            del stack[stack.index(node) :]
            parts.append(sorted(part))

    for node in range(len(needs)):
        if node not in number:
            visit(node)
    return parts
