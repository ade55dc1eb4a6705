"""The geared six-bar: a loop of six links whose three degrees of freedom two gear trains reduce to one.

Begin with `loop` (positions and rates); `relations` says what a train ties, `course` follows the loop from its start.
"""
