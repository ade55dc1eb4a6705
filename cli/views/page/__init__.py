"""A design as an HTML page: input, results, findings, tables, sheets with a linked cursor, the animation.

Begin with `sections`; `server` serves the page of a file that is being edited.
"""
