"""The codes GL1xx: what can be wrong with a design file or a command line."""

from __future__ import annotations

from gearlink.core.report import Rule

FILES: tuple[Rule, ...] = (
    Rule(
        "GL101",
        "file cannot be read",
        "There is no such file or folder, it may not be read, or a folder holds no design file (.yaml, .yml).",
        "Nothing can be computed without it; a folder given where one file is wanted is not guessed at.",
        "Check the path. `gearlink batch` and `gearlink check` take folders, all other commands one file, or - for "
        "standard input.",
    ),
    Rule(
        "GL102",
        "not plain UTF-8 text",
        "The file has another encoding, or holds control characters.",
        "In another encoding a sign may read as another one, and a hidden character changes a key without being seen.",
        "Save the file as UTF-8 without formatting; delete the character at the line and column of the message.",
    ),
    Rule(
        "GL103",
        "not a YAML design",
        "The text breaks the rules of YAML, or is not made of `key: value` lines.",
        "Usual causes: tabs in the indentation, a missing space after a colon, a bracket or quotation mark that is "
        "never closed, signs that only look like the plain ones, a second document, tags or directives.",
        "The caret stands where reading failed; the cause often lies at the end of the line above. `gearlink new KIND` "
        "prints a file that works.",
    ),
    Rule(
        "GL104",
        "key given twice",
        "The same key stands twice in one section.",
        "Most readers silently keep the last one; which of the two was meant cannot be known.",
        "Delete one of the two.",
    ),
    Rule(
        "GL105",
        "unknown key",
        "The section has no such key.",
        "A misspelt key would otherwise be ignored, and the default used in its place.",
        "Take the nearest key of the message; `gearlink schema KIND` lists all of them with units and defaults.",
    ),
    Rule(
        "GL106",
        "key missing",
        "A key that has no default is missing, or none of several alternatives is given.",
        "Without it the design is not determined.",
        "Add the key; the message says what it means. `gearlink new KIND` prints a complete file.",
    ),
    Rule(
        "GL107",
        "wrong type of value",
        "A number, a text, a list or a section stands where another of these is wanted, or a list has a wrong length.",
        "Numbers in quotation marks are text, 40:20 and no are text in YAML 1.2, and true is no number.",
        "Write the value as the message asks: numbers plain, without unit and without quotation marks.",
    ),
    Rule(
        "GL108",
        "value out of range",
        "A number lies outside its range or is not finite, or a word is none of the choices.",
        "The ranges keep out what no machine has: lengths below zero, angles beyond a turn, pressure angles of 45 deg, "
        "and any number above 1e12 or, but for 0, below 1e-30 in size.",
        "Take a value from the allowed range or list of the message. Units are mm, deg, 1/min, sheets/h, N, kg, "
        "kg m^2 and N m.",
    ),
    Rule(
        "GL109",
        "unknown kind of design",
        "The key `kind` names no kind that gearlink knows.",
        "The kind decides which keys the file has and which commands apply.",
        "Take one of the kinds in the message; `gearlink explain KIND` says what each is.",
    ),
    Rule(
        "GL110",
        "too large, or too much",
        "The file is too large, nested too deeply or has too many values; or more errors were found than are shown.",
        "No design needs it; the caps keep a wrong or hostile file from filling the memory.",
        "Check that it is the right file. Repair the errors that are shown first, the others often follow from them.",
    ),
    Rule(
        "GL111",
        "keys contradict each other",
        "Each value is right by itself, but together they are not: two alternatives are given, or a sum does not hold.",
        "Only one of the two could be used, and nobody would know which.",
        "Leave out one of them, or change it by the amount that the message names.",
    ),
    Rule(
        "GL112",
        "no such mechanism",
        "The file is in order, but no mechanism exists for its numbers: a linkage does not close or cannot turn, a "
        "stroke is too long, a law has no solution.",
        "A result in its place would belong to another mechanism.",
        "The message names the value, its limit and the key to change; change that key, or those it depends on.",
        source="the equation that has no solution is named by `gearlink explain` of the quantity",
    ),
    Rule(
        "GL113",
        "command and file do not fit",
        "The command does not apply to this kind of design, or needs a section that the file does not have.",
        "A file holds what its own commands need; the other sections are optional.",
        "Add the section that the message names (`gearlink schema KIND` shows its keys), or take one of the commands "
        "that apply.",
    ),
    Rule(
        "GL114",
        "--set cannot be used",
        "The argument of --set is not of the form PATH=VALUE, or its path leads through something that is no section.",
        "An override that went nowhere would leave the design as it was, without a word.",
        "Write the path as in the messages: gears.crank=42, teeth[1]=20, limits.gear_gap=0.5. Values are YAML.",
    ),
    Rule(
        "GL115",
        "command line wrong",
        "An argument or option is unknown, missing or has a wrong value, or names a quantity, table, kind or code that "
        "does not exist.",
        "Nothing was computed.",
        "Take the nearest name of the message; `gearlink COMMAND --help` lists the options.",
    ),
    Rule(
        "GL116",
        "file cannot be written",
        "The folder does not exist and cannot be made, may not be written to, the disk is full, or the file is there "
        "already.",
        "Files are written whole or not at all: nothing half-written was left behind.",
        "Give another folder or file with --out; `gearlink new --force` overwrites.",
    ),
    Rule(
        "GL117",
        "cannot be compared",
        "`gearlink diff` was given two files of different sorts, designs of different kinds, or a JSON file that holds "
        "no result.",
        "Quantities of different kinds share names, but not meanings.",
        "Give two design files of one kind, or two files written with --format json.",
    ),
    Rule(
        "GL199",
        "fault of the program",
        "gearlink itself failed on this design; the other designs of a batch were computed.",
        "This is not the design's fault.",
        "Please report it with the design file; GEARLINK_TRACEBACK=1 shows where it arose.",
    ),
)
