"""What designs have whose files shape their motion laws by numbers: checks, coefficients, the solved laws for a file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Found
from gearlink.core.base.report import Check, Table
from gearlink.core.parts.cams.codes import LAW_GAP, POLYDYNE_RANGE

if TYPE_CHECKING:
    from gearlink.core.parts.cams.laws import Law

LAW_CHECKS = ("law-gap", "polydyne-range")
LAW_TABLE = "law_coefficients"
_MOST_GAP, _LEAST_PERIODS = 1e-3, 1.0


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
            text = f"{path}: no law of this degree lies more than {100.0 * optimum.gap:.2g} % below {optimum.value:.6g}"
            text += ": lower the degree, or loosen a limit" if wide else ""
            yield LAW_GAP.check("warn" if wide else "pass", text, optimum.gap, _MOST_GAP)

    def check_polydyne_range(self) -> Iterator[Check]:
        """GL518."""
        for path, law in self._shaped("polydyne"):
            periods = law.shaping.periods if law.shaping else None
            if periods is None:
                continue
            few = periods < _LEAST_PERIODS
            text = f"{path}: {periods:.4g} natural periods per phase"
            text += f", below {_LEAST_PERIODS:g}: the acceleration grows as 1/lambda^2; give the phase more time" if few else ""
            yield POLYDYNE_RANGE.check("warn" if few else "pass", text, periods, _LEAST_PERIODS)

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
