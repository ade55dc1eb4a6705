"""Gear pairs from their design file."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution, at_key
from gearlink.core.base.wording import short, within
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.load import Factors, Load, Material, Required, torque_of
from gearlink.core.parts.gears.tooth.tools import PinionCutter, RackTool, usual_rounding

if TYPE_CHECKING:
    from gearlink.core.machines.gear_pair.spec import GearPairSpec
    from gearlink.core.parts.gears.keys.pair import PairKeys
    from gearlink.core.parts.gears.keys.sections import AllowanceSpec, LoadSpec, ToolSpec
    from gearlink.core.parts.gears.keys.types import MaterialSpec
    from gearlink.core.parts.gears.rack import RackMesh

_MOST_SHIFT = 5.0
_AGREE = 1e-6
"""Centre distances that differ by less, in modules, count as one."""


def pair_of(spec: GearPairSpec) -> GearPair:
    """The pair of a design file.

    Raises
        NoSolution - where the teeth cannot mesh
    """
    known = _of_teeth(spec, tuple(spec.teeth)) | {"given_spans": as_pair(spec.span_teeth) or (None, None)}
    if spec.tip_diameter is not None:
        known["given_tip_radius"] = (0.5 * spec.tip_diameter[0], 0.5 * spec.tip_diameter[1])
    if spec.cutter is not None:
        known["cutter"] = PinionCutter(**spec.cutter.model_dump())
    if spec.rack:
        return _on_rack(spec, known)
    shift, distance = spec.profile_shift, spec.center_distance
    if shift is None:
        split = spec.shift_split
        if not isinstance(split, str):
            return GearPair(**known, given_distance=distance, given_first_shift=split)
        pair = GearPair(**known, given_distance=distance)
        return pair if split == "equal" else _shared(spec, pair, split)
    if distance is None:
        return GearPair(**known, given_shift=(shift[0], shift[1]))
    with at_key("center_distance"):
        pair = GearPair(**known, given_shift=(shift[0], shift[1]), given_distance=distance)
    return _without_difference(pair)


def _of_teeth(given: GearPairSpec | PairKeys, teeth: Any) -> dict[str, Any]:
    """What a pair takes from the keys of its section, but for shifts and centre distance."""
    with at_key("tool"):
        tools = tools_of(given)
    return {
        "module": given.module,
        "teeth": teeth,
        "pressure_angle": math.radians(given.pressure_angle),
        "helix_angle": math.radians(given.helix_angle),
        "addendum": given.addendum,
        "clearance": given.clearance,
        "tip": as_pair(given.tip_shortening),
        "tools": tools,
    }


def pair_at(
    given: PairKeys,
    teeth: tuple[int, int],
    distance: float | None = None,
    teeth_keys: tuple[str, str] = GearPair.teeth_keys,
) -> GearPair:
    """The pair of a section, at the centre distance of its machine or that of its shifts.

    Parameters
        given : PairKeys, with module and pressure_angle
        teeth : (int, int)
        distance : float [mm] - None: without backlash by the shifts
        teeth_keys : keys of the section that hold the teeth
    Raises
        NoSolution - where the teeth cannot mesh
    """
    shift = as_pair(given.profile_shift)
    known = _of_teeth(given, teeth)
    pair = GearPair(**known, given_shift=shift, given_distance=distance, teeth_keys=teeth_keys)
    return pair if shift is None or distance is None else _without_difference(pair)


def rack_at(given: PairKeys, teeth: int) -> RackMesh:
    """A pinion of a section on a rack of the same reference profile.

    Parameters
        given : PairKeys, with module and pressure_angle
        teeth : int - of the pinion
    Raises
        NoSolution - where pinion and rack cannot mesh
    """
    from gearlink.core.parts.gears.rack import RackMesh, beside_a_rack

    first, second = given.profile_shift or (0.0, 0.0)
    if second != 0.0:
        raise NoSolution("a rack has no shift", key="profile_shift[1]", fix="give profile_shift: [x1, 0]")
    pair = beside_a_rack(_of_teeth(given, (teeth, teeth)), first)
    return RackMesh(data_of(given, pair, rack=True))  # type: ignore[arg-type]  # which makes it the data of a rack


def _on_rack(spec: GearPairSpec, known: dict[str, Any]) -> GearPair:
    """The gear on a rack, as gear 1 of a pair; x_1 = (a - r_1)/m where the distance to the datum line is given."""
    from gearlink.core.parts.gears.rack import beside_a_rack

    if spec.profile_shift is not None:
        return beside_a_rack(known, spec.profile_shift[0])
    assert spec.center_distance is not None, "the spec requires one of the two"
    radius = beside_a_rack(known, 0.0).reference_radius[0]
    shift = (spec.center_distance - radius) / spec.module
    if abs(shift) > _MOST_SHIFT:
        low, high = (max(0.0, radius + sign * _MOST_SHIFT * spec.module) for sign in (-1.0, 1.0))
        raise NoSolution(
            f"centre distance: {short(spec.center_distance)} mm, a profile shift of {shift:.4g} (datum line of the "
            f"rack {within(low, high, 'mm')} from the axis)",
            key="center_distance",
            fix=f"set center_distance from {within(low, high, 'mm')}",
        )
    return beside_a_rack(known, shift)


def _shared(spec: GearPairSpec, pair: GearPair, split: str) -> GearPair:
    """The pair with its shift sum shared by a criterion.

    Raises
        NoSolution - where the criterion has no share
    """
    from gearlink.core.parts.gears.shifts.candidates import strength_of
    from gearlink.core.parts.gears.shifts.shift_split import Diagonal

    diagonal = Diagonal(pair)
    with at_key("shift_split"):
        try:
            found = diagonal.split(split, strength_of(data_of(spec, pair)))
        except NoSolution as error:
            fix = "use another criterion, or x1 as a number: --candidates with shift_split: equal lists all"
            raise NoSolution(error.message, fix=error.fix or fix) from error
        return diagonal.at(found.first)


def _without_difference(pair: GearPair) -> GearPair:
    """The pair by its shifts alone, where its centre distance says the same."""
    try:
        alone = replace(pair, given_distance=None)
    except NoSolution:
        return pair
    assert pair.given_distance is not None
    same = abs(abs(alone.center_distance) - pair.given_distance) <= _AGREE * pair.module
    return alone if same else pair


def data_of(spec: GearPairSpec | PairKeys, pair: GearPair, *, rack: bool = False) -> GearData:
    """The pair of a design file, or a pinion on a rack, with all that its drawing needs.

    Raises
        NoSolution - for allowances beyond the tables of their standards
    """
    rack = rack or getattr(spec, "rack", False)
    made = GearData
    if rack:
        from gearlink.core.parts.gears.rack import RackData as made
    materials = material_of(spec.material, 0), material_of(spec.material, 1)
    conditions = None
    if spec.rating is not None:
        limits = tuple((each.contact_limit, each.bending_limit) for each in materials)
        conditions = spec.rating.conditions(limits, spec.accuracy_grade)
    return made(
        pair=pair,
        face_width=both(spec.face_width),
        pins=both(spec.pin_diameter) or (None, None),
        allowances=allowances_of(spec.allowances, pair, rack=rack),
        distance_allowance=_distance_allowance(spec, pair, rack=rack),
        load=load_of(spec.load),
        materials=materials,
        edition=spec.edition,
        load_share=spec.load_share,
        rims=both(spec.rim_thickness) or (None, None),
        accuracy_grade=spec.accuracy_grade,
        conditions=conditions,
        required=required_of(getattr(spec, "limits", None)),
    )


def required_of(limits: Any) -> Required:
    """The safeties that the section `limits` asks for."""
    if limits is None:
        return Required()
    return Required(limits.safety_pitting, limits.safety_bending, limits.safety_scuffing)


def allowances_of(given: AllowanceSpec | None, pair: GearPair, *, rack: bool = False) -> tuple[Pair, Pair] | None:
    """Upper and lower thickness allowance of both gears [mm]; a rack has no diameter, its gear's stands for it."""
    if given is None:
        return None
    if given.upper is not None and given.lower is not None:
        return (given.upper[0], given.lower[0]), (given.upper[1], given.lower[1])
    from gearlink.core.parts.gears.measures.allowances import thickness_allowances

    series = given.series if isinstance(given.series, list) else [given.series, given.series]
    radii = (pair.reference_radius[0],) * 2 if rack else pair.reference_radius
    with at_key("allowances.series"):
        first, second = (
            thickness_allowances(str(one), 2.0 * abs(radius)) for one, radius in zip(series, radii, strict=True)
        )
    return first, second


