"""Designs whose gears mesh one after the other: quantities, checks and drawings of their meshes, external or internal.

A design with one mesh gives its quantities by their plain names, one with several puts the name of the mesh before
them, `crank_idler.span_measurement`.

Where a check fails, every mesh says which keys of the file help.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, at_key, in_section
from gearlink.core.base.remedies.ways import Way, down, either, modules, shared, up, wider
from gearlink.core.base.report import Check, Shown, Table, safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike
from gearlink.core.parts.gears.checks import (
    FILLET_NOISE,
    GEAR_CHECKS,
    GEAR_QUANTITIES,
    GearQuantities,
    fouling_check,
    gear_check,
    gear_quantity,
    gear_ways,
    of_mesh,
)
from gearlink.core.parts.gears.codes import (
    AT_LIMITS,
    BACKLASH,
    BENDING,
    CONTACT_RATIO,
    FILLET,
    INTERFERENCE,
    PITTING,
    ROOT_CLEARANCE,
    TIP_FOULING,
    TIP_THICKNESS,
    UNDERCUT,
)
from gearlink.core.parts.gears.drawing_names import DERIVED, DRAWING_CHECKS, GEARS, PLACES, RATING, Roles, lacking
from gearlink.core.parts.gears.mesh.pair import GearPair, least_ring

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference
    from gearlink.core.parts.gears.train.meshes import Place, Train


MESH_QUANTITIES = (*GEAR_QUANTITIES, "tip_fouling_margin")
RING_TIPS = FILLET.checks[1]
MESH_CHECKS = (*GEAR_CHECKS, TIP_FOULING.name, RING_TIPS)
_WITHOUT_INVOLUTES = ("center_distance", "reference_radius", "base_radius", "tip_radius", "root_radius")
"""What a ring whose tips lie inside its base circle still has."""
PLANET: Roles = ("the planet", "the ring gear")


def mesh_quantity(mesh: GearPair, name: str) -> Any:
    """A quantity of standard teeth, or None where this kind of mesh has none, or its teeth have none (a check fails
    there).
    """
    if mesh.internal and mesh.ring_tip_margin < 0.0 and name not in _WITHOUT_INVOLUTES:
        return None
    if name in GEAR_QUANTITIES:
        return gear_quantity(mesh, name)
    return _interference(mesh).tip_fouling_margin if name == "tip_fouling_margin" and mesh.internal else None


def _interference(mesh: GearPair) -> InternalInterference:
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference

    return InternalInterference(mesh)


def mesh_checks(
    name: str,
    mesh: GearPair,
    limits: Any,
    label: str = "",
    shifts: bool = False,
    roles: Roles = GEARS,
    in_ring: Roles = PLANET,
) -> list[Check]:
    """The findings of one of MESH_CHECKS on standard teeth in mesh, which go by a label where a design has several.

    Parameters
        roles, in_ring : (str, str) - what messages call the two gears, in_ring where the second is a ring
    Source
        ISO 21771 for the quantities
    """
    if mesh.internal:
        return of_mesh(label, _in_ring(name, mesh, limits, in_ring))
    of_rings = name in (TIP_FOULING.name, RING_TIPS)
    return [] if of_rings else of_mesh(label, gear_check(name, mesh, limits, shifts, roles))


def _in_ring(name: str, mesh: GearPair, limits: Any, roles: Roles) -> Iterator[Check]:
    """The findings on a planet in its ring, whose root clearance and tooth form are the standard's."""
    involutes, internal = mesh.ring_tip_margin >= 0.0, _interference(mesh)
    if name == TIP_FOULING.name and (involutes or internal.tip_circles_apart < 0.0):
        yield from fouling_check(internal, roles)
    elif name == INTERFERENCE.name and not involutes:
        yield _without_involutes(mesh)
    elif name == INTERFERENCE.name:  # the planet's tips do not come near the ring's base circle
        yield list(gear_check(name, mesh, limits, roles=roles))[1]
    elif name == UNDERCUT.name or (name in (CONTACT_RATIO.name, TIP_THICKNESS.name) and involutes):
        yield from gear_check(name, mesh, limits, roles=roles)
    elif name == RING_TIPS and involutes and internal.involute_margin > 0.0:
        yield from _ring_tips_on_fillet(mesh, roles[0])


def _without_involutes(mesh: GearPair) -> Check:
    teeth, margin = least_ring(mesh), mesh.ring_tip_margin
    fix = "use a larger pressure angle" if teeth is None else f"give the ring gear at least {teeth} teeth"
    what = "tips of the ring gear within its base circle"
    return INTERFERENCE.check("fail", what, margin, 0.0, "mm", overlap=what, aside="no involute there", fix=fix)


