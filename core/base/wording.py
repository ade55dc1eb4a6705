"""Words of numbers, as messages need them."""

from __future__ import annotations


def amount(count: float, one: str, many: str = "", spec: str = "") -> str:
    """A number with what it counts, in the singular where it is one.

    Parameters
        count : float - how many
        one, many : str - a word in the singular, and its plural where that is not formed by s
        spec : str - how the number is written, "," or "g"
    Example
        >>> amount(1, "input"), amount(2, "input"), amount(1.0, "tooth", "teeth", "g"), amount(1200, "row", spec=",")
        ('1 input', '2 inputs', '1 tooth', '1,200 rows')
    """
    return f"{count:{spec}} {one if count == 1 else many or one + 's'}"
