"""Residual vibration: closed forms, the reference of all laws, and second ways by Fourier series.

1e-12 absolute for residuals over the lift (the reference holds 1e-12), 1e-10 of the largest for periodic states.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.mechanism.dynamics import reduced
from gearlink.core.parts.cams.laws import law
from gearlink.core.studies.loads.vibration import Oscillator, Panelled, PeriodicResponse, harmonics, speed_limit

DATA = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())
LAWS = DATA["residual amplitude of all laws, damping 0.0"]
CYCLOID = DATA["cycloidal rise: residual amplitude"]
PERIODIC = DATA["periodic steady state of a double-dwell cam"]


def rise(name: str, ratio: float) -> Panelled:
    """A rise of 1 in a time of 1."""
    motion = law(name)
    return Panelled.of(
        lambda u: motion.evaluate(np.clip(u, 0.0, 1.0), 2)[2], 0.0, 1.0, motion.joints, 2.0 * math.pi * ratio
    )


@pytest.mark.parametrize("name", LAWS["expected"])
def test_residual_of_every_law(name: str) -> None:
    for ratio, wanted in zip(LAWS["spec"]["ratio"], LAWS["expected"][name], strict=True):
        found = rise(name, ratio).residual(Oscillator(2.0 * math.pi * ratio, 0.0), 1.0)
        assert found == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize(
    ("ratio", "wanted"), list(zip(CYCLOID["spec"]["ratio"], CYCLOID["expected"]["closed_form"], strict=True))
)
def test_cycloid_has_its_closed_form(ratio: float, wanted: float) -> None:
    """|sin pi r|/(pi r |1 - r^2|), 1/2 at r = 1."""
    assert rise("cycloidal", ratio).residual(Oscillator(2.0 * math.pi * ratio, 0.0), 1.0) == pytest.approx(
        wanted, abs=1e-13
    )


def test_speed_scales_the_natural_periods() -> None:
    motion = Panelled.of(
        lambda u: law("cycloidal").evaluate(np.clip(u / 2.0, 0.0, 1.0), 2)[2] / 4.0, 0.0, 2.0, (1.0,), 60.0
    )
    ratio = 1.7
    speed = 3.0
    frequency = 2.0 * math.pi * ratio * speed / 2.0
    closed = abs(math.sin(math.pi * ratio)) / (math.pi * ratio * abs(1.0 - ratio**2))
    assert motion.residual(Oscillator(frequency, 0.0), speed) == pytest.approx(closed, abs=1e-13)


def test_residuals_of_many_speeds_are_those_of_each() -> None:
    motion, oscillator = rise("modified-sine", 12.0), Oscillator(2.0 * math.pi, 0.03)
    speeds = 1.0 / np.linspace(12.0, 1.0, 333)
    each = [motion.residual(oscillator, float(speed)) for speed in speeds]
    assert motion.residuals(oscillator, speeds) == pytest.approx(each, rel=1e-15, abs=1e-16)
    assert np.array_equal(motion.residuals(oscillator, speeds[100:101]), motion.residuals(oscillator, speeds)[100:101])
    assert motion.rough_residuals(oscillator, speeds) == pytest.approx(each, rel=0.0, abs=1e-12 * max(each))


def test_speed_limit_is_where_the_residual_is_what_is_allowed() -> None:
    motion = rise("polynomial-345", 40.0)
    oscillator = Oscillator(2.0 * math.pi, 0.02)
    speeds = 1.0 / np.linspace(40.0, 1.0, 1951)
    found = speed_limit(motion, oscillator, speeds, 0.01)
    assert found is not None
    assert motion.residual(oscillator, found) == pytest.approx(0.01, rel=1e-9)
    assert all(motion.residual(oscillator, float(speed)) <= 0.01 for speed in speeds[speeds < found * 0.999])
    assert speed_limit(motion, oscillator, speeds, 10.0) is None


def _periodic() -> PeriodicResponse:
    spec = PERIODIC["spec"]

    def bend(t: Any) -> Any:
        total = np.zeros_like(t)
        for piece in spec["pieces"]:
            width = piece["end"] - piece["start"]
            u = (t - piece["start"]) / width
            inside = (u >= 0.0) & (u <= 1.0)
            second = law(piece["law"]).evaluate(np.clip(u, 0.0, 1.0), 2)[2]
            total += np.where(inside, piece["lift"] * second / width**2, 0.0)
        return total

    breaks = []
    for piece in spec["pieces"]:
        width = piece["end"] - piece["start"]
        breaks += [piece["start"] + width * x for x in (0.0, *law(piece["law"]).joints, 1.0)]
    oscillator = Oscillator(2.0 * math.pi * spec["natural_frequency"], spec["damping"])
    return PeriodicResponse(bend, spec["period"], tuple(b for b in breaks if b > 0.0), oscillator, 1.0)


def test_periodic_state_of_a_double_dwell_cam() -> None:
    expected, response = PERIODIC["expected"], _periodic()
    at = np.array(PERIODIC["spec"]["at"])
    scale = np.abs(expected["deviation"]).max()
    assert response.deflection(at) == pytest.approx(expected["deviation"], abs=1e-10 * scale)
    amplitude = np.abs(response.state(np.array([0.1, 0.25]))) / response.oscillator.damped
    assert amplitude == pytest.approx(expected["dwell_amplitude"], rel=1e-10)


def test_undamped_resonance_is_not_finite() -> None:
    """For a motion that has the harmonic at the natural frequency, be it of 1e-9 of the greatest."""
    for share in (1.0, 1e-9):
        wave = PeriodicResponse(
            lambda x, s=share: np.cos(x) + s * np.cos(3 * x), 2.0 * math.pi, (), Oscillator(3.0, 0.0), 1.0
        )  # type: ignore[misc]
        assert wave.unbounded
    assert not PeriodicResponse(np.cos, 2.0 * math.pi, (), Oscillator(3.3, 0.0), 1.0).unbounded


def test_undamped_motion_without_the_natural_frequency_is_finite() -> None:
    """x'' = -cos phi at twice and at next to twice its frequency: z = cos/(w_n^2 - 1), whatever the distance."""
    phi = np.linspace(0.0, 6.2, 25)
    for off in (0.0, 1e-13, 1e-11, 1e-8, 1e-5):
        response = PeriodicResponse(lambda x: -np.cos(x), 2.0 * math.pi, (), Oscillator(2.0 + off, 0.0), 1.0)
        assert not response.unbounded
        assert response.deflection(phi) == pytest.approx(np.cos(phi) / (response.oscillator.frequency**2 - 1), abs=1e-6)


def test_a_dwell_through_the_end_of_the_period_has_no_step() -> None:
    """A stiff output follows its gears: what it covers in the dwell is the back-step, which spans crank angle 0."""
    design = factory.design(
        "two_gear_ring", command="loads", loads={"speed": 30, "links": {"output": {"inertia": 0.01}},
                                                 "vibration": {"frequency": 600}}
    )  # fmt: skip
    ((start, width),) = design.vibrating.dwells
    assert start + width > 2.0 * math.pi
    back_step = design.design.back_step_angle
    assert design.twisted_ripple == pytest.approx(back_step, abs=2.0 * design.dwell_twist)
    assert math.degrees(design.dwell_twist) < 1e-2


@pytest.mark.parametrize("damping", [0.03, pytest.param(0.0, marks=pytest.mark.slow)])
def test_a_gear_out_of_balance_leaves_the_vibration_of_the_output(damping: float) -> None:
    """Its period is nine turns; the output moves as in one."""
    idler = {"mass": 0.9, "inertia": 0.0023, "center": [1, 0]}
    vibration = {"frequency": 61.0, "damping": damping}
    one = factory.design("loaded_feed", command="loads", loads__vibration=vibration)
    nine = factory.design("loaded_feed", command="loads", loads__vibration=vibration, loads__links__idler=idler)
    assert (one.turns, nine.turns) == (1, 9)
    for name in ("dwell_twist", "twisted_ripple", "rise_periods", "frequency_ratio"):
        assert nine.raw(name) == pytest.approx(one.raw(name), rel=1e-9), name


@pytest.mark.parametrize("natural", [7.3, 0.1, 0.003])
def test_harmonic_motion_has_its_closed_form(natural: float) -> None:
    """x = cos phi: z = w^2 cos/(w_n^2 - w^2) without damping; a soft spring multiplies rounding by w/w_n."""
    response = PeriodicResponse(lambda phi: -np.cos(phi), 2.0 * math.pi, (), Oscillator(natural, 0.0), 2.0)
    phi = np.linspace(0.0, 6.2, 25)
    loss = max(1.0, 2.0 / natural)
    wanted = 4.0 * np.cos(phi) / (natural**2 - 4.0)
    assert response.deflection(phi) == pytest.approx(wanted, rel=1e-11 * loss, abs=1e-14 * loss)


FEED = {key: value for key, value in DATA["cases"][0]["spec"].items() if key != "at"}


def feed(**vibration: Any) -> Any:
    return factory.design({**FEED, "loads": {**FEED["loads"], "vibration": vibration}}, command="loads")


@pytest.mark.parametrize("way", [1, -1])
def test_dwell_twist_against_a_fourier_series(way: int) -> None:
    """Smooth and periodic: 1024 rows give the steady state to rounding by z_n = -x''_n/(w_n^2 - n^2 w^2 + 2 i ...)."""
    design = feed(frequency=40.0, damping=0.02) if way > 0 else backwards(FEED)
    n = 1024
    phi = np.arange(n) * (2.0 * math.pi / n)
    w, w_n = design.speed, 2.0 * math.pi * 40.0
    assert math.copysign(1.0, w) == way
    order = np.fft.fftfreq(n, 1.0 / n)
    spectrum = np.fft.fft(design.vibrating.bend(phi) * w * w)
    z = np.fft.ifft(-spectrum / (w_n**2 - (order * w) ** 2 + 2j * 0.02 * w_n * order * w)).real
    assert design.vibrating.deflection(phi) == pytest.approx(z, abs=1e-10 * np.abs(z).max())
    assert 0.0 < math.degrees(design.dwell_twist) <= np.abs(z).max()


def backwards(spec: dict[str, Any]) -> Any:
    loads = {**spec["loads"], "speed": -abs(spec["loads"]["speed"]), "vibration": {"frequency": 40.0, "damping": 0.02}}
    return factory.design({**spec, "loads": loads}, command="loads")


@pytest.mark.quick(1)
@pytest.mark.parametrize("frequency", [9.0, 60.0])
def test_the_mirror_image_that_turns_the_other_way_vibrates_alike(frequency: float) -> None:
    """A ring that stands over a window, which is the same from either end; its motion has no symmetry of its own."""
    links = {"crank": 23.54, "frame": 53.77}
    ring = {"kind": "three-gear-four-bar", "gears": {"module": 1, "crank": 48, "idler": 36, "output": -118}}
    vibration = {"frequency": frequency, "damping": 0.05}
    both = []
    for side in (1, -1):
        loads = {"speed": 120 * side, "links": {"output": {"inertia": 0.01}}, "vibration": vibration}
        spec = {**ring, "links": links, "assembly": side, "dwell": {"tolerance": 0.5}, "loads": loads}
        both.append(factory.design(spec, command="loads"))
    one, two = both
    assert math.degrees(one.dwell_twist) > 1e-4
    assert two.rise_periods == pytest.approx(one.rise_periods, rel=1e-9)
    assert two.dwell_twist == pytest.approx(one.dwell_twist, rel=1e-9)
    assert two.twisted_ripple == pytest.approx(one.twisted_ripple, rel=1e-9)


def test_stiffness_with_the_output_s_inertia_is_a_frequency() -> None:
    by_stiffness = feed(stiffness=0.016 * (2.0 * math.pi * 40.0) ** 2)
    assert by_stiffness.natural_frequency == pytest.approx(40.0, rel=1e-12)
    assert by_stiffness.dwell_twist == pytest.approx(feed(frequency=40.0).dwell_twist, rel=1e-12)


@pytest.mark.parametrize("name", ["loaded_six_bar", "crank_rocker_links"])
def test_an_output_vibrates_about_its_axis(name: str) -> None:
    """Its centre of mass lies 40 mm from it: against the inertia that the input feels of it, and the table's torque."""
    made = factory.design(name, command="loads", loads__vibration={"stiffness": 500.0})
    phi = np.array([1.0])
    links, mass = made.machine.at(phi), made.masses[made.output]
    assert abs(mass.center) == 40.0
    felt = reduced(links, {made.output: mass}, [], 0j).inertia[0] / links.links[made.output].turn.first[0] ** 2
    assert made.natural_frequency == pytest.approx(math.sqrt(500.0 / felt) / (2.0 * math.pi), rel=1e-9)
    by_frequency = factory.design(name, command="loads", loads__vibration={"frequency": made.natural_frequency})
    table = by_frequency.table("harmonics")
    wanted = harmonics(made.vibrating.bend(np.linspace(0.0, made.machine.period, 720, endpoint=False)), 5)
    assert table["torque"][:5] == pytest.approx(np.radians(wanted) * made.speed**2 * felt, rel=1e-9)


