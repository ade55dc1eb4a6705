"""REXS and STEP: components that the data model knows, solids of the right volume, refusals that help."""

from __future__ import annotations

import math
import sys
import xml.etree.ElementTree as ET
from dataclasses import replace
from datetime import UTC, datetime
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from oracles.sections import section_area
from scipy.interpolate import BSpline

from gearlink.cli.export import parts, step
from gearlink.cli.export.command import _drawn
from gearlink.cli.export.contour import Contour, contour
from gearlink.cli.export.options import CurveForm, Export, FileFormat
from gearlink.cli.export.rexs import as_rexs
from gearlink.cli.options import Options
from gearlink.core.base.errors import GearlinkError
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile
from gearlink.core.parts.gears.tooth.involute import involute

HELICAL = """kind: gear-pair
name: h & <b>
module: 3
teeth: [21, -67]
profile_shift: [0.3, -0.1]
helix_angle: 15
face_width: [40, 38]
tool: {addendum: 1.25, rounding: 0.38}
"""
UNITS = {
    "cylindrical_stage": {
        "center_distance": "mm",
        "gear_ratio": "none",
        "flag_designation_addendum_modification": "none",
        "sum_of_addendum_modification_coefficients": "none",
        "radial_contact_ratio": "none",
        "common_face_width": "mm",
        "minimum_normal_backlash": "mm",
        "maximum_normal_backlash": "mm",
        "application_factor_iso_6336_2006": "none",
        "mesh_load_factor_iso_6336_2006": "none",
        "dynamic_factor_iso_6336_2006": "none",
        "face_load_factor_contact_stress_iso_6336_2006": "none",
        "face_load_factor_root_stress_iso_6336_2006": "none",
        "transverse_load_factor_contact_stress_iso_6336_2006": "none",
        "transverse_load_factor_root_stress_iso_6336_2006": "none",
    },
    "cylindrical_gear": {
        "number_of_teeth": "none",
        "normal_module": "mm",
        "helix_angle_reference_diameter": "deg",
        "face_width": "mm",
        "reference_circle_diameter": "mm",
        "base_circle_diameter": "mm",
        "tip_diameter": "mm",
        "root_diameter": "mm",
        "normal_tooth_thickness_at_reference_diameter": "mm",
        "number_of_teeth_for_span_measurement": "none",
        "span_measurement": "mm",
        "lower_backlash_allowance_referenced_to_span": "mum",
        "upper_backlash_allowance_referenced_to_span": "mum",
        "diameter_of_measuring_ball_or_pin": "mm",
        "size_over_balls": "mm",
        "lower_backlash_allowance_balls_or_pins": "mm",
        "upper_backlash_allowance_balls_or_pins": "mm",
        "tolerance_class_according_to_iso_1328_2013": "none",
    },
    "cylindrical_gear_flank": {
        "normal_pressure_angle": "deg",
        "pressure_angle_in_the_transverse_section": "deg",
        "addendum_modification_coefficient": "none",
        "addendum_modification": "mm",
        "addendum_coefficient_basic_profile": "none",
        "remaining_protuberance": "mm",
    },
    "rack_shaped_tool": {
        "normal_module": "mm",
        "normal_pressure_angle": "deg",
        "addendum_coefficient_reference_profile": "none",
        "tip_radius_factor": "none",
    },
    "cutter_wheel_tool": {
        "number_of_teeth": "none",
        "normal_module": "mm",
        "normal_pressure_angle": "deg",
        "addendum_modification_coefficient": "none",
        "addendum_coefficient_reference_profile": "none",
        "tip_radius_factor": "none",
    },
    "cylindrical_stage_gear_data": {
        "pitch_diameter": "mm",
        "operating_pressure_angle_in_the_transverse_section": "deg",
        "tip_clearance": "mm",
        "safety_factor_pitting_iso_6336_2006": "none",
        "safety_factor_tooth_root_iso_6336_2006": "none",
    },
    "material": {
        "material_designation": "none",
        "surface_hardness_vickers": "HV",
        "surface_hardness_brinell": "HB",
        "allowable_stress_number_contact_iso_6336_2003": "N / mm^2",
        "nominal_stress_number_tooth_root_iso_6336_2003": "N / mm^2",
    },
}
UNITS["ring_gear"] = UNITS["cylindrical_gear"]
for _names in (UNITS["cylindrical_stage"], UNITS["cylindrical_stage_gear_data"]):
    _names |= {name.replace("2006", "2019"): unit for name, unit in _names.items() if "2006" in name}
