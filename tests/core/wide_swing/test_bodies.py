"""Links beside the shafts of cam, rocker and crank, against closed forms (1e-9) and dense rows (1 to 3 mm)."""

from __future__ import annotations

import cmath
import math
import random
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing import bodies
from gearlink.core.parts.linkages.fourbar.position import FourBar

SECTION = {"center_distance": 200, "roller_radius": 8, "shaft_radius": 25}


def told(design: Any) -> dict[str, float]:
    """Values of the findings, by their words; all are warnings."""
    found = design.check("body-clearance")
    assert {check.status for check in found} <= {"warn"}
    assert {(check.code, check.name) for check in found} <= {("GL302", "body-clearance")}
    return {"; ".join(check.lines): check.value for check in found}


def only(design: Any, words: str) -> float:
    ((message, value),) = told(design).items()
    assert words in message
    return value


# What passed without a word


@pytest.mark.parametrize("angle", [150, 140, 130, -130, -150])
def test_a_rod_that_folds_over_the_rocker_is_warned_of(angle: float) -> None:
    changes = {"slider__middle_angle": angle, "inertia": 2, "slider__mass": 0.5}
    value = only(factory.design("wide_swing_slider_cam", **changes), "rod passes over the rocker's axis")
    assert value == pytest.approx(0.0, abs=1e-9)


def test_a_rod_over_the_cam_shaft_is_warned_of() -> None:
    design = factory.design("loaded_swing_slider", command="loads", loads__slider_direction=-24)
    assert only(design, "slider's rod passes over the cam shaft") == pytest.approx(-25.0, abs=1e-9)


def test_a_device_over_the_cam_shaft_is_warned_of() -> None:
    design = factory.design("loaded_wide_swing", command="loads", loads__device_direction=0)
    assert only(design, "the device passes over the cam shaft") == pytest.approx(-25.0, abs=1e-9)


def test_a_device_round_its_own_rocker_is_warned_of() -> None:
    design = factory.design("wide_swing_twin_cam", unloader__arm=3)
    assert only(design, "distance of the device from the rocker's axis: 3 mm") == pytest.approx(3.0, rel=1e-12)
    assert "set unloader.arm to at least 8 mm" in next(iter(told(design)))
    assert not told(factory.design("wide_swing_twin_cam", unloader__arm=8))


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("drive", "words"),
    [
        (
            (1, 10, 2.4, 10.225),
            [
                "distance of pin C of the drive from the cam shaft: 2.4 mm",
                "distance of the crank's axis from the cam shaft: 10.22 mm",
            ],
        ),
        (
            (10, 100, 24, 102.25),
            ["distance of pin C of the drive from the cam shaft: 24 mm", "overlap of the cam and the crank's axis"],
        ),
        (
            (10.5, 105, 25.2, 107.3625),
            ["distance of the coupler of the drive from the cam shaft", "overlap of the cam and the crank's axis"],
        ),
    ],
)
def test_a_small_drive_is_warned_of(drive: tuple[float, ...], words: list[str]) -> None:
    lengths = dict(zip(("crank", "coupler", "rocker", "frame"), drive, strict=True))
    design = factory.design("wide_swing_oscillating_cam", drive=lengths)
    assert [word in text for word, text in zip(words, told(design), strict=True)] == [True, True]


def test_an_arm_that_turns_over_the_cam_shaft_is_warned_of() -> None:
    spec = {
        "kind": "wide-swing-cam",
        "layout": "twin-rocker",
        "swing": 270,
        "cycle": {"working": 270, "far_dwell": 8, "return": 70, "near_dwell": 12},
        "speed": 30,
        "inertia": 0.3,
        "unloader": {"type": "pneumatic", "pivot_ratio": 8, "arm": 40, "reserve": 0.3},
        "cam": {"center_distance": 150, "roller_radius": 1, "shaft_radius": 110, "free_clearance": 0.1},
        "limits": {"pressure_angle": 55},
    }
    value = only(
        factory.design(spec), "distance of the arm of the internal profile's roller from the cam shaft: 106 mm"
    )
    assert value == pytest.approx(150.0 * math.sin(math.radians(135.0)) - 110.0, rel=1e-12)


@pytest.mark.parametrize("name", ["twin_cam", "twin_rocker", "slider_cam", "oscillating_cam", "cycle"])  # the examples
def test_worked_designs_keep_clear(name: str) -> None:
    assert not told(factory.design(f"wide_swing_{name}"))


@pytest.mark.parametrize("name", ["wide_swing", "swing_slider", "swing_cycle", "oscillating_cam"])
def test_worked_loads_keep_clear(name: str) -> None:
    assert not told(factory.design(f"loaded_{name}", command="loads"))


# What clears them


@pytest.mark.slow
def test_remedies_of_links_that_meet_shafts_are_clear() -> None:
    arm = factory.design("wide_swing_twin_cam", unloader__arm=3)
    assert list(arm.candidates("body-clearance")) == [(("unloader.arm", 8.0),)]
    placed = factory.design("loaded_swing_slider", command="loads", loads__slider_direction=-24)
    remedies = [change for change in placed.candidates("body-clearance") if change[0][0] == "loads.slider_direction"]
    assert len(remedies) == 2
    for ((_, direction),) in remedies:
        assert not told(factory.design("loaded_swing_slider", command="loads", loads__slider_direction=direction))


