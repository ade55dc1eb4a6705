"""From the entries of `tolerance.sources` to laws: how far each size of a design may lie from its nominal value."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution, named
from gearlink.core.base.spec_paths import number_at, numbers_at, unit_at
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.ranges import row_of
from gearlink.core.parts.gears.measures.iso_1328 import cumulative_pitch
from gearlink.core.studies.study.faults import Fault, Place, WrongStudy
from gearlink.core.studies.tolerance.iso_286 import fit_clearances, limit_deviations
from gearlink.core.studies.tolerance.laws import Law, normal_between
from gearlink.core.studies.tolerance.spec import Tolerance, ToleranceSource

GROUPS = ("C2", "CN", "C3", "C4", "C5")
_BORES = (10, 18, 24, 30, 40, 50, 65, 80, 100)
# Minimum and maximum clearance in um, a row for each range of bores, a pair for each group.
_ROWS = (
    ((0, 7), (2, 13), (8, 23), (14, 29), (20, 37)),
    ((0, 9), (3, 18), (11, 25), (18, 33), (25, 45)),
    ((0, 10), (5, 20), (13, 28), (20, 36), (28, 48)),
    ((1, 11), (5, 20), (13, 28), (23, 41), (30, 53)),
    ((1, 11), (6, 20), (15, 33), (28, 46), (40, 64)),
    ((1, 11), (6, 23), (18, 36), (30, 51), (45, 73)),
    ((1, 15), (8, 28), (23, 43), (38, 61), (55, 90)),
    ((1, 15), (10, 30), (25, 51), (46, 71), (65, 105)),
    ((1, 18), (12, 36), (30, 58), (53, 84), (75, 120)),
)


def radial_clearance(bore: float, group: str) -> tuple[float, float]:
    """Minimum and maximum radial clearance of an unmounted bearing; fits and heat take some of it away.

    Parameters
        bore : float [mm] - above 0, up to 100
        group : str - C2, CN, C3, C4 or C5
    Returns
        minimum, maximum : float [mm]
    Raises
        NoSolution - no such group, or a bore outside of the table
    Example
        >>> radial_clearance(65, "C3")
        (0.023, 0.043)

    Source
        ISO 5753-1, table of deep-groove ball bearings with cylindrical bore
    """
    if group not in GROUPS:
        raise NoSolution(f"no clearance group {named(group)}: ISO 5753-1 has {', '.join(GROUPS)}")
    if not 0 < bore <= _BORES[-1]:
        raise NoSolution(
            f"the table of bearing clearances reaches to a bore of {_BORES[-1]} mm, not {bore:g} mm",
            fix="give clearance: [minimum, maximum]",
        )
    least, greatest = _ROWS[row_of(_BORES, bore)][GROUPS.index(group)]
    return least / 1000, greatest / 1000


MOST_COORDINATES = 64
_EVEN = 1.0 + 1e-9
"""Sigma is a sixth of the limits' distance only to rounding."""
CAM_PROFILE, ROLLER_ARM, RETURN_ARM = "cam.profile", "links.roller_arm", "links.return_roller_arm"


@dataclass(frozen=True, slots=True)
class GearOfSource:
    """What the tolerance of a gear's teeth depends on: module and reference diameter [mm], pressure angle [rad]."""

    module: float
    diameter: float
    pressure_angle: float


