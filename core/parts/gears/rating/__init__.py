"""Strength of a pair by ISO 6336: flanks (part 2) and roots (part 3), method B.

Begin with `load`, which says what the pair carries; `root_stress` and `flank_strength` give the safeties.
"""