"""Attributes and units of the REXS 1.7 data model (schema of 2024-12-12), as far as gears use them."""
ROLES = {
    "assembly": {"assembly", "part"},
    "stage": {"stage", "gear_1", "gear_2"},
    "flank": {"gear", "left", "right"},
    "stage_gear_data": {"stage", "gear", "stage_gear_data"},
    "manufacturing_step": {"workpiece", "tool", "manufacturing_settings"},
    "reference": {"origin", "referenced"},
}


def _model(data: bytes) -> tuple[dict[str, ET.Element], dict[str, dict[str, str]]]:
    """Components by number, and their attributes by name, held to the data model."""
    root = ET.fromstring(data)
    assert root.attrib["version"] == "1.7"
    components = {c.attrib["id"]: c for c in root.iter("component")}
    for component in components.values():
        for attribute in component:
            known = UNITS[component.attrib["type"]]
            assert known[attribute.attrib["id"]] == attribute.attrib["unit"]
    for relation in root.iter("relation"):
        assert {ref.attrib["role"] for ref in relation} == ROLES[relation.attrib["type"]]
        for ref in relation:
            assert components[ref.attrib["id"]].attrib["type"] == ref.attrib["hint"]
    return components, {c: {a.attrib["id"]: a.text or "" for a in e} for c, e in components.items()}


