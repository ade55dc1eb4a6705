"""One gear: the involute function, teeth, the tools that cut them, the root that these leave.

Begin with `teeth`; `mesh.pair_sweep` has its formulas for arrays.
"""
