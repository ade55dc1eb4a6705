"""Checks of the strength of a gear pair: safeties, what they rest on, with `rating` ranges, resonance and damage."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import NO_NUMBER, Check, Rule, Shown, Side, Status
from gearlink.core.base.wording import amount, short
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
        return _inputs(data, "H")
    if quantity in ("root_fillet_radius", "stress_correction_factor", "form_factor"):
        return shaped_root(data)
    if quantity in ("generated_root_factor", "generated_root_stress"):
        return "boundary integral on one tooth and its rim, within 4 %"
    return _inputs(data, "F") if quantity in ("root_stress", "safety_bending") else ""


def shaped_root(data: GearData) -> str:
    """How the fillet radius of a ring differs from the standard's, in words; empty of other roots."""
    section = data.root.sections[1] if data.pair.internal else None
    if section is None:
        return ""
    if data.cut_ring is None:
        return "without its cutter the root of the ring is that of a rack"
    norm = replace(section, given_fillet_radius=section.standard_fillet_radius)
    own = data.cut_ring.fillet_radius
    if own is None:
        return ""
    made = replace(section, given_fillet_radius=own)
    less = 1.0 - norm.stress_correction_factor / made.stress_correction_factor
    radius = norm.fillet_radius * data.pair.module
    if section.given_fillet_radius == norm.given_fillet_radius:
        shaped = own * data.pair.module
        return f"radius of ISO 6336-3:2007 with |z_n|; that of the shaped ring itself is {shaped:.4g} mm"
    change = f"{100.0 * abs(less):.2g} % {'lower' if less > 0.0 else 'higher'}"
    return (
        f"root fillet radius of the shaped ring; ISO 6336-3:2007 with |z_n| gives {radius:.4g} mm, root stress {change}"
    )


def _inputs(data: GearData, of: str) -> str:
    """The K factors of the flanks, H, or the roots, F, and where they are from."""
    k = data.factors
    face, transverse = (k.face_contact, k.transverse_contact) if of == "H" else (k.face_bending, k.transverse_bending)
    shared = "" if k.distribution == 1.0 else f"K_gamma {k.distribution:.4g}, "
    origin = "K and life factors are those of the file, else 1"
    if data.rated is not None:
        origin = "K and life factors by rating (table factors)"
    if of == "F" and data.edition != 2006:
        origin += f"; edition {data.edition} is not verified"
    every = f"K_A {k.application:.4g}, {shared}K_v {k.dynamic:.4g}, K_{of}b {face:.4g}, K_{of}a {transverse:.4g}"
    return f"{every}; {origin}"


def pitting(data: GearData, limits: Any) -> Iterator[Check]:
    """GL210 of both gears."""
    called, note = "pitting safety S_H", _inputs(data, "H")
    yield from _safety(PITTING, data, data.safety_pitting, limits.safety_pitting, called, note)


def bending(data: GearData, limits: Any) -> Iterator[Check]:
    """GL211 of both gears, and where a formula of the root leaves its range."""
    if data.load is not None:
        yield from _out_of_range(data)
    ring = shaped_root(data)
    called, note = "tooth root safety S_F", _inputs(data, "F") + (f"; {ring}" if ring else "")
    yield from _safety(BENDING, data, data.safety_bending, limits.safety_bending, called, note)


def _safety(
    rule: Rule, data: GearData, found: tuple[float | None, float | None] | None, least: float, called: str, note: str
) -> Iterator[Check]:
    for gear, safety in enumerate(found or ()):
        if safety is None:
            continue
        aside = "idler bent both ways, Y_d 0.7" if _both_ways(data, gear) and rule is BENDING else ""
        status: Status = "fail" if safety < least else "warn" if safety < 1.0 else "pass"
        what, fix = f"{data.called(gear)}: {called}", "use a larger face width, a larger module or a better material"
        said = note
        if status != "pass" and (shared := _uneven(rule, data, gear, safety, max(least, 1.0))):
            said, fix = f"{note}; {shared[0]}", shared[1] or fix
        yield rule.check(status, what, safety, least, recommended=1.0, aside=aside, fix=fix, note=said)


