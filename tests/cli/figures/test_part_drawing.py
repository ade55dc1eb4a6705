"""Drawings of gears and of wide-swing cams, read back in mm of paper: outlines to scale, tables as the design has them.

The scale of a drawing is a number of ISO 5455, so that lengths are the design's times that number to rounding (1e-9);
an outline differs from its circle by the error of its chords, 0.01 mm of paper, and printed numbers by half a digit.
"""

from __future__ import annotations

import math
import re
from typing import Any, NamedTuple

import numpy as np
import pytest
from factory import design
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.optimize import brentq
from sheets import tagged, words

from gearlink.cli.commands.sheet import sheets_of
from gearlink.cli.evaluate import whole_design
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.sheets import paper, part_drawing
from gearlink.core.base.kinds import KINDS


def whole(name: str, **keys: Any) -> Any:
    made = design(name, **keys)
    return whole_design(KINDS[made.kind], made.spec)


def scale_of(figure: Any) -> float:
    (found,) = (each for each in paper.SCALES if paper.ratio(each) in words(figure))
    return found


def cell(figure: Any, item: str) -> str:
    """The value of a line of a table."""
    texts = words(figure)
    return next(text for text in texts[texts.index(item) + 1 :] if text.replace(".", "").isdigit())


def involute(angle: float) -> float:
    return math.tan(angle) - angle


class Cut(NamedTuple):
    """A gear by its sizes, teeth counted positive; of a ring its spaces are cut as the teeth of a gear are shaped."""

    module: float
    teeth: int
    helix: float
    shift: float
    ring: bool = False

    @property
    def transverse(self) -> float:
        """Pressure angle on the reference circle."""
        return math.atan(math.tan(ALPHA) / math.cos(self.helix))

    def span(self, count: int, allowance: float = 0.0) -> float:
        """W = m cos(a) (pi (k - 1/2) + z inv(a_t)) + 2 x m sin(a), the teeth thinner by -E."""
        turns = math.pi * (count - 0.5) + self.teeth * involute(self.transverse)
        return self.module * (math.cos(ALPHA) * turns + 2.0 * self.shift * math.sin(ALPHA)) + allowance * math.cos(
            ALPHA
        )

    def over_balls(self, ball: float, allowance: float = 0.0) -> float:
        """Twice the distance of a ball's far side from the axis, or across the chord of an odd number of teeth.

        A tooth takes the angle (pi/2 + 2 x tan(a) + E/m) 2/z of the reference circle, and 2 (inv(a_t) - inv(a_y)) more
        of a circle of pressure angle a_y; the flanks that touch a ball at the ends of D are D/r_b apart.
        """
        thick = (0.5 * math.pi + 2.0 * self.shift * math.tan(ALPHA) + allowance / self.module) / self.teeth
        ball_angle = ball / (self.module * self.teeth * math.cos(ALPHA))
        wanted = thick + involute(self.transverse)
        wanted += -ball_angle if self.ring else ball_angle - math.pi / self.teeth
        angle = brentq(lambda at: involute(at) - wanted, 0.0, 1.2, xtol=1e-15)
        base = self.module * self.teeth / math.cos(self.helix) * math.cos(self.transverse)
        chord = base / math.cos(angle) * (math.cos(0.5 * math.pi / self.teeth) if self.teeth % 2 else 1.0)
        return chord - ball if self.ring else chord + ball


ALPHA = math.radians(20.0)


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "part", "tip", "cut", "thinner", "told"),
    [
        ("gear_pair", "gear1", 66.196, Cut(2.5, 23, math.radians(15.0), 0.35), (-0.07, -0.11), {"right", "71"}),
        ("standing_feed", "gear3", 92.0, Cut(2.0, 44, 0.0, 0.0), None, {"40", "84"}),
        ("ring_pair", "gear2", 131.2, Cut(2.0, 67, 0.0, 0.3, True), None, {"46", "21"}),
    ],
)
def test_a_gear_has_its_outline_and_its_table(
    name: str, part: str, tip: float, cut: Cut, thinner: tuple[float, float] | None, told: set[str]
) -> None:
    """Span and measure over balls by formulas of their own; allowances of DIN 3967, 25cd: -70 and -110 um."""
    figure = part_drawing.drawn(whole(name))[part]()
    scale = scale_of(figure)
    (profile,) = (line.get_xydata() @ [1.0, 1j] for line in tagged(figure, "profile"))
    (pitch,) = (line.get_xydata() @ [1.0, 1j] for line in tagged(figure, "reference circle"))
    middle = pitch[:-1].mean()
    far = np.abs(profile - middle)
    reach = far.min() if name == "ring_pair" else far.max()
    assert 2.0 * reach == pytest.approx(scale * tip, abs=0.03)
    assert 20.0 <= profile.real.min() <= profile.real.max() <= figure.get_figwidth() * 25.4 - 10.0
    assert told <= set(words(figure))
    count, ball = int(cell(figure, "teeth (ring: spaces) spanned")), float(cell(figure, "ball diameter"))
    limits = zip(("maximum", "minimum"), thinner, strict=True) if thinner else [("nominal", 0.0)]
    way, other = ("between", "over") if name == "ring_pair" else ("over", "between")
    assert not any(f"{other} balls" in text for text in words(figure))
    for limit, allowance in limits:
        assert cell(figure, f"span measurement, {limit}") == f"{cut.span(count, allowance):.6g}"
        assert cell(figure, f"measure {way} balls, {limit}") == f"{cut.over_balls(ball, allowance):.6g}"


