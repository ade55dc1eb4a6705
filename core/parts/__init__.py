"""Formulas of parts: gears, linkages, cams; closed forms, tooth geometry, laws, profiles."""
