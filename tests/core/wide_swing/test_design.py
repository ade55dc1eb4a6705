"""The wide-swing design class: reference cases through the design file, checks, refusals, remedies, laziness.

Tolerances: 1e-12 relative against references of 20 digits (the law keeps 1e-14, the profile 1e-13); the remedies are
applied as they are printed, so their tests have no tolerance at all.
"""

from __future__ import annotations

import json
import math
from functools import partial
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError
from sweeps import mostly_slow

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.remedies.ways import REFUSAL
from gearlink.core.base.report import remedy_words
from gearlink.core.base.spec_paths import changed, replaced, value_at
from gearlink.core.machines.wide_swing import remedies
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.slider import SliderDrive

CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}
PNEUMATIC = {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 120.0}
SPRING = {"type": "spring", "pivot_ratio": 4.0, "stretch_ratio": 0.5, "arm": 60.0}
CAM = {"center_distance": 200.0, "roller_radius": 8.0, "shaft_radius": 25.0}
SLIDER = {"crank": 150.0, "rod": 450.0, "middle_angle": 90.0, "mass": 6.0}
DRIVE = {"crank": 60.0, "coupler": 180.0, "rocker": 150.0, "frame": 240.0}


TWIN_CAM = {
    "kind": "wide-swing-cam",
    "layout": "twin-cam",
    "swing": 120.0,
    "cycle_angle": 120.0,
    "speed": 100.0,
    "inertia": 0.5,
    "unloader": PNEUMATIC,
    "cam": CAM,
}
design = partial(factory.design, TWIN_CAM)


def driven(**changes: Any) -> WideSwingDesign:
    return design(**({"cycle_angle": None, "drive": DRIVE} | changes))


def looped(**changes: Any) -> WideSwingDesign:
    soft = SPRING | {"stretch_ratio": 0.05}
    return design(**({"layout": "twin-rocker", "swing": 160.0, "cycle_angle": 150.0, "unloader": soft} | changes))


def value(made: WideSwingDesign, name: str) -> Any:
    quantity = made.quantity(name)
    assert quantity is not None
    return quantity.value


def close(number: float) -> Any:
    return pytest.approx(number, rel=1e-12, abs=0.0)


def statuses(made: WideSwingDesign, name: str) -> list[str]:
    return [check.status for check in made.check(name)]


def table(made: WideSwingDesign, name: str) -> dict[str, Any]:
    found = made.table(name)
    return dict(zip(found.columns, found.data, strict=True))