def test_rexs_of_a_ring_and_its_pinion(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "h.yaml"
    path.write_text(HELICAL)
    ended = gearlink("export", path, "--as", "rexs", "--out", tmp_path / "out")
    assert (ended.status, ended.err[:37]) == (1, "warning: the design fails GL207 fille")
    (file,) = (tmp_path / "out").iterdir()
    assert file.suffix == ".rexs"
    components, values = _model(file.read_bytes())
    (pinion,) = (values[i] for i, c in components.items() if c.attrib["type"] == "cylindrical_gear")
    (ring,) = (values[i] for i, c in components.items() if c.attrib["type"] == "ring_gear")
    (stage,) = (values[i] for i, c in components.items() if c.attrib["type"] == "cylindrical_stage")
    assert (pinion["number_of_teeth"], ring["number_of_teeth"]) == ("21", "67")
    assert float(ring["helix_angle_reference_diameter"]) == pytest.approx(15.0, rel=1e-12)  # the hand of its pinion
    transverse = 3.0 / math.cos(math.radians(15.0))
    assert float(ring["reference_circle_diameter"]) == pytest.approx(67 * transverse, rel=1e-14)
    assert float(stage["gear_ratio"]) == pytest.approx(67 / 21, rel=1e-12)
    assert float(stage["common_face_width"]) == 38.0
    shifts = [v["addendum_modification_coefficient"] for v in values.values() if "addendum_modification" in v]
    assert shifts == ["0.3", "0.3", "-0.1", "-0.1"]
    assert sum(c.attrib["type"] == "rack_shaped_tool" for c in components.values()) == 1  # a rack cuts no ring


def test_rexs_of_a_rated_pair_has_material_grade_and_safeties() -> None:
    made = design("rated_pair", command="gear")
    components, attributes = _model(as_rexs(made))
    of_kind = {kind: [c for c in components if components[c].attrib["type"] == kind] for kind in UNITS}
    steels = [attributes[c]["material_designation"] for c in of_kind["material"]]
    assert steels == ["16MnCr5", "18CrNiMo7-6"]
    grades = {attributes[c]["tolerance_class_according_to_iso_1328_2013"] for c in of_kind["cylindrical_gear"]}
    assert grades == {"6"}
    data = of_kind["cylindrical_stage_gear_data"]
    safeties = [float(attributes[c]["safety_factor_pitting_iso_6336_2006"]) for c in data]
    assert tuple(safeties) == made.safety_pitting
    (stage,) = of_kind["cylindrical_stage"]
    assert float(attributes[stage]["dynamic_factor_iso_6336_2006"]) == made.raw("dynamic_factor")


def test_rexs_omits_the_rounding_of_a_sharp_tool() -> None:
    """The range of `tip_radius_factor` in the data model is open at 0: a strict reader refuses the whole file."""
    components, attributes = _model(as_rexs(design({**PAIR, "tool": {"addendum": 1.25, "rounding": 0.0}})))
    tools = [attributes[c] for c, element in components.items() if element.attrib["type"] == "rack_shaped_tool"]
    assert len(tools) == 2
    assert not any("tip_radius_factor" in tool for tool in tools)


def _of(made: Any, kind: str) -> list[dict[str, str]]:
    components, attributes = _model(as_rexs(made))
    return [attributes[c] for c, element in components.items() if element.attrib["type"] == kind]


def test_rexs_omits_what_lies_outside_of_the_ranges_of_the_data_model() -> None:
    """Tip clearance is above 0 there and a load factor at least 1: a strict reader refuses the whole file."""
    touching = design({**PAIR, "teeth": [59, 57], "profile_shift": [0.681, -0.264], "tip_shortening": "none",
                       "addendum": 1.2, "clearance": 0.0})  # fmt: skip
    assert min(touching.raw("tip_clearance")) < 0.0
    assert not any("tip_clearance" in data for data in _of(touching, "cylindrical_stage_gear_data"))
    rated = design("rated_pair", command="gear", load__factors__dynamic=0.9)
    (stage,) = _of(rated, "cylindrical_stage")
    assert "dynamic_factor_iso_6336_2006" not in stage
    assert stage["application_factor_iso_6336_2006"] == "1.25"


def test_rexs_names_the_edition_of_the_rating() -> None:
    (stage,) = _of(design("rated_pair", command="gear", edition=2019), "cylindrical_stage")
    assert {name for name in stage if "6336" in name} == {name for name in UNITS["cylindrical_stage"] if "2019" in name}


def test_rexs_has_the_limits_of_the_teeth_and_their_backlash() -> None:
    """Without them another program takes the nominal thickness and no backlash."""
    made = design("rated_pair", command="gear")
    (stage,), gears = _of(made, "cylindrical_stage"), _of(made, "cylindrical_gear")
    assert (float(stage["minimum_normal_backlash"]), float(stage["maximum_normal_backlash"])) == made.raw(
        "backlash_normal"
    )
    for i, gear in enumerate(gears):
        for size, name, unit in (
            ("span_measurement", "referenced_to_span", 1e-3),
            ("size_over_balls", "balls_or_pins", 1.0),
        ):
            nominal = float(gear[size])
            limits = [nominal + unit * float(gear[f"{end}_backlash_allowance_{name}"]) for end in ("lower", "upper")]
            known = made.raw("span_measurement_limits" if unit < 1.0 else "measure_limits")[i]
            assert limits == pytest.approx(known, rel=1e-14)
        assert float(gear["diameter_of_measuring_ball_or_pin"]) == made.raw("pin_diameter")[i]


def test_rexs_has_the_grade_of_a_pair_without_a_rating() -> None:
    gears = _of(design("gear_pair", command="gear", accuracy_grade=7), "cylindrical_gear")
    assert [gear["tolerance_class_according_to_iso_1328_2013"] for gear in gears] == ["7", "7"]


def test_rexs_has_the_cutter_of_a_ring_and_the_protuberance_of_a_hob() -> None:
    made = design("ring_pair", command="gear", tool=[{"rounding": 0.25, "residual_undercut": 0.02}, None])
    assert _of(made, "cutter_wheel_tool") == [
        {"number_of_teeth": "25", "normal_module": "2.0", "normal_pressure_angle": "20.0",
         "addendum_modification_coefficient": "0.1", "addendum_coefficient_reference_profile": "1.25",
         "tip_radius_factor": "0.25"}
    ]  # fmt: skip
    left = [flank.get("remaining_protuberance") for flank in _of(made, "cylindrical_gear_flank")]
    assert left == ["0.04", "0.04", None, None]


def test_an_idler_is_one_gear_of_two_stages(designs: Path) -> None:
    made = design({"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40},
                   "links": {"crank": 38, "frame": 153}})  # fmt: skip
    components, _ = _model(as_rexs(made))
    kinds = [c.attrib["type"] for c in components.values()]
    assert (kinds.count("cylindrical_gear"), kinds.count("cylindrical_stage")) == (3, 2)


def _spline(name: str, given: Any, tolerance: float = 0.001) -> Contour:
    return contour(parts.makers(given)[name](), tolerance, CurveForm.SPLINE)


PAIR = {"kind": "gear-pair", "module": 4, "teeth": [13, 20], "profile_shift": [0.3, 0.0]}
RING = {
    "kind": "two-gear-four-bar",
    "gears": {"module": 2, "planet": 48, "ring": 62},
    "links": {"coupler": 30, "rocker": 50, "frame": 45},
}


def test_section_area_is_that_of_a_fine_polygon() -> None:
    made = _spline("gear1", design(PAIR))
    area = 0.0
    for piece in made.pieces:
        at = np.linspace(piece.knots[0], piece.knots[-1], 4001)
        x, y = BSpline(piece.knots, np.column_stack([piece.control[0].real, piece.control[0].imag]), 3)(at).T
        area += 0.5 * 13 * float((x[:-1] * y[1:] - x[1:] * y[:-1]).sum())
    assert section_area(made) == pytest.approx(area, rel=1e-7)


def test_a_ring_lies_between_its_teeth_and_its_rim(designs: Path) -> None:
    made = design(worked("two_gear_ring"))
    ring = _spline("gear5", made)
    mesh = made.mesh
    middle = math.pi * (ring.part.rim**2 - mesh.reference_radius[1] ** 2)
    teeth = math.pi * (mesh.reference_radius[1] ** 2 - mesh.tip_radius[1] ** 2)
    assert middle - teeth < section_area(ring) < middle + teeth
    nodes = np.abs(ring.lines[0].nodes)
    assert nodes.min() == pytest.approx(-mesh.tip_radius[1], rel=1e-12)
    assert nodes.max() == pytest.approx(-mesh.root_radius[1], rel=1e-12)
    # On the reference circle tooth and space are equally wide.
    half = math.pi / (2 * -mesh.teeth[1])
    flank = next(s for s in ring.part.stretches if s.name == "involute")
    at = math.sqrt((mesh.reference_radius[1] / mesh.base_radius[1]) ** 2 - 1.0)
    assert np.angle(flank.points(np.array([-at]))[0, 0]) == pytest.approx(half, rel=1e-12)


def test_step_is_refused_without_its_library(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    command = ["export", designs / "ty460_input_gears.yaml", "--as", "step", "--width", 20, "--out", tmp_path / "out"]
    monkeypatch.setitem(sys.modules, "OCP", None)
    ended = gearlink(*command)
    assert ended.status == 2
    assert "pip install cadquery-ocp" in ended.err
    monkeypatch.delitem(sys.modules, "OCP")
    (tmp_path / "OCP.py").write_text("raise ImportError('libGL.so.1: cannot open shared object file')")
    monkeypatch.syspath_prepend(tmp_path)
    ended = gearlink(*command)
    assert ended.status == 2
    assert "is installed, but a library that it needs is not: libGL.so.1" in " ".join(ended.err.split())
    assert "apt-get install libgl1" in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        ("kind: gear-pair\nmodule: 2\nteeth: [20, 30]\nprofile_shift: [0, 0]\n", (), "--width MM"),
        ("wide_swing_twin_cam", ("--part", "main_cam", "--width", 20), "is open"),
    ],
)
def test_what_is_no_solid_is_refused(
    gearlink: Any, designs: Path, tmp_path: Path, text: str, options: tuple[Any, ...], words: str
) -> None:
    path = tmp_path / "design.yaml"
    path.write_text((designs / f"{text}.yaml").read_text() if text.startswith("wide") else text)
    ended = gearlink("export", path, "--as", "step", *options, "--out", tmp_path / "out")
    assert ended.status == 2
    assert words in ended.err


