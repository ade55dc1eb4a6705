"""Teeth as curves, and where the gears stand in mesh: what drawings, animations and clearances are made of.

Begin with `tooth_profile`.
"""
