"""The rules that the checks of linkages judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

GEAR_COLLISION = Rule(
    "GL301",
    "gears interfere",
    "Two gears of one plane that do not mesh come closer to each other than limits.gear_gap somewhere in the cycle; "
    "if a negative limit lets them overlap, it is a warning.",
    "A gear on the crank pin moves: its minimum distance counts, not the frame length. Example 3 of the source "
    "compares the tip circles with the frame length and misses a collision of 1.6 mm.",
    "Lengthen the frame or shorten the crank by the missing amount, or use smaller gears; in a synthesis use a larger "
    "idler, in a five-bar with an idler a longer frame, within the reach of the idler.",
    "minimum distance of the axes over the cycle - both tip radii >= limits.gear_gap; gears 1 and 5 of a three-gear "
    "four-bar: |l4 - l1| - m (z1 + z5)/2 - 2 m",
    "own derivation; thesis 4.2.2, 4.2.3 with the distance at the closest",
    ("gear-collision",),
    ("links", "momentary", "back_step", "dwell", "speed", "gears", "pin_radius"),
)
SHAFT_CLEARANCE = Rule(
    "GL302",
    "gear, rim or roller reaches a shaft",
    "A part that turns or swings reaches a shaft that crosses its plane: a gear with its tips, a ring gear with its "
    "teeth or its rim, a cam or its roller, a link, a spring, or another shaft. If the file gives the shaft's radius, "
    "reaching it fails. If not, the check warns where less than the minimum shaft radius is left: limits.least_shaft, "
    "2 modules of gears, the radius of the roller or cam.shaft_radius of cams. Links count as lines without width. "
    "Also a gear on its own shaft: the rim below its teeth is at least half a tooth depth.",
    "The shaft cannot pass through this plane: it must end before it (be overhung).",
    "Overhang the shaft, make it thinner, or enlarge the distance; give its radius (shafts, cam.shaft_radius), so that "
    "it is checked.",
    "minimum distance of the axes over the cycle - tip radius - shaft radius >= 0; joint C from A: max(l2 - l1, l4 - "
    "l3); ring gear: tip radius - distance - shaft radius (shaft within) or distance - rim - shaft radius (shaft "
    "without), the greater of the two, each at its minimum over the cycle; rim = m (z/2 + 3.25) or gears.rim; own "
    "shaft: root radius - shaft radius >= h/2",
    "own derivation; the minimum rim: ISO 6336-3",
    ("shaft-clearance", "shaft-seat", "body-clearance"),
    ("shafts", "cam.shaft_radius", "cam", "links", "gears", "output_pins", "center_distance"),
)
TRANSMISSION_ANGLE = Rule(
    "GL303",
    "transmission angle too small",
    "The angle between coupler and driven link, counted up to 90 deg, falls below limits.transmission_angle.",
    "The force along the coupler then hardly turns the driven link: joint forces are high, and play has a large "
    "effect.",
    "Bring coupler and driven link nearer to a right angle: shorten the crank, or use a larger idler, or a shorter "
    "frame in a drag link; for a slider lengthen the rod.",
    "mu = min(gamma, 180 deg - gamma), cos(gamma) = (l2^2 + l3^2 - n^2)/(2 l2 l3), n the diagonal from the crank pin; "
    "for a rod and its slide line 90 deg less the rod's inclination; fails below the limit, warns less than 5 deg "
    "above it; below 3 deg the message names the condition number 1/sin(mu)",
    "VDI 2142; thesis 4.2",
    ("transmission-angle",),
    (
        *("links", "cylinder.double_crank", "bed.double_crank", "drive", "slider"),
        *("back_step", "dwell", "speed", "momentary", "gears", "swing", "function"),
    ),
)
TARGET = Rule(
    "GL307",
    "target of a synthesis missed",
    "The design that was found misses what `target` requires by more than the tolerance.",
    "The residual is measured on the motion that the design makes, not on the equations of the search.",
    "Relax the target, let more of the links change, or start from other links.",
    "residual = value reached - required value",
    "own derivation",
    ("target",),
    ("target", "target.swing", "back_step.angle", "links"),
    side="<=",
)
TRAIN_FIT = Rule(
    "GL308",
    "gear train does not fit the linkage",
    "A gear in the middle of a train is fixed, neighbours do not sit on one link, a centre distance is not the link's "
    "length, a ring is too small for the gear in it, or the links that the gears are fixed to prevent them from "
    "turning.",
    "Gears stay in mesh only where one link keeps their distance; only the ends of a train may be fixed to links.",
    "Put neighbours on two pins of one link, fix end gears only, and to a link that carries their pin.",
    "dF = 3 (J - R) - 2 (J - R) - (J - 1) = 1 - R",
    "thesis 2.1",
    ("train-fit",),
    ("trains", "links"),
)
MOBILITY = Rule(
    "GL309",
    "degrees of freedom are not the required ones",
    "Linkage and trains together have another number of degrees of freedom than `mobility` requires, or the number "
    "agrees only because redundant joints and trains are counted.",
    "With 0 the mechanism is locked; with 2 it needs a second input.",
    "Fix or free end gears: a train removes R - 1 degrees of freedom.",
    "F = F_linkage + sum(1 - R_i)",
    "thesis 2.1",
    ("mobility",),
    ("mobility", "trains"),
    side="",
)
DWELL_WINDOW = Rule(
    "GL313",
    "window of the dwell shorter than required",
    "The output leaves the band of +-tolerance before the crank has turned through the window.",
    "The machine works while the output is assumed to be at rest, but its position is off by more than the tolerance.",
    "Set links.frame or links.crank to a length that the finding names; otherwise specify a shorter window or a "
    "larger tolerance, or change the teeth: with three gears fewer on the idler.",
    "longest crank angle with |phi5 - middle| <= tolerance, against dwell.window or dwell_window",
    "own derivation; thesis 4.2.1 speaks of a dwell within usual deviations",
    ("dwell-window",),
    ("dwell.window", "links", "dwell_window", "dwell"),
)
DWELL_EDGE = Rule(
    "GL314",
    "dwell sensitive to the frame length",
    "The back-step nearly fills the band, or the interval of frame lengths that meet the specification is narrow.",
    "The window is longest where the back-step just fits the band. With a slightly different frame it exceeds the "
    "band, and the window drops at once to three quarters.",
    "Specify a shorter window, or with a tolerance alone the default dwell.margin; or keep the frame within the "
    "interval that is given.",
    "0.992 < D/(2 tolerance) <= 1, or frame_length_interval below 0.05 mm",
    "own derivation: the longest window has D = 2 tolerance",
    ("dwell-edge",),
    ("dwell.margin", "dwell.tolerance", "dwell"),
    side="<=",
)
CLOSURE = Rule(
    "GL305",
    "closure error of the joints",
    "The links close every loop at every input (a loop that does not close is an error, with the worst input); for a "
    "planar mechanism the maximum gap of a joint over the rows.",
    "Where a loop does not close, the mechanism cannot be assembled or jams.",
    "Make the links that close a loop longer or more equal, shorten the driven ones, or keep away from a dead centre.",
    "five-bar |b - c| < |BD| < b + c over the period, function form |c - e| < |CE| < c + e over the range; planar "
    "mechanism: fails above 1e-9 of the largest length",
    "own derivation",
    ("closure",),
    ("links", "range"),
)
POSE_ORDER = Rule(
    "GL340",
    "poses out of order",
    "The input angles of the poses neither rise nor fall in their order, or two poses need different assemblies.",
    "Driven in one sense, the linkage moves the body through the poses in another order, or never reaches one of them.",
    "Keep fewer of the links (target.keep), change a pose, or put the poses in another order.",
    "input angles of the poses within a period, rising or falling; C on one side of B to D in all of them",
    "thesis 2.2.2 VI; own derivation",
    ("pose-order",),
    ("target.poses", "target"),
    side="",
)
LAY_SPEED = Rule(
    "GL341",
    "sheet too fast before the front lay",
    "Over the distance feed.lay.distance before the front lay the sheet is faster than feed.lay.speed.",
    "It strikes the lay and springs back: the register is lost.",
    "Reduce the speed or the feed radius, or let the sheet arrive where the output is slow (feed.lay.angle).",
    "maximum speed over the last feed.lay.distance <= feed.lay.speed",
    "thesis 3.3.2; own derivation",
    ("lay-speed",),
    ("feed.lay.speed", "feed.lay", "input_speed", "feed"),
    side="<=",
)


ASSEMBLY = Rule(
    "GL318",
    "assembly far from the given start",
    "The direction of a link at input 0 differs by more than 45 deg from the approximate one in `start`.",
    "The approximate directions select the assembly of the links: another assembly may be intended.",
    "Set `start` to the direction found, or to that of the intended assembly; see the figure (--plot).",
    "difference of directions; warns above 45 deg",
    "own derivation",
    ("assembly",),
    ("start",),
    side="<=",
)


FULL_TURN = Rule(
    "GL330",
    "crank does not turn fully",
    "The linkage that was found for three pairs of angles goes through them, but its crank cannot make a full "
    "revolution.",
    "A drive that rotates continuously jams or breaks the linkage; one that oscillates within the range reaches all "
    "pairs.",
    "Let the drive of the crank oscillate within `range`, or specify other pairs: a smaller swing of the rocker, or "
    "another crank angle at one of them.",
    "shortest + longest link below the sum of the other two, crank or frame the shortest",
    "F. Grashof's rule",
    ("full-turn",),
    ("function.pairs", "function", "links"),
    side="",
)


DWELL_CONDITION = Rule(
    "GL306",
    "output does not make the required motion",
    "The output of a two-gear four-bar dwells where coupler and crank have a certain speed ratio; the links reach "
    "this ratio, or do not, contrary to `target.motion`.",
    "With a sun on a crank-rocker the output never dwells: the coupler would have to turn faster than the crank.",
    "Change z5/z2 beyond the limit in the message, or use a ring gear or a drag link; `synth momentary-dwell` finds "
    "the one frame length with a momentary dwell.",
    "w2/w1 = 1 + z5/z2 (sun), 1 - z5/z2 (ring gear): the line CD passes through the pitch point on AB",
    "thesis 2.2.1; the limit for a crank-rocker is an own derivation",
    ("dwell-condition",),
    ("target.motion", "gears", "links"),
    side="",
)


LOCKING = Rule(
    "GL344",
    "locking disc, arcs and slots leave too little metal",
    "The lip of the wheel between the locking arc and the end of a slot has no thickness, two slots run into each "
    "other at their bottoms, or the locking disc is so small that it does not reach the wheel or that the lips hit its "
    "edge on their way past. Of a mutilated gear: the plate's arc or the disc's cut-out reaches a shaft.",
    "The lip takes the shock of the entering pin. In the dwell no pin is in a slot: the arc alone holds the wheel, "
    "and where the disc does not reach it the wheel turns freely, so that the pin misses the slot at its next entry.",
    "Use a smaller locking disc (locking_radius) or a thinner pin where metal is missing, a larger disc where it does "
    "not hold the wheel; a larger center_distance helps with both. If a brake or a detent holds the wheel, omit "
    "locking_radius: then the disc is not checked. Of a mutilated gear use a smaller locking.radius for the shaft of "
    "the gear, a smaller locking.plate_radius for that of the wheel.",
    "r - b/2 - locking_radius - locking_clearance > 0, b = 2 r_pin + slot_clearance; locking_radius > a - tip_radius; "
    "between the bottoms of two slots (a - r) sin(pi/n) > b/2 (external); mutilated gear: a - R - c and a - p - c "
    "above the radii of the shafts",
    "thesis 4.2.1; own derivation",
    ("locking",),
    ("locking_radius", "pin_radius", "center_distance"),
)
STEP_RATE = Rule(
    "GL345",
    "step rate too high for a Geneva drive",
    "The drive makes more steps per minute than limits.steps_per_minute (a warning).",
    "The acceleration jumps at both ends of every step, and its peak is high: above 100 to 200 steps per minute such "
    "drives are noisy and wear.",
    "Reduce the speed, or use more slots or a drive without the jump: `compare` compares it with a geared linkage and "
    "a cam.",
    "input_speed x pins",
    "thesis 4.2.1: 100 to 200 steps in a minute",
    ("step-rate",),
    ("input_speed", "pins", "limits.steps_per_minute"),
    side="<=",
)
PIN_ENTRY = Rule(
    "GL347",
    "play of the locked wheel larger than that of the pin in its slot",
    "When the pin reaches its slot, the wheel may be off by half of locking_play; at the mouth of the slot that is "
    "more than half of slot_clearance (a warning).",
    "The pin then strikes the corner of the slot and does not enter smoothly: noise, wear, and an impact at the start "
    "of the step.",
    "Use a smaller locking_clearance or a larger slot_clearance, or chamfer the mouths of the slots by more than the "
    "difference.",
    "wheel_radius sin(locking_play/2) <= slot_clearance/2",
    "own derivation",
    ("pin-entry",),
    ("locking_clearance", "slot_clearance"),
    side="<=",
)
