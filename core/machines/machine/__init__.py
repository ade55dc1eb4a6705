"""A whole machine: members of any kind on one main shaft, or one driven by another.

Begin with `series` (what a member does over the machine angle) and `timing` (runs, events, free phases);
`relations` reads what is required of them, `shaft` is the main shaft as a torsional chain, `design`, `loads` and
`register` are the commands.
"""