@dataclass(frozen=True, slots=True)
class Scatter:
    """One source of a design.

    Fields
        key : str - as the file names it
        kind : str - "size" of the file, "center", "pin" (a vector), "gear" (an eccentricity)
        nominal : float - of a size or centre distance, in the unit of the file
        law : Law - of the deviation; of a pin's diametral clearance; of a gear's eccentricity
        unit : str - of the deviation: "deg" of an angle
    """

    key: str
    kind: str
    nominal: float
    law: Law
    entry: ToleranceSource
    unit: str = "mm"

    @property
    def coordinates(self) -> int:
        """Random numbers that a sample of it takes: a vector has two."""
        return 2 if self.kind in ("pin", "gear") else 1

    @property
    def limit(self) -> float:
        """Maximum distance from nominal: of a pin half the clearance, of a gear the eccentricity."""
        if self.kind == "pin":
            return 0.5 * self.law.upper
        return max(abs(self.law.lower), abs(self.law.upper))

    @property
    def keeps_limit(self) -> bool:
        """Whether its parts lie within `limit`; of a normal law three sigma of them."""
        most = max(abs(self.law.lower), abs(self.law.upper)) * _EVEN
        return self.law.form != "normal" or abs(self.law.mean) + 3.0 * self.law.sigma <= most

    @property
    def sigma(self) -> float:
        """Standard deviation of the deviation; of a pin and a gear that of one component of the vector."""
        mean, sigma = self.law.moments()
        if self.kind not in ("pin", "gear"):
            return sigma
        if self.entry.play == "floating":
            return 0.25 * mean
        half = 0.5 if self.kind == "pin" else 1.0
        return half * math.sqrt(0.5 * (mean * mean + sigma * sigma))

    def deviations(self, points: Reals) -> Reals | Points:
        """Deviations of samples; of a pin and a gear vectors x + i y, those of a pin that touches its hole or floats.

        Parameters
            points : (N, coordinates) array - random numbers in (0, 1)
        Returns
            deviations : (N,) array
        """
        if self.coordinates == 1:
            return self.law.deviations(points[:, 0])
        if self.entry.play == "floating":
            size = 0.5 * self.law.moments()[0] * np.sqrt(points[:, 0])
        else:
            half = 0.5 if self.kind == "pin" else 1.0
            size = half * np.maximum(self.law.deviations(points[:, 0]), 0.0)
        return np.asarray(size * np.exp(2j * math.pi * points[:, 1]))

    def within(self, half: float) -> Scatter:
        """The same size made to limits at one distance to either side, by the same process: law, C_p and C_pk."""
        widths = (self.law.upper - self.law.lower, 2.0 * half)
        given = dict.fromkeys(("lower", "upper", "limits", "sigma", "class_", "measured")) | {"plus_minus": half}
        if self.entry.mode is not None:
            given["mode"] = (self.entry.mode - 0.5 * (self.law.lower + self.law.upper)) * widths[1] / widths[0]
        entry = self.entry.model_copy(update=given)
        return replace(self, entry=entry, law=_law(entry, -half, half, ("tolerance", "sources", self.key)))


def numbers_of(sources: Sequence[Scatter]) -> list[slice]:
    """Which random numbers of a sample each source takes."""
    starts = itertools.accumulate((one.coordinates for one in sources), initial=0)
    return [slice(start, end) for start, end in itertools.pairwise(starts)]


def deviations_of(sources: Sequence[Scatter], points: Reals) -> dict[str, Reals | Points]:
    """Deviations of samples by source, as `Scatter.deviations` has them; (N, coordinates of all) random numbers."""
    rows = zip(sources, numbers_of(sources), strict=True)
    return {one.key: one.deviations(points[:, columns]) for one, columns in rows}


@dataclass(frozen=True, slots=True)
class Parts:
    """What a design has that no key of its file names, each with its nominal value."""

    centers: dict[str, float]
    pins: tuple[str, ...] = ()
    gears: dict[str, GearOfSource] | None = None
    others: dict[str, float] = field(default_factory=dict)


