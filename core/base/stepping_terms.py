"""The words of Geneva drives, cycloidal reducers, racks on a crank, and mechanisms of gears or links with cams."""

from __future__ import annotations

from gearlink.core.base.term import Term

GENEVA = {
    "crank_radius": Term("r", "mm", "radius of the pin's circle", "thesis 4.2.1; own derivation: a sin(pi/n)"),
    "wheel_radius": Term("R", "mm", "radius of the wheel to its slots' mouths", "own derivation: a cos(pi/n)"),
    "slot_bottom_radius": Term("", "mm", "wheel axis to the bottoms of the slots"),
    "lip_thickness": Term("", "mm", "metal between locking arc and slot", "own derivation: r - r_pin - locking_radius"),
    "motion_angle": Term("2 f_0", "deg", "input angle of a step", "own derivation: 180 deg - s 360 deg/n"),
    "locking_angle": Term("", "deg", "input angle between two steps, in which the wheel dwells"),
    "entry_acceleration_ratio": Term("tan(pi/n)", "1", "jump of the acceleration ratio at entry and exit"),
    "steps_per_minute": Term("", "1/min", "steps of the wheel in a minute: input speed times pins", "thesis 4.2.1"),
    "contact_force_max_at": Term("", "deg", "input angle of the maximum contact force"),
}
REDUCER = {
    "ratio": Term("i", "1", "input speed over output speed, signed", "thesis 2.2.2 II"),
    "lobes": Term("z", "1", "lobes of the disc, one less than pins", "thesis 2.2.2 II"),
    "shortening": Term("K", "1", "shortening coefficient e Z/R", "own derivation"),
    "pressure_angle_min": Term("", "deg", "minimum pressure angle at the pins that push, eccentric at 0"),
    "pressure_angle_mean": Term("", "deg", "mean pressure angle at the pins that push, eccentric at 0"),
    "pressure_angle_max": Term("", "deg", "maximum pressure angle at the pins that push, eccentric at 0"),
    "pin_force_max": Term("F_P,max", "N", "maximum force of a ring pin, pins of equal stiffness", "own derivation"),
    "output_pin_force_max": Term("Q_max", "N", "maximum force of an output pin", "own derivation"),
    "efficiency": Term(
        "eta",
        "1",
        "estimate from forces without loss; no churning, no seals; the force on the eccentric's bearing "
        "is taken as ring pins plus output pins pushing the same way, more than it is",
        "own derivation",
    ),
    "backlash": Term("", "deg", "turn of the disc between both flanks of the pins", "own derivation"),
    "output_hole_radius": Term("r_w + e", "mm", "radius of the holes for the output pins"),
}
RACKS = {
    "stroke_ratio": Term("1 +- z_m/z_f", "1", "stroke of the rack over the rod end's, signed", "thesis 2.2.2 III"),
    "output_stroke": Term("S_R", "mm", "stroke of the moving rack", "thesis 2.2.2 III"),
    "pinion_turns": Term("", "1", "turns of the pinion in a stroke"),
    "fixed_rack_travel": Term("", "mm", "distance that the pinion rolls on the fixed rack"),
    "moving_rack_travel": Term("", "mm", "distance that the pinion rolls on the moving rack"),
    "fixed_rack_length": Term("", "mm", "minimum length of the fixed rack: travel and path of contact"),
    "moving_rack_length": Term("", "mm", "minimum length of the moving rack: travel and path of contact"),
}
STEP_TRAIN = {"steps": Term("", "1", "steps of the output per revolution of the carrier", "thesis 2.2.2")}
CAM_DRIVE = {
    "lever_swing": Term("", "deg", "range of the lever's angle against the carrier", "thesis 1.3.4; own derivation"),
    "path_speed_max": Term("", "mm/s", "maximum speed along the path"),
    "path_speed_min": Term("", "mm/s", "minimum speed along the path"),
}
GUIDANCE = {
    "pose_error_max": Term("", "mm", "maximum distance of the guided body's point from a pose", "thesis 2.2.2 VI"),
    "pose_error_rms": Term("", "mm", "root of the mean square of these distances"),
    "pose_angle_error_max": Term("", "deg", "maximum angle by which the guided body misses a pose"),
    "body_angle": Term("", "deg", "direction of the coupler BC less the body's angle"),
    "frame_place": Term("", "mm", "position of A in the coordinates of the poses, where the frame is free"),
    "frame_direction": Term("", "deg", "direction from A to E there"),
}
PRESS_TEETH = {
    "pinion_radius": Term("r_8", "mm", "radius with which the pinion rolls on both racks", "TY-460 report 2.4"),
    "rack_teeth": Term("", "1", "teeth of the lower and the upper rack, given or as many as the travel takes"),
    "rack_travel": Term("", "mm", "distance of the pinion along the lower and the upper rack"),
}
STEPPING = {**PRESS_TEETH, **GUIDANCE, **GENEVA, **REDUCER, **RACKS, **STEP_TRAIN, **CAM_DRIVE}
