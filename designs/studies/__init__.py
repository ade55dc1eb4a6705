"""Worked studies of `gearlink explore`."""
