"""What designs have whose files shape their motion laws by numbers: checks, coefficients, solved laws."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.core.base.design import Found
from gearlink.core.base.errors import at_key
from gearlink.core.base.report import Check, Shown, Status, Table
from gearlink.core.base.wording import short
from gearlink.core.parts.cams.codes import LAW_GAP, LAW_RIPPLE, POLYDYNE_RANGE

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.cams.laws import Law
    from gearlink.core.parts.cams.shaped import Phase

LAW_CHECKS = ("law-gap", "polydyne-range", "law-ripple")
LAW_TABLE = "law_coefficients"
_MOST_GAP, _LEAST_PERIODS = 1e-3, 1.0
_ROUNDING = 1e-9


BESIDE = ("cycloidal", "modified-sine", "polynomial-4567")
"""Laws that are shown beside those of a file."""
SPEEDS = (0.5, 1.3)
_STEPS = 160


class Vibration(NamedTuple):
    """What a law of a design leaves over the speed, and usual laws instead.

    Fields
        path : str - of the law in the file
        speed : (N,) array - in `unit`; "1": shares of the speed for which the law is shaped
        periods : (N,) array - natural periods per phase
        residuals : (N,) arrays by the name of the law, its own first - over the rise
    """

    path: str
    speed: Reals
    unit: str
    periods: Reals
    residuals: dict[str, Reals]


def is_shaped(definition: Any, *types: str) -> bool:
    """Whether numbers shape a law of a file, and in one of these ways."""
    return not isinstance(definition, str | Mapping | None) and (not types or definition.type in types)


class WithShapedLaws:
    """A design whose file may shape its laws."""

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """The laws as the file has them, by their paths; those that it leaves out may be missing."""
        raise NotImplementedError

    def law_at(self, path: str, /) -> Law | None:
        """The law of a path; None where nothing moves by it."""
        raise NotImplementedError

    def law_phase(self, path: str, /) -> Phase:
        """What the design says of the phase of a law."""
        raise NotImplementedError

    def vibrations(self, samples: int | None = None) -> list[Vibration]:
        """What each law leaves from 0.5 to 1.3 of the design's speed, as far as natural periods are known of it."""
        import numpy as np

        from gearlink.core.parts.cams.laws import law as law_of
        from gearlink.core.parts.cams.shaped import residuals

        share, found = np.linspace(*SPEEDS, (samples or _STEPS) + 1), []
        for path in self.law_definitions:
            law = self.law_at(path)
            if law is None or law.kind == "given-ends":
                continue
            phase, shaping = self.law_phase(path), law.shaping
            periods = shaping.periods if shaping is not None else None
            if periods is None and phase.frequency is not None and phase.time is not None:
                periods = phase.frequency * phase.time
            if periods is None:
                continue
            damping = (phase.damping or 0.0) if shaping is None or shaping.periods is None else shaping.damping
            names = {law.name: law, **{name: law_of(name) for name in BESIDE if law.kind == "rest-to-rest"}}
            with at_key(path):
                left = {name: residuals(each, periods / share, damping) for name, each in names.items()}
            speed = share if phase.speed is None else share * phase.speed
            found.append(Vibration(path, speed, phase.unit if phase.speed is not None else "1", periods / share, left))
        return found

    def _shaped(self, *types: str) -> Iterator[tuple[str, Law]]:
        for path, definition in self.law_definitions.items():
            if is_shaped(definition, *types) and (found := self.law_at(path)) is not None:
                yield path, found

    def check_law_gap(self) -> Iterator[Check]:
        """GL517."""
        for path, law in self._shaped("optimal"):
            optimum = law.shaping.optimum if law.shaping else None
            if optimum is None or (law.shaping and law.shaping.wish and law.shaping.wish.minimize == "torque"):
                continue
            wide = optimum.gap > _MOST_GAP
            what = f"{path}: relative gap between the optimum and its proved lower bound"
            shown = Shown(100.0 * optimum.gap, 100.0 * _MOST_GAP, "%", "<=")
            aside, status = f"optimum {short(optimum.value)}", _status(wide)
            yield LAW_GAP.check(status, what, optimum.gap, _MOST_GAP, shown=shown, aside=aside, fix="reduce the degree")

    def check_polydyne_range(self) -> Iterator[Check]:
        """GL518."""
        for path, law in self._shaped("polydyne"):
            periods = law.shaping.periods if law.shaping else None
            if periods is None:
                continue
            few = periods < _LEAST_PERIODS
            what, fix = f"{path}: natural periods per phase", "give the phase more time"
            yield POLYDYNE_RANGE.check(_status(few), what, periods, _LEAST_PERIODS, fix=fix)

    def check_law_ripple(self) -> Iterator[Check]:
        """GL422."""
        for path, law in self._shaped("table"):
            if law.shaping is None or law.shaping.least_speed is None:
                continue
            speed, place = law.shaping.least_speed
            what, fix = f"{path}: minimum velocity of the table law", "smooth the points, or omit some"
            back = speed < -_ROUNDING * law.peak_velocity
            shown, at = speed if back else max(speed, 0.0), f"x = {short(place)}"
            yield LAW_RIPPLE.check(_status(back), what, shown, 0.0, at=at, fix=fix)

    def table_law_coefficients(self, _samples: int | None = None) -> Table:
        """Coefficients of the second derivative of each law that is a polynomial, by Bernstein polynomials."""
        rows = [
            (path, i, c)
            for path, law in self._shaped()
            for i, c in enumerate(law.shaping.acceleration if law.shaping else ())
        ]
        columns = zip(*rows, strict=True) if rows else ((), (), ())
        named = zip(("law", "index", "acceleration"), columns, strict=True)
        return Table.of(LAW_TABLE, {name: (list(values), "1") for name, values in named})

    def solved_laws(self) -> Iterator[Found]:
        """The optimal laws of the file as they were solved."""
        for path, law in self._shaped("optimal"):
            if law.shaping is not None:
                value = {"type": "bernstein", "acceleration": list(law.shaping.acceleration)}
                yield Found(path, value, f"solved: {law.name}")


def _status(bad: bool) -> Status:
    return "warn" if bad else "pass"
