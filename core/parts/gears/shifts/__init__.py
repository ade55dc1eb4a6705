"""Choice of teeth and profile shifts: shares of the sum, the blocking contour, the search for whole teeth.

Begin with `shift_split`, then `contour`.
"""
