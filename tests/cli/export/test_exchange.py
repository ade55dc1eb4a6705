"""REXS and STEP: components that the data model knows, solids of the right volume, refusals that help."""

from __future__ import annotations

import math
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design
from scipy.interpolate import BSpline

from gearlink.cli.export import parts, step
from gearlink.cli.export.contour import Contour, contour
from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.rexs import as_rexs

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
    },
    "cylindrical_gear_flank": {
        "normal_pressure_angle": "deg",
        "pressure_angle_in_the_transverse_section": "deg",
        "addendum_modification_coefficient": "none",
        "addendum_modification": "mm",
        "addendum_coefficient_basic_profile": "none",
    },
    "rack_shaped_tool": {
        "normal_module": "mm",
        "normal_pressure_angle": "deg",
        "addendum_coefficient_reference_profile": "none",
        "tip_radius_factor": "none",
    },
    "cylindrical_stage_gear_data": {
        "pitch_diameter": "mm",
        "operating_pressure_angle_in_the_transverse_section": "deg",
        "tip_clearance": "mm",
    },
}
UNITS["ring_gear"] = UNITS["cylindrical_gear"]
"""Attributes and units of the REXS 1.7 data model (schema of 2024-12-12), as far as gears use them."""
ROLES = {
    "assembly": {"assembly", "part"},
    "stage": {"stage", "gear_1", "gear_2"},
    "flank": {"gear", "left", "right"},
    "stage_gear_data": {"stage", "gear", "stage_gear_data"},
    "manufacturing_step": {"workpiece", "tool", "manufacturing_settings"},
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
    assert ended.status == 0
    (file,) = (tmp_path / "out").iterdir()
    assert file.suffix == ".rexs"
    components, values = _model(file.read_bytes())
    (pinion,) = (values[i] for i, c in components.items() if c.attrib["type"] == "cylindrical_gear")
    (ring,) = (values[i] for i, c in components.items() if c.attrib["type"] == "ring_gear")
    (stage,) = (values[i] for i, c in components.items() if c.attrib["type"] == "cylindrical_stage")
    assert (pinion["number_of_teeth"], ring["number_of_teeth"]) == ("21", "67")
    assert float(ring["helix_angle_reference_diameter"]) == pytest.approx(15.0)  # the hand of its pinion
    transverse = 3.0 / math.cos(math.radians(15.0))
    assert float(ring["reference_circle_diameter"]) == pytest.approx(67 * transverse, rel=1e-14)
    assert float(stage["gear_ratio"]) == pytest.approx(67 / 21)
    assert float(stage["common_face_width"]) == 38.0
    shifts = [v["addendum_modification_coefficient"] for v in values.values() if "addendum_modification" in v]
    assert shifts == ["0.3", "0.3", "-0.1", "-0.1"]
    assert sum(c.attrib["type"] == "rack_shaped_tool" for c in components.values()) == 1  # a rack cuts no ring


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
    assert step.section_area(made) == pytest.approx(area, rel=1e-7)


def test_a_ring_lies_between_its_teeth_and_its_rim(designs: Path) -> None:
    from factory import worked

    made = design(worked("two_gear_ring"))
    ring = _spline("gear5", made)
    mesh = made.mesh
    middle = math.pi * (ring.part.rim**2 - mesh.reference_radius[1] ** 2)
    teeth = math.pi * (mesh.reference_radius[1] ** 2 - mesh.tip_radius[1] ** 2)
    assert middle - teeth < step.section_area(ring) < middle + teeth
    nodes = np.abs(ring.lines[0].nodes)
    assert nodes.min() == pytest.approx(mesh.tip_radius[1], rel=1e-12)
    assert nodes.max() == pytest.approx(mesh.root_radius[1], rel=1e-12)
    # On the reference circle tooth and space are equally wide.
    half = math.pi / (2 * mesh.teeth[1])
    flank = next(s for s in ring.part.stretches if s.name == "involute")
    at = math.sqrt((mesh.reference_radius[1] / mesh.base_radius[1]) ** 2 - 1.0)
    assert np.angle(flank.points(np.array([-at]))[0, 0]) == pytest.approx(half, rel=1e-12)


def test_step_is_refused_without_its_library(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "OCP", None)
    ended = gearlink(
        "export", designs / "ty460_input_gears.yaml", "--as", "step", "--width", 20, "--out", tmp_path / "out"
    )
    assert ended.status == 2
    assert "pip install cadquery-ocp" in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("text", "options", "words"),
    [
        ("kind: gear-pair\nmodule: 2\nteeth: [20, 30]\nprofile_shift: [0, 0]\n", (), "--width MM"),
        (HELICAL, (), "is helical"),
        ("wide_swing_twin_cam", ("--part", "main_cam", "--width", 20), "is open"),
    ],
)
def test_what_is_no_prism_is_refused(
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
    reason = "STEP needs the extra `step` (cadquery-ocp), which is not installed"
    pytest.importorskip("OCP", reason=reason)
    from factory import worked
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.STEPControl import STEPControl_Reader

    made = design(worked(given) if isinstance(given, str) else given)
    section = _spline(name, made)
    path = tmp_path / "part.step"
    path.write_bytes(step.as_step(section, made.spec, 12.5))
    reader = STEPControl_Reader()
    reader.ReadFile(str(path))
    reader.TransferRoots()
    shape, found = reader.OneShape(), GProp_GProps()
    assert "SOLID" in str(shape.ShapeType())
    (getattr(BRepGProp, "VolumeProperties_s", None) or BRepGProp.VolumeProperties)(shape, found)
    assert found.Mass() == pytest.approx(12.5 * step.section_area(section), rel=1e-6)


def test_dxf_has_extents_and_circles_of_tip_and_root(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    assert gearlink("export", designs / "two_gear_ring.yaml", "--out", tmp_path).status == 0
    drawn = ezdxf.readfile(tmp_path / "two-gear-ring-gear5.dxf")
    circles = {c.dxf.layer: c.dxf.radius for c in drawn.modelspace().query("CIRCLE")}
    assert {"TIP_CIRCLE", "ROOT_CIRCLE", "RIM", "REFERENCE_CIRCLE", "BASE_CIRCLE"} <= set(circles)
    for corner, sign in (("$EXTMIN", -1.0), ("$EXTMAX", 1.0)):
        assert drawn.header[corner][:2] == pytest.approx((sign * circles["RIM"],) * 2)


def test_every_kind_with_gears_has_parts(designs: Path) -> None:
    from factory import worked

    wanted = {
        "hypocycloid_slider": ["planet", "ring"],
        "five_bar_path": ["input_gear", "output_gear"],
        "five_bar_positions": ["planet_gear", "sun_gear"],
        "mutilated_gear_press": ["wheel", "gear2"],
        "geared_six_bar": ["gear1A", "gear1B", "gear2B", "gear2C"],
        "two_gear_ring": ["gear2", "gear5"],
    }
    for name, names in wanted.items():
        assert list(parts.makers(design(worked(name)))) == names
