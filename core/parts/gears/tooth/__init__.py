"""One gear: the involute function, teeth, the tools that cut them, the root that these leave.

Begin with `teeth`; `functions` are what its formulas are made of, and `mesh.pair_sweep` has them for arrays.
"""
