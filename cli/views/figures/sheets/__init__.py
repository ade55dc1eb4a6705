"""Sheets that a design has besides the picture of its command: timing, motion of every output, cams.

Begin with `motion_sheet`.
"""
