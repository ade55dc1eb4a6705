"""Many designs in one run: shares, processes, cache, summaries for people and for CI.

Begin with `run`.
"""
