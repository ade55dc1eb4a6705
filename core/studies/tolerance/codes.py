"""The rules of tolerance studies and of the register budget."""

from __future__ import annotations

from gearlink.core.base.report import Rule

NO_MECHANISM = Rule(
    "GL177",
    "some designs as manufactured do not exist",
    "With the sizes of some samples the mechanism does not close, or its crank does not turn (a warning).",
    "Such a design counts as one that fails.",
    "Tighten the sizes that contribute most, or keep further away from the change point.",
    "share of samples without a mechanism",
    "own choice",
    ("no-mechanism",),
    ("tolerance.sources", "tolerance"),
)
NOT_LINEAR = Rule(
    "GL178",
    "sensitivities do not explain the variation",
    "The variance by the sensitivities at the nominal design is less than nine tenths of the sampled one (a warning).",
    "Linear shares then point at the wrong part: the quantity has a kink, or bends within the tolerances.",
    "Request Sobol' indices (--sobol), which need no linear response.",
    "sum (sensitivity sigma)^2 >= 0.9 variance of the samples",
    "own choice",
    ("linear-shares",),
    ("tolerance.sources", "tolerance"),
)
TARGET_YIELD = Rule(
    "GL179",
    "yield below its target",
    "The lower end of the yield's interval lies below tolerance.target_yield.",
    "More of the machines than allowed would not do what is required of them.",
    "Tighten what contributes most (table contributions), or let --allocate choose the grades.",
    "lower end of the 95 % interval >= target_yield",
    "own choice",
    ("target-yield",),
    ("tolerance.target_yield", "tolerance"),
)
REGISTER_BUDGET = Rule(
    "GL520",
    "register budget exceeded",
    "The errors of the parts add up to more than register.tolerance over the stretch that prints or holds: 99.73 % of "
    "the machines do not keep it, or at worst one does not (a warning).",
    "Colours no longer fall on each other, or the sheet is handed over where the next gripper does not expect it.",
    "Improve first what is listed first in the table budget.",
    "what 99.73 % keep over the stretch, relative to its start, <= register.tolerance; worst case: a warning",
    "ISO/IEC Guide 98-3, 5.1.2; own derivation of the gains",
    ("register-budget",),
    ("register.tolerance", "register"),
    side="<=",
)
BACKLASH_IN_DWELL = Rule(
    "GL521",
    "torque turns within the dwell",
    "The torque on the output (of a press the force on racks and cylinder) changes its sign while the output should "
    "stand or print (a warning).",
    "There the output jumps by the backlash of all meshes on its way.",
    "Brake the output with more friction than its inertia requires, or preload the gears.",
    "sign of J W' w^2 + T_f sign(W) + T_load over the stretch; of a press sign of q''",
    "own derivation",
    ("backlash-in-dwell",),
    ("register.friction", "register"),
    side="<=",
)
