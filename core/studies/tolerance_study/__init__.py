"""The tolerance study of a design: samples of it as made, their yields, what contributes to them, what to tighten.

Begin with `design`, the study as a design whose results a report shows, with slopes, indices and the choice of grades;
`problem` makes the sources ready, `samples` computes designs as manufactured, `statistics` says what came of them.
"""
