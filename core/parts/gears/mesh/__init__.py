"""Two gears in mesh: distances, shifts and tips, contact, rings, what a pair must satisfy to exist.

Begin with `pair`; `pair_sweep` is the same for arrays, rings included.
"""
