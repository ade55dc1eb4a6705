"""REXS 1.7: the gears of a design as programs for gear calculation read them (XML, https://www.rexs.info).

Components: a gear unit, a stage for each mesh, each gear on a shaft with its left and right flank, its data in each
stage, and the tool that cuts it where the file names one. The names, units and ranges are those of the REXS 1.7
data model: what lies outside of its range there is left out, since a strict reader refuses the whole file.
"""

from __future__ import annotations

import math
import os
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any
from xml.sax.saxutils import escape, quoteattr

from gearlink.cli.export.parts import pair_hands, train_hands
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.train.meshed import Meshed
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.rating.rated import Rated
    from gearlink.core.parts.gears.tooth.tools import PinionCutter

_VERSION = "1.7"


class Model:
    """Components and relations, numbered as they are added."""

    def __init__(self) -> None:
        self.components: list[str] = []
        self.relations: list[str] = []
        self._kinds: dict[int, str] = {}

    def component(self, kind: str, name: str, attributes: Iterator[tuple[str, str, Any]]) -> int:
        """A component; attributes without a value are left out."""
        number = len(self.components) + 1
        rows = [
            f"      <attribute id={quoteattr(key)} unit={quoteattr(unit)}>{_text(value)}</attribute>"
            for key, unit, value in attributes
            if value is not None
        ]
        head = f"    <component id={quoteattr(str(number))} name={quoteattr(_clean(name))} type={quoteattr(kind)}>"
        self.components.append("\n".join([head, *rows, "    </component>"]))
        self._kinds[number] = kind
        return number

    def relation(self, kind: str, order: int | None = None, **roles: int) -> None:
        """A relation between components by their roles."""
        place = "" if order is None else f' order="{order}"'
        named = ((role, number, self._kinds[number]) for role, number in roles.items())
        rows = [f'      <ref hint="{hint}" id="{number}" role="{role}"/>' for role, number, hint in named]
        head = f'    <relation id="{len(self.relations) + 1}"{place} type="{kind}">'
        self.relations.append("\n".join([head, *rows, "    </relation>"]))


def as_rexs(design: Any) -> bytes:
    """The gears of a design as a REXS file.

    Raises
        NoSolution - where a gear pair does not exist, or the kind has no external or internal pair
    Notes
        Lengths, diameters and numbers of teeth of a ring are positive, as the data model has them; profile shifts keep
        the signs of ISO 21771. The schema requires a date: that of SOURCE_DATE_EPOCH, for files that are to be the same
        again on another day, else the day of the export.
    """
    meshes = list(_meshes(design))
    if not meshes:
        having = ", ".join(kind.name for kind in KINDS.values() if kind.rexs is not None)
        raise NoSolution(f"a {design.kind} has no gear pair for REXS: kinds that have one: {having}")
    model = Model()
    unit = model.component("gear_unit", design.spec.name, iter(()))
    known: dict[str, int] = {}
    for mesh in meshes:
        names = mesh.names
        hands = [1 if hand == "right" else -1 for hand in mesh.hands]  # right-hand helices count positive
        attributes = iter((*_stage(mesh), *_factors(mesh.data)))
        stage = model.component("cylindrical_stage", f"{names[0]} - {names[1]}", attributes)
        gears = [_gear(model, unit, known, mesh, i, hands[i]) for i in (0, 1)]
        model.relation("assembly", assembly=unit, part=stage)
        model.relation("stage", stage=stage, gear_1=gears[0], gear_2=gears[1])
        for i, gear in enumerate(gears):
            attributes = iter((*_stage_data(mesh.pair, i), *_safeties(mesh.data, i)))
            data = model.component("cylindrical_stage_gear_data", names[i], attributes)
            model.relation("stage_gear_data", stage=stage, gear=gear, stage_gear_data=data)
    return _document(model).encode()


def _document(model: Model) -> str:
    given = os.environ.get("SOURCE_DATE_EPOCH")
    now = datetime.fromtimestamp(int(given), UTC) if given else datetime.now(UTC)
    moment = now if given else now.replace(hour=0, minute=0, second=0, microsecond=0)
    head = f'applicationId="gearlink" applicationVersion="{VERSION}" date="{moment.isoformat()}" version="{_VERSION}"'
    rows = ["  <relations>", *model.relations, "  </relations>", "  <components>", *model.components, "  </components>"]
    return "\n".join(['<?xml version="1.0" encoding="UTF-8"?>', f"<model {head}>", *rows, "</model>", ""])


