"""The gear table of a drawing: what a workshop needs to cut, measure and pair a gear."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Table
from gearlink.core.parts.gears.data import GearData

if TYPE_CHECKING:
    from gearlink.core.parts.gears.measures.iso_1328 import ToothTolerances
    from gearlink.core.parts.gears.rack import RackMesh

Row = tuple[str, str, Any, Any, str]


def drawing_table(data: GearData, hands: tuple[str, str] | None = None) -> Table:
    """The table `drawing`, a row per line of the drawing: item, symbol, gear 1, gear 2, unit.

    Parameters
        hands : (str, str) or None - hands of helix
    Source
        DIN 3966 for what belongs on a drawing, from memory
    """
    rows = [row for row in _rows(data, hands) if not (row[2] is None and row[3] is None)]
    return _table(rows)


def lines_of(table: Table, gear: int) -> list[tuple[str, str, Any, str]]:
    """Item, symbol, value and unit of the lines of a drawing's table that gear 0 or 1 has."""
    columns: Any = table.data
    rows = zip(*columns, strict=True)
    return [(item, symbol, values[gear], unit) for item, symbol, *values, unit in rows if values[gear] is not None]


def _table(rows: list[Row]) -> Table:
    columns = ("item", "symbol", "gear_1", "gear_2", "unit")
    return Table("drawing", columns, ("",) * len(columns), tuple(list(column) for column in zip(*rows, strict=True)))


_OF_RACK = frozenset(
    (
        *("normal module", "pressure angle", "tool addendum", "tool rounding", "helix angle", "hand of helix"),
        *("face width", "thickness allowance, upper", "thickness allowance, lower", "ball diameter"),
    )
)


def rack_drawing(rack: RackMesh, hands: tuple[str, str] | None = None) -> Table:
    """The table `drawing` of a gear on a rack, whose column is empty where a rack has no such line.

    Parameters
        hands : (str, str) or None - hands of helix
    Source
        DIN 3966 for what belongs on a drawing, from memory
    """
    rows: list[Row] = []
    for item, symbol, gear, mate, unit in (*_teeth(rack.data, hands), *_circles(rack.data), *_thickness(rack.data)):
        if item == "number of teeth":
            rows.append((item, symbol, gear, "rack", unit))
        elif gear is not None or item in _OF_RACK:
            rows.append((item, symbol, gear, mate if item in _OF_RACK else None, unit))
    rows += [*_rack_lines(rack), *_rack_mesh(rack)]
    return _table([row for row in rows if row[2] is not None or row[3] is not None])


def _rack_lines(rack: RackMesh) -> Iterator[Row]:
    """What the rack's own teeth are made and measured by."""
    module, diameter = rack.pair.module, rack.data.pin_diameter[1]
    yield "pitch of the rack", "p_t", None, rack.pitch_on_line, "mm"
    yield "tip line above the datum line", "h_aR", None, rack.path.height * module, "mm"
    yield "root line below the datum line", "h_fR", None, rack.pair.root_depth(1) * module, "mm"
    yield "tooth thickness on the datum line", "s", None, 0.5 * math.pi * module, "mm"
    if diameter is None:
        return
    allowances = ((0.0, 0.0),) * 2 if rack.data.allowances is None else rack.data.allowances
    heights = [rack.height_over_pin(diameter, each) for each in allowances[1]]
    names = ("nominal",) if rack.data.allowances is None else ("maximum", "minimum")
    for name, height in zip(names, heights, strict=False):
        yield f"datum line to ball top, {name}", "M_R", None, height, "mm"


def _rack_mesh(rack: RackMesh) -> Iterator[Row]:
    yield "axis to the datum line of the rack", "a", rack.center_distance, rack.center_distance, "mm"
    allowance = rack.data.distance_allowance
    yield "centre distance allowance +-", "A_a", allowance, allowance, "mm"
    yield "contact ratio", "eps_alpha", rack.contact_ratio, rack.contact_ratio, ""
    for play, name in zip(rack.backlash_normal or (), ("minimum", "maximum"), strict=False):
        yield f"theoretical backlash, {name}", "j_bn", play, play, "mm"


def _rows(data: GearData, hands: tuple[str, str] | None) -> Iterator[Row]:
    yield from _teeth(data, hands)
    yield from _circles(data)
    yield from _thickness(data)
    yield from _mesh(data)
    yield from _strength(data)


def _strength(data: GearData) -> Iterator[Row]:
    """Grade and tolerances, material, and the safeties; where the file has `rating`."""
    rated, tolerances = data.rated, data.tolerances
    if tolerances is not None:
        yield from _tolerances(*tolerances)
    elif data.accuracy_grade is not None:
        yield "accuracy grade, ISO 1328-1", "", data.accuracy_grade, data.accuracy_grade, ""
    if rated is None:
        return
    steels = rated.steels
    yield "material", "", steels[0].name, steels[1].name, ""
    for symbol, brinell in (("HV", False), ("HBW", True)):
        first, second = (steel.hardness if steel.kind.brinell == brinell else None for steel in steels)
        yield "hardness", symbol, first, second, ""
    yield "roughness of the flanks", "Rz", *rated.conditions.flank_roughness, "um"
    yield "safety against pitting", "S_H", *rated.safety_pitting, ""
    yield "safety against tooth breakage", "S_F", *rated.safety_bending, ""


