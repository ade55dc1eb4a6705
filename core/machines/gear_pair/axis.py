"""Gear pairs over arrays of designs: spur and helical ones that the tool of their profile cuts, rings among them.

What asks for more (racks, tools, cutters, allowances, loads, shares of the shift by a criterion) is left to the class.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.design_axis import Evaluated, Findings, kept_inside
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Rule
from gearlink.core.base.spec_paths import number_at
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.gears.checks import GEAR_QUANTITIES, measured, most_sliding
from gearlink.core.parts.gears.codes import (
    AT_LIMITS,
    BACKLASH,
    BENDING,
    CONTACT_RATIO,
    FILLET,
    INSPECTION,
    INTERFERENCE,
    OF_RATING,
    PITTING,
    ROOT_CLEARANCE,
    SLIDING,
    TIP_FOULING,
    TIP_THICKNESS,
    TOOTH_FORM,
    UNDERCUT,
)
from gearlink.core.parts.gears.data import MAGNITUDES
from gearlink.core.parts.gears.drawing_checks import FilletMeasure, fillet_measured, width_of_span
from gearlink.core.parts.gears.drawing_names import PLACES
from gearlink.core.parts.gears.from_spec import both
from gearlink.core.parts.gears.mesh.pair_sweep import (
    GearPairs,
    InternalInterferences,
    PathsOfContact,
    RingPairs,
    TipCorners,
)

_DOMAIN = {
    "module": (1e-6, 1e6, 1.0),
    "teeth[0]": (3.0, 1e4, 30.0),
    "teeth[1]": (3.0, 1e4, 30.0),
    "center_distance": (1e-9, 1e12, 1.0),
    "profile_shift[0]": (-5.0, 5.0, 0.0),
    "profile_shift[1]": (-5.0, 5.0, 0.0),
    "shift_split": (-5.0, 5.0, 0.0),
    "pressure_angle": (1.0, 45.0, 20.0),
    "helix_angle": (0.0, 45.0, 0.0),
    "addendum": (1e-3, 3.0, 1.0),
    "clearance": (0.0, 1.0, 0.25),
}
"""Keys that may vary: minimum and maximum value computed here, and one that stands in for others."""

_ABSENT = (
    *("tip_diameter", "tool", "cutter", "span_teeth", "allowances", "center_distance_allowance", "load"),
    *("helix_hand", "pin_diameter", "cutter"),
)
_TEETH = ("teeth[0]", "teeth[1]")
_DOMAIN_OF_RINGS = {**_DOMAIN, "teeth[1]": (-1e4, -3.0, -60.0)}
_OF_RING = ("involute_margin", "tip_fouling_margin", "radial_assembly_margin")
_OF_DRAWING = (
    *("transverse_pressure_angle", "base_helix_angle", "min_teeth_no_undercut", "form_radius", "tip_clearance"),
    *("path_of_contact", "used_root_radius", "usable_contact_ratio", "specific_sliding_tip", "sliding_factor"),
)
_OF_WIDTH = ("overlap_ratio", "total_contact_ratio")
_OF_TIPS = {
    *("contact_ratio", "tip_pressure_angle", "tip_thickness", "specific_sliding", "total_contact_ratio"),
    *("usable_contact_ratio", "path_of_contact", "used_root_radius", "specific_sliding_tip", "sliding_factor"),
    *_OF_RING,
}
"""Quantities that a pair does not have where a tip circle lies inside its base circle; `_TIP_RULES` likewise."""
_TIP_RULES = (TIP_THICKNESS, CONTACT_RATIO, INTERFERENCE, FILLET, SLIDING, PITTING, TOOTH_FORM)
_TIP_RULES_OF_RING = (*_TIP_RULES, TIP_FOULING)
_OF_EACH = (UNDERCUT, TIP_THICKNESS, INTERFERENCE, ROOT_CLEARANCE, TOOTH_FORM)
_LENGTHS = (INTERFERENCE, TOOTH_FORM)
_WITHOUT = (BACKLASH, PITTING, BENDING, *OF_RATING)
"""They find nothing where there are no allowances and no load, nor do those of AT_LIMITS."""
_CODES = {
    **{
        rule.name: rule.code for rule in (*_OF_EACH, CONTACT_RATIO, TIP_FOULING, FILLET, SLIDING, INSPECTION, *_WITHOUT)
    },
    "radial-assembly": TIP_FOULING.code,
    **dict.fromkeys(AT_LIMITS, ""),
}
"""The checks that are judged as the class judges them, with the codes that findings have here."""
_NEAR = 1e-9


def axis(
    spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str], checks: Sequence[str]
) -> GearPairAxis | None:
    """The array form of a study of gear pairs; None where the design class has to serve.

    Parameters
        spec, command, paths, quantities, checks : as of `core.base.design_axis.Maker`
    """
    if command not in ("gear", "analyze") or not set(checks) <= _CODES.keys() or not _served(spec, paths):
        return None
    names = {*GEAR_QUANTITIES, *_OF_DRAWING, *(() if spec.face_width is None else _OF_WIDTH)}
    names |= set(_OF_RING) if _internal(spec) else set()
    if not {name.partition("[")[0] for name in quantities} <= names:
        return None
    made = GearPairAxis(spec, tuple(quantities), frozenset(_CODES[name] for name in checks))
    one = made.evaluate({path: np.array([number_at(spec, path)], dtype=float) for path in _TEETH})
    return made if all(values.ndim == 1 for values in one.quantities.values()) else None


def _served(spec: Any, paths: Sequence[str]) -> bool:
    """Whether the array form knows all keys that are varied, and the base asks for no more."""
    if not set(paths) <= _DOMAIN.keys() or any(getattr(spec, name) is not None for name in _ABSENT):
        return False
    whole = "none" if _internal(spec) else "full"
    if any(not isinstance(z, int) for z in spec.teeth) or spec.tip_shortening not in (None, whole):
        return False
    if spec.profile_shift is not None:
        return spec.center_distance is None and "center_distance" not in paths
    return "shift_split" in paths or spec.shift_split == "equal" or not isinstance(spec.shift_split, str)


def _internal(spec: Any) -> bool:
    """Whether gear 2 of the base is a ring."""
    return isinstance(spec.teeth[1], int) and spec.teeth[1] < 0


@dataclass(frozen=True)
class GearPairAxis:
    """The array form; made by `axis`."""

    spec: Any
    wanted: tuple[str, ...]
    codes: frozenset[str]

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """As `core.base.design_axis.Axis`."""
        domain, made = (_DOMAIN_OF_RINGS, _Rings) if _internal(self.spec) else (_DOMAIN, _Batch)
        inside, outside = kept_inside(columns, domain)
        if made is _Rings:
            outside |= self._with_large_rings(inside)
        with np.errstate(all="ignore"):
            return made(self, inside, outside).evaluated()

    def _with_large_rings(self, columns: dict[str, Reals]) -> Mask:
        """Put larger rings instead of those that the model refuses, which are reported."""
        first, ring = (np.asarray(columns.get(path, self.spec.teeth[i])) for i, path in enumerate(_TEETH))
        small: Mask = -ring <= first
        columns["teeth[1]"] = np.broadcast_to(np.where(small, -first - 9.0, ring), len(next(iter(columns.values()))))
        return small


class _Batch:
    """Some pairs."""

    def __init__(self, axis: GearPairAxis, columns: Mapping[str, Reals], outside: Mask) -> None:
        self.spec, self.wanted, self.codes = axis.spec, axis.wanted, axis.codes
        self.columns, self.outside = columns, outside
        self.near = np.zeros(outside.shape, dtype=bool)

    def key(self, path: str) -> Any:
        """A key's values, or the base's value."""
        return self.columns[path] if path in self.columns else number_at(self.spec, path)

    made: type[GearPairs] = GearPairs
    tip_rules: tuple[Rule, ...] = _TIP_RULES

    @cached_property
    def pairs(self) -> GearPairs:
        """The pairs."""
        by_shift = self.spec.profile_shift is not None
        return self.made(
            module=self.key("module"),
            teeth=(self.key("teeth[0]"), self.key("teeth[1]")),
            pressure_angle=np.radians(self.key("pressure_angle")),
            helix_angle=np.radians(self.key("helix_angle")),
            addendum=self.key("addendum"),
            clearance=self.key("clearance"),
            given_shift=(self.key("profile_shift[0]"), self.key("profile_shift[1]")) if by_shift else None,
            given_distance=None if by_shift else self.key("center_distance"),
            given_first_shift=None if by_shift else self.key("shift_split"),
        )

    @cached_property
    def paths(self) -> PathsOfContact:
        """Their paths of contact, with the lesser width."""
        widths = both(self.spec.face_width)
        return PathsOfContact(self.pairs, None if widths is None else min(widths))

    def evaluated(self) -> Evaluated:
        """All that a study asks for."""
        asks_tips = any(name.partition("[")[0] in _OF_TIPS for name in self.wanted)
        asks_tips |= any(rule.code in self.codes for rule in self.tip_rules)
        exist, doubtful = self._spread(self.pairs.exist), self._spread(self.pairs.barely_exist)
        refused = np.where(exist, 0, 1)
        if asks_tips:
            refused = np.where(exist, self._spread(self._refused_for_tips()), refused)
            exist = refused == 0
            doubtful = doubtful | self._spread(self.pairs.barely_have_flanks)
        findings = [each for each in self._findings() if each.code in self.codes]
        quantities = {name: np.where(exist, self._spread(self.quantity(name)), np.nan) for name in self.wanted}
        if any(name.startswith("span_") for name in self.wanted):
            doubtful = doubtful | self._spread(self.pairs.span_is_doubtful)
        if FILLET.code in self.codes or any(name.startswith("form_radius") for name in self.wanted):
            doubtful = doubtful | (exist & self._spread(self.pairs.form_is_doubtful))
        if "usable_contact_ratio" in self.wanted:
            doubtful = doubtful | (exist & self._spread(self.pairs.flank_ends_on_base | self.pairs.form_is_doubtful))
        for each in findings:
            each.fails[~exist] = each.warns[~exist] = False
        reason = "center_distance" if self.spec.profile_shift is None else "profile_shift"
        unsure = self.outside | doubtful | (self.near & exist)
        return Evaluated(quantities, findings, refused, (reason, "teeth[1]"), unsure)

    def _refused_for_tips(self) -> Any:
        """The place of the reason that a tip circle inside its base circle is refused for; 0: none is."""
        return np.where(self.pairs.have_flanks, 0, 1)

    def _spread(self, value: Any) -> Any:
        return np.broadcast_to(value, self.outside.shape)

    def quantity(self, name: str) -> Any:
        """A quantity, or one of a list, in the units of design files."""
        plain, _, index = name.partition("[")
        place = PLACES.get(plain, f"pair.{plain}")
        part, _, name = place.rpartition(".")
        value: Any = getattr(getattr(self, {"pair": "pairs", "path": "paths"}.get(part, part)), name)
        if isinstance(value, tuple):
            value = value[int(index[0])] if index in ("0]", "1]") else np.nan
        elif index:
            value = np.nan
        return np.degrees(value) if term(plain).unit == "deg" else value

    # Checks

    def _findings(self) -> Iterator[Findings]:
        for rule in _OF_EACH:
            if rule.code in self.codes:
                unit = "mm" if rule in _LENGTHS else "1"
                for gear in self._gears_of(rule):
                    found = measured(rule.name, self.pairs, gear, self.spec.limits)
                    yield self._below(
                        rule.code, *found, unit, rule is not ROOT_CLEARANCE or not self.pairs.keeps_clearance
                    )
        if CONTACT_RATIO.code in self.codes:
            yield self._contact()
        if SLIDING.code in self.codes:
            yield from (self._sliding(gear) for gear in (0, 1))
        if FILLET.code in self.codes:
            yield from (self._fillet(gear) for gear in (0, 1))
        if INSPECTION.code in self.codes and self.spec.face_width is not None:
            yield from (self._span(gear, width) for gear, width in enumerate(both(self.spec.face_width)))

    def _gears_of(self, _rule: Rule) -> tuple[int, ...]:
        return 0, 1

    def _below(self, code: str, value: Any, fails: Any, warns: Any, unit: str, computed: bool = True) -> Findings:
        value, limit = self._spread(value), self._spread(fails)
        if computed:  # else the file's own number, which is the class's to the bit
            self.near |= _close(value, fails) | _close(value, warns)
        failing = value < fails
        return Findings(code, value, limit, failing, ~failing & (value < warns), unit)

    def _contact(self) -> Findings:
        """GL203: of helical pairs with a width the total contact ratio counts."""
        limits = measured(CONTACT_RATIO.name, self.pairs, 0, self.spec.limits)
        plain, total = self._spread(limits.value), self._spread(self.paths.total_contact_ratio)
        helical = self._spread(self.pairs.helix_angle != 0.0) & np.isfinite(total)
        found = self._below(CONTACT_RATIO.code, np.where(helical, total, plain), *limits[1:], "1")
        alone = helical & ~found.fails & ~found.warns & (plain < 1.0)
        self.near |= helical & _close(plain, 1.0)
        value, limit = np.where(alone, plain, found.value), np.where(alone, 1.0, found.limit)
        return Findings(found.code, value, limit, found.fails, found.warns | alone, "1")

    def _sliding(self, gear: int) -> Findings:
        limit = self._spread(most_sliding(self.spec.limits))
        size = np.abs(self._spread(self.pairs.specific_sliding[gear]))
        self.near |= _close(size, limit)
        return Findings(SLIDING.code, size, limit, np.zeros(size.shape, dtype=bool), size > limit, "1")

    def _fillet(self, gear: int) -> Findings:
        """GL207: contact below the end of the flank."""
        found = FilletMeasure(*map(self._spread, fillet_measured(self.pairs, self.paths, gear)))
        left = self._spread(self.pairs.interference_margin[1 - gear])
        known = ~np.isnan(self._spread(self.pairs.form_radius[gear]))
        self.near |= known & (_close(found.margin, found.limit) | _close(left, 0.0))
        self.near |= TipCorners(self.pairs, gear).may_cut(known & ~found.bad)
        fails, warns = found.bad & found.judged, found.bad & ~found.judged
        return Findings(FILLET.code, found.margin, found.limit, fails, warns, "mm")

    def _span(self, gear: int, width: float) -> Findings:
        """GL213: a span measurement that leaves the face of a helical gear."""
        needed = self._spread(width_of_span(self.pairs, gear, self.pairs.span_teeth[gear]))
        helical = self._spread(self.pairs.helix_angle != 0.0)
        self.near |= helical & (self._spread(self.pairs.span_is_doubtful) | _close(needed, width))
        warns = helical & (needed > width)
        return Findings(
            INSPECTION.code, np.full(needed.shape, width), needed, np.zeros(needed.shape, bool), warns, "mm"
        )


class _Rings(_Batch):
    """Some pinions in rings."""

    made = RingPairs
    tip_rules = _TIP_RULES_OF_RING

    @cached_property
    def internal(self) -> InternalInterferences:
        """Their interferences."""
        return InternalInterferences(self.pairs)

    def quantity(self, name: str) -> Any:
        """As `data.shown`: those with the signs of a ring as magnitudes, none that has no bound."""
        value = super().quantity(name)
        plain, _, index = name.partition("[")
        value = np.abs(value) if plain in MAGNITUDES and index != "0]" else value
        return np.where(np.isfinite(value), value, np.nan)

    def _refused_for_tips(self) -> Any:
        pinion, ring = (rise == rise for rise in self.pairs.tip_pressure_angle)
        return np.where(pinion, np.where(ring, 0, 2), 1)

    def _gears_of(self, rule: Rule) -> tuple[int, ...]:
        return (0,) if rule is UNDERCUT else (0, 1)

    def _findings(self) -> Iterator[Findings]:
        yield from super()._findings()
        if TIP_FOULING.code in self.codes:
            self.near |= self._spread(self.internal.is_doubtful)
            apart = self.internal.tip_circles_apart
            yield self._fouling(np.where(apart < 0.0, apart, self._margin("tip_fouling")), "fail")
            radial = self.spec.assembly == "radial"
            yield self._fouling(self._margin("radial_assembly"), "fail" if radial else "warn")

    def _margin(self, of: str) -> Any:
        return getattr(self.internal, f"{of}_margin")

    def _fouling(self, margin: Any, status: str) -> Findings:
        """GL206 of the tips in mesh, or of the assembly along the line of centres."""
        margin = self._spread(margin)
        bad, nothing = margin < 0.0, np.zeros(margin.shape, dtype=bool)
        shown = np.where(np.isfinite(margin), margin, np.nan)
        self.near |= _close(shown, 0.0)
        fails, warns = (bad, nothing) if status == "fail" else (nothing, bad)
        return Findings(TIP_FOULING.code, shown, np.zeros(margin.shape), fails, warns, "mm")


def _close(value: Any, limit: Any) -> Mask:
    return np.asarray(np.abs(value - limit) <= _NEAR * np.maximum(1.0, np.maximum(np.abs(value), np.abs(limit))))
