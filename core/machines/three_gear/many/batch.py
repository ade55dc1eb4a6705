"""Three-gear four-bars over arrays, whatever their task: lengths, meshes, checks, and the quantities by name."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.design_axis import Evaluated, Findings
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.three_gear.codes import BACK_STEP, DWELL_TOLERANCE
from gearlink.core.machines.three_gear.dwell_checks import ratio_judged, tolerance_judged
from gearlink.core.machines.three_gear.many.band import Dwells, Valleys, longest_in_band
from gearlink.core.machines.three_gear.many.general import Drives
from gearlink.core.machines.three_gear.many.idler import Tried
from gearlink.core.machines.three_gear.motion import tip_radius
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.parts.gears.train.unshifted import Mesh, UnshiftedMeshes
from gearlink.core.parts.linkages.checks import transmission_judged, window_judged
from gearlink.core.parts.linkages.codes import (
    DWELL_EDGE,
    DWELL_WINDOW,
    GEAR_COLLISION,
    SHAFT_CLEARANCE,
    TRANSMISSION_ANGLE,
)
from gearlink.core.parts.linkages.fourbar.loop import make_reading
from gearlink.core.studies.clearance.bodies import FULL_HEIGHT, LEAST_SHAFT_MODULES
from gearlink.core.studies.clearance.checks import collision_judged, shaft_judged

TEETH = ("gears.crank", "gears.idler", "gears.output")
LIMITS = ("limits.transmission_angle", "limits.gear_gap", "dwell_tolerance", "dwell_window")
SHAFTS = ("shafts.input_radius", "shafts.output_radius")
_NEAR, _POORLY_NEAR = 1e-9, 1e-5
_JUDGED_HERE = {
    rule.code for rule in (GEAR_COLLISION, TRANSMISSION_ANGLE, BACK_STEP, DWELL_TOLERANCE, DWELL_WINDOW, DWELL_EDGE)
}


class Batch:
    """Some designs; every result is an array, made when it is asked for. A subclass finds the links of its task.

    Parameters
        spec, command : of the base design
        wanted : names of the quantities
        meshes : UnshiftedMeshes - of the base's pressure angle
        columns : (N,) arrays by path
    """

    keys: tuple[str, ...] = ()
    """Keys of the task."""
    given: tuple[str, ...] = ()
    """Links whose length the file gives: a gap of sums of such lengths is the class's to the last bit."""
    chooses_idler = True
    """Whether the task finds an idler that the file leaves out."""
    idlers_rise = False
    """Whether all idlers above one that keeps the limits keep them."""

    def __init__(
        self, spec: Any, command: str, wanted: Sequence[str], meshes: UnshiftedMeshes, columns: Mapping[str, Reals]
    ) -> None:
        self.spec, self.command, self.wanted = spec, command, wanted
        self._made, self._columns = meshes, columns
        self.count = len(next(iter(columns.values())))
        self.z1, self.z3, self.z5 = (self.key(path) for path in TEETH)
        self.module = self.key("gears.module")
        self._at_limit = np.zeros(self.count, dtype=bool)
        self.without_idler: Mask = np.zeros(self.count, dtype=bool)  # designs for which no idler keeps the limits

    def key(self, path: str) -> Reals:
        """A key's values; NaN where the base has none and it is not varied."""
        if path in self._columns:
            return np.asarray(self._columns[path], dtype=float)
        value = number_at(self.spec, path)
        return np.full(self.count, np.nan if value is None else value)

    # What a task gives, in mm and radians; NaN where there is none

    reasons: tuple[str, ...]
    """Keys that designs are refused for."""

    @property
    def reason(self) -> Any:
        """0, or 1 + the place in `reasons` that a design is refused for; what the class refuses first counts."""
        raise NotImplementedError

    @property
    def links(self) -> tuple[Reals, Reals]:
        """Crank AB and frame AD."""
        raise NotImplementedError

    @property
    def speeds(self) -> tuple[Reals, Reals]:
        """Greatest and least speed ratio."""
        raise NotImplementedError

    @property
    def places_of_speeds(self) -> tuple[Reals, Reals]:
        """Crank angles of the greatest and the least speed."""
        raise NotImplementedError

    @property
    def mu(self) -> Reals:
        """Least transmission angle."""
        raise NotImplementedError

    @property
    def standstills(self) -> tuple[Reals, Reals]:
        """Crank angles of the first and the second one."""
        raise NotImplementedError

    @property
    def back_step(self) -> tuple[Reals, Reals]:
        """Its size, and its crank angle phi12."""
        raise NotImplementedError

    @property
    def dwell_angle(self) -> Reals:
        """phi13."""
        raise NotImplementedError

    @property
    def doubtful(self) -> Mask:
        """Designs that the class shall compute."""
        raise NotImplementedError

    @property
    def links_are_doubtful(self) -> Mask:
        """Those among them whose links or transmission angle hang by few digits."""
        raise NotImplementedError

    def of_task(self) -> Iterator[Findings]:
        """Findings of the task's own checks."""
        yield from ()

    # What follows from it

    @property
    def wrong_with_every_idler(self) -> Mask:
        """Designs whose refusal no idler could avoid."""
        raise NotImplementedError

    @cached_property
    def refused(self) -> Any:
        """`reason`, or the place after the last of `reasons` where no idler serves."""
        if not self.without_idler.any():
            return self.reason
        own = (self.reason > 0) & self.wrong_with_every_idler
        return np.where(self.without_idler & ~own, len(self.reasons) + 1, self.reason)

    @cached_property
    def exists(self) -> Mask:
        """Designs that have a mechanism."""
        return np.asarray(self.refused == 0)

    def tried(self, *, shafts: bool) -> Tried:
        """What the choice of an idler asks for."""
        mu, gap = np.degrees(self.mu), self.gap
        angle, least = self.key("limits.transmission_angle"), self.key("limits.gear_gap")
        good = self.exists & (mu >= angle) & (gap >= least)
        within = np.where(self.links_are_doubtful, _POORLY_NEAR, _NEAR)
        close = self.exists & (_near(mu, angle, within) | _near(gap, least, within))
        clear = ~self.none
        for each in self._shafts() if shafts else ():
            clear &= ~each.fails
            close |= good & (each.limit == 0.0) & _near(each.value, each.limit)  # else of an axis without a shaft
        return Tried(good, clear, close)

    @cached_property
    def none(self) -> Mask:
        """No design."""
        return np.zeros(self.count, dtype=bool)

    @cached_property
    def coupler(self) -> Reals:
        """Centre distance of gears 1 and 3."""
        return self.module * (self.z1 + self.z3) / 2.0

    @cached_property
    def rocker(self) -> Reals:
        """Centre distance of gears 3 and 5."""
        return self.module * (self.z3 + self.z5) / 2.0

    @cached_property
    def mean_ratio(self) -> Reals:
        """Net output turns per crank turn."""
        return np.where(self.links[0] > self.links[1], 1.0, self.z1 / self.z5)

    @cached_property
    def gap(self) -> Reals:
        """Gap between the tips of gears 1 and 5."""
        crank, frame = self.links
        tips = tip_radius(self.z1, self.module) + tip_radius(self.z5, self.module)  # type: ignore[arg-type]
        return np.abs(frame - crank) - tips

    @property
    def plain(self) -> dict[str, Callable[[], Any]]:
        """The quantities that this form has but for those of meshes, in the units of design files.

        Not kept: each function knows the batch, and a batch that knew them would not be freed with its last user.
        """
        degrees = np.degrees
        return {
            "i3": lambda: -self.z3 / self.z5,
            "crank_teeth": lambda: self.z1,
            "idler_teeth": lambda: self.z3,
            "output_teeth": lambda: self.z5,
            "frame_ratio": lambda: self.links[1] / self.links[0],
            "crank_length": lambda: self.links[0],
            "coupler_length": lambda: self.coupler,
            "rocker_length": lambda: self.rocker,
            "frame_length": lambda: self.links[1],
            "mean_ratio": lambda: self.mean_ratio,
            "speed_ratio_max": lambda: self.speeds[0],
            "speed_ratio_min": lambda: self.speeds[1],
            "nonuniformity": lambda: (self.speeds[0] - self.speeds[1]) / self.mean_ratio,
            "motion": self._motion,
            "dwell_crank_angles[0]": lambda: degrees(self.standstills[0]),
            "dwell_crank_angles[1]": lambda: degrees(self.standstills[1]),
            "back_step_angle": lambda: degrees(self.back_step[0]),
            "back_step_crank_angle": lambda: degrees(self.back_step[1]),
            "dwell_angle": lambda: degrees(self.dwell_angle),
            "dwell_angle_approximate": lambda: degrees(1.5 * self.back_step[1]),
            "min_transmission_angle": lambda: degrees(self.mu),
            "gear_gap": lambda: self.gap,
            "tolerance_dwell_start": lambda: degrees(self.band[0]),
            "tolerance_dwell_angle": lambda: degrees(self.band[1]),
        }

    def _motion(self) -> Any:
        first, second = (np.isfinite(angle) for angle in self.standstills)
        words = np.where(second, "back-step", np.where(first, "momentary-dwell", "unidirectional"))
        return np.where(self.exists, words, "")

    # Within a tolerance

    @cached_property
    def drives(self) -> Drives:
        """The linkages with their gears."""
        crank, frame = self.links
        shares = (self.z1 / self.z5, -(self.z1 + self.z3) / self.z5, (self.z3 + self.z5) / self.z5)
        loop: tuple[Any, Any, Any, Any, Any] = (
            crank,
            self.coupler,
            self.rocker,
            frame,
            np.full(self.count, float(self.spec.assembly)),
        )
        return Drives(*make_reading(*loop, total=sum), *shares)

    @cached_property
    def seeks_band(self) -> bool:
        """Whether the dwell within a tolerance is asked for."""
        named = any(name.startswith("tolerance_dwell") for name in self.wanted)
        return named or (self.command == "analyze" and bool(np.isfinite(self.key("dwell_window")).any()))

    @cached_property
    def given_tolerance(self) -> Reals:
        """Tolerance of the output to either side that the file names [rad]."""
        return np.radians(self.key("dwell_tolerance"))

    @property
    def tolerance(self) -> Reals:
        """That of the dwell."""
        return self.given_tolerance

    @cached_property
    def _endless(self) -> Reals:
        """Half of what the output gains in a turn of the crank [rad]."""
        return math.pi * self.mean_ratio

    @cached_property
    def _dwells(self) -> tuple[Any, Dwells]:
        """Places of the designs that have a dwell within the tolerance, and their dwells."""
        places = np.flatnonzero(self.exists & (self.given_tolerance < self._endless))
        greatest, least = self.places_of_speeds
        width = self.back_step[1]
        first = np.where(np.isfinite(width), self.start_of_back_step, least)
        second = np.where(np.isfinite(width), first + width, least)
        valleys = Valleys(self.drives, first, second, least, greatest, self.given_tolerance)
        return places, longest_in_band(valleys.part(places))

    @property
    def start_of_back_step(self) -> Reals:
        """phi(1), the standstill at which the output turns back."""
        return self.standstills[0]

    @cached_property
    def band(self) -> tuple[Reals, Reals]:
        """Start and crank angle of the dwell within the tolerance."""
        places, dwells = self._dwells
        start, width = np.full(self.count, np.nan), np.full(self.count, np.nan)
        start[places], width[places] = dwells.start, dwells.crank_angle
        return start, width

    @cached_property
    def _band_is_doubtful(self) -> Mask:
        places, dwells = self._dwells
        doubtful = np.zeros(self.count, dtype=bool)
        doubtful[places] = dwells.doubtful | (dwells.tied & ("tolerance_dwell_start" in self.wanted))
        return doubtful

    def _of_band(self) -> Iterator[Findings]:
        """GL313 where a window is asked for, GL317 where there is a tolerance."""
        asked = self.key("dwell_window")
        if self.command == "analyze" and np.isfinite(asked).any():
            width = np.degrees(self.band[1])
            got = np.where(self.given_tolerance < self._endless, width, 360.0)
            yield window_judged(got, asked).of(self.count)
        yield tolerance_judged(np.degrees(self.tolerance), np.degrees(self._endless)).of(self.count)

    # Meshes and checks

    @cached_property
    def _meshes(self) -> dict[str, Mesh]:
        make = self._made.meshes
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
        yield collision_judged(self.gap, self.key("limits.gear_gap")).of(self.count)
        yield from self._shafts()
        yield transmission_judged(np.degrees(self.mu), self.key("limits.transmission_angle")).of(self.count)
        yield from self.of_task()
        yield from self._of_band()
        asked = self.key("gears.i3")
        yield ratio_judged(np.where(np.isnan(asked), np.nan, -self.z3 / self.z5), asked).of(self.count)
        for mesh in self._meshes.values():
            yield from mesh.findings()

    def _shafts(self) -> Iterator[Findings]:
        """GL302: gears that reach the shafts A and D, and the two shafts; at a bare axis no more than a warning."""
        tips = [tip_radius(z, self.module) for z in (self.z1, self.z3, self.z5)]  # type: ignore[arg-type]
        given, (crank, frame) = self.spec.limits.least_shaft, self.links
        least = LEAST_SHAFT_MODULES * self.module if given is None else np.full(self.count, given)
        radii = [self.key(f"shafts.{name}_radius") for name in ("input", "output")]
        bare = [np.isnan(radius) for radius in radii]
        radii = [np.where(none, 0.0, radius) for none, radius in zip(bare, radii, strict=True)]
        dead = self.coupler - crank
        by_crank = dead > np.abs(self.rocker - frame)
        nearest_c = np.where(by_crank, dead, self.rocker - frame)
        both = "crank" in self.given and "frame" in self.given
        gaps = (
            (nearest_c - (tips[1] + radii[0]), 1 * bare[0], both | (by_crank & ("crank" in self.given))),
            (frame - (tips[2] + radii[0]), 1 * bare[0], "frame" in self.given),
            (np.abs(frame - crank) - (tips[0] + radii[1]), 1 * bare[1], both),
            (self.rocker - (tips[1] + radii[1]), 1 * bare[1], True),
            (frame - (radii[0] + radii[1]), 1 * bare[0] + bare[1], "frame" in self.given),
        )
        for gap, axes, exact in gaps:
            limit = least * axes
            self._at_limit |= _near(gap, limit) & ~(exact & (gap == limit))
            yield shaft_judged(gap, limit, axes > 0).of(self.count)
        height = FULL_HEIGHT * self.module
        rim, limit = tips[2] - height - radii[1], 0.5 * height
        self._at_limit |= _near(rim, limit)
        yield Findings(SHAFT_CLEARANCE.code, rim, limit, self.none, (rim < limit) & ~bare[1], "mm")

    def evaluated(self, outside: Mask) -> Evaluated:
        """All that a study asks for; what lies outside is left to the class."""
        gone = ~self.exists
        found, plain = {}, self.plain
        for name in self.wanted:
            value = plain[name]() if name in plain else self.mesh_quantity(name)
            empty: Any = "" if value.dtype.kind == "U" else np.nan
            found[name] = np.where(gone, empty, value)
        findings = [_without(each, gone) for each in self.findings()]
        reasons = (*self.reasons, "gears.idler")
        return Evaluated(found, findings, self.refused, reasons, outside | self._unsure(findings))

    def _unsure(self, findings: Sequence[Findings]) -> Mask:
        """Designs next to a limit, or where a root hangs by few digits."""
        unsure = np.zeros(self.count, dtype=bool)
        for each in findings:
            if each.code in _JUDGED_HERE:
                unsure |= _near(each.value, each.limit)
        if self.seeks_band:
            unsure |= self._band_is_doubtful
        return np.asarray((unsure | self._at_limit | self.doubtful) & self.exists)


def _near(value: Reals, limit: Reals, within: Any = _NEAR) -> Mask:
    """Where rounding might change on which side of a limit a value lies."""
    scale = np.maximum(1.0, np.maximum(np.abs(value), np.abs(limit)))
    return np.asarray(np.abs(value - limit) <= within * scale)


def _without(each: Findings, gone: Mask) -> Findings:
    """A finding whose designs that do not exist neither fail nor warn."""
    if not gone.any():
        return each
    return Findings(each.code, each.value, each.limit, each.fails & ~gone, each.warns & ~gone, each.unit)
