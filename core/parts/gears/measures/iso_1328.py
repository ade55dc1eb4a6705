"""Tolerances of gear teeth by ISO 1328-1, editions 1995 and 2013."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.ranges import row_of

EDITION = 2013


def cumulative_pitch(grade: int, module: float, diameter: float, width: float) -> float:
    """Allowed cumulative pitch deviation of a gear.

    F_pT = (0.002 d + 0.55 sqrt d + 0.7 m + 12) k, k = sqrt(2)^(A - 5), in um

    Parameters
        grade : int - flank tolerance class A, 1 to 11
        module : float [mm] - normal module, 0.5 to 70
        diameter : float [mm] - reference diameter, 5 to 15000
        width : float [mm] - face width, 4 to 1200: the standard holds for no other
    Returns
        tolerance : float [mm] - rounded as the standard does
    Raises
        NoSolution - outside of the standard's range: nothing is extrapolated
    Notes
        Edition 1995 has other formulas and grades.
    Example
        >>> cumulative_pitch(6, 3, 120, 30)
        0.029

    Source
        ISO 1328-1:2013, 5.3
    """
    try:
        found = ToothTolerances(grade=grade, module=module, diameter=diameter, width=width).cumulative_pitch
    except NoSolution as error:
        remedy = "" if "grade" in error.message else "give the deviation itself"
        raise NoSolution(error.message, fix=remedy) from error
    return round(found / 1000, 9)


_RANGES = {
    1995: (("module", 0.5, 70.0), ("diameter", 5.0, 10000.0), ("face width", 4.0, 1000.0)),
    2013: (("module", 0.5, 70.0), ("diameter", 5.0, 15000.0), ("face width", 4.0, 1200.0)),
}
_GRADES = {1995: (0, 12), 2013: (1, 11)}
_LIMITS = {
    "diameter": (5.0, 20.0, 50.0, 125.0, 280.0, 560.0, 1000.0, 1600.0, 2500.0, 4000.0, 6000.0, 8000.0, 10000.0),
    "module": (0.5, 2.0, 3.5, 6.0, 10.0, 16.0, 25.0, 40.0, 70.0),
    "width": (4.0, 10.0, 20.0, 40.0, 80.0, 160.0, 250.0, 400.0, 650.0, 1000.0),
}
"""Limits of the ranges of the edition of 1995 [mm]; a limit belongs to the lower range."""


@dataclass(frozen=True, kw_only=True)
class ToothTolerances:
    """The tolerances of a gear [um].

    Parameters
        grade : int - 0 to 12 of 1995, 1 to 11 of 2013
        module, diameter, width : float [mm] - normal module, reference diameter, face width
        edition : int - 1995, which takes the geometric mean of the range that holds a size, or 2013
    Raises
        NoSolution - outside of the standard's range: nothing is extrapolated
    Example
        >>> gear = ToothTolerances(grade=6, module=14.0, diameter=341.183, width=360.0, edition=1995)
        >>> gear.single_pitch, gear.profile_form, gear.helix_slope
        (14.0, 18.0, 18.0)

    Source
        ISO 1328-1:1995: 64 numbers of three KISSsoft reports; ISO 1328-1:2013, formulas 5 to 12, as three public
        programs write them
    """

    grade: int
    module: float
    diameter: float
    width: float
    edition: int = EDITION

    def __post_init__(self) -> None:
        least, greatest = _GRADES[self.edition]
        if not least <= self.grade <= greatest:
            text = f"grade {self.grade} of ISO 1328-1:{self.edition} does not exist: it has {least} to {greatest}"
            raise NoSolution(text)
        for (name, low, high), size in zip(_RANGES[self.edition], self._sizes, strict=True):
            if not low <= size <= high:
                raise NoSolution(
                    f"{name}: {unlike(size, low if size < low else high)} mm (ISO 1328-1:{self.edition}: {low:g} to "
                    f"{high:g} mm)",
                    fix="give the deviation itself",
                )

    @property
    def _sizes(self) -> tuple[float, float, float]:
        return self.module, self.diameter, self.width

    @cached_property
    def _means(self) -> tuple[float, float, float]:
        """m, d and b, of 1995 the geometric mean of the range that holds each."""
        if self.edition == EDITION:
            return self._sizes
        m, d, b = (_mean(name, size) for name, size in zip(("module", "diameter", "width"), self._sizes, strict=True))
        return m, d, b

    def _graded(self, um: float) -> float:
        return _rounded(um * math.sqrt(2) ** (self.grade - 5))

    @cached_property
    def single_pitch(self) -> float:
        """f_pt."""
        m, d, _ = self._means
        if self.edition == EDITION:
            return self._graded(0.001 * d + 0.4 * m + 5)
        return self._graded(0.3 * (m + 0.4 * math.sqrt(d)) + 4)

    @cached_property
    def _pitch(self) -> float:
        """F_p at grade 5, not rounded."""
        m, d, _ = self._means
        if self.edition == EDITION:
            return 0.002 * d + 0.55 * math.sqrt(d) + 0.7 * m + 12
        return 0.3 * m + 1.25 * math.sqrt(d) + 7

    @cached_property
    def cumulative_pitch(self) -> float:
        """F_p."""
        return self._graded(self._pitch)

    @cached_property
    def runout(self) -> float:
        """F_r = 0.8 F_p of the edition of 1995; of 2013 0.9 F_p."""
        return self._graded((0.9 if self.edition == EDITION else 0.8) * self._pitch)

    @cached_property
    def _profile(self) -> tuple[float, float]:
        """Slope and form at grade 5, not rounded."""
        m, d, _ = self._means
        if self.edition == EDITION:
            return 0.4 * m + 0.001 * d + 4, 0.55 * m + 5
        return 2 * math.sqrt(m) + 0.14 * math.sqrt(d) + 0.5, 2.5 * math.sqrt(m) + 0.17 * math.sqrt(d) + 0.5

    @cached_property
    def _helix(self) -> tuple[float, float]:
        """Slope and form at grade 5, not rounded; of 1995 they are the same."""
        _, d, b = self._means
        form = 0.07 * math.sqrt(d) + 0.45 * math.sqrt(b) + (4 if self.edition == EDITION else 3)
        return (0.05 * math.sqrt(d) + 0.35 * math.sqrt(b) + 4 if self.edition == EDITION else form), form

    @cached_property
    def profile_slope(self) -> float:
        """f_H,alpha."""
        return self._graded(self._profile[0])

    @cached_property
    def profile_form(self) -> float:
        """f_f,alpha."""
        return self._graded(self._profile[1])

    @cached_property
    def profile_total(self) -> float:
        """F_alpha, of 2013 from the parts that are not rounded yet."""
        if self.edition == EDITION:
            return self._graded(math.hypot(*self._profile))
        m, d, _ = self._means
        return self._graded(3.2 * math.sqrt(m) + 0.22 * math.sqrt(d) + 0.7)

    @cached_property
    def helix_slope(self) -> float:
        """f_H,beta."""
        return self._graded(self._helix[0])

    @cached_property
    def helix_form(self) -> float:
        """f_f,beta."""
        return self._graded(self._helix[1])

    @cached_property
    def helix_total(self) -> float:
        """F_beta, of 2013 from the parts that are not rounded yet."""
        if self.edition == EDITION:
            return self._graded(math.hypot(*self._helix))
        _, d, b = self._means
        return self._graded(0.1 * math.sqrt(d) + 0.63 * math.sqrt(b) + 4.2)

    def base_pitch(self, transverse_pressure_angle: float) -> float:
        """f_pb = f_pt cos(alpha_t), to 0.1 um.

        Parameters
            transverse_pressure_angle : float [rad] - alpha_t
        """
        return math.floor(self.single_pitch * math.cos(transverse_pressure_angle) * 10 + 0.5) / 10


def _mean(name: str, size: float) -> float:
    """Geometric mean of the range of the edition of 1995 that holds a size [mm]."""
    limits = _LIMITS[name]
    above = max(1, row_of(limits, size))
    return math.sqrt(limits[above - 1] * limits[above])


def _rounded(um: float) -> float:
    """To whole um above 10, to 0.5 above 5, else to 0.1; halves up, also those that rounding has made less."""
    step = 1.0 if um > 10 else 0.5 if um >= 5 else 0.1
    return round(math.floor(um / step + 0.5 + 1e-9) * step, 9)
