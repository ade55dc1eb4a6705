"""The first half of a symmetric motion law, and its mirror image.

A symmetric law is known from its first half: a `Piece` gives the integral of the rise, the rise and its first
derivatives up to the piece's end. The same code serves a float and a float64 array.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

# (x, low, high) -> derivatives low..high, counted from -1: the integral of the rise, wanted where a velocity
# follows the law.
Piece: TypeAlias = Callable[[Any, int, int], tuple[Any, ...]]


@dataclass(frozen=True, slots=True)
class FirstHalf:
    """The first half of a symmetric rest-to-rest law: its pieces with their ends, and its peak values.

    Attributes
        pieces : ((end, piece), ...) - ends ascending to 1/2; a piece serves x < end, the last one x = 1/2 too
        peak_velocity, peak_acceleration, interior_jerk, peak_power : float - largest v, |a|, |j| (beside the
            jumps of a) and v a
        end_jumps, middle_jumps : bool - the acceleration is not zero at 0, or jumps before or at 1/2
    """

    pieces: tuple[tuple[float, Piece], ...]
    peak_velocity: float
    peak_acceleration: float
    interior_jerk: float
    peak_power: float
    end_jumps: bool = False
    middle_jumps: bool = False

    def derivatives(self, x: Any, low: int, high: int) -> tuple[Any, ...]:
        """Derivatives low to high over the whole law, its second half by s(x) = 1 - s(1 - x)."""
        if not isinstance(x, float):
            return self._of_array(x, low, high)
        if x <= 0.5:
            return self._piece_at(x)(x, low, high)
        y = 1.0 - x
        first = self._piece_at(y)(y, low, high)
        return tuple(_mirrored(k, value, x) for k, value in enumerate(first, start=low))

    def _piece_at(self, y: float) -> Piece:
        for end, piece in self.pieces:
            if y < end:
                return piece
        return self.pieces[-1][1]

    def _of_array(self, x: NDArray[np.float64], low: int, high: int) -> tuple[NDArray[np.float64], ...]:
        import numpy as np

        upper = x > 0.5
        y = np.where(upper, 1.0 - x, x)
        first = _by_piece(self.pieces, y, low, high)
        return tuple(np.where(upper, _mirrored(k, value, x), value) for k, value in enumerate(first, start=low))


def _by_piece(
    pieces: tuple[tuple[float, Piece], ...], y: NDArray[np.float64], low: int, high: int
) -> tuple[NDArray[np.float64], ...]:
    if len(pieces) == 1:
        return pieces[0][1](y, low, high)
    import numpy as np

    index = np.searchsorted([end for end, _ in pieces[:-1]], y, side="right")
    values = tuple(np.empty_like(y) for _ in range(high - low + 1))
    for number, (_, piece) in enumerate(pieces):
        here = index == number
        if here.any():
            for value, part in zip(values, piece(y[here], low, high), strict=True):
                value[here] = part
    return values


def _mirrored(k: int, value: Any, x: Any) -> Any:
    if k == -1:
        return value + (x - 0.5)
    if k == 0:
        return 1.0 - value
    return 0.0 - value if k % 2 == 0 else value
