"""Standstills, back-steps and dwells of three-gear drives with any gears, external and internal.

Begin with `dwells`; `momentary_dwell` has the closed forms of an output that just stops.
"""
