"""Syntheses of the three-gear four-bar: from an output motion to its links, and to its idler where it is left out.

A `Task` is what a section of the file asks of the links; it finds them for an idler, and the idler. The tasks of the
family I = 1 have closed forms, and for gears of any size one bracketed root among the linkages of `families`. A
synthesis is a design with its task: back-step, variable speed and momentary dwell here, the dwell in `dwell_synthesis`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key, section_of
from gearlink.core.base.real_speed import other_speed
from gearlink.core.base.remedies.ways import at_most
from gearlink.core.base.report import Check, Remedy, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.three_gear import momentary, symmetric
from gearlink.core.machines.three_gear.codes import target_judged
from gearlink.core.machines.three_gear.design import CHECKS, MESHES, QUANTITIES, ThreeGearFourBar, layout, tip_excess
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.train import GearTrain, gear_gap, idler_for_ratio
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families import Family
    from gearlink.core.machines.three_gear.spec import ThreeGearSpec

_GEARS = ThreeGearFourBar.outlines["gear"]
TABLES = (*ThreeGearFourBar.extra_tables, "candidates")
LEAST_IDLER = 17
GREATEST_IDLER = 400
_RING_DIFFERENCE = 8


def with_analysis(synthesis: str, outline: Outline) -> dict[str, Outline]:
    """What a synthesis shows: its own outline, the analysis of what it finds, and its gears."""
    return {synthesis: outline, "analyze": outline._replace(tables=("motion",)), "gear": _GEARS}


class Task:
    """What a section of the file asks of the links.

    Parameters
        spec : ThreeGearSpec - its gears, limits and shafts count, and the section of the task
    Fields
        section, keys : str - the section of the file, and what it needs
    """

    section = keys = ""

    def __init__(self, spec: ThreeGearSpec) -> None:
        self.spec = spec

    @property
    def request(self) -> Any:
        """The section."""
        return section_of(self.spec, self.section, self.keys)

    def linkage_of(self, idler: int) -> FourBar:
        """The links that meet the task with an idler of so many teeth."""
        raise NotImplementedError

    def output(self, linkage: FourBar, train: GearTrain) -> Output:
        """How the output goes with the links that were found."""
        return Output(linkage, train)

    def require_gears(self) -> None:
        """Refuse gears that the task does not serve."""

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """Whether another idler could avoid a refusal of `linkage_of`."""
        return True

    def radii(self, idler: float) -> tuple[float, float, float]:
        """Reference radii of crank gear, idler and output gear [mm]."""
        gears = self.spec.gears
        r1, r3, r5 = (gears.transverse_module * teeth / 2.0 for teeth in (gears.crank, idler, gears.output))
        return r1, r3, r5

    @property
    def _addendum(self) -> float:
        """Half of what the tips of gears 1 and 5 reach beyond their reference circles, in transverse modules."""
        return 0.5 * tip_excess(self.spec.gears) / self.spec.gears.transverse_module

    def chosen_idler(self, *, advises: bool = True) -> int:  # noqa: ARG002 - a dwell has more to say
        """The smallest idler that keeps transmission angle and gear gap; a refusal that `advises` says what would."""
        gears, limits = self.spec.gears, self.spec.limits
        try:
            return smallest_idler(
                self.linkage_of,
                gears.crank,
                gears.output,
                gears.transverse_module,
                addendum=self._addendum,
                min_transmission_angle=math.radians(limits.transmission_angle),
                min_gear_gap=limits.gear_gap,
                clear=self._clears_shafts,
            )
        except MissingSection:
            raise
        except NoSolution as error:
            if error.key in ("", "gears.idler", "gears.crank", "gears.output") or not self.depends_on_idler(error):
                raise
            words = f"no idler from {LEAST_IDLER} to {GREATEST_IDLER} teeth meets the task: {error.message}"
            raise NoSolution(words, key="gears.idler", fix=error.fix) from error

    def _clears_shafts(self, linkage: FourBar, idler: int) -> bool:
        """Whether no gear reaches a shaft that the file names."""
        shafts, gears = self.spec.shafts, self.spec.gears
        if shafts is None:
            return True
        teeth = (gears.crank, idler, gears.output)
        own = None
        if gears.own_teeth:
            from gearlink.core.parts.gears.train.meshes import Train

            own = dict(zip(MESHES, Train(gears, teeth, (None, None)).pairs(), strict=True))
        found = layout(linkage, GearTrain(*teeth), self.spec, own).shaft_pairs
        return all(pair.gap >= 0.0 for pair in found if not pair.bare)

    def idler_with_room(self, idler: int) -> int | None:
        """The next larger idler with which gears 1 and 5 keep their gap; None without one."""
        gears, limit = self.spec.gears, self.spec.limits.gear_gap
        for teeth in range(idler + 1, GREATEST_IDLER + 1):
            try:
                linkage = self.linkage_of(teeth)
            except NoSolution:
                continue
            train = GearTrain(gears.crank, teeth, gears.output)
            if gear_gap(linkage, train, gears.transverse_module, self._addendum) >= limit:
                return teeth
        return None


class FamilyTask(Task):
    """A task that the family I = 1 meets in closed form: equal gears 1 and 5, equal coupler and rocker (thesis 4.1).

    Gears of any size, and equal ones with a given crank or frame, have one bracketed root instead: `in_family`.
    """

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """The linkage of a family in one unknown that meets the task."""
        raise NotImplementedError

    def crank_angle_for(self, i3: float) -> float | None:
        """phi12 [rad] of the back-step that meets the task with a ratio i3; None: the output does not dwell."""
        raise NotImplementedError

    def frame_ratio_for(self, i3: float) -> float:
        """Frame over crank that meets the task with a ratio i3: of the back-step by thesis (4-18)."""
        return symmetric.frame_ratio_for_back_step(i3, self.crank_angle_at(i3) or 0.0)

    @cached_property
    def crank_angle_at(self) -> Callable[[float], float | None]:
        """`crank_angle_for`, solved once for each i3."""
        return cache(self.crank_angle_for)

    @cached_property
    def frame_ratio_at(self) -> Callable[[float], float]:
        """`frame_ratio_for`, solved once for each i3."""
        return cache(self.frame_ratio_for)

    @cached_property
    def general(self) -> bool:
        """Whether the closed forms of the symmetric family do not serve the task."""
        section, gears = getattr(self.spec, self.section), self.spec.gears
        if section is None:
            return False
        if section.balanced and gears.crank == gears.output > 0:
            return False  # equal gears are balanced by the symmetric family
        return bool(section.crank or section.frame or section.balanced)

    def family(self, idler: float) -> Family:
        """The linkages with the crank, the frame or the balance that the section asks for."""
        from gearlink.core.machines.three_gear import families

        section, radii = getattr(self.spec, self.section), self.radii(idler)
        if momentary.is_internal(*radii):
            with at_key("gears.output" if radii[0] > 0.0 else "gears.crank"):
                momentary.shape(*radii)  # a train that never just stops is refused whatever the links
        for given, made in (("crank", families.with_crank), ("frame", families.with_frame)):
            length, key = getattr(section, given), f"{self.section}.{given}"
            if length is not None:
                with at_key(key):
                    return replace(made(*radii, length, self.spec.assembly), key=key)
        return families.balanced(*radii, self.spec.assembly)

    def require_gears(self) -> None:
        """Equal external ones, where the closed forms are to serve."""
        gears = self.spec.gears
        if self.general:
            return
        if gears.crank < 0:
            teeth = -gears.crank if gears.output < 0 else gears.output
            raise NoSolution(
                f"this synthesis applies to external gears on crank and output: {gears.crank} teeth are a ring",
                key="gears.crank",
                fix=f"set gears.crank and gears.output to {teeth}",
            )
        if gears.crank != gears.output:
            raise NoSolution(
                f"this synthesis applies to the family I = 1: crank ({gears.crank}) and output ({gears.output}) "
                "teeth must be equal",
                key="gears.output",
                fix=f"set gears.output to {gears.crank}, or give {self.section}.crank, frame or balanced as well",
            )

    def depends_on_idler(self, refusal: NoSolution) -> bool:
        """Unequal gears and a ring on the crank are wrong with every idler."""
        return refusal.key not in ("gears.output", "gears.crank")

    def linkage_of(self, idler: int) -> FourBar:
        """Links of the family for an idler."""
        gears = self.spec.gears
        if self.general:
            return self.in_family(self.family(idler), GearTrain(gears.crank, idler, gears.output))
        self.require_gears()
        ratio = self.frame_ratio_at(-idler / gears.output)
        length = gears.transverse_module * (gears.crank + idler) / 2.0
        return symmetric.symmetric_linkage(ratio, length, self.spec.assembly)

    def output(self, linkage: FourBar, train: GearTrain) -> Output:
        """In closed form in the symmetric family."""
        if self.general:
            return super().output(linkage, train)
        return symmetric.SymmetricOutput(linkage, train, self.frame_ratio_at(train.i3), self.crank_angle_at(train.i3))


# The choice of the idler


def smallest_idler(
    design: Callable[[int], FourBar],
    crank_teeth: int,
    output_teeth: int,
    module: float,
    *,
    min_transmission_angle: float,
    min_gear_gap: float,
    addendum: float = 1.0,
    clear: Callable[[FourBar, int], bool] | None = None,
) -> int:
    """Smallest idler from 17 to 400 teeth whose design keeps transmission angle and gear gap, and clears the shafts.

    mu_min >= limit  and  s15 >= limit

    Parameters
        design : function - gives the linkage of an idler's teeth, or raises NoSolution where there is none
        crank_teeth, output_teeth : int - z1, z5
        module : float [mm]
        min_transmission_angle : float [rad] - limit of mu_min
        min_gear_gap : float [mm] - limit of the gap between the tips of gears 1 and 5
        addendum : float - h_a*
        clear : function of linkage and idler - whether no gear reaches a shaft; where no idler does, shafts do not
            count: only more teeth on crank and output gear, or thinner shafts, help there
    Raises
        NoSolution - with key `gears.idler` where no idler keeps both limits: which one stands in the way and what is
            reached at best; where no idler gives a design at all, the refusal of the last one as it came
    Notes
        Closed forms and no search over the revolution: all 384 idlers cost about 5 ms.
    Example
        >>> from gearlink.core.machines.three_gear.momentary import momentary_linkage
        >>> smallest_idler(lambda z: momentary_linkage(25.0, 1.25 * z, 75.0, 16.0), 20, 60, 2.5,
        ...                min_transmission_angle=math.radians(40.0), min_gear_gap=0.0)
        19

    Source
        thesis 4.1.4: i3 is chosen for transmission angle and collision of gears 1 and 5
    """
    reached: list[tuple[int, float, float]] = []
    refusal: NoSolution | None = None
    beside = 0
    greatest = _greatest_idler(crank_teeth, output_teeth)
    if greatest < LEAST_IDLER:
        ring, key = (crank_teeth, "gears.crank") if crank_teeth < 0 else (output_teeth, "gears.output")
        least = LEAST_IDLER + _RING_DIFFERENCE
        raise NoSolution(f"no idler fits into a ring of {-ring} teeth: it needs {least} or more", key=key)
    for idler in range(LEAST_IDLER, greatest + 1):
        try:
            linkage = design(idler)
        except NoSolution as error:
            refusal = error
            continue
        angle = linkage.min_transmission_angle()
        train = GearTrain(crank_teeth, idler, output_teeth)
        # a ring stands in a plane of its own
        gap = math.inf if train.internal else gear_gap(linkage, train, module, addendum)
        if angle >= min_transmission_angle and gap >= min_gear_gap:
            if clear is None or clear(linkage, idler):
                return idler
            beside = beside or idler
        reached.append((idler, angle, gap))
    if beside:
        return beside
    if refusal is not None and not reached:
        raise refusal
    text, fix = _obstacle(reached, min_transmission_angle, min_gear_gap)
    raise NoSolution(text, key="gears.idler", fix=fix)


def _greatest_idler(crank_teeth: int, output_teeth: int) -> int:
    """400 teeth, or so many that the tips of a ring of 20 deg pressure angle do not foul them: 8 less than its own."""
    rings = [-teeth for teeth in (crank_teeth, output_teeth) if teeth < 0]
    return min([GREATEST_IDLER, *(ring - _RING_DIFFERENCE for ring in rings)])


def _obstacle(reached: list[tuple[int, float, float]], angle_limit: float, gap_limit: float) -> tuple[str, str]:
    """Which limit keeps every idler out, with the best value reached and where; and what to change."""
    best_angle = max(reached, key=lambda row: row[1])
    best_gap = max(reached, key=lambda row: row[2])
    head = f"no idler from {LEAST_IDLER} to {GREATEST_IDLER} teeth keeps the limits: "
    asked_angle = f"(limit >= {math.degrees(angle_limit):g} deg)"
    if best_gap[2] < gap_limit:
        gap = f"gap of crank and output gear at most {safely_below(best_gap[2])} mm, idler {best_gap[0]}"
        return f"{head}{gap} (limit >= {gap_limit:g} mm)", "change the crank and output teeth or the task"
    angles = "transmission angle at most "
    if best_angle[1] >= angle_limit:
        angles = f"with the gear gap {angles}"
        best_angle = max((row for row in reached if row[2] >= gap_limit), key=lambda row: row[1])
    best = safely_below(math.degrees(best_angle[1]))
    return f"{head}{angles}{best} deg, idler {best_angle[0]} {asked_angle}", f"set limits.transmission_angle to {best}"


# Candidates side by side

_SHARES = (1.0, 1.1, 1.25, 1.5, 1.75, 2.0)
"""Teeth of the idlers that are shown, over those of the first."""

_COLUMNS = {
    "module": "mm",
    "idler_teeth": "1",
    "findings": "1",
    "length": "mm",
    "crank_length": "mm",
    "frame_length": "mm",
    "dwell": "deg",
    "back_step": "deg",
    "speed_ratio_max": "1",
    "acceleration_ratio_max": "1",
    "transmission_angle": "deg",
    "gear_gap": "mm",
}


def candidates_table(design: ThreeGearFourBar, _samples: int | None = None) -> Table:
    """The task met by six idlers in each of three modules; where there is no mechanism the row says why.

    Rows: modules as the file has it and the next of ISO 54 to either side; idlers from the one that the file names, or
    from the smallest that keeps the limits, up to twice its teeth. `length` is what gears 1 and 5 cover along the line
    AD, `dwell` the window within the tolerance, or where no tolerance is asked for phi13.
    """
    from gearlink.core.base.candidates import modules

    rows = [_row(design, module, idler) for module in modules(design.spec.gears.module) for idler in _idlers(design)]
    return Table.of("candidates", {name: ([row.get(name) for row in rows], unit) for name, unit in _COLUMNS.items()})


def _idlers(design: ThreeGearFourBar) -> list[int]:
    first = design.spec.gears.idler or _smallest(design)
    return sorted({min(GREATEST_IDLER, math.ceil(first * share)) for share in _SHARES})


def _smallest(design: ThreeGearFourBar) -> int:
    try:
        return design.idler_teeth
    except NoSolution as refused:
        if refused.key != "gears.idler":
            raise
        return LEAST_IDLER


def _row(design: ThreeGearFourBar, module: float, idler: int) -> dict[str, Any]:
    """One candidate; a mechanism that does not exist has its reason among the findings."""
    row: dict[str, Any] = {"module": module, "idler_teeth": idler}
    spec = changed(design.spec, (("gears.module", module), ("gears.idler", idler), ("gears.i3", None)))
    if spec is None:
        return row | {"findings": "refused"}
    trial = type(design)(spec)
    trial.advises = False
    try:
        return row | _found(trial)
    except NoSolution as refused:
        return row | {"findings": f"{refused.code} {refused.key}"}


def _found(trial: ThreeGearFourBar) -> dict[str, Any]:
    from gearlink.core.base.candidates import findings

    radii = (trial.spec.gears.transverse_module * abs(teeth) / 2.0 for teeth in (trial.crank_teeth, trial.output_teeth))
    dwell = trial.tolerance_dwell_angle if _within_a_tolerance(trial) else trial.dwell_angle
    command = next(name for name in trial.outlines if name.startswith("synth"))
    return {
        "length": trial.crank_length + trial.frame_length + sum(radii) + trial.tip_excess,
        "crank_length": trial.crank_length,
        "frame_length": trial.frame_length,
        "dwell": None if dwell is None else math.degrees(dwell),
        "back_step": None if trial.back_step_angle is None else math.degrees(trial.back_step_angle),
        "speed_ratio_max": trial.speed_ratio_max,
        "acceleration_ratio_max": trial.acceleration_ratio_max,
        "transmission_angle": math.degrees(trial.min_transmission_angle),
        "gear_gap": trial.gear_gap,
        "findings": findings(trial, command),
    }


def _within_a_tolerance(trial: ThreeGearFourBar) -> bool:
    request = trial.spec.dwell
    return trial.spec.dwell_tolerance is not None or (request is not None and request.angle is None)


# Back-step


class BackStepTask(FamilyTask):
    """A back-step of the output, the crank angle phi12 that it takes, or both."""

    section, keys = "back_step", "angle, crank_angle (deg)"

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """One of back-step and crank angle, met by the root of the one unknown."""
        from gearlink.core.machines.three_gear.families import back_step_crank_angle_of, back_step_of, solved

        task = self.request
        if task.angle is not None and task.crank_angle is not None:
            raise NoSolution(
                "with crank, frame or balanced one of angle and crank_angle can be met",
                key="back_step.crank_angle",
                fix="omit the other",
            )
        if task.angle is not None:
            with at_key("back_step.angle"):
                request = f"a back-step of {task.angle:g} deg"
                return solved(family, back_step_of(train), math.radians(task.angle), request, key="back_step.angle")
        with at_key("back_step.crank_angle"):
            request = f"a back-step over {task.crank_angle:g} deg of the crank"
            measure, target = back_step_crank_angle_of(train), math.radians(task.crank_angle)
            return solved(family, measure, target, request, key="back_step.crank_angle")

    def chosen_idler(self, *, advises: bool = True) -> int:
        """From angle and crank angle by thesis (4-19), rounded to teeth; else the smallest that keeps the limits."""
        task = self.request
        if self.general or task.angle is None or task.crank_angle is None:
            return super().chosen_idler(advises=advises)
        if task.crank_angle == 0.0:
            words = "the output does not step back over a crank angle of 0"
            raise NoSolution(words, key="back_step.crank_angle", fix="omit crank_angle, or give one above 0")
        output, over = self.spec.gears.output, math.radians(task.crank_angle)
        with at_key("back_step.angle"):
            i3 = symmetric.i3_for_back_step(math.radians(task.angle), over)
            if -i3 * output < 0.5:
                least = math.degrees(symmetric.back_step_angle(-1.0 / output, over))
                raise NoSolution(
                    f"back-step within {short(task.crank_angle)} deg of the crank: {unlike(task.angle, least)} deg "
                    f"(limit >= {unlike(least, task.angle)} deg, that of an idler of one tooth)",
                    fix=f"set back_step.angle to at least {safely_above(least, 3)} deg, or reduce its crank_angle",
                )
        return idler_for_ratio(i3, output)

    def crank_angle_for(self, i3: float) -> float:
        """phi12 as given, or from the back-step."""
        task = self.request
        if task.crank_angle is not None:
            return math.radians(task.crank_angle)
        with at_key("back_step.angle"):
            return symmetric.crank_angle_for_back_step(i3, math.radians(task.angle))


class BackStepSynthesis(ThreeGearFourBar):
    """`synth back-step`: back-step of the output, crank angle phi12, or both are given."""

    keys = dict.fromkeys(
        ("synth back-step", "analyze"),
        (
            ("back_step_angle", "back_step.angle"),
            ("back_step_crank_angle", "back_step.crank_angle"),
            "dwell_angle",
            "idler_teeth",
            "crank_length",
            "frame_length",
            ("min_transmission_angle", ">limits.transmission_angle"),
            ("gear_gap", ">limits.gear_gap"),
            "output_acceleration_max",
            "feed_per_turn",
            "speed_ratio_max",
            "acceleration_ratio_max",
        ),
    )
    outlines = with_analysis("synth back-step", Outline(QUANTITIES, ("back-step-target", *CHECKS)))
    extra_tables, table_candidates = TABLES, candidates_table

    @cached_property
    def task(self) -> BackStepTask:
        """The section back_step."""
        return BackStepTask(self.spec)

    def check_back_step_target(self) -> Iterator[Check]:
        """GL304 where the file asks for a back-step besides the crank angle."""
        asked = self.task.request.angle
        if asked is None:
            return
        got = math.degrees(self.back_step_angle or 0.0)
        fix = "remove gears.idler or back_step.crank_angle, so that it is chosen to fit"
        yield target_judged(got, asked).check("back-step", fix)


# Variable speed


class SpeedTask(FamilyTask):
    """The minimum and the maximum speed of the output."""

    section, keys = "speed", "min, max (1/min)"

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """W_min/W_max = min/max, met by the root of the one unknown."""
        if self.request.uniform_angle is not None:
            message = "uniform_angle applies only to equal crank and output gears\nset gears.output to gears.crank"
            raise NoSolution(message, key="gears.output")
        from gearlink.core.machines.three_gear.families import with_speed_quotient

        speed = self.request
        with at_key("speed.max" if speed.max <= speed.min else "speed.min"):
            if speed.max <= speed.min:
                raise NoSolution(f"max ({speed.max:g}) must be greater than min ({speed.min:g})")
            return with_speed_quotient(family, train, speed.min / speed.max, speed.max)

    def frame_ratio_for(self, i3: float) -> float:
        """Thesis (4-20); for an even stretch the minimum frame that has it."""
        speed = self.request
        if speed.uniform_angle is not None:
            from gearlink.core.machines.three_gear.families import frame_ratio_for_window

            mu = math.radians(self.spec.limits.transmission_angle)
            with at_key("speed.uniform_angle"):
                return frame_ratio_for_window(math.radians(speed.uniform_angle), speed.uniform_tolerance, 1.0 - i3, mu)
        with at_key("speed.max" if speed.max <= speed.min else "speed.min"):
            return symmetric.frame_ratio_for_speed_band(i3, speed.min, speed.max)

    def crank_angle_for(self, i3: float) -> float | None:  # noqa: ARG002 - whatever the gears
        """The output just stops where the minimum speed is zero."""
        if self.request.uniform_angle is not None:
            return None
        return 0.0 if self.request.min == 0.0 else None

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """A wrong band is wrong with every idler."""
        return False


class VariableSpeedSynthesis(ThreeGearFourBar):
    """`synth variable-speed`: the output speed swings between two values, the input turns at their mean."""

    keys = dict.fromkeys(
        ("synth variable-speed", "analyze"),
        (
            ("speed_ratio_min", ".asked_ratio_min"),
            ("speed_ratio_max", ".asked_ratio_max"),
            "nonuniformity",
            "input_speed",
            "idler_teeth",
            "crank_length",
            "frame_length",
            ("min_transmission_angle", ">limits.transmission_angle"),
            ("gear_gap", ">limits.gear_gap"),
            "output_acceleration_max",
        ),
    )
    outlines = with_analysis("synth variable-speed", Outline(QUANTITIES, CHECKS))
    extra_tables, table_candidates = TABLES, candidates_table

    @cached_property
    def task(self) -> SpeedTask:
        """The section speed."""
        return SpeedTask(self.spec)

    @property
    def uniform_tolerance(self) -> float | None:
        """That of the task, or of the file."""
        return self.task.request.uniform_tolerance or self.spec.uniform_tolerance

    @property
    def input_speed(self) -> float | None:
        """Input speed [1/min] at which the output swings between the two: their mean where I = 1."""
        speed = self.task.request
        if speed.uniform_angle is not None:
            return self.spec.input_speed
        greatest = self.speed_ratio_max if self.mean_ratio > 0.0 else -self.speed_ratio_min
        found = float(speed.max) / greatest if self.task.general else 0.5 * (speed.min + speed.max)
        if wrong := other_speed(self.spec.input_speed, found):
            raise NoSolution(wrong, key="input_speed")
        return found

    @property
    def asked_ratio_min(self) -> float | None:
        """The minimum output speed that is asked for, per input speed; None of an even stretch."""
        return self._asked(self.task.request.min)

    @property
    def asked_ratio_max(self) -> float | None:
        """The maximum output speed that is asked for, per input speed; None of an even stretch."""
        return self._asked(self.task.request.max)

    def _asked(self, speed: float | None) -> float | None:
        return None if speed is None or self.input_speed is None else float(speed) / self.input_speed

    def completion(self) -> Iterator[Found]:
        """The input speed besides the links."""
        yield from super().completion()
        if self.task.request.uniform_angle is not None:
            yield Found(
                "uniform_tolerance", self.task.request.uniform_tolerance, "specification for synth variable-speed"
            )
            return
        yield Found("input_speed", self.input_speed, "found by synth variable-speed")


# Momentary dwell

_STEPS = (
    "quartic_k",
    "quartic_l",
    "quartic_m",
    "base_angle",
    "pole_angle",
    "segment_af",
    "segment_fe",
    "segment_eg",
    "segment_gd",
)


class MomentaryTask(Task):
    """An output that stops just once a revolution: any three gears and one length are given, the other is sought."""

    section, keys = "momentary", "eccentricity, frame or gap (mm), or balanced"

    def linkage_of(self, idler: int) -> FourBar:
        """Frame length in closed form, instead of thesis (4-26)..(4-33)."""
        crank, radii = self._crank_of(idler), self.radii(idler)
        with at_key("momentary.eccentricity"):
            if momentary.is_internal(*radii):
                from gearlink.core.machines.three_gear.families import momentary_ring_linkage

                return momentary_ring_linkage(*radii, crank, self.spec.assembly)
            return momentary.momentary_linkage(*radii, crank, self.spec.assembly)

    def _crank_of(self, idler: int) -> float:
        """Crank length as given, or from the frame, the gap or the balance that is."""
        request, radii = self.request, self.radii(idler)
        if request.eccentricity is not None:
            return float(request.eccentricity)
        if request.frame is not None:
            with at_key("momentary.frame"):
                return momentary.eccentricity_for_frame(*radii, request.frame)
        if request.gap is None:
            with at_key("momentary.balanced"):
                return momentary.balanced_eccentricity(*radii)
        if momentary.is_internal(*radii):
            raise NoSolution(
                "a ring gear is in another plane than gear 1, with no gap between them",
                key="momentary.gap",
                fix="give eccentricity, frame or balanced",
            )
        tips = tip_excess(self.spec.gears)
        crank = momentary.crank_with_room(*radii, radii[0] + radii[2] + tips + request.gap)
        if crank is None:
            widest = radii[1] * 2.0 - 2.0 * momentary.least_eccentricity(*radii) - tips  # of the shortest crank
            raise NoSolution(
                f"a momentary dwell of these gears has no gap of {request.gap:g} mm between gears 1 and 5",
                key="momentary.gap",
                fix=f"set momentary.gap below {safely_below(widest)} mm",
            )
        return crank

    def output(self, linkage: FourBar, train: GearTrain) -> Output:
        """The one standstill at full precision."""
        radii = self.radii(train.idler)
        if momentary.is_internal(*radii):
            return super().output(linkage, train)
        place = momentary.momentary_crank_angle(*radii, linkage.crank, linkage.assembly)
        return Output(linkage, train, [place])

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """A crank not below the radius of gear 1 is too long with every idler."""
        crank = self.request.eccentricity
        return crank is None or crank < self.radii(LEAST_IDLER)[0]


class MomentaryDwellSynthesis(ThreeGearFourBar):
    """`synth momentary-dwell`: any three gears and one length are given, the other is sought."""

    keys = dict.fromkeys(
        ("synth momentary-dwell", "analyze"),
        (
            "motion",
            "dwell_crank_angles",
            ("crank_length", "momentary.eccentricity"),
            ("frame_length", "momentary.frame"),
            "idler_teeth",
            ("min_transmission_angle", ">limits.transmission_angle"),
            ("gear_gap", "momentary.gap", ">limits.gear_gap"),
            "mean_ratio",
            "speed_ratio_max",
            "output_acceleration_max",
            "acceleration_ratio_max",
        ),
    )
    outlines = with_analysis("synth momentary-dwell", Outline((*QUANTITIES, *_STEPS, "dwell_pole_line_error"), CHECKS))
    extra_tables, table_candidates = TABLES, candidates_table

    @cached_property
    def task(self) -> MomentaryTask:
        """The section momentary."""
        return MomentaryTask(self.spec)

    @cached_property
    def steps(self) -> momentary.Intermediates | None:
        """The thesis's steps to the frame; it knows no rings."""
        radii = self.task.radii(self.idler_teeth)
        return None if self.train.internal else momentary.intermediates(*radii, self.linkage.crank)

    quartic_k: float | None = placed("steps.k")
    quartic_l: float | None = placed("steps.l")
    quartic_m: float | None = placed("steps.m")
    base_angle: float | None = placed("steps.beta")
    pole_angle: float | None = placed("steps.alpha")
    segment_af: float | None = placed("steps.af")
    segment_fe: float | None = placed("steps.fe")
    segment_eg: float | None = placed("steps.eg")
    segment_gd: float | None = placed("steps.gd")

    def _gap_remedy(self, missing: float) -> str:
        words, request = super()._gap_remedy(missing), self.task.request
        if request.gap is not None:
            return f"set momentary.gap to at least {self.spec.limits.gear_gap:g} mm"
        if request.eccentricity is None or self._longest_crank_with_room() is None:
            return words
        return f"shorten momentary.eccentricity, or {words}"

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """The longest crank with which the gears have room."""
        given = self.spec.momentary is not None and self.spec.momentary.eccentricity is not None
        shorter = self._longest_crank_with_room() if check == "gear-collision" and given else None
        return () if shorter is None else ((("momentary.eccentricity", at_most(shorter)),),)
