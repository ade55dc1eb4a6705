"""Joint and tooth forces by an augmented system: constraints as equations of the coordinates, multipliers as forces.

[M  C^T; C  0] [a; lambda] = [Q; gamma],  C = dPhi/dq by complex steps, gamma by differences of sixth order

It shares the places of the links with the program, nothing of its columns, its accelerations or its radial forces: the
teeth are true involutes, r_b1 (t1 - psi) + r_b2 (t2 - psi) -+ (r_b1 + r_b2) inv(alpha(a)), pressed apart. Accelerations
come out as well. Tolerance 1e-8 of the largest force: differences of sixth order over 1e-3 rad leave about 1e-10.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from six_bars import SIX_BARS

from gearlink.core.mechanism.dynamics import Force
from gearlink.core.mechanism.joints import NEWTON_METER, Contact, Guide, Mesh, Pin, Rack
from gearlink.core.mechanism.links import FRAME
from gearlink.core.mechanism.rates import cross

CASES = json.loads((Path(__file__).parents[2] / "reference" / "loads.json").read_text())["cases"]
STEP = 1e-3
PASSES = 60
"""Friction makes forces that make friction: each pass leaves less than 0.6 of the change of the one before."""
RUBBING = {"pins": 0.04, "pin_radius": 5.0, "meshes": 0.9}
TINY = 1e-30


class Augmented:
    """The constraints of a machine at one input angle; coordinates are (x, y, angle) of each centre of mass, in mm."""

    def __init__(self, design: Any, phi: float) -> None:
        self.design, self.machine = design, design.machine
        self.phi = at = np.array([phi])
        self.mechanism, self.found = self.machine.at(at), self.machine.reactions(at)
        self.names = list(self.mechanism.links)
        masses = [self.machine.masses.get(name) for name in self.names]
        self.points = [
            self.mechanism.links[name].at(0j if mass is None else mass.center)
            for name, mass in zip(self.names, masses, strict=True)
        ]
        turns = [self.mechanism.links[name].turn for name in self.names]
        pairs = list(zip(self.points, turns, strict=True))
        self.q = np.array([x for p, t in pairs for x in (p.value[0].real, p.value[0].imag, t.value[0])])
        self.rate = np.array([x for p, t in pairs for x in (p.first[0].real, p.first[0].imag, t.first[0])])
        self.bend = np.array([x for p, t in pairs for x in (p.second[0].real, p.second[0].imag, t.second[0])])
        self.mass = np.array([x for m in masses for x in ((m.tonnes, m.tonnes, m.moment) if m else (0.0, 0.0, 0.0))])

    def carried(self, name: str, place: complex, q: Any) -> tuple[Any, Any]:
        """A point that is now at a place and goes with a link, at other coordinates."""
        if name == FRAME:
            return place.real, place.imag
        k = 3 * self.names.index(name)
        arm = place - complex(self.q[k], self.q[k + 1])
        c, s = np.cos(q[k + 2] - self.q[k + 2]), np.sin(q[k + 2] - self.q[k + 2])
        return q[k] + c * arm.real - s * arm.imag, q[k + 1] + s * arm.real + c * arm.imag

    def angle(self, name: str, q: Any) -> Any:
        """The angle of a link, less what it is now."""
        k = 3 * self.names.index(name) + 2 if name != FRAME else 0
        return 0.0 if name == FRAME else q[k] - self.q[k]

    def constraints(self, q: Any) -> list[Any]:
        """Every equation that the joints and the drive put on the coordinates."""
        found: list[Any] = []
        for each in self.mechanism.connections:
            if isinstance(each, (Mesh, Rack, Contact)):
                one = {Mesh: self._teeth, Rack: self._rack, Contact: self._roller}[type(each)]
                found.append(one(each, q))  # type: ignore[operator]
                continue
            assert isinstance(each, (Pin, Guide))
            place = complex(each.at[0])
            (x1, y1), (x2, y2) = (self.carried(name, place, q) for name in (each.first, each.second))
            if isinstance(each, Pin):
                found += [x2 - x1, y2 - y1]
            else:
                across = 1j * each.along
                found += [(x2 - x1) * across.real + (y2 - y1) * across.imag, NEWTON_METER * self.angle(each.second, q)]
        return [*found, NEWTON_METER * self.angle(self.mechanism.drive, q) * self.mechanism.sense]

    def _teeth(self, mesh: Mesh, q: Any) -> Any:
        toward = complex(np.ravel(mesh.toward)[0])
        ring = -1.0 if mesh.internal else 1.0
        one, two = mesh.radius, ring * mesh.mate_radius
        center = complex(mesh.center[0])
        (x1, y1) = self.carried(mesh.first, center, q)
        (x2, y2) = self.carried(mesh.second, center + (one + two) * toward, q)
        dx, dy = x2 - x1, y2 - y1
        along, over = dx * toward.real + dy * toward.imag, dy * toward.real - dx * toward.imag
        psi = over / along - (over / along) ** 3 / 3.0  # the angle is next to 0: atan without a branch
        share = 1.0 / np.hypot(1.0, mesh.tangent)
        cosine = share * (one + two) / np.sqrt(dx * dx + dy * dy)
        sine = np.sqrt(1.0 - cosine * cosine)
        involute = sine / cosine - np.arctan2(mesh.tangent, 1.0)
        involute = involute - _angle_beyond(sine, cosine, mesh.tangent)
        flank = -ring * np.sign(self.found.unknowns[mesh.name][0][0])
        rolling = one * (self.angle(mesh.first, q) - psi) + two * (self.angle(mesh.second, q) - psi)
        return share * (rolling + flank * (one + two) * involute)

    def _rack(self, rack: Rack, q: Any) -> Any:
        """Distance along the flank's normal: that of the pinion's centre from the flank, and what it unrolls."""
        share = 1.0 / np.hypot(1.0, rack.tangent)
        flank = np.sign(self.found.unknowns[rack.name][0][0])
        normal = share * (rack.along + flank * rack.tangent * rack.normal)
        (x1, y1) = self.carried(rack.first, complex(rack.pitch_point[0]), q)
        (x2, y2) = self.carried(rack.second, complex(rack.center[0]), q)
        turning = -rack.mate_radius * share * float(cross(rack.normal, rack.along))
        return (x2 - x1) * normal.real + (y2 - y1) * normal.imag + turning * self.angle(rack.second, q)

    def _roller(self, contact: Contact, q: Any) -> Any:
        """R - rho(t - beta): the roller's centre on the pitch curve that turns with its cam; rho by its series."""
        main = self.found.unknowns[contact.name][0][0] > 0.0
        at = complex((contact.at if main else contact.back[0])[0])  # type: ignore[index]
        axis = complex(self.mechanism.links[contact.first].origin.value[0])
        (x1, y1), (x2, y2) = self.carried(contact.first, axis, q), self.carried(contact.second, at, q)
        turn = self.angle(contact.first, q)
        c, s = np.cos(turn), np.sin(turn)
        x, y = c * (x2 - x1) + s * (y2 - y1), c * (y2 - y1) - s * (x2 - x1)
        cam = self.design._cam_turn(self.phi).value
        lift, sense = self.design.design.cams.follower.lift(cam), 1.0 if main else -1.0
        rho, slope, bend = abs(at - axis), sense * float(lift.first[0]), sense * float(lift.second[0])
        beta = -x / y - (-x / y) ** 3 / 3.0
        radius = rho - slope * beta + 0.5 * bend * beta * beta
        return sense * (np.sqrt(x * x + y * y) - radius) * rho / np.hypot(rho, slope)

    def slope(self, q: Any, way: Any) -> Any:
        """Derivative of the constraints along a direction, by a complex step."""
        return np.imag(np.array(self.constraints(q + 1j * TINY * way), dtype=complex)) / TINY

    def solve(self) -> tuple[Any, Any]:
        """Accelerations per w^2, and multipliers: the forces on the second links."""
        machine, n = self.machine, len(self.q)
        jacobian = np.array([self.slope(self.q, way) for way in np.eye(n)]).T
        weights = {1: 45.0, 2: -9.0, 3: 1.0}
        gamma = -sum(
            w / 60.0 * sign * self.slope(self.q + sign * k * STEP * self.rate, self.rate) / STEP
            for k, w in weights.items()
            for sign in (1, -1)
        )
        load = np.tile([machine.gravity.real, machine.gravity.imag, 0.0], n // 3) * self.mass
        for each in machine.applied(self.phi):
            k = 3 * self.names.index(each.on)
            if isinstance(each, Force):
                force = complex(each.force[0])
                load[k : k + 2] += force.real, force.imag
                load[k + 2] += float(cross(each.at.value[0] - complex(self.q[k], self.q[k + 1]), force))
            else:
                load[k + 2] += each.torque[0]
        square = machine.speed**2
        size = len(gamma)
        matrix = np.block([[np.diag(self.mass), -jacobian.T], [jacobian, np.zeros((size, size))]])
        rubbed, whole = np.zeros(n), np.zeros(n + size)
        for _ in range(PASSES if machine.friction else 1):
            whole = np.linalg.solve(matrix, np.concatenate([load + rubbed, gamma * square]))
            rubbed = self.rubbed(whole[n:])
        return whole[:n] / square, whole[n:]

    # Friction, from the multipliers and the rates of the coordinates

    def rubbed(self, multipliers: Any) -> Any:
        """What friction puts on the coordinates: of pins mu r |F|, of teeth what makes P_out = eta P_in."""
        load, values = np.zeros(len(self.q)), iter(multipliers)
        friction = self.machine.friction
        for each in self.mechanism.connections if friction else ():
            own = [next(values) for _ in each.columns()]
            if isinstance(each, Pin):
                turning = self._turn(each.second) - self._turn(each.first)
                size = friction.pins * friction.pin_radius * np.hypot(*own)
                self._put(load, each.second, each.first, couple=-size * np.sign(turning * self.machine.speed))
            elif isinstance(each, (Mesh, Rack)):
                force = own[0] / np.hypot(1.0, each.tangent) * (-1.0 if isinstance(each, Mesh) else 1.0)
                self._put_on_driven(load, each, force * complex(np.ravel(each.columns()[0].force)[0]), friction.meshes)
        return load

    def _put_on_driven(self, load: Any, teeth: Any, force: complex, efficiency: float) -> None:
        """Take from the gear that the teeth drive, as seen from where the axes rest, what the mesh loses."""
        at = complex(teeth.pitch_point[0])
        rolling = self._velocity(teeth.second, at)
        if isinstance(teeth, Rack):  # seen along with the pinion's centre, in the directions of the rack
            center, held = complex(teeth.center[0]), teeth.first
            rolling -= self._velocity(teeth.second, center) + 1j * self._turn(held) * (at - center)
        else:
            held = teeth.carrier
            rolling -= self._velocity(held, at)
        power = (force.conjugate() * rolling).real * self.machine.speed
        driven = teeth.second if power > 0.0 else teeth.first
        lost = (1.0 - efficiency) * abs(power) / self.machine.speed
        if isinstance(teeth, Rack) and driven == teeth.first:
            less = -lost * rolling / abs(rolling) ** 2
            moment = float(cross(at - center, less))
            self._put(load, driven, FRAME, force=less, couple=-moment, at=at)
            self._put(load, teeth.second, FRAME, force=-less, at=center)
        else:
            self._put(load, driven, held, couple=-lost / (self._turn(driven) - self._turn(held)))

    def _turn(self, name: str) -> float:
        return 0.0 if name == FRAME else float(self.rate[3 * self.names.index(name) + 2])

    def _velocity(self, name: str, at: complex) -> complex:
        if name == FRAME:
            return 0j
        k = 3 * self.names.index(name)
        return complex(self.rate[k], self.rate[k + 1]) + 1j * self.rate[k + 2] * (
            at - complex(self.q[k], self.q[k + 1])
        )

    def _put(self, load: Any, on: str, off: str, couple: float = 0.0, force: complex = 0j, at: complex = 0j) -> None:
        """Add a couple and a force at a place to a link, and the opposite to another."""
        for name, sign in ((on, 1.0), (off, -1.0)):
            if name != FRAME:
                k = 3 * self.names.index(name)
                arm = at - complex(self.q[k], self.q[k + 1])
                load[k : k + 3] += sign * np.array([force.real, force.imag, couple + float(cross(arm, force))])


def _angle_beyond(sine: Any, cosine: Any, tangent: float) -> Any:
    """The pressure angle less the one whose tangent is given, next to 0."""
    c = 1.0 / np.hypot(1.0, tangent)
    s = tangent * c
    beyond = sine * c - cosine * s
    return beyond + beyond**3 / 6.0


@pytest.mark.quick(10)
@pytest.mark.parametrize("case", CASES, ids=lambda case: str(case["name"]))
@pytest.mark.parametrize("phi", [0.4, 2.9, 5.1])
def test_forces_against_the_augmented_system(case: dict[str, Any], phi: float) -> None:
    spec = {key: value for key, value in case["spec"].items() if key != "at"}
    if spec["kind"] == "geared-five-bar":
        spec["coupler_point"] = {"along": 60.0}
    _compare(Augmented(factory.design(spec, command="loads"), phi))


@pytest.mark.quick(1)
@pytest.mark.parametrize("degrees", [20.0, 80.0, 250.0, 310.0])
def test_press_against_the_augmented_system(degrees: float) -> None:
    """Twelve links with racks and a roller, main and return cam in turn: 36 equations, 36 constraints."""
    _compare(Augmented(factory.design("loaded_press", command="loads"), np.radians(degrees)))


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", SIX_BARS)
def test_six_bars_against_the_augmented_system(name: str) -> None:
    """Rings, free gears and carriers of every kind, at one input angle each."""
    _compare(Augmented(factory.design(SIX_BARS[name], command="loads"), 0.9))


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", [*(str(case["name"]) for case in CASES if "gears" in case["spec"]), *SIX_BARS])
@pytest.mark.parametrize("speed", [70.0, -70.0])
def test_friction_against_the_augmented_system(name: str, speed: float) -> None:
    """Teeth lose on the gear that they drive, whichever it is and however the carrier moves; pins beside them."""
    specs: dict[str, Any] = SIX_BARS | {case["name"]: case["spec"] for case in CASES}
    spec = {key: value for key, value in specs[name].items() if key != "at"}
    if spec["kind"] == "geared-five-bar":
        spec["coupler_point"] = {"along": 60.0}
    keys: dict[str, Any] = {"loads__friction": RUBBING, "loads__speed": speed}
    _compare(Augmented(factory.design(spec, command="loads", **keys), 1.3))


@pytest.mark.quick(1)
@pytest.mark.parametrize("degrees", [20.0, 80.0, 160.0, 250.0, 310.0])
def test_friction_of_racks_against_the_augmented_system(degrees: float) -> None:
    """The pinion drives the bed and is driven by it, the lower rack likewise."""
    friction = RUBBING | {"pins": 0.0}
    _compare(Augmented(factory.design("loaded_press", command="loads", loads__friction=friction), np.radians(degrees)))


@pytest.mark.quick(1)
@pytest.mark.parametrize("side", ["opposite", "same"])
@pytest.mark.parametrize("speed", [70.0, -70.0])
@pytest.mark.parametrize("phi", [0.6, 2.4, 4.1])
def test_friction_of_racks_on_a_crank(side: str, speed: float, phi: float) -> None:
    """The axis of the pinion travels, between a rack that is fixed and one that moves."""
    spec = {"kind": "slider-crank", "stroke": 210.0, "rod": 420.0, "offset": 30.0}
    racks = {"module": 5.0, "fixed": 42, "moving": 30, "side": side}
    masses = {"rack": {"mass": 180.0}, "pinion": {"mass": 12.0, "inertia": 0.07}}
    loads = {"speed": speed, "friction": RUBBING, "links": masses, "forces": [{"on": "rack", "force": 350.0}]}
    design = factory.design(spec, command="loads", racks=racks, loads=loads)
    _compare(Augmented(design, phi))
    assert design.power_identity < 1e-9


def _compare(augmented: Augmented) -> None:
    bend, multipliers = augmented.solve()
    meters = np.tile([1e-3, 1e-3, 1.0], len(bend) // 3)
    wanted = meters * augmented.bend
    assert meters * bend == pytest.approx(wanted, abs=1e-8 * np.abs(wanted).max())
    expected: list[float] = []
    for each in augmented.mechanism.connections:
        values = augmented.found.unknowns[each.name][:, 0].tolist()
        normal = np.hypot(1.0, each.tangent) if isinstance(each, (Mesh, Rack)) else 1.0
        expected += [-value * normal if isinstance(each, Mesh) else value * normal for value in values]
    expected.append(float(augmented.found.torque[0]))
    assert multipliers == pytest.approx(expected, abs=1e-8 * np.abs(expected).max())
