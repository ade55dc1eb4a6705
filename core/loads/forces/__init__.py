"""Reactions and torque of moving links: what a machine gives, Newton and Euler, friction, what acts from outside.

Begin with `mechanism`, then `dynamics`.
"""
