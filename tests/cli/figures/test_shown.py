"""What is shown on a mechanism: arrows are the finite differences of its positions, forces those of the table of loads,
instant centres stand still for their link, and what fails is red at the instants at which it does.

Tolerances: central differences over h = 1e-4 rad leave h^2/6 of the third derivative and eps/h of rounding, below 1e-6
of the size; their second differences eps/h^2, below 1e-4.
"""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from factory import design, each_kind
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from sheets import words

from gearlink.cli.views.figures import loads as loads_sheets
from gearlink.cli.views.figures import machine, tolerance
from gearlink.cli.views.figures import of_motion as whole
from gearlink.cli.views.figures.drawing import labels
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, vector_sheet
from gearlink.cli.views.films.page import player_data
from gearlink.cli.views.films.stage import Stage
from gearlink.cli.views.scenes import linkages, of_motion, shown
from gearlink.cli.views.scenes.scene import Arrow, Body, Chain, Line
from gearlink.core.base.kind import FileDesigns
from gearlink.core.base.kinds import KINDS
from gearlink.core.mechanism import vectors
from gearlink.core.studies.tolerance_study.samples import effects

_STEP = 1e-4
MOVING = [
    path
    for path in sorted((Path(__file__).resolve().parents[3] / "designs").glob("*.yaml"))
    if (kind := str(yaml.safe_load(path.read_text(encoding="utf-8"))["kind"])) in linkages.moving_kinds()
    and KINDS[kind].motion
]


def arrows(scene: Any) -> list[Arrow]:
    return [part for part in scene.parts if isinstance(part, Arrow)]


def scaled(scene: Any, what: str) -> float:
    """Millimetres of the drawing for a unit of an arrow, from its key."""
    (key,) = (key for key in scene.keys if key.words.startswith(what))
    return key.length / float(key.words.split()[1])


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name",
    ["standing_feed", "planar_quick_return", "swing_gripper", "wide_swing_oscillating_cam", "mutilated_gear_press"],
)
def test_arrows_are_the_finite_differences_of_their_points(name: str) -> None:
    made = design(name)
    fraction = np.array([0.11, 0.47, 0.83])
    scene = shown.build(made, fraction, shown.wishes("velocity,acceleration"))
    period = made.moving.input.end - made.moving.input.start
    speed = shown.speed_of(made) or 1.0
    ahead, behind = (
        shown.build(made, fraction + sign * _STEP / period, shown.wishes("velocity")) for sign in (1.0, -1.0)
    )
    ours = {part.name: part for part in arrows(scene)}
    later, earlier = ({part.name: part for part in arrows(each)} for each in (ahead, behind))
    assert later, "something moves"
    for name_, one in later.items():
        here = ours[name_].start
        rate = (one.start - earlier[name_].start) / (2.0 * _STEP) * speed
        bend = (one.start - 2.0 * here + earlier[name_].start) / _STEP**2 * speed**2
        size = 1.0 + float(np.abs(here).max())
        assert ours[name_].vector / scaled(scene, "velocity") == pytest.approx(rate, abs=1e-5 * size * speed)
        accelerated = ours[name_.replace("velocity", "acceleration")].vector / scaled(scene, "acceleration")
        assert accelerated == pytest.approx(bend, abs=1e-4 * size * speed**2)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["loaded_feed", "loaded_gripper", "loaded_six_bar"])
def test_force_arrows_are_those_of_the_table(name: str) -> None:
    loads = design(name, command="loads")
    table = {kind: loads.table(kind, samples=12) for kind in ("joints", "teeth")}
    scene = shown.build(design(name), np.arange(12) / 12, shown.wishes("force"))
    scale, seen = scaled(scene, "force"), 0
    for arrow in arrows(scene):
        joint = arrow.name.removeprefix("force ")
        for kind, columns in (("joints", (f"{joint}_x", f"{joint}_y")), ("teeth", (joint, f"{joint}_radial"))):
            if columns[0] in table[kind].columns:
                x, y = (np.asarray(table[kind][each]) for each in columns)
                assert np.abs(arrow.vector) / scale == pytest.approx(np.hypot(x, y), rel=1e-9, abs=1e-9)
                if kind == "joints":
                    assert arrow.vector / scale == pytest.approx(x + 1j * y, rel=1e-9, abs=1e-9)
                seen += 1
    assert seen >= 4


