"""A long dwell by a mutilated gear as a design, with the four-bar that its driven gear turns.

Between reduction and driven gear the wheel carries g groups of n teeth on a pitch circle that has room for Z_M teeth.
While a group passes, the driven gear (Z_F teeth) turns as in mesh with a full wheel; then it stands, held by a locking
disc and plate where the file has them. The motion is that of pitch circles from end to end: the first and the last
tooth of a group are cut down to pass the resting gear, and what their cut tips change of it is not in the model.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import RealSpeed, per_time
from gearlink.core.base.remedies.ways import Way, down, either, up
from gearlink.core.base.report import Check, Shown, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.rows import row_numbers
from gearlink.core.base.wording import amount, short
from gearlink.core.mechanism.courses import Shown as Column
from gearlink.core.mechanism.courses import between, motion_table, turned
from gearlink.core.mechanism.joints import Connection, Pin, ToothDrive
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import TURN, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Rates, Turn, fixed
from gearlink.core.parts.gears.checks import GEAR_CHECKS
from gearlink.core.parts.gears.codes import GAP, START_SHOCK, TRUE_FILLET
from gearlink.core.parts.gears.drawing_names import BESIDE_ROOT
from gearlink.core.parts.gears.train.meshed import MESH_CHECKS, TRAIN_CHECKS, Meshed, train_ways
from gearlink.core.parts.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.parts.linkages.checks import check_linkage, transmission_check
from gearlink.core.parts.linkages.codes import LOCKING, TARGET
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
from gearlink.core.parts.linkages.fourbar.nearest_passes import joint_to_crank_pivot, rocker_swing
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
from gearlink.core.studies.clearance import SHAFT_WAYS, Gear, Layout, WithShafts, constant, least_shaft, shafts_at

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.locking import Lock
    from gearlink.core.machines.dwell_gears.mutilated_spec import MutilatedGearDwellSpec
    from gearlink.core.numerics.arrays import Mask, Reals
    from gearlink.core.parts.gears.rating.true_root import TrueRoot
    from gearlink.core.studies.movable import Movable


LEAST_DRIVEN, MOST_DRIVEN = 17, 120


def teeth_for_times(
    share: float, driven_turn: float, groups: int, driven: int | None, most_teeth: int
) -> tuple[int, int, int, int]:
    """Teeth with which the driven gear turns for a wanted share of the cycle.

    n g/Z_M -> M/(M + D),   n = driven_turn Z_F

    Parameters
        share : float - M/(M + D), input turns of the motion over those of the cycle
        driven_turn : float - turns of the driven gear in a motion
        groups : int - g
        driven : int or None - Z_F; None: from 17 to 120
        most_teeth : int - most Z_M
    Returns
        full_teeth, group_teeth, driven_teeth, stops : int - Z_M, a multiple of g, n, Z_F, and as many locking arcs as
            lead every group from one to another
    Raises
        NoSolution - where no numbers of teeth give this turn, or the wheel would have more teeth than allowed
    Notes
        All combinations; of those whose share comes equally near the one with the fewest teeth.
    Example
        >>> teeth_for_times(0.25, 1.0, 1, None, 200)
        (68, 17, 17, 1)
    """
    found = []
    for z in range(LEAST_DRIVEN, MOST_DRIVEN + 1) if driven is None else (driven,):
        n = round(driven_turn * z)
        if n < 1 or abs(n - driven_turn * z) > 1e-9 * z:
            continue
        around = n / share  # full teeth per group
        for pitches in {math.floor(around), math.ceil(around)}:
            full = pitches * groups
            if n < pitches and full <= most_teeth:
                found.append((round(abs(n / pitches - share), 12), full, n, z))
    if not found:
        of = f"{driven} teeth" if driven is not None else f"{LEAST_DRIVEN} to {MOST_DRIVEN} teeth"
        raise NoSolution(
            f"no driven gear of {of} makes {amount(driven_turn, 'turn', spec='.4g')} in {short(share)} "
            f"of a cycle with a wheel of at most {most_teeth} teeth",
            fix="increase most_teeth, use fewer groups, or another driven_turn",
        )
    _, full, n, z = min(found)
    return full, n, z, z // math.gcd(z, n)


@dataclass(frozen=True)
class MutilatedGear:
    """Reduction, mutilated wheel and driven gear.

    Parameters
        reduction : float - i_r, input revolutions per revolution of the wheel
        full_teeth : int - Z_M, teeth that the wheel would have without gaps
        group_teeth : int - n, teeth in a group
        groups : int - g, groups evenly round the wheel
        driven_teeth : int - Z_F
        stops : int - locking arcs evenly round the driven gear
    Raises
        NoSolution - for numbers that are not positive, groups that fill the wheel, or stops that a group of teeth
            does not lead back to
    Example
        >>> gear = MutilatedGear(6.0, 80, 20, 1, 20)
        >>> gear.cycle_turns, gear.motion_turns, gear.dwell_turns
        (6.0, 1.5, 4.5)

    Source
        thesis 2.2.2 (figure 2-6) gives the mechanism without a formula; own derivation
    """

    reduction: float
    full_teeth: int
    group_teeth: int
    groups: int
    driven_teeth: int
    stops: int = 1

    def __post_init__(self) -> None:
        if not 0.0 < self.reduction < math.inf:
            raise NoSolution(f"reduction is {self.reduction:g}; it must be positive and finite", key="reduction")
        for name in ("full_teeth", "group_teeth", "groups", "driven_teeth", "stops"):
            number = getattr(self, name)
            if isinstance(number, bool) or not isinstance(number, int) or number < 1:
                raise NoSolution(f"{name.replace('_', ' ')} is {number!r}; it must be a whole number, at least 1")
        self._require_gaps()
        self._require_locking()

    def _require_gaps(self) -> None:
        used = self.group_teeth * self.groups
        if used < self.full_teeth:
            return
        most = (self.full_teeth - 1) // self.groups
        remedy = f"at most {_teeth(most)} in a group" if most else f"fewer than {amount(self.full_teeth, 'group')}"
        raise NoSolution(
            f"{amount(self.groups, 'group')} of {_teeth(self.group_teeth)} fill the wheel of "
            f"{_teeth(self.full_teeth)}: the driven gear never stops",
            fix=f"use {remedy}, or more full teeth than {used}",
        )

    def _require_locking(self) -> None:
        if self.group_teeth * self.stops % self.driven_teeth == 0:
            return
        needed = self.driven_teeth // math.gcd(self.driven_teeth, self.group_teeth)
        step = self.driven_teeth // math.gcd(self.driven_teeth, self.stops)
        other = f"use {amount(needed, 'stop')}"
        near = step * max(1, round(self.group_teeth / step))
        fix = f"set gears.group_teeth to {near}, or {other}" if near * self.groups < self.full_teeth else other
        raise NoSolution(
            f"{_teeth(self.group_teeth)} advance the driven gear {short(self.group_teeth / self.driven_teeth)} "
            f"revolutions; it must stop at a locking arc ({self.stops} of them)",
            fix=fix,
        )

    @property
    def cycle_turns(self) -> float:
        """Input turns from the start of one motion to the start of the next, i_r/g."""
        return self.reduction / self.groups

    @property
    def motion_share(self) -> float:
        """Share of the cycle in which the driven gear turns, n g/Z_M."""
        return self.group_teeth * self.groups / self.full_teeth

    @property
    def dwell_share(self) -> float:
        """Share of the cycle in which it stands, 1 - n g/Z_M."""
        return (self.full_teeth - self.group_teeth * self.groups) / self.full_teeth

    @property
    def motion_turns(self) -> float:
        """Input turns of the motion, i_r n/Z_M."""
        return self.reduction * self.group_teeth / self.full_teeth

    @property
    def dwell_turns(self) -> float:
        """Input turns of the dwell, i_r/g - i_r n/Z_M."""
        return self.cycle_turns * self.dwell_share

    @property
    def driven_turn(self) -> float:
        """Turns of the driven gear per group of teeth, n/Z_F."""
        return self.group_teeth / self.driven_teeth

    @property
    def speed_ratio(self) -> float:
        """Speed of the driven gear over that of the input while it turns, Z_M/(Z_F i_r); pitch circles only."""
        return self.full_teeth / (self.driven_teeth * self.reduction)

    @cached_property
    def cycles_to_repeat(self) -> int:
        """Cycles after which the driven gear is at the same position again, Z_F/gcd(Z_F, n)."""
        return self.driven_teeth // math.gcd(self.driven_teeth, self.group_teeth)

    @property
    def gap(self) -> float:
        """Pitches from the last tooth of a group to the first of the next, Z_M/g - n + 1."""
        return self.full_teeth / self.groups - self.group_teeth + 1.0


def _teeth(number: int) -> str:
    return amount(number, "tooth", "teeth")


_TURN = 2.0 * math.pi
_SHOWN_CYCLES = 100
# A rocker that starts with less than this share of the driven gear's speed starts from rest.
_AT_REST = 1e-6
_FOUND = "found for target"
_CANDIDATES = (
    *("full_teeth", "group_teeth", "reduction", "center_distance", "motion_turns", "dwell_turns"),
    *("driven_speed_ratio", "rocker_start_speed", "min_transmission_angle"),
)


_TEETH = (
    up("gears.full_teeth", step=1),
    Way(("gears.driven", "gears.group_teeth", "gears.full_teeth"), 1, "ratio"),
    Way(("gears.driven", "gears.group_teeth"), 1, "ratio"),
)
_LINKS = either("links.crank", "links.frame", "links.rocker", "links.coupler")


class Start(NamedTuple):
    """The start of a motion: crank angle [rad], and rocker speed over input speed right after it."""

    crank_angle: float
    rocker_speed: float


def _with_teeth(spec: MutilatedGearDwellSpec) -> MutilatedGearDwellSpec:
    """The spec with the teeth and the reduction that required times ask for."""
    gears, target = spec.gears, spec.target
    if target is None or spec.reduction is not None:
        return spec
    motion, dwell = spec.wanted_turns()
    with at_key("target.driven_turn"):
        share = motion / (motion + dwell)
        full, group, driven, stops = teeth_for_times(
            share, target.driven_turn, gears.groups, gears.driven, target.most_teeth
        )
    chosen = {"full_teeth": full, "group_teeth": group, "driven": driven, "stops": gears.stops or stops}
    reduction = gears.groups * (motion + dwell)
    return spec.model_copy(update={"reduction": reduction, "gears": gears.model_copy(update=chosen)})


class MutilatedGearDwell(RealSpeed, WithShafts, Meshed):
    """Reduction, mutilated wheel and driven gear; the crank on its shaft stands while the gap passes."""

    kind = "mutilated-gear-dwell"
    spec: MutilatedGearDwellSpec
    keys = {
        "analyze": (
            *(("motion_time", "target.motion_time"), ("dwell_time", "target.dwell_time")),
            *(("motion_turns", "target.motion_turns"), ("dwell_turns", "target.dwell_turns")),
            *(("?driven_turn", "target.driven_turn"), "full_teeth", "group_teeth", "driven_teeth", "center_distance"),
            *("locking_play", "rocker_start_speed", ("min_transmission_angle", ">limits.transmission_angle")),
            "rocker_swing",
        )
    }
    outlines = {
        "analyze": Outline(
            (
                *("reduction", "full_teeth", "group_teeth", "driven_teeth", "stops", "cycle_turns", "motion_turns"),
                *("dwell_turns", "motion_share", "dwell_share", "driven_turn", "driven_speed_ratio"),
                *("cycles_to_repeat", "center_distance", "contact_ratio", "end_tooth_radius", "locking_radius"),
                *("locking_arc", "held_turns", "locking_play", "locking_arm", "start_crank_angle", "rocker_swing"),
                *("rocker_start_speed", "min_transmission_angle", "input_speed", "turn_time", "motion_time"),
                *("dwell_time", "driven_speed", "rocker_speed_at_start"),
            ),
            (
                *("target", "start-shock", "gap", "locking", "shaft-clearance", "shaft-seat", "transmission-angle"),
                *GEAR_CHECKS,
            ),
            ("motion",),
        ),
        "gear": Outline((*OF_MESH, "output_play"), (*MESH_CHECKS, *TRAIN_CHECKS)),
    }

    ways = {
        "gap": (down("gears.group_teeth", step=1), up("gears.full_teeth", step=1)),
        "locking": (down("locking.radius"), down("locking.plate_radius")),
        "shaft-clearance": SHAFT_WAYS,
        "transmission-angle": _LINKS,
        **train_ways(2, *_TEETH),
    }

    extra_tables = ("drawing", "factors", "root", "candidates")
    beside_tables = {"root": Outline(*BESIDE_ROOT)}

    def __init__(self, spec: Any) -> None:
        self.asked = spec
        super().__init__(_with_teeth(spec))

    @property
    def given(self) -> Any:
        """The spec without the teeth that were chosen."""
        return self.asked

    def completion(self) -> Iterator[Found]:
        """Teeth and reduction instead of the required times, from which they follow."""
        if self.asked.target is None or self.asked.reduction is not None:
            return
        yield Found("reduction", self.reduction, _FOUND)
        for key in ("full_teeth", "group_teeth", "driven", "stops"):
            if getattr(self.asked.gears, key) is None:
                yield Found(f"gears.{key}", getattr(self.spec.gears, key), _FOUND)
        yield Found("target", None)

    # What holds the driven gear

    @property
    def end_tooth_radius(self) -> float:
        """Radius to which the first and the last tooth of a group are cut down, so that they pass the resting gear."""
        from gearlink.core.machines.dwell_gears.wheel import end_tooth_radius

        return end_tooth_radius(self.mesh)

    @cached_property
    def lock(self) -> Lock | None:
        """Disc and plate, where the file has them."""
        section, wheel = self.spec.locking, self.mutilated
        if section is None:
            return None
        from gearlink.core.machines.dwell_gears.locking import Lock

        radius = self.mesh.working_radius[0] if section.radius is None else section.radius
        gap = _TURN * wheel.dwell_share / wheel.groups
        ratio = self.full_teeth / self.driven_teeth
        return Lock(self.mesh.center_distance, ratio, gap, radius, section.plate_radius, section.clearance, self.stops)

    locking_radius: float | None = placed("lock.radius")
    locking_arc: float | None = placed("lock.arc")
    locking_play: float | None = placed("lock.play")
    locking_arm: float | None = placed("lock.arm")

    @property
    def held_turns(self) -> float | None:
        """Input turns in which both tips of the plate's arc lie on the disc."""
        return None if self.lock is None else self.reduction * self.lock.held / _TURN

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The required times met by other driven gears and by more groups."""
        from gearlink.core.base.candidates import Sought, nothing_sought, pairs, table

        spec = self.asked
        if spec.target is None or spec.reduction is not None:
            raise nothing_sought("give target: {motion_turns, dwell_turns} and omit reduction and teeth")
        keys = {"gears.groups": ("groups", "1"), "gears.driven": ("driven_teeth", "1")}
        rows = pairs(sorted({1, 2, spec.gears.groups}), sorted({17, 20, 24, 30, 36, self.driven_teeth}))
        # Each candidate chooses its teeth anew, from what the file asks for.
        return table(self, Sought("analyze", keys, rows, _CANDIDATES), spec)

    # The root of the tooth next to a gap

    @cached_property
    def generated_roots(self) -> tuple[TrueRoot | None, TrueRoot | None]:
        """The roots of the wheel's tooth next to a gap and of the driven gear; None of one without a flank."""
        from gearlink.core.machines.dwell_gears.wheel import end_tooth_radius
        from gearlink.core.parts.gears.rating.true_root import end_tooth_root

        data = self.mesh_data[""]
        return end_tooth_root(data, end_tooth_radius(self.mesh)), data.true_roots[1]

    generated_root_factor: list[float | None] = placed("generated_roots.*.tension.factor")

    @property
    def generated_root_stress(self) -> tuple[float | None, float | None] | None:
        """The same with the load and its factors [N/mm^2]; None without load or width."""
        return self.mesh_data[""].root_stress_of(self.generated_root_factor)

    def table_root(self, _samples: int | None = None) -> Table:
        """Stress along the fillets of the tooth next to a gap and of the driven gear; without load over F_t/(b m)."""
        from gearlink.core.parts.gears.rating.true_root import root_table

        scales = self.mesh_data[""].root_stress_scale
        roots = list(zip(("tooth next to the gap", "driven gear"), self.generated_roots, strict=True))
        return root_table(roots, scales, self.mesh.module)

    def check_true_fillet(self) -> Iterator[Check]:
        """GL219: the tooth next to a gap has no section in ISO 6336, so the boundary integral alone rates it."""
        factor = self.generated_root_factor[0]
        if factor is None:
            return
        what, aside = "stress factor of the tooth next to a gap on its generated fillet", "in F_t/(b m)"
        note = "rated only by the boundary integral: ISO 6336 has no root section for it"
        yield TRUE_FILLET.check("pass", what, factor, aside=aside, note=note)

    @cached_property
    def mutilated(self) -> MutilatedGear:
        """The kernel's view of the gears."""
        with at_key("gears"):
            teeth = (self.full_teeth, self.group_teeth, self.spec.gears.groups, self.driven_teeth)
            return MutilatedGear(self.reduction, *teeth, self.stops)

    cycle_turns: float = placed("mutilated.cycle_turns")
    motion_turns: float = placed("mutilated.motion_turns")
    dwell_turns: float = placed("mutilated.dwell_turns")
    motion_share: float = placed("mutilated.motion_share")
    dwell_share: float = placed("mutilated.dwell_share")
    driven_turn: float = placed("mutilated.driven_turn")
    driven_speed_ratio: float = placed("mutilated.speed_ratio")
    cycles_to_repeat: int = placed("mutilated.cycles_to_repeat")

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Wheel and driven gear, where teeth meet."""
        return self.full_teeth, self.driven_teeth

    # The four-bar

    @cached_property
    def linkage(self) -> FourBar | None:
        """The four-bar on the driven shaft, where the file has one."""
        links = self.spec.links
        if links is None:
            return None
        with at_key("links"):
            linkage = FourBar(links.crank, links.coupler, links.rocker, links.frame, self.spec.assembly)
            check_linkage(linkage)
        return linkage

    @cached_property
    def start_crank_angle(self) -> float | None:
        """Crank angle of the dwell [rad], by default with crank and coupler stretched (in a drag link: farthest C)."""
        if self.linkage is None:
            return None
        if self.spec.start_angle is not None:
            return math.radians(self.spec.start_angle)
        return joint_to_crank_pivot(self.linkage)[1].crank_angle

    @property
    def rocker_swing(self) -> float | None:
        """Swing of the rocker between its dead centres [rad]; a drag link has none."""
        return None if self.linkage is None else rocker_swing(self.linkage)

    @cached_property
    def hardest_start(self) -> Start | None:
        """The start of a motion, among those of all cycles, at which the rocker is fastest."""
        linkage, first = self.linkage, self.start_crank_angle
        if linkage is None or first is None:
            return None
        cycles = range(self.cycles_to_repeat)
        angles = [first + _TURN * (cycle * self.group_teeth / self.driven_teeth) for cycle in cycles]
        starts = [Start(angle, self.driven_speed_ratio * solve(linkage, angle, 1).rocker_velocity) for angle in angles]
        return max(starts, key=lambda start: abs(start.rocker_speed))

    rocker_start_speed: float | None = placed("hardest_start.rocker_speed")

    @property
    def min_transmission_angle(self) -> float | None:
        """Minimum transmission angle of the turn [rad]."""
        return None if self.linkage is None else self.linkage.min_transmission_angle()

    driven_speed: float | None = per_time("driven_speed_ratio", 1)
    rocker_speed_at_start: float | None = per_time("rocker_start_speed", 1)

    @property
    def motion_time(self) -> float | None:
        """Time of a motion of the driven gear [ms]."""
        return None if self.turn_time is None else self.turn_time * self.motion_turns

    @property
    def dwell_time(self) -> float | None:
        """Time for which it stands [ms]."""
        return None if self.turn_time is None else self.turn_time * self.dwell_turns

    @cached_property
    def layout(self) -> Layout:
        """The wheel stands on any side of A, its distance from the shaft D free, unless the loads say where."""
        spec, mesh, linkage = self.spec, self.mesh, self.linkage
        (wheel, driven), (wheel_root, driven_root) = mesh.tip_radius, mesh.root_radius
        gears = (
            Gear("the mutilated wheel", "W", wheel, mates="A", root=wheel_root),
            Gear("the driven gear", "A", driven, root=driven_root),
        )
        reaches, axes = {"AW": constant(mesh.center_distance)}, "AW"
        if linkage is not None:
            reaches["AD"], axes = constant(linkage.frame), "ADW"
            if spec.loads is not None and spec.loads.wheel_direction is not None:
                place = cmath.rect(mesh.center_distance, math.radians(spec.loads.wheel_direction))
                reaches["DW"] = constant(abs(place - linkage.frame))
        return Layout(gears, shafts_at(axes, spec.shafts), reaches, least_shaft(spec.limits, spec.gears.module))

    def table_motion(self, samples: int | None = None) -> Table:
        """Driven gear and rocker until both are back at the start, or over a hundred cycles; a motion begins at 0."""
        count, cycles = samples or 360, min(self.cycles_to_repeat, _SHOWN_CYCLES)
        rows = row_numbers(samples, cycles * count)
        degrees = 360.0 * self.cycle_turns * np.arange(rows.start, rows.stop) / count
        gear, rocker = turned("crank").less(self.start_crank_angle or 0.0), turned("rocker")
        shown = [Column("driven_angle", gear), Column("driven_speed_ratio", gear, 1, "driven_speed")]
        if self.linkage is not None:
            # The jump of the speed at a start has no acceleration: these are those of the motion.
            shown += [
                Column("rocker_angle", rocker),
                Column("rocker_speed_ratio", rocker, 1, "rocker_speed"),
                Column("rocker_acceleration_ratio", rocker, 2, "rocker_acceleration"),
                Column("transmission_angle", between("coupler", "rocker")),
            ]
        return motion_table("motion", self, shown, samples, degrees=degrees)

    reduction: float = placed("spec.reduction")
    full_teeth: int = placed("spec.gears.full_teeth")
    group_teeth: int = placed("spec.gears.group_teeth")
    driven_teeth: int = placed("spec.gears.driven")

    @property
    def stops(self) -> int:
        """Locking arcs of the driven gear: one, where neither the file nor required times name them."""
        return self.spec.gears.stops or 1

    # Checks

    def check_target(self) -> Iterator[Check]:
        """GL307 where times are asked for: whole teeth may miss them."""
        target = self.spec.target
        if target is None:
            return
        pairs = zip(("motion", "dwell"), self.spec.wanted_turns(), (self.motion_turns, self.dwell_turns), strict=True)
        for name, asked, got in pairs:
            off = got / asked - 1.0
            bad = abs(off) > target.tolerance
            yield TARGET.check(
                "fail" if bad else "pass",
                f"deviation of the {name} from that required",
                abs(off),
                target.tolerance,
                shown=Shown(100.0 * abs(off), 100.0 * target.tolerance, "%", "<="),
                aside=f"{short(got)} input revolutions, required {short(asked)}",
                fix="increase target.most_teeth",
            )

    def check_start_shock(self) -> Check:
        """GL310: the driven gear starts at once at full speed, and the model ends at the pitch circles."""
        ratio = self.driven_speed_ratio
        what = "step of the speed ratio at start and stop of the driven gear"
        note = "" if self.hardest_start is None else self._start_in_words(self.hardest_start)
        fix = "add entry cams or springs (not part of this model)"
        return START_SHOCK.check("warn", what, ratio, 0.0, fix=fix, note=note)

    def _start_in_words(self, start: Start) -> str:
        if abs(start.rocker_speed) <= _AT_REST * self.driven_speed_ratio:
            which = "" if self.cycles_to_repeat == 1 else " in every cycle"
            return f"the rocker itself starts from rest, at a dead centre{which}"
        text = f"the rocker starts with {short(start.rocker_speed)} of the input speed"
        if self.cycles_to_repeat == 1:
            return f"{text}; without start_angle it starts from rest, at a dead centre"
        return (
            f"{text} at crank angle {short(math.degrees(start.crank_angle) % 360.0)} deg; only a group of "
            f"{self.driven_teeth} teeth starts from a dead centre every time"
        )

    def check_gap(self) -> Check:
        """GL316: how long no tooth is in contact."""
        free, subject = (
            self.mutilated.gap - self.mesh.contact_ratio,
            "travel of the wheel without contact over the pitch",
        )
        return GAP.below(free, 0.0, 1.0, "1", subject, "reduce gears.group_teeth, so that the locking arc fits")

    def check_locking(self) -> Iterator[Check]:
        """GL344: metal between the plate's arc and the shaft of the gear, and between the cut-out and the wheel's."""
        lock, shafts = self.lock, self.spec.shafts
        if lock is None:
            return
        radii = (0.0, 0.0) if shafts is None else (shafts.A_radius or 0.0, shafts.W_radius or 0.0)
        walls = (
            (lock.bottom - radii[0], "metal between the plate's arc and the shaft A", "a smaller locking.radius"),
            (lock.cut - radii[1], "metal between the disc's cut-out and the shaft W", "a smaller locking.plate_radius"),
        )
        for wall, what, remedy in walls:
            overlap = what.replace("metal between", "overlap of").replace(" and the", " with the")
            status: Status = "pass" if wall > 0.0 else "fail"
            yield LOCKING.check(status, what, wall, 0.0, "mm", overlap=overlap, fix=f"use {remedy}")

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303, where there is a four-bar."""
        if self.min_transmission_angle is None:
            return
        yield transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, "shorten the crank")


