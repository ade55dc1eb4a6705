"""A cycloidal reducer: ratio, profile, forces of its pins, efficiency, backlash."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.real_speed import RealSpeed
from gearlink.core.base.remedies.ways import either
from gearlink.core.base.report import Check, Shown, Status, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, within
from gearlink.core.parts.gears.codes import DISC_INTERFERENCE, PITTING, SHORTENING, UNDERCUT
from gearlink.core.parts.linkages.codes import GEAR_COLLISION, SHAFT_CLEARANCE

if TYPE_CHECKING:
    from gearlink.core.machines.cycloidal.disc import Disc
    from gearlink.core.machines.cycloidal.spec import CycloidalReducerSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme

TURN = 2.0 * math.pi
_N_MM = 1e3
_SIZES = (
    "ratio", "lobes", "shortening", "min_curvature_radius", "pressure_angle_min", "pressure_angle_mean",
    "pressure_angle_max", "output_hole_radius", "input_speed", "turn_time",
)  # fmt: skip
_FORCES = ("pin_force_max", "contact_stress", "output_pin_force_max", "efficiency", "backlash")
_CHECKS = ("undercut", "gear-collision", "shaft-clearance", "interference", "shortening", "pitting")
_NEAR = 0.8
_USUAL = (0.4, 0.8)
_PROFILE_ROWS = 1440
_SEARCHES = {
    "pin_force_max": ("_pushed",),
    "contact_stress": ("_stressed",),
    "output_pin_force_max": ("_pushed_out",),
    "backlash": ("tightest", "_closest"),
}
_CHECKED = ("contact_stress", "backlash")


class CycloidalReducer(RealSpeed, Design):
    """Discs with lobes on an eccentric that roll in a ring of pins."""

    kind = "cycloidal-reducer"
    spec: CycloidalReducerSpec
    keys = {
        "analyze": (
            "ratio",
            "efficiency",
            "contact_stress",
            "pin_force_max",
            "output_pin_force_max",
            "backlash",
            "min_curvature_radius",
            "pressure_angle_max",
            "output_hole_radius",
            "lobes",
        )
    }
    outlines = {"analyze": Outline((*_SIZES, *_FORCES), _CHECKS, ("pins",))}
    extra_tables = ("profile",)
    requirements = Design.requirements | {"torque", "pins", "fixed"}
    ways = {
        "undercut": either("pin_radius", "eccentricity", "pin_circle_radius"),
        "gear-collision": either("pin_radius", "pin_circle_radius"),
        "shaft-clearance": either("output_pins.radius", "output_pins.circle_radius", "bearing_radius"),
        "interference": either("modification.offset"),
        "pitting": either("width", "pin_radius", "pin_circle_radius"),
    }

    at_once = 64

    @classmethod
    def find_together(cls, designs: Sequence[Any], names: Sequence[str]) -> None:
        """Forces and gaps of reducers with as many pins are sought together."""
        from gearlink.core.base.many_designs import hand_out, sought, together

        alike = ("pins", "count", "fixed", "loads")

        def find(some: Sequence[Any]) -> None:
            first, many = some[0], cls(together([design.spec for design in some], alike))
            wanted = {"pin_force_max": first.worst_torque, "output_pin_force_max": first.worst_torque,
                      "contact_stress": first.worst_torque and all(design.is_stressed for design in some),
                      "backlash": first.spec.modification}  # fmt: skip
            for name, there in wanted.items():
                if there and (name in names or name in _CHECKED):
                    hand_out(many, some, *_SEARCHES[name])

        sought(find, designs)

    # Geometry

    @cached_property
    def disc(self) -> Disc:
        """The disc for the pins as they are."""
        from gearlink.core.machines.cycloidal.disc import Disc

        spec = self.spec
        return Disc(spec.pins, spec.pin_circle_radius, spec.pin_radius, spec.eccentricity)

    @property
    def changes(self) -> tuple[float, float]:
        """Offset and pin circle of the modification [mm]."""
        found = self.spec.modification
        return (0.0, 0.0) if found is None else (found.offset, found.pin_circle)

    lobes: int = placed("disc.lobes")
    shortening: float = placed("disc.shortening")
    min_curvature_radius: float = placed("disc.min_convex_radius")

    @property
    def ratio(self) -> int:
        """Speed of the input over that of the output: -z with the ring held, Z with the output pins held."""
        return -self.disc.lobes if self.spec.fixed == "ring" else self.disc.pins

    @property
    def output_hole_radius(self) -> float | None:
        """Radius of the holes for the output pins [mm]: r_w + e."""
        pins = self.spec.output_pins
        return None if pins is None else pins.radius + self.spec.eccentricity

    @cached_property
    def _pressure_angles(self) -> Reals:
        """Between normal and motion of the contact point of the disc, at each pin that pushes, eccentric at 0 [rad]."""
        import numpy as np

        shares = self.disc.shares(np.zeros(1))
        loaded = shares.pins[0] > 0.0
        arm = shares.places[0][loaded] - self.spec.eccentricity
        seen = np.conj(arm) * shares.normals[0][loaded]
        return np.asarray(np.arctan2(np.abs(seen.real), np.abs(seen.imag)))

    @property
    def pressure_angle_min(self) -> float:
        """Minimum pressure angle at the pins that push, eccentric at 0 [rad]."""
        return float(self._pressure_angles.min())

    @property
    def pressure_angle_mean(self) -> float:
        """Their mean [rad]."""
        return float(self._pressure_angles.mean())

    @property
    def pressure_angle_max(self) -> float:
        """Their maximum [rad]."""
        return float(self._pressure_angles.max())

    # Forces

    @property
    def disc_torque(self) -> float | None:
        """Mean torque of a disc about its centre [N mm].

        torque/discs with the ring held; with the output pins held the ring bears the torque, of which z/Z is a disc's
        """
        if self.spec.torque is None:
            return None
        share = 1.0 if self.spec.fixed == "ring" else self.disc.lobes / self.disc.pins
        return _N_MM * share * self.spec.torque / self.spec.discs

    @property
    def worst_torque(self) -> float | None:
        """Torque of the disc that carries most [N mm]."""
        return None if self.disc_torque is None else self.disc_torque * self.spec.uneven

    def needs(self, name: str, /) -> str:
        """What a quantity rests on."""
        if name in ("pin_force_max", "contact_stress", "output_pin_force_max", "efficiency") and not self.spec.torque:
            return "torque"
        return {
            "contact_stress": "width", "output_pin_force_max": "output_pins", "efficiency": "friction",
            "backlash": "modification",
        }.get(name, "")  # fmt: skip

    def _over_pitch(self, pins: int, course: Callable[[Reals], Reals]) -> Extreme:
        """Maximum value over the eccentric's angle, which repeats after a pitch; a pin begins or ends to push."""
        from gearlink.core.numerics.extremes import maximum_over

        pitch = TURN / pins
        return maximum_over(course, 0.0, pitch, joints=(0.5 * pitch,), samples=256)

    @cached_property
    def _pushed(self) -> Extreme:
        """Maximum force of a ring pin, per N mm of the torque on its disc [1/mm]."""
        return self._over_pitch(self.disc.pins, lambda phi: self.disc.shares(phi).pins.max(axis=-1))

    @property
    def pin_force_max(self) -> float | None:
        """Maximum force of a ring pin [N]."""
        return None if self.worst_torque is None else self.worst_torque * self._pushed.value

    def stresses(self, phi: Reals) -> Reals:
        """Contact stress of every ring pin at angles of the eccentric, (N, Z) [N/mm^2].

        sqrt(F E*/(pi b) (1/r_p + 1/(rho - r_p)))
        """
        import numpy as np

        from gearlink.core.machines.cycloidal.disc import deep
        from gearlink.core.studies.loads.contact import plane_modulus

        assert self.worst_torque is not None
        assert self.spec.width is not None
        disc, material = self.disc.deepened, self.spec.material
        u = (TURN / disc.pins) * np.arange(disc.pins) - phi[..., None]
        bend = disc.curvature(u)
        relative = 1.0 / (disc.pin * (1.0 - bend * disc.pin))
        force = deep(self.worst_torque) * self.disc.shares(phi).pins
        modulus = plane_modulus(deep(material.elastic_modulus), deep(material.poisson))
        return np.asarray(np.sqrt(force * modulus * relative / (math.pi * deep(self.spec.width))))

    @property
    def is_stressed(self) -> bool:
        """Whether torque and width are given, and no flank is undercut."""
        given = self.worst_torque is not None and self.spec.width is not None
        return given and self.disc.pin < self.min_curvature_radius

    @cached_property
    def _stressed(self) -> Extreme:
        return self._over_pitch(self.disc.pins, lambda phi: self.stresses(phi).max(axis=-1))

    @property
    def contact_stress(self) -> float | None:
        """Maximum contact stress of a ring pin [N/mm^2]; None where an undercut flank has none."""
        return self._stressed.value if self.is_stressed else None

    @cached_property
    def _pushed_out(self) -> Extreme | None:
        """Maximum force of an output pin, per N mm of the torque on a disc [1/mm]."""
        pins = self.spec.output_pins
        if pins is None:
            return None
        count, circle = pins.count, pins.circle_radius
        return self._over_pitch(count, lambda phi: self.disc.shares(phi, count, circle).outputs.max(axis=-1))

    @property
    def output_pin_force_max(self) -> float | None:
        """Maximum force of an output pin [N]."""
        most, torque = self._pushed_out, self.worst_torque
        return None if most is None or torque is None else torque * most.value

    def _losses(self, phi: Reals) -> Reals:
        """Work lost at one disc per radian of the input, per N mm of its torque.

        mu_1 sum F |q - pitch point| w_1 + mu_2 e w_2 sum Q + mu_3 r_b |sum F n + sum Q| w_2,  w_1, w_2 turning of disc
        against ring, and of the eccentric against the disc.
        """
        import numpy as np

        assert self.spec.friction is not None
        assert self.spec.output_pins is not None
        pins, mu = self.spec.output_pins, self.spec.friction
        disc, e = self.disc, self.spec.eccentricity
        shares = disc.shares(phi, pins.count, pins.circle_radius)
        held = self.spec.fixed == "output"
        rolling = 1.0 / (disc.pins if held else disc.lobes)
        swinging = 1.0 if held else 1.0 + 1.0 / disc.lobes
        slide = np.sum(shares.pins * np.abs(shares.places - e * disc.pins), axis=1)
        outputs = np.sum(shares.outputs, axis=1)
        bearing = np.abs(shares.of_ring + outputs) * (self.spec.bearing_radius or 0.0)
        return np.asarray(mu.pins * slide * rolling + (mu.output_pins * e * outputs + mu.bearing * bearing) * swinging)

    @cached_property
    def efficiency(self) -> float | None:
        """Estimate from the forces without loss, mean over a revolution of the eccentric.

        1/(1 + loss), loss per unit of the output's work; churning and seals are not in it. In the eccentric's bearing
        ring pins and output pins are counted as pushing the same way, which is on the safe side.
        """
        import numpy as np

        from gearlink.core.numerics.gauss import gauss_legendre

        pins, torque = self.spec.output_pins, self.disc_torque
        if self.spec.friction is None or pins is None or torque is None:
            return None
        nodes, weights = gauss_legendre(6)
        count = 2 * math.lcm(self.disc.pins, pins.count)
        step = TURN / count
        edges = step * np.arange(count)
        mean = 0.0
        for part in np.array_split(edges, max(1, len(edges) // 256)):
            phi = (part[:, None] + 0.5 * step * (nodes + 1.0)).ravel()
            mean += float(np.sum(self._losses(phi).reshape(-1, nodes.size) @ weights)) * 0.5 * step / TURN
        lost = self.spec.discs * torque / _N_MM * mean
        work = (self.spec.torque or 0.0) / abs(self.ratio)
        return work / (work + lost)

    # Backlash

    @cached_property
    def tightest(self) -> Extreme | None:
        """Minimum gap of the modified profile over 0 < u < 180 deg [mm], and where."""
        if self.spec.modification is None:
            return None
        from gearlink.core.numerics.extremes import minimum_over

        return minimum_over(lambda u: self.disc.gap(u, *self.changes), 0.0, math.pi)

    @cached_property
    def _closest(self) -> Extreme:
        """Minimum turn of the disc to one flank [rad], and where."""
        from gearlink.core.numerics.extremes import minimum_over

        inside = 1e-6
        return minimum_over(lambda u: self.disc.gap(u, *self.changes) / self.disc.lever(u), inside, math.pi - inside)

    @property
    def backlash(self) -> float | None:
        """Turn of the disc between both flanks [rad]: 2 min gap Q/(e z sin u); None where disc and pins interfere."""
        return None if self.tightest is None or self.tightest.value < 0.0 else 2.0 * self._closest.value

    # Tables

    def table_pins(self, _samples: int | None = None) -> Table:
        """The ring pins with the eccentric at 0: lever, force, contact stress, gap."""
        import numpy as np

        disc, numbers = self.disc, np.arange(self.disc.pins)
        u, at = (TURN / disc.pins) * numbers.astype(np.float64), np.zeros(1)
        columns: dict[str, tuple[Any, str]] = {
            "pin": (numbers + 1, ""),
            "angle": (np.degrees(u), "deg"),
            "lever": (np.abs(disc.lever(u)), "mm"),
        }
        if self.worst_torque is not None:
            columns["force"] = self.worst_torque * disc.shares(at).pins[0], "N"
            if self.is_stressed:
                columns["stress"] = self.stresses(at)[0], "N/mm^2"
        columns["gap"] = disc.gap(u, *self.changes), "mm"
        return Table.of("pins", columns)

    def table_profile(self, samples: int | None = None) -> Table:
        """The ground profile of a disc in its own frame, with its own radius of curvature."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples or _PROFILE_ROWS)
        points, radius = self.disc.ground(*self.changes).profile(np.radians(degrees))
        columns = {
            "parameter": (degrees, "deg"),
            "x": (points.real, "mm"),
            "y": (points.imag, "mm"),
            "curvature_radius": (radius, "mm"),
        }
        return Table.of("profile", columns)

    # Checks

    def check_undercut(self) -> Check:
        """GL201: the pin's radius against the minimum convex radius of the pitch curve."""
        radius, least = self.spec.pin_radius, self.min_curvature_radius
        share = radius / least
        status: Status = "fail" if share >= 1.0 else "warn" if share > _NEAR else "pass"
        what, most = "pin radius against the minimum convex radius of the pitch curve", _NEAR * least
        fix = f"set pin_radius to at most {safely_below(most)} mm"
        return UNDERCUT.check(status, what, radius, least, "mm", side="<=", recommended=most, fix=fix)

    def check_gear_collision(self) -> Check:
        """GL301: ring pins beside each other."""
        gap = 2.0 * (self.spec.pin_circle_radius * math.sin(math.pi / self.spec.pins) - self.spec.pin_radius)
        what, overlap = "gap between two ring pins", "overlap of two ring pins"
        fix = f"set pin_radius below {safely_below(self.spec.pin_radius + 0.5 * gap)} mm"
        status: Status = "fail" if gap <= 0.0 else "pass"
        return GEAR_COLLISION.check(status, what, gap, 0.0, "mm", overlap=overlap, fix=fix)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: webs between the holes for the output pins, to the bearing's bore and to the root of the lobes."""
        pins, hole = self.spec.output_pins, self.output_hole_radius
        if pins is None or hole is None:
            return
        ground = self.disc.ground(*self.changes)
        root = ground.circle - ground.eccentricity - ground.pin
        webs = [
            ("between two holes for output pins", 2.0 * (pins.circle_radius * math.sin(math.pi / pins.count) - hole)),
            ("between the holes for output pins and the roots of the lobes", root - pins.circle_radius - hole),
        ]
        if self.spec.bearing_radius is not None:
            webs.append(
                (
                    "between the holes for output pins and the bearing",
                    pins.circle_radius - hole - self.spec.bearing_radius,
                )
            )
        for i, (where, web) in enumerate(webs):
            status: Status = "fail" if web <= 0.0 else "pass"
            most = pins.radius + (1.0 if i else 0.5) * web  # both holes shrink
            fix = f"set output_pins.radius below {safely_below(most)} mm" if most > 0.0 else "use thinner output pins"
            overlap = f"overlap {where}"
            yield SHAFT_CLEARANCE.check(status, f"web {where}", web, 0.0, "mm", overlap=overlap, fix=fix)

    def check_interference(self) -> Iterator[Check]:
        """GL342."""
        if self.tightest is None:
            return
        gap = self.tightest.value
        what, overlap = "minimum gap between disc and pins", "interference of disc and pins"
        fix = f"set modification.offset to at least {safely_above(self.changes[0] - gap)} mm"
        status: Status = "fail" if gap < 0.0 else "pass"
        yield DISC_INTERFERENCE.check(status, what, gap, 0.0, "mm", overlap=overlap, fix=fix)

    def check_shortening(self) -> Check:
        """GL343."""
        k, (low, high) = self.shortening, _USUAL
        limit = low if k < low else high
        what, aside = "shortening coefficient e Z/R", f"usual {low:g} to {high:g}"
        fix = "increase eccentricity"
        if k:
            per = self.spec.eccentricity / k
            fix = f"set eccentricity from {within(per * low, per * high, 'mm')}"
        status: Status = "pass" if low <= k <= high else "warn"
        return SHORTENING.check(status, what, k, limit, shown=Shown(k), aside=aside, fix=fix)

    def check_pitting(self) -> Iterator[Check]:
        """GL210: what the material bears over the maximum contact stress."""
        stress, bears = self.contact_stress, self.spec.material.contact_limit
        if stress is None or bears is None:
            return
        safety, limit = bears / stress, self.spec.limits.safety_pitting
        status: Status = "fail" if safety < limit else "pass"
        aside = f"contact stress {short(stress)} N/mm^2"
        assert self.spec.width is not None  # where there is a stress
        fix = f"set width to at least {safely_above(self.spec.width * (limit / safety) ** 2)} mm"
        yield PITTING.check(status, "pitting safety S_H", safety, limit, aside=aside, fix=fix)