@pytest.mark.parametrize(
    ("given", "name"), [(PAIR, "gear1"), ("two_gear_ring", "gear5"), ("ty460", "main_cam"), ("rack_drive", "rack")]
)
def test_a_solid_that_is_read_again_has_the_volume_of_its_section(given: Any, name: str, tmp_path: Path) -> None:
    pytest.importorskip("OCP", reason=NO_STEP)
    made = design(worked(given) if isinstance(given, str) else given)
    section = _spline(name, made)
    shape = _read_again(section, made.spec, 12.5, tmp_path)
    holes = [made.spec.cam.shaft_radius] if name == "main_cam" and made.spec.cam.shaft_radius else []
    assert _volume(shape) == pytest.approx(12.5 * section_area(section, holes), rel=1e-6)


NO_STEP = "STEP needs the extra `step` (cadquery-ocp), which is not installed"
RACK = {"kind": "gear-pair", "module": 3, "teeth": [21, "rack"], "profile_shift": [0.2, 0], "helix_angle": 15}


def _read_again(section: Contour, spec: Any, width: float, folder: Path) -> Any:
    """The valid solid that a STEP file holds."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.STEPControl import STEPControl_Reader

    path = folder / "part.step"
    path.write_bytes(step.as_step(section, spec, width))
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape = reader.OneShape()
    assert "SOLID" in str(shape.ShapeType())
    assert BRepCheck_Analyzer(shape).IsValid()
    return shape


def _volume(shape: Any, found: Any = None) -> float:
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    found = found or GProp_GProps()
    (getattr(BRepGProp, "VolumeProperties_s", None) or BRepGProp.VolumeProperties)(shape, found)
    return float(found.Mass())


def _cut(shape: Any, share: float) -> Any:
    """Points of the flanks at a share of their width, with their heights; twenty on each face that is a spline's."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    faces, points = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE), []
    while faces.More():
        surface = BRepAdaptor_Surface((getattr(TopoDS, "Face_s", None) or TopoDS.Face)(faces.Current()))
        faces.Next()
        if surface.GetType() != GeomAbs_SurfaceType.GeomAbs_BSplineSurface:
            continue
        low, high = surface.FirstVParameter(), surface.LastVParameter()
        for at in np.linspace(surface.FirstUParameter(), surface.LastUParameter(), 20):
            point = surface.Value(float(at), low + share * (high - low))
            points.append((complex(point.X(), point.Y()), point.Z()))
    return (np.array(each) for each in zip(*points, strict=True))


