"""What all sheets are drawn with: style, panels and their places, scenes on axes, second axes in real time.

Begin with `style`.
"""
