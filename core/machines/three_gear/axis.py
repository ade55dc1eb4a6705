"""Three-gear four-bars over arrays of designs: lengths, meshes, checks and quantities by name, and each task's links.

`Batch` is what all have in common. `General` are gears of any teeth: `Momentary` mirrors `MomentaryDwellSynthesis` (an
eccentricity), `Analysis` `ThreeGearFourBar`. `Symmetric` are equal gears in closed form: `Dwells` and `Windows` mirror
`DwellSynthesis` (an angle phi13, a window or a tolerance alone), `BackSteps` and `Speeds` the syntheses of these names.

Whatever a study asks for beside them (a synthesis for a window within a tolerance, a play, rings, gears with teeth of
their own, quantities of other commands) is left to the design classes.

The idler of many is that of `synthesis.smallest_idler`. In the symmetric family the idlers that keep the limits are all
from some number of teeth on, so they are halved; for other tasks they are tried from 17 up. In both, designs whose
idler is found drop out. The family's frame ratio d rises with n = 1 - i3: d = sc + sqrt(sc^2 + 1),
sc = sqrt(n^2 - 1) cos(h), where h stands or falls with n (a speed band gives d = q + sqrt(q^2 - 1) with q in proportion
to n). The least transmission angle follows d alone, (d - 1)/sqrt(2 (1 + d^2)) = sin(gamma/2), and rises; so does frame
less crank, b sqrt(2) (d - 1)/sqrt(1 + d^2).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design_axis import Evaluated, Findings, kept_inside
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.three_gear import sweep, symmetric
from gearlink.core.machines.three_gear.codes import (
    BACK_STEP,
    DWELL_TOLERANCE,
    back_step_judged,
    ratio_judged,
    target_judged,
    tolerance_judged,
)
from gearlink.core.machines.three_gear.design import MESHES
from gearlink.core.machines.three_gear.dwell_synthesis import MARGIN, PLAIN_TOLERANCE
from gearlink.core.machines.three_gear.sweep import Drives, Valleys, longest_in_band, momentary_dwells, wrapped
from gearlink.core.machines.three_gear.symmetric import dwell_angle_limit, window_limit
from gearlink.core.machines.three_gear.synthesis import GREATEST_IDLER, LEAST_IDLER
from gearlink.core.machines.three_gear.train import tip_radius
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.elementary_sweep import ARRAYS
from gearlink.core.parts.gears.train.unshifted import MOST_TEETH, Mesh, UnshiftedMeshes
from gearlink.core.parts.linkages.checks import edge_judged, transmission_judged, window_judged
from gearlink.core.parts.linkages.codes import (
    DWELL_EDGE,
    DWELL_WINDOW,
    GEAR_COLLISION,
    SHAFT_CLEARANCE,
    TRANSMISSION_ANGLE,
)
from gearlink.core.parts.linkages.fourbar.sweep import least_transmission_angle
from gearlink.core.studies.clearance import (
    FULL_HEIGHT,
    LEAST_SHAFT_MODULES,
    Gear,
    Shaft,
    collision_judged,
    gaps,
    shaft_judged,
    shaft_meetings,
)

TEETH = ("gears.crank", "gears.idler", "gears.output")
LIMITS = ("limits.transmission_angle", "limits.gear_gap", "dwell_tolerance", "dwell_window")
SHAFTS = ("shafts.input_radius", "shafts.output_radius")
_NEAR, _POORLY_NEAR = 1e-9, 1e-5
_JUDGED_HERE = {
    rule.code for rule in (GEAR_COLLISION, TRANSMISSION_ANGLE, BACK_STEP, DWELL_TOLERANCE, DWELL_WINDOW, DWELL_EDGE)
}
_OF_STANDSTILLS = (
    "motion",
    "dwell_crank_angles[0]",
    "dwell_crank_angles[1]",
    "back_step_angle",
    "back_step_crank_angle",
    "dwell_angle",
    "dwell_angle_approximate",
)
_SMALL, _STEEP = 1e-3, 1e-4


class Tried(NamedTuple):
    """Designs with idlers that are tried.

    good : whether they keep transmission angle and gear gap
    clear : whether no gear reaches a shaft that the file names
    close : whether rounding might change either
    """

    good: Mask
    clear: Mask
    close: Mask


class Batch:
    """Some designs; every result is an array, made when it is asked for. A subclass finds the links of its task.

    Parameters
        spec, command : of the base design
        wanted : names of the quantities
        meshes : UnshiftedMeshes - of the base's pressure angle
        columns : (N,) arrays by path
    Fields
        reasons : keys that designs are refused for
        reason : 0, or 1 + the place in `reasons` that a design is refused for; what the class refuses first counts
        wrong_with_every_idler : designs whose refusal no idler could avoid
        links : crank AB and frame AD
        speeds, places_of_speeds : maximum and minimum speed ratio, and their crank angles
        standstills : crank angles of the first and the second one
        doubtful : designs that the class shall compute
        links_are_doubtful : those among them whose links or transmission angle hang by few digits
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
        return self.nothing if value is None else np.full(self.count, value)

    # What a task gives, in mm and radians; NaN where there is none

    if TYPE_CHECKING:

        @property
        def reasons(self) -> tuple[str, ...]: ...
        @property
        def reason(self) -> Any: ...
        @property
        def wrong_with_every_idler(self) -> Mask: ...
        @property
        def links(self) -> tuple[Reals, Reals]: ...
        @property
        def speeds(self) -> tuple[Reals, Reals]: ...
        @property
        def places_of_speeds(self) -> tuple[Reals, Reals]: ...
        @property
        def standstills(self) -> tuple[Reals, Reals]: ...
        @property
        def doubtful(self) -> Mask: ...
        @property
        def links_are_doubtful(self) -> Mask: ...

    @property
    def back_step(self) -> tuple[Reals, Reals]:
        """Its size, and its crank angle phi12."""
        return self.nothing, self.nothing

    @property
    def dwell_angle(self) -> Reals:
        """phi13."""
        return self.nothing

    def of_task(self) -> Iterator[Findings]:
        """Findings of the task's own checks."""
        yield from ()

    # What follows from it

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
    def nothing(self) -> Reals:
        """What no design has."""
        return np.full(self.count, np.nan)

    def spread(self, places: Any, values: Reals) -> Reals:
        """Values of some designs, whose places or mask are given, among those that have none."""
        found = self.nothing.copy()
        found[places] = values
        return found

    @cached_property
    def coupler(self) -> Reals:
        """Centre distance of gears 1 and 3."""
        return self.module * (self.z1 + self.z3) / 2.0

    @cached_property
    def rocker(self) -> Reals:
        """Centre distance of gears 3 and 5."""
        return self.module * (self.z3 + self.z5) / 2.0

    @cached_property
    def mu(self) -> Reals:
        """Minimum transmission angle: of the folded and the stretched place."""
        crank, frame = self.links
        return least_transmission_angle(crank, self.coupler, self.rocker, frame)

    @cached_property
    def mean_ratio(self) -> Reals:
        """Net output revolutions per crank revolution."""
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
        return sweep.drives_of((crank, self.coupler, self.rocker, frame), self.spec.assembly, *shares)

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
        """Half of what the output gains in a revolution of the crank [rad]."""
        return math.pi * self.mean_ratio

    @cached_property
    def _dwells(self) -> tuple[Any, sweep.Dwells]:
        """Places of the designs that have a dwell within the tolerance, and their dwells."""
        places = np.flatnonzero(self.exists & (self.given_tolerance < self._endless))
        greatest, least = self.places_of_speeds
        width = self.back_step[1]
        first = np.where(np.isfinite(width), self.start_of_back_step, least)
        second = np.where(np.isfinite(width), first + width, least)
        high = first + np.mod(greatest - first, math.tau)
        valleys = Valleys(self.drives, first, second, least, high - math.tau, high, self.mean_ratio)
        return places, longest_in_band(valleys.part(places), self.given_tolerance[places])

    @property
    def start_of_back_step(self) -> Reals:
        """phi(1), the standstill at which the output turns back."""
        return self.standstills[0]

    @cached_property
    def band(self) -> tuple[Reals, Reals]:
        """Start and crank angle of the dwell within the tolerance."""
        places, dwells = self._dwells
        return self.spread(places, dwells.start), self.spread(places, dwells.crank_angle)

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
        return {"crank_idler": make(self.z1, self.z3, self.module), "idler_output": make(self.z3, self.z5, self.module)}

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
        radii = {axis: self.key(f"shafts.{name}_radius") for axis, name in (("A", "input"), ("D", "output"))}
        bare = {axis: np.isnan(radius) for axis, radius in radii.items()}
        shafts = tuple(Shaft("", axis, np.where(bare[axis], 0.0, radius), "") for axis, radius in radii.items())  # type: ignore[arg-type]
        gears = [Gear("", axis, tip) for axis, tip in zip("BCD", tips, strict=True)]
        dead = self.coupler - crank
        by_crank = dead > np.abs(self.rocker - frame)
        both = "crank" in self.given and "frame" in self.given
        nearest = {  # distances of axes, and whether they are those of the class to the last bit
            "AC": (np.where(by_crank, dead, self.rocker - frame), both | (by_crank & ("crank" in self.given))),
            "AD": (frame, "frame" in self.given),
            "BD": (np.abs(frame - crank), both),
            "CD": (self.rocker, True),
        }
        for one, other in shaft_meetings(gears, shafts):
            if (ends := "".join(sorted(one.axis + other.axis))) in nearest:
                distance, exact = nearest[ends]
                axes = sum(1 * bare[body.axis] for body in (one, other) if isinstance(body, Shaft))
                gap, limit = gaps(one, other, distance, distance)[0], least * axes
                self._at_limit |= _near(gap, limit) & ~(exact & (gap == limit))
                yield shaft_judged(gap, limit, axes > 0).of(self.count)
        height = FULL_HEIGHT * self.module
        rim, limit = tips[2] - height - shafts[1].outer, 0.5 * height
        self._at_limit |= _near(rim, limit)
        yield Findings(SHAFT_CLEARANCE.code, rim, limit, self.none, (rim < limit) & ~bare["D"], "mm")

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


