"""Run time against error of every solver (`gearlink bench`).

Begin with `command` and `families`.
"""
