"""The rules that the checks of the dwell gears judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

START_SHOCK = Rule(
    "GL310",
    "impact at start and stop of the driven gear",
    "A mutilated gear takes its mating gear to full speed at once (always a warning).",
    "The model ends at the pitch circles: the cut tips of the first and last tooth and the locking arcs change "
    "where exactly motion begins and ends, and the blow limits the speed.",
    "Let the crank be at a dead centre (omit start_angle), keep the speed low, add entry cams.",
    "speed ratio in motion Z_M/(Z_F i_r)",
    "own derivation; thesis figure 2-6 gives no formula",
    ("start-shock",),
    ("start_angle", "reduction", "gears"),
    side="<=",
)
GAP = Rule(
    "GL316",
    "gap of the driving gear too short",
    "Between the last tooth of a group and the first of the next, some tooth stays in contact, or nearly so.",
    "The driven gear is held by its locking arc only while no tooth drives it: without that time both fight.",
    "Take fewer teeth in a group or more full teeth.",
    "Z_M/g - n + 1 - eps pitches without contact; fails below 0, warns below 1",
    "own derivation: each tooth is in contact for eps pitches, the teeth next to a gap are Z_M/g - n + 1 apart",
    ("gap",),
    ("gears.group_teeth", "gears"),
)
DWELL_QUALITY = Rule(
    "GL311",
    "dwell shorter than required",
    "The slider leaves the band of +- dwell.tolerance before the carrier has turned through the dwell.",
    "The slider is not where it should be: the ripple of the arc about the rod's circle is too large.",
    "Allow a larger tolerance, specify a smaller dwell.angle, or let target find the rod.",
    "widest carrier angle about mid-dwell with max s - min s <= 2 tolerance",
    "own derivation; thesis 2.2.2, figure 2-5",
    ("dwell-quality",),
    ("dwell.tolerance", "dwell.angle", "rod", "target"),
)
