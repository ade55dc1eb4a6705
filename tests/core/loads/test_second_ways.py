"""Loads by ways that share nothing with the program: Lagrange at 40 digits, a published mechanism, every kind's power.

Andrews' seven-body mechanism is published with 10 to 16 digits of its state at 0.03 s; the torque that drives it and
the forces in its joints come out of that state to 2e-9, which the digits allow.
"""

from __future__ import annotations

import itertools
import math
from typing import Any

import factory
import mpmath
import numpy as np
import pytest
import yaml
from loaded import LOADS, loaded
from sweeps import mostly_slow

from gearlink.core.base.errors import GearlinkError
from gearlink.core.base.kinds import KINDS
from gearlink.core.mechanism.dynamics import Force, Mass, reduced
from gearlink.core.mechanism.friction import settled, with_friction
from gearlink.core.mechanism.joints import Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import Point, Turn, carried, fixed


def test_every_kind_that_has_loads_is_here() -> None:
    # a whole machine has no joints of its own: tests/core/machine holds its loads to those of its members
    assert {*LOADS, "machine"} == {name for name, kind in KINDS.items() if "loads" in kind.commands}


ELSEWHERE = {"planar-mechanism", "measured-cam"}
"""Their own tests look at the same, planar/test_loads.py and cams/test_measured_cam.py."""


@pytest.mark.parametrize(
    "kind", [kind if kind not in ELSEWHERE else pytest.param(kind, marks=pytest.mark.slow) for kind in LOADS]
)
def test_both_input_torques_agree_in_every_kind(kind: str) -> None:
    """Virtual power and reactions, 1e-12 of the largest."""
    assert loaded(kind).power_identity <= 1e-12


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", [kind for kind in LOADS if kind not in ("gear-pair", "flatbed-press")])
def test_friction_in_every_kind_takes_power(kind: str) -> None:
    free, rubbing = (
        loaded(kind, friction=None),
        loaded(kind, friction={"pins": 0.05, "pin_radius": 4, "meshes": 0.98}),
    )
    assert rubbing.power_identity <= 1e-12
    assert rubbing.input_power_mean > free.input_power_mean


# Lagrange


def test_four_bar_by_lagrange_at_forty_digits() -> None:
    """M = J' w^2/2 + V' with J and V from places found in mpmath and differentiated there; 1e-12 of the largest."""
    section = factory.worked("loaded_feed")["loads"]
    design = factory.design("loaded_feed", command="loads", loads__forces=[], loads__flywheel=None, loads__motor=None)
    a, b, c, d = (getattr(design.design.linkage, name) for name in ("crank", "coupler", "rocker", "frame"))
    gravity, w = section["gravity"][1], design.speed
    ratio_2, ratio_3 = -40.0 / 72.0, -72.0 / 40.0

    def angles(phi: Any) -> tuple[Any, Any]:
        pin = a * mpmath.expj(phi)
        way = d - pin
        n = abs(way)
        side = mpmath.acos((b * b + n * n - c * c) / (2 * b * n)) * design.design.linkage.assembly
        two = mpmath.arg(way) + side
        return two, mpmath.arg(pin + b * mpmath.expj(two) - d)

    def places(phi: Any) -> list[tuple[Any, Any, dict[str, Any]]]:
        two, three = angles(phi)
        pin = a * mpmath.expj(phi)
        idler = ratio_2 * phi + (1 - ratio_2) * two
        output = ratio_3 * idler + (1 - ratio_3) * three
        links = section["links"]
        found = []
        for name, origin, turn in (
            ("crank", mpmath.mpc(0), phi),
            ("coupler", pin, two),
            ("rocker", mpmath.mpc(d), three),
            ("idler", d + c * mpmath.expj(three), idler),
            ("output", mpmath.mpc(d), output),
        ):
            x, y = links[name].get("center", [0, 0])
            found.append((origin + mpmath.mpc(x, y) * mpmath.expj(turn), turn, links[name]))
        return found

    def inertia(phi: Any) -> Any:
        def coordinates(at: Any) -> Any:
            return mpmath.matrix([x for g, t, _ in places(at) for x in (g.real / 1000, g.imag / 1000, t)])

        step = mpmath.mpf(10) ** -12
        rate = (8 * (coordinates(phi + step) - coordinates(phi - step))
                - (coordinates(phi + 2 * step) - coordinates(phi - 2 * step))) / (12 * step)  # fmt: skip
        weights = [m.get(key, 0) for *_, m in places(phi) for key in ("mass", "mass", "inertia")]
        return sum(weight * value**2 for weight, value in zip(weights, rate, strict=True))

    def height(phi: Any) -> Any:
        return sum(m.get("mass", 0) * g.imag / 1000 for g, _, m in places(phi))

    phi = np.array([0.4, 2.9, 5.1])
    with mpmath.workdps(50):
        wanted = [
            float(mpmath.diff(inertia, x, h=mpmath.mpf(10) ** -10) * w * w / 2 - gravity * mpmath.diff(height, x))
            for x in map(mpmath.mpf, phi.tolist())
        ]
    assert design.machine.torque(phi) == pytest.approx(wanted, abs=1e-11 * max(map(abs, wanted)))


