"""REXS 1.7: the gears of a design as programs for gear calculation read them (XML, https://www.rexs.info).

Components: a gear unit, a stage for each mesh, each gear on a shaft with its left and right flank, its data in each
stage, and the rack tool that cuts it where the file names one. The names are those of the REXS 1.7 data model.
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
    from gearlink.core.parts.gears.rating.rated import Rated

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
        rows = [
            f'      <ref hint="{self._kinds[number]}" id="{number}" role="{role}"/>' for role, number in roles.items()
        ]
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
        names, pair, widths = mesh.names, mesh.pair, mesh.widths
        hands = [1 if hand == "right" else -1 for hand in mesh.hands]  # right-hand helices count positive
        factors = () if mesh.rated is None else _factors(mesh.rated)
        attributes = iter((*_stage(pair, widths), *factors))
        stage = model.component("cylindrical_stage", f"{names[0]} - {names[1]}", attributes)
        gears = [_gear(model, unit, known, mesh, i, hands[i]) for i in (0, 1)]
        model.relation("assembly", assembly=unit, part=stage)
        model.relation("stage", stage=stage, gear_1=gears[0], gear_2=gears[1])
        for i, gear in enumerate(gears):
            strength = () if mesh.rated is None else _safeties(mesh.rated, i)
            attributes = iter((*_stage_data(pair, i), *strength))
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
    name, pair, widths, rated = mesh.names[i], mesh.pair, mesh.widths, mesh.rated
    if name in known:
        return known[name]
    shaft = model.component("shaft", f"shaft of {name}", iter(()))
    model.relation("assembly", assembly=unit, part=shaft)
    ring = i == 1 and pair.internal
    accuracy = () if rated is None else _accuracy(rated, i)
    attributes = iter((*_gear_data(pair, i, widths, hand), *accuracy))
    gear = model.component("ring_gear" if ring else "cylindrical_gear", name, attributes)
    model.relation("assembly", assembly=shaft, part=gear)
    if rated is not None:
        material = model.component("material", rated.steels[i].name, _material(rated, i))
        model.relation("reference", origin=gear, referenced=material)
    sides = [model.component("cylindrical_gear_flank", f"{name}, {side} flank", _flank(pair, i)) for side in _SIDES]
    model.relation("flank", gear=gear, left=sides[0], right=sides[1])
    if pair.tools[i] is not None and not ring:
        tool = model.component("rack_shaped_tool", f"tool of {name}", _tool(pair, i))
        for flank in sides:
            made = model.component("cylindrical_gear_manufacturing_settings", name, iter(()))
            model.relation("manufacturing_step", 1, workpiece=flank, tool=tool, manufacturing_settings=made)
    known[name] = gear
    return gear


_SIDES = ("left", "right")


def _stage(pair: GearPair, widths: tuple[float, float] | None) -> Iterator[tuple[str, str, Any]]:
    z_1, z_2 = (abs(z) for z in pair.teeth)
    yield "center_distance", "mm", abs(pair.center_distance)
    yield "gear_ratio", "none", max(z_1, z_2) / min(z_1, z_2)
    yield "flag_designation_addendum_modification", "none", "entry_of_addendum_modification_coefficient"
    yield "sum_of_addendum_modification_coefficients", "none", sum(pair.profile_shift)
    if pair.contact_ratio > 0.0:
        yield "radial_contact_ratio", "none", pair.contact_ratio
    if widths:
        yield "common_face_width", "mm", min(widths)


def _gear_data(pair: GearPair, i: int, widths: tuple[float, float] | None, hand: int) -> Iterator[tuple[str, str, Any]]:
    yield "number_of_teeth", "none", abs(pair.teeth[i])
    yield "normal_module", "mm", pair.module
    yield "helix_angle_reference_diameter", "deg", hand * math.degrees(pair.helix_angle) + 0.0
    yield "face_width", "mm", widths[i] if widths else None
    for key, radii in (
        ("reference_circle_diameter", pair.reference_radius),
        ("base_circle_diameter", pair.base_radius),
        ("tip_diameter", pair.tip_radius),
        ("root_diameter", pair.root_radius),
    ):
        yield key, "mm", 2.0 * abs(radii[i])
    yield "normal_tooth_thickness_at_reference_diameter", "mm", pair.tooth_thickness[i]
    span = pair.span_measurement[i]
    if span is not None:
        yield "number_of_teeth_for_span_measurement", "none", pair.span_teeth[i]
        yield "span_measurement", "mm", span


def _flank(pair: GearPair, i: int) -> Iterator[tuple[str, str, Any]]:
    yield "normal_pressure_angle", "deg", math.degrees(pair.pressure_angle)
    yield "pressure_angle_in_the_transverse_section", "deg", math.degrees(pair.transverse_pressure_angle)
    yield "addendum_modification_coefficient", "none", pair.profile_shift[i]
    yield "addendum_modification", "mm", pair.profile_shift[i] * pair.module
    yield "addendum_coefficient_basic_profile", "none", pair.addendum


def _tool(pair: GearPair, i: int) -> Iterator[tuple[str, str, Any]]:
    tool = pair.tool(i)
    yield "normal_module", "mm", pair.module
    yield "normal_pressure_angle", "deg", math.degrees(pair.pressure_angle)
    yield "addendum_coefficient_reference_profile", "none", tool.addendum
    yield "tip_radius_factor", "none", tool.rounding or None  # the data model has none of 0


def _stage_data(pair: GearPair, i: int) -> Iterator[tuple[str, str, Any]]:
    yield "pitch_diameter", "mm", 2.0 * abs(pair.working_radius[i])
    yield "operating_pressure_angle_in_the_transverse_section", "deg", math.degrees(pair.working_pressure_angle)
    yield "tip_clearance", "mm", pair.tip_clearance[i]


def _material(rated: Rated, i: int) -> Iterator[tuple[str, str, Any]]:
    steel = rated.steels[i]
    yield "material_designation", "none", steel.name
    hardness, unit = ("surface_hardness_brinell", "HB") if steel.kind.brinell else ("surface_hardness_vickers", "HV")
    yield hardness, unit, steel.hardness
    yield "allowable_stress_number_contact_iso_6336_2003", "N / mm^2", steel.contact_limit
    yield "nominal_stress_number_tooth_root_iso_6336_2003", "N / mm^2", steel.bending_limit


def _accuracy(rated: Rated, i: int) -> Iterator[tuple[str, str, Any]]:
    """The grade of edition 2013, the only one that the data model has."""
    if rated.conditions.edition == 2013:
        yield "tolerance_class_according_to_iso_1328_2013", "none", rated.conditions.grades[i]


def _factors(rated: Rated) -> Iterator[tuple[str, str, Any]]:
    factors = rated.factors
    yield "application_factor_iso_6336_2006", "none", factors.application
    yield "mesh_load_factor_iso_6336_2006", "none", factors.distribution
    yield "dynamic_factor_iso_6336_2006", "none", factors.dynamic
    yield "face_load_factor_contact_stress_iso_6336_2006", "none", factors.face_contact
    yield "face_load_factor_root_stress_iso_6336_2006", "none", factors.face_bending
    yield "transverse_load_factor_contact_stress_iso_6336_2006", "none", factors.transverse_contact
    yield "transverse_load_factor_root_stress_iso_6336_2006", "none", factors.transverse_bending


def _safeties(rated: Rated, i: int) -> Iterator[tuple[str, str, Any]]:
    yield "safety_factor_pitting_iso_6336_2006", "none", rated.safety_pitting[i]
    yield "safety_factor_tooth_root_iso_6336_2006", "none", rated.safety_bending[i]


@dataclass(frozen=True)
class _Mesh:
    """A mesh of a design, a ring second: names, pair, face widths [mm], hands of helix, and its rating."""

    names: tuple[str, str]
    pair: GearPair
    widths: tuple[float, float] | None
    hands: tuple[str, str]
    rated: Rated | None = None


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
        yield _Mesh((names[0], names[1]), data.pair, data.face_width, pair_hands(design), data.rated)
    else:
        names = names or tuple(f"{name} gear" for name in design.spec.gears.gear_names())
        for label, place in zip(design.mesh_names, design.teeth_train.places, strict=True):
            one, other = place.gears
            pair = design.meshes[label]
            rated = None if design.spec.gears.rating is None else design.mesh_data[label].rated
            yield _Mesh((names[one], names[other]), pair, design.widths_of(label), train_hands(design, label), rated)


def _text(value: Any) -> str:
    return repr(value) if isinstance(value, float) else escape(str(value))


def _clean(text: str) -> str:
    return " ".join("".join(letter if letter.isprintable() else " " for letter in text).split())
