"""Drives of gears or links with cams: cam-gear, cam-linkage, linked cams; begin with `spec`."""
