"""No words on sheets lie on other words, on marks or beside the page: of all designs, and of odd proportions."""

from __future__ import annotations

import itertools
from contextlib import suppress
from typing import Any

import numpy as np
import pytest
from factory import DESIGNS, changed, design, each_kind, worked
from matplotlib.backends.backend_agg import FigureCanvasAgg
from sheets import fits_a_page, meetings, placed_sheet
from sweeps import mostly_slow

from gearlink.cli.commands.sheet import sheets_of
from gearlink.cli.evaluate import whole_design
from gearlink.cli.views.figures.drawing import labels, panels, style
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.write import panels as draw_panels
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import KINDS

Case = tuple[str, str, dict[str, Any]]


def _cases() -> list[Case]:
    """Designs at the ends of what can be built: short and long links, few and many teeth, tiny and huge."""
    found: list[Case] = []

    def add(name: str, command: str, **keys: list[Any]) -> None:
        for values in itertools.product(*keys.values()):
            found.append((name, command, dict(zip(keys, values, strict=True))))

    add("ty460_slider_crank", "crank", rod=[400.0, 900.0, 9000.0, 60000.0], offset=[-100.0, 0.0, 40.0])
    add("crank_rocker_links", "analyze", links__crank=[1.0, 10.0, 25.0], links__coupler=[100.0, 130.0])
    add("gear_pair", "gear", teeth=[[12, 300], [17, 18], [90, 14]], load=[None])
    add("rack_drive", "gear", rack_teeth=[5, 80, 500])
    add("five_bar_path", "analyze", links__coupler=[40.0, 300.0], links__follower=[45.0, 310.0])
    add("five_bar_path", "analyze", coupler_point__along=[-80.0, 0.0, 400.0])
    add("hypocycloid_slider", "analyze", gears__module=[0.05, 60.0], gears__planet=[20, 25])
    add("geneva_drive", "analyze", slots=[4, 12], center_distance=[110.0, 600.0])
    add("cycloidal_reducer", "analyze", pins=[6, 18])
    add("lift_cam", "analyze", follower__roller_radius=[2.0, 30.0], cam__shaft_radius=[5.0, 60.0])
    add("standing_feed", "analyze", gears__crank=[20, 90], gears__output=[30, 120], dwell__window=[40.0, 60.0])
    add("standing_feed", "analyze", gears__module=[0.05, 80.0])
    add("candy_feed", "synth dwell", gears__output=[30, 60, 110])
    add("two_gear_standing", "synth dwell", dwell__window=[20.0, 50.0])
    add("six_bar_swing", "analyze", links__coupler_2=[120.0, 170.0], links__coupler_1=[10.0, 36.0])
    add("mutilated_gear_press", "analyze", links__crank=[10.0, 55.0], links__frame=[110.0, 200.0])
    add("wide_lever", "analyze", gears__coupler=[24, 90])
    add("lift_cam", "analyze", limits__pressure_angle=[[35, 25]], cam=[{"prime_radius": 45, "sense": -1}])
    add("loaded_cam", "loads", follower__inertia=[0.0001, 4.0])
    add("planar_cam", "loads", input_speed=[600.0])
    add("loaded_feed", "loads", links__crank=[5.0, 45.0])
    add("loaded_press", "loads", speed=[9000.0])
    add("wide_swing_cycle", "cam", swing=[60.0, 170.0])
    add("ty460", "press", compensation=[None])
    add("swing_gripper", "gripper", speed=[3000.0, 18000.0])
    return found


ODD = _cases()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "command", "keys"), mostly_slow(ODD, 1))
def test_words_keep_clear_at_odd_proportions(name: str, command: str, keys: dict[str, Any]) -> None:
    try:
        figure = placed_sheet(name, command, **keys).figure
    except NoSolution:
        pytest.skip("this one cannot be built")
    assert meetings(figure) == []


@pytest.mark.slow
def test_fifty_of_the_odd_ones_can_be_built() -> None:
    """Those that cannot are skipped above. What a sheet shows is computed before its panels are placed."""
    built = 0
    for name, command, keys in ODD:
        with suppress(NoSolution):
            draw_panels(command, design(changed(worked(name), **keys), command=command))
            built += 1
    assert built >= 50