def _ring_tips_on_fillet(mesh: GearPair, planet: str) -> Iterator[Check]:
    """GL207: tips of full height of a ring, which is hollow, reach deeper into a root than those of the tool's rack.

    Notes
        A warning: the file says nothing of how the teeth are cut.
    """
    from gearlink.core.parts.gears.mesh.contact import PathOfContact

    used, form = PathOfContact(mesh).used_root_radius[0], mesh.form_radius_of(0)
    if form is None:
        return
    margin, limit = used - form, -FILLET_NOISE * mesh.module
    yield FILLET.check(
        "warn" if margin < limit else "pass",
        f"start of the ring gear's contact at the root of {planet}",
        margin,
        limit,
        "mm",
        name=RING_TIPS,
        shown=Shown(used, form, "mm"),
        aside="form radius of a standard tool",
        fix="shorten the tips of the ring gear",
    )


_OF_EVERY_MESH = "tip_fouling_margin"
TRAIN_QUANTITIES = tuple(name for name in PLACES if name != _OF_EVERY_MESH)
TRAIN_CHECKS = tuple(name for name in DRAWING_CHECKS if name != TIP_FOULING.name)


_THINNER = -0.005


def train_ways(gears: int, *teeth: Way) -> dict[str, tuple[Way, ...]]:
    """Ways for every check of a mesh: shifts and tools where the file gives them, teeth, lower teeth last.

    Parameters
        gears : int - as many entries have the lists of the section
        teeth : the ways to more teeth
    """
    shifts = [f"gears.profile_shift[{i}]" for i in range(gears)]
    moved = (
        *(way for i in range(gears - 1) for way in shared(shifts[i], shifts[i + 1], step=0.01)),
        *either(*shifts, step=0.01),
    )
    lower = down("gears.addendum", step=0.01)
    ways = {name: (*moved, *others, lower) for name, others in gear_ways(*teeth).items()}
    stronger = (
        wider("gears.face_width"),
        wider(*(f"gears.face_width[{i}]" for i in range(gears))),
        modules("gears.module")[0],
    )
    thinner = tuple(
        Way((f"gears.allowances.upper[{i}]", f"gears.allowances.lower[{i}]"), _THINNER) for i in range(gears)
    )
    fewer = tuple(Way(way.keys, -way.step, way.tie) for way in teeth)
    return ways | {
        ROOT_CLEARANCE.name: (up("gears.clearance", step=0.01), up("gears.tool.addendum", step=0.01)),
        FILLET.name: (down("gears.tool.rounding", step=0.01), *moved, *teeth, lower),
        BACKLASH.name: (*thinner, down("gears.center_distance_allowance", step=0.001), *moved),
        **dict.fromkeys(AT_LIMITS, (down("gears.center_distance_allowance", step=0.001), *moved)),
        TIP_FOULING.checks[1]: (*moved, *teeth, *fewer, lower),
        PITTING.name: (*stronger, *moved, *teeth),
        BENDING.name: (*stronger, up("gears.tool.rounding", step=0.01), *moved, *teeth),
    }


QUANTITIES = (*MESH_QUANTITIES, *TRAIN_QUANTITIES)
_OF_MESHES, _OF_PAIRS = frozenset(QUANTITIES), frozenset(MESH_QUANTITIES)
_LEAST_AND_GREATEST = ("backlash_circumferential", "backlash_normal")
"""Pairs that are not of two gears."""


def named(meshes: tuple[str, ...]) -> tuple[str, ...]:
    """The quantities of meshes by their names."""
    return tuple(f"{mesh}.{name}" for mesh in meshes for name in QUANTITIES)


