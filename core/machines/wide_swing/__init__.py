"""Wide-swing cam mechanisms: elastic law of motion, unloading device, twin-cam, twin-rocker, slider, oscillating cam.

Begin with `design`; `law` is the device and the law that it imposes, `cam`, `slider` and `oscillating_cam` the
geometry of the layouts, `loads` the forces.
"""