def test_lengths_of_a_large_gear_are_told_to_a_micrometre() -> None:
    """Six digits are a hundredth from 1 m on, coarser than what is allowed to the measure over balls."""
    keys = {"module": 8.0, "teeth": [21, 190], "profile_shift": [0.1, 0.2], "helix_angle": 13.0, "face_width": 90.0}
    figure = part_drawing.drawn(whole("gear_pair", **keys))["gear2"]()
    large = Cut(8.0, 190, math.radians(13.0), 0.2)
    ball = float(cell(figure, "ball diameter"))
    for limit, allowance in (("maximum", -0.24), ("minimum", -0.34)):  # 25cd above a diameter of 1000 mm
        assert cell(figure, f"measure over balls, {limit}") == f"{large.over_balls(ball, allowance):.3f}"
    assert cell(figure, "reference diameter") == f"{8.0 * 190 / math.cos(large.helix):.3f}"


def test_the_height_of_a_rack_that_fills_its_paper_keeps_off_the_frame() -> None:
    """The words had touched the frame of an A4: here they keep 2 mm off it, as far as lines of a view do."""
    rack = {"module": 5.0, "teeth": [14, "rack"], "helix_angle": 20.0, "rack_teeth": 9}
    figure = part_drawing.drawn(whole("rack_drive", **rack))["rack"]()
    _, _, right, _ = vars(figure)["view"]
    height = f"{5.0 * 2.25 + 12.0:.3f}"  # tooth and rim
    (text,) = (each for each in figure.axes[0].texts if each.get_text() == height)
    box = text.get_window_extent(FigureCanvasAgg(figure).get_renderer()).transformed(figure.transFigure.inverted())
    assert box.x1 <= right - 2.0 / (25.4 * figure.get_figwidth())


def test_the_centre_distance_of_a_table_is_that_of_its_shifts() -> None:
    """cos(a_t) (z1 + z2) m/(2 cos(b) cos(a_w)) with inv(a_w) = inv(a_t) + 2 (x1 + x2) tan(a)/(z1 + z2)."""
    figure = part_drawing.drawn(whole("gear_pair"))["gear1"]()
    at = Cut(2.5, 23, math.radians(15.0), 0.35).transverse
    wanted = involute(at) + 2.0 * (0.35 + 0.15) * math.tan(ALPHA) / (23 + 71)
    working = brentq(lambda angle: involute(angle) - wanted, 0.0, 1.0, xtol=1e-15)
    plain = 0.5 * 2.5 * (23 + 71) / math.cos(math.radians(15.0))
    assert cell(figure, "centre distance") == f"{plain * math.cos(at) / math.cos(working):.6g}"


def test_the_title_block_has_the_material_of_the_rating() -> None:
    """The field had been left to be filled in; the table has the steel as well."""
    for part, steel in (("gear1", "16MnCr5"), ("gear2", "18CrNiMo7-6")):
        assert words(part_drawing.drawn(whole("rated_pair"))[part]()).count(steel) == 2


def test_an_idler_names_both_mates() -> None:
    lines = part_drawing.makers(whole("drawn_feed"))["gear3"]().lines()
    assert [value for item, _, value, _ in lines if item == "teeth of the mating gear"] == [20, 60]
    assert [value for item, _, value, _ in lines if item == "centre distance"] == [57.5, 107.5]


@pytest.mark.slow
def test_places_of_a_wide_swing_cam_are_those_of_its_roller() -> None:
    """Rows of three cam angles against the curve at that cam angle, found by bisection; half of the last digit."""
    made = whole("wide_swing_twin_cam")
    figure = part_drawing.drawn(made)["main_cam"]()
    texts = words(figure)
    for degree in (-50.0, 10.0, 40.0):
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if _angle(made, middle) < degree else (low, middle)
        at = complex(made.cam.points(np.array([low])).pitch[0])
        row = [f"{degree:g}", f"{abs(at):.3f}"]
        k = next(k for k in range(len(texts)) if texts[k : k + 2] == row)
        assert float(texts[k + 2]) == pytest.approx(math.degrees(np.angle(at)) % 360.0, abs=5.1e-4)


