"""Tolerances of any design: standard limits, laws of distribution, samples, yields and what contributes to them.

Begin with `sources`, which makes laws of the entries of a design file. The study of a whole design stands in
`gearlink.core.studies.tolerance_study`; no machine is imported here.
"""
