"""Syntheses: from an output motion to the links, and to the idler where it is left open.

Begin with `base`; one module a command, `families` are the linkages among which those of unequal gears search.
"""
