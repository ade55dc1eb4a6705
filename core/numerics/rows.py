"""Which rows of a table are wanted."""

from __future__ import annotations


class Rows(int):
    """A number of rows of a table, of which `size` from number `first` on are wanted.

    A table that cannot be cut takes it for the number alone, and is whole.
    """

    first: int
    size: int

    @classmethod
    def part(cls, count: int, first: int, size: int) -> Rows:
        """So many of the `count` rows."""
        rows = cls(count)
        rows.first, rows.size = first, size
        return rows
