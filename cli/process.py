"""Whose the process is: what saves time at the cost of others in it is done only where there are none."""

runs_the_command_alone = False
"""Set by the command's entry point; False where Python code or a notebook has imported gearlink."""

output_is_read = True
"""False once the reader of a pipe on standard output has gone: what is written there from then on is lost."""
