"""The tolerance study of a design: samples as manufactured, their yields, contributions, and what to tighten.

Begin with `design`, the study as a design whose results a report shows, with sensitivities, indices and the choice of
grades; `problem` prepares the sources, `samples` computes designs as manufactured, `statistics` evaluates them.
"""
