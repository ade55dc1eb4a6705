"""Limit checks of an external gear pair: undercut, tips, contact ratio, interference, root clearance."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

from gearlink.core.gears.codes import CONTACT_RATIO, INTERFERENCE, ROOT_CLEARANCE, TIP_THICKNESS, UNDERCUT
from gearlink.core.gears.pair import GearPair
from gearlink.core.report import Check, Status, safely_above


class GearQuantities:
    """What can be asked of a gear mesh, and so of a design that has one: mm and radians, of two gears a pair."""

    working_pressure_angle: float
    center_distance: float
    reference_center_distance: float
    shift_sum: float
    center_distance_modification: float
    tip_shortening: float
    contact_ratio: float
    profile_shift: tuple[float, float]
    reference_radius: tuple[float, float]
    base_radius: tuple[float, float]
    working_radius: tuple[float, float]
    tip_radius: tuple[float, float]
    root_radius: tuple[float, float]
    tooth_thickness: tuple[float, float]
    tip_pressure_angle: tuple[float, float]
    tip_thickness: tuple[float, float]
    min_shift_no_undercut: tuple[float, float]
    span_measurement: tuple[float, float]
    span_teeth: tuple[int, int]
    specific_sliding: tuple[float, float] | None


GEAR_QUANTITIES = tuple(GearQuantities.__annotations__)
GEAR_CHECKS = tuple(rule.name for rule in (UNDERCUT, TIP_THICKNESS, CONTACT_RATIO, INTERFERENCE, ROOT_CLEARANCE))


class Limits(Protocol):
    """What the checks read of a spec's `limits`."""

    @property
    def undercut(self) -> float: ...
    @property
    def tip_thickness(self) -> float: ...
    @property
    def contact_ratio(self) -> float: ...


def gear_quantity(pair: GearPair, name: str) -> Any:
    """A quantity of a pair, or None where the teeth have none: no bound of the sliding where a tip reaches the
    mate's base tangent point.

    Notes
        The check `involute-interference` fails where it goes beyond and says so.
    """
    if name == "specific_sliding" and min(pair.interference_margin) <= 0.0:
        return None
    return getattr(pair, name)


def gear_check(name: str, pair: GearPair, limits: Limits, mesh: str = "", shift_key: str = "") -> Iterator[Check]:
    """The findings of one of GEAR_CHECKS on a pair.

    Parameters
        name : str - one of GEAR_CHECKS
        pair : GearPair
        limits : the `limits` section of a spec
        mesh : str - name of the mesh in a design with several, put before the message
        shift_key : str - the design file's key of both profile shifts, for remedies; empty where it has none
    Source
        ISO 21771 for the quantities; limits are usual practice (tip thickness, contact ratio, clearance)
    """
    before = f"{mesh.replace('_', '-')} mesh: " if mesh else ""
    for gear in (0, 1):
        if name == "undercut":
            yield _undercut(pair, gear, limits.undercut, before)
        elif name == "tip-thickness":
            yield _tip_thickness(pair, gear, limits, before, shift_key)
        elif name == "involute-interference":
            yield _interference(pair, gear, limits, before, shift_key)
        elif name == "root-clearance":
            yield _root_clearance(pair, gear, before)
        elif name == "contact-ratio" and gear == 0:
            yield CONTACT_RATIO.below(
                pair.contact_ratio,
                limits.contact_ratio,
                limits.contact_ratio + 0.1,
                "1",
                f"{before}the contact ratio",
                "take more teeth, a smaller pressure angle or less profile shift",
            )


def _undercut(pair: GearPair, gear: int, margin: float, before: str) -> Check:
    x, least = pair.profile_shift[gear], pair.min_shift_no_undercut[gear]
    status: Status = "pass" if x >= least else "warn" if x >= least - margin else "fail"
    text = f"{before}gear {gear + 1} ({pair.teeth[gear]} teeth) has x = {x:.6g}, undercut begins below {least:.6g}"
    if status != "pass":
        text += f": raise its profile shift to {safely_above(least, 4)} or take more teeth"
    return UNDERCUT.check(status, text, x - least, -margin)


def _tip_thickness(pair: GearPair, gear: int, limits: Limits, before: str, shift_key: str) -> Check:
    share = pair.tip_thickness[gear] / pair.module
    limit = limits.tip_thickness
    warn = limit + 0.15
    aims = [aim for aim in (warn, limit) if share < aim]
    remedy = next(filter(None, (_repaired(pair, gear, limits, aim, shift_key) for aim in aims)), "")
    return TIP_THICKNESS.below(
        share,
        limit,
        warn,
        "1",
        f"{before}the tip thickness of gear {gear + 1} over the module",
        f"lower its profile shift or its addendum{remedy}",
    )


def _repaired(pair: GearPair, gear: int, limits: Limits, tip_thickness: float, shift_key: str) -> str:
    """The shifts that repair a tip, after the words of a remedy; nothing where none do or the file has no such key."""
    if not shift_key:
        return ""
    from gearlink.core.gears.remedies import repaired_shifts

    shifts = repaired_shifts(pair, gear, tip_thickness, limits.contact_ratio)
    if shifts is None:
        return ""
    return f"; {shift_key} [{shifts[0]:.9g}, {shifts[1]:.9g}] does it at the same centre distance"


def _interference(pair: GearPair, gear: int, limits: Limits, before: str, shift_key: str) -> Check:
    margin = pair.interference_margin[gear]
    status: Status = "fail" if margin < 0.0 else "pass"
    text = f"{before}the tip of gear {gear + 1} stays {margin:.4g} mm short of the mate's base tangent point"
    if status == "fail":
        text = (
            f"{before}the tip of gear {gear + 1} goes {-margin:.4g} mm beyond the mate's base tangent point: "
            f"raise the profile shift of gear {2 - gear} or lower the addendum of gear {gear + 1}"
            f"{_repaired(pair, gear, limits, limits.tip_thickness, shift_key)}"
        )
    return INTERFERENCE.check(status, text, margin, 0.0, "mm")


def _root_clearance(pair: GearPair, gear: int, before: str) -> Check:
    least, usual = 0.05, 0.15
    return ROOT_CLEARANCE.below(
        # The profile's own coefficient: with full tip shortening it is what remains, and carries no rounding.
        pair.clearance,
        least,
        usual,
        "1",
        f"{before}the clearance at the root of gear {gear + 1} over the module",
        f"raise the clearance coefficient to {least if pair.clearance < least else usual:g} or more",
    )