def _in_range(value: Reals, low: Any, high: Any) -> Mask:
    return np.asarray((low < value) & (value < high))


def _without(each: Findings, gone: Mask) -> Findings:
    """A finding whose designs that do not exist neither fail nor warn."""
    if not gone.any():
        return each
    return Findings(each.code, each.value, each.limit, each.fails & ~gone, each.warns & ~gone, each.unit)


class General(Batch):
    """Designs whose links are known; their motion is found by Newton's method."""

    @cached_property
    def radii(self) -> tuple[Reals, Reals, Reals]:
        """Reference radii of gears 1, 3 and 5."""
        return 0.5 * self.module * self.z1, 0.5 * self.module * self.z3, 0.5 * self.module * self.z5

    @cached_property
    def _extremes(self) -> tuple[tuple[Reals, Reals, Mask], tuple[Reals, Reals, Mask]]:
        starts = (self.drives.s * 0.5 * math.pi, 1.0), (self.drives.s * 1.5 * math.pi, -1.0)
        greatest, least = (sweep.extreme(self.drives, *start) for start in starts)
        return greatest, least

    @cached_property
    def speeds(self) -> tuple[Reals, Reals]:
        """Both extremes."""
        greatest, least = self._extremes
        return greatest[0], least[0]

    @cached_property
    def places_of_speeds(self) -> tuple[Reals, Reals]:
        """Where they stand."""
        greatest, least = self._extremes
        return greatest[1], least[1]

    @cached_property
    def _seeks_speeds(self) -> bool:
        return self.seeks_band or any(
            name in ("speed_ratio_max", "speed_ratio_min", "nonuniformity") for name in self.wanted
        )

    @cached_property
    def links_are_doubtful(self) -> Mask:
        """Poor transmission, and links next to a change point."""
        return np.asarray(sweep.turns(self.drives)[2] | (self.mu < 1e-3))

    @cached_property
    def doubtful(self) -> Mask:
        """Besides: searches that did not come to rest."""
        greatest, least = self._extremes if self._seeks_speeds else ((None, None, ~self.none),) * 2
        return self.links_are_doubtful | ~(greatest[2] & least[2])


