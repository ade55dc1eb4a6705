"""The geared six-bar: a loop of six links whose three degrees of freedom two gear trains reduce to one.

Begin with `loop` (what a train ties, positions and rates); `design` follows the loop from its start.
"""
