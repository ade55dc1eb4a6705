"""Texts of the codes that the smaller gear-linkages add."""

from __future__ import annotations

from gearlink.cli.texts.explanation import Explanation

LINKAGES: dict[str, Explanation] = {
    "GL206": Explanation(
        "tips foul in an internal mesh",
        "The tips of planet and ring gear cut into each other where their tip circles cross, outside the contact.",
        "The gears cannot turn, or cannot be put together.",
        "Give the ring gear more teeth or the planet fewer: at 20 deg about 8 teeth of difference are needed.",
        "z1 (inv alpha_a1 + delta_1) - z2 (inv alpha_a2 + delta_2) + (z2 - z1) inv alpha >= 0, delta the angles from "
        "the line of centres to where the tip circles cross",
        "own derivation",
        ("tip-fouling",),
        ("gears",),
    ),
    "GL305": Explanation(
        "five-bar closes",
        "The two couplers reach from one geared link to the other at every input angle (a design that opens is refused "
        "with the worst angle).",
        "Where they do not reach, the mechanism cannot be put together or jams there.",
        "Lengthen coupler and follower together, make them more equal, or shorten the geared links.",
        "|b - c| < |BD| < b + c over the whole period; function form |c - e| < |CE| < c + e over the range",
        "own derivation",
        ("closure",),
        ("links", "range"),
    ),
    "GL306": Explanation(
        "output does not make the motion that is asked for",
        "The output of a two-gear four-bar stands still where coupler and crank have a certain speed ratio; the links "
        "reach it, or do not, against what `target.motion` says.",
        "With a sun on a crank-rocker the output never stands: the coupler would have to turn faster than the crank.",
        "Change z5/z2 beyond the limit named, take a ring gear, or a drag link.",
        "w2/w1 = 1 + z5/z2 (sun), 1 - z5/z2 (ring gear): the line CD passes through the pitch point on AB",
        "thesis 2.2.1; the limit for a crank-rocker is an own derivation",
        ("dwell-condition",),
        ("target.motion", "gears", "links"),
    ),
    "GL307": Explanation(
        "target of a synthesis missed",
        "The design that was found misses what `target` asks for by more than the tolerance.",
        "The residual is measured on the motion that the design makes, not on the equations of the search.",
        "Ask for less, free more of the links, or start from other links.",
        "residual = value reached - value asked for",
        "own derivation",
        ("target",),
        ("target", "target.swing", "links"),
    ),
    "GL308": Explanation(
        "gear train does not fit the linkage",
        "A gear in the middle of a train is fixed, neighbours do not sit on one link, or a centre distance is not the "
        "link's length.",
        "Gears stay in mesh only where one link keeps their distance; only the ends of a train may be fixed to links.",
        "Put neighbours on two pins of one link, fix end gears only, and to a link that carries their pin.",
        "dF = 3 (J - R) - 2 (J - R) - (J - 1) = 1 - R",
        "thesis 2.1",
        ("train-fit",),
        ("trains", "links"),
    ),
    "GL309": Explanation(
        "degrees of freedom are not those wanted",
        "Linkage and trains together have another number of degrees of freedom than `mobility` asks for.",
        "With none the mechanism is locked; with two it needs a second input.",
        "Fix or free end gears: a train takes R - 1 degrees of freedom away.",
        "F = F_linkage + sum(1 - R_i)",
        "thesis 2.1",
        ("mobility",),
        ("mobility", "trains"),
    ),
    "GL310": Explanation(
        "start with a shock, and what the model leaves out",
        "A mutilated gear takes its mate to full speed at once (always a warning).",
        "The model ends at the pitch circles: the cut tips of the first and last tooth and the locking arcs change "
        "where exactly motion begins and ends, and the blow limits the speed.",
        "Let the crank stand at a dead centre (leave start_angle out), keep the speed low, add entry cams.",
        "speed ratio in motion Z_M/(Z_F i_r)",
        "own derivation; thesis figure 2-6 gives no formula",
        ("start-shock",),
        ("start_angle", "reduction", "gears"),
    ),
    "GL311": Explanation(
        "dwell shorter than wanted",
        "The slider leaves the band of +- dwell.tolerance before the carrier has turned through the dwell.",
        "The slider does not stand where it should: the ripple of the arc about the rod's circle is too large.",
        "Allow a larger tolerance, ask for a smaller dwell.angle, or let target find the rod.",
        "widest carrier angle about mid-dwell with max s - min s <= 2 tolerance",
        "own derivation; thesis 2.2.2, figure 2-5",
        ("dwell-quality",),
        ("dwell.tolerance", "dwell.angle", "rod", "target"),
    ),
}