class Momentary(General):
    """`synth momentary-dwell` with an eccentricity."""

    keys = ("momentary.eccentricity",)
    given = ("crank",)
    reasons = ("momentary.eccentricity",)

    @property
    def wrong_with_every_idler(self) -> Mask:
        """A crank not below the radius of gear 1."""
        return np.asarray(self.key("momentary.eccentricity") >= self.radii[0])

    @cached_property
    def _found(self) -> Any:
        return momentary_dwells(*self.radii, self.key("momentary.eccentricity"))

    @cached_property
    def reason(self) -> Any:
        """A crank that never just stops the output."""
        return np.where(self._found.exists, 0, 1)

    @cached_property
    def links(self) -> tuple[Reals, Reals]:
        """The frame in closed form."""
        return np.where(self.exists, self.key("momentary.eccentricity"), np.nan), self._found.frame

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """The one of the momentary dwell."""
        angle = self._found.crank_angle
        return (angle if self.spec.assembly == 1 else sweep.wrapped(-angle)), self.nothing


class Analysis(General):
    """`analyze` of given links."""

    keys = ("links.crank", "links.frame")
    given = ("crank", "frame")
    reasons = ("links",)
    chooses_idler = False

    @cached_property
    def links(self) -> tuple[Reals, Reals]:
        """As given."""
        return self.key("links.crank"), self.key("links.frame")

    @cached_property
    def reason(self) -> Any:
        """Neither crank-rocker nor drag link."""
        rocker, drag, _ = sweep.turns(self.drives)
        return np.where(rocker | drag, 0, 1)

    @cached_property
    def _standing(self) -> tuple[Reals, Reals, Mask]:
        low, high, near = sweep.standstills(self.radii, self.drives)
        return np.where(self.exists, low, np.nan), np.where(self.exists, high, np.nan), near

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """Roots of the quadratic."""
        low, high, _ = self._standing
        return low, high

    @cached_property
    def doubtful(self) -> Mask:
        """Besides: where the output just stops, links at a change point whether they turn or not."""
        seeks = self.seeks_band or any(name in _OF_STANDSTILLS for name in self.wanted)
        near = self._standing[2] if seeks else self.none
        return np.asarray(super().doubtful | near)

    @cached_property
    def _places(self) -> Any:
        return np.flatnonzero(np.isfinite(self.standstills[1]))

    @cached_property
    def _stepping(self) -> tuple[Reals, Reals, Reals]:
        """Start, crank angle and size of the back-steps of `_places`."""
        low, high = self.standstills
        return sweep.back_step(low[self._places], high[self._places], self.drives.part(self._places))

    @property
    def start_of_back_step(self) -> Reals:
        """Of standstills in ascending order it may be the second."""
        return self.spread(self._places, self._stepping[0])

    @cached_property
    def back_step(self) -> tuple[Reals, Reals]:
        """Between the standstills."""
        _, width, size = self._stepping
        return self.spread(self._places, size), self.spread(self._places, width)

    @cached_property
    def dwell_angle(self) -> Reals:
        """Until the output has regained its place."""
        start, width, _ = self._stepping
        return self.spread(self._places, sweep.dwell_angle(start, width, self.drives.part(self._places)))


