"""A design as an HTML page: input, results, findings, tables, sheets with a linked cursor, the animation.

Begin with `sections`.
"""
