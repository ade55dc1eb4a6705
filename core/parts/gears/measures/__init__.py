"""What a workshop measures and allows: spans, balls and chords, allowances, backlash.

Begin with `inspection`.
"""
