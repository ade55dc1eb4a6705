"""The rows of a table that are requested: all, or a part of them."""

from __future__ import annotations

FEWEST_ROWS, MOST_ROWS = 2, 10_000_000
"""Of a revolution or stroke: its ends; what is more than memory is asked for by mistake."""


class Rows(int):
    """A number of rows of a table, of which `size` from number `first` on are wanted.

    A table that cannot be cut takes it for the number alone, and is whole.
    """

    first: int
    size: int
    cut = False
    """Whether a table took its part of the rows."""

    @classmethod
    def part(cls, count: int, first: int, size: int) -> Rows:
        """So many of the `count` rows."""
        rows = cls(count)
        rows.first, rows.size = first, size
        return rows


def row_numbers(samples: int | None, count: int) -> range:
    """The numbers of the rows that are wanted of a table of so many rows.

    Example
        >>> row_numbers(7, 8), row_numbers(Rows.part(7, 5, 10), 8)
        (range(0, 8), range(5, 8))
    """
    if isinstance(samples, Rows):
        samples.cut = True
        return range(min(samples.first, count), min(samples.first + samples.size, count))
    return range(count)
