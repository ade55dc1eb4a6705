"""Where a rising function of an interval has given values, nearly: what Newton's steps begin from."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Reals


@dataclass(frozen=True, slots=True, eq=False)
class RisingTable:
    """A rising function at some places, read backwards.

    Fields
        places : (N,) array - ascending
        values : (N,) array - of the function there, ascending
        slopes : (N,) array - of the function there, not negative
    """

    places: Reals
    values: Reals
    slopes: Reals

    def places_of(self, values: Reals) -> Reals:
        """About where the function has these values, by cubics with the slopes of the inverse at both neighbours.

        Parameters
            values : (M,) array - within those of the table
        Returns
            places : (M,) array - between the neighbours
        Notes
            The error falls as the fourth power of the step. A slope above three times that of the chord counts as
            three times, with which a cubic rises all the way.
        Example
            >>> x = np.linspace(0.0, 1.0, 17)
            >>> table = RisingTable(x, np.expm1(x), np.exp(x))
            >>> round(float(table.places_of(np.array([0.5]))[0]), 6), round(float(np.log(1.5)), 6)
            (0.405465, 0.405465)

        Source
            Fritsch and Carlson, SIAM J. Numer. Anal. 17 (1980) 238, for the bound on the slopes
        """
        left = np.clip(np.searchsorted(self.values, values, side="right") - 1, 0, len(self.values) - 2)
        start, width = self.values[left], np.diff(self.values)[left]
        rise = np.diff(self.places)[left]
        with np.errstate(divide="ignore"):
            slopes = 1.0 / self.slopes
        t = (values - start) / width
        first, last = (np.minimum(width * slopes[row], 3.0 * rise) for row in (left, left + 1))
        cubic = t * (first + t * ((3.0 * rise - 2.0 * first - last) + t * (first + last - 2.0 * rise)))
        found: Reals = self.places[left] + np.clip(cubic, 0.0, rise)
        return found