def _both_ways(data: GearData, gear: int) -> bool:
    if data.rated is not None:
        return data.idlers[gear] and data.rated.conditions.mean_stress is None
    return data.idlers[gear]


def _uneven(rule: Rule, data: GearData, gear: int, safety: float, least: float) -> tuple[str, str] | None:
    """What the load across the face takes of a safety, and what would give enough of it back, or nothing where an even
    load is too much as well; None where it takes little."""
    rated = data.rated
    if rated is None or "face_contact" in rated.given or rated.at_load.face_contact <= _UNEVEN:
        return None
    given = rated.conditions
    at, contact = rated.at_load, rule is PITTING
    taken = 1.0 - (at.face_contact**-0.5 if contact else 1.0 / at.face_bending)
    symbol, value = ("K_Hb", at.face_contact) if contact else ("K_Fb", at.face_bending)
    text = f"{symbol} {value:.3g} reduces the safety by {100.0 * taken:.0f} %"
    remedy = f"reduce {symbol}: a stiffer shaft, a smaller face width or less misalignment (rating.face)"
    if given.modification == "none" and given.misalignment is None:
        crowned = replace(rated, conditions=replace(given, modification="crowning"))
        reached = (crowned.safety_pitting if contact else crowned.safety_bending)[gear] or 0.0
        crowning = f"set rating.face.modification to crowning, which gives a safety of {short(reached)}"
        if reached >= least:
            return text, crowning
        remedy = f"{crowning}, and use a better grade or a stiffer shaft"
    return text, remedy if safety >= least * (1.0 - taken) else ""


def _out_of_range(data: GearData) -> Iterator[Check]:
    """Where the formulas of the root leave the range of their standard."""
    if data.face_width is None:
        yield BENDING.check("warn", "no stress and no safety without face_width", fix="give face_width")
    eps = data.path.contact_ratio
    if data.pair.helix_angle == 0.0 and not 1.0 <= eps <= 2.0:
        what = "contact ratio" if eps > 0.0 else "contact ratio: the gears do not mesh"
        shown = None if eps > 0.0 else NO_NUMBER
        yield BENDING.check("warn", what, eps, shown=shown, aside="method B of ISO 6336 holds for 1 to 2")
    for gear, factor in enumerate(data.root.rim_factor or ()):
        if factor is None:
            least = "1.75 modules" if data.pair.teeth[gear] < 0 else "half the height of its teeth"
            what = f"no root stress of {data.called(gear)}: its rim is too thin for ISO 6336-3"
            yield BENDING.check("warn", what, fix=f"increase rim_thickness above {least}")
    for gear, section in enumerate(data.root.sections):
        if section is None:
            what = f"no root stress of {data.called(gear)}: it has no root section as of ISO 6336-3"
            yield BENDING.check("warn", what, fix=data.rated_with(gear))
        elif not 1.0 <= section.notch < 8.0:
            what = f"notch parameter q_s of {data.called(gear)}"
            yield BENDING.check("warn", what, section.notch, aside="Y_S holds for 1 to 8")
        elif data.pair.teeth[gear] < 0 and data.pair.cutter is None:
            what = "the root of the ring gear is rated with the rounding of a rack tool"
            yield BENDING.check("warn", what, fix="give its cutter")


# With `rating`


