"""Gears that mesh one after the other inside a machine: keys, meshes, quantities, checks, drawings.

Begin with `meshed`, which a machine's design derives from.
"""
