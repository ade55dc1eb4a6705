"""The three-gear four-bar over arrays of designs: `core.design_axis` for the syntheses of equal gears in closed form.

Mirrors `DwellSynthesis` (an angle phi13), `BackStepSynthesis` and `VariableSpeedSynthesis`. Whatever a study asks for
beside that is left to the design classes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.clearance.bodies import LEAST_SHAFT_MODULES
from gearlink.core.design_axis import Evaluated, Findings
from gearlink.core.gears.unshifted import Mesh, UnshiftedMeshes
from gearlink.core.linkages.codes import GEAR_COLLISION, SHAFT_CLEARANCE, TRANSMISSION_ANGLE
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.spec_paths import number_at
from gearlink.core.three_gear import symmetric_many as many
from gearlink.core.three_gear.codes import ACHIEVED, BACK_STEP, DWELL_TOLERANCE
from gearlink.core.three_gear.motion import tip_radius
from gearlink.core.three_gear.names import MESHES

_TEETH = ("gears.crank", "gears.idler", "gears.output")
_LIMITS = ("limits.transmission_angle", "limits.gear_gap")
_PLAIN_TOLERANCE, _MISSED = 1.0, 0.5
_POOR = 5.0
_NEAR = 1e-9
_SMALL, _STEEP = 1e-3, 1e-4
_JUDGED_HERE = {r.code for r in (GEAR_COLLISION, SHAFT_CLEARANCE, TRANSMISSION_ANGLE, BACK_STEP, DWELL_TOLERANCE)}
_TASKS = {
    "synth dwell": ("dwell", ("dwell.angle",)),
    "synth back-step": ("back_step", ("back_step.angle", "back_step.crank_angle")),
    "synth variable-speed": ("speed", ("speed.min", "speed.max")),
}
_OTHERS = {"dwell": ("window", "tolerance", "margin"), "back_step": (), "speed": ()}


def axis(spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str]) -> ThreeGearAxis | None:
    """The array form of a study of three-gear four-bars; None where the design classes have to serve.

    Parameters
        spec, command, paths, quantities : as of `core.design_axis.Maker`
    """
    if command not in _TASKS or not _served(spec, command, paths):
        return None
    made = ThreeGearAxis(spec, command, tuple(quantities))
    names = {name for name in quantities if name.rpartition(".")[0] not in MESHES}
    one = _Batch(made, {path: np.array([_base(spec, path)]) for path in made.keys})
    meshes = (name for name in quantities if name not in names)
    served = names <= one.plain.keys() and all(one.mesh_quantity(name) is not None for name in meshes)
    return made if served else None


def _served(spec: Any, command: str, paths: Sequence[str]) -> bool:
    """Whether the array form knows all keys that are varied, and none of the base asks for more."""
    task, keys = _TASKS[command]
    section = getattr(spec, task)
    known = (*_TEETH, "gears.module", *keys, *_LIMITS)
    if section is None or spec.gears.i3 is not None or spec.shafts is not None:
        return False
    if any(getattr(spec, name) is not None for name in ("dwell_tolerance", "dwell_backlash", "input_speed")):
        return False
    extra = ("crank", "frame", "balanced", *_OTHERS[task])
    if any(getattr(section, name) is not None for name in extra):
        return False
    given = {path for path in known if path in paths or _base(spec, path) is not None}
    return set(paths) <= set(known) and {*_TEETH, "gears.module"} <= given


def _base(spec: Any, path: str) -> float | None:
    return number_at(spec, path)


@dataclass(frozen=True)
class ThreeGearAxis:
    """The array form; made by `axis`."""

    spec: Any
    command: str
    wanted: tuple[str, ...]

    @cached_property
    def keys(self) -> tuple[str, ...]:
        """Keys that the form reads, where the base has them or a study varies them."""
        return (*_TEETH, "gears.module", *_TASKS[self.command][1], *_LIMITS)

    @cached_property
    def meshes(self) -> UnshiftedMeshes:
        """Meshes of the base's pressure angle."""
        return UnshiftedMeshes(math.radians(self.spec.gears.pressure_angle), self.spec.limits)

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """As `core.design_axis.Axis`."""
        with np.errstate(all="ignore"):
            return _Batch(self, columns).evaluated()