def _distance_allowance(spec: GearPairSpec | PairKeys, pair: GearPair, *, rack: bool) -> float | None:
    given = spec.center_distance_allowance
    if not isinstance(given, str):
        return given
    from gearlink.core.parts.gears.measures.allowances import js7

    with at_key("center_distance_allowance"):
        on_rack = pair.reference_radius[0] + pair.profile_shift[0] * pair.module
        return js7(on_rack if rack else abs(pair.center_distance))


def load_of(given: LoadSpec | None) -> Load | None:
    """The load of a file."""
    if given is None:
        return None
    torque = given.torque
    if given.power is not None and given.speed is not None:
        torque = torque_of(given.power, given.speed)
    factors = Factors(**given.factors.model_dump())
    named = frozenset(given.factors.model_fields_set)
    return Load(torque=torque, force=given.tangential_force, speed=given.speed, factors=factors, given=named)


def material_of(given: MaterialSpec, gear: int) -> Material:
    """The material of gear 0 or 1."""
    values = {name: value[gear] if isinstance(value, list) else value for name, value in given}
    return Material(**values)


def tools_of(spec: GearPairSpec | PairKeys) -> tuple[RackTool | None, RackTool | None]:
    """The rack tools that the file gives, checked that they have a tip.

    Raises
        NoSolution - for a pointed tool
    """
    given = spec.tool
    one, other = given if isinstance(given, list) else (given, given)
    return _tool(spec, one), _tool(spec, other)


def _tool(spec: GearPairSpec | PairKeys, given: ToolSpec | None) -> RackTool | None:
    if given is None:
        return None
    alpha, rounding = math.radians(spec.pressure_angle), given.rounding
    if rounding is None:
        clearance = given.addendum - spec.addendum
        rounding = max(0.0, usual_rounding(alpha, given.addendum, clearance, given.residual_undercut))
    tool = RackTool(addendum=given.addendum, rounding=rounding, residual_undercut=given.residual_undercut)
    tool.require_tip(alpha)
    return tool


def as_pair(value: Any) -> Any:
    """A list of two as a pair; anything else as it is."""
    return (value[0], value[1]) if isinstance(value, list) else value


def both(value: Any) -> Any:
    """A number that serves both gears, or one for each; None where there is none."""
    if value is None:
        return None
    return (value[0], value[1]) if isinstance(value, list) else (value, value)
