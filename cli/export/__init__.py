"""Profiles and tables as DXF, SVG and CSV, within a chord error that is measured (`gearlink export`).

Begin with `command`; `parts` says what a design has to export.
"""
