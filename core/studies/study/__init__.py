"""The study file: its keys, the expressions in it, and what can be wrong with it.

Begin with `spec`; `gearlink.core.studies.explore` computes what a study asks for.
"""
