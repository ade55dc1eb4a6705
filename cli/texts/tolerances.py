"""The codes GL170 to GL176: what can be wrong with the section `tolerance`."""

from __future__ import annotations

from gearlink.core.report import Rule

TOLERANCES: tuple[Rule, ...] = (
    Rule(
        "GL170",
        "source is no size of this design",
        "A source names no key with a real number, no centre distance, pin or gear of this kind of design, or a whole "
        "number, which does not scatter.",
        "A tolerance on something that the design does not have would change nothing without a word.",
        "Take a key of the file, such as links.crank, or centers.MESH, pins.PIN, bearings.PIN, gears.GEAR with grade.",
    ),
    Rule(
        "GL171",
        "limits of a source wrong",
        "A source has no limits, two forms of them, limits in the wrong order or of no width, or a form that does not "
        "belong to what it names.",
        "Without width nothing scatters, and two forms could contradict each other.",
        "Give one of plus_minus, lower with upper, limits, sigma, class, fit with size, group with bore, clearance, "
        "grade with width, eccentricity, measured.",
    ),
    Rule(
        "GL172",
        "process capability wrong",
        "C_pk is above C_p, or below it without saying towards which limit the process lies.",
        "C_pk = C_p (1 - offset/half width): it is at most C_p.",
        "Give cpk at most cp, and shift: up or down.",
    ),
    Rule(
        "GL173",
        "not in the tables of ISO 286 or ISO 5753",
        "The tolerance class, fit, grade or clearance group does not exist, or not for this size (ISO 286: to 500 mm; "
        "bearings: bores to 100 mm).",
        "Nothing is extrapolated from tables.",
        "Take another class, or give the limits themselves.",
    ),
    Rule(
        "GL174",
        "not in the range of ISO 1328-1",
        "The grade, module, diameter or face width lies outside of ISO 1328-1:2013 (grades 1 to 11, modules 0.5 to 70 "
        "mm, diameters 5 to 15000 mm, widths 4 to 1200 mm).",
        "Nothing is extrapolated.",
        "Give the eccentricity itself.",
    ),
    Rule(
        "GL175",
        "too many sources",
        "The sources take more random numbers than 64 (32 with Sobol' indices); a pin takes two.",
        "Scrambled Sobol' points lose their balance in so many dimensions.",
        "Leave out the sources that contribute least.",
    ),
    Rule(
        "GL176",
        "correlations contradict each other",
        "The correlations of the file make no positive matrix, lie outside -1 to 1, or name what is no source.",
        "Three parts cannot all scatter against each other.",
        "Correlate what one machine makes in one setting; make rho smaller.",
    ),
)
