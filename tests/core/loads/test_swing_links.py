"""Wide swings with a slider, and with a cam on a crank-rocker, under load: by geometry alone, a second way.

Of the program this takes the rocker's law of displacement, the radius of its roller, and the force of its device.
Places are written down anew from circles and lines, interpolated by Chebyshev polynomials of degree 90 over the stroke,
and differentiated; the forces follow link by link, and the torque from the change of the energy. Tolerance 1e-8 of the
largest value: the second derivative of such a polynomial has lost 90^4 eps = 1e-8 at the ends, much less inside.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any

import factory
import numpy as np
import pytest
from numpy.polynomial import chebyshev

from gearlink.core.base.errors import GearlinkError
from gearlink.core.machines.wide_swing import remedies as swing_remedies

DEGREE = 90
K = np.array([0.03, 0.11, 0.24, 0.37, 0.44, 0.58, 0.66, 0.79, 0.92, 0.985])
SLIDER = {
    "device_direction": 75,
    "slider_direction": -70,
    "gravity": [1.5, -9.0],
    "links": {"rod": {"mass": 1.3, "inertia": 0.02, "center": [190, 7]}},
    "forces": [{"on": "slider", "force": -12.0}, {"on": "rocker", "torque": 3.0}],
    "roller": {"width": 20},
}
DRIVE = {
    "device_direction": 75,
    "drive_direction": 35,
    "gravity": [1.5, -9.0],
    "links": {
        "crank": {"mass": 1.2, "inertia": 0.002, "center": [10, 4]},
        "coupler": {"mass": 1.5, "inertia": 0.006, "center": [80, -6]},
        "cam": {"mass": 6.0, "inertia": 0.06, "center": [15, 3]},
    },
    "forces": [{"on": "rocker", "torque": 3.0}],
    "roller": {"width": 20},
}
Places = dict[str, Callable[[Any], Any]]


class Course:
    """A place or an angle over the stroke, with derivatives by the input angle of a polynomial through its values."""

    def __init__(self, f: Callable[[Any], Any], span: float) -> None:
        self.series = chebyshev.chebinterpolate(lambda x: f(0.5 * (x + 1.0)), DEGREE)
        self.rate = 2.0 / span

    def __call__(self, k: Any, order: int = 0) -> Any:
        found = chebyshev.chebval(2.0 * k - 1.0, chebyshev.chebder(self.series, order) if order else self.series)
        return found * self.rate**order


class Stroke:
    """The rocker, its roller and its device, which both mechanisms have; of the way home with the places it has there.

    Places are fractions of the stroke at which the rocker stood as it does at k.
    """

    def __init__(self, design: Any, home: Callable[[Any], Any] | None = None) -> None:
        self.design, self.spec, self.section = design, design.spec, design.section
        self.stood, forth = home or np.asarray, design.cam.cycle_angle
        self.begin, self.span = (forth, 2.0 * math.pi - forth) if home else (0.0, forth)
        self.speed = design.speed
        self.place, self.radius = -1e-3 * self.spec.cam.center_distance, 1e-3 * design.cam.rocker_radius
        self.gravity = complex(*self.section.gravity)
        self.aside = design.cam.arm_offset if self.spec.slider else 0.0
        self.rocker = Course(self.swing, self.span)

    def swing(self, k: Any) -> Any:
        """The rocker's angle from mid-swing [rad]."""
        law = self.design.design.motion.law
        return math.radians(self.spec.swing) * (law.invariants(self.stood(np.asarray(k)), 0)[0] - 0.5)

    def roller(self, k: Any) -> Any:
        return self.place + self.radius * np.exp(1j * (self.swing(k) - self.aside))

    def reach(self, k: Any) -> Any:
        """Length of the device from base to rocker [m]."""
        arm = 1e-3 * self.spec.unloader.arm
        return np.abs(arm * self.spec.unloader.pivot_ratio - arm * np.exp(1j * self.swing(k)))

    def pull(self, k: Any) -> tuple[Any, Any]:
        """Force of the device on the rocker, and its torque about D."""
        arm, way = 1e-3 * self.spec.unloader.arm, cmath.rect(1.0, math.radians(self.section.device_direction))
        pin = arm * way * np.exp(1j * self.swing(k))
        line = arm * self.spec.unloader.pivot_ratio * way - pin
        force = self.design.design.unloading.force * line / np.abs(line)
        return force, (np.conj(pin) * force).imag

    def outward(self, k: Any, cam_angle: Callable[[Any], Any]) -> Any:
        """Normal of the roller's path in the turning cam, out of the body, which lies on one side of it all the way."""
        path = Course(lambda x: self.roller(x) * np.exp(-1j * cam_angle(x)), self.span)
        along = path(k, 1) * np.exp(1j * cam_angle(k))
        normal = 1j * along / np.abs(along)
        return normal * np.sign((np.conj(self.roller(k)) * normal).real[0])

    def found(self) -> tuple[Any, Any]:
        phi = self.begin + K * self.span
        return self.design.machine.reactions(phi), phi

    def energy(self, parts: list[tuple[float, float, Course, Course]]) -> Course:
        """Kinetic energy at the speed and energy of place, of (mass, inertia, centre, angle) and the device."""

        def total(k: Any) -> Any:
            moving = sum(0.5 * (m * np.abs(g(k, 1)) ** 2 + j * t(k, 1) ** 2) * self.speed**2 for m, j, g, t in parts)
            weight = sum(-m * (np.conj(self.gravity) * g(k)).real for m, _, g, _ in parts)
            moving = moving + 0.5 * self.spec.inertia * (self.rocker(k, 1) * self.speed) ** 2
            return moving + weight + self.design.design.unloading.force * self.reach(k) - 3.0 * self.rocker(k)

        return Course(total, self.span)


