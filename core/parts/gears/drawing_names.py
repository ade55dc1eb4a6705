"""Names of what the drawing of a gear pair needs: quantities with their places, checks, and gears in findings."""

from __future__ import annotations

from typing import Any, TypeAlias

from gearlink.core.parts.gears.codes import AT_LIMITS, OF_RATING, TRUE_FILLET

Roles: TypeAlias = tuple[str, str]
"""What findings call the gears of a pair."""
GEARS: Roles = ("gear 1", "gear 2")


def _at(place: str, *names: str) -> dict[str, str]:
    return {name: place + name for name in names}


PLACES = {
    **_at("pair.", "transverse_pressure_angle", "base_helix_angle"),
    **_at("path.", "overlap_ratio", "total_contact_ratio", "usable_contact_ratio"),
    "path_of_contact": "path.length",
    **_at("pair.", "min_teeth_no_undercut", "form_radius"),
    "used_root_radius": "path.used_root_radius",
    "tip_clearance": "pair.tip_clearance",
    "specific_sliding_tip": "path.sliding_at_tip",
    "sliding_factor": "path.sliding_factor",
    "tooth_loss_factor": "path.loss_factor",
    **_at("internal.", "involute_margin", "tip_fouling_margin", "radial_assembly_margin"),
    **_at("", "pin_diameter", "measure_over_balls", "measure_over_pins", "chordal_thickness", "chordal_height"),
    **_at("", "generating_shift", "span_measurement_limits", "measure_limits"),
    "backlash_circumferential": "backlash.circumferential",
    "backlash_normal": "backlash.normal",
    "backlash_angle": "backlash.angle",
    **_at("flank.", "tangential_force", "zone_factor", "elasticity_factor", "contact_ratio_factor"),
    "helix_angle_factor_contact": "flank.helix_angle_factor",
    "single_contact_factor": "flank.single_contact_factor",
    "nominal_contact_stress": "flank.nominal_stress",
    **_at("", "contact_stress", "safety_pitting"),
    "root_chord": "root.chord",
    "bending_moment_arm": "root.moment_arm",
    "root_fillet_radius": "root.fillet_radius",
    **_at("root.sections.", "form_factor", "stress_correction_factor"),
    "helix_angle_factor_bending": "root.helix_angle_factor",
    **_at("root.", "rim_factor", "deep_tooth_factor", "load_reversal_factor"),
    "tip_form_factor": "root.at_tip.form_factor",
    "tip_stress_correction_factor": "root.tip_stress_correction_factor",
    "contact_ratio_factor_bending": "root.contact_ratio_factor",
    "nominal_root_stress": "root.nominal_stress",
    **_at("", "root_stress", "safety_bending"),
    "dynamic_factor": "rated.at_load.dynamic",
    **_at("rated.at_load.", "resonance_ratio", "resonance_speed"),
    "reduced_mass": "rated.bodies.reduced_mass",
    **_at("rated.at_load.", "single_stiffness", "mesh_stiffness", "mesh_stiffness_face"),
    "face_load_factor_contact": "rated.at_load.face_contact",
    "face_load_factor_bending": "rated.at_load.face_bending",
    "transverse_load_factor_contact": "rated.at_load.transverse_contact",
    "transverse_load_factor_bending": "rated.at_load.transverse_bending",
    "load_cycles": "rated.load_cycles",
    **_at("rated.steels.", "contact_limit", "bending_limit"),
    **_at("rated.", "lubricant_factor", "velocity_factor", "roughness_factor", "work_hardening_factor"),
    **_at("rated.", "size_factor_contact", "life_factor_contact", "pitting_limit_stress", "notch_sensitivity_factor"),
    **_at("rated.", "surface_factor", "size_factor_bending", "life_factor_bending", "mean_stress_factor"),
    **_at("rated.", "root_limit_stress"),
    "single_pitch_deviation": "rated.bodies.tolerances.single_pitch",
    "base_pitch_deviation": "rated.bodies.base_pitch_deviations",
    "profile_form_deviation": "rated.bodies.tolerances.profile_form",
    "helix_slope_deviation": "rated.bodies.tolerances.helix_slope",
    **_at("rated.", "damage_pitting", "damage_bending", "pitting_life", "bending_life"),
    **_at("rated.scuffing.", "integral_temperature", "scuffing_temperature"),
    "safety_scuffing": "rated.scuffing.safety",
}
"""Where each quantity of a drawing stands in a GearData."""
_FORCE, _WIDTH = "load (torque, power with speed, or tangential_force)", "face_width"
_NEEDED = {
    "tangential_force": (_FORCE,),
    **dict.fromkeys(
        ("nominal_contact_stress", "contact_stress", "nominal_root_stress", "root_stress"), (_FORCE, _WIDTH)
    ),
    "safety_pitting": (_FORCE, _WIDTH, "material.contact_limit"),
    "safety_bending": (_FORCE, _WIDTH, "material.bending_limit"),
    **dict.fromkeys(("generating_shift", "span_measurement_limits", "measure_limits"), ("allowances",)),
    **dict.fromkeys(("backlash_circumferential", "backlash_normal", "backlash_angle", "output_play"), ("allowances",)),
    **dict.fromkeys(("overlap_ratio", "total_contact_ratio"), (_WIDTH,)),
}


def lacking(quantity: str, section: Any, prefix: str = "") -> str:
    """What a file must give so that a quantity of a drawing is known, in words; empty where nothing is missing.

    Parameters
        quantity : str - plain name
        section : the section with the keys of a pair or a train
        prefix : str - of its keys, "gears."
    """
    missing = []
    for words in _NEEDED.get(quantity, ()):
        found = section
        for step in words.partition(" ")[0].split("."):
            found = getattr(found, step, None)
        if found is None:
            missing.append(prefix + words)
    return f"give {', '.join(missing)}" if missing else ""


DRAWING_QUANTITIES = tuple(PLACES)
_SAFE = frozenset(("contact_stress", "safety_pitting", "root_stress", "safety_bending"))
RATING = frozenset(name for name, place in PLACES.items() if place.startswith(("flank.", "root.", "rated."))) | _SAFE
"""Strength by ISO 6336."""
DERIVED = frozenset(DRAWING_QUANTITIES) - {"usable_contact_ratio", "span_measurement_limits", "backlash_normal"}
"""Those of them that refuse nothing: they have a value or None wherever the others, teeth and checks have one."""
RATING_CHECKS = tuple(rule.name for rule in OF_RATING)
"""They find something only where the file has `rating`."""
DRAWING_CHECKS = (
    "tip-fouling",
    "radial-assembly",
    "fillet-interference",
    "backlash",
    "inspection",
    *AT_LIMITS,
    "pitting",
    "bending",
    *RATING_CHECKS,
)
BESIDE_ROOT = ("generated_root_factor", "generated_root_stress"), (TRUE_FILLET.name,)
"""Quantities and checks beside the table `root` alone, whose boundary integral takes a tenth of a second."""
