"""Whether the bodies in the plane of the gears of any machine keep clear of each other over the whole cycle.

Begin with `bodies`: a machine lists its gears, its shafts and how near their axes come; `checks` judges every pair.
`reach` holds how far bodies reach from their axes.
"""
