"""Remedies that were tried: for a check that fails, the keys and the nearest values that repair it.

Begin with `trials`, where changes of a design are tried; `ways` says how a file may be changed, what can be built, and
what a change leaves of the commands of the file.
"""
