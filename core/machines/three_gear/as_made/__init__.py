"""Drives whose parts are as made, not as designed: one, many, and the samples of the command tolerance.

Begin with `one`.
"""