# Andrews


def _andrews() -> tuple[Mechanism, dict[str, Mass], list[Any]]:
    """The mechanism at 0.03 s in mm, derivatives by time, and the force of its spring."""
    be, th, ga, ph, de, om, ep = (
        Turn(*(np.array([x]) for x in values))
        for values in zip(
            (15.81077119629904, -15.75637105984298, 0.04082224013073101, -0.5347301163226948, 0.5244099658805303,
             0.5347301163226948, 1.048080741042263),
            (1139.920302151208, -1424.379294994111, 11.03291221937134, 19.29337464421385, 0.5735699284790808,
             -19.29337464421385, 0.3231791658026955),
            (-24631.76316945196, 51850.37701610329, 324102.5686413781, 566749.3645176213, 16743.62929479361,
             -566749.3645176222, 9826.520791458423),
            strict=True,
        )
    )  # fmt: skip

    def plus(one: Turn, two: Turn) -> Turn:
        return Turn(*(x + y for x, y in zip(one, two, strict=True)))

    a, b, o = (fixed(place, np.zeros(1)) for place in (-69.34 - 2.27j, -36.35 + 32.73j, 0j))
    first = Link(o, be)
    second = Link(first.at(7.0), plus(be, th))
    fifth, seventh = Link(a, de), Link(a, ep)
    fourth, sixth = Link(fifth.at(40.0), plus(ph, de)), Link(seventh.at(-40j), plus(om, ep))
    links = {"1": first, "2": second, "3": Link(b, ga), "4": fourth, "5": fifth, "6": sixth, "7": seventh}
    end = second.at(-28.0).value
    pins = [
        Pin("O", FRAME, "1", o.value), Pin("F", "1", "2", second.origin.value),
        Pin("E3", "2", "3", end), Pin("E4", "2", "4", end), Pin("E6", "2", "6", end),
        Pin("B", FRAME, "3", b.value), Pin("A5", FRAME, "5", a.value), Pin("A7", FRAME, "7", a.value),
        Pin("H", "5", "4", fourth.origin.value), Pin("G", "7", "6", sixth.origin.value),
    ]  # fmt: skip
    masses = {
        "1": Mass(0.04325, 2.194e-6, 0.92 + 0j), "2": Mass(0.00365, 4.410e-7, -11.5 + 0j),
        "3": Mass(0.02373, 5.255e-6, 10.43 - 18.74j), "4": Mass(0.00706, 5.667e-7, -(20.0 - 14.21) * 1j),
        "5": Mass(0.07050, 1.169e-5, 23.08 + 9.16j), "6": Mass(0.00706, 5.667e-7, 20.0 - 14.21 + 0j),
        "7": Mass(0.05498, 1.912e-5, -4.49 - 12.28j),
    }  # fmt: skip
    arm = carried(b, ga, 20.0 - 18.0j)
    way = 14.0 + 72.0j - arm.value
    pull = 4.53 * (np.abs(way) - 77.85) * way / np.abs(way)
    return Mechanism(links, pins, "1"), masses, [Force("3", pull, Point(*arm))]