class TestReferences:
    """D-cases through the design file."""

    def test_law_and_sizing(self) -> None:
        law, sizing = CASES["D02"], CASES["D20"]
        made = design(speed=60.0 * 1.66, unloader=PNEUMATIC | {"pivot_ratio": 2.5})
        assert value(made, "energy_parameter") == close(law["N"])
        assert value(made, "velocity_peak") == close(law["B"])
        assert value(made, "acceleration_peak") == close(law["C_peak"])
        assert value(made, "force") == close(sizing["P_force_N"])
        assert value(made, "power_peak") == close(sizing["bc_max"])
        assert value(made, "drive_torque_peak") == close(sizing["M_drive_max"])
        assert made.quantity("spring_rate") is None

    def test_balance(self) -> None:
        made = design(speed=60.0 * 1.66, unloader=PNEUMATIC | {"pivot_ratio": 2.5})
        rows = table(made, "balance")
        at_design = rows["torque_without"][np.argmin(np.abs(rows["speed"] - 60.0 * 1.66))]
        assert at_design == close(CASES["D20"]["M_in_max"])
        # null in the table where nothing is left
        assert None in [row[3] for row in made.table("balance").rows()]

    def test_balance_keeps_its_speeds_with_samples(self) -> None:
        """`--samples` divides turn and stroke; the speeds of the balance are no part of either."""
        made = design()
        assert len(made.table("law", samples=40).rows()) == 41
        assert made.table("balance", samples=40) is made.table("balance"), "sought once: two panels of a figure ask"

    def test_spring(self) -> None:
        made = design(swing=180.0, speed=60.0 * 1.66, unloader=SPRING | {"arm": 120.0}, cam=None)
        assert value(made, "energy_parameter") == close(CASES["D08"]["N"])
        assert value(made, "spring_rate") == close(CASES["D20"]["spring_c_N_per_m"] / 1000.0)
        assert made.quantity("force") is None
        assert made.quantity("min_pivot_ratio") is None
        assert made.check("unloader-turnability") == []

    def test_twin_cam(self) -> None:
        want = CASES["D13"]
        made = design(unloader=PNEUMATIC | {"pivot_ratio": 2.5})
        assert value(made, "rocker_radius") == close(200.0 * want["lam_c"])
        assert value(made, "profile_correction") == close(want["xi_ext_deg"])
        assert value(made, "largest_profile_correction") == close(math.degrees(want["xi_max"]))
        assert value(made, "phase_angle") == close(want["phase_deg"])
        assert value(made, "start_curvature_radius") == close(200.0 * want["R0_closed"])
        assert value(made, "start_radius_estimate") == close(200.0 * want["R_eq23(k=0.1)"])
        assert value(made, "middle_radius_estimate") == close(200.0 * want["R_eq27(k=0.45)"])
        p, q = want["cusp_p"], want["cusp_q"]
        leading = q * 0.04 / (p * p * math.radians(120.0))
        assert made.even_cam.transition_zone_estimate == close(leading)
        assert value(made, "transition_zone") == 0.5 - value(made, "contact_end") == pytest.approx(leading, rel=1e-3)
        rows = table(made, "main_cam")
        row = int(np.argmin(np.abs(rows["k"] - 0.25)))
        assert rows["x"][row] == close(200.0 * want["prof_x(0.25)"])
        assert rows["y"][row] == close(200.0 * want["prof_y(0.25)"])
        assert rows["pressure_angle"][row] == close(want["delta_deg(0.25)"])

    def test_twin_rocker(self) -> None:
        want = CASES["D15"]
        made = design(
            layout="twin-rocker",
            cycle_angle=80.0,
            unloader=PNEUMATIC | {"pivot_ratio": 2.5},
            cam=CAM | {"roller_radius": 4.0},
        )
        assert value(made, "rocker_radius") == close(200.0 * want["lam_c"])
        assert value(made, "start_curvature_radius") == close(200.0 * want["R0_closed"])
        assert value(made, "middle_radius_estimate") == close(200.0 * want["R_eq27(k=0.45)"])
        rows, back = table(made, "main_cam"), table(made, "return_cam")
        row = int(np.argmin(np.abs(rows["k"] - 0.25)))
        assert math.hypot(rows["pitch_x"][row], rows["pitch_y"][row]) == close(200.0 * want["rho(0.25)"])
        # the return stroke is guided by the external profile of the same cam
        external = design(cycle_angle=80.0, unloader=PNEUMATIC | {"pivot_ratio": 2.5}, cam=CAM | {"roller_radius": 4.0})
        np.testing.assert_array_equal(back["x"], table(external, "main_cam")["x"])

    def test_turnability(self) -> None:
        for swing in (30, 60, 90, 120, 180, 240, 300):
            assert value(design(swing=float(swing), cam=None), "min_pivot_ratio") == close(
                CASES["D12"][f"pneu_{swing}"]
            )
            unloader = {
                "type": "spring",
                "pivot_ratio": 4.0,
                "stretch_ratio": 0.2,
                "arm": 100.0,
                "stretch_capacity": 1.5,
                "end_fittings": 30.0,
            }
            made = design(swing=float(swing), unloader=unloader, cam=None)
            assert value(made, "min_pivot_ratio") == close(CASES["D12"][f"spring_{swing}"])

    def test_slider(self) -> None:
        want = CASES["D17"]
        slider = {"crank": 100.0, "rod": 300.0, "middle_angle": 90.0, "mass": 5.0}
        made = design(unloader=PNEUMATIC | {"pivot_ratio": 2.5}, cam=None, slider=slider, inertia=0.0)
        assert value(made, "energy_parameter") == close(want["N"])
        assert value(made, "middle_place") == close(want["k_mid"])
        assert value(made, "slider_stroke") == close(100.0 * want["H_over_R"])
        assert value(made, "rocker_share") == 0.0
        # N = 2 P r_d T^2/(m H^2), by hand
        time, stroke = 120.0 / 600.0, 0.1 * want["H_over_R"]
        assert value(made, "force") == close(want["N"] * 5.0 * stroke**2 / (2.0 * 0.12 * time**2))
        rows = table(made, "slider")
        assert rows["travel"][-1] == close(-100.0 * want["H_over_R"])

    def test_oscillating_cam(self) -> None:
        want = CASES["D19"]
        made = driven(unloader=PNEUMATIC | {"pivot_ratio": 2.5})
        assert value(made, "crank_span") == close(want["crank_span_deg"])
        assert value(made, "cam_swing") == close(want["cam_swing_deg"])
        assert value(made, "rocker_radius") == close(200.0 * want["r_over_a"])
        # the reference counts the angle in the other sense
        assert value(made, "middle_pressure_angle") == close(-want["delta_mid_deg"])

    def test_dynamic_coefficient(self) -> None:
        """The law of a very long device at a small swing is the harmonic one of the reference."""
        for product in (10.0, 20.0, 40.0):
            shaft = {"natural_frequency": product / (2.0 * math.pi * 0.2)}
            made = design(swing=0.01, unloader=PNEUMATIC | {"pivot_ratio": 1e5}, cam=None, shaft=shaft)
            want = CASES["D21"][f"Kd(omegaT={product:.0f})"]
            # the pendulum law differs from the harmonic one by (swing/4)^2 or so
            assert value(made, "dynamic_coefficient") == pytest.approx(want, rel=1e-7, abs=0.0)


