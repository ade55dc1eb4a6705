"""Gears of linkages with teeth of their own: what is drawn and exported is what is cut, at the machine's distances.

Tolerances
* drawn outlines keep within 0.012 module of the teeth: two of them overlap, or miss each other, by no more than 0.03.
* exported teeth are those of the gear pair of the same data, to the last bit.
"""

import math

import numpy as np
import pytest
from factory import design, worked
from matplotlib.path import Path as Polygon

from gearlink.cli.export import parts
from gearlink.cli.export.contour import contour
from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.rexs import as_rexs
from gearlink.cli.views.scenes.linkages import builder
from gearlink.cli.views.scenes.scene import Body

MODULE = 2.5
DRAWN = {
    "three": {"kind": "three-gear-four-bar", "links": {"crank": 18, "frame": 150},
              "gears": {"module": MODULE, "crank": 24, "idler": 28, "output": 60, "profile_shift": [0.3, 0.2, -0.1],
                        "helix_angle": 12}},
    "ring on the crank": {"kind": "three-gear-four-bar", "links": {"crank": 10, "frame": 100},
                          "gears": {"module": MODULE, "crank": -80, "idler": 40, "output": 30,
                                    "profile_shift": [-0.2, 0.3, 0.1]}},
    "sun": {"kind": "two-gear-four-bar", "links": {"coupler": 100, "rocker": 110, "frame": 20},
            "gears": {"module": MODULE, "planet": 31, "sun": 19, "profile_shift": [0.1, 0.4]}},
    "ring": {"kind": "two-gear-four-bar", "links": {"coupler": 60, "rocker": 80, "frame": 90},
             "gears": {"module": MODULE, "planet": 30, "ring": 62, "profile_shift": [0.3, -0.1], "rim": 90,
                       "cutter": {"teeth": 22}}},
    "rocker": {"kind": "geared-rocker", "links": {"crank": 20, "coupler": 75, "frame": 76},
               "gears": {"module": MODULE, "coupler": 28, "output": 20, "profile_shift": [0.2, 0.3]}},
    "hypocycloid": {"kind": "hypocycloid-dwell", "rod": {"rule": "osculating"},
                    "gears": {"module": MODULE, "planet": 24, "ring": 72, "profile_shift": [0.5, 0.3]}},
    "mutilated": {"kind": "mutilated-gear-dwell", "reduction": 6,
                  "gears": {"module": MODULE, "full_teeth": 80, "group_teeth": 20, "driven": 20,
                            "profile_shift": [0.1, 0.3]}},
    "idler": {"kind": "geared-five-bar", "phase": 60, "coupler_point": {"along": 40},
              "links": {"input": 30, "coupler": 90, "follower": 90, "output": 30, "frame": 70},
              "gears": {"module": MODULE, "input": 20, "idler": 15, "output": 22, "profile_shift": [0.2, 0.5, -0.1],
                        "idler_side": -1}},
    "input in a ring": {"kind": "geared-five-bar", "phase": 60, "coupler_point": {"along": 40},
                        "links": {"input": 30, "coupler": 90, "follower": 90, "output": 30},
                        "gears": {"module": MODULE, "input": 72, "output": 36, "mesh": "internal",
                                  "profile_shift": [-0.1, 0.25]}},
    "function": {"kind": "geared-five-bar", "form": "function", "phase": 0,
                 "links": {"coupler": 40, "follower": 160, "output": 160, "frame": 90},
                 "gears": {"module": MODULE, "planet": 20, "sun": 40, "profile_shift": [0.3, 0.1]}},
}  # fmt: skip


def teeth_at(body, index):
    """The outline of a gear, finely enough for the distance of two of them."""
    outline = body.outline * np.exp(1j * body.turn[min(index, len(body.turn) - 1)])
    return outline + body.place[min(index, len(body.place) - 1)]


def toothed(scene):
    return [part for part in scene.parts if isinstance(part, Body) and part.repeats > 12]


def meshing(design, bodies, index):
    """Pairs of gears whose axes stand at the working distance of a mesh of theirs, a ring second."""
    found = []
    for name, teeth in zip(design.mesh_names, design.teeth_train.places, strict=True):
        pair = [next(body for body in bodies if body.repeats == abs(z)) for z in teeth.teeth]
        one, other = (body.place[min(index, len(body.place) - 1)] for body in pair)
        assert abs(one - other) == pytest.approx(design.distance(name), rel=1e-9)
        found.append((*pair, teeth.teeth[1] < 0))
    return found