def _gear(model: Model, unit: int, known: dict[str, int], mesh: _Mesh, i: int, hand: int) -> int:
    """A gear on its shaft with material, flanks and the tool that cuts them; once, though it may mesh twice."""
    name, pair, rated = mesh.names[i], mesh.pair, mesh.data.rated
    if name in known:
        return known[name]
    shaft = model.component("shaft", f"shaft of {name}", iter(()))
    model.relation("assembly", assembly=unit, part=shaft)
    ring = i == 1 and pair.internal
    attributes = iter((*_gear_data(mesh, i, hand), *_limits(mesh.data, i), *_accuracy(mesh.data, i)))
    gear = model.component("ring_gear" if ring else "cylindrical_gear", name, attributes)
    model.relation("assembly", assembly=shaft, part=gear)
    if rated is not None:
        material = model.component("material", rated.steels[i].name, _material(rated, i))
        model.relation("reference", origin=gear, referenced=material)
    sides = [model.component("cylindrical_gear_flank", f"{name}, {side} flank", _flank(pair, i)) for side in _SIDES]
    model.relation("flank", gear=gear, left=sides[0], right=sides[1])
    cutter = pair.cutter if ring else None
    if cutter is not None or (pair.tools[i] is not None and not ring):
        called, attributes = (
            ("rack_shaped_tool", _rack(pair, i)) if cutter is None else ("cutter_wheel_tool", _cutter(pair, cutter))
        )
        tool = model.component(called, f"tool of {name}", attributes)
        for flank in sides:
            made = model.component("cylindrical_gear_manufacturing_settings", name, iter(()))
            model.relation("manufacturing_step", 1, workpiece=flank, tool=tool, manufacturing_settings=made)
    known[name] = gear
    return gear


_SIDES = ("left", "right")


def _stage(mesh: _Mesh) -> Iterator[tuple[str, str, Any]]:
    pair = mesh.pair
    z_1, z_2 = (abs(z) for z in pair.teeth)
    yield "center_distance", "mm", abs(pair.center_distance)
    yield "gear_ratio", "none", max(z_1, z_2) / min(z_1, z_2)
    yield "flag_designation_addendum_modification", "none", "entry_of_addendum_modification_coefficient"
    yield "sum_of_addendum_modification_coefficients", "none", sum(pair.profile_shift)
    if pair.contact_ratio > 0.0:
        yield "radial_contact_ratio", "none", pair.contact_ratio
    if mesh.widths:
        yield "common_face_width", "mm", min(mesh.widths)
    if mesh.data.backlash is not None:
        least, greatest = mesh.data.backlash.normal
        yield "minimum_normal_backlash", "mm", least
        yield "maximum_normal_backlash", "mm", greatest


def _gear_data(mesh: _Mesh, i: int, hand: int) -> Iterator[tuple[str, str, Any]]:
    pair, widths = mesh.pair, mesh.widths
    yield "number_of_teeth", "none", abs(pair.teeth[i])
    yield "normal_module", "mm", pair.module
    yield "helix_angle_reference_diameter", "deg", hand * math.degrees(pair.helix_angle) + 0.0
    yield "face_width", "mm", widths[i] if widths else None
    yield "reference_circle_diameter", "mm", 2.0 * abs(pair.reference_radius[i])
    yield "base_circle_diameter", "mm", 2.0 * abs(pair.base_radius[i])
    yield "tip_diameter", "mm", 2.0 * abs(pair.tip_radius[i])
    yield "root_diameter", "mm", 2.0 * abs(pair.root_radius[i])
    yield "normal_tooth_thickness_at_reference_diameter", "mm", _positive(pair.tooth_thickness[i])


def _limits(data: GearData, i: int) -> Iterator[tuple[str, str, Any]]:
    """Span and size over balls, with the deviations of both that the thickness allowances give."""
    span, over_balls = data.pair.span_measurement[i], data.measure_over_balls[i]
    spans, sizes = data.span_measurement_limits, data.measure_limits
    if span is not None and span > 0.0:
        yield "number_of_teeth_for_span_measurement", "none", data.pair.span_teeth[i]
        yield "span_measurement", "mm", span
        for end, limit in zip(_ENDS, (spans and spans[i]) or (), strict=False):
            yield f"{end}_backlash_allowance_referenced_to_span", "mum", 1000.0 * (limit - span)
    if over_balls is not None:
        yield "diameter_of_measuring_ball_or_pin", "mm", data.pin_diameter[i]
        yield "size_over_balls", "mm", over_balls
        for end, size in zip(_ENDS, (sizes and sizes[i]) or (), strict=False):
            if size is not None:
                yield f"{end}_backlash_allowance_balls_or_pins", "mm", size - over_balls


_ENDS = ("lower", "upper")


def _positive(value: float) -> float | None:
    return value if value > 0.0 else None


def _flank(pair: GearPair, i: int) -> Iterator[tuple[str, str, Any]]:
    yield "normal_pressure_angle", "deg", math.degrees(pair.pressure_angle)
    yield "pressure_angle_in_the_transverse_section", "deg", math.degrees(pair.transverse_pressure_angle)
    yield "addendum_modification_coefficient", "none", pair.profile_shift[i]
    yield "addendum_modification", "mm", pair.profile_shift[i] * pair.module
    yield "addendum_coefficient_basic_profile", "none", pair.addendum
    if not (i == 1 and pair.internal):
        yield "remaining_protuberance", "mm", _positive(pair.tool(i).residual_undercut * pair.module)


