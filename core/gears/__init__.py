"""Involute gears: single tooth, pair, mesh, true profile, checks and remedies.

Begin with `pair` (a gear pair as a record) and `design` (the kind `gear-pair`).
"""
