"""Words of the quantities of a planar mechanism; those of an output follow its name in the file."""

from __future__ import annotations

from gearlink.core.base.term import Term

_OF = {
    "angle": ("deg", "direction of the link"),
    "position": ("mm", "place along the slide or slot"),
    "velocity_ratio": ("mm/rad", "velocity along the slide or slot per input speed"),
    "jerk_ratio": ("1", "jerk per cube of the input speed"),
    "x": ("mm", "x of the point"),
    "y": ("mm", "y of the point"),
}

PLANAR: dict[str, Term] = {
    "degrees_of_freedom": Term("F", "1", "degrees of freedom, 3 n - 2 (pins + slides) - slots - meshes", "Gruebler"),
    "grashof": Term("", "1", "what the four-bars of the driven link are by Grashof's rule", "VDI 2145"),
    "free_range": Term("", "deg", "inputs from dead centre to dead centre, between which the range lies"),
    "closure_error": Term("", "mm", "greatest gap of a joint over the rows"),
    "swing": Term("", "deg", "greatest less least direction of the link"),
    "turns": Term("", "1", "net turns of the link over the period"),
    "path_length": Term("", "mm", "length of the path of the point over the period or range"),
    **{
        f"{name}_{side}": Term("", unit, f"{size} {words}")
        for name, (unit, words) in _OF.items()
        for side, size in (("max", "greatest"), ("min", "least"))
    },
    **{
        f"{name}_{side}_at": Term("", "deg", f"input of the {size} {words}")
        for name, (_, words) in _OF.items()
        for side, size in (("max", "greatest"), ("min", "least"))
    },
}
