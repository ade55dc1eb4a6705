"""The geared six-bar: a loop of six links whose three degrees of freedom two gear trains reduce to one.

Begin with `design`: what a train ties, positions and rates, and the loop followed from its start.
"""