def scatters(section: Tolerance, spec: Any, parts: Parts) -> tuple[Scatter, ...]:
    """The sources of a design, in the order of the file.

    Parameters
        spec : the design's spec
        parts : Parts - of its kind
    Raises
        WrongStudy - GL170 to GL175, each at its source
    """
    found: list[Scatter] = []
    faults: list[Fault] = []
    for key, entry in section.sources.items():
        try:
            found.append(_scatter(key, entry, spec, parts))
        except WrongStudy as error:
            faults.extend(error.faults)
    if faults:
        raise WrongStudy(faults)
    if not found:
        raise _no(
            "GL170",
            "no toleranced dimension\nadd at least one entry, such as crank: {plus_minus: 0.05}",
            ("tolerance", "sources"),
        )
    if sum(one.coordinates for one in found) > MOST_COORDINATES:
        raise _no(
            "GL175",
            f"more than {MOST_COORDINATES} coordinates (a pin and a gear need two)\nomit those with the smallest "
            "tolerances",
            ("tolerance", "sources"),
        )
    return tuple(found)


def is_play(key: str) -> bool:
    """Whether a source is the play of a pin."""
    return key.startswith(("pins.", "bearings."))


def is_of_parts(key: str, entry: ToleranceSource) -> bool:
    """Whether a source names a part and not a key of the file: play, runout, a centre distance, a cam's profile."""
    runout = key.startswith("gears.") and entry.form in ("grade", "eccentricity")
    profile = key == CAM_PROFILE or (key.startswith("cams.") and key.endswith(".profile"))
    return is_play(key) or runout or key.startswith("centers.") or profile or key in (ROLLER_ARM, RETURN_ARM)


def _scatter(key: str, entry: ToleranceSource, spec: Any, parts: Parts) -> Scatter:
    place = ("tolerance", "sources", key)
    group, _, name = key.partition(".")
    try:
        if is_play(key):
            return _pin(key, name, entry, parts, place)
        if group == "gears" and entry.form in ("grade", "eccentricity"):
            return _gear(key, name, entry, parts, place)
        return _size(key, group, name, entry, spec, parts, place)
    except NoSolution as error:
        raise _no({"grade": "GL174"}.get(entry.form, "GL173"), str(error), place) from error


def _pin(key: str, name: str, entry: ToleranceSource, parts: Parts, place: Place) -> Scatter:
    if name not in parts.pins:
        known = f": it has {', '.join(parts.pins)}" if parts.pins else ": play of pins is not computed for it"
        raise _no("GL170", f"this design has no pin {named(name)}{known}", place)
    if entry.fit is not None and entry.size is not None:
        least, greatest = fit_clearances(entry.size, entry.fit)
        if least < 0:
            raise _no(
                "GL171", f"the fit {entry.fit} may interfere by {-least:g} mm: a pin that turns needs clearance", place
            )
    elif entry.group is not None and entry.bore is not None:
        least, greatest = (max(0.0, c - entry.reduction) for c in radial_clearance(entry.bore, entry.group))
    elif entry.clearance is not None:
        least, greatest = entry.clearance
    else:
        raise _no(
            "GL171", f"a pin has a clearance, not {entry.form}\ngive fit and size, group and bore, or clearance", place
        )
    return Scatter(key, "pin", 0.0, _law(entry, least, greatest, place), entry)


_ASIDE = {"tolerance", "register", "loads", "limits", "kind", "name"}
_LONGEST = 100


def _gear(key: str, name: str, entry: ToleranceSource, parts: Parts, place: Place) -> Scatter:
    gears = parts.gears or {}
    if name not in gears:
        raise _no("GL170", f"this design has no gear {named(name)}: it has {', '.join(gears) or 'none'}", place)
    gear, limit = gears[name], entry.eccentricity or 0.0
    if entry.eccentricity is not None:
        return Scatter(key, "gear", 0.0, Law("fixed", 0.0, limit, mean=limit), entry)
    if entry.grade is not None and entry.width is not None:
        pitch = cumulative_pitch(entry.grade, gear.module, gear.diameter, entry.width)
        limit = 0.5 * pitch * math.cos(gear.pressure_angle)
    return Scatter(key, "gear", 0.0, Law("triangular", 0.0, limit, mode=limit), entry)


