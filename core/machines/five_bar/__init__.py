"""The geared five-bar: path and function form, and the synthesis of both.

Begin with `design`; `path_motion` and `function_motion` are the kinematics, `fit`, `function_fit` and `guidance` the
syntheses.
"""