class TestCombined:
    def test_slider_of_no_mass_is_the_plain_law(self) -> None:
        light = design(cam=None, slider=SLIDER | {"mass": 1e-12})
        assert value(light, "energy_parameter") == pytest.approx(value(design(), "energy_parameter"), rel=1e-9, abs=0.0)
        assert value(light, "force") == pytest.approx(value(design(), "force"), rel=1e-9, abs=0.0)
        np.testing.assert_allclose(
            table(light, "balance")["torque_with"], table(design(), "balance")["torque_with"], rtol=1e-9
        )

    def test_device_torque_with_slider(self) -> None:
        """The device's largest torque is that of the plain law with as much inertia as asks for the same force."""
        made = design(cam=None, slider=SLIDER)
        plain = design(cam=None, inertia=made.unloading.even_inertia)
        assert value(plain, "force") == pytest.approx(value(made, "force"), rel=1e-13, abs=0.0)

    def test_zone_of_oscillating_cam(self) -> None:
        """To leading order the radius has fallen to the roller's three quarters of the way into the zone."""
        cam = driven(cam=CAM | {"roller_radius": 0.01}).oscillating_cam
        zone = cam.transition_zone_estimate
        k = np.array([0.5 - 0.75 * zone, 0.5 + 0.75 * zone])
        # next order: a share of the size of the zone, 5e-5, times its slope
        np.testing.assert_allclose(cam.points(k).curvature_radius, 0.01, rtol=1e-3)
        larger = driven(cam=CAM | {"roller_radius": 0.2}).oscillating_cam
        (_, start), (end, _) = larger.contact
        assert (0.5 - start) / larger.transition_zone_estimate == pytest.approx(1.0, rel=1e-3)
        assert (end - 0.5) / larger.transition_zone_estimate == pytest.approx(1.0, rel=1e-3)

    def test_pressure_angle_of_oscillating_cam_has_no_noise_at_the_ends(self) -> None:
        cam = driven().oscillating_cam
        sampled = np.abs(cam.points(np.linspace(0.0, 1.0, 2001)).pressure_angle).max()
        assert cam.max_pressure_angle == pytest.approx(float(sampled), rel=1e-6, abs=0.0)

    def test_homeward_stroke_is_the_mirror_of_the_mirrored_drive(self) -> None:
        home = driven(drive=DRIVE | {"stroke": "homeward"})
        assert value(home, "crank_span") == close(360.0 - CASES["D19"]["crank_span_deg"])
        assert value(home, "cam_swing") == close(CASES["D19"]["cam_swing_deg"])
        mirrored = driven(drive=DRIVE | {"assembly": -1})
        assert value(mirrored, "cam_swing") == close(CASES["D19"]["cam_swing_deg"])

    def test_no_cam_of_even_rotation_beside_a_drive(self) -> None:
        assert driven().outline("cam").tables == ("main_cam",)
        for name in ("phase_angle", "start_radius_estimate"):
            with pytest.raises(NoSolution, match="omit drive"):
                driven().quantity(name)
        with pytest.raises(NoSolution, match="omit drive"):
            driven().table("return_cam")

    def test_power_peak_with_a_slider_is_that_of_all_that_moves(self) -> None:
        own = design(cam=None, slider=SLIDER)
        k = np.linspace(0.0, 1.0, 2001)
        # the power of the inertia is the slope of the energy of motion, j b^2/2
        slope = np.gradient(0.5 * own.motion.law.kinetic(k), k)
        found = own.quantity("power_peak")
        assert found is not None
        # central differences over 1/2000 of the stroke
        assert found.value == pytest.approx(np.abs(slope).max(), rel=1e-4)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"cycle_angle": None}, "the key 'cycle_angle' is missing"),
        ({"drive": DRIVE}, "omit cycle_angle"),
        ({"drive": DRIVE, "cycle_angle": None, "cam": None}, "needs the section cam"),
        ({"drive": DRIVE, "cycle_angle": None, "layout": "twin-rocker"}, "external profile"),
        ({"drive": DRIVE, "cycle_angle": None, "cam": CAM | {"rocker_radius": 70.0}}, "omit cam.rocker_radius"),
        ({"slider": SLIDER, "layout": "twin-rocker"}, "layout must be twin-cam"),
        ({"slider": SLIDER, "cam": CAM | {"rocker_radius": 70.0}}, "omit cam.rocker_radius"),
        ({"inertia": 0.0}, r"inertia: 0 \(limit > 0\)"),
        ({"swing": 341.0}, "less than or equal to 340"),
        ({"unloader": SPRING | {"stretch_ratio": -0.1}}, "greater than or equal to 0"),
        ({"unloader": SPRING | {"closed_length": 90.0, "stretch_capacity": 1.5}}, "exclude each other"),
    ],
)
def test_contradictions_of_the_file(changes: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        design(**changes)


@pytest.mark.slow
@pytest.mark.parametrize("factor", [1e-6, 1e-3, 1e6])
def test_similar_designs(factor: float) -> None:
    """Lengths scale; angles, zones, ratios and findings stay."""

    def scaled(made: WideSwingDesign) -> WideSwingDesign:
        spec = made.spec
        for path in ("cam.center_distance", "cam.roller_radius", "cam.shaft_radius", "unloader.arm"):
            spec = replaced(spec, path, factor * value_at(spec, path))
        return WideSwingDesign(spec)

    rocker = design(layout="twin-rocker", swing=150.0, cycle_angle=90.0, unloader=SPRING)
    for made in (design(), rocker):
        large = scaled(made)
        for name in made.outline("analyze").quantities:
            if name in ("force", "spring_rate") or made.quantity(name) is None:
                continue
            # the inertia stays: forces on longer arms fall
            scale = {"mm": factor, "N": 1.0 / factor}.get(made.quantity(name).unit, 1.0)  # type: ignore[union-attr]
            assert value(large, name) == pytest.approx(scale * value(made, name), rel=1e-11, abs=0.0), name
        for name in made.outline("cam").checks:
            assert statuses(large, name) == statuses(made, name)


class TestLoops:
    """A profile that does not exist is a finding of its own; nothing else is said of it."""

    @pytest.mark.slow
    def test_finding(self) -> None:
        made = looped()
        report = made.report("swing")
        failing = [check for check in report.checks if check.status == "fail"]
        assert [check.code for check in failing] == ["GL505"]
        assert "cycle angle to 113.1 deg" in failing[0].advice
        names = {quantity.name for quantity in report.quantities}
        assert {"phase_angle", "rocker_radius", "start_curvature_radius"} <= names
        absent = {"transition_zone", "max_pressure_angle", "min_curvature_radius", "contact_end"}
        assert not names & (absent | {"start_radius_estimate", "middle_radius_estimate"})
        # the external profile of the same cam exists and is judged
        assert len(made.check("pressure-angle")) == 1
        assert {table.name for table in made.report("analyze").tables} == {"law", "balance"}

    @pytest.mark.parametrize("name", ["transition_zone", "max_pressure_angle", "contact_end", "middle_radius_estimate"])
    def test_asked_for_by_name(self, name: str) -> None:
        with pytest.raises(NoSolution, match="loop") as refusal:
            looped().quantity(name)
        assert refusal.value.key == "cycle_angle"

    def test_tables_are_refused(self) -> None:
        for name in ("main_cam",):
            with pytest.raises(NoSolution, match="reduce the cycle angle") as refusal:
                looped().table(name)
            assert refusal.value.key == "cycle_angle"
        longer = design(cam=CAM | {"rocker_radius": 80.0})
        with pytest.raises(NoSolution, match="loop") as refusal:
            longer.table("main_cam")
        assert refusal.value.key == "cam.rocker_radius"
        assert statuses(longer, "profile-exists") == ["fail"]

    def test_at_the_angle_that_is_named_the_arm_is_as_long_as_the_centre_distance(self) -> None:
        repaired = looped(cycle_angle=remedies.cycle_angle(looped()))
        assert value(repaired, "rocker_radius") == pytest.approx(repaired.section.center_distance, rel=1e-12)
        assert statuses(repaired, "profile-exists") == ["pass"]

    def test_positive_phase_angle_is_not_enough(self) -> None:
        """The source's condition Phi > 0 holds here, and for arms much longer than the distance the loop is gone."""
        assert value(looped(), "phase_angle") > 19.0
        assert [statuses(looped(cycle_angle=angle), "profile-exists") for angle in (113.19, 225.0)] == [["pass"]] * 2

    @pytest.mark.slow
    def test_slow_rocker_has_no_cam(self) -> None:
        """The law stands; `cam` is refused at the key."""
        made = design(layout="twin-rocker", swing=60.0)
        report = made.report("swing")
        (finding,) = [check for check in report.checks if check.status == "fail"]
        assert (finding.code, finding.value) == ("GL505", None)
        assert "peak speed of the rocker over that of the cam: 0.802 (limit > 1 for a twin-rocker)" in finding.message
        assert "lift_off_speed" in [quantity.name for quantity in report.quantities]
        with pytest.raises(NoSolution, match="peak speed of the rocker") as refusal:
            made.report("cam")
        assert refusal.value.key == "cycle_angle"


@pytest.mark.quick(1)
@pytest.mark.parametrize("changes", [{}, {"layout": "twin-rocker", "swing": 150.0, "cycle_angle": 80.0}])
def test_slot_that_leaves_the_shaft_no_hub_is_warned_of(changes: dict[str, Any]) -> None:
    """As of every disc cam, 1.5 times the shaft: of a slot 0.5 mm above the shaft nothing was said."""
    made = design(**changes)
    cam = made.cam if not changes else made.return_cam
    assert cam is not None
    bottom = float(np.abs(cam.points(np.array([0.5])).pitch[0])) - made.section.roller_radius
    for shaft, status in (
        (bottom - 0.5, "warn"),
        (bottom / 1.499, "warn"),
        (bottom / 1.501, None),
        (bottom + 1, "fail"),
    ):
        judged = design(cam=CAM | {"shaft_radius": shaft}, **changes).check("shaft-clearance")
        found = [check for check in judged if check.status != "pass"]
        assert [check.status for check in found] == ([] if status is None else [status])
        if status == "warn":
            assert found[0].value == pytest.approx(bottom - shaft, abs=1e-9)
            words, _, most = (found[0].fix or "").partition("at most ")
            assert bool(most) is (bottom / 1.5 >= 0.75 * shaft)  # nothing thinner is advised
            assert not most or float(most.split(" ")[0]) == pytest.approx(bottom / 1.5, rel=1e-3), words


UNSAID: list[tuple[WideSwingDesign, str, str]] = [
    (design(layout="twin-rocker", swing=60.0), "profile-exists", "cycle_angle"),
    (design(layout="twin-rocker", swing=80.0, cycle_angle=80.0), "pressure-angle", "swing"),
]
"""Findings whose repair brings in another."""
MENDED: list[tuple[WideSwingDesign, str, str]] = [
    (design(unloader=PNEUMATIC | {"pivot_ratio": 0.9}), "", "unloader.pivot_ratio"),
    (design(unloader=PNEUMATIC | {"pivot_ratio": 2.5}), "unloader-turnability", "unloader.pivot_ratio"),
    (
        design(swing=150.0, unloader=SPRING | {"pivot_ratio": 3.0, "closed_length": 90.0, "end_fittings": 30.0}),
        "unloader-turnability",
        "unloader.pivot_ratio",
    ),
    (
        design(swing=150.0, unloader=SPRING | {"pivot_ratio": 1.6, "stretch_capacity": 1.2}),
        "unloader-turnability",
        "unloader.pivot_ratio",
    ),
    (design(cycle_angle=200.0, cam=CAM | {"roller_radius": 3.0}), "cycle-angles", "cycle_angle"),
    (design(cam=CAM | {"shaft_radius": 130.0}), "shaft-clearance", "cam.center_distance"),
    (looped(), "profile-exists", "cycle_angle"),
    (looped(cycle_angle=130.5), "profile-exists", "cycle_angle"),
    (design(cam=CAM | {"rocker_radius": 80.0}), "profile-exists", "cam.rocker_radius"),
    (design(swing=300.0, unloader=PNEUMATIC | {"pivot_ratio": 5.3}), "pressure-angle", "swing"),
    (
        design(layout="twin-rocker", cycle_angle=100.0, cam=CAM | {"roller_radius": 2.0}),
        "pressure-angle",
        "cycle_angle",
    ),
    (design(cam=CAM | {"roller_radius": 12.0}), "transition-zone", "cam.roller_radius"),
    (design(cam=CAM | {"roller_radius": 100.0, "shaft_radius": 0.0}), "cam-undercut", "cam.roller_radius"),
    (driven(cam=CAM | {"roller_radius": 20.0}), "transition-zone", "cam.roller_radius"),
    (driven(limits={"pressure_angle": 32.0}), "pressure-angle", "drive.crank"),
    (design(cam=None, slider=SLIDER | {"rod": 100.0}), "", "slider.rod"),
    (design(cam=None, slider=SLIDER | {"middle_angle": 40.0}, inertia=0.0), "", "slider.middle_angle"),
    (design(cam=None, slider=SLIDER | {"middle_angle": 0.0}), "", "slider.middle_angle"),
    (driven(drive=DRIVE | {"crank": 160.0}), "", "drive.crank"),
    (driven(drive=DRIVE | {"frame": 340.0}), "", "drive.frame"),
    *UNSAID,
]


@pytest.mark.parametrize(("made", "check", "path"), mostly_slow(MENDED, 4))
def test_closed_form_as_given_repairs_the_finding(made: WideSwingDesign, check: str, path: str) -> None:
    ((_, value),) = next(remedy for remedy in remedies.candidates(made, check or REFUSAL) if remedy[0][0] == path)
    repaired = factory.design(replaced(made.spec, path, value).model_dump(by_alias=True))
    if check and made.spec.unloader.pivot_ratio > 1.0:
        assert "fail" in statuses(made, check)
        assert "fail" not in statuses(repaired, check)
    else:
        with pytest.raises(NoSolution):
            made.report("swing")
        repaired.report("swing")


SAID = [(made, check) for made, check, path in MENDED if check and (made, check, path) not in UNSAID]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("made", "check"), mostly_slow(SAID, 3))
def test_remedy_in_the_message_holds(made: WideSwingDesign, check: str) -> None:
    """What a failing finding says last, put into the file, repairs it."""
    failing = [(i, found) for i, found in enumerate(made.findings("swing", check)) if found.status == "fail"]
    assert failing
    for index, found in failing:
        assert found.remedy
        assert found.fix.removesuffix(" (relaxes the requirement)").endswith(remedy_words(found.remedy))
        repaired = WideSwingDesign(changed(made.spec, found.remedy))
        assert statuses(repaired, check)[index] != "fail"


