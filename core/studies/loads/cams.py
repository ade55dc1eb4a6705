"""What `loads` adds for a machine with cams: contact forces, pressures, rollers, torque, table `contact`, checks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from gearlink.core.base.design import placed
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import at_least, at_most
from gearlink.core.base.report import NO_NUMBER, Check, Remedy, Status, Table, safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed, number_at
from gearlink.core.base.wording import amount, short
from gearlink.core.mechanism.joints import NEWTON_METER
from gearlink.core.numerics.arrays import Reals, turn_degrees
from gearlink.core.studies.codes import CONTACT_LOSS, CONTACT_PRESSURE, LOAD_REVERSAL, PRELOAD, ROLLER_SKID
from gearlink.core.studies.loads.checks import listed, load_reversal
from gearlink.core.studies.loads.design import LoadsDesign, Wanted, at_extreme
from gearlink.core.studies.loads.names import RPM

if TYPE_CHECKING:
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.studies.loads.contact import LineContact, RollerOnCam
    from gearlink.core.studies.loads.machine import Machine


CAM_CHECKS = ("contact-pressure", "contact-loss", "roller-skid", "preload")
_NEAR = 0.9
_LEAST_SHARE = 0.1


def no_width(allowed: float) -> Check:
    """GL607 of a file that allows a pressure, and gives no width."""
    what, fix = "no contact pressure without the width of the contact", "give loads.roller: {width: mm}"
    return CONTACT_PRESSURE.check("warn", what, None, allowed, "N/mm^2", fix=fix)


def pressed_where_undercut(words: str, allowed: float) -> Check:
    """GL607 of a roller that would press where its profile is cut away."""
    what, fix = f"{words} is undercut: no contact pressure", "enlarge the cam, or use a smaller roller"
    return CONTACT_PRESSURE.check("fail", what, None, allowed, "N/mm^2", fix=fix)


def pressure_check(what: str, found: float, allowed: float, at: str) -> Check:
    """GL607 of a contact pressure [N/mm^2]."""
    status: Status = "fail" if found > allowed else "warn" if found > _NEAR * allowed else "pass"
    fix = "use a wider roller"
    most = _NEAR * allowed
    return CONTACT_PRESSURE.check(status, what, found, allowed, "N/mm^2", recommended=most, at=at, fix=fix)


def contact_table(design: CamLoadsDesign, samples: int | None = None) -> Table:
    """Force, pressure, relative radius, roller speed and entrainment of each roller over the input angle."""
    degrees = turn_degrees(samples, design.turns)
    phi = np.radians(degrees)
    columns: dict[str, tuple[Any, str]] = {"cam_angle": (design.cam_degrees(phi), "deg")}
    for i, name in enumerate(design.own_rollers):
        roller, line = design.roller_on_cam(name, phi), design.contact(name, phi)
        none = np.full_like(phi, math.nan)
        later = "" if i == 0 else f"{name}_"
        columns |= {
            f"{name}_force": (design.contact_force(name, phi), "N"),
            f"{name}_pressure": (none if line is None else line.pressure, "N/mm^2"),
            f"{name}_radius": (roller.relative_radius, "mm"),
            f"{later}roller_speed": (design.roller_speed(name, phi) / RPM, "1/min"),
            f"{later}entrainment": (design.entrainment(name, phi), "mm/s"),
        }
    return Table.of("contact", columns)


CONTACT = (
    "contact_force_max",
    "contact_force_min",
    "hertz_pressure_max",
    "shear_depth",
    "roller_speed_max",
    "roller_acceleration_max",
    "traction_needed",
    "entrainment_speed_max",
    "cam_torque_max",
    "cam_torque_min",
    "cam_torque_rms",
    "preload_needed",
)
_DERIVED = frozenset(CONTACT) - {"contact_force_max", "contact_force_min", "hertz_pressure_max"}
_OF_EXTREMES = frozenset(CONTACT) - {"traction_needed", "cam_torque_rms", "preload_needed"}


def _preload_fix(needed: float) -> str:
    return f"set loads.roller.preload to {safely_above(needed)}"


class CamLoadsDesign(LoadsDesign):
    """Loads of a machine with rollers on cams; a subclass says where they are and how hard they press.

    Quantities of the contact are lists, a value for each of `rollers`.
    """

    extra_tables: ClassVar[tuple[str, ...]] = (*LoadsDesign.extra_tables, "contact")
    rollers: ClassVar[tuple[str, ...]] = ("main", "return")
    derived = LoadsDesign.derived | _DERIVED
    repaired_where_they_warn = frozenset(("roller-skid",))
    on_two_sides: ClassVar[bool] = False
    """Whether the cams take the force of a follower in either sense."""
    has_pair: ClassVar[bool] = False
    """Whether one follower has two rollers on two cams, which a preload presses on both."""

    @cached_property
    def machine(self) -> Machine:
        self.require_pair()
        return super().machine

    def require_pair(self) -> None:
        """Refuse a preload or its stiffness where no pair of rollers has it."""
        for key in ("preload", "stiffness") if self.section.roller is not None and not self.has_pair else ():
            if getattr(self.section.roller, key):
                words = f"{key} applies to two rollers of one follower on two cams, which this design does not have"
                raise NoSolution(words, key=f"loads.roller.{key}", fix="omit it")

    @property
    def roller_stiffness(self) -> tuple[float, float]:
        """Stiffness of the contacts of both rollers, in one unit; equal where the file gives none."""
        roller = self.section.roller
        if roller is None or roller.stiffness is None:
            return 1.0, 1.0
        return roller.stiffness[0], roller.stiffness[1]

    def roller_at(self, name: str, phi: Reals) -> RollerOnCam:
        """A roller at input angles, with derivatives by the turned angle of its cam."""
        raise NotImplementedError

    def roller_on_cam(self, name: str, phi: Reals) -> RollerOnCam:
        """The same, made once for links that are kept."""
        return self.machine.at(phi).once(f"roller {name}", lambda: self.roller_at(name, phi))

    def contact_force(self, name: str, phi: Reals) -> Reals:
        """Force between a roller and its cam at input angles [N]; a negative one is pulled."""
        raise NotImplementedError

    def cam_speed(self, phi: Reals) -> Reals:
        """Magnitude of the speed of the cam [rad/s]; the input's where the cam turns with it."""
        return np.full_like(phi, self.speed)

    def cam_acceleration(self, phi: Reals) -> Reals:
        """Its derivative by time [rad/s^2]."""
        return np.zeros_like(phi)

    def cam_degrees(self, phi: Reals) -> Reals:
        """Cam angle at input angles [deg]; the input's where the cam turns with it."""
        return np.degrees(phi)

    def called(self, name: str) -> str:
        """What messages call a roller."""
        return f"{name} roller" if len(self.own_rollers) > 1 else "roller"

    @property
    def closing_remedy(self) -> str:
        """What would press the rollers harder to their cams."""
        return "increase the contact force, reduce the speed, or use a lighter follower"

    @cached_property
    def own_rollers(self) -> tuple[str, ...]:
        """The rollers that this design has."""
        return self.rollers

    def contact(self, name: str, phi: Reals) -> LineContact | None:
        """The Hertzian contact of a roller; None where the file gives no width."""
        if self.section.roller is None:
            return None
        return self.machine.at(phi).once(f"contact {name}", lambda: self._contact_at(name, phi))

    def _contact_at(self, name: str, phi: Reals) -> LineContact | None:
        from gearlink.core.studies.loads.contact import contact_of

        return contact_of(self.section, self.contact_force(name, phi), self.roller_on_cam(name, phi).relative_radius)

    def course(self, name: str) -> Callable[[Reals], Reals]:
        """Those of the rollers as well, `contact_force:main`."""
        what, _, roller = name.partition(":")
        if what == "cam_torque":
            return self.cam_torque
        return partial(self._of_roller(what), roller) if roller else super().course(name)

    def _of_roller(self, what: str) -> Callable[[str, Reals], Reals]:
        return {
            "contact_force": self.contact_force,
            "hertz_pressure": lambda name, phi: self._where_pressed(name, phi, "pressure"),
            "shear_depth": lambda name, phi: self._where_pressed(name, phi, "shear_depth"),
            "radius": self._radius,
            "radius_anywhere": lambda name, phi: self.roller_on_cam(name, phi).relative_radius,
            "traction": self.traction,
            "roller_speed": lambda name, phi: abs(self.roller_speed(name, phi)),
            "roller_acceleration": lambda name, phi: abs(self.roller_acceleration(name, phi)),
            "entrainment_speed": lambda name, phi: abs(self.entrainment(name, phi)),
        }[what]

    def wanted(self, quantity: str) -> Iterable[Wanted]:
        if quantity not in _OF_EXTREMES:
            return super().wanted(quantity)
        course, greatest = quantity.removesuffix("_max").removesuffix("_min"), not quantity.endswith("_min")
        if course == "cam_torque":
            return ((course, greatest),)
        found = [(f"{course}:{name}", greatest) for name in self.own_rollers]
        if course in ("hertz_pressure", "shear_depth"):
            found += [(f"radius_anywhere:{name}", False) for name in self.own_rollers]
            return found if self.section.roller is not None else ()
        return found

    def _each(self, course: str, greatest: bool = True) -> list[Extreme]:
        return [self.extreme_of(f"{course}:{name}", greatest) for name in self.own_rollers]

    def _where_pressed(self, name: str, phi: Reals, what: str) -> Reals:
        """Pressure or depth of a roller that is pressed; 0 where it is not."""
        contact = self.contact(name, phi)
        assert contact is not None, "needed only with a width"
        return np.where(contact.force > 0.0, getattr(contact, what), 0.0)

    def _radius(self, name: str, phi: Reals) -> Reals:
        """Relative radius of a roller that is pressed [mm]; its own where it is not, by which no minimum is found."""
        roller = self.roller_on_cam(name, phi)
        return np.where(self.contact_force(name, phi) > 0.0, roller.relative_radius, roller.radius)

    def _each_pressed(self, course: str) -> list[Extreme | None] | None:
        """The maximum value of each roller; None for one that presses on an undercut, and all without a width."""
        if self.section.roller is None:
            return None
        pairs = zip(self.own_rollers, self._each(course), strict=True)
        return [None if self._is_pressed_on_undercut(name) else found for name, found in pairs]

    def _is_pressed_on_undercut(self, name: str) -> bool:
        """Whether a roller presses where its cam has no profile; where it presses is asked only if there is such."""
        if self.extreme_of(f"radius_anywhere:{name}", False).value > 0.0:
            return False
        return self.extreme_of(f"radius:{name}", False).value <= 0.0

    @cached_property
    def force_extremes(self) -> list[tuple[Extreme, Extreme]]:
        """Minimum and maximum force of each roller [N]."""
        return list(zip(self._each("contact_force", False), self._each("contact_force"), strict=True))

    contact_force_max: list[float] = placed("force_extremes.*.1.value")
    contact_force_min: list[float] = placed("force_extremes.*.0.value")

    @cached_property
    def pressure_extremes(self) -> list[Extreme | None] | None:
        """Maximum Hertzian pressure of each roller [N/mm^2]; None where its cam is undercut, and without a width."""
        return self._each_pressed("hertz_pressure")

    @property
    def _deepest(self) -> list[Extreme | None] | None:
        """Maximum depth of the maximum shear stress of each roller [mm]."""
        return self._each_pressed("shear_depth")

    hertz_pressure_max: list[float | None] | None = placed("pressure_extremes.*.value")
    shear_depth: list[float | None] | None = placed("_deepest.*.value")

    def roller_speed(self, name: str, phi: Reals) -> Reals:
        """Speed of a roller that rolls [rad/s]."""
        found: Reals = self.roller_on_cam(name, phi).roller_speed * self.cam_speed(phi)
        return found

    def roller_acceleration(self, name: str, phi: Reals) -> Reals:
        """Angular acceleration of it [rad/s^2]."""
        roller, speed = self.roller_on_cam(name, phi), self.cam_speed(phi)
        found: Reals = roller.roller_acceleration * speed**2 + roller.roller_speed * self.cam_acceleration(phi)
        return found

    @property
    def roller_speed_max(self) -> list[float]:
        """Maximum speed of each roller [1/min]."""
        return [each.value / RPM for each in self._each("roller_speed")]

    @property
    def roller_acceleration_max(self) -> list[float]:
        """Maximum angular acceleration of each roller [rad/s^2]."""
        return [each.value for each in self._each("roller_acceleration")]

    def entrainment(self, name: str, phi: Reals) -> Reals:
        """Speed of both surfaces through the contact [mm/s]."""
        found: Reals = self.roller_on_cam(name, phi).entrainment * self.cam_speed(phi)
        return found

    @property
    def entrainment_speed_max(self) -> list[float]:
        """Maximum entrainment speed of each roller [mm/s]."""
        return [each.value for each in self._each("entrainment_speed")]

    def traction(self, name: str, phi: Reals) -> Reals:
        """Share of the contact force that drives a roller round that stays on its cam, |J_r dw/dt| and its bearing's
        moment."""
        roller = self.section.roller
        need = roller.inertia * np.abs(self.roller_acceleration(name, phi)) + roller.bearing_moment
        push = need * NEWTON_METER / self.roller_on_cam(name, phi).radius
        return np.asarray(push / self.contact_force(name, phi))

    @cached_property
    def traction_needed(self) -> list[float | None] | None:
        """Maximum share of the contact force that drives each roller round; None without a roller, and for one that
        leaves its cam: then nothing drives it."""
        roller = self.section.roller
        if roller is None:
            return None
        if not roller.inertia and not roller.bearing_moment:
            return [0.0 for _ in self.own_rollers]
        pairs = zip(self.own_rollers, self.force_extremes, strict=True)
        return [self.extreme_of(f"traction:{name}").value if low.value > 0.0 else None for name, (low, _) in pairs]

    def candidates(self, check: str, /) -> Iterable[Remedy]:
        """Of rollers that skid one as light, or with as little moment, as friction drives, or what presses as hard."""
        return self._driven() if check == "roller-skid" else super().candidates(check)

    def _driven(self) -> Iterator[Remedy]:
        roller = self.section.roller
        if not roller.friction:
            return
        pressed = [
            name for name, (low, _) in zip(self.own_rollers, self.force_extremes, strict=True) if low.value > 0.0
        ]

        def bearable(name: str, phi: Reals) -> Reals:
            """Moment with which friction can drive a roller [N m]."""
            force, radius = self.contact_force(name, phi), self.roller_on_cam(name, phi).radius
            return np.asarray(roller.friction * force * radius / NEWTON_METER)

        def turning(name: str, phi: Reals) -> Reals:
            """What is left for its own inertia, over the acceleration."""
            left = bearable(name, phi) - roller.bearing_moment
            return np.asarray(np.abs(self.roller_acceleration(name, phi)) / left)

        def resisting(name: str, phi: Reals) -> Reals:
            return np.asarray(bearable(name, phi) - roller.inertia * np.abs(self.roller_acceleration(name, phi)))

        def least(of: Callable[[str, Reals], Reals]) -> float:
            return min((self.extreme(partial(of, name), False).value for name in pressed), default=0.0)

        if least(bearable) > roller.bearing_moment:
            most = 1.0 / max(self.extreme(partial(turning, name), True).value for name in pressed)
            if most < roller.inertia:
                yield (("loads.roller.inertia", at_most(most)),)
        if 0.0 < (most := least(resisting)) < roller.bearing_moment:
            yield (("loads.roller.bearing_moment", at_most(most)),)
        yield from self._pressed()

    def _pressed(self) -> Iterator[Remedy]:
        """What presses the rollers, as much as drives them: their forces are linear in it while all are pressed."""
        roller, keys = self.section.roller, ("spring.torque", "spring.preload", "spring.least_force")
        for key in ("loads.roller.preload",) if self.has_pair else keys:
            old = number_at(self.given, key)
            if old is None:
                continue
            base = max(old, 1.1 * (self.preload_needed or 0.0))
            step = max(1.0, 0.1 * base)
            specs = [changed(self.given, ((key, value),)) for value in (base, base + step)]
            one, other = (self.varied(spec) for spec in specs if spec is not None)

            def lacking(name: str, phi: Reals, one: Any = one, other: Any = other, step: float = step) -> Reals:
                force, more = one.contact_force(name, phi), other.contact_force(name, phi)
                need = roller.inertia * np.abs(self.roller_acceleration(name, phi)) + roller.bearing_moment
                need = need * NEWTON_METER / (roller.friction * self.roller_on_cam(name, phi).radius)
                return np.asarray((need - force) * step / (more - force))

            worst = max(self.extreme(partial(lacking, name), True).value for name in self.own_rollers)
            yield from (((key, at_least(more * max(base + worst, self.preload_needed or 0.0))),) for more in (1.0, 1.2))

    def cam_torque(self, phi: Reals) -> Reals:
        """Torque that drives the cams about their axis, counter-clockwise [N m]."""
        total = 0.0 * phi
        for name in self.own_rollers:
            total = total + self.roller_on_cam(name, phi).cam_torque(self.contact_force(name, phi))
        return total

    cam_torque_max: float = at_extreme("cam_torque")
    cam_torque_min: float = at_extreme("cam_torque", False)

    @cached_property
    def cam_torque_rms(self) -> float:
        """Root mean square of it over the input angle [N m]."""
        return math.sqrt(self.machine.mean(lambda phi: self.cam_torque(phi) ** 2))

    @property
    def preload_needed(self) -> float | None:
        """Minimum preload that keeps both rollers of a positive drive on their cams [N]; None elsewhere."""
        return None

    def side_force(self, phi: Reals) -> Reals:
        """Force of a follower between two cams [N], positive on the main cam; of those `on_two_sides`."""
        raise NotImplementedError

    table_contact: Any = contact_table

    def check_contact_pressure(self) -> Iterator[Check]:
        """GL607, where the file gives an allowed pressure."""
        material = self.section.material
        allowed = None if material is None else material.allowed_pressure
        found = self.pressure_extremes
        if allowed is None:
            return
        if found is None:
            yield no_width(allowed)
            return
        for name, extreme in zip(self.own_rollers, found, strict=True):
            if extreme is None:
                yield pressed_where_undercut(f"the {self.called(name)} presses where its cam", allowed)
                continue
            at = f"{short(math.degrees(extreme.place))} deg"
            yield pressure_check(f"contact pressure of the {self.called(name)}", extreme.value, allowed, at)

    def check_contact_loss(self) -> Iterator[Check]:
        """GL608: rollers that something presses to their cams."""
        if self.on_two_sides:
            return
        for name, (low, _) in zip(self.own_rollers, self.force_extremes, strict=True):
            mean = self.machine.mean(lambda phi, name=name: np.abs(self.contact_force(name, phi)))  # type: ignore[misc]
            status: Status = "fail" if low.value < 0.0 else "warn" if low.value < _LEAST_SHARE * mean else "pass"
            yield CONTACT_LOSS.check(
                status,
                f"minimum contact force of the {self.called(name)}",
                low.value,
                0.0,
                "N",
                overlap=f"missing contact force: the {self.called(name)} leaves its cam",
                recommended=_LEAST_SHARE * mean,
                at=f"{short(math.degrees(low.place))} deg",
                fix=self.closing_remedy,
            )

    def check_roller_skid(self) -> Iterator[Check]:
        """GL609, where the file gives a roller."""
        found = self.traction_needed
        if found is None:
            return
        limit = self.section.roller.friction
        for name, share in zip(self.own_rollers, found, strict=True):
            if share is None:
                what, fix = f"the {self.called(name)} leaves its cam, where no friction drives it", "press it harder"
                yield ROLLER_SKID.check("warn", what, None, limit, fix=fix)
                continue
            what = f"friction that drives the {self.called(name)}, over its contact force"
            status: Status = "warn" if share > limit else "pass"
            yield ROLLER_SKID.check(
                status, what, share, limit, fix="use a lighter roller, or increase the contact force"
            )

    def check_preload(self) -> Iterator[Check]:
        """GL613, of a positive drive with preload."""
        needed = self.preload_needed
        if needed is None or not self.section.roller.preload:
            return
        given = self.section.roller.preload
        status: Status = "warn" if given < needed else "pass"
        fix = _preload_fix(needed)
        yield PRELOAD.check(status, "preload that holds both rollers on their cams", given, needed, "N", fix=fix)

    @property
    def _may_strike(self) -> bool:
        """Whether a follower goes from one side to the other."""
        roller = self.section.roller
        return self.on_two_sides and (roller is None or not roller.preload)

    def changing(self, names: tuple[str, ...]) -> dict[str, tuple[Callable[[Reals], Reals], float]]:
        """The side of a follower as well."""
        strikes = "load-reversal" in names and self._may_strike
        return super().changing(names) | ({"side_changes": (self.side_force, self._side_size)} if strikes else {})

    @property
    def _side_size(self) -> float:
        return max(abs(high.value) for _, high in self.force_extremes)

    @cached_property
    def side_changes(self) -> list[float]:
        """Input angles at which a follower between two cams changes sides [rad]."""
        from gearlink.core.studies.loads.joints import places

        return places(self.side_force, self.machine, self._side_size)

    def check_load_reversal(self) -> Iterator[Check]:
        """GL602: each mesh, and a follower between two cams that no preload holds to both."""
        yield from load_reversal(self)
        if not self._may_strike:
            return
        found = [math.degrees(place) for place in self.side_changes]
        if found:
            yield LOAD_REVERSAL.check(
                "warn",
                f"{self.change_of_side} {amount(len(found), 'time')} over the period and strikes there",
                float(len(found)),
                0.0,
                shown=NO_NUMBER,
                at=f"{listed(found)} deg",
                fix=self.side_remedy,
            )
        else:
            yield LOAD_REVERSAL.check("pass", "the follower stays on one side", 0.0, 0.0, shown=NO_NUMBER)

    change_of_side: ClassVar[str] = "the follower changes cams"

    @property
    def side_remedy(self) -> str:
        """What keeps a follower between two cams on both."""
        needed = self.preload_needed
        if needed is None or self.section.roller is None:
            return "press both rollers on their cams (loads.roller.preload)"
        return _preload_fix(needed)
