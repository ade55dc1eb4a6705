"""`gearlink explore`: the command, the store of what is computed, the processes that compute, tables and pictures.

Begin with `run`, which goes from the study file to the page; what a study is stands in `gearlink.core.studies.explore`.
"""
