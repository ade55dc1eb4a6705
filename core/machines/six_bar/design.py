"""The geared six-bar as a design: its loop with gears and checks, extremes and standstills of its output."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import OUTPUT_SPEEDS, OutputSpeed, RealSpeed
from gearlink.core.base.remedies.ways import Way, either, modules, shared, thinner, up
from gearlink.core.base.report import Check, Table, without_noise
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.six_bar.loop import Course, SixBar, joined_by, train_relation
from gearlink.core.machines.six_bar.spec import LINKS, GearedSixBarSpec, SixTrain
from gearlink.core.numerics.arrays import Reals, range_rows, turn_degrees
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.numerics.roots import sign_changes
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.checks import gear_ways
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, mesh_checks, mesh_quantity
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.standstills import OutputRates, Turning, standstills
from gearlink.core.studies.clearance import (
    FULL_HEIGHT,
    SHAFT_WAYS,
    Gear,
    Layout,
    Reach,
    collision_check,
    constant,
    least_shaft,
    reaches,
    ring_gear,
    seat_checks,
    shaft_checks,
    shafts_at,
)

if TYPE_CHECKING:
    from gearlink.core.numerics.extremes import Extreme


_TURN = 2.0 * math.pi
_LINK_TOLERANCE = 1e-9
_STANDSTILL = 1e-9
_AXES = (("x", 1.0), ("y", 1j))
_MOST_MESHES = 4
_FREE_LINKS = either(*(f"links.{name}" for name in ("coupler_2", "coupler_1", "coupler_3", "frame", "output", "input")))
_CARRIERS = modules("trains[0].module", "trains[1].module")
"""Another module changes the link under a mesh."""
_STARTS = either(*(f"start.{name}" for name in ("coupler_1", "coupler_2", "coupler_3", "output")), step=1.0)


def _gear_ways() -> dict[str, tuple[Way, ...]]:
    """Teeth that one gear gives its neighbour, which leaves the link under them as long as it is; pressure angles."""
    found: dict[str, tuple[Way, ...]] = {}
    for train in ("trains[0]", "trains[1]"):
        pairs = ((f"{train}.gears[{k}]", f"{train}.gears[{k + 1}]") for k in range(_MOST_MESHES))
        swaps = [way for pair in pairs for way in shared(*pair, step=1)]
        for check, ways in gear_ways(*swaps, angle=f"{train}.pressure_angle").items():
            found[check] = (*found.get(check, ()), *dict.fromkeys(ways))
    return found


class GearedSixBar(OutputRates, OutputSpeed, RealSpeed, Design):
    """A loop of six links that two gear trains drive by one input."""

    kind = "geared-six-bar"
    spec: GearedSixBarSpec
    keys = {
        "analyze": (
            *("output_swing", "mean_ratio", "dwell_crank_angles"),
            *(("min_transmission_angle", ">limits.transmission_angle"), "output_speed_max", "output_acceleration_max"),
            *("speed_ratio_max", "speed_ratio_min", "acceleration_ratio_max", ("gear_gap", ">limits.gear_gap")),
            "center_distance",
        )
    }
    outlines = {
        "analyze": Outline(
            (
                *("input_length", "coupler_length", "output_length", "frame_length", "start_directions"),
                *("period_turns", "mean_ratio", "output_swing", *names("speed_ratio"), "dwell_crank_angles"),
                *(*names("acceleration_ratio"), "min_transmission_angle", "min_transmission_angle_at"),
                *("center_distance", "gear_gap", "contact_ratio", "input_speed", "turn_time", *OUTPUT_SPEEDS),
            ),
            ("gear-collision", "shaft-clearance", "shaft-seat", "transmission-angle", *MESH_CHECKS),
            ("motion",),
        ),
        "gear": Outline(("center_distance", "contact_ratio"), MESH_CHECKS),
    }
    extra_tables = ("links", "joints")
    at_once = 64
    ways = {
        "transmission-angle": (*_FREE_LINKS, *_CARRIERS, *_STARTS),
        "gear-collision": (up("links.frame"), *_FREE_LINKS, *_CARRIERS),
        "shaft-clearance": (*SHAFT_WAYS, *thinner("shafts.F_radius"), *_FREE_LINKS, *_CARRIERS),
        **_gear_ways(),
    }

    @classmethod
    def find_together(cls, designs: Sequence[GearedSixBar], names: Sequence[str]) -> None:
        """Turnings and standstills, transmission angles and distances of pins."""
        from gearlink.core.machines.six_bar.together import find_together

        find_together(designs, frozenset(names))

    @property
    def cost(self) -> float:
        """A motion of many revolutions, or near its dead centres, is followed over many places, and then searched."""
        if "course" not in self.__dict__:
            return 0.5
        searched = ("layouts" in self.__dict__) + 2 * ("acceleration_turnings" in self.__dict__)
        return 0.5 * (1 + (1 + searched) * self.course.followed // 25)

    # Gears and links

    @cached_property
    def train_meshes(self) -> list[list[GearPair]]:
        """The meshes of each train, from pin to pin."""
        return [[_mesh(train, k) for k in range(len(train.gears) - 1)] for train in self.spec.trains]

    @property
    def meshes(self) -> dict[str, GearPair]:
        """The meshes by their pins, and by their train where both have one there."""
        found: dict[str, GearPair] = {}
        for number, (train, meshes) in enumerate(zip(self.spec.trains, self.train_meshes, strict=True), start=1):
            for (one, other), mesh in zip(pairwise(train.pins), meshes, strict=True):
                pins = f"{one}{other}"
                found[f"{pins} of train {number}" if pins in found else pins] = mesh
        return found

    @property
    def center_distance(self) -> list[float]:
        """Centre distance of each mesh [mm]."""
        return [abs(mesh.center_distance) for mesh in self.meshes.values()]

    @property
    def contact_ratio(self) -> list[float] | None:
        """Contact ratio of each mesh; None where a ring's tips have no involute."""
        found = [mesh_quantity(mesh, "contact_ratio") for mesh in self.meshes.values()]
        return None if None in found else found

    @cached_property
    def lengths(self) -> tuple[float, ...]:
        """The links from the frame on [mm]; a link under a mesh is its centre distance."""
        carried: dict[str, tuple[float, str]] = {}
        for i, (train, meshes) in enumerate(zip(self.spec.trains, self.train_meshes, strict=True)):
            for k, mesh in enumerate(meshes):
                link, distance = LINKS[(train.first_pin + k + 1) % 6], abs(mesh.center_distance)
                known = carried.setdefault(link, (distance, f"trains[{i}]"))[0]
                self._require_equal(link, known, distance, f"trains[{i}].gears", "the train before requires")
        return tuple(self._length(name, carried.get(name)) for name in LINKS)

    def _length(self, name: str, carried: tuple[float, str] | None) -> float:
        given: float | None = getattr(self.spec.links, name)
        if carried is None and given is None:
            raise NoSolution(f"no train fixes the length of {name}", key="links", fix=f"give links.{name}")
        if carried is not None and given is not None:
            self._require_equal(name, carried[0], given, f"links.{name}", "its gears' centre distance is")
        return given if carried is None and given is not None else carried[0]  # type: ignore[index]

    @staticmethod
    def _require_equal(name: str, one: float, other: float, key: str, why: str) -> None:
        if abs(one - other) > _LINK_TOLERANCE * one:
            message = f"{name} would be {other:.9g} mm, {why} {one:.9g} mm"
            raise NoSolution(message, key=key, fix="omit one, or change module or teeth")

    input_length: float = placed("lengths.1")

    @property
    def coupler_length(self) -> list[float]:
        """BC, CD, DE [mm]."""
        return list(self.lengths[2:5])

    output_length: float = placed("lengths.5")
    frame_length: float = placed("lengths.0")

    # Motion

    @cached_property
    def bar(self) -> SixBar:
        """The loop at its start."""
        one, other = (train_relation(train.first_pin, train.gears) for train in self.spec.trains)
        # The file counts the output from its pivot, the loop on the way from A to F.
        start = {
            LINKS.index(name): math.radians(angle + (180.0 if name == "output" else 0.0))
            for name, angle in self.spec.start.given.items()
        }
        with at_key("start"):
            return SixBar(self.lengths, (one, other), start, self.spec.assembly)

    @cached_property
    def course(self) -> Course:
        """The motion from the start on."""
        asked = self.spec.range
        ends = None if asked is None else (math.radians(asked.start), math.radians(asked.end))
        return Course(self.bar, ends)

    @property
    def start_directions(self) -> list[float]:
        """Directions of BC, CD, DE and FE at input angle 0 [rad]."""
        *couplers, output = self.bar.start_angles
        return [math.remainder(angle, _TURN) for angle in (*couplers, output + math.pi)]

    period_turns: int | None = placed("course.period_turns")

    @cached_property
    def _gain(self) -> float | None:
        """Turn of the output over the period [rad]."""
        return None if self.period_turns is None else _TURN * round(float(self.course.gain[3, 0]) / _TURN)

    @property
    def mean_ratio(self) -> float | None:
        """Net output turns per input turn; over a range there are none."""
        return None if self._gain is None else self._gain / self.course.end

    def output(self, phi: Reals) -> Reals:
        """Direction F->E [rad], continuous, and in (-pi, pi] at input angle 0."""
        found: Reals = self.course.angles(phi)[3] + (self.start_directions[3] - self.bar.start_angles[3])
        return np.asarray(found)

    def rate(self, order: int) -> Any:
        """A derivative of the output's angle, as a function of arrays."""
        return lambda phi: self.course.rates(phi)[order][3]

    @cached_property
    def speed_turnings(self) -> list[Turning]:
        return self._turnings(1)

    @cached_property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of the output's acceleration."""
        return self._turnings(2)

    def _turnings(self, order: int) -> list[Turning]:
        ends = self.period_turns is None
        return turnings(self.rate(order), self.rate(order + 1), self.course.grid, ends)

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """Input angles at which the output stands [rad], ascending."""
        return standstills(self.rate(1), *self.standing, _between)

    @property
    def standing(self) -> tuple[list[Turning], float, float | None]:
        """Of what standstills are found: extremes of the speed, what counts as none, and the period."""
        fastest = max(abs(t.value) for t in self.speed_turnings)
        return self.speed_turnings, _STANDSTILL * fastest, None if self.period_turns is None else self.course.end

    @cached_property
    def output_swing(self) -> float | None:
        """Swing of an output that does not turn round, or over a range [rad]."""
        if self._gain:
            return None
        places = [*self.dwell_crank_angles, self.course.start, self.course.end]
        angles = self.output(np.array(places))
        return float(angles.max() - angles.min())

    @cached_property
    def _transmission(self) -> Extreme:
        from gearlink.core.numerics.extremes import minimum_over

        course, of = self.course, self.bar.transmission
        return minimum_over(lambda phi: of(course.angles(phi)), course.start, course.end, samples=course.samples)

    min_transmission_angle: float = placed("_transmission.value")
    min_transmission_angle_at: float = placed("_transmission.place")

    @cached_property
    def reaches(self) -> dict[str, Reach]:
        """Minimum and maximum distances of the pins with gears, and of A and F, over the course."""
        return {
            pair: constant(self.bar.lengths[link]) for pair, link in joined_by(self.spec.trains) if link >= 0
        } | self.moving_reaches

    @cached_property
    def moving_reaches(self) -> dict[str, Reach]:
        """The same of pins that no link joins."""
        pairs = [pair for pair, link in joined_by(self.spec.trains) if link < 0]
        if not pairs:
            return {}
        held = dict(zip("ABCDEF", (*LINKS[1:5], "output", "output"), strict=True))
        axes = {pin: (held[pin], pin) for pin in sorted({*"".join(pairs)})}
        return reaches(self.moving, axes, pairs, samples=self.course.samples)

    @cached_property
    def layouts(self) -> tuple[Layout, ...]:
        """The bodies of each plane of gears."""
        spec = self.spec
        one, other = (set(train.pins) for train in spec.trains)
        shafts, least = shafts_at("AF", spec.shafts), least_shaft(spec.limits, max(each.module for each in spec.trains))
        gears = [tuple(_gears(self, number)) for number in (0, 1)]
        planes = gears if one & other else [gears[0] + gears[1]]
        return tuple(Layout(each, shafts, self.reaches, least) for each in planes)

    @property
    def gear_gap(self) -> float | None:
        """Minimum gap of gears of one plane that do not mesh [mm]; None where there are none."""
        return min((gap for layout in self.layouts if (gap := layout.gear_gap) is not None), default=None)

    # Tables

    def _rows(self, samples: int | None) -> Reals:
        """Input angles of a table [deg]."""
        if self.period_turns is not None:
            return turn_degrees(samples, self.period_turns)
        assert self.spec.range is not None, "without a period there is a range"
        return range_rows(self.spec.range.start, self.spec.range.end, samples)

    def table_motion(self, samples: int | None = None) -> Table:
        """Directions of all links, speed and acceleration of the output, transmission angle."""
        from gearlink.core.machines.six_bar.mechanism import output, transmission
        from gearlink.core.mechanism.courses import Shown, motion_table, of_output, turned

        course = output(self)
        shown = [
            *of_output(course),
            *(Shown(f"{name}_angle", turned(name)) for name in LINKS[2:5]),
            Shown("transmission_angle", transmission(self)),
        ]
        return motion_table("motion", self, shown, samples, degrees=self._rows(samples))

    def table_links(self, samples: int | None = None) -> Table:
        """Angle, speed, acceleration and jerk of the couplers and the output."""
        from gearlink.core.machines.six_bar.mechanism import output
        from gearlink.core.mechanism.courses import all_rates, motion_table, turned

        shown = all_rates({name: turned(name) for name in LINKS[2:5]} | {"output": output(self)})
        return motion_table("links", self, shown, samples, degrees=self._rows(samples))

    def table_joints(self, samples: int | None = None) -> Table:
        """Positions of the moving pins."""
        from gearlink.core.mechanism.courses import Shown, columns_of, coordinate

        degrees = self._rows(samples)
        pins = zip("BCDE", LINKS[1:5], strict=True)
        shown = [Shown(f"{x}_{pin}", coordinate(link, pin, along)) for pin, link in pins for x, along in _AXES]
        columns = columns_of(self.moving, np.radians(degrees), shown)
        return Table.of("joints", {"input_angle": (degrees, "deg"), **columns})

    # Checks

    def check(self, name: str) -> list[Check]:
        """The checks of each mesh, and the design's own."""
        if name not in MESH_CHECKS:
            return super().check(name)
        limits = self.spec.limits
        return [each for pins, mesh in self.meshes.items() for each in mesh_checks(name, mesh, limits, pins)]

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: gears of one plane that do not mesh."""
        remedy = "lengthen the links between them"
        for pair in chain.from_iterable(layout.gear_pairs for layout in self.layouts):
            apart = short(without_noise(pair.distance, pair.one.outer + pair.other.outer))
            yield collision_check(pair, self.spec.limits.gear_gap, f"pins {apart} mm apart", remedy)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302."""
        return chain.from_iterable(shaft_checks(layout) for layout in self.layouts)

    def check_shaft_seat(self) -> Iterator[Check]:
        """GL302."""
        return chain.from_iterable(seat_checks(layout) for layout in self.layouts)

    def check_transmission_angle(self) -> Check:
        """GL303: the angle at which the two free directions close the loop."""
        remedy = "bring the two links that close the loop nearer to a right angle (longer couplers, shorter input)"
        limit = self.spec.limits.transmission_angle
        return transmission_check(self.min_transmission_angle, limit, remedy)