@pytest.mark.slow
def test_a_link_stands_still_at_its_instant_centre() -> None:
    mechanism = design("planar_watt").moving.at(np.linspace(0.1, 6.0, 7), 1)
    for name, link in mechanism.links.items():
        pole = vectors.centre(mechanism, name)
        for k, at in enumerate(pole.tolist()):
            arm = (at - link.origin.value[k]) / link.unit[k]
            assert abs(link.at(complex(arm)).first[k]) < 1e-9 * (1.0 + abs(arm))
    between = vectors.centre(mechanism, "coupler", "rocker")
    pin = next(each for each in mechanism.connections if each.name == "C")
    assert between == pytest.approx(pin.at, abs=1e-9)


def test_centres_of_three_links_lie_in_line() -> None:
    """Aronhold and Kennedy."""
    mechanism = design("planar_watt").moving.at(np.linspace(0.1, 6.0, 7), 1)
    one, other = vectors.centre(mechanism, "coupler"), vectors.centre(mechanism, "arm")
    between = vectors.centre(mechanism, "coupler", "arm")
    off = ((between - one) * np.conj(other - one)).imag / np.abs(other - one)
    assert (np.abs(off) < 1e-9 * (1.0 + np.abs(between - one))).all()


def test_a_path_passes_its_point() -> None:
    made = design("standing_feed")
    scene = shown.build(made, np.array([0.2, 0.6]), shown.wishes("path:coupler@40/-20"))
    (path,) = (part for part in scene.parts if isinstance(part, Line) and part.name == "path of coupler@40/-20")
    points = made.moving.at(np.array([0.2, 0.6]) * 2.0 * np.pi, 0).links["coupler"].at(40.0 - 20.0j).value
    assert np.abs(path.points[[72, 216]] - points).max() < 1e-9
    assert sorted(mark.text for mark in scene.marks)[:4] == ["0°", "180°", "270°", "90°"]


def test_ghosts_are_earlier_positions() -> None:
    made = design("crank_rocker")
    scene = shown.build(made, np.array([0.5]), shown.wishes("ghosts"))
    pale = [part for part in scene.parts if isinstance(part, Chain) and not part.marked]
    earlier = linkages.build(made, 0.5 - np.array([4, 3, 2, 1]) / 24.0)
    chain = next(part for part in earlier.parts if isinstance(part, Chain) and part.marked)
    shown_at = [complex(part.joints[1][0]) for part in pale if np.abs(part.joints[0][0] - chain.joints[0][0]) < 1e-9]
    assert set(np.round(chain.joints[1], 9).tolist()) <= set(np.round(shown_at, 9).tolist())


@pytest.mark.quick(3)
@pytest.mark.parametrize("path", each_kind(MOVING), ids=lambda path: path.stem)
def test_every_kind_shows_all_that_it_has(path: Path) -> None:
    """Places of the motion in the scene, or the diagram of the motion itself; and data for a page, without NaN."""
    made = design(path.stem)
    scene = shown.build(made, np.arange(4) / 4.0, shown.wishes("velocity,acceleration,centres,ghosts"))
    data = player_data(scene, "x", 25)
    assert len(data["keys"]) >= 2
    assert all(value is None or np.isfinite(value) for part in data["parts"] for value in np.ravel(part["p"]).tolist())


@pytest.mark.parametrize(
    "text", ["velocities", "path", "ghosts:A", "path:Q", "path:coupler@1", "path:coupler@nan/1", "force"]
)
def test_what_cannot_be_shown_is_refused(text: str) -> None:
    with pytest.raises(shown.WrongShow):
        shown.build(design("standing_feed"), np.array([0.1]), shown.wishes(text))


