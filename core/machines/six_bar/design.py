"""The geared six-bar as a design: positions, speeds and accelerations of its links, its gears, its checks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import chain, pairwise
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import OUTPUT_SPEEDS, RealSpeed
from gearlink.core.base.remedies.ways import Way, down, either, modules, shared, up
from gearlink.core.base.report import Check, Table, without_noise
from gearlink.core.base.results import cached_property
from gearlink.core.machines.six_bar.spec import LINKS
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.parts.gears.checks import gear_ways
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.train.single_mesh import MESH_CHECKS, mesh_checks, mesh_quantity
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.output_rates import OutputRates
from gearlink.core.studies.clearance.bodies import Layout
from gearlink.core.studies.clearance.checks import SHAFT_WAYS, collision_check, seat_checks, shaft_checks

if TYPE_CHECKING:
    from gearlink.core.machines.six_bar.course import Course
    from gearlink.core.machines.six_bar.loop import SixBar
    from gearlink.core.machines.six_bar.spec import GearedSixBarSpec, SixTrain
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.parts.linkages.standstills import Turning

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


class GearedSixBar(OutputRates, RealSpeed, Design):
    """A loop of six links that two gear trains drive by one input."""

    kind = "geared-six-bar"
    spec: GearedSixBarSpec
    outlines = {
        "analyze": Outline(
            (
                "input_length",
                "coupler_length",
                "output_length",
                "frame_length",
                "start_directions",
                "period_turns",
                "mean_ratio",
                "output_swing",
                *names("speed_ratio"),
                "dwell_crank_angles",
                *names("acceleration_ratio"),
                "min_transmission_angle",
                "min_transmission_angle_at",
                "center_distance",
                "gear_gap",
                "contact_ratio",
                "input_speed",
                "turn_time",
                *OUTPUT_SPEEDS,
            ),
            ("gear-collision", "shaft-clearance", "shaft-seat", "transmission-angle", *MESH_CHECKS),
            ("motion",),
        ),
        "gear": Outline(("center_distance", "contact_ratio"), MESH_CHECKS),
    }
    extra_tables = ("links", "joints")
    ways = {
        "transmission-angle": (*_FREE_LINKS, *_CARRIERS, *_STARTS),
        "gear-collision": (up("links.frame"), *_FREE_LINKS, *_CARRIERS),
        "shaft-clearance": (*SHAFT_WAYS, down("shafts.F_radius"), *_FREE_LINKS, *_CARRIERS),
        **_gear_ways(),
    }

    @property
    def cost(self) -> float:
        """A motion of many turns, or near its dead centres, is followed over many places, and then searched."""
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
                self._require_equal(link, known, distance, f"trains[{i}].gears", "the train before asks for")
        return tuple(self._length(name, carried.get(name)) for name in LINKS)

    def _length(self, name: str, carried: tuple[float, str] | None) -> float:
        given: float | None = getattr(self.spec.links, name)
        if carried is None and given is None:
            raise NoSolution(f"no train fixes the length of {name}: give links.{name}", key="links")
        if carried is not None and given is not None:
            self._require_equal(name, carried[0], given, f"links.{name}", "its gears' centre distance is")
        return given if carried is None and given is not None else carried[0]  # type: ignore[index]

    @staticmethod
    def _require_equal(name: str, one: float, other: float, key: str, why: str) -> None:
        if abs(one - other) > _LINK_TOLERANCE * one:
            message = f"{name} would be {other:.9g} mm, {why} {one:.9g} mm: leave one out, or change module or teeth"
            raise NoSolution(message, key=key)

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
        from gearlink.core.machines.six_bar.loop import SixBar
        from gearlink.core.machines.six_bar.relations import train_relation

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
        from gearlink.core.machines.six_bar.course import Course

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
        import numpy as np

        if self.period_turns is None:
            return None
        ends = self.course.angles(np.array([0.0, self.course.end]))[3]
        return _TURN * round(float(ends[1] - ends[0]) / _TURN)

    @property
    def mean_ratio(self) -> float | None:
        """Net output turns per input turn; over a range there are none."""
        return None if self._gain is None else self._gain / self.course.end

    def output(self, phi: Reals) -> Reals:
        """Direction F->E [rad], continuous, and in (-pi, pi] at input angle 0."""
        import numpy as np

        found: Reals = self.course.angles(phi)[3] + (self.start_directions[3] - self.bar.start_angles[3])
        return np.asarray(found)

    def rate(self, order: int) -> Any:
        """A derivative of the output's angle, as a function of arrays."""
        return lambda phi: self.course.rates(phi)[order][3]

    @cached_property
    def speed_turnings(self) -> list[Turning]:
        """Extremes of the output's speed."""
        return self._turnings(1)

    @cached_property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of the output's acceleration."""
        return self._turnings(2)

    def _turnings(self, order: int) -> list[Turning]:
        from gearlink.core.machines.six_bar.turnings import turnings

        ends = self.period_turns is None
        return turnings(self.rate(order), self.rate(order + 1), self.course.grid, ends)

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """Input angles at which the output stands [rad], ascending."""
        from gearlink.core.machines.six_bar.turnings import standstills

        fastest = max(abs(t.value) for t in self.speed_turnings)
        period = None if self.period_turns is None else self.course.end
        return standstills(self.rate(1), self.speed_turnings, _STANDSTILL * fastest, period)

    @cached_property
    def output_swing(self) -> float | None:
        """Swing of an output that does not turn round, or over a range [rad]."""
        import numpy as np

        if self._gain:
            return None
        places = [*self.dwell_crank_angles, self.course.start, self.course.end]
        angles = self.output(np.array(places))
        return float(angles.max() - angles.min())

    @cached_property
    def _transmission(self) -> Extreme:
        from gearlink.core.numerics.extremes import minimum_over

        course = self.course
        return minimum_over(
            lambda phi: self.bar.transmission(course.angles(phi)), course.start, course.end, samples=course.samples
        )

    min_transmission_angle: float = placed("_transmission.value")
    min_transmission_angle_at: float = placed("_transmission.place")

    @cached_property
    def layouts(self) -> tuple[Layout, ...]:
        """The bodies of each plane of gears."""
        from gearlink.core.machines.six_bar.bodies import layouts

        return layouts(self)

    @property
    def gear_gap(self) -> float | None:
        """Least gap of gears of one plane that do not mesh [mm]; None where there are none."""
        return min((gap for layout in self.layouts if (gap := layout.gear_gap) is not None), default=None)

    # Tables

    def _rows(self, samples: int | None) -> Reals:
        """Input angles of a table [deg]."""
        import numpy as np

        from gearlink.core.base.rows import row_numbers
        from gearlink.core.numerics.arrays import turn_degrees

        if self.period_turns is not None:
            return turn_degrees(samples, self.period_turns)
        asked, count = self.spec.range, samples or 180
        assert asked is not None, "without a period there is a range"
        rows = row_numbers(samples, count + 1)
        share = np.arange(rows.start, rows.stop) / count
        return np.asarray(asked.start + (asked.end - asked.start) * share)

    def table_motion(self, samples: int | None = None) -> Table:
        """Directions of all links, speed and acceleration of the output, transmission angle."""
        from gearlink.core.machines.six_bar.mechanism import output, transmission
        from gearlink.core.mechanism.courses import Shown, motion_table, turned

        course = output(self)
        shown = [
            Shown("output_angle", course),
            Shown("speed_ratio", course, 1, "output_speed"),
            Shown("acceleration_ratio", course, 2, "output_acceleration"),
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
        """Places of the moving pins."""
        import numpy as np

        from gearlink.core.mechanism.courses import Shown, columns_of, coordinate

        degrees = self._rows(samples)
        pins = zip("BCDE", LINKS[1:5], strict=True)
        shown = [Shown(f"{x}_{pin}", coordinate(link, pin, along)) for pin, link in pins for x, along in _AXES]
        return Table.of(
            "joints", {"input_angle": (degrees, "deg"), **columns_of(self.moving, np.radians(degrees), shown)}
        )

    # Checks

    def check(self, name: str) -> list[Check]:
        """The checks of each mesh, and the design's own."""
        if name not in MESH_CHECKS:
            return super().check(name)
        found = ((pins_, mesh) for pins_, mesh in self.meshes.items())
        return [check for pins_, mesh in found for check in mesh_checks(name, mesh, self.spec.limits, pins_)]

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: gears of one plane that do not mesh."""
        remedy = "take smaller gears, or lengthen the links between them"
        for pair in chain.from_iterable(layout.gear_pairs for layout in self.layouts):
            apart = without_noise(pair.distance, pair.one.outer + pair.other.outer)
            why = f"their pins are {apart:.6g} mm apart"
            yield collision_check(pair, self.spec.limits.gear_gap, why, remedy)

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
        return transmission_check(self.min_transmission_angle, limit, remedy, "the least transmission angle")


def _mesh(train: SixTrain, k: int) -> GearPair:
    one, other = train.gears[k : k + 2]
    alpha = math.radians(train.pressure_angle)
    with at_key("trains"):
        return GearPair.from_shift(train.module, (other, one) if one < 0 else (one, other), pressure_angle=alpha)
