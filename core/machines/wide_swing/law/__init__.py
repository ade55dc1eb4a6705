"""The unloading device of a wide-swing rocker, and the law of motion that it imposes.

Begin with `device`, then `elastic_law`; `iteration` is the source's own synthesis.
"""
