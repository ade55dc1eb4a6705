"""`python -m gearlink` runs the command, as `gearlink` does."""

from gearlink.cli.main import main

main()