def test_a_machine_of_members_has_no_vectors() -> None:
    with pytest.raises(shown.WrongShow, match="members"):
        shown.build(design("sheet_press"), np.array([0.1]), shown.wishes("velocity"))


def failing(name: str, **keys: Any) -> tuple[Any, Any]:
    made = design(name, **keys)
    found = FileDesigns(KINDS[made.kind], made.spec)
    checks = [check for command in made.spec.commands() for check in found.of(command).report(command).checks]
    return made, shown.build(made, np.arange(36) / 36.0, (), checks)


def test_instants_of_a_small_transmission_angle_are_red() -> None:
    made, scene = failing("crank_rocker", limits={"transmission_angle": 60.0})
    (fault,) = (fault for fault in scene.faults if "GL303" in fault.words)
    links = made.moving.at(np.arange(36) * np.pi / 18.0, 0).links
    angle = links["coupler"].turn.value - links["rocker"].turn.value
    assert fault.at.tolist() == (np.degrees(np.arcsin(np.abs(np.sin(angle)))) < 60.0).tolist()
    assert 0 < fault.at.sum() < 36
    red = [part for part in scene.parts if isinstance(part, Chain) and part.color == "#D00000"]
    assert [np.isfinite(part.joints[0]).tolist() for part in red] == [fault.at.tolist()] * len(red) != []


def test_gears_that_clash_are_red_where_they_do() -> None:
    made, scene = failing("drawn_feed", links__frame=100.0)
    (fault,) = (fault for fault in scene.faults if "GL301" in fault.words)
    places = {mark.text: mark.point for mark in scene.marks}
    pair = next(pair for pair in made.layout.gear_pairs if pair.gap < 0.0)
    apart = np.abs(places[pair.one.axis] - places[pair.other.axis])
    assert fault.at.tolist() == (apart < pair.one.outer + pair.other.outer).tolist()
    assert fault.at[0]
    red = [part for part in scene.parts if isinstance(part, Body) and part.color == "#D00000"]
    assert len(red) == 2


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "keys"),
    [
        ("five_bar_path", {"transmission_angle": 80.0}),
        ("five_bar_positions", {"transmission_angle": 80.0}),
        ("ty460", {"transmission_angle": 80.0}),
        ("hypocycloid_slider", {"transmission_angle": 80.0}),
        ("wide_swing_slider", {"transmission_angle": 80.0}),
        ("lift_cam", {"pressure_angle": 5.0}),
        ("wide_swing_twin_cam", {"pressure_angle": 5.0}),
        ("ty460", {"pressure_angle": 5.0}),
        ("six_bar_swing", {"gear_gap": 300.0}),
    ],
)
def test_every_failing_check_is_said_in_the_film(name: str, keys: dict[str, float]) -> None:
    """Of each kind, also where the motion does not tell the instants."""
    made, scene = failing(name, limits=keys)
    assert scene.faults
    data = player_data(scene, made.spec.name, 25)
    assert any(data["faults"])
    assert [bool(any(fault.placed and fault.at[i] for fault in scene.faults)) for i in range(36)] == [
        bool(framed) for framed in data["framed"]
    ]


def test_a_passing_design_has_nothing_red() -> None:
    _, scene = failing("crank_rocker")
    assert scene.faults == ()
    assert player_data(scene, "x", 25)["faults"] == []


def test_the_diagram_of_the_motion_serves_a_scene_that_stands_elsewhere() -> None:
    """Without input gears nothing says where the chain of the cylinder stands against that of the bed."""
    made = design("ty460", input_gears=None)
    assert shown.frame_of(made, linkages.builder(made.kind)) is None
    scene = shown.build(made, np.arange(3) / 3.0, shown.wishes("velocity:B"))
    (arrow,) = arrows(scene)
    q = of_motion.inputs(made.moving.input, np.arange(3) / 3.0)
    now = made.moving.at(q, 1)
    point = vectors.rates_of(now, vectors.place_of(now, "B"))
    assert np.array_equal(arrow.start, point.value)
    assert arrow.vector == pytest.approx(scaled(scene, "velocity") * made.angular_speed * point.first, rel=1e-9)


