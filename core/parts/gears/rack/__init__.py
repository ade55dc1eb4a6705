"""A gear on a rack: its mesh, the profile of the rack, where both stand, its rating.

Begin with `mesh`.
"""