def rating_range(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL214: what leaves its range, and what no printed number confirms."""
    if data.rated is None:
        return
    from gearlink.core.parts.gears.rating.sheet import unconfirmed

    outside, symbols = list(_outside(data.rated)), unconfirmed(data.rated)
    parts = [f"{amount(len(outside), 'value')} outside the range of its formula"] if outside else []
    if symbols:
        parts.append(f"factors without a published check value: {', '.join(symbols)}")
    what = "; ".join(parts) or "every formula of the rating is in its range and has a published check value"
    note, fix = "; ".join(outside), "compare these factors with the standard (table factors)"
    yield RATING_RANGE.check("warn" if parts else "pass", what, fix=fix, note=note)


def _outside(rated: Rated) -> Iterator[str]:
    given, name = rated.conditions, rated.data.called
    if "material" not in given.given:
        yield f"no material given: assumed {' and '.join(dict.fromkeys(steel.of for steel in rated.steels))}"
    if given.planets > 1 and "contacts" not in given.given:
        several = "sun" if given.system == "sun-planet" else "ring"
        yield f"one load contact per revolution, the {several} meets {given.planets} planets (give rating.contacts)"
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
        yield "pitting: allowed, which does not exist for this material and is not applied"
    if given.scuffing_stage is not None and rated.data.pair.internal:
        yield "scuffing of a ring: no integral temperature is computed"
    relief = None if rated.scuffing is None else rated.scuffing.relief_share
    if relief is not None and relief >= 1.0:
        yield "tip relief beyond the deflection of the teeth (X_Ca counts the deflection)"


def resonance(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL215: the speed is near to the main resonance."""
    if data.rated is None:
        return
    at, (low, high) = data.rated.at_load, _RESONANCE
    ratio = at.resonance_ratio
    near, below = low < ratio < high, ratio < 1.0
    what, aside = "speed of gear 1 over its resonance speed", f"resonance speed {short(at.resonance_speed)} 1/min"
    fix, limit = "change load.speed or the teeth", low if below else high
    status: Status = "warn" if near else "pass"
    side: Side = "<=" if below else ">="
    yield RESONANCE.check(status, what, ratio, limit, side=side, aside=aside, fix=fix)


def scuffing(data: GearData, limits: Any) -> Iterator[Check]:
    """GL216: the oil film breaks down."""
    found = None if data.rated is None else data.rated.scuffing
    if found is None:
        return
    least, safety = limits.safety_scuffing, found.safety
    aside = f"integral temperature {short(found.integral_temperature)} deg C, scuffing temperature "
    aside += f"{short(found.scuffing_temperature)} deg C"
    fix = "use an oil of a higher rating.lubricant.scuffing_stage"
    yield SCUFFING.check("fail" if safety < least else "pass", "scuffing safety", safety, least, aside=aside, fix=fix)


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
            aside = f"safety {safety:g}"
            if (life := lives[gear]) is not None:
                aside += f", life {short(life)} h of {rated.conditions.life:g} h required"
            note = ""
            if still is not None and still < safety:
                bad, note = True, f"static safety at the maximum load: {short(still)} (limit >= {safety:g})"
            called, fix = f"damage of the {what} of {data.called(gear)}", "widen the gears, or use a better material"
            yield DAMAGE.check("fail" if bad else "pass", called, used, 1.0, aside=aside, fix=fix, note=note)


def face_load(data: GearData, _limits: Any) -> Iterator[Check]:
    """GL218: the load is carried by one end of the face."""
    if data.rated is None:
        return
    factor = data.rated.at_load.face_contact
    given = data.rated.conditions
    if given.misalignment is not None:
        fix = "reduce rating.face.misalignment"
    elif given.modification == "none":
        fix = "set rating.face.modification to crowning"
    else:
        fix = "use a smaller face width, a stiffer shaft or a better grade"
    what = "face load factor K_Hb"
    yield FACE_LOAD.check("warn" if factor > _MOST_UNEVEN else "pass", what, factor, _MOST_UNEVEN, fix=fix)


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
        what = f"deviation of the root stress of {data.called(gear)} on its generated fillet from ISO 6336-3"
        aside = f"{short(factor)} and {short(standard)} F_t/(b m)"
        shown = Shown(100.0 * abs(apart), 100.0 * _APART, "%", "<=")
        fix = "use a tool with a larger rounding"
        status: Status = "warn" if abs(apart) > _APART else "pass"
        yield TRUE_FILLET.check(status, what, abs(apart), _APART, shown=shown, aside=aside, fix=fix)