def test_harmonics_of_a_table_give_the_motion_back() -> None:
    table = feed(frequency=40.0).table("harmonics")
    design = feed(frequency=40.0)
    phi = np.arange(720) * (2.0 * math.pi / 720)
    wanted = harmonics(design.vibrating.bend(phi), 5) * design.speed**2 * math.radians(0.016)
    assert table["torque"][:5] == pytest.approx(wanted, rel=1e-12)


def test_gripper_vibrates_less_the_stiffer_it_is_driven() -> None:
    found = [
        factory.design(
            "swing_gripper", command="loads", loads={"vibration": {"frequency": f, "allowed_residual": 0.05}}
        )
        for f in (60.0, 240.0)
    ]
    assert found[0].residual_amplitude > found[1].residual_amplitude > 0.0
    assert found[1].rise_periods == pytest.approx(4.0 * found[0].rise_periods, rel=1e-12)
    limit = found[1].residual_speed_limit
    slower = factory.design(
        "swing_gripper", command="loads", speed=0.99 * limit, loads={"vibration": {"frequency": 240.0}}
    )
    assert math.degrees(slower.residual_amplitude) <= 0.05


def test_a_machine_whose_speed_jumps_has_no_vibration_here() -> None:
    design = factory.design(
        "mutilated_gear_press",
        command="loads",
        loads={"speed": 60, "links": {"crank": {"inertia": 0.1}}, "vibration": {"frequency": 50}},
    )
    with pytest.raises(NoSolution) as error:
        _ = design.natural_frequency
    assert error.value.key == "loads.vibration"


