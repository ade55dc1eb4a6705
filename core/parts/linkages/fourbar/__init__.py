"""The four-bar: closing, angles and rates, at one position and over arrays, in closed form and by Newton's method.

Begin with `position` (`math` alone) or `sweep` (arrays of crank angles); the second way is its `solve_by_newton`.
"""