def _cross(a: Any, b: Any) -> Any:
    return (np.conj(a) * b).imag


def _close(found: Any, wanted: Any) -> None:
    assert np.abs(found - wanted).max() <= 1e-8 * max(np.abs(wanted).max(), 1e-3)


@pytest.mark.quick(1)
@pytest.mark.parametrize(("offset", "inertia", "angle"), [(0.0, 0.05, 73.18), (40.0, 0.02, 76.0), (-30.0, 0.3, -70.0)])
def test_slider(offset: float, inertia: float, angle: float) -> None:
    """Rod, slider, guide, contact, shafts and torque."""
    changes = {"slider__offset": offset, "inertia": inertia, "slider__middle_angle": angle}
    stroke = Stroke(factory.design("wide_swing_slider_cam", command="loads", loads=SLIDER, **changes))
    section, speed = stroke.spec.slider, stroke.speed
    away = cmath.rect(1.0, math.radians(-70.0))
    crank, rod = 1e-3 * section.crank, 1e-3 * section.rod

    def pin(k: Any) -> Any:
        return stroke.place + crank * away * np.exp(1j * (stroke.swing(k) + math.radians(angle)))

    def block(k: Any) -> Any:
        local = np.conj(away) * (pin(k) - stroke.place)
        along = local.real + np.sqrt(rod**2 - (local.imag + 1e-3 * offset) ** 2)
        return stroke.place + away * (along - 1e-3j * offset)

    e, f = Course(pin, stroke.span), Course(block, stroke.span)
    turn = Course(lambda k: np.unwrap(np.angle((block(k) - pin(k)) / away)), stroke.span)
    center = Course(lambda k: pin(k) + (block(k) - pin(k)) / rod * complex(0.19, 0.007), stroke.span)
    mass, g = 1.3, stroke.gravity
    on_slider = section.mass * (f(K, 2) * speed**2 - g) + 12.0 * away
    on_rod = mass * (center(K, 2) * speed**2 - g)
    moment = 0.02 * turn(K, 2) * speed**2 + _cross(center(K) - e(K), on_rod)
    # what the slider takes along its way comes through the rod; across it the guide bears the rest
    along = (np.conj(away) * on_slider).real
    line = f(K) - e(K)
    across = -(moment + _cross(line, along * away)) / _cross(line, 1j * away)
    pin_f = along * away + across * 1j * away
    pin_e = on_rod + pin_f
    pull, device = stroke.pull(K)
    normal = stroke.outward(K, lambda k: -stroke.span * np.asarray(k))
    turning = stroke.spec.inertia * stroke.rocker(K, 2) * speed**2
    arm = stroke.roller(K) - stroke.place
    contact = (turning - device - 3.0 + _cross(e(K) - stroke.place, pin_e)) / _cross(arm, normal)
    found, phi = stroke.found()
    # the sign of a couple at F: the rod's moment about E is that of the forces on it
    _close(found.force("F"), pin_f)
    _close(found.force("E"), pin_e)
    _close(found.unknowns["guide"][0], (np.conj(1j * away) * (on_slider - pin_f)).real)
    _close(found.unknowns["roller"][0], contact)
    _close(found.force("D"), pin_e - pull - contact * normal)
    _close(found.force("O"), contact * normal)
    parts = [(mass, 0.02, center, turn), (section.mass, 0.0, f, Course(lambda k: 0.0 * np.asarray(k), stroke.span))]
    drag = Course(lambda k: 12.0 * (np.conj(away) * block(k)).real, stroke.span)
    torque = stroke.energy(parts)(K, 1) + drag(K, 1)
    _close(found.torque, torque)
    _close(stroke.design.machine.torque(phi), torque)
    assert stroke.design.power_identity <= 1e-12