def test_polygons_close_over_the_links() -> None:
    """v_C - v_B stands across BC, as long as the coupler turns fast; the ends drawn are the rates of the points."""
    made = design("crank_rocker")
    speed = shown.speed_of(made) or 1.0
    figure = vector_sheet.draw(made, [40.0])
    ends = {line.get_gid(): complex(*line.get_xydata()[0]) for axes in figure.axes for line in axes.lines}
    links = made.moving.at(np.radians([40.0]), 2).links
    coupler = links["coupler"]
    b, c = coupler.origin, links["rocker"].at("C")
    assert ends["velocity B"] == pytest.approx(complex(b.first[0]) * speed, rel=1e-9, abs=1e-9)
    assert ends["acceleration C"] == pytest.approx(complex(c.second[0]) * speed**2)
    arm = complex(c.value[0] - b.value[0])
    turning = 1j * float(coupler.turn.first[0]) * speed
    assert ends["velocity C"] - ends["velocity B"] == pytest.approx(turning * arm, rel=1e-9, abs=1e-9)
    assert "velocity of coupler" in ends


def test_default_instants_are_the_extremes_of_the_output() -> None:
    made = design("crank_rocker")
    fastest, accelerated = vector_sheet.default_places(made)
    q = np.linspace(0.0, 2.0 * np.pi, 3601)
    _, first, second = made.moving.outputs[0].course.rates(made.moving, q, 2)
    for place, rate in ((fastest, first), (accelerated, second)):
        assert np.degrees(q[np.argmax(np.abs(rate))]) == pytest.approx(place, abs=0.4)


