"""The register between members at the print: what the errors of each member's parts cost there, and all together."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.design import Design, Outline, geometry
from gearlink.core.base.errors import MissingSection, in_section
from gearlink.core.base.report import Check, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.machine.design import Machine
from gearlink.core.machines.machine.speeds import speed_changes
from gearlink.core.studies.tolerance.budget import Budget, Contribution, budget, budget_table, tightened

if TYPE_CHECKING:
    from gearlink.core.machines.machine.loads import MachineLoads
    from gearlink.core.machines.machine.spec import MachineRegister, MachineSpec
    from gearlink.core.studies.register import RegisterDesign

_ROOT_2 = math.sqrt(2.0)


class Share(NamedTuple):
    """What a member costs at the print.

    Fields
        gain : float - its share in the chain, signed
        angle : float [deg] - its own input there
        parts : of its sources there times the gain, for the torque sign with the larger band
        correlations : of them, by pairs
        wind_up : float [mm] - what the main shaft's wind-up moves its output, times the gain
    """

    gain: float
    angle: float
    parts: tuple[Contribution, ...]
    correlations: Mapping[tuple[str, str], float]
    wind_up: float

    @property
    def budget(self) -> Budget:
        """Of the member alone."""
        return budget(self.parts, None, self.correlations)


class RegisterOfMachine(Design):
    """The members of `register.chain`, each with its own sources at its own input at the print."""

    kind = "machine"
    repairable = False
    spec: MachineSpec
    outlines = {
        "register": Outline(
            ("worst", "rss", "band", "wind_up_at_print", "machine_yield"), ("register-budget",), ("shares", "budget")
        )
    }
    advises = False
    design = geometry(Machine)

    @cached_property
    def section(self) -> MachineRegister:
        """The section `register`.

        Raises
            MissingSection
        """
        if self.spec.register_ is None:
            message = "`register` needs the section register: {at: 214, chain: {feed: 1, gripper: -1}}"
            raise MissingSection(message, key="register")
        return self.spec.register_

    def require_named(self) -> None:
        """Refuse sources and places that the members do not have."""
        _ = self.shares

    @cached_property
    def shares(self) -> Mapping[str, Share]:
        """By member."""
        return {name: self._share(name, gain) for name, gain in self.section.chain.items()}

    def _share(self, name: str, gain: float) -> Share:
        import numpy as np

        from gearlink.core.studies.register import SIGNS

        place = self.design.members[name]
        angle = math.radians(self.section.at - self.design.phases[self.spec.root(name)])
        u, rate = place.input(np.array([angle]), 1)
        own = place.reduced(u)[0]
        with in_section(f"members.{name}.design"):
            member = self.spec.members[name]
            if "register" not in member.kind.commands or not getattr(member.spec, "tolerance", None):
                message = f"{name} is listed in register.chain"
                raise MissingSection(message, key="tolerance.sources", fix="give it tolerance: {sources: {...}}")
            register: RegisterDesign = member.kind.design("register", self._spec_of(name, float(own[0]) / place.scale))  # type: ignore[assignment]
            sign = max(SIGNS, key=lambda each: float(register.budgets[SIGNS.index(each)].band.max()))
            parts = tuple(
                replace(one, gain=gain * one.gain) for one in register.contributions(register.input_angles, sign)
            )
            moved = float(
                register.output(own)(register.mechanism(own), None)[1][0] * rate[0]
            )  # mm per rad of the machine
        wind_up = gain * moved * self._twist(name)
        return Share(gain, float(own[0]) / place.scale, parts, register.correlations, wind_up)

    def _spec_of(self, name: str, angle: float) -> Any:
        """The spec of a member that looks at its register where its input stands [deg]."""
        return self.spec.members[name].changed([("register.at", angle), *speed_changes(self.spec, name)])

    def _twist(self, name: str) -> float:
        """Wind-up of the main shaft at a member at the print [rad]; 0 without shaft or loads."""
        return self._loads.twist_at(name, self.section.at) if self._winds_up else 0.0

    @property
    def _winds_up(self) -> bool:
        given = any(getattr(member.spec, "loads", None) is not None for member in self.spec.members.values())
        return given and self.spec.shaft is not None and self.spec.speed is not None

    @cached_property
    def _loads(self) -> MachineLoads:
        from gearlink.core.machines.machine.loads import MachineLoads  # with the loads, where they are wanted

        return self.of_file(MachineLoads)

    # Results

    @cached_property
    def whole(self) -> Budget:
        """Of all sources of all members, which vary each by themselves."""
        return budget(self._parts, None, self._correlations)

    @cached_property
    def _parts(self) -> list[Contribution]:
        named = ((name, one) for name, each in self.shares.items() for one in each.parts)
        return [replace(one, source=_of_member(one.source, name)) for name, one in named]

    @property
    def _correlations(self) -> dict[tuple[str, str], float]:
        return {
            (_of_member(one, name), _of_member(other, name)): rho
            for name, each in self.shares.items()
            for (one, other), rho in each.correlations.items()
        }

    @property
    def worst(self) -> float:
        """Error where all sources of all members add up [mm]."""
        return float(self.whole.worst[0])

    @property
    def rss(self) -> float:
        """Standard deviation of the error [mm]."""
        return float(self.whole.rss[0])

    @property
    def mean(self) -> float:
        """What all machines have alike [mm]."""
        return float(self.whole.mean[0])

    @property
    def band(self) -> float:
        """What 99.73 % of the machines keep by a normal law, to either side [mm]."""
        return float(self.whole.band[0])

    @property
    def wind_up_at_print(self) -> float | None:
        """What the wind-up of the main shaft moves the register [mm]: alike in every machine, set right at speed."""
        found = sum(each.wind_up for each in self.shares.values())
        return found if self._winds_up else None

    @property
    def machine_yield(self) -> float | None:
        """Share of the machines whose error is within the tolerance, by the normal law; None without one."""
        limit = self.section.tolerance
        if limit is None:
            return None
        if self.rss == 0.0:
            return float(abs(self.mean) <= limit)
        low, high = ((sign * limit - self.mean) / self.rss / _ROOT_2 for sign in (-1.0, 1.0))
        return 0.5 * (math.erf(high) - math.erf(low))

    # Tables and checks

    def table_shares(self, _samples: int | None = None) -> Table:
        """What each member gives."""
        variance = self.rss**2
        rows = []
        for name, each in self.shares.items():
            own = each.budget
            sigma = float(own.rss[0])
            share = sigma**2 / variance if variance > 0.0 else 0.0
            rows.append((name, each.gain, each.angle, float(own.worst[0]), sigma, share, each.wind_up))
        columns = ("member", "gain", "member_input", "worst", "sigma", "share", "wind_up")
        units = ("1", "1", "deg", "mm", "mm", "1", "mm")
        return Table("shares", columns, units, tuple(zip(*rows, strict=True)))

    def table_budget(self, _samples: int | None = None) -> Table:
        """Every source of every member, the maximum first; gains and shares are those of the whole."""
        sources = [(name, one.source) for name, each in self.shares.items() for one in each.parts]
        rows = [
            (name, replace(row, source=source)) for (name, source), row in zip(sources, self.whole.rows, strict=True)
        ]
        return budget_table("member", sorted(rows, key=lambda row: -row[1].share))

    def check_register_budget(self) -> Iterator[Check]:
        """GL520 where the file names what may be lost."""
        from gearlink.core.studies.register import budget_check, tighter

        limit = self.section.tolerance
        if limit is None:
            return
        kept = float(self.whole.kept[0])
        status: Status = "fail" if kept > limit else "warn" if self.worst > limit else "pass"
        fix, at_worst = "", status == "warn"
        if status != "pass":
            found = tightened([self._parts], None, self._correlations, limit, at_worst=at_worst)
            fix = tighter(found, len(self._parts))
        at = f"{short(self.section.at)} deg"
        yield budget_check(status, "register error", kept, self.worst, limit, fix, at=at)


def _of_member(source: str, name: str) -> str:
    return f"{source} of {name}"