@pytest.mark.parametrize("table", ["spectrum", "harmonics"])
def test_tables_of_a_vibration_that_is_not_given_are_refused_before_any_force(table: str) -> None:
    loads = factory.design("loaded_six_bar", command="loads", loads__vibration=None)
    with pytest.raises(MissingSection, match=r"loads\.vibration"):
        loads.report("loads", tables=(table,))
    assert "machine" not in loads.__dict__


@pytest.mark.parametrize(
    "parts",
    [
        [(100, 25), (130, None), (160, None), (280, 0), (300, None), (360, None)],  # dwells in two parts
        [
            (10, None),
            (20, None),
            (120, 25),
            (180, None),
            (300, 0),
            (360, None),
        ],  # a dwell over the end of the revolution
    ],
)
def test_dwells_that_touch_are_one(parts: list[tuple[float, float | None]]) -> None:
    """Between them there is no motion, of which the table of the spectrum and the residual had 1/0."""
    laws = {25: "modified-sine", 0: "cycloidal"}
    motion = [{"to": to} | ({} if lift is None else {"lift": lift, "law": laws[lift]}) for to, lift in parts]
    whole = factory.design("loaded_cam", command="loads").vibrating
    found = factory.design("loaded_cam", command="loads", motion=motion).vibrating
    assert [width for _, width in found.dwells] == pytest.approx([width for _, width in whole.dwells], rel=1e-12)
    assert len(found.motions) == 2
    assert found.rise_periods == pytest.approx(whole.rise_periods, rel=1e-12)
    for name in ("residual", "twist"):  # differences of 25 mm to 1e-12 of it, over some micrometres
        assert getattr(found, name) == pytest.approx(getattr(whole, name), rel=1e-8)
    assert np.isfinite(found.spectrum(5)[2]).all()