def errors(design: MutilatedGearDwell, mechanism: Mechanism) -> Movable:
    """The links of the four-bar, the angle at which it starts, and the runout of the driven gear."""
    from gearlink.core.mechanism.dual import Shift, longer
    from gearlink.core.studies.movable import Movable, Turned

    bar, gears = design.linkage, design.spec.gears
    found = {"driven": Turned.of("crank", gears, design.driven_teeth)}
    if bar is None:
        return Movable(gears=found, radius=0.5 * gears.module * design.driven_teeth)
    ends = {f"links.{name}": (name, getattr(bar, name)) for name in ("crank", "coupler", "rocker")}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, bar.frame)})
    sizes["start_angle"] = (Shift("crank", ("B",), math.radians(1.0), turned=True),)
    return Movable(sizes, gears=found, radius=bar.rocker)


_NEAR = 8.0
"""Units in the last place by which a place may lie before the start of a motion and be it."""


def motion(design: MutilatedGearDwell) -> Motion:
    """Links and joints over the input angle; a motion begins at 0, and the driven gear's axis is at 0.

    Without the four-bar on its shaft the driven gear is alone.
    """
    linkage, start = design.linkage, design.start_crank_angle or 0.0
    ratio, section = design.mutilated.speed_ratio, design.spec.loads
    direction = math.radians((section.wheel_direction if section is not None else None) or 0.0)
    radius, tangent = design.mesh.working_radius[1], math.tan(design.mesh.working_pressure_angle)

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        angle, moves = driven(design.mutilated, phi, side)
        rate = np.where(moves, ratio, 0.0)
        if linkage is None:
            still, even = fixed(0j, phi, order=order), [start + angle, np.ones_like(phi), *[np.zeros_like(phi)] * 2]
            links = {"crank": Link(still, Turn(*even[: order + 1]))}
        else:
            links = four_bar(linkage, start + angle, order)
        links = {
            name: Link(Point(*_by_input(link.origin, rate)), Turn(*_by_input(link.turn, rate)), link.points)
            for name, link in links.items()
        }
        axis = links["crank"].origin.value
        joints: list[Connection] = [Pin("A", FRAME, "crank", axis)] if linkage is None else [*four_bar_pins(links)]
        joints.append(ToothDrive("mesh_wheel", "crank", axis, cmath.rect(1.0, direction), radius, tangent, moves))
        return Mechanism(links, joints, "mesh_wheel", gain=radius * rate)

    outputs: tuple[Output, ...] = (Output("Driven gear", turned("crank").less(start)),)
    if linkage is not None:
        outputs = Output("Rocker CD", turned("rocker")), *outputs
    turns = design.cycle_turns * design.cycles_to_repeat
    given = Input(end=TURN * turns, turns=None, joints=_joints(design))
    return Motion(make, given, outputs, transmission=None if linkage is None else between("coupler", "rocker"))


