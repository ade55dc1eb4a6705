"""The study file: its keys, the expressions in it, what can be wrong with it, and the rules of its result.

Begin with `spec`; `gearlink.core.explore` computes what a study asks for.
"""
