"""All that is particular to a machine, a folder each."""
