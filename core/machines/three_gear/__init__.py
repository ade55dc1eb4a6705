"""The three-gear four-bar: analysis, four syntheses, dwells, choice of the idler, design charts.

Begin with `design` (analysis) and `synthesis.base`; `motion` is the kinematics, `dwell` where the output stands,
`symmetric` the case I = 1, `many` all of it over arrays, `register` and `as_made` what errors of the parts cost.
"""