@pytest.mark.slow
def test_a_drawing_of_a_cam_that_fails_is_forbidden(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    asked = ("sheet", designs / "ty460.yaml", "drawing-1", "-f", "svg", "--out", tmp_path)
    ended = gearlink(*asked, "--set", "cam.base_radius=35")
    assert ended.status == 1
    assert "NOT FOR MANUFACTURE" in (tmp_path / "TY-460-drawing-1.svg").read_text(encoding="utf-8")
    assert gearlink(*asked).status == 0
    assert "NOT FOR MANUFACTURE" not in (tmp_path / "TY-460-drawing-1.svg").read_text(encoding="utf-8")


def test_the_sheet_of_forces_has_the_numbers_of_the_tables() -> None:
    loads = design("loaded_feed", command="loads")
    figure = loads_sheets.draw_forces(design("loaded_feed"))
    drawn = {line.get_gid(): line.get_ydata() for axes in figure.axes for line in axes.lines if line.get_gid()}
    joints, teeth = loads.table("joints", samples=360), loads.table("teeth", samples=360)
    for name in ("A", "B", "C", "D"):
        assert drawn[f"force {name}"][:-1] == pytest.approx(np.asarray(joints[name]), rel=1e-9)
    mesh = np.hypot(teeth["mesh_13"], teeth["mesh_13_radial"])
    assert drawn["force mesh 13"][:-1] == pytest.approx(mesh, rel=1e-9)
    assert drawn["torque"][:-1] == pytest.approx(
        np.asarray(loads.table("torque", samples=360)["input_torque"]), rel=1e-9
    )
    place = loads_sheets.largest_torque(loads)
    assert np.abs(drawn["torque"]).max() <= abs(float(loads.machine.torque(np.array([place]))[0])) * (1.0 + 1e-9)
    arrows_ = [line for line in figure.axes[0].lines if str(line.get_gid()).startswith("force ")]
    assert len(arrows_) >= 8, "an arrow at every joint and mesh"


@pytest.mark.slow
def test_the_magnified_dwell_is_the_longest_within_the_tolerance() -> None:
    """A step of 0.05 deg at each end; the quantities of the design come from roots."""
    for name in ("standing_feed", "two_gear_standing"):
        made = design(name)
        found = motion_sheet.dwell_of(made)
        assert found is not None
        assert np.degrees(found.width) == pytest.approx(made.quantity("tolerance_dwell_angle").value, abs=0.11)
        figure = motion_sheet.dwell(made)
        (line,) = (line for axes in figure.axes for line in axes.lines if line.get_gid() == "dwell")
        x, y = line.get_data()
        inside = (x >= np.degrees(found.start)) & (x <= np.degrees(found.start + found.width))
        assert np.abs(y[inside]).max() <= np.degrees(found.tolerance) * (1.0 + 1e-6)


def test_a_dwell_without_a_tolerance_has_one_of_two_digits() -> None:
    """The half range of 60 deg of samples was 0.2998 deg."""
    found = motion_sheet.dwell_of(design("geneva_drive"))
    assert found is not None
    assert np.degrees(found.tolerance) == pytest.approx(0.3, rel=1e-12, abs=0.0)


def test_an_even_speed_has_its_value_once() -> None:
    axes = motion_sheet.draw(design("cycloidal_reducer")).axes[1]
    assert [text.get_text() for text in axes.texts if "0.0909" in text.get_text()] == ["−0.090909 at 0°"]


def test_a_dwell_after_a_revolution_of_the_input_begins_where_its_axis_says() -> None:
    """Its heading had named the angle within a revolution, beside an axis of six."""
    made = design("mutilated_gear_press")
    found = motion_sheet.dwell_of(made)
    assert found is not None
    begins = float(np.degrees(found.start))
    assert begins > 360.0
    upper, _ = motion_sheet.dwell(made).axes
    assert upper.get_title(loc="left").endswith(f"from {begins:.5g}°")
    low, high = upper.get_xlim()
    assert low < begins < high


def test_the_zone_shows_what_the_cams_make_up_for() -> None:
    made = design("ty460")
    start, end = np.degrees(made.sync_start), np.degrees(made.sync_end)
    x = np.linspace(start, end, 1001)
    way, speed = motion_sheet.zone_errors(made, x, cams=False)
    assert np.abs(way).max() > 1.0
    slope = np.gradient(way, np.radians(x))[1:-1] * made.input_speed  # within a step's square of the third derivative
    assert slope == pytest.approx(speed[1:-1], abs=1e-2)
    for with_cams, alone in zip(motion_sheet.zone_errors(made, x), (way, speed), strict=True):
        assert np.abs(with_cams).max() < 1e-9 * np.abs(alone).max()
    named = [text.get_text() for axes in motion_sheet.zone(made).axes for text in axes.get_legend().get_texts()]
    assert "with cams: at most 0 mm" in named, "rounding is no error"


@pytest.mark.slow
def test_the_timing_of_a_machine_keeps_the_margins_of_its_page() -> None:
    """Names of members stood at the edge of the paper, the title on the first row; a whole turn was 0 to 0."""
    made = design("sheet_press")
    figure = settled(machine.line_sheet(made))
    renderer = figure.canvas.get_renderer()
    edge = 7.5 / 25.4 * figure.dpi
    for text in (label for axes in figure.axes for label in axes.get_yticklabels()):
        assert text.get_window_extent(renderer).x0 > edge
    top = max(axes.get_tightbbox(renderer).y1 for axes in figure.axes)
    assert figure._suptitle.get_window_extent(renderer).y0 >= top  # type: ignore[attr-defined]
    assert "return 0–360°" in words(machine.circle_sheet(made))


@pytest.mark.slow
@pytest.mark.parametrize("count", [45, 120])
def test_a_machine_of_many_members_has_paper_for_their_names(count: int) -> None:
    """Names and ranges of 100 members stood on each other, their curves were flat."""
    crank = {"kind": "slider-crank", "stroke": 40, "rod": 90}
    members = {f"member_{i}": {"phase": i, "design": crank} for i in range(count)}
    made = design({"kind": "machine", "name": "long", "members": members})
    for figure in (settled(machine.draw("analyze", made)), settled(machine.line_sheet(made))):
        boxes = [label.get_window_extent() for label in figure.axes[0].get_yticklabels()]
        assert len(boxes) == count
        assert all(upper.y0 > lower.y1 for upper, lower in pairwise(boxes))
    scene = machine.build(made, np.array([0.0]))
    assert (scene.chart, [each.label for each in scene.readouts]) == (None, ["machine"]), (
        "values and curves fill a film"
    )
    circle = settled(machine.circle_sheet(made))
    boxes = [text.get_window_extent() for text in circle.axes[0].texts if text.get_text().startswith("member ")]
    assert len(boxes) == count
    assert all(upper.y0 > lower.y1 - 0.3 * lower.height for upper, lower in pairwise(boxes)), "letters have room"


def test_a_cam_is_coloured_by_its_pressure_angle() -> None:
    made = design("ty460", limits__pressure_angle=12.0)
    figure = motion_sheet.contact(made)
    for axes, cam in zip(figure.axes, cam_sheets.discs(made), strict=False):
        lines, red = axes.collections
        theta = np.linspace(0.0, 2.0 * np.pi, 1441)
        angle = np.degrees(np.abs(cam.pressure_angle(0.5 * (theta[1:] + theta[:-1]))))
        assert np.array_equal(lines.get_array(), angle)
        assert len(red.get_segments()) == (angle > 12.0).sum() > 0
        rollers = [patch for patch in axes.patches if patch.get_gid() == "roller"]
        assert [patch.radius for patch in rollers] == [cam.roller_radius] * 12


def test_bars_of_a_tornado_are_designs_with_one_size_at_its_limit() -> None:
    made = design("slider_crank_tolerances")
    study = tolerance.study_of(made)
    assert study is not None
    found, nominal = effects(study.problem, ["stroke"])
    assert nominal["stroke"] == pytest.approx(made.quantity("stroke").value, rel=1e-12)
    for key, low, high in found["stroke"]:
        off = {"crank": 0.02, "rod": 0.03, "offset": 0.05}[key]
        for sign, change in ((-1.0, low), (1.0, high)):
            other = design("slider_crank_tolerances", **{key: getattr(made.spec, key) + sign * off})
            expected = other.quantity("stroke").value - nominal["stroke"]
            assert change == pytest.approx(expected, abs=1e-9)
    assert [row[0] for row in found["stroke"]] == ["crank", "offset", "rod"]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["loaded_measured_cam", "ty460_register"])
