"""The loads of a planar mechanism: torque of the driven link, forces of pins, slides, slots and teeth."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import NamesOfFile, Outline, geometry
from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.base.report import Check, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.planar.design import PlanarMechanism
from gearlink.core.machines.planar.outputs import inputs
from gearlink.core.mechanism.joints import Contact, Guide
from gearlink.core.mechanism.rates import dot
from gearlink.core.studies.loads import tables
from gearlink.core.studies.loads.design import LoadsDesign, Wanted, loads_outline

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from gearlink.core.machines.planar.loads_spec import PlanarLoads as Section
    from gearlink.core.machines.planar.spec import PlanarSpec
    from gearlink.core.mechanism.dynamics import Force, Mass, Torque
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.studies.loads.machine import Machine
    from gearlink.core.studies.loads.sources import Sources

_CONTACT = ("contact_force_max", "contact_force_min")
_WITHIN = np.array([0.02, 0.2, 0.4, 0.6, 0.8, 0.98])
"""Shares of a stretch between two joints of cams at which the output is asked whether it moves."""
_STANDS = 1e-9
"""Share of its maximum speed below which the output stands: of a closed loop rounding leaves some 1e-14."""


class PlanarLoads(LoadsDesign):
    """Forces over the period, or with a range over one pass of it at constant speed.

    Parameters
        spec : PlanarSpec
    """

    kind = "planar-mechanism"
    spec: PlanarSpec
    links, pins, meshes = (), (), ()
    outlines = loads_outline((), ())
    quantity_names = NamesOfFile()
    joints_of_period = True
    stands = True

    def __init__(self, spec: Any) -> None:
        super().__init__(spec)
        structure = self.design.structure
        first = next((name for name in spec.shown if name in (*spec.links, *spec.slides)), structure.names[-1])
        sliding = [slide.link for slide in spec.slides.values() if slide.on == structure.names[0]]
        vars(self).update(
            links=structure.names[1:],
            sliding=tuple(sliding),
            pins=tuple(pin.name for pin in structure.pins),
            meshes=tuple(spec.meshes),
            output=spec.slides[first].link if first in spec.slides else first,
        )

    design: cached_property[PlanarMechanism] = geometry(PlanarMechanism)

    @property
    def own_names(self) -> tuple[str, ...]:
        """The quantities of this design."""
        return self.outline("loads").quantities

    @classmethod
    def names_for(cls, spec: Any, /) -> tuple[str, ...]:
        """The quantities of the joints of a file."""
        return cls(spec).own_names

    def outline(self, command: str) -> Outline:
        """With the joints of the file."""
        contacts = tuple(f"{cam}.{name}" for cam in self.spec.cams for name in _CONTACT)
        found = loads_outline(self.pins, self.meshes, contacts)[command]
        return found._replace(checks=(*found.checks, "lift-off"))

    def raw(self, name: str) -> Any:
        """A quantity, the contact forces of a cam under its name."""
        cam, _, what = name.partition(".")
        if what not in _CONTACT:
            return super().raw(name)
        return self._unless_locked(lambda: self._contact(cam, greatest=what.endswith("max")).value, None)

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        """The extremes that a quantity needs; those of cams are sought by themselves."""
        return () if quantity.partition(".")[2] in _CONTACT else super().wanted(quantity)

    def _contact(self, cam: str, *, greatest: bool) -> Extreme:
        """Maximum or minimum contact force of a cam [N]."""
        return self.extreme_of(f"contact {cam}", greatest)

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """The forces of cams beside those of every machine."""
        cam = name.removeprefix("contact ")
        if cam == name:
            return super().course(name)
        return lambda phi: self.machine.reactions(phi).unknowns[cam][0]

    def check_lift_off(self) -> Iterator[Check]:
        """GL406: cams that would have to pull their followers."""
        from gearlink.core.parts.cams.codes import LIFT_OFF

        for cam in self.spec.cams:
            least = self._contact(cam, greatest=False)
            status: Status = "fail" if least.value < 0.0 else "pass"
            what, at = f"minimum contact force of the cam {cam}", f"input angle {short(math.degrees(least.place))} deg"
            fix = "press the follower on the cam by a force, or reduce the speed"
            yield LIFT_OFF.check(status, what, least.value, 0.0, "N", side=">=", at=at, fix=fix)

    @cached_property
    def section(self) -> Section:
        """The section `loads`, refused where it asks for what a pass over a range or a slide as drive has not."""
        if self.spec.drive.slide is not None:
            words = "`loads` needs a link that the input turns"
            raise MissingSection(words, key="drive.slide", fix="drive a link instead of a slide")
        found: Section | None = self.spec.loads
        if found is None:
            raise MissingSection(self._first_section(), key="loads")
        if self.spec.range is not None:
            for key in ("flywheel", "motor", "vibration"):
                if getattr(found, key) is not None:
                    words = f"with range the motion does not repeat, so {key} cannot be computed"
                    raise MissingSection(words, key=f"loads.{key}", fix="omit it, or range")
            for name, bearing in found.bearings.items():
                if bearing.life is not None:
                    words = "with range the motion does not repeat, so no life can be computed"
                    raise MissingSection(words, key=f"loads.bearings.{name}.life", fix="omit it, or range")
        return found

    @cached_property
    def masses(self) -> dict[str, Mass]:
        from gearlink.core.studies.loads.sources import mass_of

        for name in self.section.links:
            if name not in self.links:
                words = f"this mechanism has no link {name!r}: it has {', '.join(self.links)}"
                raise NoSolution(words, key=f"loads.links.{name}")
        bodies = self.section.links
        return {name: mass_of(body) for name, body in bodies.items() if body.mass or body.inertia}

    @property
    def turns(self) -> int:
        """Input turns after which everything repeats; over a range those that it takes."""
        course = self.design.course
        return self.design.period_turns or math.ceil((course.end - course.start) / (2.0 * math.pi))

    @cached_property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwells that cams give the output: stretches between joints of their laws in which it stands [rad]."""
        if not self.moving.input.joints or self.spec.range is not None:
            return []
        joints = sorted({0.0, *self.moving.input.joints})  # the period may begin at one
        starts = np.array(joints)
        widths = np.diff(starts, append=self.machine.period)
        mechanism = self.moving.at((starts[:, None] + widths[:, None] * _WITHIN).ravel(), 1)
        link = mechanism.links[self.output]
        slides = self.output in self.sliding
        speed = dot(mechanism.travel[self.output], link.origin.first) if slides else link.turn.first
        size = np.abs(speed).reshape(len(joints), -1).max(axis=1)
        still = size <= _STANDS * size.max()
        return [(start, width) for start, width, stands in zip(joints, widths.tolist(), still, strict=True) if stands]

    # One pass over a range

    @property
    def _first(self) -> float:
        """Input at which a pass begins [rad]; 0 of a period."""
        return self.design.course.start

    @cached_property
    def moving(self) -> Motion:
        """The motion; over a range its input counts from where the pass begins."""
        found, first = self.design.moving, self._first
        if self.spec.range is None or first == 0.0:
            return found
        joints = tuple(joint - first for joint in found.input.joints)
        given = replace(found.input, start=0.0, end=found.input.end - first, joints=joints)
        return replace(found, input=given, make=lambda q, order, side: found.make(q + first, order, side), kept={},
                       kept_few={})  # fmt: skip

    @cached_property
    def machine(self) -> Machine:
        """Everything together; over a range a pass of it."""
        found = super().machine
        if self.spec.range is None:
            return found
        first, last = self._first, self.design.course.end
        sources: Any = _Shifted(found.sources, first)
        return replace(found, sources=sources, stroke=last - first)

    def rows(self, samples: int | None) -> tuple[Reals, dict[str, tuple[Any, str]]]:
        """Input angles of a table's rows from where the pass begins [rad], and the first column."""
        if self.spec.range is None:
            return super().rows(samples)
        degrees = inputs(self.design, samples)
        return np.radians(degrees) - self._first, {"input_angle": (degrees, "deg")}

    @property
    def input_torque_max_at(self) -> float:
        """Input angle of the maximum torque [rad]."""
        return self._place(self.torque_range[1].place)

    @property
    def input_torque_min_at(self) -> float:
        return self._place(self.torque_range[0].place)

    def _place(self, found: float) -> float:
        return found % self.machine.period if self.spec.range is None else found + self._first

    # Tables

    def table_joints(self, samples: int | None = None) -> Table:
        """Forces of pins, those across slides with their couples, those of slots."""
        whole = tables.joints(self, samples)
        found = self.machine.reactions(self.rows(samples)[0])
        columns = dict(zip(whole.columns, zip(whole.data, whole.units, strict=True), strict=True))
        for each in found.mechanism.connections:
            if isinstance(each, Guide):  # one number across the line says it
                columns.pop(f"{each.name}_x")
                columns.pop(f"{each.name}_y")
                columns[each.name] = found.unknowns[each.name][0], "N"
            elif isinstance(each, Contact):
                columns[each.name] = found.unknowns[each.name][0], "N"
        return Table.of("joints", columns)


@dataclass(frozen=True)
class _Shifted:
    """Sources whose input counts from elsewhere [rad]."""

    sources: Sources
    first: float

    @property
    def any(self) -> bool:
        """Whether there is any force at all."""
        return self.sources.any

    @property
    def resisted(self) -> tuple[str, ...]:
        """Links with a resistance."""
        return self.sources.resisted

    def breaks(self) -> list[float]:
        """Where a zone or a table jumps or bends."""
        return sorted(self._breaks())

    def _breaks(self) -> Iterator[float]:
        for place in self.sources.breaks():
            yield (place - self.first) % (2.0 * math.pi)

    def at(self, mechanism: Mechanism, phi: Reals, sense: float) -> list[Force | Torque]:
        """All of them."""
        return self.sources.at(mechanism, phi + self.first, sense)