def crank_rocker(bar: Any, span: float, *, begin: float = 0.0) -> Places:
    """Crank pin B and cam pin C from a crank angle of the turn on; the cam turns clockwise in the stroke."""
    a, b, c, d = (1e-3 * getattr(bar, name) for name in ("crank", "coupler", "rocker", "frame"))
    base = cmath.rect(d, math.radians(35.0))
    reach, folded = (b + a, 0.0) if bar.stroke == "outward" else (b - a, math.pi)
    lean = math.acos((d * d + reach * reach - c * c) / (2.0 * d * reach))

    def linkage(mirror: float, begin: float, span: float) -> Places:
        side = mirror * bar.assembly
        start = cmath.phase(-base) + side * lean + folded

        def crank(k: Any) -> Any:
            return base + a * np.exp(1j * (start + mirror * (begin + span * np.asarray(k))))

        def end(k: Any) -> Any:
            line = -crank(k)
            n = np.abs(line)
            along = (b * b - c * c + n * n) / (2.0 * n)
            return crank(k) + line / n * (along + 1j * side * np.sqrt((b - along) * (b + along)))

        return {"b": crank, "c": end}

    forth = [linkage(mirror, 0.0, begin or span) for mirror in (1.0, -1.0)]
    clockwise = [_cross(places["c"](0.4), places["c"](0.6)) < 0.0 for places in forth]
    assert clockwise.count(True) == 1
    sense = (1.0, -1.0)[clockwise.index(True)]
    return {**linkage(sense, begin, span), "sense": lambda _: sense, "base": lambda _: base}