@pytest.mark.parametrize(("hand", "name"), [("right", "gear1"), ("left", "gear1"), ("left", "gear2")])
def test_a_helical_solid_is_its_section_turned_along_the_axis(hand: str, name: str, tmp_path: Path) -> None:
    """The volume, and in mid-face the involutes at their places, by the closed form of their thickness.

    Tolerances: volumes as their program measures them, 1e-6; sections the spline error, and 1e-5 mm of the cut.
    """
    pytest.importorskip("OCP", reason=NO_STEP)
    number, width = ("gear1", "gear2").index(name), 24.0
    teeth = [13, -40] if number else [13, 27]
    hands = [hand, hand if number else "left" if hand == "right" else "right"]
    made = design(PAIR | {"teeth": teeth, "profile_shift": [0.3, 0.1], "helix_angle": 20, "helix_hand": hands})
    section, pair = _spline(name, made, 1e-4), made.gear_pair
    shape = _read_again(section, made.spec, width, tmp_path)
    assert _volume(shape) == pytest.approx(width * section_area(section), rel=1e-6)
    assert step.helix_error(section, width) < 0.01 * section.tolerance
    twist = (1.0 if hand == "right" else -1.0) * math.tan(math.radians(20.0)) / abs(pair.reference_radius[number])
    points, heights = _cut(shape, 0.5)
    assert heights == pytest.approx(0.5 * width, abs=1e-9)
    points *= np.exp(-0.5j * twist * width)
    radius, tip = np.abs(points), abs(pair.tip_radius[number])
    ends = (tip, abs(pair.root_radius[1])) if number else (ToothProfile.of(pair, 0).form_radius, tip)
    flank = (radius > ends[0] + 0.01) & (radius < ends[1] - 0.01)
    assert flank.sum() > 100
    z, base = abs(pair.teeth[number]), abs(pair.base_radius[number])
    inv = np.array([involute(math.acos(base / r)) for r in radius[flank].tolist()])
    more = (-2.0 if number else 2.0) * pair.profile_shift[number] * math.tan(pair.pressure_angle)
    half = (0.5 * math.pi + more) / z + involute(pair.transverse_pressure_angle) - inv  # of a tooth, of a ring a space
    pitch = 2.0 * math.pi / z
    from_space = np.abs(np.angle(points[flank]) - pitch * np.round(np.angle(points[flank]) / pitch))
    off = from_space - (half if number else 0.5 * pitch - half)
    assert np.abs(off * radius[flank]).max() < section.error + 1e-5


