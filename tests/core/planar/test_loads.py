"""Forces of planar mechanisms: each link free, by the forces of the tables and differences of places; other kinds."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from oracles.planar_zoo import LOADS, ZOO, made

from gearlink.cli.opening import design
from gearlink.cli.opening import load as opened_from
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar.loads import PlanarLoads
from gearlink.core.mechanism.joints import Contact, Coupling, Feed, Guide, Mesh, Pin, Rack

SPEED = 90.0
_STEP = 1e-3
_SECOND = (-1.0 / 560, 8.0 / 315, -0.2, 1.6, -205.0 / 72, 1.6, -0.2, 8.0 / 315, -1.0 / 560)


def loaded(name: str, **more: Any) -> PlanarLoads:
    section = {"speed": SPEED, "gravity": [0.5, -9.81], **LOADS[name], **more}
    from gearlink.core.machines.planar.loads_spec import PlanarLoads as Section

    return PlanarLoads(made(name, loads=Section.model_validate(section)))


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", LOADS)
def test_the_torque_is_that_of_virtual_power(name: str) -> None:
    assert loaded(name).power_identity < 1e-12


def _forces(each: Any, unknown: Any) -> Iterator[tuple[complex, complex, float]]:
    """Force on the second link, where, and couple [N mm], as the contract of the tables has them."""
    value = complex(unknown[0][0])
    if isinstance(each, Pin):
        yield complex(unknown[0][0], unknown[1][0]), complex(each.at[0]), 0.0
        return
    along = complex(np.broadcast_to(np.asarray(getattr(each, "along", 0j)), (1,))[0])
    if isinstance(each, Guide):
        yield 1j * along * value, complex(each.at[0]), 1e3 * float(unknown[1][0])
    elif isinstance(each, Contact):
        yield value * complex(each.normal[0]), complex(each.at[0]), 0.0
    elif isinstance(each, Mesh):
        e = complex(np.broadcast_to(np.asarray(each.toward), (1,))[0])
        point = complex(each.center[0]) + each.radius * e
        yield 1j * e * value, point, 0.0
        yield abs(value) * each.tangent * e * (-1.0 if each.internal else 1.0), point, 0.0
    elif isinstance(each, Rack):
        normal = complex(np.broadcast_to(np.asarray(each.normal), (1,))[0])
        point = complex(each.center[0]) - each.mate_radius * normal
        yield along * value, point, 0.0
        yield abs(value) * each.tangent * normal, point, 0.0


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", [name for name in LOADS if name != "slide-on-lever"])
def test_every_link_is_in_equilibrium(name: str) -> None:
    """Sum of the forces of the tables on each link, with weight and loads of the file, against mass times acceleration
    by nine places beside each other."""
    design = loaded(name)
    q, file = 0.37 * design.design.course.end, LOADS[name]
    speed = SPEED * math.pi / 30.0
    found = design.machine.reactions(np.array([q]))
    driven = {ZOO[name]["drive"]["link"], *ZOO[name]["drive"].get("with", {})}
    slid = {slide["link"]: slide for slide in ZOO[name].get("slides", {}).values()}
    trains = [each for each in found.mechanism.connections if isinstance(each, (Coupling, Feed))]
    size = max(float(np.abs(each).max()) for each in found.unknowns.values())
    nine = design.moving.at(q + _STEP * np.arange(-4, 5), 0)
    for body, link in found.mechanism.links.items():
        if body in driven or any(body == each.second for each in trains):
            continue
        mass = file["links"].get(body, {})
        m, j, at = mass.get("mass", 0.0), mass.get("inertia", 0.0), complex(*mass.get("center", [0, 0]))
        centers = nine.links[body].at(at).value
        wanted = m * (np.dot(_SECOND, centers) / _STEP**2 * speed**2 * 1e-3 - complex(0.5, -9.81))
        turned = j * np.dot(_SECOND, nine.links[body].turn.value) / _STEP**2 * speed**2 * 1e3
        force, moment, center = 0j, 0.0, complex(link.at(at).value[0])
        for each in found.mechanism.connections:
            sign = (body == getattr(each, "second", "")) - (body == each.first)
            for vector, where, couple in _forces(each, found.unknowns[each.name]) if sign else ():
                force += sign * vector
                moment += sign * (((where - center).conjugate() * vector).imag + couple)
        for load in file.get("forces", ()):
            if load["on"] != body:
                continue
            if "torque" in load:
                moment += 1e3 * load["torque"]
            elif "point" in load:
                where, vector = complex(link.at(complex(*load["point"])).value[0]), complex(*load["force"])
                force, moment = force + vector, moment + ((where - center).conjugate() * vector).imag
            else:
                vector = load["force"] * cmath.exp(1j * math.radians(slid[body]["direction"]))
                where = complex(link.origin.value[0])
                force, moment = force + vector, moment + ((where - center).conjugate() * vector).imag
        assert force == pytest.approx(wanted, abs=1e-6 * size), body
        assert moment == pytest.approx(turned, abs=1e-4 * size), body


@pytest.mark.slow
def test_a_slider_crank_has_the_loads_of_its_kind() -> None:
    links = {"crank": {"mass": 1, "inertia": 0.002, "center": [12, 1]},
             "rod": {"mass": 2, "inertia": 0.01, "center": [60, 2]},
             "slider": {"mass": 3}}  # fmt: skip
    forces = [{"on": "slider", "force": -40}]
    other = design(
        "loads", kind="slider-crank", name="one", crank=40, rod=150, offset=10,
        loads={"speed": SPEED, "links": links, "forces": forces},
    )  # fmt: skip
    mine = design(
        "loads", kind="planar-mechanism", name="two", frame={"D": [0, 0]},
        links={"crank": ["D", "E", 40], "rod": ["E", "F", 150], "slider": {"F": [0, 0]}},
        slides={"guide": {"link": "slider", "through": [-10, 0], "direction": -90, "angle": 90}},
        drive={"link": "crank"}, start={"crank": 0, "rod": -90, "guide": 150}, outputs=["guide"],
        loads={"speed": SPEED, "links": links, "forces": forces},
    )  # fmt: skip
    for name in ("input_torque_max", "input_torque_max_at", "input_torque_min", "input_torque_rms", "shaking_force_max",
                 "pin_D.peak", "pin_E.peak", "pin_F.peak", "pin_E.equivalent", "torque_reversals"):  # fmt: skip
        assert mine.raw(name) == pytest.approx(other.raw(name), rel=1e-9), name
    one, two = mine.table("joints", samples=8), other.table("joints", samples=8)
    for column in ("D_x", "D_y", "E_x", "F_y", "guide_moment"):
        mine_, other_ = (np.asarray(each.data[each.columns.index(column)]) for each in (one, two))
        assert mine_ == pytest.approx(other_, abs=1e-9), column
    across = np.asarray(one.data[one.columns.index("guide")])
    assert across == pytest.approx(np.asarray(two.data[two.columns.index("guide_x")]), abs=1e-9)


def test_the_pins_of_a_triangle_of_bars_have_no_friction() -> None:
    """Nothing turns in them; the sense of their friction was that of the rounding errors, another in each row."""
    rigid = {"E": 0.2, "T": 0.2}
    keys: dict[str, Any] = {
        "frame": {"A": [0, 0], "D": [110, 0]},
        "links": {"crank": ["A", "B", 40], "coupler": {"B": [0, 0], "C": [100, 0], "E": [50, 40]},
                  "rocker": ["D", "C", 90], "b1": ["B", "T", 60], "b2": ["E", "T", 50]},
        "drive": {"link": "crank"},
        "start": {"crank": 0, "coupler": 60, "rocker": 105, "b1": 80, "b2": 150},
        "outputs": ["rocker"],
    }  # fmt: skip
    masses = {"coupler": {"mass": 2, "center": [50, 0]}, "b2": {"mass": 1, "center": [40, 10]}}
    with_, without = (
        design(
            "loads", kind="planar-mechanism", name="braced", **keys,
            loads={"speed": SPEED, "links": masses, "friction": {"pin_radius": 10, "joints": joints}},
        ).table("joints", samples=24)
        for joints in (rigid | {"C": 0.1}, {"C": 0.1})
    )  # fmt: skip
    assert with_.columns == without.columns
    for one, other in zip(with_.data, without.data, strict=True):
        assert np.asarray(one) == pytest.approx(np.asarray(other), rel=1e-9, abs=1e-9)


@pytest.mark.slow
def test_a_pass_over_a_range_takes_the_loads_where_they_are() -> None:
    """The same mechanism over its period and over a range of it: rows at equal inputs are equal."""
    section = {"speed": SPEED, **LOADS["watt"]}
    section["forces"] = [{"on": "output", "torque": {"zones": [{"from": 30, "to": 80, "value": 5}]}}]
    whole, part = loaded("watt", **section), None
    from gearlink.core.machines.planar.loads_spec import PlanarLoads as Section

    part = PlanarLoads(made("watt", range={"start": -20, "end": 100}, loads=Section.model_validate({
        "gravity": [0.5, -9.81], **section})))  # fmt: skip
    one, two = whole.table("torque", samples=360), part.table("torque", samples=120)
    torque = np.asarray(one.data[1])
    assert np.asarray(two.data[0])[[0, -1]].tolist() == [-20.0, 100.0]
    assert np.asarray(two.data[1])[20:120] == pytest.approx(torque[:100], abs=1e-12)
    assert -20.0 <= math.degrees(part.input_torque_max_at) <= 100.0


@pytest.mark.parametrize(
    ("more", "loads", "key"),
    [
        ({"range": {"start": 0, "end": 90}}, {"flywheel": {"inertia": 1.0}}, "loads.flywheel"),
        ({"range": {"start": 0, "end": 90}}, {"vibration": {"frequency": 50.0}}, "loads.vibration"),
        ({}, {"links": {"lever": {"mass": 1.0}}}, "loads.links.lever"),
        ({}, {"forces": [{"on": "lever", "torque": 1.0}]}, "loads.forces[0].on"),
    ],
)  # fmt: skip
def test_refusals(more: dict[str, Any], loads: dict[str, Any], key: str) -> None:
    from gearlink.core.machines.planar.loads_spec import PlanarLoads as Section

    section = Section.model_validate({"speed": 60.0, "links": {"coupler": {"mass": 1.0}}, **loads})
    with pytest.raises(NoSolution) as refusal:
        PlanarLoads(made("four-bar", loads=section, **more)).require("loads")
    assert refusal.value.key == key


def test_a_slide_as_drive_has_no_loads() -> None:
    from gearlink.core.machines.planar.loads_spec import PlanarLoads as Section

    section = Section.model_validate({"speed": 60.0, "links": {"rod": {"mass": 1.0}}})
    with pytest.raises(NoSolution) as refusal:
        PlanarLoads(made("cylinder", loads=section)).require("loads")
    assert (refusal.value.code, refusal.value.key) == ("GL113", "drive.slide")


@pytest.mark.slow
def test_what_is_led_round_takes_no_torque_in_the_mean(designs: Path) -> None:
    """Inertia does no work over a revolution: parts of the mean end where the law of the cam changes."""
    opened: Any = opened_from(designs / "planar_cam.yaml", command="loads")
    assert abs(opened.raw("input_torque_mean")) < 1e-12 * opened.raw("input_torque_rms")


@pytest.mark.quick(1)
@pytest.mark.parametrize("dwells", [(150.0, 240.0), (150.0, 360.0), (90.0, 240.0)])
def test_dwells_of_cams_are_those_of_a_disc_cam(dwells: tuple[float, float]) -> None:
    """The vibration of a lever on a cam, as either kind has it: two dwells, one of either, the last over the start.

    Both integrate the same response between the same joints; positions of the planar loop are closed to some 1e-14
    of the lever, which divided by the 0.02 deg of an amplitude leaves 1e-8.
    """
    rest, end = dwells
    given: list[dict[str, Any]] = [{"to": 90, "lift": 20, "law": "modified-sine"}, {"to": rest}]
    motion = [each for k, each in enumerate(given) if k == 0 or rest > 90] + [
        {"to": end, "lift": 0, "law": "cycloidal"}
    ]
    motion += [{"to": 360}] if end < 360 else []
    arm, distance, prime = 100.0, 165.0, 90.0
    swung = math.degrees(math.acos((arm**2 + distance**2 - prime**2) / (2.0 * arm * distance)))
    vibration = {"frequency": 60, "damping": 0.02, "allowed_residual": 0.05}
    one = design(
        kind="disc-cam", command="loads", speed=180, motion=motion, cam={"prime_radius": prime, "sense": 1},
        follower={"type": "oscillating-roller", "roller_radius": 12, "arm": arm, "center_distance": distance, "side": 1,
                  "inertia": 0.04},
        loads={"vibration": vibration},
    )  # fmt: skip
    cam = {"cam": "shaft", "follower": "lever", "point": "R", "roller_radius": 12, "motion": motion}
    other = design(
        kind="planar-mechanism", command="loads", frame={"O": [0, 0], "A": [distance, 0]},
        links={"shaft": {"O": [0, 0]}, "lever": ["A", "R", arm]}, cams={"cam": cam}, drive={"link": "shaft"},
        start={"lever": 180.0 - swung}, outputs=["lever"],
        loads={"speed": 180, "links": {"lever": {"inertia": 0.04}}, "vibration": vibration},
    )  # fmt: skip
    for name in ("rise_periods", "residual_amplitude", "dwell_twist", "twisted_ripple", "residual_speed_limit"):
        assert other.quantity(name).value == pytest.approx(one.quantity(name).value, rel=1e-7), name
    (found,) = other.check("residual-vibration")
    assert found.value == pytest.approx(other.quantity("residual_amplitude").value, rel=1e-12)


def test_a_linkage_without_cams_has_no_dwell() -> None:
    assert loaded(next(iter(LOADS))).quiet_zones == []