class Symmetric(Batch):
    """Designs of the family I = 1.

    Fields
        possible : where equal gears meet the task
        h : half of phi12 [rad]; NaN where the output has no standstill
    """

    idlers_rise = True

    if TYPE_CHECKING:

        @property
        def possible(self) -> Mask: ...
        @property
        def h(self) -> Reals: ...

    @property
    def impossible(self) -> Any:
        """Place among the reasons of a task that cannot be met."""
        return 1

    @property
    def wrong_with_every_idler(self) -> Mask:
        """Unequal gears."""
        return np.asarray(self.z1 != self.z5)

    @cached_property
    def i3(self) -> Reals:
        """Ratio of idler and output gear."""
        return -self.z3 / self.z5

    @cached_property
    def n(self) -> Reals:
        """1 - i3."""
        return 1.0 - self.i3

    @cached_property
    def reason(self) -> Any:
        """Unequal gears, then an impossible task."""
        return np.where(self.z1 != self.z5, 1, np.where(self.possible, 0, 1 + self.impossible))

    @cached_property
    def frame_ratio(self) -> Reals:
        """d."""
        found: Reals = symmetric.frame_ratio(self.i3, self.h, ARRAYS)
        return found

    @cached_property
    def links(self) -> tuple[Reals, Reals]:
        """From the frame ratio (thesis (4-10))."""
        crank = symmetric.crank_length(self.frame_ratio, self.coupler, ARRAYS)
        return crank, self.frame_ratio * crank

    @cached_property
    def speeds(self) -> tuple[Reals, Reals]:
        """In closed form (thesis (4-13))."""
        return symmetric.speed_ratio_limits(self.i3, self.frame_ratio)

    @cached_property
    def places_of_speeds(self) -> tuple[Reals, Reals]:
        """At 90 and 270 deg."""
        quarter = np.full(self.count, 0.5 * math.pi * self.spec.assembly)
        return quarter, quarter + math.pi

    @cached_property
    def _steps_back(self) -> Mask:
        return np.asarray(self.h > 0.0)

    @cached_property
    def standstills(self) -> tuple[Reals, Reals]:
        """phi12/2 on either side of the minimum speed."""
        middle = 1.5 * math.pi if self.spec.assembly == 1 else 0.5 * math.pi
        first = np.where(np.isfinite(self.h), middle - self.h, np.nan)
        return first, np.where(self._steps_back, middle + self.h, np.nan)

    @cached_property
    def back_step(self) -> tuple[Reals, Reals]:
        """In closed form (thesis (4-19))."""
        size = np.where(self._steps_back, symmetric.back_step(self.n, self.h, ARRAYS)[0], np.nan)
        return size, np.where(self._steps_back, 2.0 * self.h, np.nan)

    @cached_property
    def dwell_angle(self) -> Reals:
        """From its equation."""
        places = np.flatnonzero(self._steps_back)
        h = self.h[places]
        return self.spread(places, h + symmetric.regained(self.n[places], h, ARRAYS)) if places.size else self.nothing

    @cached_property
    def doubtful(self) -> Mask:
        """Where the root for h hangs by few digits."""
        return np.asarray((self.h > 0.0) & ((self.h < _SMALL) | (self.h > 0.5 * math.pi - _STEEP)))

    @property
    def links_are_doubtful(self) -> Mask:
        """The same: links and motion hang by h."""
        return self.doubtful


