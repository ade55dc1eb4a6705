"""Cams true to size: the page and the paths of the PDF itself, in points of 1/72 inch.

Tolerances: matplotlib writes coordinates to 1e-6 of a point.
"""

from __future__ import annotations

import re
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design, worked

from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.views.figures.sheets.true_size import PAPERS, Scale, drawing, next_scale, polygons

MM = 72.0 / 25.4


def read(figure: Any, path: Path) -> tuple[np.ndarray, list[np.ndarray]]:
    """Size of the page, and each line of it [points]."""
    figure.savefig(path, format="pdf")
    data = path.read_bytes()
    box = np.array([float(x) for x in re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", data)[0]])
    lines: list[np.ndarray] = []
    for found in re.finditer(rb"stream\n(.*?)endstream", data, re.S):
        try:
            text = zlib.decompress(found.group(1))
        except zlib.error:
            continue
        for part in re.split(rb"(?<=\n)(?=[-\d.]+ [-\d.]+ m\n)", text):
            points = re.findall(rb"^([-\d.]+) ([-\d.]+) [ml]$", part, re.M)
            if len(points) > 1:
                lines.append(np.array([complex(float(x), float(y)) for x, y in points]))
    return box, lines


@pytest.mark.quick(1)
@pytest.mark.parametrize("reduction", [1.0, 2.0])
def test_cam_and_bar_have_their_size_on_paper(tmp_path: Path, reduction: float) -> None:
    made = design(worked("ty460"))
    box, lines = read(drawing(made, 0, Scale(reduction)), tmp_path / "cam.pdf")
    longest = max(lines, key=len)
    assert np.ptp(np.abs(longest - np.mean(longest))) > 0.0
    theta = np.linspace(0.0, 2.0 * np.pi, longest.size)
    _, profile = made.main_cam.points(theta)
    way = longest[0] - profile[0] * MM / reduction
    assert np.abs(longest - way - profile * MM / reduction).max() < 1e-4
    assert any(abs(abs(line[-1] - line[0]) - 100.0 * MM) < 1e-4 and line.size == 2 for line in lines)
    pitch = made.main_cam.points(theta)[0].real
    reach = made.max_radius + 5.0 * reduction
    wide = (max(pitch.max(), reach) - min(pitch.min(), -reach)) / reduction
    assert box[0] == pytest.approx((max(wide, 100.0) + 20.0) * MM, abs=1e-3)


def test_paper_that_is_too_small_names_one_that_is_not(tmp_path: Path) -> None:
    made = design(worked("ty460"))
    box, _ = read(drawing(made, 0, Scale(1.0, "A3")), tmp_path / "cam.pdf")
    assert sorted(box / MM) == pytest.approx(PAPERS["A3"], abs=1e-3)
    with pytest.raises(DesignFileError, match="A4"):
        drawing(made, 0, Scale(0.8, "A4"))
    with pytest.raises(DesignFileError) as refused:
        drawing(made, 0, Scale(0.8, "A4"))
    assert "use A3" in refused.value.diagnostics[0].message
    with pytest.raises(DesignFileError) as refused:
        drawing(made, 0, Scale(0.1, "A0"))
    assert "not even A0" in refused.value.diagnostics[0].message


def test_polygons_are_true_to_their_scale(tmp_path: Path) -> None:
    made = design("ty460_gears", command="press")
    figure = polygons(made)
    scale = float(re.findall(r"= ([\d.]+) mm/s", str(figure.get_suptitle()))[0])
    box, lines = read(figure, tmp_path / "polygons.pdf")
    assert box / MM == pytest.approx([210.0, 297.0], abs=1e-3)
    bars = [line for line in lines if line.size == 2 and abs(abs(line[1] - line[0]) - 10.0 * MM) < 1e-3]
    assert len(bars) == 12
    assert next_scale(scale * 1.01) > scale
