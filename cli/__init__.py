"""The command line: reading of design files, commands, renderers, plots."""