def depth(points, polygon, inside):
    """How far points lie inside (or outside) of a polygon at most, and the minimum distance of any from it."""
    contained = Polygon(np.column_stack([polygon.real, polygon.imag])).contains_points(
        np.column_stack([points.real, points.imag])
    )
    ends = np.roll(polygon, -1)
    way = ends - polygon
    share = ((points[:, None] - polygon) * way.conj()).real / np.maximum(np.abs(way) ** 2, 1e-300)
    gap = np.abs(points[:, None] - polygon - np.clip(share, 0.0, 1.0) * way).min(axis=1)
    return gap[contained if inside else ~contained].max(initial=0.0), gap.min()


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", [name for name in DRAWN if name != "mutilated"])  # its wheel has cut teeth
def test_drawn_teeth_touch_and_do_not_overlap(name):
    made = design(DRAWN[name])
    build = builder(made.kind)
    fractions = np.array([0.0, 0.137, 0.61])
    bodies = toothed(build(made, fractions))
    for index in range(len(fractions)):
        for one, other, ring in meshing(made, bodies, index):
            first, second = teeth_at(one, index), teeth_at(other, index)
            touch = one.place[index] - (one.place[index] - other.place[index]) * (
                -1.0 if ring else 1.0
            ) * one.pitch / abs(one.place[index] - other.place[index])
            near = [points[np.abs(points - touch) < 12.0 * MODULE] for points in (first, second)]
            over, least = depth(near[0], second, inside=not ring)
            assert over < 0.03 * MODULE
            assert least < 0.03 * MODULE


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("name", "part", "gear", "places"),
    [("sun", "gear2", 0, (0, 1)), ("ring", "gear5", 1, (0, 1)), ("rocker", "gear5", 1, (0, 1)),
     ("hypocycloid", "ring", 1, (0, 1)), ("mutilated", "gear2", 1, (0, 1)), ("function", "sun_gear", 1, (0, 1)),
     ("input in a ring", "input_gear", 1, (1, 0))],
)  # fmt: skip
def test_exported_teeth_are_those_of_the_pair(name, part, gear, places):
    made = design(DRAWN[name])
    keys = DRAWN[name]["gears"]
    teeth = made.teeth_train.places[0].teeth
    alone = design(
        {"kind": "gear-pair", "module": MODULE, "teeth": list(teeth)}
        | {"profile_shift": [keys["profile_shift"][i] for i in places]}
        | {key: keys[key] for key in ("cutter",) if key in keys}
    )
    mine, theirs = (
        contour(parts.makers(each)[which](), 1e-3, CurveForm.POLYLINE)
        for each, which in ((made, part), (alone, f"gear{gear + 1}"))
    )
    assert np.array_equal(mine.lines[0].nodes, theirs.lines[0].nodes)
    shift = keys["profile_shift"][places[gear]]
    assert any(f"profile shift {shift:.9g}" in note for note in mine.part.notes)


def test_the_rim_of_the_file_is_drawn_and_exported():
    made = design(DRAWN["ring"])
    circles = {circle.layer: circle.radius for circle in parts.makers(made)["gear5"]().circles}
    assert circles["RIM"] == 90.0
    scene = builder(made.kind)(made, np.zeros(1))
    rims = [part for part in scene.parts if isinstance(part, Body) and part.repeats == 0]
    assert max(abs(rims[0].outline)) == pytest.approx(90.0, rel=1e-12)
    ring = next(gear for gear in made.layout.gears if gear.axis == "A")
    assert (ring.outer, ring.inner) == (90.0, pytest.approx(abs(made.raw("tip_radius")[1]), rel=1e-12))


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", [name for name in DRAWN if name != "mutilated"])
def test_rexs_has_the_shifts_widths_and_hands_of_the_file(name):
    data = DRAWN[name]
    count = len(data["gears"]["profile_shift"])
    widths = [20.0 + i for i in range(count)]
    helical = {"face_width": widths, "helix_angle": 12}
    text = as_rexs(design(data | {"gears": data["gears"] | helical})).decode()
    for shift, width in zip(data["gears"]["profile_shift"], widths, strict=True):
        assert f'<attribute id="addendum_modification_coefficient" unit="none">{shift}</attribute>' in text
        assert f'<attribute id="face_width" unit="mm">{width}</attribute>' in text
    angles = [line for line in text.splitlines() if "helix_angle_reference_diameter" in line]
    assert len(angles) == count
    assert sum("-" in line.partition(">")[2].partition("<")[0] for line in angles) == (
        1 if not made_of_rings(data) else 0 if count == 2 else 1
    )


def made_of_rings(data):
    gears = data["gears"]
    return gears.get("mesh") == "internal" or "ring" in gears or min(gears.get("crank", 1), gears.get("output", 1)) < 0


def test_a_worked_drive_with_shifts_has_the_width_of_its_file():
    made = design(worked("drawn_feed"))
    assert parts.makers(made)["gear5"]().width == made.spec.gears.face_width[2]
    assert math.isfinite(made.gear_gap)