RATED = {
    "load": {"torque": 100, "speed": 500},
    "face_width": 20,
    "rating": {"life": 1000, "material": "16MnCr5", "grade": 6, "lubricant": {"vg": 220}, "bore": [20.0, 30.0]},
}
BORED: list[tuple[Any, str, list[float]]] = [
    ("lift_cam", "main_cam", [20.0]),
    ("swing_gripper", "return_cam", [40.0]),
    ("arc_cam", "main_cam", [10.0]),
    ("planar_cam", "cam", [15.0]),
    (PAIR | {"module": 5} | RATED, "gear1", [10.0]),
    (PAIR | {"module": 5, "helix_angle": 15} | RATED, "gear2", [15.0]),
    (PAIR | {"teeth": [20, -60]} | RATED | {"rating": RATED["rating"] | {"bore": [25.0, 300.0]}}, "gear2", []),
    ("geneva_drive", "driver", []),
    ("cycloidal_reducer", "disc", []),
]


@pytest.mark.parametrize(("given", "name", "radii"), BORED)
def test_a_part_has_the_holes_that_its_file_names(given: Any, name: str, radii: list[float], tmp_path: Path) -> None:
    """Cylinders through the width and what they take of the volume; of a ring the outside. The shaft of the Geneva
    crank cuts into the cut-out of the disc, and does not go through it."""
    made = design(worked(given) if isinstance(given, str) else given)
    section = _spline(name, made)
    if name == "disc":
        radii = [made.spec.bearing_radius, *[made.output_hole_radius] * made.spec.output_pins.count]
    assert [each.radius for each in section.holes] == pytest.approx(radii, rel=1e-12)
    if name == "gear2" and not radii:
        assert section.part.rim == 150.0
    if find_spec("OCP") is not None:
        shape = _read_again(section, made.spec, 12.5, tmp_path)
        whole = _read_again(replace(section, part=replace(section.part, circles=())), made.spec, 12.5, tmp_path)
        bored = 12.5 * math.pi * math.fsum(radius**2 for radius in radii)
        assert _volume(whole) - _volume(shape) == pytest.approx(bored, abs=1e-6 * _volume(whole))
        outside = [section.part.rim] if section.part.rim else []
        assert _cylinders(shape) == pytest.approx(sorted([*radii, *outside]), rel=1e-9)


@pytest.mark.parametrize("left_out", [("shaft_radius",), ("shaft_radius", "hub_radius"), ("hub_radius",)])
def test_a_geneva_drive_needs_neither_shaft_nor_hub(left_out: tuple[str, ...]) -> None:
    made = design({key: value for key, value in worked("geneva_drive").items() if key not in left_out})
    driver, wheel = (_spline(name, made).part for name in ("driver", "wheel"))
    assert ("shaft" in " ".join(driver.notes)) == ("shaft_radius" not in left_out)
    assert any(each.layer == "HUB" for each in wheel.circles) == ("hub_radius" not in left_out)