# Distances against dense rows


def rows_to_line(point: complex, start: np.ndarray, end: np.ndarray, steps: int = 301) -> float:
    """The nearest of points strung along each line."""
    share = np.linspace(0.0, 1.0, steps)[:, None]
    return float(np.abs(start + share * (end - start) - point).min())


@pytest.mark.slow
def test_device_and_rod_against_dense_rows() -> None:
    rng = random.Random(7)
    for _ in range(60):
        swing, ratio = math.radians(rng.uniform(20, 300)), rng.uniform(1.05, 6.0)
        phi = np.linspace(-0.5, 0.5, 801) * swing
        found = bodies.device_room(ratio, swing)
        assert found == pytest.approx(rows_to_line(0j, np.exp(1j * phi), np.full(801, ratio + 0j)), abs=1e-4 * ratio)
        crank, middle, offset = rng.uniform(50, 200), rng.uniform(-math.pi, math.pi), rng.uniform(-30, 30)
        rod = crank + abs(offset) + rng.uniform(20, 400)
        pin = crank * np.exp(1j * (phi + middle))
        end = pin.real + np.sqrt(rod**2 - (pin.imag + offset) ** 2) - 1j * offset
        drive = bodies_drive(crank, rod, middle, offset)
        place = cmath.rect(rng.uniform(0, 400), rng.uniform(0, 6.3)) if rng.random() < 0.7 else 0j
        rows = rows_to_line(place, pin, end)
        assert rows - 1.5 <= bodies.rod_room(drive, swing, place) <= rows + 1e-9


def bodies_drive(crank: float, rod: float, middle: float, offset: float) -> Any:
    from gearlink.core.machines.wide_swing.slider import SliderDrive

    return SliderDrive(crank, rod, middle, offset)


@pytest.mark.slow
def test_lever_against_dense_rows() -> None:
    rng = random.Random(8)
    for _ in range(100):
        length, aside = rng.uniform(10, 300), rng.uniform(-10, 10)
        swing, reach = math.radians(rng.uniform(20, 300)), rng.uniform(50, 300)
        tips = length * np.exp(1j * np.linspace(-0.5, 0.5, 801) * swing)
        rows = rows_to_line(cmath.rect(reach, aside), np.zeros(801), tips)
        assert rows - 1.0 <= bodies.swept_room(length, aside, swing, reach) <= rows + 1e-9


@pytest.mark.slow
def test_coupler_against_dense_rows() -> None:
    rng, seen = random.Random(9), 0
    theta = np.linspace(0.0, 2.0 * math.pi, 721)
    while seen < 60:
        lengths = [rng.uniform(20, 200) for _ in range(4)]
        bar = FourBar(*lengths)
        try:
            if bar.kind() != "crank-rocker":
                continue
        except NoSolution:
            continue
        seen += 1
        pin = bar.crank * np.exp(1j * theta)
        away = bar.frame - pin
        turn = np.arccos((np.abs(away) ** 2 + bar.coupler**2 - bar.rocker**2) / (2 * np.abs(away) * bar.coupler))
        end = pin + bar.coupler * np.exp(1j * (np.angle(away) + turn))
        rows = rows_to_line(complex(bar.frame), pin, end, 401)
        assert rows - 1.0 <= bodies.coupler_room(bar) <= rows + 1e-9


PLACED = {
    "device_direction": "the device",
    "slider_direction": "the slider's rod",
    "drive_direction": "of the drive",
}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("loaded_wide_swing", "device_direction"),
        ("loaded_swing_cycle", "device_direction"),
        ("loaded_swing_slider", "slider_direction"),
        ("loaded_oscillating_cam", "drive_direction"),
    ],
)
def test_what_a_direction_places_against_the_links_of_the_loads(name: str, key: str) -> None:
    """The minimum distance of rows of the mechanism that the loads are computed with, in directions all round."""
    warned = 0
    for direction in range(-180, 180, 15):
        design = factory.design(name, command="loads", **{f"loads__{key}": direction})
        phi = np.linspace(0.0, design.machine.period, 361)
        links, spec = design.machine.at(phi).links, design.spec
        pivot = links["rocker"].origin.value
        point, needed = 0j, spec.cam.shaft_radius
        if key == "device_direction":
            arm, way = spec.unloader.arm, cmath.rect(1.0, math.radians(direction))
            lines = [(links["rocker"].at(arm * way).value, pivot + way * arm * spec.unloader.pivot_ratio)]
        elif key == "slider_direction":
            lines = [(links["rod"].origin.value, links["slider"].origin.value)]
        else:
            point, needed = complex(pivot[0]), spec.cam.roller_radius
            lengths = {"crank": spec.drive.crank, "coupler": spec.drive.coupler}
            lines = [(links[each].origin.value, links[each].at(size).value) for each, size in lengths.items()]
        rows = min(rows_to_line(point, start, end, 101) for start, end in lines)
        found = [value for text, value in told(design).items() if PLACED[key] in text]
        expected = rows - needed if key != "drive_direction" else rows
        if found:
            warned += 1
            assert expected - 3.0 <= min(found) <= expected + 1e-6
        else:
            assert rows > needed - 1e-6
    assert warned
