"""Rollers on cams: their contact, forces and pressures, what a machine with cams shows besides, springs that hold them.

Begin with `design`; `contact` is the kernel.
"""
