"""The mutilated wheel in files: closed, its groups and gaps where they belong, the same as on the sheet."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.cli.export import parts
from gearlink.cli.export.contour import contour
from gearlink.cli.export.options import CurveForm
from gearlink.cli.views.figures.mutilated_gear_dwell import mesh_scene
from gearlink.core.machines.dwell_gears.wheel import free_radius


def outline(made: Any, form: CurveForm = CurveForm.POLYLINE) -> Any:
    (line,) = contour(parts.makers(made)["wheel"](), 1e-3, form).lines
    assert line.closed
    return line.nodes


@pytest.mark.quick(1)
@pytest.mark.parametrize(("full", "group", "driven", "groups", "stops"), [
    (80, 20, 20, 1, 1), (80, 10, 20, 2, 2), (60, 15, 15, 2, 1), (48, 1, 16, 1, 16),
])  # fmt: skip
def test_the_outline_is_closed_and_has_its_teeth(full: int, group: int, driven: int, groups: int, stops: int) -> None:
    teeth = {"module": 3, "full_teeth": full, "group_teeth": group, "driven": driven, "groups": groups, "stops": stops}
    made = design("mutilated_gear_press", gears=teeth)
    points = outline(made)
    assert points[0] == points[-1]
    radius, mesh = np.abs(points), made.mesh
    cut = max(mesh.root_radius[0], free_radius(mesh))
    inner = max(0, group - 2) * groups
    high = radius > cut + 1e-9
    assert int((np.diff(high.astype(int)) == 1).sum()) == inner  # teeth that stand out above the cut ones
    assert radius.max() == pytest.approx(mesh.tip_radius[0] if inner else cut, abs=1e-9)
    assert radius.min() == pytest.approx(mesh.root_radius[0], abs=1e-9)
    gap = 2.0 * math.pi / groups - group * 2.0 * math.pi / full
    middle = points[np.abs(np.angle(points)) < 0.49 * gap]
    assert np.abs(np.abs(middle) - mesh.root_radius[0]).max() < 1e-9
    turned = np.angle(points[1:] / points[:-1]).sum()
    assert turned == pytest.approx(2.0 * math.pi, abs=1e-9)


def test_the_file_is_what_the_sheet_shows() -> None:
    made = design("mutilated_gear_press")
    points = outline(made)
    body = next(each for each in mesh_scene(made).parts if getattr(each, "label", "") == "1")
    area = 0.5 * abs((points[:-1].conj() * points[1:]).imag.sum())
    shown = body.outline
    assert area == pytest.approx(0.5 * abs((shown[:-1].conj() * shown[1:]).imag.sum()), rel=1e-3)


def test_splines_and_a_wheel_that_passes_its_driven_gear() -> None:
    made = design("mutilated_gear_press")
    assert outline(made, CurveForm.SPLINE).size > 100
    assert free_radius(made.mesh) < made.mesh.tip_radius[0]


@pytest.mark.parametrize("form", ["dxf", "svg", "csv"])
def test_groups_that_fill_the_wheel_are_refused(form: str, gearlink: Any, designs: Path, tmp_path: Path) -> None:
    """As its analysis refuses them: teeth upon teeth are no outline."""
    spec = designs / "mutilated_gear_press.yaml"
    ended = gearlink("export", spec, "--as", form, "--out", tmp_path, "--set", "gears.groups=10")
    assert (ended.status, "fill the wheel" in ended.err) == (2, True)
    assert not list(tmp_path.iterdir())