def test_a_tornado_shows_four_quantities_that_their_sources_move(name: str) -> None:
    """Sixteen panels on one page had their words one on the other."""
    figure = tolerance.draw_tornado(design(name))
    assert len(figure.axes) == 4
    for axes in figure.axes:
        widths = [[abs(bar.get_width()) for bar in drawn] for drawn in axes.containers]
        assert min(max(pair) for pair in zip(*widths, strict=True)) > 0.0
        assert len(axes.get_yticks()) == len(widths[0])


@pytest.mark.parametrize("name", ["ty460", "swing_gripper", "wide_swing_cycle", "lift_cam", "barrel_cam"])
def test_vectors_are_in_real_time_where_the_sheet_of_motion_is(name: str) -> None:
    """Those of a press, a gripper, a wide swing and cams had been per rad of the input despite the file's speed."""
    made = design(name)
    assert shown.speed_of(made) == pytest.approx(motion_sheet.courses(made)[0].speed, rel=1e-12)
    assert [vector_sheet.unit(made, order) for order in (1, 2)] == ["mm/s", "mm/s²"]


@pytest.mark.slow
def test_vectors_are_shown_where_they_are_largest_under_the_name_of_the_input() -> None:
    """Of a cam they stood at the nearest of a thousand angles, of a gripper at `theta`."""
    made = design("lift_cam")
    exact = [195.0, made.quantity("acceleration_min_at").value]
    assert vector_sheet.default_places(made) == pytest.approx(exact, abs=2e-4)  # twice the last of its digits
    figure = vector_sheet.draw(design("swing_gripper"), [185.0])
    assert figure.axes[0].get_title(loc="left").startswith("At cylinder angle 185°")
    assert "F" in [text.get_text() for text in figure.axes[-1].get_legend().get_texts()]