class _Batch:
    """Some designs; every result is an array, made when it is asked for."""

    def __init__(self, axis: ThreeGearAxis, columns: Mapping[str, Reals]) -> None:
        self._axis, self._columns = axis, columns
        self.count = len(next(iter(columns.values())))
        self.z1, self.z3, self.z5 = (self.key(path) for path in _TEETH)
        self.module = self.key("gears.module")

    def key(self, path: str) -> Reals:
        """A key's values; NaN where the base has none and it is not varied."""
        if path in self._columns:
            return np.asarray(self._columns[path], dtype=float)
        value = _base(self._axis.spec, path)
        return np.full(self.count, np.nan if value is None else value)

    # The task

    @cached_property
    def n(self) -> Reals:
        """1 - i3."""
        return 1.0 + self.z3 / self.z5

    @cached_property
    def _reason(self) -> Any:
        """0, or 1 + the place in `reasons` that a design is refused for; what the class refuses first counts."""
        unequal = self.z1 != self.z5
        return np.where(unequal, 1, np.where(self._possible, 0, 1 + self._impossible))

    @property
    def reasons(self) -> tuple[str, ...]:
        """Keys that designs are refused for."""
        keys = {"synth dwell": ("dwell.angle",), "synth back-step": ("back_step.angle",)}
        return ("gears.output", *keys.get(self._axis.command, ("speed.max", "speed.min")))

    @cached_property
    def _possible(self) -> Mask:
        """Where equal gears meet the task."""
        if self._axis.command == "synth dwell":
            return many.in_range(self._asked, 0.0, 2.0 * math.pi * self.n / (self.n + 1.0))
        if self._axis.command == "synth back-step":
            by_crank = np.isfinite(self.key("back_step.crank_angle"))
            return by_crank | many.in_range(self._asked, 0.0, math.pi * (self.n - 1.0))
        low, high = self.key("speed.min"), self.key("speed.max")
        return np.asarray((low >= 0.0) & (low < high))

    @property
    def _impossible(self) -> Any:
        """Place among the reasons of a task that cannot be met."""
        if self._axis.command != "synth variable-speed":
            return 1
        return np.where(self.key("speed.max") <= self.key("speed.min"), 1, 2)

    @cached_property
    def _asked(self) -> Reals:
        """The angle that is asked for [rad]."""
        return np.radians(self.key("dwell.angle" if self._axis.command == "synth dwell" else "back_step.angle"))

    @cached_property
    def _exists(self) -> Mask:
        return np.asarray(self._reason == 0)

    @cached_property
    def h(self) -> Reals:
        """Half of phi12 [rad]; NaN where the output has no back-step or standstill."""
        h, good = np.full(self.count, np.nan), self._exists
        n, asked = self.n[good], self._asked[good]
        if self._axis.command == "synth dwell":
            h[good] = many.half_angle_for_dwell(n, asked)
        elif self._axis.command == "synth back-step":
            by_crank = np.radians(self.key("back_step.crank_angle")) / 2.0
            h[good] = by_crank[good]
            sought = np.flatnonzero(good & np.isnan(by_crank))
            if sought.size:
                h[sought] = many.half_angle_for_back_step(self.n[sought], self._asked[sought])
        else:
            h[good & (self.key("speed.min") == 0.0)] = 0.0
        return h

    @cached_property
    def frame_ratio(self) -> Reals:
        """d."""
        if self._axis.command != "synth variable-speed":
            return many.frame_ratio(self.n, self.h)
        d = many.frame_ratio_for_speeds(self.n, self.key("speed.min"), self.key("speed.max"))
        return np.where(self._exists, d, np.nan)

    # Lengths and motion, [mm, rad]

    @cached_property
    def coupler(self) -> Reals:
        """Centre distance of gears 1 and 3."""
        return self.module * (self.z1 + self.z3) / 2.0

    @cached_property
    def crank(self) -> Reals:
        """AB (thesis (4-10))."""
        return np.asarray(self.coupler / np.sqrt(0.5 * (1.0 + self.frame_ratio * self.frame_ratio)))

    @cached_property
    def frame(self) -> Reals:
        """AD."""
        return self.frame_ratio * self.crank

    @cached_property
    def _swing(self) -> Reals:
        """Half of the speed's swing (thesis (4-13))."""
        return 2.0 * self.n * self.frame_ratio / (self.frame_ratio * self.frame_ratio + 1.0)

    @cached_property
    def _mu(self) -> Reals:
        """Least transmission angle: the triangle BCD is isosceles."""
        b, apart, stretched = self.coupler, self.frame - self.crank, self.frame + self.crank
        at_0 = np.arctan2(apart, np.sqrt((2.0 * b - apart) * (2.0 * b + apart)))
        at_pi = np.arctan2(stretched, np.sqrt((2.0 * b - stretched) * (2.0 * b + stretched)))
        # Each is half of gamma; an obtuse gamma counts from the other side.
        return np.minimum(_acute(2.0 * at_0), _acute(2.0 * at_pi))

    @cached_property
    def _steps_back(self) -> Mask:
        return np.asarray(self.h > 0.0)

    @cached_property
    def back_step(self) -> Reals:
        """Back-step of the output."""
        return np.where(self._steps_back, many.back_step(self.n, self.h), np.nan)

    @cached_property
    def dwell_angle(self) -> Reals:
        """phi13: as asked for, or from its equation."""
        if self._axis.command == "synth dwell":
            return np.where(self._exists, self._asked, np.nan)
        angle, places = np.full(self.count, np.nan), np.flatnonzero(self._steps_back)
        if places.size:
            angle[places] = many.dwell_angle(self.n[places], self.h[places])
        return angle

    @cached_property
    def gap(self) -> Reals:
        """Gap between the tips of gears 1 and 5."""
        tips = tip_radius(self.z1, self.module) + tip_radius(self.z5, self.module)  # type: ignore[arg-type]
        return np.abs(self.frame - self.crank) - tips

    def _standstill(self, side: float) -> Reals:
        """Crank angle of a standstill, before (-1) or after (1) the least speed."""
        middle = 1.5 * math.pi if self._axis.spec.assembly == 1 else 0.5 * math.pi
        exists = self._steps_back if side > 0.0 else np.isfinite(self.h)
        return np.where(exists, middle + side * self.h, np.nan)

    @cached_property
    def plain(self) -> dict[str, Callable[[], Any]]:
        """The quantities that this form has but for those of meshes, in the units of design files."""
        degrees = np.degrees
        return {
            "i3": lambda: -self.z3 / self.z5,
            "crank_teeth": lambda: self.z1,
            "idler_teeth": lambda: self.z3,
            "output_teeth": lambda: self.z5,
            "frame_ratio": lambda: self.frame_ratio,
            "crank_length": lambda: self.crank,
            "coupler_length": lambda: self.coupler,
            "rocker_length": lambda: self.module * (self.z3 + self.z5) / 2.0,
            "frame_length": lambda: self.frame,
            "mean_ratio": lambda: self.z1 / self.z5,
            "speed_ratio_max": lambda: 1.0 + self._swing,
            "speed_ratio_min": lambda: 1.0 - self._swing,
            "nonuniformity": lambda: 2.0 * self._swing,
            "motion": self._motion,
            "dwell_crank_angles[0]": lambda: degrees(self._standstill(-1.0)),
            "dwell_crank_angles[1]": lambda: degrees(self._standstill(1.0)),
            "back_step_angle": lambda: degrees(self.back_step),
            "back_step_crank_angle": lambda: np.where(self._steps_back, degrees(2.0 * self.h), np.nan),
            "dwell_angle": lambda: degrees(self.dwell_angle),
            "dwell_angle_approximate": lambda: np.where(self._steps_back, degrees(3.0 * self.h), np.nan),
            "min_transmission_angle": lambda: degrees(self._mu),
            "gear_gap": lambda: self.gap,
        }

    def _motion(self) -> Any:
        words = np.where(self._steps_back, "back-step", np.where(self.h == 0.0, "momentary-dwell", "unidirectional"))
        return np.where(self._exists, words, "")

    # Meshes and checks

    @cached_property
    def _meshes(self) -> dict[str, Mesh]:
        make = self._axis.meshes.meshes
        return {
            "crank_idler": make(self.z1, self.z3, self.module),
            "idler_output": make(self.z3, self.z5, self.module),
        }

    def mesh_quantity(self, name: str) -> Any:
        """A quantity of a mesh by its whole name, in the units of design files; None where this form has it not."""
        mesh, _, plain = name.partition(".")
        value = self._meshes[mesh].quantity(plain)
        angle = plain.partition("[")[0] in ("working_pressure_angle", "tip_pressure_angle")
        return np.degrees(value) if angle and value is not None else value

    def findings(self) -> Iterator[Findings]:
        """Every finding of the command's checks."""
        limit, none = self.key("limits.gear_gap"), np.zeros(self.count, dtype=bool)
        yield Findings(GEAR_COLLISION.code, self.gap, limit, self.gap < limit, none, "mm")
        yield from self._shafts()
        mu, limit = np.degrees(self._mu), self.key("limits.transmission_angle")
        warns = (mu >= limit) & (mu < limit + _POOR)
        yield Findings(TRANSMISSION_ANGLE.code, mu, limit, mu < limit, warns, "deg")
        yield from self._of_task(none)
        for mesh in self._meshes.values():
            yield from mesh.findings()

    def _of_task(self, none: Mask) -> Iterator[Findings]:
        """GL315 and GL317 of a dwell angle, GL304 of a back-step that was asked for."""
        if self._axis.command == "synth dwell":
            half = np.degrees(0.5 * self.back_step)
            yield Findings(BACK_STEP.code, half, np.full(self.count, _PLAIN_TOLERANCE), none, half > 1.0, "deg")
            endless = np.degrees(math.pi * self.z1 / self.z5)
            yield Findings(DWELL_TOLERANCE.code, half, endless, half >= endless, none, "deg")
        elif self._axis.command == "synth back-step":
            asked, got = self.key("back_step.angle"), np.degrees(np.where(self.h == 0.0, 0.0, self.back_step))
            value = np.where(np.isnan(asked), np.nan, got)
            yield Findings(ACHIEVED.code, value, asked, none, np.abs(value - asked) > _MISSED, "deg")

    def _shafts(self) -> Iterator[Findings]:
        """GL302 for bare axes A and D: of gears that reach them, and of the two axes."""
        tips = [tip_radius(z, self.module) for z in (self.z1, self.z3, self.z5)]  # type: ignore[arg-type]
        given = self._axis.spec.limits.least_shaft
        least = LEAST_SHAFT_MODULES * self.module if given is None else np.full(self.count, given)
        none = np.zeros(self.count, dtype=bool)
        nearest_c = np.where(self.coupler - self.crank > 0.0, self.coupler - self.crank, np.nan)
        gaps = (
            (nearest_c - tips[1], least),
            (self.frame - tips[2], least),
            (np.abs(self.frame - self.crank) - tips[0], least),
            (self.module * (self.z3 + self.z5) / 2.0 - tips[1], least),
            (self.frame, 2.0 * least),
        )
        for gap, limit in gaps:
            yield Findings(SHAFT_CLEARANCE.code, gap, limit, none, gap < limit, "mm")

    def evaluated(self) -> Evaluated:
        """All that a study asks for."""
        gone = ~self._exists
        found = {}
        for name in self._axis.wanted:
            value = self.plain[name]() if name in self.plain else self.mesh_quantity(name)
            empty: Any = "" if value.dtype.kind == "U" else np.nan
            found[name] = np.where(gone, empty, value)
        findings = [_without(each, gone) for each in self.findings()]
        return Evaluated(found, findings, self._reason, self.reasons, self._unsure(findings))

    def _unsure(self, findings: Sequence[Findings]) -> Mask:
        """Designs next to a limit, or where a root hangs by few digits."""
        unsure = np.zeros(self.count, dtype=bool)
        for each in findings:
            scale = np.maximum(1.0, np.maximum(np.abs(each.value), np.abs(each.limit)))
            near = np.abs(each.value - each.limit) <= _NEAR * scale
            if each.code in _JUDGED_HERE:
                unsure |= near
        few = (self.h > 0.0) & ((self.h < _SMALL) | (self.h > 0.5 * math.pi - _STEEP))
        return np.asarray((unsure | few) & self._exists)


def _acute(angle: Reals) -> Reals:
    return np.minimum(angle, math.pi - angle)


def _without(each: Findings, gone: Mask) -> Findings:
    """A finding whose designs that do not exist neither fail nor warn."""
    if not gone.any():
        return each
    return Findings(each.code, each.value, each.limit, each.fails & ~gone, each.warns & ~gone, each.unit)