@pytest.mark.quick(1)
@pytest.mark.parametrize("home", [False, True])
@pytest.mark.parametrize(("assembly", "way"), [(1, "outward"), (-1, "outward"), (1, "homeward")])
def test_cam_on_a_crank_rocker(assembly: int, way: str, home: bool) -> None:
    """Crank, coupler, cam, contact, shafts and torque; on the way home the rocker stands where the cam held it."""
    changes = {"drive__assembly": assembly, "drive__stroke": way}
    design = factory.design("wide_swing_oscillating_cam", command="loads", loads=DRIVE, **changes)
    bar, span = design.spec.drive, design.cam.cycle_angle
    places = forth = crank_rocker(bar, span)
    if home:
        places = crank_rocker(bar, 2.0 * math.pi - span, begin=span)

    def stood(k: Any) -> Any:
        """Bisected: the cam's pin goes clockwise in the stroke."""
        wanted, low, high = places["c"](k), np.zeros_like(k), np.ones_like(k)
        for _ in range(60):
            middle = 0.5 * (low + high)
            before = _cross(forth["c"](middle), wanted) < 0.0
            low, high = np.where(before, middle, low), np.where(before, high, middle)
        return 0.5 * (low + high)

    stroke = Stroke(design, stood if home else None)
    speed, g, base, sense = stroke.speed, stroke.gravity, places["base"](0), places["sense"](0)

    def angle(f: Callable[[Any], Any]) -> Callable[[Any], Any]:
        middle = f(np.array([0.5]))[0]
        return lambda k: np.angle(f(np.asarray(k)) / middle) + cmath.phase(middle)

    turns = {
        "crank": angle(lambda k: places["b"](k) - base),
        "coupler": angle(lambda k: places["c"](k) - places["b"](k)),
        "cam": angle(places["c"]),
    }
    origin = {"crank": lambda _: base, "coupler": places["b"], "cam": lambda _: 0j}
    bodies = {}
    for name, body in DRIVE["links"].items():  # type: ignore[attr-defined]
        offset = 1e-3 * complex(*body["center"])
        g_of = Course(lambda k, n=name, z=offset: origin[n](k) + z * np.exp(1j * turns[n](k)), stroke.span)  # type: ignore[misc]
        bodies[name] = (body["mass"], body["inertia"], g_of, Course(turns[name], stroke.span))
    inertial = {n: m * (x(K, 2) * speed**2 - g) for n, (m, _, x, _) in bodies.items()}
    couple = {n: j * t(K, 2) * speed**2 for n, (_, j, _, t) in bodies.items()}
    at = {n: x(K) for n, (_, _, x, _) in bodies.items()}
    pull, device = stroke.pull(K)
    normal = stroke.outward(K, turns["cam"])
    roller = stroke.roller(K)
    turning = stroke.spec.inertia * stroke.rocker(K, 2) * speed**2
    contact = (turning - device - 3.0) / _cross(roller - stroke.place, normal)
    # the cam's moment about O and the coupler's about B give the force at C
    at_b, at_c = places["b"](K), places["c"](K)
    of_cam = couple["cam"] + _cross(at["cam"], inertial["cam"]) + _cross(roller, contact * normal)
    of_coupler = couple["coupler"] + _cross(at["coupler"] - at_b, inertial["coupler"])
    rows = np.array([[-at_c.imag, at_c.real], [(at_c - at_b).imag, -(at_c - at_b).real]]).transpose(2, 0, 1)
    x, y = np.linalg.solve(rows, np.array([of_cam, of_coupler]).T[..., None])[..., 0].T
    pin_c = x + 1j * y
    pin_b = inertial["coupler"] + pin_c
    pin_a = inertial["crank"] + pin_b
    drive = couple["crank"] + _cross(at["crank"] - base, inertial["crank"]) + _cross(at_b - base, pin_b)
    found, phi = stroke.found()
    _close(found.unknowns["roller"][0], contact)
    for name, force in (("C", pin_c), ("B", pin_b), ("A", pin_a)):
        _close(found.force(name), force)
    _close(found.force("O"), inertial["cam"] + contact * normal - pin_c)
    _close(found.force("D"), -pull - contact * normal)
    _close(found.torque, sense * drive)
    _close(stroke.design.machine.torque(phi), stroke.energy(list(bodies.values()))(K, 1))
    assert stroke.design.power_identity <= 1e-12