@pytest.mark.slow
@pytest.mark.parametrize(("made", "check", "path"), UNSAID)
def test_remedy_that_breaks_another_check_is_not_said(made: WideSwingDesign, check: str, path: str) -> None:
    (found,) = (each for each in made.findings("swing", check) if each.status == "fail")
    assert found.remedy == ()
    assert "set " not in (found.fix or "")
    ((_, value),) = next(remedy for remedy in remedies.candidates(made, check) if remedy[0][0] == path)
    repaired = factory.design(replaced(made.spec, path, value).model_dump(by_alias=True))
    before, after = (
        {name for name in each.outline("swing").checks if "fail" in statuses(each, name)} for each in (made, repaired)
    )
    assert after - before


class TestChecks:
    def test_spring_without_stretch_is_slack(self) -> None:
        slack = design(swing=60.0, unloader=SPRING | {"stretch_ratio": 0.0}, cam=None)
        assert statuses(slack, "force-closure") == ["warn"]
        taut = design(swing=60.0, unloader=SPRING | {"stretch_ratio": 0.1}, cam=None)
        assert statuses(taut, "force-closure") == ["pass"]
        assert design().check("force-closure") == []

    @pytest.mark.parametrize("residual", [0.0, 0.22])
    def test_harmful_speed(self, residual: float) -> None:
        """The ratio of the table crosses 1 where the check says so; the share that it recommends helps there."""
        unloader = PNEUMATIC | {"residual": residual}
        made = design(unloader=unloader, operating_speed_min=60.0)
        rows = table(made, "balance")
        np.testing.assert_array_equal(rows["ratio"] > 1.0, rows["speed"] > made.unloading.harmful_speed)
        (check,) = made.check("balancing")
        assert check.status == "warn"
        share = float(check.fix.split("rate to ")[1].split(" ")[0])
        lowered = design(unloader=unloader, speed=60.0, operating_speed_min=60.0)
        assert value(lowered, "force") / value(made, "force") == pytest.approx(share, rel=1e-12)
        assert statuses(lowered, "balancing") == ["pass"]

    def test_source_s_estimate_warns_only(self) -> None:
        made = design(layout="twin-rocker", cycle_angle=80.0, cam=CAM | {"roller_radius": 5.0})
        assert statuses(made, "cam-undercut")[-1] == "warn"
        most = float(made.check("cam-undercut")[-1].fix.split("at most ")[1].split(" ")[0])
        smaller = design(layout="twin-rocker", cycle_angle=80.0, cam=CAM | {"roller_radius": most})
        assert len(smaller.check("cam-undercut")) == 2

    def test_cam_over_the_rocker_s_axis(self) -> None:
        wide = design(swing=300.0, unloader=PNEUMATIC | {"pivot_ratio": 5.3})
        assert statuses(wide, "shaft-clearance") == ["warn", "pass"]
        assert statuses(design(), "shaft-clearance") == ["pass"]

    @pytest.mark.slow
    def test_where_nothing_helps_no_number_is_named(self) -> None:
        made = design(limits={"pressure_angle": 1.0}, layout="twin-rocker", swing=150.0, cycle_angle=90.0)
        assert [found.remedy for found in made.findings("swing", "pressure-angle")] == [(), ()]

    def test_shorter_rocker_has_no_cusp(self) -> None:
        """60 mm instead of 74.55 mm: the pitch curve turns smoothly and nothing of the profile is cut away."""
        made = design(cam=CAM | {"rocker_radius": 60.0})
        assert value(made, "contact_end") == 0.5
        assert not np.isnan(table(made, "main_cam")["x"]).any()
        nearly = design(cam=CAM | {"rocker_radius": made.even_cam.nominal_rocker_radius * (1.0 - 1e-9)})
        assert value(nearly, "contact_end") == pytest.approx(value(design(), "contact_end"), rel=1e-6)


