"""Loads of any mechanism: torque, joint and tooth forces, flywheel and motor, cam contact, residual vibration.

Begin with `design`, which all kinds share; `gearlink.core.mechanism` defines what a machine must provide (links and
connections) and computes torque and reactions from it, `cams` adds rollers. No module depends on a machine; the part
of a machine is in its own module `loads`.
"""
