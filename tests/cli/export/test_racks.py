"""Racks in files: outline, construction lines, area, and what has no place in a format.

Tolerances: chords within the tolerance of the export, 1e-3 mm; a spline within 1e-5 mm of straight lines and arcs
has the area of its section to 3e-8 (60 arcs of 1.4 mm, a tenth of 1e-5 mm on average).
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from oracles.sections import section_area

from gearlink.cli.export import parts
from gearlink.cli.export.contour import contour
from gearlink.cli.export.options import CurveForm
from gearlink.cli.views.figures.gears import build, zone_size
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry

BENT = worked("rack_drive") | {"helix_angle": 12, "tool": {"addendum": 1.3, "rounding": 0.2}}


def rack_part(given: Any, form: CurveForm = CurveForm.POLYLINE) -> Any:
    return contour(parts.makers(design(given))["rack"](), 1e-3, form)


@pytest.mark.quick(1)
@pytest.mark.parametrize("given", [worked("rack_drive"), BENT], ids=["spur", "helical"])
@pytest.mark.parametrize("form", list(CurveForm))
def test_the_outline_is_closed_and_has_its_teeth_and_lines(given: Any, form: CurveForm) -> None:
    made, beta = rack_part(given, form), math.radians(given.get("helix_angle", 0))
    lines = {line.layer: line for line in made.lines}
    assert list(lines) == ["PROFILE", "DATUM_LINE", "PITCH_LINE"]
    nodes, profile = lines["PROFILE"].nodes, design(given).rack.profile
    assert lines["PROFILE"].closed
    assert nodes[0] == nodes[-1]
    assert np.sum((nodes[:-1].conj() * nodes[1:]).imag) > 0.0, "counter-clockwise, as gears and cams are"
    assert (nodes.imag.max(), nodes.imag.min()) == pytest.approx((3.0, profile.root - 12.0), rel=1e-12)
    assert np.ptp(nodes.real) == pytest.approx(30 * math.pi * 3 / math.cos(beta), rel=1e-12)
    assert np.count_nonzero(np.diff((nodes.imag > 0.0).astype(int)) == 1) == 30
    assert set(lines["DATUM_LINE"].nodes.imag) == {0.0}
    assert lines["PITCH_LINE"].nodes.imag == pytest.approx(0.6, rel=1e-12)


@pytest.mark.slow
def test_the_solid_has_the_area_of_trapezia_less_the_roundings() -> None:
    """Tooth and space are equal on the datum line, so the section is a rectangle to it, but for flank and rounding."""
    made = contour(parts.makers(design("rack_drive"))["rack"](), 1e-5, CurveForm.SPLINE)
    rack = design(worked("rack_drive")).rack
    m, alpha, rho = 3.0, math.radians(20.0), rack.profile.tool.rounding * 3.0
    deep, pitch = 1.25 * m, math.pi * m
    teeth = 30 * (pitch / 2 * m - m * m * math.tan(alpha))
    below = 30 * (pitch / 2 * deep + deep * deep * math.tan(alpha))
    turned = math.pi / 2 - alpha  # each corner is rounded by an arc of this angle
    corner = rho * rho * (math.tan(turned / 2) - turned / 2)
    assert section_area(made) == pytest.approx(teeth + below + 60 * corner + 30 * pitch * 12.0, rel=3e-8)


@pytest.mark.slow
def test_files_of_a_rack_and_what_has_none(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ended = gearlink(
        "export", designs / "rack_drive.yaml", "--as", "svg", "--as", "csv", "--as", "dxf", "--out", tmp_path
    )
    assert ended.status == 0
    assert {path.name for path in tmp_path.glob("*-rack.*")} == {
        f"rack_drive-rack.{form}" for form in ("svg", "csv", "dxf")
    }
    rows = (tmp_path / "rack_drive-rack.csv").read_text().splitlines()
    assert rows[-1].endswith(",body")
    assert not any("datum" in row or "pitch line" in row for row in rows if not row.startswith("#"))
    refused = gearlink("export", designs / "rack_drive.yaml", "--as", "rexs", "--out", tmp_path / "no")
    assert (refused.status, "REXS 1.7 has no rack" in refused.err) == (2, True)
    assert not (tmp_path / "no").exists()


def test_a_rack_too_long_for_a_file_is_refused_at_once(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ended = gearlink("export", designs / "rack_drive.yaml", "--set", "rack_teeth=1001", "--out", tmp_path / "out")
    assert (ended.status, "at most 1000 teeth, not 1001\n" in ended.err and "help: give rack_teeth" in ended.err) == (
        2,
        True,
    )


def test_the_rim_of_a_ring_is_where_the_file_says(designs: Path) -> None:
    made = design("ring_pair", rim_thickness=[None, 7.5])
    root = abs(made.gear_pair.root_radius[1])
    assert parts.makers(made)["gear2"]().rim == pytest.approx(root + 7.5, rel=1e-12)


def test_the_rack_goes_there_and_back_as_the_gear_rolls() -> None:
    made = design("rack_drive")
    fraction = np.linspace(0.0, 1.0, 9)
    rack, gear = build(made, fraction).parts[:2]
    assert rack.place[0] == pytest.approx(rack.place[-1], rel=1e-12)
    travel = (rack.place - rack.place[0]).imag
    assert travel.max() > 5 * math.pi * 3.0
    assert (gear.turn - gear.turn[0]) * 31.5 == pytest.approx(travel, abs=1e-9)


def test_page_film_and_tables_of_a_rack(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    path = designs / "rack_drive.yaml"
    found = gearlink("gear", path, "--table", "path", "--table", "drawing", "--format", "json")
    assert found.status == 0
    table = json.loads(found.out)["tables"]
    assert {"path", "drawing"} <= {each if isinstance(each, str) else each["name"] for each in table}
    contourless = gearlink("gear", path, "--table", "contour")
    assert (contourless.status, "needs two gears, not a rack" in contourless.err) == (2, True)
    geometry = RackGeometry(design("rack_drive").rack)
    assert zone_size(geometry, 3.0)[1] >= abs((geometry.contact_end - geometry.pitch_point).imag)
