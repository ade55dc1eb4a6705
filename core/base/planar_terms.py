"""Words of the quantities of a planar mechanism; those of an output follow its name in the file."""

from __future__ import annotations

from gearlink.core.base.term import Term

PLANAR: dict[str, Term] = {
    "degrees_of_freedom": Term("F", "1", "degrees of freedom, 3 n - 2 (pins + slides) - slots - meshes", "Gruebler"),
    "grashof": Term("", "1", "class of the four-bars of the driven link by Grashof's rule", "VDI 2145"),
    "free_range": Term("", "deg", "inputs from dead centre to dead centre, between which the range lies"),
    "closure_error": Term("", "mm", "greatest gap of a joint over the rows"),
    "swing": Term("", "deg", "greatest less least direction of the link"),
    "turns": Term("", "1", "net turns of the link over the period"),
    "path_length": Term("", "mm", "length of the path of the point over the period or range"),
    "angle_max": Term("", "deg", "greatest direction of the link"),
    "angle_min": Term("", "deg", "least direction of the link"),
    "position_max": Term("", "mm", "greatest place along the slide or slot"),
    "position_min": Term("", "mm", "least place along the slide or slot"),
    "velocity_ratio_max": Term("", "mm/rad", "greatest velocity along the slide or slot per input speed"),
    "velocity_ratio_min": Term("", "mm/rad", "least velocity along the slide or slot per input speed"),
    "jerk_ratio_max": Term("", "1", "greatest jerk per cube of the input speed"),
    "jerk_ratio_min": Term("", "1", "least jerk per cube of the input speed"),
    "x_max": Term("", "mm", "greatest x of the point"),
    "x_min": Term("", "mm", "least x of the point"),
    "y_max": Term("", "mm", "greatest y of the point"),
    "y_min": Term("", "mm", "least y of the point"),
    "angle_max_at": Term("", "deg", "input of the greatest direction of the link"),
    "angle_min_at": Term("", "deg", "input of the least direction of the link"),
    "position_max_at": Term("", "deg", "input of the greatest place along the slide or slot"),
    "position_min_at": Term("", "deg", "input of the least place along the slide or slot"),
    "velocity_ratio_max_at": Term("", "deg", "input of the greatest velocity along the slide or slot per input speed"),
    "velocity_ratio_min_at": Term("", "deg", "input of the least velocity along the slide or slot per input speed"),
    "jerk_ratio_max_at": Term("", "deg", "input of the greatest jerk per cube of the input speed"),
    "jerk_ratio_min_at": Term("", "deg", "input of the least jerk per cube of the input speed"),
    "x_max_at": Term("", "deg", "input of the greatest x of the point"),
    "x_min_at": Term("", "deg", "input of the least x of the point"),
    "y_max_at": Term("", "deg", "input of the greatest y of the point"),
    "y_min_at": Term("", "deg", "input of the least y of the point"),
}
