"""Syntheses: from an output motion to the links, and to the idler where it is left open.

Begin with `base`; one module a command. Those of unequal gears search among the linkages of `families`.
"""
