"""One module per command: what it prints and how it ends.

`design` serves every command that works on one design file.
"""