class TestSections:
    @pytest.mark.slow
    def test_shaft(self) -> None:
        made = design(shaft={"natural_frequency": 60.0, "damping": 0.05, "linkage_share": 0.25})
        assert value(made, "drive_balancing_ratio") == 5.0
        assert 1.0 < value(made, "dynamic_coefficient") < 2.1
        at_design = np.argmin(np.abs(table(made, "balance")["speed"] - 100.0))
        assert table(made, "balance")["drive_ratio"][at_design] == close(5.0)
        assert design(shaft={"natural_frequency": 60.0}).quantity("drive_balancing_ratio") is None

    @pytest.mark.slow
    @pytest.mark.parametrize(("residual", "reserve"), [(0.22, 0.3), (0.22, 0.0), (0.0, 0.1)])
    def test_drive_ratio_counts_residual_and_reserve(self, residual: float, reserve: float) -> None:
        """With 0.22 of residual and 0.25 of the links 1.25/0.47 = 2.66; the table says the same at the design speed."""
        shaft = {"natural_frequency": 60.0, "linkage_share": 0.25}
        made = design(shaft=shaft, unloader=PNEUMATIC | {"residual": residual, "reserve": reserve})
        assert value(made, "drive_balancing_ratio") == close(1.25 / (residual + reserve + 0.25))
        rows = table(made, "balance")
        at_design = int(np.argmin(np.abs(rows["speed"] - 100.0)))
        assert rows["drive_ratio"][at_design] == close(1.25 / (residual + reserve + 0.25))
        # at half the speed: inertia and links fall to a quarter, the device stays
        half = int(np.argmin(np.abs(rows["speed"] - 50.0)))
        assert rows["drive_ratio"][half] == close(0.25 * 1.25 / (1.0 + reserve - 0.25 + residual + 0.0625))

    @pytest.mark.parametrize(
        ("name", "key"),
        [
            ("dynamic_coefficient", "shaft"),
            ("slider_stroke", "slider"),
            ("cam_swing", "drive"),
            ("rocker_radius", "cam"),
        ],
    )
    def test_missing_section_is_named(self, name: str, key: str) -> None:
        with pytest.raises(MissingSection) as refusal:
            design(cam=None).quantity(name)
        assert refusal.value.key == key

    @pytest.mark.parametrize("name", ["line_of_centers_place", "roller_arm_offset"])
    def test_what_a_slider_alone_has_names_its_section(self, name: str) -> None:
        for made in (design(), driven()):
            with pytest.raises(MissingSection) as refusal:
                made.quantity(name)
            assert refusal.value.key == "slider"

    def test_iteration(self) -> None:
        made = design(method="iteration", iteration_steps=10)
        assert value(made, "iteration_error") == pytest.approx(2.65e-3, rel=0.05)
        assert value(made, "iteration_passes") < 25
        errors = table(made, "iteration")["relative_error"]
        # trapezoidal rule: ten times the steps, a hundredth of the error
        assert errors[1] / errors[4] == pytest.approx(100.0, rel=0.02)
        assert "iteration_error" not in design().outline("swing").quantities

    @pytest.mark.slow
    def test_every_quantity_of_every_outline_is_known(self) -> None:
        rocker = design(layout="twin-rocker", swing=150.0, cycle_angle=90.0, unloader=SPRING)
        marched = design(method="iteration", iteration_steps=10)
        for made in (design(), rocker, marched, driven(), design(cam=None, slider=SLIDER)):
            for command in ("swing", "analyze"):
                assert set(made.outline(command).quantities) <= set(made.quantity_names())
            made.report("analyze")