def _size(key: str, group: str, name: str, entry: ToleranceSource, spec: Any, parts: Parts, place: Place) -> Scatter:
    if group == "centers":
        if name not in parts.centers:
            known = (
                f"it has {', '.join(parts.centers)}" if parts.centers else "its centre distances are keys of the file"
            )
            raise _no("GL170", f"this design has no centre distance {named(name)}: {known}", place)
        nominal: float | None = parts.centers[name]
    elif key in parts.others:
        nominal = parts.others[key]
    else:
        nominal = number_at(spec, key)
    if nominal is None or (group != "centers" and isinstance(nominal, int)):
        what = "holds a whole number, which does not vary" if nominal is not None else "is not a key with a number"
        near = _near(key, spec) if nominal is None else ""
        remedy = f"did you mean {near}?" if near else "use a length or an angle of this file"
        raise _no("GL170", f"{named(key)} {what}\n{remedy}", place)
    unit = "mm" if group == "centers" or key in parts.others else unit_at(spec, key)
    if unit not in ("mm", "") and (entry.form == "class" or entry.grades is not None):
        what = "class" if entry.form == "class" else "grades"
        message = f"{what} needs the length of a part, but {key} is in {unit}\ngive plus_minus or limits"
        raise _no("GL173", message, (*place, what))
    lower, upper = _limits(entry, nominal, place)
    kind = "center" if group == "centers" else "size"
    return Scatter(key, kind, nominal, _law(entry, lower, upper, place), entry, unit or "mm")


def _near(key: str, spec: Any) -> str:
    """The nearest key of the file that holds a number, or ""."""
    from difflib import get_close_matches

    sections = (name for name in spec.model_fields_set if name not in _ASIDE)
    known = [path for name in sections for path in numbers_at(spec, name)]
    return next(iter(get_close_matches(key[:_LONGEST], known, n=1, cutoff=0.7)), "")


def _limits(entry: ToleranceSource, nominal: float, place: Place) -> tuple[float, float]:
    form = entry.form
    if form == "plus_minus":
        return -entry.plus_minus, entry.plus_minus  # type: ignore[operator,return-value]
    if form == "lower":
        return entry.lower, entry.upper  # type: ignore[return-value]
    if form == "limits":
        return entry.limits[0], entry.limits[1]  # type: ignore[index]
    if form == "sigma":
        return -3.0 * entry.sigma, 3.0 * entry.sigma  # type: ignore[operator]
    if form == "measured":
        off = entry.measured - nominal  # type: ignore[operator]
        return off, off
    if form == "class":
        return limit_deviations(abs(nominal), entry.class_ or "")
    raise _no(
        "GL171",
        f"{form} applies only to pins, bearings or gears\ngive plus_minus, limits, class, sigma or measured",
        place,
    )


def _law(entry: ToleranceSource, lower: float, upper: float, place: Place) -> Law:
    if entry.form == "measured":
        return Law("fixed", lower, upper, mean=lower)
    if not lower < upper:
        raise _no("GL171", f"the limits {lower:g} and {upper:g} have no width: nothing varies", place)
    normal = normal_between(lower, upper, entry.cp, entry.cpk, entry.shift != "down")
    if entry.form == "sigma":
        normal = Law("normal", lower, upper, 0.0, entry.sigma or 0.0)
    if entry.law == "triangular":
        mode = 0.5 * (lower + upper) if entry.mode is None else entry.mode
        if not lower <= mode <= upper:
            raise _no("GL171", f"mode {mode:g} lies outside the limits {lower:g} to {upper:g}", place)
        return Law("triangular", lower, upper, mode=mode)
    if entry.law == "uniform":
        return Law("uniform", lower, upper)
    return Law(entry.law, lower, upper, normal.mean, normal.sigma)


def _no(code: str, message: str, place: Place) -> WrongStudy:
    return WrongStudy([Fault(code, message, place)])
