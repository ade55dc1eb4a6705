"""Rollers on cams: their contact, forces and pressures, and what a machine with cams shows besides.

Begin with `design`; `contact` is the kernel.
"""
