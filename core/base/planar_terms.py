"""Words of the quantities of a planar mechanism; those of an output follow its name in the file."""

from __future__ import annotations

from gearlink.core.base.term import Term

PLANAR: dict[str, Term] = {
    "degrees_of_freedom": Term(
        "F", "1", "degrees of freedom, 3 n - 2 (pins + slides) - slots - meshes - cams", "Gruebler"
    ),
    "grashof": Term("", "1", "class of the four-bars of the driven link by Grashof's rule", "VDI 2145"),
    "free_range": Term("", "deg", "inputs from dead centre to dead centre, between which the range lies"),
    "closure_error": Term("", "mm", "maximum gap of a joint over the rows"),
    "swing": Term("", "deg", "maximum less minimum direction of the link"),
    "turns": Term("", "1", "net turns of the link over the period"),
    "path_length": Term("", "mm", "length of the path of the point over the period or range"),
    "angle_max": Term("", "deg", "maximum direction of the link"),
    "angle_min": Term("", "deg", "minimum direction of the link"),
    "position_max": Term("", "mm", "maximum position along the slide or slot"),
    "position_min": Term("", "mm", "minimum position along the slide or slot"),
    "velocity_ratio_max": Term("", "mm/rad", "maximum velocity along the slide or slot per input speed"),
    "velocity_ratio_min": Term("", "mm/rad", "minimum velocity along the slide or slot per input speed"),
    "jerk_ratio_max": Term("", "1", "maximum jerk per cube of the input speed"),
    "jerk_ratio_min": Term("", "1", "minimum jerk per cube of the input speed"),
    "x_max": Term("", "mm", "maximum x of the point"),
    "x_min": Term("", "mm", "minimum x of the point"),
    "y_max": Term("", "mm", "maximum y of the point"),
    "y_min": Term("", "mm", "minimum y of the point"),
    "angle_max_at": Term("", "deg", "input of the maximum direction of the link"),
    "angle_min_at": Term("", "deg", "input of the minimum direction of the link"),
    "position_max_at": Term("", "deg", "input of the maximum position along the slide or slot"),
    "position_min_at": Term("", "deg", "input of the minimum position along the slide or slot"),
    "velocity_ratio_max_at": Term("", "deg", "input of the maximum velocity along the slide or slot per input speed"),
    "velocity_ratio_min_at": Term("", "deg", "input of the minimum velocity along the slide or slot per input speed"),
    "jerk_ratio_max_at": Term("", "deg", "input of the maximum jerk per cube of the input speed"),
    "jerk_ratio_min_at": Term("", "deg", "input of the minimum jerk per cube of the input speed"),
    "x_max_at": Term("", "deg", "input of the maximum x of the point"),
    "x_min_at": Term("", "deg", "input of the minimum x of the point"),
    "y_max_at": Term("", "deg", "input of the maximum y of the point"),
    "y_min_at": Term("", "deg", "input of the minimum y of the point"),
}
