"""The codes GL150 to GL160: what can be wrong with a study file, or with the store of what was computed."""

from __future__ import annotations

from gearlink.core.report import Rule

STUDIES: tuple[Rule, ...] = (
    Rule(
        "GL150",
        "base design missing or given twice",
        "A study has one base design: the file that `of` names, or the one that stands in it under `design`.",
        "Every design of a study is the base with other values at the paths of its variables.",
        "Give `of` or `design`, exactly one.",
    ),
    Rule(
        "GL151",
        "variable leads nowhere",
        "A variable, one of its `also`, or what its `times` names is no key of the base design's kind, or no variable "
        "above it.",
        "A variable that changed nothing would multiply the designs without a word.",
        "Take the nearest path of the message; `gearlink schema KIND` lists all of them.",
    ),
    Rule(
        "GL152",
        "quantity or check unknown, or not to be compared",
        "An objective, a definition or a condition names a quantity that the kind does not have, a list without an "
        "index or a word where a number is needed, or cannot be read; or a check has no such code.",
        "What cannot be computed cannot be sought.",
        "Take the nearest name of the message. Expressions have numbers, quantities, [i] (from 0), + - * /, min, max, "
        "abs, sqrt and brackets.",
    ),
    Rule(
        "GL153",
        "unit differs",
        "A resolution or a limit is given in another unit than its quantity has.",
        "Nothing is converted: a wrong unit would be a wrong limit.",
        "Give it in the quantity's own unit, or leave the unit out.",
    ),
    Rule(
        "GL154",
        "resolution missing",
        "An objective has no resolution above 0.",
        "The resolution is the difference that you would not pay for; without it a front has as many rows as designs.",
        "Give one, such as `envelope: 10 mm`.",
    ),
    Rule(
        "GL155",
        "more designs than the budget",
        "The grid of all variables holds more designs than `sampling.budget`, or a variable has no grid, and the "
        "method `grid` is asked for.",
        "A grid is computed whole or not at all.",
        "Coarsen the variable of the message, raise the budget, or take the method auto, which samples then.",
    ),
    Rule(
        "GL156",
        "base design or value refused",
        "The base design is wrong or cannot be computed, or its model refuses a value of a variable.",
        "A study varies a design that exists; each value is tried alone before any design is computed.",
        "Repair the base, or narrow the variable's range to what its key takes.",
    ),
    Rule(
        "GL157",
        "store of another study",
        "The store was made for a study that differs from this one in the key of the message.",
        "Its results belong to other designs.",
        "Give another --store, or put the study back as it was.",
    ),
    Rule(
        "GL158",
        "store or worker of another program",
        "The store was made, or a worker runs, with another gearlink (its version or its code), Python, numpy or "
        "scipy, or on another type of processor.",
        "Last bits of numbers would differ within one result. A finished store is shown nevertheless, with a note.",
        "Continue where it was begun, or begin a new store.",
    ),
    Rule(
        "GL159",
        "store exists or is damaged",
        "The store is there already, and --resume was not given; or it is no store, or in use; or its content is not "
        "what was written, as its checksums tell.",
        "Results are never overwritten, and what a disk or a copy has changed is not believed.",
        "Add --resume to continue it, or give another --store. Put back a copy of a damaged one, or compute it again.",
    ),
    Rule(
        "GL160",
        "two ways, two results",
        "A design of the front has other figures by its own class than in the search.",
        "This is a fault of the program, not of the study.",
        "Please report it with the study; the message has the design and both figures.",
    ),
)