@pytest.mark.slow
def test_keys_stand_below_the_drawing_in_rows_of_their_own() -> None:
    """In a flat panel the words of one had moved below the next, with a line to their sign."""
    figure = settled(vector_sheet.draw(design("crank_rocker"), [340.0, 40.0]))
    rows = [
        [text.get_window_extent() for text in axes.texts if text.get_gid() == labels.KEY] for axes in figure.axes[:4:3]
    ]
    for first, second in rows:
        assert first.y0 > second.y0 + 0.7 * second.height
        assert first.x0 == pytest.approx(second.x0, abs=0.3 * first.width)
    slides = vector_sheet.draw(design("slider_crank_tolerances")).axes[0]
    lowest = min(float(np.min(line.get_ydata())) for line in slides.lines if line.get_linewidth() > 0.0)
    keys = [text.xy[1] for text in slides.texts if text.get_gid() == labels.KEY]
    assert max(keys) <= lowest + 1e-9, "below the way of the slider"


@pytest.mark.parametrize("name", ["ty460", "ty460_gears"])
def test_vectors_of_a_press_without_loads_stand_on_its_own_drawing(name: str) -> None:
    """Its file does not say where gear 1 and the cylinder are; the arrows begin at the joints that are drawn."""
    made, fraction = design(name), np.array([0.11, 0.47, 0.83])
    scene = shown.build(made, fraction, shown.wishes("velocity"))
    drawn = {mark.text: mark.point for mark in linkages.build(made, fraction).marks}
    begun = {part.name.rpartition(" ")[2]: part.start for part in arrows(scene)}
    for pin in "BCEFHM":
        assert begun[pin] == pytest.approx(drawn[pin], rel=0.0, abs=1e-6)
    bed = next(part for part in arrows(scene) if part.name.endswith(" bed"))
    assert np.abs(bed.vector.imag).max() < 1e-9 * np.abs(bed.vector).max()


def test_both_rollers_of_a_twin_rocker_have_vectors() -> None:
    made = design("wide_swing_cycle")
    scene = shown.build(made, np.array([0.05, 0.1]), shown.wishes("velocity"))
    speeds = {part.name.rpartition(".")[2]: np.abs(part.vector) for part in arrows(scene)}
    assert set(speeds) == {"roller", "return_roller"}
    arms = [abs(made.moving.at(np.zeros(2), 0).links["rocker"].points[name]) for name in speeds]
    one, other = (speed / arm for speed, arm in zip(speeds.values(), arms, strict=True))
    assert one == pytest.approx(other, rel=1e-12, abs=0.0)  # of one rocker


def test_the_mechanism_of_an_animation_keeps_clear_of_the_keys_of_arrows() -> None:
    scene = shown.build(design("hypocycloid_slider"), np.arange(12) / 12, shown.wishes("velocity,ghosts,centres"))
    stage = Stage(scene, "", 960, 720)
    assert len(stage.scales()) == 3
    assert stage.extent.bottom < min(at.imag for at, *_ in stage.scales())


def test_numbers_of_a_path_that_coincide_are_one_text() -> None:
    scene = shown.build(design("linked_cams"), np.zeros(1), shown.wishes("path:roller_y"))
    texts = [mark.text for mark in scene.marks if "°" in mark.text]
    assert texts == ["0° 90° 180° 270°"]
    scene = shown.build(design("crank_rocker_links"), np.zeros(1), shown.wishes("path:B"))
    assert [mark.text for mark in scene.marks if "°" in mark.text] == ["0°", "90°", "180°", "270°"]


@pytest.mark.slow
def test_a_joint_of_two_letters_keeps_them_on_a_small_drawing() -> None:
    small = vector_sheet.draw(design("five_bar_path"), [40.0]).axes[0]
    assert {"A", "B", "C, M", "D", "E"} <= {text.get_text() for text in small.texts}


