"""Four-bars with a gear fixed to the coupler: two-gear four-bar and geared rocker.

Begin with `two_gear_design` or `rocker_design`; `planet` is the kinematics of both.
"""
