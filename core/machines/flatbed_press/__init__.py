"""The flatbed press: two drag-link chains, synchronous zone, compensation cam pair.

Begin with `design`; `chains` is the kinematics, `zone` the synchronous zone, `compensation` the cam follower.
"""
