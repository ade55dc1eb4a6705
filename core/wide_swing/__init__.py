"""Wide-swing cam mechanisms: elastic law of motion, unloading device, twin-cam, twin-rocker, slider, oscillating cam.

Begin with `design`; `elastic_law` is the law by quadrature, `cam` the geometry of both layouts.
"""
