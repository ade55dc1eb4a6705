"""Figures of a slider-crank: links of true length, travel and velocity as the kernel has them, one orientation.

Tolerances
* lengths of drawn links and travel: 1e-12 of the rod, a handful of operations.
"""

import numpy as np
import pytest
from factory import design
from sheets import curve, lines, panel, placed_sheet, points, sheet, words
from sweeps import mostly_slow

from gearlink.cli.options import Options
from gearlink.cli.views.figures.slider_crank import build
from gearlink.cli.views.figures.write import write_plot

DATA = {"kind": "slider-crank", "name": "sc", "stroke": 310.0, "rod": 520.0, "offset": 50.0}
CASES = [
    (310.0, 520.0, 50.0),
    (300.0, 200.0, -60.0),
    (1e-6, 5e-6, 0.0),
    (1e6, 4e6, 2e5),
    (988.7, 520.0, 50.0),
    (1.0, 5000.0, 0.0),
    (10.0, 520.0, 515.0),
]


def keys(case):
    return dict(zip(("stroke", "rod", "offset"), case, strict=True))


@pytest.mark.quick(1)
@pytest.mark.parametrize("case", CASES)
def test_curves(case):
    made, figure = sheet(DATA, "crank", **keys(case))
    stroke, rod, _ = case
    degrees, travel = curve(figure, "travel")
    assert travel.min() == pytest.approx(0.0, abs=1e-9 * rod)
    assert travel.max() == pytest.approx(stroke, abs=1e-9 * rod)
    assert degrees[np.argmin(travel)] == pytest.approx(np.degrees(made.dead_center_folded_at) % 360.0, abs=0.5)
    out = (degrees[np.argmax(travel)] - degrees[np.argmin(travel)]) % 360.0
    assert out / (360.0 - out) == pytest.approx(made.slider_crank.quick_return_ratio, rel=1e-2)
    _, velocity = curve(figure, "velocity")
    slope = np.gradient(travel, np.radians(degrees))
    if stroke < 0.9 * made.slider_crank.max_stroke:
        assert np.abs(slope - velocity)[2:-2].max() < 2e-3 * np.abs(velocity).max()


@pytest.mark.quick(1)
@pytest.mark.parametrize("case", CASES)
def test_positions_have_the_lengths_of_the_links(case):
    made, figure = sheet(DATA, "crank", **keys(case))
    stroke, rod, offset = case
    drawn = lines(panel(figure, "Crank"))
    near, far = (
        points(line) for name in ("folded", "stretched") for label, line in drawn.items() if label.startswith(name)
    )
    for pivot, pin, block in (near, far):
        assert pivot == 0.0
        assert abs(pin) == pytest.approx(made.slider_crank.crank_length, rel=1e-12)
        assert abs(block - pin) == pytest.approx(rod, rel=1e-12)
        assert block.real == -offset
    # The slider runs below the crank, and its stroke goes away from it.
    assert near[2].imag - far[2].imag == pytest.approx(stroke, abs=1e-9 * rod)


def test_the_sheet_stands_as_the_film_does():
    made, figure = sheet(DATA, "crank")
    folded = made.dead_center_folded_at
    film = build(made, np.array([folded / (2.0 * np.pi)]))
    (line,) = (line for label, line in lines(panel(figure, "Crank")).items() if label.startswith("folded"))
    assert points(line).tolist() == [complex(mark.point[0]) for mark in film.marks]


def test_drawing_names_its_dimensions():
    shown = words(sheet(DATA, "analyze").figure)
    assert {"D", "E", "F", "stroke 310 mm", "offset 50 mm"} <= set(shown)
    assert not [text for text in words(sheet(DATA, "crank", offset=0.0).figure) if "offset" in text]


@pytest.mark.slow
@pytest.mark.parametrize("command", mostly_slow(["crank", "analyze"], 1))
@pytest.mark.parametrize("case", mostly_slow([[case] for case in CASES], 1))
def test_every_command_draws(case, command):
    placed_sheet(DATA, command, **keys(case[0]))


def test_a_folder_that_is_a_file_is_refused_and_stays(tmp_path):
    from gearlink.cli.files import CannotWrite

    (tmp_path / "out").write_text("kept")
    with pytest.raises(CannotWrite):
        write_plot("crank", design(DATA, command="crank"), Options(out=tmp_path / "out"))
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert (tmp_path / "out").read_text() == "kept"
