"""Drawings of Geneva wheels, cycloidal discs, grooves and cams, read back in mm of paper.

Sizes against formulas of their own, as printed, so to half of the last digit; outlines against those that `export`
writes, to the error of the chords of both; lengths on the paper against their words times the scale, to rounding.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from factory import design
from matplotlib.backends.backend_agg import FigureCanvasAgg
from sheets import meetings, tagged, words
from sheets import points as points_of
from sweeps import ALL

from gearlink.cli.commands.sheet import sheets_of
from gearlink.cli.evaluate import whole_design
from gearlink.cli.export.contour import contour
from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.parts import makers
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.sheets import paper, part_drawing
from gearlink.core.base.kinds import KINDS

FINE, CHORDS = 1e-3, 0.01
"""Errors of the chords: of the export [mm], and of the drawing [mm of paper]."""
UNDER_A_FACE = {
    "kind": "planar-mechanism",
    "frame": {"O": [0, 0]},
    "links": {"cam": {"O": [0, 0]}, "follower": {"B": [0, 0]}},
    "slides": {"guide": {"link": "follower", "through": [0, 0], "direction": 90}},
    "cams": {
        "main": {
            "cam": "cam", "follower": "follower", "point": "B", "face": 90.0,
            "motion": [{"to": 180, "lift": 9}, {"to": 360, "lift": 0}],
        }
    },
    "drive": {"link": "cam"},
    "start": {"guide": 52.0},
    "outputs": ["guide"],
}  # fmt: skip


def whole(given: Any, **keys: Any) -> Any:
    made = design(given, **keys)
    return whole_design(KINDS[made.kind], made.spec)


def read(figure: Any) -> tuple[float, complex]:
    """Scale of a drawing, and where on the paper its axis lies."""
    (scale,) = (each for each in paper.SCALES if paper.ratio(each) in words(figure))
    across, up = (points_of(line) for line in tagged(figure, "axis"))
    return scale, complex(up[0].real, across[0].imag)


def outlines(figure: Any) -> list[Any]:
    """The edges that a drawing shows, in mm of the part about its axis."""
    scale, axis = read(figure)
    return [(points_of(line) - axis) / scale for line in tagged(figure, "profile")]


def apart(points: Any, lines: Sequence[Any]) -> float:
    """Maximum distance of some points from the chords of lines."""
    found = np.full(len(points), math.inf)
    for line in lines:
        start, chord = line[:-1], np.diff(line)
        start, chord = start[chord != 0.0], chord[chord != 0.0]
        for some in np.array_split(np.arange(len(points)), max(1, len(points) // 200)):
            way = points[some, None] - start
            along = np.clip((way * chord.conj()).real / np.abs(chord) ** 2, 0.0, 1.0)
            found[some] = np.minimum(found[some], np.abs(way - along * chord).min(axis=1))
    return float(found.max())


def cell(figure: Any, item: str) -> float:
    """The value of a line of a table."""
    texts = words(figure)
    return next(float(text) for text in texts[texts.index(item) + 1 :] if text.replace(".", "").isdigit())


def digits(value: float) -> str:
    return f"{value:.3f}".rstrip("0").rstrip(".")


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("given", "sheet", "parts"),
    [
        ("linked_cams", "1", ["x_cam"]),
        ("geneva_drive", "wheel", ["wheel"]),
        ("cam_gear", "groove", ["groove_inner", "groove_outer"]),
        ("geneva_drive", "driver", ["driver"]),
        ("cycloidal_reducer", "disc", ["disc"]),
        ("cam_linkage", "groove", ["groove_inner", "groove_outer"]),
        ("linked_cams", "2", ["y_cam"]),
        ("planar_cam", "1", ["cam"]),
        (UNDER_A_FACE, "1", ["main"]),
        ("mutilated_gear_press", "wheel", ["wheel"]),
    ],
)
def test_an_outline_is_the_one_that_is_exported(given: Any, sheet: str, parts: list[str]) -> None:
    made = whole(given)
    figure = sheets_of(made)[f"drawing-{sheet}"]()
    exported = [
        line.nodes
        for part in parts
        for line in contour(makers(made)[part](), FINE, CurveForm.POLYLINE).lines
        if line.layer == "PROFILE"
    ]
    drawn = outlines(figure)
    assert len(drawn) == len(exported)
    most = FINE + CHORDS / read(figure)[0]
    assert apart(np.concatenate(drawn), exported) <= most
    assert apart(np.concatenate(exported), drawn) <= most


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("keys", "side"),
    [
        ({}, 1.0),
        ({"type": "internal", "slots": 5, "locking_radius": 30.0, "hub_radius": None}, -1.0),
        ({"slots": 4, "slot_clearance": 0.05, "locking_clearance": 0.02, "hub_radius": 20.0}, 1.0),
    ],
)
def test_a_geneva_wheel_has_the_sizes_of_its_triangle(keys: dict[str, Any], side: float) -> None:
    """r = a sin(pi/n), mouths at a cos(pi/n), bottoms where the pin is on the line of centres."""
    made = whole("geneva_drive", compare=None, **keys)
    spec, figure = made.spec, part_drawing.drawn(whole("geneva_drive", compare=None, **keys))["wheel"]()
    n, a, half = spec.slots, 120.0, math.pi / spec.slots
    wide, hollow = 16.0 + spec.slot_clearance, spec.locking_radius + spec.locking_clearance
    crank, mouth = a * math.sin(half), a * math.cos(half)
    bottom = a - side * (crank + 0.5 * wide)
    shown = set(words(figure))
    assert {f"{n} × {digits(wide)}", f"{n} × R{digits(hollow)}", f"R{digits(bottom)}", "120"} <= shown
    assert f"⌀{2.0 * math.hypot(mouth, 0.5 * wide):.3f}" in shown
    assert cell(figure, "radius of the pin's circle") == pytest.approx(crank, rel=5e-6)
    assert cell(figure, "radius of the wheel to the mouths of its slots") == pytest.approx(mouth, rel=5e-6)
    assert cell(figure, "axis to the centre of a slot's bottom") == pytest.approx(a - side * crank, rel=5e-6)
    (wheel,), error = outlines(figure), CHORDS / read(figure)[0]
    arc = wheel[np.abs(np.abs(wheel - cmath.rect(a, half)) - hollow) < 1e-6]
    assert arc.size > 5
    assert np.abs(arc).min() == pytest.approx(a - hollow, abs=error) if side > 0.0 else np.abs(arc).max() == (
        pytest.approx(a + hollow, abs=error))  # fmt: skip


@pytest.mark.quick(2)
@pytest.mark.parametrize(("part", "keys"), [("wheel", {}), ("driver", {}), ("driver", {"slots": 4, "pins": 2})])
def test_a_length_on_the_paper_is_its_words_times_the_scale(part: str, keys: dict[str, Any]) -> None:
    figure = part_drawing.drawn(whole("geneva_drive", compare=None, **keys))[part]()
    scale, _ = read(figure)
    ends = [points_of(line)[0] for line in tagged(figure, "extension line")]
    measured = [abs(one - other) / scale for one, other in zip(ends[::2], ends[1::2], strict=True)]
    if part == "wheel":
        assert measured == pytest.approx([16.0], rel=1e-9)
        return
    n, locking = (keys or {"slots": 6})["slots"], 42.0
    # from (a - a cos(pi/n)) l/r, r = a sin(pi/n), which is l tan(pi/2n); the edges where a pin enters and leaves
    wanted = [
        locking * math.tan(0.5 * math.pi / n),
        120.0 * math.sin(math.pi / n),
        2.0 * locking * math.cos(math.pi / n),
    ]
    assert measured == pytest.approx(wanted, rel=1e-9)
    assert {digits(each) for each in wanted} <= set(words(figure))
    rise = locking * math.sin(math.pi / n) - wanted[0]
    radius = (rise**2 + (0.5 * wanted[2]) ** 2) / (2.0 * rise)  # of the circle through vertex and edges
    assert cell(figure, "radius of a cut-out") == pytest.approx(radius, rel=5e-6)


@pytest.mark.slow
def test_a_shaft_that_the_cut_out_meets_is_no_bore() -> None:
    """At 11.254 mm from the axis the cut-out lies within the shaft of 14 mm; that of a wheel of 4 slots does not."""
    shown = words(part_drawing.drawn(whole("geneva_drive"))["driver"]())
    assert "⌀28 shaft" in shown
    assert any("the shaft of radius 14 mm does not go through the disc" in text for text in shown)
    assert not any("H7" in text for text in shown)
    other = words(part_drawing.drawn(whole("geneva_drive", slots=4, compare=None))["driver"]())
    assert any(text.startswith("⌀28 H7\nkeyway 8 P9") for text in other)
    crescent = part_drawing.drawn(
        whole("geneva_drive", type="internal", slots=5, compare=None, hub_radius=None, locking_radius=40)
    )["driver"]()
    assert "⌀28 shaft" in words(crescent)  # between arc and cut-out, far from the axis


def test_a_disc_is_drawn_without_a_shaft() -> None:
    """`shaft_radius` is an optional key: the cut-out is the same, and no shaft is named."""
    shown = words(part_drawing.drawn(whole("geneva_drive", compare=None, shaft_radius=None))["driver"]())
    assert any("11.2539 mm from" in text for text in shown)
    assert not any("shaft" in text for text in shown)


def test_a_cycloidal_disc_has_lobes_holes_and_its_table() -> None:
    """Ground for pins of 5.01 mm on a circle of 59.98 mm; the profile by the usual equations of x and y."""
    figure = part_drawing.drawn(whole("cycloidal_reducer"))["disc"]()
    circle, pin, e, count = 60.0 - 0.02, 5.0 + 0.01, 3.0, 12
    shown, texts = set(words(figure)), words(figure)
    assert {f"R{circle - e - pin:.3f}", f"R{circle + e - pin:.3f}", "⌀20", "6 × ⌀14 on ⌀60", "12"} <= shown
    assert f"⌀{2.0 * (circle + e - pin):.3f}" in shown
    (disc,) = outlines(figure)
    size = np.abs(disc[:-1])
    assert np.count_nonzero((size > np.roll(size, 1)) & (size >= np.roll(size, -1))) == count - 1
    for k in (0, 7, 15, 30):
        tau = math.pi / (count - 1) * k / 30
        row = texts.index(f"{math.degrees(tau):.4f}")  # every number of the column with the same digits
        lean = math.atan2(math.sin((1 - count) * tau), circle / (e * count) - math.cos((1 - count) * tau))
        x = circle * math.cos(tau) - pin * math.cos(tau + lean) - e * math.cos(count * tau)
        y = circle * math.sin(tau) - pin * math.sin(tau + lean) - e * math.sin(count * tau)
        assert float(texts[row + 1]) == pytest.approx(math.hypot(x, y), abs=5.1e-4)
        assert float(texts[row + 2]) == pytest.approx(math.degrees(math.atan2(y, x)), abs=5.1e-4)


def test_a_ring_has_its_pins() -> None:
    figure = part_drawing.drawn(whole("cycloidal_reducer"))["ring"]()
    assert "12 × ⌀10 on ⌀120" in words(figure)
    # the chord of 30 deg of a circle of 60 mm, by the law of cosines
    chord = math.sqrt(2.0 * 60.0**2 * (1.0 - math.cos(math.radians(30.0))))
    assert cell(figure, "distance of two neighbours' centres") == pytest.approx(chord, rel=5e-6)
    assert cell(figure, "diameter of the circle within the pins") == 110.0


def test_a_groove_lies_a_roller_to_both_sides_of_its_table() -> None:
    """Of a cam-gear: in its dwell the planet rolls on the standing sun, the lever at 85 deg + 20/50 theta."""
    made = whole("cam_gear")
    figure = part_drawing.drawn(made)["groove"]()
    texts, carrier = words(figure), 0.5 * 2.0 * (20 + 50)
    for degree in (0, 37, 120):
        turn, lever = math.radians(degree), math.radians(85.0 + 0.4 * degree)
        place = cmath.rect(1.0, turn) * (carrier + cmath.rect(40.0, lever))
        k = next(k for k in range(len(texts)) if texts[k : k + 2] == [f"{degree}", f"{abs(place):.3f}"])
        assert float(texts[k + 2]) == pytest.approx(math.degrees(cmath.phase(place)) % 360.0, abs=5.1e-4)
    levers = np.radians(made.table("motion", samples=7200)["lever_angle"])
    radii = np.sqrt(carrier**2 + 40.0**2 + 2.0 * carrier * 40.0 * np.cos([levers.max(), levers.min()]))
    assert {f"R{radius:.3f}" for radius in radii.tolist()} <= set(texts)
    scale, axis = read(figure)
    (middle,) = ((points_of(line) - axis) / scale for line in tagged(figure, "pitch curve"))
    error = 2.0 * CHORDS / scale
    for wall in outlines(figure):
        nearest = np.abs(wall[:, None] - middle).min(axis=1)
        assert nearest.min() >= 6.0 - error
        assert apart(wall, [middle]) == pytest.approx(6.0, abs=error)
    assert "⌀12" in texts


@pytest.mark.slow
def test_linked_cams_have_the_radii_of_their_harmonics() -> None:
    """x = 20 cos(theta) above its minimum of -20, base radius 60, the start mark along x."""
    shown = set(words(sheets_of(whole("linked_cams"))["drawing-1"]()))
    assert {f"{80.0 + 20.0 * math.cos(math.radians(degree)):.3f}" for degree in range(360)} <= shown
    assert {"R50.000", "R90.000"} <= shown


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["arc_cam", "tangent_cam", "lift_cam", "swing_gripper"])
def test_words_of_a_bore_keep_clear_of_the_outlines(name: str) -> None:
    figure = sheets_of(whole(name))["drawing-1"]()
    canvas = FigureCanvasAgg(figure)
    (axes,) = (each for each in figure.axes if any(line.get_gid() == "profile" for line in each.lines))
    (note,) = (text for text in axes.texts if "keyway" in text.get_text())
    box = note.get_window_extent(canvas.get_renderer())
    for line in axes.lines:
        if line.get_gid() in ("profile", "pitch curve", "bore"):
            x, y = axes.transData.transform(np.column_stack(line.get_data())).T
            inside = (x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1)
            assert not inside.any(), line.get_gid()


def test_a_planar_cam_has_the_bore_of_its_shaft() -> None:
    shown = words(sheets_of(whole("planar_cam"))["drawing-1"]())
    assert any(text.startswith("⌀30 H7\nkeyway 8 P9") for text in shown)
    if ALL:  # the slowest of the drawings, once more
        bare = words(sheets_of(whole("planar_cam", shafts={}))["drawing-1"]())
        assert not any("H7" in text for text in bare)


@pytest.mark.slow
@pytest.mark.parametrize(("bore", "note"), [([30.0, 60.0], "Hub and tolerances"), (None, "Bore, hub and tolerances")])
def test_a_gear_has_the_bore_of_its_rating(bore: list[float] | None, note: str) -> None:
    """The note said that the file has no bore beside the one that was drawn."""
    shown = words(sheets_of(whole("rated_pair", rating__bore=bore))["drawing-gear2"]())
    assert ("⌀60" in shown) == (bore is not None)
    assert any(text.startswith(note) for text in shown)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["wide_swing_cycle", "wide_swing_twin_cam"])
def test_extreme_radii_are_those_of_the_curve_and_not_of_its_chords(name: str) -> None:
    """At 1:2 the nodes of the outline may miss an extreme by 0.02 mm."""
    made = whole(name)
    for part, make in part_drawing.drawn(made).items():
        ends = []
        for stretch in makers(made)[part]().stretches:
            if "PROFILE" in stretch.layers:
                curve = stretch.points(np.linspace(stretch.low, stretch.high, 100001))[stretch.layers.index("PROFILE")]
                ends += [np.abs(curve).min(), np.abs(curve).max()]
        shown = [float(text[1:]) for text in words(make()) if text[:1] == "R" and text[1:2].isdigit()]
        assert sorted(shown) == pytest.approx([min(ends), max(ends)], abs=5.1e-4)


def test_a_mutilated_wheel_says_how_its_ends_are_cut() -> None:
    shown = words(part_drawing.drawn(whole("mutilated_gear_press"))["wheel"]())
    assert any(text.startswith("1 group of 20 teeth, 80 teeth without gaps") for text in shown)
    assert any(text.startswith("First and last tooth of a group cut to radius") for text in shown)


ODD = [
    ("geneva_drive", {}),
    ("cycloidal_reducer", {"pins": 40, "pin_radius": 2.0, "eccentricity": 1.0}),
    ("geneva_drive", {"slots": 40, "center_distance": 200.0, "pin_radius": 2.0, "locking_radius": 10.0}),
    ("geneva_drive", {"slots": 4, "pins": 2, "center_distance": 3000.0}),
    ("geneva_drive", {"slots": 8, "pin_radius": 4.0, "locking_radius": 30.0, "hub_radius": None}),
    ("geneva_drive", {"slots": 5, "type": "internal", "locking_radius": 30.0, "hub_radius": None}),
    ("geneva_drive", {"slots": 3, "pin_radius": 4.0, "locking_radius": None, "hub_radius": None}),
    ("cycloidal_reducer", {"pins": 6, "eccentricity": 1.0, "output_pins": None, "friction": None}),
    ("cycloidal_reducer", {"width": 80.0, "pin_circle_radius": 150.0}),
    ("cam_gear", {"roller_radius": 2.0}),
    ("cam_linkage", {}),
    ("linked_cams", {"cams__x__roller_radius": 30.0}),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "keys"), ODD)
def test_words_keep_clear_and_within_the_frame_at_odd_proportions(name: str, keys: dict[str, Any]) -> None:
    given = {"compare": None, **keys} if name == "geneva_drive" else keys
    drawings = {sheet: make for sheet, make in sheets_of(whole(name, **given)).items() if sheet.startswith("drawing")}
    assert drawings
    for sheet, make in drawings.items():
        figure = settled(make())
        assert meetings(figure) == [], sheet
        wide, tall = figure.get_size_inches() * 25.4
        drawn = np.concatenate([line.get_xydata() for line in figure.axes[0].lines])
        assert np.all(drawn >= np.array([20.0, 10.0]) - 1e-9)
        assert np.all(drawn <= np.array([wide - 10.0, tall - 10.0]) + 1e-9)
        renderer = FigureCanvasAgg(figure).get_renderer()
        for text in (text for axes in figure.axes for text in axes.texts if text.get_text()):
            box = text.get_window_extent(renderer).transformed(figure.transFigure.inverted())
            assert 20.0 / wide <= box.x0 <= box.x1 <= 1.0 - 10.0 / wide, text.get_text()
            assert 10.0 / tall <= box.y0 <= box.y1 <= 1.0 - 10.0 / tall, text.get_text()
