"""What each code means, how to repair the design, and the key that a check's finding is about."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

from gearlink.core.base.codes import rules
from gearlink.core.base.report import Check, Rule

# The codes GL1xx: what can be wrong with a design file or a command line

FILES: tuple[Rule, ...] = (
    Rule(
        "GL101",
        "file cannot be read",
        "There is no such file or folder, it may not be read, or a folder holds no design file (.yaml, .yml).",
        "Nothing can be computed without the file; where one file is required, none is chosen from a folder.",
        "Check the path. `gearlink batch` and `gearlink check` take folders, all other commands one file, or - for "
        "standard input.",
    ),
    Rule(
        "GL102",
        "not plain UTF-8 text",
        "The file has another encoding, or holds control characters.",
        "In another encoding a character may be read as a different one, and an invisible character changes a key "
        "unnoticed.",
        "Save the file as UTF-8 without formatting; delete the character at the line and column of the message.",
    ),
    Rule(
        "GL103",
        "not a YAML design",
        "The text breaks the rules of YAML, or is not made of `key: value` lines.",
        "Usual causes: tabs in the indentation, a missing space after a colon, a bracket or quotation mark that is "
        "never closed, characters that only look like plain ones, a second document, tags or directives.",
        "The caret marks where reading failed; the cause often lies at the end of the line above. `gearlink new KIND` "
        "prints a file that works.",
    ),
    Rule(
        "GL104",
        "key given twice",
        "The same key is given twice in one section.",
        "Most readers silently keep the last one; which of the two was meant cannot be known.",
        "Delete one of the two lines.",
    ),
    Rule(
        "GL105",
        "unknown key",
        "The section has no such key.",
        "A misspelt key would otherwise be ignored, and the default used instead.",
        "Use the nearest key, which the message names; `gearlink schema KIND` lists all of them with units and "
        "defaults.",
    ),
    Rule(
        "GL106",
        "key missing",
        "A key that has no default is missing, or none of several alternatives is given.",
        "Without it the design is not determined.",
        "Add the key; the message explains it. `gearlink new KIND` prints a complete file.",
    ),
    Rule(
        "GL107",
        "wrong type of value",
        "A number, a text, a list or a section is given where another of these is required, or a list has a wrong "
        "length.",
        "Numbers in quotation marks are text, 40:20 and no are text in YAML 1.2, and true is no number.",
        "Write the value as the message says: a number plain or with a unit, without quotation marks.",
    ),
    Rule(
        "GL108",
        "value out of range",
        "A number lies outside its range or is not finite, or a word is none of the choices.",
        "The ranges exclude what no machine has: negative lengths, angles above 360 deg, pressure angles of 45 deg, "
        "and numbers above 1e12 or, except for 0, below 1e-30 in magnitude.",
        "Use a value from the allowed range or list in the message. Units are mm, deg, 1/min, sheets/h, N, kg, kg m^2 "
        "and N m.",
    ),
    Rule(
        "GL109",
        "unknown kind of design",
        "The key `kind` names no kind that gearlink knows.",
        "The kind decides which keys the file has and which commands apply.",
        "Use one of the kinds in the message; `gearlink explain KIND` says what each is.",
    ),
    Rule(
        "GL110",
        "file too large, or too many errors",
        "The file is too large, nested too deeply or has too many values; or more errors were found than are shown.",
        "No design needs this size; the limits keep a wrong or malicious file from filling the memory.",
        "Check that it is the right file. Correct the errors that are shown first; further errors often disappear "
        "with them.",
    ),
    Rule(
        "GL111",
        "keys contradict each other",
        "Each value is right by itself, but together they are not: two alternatives are given, or a sum does not hold.",
        "Only one of them could be used, and the user would not know which one.",
        "Leave out one of them, or change it by the amount that the message names.",
    ),
    Rule(
        "GL112",
        "no such mechanism",
        "The file is in order, but no mechanism exists for its numbers: a linkage does not close or cannot turn, a "
        "stroke is too long, a law has no solution.",
        "Any result would belong to another mechanism.",
        "The message names the value, its limit and the key to change; change that key, or those it depends on.",
        source="the equation that has no solution is named by `gearlink explain` of the quantity",
    ),
    Rule(
        "GL113",
        "command does not apply to the file",
        "The command does not apply to this kind of design, or needs a section that the file does not have.",
        "A file needs only the sections of the commands that are run; the other sections are optional.",
        "Add the section that the message names (`gearlink schema KIND` shows its keys), or use one of the commands "
        "that apply.",
    ),
    Rule(
        "GL114",
        "--set cannot be used",
        "The argument of --set is not of the form PATH=VALUE, or its path leads through a value that is not a section.",
        "Otherwise the override would change nothing, and the user would not notice.",
        "Write the path as in the messages: gears.crank=42, teeth[1]=20, limits.gear_gap=0.5. Values are YAML.",
    ),
    Rule(
        "GL115",
        "error in the command line",
        "An argument or option is unknown, missing or has a wrong value, or names a quantity, table, kind or code that "
        "does not exist.",
        "Nothing was computed.",
        "Use the nearest name, which the message gives; `gearlink COMMAND --help` lists the options.",
    ),
    Rule(
        "GL116",
        "file cannot be written",
        "The folder does not exist and cannot be made, may not be written to, the disk is full, or the file already "
        "exists.",
        "Files are written completely or not at all: no partial file is left.",
        "Give another folder or file with --out; `gearlink new --force` overwrites.",
    ),
    Rule(
        "GL117",
        "cannot be compared",
        "`gearlink diff` was given a design and a result, designs of different kinds, or a JSON file without a result.",
        "Quantities of different kinds share names, but not meanings.",
        "Give two design files of one kind, or two files written with --format json.",
    ),
    Rule(
        "GL199",
        "fault of the program",
        "gearlink itself failed on this design; the other designs of a batch were computed.",
        "The design is not the cause.",
        "Please report it with the design file; GEARLINK_TRACEBACK=1 shows where it arose.",
    ),
)


# The codes GL150 to GL160: what can be wrong with a study file, or with the store of what was computed

STUDIES: tuple[Rule, ...] = (
    Rule(
        "GL150",
        "base design missing or given twice",
        "A study has one base design: the file that `of` names, or the one given in it under `design`.",
        "Every design of a study is the base with other values at the paths of its variables.",
        "Give `of` or `design`, exactly one.",
    ),
    Rule(
        "GL151",
        "variable names no key",
        "A variable or an entry of its `also` is not a key of the base design's kind, or its `times` names neither "
        "such a key nor a variable above it.",
        "A variable without effect would only multiply the number of designs.",
        "Use the nearest path, which the message names; `gearlink schema KIND` lists all of them.",
    ),
    Rule(
        "GL152",
        "quantity or check unknown, or not comparable",
        "An objective, a definition or a condition names a quantity that the kind does not have, a list without an "
        "index or a word where a number is needed, or cannot be read; or a check has no such code.",
        "A study can optimize and limit only numbers that are computed.",
        "Use the nearest name, which the message gives. Expressions may have numbers, quantities, [i] (from 0), + - * "
        "/, min, max, abs, sqrt and brackets.",
    ),
    Rule(
        "GL153",
        "unit differs",
        "A resolution or a limit is given in another unit than its quantity has.",
        "Nothing is converted: a wrong unit would be a wrong limit.",
        "Use the unit of the quantity, or omit the unit.",
    ),
    Rule(
        "GL154",
        "resolution missing",
        "An objective has no resolution above 0.",
        "The resolution is the largest difference that does not matter; without it a front has as many rows as "
        "designs.",
        "Give one, such as `envelope: 10 mm`.",
    ),
    Rule(
        "GL155",
        "more designs than the budget",
        "The grid of all variables holds more designs than `sampling.budget`, or a variable has no grid although the "
        "method is `grid`.",
        "A grid is computed completely or not at all.",
        "Use a coarser grid of the variable in the message, increase the budget, or use the method auto, which then "
        "samples.",
    ),
    Rule(
        "GL156",
        "base design or value rejected",
        "The base design is wrong or cannot be computed, or its model rejects a value of a variable.",
        "A study varies a design that exists; each value is checked by itself before any design is computed.",
        "Correct the base design, or narrow the range of the variable to that of its key.",
    ),
    Rule(
        "GL157",
        "store of another study",
        "The store was made for a study that differs from this one in the key of the message.",
        "Its results belong to other designs.",
        "Give another --store, or undo the change of the study.",
    ),
    Rule(
        "GL158",
        "store or worker of another program",
        "The store was made, or a worker runs, with another gearlink (its version or its code), Python, numpy or "
        "scipy, or on another type of processor.",
        "Numbers of one result would differ in their last digits. A finished store is still shown, with a note.",
        "Continue with the installation that began the store, or begin a new store.",
    ),
    Rule(
        "GL159",
        "store exists or is damaged",
        "The store already exists, and --resume was not given; or the file is not a store, or is in use; or its "
        "checksums do not match its content.",
        "Results are never overwritten, and damaged data are not used.",
        "Add --resume to continue it, or give another --store. Restore a damaged store from a copy, or compute it "
        "again.",
    ),
    Rule(
        "GL160",
        "two methods give different results",
        "A design of the front has other results when it is computed by itself than in the search.",
        "This is a fault of the program, not of the study.",
        "Please report it with the study; the message has the design and both results.",
    ),
)


# The codes GL170 to GL176: what can be wrong with the section `tolerance`

TOLERANCES: tuple[Rule, ...] = (
    Rule(
        "GL170",
        "source is not a size of this design",
        "A source must be a key with a real number, or a centre distance, pin or gear of this kind of design; whole "
        "numbers do not vary.",
        "A tolerance on something that the design does not have would have no effect.",
        "Use a key of the file, such as links.crank, or centers.MESH, pins.PIN, bearings.PIN, gears.GEAR with grade.",
    ),
    Rule(
        "GL171",
        "limits of a source wrong",
        "A source has no limits, two forms of them, limits in the wrong order or of no width, or a form that does not "
        "belong to what it names.",
        "Without width nothing varies, and two forms could contradict each other.",
        "Give one of plus_minus, lower with upper, limits, sigma, class, fit with size, group with bore, clearance, "
        "grade with width, eccentricity, measured.",
    ),
    Rule(
        "GL172",
        "process capability wrong",
        "C_pk is above C_p, or below C_p without `shift`, which says towards which limit the process is shifted.",
        "C_pk = C_p (1 - offset/half width): it is at most C_p.",
        "Give cpk at most cp, and shift: up or down.",
    ),
    Rule(
        "GL173",
        "not in the tables of ISO 286 or ISO 5753",
        "The tolerance class, fit, grade or clearance group does not exist, or not for this size (ISO 286: to 500 mm; "
        "bearings: bores to 100 mm).",
        "The tables are not extrapolated.",
        "Use another class, or give the limits directly.",
    ),
    Rule(
        "GL174",
        "not in the range of ISO 1328-1",
        "The grade, module, diameter or face width lies outside ISO 1328-1:2013 (grades 1 to 11, modules 0.5 to 70 "
        "mm, diameters 5 to 15000 mm, widths 4 to 1200 mm).",
        "The formulas are not extrapolated.",
        "Give the eccentricity directly.",
    ),
    Rule(
        "GL175",
        "too many sources",
        "The sources need more than 64 random numbers (32 with Sobol' indices); a pin needs two.",
        "Scrambled Sobol' points are no longer evenly distributed in so many dimensions.",
        "Omit the sources with the smallest contributions.",
    ),
    Rule(
        "GL176",
        "correlations contradict each other",
        "The correlations of the file do not form a positive matrix, lie outside -1 to 1, or name something that is "
        "not a source.",
        "Three parts cannot all vary in opposite directions.",
        "Correlate only parts that one machine makes in one setting; reduce rho.",
    ),
)


# The codes GL180 to GL182: what can be wrong with the unit of a value, and with a file of numbers

VALUES: tuple[Rule, ...] = (
    Rule(
        "GL182",
        "unreadable file of numbers",
        "A file named by a key contains something other than rows of two numbers.",
        "A cell that is misread or skipped would distort the curve through the points.",
        "Save the numbers as CSV: two columns with comma, semicolon or tab between them; header lines are allowed.",
    ),
    Rule(
        "GL180",
        "unknown unit",
        "A value is written as NUMBER UNIT, and no unit has that name.",
        "A value with an unknown unit cannot be converted.",
        "Use one of the units that the message lists for this key, or a plain number in the unit of the key.",
    ),
    Rule(
        "GL181",
        "unit of another quantity",
        "A value is written as NUMBER UNIT, and the unit belongs to another quantity than the key.",
        "Only units of one quantity can be converted into each other; a diametral pitch (DP) is allowed for `module` "
        "alone.",
        "Use one of the units that the message lists for this key, or move the value to the key that it belongs to.",
    ),
)


@cache
def explanations() -> dict[str, Rule]:
    """Every code with its texts, in the order of the codes: those of files and command lines, then the checks'."""
    return {rule.code: rule for rule in (*FILES, *STUDIES, *TOLERANCES, *VALUES)} | rules()