def _mesh(train: SixTrain, k: int) -> GearPair:
    one, other = train.gears[k : k + 2]
    alpha = math.radians(train.pressure_angle)
    with at_key("trains"):
        return GearPair.from_shift(train.module, (other, one) if one < 0 else (one, other), pressure_angle=alpha)


def _gears(design: GearedSixBar, number: int) -> list[Gear]:
    """The gears of a train, called by their pins.

    Notes
        The end gears are fixed to links: a first gear on B to the input link AB, a last gear on E to the output link
        EF. Each is one body with the shaft of that link.
    """
    train, meshes = design.spec.trains[number], design.train_meshes[number]
    found = []
    for k, (pin, teeth) in enumerate(zip(train.pins, train.gears, strict=True)):
        mesh = meshes[min(k, len(meshes) - 1)]
        mates = "".join(train.pins[j] for j in (k - 1, k + 1) if 0 <= j < len(train.pins))
        shaft = "A" if pin == "B" and k == 0 else "F" if pin == "E" and k == len(train.pins) - 1 else ""
        if teeth < 0:
            ring = ring_gear(pin, mesh, mates, train.rim)
            found.append(ring._replace(name=f"the ring gear on {pin}", turns_with=shaft))
            continue
        tip = 0.5 * train.module * teeth + train.module
        root = tip - FULL_HEIGHT * train.module
        found.append(Gear(f"the gear on {pin}", pin, tip, mates=mates, turns_with=shaft, root=root))
    return found


