"""Wide-swing cam mechanisms: elastic law of motion, unloading device, twin-cam, twin-rocker, slider, oscillating cam.

Begin with `design`; `law` is the device and the law that it imposes, `cams` the geometry of all layouts, `loads` the
forces.
"""
