"""The three-gear four-bar over arrays of designs, for studies: what `axis` gives them, and the kernels beneath.

Begin with `axis`.
"""
