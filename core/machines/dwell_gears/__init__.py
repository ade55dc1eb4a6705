"""Dwells by gears alone: the hypocycloid dwell and the mutilated gear, a `*_spec` and a `*_design` each.

Begin with `hypocycloid_design` or `mutilated_design`, which have the kernels.
"""
