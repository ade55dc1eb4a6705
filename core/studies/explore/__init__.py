"""Studies: the best of many designs. Every design of a grid is computed, or a sample of a continuum.

Begin with `problem`, a study prepared by `preparing`; `chunks` computes shares of it and combines them, `front` holds
the designs that remain, `exploration` is the study as a design whose results a report shows. No module stores or
prints.
"""