def test_andrews_mechanism_needs_the_torque_that_drives_it() -> None:
    """0.033 N m by reactions and by virtual power; multipliers are the forces of its three closed loops at E."""
    mechanism, masses, applied = _andrews()
    ends = [mechanism.links["3"].at(-35j), mechanism.links["4"].at(-20j), mechanism.links["6"].at(20.0)]
    for end in ends:  # the published state closes the loops
        assert complex(end.value[0]) == pytest.approx(complex(mechanism.links["2"].at(-28.0).value[0]), abs=1e-7)
    found = with_friction(*settled(mechanism, masses, applied, 0j, 1.0, None), None, 1.0)
    assert found.torque[0] == pytest.approx(0.033, rel=2e-8)
    power = reduced(mechanism, masses, applied, 0j).torque(1.0)[0]
    assert power / mechanism.links["1"].turn.first[0] == pytest.approx(0.033, rel=2e-8)
    forces = [np.abs(found.force(name)[0]) for name in ("E3", "E4", "E6")]
    published = [199.175333373191, -29.75531228015052, 23.06654119098399, 31.45271365475927, 22.64249232082739,
                 11.61740700019673]  # fmt: skip
    assert forces == pytest.approx([math.hypot(*published[i : i + 2]) for i in (0, 2, 4)], rel=3e-9)


# Refused


def test_change_point_linkage_is_refused() -> None:
    """A parallelogram: nothing says which way it folds where all its links lie in line. Rocker 60 mm, as the crank."""
    loads = {"speed": 60, "links": {"coupler": {"mass": 1.5, "inertia": 0.01}}}
    with pytest.raises(GearlinkError) as caught:
        factory.design(
            "wide_lever", command="loads", loads=loads, target=None, links={"crank": 60, "coupler": 80, "frame": 80}
        ).report("loads")
    assert "links" in (caught.value.key or "")


def test_what_has_no_masses_computes_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    """Another command on a file with loads, and every command on one without, never asks for the links' motion."""
    from gearlink.core.machines.three_gear.loads import ThreeGearLoads

    def refuse(*_: Any) -> Any:
        raise AssertionError("loads were computed")

    monkeypatch.setattr(ThreeGearLoads, "moving", property(refuse))
    assert factory.design("loaded_feed").report("analyze").quantities
    with pytest.raises(GearlinkError, match="needs the section loads"):
        factory.design("candy_feed", command="loads").report("loads")


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    "name",
    mostly_slow(
        ["ty460", "swing_gripper", "gear_pair", "wide_swing_twin_cam", "loaded_feed", "wide_lever",
         "two_gear_drag_link", "mutilated_gear_press", "hypocycloid_slider", "five_bar_path", "geared_six_bar",
         "ty460_slider_crank", "crank_rocker_links"],
        4,
    ),
)  # fmt: skip
def test_the_section_that_is_named_where_none_is_there_serves(name: str) -> None:
    with pytest.raises(GearlinkError, match="needs the section loads") as refused:
        factory.design(name, command="loads", loads=None).report("loads")
    written = str(refused.value).split("such as ")[1].split(" (")[0]
    data = {**factory.worked(name), **yaml.safe_load(written)}
    assert factory.design(data, command="loads").report("loads").checks


@pytest.mark.parametrize("name", ["loaded_feed", "loaded_gripper"])
def test_time_is_the_integral_of_the_pace_whatever_rows_are_asked_for(name: str) -> None:
    """Exactly the same in every table; and Simpson's rule between the breaks, good to (0.05 deg)^4 of the fifth
    derivative, some 1e-10 of the period."""
    loads: Any = factory.design(name, command="loads")
    fine, coarse = loads.table("speed", samples=360), loads.table("speed", samples=12)
    place = fine.columns.index("time")
    times = np.asarray(fine.data[place])
    assert np.array_equal(times[::30], np.asarray(coarse.data[place]))
    machine, total = loads.machine, 0.0
    for low, high in itertools.pairwise([0.0, *machine.breaks, machine.period]):
        steps = 2 * max(1, math.ceil((high - low) / math.radians(0.1)))
        inside = np.linspace(low, high, steps + 1)
        inside[0], inside[-1] = np.nextafter(low, high), np.nextafter(high, low)
        pace = 1.0 / np.abs(loads.running.speed(inside))
        total += (high - low) / (3 * steps) * (pace[0] + 4.0 * pace[1::2].sum() + 2.0 * pace[2:-1:2].sum() + pace[-1])
    assert float(loads.running.time(np.array([machine.period]))[0]) == pytest.approx(total, rel=1e-9)
