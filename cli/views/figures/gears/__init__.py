"""Panels of gears, for the sheet of a pair and for machines that hold meshes: teeth, values, contour, path of contact.

Begin with `mesh`.
"""