_MESHES = {"cylinder_gears": "cylinder.gears", "pinion_rack": "bed.pinion"}
"""Sections of the meshes that a message names in front."""
_PATH = re.compile(r"\b[a-z][a-z0-9_]*(?:\.[a-z][a-z0-9_]*)+\b")


def key_of(data: dict[str, Any], check: Check) -> str:
    """The key of a file that a check is about: one that its message names, else the most telling one of its code.

    Of a section it is the key that the remedy changes, where that stands in it.

    Example
        >>> key_of({"cam": {"base_radius": 9}}, Check("GL405", "sum", "fail", "", advice="increase cam.base_radius"))
        'cam.base_radius'
    """
    if member := _member(data, check):
        design = f"members.{member}.design"
        remedy = tuple((key.removeprefix(f"{design}."), value) for key, value in check.remedy)
        advice = check.advice.replace(f"{design}.", "")
        own = check._replace(what=check.what.removeprefix(f"{member}: "), remedy=remedy, advice=advice)
        return f"{design}.{key_of(data['members'][member]['design'], own)}"
    known = explanations().get(check.code)
    section = _MESHES.get(check.what.partition(": ")[0], "")
    if section and _has(data, section):
        within = (f"{section}.{key}" for key in (known.keys if known else ()))
        return next((key for key in within if _has(data, key)), section)
    # The keys of a remedy may stand anywhere: what is about to be changed is not what the finding is about.
    for path in (
        *([check.what] if check.what.isidentifier() else ()),
        *_PATH.findall(f"{check.what} {check.aside} {'' if check.remedy else check.advice}"),
        *(known.keys if known else ()),
    ):
        if _has(data, path):
            changed = (key for key, _ in check.remedy if key.startswith(f"{path}.") and _has(data, key))
            return next(changed, _line(data, path, check.what))
    return "kind"


def _member(data: dict[str, Any], check: Check) -> str:
    """The member of a machine whose name begins the message; "" without one."""
    name, colon, _ = check.what.partition(": ")
    members = data.get("members")
    design = members.get(name) if colon and isinstance(members, dict) else None
    return name if isinstance(design, dict) and isinstance(design.get("design"), dict) else ""


def _line(data: dict[str, Any], path: str, what: str) -> str:
    """Of a list of texts the one with which the message begins."""
    lines = data.get(path)
    if isinstance(lines, list):
        for i, line in enumerate(lines):
            if isinstance(line, str) and what.startswith(" ".join(line.split())):
                return f"{path}[{i}]"
    return str(path)


def _has(data: Any, path: str) -> bool:
    for step in path.split("."):
        if not isinstance(data, dict) or data.get(step) is None:
            return False
        data = data[step]
    return True
