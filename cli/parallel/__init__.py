"""Computing at several places at once: processes of this machine, a Dask cluster.

Begin with `workers`, an ordinary executor whose processes end with this one.
"""
