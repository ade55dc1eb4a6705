"""What is drawn of a mechanism, as data, one module per kind.

Begin with `scene`.
"""
