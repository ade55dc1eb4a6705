"""Worked designs, one file each; also the templates of `gearlink new`."""