class Meshed(GearQuantities, Design):
    """A design with gears in mesh, whose section `gears` has the keys of a train."""

    derived = DERIVED | {"output_play"}
    own_quantities: ClassVar[frozenset[str]] = frozenset()
    """Quantities of a mesh that the design gives itself under their plain names."""
    in_ring: ClassVar[Roles] = PLANET
    """What findings call a gear within a ring, and the ring."""

    # What a machine says of its gears

    @property
    def signed_teeth(self) -> tuple[int, ...]:
        """Teeth of the gears that mesh one after the other, in the order of the file's lists; rings negative."""
        raise NotImplementedError

    @property
    def mesh_names(self) -> tuple[str, ...]:
        """Names of the meshes; empty for an only one."""
        return ("",)

    @property
    def given_distances(self) -> tuple[float | None, ...]:
        """Links of the file that are working centre distances [mm]; they count where it gives profile shifts too."""
        return (None,) * len(self.mesh_names)

    def rim_of(self, _mesh: str, /) -> float | None:
        """Outer radius of the ring of a mesh [mm], where the file gives it."""
        found: float | None = getattr(self.spec.gears, "rim", None)
        return found

    def outer_rim(self, name: str = "") -> float | None:
        """Outer radius of the ring of a mesh [mm], by `rim` or by its rim_thickness; None without either."""
        given = self.rim_of(name)
        if given is not None or self.spec.gears.rim_thickness is None:
            return given
        place = self.teeth_train.places[self.mesh_names.index(name)]
        found: float | None = self.spec.gears.rim_at(place.gears[1], self.meshes[name].root_radius[1])
        return found

    @classmethod
    def tables_of_page(cls, command: str, spec: Any) -> tuple[str, ...]:
        """The gear tables, where the file has keys of a drawing, and the calculation sheet of a rating."""
        found = ("drawing",) if command == "gear" and spec.gears.drawing else ()
        return (*found, "factors") if command == "gear" and spec.gears.rating is not None else found

    def tables_of_data(self, command: str, /) -> tuple[str, ...]:
        """The calculation sheet, where the file has `rating`."""
        return ("factors",) if command == "gear" and self.spec.gears.rating is not None else ()

    def require_table(self, name: str, /) -> None:
        """The calculation sheet needs `rating`."""
        if name == "factors" and self.spec.gears.rating is None:
            text = "the table factors needs gears.rating: {life: 20000, material: 16MnCr5, ...}"
            raise MissingSection(text, key="gears.rating")
        super().require_table(name)

    # The meshes

    @cached_property
    def teeth_train(self) -> Train:
        """The meshes with the keys of the file."""
        from gearlink.core.parts.gears.train.meshes import Train

        return Train(self.spec.gears, self.signed_teeth, self._distances)

    @property
    def _distances(self) -> tuple[float | None, ...]:
        """Links of the file that count as working centre distances [mm]."""
        return self.given_distances if self.spec.gears.profile_shift is not None else (None,) * len(self.mesh_names)

    @cached_property
    def own_teeth(self) -> bool:
        """Whether the teeth are not those of the standard profile at the reference centre distance."""
        return bool(self.spec.gears.own_teeth or any(self._distances))

    @cached_property
    def meshes(self) -> dict[str, GearPair]:
        """The meshes by name; a ring is the second gear of its pair."""
        if self.own_teeth:
            return dict(self._own_pairs)
        with at_key("gears"):
            return {name: self._standard(i) for i, name in enumerate(self.mesh_names)}

    @cached_property
    def _own_pairs(self) -> dict[str, GearPair]:
        """Pairs by the keys of the file, in which a ring has negative teeth."""
        with in_section("gears"):
            pairs = self.teeth_train.pairs()
            roots = [abs(pair.root_radius[1]) for pair in pairs]  # a cutter that shapes no ring is refused here
        for name, pair, root in zip(self.mesh_names, pairs, roots, strict=True):
            rim = self.rim_of(name)
            if pair.internal and rim is not None and rim <= root:
                raise NoSolution(
                    f"radius of the rim: {unlike(rim, root)} mm (limit > {unlike(root, rim)} mm, the root radius of "
                    "the ring)",
                    key="gears.rim",
                    fix=f"set gears.rim above {safely_above(root)} mm",
                )
        return dict(zip(self.mesh_names, pairs, strict=True))

    def _standard(self, place: int) -> GearPair:
        gears, (one, other) = self.spec.gears, self.signed_teeth[place : place + 2]
        teeth = (other, one) if one < 0 else (one, other)
        return GearPair.from_shift(gears.module, teeth, pressure_angle=math.radians(gears.pressure_angle))

    @property
    def mesh(self) -> GearPair:
        """The mesh of a design with one."""
        return self.meshes[""]

    def distance(self, name: str = "") -> float:
        """Working centre distance of a mesh [mm]."""
        return abs(self.meshes[name].center_distance)

    @cached_property
    def mesh_data(self) -> dict[str, GearData]:
        """The meshes with all that their drawing needs; a ring is the second gear of its pair."""
        from gearlink.core.parts.gears.from_spec import required_of

        train, pairs = self.teeth_train, self._own_pairs  # whose refusals name the section already
        with in_section("gears"):
            found, required = (
                zip(self.mesh_names, train.places, pairs.values(), strict=True),
                required_of(self.spec.limits),
            )
            return {
                name: replace(train.data(place, pair, self.rim_of(name)), roles=self._roles(name), required=required)
                for name, place, pair in found
            }

    def widths_of(self, name: str = "") -> tuple[float, float] | None:
        """Face widths of the gears of a mesh [mm], a ring's second; None where the file has none."""
        return None if self.spec.gears.face_width is None else self.mesh_data[name].face_width

    def require_proportion(self) -> None:
        """Refuse profile shifts that move a centre distance: the forms of a synthesis have links as the teeth say.

        Raises
            NoSolution
        """
        if self.spec.gears.off_center(len(self.mesh_names)):
            example = "[x, -x, x]" if len(self.mesh_names) > 1 else "[x, -x]"
            raise NoSolution(
                f"a synthesis needs profile shifts that add up to 0 in each mesh, such as {example}: links in "
                "proportion to the teeth",
                key="gears.profile_shift",
            )

    # Quantities

    def outline(self, command: str) -> Outline:
        """The strength of teeth is shown where the file asks for it."""
        found = super().outline(command)
        if command != "gear" or self.spec.gears.rated:
            return found
        shown = tuple(name for name in found.quantities if name.rpartition(".")[2] not in RATING)
        return found._replace(quantities=shown)

    def raw(self, name: str) -> Any:
        """The quantities of the meshes, and the design's own."""
        mesh, _, quantity = name.rpartition(".")
        if quantity not in _OF_MESHES or (not mesh and name in self.own_quantities):
            return super().raw(name)
        if mesh not in self.mesh_names:
            return None
        with at_key("gears"):
            found = self._of_mesh(mesh, quantity)
        swapped = self._swapped(mesh) and quantity not in _LEAST_AND_GREATEST
        return found[::-1] if swapped and isinstance(found, tuple) else found

    def _swapped(self, mesh: str) -> bool:
        """Whether a ring stands before its mating gear: the first gear of its mesh, the second of its pair."""
        return mesh in self._rings_first

    def _roles(self, mesh: str) -> Roles:
        """The gears of a pair as the file's lists number them."""
        return (GEARS[1], GEARS[0]) if self._swapped(mesh) else GEARS

    @cached_property
    def _rings_first(self) -> frozenset[str]:
        return frozenset(name for name, teeth in zip(self.mesh_names, self.signed_teeth, strict=False) if teeth < 0)

    def _of_mesh(self, name: str, quantity: str) -> Any:
        if quantity in GEAR_QUANTITIES and self.own_teeth:
            mesh = self.meshes[name]
            with in_section("gears"):
                return gear_quantity(mesh, quantity)
        if quantity in _OF_PAIRS and not self.own_teeth:
            return mesh_quantity(self.meshes[name], quantity)
        if not self._has_involutes(name):
            return None
        data = self.mesh_data[name]
        with in_section("gears"):
            return data.quantity(quantity)

    def _has_involutes(self, name: str) -> bool:
        """Whether the tips of a standard ring reach its involutes; where not, a check fails and says so."""
        mesh = self.meshes[name]
        return self.own_teeth or not mesh.internal or mesh.ring_tip_margin >= 0.0

    @property
    def output_play(self) -> tuple[float, float] | None:
        """Free turn of the last gear while the first and all links stand [rad], minimum and greatest.

        sum over the meshes of j_phi z/z_last, j_phi the free turn of the second gear of a mesh, z its teeth

        Source
            own derivation: plays of a train add up at the pitch circles
        """
        data, teeth = self.mesh_data, self.signed_teeth
        if any(each.backlash is None for each in data.values()):
            return None
        found = [self.raw(f"{name}.backlash_angle" if name else "backlash_angle") for name in data]
        turns = [each[1] for each in found if each is not None]
        if len(turns) < len(found):  # a ring whose tips have no involute
            return None
        shares = [abs(z / teeth[-1]) for z in teeth[1:]]
        least, greatest = (
            math.fsum(turn[end] * share for turn, share in zip(turns, shares, strict=True)) for end in (0, 1)
        )
        return least, greatest

    def needs(self, name: str) -> str:
        """The keys that a mesh lacks for a quantity."""
        return lacking(name.rpartition(".")[2], self.spec.gears, "gears.")

    def rests_on(self, name: str) -> str:
        """The factors of the rating."""
        mesh, _, quantity = name.rpartition(".")
        if quantity not in RATING:
            return ""
        from gearlink.core.parts.gears.strength_checks import rests_on

        return rests_on(quantity, self.mesh_data[mesh])

    def table_drawing(self, _samples: int | None = None) -> Table:
        """The gear tables of the meshes, one below the other."""
        found = self.mesh_data
        with in_section("gears"):
            return drawings(found, self.spec.gears.helix_hand, self.teeth_train.places)

    def table_factors(self, _samples: int | None = None) -> Table:
        """The calculation sheets of the meshes, one below the other; a ring is gear 2 of its pair."""
        from gearlink.core.parts.gears.rating.sheet import factors_table

        self.require_table("factors")
        with in_section("gears"), at_key("rating"):
            tables = {
                mesh: factors_table(each.rated) for mesh, each in self.mesh_data.items() if each.rated is not None
            }
        return _below_each_other("factors", tables)

    # Checks

    def check(self, name: str) -> list[Check]:
        """Gear checks run over all meshes."""
        if name in MESH_CHECKS:
            return [check for mesh in self.mesh_names for check in self.check_mesh(name, mesh)]
        if name not in TRAIN_CHECKS:
            return super().check(name)
        if not self._judged(name):
            return []

        with at_key("gears"):
            known = {mesh: data for mesh, data in self.mesh_data.items() if self._has_involutes(mesh)}
        from gearlink.core.parts.gears.drawing_checks import pair_check

        radial, limits = self.spec.gears.assembly == "radial", self.spec.limits
        with in_section("gears"):
            found = [pair_check(name, data, limits, mesh=mesh, radial=radial) for mesh, data in known.items()]
        return [check for checks in found for check in checks]

    def check_mesh(self, name: str, mesh: str) -> list[Check]:
        """The findings of one of MESH_CHECKS on one mesh."""
        pair, limits, shifts = self.meshes[mesh], self.spec.limits, self.spec.gears.profile_shift is not None
        if name == RING_TIPS and self.own_teeth:
            return []  # judged by the check that knows the tool
        if self.own_teeth and (self.spec.gears.helix_angle or pair.internal):
            from gearlink.core.parts.gears.drawing_checks import pair_check

            data = self.mesh_data[mesh]
            with in_section("gears"):
                return pair_check(name, data, limits, mesh=mesh, shifts=shifts)
        with in_section("gears"):
            return mesh_checks(name, pair, limits, mesh, shifts, self._roles(mesh), self.in_ring)

    def _judged(self, name: str) -> bool:
        """Whether the file gives what a check of the drawing or of the strength needs."""
        gears = self.spec.gears
        needed = {
            "radial-assembly": (gears.assembly, gears.cutter),
            "fillet-interference": (self.own_teeth or None,),
            **dict.fromkeys(AT_LIMITS, (gears.center_distance_allowance,)),
            "backlash": (gears.allowances, gears.center_distance_allowance, *self._distances),
        }.get(name, (gears.load,))
        return any(each is not None for each in needed)