class OfDwell(Symmetric):
    """A dwell: where no tolerance is given, that of the band which the back-step fills."""

    @cached_property
    def tolerance(self) -> Reals:
        """As given, or half of the back-step."""
        return np.where(np.isnan(self.given_tolerance), 0.5 * self.back_step[0], self.given_tolerance)

    @cached_property
    def band(self) -> tuple[Reals, Reals]:
        """In closed form where the back-step fills the band."""
        start, width = super().band
        fills = np.isnan(self.given_tolerance)
        before = self.standstills[0] - (self.dwell_angle - self.back_step[1])
        length = 2.0 * self.dwell_angle - self.back_step[1]
        return np.where(fills, wrapped(before), start), np.where(fills, length, width)


class Dwells(OfDwell):
    """`synth dwell` with an angle."""

    keys = ("dwell.angle",)
    reasons = ("gears.output", "dwell.angle")

    @cached_property
    def _asked(self) -> Reals:
        return np.radians(self.key("dwell.angle"))

    @cached_property
    def possible(self) -> Mask:
        """Below the limit of the gears."""
        return _in_range(self._asked, 0.0, dwell_angle_limit(self.i3))

    @cached_property
    def h(self) -> Reals:
        """From phi13."""
        good = self.exists
        return self.spread(good, symmetric.half_angle_for_dwell(self.n[good], self._asked[good], ARRAYS))

    @cached_property
    def dwell_angle(self) -> Reals:
        """As asked for."""
        return np.where(self.exists, self._asked, np.nan)

    def of_task(self) -> Iterator[Findings]:
        """GL315: half of the back-step."""
        half = np.degrees(0.5 * self.back_step[0])
        limit = np.where(np.isnan(self.given_tolerance), PLAIN_TOLERANCE, np.degrees(self.given_tolerance))
        yield back_step_judged(half, limit).of(self.count)


class Windows(OfDwell):
    """`synth dwell` with a window or a tolerance; what asks for both is the class's."""

    keys = ("dwell.window", "dwell.tolerance", "dwell.margin")
    chooses_idler = False

    @property
    def reasons(self) -> tuple[str, ...]:
        """The key that asks for the dwell is the one at fault."""
        return "gears.output", "dwell.window" if self._by_window else "dwell.tolerance"

    @cached_property
    def _by_window(self) -> bool:
        return bool(np.isfinite(self.key("dwell.window")).any())

    @cached_property
    def _window(self) -> Reals:
        return np.radians(self.key("dwell.window"))

    @cached_property
    def given_tolerance(self) -> Reals:
        """That of the dwell."""
        return np.radians(self.key("dwell.tolerance"))

    @cached_property
    def _back_step_sought(self) -> Reals:
        """Twice the tolerance less the margin."""
        margin = self.key("dwell.margin")
        return 2.0 * (self.given_tolerance * (1.0 - np.where(np.isnan(margin), MARGIN, margin)))

    @cached_property
    def possible(self) -> Mask:
        """Windows and tolerances that the gears reach."""
        if self._by_window:
            return _in_range(self._window, 0.0, window_limit(self.i3))
        most = np.minimum(math.pi, 0.5 * (self.z3 / self.z5) * math.pi)
        return _in_range(self.given_tolerance, 0.0, most) & (self._back_step_sought > 0.0)

    @cached_property
    def h(self) -> Reals:
        """From the window, or from the back-step that fills the band but for the margin."""
        good = self.exists
        if self._by_window:
            return self.spread(good, symmetric.half_angle_for_window(self.n[good], self._window[good], ARRAYS))
        sought = self._back_step_sought[good]
        return self.spread(good, symmetric.half_angle_for_back_step(self.n[good], sought, ARRAYS))

    @cached_property
    def _longest(self) -> Reals:
        """The longest window that the tolerance leaves to the gears."""
        good = self.exists
        if not good.any():
            return self.nothing
        h = symmetric.half_angle_for_back_step(self.n[good], 2.0 * self.given_tolerance[good], ARRAYS)
        return self.spread(good, 2.0 * symmetric.regained(self.n[good], h, ARRAYS))

    @property
    def plain(self) -> dict[str, Callable[[], Any]]:
        """With what a window has."""
        own = {"dwell_tolerance": lambda: np.degrees(0.5 * self.back_step[0])}
        if not self._by_window:
            own["window_limit"] = lambda: np.degrees(self._longest)
        return {**super().plain, **own}

    def of_task(self) -> Iterator[Findings]:
        """GL314: the back-step's share of the band."""
        share = 0.5 * self.back_step[0] / self.given_tolerance
        yield edge_judged(share).of(self.count)