@pytest.mark.quick(1)
@pytest.mark.parametrize("base", ["wide_swing_slider_cam", "wide_swing_oscillating_cam"])
def test_device_leaves_its_reserve_alone(base: str) -> None:
    """Without other masses the cam carries the reserve's share of the device, as the closed form has it."""
    design = factory.design(base, command="loads", loads={"roller": {"width": 20}})
    stroke = design.strokes[0]
    assert design.design.unloading.contact_force(stroke.cam, K) == pytest.approx(stroke.force(K), rel=1e-10)
    assert design.contact_force_max == pytest.approx(design.design.contact_force, rel=1e-9)


@pytest.mark.slow
def test_the_arm_at_which_both_change_sides_is_named() -> None:
    geometry = factory.design("wide_swing_slider_cam", slider__middle_angle=90)
    (found,) = geometry.findings("swing", "side-change")
    assert (found.code, found.status) == ("GL514", "fail")
    assert found.remedy == (("slider.middle_angle", 73.18),)


HEAVY = {"type": "spring", "pivot_ratio": 4, "stretch_ratio": 0.5, "arm": 80, "reserve": 0.3}
"""A spring that pulls little at mid-swing, under which the slider's mass makes the rocker slowest there."""


@pytest.mark.slow
def test_a_lighter_slider_lets_both_change_sides_together() -> None:
    """Not half the mass but a fifth of it; the arm stands already where the slider is fastest."""
    heavy = factory.design("wide_swing_slider_cam", slider__middle_angle=73.18, unloader=HEAVY)
    (found,) = heavy.check("side-change")
    assert (found.code, found.status) == ("GL514", "fail")
    assert "the roller is pushed off its cam near mid-swing" in found.message
    ways = list(swing_remedies.candidates(heavy, "side-change"))
    assert ways == [
        (("slider.mass", pytest.approx(share * heavy.spec.slider.mass, rel=1e-12)),) for share in (0.5, 0.2, 0.1)
    ]
    found = [
        factory.design("wide_swing_slider_cam", slider__middle_angle=73.18, slider__mass=mass, unloader=HEAVY)
        for ((_, mass),) in ways[:2]
    ]
    assert [check.status for made in found for check in made.check("side-change")] == ["fail", "pass"]


def test_lost_contact_is_repaired_by_the_arm_alone_or_with_more_reserve() -> None:
    apart = factory.design(
        "wide_swing_slider_cam", command="loads", slider__middle_angle=90, loads={"roller": {"width": 20}}
    )
    (loss,) = [f for f in apart.check("contact-loss") if f.value == apart.least_contact_force]
    assert (loss.code, loss.status) == ("GL608", "fail")
    assert "missing contact force: the roller leaves its cam" in loss.message
    ways = list(apart.candidates("contact-loss"))
    arm, reserve, mass = ("slider.middle_angle", 73.18), apart.spec.unloader.reserve, apart.spec.slider.mass
    assert ways[:3] == [
        (arm,),
        (arm, ("unloader.reserve", pytest.approx(reserve + 0.25, rel=1e-12))),
        (arm, ("unloader.reserve", pytest.approx(reserve + 1.0, rel=1e-12))),
    ]
    assert ways[3] == (arm, ("slider.mass", pytest.approx(0.5 * mass, rel=1e-12)))
    assert list(apart.candidates("side-change")) == []


@pytest.mark.slow
def test_device_and_roller_change_sides_together() -> None:
    """Where the slider is not fastest at mid-swing the device pushes the roller off its profile between the two."""
    apart = factory.design(
        "wide_swing_slider_cam", command="loads", slider__middle_angle=90, loads={"roller": {"width": 20}}
    )
    law, cam = apart.design.motion.slider, apart.cam
    between = np.array([0.5 * (law.middle_place + apart.design.slot_of(cam)[0])])
    assert apart.design.unloading.contact_force(cam, between)[0] < 0.0
    (loss,) = [f for f in apart.findings("loads", "contact-loss") if f.value == apart.least_contact_force]
    assert (loss.status, loss.remedy) == ("fail", (("slider.middle_angle", 73.18),))
    # under a spring that pulls little at mid-swing the slider's mass makes the rocker slowest there
    heavy = factory.design("wide_swing_slider_cam", slider__middle_angle=73.18, unloader=HEAVY)
    assert heavy.cam.middle < 0.3
    (found,) = heavy.findings("swing", "side-change")
    assert (found.status, found.remedy) == ("fail", (("slider.mass", 1.2),))
    mended = factory.design("wide_swing_slider_cam", slider__middle_angle=73.18)
    assert mended.check("side-change")[0].status == "pass"
    assert mended.cam.middle == pytest.approx(mended.motion.slider.middle_place, abs=2e-4)


