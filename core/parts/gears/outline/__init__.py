"""Teeth as curves, and where the gears stand in mesh: what drawings, films and clearances are made of.

Begin with `tooth_profile`.
"""
