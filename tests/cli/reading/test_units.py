"""Values with units: exact conversions against their definitions in 60 digits, where they are taken, and refusals."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

import mpmath
import pytest

from gearlink.cli.reading.design_file import parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.reading.units import UNITS, convert, converted, split, wrong_unit
from gearlink.core.base.kinds import KINDS
from gearlink.core.machines.slider_crank.spec import SliderCrankSpec

HEAD = b"kind: slider-crank\n"


def validate_units(loaded: Any, kind: str) -> None:
    """Put numbers instead of the values with units; nothing may be left to say."""
    assert convert(loaded, KINDS[kind].spec_model()) == []


def spec(text: str, kind: str = "slider-crank") -> Any:
    return validate(parse(f"kind: {kind}\n{text}".encode(), "x.yaml"), KINDS[kind].spec_model())


@pytest.mark.parametrize(
    ("text", "unit", "exact"),
    [
        ("4.5 in", "mm", "4.5 * 25.4"), ('1"', "mm", "25.4"), ("2 ft", "mm", "609.6"), ("3 thou", "mm", "0.0762"),
        ("7 mil", "mm", "0.1778"), ("12.7 cm", "mm", "127"), ("0.3 m", "mm", "300"), ("5 um", "mm", "0.005"),
        ("1 rad", "deg", "180/pi"), ("3 mrad", "deg", "0.54/pi"), ("30'", "deg", "0.5"), ("36 arcsec", "deg", "0.01"),
        ("2 Hz", "1/min", "120"), ("1 rad/s", "1/min", "30/pi"), ("90 deg/s", "1/min", "15"),
        ("8000 sheets/h", "1/min", "8000/mpf(60)"), ("100 sheets/min", "sheets/h", "6000"), ("2 1/h", "sheets/h", "2"),
        ("1.25 1/s", "sheets/h", "4500"), ("2 Hz", "sheets/h", "7200"),
        ("4000 prints/h", "1/min", "4000/mpf(60)"), ("9000 impressions/h", "sheets/h", "9000"),
        ("70 strokes/min", "1/min", "70"), ("7200 iph", "1/min", "120"), ("90 cycles/min", "sheets/h", "5400"),
        ("8000 sph", "sheets/h", "8000"),
        ("1 lbf", "N", "mpf('4.4482216152605')"), ("1 kgf", "N", "mpf('9.80665')"),
        ("1 lbf ft", "N m", "mpf('4.4482216152605') * mpf('0.3048')"), ("5 N mm", "N m", "mpf('0.005')"),
        ("1 lbf/in", "N/mm", "mpf('4.4482216152605') / mpf('25.4')"), ("4 N/m", "N/mm", "mpf('0.004')"),
        ("1 psi", "N/mm^2", "mpf('4.4482216152605') / mpf('25.4')**2"), ("3 bar", "N/mm^2", "mpf('0.3')"),
        ("1 lb", "kg", "mpf('0.45359237')"), ("250 g", "kg", "0.25"),
        ("1 lb in^2", "kg m^2", "mpf('0.45359237') * mpf('0.0254')**2"), ("2 kg cm²", "kg m^2", "mpf('0.0002')"),
        ("1 lbf in s^2", "kg m^2", "mpf('4.4482216152605') * mpf('0.0254')"),
        ("1 hp", "kW", "mpf('0.74569987158227022')"), ("1 PS", "kW", "mpf('0.73549875')"), ("2 g0", "m/s^2", "19.6133"),
        ("5 %", "1", "mpf('0.05')"), ("8000/h", "1/min", "8000/mpf(60)"), ("75 rpm", "sheets/h", "4500"),
        ("1.2 kN m", "N m", "1200"), ("20°", "deg", "20"),
    ],
)  # fmt: skip
def test_conversions_are_the_nearest_numbers(text: str, unit: str, exact: str) -> None:
    with mpmath.workdps(60):
        expected = float(eval(exact, {"pi": mpmath.pi, "mpf": mpmath.mpf}))
    found = split(text)
    assert found is not None
    assert converted(*found, unit) == pytest.approx(expected, rel=3e-16)


@pytest.mark.parametrize(("text", "unit"), [("50 deg", "mm"), ("3 mm", "1"), ("3 mm", "teeth"), ("12 DP", "mm")])
def test_units_that_do_not_belong_there(text: str, unit: str) -> None:
    found = split(text)
    assert found is not None
    assert converted(*found, unit, "stroke") is None


def test_a_value_is_rounded_once() -> None:
    assert converted("0.3", "in", "mm") == 7.62 != 0.3 * 25.4
    assert converted("4.5", "in", "mm") == 114.3
    assert all(isinstance(factor, Fraction) for names in UNITS.values() for factor in names.values())


def test_where_values_with_units_stand() -> None:
    made = spec(
        'stroke: "4.5 in"\nrod: 20 in\noffset: -1 in\ninput_speed: 7200 sheets/h\nlimits: {transmission_angle: 0.5 rad}'
    )
    assert (made.stroke, made.rod, made.offset, made.input_speed) == (114.3, 508.0, -25.4, 120.0)
    assert made.limits.transmission_angle == pytest.approx(28.64788975654116, rel=1e-15)
    pair = spec("module: 12 DP\nteeth: [24, 36]\nprofile_shift: [0.1, -0.1]", "gear-pair")
    assert pair.module == 25.4 / 12
    press = spec("links: {crank: 40, coupler: 4 in, rocker: 80, frame: 120}\ncoupler_point: [2 in, 5]", "crank-rocker")
    assert press.coupler_point == [50.8, 5.0]
    assert spec("name: 12 in press\nstroke: 1\nrod: 2").name == "12 in press"


def test_units_are_those_of_the_keys() -> None:
    made = spec(
        "layout: twin-cam\nswing: 2 rad\ncycle_angle: 120\nspeed: 1 Hz\ninertia: 300 kg cm^2\n"
        "unloader: {type: pneumatic, pivot_ratio: 2.5, arm: 12 cm}\ncam: {center_distance: 20 cm, roller_radius: 8}\n",
        "wide-swing-cam",
    )
    found = (made.swing, made.speed, made.inertia, made.unloader.arm, made.cam.center_distance)
    assert found == (pytest.approx(114.59155902616465, rel=1e-15), 60.0, 0.03, 120.0, 200.0)


CAM = (
    "motion: [{to: 90, lift: LIFT}, {to: 180}, {to: 270, lift: 0}, {to: 360}]\nfollower: {type: TYPE}\n"
    "cam: {prime_radius: 60}\nspring: {preload: FORCE}"
)


def cam(follower: str, lift: str, force: str) -> Any:
    text = CAM.replace("LIFT", lift).replace("TYPE", follower).replace("FORCE", force)
    return spec(text, "disc-cam")


def test_units_of_a_cam_go_with_its_follower() -> None:
    rocks = "oscillating-roller, roller_radius: 12, arm: 90, center_distance: 120"
    made = cam(rocks, "0.25 rad", "3000 N mm")
    assert made.motion[0].lift == pytest.approx(14.32394487827058, rel=1e-15)
    assert made.spring.preload == 3.0
    slides = cam("translating-roller, roller_radius: 12", "1 in", "2 kN")
    assert (slides.motion[0].lift, slides.spring.preload) == (25.4, 2000.0)
    with pytest.raises(DesignFileError) as refused:
        cam(rocks, "18 mm", "5 N")
    assert [found.message for found in refused.value.diagnostics] == [
        "mm is a length, motion[0].lift is in deg", "N is a force, spring.preload is in N m"
    ]  # fmt: skip


TABLE = [["0 deg", "0 mm"], ["0.5 rad", "1 in"], [180, 20], [360, "0 mm"]]


def test_cells_of_a_table_have_the_unit_of_their_column() -> None:
    text = "motion: {table: TABLE}\nfollower: {type: TYPE}\ncam: {prime_radius: 60}".replace("TABLE", str(TABLE))
    made = spec(text.replace("TYPE", "translating-roller, roller_radius: 9"), "disc-cam")
    assert made.motion.table[1] == pytest.approx([28.64788975654116, 25.4], rel=1e-15)
    with pytest.raises(DesignFileError) as refused:
        spec(text.replace("TYPE", "oscillating-roller, roller_radius: 9, arm: 90, center_distance: 120"), "disc-cam")
    assert [found.message for found in refused.value.diagnostics] == [
        f"{unit} is a length, motion.table[{row}][1] is in deg" for row, unit in ((0, "mm"), (1, "in"), (3, "mm"))
    ]
    turned = spec(
        "gears: {module: 2, sun: 20, planet: 20}\nlever: {length: 20, angle: 90}\nroller_radius: 5\n"
        "motion: {table: [[0, 0], [1 rad, 0.1 rad], [200, 8], [360, 0]]}", "cam-gear"
    )  # fmt: skip
    assert turned.motion.table[1] == pytest.approx([57.29577951308232, 5.729577951308232], rel=1e-15)


def test_bars_and_sections_read_later_take_units() -> None:
    """The length of a bar stands among names; the material of a gear is a model that is imported when it is there."""
    made = spec(
        "frame: {A: [0, 0], D: [6 in, 0]}\nlinks: {crank: [A, B, 2 in], coupler: [B, C, 6 in], rocker: [D, C, 5 in]}\n"
        "drive: {link: crank}\nstart: {coupler: 30, rocker: 90}", "planar-mechanism"
    )  # fmt: skip
    assert made.links["crank"] == ["A", "B", 50.8]
    pair = spec(
        "module: 2\nteeth: [20, 40]\nprofile_shift: [0, 0]\n"
        "material: {contact_limit: [1 GPa, 900], bending_limit: 60 ksi}",
        "gear-pair",
    )
    assert pair.material.contact_limit == [1000.0, 900.0]
    assert pair.material.bending_limit == pytest.approx(413.6854375901017, rel=1e-12)


def test_loads_and_set_take_units() -> None:
    loaded = parse(HEAD + b"stroke: 310\nrod: 520\nloads: {speed: 2 Hz, links: {slider: {mass: 10 lb}}}", "x.yaml",
                   overrides=["stroke=0.31 m"])  # fmt: skip
    made = validate(loaded, SliderCrankSpec)
    assert (made.stroke, made.loads.speed, made.loads.links.slider.mass) == (310.0, 120.0, 4.5359237)


def test_sizes_of_a_source_have_the_unit_of_the_key_that_it_names() -> None:
    """Lengths and angles, columns of lists and parts without a key; what has a unit of its own keeps it."""
    text = (
        "arm: {length: 300, direction: 125}\nlinks: {input: 150, coupler: 260, output: 100}\n"
        "pivots: {input: [230, 0], output: [498, 55]}\ntolerance: {sources: {arm.direction: {plus_minus: 3 arcmin}, "
        "links.input: {limits: [-1 thou, 20 um], law: triangular, mode: 5 um}, 'pivots.output[0]': {sigma: 1 mil}, "
        "pins.C: {fit: H7/g6, size: 2 cm}, pins.D: {clearance: [2 um, 8 um]}, "
        "links.output: {measured: 4 in}}}\nregister: {tolerance: 4 thou}"
    )
    sources = parse(f"kind: swing-gripper\n{text}".encode(), "x.yaml")
    validate_units(sources, "swing-gripper")
    found = sources.data["tolerance"]["sources"]
    assert found["arm.direction"]["plus_minus"] == pytest.approx(0.05, rel=1e-15)
    assert found["links.input"]["limits"] == pytest.approx([-0.0254, 0.02], rel=1e-15)
    assert found["links.input"]["mode"] == pytest.approx(0.005, rel=1e-15)
    assert found["pivots.output[0]"]["sigma"] == pytest.approx(0.0254, rel=1e-15)
    assert (found["pins.C"]["size"], found["links.output"]["measured"]) == (20.0, pytest.approx(101.6, rel=1e-15))
    assert found["pins.D"]["clearance"] == pytest.approx([0.002, 0.008], rel=1e-15)


def test_a_source_in_another_unit_than_its_key_is_refused() -> None:
    text = "stroke: 310\nrod: 520\ntolerance: {sources: {stroke: {plus_minus: 1 arcmin}, rod: {sigma: 2 thou}}}"
    with pytest.raises(DesignFileError) as refused:
        spec(text)
    assert [(found.code, found.message) for found in refused.value.diagnostics] == [
        ("GL181", "arcmin is an angle, tolerance.sources.stroke.plus_minus is in mm")
    ]


def test_a_key_whose_unit_is_not_known_is_not_told_to_lose_one() -> None:
    """The lift at a cam pair of a planar mechanism is mm or deg, as the follower is a slide or a link."""
    text = (
        "frame: {O: [0, 0], A: [100, 0]}\nlinks: {cam: {O: [0, 0]}, arm: [A, R, 60]}\ndrive: {link: cam}\n"
        "cams: {pair: {cam: cam, follower: arm, roller_radius: 9, point: R, "
        "motion: [{to: 180, lift: 5 thou}, {to: 360, lift: 0}]}}\nstart: {arm: 150}"
    )
    with pytest.raises(DesignFileError) as refused:
        spec(text, "planar-mechanism")
    helps = [found.help for found in refused.value.diagnostics if found.key == "cams.pair.motion[0].lift"]
    assert helps == ["a unit is not allowed here: convert the number to the unit of this key"]


def test_play_of_the_teeth_is_a_length() -> None:
    assert spec("stroke: 310\nrod: 520\nloads: {speed: 60, backlash: 2 thou}").loads.backlash == 0.0508


@pytest.mark.parametrize(
    ("text", "code", "key", "words"),
    [
        ("stroke: 4.5 kg\nrod: 520", "GL181", "stroke", "kg is a mass, stroke is in mm"),
        ("stroke: 12 DP\nrod: 520", "GL181", "stroke", "applies only to module"),
        ("stroke: 310\nrod: 5 inh", "GL180", "rod", "no unit 'inh'"),
        ("stroke: 310\nrod: 520\ninput_speed: 5 mm", "GL181", "input_speed", "mm is a length"),
        ("stroke: 310\nrod: 520\nloads: {speed: 60, links: {slider: {mass: 3 stones}}}", "GL180",
         "loads.links.slider.mass", "no unit 'stones'"),
        ("stroke: 2O\nrod: 520", "GL107", "stroke", "must be a number"),
        ("stroke: -4 in\nrod: 520", "GL108", "stroke", "greater than 0"),
    ],
)  # fmt: skip
def test_refused(text: str, code: str, key: str, words: str) -> None:
    with pytest.raises(DesignFileError) as refused:
        spec(text)
    (found,) = refused.value.diagnostics
    assert (found.code, found.key) == (code, key)
    assert words in found.message


def test_german_degrees_are_no_radians() -> None:
    assert wrong_unit("Grad", "deg", "angle")[2].startswith("did you mean deg?")


def test_teeth_take_no_unit() -> None:
    with pytest.raises(DesignFileError) as refused:
        spec("module: 2\nteeth: [24 in, 36]\nprofile_shift: [0, 0]", "gear-pair")
    assert {found.code for found in refused.value.diagnostics} == {"GL107"}


def test_save_keeps_the_text(gearlink: Any, tmp_path: Any) -> None:
    file = tmp_path / "inch.yaml"
    file.write_text('kind: slider-crank\nstroke: "4.5 in"\nrod: 20 in\noffset: 3\n')
    out = gearlink("crank", file, "--save", "-", "--set", "offset=1 in", "--set", "rod=500").out
    assert 'stroke: "4.5 in"' in out
    assert 'offset: "1 in"' in out
    assert "rod: 500" in out
    value = gearlink("crank", file, "--set", "offset=1 in", "--quantity", "crank_length").out
    assert value.split()[1] == "mm"
    assert float(value.split()[0]) == pytest.approx(57.077600921053005, rel=1e-12)
