"""The offset slider-crank, and the kind `slider-crank`.

Begin with `position` (`math` alone) or `design` (the kind).
"""
