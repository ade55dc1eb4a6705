"""Sheets: one matplotlib figure per kind and command.

Begin with `write`; `style` and `panels` are what all sheets share.
"""
