"""A planar mechanism as a design: what its outputs do over the input, its tables and its checks."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.polynomial import legendre

from gearlink.core.base.design import Design, NamesOfFile, Outline, placed
from gearlink.core.base.errors import GearlinkError, MissingSection
from gearlink.core.base.nomenclature import term
from gearlink.core.base.remedies.ways import Way, down, either
from gearlink.core.base.report import Check, Quantity, Status
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.planar import outputs
from gearlink.core.machines.planar.course import Course
from gearlink.core.machines.planar.dyads import folded
from gearlink.core.machines.planar.extremes import Pair, Wanted, extremes, quick_return_ratio, turning_points
from gearlink.core.machines.planar.gaps import layout
from gearlink.core.machines.planar.outputs import RATES, Moved, moved, point_output
from gearlink.core.machines.planar.structure import Structure
from gearlink.core.machines.planar.wiring import FRAME
from gearlink.core.mechanism import courses
from gearlink.core.numerics.arrays import distinct
from gearlink.core.numerics.extremes import Extreme
from gearlink.core.numerics.gauss import GAUSS_NODES, GAUSS_WEIGHTS
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import ASSEMBLY, CLOSURE
from gearlink.core.studies.clearance import Layout, collision_check, seat_checks, shaft_checks

if TYPE_CHECKING:
    from collections.abc import Iterable

    from gearlink.core.machines.planar.spec import PlanarSpec
    from gearlink.core.machines.planar.system import Jets
    from gearlink.core.numerics.arrays import Reals


def greatest_gap(course: Course) -> float:
    """Maximum gap of a pin, a line or a mesh [mm], directions taken at the unit of length."""
    q = course.grid[:-1] if course.turns is not None else course.grid
    scaled, jets = course.walked(q), course.jets(q, 0)
    gaps = np.abs(course.system.values(jets, 0, scaled))
    return float(gaps.max()) * course.structure.size


_CHANGE = 1e-9


def loops(spec: PlanarSpec) -> list[str]:
    """The loops frame, driven link, coupler, output link of four pins, as "A B C D: crank-rocker"."""
    bodies, crank = spec.bodies, spec.drive.link
    if crank is None:
        return []
    found = []
    for a in _shared(bodies, FRAME, crank):
        for b in (point for point in bodies[crank] if point != a):
            for coupler in (name for name in bodies if name not in (FRAME, crank) and b in bodies[name]):
                for c in (point for point in bodies[coupler] if point != b):
                    for last in (name for name in bodies if name not in (FRAME, crank, coupler) and c in bodies[name]):
                        for d in _shared(bodies, FRAME, last):
                            if len({a, b, c, d}) == 4:
                                pairs = (crank, a, b), (coupler, b, c), (last, c, d), (FRAME, a, d)
                                lengths = [abs(bodies[body][p] - bodies[body][q]) for body, p, q in pairs]
                                found.append(f"{a} {b} {c} {d}: {sort_of(*lengths)}")
    return list(dict.fromkeys(found))


def _shared(bodies: dict[str, dict[str, complex]], one: str, other: str) -> list[str]:
    return [point for point in bodies[one] if point in bodies[other]]


def sort_of(crank: float, coupler: float, output: float, frame: float) -> str:
    """What a four-bar is by Grashof's rule.

    Example
        >>> sort_of(32.0, 96.0, 78.0, 120.0), sort_of(50.0, 60.0, 50.0, 60.0), sort_of(80.0, 60.0, 50.0, 100.0)
        ('crank-rocker', 'change-point', 'non-Grashof')
    """
    lengths = [crank, coupler, output, frame]
    least, _, _, greatest = sorted(lengths)
    apart = 2.0 * (least + greatest) - sum(lengths)
    if abs(apart) <= _CHANGE * greatest:
        return "change-point"
    if apart > 0.0:
        return "non-Grashof"
    return ("crank-rocker", "double-rocker", "rocker-crank", "double-crank")[lengths.index(least)]


_STEPS = 8
"""Of the grid, in a panel of the path."""
_ROUGH = 1e-7
"""Of the size of the speed: last coefficients of ten nodes, of whose squares the integral is wrong."""


def length(course: Course, x_of: Moved, y_of: Moved) -> float:
    """Length of the path over the period or range [mm]: the integral of |P'|.

    Notes
        Panels end where |P'| is smallest, at a kink where the point turns back. A panel is several steps of the grid,
        and those steps one by one where |P'| at its nodes is no polynomial: its last two Legendre coefficients tell.
    """
    point, arm = x_of, x_of.place / x_of.size

    def square(jets: Jets, k: int) -> Reals:
        rates = [(j + 1) * jets.point(point.body, arm, j + 1) for j in range(k + 1)]
        return np.asarray(sum((np.conj(rates[j]) * rates[k - j]).real for j in range(k + 1)))

    places = turning_points(course, square, ahead=1)
    x = np.array([*(-node for node in GAUSS_NODES), *GAUSS_NODES])
    w = np.array([*GAUSS_WEIGHTS, *GAUSS_WEIGHTS])

    def speeds(low: Reals, high: Reals) -> Reals:
        q = low[:, None] + 0.5 * (high - low)[:, None] * (1.0 + x)
        jets = course.jets(q.ravel(), 1)
        rates = [course.derivatives(each.coefficient, jets, 1)[1] for each in (x_of, y_of)]
        return np.asarray(np.hypot(*rates)).reshape(q.shape)

    grid = course.grid
    edges = distinct(np.concatenate([grid[::_STEPS], grid[-1:], places]))
    found = speeds(edges[:-1], edges[1:])
    size = np.abs(found) @ w
    tail = np.abs(found @ (w[:, None] * legendre.legvander(x, x.size - 1)[:, -2:])).max(axis=1)
    rough = tail > _ROUGH * size
    total = float(np.sum(0.5 * np.diff(edges)[~rough] * (found[~rough] @ w)))
    fine = distinct(np.concatenate([grid, places]))
    inside = rough[np.searchsorted(edges, fine[:-1], side="right") - 1]
    low, high = fine[:-1][inside], fine[1:][inside]
    return total + float(np.sum(0.5 * (high - low) * (speeds(low, high) @ w))) if low.size else total


GENERAL = (
    "degrees_of_freedom",
    "period_turns",
    "grashof",
    "min_transmission_angle",
    "min_transmission_angle_at",
    "free_range",
    "closure_error",
)
CAM_QUANTITIES = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_SIDES = ("max", "max_at", "min", "min_at")
_REAL = {"link": ("speed", "acceleration"), "line": ("velocity", "acceleration")}
_PER_TIME = {"link": ("rad/s", "rad/s^2"), "line": ("mm/s", "mm/s^2")}


class Meaning(NamedTuple):
    """What a quantity of an output is.

    Fields
        output : Moved - the number that it is of
        order : int - of the derivative
        side : "max", "max_at", "min", "min_at", or what else it is: "span", "return", "turns", "path"
        timed : bool - in real time
    """

    output: Moved
    order: int
    side: str
    timed: bool
    unit: str


def meanings(parts: tuple[Moved, ...], name: str, per: str, *, timed: bool) -> Iterator[tuple[str, Meaning]]:
    """The quantities of an output of the file.

    Parameters
        parts : its numbers: one, or both coordinates of a point
        per : unit of the input, rad or mm
        timed : bool - whether the speed of the input is known
    """
    at = "deg" if per == "rad" else "mm"
    for part in parts:
        if part.sort in ("x", "y"):
            yield from ((f"{name}.{part.sort}_{side}", Meaning(part, 0, side, False, at if "at" in side else "mm"))
                        for side in _SIDES)  # fmt: skip
            continue
        for order, rate in enumerate(RATES[part.sort]):
            unit = "deg" if (part.unit, order) == ("rad", 0) else courses.unit_of(part.unit, order, per)
            yield from ((f"{name}.{rate}_{side}", Meaning(part, order, side, False, at if "at" in side else unit))
                        for side in _SIDES)  # fmt: skip
            if order == 0:
                span = "swing" if part.sort == "link" else "stroke"
                yield f"{name}.{span}", Meaning(part, 0, "span", False, unit)
                yield f"{name}.quick_return_ratio", Meaning(part, 0, "return", False, "1")
                if part.sort == "link":
                    yield f"{name}.turns", Meaning(part, 0, "turns", False, "1")
        if timed:
            for order, (rate, unit) in enumerate(zip(_REAL[part.sort], _PER_TIME[part.sort], strict=True), 1):
                yield from (
                    (f"{name}.{rate}_{side}", Meaning(part, order, side, True, unit)) for side in ("max", "min")
                )
    if len(parts) == 2:
        yield f"{name}.path_length", Meaning(parts[0], 0, "path", False, "mm")


def generic() -> tuple[str, ...]:
    """The names that an output may have, under one name for all."""
    found = [f"{name}_{side}" for rates in RATES.values() for name in rates for side in _SIDES]
    found += [f"{axis}_{side}" for axis in "xy" for side in _SIDES]
    found += ["swing", "turns", "stroke", "quick_return_ratio", "path_length", "prime_radius", "base_radius"]
    found += CAM_QUANTITIES
    found += [f"{name}_{side}" for sort in _REAL for name in _REAL[sort] for side in ("max", "min")]
    return tuple(f"output.{name}" for name in dict.fromkeys(found))


_WORDS = {
    "angle": "direction",
    "position": "place",
    "speed_ratio": "speed per input speed",
    "velocity_ratio": "velocity per input speed",
    "acceleration_ratio": "acceleration per square of the input speed",
    "jerk_ratio": "jerk per cube of the input speed",
    "speed": "speed",
    "velocity": "velocity",
    "acceleration": "acceleration",
}
_WHOLE = {
    "swing": "swing of {}",
    "stroke": "stroke of {}",
    "quick_return_ratio": "time of the slower stroke of {} over that of the faster one",
    "turns": "net turns of {} over the period",
    "path_length": "length of the path of {} over the period or range",
}


def words_of(name: str) -> str:
    """In words, what a quantity of an output is.

    Example
        >>> words_of("rocker.speed_ratio_max_at")
        'input of the maximum speed per input speed of rocker'
    """
    output, _, rest = name.partition(".")
    if rest in _WHOLE:
        return _WHOLE[rest].format(output)
    where, rest = ("input of the ", rest.removesuffix("_at")) if rest.endswith("_at") else ("", rest)
    what, _, side = rest.rpartition("_")
    return f"{where}{'maximum' if side == 'max' else 'minimum'} {_WORDS.get(what, what)} of {output}"


_CLOSED = 1e-9
_FAR_OFF = 45.0  # deg
_ANYWAY = ("degrees_of_freedom", "period_turns")
_INPUTS = ("free_range", "min_transmission_angle_at")


class PlanarMechanism(Design):
    """Links, joints and drives of a file in motion."""

    kind = "planar-mechanism"
    spec: PlanarSpec
    keys = {
        "analyze": (
            "degrees_of_freedom",
            "grashof",
            "free_range",
            ("min_transmission_angle", ">limits.transmission_angle"),
            ("*.max_pressure_angle", "<limits.pressure_angle"),
            "*.prime_radius",
            "*.base_radius",
            "*.swing",
            "*.stroke",
            "*.quick_return_ratio",
            "*.turns",
            "*.path_length",
            "*.speed_max",
            "*.velocity_max",
            "*.acceleration_max",
            "*.speed_ratio_max",
            "*.velocity_ratio_max",
            "*.acceleration_ratio_max",
            "*.x_max",
            "*.x_min",
            "*.y_max",
            "*.y_min",
        )
    }
    outlines = {
        "analyze": Outline(
            (*GENERAL, *generic()),
            (
                "closure",
                "assembly",
                "transmission-angle",
                "gear-collision",
                "shaft-clearance",
                "shaft-seat",
                "pressure-angle",
                "cam-undercut",
                "acceleration-step",
            ),
            ("motion",),
        )
    }
    extra_tables = ("links", "points", "slides", "poles", "cams")
    quantity_names = NamesOfFile()

    @cached_property
    def structure(self) -> Structure:
        """Its bodies and joints."""
        return Structure(self.spec)

    @cached_property
    def course(self) -> Course:
        """Its motion from the start on."""
        return Course(self.structure)

    @property
    def cost(self) -> float:
        """A motion is followed over many places, and then searched."""
        followed = self.course.walk.followed if "course" in self.__dict__ and "walk" in self.course.__dict__ else 50
        return 2.0 * (followed + 20.0 * len(self.spec.links))

    # Names

    @cached_property
    def meanings(self) -> dict[str, Meaning]:
        """What the quantities of the outputs are."""
        per, timed = "mm" if self.spec.drive.slide else "rad", self.spec.input_speed is not None
        return dict(
            chain.from_iterable(
                meanings(moved(self.structure, name), name, per, timed=timed) for name in self.spec.shown
            )
        )

    @property
    def own_names(self) -> tuple[str, ...]:
        """The quantities of this design."""
        return (*GENERAL, *self.meanings, *self._of_cams)

    @property
    def _of_cams(self) -> Iterator[str]:
        """The quantities of the cams."""
        for name, cam in self.spec.cams.items():
            radius = "prime_radius" if cam.face is None else "base_radius"
            yield from (f"{name}.{each}" for each in (radius, *CAM_QUANTITIES))

    @classmethod
    def names_for(cls, spec: Any, /) -> tuple[str, ...]:
        """The quantities of the outputs of a file."""
        return cls(spec).own_names

    @classmethod
    def unit_for(cls, spec: Any, name: str, /) -> str:
        """Units follow the input and what the outputs are."""
        if name in GENERAL:  # inputs of a slide are in mm
            return "mm" if spec.drive.slide and name in _INPUTS else super().unit_for(spec, name)
        return cls(spec).unit_of(name)

    def unit_of(self, name: str) -> str:
        """Of this design, whose outputs are known."""
        meaning = self.meanings.get(name)
        if name in GENERAL:
            return super().unit_of(name)
        return super().unit_for(self.spec, name.rpartition(".")[2]) if meaning is None else meaning.unit

    def outline(self, command: str) -> Outline:
        """With the quantities of the file's outputs."""
        return super().outline(command)._replace(quantities=self.own_names)

    def decisive(self, _command: str) -> Iterable[str]:
        """Where the motion is followed to its end, everything exists."""
        return _ANYWAY

    def raw(self, name: str) -> Any:
        """Extremes stand under the names of the outputs."""
        if name in GENERAL:
            return super().raw(name)
        meaning = self.meanings.get(name)
        return self._of_cam(*name.split(".")) if meaning is None else self._of_output(meaning)

    def _of_cam(self, name: str, what: str) -> float:
        """A size of a cam [mm or rad]."""
        cam = self.structure.cams[name]
        if what in ("prime_radius", "base_radius"):
            return cam.start_radius
        found = getattr(cam.profile, what)
        return float(found if isinstance(found, float) else found.value)

    def quantity(self, name: str) -> Quantity | None:
        """Units of the outputs follow the input and what they are."""
        meaning = self.meanings.get(name)
        if name in self._of_cams:
            cam, what = name.split(".")
            entry, value = term(what), self._of_cam(cam, what)
            shown = math.degrees(value) if entry.unit == "deg" else value
            return Quantity(name, shown, entry.unit, entry.symbol, f"{entry.words}, of the cam {cam}")
        if meaning is None:
            return super().quantity(name)
        found = self.raw(name)
        if found is None:
            return None
        return Quantity(name, math.degrees(found) if meaning.unit == "deg" else found, meaning.unit, "", words_of(name))

    @property
    def traced(self) -> tuple[str, ...]:
        """The outputs of the file that are points."""
        return tuple(name for name in self.spec.shown if len(moved(self.structure, name)) == 2)

    @property
    def output_columns(self) -> dict[str, tuple[str, ...]]:
        """The first output of the file."""
        return {"motion": tuple(part.columns[0] for part in moved(self.structure, self.spec.shown[0]))}

    # General quantities

    @property
    def degrees_of_freedom(self) -> int:
        """Gruebler's degrees of freedom.

        Raises
            NoSolution - where there are not as many drives, or the mechanism does not close
        """
        _ = self.course.at_start.closed
        return self.structure.freedoms

    period_turns: int | None = placed("course.turns")

    @property
    def grashof(self) -> list[str] | None:
        """What the four-bars of the driven link on the frame are."""
        return loops(self.spec) or None

    @property
    def free_range(self) -> list[float | None] | None:
        """Inputs between which there is no dead centre [rad or mm], with a range."""
        found = None if self.spec.range is None else self.course.free_range
        return None if found is None else list(found)

    @cached_property
    def closure_error(self) -> float:
        """Maximum gap of a joint over the rows [mm]."""
        return greatest_gap(self.course)

    # Extremes

    @cached_property
    def _found(self) -> dict[tuple[str, int], Pair]:
        """Extremes that were asked for, by the number that moves and the order of the derivative."""
        return {}

    def prepare(self, quantities: Iterable[str], /) -> None:
        """Search the extremes of these quantities together; a motion that is refused is so where one is asked for."""
        with suppress(GearlinkError):
            self._search(key for name in quantities for key in self.needed(name))

    def needed(self, name: str) -> list[tuple[str, int]]:
        """Numbers and orders of their derivatives whose extremes a quantity is made of."""
        if name.startswith("min_transmission_angle"):
            return self.dyad_keys
        meaning = self.meanings.get(name)
        if meaning is None or meaning.side in ("return", "turns", "path") or self._turns_through(meaning):
            return []
        return [(meaning.output.name, meaning.order)]

    @property
    def dyad_keys(self) -> list[tuple[str, int]]:
        """The angles of the dyads."""
        return [(f"dyad {i}", 0) for i in range(len(self.course.dyads))]

    @property
    def moving_numbers(self) -> dict[str, tuple[Any, str]]:
        """By name what moves, its Taylor coefficients and its unit."""
        found: dict[str, tuple[Any, str]] = {
            each.output.name: (each.output.coefficient, each.output.unit) for each in self.meanings.values()
        }
        return found | {f"dyad {i}": (dyad.angle, "rad") for i, dyad in enumerate(self.course.dyads)}

    def extremes(self, *keys: tuple[str, int]) -> list[Pair]:
        """Extremes of numbers by name and order of the derivative."""
        self._search(keys)
        return [self._found[key] for key in keys]

    def wanted(self, keys: Iterable[tuple[str, int]]) -> dict[str, Wanted]:
        """Numbers with the orders of their derivatives, by name."""
        moving, orders = self.moving_numbers, dict[str, list[int]]()
        for name, order in dict.fromkeys(keys):
            orders.setdefault(name, []).append(order)
        return {name: Wanted(moving[name][0], of, moving[name][1]) for name, of in orders.items()}

    def _search(self, keys: Iterable[tuple[str, int]]) -> None:
        if wanted := self.wanted(key for key in keys if key not in self._found):
            self._found.update(extremes(self.course, wanted))

    def _turns_through(self, meaning: Meaning) -> bool:
        """Whether it is the direction of a link that turns on and on."""
        of_direction = meaning.output.sort == "link" and meaning.order == 0
        return of_direction and self.period_turns is not None and bool(self.course.gains[meaning.output.body])

    def _of_output(self, meaning: Meaning) -> float | None:
        output, order = meaning.output, meaning.order
        through = self._turns_through(meaning)
        if meaning.side == "turns":
            return float(round(self.course.gains[output.body] / (2.0 * math.pi))) if through else None
        if through:
            return None
        if meaning.side == "path":
            return length(self.course, *point_output(self.structure, output.name.removesuffix("_x")))
        if meaning.side == "return":
            return quick_return_ratio(self.course, Wanted(output.coefficient, (0,), output.unit))
        (found,) = self.extremes((output.name, order))
        if meaning.side == "span":
            return found.max.value - found.min.value
        extreme: Extreme = found.max if meaning.side.startswith("max") else found.min
        if meaning.side.endswith("_at"):
            return extreme.place
        return extreme.value * (self.angular_speed or 0.0) ** order if meaning.timed else extreme.value

    @property
    def angular_speed(self) -> float | None:
        """Speed of the input [rad/s or mm/s], where it is known."""
        given = self.spec.input_speed
        return None if given is None else given if self.spec.drive.slide else given * math.pi / 30.0

    @cached_property
    def _transmission(self) -> tuple[float, float] | None:
        """Minimum transmission angle of the dyads and its input."""
        found = self.extremes(*self.dyad_keys)
        angles = [(float(folded(each.value)), each.place) for pair in found for each in pair]
        if not angles:
            return None
        least = min(angle for angle, _ in angles)
        return least, min(place for angle, place in angles if angle <= least + 1e-10)

    min_transmission_angle: float | None = placed("_transmission.0")
    min_transmission_angle_at: float | None = placed("_transmission.1")

    # Tables

    table_motion, table_links, table_points = outputs.motion, outputs.links, outputs.points
    table_slides, table_poles, table_cams = outputs.slides, outputs.poles, outputs.cams

    def require_table(self, name: str, /) -> None:
        """Refuse the table of cams where there are none."""
        if name == "cams" and not self.spec.cams:
            raise MissingSection("the table cams needs cams", key="cams")

    # Checks

    def check_closure(self) -> Check:
        """GL305: joints that are closed at every row."""
        largest = self.structure.largest
        share = self.closure_error / largest
        status: Status = "fail" if share > _CLOSED else "pass"
        what, limit, fix = "closure error of the joints", _CLOSED * largest, "keep range away from a dead centre"
        return CLOSURE.check(status, what, self.closure_error, limit, "mm", side="<=", fix=fix)

    def check_assembly(self) -> Iterator[Check]:
        """GL318: rough start directions against those that were found."""
        for name, error in self.course.at_start.rough_errors.items():
            off = math.degrees(error)
            if off <= _FAR_OFF:
                continue
            _, t = self.course.at_start.closed
            found = math.degrees(float(t[self.structure.numbers[name]]))
            what, fix = f"deviation of {name} from start.{name}", f"set start.{name} near the required assembly"
            aside = f"found {short(found)} deg, start.{name} {short(self.spec.start[name])} deg"
            yield ASSEMBLY.check("warn", what, off, _FAR_OFF, "deg", side="<=", aside=aside, fix=fix)

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303: the minimum of all dyads."""
        if self.min_transmission_angle is not None:
            remedy = "bring the two links of the dyad nearer to a right angle"
            limit = self.spec.limits.transmission_angle
            yield transmission_check(self.min_transmission_angle, limit, remedy)

    @cached_property
    def layout(self) -> Layout | None:
        """Gears and shafts; None without either."""
        return layout(self)

    def check_gear_collision(self) -> Iterator[Check]:
        """GL301: gears that do not mesh."""
        for pair in () if self.layout is None else self.layout.gear_pairs:
            why = f"centres {short(pair.distance)} mm apart"
            remedy = "set the centres farther apart, or use fewer teeth"
            yield collision_check(pair, self.spec.limits.gear_gap, why, remedy)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302, of cams against their own shafts as well."""
        if self.layout is not None:
            yield from shaft_checks(self.layout)
        for cam in self.structure.cams.values():
            yield from cam.check_shaft()

    def check_shaft_seat(self) -> Iterator[Check]:
        """GL302."""
        return iter(()) if self.layout is None else seat_checks(self.layout)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 of every cam."""
        for cam in self.structure.cams.values():
            yield from cam.check_pressure_angle(self.spec.limits.pressure_angle)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 of every cam."""
        for cam in self.structure.cams.values():
            yield from cam.check_undercut()

    def check_acceleration_step(self) -> Iterator[Check]:
        """GL404 of every cam."""
        for cam in self.structure.cams.values():
            yield cam.check_step()

    def ways_of(self, check: str) -> Iterable[Way]:
        """Lengths of the bars, where the transmission angle is poor; shafts where they are in the way."""
        if check == "transmission-angle":
            bars = [f"links.{name}[2]" for name, link in self.spec.links.items() if isinstance(link, list)]
            return either(*bars) if bars else ()
        if check == "shaft-clearance":
            return tuple(down(f"shafts.{name}") for name in self.spec.shafts)
        return ()
