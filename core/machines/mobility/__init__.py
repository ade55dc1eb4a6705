"""Degrees of freedom of linkages that carry gear trains, and the kind `gear-train-mobility`.

Begin with `design`, which counts them too.
"""