class BackSteps(Symmetric):
    """`synth back-step`."""

    keys = ("back_step.angle", "back_step.crank_angle")
    reasons = ("gears.output", "back_step.angle")

    @cached_property
    def _asked(self) -> Reals:
        return np.radians(self.key("back_step.angle"))

    @cached_property
    def _given(self) -> Reals:
        return np.radians(self.key("back_step.crank_angle")) / 2.0

    @cached_property
    def possible(self) -> Mask:
        """A crank angle always is; a back-step below the limit of the gears."""
        return np.isfinite(self._given) | _in_range(self._asked, 0.0, math.pi * (self.n - 1.0))

    @cached_property
    def h(self) -> Reals:
        """As given, or from the back-step."""
        h = np.where(self.exists, self._given, np.nan)
        sought = np.flatnonzero(self.exists & np.isnan(self._given))
        if sought.size:
            h[sought] = symmetric.half_angle_for_back_step(self.n[sought], self._asked[sought], ARRAYS)
        return h

    def of_task(self) -> Iterator[Findings]:
        """GL304: the back-step that was asked for."""
        asked, got = self.key("back_step.angle"), np.degrees(np.where(self.h == 0.0, 0.0, self.back_step[0]))
        value = np.where(np.isnan(asked), np.nan, got)
        yield target_judged(value, asked).of(self.count)


class Speeds(Symmetric):
    """`synth variable-speed`."""

    keys = ("speed.min", "speed.max")
    reasons = ("gears.output", "speed.max", "speed.min")

    @cached_property
    def possible(self) -> Mask:
        """A band that does not reach below zero."""
        low, high = self.key("speed.min"), self.key("speed.max")
        return np.asarray((low >= 0.0) & (low < high))

    @property
    def wrong_with_every_idler(self) -> Mask:
        """A wrong band too."""
        return np.asarray((self.z1 != self.z5) | ~self.possible)

    @property
    def impossible(self) -> Any:
        """The key at fault."""
        return np.where(self.key("speed.max") <= self.key("speed.min"), 1, 2)

    @cached_property
    def h(self) -> Reals:
        """0 where the output just stops."""
        return np.where(self.exists & (self.key("speed.min") == 0.0), 0.0, np.nan)

    @cached_property
    def frame_ratio(self) -> Reals:
        """From the band."""
        d = symmetric.frame_ratio_between(self.i3, self.key("speed.min"), self.key("speed.max"), ARRAYS)
        return np.where(self.exists, d, np.nan)


_TASKS: dict[str, tuple[str, type[Batch]]] = {
    "synth dwell": ("dwell", Dwells),
    "synth back-step": ("back_step", BackSteps),
    "synth variable-speed": ("speed", Speeds),
    "synth momentary-dwell": ("momentary", Momentary),
    "analyze": ("links", Analysis),
}
_CHECKS = (
    *("undercut", "tip-thickness", "contact-ratio", "involute-interference", "root-clearance", "sliding", "tooth-form"),
    *("gear-collision", "shaft-clearance", "shaft-seat", "transmission-angle", "rounded-ratio", "dwell-tolerance"),
    *("tip-fouling", "ring-tips"),  # of rings, which are left to the class
)
"""Names of the checks that are judged here, and of those that find nothing on the designs that are served."""
_CHECKS_OF = {
    "synth dwell": ("back-step", "dwell-window", "dwell-edge"),
    "synth back-step": ("back-step-target",),
    "synth variable-speed": (),
    "synth momentary-dwell": (),
    "analyze": ("dwell-window",),
}
"""Those of a task in addition."""
_DOMAIN = {path: (1.0, float(MOST_TEETH), 20.0) for path in TEETH} | {
    "gears.module": (1e-6, 1e6, 1.0),
    "dwell_tolerance": (1e-6, 360.0, 1.0),
    "dwell_window": (1e-6, 360.0, 1.0),
}
"""Minimum and maximum value that is computed here, not by the class, and one between that stands in for others."""
_PLACED = ("crank", "frame", "balanced")
_OTHERS = {
    "dwell": (*_PLACED, "window", "tolerance", "margin"),
    "back_step": _PLACED,
    "speed": (*_PLACED, "uniform_angle", "uniform_tolerance"),
    "momentary": ("frame", "gap", "balanced"),
    "links": (),
}


