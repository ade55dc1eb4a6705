"""Cams of any machine: laws of motion, cam profiles for every follower, size, undercut, checks.

Begin with `laws` (law by name) and `profile` (one formulation of profile, pressure angle and curvature).
Nothing here knows a machine.
"""
