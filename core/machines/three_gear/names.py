"""What an analysis of the three-gear four-bar shows, by name."""

from __future__ import annotations

from gearlink.core.base.real_speed import OUTPUT_SPEEDS
from gearlink.core.numerics.motion_extremes import names
from gearlink.core.parts.gears.train.meshed import named
from gearlink.core.parts.gears.train.single_mesh import MESH_CHECKS
from gearlink.core.parts.linkages.feed import FEED_QUANTITIES

QUANTITIES = (
    "i3",
    "crank_teeth",
    "idler_teeth",
    "output_teeth",
    "frame_ratio",
    "crank_length",
    "coupler_length",
    "rocker_length",
    "frame_length",
    "mean_ratio",
    "speed_ratio_max",
    "speed_ratio_min",
    "motion",
    "dwell_crank_angles",
    "back_step_angle",
    "back_step_crank_angle",
    "dwell_angle",
    "dwell_angle_approximate",
    "min_transmission_angle",
    "gear_gap",
    "nonuniformity",
    "speed_ratio_max_at",
    "speed_ratio_min_at",
    *names("acceleration_ratio"),
    "rocker_swing",
    "tolerance_dwell_angle",
    "tolerance_dwell_start",
    "input_speed",
    "turn_time",
    *OUTPUT_SPEEDS,
    "back_step_time",
    "dwell_time",
    "tolerance_dwell_time",
    *FEED_QUANTITIES,
)
CHECKS = (
    "gear-collision",
    "shaft-clearance",
    "shaft-seat",
    "transmission-angle",
    "rounded-ratio",
    "dwell-tolerance",
    *MESH_CHECKS,
)
MESHES = ("crank_idler", "idler_output")
MESH_QUANTITIES = named(MESHES)