def axis(
    spec: Any, command: str, paths: Sequence[str], quantities: Sequence[str], checks: Sequence[str]
) -> ThreeGearAxis | None:
    """The array form of a study of three-gear four-bars; None where the design classes have to serve.

    Parameters
        spec, command, paths, quantities, checks : as of `core.base.design_axis.Maker`
    """
    if command not in _TASKS or not set(checks) <= {*_CHECKS, *_CHECKS_OF[command]}:
        return None
    if not _served(spec, command, paths):
        return None
    made = ThreeGearAxis(spec, command, tuple(quantities))
    one = made.batch({path: np.array([20.0]) for path in TEETH})
    plain = {name for name in quantities if name.rpartition(".")[0] not in MESHES}
    meshes = (name for name in quantities if name not in plain)
    served = plain <= one.plain.keys() and all(one.mesh_quantity(name) is not None for name in meshes)
    return made if served else None


def _served(spec: Any, command: str, paths: Sequence[str]) -> bool:
    """Whether the array form knows all keys that are varied, and the base asks for no more."""
    task, batch = _TASKS[command][0], _batch_of(spec, command)
    section = getattr(spec, task)
    if section is None:
        return False
    if spec.gears.own_teeth or min(spec.gears.crank, spec.gears.output) < 0:  # or a ring gear
        return False
    if any(getattr(spec, name) is not None for name in ("dwell_backlash", "input_speed", "uniform_tolerance")):
        return False
    if spec.feed is not None and (spec.feed.step is not None or spec.feed.lay is not None):
        return False
    if any(getattr(section, name) is not None for name in (_PLACED if batch is Windows else _OTHERS[task])):
        return False
    known = {*TEETH, "gears.module", "gears.i3", *batch.keys, *LIMITS, *SHAFTS}

    def given(path: str) -> bool:
        return path in paths or number_at(spec, path) is not None

    if command == "analyze" and given("dwell.tolerance"):  # measured by the class alone
        return False
    if batch is Windows:
        window = given("dwell.window")
        if window == given("dwell.tolerance") or (window and given("dwell_tolerance")):
            return False
    others = given("gears.crank") and given("gears.output") and given("gears.module")
    idler = given("gears.idler") != given("gears.i3") or (batch.chooses_idler and not _is_given_by_task(command, given))
    return set(paths) <= known and others and idler


def _batch_of(spec: Any, command: str) -> type[Batch]:
    """What computes the designs of a task: a dwell may ask for a window instead of an angle."""
    by_window = command == "synth dwell" and spec.dwell is not None and spec.dwell.angle is None
    return Windows if by_window else _TASKS[command][1]


def _is_given_by_task(command: str, given: Callable[[str], bool]) -> bool:
    """Whether the task itself gives the idler: a back-step over a crank angle does."""
    both = given("back_step.angle") and given("back_step.crank_angle")
    return (command == "synth back-step" and both) or given("gears.i3")