@pytest.mark.quick(4)
@pytest.mark.parametrize(
    ("base", "loads", "key"),
    [
        ("wide_swing_slider_cam", {"links": {"coupler": {"mass": 1}}}, "loads.links.coupler"),
        ("wide_swing_oscillating_cam", {"links": {"rod": {"mass": 1}}}, "loads.links.rod"),
        ("wide_swing_twin_cam", {"links": {"return_cam": {"mass": 1}}}, "loads.links.return_cam"),
        ("wide_swing_slider_cam", {"gravity": [0, -9.81]}, "loads.gravity"),
        ("wide_swing_oscillating_cam", {"gravity": [0, -9.81]}, "loads.gravity"),
        ("wide_swing_slider_cam", {"motor": {"no_load_speed": 1500, "slope": 1}}, "loads.motor"),
        ("wide_swing_slider_cam", {"flywheel": {"inertia": 1}}, "loads.flywheel"),
        ("wide_swing_slider_cam", {"vibration": {"stiffness": 1e4}}, "loads.vibration.stiffness"),
        ("wide_swing_slider_cam", {"forces": [{"on": "slider", "torque": 1}]}, "loads.forces[0].torque"),
    ],
)
def test_what_is_refused(base: str, loads: dict[str, Any], key: str) -> None:
    quantity = "natural_frequency" if "vibration" in loads else "input_torque_max"
    with pytest.raises(GearlinkError) as caught:
        factory.design(base, command="loads", loads=loads).report("loads", quantities=[quantity])
    assert caught.value.key == key


@pytest.mark.slow
def test_the_way_home_of_a_cam_on_a_crank_rocker_is_under_load() -> None:
    """A torque of 1 N m on the rocker left the roller 5 N in the stroke; on the way home it takes 7.5 N too much."""
    design = factory.design("loaded_oscillating_cam", command="loads", loads__forces=[{"on": "rocker", "torque": 1}])
    forth, home = (stroke.pressed["least_force"].value for stroke in design.strokes)
    assert (forth > 4.0, home) == (True, pytest.approx(-7.4963, abs=1e-4))
    assert [check.status for check in design.check("contact-loss")] == ["fail", "fail"]


@pytest.mark.slow
def test_a_crank_rocker_has_a_whole_turn() -> None:
    """Weights and the device take nothing over a revolution; a flywheel and a motor have what they need."""
    loads = {"gravity": [3.0, -9.81], "drive_direction": 20, "flywheel": {"inertia": 3.0}, "roller": {"width": 20}}
    links = {"crank": {"mass": 1.2, "inertia": 0.002, "center": [10, 4]}, "cam": {"mass": 6.0, "inertia": 0.06}}
    design = factory.design("wide_swing_oscillating_cam", command="loads", loads={**loads, "links": links})
    assert abs(design.input_torque_mean) <= 1e-11 * design.input_torque_max
    assert design.power_identity <= 1e-12
    assert 0.0 < design.raw("speed_fluctuation") < 0.1
    assert design.pin("O").travel == pytest.approx(2.0 * design.cam.drive.swing / (2.0 * math.pi), rel=1e-9)
    assert [len(design.table(name).columns) > 1 for name in ("torque", "contact_stroke")] == [True, True]
    assert design.table("torque").length == 360


