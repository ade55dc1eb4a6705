"""Cams of wide-swing mechanisms: twin-cam, twin-rocker, slider and oscillating cam; their contours and contact.

Begin with `cam`; `curve` has the formulas of its pitch curve.
"""
