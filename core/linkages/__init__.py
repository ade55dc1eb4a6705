"""Linkages of any machine: four-bar, slider-crank, dyad, standstills, mobility.

Begin with `fourbar` (one position, `math` alone) or `fourbar_sweep` (arrays); the second way is `fourbar_newton`.
The kinds `slider-crank` and `gear-train-mobility`, which are bare linkages, stand here too.
"""