def drawings(found: Mapping[str, GearData], hands: Sequence[str] | None, places: Sequence[Place]) -> Table:
    """The gear tables of the meshes, one below the other; a single one as it is.

    Parameters
        found : GearData of the meshes by name, a ring second; the columns have the order of the file's lists
        hands : of helix of all gears, or None
        places : Places of the meshes
    """
    from gearlink.core.parts.gears.drawing import drawing_table

    tables = {
        mesh: _in_order(
            drawing_table(data, None if hands is None else (hands[place.gears[0]], hands[place.gears[1]])), place
        )
        for (mesh, data), place in zip(found.items(), places, strict=True)
    }
    return _below_each_other("drawing", tables)


def _below_each_other(name: str, tables: Mapping[str, Table]) -> Table:
    """The tables of several meshes as one, whose first column names the mesh; a single one as it is."""
    one, *_ = tables.values()
    if len(tables) == 1:
        return one
    names = [mesh for mesh, table in tables.items() for _ in range(table.length)]
    columns = [[value for table in tables.values() for value in table.data[i]] for i in range(len(one.columns))]
    return Table(name, ("mesh", *one.columns), ("", *one.units), (names, *columns))


def _in_order(table: Table, place: Place) -> Table:
    """The gears in the order of the file's lists, where a ring stands before its mating gear."""
    if place.gears[0] < place.gears[1]:
        return table
    item, symbol, pinion, ring, *rest = table.data
    return Table(table.name, table.columns, table.units, (item, symbol, ring, pinion, *rest))