def _rack(pair: GearPair, i: int) -> Iterator[tuple[str, str, Any]]:
    tool = pair.tool(i)
    yield "normal_module", "mm", pair.module
    yield "normal_pressure_angle", "deg", math.degrees(pair.pressure_angle)
    yield "addendum_coefficient_reference_profile", "none", tool.addendum
    yield "tip_radius_factor", "none", _positive(tool.rounding)


def _cutter(pair: GearPair, cutter: PinionCutter) -> Iterator[tuple[str, str, Any]]:
    yield "number_of_teeth", "none", cutter.teeth
    yield "normal_module", "mm", pair.module
    yield "normal_pressure_angle", "deg", math.degrees(pair.pressure_angle)
    yield "addendum_modification_coefficient", "none", cutter.shift
    yield "addendum_coefficient_reference_profile", "none", cutter.addendum
    yield "tip_radius_factor", "none", _positive(cutter.rounding)


def _stage_data(pair: GearPair, i: int) -> Iterator[tuple[str, str, Any]]:
    yield "pitch_diameter", "mm", 2.0 * abs(pair.working_radius[i])
    yield "operating_pressure_angle_in_the_transverse_section", "deg", math.degrees(pair.working_pressure_angle)
    yield "tip_clearance", "mm", _positive(pair.tip_clearance[i])


def _material(rated: Rated, i: int) -> Iterator[tuple[str, str, Any]]:
    steel = rated.steels[i]
    yield "material_designation", "none", steel.name
    hardness, unit = ("surface_hardness_brinell", "HB") if steel.kind.brinell else ("surface_hardness_vickers", "HV")
    yield hardness, unit, steel.hardness
    yield "allowable_stress_number_contact_iso_6336_2003", "N / mm^2", steel.contact_limit
    yield "nominal_stress_number_tooth_root_iso_6336_2003", "N / mm^2", steel.bending_limit


def _accuracy(data: GearData, i: int) -> Iterator[tuple[str, str, Any]]:
    """The grade of edition 2013 of ISO 1328-1, the only one that the data model has."""
    rated = data.rated
    if rated is None:
        yield "tolerance_class_according_to_iso_1328_2013", "none", data.accuracy_grade
    elif rated.conditions.edition == 2013:
        yield "tolerance_class_according_to_iso_1328_2013", "none", rated.conditions.grades[i]


def _factors(data: GearData) -> Iterator[tuple[str, str, Any]]:
    """The factors of a rating; one below 1 that the file gives has no place in the data model."""
    if data.rated is None:
        return
    factors = data.rated.factors
    yield f"mesh_load_factor_iso_6336_{data.edition}", "none", factors.distribution
    for name, factor in (
        ("application_factor", factors.application),
        ("dynamic_factor", factors.dynamic),
        ("face_load_factor_contact_stress", factors.face_contact),
        ("face_load_factor_root_stress", factors.face_bending),
        ("transverse_load_factor_contact_stress", factors.transverse_contact),
        ("transverse_load_factor_root_stress", factors.transverse_bending),
    ):
        yield f"{name}_iso_6336_{data.edition}", "none", factor if factor >= 1.0 else None


def _safeties(data: GearData, i: int) -> Iterator[tuple[str, str, Any]]:
    if data.rated is not None:
        yield f"safety_factor_pitting_iso_6336_{data.edition}", "none", data.rated.safety_pitting[i]
        yield f"safety_factor_tooth_root_iso_6336_{data.edition}", "none", data.rated.safety_bending[i]


@dataclass(frozen=True)
class _Mesh:
    """A mesh of a design, a ring second: names, its data, face widths [mm] and hands of helix."""

    names: tuple[str, str]
    data: GearData
    widths: tuple[float, float] | None
    hands: tuple[str, str]

    @property
    def pair(self) -> GearPair:
        return self.data.pair


def _meshes(design: Any) -> Iterator[_Mesh]:
    """Every mesh of a design."""
    if getattr(design.spec, "rack", False):
        raise NoSolution("the data model of REXS 1.7 has no rack", key="teeth[1]", fix="use --as dxf, svg, csv or step")
    names = KINDS[design.kind].rexs
    if names is None:
        return
    if not isinstance(design, Meshed):
        if design.kind == "flatbed-press" and design.spec.input_gears is None:
            return
        data = design.data if design.kind == "gear-pair" else design.gear_data
        yield _Mesh((names[0], names[1]), data, data.face_width, pair_hands(design))
    else:
        names = names or tuple(f"{name} gear" for name in design.spec.gears.gear_names())
        for label, place in zip(design.mesh_names, design.teeth_train.places, strict=True):
            one, other = place.gears
            data = design.mesh_data[label]
            yield _Mesh((names[one], names[other]), data, design.widths_of(label), train_hands(design, label))


def _text(value: Any) -> str:
    return repr(value) if isinstance(value, float) else escape(str(value))


def _clean(text: str) -> str:
    return " ".join("".join(letter if letter.isprintable() else " " for letter in text).split())
