"""Sheets: one matplotlib figure per kind and command, in the module (or package) named after the kind.

Begin with `write`; `drawing` is what all sheets are drawn with, `sheets` are those beside the picture of a command.
"""
