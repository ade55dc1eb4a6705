"""Whose the process is: what saves time at the cost of others in it is done only where there are none."""

runs_the_command_alone = False
"""Set by the command's entry point; False where Python code or a notebook has imported gearlink."""
