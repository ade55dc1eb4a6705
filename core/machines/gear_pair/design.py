"""The gear pair as a design."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Found, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.key_results import SHARED
from gearlink.core.base.remedies.ways import Way, down, either, modules, shared, up, wider
from gearlink.core.base.report import Check, Remedy, Table
from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.checks import GEAR_CHECKS, GEAR_QUANTITIES, GearQuantities, gear_quantity
from gearlink.core.parts.gears.codes import AT_LIMITS
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.drawing_checks import pair_check
from gearlink.core.parts.gears.drawing_names import BESIDE_ROOT, DERIVED, DRAWING_CHECKS, DRAWING_QUANTITIES, lacking
from gearlink.core.parts.gears.from_spec import data_of, pair_of
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.strength_checks import rests_on

if TYPE_CHECKING:
    from gearlink.core.machines.gear_pair.spec import GearPairSpec
    from gearlink.core.parts.gears.rack import RackMesh
    from gearlink.core.parts.gears.shifts.contour import BlockingContour

_SHIFTS = (
    *shared("profile_shift[0]", "profile_shift[1]", step=0.01),
    *either("profile_shift[0]", "profile_shift[1]", "shift_split", step=0.01),
)
_ANGLE = either("pressure_angle", step=0.5)
_LOWER = down("addendum", step=0.01)


_RACK_BACK = 2.0
"""Modules of a rack below its root line where the file names no rim."""
_DEEPER = tuple(up(f"{tool}.addendum", step=0.01) for tool in ("tool", "tool[0]", "tool[1]", "cutter"))
_WIDER = (wider("face_width"), wider("face_width[0]", "face_width[1]"))
_CARRIES = ("pitting", "bending", "damage", "face-load")
"""Checks to which a load that is even across the face helps."""
_THINNER = tuple(Way((f"allowances.upper[{gear}]", f"allowances.lower[{gear}]"), -0.005) for gear in (0, 1))


def _ways(*teeth: Way) -> dict[str, tuple[Way, ...]]:
    fewer = tuple(Way(way.keys, -way.step) for way in teeth)
    return {
        "undercut": (*_SHIFTS, *teeth, *_ANGLE, *fewer),
        "tip-thickness": (*_SHIFTS, _LOWER, *teeth, *_ANGLE),
        "contact-ratio": (*_SHIFTS, up("addendum", step=0.01), *teeth, *_ANGLE),
        "involute-interference": (*_SHIFTS, _LOWER, *teeth, *_ANGLE, *fewer),
        "tooth-form": (*_SHIFTS, _LOWER, *teeth, *_ANGLE, *fewer),
        "root-clearance": (up("clearance", step=0.01), *_DEEPER),
        "fillet-interference": (*_SHIFTS, _LOWER, *teeth, *_DEEPER, *_ANGLE, *fewer),
        "tip-fouling": (*_SHIFTS, _LOWER, *teeth, *_ANGLE),
        "radial-assembly": (*_SHIFTS, _LOWER, *teeth, *_ANGLE),
        **dict.fromkeys(AT_LIMITS, (down("center_distance_allowance", step=0.001), *_SHIFTS)),
        "backlash": (*_THINNER, *either("center_distance", step=0.01), *_SHIFTS),
        "pitting": (*_WIDER, modules("module")[0], *_SHIFTS, *teeth),
        "damage": (*_WIDER, modules("module")[0], *_SHIFTS, *teeth),
        "scuffing": (up("rating.lubricant.scuffing_stage", step=1), up("rating.tip_relief", step=1.0), *_WIDER),
        "bending": (*_WIDER, up("tool.rounding", step=0.01), modules("module")[0], *_SHIFTS, *teeth),
    }


_INSIDE = (
    *("undercut", "tip-thickness", "contact-ratio", "involute-interference", "tooth-form", "fillet-interference"),
    *("tip-fouling", "radial-assembly"),
)
_LINES = dict.fromkeys(_INSIDE, "") | {"sliding": "equal sliding", "bending": "equal root stress"}
"""For each check that a share of the shift sum may repair, the line to go to; none: within all limits."""
_MOST_SHARES = 8
_OF_TIPS = ("involute-interference", "fillet-interference")
_SHORTER = (0.0, 0.02, 0.05, 0.1, 0.15, 0.2)
"""Modules by which tips are tried shorter than contact alone demands."""
_WAYS = _ways(up("teeth[0]", step=1), up("teeth[1]", step=1))
_WAYS_WITH_RING = _ways(down("teeth[1]", step=1), *either("teeth[0]", step=1))


class GearPairDesign(GearQuantities, Design):
    """Cylindrical gears, given by centre distance, by profile shifts, or by both."""

    kind = "gear-pair"
    spec: GearPairSpec
    keys = {"analyze": SHARED["gear"]}
    outlines = {
        "gear": Outline((*GEAR_QUANTITIES, *DRAWING_QUANTITIES), (*GEAR_CHECKS, *DRAWING_CHECKS)),
        "analyze": Outline((*GEAR_QUANTITIES, *DRAWING_QUANTITIES), (*GEAR_CHECKS, *DRAWING_CHECKS)),
    }

    derived = DERIVED
    page_tables = ("drawing",)
    extra_tables = ("drawing", "factors", "root", "path", "candidates", "contour", "margins")
    beside_tables = {"root": Outline(*BESIDE_ROOT)}

    def tables_of_data(self, _command: str, /) -> tuple[str, ...]:
        """The calculation sheet, where the file has `rating`."""
        return () if self.spec.rating is None else ("factors",)

    @classmethod
    def tables_of_page(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """With `rating` also the calculation sheet and the root on the generated fillet."""
        found = super().tables_of_page(command, spec)
        return found if spec.rating is None else (*found, "factors", "root")

    def require_table(self, name: str, /) -> None:
        """The calculation sheet needs `rating`."""
        if name in ("factors", "root") and self.spec.rating is None:
            raise MissingSection(
                f"the table {name} needs rating: {{life: 20000, material: 16MnCr5, ...}}", key="rating"
            )

    @property
    def ways(self) -> dict[str, tuple[Way, ...]]:  # type: ignore[override]
        """More teeth of a ring are a smaller number."""
        return _WAYS_WITH_RING if not self.spec.rack and self.gear_pair.internal else _WAYS

    def candidates(self, check: str) -> Iterator[Remedy]:
        """A crowned helix; the shifts in the blocking contour, or on its line of equal sliding or root stress."""
        face = self.spec.rating.face if self.spec.rating else None
        plain = face is not None and face.misalignment is None and face.modification in (None, "none")
        if plain and check in _CARRIES:
            yield (("rating.face.modification", "crowning"),)
        if self.spec.rack:
            return
        if check in _OF_TIPS and self.gear_pair.internal and self.spec.tip_diameter is None:
            yield from self._shorter_tips()
        line = _LINES.get(check)
        if line is None:
            return
        shift = self.spec.profile_shift
        for first in self.contour.shares(line)[:_MOST_SHARES]:
            if shift is None:
                yield (("shift_split", first),)
            else:
                yield ("profile_shift[0]", first), ("profile_shift[1]", math.fsum((*shift, -first)))

    def _shorter_tips(self) -> Iterator[Remedy]:
        """Tips that clear the mate's fillet on the path of contact, and further ones for what their corners cut."""
        tips = [self.data.path.shortened(gear) for gear in (0, 1)]
        if tips == [None, None]:
            tips = list(self.gear_pair.tip_alteration)
        for more in _SHORTER:
            whole = zip(tips, self.gear_pair.tip_alteration, strict=True)
            yield (
                (
                    "tip_shortening",
                    tuple(own if k is None else round(math.floor(100.0 * k) / 100.0 - more, 2) for k, own in whole),
                ),
            )

    def as_found(self) -> Iterator[Found]:
        """Shifts and tips that the nominal centre distance asks for: gears are cut once, wherever their axes lie."""
        spec, by = self.spec, "found for center_distance"
        if spec.center_distance is None or spec.rack:
            return
        if spec.profile_shift is None:
            yield Found("profile_shift", list(self.gear_pair.profile_shift), by)
            yield Found("shift_split", "equal")
        if spec.tip_shortening in (None, "full") and spec.tip_diameter is None:
            yield Found("tip_shortening", list(self.gear_pair.tip_alteration), by)

    @cached_property
    def gear_pair(self) -> GearPair:
        """The pair of the design file.

        Raises
            NoSolution - where the teeth cannot mesh
        """
        with at_key(self._placed_by):
            return pair_of(self.spec)

    @cached_property
    def data(self) -> GearData:
        """The pair, or gear and rack, with all that its drawing needs."""
        return data_of(self.spec, self.gear_pair)

    @cached_property
    def rack(self) -> RackMesh | None:
        """The mesh of a gear on a rack; None for two gears."""
        if not self.spec.rack:
            return None
        from gearlink.core.parts.gears.rack import RackData, RackMesh

        data = self.data
        assert isinstance(data, RackData)
        return RackMesh(data)

    @property
    def rack_teeth(self) -> int:
        """Teeth of the rack that figures and exports show."""
        given: int | None = self.spec.rack_teeth
        return self.gear_pair.teeth[0] if given is None else given

    @property
    def rack_back(self) -> float:
        """Thickness of the rack below its root line [mm]."""
        given = self.data.rims[1]
        return _RACK_BACK * self.gear_pair.module if given is None else given

    def raw(self, name: str) -> Any:
        """Every quantity is the pair's."""
        with at_key(self._decided_by(name)):
            if self.spec.rack and self.rack is not None:
                return self.rack.quantity(name)
            return gear_quantity(self.gear_pair, name) if name in GEAR_QUANTITIES else self.data.quantity(name)

    def check(self, name: str) -> list[Check]:
        """Every check is the pair's."""
        with at_key(self._decided_by(name)):
            if self.spec.rack and self.rack is not None:
                return list(self.rack.checks(name, self.spec.limits))
            return pair_check(name, self.data, self.spec.limits, radial=self.spec.assembly == "radial")

    def needs(self, name: str) -> str:
        """The keys that the file lacks for a quantity."""
        return lacking(name, self.spec)

    def rests_on(self, name: str) -> str:
        """The factors of the rating."""
        return rests_on(name, self.data)

    def _two_gears(self, what: str) -> GearData:
        """The data of a pair of two gears.

        Raises
            NoSolution - for a gear on a rack
        """
        self.require_two_gears(f"the table {what}")
        return self.data

    def require_two_gears(self, what: str) -> None:
        """Refuse what a gear on a rack does not have.

        Raises
            NoSolution
        """
        if self.spec.rack:
            raise NoSolution(f"{what} needs two gears, not a rack", key="teeth[1]")

    def table_drawing(self, _samples: int | None = None) -> Table:
        """The gear table of the drawing."""
        from gearlink.core.parts.gears.drawing import drawing_table, rack_drawing

        hands = self.spec.helix_hand
        of_both = None if hands is None else (hands[0], hands[1])
        with at_key(self._placed_by):
            if self.rack is not None:
                return rack_drawing(self.rack, of_both)
            return drawing_table(self.data, of_both)

    def table_factors(self, _samples: int | None = None) -> Table:
        """The calculation sheet of the rating."""
        from gearlink.core.parts.gears.rating.sheet import factors_table

        self.require_table("factors")
        with at_key("rating"):
            assert self.data.rated is not None, "the file has rating"
            return factors_table(self.data.rated)

    def table_root(self, _samples: int | None = None) -> Table:
        """Stress along the generated fillets."""
        from gearlink.core.parts.gears.rating.true_root import root_table

        self.require_table("root")
        with at_key("rating"):
            data = self.data
            roots = [(data.called(gear), root) for gear, root in enumerate(data.true_roots)]
            return root_table(roots, data.root_stress_scale, data.pair.module)

    def table_path(self, samples: int | None = None) -> Table:
        """Sliding, pressure and root stress along the path of contact."""
        from gearlink.core.parts.gears.along_path import AlongPath

        with at_key(self._placed_by):
            along = AlongPath(self.data)
            return along.table() if samples is None else along.table(samples)

    def table_candidates(self, _samples: int | None = None) -> Table:
        """The shares of the shift sum side by side."""
        from gearlink.core.parts.gears.shifts.candidates import candidates_table

        with at_key(self._placed_by):
            return candidates_table(self._two_gears("candidates"))

    @cached_property
    def contour(self) -> BlockingContour:
        """The blocking contour about the design."""
        from gearlink.core.parts.gears.shifts.contour import BlockingContour

        return BlockingContour(self._two_gears("contour"))

    def table_contour(self, _samples: int | None = None) -> Table:
        """The lines of the blocking contour, point by point."""
        with at_key(self._placed_by):
            return self.contour.table()

    def table_margins(self, _samples: int | None = None) -> Table:
        """Distance of the design from each line of the contour, at the same shift sum."""
        with at_key(self._placed_by):
            return self.contour.margin_table()

    def _decided_by(self, name: str) -> str:
        """The key that decides whether a quantity or a check exists."""
        at_limits = "backlash" in name or name in AT_LIMITS
        given = self.spec.center_distance_allowance is not None
        return "center_distance_allowance" if at_limits and given else self._placed_by

    @property
    def _placed_by(self) -> str:
        """The key that decides whether the teeth have a flank left; the pair finds out when it is asked."""
        return "center_distance" if self.spec.profile_shift is None else "profile_shift"
