"""A motion law as a design: peaks, natural periods, residual vibration, and how far it is from the minimum."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import Field, model_validator

from gearlink.core.base.design import Design, Found, Outline, placed
from gearlink.core.base.errors import at_key, in_section
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec import DesignSpec, Length, Speed, refused, unit
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE, WithShapedLaws
from gearlink.core.parts.cams.spec import MotionLaw

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from gearlink.core.parts.cams.laws import Law
    from gearlink.core.parts.cams.optimal import Optimum
    from gearlink.core.parts.cams.shaped import Phase, Shaping


Millis = Annotated[float, unit("ms", gt=0, le=1e9)]
PhaseAngle = Annotated[float, unit("deg", gt=0, le=360)]
Hertz = Annotated[float, unit("Hz", gt=0, le=1e7)]
Damping = Annotated[float, unit("1", ge=0, lt=1)]


class MotionLawSpec(DesignSpec):
    """A motion law, over the share x of a phase."""

    kind: Literal["motion-law"]
    law: MotionLaw = Field(description="the law: a name, or a mapping with its numbers")
    stroke: Length | None = Field(None, description="rise over the phase; with a time real speeds are given")
    time: Millis | None = Field(None, description="time of the phase")
    speed: Speed | None = Field(None, description="speed of the input, instead of time; with angle")
    angle: PhaseAngle | None = Field(None, description="angle of the input over the phase")
    frequency: Hertz | None = Field(None, description="natural frequency of the driven system")
    damping: Damping | None = Field(None, description="damping ratio of that system; default: 0")

    @model_validator(mode="after")
    def _one_time(self) -> MotionLawSpec:
        if self.time is not None and self.speed is not None:
            raise refused("time and speed specify the same\nomit time or speed", "speed")
        if (self.speed is None) != (self.angle is None):
            key = "angle" if self.angle is None else "speed"
            raise refused("speed and angle go together\ngive both, or time", key)
        return self

    @property
    def seconds(self) -> float | None:
        """Time of the phase [s]."""
        if self.speed is not None and self.angle is not None:
            return self.angle / (6.0 * self.speed)
        return None if self.time is None else 1e-3 * self.time

    def commands(self) -> tuple[str, ...]:
        return ("laws",)


_QUANTITIES = (
    "peak_velocity",
    "peak_acceleration",
    "peak_jerk",
    "peak_power",
    "kappa",
    "degree",
    "periods",
    "residual",
    "residual_at_design",
    "lower_bound",
    "lower_bound_all_laws",
    "gap",
    "follower_velocity_max",
    "follower_acceleration_max",
)
_OUTLINE = Outline(_QUANTITIES, LAW_CHECKS, ("law", "residual", "coefficients"))
_SLOWEST, _FASTEST = 0.5, 1.3
_STEPS = 100


class MotionLawDesign(WithShapedLaws, Design):
    """The law of a design file."""

    kind = "motion-law"
    spec: MotionLawSpec
    keys = dict.fromkeys(
        ("laws", "analyze"),
        (
            "peak_velocity",
            "peak_acceleration",
            "peak_jerk",
            "residual_at_design",
            "residual",
            "lower_bound",
            "gap",
            "follower_velocity_max",
            "follower_acceleration_max",
            "peak_power",
        ),
    )
    outlines = {"laws": _OUTLINE, "analyze": _OUTLINE}
    extra_tables = (LAW_TABLE,)
    advises = False

    @cached_property
    def law(self) -> Law:
        """The law over x in [0, 1]."""
        from gearlink.core.parts.cams.laws import law

        with in_section("law"):
            return law(self.spec.law, self.law_phase(""))

    def law_phase(self, _path: str, /) -> Phase:
        """What the file says of the phase."""
        from gearlink.core.parts.cams.shaped import Phase

        spec = self.spec
        angle = None if spec.angle is None else math.radians(spec.angle)
        unit = "" if spec.speed is None else "1/min"
        return Phase(angle, spec.stroke, spec.seconds, spec.speed, unit, spec.frequency, spec.damping, in_periods=True)

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """The law of the file."""
        return {"law": self.spec.law}

    def law_at(self, _path: str, /) -> Law:
        """The law of the file."""
        return self.law

    def completion(self) -> Iterator[Found]:
        """The law as it was solved."""
        return self.solved_laws()

    def outline(self, command: str) -> Outline:
        """The tables that this law has."""
        found = super().outline(command)
        has = {"residual": self.band is not None, "coefficients": bool(self.shaping and self.shaping.acceleration)}
        return found._replace(tables=tuple(name for name in found.tables if has.get(name, True)))

    @property
    def shaping(self) -> Shaping | None:
        """How numbers shaped the law."""
        return self.law.shaping

    @property
    def optimum(self) -> Optimum | None:
        """What is proved of the law."""
        return None if self.shaping is None else self.shaping.optimum

    # Peaks

    peak_velocity: float = placed("law.peak_velocity")
    peak_acceleration: float = placed("law.peak_acceleration")
    peak_jerk: float = placed("law.interior_jerk")
    peak_power: float = placed("law.peak_power")
    kappa: float = placed("law.kappa")

    @property
    def degree(self) -> int | None:
        """Degree of the acceleration, of an optimal or solved law."""
        named = self.shaping is not None and self.shaping.type in ("optimal", "bernstein")
        return len(self.shaping.acceleration) - 1 if named and self.shaping is not None else None

    def _real(self, peak: float, order: int) -> float | None:
        stroke, time = self.spec.stroke, self.spec.seconds
        return None if stroke is None or time is None else peak * stroke / time**order

    @property
    def follower_velocity_max(self) -> float | None:
        """Maximum velocity over stroke and time [mm/s]."""
        return self._real(self.law.peak_velocity, 1)

    @property
    def follower_acceleration_max(self) -> float | None:
        """Maximum acceleration [mm/s^2]."""
        return self._real(self.law.peak_acceleration, 2)

    # Vibration

    @property
    def damping(self) -> float:
        """Damping ratio of what the law moves."""
        if self.shaping is not None and self.shaping.type in ("polydyne", "optimal"):
            return self.shaping.damping
        return self.spec.damping or 0.0

    @cached_property
    def periods(self) -> float | None:
        """Natural periods per phase."""
        if self.shaping is not None and self.shaping.periods is not None:
            return self.shaping.periods
        frequency, time = self.spec.frequency, self.spec.seconds
        return None if frequency is None or time is None else frequency * time

    @property
    def asked_band(self) -> tuple[float, float] | None:
        """The band of natural periods over which the residual was minimized."""
        return None if self.shaping is None or self.shaping.wish is None else self.shaping.wish.band

    @property
    def band(self) -> tuple[float, float] | None:
        """The natural periods of the table `residual`: the band, or 1.3 to 0.5 of the design's speed."""
        if self.asked_band is not None:
            return self.asked_band
        return None if self.periods is None else (self.periods / _FASTEST, self.periods / _SLOWEST)

    @property
    def residual(self) -> float | None:
        """Maximum vibration left over the band, over the rise, from above."""
        return None if self.asked_band is None or self.optimum is None else self.optimum.value

    def residuals(self, periods: NDArray[np.float64]) -> NDArray[np.float64]:
        """Vibration left over the rise at numbers of natural periods."""
        from gearlink.core.parts.cams.shaped import residuals

        with at_key("law" if self.spec.frequency is None else "frequency"):
            return residuals(self.law, periods, self.damping)

    @cached_property
    def residual_at_design(self) -> float | None:
        """Vibration left at the design's speed, over the rise."""
        import numpy as np

        return None if self.periods is None else float(self.residuals(np.array([self.periods]))[0])

    # Proof

    lower_bound: float | None = placed("optimum.lower_bound")
    lower_bound_all_laws: float | None = placed("optimum.lower_bound_all_laws")
    gap: float | None = placed("optimum.gap")

    # Tables

    def table_law(self, samples: int | None = None) -> Table:
        """Rise and its derivatives over x, both ends."""
        from gearlink.core.parts.cams.law_tables import course

        found = course(self.law, samples or _STEPS)
        return Table("law", found.columns, found.units, found.data)

    def table_residual(self, samples: int | None = None) -> Table:
        """Vibration left over the speed; without a design speed that of the minimum periods of the band is 1."""
        import numpy as np

        if self.band is None:
            return Table.of("residual", {name: ([], "1") for name in ("speed", "periods", "residual")})
        low, high = self.band
        reference = self.periods or low
        speed = np.linspace(reference / high, reference / low, (samples or _STEPS) + 1)
        periods = reference / speed
        known = self.spec.speed if self.periods else None
        shown = (speed if known is None else speed * known, "1" if known is None else "1/min")
        columns = {"speed": shown, "periods": (periods, "1"), "residual": (self.residuals(periods), "1")}
        return Table.of("residual", columns)

    def table_coefficients(self, _samples: int | None = None) -> Table:
        """Coefficients of the second derivative by Bernstein polynomials."""
        found = self.shaping.acceleration if self.shaping is not None else ()
        return Table.of("coefficients", {"index": (list(range(len(found))), "1"), "acceleration": (list(found), "1")})