Function = Callable[[Reals], Reals]


def zeros(f: Function, grid: Reals) -> list[float]:
    """Zeros of a function of arrays at which its sign changes on a grid; two within one step are missed.

    Raises
        NoSolution - where the function is no number, as in a dead centre
    Example
        >>> [round(x, 12) for x in zeros(np.cos, np.linspace(0.0, 6.0, 100))]
        [1.570796326795, 4.712388980385]
    """
    values = f(grid)
    places = np.array(sign_changes(values.tolist()), dtype=int)
    if not places.size:
        return []
    return _between(f, grid[places], grid[places + 1], (values[places], values[places + 1]))


def _between(f: Function, lows: ArrayLike, highs: ArrayLike, ends: Any) -> list[float]:
    low, high, first, last = (np.asarray(each, dtype=float) for each in (lows, highs, *ends))
    found = bracketed_roots(f, low, high, ends=(first, last))
    if np.isnan(found).any():
        at = float(np.degrees(low[np.isnan(found)][0]))
        raise NoSolution(
            f"the six-bar has no rates next to the input angle {short(at)} deg: it is in a dead centre there"
        )
    return [float(x) for x in found]


def turnings(f: Function, slope: Function, grid: Reals, ends: bool) -> list[Turning]:
    """Extremes of a function by the zeros of its derivative, and its values at both ends where they count.

    Example
        >>> [round(t.value, 12) for t in turnings(np.sin, np.cos, np.linspace(0.0, 6.0, 100), False)]
        [1.0, -1.0]
    """
    places = zeros(slope, grid)
    places = sorted({*places, float(grid[0]), float(grid[-1])}) if ends or not places else places
    return [Turning(place, value) for place, value in zip(places, f(np.array(places)).tolist(), strict=True)]
