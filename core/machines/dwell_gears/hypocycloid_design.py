"""A dwell on an arc of a hypocycloid as a design: planet in a ring gear, rod, slider."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.real_speed import SLIDER_SPEEDS, SliderSpeed, per_time
from gearlink.core.base.remedies.ways import Way, either, up
from gearlink.core.base.report import Check, Remedy, Shown, Status, Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import short
from gearlink.core.machines.dwell_gears import hypocycloid
from gearlink.core.machines.dwell_gears.bodies import hypocycloid_layout
from gearlink.core.machines.dwell_gears.codes import DWELL_QUALITY
from gearlink.core.machines.dwell_gears.hypocycloid import HypocycloidSlider, SlottedArm
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.parts.gears.train.meshed import QUANTITIES as OF_MESH
from gearlink.core.parts.gears.train.meshed import TRAIN_CHECKS, Meshed, train_ways
from gearlink.core.parts.gears.train.single_mesh import MESH_CHECKS
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.studies.clearance.bodies import Layout
from gearlink.core.studies.clearance.checks import SHAFT_WAYS, shaft_checks

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_spec import HypocycloidDwellSpec


_ARM = (
    "steps",
    "speed_ratio_max",
    "speed_ratio_min",
    "back_step_angle",
    "tolerance_dwell_angle",
    "tolerance_dwell_start",
    "output_speed_max",
    "output_speed_min",
)
_SHARED = (
    *("planet_teeth", "ring_teeth", "carrier_length", "point_radius", "contact_ratio", "input_speed", "turn_time"),
    "dwell_time",
)


class HypocycloidDwell(SliderSpeed, Meshed):
    """Slider that dwells while a point of the planet runs along an arc about its centre, or an arm that steps."""

    kind = "hypocycloid-dwell"
    spec: HypocycloidDwellSpec
    keys = {
        "analyze": (
            ("dwell_carrier_angle", "dwell.angle"),
            "dwell_ripple",
            ("ripple_share", "<target.quality"),
            "stroke",
            "rod_length",
            "tolerance_carrier_angle",
            ("min_transmission_angle", ">limits.transmission_angle"),
            "dwell_time",
            "slider_acceleration_max",
            "velocity_max",
            "acceleration_max",
        ),
    }
    outlines = {
        "analyze": Outline(
            (
                "cusps",
                "planet_teeth",
                "ring_teeth",
                "carrier_length",
                "point_radius",
                "rod_length",
                "tangent_circle_length",
                "osculating_length",
                "dwell_carrier_angle",
                "dwell_ripple",
                "dwell_deviation_min",
                "dwell_deviation_max",
                "tolerance_carrier_angle",
                "stroke",
                "ripple_share",
                "min_transmission_angle",
                "contact_ratio",
                *names("velocity", "acceleration"),
                "input_speed",
                "turn_time",
                *SLIDER_SPEEDS,
                "dwell_time",
                *_ARM,
            ),
            ("dwell-quality", "shaft-clearance", "transmission-angle", *MESH_CHECKS),
            ("motion",),
        ),
        "gear": Outline(OF_MESH, (*MESH_CHECKS, *TRAIN_CHECKS)),
    }

    ways = {
        "shaft-clearance": SHAFT_WAYS,
        "transmission-angle": (up("rod.length"),),
        "dwell-quality": either("rod.length"),
        **train_ways(2, Way(("gears.planet", "gears.ring"), 1, "ratio")),
    }

    requirements = Meshed.requirements | {"dwell.tolerance", "dwell.angle"}
    extra_tables = ("drawing", "factors", "candidates")

    def outline(self, command: str) -> Outline:
        """Slider and arm have quantities of their own."""
        found = super().outline(command)
        if command != "analyze":
            return found
        arm = self.spec.is_arm
        shown = tuple(name for name in found.quantities if name in _SHARED or (name in _ARM) is arm)
        checks = tuple(name for name in found.checks if not arm or name != "transmission-angle")
        return found._replace(quantities=shown, checks=checks)

    @property
    def output_columns(self) -> dict[str, tuple[str, ...]]:
        """The slider's position, or the arm's angle."""
        return {"motion": ("output_angle",)} if self.spec.is_arm else {"motion": ("deviation",)}

    def raw(self, name: str) -> Any:
        """What the other output has is None."""
        if name in _ALL and name not in _SHARED and (name in _ARM) is not self.spec.is_arm:
            return None
        return super().raw(name)

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The rods of every rule side by side."""
        from gearlink.core.machines.dwell_gears.candidates import hypocycloid

        return hypocycloid(self)

    cost = 7.0  # a rod that is sought

    def candidates(self, check: str) -> Iterator[Remedy]:
        """A rod of another rule, or what the slider does over the dwell that is wanted; a curve with a cusp less."""
        if self.spec.is_arm:
            return
        if check == "dwell-quality" and self.tolerance_carrier_angle is not None:
            yield from self._better_rods()
            yield (("dwell.tolerance", math.ceil(501.0 * self.dwell_ripple) / 1000.0),)
            yield (("dwell.angle", math.floor(10.0 * math.degrees(self.tolerance_carrier_angle)) / 10.0),)
        if check == "transmission-angle":
            yield (("gears.ring", self.ring_teeth - self.planet_teeth),)

    def _better_rods(self) -> Iterator[Remedy]:
        """The rod of the minimum ripple over the dwell, to tenths and hundredths; or what is sought of it."""
        rod = self.spec.rod
        if self.spec.point.ratio != 1.0:
            return
        if rod is None:
            yield (("target.quality", "widest-dwell"),)
            return
        spec = changed(self.spec, (("rod", None), ("target", {"quality": "least-ripple"})))
        try:
            found = type(self)(spec).rod_length
        except NoSolution:  # a dwell beyond one arc has no such rod
            return
        given: Remedy = () if rod.rule is None else (("rod.rule", None),)
        yield from ((("rod.length", round(found, digits)), *given) for digits in (1, 2))

    # Gears and rod

    planet_teeth: int = placed("spec.gears.planet")
    ring_teeth: int = placed("spec.gears.ring")

    @cached_property
    def cusps(self) -> int:
        """Cusps of the curve, ring teeth over planet teeth."""
        planet, ring = self.planet_teeth, self.ring_teeth
        if (far := self.spec.point.ratio) != 1.0 and far >= ring / planet - 1.0:
            most = ring / planet - 1.0
            message = f"point.ratio must lie between 0 and ring/planet - 1 = {most:.6g}, not at {far:g}"
            raise NoSolution(message, key="point.ratio")
        if ring % planet:
            near = max(3, round(ring / planet))
            raise NoSolution(
                (
                    f"ring {ring} over planet {planet} teeth is {ring / planet:.6g}: the curve does not close "
                    "in one revolution of the carrier"
                ),
                key="gears.ring",
                fix=f"take a whole multiple, for example {near * planet}",
            )
        with at_key("gears.ring"):
            hypocycloid.require_cusps(self.point_radius, ring // planet)
        return ring // planet

    @property
    def point_radius(self) -> float:
        """Pitch radius of the planet, on which the point lies [mm]; of shifted teeth the working one."""
        if self.own_teeth:
            return self.distance() * self.planet_teeth / (self.ring_teeth - self.planet_teeth)
        return self.spec.gears.module * self.planet_teeth / 2.0

    @property
    def carrier_length(self) -> float:
        """Centre distance of planet and ring gear [mm]."""
        return self.distance()

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Planet and ring gear."""
        return self.planet_teeth, -self.ring_teeth

    @property
    def tangent_circle_length(self) -> float | None:
        """Rod of the circle through the ends and the middle of the dwell [mm]; None beside the pitch circle."""
        return self._tangent_circle if self.spec.point.ratio == 1.0 else None

    @property
    def _tangent_circle(self) -> float:
        with at_key("dwell.angle"):
            return hypocycloid.tangent_circle(self.point_radius, self.cusps, self.dwell_carrier_angle)

    @property
    def osculating_length(self) -> float | None:
        """Rod of the circle of curvature [mm]; None beside the pitch circle."""
        return self._osculating if self.spec.point.ratio == 1.0 else None

    @property
    def _osculating(self) -> float:
        return hypocycloid.osculating(self.point_radius, self.cusps)

    @property
    def dwell_carrier_angle(self) -> float:
        """Carrier angle of the dwell that is wanted [rad]."""
        asked = self.spec.dwell.angle
        return 2.0 * math.pi / self.cusps if asked is None else math.radians(asked)

    @cached_property
    def rod_length(self) -> float:
        """Rod [mm], given, by rule or by target."""
        if self.spec.target is not None:
            return self._rod_for_target(self.spec.target.quality)
        rod = self.spec.rod
        if rod is not None and rod.length is not None:
            return rod.length
        rule = None if rod is None else rod.rule
        if rule == "osculating":
            return self._osculating
        if rule == "tangent-circle":
            return self._tangent_circle
        with at_key("dwell.angle"):
            return hypocycloid.minimax(self.point_radius, self.cusps, self.dwell_carrier_angle)

    def _rod_for_target(self, quality: str) -> float:
        tolerance = self.spec.dwell.tolerance
        if quality == "widest-dwell" and tolerance is not None:
            with at_key("dwell.tolerance"):
                return hypocycloid.widest_dwell(self.point_radius, self.cusps, tolerance)
        with at_key("dwell.angle"):
            return hypocycloid.least_ripple(self.point_radius, self.cusps, self.dwell_carrier_angle)

    def completion(self) -> Iterator[Found]:
        """The rod instead of the target or the rule."""
        if not self.spec.is_arm and (self.spec.rod is None or self.spec.rod.rule is not None):
            yield Found("rod.length", self.rod_length, "found for target" if self.spec.target else "found by rod.rule")
            yield Found("rod.rule", None)
            yield Found("target", None)

    # A slotted arm

    @cached_property
    def arm(self) -> SlottedArm:
        """The kernel's view of gears and arm."""
        with at_key("point.ratio"):
            return SlottedArm(self.ring_teeth / self.planet_teeth, self.spec.point.ratio)

    @property
    def steps(self) -> int | None:
        """Steps of the arm per revolution of the carrier; None where teeth make no whole number."""
        planet, ring = self.planet_teeth, self.ring_teeth
        return None if ring % planet else ring // planet

    speed_ratio_max: float = placed("arm.speed_max")
    speed_ratio_min: float = placed("arm.speed_min")
    back_step_angle: float | None = placed("arm.back_step")
    output_speed_max: float | None = per_time("speed_ratio_max", 1)
    output_speed_min: float | None = per_time("speed_ratio_min", 1)

    @cached_property
    def _arm_dwell(self) -> tuple[float, float] | None:
        if self.spec.dwell.tolerance is None:
            return None
        with at_key("dwell.tolerance"):
            return self.arm.dwell(math.radians(self.spec.dwell.tolerance))

    tolerance_dwell_angle: float | None = placed("_arm_dwell.0")
    tolerance_dwell_start: float | None = placed("_arm_dwell.1")

    # Motion

    @cached_property
    def slider(self) -> HypocycloidSlider:
        """The kernel's view of gears and rod."""
        with at_key("rod" if self.spec.target is None else "target"):
            return HypocycloidSlider(self.point_radius, self.cusps, self.rod_length, self.spec.point.ratio)

    stroke: float = placed("slider.stroke")

    @property
    def dwell_deviation_min(self) -> float:
        """Minimum deviation in the dwell [mm]."""
        return self.slider.deviation_range(self.dwell_carrier_angle)[0]

    @property
    def dwell_deviation_max(self) -> float:
        """Maximum deviation in the dwell [mm]."""
        return self.slider.deviation_range(self.dwell_carrier_angle)[1]

    @property
    def dwell_ripple(self) -> float:
        """Range of the slider's position in the dwell [mm]."""
        return self.dwell_deviation_max - self.dwell_deviation_min

    @property
    def ripple_share(self) -> float:
        """Ripple over stroke."""
        return self.dwell_ripple / self.stroke

    @cached_property
    def tolerance_carrier_angle(self) -> float | None:
        """Widest carrier angle within the file's tolerance [rad]."""
        if self.spec.dwell.tolerance is None:
            return None
        with at_key("dwell.tolerance"):
            return self.slider.dwell_angle(self.spec.dwell.tolerance)

    velocity_max: float = placed("slider.fastest.0")
    velocity_max_at: float = placed("slider.fastest.1")

    @property
    def velocity_min(self) -> float:
        """Maximum velocity inwards, as a negative number [mm/rad]: the motion is its own mirror image."""
        return -self.slider.fastest[0]

    @property
    def velocity_min_at(self) -> float:
        """Carrier angle of it [rad]."""
        return 2.0 * math.pi - self.slider.fastest[1]

    acceleration_max: float = placed("slider.hardest.0")
    acceleration_max_at: float = placed("slider.hardest.1")
    acceleration_min: float = placed("slider.hardest_inwards.0")
    acceleration_min_at: float = placed("slider.hardest_inwards.1")
    dwell_time: float | None = per_time("_dwell_reached", -1)

    @property
    def _dwell_reached(self) -> float | None:
        """Carrier angle of the dwell within the tolerance, else of the one that is wanted [rad]."""
        if self.spec.is_arm:
            return self.tolerance_dwell_angle
        return self.tolerance_carrier_angle or self.dwell_carrier_angle

    @property
    def min_transmission_angle(self) -> float:
        """Minimum angle between the rod and the normal of the slide line over the turn [rad]."""
        return 0.5 * math.pi - self.slider.max_rod_angle

    @cached_property
    def layout(self) -> Layout:
        """The bodies in the plane of the gears."""
        return hypocycloid_layout(self)

    def table_motion(self, samples: int | None = None) -> Table:
        """Slider and point over a revolution of the carrier; the middle of the dwell is at carrier angle 0."""
        from gearlink.core.machines.dwell_gears.hypocycloid_mechanism import outwards
        from gearlink.core.mechanism.courses import Shown, coordinate, motion_table, turned

        if self.spec.is_arm:
            course, place = turned("arm"), -self.arm.ratio * self.point_radius
            of_arm = [
                Shown("output_angle", course),
                Shown("speed_ratio", course, 1, "output_speed"),
                Shown("acceleration_ratio", course, 2, "output_acceleration"),
                Shown("x", coordinate("planet", place)),
                Shown("y", coordinate("planet", place, 1j)),
            ]
            return motion_table("motion", self, of_arm, samples)
        way, point = outwards(self), -self.slider.ratio * self.slider.planet_radius
        shown = [
            Shown("deviation", way.scaled(-1.0)),
            Shown("velocity", way, 1, "slider_velocity"),
            Shown("acceleration", way, 2, "slider_acceleration"),
            Shown("rod_angle", turned("rod", sense=-1.0)),
            Shown("x", coordinate("planet", point)),
            Shown("y", coordinate("planet", point, 1j)),
        ]
        return motion_table("motion", self, shown, samples)

    # Checks

    def check_dwell_quality(self) -> Iterator[Check]:
        """GL311: the dwell that is reached within the tolerance against the one that is wanted."""
        if self.spec.is_arm:
            yield from self._arm_quality()
            return
        tolerance, reached = self.spec.dwell.tolerance, self.tolerance_carrier_angle
        if tolerance is None or reached is None:
            return
        wanted, found = math.degrees(self.dwell_carrier_angle), math.degrees(reached)
        met = found >= wanted - 1e-9
        aside = f"within +-{short(tolerance)} mm"
        if not met:
            aside += f"; the slider moves {short(self.dwell_ripple)} mm over the required angle"
        what, fix = "dwell of the slider", "allow a larger dwell.tolerance"
        shown = Shown(found, min(wanted, found) if met else wanted, "deg", ">=")
        yield DWELL_QUALITY.check(
            "pass" if met else "fail", what, found, wanted, "deg", shown=shown, aside=aside, fix=fix
        )

    def _arm_quality(self) -> Iterator[Check]:
        asked, reached, tolerance = self.spec.dwell.angle, self.tolerance_dwell_angle, self.spec.dwell.tolerance
        if asked is None or reached is None:
            return
        found = math.degrees(reached)
        met, what, fix = found >= asked - 1e-9, "dwell of the arm", "allow a larger dwell.tolerance"
        shown = Shown(found, min(asked, found) if met else asked, "deg", ">=")
        aside = "" if tolerance is None else f"within +-{short(tolerance)} deg"
        status: Status = "pass" if met else "fail"
        yield DWELL_QUALITY.check(status, what, found, asked, "deg", shown=shown, aside=aside, fix=fix)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302."""
        return shaft_checks(self.layout)

    def check_transmission_angle(self) -> Check:
        """GL303: the rod against the slide line."""
        remedy = "lengthen the rod, or take a curve with fewer cusps (fewer ring teeth)"
        return transmission_check(self.min_transmission_angle, self.spec.limits.transmission_angle, remedy)


_ALL = frozenset(HypocycloidDwell.outlines["analyze"].quantities)