def test_an_instant_centre_beyond_the_picture_has_an_arrow_at_its_edge() -> None:
    """The coupler of a crank-rocker: the pole is where crank and rocker meet, found by their lines (1e-9)."""
    made = design("crank_rocker_links")
    fraction = np.array([80.0 / 360.0])
    scene = shown.build(made, fraction, shown.wishes("centres"))
    (arrow,) = (part for part in scene.parts if isinstance(part, Arrow))
    links = made.moving.at(2.0 * np.pi * fraction, 0)
    pins = {pin.name: complex(pin.at[0]) for pin in links.connections}
    crank, rocker = pins["B"] - pins["A"], pins["C"] - pins["D"]
    share = ((pins["D"] - pins["A"]) * rocker.conjugate()).imag / (crank * rocker.conjugate()).imag
    pole, end = pins["A"] + share * crank, complex(arrow.start[0] + arrow.vector[0])
    assert abs(((pole - end) * complex(arrow.vector[0]).conjugate()).imag) < 1e-9 * abs(pole - end) * abs(
        arrow.vector[0]
    )
    assert ((pole - end) * complex(arrow.vector[0]).conjugate()).real > 0.0
    assert any(f"P coupler: {abs(pole - end):.3g} mm beyond the edge" == key.words for key in scene.keys)
    assert "P coupler" in [text.get_text() for text in vector_sheet.draw(made, [80.0], "centres").axes[0].texts]


@pytest.mark.slow
def test_sheets_call_inputs_and_points_in_words() -> None:
    """The input of a gripper was the letter of its tables, points had the underscores of their names."""
    gripper = design("swing_gripper")
    assert motion_sheet.input_words(gripper.moving.input) == "cylinder angle"
    assert motion_sheet.courses(gripper)[0].over == "cylinder angle [deg]"
    figure = vector_sheet.draw(design("linked_cams"), [90.0])
    names = [label for axes in figure.axes for label in axes.get_legend_handles_labels()[1]]
    assert "roller y" in names
    assert not any("_" in name for name in names)


def test_a_vector_that_is_zero_is_a_point_on_the_scale_of_the_others() -> None:
    """Where the velocity is largest, the acceleration was an arrow of its rounding on an axis of 1e-13."""
    made = design("barrel_cam")
    place = made.quantity("velocity_max_at").value
    axes = Figure().subplots()
    vector_sheet.polygon(axes, made, math.radians(place), 2)
    q = np.linspace(0.0, 2.0 * np.pi, 721)
    largest = max(np.abs(each).max() for each in vector_sheet.rates(made, q, 2)[0].values())
    assert np.ptp(axes.get_ylim()) > 0.1 * largest


@pytest.mark.slow
def test_names_of_findings_do_not_cover_the_headings_of_columns() -> None:
    """They covered the name of an output in the second column."""
    made = design("planar_watt", limits__transmission_angle=85.0)
    figure = motion_sheet.draw(made)
    whole.instants(figure, made, made.check("transmission-angle"))
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    named = [axes for axes in figure.axes if axes.get_legend() is not None]
    assert len(named) > 1
    for axes in named:
        title, legend = axes._left_title.get_window_extent(renderer), axes.get_legend().get_window_extent(renderer)
        assert not title.overlaps(legend)


def test_a_hodograph_of_many_turns_is_round() -> None:
    """Of 87 turns of an input it had eight corners in each, which together made a broad ring."""
    made = design("cycloidal_reducer", pins=60, eccentricity=0.6, pin_radius=2.0)
    axes = Figure().subplots()
    vector_sheet.hodographs(axes, made, 1)
    ring = next(line for line in axes.lines if str(line.get_gid()).startswith("hodograph"))
    middles = 0.5 * (ring.get_xydata()[1:] + ring.get_xydata()[:-1])
    radii = np.hypot(*middles.T)
    assert radii.min() == pytest.approx(radii.max(), rel=1e-3)