@dataclass(frozen=True)
class ThreeGearAxis:
    """The array form; made by `axis`."""

    spec: Any
    command: str
    wanted: tuple[str, ...]

    @cached_property
    def meshes(self) -> UnshiftedMeshes:
        """Meshes of the base's pressure angle."""
        return UnshiftedMeshes(math.radians(self.spec.gears.pressure_angle), self.spec.limits)

    def batch(self, columns: Mapping[str, Reals]) -> Batch:
        """Some designs."""
        return self._kind(self.spec, self.command, self.wanted, self.meshes, columns)

    @cached_property
    def _kind(self) -> type[Batch]:
        return _batch_of(self.spec, self.command)

    def _with_idlers(self, columns: Mapping[str, Reals]) -> Mapping[str, Reals]:
        """With the idlers that ratios ask for, as `idler_for_ratio`; none where the model refuses gears beside one."""
        ratio = columns.get("gears.i3", self.spec.gears.i3)
        if ratio is None:
            return columns
        crank, _, output = (columns.get(path, number_at(self.spec, path)) for path in TEETH)
        idler = np.where(crank == output, np.floor(-ratio * output + 0.5), np.nan)
        count = len(next(iter(columns.values())))
        return {**columns, "gears.idler": np.broadcast_to(idler, (count,))}

    @cached_property
    def _seeks_idler(self) -> bool:
        return all(number_at(self.spec, path) is None for path in ("gears.idler", "gears.i3"))

    def evaluate(self, columns: Mapping[str, Reals]) -> Evaluated:
        """As `core.base.design_axis.Axis`."""
        inside, outside = kept_inside(self._with_idlers(columns), _DOMAIN)
        if self._kind is Windows:  # of unequal gears the class has them, in the balanced family
            crank, output = (inside.get(path, number_at(self.spec, path)) for path in (TEETH[0], TEETH[2]))
            outside |= np.asarray(crank != output)
            inside["gears.output"] = np.broadcast_to(np.asarray(crank), outside.shape)
        with np.errstate(all="ignore"):
            if not self._seeks_idler or {"gears.idler", "gears.i3"} & columns.keys():
                return self.batch(inside).evaluated(outside)
            teeth, doubtful = self._idlers(inside)
            none = np.isnan(teeth)
            made = self.batch({**inside, "gears.idler": np.where(none, LEAST_IDLER, teeth)})
            made.without_idler = none
            return made.evaluated(outside | doubtful)

    def _idlers(self, columns: Mapping[str, Reals]) -> Idlers:
        """The smallest idlers that keep the limits."""
        shafts = any(path in columns or number_at(self.spec, path) is not None for path in SHAFTS)

        def trial(teeth: Reals, places: Any) -> Tried:
            some = {path: values[places] for path, values in columns.items()}
            return self.batch({**some, "gears.idler": teeth}).tried(shafts=shafts)

        count = len(next(iter(columns.values())))
        return smallest_idlers(trial, count, rising=self._kind.idlers_rise, shafts=shafts)


Trial = Callable[[Reals, Any], Tried]
"""Tries idlers, a number of teeth each, on the designs of some places."""


class Idlers(NamedTuple):
    """Smallest idlers: teeth, NaN where no idler keeps the limits, and designs that the class shall compute."""

    teeth: Reals
    doubtful: Mask


def smallest_idlers(trial: Trial, count: int, *, rising: bool, shafts: bool) -> Idlers:
    """The smallest idler of each design that keeps the limits and clears the shafts; or the limits alone, if none does.

    Parameters
        count : int - of the designs
        rising : bool - whether all idlers above one that keeps the limits keep them
        shafts : bool - whether there are shafts to clear
    """
    doubtful = np.zeros(count, dtype=bool)
    first = (_halved if rising else _from_below)(trial, count, doubtful)
    if not shafts:
        return Idlers(first, doubtful)
    return Idlers(_clear(trial, first, doubtful), doubtful)


def _halved(trial: Trial, count: int, doubtful: Mask) -> Reals:
    """Bisection: the minimum of an upper range."""
    low, high = np.full(count, LEAST_IDLER - 1.0), np.full(count, float(GREATEST_IDLER))
    every = np.arange(count)
    at_most = trial(high, every)
    doubtful |= at_most.close
    live = np.flatnonzero(at_most.good)
    while live.size:
        middle = np.floor(0.5 * (low[live] + high[live]))
        found = trial(middle, live)
        doubtful[live] |= found.close
        high[live] = np.where(found.good, middle, high[live])
        low[live] = np.where(found.good, low[live], middle)
        live = live[high[live] - low[live] > 1.0]
    return np.where(at_most.good, high, np.nan)


def _from_below(trial: Trial, count: int, doubtful: Mask) -> Reals:
    return _first(trial, np.full(count, float(LEAST_IDLER)), doubtful, lambda found: found.good)


def _clear(trial: Trial, first: Reals, doubtful: Mask) -> Reals:
    """The first idler from those that keep the limits on that clears the shafts too; where none does, those."""
    found = _first(trial, first, doubtful, lambda tried: tried.good & tried.clear)
    return np.where(np.isnan(found), first, found)


def _first(trial: Trial, start: Reals, doubtful: Mask, holds: Callable[[Tried], Mask]) -> Reals:
    """The first idler from `start` on for which something holds; NaN where there is none, or no start."""
    found = np.full(start.shape, np.nan)
    live, teeth = np.flatnonzero(~np.isnan(start)), start[~np.isnan(start)]
    while live.size:
        tried = trial(teeth, live)
        doubtful[live] |= tried.close
        good = holds(tried)
        found[live[good]] = teeth[good]
        going = ~good & (teeth < GREATEST_IDLER)
        live, teeth = live[going], teeth[going] + 1.0
    return found
