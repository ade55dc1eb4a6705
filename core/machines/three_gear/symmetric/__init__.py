"""The symmetric family (I = 1): its closed forms, the dwell within a tolerance, its design charts.

Begin with `family`, then `back_step`.
"""
