"""What the program explains: codes, quantities, formulas, keys, the JSON Schema.

Begin with `codes`.
"""
