"""The three-gear four-bar: analysis, four syntheses, dwells, choice of the idler, design charts.

Begin with `design` (analysis) and `synthesis`; `motion` is the kinematics, `symmetric_family` the case I = 1.
"""
