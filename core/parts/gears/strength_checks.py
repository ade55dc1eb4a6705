"""Checks of the strength of a gear pair: safeties, what they rest on, with `rating` ranges, resonance and damage."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Check, Rule, Status
from gearlink.core.parts.gears.codes import (
    BENDING,
    DAMAGE,
    FACE_LOAD,
    PITTING,
    RATING_RANGE,
    RESONANCE,
    SCUFFING,
    TRUE_FILLET,
)
from gearlink.core.parts.gears.data import GearData

if TYPE_CHECKING:
    from gearlink.core.parts.gears.rating.rated import Rated

_UNEVEN = 1.1
"""The face load factor from which on a failing safety names it."""
_RESONANCE = (0.85, 1.15)
_MOST_UNEVEN = 2.0
_APART = 0.25


def rests_on(quantity: str, data: GearData) -> str:
    """Which inputs a stress or a safety rests on, in words; empty for other quantities."""
    if quantity in ("contact_stress", "safety_pitting"):
        return _contact_inputs(data)
    if quantity in ("root_fillet_radius", "stress_correction_factor", "form_factor"):
        return shaped_root(data)
    if quantity in ("generated_root_factor", "generated_root_stress"):
        return "boundary integral on one tooth and its rim, within 4 %"
    if quantity in ("integral_temperature", "safety_scuffing"):
        return "within 0.5 % of the reference" if data.rated is not None else ""
    return _bending_inputs(data) if quantity in ("root_stress", "safety_bending") else ""


def shaped_root(data: GearData) -> str:
    """How the fillet radius of a ring differs from the standard's, in words; empty of other roots."""
    section = data.root.sections[1] if data.pair.internal else None
    if section is None:
        return ""
    if data.pair.shaped is None:
        return "without its cutter the root of the ring is that of a rack"
    norm = replace(section, given_fillet_radius=section.standard_fillet_radius)
    own = data.pair.shaped.fillet_radius
    if own is None:
        return ""
    made = replace(section, given_fillet_radius=own)
    less = 1.0 - norm.stress_correction_factor / made.stress_correction_factor
    radius = norm.fillet_radius * data.pair.module
    if section.given_fillet_radius == norm.given_fillet_radius:
        shaped = own * data.pair.module
        return f"radius of ISO 6336-3:2007 with |z_n|; that of the shaped ring itself is {shaped:.4g} mm"
    change = f"{100.0 * abs(less):.2g} % {'lower' if less > 0.0 else 'higher'}"
    return f"radius of the shaped ring itself; ISO 6336-3:2007 with |z_n| gives {radius:.4g} mm, root stress {change}"


def _contact_inputs(data: GearData) -> str:
    k = data.factors
    return (
        f"K_A {k.application:.4g}, {_shared(k.distribution)}K_v {k.dynamic:.4g}, K_Hb {k.face_contact:.4g}, "
        f"K_Ha {k.transverse_contact:.4g} and the life factors {_origin(data)}"
    )


def _bending_inputs(data: GearData) -> str:
    k = data.factors
    edition = "" if data.edition == 2006 else f"; edition {data.edition} is not verified"
    return (
        f"K_A {k.application:.4g}, {_shared(k.distribution)}K_v {k.dynamic:.4g}, K_Fb {k.face_bending:.4g}, "
        f"K_Fa {k.transverse_bending:.4g} and the life factors {_origin(data)}{edition}"
    )


def _shared(distribution: float) -> str:
    return "" if distribution == 1.0 else f"K_gamma {distribution:.4g}, "


def _origin(data: GearData) -> str:
    if data.rated is not None:
        return "by rating: see the table factors"
    return "are not computed: 1 unless given"


def pitting(data: GearData, limits: Any) -> Iterator[Check]:
    """GL210 of both gears."""
    against = "pitting", _contact_inputs(data)
    yield from _safety(PITTING, data, data.safety_pitting, limits.safety_pitting, *against)


def bending(data: GearData, limits: Any) -> Iterator[Check]:
    """GL211 of both gears, and where a formula of the root leaves its range."""
    if data.load is not None:
        yield from _out_of_range(data)
    against = "breaking at the root", _bending_inputs(data)
    yield from _safety(BENDING, data, data.safety_bending, limits.safety_bending, *against)


def _safety(
    rule: Rule, data: GearData, found: tuple[float | None, float | None] | None, least: float, against: str, inputs: str
) -> Iterator[Check]:
    for gear, safety in enumerate(found or ()):
        if safety is None:
            continue
        both_ways = ", an idler's, bent both ways (Y_d 0.7)" if _both_ways(data, gear) and rule is BENDING else ""
        text = f"the safety of {data.called(gear)} against {against} is {safety:.4g}{both_ways}, nominal: {inputs}"
        if safety < max(least, 1.0):
            limit = f"the limit {least:g}" if safety < least else f"1, though the limit {least:g} allows it"
            text += (
                f"; below {limit}: {_help(rule, data, gear)}widen the gears, take a larger module or a better material"
            )
        status: Status = "fail" if safety < least else "warn" if safety < 1.0 else "pass"
        yield rule.check(status, text, safety, least)


