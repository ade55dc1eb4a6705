"""Data: the published cases, a file for each source."""