def _cylinders(shape: Any) -> list[float]:
    """Radii of the cylindrical faces; lines of a profile that are arcs are splines."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    faces, found = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE), []
    while faces.More():
        surface = BRepAdaptor_Surface((getattr(TopoDS, "Face_s", None) or TopoDS.Face)(faces.Current()))
        faces.Next()
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            found.append(float(surface.Cylinder().Radius()))
    return sorted(found)


def test_a_helical_rack_is_a_slanted_prism(tmp_path: Path) -> None:
    pytest.importorskip("OCP", reason=NO_STEP)
    from OCP.GProp import GProp_GProps

    made = design(RACK | {"rack_teeth": 5})
    section = _spline("rack", made, 1e-4)
    shape, straight = (_read_again(each, made.spec, 30.0, tmp_path) for each in (section, _upright(section)))
    assert _volume(shape) == pytest.approx(30.0 * section_area(section), rel=1e-7)
    centers = []
    for solid in (shape, straight):
        found = GProp_GProps()
        _volume(solid, found)
        centers.append(found.CentreOfMass())
    lean = 15.0 * math.tan(math.radians(15.0))
    assert centers[0].X() - centers[1].X() == pytest.approx(lean, abs=1e-5)
    assert centers[0].Y() == pytest.approx(centers[1].Y(), abs=1e-5)


def _upright(section: Contour) -> Contour:
    return replace(section, part=replace(section.part, slant=0.0))


def test_helical_teeth_have_their_hands() -> None:
    """Mates lean the same way where they touch: the gear above its rack, the pinion in its ring."""
    slope = math.tan(math.radians(15.0))
    made = parts.makers(design(RACK | {"helix_hand": ["left", "right"]}))
    gear, rack = made["gear1"](), made["rack"]()
    assert (gear.twist * 31.5 / math.cos(math.radians(15.0)), rack.slant) == pytest.approx((-slope, -slope), rel=1e-12)
    assert any("15 deg left-hand" in note for note in gear.notes)
    ring = design({"kind": "gear-pair", "module": 3, "teeth": [21, -67], "profile_shift": [0, 0], "helix_angle": 15})
    pinion, mate = (parts.makers(ring)[name]() for name in ("gear1", "gear2"))
    assert (21 * pinion.twist, 67 * mate.twist) == pytest.approx(
        (42 * slope / 63 * math.cos(math.radians(15.0)),) * 2, rel=1e-12
    )
    train = design({"kind": "three-gear-four-bar", "links": {"crank": 38, "frame": 158},
                    "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40, "helix_angle": 10}})  # fmt: skip
    turns = [parts.makers(train)[name]().twist for name in ("gear1", "gear3", "gear5")]
    assert [math.copysign(1.0, turn) for turn in turns] == [1.0, -1.0, 1.0]


def test_a_gear_that_turns_for_ever_is_refused(gearlink: Any, tmp_path: Path) -> None:
    pytest.importorskip("OCP", reason=NO_STEP)
    path = tmp_path / "h.yaml"
    path.write_text(HELICAL)
    ended = gearlink("export", path, "--as", "step", "--width", 1e5, "--out", tmp_path / "out")
    assert ended.status == 2
    assert "smaller --width" in ended.err
    assert not (tmp_path / "out").exists()


def test_dxf_has_extents_and_circles_of_tip_and_root(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    assert gearlink("export", designs / "two_gear_ring.yaml", "--out", tmp_path).status == 0
    drawn = ezdxf.readfile(tmp_path / "two-gear-ring-gear5.dxf")
    circles = {c.dxf.layer: c.dxf.radius for c in drawn.modelspace().query("CIRCLE")}
    assert {"TIP_CIRCLE", "ROOT_CIRCLE", "RIM", "REFERENCE_CIRCLE", "BASE_CIRCLE"} <= set(circles)
    for corner, sign in (("$EXTMIN", -1.0), ("$EXTMAX", 1.0)):
        assert drawn.header[corner][:2] == pytest.approx((sign * circles["RIM"],) * 2, rel=1e-12)


@pytest.mark.parametrize("tolerance", [0.001, pytest.param(1.0, marks=pytest.mark.slow)])
def test_what_is_drawn_lies_within_extents_and_frame_of_a_spline(
    gearlink: Any, designs: Path, tmp_path: Path, tolerance: float
) -> None:
    """Between its nodes a spline reaches farther than at them: here the curve itself, at 64 places of each span."""
    ezdxf = pytest.importorskip("ezdxf")
    asked = ("--as", "dxf", "--as", "svg", "--curve", "spline", "--part", "main_cam", "--tolerance", tolerance)
    assert gearlink("export", designs / "lift_cam.yaml", *asked, "--out", tmp_path).status == 0
    drawn = ezdxf.readfile(tmp_path / "lift-cam-main_cam.dxf")
    places = []
    for spline in drawn.modelspace().query("SPLINE"):
        knots = np.unique(spline.knots)
        at = np.interp(np.linspace(0.0, knots.size - 1.0, 64 * (knots.size - 1) + 1), np.arange(knots.size), knots)
        places.append(BSpline(spline.knots, np.array(spline.control_points)[:, :2], 3)(at))
    low, high = (side(np.concatenate(places), axis=0) for side in (np.min, np.max))
    # a span bends by less than a radian, so that a place between two of 64 is off by 1/8 (1/64)^2 of its length at most
    assert drawn.header["$EXTMIN"][:2] == pytest.approx(low, abs=1e-3)
    assert drawn.header["$EXTMAX"][:2] == pytest.approx(high, abs=1e-3)
    assert (drawn.header["$EXTMIN"][:2] <= low + 1e-9).all()
    assert (drawn.header["$EXTMAX"][:2] >= high - 1e-9).all()
    left, top, width, height = map(
        float, ET.parse(tmp_path / "lift-cam-main_cam.svg").getroot().attrib["viewBox"].split()
    )
    assert left + 2.0 <= low[0]
    assert left + width - 2.0 >= high[0]
    assert -top - height + 2.0 <= low[1]
    assert -top - 2.0 >= high[1]


def test_pins_of_a_reducer_are_no_solid_and_have_their_places_in_a_table(
    gearlink: Any, designs: Path, tmp_path: Path
) -> None:
    file = designs / "cycloidal_reducer.yaml"
    refused = gearlink("export", file, "--part", "ring", "--as", "step", "--width", 12, "--out", tmp_path)
    assert refused.status == 2
    assert "a circle of pins is not a solid" in refused.err
    made = [
        contour(make(), 0.1, CurveForm.SPLINE) for make in parts.makers(design(worked("cycloidal_reducer"))).values()
    ]
    asked = Export((FileFormat.STEP,), (), 0.1, CurveForm.SPLINE, Options())
    solids = _drawn(FileFormat.STEP, {CurveForm.SPLINE: made}, asked)
    assert [each.part.name for each in solids] == ["disc"]
    assert gearlink("export", file, "--part", "ring", "--as", "csv", "--out", tmp_path).status == 0
    text = (tmp_path / "cycloidal-reducer-ring.csv").read_text(encoding="utf-8").splitlines()
    head, *rows = [line.split(",") for line in text if not line.startswith("#")]
    assert head == ["x [mm]", "y [mm]", "angle [deg]"]
    places = {round(float(row[2]), 9): complex(float(row[0]), float(row[1])) for row in rows}
    for k in range(12):
        turn = math.radians(30.0 * k)
        assert places[30.0 * k] == pytest.approx(60.0 * complex(math.cos(turn), math.sin(turn)), abs=1e-12)


@pytest.mark.parametrize("name", ["lift_cam", "arc_cam"])
def test_the_path_of_a_cutter_is_no_solid(name: str) -> None:
    """Beside the solid of a cam it had been written as if it were another, larger cam."""
    given = design({**worked(name), "cam": {**worked(name)["cam"], "cutter_radius": 10}})
    made = [contour(make(), 0.1, CurveForm.SPLINE) for make in parts.makers(given).values()]
    assert [each.part.name for each in made] == ["main_cam", "cutter"]
    asked = Export((FileFormat.STEP,), (), 0.1, CurveForm.SPLINE, Options())
    assert [each.part.name for each in _drawn(FileFormat.STEP, {CurveForm.SPLINE: made}, asked)] == ["main_cam"]
    with pytest.raises(GearlinkError, match="a path is not a solid"):
        _drawn(FileFormat.STEP, {CurveForm.SPLINE: made[1:]}, asked)


def test_every_kind_with_gears_has_parts(designs: Path) -> None:
    wanted = {
        "hypocycloid_slider": ["planet", "ring"],
        "five_bar_path": ["input_gear", "output_gear", "PATH-M"],
        "five_bar_positions": ["planet_gear", "sun_gear"],
        "mutilated_gear_press": ["wheel", "gear2"],
        "geared_six_bar": ["gear1A", "gear1B", "gear2B", "gear2C"],
        "two_gear_ring": ["gear2", "gear5"],
    }
    for name, names in wanted.items():
        assert list(parts.makers(design(worked(name)))) == names


def test_rexs_bears_no_false_date(monkeypatch: pytest.MonkeyPatch) -> None:
    """The schema requires a date: the day of the export, which makes the file the same all day, or the one given."""
    made = design("gear_pair", command="gear")
    monkeypatch.delenv("SOURCE_DATE_EPOCH", raising=False)
    before = datetime.now(UTC).date()
    first, after = ET.fromstring(as_rexs(made)).get("date"), datetime.now(UTC).date()
    assert first in {f"{day.isoformat()}T00:00:00+00:00" for day in (before, after)}
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert ET.fromstring(as_rexs(made)).get("date") == "2023-11-14T22:13:20+00:00"
