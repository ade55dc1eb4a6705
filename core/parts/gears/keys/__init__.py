"""Keys of design files that describe gears, shared by the pair, the rack and the gears inside machines.

Begin with `pair`.
"""
