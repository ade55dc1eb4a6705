"""The three-gear four-bar: analysis, four syntheses, dwells, choice of the idler, design charts.

Begin with `design` (analysis), `synthesis` and `dwell_synthesis`; `train` are the gears, `dwell` how the output goes
and where it stands, `momentary` where it just stops, `symmetric` the case I = 1, `families` linkages in one
unknown. `axis` has them over arrays of designs, for studies, by the kernels of `sweep`. `charts` are the curves of the
design charts, `register` is what errors of the parts cost.
"""
