"""Names of what `loads` shows, and the unit of speeds."""

from __future__ import annotations

import math

RPM = 2.0 * math.pi / 60.0
"""1/min in rad/s."""
TORQUE = (
    "input_torque_mean",
    "input_torque_rms",
    "input_torque_max",
    "input_torque_max_at",
    "input_torque_min",
    "input_torque_min_at",
    "input_power_mean",
    "input_power_peak",
    "reflected_inertia_min",
    "reflected_inertia_max",
    "reflected_inertia_mean",
    "torque_reversals",
    "energy_fluctuation",
)
RUN = ("flywheel_inertia", "speed_min", "speed_max", "speed_fluctuation", "motor_torque_rms", "motor_torque_peak")
FRAME = ("shaking_force_max", "shaking_moment_max")
BALANCE = (
    "counterweight_crank",
    "counterweight_crank_direction",
    "counterweight_rocker",
    "counterweight_rocker_direction",
    "balanced_force_max",
)
PIN = ("peak", "equivalent", "travel", "life", "bearing_pressure")
MESH = ("tooth_force_max", "reversals")
TABLES = ("torque", "joints", "teeth", "frame", "speed", "spectrum", "harmonics")
OF_VIBRATION = ("spectrum", "harmonics")
VIBRATION = (
    "natural_frequency",
    "frequency_ratio",
    "rise_periods",
    "residual_amplitude",
    "residual_speed_limit",
    "dwell_twist",
    "twisted_ripple",
)
DERIVED = frozenset((*TORQUE, *RUN, *FRAME, *PIN, *VIBRATION, "tooth_force_max", "balanced_force_max")) - {
    "input_torque_max",
    "life",
    "natural_frequency",
}
"""What refuses nothing that the checks of `loads` or the other quantities let pass."""
