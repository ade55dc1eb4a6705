"""Names of what the drawing of a mesh inside a machine gives, beside the quantities that every mesh has."""

from __future__ import annotations

TRAIN_QUANTITIES = (
    "transverse_pressure_angle",
    "base_helix_angle",
    "overlap_ratio",
    "total_contact_ratio",
    "usable_contact_ratio",
    "path_of_contact",
    "form_radius",
    "used_root_radius",
    "tip_clearance",
    "specific_sliding_tip",
    "sliding_factor",
    "involute_margin",
    "radial_assembly_margin",
    "pin_diameter",
    "measure_over_balls",
    "measure_over_pins",
    "chordal_thickness",
    "chordal_height",
    "generating_shift",
    "span_measurement_limits",
    "measure_limits",
    "backlash_circumferential",
    "backlash_normal",
    "backlash_angle",
)
TRAIN_CHECKS = ("fillet-interference", "backlash")
