"""The version of gearlink, alone in a module so that `--version` imports nothing else."""

VERSION = "0.2.0"