def _by_input(rates: Rates[Any], rate: Reals) -> list[Any]:
    """Derivatives by the driven gear's angle as those by the input, which drives it at a rate that stays."""
    return [each if k == 0 else each * rate**k for k, each in enumerate(rates)]


def _joints(design: MutilatedGearDwell) -> tuple[float, ...]:
    """Input angles at which a motion begins or ends, until wheel and linkage come home [rad]."""
    cycle, moved = TURN * design.cycle_turns, TURN * design.motion_turns
    return tuple(start for k in range(design.cycles_to_repeat) for start in (k * cycle, k * cycle + moved))


def driven(gear: MutilatedGear, phi: Reals, side: int = 1) -> tuple[Reals, Mask]:
    """Angle that the driven gear has turned since input angle 0, where a motion begins, and whether it moves.

    psi = k n/Z_F 2 pi + min(speed_ratio * rest, n/Z_F 2 pi),   k whole cycles

    Parameters
        phi : (N,) array [rad] - input angles
        side : +1 or -1 - just after them, or just before: it is then that a start or an end of the motion counts
    Returns
        psi, moves : (N,) arrays [rad], bool
    Notes
        A place that is the start or the end of a motion but for rounding is that.
    Example
        >>> psi, moves = driven(MutilatedGear(6.0, 80, 20, 1, 20), TURN * np.array([0.75, 3.0, 6.75]))
        >>> (psi / TURN).round(12).tolist(), moves.tolist()
        ([0.5, 1.0, 1.5], [True, False, True])
    """
    cycle, step, moved = TURN * gear.cycle_turns, TURN * gear.driven_turn, TURN * gear.motion_turns
    rest = np.mod(phi, cycle)
    near = _NEAR * np.spacing(np.maximum(np.abs(phi), cycle))
    rest = np.where(cycle - rest <= near, 0.0, rest)
    whole = np.round((phi - rest) / cycle)
    # Within a cycle the gear turns by one step, and then stands.
    angle = np.asarray(whole * step + np.minimum(gear.speed_ratio * rest, step))
    moves = rest < moved - near if side > 0 else (rest > near) & (rest <= moved + near)
    return angle, np.asarray(moves)
