"""A cam whose profile was measured: the motion of its follower, and the laws that it seems to be made of. Begin with
design.
"""