def test_joints_whose_neighbours_are_unknown_are_left_out() -> None:
    for base, shown in (("wide_swing_slider_cam", {"O", "E", "F"}), ("wide_swing_oscillating_cam", {"A", "B", "C"})):
        design = factory.design(base, command="loads", loads={"device_direction": 90})
        columns = design.table("joints").columns
        assert {name for name in design.pins if name in columns} - {"D"} == shown
        assert ("D" in columns) == (base == "wide_swing_oscillating_cam")


@pytest.mark.slow
def test_standstills_of_the_cam_are_no_noise() -> None:
    """Beside a standstill the roller's way has no digits of its own; forces there are those of the limit."""
    design = factory.design("loaded_oscillating_cam", command="loads")
    near = np.array([0.0, 1e-17, 1e-15, 1e-12, 1e-9])
    for stroke in design.strokes:
        for k in (near, 1.0 - near):
            assert stroke.force(k) == pytest.approx(stroke.force(k[:1])[0], rel=1e-7)
    assert design.pin("O").equivalent < design.pin("O").peak
    found = {q.name: q.value for q in design.report("loads").quantities}
    assert found["shear_depth"] < 0.1
    assert found["entrainment_speed_max"] < 1000.0
    assert "cam_torque_max" not in found


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("base", "changes"),
    [
        ("wide_swing_twin_cam", {}),
        ("wide_swing_twin_rocker", {}),
        ("wide_swing_slider_cam", {}),
        ("wide_swing_cycle", {"layout": "twin-cam"}),
    ],
)
def test_cams_stand_in_the_frames_of_their_tables(base: str, changes: dict[str, Any]) -> None:
    """The roller's centre, seen from the cam that guides it, is the table's pitch point."""
    design = factory.design(base, command="loads", loads={"roller": {"width": 20}}, **changes)
    for stroke, table, cam in zip(design.strokes, ("main_cam", "return_cam"), ("cam", "return_cam"), strict=False):
        rows = design.design.table(table)
        pitch = np.array(rows["pitch_x"]) + 1j * np.array(rows["pitch_y"])
        k = np.array(rows["k"])[1:-1]
        mechanism = design.machine.at(stroke.start + k * stroke.cam.cycle_angle)
        roller = next(each for each in mechanism.connections if each.name == "roller")
        seen = roller.at * np.exp(-1j * mechanism.links[cam].turn.value)
        assert np.abs(seen - pitch[1:-1]).max() <= 1e-9 * np.abs(pitch).max()


@pytest.mark.parametrize("way", ["outward", "homeward"])
def test_directions_left_out_are_those_of_the_film(way: str) -> None:
    from gearlink.cli.views.figures.wide_swing_cam import Cycle, _slider

    design = factory.design("wide_swing_oscillating_cam", command="loads", drive__stroke=way, loads={})
    phi = np.array([0.2, 1.1, 2.3])
    drawn = Cycle(design.design, phi / (2.0 * math.pi)).pins
    links = design.machine.at(phi).links
    shift = design.spec.cam.center_distance
    for name, place in {"crank": "A", "coupler": "B", "cam": "O"}.items():
        assert np.abs(links[name].origin.value + shift - drawn[place]).max() <= 1e-9
    swung = factory.design("wide_swing_slider_cam", command="loads", loads={})
    cycle = Cycle(swung.design, phi / swung.cam.cycle_angle * 0.5 * 150.0 / 180.0)
    _, chain = _slider(cycle)
    at = swung.machine.at(cycle.stroke * swung.cam.cycle_angle).links
    assert np.abs(at["slider"].origin.value + shift - chain.joints[2]).max() <= 1e-9  # type: ignore[union-attr]
    assert np.abs(at["rod"].origin.value + shift - chain.joints[1]).max() <= 1e-9  # type: ignore[union-attr]


def test_a_mass_of_nothing_is_as_one_that_is_left_out() -> None:
    """`rod: null` is no rod, and refused nowhere."""
    made = factory.design("loaded_wide_swing", command="loads", loads__links={"rod": None})
    assert made.own_links == factory.design("loaded_wide_swing", command="loads").own_links
