"""Profiles of cams and gears as files for CAD and machine tools: DXF, SVG, CSV."""