def _angle(made: Any, k: float) -> float:
    return math.degrees(float(made.cam.points(np.array([k])).cam_angle[0]))


@pytest.mark.slow
def test_parts_that_are_drawn() -> None:
    names = {
        "wide_swing_cycle": ["main_cam", "return_cam", "contour", "return_contour"],
        "wide_swing_slider_cam": ["main_cam"],
        "wide_swing_slider": [],
        "ty460_gears": ["1", "2", "gear1", "gear2", "gear3", "gear4", "pinion", "lower_rack", "upper_rack"],
        "planar_cam": ["1"],
        "linked_cams": ["1", "2"],
        "cycloidal_reducer": ["disc", "ring"],
        "cam_gear": ["groove"],
        "cam_linkage": ["groove"],
        "rack_stroke": ["pinion", "fixed_rack", "moving_rack"],
        "geneva_drive": ["wheel", "driver"],
    }
    for name, parts in names.items():
        found = [sheet for sheet in sheets_of(whole(name)) if sheet.startswith("drawing")]
        assert found == [f"drawing-{part}" for part in parts], name


@pytest.mark.slow
@pytest.mark.parametrize("name", ["rack_drive", "wide_swing_cycle", "wide_swing_twin_rocker", "mutilated_gear_press"])
def test_all_of_a_drawing_lies_within_its_frame(name: str) -> None:
    drawn = part_drawing.drawn(whole(name))
    assert drawn
    for make in drawn.values():
        figure = make()
        wide, tall = figure.get_size_inches() * 25.4
        points = np.concatenate([line.get_xydata() for line in figure.axes[0].lines])
        assert np.all(points >= np.array([20.0, 10.0]) - 1e-9)
        assert np.all(points <= np.array([wide - 10.0, tall - 10.0]) + 1e-9)
        renderer = FigureCanvasAgg(figure).get_renderer()
        for axes in figure.axes:
            for text in axes.texts:
                box = text.get_window_extent(renderer).transformed(figure.transFigure.inverted())
                assert 20.0 / wide <= box.x0 <= box.x1 <= 1.0 - 10.0 / wide, text.get_text()
                assert 10.0 / tall <= box.y0 <= box.y1 <= 1.0 - 10.0 / tall, text.get_text()


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["gear_pair", "wide_swing_cycle"])
def test_the_stamp_keeps_to_the_view(name: str) -> None:
    """It had covered rows of the table of an A3, and notes of an A4."""
    *_, make = part_drawing.drawn(whole(name)).values()
    figure = make()
    style.forbid(figure, "NOT FOR MANUFACTURE: GL402 cam-undercut 2.217 (limit ≤ 1), GL401 pressure-angle 48 deg")
    left, low, right, high = vars(figure)["view"]
    (stamp,) = (text for text in figure.texts if text.get_gid() == "forbidden")
    box = stamp.get_window_extent().transformed(figure.transFigure.inverted())
    assert left - 1e-3 <= box.x0 <= box.x1 <= right + 1e-3
    assert low - 1e-3 <= box.y0 <= box.y1 <= high + 1e-3


def test_words_beside_a_circle_keep_to_the_view() -> None:
    """The bore of this cam stands at the right of its view, and its words had run into the table."""
    figure = part_drawing.drawn(whole("loaded_wide_swing"))["main_cam"]()
    (bore,) = (text for axes in figure.axes for text in axes.texts if "H7" in text.get_text())
    box = bore.get_window_extent().transformed(figure.transFigure.inverted())
    left, low, right, high = vars(figure)["view"]
    assert left <= box.x0 <= box.x1 <= right
    assert low <= box.y0 <= box.y1 <= high


def test_a_small_part_is_drawn_large_and_its_notes_have_short_numbers() -> None:
    """10:1 was the largest scale, at which sizes covered a pinion of 1.3 mm; its notes had nine digits."""
    keys = {"module": 0.12, "teeth": [14, 64], "center_distance": None, "profile_shift": [0.2, 0], "face_width": 0.4}
    figure = part_drawing.drawn(whole("gear_pair", **keys))["gear1"]()
    assert scale_of(figure) == 50.0
    notes = [text for text in words(figure) if "involute from radius" in text]
    assert len(notes) == 1
    assert not re.search(r"\d\.\d{5}", notes[0])


def test_many_notes_do_not_cover_each_other() -> None:
    """Letters are lower than the step from row to row, however many rows there are."""
    page = paper.PAGES[0]
    _, axes = paper.sheet(page)
    paper.notes(axes, page, [f"note {k}" for k in range(12)])
    rows = [text for text in axes.texts if text.get_text().startswith("note")]
    steps = -np.diff([text.get_position()[1] for text in rows])
    assert all(text.get_fontsize() * 25.4 / 72.0 < min(steps) for text in rows)
