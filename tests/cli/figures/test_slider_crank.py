"""Figures of a slider-crank: links of true length, travel and velocity as the kernel has them.

Tolerances
* lengths of drawn links and travel: 1e-12 of the rod, a handful of operations.
"""

import numpy as np
import pytest

from gearlink.cli.figures.slider_crank import dead_centers, pin_and_slider
from gearlink.cli.figures.write import draw, write_plot
from gearlink.cli.options import Options
from gearlink.core.linkages.slider_crank_design import SliderCrankDesign
from gearlink.core.linkages.slider_crank_spec import SliderCrankSpec


def design(stroke=310.0, rod=520.0, offset=50.0):
    return SliderCrankDesign(SliderCrankSpec(kind="slider-crank", name="sc", stroke=stroke, rod=rod, offset=offset))


def line(figure, gid):
    (found,) = [line for axes in figure.axes for line in axes.lines if line.get_gid() == gid]
    return np.asarray(found.get_xdata()), np.asarray(found.get_ydata())


CASES = [
    (310.0, 520.0, 50.0),
    (300.0, 200.0, -60.0),
    (1e-6, 5e-6, 0.0),
    (1e6, 4e6, 2e5),
    (988.7, 520.0, 50.0),
    (1.0, 5000.0, 0.0),
    (10.0, 520.0, 515.0),
]


@pytest.mark.parametrize("case", CASES)
def test_curves(case):
    made = design(*case)
    stroke, rod, _ = case
    figure = draw("crank", made)
    degrees, travel = line(figure, "travel")
    assert travel.min() == pytest.approx(0.0, abs=1e-9 * rod)
    assert travel.max() == pytest.approx(stroke, abs=1e-9 * rod)
    ratio = made.slider_crank.quick_return_ratio
    top = degrees[np.argmax(travel)]
    assert top / (360.0 - top) == pytest.approx(ratio, rel=1e-2)
    _, velocity = line(figure, "velocity")
    slope = np.gradient(travel, np.radians(degrees))
    if stroke < 0.9 * made.slider_crank.max_stroke:
        assert np.abs(slope - velocity)[2:-2].max() < 2e-3 * np.abs(velocity).max()


@pytest.mark.parametrize("case", CASES)
def test_positions_have_the_lengths_of_the_links(case):
    made = design(*case)
    stroke, rod, offset = case
    near, far = (pin_and_slider(made, psi) for psi in dead_centers(made))
    for pin, block in (near, far):
        assert abs(pin) == pytest.approx(made.slider_crank.crank_length, rel=1e-12)
        assert abs(block - pin) == pytest.approx(rod, rel=1e-12)
        assert block.imag == -offset
    assert far[1].real - near[1].real == pytest.approx(stroke, abs=1e-9 * rod)


def test_drawing_names_its_dimensions():
    figure = draw("analyze", design())
    shown = [text.get_text() for text in figure.axes[0].texts]
    assert {"D", "E", "F", "stroke 310 mm", "offset\n50 mm"} <= set(shown)
    central = [text.get_text() for text in draw("crank", design(offset=0.0)).axes[0].texts]
    assert not [text for text in central if "offset" in text]


@pytest.mark.parametrize("case", CASES[1:4])
def test_odd_designs_draw(case, tmp_path):
    path = write_plot("crank", design(*case), Options(out=tmp_path))
    assert [path] == list(tmp_path.iterdir())
    assert path.read_bytes().startswith(b"\x89PNG")


def test_a_folder_that_is_a_file_is_refused_and_stays(tmp_path):
    from gearlink.cli.files import CannotWrite

    (tmp_path / "out").write_text("kept")
    with pytest.raises(CannotWrite):
        write_plot("crank", design(), Options(out=tmp_path / "out"))
    assert [path.name for path in tmp_path.iterdir()] == ["out"]
    assert (tmp_path / "out").read_text() == "kept"