@pytest.mark.slow
@pytest.mark.parametrize("path", each_kind(sorted(DESIGNS.glob("*.yaml"))), ids=lambda path: path.stem)
def test_words_keep_clear_on_every_sheet_of_every_design(path: Any) -> None:
    data = worked(path.stem)
    kind = KINDS[data["kind"]]
    spec = kind.spec_model().model_validate(data)
    for command in spec.commands():
        figure = placed_sheet(data, command).figure
        assert meetings(figure) == [], command
        assert fits_a_page(figure), command
    for name, draw in sheets_of(whole_design(kind, spec)).items():
        figure = settled(draw())
        assert meetings(figure) == [], name
        assert fits_a_page(figure), name


@pytest.mark.parametrize(("share", "size"), [(0.5, (8.27, 5.845)), (1.2, (8.27, 11.69)), (1.6, (11.69, 16.54))])
def test_a_page_is_a4_or_a3_and_no_longer(share: float, size: tuple[float, float]) -> None:
    """Printers took the values of a gear pair, 336 mm long, to no scale."""
    made = panels.page("page", share)
    assert made.get_size_inches() == pytest.approx(size, rel=1e-12)
    assert fits_a_page(made)


def test_a_letter_that_is_hidden_counts_whole_under_a_long_word_too() -> None:
    word, letter, beside = [0.0, 0.0, 120.0, 10.0], [20.0, 0.0, 28.0, 10.0], [20.0, 5.0, 28.0, 15.0]
    for box, taken, share in ((word, letter, 1.0), (letter, word, 1.0), (word, beside, 0.5), (beside, word, 0.5)):
        assert labels._on(np.array([box]), np.array([taken])) == pytest.approx([share], rel=1e-12)


def test_words_on_words_move_and_others_stay() -> None:
    made = panels.page("two letters", 0.4)
    axes = made.add_subplot()
    style.drawing(axes)
    axes.plot([0.0, 10.0], [0.0, 10.0])
    for name, place in (("A", 2 + 2j), ("B", 2.1 + 2j), ("C", 8 + 8j)):
        style.letter(axes, place, name, (6.0, 6.0))
    one, two, alone = axes.texts
    settled(made)
    assert meetings(made) == []
    assert one.xyann == alone.xyann == (6.0, 6.0)  # type: ignore[attr-defined]
    assert two.xyann != (6.0, 6.0)  # type: ignore[attr-defined]


@pytest.mark.slow
def test_a_word_far_from_its_point_has_a_line_to_it() -> None:
    made = panels.page("crowd", 0.4)
    axes = made.add_subplot()
    style.drawing(axes)
    axes.set_xlim(0.0, 10.0)
    axes.set_ylim(0.0, 10.0)
    for i in range(12):
        axes.annotate(f"point {i}", (5.0, 5.0 + 0.01 * i), (4, 4), textcoords="offset points", fontsize=9)
    settled(made)
    assert meetings(made) == []
    renderer = FigureCanvasAgg(made).get_renderer()
    leaders = [each for each in axes.lines if each.get_gid() == "leader"]
    far = 0
    for text in axes.texts:
        box = np.array(labels.box_of(text, renderer)).reshape(2, 2)
        at = axes.transData.transform(text.xy)  # type: ignore[attr-defined]
        far += float(np.hypot(*np.maximum(np.maximum(box[0] - at, at - box[1]), 0.0))) > 13.5 * made.dpi / 72.0
    assert leaders
    assert len(leaders) >= far


def test_a_long_word_uncovers_a_small_mark() -> None:
    """The mark takes a hundredth of the word, and yet none of it was to be seen."""
    made = panels.page("end of a vector", 0.4)
    axes = made.add_subplot()
    style.drawing(axes)
    axes.plot([0.0, 10.0], [0.0, 10.0], linewidth=0.0)
    axes.plot([5.0], [5.0], ".", markersize=3)
    style.letter(axes, 5 + 5j, "return_roller", (8.0, 0.0))
    settled(made)
    assert meetings(made) == []
