"""The swing gripper of a sheet-fed press: six-phase law, vector loop, handover, cams, force closure.

Begin with `design`; `law` and `linkage` are the kinematics.
"""
