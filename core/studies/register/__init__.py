"""The register budget of any machine: what the errors of its parts cost at its output over a stretch of its cycle.

Begin with `design`; `gains` has what every error moves.
"""