def test_laziness() -> None:
    """Asking for the velocity peak computes no profile, no drive and no balance."""
    made = design()
    made.report("swing", quantities=("velocity_peak",))
    assert set(vars(made)) <= {"spec", "kin", "motion"}
    assert set(vars(made.motion)) <= {"spec", "swing", "device", "plain_law"}
    made.report("swing", quantities=("min_pivot_ratio",))
    fresh = design()
    fresh.report("swing", quantities=("min_pivot_ratio",))
    assert set(vars(fresh.motion)) <= {"spec", "swing", "min_pivot_ratio"}


def test_spring_of_given_length_is_judged_by_formula_4() -> None:
    """The minimum ratio solves (4) with its own stretch, whatever ratio the file has; it is the check's limit."""
    unloader = {"type": "spring", "stretch_ratio": 0.5, "arm": 120, "closed_length": 150, "end_fittings": 40}
    for ratio in (2.2, 2.9, 2.92, 4.0):
        made = design(unloader={**unloader, "pivot_ratio": ratio}, cam=None)
        least = value(made, "min_pivot_ratio")
        longest = math.sqrt(1.0 + least * least - 2.0 * least * math.cos(0.5 * made.motion.swing))
        stretch = 0.5 * 120.0 * (longest - (least - 1.0))
        assert least == close(1.0 + (150.0 + 40.0 + stretch) / 120.0)
        assert statuses(made, "unloader-turnability") == ["pass" if ratio >= least else "fail"]
        just = {**unloader, "pivot_ratio": least * (1.0 + 1e-9)}
        assert statuses(design(unloader=just, cam=None), "unloader-turnability") == ["pass"]


