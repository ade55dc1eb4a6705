"""`python -m gearlink.cli` runs the command."""

from gearlink.cli.main import main

main()
