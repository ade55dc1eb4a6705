"""The study file: its keys, the expressions in it, what can be wrong with it, and the rules of its result.

Begin with `spec`; `gearlink.core.studies.explore` computes what a study asks for.
"""