def test_least_ratio_of_a_spring_far_from_its_own() -> None:
    """Swing 219.9, ratio 4.43: (4) solved gives 3.192302, not the 3.158318 of the stretch at 4.43."""
    unloader = {
        "type": "spring",
        "pivot_ratio": 4.43,
        "arm": 106.8,
        "stretch_ratio": 1.09,
        "closed_length": 51.1,
        "end_fittings": 12.6,
    }
    assert value(design(swing=219.9, unloader=unloader, cam=None), "min_pivot_ratio") == pytest.approx(
        3.192302, abs=5e-7
    )


@pytest.mark.quick(2)
@pytest.mark.parametrize(("radius", "status"), [(70.0, "fail"), (74.0, "fail"), (74.55, "pass")])
def test_shorter_rocker_is_judged_as_its_table_shows_it(radius: float, status: str) -> None:
    """Below (18), 74.550035 mm, contact lasts to mid-swing with 90 deg there; rounded to 74.55 nothing changes."""
    made = design(cam=CAM | {"rocker_radius": radius})
    assert statuses(made, "pressure-angle") == [status]
    rows = table(made, "main_cam")
    largest = np.abs(rows["pressure_angle"])[~np.isnan(rows["x"])].max()
    assert value(made, "max_pressure_angle") >= largest * (1 - 1e-9)
    assert (largest == pytest.approx(90.0, rel=1e-12)) == (status == "fail")


def test_zone_is_judged_by_its_exact_end() -> None:
    """Here the leading order, 0.0498, would pass the limit of 0.05; contact ends 0.0516 before mid-swing."""
    unloader = {"type": "spring", "pivot_ratio": 4.1098, "stretch_ratio": 0.334, "arm": 60.0}
    cam = {"center_distance": 127.3, "roller_radius": 8.05}
    made = design(layout="twin-rocker", swing=126.1, cycle_angle=49.3, unloader=unloader, cam=cam)
    (internal, external) = made.check("transition-zone")
    assert made.even_cam.transition_zone_estimate == pytest.approx(0.04976, abs=5e-6)
    assert (internal.status, internal.value) == ("fail", 0.5 - made.contact_end)
    assert made.contact_end == pytest.approx(0.44837, abs=5e-6)
    assert external.status in ("pass", "fail")


def test_curve_that_bulges_nowhere_has_no_least_radius_in_its_words() -> None:
    """A twin-rocker with a very short arm is hollow all the way: 'inf mm' is no length."""
    cam = CAM | {"rocker_radius": 10.9, "roller_radius": 40.0}
    made = design(
        layout="twin-rocker", swing=160.0, cycle_angle=56.0, unloader=PNEUMATIC | {"pivot_ratio": 5.3}, cam=cam
    )
    check = made.check("cam-undercut")[0]
    assert (check.status, check.value) == ("pass", 0.0)
    assert "roller radius, internal profile" in check.message
    assert "inf" not in check.message


def test_a_bend_that_no_smaller_roller_makes_short_enough_asks_for_the_rocker_radius_of_the_law() -> None:
    made = factory.design(
        "wide_swing_twin_cam",
        swing=135.39,
        cycle_angle=126.24,
        unloader={"type": "spring", "arm": 60.0, "pivot_ratio": 6.32, "stretch_ratio": 0.331},
        cam={"center_distance": 275.96, "roller_radius": 87.146, "rocker_radius": 103.599},
    )
    (check,) = made.check("transition-zone")
    assert check.status == "fail"
    assert check.fix == "remove cam.rocker_radius"


@pytest.mark.slow
def test_a_cam_that_swings_over_the_rocker_axis_is_warned_of_before_it_reaches_it() -> None:
    """The oscillating cam's body by its outline: farthest from its axis at the ends of the stroke."""
    for swing, room in ((150.0, None), (170.0, 3.836), (200.0, -6.706)):
        lengths = {"drive__crank": 60.0, "drive__coupler": 180.0, "drive__frame": 192.0}
        made = factory.design("wide_swing_oscillating_cam", swing=swing, unloader__pivot_ratio=5.0, **lengths)
        found = [check for check in made.check("shaft-clearance") if "rocker's axis" in check.message]
        assert [check.status for check in found] == ([] if room is None else ["warn"])
        for check in found:
            outline = np.abs(made.cam.points(np.linspace(0.0, 1.0, 4001)).profile)
            assert check.value == pytest.approx(room, abs=1e-3)
            assert check.value == pytest.approx(made.section.center_distance - outline.max(), abs=0.05)