def _both_ways(data: GearData, gear: int) -> bool:
    if data.rated is not None:
        return data.idlers[gear] and data.rated.conditions.mean_stress is None
    return data.idlers[gear]


def _help(rule: Rule, data: GearData, gear: int) -> str:
    """What the load across the face takes of a safety, and what crowning would give; empty where it takes little."""
    rated = data.rated
    if rated is None or "face_contact" in rated.given or rated.at_load.face_contact <= _UNEVEN:
        return ""
    given = rated.conditions
    at, contact = rated.at_load, rule is PITTING
    taken = 1.0 - (at.face_contact**-0.5 if contact else 1.0 / at.face_bending)
    symbol, value = ("K_Hb", at.face_contact) if contact else ("K_Fb", at.face_bending)
    text = f"{symbol} = {value:.3g} takes {100.0 * taken:.0f} % of it"
    if given.modification != "none" or given.misalignment is not None:
        return f"{text}; "
    crowned = replace(rated, conditions=replace(given, modification="crowning"))
    safety = (crowned.safety_pitting if contact else crowned.safety_bending)[gear]
    return f"{text}; rating.face.modification: crowning gives {safety:.3g}; "


def _out_of_range(data: GearData) -> Iterator[Check]:
    """Where the formulas of the root leave the range of their standard."""
    if data.face_width is None:
        yield BENDING.check("warn", "a load without face_width gives no stress and no safety: give face_width")
    eps = data.path.contact_ratio
    if data.pair.helix_angle == 0.0 and not 1.0 <= eps <= 2.0:
        text = f"contact ratio {eps:.4g}: method B of ISO 6336 covers 1 to 2, stresses are out of its range"
        yield BENDING.check("warn", text, eps)
    for gear, factor in enumerate(data.root.rim_factor or ()):
        if factor is None:
            least = "1.75 modules" if data.pair.teeth[gear] < 0 else "half the height of its teeth"
            text = f"the rim of {data.called(gear)} is too thin for ISO 6336-3: no root stress is given"
            yield BENDING.check("warn", f"{text}; raise rim_thickness above {least}")
    for gear, section in enumerate(data.root.sections):
        if section is None:
            text = f"{data.called(gear)} has no root section that ISO 6336-3 could judge: no root stress is given"
            yield BENDING.check("warn", f"{text}; {data.rated_with(gear)}")
        elif not 1.0 <= section.notch < 8.0:
            text = f"notch parameter q_s = {section.notch:.4g} of {data.called(gear)} is outside 1 to 8"
            yield BENDING.check("warn", f"{text}, where Y_S holds", section.notch)
        elif data.pair.teeth[gear] < 0 and data.pair.cutter is None:
            text = "without its cutter the root of the ring is judged with the rounding of a rack tool"
            yield BENDING.check("warn", text)


# With `rating`