def _tolerances(one: ToothTolerances, other: ToothTolerances) -> Iterator[Row]:
    """Those of the flanks."""
    yield f"accuracy grade, ISO 1328-1:{one.edition}", "", one.grade, other.grade, ""
    for words, symbol, values in (
        ("single pitch deviation", "f_pt", (one.single_pitch, other.single_pitch)),
        ("cumulative pitch deviation", "F_p", (one.cumulative_pitch, other.cumulative_pitch)),
        ("total profile deviation", "F_alpha", (one.profile_total, other.profile_total)),
        ("total helix deviation", "F_beta", (one.helix_total, other.helix_total)),
        ("runout", "F_r", (one.runout, other.runout)),
    ):
        yield words, symbol, *values, "um"


def _teeth(data: GearData, hands: tuple[str, str] | None) -> Iterator[Row]:
    pair = data.pair
    yield "normal module", "m", pair.module, pair.module, "mm"
    yield "number of teeth", "z", *pair.teeth, ""
    angle = _degrees(pair.pressure_angle)
    yield "pressure angle", "alpha", angle, angle, "deg"
    yield "tool addendum", "h_fP*", pair.root_depth(0), pair.root_depth(1), ""
    first, second = (None if tool is None else tool.rounding for tool in pair.tools)
    yield "tool rounding", "rho*", first, second, ""
    helix = _degrees(pair.helix_angle)
    yield "helix angle", "beta", helix, helix, "deg"
    if hands is not None:
        yield "hand of helix", "", *hands, ""
    yield "profile shift", "x", *pair.profile_shift, ""
    yield "face width", "b", *(data.face_width or (None, None)), "mm"


def _degrees(angle: float) -> float:
    """In degrees, as a file wrote it: without the rounding of the way there and back."""
    return round(math.degrees(angle), 12)


def _circles(data: GearData) -> Iterator[Row]:
    pair = data.pair
    circles = (
        ("reference diameter", "d", pair.reference_radius),
        ("tip diameter", "d_a", pair.tip_radius),
        ("root diameter", "d_f", pair.root_radius),
        ("root form diameter", "d_Ff", pair.form_radius),
        ("base diameter", "d_b", pair.base_radius),
    )
    for words, symbol, radii in circles:
        one, other = (None if radius is None else 2.0 * abs(radius) for radius in radii)
        yield words, symbol, one, other, "mm"


def _limits(words: str, symbol: str, nominal: Any, limits: Any) -> Iterator[Row]:
    """A measure by its nominal value, or by its limits where there are allowances."""
    if limits is None:
        yield f"{words}, nominal", symbol, *nominal, "mm"
        return
    for end, name in ((1, "maximum"), (0, "minimum")):
        one, other = (None if each is None else each[end] for each in limits)
        yield f"{words}, {name}", symbol, one, other, "mm"


def _thickness(data: GearData) -> Iterator[Row]:
    pair = data.pair
    if data.allowances is not None:
        for end, (name, symbol) in enumerate((("upper", "E_sns"), ("lower", "E_sni"))):
            one, other = (each[end] for each in data.allowances)
            yield f"thickness allowance, {name}", symbol, one, other, "mm"
    yield "teeth (ring: spaces) spanned", "k", *pair.span_teeth, ""
    yield from _limits("span measurement", "W_k", pair.span_measurement, data.span_measurement_limits)
    yield "ball diameter", "D_M", *data.pin_diameter, "mm"
    yield from _over_balls(data)
    yield "chordal thickness, nominal", "s_c", *data.chordal_thickness, "mm"
    yield "chordal height", "h_c", *data.chordal_height, "mm"


def _over_balls(data: GearData) -> Iterator[Row]:
    """The measure over balls, of a ring between them, each in lines of its own."""
    for words, of_ring in (("measure over balls", False), ("measure between balls", True)):
        mine = [(teeth < 0) is of_ring for teeth in data.pair.teeth]
        if any(mine):
            values = (data.measure_over_balls, data.measure_limits)
            nominal, limits = (
                None if each is None else tuple(value if own else None for value, own in zip(each, mine, strict=True))
                for each in values
            )
            yield from _limits(words, "M_dK", nominal, limits)


def _mesh(data: GearData) -> Iterator[Row]:
    pair = data.pair
    yield "teeth of the mating gear", "", pair.teeth[1], pair.teeth[0], ""
    distance = abs(pair.center_distance)
    yield "centre distance", "a_w", distance, distance, "mm"
    allowance = data.distance_allowance
    yield "centre distance allowance +-", "A_a", allowance, allowance, "mm"
    yield "working pressure angle", "alpha_wt", *(_degrees(pair.working_pressure_angle),) * 2, "deg"
    yield "contact ratio", "eps_alpha", pair.contact_ratio, pair.contact_ratio, ""
    if data.backlash is not None:
        for end, name in ((0, "minimum"), (1, "maximum")):
            play = data.backlash.normal[end]
            yield f"theoretical backlash, {name}", "j_bn", play, play, "mm"