@pytest.mark.parametrize(
    ("links", "status"),
    [
        ((60.0, 180.0, 96.0, 192.0), "pass"),
        ((60.0, 150.0, 96.0, 160.0), "warn"),
        ((60.0, 110.0, 96.0, 115.0), "fail"),
        ((40.0, 140.0, 45.0, 140.0), "fail"),
    ],
)
def test_drive_is_judged_by_its_transmission_angle(links: tuple[float, ...], status: str) -> None:
    """Second way: the triangle of coupler, rocker and diagonal at 36000 places of the crank."""
    names = ("crank", "coupler", "rocker", "frame")
    made = driven(**{f"drive__{name}": length for name, length in zip(names, links, strict=True)})
    (check,) = made.check("transmission-angle")
    crank, coupler, rocker, frame = links
    diagonal = np.abs(crank * np.exp(1j * np.linspace(0.0, 2.0 * math.pi, 36001)) - frame)
    cosine = (coupler**2 + rocker**2 - diagonal**2) / (2.0 * coupler * rocker)
    assert check.value == pytest.approx(math.degrees(math.acos(np.abs(cosine).max())), abs=1e-6)
    assert (check.code, check.status) == ("GL303", status)


@pytest.mark.quick(9)
@pytest.mark.parametrize("middle", [-200.0, -90.0, -61.0, 0.0, 13.0, 29.0, 31.0, 73.18, 149.0, 151.0, 270.0, 3600.0])
@pytest.mark.parametrize("offset", [-40.0, 0.0, 25.0])
def test_slider_rod_is_judged_over_the_swing(middle: float, offset: float) -> None:
    """Second way: the slider of the table's own kernel, the rod's direction from both its ends, 36000 places."""
    drive = SliderDrive(150.0, 200.0, math.radians(middle), offset)
    swing = math.radians(120.0)
    phi = np.linspace(-0.5 * swing, 0.5 * swing, 36001)
    # Along the slide line the slider, from the rocker's axis; its depth grows towards the axis' far side.
    depth = np.abs(drive.depth(phi)[0] - 150.0 * np.cos(phi + drive.middle_angle))
    leans = np.arccos(np.minimum(1.0, depth / 200.0))
    assert drive.least_transmission(swing) == pytest.approx(0.5 * math.pi - leans.max(), abs=1e-6)


def test_remedy_of_a_slider_rod_holds() -> None:
    made = factory.design("wide_swing_slider", slider__rod=160.0)
    (check,) = (check for check in made.report("swing").checks if check.status == "fail")
    ((path, value),) = check.remedy
    assert (check.code, path) == ("GL303", "slider.rod")
    (repaired,) = factory.design("wide_swing_slider", slider__rod=value).check("transmission-angle")
    assert repaired.status == "pass"


@pytest.mark.parametrize("swing", [40.0, 120.0, 250.0])
@pytest.mark.parametrize("stretch", [0.0, 0.3, 1.0])
@pytest.mark.parametrize("ratio", [1.02, 1.3, 1.9, 2.6, 4.0, 7.0])
def test_spring_of_no_length_is_warned_of_where_no_steel_fits(ratio: float, stretch: float, swing: float) -> None:
    """Second way: the pins placed in the plane, the longest coils that fit at mid-swing, and what they must bear."""
    arm, fittings = 120.0, 20.0
    spring = {"type": "spring", "pivot_ratio": ratio, "stretch_ratio": stretch, "arm": arm, "end_fittings": fittings}
    made = design(unloader=spring, swing=swing)
    shortest, longest = (abs(ratio * arm - arm * np.exp(1j * turn)) for turn in (0.0, math.radians(0.5 * swing)))
    coils = shortest - fittings - stretch * (longest - shortest)
    fits = coils > 0.0 and (1.0 + stretch) * (longest - shortest) <= 2.0 * coils
    assert statuses(made, "unloader-turnability") == ([] if fits else ["warn"])
    capacity = made.spec.model_dump(exclude_none=True)["unloader"] | {"stretch_capacity": 2.0}
    assert statuses(design(unloader=capacity, swing=swing), "unloader-turnability") == ["pass" if fits else "fail"]


def test_return_cam_of_another_shape_has_its_own_quantities() -> None:
    """Against the dense table of its points: the table's samples lie below the maximum by the square of their step."""
    made = design(layout="twin-rocker", swing=150.0, cycle_angle=90.0, unloader=SPRING)
    columns = made.table_return_cam(4000)
    touching = np.isfinite(columns["x"])
    pressure = np.abs(columns["pressure_angle"][touching]).max()
    assert value(made, "return_max_pressure_angle") == pytest.approx(pressure, rel=1e-5)
    reach = np.hypot(columns["pitch_x"], columns["pitch_y"])
    assert value(made, "return_max_radius") == pytest.approx(reach.max(), rel=1e-9)
    zone = 0.5 - columns["k"][touching & (columns["k"] < 0.5)].max()
    assert value(made, "return_transition_zone") == pytest.approx(zone, abs=1.0 / 4000)
    assert value(made, "return_transition_zone") <= zone
    judged = [check.value for check in made.check("pressure-angle")]
    assert value(made, "return_max_pressure_angle") == pytest.approx(judged[1], rel=1e-12)


def test_mirror_image_has_no_quantities_of_its_own() -> None:
    assert "return_max_pressure_angle" not in design().outline("swing").quantities
    with pytest.raises(NoSolution, match="mirror image"):
        design().quantity("return_max_pressure_angle")
