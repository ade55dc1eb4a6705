"""Many designs in one run: shares, processes, summaries for people and for CI.

Begin with `run`.
"""
