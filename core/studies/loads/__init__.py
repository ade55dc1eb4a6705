"""Loads of any mechanism: torque, joint and tooth forces, flywheel and motor, cam contact, residual vibration.

Begin with `design`, which all kinds share; `gearlink.core.mechanism` says what a machine must give (links and
connections) and turns that into torque and reactions, `cams` adds rollers. Nothing here knows a machine: its own part
stands in its `loads`.
"""
