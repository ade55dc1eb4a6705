"""Studies: which of many designs are the best ones. Every design of a grid is computed, or a sample of a continuum.

Begin with `problem`, a study made ready by `preparing`; `chunks` computes shares of it and puts them together, `front`
holds what is left, `exploration` is the study as a design whose results a report shows. Nothing here stores or prints.
"""
