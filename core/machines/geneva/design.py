"""A Geneva drive: sizes, motion, forces on the pin, and its comparison with a gear linkage and a cam."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, in_section
from gearlink.core.base.real_speed import RealSpeed, per_time
from gearlink.core.base.remedies.ways import either
from gearlink.core.base.report import Check, Status, Table, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.parts.linkages.codes import LOCKING, PIN_ENTRY, SHAFT_CLEARANCE, STEP_RATE

if TYPE_CHECKING:
    from gearlink.core.machines.geneva.bodies import Outlines
    from gearlink.core.machines.geneva.mechanism import Geneva
    from gearlink.core.machines.geneva.spec import GenevaDriveSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme

TURN = 2.0 * math.pi
SIZES = ("crank_radius", "wheel_radius", "tip_radius", "slot_bottom_radius", "lip_thickness")
PLAYS = ("wheel_backlash", "locking_play")
MOTION = (
    "motion_angle", "motion_share", "locking_angle", "speed_ratio_max", "acceleration_ratio_max",
    "acceleration_ratio_max_at", "entry_acceleration_ratio", "input_speed", "turn_time", "steps_per_minute",
    "output_speed_max", "output_acceleration_max",
)  # fmt: skip
FORCES = ("contact_force_max", "contact_force_max_at", "input_torque_max", "input_torque_max_at")
_COMPARED = "three-gear-four-bar"
_SAME = 1e-9


class GenevaDrive(RealSpeed, Design):
    """A wheel of radial slots, and a crank whose pin enters them along the slot."""

    kind = "geneva-drive"
    spec: GenevaDriveSpec
    keys = {
        "analyze": (
            "motion_angle",
            "motion_share",
            ("steps_per_minute", "<limits.steps_per_minute"),
            "crank_radius",
            "wheel_radius",
            "slot_bottom_radius",
            "output_acceleration_max",
            "contact_force_max",
            "input_torque_max",
            "locking_angle",
            "speed_ratio_max",
            "acceleration_ratio_max",
        ),
    }
    outlines = {
        "analyze": Outline(
            (*SIZES, *PLAYS, *MOTION, *FORCES), ("locking", "pin-entry", "shaft-clearance", "step-rate"), ("motion",)
        )
    }
    extra_tables = ("comparison",)
    requirements = Design.requirements | {"slots", "type", "limits.steps_per_minute"}
    ways = {
        "locking": either("locking_radius", "pin_radius", "center_distance"),
        "pin-entry": either("locking_clearance", "slot_clearance"),
        "shaft-clearance": either("shaft_radius", "hub_radius", "center_distance"),
    }

    def outline(self, command: str) -> Outline:
        """With a design to compare, its table."""
        found = self.outlines[command]
        return found if self.spec.compare is None else found._replace(tables=(*found.tables, "comparison"))

    # Sizes

    @cached_property
    def drive(self) -> Geneva:
        """Its motion in closed form."""
        from gearlink.core.machines.geneva.mechanism import Geneva

        sign = 1.0 if self.spec.type == "external" else -1.0
        return Geneva(self.spec.slots, self.spec.pins, self.spec.center_distance, sign)

    crank_radius: float = placed("drive.crank")
    wheel_radius: float = placed("drive.wheel")

    @property
    def tip_radius(self) -> float:
        """Wheel axis to the corners of a slot's mouth [mm]: sqrt(wheel^2 + (b/2)^2)."""
        return self.outlines_with(0.0).tip

    def outlines_with(self, locking: float) -> Outlines:
        """Wheel and driver with a locking disc of this radius [mm]."""
        from gearlink.core.machines.geneva.bodies import Outlines

        return Outlines(self.drive, self._half_slot, locking, locking + self.spec.locking_clearance)

    @property
    def _half_slot(self) -> float:
        return self.spec.pin_radius + 0.5 * self.spec.slot_clearance

    @property
    def slot_bottom_radius(self) -> float | None:
        """Wheel axis to the bottom of a slot [mm], a - r - b/2; of an internal wheel the bottoms lie outside."""
        if self.drive.sign < 0.0:
            return None
        return self.drive.distance - self.crank_radius - self._half_slot

    @property
    def lip_thickness(self) -> float | None:
        """Metal between the locking arc and a slot [mm]: r - b/2 - (locking_radius + locking_clearance)."""
        locking = self.spec.locking_radius
        return None if locking is None else self.crank_radius - self._half_slot - locking - self.spec.locking_clearance

    # Play

    @property
    def wheel_backlash(self) -> float | None:
        """Maximum angle that the wheel can turn about a pin in its slot [rad]: 2 asin(c/(2 p)), p the minimum reach."""
        if not self.spec.slot_clearance:
            return None
        nearest = self.drive.distance - self.crank_radius if self.drive.sign > 0.0 else self.wheel_radius
        return 2.0 * math.asin(0.5 * self.spec.slot_clearance / nearest)

    @property
    def locking_play(self) -> float | None:
        """Angle that the wheel can turn in the middle of the dwell [rad]."""
        if self.spec.locking_radius is None or not self.spec.locking_clearance:
            return None
        return self.outlines_with(self.spec.locking_radius).play

    # Motion

    @property
    def motion_angle(self) -> float:
        """Crank angle of a step [rad]."""
        return 2.0 * self.drive.half

    @property
    def motion_share(self) -> float:
        """Share of a revolution of the crank in which one pin moves the wheel: 1/2 - s/n."""
        return self.motion_angle / TURN

    @property
    def locking_angle(self) -> float:
        """Crank angle between two steps, in which the wheel dwells [rad]."""
        return TURN / self.spec.pins - self.motion_angle

    @property
    def speed_ratio_max(self) -> float:
        """Maximum speed of the wheel over the crank's, on the line of centres: l/(1 - s l)."""
        lam = self.drive.ratio
        return lam / (1.0 - self.drive.sign * lam)

    @property
    def acceleration_ratio_max(self) -> float:
        """Maximum magnitude of the wheel's acceleration over the square of the crank's speed."""
        import numpy as np

        return float(self.drive.rates(np.array([self.drive.peak_place]), 2)[2][0])

    acceleration_ratio_max_at: float = placed("drive.peak_place")

    @property
    def entry_acceleration_ratio(self) -> float:
        """Jump of the acceleration ratio at entry and exit: tan(pi/n)."""
        return math.tan(math.pi / self.spec.slots)

    @property
    def steps_per_minute(self) -> float | None:
        """Steps in a minute."""
        return None if self.input_speed is None else self.input_speed * self.spec.pins

    output_speed_max: float | None = per_time("speed_ratio_max", 1)
    output_acceleration_max: float | None = per_time("acceleration_ratio_max", 2)

    # Forces

    def needs(self, name: str, /) -> str:
        """What contact force and torque rest on."""
        if name not in FORCES:
            return ""
        return "wheel: {inertia, resistance}" if self.spec.wheel is None else "input_speed"

    @property
    def _torque(self) -> tuple[float, float] | None:
        """Inertia times the square of the speed, and resistance [N m]."""
        wheel = self.spec.wheel
        if wheel is None or (wheel.inertia > 0.0 and self.angular_speed is None):
            return None
        return wheel.inertia * (self.angular_speed or 0.0) ** 2, wheel.resistance

    def forces(self, f: Reals) -> tuple[Reals, Reals]:
        """Force between pin and slot [N] and torque of the crank [N m] while the wheel moves.

        N = |J W' w^2 + T|/p,  torque (J W' w^2 + T) W

        Parameters
            f : (N,) array [rad] - crank angle from the line of centres
        """
        assert self._torque is not None
        inertial, resistance = self._torque
        _, speed, acceleration = self.drive.rates(f, 2)
        torque = inertial * acceleration + resistance
        return abs(torque) / (1e-3 * self.drive.reach(f)), torque * speed

    @cached_property
    def _hardest(self) -> list[Extreme] | None:
        if self._torque is None:
            return None
        from gearlink.core.numerics.extremes import extremes_over

        half = self.drive.half
        return extremes_over(
            [(lambda f: self.forces(f)[0], True), (lambda f: abs(self.forces(f)[1]), True)], -half, half
        )

    contact_force_max: float | None = placed("_hardest.0.value")
    contact_force_max_at: float | None = placed("_hardest.0.place")
    input_torque_max: float | None = placed("_hardest.1.value")
    input_torque_max_at: float | None = placed("_hardest.1.place")

    # Tables

    def table_motion(self, samples: int | None = None) -> Table:
        """The wheel over a revolution of the crank from a pin on the line of centres."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        phi = np.radians(degrees)
        (angle, speed, acceleration), moves, pin = self.drive.over(phi, 2)
        columns: dict[str, tuple[Any, str]] = {
            "crank_angle": (degrees, "deg"),
            "wheel_angle": (np.degrees(angle), "deg"),
            "speed_ratio": (speed, "1"),
            "acceleration_ratio": (acceleration, "1"),
        }
        if self._torque is not None:
            force, torque = self.forces(phi - pin * (TURN / self.spec.pins))
            columns["contact_force"] = np.where(moves, force, 0.0), "N"
            columns["input_torque"] = np.where(moves, torque, 0.0), "N m"
        rates = {"output_speed": ("speed_ratio", 1), "output_acceleration": ("acceleration_ratio", 2)}
        return Table.of("motion", self.timed(columns, "crank_angle", rates))

    def require_table(self, name: str, /) -> None:
        """A comparison needs the other design."""
        if name == "comparison" and self.spec.compare is None:
            message = "the table comparison needs compare: {gears, links, ...}, a three-gear-four-bar of the same step"
            raise MissingSection(message, key="compare")

    @cached_property
    def compared(self) -> Any:
        """The gear linkage of `compare`, with the tolerance of its dwell.

        Raises
            NoSolution - where its step is another
        """
        from gearlink.core.base.kinds import KINDS
        from gearlink.core.base.spec_paths import changed

        spec = changed(self.spec.compare, [("dwell_backlash", None), ("dwell_tolerance", self.spec.compare_tolerance)])
        with in_section("compare"):
            found: Any = KINDS[_COMPARED].design("analyze", spec)
            turns = found.mean_ratio
        if abs(abs(turns) * self.spec.slots - 1.0) > _SAME:
            message = (
                f"the linkage moves its output by {short(360.0 * turns)} deg per revolution, this wheel by "
                f"{short(math.degrees(self.drive.step))} deg"
            )
            raise NoSolution(message, key="compare.gears", fix=f"choose teeth with crank/output 1/{self.spec.slots}")
        return found

    def table_comparison(self, _samples: int | None = None) -> Table:
        """This drive, a cam with a modified sine of the same motion angle, and the gear linkage, of the same step.

        Dwells are crank angles in which the output stays within +-compare_tolerance; `steps_per_minute` are those at
        the peak acceleration of this drive: n sqrt(A_this/A_other).
        """
        self.require_table("comparison")
        from gearlink.core.numerics.roots import bracketed_root
        from gearlink.core.parts.cams.laws import law

        step, half, pitch = self.drive.step, math.radians(self.spec.compare_tolerance), TURN / self.spec.pins
        if half >= 0.5 * step:
            most = safely_below(math.degrees(0.5 * step))
            raise NoSolution(
                f"compare_tolerance: {short(self.spec.compare_tolerance)} deg (limit < {most} deg, half a step)",
                key="compare_tolerance",
                fix=f"set compare_tolerance below {most} deg",
            )
        sine, share, other = law("modified-sine"), self.motion_angle, self.compared
        left = bracketed_root(lambda x: sine.evaluate(x, 0)[0] - half / step, 0.0, 0.5)
        rows = [
            ("geneva-drive", step, pitch - 2.0 * self.drive.leaves(half), self.speed_ratio_max,
             self.acceleration_ratio_max, self.spec.pins),
            ("cam, modified sine", step, pitch - share * (1.0 - 2.0 * left),
             step * sine.peak_velocity / share, step * sine.peak_acceleration / share**2, self.spec.pins),
            (_COMPARED, step, other.tolerance_dwell_angle or 0.0, other.speed_ratio_max,
             max(other.acceleration_ratio_max, -other.acceleration_ratio_min), 1),
        ]  # fmt: skip
        speed = math.nan if self.input_speed is None else self.input_speed
        hardest = self.acceleration_ratio_max
        names, steps, dwells, speeds, peaks_of, pins = zip(*rows, strict=True)
        rate = [speed * per * math.sqrt(hardest / each) for per, each in zip(pins, peaks_of, strict=True)]
        columns: dict[str, tuple[Any, str]] = {
            "mechanism": (names, ""),
            "step": ([math.degrees(each) for each in steps], "deg"),
            "dwell": ([math.degrees(each) for each in dwells], "deg"),
            "speed_ratio_max": (speeds, "1"),
            "acceleration_ratio_max": (peaks_of, "1"),
            "steps_per_minute": (rate, "1/min"),
        }
        return Table.of("comparison", columns)

    # Checks

    def check_locking(self) -> Iterator[Check]:
        """GL344: the lip at the locking arc, and the web between two slots of an external wheel."""
        lip = self.lip_thickness
        if lip is not None:
            status: Status = "fail" if lip <= 0.0 else "pass"
            what, overlap = "thickness of the lip between locking arc and slot", "overlap of locking arc and slot"
            fix = "take a smaller locking_radius or pin_radius"
            yield LOCKING.check(status, what, lip, 0.0, "mm", overlap=overlap, fix=fix)
            yield from self._held(self.outlines_with(self.spec.locking_radius or 0.0), lips=lip > 0.0)
        if self.drive.sign > 0.0:
            bottom = self.drive.distance - self.crank_radius
            web = 2.0 * (bottom * self.drive.ratio - self._half_slot)
            status = "fail" if web <= 0.0 else "pass"
            what, overlap = "web between the bottoms of two slots", "overlap of the bottoms of two slots"
            fix = "take a smaller pin_radius, or a larger center_distance"
            yield LOCKING.check(status, what, web, 0.0, "mm", overlap=overlap, fix=fix)

    @staticmethod
    def _held(outlines: Outlines, *, lips: bool) -> Iterator[Check]:
        """Whether the disc reaches into the wheel, and lets the lips that it leaves pass beside a driven slot."""
        depth, deeper = outlines.depth, "choose a larger locking_radius"
        status: Status = "fail" if depth <= 0.0 else "pass"
        what, overlap = "depth of the locking disc in the wheel", "gap between locking disc and wheel"
        yield LOCKING.check(status, what, depth, 0.0, "mm", overlap=overlap, fix=deeper)
        if lips and depth > 0.0 and (over := outlines.overlap) > 0.0:
            what = "interference of the lip at a slot with the edge of the locking disc"
            yield LOCKING.check("fail", what, over, 0.0, "mm", side="<=", fix=deeper)

    def check_pin_entry(self) -> Iterator[Check]:
        """GL347: whether a wheel that stands off by its play takes the pin."""
        play = self.locking_play
        if play is None:
            return
        off, most = self.wheel_radius * math.sin(0.5 * play), 0.5 * self.spec.slot_clearance
        what = "offset of a slot at its mouth, of the locked wheel"
        fix = "lower locking_clearance, raise slot_clearance, or chamfer the mouths of the slots"
        yield PIN_ENTRY.check("warn" if off > most else "pass", what, off, most, "mm", fix=fix)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: the crank's shaft beside an external wheel, and the wheel's hub within the bottoms of its slots."""
        bottom = self.slot_bottom_radius
        if bottom is None:
            return
        room = self.drive.distance - self.tip_radius
        pairs = (("tips of the wheel", "crank's shaft", room, self.spec.shaft_radius, "shaft_radius"),
                 ("bottoms of the slots", "wheel's hub", bottom, self.spec.hub_radius, "hub_radius"))  # fmt: skip
        for what, body, place, radius, key in pairs:
            if radius is None:
                continue
            fails = place <= radius
            subject, aside = f"space left by the {what}", f"radius of the {body}"
            fix = f"lower {key}, or enlarge center_distance"
            yield SHAFT_CLEARANCE.check("fail" if fails else "pass", subject, place, radius, "mm", aside=aside, fix=fix)

    def check_step_rate(self) -> Iterator[Check]:
        """GL345."""
        rate, speed, limit = self.steps_per_minute, self.spec.input_speed, self.spec.limits.steps_per_minute
        if rate is None or speed is None:
            return
        over = rate > limit
        fix = f"reduce input_speed to {safely_below(abs(speed) * limit / rate)} 1/min or less" if over else ""
        yield STEP_RATE.check("warn" if over else "pass", "step rate", rate, limit, "1/min", fix=fix)