def rating_range(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL214: what leaves its range, and what no printed number confirms."""
    if data.rated is None:
        return
    from gearlink.core.parts.gears.rating.sheet import unconfirmed

    outside, symbols = list(_outside(data.rated)), unconfirmed(data.rated)
    parts = [f"outside of its range: {'; '.join(outside)}"] if outside else []
    if symbols:
        parts.append(
            f"no printed number confirms {', '.join(symbols)} as used here (table factors): check them yourself"
        )
    text = "; ".join(parts) or "every formula of the rating is in its range and met by a printed number"
    yield RATING_RANGE.check("warn" if parts else "pass", text)


def _outside(rated: Rated) -> Iterator[str]:
    given, name = rated.conditions, rated.data.called
    for gear, steel in enumerate(rated.steels):
        low, high = steel.kind.range_of(given.quality)
        unit = "HBW" if steel.kind.brinell else "HV"
        by_table = not {"contact_limit", "bending_limit"} <= steel.given
        if steel.hardness is not None and by_table and not low <= steel.hardness <= high:
            held = f"{steel.of} {given.quality} has {low:g} to {high:g}"
            yield f"hardness {steel.hardness:g} {unit} of {name(gear)}, {held}"
        if steel.kind.notch is None and not 300.0 <= steel.yield_strength <= 1000.0:
            yield f"yield point {steel.yield_strength:g} N/mm^2 of {name(gear)} (Y_delta,relT: 300 to 1000)"
        if not given.root_roughness[gear] <= 40.0:
            yield f"Rz {given.root_roughness[gear]:g} um of the root of {name(gear)} (Y_R,relT: up to 40)"
        line, cycles = rated.root_lines[gear], rated.load_cycles[gear]
        if line is not None and cycles < line.endurance.reference:
            lasting = f"{line.endurance.reference:.0e}"
            yield f"{cycles:.3g} load cycles of the root of {name(gear)}, below the {lasting} of Y_NT 1"
        if rated.hardened[gear] and steel.brinell is not None and not 130.0 <= steel.brinell <= 470.0:
            yield f"{steel.brinell:g} HBW of {name(gear)} (Z_W: 130 to 470)"
    if given.pitting_allowed and any(line.bend is None for line in rated.flank_lines):
        yield "pitting: allowed, which is not known of this material and left out"
    if given.scuffing_stage is not None and rated.data.pair.internal:
        yield "scuffing of a ring: no integral temperature is given"
    relief = None if rated.scuffing is None else rated.scuffing.relief_share
    if relief is not None and relief >= 1.0:
        yield "tip relief beyond the deflection of the teeth (X_Ca counts the deflection)"


def resonance(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL215: the speed is near to the main resonance."""
    if data.rated is None:
        return
    at, (low, high) = data.rated.at_load, _RESONANCE
    ratio = at.resonance_ratio
    text = f"gear 1 runs at {ratio:.4g} of its resonance speed {at.resonance_speed:.6g} 1/min"
    near = low < ratio < high
    if near:
        text += f", between {low:g} and {high:g}: change load.speed or the teeth, or have the dynamics measured"
    below = ratio < 1.0
    found = RESONANCE.check("warn" if near else "pass", text, ratio, low if below else high)
    yield replace(found, side="<=" if below else ">=")


def scuffing(data: GearData, limits: Any) -> Iterator[Check]:
    """GL216: the oil film breaks down."""
    found = None if data.rated is None else data.rated.scuffing
    if found is None:
        return
    least, safety = limits.safety_scuffing, found.safety
    text = (
        f"the safety against scuffing is {safety:.4g}: integral temperature {found.integral_temperature:.4g} deg C, "
        f"the oil fails at {found.scuffing_temperature:.4g}"
    )
    if safety < least:
        text += f"; below the limit {least:g}: take an oil of a higher rating.lubricant.scuffing_stage, or a tip relief"
    yield SCUFFING.check("fail" if safety < least else "pass", text, safety, least)


def damage(data: GearData, limits: Any) -> Iterator[Check]:
    """GL217: the required life uses up more than all of a gear, or one load is above the static limit."""
    rated = data.rated
    if rated is None:
        return
    rows = (
        ("flank", rated.damage_pitting, rated.pitting_life, rated.static_safety[0], limits.safety_pitting),
        ("root", rated.damage_bending, rated.bending_life, rated.static_safety[1], limits.safety_bending),
    )
    for what, found, lives, static, safety in rows:
        for gear, used in enumerate(found):
            if used is None:
                continue
            bad, still = used > 1.0, static[gear]
            life = "" if lives[gear] is None else f", a life of {lives[gear]:.4g} h"
            text = f"the {what} of {data.called(gear)} has the damage {used:.4g} at the safety {safety:g}{life}"
            if bad:
                text += f", of {rated.conditions.life:g} h required: widen the gears, or take a better material"
            if still is not None and still < safety:
                bad, text = True, f"{text}; the greatest load exceeds its static limit, safety {still:.4g}"
            yield DAMAGE.check("fail" if bad else "pass", text, used, 1.0)


def face_load(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL218: the load is carried by one end of the face."""
    if data.rated is None:
        return
    factor = data.rated.at_load.face_contact
    text = f"the face load factor K_Hb is {factor:.4g}"
    if factor > _MOST_UNEVEN:
        text += ": narrow the gears, take a better rating.grade, or rating.face.modification: crowning"
    yield FACE_LOAD.check("warn" if factor > _MOST_UNEVEN else "pass", text, factor, _MOST_UNEVEN)


def true_fillet(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL219: the boundary integral and the standard disagree on the root; asked for by the table root alone."""
    if data.rated is None:
        return
    for gear, factor in enumerate(data.generated_root_factor or ()):
        section = data.root.sections[gear]
        if factor is None or section is None:
            continue
        standard = section.form_factor * section.stress_correction_factor
        apart = factor / standard - 1.0
        text = (
            f"the root stress of {data.called(gear)} on its generated fillet is {factor:.4g} F_t/(b m), the standard's "
            f"{standard:.4g}: {100.0 * abs(apart):.2g} % {'more' if apart > 0.0 else 'less'}"
        )
        bad = abs(apart) > _APART
        if bad:
            text += "; have this root checked by other means, or take a tool with a larger rounding"
        yield TRUE_FILLET.check("warn" if bad else "pass", text, abs(apart), _APART)
