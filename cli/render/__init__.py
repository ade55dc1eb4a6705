"""One renderer per format of a report: terminal, JSON, CSV, Markdown."""
